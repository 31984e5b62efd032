#pragma once

#include "glissade/core/arc_path.hpp"
#include "glissade/core/vec.hpp"

#include <optional>

namespace glissade {

/// A hole between two half circles: the bolt in it may stand anywhere along its axis.
struct Slot {
  Vec2 middle;          ///< [m]
  Vec2 reach;           ///< from its middle to that of either half circle; not 0 [m]
  double radius = 0.0;  ///< of the half circles [m]; > 0

  friend constexpr bool operator==(const Slot&, const Slot&) = default;
};

/// @return its outline: two lines and two half circles, counter-clockwise from the beginning of a line
[[nodiscard]] ArcPath path_of(const Slot& slot);

/// @return the slot that a closed path is the outline of, whichever way it runs; none if it is another figure
[[nodiscard]] std::optional<Slot> as_slot(const ArcPath& path);

/// @return from end to end [m]
[[nodiscard]] double overall_length(const Slot& slot);

}  // namespace glissade
