#include "glissade/core/error.hpp"
#include "glissade/io/dxf_file.hpp"

#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/temp_dir.hpp"
#include "support/workshop_shapes.hpp"

#include <cmath>
#include <limits>
#include <string>

namespace dxf_test {

namespace {

using namespace glissade;

Drawing plate(int arcs, int holes) {
  Drawing drawing;
  drawing.name = "plate";
  const std::size_t cut = drawing.layer({"CUT", LineStyle::continuous, 0.25, 7});
  const std::size_t mark = drawing.layer({"MARK", LineStyle::continuous, 0.18, 5});
  const std::size_t bend = drawing.layer({"BEND_UP", LineStyle::dashed, 0.18, 3});
  const PlaneRegion region = testing::band(arcs, 3000.0, 250.0, holes);
  drawing.add(cut, region);
  for (const ArcPath& stroke : stroked_text("07", {40.0, -400.0}, 20.0)) drawing.add(mark, stroke);
  drawing.line(bend, {0.0, 0.0}, {100.0, 0.0});
  return drawing;
}

std::string message_of(const std::filesystem::path& file) {
  try {
    (void)read_dxf(file);
  } catch (const FileError& error) {
    return error.what();
  }
  return "read";
}

}  // namespace

TEST_CASE("DXF read back is the drawing, to the last digit; the same drawing has the same bytes") {
  const TempDir directory;
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (int round = 0; round < 20; ++round) {
    Drawing drawing = plate(random.integer(1, 30), random.integer(1, 15));
    const PlaneMotion motion = PlaneMotion::turn(random.between(-3.0, 3.0), {random.between(-1e4, 1e4), 3.0});
    for (DrawnPath& drawn : drawing.paths) drawn.path = moved(drawn.path, motion);
    for (DrawnCircle& drawn : drawing.circles) drawn.circle.centre = motion(drawn.circle.centre);
    const auto file = directory / "plate.dxf";
    write_dxf(file, drawing);
    require_same_dxf(file, drawing);
    const Drawing found = read_dxf(file);
    REQUIRE(found.paths.size() == drawing.paths.size());
    for (std::size_t i = 0; i < found.paths.size(); ++i) CHECK(found.paths[i].path == drawing.paths[i].path);
    CHECK(bytes_of(file) == dxf_text(drawing));
    write_dxf(file, drawing, {DxfVersion::r12});
    require_same_dxf(file, drawing, {DxfVersion::r12});
  }
}

TEST_CASE("numbers of DXF have no exponent, however small or large") {
  const TempDir directory;
  Drawing drawing = plate(2, 1);
  drawing.line(0, {7.5254e-9, -5e-324}, {1e22, 1.7976931348623157e308});
  const auto file = directory / "tiny.dxf";
  write_dxf(file, drawing);
  require_same_dxf(file, drawing);
  const std::string text = bytes_of(file);
  CHECK(text.find("\n0.0000000075254\n") != std::string::npos);
  CHECK(text.find("e-") == std::string::npos);
  CHECK(text.find("e+") == std::string::npos);
}

TEST_CASE("a DXF file that is not the drawing is found out") {
  const TempDir directory;
  const auto file = directory / "plate.dxf";
  Drawing drawing = plate(5, 3);
  write_dxf(file, drawing);
  drawing.circles[1].circle.radius *= 1.0 + 1e-12;
  CHECK_THROWS_AS(require_same_dxf(file, drawing), InternalError);
  drawing = plate(5, 3);
  drawing.paths[0].path.vertices[2].bulge += 1e-12;
  CHECK_THROWS_AS(require_same_dxf(file, drawing), InternalError);
  drawing = plate(5, 3);
  write_dxf(file, drawing, {DxfVersion::r12});
  drawing.paths[0].path.vertices[2].at.x += 1e-4;
  CHECK_THROWS_AS(require_same_dxf(file, drawing, {DxfVersion::r12}), InternalError);
}

TEST_CASE("a side plate of 30 arcs with 15 holes and its number takes at most 10 kB") {
  CHECK(dxf_text(plate(15, 15)).size() <= 10'000);
}

TEST_CASE("what a part file says: millimetres, closed polylines with bulges, circles, no text") {
  const std::string text = dxf_text(plate(8, 4));
  CHECK(text.find("9\n$ACADVER\n1\nAC1015\n") != std::string::npos);
  CHECK(text.find("9\n$INSUNITS\n70\n4\n") != std::string::npos);
  CHECK(text.find("\nTEXT\n") == std::string::npos);
  CHECK(text.find("\nSPLINE\n") == std::string::npos);
  CHECK(text.find("\nDASHED\n") != std::string::npos);
  const std::string old = dxf_text(plate(8, 4), {DxfVersion::r12});
  CHECK(old.find("AC1009") != std::string::npos);
  CHECK(old.find("POLYLINE") == std::string::npos);
  CHECK(old.find("\nARC\n") != std::string::npos);
}

TEST_CASE("texts and dimensions of a drawing come back, letters beyond ASCII too") {
  const TempDir directory;
  Drawing drawing = plate(3, 1);
  drawing.text_scale = 20.0;
  drawing.texts.push_back(
      {0, {1.0, 2.0}, 2.5, "Länge Ø 12 °\nß", TextAnchor::centre, Angle::from_radians(0.5)});
  drawing.dimensions.push_back({0, {0.0, 0.0}, {100.0, 50.0}, 8.0, DimensionKind::level, ""});
  const auto file = directory / "drawing.dxf";
  write_dxf(file, drawing);
  require_same_dxf(file, drawing);
  const Drawing found = read_dxf(file);
  REQUIRE(found.texts.size() == 2);
  CHECK(found.texts[0].text == "Länge Ø 12 ° ß");
  CHECK(found.texts[0].height_mm == 50.0);
  CHECK(found.texts[1].text == "100");
  const std::string bytes = bytes_of(file);
  CHECK(std::all_of(bytes.begin(), bytes.end(), [](char c) { return c == '\n' || (c >= ' ' && c < 0x7F); }));
}

TEST_CASE("drawings that DXF cannot hold are refused") {
  Drawing drawing = plate(3, 1);
  drawing.paths[0].path.vertices[0].at.x = std::numeric_limits<double>::infinity();
  CHECK_THROWS_WITH(dxf_text(drawing), "drawing plate: a number of a path is not finite");
  drawing = plate(3, 1);
  drawing.circles[0].layer = 9;
  CHECK_THROWS_AS(dxf_text(drawing), InputError);
  drawing = plate(3, 1);
  drawing.layers[1].name = "CUT";
  CHECK_THROWS_AS(dxf_text(drawing), InputError);
  drawing.layers[1].name = "a\nb";
  CHECK_THROWS_AS(dxf_text(drawing), InputError);
}

TEST_CASE("a DXF file that is cut off or broken anywhere is an error with its line, never more") {
  const TempDir directory;
  const auto file = directory / "broken.dxf";
  const std::string good = dxf_text(plate(2, 1));
  for (std::size_t size = 0; size + 4 < good.size(); size += 37) {
    put_bytes(file, good.substr(0, size));
    CHECK(message_of(file).find("broken.dxf:") != std::string::npos);
  }
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (int round = 0; round < 200; ++round) {
    std::string bad = good;
    for (int i = 0; i < 3; ++i) {
      bad[static_cast<std::size_t>(random.integer(0, static_cast<int>(bad.size()) - 1))] =
          static_cast<char>(random.integer(0, 255));
    }
    put_bytes(file, bad);
    CHECK_NOTHROW(message_of(file));
  }
  std::string inches = good;
  inches.replace(inches.find("$INSUNITS\n70\n4"), 14, "$INSUNITS\n70\n1");
  put_bytes(file, inches);
  CHECK(message_of(file).find("$INSUNITS is 1") != std::string::npos);
  CHECK(message_of(directory / "none.dxf") != "read");
}

}  // namespace dxf_test
