// The hood of a transfer as plates: where they hang, what they add up to, and what is told of them.

#include "glissade/core/error.hpp"
#include "glissade/design/write.hpp"
#include "glissade/pipeline.hpp"
#include "glissade/pipeline/flights.hpp"

#include "parts/bodies/body_mesh.hpp"
#include "support/catch.hpp"
#include "support/thorough.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace hood_parts_test {

namespace {

using namespace glissade;
using Catch::Matchers::Contains;

constexpr double kRadius = 1.0;
constexpr const char* kChannel = "{kind: u-channel, width: 800 mm, wall_height: 400 mm, thickness: 8 mm}";

/// 400 t/h of ore from a fast belt over a hood onto a straight spoon.
std::string transfer(const std::string& fabrication, const std::string& section = kChannel,
                     const std::string& drop = "700 mm") {
  return "glissade: 1\ntrack: {start: {x: 2 m, y: 1 m, z: 3 m}, finish: {x: 3.2 m, y: 1 m, z: 1.4 m}}\n"
         "body: {friction_angle: 27 deg}\n"
         "stream: {mass_flow: 400 t/h, bulk_density: 1600 kg/m^3, lump_size: 60 mm}\n"
         "feed: {kind: belt, belt_speed: 3.6 m/s, pulley_radius: 400 mm, drop: 200 mm}\n"
         "hood: {radius: 1 m, impact_angle: 12 deg, exit_angle: 78 deg, drop: " +
         drop +
         "}\n"
         "discharge: {belt_speed: 3 m/s, drop: 300 mm}\ncenterline: {kind: straight}\n"
         "cross_section: " +
         section + "\nfabrication: " + fabrication +
         "\nmesh: {tolerance: 2 mm}\nexport: {formats: [off], frame: local}\n";
}

struct Made {
  Design design;
  Assembly assembly;
  [[nodiscard]] const Workshop& workshop() const { return assembly.fabrication->workshop; }
};

Made made(const std::string& text) {
  Design design = parse_design(text, "d.yaml");
  Assembly assembly = assemble(design, solve(design));
  return {std::move(design), std::move(assembly)};
}

std::string refusal(const std::string& text) {
  try {
    (void)made(text);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

/// The centre of the circle on which the underside lies, in the frame of StreamFlight.
Vec2 centre_of(const Made& all) {
  const std::vector<Vec2> line = hood_line(all.design, all.assembly.track);
  const Vec2 a = line[line.size() / 2] - line.front();
  const Vec2 b = line.back() - line.front();
  const double twice = 2.0 * cross(a, b);
  return line.front() +
         (1.0 / twice) * Vec2{b.y * dot(a, a) - a.y * dot(b, b), a.x * dot(b, b) - b.x * dot(a, a)};
}

struct Reach {
  double least = 1e300;
  double most = 0.0;
};

/// The distances from the hood's axis at which parts lie whose names hold a word.
Reach reach_of(const Made& all, const std::string& word) {
  const Vec2 centre = centre_of(all);
  Reach reach;
  for (const ShopPart& part : all.workshop().parts) {
    if (!part.name.starts_with("hood_") || part.name.find(word) == std::string::npos) continue;
    const TriangleMesh mesh = parts::facets_of(part.body, 1e-5);
    for (const Frame& place : part.places) {
      for (const Vec3 vertex : mesh.vertices) {
        const Vec3 at = place.to_space(vertex);
        const double away = norm(Vec2{at.x, at.z} - centre);
        reach = {std::min(reach.least, away), std::max(reach.most, away)};
      }
    }
  }
  return reach;
}

double volume_of_hood(const Made& all) {
  double volume = 0.0;
  for (const ShopPart& part : all.workshop().parts) {
    if (part.name.starts_with("hood_floor") || part.name.starts_with("hood_wall"))
      volume += part.volume * static_cast<double>(part.quantity());
  }
  return volume;
}

}  // namespace

TEST_CASE("hood parts: floor and walls are the solid of the hood, where the stream meets it") {
  const Made all = made(transfer("{process: plate}"));
  REQUIRE(all.assembly.parts.size() == 2);
  CHECK(volume_of_hood(all) == Approx(all.assembly.parts[1].solid->solid.exact_volume).epsilon(1e-9));
  // The floor's face is the underside; walls hang down from beside it.
  const Reach floor = reach_of(all, "floor");
  CHECK(floor.least == Approx(kRadius).epsilon(2e-5));
  CHECK(floor.most == Approx(kRadius + 8e-3).epsilon(2e-5));
  const Reach wall = reach_of(all, "wall");
  CHECK(wall.least == Approx(kRadius - 0.4).epsilon(2e-4));
  CHECK(wall.most == Approx(kRadius + 8e-3).epsilon(2e-5));
  // The proof counts both, and the lists tell the hood's.
  CHECK(all.assembly.fabrication->proof.volume ==
        Approx(all.assembly.parts[0].solid->solid.exact_volume + volume_of_hood(all)).epsilon(1e-6));
  const Vec2 centre = centre_of(all);
  std::size_t rows = 0;
  for (const SettingOutPoint& point : all.workshop().setting_out) {
    if (!point.what.starts_with("hood ")) continue;
    ++rows;
    CHECK(norm(Vec2{point.x, point.z} - centre) == Approx(kRadius).epsilon(1e-6));
    CHECK(norm(Vec2{point.site.x - 2.0, point.site.z - 3.0} - Vec2{point.x, point.z}) < 1e-9);
    CHECK(point.radius == Approx(-kRadius).epsilon(1e-4));
  }
  CHECK(rows > 8);
}

TEST_CASE("hood parts: every section and make hangs with its face on the underside") {
  const std::string sections[] = {
      "{kind: trapezoid, width: 700 mm, wall_height: 300 mm, wall_angle: 20 deg, thickness: 6 mm}",
      "{kind: u-channel, width: [{at: 0 m, width: 800 mm}, {at: 1.5 m, width: 700 mm}], wall_height: 300 mm, "
      "thickness: 6 mm}",
      kChannel};
  int combination = 0;
  for (const std::string& section : sections) {
    for (const char* const make : {"floor: rolled", "floor: bent", "split: {widest: 300 mm}"}) {
      // Each section made in one of the three ways, elsewhere than in CI.
      const int number = combination++;
      if (number % 3 != number / 3 && !testing::thorough()) continue;
      INFO(section << " " << make);
      const Made all = made(transfer("{process: plate, flanges: none, " + std::string(make) + "}", section));
      const Reach floor = reach_of(all, "floor");
      // Flats touch the underside from outside.
      CHECK(floor.least == Approx(kRadius).epsilon(2e-5));
      CHECK(floor.most < kRadius + 0.02);
    }
  }
}

TEST_CASE("hood parts: a liner covers the underside whole, rims and stiffeners go round it") {
  const Made all =
      made(transfer("{process: plate, liner: {thickness: 10 mm}, rim: {}, stiffeners: {spacing: 300 mm}, "
                    "lifting: {}}",
                    kChannel, "900 mm"));
  const Reach tiles = reach_of(all, "tile");
  CHECK(tiles.least == Approx(kRadius).epsilon(2e-5));
  CHECK(tiles.most == Approx(kRadius + 10e-3).epsilon(2e-5));
  CHECK(reach_of(all, "floor").most == Approx(kRadius + 18e-3).epsilon(2e-5));
  CHECK(reach_of(all, "rim").least == Approx(kRadius - 0.4).epsilon(2e-4));
  for (const ShopPart& part : all.workshop().parts) {
    INFO(part.name);
    CHECK(part.name.find("hood_lug") == std::string::npos);
  }
  std::vector<int> numbers;
  for (const ShopPart& part : all.workshop().parts) numbers.push_back(part.number);
  for (std::size_t i = 0; i < numbers.size(); ++i) CHECK(numbers[i] == static_cast<int>(i) + 1);
  for (const BendStep& step : all.workshop().bends) {
    const ShopPart& part = all.workshop().parts.at(static_cast<std::size_t>(step.part) - 1);
    CHECK(part.name.find("floor") != std::string::npos);
  }
}

TEST_CASE("hood parts: a hood that is left a solid, and one whose frames meet those of the track") {
  const std::string solid = transfer("{process: plate, hood: false}");
  const Made all = made(solid);
  for (const ShopPart& part : all.workshop().parts) CHECK_FALSE(part.name.starts_with("hood_"));
  CHECK(std::find(all.workshop().notes.begin(), all.workshop().notes.end(),
                  "The hood is a solid alone: these are the parts of the track.") !=
        all.workshop().notes.end());
  CHECK(parse_design(design_text(all.design), "d.yaml").fabrication == all.design.fabrication);

  const std::string near = refusal(transfer("{process: plate}", kChannel, "10 mm"));
  CHECK_THAT(near, Contains("hood and track do not go together: parts clash"));
  CHECK_THAT(near, Contains("d.yaml:6:1"));
  CHECK_THAT(near, Contains("Try: a larger drop, narrower or no flanges"));
  std::string none = transfer("{process: plate, hood: false}");
  none.erase(none.find("hood: {"), none.find("discharge") - none.find("hood: {"));
  CHECK_THAT(refusal(none), Contains("hood: false, of a design without a hood"));
}

}  // namespace hood_parts_test
