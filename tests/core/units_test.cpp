#include "glissade/core/units.hpp"

#include "glissade/core/error.hpp"

#include "support/catch.hpp"

#include <cmath>
#include <limits>

using namespace glissade;

TEST_CASE("a friction coefficient is kept to the last bit") {
  CHECK(Friction::from_coefficient(0.306).coefficient() == 0.306);
  CHECK(Friction::from_angle(Angle::from_degrees(45)).coefficient() == Approx(1.0).epsilon(1e-15));
  CHECK(Friction::from_coefficient(1.0).angle().degrees() == Approx(45.0).epsilon(1e-15));
}

TEST_CASE("friction out of range names the value and the range") {
  CHECK_THROWS_AS(Friction::from_coefficient(-0.1), InputError);
  CHECK_THROWS_AS(Friction::from_coefficient(std::numeric_limits<double>::quiet_NaN()), InputError);
  CHECK_THROWS_WITH(Friction::from_angle(Angle::from_degrees(95)),
                    Catch::Matchers::Contains("friction angle 95 deg is out of range") &&
                        Catch::Matchers::Contains("between 0 and 90 deg"));
}

TEST_CASE("an error's text has where, what, why and what to try, one after the other") {
  const InputError error(
      Issue{"chute.yaml:7:19", "width: 0 mm is not positive", "A channel needs room.", "400 mm"});
  CHECK(std::string(error.what()) ==
        "chute.yaml:7:19: width: 0 mm is not positive\n      A channel needs room.\n      Try: 400 mm");
}
