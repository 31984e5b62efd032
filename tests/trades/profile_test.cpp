#include "glissade/core/error.hpp"
#include "glissade/design/write.hpp"
#include "glissade/io/dxf_file.hpp"
#include "glissade/io/sheet_file.hpp"
#include "glissade/pipeline/profile_drawing.hpp"
#include "glissade/section/cross_section.hpp"

#include "support/catch.hpp"
#include "support/paths.hpp"
#include "support/temp_dir.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace profile_test {

using namespace glissade;
using Catch::Matchers::Contains;

namespace {

Design garmisch() {
  return read_design(designs_path("hills/garmisch_hs142.yaml"));
}

}  // namespace

TEST_CASE("a coordinate table has every step and every letter, from the start to the edge") {
  const Design design = garmisch();
  const Track track = solve(design);
  const std::vector<ProfileStation> stations = coordinate_table(design, track);
  REQUIRE(stations.size() == 103 + 2);  // 0 to 102 m with A, B at 24 m and E2 at 96 m; E1 and T
  std::string letters;
  for (const ProfileStation& station : stations) letters += station.name;
  CHECK(letters == "ABE1E2T");
  CHECK(std::is_sorted(stations.begin(), stations.end(),
                       [](const auto& a, const auto& b) { return a.arc_length < b.arc_length; }));
  CHECK(stations.back().to_edge == 0.0);
  CHECK(std::fabs(stations.back().position.x) < 1e-12);
  CHECK(std::fabs(stations.back().position.z) < 1e-12);
}

TEST_CASE("stations of round metres of x have round metres of x") {
  const Design design = garmisch();
  const Track track = solve(design);
  ProfileOptions options;
  options.step = 0.5;
  options.row = CountedFrom::run;
  int round = 0;
  for (const ProfileStation& station : coordinate_table(design, track, options)) {
    if (!station.name.empty()) continue;
    const double halves = station.position.x * 2.0;
    CHECK(std::fabs(halves - std::round(halves)) < 1e-9);
    ++round;
  }
  CHECK(round >= 180);
}

TEST_CASE("parallel lines lie square to the track at their distance") {
  const Design design = garmisch();
  const Track track = solve(design);
  ProfileOptions options;
  options.parallels = {{"tube", 0.12}, {"beam", -0.35}};
  for (const ProfileStation& station : coordinate_table(design, track, options)) {
    for (std::size_t i = 0; i < 2; ++i) {
      const Vec3 away = station.parallels[i] - station.position;
      const double along =
          away.x * std::cos(station.slope_angle.radians()) - away.z * std::sin(station.slope_angle.radians());
      const double up =
          away.x * std::sin(station.slope_angle.radians()) + away.z * std::cos(station.slope_angle.radians());
      CHECK(std::fabs(along) < 1e-12);
      CHECK(std::fabs(up - options.parallels[i].height) < 1e-12);
    }
  }
}

TEST_CASE("a parallel line beyond the centre of curvature and a step of nothing are refused") {
  const Design design = garmisch();
  const Track track = solve(design);
  ProfileOptions high;
  high.parallels = {{"sky", 120.0}};
  CHECK_THROWS_WITH(coordinate_table(design, track, high),
                    Contains("sky: 120 m turns back on itself") && Contains("centre of curvature"));
  ProfileOptions none;
  none.step = 0.0;
  CHECK_THROWS_WITH(coordinate_table(design, track, none), Contains("a step of 0"));
}

TEST_CASE(
    "the section is drawn at 1:1 with its letters, gates and measures, and read back as it was written") {
  const Design design = garmisch();
  const Track track = solve(design);
  ProfileOptions options;
  options.parallels = {{"beam", -0.35}};
  const Drawing drawing = longitudinal_section(design, track, options);
  const auto box = bounds(drawing);
  REQUIRE(box.has_value());
  const Endpoints end = track.centerline->endpoints();
  CHECK(box->width() > 1e3 * end.run);
  CHECK(box->width() < 1e3 * end.run + 3e3);
  const auto has = [&](const std::string& text) {
    return std::any_of(drawing.texts.begin(), drawing.texts.end(),
                       [&](const DrawnText& one) { return one.text == text; });
  };
  for (const char* const letter : {"A", "B", "E1", "E2", "T", "1", "45", "49"}) {
    INFO(letter);
    CHECK(has(letter));
  }
  CHECK(drawing.dimensions.size() == 4);
  const TempDir folder;
  write_dxf(folder / "s.dxf", drawing);
  CHECK_NOTHROW(require_same_dxf(folder / "s.dxf", drawing));
}

TEST_CASE("the sheets hold the section, the certificate in three languages, gates and coordinates") {
  const Design design = garmisch();
  const Track track = solve(design);
  const std::vector<Sheet> sheets = profile_sheets(design, track);
  REQUIRE(sheets.size() >= 4);
  CHECK(sheets.front().views.size() == 1);
  std::string words;
  std::size_t rows = 0;
  for (const Sheet& sheet : sheets) {
    for (const SheetTable& table : sheet.tables) {
      rows += table.rows.size();
      for (const auto& row : table.rows) {
        for (const std::string& cell : row) words += cell + "|";
      }
    }
  }
  CHECK_THAT(words, Contains("|slope of the straight|Neigung der Geraden|pente de la partie droite|35 deg|"));
  CHECK_THAT(words, Contains("radius at the end of the transition") && Contains("103 m"));
  CHECK(rows >= 106 + 49 + 10);
  const std::string pdf = pdf_text(sheets, "Garmisch");
  CHECK(pdf.starts_with("%PDF"));
}

TEST_CASE("sheets of a hill that is turned in plan tell y of gates, stations and parallel lines") {
  const auto headings_at = [](double azimuth) {
    Design design = garmisch();
    std::string text = design_text(design);
    const std::string key = "track:\n";
    text.insert(text.find(key) + key.size(), "  azimuth: " + std::to_string(azimuth) + " deg\n");
    design = parse_design(text, "turned.yaml");
    ProfileOptions options;
    options.parallels = {{"beam", -0.35}};
    std::string words;
    for (const Sheet& sheet : profile_sheets(design, solve(design), options)) {
      for (const SheetTable& table : sheet.tables) {
        CHECK(table.header.size() == table.widths_mm.size());
        for (const auto& row : table.rows) CHECK(row.size() == table.header.size());
        for (const std::string& head : table.header) words += head + "|";
      }
    }
    return words;
  };
  const std::string turned = headings_at(30.0);
  CHECK_THAT(turned, Contains("gate|to edge [m]|x [m]|y [m]|z [m]|") && Contains("beam x, y, z [m]|"));
  const std::string plain = headings_at(0.0);
  CHECK_THAT(plain, Contains("gate|to edge [m]|x [m]|z [m]|") && Contains("beam x, z [m]|"));
}

TEST_CASE("the cross-section is drawn as it is swept: its area, its grooves and their measures") {
  for (const char* const file : {"hills/garmisch_hs142.yaml", "grain_chute.yaml", "toboggan_run.yaml"}) {
    INFO(file);
    const Design design = read_design(designs_path(file));
    const std::optional<Drawing> drawing = cross_section_drawing(design);
    REQUIRE(drawing.has_value());
    const CrossSection section = CrossSection(*design.cross_section).at(0.0);
    double area = 0.0;
    for (const DrawnPath& path : drawing->paths) {
      if (path.path.closed) area += signed_area(path.path);
    }
    // Mirrored: what runs counter-clockwise in the section runs clockwise on paper.
    CHECK(std::fabs(-area * 1e-6 / section.area() - 1.0) < 1e-9);
    const TempDir folder;
    write_dxf(folder / "c.dxf", *drawing);
    CHECK_NOTHROW(require_same_dxf(folder / "c.dxf", *drawing));
  }
  const std::optional<Drawing> track = cross_section_drawing(garmisch());
  const auto measured = [&](double millimetres) {
    return std::count_if(track->dimensions.begin(), track->dimensions.end(), [&](const DrawnDimension& one) {
      const Vec2 way = one.to - one.from;
      const double length = one.kind == DimensionKind::level ? std::fabs(way.x) : std::fabs(way.y);
      return std::fabs(length - millimetres) < 1e-9;
    });
  };
  CHECK(measured(2800.0) == 1);
  CHECK(measured(320.0) == 1);
  CHECK(measured(135.0) == 2);
  CHECK(measured(30.0) == 1);
  Design bare = garmisch();
  bare.cross_section.reset();
  CHECK_FALSE(cross_section_drawing(bare).has_value());
}

TEST_CASE("the files of a profile appear together, or none does") {
  const Design design = garmisch();
  const Track track = solve(design);
  const TempDir folder;
  const auto files = write_profile(folder / "out", design, track);
  REQUIRE(files.size() == 4);
  for (const auto& file : files) CHECK(std::filesystem::exists(file));
  const TempDir other;
  // A directory where the coordinates should be.
  std::filesystem::create_directories(other / "garmisch_hs142.coordinates.csv");
  CHECK_THROWS_AS(write_profile(other.path(), design, track), FileError);
  CHECK_FALSE(std::filesystem::exists(other / "garmisch_hs142.section.dxf"));
  CHECK_FALSE(std::filesystem::exists(other / "garmisch_hs142.section.pdf"));
}

}  // namespace profile_test
