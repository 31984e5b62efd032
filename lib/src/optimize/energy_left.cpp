#include "optimize/energy_left.hpp"

#include "glissade/core/math.hpp"
#include "glissade/core/units.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace glissade::optimizer {
namespace {

// What the grid of slopes may miss of the bound, and rounding, as a share of gravity times the chord.
constexpr double kSafety = 1e-5;

struct Slopes {
  double flattest = -kRightAngle;
  double steepest = kRightAngle;

  void hold(const Range& range) {
    if (range.lowest) flattest = std::max(flattest, *range.lowest);
    if (range.highest) steepest = std::min(steepest, *range.highest);
  }
};

/// Lower convex envelope of h(q)/(2 g) over the slopes, at q = mean. By duality it is the greatest of all lines
/// through (mean, .) that stay below: whatever the slope of the line, what it gives is a lower bound.
double envelope(const Slopes& slopes, double mu, double mean) {
  constexpr int kGrid = 2048;              // taste
  constexpr int kThirds = 100;             // rounding: (2/3)^100
  constexpr double kNearlyUpright = 1e-3;  // taste
  const double from = slopes.flattest;
  const double to = std::min(slopes.steepest, kRightAngle - kNearlyUpright);
  std::vector<double> q;
  std::vector<double> h;
  for (int i = 0; i <= kGrid; ++i) {
    const double zeta = from + (to - from) * i / kGrid;
    q.push_back(math::tan(zeta));
    h.push_back((q.back() - mu) * math::exp(-2.0 * mu * zeta));
  }
  const auto below = [&](double line) {
    double least = HUGE_VAL;
    for (std::size_t i = 0; i < q.size(); ++i) least = std::min(least, h[i] - line * (q[i] - mean));
    return least;
  };
  // Towards the vertical h grows as q e^(-mu pi): a line that is steeper crosses it in the end.
  const bool upright = slopes.steepest > to;
  double low = -1.0;
  double high =
      upright ? math::exp(-2.0 * mu * kRightAngle) : (1.0 + 2.0 * mu) * math::exp(2.0 * mu * kRightAngle);
  for (int i = 0; i < kThirds; ++i) {
    const double left = low + (high - low) / 3.0;
    const double right = high - (high - low) / 3.0;
    if (below(left) < below(right)) {
      low = left;
    } else {
      high = right;
    }
  }
  return below(0.5 * (low + high));
}

/// Of one friction.
std::optional<double> left_at(const Problem& problem, double mu) {
  const double run = std::fabs(problem.endpoints.run);
  const double drop = problem.endpoints.drop;
  const double entry2 = problem.body.entry_speed * problem.body.entry_speed;
  if (mu == 0.0) return std::sqrt(std::max(0.0, entry2 + 2.0 * problem.gravity * drop));
  Slopes all;
  all.hold(problem.limits.slope_angle);
  Slopes entry = all;
  entry.hold(problem.limits.entry_slope_angle);
  Slopes exit = all;
  exit.hold(problem.limits.exit_slope_angle);
  const double mean = math::atan2(drop, run);
  if (!(all.flattest > -kRightAngle) || !(all.flattest < mean && mean < all.steepest)) return std::nullopt;
  const double grown = 2.0 * problem.gravity * run * envelope(all, mu, drop / run) -
                       kSafety * problem.gravity * math::hypot(run, drop);
  const double weighted = entry2 * math::exp(-2.0 * mu * entry.steepest) + grown;
  if (!(weighted > 0.0)) return std::nullopt;
  return std::sqrt(weighted * math::exp(2.0 * mu * exit.flattest));
}

}  // namespace

std::optional<double> least_speed_left(const Problem& problem) {
  const Body& body = problem.body;
  if (problem.finish.kind != FinishKind::point || !is_sliding_point(body) || body.drag_per_metre > 0.0) {
    return std::nullopt;
  }
  // The limits hold at every friction of the range, so that its least one tells.
  return left_at(problem, problem.low_friction.value_or(body.friction).coefficient());
}

}  // namespace glissade::optimizer
