#include "glissade/core/number_text.hpp"
#include "glissade/io/dxf_file.hpp"
#include "glissade/io/sheet_file.hpp"
#include "glissade/pipeline/profile_drawing.hpp"

#include "drawing/extents.hpp"
#include "drawing/ink.hpp"
#include "support/catch.hpp"
#include "support/paths.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

namespace profile_sizes_test {

using namespace glissade;
using Catch::Matchers::Contains;

namespace {

/// From a bead to a valley: a track so long, with a channel of its size.
Design design_of(double size, const std::string& kind, double over_run = 0.6) {
  const auto metres = [](double value) { return exact_text(value) + " m"; };
  return parse_design("glissade: 1\nname: size\ntrack:\n  start: {x: 0 m, z: " + metres(over_run * size) +
                          "}\n  finish: {x: " + metres(size) +
                          ", z: 0 m}\nbody: {friction_angle: 5 deg}\ncenterline: {kind: " + kind +
                          "}\ncross_section: {kind: u-channel, width: " + metres(0.08 * size) +
                          ", wall_height: " + metres(0.04 * size) + ", thickness: " + metres(0.004 * size) +
                          "}\nmesh: {tolerance: " + metres(1e-3 * size) + "}\n",
                      "size.yaml");
}

constexpr double kSizes[] = {0.003, 0.02, 0.2, 0.9, 5.4, 49.0, 100.0, 500.0, 1500.0, 5200.0, 1e4, 1e5};

ProfileOptions hundredths(double size) {
  ProfileOptions options;
  options.step = 0.01 * size;
  return options;
}

bool holds(const PlaneBox& outer, const PlaneBox& inner) {
  const double leeway = 1e-9 * (1.0 + outer.width() + outer.height());
  return inner.low.x >= outer.low.x - leeway && inner.low.y >= outer.low.y - leeway &&
         inner.high.x <= outer.high.x + leeway && inner.high.y <= outer.high.y + leeway;
}

/// $EXTMIN and $EXTMAX of a DXF.
PlaneBox stated_extents(const std::string& dxf) {
  const auto point = [&](const std::string& name) {
    std::istringstream lines(dxf.substr(dxf.find(name)));
    std::string word;
    Vec2 at;
    lines >> word >> word >> at.x >> word >> at.y;
    return at;
  };
  return {point("$EXTMIN"), point("$EXTMAX")};
}

/// How far a text's place is from the nearest end of the track, both in one unit.
double away(const DrawnText& text, const std::vector<Vec2>& ends) {
  double nearest = 1e300;
  for (const Vec2& end : ends) nearest = std::min(nearest, norm(text.at - end));
  return nearest;
}

}  // namespace

TEST_CASE(
    "a section of any size has its marks and letters in proportion, and all of them within its extents") {
  for (const double size : kSizes) {
    for (const char* const kind : {"straight", "fastest"}) {
      INFO(size << " m, " << kind);
      const Design design = design_of(size, kind);
      const Track track = solve(design);
      const Drawing drawing = longitudinal_section(design, track, hundredths(size));
      const double millimetres = 1e3 * size;
      REQUIRE(drawing.circles.size() == 2);
      for (const DrawnCircle& circle : drawing.circles) CHECK(circle.circle.radius <= 0.004 * millimetres);
      const std::vector<Vec2> ends = {drawing.circles[0].circle.centre, drawing.circles[1].circle.centre};
      REQUIRE(drawing.texts.size() == 2);
      for (const DrawnText& text : drawing.texts) {
        CHECK(away(text, ends) <= 0.06 * millimetres);
        const double height = text.height_mm * drawing.text_scale;
        CHECK(height <= 0.03 * millimetres);
        CHECK(height >= 0.006 * millimetres);
      }
      for (const DrawnDimension& dimension : drawing.dimensions)
        CHECK(std::fabs(dimension.offset_mm) * drawing.text_scale <= 0.12 * millimetres);
      const PlaneBox stated = stated_extents(dxf_text(drawing));
      const Drawing flat = without_dimensions(drawing);
      CHECK(holds(stated, bounds(flat).value()));
      for (const DrawnText& text : flat.texts) {
        const double height = text.height_mm * drawing.text_scale;
        for (const ArcPath& stroke : stroked_text(text.text, text.at, height, text.angle, text.anchor))
          CHECK(holds(stated, bounds(stroke)));
      }
      const Drawing across = cross_section_drawing(design).value();
      const PlaneBox box = bounds(across).value();
      CHECK(box.width() <= 1.3 * 88.0 * size);
      for (const DrawnDimension& one : across.dimensions) {
        const double length =
            one.kind == DimensionKind::level ? one.to.x - one.from.x : one.to.y - one.from.y;
        const double told = std::stod(lines_of(one, 1.0).text.text);
        CHECK(std::fabs(told - std::fabs(length)) <= std::max(0.05, 0.0025 * 88.0 * size) + 1e-9);
        CHECK(told > 0.0);
        if (size < 0.2) CHECK(std::fabs(told / std::fabs(length) - 1.0) < 0.06);
      }
      CHECK(holds(stated_extents(dxf_text(across)), bounds(without_dimensions(across)).value()));
    }
  }
}

TEST_CASE("a section of any size fills its sheet and lies within the frame, its letters beside its ends") {
  for (const double size : kSizes) {
    for (const double over_run : {0.2, 0.6, 3.0}) {
      INFO(size << " m, drop " << over_run);
      const Design design = design_of(size, "straight", over_run);
      const Track track = solve(design);
      const std::vector<Sheet> sheets = profile_sheets(design, track, hundredths(size));
      REQUIRE(sheets.size() >= 3);
      for (std::size_t i = 0; i < 2; ++i) {
        const PlaneBox frame = drawing_area(sheets[i]);
        const drawing::Ink view = drawing::ink_of(sheets[i]).front();
        CHECK_FALSE(view.clip.has_value());
        CHECK(holds(frame, drawing::extents(view.drawing).value()));
        const PlaneBox lines = bounds(sheets[i].views.front().drawing).value();
        const double share = sheets[i].views.front().scale *
                             std::max(lines.width() / frame.width(), lines.height() / frame.height());
        CHECK(share > 0.15);
      }
      const drawing::Ink section = drawing::ink_of(sheets.front()).front();
      std::vector<Vec2> ends;
      for (const DrawnCircle& circle : section.drawing.circles) {
        ends.push_back(circle.circle.centre);
        CHECK(circle.circle.radius < 1.5);
      }
      for (const DrawnText& text : section.drawing.texts) {
        if (text.text == "start" || text.text == "finish") CHECK(away(text, ends) < 20.0);
      }
      CHECK_NOTHROW(pdf_text({sheets.front()}, "size"));
    }
  }
}

namespace {

/// All lines of the coordinate table, over however many sheets it takes.
SheetTable coordinates_of(const Design& design, const Track& track, const ProfileOptions& options) {
  SheetTable whole;
  for (const Sheet& sheet : profile_sheets(design, track, options)) {
    for (const SheetTable& table : sheet.tables) {
      if (!table.caption.starts_with("Coordinates")) continue;
      whole.header = table.header;
      whole.rows.insert(whole.rows.end(), table.rows.begin(), table.rows.end());
    }
  }
  return whole;
}

}  // namespace

TEST_CASE(
    "coordinates on sheets have the decimals of their unit, no rounding noise, and straights no radius") {
  for (const double size : kSizes) {
    for (const double far : {0.0, 5432100.55}) {
      INFO(size << " m, at " << far);
      Design design = design_of(size, "straight");
      design.track.start.x += far;
      design.track.finish.x += far;
      const Track track = solve(design);
      const SheetTable table = coordinates_of(design, track, hundredths(size));
      const auto stations = coordinate_table(design, track, hundredths(size));
      REQUIRE(table.rows.size() == stations.size());
      const std::string unit = size < 1.0 ? "[mm]" : "[m]";
      CHECK(table.header[1] == "s " + unit);
      CHECK(table.header[7] == "radius " + unit);
      const double per_metre = size < 1.0 ? 1e3 : 1.0;
      for (std::size_t i = 0; i < stations.size(); ++i) {
        for (std::size_t column = 1; column <= 6; ++column) {
          const std::string& text = table.rows[i][column];
          INFO(column << " " << text);
          REQUIRE(text.find('.') == text.size() - 5);
          CHECK(text.find('e') == std::string::npos);
          CHECK_FALSE(text == "-0.0000");
        }
        CHECK(table.rows[i][7] == "straight");
        const double told = std::stod(table.rows[i][3]);
        CHECK(std::fabs(told - per_metre * stations[i].position.x) <= 0.51e-4);
      }
    }
  }
}

TEST_CASE("a curved track has radii on its sheets, to six digits") {
  const Design design = design_of(5.4, "fastest");
  const Track track = solve(design);
  const SheetTable table = coordinates_of(design, track, hundredths(5.4));
  const auto stations = coordinate_table(design, track, hundredths(5.4));
  REQUIRE(table.rows.size() == stations.size());
  for (std::size_t i = 1; i < stations.size(); ++i)
    CHECK(std::stod(table.rows[i][7]) == Approx(1.0 / stations[i].curvature).epsilon(1e-5));
}

TEST_CASE(
    "without a step in-runs have a station every metre, and shorter and longer tracks as many as one reads") {
  for (const double size : kSizes) {
    INFO(size << " m");
    const Design design = design_of(size, "straight");
    const Track track = solve(design);
    const double length = track.centerline->length();
    const std::vector<ProfileStation> stations = coordinate_table(design, track);
    const double step = stations[1].arc_length - stations[0].arc_length;
    if (length >= 20.0 && length <= 2000.0) {
      CHECK(step == Approx(1.0).epsilon(1e-12));
    } else {
      CHECK(stations.size() >= 50);
      CHECK(stations.size() <= 260);
    }
  }
}

TEST_CASE("a step that makes too many stations is refused with one that does not") {
  for (const double size : kSizes) {
    const Design design = design_of(size, "straight");
    const Track track = solve(design);
    for (const double step : {0.0, -1.0, 1e-7 * size}) {
      INFO(size << " m, step " << step);
      ProfileOptions options;
      options.step = step;
      std::string advised;
      try {
        static_cast<void>(coordinate_table(design, track, options));
      } catch (const InputError& error) {
        const std::string text = error.what();
        CHECK_THAT(text, Contains("--step: a step of ") && Contains("at most 100 000 stations"));
        advised = text.substr(text.find("Try: ") + 5);
      }
      REQUIRE_FALSE(advised.empty());
      std::istringstream words(advised);
      std::string unit;
      double value = 0.0;
      words >> value >> unit;
      options.step = value * (unit == "mm" ? 1e-3 : unit == "km" ? 1e3 : 1.0);
      const std::size_t stations = coordinate_table(design, track, options).size();
      CHECK(stations >= 50);
      CHECK(stations <= 260);
    }
  }
}

TEST_CASE("what stands on the sheets of the shipped hills keeps its place and size") {
  for (const char* const file :
       {"hills/rasnov_hs38.yaml", "hills/garmisch_hs142.yaml", "hills/vikersund_hs240.yaml"}) {
    INFO(file);
    const Design design = read_design(designs_path(file));
    const Track track = solve(design);
    const Drawing drawing = longitudinal_section(design, track);
    CHECK(drawing.text_scale == 250.0);
    for (const DrawnCircle& circle : drawing.circles) CHECK(circle.circle.radius == 150.0);
  }
}

}  // namespace profile_sizes_test
