#pragma once

#include "glissade/pipeline.hpp"

#include <string>
#include <vector>

namespace glissade::pipeline {

/// The part of a build that comes closest to something that its design keeps clear of.
struct PartApproach {
  std::string limit;     ///< "keep_outs[0]"
  double asked = 0.0;    ///< clearance of the limit [m]
  double reached = 0.0;  ///< signed distance, negative behind or within the obstacle [m]
  int part = 0;          ///< its number in the list
  std::string name;      ///< of the part: "end_frame"
  Vec2 point;            ///< of the part, in the plane of the track: run from the start, drop below it [m]
};

/// Holds every piece of a workshop, seen from the side, against what the design keeps clear of: the search and the referee
/// know the swept solid alone, not the frames, flanges, stiffeners, beams and supports round it.
///
/// Parts that stand on the ground are held against keep_outs alone. Nothing is held where clearances count from the
/// centerline on request.
/// @param frame  of the assembly
/// @return for each limit that keeps clear the closest piece; arcs by chords within a tenth of the arc tolerance
[[nodiscard]] std::vector<PartApproach> closest_parts(const Design& design, const Placement& frame,
                                                      const Workshop& workshop);

}  // namespace glissade::pipeline
