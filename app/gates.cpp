#include "glissade/core/error.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/io/gates_csv.hpp"
#include "glissade/pipeline.hpp"
#include "glissade/pipeline/json.hpp"

#include "app/command_line.hpp"
#include "app/console.hpp"
#include "app/gates_text.hpp"
#include "app/option_value.hpp"
#include "app/output_files.hpp"
#include "app/searched_track.hpp"
#include "app/summary.hpp"
#include "app/table.hpp"
#include "app/time_budget.hpp"
#include "app/track_input.hpp"
#include "app/usage_problem.hpp"

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace glissade::app {
namespace {

constexpr const char* kGatesDescription =
    "The start gates of a ski jump: where each lies, and the speed, time and load from it in every "
    "condition.";

constexpr const char* kGatesFooter =
    "Examples:\n"
    "  glissade gates designs/hills/garmisch_hs142.yaml\n"
    "  glissade gates designs/hills/garmisch_hs142.yaml --speed 90km/h            the gate for that speed\n"
    "  glissade gates designs/hills/garmisch_hs142.yaml --head-wind-change 1m/s   how many gates make up for "
    "it\n"
    "  glissade gates designs/hills/garmisch_hs142.yaml --slopes                  what friction and drag "
    "cost\n"
    "  glissade gates designs/hills/garmisch_hs142.yaml --csv gates.csv";

struct GatesArguments {
  DesignInput design;
  std::string speed;
  std::string wind_change;
  std::string csv;
  bool slopes = false;
  bool json = false;
  TimeBudget time_budget;
  Verbosity verbosity;
};

/// The speeds at the measuring place, of the gates that have one.
std::vector<double> measured_speeds(const std::vector<GateRide>& rides) {
  std::vector<double> speeds;
  for (const GateRide& ride : rides) {
    if (ride.speed_at_measuring_place) speeds.push_back(*ride.speed_at_measuring_place);
  }
  return speeds;
}

/// Which gate gives a speed, in words, for each condition.
std::string gate_for(const GateTable& table, double speed) {
  std::string text;
  for (const GateCondition& condition : table.conditions) {
    const auto gate = gate_for_speed(condition.rides, speed);
    const std::vector<double> speeds = measured_speeds(condition.rides);
    std::string what = "no gate: no body gets to the edge";
    if (gate) {
      what = "gate " + rounded_text(*gate, 3) + (*gate == std::floor(*gate) ? "" : ", between gates");
    } else if (!speeds.empty()) {
      what = "no gate: they give " + speed_text(speeds.front()) + " to " + speed_text(speeds.back());
    }
    text += (text.empty() ? "" : "\n") + condition.name + ": " + what;
  }
  return labelled("For " + speed_text(speed), text);
}

/// A gate that is ridden to the edge, and past the measuring place, with a wind and without it.
struct BlownGate {
  int number = 1;
  double before = 0.0;  ///< speed at the measuring place [m/s]
  double after = 0.0;   ///< the same with the other wind [m/s]
};

std::vector<BlownGate> blown_gates(const std::vector<GateRide>& before, const std::vector<GateRide>& after) {
  std::vector<BlownGate> gates;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const std::optional<double>& was = before[i].speed_at_measuring_place;
    const std::optional<double>& is = after[i].speed_at_measuring_place;
    if (was && is) gates.push_back({before[i].gate.number, *was, *is});
  }
  return gates;
}

/// How many gates make up for a change of wind: from the middle gate, what the speed loses over what a gate gains.
std::string gates_for_wind(const Design& design, const Track& track, double change) {
  Design blown = design;
  blown.body.head_wind += change;
  for (auto* const condition : {&blown.gates->slow, &blown.gates->fast}) {
    if (*condition && (*condition)->head_wind) *(*condition)->head_wind += change;
  }
  const Track other = ride(blown, track.centerline);
  const std::vector<GateCondition>& conditions = track.gates->conditions;
  std::string text;
  for (std::size_t k = 0; k < conditions.size(); ++k) {
    const std::vector<BlownGate> gates = blown_gates(conditions[k].rides, other.gates->conditions[k].rides);
    text += (text.empty() ? "" : "\n") + conditions[k].name + ": ";
    if (gates.size() < 2) {
      text += "fewer than two gates have a speed at the measuring place";
      continue;
    }
    const BlownGate& middle = gates[gates.size() / 2];
    const double gain = middle.after - middle.before;
    const double per_gate =
        (gates.back().after - gates.front().after) / (gates.back().number - gates.front().number);
    text += (gain < 0.0 ? "-" : "+") + speed_text(std::fabs(gain)) + " from gate " +
            std::to_string(middle.number) + ", " + rounded_text(std::fabs(gain / per_gate), 2) +
            (gain < 0.0 ? " gates higher" : " gates lower") + " make up for it";
  }
  return labelled(std::string(change < 0.0 ? "Tail" : "Head") + " wind +" + speed_text(std::fabs(change)),
                  text);
}

/// What was asked beside the table.
std::string answers(const GatesArguments& options, const Design& design, const Track& track) {
  std::string text;
  if (!options.speed.empty()) {
    text += gate_for(*track.gates, option_value(options.speed, Dimension::speed, "--speed"));
  }
  if (options.wind_change.empty()) return text;
  const double change = option_value(options.wind_change, Dimension::speed, "--head-wind-change");
  if (!(design.body.drag_per_metre > 0.0)) {
    throw InputError({"--head-wind-change", "the body has no drag that a wind could act on", "",
                      "drag: 0.0013 1/m in the body"});
  }
  if (track.gates->gates.size() < 2) {
    throw InputError({"--head-wind-change", "one gate cannot make up for a wind", "", "gates: {count: 20}"});
  }
  return text + gates_for_wind(design, track, change);
}

void require_arrivals(const Design& design, const GateTable& table) {
  for (const GateCondition& condition : table.conditions) {
    for (const GateRide& ride : condition.rides) {
      if (ride.arrived) continue;
      throw InfeasibleError({design.where("gates"),
                             "from gate " + std::to_string(ride.gate.number) + " (" + condition.name +
                                 ") the body does not arrive at the edge",
                             "It stalls, or leaves the track.",
                             "less friction, or a longer in-run below the gates"});
    }
  }
}

ExitCode show_gates(const CLI::App& command, const GatesArguments& options) {
  if (options.json) {
    refuse_ignored(command, {"--speed", "--head-wind-change", "--slopes"}, "beside --json",
                   "The object holds every gate with its speeds and their derivatives, and no answers.",
                   "one of the two");
  }
  const Design design = options.design.read();
  if (!design.gates) {
    throw InputError({design.where("centerline"), "the design has no gates", "",
                      "gates: {count: 49}; with a centerline that is no in-run, their start_area too"});
  }
  const Track track = searched_track(design, options.verbosity, options.time_budget.seconds());
  const std::string asked = answers(options, design, track);
  std::string text;
  if (options.json) {
    text = track_json(design, track);
  } else {
    const std::string heading = design.name.empty() ? std::string("Gates") : design.name;
    const std::string below = gates_below_place(*track.gates);
    text = emphasised(heading, Emphasis::heading) + "\n  speed v " +
           length_text(track.gates->measuring_place) + " before the edge\n\n" +
           (options.slopes ? slopes_table(*track.gates) : gates_table(*track.gates)).text() +
           (below.empty() ? "" : "\n  " + below + "\n") + (asked.empty() ? "" : "\n" + asked);
  }
  const auto write = [&] {
    OutputFiles files;
    files.make(options.csv, [&](const std::filesystem::path& csv) { write_gates_csv(csv, *track.gates); });
    files.put_in_place();
  };
  write_and_print(write, text, options.csv.empty() ? "" : kFilesWritten);
  require_arrivals(design, *track.gates);
  require_searched_through(design, track);
  return ExitCode::done;
}

}  // namespace

void add_gates(CLI::App& program, Action& action) {
  CLI::App& command = *program.add_subcommand("gates", kGatesDescription)->footer(kGatesFooter);
  const auto options = std::make_shared<GatesArguments>();
  options->design.add_to(command);
  command.add_option("--speed", options->speed, "Tell which gate gives this speed at the measuring place")
      ->type_name("SPEED");
  command
      .add_option("--head-wind-change", options->wind_change,
                  "Tell how many gates make up for this much more wind from ahead; less where negative")
      ->type_name("SPEED");
  command.add_option("--csv", options->csv, "Write the table, SI, with the derivatives of the speed")
      ->type_name("FILE");
  command.add_flag("--slopes", options->slopes,
                   "Tell how the speed answers to friction, drag and length of in-run instead");
  add_json_flag(command, options->json, "the table");
  options->time_budget.add_to(command);
  options->verbosity.add_to(command, "Show no progress");
  command.callback([options, &action, &command] {
    action = [options, &command] { return show_gates(command, *options); };
  });
}

}  // namespace glissade::app
