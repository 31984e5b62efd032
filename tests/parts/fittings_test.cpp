// What is set on a channel: liner, rims, covers, openings, lugs, stiffeners, trestles. Every build of these proves that no two
// parts clash.

#include "glissade/centerline/clothoid_spline.hpp"
#include "glissade/centerline/coulomb_brachistochrone.hpp"
#include "glissade/core/error.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/quantity.hpp"
#include "glissade/parts/plates.hpp"

#include "parts/chute_plates.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/shortfalls.hpp"
#include "support/thorough.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace fittings_test {

namespace {

using namespace glissade;
using namespace testing;

PlateOptions with_everything() {
  PlateOptions options;
  options.split.longest = 2.9;
  options.rim.emplace();
  options.stiffeners.emplace();
  options.liner.emplace();
  options.cover.emplace();
  options.inspection = {{4.5, 0.2, 0.12, 8}};
  options.lifting.emplace();
  options.supports.emplace();
  options.supports->ground = {{0.0, -6.2}};
  return options;
}

/// @return the place along the track nearest to a point, to 0.1 mm
double nearest_to(const WorkshopBuild& build, Vec3 point) {
  const ArcSpline& track = *build.master.spline;
  double nearest = 0.0;
  double least = HUGE_VAL;
  const auto look = [&](double from, double to) {
    constexpr int kSteps = 400;
    for (int k = 0; k <= kSteps; ++k) {
      const double s = from + (to - from) * k / kSteps;
      const CenterlinePoint here = track.at(s);
      const double off = std::hypot(here.x - point.x, -here.drop - point.z);
      if (off < least) std::tie(least, nearest) = std::pair(off, s);
    }
  };
  look(0.0, track.length());
  const double about = nearest;
  look(std::max(0.0, about - 0.01 * track.length()), std::min(track.length(), about + 0.01 * track.length()));
  return nearest;
}

}  // namespace

TEST_CASE("liner: its face is the track, the floor lies below it, and tiles and floors have the same holes") {
  PlateOptions options;
  options.liner.emplace();
  options.liner->heaviest = 5.0;
  const WorkshopBuild build = plates(chute(), options);
  const WorkshopBuild plain = plates(chute(), {});
  CHECK(std::fabs(build.ride.exit_speed / plain.ride.exit_speed - 1.0) < 1e-9);
  std::size_t tile_holes = 0;
  double tiled = 0.0;
  for (const ShopPart* tile : named(build, "tile")) {
    CHECK(tile->mass <= 5.0);
    CHECK(tile->material == "400 HB");
    const PlaneBox box = bounds(tile->pattern->region.outline);
    CHECK(box.width() <= 0.6 + 1e-3);
    CHECK(box.height() <= 0.2);
    tile_holes += tile->pattern->region.holes.size() * tile->quantity();
    tiled += box.width() * box.height() * static_cast<double>(tile->quantity());
  }
  std::size_t floor_holes = 0;
  for (const ShopPart* floor : named(build, "floor"))
    floor_holes += floor->pattern->region.holes.size() * floor->quantity();
  CHECK(tile_holes == floor_holes);
  CHECK(tile_holes > 50);
  // They cover the floor but for gaps of 2 mm: three or four across 400 mm, one between courses.
  const double covered = tiled / (kChannel.width * build.master.spline->length());
  CHECK(covered > 0.970);
  CHECK(covered < 0.985);
  std::size_t bolts = 0;
  for (const BoughtInItem& item : build.workshop.items) {
    if (item.name.starts_with("countersunk")) bolts = item.quantity;
  }
  CHECK(bolts == tile_holes);
}

TEST_CASE("liner: seams of one course lie in the middle of the next one's tiles") {
  PlateOptions options;
  options.liner.emplace();
  const WorkshopBuild build = plates(chute(), options);
  // Places across of the left edges of tiles, by course.
  const auto seams = [&](const std::string& course) {
    std::vector<double> places;
    for (const ShopPart& part : build.workshop.parts) {
      if (part.name != "tile_" + course && part.name != "tile_" + course + "_half") continue;
      for (const Frame& place : part.places) places.push_back(place.origin.y);
    }
    std::sort(places.begin(), places.end());
    return places;
  };
  const std::vector<double> even = seams("1");
  const std::vector<double> odd = seams("2");
  REQUIRE(even.size() == 2);
  REQUIRE(odd.size() == 3);
  for (const double a : even) {
    for (const double b : odd) {
      if (std::fabs(std::fabs(a) - 0.2) < 0.01 || std::fabs(std::fabs(b) - 0.2) < 0.01) continue;
      CHECK(std::fabs(a - b) > 0.04);
    }
  }
}

TEST_CASE("trestles: legs stand from their base plates to the beam, saddles fit the underside") {
  PlateOptions options;
  options.supports.emplace();
  options.supports->ground = {{0.0, -7.0}, {6.0, -6.0}};
  const WorkshopBuild build = plates(chute(), options);
  const std::vector<const ShopPart*> plates_below = named(build, "base_plate");
  REQUIRE(plates_below.size() == 1);
  const std::vector<const ShopPart*> saddles = named(build, "saddle");
  CHECK(plates_below.front()->quantity() == 2 * saddles.size());
  CHECK(plates_below.front()->pattern->region.holes.size() == 4);
  for (const Frame& place : plates_below.front()->places) {
    // Grout of at least 25 mm on a ground that rises from -7 m to -6 m.
    const double ground = -7.0 + place.origin.x / 6.0;
    CHECK(place.origin.z - ground >= 25e-3 - 1e-9);
    CHECK(place.origin.z - ground < 60e-3);
  }
  const ArcSpline& line = *build.master.spline;
  for (const ShopPart* saddle : saddles) {
    // Each point of its upper edge is a plate's thickness below the track.
    const Prism& body = std::get<Prism>(saddle->body);
    double nearest = 1.0;
    for (const PathVertex& vertex : body.region.outline.vertices) {
      const Vec3 at = saddle->places.front().to_space({vertex.at.x, vertex.at.y, 0.0});
      double least = 1e9;
      for (int k = 0; k <= 20000; ++k) {
        const CenterlinePoint point = line.at(std::min(line.length(), line.length() * k / 20000.0));
        least = std::min(least, std::hypot(point.x - at.x, -point.drop - at.z));
      }
      nearest = std::min(nearest, least);
    }
    CHECK(std::fabs(nearest - 4e-3) < 1e-4);
  }
  std::size_t set_out = 0;
  for (const SettingOutPoint& row : build.workshop.setting_out) {
    if (!row.what.starts_with("support")) continue;
    ++set_out;
    INFO(row.what);
    // Plumb above the middle of base plates whose underside has the level that is told.
    const double foot = std::stod(row.what.substr(row.what.find("foot z ") + 7)) * 1e-3;
    double off = 1.0;
    for (const Frame& place : plates_below.front()->places) {
      const PlaneBox plate = bounds(plates_below.front()->pattern->region.outline);
      const Vec2 middle = 0.5 * (plate.low + plate.high);
      const Vec3 at = place.to_space({middle.x, middle.y, 0.0});
      const Vec3 other = place.to_space({middle.x, middle.y, plates_below.front()->thickness});
      if (std::fabs(std::min(at.z, other.z) - foot) < 1e-5) off = std::min(off, std::fabs(at.x - row.x));
    }
    CHECK(off < 1e-9);
    CHECK(row.what.find("middle x " + rounded_text(row.x * 1e3, 6) + ", ") != std::string::npos);
  }
  CHECK(set_out == saddles.size());
  CHECK_FALSE(named(build, "brace").empty());
}

TEST_CASE("lugs: plumb above the centre of gravity of what they lift, where the unit allows") {
  PlateOptions options = with_everything();
  options.supports.reset();
  const WorkshopBuild build = plates(chute(), options);
  const std::vector<const ShopPart*> lugs = named(build, "lug");
  CHECK(lugs.size() == build.joints.size() - 1);
  // Of the last unit, which is the flattest, by all parts that lie on it.
  Vec3 moment;
  double mass = 0.0;
  const double from = build.joints[build.joints.size() - 2];
  for (const ShopPart& part : build.workshop.parts) {
    if (part.name.starts_with("lug")) continue;
    for (const Frame& place : part.places) {
      const Frame& first = part.places.front();
      const Vec3 away = part.centre_of_gravity - first.origin;
      const Vec3 centre = place.to_space({dot(away, first.x), dot(away, first.y), dot(away, first.z)});
      if (nearest_to(build, centre) < from) continue;
      mass += part.mass;
      moment = moment + part.mass * centre;
    }
  }
  const Vec3 centre = (1.0 / mass) * moment;
  // It hangs from their eyes, which stand square to the track above the walls.
  const Circle eye = lugs.back()->pattern->region.holes.front();
  const Vec3 hung = lugs.back()->places.front().to_space({eye.centre.x, eye.centre.y, 0.0});
  CAPTURE(mass, centre.x, hung.x);
  CHECK(std::fabs(hung.x - centre.x) < 2e-3);
  for (const ShopPart* lug : lugs) CHECK(lug->quantity() == 2);
}

namespace {

double metres(const std::string& text) {
  return parse_quantity(text, Dimension::length, "length");
}

/// Where stiffeners stand along the track, by the middles of their thickness.
std::vector<double> stiffeners_along(const WorkshopBuild& build) {
  std::vector<double> all;
  for (const ShopPart& part : build.workshop.parts) {
    if (!part.name.starts_with("stiffener")) continue;
    for (const Frame& place : part.places)
      all.push_back(nearest_to(build, place.origin + 0.5 * part.thickness * place.z));
  }
  std::sort(all.begin(), all.end());
  return all;
}

}  // namespace

TEST_CASE(
    "stiffeners are no farther apart than asked for, wherever openings are, or the widest gap is told") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  int wide = 0;
  for (int i = 0; i < (testing::thorough() ? 24 : 4); ++i) {
    PlateOptions options;
    options.split.longest = random.between(1.0, 3.0);
    options.stiffeners.emplace();
    options.stiffeners->spacing = random.between(0.2, 0.9);
    options.inspection = {{random.between(1.0, 5.5), random.between(0.2, 0.8), 0.1, 8}};
    INFO(i << ": units of " << *options.split.longest << " m, spacing " << options.stiffeners->spacing
           << " m, an opening of " << options.inspection.front().length << " m at "
           << options.inspection.front().at << " m");
    std::optional<WorkshopBuild> build;
    try {
      build = plates(chute(), options);
    } catch (const InputError&) {
      continue;  // a lid across a joint
    }
    constexpr double kStep = 1e-4;  // of the places that are looked at
    std::vector<double> ends = stiffeners_along(*build);
    for (std::size_t k = 1; k < ends.size(); ++k) CHECK(ends[k] - ends[k - 1] >= 0.06 - kStep);
    ends.insert(ends.end(), build->joints.begin(), build->joints.end());
    std::sort(ends.begin(), ends.end());
    double widest = 0.0;
    for (std::size_t k = 1; k < ends.size(); ++k) widest = std::max(widest, ends[k] - ends[k - 1]);
    const std::string told = shortfall_of(build->workshop, "spacing: stiffeners");
    CAPTURE(widest, told);
    CHECK(told.empty() == (widest <= options.stiffeners->spacing + kStep));
    if (told.empty()) continue;
    ++wide;
    const std::string kBegins = "stiffeners.spacing|spacing: stiffeners and ends of units are ";
    REQUIRE(told.starts_with(kBegins));
    const double apart = metres(told.substr(kBegins.size(), told.find(" apart, for ") - kBegins.size()));
    CHECK(apart == Approx(widest).margin(1e-3));
    // What it says to try does.
    const std::size_t from = told.find("|spacing: ", 60) + 10;
    options.stiffeners->spacing = metres(told.substr(from, told.find(',', from) - from));
    CHECK(shortfall_of(plates(chute(), options).workshop, "spacing: stiffeners").empty());
  }
  CAPTURE(wide);
  if (testing::thorough()) CHECK(wide > 0);
}

TEST_CASE("lugs and stiffeners of a channel that find no place are told with the units and places, and why") {
  PlateOptions options;
  options.split.longest = 0.5;
  options.lifting.emplace();
  options.stiffeners.emplace();
  options.stiffeners->spacing = 0.1;
  const WorkshopBuild crowded = plates(chute(), options);
  CHECK(named(crowded, "lug").empty());
  const std::string lugs = shortfall_of(crowded.workshop, "lifting: ");
  INFO(lugs);
  CHECK(lugs.starts_with("lifting|lifting: no lugs on units 1 ("));
  CHECK(lugs.find(" kg), 2 (") != std::string::npos);
  CHECK(lugs.find(std::to_string(crowded.joints.size() - 1 - 6) +
                  " more|Frames, stiffeners, bolts and openings leave no 80 mm of the track free, which a "
                  "pair of them "
                  "takes.|longer units (split.longest)") != std::string::npos);
  // Of thick plates in a hollow the gap would close.
  const ClothoidSpline track(Angle::from_degrees(60.0), {{1.0, 0.0, 0.0}, {0.5, 1.5, 1.5}, {1.0, 0.0, 0.0}});
  options = {};
  options.split.longest = 3.0;
  options.stiffeners.emplace();
  options.stiffeners->spacing = 0.4;
  options.stiffeners->thickness = 30e-3;
  const WorkshopBuild bent = plates(track, options);
  const std::string stiffeners = shortfall_of(bent.workshop, "spacing: stiffeners");
  INFO(stiffeners);
  CHECK(stiffeners.starts_with("stiffeners.spacing|spacing: stiffeners and ends of units are "));
  CHECK(stiffeners.find(" apart, for 400 mm, along the track from ") != std::string::npos);
  CHECK(stiffeners.find("|Over their thickness of 30 mm plates bend there by more than the gap of ") !=
        std::string::npos);
  CHECK(stiffeners.ends_with(
      ", a smaller thickness, a larger flanges.gap, openings elsewhere, or no stiffeners"));
  options.stiffeners->thickness = 6e-3;
  CHECK(shortfalls_of(plates(track, options).workshop).empty());
}

TEST_CASE("lugs of a channel that are not plumb above the centre of gravity are told so") {
  PlateOptions options;
  options.split.longest = 0.7;
  options.lifting.emplace();
  const WorkshopBuild build = plates(chute(), options);
  const auto noted = [&](const std::string& unit) {
    for (const std::string& note : build.workshop.notes) {
      if (note.starts_with(unit)) return note;
    }
    return std::string();
  };
  CHECK(noted("Unit 1: ").ends_with(" from plumb above its centre of gravity."));
  CHECK(noted("Unit " + std::to_string(build.joints.size() - 1) + ": ")
            .ends_with(" along the track, beside its centre of gravity."));
}

TEST_CASE("units without frames are told to be welded end to end, of every kind of plates") {
  PlateOptions options;
  options.split.longest = 2.9;
  const auto noted = [&](const WorkshopBuild& build) {
    const auto& notes = build.workshop.notes;
    return std::count(notes.begin(), notes.end(),
                      "Without frames units are welded end to end, all round: 2 joints.");
  };
  CHECK(noted(plates(chute(), options)) == 0);
  options.flanges.wanted = false;
  CHECK(noted(plates(chute(), options)) == 1);
  CHECK(noted(plates_of(chute(), v_channel(), options)) == 1);
  options.round = RoundMake::mitred;
  CHECK(noted(plates_of(chute(), section::HalfPipe{0.4, 0.05, 4e-3}, options)) == 1);
  options.split.longest.reset();
  options.split.sheet = {12.0, 2.0};
  const WorkshopBuild whole = plates(chute(), options);
  CHECK(whole.joints.size() == 2);
  CHECK(noted(whole) == 0);
}

TEST_CASE("covers and rims: as many holes in one as in the other; lids cover their openings") {
  const WorkshopBuild build = plates(chute(), with_everything());
  std::size_t rim_holes = 0;
  std::size_t cover_holes = 0;
  for (const ShopPart* part : named(build, "rim"))
    rim_holes += part->pattern->region.holes.size() * part->quantity();
  for (const ShopPart* part : named(build, "cover"))
    cover_holes += part->pattern->region.holes.size() * part->quantity();
  CHECK(rim_holes == cover_holes);
  CHECK(rim_holes > 20);
  const std::vector<const ShopPart*> left = named(build, "left_wall");
  REQUIRE(left.size() == 1);
  REQUIRE(left.front()->pattern->region.cutouts.size() == 1);
  const std::vector<const ShopPart*> lids = named(build, "lid");
  REQUIRE(lids.size() == 1);
  CHECK(lids.front()->pattern->region.holes.size() == left.front()->pattern->region.holes.size());
  CHECK(std::fabs(moments({left.front()->pattern->region.cutouts.front(), {}, {}}).area - 0.2 * 0.12) < 1e-9);
}

TEST_CASE("fittings: random ones on random tracks fit without a clash") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (int run = 0; run < 8; ++run) {
    const double size = random.between(4.0, 10.0);
    std::vector<ClothoidSegment> segments;
    for (int i = random.integer(1, 3); i > 0; --i) {
      const double curvature = random.between(-0.1, 0.9) / size;
      segments.push_back({random.between(0.2, 0.4) * size, curvature, curvature});
    }
    const ClothoidSpline track(Angle::from_degrees(random.between(30.0, 50.0)), segments);
    PlateOptions options;
    const auto maybe = [&] { return random.integer(0, 2) > 0; };
    options.split.longest = random.between(1.2, 2.9);
    options.rim.emplace();
    if (maybe()) options.stiffeners.emplace();
    if (maybe()) options.liner.emplace();
    if (maybe()) options.cover.emplace();
    if (maybe()) options.lifting.emplace();
    options.supports.emplace();
    options.supports->ground = {{0.0, -1.2 * size}};
    options.supports->spacing = random.between(0.8, 2.5);
    const ChannelMeasures channel{random.between(0.3, 0.8), random.between(0.15, 0.3),
                                  random.between(3e-3, 6e-3)};
    const WorkshopBuild build = plates(track, options, channel);
    CHECK(build.proof.pairs > 50);
    for (const ShopPart& part : build.workshop.parts) {
      CHECK(part.mass > 0.0);
      if (part.pattern) CHECK(faults_of(part.pattern->region).empty());
    }
  }
}

TEST_CASE("fittings: covers that no sheet takes in one are pieces side by side, as heavy as a part may be") {
  PlateOptions options;
  options.rim.emplace();
  options.cover.emplace();
  // The floor goes across the sheet, the cover over the rims does not.
  const ChannelMeasures wide{1.45, 0.25, 4e-3};
  for (const bool lean : {false, true}) {
    for (const FloorMake floor : {FloorMake::rolled, FloorMake::bent}) {
      options.floor = floor;
      const WorkshopBuild build =
          lean ? plates_of(chute(), section::Trapezoid{WidthLaw(1.45), 0.25, Angle::from_degrees(5.0), 4e-3},
                           options)
               : plates(chute(), options, wide);
      const std::vector<const ShopPart*> covers = named(build, "cover");
      CHECK(covers.size() > build.joints.size() - 1);
      for (const ShopPart* const cover : covers) {
        const PlaneBox box = bounds(cover->pattern->region.outline);
        CHECK(std::min(box.width(), box.height()) <= 1.49 + 1e-9);
        CHECK(cover->pattern->region.holes.size() >= 4);
      }
      CHECK(build.proof.bolted > 0);
    }
  }
  options = PlateOptions();
  options.rim.emplace();
  options.cover.emplace();
  options.split.heaviest = 15.0;
  const WorkshopBuild light = plates(chute(), options, {1.2, 0.25, 2e-3});
  for (const ShopPart* const cover : named(light, "cover")) CHECK(cover->mass <= 15.0);
}

TEST_CASE("fittings: what cannot be made is refused with place, value, bound and way out") {
  SupportOptions on_high_ground;
  on_high_ground.ground = {{0.0, -3.0}};
  PlateOptions above;
  above.supports = on_high_ground;
  CHECK(refusal(above).find("supports.ground|ground: at ") == 0);
  CHECK(refusal(above).find("a lower ground") != std::string::npos);
  PlateOptions cover;
  cover.cover.emplace();
  CHECK(refusal(cover).find("cover|cover: it is bolted to a rim, and there is none") == 0);
  cover.rim.emplace();
  for (const double slip : {0.3, 2.0}) {
    cover.cover->thickness = slip;
    CHECK(refusal(cover).find("cover.thickness|thickness: " + std::string(slip > 1.0 ? "2 m" : "300 mm") +
                              " is more than the rim below it is wide, 40 mm|") == 0);
    CHECK(refusal_of([&] { return plates_of(chute(), v_channel(), cover); }).find("cover.thickness|") == 0);
  }
  PlateOptions slips;
  slips.liner.emplace();
  slips.liner->thickness = 2.0;
  slips.lifting.emplace();
  slips.lifting->thickness = 2.0;
  slips.inspection = {{3.0, 0.2, 0.12, 8}};
  const std::string bounds = refusal(slips);
  CHECK(bounds.find("liner.thickness|thickness: 2 m is more than a tile is wide, 200 mm|") !=
        std::string::npos);
  CHECK(bounds.find("lifting.thickness|thickness: 2 m is more than a lug is wide, 80 mm|") !=
        std::string::npos);
  // Those of bent floors are bounded as the sections of strips.
  slips.floor = FloorMake::bent;
  slips.lifting.reset();
  CHECK(refusal(slips).find("liner.thickness|thickness: 2 m is more than a tile is wide, 200 mm|") !=
        std::string::npos);
  CHECK(refusal(slips).find("inspection|") == std::string::npos);
  PlateOptions bent;
  bent.floor = FloorMake::bent;
  bent.liner.emplace();
  CHECK(refusal(bent, {0.4, 0.06, 4e-3, 20e-3})
            .find("liner|liner: curbs follow the track where tiles would follow the flats of a bent floor|"
                  "Curbs are cut along arcs; between bends tiles would leave them.|") == 0);
  PlateOptions high;
  high.inspection = {{3.0, 0.2, 0.24, 8}};
  CHECK(refusal(high).find("inspection|height: 240 mm leaves too little of the wall, 250 mm|") == 0);
  CHECK(refusal(high).find("height: 190 mm") != std::string::npos);
  PlateOptions joint;
  joint.split.longest = 2.9;
  joint.inspection = {{0.02, 0.2, 0.12, 8}};
  CHECK(refusal(joint).find("inspection|at: an opening at 20 mm reaches over the end of a unit|") == 0);
  PlateOptions away;
  away.inspection = {{20.0, 0.2, 0.12, 8}};
  CHECK(refusal(away).find("inspection|at: an opening at 20 m is not on the track|It is 7.746 m long.") == 0);
  PlateOptions all;
  all.split.longest = 2.9;
  all.inspection = {{0.02, 0.2, 0.12, 8}, {20.0, 0.2, 0.12, 8}, {1.2, 0.2, 0.12, 8}, {1.25, 0.2, 0.12, 8}};
  for (const char* const told : {"inspection|at: an opening at 20 mm reaches over the end of a unit|",
                                 "inspection|at: an opening at 20 m is not on the track|",
                                 "inspection|at: openings at 1.2 m and 1.25 m are too close|"}) {
    INFO(told);
    CHECK(refusal(all).find(told) != std::string::npos);
  }
  PlateOptions wide;
  wide.rim.emplace();
  wide.rim->width = 0.3;
  CHECK(refusal(wide).find(
            "rim.width|width: 300 mm is more than the walls are high, 250 mm|The rim would stand "
            "out farther than the channel is deep.|width: 250 mm or less") != std::string::npos);
  PlateOptions tiles;
  tiles.liner.emplace();
  tiles.liner->thickness = 8e-3;
  tiles.liner->bolt = 10;
  tiles.liner->tile_width = 40e-3;
  CHECK(
      refusal(tiles).find("liner.tile_width|tile_width: 40 mm makes half tiles of 17.9 mm|Holes for M10 take "
                          "26.4 mm with their edges.|tile_width: 59 mm or more") == 0);
  PlateOptions many;
  many.split.longest = 1e-3;
  CHECK(refusal(many).find(
            "split.longest|longest: 1 mm makes 7747 units of a track of 7.746 m|There are at most "
            "400.") == 0);
  PlateOptions slab;
  slab.rim.emplace();
  CHECK(refusal(slab, {0.4, 0.0, 4e-3}).find("rim|rim: there are no walls to set it on") == 0);
}

}  // namespace fittings_test
