#pragma once

#include "glissade/parts/shop_part.hpp"

#include "parts/prints/print_split.hpp"

#include <cstddef>
#include <vector>

namespace glissade::parts {

/// A piece between two joints.
struct PrintUnit {
  Span span;
  ArcSpline line;  ///< its floor line, from its own origin
  Vec2 origin;     ///< where that lies, in the frame (x, height) of the track
  Pose pose;
  TriangleMesh mesh;          ///< in the frame of the piece
  double exact_volume = 0.0;  ///< of the sweep, before anything is taken off it [m^3]
  double eased_volume = 0.0;  ///< taken off the edge of the run surface [m^3]
  double sunk_volume = 0.0;   ///< of holes, notches and numbers, less that of the tongue [m^3]
  double digit_height = 0.0;  ///< of the numbers; 0: none [m]
  std::vector<Vec2>
      first_face;  ///< corners of its end faces in the frame of the section, before they are eased
  std::vector<Vec2> last_face;
};

/// @param index  of the piece, from 0
/// @throws InputError as sweep(), or if it fits the bed in no way; InternalError if its mesh turns out faulty
[[nodiscard]] PrintUnit make_unit(const PrintJob& job, const PrintPlan& plan, const Hold& hold,
                                  std::size_t index);

/// @return the frame of a piece in that of the placement
[[nodiscard]] Frame place_of(const PrintJob& job, Vec2 origin);

}  // namespace glissade::parts
