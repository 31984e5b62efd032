#pragma once

#include "glissade/core/arc_path.hpp"
#include "glissade/parts/arc_spline.hpp"

#include <optional>
#include <vector>

namespace glissade::parts {

/// A stretch of a track between two planes square to it.
struct Span {
  double from = 0.0;  ///< arc length [m]
  double to = 0.0;
};

/// A point of the track with its directions, in the frame (x, height).
struct TrackFrame {
  Vec2 at;
  Vec2 along;  ///< unit tangent
  Vec2 up;     ///< unit normal, towards the side that a body slides on
};
[[nodiscard]] TrackFrame frame_at(const ArcSpline& track, double s);

/// The line at a height above a stretch of track, between the planes of its ends: concentric arcs, those that would fold
/// over cut away where the line meets an end plane or itself.
/// @param height  [m]; negative below
/// @return none where the height folds the line away altogether
[[nodiscard]] std::optional<ArcPath> offset_line(const ArcSpline& track, const Span& span, double height);

/// @return whether offset_line() cuts anything away there
[[nodiscard]] bool folds(const ArcSpline& track, const Span& span, double height);

/// What lies between two heights over a stretch of track.
/// @param low,high  low < high [m]
/// @return counter-clockwise, from the upstream end of the lower line; none where a line folds away
[[nodiscard]] std::optional<ArcPath> band(const ArcSpline& track, const Span& span, double low, double high);

/// The places along a track at which something round goes through a plate: on one arc at all heights of the plate.
class OnOneArc {
 public:
  /// @param radius   of what goes through [m]
  /// @param heights  of the plate above the track
  /// @param breaks   places that count as ends of arcs, too
  /// @param bends    what bends take of either side of every joint, the track's ends included; none: nothing
  OnOneArc(const ArcSpline& track, double radius, const Span& heights, const std::vector<double>& breaks = {},
           const std::vector<double>& bends = {});
  /// @param slack  by which slots are longer than tabs at either end [m]
  /// @return breaks for a tab and its slot: one plate has an edge where the tab ends, the other one where the slot does
  [[nodiscard]] static std::vector<double> ends_of_tab(const Span& tab, double slack);
  [[nodiscard]] bool has(double place) const { return nearest(place, {place, place}).has_value(); }
  /// @return the nearest such place within a span; none if there is none
  [[nodiscard]] std::optional<double> nearest(double about, const Span& within) const;

 private:
  static constexpr double kAside = 0.5e-3;  // taste: from where arcs meet [m]
  std::vector<Span> rooms_;
};

}  // namespace glissade::parts
