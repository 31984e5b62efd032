#include "centerline/profile/interpolating_spline.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace glissade::centerline {
namespace {

constexpr std::size_t kMostDegree = 5;

/// The basis functions of this degree that are not 0 in one span, by de Boor's recurrence.
std::array<double, kMostDegree + 1> basis(const std::vector<double>& knots, std::size_t span,
                                          std::size_t degree, double t) {
  std::array<double, kMostDegree + 1> values{1.0};
  for (std::size_t p = 1; p <= degree; ++p) {
    double carried = 0.0;
    for (std::size_t i = 0; i < p; ++i) {
      const double right = knots[span + 1 + i];
      const double left = knots[span + 1 + i - p];
      const double share = values[i] / (right - left);
      values[i] = carried + (right - t) * share;
      carried = (t - left) * share;
    }
    values[p] = carried;
  }
  return values;
}

}  // namespace

InterpolatingSpline::InterpolatingSpline(std::vector<double> parameters, const std::vector<Vec2>& values,
                                         SplineDegree degree)
    : degree_(static_cast<std::size_t>(degree)) {
  const std::size_t count = parameters.size();
  const std::size_t left_out = (degree_ + 1) / 2;
  knots_.assign(degree_ + 1, parameters.front());
  for (std::size_t i = left_out; i + left_out < count; ++i) knots_.push_back(parameters[i]);
  knots_.insert(knots_.end(), degree_ + 1, parameters.back());
  solve(parameters, values);
}

std::size_t InterpolatingSpline::span_of(double t) const {
  const auto first = knots_.begin() + static_cast<std::ptrdiff_t>(degree_) + 1;
  const auto last = knots_.end() - static_cast<std::ptrdiff_t>(degree_) - 1;
  return static_cast<std::size_t>(std::upper_bound(first, last, t) - knots_.begin()) - 1;
}

/// Elimination within the band: the matrix is totally positive, so that no rows need change places.
void InterpolatingSpline::solve(const std::vector<double>& parameters, const std::vector<Vec2>& values) {
  const std::size_t count = parameters.size();
  const std::size_t width = 2 * degree_ + 1;  // column - row + degree
  std::vector<double> rows(count * width, 0.0);
  const auto entry = [&](std::size_t row, std::size_t column) -> double& {
    return rows[row * width + column + degree_ - row];
  };
  for (std::size_t row = 0; row < count; ++row) {
    const std::size_t span = span_of(parameters[row]);
    const auto functions = basis(knots_, span, degree_, parameters[row]);
    for (std::size_t i = 0; i <= degree_; ++i) {
      // What lies outside the band is 0 but for rounding (Schoenberg and Whitney).
      const std::size_t column = span - degree_ + i;
      if (column + degree_ >= row && column <= row + degree_) entry(row, column) = functions[i];
    }
  }
  coefficients_ = values;
  for (std::size_t pivot = 0; pivot < count; ++pivot) {
    const std::size_t end = std::min(count, pivot + degree_ + 1);
    for (std::size_t row = pivot + 1; row < end; ++row) {
      const double factor = entry(row, pivot) / entry(pivot, pivot);
      if (factor == 0.0) continue;
      for (std::size_t column = pivot + 1; column < end; ++column) {
        entry(row, column) -= factor * entry(pivot, column);
      }
      coefficients_[row] = coefficients_[row] - factor * coefficients_[pivot];
    }
  }
  for (std::size_t row = count; row-- > 0;) {
    Vec2 sum = coefficients_[row];
    for (std::size_t column = row + 1; column < std::min(count, row + degree_ + 1); ++column) {
      sum = sum - entry(row, column) * coefficients_[column];
    }
    coefficients_[row] = (1.0 / entry(row, row)) * sum;
  }
}

InterpolatingSpline::Place InterpolatingSpline::at(double t) const {
  const std::size_t span = span_of(t);
  const std::size_t first = span - degree_;
  // Derivatives are splines of lower degree, their coefficients differences of those before.
  std::array<Vec2, kMostDegree + 1> here{};
  for (std::size_t i = 0; i <= degree_; ++i) here[i] = coefficients_[first + i];
  const auto combined = [&](std::size_t degree) {
    const auto functions = basis(knots_, span, degree, t);
    Vec2 sum;
    for (std::size_t i = 0; i <= degree; ++i) sum = sum + functions[i] * here[i];
    return sum;
  };
  const auto differentiate = [&](std::size_t degree) {
    for (std::size_t i = 0; i < degree; ++i) {
      const std::size_t knot = span - degree + 1 + i;
      const double stretch = knots_[knot + degree] - knots_[knot];
      here[i] = (static_cast<double>(degree) / stretch) * (here[i + 1] - here[i]);
    }
  };
  Place place;
  place.value = combined(degree_);
  differentiate(degree_);
  place.first = combined(degree_ - 1);
  differentiate(degree_ - 1);
  place.second = combined(degree_ - 2);
  return place;
}

}  // namespace glissade::centerline
