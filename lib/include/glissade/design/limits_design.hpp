#pragma once

#include "glissade/core/vec.hpp"

#include <optional>
#include <vector>

namespace glissade {

/// The `limits:` section of a design file as plain values, under the same names; docs/design-file.md
/// describes them.
///
/// Units: SI, radians. Frame of points: (x, z) as the file gives them, z up; x is the design's x for a track
/// along the x axis, otherwise the horizontal distance from the start towards the finish. in_track_plane() of
/// design.hpp turns them into run and drop.

/// A closed interval of which either side may be left out.
struct LimitRange {
  std::optional<double> lowest;
  std::optional<double> highest;

  [[nodiscard]] constexpr bool limited() const { return lowest.has_value() || highest.has_value(); }
  friend bool operator==(const LimitRange&, const LimitRange&) = default;
};

/// One side of a straight line that the track must stay on.
struct HalfPlaneDesign {
  Vec2 point;      ///< on the line
  Vec2 forbidden;  ///< unit vector square to the line, towards the forbidden side
  double clearance = 0.0;
};

enum class PassageDesign { either, above, below };

struct KeepOutDesign {
  std::vector<Vec2> outline;  ///< simple polygon, either winding
  double clearance = 0.0;
  PassageDesign passage = PassageDesign::either;
};

/// Ground to stay above, or a ceiling to stay below.
struct ProfileDesign {
  std::vector<Vec2> line;  ///< ascending x, at least two points
  double clearance = 0.0;
};

enum class ObjectiveDesignKind { travel_time, exit_speed, blend };

struct ObjectiveDesign {
  ObjectiveDesignKind kind = ObjectiveDesignKind::travel_time;
  double exit_speed_weight = 0.0;  ///< of `blend`: least T - weight * exit speed [s/(m/s)]; >= 0
  bool worst_case = false;         ///< at the highest friction of the body's range
};

struct LimitsDesign {
  LimitRange entry_slope_angle;  ///< [rad]
  LimitRange exit_slope_angle;   ///< [rad]
  LimitRange slope_angle;        ///< anywhere [rad]

  std::optional<double> smallest_valley_radius;  ///< [m]; > 0
  std::optional<double> smallest_crest_radius;   ///< [m]; > 0
  std::optional<double> highest_curvature_rate;  ///< |d kappa/ds| [1/m^2]; > 0
  bool concave = false;                          ///< no crest at all

  std::optional<double> highest_normal_load;       ///< [m/s^2]
  std::optional<double> lowest_normal_load = 0.0;  ///< [m/s^2]; none: the body is held from both sides
  std::optional<double> highest_curvature_load;    ///< kappa u^2 [m/s^2]; > 0

  LimitRange speed;                ///< anywhere [m/s]
  double lowest_speed_from = 0.0;  ///< arc length from which speed.lowest holds [m]; >= 0
  LimitRange exit_speed;           ///< [m/s]
  LimitRange arc_length;           ///< [m]

  double lead_in = 0.0;   ///< straight at the start [m]; >= 0
  double lead_out = 0.0;  ///< straight at the end [m]; >= 0

  std::vector<HalfPlaneDesign> half_planes;
  std::vector<KeepOutDesign> keep_outs;
  std::vector<ProfileDesign> stay_above;
  std::vector<ProfileDesign> stay_below;
  std::vector<Vec2> waypoints;  ///< in this order

  ObjectiveDesign objective;
};

}  // namespace glissade
