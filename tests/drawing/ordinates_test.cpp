// Ordinates of curved edges, against the circle.

#include "drawing/ordinates.hpp"

#include "glissade/core/math.hpp"

#include "support/catch.hpp"

#include <cmath>
#include <string>

using namespace glissade;

namespace {

/// Between two concentric arcs round (1, 10), from x = 0 to 2 on the lower one; the lower one sags to 1 at x = 1.
ArcPath sagging(double radius, double depth) {
  const Vec2 centre{1.0, 10.0};
  const double half = std::asin(1.0 / radius);
  const auto at = [&](double r, double angle) {
    return centre + r * Vec2{std::sin(angle), -std::cos(angle)};
  };
  ArcPath path;
  path.closed = true;
  path.vertices = {{at(radius, -half), std::tan(0.5 * half)},
                   {at(radius, half), 0.0},
                   {at(radius - depth, half), -std::tan(0.5 * half)},
                   {at(radius - depth, -half), 0.0}};
  return path;
}

}  // namespace

TEST_CASE("ordinates: both edges of a curved strip are those of their circles, at round distances") {
  const ArcPath path = sagging(9.0, 0.2);
  for (const double x : {0.1, 0.4, 1.0, 1.9}) {
    const auto heights = drawing::heights_at(path, x);
    REQUIRE(heights);
    CHECK(heights->first == Approx(10.0 - std::sqrt(81.0 - (x - 1.0) * (x - 1.0))).epsilon(1e-9));
    CHECK(heights->second == Approx(10.0 - std::sqrt(8.8 * 8.8 - (x - 1.0) * (x - 1.0))).epsilon(1e-9));
  }
  CHECK_FALSE(drawing::heights_at(path, 3.0));
  const SheetTable table = drawing::ordinate_table(path);
  REQUIRE(table.rows.size() == 21);  // every 100 mm of 2 m
  CHECK(table.rows[10][0] == "1000");
  CHECK(table.rows[10][1] == "0");    // the lowest point
  CHECK(table.rows[10][2] == "200");  // a strip of 200 mm
  CHECK(table.rows[3][1] == table.rows[17][1]);
}

TEST_CASE("ordinates: straight and short pieces have none") {
  CHECK(drawing::ordinate_table(rectangle({}, {2.0, 0.2})).rows.empty());
  ArcPath small = sagging(9.0, 0.2);
  for (PathVertex& vertex : small.vertices) vertex.at = 0.1 * vertex.at;
  CHECK(drawing::ordinate_table(small).rows.empty());
}
