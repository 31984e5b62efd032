#pragma once

#include "optimize/problem/rows.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <vector>

/// Derivatives by central differences in the unknowns of a search, for tests.
namespace glissade::optimizer {

// Truncation h^2 f'''/6 and rounding 1e-16/h balance near here.
inline constexpr double kStep = 1e-5;
inline constexpr double kDifferenceError = 2e-8;
// The curvature between a foot and the stations beside it is interpolated.
inline constexpr double kFootError = 2e-3;

/// As gradient_error(), of many functions that one evaluation gives together.
/// @param gradients  one of each
template <class Functions>
Vector gradient_errors(const Functions& functions, const Vector& z, const std::vector<Vector>& gradients) {
  Vector worst(gradients.size(), 0.0);
  Vector size(gradients.size(), 1.0);
  for (std::size_t j = 0; j < z.size(); ++j) {
    const auto moved = [&](double step) {
      Vector at = z;
      at[j] += step;
      return functions(at);
    };
    // Richardson: fourth order from two second-order differences.
    const Vector above = moved(kStep);
    const Vector below = moved(-kStep);
    const Vector far_above = moved(2.0 * kStep);
    const Vector far_below = moved(-2.0 * kStep);
    for (std::size_t i = 0; i < gradients.size(); ++i) {
      const double wide = (above[i] - below[i]) / (2.0 * kStep);
      const double wider = (far_above[i] - far_below[i]) / (4.0 * kStep);
      worst[i] = std::max(worst[i], std::fabs((4.0 * wide - wider) / 3.0 - gradients[i][j]));
      size[i] = std::max(size[i], std::fabs(gradients[i][j]));
    }
  }
  for (std::size_t i = 0; i < worst.size(); ++i) worst[i] /= size[i];
  return worst;
}

/// Greatest distance between a gradient and central differences of its function, over the gradient's size.
template <class Function>
double gradient_error(const Function& function, const Vector& z, const Vector& gradient) {
  return gradient_errors([&](const Vector& at) { return Vector{function(at)}; }, z, {gradient}).front();
}

/// States with derivatives of a problem's rows, each made once: tests of one row after the other move the same unknowns.
class KnownStates {
 public:
  explicit KnownStates(const Rows& rows) : rows_(rows) {}
  const State& at(const Vector& z) {
    const auto found = all_.find(z);
    return found != all_.end() ? found->second : all_.emplace(z, rows_.state(z, true)).first->second;
  }

 private:
  const Rows& rows_;
  std::map<Vector, State> all_;
};

/// Greatest distance of the Lagrangian's Hessian from central differences of its gradient.
inline double hessian_error(const Vector& at, const Rows& rows, KnownStates& states, const Vector& equality,
                            const std::vector<Row>& active, const Vector& inequality) {
  const Matrix hessian = rows.hessian(states.at(at), equality, active, inequality, 1.0);
  const auto slopes = [&](const Vector& z) {
    const State& state = states.at(z);
    Vector value;
    Matrix jacobian;
    rows.equalities(state, value, jacobian);
    Vector sums = rows.objective_gradient(state);
    Vector gradient(z.size());
    for (std::size_t i = 0; i < active.size(); ++i) {
      rows.gradient(state, active[i], gradient.data());
      for (std::size_t j = 0; j < z.size(); ++j) sums[j] += inequality[i] * gradient[j];
    }
    for (std::size_t i = 0; i < value.size(); ++i) {
      for (std::size_t j = 0; j < z.size(); ++j) sums[j] += equality[i] * jacobian(i, j);
    }
    return sums;
  };
  std::vector<Vector> seconds;
  for (std::size_t j = 0; j < at.size(); ++j)
    seconds.emplace_back(hessian.row(j), hessian.row(j) + at.size());
  double worst = 0.0;
  for (const double error : gradient_errors(slopes, at, seconds)) worst = std::max(worst, error);
  return worst;
}

}  // namespace glissade::optimizer
