// What the search calls infeasible is held against a search of another kind: penalised violations of splines
// of few pieces, minimised without derivatives from many random beginnings. It finds a track where there
// plainly is one, and must not find any where the report says that limits contradict each other.

#include "glissade/centerline/clothoid_spline.hpp"

#include "clearance/random_case.hpp"
#include "optimize/changed_bound.hpp"
#include "optimize/random_limits.hpp"
#include "referee/judgement.hpp"
#include "support/catch.hpp"
#include "support/thorough.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <vector>

using namespace glissade;
using optimizer::with_bound;
using testing_problems::random_limited;

namespace {

constexpr int kPieces = 6;

std::shared_ptr<ClothoidSpline> track_of(const Problem& problem, const std::vector<double>& z) {
  const double chord = std::hypot(problem.endpoints.run, problem.endpoints.drop);
  const double core = std::exp(z[1]) * chord - problem.limits.lead_in - problem.limits.lead_out;
  if (!(core > 0.05 * chord)) return nullptr;
  const bool starts_straight = problem.limits.lead_in > 0.0;
  const bool ends_straight = problem.limits.lead_out > 0.0;
  std::vector<ClothoidSegment> segments;
  if (starts_straight) segments.push_back({problem.limits.lead_in, 0.0, 0.0});
  const auto curvature = [&](int knot) {
    if ((knot == 0 && starts_straight) || (knot == kPieces && ends_straight)) return 0.0;
    return z[static_cast<std::size_t>(2 + knot)] / chord;
  };
  for (int i = 0; i < kPieces; ++i) segments.push_back({core / kPieces, curvature(i), curvature(i + 1)});
  if (ends_straight) segments.push_back({problem.limits.lead_out, 0.0, 0.0});
  return std::make_shared<ClothoidSpline>(Angle::from_radians(z[0]), std::move(segments));
}

double violation(const Problem& problem, const std::vector<double>& z) {
  constexpr double kNoTrack = 10.0;
  if (std::fabs(z[0]) > 1.5) return kNoTrack;
  // Coils, and tracks of more than e^4 chords, are none; a spline refuses to be wound up without end.
  constexpr double kCoil = 1e3;
  constexpr double kLongest = 4.0;
  if (std::any_of(z.begin(), z.end(), [](double value) { return !(std::fabs(value) < kCoil); }))
    return kNoTrack;
  if (z[1] > kLongest) return kNoTrack;
  const auto track = track_of(problem, z);
  if (!track) return kNoTrack;
  for (const double s : track->breaks()) {
    if (std::fabs(track->slope_angle(s)) > 1.57) return kNoTrack;
  }
  const referee::Judgement verdict = referee::judge_track(problem, track, 6);
  return verdict.worst + (verdict.arrived ? 0.0 : 1.0);
}

/// A (1+1) evolution: random steps, kept where they pay, of a size that follows its success.
double least_found(const Problem& problem, testing::Random& random) {
  double least = 10.0;
  for (int beginning = 0; beginning < 3; ++beginning) {
    std::vector<double> z(static_cast<std::size_t>(3 + kPieces), 0.0);
    const double mean = std::atan2(problem.endpoints.drop, problem.endpoints.run);
    z[0] = mean + random.between(-0.2, 0.5);
    z[1] = random.between(0.0, 0.1);
    for (std::size_t i = 2; i < z.size(); ++i) z[i] = random.between(-0.2, 1.0);
    double now = violation(problem, z);
    double size = 0.3;
    for (int step = 0; step < 400; ++step) {
      std::vector<double> next = z;
      for (double& value : next) value += size * random.between(-1.0, 1.0) * random.between(0.0, 1.0);
      const double there = violation(problem, next);
      if (there <= now) {
        now = there;
        z = std::move(next);
        size *= 1.5;
      } else {
        size *= 0.92;
      }
      if (size < 1e-6) size = 0.05;
    }
    least = std::min(least, now);
  }
  return least;
}

/// How many of a test's problems are searched; more of it takes minutes: continuous integration does that.
int problems_of(int quick) {
  const int most = std::max(1, 2 * testing_problems::problem_count() / 3);
  return testing::thorough() ? most : std::min(most, quick);
}

/// What would do is enough: each bound, put in alone, has a track.
void check_needed(const Problem& problem, const OptimizeReport& report) {
  for (const Relaxation& relaxation : report.conflict.relaxations) {
    CAPTURE(relaxation.limit.key(), relaxation.value, relaxation.needed);
    const bool moves = entry_of(relaxation.limit.id).form == LimitForm::list && relaxation.needed < 0.0;
    if (moves || relaxation.limit.id == LimitId::match_belt) continue;
    const auto changed = with_bound(problem, relaxation.limit, relaxation.needed);
    REQUIRE(changed);
    CHECK(optimize(*changed).centerline);
  }
}

}  // namespace

TEST_CASE(
    "an independent search finds no track where limits are said to contradict each other, and what they "
    "would take "
    "does") {
  testing::Random random = testing_problems::seeded_for_limited();
  INFO("GLISSADE_SEED=" << random.seed());
  // Its own numbers: the problems are those of the other test of random limits.
  testing::Random steps(random.seed());
  int infeasible = 0;
  for (int i = problems_of(20); i > 0; --i) {
    const Problem problem = random_limited(random);
    const Optimum optimum = optimize(problem);
    if (optimum.centerline) continue;
    CAPTURE(i, optimum.report.message);
    check_needed(problem, optimum.report);
    if (optimum.report.status != OptimizeStatus::infeasible) continue;
    ++infeasible;
    CHECK(least_found(problem, steps) > 1e-5);
  }
  CAPTURE(infeasible);
  CHECK(infeasible > 0);
}

TEST_CASE("an independent search finds no room for a whole solid where clearances are said to leave none") {
  testing::Random random = testing::seeded_random(20250303);
  INFO("GLISSADE_SEED=" << random.seed());
  testing::Random steps(random.seed());
  int infeasible = 0;
  for (int i = problems_of(6); i > 0; --i) {
    const RandomCase made = random_case(random);
    const Optimum optimum = optimize(made.problem);
    if (optimum.centerline) continue;
    CAPTURE(i, made.words, optimum.report.message);
    check_needed(made.problem, optimum.report);
    if (optimum.report.status != OptimizeStatus::infeasible) continue;
    ++infeasible;
    CHECK(least_found(made.problem, steps) > 1e-5);
  }
  CAPTURE(infeasible);
  CHECK(infeasible > 0);
}

TEST_CASE(
    "drawn problems whose limits leave little room are solved, and in a valley that is known to be good") {
  // Where bends wear the energy down, the way there is found by how the limits bend: steps that are too short for it
  // ended without a track, or in a valley some percents slower.
  struct Drawn {
    std::uint64_t seed;
    int index;
    double objective;  // at most: time, or exit speed with the other sign
  };
  constexpr Drawn kDrawn[] = {{1, 88, 5.50}, {3, 30, -80.6}};
  for (const Drawn& drawn : kDrawn) {
    testing::Random random(drawn.seed);
    Problem problem = random_limited(random);
    for (int i = 0; i < drawn.index; ++i) problem = random_limited(random);
    const Optimum optimum = optimize(problem);
    CAPTURE(drawn.seed, drawn.index, optimum.report.message);
    REQUIRE(optimum.centerline);
    const OptimizeReport& report = optimum.report;
    const bool speed = problem.objective.kind == ObjectiveKind::exit_speed;
    const double objective = speed ? -report.exit_speed : report.travel_time;
    CHECK(objective <= drawn.objective);
  }
}

TEST_CASE("the independent search does find tracks where there are some") {
  testing::Random random(7);
  Problem problem;
  problem.endpoints = {10.0, 5.0};
  problem.body.friction = Friction::from_coefficient(0.2);
  problem.limits.slope_angle.highest = 0.8;
  problem.limits.smallest_valley_radius = 3.0;
  CHECK(least_found(problem, random) < 0.05);
}

TEST_CASE(
    "a cap on the speed takes the same bound whatever it is, and is called infeasible only where that is "
    "proven") {
  constexpr double kDegree = std::numbers::pi / 180.0;
  Problem problem;
  problem.endpoints = {8.0, 5.0};
  problem.body.friction = Friction::from_coefficient(0.25);
  problem.limits.slope_angle = {9.0 * kDegree, 60.0 * kDegree};
  problem.limits.smallest_valley_radius = 1.0;
  problem.limits.smallest_crest_radius = 1.0;
  const auto needed_speed = [&](double cap, OptimizeStatus status) {
    problem.limits.speed.highest = cap;
    const OptimizeReport report = optimize(problem).report;
    CAPTURE(cap, report.message);
    CHECK(report.status == status);
    for (const Relaxation& relaxation : report.conflict.relaxations) {
      if (relaxation.limit.id == LimitId::speed) return relaxation.needed;
    }
    FAIL("no speed would do: " << report.message);
    return 0.0;
  };
  const double needed = needed_speed(6.4, OptimizeStatus::no_track_found);
  CHECK(needed_speed(6.0, OptimizeStatus::no_track_found) == Approx(needed).epsilon(5e-4));
  // The energy equation alone leaves 5.85 m/s.
  CHECK(needed_speed(5.8, OptimizeStatus::infeasible) == Approx(needed).epsilon(5e-4));
  problem.limits.speed.highest = needed;
  CHECK(optimize(problem).centerline);
}

TEST_CASE("slope angles that leave out the mean slope are told by it, by however little they do") {
  testing::Random random = testing::seeded_random();
  for (int i = 0; i < 8; ++i) {
    Problem problem;
    problem.endpoints = {random.between(2.0, 40.0), 0.0};
    problem.endpoints.drop = problem.endpoints.run * random.between(0.3, 1.2);
    problem.body.friction = Friction::from_coefficient(random.between(0.0, 0.2));
    const double mean = std::atan2(problem.endpoints.drop, problem.endpoints.run);
    const double miss = std::pow(10.0, random.between(-6.5, -1.5));
    const bool flat = i % 2 == 0;
    Range& slope = problem.limits.slope_angle;
    (flat ? slope.highest : slope.lowest) = flat ? mean - miss : mean + miss;
    INFO("problem " << i << ", mean slope " << mean << ", missed by " << miss);
    const Optimum optimum = optimize(problem);
    CHECK(optimum.report.status == OptimizeStatus::infeasible);
    CHECK(optimum.centerline == nullptr);
    CHECK(optimum.report.message.find(flat ? "slope_angle.highest" : "slope_angle.lowest") == 0);
    CHECK(optimum.report.message.find(" cannot be met; it would take slope_angle.") != std::string::npos);
    CHECK(optimum.report.conflict.why.find("mean value theorem") != std::string::npos);
    REQUIRE(optimum.report.conflict.relaxations.size() == 1);
    const Relaxation& told = optimum.report.conflict.relaxations.front();
    CHECK(std::fabs(told.needed - mean) < 0.02);
    (flat ? slope.highest : slope.lowest) = told.needed;
    CHECK(optimize(problem).report.status == OptimizeStatus::optimal);
    // The straight line has the mean slope alone.
    (flat ? slope.highest : slope.lowest) = mean;
    CHECK(optimize(problem).centerline != nullptr);
  }
}

TEST_CASE(
    "a slope angle that misses the mean slope by a hair leaves the straight line, and the search says so") {
  testing::Random random = testing::seeded_random();
  for (int i = 0; i < 8; ++i) {
    Problem problem;
    problem.endpoints = {random.between(2.0, 40.0), 0.0};
    problem.endpoints.drop = problem.endpoints.run * random.between(0.3, 2.0);
    problem.body.friction = Friction::from_coefficient(random.between(0.0, 0.2));
    const double mean = std::atan2(problem.endpoints.drop, problem.endpoints.run);
    const double miss = std::pow(10.0, random.between(-11.0, -7.5));
    const bool flat = i % 2 == 0;
    Range& slope = problem.limits.slope_angle;
    (flat ? slope.highest : slope.lowest) = flat ? mean - miss : mean + miss;
    INFO("problem " << i << ", mean slope " << mean << ", missed by " << miss);
    const Optimum optimum = optimize(problem);
    CHECK(optimum.report.status == OptimizeStatus::optimal);
    REQUIRE(optimum.centerline);
    for (const double share : {0.0, 0.3, 0.7}) {
      CHECK(optimum.centerline->slope_angle(share * optimum.centerline->length()) ==
            Approx(mean).margin(1e-3));
    }
  }
}
