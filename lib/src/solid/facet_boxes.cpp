#include "solid/facet_boxes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace glissade::solid {
namespace {

// Fewer facets in a leaf are not worth a box of their own.
constexpr std::size_t kFacetsOfLeaf = 4;
// Whether facets lean is judged by so many of them, spread evenly. One does if the box along its own edges has
// less than this share of the surface of that along the coordinates; leaning boxes pay if more than the other
// share of the facets do.
constexpr std::size_t kJudges = 1024;
constexpr double kLeaningShare = 0.1;
constexpr double kWorthwhile = 0.03;
// A leaning box of so many facets is made to measure, a larger one around those of its halves.
constexpr std::size_t kMeasured = 64;
// Rounding of the differences and products of a leaning box, relative to its size.
constexpr double kLeaningMargin = 64.0 * std::numeric_limits<double>::epsilon();
constexpr std::size_t kFacetsBetweenPauses = std::size_t{1} << 15U;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

using Corners = std::array<Vec3, 3>;

struct Extent {
  double low = 0.0;
  double high = 0.0;
};

Extent extent_along(Vec3 axis, const Corners& facet) {
  const auto [low, high] = std::minmax({dot(axis, facet[0]), dot(axis, facet[1]), dot(axis, facet[2])});
  return {low, high};
}

/// Positions relative to the middle of all, the largest side of their box being 1: single precision ends at
/// 3e38 and loses small numbers.
class Scale {
 public:
  explicit Scale(const std::vector<Vec3>& positions) {
    Vec3 low = positions.front();
    Vec3 high = low;
    for (const Vec3 p : positions) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    origin_ = 0.5 * (low + high);
    const double largest = std::max({high.x - low.x, high.y - low.y, high.z - low.z});
    factor_ = largest > kSmallest ? 1.0 / largest : 1.0;
    const double farthest = std::max({std::fabs(low.x), std::fabs(low.y), std::fabs(low.z), std::fabs(high.x),
                                      std::fabs(high.y), std::fabs(high.z)});
    margin_ = 8.0 * std::numeric_limits<double>::epsilon() * (farthest * factor_ + 1.0);
  }

  [[nodiscard]] Corners of(const std::vector<Vec3>& positions, const FacetCorners& facet) const {
    return {factor_ * (positions[facet[0]] - origin_), factor_ * (positions[facet[1]] - origin_),
            factor_ * (positions[facet[2]] - origin_)};
  }
  /// @return more than the difference to the middle is rounded by: relative to the coordinates, not to it
  [[nodiscard]] double margin() const { return margin_; }

 private:
  static constexpr double kSmallest = 1e-300;
  Vec3 origin_;
  double factor_ = 1.0;
  double margin_ = 0.0;
};

double longest_edge(const Corners& facet, Vec3& edge) {
  double longest = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 side = facet[(i + 1) % 3] - facet[i];
    const double length = norm(side);
    if (length <= longest) continue;
    longest = length;
    edge = side;
  }
  return longest;
}

struct Axes {
  Vec3 first{1.0, 0.0, 0.0};
  Vec3 second{0.0, 1.0, 0.0};
  [[nodiscard]] Vec3 third() const { return cross(first, second); }
};

/// @return axes along the longest edge of a facet and, in its plane, square to it; those of the coordinates
///         where it has no area to speak of
Axes axes_of(const Corners& facet) {
  Vec3 edge;
  const double length = longest_edge(facet, edge);
  const Vec3 normal = cross(facet[1] - facet[0], facet[2] - facet[0]);
  const Vec3 side = cross(normal, edge);
  const double side_length = norm(side);
  if (!(side_length > std::numeric_limits<double>::min())) return {};
  return {(1.0 / length) * edge, (1.0 / side_length) * side};
}

double surface(Vec3 size) {
  return size.x * size.y + size.y * size.z + size.z * size.x;
}

Vec3 size_along(Vec3 first, Vec3 second, Vec3 third, const Corners& facet) {
  const Extent x = extent_along(first, facet);
  const Extent y = extent_along(second, facet);
  const Extent z = extent_along(third, facet);
  return {x.high - x.low, y.high - y.low, z.high - z.low};
}

bool facets_lean(const std::vector<Vec3>& positions, const std::vector<FacetCorners>& facets,
                 const Scale& scale) {
  const std::size_t count = std::min(kJudges, facets.size());
  std::size_t leaning = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Corners facet = scale.of(positions, facets[i * facets.size() / count]);
    const Axes axes = axes_of(facet);
    const double upright = surface(size_along({1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}, facet));
    const double own = surface(size_along(axes.first, axes.second, axes.third(), facet));
    if (own < kLeaningShare * upright) ++leaning;
  }
  return static_cast<double>(leaning) > kWorthwhile * static_cast<double>(count);
}

float rounded_down(double value) {
  const auto nearest = static_cast<float>(value);
  return nearest <= value ? nearest : std::nextafter(nearest, -kInfinity);
}

float rounded_up(double value) {
  const auto nearest = static_cast<float>(value);
  return nearest >= value ? nearest : std::nextafter(nearest, kInfinity);
}

}  // namespace

/// Makes the leaning boxes, from the leaves up.
class FacetBoxes::Leaning {
 public:
  Leaning(FacetBoxes& boxes, const std::vector<Vec3>& positions, const std::vector<FacetCorners>& facets,
          const Scale& scale, const std::function<void()>& pause)
      : boxes_(boxes), positions_(positions), facets_(facets), scale_(scale), pause_(pause) {
    boxes_.leaning_.resize(boxes_.nodes_.size());
  }

  void enclose() { static_cast<void>(enclose(1, 0, boxes_.facets_.size())); }

 private:
  /// The facet that a node takes its axes from.
  struct Model {
    Corners facet{};
    double length = -1.0;
  };

  [[nodiscard]] Corners corners(std::size_t i) const {
    return scale_.of(positions_, facets_[boxes_.facets_[i]]);
  }

  Model enclose(std::size_t node, std::size_t begin, std::size_t end) {
    if (end - begin > kFacetsBetweenPauses / 4) pause_();
    Model model;
    if (boxes_.is_leaf(node)) {
      for (std::size_t i = begin; i < end; ++i) {
        Vec3 edge;
        const Corners facet = corners(i);
        const double length = longest_edge(facet, edge);
        if (length > model.length) model = {facet, length};
      }
    } else {
      const std::size_t middle = begin + (end - begin) / 2;
      const Model first = enclose(2 * node, begin, middle);
      const Model second = enclose(2 * node + 1, middle, end);
      model = first.length >= second.length ? first : second;
    }
    const Axes axes = axes_of(model.facet);
    boxes_.leaning_[node] = end - begin <= kMeasured ? measured(axes, begin, end) : around_halves(axes, node);
    return model;
  }

  [[nodiscard]] LeaningBox measured(const Axes& axes, std::size_t begin, std::size_t end) const {
    const Vec3 third = axes.third();
    Reach reach;
    for (std::size_t i = begin; i < end; ++i) {
      for (const Vec3 p : corners(i)) {
        reach.include({dot(axes.first, p), dot(axes.second, p), dot(third, p)}, Vec3{});
      }
    }
    return reach.box(axes, scale_.margin());
  }

  [[nodiscard]] LeaningBox around_halves(const Axes& axes, std::size_t node) const {
    const Vec3 third = axes.third();
    Reach reach;
    for (const std::size_t child : {2 * node, 2 * node + 1}) {
      const LeaningBox& box = boxes_.leaning_[child];
      const Vec3 side = cross(box.first, box.second);
      const auto radius = [&](Vec3 axis) {
        return std::fabs(dot(axis, box.first)) * box.half.x + std::fabs(dot(axis, box.second)) * box.half.y +
               std::fabs(dot(axis, side)) * box.half.z;
      };
      reach.include({dot(axes.first, box.centre), dot(axes.second, box.centre), dot(third, box.centre)},
                    {radius(axes.first), radius(axes.second), radius(third)});
    }
    return reach.box(axes, scale_.margin());
  }

  /// What lies between two corners, in coordinates along some axes.
  struct Reach {
    Vec3 low{kInfinity, kInfinity, kInfinity};
    Vec3 high{-kInfinity, -kInfinity, -kInfinity};

    void include(Vec3 p, Vec3 radius) {
      low = {std::min(low.x, p.x - radius.x), std::min(low.y, p.y - radius.y),
             std::min(low.z, p.z - radius.z)};
      high = {std::max(high.x, p.x + radius.x), std::max(high.y, p.y + radius.y),
              std::max(high.z, p.z + radius.z)};
    }

    [[nodiscard]] LeaningBox box(const Axes& axes, double margin) const {
      const Vec3 middle = 0.5 * (low + high);
      const Vec3 half = 0.5 * (high - low);
      const double slack = 2.0 * margin + kLeaningMargin * (half.x + half.y + half.z);
      return {middle.x * axes.first + middle.y * axes.second + middle.z * axes.third(), axes.first,
              axes.second, half + Vec3{slack, slack, slack}};
    }
  };

  FacetBoxes& boxes_;
  const std::vector<Vec3>& positions_;
  const std::vector<FacetCorners>& facets_;
  const Scale& scale_;
  const std::function<void()>& pause_;
};

FacetBoxes::FacetBoxes(const std::vector<Vec3>& positions, const std::vector<FacetCorners>& facets,
                       const std::function<void()>& pause) {
  if (facets.empty()) return;
  const Scale scale(positions);
  std::vector<Box> boxes(facets.size());
  std::vector<Item> items(facets.size());
  for (std::size_t i = 0; i < facets.size(); ++i) {
    if (i % kFacetsBetweenPauses == 0) pause();
    const Corners corners = scale.of(positions, facets[i]);
    const std::array<Extent, 3> extents{extent_along({1.0, 0.0, 0.0}, corners),
                                        extent_along({0.0, 1.0, 0.0}, corners),
                                        extent_along({0.0, 0.0, 1.0}, corners)};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Extent extent = extents[axis];
      boxes[i].low[axis] = rounded_down(extent.low - scale.margin());
      boxes[i].high[axis] = rounded_up(extent.high + scale.margin());
      items[i].centre[axis] = 0.5F * (boxes[i].low[axis] + boxes[i].high[axis]);
    }
    items[i].facet = static_cast<std::uint32_t>(i);
  }

  std::size_t leaves = 1;
  while (leaves * kFacetsOfLeaf < facets.size()) leaves *= 2;
  nodes_.resize(2 * leaves);
  arrange(items, 1, 0, items.size(), pause);
  facets_.reserve(items.size());
  boxes_.reserve(items.size());
  for (const Item& item : items) {
    facets_.push_back(item.facet);
    boxes_.push_back(boxes[item.facet]);
  }
  enclose(1, 0, boxes_.size());
  if (facets_lean(positions, facets, scale)) Leaning(*this, positions, facets, scale, pause).enclose();
}

// Halves the range across its longest side, down to the leaves.
void FacetBoxes::arrange(std::vector<Item>& items, std::size_t node, std::size_t begin, std::size_t end,
                         const std::function<void()>& pause) {
  if (is_leaf(node)) return;
  if (end - begin > kFacetsBetweenPauses) pause();
  std::array<float, 3> low{kInfinity, kInfinity, kInfinity};
  std::array<float, 3> high{-kInfinity, -kInfinity, -kInfinity};
  for (std::size_t i = begin; i < end; ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], items[i].centre[axis]);
      high[axis] = std::max(high[axis], items[i].centre[axis]);
    }
  }
  std::size_t longest = 0;
  for (const std::size_t axis : {1U, 2U}) {
    if (high[axis] - low[axis] > high[longest] - low[longest]) longest = axis;
  }
  const std::size_t middle = begin + (end - begin) / 2;
  const auto at = [&items](std::size_t i) { return items.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(begin), at(middle), at(end),
                   [longest](const Item& a, const Item& b) { return a.centre[longest] < b.centre[longest]; });
  arrange(items, 2 * node, begin, middle, pause);
  arrange(items, 2 * node + 1, middle, end, pause);
}

void FacetBoxes::enclose(std::size_t node, std::size_t begin, std::size_t end) {
  Box box{{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};
  const auto include = [&box](const Box& other) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box.low[axis] = std::min(box.low[axis], other.low[axis]);
      box.high[axis] = std::max(box.high[axis], other.high[axis]);
    }
  };
  if (is_leaf(node)) {
    for (std::size_t i = begin; i < end; ++i) include(boxes_[i]);
  } else {
    const std::size_t middle = begin + (end - begin) / 2;
    enclose(2 * node, begin, middle);
    enclose(2 * node + 1, middle, end);
    include(nodes_[2 * node]);
    include(nodes_[2 * node + 1]);
  }
  nodes_[node] = box;
}

/// One search for pairs. All leaves are equally deep, so that two nodes of one depth are opened together.
class FacetBoxes::Walk {
 public:
  Walk(const FacetBoxes& boxes, const std::function<void(std::uint32_t, std::uint32_t)>& visit,
       const std::function<void()>& pause)
      : boxes_(boxes), visit_(visit), pause_(pause) {}

  struct Range {
    std::size_t node;
    std::size_t begin;
    std::size_t end;
  };

  void within(const Range& range) {
    if (!boxes_.is_leaf(range.node)) {
      const auto [first, second] = halves(range);
      within(first);
      within(second);
      between(first, second);
      return;
    }
    for (std::size_t i = range.begin; i < range.end; ++i) {
      for (std::size_t k = i + 1; k < range.end; ++k) meet(i, k);
    }
  }

 private:
  static std::pair<Range, Range> halves(const Range& range) {
    const std::size_t middle = range.begin + (range.end - range.begin) / 2;
    return {{2 * range.node, range.begin, middle}, {2 * range.node + 1, middle, range.end}};
  }

  static bool overlap(const Box& a, const Box& b) {
    return a.low[0] <= b.high[0] && b.low[0] <= a.high[0] && a.low[1] <= b.high[1] && b.low[1] <= a.high[1] &&
           a.low[2] <= b.high[2] && b.low[2] <= a.high[2];
  }

  // Whether no side of either box parts the two (Gottschalk, Lin, Manocha 1996, without the edges).
  static bool overlap(const LeaningBox& a, const LeaningBox& b) {
    const Vec3 gap = b.centre - a.centre;
    const std::array<Vec3, 3> mine{a.first, a.second, cross(a.first, a.second)};
    const std::array<Vec3, 3> other{b.first, b.second, cross(b.first, b.second)};
    const std::array<double, 3> my_half{a.half.x, a.half.y, a.half.z};
    const std::array<double, 3> other_half{b.half.x, b.half.y, b.half.z};
    std::array<double, 3> reach_of_mine = other_half;
    for (std::size_t i = 0; i < 3; ++i) {
      double reach = my_half[i];
      for (std::size_t k = 0; k < 3; ++k) {
        const double share = std::fabs(dot(mine[i], other[k]));
        reach += share * other_half[k];
        reach_of_mine[k] += share * my_half[i];
      }
      if (std::fabs(dot(mine[i], gap)) > reach) return false;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      if (std::fabs(dot(other[k], gap)) > reach_of_mine[k]) return false;
    }
    return true;
  }

  [[nodiscard]] bool overlap(std::size_t a, std::size_t b) const {
    return overlap(boxes_.nodes_[a], boxes_.nodes_[b]) &&
           (boxes_.leaning_.empty() || overlap(boxes_.leaning_[a], boxes_.leaning_[b]));
  }

  void between(const Range& a, const Range& b) {
    if (!overlap(a.node, b.node)) return;
    constexpr std::size_t kStepsBetweenPauses = 1U << 10U;
    if (++steps_ % kStepsBetweenPauses == 0) pause_();
    if (!boxes_.is_leaf(a.node)) {
      const auto [a_first, a_second] = halves(a);
      const auto [b_first, b_second] = halves(b);
      between(a_first, b_first);
      between(a_first, b_second);
      between(a_second, b_first);
      between(a_second, b_second);
      return;
    }
    for (std::size_t i = a.begin; i < a.end; ++i) {
      if (!overlap(boxes_.boxes_[i], boxes_.nodes_[b.node])) continue;
      for (std::size_t k = b.begin; k < b.end; ++k) meet(i, k);
    }
  }

  void meet(std::size_t i, std::size_t k) {
    if (overlap(boxes_.boxes_[i], boxes_.boxes_[k])) visit_(boxes_.facets_[i], boxes_.facets_[k]);
  }

  const FacetBoxes& boxes_;
  const std::function<void(std::uint32_t, std::uint32_t)>& visit_;
  const std::function<void()>& pause_;
  std::size_t steps_ = 0;
};

void FacetBoxes::for_each_pair(const std::function<void(std::uint32_t, std::uint32_t)>& visit,
                               const std::function<void()>& pause) const {
  if (!facets_.empty()) Walk(*this, visit, pause).within({1, 0, facets_.size()});
}

}  // namespace glissade::solid
