// Prices of random problems against central differences of re-solves.

#include "optimize/changed_bound.hpp"
#include "optimize/drawn_problems.hpp"
#include "optimize/random_limits.hpp"
#include "support/catch.hpp"
#include "support/thorough.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>
#include <string>

using Catch::Matchers::Contains;
using namespace glissade;

namespace {

// What a price may miss of what re-solves win.
constexpr double kAccuracy = 0.02;
// By so much of the objective two searches of neighbouring problems may end apart.
constexpr double kSearchNoise = 5e-7;
// A step is to win this share of the objective, ...
constexpr double kShare = 2e-4;
// ... but to change its bound by no more than this share.
constexpr double kLongestStep = 0.01;
// Prices below this many times the noise of such a difference are not compared.
constexpr double kTells = 50.0;
// Nor are those for which re-solves contradict each other by more than this share of the price.
constexpr double kContradiction = 0.1;

double objective_of(const Problem& problem, const OptimizeReport& report) {
  return problem.objective.kind == ObjectiveKind::exit_speed ? -report.exit_speed : report.travel_time;
}

/// Which way a bound gives way; an exact one is moved towards larger values.
double giving_way(const ActiveLimit& active) {
  const bool shrinks = active.limit.bound == Bound::lowest;
  return shrinks ? -1.0 : 1.0;
}

/// The polynomial through the chosen ones of some values (by Lagrange), between them.
double through(const std::array<double, 7>& values, unsigned chosen, double at) {
  double sum = 0.0;
  for (unsigned i = 0; i < values.size(); ++i) {
    if ((chosen >> i & 1U) == 0) continue;
    double weight = 1.0;
    for (unsigned k = 0; k < values.size(); ++k) {
      if (k != i && (chosen >> k & 1U) != 0) weight *= (at - k) / (static_cast<double>(i) - k);
    }
    sum += weight * values[i];
  }
  return sum;
}

/// What is won for each unit by which a bound gives way, between six problems whose bounds lie one step apart, the
/// problem's own in their middle.
struct Differences {
  std::array<double, 6> steps{};
  double noise = 0.0;  ///< of each

  /// At the bound itself: the slope of the cubic through four of the seven objectives that all of them lie closest to, by the
  /// sum of distances. A search that ends beside its neighbours does not move it, nor does a price that changes fast.
  [[nodiscard]] double central() const {
    std::array<double, 7> won{};
    for (std::size_t k = 0; k < steps.size(); ++k) won[k + 1] = won[k] + steps[k];
    double least = std::numeric_limits<double>::infinity();
    double slope = 0.0;
    for (unsigned chosen = 0; chosen < 1U << won.size(); ++chosen) {
      if (std::popcount(chosen) != 4) continue;
      const auto cubic = [&](double at) { return through(won, chosen, at); };
      double apart = 0.0;
      for (std::size_t k = 0; k < won.size(); ++k) apart += std::fabs(won[k] - cubic(static_cast<double>(k)));
      if (apart >= least) continue;
      least = apart;
      // Of a cubic this is its slope in the middle.
      slope = (8.0 * (cubic(3.5) - cubic(2.5)) - (cubic(4.0) - cubic(2.0))) / 6.0;
    }
    return slope;
  }
  /// On the side where the bound is tighter, and where it is looser.
  [[nodiscard]] double tighter() const { return (steps[0] + steps[1] + steps[2]) / 3.0; }
  [[nodiscard]] double looser() const { return (steps[3] + steps[4] + steps[5]) / 3.0; }
  /// How far steps on one side lie from each other, over what a smooth change between the sides explains.
  [[nodiscard]] double scatter() const {
    const double change = std::fabs(looser() - tighter());
    double most = 0.0;
    for (const std::size_t side : {std::size_t{0}, std::size_t{3}}) {
      const auto [low, high] = std::minmax({steps[side], steps[side + 1], steps[side + 2]});
      most = std::max(most, high - low - change);
    }
    return std::max(most, 0.0);
  }
  /// Whether the price is told between two that differ: the bound lies where another limit begins to bind.
  [[nodiscard]] bool has_kink_at(double price) const {
    const auto [low, high] = std::minmax(tighter(), looser());
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
  std::array<double, 7> objectives{};
  for (int k = -3; k <= 3; ++k) {
    const auto changed =
        optimizer::with_bound(problem, active.limit, active.value + k * step * giving_way(active));
    if (!changed) return std::nullopt;
    const OptimizeReport there = k == 0 ? report : optimize(*changed).report;
    if (there.status != OptimizeStatus::optimal) return std::nullopt;
    objectives[static_cast<std::size_t>(k + 3)] = objective_of(*changed, there);
  }
  const double sign =
      active.limit.bound == Bound::exactly && objectives.back() > objectives.front() ? -1.0 : 1.0;
  Differences differences;
  differences.noise = noise;
  for (std::size_t k = 0; k < differences.steps.size(); ++k) {
    differences.steps[k] = sign * (objectives[k] - objectives[k + 1]) / step;
  }
  return differences;
}

const ActiveLimit& active_of(const OptimizeReport& report, const std::string& key) {
  const auto found = std::find_if(report.active.begin(), report.active.end(),
                                  [&](const ActiveLimit& one) { return one.limit.key() == key; });
  INFO(key);
  REQUIRE(found != report.active.end());
  return *found;
}

/// What a step of a bound wins, for each unit of it; infinite against it where no track is left.
double won_by(const Problem& problem, const OptimizeReport& report, const LimitName& limit, double bound,
              double step) {
  const OptimizeReport there = optimize(*optimizer::with_bound(problem, limit, bound + step)).report;
  if (there.status == OptimizeStatus::infeasible) return -std::numeric_limits<double>::infinity();
  REQUIRE(there.status == OptimizeStatus::optimal);
  return (report.travel_time - there.travel_time) / std::fabs(step);
}

Problem shallow() {
  Problem problem;
  problem.endpoints = {10.0, 5.0};
  problem.body.friction = Friction::from_coefficient(0.2);
  problem.limits.slope_angle.lowest = 15.0 * kRightAngle / 90.0;
  return problem;
}

}  // namespace

TEST_CASE("two caps that bind at one place win nothing alone, and cost what re-solves lose") {
  Problem problem = shallow();
  const double cap = 0.995 * optimize(problem).report.exit_speed;
  problem.limits.speed.highest = cap;
  problem.limits.exit_speed.highest = cap;
  const OptimizeReport report = optimize(problem).report;
  REQUIRE(report.status == OptimizeStatus::optimal);
  for (const char* key : {"speed.highest", "exit_speed.highest"}) {
    INFO(key);
    const ActiveLimit& active = active_of(report, key);
    CHECK(active.price == Approx(0.0).margin(1e-9));
    REQUIRE(active.tightening_price);
    const double step = 1e-4 * cap;
    CHECK(won_by(problem, report, active.limit, cap, step) == Approx(0.0).margin(1e-6));
    CHECK(-won_by(problem, report, active.limit, cap, -step) ==
          Approx(*active.tightening_price).epsilon(0.02));
    CHECK_THAT(price_text(active, problem.objective), Contains("0 s per m/s looser, 0.07"));
  }
  // Any other limit has one price.
  CHECK_FALSE(active_of(report, "slope_angle.lowest").tightening_price);
}

TEST_CASE("where two limits leave one value, nothing tighter is kept, and what relief wins is told") {
  Problem problem = shallow();
  problem.endpoints.drop = 6.0;
  problem.limits.smallest_valley_radius = 3.0;
  const double angle = 25.0 * kRightAngle / 90.0;
  problem.limits.slope_angle.lowest = angle;
  problem.limits.exit_slope_angle.highest = angle;
  const OptimizeReport report = optimize(problem).report;
  REQUIRE(report.status == OptimizeStatus::optimal);
  const ActiveLimit& lowest = active_of(report, "slope_angle.lowest");
  const double step = 1e-4 * angle;
  CHECK(won_by(problem, report, lowest.limit, angle, -step) == Approx(lowest.price).epsilon(0.02));
  const ActiveLimit& exit = active_of(report, "exit_slope_angle.highest");
  CHECK(won_by(problem, report, exit.limit, angle, step) == Approx(exit.price).margin(1e-6));
  for (const ActiveLimit* const active : {&lowest, &exit}) {
    REQUIRE(active->tightening_price);
    CHECK(std::isinf(*active->tightening_price));
    CHECK_THAT(price_text(*active, problem.objective), Contains(" looser, no track tighter"));
    const double tighter = active == &lowest ? step : -step;
    CHECK(std::isinf(won_by(problem, report, active->limit, angle, tighter)));
  }
}

TEST_CASE("a place in the way that is named twice wins nothing by one name, and costs its price") {
  testing::Random random = testing::seeded_random(20250306);
  INFO("GLISSADE_SEED=" << random.seed());
  int compared = 0;
  for (int i = 0; i < 150 && compared < 6; ++i) {
    Problem problem = testing_problems::drawn(random);
    if (problem.limits.stay_above.empty()) continue;
    const OptimizeReport once = optimize(problem).report;
    const auto known = std::find_if(once.active.begin(), once.active.end(), [](const ActiveLimit& active) {
      return active.limit.id == LimitId::stay_above && active.limit.index == 0;
    });
    if (once.status != OptimizeStatus::optimal || known == once.active.end()) continue;
    problem.limits.stay_above.insert(problem.limits.stay_above.begin() + 1, problem.limits.stay_above[0]);
    const OptimizeReport twice = optimize(problem).report;
    if (twice.status != OptimizeStatus::optimal) continue;
    CAPTURE(i, known->price);
    ++compared;
    for (const char* key : {"stay_above[0]", "stay_above[1]"}) {
      const ActiveLimit& active = active_of(twice, key);
      CHECK(active.price == Approx(0.0).margin(1e-6 * known->price));
      CHECK(active.tightening() == Approx(known->price).epsilon(0.02));
    }
  }
  CHECK(compared >= 5);
}

TEST_CASE("prices of random problems are what re-solves win, to 2 %") {
  testing::Random random = testing::seeded_random(20250305);
  INFO("GLISSADE_SEED=" << random.seed());
  // docs/optimization.md tells what more of them find.
  const bool asked = std::getenv("GLISSADE_PROBLEMS") != nullptr;
  constexpr int kQuick = 25;
  constexpr int kThorough = 100;
  const int problems = asked ? testing_problems::problem_count() : testing::thorough() ? kThorough : kQuick;
  int compared = 0;
  int kinks = 0;
  int unclear = 0;
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
      // Searches of neighbouring problems that end in different valleys tell nothing of a price.
      if (differences->scatter() > kContradiction * active.price) {
        ++unclear;
        continue;
      }
      ++compared;
      CAPTURE(i, active.limit.key(), active.price, differences->steps);
      if (std::fabs(active.price - differences->central()) <=
          kAccuracy * differences->central() + differences->noise) {
        continue;
      }
      CHECK(differences->has_kink_at(active.price));
      ++kinks;
    }
  }
  CAPTURE(compared, kinks, unclear);
  CHECK(compared > problems / 2);
  CHECK(kinks <= compared / 10);
  CHECK(unclear <= compared / 4);
}
