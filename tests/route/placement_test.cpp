#include "glissade/route/placement.hpp"

#include "glissade/core/error.hpp"

#include "support/catch.hpp"

#include <limits>
#include <numbers>

using namespace glissade;

TEST_CASE("placement: without arguments the plane is x-z and left is +y") {
  const Placement placement;
  CHECK(placement.to_space(2.0, 3.0, 0.5) == Vec3{2.0, 0.5, -3.0});
  CHECK(placement.azimuth().radians() == 0.0);
}

TEST_CASE("placement: through two points the run ends above or below the finish, exactly on its axis") {
  const Vec3 start{1.0, -2.0, 6.0};
  const Vec3 finish{4.0, 2.0, 1.0};
  const Placement placement = Placement::through(start, finish);
  const Vec3 end = placement.to_space(5.0, 5.0, 0.0);
  CHECK(norm(end - finish) <= 4e-15);
  CHECK(placement.azimuth().degrees() == Approx(53.13010235415598).epsilon(1e-14));

  const Placement north = Placement::through({0.0, 0.0, 1.0}, {0.0, 7.0, 0.0});
  CHECK(north.to_space(7.0, 1.0, 0.25) == Vec3{-0.25, 7.0, 0.0});
}

TEST_CASE("placement: a finish straight below the start lies in the x-z plane") {
  CHECK(Placement::through({3.0, 4.0, 5.0}, {3.0, 4.0, 0.0}) ==
        Placement({3.0, 4.0, 5.0}, Angle::from_radians(0.0)));
}

TEST_CASE("placement: positions keep distances and the left side, whatever the azimuth") {
  for (const double azimuth : {-3.0, -1.0, 0.3, 2.0}) {
    const Placement placement({10.0, 20.0, 30.0}, Angle::from_radians(azimuth));
    const Vec3 origin = placement.to_space(0.0, 0.0, 0.0);
    const Vec3 forward = placement.to_space(1.0, 0.0, 0.0) - origin;
    const Vec3 left = placement.to_space(0.0, 0.0, 1.0) - origin;
    const Vec3 up = placement.to_space(0.0, -1.0, 0.0) - origin;
    CHECK(norm(cross(forward, left) - up) <= 1e-14);
    CHECK(std::fabs(dot(forward, left)) <= 1e-14);
  }
}

TEST_CASE("placement: a position that is not finite is refused by name") {
  CHECK_THROWS_WITH(Placement::through({0.0, 0.0, 0.0}, {std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0}),
                    contains_text("finish: (nan, 0, 0) m is not a position"));
  CHECK_THROWS_AS(Placement({0.0, std::numeric_limits<double>::infinity(), 0.0}, Angle()), InputError);
}
