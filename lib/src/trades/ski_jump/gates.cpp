#include "glissade/trades/ski_jump/gates.hpp"

#include "glissade/centerline/track_from.hpp"
#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <boost/math/tools/toms748_solve.hpp>

namespace glissade {
namespace {

void require_area(double length, double start_area) {
  if (length > 0.0 && start_area >= 0.0 && start_area < length) return;
  throw InputError(
      {"start_area",
       "the start area, " + length_text(start_area) + ", does not fit an in-run of " + length_text(length),
       "Gates lie between the start of the track and its edge.", "a shorter start area"});
}

/// How many steps a start area holds.
/// @param key   of the step
/// @param area  its length, or its height [m]
/// @param high  what is said of it: "", or that it is a height
int steps_in(const char* key, double area, const char* high, double step) {
  constexpr double kMost = 1e5;       // taste: more gates than anyone lists
  constexpr double kRounding = 1e-9;  // rounding: of an area that is a sum of steps
  const double steps = std::floor(area / step * (1.0 + kRounding));
  if (!(step > 0.0) || !(steps < kMost)) {
    throw InputError(
        {key, std::string(key) + ": " + length_text(step) + " is out of range",
         "It is above 0, and a start area of " + length_text(area) + high + " holds at most 100 000.", ""});
  }
  return static_cast<int>(steps);
}

/// Each height is that of one place.
void require_falling(const Centerline& track, double start_area) {
  std::vector<double> places = {0.0, start_area};
  const std::vector<double> breaks = track.breaks();
  for (std::size_t i = 1; i < breaks.size() && breaks[i - 1] < start_area; ++i) {
    const double width = std::min(breaks[i], start_area) - breaks[i - 1];
    constexpr int kSamples = 64;  // budget: a bump between them is narrower than any that a gate stands on
    for (int k = 1; k < kSamples; ++k) places.push_back(breaks[i - 1] + width * k / kSamples);
  }
  for (const double s : places) {
    constexpr double kLevel = -1e-12;  // rounding: [rad]
    if (track.slope_angle(s) >= kLevel) continue;
    throw InputError(
        {"vertical_step",
         "vertical_step: the track rises within the start area, " + length_text(s) + " from its start",
         "Gates a step in height apart lie on a track that falls.", "step: 0.7 m, along the track"});
  }
}

/// A gate at an end of the start area within rounding lies there: next to the start of the track, at the start.
Gate gate_at(int number, double from_start, double length) {
  constexpr double kRounding = 1e-12;  // rounding, of the length of the track
  const double place = from_start > kRounding * length ? from_start : 0.0;
  return {number, place, length - place};
}

/// The highest kappa u^2; 0 of a ride that has none above.
void add_radial(const Motion& motion, double from_start, GateRide& ride) {
  const QuantityPeak peak = motion.highest(
      [&](const LawState& at) { return at.normal_load - motion.gravity() * math::cos(at.slope_angle); });
  if (!(peak.value > 0.0)) return;
  ride.highest_radial = peak.value;
  ride.highest_radial_at = from_start + peak.arc_length;
}

GateRide ridden(const CenterlinePtr& track, const Gate& gate, const Body& body, double measuring_place,
                double gravity) {
  const Motion motion = ride_from(track, gate.from_start, body, gravity);
  GateRide ride;
  ride.gate = gate;
  ride.arrived = motion.arrived();
  ride.end = ride_end(motion);
  ride.ended_at = gate.from_start + motion.distance();
  const MotionState heaviest = motion.highest_load();
  ride.highest_load = heaviest.normal_load;
  ride.highest_load_at = gate.from_start + heaviest.arc_length;
  const MotionState lightest = motion.lowest_load();
  ride.lowest_load = lightest.normal_load;
  ride.lowest_load_at = gate.from_start + lightest.arc_length;
  const MotionState fastest = motion.highest_speed();
  ride.highest_speed = fastest.speed;
  ride.highest_speed_at = gate.from_start + fastest.arc_length;
  add_radial(motion, gate.from_start, ride);
  if (!ride.arrived) return ride;
  ride.travel_time = motion.travel_time();
  ride.speed_at_edge = motion.exit_speed();
  if (!passes(gate, measuring_place)) return ride;
  const double place = std::min(gate.to_edge - measuring_place, motion.distance());  // but for rounding
  ride.speed_at_measuring_place = motion.at(place).speed;
  ride.slopes = speed_slopes(track, gate.from_start, gate.from_start + place, body, gravity);
  return ride;
}

void require_passed(const std::vector<Gate>& gates, double measuring_place) {
  if (!(measuring_place >= 0.0)) {
    throw InputError({"measuring_place",
                      "measuring_place: " + length_text(measuring_place) + " is out of range",
                      "It counts back from the edge: 0 or more.", ""});
  }
  double farthest = 0.0;
  for (const Gate& gate : gates) {
    if (passes(gate, measuring_place)) return;
    farthest = std::max(farthest, gate.to_edge);
  }
  if (gates.empty()) return;
  const auto [place, highest] = texts_apart(measuring_place, farthest, length_text);
  throw InputError({"measuring_place",
                    "measuring_place: " + place + " before the edge no ride of this line passes",
                    "The gate farthest from the edge lies " + highest + " before it.", "10 m"});
}

}  // namespace

std::vector<Gate> even_gates(double length, double start_area, int count) {
  require_area(length, start_area);
  if (count < 1) {
    throw InputError({"count", "count: " + std::to_string(count) + " is no number of gates",
                      "There is at least one.", ""});
  }
  std::vector<Gate> gates;
  gates.reserve(static_cast<std::size_t>(count));
  for (int number = 1; number <= count; ++number) {
    const double above = count == 1 ? 0.0 : start_area * (number - 1) / (count - 1);
    gates.push_back(gate_at(number, start_area - above, length));
  }
  return gates;
}

std::vector<Gate> stepped_gates(double length, double start_area, double step) {
  require_area(length, start_area);
  const int steps = steps_in("step", start_area, "", step);
  std::vector<Gate> gates;
  for (int number = 1; number <= steps + 1; ++number) {
    gates.push_back(gate_at(number, start_area - (number - 1) * step, length));
  }
  return gates;
}

std::vector<Gate> gates_by_height(const Centerline& centerline, double start_area, double step) {
  const double length = centerline.length();
  require_area(length, start_area);
  require_falling(centerline, start_area);
  const auto drop = [&](double s) { return centerline.at(s).drop; };
  const double lowest = drop(start_area);
  const int steps = steps_in("vertical_step", lowest, " in height", step);
  std::vector<Gate> gates = {gate_at(1, start_area, length)};
  for (int number = 2; number <= steps + 1; ++number) {
    const double below = gates.back().from_start;
    const double wanted = std::max(lowest - (number - 1) * step, 0.0);
    const auto excess = [&](double s) { return drop(s) - wanted; };
    double place = 0.0;
    if (wanted > 0.0 && excess(below) > 0.0) {
      std::uintmax_t most = 100;
      constexpr int kBits = 50;  // accuracy: of a length along the track
      const auto [left, right] = boost::math::tools::toms748_solve(
          excess, 0.0, below, boost::math::tools::eps_tolerance<double>(kBits), most);
      place = 0.5 * (left + right);
    }
    gates.push_back(gate_at(number, place, length));
  }
  return gates;
}

bool passes(const Gate& gate, double measuring_place) {
  return measuring_place < gate.to_edge;
}

Motion ride_from(const CenterlinePtr& track, double from_start, const Body& body, double gravity) {
  if (from_start == 0.0) return Motion(track, body, gravity);
  return Motion(std::make_shared<const TrackFrom>(track, from_start), body_from(body, from_start), gravity);
}

std::vector<GateRide> ride_gates(const CenterlinePtr& track, const std::vector<Gate>& gates, const Body& body,
                                 double measuring_place, double gravity) {
  require_passed(gates, measuring_place);
  std::vector<GateRide> rides;
  rides.reserve(gates.size());
  for (const Gate& gate : gates) rides.push_back(ridden(track, gate, body, measuring_place, gravity));
  return rides;
}

bool GateTable::has_y() const {
  constexpr double kRounding = 1e-9;  // rounding: of a turn by 180 deg [m]
  return std::any_of(positions.begin(), positions.end(),
                     [](const Vec3& at) { return std::fabs(at.y) > kRounding; });
}

std::optional<double> gate_for_speed(const std::vector<GateRide>& rides, double speed) {
  for (std::size_t i = 0; i < rides.size(); ++i) {
    const std::optional<double> above = rides[i].speed_at_measuring_place;
    if (above == speed) return rides[i].gate.number;
    if (i == 0) continue;
    const std::optional<double> below = rides[i - 1].speed_at_measuring_place;
    if (!above || !below || (speed - *below) * (speed - *above) >= 0.0) continue;
    return rides[i - 1].gate.number + (speed - *below) / (*above - *below);
  }
  return {};
}

}  // namespace glissade
