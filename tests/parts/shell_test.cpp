// What is set on sections of any kind: stiffeners, lugs, trestles. Every build proves that no two parts clash.

#include "glissade/centerline/clothoid_spline.hpp"
#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/parts/plates.hpp"

#include "parts/brep_faults.hpp"
#include "parts/chute_plates.hpp"
#include "parts/random_tracks.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/shortfalls.hpp"
#include "support/thorough.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

namespace shell_test {

namespace {

using namespace glissade;
using namespace testing;

struct NamedSection {
  std::string name;
  section::Measures measures;
};

section::Polygon block() {
  section::Polygon polygon;
  polygon.outline = {{0.2, 0.0},    {0.3, 0.15},  {0.4, 0.15},  {0.36, -0.1},
                     {-0.36, -0.1}, {-0.4, 0.15}, {-0.3, 0.15}, {-0.2, 0.0}};
  return polygon;
}

/// One of each kind that is no rectangular channel.
std::vector<NamedSection> sections() {
  const WidthLaw widths(std::vector<WidthAt>{{0.0, 0.4}, {3.0, 0.4}, {6.0, 0.5}});
  const Angle lean = Angle::from_degrees(25.0);
  return {{"trapezoid", section::Trapezoid{WidthLaw(0.4), 0.25, lean, 4e-3}},
          {"trapezoid of two widths", section::Trapezoid{widths, 0.25, lean, 4e-3}},
          {"u-channel of two widths", section::UChannel{widths, 0.25, 4e-3}},
          {"v-channel", v_channel()},
          {"slab of two widths", section::Slab{widths, 5e-3, 0.0, 0.0}},
          {"half-pipe", section::HalfPipe{0.4, 0.05, 4e-3}},
          {"pipe", section::Pipe{0.4, 3e-3}},
          {"block", block()}};
}

PlateOptions with_all(RoundMake round) {
  PlateOptions options;
  options.round = round;
  options.split.longest = 2.9;
  options.stave_tolerance = 5e-3;
  options.stiffeners.emplace();
  options.lifting.emplace();
  options.supports.emplace();
  options.supports->ground = {{0.0, -6.5}};
  return options;
}

std::size_t pieces(const WorkshopBuild& build, const std::string& word) {
  std::size_t count = 0;
  for (const ShopPart* part : named(build, word)) count += part->quantity();
  return count;
}

void require_sound(const WorkshopBuild& build) {
  for (const ShopPart& part : build.workshop.parts) {
    INFO(part.name);
    // Of what is round, volumes by chords say nothing.
    const std::string fault = fault_of(part);
    if (!fault.ends_with("do not look outwards")) CHECK(fault == "");
    if (part.pattern) CHECK(faults_of(part.pattern->region).empty());
  }
}

std::string refused(const section::Measures& measures, const PlateOptions& options) {
  return refusal_of([&] { return plates_of(chute(), measures, options); });
}

}  // namespace

TEST_CASE("shells: stiffeners, lugs and trestles stand on every section, as strips and mitred") {
  for (const auto& [name, measures] : sections()) {
    for (const RoundMake round : {RoundMake::staves, RoundMake::mitred}) {
      const bool goes_round = std::holds_alternative<section::HalfPipe>(measures) ||
                              std::holds_alternative<section::Pipe>(measures);
      if (round == RoundMake::mitred && !goes_round) continue;
      INFO(name << (round == RoundMake::mitred ? ", mitred" : ""));
      const WorkshopBuild build = plates_of(chute(), measures, with_all(round));
      require_sound(build);
      const std::size_t units = build.joints.size() - 1;
      CHECK(units >= 3);
      const std::size_t halves = std::holds_alternative<section::Pipe>(measures) ? 2 : 1;
      // 7.7 m in three units, no farther apart than 0.8 m: three each.
      CHECK(pieces(build, "stiffener") >= 5 * halves);
      CHECK(pieces(build, "stiffener") <= 3 * units * halves);
      CHECK(pieces(build, "lug") == 2 * units);
      const std::size_t saddles = pieces(build, "saddle");
      CHECK(saddles >= 4);
      CHECK(pieces(build, "base_plate") == saddles);
      CHECK(pieces(build, "leg") == saddles);
    }
  }
}

TEST_CASE("shells: bolts of frames lie below thick rims with their washers, where these have room") {
  const Angle lean = Angle::from_degrees(25.0);
  const std::vector<NamedSection> open = {{"u-channel", section::UChannel{WidthLaw(0.4), 0.25, 4e-3}},
                                          {"trapezoid", section::Trapezoid{WidthLaw(0.4), 0.25, lean, 4e-3}},
                                          {"v-channel", v_channel()},
                                          {"half-pipe", section::HalfPipe{0.4, 0.05, 4e-3}}};
  constexpr double kWasher = 20e-3;  // of M10, ISO 7089
  for (const auto& [name, measures] : open) {
    for (const RoundMake round : {RoundMake::staves, RoundMake::mitred}) {
      if (round == RoundMake::mitred && name != "half-pipe") continue;
      for (const double thickness : {5e-3, 20e-3}) {
        INFO(name << (round == RoundMake::mitred ? ", mitred" : "") << ", " << thickness);
        PlateOptions options;
        options.round = round;
        options.stave_tolerance = 5e-3;
        options.rim = RimOptions{40e-3, thickness};
        const WorkshopBuild build = plates_of(chute(), measures, options);
        std::size_t frames = 0;
        for (const ShopPart* frame :
             named(build, round == RoundMake::mitred ? "trough_flange" : "end_frame")) {
          const PlaneRegion& region = frame->pattern->region;
          double highest = -HUGE_VAL;
          for (const Circle& hole : region.holes) highest = std::max(highest, hole.centre.y);
          CHECK(highest <= bounds(region.outline).high.y - thickness - 0.5 * kWasher);
          frames += frame->quantity();
        }
        CHECK(frames >= 2);
      }
    }
  }
  PlateOptions options;
  options.rim = RimOptions{40e-3, 30e-3};
  options.flanges.bolt = 12;
  options.flanges.slotted = FlangeSide::downstream;
  options.flanges.width = 60e-3;
  const ChannelMeasures low{0.4, 0.06, 4e-3};
  const std::string told = refusal(options, low);
  INFO(told);
  CHECK(told.starts_with(
      "flanges.bolt|bolt: M12 finds no place beside walls of 60 mm|Two slots, as wide as holes of "));
  CHECK(told.find(" apart there, below the rim of 30 mm.|a thinner rim, a smaller bolt, a shorter slot, or "
                  "slotted: none") != std::string::npos);
  options.rim->thickness = 5e-3;
  CHECK(refusal(options, low).empty());
}

TEST_CASE("shells: nothing stands nearer to the section than the gap, and stiffeners keep it all along") {
  int number = 0;
  for (const auto& [name, measures] : sections()) {
    INFO(name);
    // Every other one, elsewhere than in CI; the others below.
    if (number++ % 2 == 1 && !testing::thorough()) continue;
    PlateOptions options;
    options.round = RoundMake::staves;
    options.stave_tolerance = 5e-3;
    options.stiffeners.emplace();
    options.flanges.gap = 1e-3;
    const WorkshopBuild plain = plates_of(chute(), measures, [&] {
      PlateOptions without = options;
      without.stiffeners.reset();
      return without;
    }());
    const WorkshopBuild build = plates_of(chute(), measures, options);
    // They are not of the section: its own volume is what it was.
    CHECK(build.proof.volume == Approx(plain.proof.volume).epsilon(1e-12));
    double added = 0.0;
    for (const ShopPart* part : named(build, "stiffener")) {
      CHECK(part->thickness == 6e-3);
      added += part->volume * static_cast<double>(part->quantity());
      // Volume of a band of its width round the section, by the areas inside two moved outlines.
      const AreaMoments flat = moments(part->pattern->region);
      CHECK(part->volume == Approx(std::fabs(flat.area) * 6e-3).epsilon(1e-12));
    }
    CHECK(build.proof.added_volume == Approx(plain.proof.added_volume + added).epsilon(1e-9));
  }
}

TEST_CASE(
    "shells: stiffeners are bands of their width, by closed forms of a ring in halves and of a trapezoid") {
  constexpr double kPi = 3.14159265358979323846;
  PlateOptions options;
  options.round = RoundMake::mitred;
  options.stiffeners.emplace();
  options.flanges.gap = 1e-3;
  const WorkshopBuild pipe = plates_of(chute(), section::Pipe{0.4, 3e-3}, options);
  const double inner = 0.2 + 3e-3 + 1e-3;
  const double outer = inner + 40e-3;
  // Less a slit of 1 mm at the top and one at the bottom, whose ends are round.
  const double ring = kPi * (outer * outer - inner * inner) - 2.0 * 1e-3 * (outer - inner);
  CHECK(2.0 * part_of(pipe, "stiffener_half").volume == Approx(6e-3 * ring).epsilon(1e-6));
  options.round = RoundMake::as_fits;
  const double lean = 25.0 * kPi / 180.0;
  const WorkshopBuild trough = plates_of(
      chute(), section::Trapezoid{WidthLaw(0.4), 0.25, Angle::from_degrees(lean * 180.0 / kPi), 4e-3},
      options);
  // What a line moved out by d encloses up to the walls' tops, doubled: both halves lean alike.
  const auto within = [&](double d) {
    const double foot = 0.2 + d * (1.0 - std::sin(lean)) / std::cos(lean);
    const double high = 0.25 + d;
    return high * (2.0 * foot + high * std::tan(lean));
  };
  CHECK(part_of(trough, "stiffener").volume ==
        Approx(6e-3 * (within(4e-3 + 1e-3 + 40e-3) - within(4e-3 + 1e-3))).epsilon(1e-9));
}

/// Where upper edges along a bent wall cross a plane across the track: the one farther out, along the plane's x.
std::optional<double> farthest_out(const ShopPart& wall, const Frame& plane) {
  std::optional<double> out;
  const auto& corners = std::get<FoldedPlate>(wall.body).corners;
  for (const Frame& place : wall.places) {
    for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
      for (std::size_t j = 0; j < 4; ++j) {
        const Vec3 from = place.to_space(corners[i][j]) - plane.origin;
        const Vec3 to = place.to_space(corners[i + 1][j]) - plane.origin;
        const double before = dot(from, plane.z);
        const double after = dot(to, plane.z);
        if (before * after > 0.0) continue;
        const Vec3 at = from + (before / (before - after)) * (to - from);
        if (dot(at, plane.y) < 0.2) continue;  // the lower edges of a wall that leans inwards
        const double across = dot(at, plane.x);
        out = std::max(out.value_or(across), across);
      }
    }
  }
  return out;
}

TEST_CASE("shells: stiffeners and lugs keep the gap to bent sides that lean otherwise from flat to flat") {
  const WidthLaw widths(std::vector<WidthAt>{{0.0, 0.4}, {2.0, 0.4}, {6.0, 0.7}});
  const section::UChannel channel{widths, 0.25, 4e-3};
  PlateOptions options = with_all(RoundMake::staves);
  options.floor = FloorMake::bent;
  options.supports.reset();
  options.flanges.gap = 1e-3;
  const WorkshopBuild build = plates_of(chute(), channel, options);
  require_sound(build);
  CHECK(pieces(build, "lug") == 2 * (build.joints.size() - 1));
  std::size_t held = 0;
  for (const ShopPart* const stiffener : named(build, "stiffener")) {
    for (const Frame& place : stiffener->places) {
      for (const double depth : {0.0, stiffener->thickness}) {
        Frame plane = place;
        plane.origin = plane.origin + depth * plane.z;
        // The left end of its inner edge: the highest corner but that of the outer one.
        double inner = 1.0;
        for (const PathVertex& corner : stiffener->pattern->region.outline.vertices) {
          if (corner.at.y > 0.25 - 1e-6 && corner.at.x > 0.0) inner = std::min(inner, corner.at.x);
        }
        for (const ShopPart* const wall : named(build, "left_wall")) {
          const auto out = farthest_out(*wall, plane);
          if (!out) continue;
          // It is as wide as where the channel is widest, a thickness to both sides.
          CHECK(inner - *out >= 1e-3 - 1e-6);
          CHECK(inner - *out < 1e-3 + 0.075 * 2.0 * stiffener->thickness + 0.05e-3);
          ++held;
        }
      }
    }
  }
  CHECK(held >= 10);
}

TEST_CASE("shells: eyes of lugs stand plumb above the centre of gravity of their unit, above its tops") {
  for (const auto& [name, measures] : sections()) {
    INFO(name);
    PlateOptions options;
    options.round = RoundMake::staves;
    options.stave_tolerance = 5e-3;
    options.split.longest = 2.9;
    options.lifting.emplace();
    const WorkshopBuild build = plates_of(chute(), measures, options);
    // Of the last unit, the flattest, by all parts that lie on it but its lugs.
    Vec3 moment;
    double mass = 0.0;
    const CenterlinePoint joint = build.master.spline->at(build.joints[build.joints.size() - 2]);
    const auto [sine, cosine] = math::sine_cosine(joint.slope_angle);
    const auto beyond = [&, down = sine, ahead = cosine](Vec3 point) {
      return (point.x - joint.x) * ahead - (point.z + joint.drop) * down > 0.0;
    };
    const ShopPart* lug = nullptr;
    for (const ShopPart& part : build.workshop.parts) {
      const bool is_lug = part.name.find("lug") != std::string::npos;
      if (is_lug) lug = &part;
      for (const Frame& place : part.places) {
        const Vec3 local = part.places.front().to_space({});
        const Vec3 away = part.centre_of_gravity - local;
        const Frame& first = part.places.front();
        const Vec3 own{dot(away, first.x), dot(away, first.y), dot(away, first.z)};
        const Vec3 centre = place.to_space(own);
        if (is_lug || !beyond(centre)) continue;
        mass += part.mass;
        moment = moment + part.mass * centre;
      }
    }
    REQUIRE(lug != nullptr);
    const Vec2 eye = std::get<Prism>(lug->body).region.holes.front().centre;
    const Vec3 at = lug->places.back().to_space({eye.x, eye.y, 0.5 * lug->thickness});
    const Vec3 centre = (1.0 / mass) * moment;
    CHECK(std::fabs(at.x - centre.x) < 0.02);
    CHECK(at.z > centre.z);
  }
}

TEST_CASE("shells: saddles touch the section from below, by the outside of the plates as they are made") {
  int number = 0;
  for (const auto& [name, measures] : sections()) {
    INFO(name);
    if (number++ % 2 == 0 && !testing::thorough()) continue;
    PlateOptions options;
    options.round = RoundMake::staves;
    options.stave_tolerance = 5e-3;
    options.supports.emplace();
    options.supports->ground = {{0.0, -7.0}};
    const WorkshopBuild build = plates_of(chute(), measures, options);
    const double drop = build.master.spline->at(build.master.spline->length()).drop;
    for (const ShopPart* saddle : named(build, "saddle")) {
      const Prism& body = std::get<Prism>(saddle->body);
      CHECK(body.depth == 8e-3);
      CHECK(bounds(body.region.outline).height() >= 30e-3 - 1e-9);
    }
    for (const ShopPart* plate : named(build, "base_plate")) {
      for (const Frame& place : plate->places) CHECK(place.origin.z == Approx(-7.0 + 25e-3).margin(1e-9));
    }
    CHECK(drop < 7.0);
    std::size_t set_out = 0;
    for (const SettingOutPoint& row : build.workshop.setting_out)
      set_out += row.what.starts_with("support") ? 1 : 0;
    CHECK(2 * set_out == pieces(build, "saddle"));
  }
}

TEST_CASE("shells: random sections with corners, rims, liners and all that is set on them do not clash") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  std::size_t set = 0;
  const int runs = testing::thorough() ? 10 : 6;  // each kind once at least
  for (int run = 0; run < runs; ++run) {
    const ClothoidSpline track = random_track(random, {3.0, 8.0, 3, -0.3, 0.9, 0.2, 0.5, 50.0});
    const double t = random.between(2e-3, 6e-3);
    const double width = random.between(0.25, 0.6);
    std::vector<section::Measures> kinds = {
        section::Trapezoid{WidthLaw(width), random.between(0.12, 0.3),
                           Angle::from_degrees(random.between(0.0, 50.0)), t},
        section::HalfPipe{width, random.between(0.0, 0.1), t},
        section::Pipe{width, t},
        v_channel(),
        block(),
        section::Slab{WidthLaw(width), t, 0.0, 0.0}};
    PlateOptions options;
    const auto maybe = [&] { return random.integer(0, 1) == 0; };
    options.floor = random.integer(0, 3) == 0 ? FloorMake::bent : FloorMake::rolled;
    options.round = maybe() ? RoundMake::staves : RoundMake::as_fits;
    options.stave_tolerance = 6e-3;
    options.flanges.wanted = random.integer(0, 2) > 0;
    options.flanges.bolt = 6;
    options.split.longest = random.between(1.0, 3.0);
    options.stiffeners.emplace();
    options.stiffeners->width = random.between(40e-3, 70e-3);
    options.lifting.emplace();
    options.supports.emplace();
    options.supports->ground = {{0.0, -16.0}};
    const section::Measures& measures = kinds[static_cast<std::size_t>(run) % kinds.size()];
    const bool channel = std::holds_alternative<section::Trapezoid>(measures);
    if (channel && options.floor == FloorMake::rolled) {
      if (maybe()) options.corners.kind = maybe() ? CornerJoint::lap : CornerJoint::tab_and_slot;
      if (maybe()) options.rim = RimOptions{};
      if (maybe()) options.liner = LinerOptions{};
    }
    INFO("run " << run << ", kind " << measures.index());
    const WorkshopBuild build = plates_of(track, measures, options);  // throws where parts clash
    require_sound(build);
    set += pieces(build, "stiffener") + pieces(build, "lug") + pieces(build, "saddle");
  }
  CHECK(set > 6 * static_cast<std::size_t>(runs));
}

TEST_CASE("shells: saddles stand inside of walls that reach far below a narrow floor") {
  const ClothoidSpline track(Angle::from_degrees(45.0), {{3.0, 0.0, 0.3}, {2.0, 0.3, 0.1}});
  for (const double width : {0.12, 0.146, 0.2, 0.3}) {
    PlateOptions options;
    options.corners.kind = CornerJoint::lap;
    options.liner.emplace();
    options.flanges.wanted = false;
    options.supports.emplace();
    options.supports->ground = {{0.0, -8.0}};
    options.split.longest = 1.8;
    INFO(width);
    const WorkshopBuild build = plates_of(
        track, section::Trapezoid{WidthLaw(width), 0.174, Angle::from_degrees(36.5), 6e-3}, options);
    CHECK(pieces(build, "saddle") > 0);
  }
}

TEST_CASE("shells: saddles keep off bolts of tiles below flats that touch the track off their middles") {
  const ClothoidSpline track(Angle::from_degrees(50.0),
                             {{1.0, 0.0, 0.0}, {0.9163, 1.0 / 1.5, 1.0 / 1.5}, {1.0, 0.0, 0.0}});
  PlateOptions options;
  options.floor = FloorMake::bent;
  options.liner.emplace();
  options.liner->thickness = 5e-3;
  options.liner->tile_length = 0.237;
  options.liner->tile_width = 96e-3;
  options.liner->bolt = 8;
  options.liner->gap = 0.0;
  options.supports.emplace();
  options.supports->ground = {{0.0, -4.0}};
  const section::Trapezoid section{WidthLaw(0.45), 0.2, Angle::from_degrees(4.0), 5e-3};
  for (const double kink : {5.0, 6.0}) {
    options.bend = {FacetRule::segment_angle, Angle::from_degrees(kink).radians(), {}, {}};
    INFO(kink);
    // Throws InternalError where a saddle covers a hole.
    CHECK(pieces(plates_of(track, section, options), "saddle") > 0);
  }
}

TEST_CASE("shells: below narrow floors saddles carry what laps there") {
  PlateOptions options;
  options.corners.kind = CornerJoint::lap;
  options.flanges.wanted = false;
  options.supports.emplace();
  options.supports->ground = {{0.0, -6.5}};
  int combination = 0;
  for (const auto& [width, lean, walls] :
       {std::tuple(0.016, 30.0, WallSeat::on_floor), std::tuple(0.032, 30.0, WallSeat::beside_floor),
        std::tuple(0.040, 30.0, WallSeat::beside_floor), std::tuple(0.060, 55.0, WallSeat::beside_floor)}) {
    for (const FloorMake floor : {FloorMake::rolled, FloorMake::bent}) {
      // Each with one of the two in turn, elsewhere than in CI.
      const int number = combination++;
      if (!testing::thorough() && number % 2 != number / 2 % 2) continue;
      INFO(width << " " << lean);
      options.walls = walls;
      options.floor = floor;
      const section::Trapezoid section{WidthLaw(width), 0.1, Angle::from_degrees(lean), 4e-3};
      // Throws InternalError where a saddle reaches into a lap.
      CHECK(pieces(plates_of(chute(), section, options), "saddle") > 0);
    }
  }
}

TEST_CASE("shells: trestles stand no nearer than their base plates are wide") {
  PlateOptions options;
  options.supports.emplace();
  options.supports->ground = {{0.0, -7.0}};
  options.supports->spacing = 0.24;
  for (const FloorMake floor : {FloorMake::rolled, FloorMake::bent}) {
    options.floor = floor;
    options.bend = {FacetRule::segment_angle, Angle::from_degrees(10.0).radians(), {}, {}};
    const WorkshopBuild build = plates_of(chute(), section::Slab{WidthLaw(0.42), 3e-3}, options);
    std::vector<double> places;
    for (const ShopPart* const plate : named(build, "base_plate")) {
      for (const Frame& place : plate->places) {
        if (place.origin.y > 0.0) places.push_back(place.origin.x);
      }
    }
    std::sort(places.begin(), places.end());
    CHECK(places.size() >= 5);
    for (std::size_t i = 1; i < places.size(); ++i) CHECK(places[i] - places[i - 1] >= 0.16 - 1e-9);
  }
}

TEST_CASE("shells: lugs keep off stiffeners that are square to another tube up to their eyes") {
  const CoulombBrachistochrone track({0.95, 1.25}, Friction::from_angle(Angle::from_degrees(24.0)));
  PlateOptions options;
  options.round = RoundMake::mitred;
  options.bend = {FacetRule::segment_angle, Angle::from_degrees(7.5).radians(), {}, {}};
  options.split.longest = 1.2;
  options.flanges.thickness = 4e-3;
  options.stiffeners.emplace();
  options.stiffeners->thickness = 13e-3;
  options.lifting.emplace();
  options.lifting->thickness = 16e-3;
  for (const double spacing : {0.2, 0.227, 0.254, 0.281}) {
    INFO(spacing);
    options.stiffeners->spacing = spacing;
    // Throws InternalError where parts clash.
    CHECK(pieces(plates_of(track, section::Pipe{0.15, 2e-3}, options), "lug") > 0);
  }
}

TEST_CASE("shells: lugs on bent sides as high as the radius of the first flats stand clear of the frame") {
  const WidthLaw widths(std::vector<WidthAt>{{0.0, 1.665}, {1.888, 1.665}, {3.167, 1.892}});
  PlateOptions options;
  options.floor = FloorMake::bent;
  options.bend = {FacetRule::segment_angle, Angle::from_degrees(1.41).radians(), {}, {}};
  options.split.longest = 2.11;
  options.stiffeners.emplace();
  options.lifting.emplace();
  for (const double high : {0.4, 0.55, 0.705}) {
    INFO(high);
    // Throws InternalError where parts clash.
    CHECK(pieces(plates_of(chute(), section::UChannel{widths, high, 2e-3}, options), "lug") > 0);
  }
}

TEST_CASE("shells: what no section holds is refused with place, value, bound and a way out") {
  PlateOptions stiff;
  stiff.stiffeners.emplace();
  stiff.stiffeners->spacing = 20e-3;
  CHECK(refused(section::Pipe{0.3, 3e-3}, stiff) ==
        "stiffeners.spacing|spacing: 20 mm leaves no room to weld them|They are at least ten thicknesses "
        "apart, 60 mm.|spacing: 800 mm\n");
  PlateOptions high;
  high.supports.emplace();
  high.supports->ground = {{0.0, -4.0}};
  CHECK(refused(v_channel(), high).find("supports.ground|ground: at ") == 0);
}

TEST_CASE(
    "openings: cut into the widest upright side, lids have the same holes, both differences are listed") {
  const Angle lean = Angle::from_degrees(25.0);
  for (const section::Measures& measures :
       {section::Measures(section::Trapezoid{WidthLaw(0.4), 0.25, lean, 4e-3}),
        section::Measures(v_channel()), section::Measures(section::HalfPipe{0.6, 0.2, 4e-3}),
        section::Measures(section::Pipe{0.6, 3e-3}), section::Measures(block())}) {
    INFO("kind " << measures.index());
    PlateOptions options;
    options.stave_tolerance = 12e-3;
    options.stiffeners.emplace();
    options.lifting.emplace();
    options.inspection = {{2.2, 0.15, 0.08, 6}, {5.1, 0.2, 0.1, 6}};
    const WorkshopBuild build = plates_of(chute(), measures, options);
    require_sound(build);
    const std::size_t lids = pieces(build, "lid");
    CHECK(lids == 2);
    std::size_t lid_holes = 0;
    std::size_t cutouts = 0;
    std::size_t side_holes = 0;
    double opened = 0.0;
    for (const ShopPart& part : build.workshop.parts) {
      const PlaneRegion& flat = part.pattern->region;
      const bool across =
          part.name.find("frame") != std::string::npos || part.name.find("lug") != std::string::npos;
      if (part.name.starts_with("lid")) {
        lid_holes += part.quantity() * flat.holes.size();
      } else if (!across) {
        side_holes += part.quantity() * flat.holes.size();
        cutouts += part.quantity() * flat.cutouts.size();
        for (const ArcPath& cutout : flat.cutouts) {
          opened += std::fabs(signed_area(cutout)) * part.thickness * static_cast<double>(part.quantity());
        }
      }
    }
    CHECK(cutouts == 2);
    CHECK(lid_holes == side_holes);
    CHECK(lid_holes >= 8);
    double listed = 0.0;
    for (const VolumeDifference& one : build.proof.differences) {
      if (one.what == "openings") listed = one.volume;
      if (one.what == "holes of lids") CHECK(one.volume < 0.0);
    }
    // On the flat in the middle of the thickness, where Pappus has the volume.
    CHECK(-listed == Approx(opened).epsilon(1e-9));
    for (const ShopPart* lid : named(build, "lid")) CHECK(lid->pattern->region.holes.size() >= 4);
  }
}

TEST_CASE("openings: where none is to be had it is refused with place, value, bound and a way out") {
  PlateOptions options;
  options.inspection = {{2.0, 0.2, 0.3, 8}};
  const section::Trapezoid trapezoid{WidthLaw(0.4), 0.25, Angle::from_degrees(25.0), 4e-3};
  CHECK(refused(trapezoid, options) ==
        "inspection|height: 300 mm leaves too little of the left_wall, 276 mm wide|Its lid laps over by 30 "
        "mm all "
        "round.|height: 215 mm\n");
  options.inspection = {{9.0, 0.2, 0.1, 8}};
  CHECK(refused(trapezoid, options).find("inspection|at: an opening at 9 m is not on the track|It is 7.7") ==
        0);
  options.inspection = {{2.0, 0.2, 0.1, 8}, {2.1, 0.2, 0.1, 8}};
  CHECK(refused(trapezoid, options).find("inspection|at: openings at 2 m and 2.1 m are too close") == 0);
  // All of it is told at once, of each opening the first.
  options.inspection = {{9.0, 0.2, 0.1, 8}, {2.0, 0.2, 0.1, 8}, {2.1, 0.2, 0.1, 8}, {-1.0, 0.2, 0.1, 8}};
  const std::string several = refused(trapezoid, options);
  CHECK(several.find("inspection|at: an opening at 9 m is not on the track|") == 0);
  CHECK(several.find("\ninspection|at: openings at 2 m and 2.1 m are too close|") != std::string::npos);
  CHECK(several.find("\ninspection|at: an opening at -1 m is not on the track|") != std::string::npos);
  // Moved to one arc, which is told.
  options.inspection = {{1.2, 0.2, 0.1, 8}, {4.0, 0.2, 0.1, 8}, {5.5, 0.2, 0.1, 8}};
  const WorkshopBuild moved = plates_of(chute(), trapezoid, options);
  CHECK(pieces(moved, "lid") == 3);
  for (const std::string& told : shortfalls_of(moved.workshop, "at: ")) {
    CHECK(told.find("|With its lid it lies on one arc of its plate, clear of frames.|at: ") !=
          std::string::npos);
  }
  options.inspection = {{2.0, 1.5, 0.1, 8}};
  CHECK(refused(trapezoid, options).find("inspection|at: an opening at 2 m ") == 0);
  // Openings in bent sides go across bends.
  options.floor = FloorMake::bent;
  CHECK(pieces(plates_of(chute(), trapezoid, options), "lid") == 1);
  options.inspection = {{0.01, 0.2, 0.1, 8}};
  const std::string across = refused(trapezoid, options);
  CHECK(across.find("inspection|at: an opening at 10 mm finds no place in its unit|Units end at 0 mm and ") ==
        0);
  CHECK(across.find("and their ends lie off the bends of the left_wall.|another at, or a smaller length") !=
        std::string::npos);
}

TEST_CASE("lugs: on walls without a rim they keep off stiffeners") {
  PlateOptions options;
  options.stiffeners.emplace();
  options.stiffeners->spacing = 0.2;
  options.lifting.emplace();
  const WorkshopBuild build = plates(chute(), options);  // throws where parts clash
  CHECK(pieces(build, "stiffener") > 20);
  CHECK(pieces(build, "lug") >= 2);
}

TEST_CASE(
    "trestles: saddles stand on one flat each, and beams below the lowest corners of steep bent plates") {
  // Each ended as a clash: flats overlap as stretches of the track, and a steep bottom lies above a beam far from its saddles.
  const ClothoidSpline shallow(
      Angle::from_degrees(31.88),
      {{1.196, 1.0 / 13.7052, 1.0 / 13.7052}, {0.5433, 1.0 / 6.226, 1.0 / 6.226}, {1.9141, 0.0, 0.0}});
  PlateOptions options;
  options.floor = FloorMake::bent;
  options.supports.emplace();
  options.supports->spacing = 0.9;
  options.supports->ground = {{0.0, -7.9}};
  CHECK(pieces(plates(shallow, options, {0.699, 0.327, 6e-3}), "saddle") >= 4);
  const CoulombBrachistochrone steep({5.7, 4.879}, Friction::from_angle(Angle::from_degrees(23.06)));
  section::VChannel wide;
  wide.angle = Angle::from_degrees(132.7);
  wide.bottom_radius = 0.1883;
  wide.wall_height = 0.2476;
  wide.thickness = 3e-3;
  options.split.longest = 2.105;
  options.split.sheet = {6.0, 2.0};
  options.stave_tolerance = 3.278e-3;
  options.supports->spacing = 0.94;
  CHECK(pieces(plates_of(steep, wide, options), "saddle") >= 4);
}

TEST_CASE("lids: a straight one beside the frame of a hollow is refused with the place that would do") {
  const ClothoidSpline hollow(Angle::from_degrees(58.09), {{1.1253, 1.0 / 8.5933, 1.0 / 8.5933},
                                                           {1.2273, 1.0 / 14.064, 1.0 / 14.064},
                                                           {1.2807, 1.0 / 4.6291, 1.0 / 4.6291}});
  PlateOptions options;
  options.split.longest = 2.174;
  options.split.sheet = {6.0, 2.0};
  options.inspection = {{3.49, 0.20889, 0.0432, 8}};
  const ChannelMeasures channel{0.5037, 0.2978, 2e-3};
  const std::string text = refusal_of([&] { return plates(hollow, options, channel); });
  CHECK(text.find("inspection|at: an opening at 3.49 m reaches over the end of a unit|") == 0);
  const std::size_t at = text.find("|at: ", 20);
  REQUIRE(at != std::string::npos);
  options.inspection.front().at = std::stod(text.substr(at + 5));
  CHECK(std::fabs(options.inspection.front().at - 3.49) < 0.2);
  CHECK(pieces(plates(hollow, options, channel), "lid") == 1);
}

}  // namespace shell_test
