#pragma once

#include "glissade/core/error.hpp"
#include "glissade/core/quantity.hpp"

#include <string>
#include <utility>
#include <vector>

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

/// @return problems with the option that gives the directory where they advise another one: "another directory with -d, or free
///         space"
[[nodiscard]] std::vector<Issue> with_directory_option(std::vector<Issue> issues, const std::string& option);

/// Calls `make`, which writes into a directory; what it throws names the option for another one.
template <typename Make>
auto into_directory_of(const std::string& option, Make&& make) {
  try {
    return std::forward<Make>(make)();
  } catch (const FileError& error) {
    throw FileError(with_directory_option(error.issues(), option));
  } catch (const InputError& error) {
    throw InputError(with_directory_option(error.issues(), option));
  }
}

}  // namespace glissade::app
