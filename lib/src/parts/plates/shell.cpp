#include "parts/plates/shell.hpp"

#include "glissade/core/math.hpp"

#include "core/plane_geometry.hpp"
#include "parts/bodies/body_moments.hpp"
#include "parts/curves/nearest_place.hpp"
#include "parts/plates/plate_unit.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace glissade::parts {
namespace {

/// The one in which a place lies deepest, or nearest to: flats of a hollow are longer than the track that they touch, so that
/// their stretches overlap.
const Straight* straight_at(const std::vector<Straight>& straights, double s) {
  const Straight* best = nullptr;
  double deepest = -std::numeric_limits<double>::infinity();
  for (const Straight& one : straights) {
    const double deep = std::min(s - one.span.from, one.span.to - s);
    if (deep <= deepest) continue;
    deepest = deep;
    best = &one;
  }
  return best;
}

}  // namespace

TrackFrame frame_on(const std::vector<Straight>& straights, const ArcSpline& track, double s) {
  const Straight* const straight = straight_at(straights, s);
  if (straight == nullptr) return frame_at(track, s);
  TrackFrame frame = straight->from;
  frame.at = frame.at + (s - straight->span.from) * straight->stretch * frame.along;
  return frame;
}

TrackFrame frame_of(const Shell& shell, double s) {
  return frame_on(shell.straights, shell.track, s);
}

bool keeps_straight(const Shell& shell, double s, double half, double gap) {
  if (const Straight* const straight = straight_at(shell.straights, s))
    return s - half >= straight->span.from && s + half <= straight->span.to;
  // Above a hollow what lies within the same thickness is on a longer stretch of the track.
  const double reach = 4.0 * half;
  for (const TrackArc& arc : shell.track.arcs()) {
    if (arc.curvature == 0.0 || arc.start > s + reach || arc.start + arc.length < s - reach) continue;
    for (const double height : {shell.lowest, shell.highest}) {
      const double radius = std::fabs(1.0 / arc.curvature - height);
      if (radius <= half || radius - std::sqrt(radius * radius - half * half) > gap) return false;
    }
  }
  return true;
}

bool is_seat(const Shell& shell, const SeatNeed& need, const Span& within, double s) {
  constexpr double kRounding = 1.5e-5;  // of parts that share a number [m]
  return shell.taken.is_free(s, need.taken, within) &&
         keeps_straight(shell, s, need.straight, shell.options.flanges.gap + kRounding);
}

double seat_place(const Span& within, int k) {
  return within.from + (within.to - within.from) * k / kSeats;
}

std::optional<double> best_seat(const Shell& shell, const SeatNeed& need, const Span& within,
                                const std::function<double(double)>& cost) {
  std::optional<double> best;
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k <= kSeats; ++k) {
    const double s = seat_place(within, k);
    const double price = cost(s);
    if (!(price < least) || !is_seat(shell, need, within, s)) continue;
    least = price;
    best = s;
  }
  return best;
}

namespace {

/// The first place from an end of a unit at which a plate square to its straight stands beyond what a frame takes there.
double beyond_frame_on_straights(const Shell& shell, double taken, double end, double sense) {
  constexpr double kStep = 0.5e-3;  // [m]
  const TrackFrame joint = frame_at(shell.track, end);
  double place = end + sense * taken;
  const auto clear = [&] {
    const TrackFrame here = frame_of(shell, place);
    return std::min({dot(here.at - joint.at, sense * joint.along),
                     dot(here.at + shell.highest * here.up - joint.at, sense * joint.along),
                     dot(here.at + shell.lowest * here.up - joint.at, sense * joint.along)}) >= taken;
  };
  while (place > 0.0 && place < shell.track.length() && !clear()) place += sense * kStep;
  return std::clamp(place, 0.0, shell.track.length());
}

}  // namespace

Span between_frames(const Shell& shell, const Span& unit) {
  Span room{std::max(unit.from, shell.whole.from), std::min(unit.to, shell.whole.to)};
  if (!shell.options.flanges.wanted) return room;
  const double taken = shell.options.flanges.along() + kAsideOfFrame;
  if (!shell.straights.empty()) {
    return {std::max(room.from, beyond_frame_on_straights(shell, taken, unit.from, 1.0)),
            std::min(room.to, beyond_frame_on_straights(shell, taken, unit.to, -1.0))};
  }
  return {std::max(room.from, beyond_frame(shell.track, taken, unit.from, 1.0, shell.highest)),
          std::min(room.to, beyond_frame(shell.track, taken, unit.to, -1.0, shell.highest))};
}

std::string unit_suffix(const Shell& shell, std::size_t unit) {
  return shell.units.size() > 1 ? "_" + std::to_string(unit + 1) : "";
}

ShopPart cross_plate(const Shell& shell, const std::string& name, const PlaneRegion& region, double thickness,
                     double s) {
  ShopPart part;
  part.name = name;
  part.material = shell.options.material.name;
  part.density = shell.options.material.density;
  part.thickness = thickness;
  part.body = Prism{region, thickness};
  const TrackFrame frame = frame_of(shell, s);
  part.places = {{in_space(shell.placement, frame.at - 0.5 * thickness * frame.along),
                  across(shell.placement), direction_in_space(shell.placement, frame.up),
                  direction_in_space(shell.placement, frame.along)}};
  FlatPattern pattern;
  pattern.region = region;
  part.pattern = std::move(pattern);
  weigh(part);
  return part;
}

void take_frames(const Shell& shell) {
  const double frame = shell.options.flanges.wanted ? shell.options.flanges.along() : 0.0;
  for (const Span& unit : shell.units) {
    shell.taken.add(unit.from, unit.from + frame);
    shell.taken.add(unit.to - frame, unit.to);
  }
}

bool stand_apart(const StandingPlate& a, const StandingPlate& b) {
  constexpr double kWeldBetween = 2e-3;  // taste: the least that frames and lugs leave each other [m]
  const auto end = [](const StandingPlate& plate, double height) {
    return plate.middle.at + height * plate.middle.up;
  };
  const Vec2 low_a = end(a, a.heights.from);
  const Vec2 high_a = end(a, a.heights.to);
  const Vec2 low_b = end(b, b.heights.from);
  const Vec2 high_b = end(b, b.heights.to);
  if (core::segment_crossing(low_a, high_a, low_b, high_b)) return false;
  const double least = std::min(
      {core::distance_to_segment(low_a, low_b, high_b), core::distance_to_segment(high_a, low_b, high_b),
       core::distance_to_segment(low_b, low_a, high_a), core::distance_to_segment(high_b, low_a, high_a)});
  return least >= a.half + b.half + kWeldBetween;
}

bool all_apart(const StandingPlate& plate, const std::vector<StandingPlate>& others) {
  return std::all_of(others.begin(), others.end(),
                     [&](const StandingPlate& other) { return stand_apart(plate, other); });
}

std::vector<StandingPlate> standing_frames(const Shell& shell) {
  const FlangeOptions& flange = shell.options.flanges;
  if (!flange.wanted) return {};
  const double out = flange.gap + flange.width;
  const double half = 0.5 * flange.along();
  std::vector<StandingPlate> frames;
  for (const Span& unit : shell.units) {
    for (const double sense : {1.0, -1.0}) {
      TrackFrame frame = frame_at(shell.track, sense > 0.0 ? unit.from : unit.to);
      frame.at = frame.at + sense * half * frame.along;
      frames.push_back({frame, half, {shell.lowest - out, shell.highest + (shell.ring ? out : 0.0)}});
    }
  }
  return frames;
}

std::vector<UnitMass> masses_of(const Workshop& workshop, const ArcSpline& track, const Placement& placement,
                                const std::vector<Span>& units) {
  std::vector<UnitMass> masses(units.size());
  const Span whole{0.0, track.length()};
  const Vec3 start = in_space(placement, {});
  for (const ShopPart& part : workshop.parts) {
    const BodyMoments body = moments(part.body);
    for (const Frame& place : part.places) {
      const Vec3 centre = place.to_space(body.centroid);
      const Vec3 away = centre - start;
      const double s = nearest_place(track, whole, {dot(away, along(placement)), away.z}).s;
      std::size_t unit = 0;
      while (unit + 1 < units.size() && s >= units[unit].to) ++unit;
      masses[unit].mass += part.mass;
      masses[unit].moment = masses[unit].moment + part.mass * centre;
    }
  }
  return masses;
}

}  // namespace glissade::parts
