// How far apart trestles stand.

#include "glissade/centerline/clothoid_spline.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/parts/plates.hpp"
#include "glissade/pipeline.hpp"

#include "parts/chute_plates.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/shortfalls.hpp"
#include "support/thorough.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

using namespace glissade;
using namespace testing;

namespace {

std::vector<double> places_of(const WorkshopBuild& build) {
  std::vector<double> places;
  for (const SettingOutPoint& point : build.workshop.setting_out) {
    if (point.what.rfind("support ", 0) == 0) places.push_back(point.arc_length);
  }
  REQUIRE(std::is_sorted(places.begin(), places.end()));
  return places;
}

/// The longest stretch of track between two trestles [m].
double widest_span(const WorkshopBuild& build) {
  const std::vector<double> places = places_of(build);
  double widest = 0.0;
  for (std::size_t i = 1; i < places.size(); ++i) widest = std::max(widest, places[i] - places[i - 1]);
  return widest;
}

bool tells_of_spans(const WorkshopBuild& build) {
  return !shortfall_of(build.workshop, "spacing: supports ").empty();
}

/// @param which  "above support 1"
bool tells_of_end(const WorkshopBuild& build, const std::string& which) {
  const std::vector<std::string> all = shortfalls_of(build.workshop, "spacing: the track sticks out by ");
  return std::any_of(all.begin(), all.end(),
                     [&](const std::string& told) { return told.find(" " + which) != std::string::npos; });
}

std::string last_of(const std::vector<double>& row) {
  return "below support " + std::to_string(row.size()) + ",";
}

/// What spans of a row are wider than asked for, by squares; ends that stick out count twice.
double excess(const std::vector<double>& row, double spacing, double length) {
  std::vector<double> spans = {2.0 * row.front(), 2.0 * (length - row.back())};
  for (std::size_t i = 1; i < row.size(); ++i) spans.push_back(row[i] - row[i - 1]);
  double sum = 0.0;
  for (const double span : spans) sum += std::pow(std::max(0.0, span - spacing), 2.0);
  return sum;
}

/// Straight, a bend and straight: lined, framed, on a bent floor, of which trestles find few places.
WorkshopBuild crowded(double spacing, const std::vector<Vec2>& ground = {{0.0, -8.0}}) {
  const ClothoidSpline track(Angle::from_degrees(58.0), {{1.5, 0.0}, {2.0, 0.2}, {2.5, 0.0}});
  PlateOptions options;
  options.floor = FloorMake::bent;
  options.split.longest = 2.2;
  options.flanges = {true, 60e-3, 8e-3, 12, 160e-3};
  options.liner.emplace();
  options.liner->tile_length = 0.35;
  options.rim.emplace();
  options.stiffeners.emplace();
  options.stiffeners->spacing = 0.7;
  options.supports.emplace();
  options.supports->ground = ground;
  options.supports->spacing = spacing;
  return plates(track, options);
}

}  // namespace

TEST_CASE("trestles are no farther apart than is asked for, or a note says where and why") {
  Random random = seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  PlateOptions options;
  options.split.longest = 2.9;
  options.supports.emplace();
  options.supports->ground = {{0.0, -6.2}};
  bool kept = false;
  bool told = false;
  for (int i = 0; i < (testing::thorough() ? 12 : 3); ++i) {
    options.stiffeners.reset();
    if (i % 2 == 1) options.stiffeners.emplace();
    options.supports->spacing = i == 0 ? 0.25 : i == 1 ? 1.8 : random.between(0.25, 3.0);
    INFO("spacing " << options.supports->spacing << (options.stiffeners ? ", stiffeners" : ""));
    const WorkshopBuild build = plates(chute(), options);
    const bool wide = widest_span(build) > options.supports->spacing + 1e-3;
    CHECK(wide == tells_of_spans(build));
    const std::vector<double> row = places_of(build);
    const double length = build.master.spline->length();
    const double most = 0.5 * options.supports->spacing + 1e-3;
    // Places as they are measured on the parts are a few millimetres off those along the track.
    constexpr double kClose = 5e-3;
    if (std::fabs(row.front() - most) > kClose)
      CHECK((row.front() > most) == tells_of_end(build, "above support 1,"));
    if (std::fabs(length - row.back() - most) > kClose)
      CHECK((length - row.back() > most) == tells_of_end(build, last_of(row)));
    kept = kept || !wide;
    told = told || wide;
  }
  CHECK(kept);
  CHECK(told);
}

TEST_CASE("trestles: braces are bolted wherever they end, two that share a place by one bolt") {
  Random random = seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  std::size_t shared = 0;
  for (int i = 0; i < 3; ++i) {
    const WorkshopBuild build = crowded(1.5, {{0.0, -random.between(6.0, 14.0)}});
    std::map<std::string, std::size_t> braces;  // of each trestle
    std::size_t holes = 0;
    for (const ShopPart& part : build.workshop.parts) {
      if (!part.name.starts_with("brace")) continue;
      braces[part.name] += part.quantity();
      holes += part.quantity() * part.pattern->region.holes.size();
    }
    REQUIRE_FALSE(braces.empty());
    std::size_t wanted = 0;
    for (const auto& [name, count] : braces) wanted += 2 * (count / 2 + 1);
    std::map<std::string, std::size_t> bought;
    for (const BoughtInItem& item : build.workshop.items) {
      if (item.where == "braces") bought[item.name.substr(0, item.name.find(' '))] += item.quantity;
    }
    CAPTURE(braces.size(), holes);
    CHECK(bought["bolt"] == wanted);
    CHECK(bought["nut"] == wanted);
    CHECK(bought["washer"] == 2 * wanted);
    CHECK(holes == 2 * wanted - 4 * braces.size());
    shared += holes - wanted;
  }
  CHECK(shared > 0);
}

TEST_CASE("trestles: what stands closer than is asked for shows which places are free, and they are found") {
  std::vector<std::vector<double>> rows;
  const std::vector<double> spacings = {0.5, 1.2, 2.0, 3.0};
  double length = 0.0;
  for (const double spacing : spacings) {
    const WorkshopBuild build = crowded(spacing);
    length = build.master.spline->length();
    rows.push_back(places_of(build));
    REQUIRE_FALSE(rows.back().empty());
    CHECK((widest_span(build) > spacing + 1e-3) == tells_of_spans(build));
    CHECK((rows.back().front() > 0.5 * spacing + 1e-3) == tells_of_end(build, "above support 1,"));
    CHECK((length - rows.back().back() > 0.5 * spacing + 1e-3) == tells_of_end(build, last_of(rows.back())));
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (const auto& other : rows) {
      INFO("spacing " << spacings[i]);
      CHECK(excess(rows[i], spacings[i], length) <= excess(other, spacings[i], length) + 1e-3);
    }
  }
  CHECK(rows[2].size() > 1);
}

TEST_CASE(
    "trestles: one that would stand beyond the line of the ground is refused, told from where to where") {
  const auto told = [&](const std::vector<Vec2>& ground) {
    return refusal_of([&] { return crowded(2.0, ground); });
  };
  const std::string ends = told({{-1.0, -6.0}, {2.0, -8.0}});
  CHECK(ends.find("supports.ground|ground: its line ends 2 m from the start along the run, and a trestle "
                  "stands at ") == 0);
  CHECK(ends.find("a line as far as ") != std::string::npos);
  // The line that is told does.
  const std::size_t hint = ends.find("a line as far as ") + 17;
  CHECK(told({{-1.0, -6.0}, {std::stod(ends.substr(hint)), -8.0}}).empty());
  CHECK(told({{3.0, -8.0}, {9.0, -8.0}}).find("its line begins 3 m from the start along the run") !=
        std::string::npos);
  CHECK(told({{-1.0, -8.0}, {9.0, -8.0}}).empty());
}

TEST_CASE("trestles: one more stands where the places that are free would leave a span too wide") {
  PlateOptions options;
  options.split.longest = 2.9;
  options.stiffeners.emplace();
  options.supports.emplace();
  options.supports->ground = {{0.0, -6.2}};
  for (const double spacing : {1.6, 1.8, 1.9, 2.2}) {
    INFO("spacing " << spacing);
    options.supports->spacing = spacing;
    CHECK(widest_span(plates(chute(), options)) <= spacing + 1e-9);
  }
}

TEST_CASE("trestles: beams of any width stand clear of a steep track, its frames and what is welded to it") {
  PlateOptions options;
  options.split.longest = 2.9;
  options.liner.emplace();
  options.rim.emplace();
  options.stiffeners.emplace();
  options.supports.emplace();
  SupportOptions& supports = *options.supports;
  supports.ground = {{0.0, -8.2}};
  supports.steepest = Angle::from_degrees(66.0);
  const auto set = [&](double spacing, double tube) {
    supports.spacing = spacing;
    supports.tube = tube;
    INFO("spacing " << spacing << ", tube " << tube);
    // Throws InternalError where one reaches into another.
    CHECK(!named(plates(chute(), options), "beam").empty());
  };
  for (const FloorMake floor : {FloorMake::rolled, FloorMake::bent}) {
    options.floor = floor;
    if (floor == FloorMake::rolled || testing::thorough()) set(1.687, 100e-3);
    // The widest and the narrowest below a rolled floor, the other below a bent one, elsewhere than in CI.
    for (const double tube : {80e-3, 110e-3, 150e-3}) {
      if (testing::thorough() || (tube == 110e-3) == (floor == FloorMake::bent)) set(1.9, tube);
    }
  }
}

TEST_CASE("trestles carry a track with grooves, thin or thick below them, on the underside of its outline") {
  PlateOptions options;
  options.supports.emplace();
  options.supports->ground = {{0.0, -8.2}};
  options.supports->spacing = 1.5;
  options.supports->steepest = Angle::from_degrees(75.0);
  for (const FloorMake floor : {FloorMake::rolled, FloorMake::bent}) {
    options.floor = floor;
    for (const double thickness : {0.03, 0.04, 0.12}) {
      INFO("thickness " << thickness);
      if (!testing::thorough() && (thickness == 0.04) != (floor == FloorMake::bent)) continue;
      section::TrackGroove track;
      track.width = WidthLaw(0.4);
      track.groove_width = 0.08;
      track.groove_depth = 0.04;
      track.groove_spacing = 0.2;
      track.thickness = thickness;
      // Throws InternalError where one reaches into another.
      const WorkshopBuild build = plates_of(chute(), track, options);
      CHECK(named(build, "saddle").size() >= 2);
      CHECK_FALSE(named(build, "frame").empty());
    }
  }
}

TEST_CASE("trestles: saddles stand beside stiffeners that lean over them") {
  const Design design = parse_design(
      "glissade: 1\n"
      "track: {start: {x: -4 m, z: 0 m}}\n"
      "body: {friction_angle: 8 deg, entry_speed: 0.5 m/s}\n"
      "centerline:\n"
      "  kind: segments\n"
      "  entry_slope_angle: 35 deg\n"
      "  segments:\n"
      "    - {length: 0.5 m}\n"
      "    - {to_slope_angle: 50 deg, radius: -7.5 m}\n"
      "    - {to_slope_angle: 25 deg, radius: 3 m}\n"
      "    - {to_slope_angle: 35 deg, radius: -10 m}\n"
      "    - {length: 0.5 m}\n"
      "    - {to_slope_angle: 15 deg, radius: 4.5 m}\n"
      "cross_section: {kind: pipe, inner_diameter: 420 mm, thickness: 8 mm}\n"
      "fabrication:\n"
      "  process: plate\n"
      "  floor: bent\n"
      "  round: staves\n"
      "  stiffeners: {spacing: 600 mm}\n"
      "  supports: {ground: -9.5 m, spacing: 0.9 m, steepest: 75 deg}\n"
      "mesh: {tolerance: 3 mm}\n"
      "export: [tables]\n",
      "pipe.yaml");
  // Throws InternalError where one reaches into another.
  const Assembly assembly = assemble(design, solve(design));
  REQUIRE(assembly.fabrication);
  CHECK_FALSE(named(*assembly.fabrication, "saddle").empty());
}

TEST_CASE("trestles: base plates of both legs lie beside each other, however thin tubes and section are") {
  const CoulombBrachistochrone track({0.95, 1.25}, Friction::from_angle(Angle::from_degrees(24.0)));
  PlateOptions options;
  options.round = RoundMake::mitred;
  options.bend = {FacetRule::segment_angle, Angle::from_degrees(7.5).radians(), {}, {}};
  options.supports.emplace();
  options.supports->ground = {{0.0, -5.0}};
  for (const double tube : {40e-3, 50e-3, 60e-3}) {
    INFO("tube " << tube);
    options.supports->tube = tube;
    const WorkshopBuild build = plates_of(track, section::Pipe{0.15, 2e-3}, options);
    for (const ShopPart* const plate : named(build, "base_plate")) {
      REQUIRE(plate->places.size() % 2 == 0);
      const double apart = plate->places[0].origin.y - plate->places[1].origin.y;
      CHECK(std::fabs(apart) >= bounds(plate->pattern->region.outline).width() + 10e-3 - 1e-9);
    }
  }
}

TEST_CASE("trestles: what is told of wide spans names the supports, the bound, and a spacing that does") {
  const double spacing = 0.5;
  const WorkshopBuild build = crowded(spacing);
  const std::vector<double> row = places_of(build);
  const std::string span = shortfall_of(build.workshop, "spacing: supports ");
  INFO(span);
  const auto supports = [](std::size_t i) { return std::to_string(i) + " and " + std::to_string(i + 1); };
  std::size_t widest = 1;
  for (std::size_t i = 1; i < row.size(); ++i) {
    if (row[i] - row[i - 1] > row[widest] - row[widest - 1]) widest = i;
  }
  CHECK(span.find("supports.spacing|spacing: supports " + supports(widest) + " are ") == 0);
  CHECK(span.find(", for 500 mm") != std::string::npos);
  CHECK(span.find("|Frames, stiffeners, openings, bends or other trestles leave no place between them.|") !=
        std::string::npos);
  // The largest spacing that is named does, and no less does by much.
  double enough = 0.0;
  for (const std::string& told : shortfalls_of(build.workshop, "spacing: ")) {
    const std::size_t hint = told.rfind("|spacing: ") + 10;
    const bool millimetres = told.find(" mm", hint) < told.find(',', hint);
    enough = std::max(enough, std::stod(told.substr(hint)) * (millimetres ? 1e-3 : 1.0));
  }
  CHECK(shortfalls_of(crowded(enough).workshop, "spacing: ").empty());
  CHECK_FALSE(shortfalls_of(crowded(0.9 * enough).workshop, "spacing: ").empty());
}

TEST_CASE("trestles: an end that sticks out where the track is steep is told with its slope and the bound") {
  PlateOptions options;
  options.split.longest = 2.9;
  options.flanges.wanted = false;
  options.supports.emplace();
  options.supports->ground = {{0.0, -6.2}};
  options.supports->spacing = 1.0;
  options.supports->steepest = Angle::from_degrees(40.0);
  const WorkshopBuild build = plates(chute(), options);
  const double first = places_of(build).front();
  const std::string end = shortfall_of(build.workshop, "spacing: the track sticks out by ");
  INFO(end);
  const std::size_t at = end.find(" above support 1, at ");
  REQUIRE(at != std::string::npos);
  // Places as they are measured on the parts are a few millimetres off those along the track.
  CHECK(std::fabs(std::stod(end.substr(at + 21)) - first) < 5e-3);
  CHECK(end.find(" m along it, for 500 mm, half of 1 m|Nearer to its end it is ") != std::string::npos);
  CHECK(end.find(
            " deg steep or steeper, and a trestle stands below no more than 40 deg (steepest).|spacing: ") !=
        std::string::npos);
  CHECK(end.ends_with(", a larger steepest, or a support of your own that holds the end"));
}
