#pragma once

#include "glissade/motion/motion.hpp"
#include "glissade/parts/master_curve.hpp"
#include "glissade/parts/print_options.hpp"
#include "glissade/parts/workshop_build.hpp"
#include "glissade/route/placement.hpp"
#include "glissade/section/cross_section.hpp"

#include <stop_token>

namespace glissade {

/// A swept solid in pieces for a printer: split between planes square to the track, pinned, numbered, posed, proven.
///
/// Shape: each piece is the sweep of the section along its own stretch of the master curve, with end faces square to the
///   track; blind holes and numbers go into joint faces square to them. Both faces of a joint have the same holes.
/// Frame: bodies in that of the piece (x along the run, y across to the left, z up, origin where its floor line begins),
///   places in that of the placement; WorkshopBuild::prints as they lie on beds.
/// Accuracy: pieces add up to the section along the arcs, A S - M phi, to kPartsVolumeAccuracy where nothing folds; their
///   meshes depart from that by `mesh_tolerance` at most.
/// Identity: same input, same bits. Every mesh is closed, outward, free of self-intersection (measure()).
/// @param mesh_tolerance  greatest distance between the meshes and the pieces [m]; > 0
/// @throws InputError with everything that cannot be made: where, value, bound, way out; as fit_arcs() and sweep()
[[nodiscard]] WorkshopBuild make_prints(const Centerline& track, const CrossSection& section,
                                        const MasterCurveOptions& fit, const PrintOptions& options,
                                        double mesh_tolerance, const Placement& placement, const Body& body,
                                        double gravity = kDefaultGravity, const std::stop_token& stop = {});

}  // namespace glissade
