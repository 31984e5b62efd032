#pragma once

#include "glissade/core/error.hpp"
#include "glissade/core/quantity.hpp"

#include <string>
#include <utility>

namespace CLI {
class App;
}

namespace glissade::app {

/// Adds --json to a command.
/// @param instead  what it prints otherwise: "the table"
void add_json_flag(CLI::App& command, bool& json, const std::string& instead);

/// The value of an option: a plain number counts in SI units, anything else as in a design file ("400 mm",
/// "11deg"). An angle needs its unit.
/// @param name  the option, for messages
/// @return SI, radians
/// @throws InputError if it is neither
[[nodiscard]] double option_value(const std::string& text, Dimension dimension, const std::string& name);

/// Calls `make`; what it throws names the option.
template <typename Make>
auto at_option(const std::string& option, Make&& make) {
  try {
    return std::forward<Make>(make)();
  } catch (const InputError& error) {
    Issue issue = error.issues().front();
    if (issue.where.empty() && !issue.what.starts_with(option)) issue.where = option;
    throw InputError(issue);
  }
}

}  // namespace glissade::app
