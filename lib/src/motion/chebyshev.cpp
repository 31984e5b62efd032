#include "chebyshev.hpp"

#include "glissade/core/math.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <boost/math/quadrature/gauss.hpp>

namespace glissade::motion::chebyshev {
namespace {

constexpr std::size_t kDegree = kNodes - 1;
using Matrix = std::array<Values, kNodes>;

double dot(const Values& a, const Values& b) {
  double sum = 0.0;
  for (std::size_t j = 0; j < kNodes; ++j) sum += a[j] * b[j];
  return sum;
}

Values product(const Matrix& matrix, const Values& f) {
  Values result;
  for (std::size_t i = 0; i < kNodes; ++i) result[i] = dot(matrix[i], f);
  return result;
}

Values make_nodes() {
  Values x;
  for (std::size_t j = 0; j < kNodes; ++j) {
    const double half_angle = 0.5 * std::numbers::pi * static_cast<double>(j) / kDegree;
    x[j] = math::sin(half_angle) * math::sin(half_angle);
  }
  x.back() = 1.0;
  return x;
}

/// Weights of the barycentric formula at these nodes, up to a common factor.
double barycentric_weight(std::size_t j) {
  const double size = j == 0 || j == kDegree ? 0.5 : 1.0;
  return j % 2 == 0 ? size : -size;
}

Values barycentric_weights() {
  Values weights;
  for (std::size_t j = 0; j < kNodes; ++j) weights[j] = barycentric_weight(j);
  return weights;
}

/// The values at x of the polynomials that are 1 at one node and 0 at the others.
Values basis_at(double x) {
  static const Values weights = barycentric_weights();
  const Values& x_nodes = nodes();
  Values basis{};
  // Loops of one kind each, which the compiler does several at a time.
  Values distance;
  for (std::size_t j = 0; j < kNodes; ++j) distance[j] = x - x_nodes[j];
  for (std::size_t j = 0; j < kNodes; ++j) {
    if (distance[j] != 0.0) continue;
    basis[j] = 1.0;
    return basis;
  }
  for (std::size_t j = 0; j < kNodes; ++j) basis[j] = weights[j] / distance[j];
  double sum = 0.0;
  for (const double value : basis) sum += value;
  for (double& value : basis) value /= sum;
  return basis;
}

/// Row i: Int_0^1 basis(x_i t) weight(t) dt, by a Gauss rule that is exact for it, of those that Boost has as a
/// table: nodes that it computes vary by processor.
template <class Weight>
Matrix mean_matrix(const Weight& weight) {
  using Rule = boost::math::quadrature::gauss<double, 20>;
  static_assert(kNodes <= 2 * 20 - 1);  // degree kNodes - 1, times a weight of degree 1
  Matrix matrix{};
  const auto add = [&](std::size_t row, double t, double gauss_weight) {
    const Values basis = basis_at(nodes()[row] * t);
    for (std::size_t j = 0; j < kNodes; ++j) matrix[row][j] += 0.5 * gauss_weight * weight(t) * basis[j];
  };
  for (std::size_t row = 0; row < kNodes; ++row) {
    for (std::size_t i = 0; i < Rule::abscissa().size(); ++i) {
      add(row, 0.5 * (1.0 - Rule::abscissa()[i]), Rule::weights()[i]);
      add(row, 0.5 * (1.0 + Rule::abscissa()[i]), Rule::weights()[i]);
    }
  }
  return matrix;
}

Matrix coefficient_matrix() {
  Matrix matrix{};
  for (std::size_t k = 0; k < kNodes; ++k) {
    for (std::size_t j = 0; j < kNodes; ++j) {
      const double halves = (k == 0 || k == kDegree ? 0.5 : 1.0) * (j == 0 || j == kDegree ? 0.5 : 1.0);
      // Node j lies at -cos(j pi / n) on [-1, 1]; the angle is reduced so that it stays exact.
      const double turn = static_cast<double>((k * (kDegree - j)) % (2 * kDegree)) / kDegree;
      matrix[k][j] = 2.0 * halves / kDegree * math::cos_pi(turn);
    }
  }
  return matrix;
}

Matrix derivative_matrix() {
  const Values& x = nodes();
  Matrix matrix{};
  for (std::size_t i = 0; i < kNodes; ++i) {
    double sum = 0.0;
    for (std::size_t j = 0; j < kNodes; ++j) {
      if (i == j) continue;
      matrix[i][j] = barycentric_weight(j) / barycentric_weight(i) / (x[i] - x[j]);
      sum += matrix[i][j];
    }
    matrix[i][i] = -sum;
  }
  return matrix;
}

}  // namespace

const Values& nodes() {
  static const Values values = make_nodes();
  return values;
}

Values running_mean(const Values& f) {
  static const Matrix matrix = mean_matrix([](double) { return 1.0; });
  return product(matrix, f);
}

Values weighted_running_mean(const Values& f) {
  static const Matrix matrix = mean_matrix([](double t) { return 2.0 * t; });
  return product(matrix, f);
}

Values coefficients(const Values& f) {
  static const Matrix matrix = coefficient_matrix();
  return product(matrix, f);
}

Values derivative(const Values& f) {
  static const Matrix matrix = derivative_matrix();
  return product(matrix, f);
}

double extrapolated_to_zero(const Values& f) {
  // Through the other nodes goes a polynomial of one degree less: the divided difference over all nodes is
  // zero.
  double sum = 0.0;
  for (std::size_t j = 1; j < kNodes; ++j) sum += barycentric_weight(j) * f[j];
  return -sum / barycentric_weight(0);
}

Range range(const Values& f) {
  const Values c = coefficients(f);
  double spread = 0.0;
  for (std::size_t k = 1; k < kNodes; ++k) spread += std::fabs(c[k]);
  return {c[0] - spread, c[0] + spread};
}

double tail(const Values& f) {
  const Values c = coefficients(f);
  const auto smaller = [](double a, double b) { return std::fabs(a) < std::fabs(b); };
  const double size = std::fabs(*std::max_element(f.begin(), f.end(), smaller));
  if (size == 0.0) return 0.0;
  return std::fabs(*std::max_element(c.end() - 3, c.end(), smaller)) / size;
}

Interpolation::Interpolation(double x) : weights_(basis_at(x)) {}

double Interpolation::operator()(const Values& f) const {
  return dot(weights_, f);
}

}  // namespace glissade::motion::chebyshev
