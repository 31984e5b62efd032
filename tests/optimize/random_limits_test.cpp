// Random mixtures of limits: every result is held against the referee, against its own neighbours, and
// against re-solves; where there is none, against an independent search.

#include "optimize/random_limits.hpp"

#include "glissade/centerline/clothoid_spline.hpp"

#include "optimize/independent_search.hpp"
#include "referee/judgement.hpp"
#include "support/catch.hpp"
#include "support/thorough.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>

namespace random_limits_test {

using namespace glissade;
using testing_problems::random_limited;

namespace {

// A limit may be missed by this much of its scale, at points ten times denser than the search's.
constexpr double kKept = 1e-6;
constexpr int kReferee = 70;
// What margins may cost, as a share of the objective, at most and in all but one of a hundred problems
// (docs/optimization.md).
constexpr double kKeptBack = 1e-3;
constexpr double kRarelyKeptBack = 1e-4;

/// Newton's method on the finish: shifts a spline's two middle curvatures and its length so that it ends
/// where it must. Nothing of the search takes part.
std::optional<std::shared_ptr<ClothoidSpline>> through_finish(double entry,
                                                              std::vector<ClothoidSegment> segments,
                                                              double run, std::optional<double> drop) {
  const auto build = [&](double bend, double stretch) {
    std::vector<ClothoidSegment> moved = segments;
    const std::size_t middle = moved.size() / 2;
    moved[middle].exit_curvature += bend;
    moved[middle + 1].entry_curvature += bend;
    for (ClothoidSegment& segment : moved) {
      const bool straight = segment.entry_curvature == 0.0 && segment.exit_curvature == 0.0;
      if (!straight) segment.length *= std::max(0.1, 1.0 + stretch);  // Newton's first steps may go far
    }
    return std::make_shared<ClothoidSpline>(Angle::from_radians(entry), std::move(moved));
  };
  const double size = build(0.0, 0.0)->length();
  double bend = 0.0;
  double stretch = 0.0;
  for (int step = 0; step < 12; ++step) {
    const auto end = [&](double b, double s) {
      const auto track = build(b, s);
      const CenterlinePoint point = track->at(track->length());
      return Vec2{point.x - run, drop ? point.drop - *drop : 0.0};
    };
    const Vec2 miss = end(bend, stretch);
    if (std::hypot(miss.x, miss.y) < 1e-12 * size) return build(bend, stretch);
    const double h = 1e-6;
    const Vec2 by_stretch = (1.0 / h) * (end(bend, stretch + h) - miss);
    if (!drop) {
      stretch -= miss.x / by_stretch.x;
      continue;
    }
    const Vec2 by_bend = (size / h) * (end(bend + h / size, stretch) - miss);
    const double determinant = cross(by_bend, by_stretch);
    if (std::fabs(determinant) < 1e-12 * size * size) return std::nullopt;
    bend -= cross(miss, by_stretch) / determinant;
    stretch -= cross(by_bend, miss) / determinant;
  }
  return std::nullopt;
}

/// What a problem minimises, of a ride at the nominal friction.
double objective_of(const Problem& problem, const referee::Judgement& verdict) {
  if (problem.objective.kind == ObjectiveKind::exit_speed) return -verdict.exit_speed;
  return verdict.travel_time - problem.objective.exit_speed_weight * verdict.exit_speed;
}

/// Whether a track would have to be slower or longer than those that were found: more and other bends might do, of which
/// no search tries all (docs/optimization.md).
bool asks_for_bends(const OptimizeReport& report) {
  const std::vector<StatedLimit>& limits = report.conflict.limits;
  return std::any_of(limits.begin(), limits.end(), [](const StatedLimit& stated) {
    const LimitName& name = stated.limit;
    const bool speed = name.id == LimitId::speed || name.id == LimitId::exit_speed;
    return (speed && name.bound != Bound::lowest) ||
           (name.id == LimitId::arc_length && name.bound != Bound::highest);
  });
}

/// What the distance costs at which the search keeps from limits that would else be broken between its
/// stations, above all from losing contact: the price of each limit times how far the referee finds the track
/// from it, in the unit of the objective.
double kept_back(const OptimizeReport& report) {
  double cost = 0.0;
  for (const ActiveLimit& active : report.active) {
    // A track that all but stalls has prices that are told to tens of a hundred: as much as is certain counts.
    const double price = active.price * std::max(0.0, 1.0 - active.price_error);
    for (const LimitCheck& check : report.checks) {
      if (check.limit == active.limit) cost += price * std::fabs(check.reached - check.value);
    }
  }
  return cost;
}

/// Whether the referee finds the track at every bound that is told to be active, to a thousandth of its scale.
bool lies_at_its_limits(const OptimizeReport& report) {
  return std::all_of(report.active.begin(), report.active.end(), [&](const ActiveLimit& active) {
    return std::all_of(report.checks.begin(), report.checks.end(), [&](const LimitCheck& check) {
      return check.limit != active.limit || std::fabs(check.reached - check.value) <= 1e-3 * check.scale;
    });
  });
}

/// What became of a number of random problems.
struct Tally {
  int solved = 0;
  int converged = 0;
  int admissible = 0;
  int undecided = 0;
  int kept_far_back = 0;
  int infeasible = 0;  ///< of those that were held against the independent search
};

/// Holds one answer against the referee and against so many neighbours. @return what was found
OptimizeReport hold(const Problem& problem, int neighbours, testing::Random& random, Tally& tally) {
  const Optimum optimum = optimize(problem);
  CAPTURE(optimum.report.brief());
  const bool none = optimum.report.status == OptimizeStatus::no_track_found;
  tally.undecided += none && !asks_for_bends(optimum.report) ? 1 : 0;
  if (!optimum.centerline) return optimum.report;
  ++tally.solved;
  const referee::Judgement verdict = referee::judge_track(problem, optimum.centerline, kReferee);
  CHECK(verdict.arrived);
  CHECK(verdict.worst <= kKept);
  CHECK(verdict.travel_time == optimum.report.travel_time);
  if (optimum.report.status != OptimizeStatus::optimal) return optimum.report;
  ++tally.converged;
  CHECK(lies_at_its_limits(optimum.report));
  const double least = objective_of(problem, verdict);
  const double kept = kept_back(optimum.report);
  CHECK(kept <= kKeptBack * std::fabs(least));
  tally.kept_far_back += kept > kRarelyKeptBack * std::fabs(least) ? 1 : 0;
  // The report tells the nominal friction, at which neighbours are compared.
  if (problem.objective.worst_case) return optimum.report;
  // Where contact alone holds it back, the answer is the exact optimum, which has its own tests.
  const auto* found = dynamic_cast<const ClothoidSpline*>(optimum.centerline.get());
  if (found == nullptr) return optimum.report;
  const ClothoidSpline& spline = *found;
  const double run = spline.at(spline.length()).x;
  const auto drop =
      problem.finish.kind == FinishKind::vertical_line ? std::nullopt : std::optional(problem.endpoints.drop);
  for (int k = 0; k < neighbours; ++k) {
    // Smooth random bends of 1e-6 to 1e-2 rad; straights that the problem asks for stay straight.
    const double amplitude = std::pow(10.0, random.between(-6.0, -2.0)) / spline.length();
    const double wave = random.between(0.5, 4.0);
    const double phase = random.between(0.0, 6.3);
    std::vector<ClothoidSegment> segments = spline.segments();
    double s = 0.0;
    for (std::size_t j = 0; j < segments.size(); ++j) {
      ClothoidSegment& segment = segments[j];
      const bool lead = (j == 0 && problem.limits.lead_in > 0.0) ||
                        (j + 1 == segments.size() && problem.limits.lead_out > 0.0);
      const auto bend = [&](double at) {
        return amplitude * std::sin(6.283 * wave * at / spline.length() + phase);
      };
      if (!lead) {
        const bool after_lead = j == 1 && problem.limits.lead_in > 0.0;
        const bool before_lead = j + 2 == segments.size() && problem.limits.lead_out > 0.0;
        if (!after_lead) segment.entry_curvature += bend(s);
        if (!before_lead) segment.exit_curvature += bend(s + segment.length);
      }
      s += segment.length;
    }
    const double entry =
        spline.entry_slope_angle().radians() + random.between(-1.0, 1.0) * amplitude * spline.length();
    const auto neighbour = through_finish(entry, segments, run, drop);
    if (!neighbour) continue;
    const referee::Judgement other = referee::judge_track(problem, *neighbour, 8);
    if (!other.arrived || other.worst > 1e-7) continue;
    ++tally.admissible;
    if (objective_of(problem, other) >= least - 1e-6 * std::fabs(least) - kept) continue;
    // Faster at eight points a piece: look as closely as at the optimum itself.
    const referee::Judgement close = referee::judge_track(problem, *neighbour, kReferee);
    CAPTURE(k, amplitude * spline.length());
    // A neighbour that breaks a limit by 1e-7 may win that much times the limit's price.
    CHECK((!close.arrived || close.worst > 1e-7));
  }
  return optimum.report;
}

}  // namespace

namespace {

/// @param searched  of so many the independent search looks for a track where none is told
void hold_random_limited(testing::Random random, int problems, int searched) {
  INFO("GLISSADE_SEED=" << random.seed());
  // Numbers of their own: the problems are the same without that search, and whatever is found for those before.
  testing::Random steps(random.seed());
  testing::Random bends(random.seed() + 1);
  constexpr int kNeighbours = 16;
  Tally tally;
  for (int i = 0; i < problems; ++i) {
    const Problem problem = random_limited(random);
    CAPTURE(i);
    const OptimizeReport report = hold(problem, kNeighbours, bends, tally);
    const bool none =
        report.status == OptimizeStatus::infeasible || report.status == OptimizeStatus::no_track_found;
    if (i < searched && none) tally.infeasible += testing_problems::hold_none(problem, report, steps) ? 1 : 0;
  }
  CAPTURE(tally.solved, tally.converged, tally.admissible, tally.undecided, tally.infeasible);
  CHECK(tally.infeasible > 0);
  // Neither a track nor a contradiction: an answer that has to stay rare.
  CHECK(tally.undecided <= problems / 100);
  CHECK(tally.kept_far_back <= std::max(1, problems / 100));
  CHECK(tally.converged >= problems * 7 / 10);
  CHECK(tally.converged >= tally.solved - tally.solved / 100);
  CHECK(tally.admissible > problems / 2);
}

}  // namespace

TEST_CASE(
    "random limited problems: every limit is kept, no admissible neighbour is faster, and an independent "
    "search finds no "
    "track where limits are said to contradict each other, and what they would take does") {
  // A quarter of those of other tests, elsewhere than in CI.
  const int share = testing::thorough() ? 1 : 4;
  hold_random_limited(testing_problems::seeded_for_limited(),
                      std::max(1, testing_problems::problem_count() / share),
                      std::max(1, testing_problems::problems_of(20) * 2 / (share + 1)));
  // Continuous integration draws others: those that a short run has it holds, too.
  constexpr int kShort = 40;
  constexpr int kShortSearched = 20;
  if (testing::thorough() && std::getenv("GLISSADE_SEED") == nullptr)
    hold_random_limited(testing::Random(testing_problems::kShortSeed), kShort, kShortSearched);
}

/// The same problem on ground that changes up to three times, some of them beyond the finish.
Problem with_changing_friction(Problem problem, testing::Random& random) {
  const double chord = std::hypot(problem.endpoints.run, problem.endpoints.drop);
  const double mu = problem.body.friction.coefficient();
  const int count = 1 + static_cast<int>(random.between(0.0, 3.0));
  double place = 0.0;
  for (int i = 0; i < count; ++i) {
    place += random.between(0.02, 0.5) * chord;
    problem.body.friction_changes.push_back(
        {place, Friction::from_coefficient(random.between(0.0, 1.3 * mu))});
  }
  return problem;
}

TEST_CASE("random limited problems where friction changes: no admissible neighbour is faster") {
  // The first of those that continuous integration draws winds at a cap on the speed, for some twenty seconds.
  testing::Random random = testing::thorough() ? testing::seeded_random() : testing::seeded_random(4);
  INFO("GLISSADE_SEED=" << random.seed());
  // Most of them lift off where the track found flies over rougher ground.
  constexpr int kNeighbours = 80;
  Tally tally;
  const int problems = std::max(1, testing_problems::problem_count() / (testing::thorough() ? 7 : 6));
  for (int i = 0; i < problems; ++i) {
    const Problem problem = with_changing_friction(random_limited(random), random);
    CAPTURE(i);
    hold(problem, kNeighbours, random, tally);
  }
  CAPTURE(tally.solved, tally.converged, tally.admissible, tally.undecided);
  CHECK(tally.undecided <= std::max(1, problems / 20));
  CHECK(tally.converged >= problems * 6 / 10);
  CHECK(tally.converged >= tally.solved - std::max(1, tally.solved / 20));
  CHECK(tally.admissible > problems / 4);
}

TEST_CASE("random limited problems: three times as many pieces win nothing that matters") {
  const int count = testing::thorough() ? 40 : 7;
  const auto of = [](const Problem& problem, const OptimizeReport& report) {
    if (problem.objective.kind == ObjectiveKind::exit_speed) return -report.exit_speed;
    const double weight =
        problem.objective.kind == ObjectiveKind::blend ? problem.objective.exit_speed_weight : 0.0;
    return report.travel_time - weight * report.exit_speed;
  };
  // The first of these blends time and exit speed above a lowest slope: it ends on a crest of a few hundredths of its
  // length, where the track carries less.
  testing::Random random(1);
  int compared = 0;
  int missed = 0;
  for (int i = 0; i < count; ++i) {
    const Problem problem = random_limited(random);
    // The third takes longer than all others together: CI solves it.
    if (i == 2 && !testing::thorough()) continue;
    const Optimum usual = optimize(problem);
    if (usual.report.status != OptimizeStatus::optimal) continue;
    OptimizeOptions many;
    many.pieces = 96;
    const Optimum fine = optimize(problem, many);
    if (fine.report.status != OptimizeStatus::optimal) continue;
    ++compared;
    const double known = of(problem, fine.report);
    const double slower = (of(problem, usual.report) - known) / std::fabs(known);
    CAPTURE(i, slower);
    if (i == 0) CHECK(slower < 1e-6);
    missed += slower > 1e-5 ? 1 : 0;
  }
  CHECK(compared >= count / 2);
  CHECK(20 * missed <= compared);
}

TEST_CASE("prices are what a re-solve with the limit relaxed wins") {
  Problem problem;
  problem.endpoints = {10.0, 5.0};
  problem.body.friction = Friction::from_coefficient(0.2);
  const auto price_matches = [&](const char* key, auto relax, double step) {
    const Optimum now = optimize(problem);
    Problem tight = problem;
    Problem loose = problem;
    relax(tight.limits, -step);
    relax(loose.limits, step);
    const double won =
        (optimize(tight).report.travel_time - optimize(loose).report.travel_time) / (2.0 * step);
    for (const ActiveLimit& active : now.report.active) {
      if (active.limit.key() != key) continue;
      CAPTURE(key, active.price, won);
      // Central difference over two meshes that adapt on their own.
      CHECK(active.price == Approx(won).epsilon(0.03));
      return;
    }
    FAIL(key << " is not active");
  };
  problem.limits.slope_angle.highest = 0.7;
  price_matches(
      "slope_angle.highest", [](Limits& l, double d) { *l.slope_angle.highest += d; }, 0.01);
  problem.limits = {};
  problem.limits.smallest_valley_radius = 8.0;
  price_matches(
      "smallest_valley_radius", [](Limits& l, double d) { *l.smallest_valley_radius -= d; }, 0.2);
  problem.limits = {};
  problem.limits.highest_normal_load = 14.0;
  price_matches(
      "highest_normal_load", [](Limits& l, double d) { *l.highest_normal_load += d; }, 0.3);
  problem.limits = {};
  problem.limits.speed.highest = 7.0;
  price_matches(
      "speed.highest", [](Limits& l, double d) { *l.speed.highest += d; }, 0.02);
  problem.limits = {};
  problem.limits.half_planes.push_back({{0.0, 1.0}, {-0.5, 1.0}, 0.1});
  price_matches(
      "half_planes[0]", [](Limits& l, double d) { l.half_planes[0].clearance -= d; }, 0.02);
  problem.limits = {};
  problem.limits.arc_length.highest = 11.4;
  price_matches(
      "arc_length.highest", [](Limits& l, double d) { *l.arc_length.highest += d; }, 0.01);
}

TEST_CASE(
    "each limit has one price, and it is what a re-solve wins, where curvature is bounded in many ways") {
  constexpr double kDegree = std::numbers::pi / 180.0;
  const auto check = [](const Problem& problem, const std::string& key, auto relax, double step,
                        double accuracy = 0.02) {
    const Optimum now = optimize(problem);
    CAPTURE(key, now.report.brief());
    const auto has_key = [&](const ActiveLimit& active) { return active.limit.key() == key; };
    REQUIRE(std::count_if(now.report.active.begin(), now.report.active.end(), has_key) == 1);
    Problem tight = problem;
    Problem loose = problem;
    relax(tight.limits, -step);
    relax(loose.limits, step);
    const double won =
        (optimize(tight).report.travel_time - optimize(loose).report.travel_time) / (2.0 * step);
    const auto active = std::find_if(now.report.active.begin(), now.report.active.end(), has_key);
    CHECK(active->price == Approx(won).epsilon(accuracy));
  };
  Problem problem;
  problem.endpoints = {10.0, 5.0};
  problem.body.friction = Friction::from_coefficient(0.2);
  problem.limits.highest_curvature_rate = 0.08;
  problem.limits.smallest_valley_radius = 4.0;
  problem.limits.smallest_crest_radius = 4.0;
  check(
      problem, "highest_curvature_rate", [](Limits& l, double d) { *l.highest_curvature_rate += d; }, 2e-3,
      // Where the rate switches its side the knots are only near.
      0.1);
  check(
      problem, "smallest_valley_radius", [](Limits& l, double d) { *l.smallest_valley_radius -= d; }, 0.05);
  // A short crest before the exit.
  problem = Problem{};
  problem.endpoints = {8.0, 6.0};
  problem.body.friction = Friction::from_coefficient(0.25);
  problem.limits.slope_angle = {25.0 * kDegree, 70.0 * kDegree};
  problem.limits.exit_slope_angle = Range::fixed(30.0 * kDegree);
  problem.limits.smallest_valley_radius = 0.7;
  problem.limits.smallest_crest_radius = 0.7;
  check(
      problem, "slope_angle.lowest", [](Limits& l, double d) { *l.slope_angle.lowest -= d; }, 0.005);
  check(
      problem, "exit_slope_angle",
      [](Limits& l, double d) { l.exit_slope_angle = Range::fixed(*l.exit_slope_angle.lowest - d); }, 0.005);
}

TEST_CASE("what the report of a contradiction calls enough is enough, and a little less is not") {
  Problem problem;
  problem.endpoints = {83.48, 45.79};
  problem.body.friction = Friction::from_coefficient(0.03);
  constexpr double kDegree = std::numbers::pi / 180.0;
  problem.limits.slope_angle.highest = 30.0 * kDegree;
  problem.limits.exit_slope_angle = Range::fixed(11.0 * kDegree);
  problem.limits.smallest_valley_radius = 90.0;
  const Optimum optimum = optimize(problem);
  INFO(optimum.report.message);
  REQUIRE(optimum.report.status == OptimizeStatus::infeasible);
  const auto with = [&](const Relaxation& relaxation, double share) {
    Problem changed = problem;
    const double value = relaxation.value + share * (relaxation.needed - relaxation.value);
    if (relaxation.limit.key() == "slope_angle.highest") changed.limits.slope_angle.highest = value;
    if (relaxation.limit.key() == "smallest_valley_radius") changed.limits.smallest_valley_radius = value;
    if (relaxation.limit.key() == "exit_slope_angle") changed.limits.exit_slope_angle = Range::fixed(value);
    return optimize(changed).report.status;
  };
  REQUIRE(optimum.report.conflict.relaxations.size() == 3);
  for (const Relaxation& relaxation : optimum.report.conflict.relaxations) {
    CAPTURE(relaxation.limit.key(), relaxation.needed);
    CHECK(with(relaxation, 1.02) != OptimizeStatus::infeasible);
    CHECK(with(relaxation, 0.9) == OptimizeStatus::infeasible);
  }
}

TEST_CASE("a stop or an empty budget ends early and says so") {
  Problem problem;
  problem.endpoints = {10.0, 5.0};
  problem.body.friction = Friction::from_coefficient(0.2);
  problem.limits.highest_normal_load = 14.0;
  std::stop_source source;
  source.request_stop();
  const Optimum stopped = optimize(problem, {}, source.get_token());
  CHECK(stopped.report.status != OptimizeStatus::optimal);
  CHECK(stopped.report.status != OptimizeStatus::infeasible);
  OptimizeOptions hurried;
  hurried.time_budget = 1e-9;
  const Optimum early = optimize(problem, hurried);
  CHECK(early.report.status != OptimizeStatus::optimal);
  if (early.centerline) CHECK(referee::judge_track(problem, early.centerline, kReferee).worst <= kKept);
}

TEST_CASE(
    "a search that is asked to end halfway gives a track that keeps every limit, and is not called optimal") {
  Problem problem;
  problem.endpoints = {10.0, 5.0};
  problem.body.friction = Friction::from_coefficient(0.2);
  problem.limits.highest_normal_load = 14.0;
  problem.limits.slope_angle.highest = 0.8;
  problem.limits.smallest_valley_radius = 5.0;
  const Optimum whole = optimize(problem);
  REQUIRE(whole.report.status == OptimizeStatus::optimal);
  // Each step of a search, those in which the track stands already among them.
  for (const std::string_view step : {"finer track", "referee", "prices"}) {
    INFO(step);
    std::stop_source source;
    const Progress ask = [&](std::string_view stage, std::optional<double>) {
      if (stage == step) source.request_stop();
    };
    const Optimum early = optimize(problem, {}, source.get_token(), ask);
    INFO(early.report.brief());
    CHECK(source.stop_requested());
    CHECK(early.report.ended_early);
    CHECK(early.report.status == OptimizeStatus::feasible_not_converged);
    CHECK(early.report.message == "stopped: the best track so far");
    REQUIRE(early.centerline);
    CHECK(referee::judge_track(problem, early.centerline, kReferee).worst <= kKept);
    CHECK(early.report.travel_time >= whole.report.travel_time * (1.0 - 1e-6));
    CHECK(early.report.evaluations < whole.report.evaluations);
  }
}

}  // namespace random_limits_test
