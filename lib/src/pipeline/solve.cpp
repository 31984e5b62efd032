#include "glissade/pipeline/solve.hpp"

#include "glissade/centerline/fastest_track.hpp"
#include "glissade/centerline/reach.hpp"
#include "glissade/centerline/straight_line.hpp"
#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/trades/chute/stream.hpp"

#include "optimize/stopped.hpp"
#include "pipeline/ride/extremes.hpp"
#include "pipeline/ride/gates.hpp"
#include "pipeline/task/body.hpp"
#include "pipeline/task/friction_range.hpp"
#include "pipeline/task/hood.hpp"
#include "pipeline/task/limits.hpp"
#include "pipeline/task/located.hpp"
#include "pipeline/task/search_goes_on.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace glissade {

using namespace pipeline;

namespace {

void require_sound(const Design& design) {
  std::vector<Issue> issues = check(design);
  if (issues.empty()) return;
  const std::optional<Issue> unreachable = check_reach(design);
  if (issues.size() == 1 && unreachable && issues.front() == *unreachable) {
    throw InfeasibleError(std::move(issues));
  }
  throw InputError(std::move(issues));
}

FastestTrack fastest_of(const Design& design) {
  return fastest_track(endpoints_of(design), design.body.friction, design.body.entry_speed, design.gravity);
}

/// Where the curve really ends: what was drawn by hand may miss the finish by a little.
Endpoints endpoints_of(const Centerline& centerline) {
  const CenterlinePoint finish = centerline.at(centerline.length());
  return {finish.x, finish.drop};
}

/// Where the track lies: from its start, or, where the search chose that, up to its finish.
Placement placement_of(const TrackDesign& track, const Endpoints& endpoints) {
  const Placement from_start = Placement::through(track.start, track.finish);
  if (!track.free_start) return from_start;
  const Vec3 miss = track.finish - from_start.to_space(endpoints.run, endpoints.drop, 0.0);
  return {from_start.start() + miss, from_start.azimuth()};
}

/// Whether the theory gives the fastest track of this body in closed form, limits aside.
bool has_closed_optimum(const Body& body) {
  return is_sliding_point(body) && body.drag_per_metre == 0.0;
}

}  // namespace

std::optional<Motion> pipeline::straight_ride(const Endpoints& endpoints, const Body& body, double gravity) {
  Motion ride(std::make_shared<StraightLine>(endpoints), body, gravity);
  if (!ride.arrived() || !enters(ride)) return {};
  return ride;
}

std::optional<double> Track::straight_travel_time() const {
  if (!straight) return {};
  return straight->travel_time();
}

namespace {

/// @param found  if the track is the fastest of all, limits aside, what is known of it: it is not made twice
Track ride_on(const Design& design, CenterlinePtr centerline, std::optional<FastestTrack> found,
              const RunContext& context) {
  const bool chosen = is_drawn(design.centerline.kind) || design.track.free_finish != FinishKind::point;
  const Endpoints endpoints = chosen ? endpoints_of(*centerline) : endpoints_of(design);
  const Body body = body_of(design);

  const double radius = smallest_radius(*centerline);
  const Angle steepest = steepest_slope_angle(*centerline);
  Motion motion(centerline, body, design.gravity);

  std::optional<Motion> optimum;
  std::optional<double> optimum_travel_time;
  if (found) {
    optimum_travel_time = found->travel_time;
    optimum = motion;
  } else if (context.measures_optimum && has_closed_optimum(body) &&
             can_arrive(endpoints, body.friction, body.entry_speed, design.gravity)) {
    FastestTrack fastest = fastest_track(endpoints, body.friction, body.entry_speed, design.gravity);
    optimum_travel_time = fastest.travel_time;
    optimum.emplace(std::move(fastest.centerline), body, design.gravity);
  }
  std::vector<LimitCheck> limit_checks = checked_limits(design, endpoints, centerline);
  std::vector<RangeRide> range = rides_of_range(design, centerline);
  const Placement placement = placement_of(design.track, endpoints);
  std::optional<GateTable> gates = gate_table(design, centerline, placement);
  return {endpoints,
          placement,
          std::move(centerline),
          std::move(motion),
          straight_ride(endpoints, body, design.gravity),
          std::move(optimum),
          optimum_travel_time,
          radius,
          steepest,
          {},
          {},
          std::move(limit_checks),
          std::move(range),
          std::move(gates),
          design.hood};
}

/// The curve of the closed form, which knows neither limits nor a finish that it may choose.
Track ride_fastest(const Design& design, const RunContext& context) {
  FastestTrack fastest = at_place(design.where("centerline"), [&] { return fastest_of(design); });
  CenterlinePtr centerline = fastest.centerline;
  return ride_on(design, std::move(centerline), std::move(fastest), context);
}

}  // namespace

Track ride(const Design& design, CenterlinePtr centerline, const RunContext& context) {
  return ride_on(design, std::move(centerline), {}, context);
}

namespace {

/// The greatest wear of the floor of a track over the frictions of a design [W/m^2].
double highest_floor_wear(const Design& design, const CenterlinePtr& centerline) {
  const Motion nominal(centerline, body_of(design), design.gravity);
  const std::vector<RangeRide> range = rides_of_range(design, centerline);
  std::vector<const Motion*> motions{&nominal};
  for (const RangeRide& ride : range) motions.push_back(&ride.motion);
  const std::optional<Motion> between = most_wearing_ride(centerline, nominal, range);
  if (between) motions.push_back(&*between);
  return wear_of(motions).floor.value;
}

Optimum search_that_may_end(const Design& design, const RunContext& context) {
  const SearchGoesOn goes_on(context);
  return search_within_limits(design, context);
}

/// The same with a track that is known: it is the best so far where the search is to end before it finds any.
/// @param known  of the same design; none where nothing is known
Optimum search_from(std::optional<Optimum> known, const Design& design, const RunContext& context) {
  if (!known) return search_that_may_end(design, context);
  const auto so_far = [&] {
    optimizer::tell_stopped(known->report);
    return *std::move(known);
  };
  if (context.stop.stop_requested()) return so_far();
  try {
    return search_that_may_end(design, context);
  } catch (const Interrupted&) {
    return so_far();
  } catch (const NoTrackFound& none) {
    if (!none.report().ended_early) throw;
    known->report.ended_early = true;
    known->report.status = OptimizeStatus::feasible_not_converged;
    known->report.message = "the time budget ran out: the best track so far";
    return *std::move(known);
  }
}

/// The same search for the travel time, which prices what it was given up for. None where it was asked to end, or ran out of time:
/// what it found by then would price nothing.
std::optional<FastestWithin> fastest_within(Design design, const RunContext& context) {
  const ObjectiveKind kind = design.objective.kind;
  if (kind != ObjectiveKind::least_wear && kind != ObjectiveKind::least_peak_wear &&
      kind != ObjectiveKind::even_speed)
    return {};
  if (context.stop.stop_requested()) return {};
  design.objective.kind = ObjectiveKind::travel_time;
  try {
    const Optimum optimum = search_that_may_end(design, context);
    if (optimum.report.ended_early) return {};
    const Motion motion(optimum.centerline, body_of(design), design.gravity);
    if (!motion.arrived()) return {};
    FastestWithin fastest{motion.travel_time(), motion.at(motion.distance()).friction_loss};
    if (design.stream) fastest.floor_wear = highest_floor_wear(design, optimum.centerline);
    return fastest;
  } catch (const Error&) {
    return {};  // also where it was asked to end before it found a track: the one that is wanted is there
  }
}

/// solve() of a sound design whose hood is known.
/// @param rough  a track that its limits keep, where one is known
Track solve_settled(const Design& design, std::optional<Optimum> rough, const RunContext& context) {
  if (context.progress) context.progress("finding the track", {});
  // The closed form knows neither limits, nor a finish that it may choose, nor drag, nor bodies but the sliding
  // point.
  const bool searched =
      design.limits || design.track.free_finish != FinishKind::point || !has_closed_optimum(body_of(design));
  if (design.centerline.kind != CenterlineKind::fastest)
    return ride(design, make_centerline(design), context);
  if (!searched) return ride_fastest(design, context);
  Optimum optimum = search_from(std::move(rough), design, context);
  const bool has_met_request = optimum.report.ended_early && context.stop.stop_requested();
  if (context.progress) context.progress("riding the track", {});
  Track track = ride(design, std::move(optimum.centerline), context);
  if (context.stop.stop_requested() && !has_met_request)
    throw Interrupted({design.file, "interrupted after the search", "", ""});
  track.search = std::move(optimum.report);
  track.fastest_within = fastest_within(design, context);
  // It may have been that second search that was asked to end.
  if (context.stop.stop_requested()) optimizer::tell_stopped(*track.search);
  return track;
}

/// A track below a hood that is not known to be the best one is not known to be the best either.
void tell_of_hood(std::optional<EarlyHood> search, Track& track) {
  if (!search) return;
  track.early_hood = std::move(search);
  if (!track.search) return;
  OptimizeReport& report = *track.search;
  if (report.status != OptimizeStatus::optimal && !report.ended_early) return;
  report.status = OptimizeStatus::feasible_not_converged;
  report.message = track.early_hood->message;
  report.ended_early = report.ended_early || track.early_hood->ended_early;
  report.interrupted = report.interrupted || track.early_hood->interrupted;
}

}  // namespace

Track solve(const Design& given, const RunContext& context) {
  require_sound(given);
  SettledDesign settled = pipeline::settled(given, context);
  if (auto problem = hood_problem(settled.design)) throw InfeasibleError(*std::move(problem));
  Track track = solve_settled(settled.design, std::move(settled.rough), context);
  tell_of_hood(std::move(settled.hood_search), track);
  return track;
}

}  // namespace glissade
