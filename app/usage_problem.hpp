#pragma once

#include "glissade/core/error.hpp"

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace glissade::app {

/// What is wrong with arguments that were not understood.
/// @param parser_text  what the parser says of them
/// @return an unknown command, option or argument by its name, with the one that was probably meant; else what
///         the parser says
[[nodiscard]] Issue usage_issue(const CLI::App& program, const std::string& parser_text);

/// What is wrong with a command that the program does not have.
[[nodiscard]] Issue unknown_command(const CLI::App& program, const std::string& word);

/// Looks at values that the parser took but that name nothing: an empty one, or "-" for a file.
/// @throws InputError with the option
void require_values(const CLI::App& program);

/// Refuses options that were given and would change nothing.
/// @param beside  with what, or without what, they mean nothing: "beside --quantities", "without -o"
/// @throws InputError with the first of them
void refuse_ignored(const CLI::App& command, const std::vector<std::string>& options,
                    const std::string& beside, const std::string& why, const std::string& hint);

/// Looks that no file is written over one that the command reads, its design's profiles among them, or over
/// another that it writes.
/// @throws InputError with the option
void keep_what_is_read(const CLI::App& program);

}  // namespace glissade::app
