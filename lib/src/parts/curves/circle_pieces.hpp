#pragma once

#include "glissade/centerline/centerline.hpp"
#include "glissade/core/vec.hpp"

#include <cstddef>
#include <vector>

namespace glissade::parts {

/// A track at many places, in the frame (x, height): denser where it bends more from place to place.
struct TrackSamples {
  std::vector<double> s;        ///< ascending arc lengths [m]; first 0, last the length
  std::vector<Vec2> point;      ///< [m]
  std::vector<double> heading;  ///< -zeta [rad]

  [[nodiscard]] std::size_t size() const { return s.size(); }
};

/// @param count  about how many places; each stretch between breaks gets at least 16
[[nodiscard]] TrackSamples sample(const Centerline& track, std::size_t count);

/// @return the first sample at an arc length or after it
[[nodiscard]] std::size_t index_at(const TrackSamples& samples, double s);

/// @return the same places moved to the left of the track
[[nodiscard]] TrackSamples moved_left(const TrackSamples& samples, double distance);

/// The distance of points from one circle, or straight line: C |p|^2 + B x + y + A = 0 in the frame of a chord.
/// @param first,last  indices of the piece, first < last
/// @return whether some circle passes all samples of the piece within the tolerance. False is certain: four samples
///   are known that no circle passes within it. True holds for at most some 100 samples, evenly spread.
[[nodiscard]] bool fits_circle(const TrackSamples& samples, std::size_t first, std::size_t last,
                               double tolerance);

/// The longest pieces that single circles pass within a tolerance, one after the other.
struct CirclePieces {
  std::vector<std::size_t>
      ends;  ///< index of the last sample of each piece; the next piece starts at the one after
  /// Of the last piece, how much of a whole one it is.
  double last_share = 1.0;

  /// The least number of arcs: each piece ends before four samples that rule out a longer one, and no arc of any
  /// chain can reach farther.
  [[nodiscard]] std::size_t count() const { return ends.size(); }
};
/// @return more samples between those that are there, so that each piece has at least `count` steps
[[nodiscard]] TrackSamples refined(const Centerline& track, const TrackSamples& samples,
                                   const CirclePieces& pieces, std::size_t count);

[[nodiscard]] CirclePieces circle_pieces(const TrackSamples& samples, std::size_t first, std::size_t last,
                                         double tolerance);

}  // namespace glissade::parts
