// How deep a convex shape reaches into a region. What is forbidden lies in convex pieces, and so does the part of the
// shape in each of them. Over a piece depth is the least of distances from edges. Distances are convex: over a triangle
// each is no more than the linear one with its values at the corners, and the highest place of the lowest of those bounds
// the depth from above, exactly where they are linear, else by the square of the triangle's size. Triangles whose bound
// says more than is found are halved.

#include "clearance/convex.hpp"
#include "clearance/region.hpp"
#include "core/float_limits.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace glissade::clearance {
namespace {

constexpr double kRounding = 16.0 * core::kEpsilon;  // rounding: of a distance, as a share of the coordinates
constexpr std::size_t kMostEdges = 6;                // taste: bounds of one triangle before it is halved
constexpr int kMostHalvings = 60;                    // rounding: a triangle by 2^30 either way is a point
constexpr int kMostTriangles = 20000;                // budget: of one shape; random ones ask for some 100

/// A triangle, or a segment.
struct Simplex {
  std::array<Vec2, 3> corners;
  std::size_t size = 3;

  [[nodiscard]] Vec2 at(Vec2 share) const {
    Vec2 point = corners[0] + share.x * (corners[1] - corners[0]);
    if (size == 3) point = point + share.y * (corners[2] - corners[0]);
    return point;
  }
};

/// The distance from one edge at the corners of a simplex, linear in between.
struct Bound {
  std::size_t edge = 0;
  std::array<double, 3> at{};

  [[nodiscard]] double operator()(Vec2 share) const {
    return at[0] + share.x * (at[1] - at[0]) + share.y * (at[2] - at[0]);
  }
};

struct Highest {
  double value = -core::kInfinity;
  Vec2 share;
};

/// The highest place of the lowest of some bounds: where one is the lowest is a convex part, and a corner of that its highest.
Highest highest_of(const std::vector<Bound>& bounds, std::size_t size) {
  constexpr std::array<Vec2, 3> kCorners{Vec2{0.0, 0.0}, Vec2{1.0, 0.0}, Vec2{0.0, 1.0}};
  Highest highest;
  for (const Bound& lowest : bounds) {
    Convex part(kCorners.begin(), kCorners.begin() + static_cast<std::ptrdiff_t>(size));
    for (const Bound& other : bounds) {
      if (&other == &lowest || part.empty()) continue;
      part = clipped_by(part, [&](Vec2 share) { return other(share) - lowest(share); });
    }
    for (const Vec2 share : part) {
      if (lowest(share) > highest.value) highest = {lowest(share), share};
    }
  }
  return highest;
}

}  // namespace

/// The deepest place found so far.
struct Region::Sounding {
  const Region& region;
  double rounding;
  Depth depth;
  int triangles = 0;

  [[nodiscard]] Found see(Vec2 point);
  void sound(const Convex& part);
  void sound(const Simplex& simplex, int halvings);
  [[nodiscard]] bool settled(double most) const {
    return most <= depth.value + std::max(rounding, kRegionDepthAccuracy * depth.value);
  }
};

Region::Found Region::Sounding::see(Vec2 point) {
  const Found found = region.nearest_edge({&point, 1});
  if (found.value > depth.value) {
    depth.value = found.value;
    depth.point = point;
  }
  return found;
}

void Region::Sounding::sound(const Convex& part) {
  if (part.size() == 1) (void)see(part[0]);
  if (part.size() == 2) sound({{part[0], part[1], part[1]}, 2}, 0);
  for (std::size_t i = 1; i + 1 < part.size(); ++i) sound({{part[0], part[i], part[i + 1]}, 3}, 0);
}

void Region::Sounding::sound(const Simplex& simplex, int halvings) {
  std::vector<Bound> bounds;
  const auto add = [&](std::size_t edge) {
    const auto same = [&](const Bound& bound) { return bound.edge == edge; };
    if (bounds.size() == kMostEdges || std::any_of(bounds.begin(), bounds.end(), same)) return false;
    Bound bound{edge, {}};
    for (std::size_t i = 0; i < simplex.size; ++i) bound.at[i] = region.distance(simplex.corners[i], edge);
    if (simplex.size == 2) bound.at[2] = bound.at[0];
    bounds.push_back(bound);
    return true;
  };
  for (std::size_t i = 0; i < simplex.size; ++i) add(see(simplex.corners[i]).edge);
  double most = core::kInfinity;
  bool added = true;
  while (added) {
    const Highest highest = highest_of(bounds, simplex.size);
    most = std::min(most, highest.value);
    if (settled(most)) return;
    added = add(see(simplex.at(highest.share)).edge);
    if (settled(most)) return;
  }
  if (halvings == kMostHalvings || ++triangles > kMostTriangles) {
    depth.at_most = std::max(depth.at_most, most);
    return;
  }
  std::size_t longest = 0;
  double length = -1.0;
  for (std::size_t i = 0; i < (simplex.size == 2 ? 1 : 3); ++i) {
    const double side = norm(simplex.corners[(i + 1) % 3] - simplex.corners[i]);
    if (side > length) {
      length = side;
      longest = i;
    }
  }
  const Vec2 a = simplex.corners[longest];
  const Vec2 b = simplex.corners[(longest + 1) % 3];
  const Vec2 opposite = simplex.corners[(longest + 2) % 3];
  const Vec2 middle = a + 0.5 * (b - a);
  sound({{a, middle, simplex.size == 2 ? middle : opposite}, simplex.size}, halvings + 1);
  sound({{middle, b, simplex.size == 2 ? b : opposite}, simplex.size}, halvings + 1);
}

Region::Depth Region::deepest(std::span<const Vec2> shape) const {
  Vec2 low = shape[0];
  Vec2 high = shape[0];
  for (const Vec2 p : shape) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  const double most = std::max({std::fabs(low.x), std::fabs(low.y), std::fabs(high.x), std::fabs(high.y)});
  Sounding sounding{*this, kRounding * most, {}};
  const bool upright = kind_ == Kind::area && side_ != 0.0;
  auto piece = std::lower_bound(pieces_.begin(), pieces_.end(), low.x,
                                [](const Piece& at, double run) { return at.upper.to.x < run; });
  for (; piece != pieces_.end() && piece->upper.from.x <= high.x; ++piece) {
    if (std::min(piece->upper.from.y, piece->upper.to.y) > high.y) continue;
    if (std::max(piece->lower.from.y, piece->lower.to.y) < low.y) continue;
    const Convex part = piece->part_of(shape);
    if (!upright) {
      sounding.sound(part);
      continue;
    }
    const Edge& side = side_ > 0.0 ? piece->upper : piece->lower;
    for (const Vec2 corner : part) {
      const double share = (corner.x - side.from.x) / (side.to.x - side.from.x);
      const double behind = side_ * (corner.y - side.from.y - share * (side.to.y - side.from.y));
      if (behind > sounding.depth.value) sounding.depth = {behind, behind, false, corner};
    }
  }
  Depth& depth = sounding.depth;
  depth.at_most = std::max(depth.at_most, depth.value);
  if (!upright && depth.at_most > 0.0) {
    depth.at_most += std::max(sounding.rounding, kRegionDepthAccuracy * depth.value);
  }
  depth.told = depth.value > sounding.rounding;
  return depth;
}

Convex Region::Piece::part_of(std::span<const Vec2> shape) const {
  const auto below = [](const Edge& edge) { return Vec2{edge.from.y - edge.to.y, edge.to.x - edge.from.x}; };
  Convex part = clipped_by(shape, [&](Vec2 point) { return point.x - upper.from.x; });
  part = clipped_by(part, [&](Vec2 point) { return upper.to.x - point.x; });
  if (std::isfinite(upper.from.y)) part = clipped(part, upper.from, below(upper));
  if (std::isfinite(lower.from.y)) part = clipped(part, lower.from, -1.0 * below(lower));
  return part;
}

}  // namespace glissade::clearance
