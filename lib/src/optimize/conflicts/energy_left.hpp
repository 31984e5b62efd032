#pragma once

#include "glissade/task/problem.hpp"

#include <optional>
#include <string>

namespace glissade::optimizer {

/// The least speed at the finish [m/s] that the energy equation leaves to any track within the slope angles that the
/// limits allow, however it winds.
///
/// Source: docs/theory.md, reach theorem. With h(q) = 2 g (q - mu) e^(-2 mu atan q) of the slope q = tan zeta the
///   weighted squared speed grows by Int h(q) dx, and no less than by run * E(drop/run), where E is the lower
///   convex envelope of h over the slopes allowed. Contact and radii are not asked for: the true least is higher.
/// @return none where there is no such bound: other bodies than the sliding point, drag, a free finish, slopes that
///         may be as steep as one likes uphill
[[nodiscard]] std::optional<double> least_speed_left(const Problem& problem);

/// No track brings the body to the finish faster than this [m/s], whatever its shape.
///
/// Source: nothing but gravity adds energy, so that v^2 <= v0^2 + 2 g drop. Of a finish that is given friction has its part, too:
///   with h as above, friction of mu times a load that is never counted negative, and drag that only holds back,
///   the weighted squared speed e^(-2 mu zeta) v^2 grows by no more than Int h(q) dx. As
///   h'' = -8 g mu (1 + mu^2) e^(-2 mu atan q)/(1 + q^2)^2 <= 0, h is concave, and that is no more than run * h(drop/run) (Jensen).
///   The slope angles at the ends, as the limits allow them, give v^2 back. The lower of the two bounds.
/// @return none where there is no such bound: another body than a point, a wind from behind on a body with drag, a finish that
///         may lie as deep as one likes
[[nodiscard]] std::optional<double> most_speed_left(const Problem& problem);

/// No body is faster after so much of its track [m/s]: that would take a fall of more than its length.
/// @param length  [m]; >= 0
/// @return none where there is no such bound: as most_speed_left(), but for the finish
[[nodiscard]] std::optional<double> most_speed_after(const Problem& problem, double length);

/// What a search takes for lying still at the end of a track so long [m/s]: kCreep of the squared speed of free fall.
[[nodiscard]] double creeping_speed(const Problem& problem, double length);

/// The finish lies so near to what friction ends the ride at that no track, whatever its shape, brings the body there faster than
/// what a search takes for lying still. The straight line may arrive; which track is better no search can tell.
struct Creep {
  double most = 0.0;     ///< what no track exceeds at the finish, as most_speed_left() [m/s]
  double counted = 0.0;  ///< what a search takes for lying still there, at least [m/s]
  double enough = 0.0;   ///< a drop that leaves tracks to be told apart [m]
};
/// @return none where a faster arrival is not ruled out, or the finish is free
[[nodiscard]] std::optional<Creep> creep_at_best(const Problem& problem);
/// @return "so near to ... that tracks cannot be told apart: ..., and what to try
[[nodiscard]] std::string creep_text(const Creep& creep);

}  // namespace glissade::optimizer
