#pragma once

#include "glissade/centerline/centerline.hpp"
#include "glissade/parts/arc_spline.hpp"

#include <cstddef>
#include <memory>

namespace glissade {

/// Where an arc spline may depart from the track.
enum class FitSide {
  both,      ///< to either side, by at most the tolerance
  away,      ///< away from the side that a body slides on; into it by at most kOneSidedSlip of the tolerance
  into_flow  ///< into that side, away from it by as little
};

/// How closely arcs follow a track, and on which side of it they may lie.
struct MasterCurveOptions {
  double tolerance = 1e-4;  ///< greatest distance between the track and its arcs [m]; > 0
  FitSide side = FitSide::both;
  /// Whether the track was searched for: arcs that it has are where a limit held the search, not what somebody drew, and
  /// may go where too many arcs are needed to keep them. Lines stay.
  bool found = false;
};

/// The floor line of a track as lines and arcs, which every edge of every part is an offset of.
struct MasterCurve {
  std::shared_ptr<const ArcSpline> spline;
  std::size_t arcs = 0;   ///< pieces of the spline, straight ones among them
  std::size_t lines = 0;  ///< straight ones
  std::size_t kept = 0;   ///< lines and arcs of the track itself, kept whole on their lines and circles
  /// No chain of fewer arcs keeps both the tolerance and the kept pieces with their tangents, in whatever way its arcs
  /// are joined with each other.
  std::size_t lower_bound = 0;
  double tolerance = 0.0;      ///< that was asked for [m]
  double max_deviation = 0.0;  ///< greatest distance between track and spline, measured both ways [m]
};

/// Puts lines and arcs in place of a track.
///
/// Curve: straight lines and arcs of the track are kept on their lines and circles, from end to end; where the tolerance
///   allows they reach on into what lies beside them. Of a track that was found, arcs that lie within the tolerance of a
///   line go where that saves some, and all its arcs where the chain would have more than 1.16 times the lower bound and two. In between, joints are moved until their
///   arcs come as close as so many can, first from even ones, then from those that dynamic programming over places and
///   headings within the band finds. Start and finish are those of the track; the tangent there may turn by some 16
///   tolerances a length of the arc.
/// Source: docs/fabrication.md. |dkappa/ds| h^3/192 is the error of separate arcs of length h, h^3/124.7 that of arcs
///   with common tangents, so that some 1.16 times the lower bound is the least to hope for.
/// Accuracy: max_deviation is measured at kPointsPerArc points of each arc by the nearest point of the track. The
///   lower bound is certified by four points of the track for each of its pieces: no circle passes all four within
///   the tolerance; of a fit to one side, within half the band about its middle. Beside a kept piece it is certified for
///   circles that touch this one: whatever the place, two points of the track ask for different curvatures.
/// Identity: same input, same bits. Works where the curvature is unbounded at the start.
/// @throws InputError if the tolerance is not finite and positive, or finer than kFinestTolerance of the length
[[nodiscard]] MasterCurve fit_arcs(const Centerline& track, const MasterCurveOptions& options = {});

inline constexpr double kFinestTolerance = 1e-9;
inline constexpr int kPointsPerArc = 32;
inline constexpr double kOneSidedSlip = 0.02;

}  // namespace glissade
