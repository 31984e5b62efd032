#pragma once

#include "glissade/motion/motion.hpp"
#include "glissade/parts/arc_spline.hpp"
#include "glissade/parts/workshop_build.hpp"

#include "parts/bodies/facets.hpp"

#include <cstddef>
#include <memory>
#include <vector>

namespace glissade::parts {

/// The body down the floors of units one after the other.
/// @param design  the ride on the track as it was meant
/// @param joint_step  by which the floor drops from unit to unit [m]
[[nodiscard]] AsBuiltRide ride_units(const std::vector<std::shared_ptr<const ArcSpline>>& floors,
                                     double joint_step, const Motion& design, const Body& body,
                                     double gravity);

/// @return a ride as it is told
[[nodiscard]] AsBuiltRide as_told(const FacetRide& found, const Motion& design, std::size_t bends,
                                  std::size_t joints);

}  // namespace glissade::parts
