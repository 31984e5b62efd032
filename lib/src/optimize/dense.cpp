#include "optimize/dense.hpp"

#include <algorithm>
#include <cmath>

namespace glissade::fastest {

double dot(const double* a, const double* b, std::size_t n) {
  // Four sums side by side: the order is fixed, and the processor need not wait for each addition.
  double sum[4] = {};
  std::size_t i = 0;
  for (; i + 4 <= n; i += 4) {
    for (std::size_t k = 0; k < 4; ++k) sum[k] += a[i + k] * b[i + k];
  }
  for (; i < n; ++i) sum[0] += a[i] * b[i];
  return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

void add_scaled(double* y, double k, const double* a, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) y[i] += k * a[i];
}

double norm(const Vector& a) {
  return std::sqrt(dot(a.data(), a.data(), a.size()));
}

ShiftedCholesky::ShiftedCholesky(const Matrix& symmetric, const Vector& diagonal) {
  constexpr double kFirstShift = 1e-6;
  constexpr double kShiftGrowth = 8.0;
  constexpr double kLastShift = 1e9;
  shift_ = 0.0;
  while (!factor(symmetric, diagonal) && shift_ <= kLastShift) {
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

void ShiftedCholesky::backward(double* x) const {
  for (std::size_t i = lower_.columns(); i-- > 0;) {
    x[i] *= inverse_[i];
    add_scaled(x, -x[i], lower_.row(i), i);
  }
}

void ShiftedCholesky::forward(double* x) const {
  for (std::size_t i = 0; i < lower_.columns(); ++i) x[i] = (x[i] - dot(lower_.row(i), x, i)) * inverse_[i];
}

namespace {

/// Orthonormal rows and the triangle that makes the given rows of them: row_i = sum_j r(i, j) q_j.
struct RowBasis {
  std::vector<Vector> q;
  std::vector<Vector> r;
  std::vector<std::size_t> source;

  /// @return false if the row depends on those before
  bool append(const double* row, std::size_t n, std::size_t index) {
    constexpr double kDependent = 1e-9;
    Vector rest(row, row + n);
    const double size = norm(rest);
    Vector coefficients(q.size() + 1, 0.0);
    for (int pass = 0; pass < 2; ++pass) {
      for (std::size_t j = 0; j < q.size(); ++j) {
        const double along = dot(q[j].data(), rest.data(), n);
        coefficients[j] += along;
        add_scaled(rest.data(), -along, q[j].data(), n);
      }
    }
    const double left = norm(rest);
    if (!(left > kDependent * size)) return false;
    for (double& value : rest) value /= left;
    coefficients.back() = left;
    q.push_back(std::move(rest));
    r.push_back(std::move(coefficients));
    source.push_back(index);
    return true;
  }

  /// @return k with sum_i k_i row_i = the part of -target in the span; the rest of target in `rest`
  [[nodiscard]] Vector fit(const Vector& target, Vector& rest) const {
    rest = target;
    Vector along(q.size());
    for (std::size_t j = 0; j < q.size(); ++j) {
      along[j] = -dot(q[j].data(), rest.data(), rest.size());
      add_scaled(rest.data(), along[j], q[j].data(), rest.size());
    }
    Vector k(q.size());
    for (std::size_t i = q.size(); i-- > 0;) {
      k[i] = along[i] / r[i][i];
      for (std::size_t j = 0; j < i; ++j) along[j] -= k[i] * r[i][j];
    }
    return k;
  }
};

}  // namespace

Multipliers least_multipliers(const Vector& target, const Matrix& equality, const Matrix& inequality) {
  const std::size_t n = target.size();
  RowBasis fixed;
  for (std::size_t i = 0; i < equality.rows(); ++i) (void)fixed.append(equality.row(i), n, i);

  // Lawson and Hanson's active-set method for the inequality rows; the equality rows are always in the basis.
  std::vector<std::size_t> passive;
  Vector nu(inequality.rows(), 0.0);
  std::vector<bool> barred(inequality.rows(), false);
  RowBasis basis = fixed;
  Vector rest;
  Vector k = basis.fit(target, rest);
  const std::size_t most_rounds = 3 * (n + inequality.rows()) + 10;
  for (std::size_t round = 0; round < most_rounds; ++round) {
    std::size_t best = inequality.rows();
    double steepest = 1e-12;
    const double rest_norm = norm(rest);
    if (rest_norm <= 1e-15 * norm(target)) break;
    for (std::size_t i = 0; i < inequality.rows(); ++i) {
      if (nu[i] > 0.0 || barred[i]) continue;
      const double size = std::sqrt(dot(inequality.row(i), inequality.row(i), n));
      if (size == 0.0) continue;
      const double slope = -dot(inequality.row(i), rest.data(), n) / (size * rest_norm);
      if (slope > steepest) {
        steepest = slope;
        best = i;
      }
    }
    if (best == inequality.rows()) break;
    if (!basis.append(inequality.row(best), n, best)) {
      barred[best] = true;
      continue;
    }
    passive.push_back(best);
    for (;;) {
      k = basis.fit(target, rest);
      const std::size_t first = fixed.q.size();
      double step = 1.0;
      std::size_t leaving = passive.size();
      for (std::size_t i = 0; i < passive.size(); ++i) {
        if (k[first + i] > 0.0) continue;
        const double old = nu[passive[i]];
        const double part = old / (old - k[first + i]);
        if (part < step || leaving == passive.size()) {
          step = std::min(step, part);
          leaving = i;
        }
      }
      if (leaving == passive.size()) {
        for (std::size_t i = 0; i < passive.size(); ++i) nu[passive[i]] = k[first + i];
        break;
      }
      if (passive[leaving] == best && nu[best] == 0.0) barred[best] = true;
      for (std::size_t i = 0; i < passive.size(); ++i) {
        double& value = nu[passive[i]];
        value += step * (k[first + i] - value);
      }
      nu[passive[leaving]] = 0.0;
      passive.erase(passive.begin() + static_cast<std::ptrdiff_t>(leaving));
      basis = fixed;
      std::vector<std::size_t> kept;
      for (const std::size_t i : passive) {
        if (basis.append(inequality.row(i), n, i)) {
          kept.push_back(i);
        } else {
          nu[i] = 0.0;
        }
      }
      passive = kept;
    }
  }
  Multipliers result;
  result.equality.assign(equality.rows(), 0.0);
  for (std::size_t i = 0; i < fixed.source.size(); ++i) result.equality[fixed.source[i]] = k[i];
  result.inequality = std::move(nu);
  result.residual = std::move(rest);
  return result;
}

Vector shortest_solution(const Matrix& rows, const Vector& value) {
  RowBasis basis;
  Vector solution(rows.columns(), 0.0);
  for (std::size_t i = 0; i < rows.rows(); ++i) {
    if (!basis.append(rows.row(i), rows.columns(), i)) continue;
    const Vector& r = basis.r.back();
    const double met = dot(rows.row(i), solution.data(), rows.columns());
    add_scaled(solution.data(), (value[i] - met) / r.back(), basis.q.back().data(), rows.columns());
  }
  return solution;
}

}  // namespace glissade::fastest
