#pragma once

#include "glissade/motion/motion.hpp"
#include "glissade/parts/master_curve.hpp"
#include "glissade/parts/timber_options.hpp"
#include "glissade/parts/workshop_build.hpp"
#include "glissade/route/placement.hpp"
#include "glissade/section/measures.hpp"

namespace glissade {

/// A section in timber. A slab with or without curbs, or a U-channel: bearers along the track, cross members, a deck in layers,
/// curbs, legs. A trapezoid, half-pipe or V-channel: bearers, templates across the track whose upper edge is the section, a
/// lining of strips along the track in layers, legs.
///
/// Shape: from the floor line down: layers of the deck (the section's floor), cross members, bearers. Deck, curbs and bearers
///   lie between offsets of the master curve; cross members are straight and touch the deck in the middle of a hollow, with
///   both edges on a crest. Sheets of the deck have the stock's length along their neutral fibre. Strips of a lining are flat
///   across, meet in mitres, and develop as plates do: a side that leans b from upright along a curve of curvature kappa cos b.
/// Frame: that of the placement. The setting-out table has the heights of the lines below the floor (offsets).
/// Identity: deck and curbs, or the lining, add up to A S - M phi of the section (kPartsVolumeAccuracy where nothing folds).
/// @throws InputError with everything that cannot be made: where, value, bound, way out; ConvergenceError as fit_arcs()
[[nodiscard]] WorkshopBuild make_timber(const Centerline& track, const section::Measures& measures,
                                        const MasterCurveOptions& fit, const TimberOptions& options,
                                        const Placement& placement, const Body& body,
                                        double gravity = kDefaultGravity);

}  // namespace glissade
