#pragma once

#include "glissade/core/error.hpp"
#include "glissade/motion/motion.hpp"
#include "glissade/parts/master_curve.hpp"
#include "glissade/parts/plate_options.hpp"
#include "glissade/parts/workshop_build.hpp"
#include "glissade/route/placement.hpp"
#include "glissade/section/measures.hpp"

#include <optional>
#include <vector>

namespace glissade {

/// A channel of flat floor and upright walls as plates: developed, split, flanged, listed, proven.
///
/// Frame: that of the placement. Every part lies in a plane of its own, where its pattern is drawn.
/// Source: docs/fabrication.md. The side of a channel that leans by b from upright develops along a curve of curvature
///   kappa cos b: walls (b = 0) are cut as they stand, the floor (b = 90 deg) is a rectangle.
/// Identity: mating edges are the same numbers; plates add up to the channel (PartsProof).
/// @param body,gravity  what rides the parts as they are built
/// @throws InputError with everything that cannot be made: where, value, bound, way out; ConvergenceError as fit_arcs()
[[nodiscard]] WorkshopBuild make_plates(const Centerline& track, const ChannelMeasures& channel,
                                        const MasterCurveOptions& fit, const PlateOptions& options,
                                        const Placement& placement, const Body& body,
                                        double gravity = kDefaultGravity);

/// @return what a cross-section is as a channel of a flat floor and upright walls; none where it is no such channel
[[nodiscard]] std::optional<ChannelMeasures> channel_of(const section::Measures& measures);

/// Any cross-section of one width as plates: channels as above; leaning, round and free ones as strips along the track that
/// meet in mitres, each developed along a curve of curvature kappa cos b; pipes as mitred tubes, too.
/// @throws as above
[[nodiscard]] WorkshopBuild make_plates(const Centerline& track, const section::Measures& measures,
                                        const MasterCurveOptions& fit, const PlateOptions& options,
                                        const Placement& placement, const Body& body,
                                        double gravity = kDefaultGravity);

/// Options with what is not told in them as the section asks for it: narrower frames with smaller bolts beside low walls, none
/// where none fits; the thickness of plates round a free outline. make_plates() and plate_problems() do so themselves.
[[nodiscard]] PlateOptions fitted(const section::Measures& measures, PlateOptions options);

/// As plate_problems() of a channel, of any cross-section.
[[nodiscard]] std::vector<Issue> plate_problems(const section::Measures& measures,
                                                const PlateOptions& options);

/// Stated bound of |volume - exact_volume| / exact_volume of a channel whose floor is rolled and whose walls fold
/// nowhere.
inline constexpr double kPartsVolumeAccuracy = 1e-9;

}  // namespace glissade
