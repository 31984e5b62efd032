// The group `body`: what slides and what rolls, with what it takes for granted and what it refuses.

#include "glissade/core/air.hpp"
#include "glissade/design/design.hpp"

#include "design/design_text.hpp"
#include "support/catch.hpp"

#include <cmath>
#include <string>

using namespace glissade;
using namespace glissade::test;
using Catch::Matchers::Contains;

namespace {

std::string with_body(const std::string& keys, const std::string& kind = "fastest") {
  std::string text = sound_design_with("  friction_angle: 17 deg\n", "  " + keys + "\n");
  return text.replace(text.find("kind: fastest"), 13, "kind: " + kind);
}

BodyDesign body_with(const std::string& keys, const std::string& kind = "fastest") {
  return parse_design(with_body(keys, kind), "d.yaml").body;
}

std::string problems_of_body(const std::string& keys, const std::string& kind = "fastest") {
  return problems_of(with_body(keys, kind));
}

const std::string kBall = "{kind: rolling, rolling_resistance: 0.01, radius: 8 mm";

std::string ball_with(const std::string& more) {
  std::string text(kSoundDesign);
  const std::string_view part = "body:\n  friction_angle: 17 deg\n";
  return text.replace(text.find(part), part.size(), "body: " + kBall + more + "}\n");
}

}  // namespace

TEST_CASE("a rolling body has a radius, a resistance and, if slip is to be judged, a friction") {
  const BodyDesign ball =
      parse_design(ball_with(", groove_half_angle: 45 deg, friction_angle: 17 deg"), "d").body;
  REQUIRE(ball.rolling() != nullptr);
  CHECK(ball.friction.coefficient() == 0.01);
  CHECK(ball.rolling()->radius == 0.008);
  CHECK(ball.rolling()->groove_half_angle.degrees() == Approx(45.0));
  REQUIRE(ball.rolling()->grip);
  CHECK(ball.rolling()->grip->angle().degrees() == Approx(17.0));
  CHECK_FALSE(ball.centre_height);
  CHECK_FALSE(parse_design(ball_with(""), "d").body.rolling()->grip);
  CHECK(parse_design(ball_with(", centre_height: 9 mm"), "d").body.centre_height == 0.009);
  CHECK(body_with("friction_angle: 17 deg").slides());
  CHECK(body_with("kind: sliding\n  friction_angle: 17 deg").slides());
}

TEST_CASE("the rolling resistance may be a range") {
  std::string text = ball_with("");
  text.replace(text.find("0.01"), 4, "{low: 0.005, nominal: 0.01, high: 0.02}");
  const BodyDesign body = parse_design(text + "limits: {}\n", "d").body;
  CHECK(body.low_friction->coefficient() == 0.005);
  CHECK(body.high_friction->coefficient() == 0.02);
  CHECK(problems_of(text).empty());
}

TEST_CASE("drag follows from mass, drag area and the air") {
  // The standard atmosphere at sea level weighs 1.225 kg/m^3.
  CHECK(body_with("{friction_angle: 3 deg, mass: 80 kg, drag_area: 0.25 m^2}").drag_per_metre ==
        Approx(1.225 * 0.25 / 160.0).epsilon(1e-6));
  CHECK(body_with("{friction_angle: 3 deg, mass: 80 kg, drag_area: 2500 cm^2, air: {density: 1.1 kg/m^3}}")
            .drag_per_metre == Approx(1.1 * 0.25 / 160.0).epsilon(1e-14));
  const BodyDesign skier = body_with(
      "{friction_angle: 3 deg, mass: 80 kg, drag_area: 0.25 m^2, air: {altitude: 1200 m, temperature: -5 "
      "degC}}");
  CHECK(skier.drag_per_metre == air_density(1200.0, 268.15) * 0.25 / 160.0);
}

TEST_CASE("a friction that changes along the track is a list from its start on") {
  const std::string list = "friction: [{from: 0 m, angle: 3 deg}, {from: 4 m, coefficient: 0.2}]";
  const BodyDesign body = body_with(list, "straight");
  REQUIRE(body.friction_changes.size() == 2);
  CHECK(body.friction == body.friction_changes[0].friction);
  CHECK(body.friction_changes[1].from == 4.0);
  CHECK(body.friction_changes[1].friction.coefficient() == 0.2);
  CHECK(problems_of_body(list).empty());
  CHECK_THAT(problems_of_body("friction: [{from: 1 m, angle: 3 deg}]", "straight"),
             Contains("friction: the first entry begins at 1 m") && Contains("Try: from: 0 m"));
  CHECK_THAT(problems_of_body("friction: [{from: 0 m, angle: 3 deg}, {from: 0 m, angle: 4 deg}]", "straight"),
             Contains("from: 0 mm after 0 mm"));
  CHECK_THAT(problems_of_body("friction: []", "straight"), Contains("friction: the list is empty"));
  CHECK_THAT(problems_of_body("friction: [{from: 0 m, angle: 3 deg, coefficient: 0.1}]", "straight"),
             Contains("both angle and coefficient are given"));
  CHECK_THAT(problems_of_body("friction: [{from: 0 m, angle: 3 deg}]\n  friction_angle: 4 deg", "straight"),
             Contains("a list, and a friction for the whole track beside it"));
  // One value from the command line replaces it.
  CHECK(problems_of(with_body(list), {{"body.friction_angle", "5 deg"}}).empty());
}

TEST_CASE("a body that cannot be is refused with its value, its bound and a way out") {
  CHECK_THAT(problems_of_body("{kind: rolling, radius: 8 mm}"),
             Contains("rolling_resistance is missing") && Contains("Try: rolling_resistance: 0.01"));
  CHECK_THAT(problems_of_body("{kind: rolling, rolling_resistance: 0.01}"), Contains("radius is missing"));
  CHECK_THAT(problems_of(ball_with(", radius: 0 mm")), Contains("radius"));
  CHECK_THAT(problems_of_body("{friction_angle: 3 deg, radius: 8 mm}"),
             Contains("unknown key radius") && Contains("Try: kind: rolling"));
  CHECK_THAT(problems_of_body("{kind: flowing, friction_angle: 3 deg}"), Contains("flowing"));
  CHECK_THAT(problems_of(ball_with(", groove_half_angle: 100 deg")),
             Contains("groove_half_angle: 100 deg is out of range") && Contains("at most 90 deg"));
  CHECK_THAT(problems_of(ball_with(", friction_coefficient: {nominal: 0.3, low: 0.2}")),
             Contains("friction_coefficient: a range, of a body that rolls"));
  CHECK_THAT(problems_of_body("{friction_angle: 3 deg, centre_height: -1 m}"),
             Contains("centre_height: -1 m is out of range"));
  CHECK_THAT(problems_of_body("{friction_angle: 3 deg, mass: 80 kg}"),
             Contains("mass: without a drag_area it changes nothing"));
  CHECK_THAT(problems_of_body("{friction_angle: 3 deg, drag_area: 0.2 m^2}"), Contains("mass is missing"));
  // What hangs on a key that is misspelt is no problem of its own.
  CHECK_THAT(problems_of_body("{friction_angel: 3 deg, mass: 80 kg, drag_are: 0.2 m^2, head_wind: 2 m/s}"),
             Contains("unknown key friction_angel") && Contains("unknown key drag_are") &&
                 !Contains("is missing") && !Contains("changes nothing") && !Contains("without drag"));
  CHECK_THAT(problems_of_body("{friction_coeficient: 0.1}"),
             Contains("Try: friction_coefficient") && !Contains("is missing"));
  CHECK_THAT(problems_of_body("{friction_angle: 3 deg, drag_area: 0.2 m^2, mass: 0 kg}"),
             Contains("mass: 0 kg is out of range"));
  CHECK_THAT(problems_of_body("{friction_angle: 3 deg, drag_area: 0.2 m^2, mass: 9 kg, drag: 0.1 1/m}"),
             Contains("both drag and drag_area are given"));
  CHECK_THAT(
      problems_of_body("{friction_angle: 3 deg, drag_area: 0.2 m^2, mass: 9 kg, air: {altitude: 20 km}}"),
      Contains("altitude: 20 km is out of range") && Contains("between -500 m and 11 km"));
  CHECK_THAT(
      problems_of_body("{friction_angle: 3 deg, drag_area: 0.2 m^2, mass: 9 kg, air: {temperature: -5}}"),
      Contains("temperature: -5 has no unit") && Contains("degC or K"));
  CHECK_THAT(
      problems_of_body(
          "{friction_angle: 3 deg, drag_area: 0.2 m^2, mass: 9 kg, air: {density: 1 kg/m^3, altitude: 0 m}}"),
      Contains("air: a density, and what it follows from beside it"));
  CHECK_THAT(problems_of_body("{friction_angle: 3 deg, head_wind: 3 m/s}"),
             Contains("head_wind: 3 m/s on a body without drag"));
  CHECK_THAT(problems_of_body("{friction_angle: 3 deg, head_wind: 300 m/s, drag: 0.1 1/m}"),
             Contains("head_wind: 300 m/s is out of range"));
  CHECK_THAT(problems_of_body("{friction_angle: 3 deg, centre_height: 0.6 m}", "constant-speed"),
             Contains("constant-speed without p, for a body that is not a sliding point"));
  // A list of one friction is that friction.
  CHECK(
      problems_of_body("{friction: [{from: 0 m, angle: 3 deg}, {from: 1 m, angle: 3 deg}]}", "constant-speed")
          .empty());
  CHECK_THAT(problems_of_body("{friction: [{from: 0 m, angle: 3 deg}, {from: 1 m, angle: 4 deg}]}",
                              "constant-speed"),
             Contains("constant-speed without p, for a body that is not a sliding point"));
}

TEST_CASE("beyond reach is told of what rolls by its own resistance, and only where the theorem holds") {
  std::string text = ball_with("");
  text.replace(text.find("0.01"), 4, "0.96");
  CHECK_THAT(problems_of(text),
             Contains("infeasible: ") && Contains("rolling_resistance: 0.96 (43.83 deg) is steeper"));
  // Between 5.1 m of drop over 5.4 m, a centre 2 m up may just arrive; and a gale may blow a body there.
  text.replace(text.find("8 mm"), 4, "2 m");
  CHECK(problems_of(text).empty());
  CHECK_THAT(problems_of_body("{friction_angle: 50 deg, drag: 0.1 1/m}"), Contains("infeasible: "));
  CHECK(problems_of_body("{friction_angle: 50 deg, drag: 0.1 1/m, head_wind: -40 m/s}").empty());
}

TEST_CASE("air density: the standard atmosphere") {
  // ISO 2533, table of altitudes.
  CHECK(air_density(0.0, standard_temperature(0.0)) == Approx(1.225).epsilon(1e-5));
  CHECK(air_density(1000.0, standard_temperature(1000.0)) == Approx(1.11164).epsilon(1e-5));
  CHECK(air_density(5000.0, standard_temperature(5000.0)) == Approx(0.73612).epsilon(1e-4));
  CHECK(air_density(11000.0, standard_temperature(11000.0)) == Approx(0.3639).epsilon(1e-3));
  CHECK(air_density(0.0, 273.15) == Approx(1.2923).epsilon(1e-4));
  for (const double altitude : {-501.0, 11001.0, std::nan("")}) {
    CHECK_THROWS_AS(standard_temperature(altitude), InputError);
    CHECK_THROWS_AS(air_density(altitude, 273.15), InputError);
  }
  for (const double temperature : {0.0, -1.0, std::nan("")})
    CHECK_THROWS_AS(air_density(0.0, temperature), InputError);
}
