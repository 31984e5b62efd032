#include "glissade/trades/ski_jump/gates.hpp"

#include "glissade/centerline/track_from.hpp"
#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <string>

namespace glissade {
namespace {

void require_area(double length, double start_area) {
  if (length > 0.0 && start_area >= 0.0 && start_area < length) return;
  throw InputError(
      {"start_area",
       "the start area, " + length_text(start_area) + ", does not fit an in-run of " + length_text(length),
       "Gates lie between the start of the track and its edge.", "a shorter start area"});
}

Gate gate_at(int number, double from_start, double length) {
  return {number, from_start, length - from_start};
}

/// The highest kappa u^2: sampled between the breaks, both sides of each, then narrowed down by golden sections.
void add_radial(const Motion& motion, double from_start, GateRide& ride) {
  constexpr int kSamples = 16;
  constexpr double kGolden = 0.6180339887498949;
  const std::vector<double> breaks = motion.centerline().breaks();
  const auto see = [&](double s) {
    const double radial =
        motion.at(s).normal_load - motion.gravity() * math::cos(motion.centerline().slope_angle(s));
    if (radial > ride.highest_radial) {
      ride.highest_radial = radial;
      ride.highest_radial_at = from_start + s;
    }
    return radial;
  };
  for (std::size_t i = 1; i < breaks.size() && breaks[i - 1] < motion.distance(); ++i) {
    const double end = std::nextafter(std::min(breaks[i], motion.distance()), 0.0);
    const double step = (end - breaks[i - 1]) / kSamples;
    int best = 0;
    double highest = see(breaks[i - 1]);
    for (int k = 1; k <= kSamples; ++k) {
      const double here = see(k == kSamples ? end : breaks[i - 1] + step * k);
      if (here > highest) best = k;
      highest = std::max(highest, here);
    }
    if (highest < ride.highest_radial || !(highest > 0.0)) continue;
    double low = breaks[i - 1] + step * std::max(best - 1, 0);
    double high = best >= kSamples - 1 ? end : breaks[i - 1] + step * (best + 1);
    constexpr int kRounds = 40;  // a peak is flat: its value is known long before its place
    for (int round = 0; round < kRounds; ++round) {
      const double left = high - kGolden * (high - low);
      const double right = low + kGolden * (high - low);
      if (see(left) > see(right)) {
        high = right;
      } else {
        low = left;
      }
    }
  }
}

GateRide ridden(const CenterlinePtr& track, const Gate& gate, const Body& body, double measuring_place,
                double gravity) {
  const Motion motion = ride_from(track, gate.from_start, body, gravity);
  GateRide ride;
  ride.gate = gate;
  ride.arrived = motion.arrived();
  const MotionState heaviest = motion.highest_load();
  ride.highest_load = heaviest.normal_load;
  ride.highest_load_at = gate.from_start + heaviest.arc_length;
  ride.lowest_load = motion.lowest_load().normal_load;
  add_radial(motion, gate.from_start, ride);
  if (!ride.arrived) return ride;
  ride.travel_time = motion.travel_time();
  ride.speed_at_edge = motion.exit_speed();
  const double place = std::clamp(gate.to_edge - measuring_place, 0.0, motion.distance());
  ride.speed_at_measuring_place = motion.at(place).speed;
  if (place > 0.0) ride.slopes = speed_slopes(track, gate.from_start, gate.from_start + place, body, gravity);
  return ride;
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
  constexpr double kMost = 1e5;
  constexpr double kRounding = 1e-9;
  const double steps = std::floor(start_area / step * (1.0 + kRounding));
  if (!(step > 0.0) || !(steps < kMost)) {
    throw InputError(
        {"step", "step: " + length_text(step) + " is out of range",
         "It is above 0, and a start area of " + length_text(start_area) + " holds at most 100 000.", ""});
  }
  std::vector<Gate> gates;
  for (int number = 1; number <= static_cast<int>(steps) + 1; ++number) {
    gates.push_back(gate_at(number, std::max(start_area - (number - 1) * step, 0.0), length));
  }
  return gates;
}

Motion ride_from(const CenterlinePtr& track, double from_start, const Body& body, double gravity) {
  if (from_start == 0.0) return Motion(track, body, gravity);
  Body shifted = body;
  shifted.friction_changes.clear();
  for (const FrictionChange& change : body.friction_changes) {
    if (change.from > from_start) {
      shifted.friction_changes.push_back({change.from - from_start, change.friction});
    } else {
      shifted.friction = change.friction;
    }
  }
  return Motion(std::make_shared<const TrackFrom>(track, from_start), shifted, gravity);
}

std::vector<GateRide> ride_gates(const CenterlinePtr& track, const std::vector<Gate>& gates, const Body& body,
                                 double measuring_place, double gravity) {
  std::vector<GateRide> rides;
  rides.reserve(gates.size());
  for (const Gate& gate : gates) rides.push_back(ridden(track, gate, body, measuring_place, gravity));
  return rides;
}

std::optional<double> gate_for_speed(const std::vector<GateRide>& rides, double speed) {
  for (std::size_t i = 0; i < rides.size(); ++i) {
    if (rides[i].arrived && rides[i].speed_at_measuring_place == speed) return rides[i].gate.number;
    if (i == 0 || !rides[i].arrived || !rides[i - 1].arrived) continue;
    const double below = rides[i - 1].speed_at_measuring_place;
    const double above = rides[i].speed_at_measuring_place;
    if ((speed - below) * (speed - above) >= 0.0) continue;
    return rides[i - 1].gate.number + (speed - below) / (above - below);
  }
  return {};
}

}  // namespace glissade
