#include "glissade/solid/cross_section.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"

#include "core/plane_geometry.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

namespace glissade {
namespace {

using Polygon = CrossSection::Polygon;

constexpr double kPi = std::numbers::pi;
// An arc always has at least this many chords in a quarter turn: fewer no longer look or behave round.
constexpr double kLeastChordsPerQuarter = 3.0;

void require_positive(const std::string& name, double size) {
  if (std::isfinite(size) && size > 0.0) return;
  throw InputError({"", name + ": " + length_text(size) + " is not a size",
                    "A " + name + " is finite and above zero.", "a positive length"});
}

void require_not_negative(const std::string& name, double size) {
  if (std::isfinite(size) && size >= 0.0) return;
  throw InputError({"", name + ": " + length_text(size) + " is not a size",
                    "A " + name + " is finite, zero or above.", "zero or a positive length"});
}

void require_thinner(double thickness, const std::string& name, double width) {
  if (thickness < width) return;
  throw InputError({"",
                    "thickness: " + length_text(thickness) + " is wider than the channel, " +
                        length_text(width) + " (" + name + ")",
                    "The plates of a channel are thinner than the channel is wide.",
                    "a thickness below " + length_text(width)});
}

bool segments_meet(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  const double side_c = cross(b - a, c - a);
  const double side_d = cross(b - a, d - a);
  const double side_a = cross(d - c, a - c);
  const double side_b = cross(d - c, b - c);
  return ((side_c > 0.0) != (side_d > 0.0)) && ((side_a > 0.0) != (side_b > 0.0));
}

double segment_distance(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  if (segments_meet(a, b, c, d)) return 0.0;
  return std::min({core::distance_to_segment(a, c, d), core::distance_to_segment(b, c, d),
                   core::distance_to_segment(c, a, b), core::distance_to_segment(d, a, b)});
}

double signed_area(const Polygon& polygon) {
  double twice = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    twice += cross(polygon[i] - polygon[0], polygon[(i + 1) % polygon.size()] - polygon[0]);
  }
  return 0.5 * twice;
}

double signed_moment(const Polygon& polygon) {
  double sum = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 a = polygon[i];
    const Vec2 b = polygon[(i + 1) % polygon.size()];
    sum += (a.y + b.y) * cross(a, b);
  }
  return sum / 6.0;
}

double extent(const Polygon& polygon) {
  double size = 0.0;
  for (const Vec2 corner : polygon) size = std::max({size, std::fabs(corner.x), std::fabs(corner.y)});
  return size;
}

struct ClosestSides {
  double distance = std::numeric_limits<double>::infinity();
  std::size_t first = 0;
  std::size_t second = 0;
};

ClosestSides closest_sides(const Polygon& polygon) {
  ClosestSides closest;
  const std::size_t count = polygon.size();
  for (std::size_t i = 0; i + 2 < count; ++i) {
    const std::size_t last = i == 0 ? count - 1 : count;
    for (std::size_t j = i + 2; j < last; ++j) {
      const double distance =
          segment_distance(polygon[i], polygon[i + 1], polygon[j], polygon[(j + 1) % count]);
      if (distance < closest.distance) closest = {distance, i, j};
    }
  }
  // A triangle has no two sides apart: its heights stand for them.
  if (count == 3) {
    for (std::size_t i = 0; i < 3; ++i) {
      const double height = core::distance_to_segment(polygon[i], polygon[(i + 1) % 3], polygon[(i + 2) % 3]);
      if (height < closest.distance) closest = {height, i, (i + 1) % 3};
    }
  }
  return closest;
}

std::string side_name(std::size_t index) {
  return "side " + std::to_string(index + 1);
}

void require_simple(const Polygon& outline) {
  const double size = extent(outline);
  const std::size_t count = outline.size();
  for (std::size_t i = 0; i < count; ++i) {
    const Vec2 before = outline[i];
    const Vec2 corner = outline[(i + 1) % count];
    const Vec2 after = outline[(i + 2) % count];
    if (!(norm(corner - before) > 1e-9 * size)) {
      throw InputError({"", "outline: " + side_name(i) + " has no length",
                        "Every vertex of an outline differs from the next; the outline closes by itself.",
                        "leaving the repeated vertex out"});
    }
    const Vec2 in = corner - before;
    const Vec2 out = after - corner;
    if (dot(in, out) < 0.0 && std::fabs(cross(in, out)) <= 1e-9 * norm(in) * norm(out)) {
      throw InputError({"", "outline: " + side_name((i + 1) % count) + " runs back along " + side_name(i),
                        "An outline is simple: its sides meet only where one ends and the next begins.", ""});
    }
  }
  const ClosestSides closest = closest_sides(outline);
  if (closest.distance > 1e-9 * size) return;
  throw InputError({"",
                    "outline: " + side_name(closest.first) + " and " + side_name(closest.second) +
                        (closest.distance > 0.0 ? " touch" : " cross or touch"),
                    "An outline is simple: its sides meet only where one ends and the next begins.",
                    "checking the order of the vertices"});
}

// Counter-clockwise, so a side faces up where it runs towards -x.
void require_floor_at_origin(const Polygon& outline) {
  const double reach = 1e-9 * extent(outline);
  bool on_outline = false;
  bool faces_up = false;
  bool faces_down = false;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2 a = outline[i];
    const Vec2 b = outline[(i + 1) % outline.size()];
    if (core::distance_to_segment({0.0, 0.0}, a, b) > reach) continue;
    on_outline = true;
    faces_up = faces_up || b.x < a.x;
    faces_down = faces_down || b.x > a.x;
  }
  if (!on_outline) {
    throw InputError({"", "outline: (0, 0) does not lie on it",
                      "The point (0, 0) of an outline is the floor's surface line, on which the body slides.",
                      "shifting the outline so that the floor's surface passes through (0, 0)"});
  }
  if (!faces_up || faces_down) {
    throw InputError({"", "outline: the side at (0, 0) does not face up",
                      "The material lies below the floor's surface line, the body above it.",
                      "shifting the outline so that (0, 0) lies on the upper surface of the floor"});
  }
}

// Chords of a quarter turn.
double chords_per_quarter(double radius, double chord_tolerance) {
  const double half_step = 2.0 * math::asin(std::sqrt(std::min(0.5, 0.5 * chord_tolerance / radius)));
  return std::max(kLeastChordsPerQuarter, std::ceil(0.25 * kPi / half_step));
}

// Quarter of a circle of centre (0, height), from its lowest point to its rightmost, both exact.
Polygon quarter(double radius, double height, double lowest, std::size_t chords) {
  Polygon points;
  points.reserve(chords + 1);
  points.push_back({0.0, lowest});
  for (std::size_t i = 1; i < chords; ++i) {
    const double angle = 0.5 * kPi * static_cast<double>(i) / static_cast<double>(chords);
    const double rise = math::sin(0.5 * angle);
    points.push_back({radius * math::sin(angle), lowest + 2.0 * radius * rise * rise});
  }
  points.push_back({radius, height});
  return points;
}

// From the leftmost point over the lowest to the rightmost.
Polygon lower_half(double radius, double height, double lowest, std::size_t chords) {
  const Polygon right = quarter(radius, height, lowest, chords);
  Polygon points;
  points.reserve(2 * chords + 1);
  for (std::size_t i = chords; i > 0; --i) points.push_back({-right[i].x, right[i].y});
  points.insert(points.end(), right.begin(), right.end());
  return points;
}

Polygon circle(double radius, double height, double lowest, std::size_t chords) {
  Polygon points = lower_half(radius, height, lowest, chords);
  const Polygon lower = points;
  for (std::size_t i = lower.size() - 1; i-- > 1;) {
    points.push_back({lower[i].x, i == chords ? height + radius : 2.0 * height - lower[i].y});
  }
  return points;
}

}  // namespace

CrossSection CrossSection::slab(double width, double thickness, double curb_height, double curb_width) {
  require_positive("width", width);
  require_positive("thickness", thickness);
  require_not_negative("curb_height", curb_height);
  require_not_negative("curb_width", curb_width);
  if ((curb_height > 0.0) != (curb_width > 0.0)) {
    const bool low = curb_height == 0.0;
    throw InputError({"",
                      low ? "curb_height: missing, while curb_width is " + length_text(curb_width)
                          : "curb_width: missing, while curb_height is " + length_text(curb_height),
                      "A curb has a height and a width.", "giving both, or none for a plain ramp"});
  }
  CrossSection section(Kind::slab);
  const double half = 0.5 * width;
  if (curb_height > 0.0) {
    const double outer = half + curb_width;
    section.corners_ = {{-outer, -thickness}, {outer, -thickness},  {outer, curb_height},
                        {half, curb_height},  {half, 0.0},          {-half, 0.0},
                        {-half, curb_height}, {-outer, curb_height}};
  } else {
    section.corners_ = {{-half, -thickness}, {half, -thickness}, {half, 0.0}, {-half, 0.0}};
  }
  section.narrowest_ = closest_sides(section.corners_).distance;
  return section;
}

CrossSection CrossSection::u_channel(double width, double wall_height, double thickness) {
  CrossSection section = trapezoid(width, wall_height, Angle(), thickness);
  section.kind_ = Kind::u_channel;
  return section;
}

CrossSection CrossSection::trapezoid(double floor_width, double wall_height, Angle wall_angle,
                                     double thickness) {
  require_positive("width", floor_width);
  require_positive("wall_height", wall_height);
  require_positive("thickness", thickness);
  require_thinner(thickness, "width", floor_width);
  if (!(wall_angle >= Angle() && wall_angle <= kMaxWallAngle)) {
    throw InputError({"", "wall_angle: " + angle_text(wall_angle.radians()) + " is out of range",
                      "The walls of a trapezoid lean outward by 0 to " + angle_text(kMaxWallAngle.radians()) +
                          " from upright.",
                      "0 deg for upright walls, 30 deg for a common chute"});
  }
  const double lean = math::tan(wall_angle.radians());
  const double across = 1.0 / math::cos(wall_angle.radians());
  const double half = 0.5 * floor_width;
  const double top = half + wall_height * lean;
  const double foot = half + thickness * (1.0 - math::sin(wall_angle.radians())) * across;
  const double outer = top + thickness * across;
  CrossSection section(Kind::trapezoid);
  section.corners_ = {{-foot, -thickness}, {foot, -thickness}, {outer, wall_height}, {top, wall_height},
                      {half, 0.0},         {-half, 0.0},       {-top, wall_height},  {-outer, wall_height}};
  section.narrowest_ = closest_sides(section.corners_).distance;
  return section;
}

CrossSection CrossSection::half_pipe(double width, double thickness, double wall_height) {
  require_positive("width", width);
  require_positive("thickness", thickness);
  require_not_negative("wall_height", wall_height);
  require_thinner(thickness, "width", width);
  CrossSection section(Kind::half_pipe);
  section.diameter_ = width;
  section.thickness_ = thickness;
  section.wall_height_ = wall_height;
  section.narrowest_ = thickness;
  return section;
}

CrossSection CrossSection::pipe(double inner_diameter, double thickness) {
  require_positive("width", inner_diameter);
  require_positive("thickness", thickness);
  require_thinner(thickness, "width", inner_diameter);
  CrossSection section(Kind::pipe);
  section.diameter_ = inner_diameter;
  section.thickness_ = thickness;
  section.narrowest_ = thickness;
  return section;
}

CrossSection CrossSection::polygon(Polygon outline) {
  if (outline.size() < 3 || outline.size() > kMaxOutlineVertices) {
    throw InputError({"", "outline: " + std::to_string(outline.size()) + " vertices",
                      "An outline has 3 to " + std::to_string(kMaxOutlineVertices) + " vertices.", ""});
  }
  for (const Vec2 corner : outline) {
    if (std::isfinite(corner.x) && std::isfinite(corner.y)) continue;
    throw InputError({"",
                      "outline: (" + exact_text(corner.x) + ", " + exact_text(corner.y) + ") is not a point",
                      "Every coordinate of an outline is a finite number.", ""});
  }
  require_simple(outline);
  if (signed_area(outline) < 0.0) std::reverse(outline.begin(), outline.end());
  require_floor_at_origin(outline);
  CrossSection section(Kind::polygon);
  section.narrowest_ = closest_sides(outline).distance;
  section.corners_ = std::move(outline);
  return section;
}

std::string_view CrossSection::kind() const {
  switch (kind_) {
    case Kind::slab:
      return "slab";
    case Kind::u_channel:
      return "u-channel";
    case Kind::trapezoid:
      return "trapezoid";
    case Kind::half_pipe:
      return "half-pipe";
    case Kind::pipe:
      return "pipe";
    case Kind::polygon:
      return "polygon";
  }
  throw InternalError({"", "cross-section of unknown kind", "", ""});
}

Polygon CrossSection::outline(double chord_tolerance) const {
  if (!round()) return corners_;
  const double radius = 0.5 * diameter_;
  const double outer = radius + thickness_;
  const auto chords = static_cast<std::size_t>(chords_per_quarter(outer, chord_tolerance));
  if (kind_ == Kind::pipe) return circle(outer, radius, -thickness_, chords);

  Polygon points = lower_half(outer, radius, -thickness_, chords);
  const Polygon inner = lower_half(radius, radius, 0.0, chords);
  const double top = radius + wall_height_;
  if (wall_height_ > 0.0) {
    points.insert(points.end(), {{outer, top}, {radius, top}});
    points.insert(points.end(), inner.rbegin(), inner.rend());
    points.insert(points.end(), {{-radius, top}, {-outer, top}});
  } else {
    points.insert(points.end(), inner.rbegin(), inner.rend());
  }
  return points;
}

Polygon CrossSection::bore(double chord_tolerance) const {
  if (kind_ != Kind::pipe) return {};
  const double radius = 0.5 * diameter_;
  const auto chords = static_cast<std::size_t>(chords_per_quarter(radius + thickness_, chord_tolerance));
  Polygon points = circle(radius, radius, 0.0, chords);
  std::reverse(points.begin(), points.end());
  return points;
}

double CrossSection::vertex_count(double chord_tolerance) const {
  if (!round()) return static_cast<double>(corners_.size());
  const double chords = chords_per_quarter(0.5 * diameter_ + thickness_, chord_tolerance);
  if (kind_ == Kind::pipe) return 8.0 * chords;
  return 4.0 * chords + (wall_height_ > 0.0 ? 6.0 : 2.0);
}

double CrossSection::chord_error(double chord_tolerance) const {
  if (!round()) return 0.0;
  const double outer = 0.5 * diameter_ + thickness_;
  const double quarter_step = 0.125 * kPi / chords_per_quarter(outer, chord_tolerance);
  const double sine = math::sin(quarter_step);
  return 2.0 * outer * sine * sine;
}

double CrossSection::area() const {
  if (!round()) return signed_area(corners_);
  const double radius = 0.5 * diameter_;
  const double half_ring = 0.5 * kPi * thickness_ * (2.0 * radius + thickness_);
  if (kind_ == Kind::pipe) return 2.0 * half_ring;
  return half_ring + 2.0 * thickness_ * wall_height_;
}

double CrossSection::first_moment() const {
  if (!round()) return signed_moment(corners_);
  const double radius = 0.5 * diameter_;
  if (kind_ == Kind::pipe) return area() * radius;
  const double outer = radius + thickness_;
  const double half_ring = 0.5 * kPi * thickness_ * (2.0 * radius + thickness_);
  const double below_centre =
      2.0 / 3.0 * thickness_ * (outer * outer + outer * radius + radius * radius);  // (outer^3 - radius^3)
  return half_ring * radius - below_centre + 2.0 * thickness_ * wall_height_ * (radius + 0.5 * wall_height_);
}

double CrossSection::lowest() const {
  if (round()) return -thickness_;
  double height = 0.0;
  for (const Vec2 corner : corners_) height = std::min(height, corner.y);
  return height;
}

double CrossSection::highest() const {
  if (kind_ == Kind::pipe) return diameter_ + thickness_;
  if (kind_ == Kind::half_pipe) return 0.5 * diameter_ + wall_height_;
  double height = 0.0;
  for (const Vec2 corner : corners_) height = std::max(height, corner.y);
  return height;
}

double CrossSection::narrowest() const {
  return narrowest_;
}

}  // namespace glissade
