#pragma once

#include "glissade/centerline/clothoid_spline.hpp"
#include "glissade/core/vec.hpp"

#include "support/random.hpp"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace testing {

/// A profile whose curvature breaks where it is known to, and what a body finds on it.
struct KnownProfile {
  std::string name;
  double length = 0.0;                                    // [m]
  std::function<glissade::Vec2(double s)> at;             // (run, drop) by arc length [m]
  std::shared_ptr<const glissade::ClothoidSpline> truth;  // the same curve, or within 1e-9 of its length
  double smallest_radius = 0.0;                           // [m]
};

[[nodiscard]] KnownProfile known_profile(std::string name, double entry_slope_deg,
                                         std::vector<glissade::ClothoidSegment> segments);

/// A ski jump's in-run: straight, cubic parabola in the tangent frame of its beginning (curvature from 0 to 1/r1),
/// straight table. Angles in degrees, lengths in metres: `straight` is that above the transition.
[[nodiscard]] KnownProfile known_in_run(double gamma, double alpha, double r1, double table, double straight);

/// Roughly normal, of mean 0 and variance 1: the sum of twelve uniform numbers.
[[nodiscard]] double bell(Random& random);

/// Points at equal steps of arc length, each coordinate off by the noise.
[[nodiscard]] std::vector<glissade::Vec2> points_of(const KnownProfile& profile, int count, double noise,
                                                    Random& random);

/// @return the smallest radius of a valley [m]
[[nodiscard]] double smallest_valley_radius(const glissade::ClothoidSpline& curve);

/// @return the largest curvature of either side [1/m]
[[nodiscard]] double largest_curvature(const glissade::ClothoidSpline& curve);

/// Waves along 60 m that fall by 21 m, as high as leaves each of them alike (0.6 m over their number), at equal steps of x, both
/// coordinates rounded to millimetres.
struct RoundedWave {
  int periods = 1;
  int count = 0;
  double phase = 0.0;  // [rad]

  [[nodiscard]] std::vector<glissade::Vec2> points() const;
  /// @return of the wave, by looking [m]
  [[nodiscard]] double smallest_radius() const;
};

}  // namespace testing
