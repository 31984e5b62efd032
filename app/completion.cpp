#include "app/completion.hpp"

#include "glissade/core/file_format.hpp"
#include "glissade/design/design.hpp"
#include "glissade/design/rule_sets.hpp"
#include "glissade/design/schema.hpp"
#include "glissade/design/template.hpp"
#include "glissade/report/ride_figure.hpp"

#include <algorithm>
#include <cstddef>
#include <string_view>
#include <utility>

#include <CLI/CLI.hpp>

namespace glissade::app {
namespace {

/// Words with what each means, in the order in which they are offered.
class Offer {
 public:
  explicit Offer(std::string begun) : begun_(std::move(begun)) {}

  /// Everything that is added later stands behind this part of the word.
  void keep(std::string_view part) { kept_ += part; }
  void add(std::string_view word, std::string_view meaning = {}) {
    const std::string whole = kept_ + std::string(word);
    if (!whole.starts_with(begun_)) return;
    text_ += whole;
    if (!meaning.empty()) text_ += "\t" + std::string(meaning.substr(0, meaning.find_first_of("\n")));
    text_ += "\n";
  }
  void add_all(const std::vector<std::string>& words) {
    for (const std::string& word : words) add(word);
  }
  void add_directive(std::string_view directive, std::string_view endings = {}) {
    text_ += ":" + std::string(directive) + (endings.empty() ? "" : "\t" + std::string(endings)) + "\n";
  }

  /// @return what stands of the word behind what is kept
  [[nodiscard]] std::string rest() const { return begun_.substr(std::min(kept_.size(), begun_.size())); }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string begun_;
  std::string kept_;
  std::string text_;
};

std::string mesh_endings() {
  std::string endings;
  for (const FileFormat& format : kFileFormats) {
    const bool is_mesh =
        format.content == FileContent::rounded_mesh || format.content == FileContent::exact_mesh;
    if (!is_mesh || endings.find(format.ending) != std::string::npos) continue;
    endings += (endings.empty() ? "" : " ") + std::string(format.ending);
  }
  return endings;
}

const DesignKey* key_named(const std::vector<DesignKey>& keys, std::string_view path) {
  const auto found =
      std::find_if(keys.begin(), keys.end(), [&](const DesignKey& key) { return key.path == path; });
  return found == keys.end() ? nullptr : &*found;
}

/// Of a list that is separated by commas, what stands before the last item.
std::string_view items_before(std::string_view text) {
  const std::size_t comma = text.find_last_of("[,");
  return comma == std::string_view::npos ? text.substr(0, 0) : text.substr(0, comma + 1);
}

void offer_list(Offer& offer, const std::vector<std::string>& words) {
  const std::string rest = offer.rest();
  const std::string before(items_before(rest));
  offer.keep(before);
  for (const std::string& word : words) {
    const bool there = ("," + before).find("," + word + ",") != std::string::npos ||
                       before.find("[" + word + ",") != std::string::npos;
    if (!there) offer.add(word);
  }
}

/// KEY=VALUE of a design file.
void offer_key_value(Offer& offer) {
  const std::vector<DesignKey> keys = design_keys();
  const std::string rest = offer.rest();
  const std::size_t sign = rest.find('=');
  if (sign == std::string::npos) {
    for (const DesignKey& key : keys) offer.add(key.path + "=");
    return;
  }
  offer.keep(rest.substr(0, sign + 1));
  const DesignKey* const key = key_named(keys, rest.substr(0, sign));
  if (key == nullptr) return;
  if (!key->list) {
    offer.add_all(key->words);
    return;
  }
  if (offer.rest().empty()) offer.keep("[");
  offer_list(offer, key->words);
}

/// Those that need no design file.
std::vector<std::string> centerline_words() {
  std::vector<std::string> words;
  for (const CenterlineKind kind : centerline_kinds()) {
    if (kind != CenterlineKind::segments && kind != CenterlineKind::points) words.emplace_back(word(kind));
  }
  return words;
}

void offer_commands(Offer& offer, const CLI::App& program) {
  for (const CLI::App* command : program.get_subcommands([](const CLI::App*) { return true; }))
    offer.add(command->get_name(), command->get_description());
}

/// @param command  that the option belongs to
void offer_values(Offer& offer, const CLI::App& program, const CLI::App& command, const CLI::Option& option) {
  const std::string type = option.get_type_name();
  if (type.find("DESIGN") != std::string::npos) {
    if (type.starts_with("WORD")) {
      for (const RuleSet& rules : shipped_rule_sets()) offer.add(rules.name);
    }
    offer.add_directive("files", ".yaml .yml");
  } else if (type == "MESH") {
    offer.add_directive("files", mesh_endings());
  } else if (type == "DIR") {
    offer.add_directive("directories");
  } else if (type.starts_with("FILE") || type == "PATH") {
    offer.add_directive("files");
  } else if (type.starts_with("KEY=")) {
    offer_key_value(offer);
  } else if (type == "KIND" && command.get_name() == "init") {
    for (const DesignTemplate& entry : design_templates()) offer.add(entry.kind, entry.summary);
  } else if (type == "KIND") {
    offer.add_all(centerline_words());
  } else if (type == "LIST") {
    std::vector<std::string> words;
    for (const RideQuantity quantity : ride_quantities()) words.emplace_back(word(quantity));
    offer_list(offer, words);
  } else if (type == "UNIT") {
    offer.add_all({"mm", "m"});
  } else if (type == "WAY") {
    offer.add_all({"sobol", "latin-hypercube", "random"});
  } else if (type == "SHELL") {
    offer.add_all(completed_shells());
  } else if (type == "COMMAND") {
    offer_commands(offer, program);
  }
}

void offer_options(Offer& offer, const CLI::App& command) {
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) offer.add("--" + name, option->get_description());
  }
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_snames()) offer.add("-" + name, option->get_description());
  }
}

/// @return the option that a word names, null if none
const CLI::Option* option_named(const CLI::App& command, const std::string& word) {
  if (word.size() < 2 || word.front() != '-') return nullptr;
  for (const CLI::Option* option : command.get_options()) {
    if (!option->get_positional() && option->check_name(word)) return option;
  }
  return nullptr;
}

bool takes_value(const CLI::Option& option) {
  return option.get_type_size() > 0;
}

/// @param used  how many arguments stand on the line already
const CLI::Option* argument_after(const CLI::App& command, std::size_t used) {
  const CLI::Option* last = nullptr;
  for (const CLI::Option* option : command.get_options()) {
    if (!option->get_positional()) continue;
    last = option;
    if (used-- == 0) return option;
  }
  return last != nullptr && last->get_items_expected_max() > 1 ? last : nullptr;
}

void offer_of_command(Offer& offer, const CLI::App& program, const CLI::App& command,
                      const std::vector<std::string>& words) {
  std::size_t arguments = 0;
  const CLI::Option* waiting = nullptr;  // an option whose value comes next
  for (std::size_t i = 0; i + 1 < words.size(); ++i) {
    const CLI::Option* const option = waiting != nullptr ? nullptr : option_named(command, words[i]);
    if (waiting == nullptr && !words[i].starts_with('-')) ++arguments;
    waiting = option != nullptr && takes_value(*option) ? option : nullptr;
  }
  const std::string& begun = words.back();
  const std::size_t sign = begun.find('=');
  if (waiting != nullptr) {
    offer_values(offer, program, command, *waiting);
  } else if (begun.starts_with("--") && sign != std::string::npos) {
    const CLI::Option* const option = option_named(command, begun.substr(0, sign));
    offer.keep(begun.substr(0, sign + 1));
    if (option != nullptr && takes_value(*option)) offer_values(offer, program, command, *option);
  } else if (begun.starts_with('-')) {
    offer_options(offer, command);
  } else if (const CLI::Option* const argument = argument_after(command, arguments)) {
    offer_values(offer, program, command, *argument);
  }
}

}  // namespace

std::string completions(const CLI::App& program, const std::vector<std::string>& words) {
  const std::vector<std::string> line = words.empty() ? std::vector<std::string>{""} : words;
  Offer offer(line.back());
  const auto given = std::find_if(line.begin(), line.end() - 1,
                                  [](const std::string& word) { return !word.starts_with('-'); });
  if (given == line.end() - 1) {
    if (line.back().starts_with('-')) {
      offer_options(offer, program);
    } else {
      offer_commands(offer, program);
    }
    return offer.text();
  }
  for (const CLI::App* command : program.get_subcommands([](const CLI::App*) { return true; })) {
    if (command->get_name() == *given) offer_of_command(offer, program, *command, {given + 1, line.end()});
  }
  return offer.text();
}

}  // namespace glissade::app
