#pragma once

#include "glissade/clearance/envelope.hpp"
#include "glissade/core/units.hpp"
#include "glissade/core/vec.hpp"

#include <optional>
#include <vector>

namespace glissade {

/// A closed interval of which either side may be left out.
struct Range {
  std::optional<double> lowest;   ///< value >= lowest
  std::optional<double> highest;  ///< value <= highest

  /// @return the range that holds `value` alone
  [[nodiscard]] static constexpr Range fixed(double value) { return {value, value}; }
  [[nodiscard]] constexpr bool limited() const { return lowest.has_value() || highest.has_value(); }
  [[nodiscard]] constexpr bool is_fixed() const { return limited() && lowest == highest; }
  /// @return whether `value` lies within, its ends included
  [[nodiscard]] constexpr bool holds(double value) const {
    return lowest.value_or(value) <= value && value <= highest.value_or(value);
  }

  friend bool operator==(const Range&, const Range&) = default;
};

/// One side of a straight line that the track must stay on.
struct HalfPlane {
  Vec2 point;      ///< on the line [m]
  Vec2 forbidden;  ///< direction square to the line, towards the forbidden side; any length > 0
  double clearance =
      0.0;  ///< distance from the envelope to the line >= clearance, on the free side [m]; >= 0
  /// A second point of the line, as a design gave it: a file written anew has it again. The limit does not ask for it.
  std::optional<Vec2> second = std::nullopt;

  friend bool operator==(const HalfPlane&, const HalfPlane&) = default;
};

/// A beam, a duct, a machine: the track passes wholly above or wholly below it.
enum class Passage { either, above, below };

/// A polygon that the track, or the solid round it, keeps out of.
struct KeepOut {
  /// Simple polygon [m], either winding: 3 to 2000 corners within 1e7 m, neighbours at least 1e-6 m apart.
  std::vector<Vec2> outline;
  double clearance = 0.0;             ///< distance from the envelope to the polygon >= clearance [m]; >= 0
  Passage passage = Passage::either;  ///< either: both are tried, the faster one is taken

  friend bool operator==(const KeepOut&, const KeepOut&) = default;
};

/// A line of ground or of a roof, first coordinates ascending [m], at least two points. It limits the track
/// beside itself only, not beyond its ends.
struct Profile {
  std::vector<Vec2> line;
  double clearance =
      0.0;  ///< distance from the envelope to the line >= clearance, on the free side [m]; >= 0

  friend bool operator==(const Profile&, const Profile&) = default;
};

/// What the clearances of a design are measured from.
enum class ClearancesFrom {
  solid,      ///< the whole solid that the cross_section makes, and the headroom
  centerline  ///< the middle line of the floor
};

/// A belt whose speed a stream is to have along it when it lands.
struct BeltMatch {
  double speed = 0.0;   ///< of the belt [m/s]; > 0
  Angle direction;      ///< seen from above, from the track's own; within +-90 deg
  double within = 0.1;  ///< share of the speed by which the stream may miss it; > 0, at most 1

  friend bool operator==(const BeltMatch&, const BeltMatch&) = default;
};

/// What a job asks of a track. Every limit is optional; each holds at every point of the track, and at every
/// friction of the range. Their names, dimensions and bounds: limit_catalogue().
///
/// Units: SI, radians; slope angle positive downhill. Frame of half-planes, keep-outs, lines and waypoints:
/// (run, drop), drop positive DOWN, in a Problem; (x, z), z up, as the file gives them, in a Design.
struct Limits {
  Range entry_slope_angle;  ///< of zeta(0) [rad]
  Range exit_slope_angle;   ///< of zeta(S) [rad]
  Range slope_angle;        ///< of zeta(s) for every s [rad]

  std::optional<double> smallest_valley_radius;  ///< kappa <= 1/radius where kappa > 0 [m]
  std::optional<double> smallest_crest_radius;   ///< -kappa <= 1/radius where kappa < 0 [m]
  std::optional<double> highest_curvature_rate;  ///< |d kappa/ds| <= rate [1/m^2]
  bool concave = false;                          ///< kappa >= 0: no crest at all

  std::optional<double> highest_normal_load;  ///< N = g cos(zeta) + kappa u^2 <= value [m/s^2]
  /// N >= value [m/s^2]; 0 keeps the body in contact. None: it is held from both sides (Body::held of what rides), for which no
  /// track is searched.
  std::optional<double> lowest_normal_load = 0.0;
  std::optional<double> highest_curvature_load;  ///< kappa u^2 <= value [m/s^2]; valleys alone can break it

  /// H <= depth along the track [m]; of a stream alone
  std::optional<double> highest_burden_depth;
  /// W_c = Q K_c mu N/B <= value along the track [W/m^2]; of a stream alone
  std::optional<double> highest_floor_wear;
  /// zeta(s) - atan(mu) >= value for every s, at the highest friction [rad]
  std::optional<double> lowest_slope_margin;

  Range speed;  ///< of u(s) [m/s]; `lowest` from `lowest_speed_from` on, `highest` everywhere
  double lowest_speed_from = 0.0;  ///< arc length from which speed.lowest holds [m]; >= 0
  Range exit_speed;                ///< of u(S) [m/s]
  /// u(S) cos(zeta(S)) cos(direction) within `within` of the belt's speed: what flight leaves unchanged
  std::optional<BeltMatch> match_belt;
  Range arc_length;  ///< of S [m]

  double lead_in = 0.0;   ///< the track starts with a straight exactly this long [m]; >= 0
  double lead_out = 0.0;  ///< the track ends with a straight exactly this long [m]; >= 0

  /// What half_planes, keep_outs, stay_above and stay_below are measured from: the solid round the centerline
  /// and what slides on it; by default the centerline itself. In a Design the headroom alone, its
  /// cross_section tells the rest.
  Envelope envelope;
  ClearancesFrom clearances_from = ClearancesFrom::solid;  ///< of a Design; a Problem's envelope says it all
  std::vector<HalfPlane> half_planes;
  std::vector<KeepOut> keep_outs;
  std::vector<Profile> stay_above;  ///< terrain, floors
  std::vector<Profile> stay_below;  ///< roofs, ceilings

  std::vector<Vec2> waypoints;  ///< points that the track passes through, in this order [m]

  /// @return whether anything is to be kept clear of
  [[nodiscard]] bool has_clearances() const {
    return !half_planes.empty() || !keep_outs.empty() || !stay_above.empty() || !stay_below.empty();
  }

  friend bool operator==(const Limits&, const Limits&) = default;
};

/// Everything that a track can be held against, in the order of the catalogue.
enum class LimitId {
  entry_slope_angle,
  exit_slope_angle,
  slope_angle,
  smallest_valley_radius,
  concave,
  smallest_crest_radius,
  highest_curvature_rate,
  highest_normal_load,
  lowest_normal_load,
  highest_curvature_load,
  highest_burden_depth,
  highest_floor_wear,
  lowest_slope_margin,
  speed,
  exit_speed,
  match_belt,
  arc_length,
  lead_in,
  lead_out,
  half_planes,
  keep_outs,
  stay_above,
  stay_below,
  waypoints,
  // What a task asks for by its two ends.
  finish,
  finish_run,   ///< of a free finish, in the frame of a Problem
  finish_drop,  ///< of a free finish, in the frame of a Problem
  finish_x,     ///< of a free finish, in the frame of a Design
  finish_z,     ///< of a free finish, in the frame of a Design
  friction,     ///< as a reason why there is no track
  arrival_at_low_friction,
  arrival_at_high_friction,
  // What holds without being asked for: kept by the search.
  arrival,
  no_steeper_than_vertical,
  no_climb_beyond_vertical,
  not_shorter_than_chord,
  not_many_chords_long,
  room_for_body,  ///< whose centre of mass runs above the track
  no_choking,     ///< of a stream
  landing,        ///< of a stream that falls on the start
};

}  // namespace glissade
