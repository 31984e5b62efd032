#pragma once

#include "glissade/centerline/centerline.hpp"
#include "glissade/core/error.hpp"
#include "glissade/core/friction_level.hpp"
#include "glissade/core/progress.hpp"
#include "glissade/core/units.hpp"
#include "glissade/design/ends_design.hpp"
#include "glissade/motion/motion.hpp"
#include "glissade/optimize/optimize.hpp"
#include "glissade/route/placement.hpp"
#include "glissade/trades/ski_jump/gates.hpp"

#include <atomic>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

namespace glissade {

/// What solve() makes of a design, and how it is made.

/// How long work tells how far it is, and is asked to end.
struct RunContext {
  Progress progress;
  std::stop_token stop;  ///< a search within limits ends with the best track so far
  double time_budget = OptimizeOptions{}.time_budget;  ///< of a search within limits [s]; > 0
  /// Where it is not null: true while a request to stop ends a search with the best track so far, and from then on, as the
  /// work goes on with that. Anything else that is asked to stop ends.
  std::atomic<bool>* goes_on_after_stop = nullptr;
  /// False leaves out what a track is measured by, Track::optimum, where it would be made for that alone: with an entry
  /// speed it costs several times the ride.
  bool measures_optimum = true;
};

/// The ride at one end of a friction range.
struct RangeRide {
  FrictionLevel level = FrictionLevel::low;
  Motion motion;  ///< its body has that friction
};

/// One of a track's rides by its friction.
struct LevelRide {
  FrictionLevel level = FrictionLevel::nominal;
  const Motion* motion = nullptr;
};

/// What an objective other than the travel time is paid for with.
struct FastestWithin {
  double travel_time = 0.0;    ///< [s]
  double friction_loss = 0.0;  ///< work of rubbing on floor and walls per mass [J/kg]
  /// Of a stream: the greatest wear of its floor over all frictions [W/m^2].
  std::optional<double> floor_wear = {};
};

/// Why a hood that was chosen with its track is not known to be the best one.
struct EarlyHood {
  std::string message;       ///< "the time budget ran out: the best hood and track so far"
  bool ended_early = false;  ///< asked to, or the time budget ran out
  bool interrupted = false;  ///< asked to; then ended_early holds, too
};

/// A centerline with the ride down it and the two rides that it is measured by.
struct Track {
  Endpoints endpoints;
  Placement placement;
  CenterlinePtr centerline;
  Motion motion;  ///< at the nominal friction
  /// The same body on the straight line between the endpoints; none if it does not arrive there.
  std::optional<Motion> straight;
  /// The ride on the fastest track there is, which the theory gives without drag (docs/theory.md, fastest track); none
  /// where it does not apply, or was not asked for.
  std::optional<Motion> optimum;
  /// Travel time of `optimum` by its closed form, which shares nothing with Motion [s].
  std::optional<double> optimum_travel_time;
  /// Smallest radius of curvature [m]: 0 where the curvature is unbounded at the start, infinity on a
  /// straight.
  double min_radius = 0.0;
  Angle steepest_slope_angle;  ///< largest slope angle anywhere
  /// How the search within the limits ended, of the kind fastest with limits; none otherwise. Limits have the
  /// names and the frame of the design file: finish.x, finish.z.
  std::optional<OptimizeReport> search;
  /// Of a search for less wear, less peak wear or more even speed: the fastest track within the same limits; none where the
  /// search is for that, or where it failed or ended early.
  std::optional<FastestWithin> fastest_within;
  /// Every limit of the design, whatever the kind, as the referee finds it on this track; empty without
  /// limits. Places of an envelope are (x, z) as the design's limits give them.
  std::vector<LimitCheck> limit_checks;
  /// The same body at the ends of the design's friction range; empty where it has none.
  std::vector<RangeRide> range;
  /// The rides from every gate of the design; none where it has none.
  std::optional<GateTable> gates = {};
  /// The hood before it, as given or as the search chose it together with the track; none of a design without one.
  std::optional<HoodDesign> hood = {};
  /// Where the search for the hood did not come to its end; `search`, if there is one, tells it, too.
  std::optional<EarlyHood> early_hood = {};

  /// @return the rides at every friction that the design names, from low to high; the nominal one is always
  ///         among them. They live as long as the track.
  [[nodiscard]] std::vector<LevelRide> rides() const;
  /// @return travel time on the straight line [s]; none if the body does not arrive there
  [[nodiscard]] std::optional<double> straight_travel_time() const;
};

/// No track keeps the limits of a design. Its issue names those that contradict each other and the smallest relaxations
/// that would do.
class LimitsConflict : public InfeasibleError {
 public:
  LimitsConflict(Issue issue, OptimizeReport report)
      : InfeasibleError(std::move(issue)), report_(std::move(report)) {}
  [[nodiscard]] const OptimizeReport& report() const noexcept { return report_; }

 private:
  OptimizeReport report_;
};

/// No track was found that keeps the limits, and no conflict between them is certain. Its issue names those that the
/// closest track breaks, and what would do where that was found.
class NoTrackFound : public ConvergenceError {
 public:
  NoTrackFound(Issue issue, OptimizeReport report)
      : ConvergenceError(std::move(issue)), report_(std::move(report)) {}
  [[nodiscard]] const OptimizeReport& report() const noexcept { return report_; }

 private:
  OptimizeReport report_;
};

}  // namespace glissade
