#include "support/cramer_rao.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace testing {

using namespace glissade;

namespace {

using Matrix = std::vector<std::vector<double>>;

/// Solves a symmetric positive definite system by elimination, scaled to a diagonal of ones.
std::vector<double> solved(Matrix matrix, std::vector<double> right) {
  const std::size_t size = right.size();
  std::vector<double> scale(size);
  for (std::size_t i = 0; i < size; ++i) scale[i] = 1.0 / std::sqrt(matrix[i][i]);
  for (std::size_t i = 0; i < size; ++i) {
    right[i] *= scale[i];
    for (std::size_t j = 0; j < size; ++j) matrix[i][j] *= scale[i] * scale[j];
  }
  for (std::size_t i = 0; i < size; ++i) {
    for (std::size_t r = i + 1; r < size; ++r) {
      const double factor = matrix[r][i] / matrix[i][i];
      for (std::size_t c = i; c < size; ++c) matrix[r][c] -= factor * matrix[i][c];
      right[r] -= factor * right[i];
    }
  }
  for (std::size_t i = size; i-- > 0;) {
    for (std::size_t c = i + 1; c < size; ++c) right[i] -= matrix[i][c] * right[c];
    right[i] /= matrix[i][i];
  }
  for (std::size_t i = 0; i < size; ++i) right[i] *= scale[i];
  return right;
}

}  // namespace

double least_deviation(const ProfileMake& make, int count, double noise,
                       const std::function<double(const KnownProfile&)>& quantity) {
  constexpr double kStep = 1e-5;
  const KnownProfile known = make.known();
  const std::size_t size = make.numbers.size() + 1;  // the last: the place across
  std::vector<std::pair<KnownProfile, KnownProfile>> beside;
  std::vector<double> steps;
  std::vector<double> gradient(size, 0.0);
  for (std::size_t j = 0; j + 1 < size; ++j) {
    steps.push_back(kStep * std::fabs(make.numbers[j]));
    std::vector<double> more = make.numbers;
    std::vector<double> less = make.numbers;
    more[j] += steps[j];
    less[j] -= steps[j];
    beside.emplace_back(make.of(more), make.of(less));
    gradient[j] = (quantity(beside[j].first) - quantity(beside[j].second)) / (2.0 * steps[j]);
  }
  const auto across = [&](double s) {
    const double near = 1e-4 * known.length;
    const Vec2 along = known.at(std::min(s + near, known.length)) - known.at(std::max(s - near, 0.0));
    return 1.0 / norm(along) * Vec2{-along.y, along.x};
  };
  const Vec2 moved = across(0.0);
  Matrix information(size, std::vector<double>(size, 0.0));
  for (int i = 0; i < count; ++i) {
    const double s = known.length * (static_cast<double>(i) / (count - 1));
    const Vec2 normal = across(s);
    std::vector<double> row;
    for (std::size_t j = 0; j + 1 < size; ++j) {
      row.push_back(dot(beside[j].first.at(s) - beside[j].second.at(s), normal) / (2.0 * steps[j]));
    }
    row.push_back(dot(moved, normal));
    for (std::size_t a = 0; a < size; ++a) {
      for (std::size_t b = 0; b < size; ++b) information[a][b] += row[a] * row[b] / (noise * noise);
    }
  }
  const std::vector<double> spread = solved(information, gradient);
  double variance = 0.0;
  for (std::size_t j = 0; j < size; ++j) variance += gradient[j] * spread[j];
  return std::sqrt(variance) / std::fabs(quantity(known));
}

}  // namespace testing
