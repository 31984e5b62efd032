// The outline of each kind of cross-section, and what its measures ask of each other.

#include "section/shapes.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/quantity.hpp"
#include "glissade/core/units.hpp"
#include "glissade/section/cross_section.hpp"

#include "core/plane_geometry.hpp"

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
using section::Shape;
using section::Side;
using section::Stroke;
using Polygon = CrossSection::Polygon;

// --- what measures ask of each other -------------------------------------------------------------------

/// Every length is a size of its own, before it is compared with others.
class RequireSizes {
 public:
  void length(const std::string& name, double size, const char*) const {
    if (std::isfinite(size) && size > 0.0) return within(name, size);
    throw InputError({"", name + ": " + length_text(size) + " is not a size",
                      "A " + name + " is finite and above zero.", "a positive length"});
  }
  void optional_length(const std::string& name, double size) const {
    if (size == 0.0) return;
    if (std::isfinite(size) && size > 0.0) return within(name, size);
    throw InputError({"", name + ": " + length_text(size) + " is not a size",
                      "A " + name + " is finite, zero or above.", "zero or a positive length"});
  }
  void width(const std::string& name, const WidthLaw& width, const char* example) const {
    for (const WidthAt& knot : width.knots()) length(name, knot.width, example);
  }
  void angle(const std::string& name, Angle size, const char*) const {
    if (std::isfinite(size.radians())) return;
    throw InputError({"", name + ": " + exact_text(size.degrees()) + " deg is not an angle", "", ""});
  }
  void corners(const std::string& name, const Polygon& corners, const char*) const {
    for (const Vec2 corner : corners) {
      if (std::max(std::fabs(corner.x), std::fabs(corner.y)) <= CrossSection::kLargestLength) continue;
      throw InputError(
          {"", name + ": (" + exact_text(corner.x) + ", " + exact_text(corner.y) + ") is not a point",
           "Every coordinate of an outline is a finite number, 1e+100 m at most.", ""});
    }
  }
  void misnomer(const char*, const char*) const {}

 private:
  static void within(const std::string& name, double size) {
    if (size >= CrossSection::kSmallestLength && size <= CrossSection::kLargestLength) return;
    throw InputError({"", name + ": " + exact_text(size) + " m is out of range",
                      "Between " + rounded_text(CrossSection::kSmallestLength, 3) + " m and " +
                          rounded_text(CrossSection::kLargestLength, 3) +
                          " m area and moment of a section stay within the range of numbers.",
                      "lengths in metres"});
  }
};

void require_thinner(double thickness, const std::string& name, double width) {
  if (thickness < width) return;
  const auto [thick, wide] = texts_apart(thickness, width, &length_text);
  throw InputError({"", "thickness: " + thick + " is no thinner than the " + name + ", " + wide,
                    "A plate is thinner than the " + name + " that it encloses.", "the units of both"});
}

void require_between(const std::string& name, Angle angle, Angle least, Angle most, const std::string& why,
                     const std::string& hint) {
  if (angle >= least && angle <= most) return;
  throw InputError(out_of_range(name, angle.radians(), Dimension::angle, {least.radians(), most.radians()},
                                why + angle_text(least) + " to " + angle_text(most) + ".", hint));
}

void require_more(const std::string& name, double size, const std::string& bound_name, double bound,
                  const std::string& why) {
  if (size > bound) return;
  const auto [small, beside] = texts_apart(size, bound, &length_text);
  throw InputError({"", name + ": " + small + " is too small beside " + bound_name + ", " + beside, why,
                    "a " + name + " above " + beside});
}

// --- plane figures -------------------------------------------------------------------------------------

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

// --- the kinds -----------------------------------------------------------------------------------------

/// Puts one stroke after another.
class Pen {
 public:
  explicit Pen(Vec2 start) : start_(start), place_(start) {}

  Pen& line(Vec2 to, Side side) {
    outline_.push_back({place_, to, side, std::nullopt});
    place_ = to;
    return *this;
  }
  /// Along a circle between two angles from its lowest point, cut there: (0, 0) becomes a vertex.
  Pen& arc(Vec2 bottom, double radius, double from, double to, Vec2 end, Side side) {
    const Arc whole{bottom, radius, from, to};
    if (from * to < 0.0) {
      arc_piece({bottom, radius, from, 0.0}, bottom, side);
      return arc_piece({bottom, radius, 0.0, to}, end, side);
    }
    return arc_piece(whole, end, side);
  }
  [[nodiscard]] Outline close(Side side) {
    if (!(place_ == start_)) line(start_, side);
    return std::move(outline_);
  }

 private:
  Pen& arc_piece(const Arc& arc, Vec2 end, Side side) {
    outline_.push_back({place_, end, side, arc});
    place_ = end;
    return *this;
  }

  Vec2 start_;
  Vec2 place_;
  Outline outline_;
};

Outline closed(const Polygon& corners, const std::vector<Side>& sides) {
  Pen pen(corners.front());
  for (std::size_t i = 1; i < corners.size(); ++i) pen.line(corners[i], sides[i - 1]);
  return pen.close(sides.back());
}

Shape straight_shape(const Polygon& corners, const std::vector<Side>& sides) {
  return {{closed(corners, sides)}, closest_sides(corners).distance};
}

constexpr Side kFloor = Side::floor;
constexpr Side kLeft = Side::left_wall;
constexpr Side kRight = Side::right_wall;
constexpr Side kRim = Side::rim;
constexpr Side kUnder = Side::underside;

Shape shape_of(const section::Slab& slab) {
  const bool high = slab.curb_height > 0.0;
  if (high != (slab.curb_width > 0.0)) {
    throw InputError({"", std::string(high ? "curb_height" : "curb_width") + " stands alone",
                      "A curb has both a curb_height and a curb_width.", "both, or none"});
  }
  const double half = 0.5 * slab.width.narrowest();
  const double under = -slab.thickness;
  if (!high) {
    return straight_shape({{-half, under}, {half, under}, {half, 0.0}, {-half, 0.0}},
                          {kUnder, kUnder, kFloor, kUnder});
  }
  const double outer = half + slab.curb_width;
  const double top = slab.curb_height;
  return straight_shape({{-outer, under},
                         {outer, under},
                         {outer, top},
                         {half, top},
                         {half, 0.0},
                         {-half, 0.0},
                         {-half, top},
                         {-outer, top}},
                        {kUnder, kUnder, kRim, kLeft, kFloor, kRight, kRim, kUnder});
}

Shape shape_of(const section::Trapezoid& channel) {
  require_thinner(channel.thickness, "width", channel.width.narrowest());
  require_between("wall_angle", channel.wall_angle, Angle(), CrossSection::kMaxWallAngle,
                  "The walls of a trapezoid lean outward from upright by ", "20 deg");
  const double lean = math::tan(channel.wall_angle.radians());
  const double across = 1.0 / math::cos(channel.wall_angle.radians());
  const double half = 0.5 * channel.width.narrowest();
  const double wall = channel.wall_height;
  const double top = half + wall * lean;
  const double foot = half + channel.thickness * (1.0 - math::sin(channel.wall_angle.radians())) * across;
  const double outer = top + channel.thickness * across;
  const double under = -channel.thickness;
  return straight_shape({{-foot, under},
                         {foot, under},
                         {outer, wall},
                         {top, wall},
                         {half, 0.0},
                         {-half, 0.0},
                         {-top, wall},
                         {-outer, wall}},
                        {kUnder, kUnder, kRim, kLeft, kFloor, kRight, kRim, kUnder});
}

Shape shape_of(const section::UChannel& channel) {
  return shape_of(section::Trapezoid{channel.width, channel.wall_height, Angle(), channel.thickness});
}

Shape shape_of(const section::HalfPipe& trough) {
  require_thinner(trough.thickness, "width", trough.width);
  const double radius = 0.5 * trough.width;
  const double outer = radius + trough.thickness;
  const double top = radius + trough.wall_height;
  Pen pen({-outer, radius});
  pen.arc({0.0, -trough.thickness}, outer, -kRightAngle, kRightAngle, {outer, radius}, kUnder);
  if (trough.wall_height > 0.0) pen.line({outer, top}, kUnder);
  pen.line({radius, top}, kRim);
  if (trough.wall_height > 0.0) pen.line({radius, radius}, kLeft);
  pen.arc({0.0, 0.0}, radius, kRightAngle, -kRightAngle, {-radius, radius}, kFloor);
  if (trough.wall_height > 0.0) pen.line({-radius, top}, kRight);
  pen.line({-outer, top}, kRim);
  return {{pen.close(kUnder)}, trough.thickness};
}

Outline circle(double bottom, double radius, double middle, Side side) {
  const Vec2 pole{0.0, bottom};
  Pen pen({-radius, middle});
  pen.arc(pole, radius, -kRightAngle, kRightAngle, {radius, middle}, side)
      .arc(pole, radius, kRightAngle, std::numbers::pi, {0.0, middle + radius}, side)
      .arc(pole, radius, -std::numbers::pi, -kRightAngle, {-radius, middle}, side);
  return pen.close(side);
}

Outline reversed(const Outline& outline) {
  Outline back;
  for (auto stroke = outline.rbegin(); stroke != outline.rend(); ++stroke) {
    back.push_back(*stroke);
    std::swap(back.back().from, back.back().to);
    if (back.back().arc) std::swap(back.back().arc->from, back.back().arc->to);
  }
  return back;
}

Shape shape_of(const section::Pipe& pipe) {
  require_thinner(pipe.thickness, "inner_diameter", pipe.inner_diameter);
  const double radius = 0.5 * pipe.inner_diameter;
  return {{circle(-pipe.thickness, radius + pipe.thickness, radius, kUnder),
           reversed(circle(0.0, radius, radius, kFloor))},
          pipe.thickness};
}

Shape shape_of(const section::VChannel& channel) {
  require_between("angle", channel.angle, CrossSection::kLeastVAngle, CrossSection::kMostVAngle,
                  "The walls of a v-channel open by ", "90 deg");
  // The walls rise by this angle from level, and the bottom's arc turns by it on either side.
  const double rise = kRightAngle - 0.5 * channel.angle.radians();
  const double sine = math::sin(rise);
  const double cosine = math::cos(rise);
  const double half_sine = math::sin(0.5 * rise);
  const double foot = 2.0 * channel.bottom_radius * half_sine * half_sine;
  require_more("wall_height", channel.wall_height, "the end of the bottom's arc", foot,
               "The walls begin where the round bottom ends.");
  const double outer_radius = channel.bottom_radius + channel.thickness;
  const double outer_foot = 2.0 * outer_radius * half_sine * half_sine - channel.thickness;
  const auto across_at = [&](double radius, double begin, double height) {
    return radius * sine + (height - begin) * cosine / sine;
  };
  const double wall = channel.wall_height;
  const double inner = across_at(channel.bottom_radius, foot, wall);
  const double outer = across_at(outer_radius, outer_foot, wall);
  const Vec2 inner_end{channel.bottom_radius * sine, foot};
  const Vec2 outer_end{outer_radius * sine, outer_foot};
  Pen pen({-outer_end.x, outer_end.y});
  pen.arc({0.0, -channel.thickness}, outer_radius, -rise, rise, outer_end, kUnder)
      .line({outer, wall}, kUnder)
      .line({inner, wall}, kRim)
      .line(inner_end, kLeft)
      .arc({0.0, 0.0}, channel.bottom_radius, rise, -rise, {-inner_end.x, inner_end.y}, kFloor)
      .line({-inner, wall}, kRight)
      .line({-outer, wall}, kRim);
  return {{pen.close(kUnder)}, channel.thickness};
}

Shape shape_of(const section::TrackGroove& track) {
  require_more("groove_spacing", track.groove_spacing, "groove_width", track.groove_width,
               "A ridge stands between the two grooves.");
  require_more("width", track.width.narrowest(), "both grooves", track.groove_spacing + track.groove_width,
               "The track goes on beside its grooves.");
  const double half = 0.5 * track.width.narrowest();
  const double near = 0.5 * (track.groove_spacing - track.groove_width);
  const double far = 0.5 * (track.groove_spacing + track.groove_width);
  const double top = track.groove_depth;
  const double under = -track.thickness;
  return straight_shape(
      {{-half, under},
       {half, under},
       {half, top},
       {far, top},
       {far, 0.0},
       {near, 0.0},
       {near, top},
       {-near, top},
       {-near, 0.0},
       {-far, 0.0},
       {-far, top},
       {-half, top}},
      {kUnder, kUnder, kRim, kLeft, kFloor, kRight, kRim, kLeft, kFloor, kRight, kRim, kUnder});
}

/// Names the sides of an outline that runs counter-clockwise: over it from the highest point on the left of the
/// origin to the highest on its right.
std::vector<Side> named_sides(const Polygon& corners) {
  const std::size_t count = corners.size();
  const double reach = 1e-9 * extent(corners);
  std::size_t origin = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec2 a = corners[i];
    const Vec2 b = corners[(i + 1) % count];
    if (b.x < a.x && core::distance_to_segment({0.0, 0.0}, a, b) <= reach) origin = i;
  }
  // To +x the outline is followed backwards from the origin, to -x forwards, each to its highest corner.
  const auto highest = [&](bool backwards) {
    std::size_t best = 0;
    double height = -std::numeric_limits<double>::infinity();
    for (std::size_t step = 0; step < count; ++step) {
      const std::size_t corner = (origin + (backwards ? count - step : step + 1)) % count;
      if (backwards ? corners[corner].x <= 0.0 && step > 0 : corners[corner].x >= 0.0 && step > 0) break;
      if (corners[corner].y <= height) continue;
      height = corners[corner].y;
      best = step;
    }
    return best;
  };
  const std::size_t left = highest(true);    // sides before the one at the origin
  const std::size_t right = highest(false);  // sides after it
  std::vector<Side> sides(count, kUnder);
  const auto name = [&](std::size_t side, Side wall) {
    const Vec2 along = corners[(side + 1) % count] - corners[side];
    sides[side] = -along.x >= std::fabs(along.y) ? kFloor : wall;
  };
  for (std::size_t step = 1; step <= left; ++step) name((origin + count - step) % count, kLeft);
  for (std::size_t step = 1; step <= right; ++step) name((origin + step) % count, kRight);
  name(origin, corners[origin].x > 0.0 ? kLeft : kRight);
  for (const auto& [at, from_left] :
       {std::pair{(origin + count - left) % count, true}, std::pair{(origin + right + 1) % count, false}}) {
    const std::size_t side = from_left ? (at + count - 1) % count : at;
    const Vec2 along = corners[(side + 1) % count] - corners[side];
    const bool level = along.x < 0.0 && std::fabs(along.y) <= reach;
    if (level && sides[side] == kUnder && corners[at].y > reach) sides[side] = kRim;
  }
  return sides;
}

Shape shape_of(const section::Polygon& polygon) {
  Polygon outline = polygon.outline;
  if (outline.size() < 3 || outline.size() > CrossSection::kMaxOutlineVertices) {
    throw InputError(
        {"", "outline: " + std::to_string(outline.size()) + " vertices",
         "An outline has 3 to " + std::to_string(CrossSection::kMaxOutlineVertices) + " vertices.", ""});
  }
  require_simple(outline);
  if (signed_area(outline) < 0.0) std::reverse(outline.begin(), outline.end());
  require_floor_at_origin(outline);
  return straight_shape(outline, named_sides(outline));
}

}  // namespace

section::Shape section::shape_of(const Measures& measures) {
  visit_measures(measures, RequireSizes());
  return std::visit([](const auto& kind) { return glissade::shape_of(kind); }, measures);
}

}  // namespace glissade
