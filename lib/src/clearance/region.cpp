#include "clearance/region.hpp"

#include "glissade/core/math.hpp"

#include "core/float_limits.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace glissade::clearance {
namespace {

constexpr std::size_t kEdgesOfLeaf = 4;

Vec2 nearest_of_segment(Vec2 point, Vec2 from, Vec2 to) {
  const Vec2 along = to - from;
  const double square = dot(along, along);
  if (square == 0.0) return from;
  return from + std::clamp(dot(point - from, along) / square, 0.0, 1.0) * along;
}

bool cross_each_other(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  const auto opposite = [](double first, double second) {
    return (first >= 0.0 && second <= 0.0) || (first <= 0.0 && second >= 0.0);
  };
  const double c_side = cross(b - a, c - a);
  const double d_side = cross(b - a, d - a);
  if (c_side == 0.0 && d_side == 0.0) return false;  // along one line: their ends tell the distance
  return opposite(c_side, d_side) && opposite(cross(d - c, a - c), cross(d - c, b - c));
}

/// Of two segments that do not cross, some end is nearest.
Nearest between_segments(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  Nearest nearest;
  const auto see = [&](Vec2 on_first, Vec2 on_second) {
    const double distance = norm(on_second - on_first);
    if (distance < nearest.value) nearest = {distance, on_first};
  };
  see(a, nearest_of_segment(a, c, d));
  see(b, nearest_of_segment(b, c, d));
  see(nearest_of_segment(c, a, b), c);
  see(nearest_of_segment(d, a, b), d);
  if (nearest.value > 0.0 && cross_each_other(a, b, c, d)) {
    const double share = cross(c - a, d - c) / cross(b - a, d - c);
    nearest = {0.0, a + std::clamp(share, 0.0, 1.0) * (b - a)};
  }
  return nearest;
}

/// @return whether a point lies within a convex polygon, of either winding
bool within_convex(Vec2 point, std::span<const Vec2> shape) {
  bool left = false;
  bool right = false;
  for (std::size_t i = 0; i < shape.size(); ++i) {
    const double side = cross(shape[(i + 1) % shape.size()] - shape[i], point - shape[i]);
    left = left || side > 0.0;
    right = right || side < 0.0;
  }
  return !(left && right);
}

/// @return the runs of some corners, ascending, each once
std::vector<double> runs_of(const std::vector<Vec2>& corners) {
  std::vector<double> runs;
  for (const Vec2 corner : corners) runs.push_back(corner.x);
  std::sort(runs.begin(), runs.end());
  runs.erase(std::unique(runs.begin(), runs.end()), runs.end());
  return runs;
}

/// @return the part of a segment between two runs, ascending; nothing where it does not reach from one to the other
std::optional<std::pair<Vec2, Vec2>> between_runs(Vec2 from, Vec2 to, double low, double high) {
  if (from.x > to.x) std::swap(from, to);
  if (!(from.x <= low && to.x >= high)) return std::nullopt;
  const auto at = [&](double run) {
    if (run == to.x) return to;
    return Vec2{run, from.y + (to.y - from.y) * (run - from.x) / (to.x - from.x)};
  };
  return std::pair{at(low), at(high)};
}

Nearest between(std::span<const Vec2> shape, Vec2 from, Vec2 to) {
  if (shape.size() == 1) {
    return {norm(nearest_of_segment(shape[0], from, to) - shape[0]), shape[0]};
  }
  Nearest nearest;
  const std::size_t sides = shape.size() == 2 ? 1 : shape.size();
  for (std::size_t i = 0; i < sides; ++i) {
    const Nearest side = between_segments(shape[i], shape[(i + 1) % shape.size()], from, to);
    if (side.value < nearest.value) nearest = side;
  }
  if (nearest.value > 0.0 && shape.size() > 2 && within_convex(from, shape)) nearest = {0.0, from};
  return nearest;
}

}  // namespace

Region Region::area(const std::vector<Vec2>& outline, Pass pass) {
  Region region(Kind::area);
  region.pass_ = pass;
  region.add_edges(outline, true);
  if (pass == Pass::either) {
    region.add_inside(outline);
  } else {
    region.add_profile(outline, pass == Pass::above ? 1.0 : -1.0);
  }
  return region;
}

Region Region::line(const std::vector<Vec2>& line, bool above) {
  Region region(Kind::line);
  region.add_edges(line, false);
  region.add_behind(region.edges_, above ? 1.0 : -1.0);
  return region;
}

Region Region::half_plane(Vec2 point, Vec2 forbidden) {
  Region region(Kind::half_plane);
  region.edges_ = {{point, point}};
  region.forbidden_ = (1.0 / norm(forbidden)) * forbidden;
  return region;
}

void Region::add_edges(const std::vector<Vec2>& corners, bool closed) {
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) edges_.push_back({corners[i], corners[i + 1]});
  if (closed) edges_.push_back({corners.back(), corners.front()});
  std::size_t leaves = 1;
  while (leaves * kEdgesOfLeaf < edges_.size()) leaves *= 2;
  boxes_.resize(2 * leaves);
  build_boxes(1, 0, edges_.size());
}

// What lies within an outline: between two runs at which it has corners, every other gap between its edges.
void Region::add_inside(const std::vector<Vec2>& outline) {
  const std::vector<double> runs = runs_of(outline);
  std::vector<Edge> across;
  for (std::size_t i = 0; i + 1 < runs.size(); ++i) {
    across.clear();
    for (const Edge& edge : edges_) {
      if (const auto part = between_runs(edge.from, edge.to, runs[i], runs[i + 1])) {
        across.push_back({part->first, part->second});
      }
    }
    std::sort(across.begin(), across.end(),
              [](const Edge& a, const Edge& b) { return a.from.y + a.to.y < b.from.y + b.to.y; });
    for (std::size_t k = 0; k + 1 < across.size(); k += 2) pieces_.push_back({across[k], across[k + 1]});
  }
}

// The upper (least drop) or lower side of an outline: between two runs at which it has corners, one edge of it
// is the outermost all the way.
void Region::add_profile(const std::vector<Vec2>& outline, double side) {
  const std::vector<double> runs = runs_of(outline);
  std::vector<Edge> profile;
  for (std::size_t i = 0; i + 1 < runs.size(); ++i) {
    double extreme = core::kInfinity;
    Edge outermost;
    for (const Edge& edge : edges_) {
      const auto part = between_runs(edge.from, edge.to, runs[i], runs[i + 1]);
      if (!part) continue;
      const double middle = side * 0.5 * (part->first.y + part->second.y);
      if (middle >= extreme) continue;
      extreme = middle;
      outermost = {part->first, part->second};
    }
    if (extreme < core::kInfinity) profile.push_back(outermost);
  }
  add_behind(profile, side);
}

void Region::add_behind(const std::vector<Edge>& profile, double side) {
  side_ = side;
  for (const Edge& edge : profile) {
    if (edge.from.x == edge.to.x) continue;
    const double far = side * core::kInfinity;
    const Edge beyond{{edge.from.x, far}, {edge.to.x, far}};
    pieces_.push_back(side > 0.0 ? Piece{edge, beyond} : Piece{beyond, edge});
    if (kind_ == Kind::area) {
      const double slope = (edge.to.y - edge.from.y) / (edge.to.x - edge.from.x);
      steepness_ = std::max(steepness_, math::hypot(1.0, slope));
    }
  }
  if (profile.empty()) return;
  jumps_.push_back(profile.front().from.x);
  for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
    if (!(profile[i].to == profile[i + 1].from)) jumps_.push_back(profile[i].to.x);
  }
  jumps_.push_back(profile.back().to.x);
}

bool Region::jumps_within(double low_run, double high_run) const {
  const auto next = std::lower_bound(jumps_.begin(), jumps_.end(), low_run);
  return next != jumps_.end() && *next <= high_run;
}

// A tree over the edges in their order: neighbours along an outline are neighbours in space.
void Region::build_boxes(std::size_t node, std::size_t begin, std::size_t end) {
  Box box{{core::kInfinity, core::kInfinity}, {-core::kInfinity, -core::kInfinity}};
  for (std::size_t i = begin; i < end; ++i) {
    for (const Vec2 p : {edges_[i].from, edges_[i].to}) {
      box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y)};
      box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y)};
    }
  }
  boxes_[node] = box;
  if (end - begin <= kEdgesOfLeaf || 2 * node + 1 >= boxes_.size()) return;
  const std::size_t middle = begin + (end - begin) / 2;
  build_boxes(2 * node, begin, middle);
  build_boxes(2 * node + 1, middle, end);
}

void Region::search(std::size_t node, std::size_t begin, std::size_t end, std::span<const Vec2> shape,
                    const Box& around, Found& nearest) const {
  const auto apart = [&](const Box& box) {
    return math::hypot(std::max({box.low.x - around.high.x, 0.0, around.low.x - box.high.x}),
                       std::max({box.low.y - around.high.y, 0.0, around.low.y - box.high.y}));
  };
  if (end - begin <= kEdgesOfLeaf || 2 * node + 1 >= boxes_.size()) {
    for (std::size_t i = begin; i < end; ++i) {
      const Nearest here = between(shape, edges_[i].from, edges_[i].to);
      if (here.value < nearest.value) nearest = {here, i};
    }
    return;
  }
  const std::size_t middle = begin + (end - begin) / 2;
  const double first = apart(boxes_[2 * node]);
  const double second = apart(boxes_[2 * node + 1]);
  for (const bool take_first : {first <= second, first > second}) {
    if ((take_first ? first : second) >= nearest.value) continue;
    if (take_first) {
      search(2 * node, begin, middle, shape, around, nearest);
    } else {
      search(2 * node + 1, middle, end, shape, around, nearest);
    }
  }
}

Region::Found Region::nearest_edge(std::span<const Vec2> shape) const {
  Box around{shape[0], shape[0]};
  for (const Vec2 p : shape) {
    around.low = {std::min(around.low.x, p.x), std::min(around.low.y, p.y)};
    around.high = {std::max(around.high.x, p.x), std::max(around.high.y, p.y)};
  }
  Found nearest;
  search(1, 0, edges_.size(), shape, around, nearest);
  return nearest;
}

void Region::meet(std::size_t node, std::size_t begin, std::size_t end, Vec2 from, Vec2 to,
                  std::vector<Crossing>& found) const {
  const Box& box = boxes_[node];
  if (std::min(from.x, to.x) > box.high.x || std::max(from.x, to.x) < box.low.x ||
      std::min(from.y, to.y) > box.high.y || std::max(from.y, to.y) < box.low.y) {
    return;
  }
  if (end - begin > kEdgesOfLeaf && 2 * node + 1 < boxes_.size()) {
    const std::size_t middle = begin + (end - begin) / 2;
    meet(2 * node, begin, middle, from, to, found);
    meet(2 * node + 1, middle, end, from, to, found);
    return;
  }
  for (std::size_t i = begin; i < end; ++i) {
    const Edge& edge = edges_[i];
    if (!cross_each_other(from, to, edge.from, edge.to)) continue;
    const Vec2 along = edge.to - edge.from;
    const double area = cross(to - from, along);
    if (area == 0.0) continue;
    found.push_back({std::clamp(cross(edge.from - from, along) / area, 0.0, 1.0), i});
  }
}

std::vector<Region::Crossing> Region::crossings(Vec2 from, Vec2 to) const {
  std::vector<Crossing> found;
  if (kind_ == Kind::half_plane) return found;
  meet(1, 0, edges_.size(), from, to, found);
  std::stable_sort(found.begin(), found.end(),
                   [](const Crossing& a, const Crossing& b) { return a.share < b.share; });
  return found;
}

std::vector<Vec2> Region::corners() const {
  std::vector<Vec2> corners;
  if (kind_ == Kind::half_plane) return corners;
  for (const Edge& edge : edges_) corners.push_back(edge.from);
  if (kind_ == Kind::line) corners.push_back(edges_.back().to);
  return corners;
}

std::vector<std::vector<Vec2>> Region::cut_off(std::size_t entered, std::size_t left) const {
  if (kind_ == Kind::half_plane || (kind_ == Kind::area && pass_ != Pass::either)) return {};
  const std::size_t first = std::min(entered, left);
  const std::size_t last = std::max(entered, left);
  std::vector<Vec2> between;
  for (std::size_t i = first; i < last; ++i) between.push_back(edges_[i].to);
  if (kind_ == Kind::line) return {between};
  std::vector<Vec2> others;
  for (std::size_t i = last; i < edges_.size() + first; ++i) others.push_back(edges_[i % edges_.size()].to);
  return {between, others};
}

double Region::distance(Vec2 point, std::size_t edge) const {
  return norm(nearest_of_segment(point, edges_[edge].from, edges_[edge].to) - point);
}

Nearest Region::nearest(std::span<const Vec2> shape) const {
  if (kind_ == Kind::half_plane) {
    Nearest nearest;
    for (const Vec2 p : shape) {
      const double value = dot(edges_[0].from - p, forbidden_);
      if (value < nearest.value) nearest = {value, p};
    }
    return nearest;
  }
  const Depth depth = deepest(shape);
  if (depth.told) return {-depth.value, depth.point};
  return nearest_edge(shape);
}

// A larger shape has no larger value: that of all within the distance bounds that of each, be it where the value jumps.
double Region::lower_bound(std::span<const Vec2> shape, double distance) const {
  if (kind_ == Kind::half_plane) return nearest(shape).value - distance;
  const Depth depth = deepest(grown(shape, distance));
  if (depth.at_most > 0.0) return -depth.at_most;
  return std::max(0.0, nearest_edge(shape).value - distance);
}

}  // namespace glissade::clearance
