#include "optimize/conflicts/energy_left.hpp"

#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/quantity.hpp"
#include "glissade/core/units.hpp"

#include "optimize/problem/scaled_problem.hpp"

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

/// Whether nothing but gravity can add to the energy of the body's one speed.
bool only_loses(const Body& body) {
  const bool point = !body.law || (body.law->inertia() == 1.0 && body.law->centre_height() == 0.0 &&
                                   !body.law->depends_on_speed() && body.law->side() == 1.0);
  return point && !is_driven_by_wind(body) && !body.landing && !body.approach;
}

/// How far down the finish may lie; none where as far as one likes.
std::optional<double> deepest(const Problem& problem) {
  switch (problem.finish.kind) {
    case FinishKind::point:
    case FinishKind::level:
      return problem.endpoints.drop;
    case FinishKind::vertical_line:
      return problem.finish.free_range.highest;
    case FinishKind::anywhere:
      return problem.finish.free_drop.highest;
  }
  return std::nullopt;
}

/// Limits hold at every friction of the range, so that its highest one tells; of one that changes, the least.
Friction telling_friction(const Problem& problem) {
  Friction friction = problem.high_friction.value_or(problem.body.friction);
  for (const FrictionChange& change : problem.body.friction_changes)
    friction = std::min(friction, change.friction);
  return friction;
}

/// What friction leaves of the squared speed at a finish that is given; none where it says nothing.
std::optional<double> most_square_left(const Problem& problem) {
  const double run = std::fabs(problem.endpoints.run);
  const double drop = problem.endpoints.drop;
  const double mu = telling_friction(problem).coefficient();
  Slopes entry;
  entry.hold(problem.limits.slope_angle);
  Slopes exit = entry;
  entry.hold(problem.limits.entry_slope_angle);
  exit.hold(problem.limits.exit_slope_angle);
  const double entry2 = problem.body.entry_speed * problem.body.entry_speed;
  const double grown =
      2.0 * problem.gravity * (drop - mu * run) * math::exp(-2.0 * mu * math::atan2(drop, run));
  const double weighted = entry2 * math::exp(-2.0 * mu * entry.flattest) + grown;
  const double square = weighted * math::exp(2.0 * mu * exit.steepest);
  // Below nothing is left: that no track arrives is told elsewhere.
  if (!(square > 0.0) || !std::isfinite(square)) return std::nullopt;
  return square;
}

}  // namespace

std::optional<double> most_speed_left(const Problem& problem) {
  const std::optional<double> drop = deepest(problem);
  if (!drop || !only_loses(problem.body)) return std::nullopt;
  const double entry2 = problem.body.entry_speed * problem.body.entry_speed;
  double square = entry2 + 2.0 * problem.gravity * *drop;
  if (!(square > 0.0)) return std::nullopt;
  if (problem.finish.kind == FinishKind::point)
    square = std::min(square, most_square_left(problem).value_or(square));
  return std::sqrt(square);
}

std::optional<double> most_speed_after(const Problem& problem, double length) {
  if (!only_loses(problem.body)) return std::nullopt;
  const double entry = problem.body.entry_speed;
  return std::sqrt(entry * entry + 2.0 * problem.gravity * length);
}

std::optional<double> least_speed_left(const Problem& problem) {
  const Body& body = problem.body;
  if (problem.finish.kind != FinishKind::point || !is_sliding_point(body) || body.drag_per_metre > 0.0) {
    return std::nullopt;
  }
  // The limits hold at every friction of the range, so that its least one tells.
  return left_at(problem, problem.low_friction.value_or(body.friction).coefficient());
}

double creeping_speed(const Problem& problem, double length) {
  const double entry = problem.body.entry_speed;
  return std::sqrt(kCreep * (2.0 * problem.gravity * length + entry * entry));
}

std::optional<Creep> creep_at_best(const Problem& problem) {
  // Ten times what creeping takes, and as much again for drag.
  constexpr double kEnough = 100.0;  // taste
  if (problem.finish.kind != FinishKind::point) return std::nullopt;
  const std::optional<double> most = most_speed_left(problem);
  const Endpoints& ends = problem.endpoints;
  const double chord = math::hypot(ends.run, ends.drop);
  const double counted = creeping_speed(problem, chord);
  if (!most || *most >= counted) return std::nullopt;
  return Creep{*most, counted, ends.drop + kEnough * kCreep * chord};
}

std::string creep_text(const Creep& creep) {
  constexpr int kDigits = 6;  // accuracy: it lies a ten-thousandth of the chord above the drop
  return "no track brings the body to the finish faster than " + quantity_text(creep.most, Dimension::speed) +
         ", and what arrives at less than " + quantity_text(creep.counted, Dimension::speed) +
         " a search takes for lying still: drop and friction are so near to what ends the ride that tracks "
         "cannot be told "
         "apart; try a drop of " +
         length_text(creep.enough, kDigits) + " or more, less friction or an entry speed";
}

}  // namespace glissade::optimizer
