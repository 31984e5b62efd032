// The proof that no two parts clash, on bodies whose faces lie in one another's: no edge of either is inside the other.

#include "parts/bodies/clash.hpp"

#include "glissade/core/error.hpp"
#include "glissade/parts/shop_part.hpp"

#include "support/catch.hpp"

#include <string>

namespace clash_test {

using namespace glissade;

namespace {

ShopPart part(const char* name, PartBody body, double thickness, Vec3 origin) {
  ShopPart one;
  one.name = name;
  one.thickness = thickness;
  one.body = std::move(body);
  one.places = {Frame{origin, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}};
  return one;
}

/// A ring 6 mm thick, so deep.
Prism ring(double depth) {
  const auto circle = [](double radius) {
    return ArcPath{{{{radius, 0.0}, 1.0}, {{-radius, 0.0}, 1.0}}, true};
  };
  return {{circle(0.2), {circle(0.194)}, {}}, depth};
}

/// What is told of two parts, the second one moved.
std::string told(const PartBody& body, const PartBody& other, double thickness, Vec3 moved) {
  Workshop workshop;
  workshop.parts = {part("one", body, thickness, {}), part("other", other, thickness, moved)};
  try {
    (void)parts::require_no_clash(workshop);
  } catch (const InternalError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("bodies that lie flush in one another clash, those that touch do not") {
  const ArcPath square{{{{0.0, 0.0}, 0.0}, {{0.3, 0.0}, 0.0}, {{0.3, 0.05}, 0.0}, {{0.0, 0.05}, 0.0}}, true};
  const Prism bar{{square, {}, {}}, 6e-3};
  TubeGore tube;
  tube.inner_radius = 0.1;
  tube.thickness = 4e-3;
  tube.length = 0.5;
  struct Case {
    const char* what;
    PartBody body;
    double thickness;
    Vec3 overlapping;
    Vec3 touching;
  };
  const Case cases[] = {{"legs of rings", ring(75e-3), 6e-3, {0.0, 0.0, 30e-3}, {0.0, 0.0, 75e-3}},
                        {"bars", bar, 6e-3, {0.1, 0.0, 0.0}, {0.3, 0.0, 0.0}},
                        {"bars upon one another", bar, 6e-3, {0.0, 0.0, 3e-3}, {0.0, 0.0, 6e-3}},
                        {"tubes", tube, 4e-3, {0.0, 0.0, 0.2}, {0.0, 0.0, 0.5}},
                        {"one twice", ring(75e-3), 6e-3, {}, {0.0, 0.0, 75e-3}}};
  for (const Case& one : cases) {
    INFO(one.what);
    CHECK(told(one.body, one.body, one.thickness, one.overlapping).find("parts clash: ") !=
          std::string::npos);
    CHECK(told(one.body, one.body, one.thickness, one.touching) == "");
  }
}

}  // namespace clash_test
