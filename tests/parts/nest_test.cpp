#include "glissade/parts/nest.hpp"

#include "glissade/core/error.hpp"

#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/shop_parts.hpp"

#include <algorithm>
#include <string>
#include <vector>

namespace nest_test {

using namespace glissade;

namespace {

ShopPart flat_part(int number, const PlaneRegion& region, std::size_t quantity, double thickness = 0.004) {
  ShopPart part = testing::shop_part(number, "part", Prism{region, thickness});
  part.thickness = thickness;
  part.pattern = FlatPattern{region, {}, {}, {}, {}, 0.0};
  part.places.assign(quantity, Frame{});
  return part;
}

PlaneRegion plate(double width, double height) {
  return {rectangle({1.0, -2.0}, {1.0 + width, -2.0 + height}), {}, {}};
}

std::vector<PlaneRegion> regions_on(const Workshop& workshop, const NestedSheet& sheet) {
  std::vector<PlaneRegion> regions;
  for (const NestedPiece& piece : sheet.pieces) {
    regions.push_back(moved(workshop.parts[piece.part].pattern->region, piece.motion));
  }
  return regions;
}

/// Every piece on its sheet, apart, and as often as ordered; areas add up.
void require_sound(const Workshop& workshop, const std::vector<NestedSheet>& sheets) {
  constexpr double kSlack = 1e-9;
  std::vector<std::size_t> laid(workshop.parts.size(), 0);
  for (const NestedSheet& sheet : sheets) {
    const std::vector<PlaneRegion> regions = regions_on(workshop, sheet);
    double area = 0.0;
    for (std::size_t i = 0; i < regions.size(); ++i) {
      const ShopPart& part = workshop.parts[sheet.pieces[i].part];
      CHECK(part.material == sheet.material);
      CHECK(part.thickness == sheet.thickness);
      ++laid[sheet.pieces[i].part];
      area += moments(regions[i]).area;
      const PlaneBox box = bounds(regions[i].outline);
      CHECK(box.low.x >= sheet.stock.margin - kSlack);
      CHECK(box.low.y >= sheet.stock.margin - kSlack);
      CHECK(box.high.x <= sheet.stock.width - sheet.stock.margin + kSlack);
      CHECK(box.high.y <= sheet.stock.height - sheet.stock.margin + kSlack);
      for (std::size_t k = 0; k < i; ++k) {
        CHECK(distance(regions[i].outline, regions[k].outline) >= sheet.stock.spacing - kSlack);
        CHECK_FALSE(contains(regions[i].outline, regions[k].outline.vertices[0].at));
        CHECK_FALSE(contains(regions[k].outline, regions[i].outline.vertices[0].at));
      }
    }
    CHECK(sheet.utilisation == Approx(area / (sheet.stock.width * sheet.stock.height)).epsilon(1e-12));
  }
  for (std::size_t i = 0; i < laid.size(); ++i) {
    CHECK(laid[i] == (workshop.parts[i].pattern ? workshop.parts[i].quantity() : 0));
  }
}

}  // namespace

TEST_CASE("random parts are nested apart, inside their sheets, as often as ordered, and the same twice") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (int round = 0; round < 6; ++round) {
    Workshop workshop;
    const int parts = random.integer(3, 8);
    for (int i = 1; i <= parts; ++i) {
      const double size = random.between(0.2, 0.9);
      PlaneRegion region = random.integer(0, 1) == 0
                               ? plate(size, random.between(0.05, 0.5))
                               : scaled(testing::metre_band(random.integer(2, 8), 3), 0.5 * size);
      region = moved(region, PlaneMotion::turn(random.between(-3.0, 3.0), {random.between(-5.0, 5.0), 1.0}));
      workshop.parts.push_back(flat_part(i, region, static_cast<std::size_t>(random.integer(1, 4)),
                                         random.integer(0, 2) == 0 ? 0.004 : 0.006));
    }
    NestStock stock{random.between(1.6, 3.0), 1.5, random.between(0.0, 0.02), random.between(0.0, 0.03)};
    const std::vector<NestedSheet> sheets = nest(workshop, stock);
    require_sound(workshop, sheets);
    const std::vector<NestedSheet> again = nest(workshop, stock);
    REQUIRE(again.size() == sheets.size());
    for (std::size_t i = 0; i < sheets.size(); ++i) {
      REQUIRE(again[i].pieces.size() == sheets[i].pieces.size());
      for (std::size_t k = 0; k < sheets[i].pieces.size(); ++k) {
        CHECK(again[i].pieces[k].part == sheets[i].pieces[k].part);
        CHECK(again[i].pieces[k].motion.shift == sheets[i].pieces[k].motion.shift);
      }
    }
  }
}

TEST_CASE("parts whose thicknesses differ by rounding share a sheet, and no two sheets share a name") {
  Workshop workshop;
  workshop.parts = {flat_part(1, plate(1.2, 0.9), 3, 5e-3),
                    flat_part(2, plate(1.2, 0.9), 3, 0.0050000000000000044),
                    flat_part(3, plate(0.3, 0.3), 1, 5e-3 + 1e-9), flat_part(4, plate(0.3, 0.3), 1, 6e-3)};
  const std::vector<NestedSheet> sheets = nest(workshop, NestStock{});
  std::vector<std::string> names;
  std::size_t mixed = 0;
  for (std::size_t i = 0; i < sheets.size(); ++i) {
    names.push_back(sheets[i].name);
    bool one = false;
    bool other = false;
    for (const NestedPiece& piece : sheets[i].pieces) {
      one = one || piece.part == 0;
      other = other || piece.part == 1;
    }
    if (one && other) ++mixed;
  }
  CHECK(mixed > 0);
  std::sort(names.begin(), names.end());
  CHECK(std::unique(names.begin(), names.end()) == names.end());
  // Counted by stock they are as many as their names say.
  const std::vector<StockGroup> groups = by_stock(sheets);
  REQUIRE(groups.size() == 2);
  CHECK(groups[0].sheets.size() + groups[1].sheets.size() == sheets.size());
  double area = 0.0;
  for (const StockGroup& group : groups) {
    CHECK(group.sheets.back().name.ends_with("_of_" + std::to_string(group.sheets.size())));
    area +=
        group.utilisation * static_cast<double>(group.sheets.size()) * NestStock{}.width * NestStock{}.height;
  }
  CHECK(area == Approx(6 * 1.2 * 0.9 + 2 * 0.3 * 0.3));
  CHECK(by_stock({}).empty());
}

TEST_CASE("rectangles that fill a sheet fill it") {
  Workshop workshop;
  // Three rows of two, 0.9 m x 0.4 m, on 2 m x 1.5 m with 10 mm margin and spacing.
  workshop.parts.push_back(flat_part(1, plate(0.9, 0.4), 6));
  const auto sheets = nest(workshop, {2.0, 1.5, 0.01, 0.01});
  REQUIRE(sheets.size() == 1);
  CHECK(sheets[0].utilisation == Approx(6 * 0.36 / 3.0));
  require_sound(workshop, sheets);
  // Turned where only that fits.
  workshop.parts[0] = flat_part(1, plate(0.4, 1.9), 1);
  CHECK(nest(workshop, {2.0, 0.5, 0.01, 0.01}).size() == 1);
}

TEST_CASE("curved bands stack into each other's hollows") {
  // 2.4 m long, 0.25 m wide, curved by more than half their width: in boxes of their own, two fit a sheet; stacked, four.
  Workshop workshop;
  const PlaneRegion band = testing::metre_band(6, 0);
  workshop.parts.push_back(flat_part(1, band, 4));
  const auto sheets = nest(workshop, {3.0, 2.0, 0.01, 0.01});
  REQUIRE(sheets.size() == 1);
  require_sound(workshop, sheets);
}

TEST_CASE("parts that fit no sheet are named, all of them; so are sheets that are none") {
  Workshop workshop;
  workshop.parts.push_back(flat_part(1, plate(3.5, 0.4), 2));
  workshop.parts.push_back(flat_part(2, plate(0.5, 0.4), 2));
  workshop.parts.push_back(flat_part(3, plate(2.0, 1.6), 1));
  try {
    (void)nest(workshop);
    FAIL("laid");
  } catch (const InputError& error) {
    REQUIRE(error.issues().size() == 2);
    CHECK(error.issues()[0].where == "split.sheet");
    CHECK(error.issues()[0].what == "part 1, part: its pattern of 3.5 m x 400 mm fits no sheet");
    CHECK(error.issues()[0].why == "Sheets are 3 m x 1.5 m with a margin of 5 mm.");
    CHECK(error.issues()[1].what.find("part 3, part: ") == 0);
  }
  CHECK_THROWS_AS(nest(workshop, {0.0, 1.5, 0.01, 0.01}), InputError);
  CHECK_THROWS_AS(nest(workshop, {1.0, 1.5, -0.01, 0.01}), InputError);
}

TEST_CASE("what is wrong with a sheet is told, all of it, with its bounds") {
  const auto told = [](const NestStock& stock) {
    std::string text;
    for (const Issue& issue : stock_problems(stock))
      text += issue.where + "|" + issue.what + "|" + issue.hint + "\n";
    return text;
  };
  CHECK(told(NestStock{}).empty());
  CHECK(told({3.0, 1.5, 0.0, 0.0}).empty());
  CHECK(told({3.0, 1.5, 0.75, 1.5}) ==
        "split.margin|margin: 750 mm leaves nothing of a sheet that is 1.5 m wide|less than 750 mm\n"
        "split.spacing|spacing: 1.5 m is no less than the width of the sheet, 1.5 m|a spacing of less than "
        "1.5 m, or a larger sheet\n");
  CHECK(told({3.0, 1.5, -1e-3, -2e-3}) ==
        "split.margin|margin: -1 mm is negative|margin: 5 mm\n"
        "split.spacing|spacing: -2 mm is negative|spacing: 10 mm\n");
  CHECK(told({3.0, 0.0, 5e-3, 10e-3}) == "split.sheet|sheet: 0 mm is not positive|sheet: [3 m, 1.5 m]\n");
}

}  // namespace nest_test
