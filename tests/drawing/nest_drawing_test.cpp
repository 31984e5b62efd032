#include "glissade/drawing/workshop_drawings.hpp"
#include "glissade/io/dxf_file.hpp"

#include "support/catch.hpp"
#include "support/shop_parts.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <vector>

using namespace glissade;

namespace {

/// Paths and circles by the name of their layer.
std::map<std::string, std::size_t> lines_by_layer(const Drawing& drawing) {
  std::map<std::string, std::size_t> counts;
  for (const DrawnPath& drawn : drawing.paths) ++counts[drawing.layers[drawn.layer].name];
  for (const DrawnCircle& drawn : drawing.circles) ++counts[drawing.layers[drawn.layer].name];
  return counts;
}

/// A workshop of which every part has all that a pattern can have.
Workshop marked_workshop() {
  Workshop workshop = testing::sample_workshop();
  std::erase_if(workshop.parts, [](const ShopPart& part) { return !part.pattern; });
  workshop.parts[0].places.resize(2);
  FlatPattern& pattern = *workshop.parts[0].pattern;
  const PlaneBox box = bounds(pattern.region.outline);
  const Vec2 middle = 0.5 * (box.low + box.high);
  pattern.bends = {{middle, middle + Vec2{0.0, 0.01}, Angle::from_degrees(10.0), 4e-3, true},
                   {middle, middle + Vec2{0.0, 0.02}, Angle::from_degrees(10.0), 4e-3, false}};
  pattern.rolls = {{middle, middle + Vec2{0.0, 0.03}, 2.0}};
  pattern.marks = {{{{middle}, {middle + Vec2{0.01, 0.0}}}, false}};
  pattern.number_at = middle;
  pattern.number_height = 0.01;
  return workshop;
}

/// The pieces on a sheet, where they lie [mm].
std::vector<PlaneRegion> regions_on(const NestedSheet& sheet, const Workshop& workshop) {
  std::vector<PlaneRegion> regions;
  for (const NestedPiece& piece : sheet.pieces)
    regions.push_back(scaled(moved(workshop.parts[piece.part].pattern->region, piece.motion), 1000.0));
  return regions;
}

}  // namespace

TEST_CASE("a nest holds of each piece what the file of its part holds, on the layers that are asked for") {
  const Workshop workshop = marked_workshop();
  for (const LayerPreset preset :
       {LayerPreset::own, LayerPreset::plain, LayerPreset::inventor, LayerPreset::sendcutsend}) {
    std::map<std::string, std::size_t> expected;
    std::map<std::string, std::size_t> found;
    for (const NestedSheet& sheet : nest(workshop)) {
      for (const NestedPiece& piece : sheet.pieces) {
        for (const auto& [layer, count] : lines_by_layer(cut_drawing(workshop.parts[piece.part], preset)))
          expected[layer] += count;
      }
      const Drawing drawing = nest_drawing(workshop, sheet, preset);
      for (const auto& [layer, count] : lines_by_layer(drawing)) found[layer] += count;
      CHECK(dxf_text(drawing) == dxf_text(nest_drawing(workshop, sheet, preset)));
    }
    if (preset == LayerPreset::plain) {
      // Sheet and labels lie there, too.
      CHECK(found["0"] > expected["0"]);
      continue;
    }
    const bool labelled = preset != LayerPreset::sendcutsend;
    CHECK((found["LABEL"] > 0) == labelled);
    CHECK((found["SHEET"] > 0) == labelled);
    found.erase("LABEL");
    found.erase("SHEET");
    CHECK(found == expected);
    CHECK(expected.size() >= (labelled ? 5 : 1));
  }
}

TEST_CASE("labels of a nest lie inside their piece, and what is not cut is grey in a file of one layer") {
  const Workshop workshop = marked_workshop();
  for (const NestedSheet& sheet : nest(workshop)) {
    const std::vector<PlaneRegion> regions = regions_on(sheet, workshop);
    const Drawing drawing = nest_drawing(workshop, sheet);
    for (const DrawnPath& drawn : drawing.paths) {
      if (drawing.layers[drawn.layer].name != "LABEL") continue;
      const Vec2 point = drawn.path.vertices.front().at;
      CHECK(std::any_of(regions.begin(), regions.end(),
                        [&](const PlaneRegion& region) { return contains(region.outline, point); }));
    }
    const Drawing plain = nest_drawing(workshop, sheet, LayerPreset::plain);
    std::size_t grey = 0;
    for (const DrawnPath& drawn : plain.paths) grey += drawn.colour == 8 ? 1 : 0;
    const auto own = lines_by_layer(drawing);
    CHECK(grey == own.at("LABEL") + own.at("SHEET"));
  }
}

TEST_CASE("labels of a nest lie inside plates of every width with all of their strokes, descenders too") {
  Workshop workshop;
  for (double width = 6e-3; width < 60e-3; width += 0.7e-3) {
    ShopPart part;
    part.number = static_cast<int>(workshop.parts.size()) + 1;
    part.name = "gyp(py_g)";
    part.material = "S235";
    part.thickness = 3e-3;
    part.density = 7850.0;
    part.places.resize(1);
    part.pattern.emplace();
    part.pattern->region.outline = rectangle({}, {0.4, width});
    part.body = Prism{part.pattern->region, 3e-3};
    workshop.parts.push_back(std::move(part));
  }
  std::size_t labels = 0;
  for (const NestedSheet& sheet : nest(workshop)) {
    const std::vector<PlaneRegion> regions = regions_on(sheet, workshop);
    const Drawing drawing = nest_drawing(workshop, sheet);
    for (const DrawnPath& drawn : drawing.paths) {
      if (drawing.layers[drawn.layer].name != "LABEL") continue;
      ++labels;
      const std::vector<Vec2> points = flattened(drawn.path, 0.01);
      CHECK(std::any_of(regions.begin(), regions.end(), [&](const PlaneRegion& region) {
        return std::all_of(points.begin(), points.end(),
                           [&](Vec2 point) { return contains(region.outline, point); });
      }));
    }
  }
  CHECK(labels > 500);
}
