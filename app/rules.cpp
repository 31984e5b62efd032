#include "glissade/pipeline/rules.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/words.hpp"
#include "glissade/design/rule_sets.hpp"
#include "glissade/pipeline.hpp"
#include "glissade/pipeline/json.hpp"

#include "app/command_line.hpp"
#include "app/console.hpp"
#include "app/interrupt.hpp"
#include "app/output_files.hpp"
#include "app/progress_line.hpp"
#include "app/rules_text.hpp"
#include "app/searched_track.hpp"
#include "app/time_budget.hpp"
#include "app/track_input.hpp"
#include "app/usage_problem.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace glissade::app {
namespace {

constexpr const char* kRulesDescription =
    "List the rules that tracks can be held against, or hold a design against its rules.\n"
    "\n"
    "Each rule has its bound, its source, and how sure the bound is: those that nobody read in the document\n"
    "itself are marked, and to be checked before anyone relies on them. Given a design, its track is held\n"
    "against its rules and, where it has a fabrication, its parts against those of the shop; the exit code\n"
    "is 1 if a rule fails; advice that is not followed is a warning.";

constexpr const char* kRulesFooter =
    "Examples:\n"
    "  glissade rules                          every rule of every set\n"
    "  glissade rules slide                    those of a set, or that speak of a word\n"
    "  glissade rules --quantities             what rules of your own may bound\n"
    "  glissade rules designs/toboggan_run.yaml --set \"rules={sets: [summer-toboggan]}\"   the verdicts";

struct RulesArguments {
  std::string what;
  Overrides overrides;
  std::string csv;  ///< for the verdicts
  TimeBudget time_budget;
  Verbosity verbosity;
  bool quantities = false;
  bool json = false;
};

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return text;
}

bool speaks_of(const Rule& rule, const std::string& word) {
  const std::vector<std::string> texts = {rule.id, rule.sentence, rule.quantity, rule.source};
  return std::any_of(texts.begin(), texts.end(),
                     [&](const std::string& text) { return lower(text).find(word) != std::string::npos; });
}

/// The sets that a word names, or else the rules in them that speak of it.
std::vector<RuleSet> found(const std::string& given) {
  const std::string word = lower(given);
  std::vector<RuleSet> sets;
  for (RuleSet set : shipped_rule_sets()) {
    if (set.name.find(word) == std::string::npos) {
      std::erase_if(set.rules, [&](const Rule& rule) { return !speaks_of(rule, word); });
    }
    if (!set.rules.empty()) sets.push_back(std::move(set));
  }
  if (!sets.empty()) return sets;
  std::vector<std::string> names;
  for (const RuleSet& set : shipped_rule_sets()) names.push_back(set.name);
  throw InputError({"", "no rule speaks of " + shown(given), "The sets are " + listed(names) + ".",
                    "glissade rules, which lists all; or the path of a design, which ends in .yaml"});
}

ExitCode list_rules(const RulesArguments& options) {
  const std::vector<RuleSet> sets = found(options.what);
  if (options.json) {
    print(rules_json(sets));
    return ExitCode::done;
  }
  std::string text;
  for (const RuleSet& set : sets) {
    text += (text.empty() ? "" : "\n") + emphasised(set.name, Emphasis::heading) + ": " + set.title + "\n";
    for (const Rule& rule : set.rules) text += "\n" + rule_text(rule);
  }
  print(text);
  return ExitCode::done;
}

/// What rules say of a design: of its track, and of what a workshop makes of it.
struct Verdicts {
  Track track;
  std::vector<Judgement> rules;               ///< of the track
  std::shared_ptr<const WorkshopBuild> made;  ///< none of a design without a fabrication

  [[nodiscard]] bool fail() const {
    if (worst(rules) == RuleVerdict::fail) return true;
    return made != nullptr &&
           std::any_of(made->workshop.checks.begin(), made->workshop.checks.end(),
                       [](const ShopCheck& check) { return check.verdict == ShopVerdict::fail; });
  }
};

Verdicts judged(const Design& design, const RulesArguments& options) {
  const Interrupt interrupt;
  ProgressLine progress(options.verbosity);
  const RunContext context = interrupt.context(progress.callback(), options.time_budget.seconds());
  Verdicts verdicts{solve(design, context), {}, nullptr};
  verdicts.rules = judge_rules(design, verdicts.track);
  if (design.fabrication) verdicts.made = assemble(design, verdicts.track, context).fabrication;
  return verdicts;
}

ExitCode judge_design(const RulesArguments& options) {
  const Design design = read_design(options.what, options.overrides.values());
  if (design.rules.in_force.empty() && !design.fabrication) {
    throw InputError({design.where("rules"), "the design has no rules to be held against", "",
                      "rules: {sets: [...]} in it; 'glissade rules' lists the sets"});
  }
  const Verdicts verdicts = judged(design, options);
  std::string text;
  if (options.json) {
    text = verdicts_json(design, verdicts.track, verdicts.rules, verdicts.made.get());
  } else {
    text = emphasised(design.name.empty() ? std::string("Track") : design.name, Emphasis::heading) + "\n";
    if (!verdicts.rules.empty()) text += "\n" + verdicts_table(verdicts.rules);
    if (verdicts.made) text += "\n" + shop_table(verdicts.made->workshop.checks);
  }
  const auto write = [&] {
    OutputFiles files;
    files.make(options.csv,
               [&](const std::filesystem::path& csv) { write_verdicts_csv(csv, verdicts.rules); });
    files.put_in_place();
  };
  write_and_print(write, text, options.csv.empty() ? "" : "The table is written, as " + options.csv + ".");
  print_warnings(warnings(design, verdicts.track, verdicts.made.get()));
  if (verdicts.fail()) return ExitCode::faulty;
  require_searched_through(design, verdicts.track);
  return ExitCode::done;
}

ExitCode list_quantities(const CLI::App& command, const RulesArguments& options) {
  refuse_ignored(command, {"what", "--set", "--csv", "--time-budget"}, "beside --quantities",
                 "What rules may bound is the same for every design and every set.", "--quantities alone");
  print(options.json ? rule_quantities_json() : quantities_table());
  return ExitCode::done;
}

ExitCode run_rules(const CLI::App& command, const RulesArguments& options) {
  if (options.quantities) return list_quantities(command, options);
  if (options.what.ends_with(".yaml") || options.what.ends_with(".yml")) return judge_design(options);
  refuse_ignored(command, {"--set", "--csv", "--time-budget"}, "without a design",
                 "Rules that are listed are held against nothing, and give no verdicts.",
                 "the design that is meant, DESIGN.yaml");
  return list_rules(options);
}

}  // namespace

void add_rules(CLI::App& program, Action& action) {
  CLI::App& command = *program.add_subcommand("rules", kRulesDescription)->footer(kRulesFooter);
  const auto options = std::make_shared<RulesArguments>();
  command
      .add_option("what", options->what, "A word to look for, the name of a set, or a design file (.yaml)")
      ->type_name("WORD|DESIGN.yaml");
  options->overrides.add_to(command);
  options->time_budget.add_to(command);
  command
      .add_option("--csv", options->csv, "Write the verdicts on a design, with source and certainty of each")
      ->type_name("FILE");
  command.add_flag("--quantities", options->quantities, "List what rules may bound, with the unit");
  command.add_flag("--json", options->json, "Print one JSON object with SI values instead");
  options->verbosity.add_to(command, "Show no progress");
  command.callback([options, &action, &command] {
    action = [options, &command] { return run_rules(command, *options); };
  });
}

}  // namespace glissade::app
