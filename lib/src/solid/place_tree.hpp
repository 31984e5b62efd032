#pragma once

#include "glissade/core/vec.hpp"

#include <cstddef>
#include <vector>

namespace glissade::solid {

/// Places along a curve, for looking up the nearest one: a tree of boxes over them in their order, since neighbours along a
/// curve are neighbours in space.
class PlaceTree {
 public:
  PlaceTree() = default;
  /// @param places  at least one
  explicit PlaceTree(std::vector<Vec2> places);

  /// Looks for a place nearer than what is known.
  /// @param best     squared distance within which it is looked for; lowered to that of the nearest place inside
  /// @param nearest  its index; left as it is where there is none
  void search(Vec2 point, double& best, std::size_t& nearest) const {
    search(1, 0, places_.size(), point, best, nearest);
  }

 private:
  struct Box {
    Vec2 low;
    Vec2 high;
  };

  void build(std::size_t node, std::size_t begin, std::size_t end);
  void search(std::size_t node, std::size_t begin, std::size_t end, Vec2 point, double& best,
              std::size_t& nearest) const;

  std::vector<Vec2> places_;
  std::vector<Box> boxes_;  // 1 the root, 2 i and 2 i + 1 the halves of i
};

}  // namespace glissade::solid
