#include "app/help.hpp"

#include <algorithm>
#include <cstddef>

#include <CLI/CLI.hpp>

namespace glissade::app {
namespace {

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

/// @param name_column  where names begin: options of one letter stand before those of a word
std::string section(const std::string& heading, const HelpPage::Entries& entries) {
  if (entries.empty()) return "";
  std::string text = "\n" + heading + ":\n";
  for (const auto& [name, description] : entries) {
    std::string line = name.starts_with("--") ? "      " + name : "  " + name;
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
  for (const std::string& word : option.get_lnames()) name += "--" + word;
  if (!option.get_type_name().empty()) name += " " + option.get_type_name();
  return name;
}

/// The entries of a group of options, made where there is none of that heading yet.
HelpPage::Entries& group_of(HelpPage& page, const std::string& heading) {
  const auto known = std::find_if(page.options.begin(), page.options.end(),
                                  [&](const auto& group) { return group.first == heading; });
  return known != page.options.end() ? known->second
                                     : page.options.emplace_back(heading, HelpPage::Entries{}).second;
}

}  // namespace

bool is_hidden(const CLI::App& command) {
  return command.get_group().empty();
}

HelpPage help_page(const CLI::App& command) {
  HelpPage page;
  page.name = full_name(command);
  page.usage = page.name;
  page.description = command.get_description();
  page.footer = command.get_footer();
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_positional()) {
      const std::string name = option->get_type_name();
      page.usage += option->get_required() ? " " + name : " [" + name + "]";
      page.arguments.emplace_back(name, option->get_description());
    } else {
      group_of(page, option->get_group()).emplace_back(option_name(*option), option->get_description());
    }
  }
  for (const CLI::App* subcommand : command.get_subcommands([](const CLI::App*) { return true; })) {
    if (is_hidden(*subcommand)) continue;
    page.commands.emplace_back(subcommand->get_name(), first_sentence(subcommand->get_description()));
  }
  page.usage += page.commands.empty() ? " [OPTIONS]" : " COMMAND [OPTIONS]";
  return page;
}

std::string first_sentence(std::string_view description) {
  std::size_t end = std::min(description.find("\n\n"), description.size());
  for (const std::string_view stop : {". ", ".\n"}) {
    const std::size_t at = description.substr(0, end).find(stop);
    if (at != std::string_view::npos) end = at + 1;
  }
  std::string sentence(description.substr(0, end));
  std::replace(sentence.begin(), sentence.end(), '\n', ' ');
  return sentence;
}

std::string help_text(const CLI::App& command) {
  const HelpPage page = help_page(command);
  std::string text = "Usage: " + page.usage + "\n\n" + page.description + "\n";
  text += section("Commands", page.commands);
  text += section("Arguments", page.arguments);
  for (const auto& [heading, entries] : page.options) text += section(heading, entries);
  if (!page.footer.empty()) text += "\n" + page.footer + "\n";
  return text;
}

}  // namespace glissade::app
