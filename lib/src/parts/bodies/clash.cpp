#include "parts/bodies/clash.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/number_text.hpp"

#include "parts/bodies/body_depth.hpp"
#include "parts/bodies/body_edges.hpp"
#include "parts/bodies/placed_piece.hpp"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace glissade::parts {
namespace {

constexpr double kInset = 20e-6;  // from a part's edges to the points that are looked for in others [m]
constexpr double kDeep = 10e-6;   // inside another part that counts as a clash [m]
constexpr double kFar = 1e300;

/// One piece in space, for looking into.
struct Box {
  Vec3 low{kFar, kFar, kFar};
  Vec3 high{-kFar, -kFar, -kFar};

  void widen(Vec3 point) {
    low = {std::min(low.x, point.x), std::min(low.y, point.y), std::min(low.z, point.z)};
    high = {std::max(high.x, point.x), std::max(high.y, point.y), std::max(high.z, point.z)};
  }
  [[nodiscard]] bool meets(const Box& other, double margin) const {
    return other.low.x <= high.x + margin && low.x <= other.high.x + margin &&
           other.low.y <= high.y + margin && low.y <= other.high.y + margin &&
           other.low.z <= high.z + margin && low.z <= other.high.z + margin;
  }
};

constexpr double kMargin = 1e-3;  // of boxes round points that lie just inside

struct PlacedShape {
  const ShopPart* part = nullptr;
  Frame place;
  std::vector<Vec3> points;
  Box box;
  Box own;  ///< in its own frame, where a thin plate that leans is thin
  std::vector<EdgeLine> lines = {};
};

std::vector<PlacedShape> pieces_in_space(const Workshop& workshop) {
  std::vector<PlacedShape> pieces;
  for (const ShopPart& part : workshop.parts) {
    const std::vector<Vec3> own = edge_points(part.body, kInset);
    Box box;
    for (const Vec3 local : own) box.widen(local);
    const std::vector<EdgeLine> lines = edge_lines(part.body, kInset);
    for (const Frame& place : part.places) {
      PlacedShape piece{&part, place, {}, {}, box};
      for (const EdgeLine& line : lines)
        piece.lines.push_back({place.to_space(line.from), place.to_space(line.to)});
      for (const Vec3 local : own) {
        piece.points.push_back(place.to_space(local));
        piece.box.widen(piece.points.back());
      }
      pieces.push_back(std::move(piece));
    }
  }
  return pieces;
}

[[noreturn]] void tell_clash(const PlacedShape& a, const PlacedShape& b, double depth) {
  throw InternalError(
      {"", "parts clash: " + a.part->name + " reaches " + length_text(depth, 3) + " into " + b.part->name, "",
       "another design, and a report of this one"});
}

/// Along an edge, in steps that the distance from the other part allows: nothing thicker than half a plate is stepped over.
void require_apart(const PlacedShape& a, const EdgeLine& line, const PlacedShape& b) {
  const Vec3 from = in_own(b.place, line.from);
  const Vec3 way = in_own(b.place, line.to) - from;
  const double whole = norm(way);
  Box box;
  box.widen(from);
  box.widen(from + way);
  if (!(whole > 0.0) || !b.own.meets(box, kMargin)) return;
  constexpr double kLeastStep = 0.5e-3;
  const double step = std::max(kLeastStep, 0.5 * b.part->thickness);
  for (double at = 0.0; at < whole;) {
    const double depth = depth_inside(b.part->body, from + (at / whole) * way);
    if (depth > kInset + kDeep) tell_clash(a, b, depth);
    at += std::max(step, -depth);
  }
}

/// Points and edges of one piece inside another.
void require_apart(const PlacedShape& a, const PlacedShape& b) {
  for (const EdgeLine& line : a.lines) require_apart(a, line, b);
  for (const Vec3 point : a.points) {
    if (!b.box.meets({point, point}, kMargin)) continue;
    const Vec3 own = in_own(b.place, point);
    if (!b.own.meets({own, own}, kMargin)) continue;
    const double depth = depth_inside(b.part->body, own);
    if (depth <= kInset + kDeep) continue;
    tell_clash(a, b, depth);
  }
}

}  // namespace

std::size_t require_no_clash(const Workshop& workshop) {
  const std::vector<PlacedShape> pieces = pieces_in_space(workshop);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    for (std::size_t k = 0; k < pieces.size(); ++k) {
      if (k != i && pieces[k].box.meets(pieces[i].box, kMargin)) require_apart(pieces[i], pieces[k]);
    }
  }
  return pieces.size() * (pieces.size() - 1) / 2;
}

}  // namespace glissade::parts
