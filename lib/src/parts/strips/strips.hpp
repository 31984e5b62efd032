#pragma once

#include "glissade/parts/plates.hpp"

#include "parts/plates/plate_section.hpp"

namespace glissade::parts {

/// A section of flat plates that lean as they like, as strips along the track that meet in mitres.
///
/// A plate that leans by b from upright develops along a curve of curvature kappa cos b: lines and arcs again. Patterns are those
/// of the middle of the thickness; edges are to be bevelled to the mitres. Where a hollow at either end of the track bends
/// tighter than a strip is high, that strip begins after it.
/// @throws InputError as make_plates()
[[nodiscard]] WorkshopBuild make_strips(const ArcSpline& track, const PlateSection& section,
                                        const PlateOptions& options, const Placement& placement,
                                        const Body& body, double gravity, const Motion& design);

/// What keeps a section from being made so, whatever the track is.
[[nodiscard]] std::vector<Issue> strip_problems(const PlateSection& section, const PlateOptions& options);

}  // namespace glissade::parts
