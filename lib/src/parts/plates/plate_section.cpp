// Sections as flat plates. Straight sides stay as they are; round ones become staves that touch the round from outside, one
// of them at its lowest line, so that the floor line is the track.

#include "parts/plates/plate_section.hpp"

#include "glissade/core/math.hpp"
#include "glissade/section/cross_section.hpp"

#include "core/plane_geometry.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>

namespace glissade::parts {
namespace {

constexpr double kPi = std::numbers::pi;

Vec2 left_of(Vec2 along) {
  return (1.0 / norm(along)) * Vec2{-along.y, along.x};
}

/// Where two lines, both moved to the left, meet.
Vec2 mitre(Vec2 before, Vec2 corner, Vec2 after, double thickness) {
  const Vec2 a = left_of(corner - before);
  const Vec2 b = left_of(after - corner);
  return corner + (thickness / (1.0 + dot(a, b))) * (a + b);
}

/// The end of a line that is moved to the left: at the height of its corner, so that rims are level.
Vec2 level_end(Vec2 corner, Vec2 along, double thickness) {
  const Vec2 aside = thickness * left_of(along);
  if (std::fabs(along.y) < 1e-12 * norm(along)) return corner + aside;
  return corner + aside - (aside.y / along.y) * along;
}

}  // namespace

std::vector<Vec2> moved_to_left(const std::vector<Vec2>& chain, bool closed, double by) {
  const std::size_t count = chain.size();
  std::vector<Vec2> moved;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec2 before = chain[(i + count - 1) % count];
    const Vec2 after = chain[(i + 1) % count];
    if (!closed && i == 0) {
      moved.push_back(level_end(chain[i], after - chain[i], by));
    } else if (!closed && i + 1 == count) {
      moved.push_back(level_end(chain[i], chain[i] - before, by));
    } else {
      moved.push_back(mitre(before, chain[i], after, by));
    }
  }
  return moved;
}

namespace {

/// Whether a chain turns everywhere to the right, or everywhere to the left.
bool turns_one_way(const std::vector<Vec2>& chain, bool closed) {
  const std::size_t count = chain.size();
  bool left = false;
  bool right = false;
  for (std::size_t i = closed ? 0 : 1; i + (closed ? 0 : 1) < count; ++i) {
    const double turn = cross(chain[i] - chain[(i + count - 1) % count], chain[(i + 1) % count] - chain[i]);
    left = left || turn > 0.0;
    right = right || turn < 0.0;
  }
  return left != right || !(left || right);
}

PlateSection of_chain(const std::vector<Vec2>& chain, double thickness, bool closed) {
  PlateSection section;
  section.thickness = thickness;
  section.closed = closed;
  section.convex = turns_one_way(chain, closed);
  const std::size_t count = chain.size();
  const std::vector<Vec2> back = moved_to_left(chain, closed, thickness);
  for (std::size_t i = 0; i + (closed ? 0 : 1) < count; ++i) {
    const std::size_t next = (i + 1) % count;
    section.plates.push_back({"", chain[i], chain[next], back[i], back[next]});
  }
  section.outside = back;
  section.ring = closed;
  return section;
}

void name_by_place(PlateSection& section, const std::string& word) {
  for (std::size_t i = 0; i < section.plates.size(); ++i) {
    SectionPlate& plate = section.plates[i];
    const bool carries = plate.face_from.x > 0.0 && plate.face_to.x < 0.0 &&
                         std::fabs(plate.face_from.y) + std::fabs(plate.face_to.y) < 1e-9;
    plate.name = carries ? "floor" : word + "_" + std::to_string(i + 1);
  }
}

/// Corners of lines that touch a circle above the floor line at angles from its lowest point, from left to right.
std::vector<Vec2> round_corners(double radius, const std::vector<double>& touches) {
  std::vector<Vec2> corners;
  for (std::size_t i = 0; i + 1 < touches.size(); ++i) {
    const double middle = 0.5 * (touches[i] + touches[i + 1]);
    const double reach = radius / math::cos(0.5 * (touches[i] - touches[i + 1]));
    const auto [sine, cosine] = math::sine_cosine(middle);
    corners.push_back({reach * sine, radius - reach * cosine});
  }
  return corners;
}

double miss_of(double radius, double turn) {
  return radius * (1.0 / math::cos(0.5 * turn) - 1.0);
}

/// Turns between staves of a round, an even number on the whole, so that one touches at the lowest line.
int turns_of(double radius, double whole, double tolerance) {
  int turns = 2;
  while (turns < 360 && miss_of(radius, whole / turns) > tolerance) turns += 2;
  return turns;
}

std::vector<double> touches_of(double high, int turns) {
  std::vector<double> touches;
  for (int k = 0; k <= turns; ++k) touches.push_back(high * (1.0 - 2.0 * k / turns));
  return touches;
}

// --- the kinds

std::optional<WidthLaw> changing(const WidthLaw& width) {
  return width.is_constant() ? std::nullopt : std::optional(width);
}

/// The thickness of a liner.
double lining_of(const PlateOptions& options) {
  return options.liner ? options.liner->thickness : 0.0;
}

/// Moves all plates of a chain outwards by a liner that covers them.
PlateSection lined(const std::vector<Vec2>& chain, PlateSection section, const PlateOptions& options) {
  if (!options.liner) return section;
  PlateSection moved =
      of_chain(moved_to_left(chain, section.closed, lining_of(options)), section.thickness, section.closed);
  for (std::size_t i = 0; i < section.plates.size(); ++i) {
    moved.plates[i].name = section.plates[i].name;
    moved.lined.push_back({i, section.plates[i].face_from, section.plates[i].face_to});
  }
  moved.departure = section.departure;
  return moved;
}

std::optional<PlateSection> section_of(const section::Trapezoid& channel, const PlateOptions& options) {
  const double half = 0.5 * channel.width.narrowest();
  const double lean = math::tan(channel.wall_angle.radians());
  const double top = half + channel.wall_height * lean;
  // Below a liner the floor is narrower by as much as the walls lean.
  const double low = lining_of(options);
  const double foot = half - low * lean;
  PlateSection section =
      of_chain({{top, channel.wall_height}, {foot, -low}, {-foot, -low}, {-top, channel.wall_height}},
               channel.thickness, false);
  if (options.liner) section.lined = {{1, {half, 0.0}, {-half, 0.0}}};
  section.plates[0].name = "left_wall";
  section.plates[1].name = "floor";
  section.plates[2].name = "right_wall";
  section.widths = changing(channel.width);
  return section;
}

/// Upright walls beside the floor, or on it: edges are square.
std::optional<PlateSection> section_of(const section::UChannel& channel, const PlateOptions& options) {
  // Laps, tabs and slots are those of plates that meet at corners.
  if (options.corners.kind != CornerJoint::butt && channel.width.is_constant())
    return section_of(section::Trapezoid{channel.width, channel.wall_height, Angle(), channel.thickness},
                      options);
  const double t = channel.thickness;
  const double inner = 0.5 * channel.width.narrowest();
  const double outer = inner + t;
  const double high = channel.wall_height;
  const bool beside = options.walls == WallSeat::beside_floor;
  const double low = lining_of(options);
  const double foot = (beside ? -t : 0.0) - low;
  const double edge = beside ? inner : outer;
  PlateSection section;
  section.plates = {{"left_wall", {inner, high}, {inner, foot}, {outer, high}, {outer, foot}},
                    {"floor", {edge, -low}, {-edge, -low}, {edge, -low - t}, {-edge, -low - t}},
                    {"right_wall", {-inner, foot}, {-inner, high}, {-outer, foot}, {-outer, high}}};
  section.thickness = t;
  section.convex = true;
  section.mitred = false;
  section.outside = {{outer, high}, {outer, -low - t}, {-outer, -low - t}, {-outer, high}};
  if (options.liner) section.lined = {{1, {inner, 0.0}, {-inner, 0.0}}};
  section.widths = changing(channel.width);
  return section;
}

std::optional<PlateSection> section_of(const section::HalfPipe& trough, const PlateOptions& options) {
  const double radius = 0.5 * trough.width;
  const int turns = turns_of(radius, kPi, options.stave_tolerance);
  std::vector<Vec2> chain = {{radius, radius + trough.wall_height}};
  for (const Vec2 corner : round_corners(radius, touches_of(0.5 * kPi, turns))) chain.push_back(corner);
  chain.push_back({-radius, radius + trough.wall_height});
  PlateSection section = of_chain(chain, trough.thickness, false);
  section.departure = miss_of(radius, kPi / turns);
  name_by_place(section, "stave");
  return lined(chain, std::move(section), options);
}

std::optional<PlateSection> section_of(const section::Pipe& pipe, const PlateOptions& options) {
  const double radius = 0.5 * pipe.inner_diameter;
  int count = 4;
  while (count < 360 && miss_of(radius, 2.0 * kPi / count) > options.stave_tolerance) ++count;
  std::vector<double> touches;
  for (int k = 0; k <= count; ++k) touches.push_back(-2.0 * kPi * k / count);
  const std::vector<Vec2> chain = round_corners(radius, touches);
  PlateSection section = of_chain(chain, pipe.thickness, true);
  section.departure = miss_of(radius, 2.0 * kPi / count);
  // Corners begin to the right of the lowest line: the last plate is the floor.
  name_by_place(section, "stave");
  return lined(chain, std::move(section), options);
}

std::optional<PlateSection> section_of(const section::VChannel& channel, const PlateOptions& options) {
  const double rise = 0.5 * kPi - 0.5 * channel.angle.radians();
  const int turns = turns_of(channel.bottom_radius, 2.0 * rise, options.stave_tolerance);
  const std::vector<Vec2> corners = round_corners(channel.bottom_radius, touches_of(rise, turns));
  const double half_sine = math::sin(0.5 * rise);
  const double foot = 2.0 * channel.bottom_radius * half_sine * half_sine;
  const double top = channel.bottom_radius * math::sin(rise) +
                     (channel.wall_height - foot) * math::cos(rise) / math::sin(rise);
  std::vector<Vec2> chain = {{top, channel.wall_height}};
  chain.insert(chain.end(), corners.begin(), corners.end());
  chain.push_back({-top, channel.wall_height});
  PlateSection section = of_chain(chain, channel.thickness, false);
  section.departure = miss_of(channel.bottom_radius, 2.0 * rise / turns);
  name_by_place(section, "stave");
  section.plates.front().name = "left_wall";
  section.plates.back().name = "right_wall";
  return lined(chain, std::move(section), options);
}

/// Where two lines meet.
Vec2 crossing(Vec2 a, Vec2 along_a, Vec2 b, Vec2 along_b) {
  return a + (cross(b - a, along_b) / cross(along_a, along_b)) * along_a;
}

/// Moves one side of a closed chain to its left, the sides beside it going on to it.
std::vector<Vec2> with_side_moved(std::vector<Vec2> chain, std::size_t side, double by) {
  const std::size_t count = chain.size();
  const Vec2 from = chain[side];
  const Vec2 to = chain[(side + 1) % count];
  const Vec2 moved = from + by * left_of(to - from);
  const Vec2 before = from - chain[(side + count - 1) % count];
  const Vec2 after = chain[(side + 2) % count] - to;
  chain[side] = crossing(moved, to - from, from, before);
  chain[(side + 1) % count] = crossing(moved, to - from, to, after);
  return chain;
}

/// @param outline  counter-clockwise
/// @return its corners from the left top below it to the right one: tops are the highest corners beside the floor line, the outermost
std::vector<Vec2> below_tops(const std::vector<Vec2>& outline) {
  constexpr double kLevel = 1e-9;  // [m]
  const std::size_t count = outline.size();
  // The floor line is the origin, on a side or at a corner, between two grooves inside the outline. It lies nearest to a side that
  // faces up: where the section is thin the underside may be nearer than the sides of the grooves.
  std::size_t first = 0;  // the corner before it, or that at it
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < count; ++i) {
    const Vec2 next = outline[(i + 1) % count];
    const double near = core::distance_to_segment({}, outline[i], next);
    if (!(next.x < outline[i].x - kLevel) || !(near < nearest)) continue;
    nearest = near;
    first = i;
  }
  double lowest = outline.front().y;
  for (const Vec2 corner : outline) lowest = std::min(lowest, corner.y);
  // Ahead of the floor line the outline goes down on the right.
  const auto top = [&](std::size_t from, std::size_t step) {
    std::size_t best = from;
    for (std::size_t i = from; outline[i].y > lowest + kLevel; i = (i + step) % count) {
      if (outline[i].y > outline[best].y - kLevel) best = i;
    }
    return best;
  };
  const std::size_t right = top((first + 1) % count, 1);
  const std::size_t left = top(first, count - 1);
  std::vector<Vec2> chain = {outline[left]};
  for (std::size_t i = left; i != right;) {
    i = (i + count - 1) % count;
    chain.push_back(outline[i]);
  }
  return chain;
}

/// Whether the side at an end of a chain is upright enough for what ends level with it.
bool steep(Vec2 top, Vec2 low) {
  constexpr double kSteepEnough = 0.2;  // height per length
  return top.y - low.y > kSteepEnough * norm(low - top);
}

void set_outside(const std::vector<Vec2>& outline, PlateSection& section) {
  section.outside = below_tops(outline);
  section.ring = false;
  section.inside_outline = true;
  const std::size_t count = section.outside.size();
  section.convex = count > 2 && turns_one_way(section.outside, false) &&
                   steep(section.outside[0], section.outside[1]) &&
                   steep(section.outside[count - 1], section.outside[count - 2]);
}

/// Plates inside the outline of a solid, one a side.
std::optional<PlateSection> round_outline(const section::Measures& measures, const PlateOptions& options) {
  const CrossSection whole(measures);
  const CrossSection::Polygon corners = whole.outline(1e-3);
  double area = 0.0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    area += cross(corners[i], corners[(i + 1) % corners.size()]);
  }
  std::vector<Vec2> chain(corners.begin(), corners.end());
  if (area < 0.0) std::reverse(chain.begin(), chain.end());
  // Corners in the middle of a side, such as the floor line, are none of a plate.
  std::vector<Vec2> kept;
  for (std::size_t i = 0; i < chain.size(); ++i) {
    const Vec2 in = chain[i] - chain[(i + chain.size() - 1) % chain.size()];
    const Vec2 out = chain[(i + 1) % chain.size()] - chain[i];
    if (std::fabs(cross(in, out)) > 1e-9 * norm(in) * norm(out)) kept.push_back(chain[i]);
  }
  PlateSection section = of_chain(kept, options.polygon_thickness.value_or(4e-3), true);
  set_outside(kept, section);
  name_by_place(section, "side");
  for (std::size_t i = 0; options.liner && i < section.plates.size(); ++i) {
    if (section.plates[i].name != "floor") continue;
    // Below the liner's tiles, which lie inside the outline.
    PlateSection below = of_chain(with_side_moved(kept, i, lining_of(options)), section.thickness, true);
    for (std::size_t k = 0; k < below.plates.size(); ++k) below.plates[k].name = section.plates[k].name;
    below.lined = {{i, section.plates[i].face_from, section.plates[i].face_to}};
    set_outside(with_side_moved(kept, i, lining_of(options)), below);
    return below;
  }
  return section;
}

std::optional<PlateSection> section_of(const section::Polygon& polygon, const PlateOptions& options) {
  return round_outline(polygon, options);
}

std::optional<PlateSection> section_of(const section::TrackGroove& track, const PlateOptions& options) {
  if (!track.width.is_constant()) return std::nullopt;
  return round_outline(track, options);
}

std::optional<PlateSection> section_of(const section::Slab& slab, const PlateOptions& options) {
  if (!slab.width.is_constant() && slab.curb_height > 0.0) return std::nullopt;
  const double half = 0.5 * slab.width.narrowest() + slab.curb_width;
  const double low = lining_of(options);
  PlateSection section = of_chain({{half, -low}, {-half, -low}}, slab.thickness, false);
  if (options.liner) section.lined = {{0, {half, 0.0}, {-half, 0.0}}};
  section.plates[0].name = "floor";
  section.widths = changing(slab.width);
  return section;
}

}  // namespace

std::optional<PlateSection> plate_section(const section::Measures& measures, const PlateOptions& options) {
  auto section = std::visit([&](const auto& one) { return section_of(one, options); }, measures);
  if (!section) return section;
  section->lowest = std::numeric_limits<double>::infinity();
  section->highest = -section->lowest;
  for (const SectionPlate& plate : section->plates) {
    for (const Vec2 corner : {plate.face_from, plate.face_to, plate.back_from, plate.back_to}) {
      section->lowest = std::min(section->lowest, corner.y);
      section->highest = std::max(section->highest, corner.y);
    }
  }
  return section;
}

bool SectionPlate::ends_at_floor() const {
  constexpr double kLevel = 1e-9;  // rounding: of heights that are one [m]
  const Vec2 from = middle_from();
  const Vec2 to = middle_to();
  const double nearer = std::fabs(from.y) - std::fabs(to.y);
  return std::fabs(nearer) > kLevel ? nearer > 0.0 : std::fabs(to.x) <= std::fabs(from.x) + kLevel;
}

PlateSection PlateSection::of_unit(std::size_t unit) const {
  PlateSection one = *this;
  one.plates = plates_of(unit);
  one.staggered.clear();
  return one;
}

}  // namespace glissade::parts
