#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace glissade::parts {

/// What stands along the track no farther apart than a spacing, where only some places are free.
struct RowTask {
  std::vector<double> places;  ///< ascending [m]
  double from = 0.0;           ///< where the first span begins [m]
  double to = 0.0;             ///< where the last one ends [m]
  double spacing = 0.0;        ///< that spans are not to exceed [m]
  double end_weight = 1.0;     ///< times the spans at both ends, which may count more than those between
  std::size_t least = 1;       ///< that a row has at least, where there are places: 1 or 2
  /// Whether one place and another after it, by their indices, may both be taken.
  std::function<bool(std::size_t, std::size_t)> beside;
};

/// What a row falls short of what is asked for, and what it takes.
struct RowCost {
  double excess = 0.0;    ///< sum of squares of what spans are wider than asked for [m^2]
  std::size_t count = 0;  ///< of places
  double uneven = 0.0;    ///< sum of squares of spans [m^2]

  /// @param span  one more
  [[nodiscard]] RowCost with(double span, double spacing) const;
};

/// @param row  indices of places, ascending; not empty
/// @return of that row
[[nodiscard]] RowCost cost_of(const RowTask& task, const std::vector<std::size_t>& row);

/// Of all rows the one of the least excess, then of the fewest places, then the most even.
///
/// Exact over the places given: each is reached by the best row that ends there. Takes the square of their number.
/// @return indices of places, ascending; empty where there are none
[[nodiscard]] std::vector<std::size_t> cheapest_row(const RowTask& task);

}  // namespace glissade::parts
