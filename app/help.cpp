#include "app/help.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

namespace glissade::app {
namespace {

using Entries = std::vector<std::pair<std::string, std::string>>;

constexpr std::size_t kColumn = 31;
constexpr std::size_t kWidth = 100;

std::string full_name(const CLI::App& command) {
  const CLI::App* parent = command.get_parent();
  return parent == nullptr ? command.get_name() : full_name(*parent) + " " + command.get_name();
}

/// Words of `text` on lines that end before kWidth, each after the first begun at kColumn.
std::string wrapped(const std::string& text) {
  std::string lines;
  std::size_t column = kColumn;
  std::size_t from = 0;
  while (from < text.size()) {
    const std::size_t to = std::min(text.find(' ', from), text.size());
    const std::string word = text.substr(from, to - from);
    if (column != kColumn && column + 1 + word.size() > kWidth) {
      lines += '\n' + std::string(kColumn, ' ');
      column = kColumn;
    } else if (column != kColumn) {
      lines += ' ';
      ++column;
    }
    lines += word;
    column += word.size();
    from = to + 1;
  }
  return lines;
}

std::string section(const std::string& heading, const Entries& entries) {
  if (entries.empty()) return "";
  std::string text = "\n" + heading + ":\n";
  for (const auto& [name, description] : entries) {
    std::string line = "  " + name;
    if (line.size() + 2 > kColumn) {
      line += '\n' + std::string(kColumn, ' ');
    } else {
      line.append(kColumn - line.size(), ' ');
    }
    text += line + wrapped(description) + '\n';
  }
  return text;
}

std::string option_name(const CLI::Option& option) {
  std::string name;
  for (const std::string& letter : option.get_snames()) name += "-" + letter + ", ";
  if (name.empty()) name = "    ";
  for (const std::string& word : option.get_lnames()) name += "--" + word;
  if (!option.get_type_name().empty()) name += " " + option.get_type_name();
  return name;
}

}  // namespace

std::string help_text(const CLI::App& command) {
  const bool is_program = command.get_parent() == nullptr;
  std::string usage = "Usage: " + full_name(command);
  Entries arguments;
  std::vector<std::pair<std::string, Entries>> groups;
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_positional()) {
      const std::string name = option->get_type_name();
      usage += option->get_required() ? " " + name : " [" + name + "]";
      arguments.emplace_back(name, option->get_description());
      continue;
    }
    const std::string& group = option->get_group();
    auto place =
        std::find_if(groups.begin(), groups.end(), [&](const auto& known) { return known.first == group; });
    if (place == groups.end()) place = groups.insert(groups.end(), {group, {}});
    place->second.emplace_back(option_name(*option), option->get_description());
  }
  Entries commands;
  for (const CLI::App* subcommand : command.get_subcommands([](const CLI::App*) { return true; })) {
    commands.emplace_back(subcommand->get_name(),
                          subcommand->get_description().substr(0, subcommand->get_description().find('\n')));
  }

  std::string text = usage + (is_program ? " COMMAND [OPTIONS]\n" : " [OPTIONS]\n") + "\n" +
                     command.get_description() + "\n";
  text += section("Commands", commands);
  text += section("Arguments", arguments);
  for (const auto& [heading, entries] : groups) text += section(heading, entries);
  if (!command.get_footer().empty()) text += "\n" + command.get_footer() + "\n";
  return text;
}

}  // namespace glissade::app
