#pragma once

#include "optimize/algebra/dense.hpp"

#include <functional>

namespace glissade::optimizer {

/// Values and derivatives at one point; inequality rows are kept where <= 0, equality rows where 0.
struct Sample {
  double objective = 0.0;
  Vector gradient;
  Vector equality;
  Matrix equality_jacobian;
  Vector inequality;
  Matrix inequality_jacobian;
};

/// A smooth problem whose rows do not change while it is being solved.
using SampleFunction = std::function<void(const Vector& z, Sample& out)>;

struct DescentOptions {
  int most_evaluations = 60;
  double step_tolerance = 1e-9;  ///< of a step in scaled variables
};

struct Descent {
  Vector z;
  int evaluations = 0;
  bool stopped = false;  ///< `stop` asked for an end
};

/// NLopt's SLSQP from z, in variables y with z = z_0 + L^-T y, where L L^T is the Hessian of the Lagrangian
/// at z_0: its quasi-Newton matrix then starts exact rather than as the identity.
/// @param stop  asked before every evaluation
[[nodiscard]] Descent descend(const SampleFunction& function, const Vector& z, std::size_t equalities,
                              std::size_t inequalities, const ShiftedCholesky& metric,
                              const DescentOptions& options, const std::function<bool()>& stop);

}  // namespace glissade::optimizer
