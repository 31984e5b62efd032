#pragma once

#include "glissade/centerline/centerline.hpp"

#include "parts/curves/arc_fit.hpp"
#include "parts/curves/circle_pieces.hpp"

#include <cstddef>
#include <optional>

namespace glissade::parts {

/// Where a chain may lie beside the track, its ends on the track.
struct Band {
  double left = 0.0;   ///< by how much to the left of it at most [m]; > 0
  double right = 0.0;  ///< to the right [m]; > 0

  [[nodiscard]] double half_width() const { return 0.5 * (left + right); }
  /// How far its middle lies to the left of the track.
  [[nodiscard]] double middle() const { return 0.5 * (left - right); }
  /// The band about the same middle.
  [[nodiscard]] Band scaled(double factor) const {
    return {middle() + factor * half_width(), factor * half_width() - middle()};
  }
};

// How finely both searches look, this one and search_joints(). Measured over the shipped designs at six tolerances and 300
// random tracks: halving the widths of offsets and headings, or twice the curvatures, costs two to eight times the time
// and saves 1 arc in 100; joints that lie closer save more.
inline constexpr std::size_t kGatesPerStep = 2;
inline constexpr std::size_t kCurvatures = 8;  // of an interval that are followed
inline constexpr std::size_t kOffsets = 6;     // across the band, that count as one each
inline constexpr double kHeadings = 2.0;       // wide [half widths of the band a piece]
inline constexpr std::size_t kMostHeadings = 64;
inline constexpr double kSteepest = 16.0;  // heading at a free start, off the track's [the same]
inline constexpr std::size_t kFreeHeadings = 33;
inline constexpr std::size_t kReaches = 6;    // places along what a kept piece may reach
inline constexpr std::size_t kStepsBack = 2;  // behind the front at which states are still followed
inline constexpr std::size_t kBiarcs = 12;
inline constexpr double kBetween = 0.05;  // half widths of the band that an arc may gain between two gates
inline constexpr double kInside = 1e-9;   // of an interval of curvatures, off its ends

/// A chain within a band, and where its joints lie as seen from the track.
struct FoundChain {
  ArcChain chain;
  ChainStart joints;
  std::size_t arcs = 0;
};

/// A chain of few arcs within a band, by dynamic programming over the places and headings that some number of arcs can
/// reach.
/// @param stretch  what its kept ends may reach is within the band
/// @param steps  places for a joint along the longest piece that one circle passes: the chain has up to half an arc in
///   as many more than needed
/// @return none where no chain was met
[[nodiscard]] std::optional<FoundChain> search_chain(const Centerline& track, const TrackSamples& samples,
                                                     const Stretch& stretch, const Band& band,
                                                     std::size_t steps);

}  // namespace glissade::parts
