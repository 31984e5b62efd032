// What meets at joints: holes that one bolt goes through, and the faces that the body slides over.

#include "glissade/centerline/clothoid_spline.hpp"
#include "glissade/parts/plates.hpp"

#include "parts/bolt_faults.hpp"
#include "parts/chute_plates.hpp"
#include "parts/strips/joint_steps.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/thorough.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <variant>
#include <vector>

namespace {

using namespace glissade;
using namespace testing;

/// Frames, tiles, rims with covers, and a lid.
WorkshopBuild bolted_chute() {
  PlateOptions options;
  options.split.longest = 2.5;
  options.liner.emplace();
  options.rim.emplace();
  options.cover.emplace();
  return plates(chute(), options);
}

std::vector<Circle>* holes_of(PartBody& body) {
  if (auto* const prism = std::get_if<Prism>(&body)) return &prism->region.holes;
  if (auto* const swept = std::get_if<SweptBody>(&body)) return &swept->holes;
  if (auto* const sheet = std::get_if<RolledSheet>(&body)) return &sheet->region.holes;
  return nullptr;
}

std::size_t bolts_in(const Workshop& workshop) {
  std::size_t bolts = 0;
  for (const BoughtInItem& item : workshop.items)
    bolts += item.name.find("bolt M") != std::string::npos ? item.quantity : 0;
  return bolts;
}

double highest(const WorkshopBuild& build) {
  double most = -1.0;
  for (const ShopMeasurement& one : build.workshop.measured) {
    if (one.quantity == "step_up") most = std::max(most, one.value);
  }
  return most;
}

}  // namespace

TEST_CASE("joints: each bolt of the list goes through two holes about one axis, whatever is bolted") {
  for (const bool lined : {true, false}) {
    PlateOptions options;
    options.split.longest = 2.5;
    if (lined) options.liner.emplace();
    options.rim.emplace();
    options.cover.emplace();
    const WorkshopBuild build = plates(chute(), options);
    const parts::BoltedHoles facts = parts::require_bolts_meet(build.workshop);
    CHECK(facts.joined == build.proof.bolted);
    CHECK(facts.off_axis < 4e-6);
    CHECK(facts.joined == bolts_in(build.workshop));
    CHECK(facts.joined > (lined ? 200 : 80));
    CHECK(facts.open > 0);
  }
  for (const section::Measures& measures :
       {section::Measures(section::Trapezoid{WidthLaw(0.4), 0.25, Angle::from_degrees(20.0), 4e-3}),
        section::Measures(section::Pipe{0.2, 3e-3}), section::Measures(section::HalfPipe{0.4, 0.1, 3e-3})}) {
    PlateOptions options;
    options.split.longest = 2.5;
    const ClothoidSpline track(Angle::from_degrees(40.0), {{2.0, 0.1, 0.1}, {3.0, 0.0, 0.05}});
    const WorkshopBuild build = plates_of(track, measures, options);
    CHECK(build.proof.bolted == bolts_in(build.workshop));
    CHECK(build.proof.bolted > 0);
  }
}

TEST_CASE("joints: a hole that is moved, widened, closed or covered in any part is found") {
  const WorkshopBuild build = bolted_chute();
  REQUIRE(bolt_fault(build.workshop).empty());
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  std::size_t tried = 0;
  // Every third part, elsewhere than in CI.
  for (std::size_t k = 0; k < build.workshop.parts.size(); k += testing::thorough() ? 1 : 3) {
    Workshop moved = build.workshop;
    ShopPart& part = moved.parts[k];
    std::vector<Circle>* const holes = holes_of(part.body);
    if (holes == nullptr || holes->empty()) continue;
    // Of the frames at both ends of the chute nothing is bolted to one side: they are pieces of the same parts.
    INFO(part.name);
    ++tried;
    const std::size_t which =
        static_cast<std::size_t>(random.integer(0, static_cast<int>(holes->size()) - 1));
    const Circle right = (*holes)[which];
    for (const double by : {2e-5, 1e-3, 8e-3}) {
      (*holes)[which].centre = right.centre + Vec2{0.0, by};
      const std::string fault = bolt_fault(moved);
      CHECK(fault.find("off the axis of that in") != std::string::npos);
    }
    (*holes)[which].centre = right.centre + Vec2{0.0, 16e-3};
    CHECK_FALSE(bolt_fault(moved).empty());
    (*holes)[which] = {right.centre, 1.6 * right.radius};
    CHECK(bolt_fault(moved).find("no bolt goes with both") != std::string::npos);
    (*holes)[which] = right;
    CHECK(bolt_fault(moved).empty());
    holes->erase(holes->begin() + static_cast<std::ptrdiff_t>(which));
    CHECK(bolt_fault(moved).find("is covered by " + part.name + ", which has none there") !=
          std::string::npos);
  }
  CHECK(tried > (testing::thorough() ? 10 : 3));
}

TEST_CASE("joints: slots take a bolt anywhere along them and nowhere else") {
  const auto plate = [](double z, const PlaneRegion& region) {
    ShopPart part;
    part.name = z > 0.0 ? "upper" : "lower";
    part.thickness = 0.01;
    part.body = Prism{region, 0.01};
    part.places = {{{0.0, 0.0, z}}};
    return part;
  };
  const ArcPath square{{{{0.0, 0.0}, 0.0}, {{0.2, 0.0}, 0.0}, {{0.2, 0.2}, 0.0}, {{0.0, 0.2}, 0.0}}, true};
  // 11 mm wide, 20 mm between the centres of its ends.
  const ArcPath slot{
      {{{0.09, 0.0945}, 0.0}, {{0.11, 0.0945}, 1.0}, {{0.11, 0.1055}, 0.0}, {{0.09, 0.1055}, 1.0}}, true};
  const auto fault = [&](Vec2 bolt) {
    Workshop workshop;
    workshop.parts = {plate(0.0, {square, {}, {{bolt, 5.5e-3}}}), plate(0.01, {square, {slot}, {}})};
    return bolt_fault(workshop);
  };
  for (const double x : {0.09, 0.1, 0.107, 0.11}) CHECK(fault({x, 0.1}) == "");
  CHECK(fault({0.1, 0.101}).find("1 mm off the axis of that in ") != std::string::npos);
  CHECK(fault({0.113, 0.1}).find("3 mm off the axis of that in ") != std::string::npos);
  CHECK(fault({0.15, 0.15}).find("is covered by ") != std::string::npos);
}

TEST_CASE("joints: steps are measured on the plates as they lie, of every section") {
  const ClothoidSpline track(Angle::from_degrees(40.0), {{2.0, 0.1, 0.1}, {3.0, 0.0, 0.05}});
  const std::vector<section::Measures> kinds = {
      section::UChannel{WidthLaw(0.4), 0.2, 4e-3},
      section::Trapezoid{WidthLaw(0.4), 0.25, Angle::from_degrees(20.0), 4e-3},
      section::UChannel{WidthLaw({{0.0, 0.4}, {4.0, 0.6}}), 0.2, 4e-3}, section::HalfPipe{0.4, 0.1, 3e-3},
      section::Pipe{0.2, 3e-3}};
  for (const section::Measures& measures : kinds) {
    for (const FloorMake floor : {FloorMake::rolled, FloorMake::bent}) {
      INFO("kind " << measures.index() << (floor == FloorMake::bent ? ", bent" : ", rolled"));
      PlateOptions options;
      options.split.longest = 2.0;
      options.floor = floor;
      const WorkshopBuild build = plates_of(track, measures, options);
      REQUIRE(build.joints.size() > 3);
      std::size_t measured = 0;
      for (const ShopMeasurement& one : build.workshop.measured)
        measured += one.quantity == "step_up" ? 1 : 0;
      CHECK(measured >= build.joints.size() - 2);
      CHECK(highest(build) == 0.0);
      CHECK(build.ride.highest_step == 0.0);
      CHECK(build.ride.joint_step == 0.0);
      // M10 in holes of 11 and 12 mm.
      CHECK(build.ride.joint_play == Approx(1.5e-3));
      options.joint_step = 0.5e-3;
      const WorkshopBuild dropped = plates_of(track, measures, options);
      CHECK(highest(dropped) == Approx(-0.5e-3));
      CHECK(dropped.ride.joint_step == 0.5e-3);
      CHECK(dropped.ride.exit_speed < build.ride.exit_speed);
    }
  }
}

TEST_CASE("joints: of a unit that is raised the step is found, whichever way faces lie") {
  PlateOptions options;
  options.split.longest = 2.5;
  options.liner.emplace();
  for (const bool lined : {true, false}) {
    if (!lined) options.liner.reset();
    const WorkshopBuild build = plates(chute(), options);
    const ArcSpline& track = *build.master.spline;
    const Placement placement;
    const std::vector<parts::FacePlace> places =
        parts::channel_places({track, kChannel, options, placement}, build.joints);
    REQUIRE(places.size() == 4 * (build.joints.size() - 2));
    for (const parts::FacePlace& place : places) {
      INFO(place.where << (lined ? ", lined" : ""));
      REQUIRE(parts::step_at(build.workshop, place));
      CHECK(std::fabs(*parts::step_at(build.workshop, place)) < 1e-7);
      for (const double by : {-0.8e-3, 0.3e-3, 2e-3}) {
        // Whatever lies downstream of the joint.
        Workshop raised = build.workshop;
        for (ShopPart& part : raised.parts) {
          for (Frame& piece : part.places) {
            const Vec3 own = part.places.front().origin;
            const Vec3 middle = part.centre_of_gravity + (piece.origin - own);
            if (dot(middle - place.at, place.along) > 0.0) piece.origin = piece.origin + by * place.out;
          }
        }
        REQUIRE(parts::step_at(raised, place));
        CHECK(*parts::step_at(raised, place) == Approx(by).margin(1e-7));
      }
    }
  }
}

TEST_CASE("parts larger or heavier than is allowed: the sheet and the mass that are told take them") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  int told = 0;
  for (int round = 0; round < 24; ++round) {
    const double wide = random.between(0.3, 3.0);
    const double t = random.between(3e-3, 6e-3);
    const section::Measures sections[] = {
        section::Pipe{wide, t}, section::HalfPipe{wide, 0.1, t}, section::UChannel{WidthLaw(wide), 0.3, t},
        section::Trapezoid{WidthLaw(wide), 0.3, Angle::from_degrees(20.0), t}};
    const section::Measures& measures = sections[random.integer(0, 3)];
    PlateOptions options;
    options.round = RoundMake::mitred;
    options.bend = {FacetRule::segment_angle, 0.1, {}, {}};
    options.split.sheet = {random.between(1.5, 3.0), random.between(0.4, 1.2)};
    options.split.allowed = random.integer(0, 1) == 0;
    if (random.integer(0, 1) == 0) options.split.heaviest = random.between(2.0, 60.0);
    const ClothoidSpline track(Angle::from_degrees(45.0), {{random.between(1.0, 4.0), 0.2, 0.2}});
    CAPTURE(round, measures.index(), wide, options.split.sheet.x, options.split.sheet.y,
            options.split.allowed);
    const auto refused = [&] { return refusal_of([&] { return plates_of(track, measures, options); }); };
    std::string text = refused();
    // One after the other: of the worst part each.
    for (int tries = 0; tries < 6 && !text.empty(); ++tries) {
      INFO(text);
      const std::size_t sheet = text.rfind("sheet: [");
      const std::size_t heaviest = text.rfind("heaviest: ");
      const auto value = [&](std::size_t at) {
        std::size_t unit = 0;
        const double number = std::stod(text.substr(at), &unit);
        return text.substr(at + unit, 3) == " mm" ? 1e-3 * number : number;
      };
      const bool of_sheet = sheet != std::string::npos && text.find("split") == 0;
      const bool of_mass = heaviest != std::string::npos && heaviest > text.find('|', text.find('|') + 1);
      if (!of_sheet && !of_mass) break;
      ++told;
      if (of_sheet) options.split.sheet = {value(sheet + 8), value(text.find(", ", sheet) + 2)};
      if (of_mass) options.split.heaviest = value(heaviest + 10);
      text = refused();
    }
    INFO(text);
    CHECK((text.empty() || text.find("flanges") != std::string::npos ||
           text.find("no room for the frames") != std::string::npos));
  }
  CHECK(told > 8);
}
