#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

namespace glissade::optimizer {

/// The least value found of a function of few variables that is costly, may have no value at places, and whose
/// derivatives nobody knows.
struct BoxMinimum {
  std::vector<double> at;  ///< each within 0 to 1
  double value = 0.0;
  /// Known to kBoxAccuracy; false where `ends` said so before, or kMostBoxValues were looked at.
  bool to_the_end = false;
};

/// The middle of the box and the middles of its sides are looked at; from the best of them NLopt's search by quadratic
/// models (LN_BOBYQA, of two variables or more) goes on until the box is known to kBoxAccuracy; where there is no value at
/// a place that it looks at, the subplex search (LN_SBPLX).
/// @param value  +infinity where there is none
/// @param ends   asked before each evaluation beyond the first: whether the best so far is to do
/// @return none if no value was found
[[nodiscard]] std::optional<BoxMinimum> least_in_box(
    std::size_t variables, const std::function<double(const std::vector<double>&)>& value,
    const std::function<bool()>& ends);

/// Of each side of the box.
inline constexpr double kBoxAccuracy = 1e-3;  // taste
/// Places that one engine looks at.
inline constexpr int kMostBoxValues = 120;  // budget: twice what three variables took

}  // namespace glissade::optimizer
