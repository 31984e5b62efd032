#pragma once

#include "glissade/core/error.hpp"
#include "glissade/design/design.hpp"
#include "glissade/motion/motion.hpp"
#include "glissade/parts/plate_options.hpp"
#include "glissade/pipeline/solve.hpp"

#include <optional>
#include <string>
#include <vector>

namespace glissade::pipeline {

/// @return what resists where a body stalls, for a message: "the friction angle, 17 deg"
[[nodiscard]] std::string friction_text(const Body& body, const Stall& stall);

/// Where the stream of a track wears its floor, the most over every friction of the design.
/// @param track  of a design with a stream
[[nodiscard]] std::vector<FloorWear> floor_wear(const Design& design, const Track& track);

/// The ride at the friction inside a range at which a stream wears its floor most.
/// @param nominal  of a stream
/// @param range    the rides at the ends of the range
/// @return none where that is an end, or there is no range
[[nodiscard]] std::optional<Motion> most_wearing_ride(const CenterlinePtr& centerline, const Motion& nominal,
                                                      const std::vector<RangeRide>& range);

/// @return of a body on the straight line to the finish; none where it does not get onto it or does not arrive
[[nodiscard]] std::optional<Motion> straight_ride(const Endpoints& endpoints, const Body& body,
                                                  double gravity);

/// @param length  of the whole track [m]
[[nodiscard]] Issue law_end_problem(const Design& design, const LawEnd& end, double length);

}  // namespace glissade::pipeline
