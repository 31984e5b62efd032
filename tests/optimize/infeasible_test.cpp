// What is said of limits that no track keeps: by an independent search, by bounds put in, by closed forms. Random problems
// with limits of every kind are held against that search where they are solved, in random_limits_test.cpp.

#include "clearance/random_case.hpp"
#include "optimize/independent_search.hpp"
#include "optimize/random_limits.hpp"
#include "support/catch.hpp"
#include "support/thorough.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

using namespace glissade;
using testing_problems::hold_none;
using testing_problems::least_found;
using testing_problems::problems_of;
using testing_problems::random_limited;

TEST_CASE("an independent search finds no room for a whole solid where clearances are said to leave none") {
  testing::Random random = testing::seeded_random(20250303);
  INFO("GLISSADE_SEED=" << random.seed());
  testing::Random steps(random.seed());
  int infeasible = 0;
  // Solids take longest.
  for (int i = testing::thorough() ? 2 * problems_of(6) / 3 : problems_of(6); i > 0; --i) {
    const RandomCase made = random_case(random);
    const Optimum optimum = optimize(made.problem);
    if (optimum.centerline) continue;
    CAPTURE(i, made.words);
    infeasible += hold_none(made.problem, optimum.report, steps) ? 1 : 0;
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
  std::vector<Drawn> all{{3, 30, -80.6}};
  // This one takes half a minute.
  if (testing::thorough()) all.push_back({1, 88, 5.50});
  for (const Drawn& drawn : all) {
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

TEST_CASE(
    "a lowest speed beyond what the drop gives is a conflict by the energy equation, with what it takes") {
  Problem problem;
  problem.endpoints = {5.4, 5.1};
  problem.body.friction = Friction::from_angle(Angle::from_degrees(17.0));
  const auto proven = [&] {
    const Optimum optimum = optimize(problem);
    return optimum.report.status == OptimizeStatus::infeasible &&
           optimum.report.conflict.limits.size() == 1 &&
           optimum.report.conflict.why.find("the energy equation leaves at most 10 m/s") != std::string::npos;
  };
  problem.limits.exit_speed = {20.0, 20.0};
  CHECK(proven());
  problem.limits.exit_speed = {20.0, {}};
  CHECK(proven());
  problem.limits.exit_speed = {};
  problem.limits.speed.lowest = 20.0;
  problem.limits.lowest_speed_from = 1.0;
  CHECK(proven());
  // Where it may never begin to hold nothing is proven.
  problem.limits.lowest_speed_from = 30.0;
  CHECK(!proven());
  // A wind from behind may add what is missing.
  problem.limits.speed = {};
  problem.limits.exit_speed = {20.0, {}};
  problem.body.drag_per_metre = 0.05;
  problem.body.head_wind = -60.0;
  CHECK(!proven());
}

TEST_CASE("a straight end that has a part in a conflict is named, with a length that does") {
  struct Held {
    double radius, entry_slope, exit_slope;
    LimitId lead;
    double length;
  };
  const double degree = std::numbers::pi / 180.0;
  for (const Held& held : {Held{4.0, 0.0, 5.0 * degree, LimitId::lead_out, 2.0},
                           Held{6.0, 60.0 * degree, 0.0, LimitId::lead_in, 0.2}}) {
    Problem problem;
    problem.endpoints = {5.0, 3.0};
    problem.body.friction = Friction::from_angle(Angle::from_degrees(8.0));
    Limits& limits = problem.limits;
    limits.smallest_valley_radius = limits.smallest_crest_radius = held.radius;
    if (held.exit_slope > 0.0) limits.exit_slope_angle = Range::fixed(held.exit_slope);
    if (held.entry_slope > 0.0) limits.entry_slope_angle = Range::fixed(held.entry_slope);
    double& lead = held.lead == LimitId::lead_in ? limits.lead_in : limits.lead_out;
    lead = held.length;
    const OptimizeReport report = optimize(problem).report;
    CAPTURE(report.message);
    CHECK(report.status == OptimizeStatus::infeasible);
    const auto is_lead = [&](const auto& one) { return one.limit.id == held.lead; };
    const std::vector<StatedLimit>& stated = report.conflict.limits;
    const auto named = std::find_if(stated.begin(), stated.end(), is_lead);
    REQUIRE(named != stated.end());
    CHECK(named->value == held.length);
    lead = 0.0;
    CHECK(optimize(problem).centerline);
    const std::vector<Relaxation>& relaxations = report.conflict.relaxations;
    const auto does = std::find_if(relaxations.begin(), relaxations.end(), is_lead);
    if (held.lead == LimitId::lead_out) REQUIRE(does != relaxations.end());
    if (does == relaxations.end()) continue;
    CHECK(does->needed < held.length);
    lead = does->needed;
    CHECK(optimize(problem).centerline);
    lead = std::min(held.length, does->needed + 0.03 * held.length);
    CHECK_FALSE(optimize(problem).centerline);
  }
}

TEST_CASE("limits that a track just keeps are not said to contradict each other") {
  if (!testing::thorough()) return;  // each takes seconds
  Problem problem;
  problem.gravity = 9.81;
  problem.endpoints = {90.0, 47.104};
  problem.body.friction = Friction::from_coefficient(0.03);
  problem.body.drag_per_metre = 0.0013;
  problem.limits.slope_angle.highest = Angle::from_degrees(35.0).radians();
  problem.limits.exit_slope_angle = Range::fixed(Angle::from_degrees(11.0).radians());
  problem.limits.concave = true;
  problem.limits.smallest_valley_radius = 104.1;
  problem.limits.lead_in = 24.0;
  problem.limits.lead_out = 6.767;
  // The least that a track carries is 15.0331 m/s^2, by descents of the load alone.
  for (const double load : {15.035, 15.0335}) {
    problem.limits.highest_normal_load = load;
    const Optimum within = optimize(problem);
    CAPTURE(load, within.report.brief());
    CHECK(within.report.status == OptimizeStatus::optimal);
  }
  for (const double load : {15.032, 15.0}) {
    problem.limits.highest_normal_load = load;
    const Optimum without = optimize(problem);
    CAPTURE(load, without.report.brief());
    CHECK(without.report.status == OptimizeStatus::infeasible);
    CHECK(without.report.message.find("cannot be met together; it would take") != std::string::npos);
  }
}
