#include "optimize/descent/programs.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace glissade::optimizer {
namespace {

void add_squares(Matrix& hessian, double factor, const Matrix& rows) {
  const std::size_t n = hessian.columns();
  for (std::size_t e = 0; e < rows.rows(); ++e) {
    const double* row = rows.row(e);
    for (std::size_t i = 0; i < n; ++i) {
      if (row[i] != 0.0) add_scaled(hessian.row(i), factor * row[i], row, n);
    }
  }
}

}  // namespace

Matrix jacobian_of(const Rows& rows, const State& state, const std::vector<Row>& set, std::size_t n) {
  Matrix jacobian = Matrix::unset(set.size(), n);
  for (std::size_t i = 0; i < set.size(); ++i) rows.gradient(state, set[i], jacobian.row(i));
  return jacobian;
}

Vector values_of(const Rows& rows, const State& state, const std::vector<Row>& set) {
  Vector values(set.size());
  for (std::size_t i = 0; i < set.size(); ++i) values[i] = rows.value(state, set[i]);
  return values;
}

double greatest_of(const Vector& values) {
  double greatest = 0.0;
  for (const double value : values) greatest = std::max(greatest, value);
  return greatest;
}

double greatest_size(const Vector& values) {
  double greatest = 0.0;
  for (const double value : values) greatest = std::max(greatest, std::fabs(value));
  return greatest;
}

ShiftedCholesky metric_of(const Matrix& hessian, const Matrix& equality, const Matrix& carrying,
                          bool bends_much) {
  constexpr double kPenalties[] = {10.0, 100.0, 1e3, 1e5};  // taste
  constexpr double kLittle = 1e-5;                          // taste
  // Where every limit had the last one, searches would lead elsewhere, and win nothing.
  const std::size_t penalties = std::size(kPenalties) - (bends_much ? 0 : 1);
  const std::size_t n = hessian.columns();
  Vector diagonal(n);
  double largest = 0.0;
  for (std::size_t i = 0; i < n; ++i) largest = std::max(largest, std::fabs(hessian(i, i)));
  for (std::size_t i = 0; i < n; ++i) diagonal[i] = std::max(std::fabs(hessian(i, i)), 1e-12 * largest);
  const bool carries = carrying.rows() > 0;
  ShiftedCholesky best;
  for (const bool with_carrying : {false, true}) {
    if (with_carrying && !carries) break;
    for (std::size_t i = 0; i < penalties; ++i) {
      Matrix convex = hessian;
      add_squares(convex, kPenalties[i], equality);
      if (with_carrying) add_squares(convex, kPenalties[i], carrying);
      const bool last = with_carrying == carries && i + 1 == penalties;
      best = ShiftedCholesky(convex, diagonal, last ? ShiftedCholesky::kLargestShift : kLittle);
      if (best.shift() <= kLittle) return best;
    }
  }
  return best;
}

Matrix shape_metric(const Transcription& track) {
  const std::vector<Station>& stations = track.stations();
  Vector weights(stations.size(), 0.0);
  for (std::size_t i = 1; i < stations.size(); ++i) {
    weights[i] = stations[i].arc_length(1.0) - stations[i - 1].arc_length(1.0);
  }
  Matrix gram = track.gram_of_dzeta(weights);
  for (std::size_t span = 0; span < track.layout().spans; ++span) {
    const std::size_t at_length = track.layout().length(span);
    gram(at_length, at_length) = 1.0;
  }
  constexpr double kStiffening = 1e-4;  // taste
  for (std::size_t i = 0; i < gram.columns(); ++i) gram(i, i) *= 1.0 + kStiffening;
  return gram;
}

}  // namespace glissade::optimizer
