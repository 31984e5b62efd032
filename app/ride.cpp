#include "glissade/core/error.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/pipeline.hpp"
#include "glissade/pipeline/json.hpp"

#include "app/command_line.hpp"
#include "app/console.hpp"
#include "app/option_value.hpp"
#include "app/rides_text.hpp"
#include "app/searched_track.hpp"
#include "app/summary.hpp"
#include "app/time_budget.hpp"
#include "app/track_input.hpp"

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

namespace glissade::app {
namespace {

constexpr const char* kRideDescription =
    "Ride the track of a design at other frictions; the track stays as it is.\n"
    "\n"
    "The track is found once, at the design's own friction, as 'glissade solve' finds it. Each friction "
    "given\n"
    "here then rides that same track: time, speeds, loads, how far it is from a stall, and the limits held\n"
    "against that friction alone. Where friction changes along the track the one given is that of the "
    "start,\n"
    "and the others change by the same angle; one that would leave 0 to 89.994 deg so is refused. A ride "
    "that\n"
    "ends early or breaks a limit is a result: the exit code is 0.";

constexpr const char* kRideFooter =
    "Examples:\n"
    "  glissade ride designs/grain_chute.yaml --friction-angle 14deg,16deg,18deg\n"
    "  glissade ride designs/grain_chute.yaml --friction-coefficient 0.2,0.3,0.4 --json";

struct RideArguments {
  std::string design;
  Overrides overrides;
  std::vector<std::string> angles;
  std::vector<std::string> coefficients;
  TimeBudget time_budget;
  Verbosity verbosity;
  bool json = false;
};

/// What stands between the commas, nothing between two of them included: that is a value missing.
std::vector<std::string> items_of(const std::vector<std::string>& lists) {
  std::vector<std::string> items;
  for (const std::string& list : lists) {
    std::size_t from = 0;
    while (true) {
      const std::size_t comma = std::min(list.find(',', from), list.size());
      items.push_back(list.substr(from, comma - from));
      if (comma == list.size()) break;
      from = comma + 1;
    }
  }
  return items;
}

std::vector<Friction> frictions_of(const RideArguments& options) {
  std::vector<Friction> frictions;
  for (const std::string& text : items_of(options.angles)) {
    frictions.push_back(at_option("--friction-angle", [&] {
      return Friction::from_angle(
          Angle::from_radians(option_value(text, Dimension::angle, "--friction-angle")));
    }));
  }
  for (const std::string& text : items_of(options.coefficients)) {
    frictions.push_back(at_option("--friction-coefficient", [&] {
      return Friction::from_coefficient(option_value(text, Dimension::number, "--friction-coefficient"));
    }));
  }
  if (!frictions.empty()) return frictions;
  throw InputError({"", "no friction is given to ride at",
                    "The design's own friction finds the track; these ride it.",
                    "--friction-angle 14deg,16deg,18deg"});
}

/// Tells of every friction that a track of the design cannot be ridden at.
/// @param length  of the track, or the least that it can have [m]
void require_rideable(const Design& design, const std::vector<Friction>& frictions, double length) {
  std::vector<Issue> issues;
  for (const Friction& friction : frictions) {
    try {
      static_cast<void>(with_friction(design, friction, length));
    } catch (const InputError& error) {
      issues.insert(issues.end(), error.issues().begin(), error.issues().end());
    }
  }
  if (!issues.empty()) throw InputError(std::move(issues));
}

std::string limits_at(const Track& ride) {
  std::string broken;
  for (const LimitCheck& check : ride.limit_checks) {
    if (!check.kept()) broken += (broken.empty() ? "" : ", ") + check.limit.key();
  }
  if (!broken.empty()) return "breaks " + broken;
  return ride.motion.arrived() && enters(ride.motion) ? "limits kept" : "-";
}

std::string rides_summary(const Design& design, const Track& track, const std::vector<Track>& rides) {
  const std::optional<Angle> stall_angle = stall_angle_of(track);
  Table table = rides_table("Friction");
  const auto add = [&](const std::string& name, const Motion& motion, const Track& checked) {
    add_ride(table, name, motion, stall_angle, design.limits ? limits_at(checked) : "");
  };
  const auto angle_of = [](const Motion& motion) { return angle_text(motion.body().friction.angle()); };
  add("found at " + angle_of(track.motion), track.motion, track);
  for (const Track& ride : rides) add(angle_of(ride.motion), ride.motion, ride);
  const std::string heading = design.name.empty() ? std::string("Track") : design.name;
  return emphasised(heading, Emphasis::heading) + "\n  " + task_line(design, track.endpoints) + "\n\n" +
         table.text();
}

ExitCode ride_track(const RideArguments& options) {
  const std::vector<Friction> frictions = frictions_of(options);
  const Design design = read_design(options.design, options.overrides.values());
  // What the shortest track meets need not wait for a search.
  require_rideable(design, frictions, shortest_length_of(design));
  const Track track = searched_track(design, options.verbosity, options.time_budget.seconds());
  require_rideable(design, frictions, track.centerline->length());
  std::vector<Track> rides;
  rides.reserve(frictions.size());
  const Design solved = as_solved(design, track);
  for (const Friction friction : frictions) rides.push_back(ride_at(solved, track.centerline, friction));
  print(options.json ? rides_json(design, track, rides) : rides_summary(design, track, rides));
  require_searched_through(design, track);
  return ExitCode::done;
}

}  // namespace

void add_ride(CLI::App& program, Action& action) {
  CLI::App& command = *program.add_subcommand("ride", kRideDescription)->footer(kRideFooter);
  const auto options = std::make_shared<RideArguments>();
  command.add_option("design", options->design, "Design file")->type_name("DESIGN.yaml")->required();
  command
      .add_option("--friction-angle", options->angles,
                  "Friction angles with their unit, separated by commas: 14deg,16deg")
      ->type_name("ANGLES")
      ->allow_extra_args(false);
  command
      .add_option("--friction-coefficient", options->coefficients,
                  "The same as their tangents, separated by commas: 0.25,0.3")
      ->type_name("NUMBERS")
      ->allow_extra_args(false);
  options->overrides.add_to(command);
  options->time_budget.add_to(command);
  add_json_flag(command, options->json, "the table");
  options->verbosity.add_to(command, "Show no progress");
  command.callback([options, &action] { action = [options] { return ride_track(*options); }; });
}

}  // namespace glissade::app
