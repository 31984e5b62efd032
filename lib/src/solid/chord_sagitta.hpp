#pragma once

#include "glissade/centerline/centerline.hpp"
#include "glissade/core/vec.hpp"

#include "solid/stations.hpp"

#include <array>
#include <cstddef>

namespace glissade::solid {

/// The greatest distance between a chord of a level curve and the curve, over a stretch of the track.
///
/// Not halfway: beside a start of unbounded curvature the worst place lies at a quarter of the step and less.
/// It is looked for at samples that all levels share, and then between the best one's neighbours.
/// Accuracy: 1e-4 relative on a stretch without an inflection, however short it is against the arc lengths of its ends;
///   where one lies within it, the larger side is found.
class ChordSagitta {
 public:
  /// @param from,to  arc lengths on the centerline, which must outlive this; from < to
  ChordSagitta(const Centerline& centerline, double from, double to);

  /// @return whether the level folds over itself in the stretch: it has no chord there
  [[nodiscard]] bool folds(double height) const;

  /// @param a,b     the ends of the chord, (x, z)
  /// @param enough  a distance that is surely less than this is not worth a closer look [m]
  /// @return the greatest distance [m]; that of the best sample where it is surely less than `enough`
  [[nodiscard]] double of_level(double height, Vec2 a, Vec2 b, double enough) const;

 private:
  static constexpr std::size_t kSamples = 11;
  const Centerline& centerline_;
  std::array<Station, kSamples> samples_;
};

}  // namespace glissade::solid
