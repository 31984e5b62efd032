#include "app/gates_text.hpp"

#include "glissade/core/number_text.hpp"
#include "glissade/core/units.hpp"

#include "app/console.hpp"
#include "app/summary.hpp"

#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace glissade::app {
namespace {

std::string_view word(InRunTransition transition) {
  switch (transition) {
    case InRunTransition::cubic:
      return "a cubic parabola";
    case InRunTransition::circle:
      return "an arc of a circle";
    case InRunTransition::clothoid:
      return "a clothoid";
    case InRunTransition::two_radii:
      return "of two radii";
  }
  return "";
}

/// @return how many decimals tell the places of neighbouring gates apart [m]: two of a hill, more of a small track
int decimals_of_places(const std::vector<Gate>& gates) {
  constexpr int kLeast = 2;           // taste
  constexpr int kMost = 9;            // budget: beyond any track's
  constexpr double kSteps = 10.0;     // taste: of the last decimal, from gate to gate
  constexpr double kRounding = 1e-9;  // rounding: relative, of distances that are a step apart
  int decimals = kLeast;
  double step = 0.01;  // theory: of two decimals
  for (std::size_t i = 1; i < gates.size(); ++i) {
    const double apart = std::fabs(gates[i].to_edge - gates[i - 1].to_edge) * (1.0 + kRounding);
    for (; decimals < kMost && apart < kSteps * step; ++decimals) step /= 10.0;
  }
  return decimals;
}

std::string speeds_text(const GateCondition& condition) {
  const GateRide& lowest = condition.rides.front();
  const GateRide& highest = condition.rides.back();
  const auto from = [](const GateRide& ride) {
    const std::string gate = " from gate " + std::to_string(ride.gate.number);
    if (!ride.arrived) return "does not arrive" + gate;
    return ride.speed_at_measuring_place ? speed_text(*ride.speed_at_measuring_place) + gate
                                         : "does not pass the measuring place" + gate;
  };
  std::string text = condition.name + " (friction " + rounded_text(condition.body.friction.coefficient(), 4) +
                     ", drag " + rounded_text(condition.body.drag_per_metre, 4) + " 1/m";
  if (condition.body.head_wind != 0.0) text += ", head wind " + speed_text(condition.body.head_wind);
  text += "): " + from(lowest);
  return condition.rides.size() == 1 ? text : text + ", " + from(highest);
}

std::string spacing_text(const GateTable& table) {
  if (table.gates.size() < 2) return "one gate";
  const double step = table.gates[1].to_edge - table.gates[0].to_edge;
  return count_text(table.gates.size()) + " gates, " + length_text(step) + " apart along the track, " +
         length_text(table.largest_height_step) + " in height";
}

}  // namespace

std::string in_run_text(const InRun& in_run) {
  const double bend = in_run.table_begins() - in_run.transition_begins();
  return "in-run, the transition " + std::string(word(in_run.shape().transition)) + "\nstraight " +
         length_text(in_run.transition_begins(), 6) + ", transition " + length_text(bend, 6) + ", table " +
         length_text(in_run.length() - in_run.table_begins(), 6);
}

std::string gates_below_place(const GateTable& table) {
  std::vector<int> numbers;
  for (const Gate& gate : table.gates) {
    if (!passes(gate, table.measuring_place)) numbers.push_back(gate.number);
  }
  if (numbers.empty()) return "";
  const std::string which = numbers.size() == 1 ? "gate " + std::to_string(numbers.front())
                                                : "gates " + std::to_string(numbers.front()) + " to " +
                                                      std::to_string(numbers.back());
  return "From " + which +
         " no body passes the measuring place: " + (numbers.size() == 1 ? "it lies" : "they lie") +
         " no more than " + length_text(table.measuring_place) + " before the edge.";
}

std::string gates_lines(const Track& track) {
  if (!track.gates) return "";
  const GateTable& table = *track.gates;
  std::string text =
      spacing_text(table) + "\nspeed " + length_text(table.measuring_place) + " before the edge";
  for (const GateCondition& condition : table.conditions) text += "\n" + speeds_text(condition);
  if (const std::string below = gates_below_place(table); !below.empty()) text += "\n" + below;
  return labelled("Gates", text);
}

Table slopes_table(const GateTable& table) {
  std::vector<std::string> headings = {"gate"};
  for (const GateCondition& condition : table.conditions) {
    const std::string name = table.conditions.size() > 1 ? condition.name + " " : "";
    headings.push_back(name + "per 0.01 of friction [m/s]");
    headings.emplace_back("per 0.0001 1/m of drag");
    headings.emplace_back("per m of in-run");
  }
  Table text(std::move(headings));
  constexpr double kFriction = 0.01;
  constexpr double kDrag = 1e-4;  // [1/m]
  for (std::size_t i = 0; i < table.gates.size(); ++i) {
    std::vector<std::string> row = {std::to_string(table.gates[i].number)};
    for (const GateCondition& condition : table.conditions) {
      const GateRide& ride = condition.rides[i];
      if (!ride.slopes) {
        row.insert(row.end(), 3, "-");
        continue;
      }
      for (const double value :
           {kFriction * ride.slopes->by_friction, kDrag * ride.slopes->by_drag, ride.slopes->by_length}) {
        row.push_back(fixed_text(value, 3));
      }
    }
    text.add(std::move(row));
  }
  return text;
}

Table gates_table(const GateTable& table) {
  std::vector<std::string> headings = {"gate", "to edge [m]", "x [m]"};
  if (table.has_y()) headings.emplace_back("y [m]");
  headings.emplace_back("z [m]");
  for (const GateCondition& condition : table.conditions) {
    const std::string name = table.conditions.size() > 1 ? condition.name + " " : "";
    headings.push_back(name + "v [m/s]");
    for (const char* const column : {"[km/h]", "edge [m/s]", "t [s]", "load [g]"})
      headings.emplace_back(column);
  }
  Table text(std::move(headings));
  const int finest = decimals_of_places(table.gates);
  for (std::size_t i = 0; i < table.gates.size(); ++i) {
    std::vector<std::string> row = {std::to_string(table.gates[i].number)};
    const Vec3 at = table.positions[i];
    row.push_back(fixed_text(table.gates[i].to_edge, finest));
    row.push_back(fixed_text(at.x, finest));
    if (table.has_y()) row.push_back(fixed_text(at.y, finest));
    row.push_back(fixed_text(at.z, finest));
    for (const GateCondition& condition : table.conditions) {
      const GateRide& ride = condition.rides[i];
      const auto told = [&](double value, int decimals) {
        return ride.arrived ? fixed_text(value, decimals) : std::string("-");
      };
      constexpr double kKilometresPerHour = 3.6;
      const std::optional<double>& measured = ride.speed_at_measuring_place;
      row.push_back(measured ? fixed_text(*measured, 2) : "-");
      row.push_back(measured ? fixed_text(*measured * kKilometresPerHour, 1) : "-");
      row.push_back(told(ride.speed_at_edge, 2));
      row.push_back(told(ride.travel_time, 2));
      row.push_back(fixed_text(ride.highest_load / kStandardGravity, 2));
    }
    text.add(std::move(row));
  }
  return text;
}

}  // namespace glissade::app
