// Lugs of sections of any kind: plates across the track, since slings pull them inwards. Their inner edges follow the outside of
// the section from its tops down, or below the rim; their eyes stand above the tops.

#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"

#include "parts/bodies/body_places.hpp"
#include "parts/plates/plate_unit.hpp"
#include "parts/plates/shell.hpp"
#include "parts/plates/shortfalls.hpp"
#include "parts/shop/workshop_list.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

namespace glissade::parts {
namespace {

constexpr double kWide = 80e-3;      // of a lug [m]
constexpr double kEye = 33e-3;       // of an eye's middle above the top, at least [m]
constexpr double kHang = 30e-3;      // above the centre of gravity, that the unit may not turn over [m]
constexpr double kOverEye = 27e-3;   // of a lug, above the eye's middle [m]
constexpr double kGrip = 60e-3;      // along the section's outside [m]
constexpr double kMostGrip = 0.3;    // of the outside's length
constexpr double kDeep = 60e-3;      // from the outside, at the lower end [m]
constexpr double kLugAside = 15e-3;  // from what else stands there [m]
constexpr double kOffFrame = 2e-3;   // of lugs [m]

/// The outside from where a lug begins.
struct Seat {
  ArcPath line;
  double top = 0.0;  ///< above which its eye stands
};

/// On the left. Of rings from where the outside faces half upwards.
Seat seat_of(const Shell& shell, const SectionOutside& outside) {
  ArcPath line = outside.line;
  if (shell.ring) {
    const ArcPath half = left_half(line, 1e-3);
    const double from = 0.25 * length(half);
    return {reversed(first_stretch(reversed(half), length(half) - from)), shell.highest};
  }
  // A side that begins level is the underside of a plate that ends there: its edge goes first.
  const Vec2 first = line.vertices[1].at - line.vertices[0].at;
  const double rise = shell.highest - line.vertices.front().at.y;
  if (std::fabs(first.y) < 1e-9 && rise > 0.0)
    line.vertices.insert(line.vertices.begin(), {line.vertices.front().at + Vec2{0.0, rise}, 0.0});
  return {line, line.vertices.front().at.y};
}

struct LugShape {
  PlaneRegion region;
  Vec2 eye;
};

/// @param eye  height of its middle above the floor line, at least
LugShape lug_on_left(const Shell& shell, const SectionOutside& outside, double eye) {
  const double gap = shell.options.flanges.gap;
  const Seat seat = seat_of(shell, outside);
  const double level_of_eye = std::max(eye, seat.top + kEye);
  const double high = level_of_eye + kOverEye;
  SectionOutside below{seat.line, {}};
  std::vector<Vec2> corners;
  double aside = 0.0;
  if (shell.options.rim && !shell.ring) {
    // Out below the rim and up beside it.
    const RimOptions& rim = *shell.options.rim;
    below = lowered(below, rim.thickness + gap);
    aside = seat.line.vertices.front().at.x + rim.width + gap;
    corners = {{aside, high}, {aside, below.line.vertices.front().at.y}};
  }
  const double grip = std::min(kGrip, kMostGrip * length(outside.line));
  const ArcPath held = first_stretch(below.line, grip);
  // Square to the outside at its lower end.
  const Vec2 end = held.vertices.back().at;
  const Vec2 along = tangent_at(pieces_of(held).back(), 1.0);
  const Vec2 out{-along.y, along.x};
  ArcPath inner = moved_out(held, gap);
  inner.vertices.back().at = end + gap * out;
  if (corners.empty()) {
    aside = inner.vertices.front().at.x;
    corners = {{aside, high}};
  }
  LugShape shape;
  shape.eye = {aside + 0.5 * kWide, level_of_eye};
  ArcPath& outline = shape.region.outline;
  outline.closed = true;
  for (const Vec2 corner : corners) outline.vertices.push_back({corner, 0.0});
  outline.vertices.insert(outline.vertices.end(), inner.vertices.begin(), inner.vertices.end());
  const Vec2 deep = end + (gap + kDeep) * out;
  outline.vertices.push_back({deep, 0.0});
  const double level = std::max(inner.vertices.front().at.y, deep.y);
  outline.vertices.push_back({{aside + kWide, level}, 0.0});
  outline.vertices.push_back({{aside + kWide, high}, 0.0});
  shape.region.holes = {{shape.eye, 0.5 * shell.options.lifting->hole}};
  return shape;
}

PlaneRegion mirrored(PlaneRegion region) {
  for (PathVertex& vertex : region.outline.vertices) {
    vertex.at.x = -vertex.at.x;
    vertex.bulge = -vertex.bulge;
  }
  for (Circle& hole : region.holes) hole.centre.x = -hole.centre.x;
  return region;
}

/// Whether a lug stands clear of the frames at both ends of its unit up to its upper edge: in a hollow that lies above the tops of
/// where it stands, and beside frames all the same.
bool clear_of_frames(const Shell& shell, const Span& unit, const TrackFrame& frame, double top) {
  const FlangeOptions& flange = shell.options.flanges;
  if (!flange.wanted) return true;
  // Its corners lie aside of its middle plane, and there is a weld.
  const double taken = flange.along() + 0.5 * shell.options.lifting->thickness + kOffFrame;
  for (const double sense : {1.0, -1.0}) {
    const TrackFrame joint = frame_at(shell.track, sense > 0.0 ? unit.from : unit.to);
    const Vec2 away = frame.at - joint.at;
    const double rise = dot(frame.up, joint.up);
    const double tops = shell.highest + flange.gap + (shell.ring ? flange.width : 0.0);
    const double above = tops - dot(away, joint.up);
    const double high = rise > 0.0 ? std::min(top, above / rise) : top;
    if (high > 0.0 && sense * dot(away + high * frame.up, joint.along) < taken) return false;
  }
  return true;
}

}  // namespace

void add_lugs(const Shell& shell, const std::vector<StandingPlate>& stiffeners) {
  if (!shell.options.lifting) return;
  const LiftingOptions& lifting = *shell.options.lifting;
  const double half = 0.5 * lifting.thickness;
  const std::vector<UnitMass> masses = masses_of(shell.workshop, shell.track, shell.placement, shell.units);
  UnitsWithoutLugs without;
  for (std::size_t i = 0; i < shell.units.size(); ++i) {
    const Vec3 mean = (1.0 / masses[i].mass) * masses[i].moment - in_space(shell.placement, {});
    const Vec2 centre{dot(mean, along(shell.placement)), mean.z};
    const auto eye_at = [&](const TrackFrame& frame) {
      return std::max(shell.highest + kEye, dot(centre - frame.at, frame.up) + kHang);
    };
    const auto off_plumb = [&](double s) {
      const TrackFrame frame = frame_of(shell, s);
      return std::fabs(frame.at.x + eye_at(frame) * frame.up.x - centre.x);
    };
    const auto cost = [&](double s) {
      const TrackFrame frame = frame_of(shell, s);
      const double top = eye_at(frame) + kOverEye;
      const bool clear = clear_of_frames(shell, shell.units[i], frame, top) &&
                         all_apart({frame, half, {shell.lowest, top}}, stiffeners);
      return clear ? off_plumb(s) : kNoPlace;
    };
    const auto at = best_seat(shell, {half + kLugAside, half}, between_frames(shell, shell.units[i]), cost);
    if (!at) {
      without.no_place(i, masses[i].mass);
      continue;
    }
    const SectionOutside outside = shell.outside(*at);
    const double eye = eye_at(frame_of(shell, *at));
    const LugShape left = lug_on_left(shell, outside, eye);
    const LugShape right = lug_on_left(shell, parts::mirrored(outside), eye);
    if (!faults_of(left.region).empty() || !faults_of(right.region).empty()) {
      without.no_room(i, masses[i].mass);
      continue;
    }
    const std::string suffix = unit_suffix(shell, i);
    add_part(shell.workshop, cross_plate(shell, "left_lug" + suffix, left.region, lifting.thickness, *at),
             kFittingColour);
    add_part(shell.workshop,
             cross_plate(shell, "right_lug" + suffix, mirrored(right.region), lifting.thickness, *at),
             kFittingColour);
    shell.taken.add(*at - half, *at + half);
    note_lugs(i, masses[i].mass, *at, off_plumb(*at), shell.workshop);
  }
  without.tell(2.0 * (half + kLugAside), "The outside of the section leaves them no room below its tops.",
               shell.workshop);
}

}  // namespace glissade::parts
