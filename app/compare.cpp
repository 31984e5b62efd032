#include "glissade/centerline/constant_speed_curve.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/version.hpp"
#include "glissade/io/atomic_file.hpp"
#include "glissade/pipeline.hpp"
#include "glissade/pipeline/json.hpp"
#include "glissade/pipeline/rules.hpp"
#include "glissade/report/figure_page.hpp"

#include "app/command_line.hpp"
#include "app/comparison.hpp"
#include "app/console.hpp"
#include "app/interrupt.hpp"
#include "app/law_text.hpp"
#include "app/limits_text.hpp"
#include "app/option_value.hpp"
#include "app/output_files.hpp"
#include "app/progress_line.hpp"
#include "app/searched_track.hpp"
#include "app/summary.hpp"
#include "app/table.hpp"
#include "app/time_budget.hpp"
#include "app/track_input.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

namespace glissade::app {
namespace {

constexpr const char* kCompareDescription =
    "Put every kind of centerline between the same two points side by side, or several designs.\n"
    "\n"
    "A design with limits shows the fastest track within them beside the fastest without; the others are "
    "held\n"
    "against the limits.\n"
    "\n"
    "With --friction-sweep: the constant-speed curve (Pudasaini's) over a list of friction angles, as in\n"
    "figure 1 of his paper, beside the fastest track and the straight line.";

constexpr const char* kCompareFooter =
    "Examples:\n"
    "  glissade compare designs/grain_chute.yaml\n"
    "  glissade compare --run 10 --drop 5 --friction-coefficient 0.2 --json\n"
    "  glissade compare --run 2.5 --drop 2.5 --p 100 --friction-sweep "
    "11deg,13deg,15deg,17deg,20deg,25deg,40deg\n"
    "  glissade compare designs/grain_chute.yaml --html chute.html     figures too, for a browser or paper\n"
    "  glissade compare designs/marble_run.yaml designs/grain_chute.yaml --svg both.svg\n"
    "  glissade compare designs/hills/garmisch_hs142.yaml designs/hills/kulm_hs235.yaml --html hills.html\n"
    "  glissade compare designs/grain_chute.yaml --csv curves.csv      the curves themselves";

struct CompareArguments {
  TrackInput input{TrackInput::Scope::every_kind};
  std::vector<std::string> frictions;
  std::vector<std::string> others;
  TimeBudget time_budget;
  std::string csv;
  std::string html;
  std::string svg;
  bool json = false;
  Verbosity verbosity;
};

std::string ride_text(const Motion& motion) {
  if (!enters(motion)) return std::string(ride_status(motion));
  if (motion.arrived()) return time_text(motion.travel_time());
  if (motion.law_end()) return std::string(ride_status(motion));
  return motion.stall() ? "stalls" : "lifts off";
}

std::string exit_text(const Motion& motion) {
  return motion.arrived() && enters(motion) ? speed_text(motion.exit_speed()) : "-";
}

/// One row a track; of one that does not exist its name and what is wrong.
/// @param cells  those behind the name
template <typename Cells>
Table table_of(std::vector<std::string> headings, const std::vector<Entry>& entries,
               const std::vector<std::string>& names, const Cells& cells) {
  Table table(std::move(headings));
  for (std::size_t i = 0; i < entries.size(); ++i) {
    std::vector<std::string> row = {names[i]};
    if (entries[i].track) {
      for (std::string& cell : cells(entries[i].design, *entries[i].track)) row.push_back(std::move(cell));
    } else {
      row.push_back(entries[i].problem);
    }
    table.add(std::move(row));
  }
  return table;
}

using Row = std::vector<std::string>;

std::string excess_text(const Track& track) {
  if (!track.motion.arrived() || !enters(track.motion) || !track.optimum_travel_time) return "-";
  const double percent = 100.0 * (track.motion.travel_time() / *track.optimum_travel_time - 1.0);
  return rounded_text(std::round(percent * 100.0) / 100.0 + 0.0, 4) + " %";
}

Table rides_table(const std::string& heading, const std::vector<Entry>& entries,
                  const std::vector<std::string>& names) {
  const bool limited = std::any_of(entries.begin(), entries.end(),
                                   [](const Entry& entry) { return entry.design.limits.has_value(); });
  Row headings = {heading,    "travel time",  "above least", "exit speed",
                  "steepest", "highest load", "arc length",  "least radius"};
  if (limited) headings.emplace_back("limits");
  return table_of(std::move(headings), entries, names, [&](const Design&, const Track& track) {
    Row row = {ride_text(track.motion),
               excess_text(track),
               exit_text(track.motion),
               angle_text(track.steepest_slope_angle, 3),
               enters(track.motion) ? acceleration_text(track.motion.highest_load().normal_load) : "-",
               length_text(track.centerline->length()),
               std::isinf(track.min_radius) ? "straight" : length_text(track.min_radius, 3)};
    if (limited) row.push_back(limits_verdict(track));
    return row;
  });
}

Table kinds_table(const std::vector<Entry>& entries) {
  std::vector<std::string> kinds;
  kinds.reserve(entries.size());
  for (const Entry& entry : entries) kinds.push_back(entry_name(entry));
  return rides_table("Centerline", entries, kinds);
}

/// What a planner chooses hills by.
struct HillFacts {
  explicit HillFacts(const Design& design, const Track& track)
      : lettered(design.centerline.kind == CenterlineKind::in_run),
        r1(lettered ? design.centerline.in_run.r1 : track.min_radius),
        gamma(Angle::from_radians(track.centerline->slope_angle(0.0))),
        alpha(Angle::from_radians(track.centerline->slope_angle(track.centerline->length()))) {
    const std::vector<Judgement> judgements = judge_rules(design, track);
    const auto count = [&](RuleVerdict verdict) {
      return std::count_if(judgements.begin(), judgements.end(),
                           [&](const Judgement& one) { return one.verdict == verdict; });
    };
    fail = count(RuleVerdict::fail);
    warn = count(RuleVerdict::warn);
    if (!track.gates) return;
    const std::vector<GateRide>& rides = track.gates->conditions.front().rides;
    const auto speed = [](const GateRide& ride) {
      return ride.speed_at_measuring_place ? fixed_text(*ride.speed_at_measuring_place, 2) : std::string("-");
    };
    gates = std::to_string(rides.size());
    lowest_gate = speed(rides.front());
    highest_gate = speed(rides.back());
  }

  bool lettered;  ///< it has letters of its own
  double r1;
  Angle gamma;  ///< of any in-run: the slopes that it begins and ends with
  Angle alpha;
  std::ptrdiff_t fail = 0;
  std::ptrdiff_t warn = 0;
  std::string gates = "-";
  std::string lowest_gate = "-";  ///< speed from there [m/s]
  std::string highest_gate = "-";
};

Table hills_table(const std::vector<Entry>& entries) {
  Row headings = {"Hill",   "HS",    "gamma, alpha",   "r1",           "t",    "drop",
                  "length", "gates", "speed by gates", "highest load", "rules"};
  return table_of(std::move(headings), entries, design_names(entries),
                  [](const Design& design, const Track& track) {
                    const HillFacts hill(design, track);
                    return Row{design.hill.size ? length_text(*design.hill.size, 4) : "-",
                               angle_text(hill.gamma, 4) + ", " + angle_text(hill.alpha, 4),
                               length_text(hill.r1, 4),
                               hill.lettered ? length_text(design.centerline.in_run.t, 4) : "-",
                               length_text(track.endpoints.drop, 4),
                               length_text(track.centerline->length(), 5),
                               hill.gates,
                               track.gates ? hill.lowest_gate + " to " + hill.highest_gate + " m/s" : "-",
                               acceleration_text(track.motion.highest_load().normal_load),
                               std::to_string(hill.fail) + " fail, " + std::to_string(hill.warn) + " warn"};
                  });
}

Table designs_table(const std::vector<Entry>& entries) {
  if (are_hills(entries)) return hills_table(entries);
  return rides_table("Design", entries, design_names(entries));
}

/// Hills as a page sorts them: bare numbers, units in the headings.
Table hills_page_table(const std::vector<Entry>& entries) {
  Row headings = {"Hill",
                  "HS [m]",
                  "K [m]",
                  "gamma [deg]",
                  "alpha [deg]",
                  "r1 [m]",
                  "t [m]",
                  "e1 [m]",
                  "drop [m]",
                  "length [m]",
                  "gates",
                  "lowest gate [m/s]",
                  "highest gate [m/s]",
                  "edge [m/s]",
                  "load [g]",
                  "rules failed",
                  "warned"};
  return table_of(std::move(headings), entries, design_names(entries),
                  [](const Design& design, const Track& track) {
                    const HillFacts hill(design, track);
                    const InRunDesign& letters = design.centerline.in_run;
                    const auto given = [](const std::optional<double>& value) {
                      return value ? rounded_text(*value, 6) : "-";
                    };
                    return Row{given(design.hill.size),
                               given(design.hill.construction_point),
                               rounded_text(hill.gamma.degrees(), 5),
                               rounded_text(hill.alpha.degrees(), 5),
                               rounded_text(hill.r1, 5),
                               hill.lettered ? rounded_text(letters.t, 5) : "-",
                               hill.lettered ? rounded_text(letters.longest(), 6) : "-",
                               fixed_text(track.endpoints.drop, 2),
                               fixed_text(track.centerline->length(), 2),
                               hill.gates,
                               hill.lowest_gate,
                               hill.highest_gate,
                               track.motion.arrived() ? fixed_text(track.motion.exit_speed(), 2) : "-",
                               fixed_text(track.motion.highest_load().normal_load / kStandardGravity, 3),
                               std::to_string(hill.fail),
                               std::to_string(hill.warn)};
                  });
}

/// Other designs the same way.
Table designs_page_table(const std::vector<Entry>& entries) {
  if (are_hills(entries)) return hills_page_table(entries);
  Row headings = {"Design",  "travel time [s]", "exit speed [m/s]", "steepest [deg]",   "highest load [g]",
                  "run [m]", "drop [m]",        "arc length [m]",   "least radius [m]", "limits broken"};
  return table_of(std::move(headings), entries, design_names(entries), [](const Design&, const Track& track) {
    const Motion& motion = track.motion;
    const auto broken = std::count_if(track.limit_checks.begin(), track.limit_checks.end(),
                                      [](const LimitCheck& check) { return !check.kept(); });
    const bool there = enters(motion);
    return Row{there && motion.arrived() ? rounded_text(motion.travel_time(), 5) : "-",
               there && motion.arrived() ? rounded_text(motion.exit_speed(), 5) : "-",
               rounded_text(track.steepest_slope_angle.degrees(), 4),
               there ? rounded_text(motion.highest_load().normal_load / kStandardGravity, 4) : "-",
               rounded_text(track.endpoints.run, 5),
               rounded_text(track.endpoints.drop, 5),
               rounded_text(track.centerline->length(), 5),
               std::isfinite(track.min_radius) ? rounded_text(track.min_radius, 5) : "-",
               std::to_string(broken)};
  });
}

std::string entered_text(const Design& design) {
  if (design.feed) return "as fed";
  return design.body.entry_speed > 0.0 ? "from " + speed_text(design.body.entry_speed) : "from rest";
}

Table sweep_table(const std::vector<Entry>& entries) {
  std::vector<std::string> angles;
  angles.reserve(entries.size());
  for (const Entry& entry : entries) angles.push_back(angle_text(entry.design.body.friction.angle()));
  Row headings = {"Friction angle",
                  "P",
                  "slope at start",
                  "at finish",
                  "arc length",
                  "at constant speed",
                  entered_text(entries.front().design),
                  "fastest track",
                  "straight line"};
  return table_of(std::move(headings), entries, angles, [](const Design&, const Track& track) {
    const auto& curve = dynamic_cast<const ConstantSpeedCurve&>(*track.centerline);
    const Body& body = track.motion.body();
    const bool keeps = kept_speed(curve, body).has_value();
    // Where the theory knows the fastest track, one that is not there arrives nowhere.
    const bool knows = is_sliding_point(body) && body.drag_per_metre == 0.0;
    return Row{rounded_text(curve.p(), 4) + " m^2/s^2",
               angle_text(curve.entry_slope_angle()),
               angle_text(curve.exit_slope_angle()),
               length_text(curve.length()),
               keeps ? time_text(curve.travel_time_at_constant_speed()) : "-",
               ride_text(track.motion),
               track.optimum_travel_time ? time_text(*track.optimum_travel_time)
               : knows                   ? "none arrives"
                                         : "-",
               track.straight ? ride_text(*track.straight) : "stalls"};
  });
}

/// Every curve as points, for a plotting program.
std::string curves_csv(const std::vector<Entry>& entries) {
  constexpr int kPoints = 200;
  Table table(
      {"design", "centerline", "friction_angle_deg", "arc_length_m", "run_m", "drop_m", "slope_angle_deg"});
  for (const Entry& entry : entries) {
    if (!entry.track) continue;
    const Centerline& centerline = *entry.track->centerline;
    for (int index = 0; index <= kPoints; ++index) {
      // Crowded towards the start, where the curves bend most.
      const double part = static_cast<double>(index) / kPoints;
      const CenterlinePoint point = centerline.at(centerline.length() * part * part);
      table.add({entry.design.file.string(), entry_name(entry),
                 exact_text(entry.design.body.friction.angle().degrees()), exact_text(point.arc_length),
                 exact_text(point.x), exact_text(point.drop),
                 exact_text(Angle::from_radians(point.slope_angle).degrees())});
    }
  }
  return table.csv();
}

std::string json_of(const CompareArguments& options, const Design& design,
                    const std::vector<Entry>& entries) {
  std::vector<ComparedTrack> tracks;
  for (const Entry& entry : entries) {
    tracks.push_back({entry.design, entry.track ? &*entry.track : nullptr, entry.problem});
  }
  return comparison_json(options.others.empty() ? &design : nullptr, tracks);
}

std::vector<Friction> frictions_of(const std::vector<std::string>& texts) {
  std::vector<Friction> frictions;
  frictions.reserve(texts.size());
  for (const std::string& text : texts) {
    frictions.push_back(
        Friction::from_angle(Angle::from_radians(option_value(text, Dimension::angle, "--friction-sweep"))));
  }
  return frictions;
}

std::vector<Entry> designs_given(const CompareArguments& options, Design first, const RunContext& context) {
  std::vector<Design> designs = {std::move(first)};
  for (const std::string& file : options.others)
    designs.push_back(read_design(file, options.input.overrides()));
  return every_design(std::move(designs), context);
}

/// What is compared with what.
struct Comparison {
  std::string heading;
  std::string task;
  std::vector<Entry> entries;
  Table table;
};

Comparison comparison_of(const CompareArguments& options, const Design& design,
                         const std::vector<Friction>& frictions, const RunContext& context) {
  const std::string heading = design.name.empty() ? std::string("Comparison") : design.name;
  if (!options.others.empty()) {
    std::vector<Entry> entries = designs_given(options, design, context);
    Table table = designs_table(entries);
    return {"Comparison of designs", std::to_string(entries.size()) + " designs, each with its own body",
            std::move(entries), std::move(table)};
  }
  if (!frictions.empty()) {
    std::vector<Entry> entries = friction_sweep(design, frictions);
    Table table = sweep_table(entries);
    return {heading, span_line(design, endpoints_of(design)) + ", constant-speed", std::move(entries),
            std::move(table)};
  }
  std::vector<Entry> entries = every_kind(design, context);
  Table table = kinds_table(entries);
  const Entry& first = entries.front();
  const Endpoints endpoints = first.track ? first.track->endpoints : endpoints_of(design);
  return {heading, task_line(design, endpoints), std::move(entries), std::move(table)};
}

KindsFigures figures_of(const CompareArguments& options, const Design& design,
                        const std::vector<Entry>& entries, const RunContext& context) {
  if (options.svg.empty() && options.html.empty()) return {};
  if (!options.others.empty()) return {design_figures(entries)};
  if (!options.frictions.empty()) return {sweep_figures(entries)};
  return kinds_figures(design, entries, context);
}

std::string page_of(const CompareArguments& options, const Comparison& comparison,
                    const std::vector<Figure>& figures) {
  const bool several = !options.others.empty();
  const Table table = several ? designs_page_table(comparison.entries) : comparison.table;
  const auto& rows = table.rows();
  std::vector<std::string> choices;
  if (several) choices = design_names(comparison.entries);
  return figure_page_html({comparison.heading,
                           comparison.task,
                           figures,
                           {rows.front(), {rows.begin() + 1, rows.end()}},
                           std::move(choices)});
}

void write_files(const CompareArguments& options, const Comparison& comparison,
                 const std::vector<Figure>& figures) {
  using Path = std::filesystem::path;
  OutputFiles files;
  files.make(options.svg, [&](const Path& svg) { write_atomically(svg, figures_svg(figures)); });
  files.make(options.html,
             [&](const Path& page) { write_atomically(page, page_of(options, comparison, figures)); });
  files.make(options.csv, [&](const Path& csv) { write_atomically(csv, curves_csv(comparison.entries)); });
  files.put_in_place();
}

/// @throws ConvergenceError if a search for a track, or for a point of a figure, ended early
void require_all_searched(const std::vector<Entry>& entries, const KindsFigures& figures) {
  for (const Entry& entry : entries) {
    if (entry.track) require_searched_through(entry.design, *entry.track);
  }
  for (const Entry& entry : entries) {
    if (entry.interrupted) throw ConvergenceError({entry.design.where("limits"), entry.problem, "", ""});
  }
  if (!figures.ended_early) return;
  throw ConvergenceError({entries.front().design.file.string(),
                          "a search for the figures over friction ended early: points are missing there",
                          "Each kind that is searched for is searched for at every friction.",
                          hint_to_search_on(figures.interrupted) + ", or no --html and --svg"});
}

ExitCode compare(const CompareArguments& options) {
  const std::vector<Friction> frictions = frictions_of(options.frictions);
  const Design design =
      with_finish(options.input.design(frictions.empty() ? std::nullopt : std::optional(frictions.front())));
  if (!options.others.empty() && !frictions.empty()) {
    throw InputError({"--friction-sweep", "it cannot be combined with several designs", "", ""});
  }
  KindsFigures figures;
  const Comparison comparison = [&] {
    const Interrupt interrupt;
    ProgressLine progress(options.verbosity);
    const RunContext context = interrupt.context(progress.callback(), options.time_budget.seconds());
    Comparison made = comparison_of(options, design, frictions, context);
    figures = figures_of(options, design, made.entries, context);
    return made;
  }();
  const bool files = !(options.svg.empty() && options.html.empty() && options.csv.empty());
  write_and_print([&] { write_files(options, comparison, figures.figures); },
                  options.json ? json_of(options, design, comparison.entries)
                               : emphasised(comparison.heading, Emphasis::heading) + "\n  " +
                                     comparison.task + "\n\n" + comparison.table.text(),
                  files ? kFilesWritten : "");
  require_all_searched(comparison.entries, figures);
  return ExitCode::done;
}

}  // namespace

void add_compare(CLI::App& program, Action& action) {
  CLI::App& command = *program.add_subcommand("compare", kCompareDescription)->footer(kCompareFooter);
  const auto options = std::make_shared<CompareArguments>();
  options->input.add_to(command);
  command
      .add_option("--friction-sweep", options->frictions,
                  "Friction angles with their unit, separated by commas: 11deg,13deg")
      ->type_name("ANGLES")
      ->delimiter(',')
      ->group("Options");
  options->time_budget.add_to(command);
  command.add_option("others", options->others, "More design files: each on its own line, beside the first")
      ->type_name("DESIGN.yaml...");
  command
      .add_option("--html", options->html, "Write a page with figures and the table, for a browser or paper")
      ->type_name("FILE")
      ->group("Options");
  command.add_option("--svg", options->svg, "Write the figures alone")->type_name("FILE")->group("Options");
  command.add_option("--csv", options->csv, "Write the curves as points, one line each")
      ->type_name("FILE")
      ->group("Options");
  add_json_flag(command, options->json, "the table");
  options->verbosity.add_to(command, "Show no progress");
  command.callback([options, &action] { action = [options] { return compare(*options); }; });
}

}  // namespace glissade::app
