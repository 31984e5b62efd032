#pragma once

#include "glissade/centerline/centerline.hpp"
#include "glissade/core/progress.hpp"
#include "glissade/core/units.hpp"
#include "glissade/referee/referee.hpp"
#include "glissade/task/problem.hpp"

#include <cstddef>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

namespace glissade {

/// How closely and for how long optimize() looks; the defaults suit tracks of a few metres to kilometres.
struct OptimizeOptions {
  int pieces = 32;          ///< clothoids between the places where limits change over; 8 <= pieces <= 200
  double tolerance = 1e-5;  ///< of the first-order residual, a tenth is aimed at; 1e-12 <= tolerance <= 1e-3
  double limit_tolerance = 1e-7;  ///< greatest violation of a limit, of its scale; 1e-10 <= value <= 1e-4
  double time_budget =
      60.0;  ///< of the calling thread's processor time [s]; finite, > 0; ends with the best track so far
};

enum class OptimizeStatus {
  optimal,                 ///< every limit holds, first-order conditions met
  feasible_not_converged,  ///< every limit holds, but the search ended early (message says why)
  infeasible,              ///< the limits contradict each other; see conflict
  no_track_found           ///< no track held every limit: the search ended early, or confirmed no conflict;
                           ///< conflict then tells what the closest track breaks
};

/// @return "optimal", "feasible, not converged", "infeasible", "no track found"
[[nodiscard]] std::string_view to_text(OptimizeStatus status);

/// A piece of the track, by arc length.
struct Stretch {
  double from = 0.0;  ///< [m]
  double to = 0.0;    ///< [m]; >= from
};

/// A limit that holds the optimum back, where, and what it costs.
struct ActiveLimit {
  LimitName limit;
  double value = 0.0;          ///< the bound [SI]
  std::vector<Stretch> where;  ///< where the track lies at the bound, in order
  /// Seconds of the objective won for each unit by which the bound is relaxed (of an objective exit_speed:
  /// m/s, of least_drop and least_length: metres); >= 0. The first-order multiplier; of a radius it belongs to a
  /// smaller radius. Of a value to be met exactly: by which it moves the way that wins.
  double price = 0.0;
  /// What each unit costs by which the bound is tightened instead, > price, where that is not the price: another limit
  /// begins to bind at the same bound. Infinite where no track keeps a tighter one. None: the price, to either side.
  std::optional<double> tightening_price = std::nullopt;
  /// Share of itself by which the price still changes from one mesh to the next, where that is more than 2 %: no mesh that
  /// was looked at tells it more closely. 0: it stays.
  double price_error = 0.0;

  /// @return what a unit costs by which the bound is tightened
  [[nodiscard]] double tightening() const { return tightening_price.value_or(price); }
};

/// @return "0.0123 s per deg"; of a price to either side "0.0123 s per deg looser, 0.0456 tighter", or "0.0123 s per deg
///         looser, no track tighter"; of one that meshes do not tell closely "0.0123 s per deg (to 6 %)", of one
///         that changes by as much as itself or more "below some 0.0123 s per deg"
[[nodiscard]] std::string price_text(const ActiveLimit& active, const Objective& objective);

/// The smallest change of one limit, all others kept, that was found to make the problem solvable.
struct Relaxation {
  LimitName limit;
  double value = 0.0;  ///< the bound now, SI
  /// The bound that would do, SI: the search has solved the problem with it. It is a number of four digits in the
  /// unit that messages give it in, rounded away from the least that a local search found.
  double needed = 0.0;
};

/// A limit as the problem states it.
struct StatedLimit {
  LimitName limit;
  std::optional<double> value;  ///< SI; none for what holds without being asked for
};

/// Why there is no track.
struct Conflict {
  std::vector<StatedLimit> limits;      ///< those that cannot be met together
  std::vector<Relaxation> relaxations;  ///< each of them alone would do; empty if no single change helps
  std::string text;                     ///< all of it as one sentence, angles in degrees
  std::string why;                      ///< what confirms it; empty: the search for the least violation
};

/// @return the limits that contradict each other and what would do, as one sentence
[[nodiscard]] std::string conflict_text(const Conflict& conflict);

/// How a search ended: what was reached, which limits hold the track back, and what each of them costs.
struct OptimizeReport {
  OptimizeStatus status = OptimizeStatus::no_track_found;
  std::string message;  ///< one sentence on how the search ended

  Objective objective;  ///< what was searched for; it says what a price is in

  double travel_time = 0.0;  ///< by the referee, at nominal friction [s]
  double exit_speed = 0.0;   ///< by the referee, at nominal friction [m/s]
  std::optional<double>
      unlimited_travel_time;  ///< exact optimum without limits, where the theory applies [s]
  /// Norm of the Lagrangian's gradient over that of the objective's, both in the metric of the Lagrangian's
  /// Hessian; dimensionless. Half its square is about the relative time that could still be won nearby. Infinite
  /// where that did not come out.
  double first_order_residual = 0.0;
  /// What finer meshes would win, as a share of the objective, rather too much than too little: the residual is that
  /// of one mesh, and knows nothing of it. None where that was not looked at: without limits, or stopped early.
  std::optional<double> finer_mesh_wins;
  std::vector<LimitCheck> checks;  ///< one for each limit, sampled by the referee ten times finer
  /// By name; of what the problem asks for, not of what a search sets itself.
  std::vector<ActiveLimit> active;
  /// Of a problem without a track. Where it is not called infeasible: what the closest track breaks, and what
  /// would do; without text.
  Conflict conflict;

  bool ended_early = false;  ///< asked to, or the time budget ran out
  bool interrupted = false;  ///< asked to; then ended_early holds, too
  int iterations = 0;        ///< rounds of Newton steps, at least one a mesh
  int evaluations = 0;       ///< of objective and limits with gradients
  double seconds = 0.0;      ///< wall clock; the only field that differs between two runs

  /// @return a few lines for people
  [[nodiscard]] std::string brief() const;
  /// @return "first-order residual 1.4e-11, a finer mesh would win 2.1e-07"
  [[nodiscard]] std::string convergence_text() const;
};

/// What optimize() found.
struct Optimum {
  CenterlinePtr centerline;  ///< the track; empty where status is infeasible or no_track_found
  OptimizeReport report;
};

/// The fastest track that keeps every limit.
///
/// Method: docs/optimization.md. The track is a clothoid spline; curvature at its knots, entry slope angle
///   and length are the unknowns; gradients are exact; sequential quadratic programs minimise on a coarse mesh and
///   carry its optimum to finer ones, and NLopt's SLSQP goes on where they do not arrive. All of it in units of chord
///   and sqrt(chord/gravity), so that tracks of any size take the same path. Needs no guess, is deterministic
///   but for the time budget, which counts processor time: other work on the machine changes no answer.
/// Accuracy: without limits kOptimizeAccuracy relative in travel time at the default pieces, never below the
///   exact optimum by more than kOptimizeUndershoot. Within limits docs/optimization.md.
/// Identity: every number in the report comes from Motion on the centerline returned.
/// @param stop  asks the search to end with the best track so far
/// @throws InputError if a field of problem or options breaks its stated bound
[[nodiscard]] Optimum optimize(const Problem& problem, const OptimizeOptions& options = {},
                               const std::stop_token& stop = {}, const Progress& progress = {});

/// Greatest relative excess of travel time over the exact optimum without limits, mu 0 to 1, H/L from 1.02 mu
/// to 5, default options.
inline constexpr double kOptimizeAccuracy = 1e-6;
/// Greatest relative deficit.
inline constexpr double kOptimizeUndershoot = 1e-9;

}  // namespace glissade
