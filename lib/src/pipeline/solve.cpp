#include "glissade/pipeline/solve.hpp"

#include "glissade/centerline/constant_speed_curve.hpp"
#include "glissade/centerline/cycloid.hpp"
#include "glissade/centerline/drawn_track.hpp"
#include "glissade/centerline/fastest_track.hpp"
#include "glissade/centerline/fitted_profile.hpp"
#include "glissade/centerline/in_run.hpp"
#include "glissade/centerline/no_curvature_load.hpp"
#include "glissade/centerline/reach.hpp"
#include "glissade/centerline/straight_line.hpp"
#include "glissade/centerline/tabulated_curve.hpp"
#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/io/profile_csv.hpp"
#include "glissade/trades/chute/stream.hpp"

#include "optimize/stopped.hpp"
#include "pipeline/body.hpp"
#include "pipeline/extremes.hpp"
#include "pipeline/friction_range.hpp"
#include "pipeline/gates.hpp"
#include "pipeline/hood.hpp"
#include "pipeline/limits.hpp"
#include "pipeline/located.hpp"

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

/// The track on which a stream keeps the speed at which it enters, and with it its depth and its friction.
/// @throws InputError if at that speed there is none, with the entry speed from which on there is
CenterlinePtr make_even_depth(const Design& design, const Endpoints& endpoints) {
  const Body body = body_of(design);
  const auto friction_at = [&](double speed) {
    return Friction::from_coefficient(body.law->resistance(0.0, speed * speed).factor *
                                      body.friction.coefficient());
  };
  const double entry = body.entry_speed;
  // A faster stream is thinner and rubs less: the least speed is a fixed point that a few steps find.
  double needed = entry;
  for (int i = 0; i < 20; ++i) {
    needed = std::sqrt(ConstantSpeedCurve::smallest_p(endpoints, friction_at(needed), design.gravity));
  }
  if (entry >= needed) {
    return std::make_shared<ConstantSpeedCurve>(endpoints, friction_at(entry), design.gravity, entry * entry);
  }
  throw InputError(
      {design.where("body.entry_speed"),
       "entry_speed: no track between these points keeps a stream at " + rounded_text(entry, 4) + " m/s",
       "Slower than " + rounded_text(needed, 4) +
           " m/s it would have to start steeper than vertical to give off enough energy: even "
           "burden depth is the constant-speed curve (docs/chutes.md).",
       "an entry_speed of at least " + rounded_text(needed * (1.0 + 1e-3), 4) +
           " m/s, ends less steep, or kind: fastest"});
}

CenterlinePtr make_constant_speed(const Design& design, const Endpoints& endpoints) {
  const Friction friction = design.body.friction;
  if (const auto p = design.centerline.constant_speed_p) {
    return std::make_shared<ConstantSpeedCurve>(endpoints, friction, design.gravity, *p);
  }
  if (design.stream) return make_even_depth(design, endpoints);
  return std::make_shared<ConstantSpeedCurve>(
      ConstantSpeedCurve::fastest(endpoints, friction, design.gravity, design.body.entry_speed));
}

CenterlinePtr make_segments(const Design& design) {
  DrawnSegments drawn = drawn_segments(design.track, design.centerline);
  if (drawn.fault) throw InputError(std::move(drawn.fault->issue));
  return joined(design.centerline.entry_slope_angle, drawn.segments);
}

/// A fault of a file's points, at their line.
[[noreturn]] void refuse_point(const CenterlineDesign& design, const ProfilePoints& profile, Issue issue,
                               std::optional<std::size_t> point) {
  issue.where = design.points_file.string();
  if (point) issue.where += ":" + std::to_string(profile.lines[*point]);
  throw InputError(std::move(issue));
}

/// Points that say how the track leads on from each: nothing is fitted.
CenterlinePtr make_tabulated(const CenterlineDesign& design, const ProfilePoints& profile) {
  std::vector<TabulatedPoint> rows;
  rows.reserve(profile.points.size());
  for (std::size_t i = 0; i < profile.points.size(); ++i) {
    const Vec2 place = profile.points[i];
    rows.push_back({place.x, place.y, profile.slope_angles[i], profile.curvatures[i]});
  }
  if (const auto fault = table_fault(rows)) refuse_point(design, profile, fault->issue, fault->row);
  return std::make_shared<TabulatedCurve>(std::move(rows));
}

ProfilePoints read_points(const CenterlineDesign& design) {
  const ProfileCsvOptions options{design.points_distance_column, design.points_height_column,
                                  design.points_unit, design.points_slope_angle_column,
                                  design.points_curvature_column};
  ProfilePoints profile = read_profile_csv(design.points_file, options);
  if (auto fault = distance_fault(profile, options)) {
    fault->where = design.points_file.string();
    throw InputError(*std::move(fault));
  }
  return profile;
}

std::shared_ptr<const FittedProfile> fit_points(const CenterlineDesign& design, ProfilePoints profile) {
  if (const auto fault = profile_fault(profile.points)) {
    refuse_point(design, profile, fault->issue, fault->point);
  }
  return std::make_shared<FittedProfile>(std::move(profile.points), ProfileFit{design.points_max_deviation});
}

CenterlinePtr make_points(const Design& design) {
  ProfilePoints points = read_points(design.centerline);
  CenterlinePtr track;
  double deviation = 0.0;
  if (points.curvatures.empty()) {
    const auto profile = fit_points(design.centerline, std::move(points));
    deviation = profile->max_deviation();
    track = profile;
  } else {
    track = make_tabulated(design.centerline, points);
  }
  if (!design.track.finish_given) return track;
  const Endpoints end = track->endpoints();
  auto missed = missed_finish(design.track, "the points", {end.run, end.drop}, deviation);
  if (!missed) return track;
  missed->where = design.where("track.finish");
  throw InputError(*std::move(missed));
}

FastestTrack fastest_of(const Design& design) {
  return fastest_track(endpoints_of(design), design.body.friction, design.body.entry_speed, design.gravity);
}

CenterlinePtr make_of_kind(const Design& design) {
  const Endpoints endpoints = endpoints_of(design);
  const Friction friction = design.body.friction;
  switch (design.centerline.kind) {
    case CenterlineKind::fastest:
      return fastest_of(design).centerline;
    case CenterlineKind::constant_speed:
      return make_constant_speed(design, endpoints);
    case CenterlineKind::straight:
      return std::make_shared<StraightLine>(endpoints);
    case CenterlineKind::cycloid:
      return std::make_shared<Cycloid>(endpoints);
    case CenterlineKind::no_curvature_load:
      return std::make_shared<NoCurvatureLoadCurve>(endpoints, friction);
    case CenterlineKind::segments:
      return make_segments(design);
    case CenterlineKind::points:
      return make_points(design);
    case CenterlineKind::in_run:
      return std::make_shared<InRun>(design.centerline.in_run.shape());
  }
  throw InternalError({"", "a centerline of this kind cannot be made", "", ""});
}

/// Where the curve really ends: what was drawn by hand may miss the finish by a little.
Endpoints endpoints_of(const Centerline& centerline) {
  const CenterlinePoint finish = centerline.at(centerline.length());
  return {finish.x, finish.drop};
}

std::optional<Motion> straight_ride(const Endpoints& endpoints, const Body& body, double gravity) {
  Motion ride(std::make_shared<StraightLine>(endpoints), body, gravity);
  if (!ride.arrived() || !enters(ride)) return {};
  return ride;
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

std::optional<double> Track::straight_travel_time() const {
  if (!straight) return {};
  return straight->travel_time();
}

Endpoints endpoints_of(const Design& design) {
  const Vec3 way = design.track.finish - design.track.start;
  return {math::hypot(way.x, way.y), -way.z};
}

Design with_finish(Design design) {
  if (design.track.finish_given) return design;
  const Endpoints end = make_centerline(design)->endpoints();
  design.track.finish = design.track.start + Vec3{end.run, 0.0, -end.drop};
  design.track.finish_given = true;
  return design;
}

CenterlinePtr make_centerline(const Design& design) {
  return at_place(design.where("centerline"), [&] { return make_of_kind(design); });
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
  return wear_of(motions).floor.value;
}

/// While it lives, a request to stop is met by a search; the work then goes on with what that found.
class SearchGoesOn {
 public:
  explicit SearchGoesOn(const RunContext& context) : context_(context) { tell(true); }
  ~SearchGoesOn() { tell(context_.stop.stop_requested()); }
  SearchGoesOn(const SearchGoesOn&) = delete;
  SearchGoesOn& operator=(const SearchGoesOn&) = delete;

 private:
  void tell(bool goes_on) const {
    if (context_.goes_on_after_stop != nullptr) *context_.goes_on_after_stop = goes_on;
  }
  const RunContext& context_;
};

Optimum search_that_may_end(const Design& design, const RunContext& context) {
  const SearchGoesOn goes_on(context);
  return search_within_limits(design, context);
}

/// The same search for the travel time, which prices what it was given up for. None where the work was asked to end: what it
/// found by then would price nothing.
std::optional<FastestWithin> fastest_within(Design design, const RunContext& context) {
  const ObjectiveKind kind = design.objective.kind;
  if (kind != ObjectiveKind::least_wear && kind != ObjectiveKind::least_peak_wear &&
      kind != ObjectiveKind::even_speed)
    return {};
  if (context.stop.stop_requested()) return {};
  design.objective.kind = ObjectiveKind::travel_time;
  try {
    const Optimum optimum = search_that_may_end(design, context);
    if (context.stop.stop_requested()) return {};
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
Track solve_settled(const Design& design, const RunContext& context) {
  if (context.progress) context.progress("finding the track", {});
  // The closed form knows neither limits, nor a finish that it may choose, nor drag, nor bodies but the sliding
  // point.
  const bool searched =
      design.limits || design.track.free_finish != FinishKind::point || !has_closed_optimum(body_of(design));
  if (design.centerline.kind != CenterlineKind::fastest)
    return ride(design, make_centerline(design), context);
  if (!searched) return ride_fastest(design, context);
  Optimum optimum = search_that_may_end(design, context);
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

}  // namespace

Track solve(const Design& given, const RunContext& context) {
  require_sound(given);
  const Design design = settled(given, context);
  if (auto problem = hood_problem(design)) throw InfeasibleError(*std::move(problem));
  return solve_settled(design, context);
}

namespace {

/// What a track is the most of, as an adjective of it.
const char* best_text(ObjectiveKind kind) {
  switch (kind) {
    case ObjectiveKind::exit_speed:
      return "of the highest exit speed";
    case ObjectiveKind::least_wear:
      return "of the least wear";
    case ObjectiveKind::least_peak_wear:
      return "of the least peak wear";
    case ObjectiveKind::even_speed:
      return "of the most even speed";
    case ObjectiveKind::least_drop:
      return "lowest";
    case ObjectiveKind::least_length:
      return "shortest";
    case ObjectiveKind::least_load:
      return "of the least load";
    case ObjectiveKind::least_curvature_rate:
      return "of the most gradual bends";
    case ObjectiveKind::blend:
      return "of the best blend of travel time and exit speed";
    case ObjectiveKind::travel_time:
      break;
  }
  return "fastest";
}

}  // namespace

std::string searched_name(const Design& design) {
  return std::string(best_text(design.objective.kind)) +
         (design.limits ? " within the limits" : ", searched for");
}

namespace {

/// A feed that falls flatter than the floor where it should land never meets it there.
std::optional<Issue> feed_problem(const Design& design, const Track& track) {
  if (!design.feed) return {};
  Angle falls = track.motion.body().landing->angle;
  bool all_land = lands(track.motion);
  for (const LevelRide& ride : track.rides()) {
    falls = std::min(falls, ride.motion->body().landing->angle);
    all_land = all_land && lands(*ride.motion);
  }
  if (all_land) return {};
  const Angle slope = Angle::from_radians(track.centerline->slope_angle(0.0));
  return Issue{design.where("feed"),
               "the feed flies over the start: it falls at " + angle_text(falls) + ", the floor at " +
                   angle_text(slope),
               "A stream meets a floor that is less steep than its way.",
               "a larger drop, a slower belt, or limits: {entry_slope_angle: {highest: " +
                   angle_text(falls, 3) + "}}"};
}

// Tenths of a degree, rounded to the side that helps.
constexpr double kShownSteps = 10.0;  // taste

Angle shown_up(Angle angle) {
  return Angle::from_degrees(std::ceil(kShownSteps * angle.degrees()) / kShownSteps);
}
Angle shown_down(Angle angle) {
  return Angle::from_degrees(std::floor(kShownSteps * angle.degrees()) / kShownSteps);
}

/// What would do in place of a feed that stands where it lands: the impact then leaves what practice asks for. Only what
/// brings the stream to the finish is told.
class WaysOut {
 public:
  WaysOut(const Design& design, const Track& track, const Motion& motion)
      : design_(design), track_(track), motion_(motion) {}

  [[nodiscard]] std::string text() const {
    std::string text;
    for (const std::string& way : {floor(), friction(), feed()}) {
      if (!way.empty()) text += (text.empty() ? "" : ", or ") + way;
    }
    if (text.empty()) return "less friction, or a floor nearer to the direction of the fall";
    return text + ": the impact then leaves " + rounded_text(kSpeedToKeep, 2) + " of the speed";
  }

 private:
  [[nodiscard]] Angle falls() const { return motion_.body().landing->angle; }
  [[nodiscard]] Angle slope() const { return Angle::from_radians(motion_.centerline().slope_angle(0.0)); }
  [[nodiscard]] Angle steepest() const { return steepest_impact(kSpeedToKeep, motion_.body().friction); }
  [[nodiscard]] bool arrives(const CenterlinePtr& centerline, const Body& body) const {
    const Motion tried(centerline, body, design_.gravity);
    return tried.arrived() && enters(tried);
  }

  [[nodiscard]] std::string floor() const {
    const Angle least = std::min(falls(), shown_up(falls() - steepest()));
    // A floor that is upright has no run; one that climbs leads nowhere.
    constexpr double kMost = 89.9;  // taste [deg]
    if (!(least.degrees() > 0.0 && least.degrees() < kMost)) return {};
    const double length = track_.centerline->length();
    const Endpoints ends{length * math::cos(least.radians()), length * math::sin(least.radians())};
    if (!arrives(std::make_shared<const StraightLine>(ends), motion_.body())) return {};
    return "a floor of at least " + angle_text(least) + " where it lands";
  }

  [[nodiscard]] std::string friction() const {
    const auto kept = most_friction_of_impact(kSpeedToKeep, falls() - slope());
    const std::optional<Angle> stops = stall_angle_of(track_);
    if (!kept || !stops) return {};
    const Angle most = shown_down(std::min(kept->angle(), *stops));
    Body body = motion_.body();
    body.friction = Friction::from_angle(most);
    return arrives(track_.centerline, body) ? "a friction angle of at most " + angle_text(most)
                                            : std::string();
  }

  [[nodiscard]] std::string feed() const {
    if (design_.hood || design_.feed->kind != FeedKind::belt) return {};
    const Angle most = shown_down(slope() + steepest());
    Body body = motion_.body();
    body.landing->angle = most;
    if (!arrives(track_.centerline, body)) return {};
    return "a feed that falls at " + angle_text(slope(), 3) + " to " + angle_text(most) +
           " (a faster belt, or less drop)";
  }

  const Design& design_;
  const Track& track_;
  const Motion& motion_;
};

/// A feed of which friction takes all the speed where it lands.
Issue stand_problem(const Design& design, const Track& track, const Motion& motion, const std::string& when) {
  const Angle steeper =
      motion.body().landing->angle - Angle::from_radians(motion.centerline().slope_angle(0.0));
  return {design.where("feed"), when + "the feed stands where it lands: friction takes all of its speed",
          "It falls " + angle_text(steeper, 3) + " steeper than the floor; with the friction angle, " +
              angle_text(motion.body().friction.angle()) + ", that is 90 deg or more.",
          WaysOut(design, track, motion).text()};
}

/// What keeps one ride from the finish. Of a ride at the nominal friction the friction needs no name.
std::optional<Issue> problem_of_ride(const Design& design, const Track& track, const LevelRide& ride) {
  const Motion& motion = *ride.motion;
  const double length = track.centerline->length();
  const std::string when = ride.level == FrictionLevel::nominal ? "" : at_friction_text(ride) + ", ";
  if (stands_where_it_lands(motion)) return stand_problem(design, track, motion, when);
  if (const auto& stall = motion.stall()) {
    const auto [stalls_after, whole] = texts_apart(stall->arc_length, length, &length_text);
    const bool all_but_there = stalls_after == whole;  // nearer than digits tell
    const std::string place = all_but_there
                                  ? "the body stalls all but at the finish, at " + length_text(length)
                                  : (stall->arc_length == 0.0 ? "the body does not start to slide"
                                                              : "the body stalls after " + stalls_after) +
                                        ", before the finish at " + whole;
    return Issue{design.where("centerline"), when + place,
                 "The slope angle there is " +
                     angle_text(Angle::from_radians(track.centerline->slope_angle(stall->arc_length))) +
                     ", " + angle_text(stall->missing_slope) + " less than " +
                     friction_text(motion.body(), *stall) + ".",
                 std::string("a steeper track, less friction, or ") +
                     (design.body.entry_speed > 0.0 ? "a higher entry_speed" : "an entry_speed")};
  }
  if (const auto& lift_off = motion.lift_off()) {
    return Issue{design.where("centerline"),
                 when + "the body leaves the track after " + length_text(lift_off->arc_length) + ", at " +
                     rounded_text(lift_off->speed, 4) + " m/s",
                 "The track bends away below it there with a radius of " +
                     length_text(1.0 / std::fabs(lift_off->curvature)) +
                     ", tighter than gravity can make it follow.",
                 "a larger radius at that crest, or less speed"};
  }
  if (const auto& end = motion.law_end()) return law_end_problem(design, *end, length);
  return {};
}

}  // namespace

std::optional<LevelRide> ride_that_fails(const Track& track) {
  for (const LevelRide& ride : track.rides()) {
    if (!lands(*ride.motion)) return ride;
  }
  if (!track.motion.arrived()) return LevelRide{FrictionLevel::nominal, &track.motion};
  for (const RangeRide& ride : track.range) {
    if (!ride.motion.arrived()) return LevelRide{ride.level, &ride.motion};
  }
  return {};
}

std::optional<Issue> ride_problem(const Design& design, const Track& track) {
  const std::optional<LevelRide> fails = ride_that_fails(track);
  if (!fails) return {};
  if (auto problem = feed_problem(design, track)) return problem;
  auto problem = problem_of_ride(design, track, *fails);
  const bool searched = design.limits && design.centerline.kind == CenterlineKind::fastest;
  if (problem && fails->level != FrictionLevel::nominal && !searched &&
      design.centerline.kind == CenterlineKind::fastest) {
    problem->hint = "limits: {}, which finds the fastest track that holds over the whole range of friction";
  }
  return problem;
}

}  // namespace glissade
