#pragma once

#include <algorithm>
#include <vector>

namespace glissade::optimizer {

inline constexpr double kBoundAccuracy = 1e-9;  // of the bound; accuracy
// Of a bound that no track keeps, whatever its speed: a hundred times the accuracy of a limit.
inline constexpr double kKeptAccuracy = 1e-6;
/// What a search told of a bound.
enum class Verdict {
  does,          ///< a track keeps it and reaches the speed
  too_slow,      ///< the fastest track that keeps it does not reach the speed
  kept_by_none,  ///< no track keeps it, whatever its speed
  untold         ///< the search came to no end: that proves nothing
};

/// What is known of the bounds: they do from `loose` on, and do not up to `tight`.
struct Bracket {
  double loose = 0.0;
  double tight = 0.0;
  Verdict why = Verdict::too_slow;  ///< of `tight`
  std::vector<double> untold;       ///< between the two, ascending

  [[nodiscard]] double floor() const { return untold.empty() ? tight : untold.back(); }
  void learn(double bound, Verdict verdict) {
    if (verdict == Verdict::untold) {
      untold.insert(std::upper_bound(untold.begin(), untold.end(), bound), bound);
    } else if (verdict == Verdict::does) {
      loose = std::min(loose, bound);
    } else if (bound > tight) {
      tight = bound;
      why = verdict;
    }
    // A looser bound does where a tighter one does.
    std::erase_if(untold, [&](double one) { return one <= tight || one >= loose; });
  }
  [[nodiscard]] double accuracy() const {
    return untold.empty() && why == Verdict::too_slow ? kBoundAccuracy : kKeptAccuracy;
  }
  [[nodiscard]] bool is_closed() const { return loose - floor() <= accuracy() * loose; }
};

}  // namespace glissade::optimizer
