#include "parts/curves/spline_change.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace glissade::parts {
namespace {

constexpr std::size_t kRowsPerCell = 5;

}  // namespace

MinimaxRow bernstein_row(const std::vector<double>& knots, std::size_t cell, double s, double offset) {
  const double v = (s - knots[cell]) / (knots[cell + 1] - knots[cell]);
  return {2 * cell, {(1.0 - v) * (1.0 - v), 2.0 * v * (1.0 - v), v * v}, offset, 1.0, 1.0, 0.0};
}

std::vector<MinimaxRow> spline_rows(const TrackSamples& samples, std::size_t first, std::size_t last,
                                    const std::vector<double>& knots, const std::vector<double>& offsets) {
  std::vector<MinimaxRow> rows;
  const auto index_of = [&](double s) { return std::clamp(index_at(samples, s), first, last); };
  for (std::size_t cell = 0; cell + 1 < knots.size(); ++cell) {
    const std::size_t from = index_of(knots[cell]);
    const std::size_t to = index_of(knots[cell + 1]);
    if (from >= to) continue;
    const auto add = [&](std::size_t j) {
      rows.push_back(bernstein_row(knots, cell, samples.s[j], offsets[j - first]));
    };
    const std::size_t count = to - from;
    const std::size_t taken = std::min(count, kRowsPerCell);
    for (std::size_t k = 0; k < taken; ++k) add(from + (2 * k + 1) * count / (2 * taken));
    const auto begin = offsets.begin() + static_cast<std::ptrdiff_t>(from - first);
    const auto [least, most] = std::minmax_element(begin, begin + static_cast<std::ptrdiff_t>(count));
    add(from + static_cast<std::size_t>(least - begin));
    add(from + static_cast<std::size_t>(most - begin));
  }
  return rows;
}

MinimaxRow start_row(double more, double far) {
  const double room = std::fabs(more) + far;
  return {0, {0.0, 1.0, 0.0}, more - room, 0.0, 0.0, room};
}

MinimaxResult best_change(const std::vector<double>& knots, const std::vector<MinimaxRow>& rows,
                          bool tangent_first, bool tangent_last) {
  const std::size_t n = knots.size() - 1;
  // The ordinate at a joint lies on the line between those of the arcs beside it: what the one before gives. So the
  // unknowns are those of the arcs, between the ones of both ends.
  std::vector<double> share(n + 1, 0.0);
  share.front() = 1.0;
  for (std::size_t i = 1; i < n; ++i) share[i] = (knots[i + 1] - knots[i]) / (knots[i + 1] - knots[i - 1]);
  std::vector<MinimaxRow> reduced = rows;
  for (MinimaxRow& row : reduced) {
    const std::size_t cell = row.first / 2;
    const auto [from, middle, to] = row.value;
    row.first = cell;
    row.value = {from * share[cell], from * (1.0 - share[cell]) + middle + to * share[cell + 1],
                 to * (1.0 - share[cell + 1])};
  }
  std::vector<bool> fixed(n + 2, false);
  fixed.front() = fixed.back() = true;
  if (tangent_first) fixed[1] = true;
  if (tangent_last) fixed[n] = true;
  const auto [x, most] = minimax(reduced, fixed, kSplineGap);
  std::vector<double> ordinates(2 * n + 1, 0.0);
  for (std::size_t i = 0; i < n; ++i) ordinates[2 * i + 1] = x[i + 1];
  for (std::size_t i = 1; i < n; ++i) ordinates[2 * i] = share[i] * x[i] + (1.0 - share[i]) * x[i + 1];
  return {std::move(ordinates), most};
}

}  // namespace glissade::parts
