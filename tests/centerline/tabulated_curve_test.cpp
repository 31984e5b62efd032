#include "glissade/centerline/tabulated_curve.hpp"

#include "glissade/centerline/clothoid_spline.hpp"
#include "glissade/centerline/constant_speed_curve.hpp"
#include "glissade/centerline/coulomb_brachistochrone.hpp"
#include "glissade/centerline/cycloid.hpp"
#include "glissade/centerline/flying_start_brachistochrone.hpp"
#include "glissade/centerline/straight_line.hpp"
#include "glissade/core/error.hpp"
#include "glissade/motion/motion.hpp"

#include "support/catch.hpp"
#include "support/thorough.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace tabulated_curve_test {

using namespace glissade;
using Catch::Matchers::Contains;

namespace {

struct Ridden {
  std::string name;
  CenterlinePtr curve;
  double entry_speed = 0.0;
};

std::vector<Ridden> curves() {
  const Friction friction = Friction::from_coefficient(0.2);
  const Endpoints ends{10.0, 6.0};
  std::vector<Ridden> all = {
      {"brachistochrone", std::make_shared<CoulombBrachistochrone>(ends, friction)},
      {"flat brachistochrone", std::make_shared<CoulombBrachistochrone>(Endpoints{10.0, 2.6}, friction)},
      {"constant speed", std::make_shared<ConstantSpeedCurve>(
                             ConstantSpeedCurve::fastest(ends, friction, kDefaultGravity, 0.0))},
      {"straight", std::make_shared<StraightLine>(ends)},
      {"cycloid", std::make_shared<Cycloid>(ends)},
  };
  for (const Endpoints& flown :
       {Endpoints{10.0, 6.0}, Endpoints{40.0, 7.0}, Endpoints{0.3, 12.0}, Endpoints{4.0, -0.5}}) {
    all.push_back({"flight first", std::make_shared<FlyingStartBrachistochrone>(flown, friction, 7.0), 7.0});
    all.push_back({"flight", std::make_shared<FlyingStartBrachistochrone>(flown, friction, 90.0), 90.0});
  }
  // Jumps of curvature, which a table says by two rows.
  all.push_back({"straight, arc, straight",
                 std::make_shared<ClothoidSpline>(
                     Angle::from_degrees(50.0),
                     std::vector<ClothoidSegment>{{4.0, 0.0, 0.0}, {2.0, 0.2, 0.2}, {3.0, 0.0, 0.1}})});
  return all;
}

std::string refusal(std::vector<TabulatedPoint> rows) {
  try {
    const TabulatedCurve curve(std::move(rows));
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace

TEST_CASE("a table takes rows where a curve bends, not where rounding decides") {
  // Of a curve with many breaks, next to an unbounded curvature lie stretches that turn by hardly more than rounding.
  class Another final : public Centerline {
   public:
    explicit Another(const Centerline& of) : of_(of) {}
    [[nodiscard]] std::string_view kind() const noexcept override { return "another"; }
    [[nodiscard]] double length() const noexcept override { return of_.length(); }
    [[nodiscard]] CenterlinePoint at(double s) const override { return of_.at(s); }
    [[nodiscard]] double slope_angle(double s) const override { return of_.slope_angle(s); }
    [[nodiscard]] Direction direction(double s) const override { return of_.direction(s); }
    [[nodiscard]] std::vector<double> breaks() const override { return of_.breaks(); }
    [[nodiscard]] bool unbounded_curvature_at_start() const noexcept override {
      return of_.unbounded_curvature_at_start();
    }

   private:
    const Centerline& of_;
  };
  const CoulombBrachistochrone curve({3.0, 2.0}, Friction::from_angle(Angle::from_degrees(17.0)));
  const TabulatedCurve table(table_of(curve));
  CHECK(table_of(table).size() == table.rows().size());
  CHECK(table_of(Another(table)).size() < 40 * table.rows().size());
}

TEST_CASE("a table of a curve is that curve, for bodies of any friction") {
  for (const Ridden& ridden : curves()) {
    INFO(ridden.name);
    const auto again = std::make_shared<const TabulatedCurve>(table_of(*ridden.curve));
    CHECK(again->length() == Approx(ridden.curve->length()).epsilon(1e-11));
    CHECK(again->unbounded_curvature_at_start() == ridden.curve->unbounded_curvature_at_start());
    for (const double share : {0.001, 0.1, 0.37, 0.62, 1.0}) {
      const CenterlinePoint was = ridden.curve->at(share * ridden.curve->length());
      const CenterlinePoint is = again->at(share * again->length());
      CHECK(is.x == Approx(was.x).epsilon(1e-9).margin(1e-10));
      CHECK(is.drop == Approx(was.drop).epsilon(1e-9).margin(1e-10));
      CHECK(is.slope_angle == Approx(was.slope_angle).margin(1e-8));
    }
    for (const double mu : {0.1, 0.2, 0.24}) {
      const Body body{Friction::from_coefficient(mu), ridden.entry_speed, 0.0};
      const Motion was(ridden.curve, body);
      const Motion is(again, body);
      INFO("friction coefficient " << mu);
      REQUIRE(is.arrived() == was.arrived());
      if (!was.arrived()) continue;
      CHECK(is.travel_time() == Approx(was.travel_time()).epsilon(kTableAccuracy));
      CHECK(is.exit_speed() == Approx(was.exit_speed()).epsilon(kTableAccuracy));
      CHECK(is.highest_load().normal_load ==
            Approx(was.highest_load().normal_load).epsilon(1e-6).margin(1e-9));
    }
  }
}

namespace {

/// Holds a table against the curve that it was made of, for the body the curve is fastest for.
void check_ride_from(std::vector<TabulatedPoint> rows, const CenterlinePtr& curve, const Body& body,
                     double rounding) {
  const Motion was(curve, body);
  REQUIRE(was.arrived());
  const Motion is(std::make_shared<const TabulatedCurve>(std::move(rows)), body);
  REQUIRE(is.arrived());
  const double v2 = was.exit_speed() * was.exit_speed();
  const double energy = body.entry_speed * body.entry_speed + 2.0 * kDefaultGravity * curve->length();
  const double off = rounding * energy;
  CHECK(std::fabs(is.exit_speed() * is.exit_speed() - v2) <= 2.0 * kTableAccuracy * v2 + off);
  CHECK(std::fabs(is.travel_time() - was.travel_time()) <=
        kTableAccuracy * was.travel_time() + off / (kDefaultGravity * was.exit_speed()));
  CHECK(is.centerline().length() == Approx(curve->length()).epsilon(kTableAccuracy));
}

/// Rows at stations as `solve --csv` has them, in coordinates that count from `origin`.
std::vector<TabulatedPoint> rows_at_stations(const Centerline& curve, double origin) {
  constexpr int kStations = 400;
  std::vector<double> stations;
  for (int i = 0; i <= kStations; ++i) stations.push_back(curve.length() * i / kStations);
  stations.back() = curve.length();
  const double shortest = 256.0 * std::numeric_limits<double>::epsilon() * (origin + 2.0 * curve.length());
  std::vector<TabulatedPoint> rows;
  for (const double s : places_for_table(curve, stations, shortest)) {
    const CenterlinePoint at = curve.at(s);
    rows.push_back({origin + at.x, origin + at.drop, at.slope_angle, s == 0.0 ? HUGE_VAL : at.curvature});
  }
  return rows;
}

}  // namespace

TEST_CASE("tables of fastest tracks next to the limit of what can be reached come back") {
  const std::vector<double> coefficients =
      testing::thorough() ? std::vector{0.02, 0.3, 2.0} : std::vector{0.3};
  const std::vector<double> margins =
      testing::thorough() ? std::vector{0.15, 0.05, 0.03, 0.01, 1e-3, 1e-4} : std::vector{0.05, 1e-4};
  for (const double mu : coefficients) {
    for (const double margin : margins) {
      const Friction friction = Friction::from_coefficient(mu);
      const auto curve =
          std::make_shared<const CoulombBrachistochrone>(Endpoints{3.0, 3.0 * mu * (1.0 + margin)}, friction);
      INFO("friction coefficient " << mu << ", " << margin << " above the limit");
      std::vector<TabulatedPoint> rows = table_of(*curve);
      CHECK(rows.size() < 30000);
      check_ride_from(std::move(rows), curve, {friction, 0.0, 0.0}, kTableRounding);
      check_ride_from(rows_at_stations(*curve, 0.0), curve, {friction, 0.0, 0.0}, kTableRounding);
    }
  }
}

TEST_CASE("a bend that is lost in the rounding of places is no fault of its rows") {
  const Friction friction = Friction::from_coefficient(0.1);
  const std::vector<double> margins =
      testing::thorough() ? std::vector{1e-2, 1e-4, 1e-5, 1e-6, 1e-8, 1e-10, 1e-12} : std::vector{1e-10};
  for (const double margin : margins) {
    const CoulombBrachistochrone curve({3.0, 0.3 * (1.0 + margin)}, friction);
    INFO(margin << " above the limit of what can be reached");
    CHECK(refusal(rows_at_stations(curve, 0.0)) == "accepted");
    CHECK(refusal(rows_at_stations(curve, 4321.0)) == "accepted");
    const TabulatedCurve table(table_of(curve));  // one that is refused throws
    CHECK(table.length() == Approx(curve.length()).epsilon(kTableAccuracy));
    CHECK(table.at(table.length()).slope_angle == Approx(curve.at(curve.length()).slope_angle).margin(1e-9));
  }
}

TEST_CASE("a long flight in one stretch is no fault of its rows") {
  const Friction friction = Friction::from_coefficient(4.83992);
  const auto curve =
      std::make_shared<const FlyingStartBrachistochrone>(Endpoints{215.0, 1990.0}, friction, 2.14);
  REQUIRE(curve->flight_length() > 10.0);
  for (const double side : {1.0, -1.0}) {
    std::vector<TabulatedPoint> rows = table_of(*curve);
    for (TabulatedPoint& row : rows) row.x *= side;
    CHECK(refusal(rows) == "accepted");
  }
}

TEST_CASE("rows twice as dense err sixteen times less") {
  const CoulombBrachistochrone curve({10.0, 6.0}, Friction::from_coefficient(0.2));
  const auto length_error = [&](int rows) {
    std::vector<TabulatedPoint> table;
    for (int i = 0; i <= rows; ++i) {
      const double root = std::sqrt(curve.length()) * i / rows;
      const CenterlinePoint place = curve.at(std::min(root * root, curve.length()));
      table.push_back({place.x, place.drop, place.slope_angle, i == 0 ? HUGE_VAL : place.curvature});
    }
    return std::fabs(TabulatedCurve(table).length() - curve.length());
  };
  CHECK(length_error(8) / length_error(16) > 10.0);
  CHECK(length_error(16) / length_error(32) > 10.0);
}

TEST_CASE("a table that leads to the left is mirrored") {
  const CoulombBrachistochrone curve({10.0, 6.0}, Friction::from_coefficient(0.2));
  std::vector<TabulatedPoint> rows = table_of(curve);
  for (TabulatedPoint& row : rows) row.x = 3.0 - row.x;
  const TabulatedCurve left(rows);
  CHECK(left.at(0.0).x == 0.0);
  CHECK(left.endpoints().run == Approx(10.0).epsilon(1e-10));
}

TEST_CASE("curvatures of another sign or unit than the slope angles show are refused, rounded ones are not") {
  for (const Ridden& ridden : curves()) {
    INFO(ridden.name);
    const auto rows = table_of(*ridden.curve);
    const auto changed = [&](auto change) {
      std::vector<TabulatedPoint> other = rows;
      for (TabulatedPoint& row : other) change(row);
      if (!std::isfinite(other.front().curvature)) other.front().curvature = HUGE_VAL;
      return refusal(std::move(other));
    };
    double turned = 0.0;
    for (std::size_t i = 1; i < rows.size(); ++i)
      turned += std::fabs(rows[i].slope_angle - rows[i - 1].slope_angle);
    INFO("turns by " << turned);
    if (turned > 0.1) {
      for (const double factor : {-1.0, 0.0, 1e-3, 1e3}) {
        CHECK_THAT(changed([&](TabulatedPoint& row) {
                     if (std::isfinite(row.curvature)) row.curvature *= factor;
                   }),
                   Contains("does not agree with the "));
      }
    }
    const double unit = Angle::from_degrees(1e-3).radians();
    CHECK(changed([&](TabulatedPoint& row) {
            row.slope_angle = unit * std::round(row.slope_angle / unit);
          }) == "accepted");
    CHECK(changed([&](TabulatedPoint& row) { row.curvature *= 1.05; }) == "accepted");
  }
}

TEST_CASE(
    "a jump of curvature that a table does not say by two rows is seen, wherever it lies between two rows") {
  const ClothoidSpline track(Angle::from_degrees(50.0), {{4.0, 0.0, 0.0}, {2.0, 0.2, 0.2}, {3.0, 0.0, 0.02}});
  const auto highest_curvature = [](const Centerline& curve) {
    double highest = 0.0;
    for (int i = 0; i <= 20000; ++i) {
      highest = std::max(highest, std::fabs(curve.direction(i * curve.length() / 20000.0).curvature));
    }
    return highest;
  };
  REQUIRE(highest_curvature(track) == Approx(0.2));
  for (const int rows : {45, 90, 181, 360, 997}) {  // 45, 90 and 360 of them have a row at each jump
    for (const bool before : {false, true}) {
      INFO(rows << " rows, " << (before ? "with the curvature before a jump" : "with that behind it"));
      std::vector<TabulatedPoint> table;
      for (int i = 0; i <= rows; ++i) {
        const double s = track.length() * i / rows;
        const CenterlinePoint place = track.at(s);
        const double near = before && i > 0 ? s - 1e-12 : s;
        table.push_back({place.x, place.drop, place.slope_angle, track.direction(near).curvature});
      }
      const TabulatedCurve again(table);
      CHECK(highest_curvature(again) <= 0.2 * 1.005);
      CHECK(again.length() == Approx(track.length()).epsilon(1e-6));
      CHECK(again.endpoints().run == Approx(track.endpoints().run).epsilon(1e-5));
      CHECK(again.endpoints().drop == Approx(track.endpoints().drop).epsilon(1e-5));
    }
  }
}

TEST_CASE("where curvature does not jump no row is added to those of a table") {
  for (const Ridden& ridden : curves()) {
    INFO(ridden.name);
    const auto rows = table_of(*ridden.curve);
    std::size_t jumps = 0;
    for (std::size_t i = 1; i < rows.size(); ++i) {
      jumps += rows[i].x == rows[i - 1].x && rows[i].drop == rows[i - 1].drop ? 1U : 0U;
    }
    CHECK(TabulatedCurve(rows).breaks().size() == rows.size() - jumps);
  }
}

TEST_CASE("rows that contradict themselves are refused by their number") {
  const double level = 0.0;
  CHECK_THAT(refusal({{0.0, 0.0, 0.0, 0.0}}), Contains("no second row"));
  CHECK_THAT(refusal({{0.0, 0.0, 0.5, 0.0}, {1.0, level, 0.5, 0.0}}),
             Contains("row 2 (1, 0)") && Contains("slope angle of 28.65 deg does not agree") &&
                 Contains("leads along 0 deg"));
  CHECK_THAT(refusal({{0.0, 0.0, 0.0, 0.0}, {1.0, 0.0, 0.0, HUGE_VAL}}),
             Contains("row 2") && Contains("curvature is not finite"));
  CHECK_THAT(refusal({{0.0, 0.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 0.0}, {1.0, 0.0, 0.0, 0.0}}),
             Contains("row 2") && Contains("repeats the row before it"));
  CHECK_THAT(
      refusal({{0.0, 0.0, 0.0, 0.0}, {1.0, 0.0, 0.0, 0.0}, {0.5, 0.0, 0.0, 0.0}, {2.0, 0.0, 0.0, 0.0}}),
      Contains("row 3"));
  CHECK(refusal(
            {{0.0, 0.0, 0.0, 0.0}, {1.0, 0.0, 0.0, 0.0}, {1.0, 0.0, 0.0, 0.1}, {1.5, -0.0125, -0.05, 0.1}}) ==
        "accepted");
}

}  // namespace tabulated_curve_test
