#include "glissade/drawing/drawing.hpp"

#include "support/catch.hpp"

#include <cmath>
#include <string>

using namespace glissade;

namespace {

PlaneBox box_of(const std::vector<ArcPath>& paths) {
  Drawing drawing;
  const std::size_t layer = drawing.layer({"0", LineStyle::continuous, 0.25, 7});
  for (const ArcPath& path : paths) drawing.add(layer, path);
  return bounds(drawing).value();
}

}  // namespace

TEST_CASE("stroked text is as high as asked for and as wide as it says, at its anchor") {
  const std::string text = "HEIGHT 17";
  const PlaneBox left = box_of(stroked_text(text, {3.0, 4.0}, 7.0));
  CHECK(left.low.x == Approx(3.0));
  CHECK(left.low.y == Approx(4.0));
  CHECK(left.height() == Approx(7.0));
  CHECK(left.low.x + stroked_width(text, 7.0) >= left.high.x);
  CHECK(left.width() == Approx(stroked_width(text, 7.0)).epsilon(0.02));
  const PlaneBox right = box_of(stroked_text(text, {3.0, 4.0}, 7.0, {}, TextAnchor::right));
  CHECK(right.low.x == Approx(3.0 - stroked_width(text, 7.0)));
  const PlaneBox upright = box_of(stroked_text(text, {3.0, 4.0}, 7.0, Angle::from_degrees(90.0)));
  CHECK(upright.width() == Approx(7.0));
  CHECK(upright.height() == Approx(left.width()));
}

TEST_CASE("every letter has strokes of its own; what has none is a box") {
  const std::string box = "\xE2\x98\x83";  // a snowman
  const auto strokes = stroked_text(box, {}, 10.0);
  REQUIRE(strokes.size() == 1);
  CHECK(strokes[0].vertices.size() == 5);
  std::vector<std::vector<ArcPath>> seen;
  for (char letter = '!'; letter <= '~'; ++letter) {
    const auto drawn = stroked_text(std::string(1, letter), {}, 10.0);
    CHECK(drawn != strokes);
    CHECK_FALSE(drawn.empty());
    for (const auto& other : seen) CHECK(drawn != other);
    seen.push_back(drawn);
  }
  for (const char* letter : {"ä", "Ö", "ß", "é", "ç", "°", "Ø", "×", "–"})
    CHECK(stroked_text(letter, {}, 10.0) != strokes);
  // Broken UTF-8 is a box a byte, not a crash.
  CHECK(stroked_text("\xFF\xC3", {}, 10.0).size() == 2);
  CHECK(stroked_text("", {}, 10.0).empty());
  CHECK(stroked_width("", 10.0) == 0.0);
}

TEST_CASE("a dimension says the distance it measures, and its line keeps its offset on paper") {
  DrawnDimension dimension{0, {100.0, 50.0}, {400.0, 450.0}, 8.0, DimensionKind::aligned, ""};
  CHECK(lines_of(dimension, 0.1).text.text == "500");
  dimension.kind = DimensionKind::level;
  CHECK(lines_of(dimension, 0.1).text.text == "300");
  dimension.kind = DimensionKind::upright;
  CHECK(lines_of(dimension, 0.1).text.text == "400");
  dimension.text = "H";
  CHECK(lines_of(dimension, 0.1).text.text == "H");
  dimension = {0, {0.0, 0.0}, {300.0, 0.0}, -8.0, DimensionKind::level, ""};
  const DimensionLines lines = lines_of(dimension, 0.1);
  REQUIRE(lines.arrows.size() == 2);
  CHECK(lines.arrows[0].vertices[0].at == Vec2{0.0, -80.0});
  CHECK(lines.arrows[1].vertices[0].at == Vec2{300.0, -80.0});
  CHECK(lines.text.at.y == Approx(-72.0));
  // Upright texts are read from the right, whichever way they were measured.
  const double quarter = std::acos(0.0);
  CHECK(lines_of({0, {0.0, 0.0}, {0.0, 90.0}, 8.0, DimensionKind::aligned, ""}, 1.0).text.angle.radians() ==
        Approx(quarter));
  CHECK(lines_of({0, {0.0, 90.0}, {0.0, 0.0}, 8.0, DimensionKind::aligned, ""}, 1.0).text.angle.radians() ==
        Approx(quarter));
  CHECK(lines_of({0, {90.0, 0.0}, {0.0, 0.0}, 8.0, DimensionKind::aligned, ""}, 1.0).text.angle.radians() ==
        Approx(0.0).margin(1e-12));
}

TEST_CASE(
    "the number of a short dimension stands beyond its end, on its line, clear of the lines to what it "
    "measures") {
  for (double length = 1.0; length < 30.0; length += 0.7) {
    const DimensionLines drawn =
        lines_of({0, {0.0, 0.0}, {length, 0.0}, -8.0, DimensionKind::level, ""}, 1.0);
    const double half = 0.5 * stroked_width(drawn.text.text, drawn.text.height_mm);
    const double left = drawn.text.at.x - half;
    const double right = drawn.text.at.x + half;
    INFO(length << " mm: " << left << " to " << right);
    CHECK((left > length || (left > 0.0 && right < length)));
    const PathVertex& line_end = drawn.lines.back().vertices.back();
    CHECK(right <= line_end.at.x + 1e-9);
  }
}

TEST_CASE("layers are found by their names, and a drawing without figures has no bounds") {
  Drawing drawing;
  const std::size_t first = drawing.layer({"CUT", LineStyle::continuous, 0.25, 7});
  CHECK(drawing.layer({"MARK", LineStyle::dashed, 0.25, 5}) == first + 1);
  CHECK(drawing.layer({"CUT", LineStyle::dashed, 0.5, 1}) == first);
  CHECK(drawing.layers.size() == 2);
  CHECK_FALSE(bounds(drawing).has_value());
  drawing.add(first, Circle{{1.0, 2.0}, 3.0});
  CHECK(bounds(drawing)->low == Vec2{-2.0, -1.0});
}
