// Segments that lead to a slope angle, to a point, by a cubic bend: what they become on the track, and what cannot be.
#include "glissade/centerline/drawn_track.hpp"
#include "glissade/centerline/in_run.hpp"
#include "glissade/design/write.hpp"

#include "design/design_text.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"

#include <cmath>
#include <string>
#include <variant>
#include <vector>

namespace segments_test {

using namespace glissade;
using namespace glissade::test;
using Catch::Matchers::Contains;

namespace {

std::string segments(const std::string& list, const std::string& entry = "40 deg",
                     const std::string& start = "{x: 0 m, z: 6.2 m}") {
  return "glissade: 1\ntrack: {start: " + start +
         "}\nbody: {friction_angle: 10 deg}\ncenterline:\n"
         "  kind: segments\n  entry_slope_angle: " +
         entry + "\n  segments: " + list + "\n";
}

CenterlinePtr track_of(const Design& design) {
  const DrawnSegments drawn = drawn_segments(design.track, design.centerline);
  REQUIRE_FALSE(drawn.fault);
  return joined(design.centerline.entry_slope_angle, drawn.segments);
}

CenterlinePtr track_of(const std::string& text) {
  return track_of(parse_design(text, "d.yaml"));
}

double exit_slope(const CenterlinePtr& track) {
  return Angle::from_radians(track->slope_angle(track->length())).degrees();
}

}  // namespace

TEST_CASE("a segment leads to a slope angle: its length or its curvature follows") {
  const CenterlinePtr arc = track_of(segments("[{length: 2 m}, {to_slope_angle: 10 deg, radius: 3 m}]"));
  CHECK(arc->length() == Approx(2.0 + 3.0 * Angle::from_degrees(30.0).radians()).epsilon(1e-15));
  CHECK(exit_slope(arc) == Approx(10.0).epsilon(1e-14));

  const CenterlinePtr crest = track_of(segments("[{to_slope_angle: 70 deg, radius: -3 m}]"));
  CHECK(crest->length() == Approx(3.0 * Angle::from_degrees(30.0).radians()).epsilon(1e-15));
  CHECK(crest->at(0.1).curvature == Approx(-1.0 / 3.0));

  const CenterlinePtr of_length = track_of(segments("[{to_slope_angle: -10 deg, length: 4 m}]"));
  CHECK(of_length->length() == 4.0);
  CHECK(of_length->at(1.0).curvature == Approx(Angle::from_degrees(50.0).radians() / 4.0).epsilon(1e-14));

  const CenterlinePtr easing = track_of(segments("[{to_slope_angle: 25 deg, exit_radius: 6 m}]"));
  CHECK(easing->length() == Approx(2.0 * 6.0 * Angle::from_degrees(15.0).radians()).epsilon(1e-14));
  CHECK(easing->at(0.0).curvature == 0.0);
  CHECK(easing->at(easing->length()).curvature == Approx(1.0 / 6.0));
  CHECK(exit_slope(easing) == Approx(25.0).epsilon(1e-14));
}

TEST_CASE("a segment leads to a point of the site, on either side and off the x axis") {
  const auto end_of = [](const std::string& list, const std::string& start, const std::string& finish) {
    std::string text = segments(list, "40 deg", start);
    if (!finish.empty()) text.replace(text.find("}\nbody"), 1, ", finish: " + finish + "}");
    const Design design = parse_design(text, "d.yaml");
    CHECK(design_text(parse_design(design_text(design), "d.yaml")) == design_text(design));
    const Endpoints end = track_of(design)->endpoints();
    return Vec2{end.run, design.track.start.z - end.drop};
  };
  const Vec2 right = end_of("[{length: 1 m}, {to_point: [104 m, 4 m]}]", "{x: 100 m, z: 6.2 m}", "");
  CHECK(right.x == Approx(4.0).epsilon(1e-13));
  CHECK(right.y == Approx(4.0).epsilon(1e-13));
  const Vec2 left =
      end_of("[{length: 1 m}, {to_point: [96 m, 4 m]}]", "{x: 100 m, z: 6.2 m}", "{x: 96 m, z: 4 m}");
  CHECK(left.x == Approx(4.0).epsilon(1e-13));
  CHECK(left.y == Approx(4.0).epsilon(1e-13));
  // off the x axis points are counted from the start
  const Vec2 across =
      end_of("[{length: 1 m}, {to_point: [5 m, 4 m]}]", "{x: 100 m, z: 6.2 m}", "{x: 103 m, y: 4 m, z: 4 m}");
  CHECK(across.x == Approx(5.0).epsilon(1e-13));
  // at a slope angle: a clothoid, whose neighbours go on from there
  const CenterlinePtr clothoid =
      track_of(segments("[{length: 1 m}, {to_point: [4 m, 4 m], to_slope_angle: 12 deg}, {to_slope_angle: 0 "
                        "deg, radius: 2 m}]"));
  const double joint = clothoid->breaks()[2];
  CHECK(clothoid->at(joint).x == Approx(4.0).epsilon(1e-13));
  CHECK(clothoid->at(joint).drop == Approx(2.2).epsilon(1e-13));
  CHECK(Angle::from_radians(clothoid->slope_angle(joint)).degrees() == Approx(12.0).epsilon(1e-13));
  CHECK(std::fabs(exit_slope(clothoid)) < 1e-12);
}

TEST_CASE("a cubic bend leads into a curve or out of one, in valleys and on crests") {
  const CenterlinePtr drawn = track_of(segments(
      "[{length: 24.723 m}, {bend: cubic, to_slope_angle: 11 deg, exit_radius: 103 m}, {length: 6.9 m}]",
      "35 deg", "{x: 0 m, z: 60 m}"));
  const InRun in_run({Angle::from_degrees(35.0), Angle::from_degrees(11.0), 103.0, 6.9, drawn->length(),
                      InRunTransition::cubic, 0.0});
  CHECK(drawn->endpoints().run == Approx(in_run.endpoints().run).epsilon(1e-13));
  CHECK(drawn->endpoints().drop == Approx(in_run.endpoints().drop).epsilon(1e-13));

  const CenterlinePtr both =
      track_of(segments("[{bend: cubic, to_slope_angle: 25 deg, exit_radius: 8 m}, {bend: cubic, "
                        "to_slope_angle: 10 deg, entry_radius: 8 "
                        "m}]"));
  const double middle = both->breaks()[1];
  CHECK(both->at(0.0).curvature == 0.0);
  CHECK(both->at(middle).curvature == Approx(1.0 / 8.0).epsilon(1e-13));
  CHECK(std::fabs(both->at(both->length()).curvature) < 1e-12);
  CHECK(both->length() == Approx(2.0 * middle).epsilon(1e-13));

  const CenterlinePtr crest =
      track_of(segments("[{bend: cubic, to_slope_angle: 60 deg, exit_radius: -8 m}]"));
  CHECK(crest->at(crest->length()).curvature == Approx(-1.0 / 8.0).epsilon(1e-13));
  CHECK(exit_slope(crest) == Approx(60.0).epsilon(1e-14));
}

TEST_CASE("segments that cannot be are refused with place, value, bound and a way out") {
  const auto told = [](const std::string& list, const std::string& entry = "40 deg") {
    return problems_of(segments(list, entry));
  };
  CHECK_THAT(
      told("[{to_slope_angle: 10 deg}]"),
      Contains("d.yaml:7:31: segments[0]: to_slope_angle: a straight never reaches 10 deg from 40 deg") &&
          Contains("Try: radius: 5 m"));
  CHECK_THAT(
      told("[{to_slope_angle: 60 deg, radius: 3 m}]"),
      Contains("from 40 deg to 60 deg the track bends downwards, with radius 3 m it bends the other way") &&
          Contains("Try: radius -3 m"));
  CHECK_THAT(told("[{length: 1 m}, {to_slope_angle: 40 deg, radius: 3 m}]"),
             Contains("segments[1]: to_slope_angle: 40 deg is the slope angle where the segment begins"));
  CHECK_THAT(told("[{to_slope_angle: 95 deg, radius: -3 m}]"), Contains("to_slope_angle: 95 deg overhangs"));
  CHECK_THAT(told("[{to_slope_angle: 10 deg, radius: 3 m, length: 2 m}]"),
             Contains("length: 2 m is given beside a bend and a to_slope_angle"));
  CHECK_THAT(told("[{to_slope_angle: 10 deg, entry_curvature: 1 1/m, exit_curvature: -1 1/m}]"),
             Contains("the segment would be endless"));
  CHECK_THAT(told("[{to_slope_angle: 10 deg, radius: 1e9 m}]"),
             Contains("long") && Contains("at most 1000 km"));
  CHECK_THAT(told("[{to_point: [3 m, 4 m], length: 3 m}]"),
             Contains("to_point: a length is given beside it"));
  CHECK_THAT(told("[{to_point: [3 m, 4 m], radius: 3 m}]"),
             Contains("to_point: a curvature is given beside it"));
  CHECK_THAT(told("[{to_point: [0 m, 6.2 m]}]"), Contains("is where the segment begins"));
  CHECK_THAT(told("[{to_point: [-3 m, 6.2 m]}]"),
             Contains("no arc leads to [-3 m, 6.2 m]") && Contains("with slope angle 40 deg"));
  CHECK_THAT(told("[{length: 1 m}, {to_point: [1 m, 9 m]}]"),
             Contains("no arc leads to [1 m, 9 m] but one that ends at a slope angle of") &&
                 Contains("or a to_slope_angle beside it"));
  CHECK_THAT(told("[{to_point: [-3 m, 9 m], to_slope_angle: 0 deg}]"), Contains("segments[0]"));
  CHECK_THAT(told("[{to_point: [3 m, 4 m, 5 m]}]"), Contains("has 3 values instead of 2"));
  CHECK_THAT(told("[{bend: cubic, length: 3 m, exit_radius: 5 m}]"),
             Contains("a cubic bend has no to_slope_angle"));
  CHECK_THAT(told("[{bend: cubic, to_slope_angle: 10 deg, radius: 5 m}]"),
             Contains("straight at one end and has a radius at the other"));
  CHECK_THAT(told("[{bend: cubic, to_slope_angle: 10 deg, length: 4 m, exit_radius: 5 m}]"),
             Contains("length: 4 m of a cubic bend is given"));
  CHECK_THAT(told("[{bend: cubic, to_slope_angle: -20 deg, exit_radius: 5 m}]"),
             Contains("a cubic bend would turn by 60 deg") && Contains("at most 50 deg"));
  CHECK_THAT(told("[{bend: cubic, to_point: [3 m, 4 m]}]"),
             Contains("leads to a slope angle, not to a point"));
  CHECK_THAT(told("[{bend: square, length: 1 m}]"), Contains("bend"));
  CHECK_THAT(told("[{exit_radius: 3 m, exit_curvature: 1 1/m, length: 1 m}]"),
             Contains("bent in more than one way"));
  CHECK_THAT(told("[{length: 1 m, exit_radius: 0 m}]"), Contains("exit_radius: 0 m bends without bound"));
  CHECK_THAT(told("[{radius: 3 m}]"), Contains("length is missing"));
}

TEST_CASE("random segments of every kind are drawn, end where they say, and are written back") {
  auto random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  int drawn_ones = 0;
  for (int i = 0; i < 200; ++i) {
    Design design = parse_design(segments("[{length: 1 m}]"), "d.yaml");
    design.centerline.entry_slope_angle = Angle::from_degrees(random.between(-20.0, 80.0));
    for (int k = random.integer(1, 4); k > 0; --k) {
      SegmentDesign segment;
      const int kind = random.integer(0, 4);
      const Angle slope = Angle::from_degrees(random.between(0.0, 70.0));
      const double radius = random.between(1.0, 9.0) * (random.integer(0, 1) == 0 ? 1.0 : -1.0);
      if (kind == 0) segment.length = random.between(0.1, 3.0);
      if (kind == 1 || kind == 3 || kind == 4) segment.to_slope_angle = slope;
      if (kind == 1) segment.entry_curvature = segment.exit_curvature = 1.0 / radius;
      if (kind == 2 || kind == 3)
        segment.to_point = Vec2{random.between(1.0, 9.0), random.between(-9.0, 5.0)};
      if (kind == 4) {
        segment.bend = SegmentBend::cubic;
        (random.integer(0, 1) == 0 ? segment.entry_curvature : segment.exit_curvature) = 1.0 / radius;
      }
      design.centerline.segments.push_back(segment);
    }
    const DrawnSegments drawn = drawn_segments(design.track, design.centerline);
    CHECK(check(design).empty() != drawn.fault.has_value());
    if (drawn.fault) continue;
    ++drawn_ones;
    const CenterlinePtr track = joined(design.centerline.entry_slope_angle, drawn.segments);
    const std::vector<double> joints = track->breaks();
    REQUIRE(joints.size() == design.centerline.segments.size() + 1);
    for (std::size_t k = 0; k < drawn.segments.size(); ++k) {
      const SegmentDesign& segment = design.centerline.segments[k];
      const CenterlinePoint end = track->at(joints[k + 1]);
      if (segment.to_slope_angle) {
        CHECK(end.slope_angle == Approx(segment.to_slope_angle->radians()).epsilon(1e-12).margin(1e-12));
      }
      if (segment.to_point) {
        const Vec2 there = in_track_plane(design.track, *segment.to_point);
        CHECK(std::hypot(end.x - there.x, end.drop - there.y) <= 1e-13 * (1.0 + track->length()));
      }
    }
    const std::string text = design_text(design);
    INFO(text);
    CHECK(parse_design(text, "d.yaml").centerline.segments == design.centerline.segments);
  }
  CHECK(drawn_ones > 30);
}

}  // namespace segments_test
