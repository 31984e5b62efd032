#include "glissade/drawing/sheet.hpp"

#include "glissade/io/sheet_file.hpp"

#include "drawing/ink.hpp"
#include "support/catch.hpp"
#include "support/oracle.hpp"
#include "support/program.hpp"
#include "support/temp_dir.hpp"
#include "support/workshop_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

using namespace glissade;

namespace {

Drawing plate() {
  Drawing drawing;
  drawing.name = "plate";
  drawing.add(drawing.layer({"CUT", LineStyle::continuous, 0.5, 7}), testing::band(7, 3000.0, 250.0, 7));
  const PlaneBox box = bounds(drawing).value();
  const std::size_t thin = drawing.layer({"DIM", LineStyle::continuous, 0.25, 7});
  drawing.dimensions.push_back({thin, box.low, {box.high.x, box.low.y}, -10.0, DimensionKind::level, ""});
  return drawing;
}

TitleBlock title() {
  return {"Seitenwand links", "Grain chute", "03", "S235, 4 mm", "", "ISO 2768-m", ""};
}

Sheet part_sheet() {
  Sheet sheet = blank_sheet(PaperSize::a3);
  sheet.title = title();
  sheet.views.push_back(fitted_view(plate(), drawing_area(sheet), "Flat pattern"));
  return sheet;
}

std::vector<std::vector<std::string>> rows(int count) {
  std::vector<std::vector<std::string>> made;
  for (int i = 0; i < count; ++i) made.push_back({std::to_string(i), "row " + std::to_string(i)});
  return made;
}

}  // namespace

TEST_CASE("a view takes the largest scale of ISO 5455 that fits its room, in its middle") {
  Drawing drawing;
  drawing.add(drawing.layer({"CUT", LineStyle::continuous, 0.5, 7}),
              rectangle({100.0, 100.0}, {2100.0, 600.0}));
  const PlaneBox room{{20.0, 50.0}, {280.0, 200.0}};
  const SheetView view = fitted_view(drawing, room);
  CHECK(view.scale == 0.1);
  CHECK(scale_text(view.scale) == "1:10");
  CHECK(view.at == Vec2{150.0, 125.0});
  CHECK(view.anchor == Vec2{1100.0, 350.0});
  CHECK(fitted_view(drawing, {{0.0, 0.0}, {2000.0, 500.0}}).scale == 1.0);
  CHECK(fitted_view(drawing, {{0.0, 0.0}, {1999.0, 500.0}}).scale == 0.5);
  CHECK(scale_text(5.0) == "5:1");
}

TEST_CASE("a long table goes over as many sheets as it takes, each row once") {
  const std::vector<Sheet> sheets = numbered(
      table_sheets(title(), PaperSize::a4, {{}, "Parts", {20.0, 60.0}, {"no.", "name"}, rows(150), 2.5}));
  REQUIRE(sheets.size() >= 3);
  int next = 0;
  for (const Sheet& sheet : sheets) {
    REQUIRE(sheet.tables.size() == 1);
    CHECK(sheet.tables[0].header[0] == "no.");
    for (const auto& row : sheet.tables[0].rows) CHECK(row[0] == std::to_string(next++));
  }
  CHECK(next == 150);
  CHECK(sheets[1].title.sheet == "2/" + std::to_string(sheets.size()));
}

TEST_CASE("no row of a table stands alone on its last sheet") {
  const SheetTable head{{}, "Parts", {20.0, 60.0}, {"no.", "name"}, {}, 2.5};
  for (int count = 30; count < 120; ++count) {
    CAPTURE(count);
    SheetTable table = head;
    table.rows = rows(count);
    const std::vector<Sheet> sheets = table_sheets(title(), PaperSize::a4, std::move(table));
    std::size_t all = 0;
    for (const Sheet& sheet : sheets) all += sheet.tables[0].rows.size();
    CHECK(all == static_cast<std::size_t>(count));
    CHECK(sheets.back().tables[0].rows.size() > 1);
  }
}

namespace {

/// What the windows of templates show of the drawing, each in the drawing's own frame.
std::vector<PlaneBox> windows_of(const std::vector<Sheet>& sheets) {
  std::vector<PlaneBox> windows;
  for (const Sheet& sheet : sheets) {
    const SheetView& view = sheet.views.front();
    CHECK(view.scale == 1.0);
    REQUIRE(view.clip.has_value());
    const Vec2 low = view.anchor + (view.clip->low - view.at);
    windows.push_back({low, low + Vec2{view.clip->width(), view.clip->height()}});
    CHECK(view.clip->high.x <= sheet.width_mm);
    CHECK(view.clip->high.y <= sheet.height_mm);
  }
  return windows;
}

bool holds(const PlaneBox& box, Vec2 point) {
  return point.x >= box.low.x && point.x <= box.high.x && point.y >= box.low.y && point.y <= box.high.y;
}

/// Every point of the contours lies in a window, with its neighbourhood where windows overlap; no window is blank.
void require_covered(const Drawing& drawing, const std::vector<Sheet>& sheets) {
  const std::vector<PlaneBox> windows = windows_of(sheets);
  std::vector<Vec2> points;
  for (const DrawnPath& drawn : drawing.paths) {
    const std::vector<Vec2> flat = flattened(drawn.path, 0.05);
    for (std::size_t i = 0; i + 1 < flat.size(); ++i) {
      for (int k = 0; k < 40; ++k) points.push_back(flat[i] + (k / 40.0) * (flat[i + 1] - flat[i]));
    }
  }
  std::size_t missed = 0;
  for (const Vec2 point : points) {
    missed += std::none_of(windows.begin(), windows.end(),
                           [&](const PlaneBox& window) { return holds(window, point); })
                  ? 1
                  : 0;
  }
  CHECK(missed == 0);
  for (const PlaneBox& window : windows) {
    const bool has_line =
        std::any_of(points.begin(), points.end(), [&](Vec2 point) { return holds(window, point); });
    const Vec2 middle = 0.5 * (window.low + window.high);
    const bool lies_inside = std::any_of(
        drawing.paths.begin(), drawing.paths.end(),
        [&](const DrawnPath& drawn) { return drawn.path.closed && contains(drawn.path, middle); });
    CHECK((has_line || lies_inside));
  }
}

}  // namespace

TEST_CASE("templates at 1:1 cover the drawing with overlapping windows and show no blank sheet") {
  const Drawing drawing = plate();
  for (const PaperSize size : {PaperSize::a4, PaperSize::a3}) {
    const std::vector<Sheet> sheets = tiled_template(drawing, title(), size, 10.0);
    CHECK(template_sheets(drawing, size, 10.0) == sheets.size());
    require_covered(drawing, sheets);
  }
  const std::vector<Sheet> rolls = roll_template(drawing, title());
  REQUIRE(rolls.size() == 1);
  CHECK(template_sheets(drawing, {}) == 1);
  CHECK(rolls.front().width_mm >= bounds(drawing)->width());
  require_covered(drawing, rolls);
}

TEST_CASE("the bars of 100 mm on templates stand beside the pattern, and on the paper") {
  const Drawing drawing = plate();
  std::vector<Sheet> sheets = roll_template(drawing, title());
  for (const PaperSize size : {PaperSize::a4, PaperSize::a3}) {
    for (Sheet& sheet : tiled_template(drawing, title(), size, 10.0)) sheets.push_back(std::move(sheet));
  }
  for (const Sheet& sheet : sheets) {
    REQUIRE(sheet.views.size() >= 2);
    REQUIRE(sheet.views[0].clip);
    const PlaneBox& window = *sheet.views[0].clip;
    double highest = 0.0;
    for (const DrawnPath& drawn : sheet.views[1].drawing.paths) {
      const PlaneBox line = bounds(drawn.path);
      highest = std::max(highest, line.high.y - line.low.y);
      CHECK((line.high.x < window.low.x || line.high.y < window.low.y));
      // Office printers leave 8 mm white.
      CHECK(line.low.x >= 8.0 - 1e-9);
      CHECK(line.low.y >= 8.0 - 1e-9);
    }
    CHECK(highest == Approx(100.0));
  }
}

TEST_CASE("a roll that is longer than a page of a PDF may be is several, with crosses and a key") {
  Drawing drawing;
  const std::size_t layer = drawing.layer({"CUT", LineStyle::continuous, 0.25, 7});
  drawing.add(layer, rectangle({0.0, 0.0}, {12'000.0, 300.0}));
  const std::vector<Sheet> rolls = roll_template(drawing, title(), 10.0);
  REQUIRE(rolls.size() == 3);
  CHECK(template_sheets(drawing, {}, 10.0) == 3);
  for (const Sheet& sheet : rolls) {
    CHECK(sheet.width_mm <= 5000.0);
    CHECK(sheet.views.size() == 3);
  }
  require_covered(drawing, rolls);
  // Crosses of neighbours fall together: they lie in the middle of what both show.
  const std::vector<PlaneBox> windows = windows_of(rolls);
  CHECK(windows[0].high.x - windows[1].low.x == Approx(10.0));
  const std::vector<DrawnText>& texts = rolls[1].views[1].drawing.texts;
  CHECK(std::any_of(texts.begin(), texts.end(), [](const DrawnText& text) {
    return text.text.find("sheet 2 of 3, row 1 of 1, column 2 of 3; overlap 10 mm") != std::string::npos;
  }));
}

TEST_CASE("an upright picture is tiled over upright sheets where these are fewer") {
  Drawing drawing;
  const std::size_t layer = drawing.layer({"CUT", LineStyle::continuous, 0.25, 7});
  drawing.add(layer, rectangle({0.0, 0.0}, {180.0, 260.0}));
  const std::vector<Sheet> sheets = tiled_template(drawing, title(), PaperSize::a4);
  REQUIRE(sheets.size() == 1);
  CHECK(sheets[0].height_mm == 297.0);
  CHECK(sheets[0].views.size() == 2);  // one sheet has no neighbours to show
}

TEST_CASE("PDF and SVG of the same sheets are the same bytes; sheets that are none are refused") {
  std::vector<Sheet> sheets{part_sheet()};
  const std::string pdf = pdf_text(sheets, "Chute – drawings");
  const std::string svg = svg_text(sheets[0]);
  (void)svg_text(part_sheet());
  CHECK(pdf == pdf_text(sheets, "Chute – drawings"));
  CHECK(svg == svg_text(sheets[0]));
  CHECK(svg.find("width=\"420mm\" height=\"297mm\"") != std::string::npos);
  CHECK_THROWS_WITH(pdf_text({}, ""), "drawing set: has no sheet\n      A PDF has one or more.");
  sheets[0].views[0].drawing.circles[0].circle.radius = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_WITH(pdf_text(sheets, ""), "sheet  Seitenwand links: a number is not finite");
}

TEST_CASE(
    "at a reduced scale lines that a pen draws over each other are drawn once, and specks are left out") {
  Drawing drawing;
  const std::size_t layer = drawing.layer({"EDGES", LineStyle::continuous, 0.25, 7});
  drawing.line(layer, {0.0, 0.0}, {50'000.0, 0.0});
  drawing.line(layer, {50'000.0, 1.0}, {1.0, 0.0});  // the other way, 2 um off on paper
  drawing.line(layer, {0.0, 100.0}, {50'000.0, 100.0});
  drawing.line(layer, {10.0, 10.0}, {14.0, 10.0});  // 8 um on paper
  ArcPath wave;
  for (int i = 0; i <= 5000; ++i) wave.vertices.push_back({{2.0 * i, 1000.0 * std::sin(0.01 * i)}, 0.0});
  drawing.add(layer, wave);
  Sheet sheet = blank_sheet(PaperSize::a3);
  sheet.frame = false;
  for (const double scale : {1.0 / 500.0, 1.0}) {
    SheetView view;
    view.drawing = drawing;
    view.scale = scale;
    sheet.views = {view};
    const std::vector<DrawnPath> paths = drawing::ink_of(sheet).front().drawing.paths;
    if (scale == 1.0) {
      CHECK(paths.size() == 5);
      CHECK(paths.back().path.vertices.size() == 5001);
      continue;
    }
    REQUIRE(paths.size() == 3);
    const std::vector<PathVertex>& kept = paths.back().path.vertices;
    CHECK(kept.size() < 2600);
    CHECK(kept.front().at == scale * wave.vertices.front().at);
    CHECK(kept.back().at == scale * wave.vertices.back().at);
    // What is left out lies within a speck of what is drawn.
    for (const PathVertex& vertex : wave.vertices) {
      double least = 1.0;
      for (const PathVertex& one : kept) least = std::min(least, norm(one.at - scale * vertex.at));
      CHECK(least < 0.02);
    }
  }
}

TEST_CASE("poppler finds the pages in their sizes, and the words on them", "[external]") {
  if (!oracle_is_there("pdfinfo", {"-v"})) return;
  const TempDir directory;
  std::vector<Sheet> sheets{part_sheet()};
  for (Sheet& sheet : table_sheets(title(), PaperSize::a4,
                                   {{}, "Stückliste", {20.0, 60.0}, {"no.", "name"}, rows(3), 2.5})) {
    sheets.push_back(sheet);
  }
  sheets.push_back(roll_template(plate(), title()).front());
  const auto file = directory / "set.pdf";
  write_pdf(file, numbered(sheets), "Chute");
  const Outcome info = run_program("pdfinfo", {"-f", "1", "-l", "3", file.string()});
  INFO(info.output << info.errors);
  CHECK(info.output.find("Pages:           3") != std::string::npos);
  CHECK(info.output.find("Page    1 size:  1190.55 x 841.89 pts (A3)") != std::string::npos);
  CHECK(info.output.find("Page    2 size:  595.276 x 841.89 pts (A4)") != std::string::npos);
  char size[64];
  std::snprintf(size, sizeof size, "Page    3 size:  %.6g x %.6g pts", sheets[2].width_mm * 72.0 / 25.4,
                sheets[2].height_mm * 72.0 / 25.4);
  CHECK(info.output.find(size) != std::string::npos);
  CHECK(info.output.find("Title:           Chute") != std::string::npos);
  const Outcome text = run_program("pdftotext", {"-layout", file.string(), "-"});
  for (const char* word :
       {"Seitenwand links", "S235, 4 mm", "Stückliste", "row 2", "1/3", "1:10", "100 mm both ways"}) {
    INFO(word);
    CHECK(text.output.find(word) != std::string::npos);
  }
}
