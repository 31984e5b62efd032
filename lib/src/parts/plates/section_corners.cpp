#include "parts/plates/section_corners.hpp"

#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"

#include "parts/plates/corners.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>

namespace glissade::parts {
namespace {

using Meeting = CornerEdge::Meeting;

/// How many plates a plate is away from the floor, or from the nearest of its strips.
std::size_t rank_of(const PlateSection& section, std::size_t plate) {
  const auto count = static_cast<std::size_t>(section.plates.size());
  const auto away_from = [&](std::size_t floor) {
    const std::size_t away = plate > floor ? plate - floor : floor - plate;
    return section.closed ? std::min(away, count - away) : away;
  };
  std::optional<std::size_t> least;
  for (std::size_t i = 0; i < count; ++i) {
    if (section.plates[i].name.starts_with("floor"))
      least = std::min(least.value_or(away_from(i)), away_from(i));
  }
  return least ? *least : away_from(count / 2);
}

/// The numbers of a corner that turns outwards.
struct Turn {
  double over = 0.0;   ///< from the corner along a face to the other plate's far face [m]
  double slant = 0.0;  ///< by how much that is farther back on the far face
  double mitre = 0.0;  ///< from the corner to that of both far faces, along either
  double sine = 0.0;
};

std::optional<Turn> turn_between(const SectionPlate& before, const SectionPlate& after, double thickness) {
  const Vec2 a = before.way();
  const Vec2 b = after.way();
  // The far faces lie to the left: a corner that leaves room for laps there turns to the right.
  const double sine = -cross(a, b);
  const double cosine = dot(a, b);
  // Neither flatter nor, folded back, sharper.
  const double most = math::cos(Angle::from_degrees(kLeastTurn).radians());
  if (!(sine > 0.0) || std::fabs(cosine) > most) return std::nullopt;
  return Turn{thickness / sine, thickness * cosine / sine, thickness * (1.0 - cosine) / sine, sine};
}

/// @param sense  +1 at the end of a plate, -1 at its beginning: outwards
CornerEdge edge_of(bool passes, double corner, double sense, const Turn& turn, const CornerOptions& options) {
  const double slant = -sense * turn.slant;
  const auto at = [&](double outwards, double below) { return Bevel{corner + sense * outwards, below}; };
  CornerEdge edge;
  edge.meeting = passes ? Meeting::passes : Meeting::butts;
  if (!passes) {
    edge.plain = at(0.0, slant);
    edge.out = at(turn.over, slant);
    return edge;
  }
  const double slack = 0.5 * options.clearance / turn.sine;
  edge.plain = at(turn.over, slant);
  edge.out = at(std::max(turn.over, turn.mitre) + options.overlap, 0.0);
  edge.slot_near = at(-slack, slant);
  edge.slot_far = at(turn.over + slack, slant);
  return edge;
}

}  // namespace

std::vector<CorneredPlate> cornered(const PlateSection& section, const PlateOptions& options) {
  const std::size_t count = section.plates.size();
  std::vector<CorneredPlate> plates(count);
  for (std::size_t i = 0; i < count; ++i) {
    const SectionPlate& plate = section.plates[i];
    const Vec2 way = plate.way();
    plates[i].from.plain = {0.0, dot(plate.back_from - plate.face_from, way)};
    plates[i].to.plain = {norm(plate.face_to - plate.face_from), dot(plate.back_to - plate.face_to, way)};
  }
  if (options.corners.kind == CornerJoint::butt) return plates;
  for (std::size_t i = 0; i + (section.closed ? 0 : 1) < count; ++i) {
    const std::size_t next = (i + 1) % count;
    const auto turn = turn_between(section.plates[i], section.plates[next], section.thickness);
    if (!turn) continue;
    const bool outer_passes = options.walls == WallSeat::beside_floor;
    const std::size_t one = rank_of(section, i);
    const std::size_t other = rank_of(section, next);
    const bool first_passes = one == other || (one > other) == outer_passes;
    const double end = norm(section.plates[i].face_to - section.plates[i].face_from);
    plates[i].to = edge_of(first_passes, end, 1.0, *turn, options.corners);
    plates[next].from = edge_of(!first_passes, 0.0, -1.0, *turn, options.corners);
  }
  return plates;
}

namespace {

/// Corners of a stretch of a plate's section.
std::array<Vec2, 4> stretch_of(const SectionPlate& plate, double thickness, const Bevel& from,
                               const Bevel& to) {
  const Vec2 way = plate.way();
  const Vec2 back = thickness * Vec2{-way.y, way.x};
  const auto face = [&](const Bevel& end) { return plate.face_from + end.at * way; };
  const auto below = [&](const Bevel& end) { return plate.face_from + (end.at + end.below) * way + back; };
  return {face(from), face(to), below(to), below(from)};
}

/// @return by how much two convex figures reach into each other; none of those that do not
double reach_into(const std::array<Vec2, 4>& a, const std::array<Vec2, 4>& b) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto* const one : {&a, &b}) {
    for (std::size_t i = 0; i < 4; ++i) {
      const Vec2 side = (*one)[(i + 1) % 4] - (*one)[i];
      if (!(norm(side) > 0.0)) continue;
      const Vec2 normal = (1.0 / norm(side)) * Vec2{-side.y, side.x};
      const auto span = [&](const std::array<Vec2, 4>& figure) {
        double low = dot(figure[0], normal);
        double high = low;
        for (const Vec2 corner : figure) {
          low = std::min(low, dot(corner, normal));
          high = std::max(high, dot(corner, normal));
        }
        return std::pair(low, high);
      };
      const auto [a_low, a_high] = span(a);
      const auto [b_low, b_high] = span(b);
      least = std::min(least, std::min(a_high, b_high) - std::max(a_low, b_low));
    }
  }
  return least;
}

/// Laps that run into another plate.
std::optional<Issue> lap_clash(const PlateSection& section, const PlateOptions& options,
                               const std::vector<CorneredPlate>& plates) {
  constexpr double kTouch = 1e-7;  // [m]
  for (std::size_t i = 0; i < plates.size(); ++i) {
    for (const CornerEdge* const edge : {&plates[i].from, &plates[i].to}) {
      if (edge->meeting != Meeting::passes) continue;
      const auto lap = stretch_of(section.plates[i], section.thickness, edge->plain, edge->out);
      for (std::size_t k = 0; k < plates.size(); ++k) {
        if (k == i) continue;
        const auto end = [](const CornerEdge& one) {
          return one.meeting == Meeting::passes ? one.out : one.plain;
        };
        const auto whole =
            stretch_of(section.plates[k], section.thickness, end(plates[k].from), end(plates[k].to));
        const double reach = reach_into(lap, whole);
        if (reach <= kTouch) continue;
        return Issue{"corners.overlap",
                     "overlap: the lap of the " + section.plates[i].name + " would run " +
                         length_text(reach, 3) + " into the " + section.plates[k].name,
                     "It reaches " + length_text(options.corners.overlap) + " beyond its corner.",
                     "a smaller overlap, walls: " +
                         std::string(options.walls == WallSeat::beside_floor ? "on-floor" : "beside-floor") +
                         ", or corners: butt"};
      }
    }
  }
  return std::nullopt;
}

double largest_turn(const PlateSection& section) {
  double most = 0.0;
  const std::size_t count = section.plates.size();
  for (std::size_t i = 0; i + (section.closed ? 0 : 1) < count; ++i) {
    const Vec2 a = section.plates[i].way();
    const Vec2 b = section.plates[(i + 1) % count].way();
    most = std::max(most, math::atan2(-cross(a, b), dot(a, b)));
  }
  return most;
}

}  // namespace

std::vector<Issue> section_corner_problems(const PlateSection& section, const PlateOptions& options) {
  if (options.corners.kind == CornerJoint::butt) return {};
  const double t = section.thickness;
  if (section.widths) {
    return {{"corners", "corners: plates beside a width that changes meet edge against face",
             "Slots and laps are cut along a corner of one height and one distance from the middle.",
             "corners: butt, or one width"}};
  }
  // Measures of laps, tabs and slots are those of a channel of the same plate.
  std::vector<Issue> issues = corner_problems({1.0, 1.0, t, t}, options);
  if (!issues.empty()) return issues;
  const std::vector<CorneredPlate> plates = cornered(section, options);
  const bool any = std::any_of(plates.begin(), plates.end(), [](const CorneredPlate& plate) {
    return plate.from.meeting != Meeting::mitre || plate.to.meeting != Meeting::mitre;
  });
  if (!any) {
    issues.push_back(
        {"corners",
         "corners: no two plates of this section meet at a corner that could lap: the sharpest "
         "turns outwards by " +
             angle_text(Angle::from_radians(largest_turn(section)), 3),
         "Below " + angle_text(Angle::from_degrees(kLeastTurn), 2) +
             " the plate that ends there would end in a knife edge.",
         section.departure > 0.0 ? "corners: butt, or a larger stave_tolerance" : "corners: butt"});
    return issues;
  }
  if (const auto clash = lap_clash(section, options, plates)) issues.push_back(*clash);
  return issues;
}

}  // namespace glissade::parts
