#include "glissade/centerline/constant_speed_curve.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/io/atomic_file.hpp"
#include "glissade/pipeline.hpp"

#include "app/command_line.hpp"
#include "app/console.hpp"
#include "app/json.hpp"
#include "app/option_value.hpp"
#include "app/summary.hpp"
#include "app/table.hpp"
#include "app/track_input.hpp"

#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

namespace glissade::app {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kDescription =
    "Put every kind of centerline between the same two points side by side.\n"
    "\n"
    "With --friction-sweep: the constant-speed curve (Pudasaini's) over a list of friction angles, as in\n"
    "figure 1 of his paper, beside the fastest track and the straight line.";

constexpr const char* kFooter =
    "Examples:\n"
    "  glissade compare designs/grain_chute.yaml\n"
    "  glissade compare --run 10 --drop 5 --friction-coefficient 0.2 --json\n"
    "  glissade compare --run 2.5 --drop 2.5 --p 100 --friction-sweep "
    "11deg,13deg,15deg,17deg,20deg,25deg,40deg\n"
    "  glissade compare designs/grain_chute.yaml --csv curves.csv      the curves themselves";

struct Options {
  TrackInput input{TrackInput::Scope::every_kind};
  std::vector<std::string> frictions;
  std::string csv;
  bool json = false;
};

/// One line of a comparison: a track, or why there is none.
struct Entry {
  Design design;
  std::optional<Track> track;
  std::string problem;
};

Entry entry_of(Design design, const std::function<Track(const Design&)>& make) {
  Entry entry{std::move(design), {}, {}};
  try {
    entry.track = make(entry.design);
  } catch (const InputError& error) {
    entry.problem = error.issues().front().what;
  } catch (const InfeasibleError& error) {
    entry.problem = error.issues().front().what;
  } catch (const ConvergenceError& error) {
    entry.problem = error.issues().front().what;
  }
  return entry;
}

Design of_kind(Design design, CenterlineKind kind) {
  design.centerline.kind = kind;
  return design;
}

std::vector<CenterlineKind> kinds_for(const Design& design) {
  std::vector<CenterlineKind> kinds = {CenterlineKind::fastest, CenterlineKind::constant_speed,
                                       CenterlineKind::straight, CenterlineKind::cycloid,
                                       CenterlineKind::no_curvature_load};
  const CenterlineKind own = design.centerline.kind;
  if (own == CenterlineKind::segments || own == CenterlineKind::points) kinds.insert(kinds.begin(), own);
  return kinds;
}

std::string ride_text(const Motion& motion) {
  if (motion.arrived()) return time_text(motion.travel_time());
  return motion.stall() ? "stalls" : "lifts off";
}

std::string exit_text(const Motion& motion) {
  return motion.arrived() ? speed_text(motion.exit_speed()) : "-";
}

std::string kinds_table(const std::vector<Entry>& entries) {
  Table table({"Centerline", "travel time", "above least", "exit speed", "steepest", "highest load",
               "arc length", "least radius"});
  for (const Entry& entry : entries) {
    const std::string kind(word(entry.design.centerline.kind));
    if (!entry.track) {
      table.add({kind, entry.problem});
      continue;
    }
    const Track& track = *entry.track;
    const Motion& motion = track.motion;
    std::string excess = "-";
    if (motion.arrived() && track.optimum_travel_time) {
      const double percent = 100.0 * (motion.travel_time() / *track.optimum_travel_time - 1.0);
      excess = rounded_text(std::round(percent * 100.0) / 100.0, 4) + " %";
    }
    table.add({kind, ride_text(motion), excess, exit_text(motion), angle_text(track.steepest_slope_angle, 3),
               rounded_text(motion.highest_load().normal_load, 4) + " m/s^2",
               length_text(track.centerline->length()),
               std::isinf(track.min_radius) ? "straight" : length_text(track.min_radius, 3)});
  }
  return table.text();
}

std::string sweep_table(const std::vector<Entry>& entries) {
  Table table({"Friction angle", "P", "slope at start", "at finish", "arc length", "at constant speed",
               "from rest", "fastest track", "straight line"});
  for (const Entry& entry : entries) {
    const std::string angle = angle_text(entry.design.body.friction.angle().radians());
    if (!entry.track) {
      table.add({angle, entry.problem});
      continue;
    }
    const Track& track = *entry.track;
    const auto& curve = dynamic_cast<const ConstantSpeedCurve&>(*track.centerline);
    table.add({angle, rounded_text(curve.p(), 4) + " m^2/s^2",
               angle_text(curve.entry_slope_angle().radians()),
               angle_text(curve.exit_slope_angle().radians()), length_text(curve.length()),
               time_text(curve.travel_time_at_constant_speed()), ride_text(track.motion),
               track.optimum_travel_time ? time_text(*track.optimum_travel_time) : "none arrives",
               track.straight ? ride_text(*track.straight) : "stalls"});
  }
  return table.text();
}

/// Every curve as points, for a plotting program.
std::string curves_csv(const std::vector<Entry>& entries) {
  constexpr int kPoints = 200;
  Table table({"centerline", "friction_angle_deg", "arc_length_m", "run_m", "drop_m", "slope_angle_deg"});
  for (const Entry& entry : entries) {
    if (!entry.track) continue;
    const Centerline& centerline = *entry.track->centerline;
    for (int index = 0; index <= kPoints; ++index) {
      // Crowded towards the start, where the curves bend most.
      const double part = static_cast<double>(index) / kPoints;
      const CenterlinePoint point = centerline.at(centerline.length() * part * part);
      table.add({std::string(word(entry.design.centerline.kind)),
                 exact_text(entry.design.body.friction.angle().degrees()), exact_text(point.arc_length),
                 exact_text(point.x), exact_text(point.drop),
                 exact_text(Angle::from_radians(point.slope_angle).degrees())});
    }
  }
  return table.csv();
}

Json comparison_json(const Design& design, const std::vector<Entry>& entries) {
  Json json = input_json(design);
  json["tracks"] = Json::array();
  for (const Entry& entry : entries) {
    if (entry.track) {
      Json track = track_json(entry.design, *entry.track);
      track["problem"] = nullptr;
      json["tracks"].push_back(std::move(track));
    } else {
      json["tracks"].push_back({{"centerline", word(entry.design.centerline.kind)},
                                {"friction_angle_deg", entry.design.body.friction.angle().degrees()},
                                {"problem", entry.problem}});
    }
  }
  return json;
}

std::vector<Friction> frictions_of(const std::vector<std::string>& texts) {
  std::vector<Friction> frictions;
  for (const std::string& text : texts) {
    frictions.push_back(
        Friction::from_angle(Angle::from_radians(option_value(text, Dimension::angle, "--friction-sweep"))));
  }
  return frictions;
}

std::vector<Entry> sweep(const Design& design, const std::vector<Friction>& frictions) {
  std::vector<Entry> entries;
  for (const Friction friction : frictions) {
    Design swept = of_kind(design, CenterlineKind::constant_speed);
    swept.body.friction = friction;
    // The curve is there whether or not a body from rest arrives on it.
    entries.push_back(
        entry_of(std::move(swept), [](const Design& one) { return ride(one, make_centerline(one)); }));
  }
  return entries;
}

std::vector<Entry> every_kind(const Design& design) {
  std::vector<Entry> entries;
  for (const CenterlineKind kind : kinds_for(design)) {
    entries.push_back(entry_of(of_kind(design, kind), [](const Design& one) { return solve(one); }));
  }
  return entries;
}

ExitCode compare(const Options& options) {
  const std::vector<Friction> frictions = frictions_of(options.frictions);
  const Design design =
      options.input.design(frictions.empty() ? std::nullopt : std::optional(frictions.front()));
  const std::vector<Entry> entries = frictions.empty() ? every_kind(design) : sweep(design, frictions);
  if (!options.csv.empty()) {
    AtomicFile file(options.csv);
    file.write(curves_csv(entries));
    file.commit();
  }
  if (options.json) {
    print(document(comparison_json(design, entries)));
    return ExitCode::done;
  }
  const std::string heading = design.name.empty() ? std::string("Comparison") : design.name;
  const std::string task = frictions.empty() ? task_line(design, endpoints_of(design))
                                             : span_line(design, endpoints_of(design)) + ", constant-speed";
  print(emphasised(heading, Emphasis::heading) + "\n  " + task + "\n\n" +
        (frictions.empty() ? kinds_table(entries) : sweep_table(entries)));
  return ExitCode::done;
}

}  // namespace

void add_compare(CLI::App& program, Action& action) {
  CLI::App& command = *program.add_subcommand("compare", kDescription)->footer(kFooter);
  const auto options = std::make_shared<Options>();
  options->input.add_to(command);
  command
      .add_option("--friction-sweep", options->frictions,
                  "Friction angles with their unit, separated by commas: 11deg,13deg")
      ->type_name("ANGLES")
      ->delimiter(',')
      ->group("Options");
  command.add_option("--csv", options->csv, "Write the curves as points, one line each")
      ->type_name("FILE")
      ->group("Options");
  command.add_flag("--json", options->json, "Print one JSON object with SI values instead of the table");
  command.callback([options, &action] { action = [options] { return compare(*options); }; });
}

}  // namespace glissade::app
