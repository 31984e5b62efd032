#include "glissade/report/ride_figure.hpp"

#include "glissade/centerline/straight_line.hpp"
#include "glissade/core/error.hpp"
#include "glissade/report/figure_page.hpp"

#include "support/catch.hpp"

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

TEST_CASE("energies add up to the height lost at every station") {
  const Motion motion = ride_down(0.3, 0.05);
  const Figure figure = ride_figure(RideQuantity::energy, {{"straight", &motion}});
  REQUIRE(figure.lines.size() == 4);
  for (std::size_t i = 0; i < figure.lines[0].xs.size(); ++i) {
    double sum = 0.0;
    for (const FigureLine& line : figure.lines) sum += line.ys[i];
    CHECK(sum == Approx(3.0 * kDefaultGravity).epsilon(1e-9));
  }
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
