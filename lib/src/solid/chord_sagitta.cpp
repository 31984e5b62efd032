#include "solid/chord_sagitta.hpp"

#include "core/plane_geometry.hpp"
#include "solid/least_between.hpp"

#include <algorithm>
#include <cstdint>

namespace glissade::solid {
namespace {

// Close to both ends, where curvature may be unbounded, as well as in between.
constexpr std::array<double, 11> kShares{0.0, 0.02, 0.06, 0.14, 0.25, 0.4, 0.6, 0.75, 0.86, 0.94, 1.0};
// A parabola loses at most a tenth between two samples.
constexpr double kLostBetweenSamples = 1.15;

}  // namespace

ChordSagitta::ChordSagitta(const Centerline& centerline, double from, double to)
    : centerline_(centerline), samples_{} {
  static_assert(kShares.size() == kSamples);
  for (std::size_t i = 0; i < kSamples; ++i) {
    samples_[i] = station_at(centerline, from + kShares[i] * (to - from));
  }
}

bool ChordSagitta::folds(double height) const {
  return height != 0.0 && std::any_of(samples_.begin(), samples_.end(),
                                      [height](const Station& at) { return at.kappa * height >= 1.0; });
}

double ChordSagitta::of_level(double height, Vec2 a, Vec2 b, double enough) const {
  const auto distance = [&](const Station& at) {
    const Vec2 point = offset(at, height);
    return a == b ? norm(point - a) : core::distance_to_segment(point, a, b);
  };
  std::size_t best = 1;
  double worst = 0.0;
  for (std::size_t i = 1; i + 1 < kSamples; ++i) {
    const double here = distance(samples_[i]);
    if (here <= worst) continue;
    worst = here;
    best = i;
  }
  if (kLostBetweenSamples * worst < enough) return worst;
  constexpr int kBits = 9;  // accuracy: 0.5 % of the bracket, 1e-5 of a parabola's height
  constexpr std::uintmax_t kIterations = 20;
  const auto [s, least] =
      least_between(samples_[best - 1].s, samples_[best + 1].s, kBits, kIterations,
                    [&](double there) { return -distance(station_at(centerline_, there)); });
  return std::max(worst, -least);
}

}  // namespace glissade::solid
