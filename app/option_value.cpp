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

std::vector<Issue> with_directory_option(std::vector<Issue> issues, const std::string& option) {
  const std::string advice = "another directory";
  for (Issue& issue : issues) {
    const bool advised = issue.hint == advice || issue.hint.starts_with(advice + ",");
    if (advised) issue.hint.insert(advice.size(), " with " + option);
  }
  return issues;
}

}  // namespace glissade::app
