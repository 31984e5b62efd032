#include "referee/judgement.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/motion/laws/most_wear.hpp"
#include "glissade/motion/motion.hpp"

#include "referee/track_samples.hpp"
#include "referee/watches.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

namespace glissade::referee {
namespace {

/// A friction that limits hold at, and what the check of arriving there is called, if it has one.
struct NamedFriction {
  Friction friction;
  std::optional<FrictionLevel> level;  ///< none where there is no range
  std::optional<LimitId> arrival;
  bool is_nominal = false;
};

/// The friction inside a range at which a stream wears its track most, where wear is limited: mu N is greatest at neither end.
std::optional<Friction> most_wearing(const Problem& problem, const CenterlinePtr& track) {
  const bool is_limited = problem.limits.highest_floor_wear.has_value();
  if (!is_limited || (!problem.low_friction && !problem.high_friction)) return {};
  return friction_of_most_wear(track, problem.body, problem.gravity,
                               problem.low_friction.value_or(problem.body.friction),
                               problem.high_friction.value_or(problem.body.friction));
}

std::vector<NamedFriction> frictions_of(const Problem& problem, const CenterlinePtr& track) {
  using enum FrictionLevel;
  const bool ranges = problem.low_friction || problem.high_friction;
  std::vector<NamedFriction> frictions{
      {problem.body.friction, ranges ? std::optional(nominal) : std::nullopt, {}, true}};
  if (problem.low_friction) {
    frictions.push_back({*problem.low_friction, low, LimitId::arrival_at_low_friction});
  }
  if (problem.high_friction) {
    frictions.push_back({*problem.high_friction, high, LimitId::arrival_at_high_friction});
  }
  if (const auto friction = most_wearing(problem, track)) frictions.push_back({*friction, between, {}});
  return frictions;
}

}  // namespace

const LimitCheck* Judgement::find(const LimitName& limit) const {
  const auto found = std::find_if(checks.begin(), checks.end(),
                                  [&](const LimitCheck& check) { return check.limit == limit; });
  return found == checks.end() ? nullptr : &*found;
}

namespace {

/// The problem with all places counted from the start of a track.
Problem from_start_of(Problem problem, const Centerline& track) {
  if (problem.places_from == PlacesFrom::start) return problem;
  const Endpoints ends = track.endpoints();
  const Vec2 finish{ends.run, ends.drop};
  Limits& limits = problem.limits;
  const auto shift = [&](std::vector<Vec2>& points) {
    for (Vec2& point : points) point = point + finish;
  };
  for (HalfPlane& plane : limits.half_planes) plane.point = plane.point + finish;
  for (KeepOut& area : limits.keep_outs) shift(area.outline);
  for (Profile& profile : limits.stay_above) shift(profile.line);
  for (Profile& profile : limits.stay_below) shift(profile.line);
  shift(limits.waypoints);
  problem.places_from = PlacesFrom::start;
  return problem;
}

}  // namespace

namespace {

bool comes_first(const CenterlinePoint& a, const CenterlinePoint& b) {
  return a.arc_length < b.arc_length;
}

/// Where a track is looked at, in order: samples, and wherever between them its slope is greatest or least.
std::vector<CenterlinePoint> points_along(const Centerline& track, const Problem& problem, int samples) {
  const std::vector<double> stations = sampled(track, problem, samples);
  std::vector<CenterlinePoint> points;
  std::vector<double> slopes;
  for (const double s : stations) {
    points.push_back(track.at(s));
    slopes.push_back(points.back().slope_angle);
  }
  std::vector<double> places;
  add_extremes(stations, slopes, places);
  for (const double s : places) points.push_back(track.at(s));
  std::inplace_merge(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(stations.size()),
                     points.end(), comes_first);
  return points;
}

/// What a ride shows at one place.
struct Sight {
  double s = 0.0;
  Watches::Measures measures;
};

/// Adds the places at which something that limits ask for is greatest or least. Where samples are far apart for its bends a
/// parabola through three of them tells the place roughly; one through those next to that place tells it better.
/// @param sights  in order
void add_extreme_sights(std::vector<Sight>& sights, const std::function<Sight(double)>& sight) {
  constexpr int kRounds = 6;  // budget: each has some twice as many digits
  for (int round = 0; round < kRounds; ++round) {
    std::vector<double> stations;
    for (const Sight& seen : sights) stations.push_back(seen.s);
    std::vector<double> places;
    std::vector<double> values(stations.size());
    for (std::size_t k = 0; k < Watches::Measures{}.size(); ++k) {
      for (std::size_t i = 0; i < values.size(); ++i) values[i] = sights[i].measures[k];
      add_extremes(stations, values, places);
    }
    if (places.empty()) return;
    std::sort(places.begin(), places.end());
    places.erase(std::unique(places.begin(), places.end()), places.end());
    for (const double s : places) sights.push_back(sight(s));
    std::inplace_merge(sights.begin(), sights.begin() + static_cast<std::ptrdiff_t>(stations.size()),
                       sights.end(), [](const Sight& a, const Sight& b) { return a.s < b.s; });
  }
}

/// What a ride that ends before the finish shows where it ends, on the side that it came from: what the track does beyond a
/// jump of curvature there, the body does not ride. A law's own quantity is what it is where the law ends (Motion::highest()).
Sight sight_of_end(const Motion& motion, const Watches& watches) {
  const double end = motion.distance();
  const auto measures_at = [&](double s) {
    return watches.measures(motion.at(s), motion.centerline().at(s));
  };
  const Watches::Measures there = measures_at(end);
  if (end == 0.0) return {end, there};
  Watches::Measures measures = measures_at(std::nextafter(end, 0.0));
  for (std::size_t k = Watches::kFirstOfLaw; motion.law_end() && k < measures.size(); ++k) {
    measures[k] = std::max(measures[k], there[k]);
  }
  return {end, measures};
}

/// Shows a ride at the points that it reaches, and wherever between them something that limits ask for is greatest or least.
void show(const Motion& motion, const std::vector<CenterlinePoint>& points, Watches& watches) {
  const auto sight_at = [&](const CenterlinePoint& point) -> Sight {
    const MotionState state = motion.at(point.arc_length);
    return {point.arc_length, watches.measures(state, point)};
  };
  std::vector<Sight> sights;
  const bool arrived = motion.arrived();
  for (const CenterlinePoint& point : points) {
    if (point.arc_length > motion.distance()) break;
    if (arrived || point.arc_length < motion.distance()) sights.push_back(sight_at(point));
  }
  if (!arrived) sights.push_back(sight_of_end(motion, watches));
  add_extreme_sights(sights, [&](double s) { return sight_at(motion.centerline().at(s)); });
  for (const Sight& seen : sights) watches.at_measures(seen.measures, seen.s);
}

}  // namespace

Judgement judge_track(const Problem& asked, const CenterlinePtr& track, int samples,
                      BrokenRides broken_rides) {
  const Problem problem = from_start_of(asked, *track);
  const CenterlinePoint end = track->at(track->length());
  const double chord = math::hypot(end.x, end.drop);
  const std::vector<CenterlinePoint> points = points_along(*track, problem, samples);

  Watches watches(problem, chord);
  for (const CenterlinePoint& point : points) watches.at_point(point);
  watches.at_obstacles(*track, points);
  see_curvature(*track, samples, watches);
  const auto [lead_in, lead_out] = straight_ends(points);
  watches.at_leads(lead_in, lead_out, track->length());
  const std::vector<std::size_t> passages = passages_in_order(points, problem.limits.waypoints);
  for (std::size_t i = 0; i < problem.limits.waypoints.size(); ++i) {
    double where = 0.0;
    const double distance = closest_approach(*track, points, passages[i], problem.limits.waypoints[i], where);
    watches.near(i, distance, where);
  }

  Judgement judgement;
  judgement.arrived = true;
  for (const auto& [friction, level, arrival, is_nominal] : frictions_of(problem, track)) {
    watches.ride_at(level, friction);
    Body body = problem.body;
    body.friction = friction;
    const Motion motion(track, body, problem.gravity);
    // What flies over the start is no ride. A search has a limit of its own for that, and ends as near to it as to any other.
    if (broken_rides == BrokenRides::judged && !lands(motion)) {
      judgement.arrived = false;
      if (arrival) watches.at_arrival(*arrival, 0.0, track->length());
      continue;
    }
    if (arrival) watches.at_arrival(*arrival, motion.distance(), track->length());
    if (!motion.arrived()) {
      judgement.arrived = false;
      if (motion.lift_off()) judgement.lift_off = motion.lift_off()->arc_length;
      if (motion.stall()) judgement.stall = motion.stall()->arc_length;
      if (motion.law_end()) judgement.stall = motion.law_end()->arc_length;
      if (broken_rides == BrokenRides::left_out) continue;
    }
    if (is_nominal) {
      judgement.travel_time = motion.travel_time();
      judgement.exit_speed = motion.exit_speed();
    }
    show(motion, points, watches);
    if (motion.arrived()) watches.at_exit_speed(motion.exit_speed(), end);
    if (motion.stall()) watches.at_stall(motion.stall()->arc_length);
    if (motion.lift_off()) watches.at_lift_off();
  }
  watches.ride_at({});
  watches.at_end(*track);
  judgement.checks = watches.checks();
  judgement.broken = watches.broken();
  if (asked.places_from == PlacesFrom::finish) {
    for (LimitCheck& check : judgement.checks) {
      if (check.closest) check.closest->point = check.closest->point - Vec2{end.x, end.drop};
    }
  }
  for (const LimitCheck& check : judgement.checks) {
    judgement.worst = std::max(judgement.worst, check.violation / check.scale);
  }
  return judgement;
}

}  // namespace glissade::referee

namespace glissade {

std::vector<LimitCheck> check_limits(const Problem& problem, const CenterlinePtr& track) {
  require_judgeable(problem);
  if (!track) throw InputError({"", "there is no track to hold against the limits", "", ""});
  return referee::judge_track(problem, track, referee::kRefereeSamples, referee::BrokenRides::judged).checks;
}

}  // namespace glissade
