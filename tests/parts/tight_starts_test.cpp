// Frames of large sections about tracks that begin upright, whose radius is nothing there: plates bend away behind the frame.

#include "glissade/centerline/coulomb_brachistochrone.hpp"
#include "glissade/parts/plates.hpp"

#include "parts/chute_plates.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"

#include <string>

using namespace glissade;
using namespace testing;

namespace {

PlateOptions of_staves(double tolerance, double longest) {
  PlateOptions options;
  options.round = RoundMake::staves;
  options.stave_tolerance = tolerance;
  options.split.longest = longest;
  options.split.sheet = {2.0, 1.0};
  return options;
}

CoulombBrachistochrone upright_start(double run, double drop) {
  return {{run, drop}, Friction::from_angle(Angle::from_degrees(6.8))};
}

}  // namespace

TEST_CASE("a frame that plates bend away behind is refused where no gap clears them") {
  PlateOptions options = of_staves(18e-3, 3.303);
  const section::Pipe pipe{3.162, 4e-3};
  const auto make = [&] { return plates_of(upright_start(7.904, 5.883), pipe, options); };
  CHECK(refusal_of(make) ==
        "flanges|flanges: the frame at 0 mm along the track lies across plates that bend away behind it|They "
        "stand 76.1 mm "
        "out of the section within its thickness.|a track that bends less there, by a limit "
        "smallest_valley_radius, or "
        "flanges: none\n");
  options.flanges.wanted = false;
  CHECK_NOTHROW(make());
}

TEST_CASE("large pipes from upright starts are built, or refused for what is asked, and are never a defect") {
  Random random = seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (int run = 0; run < 6; ++run) {
    const double size = random.between(1.5, 3.5);
    const PlateOptions options = of_staves(random.between(10e-3, 30e-3), random.between(2.5, 4.0));
    const section::Pipe pipe{size, random.between(3e-3, 6e-3)};
    CAPTURE(run, size, options.stave_tolerance);
    std::string refused;
    CHECK_NOTHROW(refused = refusal_of([&] {
                    return plates_of(upright_start(random.between(6.0, 9.0), random.between(4.0, 7.0)), pipe,
                                     options);
                  }));
  }
}
