#pragma once

#include "optimize/rows.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

/// Derivatives by central differences in the unknowns of a search, for tests.
namespace glissade::optimizer {

// Truncation h^2 f'''/6 and rounding 1e-16/h balance near here.
inline constexpr double kStep = 1e-5;
inline constexpr double kDifferenceError = 2e-8;
// The curvature between a foot and the stations beside it is interpolated.
inline constexpr double kFootError = 2e-3;

/// Greatest distance between a gradient and central differences of its function, over the gradient's size.
template <class Function>
double gradient_error(const Function& function, const Vector& z, const Vector& gradient) {
  double worst = 0.0;
  double size = 1.0;
  for (std::size_t j = 0; j < z.size(); ++j) {
    Vector above = z;
    Vector below = z;
    above[j] += kStep;
    below[j] -= kStep;
    // Richardson: fourth order from two second-order differences.
    const double wide = (function(above) - function(below)) / (2.0 * kStep);
    above[j] = z[j] + 2.0 * kStep;
    below[j] = z[j] - 2.0 * kStep;
    const double wider = (function(above) - function(below)) / (4.0 * kStep);
    worst = std::max(worst, std::fabs((4.0 * wide - wider) / 3.0 - gradient[j]));
    size = std::max(size, std::fabs(gradient[j]));
  }
  return worst / size;
}

/// Greatest distance of the Lagrangian's Hessian from central differences of its gradient.
inline double hessian_error(const Vector& at, const Rows& rows, const Vector& equality,
                            const std::vector<Row>& active, const Vector& inequality) {
  const Matrix hessian = rows.hessian(rows.state(at, true), equality, active, inequality, 1.0);
  double worst = 0.0;
  for (std::size_t j = 0; j < at.size(); ++j) {
    const auto slope = [&](const Vector& z) {
      const State state = rows.state(z, true);
      Vector value;
      Matrix jacobian;
      rows.equalities(state, value, jacobian);
      double sum = rows.objective_gradient(state)[j];
      for (std::size_t i = 0; i < value.size(); ++i) sum += equality[i] * jacobian(i, j);
      Vector gradient(z.size());
      for (std::size_t i = 0; i < active.size(); ++i) {
        rows.gradient(state, active[i], gradient.data());
        sum += inequality[i] * gradient[j];
      }
      return sum;
    };
    worst = std::max(worst, gradient_error(slope, at, Vector(hessian.row(j), hessian.row(j) + at.size())));
  }
  return worst;
}

}  // namespace glissade::optimizer
