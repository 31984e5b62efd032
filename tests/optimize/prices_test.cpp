// Prices of random problems against central differences of re-solves.

#include "optimize/changed_bound.hpp"
#include "optimize/drawn_problems.hpp"
#include "optimize/random_limits.hpp"
#include "support/catch.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>

using namespace glissade;

namespace {

// What a price may miss of the central difference.
constexpr double kAccuracy = 0.02;
// By so much of the objective two searches of neighbouring problems may end apart.
constexpr double kSearchNoise = 5e-7;
// A step is to win this share of the objective, ...
constexpr double kShare = 2e-4;
// ... but to change its bound by no more than this share.
constexpr double kLongestStep = 0.01;
// Prices below this many times the noise of such a difference are not compared.
constexpr double kTells = 50.0;

double objective_of(const Problem& problem, const OptimizeReport& report) {
  return problem.objective.kind == ObjectiveKind::exit_speed ? -report.exit_speed : report.travel_time;
}

/// Which way a bound gives way; an exact one is moved towards larger values.
double giving_way(const ActiveLimit& active) {
  const bool shrinks = active.limit.bound == Bound::lowest;
  return shrinks ? -1.0 : 1.0;
}

struct Differences {
  double tighter = 0.0;  ///< price by the tighter neighbour alone
  double looser = 0.0;   ///< by the looser one
  double noise = 0.0;    ///< of either

  [[nodiscard]] double central() const { return 0.5 * (tighter + looser); }
  /// Whether the price is told between two that differ: the bound lies where another limit begins to bind.
  [[nodiscard]] bool has_kink_at(double price) const {
    const auto [low, high] = std::minmax(tighter, looser);
    return high - low > 2.0 * kAccuracy * high && price > low - noise && price < high + noise;
  }
};

/// @return none where no difference tells, or a neighbour has no track
std::optional<Differences> differences_of(const Problem& problem, const OptimizeReport& report,
                                          const ActiveLimit& active) {
  const double objective = objective_of(problem, report);
  const double wanted = kShare * std::fabs(objective) / active.price;
  const double step = std::min(wanted, kLongestStep * std::fabs(active.value));
  const double noise = kSearchNoise * std::fabs(objective) / step;
  if (!(active.price > kTells * noise)) return std::nullopt;
  const auto objective_at = [&](double change) -> std::optional<double> {
    const auto changed =
        optimizer::with_bound(problem, active.limit, active.value + change * giving_way(active));
    if (!changed) return std::nullopt;
    const OptimizeReport there = optimize(*changed).report;
    if (there.status != OptimizeStatus::optimal) return std::nullopt;
    return objective_of(*changed, there);
  };
  const auto tight = objective_at(-step);
  const auto loose = objective_at(step);
  if (!tight || !loose) return std::nullopt;
  const double sign = active.limit.bound == Bound::exactly && *loose > *tight ? -1.0 : 1.0;
  return Differences{sign * (*tight - objective) / step, sign * (objective - *loose) / step, noise};
}

}  // namespace

TEST_CASE("prices of random problems are what re-solves win, to 2 %") {
  testing::Random random = testing::seeded_random(20250305);
  INFO("GLISSADE_SEED=" << random.seed());
  // docs/optimization.md tells what more of them find.
  const bool asked = std::getenv("GLISSADE_PROBLEMS") != nullptr;
  const int problems = asked ? testing_problems::problem_count() : 12;
  int compared = 0;
  int kinks = 0;
  for (int i = 0; i < problems; ++i) {
    Problem problem = testing_problems::drawn(random);
    for (HalfPlane& plane : problem.limits.half_planes) {
      // A clearance that can give way.
      plane.clearance = 0.05 * std::hypot(problem.endpoints.run, problem.endpoints.drop);
      plane.point.y += plane.clearance;
    }
    const OptimizeReport report = optimize(problem).report;
    if (report.status != OptimizeStatus::optimal) continue;
    for (const ActiveLimit& active : report.active) {
      const auto differences = differences_of(problem, report, active);
      if (!differences) continue;
      ++compared;
      CAPTURE(i, active.limit.key(), active.price, differences->tighter, differences->looser);
      if (differences->has_kink_at(active.price)) {
        ++kinks;
        continue;
      }
      CHECK(std::fabs(active.price - differences->central()) <=
            kAccuracy * differences->central() + differences->noise);
    }
  }
  CAPTURE(compared, kinks);
  CHECK(compared > problems / 2);
  CHECK(kinks <= compared / 4);
}
