#include "glissade/section/cross_section.hpp"

#include "glissade/core/error.hpp"

#include "support/catch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

using namespace glissade;

namespace {

using Polygon = CrossSection::Polygon;

constexpr double kPi = std::numbers::pi;

double area_of(const Polygon& polygon) {
  double twice = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i)
    twice += cross(polygon[i], polygon[(i + 1) % polygon.size()]);
  return 0.5 * twice;
}

// Integral of the height, by slicing each side's triangle with the origin.
double moment_of(const Polygon& polygon) {
  double sum = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 a = polygon[i];
    const Vec2 b = polygon[(i + 1) % polygon.size()];
    sum += 0.5 * cross(a, b) * (a.y + b.y) / 3.0;
  }
  return sum;
}

std::string message_of(auto&& call) {
  try {
    static_cast<void>(call());
  } catch (const InputError& error) {
    return error.what();
  }
  return "nothing was thrown";
}

std::vector<CrossSection> one_of_each() {
  return {CrossSection::slab(0.4, 0.02),
          CrossSection::slab(0.4, 0.02, 0.05, 0.03),
          CrossSection::u_channel(0.4, 0.25, 0.004),
          CrossSection::trapezoid(0.3, 0.2, Angle::from_degrees(30.0), 0.005),
          CrossSection::half_pipe(0.5, 0.01),
          CrossSection::half_pipe(0.5, 0.01, 0.1),
          CrossSection::pipe(0.3, 0.006),
          CrossSection::v_channel(Angle::from_degrees(70.0), 0.05, 0.3, 0.006),
          CrossSection::track_groove(0.6, 0.135, 0.03, 0.32, 0.05),
          CrossSection::polygon({{0.0, 0.0}, {-0.2, 0.1}, {-0.2, -0.1}, {0.2, -0.1}, {0.2, 0.1}})};
}

}  // namespace

TEST_CASE("cross-section: outlines run counter-clockwise, bores clockwise, the floor touches the origin") {
  for (const CrossSection& section : one_of_each()) {
    INFO(section.kind());
    const Polygon outline = section.outline(1e-4);
    CHECK(area_of(outline) > 0.0);
    const Polygon bore = section.bore(1e-4);
    CHECK(bore.empty() == (section.kind() != "pipe"));
    CHECK(area_of(bore) <= 0.0);
    CHECK(static_cast<double>(outline.size() + bore.size()) == section.vertex_count(1e-4));
    double low = 0.0;
    double high = 0.0;
    for (const Vec2 corner : outline) {
      low = std::min(low, corner.y);
      high = std::max(high, corner.y);
    }
    CHECK(low == section.lowest());
    CHECK(high == Approx(section.highest()).epsilon(1e-15));
  }
}

TEST_CASE("cross-section: area and first moment are the limits of the polygons', at order 2") {
  for (const CrossSection& section : one_of_each()) {
    INFO(section.kind());
    double last_error = 0.0;
    for (const double tolerance : {1e-4, 1e-6}) {
      const double area = area_of(section.outline(tolerance)) + area_of(section.bore(tolerance));
      const double moment = moment_of(section.outline(tolerance)) + moment_of(section.bore(tolerance));
      const double error = std::fabs(area / section.area() - 1.0);
      // Both arcs lose the same share of their area: the chords' (2/3) gap / radius.
      CHECK(error <= 4.0 * tolerance / 0.15 + 1e-13);
      CHECK(std::fabs(moment - section.first_moment()) <= 8.0 * tolerance * section.area() + 1e-15);
      if (last_error > 1e-10) CHECK(error < 0.02 * last_error);
      last_error = error;
    }
  }
}

TEST_CASE("cross-section: known areas and moments") {
  CHECK(CrossSection::u_channel(0.4, 0.25, 0.004).area() ==
        Approx(0.408 * 0.254 - 0.4 * 0.25).epsilon(1e-14));
  CHECK(CrossSection::slab(2.0, 0.5).first_moment() == Approx(-0.25).epsilon(1e-14));
  CHECK(CrossSection::pipe(0.3, 0.01).area() == Approx(kPi * (0.16 * 0.16 - 0.15 * 0.15)).epsilon(1e-14));
  CHECK(CrossSection::pipe(0.3, 0.01).first_moment() ==
        Approx(0.15 * kPi * (0.16 * 0.16 - 0.15 * 0.15)).epsilon(1e-14));
  const CrossSection track = CrossSection::track_groove(0.6, 0.135, 0.03, 0.32, 0.05);
  CHECK(track.area() == Approx(0.6 * 0.08 - 2.0 * 0.135 * 0.03).epsilon(1e-14));
  CHECK(track.first_moment() ==
        Approx(0.5 * 0.6 * (0.03 * 0.03 - 0.05 * 0.05) - 0.135 * 0.03 * 0.03).epsilon(1e-13));
}

TEST_CASE(
    "cross-section: a v-channel is a bent plate: its arc is tangent to both walls, its rims are level") {
  const double angle = 70.0 * kPi / 180.0;
  const double radius = 0.05;
  const double height = 0.3;
  const double thickness = 0.006;
  const CrossSection section = CrossSection::v_channel(Angle::from_radians(angle), radius, height, thickness);
  // The plate by its two faces: half a ring of the bend, and two walls between parallel lines.
  const double turn = kPi - angle;
  const auto wall_length = [&](double r, double low) {
    return (height - (low + r * (1.0 - std::cos(0.5 * turn)))) / std::sin(0.5 * turn);
  };
  const double inner = wall_length(radius, 0.0);
  const double outer = wall_length(radius + thickness, -thickness);
  const double ring = 0.5 * turn * thickness * (2.0 * radius + thickness);
  CHECK(section.area() == Approx(ring + thickness * (inner + outer)).epsilon(1e-13));
  for (const section::Side side : {section::Side::left_wall, section::Side::right_wall}) {
    const auto strokes = section.strokes(side);
    REQUIRE(strokes.size() == 1);
    CHECK(strokes[0].length() == Approx(inner).epsilon(1e-13));
    const Vec2 along = strokes[0].to - strokes[0].from;
    CHECK(std::atan2(std::fabs(along.x), std::fabs(along.y)) == Approx(0.5 * angle).epsilon(1e-13));
    // The radius at the end of the arc is square to the wall.
    const Vec2 foot = strokes[0].to.y < strokes[0].from.y ? strokes[0].to : strokes[0].from;
    CHECK(std::fabs(dot(foot - Vec2{0.0, radius}, along)) <= 1e-15);
    CHECK(norm(foot - Vec2{0.0, radius}) == Approx(radius).epsilon(1e-13));
  }
  for (const section::Stroke& rim : section.strokes(section::Side::rim)) CHECK(rim.from.y == rim.to.y);
  double floor = 0.0;
  for (const section::Stroke& stroke : section.strokes(section::Side::floor)) floor += stroke.length();
  CHECK(floor == Approx(turn * radius).epsilon(1e-13));
}

TEST_CASE("cross-section: sides are named, and together they are the outline") {
  for (const CrossSection& section : one_of_each()) {
    INFO(section.kind());
    double whole = 0.0;
    for (const section::Outline& loop : section.loops()) {
      for (std::size_t i = 0; i < loop.size(); ++i) {
        whole += loop[i].length();
        CHECK(loop[i].to == loop[(i + 1) % loop.size()].from);
      }
    }
    double named = 0.0;
    for (const section::Side side :
         {section::Side::floor, section::Side::left_wall, section::Side::right_wall, section::Side::rim,
          section::Side::underside}) {
      for (const section::Stroke& stroke : section.strokes(side)) {
        named += stroke.length();
        const double middle = 0.5 * (stroke.from.x + stroke.to.x);
        if (section.kind() == "track-groove") continue;  // each groove has both walls
        if (side == section::Side::left_wall) CHECK(middle > 0.0);
        if (side == section::Side::right_wall) CHECK(middle < 0.0);
      }
    }
    CHECK(named == Approx(whole).epsilon(1e-14));
    CHECK_FALSE(section.strokes(section::Side::floor).empty());
    CHECK_FALSE(section.strokes(section::Side::underside).empty());
  }
}

TEST_CASE("cross-section: a u-channel's sides, one by one") {
  const CrossSection section = CrossSection::u_channel(0.4, 0.25, 0.004);
  const auto ends = [&](section::Side side) {
    std::vector<Vec2> points;
    for (const section::Stroke& stroke : section.strokes(side)) {
      points.push_back(stroke.from);
      points.push_back(stroke.to);
    }
    return points;
  };
  CHECK(ends(section::Side::floor) == Polygon{{0.2, 0.0}, {-0.2, 0.0}});
  CHECK(ends(section::Side::left_wall) == Polygon{{0.2, 0.25}, {0.2, 0.0}});
  CHECK(ends(section::Side::right_wall) == Polygon{{-0.2, 0.0}, {-0.2, 0.25}});
  CHECK(ends(section::Side::rim) ==
        Polygon{{0.2 + 0.004, 0.25}, {0.2, 0.25}, {-0.2, 0.25}, {-0.2 - 0.004, 0.25}});
  CHECK(word(section::Side::left_wall) == "left wall");
}

TEST_CASE("cross-section: a polygon's sides are named by where they face") {
  // A groove: a block with a v in it that is flatter than 45 deg on the left, steeper on the right.
  const CrossSection section =
      CrossSection::polygon({{0.0, 0.0}, {-0.1, 0.3}, {-0.2, 0.3}, {-0.2, -0.1}, {0.2, -0.1}, {0.2, 0.05}});
  const auto count = [&](section::Side side) { return section.strokes(side).size(); };
  CHECK(count(section::Side::floor) == 1);
  CHECK(section.strokes(section::Side::floor)[0].from == Vec2{0.2, 0.05});
  CHECK(count(section::Side::right_wall) == 1);
  CHECK(count(section::Side::rim) == 1);
  CHECK(count(section::Side::left_wall) == 0);
  CHECK(count(section::Side::underside) == 3);
}

TEST_CASE("cross-section: a trapezoid's plates have their thickness measured square to them") {
  const double lean = 30.0 * kPi / 180.0;
  const Polygon corners = CrossSection::trapezoid(0.3, 0.2, Angle::from_radians(lean), 0.005).outline(1e-3);
  REQUIRE(corners.size() == 8);
  const Vec2 outward{std::cos(lean), -std::sin(lean)};
  CHECK(dot(corners[2] - corners[3], outward) == Approx(0.005).epsilon(1e-12));
  CHECK(dot(corners[1] - corners[4], outward) == Approx(0.005).epsilon(1e-12));
  CHECK(corners[1].y == -0.005);
  CHECK(CrossSection::trapezoid(0.3, 0.2, Angle(), 0.005).outline(1e-3) ==
        CrossSection::u_channel(0.3, 0.2, 0.005).outline(1e-3));
}

TEST_CASE("cross-section: round outlines stay within the chord tolerance, vertices on the arc") {
  for (const double tolerance : {1e-2, 1e-3, 1e-5}) {
    const CrossSection pipe = CrossSection::pipe(0.4, 0.02);
    const Vec2 centre{0.0, 0.2};
    for (const auto& [polygon, radius] :
         {std::pair{pipe.outline(tolerance), 0.22}, {pipe.bore(tolerance), 0.2}}) {
      double gap = 0.0;
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        CHECK(norm(polygon[i] - centre) == Approx(radius).epsilon(1e-14));
        gap = std::max(gap, radius - norm(0.5 * (polygon[i] + polygon[(i + 1) % polygon.size()]) - centre));
      }
      CHECK(gap <= tolerance);
      CHECK(gap <= pipe.chord_error(tolerance) * (1.0 + 1e-9));
    }
    CHECK(pipe.chord_error(tolerance) <= tolerance);
  }
}

TEST_CASE("cross-section: left and right are exact mirror images") {
  for (const CrossSection& section :
       {CrossSection::half_pipe(0.37, 0.011, 0.05), CrossSection::pipe(0.31, 0.007)}) {
    const Polygon outline = section.outline(1e-4);
    for (const Vec2 corner : outline) {
      CHECK(std::find(outline.begin(), outline.end(), Vec2{-corner.x, corner.y}) != outline.end());
    }
  }
}

TEST_CASE("cross-section: the narrowest place of a section is its plate, or its curb") {
  CHECK(CrossSection::u_channel(0.4, 0.25, 0.004).narrowest() == Approx(0.004));
  CHECK(CrossSection::slab(0.4, 0.02, 0.05, 0.003).narrowest() == Approx(0.003));
  CHECK(CrossSection::pipe(0.4, 0.02).narrowest() == 0.02);
}

TEST_CASE("cross-section: either winding of a polygon is the same section") {
  const Polygon corners{{-0.2, 0.0}, {-0.2, -0.1}, {0.2, -0.1}, {0.2, 0.0}};
  const Polygon reversed(corners.rbegin(), corners.rend());
  CHECK(CrossSection::polygon(corners).area() == CrossSection::polygon(reversed).area());
  CHECK(CrossSection::polygon(corners) == CrossSection::polygon(corners));
}

TEST_CASE("cross-section: slabs and track-grooves may be thicker than wide") {
  CHECK(CrossSection::slab(0.1, 0.15).area() == Approx(0.1 * 0.15));
  CHECK(CrossSection::track_groove(0.6, 0.135, 0.03, 0.32, 0.8).area() > 0.6 * 0.8);
}

TEST_CASE("cross-section: sizes that make no section are refused with their value and bound") {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  CHECK(message_of([] { return CrossSection::u_channel(0.4, 0.25, 0.45); }) ==
        "thickness: 450 mm is no thinner than the width, 400 mm\n"
        "      A plate is thinner than the width that it encloses.\n"
        "      Try: the units of both");
  CHECK_THAT(
      message_of([] { return CrossSection::pipe(0.15, 0.15); }),
      Catch::Matchers::StartsWith("thickness: 150 mm is no thinner than the inner_diameter, 150 mm\n"));
  CHECK_THAT(message_of([] { return CrossSection::slab(0.0, 0.1); }),
             Catch::Matchers::StartsWith("width: 0 mm is not"));
  CHECK_THAT(message_of([] { return CrossSection::slab(0.4, -0.1); }),
             Catch::Matchers::StartsWith("thickness: -100 mm is not a size"));
  CHECK_THAT(message_of([] { return CrossSection::u_channel(0.4, kNan, 0.004); }),
             Catch::Matchers::StartsWith("wall_height: nan m"));
  CHECK_THAT(message_of([] { return CrossSection::slab(0.4, 0.1, 0.1); }),
             Catch::Matchers::StartsWith("curb_height stands alone"));
  CHECK_THAT(message_of([] { return CrossSection::trapezoid(0.4, 0.1, Angle::from_degrees(89.0), 0.01); }),
             Catch::Matchers::StartsWith(
                 "wall_angle: 89 deg is out of range\n"
                 "      The walls of a trapezoid lean outward from upright by 0 deg to 80 deg."));
  CHECK_THAT(message_of([] { return CrossSection::v_channel(Angle::from_degrees(175.0), 0.05, 0.3, 0.006); }),
             Catch::Matchers::StartsWith("angle: 175 deg is out of range\n"
                                         "      The walls of a v-channel open by 20 deg to 170 deg."));
  CHECK_THAT(message_of([] { return CrossSection::v_channel(Angle::from_degrees(90.0), 1.0, 0.25, 0.006); }),
             Catch::Matchers::StartsWith(
                 "wall_height: 250 mm is too small beside the end of the bottom's arc, 292.9 mm"));
  CHECK_THAT(message_of([] { return CrossSection::track_groove(0.6, 0.135, 0.03, 0.1, 0.05); }),
             Catch::Matchers::StartsWith("groove_spacing: 100 mm is too small beside groove_width, 135 mm"));
  CHECK_THAT(message_of([] { return CrossSection::track_groove(0.4, 0.135, 0.03, 0.32, 0.05); }),
             Catch::Matchers::StartsWith("width: 400 mm is too small beside both grooves, 455 mm"));
  CHECK_THAT(message_of([] { return CrossSection::half_pipe(0.4, 0.5); }),
             Catch::Matchers::StartsWith("thickness: 500 mm"));
  CHECK_THAT(message_of([] { return CrossSection::pipe(0.4, std::numeric_limits<double>::infinity()); }),
             Catch::Matchers::StartsWith("thickness: inf"));
}

TEST_CASE("cross-section: sizes whose area would be no number are refused, all others have one") {
  using Catch::Matchers::Contains;
  CHECK_THROWS_WITH(CrossSection::pipe(1e300, 1e200), Contains("inner_diameter: 1e+300 m is out of range") &&
                                                          Contains("1e-100 m and 1e+100 m"));
  CHECK_THROWS_WITH(CrossSection::pipe(1.0, 1e-101), Contains("thickness: 1e-101 m is out of range"));
  CHECK_THROWS_WITH(CrossSection::polygon({{-1e101, 0.0}, {0.0, -1.0}, {1e101, 0.0}}),
                    Contains("is not a point") && Contains("1e+100 m at most"));
  for (const double size : {1e-99, 1.0, 1e99}) {
    const CrossSection pipe = CrossSection::pipe(size, 0.1 * size);
    CHECK(pipe.area() / (size * size) == Approx(0.11 * kPi).epsilon(1e-14));
    CHECK(std::isfinite(pipe.first_moment()));
    CHECK(pipe.first_moment() != 0.0);
  }
}

TEST_CASE("cross-section: a chord tolerance is above zero") {
  using Catch::Matchers::Contains;
  for (const CrossSection& section : {CrossSection::pipe(0.1, 0.01), CrossSection::slab(0.4, 0.1)}) {
    for (const double tolerance : {0.0, -1.0, std::nan("")}) {
      CHECK_THROWS_WITH(section.outline(tolerance),
                        Contains("chord_tolerance: ") && Contains(" m is not above zero"));
      CHECK_THROWS_AS(section.vertex_count(tolerance), InputError);
      CHECK_THROWS_AS(section.chord_error(tolerance), InputError);
    }
    CHECK_NOTHROW(section.outline(std::numeric_limits<double>::infinity()));
  }
  CHECK_THROWS_AS(CrossSection::pipe(0.1, 0.01).bore(0.0), InputError);
}

TEST_CASE("cross-section: outlines that are not simple are refused, naming the sides") {
  CHECK_THAT(message_of([] {
               return CrossSection::polygon({{0, 0}, {1, 0}});
             }),
             Catch::Matchers::StartsWith("outline: 2 vertices"));
  CHECK_THAT(message_of([] {
               return CrossSection::polygon({{-1, 0}, {-1, -1}, {1, 0}, {1, -1}});
             }),
             Catch::Matchers::StartsWith("outline: side 2 and side 4 cross"));
  CHECK_THAT(message_of([] {
               return CrossSection::polygon({{-1, 0}, {-1, -1}, {1, -1}, {1, -1}, {1, 0}});
             }),
             Catch::Matchers::StartsWith("outline: side 3 has no length"));
  CHECK_THAT(message_of([] {
               return CrossSection::polygon({{-1, 0}, {-1, -1}, {1, -1}, {1, 0}, {2, 0}, {0.5, 0}});
             }),
             contains_text("runs back along"));
  CHECK_THAT(message_of([] {
               return CrossSection::polygon({{-1, 1}, {-1, 0.5}, {1, 0.5}, {1, 1}});
             }),
             Catch::Matchers::StartsWith("outline: (0, 0) does not lie on it"));
  CHECK_THAT(message_of([] {
               return CrossSection::polygon({{-1, 1}, {-1, 0}, {1, 0}, {1, 1}});
             }),
             Catch::Matchers::StartsWith("outline: the side at (0, 0) does not face up"));
}
