#include "glissade/centerline/centerline.hpp"

#include "glissade/centerline/clothoid_spline.hpp"
#include "glissade/centerline/straight_line.hpp"
#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"

#include "support/catch.hpp"

#include <cmath>
#include <limits>
#include <numbers>

using namespace glissade;

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

TEST_CASE("straight line: ends at its endpoints to the last bit, without curvature") {
  for (const Endpoints endpoints : {Endpoints{10.0, 5.0}, Endpoints{0.1, 0.3}, Endpoints{0.0, 7.0},
                                    Endpoints{1e5, 1e-3}, Endpoints{3.0, -1.0}}) {
    const StraightLine line(endpoints);
    CHECK(line.endpoints() == endpoints);
    CHECK(line.length() == math::hypot(endpoints.run, endpoints.drop));
    const CenterlinePoint middle = line.at(0.5 * line.length());
    CHECK(middle.x == Approx(0.5 * endpoints.run).epsilon(1e-15));
    CHECK(middle.drop == Approx(0.5 * endpoints.drop).epsilon(1e-15));
    CHECK(middle.slope_angle == std::atan2(endpoints.drop, endpoints.run));
    CHECK(middle.curvature == 0.0);
  }
}

TEST_CASE("straight line: a finish to the left is the mirror image") {
  const StraightLine line(Endpoints{-10.0, 5.0});
  CHECK(line.endpoints() == Endpoints{10.0, 5.0});
  CHECK(line.slope_angle(1.0) == std::atan2(5.0, 10.0));
}

TEST_CASE("straight line: refuses endpoints that span no track") {
  CHECK_THROWS_WITH(StraightLine(Endpoints{0.0, 0.0}),
                    Catch::Matchers::Contains("start and finish are the same point"));
  CHECK_THROWS_WITH(StraightLine(Endpoints{kInfinity, 1.0}),
                    Catch::Matchers::Contains("run inf m") && Catch::Matchers::Contains("not finite"));
  CHECK_THROWS_AS(StraightLine(Endpoints{std::nan(""), 1.0}), InputError);
  CHECK_THROWS_WITH(
      StraightLine(Endpoints{1e308, 1.7e308}),
      Catch::Matchers::Contains("drop 1.7e+308 m are too far apart") && !Catch::Matchers::Contains("finite"));
}

TEST_CASE("a centerline refuses arc lengths that are not on it") {
  const StraightLine line(Endpoints{3.0, 4.0});
  CHECK_THROWS_WITH(line.at(5.1), Catch::Matchers::Contains("arc length 5.1 m is not on the track") &&
                                      Catch::Matchers::Contains("5 m long"));
  CHECK_THROWS_AS(line.at(-1e-9), InputError);
  CHECK_THROWS_AS(line.at(std::nan("")), InputError);
  CHECK_THROWS_AS(line.slope_angle(6.0), InputError);
}

TEST_CASE("the arc length at a run leads back to that run") {
  const ClothoidSpline spline(Angle::from_degrees(85), {{3.0, 0.0, 0.2}, {4.0, 0.2, 0.2}, {5.0, -0.1, 0.05}});
  const double run = spline.endpoints().run;
  for (int i = 0; i <= 100; ++i) {
    const double x = i == 100 ? run : run * i / 100.0;
    const double s = spline.arc_length_at_run(x);
    CHECK(std::fabs(spline.at(s).x - x) <= kRunAccuracy * spline.length());
  }
  CHECK_THROWS_WITH(spline.arc_length_at_run(run + 1.0),
                    Catch::Matchers::Contains("no point of the track has a run of"));
  CHECK_THROWS_AS(spline.arc_length_at_run(-1.0), InputError);
}

TEST_CASE("where a track overhangs, the arc length at a run is the first of several") {
  // A full loop of radius 1 between two straights of 5 m: every run from 4 m to 6 m occurs three times or
  // twice.
  const ClothoidSpline loop(Angle::from_radians(0.0),
                            {{5.0, 0.0, 0.0}, {2.0 * kPi, 1.0, 1.0}, {5.0, 0.0, 0.0}});
  CHECK(loop.arc_length_at_run(4.5) == Approx(4.5).epsilon(1e-15));
  CHECK(loop.arc_length_at_run(5.5) == Approx(5.0 + kPi / 6.0).epsilon(1e-15));
  CHECK(loop.arc_length_at_run(6.5) == Approx(6.5 + 2.0 * kPi).epsilon(1e-15));
}

TEST_CASE("on a vertical stretch the arc length at its run is where the track first gets there") {
  const ClothoidSpline track(Angle::from_radians(kPi / 2.0), {{2.0, 0.0, 0.0}, {1.0, 0.5, 0.5}});
  CHECK(track.arc_length_at_run(0.0) == 0.0);
}
