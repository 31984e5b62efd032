#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace glissade::app {

/// What the help of a command says, whatever it is set in.
struct HelpPage {
  using Entries = std::vector<std::pair<std::string, std::string>>;  ///< what it is called, what it does

  std::string name;   ///< "glissade build"
  std::string usage;  ///< "glissade build DESIGN.yaml [OPTIONS]"
  std::string description;
  Entries commands;
  Entries arguments;
  std::vector<std::pair<std::string, Entries>> options;  ///< by the heading of their group
  std::string footer;
};

[[nodiscard]] HelpPage help_page(const CLI::App& command);

/// @return what --help prints for a command: usage, what it does, arguments, options, examples. The same
///         bytes with every version of the library that parses the command line.
[[nodiscard]] std::string help_text(const CLI::App& command);

/// @return the first sentence of a description, on one line, with its full stop
[[nodiscard]] std::string first_sentence(std::string_view description);

/// @return whether an option or a command is for scripts of the program's own, and in no help
[[nodiscard]] bool is_hidden(const CLI::App& command);

}  // namespace glissade::app
