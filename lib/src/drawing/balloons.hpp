#pragma once

#include "glissade/core/vec.hpp"

#include <cstddef>
#include <vector>

namespace glissade::drawing {

/// Something that a drawing names: any of its pieces may be pointed at.
struct Named {
  std::vector<Vec2> pieces;  ///< where they lie; at least one
};

/// A place for a name, and what it points at.
struct Label {
  std::size_t slot;
  Vec2 target;  ///< of the pieces the one next to the slot
};

/// Gives each name a place of its own so that the lines from the places to the pieces are short, do not cross
/// and run through no other name. First by length alone, where no two names that change places make the lines shorter together
/// (of two lines that cross an exchange always does, by the triangle's inequality); then moves and exchanges that take
/// lines out of other names. A drawing too full for all of it keeps what is the least.
/// @param slots   where names may stand; at least as many as there are names
/// @param radius  of the room that a name takes round its slot
/// @param others  middles of other words, as large as a name, which lines keep off, too
/// @return one label a name, in their order
[[nodiscard]] std::vector<Label> labelled(const std::vector<Named>& names, const std::vector<Vec2>& slots,
                                          double radius, const std::vector<Vec2>& others = {});

/// @return whether two lines cross between their ends
[[nodiscard]] bool lines_cross(Vec2 from, Vec2 to, Vec2 other_from, Vec2 other_to);
/// @return whether a line passes a point within a distance
[[nodiscard]] bool line_passes(Vec2 from, Vec2 to, Vec2 point, double within);

}  // namespace glissade::drawing
