#include "support/known_profiles.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

namespace testing {

using namespace glissade;

namespace {

double radians(double degrees) {
  return degrees * std::numbers::pi / 180.0;
}

/// eta = C xi^3 along the tangent where it begins.
struct CubicParabola {
  double c = 0.0;
  double reach = 0.0;  // xi at its end

  [[nodiscard]] double stretch(double xi) const { return std::sqrt(1.0 + 9.0 * c * c * std::pow(xi, 4)); }
  [[nodiscard]] double curvature(double xi) const { return 6.0 * c * xi / std::pow(stretch(xi), 3); }
  /// Simpson's rule in many steps.
  [[nodiscard]] double arc_length(double xi) const {
    constexpr int kSteps = 200;
    double sum = 0.0;
    for (int i = 0; i < kSteps; ++i) {
      const double a = xi * i / kSteps;
      const double b = xi * (i + 1) / kSteps;
      sum += (b - a) / 6.0 * (stretch(a) + 4.0 * stretch(0.5 * (a + b)) + stretch(b));
    }
    return sum;
  }
  [[nodiscard]] double xi_at(double s) const {
    double xi = s;
    for (int i = 0; i < 8; ++i) xi -= (arc_length(xi) - s) / stretch(xi);
    return xi;
  }
};

}  // namespace

KnownProfile known_profile(std::string name, double entry_slope_deg, std::vector<ClothoidSegment> segments) {
  double sharpest = 0.0;
  for (const ClothoidSegment& segment : segments) {
    sharpest = std::max({sharpest, segment.entry_curvature, segment.exit_curvature});
  }
  auto truth =
      std::make_shared<const ClothoidSpline>(Angle::from_degrees(entry_slope_deg), std::move(segments));
  const auto at = [truth](double s) {
    const CenterlinePoint place = truth->at(std::min(s, truth->length()));
    return Vec2{place.x, place.drop};
  };
  return {std::move(name), truth->length(), at, truth, 1.0 / sharpest};
}

KnownProfile known_in_run(double gamma, double alpha, double r1, double table, double straight) {
  const double turn = radians(gamma - alpha);
  const double reach = 2.0 * r1 * std::sin(turn) * std::cos(turn) * std::cos(turn);
  const CubicParabola parabola{std::tan(turn) / (3.0 * reach * reach), reach};
  const double transition = parabola.arc_length(reach);
  const Vec2 down{std::cos(radians(gamma)), std::sin(radians(gamma))};
  const Vec2 up{down.y, -down.x};
  const Vec2 take_off{std::cos(radians(alpha)), std::sin(radians(alpha))};
  const auto at = [=](double s) {
    if (s <= straight) return s * down;
    const double xi = parabola.xi_at(std::min(s - straight, transition));
    const Vec2 bend = (straight + xi) * down + (parabola.c * xi * xi * xi) * up;
    return bend + std::max(0.0, s - straight - transition) * take_off;
  };
  // Curvature linear between places so near that what it leaves out is some 1e-9 of the length.
  constexpr int kPieces = 500;
  std::vector<ClothoidSegment> segments = {{straight, 0.0, 0.0}};
  double before = 0.0;
  for (int i = 1; i <= kPieces; ++i) {
    const double xi = parabola.xi_at(transition * i / kPieces);
    const double curvature = parabola.curvature(xi);
    segments.push_back({transition / kPieces, before, curvature});
    before = curvature;
  }
  segments.push_back({table, 0.0, 0.0});
  auto truth = std::make_shared<const ClothoidSpline>(Angle::from_degrees(gamma), std::move(segments));
  return {"in-run", straight + transition + table, at, truth, r1};
}

double bell(Random& random) {
  double sum = -6.0;
  for (int i = 0; i < 12; ++i) sum += random.between(0.0, 1.0);
  return sum;
}

std::vector<Vec2> points_of(const KnownProfile& profile, int count, double noise, Random& random) {
  std::vector<Vec2> points;
  for (int i = 0; i < count; ++i) {
    const Vec2 point = profile.at(profile.length * (static_cast<double>(i) / (count - 1)));
    points.push_back({point.x + noise * bell(random), point.y + noise * bell(random)});
  }
  return points;
}

double smallest_valley_radius(const ClothoidSpline& curve) {
  double sharpest = 0.0;
  for (const ClothoidSegment& segment : curve.segments()) {
    sharpest = std::max({sharpest, segment.entry_curvature, segment.exit_curvature});
  }
  return 1.0 / sharpest;
}

double largest_curvature(const ClothoidSpline& curve) {
  double sharpest = 0.0;
  for (const ClothoidSegment& segment : curve.segments()) {
    sharpest = std::max({sharpest, std::fabs(segment.entry_curvature), std::fabs(segment.exit_curvature)});
  }
  return sharpest;
}

namespace {

constexpr double kWaveRun = 60.0;
constexpr double kWaveFall = 0.35;
constexpr double kWaveHeights = 0.6;

}  // namespace

std::vector<Vec2> RoundedWave::points() const {
  const auto rounded = [](double value) { return std::round(value * 1e3) / 1e3; };
  const double turn = 2.0 * std::numbers::pi * periods / kWaveRun;
  std::vector<Vec2> points;
  for (int i = 0; i < count; ++i) {
    const double x = kWaveRun * i / (count - 1);
    const double wave = kWaveHeights / periods * std::sin(turn * x + phase);
    points.push_back({rounded(x), rounded(kWaveFall * x - wave)});
  }
  return points;
}

double RoundedWave::smallest_radius() const {
  constexpr int kPlaces = 20'000;
  const double turn = 2.0 * std::numbers::pi * periods / kWaveRun;
  const double height = kWaveHeights / periods;
  double largest = 0.0;
  for (int i = 0; i <= kPlaces; ++i) {
    const double angle = turn * kWaveRun * i / kPlaces + phase;
    const double slope = kWaveFall - height * turn * std::cos(angle);
    largest = std::max(
        largest, std::fabs(height * turn * turn * std::sin(angle)) / std::pow(1.0 + slope * slope, 1.5));
  }
  return 1.0 / largest;
}

}  // namespace testing
