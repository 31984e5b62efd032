#pragma once

#include "glissade/core/vec.hpp"

#include <algorithm>
#include <string_view>

namespace glissade {

/// How far the solid round a centerline, and what slides on it, reach above and below the floor: what
/// clearances are measured from. All 0: from the centerline itself.
///
/// Shape: every point of the vertical plane whose height above the floor lies within -below and top(), between
///   the two planes square to the track at its ends (docs/solid.md): the side view of the swept solid. What slides
///   leans through those planes where the track ends in a curve: up to the headroom they cut nothing off.
struct Envelope {
  double below = 0.0;     ///< depth of the underside below the floor [m]; >= 0
  double above = 0.0;     ///< height of walls or curbs above the floor [m]; >= 0
  double headroom = 0.0;  ///< height above the floor that what slides needs [m]; >= 0

  [[nodiscard]] constexpr double top() const { return std::max(above, headroom); }
  [[nodiscard]] constexpr bool is_line() const { return below == 0.0 && top() == 0.0; }

  friend bool operator==(const Envelope&, const Envelope&) = default;
};

/// Parts of an envelope that an obstacle may be closest to.
enum class EnvelopePart {
  floor,      ///< the centerline: nothing of the envelope lies beyond it there
  underside,  ///< the lower edge
  rim,        ///< the upper edge, where walls or curbs end
  headroom,   ///< what slides, where it is higher than the walls or leans through an end plane
  side,       ///< between the edges: the obstacle reaches into the envelope
  start_face,
  finish_face
};

/// @return "floor", "underside", "rim", "headroom", "side", "start face", "finish face"
[[nodiscard]] std::string_view to_text(EnvelopePart part);

/// The place of an envelope that comes closest to an obstacle.
struct EnvelopePlace {
  EnvelopePart part = EnvelopePart::floor;
  double height = 0.0;  ///< above the floor [m]
  Vec2 point;           ///< (run, drop) [m]

  friend bool operator==(const EnvelopePlace&, const EnvelopePlace&) = default;
};

}  // namespace glissade
