#pragma once

#include "glissade/core/units.hpp"
#include "glissade/core/width_law.hpp"
#include "glissade/design/design.hpp"

#include <optional>

namespace glissade {

/// What a stream runs in: a flat floor between two walls.
struct StreamChannel {
  WidthLaw width;            ///< of the floor along the track [m]
  double wall_height = 0.0;  ///< upright [m]
  Angle wall_angle = {};     ///< from upright, outward
  /// @return whether a stream spills over the wall before it is as deep as its channel is wide, everywhere
  [[nodiscard]] bool has_low_walls() const { return wall_height < width.narrowest(); }
  /// @return the area of what fills it up to the tops of its walls, where it is widest [m^2]
  [[nodiscard]] double full_area() const;
};

/// @return the channel that a cross-section is for a stream: of a trapezoid its floor, of a slab what lies
///         between its curbs; none of round sections, grooves, polygons and slabs without curbs
[[nodiscard]] std::optional<StreamChannel> stream_channel(const CrossSectionDesign& section);

/// The speed that free fall alone gives from where a stream leaves its feed, or enters, down to the finish: none is faster
/// [m/s]. Below a hood, whose fall is not known before it is chosen, a bound of it.
/// @param design  whose finish is a point
[[nodiscard]] double speed_of_free_fall(const Design& design);

}  // namespace glissade
