#pragma once

#include "parts/curves/circle_pieces.hpp"
#include "parts/curves/minimax.hpp"

#include <cstddef>
#include <vector>

namespace glissade::parts {

/// The values of the three Bernstein polynomials of a place in a cell, as a row of minimax() in its ordinates: one a joint
/// and between them one a cell.
[[nodiscard]] MinimaxRow bernstein_row(const std::vector<double>& knots, std::size_t cell, double s,
                                       double offset);

/// A row for each of some samples of each cell, and for the farthest ones to either side.
/// @param first,last  of the samples that offsets are of, the first and the one after the last
/// @param offsets     of the samples [m]
[[nodiscard]] std::vector<MinimaxRow> spline_rows(const TrackSamples& samples, std::size_t first,
                                                  std::size_t last, const std::vector<double>& knots,
                                                  const std::vector<double>& offsets);

/// A row that keeps the second ordinate, and with it a free start's slope, from falling.
/// @param more  by which it may fall [m]
/// @param far   more than it can be expected to rise by [m]
[[nodiscard]] MinimaxRow start_row(double more, double far);

/// The change by a quadratic spline with continuous slope that makes the largest offset least.
/// @param rows  from spline_rows()
/// @param tangent_first,tangent_last  whether the slope at that end stays; its value there stays always
/// @return its ordinates, and the largest offset that the rows have then, to a thousandth
[[nodiscard]] MinimaxResult best_change(const std::vector<double>& knots, const std::vector<MinimaxRow>& rows,
                                        bool tangent_first, bool tangent_last);

/// Gap of minimax() that is close enough for either.
inline constexpr double kSplineGap = 1e-3;

}  // namespace glissade::parts
