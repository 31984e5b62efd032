#include "glissade/section/outline.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"

#include <cmath>
#include <cstddef>

// What lies between an arc and its chord is a circular segment of area R^2 (D - sin D) / 2, whose first moment
// about the centre is 2/3 R^3 sin^3(D/2) towards the middle of the arc (D the angle that the arc turns through).

namespace glissade::section {
namespace {

double turn_of(const Arc& arc) {
  return arc.to - arc.from;
}

double segment_area(const Arc& arc) {
  const double turn = turn_of(arc);
  return 0.5 * arc.radius * arc.radius * (turn - math::sin(turn));
}

double segment_moment(const Arc& arc) {
  const double half_sine = math::sin(0.5 * turn_of(arc));
  const double about_centre =
      2.0 / 3.0 * arc.radius * arc.radius * arc.radius * half_sine * half_sine * half_sine;
  const double upward = -math::cos(0.5 * (arc.from + arc.to));
  return arc.centre().y * segment_area(arc) + upward * about_centre;
}

}  // namespace

std::string_view word(Side side) {
  switch (side) {
    case Side::floor:
      return "floor";
    case Side::left_wall:
      return "left wall";
    case Side::right_wall:
      return "right wall";
    case Side::rim:
      return "rim";
    case Side::underside:
      return "underside";
  }
  throw InternalError({"", "a side of a section without a word", "", ""});
}

Vec2 Arc::at(double angle) const {
  const double rise = math::sin(0.5 * angle);
  return {bottom.x + radius * math::sin(angle), bottom.y + 2.0 * radius * rise * rise};
}

double Stroke::length() const {
  return arc ? arc->radius * std::fabs(turn_of(*arc)) : norm(to - from);
}

double area(const Outline& outline) {
  double twice = 0.0;
  double segments = 0.0;
  const Vec2 origin = outline.front().from;
  for (const Stroke& stroke : outline) {
    twice += cross(stroke.from - origin, stroke.to - origin);
    if (stroke.arc) segments += segment_area(*stroke.arc);
  }
  return 0.5 * twice + segments;
}

double first_moment(const Outline& outline) {
  double sum = 0.0;
  double segments = 0.0;
  for (const Stroke& stroke : outline) {
    sum += (stroke.from.y + stroke.to.y) * cross(stroke.from, stroke.to);
    if (stroke.arc) segments += segment_moment(*stroke.arc);
  }
  return sum / 6.0 + segments;
}

}  // namespace glissade::section
