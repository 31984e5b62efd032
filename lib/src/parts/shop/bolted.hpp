#pragma once

#include "glissade/parts/shop_part.hpp"

#include <cstddef>

namespace glissade::parts {

/// How the holes of finished pieces stand to those of the pieces that they lie on.
struct BoltedHoles {
  std::size_t joined = 0;  ///< pairs of holes that one bolt goes through
  std::size_t open = 0;    ///< ends of holes that no other piece touches: heads, nuts, anchors, shackles
  double off_axis = 0.0;   ///< greatest distance of two axes where holes meet [m]
};

/// Holds every hole of every piece, as it lies in the assembly, against the pieces that touch the plate there: whoever lies on the
/// end of a hole has a hole about the same axis for the same bolt (ISO 273, of whichever fit), or a slot that the axis goes through;
/// no other piece covers any of it. Tubes that are bought are drilled on site through the holes of what is bolted to them.
/// Looks at bodies and places alone, not at how they came about.
/// @throws InternalError if two holes do not meet, if no bolt fits both, or if a piece covers the end of a hole; says which
BoltedHoles require_bolts_meet(const Workshop& workshop);

}  // namespace glissade::parts
