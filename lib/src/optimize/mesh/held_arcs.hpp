#pragma once

#include "optimize/descent/search.hpp"

#include <optional>

namespace glissade::optimizer {

/// A stretch between two stations along which a body would leave the track.
struct LiftOff {
  double sigma = 0.0;  ///< its lowest load, of the core by its length
  double depth = 0.0;  ///< how far that lies below none, in scales of the limit on the load
};
[[nodiscard]] std::vector<LiftOff> lift_offs_of(const ScaledProblem& problem, const Found& found);

/// Where a track exceeds a cap on the speed the most, stretch by stretch, between the stations at which it is held.
/// @param by  less is left alone, in scales of the limit
/// @return places of the core, by its length
[[nodiscard]] Vector exceeded_caps_of(const ScaledProblem& problem, const Found& found, double by);

/// A mesh whose curvature follows a limit on the load, or a cap on the speed, wherever the track found lies at it for a
/// stretch.
///
/// There the curvature is that of constant load, kappa = (N - g cos(zeta))/v (a parabola in flight for N = 0), or of constant
/// speed, which are not linear in arc length: between two knots a clothoid keeps the limit at the cost of second order in
/// their distance. The mesh returned has fine knots along these stretches, as many as their price asks for; the
/// turning rates that they add are what the track found lacks between its knots. They are as good as that track,
/// so that a search on the mesh, and this once more, come closer by another order each time.
/// @param lifts  places of the core, by its length, at which a body left the track between two stations: the
///               pieces there get twice as many fine knots as they have
/// @return none where no such limit is held over whole pieces, or where fine knots would win nothing
[[nodiscard]] std::optional<Mesh> following_limits(const ScaledProblem& problem, const Found& found,
                                                   const Vector& lifts = {});

}  // namespace glissade::optimizer
