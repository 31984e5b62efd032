#include "solid/level_nodes.hpp"

#include "core/plane_geometry.hpp"

#include <cstddef>

namespace glissade::solid {
namespace {

// Nodes next to a trim are left out where they stand closer to it than this share of the step after them.
constexpr double kCrowded = 0.15;
// At most so many nodes are left out between a trim and the next one that stays.
constexpr std::ptrdiff_t kMostLeftOut = 50;

// Which nodes of a level curve stand in the way of the facets beside its trims.
class CrowdAtTrims {
 public:
  CrowdAtTrims(const std::vector<LevelNode>& nodes, const NodeSpacing& limits)
      : nodes_(nodes), limits_(limits), drop_(nodes.size(), false) {
    if (limits.keeps_beside_trims) return;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if (!nodes[i].trim) continue;
      clear(i, 1);
      clear(i, -1);
    }
  }

  [[nodiscard]] bool drops(std::size_t i) const { return drop_[i]; }

 private:
  [[nodiscard]] Vec2 point(std::ptrdiff_t i) const { return nodes_[static_cast<std::size_t>(i)].point; }

  // Drops the nodes next to a trim on one side of it, the nearest first.
  void clear(std::size_t trim, std::ptrdiff_t step) {
    const auto at = static_cast<std::ptrdiff_t>(trim);
    const auto last = static_cast<std::ptrdiff_t>(nodes_.size()) - 1;
    for (std::ptrdiff_t count = 0; count < kMostLeftOut; ++count) {
      const std::ptrdiff_t i = at + (count + 1) * step;
      if (i <= 0 || i >= last || nodes_[static_cast<std::size_t>(i)].trim) return;
      const double distance = norm(point(i) - point(at));
      const bool is_crowded = distance < kCrowded * norm(point(i + step) - point(i));
      const bool is_near = distance < limits_.beside_trims;
      if (!(is_crowded || is_near) || !lies_on_chords(at, i, step)) return;
      drop_[static_cast<std::size_t>(i)] = true;
    }
  }

  // Whether the chord from the trim to the node after `last` still follows the curve.
  [[nodiscard]] bool lies_on_chords(std::ptrdiff_t trim, std::ptrdiff_t last, std::ptrdiff_t step) const {
    for (std::ptrdiff_t i = trim + step; i != last + step; i += step) {
      if (core::distance_to_line(point(i), point(trim), point(last + step)) > limits_.sagitta) return false;
    }
    return true;
  }

  const std::vector<LevelNode>& nodes_;
  const NodeSpacing& limits_;
  std::vector<bool> drop_;
};

}  // namespace

// Drops every node that is not a trim and stands too close to the one kept before it, or to a trim.
void thin_out(std::vector<LevelNode>& nodes, const NodeSpacing& limits) {
  const std::size_t count = nodes.size();
  const CrowdAtTrims crowd(nodes, limits);
  std::size_t kept = 0;
  for (std::size_t i = 1; i < count; ++i) {
    const bool last = i + 1 == count;
    if (crowd.drops(i)) continue;
    if (!last && !nodes[i].trim && norm(nodes[i].point - nodes[kept].point) < limits.shortest) continue;
    // What precedes a node that has to stay makes room for it.
    while (kept > 0 && (last || nodes[i].trim) && !nodes[kept].trim &&
           norm(nodes[i].point - nodes[kept].point) < limits.shortest) {
      --kept;
    }
    nodes[++kept] = nodes[i];
  }
  nodes.resize(kept + 1);
}

}  // namespace glissade::solid
