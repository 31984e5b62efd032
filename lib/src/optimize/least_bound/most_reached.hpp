#pragma once

#include "glissade/referee/referee.hpp"
#include "glissade/task/problem.hpp"

#include <cmath>
#include <optional>

namespace glissade::optimizer {

/// @return the most of what a limit bounds, as the referee finds it on a track; none where curvature jumps
inline std::optional<double> most_reached(Problem problem, std::optional<double> Limits::*limit,
                                          const LimitName& name, const CenterlinePtr& track) {
  constexpr double kTight = 1e-9;  // accuracy: a hundredth of that of a limit
  problem.limits = {};
  problem.limits.*limit = kTight;
  for (const LimitCheck& check : check_limits(problem, track)) {
    if (check.limit == name && std::isfinite(check.reached)) return check.reached;
  }
  return std::nullopt;
}

}  // namespace glissade::optimizer
