// Where the curvature sought jumps, as seen from a track whose linear curvature cannot jump.

#include "optimize/mesh/jump_fit.hpp"

#include <algorithm>
#include <cmath>

namespace glissade::optimizer {
namespace {

/// The quadratic B-spline of four knots, ascending, of which two may coincide.
double b_spline(const std::array<double, 4>& knot, double at) {
  const auto rising = [&](std::size_t i, std::size_t order) {
    const double width = knot[i + order] - knot[i];
    return width > 0.0 ? (at - knot[i]) / width : 0.0;
  };
  const auto hat = [&](std::size_t i) {
    if (at < knot[i] || at > knot[i + 2]) return 0.0;
    return at < knot[i + 1] ? rising(i, 1) : 1.0 - rising(i + 1, 1);
  };
  return rising(0, 2) * hat(0) + (1.0 - rising(1, 2)) * hat(1);
}

}  // namespace

FoundSlope::FoundSlope(const Found& found)
    : track_(*found.track), knots_(track_.mesh().knots), turns_(knots_.size()), at_knots_(knots_.size()) {
  const Layout& layout = found.track->layout();
  for (std::size_t i = 0; i < knots_.size(); ++i) turns_[i] = found.z[layout.turn(i)];
  at_knots_[0] = found.z[layout.angle()];
  for (std::size_t i = 0; i + 1 < knots_.size(); ++i) {
    at_knots_[i + 1] = at_knots_[i] - 0.5 * (knots_[i + 1] - knots_[i]) * (turns_[i] + turns_[i + 1]);
  }
}

double FoundSlope::value(std::size_t piece, double share) const {
  const double bend = turns_[piece] + 0.5 * share * (turns_[piece + 1] - turns_[piece]);
  const double width = share * (knots_[piece + 1] - knots_[piece]);
  return at_knots_[piece] - width * bend + track_.own_angle(knots_[piece] + width);
}

Parabola beside_jump(const Vector& knots, const FoundSlope& found, std::size_t from, bool backwards,
                     std::size_t most) {
  constexpr std::size_t kTests = 3;  // theory: a parabola has three coefficients
  // Gauss-Legendre: products of two parabolas are integrated exactly.
  constexpr double kOffset = 0.3872983346207417;  // theory: Gauss-Legendre, sqrt(3/5)/2
  constexpr std::array<double, 3> kShare = {0.5 - kOffset, 0.5, 0.5 + kOffset};    // theory
  constexpr std::array<double, 3> kWeight = {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};  // theory
  const double sign = backwards ? -1.0 : 1.0;
  const double origin = knots[from];
  const std::size_t reach = std::min(most, kTests + 1);
  const auto away = [&](std::size_t k) {
    const std::size_t step = std::min(k, reach);
    return sign * (knots[backwards ? from - step : from + step] - origin);
  };
  // Both the jump and, if it is as near as that, the next one are double knots.
  std::array<std::array<double, 4>, kTests> tests{};
  for (std::size_t j = 0; j < kTests; ++j) {
    for (std::size_t k = 0; k < 4; ++k) tests[j][k] = away(j + k == 0 ? 0 : j + k - 1);
  }
  Matrix system(kTests, kTests);
  Vector right(kTests, 0.0);
  const double unit = away(reach);
  for (std::size_t k = 0; k < reach; ++k) {
    const std::size_t piece = backwards ? from - k - 1 : from + k;
    const double width = away(k + 1) - away(k);
    for (std::size_t q = 0; q < kShare.size(); ++q) {
      const double at = away(k) + kShare[q] * width;
      const double t = at / unit;
      const double zeta = found.value(piece, backwards ? 1.0 - kShare[q] : kShare[q]);
      for (std::size_t j = 0; j < kTests; ++j) {
        const double test = kWeight[q] * width * b_spline(tests[j], at);
        system(j, 0) += test;
        system(j, 1) += test * t;
        system(j, 2) += test * t * t;
        right[j] += test * zeta;
      }
    }
  }
  // Cramer's rule: three unknowns of like size.
  const auto determinant = [&](std::size_t replaced) {
    std::array<std::array<double, kTests>, kTests> m{};
    for (std::size_t i = 0; i < kTests; ++i) {
      for (std::size_t j = 0; j < kTests; ++j) m[i][j] = j == replaced ? right[i] : system(i, j);
    }
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
           m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
  };
  const double whole = determinant(kTests);
  Parabola side;
  side.origin = origin;
  side.factor = {determinant(0) / whole, sign * determinant(1) / whole / unit,
                 determinant(2) / whole / (unit * unit)};
  return side;
}

Kink::Kink(const Vector& knots, const FoundSlope& found, std::size_t first, std::size_t last, Span blurred)
    : seen_{knots[first], knots[last]} {
  constexpr std::size_t kPoints = 6;  // taste
  for (std::size_t i = first; i < last; ++i) {
    if (knots[i] >= blurred.from && knots[i + 1] <= blurred.to) continue;
    const double width = knots[i + 1] - knots[i];
    for (std::size_t k = 0; k < kPoints; ++k) {
      const double share = (static_cast<double>(k) + 0.5) / kPoints;
      points_.push_back({knots[i] + share * width, found.value(i, share),
                         width / (kPoints * (knots[last] - knots[first]))});
    }
  }
}

Kink::Fit Kink::fit(double at) const {
  std::array<std::array<double, kTerms>, kTerms> sums{};
  Vector factors(kTerms, 0.0);
  for (const Point& point : points_) {
    const auto term = terms(point.sigma, at);
    for (std::size_t j = 0; j < kTerms; ++j) {
      const double weighed = point.weight * term[j];
      for (std::size_t k = 0; k < kTerms; ++k) sums[j][k] += weighed * term[k];
      factors[j] += weighed * point.zeta;
    }
  }
  Matrix normal(kTerms, kTerms);
  Vector diagonal(kTerms);
  for (std::size_t j = 0; j < kTerms; ++j) {
    std::copy(sums[j].begin(), sums[j].end(), normal.row(j));
    diagonal[j] = normal(j, j);
  }
  const ShiftedCholesky cholesky(normal, diagonal);
  cholesky.forward(factors.data());
  cholesky.backward(factors.data());
  double squares = 0.0;
  for (const Point& point : points_) {
    const auto term = terms(point.sigma, at);
    double miss = -point.zeta;
    for (std::size_t j = 0; j < kTerms; ++j) miss += term[j] * factors[j];
    squares += point.weight * miss * miss;
  }
  return {std::sqrt(squares), factors[3] / unit()};
}

double Kink::best(Span span) const {
  constexpr int kScan = 24;      // taste
  constexpr int kHalvings = 20;  // rounding: 2^-20 of a piece
  const double step = (span.to - span.from) / kScan;
  double at = span.from;
  double least = HUGE_VAL;
  for (int k = 0; k <= kScan; ++k) {
    const double miss = fit(span.from + step * k).miss;
    if (miss >= least) continue;
    least = miss;
    at = span.from + step * k;
  }
  double width = 0.5 * step;
  for (int k = 0; k < kHalvings; ++k, width *= 0.5) {
    const double before = fit(at - width).miss;
    const double behind = fit(at + width).miss;
    if (std::min(before, behind) >= least) continue;
    least = std::min(before, behind);
    at += before < behind ? -width : width;
  }
  return at;
}

std::array<double, Kink::kTerms> Kink::terms(double sigma, double at) const {
  const double t = (sigma - at) / unit();
  const double behind = std::max(t, 0.0);
  return {1.0, t, t * t, behind, behind * behind};
}

}  // namespace glissade::optimizer
