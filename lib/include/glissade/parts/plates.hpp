#pragma once

#include "glissade/core/error.hpp"
#include "glissade/motion/motion.hpp"
#include "glissade/parts/master_curve.hpp"
#include "glissade/parts/plate_options.hpp"
#include "glissade/parts/shop_part.hpp"
#include "glissade/route/placement.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace glissade {

/// The body that rides what has been built.
struct AsBuiltRide {
  bool arrives = false;
  double travel_time = 0.0;  ///< [s]
  double exit_speed = 0.0;   ///< [m/s]
  double design_travel_time = 0.0;
  double design_exit_speed = 0.0;
  std::size_t bends = 0;   ///< kinks of the floor
  std::size_t joints = 0;  ///< between units
  /// The highest load on the floor, between kinks [m/s^2].
  double highest_load = 0.0;
};

/// How the parts stand to the solid that they make.
struct PartsProof {
  double volume = 0.0;         ///< of all floor and wall plates [m^3]
  double exact_volume = 0.0;   ///< of the channel along the arcs, by another route [m^3]
  double added_volume = 0.0;   ///< of flanges and what else is not of the channel, holes taken off [m^3]
  double smallest_gap = 0.0;   ///< between parts that do not touch by design [m]
  std::size_t pairs = 0;       ///< of parts that were held against each other
  double edge_mismatch = 0.0;  ///< greatest difference of lengths between flat and finished edges [m]
};

/// A channel made of plates, with the curve that it follows and how a body rides it.
struct PlateBuild {
  MasterCurve master;
  Workshop workshop;
  std::vector<double> joints;  ///< arc lengths of the units' ends, first 0, last the length [m]
  AsBuiltRide ride;
  PartsProof proof;
};

/// A channel of flat floor and upright walls as plates: developed, split, flanged, listed, proven.
///
/// Frame: that of the placement. Every part lies in a plane of its own, where its pattern is drawn.
/// Source: docs/fabrication.md. The side of a channel that leans by b from upright develops along a curve of curvature
///   kappa cos b: walls (b = 0) are cut as they stand, the floor (b = 90 deg) is a rectangle.
/// Identity: mating edges are the same numbers; plates add up to the channel (PartsProof).
/// @param body,gravity  what rides the parts as they are built
/// @throws InputError with everything that cannot be made: where, value, bound, way out; ConvergenceError as fit_arcs()
[[nodiscard]] PlateBuild make_plates(const Centerline& track, const ChannelMeasures& channel,
                                     const MasterCurveOptions& fit, const PlateOptions& options,
                                     const Placement& placement, const Body& body,
                                     double gravity = kDefaultGravity);

/// Stated bound of |volume - exact_volume| / exact_volume of a channel whose floor is rolled and whose walls fold
/// nowhere.
inline constexpr double kPartsVolumeAccuracy = 1e-9;

}  // namespace glissade
