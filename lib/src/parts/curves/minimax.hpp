#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace glissade::parts {

/// One bounded value: -room - below t <= base + A x <= room + above t.
struct MinimaxRow {
  std::size_t first = 0;          ///< of the three columns that are not zero here; may be a dropped one
  std::array<double, 3> value{};  ///< of them
  double base = 0.0;
  double above = 1.0;  ///< >= 0
  double below = 1.0;  ///< >= 0
  double room = 0.0;   ///< >= 0
};

/// The least t for which every row keeps its bounds.
struct MinimaxResult {
  std::vector<double> x;  ///< one a column; dropped ones are 0
  double t = 0.0;
};

/// Minimax of a piecewise quadratic by a primal-dual interior point method (S. Mehrotra, SIAM J. Optim. 2(4), 1992):
/// the normal equations have three diagonals and a border, so that a step costs O(rows + columns).
/// @param dropped  one a column; true: it stays 0
/// @param gap      of t, between the value and its bound from below, at which it ends
[[nodiscard]] MinimaxResult minimax(const std::vector<MinimaxRow>& rows, const std::vector<bool>& dropped,
                                    double gap = 1e-6);

}  // namespace glissade::parts
