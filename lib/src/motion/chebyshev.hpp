#pragma once

#include <array>
#include <cstddef>

/// Polynomials given by their values at the Chebyshev-Lobatto nodes of [0, 1]: what a panel of a ride is made
/// of.
namespace glissade::motion::chebyshev {

inline constexpr std::size_t kNodes = 17;

/// Values at the nodes, in ascending order of the nodes.
using Values = std::array<double, kNodes>;

/// @return the nodes (1 - cos(j pi / 16)) / 2: 0 the first, 1 the last
[[nodiscard]] const Values& nodes();

/// @return at each node x the mean of f over [0, x], (1/x) Int_0^x f(t) dt; f(0) at x = 0.
///         Every mean keeps its relative accuracy, however small its x.
[[nodiscard]] Values running_mean(const Values& f);

/// @return at each node x the mean of f over [0, x] with weight t, (2/x^2) Int_0^x f(t) t dt; f(0) at x = 0
[[nodiscard]] Values weighted_running_mean(const Values& f);

/// @return the polynomial's Chebyshev coefficients
[[nodiscard]] Values coefficients(const Values& f);

/// @return at the nodes, the derivative with respect to x
[[nodiscard]] Values derivative(const Values& f);

/// @return f(0) as the other nodes have it, for an f that cannot be evaluated at 0
[[nodiscard]] double extrapolated_to_zero(const Values& f);

/// Bounds of a polynomial on all of [0, 1].
struct Range {
  double lower = 0.0;
  double upper = 0.0;
};

/// @return bounds from the coefficients: never too tight, tight where f is nearly constant
[[nodiscard]] Range range(const Values& f);

/// @return the largest of the last three coefficients in size, relative to the largest |f| at a node: how
///         much of f the polynomial still misses. 0 for f = 0.
[[nodiscard]] double tail(const Values& f);

/// Interpolation to one x, for any number of polynomials.
class Interpolation {
 public:
  /// @param x  in [0, 1]
  explicit Interpolation(double x);
  [[nodiscard]] double operator()(const Values& f) const;

 private:
  Values weights_;
};

}  // namespace glissade::motion::chebyshev
