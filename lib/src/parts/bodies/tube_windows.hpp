#pragma once

#include "glissade/parts/shop_part.hpp"

#include "parts/bodies/body_moments.hpp"
#include "parts/bodies/bores.hpp"
#include "parts/bodies/brep.hpp"

#include <vector>

namespace glissade::parts {

/// Openings and holes of tubes, and of the round of troughs.

/// @return the tube that the round of a trough is half of
[[nodiscard]] TubeGore round_of(const TroughGore& gore);

/// @return the holes of a tube, from its inside outwards
[[nodiscard]] std::vector<Bore> bores_of(const TubeGore& gore);
/// @return what a window takes out of its tube
[[nodiscard]] BodyMoments moments_of(const TubeWindow& window, const TubeGore& gore);
/// @return the distance of a place from a window, square to the edges that it has on the cylinder through that place; negative in it
[[nodiscard]] double beside(const TubeWindow& window, Vec3 place);
/// @return points of the tube just beside the edges of its windows
/// @param inset  of the points from the faces [m]
[[nodiscard]] std::vector<Vec3> points_beside(const TubeGore& gore, double inset);

/// What windows and holes are in the faces of a tube.
struct TubeMouths {
  std::vector<std::vector<BrepUse>> inside;
  std::vector<std::vector<BrepUse>> outside;
};
/// Adds their walls to a solid in millimetres.
[[nodiscard]] TubeMouths add_openings(Brep& brep, const TubeGore& gore);

}  // namespace glissade::parts
