#pragma once

#include "glissade/core/math.hpp"

#include <array>
#include <cstddef>

namespace glissade::centerline {

/// @param x  in [-1, 1]
/// @return the sum of coefficients[k] T_k(x)
template <std::size_t kTerms>
double chebyshev_value(const std::array<double, kTerms>& coefficients, double x) {
  double next = 0.0;
  double after = 0.0;
  for (std::size_t i = kTerms - 1; i > 0; --i) {
    const double current = 2.0 * x * next - after + coefficients[i];
    after = next;
    next = current;
  }
  return x * next - after + coefficients[0];
}

/// @return cos(k (j + 1/2) pi/kTerms), the angle reduced first: an error in it would pass for a coefficient
template <std::size_t kTerms>
double node_cosine(std::size_t k, std::size_t j) {
  const std::size_t halves = k * (2 * j + 1) % (4 * kTerms);
  return math::cos_pi(static_cast<double>(halves) / static_cast<double>(2 * kTerms));
}

/// Every node_cosine(k, j): tables of curves take thousands of series.
template <std::size_t kTerms>
const std::array<std::array<double, kTerms>, kTerms>& node_cosines() {
  static const auto cosines = [] {
    std::array<std::array<double, kTerms>, kTerms> table{};
    for (std::size_t k = 0; k < kTerms; ++k) {
      for (std::size_t j = 0; j < kTerms; ++j) table[k][j] = node_cosine<kTerms>(k, j);
    }
    return table;
  }();
  return cosines;
}

/// @param values  at the nodes node_cosine(1, j)
template <std::size_t kTerms>
std::array<double, kTerms> chebyshev_series(const std::array<double, kTerms>& values) {
  const auto& cosines = node_cosines<kTerms>();
  std::array<double, kTerms> coefficients{};
  for (std::size_t k = 0; k < kTerms; ++k) {
    for (std::size_t j = 0; j < kTerms; ++j) coefficients[k] += values[j] * cosines[k][j];
    coefficients[k] *= (k == 0 ? 1.0 : 2.0) / static_cast<double>(kTerms);
  }
  return coefficients;
}

/// @return the integral from -1 of a series whose last coefficient is negligible
template <std::size_t kTerms>
std::array<double, kTerms> chebyshev_integral(const std::array<double, kTerms>& coefficients) {
  std::array<double, kTerms> integral{};
  integral[1] = coefficients[0] - 0.5 * coefficients[2];
  for (std::size_t k = 2; k < kTerms; ++k) {
    const double above = k + 1 < kTerms ? coefficients[k + 1] : 0.0;
    integral[k] = (coefficients[k - 1] - above) / (2.0 * static_cast<double>(k));
  }
  double at_begin = 0.0;
  for (std::size_t k = 1; k < kTerms; ++k) at_begin += (k % 2 == 0 ? 1.0 : -1.0) * integral[k];
  integral[0] = -at_begin;
  return integral;
}

}  // namespace glissade::centerline
