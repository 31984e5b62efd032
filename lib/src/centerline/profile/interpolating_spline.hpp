#pragma once

#include "glissade/core/vec.hpp"

#include <cstddef>
#include <vector>

namespace glissade::centerline {

/// How many polynomials of a spline are one and the same at each end is what its degree leaves open ("not a knot"), so
/// that nothing is assumed there.
enum class SplineDegree : std::size_t { cubic = 3, quintic = 5 };

/// A parametric spline through points (de Boor, A Practical Guide to Splines, chapters IX, X, XIII). All derivatives
/// below its degree are continuous; beyond its ends the polynomials there go on.
/// Cost: construction O(n), at() O(log n).
class InterpolatingSpline {
 public:
  /// @param parameters  strictly increasing, more of them than the degree
  /// @param values      one for each
  InterpolatingSpline(std::vector<double> parameters, const std::vector<Vec2>& values, SplineDegree degree);

  struct Place {
    Vec2 value;
    Vec2 first;   // derivative by the parameter
    Vec2 second;  // derivative of that
  };
  [[nodiscard]] Place at(double t) const;

 private:
  [[nodiscard]] std::size_t span_of(double t) const;
  void solve(const std::vector<double>& parameters, const std::vector<Vec2>& values);

  std::size_t degree_;
  std::vector<double> knots_;
  std::vector<Vec2> coefficients_;
};

}  // namespace glissade::centerline
