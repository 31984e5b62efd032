#pragma once

#include <string>

namespace CLI {
class App;
}

namespace glissade::app {

/// @return what --help prints for a command: usage, what it does, arguments, options, examples. The same
///         bytes with every version of the library that parses the command line.
[[nodiscard]] std::string help_text(const CLI::App& command);

}  // namespace glissade::app
