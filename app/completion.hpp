#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace glissade::app {

/// What may stand where a command line ends, for the completion of shells.
/// @param words  those after the program's name; the last is the one to complete, empty if nothing of it is there
/// @return a line each: the word, a tab, what it means; a word that ends with "=" goes on. ":files" with the
///         endings that count, or ":directories", where the shell knows better
[[nodiscard]] std::string completions(const CLI::App& program, const std::vector<std::string>& words);

/// @return a script for a shell that asks the program for completions; none if the shell is not known
[[nodiscard]] std::string completion_script(const std::string& shell);

/// @return the shells that there is a script for
[[nodiscard]] const std::vector<std::string>& completed_shells();

/// The first argument that asks for completions() of those that follow.
inline constexpr const char* kCompleteWord = "__complete";

}  // namespace glissade::app
