#pragma once

#include "glissade/centerline/centerline.hpp"
#include "glissade/centerline/clothoid_spline.hpp"
#include "glissade/centerline/cubic_bend.hpp"
#include "glissade/core/units.hpp"
#include "glissade/core/vec.hpp"

#include <optional>
#include <variant>
#include <vector>

namespace glissade {

/// A CubicBend as a piece of a track; it leads from a straight into a curve, or out of one.
struct CubicSegment {
  /// By how much it turns upwards, by which the slope angle falls; negative of a crest. Not 0, at most
  /// CubicBend::kMostTurn either way.
  Angle turn;
  double radius = 0.0;  ///< at its bent end [m]; finite, > 0
  bool begins_bent =
      false;  ///< its curvature is 1/radius where it begins and 0 where it ends, not the other way

  friend bool operator==(const CubicSegment&, const CubicSegment&) = default;
};

using TrackSegment = std::variant<ClothoidSegment, CubicSegment>;

/// A track put together from straights, arcs, clothoids and cubic bends.
///
/// Curve: position and slope angle are continuous; curvature may jump from one segment to the next (at() gives the
///   value after the jump).
/// Accuracy: kDrawnTrackAccuracy * length() in position and arc length.
/// Identity: of clothoid segments alone it is the ClothoidSpline of them.
class DrawnTrack final : public Centerline {
 public:
  /// @param entry_slope_angle  zeta at the start; finite
  /// @param segments           in order from the start; at least one
  /// @throws InputError as ClothoidSpline and CubicBend do, of all segments together
  DrawnTrack(Angle entry_slope_angle, const std::vector<TrackSegment>& segments);

  [[nodiscard]] std::string_view kind() const noexcept override { return "segments"; }
  [[nodiscard]] double length() const noexcept override { return end_.arc_length; }
  [[nodiscard]] CenterlinePoint at(double s) const override;
  [[nodiscard]] double slope_angle(double s) const override;
  [[nodiscard]] Direction direction(double s) const override;
  /// @return the joints between segments, with start and finish
  [[nodiscard]] std::vector<double> breaks() const override { return joints_; }

 private:
  /// A cubic bend in the direction in which the track leads through it.
  struct Bend {
    CubicBend curve;
    double side;  ///< 1 where it turns upwards, -1 on a crest
    bool backwards;

    [[nodiscard]] CubicBend::Place at(double s) const;
  };
  struct Part {
    CenterlinePoint start;
    std::variant<ClothoidSpline, Bend> curve;

    [[nodiscard]] double length() const;
    [[nodiscard]] CenterlinePoint at(double s) const;
    [[nodiscard]] Direction direction(double s) const;
  };
  void append(Part part);
  [[nodiscard]] const Part& part_at(double s) const;

  std::vector<Part> parts_;
  std::vector<double> joints_;
  CenterlinePoint end_;
};

/// Stated bound of the position and arc-length error of DrawnTrack, relative to its length.
inline constexpr double kDrawnTrackAccuracy = 1e-14;

/// @return a ClothoidSpline where it is made of clothoid segments alone, otherwise a DrawnTrack
/// @throws InputError as they do
[[nodiscard]] CenterlinePtr joined(Angle entry_slope_angle, const std::vector<TrackSegment>& segments);

/// The one arc that leaves tangentially and passes a place; a straight where the place lies straight ahead.
/// @param way    (run, drop) from where it begins to where it ends [m]; not (0, 0)
/// @param entry  slope angle where it begins
/// @throws InputError if the way or the entry is not finite, or the way is (0, 0)
/// @return it; none where the place lies straight behind. It turns by twice the angle between tangent and way
[[nodiscard]] std::optional<ClothoidSegment> arc_to(Vec2 way, Angle entry);

/// The clothoid, curvature linear in between, that leads to a place and has a given slope angle there.
/// Source: E. Bertolazzi, M. Frego, G1 fitting with clothoids, Math. Meth. Appl. Sci. 38 (2015), equation (9); derived
///   again in the source.
/// Accuracy: it ends within kClothoidAccuracy * length of the place.
/// @param way    as of arc_to()
/// @param entry  slope angle where it begins
/// @param exit   slope angle where it ends; both differ from the direction of the way by less than 135 deg
/// @throws InputError as arc_to()
/// @return the one that winds least; none if a slope angle differs by more, or no clothoid was found
[[nodiscard]] std::optional<ClothoidSegment> clothoid_to(Vec2 way, Angle entry, Angle exit);

}  // namespace glissade
