// Where a load limit binds over a stretch the curvature is that of constant load, which no clothoid follows: excess
// over exact optima with an entry speed (free flight, then the extremal), and over the same search on a mesh three
// times as fine where no exact optimum is known.

#include "glissade/optimize/optimize.hpp"

#include "support/catch.hpp"
#include "support/paths.hpp"
#include "support/random.hpp"
#include "support/thorough.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <numbers>
#include <optional>
#include <vector>

#include <nlohmann/json.hpp>

namespace held_arcs_test {

using namespace glissade;

namespace {

// Of the objective, relative.
constexpr double kExcess = 1e-6;

/// A track that is ridden at the lowest load first and at the highest one from some place on, by a rule of its own
/// (Runge and Kutta's, fourth order): which of them is the fastest, no search may be slower by more than it states.
class TwoLoads {
 public:
  explicit TwoLoads(const Problem& problem)
      : run_(problem.endpoints.run),
        drop_(problem.endpoints.drop),
        gravity_(problem.gravity),
        friction_(problem.body.friction.coefficient()),
        entry_speed_(problem.body.entry_speed),
        lowest_(*problem.limits.lowest_normal_load),
        highest_(*problem.limits.highest_normal_load) {}

  /// @return none where no such track leads to the finish
  [[nodiscard]] std::optional<double> least_time() const {
    constexpr int kAngles = 30;
    double best = HUGE_VAL;
    double best_angle = 0.0;
    const double step = (kSteepest - kFlattest) / kAngles;
    for (int i = 0; i <= kAngles; ++i) {
      const double angle = kFlattest + step * i;
      const double time = least_time_from(angle);
      if (time < best) {
        best = time;
        best_angle = angle;
      }
    }
    if (best == HUGE_VAL) return std::nullopt;
    const double golden = 0.5 * (std::sqrt(5.0) - 1.0);
    double low = best_angle - step;
    double high = best_angle + step;
    while (high - low > 1e-6) {
      const double left = high - golden * (high - low);
      const double right = low + golden * (high - low);
      if (least_time_from(left) < least_time_from(right)) {
        high = right;
      } else {
        low = left;
      }
    }
    return std::min(best, least_time_from(0.5 * (low + high)));
  }

 private:
  static constexpr double kFlattest = 0.05;
  static constexpr double kSteepest = 1.5;
  static constexpr int kSteps = 200;  ///< of each load
  struct Place {
    double x = 0.0, y = 0.0, zeta = 0.0, v = 0.0, time = 0.0;
  };

  [[nodiscard]] Place rate(const Place& at, double load) const {
    const double cosine = std::cos(at.zeta);
    const double sine = std::sin(at.zeta);
    return {cosine, sine, -(load - gravity_ * cosine) / at.v, 2.0 * (gravity_ * sine - friction_ * load),
            1.0 / std::sqrt(at.v)};
  }
  [[nodiscard]] static Place moved(const Place& at, const Place& rate, double by) {
    return {at.x + by * rate.x, at.y + by * rate.y, at.zeta + by * rate.zeta, at.v + by * rate.v,
            at.time + by * rate.time};
  }
  [[nodiscard]] Place stepped(const Place& at, double load, double by) const {
    const Place k1 = rate(at, load);
    const Place k2 = rate(moved(at, k1, 0.5 * by), load);
    const Place k3 = rate(moved(at, k2, 0.5 * by), load);
    const Place k4 = rate(moved(at, k3, by), load);
    return moved(moved(moved(moved(at, k1, by / 6.0), k2, by / 3.0), k3, by / 3.0), k4, by / 6.0);
  }
  /// At the finish's run, the second load taking over after a length. Its y is NaN where it does not get there.
  [[nodiscard]] Place finish(double angle, double length) const {
    Place at{0.0, 0.0, angle, entry_speed_ * entry_speed_, 0.0};
    for (int i = 0; i < kSteps; ++i) at = stepped(at, lowest_, length / kSteps);
    // The way that is left, as far as known: halved where a step would go past the finish.
    double by = 2.0 * (run_ - at.x) / kSteps;
    for (int i = 0; i < 40 * kSteps && by > 1e-15 * run_; ++i) {
      if (!(at.v > 1e-6) || std::fabs(at.zeta) > 1.55) break;
      const Place next = stepped(at, highest_, by);
      if (next.x > run_) {
        by *= 0.5;
      } else {
        at = next;
      }
    }
    if (std::fabs(at.x - run_) > 1e-9 * run_) at.y = NAN;
    return at;
  }
  /// Of the lengths of the first part that lead to the finish.
  [[nodiscard]] double least_time_from(double angle) const {
    constexpr int kLengths = 24;
    const double longest = std::hypot(run_, drop_);
    double best = HUGE_VAL;
    double before = finish(angle, 0.0).y - drop_;
    for (int k = 1; k <= kLengths; ++k) {
      double low = longest * (k - 1) / kLengths;
      double high = longest * k / kLengths;
      const double here = finish(angle, high).y - drop_;
      if (before * here <= 0.0) {
        for (int i = 0; i < 50; ++i) {
          const double middle = 0.5 * (low + high);
          ((finish(angle, middle).y - drop_) * before > 0.0 ? low : high) = middle;
        }
        const Place end = finish(angle, low);
        if (std::fabs(end.y - drop_) < 1e-8 * drop_) best = std::min(best, end.time);
      }
      before = here;
    }
    return best;
  }

  double run_;
  double drop_;
  double gravity_;
  double friction_;
  double entry_speed_;
  double lowest_;
  double highest_;
};

double objective_of(const Problem& problem, const OptimizeReport& report) {
  return problem.objective.kind == ObjectiveKind::exit_speed ? -report.exit_speed : report.travel_time;
}

}  // namespace

TEST_CASE(
    "with an entry speed the search flies where that is fastest: at most 1e-6 above the exact optimum") {
  std::ifstream file(test_data_path("reference/entry_speed.json"));
  const nlohmann::json cases = nlohmann::json::parse(file);
  REQUIRE(cases.size() == 20);
  for (const auto& entry : cases) {
    const auto number = [&](const char* key) { return std::stod(entry.at(key).get<std::string>()); };
    Problem problem;
    problem.endpoints = {number("run"), number("drop")};
    problem.body.friction = Friction::from_coefficient(number("friction_coefficient"));
    problem.body.entry_speed = number("entry_speed");
    problem.gravity = number("gravity");
    const Optimum optimum = optimize(problem);
    const double exact = number("travel_time");
    CAPTURE(problem.endpoints.run, problem.endpoints.drop, problem.body.entry_speed, optimum.report.brief());
    CHECK(optimum.report.status == OptimizeStatus::optimal);
    CHECK(optimum.report.travel_time <= exact * (1.0 + kExcess));
    CHECK(optimum.report.travel_time >= exact * (1.0 - kOptimizeUndershoot));
  }
}

TEST_CASE("where a load is held a mesh three times as fine wins at most 1e-6") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  const int of_each = testing::thorough() ? 2 : 1;
  for (int i = 0; i < 3 * of_each; ++i) {
    Problem problem;
    const double mu = random.between(0.0, 0.5);
    const double ratio = std::max(1.3 * mu, random.between(0.2, 1.5));
    problem.endpoints = {10.0, 10.0 * ratio};
    problem.body.friction = Friction::from_coefficient(mu);
    problem.body.entry_speed = random.between(0.5, 6.0);
    if (i % 3 == 0) problem.limits.lowest_normal_load = 0.3 * problem.gravity;
    if (i % 3 == 1) problem.limits.highest_normal_load = random.between(1.2, 2.0) * problem.gravity;
    if (i % 3 == 2) problem.objective.kind = ObjectiveKind::exit_speed;
    const Optimum optimum = optimize(problem);
    OptimizeOptions finer;
    finer.pieces = 96;
    const double least = objective_of(problem, optimize(problem, finer).report);
    CAPTURE(i, mu, ratio, problem.body.entry_speed, optimum.report.brief());
    CHECK(optimum.report.status == OptimizeStatus::optimal);
    CHECK(objective_of(problem, optimum.report) - least <= kExcess * std::fabs(least));
  }
}

TEST_CASE(
    "between a lowest and a highest load the search is at most 1e-6 above a fall at the one, then a valley "
    "at the other") {
  struct Case {
    Endpoints endpoints;
    double friction;
    double entry_speed;
    double lowest;   ///< [g]
    double highest;  ///< [g]
    bool is_best;    ///< no track at a load between the two is faster
  };
  std::vector<Case> cases{{{10.0, 5.0}, 0.2, 4.0, 0.2, 1.3, true}, {{20.0, 9.0}, 0.15, 5.0, 0.5, 1.4, true}};
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (int i = 0; i < (testing::thorough() ? 40 : 1); ++i) {
    const double run = random.between(4.0, 30.0);
    const double drop = run * random.between(0.3, 0.9);
    const double friction = random.between(0.02, 0.25);
    const double entry_speed = random.between(1.0, 7.0);
    const double lowest = random.between(0.05, 0.6);
    cases.push_back({{run, drop}, friction, entry_speed, lowest, random.between(1.15, 1.8), false});
  }
  int compared = 0;
  for (const Case& entry : cases) {
    Problem problem;
    problem.endpoints = entry.endpoints;
    problem.body.friction = Friction::from_coefficient(entry.friction);
    problem.body.entry_speed = entry.entry_speed;
    problem.limits.lowest_normal_load = entry.lowest * problem.gravity;
    problem.limits.highest_normal_load = entry.highest * problem.gravity;
    const std::optional<double> by_hand = TwoLoads(problem).least_time();
    if (!by_hand) continue;
    ++compared;
    const OptimizeReport report = optimize(problem).report;
    CAPTURE(entry.endpoints.run, entry.endpoints.drop, entry.friction, entry.entry_speed, entry.lowest,
            entry.highest, *by_hand, report.brief());
    CHECK(report.status == OptimizeStatus::optimal);
    CHECK(report.travel_time <= *by_hand * (1.0 + kExcess));
    if (entry.is_best) CHECK(report.travel_time >= *by_hand * (1.0 - kExcess));
  }
  CHECK(2 * compared > static_cast<int>(cases.size()));
}

namespace {

/// A body that leaves the start at a given slope, falls from there and comes down on an extremal (docs/theory.md, a fastest
/// track with an entry speed): where it has fallen to slope angle `joint`, and the track ends at `exit`.
struct FallOnto {
  double joint = 0.0;
  double exit = 0.0;
};

struct Ending {
  double x = 0.0;
  double y = 0.0;
  double time = 0.0;
};

Ending ending(const Problem& problem, double entry, const FallOnto& track) {
  const double beta = std::atan(problem.body.friction.coefficient());
  const double g = problem.gravity;
  const double level = problem.body.entry_speed * std::cos(entry);
  const double fall = (std::tan(track.joint) - std::tan(entry)) * level / g;
  Ending end{level * fall, problem.body.entry_speed * std::sin(entry) * fall + 0.5 * g * fall * fall, fall};
  const auto d = [&](double zeta) {
    return std::cos(track.exit - beta) - std::sin(beta) * std::sin(2.0 * zeta - track.exit);
  };
  const double speed = level / std::cos(track.joint);
  const double scale = speed * d(track.joint) / std::cos(track.joint);
  // Simpson's rule, to 1e-13 of the time.
  constexpr int kSteps = 4000;
  const double step = (track.exit - track.joint) / kSteps;
  for (int i = 0; i <= kSteps; ++i) {
    const double zeta = track.joint + step * i;
    const double weight = step / 3.0 * (i == 0 || i == kSteps ? 1.0 : (i % 2 == 1 ? 4.0 : 2.0));
    const double v = scale * std::cos(zeta) / d(zeta);
    const double dt = -scale / g *
                      (std::cos(track.exit + beta) + std::sin(beta) * std::sin(2.0 * zeta - track.exit)) /
                      (d(zeta) * d(zeta));
    end.time += weight * dt;
    end.x += weight * dt * v * std::cos(zeta);
    end.y += weight * dt * v * std::sin(zeta);
  }
  return end;
}

/// The least time from there to the finish, by Newton's method on both angles.
double least_time(const Problem& problem, double entry, FallOnto& track) {
  const auto missed = [&](const FallOnto& at) {
    const Ending end = ending(problem, entry, at);
    return std::array{end.x - problem.endpoints.run, end.y - problem.endpoints.drop};
  };
  for (int step = 0; step < 30; ++step) {
    constexpr double kAside = 1e-6;
    const auto here = missed(track);
    const auto by_joint = missed({track.joint + kAside, track.exit});
    const auto by_exit = missed({track.joint, track.exit + kAside});
    const double a = (by_joint[0] - here[0]) / kAside, b = (by_exit[0] - here[0]) / kAside;
    const double c = (by_joint[1] - here[1]) / kAside, d = (by_exit[1] - here[1]) / kAside;
    const double det = a * d - b * c;
    track.joint -= (d * here[0] - b * here[1]) / det;
    track.exit -= (a * here[1] - c * here[0]) / det;
  }
  const auto left = missed(track);
  REQUIRE(std::hypot(left[0], left[1]) < 1e-9 * problem.endpoints.run);
  return ending(problem, entry, track).time;
}

}  // namespace

// What is flown over is short beside the track, and its bend is that of the body's own speed.
TEST_CASE(
    "a push start at a given slope falls as far as it is best to, and the slope's price is that of a closed "
    "form") {
  struct Start {
    double run, drop, friction, speed, degrees;
    FallOnto near;
  };
  for (const Start& start : {Start{100.0, 15.0, 0.05, 1.0, 0.0, {1.3475, -0.9802}},
                             Start{100.0, 15.0, 0.05, 1.0, 20.0, {1.3543, -0.9806}},
                             Start{402.0, 82.0, 0.04, 2.0, 0.0, {1.3617, -0.7902}},
                             Start{402.0, 82.0, 0.04, 2.0, 20.0, {1.3682, -0.7906}},
                             Start{10.0, 5.0, 0.2, 2.0, 20.0, {1.0675, -0.2588}}}) {
    Problem problem;
    problem.endpoints = {start.run, start.drop};
    problem.body.friction = Friction::from_coefficient(start.friction);
    problem.body.entry_speed = start.speed;
    const double entry = start.degrees * std::numbers::pi / 180.0;
    problem.limits.entry_slope_angle = Range::fixed(entry);
    const OptimizeReport report = optimize(problem).report;
    CAPTURE(start.run, start.degrees, report.brief());
    REQUIRE(report.status == OptimizeStatus::optimal);
    FallOnto track = start.near;
    const double exact = least_time(problem, entry, track);
    CHECK(report.travel_time / exact - 1.0 < 2e-6);
    CHECK(report.travel_time / exact - 1.0 > -1e-9);
    constexpr double kStep = 1e-3;
    const double flatter = least_time(problem, entry - kStep, track);
    const double steeper = least_time(problem, entry + kStep, track);
    const auto is_entry = [](const ActiveLimit& active) {
      return active.limit.id == LimitId::entry_slope_angle;
    };
    const auto active = std::find_if(report.active.begin(), report.active.end(), is_entry);
    REQUIRE(active != report.active.end());
    CHECK(active->price == Approx((flatter - steeper) / (2.0 * kStep)).epsilon(0.02));
  }
}

// Within a piece the one may end and the other begin.
TEST_CASE(
    "a track that flies first and presses later follows each load where it binds: the looser, the faster") {
  struct Before {
    double load = 0.0;
    double time = 0.0;
    double price = 0.0;
  };
  Before before;
  for (const double load : {14.02, 14.04, 14.06, 14.22, 14.24, 14.34, 14.36}) {
    if (load > 14.3 && !testing::thorough()) continue;
    Problem problem;
    problem.endpoints = {18.0, 23.0};
    problem.body.friction = Friction::from_coefficient(0.41);
    problem.body.entry_speed = 0.5;
    problem.gravity = 9.81;
    problem.limits.entry_slope_angle = Range::fixed(46.0 * std::numbers::pi / 180.0);
    problem.limits.exit_slope_angle = Range::fixed(26.0 * std::numbers::pi / 180.0);
    problem.limits.highest_normal_load = load;
    const OptimizeReport report = optimize(problem).report;
    CAPTURE(load, report.brief());
    REQUIRE(report.status == OptimizeStatus::optimal);
    const auto is_load = [](const ActiveLimit& active) {
      return active.limit.id == LimitId::highest_normal_load;
    };
    const auto active = std::find_if(report.active.begin(), report.active.end(), is_load);
    REQUIRE(active != report.active.end());
    if (before.load > 0.0) {
      const double won = before.time - report.travel_time;
      CHECK(won > 0.0);
      CHECK(won == Approx(0.5 * (load - before.load) * (before.price + active->price)).epsilon(0.02));
    }
    before = {load, report.travel_time, active->price};
  }
}

}  // namespace held_arcs_test
