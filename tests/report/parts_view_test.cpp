#include "report/parts_view.hpp"

#include "glissade/centerline/straight_line.hpp"

#include "report/serial/pattern.hpp"
#include "support/catch.hpp"
#include "support/shop_parts.hpp"

#include <cmath>

using namespace glissade;

namespace {

/// A bar along the track x = z = 0 to 4 m, at a height and to the left of it, centred at a distance along it.
ShopPart bar(const std::string& name, double along, double left, double above) {
  constexpr double kLength = 1.0;
  constexpr double kThickness = 0.01;
  Prism body{{rectangle({-0.5 * kLength, -0.05}, {0.5 * kLength, 0.05}), {}, {}}, kThickness};
  ShopPart part = testing::shop_part(1, name, std::move(body));
  part.thickness = kThickness;
  part.places = {{{along, left, above - 0.5 * kThickness}}};
  return part;
}

Vec3 shift_of(const std::vector<ShopPart>& parts, std::size_t i) {
  return report::shifts_apart(parts, StraightLine(Endpoints{4.0, 0.0}), Placement())[i].front();
}

}  // namespace

TEST_CASE("Drawn apart, pieces keep their order along, across and square to the track", "[parts_view]") {
  const std::vector<ShopPart> parts = {bar("leg_1", 2.0, 0.0, -0.4),      bar("floor_1", 1.0, 0.0, 0.0),
                                       bar("floor_2", 3.0, 0.0, 0.0),     bar("left_wall", 2.0, 0.3, 0.1),
                                       bar("right_wall", 2.0, -0.3, 0.1), bar("cover", 2.0, 0.0, 0.2)};
  const Vec3 leg = shift_of(parts, 0);
  const Vec3 first = shift_of(parts, 1);
  const Vec3 second = shift_of(parts, 2);
  const Vec3 left = shift_of(parts, 3);
  const Vec3 right = shift_of(parts, 4);
  const Vec3 cover = shift_of(parts, 5);
  // Along: away from the middle, by a quarter of the way from it.
  CHECK(first.x == Approx(-0.25).margin(3e-3));
  CHECK(second.x == Approx(0.25).margin(3e-3));
  CHECK(std::fabs(leg.x) < 3e-3);
  // Across: as far again as they are from the middle.
  CHECK(first.y == Approx(0.0).margin(1e-12));
  CHECK(left.y == Approx(0.3));
  CHECK(right.y == Approx(-0.3));
  // Layers: what is floor stays, what lies lower goes down.
  CHECK(first.z == Approx(0.0).margin(1e-12));
  CHECK(second.z == first.z);
  CHECK(leg.z < -0.1);
  CHECK(left.z > 0.1);
  CHECK(left.z == right.z);
  CHECK(cover.z > left.z + 0.1);
}

TEST_CASE("What is far below the track goes straight down, also where it is steep", "[parts_view]") {
  const StraightLine steep(Endpoints{1.0, 4.0});
  ShopPart leg = bar("leg_1", 0.0, 0.0, 0.0);
  leg.places.front().origin = {-1.5, 0.0, -3.0};
  const std::vector<ShopPart> parts = {bar("floor_1", 0.0, 0.0, 0.0), leg};
  const Vec3 apart = report::shifts_apart(parts, steep, Placement())[1].front();
  const CenterlinePoint middle = steep.at(0.5 * steep.length());
  // What is left is along the track: a quarter of the way from the middle.
  CHECK(apart.z < 0.0);
  CHECK(apart.y == Approx(0.0).margin(1e-12));
  CHECK(std::fabs(apart.x) <= 0.25 * middle.x + 1e-9);
}

TEST_CASE("Drawn apart far away and turned, the assembly is the same", "[parts_view]") {
  const StraightLine track(Endpoints{4.0, 3.0});
  const Placement far({500e3, -20e3, 1500.0}, Angle::from_degrees(70.0));
  const std::vector<ShopPart> here = {bar("floor_1", 1.0, 0.0, -0.7), bar("left_wall", 2.0, 0.3, -1.2)};
  const auto shifts = report::shifts_apart(here, track, Placement());
  std::vector<ShopPart> there = here;
  const double c = std::cos(far.azimuth().radians());
  const double s = std::sin(far.azimuth().radians());
  const auto turned = [&](Vec3 v) { return Vec3{c * v.x - s * v.y, s * v.x + c * v.y, v.z}; };
  for (ShopPart& part : there) {
    for (Frame& place : part.places)
      place = {far.start() + turned(place.origin), turned(place.x), turned(place.y), turned(place.z)};
  }
  const auto moved = report::shifts_apart(there, track, far);
  for (std::size_t i = 0; i < here.size(); ++i)
    CHECK(norm(moved[i].front() - turned(shifts[i].front())) < 1e-6);
}

TEST_CASE("The page has the pattern that the DXF has, to a tenth of a micrometre", "[parts_view]") {
  const ShopPart part = testing::sample_workshop().parts.front();
  const auto json = report::pattern_json(part);
  const FlatPattern& pattern = *part.pattern;
  REQUIRE(json["outline_m"].size() == pattern.region.outline.vertices.size());
  for (std::size_t i = 0; i < json["outline_m"].size(); ++i) {
    const PathVertex& vertex = pattern.region.outline.vertices[i];
    CHECK(std::fabs(json["outline_m"][i][0].get<double>() - vertex.at.x) < 0.51e-7);
    CHECK(std::fabs(json["outline_m"][i][1].get<double>() - vertex.at.y) < 0.51e-7);
    CHECK(std::fabs(json["outline_m"][i][2].get<double>() - vertex.bulge) < 0.51e-9);
  }
  CHECK(json["cutouts_m"].size() == 1);
  REQUIRE(json["holes_m"].size() == pattern.region.holes.size());
  CHECK(json["holes_m"][0][2].get<double>() == Approx(2.0 * pattern.region.holes[0].radius));
  REQUIRE(json["bends"].size() == 2);
  CHECK(json["bends"][0]["angle_deg"].get<double>() == Approx(pattern.bends[0].angle.degrees()));
  CHECK(json["bends"][0]["up"] == true);
  CHECK(json["bends"][1]["up"] == false);
  REQUIRE(json["rolls"].size() == 1);
  CHECK(json["rolls"][0]["radius_m"] == 2.5);
  CHECK(report::pattern_json(testing::sample_workshop().parts[1]).is_null());
}
