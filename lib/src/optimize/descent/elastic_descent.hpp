#pragma once

#include "optimize/descent/programs.hpp"
#include "optimize/descent/search.hpp"

namespace glissade::optimizer {

/// Where steps from afar led.
struct ElasticEnd {
  Vector z;
  Multipliers multipliers;  ///< of the last program there
  double violation = 0.0;   ///< greatest of all rows, in scales
};

/// Lowers f + M t, the objective f and a price M on the greatest violation t of all rows, from a beginning that may
/// break any of them and be far from the optimum. Each step solves a quadratic program with the Lagrangian's exact
/// Hessian; where its rows contradict each other, or a step did not keep its promise, all of them give way by t, and
/// changes of shape have a price, which is raised until a step does: a trust region. Where rows bend, a step follows
/// them by one correction of second order. A metric made convex may have more curvature than the sum has: where a step won more
/// than it promised the way is doubled as long as that pays, and the next programs count the metric less.
///
/// Source: R. Fletcher, "Practical Methods of Optimization" (2nd ed., 1987), 14.4, the exact penalty with corrections;
/// the price on steps as in K. Madsen, H. Nielsen, O. Tingleff, "Methods for Non-Linear Least Squares" (2004), 3.2.
///
/// Ends where Newton steps take over, where nothing lowers the sum, or after a number of steps.
/// @param near  steps no longer than this over the gradient, in the metric, are left to Newton's method
[[nodiscard]] ElasticEnd descend_elastically(const Rows& rows, const Transcription& track, const Vector& z,
                                             const Multipliers& known, double near, SearchControl& control);

}  // namespace glissade::optimizer
