#include "glissade/centerline/cycloid.hpp"

#include "glissade/centerline/coulomb_brachistochrone.hpp"
#include "glissade/centerline/no_curvature_load.hpp"
#include "glissade/core/error.hpp"

#include "support/catch.hpp"
#include "support/random.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <vector>

using namespace glissade;

namespace {

/// Endpoints 1 mm to 100 km apart whose mean slope exceeds the friction coefficient by 10^-4 to 10^4.
Endpoints random_endpoints(testing::Random& random, double mu) {
  const double run = std::pow(10.0, random.between(-3.0, 5.0));
  const double ratio = mu + std::pow(10.0, random.between(-4.0, 4.0));
  return {run, run * ratio};
}

void check_same_curve(const Centerline& first, const Centerline& second) {
  const double tolerance = 1e-13 * first.length();
  CHECK(std::fabs(first.length() - second.length()) <= tolerance);
  for (const double part : {1e-9, 0.01, 0.2, 0.5, 0.8, 0.97}) {
    INFO("at " << part << " of the length");
    const CenterlinePoint a = first.at(part * first.length());
    const CenterlinePoint b = second.at(part * first.length());
    CHECK(std::fabs(a.x - b.x) <= tolerance);
    CHECK(std::fabs(a.x - b.x) <= 1e-11 * a.x);
    CHECK(std::fabs(a.drop - b.drop) <= tolerance);
    CHECK(std::fabs(a.slope_angle - b.slope_angle) * a.curvature <= 1e-12 * a.curvature);
  }
}

}  // namespace

TEST_CASE("cycloid: it is the fastest track at friction 0") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (int i = 0; i < 100; ++i) {
    const Endpoints endpoints = random_endpoints(random, 0.0);
    INFO("run " << endpoints.run << ", drop " << endpoints.drop);
    check_same_curve(Cycloid(endpoints), CoulombBrachistochrone(endpoints, Friction{}));
  }
}

TEST_CASE("no-curvature-load: it is the cycloid at friction 0") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (int i = 0; i < 100; ++i) {
    const Endpoints endpoints = random_endpoints(random, 0.0);
    INFO("run " << endpoints.run << ", drop " << endpoints.drop);
    check_same_curve(Cycloid(endpoints), NoCurvatureLoadCurve(endpoints, Friction{}));
  }
}

TEST_CASE("no-curvature-load: its points are those of the textbook form") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (int i = 0; i < 200; ++i) {
    const double mu = random.between(0.0, 3.0);
    const Endpoints endpoints = random_endpoints(random, mu);
    INFO("mu " << mu << ", run " << endpoints.run << ", drop " << endpoints.drop);
    const NoCurvatureLoadCurve curve(endpoints, Friction::from_coefficient(mu));
    const double tolerance = NoCurvatureLoadCurve::kPositionAccuracy * curve.length();
    const CenterlinePoint finish = curve.at(curve.length());
    CHECK(std::fabs(finish.x - endpoints.run) <= tolerance);
    CHECK(std::fabs(finish.drop - endpoints.drop) <= tolerance);
    const double scale = 1.0 / (4.0 * curve.at(0.0).curvature * mu);  // half of MathWorld's k^2
    for (const double part : {0.2, 0.6, 0.9}) {
      const CenterlinePoint point = curve.at(part * curve.length());
      const double t = std::numbers::pi - 2.0 * point.slope_angle;
      CHECK(std::fabs(point.x - scale * ((t - std::sin(t)) + mu * (1.0 - std::cos(t)))) <=
            tolerance + 1e-15 * scale);
      CHECK(std::fabs(point.drop - scale * ((1.0 - std::cos(t)) + mu * (t + std::sin(t)))) <=
            tolerance + 1e-15 * scale);
    }
  }
}

TEST_CASE("no-curvature-load: the body it was made for takes the time of its closed form") {
  const double mu = 0.3;
  const double gravity = 9.81;
  const NoCurvatureLoadCurve curve({10.0, 5.0}, Friction::from_coefficient(mu));
  // dt = ds/u with u^2 = 2 g (y - mu x); s = r^2 takes the singularity at rest away.
  constexpr int kSteps = 20000;
  const double last = std::sqrt(curve.length());
  double time = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double root = (i + 0.5) / kSteps * last;
    const CenterlinePoint point = curve.at(root * root);
    time += 2.0 * root * last / kSteps / std::sqrt(2.0 * gravity * (point.drop - mu * point.x));
  }
  CHECK(curve.travel_time_without_curvature_load(gravity) == Approx(time).epsilon(1e-8));
}

TEST_CASE("no-curvature-load: with friction its curvature at the start is finite") {
  const NoCurvatureLoadCurve rough({10.0, 5.0}, Friction::from_coefficient(0.3));
  CHECK_FALSE(rough.unbounded_curvature_at_start());
  CHECK(rough.at(0.0).slope_angle == std::numbers::pi / 2.0);
  CHECK(rough.at(0.0).curvature == Approx(rough.at(1e-12).curvature).epsilon(1e-9));
  const NoCurvatureLoadCurve smooth({10.0, 5.0}, Friction{});
  CHECK(smooth.unbounded_curvature_at_start());
  CHECK(smooth.at(0.0).curvature == std::numeric_limits<double>::infinity());
}

TEST_CASE("cycloid and no-curvature-load: a run of 0 is a vertical line") {
  const Cycloid cycloid({0.0, 5.0});
  const NoCurvatureLoadCurve rough({0.0, 5.0}, Friction::from_coefficient(0.3));
  const std::vector<const Centerline*> tracks = {&cycloid, &rough};
  for (const Centerline* track : tracks) {
    CHECK(track->length() == 5.0);
    const CenterlinePoint point = track->at(2.0);
    CHECK(point.x == 0.0);
    CHECK(point.drop == 2.0);
    CHECK(point.slope_angle == std::numbers::pi / 2.0);
    CHECK(point.curvature == 0.0);
    CHECK_FALSE(track->unbounded_curvature_at_start());
  }
  CHECK(rough.travel_time_without_curvature_load(10.0) == 1.0);
}

TEST_CASE(
    "cycloid and no-curvature-load: all but vertical, all but level, immense and tiny, they end at the "
    "finish") {
  for (const Endpoints& way :
       {Endpoints{1.0, 1e150}, Endpoints{1e-160, 1.0}, Endpoints{1e199, 1e199}, Endpoints{3e-199, 2e-199},
        Endpoints{1.0, 1e-150}, Endpoints{1586.829204992559, 4.4117094685325933e-14}}) {
    INFO("run " << way.run << ", drop " << way.drop);
    const std::array<CenterlinePtr, 2> tracks = {
        std::make_shared<const Cycloid>(way), std::make_shared<const NoCurvatureLoadCurve>(way, Friction())};
    for (const CenterlinePtr& track : tracks) {
      const CenterlinePoint end = track->at(track->length());
      CHECK(std::fabs(end.x - way.run) <= 1e-7 * track->length());
      CHECK(std::fabs(end.drop - way.drop) <= 1e-13 * track->length());
      CHECK(std::isfinite(track->at(0.5 * track->length()).x));
    }
  }
}

TEST_CASE("cycloid and no-curvature-load: faulty endpoints are named") {
  CHECK_THROWS_AS(Cycloid({1e308, 1e308}), InputError);
  CHECK_THROWS_AS(NoCurvatureLoadCurve({3e-310, 2e-310}, Friction()), InputError);
  CHECK_THROWS_WITH(Cycloid({1.0, -1.0}),
                    Catch::Matchers::Contains("drop: -1 m is not a finite length above 0"));
  CHECK_THROWS_WITH(Cycloid({std::numeric_limits<double>::infinity(), 1.0}),
                    Catch::Matchers::Contains("run: inf m is not a finite length"));
  CHECK_THROWS_AS(NoCurvatureLoadCurve({2.0, 1.0}, Friction::from_coefficient(0.6)), InfeasibleError);
  CHECK_THROWS_WITH(NoCurvatureLoadCurve({2.0, 1.0}, Friction::from_coefficient(0.6)),
                    Catch::Matchers::Contains("is steeper than the mean slope from start to finish"));
}
