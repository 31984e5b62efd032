#pragma once

#include "parts/curves/arc_fit.hpp"
#include "parts/curves/circle_pieces.hpp"

#include <vector>

namespace glissade::parts {

/// Joints that were closed in on.
struct FittedJoints {
  ChainStart joints;
  std::vector<double> deviations;  ///< the greatest of each arc [m]
  double deviation = 0.0;          ///< of all, to first order in it; infinite where there is none [m]
};

/// The joints, as many as at the start, whose chain comes closest to a line beside the track, as found by moving them:
/// to first order in the distance from the track. What fit_chain() does, without chains: offsets that are not the
/// best ones add up along a chain of true arcs from joint to joint, here each joint is as good as its neighbours.
/// @param middle  how far to the left of the track the chain is to lie [m]
/// @param tolerance  the deviation that is enough [m]; the search ends there, or where it sees that it is out of reach
[[nodiscard]] FittedJoints fit_joints(const TrackSamples& samples, const Stretch& stretch, ChainStart start,
                                      double middle, double tolerance);

}  // namespace glissade::parts
