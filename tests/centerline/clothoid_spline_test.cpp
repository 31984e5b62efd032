#include "glissade/centerline/clothoid_spline.hpp"

#include "glissade/core/error.hpp"

#include "support/catch.hpp"
#include "support/paths.hpp"
#include "support/random.hpp"
#include "support/thorough.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <numbers>
#include <string>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <nlohmann/json.hpp>

using namespace glissade;

namespace {

using Precise = boost::multiprecision::cpp_bin_float_50;

struct PrecisePoint {
  Precise x = 0;
  Precise drop = 0;
  Precise zeta = 0;
};

/// The same track by the composite Simpson rule with Richardson extrapolation in 50 digits: no code in
/// common.
PrecisePoint integrate(double entry_slope_angle, const std::vector<ClothoidSegment>& segments) {
  PrecisePoint end;
  end.zeta = entry_slope_angle;
  for (const ClothoidSegment& segment : segments) {
    const Precise length = segment.length;
    const Precise kappa = segment.entry_curvature;
    const Precise rate = (Precise(segment.exit_curvature) - kappa) / length;
    const auto zeta = [&](const Precise& t) { return Precise(end.zeta - kappa * t - rate * t * t / 2); };
    const auto simpson = [&](int panels, auto component) {
      Precise sum = component(zeta(0)) + component(zeta(length));
      for (int i = 1; i < 2 * panels; ++i)
        sum += (i % 2 == 1 ? 4 : 2) * component(zeta(length * i / (2 * panels)));
      return Precise(sum * length / (6 * panels));
    };
    const auto extrapolated = [&](auto component) {
      std::vector<Precise> column;
      for (int panels = 4; panels <= 512; panels *= 2) column.push_back(simpson(panels, component));
      for (int order = 4; column.size() > 1; order += 2) {
        const Precise factor = pow(Precise(2), order);
        for (std::size_t i = 0; i + 1 < column.size(); ++i) {
          column[i] = (factor * column[i + 1] - column[i]) / (factor - 1);
        }
        column.pop_back();
      }
      return column.front();
    };
    const Precise dx = extrapolated([](const Precise& angle) { return Precise(cos(angle)); });
    const Precise dy = extrapolated([](const Precise& angle) { return Precise(sin(angle)); });
    end = {end.x + dx, end.drop + dy, zeta(length)};
  }
  return end;
}

}  // namespace

TEST_CASE("clothoid spline: agrees with 50-digit integration on random tracks") {
  auto random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (int track = 0; track < (testing::thorough() ? 25 : 10); ++track) {
    const double scale = std::pow(10.0, random.between(-3.0, 5.0));
    std::vector<ClothoidSegment> segments;
    const int count = random.integer(1, 4);
    for (int i = 0; i < count; ++i) {
      const double from = random.between(-3.0, 3.0) / scale;
      const double to = random.integer(0, 2) == 0 ? from : random.between(-3.0, 3.0) / scale;
      segments.push_back({random.between(0.1, 1.0) * scale, random.integer(0, 4) == 0 ? 0.0 : from, to});
    }
    const double entry = random.between(-1.5, 1.5);
    const ClothoidSpline spline(Angle::from_radians(entry), segments);
    const PrecisePoint expected = integrate(entry, segments);
    const CenterlinePoint finish = spline.at(spline.length());
    CHECK(std::fabs(finish.x - expected.x.convert_to<double>()) <= kClothoidAccuracy * spline.length());
    CHECK(std::fabs(finish.drop - expected.drop.convert_to<double>()) <= kClothoidAccuracy * spline.length());
    CHECK(finish.slope_angle == Approx(expected.zeta.convert_to<double>()).epsilon(1e-14).margin(1e-14));
  }
}

TEST_CASE("clothoid spline: meets the finish of every reference track") {
  std::ifstream file(test_data_path("reference/pudasaini_and_tracks.json"));
  const auto tracks = nlohmann::json::parse(file).at("tracks");
  REQUIRE(tracks.size() == 15);
  const auto number = [](const nlohmann::json& text) { return std::stod(text.get<std::string>()); };
  for (const auto& track : tracks) {
    std::vector<ClothoidSegment> segments;
    for (const auto& s : track.at("segments")) segments.push_back({s.at(0), s.at(1), s.at(2)});
    const ClothoidSpline spline(Angle::from_radians(track.at("entry_slope_angle")), segments);
    const CenterlinePoint finish = spline.at(spline.length());
    CHECK(spline.length() == Approx(number(track.at("arc_length"))).epsilon(1e-15));
    CHECK(std::fabs(finish.x - number(track.at("x"))) <= kClothoidAccuracy * spline.length());
    CHECK(std::fabs(finish.drop - number(track.at("drop"))) <= kClothoidAccuracy * spline.length());
    CHECK(std::fabs(finish.slope_angle - number(track.at("exit_slope_angle"))) <= 1e-14);
  }
}

TEST_CASE("clothoid spline: a circle closes, however often it is run through") {
  for (const double turns : {1.0, 7.0, 1000.0}) {
    const ClothoidSpline circle(Angle::from_radians(0.3), {{turns * 2.0 * std::numbers::pi * 2.0, 0.5, 0.5}});
    const CenterlinePoint finish = circle.at(circle.length());
    CHECK(std::hypot(finish.x, finish.drop) <= kClothoidAccuracy * circle.length());
  }
}

TEST_CASE("clothoid spline: however much it turns, what follows leads on as closely as is stated") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (int i = 0; i < (testing::thorough() ? 200 : 25); ++i) {
    const double turning = i == 0 ? 999'999.7 : std::exp(random.between(0.0, std::log(1e6)));
    const double sign = i % 2 == 0 ? 1.0 : -1.0;
    const double straight = random.between(0.5, 20.0);
    CAPTURE(turning, sign, straight);
    const ClothoidSpline spline(Angle::from_radians(0.3),
                                {{1.0, sign * turning, sign * turning}, {straight, 0.0, 0.0}});
    const Precise kappa = sign * turning;
    const Precise zeta = Precise(0.3) - kappa;
    const Precise x = (sin(Precise(0.3)) - sin(zeta)) / kappa + straight * cos(zeta);
    const Precise drop = (cos(zeta) - cos(Precise(0.3))) / kappa + straight * sin(zeta);
    const CenterlinePoint finish = spline.at(spline.length());
    const double error =
        std::hypot((finish.x - x).convert_to<double>(), (finish.drop - drop).convert_to<double>());
    CHECK(error <= clothoid_accuracy(turning) * spline.length());
  }
}

TEST_CASE("clothoid spline: position, slope angle and curvature belong together everywhere") {
  const ClothoidSpline spline(
      Angle::from_radians(1.2),
      {{2.0, 0.0, 0.4}, {1.0, 0.4, 0.4}, {3.0, -0.2, 0.3}, {1.5, 0.0, 0.0}, {2.0, 0.1, 9.0}});
  constexpr double kStep = 1e-4;
  for (double s = 0.05; s < spline.length() - 0.05; s += 0.01) {
    const auto joints = spline.breaks();
    const bool near_joint = std::any_of(joints.begin(), joints.end(),
                                        [&](double joint) { return std::fabs(joint - s) < 2 * kStep; });
    if (near_joint) continue;
    const CenterlinePoint before = spline.at(s - kStep);
    const CenterlinePoint here = spline.at(s);
    const CenterlinePoint after = spline.at(s + kStep);
    CHECK((after.x - before.x) / (2 * kStep) == Approx(std::cos(here.slope_angle)).margin(5e-7));
    CHECK((after.drop - before.drop) / (2 * kStep) == Approx(std::sin(here.slope_angle)).margin(5e-7));
    CHECK((before.slope_angle - after.slope_angle) / (2 * kStep) == Approx(here.curvature).margin(1e-9));
    CHECK(spline.slope_angle(s) == here.slope_angle);
    CHECK(spline.direction(s).curvature == here.curvature);
  }
}

TEST_CASE("clothoid spline: at a jump of curvature the value after it counts, position and slope go on") {
  const ClothoidSpline spline(Angle::from_radians(0.5), {{1.0, 0.0, 0.1}, {1.0, -0.3, -0.3}});
  CHECK(spline.breaks() == std::vector<double>{0.0, 1.0, 2.0});
  const CenterlinePoint before = spline.at(std::nextafter(1.0, 0.0));
  const CenterlinePoint joint = spline.at(1.0);
  CHECK(before.curvature == Approx(0.1).epsilon(1e-14));
  CHECK(joint.curvature == -0.3);
  CHECK(joint.x == Approx(before.x).epsilon(1e-15));
  CHECK(joint.slope_angle == Approx(before.slope_angle).epsilon(1e-15));
}

TEST_CASE("clothoid spline: a track cut into thousands of segments stays where it was") {
  const ClothoidSpline whole(Angle::from_radians(1.0), {{100.0, 0.0, 0.02}});
  std::vector<ClothoidSegment> cut;
  constexpr int kPieces = 8192;
  for (int i = 0; i < kPieces; ++i)
    cut.push_back({100.0 / kPieces, 0.02 * i / kPieces, 0.02 * (i + 1) / kPieces});
  const ClothoidSpline pieces(Angle::from_radians(1.0), cut);
  CHECK(pieces.length() == whole.length());
  CHECK(std::fabs(pieces.endpoints().run - whole.endpoints().run) <= kClothoidAccuracy * whole.length());
  CHECK(std::fabs(pieces.endpoints().drop - whole.endpoints().drop) <= kClothoidAccuracy * whole.length());
}

TEST_CASE("clothoid spline: says which segment is unusable and why") {
  const Angle level = Angle::from_radians(0.0);
  CHECK_THROWS_WITH(ClothoidSpline(level, {}), Catch::Matchers::Contains("segments: there are none"));
  CHECK_THROWS_WITH(ClothoidSpline(level, {{1.0, 0.0, 0.0}, {0.0, 0.0, 0.0}}),
                    Catch::Matchers::Contains("segments[1]: length: 0 m is not positive"));
  CHECK_THROWS_WITH(ClothoidSpline(level, {{1e308, 0.0, 0.0}, {1e308, 0.0, 0.0}}),
                    Catch::Matchers::Contains("segments: their length is beyond the range of numbers"));
  CHECK_THROWS_WITH(ClothoidSpline(level, {{1.0, std::nan(""), 0.0}}),
                    Catch::Matchers::Contains("segments[0]: curvature: nan 1/m is not finite"));
  CHECK_THROWS_WITH(ClothoidSpline(level, {{1.0, 0.0, 1e9}}),
                    Catch::Matchers::Contains("turns by up to 1000000000 rad"));
  CHECK_THROWS_WITH(ClothoidSpline(level, {{1.0, 0.0, 1.0001e6}}),
                    Catch::Matchers::Contains("turns by up to 1000100 rad") &&
                        Catch::Matchers::Contains("may turn by 1000000 rad in all"));
  CHECK_THROWS_WITH(ClothoidSpline(level, {{1.0, 0.0, 5e5}, {1.0, 5.00001e5, 0.0}}),
                    Catch::Matchers::Contains("they turn by up to 1000001 rad in all"));
  CHECK_THROWS_WITH(
      ClothoidSpline(Angle::from_radians(std::numeric_limits<double>::infinity()), {{1.0, 0.0, 0.0}}),
      Catch::Matchers::Contains("entry slope angle: inf deg is not finite"));
}
