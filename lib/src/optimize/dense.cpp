#include "optimize/dense.hpp"

#include <algorithm>
#include <cmath>

// Of processors that add four numbers at once these two take half the time, to the same bits: the order of the
// additions stays, and no variant fuses them with the multiplications.
#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__)
#define GLISSADE_WIDE_VARIANT __attribute__((target_clones("avx2", "default")))
#else
#define GLISSADE_WIDE_VARIANT
#endif

namespace glissade::optimizer {

GLISSADE_WIDE_VARIANT double dot(const double* a, const double* b, std::size_t n) {
  // Four sums side by side: the order is fixed, and the processor need not wait for each addition.
  double sum[4] = {};
  std::size_t i = 0;
  for (; i + 4 <= n; i += 4) {
    for (std::size_t k = 0; k < 4; ++k) sum[k] += a[i + k] * b[i + k];
  }
  for (; i < n; ++i) sum[0] += a[i] * b[i];
  return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

GLISSADE_WIDE_VARIANT void add_scaled(double* y, double k, const double* a, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) y[i] += k * a[i];
}

void add_symmetric(Matrix& matrix, double factor, const Vector& a, const Vector& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    add_scaled(matrix.row(i), factor * a[i], b.data(), b.size());
    add_scaled(matrix.row(i), factor * b[i], a.data(), a.size());
  }
}

double norm(const Vector& a) {
  return std::sqrt(dot(a.data(), a.data(), a.size()));
}

ShiftedCholesky::ShiftedCholesky(const Matrix& symmetric, const Vector& diagonal, double largest) {
  constexpr double kFirstShift = 1e-6;  // taste
  constexpr double kShiftGrowth = 8.0;  // taste
  while (shift_ <= largest && !factor(symmetric, diagonal)) {
    shift_ = shift_ == 0.0 ? kFirstShift : shift_ * kShiftGrowth;
  }
}

bool ShiftedCholesky::factor(const Matrix& symmetric, const Vector& diagonal) {
  // A pivot that lost this much against its diagonal is rounding, not curvature.
  constexpr double kSmallestPivot = 1e-11;
  const std::size_t n = diagonal.size();
  lower_ = Matrix(n, n);
  inverse_.assign(n, 1.0);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      lower_(i, j) = (symmetric(i, j) - dot(lower_.row(i), lower_.row(j), j)) * inverse_[j];
    }
    const double full = symmetric(i, i) + shift_ * diagonal[i];
    const double pivot = full - dot(lower_.row(i), lower_.row(i), i);
    if (!(pivot > kSmallestPivot * diagonal[i])) return false;
    lower_(i, i) = std::sqrt(pivot);
    inverse_[i] = 1.0 / lower_(i, i);
  }
  return true;
}

ShiftedCholesky ShiftedCholesky::with_one_more(double curvature) const {
  const std::size_t n = lower_.columns();
  ShiftedCholesky larger;
  larger.lower_ = Matrix(n + 1, n + 1);
  for (std::size_t i = 0; i < n; ++i) std::copy_n(lower_.row(i), n, larger.lower_.row(i));
  larger.lower_(n, n) = std::sqrt(curvature);
  larger.inverse_ = inverse_;
  larger.inverse_.push_back(1.0 / larger.lower_(n, n));
  larger.shift_ = shift_;
  return larger;
}

void ShiftedCholesky::backward(double* x) const {
  for (std::size_t i = lower_.columns(); i-- > 0;) {
    x[i] *= inverse_[i];
    add_scaled(x, -x[i], lower_.row(i), i);
  }
}

void ShiftedCholesky::forward(double* x) const {
  for (std::size_t i = 0; i < lower_.columns(); ++i) x[i] = (x[i] - dot(lower_.row(i), x, i)) * inverse_[i];
}

}  // namespace glissade::optimizer
