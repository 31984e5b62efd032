// Friction that changes along the track, in the search: against one friction, against neighbours, and its derivatives.

#include "optimize/friction_along.hpp"

#include "glissade/centerline/clothoid_spline.hpp"
#include "glissade/optimize/optimize.hpp"

#include "support/catch.hpp"
#include "support/neighbours.hpp"
#include "support/random.hpp"

#include <cmath>

using namespace glissade;

namespace {

FrictionChange from(double place, double mu) {
  return {place, Friction::from_coefficient(mu)};
}

Problem slide(double entry_speed, double mu, std::vector<FrictionChange> changes) {
  Problem problem;
  problem.endpoints = {60.0, 30.0};
  problem.body.friction = Friction::from_coefficient(mu);
  problem.body.entry_speed = entry_speed;
  problem.body.friction_changes = std::move(changes);
  return problem;
}

double searched_time(const Problem& problem) {
  const Optimum optimum = optimize(problem);
  CAPTURE(optimum.report.message);
  REQUIRE(optimum.report.status == OptimizeStatus::optimal);
  CHECK(Motion(optimum.centerline, problem.body).travel_time() == optimum.report.travel_time);
  return optimum.report.travel_time;
}

}  // namespace

TEST_CASE("friction along: a list that changes nothing is one friction") {
  for (const double speed : {0.0, 4.0}) {
    const double one = searched_time(slide(speed, 0.1, {}));
    CHECK(searched_time(slide(speed, 0.1, {from(20.0, 0.1), from(500.0, 0.4)})) == Approx(one).epsilon(2e-7));
  }
}

TEST_CASE("friction along: less friction on a part of the track is never slower") {
  const double rough = searched_time(slide(3.0, 0.2, {from(25.0, 0.25), from(45.0, 0.1)}));
  const double smoother = searched_time(slide(3.0, 0.2, {from(25.0, 0.15), from(45.0, 0.1)}));
  const double smoothest = searched_time(slide(3.0, 0.2, {from(25.0, 0.15), from(45.0, 0.05)}));
  CHECK(smoother < rough);
  CHECK(smoothest < smoother);
  CHECK(rough < searched_time(slide(3.0, 0.25, {})));
}

TEST_CASE(
    "friction along: no neighbour of the fastest track is faster, by rides that know the places exactly") {
  auto random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (Problem problem : {slide(3.0, 0.03, {from(20.0, 0.3)}), slide(3.0, 0.3, {from(30.0, 0.02)}),
                          slide(0.0, 0.0, {from(15.0, 0.2), from(18.0, 0.0), from(50.0, 0.4)})}) {
    problem.limits.slope_angle.highest = 1.3;
    problem.limits.entry_slope_angle = Range::fixed(1.0);
    problem.limits.exit_slope_angle = Range::fixed(0.1);
    const Optimum optimum = optimize(problem);
    CAPTURE(optimum.report.message);
    REQUIRE(optimum.report.status == OptimizeStatus::optimal);
    const auto* spline = dynamic_cast<const ClothoidSpline*>(optimum.centerline.get());
    REQUIRE(spline != nullptr);
    const double best = optimum.report.travel_time;
    // Neighbours differ in their end slopes too: what those are worth is known from the multipliers.
    double price = 0.0;
    for (const ActiveLimit& active : optimum.report.active) {
      if (active.limit.id == LimitId::entry_slope_angle || active.limit.id == LimitId::exit_slope_angle)
        price += active.price;
    }
    int rides = 0;
    double gained = 0.0;
    for (int i = 0; i < 300; ++i) {
      const CenterlinePtr other = testing::neighbour(*spline, random, random.between(-0.05, 0.05));
      const Motion ride(other, problem.body);
      if (!ride.arrived()) continue;
      ++rides;
      const double turned =
          std::fabs(other->slope_angle(0.0) - 1.0) + std::fabs(other->slope_angle(other->length()) - 0.1);
      gained = std::max(gained, (best - 1.05 * price * turned - ride.travel_time()) / best);
    }
    CHECK(rides > 20);
    // What the search's own softened changes cost.
    CHECK(gained <= 2e-6);
  }
}

TEST_CASE("friction along: limits hold, by the referee") {
  Problem problem = slide(2.0, 0.05, {from(20.0, 0.25), from(40.0, 0.05)});
  problem.limits.speed.highest = 15.0;
  problem.limits.smallest_valley_radius = 12.0;
  problem.limits.highest_normal_load = 2.0 * kDefaultGravity;
  const Optimum optimum = optimize(problem);
  CAPTURE(optimum.report.message);
  REQUIRE(optimum.report.status == OptimizeStatus::optimal);
  for (const LimitCheck& check : optimum.report.checks) {
    CAPTURE(check.limit.key(), check.reached, check.value);
    CHECK(check.kept());
  }
}

TEST_CASE("friction along: what it cannot be together with is told, all at once") {
  Problem problem = slide(2.0, 0.05, {from(20.0, 0.25)});
  problem.high_friction = Friction::from_coefficient(0.1);
  problem.limits.lowest_slope_margin = 0.1;
  const auto refusal = [&] {
    try {
      (void)optimize(problem);
    } catch (const InputError& error) {
      return error.issues();
    }
    return std::vector<Issue>{};
  }();
  REQUIRE(refusal.size() == 2);
  CHECK(refusal[0].what == "friction that changes along the track, and a range of frictions");
  CHECK(refusal[1].what == "friction that changes along the track, and lowest_slope_margin");
}

TEST_CASE(
    "friction along: derivatives of the softened law are those of its values, and its integral is exact") {
  Body body{Friction::from_coefficient(0.1)};
  body.friction_changes = {from(4.0, 0.4), from(4.2, 0.0), from(9.0, 0.2)};
  const double chord = 10.0;
  const optimizer::FrictionAlong along(body, chord);
  const double step = 1e-5;
  double sum = 0.0;
  const int pieces = 20000;
  for (int i = 0; i < pieces; ++i) {
    const double s = (i + 0.5) / pieces;
    const Resistance here = along.resistance(s, 1.0);
    sum += along.mean() * here.factor / pieces;
    if (i % 97 != 0) continue;
    const Resistance before = along.resistance(s - step, 1.0);
    const Resistance after = along.resistance(s + step, 1.0);
    const double scale = 1.0 + std::fabs(here.by_s_s);
    CHECK(here.by_s == Approx((after.factor - before.factor) / (2.0 * step)).margin(1e-6 * scale));
    CHECK(here.by_s_s == Approx((after.by_s - before.by_s) / (2.0 * step)).margin(1e-2 * scale));
  }
  CHECK(sum == Approx(0.1 * 0.4 + 0.4 * 0.02 + 0.2 * 0.1).epsilon(1e-6));
  CHECK(along.mean() == Approx(sum).epsilon(1e-6));
  // In other units it is the same.
  const LawPtr metres = along.in_units(1.0 / chord, 1.0);
  CHECK(metres->resistance(4.1, 1.0).factor == Approx(along.resistance(0.41, 1.0).factor));
  CHECK(metres->resistance(4.1, 1.0).by_s == Approx(along.resistance(0.41, 1.0).by_s / chord));
}
