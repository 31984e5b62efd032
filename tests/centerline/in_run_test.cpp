#include "glissade/centerline/in_run.hpp"

#include "glissade/centerline/cubic_bend.hpp"
#include "glissade/centerline/track_from.hpp"
#include "glissade/core/error.hpp"

#include "support/catch.hpp"
#include "support/random.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <string>

#include <boost/math/quadrature/gauss_kronrod.hpp>

using namespace glissade;
using Catch::Matchers::Contains;

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

InRunShape garmisch(InRunTransition transition = InRunTransition::cubic) {
  return {Angle::from_degrees(35.0), Angle::from_degrees(11.0), 103.0, 6.9, 102.9, transition, 0.0};
}

double quadrature(const std::function<double(double)>& function, double from, double to) {
  return boost::math::quadrature::gauss_kronrod<double, 61>::integrate(function, from, to, 10, 1e-15);
}

std::string problem_of(const InRunShape& shape) {
  try {
    const InRun in_run(shape);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

InRunShape random_shape(testing::Random& random) {
  InRunShape shape;
  shape.alpha = Angle::from_degrees(random.between(0.0, 20.0));
  shape.gamma = Angle::from_degrees(shape.alpha.degrees() + random.between(1.0, 49.0));
  shape.gamma = std::min(shape.gamma, Angle::from_degrees(75.0));
  shape.r1 = std::pow(10.0, random.between(-1.0, 3.0));
  shape.t = shape.r1 * random.between(0.01, 0.2);
  shape.transition = static_cast<InRunTransition>(static_cast<int>(random.between(0.0, 3.999)));
  shape.first_radius = shape.r1 * random.between(0.3, 3.0);
  shape.length = (shape.t + transition_length(shape)) * random.between(1.001, 2.0);
  return shape;
}

}  // namespace

TEST_CASE("the cubic transition of a certificate has the measures that the norm's formulas give") {
  // facts of the norm, worked out for gamma 35, alpha 11, r1 103 m, t 6.9 m, e 96 m
  const InRun in_run(garmisch());
  CHECK(std::fabs(in_run.table_begins() - in_run.transition_begins() - 71.2767) < 0.5e-4);
  CHECK(std::fabs(in_run.transition_begins() - 24.723) < 0.5e-3);
  const CubicBend bend(Angle::from_degrees(24.0), 103.0);
  CHECK(std::fabs(bend.reach() - 69.9263) < 0.5e-4);
  CHECK(std::fabs(bend.offset() - 10.3777) < 0.5e-4);
  const Endpoints end = in_run.endpoints();
  const CenterlinePoint e1 = in_run.at(in_run.transition_begins());
  CHECK(std::fabs(end.run - e1.x - 70.01) < 0.5e-2);
  CHECK(std::fabs(end.drop - e1.drop - 32.92) < 0.5e-2);
  // A as programs place it that take the length of the curve for d (1 + 0.1 tan^2 D): 36 mm too far down
  const double rough = bend.reach() * (1.0 + 0.1 * std::pow(std::tan(24.0 * kDegree), 2.0));
  CHECK(std::fabs(rough - bend.length() - 0.0358) < 0.5e-4);
  CHECK(std::fabs(end.run - (rough - bend.length()) * std::cos(35.0 * kDegree) - 90.23) < 0.5e-2);
  CHECK(std::fabs(end.drop - (rough - bend.length()) * std::sin(35.0 * kDegree) - 47.08) < 0.5e-2);
  CHECK(std::fabs(transition_length(garmisch(InRunTransition::circle)) - 43.145) < 0.5e-3);
  CHECK(std::fabs(transition_length(garmisch(InRunTransition::clothoid)) - 86.289) < 0.5e-3);
}

TEST_CASE(
    "curvature is 0 where a cubic bend begins, 1/R where it ends, grows all along, and turns by the angle "
    "asked") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (int i = 0; i < 300; ++i) {
    const double turn = random.between(0.01, 50.0) * kDegree;
    const double radius = std::pow(10.0, random.between(-3.0, 4.0));
    CAPTURE(turn, radius);
    const CubicBend bend(Angle::from_radians(turn), radius);
    CHECK(bend.at(0.0).curvature == 0.0);
    CHECK(bend.at(0.0).along == 0.0);
    const CubicBend::Place end = bend.at(bend.length());
    CHECK(std::fabs(end.curvature * radius - 1.0) < 1e-13);
    CHECK(std::fabs(end.turned - turn) < 1e-14);
    CHECK(std::fabs(end.along / bend.reach() - 1.0) < kCubicBendAccuracy);
    CHECK(std::fabs(end.across / bend.offset() - 1.0) < 3.0 * kCubicBendAccuracy);
    double before = 0.0;
    double most = 0.0;
    bool grows = true;
    for (int k = 1; k <= 400; ++k) {
      const double curvature = bend.at(bend.length() * k / 400).curvature;
      grows = grows && curvature > before;
      before = curvature;
      most = std::max(most, curvature);
    }
    // 400 samples do not see a peak that lies within the last of them.
    const double beyond = turn - CubicBend::kGrowingTurn.radians();
    if (std::fabs(beyond) > 0.01) CHECK(grows == (beyond < 0.0));
    CHECK(std::fabs(most * bend.smallest_radius() - 1.0) < 1e-4);
    CHECK(most * bend.smallest_radius() <= 1.0 + 1e-13);
  }
}

TEST_CASE(
    "arc length of a cubic bend is that of adaptive quadrature, to its stated accuracy, at every place") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (int i = 0; i < 200; ++i) {
    const double turn = random.between(0.01, 50.0) * kDegree;
    const CubicBend bend(Angle::from_radians(turn), random.between(0.1, 200.0));
    const double c = std::tan(turn) / (3.0 * bend.reach() * bend.reach());
    const double s = bend.length() * random.between(0.0, 1.0);
    CAPTURE(turn, bend.end_radius(), s);
    const double length = quadrature(
        [&](double xi) { return std::sqrt(1.0 + 9.0 * c * c * std::pow(xi, 4.0)); }, 0.0, bend.at(s).along);
    CHECK(std::fabs(length - s) <= kCubicBendAccuracy * bend.length());
  }
}

TEST_CASE("an in-run's position is the integral of its direction, and its slope that of its curvature") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (int i = 0; i < 60; ++i) {
    const InRun in_run(random_shape(random));
    CAPTURE(i, static_cast<int>(in_run.shape().transition), in_run.shape().r1);
    const std::vector<double> breaks = in_run.breaks();
    REQUIRE(breaks.size() == 4);
    for (std::size_t k = 1; k < breaks.size(); ++k) {
      const double to = std::nextafter(breaks[k], 0.0);
      const auto integral = [&](auto value) { return quadrature(value, breaks[k - 1], to); };
      const CenterlinePoint a = in_run.at(breaks[k - 1]);
      const CenterlinePoint b = in_run.at(to);
      const double scale = in_run.length();
      CHECK(std::fabs(integral([&](double s) { return std::cos(in_run.slope_angle(s)); }) - (b.x - a.x)) <
            kInRunAccuracy * scale);
      CHECK(std::fabs(integral([&](double s) { return std::sin(in_run.slope_angle(s)); }) -
                      (b.drop - a.drop)) < kInRunAccuracy * scale);
      CHECK(std::fabs(integral([&](double s) { return in_run.direction(s).curvature; }) -
                      (a.slope_angle - b.slope_angle)) < 1e-13);
    }
    CHECK(in_run.slope_angle(0.0) == in_run.shape().gamma.radians());
    CHECK(in_run.slope_angle(in_run.length()) == in_run.shape().alpha.radians());
    CHECK(in_run.at(in_run.table_begins()).curvature == 0.0);
    const double before = in_run.direction(std::nextafter(in_run.table_begins(), 0.0)).curvature;
    CHECK(std::fabs(before * in_run.shape().r1 - 1.0) < 1e-11);
  }
}

TEST_CASE("the explicit height of a cubic transition over its run is the norm's, by Cardano's formula") {
  const InRunShape shape = garmisch();
  const InRun in_run(shape);
  const double g = 35.0 * kDegree;
  const double a = 11.0 * kDegree;
  const double turn = g - a;
  const double d = 2.0 * shape.r1 * std::sin(turn) * std::pow(std::cos(turn), 2.0);
  const double c = std::tan(turn) / (3.0 * d * d);
  const double f = std::tan(turn) * d / 3.0;
  const Endpoints edge = in_run.endpoints();
  for (int i = 1; i < 40; ++i) {
    const double s =
        in_run.transition_begins() + (in_run.table_begins() - in_run.transition_begins()) * i / 40;
    const CenterlinePoint point = in_run.at(s);
    const double x = point.x - edge.run;
    const double p = 1.0 / (3.0 * c * std::tan(g));
    const double q =
        (x + shape.t * std::cos(a) + f * std::sin(g) + d * std::cos(g)) / (2.0 * c * std::sin(g));
    const double root = std::sqrt(q * q + p * p * p);
    const double xi = std::cbrt(root + q) - std::cbrt(root - q);
    const double z = shape.t * std::sin(a) - f * std::cos(g) + d * std::sin(g) - xi * std::sin(g) +
                     c * xi * xi * xi * std::cos(g);
    CHECK(std::fabs(z - (edge.drop - point.drop)) < 1e-12);
  }
}

TEST_CASE("a cubic bend of any size within its bounds is the same bend") {
  for (const double radius : {kShortestWay, 1.0, kLongestWay}) {
    const CubicBend bend(Angle::from_degrees(20.0), radius);
    CHECK(bend.length() / radius ==
          Approx(CubicBend(Angle::from_degrees(20.0), 1.0).length()).epsilon(1e-14));
    CHECK(bend.at(bend.length()).along / radius == Approx(bend.reach() / radius).epsilon(1e-13));
  }
  for (const double radius : {1e308, 1e-201}) {
    CHECK_THROWS_WITH(CubicBend(Angle::from_degrees(20.0), radius),
                      Contains(" m, is out of range") && Contains("between 1e-200 m and 1e+200 m"));
  }
}

TEST_CASE("what makes no in-run is refused with the value, the bound and a way out") {
  const auto with = [](auto change) {
    InRunShape shape = garmisch();
    change(shape);
    return problem_of(shape);
  };
  CHECK(with([](InRunShape&) {}) == "");
  // Heini-Klopfer: r1 177.5 m is no radius of a cubic transition.
  const InRunShape klopfer{Angle::from_degrees(38.7),
                           Angle::from_degrees(11.2),
                           177.5,
                           8.5,
                           118.0 + 8.5,
                           InRunTransition::cubic,
                           0.0};
  CHECK_THAT(problem_of(klopfer), Contains("with r1 177.5 m") &&
                                      Contains("are longer than the in-run, 126.5 m") &&
                                      Contains("transition: circle"));
  CHECK_THAT(with([](InRunShape& shape) { shape.gamma = Angle::from_degrees(10.0); }),
             Contains("gamma: 10 deg is not above alpha, 11 deg"));
  CHECK_THAT(with([](InRunShape& shape) { shape.r1 = 0.0; }),
             Contains("r1: 0") && Contains("is not positive"));
  CHECK_THAT(with([](InRunShape& shape) { shape.t = -1.0; }), Contains("t: -1 m is not positive"));
  CHECK_THAT(with([](InRunShape& shape) { shape.gamma = Angle::from_degrees(80.0); }),
             Contains("gamma - alpha: 69 deg is too much for a cubic transition") && Contains("clothoid"));
  // Curvature grows to the end of a bend up to 24.1 deg; it is the stated accuracy that ends at 50 deg.
  CHECK_THAT(with([](InRunShape& shape) { shape.gamma = Angle::from_degrees(70.0); }),
             Contains("gamma - alpha: 59 deg is too much") &&
                 Contains("turns by at most 50 deg: up to there") &&
                 Contains("it turns by 24.1 deg at most"));
  CHECK_THAT(with([](InRunShape& shape) { shape.r1 = HUGE_VAL; }), Contains("is not positive and finite"));
  // Each letter is named once.
  const std::string steep = with([](InRunShape& shape) { shape.gamma = Angle::from_degrees(91.0); });
  CHECK_THAT(steep, Catch::Matchers::StartsWith("gamma: 91 deg is out of range"));
  CHECK_THAT(with([](InRunShape& shape) { shape.length = 60.0; }), Contains("longer than the in-run, 60 m"));
  CHECK_THAT(with([](InRunShape& shape) { shape.transition = InRunTransition::two_radii; }),
             Contains("first_radius: 0"));
  // Each letter that is wrong by itself, at once.
  CHECK_THAT(with([](InRunShape& shape) {
               shape.alpha = Angle::from_degrees(41.0);
               shape.r1 = -103.0;
               shape.t = 0.0;
             }),
             Contains("gamma: 35 deg is not above alpha, 41 deg") && Contains("r1: -103 m is not positive") &&
                 Contains("t: 0 mm is not positive"));
}

TEST_CASE("the part of a track from a place on is that track, moved") {
  const auto whole = std::make_shared<const InRun>(garmisch());
  const TrackFrom part(whole, 10.0);
  CHECK(part.length() == whole->length() - 10.0);
  CHECK(part.at(0.0).x == 0.0);
  CHECK(part.breaks().size() == 4);
  for (const double s : {0.0, 5.0, 20.0, 90.0, part.length()}) {
    const CenterlinePoint here = part.at(s);
    const CenterlinePoint there = whole->at(std::min(10.0 + s, whole->length()));
    CHECK(here.slope_angle == there.slope_angle);
    CHECK(std::fabs(here.x - (there.x - whole->at(10.0).x)) < 1e-13);
    CHECK(part.direction(s).curvature == there.curvature);
  }
  CHECK(TrackFrom(whole, 30.0).breaks().size() == 3);
  CHECK_THROWS_AS(TrackFrom(whole, whole->length()), InputError);
  CHECK_THROWS_AS(TrackFrom(nullptr, 0.0), InputError);
  const TrackFrom middle(whole, 10.0, 60.0);
  CHECK(middle.length() == 50.0);
  CHECK(middle.breaks().size() == 3);
  CHECK(middle.breaks().back() == 50.0);
  for (const double s : {0.0, 20.0, 50.0}) {
    CHECK(middle.at(s).x == part.at(s).x);
    CHECK(middle.at(s).curvature == part.at(s).curvature);
  }
  CHECK_THROWS_AS(middle.at(50.1), InputError);
  for (const double end : {10.0, 5.0, whole->length() + 1e-6})
    CHECK_THROWS_WITH(TrackFrom(whole, 10.0, end), Contains("from 10 m on cannot end at"));
}
