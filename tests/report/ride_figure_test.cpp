#include "glissade/report/ride_figure.hpp"

#include "glissade/centerline/drawn_track.hpp"
#include "glissade/centerline/straight_line.hpp"
#include "glissade/core/error.hpp"
#include "glissade/motion/laws/rider.hpp"
#include "glissade/motion/laws/rolling_ball.hpp"
#include "glissade/report/figure_page.hpp"

#include "support/catch.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

using namespace glissade;
using Catch::Matchers::Contains;

namespace {

Motion ride_down(double friction, double drag = 0.0) {
  return Motion(std::make_shared<StraightLine>(Endpoints{4.0, 3.0}),
                Body{Friction::from_coefficient(friction), 0.0, drag});
}

}  // namespace

TEST_CASE("every quantity has a word that names it again") {
  for (const RideQuantity quantity : ride_quantities()) CHECK(ride_quantity(word(quantity)) == quantity);
  CHECK_FALSE(ride_quantity("colour"));
}

TEST_CASE("a figure of a ride holds the numbers of the ride") {
  const Motion motion = ride_down(0.3);
  const Figure speed = ride_figure(RideQuantity::speed, {{"straight", &motion}});
  REQUIRE(speed.lines.size() == 1);
  CHECK(speed.lines[0].xs.back() == Approx(5.0));
  // v^2 = 2 g (drop - mu run)
  CHECK(speed.lines[0].ys.back() == Approx(std::sqrt(2.0 * kDefaultGravity * (3.0 - 0.3 * 4.0))));
  const Figure load = ride_figure(RideQuantity::load, {{"straight", &motion}});
  CHECK(load.lines[0].ys.back() == Approx(0.8 * 9.81 / 9.80665));
  const Figure profile = ride_figure(RideQuantity::profile, {{"straight", &motion}});
  CHECK(profile.to_scale);
  CHECK(profile.lines[0].ys.back() == Approx(-3.0));
}

TEST_CASE(
    "energies add up to one constant, whatever slides or rolls, spin and height of the centre of mass "
    "included") {
  // A crest and a valley between straights: the centre rises and falls against the track.
  const CenterlinePtr track =
      joined(Angle::from_degrees(30.0), {ClothoidSegment{1.0, 0.0, 0.0}, ClothoidSegment{1.0, -0.2, -0.2},
                                         ClothoidSegment{2.0, 0.4, 0.4}, ClothoidSegment{0.5, 0.0, 0.0}});
  const auto law =
      GENERATE(as<LawPtr>{}, nullptr, std::make_shared<Rider>(0.5),
               std::make_shared<RollingBall>(BallShape{0.02, Angle::from_degrees(40.0), {}, {}}));
  const double drag = GENERATE(0.0, 0.05);
  const double entry = GENERATE(0.0, 2.0);
  Body body{Friction::from_coefficient(0.1), entry, drag};
  body.law = law;
  const Motion motion(track, body);
  REQUIRE(motion.arrived());
  const Figure figure = ride_figure(RideQuantity::energy, {{"track", &motion}});
  REQUIRE(figure.lines.size() == (drag > 0.0 ? 4 : 3));
  const auto sum_at = [&](std::size_t i) {
    double sum = 0.0;
    for (const FigureLine& line : figure.lines) sum += line.ys[i];
    return sum;
  };
  for (std::size_t i = 0; i < figure.lines[0].xs.size(); ++i)
    CHECK(sum_at(i) == Approx(sum_at(0)).epsilon(1e-9));
  // The lowest place of the centre is where potential energy is 0; the law's inertia counts in kinetic energy alone.
  const double inertia = law ? law->inertia() : 1.0;
  CHECK(figure.lines[1].ys.front() == Approx(0.5 * inertia * entry * entry));
  CHECK(*std::min_element(figure.lines[0].ys.begin(), figure.lines[0].ys.end()) == 0.0);
}

TEST_CASE("a figure shows the whole track of a body that stalls, and its ride as far as it came") {
  const Motion motion = ride_down(0.8);
  REQUIRE(motion.stall());
  CHECK(ride_figure(RideQuantity::profile, {{"too rough", &motion}}).lines[0].xs.back() == Approx(4.0));
}

TEST_CASE("a figure without a ride is refused") {
  CHECK_THROWS_WITH(ride_figure(RideQuantity::speed, {}), Contains("there is no ride to draw"));
}

TEST_CASE("a page of figures escapes what it is given and fetches nothing") {
  const Motion motion = ride_down(0.3);
  const Figure speed = ride_figure(RideQuantity::speed, {{"<b>", &motion}});
  const std::string page =
      figure_page_html({"<script>", "a & b", {speed}, {{"name", "time", "speed"}, {{"<i>", "1"}}}});
  CHECK_THAT(page, !Contains("<script") && !Contains("<b>") && !Contains("<i>") &&
                       !Contains("http-equiv=\"refresh"));
  CHECK_THAT(page, Contains("&lt;script&gt;") && Contains("a &amp; b") && Contains("colspan=\"2\""));
  CHECK_THAT(page, Contains("default-src 'none'"));
}
