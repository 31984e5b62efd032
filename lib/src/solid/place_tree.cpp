#include "solid/place_tree.hpp"

#include "core/float_limits.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace glissade::solid {
namespace {

constexpr std::size_t kPlacesOfLeaf = 8;

double square_of(Vec2 a) {
  return dot(a, a);
}

}  // namespace

PlaceTree::PlaceTree(std::vector<Vec2> places) : places_(std::move(places)) {
  std::size_t leaves = 1;
  while (leaves * kPlacesOfLeaf < places_.size()) leaves *= 2;
  boxes_.resize(2 * leaves);
  build(1, 0, places_.size());
}

void PlaceTree::build(std::size_t node, std::size_t begin, std::size_t end) {
  Box box{{core::kInfinity, core::kInfinity}, {-core::kInfinity, -core::kInfinity}};
  if (end - begin <= kPlacesOfLeaf || 2 * node + 1 >= boxes_.size()) {
    for (std::size_t i = begin; i < end; ++i) {
      const Vec2 p = places_[i];
      box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y)};
      box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y)};
    }
    boxes_[node] = box;
    return;
  }
  const std::size_t middle = begin + (end - begin) / 2;
  build(2 * node, begin, middle);
  build(2 * node + 1, middle, end);
  const Box& a = boxes_[2 * node];
  const Box& b = boxes_[2 * node + 1];
  boxes_[node] = {{std::min(a.low.x, b.low.x), std::min(a.low.y, b.low.y)},
                  {std::max(a.high.x, b.high.x), std::max(a.high.y, b.high.y)}};
}

void PlaceTree::search(std::size_t node, std::size_t begin, std::size_t end, Vec2 point, double& best,
                       std::size_t& nearest) const {
  const auto distance_to = [point](const Box& box) {
    return square_of({std::max({box.low.x - point.x, 0.0, point.x - box.high.x}),
                      std::max({box.low.y - point.y, 0.0, point.y - box.high.y})});
  };
  if (end - begin <= kPlacesOfLeaf || 2 * node + 1 >= boxes_.size()) {
    for (std::size_t i = begin; i < end; ++i) {
      const double distance = square_of(places_[i] - point);
      if (distance >= best) continue;
      best = distance;
      nearest = i;
    }
    return;
  }
  const std::size_t middle = begin + (end - begin) / 2;
  const double first = distance_to(boxes_[2 * node]);
  const double second = distance_to(boxes_[2 * node + 1]);
  const bool first_nearer = first <= second;
  for (const bool take_first : {first_nearer, !first_nearer}) {
    if ((take_first ? first : second) >= best) continue;
    if (take_first) {
      search(2 * node, begin, middle, point, best, nearest);
    } else {
      search(2 * node + 1, middle, end, point, best, nearest);
    }
  }
}

}  // namespace glissade::solid
