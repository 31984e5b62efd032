#pragma once

#include "glissade/parts/workshop_build.hpp"

#include "parts/plates/plate_unit.hpp"
#include "parts/strips/strip_shape.hpp"

#include <optional>
#include <string>
#include <vector>

namespace glissade::parts {

/// A place on the face that the body slides on, where one unit ends and the next begins.
struct FacePlace {
  std::string where;
  Vec3 at;     ///< by design, within some millimetres
  Vec3 along;  ///< unit, downstream
  Vec3 out;    ///< unit, square to it, from the plate towards the body
  double below =
      30e-3;  ///< how far below a face still is one: bent floors lie off the track, below a tile is a gap [m]
  double clear = 0.0;  ///< to either side of the joint, where gaps between tiles are [m]
};

/// @return by how much the piece downstream stands out farther than the one upstream, as both bodies lie in the assembly, within
///         1e-8 m; none where one of them has no face there [m]
[[nodiscard]] std::optional<double> step_at(const Workshop& workshop, const FacePlace& place);

/// Measures steps for the rules of the shop, less the drop that the design asks for at every joint, and tells the greatest of them
/// and the play of the joints' bolts with the ride.
void measure_steps(const std::vector<FacePlace>& places, const PlateOptions& options, WorkshopBuild& build);

/// @return places on floor and walls of a channel, or of the liner on it, at the joints between units
[[nodiscard]] std::vector<FacePlace> channel_places(const Job& job, const std::vector<double>& joints);
/// @return in the middle of every plate of a section
[[nodiscard]] std::vector<FacePlace> section_places(const StripJob& job, const std::vector<double>& joints);

}  // namespace glissade::parts
