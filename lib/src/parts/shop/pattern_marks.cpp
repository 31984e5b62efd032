#include "parts/shop/pattern_marks.hpp"

#include "core/arc_pieces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace glissade::parts {
namespace {

constexpr std::array<double, 3> kNumberHeights = {20e-3, 14e-3, 10e-3};  // taste [m]
constexpr double kLeastPlate = 40e-3;  // taste: narrower ones are told apart by their shapes [m]
constexpr double kDigit = 0.77;  // of the height: the widest digit of stroked text, and the space after it
constexpr double kClear = 0.1;   // taste, of the height: from strokes to cuts

/// Whether a box with all that is near it lies on the plate.
bool lies_on(const PlaneRegion& region, const PlaneBox& box, double clear) {
  const ArcPath edges = rectangle(box.low, box.high);
  const Vec2 middle = 0.5 * (box.low + box.high);
  if (!contains(region.outline, middle) || distance(region.outline, edges) < clear) return false;
  const bool cut = std::any_of(region.cutouts.begin(), region.cutouts.end(), [&](const ArcPath& cutout) {
    return contains(cutout, middle) || contains(edges, cutout.vertices.front().at) ||
           distance(cutout, edges) < clear;
  });
  if (cut) return false;
  return std::none_of(region.holes.begin(), region.holes.end(), [&](const Circle& hole) {
    const Vec2 nearest{std::clamp(hole.centre.x, box.low.x, box.high.x),
                       std::clamp(hole.centre.y, box.low.y, box.high.y)};
    return norm(nearest - hole.centre) < hole.radius + clear;
  });
}

/// Whether a sheet is bent within a box, or as near to it.
bool is_bent(const std::vector<BendLine>& bends, const PlaneBox& box, double clear) {
  const ArcPath edges = rectangle(box.low, box.high);
  return std::any_of(bends.begin(), bends.end(), [&](const BendLine& bend) {
    const ArcPath line{{{bend.from, 0.0}, {bend.to, 0.0}}};
    const double half_bent = 0.5 * bend.angle.radians() * bend.inner_radius;
    return contains(edges, 0.5 * (bend.from + bend.to)) || distance(line, edges) < half_bent + clear;
  });
}

bool on_plate(const PlaneRegion& region, Vec2 point) {
  return contains(region.outline, point) &&
         std::none_of(region.cutouts.begin(), region.cutouts.end(),
                      [&](const ArcPath& cutout) { return contains(cutout, point); }) &&
         std::none_of(region.holes.begin(), region.holes.end(),
                      [&](const Circle& hole) { return norm(point - hole.centre) < hole.radius; });
}

/// Whether a bend line crosses an upright between two heights.
bool is_bent_between(const std::vector<BendLine>& bends, double x, double low, double high) {
  return std::any_of(bends.begin(), bends.end(), [&](const BendLine& bend) {
    const Vec2 way = bend.to - bend.from;
    const double share = way.x == 0.0 ? -1.0 : (x - bend.from.x) / way.x;
    const double y = bend.from.y + share * way.y;
    return share >= 0.0 && share <= 1.0 && y > low && y <= high;
  });
}

/// The middles of what uprights through a plate have of it between bends, outwards from the middle one.
std::vector<Vec2> middles_of(const PlaneRegion& region, const std::vector<BendLine>& bends) {
  constexpr int kColumns = 24;  // budget, on either side of the middle
  constexpr int kSteps = 64;    // budget, up an upright
  const PlaneBox box = bounds(region.outline);
  std::vector<Vec2> places;
  const double step = box.height() / kSteps;
  const auto add_column = [&](double x) {
    int first = -1;
    for (int i = 0; i <= kSteps; ++i) {
      const double y = box.low.y + (i + 0.5) * step;
      const bool inside = i < kSteps && on_plate(region, {x, y});
      const bool ends = first >= 0 && (!inside || is_bent_between(bends, x, y - step, y));
      if (ends) places.push_back({x, box.low.y + 0.5 * (first + i) * step});
      if (!inside)
        first = -1;
      else if (first < 0 || ends)
        first = i;
    }
  };
  const double middle = 0.5 * (box.low.x + box.high.x);
  add_column(middle);
  for (int k = 1; k < kColumns; ++k) {
    for (const double side : {-1.0, 1.0}) add_column(middle + side * 0.5 * box.width() * k / kColumns);
  }
  return places;
}

/// The longest stretch of a line on the plate, as shares of the line.
struct Stretch {
  double from = 0.0;
  double to = 0.0;
};

/// Along an edge, just within it counts.
bool beside(const ArcPath& outline, Vec2 point, Vec2 across) {
  return contains(outline, point + across) || contains(outline, point - across);
}

std::optional<Stretch> longest_inside(const ArcPath& outline, Vec2 from, Vec2 to) {
  constexpr double kNear = 1e-6;  // accuracy: of what lies on an edge [m]
  const Vec2 way = to - from;
  const double whole = norm(way);
  if (!(whole > kNear)) return {};
  const Vec2 across = (kNear / whole) * Vec2{-way.y, way.x};
  std::vector<double> shares = {0.0, 1.0};
  const auto see = [&](Vec2 point) {
    const double share = dot(point - from, way) / (whole * whole);
    if (share > 0.0 && share < 1.0) shares.push_back(share);
  };
  for (const PathPiece& piece : pieces_of(outline)) {
    for (const Vec2 point : core::meetings({from, to, 0.0}, piece)) see(point);
    if (std::fabs(dot(piece.from - from, across)) < kNear * kNear) see(piece.from);
  }
  std::sort(shares.begin(), shares.end());
  std::optional<Stretch> longest;
  std::optional<Stretch> now;
  for (std::size_t k = 0; k + 1 < shares.size(); ++k) {
    // What is shorter than the nearness goes with what is before it.
    if ((shares[k + 1] - shares[k]) * whole > kNear) {
      const Vec2 middle = from + 0.5 * (shares[k] + shares[k + 1]) * way;
      if (!beside(outline, middle, across)) {
        now.reset();
        continue;
      }
    }
    now = Stretch{now ? now->from : shares[k], shares[k + 1]};
    if (!longest || now->to - now->from > longest->to - longest->from) longest = now;
  }
  if (longest && (longest->to - longest->from) * whole <= kNear) longest.reset();
  return longest;
}

template <typename Line>
void clip(const ArcPath& outline, Line& line) {
  const auto stretch = longest_inside(outline, line.from, line.to);
  if (!stretch) return;
  const Vec2 from = line.from;
  const Vec2 way = line.to - line.from;
  if (stretch->from > 0.0) line.from = from + stretch->from * way;
  if (stretch->to < 1.0) line.to = from + stretch->to * way;
}

}  // namespace

void set_number_place(FlatPattern& pattern, int number) {
  pattern.number_at.reset();
  pattern.number_height = 0.0;
  const PlaneBox box = bounds(pattern.region.outline);
  if (std::min(box.width(), box.height()) < kLeastPlate) return;
  const double digits = std::max(2.0, static_cast<double>(std::to_string(number).size()));
  std::vector<Vec2> places;
  const auto fits = [&](Vec2 corner, double height, bool on_bends) {
    const PlaneBox around{corner, corner + Vec2{digits * kDigit * height, height}};
    if (!lies_on(pattern.region, around, kClear * height)) return false;
    if (!on_bends && is_bent(pattern.bends, around, kClear * height)) return false;
    pattern.number_at = corner;
    pattern.number_height = height;
    return true;
  };
  const auto is_placed = [&](double height, bool on_bends) {
    // Beside the outline's middle, where bands are widest.
    if (fits(0.5 * (box.low + box.high) - height * Vec2{1.5, 0.5}, height, on_bends)) return true;
    if (places.empty()) places = middles_of(pattern.region, pattern.bends);
    const Vec2 half = 0.5 * height * Vec2{digits * kDigit, 1.0};
    return std::any_of(places.begin(), places.end(),
                       [&](Vec2 place) { return fits(place - half, height, on_bends); });
  };
  // A number across a bend can be read, too, if the sheet is bent all over.
  for (const bool on_bends : {false, true}) {
    if (on_bends && pattern.bends.empty()) return;
    for (const double height : kNumberHeights) {
      if (is_placed(height, on_bends)) return;
    }
  }
}

void clip_lines(FlatPattern& pattern) {
  for (BendLine& bend : pattern.bends) clip(pattern.region.outline, bend);
  for (RollLine& roll : pattern.rolls) clip(pattern.region.outline, roll);
}

}  // namespace glissade::parts
