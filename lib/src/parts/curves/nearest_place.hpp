#pragma once

#include "glissade/parts/arc_spline.hpp"

#include "parts/curves/offset_line.hpp"

namespace glissade::parts {

/// A place of a track and how far a point is from it.
struct TrackPlace {
  double s = 0.0;         ///< arc length [m]
  double distance = 0.0;  ///< [m]
};

/// The place of a stretch of track that is nearest to a point, of equals the first; in closed form arc by arc, and arcs that
/// lie too far off are passed over.
/// @param point  in the frame (x, height)
/// Accuracy: kArcSplineAccuracy * length() of the track.
[[nodiscard]] TrackPlace nearest_place(const ArcSpline& track, const Span& span, Vec2 point);

}  // namespace glissade::parts
