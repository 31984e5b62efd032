#pragma once

#include "glissade/core/vec.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace glissade::solid {

using FacetCorners = std::array<std::uint32_t, 3>;

/// The pairs of facets whose bounding boxes overlap, found by a tree of boxes.
///
/// Every facet has a box along the axes of the coordinates, and so has every node of the tree. Where facets are
/// long and lean against these axes, such boxes overlap by the thousand: nodes then have a second box as well,
/// along the longest edge and the normal of one of their facets, and a pair of nodes is looked into only if
/// the boxes of both sorts overlap.
/// Identity: two facets with a point in common are always found: boxes are larger than they would have to be
///   by more than rounding takes off.
class FacetBoxes {
 public:
  /// @param facets  corners are indices of positions, which are finite
  /// @param pause  called every some ten thousand facets while the tree is made; may throw to end
  FacetBoxes(
      const std::vector<Vec3>& positions, const std::vector<FacetCorners>& facets,
      const std::function<void()>& pause = [] {});

  /// Visits every pair once, in an order that depends on the facets alone.
  /// @param visit  told both facets
  /// @param pause  called now and then, at least once in some hundred thousand steps; may throw to end
  void for_each_pair(const std::function<void(std::uint32_t, std::uint32_t)>& visit,
                     const std::function<void()>& pause) const;

 private:
  /// Single precision: half the memory, and overlaps only where doubles nearly do.
  struct Box {
    std::array<float, 3> low;
    std::array<float, 3> high;
  };
  struct Item {
    std::array<float, 3> centre;
    std::uint32_t facet;
  };
  /// A box along two orthogonal unit vectors and their cross product.
  struct LeaningBox {
    Vec3 centre;
    Vec3 first;
    Vec3 second;
    Vec3 half;  // extents along first, second, third
  };
  class Leaning;
  class Walk;

  void arrange(std::vector<Item>& items, std::size_t node, std::size_t begin, std::size_t end,
               const std::function<void()>& pause);
  void enclose(std::size_t node, std::size_t begin, std::size_t end);
  [[nodiscard]] bool is_leaf(std::size_t node) const { return 2 * node >= nodes_.size(); }

  std::vector<std::uint32_t> facets_;  // in the order of the tree's leaves
  std::vector<Box> boxes_;             // of the facets, in that order
  std::vector<Box> nodes_;             // a complete binary tree: the children of n are 2n and 2n + 1
  std::vector<LeaningBox> leaning_;    // of the nodes; empty where facets do not ask for it
};

}  // namespace glissade::solid
