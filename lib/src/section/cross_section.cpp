#include "glissade/section/cross_section.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/units.hpp"

#include "section/shapes.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <variant>

namespace glissade {
namespace {

using section::Arc;
using section::Outline;
using section::Side;
using section::Stroke;
using Polygon = CrossSection::Polygon;

// An arc always has at least this many chords in a quarter turn: fewer no longer look or behave round.
constexpr double kLeastChordsPerQuarter = 3.0;

/// @return how far the width changes over a length at its fastest, over that length
double steepest_widening(const WidthLaw& law) {
  double steepest = 0.0;
  for (const WidthAt& knot : law.knots()) steepest = std::max(steepest, std::fabs(law.slope(knot.at)));
  return steepest;
}

void require_gentle(const WidthLaw& law) {
  for (const WidthAt& knot : law.knots()) {
    const double slope = std::fabs(law.slope(knot.at));
    if (slope <= CrossSection::kSteepestWidening) continue;
    throw InputError(
        {"",
         "width: after " + length_text(knot.at) + " it changes by " + rounded_text(slope, 3) +
             " times the length of track that it takes",
         "It may change by twice that length: walls that turn further no longer keep their thickness.",
         "places that are further apart"});
  }
}

double turn_of(const Arc& arc) {
  return std::fabs(arc.to - arc.from);
}

/// @param half_step  half the angle that a chord may turn through
double chords_of(const Arc& arc, double half_step) {
  return std::max(std::ceil(kLeastChordsPerQuarter * turn_of(arc) / kRightAngle),
                  std::ceil(0.5 * turn_of(arc) / half_step));
}

// Points inside an arc are counted from the end that is nearer to the pole of its half, and an upper half is the
// image of the lower one: arcs that mirror each other get points that do, to the last digit.
void put_arc(const Arc& arc, double half_step, Polygon& points) {
  const auto chords = static_cast<std::size_t>(chords_of(arc, half_step));
  const bool upper = std::fabs(arc.from + arc.to) > std::numbers::pi;
  const auto from_pole = [&](double angle) {
    return upper ? std::copysign(std::numbers::pi, angle) - angle : angle;
  };
  const double from = from_pole(arc.from);
  const double to = from_pole(arc.to);
  const bool leaves = std::fabs(from) <= std::fabs(to);
  const double near = leaves ? from : to;
  const double far = leaves ? to : from;
  for (std::size_t i = 1; i < chords; ++i) {
    const std::size_t from_near = leaves ? i : chords - i;
    const Vec2 lower =
        arc.at(near + (far - near) * static_cast<double>(from_near) / static_cast<double>(chords));
    points.push_back({lower.x, upper ? 2.0 * arc.centre().y - lower.y : lower.y});
  }
}

}  // namespace

CrossSection::CrossSection(const section::Measures& measures)
    : measures_(measures), kind_(section::kind(measures)) {
  // The narrowest first: what measures ask of each other holds there last.
  section::Shape shape = section::shape_of(measures);
  narrowest_ = shape.narrowest;
  if (const std::optional<WidthLaw> law = section::width_law(measures); law && !law->is_constant()) {
    require_gentle(*law);
    varies_ = true;
    const double turned = 0.5 * steepest_widening(*law);
    narrowest_ /= math::hypot(1.0, turned);
    shape = section::shape_of(section::with_width(measures, law->at(0.0)));
  }
  loops_ = std::move(shape.loops);
  for (const Outline& loop : loops_) {
    for (const Stroke& stroke : loop) {
      lowest_ = std::min(lowest_, stroke.from.y);
      highest_ = std::max(highest_, stroke.from.y);
      if (!stroke.arc) continue;
      widest_radius_ = std::max(widest_radius_, stroke.arc->radius);
    }
  }
}

CrossSection CrossSection::at(double s) const {
  return varies_ ? CrossSection(section::with_width(measures_, width_law()->at(s))) : *this;
}

CrossSection CrossSection::at_narrowest() const {
  return varies_ ? CrossSection(section::with_width(measures_, width_law()->narrowest())) : *this;
}

CrossSection CrossSection::at_widest() const {
  return varies_ ? CrossSection(section::with_width(measures_, width_law()->widest())) : *this;
}

CrossSection CrossSection::slab(double width, double thickness, double curb_height, double curb_width) {
  return CrossSection(section::Slab{width, thickness, curb_height, curb_width});
}

CrossSection CrossSection::u_channel(double width, double wall_height, double thickness) {
  return CrossSection(section::UChannel{width, wall_height, thickness});
}

CrossSection CrossSection::trapezoid(double floor_width, double wall_height, Angle wall_angle,
                                     double thickness) {
  return CrossSection(section::Trapezoid{floor_width, wall_height, wall_angle, thickness});
}

CrossSection CrossSection::half_pipe(double width, double thickness, double wall_height) {
  return CrossSection(section::HalfPipe{width, wall_height, thickness});
}

CrossSection CrossSection::pipe(double inner_diameter, double thickness) {
  return CrossSection(section::Pipe{inner_diameter, thickness});
}

CrossSection CrossSection::v_channel(Angle angle, double bottom_radius, double wall_height,
                                     double thickness) {
  return CrossSection(section::VChannel{angle, bottom_radius, wall_height, thickness});
}

CrossSection CrossSection::track_groove(double width, double groove_width, double groove_depth,
                                        double groove_spacing, double thickness) {
  return CrossSection(section::TrackGroove{width, groove_width, groove_depth, groove_spacing, thickness});
}

CrossSection CrossSection::polygon(Polygon outline) {
  return CrossSection(section::Polygon{std::move(outline)});
}

std::vector<Stroke> CrossSection::strokes(Side side) const {
  std::vector<Stroke> found;
  for (const Outline& loop : loops_) {
    std::copy_if(loop.begin(), loop.end(), std::back_inserter(found),
                 [side](const Stroke& stroke) { return stroke.side == side; });
  }
  return found;
}

// Half the angle of a chord that stays within the tolerance on the widest arc: all arcs are cut alike.
double CrossSection::half_step(double chord_tolerance) const {
  if (!(chord_tolerance > 0.0))
    throw InputError({"", "chord_tolerance: " + exact_text(chord_tolerance) + " m is not above zero",
                      "Chords leave the arc that they stand for.", "0.0001 m"});
  return 2.0 * math::asin(std::sqrt(std::min(0.5, 0.5 * chord_tolerance / widest_radius_)));
}

Polygon CrossSection::polygon_of(const Outline& outline, double chord_tolerance) const {
  const double half = half_step(chord_tolerance);
  Polygon points;
  for (const Stroke& stroke : outline) {
    points.push_back(stroke.from);
    if (stroke.arc) put_arc(*stroke.arc, half, points);
  }
  return points;
}

Polygon CrossSection::outline(double chord_tolerance) const {
  return polygon_of(loops_.front(), chord_tolerance);
}

Polygon CrossSection::bore(double chord_tolerance) const {
  if (loops_.size() < 2) return {};
  Polygon points = polygon_of(loops_.back(), chord_tolerance);
  // The outline read backwards: it ends where that begins.
  std::rotate(points.begin(), std::next(points.begin()), points.end());
  return points;
}

double CrossSection::vertex_count(double chord_tolerance) const {
  const double half = half_step(chord_tolerance);
  double count = 0.0;
  for (const Outline& loop : loops_) {
    for (const Stroke& stroke : loop) count += stroke.arc ? chords_of(*stroke.arc, half) : 1.0;
  }
  return count;
}

double CrossSection::chord_error(double chord_tolerance) const {
  const double half = half_step(chord_tolerance);
  double worst = 0.0;
  for (const Outline& loop : loops_) {
    for (const Stroke& stroke : loop) {
      if (!stroke.arc) continue;
      const double sine = math::sin(0.25 * turn_of(*stroke.arc) / chords_of(*stroke.arc, half));
      worst = std::max(worst, 2.0 * stroke.arc->radius * sine * sine);
    }
  }
  return worst;
}

double CrossSection::area() const {
  double sum = 0.0;
  for (const Outline& loop : loops_) sum += section::area(loop);
  return sum;
}

double CrossSection::first_moment() const {
  double sum = 0.0;
  for (const Outline& loop : loops_) sum += section::first_moment(loop);
  return sum;
}

}  // namespace glissade
