#pragma once

#include "glissade/core/vec.hpp"
#include "glissade/optimize/optimize.hpp"
#include "glissade/task/limit_catalogue.hpp"
#include "glissade/task/problem.hpp"

#include "optimize/discretise/transcription.hpp"
#include "optimize/problem/measure.hpp"

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace glissade::optimizer {

/// One limit, scaled.
struct LimitSpec {
  LimitName name;
  const Measure* measure = nullptr;
  int side = 0;              ///< +1: measure <= bound, -1: measure >= bound, 0: measure == bound
  double bound = 0.0;        ///< scaled; of a radius: the curvature
  double scale = 1.0;        ///< what a violation is measured against, as `bound`
  double bound_si = 0.0;     ///< as the user gave it
  double per_si = 1.0;       ///< |d bound/d bound_si|
  std::size_t obstacle = 0;  ///< of distance and waypoint
  bool built_in = false;     ///< not set by the user: arrival
  /// The one ride that it is held on, its bound being that ride's; none: wherever the measure binds.
  std::optional<std::size_t> ride;
  /// The one friction along the track that it is held where, as of Station; none: everywhere.
  std::optional<std::size_t> zone;
  /// The measure is multiplied by the width of a stream's channel, over that at the start, to this power.
  int width_power = 0;
};

/// The bound after relaxing a limit by t scales, in the user's unit.
/// @param measured  what an equality measures then, as `bound`; it alone counts
[[nodiscard]] double relaxed_bound(const LimitSpec& limit, double t, double measured);

/// A chain of straight edges that forbids what lies behind it.
struct Obstacle {
  std::vector<Vec2> corners;  ///< ascending run; two for a half-plane
  std::vector<Vec2>
      normals;  ///< of the edges between them, unit vectors into what is forbidden; none of a half-plane
  bool endless = false;       ///< a half-plane: the line goes on beyond its corners
  double side = 1.0;          ///< +1: forbidden below (larger drop), -1: forbidden above; of chains
  Vec2 forbidden;             ///< unit vector, of half-planes
  std::vector<Vec2> outline;  ///< of areas: all corners around it, of which the chain has one side
  /// Of areas: the sides that are not in the chain, in an order that leaves the area to their left where drop
  /// points down, and the corners that are not.
  std::vector<std::pair<Vec2, Vec2>> other_sides;
  std::vector<Vec2> other_corners;
  /// Of chains: corners that no track touches which keeps the limits; none: every corner may be.
  std::vector<bool> out_of_reach;

  [[nodiscard]] bool is_touchable(std::size_t corner) const {
    return corner >= out_of_reach.size() || !out_of_reach[corner];
  }
  /// @return a corner of the chain, or one of the others after them
  [[nodiscard]] Vec2 corner(std::size_t index) const {
    return index < corners.size() ? corners[index] : other_corners[index - corners.size()];
  }
};

/// The problem without dimension: lengths in chords, speeds in sqrt(gravity chord), gravity 1.
struct ScaledProblem {
  double chord = 1.0;  ///< [m]
  double time = 1.0;   ///< sqrt(chord/gravity) [s]
  double speed = 1.0;  ///< sqrt(gravity chord) [m/s]
  double gravity = 1.0;
  double run = 0.0;
  double drop = 0.0;
  double fall = 0.0;  ///< the drop of free fall to the lowest exit speed
  FinishKind finish = FinishKind::point;
  PlacesFrom places_from = PlacesFrom::start;  ///< of obstacles and waypoints
  std::vector<double> changes;  ///< arc lengths from which on the track rubs differently, ascending
  double lead_in = 0.0;
  double lead_out = 0.0;
  double lowest_speed_from = 0.0;
  double entry_speed2 = 0.0;
  double drag = 0.0;
  std::vector<Ride> rides;  ///< lowest friction first; the limits hold on each
  std::size_t objective_ride = 0;
  std::size_t nominal_ride = 0;
  double time_weight = 1.0;  ///< objective: time_weight T - speed_weight u(S), both scaled
  double speed_weight = 0.0;
  /// Of least wear: the squared speed that goes with cos(zeta) at the start less that at the finish. By them the centre of a
  /// body that is higher than the track comes down by another drop than the track's, and what is not rubbed off arrives.
  double tilt = 0.0;
  double drop_weight = 0.0;    ///< ... + drop_weight times the drop
  double length_weight = 0.0;  ///< ... + length_weight times the length
  std::vector<LimitSpec> limits;
  std::vector<Obstacle> obstacles;
  double envelope_low = 0.0;   ///< heights that clearances are measured from: of the underside, <= 0
  double envelope_high = 0.0;  ///< and of the top, >= 0
  double headroom = 0.0;       ///< up to here no end plane cuts it
  std::vector<Vec2> waypoints;
};

/// Which side of each keep-out polygon is passed.
using Passages = std::vector<Passage>;

/// @param passages  above or below, one for each keep-out
[[nodiscard]] ScaledProblem scaled(const Problem& problem, const Passages& passages);
/// The same with places and bounds to about 1e-8: what a search is on up to its last steps. The same problem far from its origin is
/// the same here, nearly always, and so is the valley that a search ends in. Where friction changes along the track, or limits
/// leave hardly any track but the straight line, it is scaled() itself.
[[nodiscard]] ScaledProblem roughly_scaled(const Problem& problem, const Passages& passages);

/// A body that creeps at less than this share of free fall's squared speed is as good as lying still.
inline constexpr double kCreep = 1e-6;  // taste

/// Knots are added where friction changes.
/// @param knots        of the core, by its length: 0 to 1
/// @param core_length  about the length of the core [chords]
[[nodiscard]] Mesh mesh_of(const ScaledProblem& problem, Vector knots, double core_length);

/// Whether a limit is one on the speed along the track, from above.
[[nodiscard]] bool is_cap_along(const LimitSpec& limit);

/// Whether a limit holds from ScaledProblem::lowest_speed_from on.
[[nodiscard]] bool holds_from_a_place(const LimitSpec& limit);

/// Whether the rate of curvature is limited: then nothing jumps.
[[nodiscard]] bool is_smooth(const ScaledProblem& problem);

/// @throws InputError as require_valid() of a Problem, or if the lowest normal load is lifted, which no search can
///         model
void require_searchable(const Problem& problem);
/// @throws InputError listing every field that breaks its bound
void require_valid(const OptimizeOptions& options);
/// @throws InputError for waypoints that no track within the vertical passes in their order
void require_passable_in_order(const Problem& problem);

}  // namespace glissade::optimizer
