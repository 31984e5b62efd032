#include "glissade/pipeline/redesign.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/quantity.hpp"
#include "glissade/core/units.hpp"
#include "glissade/core/words.hpp"
#include "glissade/design/write.hpp"
#include "glissade/pipeline/json.hpp"

#include "app/command_line.hpp"
#include "app/console.hpp"
#include "app/interrupt.hpp"
#include "app/limits_text.hpp"
#include "app/option_value.hpp"
#include "app/output_files.hpp"
#include "app/progress_line.hpp"
#include "app/summary.hpp"
#include "app/table.hpp"
#include "app/time_budget.hpp"
#include "app/track_input.hpp"
#include "app/usage_problem.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>

namespace glissade::app {
namespace {

constexpr const char* kRedesignDescription =
    "Compare an in-run with what the rules would allow for the same take-off speed: its letters at the "
    "bounds of\n"
    "the rules, other transitions, and the free shape that a search finds; with metres of tower saved and "
    "the\n"
    "price of each letter.";

constexpr const char* kRedesignFooter =
    "Examples:\n"
    "  glissade redesign designs/hills/garmisch_hs142.yaml\n"
    "  glissade redesign designs/hills/garmisch_hs142.yaml --for least-load      from the same height\n"
    "  glissade redesign designs/hills/garmisch_hs142.yaml --speed 26.5m/s -o lower.yaml\n"
    "  glissade redesign designs/hills/garmisch_hs142.yaml --letters -o letters.yaml   a certificate again";

struct RedesignArguments {
  DesignInput design;
  std::string goal = "least-drop";
  std::string speed;
  std::string rate;
  std::string output;
  bool letters = false;
  bool json = false;
  TimeBudget time_budget;
  Verbosity verbosity;
};

RedesignGoal goal_named(const std::string& text) {
  std::vector<std::string> words;
  for (const RedesignGoal goal : redesign_goals()) {
    if (text == word(goal)) return goal;
    words.emplace_back(word(goal));
  }
  throw InputError(
      {"--for", "'" + text + "' is nothing that an in-run is redesigned for", "", listed(words)});
}

double positive(const std::string& text, Dimension dimension, const char* option) {
  const double value = option_value(text, dimension, option);
  if (value > 0.0) return value;
  throw InputError({option, text + " is not positive", "", "a value above 0"});
}

RedesignOptions wanted(const RedesignArguments& options) {
  RedesignOptions wanted;
  wanted.goal = goal_named(options.goal);
  if (!options.speed.empty()) wanted.speed = positive(options.speed, Dimension::speed, "--speed");
  if (!options.rate.empty())
    wanted.curvature_rate = positive(options.rate, Dimension::per_area, "--curvature-rate");
  return wanted;
}

std::string difference_text(double metres) {
  const std::string text = fixed_text(std::fabs(metres), 2);
  if (text == "0.00") return "0.00";
  return (metres < 0.0 ? "-" : "+") + text;
}

Table shapes_table(const Redesign& found) {
  Table table({"in-run", "drop [m]", "change [m]", "length [m]", "v [m/s]", "load [g]", "v^2/r [g]",
               "growth [1/m^2]"});
  const RedesignShape& certificate = found.shapes.front();
  for (const RedesignShape& shape : found.shapes) {
    if (!shape.problem.empty()) {
      table.add({shape.name, shape.problem});
      continue;
    }
    constexpr double kJump = 1e-6;  // rounding; a bend that begins at full curvature has no rate [1/m]
    const std::string growth =
        std::isfinite(shape.curvature_rate) ? rounded_text(shape.curvature_rate, 3) : "unbounded";
    table.add({shape.name, fixed_text(shape.ends.drop, 2),
               difference_text(shape.ends.drop - certificate.ends.drop), fixed_text(shape.length, 2),
               fixed_text(shape.take_off_speed, 3), fixed_text(shape.highest_load / kStandardGravity, 3),
               fixed_text(shape.highest_radial / kStandardGravity, 3),
               shape.largest_jump > kJump ? "jumps" : growth});
  }
  return table;
}

/// "0.31 m per m"; of the take-off speed both prices, and what they hold
std::string price_words(const LetterPrice& price) {
  const bool angle = price.dimension == Dimension::angle;
  const double value = price.price * (angle ? Angle::from_degrees(1.0).radians() : 1.0);
  const std::string unit = angle ? "deg" : price.dimension == Dimension::speed ? "m/s" : "m";
  const std::string words = rounded_text(value, 3) + " m per " + unit;
  if (!price.price_with_rules) return words;
  std::string letters;
  for (const std::string& letter : price.following) letters += (letters.empty() ? "" : " and ") + letter;
  return words + " with " + letters + " as " + (price.following.size() > 1 ? "they are" : "it is") + ", " +
         rounded_text(*price.price_with_rules, 3) + " with " + letters + " as the rules ask at each speed";
}

std::string prices_text(const Redesign& found) {
  std::string text;
  for (const LetterPrice& price : found.prices) {
    text += (text.empty() ? "" : "\n") + price.letter + " " + quantity_text(price.value, price.dimension) +
            ": " + price_words(price);
    if (!price.rule.empty()) text += ", held by " + price.rule;
    if (price.by_start_area) {
      text += found.start_area > 0.0
                  ? ", held by a straight along the start area, " + length_text(found.start_area)
                  : std::string(", held by the start, which would lie in the bend");
    }
    if (price.certainty && needs_checking(*price.certainty))
      text += " [" + std::string(word(*price.certainty)) + "]";
  }
  return text.empty() ? "" : labelled("Tower for each", text);
}

/// What holds the free shape back, to the beginning of the table.
std::string free_text(const Redesign& found) {
  if (!found.search || found.shapes.back().track == nullptr) return "";
  const bool optimal = found.search->status == OptimizeStatus::optimal;
  std::string text =
      (optimal ? std::string() : emphasised(to_text(found.search->status), Emphasis::bad) + ": ") +
      found.search->message;
  for (const ActiveLimit& active : found.search->active) {
    // Those of the take-off are told with the letters, table included.
    if (active.limit.id == LimitId::exit_slope_angle || active.limit.id == LimitId::exit_speed) continue;
    const std::string_view met = entry_of(active.limit.id).met;
    text += "\n" + active.limit.key() + " " +
            (met.empty() ? quantity_text(active.value, active.limit.dimension()) : std::string(met)) + ": " +
            price_text(active, found.search->objective);
  }
  return labelled("Free shape", text);
}

/// What stands in the way of which shape.
std::string breaks_text(const Redesign& found) {
  std::string text;
  for (const RedesignShape& shape : found.shapes) {
    const std::string line = text.empty() ? "" : "\n";
    if (!shape.breaks.empty()) text += line + shape.name + " does not keep " + listed(shape.breaks);
  }
  return text.empty() ? "" : labelled("In the way", text);
}

/// Which shapes begin to bend where gates lie.
std::string area_text(const Redesign& found) {
  std::string text;
  for (const RedesignShape& shape : found.shapes) {
    if (!shape.short_straight) continue;
    const auto [straight, area] = texts_apart(*shape.short_straight, found.start_area, &length_text);
    text += (text.empty() ? "" : "\n") + shape.name + " is straight over " + straight + ", less than " + area;
  }
  return text.empty() ? "" : labelled("Start area", text);
}

/// What a design that is written is for, and within.
std::string purpose(RedesignGoal goal, bool letters) {
  constexpr const char* kByRules =
      ". It is not held to every rule: `glissade rules` tells which its rides break";
  switch (letters ? RedesignGoal::least_drop : goal) {
    case RedesignGoal::least_load:
      return "for the least load from the same height to the same speed; r1 is free" + std::string(kByRules);
    case RedesignGoal::exit_speed:
      return "for the highest take-off speed from the same height" + std::string(kByRules);
    case RedesignGoal::least_curvature_rate:
      return "for the most gradual bend from the same height to the same speed, within the rules";
    default:
      return "for the same take-off speed within the rules";
  }
}

/// @return what was written
std::string write_design(const RedesignArguments& options, const Design& design, const Redesign& found) {
  const bool is_there =
      options.letters ? found.within_rules.has_value() : found.shapes.back().track != nullptr;
  if (options.output.empty() || !is_there) return "";
  Design made = moved_to(redesigned(design, found, !options.letters), options.output);
  const std::string of = design.name.empty() ? std::string("an in-run") : design.name;
  made.name = of + ", redesigned";
  const char* const which = options.letters               ? "by its letters"
                            : found.shapes.back().letters ? "the best shape that is known"
                                                          : "the shape that a search found";
  OutputFiles files;
  files.set().put(options.output, "# " + of + ", " + which + ",\n# " + purpose(found.goal, options.letters) +
                                      ".\n" + design_text(made));
  files.put_in_place();
  return "The design is written, as " + options.output + ".";
}

std::string table_text(const Design& design, const Redesign& found) {
  const std::string heading = design.name.empty() ? std::string("In-run") : design.name;
  return emphasised(heading, Emphasis::heading) + "\n  take-off speed " + speed_text(found.take_off.speed) +
         ", friction " + rounded_text(found.take_off.body.friction.coefficient(), 4) + ", drag " +
         rounded_text(found.take_off.body.drag_per_metre, 4) + " 1/m\n\n" + shapes_table(found).text() +
         "\n" + prices_text(found) + free_text(found) + breaks_text(found) + area_text(found);
}

/// @param letters  whether those within the rules were asked for
/// @throws ConvergenceError, or InfeasibleError where no free shape, or no letters, keep what is asked for
void require_found(const Design& design, const Redesign& found, bool letters) {
  if (letters && !found.within_rules) {
    Issue none = *found.letters_problem();
    none.where = design.where("centerline");
    throw InfeasibleError(none);
  }
  std::optional<Issue> problem = found.search_problem();
  if (!problem) return;
  problem->where = design.where("centerline");
  if (found.is_infeasible()) throw InfeasibleError(*problem);
  throw ConvergenceError(*problem);
}

ExitCode show_redesign(const CLI::App& command, const RedesignArguments& options) {
  if (options.output.empty()) {
    refuse_ignored(command, {"--letters"}, "without -o", "It chooses which of the two designs is written.",
                   "--letters -o letters.yaml");
  }
  const RedesignOptions asked = wanted(options);
  const Design design = options.design.read();
  const Redesign found = [&] {
    const Interrupt interrupt;
    ProgressLine progress(options.verbosity);
    return redesign(design, asked, interrupt.context(progress.callback(), options.time_budget.seconds()));
  }();
  const std::string kept = write_design(options, design, found);
  print(options.json ? redesign_json(design, found) : table_text(design, found), kept);
  require_found(design, found, options.letters);
  return ExitCode::done;
}

}  // namespace

void add_redesign(CLI::App& program, Action& action) {
  CLI::App& command = *program.add_subcommand("redesign", kRedesignDescription)->footer(kRedesignFooter);
  const auto options = std::make_shared<RedesignArguments>();
  options->design.add_to(command, "Design file, of kind in-run");
  command
      .add_option(
          "--for", options->goal,
          "What the free shape is searched for: least-drop or least-length at the take-off speed; "
          "least-load or least-curvature-rate at that speed and the same drop; exit-speed at the same "
          "drop [default: least-drop]")
      ->type_name("GOAL");
  command
      .add_option("--speed", options->speed,
                  "The take-off speed [default: what the design gives from its highest start]")
      ->type_name("SPEED");
  command
      .add_option("--curvature-rate", options->rate,
                  "How fast the curvature of the free shape may grow [default: as in the certificate's bend]")
      ->type_name("RATE");
  command
      .add_option("-o,--output", options->output,
                  "Write the free shape as a design of kind segments, or in-run if letters make it")
      ->type_name("FILE");
  command.add_flag("--letters", options->letters,
                   "Write the certificate's letters within the rules instead, a design of kind in-run");
  add_json_flag(command, options->json, "the table");
  options->time_budget.add_to(command);
  options->verbosity.add_to(command, "Show no progress");
  command.callback([options, &action, &command] {
    action = [options, &command] { return show_redesign(command, *options); };
  });
}

}  // namespace glissade::app
