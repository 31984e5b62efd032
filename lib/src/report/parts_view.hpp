#pragma once

#include "glissade/report/report.hpp"

#include "report/serial/vocabulary.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace glissade::report {

/// Most facets that the page's view of the parts holds, each part counted once.
inline constexpr std::size_t kPartsViewTriangles = 60'000;

/// Where pieces go when the assembly is drawn apart.
///
/// Along the track and across it distances from its middle grow; layers, from legs to covers, move apart square to
/// the track, those far below it straight down. Pieces of a kind (floor_1, floor_2) keep together.
/// @return for each part, for each of its places, the shift of an assembly that is drawn apart all the way [m]
/// @param placement  of the frame that the parts lie in
[[nodiscard]] std::vector<std::vector<Vec3>> shifts_apart(const std::vector<ShopPart>& parts,
                                                          const Centerline& centerline,
                                                          const Placement& placement);

/// The parts as the page draws them: each body once, with the places of its pieces and where they go when drawn apart.
/// null where there is no solid whose frame they could lie in.
[[nodiscard]] Json parts_view_json(const ReportInput& input);

}  // namespace glissade::report
