#pragma once

#include "optimize/descent/search.hpp"

#include <vector>

namespace glissade::optimizer {

/// Which limits give way in the search for the least violation.
struct Elastic {
  std::vector<bool> limits;  ///< these are relaxed by t scales, ...
  bool equalities = true;    ///< the finish and straight ends too; all others are kept

  [[nodiscard]] static Elastic all(std::size_t limits) { return {std::vector<bool>(limits, true), true}; }
};

/// What a step of the search knows of how the rows bend.
enum class StepModel {
  curved,  ///< the Lagrangian's curvature: few steps, to the end closest by
  flat  ///< nothing but the price on the change of shape: more steps, past ends that curvature would draw it into
};

/// The least t by which the elastic rows must give way, and who holds it up.
struct Relaxed {
  Found found;           ///< multipliers are those of t; violation is that of the rows that do not give way
  double t = 0.0;        ///< in scales; <= 0 where all can be kept
  bool settled = false;  ///< no small change of the track lowers t
};

/// Minimises the greatest violation of the elastic rows, the others being kept, by a sequence of quadratic
/// programs: rows linearised, the Lagrangian's curvature where it is convex, and a price on the change of the
/// slope angle that rises where the linear rows promised too much. Rows that are to be kept are held by an
/// exact penalty on the greatest of them, so that the start may break them and no program is contradictory.
///
/// Source: R. Fletcher, "Practical Methods of Optimization", 2nd ed. (1987), sections 14.3 and 14.4 (the model,
/// its acceptance, the second-order correction).
/// Ends early, unsettled, with t <= 0: then all can be kept.
[[nodiscard]] Relaxed least_violation(const ScaledProblem& problem, const Mesh& mesh, const Vector& z,
                                      const Elastic& elastic, const Vector& margins, SearchControl& control,
                                      StepModel model = StepModel::curved);

}  // namespace glissade::optimizer
