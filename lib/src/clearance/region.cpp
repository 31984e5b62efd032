#include "clearance/region.hpp"

#include "glissade/core/math.hpp"

#include "core/float_limits.hpp"

#include <algorithm>
#include <cmath>

namespace glissade::clearance {
namespace {

constexpr std::size_t kEdgesOfLeaf = 4;
// Steps along a piece within an area at which its depth is measured.
constexpr int kDepthSamples = 8;

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
  if (pass != Pass::either) region.add_profile(outline, pass == Pass::above ? 1.0 : -1.0);
  return region;
}

Region Region::line(const std::vector<Vec2>& line, bool above) {
  Region region(Kind::line);
  region.add_edges(line, false);
  region.profile_ = region.edges_;
  region.side_ = above ? 1.0 : -1.0;
  region.add_jumps();
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

// The upper (least drop) or lower side of an outline: between two runs at which it has corners, one edge of it
// is the outermost all the way.
void Region::add_profile(const std::vector<Vec2>& outline, double side) {
  side_ = side;
  std::vector<double> runs;
  for (const Vec2 corner : outline) runs.push_back(corner.x);
  std::sort(runs.begin(), runs.end());
  runs.erase(std::unique(runs.begin(), runs.end()), runs.end());
  for (std::size_t i = 0; i + 1 < runs.size(); ++i) {
    const double middle = 0.5 * (runs[i] + runs[i + 1]);
    double extreme = core::kInfinity;
    Edge outermost;
    for (const Edge& edge : edges_) {
      const Vec2 a = edge.from.x <= edge.to.x ? edge.from : edge.to;
      const Vec2 b = edge.from.x <= edge.to.x ? edge.to : edge.from;
      if (!(a.x <= runs[i] && b.x >= runs[i + 1])) continue;
      const auto drop = [&](double run) { return a.y + (b.y - a.y) * (run - a.x) / (b.x - a.x); };
      if (side * drop(middle) >= extreme) continue;
      extreme = side * drop(middle);
      outermost = {{runs[i], drop(runs[i])}, {runs[i + 1], drop(runs[i + 1])}};
    }
    profile_.push_back(outermost);
  }
  add_jumps();
}

void Region::add_jumps() {
  jumps_.push_back(profile_.front().from.x);
  for (std::size_t i = 0; i + 1 < profile_.size(); ++i) {
    if (!(profile_[i].to == profile_[i + 1].from)) jumps_.push_back(profile_[i].to.x);
  }
  jumps_.push_back(profile_.back().to.x);
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
                    const Box& around, Nearest& nearest) const {
  const auto apart = [&](const Box& box) {
    return math::hypot(std::max({box.low.x - around.high.x, 0.0, around.low.x - box.high.x}),
                       std::max({box.low.y - around.high.y, 0.0, around.low.y - box.high.y}));
  };
  if (end - begin <= kEdgesOfLeaf || 2 * node + 1 >= boxes_.size()) {
    for (std::size_t i = begin; i < end; ++i) {
      const Nearest here = between(shape, edges_[i].from, edges_[i].to);
      if (here.value < nearest.value) nearest = here;
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

Nearest Region::nearest_edge(std::span<const Vec2> shape) const {
  Box around{shape[0], shape[0]};
  for (const Vec2 p : shape) {
    around.low = {std::min(around.low.x, p.x), std::min(around.low.y, p.y)};
    around.high = {std::max(around.high.x, p.x), std::max(around.high.y, p.y)};
  }
  Nearest nearest;
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

bool Region::inside(Vec2 point) const {
  bool odd = false;
  for (const Edge& edge : edges_) {
    const Vec2 a = edge.from;
    const Vec2 b = edge.to;
    if ((a.y > point.y) == (b.y > point.y)) continue;
    if (point.x < a.x + (b.x - a.x) * (point.y - a.y) / (b.y - a.y)) odd = !odd;
  }
  return odd;
}

// Of a shape that meets the area: along each of its sides the pieces within the area are found from where the
// outline crosses it, however short, and some points of each are measured.
Nearest Region::deepest_within(std::span<const Vec2> shape) const {
  Nearest deepest{0.0, nearest_edge(shape).point};
  const std::size_t sides = shape.size() <= 2 ? 1 : shape.size();
  for (std::size_t i = 0; i < sides; ++i) {
    const Vec2 from = shape[i];
    const Vec2 along = shape[(i + 1) % shape.size()] - from;
    std::vector<double> shares{0.0, 1.0};
    for (const Edge& edge : edges_) {
      const Vec2 other = edge.to - edge.from;
      const double area = cross(along, other);
      if (area == 0.0) continue;
      const double share = cross(edge.from - from, other) / area;
      const double on_edge = cross(edge.from - from, along) / area;
      if (share > 0.0 && share < 1.0 && on_edge >= 0.0 && on_edge <= 1.0) shares.push_back(share);
    }
    std::sort(shares.begin(), shares.end());
    for (std::size_t k = 0; k + 1 < shares.size(); ++k) {
      if (!inside(from + 0.5 * (shares[k] + shares[k + 1]) * along)) continue;
      for (int sample = 0; sample <= kDepthSamples; ++sample) {
        const double part = static_cast<double>(sample) / kDepthSamples;
        const Vec2 point = from + (shares[k] + part * (shares[k + 1] - shares[k])) * along;
        const double depth = nearest_edge({&point, 1}).value;
        if (-depth < deepest.value) deepest = {-depth, point};
      }
    }
  }
  return deepest;
}

// How far a shape reaches behind the profile: both its own edge and the profile are linear between their
// corners, so that the depth is greatest at one of these. Negative where all of it is in front; infinite where
// none of it lies over the profile's runs.
Nearest Region::deepest_behind(std::span<const Vec2> shape) const {
  Nearest deepest{-core::kInfinity, {}};
  double low = core::kInfinity;
  double high = -core::kInfinity;
  for (const Vec2 p : shape) {
    low = std::min(low, p.x);
    high = std::max(high, p.x);
  }
  // The drop of the shape's edge that is turned to the profile.
  const auto outermost = [&](double run) {
    double drop = -core::kInfinity;
    const std::size_t sides = shape.size() <= 2 ? 1 : shape.size();
    for (std::size_t i = 0; i < sides; ++i) {
      Vec2 a = shape[i];
      Vec2 b = shape[(i + 1) % shape.size()];
      if (a.x > b.x) std::swap(a, b);
      if (run < a.x || run > b.x) continue;
      drop = std::max({drop, a.x == b.x ? std::max(side_ * a.y, side_ * b.y)
                                        : side_ * (a.y + (b.y - a.y) * (run - a.x) / (b.x - a.x))});
    }
    return side_ * drop;
  };
  auto edge = std::lower_bound(profile_.begin(), profile_.end(), low,
                               [](const Edge& at, double run) { return at.to.x < run; });
  for (; edge != profile_.end() && edge->from.x <= high; ++edge) {
    const auto see = [&](double run) {
      if (run < edge->from.x || run > edge->to.x || run < low || run > high) return;
      const double share = (run - edge->from.x) / (edge->to.x - edge->from.x);
      const double drop = outermost(run);
      const double depth = side_ * (drop - (edge->from.y + share * (edge->to.y - edge->from.y)));
      if (depth > deepest.value) deepest = {depth, {run, drop}};
    };
    see(edge->from.x);
    see(edge->to.x);
    for (const Vec2 p : shape) see(p.x);
  }
  return deepest;
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
  const Nearest apart = nearest_edge(shape);
  if (!profile_.empty()) {
    const Nearest behind = deepest_behind(shape);
    if (behind.value > 0.0) {
      if (kind_ == Kind::area) return {-behind.value, behind.point};
      return {-nearest_edge({&behind.point, 1}).value, behind.point};
    }
    return apart;
  }
  if (apart.value > 0.0 && !inside(shape[0])) return apart;
  return deepest_within(shape);
}

}  // namespace glissade::clearance
