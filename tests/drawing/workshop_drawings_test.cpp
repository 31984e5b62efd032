#include "glissade/drawing/workshop_drawings.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/slot.hpp"
#include "glissade/io/dxf_file.hpp"
#include "glissade/io/sheet_file.hpp"
#include "glissade/io/workshop_tables.hpp"

#include "drawing/balloons.hpp"
#include "parts/bodies/angle_bar.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/shop_parts.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <utility>
#include <variant>
#include <vector>

using namespace glissade;

namespace {

std::set<std::string> layer_names(const Drawing& drawing) {
  std::set<std::string> names;
  for (const DrawingLayer& layer : drawing.layers) names.insert(layer.name);
  return names;
}

bool says(const Sheet& sheet, const std::string& text) {
  const auto is_it = [&](const DrawnText& drawn) { return drawn.text.find(text) != std::string::npos; };
  bool found = sheet.title.title.find(text) != std::string::npos ||
               std::any_of(sheet.texts.begin(), sheet.texts.end(), is_it);
  for (const SheetView& view : sheet.views) {
    found = found || std::any_of(view.drawing.texts.begin(), view.drawing.texts.end(), is_it);
  }
  for (const SheetTable& table : sheet.tables) {
    for (const auto& row : table.rows) found = found || std::find(row.begin(), row.end(), text) != row.end();
  }
  return found;
}

}  // namespace

TEST_CASE("a cutting file has the part's contour and holes, moved to its corner; presets name the layers") {
  const ShopPart part = testing::sample_workshop().parts[0];
  const PlaneRegion& region = part.pattern->region;
  for (const LayerPreset preset :
       {LayerPreset::own, LayerPreset::plain, LayerPreset::inventor, LayerPreset::sendcutsend}) {
    const Drawing drawing = cut_drawing(part, preset);
    PlaneRegion drawn{drawing.paths[0].path, {drawing.paths[1].path}, {}};
    for (const DrawnCircle& circle : drawing.circles) drawn.holes.push_back(circle.circle);
    CHECK(drawn.holes.size() == region.holes.size());
    CHECK(moments(drawn).area == Approx(1e6 * moments(region).area).epsilon(1e-12));
    CHECK(bounds(drawn.outline).low.x == Approx(10.0).margin(1e-9));
    CHECK(bounds(drawn.outline).low.y == Approx(10.0).margin(1e-9));
    CHECK(drawing.texts.empty());
    // Whatever the names, bends are dashed: a reader must not take them for cuts.
    const auto dashed = [&](const DrawnPath& path) {
      return path.style.value_or(drawing.layers[path.layer].style) == LineStyle::dashed;
    };
    CHECK(std::count_if(drawing.paths.begin(), drawing.paths.end(), dashed) == 2);
    CHECK(dxf_text(drawing).size() <= 10'000);
  }
  CHECK(layer_names(cut_drawing(part)) ==
        std::set<std::string>{"CUT", "MARK", "BEND_UP", "BEND_DOWN", "ROLL"});
  CHECK(layer_names(cut_drawing(part, LayerPreset::plain)) == std::set<std::string>{"0"});
  CHECK(layer_names(cut_drawing(part, LayerPreset::inventor)).count("IV_INTERIOR_PROFILES") == 1);
  // One contour with its bends, no marks, no rolls.
  CHECK(cut_drawing(part, LayerPreset::sendcutsend).paths.size() == 2 + 2);
  CHECK(cut_drawing(part).paths.size() > 2 + 2 + 1);
  CHECK_THROWS_WITH(cut_drawing(testing::sample_workshop().parts[3]),
                    "part 4, gore: is cut from no sheet\n      It has no flat pattern.");
}

TEST_CASE("the set of drawings has every part, list and table, each sheet numbered, and is the same twice") {
  const Workshop workshop = testing::upright_workshop();
  const std::vector<Sheet> set = drawing_set(workshop);
  REQUIRE(set.size() == 23);
  for (std::size_t i = 0; i < set.size(); ++i) {
    CHECK(set[i].title.sheet == std::to_string(i + 1) + "/23");
    CHECK(set[i].title.owner == workshop.name);
  }
  for (const char* text : {"General arrangement", "left_wall", "floor", "leaning_wall", "gore", "pipe",
                           "bolt M12 x 40", "smallest hole", "joint 1", "Floor: rolled; K = 0.5"}) {
    INFO(text);
    CHECK(std::any_of(set.begin(), set.end(), [&](const Sheet& sheet) { return says(sheet, text); }));
  }
  CHECK(pdf_text(set, "x") == pdf_text(drawing_set(workshop), "x"));
}

TEST_CASE("what is not as asked for stands before the notes on the first sheet, with what to try") {
  Workshop workshop = testing::upright_workshop();
  workshop.shortfalls = {{"supports.spacing", "spacing: 2 m", "No place.", "3 m"}, {"", "no lugs", "", ""}};
  const Sheet first = drawing_set(workshop).front();
  std::vector<std::string> texts;
  for (const DrawnText& text : first.texts) texts.push_back(text.text);
  const auto shortfall =
      std::find(texts.begin(), texts.end(), "Not as asked for: spacing: 2 m. No place. Try: 3 m.");
  REQUIRE(shortfall != texts.end());
  CHECK(std::find(shortfall, texts.end(), "Not as asked for: no lugs.") != texts.end());
  CHECK(std::find(shortfall, texts.end(), workshop.notes.front()) != texts.end());
}

TEST_CASE("slots are numbered after the holes, with middle, width and length") {
  Workshop workshop = testing::upright_workshop();
  ShopPart part;
  part.name = "frame";
  part.material = "S235";
  part.number = 1;
  part.thickness = 6e-3;
  part.places = {Frame{}};
  part.pattern.emplace();
  PlaneRegion& region = part.pattern->region;
  region.outline = {{{{0.01, 0.02}, 0.0}, {{0.41, 0.02}, 0.0}, {{0.41, 0.12}, 0.0}, {{0.01, 0.12}, 0.0}},
                    true};
  region.cutouts = {{{{{0.1, 0.05}, 0.0}, {{0.12, 0.05}, 0.0}, {{0.12, 0.06}, 0.0}}, true},
                    path_of(Slot{{0.06, 0.07}, {0.0, 6.5e-3}, 6e-3})};
  region.holes = {{{0.2, 0.07}, 5.5e-3}};
  part.body = Prism{region, part.thickness};
  workshop.parts = {part};
  const auto has_row = [&](const std::vector<std::string>& wanted) {
    for (const Sheet& sheet : drawing_set(workshop)) {
      for (const SheetTable& table : sheet.tables) {
        if (std::find(table.rows.begin(), table.rows.end(), wanted) != table.rows.end()) return true;
      }
    }
    return false;
  };
  CHECK(has_row({"1", "190", "50", "11"}));
  CHECK(has_row({"2", "50", "50", "12 x 25"}));
  workshop.parts[0].pattern->region.holes.clear();
  CHECK(has_row({"1", "50", "50", "12 x 25"}));
}

TEST_CASE("the view from the side shows parts in their true size") {
  Workshop workshop;
  workshop.parts.push_back(
      testing::shop_part(1, "plate", Prism{{rectangle({0.0, 0.0}, {2.0, 1.0}), {}, {}}, 0.1}));
  // Upright, across a track that runs to the north-east.
  const double k = std::sqrt(0.5);
  workshop.parts[0].places = {{{5.0, 5.0, 3.0}, {k, k, 0.0}, {0.0, 0.0, 1.0}, {k, -k, 0.0}}};
  workshop.setting_out = {{"start", 0, 0, 0, {5.0, 5.0, 4.0}, {}, 0, 0, {}},
                          {"finish", 0, 0, 0, {7.0, 7.0, 3.0}, {}, 0, 0, {}}};
  const PlaneBox side = bounds(side_view(workshop)).value();
  CHECK(side.width() == Approx(2000.0));
  const PlaneBox plan = bounds(plan_view(workshop)).value();
  CHECK(plan.width() == Approx(2000.0));
  CHECK(plan.height() == Approx(100.0));
  // Front and back fall together: four lines.
  Workshop bare = workshop;
  bare.setting_out.resize(2);
  CHECK(plan_view(bare).paths.size() == 4);
  // A tube lying along the track: two outlines and its ends.
  workshop.parts = {testing::shop_part(2, "pipe", TubeGore{0.05, 0.002, 1.0, {}, {}})};
  workshop.parts[0].places = {{{0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, {k, -k, 0.0}, {k, k, 0.0}}};
  const PlaneBox pipe = bounds(side_view(workshop)).value();
  CHECK(pipe.width() == Approx(1000.0));
  CHECK(pipe.height() == Approx(104.0));
}

TEST_CASE(
    "the general arrangement takes the largest scale that fits, with the names of places below the view") {
  Workshop workshop;
  // 4.7 m long, 6.4 m high, 1 m wide: 1:20 is too large for A3, 1:50 is not.
  workshop.parts.push_back(
      testing::shop_part(1, "plate", Prism{{rectangle({0.0, -6.4}, {4.7, 0.0}), {}, {}}, 1.0}));
  workshop.parts[0].places = {{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, {0.0, -1.0, 0.0}}};
  workshop.setting_out = {{"start", 0, 0, 0, {0.0, 0.0, 0.0}, {}, 0, 0, {}},
                          {"mitre 1, 14.39 deg", 3, 2.0, -3.0, {2.0, 0.0, -3.0}, {}, 0, 0, {}},
                          {"joint 2", 3.1, 2.01, -3.1, {2.01, 0.0, -3.1}, {}, 0, 0, {}},
                          {"finish", 8, 4.7, -6.4, {4.7, 0.0, -6.4}, {}, 0, 0, {}}};
  const Sheet sheet = drawing_set(workshop).front();
  REQUIRE(sheet.views.size() == 2);
  const SheetView& side = sheet.views.front();
  CHECK(side.scale == Approx(1.0 / 50.0));
  CHECK(sheet.views.back().scale == side.scale);
  std::vector<std::string> names;
  for (const DrawnText& text : side.drawing.texts) {
    if (text.angle == Angle{}) continue;
    names.push_back(text.text);
    CHECK(text.at.y < -6400.0);
  }
  // The mitre lies so close to joint 2, which counts for more, that its name would lie across the other.
  CHECK(names == std::vector<std::string>{"start", "joint 2", "finish"});
}

TEST_CASE("tables as CSV: units in the header, one row each, texts with commas in quotes") {
  Workshop workshop = testing::sample_workshop();
  workshop.items[0].where = "joint 1, \"left\"";
  CHECK(bought_in_csv(workshop) ==
        "name,standard,quantity,where\nbolt M12 x 40,ISO 4017 8.8,24,\"joint 1, \"\"left\"\"\"\n");
  CHECK(bend_schedule_csv(workshop) ==
        "part,hit,distance_mm,length_mm,angle_deg,sum_deg,radius_mm,chord_error_mm\n"
        "2,1,250,0,1.718873385,1.718873385,2500,0.2\n");
  const std::string cuts = cut_list_csv(workshop);
  CHECK(std::count(cuts.begin(), cuts.end(), '\n') == 1 + 17);
  CHECK(cuts.find("\n1,left_wall,S235,4,2,") != std::string::npos);
  CHECK(cuts.find("\n4,gore,S235,4,2,,,,,,0,0,") != std::string::npos);
  const std::string out = setting_out_csv(workshop);
  // The distance travelled, whichever way the track runs: as `run_m` of stations.
  CHECK(out.starts_with("what,arc_length_mm,run_mm,z_mm,site_x_m,"));
  CHECK(out.find("ordinate_mm,underside_plumb_mm\nstart,0,0,0,0,0,0,") != std::string::npos);
  // A line that ends short of a place has no level there.
  workshop.setting_out.front().offsets = {std::nullopt};
  CHECK(setting_out_csv(workshop).find(",2500,0,\njoint 1,") != std::string::npos);
  // What is upright rises without bound, over whatever rounding leaves of its run.
  for (const auto& [degrees, percent] :
       {std::pair(90.0, "90,inf"), std::pair(-90.0, "-90,-inf"), std::pair(45.0, "45,100")}) {
    workshop.setting_out.front().slope_angle = Angle::from_degrees(degrees);
    CHECK(setting_out_csv(workshop).find("\nstart,0,0,0,0,0,0," + std::string(percent) + ",") !=
          std::string::npos);
  }
  CHECK(shop_checks_csv(workshop) ==
        "rule,verdict,value,bound,where,source,sentence,certainty\n"
        "smallest hole,pass,14 mm,at least 4 mm,part 1,a source,Holes are wide enough.,secondary\n");
}

TEST_CASE(
    "the cut list tells what parts are cut from: the rectangle round a board that lies askew, length and "
    "section of tubes") {
  Workshop workshop;
  // A brace of 2 m x 120 mm at 45 deg, a curved band, and a tube of 60 x 60 x 4 mm.
  const ArcPath board =
      moved(rectangle({0.0, 0.0}, {2.0, 0.12}), PlaneMotion::turn(0.25 * std::numbers::pi, {3.0, 1.0}));
  workshop.parts.push_back(testing::shop_part(1, "brace", Prism{{board, {}, {}}, 0.024}));
  workshop.parts[0].pattern = FlatPattern{{board, {}, {}}, {}, {}, {}, {}, 0.0};
  workshop.parts.push_back(testing::shop_part(
      2, "leg",
      Prism{{rectangle({-0.03, -0.03}, {0.03, 0.03}), {rectangle({-0.026, -0.026}, {0.026, 0.026})}, {}},
            1.5}));
  workshop.parts[1].pattern.reset();
  workshop.parts[1].thickness = 0.004;
  const std::string cuts = cut_list_csv(workshop);
  INFO(cuts);
  CHECK(cuts.find("\n1,brace,S235,4,1,2000,120,4240,0,0,") != std::string::npos);
  CHECK(cuts.find("\n2,leg,S235,4,1,1500,60,,,,") != std::string::npos);
  CHECK(cuts.find(",tube 60 x 60 x 4 mm\n") != std::string::npos);
}

TEST_CASE("a flat bar's row and sheet tell its section and length, and no edge that is cut from a sheet") {
  Workshop workshop;
  workshop.name = "flat bar";
  const PlaneRegion region{
      rectangle({0.0, 0.0}, {2.0, 0.05}), {}, {{{0.03, 0.025}, 7e-3}, {{1.97, 0.025}, 7e-3}}};
  workshop.parts.push_back(testing::shop_part(1, "brace", Prism{region, 0.006}));
  workshop.parts[0].pattern = FlatPattern{region, {}, {}, {}, {}, 0.0};
  workshop.parts[0].thickness = 0.006;
  workshop.parts[0].bought_in = true;
  workshop.parts[0].flat_bar = true;
  const std::string cuts = cut_list_csv(workshop);
  INFO(cuts);
  CHECK(cuts.find("\n1,brace,S235,6,1,2000,50,,2,,") != std::string::npos);
  CHECK(cuts.find(",yes,flat bar 50 x 6 mm\n") != std::string::npos);
  std::string texts;
  for (const Sheet& sheet : drawing_set(workshop)) {
    for (const DrawnText& text : sheet.texts) texts += text.text + "\n";
  }
  INFO(texts);
  CHECK(texts.find("flat bar 50 x 6 mm\n") != std::string::npos);
  CHECK(texts.find("2000 mm of bar\n") != std::string::npos);
  CHECK(texts.find("cut edge") == std::string::npos);
}

TEST_CASE(
    "an angle's row tells the straight bar that it takes, its sheet both legs and how its ends are cut") {
  Workshop workshop;
  workshop.name = "angles";
  workshop.parts.push_back(testing::shop_part(1, "frame_angle", testing::mitred_angle()));
  workshop.parts.push_back(testing::shop_part(2, "pipe_flange", testing::angle_ring()));
  for (ShopPart& part : workshop.parts)
    part.pattern = FlatPattern{parts::lying_leg(std::get<AngleBar>(part.body)), {}, {}, {}, {}, 0.0};
  const std::string cuts = cut_list_csv(workshop);
  INFO(cuts);
  // Its longer edge runs from -30 to 560 mm.
  CHECK(cuts.find("\n1,frame_angle,S235,4,1,590,60,,2,,") != std::string::npos);
  CHECK(cuts.find(",angle 60 x 60 x 6 mm\n") != std::string::npos);
  // Round the centroid of an L of 50 x 50 x 5 mm, 13.82 mm from its heel (1312.5 + 4375 over 475 mm^2, by its two legs).
  const double around = 2.0 * std::numbers::pi * (200.0 + (250.0 * 25.0 + 225.0 * 2.5) / 475.0);
  CHECK(cuts.find("\n2,pipe_flange,S235,4,1," + rounded_text(around, 7)) != std::string::npos);
  std::string texts;
  for (const Sheet& sheet : drawing_set(workshop)) {
    for (const DrawnText& text : sheet.texts) texts += text.text + "\n";
    for (const SheetView& view : sheet.views) texts += view.caption + "\n";
  }
  INFO(texts);
  CHECK(texts.find("angle 60 x 60 x 6 mm, EN 10056-1\n590 mm of bar\nends cut at 63.4 and 45.0 deg\n") !=
        std::string::npos);
  CHECK(texts.find("rolled, the drilled leg outwards\n") != std::string::npos);
  CHECK(texts.find("Drilled leg, the other one towards you") != std::string::npos);
}

TEST_CASE("the table of sheets tells the stock, its pieces, and the share of it that they use") {
  Workshop workshop;
  workshop.parts.push_back(
      testing::shop_part(1, "plate", Prism{{rectangle({0.0, 0.0}, {1.0, 0.5}), {}, {}}, 0.004}));
  PlaneRegion region;
  region.outline = rectangle({0.0, 0.0}, {1.0, 0.5});
  region.holes = {{{0.5, 0.25}, 0.1}};
  workshop.parts[0].pattern = FlatPattern{region, {}, {}, {}, {}, 0.0};
  workshop.parts[0].places.resize(3);
  const std::vector<NestedSheet> sheets = nest(workshop, {2.05, 1.05, 0.01, 0.01});
  REQUIRE(sheets.size() == 1);
  const std::string table = nests_csv(workshop, sheets);
  INFO(table);
  CHECK(table.find("sheet,material,thickness_mm,length_mm,width_mm,margin_mm,spacing_mm,pieces,parts_area_m2,"
                   "utilisation_percent,parts\nnest_S235_4mm_1_of_1,S235,4,2050,1050,10,10,3,1.40575222") ==
        0);
  CHECK(table.find(",3 x no. 1\n") != std::string::npos);
  // Three plates less their holes, over the sheet.
  const double share = 3.0 * (0.5 - std::numbers::pi * 0.01) / (2.05 * 1.05);
  CHECK(sheets[0].utilisation == Approx(share).epsilon(1e-12));
  CHECK(table.find(",65.3") != std::string::npos);
}

TEST_CASE("no line of the general arrangement runs through the numbers of its overall sizes") {
  Workshop workshop = testing::sample_workshop();
  for (int i = 0; i < 800; ++i) {
    SettingOutPoint joint;
    joint.what = "joint " + std::to_string(i);
    joint.x = 0.05 * (i / 4 - 100);
    joint.z = 0.5 * (i % 4 - 2);
    workshop.setting_out.push_back(joint);
  }
  const Sheet sheet = drawing_set(workshop).front();
  std::size_t joints = 0;
  for (const SheetView& view : sheet.views) {
    for (const DrawnDimension& dimension : view.drawing.dimensions) {
      const DrawnText text = lines_of(dimension, view.scale).text;
      // Five points along the number, a little narrower than it is.
      const Vec2 along = PlaneMotion::turn(text.angle.radians())(Vec2{1.0, 0.0});
      const Vec2 up{-along.y, along.x};
      const double half = 0.45 * stroked_width(text.text, text.height_mm) / view.scale;
      for (int k = -2; k <= 2; ++k) {
        const Vec2 point = text.at + 0.5 * k * half * along + 0.5 * text.height_mm / view.scale * up;
        for (const DrawnPath& drawn : view.drawing.paths) {
          const std::string& layer = view.drawing.layers[drawn.layer].name;
          if (layer != "JOINTS" && layer != "NUMBERS") continue;
          joints += layer == "JOINTS" ? 1 : 0;
          const Vec2 from = drawn.path.vertices.front().at;
          const Vec2 way = drawn.path.vertices.back().at - from;
          const double share = std::clamp(dot(point - from, way) / std::max(dot(way, way), 1e-12), 0.0, 1.0);
          CHECK(norm(from + share * way - point) * view.scale > 0.3);
        }
      }
    }
  }
  CHECK(joints > 100);
}

namespace {

/// A track of boxes on legs: so many units, each of two kinds of its own, and one kind that all have.
Workshop row_of_units(int units, double step, double drop) {
  Workshop workshop;
  workshop.name = "row";
  int number = 0;
  const auto add = [&](const std::string& name, double wide, double high, std::vector<Vec3> places) {
    ShopPart part = testing::shop_part(
        ++number, name,
        Prism{{rectangle({-0.5 * wide, -0.5 * high}, {0.5 * wide, 0.5 * high}), {}, {}}, 0.4});
    part.places.clear();
    for (const Vec3 place : places)
      part.places.push_back({place, {1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, {0.0, -1.0, 0.0}});
    part.centre_of_gravity = places.front() + Vec3{0.0, -0.2, 0.0};
    workshop.parts.push_back(std::move(part));
  };
  std::vector<Vec3> all;
  for (int i = 0; i < units; ++i) {
    const Vec3 at{step * i, 0.0, -drop * i};
    add("box_" + std::to_string(i + 1), 0.9 * step, 0.2, {at});
    add("leg_" + std::to_string(i + 1), 0.05, 0.8, {at + Vec3{0.0, 0.1, -0.6}, at + Vec3{0.0, -0.1, -0.6}});
    all.push_back(at + Vec3{0.3 * step, 0.0, 0.2});
  }
  add("knob", 0.05, 0.05, all);
  workshop.setting_out = {{"start", 0, 0, 0, {}, {}, 0, 0, {}},
                          {"finish",
                           step * units,
                           step * units,
                           -drop * units,
                           {step * units, 0.0, -drop * units},
                           {},
                           0,
                           0,
                           {}}};
  return workshop;
}

}  // namespace

TEST_CASE(
    "every joint and support of the general arrangement has its name, beside the others, and a line to it") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (int round = 0; round < 25; ++round) {
    Workshop workshop = row_of_units(5, 1.0, random.between(0.1, 0.5));
    const int places = 2 + round * 2;
    for (int i = 0; i < places; ++i) {
      SettingOutPoint point;
      point.what = (i % 2 == 0 ? "joint " : "support ") + std::to_string(i);
      // Some at one place, some near the ends.
      const double x = random.between(0.0, 1.0) < 0.3 ? (i % 4 < 2 ? 0.0 : 4.4) : random.between(0.0, 4.4);
      point.x = x;
      point.z = -0.2 * x;
      workshop.setting_out.push_back(point);
    }
    for (int i = 0; i < 30; ++i) {
      SettingOutPoint mitre;
      mitre.what = "mitre " + std::to_string(i);
      mitre.x = random.between(0.0, 4.4);
      workshop.setting_out.push_back(mitre);
    }
    const SheetView view = drawing_set(workshop).front().views.front();
    std::map<std::string, Vec2> names;
    for (const DrawnText& text : view.drawing.texts) {
      if (view.drawing.layers[text.layer].name == "JOINTS") CHECK(names.emplace(text.text, text.at).second);
    }
    for (const SettingOutPoint& point : workshop.setting_out) {
      CAPTURE(point.what);
      const bool named = point.what.starts_with("joint") || point.what.starts_with("support");
      CHECK((!named || names.contains(point.what)));
    }
    std::vector<double> across;
    for (const auto& [name, at] : names) {
      across.push_back(at.x);
      // The last of its line ends above it.
      const bool led_to = std::any_of(view.drawing.paths.begin(), view.drawing.paths.end(),
                                      [&, x = at.x, y = at.y](const DrawnPath& drawn) {
                                        const Vec2 end = drawn.path.vertices.back().at;
                                        return view.drawing.layers[drawn.layer].name == "JOINTS" &&
                                               std::fabs((x - end.x) * view.scale - 1.25) < 1e-6 &&
                                               std::fabs((end.y - y) * view.scale - 1.0) < 1e-6;
                                      });
      CHECK(led_to);
    }
    std::sort(across.begin(), across.end());
    for (std::size_t i = 1; i < across.size(); ++i)
      CHECK((across[i] - across[i - 1]) * view.scale > 3.5 - 1e-6);
  }
}

namespace {

/// Lines from numbers to parts, with the balloons in which they begin.
struct Pointed {
  std::vector<Vec2> balloons;
  std::vector<std::pair<Vec2, Vec2>> lines;
  std::map<std::string, int> numbers;
};

Pointed pointed_in(const SheetView& view) {
  Pointed all;
  for (const DrawnText& text : view.drawing.texts) {
    if (view.drawing.layers[text.layer].name == "NUMBERS" && text.text.find('x') == std::string::npos)
      ++all.numbers[text.text];
  }
  for (const DrawnCircle& drawn : view.drawing.circles) {
    if (view.drawing.layers[drawn.layer].name == "NUMBERS" && drawn.circle.radius * view.scale > 1.0)
      all.balloons.push_back(drawn.circle.centre);
  }
  for (const DrawnPath& drawn : view.drawing.paths) {
    if (view.drawing.layers[drawn.layer].name == "NUMBERS")
      all.lines.emplace_back(drawn.path.vertices.front().at, drawn.path.vertices.back().at);
  }
  return all;
}

}  // namespace

TEST_CASE(
    "arrangements of many parts: stretches number every part, lines cross neither one another nor numbers") {
  for (const int units : {4, 11, 12, 20, 45}) {
    for (const double drop : {0.0, 0.4, 1.5}) {
      CAPTURE(units, drop);
      const Workshop workshop = row_of_units(units, 1.0, drop);
      const std::vector<Sheet> set = drawing_set(workshop);
      std::vector<const Sheet*> sheets;
      for (const Sheet& sheet : set) {
        if (says(sheet, "rrangement")) sheets.push_back(&sheet);
      }
      const bool many = workshop.parts.size() > 24;
      CHECK((sheets.size() > 1) == many);
      std::map<std::string, int> numbers;
      int pieces = 0;
      for (std::size_t i = 0; i < sheets.size(); ++i) {
        const SheetView& view = sheets[i]->views.front();
        const Pointed all = pointed_in(view);
        CHECK(all.balloons.size() <= 24);
        REQUIRE(all.lines.size() == all.balloons.size());
        for (std::size_t a = 0; a < all.lines.size(); ++a) {
          for (std::size_t b = 0; b < all.lines.size(); ++b) {
            if (a == b) continue;
            CHECK_FALSE(drawing::lines_cross(all.lines[a].first, all.lines[a].second, all.lines[b].first,
                                             all.lines[b].second));
            CHECK_FALSE(drawing::line_passes(all.lines[a].first, all.lines[a].second, all.balloons[b],
                                             3.5 / view.scale));
          }
        }
        if (many && i == 0) continue;
        CHECK((!many || view.scale > sheets.front()->views.front().scale));
        for (const auto& [number, count] : all.numbers) {
          CHECK(count == 1);
          numbers[number] += count;
        }
        // How many there are stands in the balloon, one alone without.
        pieces += static_cast<int>(all.balloons.size());
        for (const DrawnText& text : view.drawing.texts) {
          if (view.drawing.layers[text.layer].name == "NUMBERS" && text.text.find('x') != std::string::npos)
            pieces += std::stoi(text.text) - 1;
        }
      }
      CHECK(numbers.size() == workshop.parts.size());
      CHECK(pieces == 4 * units);
    }
  }
}

TEST_CASE("of a round pin of facets both sides are drawn where they turn away, and no other facet's edge") {
  constexpr int kSides = 36;
  TriangleMesh mesh;
  for (const double z : {0.0, 0.03}) {
    for (int i = 0; i < kSides; ++i) {
      const double turn = 2.0 * std::numbers::pi * (i + 0.3) / kSides;
      mesh.vertices.push_back({0.003 * std::cos(turn), 0.003 * std::sin(turn), z});
    }
  }
  const auto corner = [](int ring, int i) { return static_cast<std::uint32_t>(ring * kSides + i % kSides); };
  for (int i = 0; i < kSides; ++i) {
    mesh.triangles.push_back({corner(0, i), corner(0, i + 1), corner(1, i + 1)});
    mesh.triangles.push_back({corner(0, i), corner(1, i + 1), corner(1, i)});
    if (i < 2) continue;
    mesh.triangles.push_back({corner(0, 0), corner(0, i), corner(0, i - 1)});
    mesh.triangles.push_back({corner(1, 0), corner(1, i - 1), corner(1, i)});
  }
  Workshop workshop;
  workshop.parts.push_back(testing::shop_part(1, "pin", MeshBody{mesh}));
  std::vector<double> sides;
  for (const DrawnPath& drawn : side_view(workshop).paths) {
    const PlaneBox box = bounds(drawn.path);
    if (box.height() > 29.9) sides.push_back(box.low.x);
  }
  REQUIRE(sides.size() == 2);
  CHECK(std::fabs(sides[0] - sides[1]) == Approx(6.0).margin(0.05));
}
