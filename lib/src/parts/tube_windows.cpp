#include "parts/tube_windows.hpp"

#include "glissade/core/math.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace glissade::parts {
namespace {

Vec3 at_angle(double radius, double angle, double z) {
  const auto [sine, cosine] = math::sine_cosine(angle);
  return {radius * cosine, radius * sine, z};
}

}  // namespace

std::vector<Bore> bores_of(const TubeGore& gore) {
  std::vector<Bore> bores;
  for (const TubeHole& hole : gore.holes) {
    const auto [sine, cosine] = math::sine_cosine(hole.about.radians());
    Bore bore;
    bore.centre = at_angle(gore.inner_radius, hole.about.radians(), hole.along);
    bore.along = {-sine, cosine, 0.0};
    bore.across = {0.0, 0.0, 1.0};
    bore.into = {cosine, sine, 0.0};
    bore.radius = hole.radius;
    bore.depth = gore.thickness;
    bore.from_axis = gore.inner_radius;
    bore.grows_into = 1.0;
    bore.path_radius = gore.inner_radius;
    bores.push_back(bore);
  }
  return bores;
}

BodyMoments moments_of(const TubeWindow& window, const TubeGore& gore) {
  const double inner = gore.inner_radius;
  const double outer = inner + gore.thickness;
  const double turn = window.high.radians() - window.low.radians();
  const double area = 0.5 * turn * (outer * outer - inner * inner);
  // Of the sector of a ring, from the axis.
  const double out =
      2.0 / 3.0 * (outer * outer * outer - inner * inner * inner) * math::sin(0.5 * turn) / area;
  const double middle = 0.5 * (window.low.radians() + window.high.radians());
  return {area * (window.to - window.from), at_angle(out, middle, 0.5 * (window.from + window.to))};
}

double beside(const TubeWindow& window, Vec3 place) {
  const double radius = math::hypot(place.x, place.y);
  const double middle = 0.5 * (window.low.radians() + window.high.radians());
  const auto [sine, cosine] = math::sine_cosine(middle);
  const double turned = math::atan2(cosine * place.y - sine * place.x, cosine * place.x + sine * place.y);
  const double round = radius * (std::fabs(turned) - 0.5 * (window.high.radians() - window.low.radians()));
  const double along = std::max(window.from - place.z, place.z - window.to);
  if (round <= 0.0 || along <= 0.0) return std::max(round, along);
  return math::hypot(round, along);
}

std::vector<Vec3> points_beside(const TubeGore& gore, double inset) {
  std::vector<Vec3> points;
  constexpr int kPoints = 6;
  for (const TubeWindow& window : gore.windows) {
    for (const double radius : {gore.inner_radius + inset, gore.inner_radius + gore.thickness - inset}) {
      const double off = inset / radius;
      const double low = window.low.radians() - off;
      const double high = window.high.radians() + off;
      for (int k = 0; k <= kPoints; ++k) {
        const double share = static_cast<double>(k) / kPoints;
        const double z = window.from + share * (window.to - window.from);
        const double angle = low + share * (high - low);
        points.push_back(at_angle(radius, low, z));
        points.push_back(at_angle(radius, high, z));
        points.push_back(at_angle(radius, angle, window.from - inset));
        points.push_back(at_angle(radius, angle, window.to + inset));
      }
    }
  }
  return points;
}

}  // namespace glissade::parts
