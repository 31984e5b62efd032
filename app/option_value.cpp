#include "app/option_value.hpp"

#include "glissade/core/error.hpp"

#include <charconv>
#include <cmath>
#include <system_error>

#include <CLI/CLI.hpp>

namespace glissade::app {

void add_json_flag(CLI::App& command, bool& json, const std::string& instead) {
  command.add_flag("--json", json, "Print one JSON object with SI values instead of " + instead);
}

double option_value(const std::string& text, Dimension dimension, const std::string& name) {
  double number = 0.0;
  const char* const end = text.data() + text.size();
  const auto [rest, status] = std::from_chars(text.data(), end, number);
  const bool plain = status == std::errc() && rest == end && std::isfinite(number);
  if (plain && dimension != Dimension::angle) return number;
  try {
    return parse_quantity(text, dimension, name);
  } catch (const InputError& error) {
    Issue issue = error.issues().front();
    if (issue.where.empty() && !issue.what.starts_with(name)) issue.where = name;
    throw InputError(issue);
  }
}

}  // namespace glissade::app
