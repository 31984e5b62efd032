#include "referee/watches.hpp"

#include "glissade/core/math.hpp"

#include "task/obstacles.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace glissade::referee {
namespace {

/// By so much, as a share of the chord, the least clearance may be overstated.
constexpr double kClearanceAccuracy = 1e-9;

}  // namespace

void Watch::see(double value, double where, std::optional<FrictionLevel> friction,
                const std::optional<EnvelopePlace>& closest) {
  const double excess = excess_of(value);
  see_broken(excess / check_.scale, where);
  // A friction that changes nothing but the last digits is not the one at which a limit binds.
  constexpr double kSameDigits = 1e-12;
  const double least = friction == check_.friction ? worst_ : worst_ + kSameDigits * check_.scale;
  if (seen_ && excess <= least) return;
  seen_ = true;
  worst_ = excess;
  check_.reached = value;
  check_.where = where;
  check_.friction = friction;
  check_.closest = closest;
  check_.violation = std::max(0.0, excess);
}

double Watch::excess_of(double value) const {
  switch (check_.limit.bound) {
    case Bound::highest:
      return value - check_.value;
    case Bound::lowest:
      return check_.value - value;
    case Bound::exactly:
      break;
  }
  return std::fabs(value - check_.value);
}

void Watch::see_broken(double violation, double where) {
  constexpr double kRounding = 1e-12;
  const bool goes_on = breaking_ && where >= last_;
  last_ = where;
  breaking_ = violation > kRounding;
  if (!breaking_) return;
  if (!goes_on) {
    broken_.push_back({check_.limit, where, violation});
  } else if (violation > broken_.back().violation) {
    broken_.back().where = where;
    broken_.back().violation = violation;
  }
}

Watches::Watches(const Problem& problem, double chord)
    : problem_(problem), chord_(chord), stream_(dynamic_cast<const BulkStream*>(problem.body.law.get())) {}

void Watches::at_point(const CenterlinePoint& point) {
  const double s = point.arc_length;
  see(LimitId::slope_angle, point.slope_angle, s);
  see(LimitId::lowest_slope_margin, point.slope_angle - steepest_friction(s), s);
}

void Watches::at_obstacles(const Centerline& track, const std::vector<CenterlinePoint>& points) {
  const Limits& limits = problem_.limits;
  const std::vector<task::Obstacle> obstacles = task::obstacles_of(limits);
  if (obstacles.empty()) return;
  // Of a line every place is the floor: nothing to tell of it.
  const auto place_of = [&](const clearance::Approach& near) {
    return limits.envelope.is_line() ? std::nullopt : std::optional(near.place);
  };
  const clearance::Strip strip(track, limits.envelope, points);
  for (const task::Obstacle& obstacle : obstacles) {
    Watch& clear = watch(obstacle.limit, obstacle.clearance, chord_);
    const std::vector<clearance::Approach> stations = strip.along(obstacle.region);
    for (const clearance::Approach& near : stations) {
      clear.see(near.value, near.arc_length, {}, place_of(near));
    }
    // A post between two samples, or the corner of an area, comes closer than any sample tells.
    const clearance::Approach least =
        strip.least(obstacle.region, stations, kClearanceAccuracy * chord_).closest;
    clear.see(least.value, least.arc_length, {}, place_of(least));
    if (!(least.value < 0.0)) continue;
    const std::optional<clearance::Approach> pierced = strip.pierced(obstacle.region);
    if (pierced) clear.see(pierced->value, pierced->arc_length, {}, place_of(*pierced));
  }
}

void Watches::at_curvature(double s, double curvature) {
  if (curvature > 0.0) see(LimitId::smallest_valley_radius, 1.0 / curvature, s);
  if (problem_.limits.concave) {
    watch({LimitId::concave, Bound::lowest}, 0.0, 1.0 / chord_).see(curvature, s);
  } else if (curvature < 0.0) {
    see(LimitId::smallest_crest_radius, -1.0 / curvature, s);
  }
}

void Watches::at_rate(double s, double rate) {
  see(LimitId::highest_curvature_rate, std::fabs(rate), s);
}

void Watches::ride_at(std::optional<FrictionLevel> level, Friction friction) {
  friction_ = level;
  friction_of_ride_ = friction;
}

Watches::Measures Watches::measures(const MotionState& state, const CenterlinePoint& point) const {
  // Unbounded curvature at a start from rest loads the track all the same no more than finitely.
  const double curvature_load = std::isfinite(point.curvature) && !problem_.body.law
                                    ? point.curvature * state.speed * state.speed
                                    : state.normal_load - problem_.gravity * math::cos(point.slope_angle);
  Measures measures{state.normal_load, curvature_load, state.speed, 0.0, 0.0};
  if (stream_ != nullptr) {
    const double s = state.arc_length;
    measures[3] = stream_->depth(s, state.speed);
    measures[4] = stream_->floor_wear(s, friction_at(s, friction_of_ride_), state.normal_load);
  }
  return measures;
}

void Watches::at_measures(const Measures& measures, double s) {
  const auto& [normal_load, curvature_load, speed_there, depth, wear] = measures;
  see(LimitId::highest_normal_load, normal_load, s);
  see(LimitId::lowest_normal_load, normal_load, s);
  see(LimitId::highest_curvature_load, curvature_load, s);
  if (stream_ != nullptr) {
    see(LimitId::highest_burden_depth, depth, s);
    see(LimitId::highest_floor_wear, wear, s);
  }
  const Range& speed = problem_.limits.speed;
  if (s >= problem_.limits.lowest_speed_from) {
    see(LimitId::speed, speed_there, s);
  } else if (speed.highest) {
    see_side({LimitId::speed, Bound::highest}, *speed.highest, speed_there, s);
  }
}

void Watches::at_stall(double s) {
  // Where a lowest speed is to hold from a place behind it, too: the body never gets there.
  see(LimitId::speed, 0.0, s);
  see(LimitId::exit_speed, 0.0, s);
}

void Watches::at_lift_off() {
  for (Watch& watch : watches_) {
    if (watch.check().limit.id == LimitId::lowest_normal_load) watch.see_lift_off();
  }
}

void Watches::at_exit_speed(double exit_speed, const CenterlinePoint& end) {
  see(LimitId::exit_speed, exit_speed, end.arc_length);
  if (!problem_.limits.match_belt) return;
  const BeltMatch& match = *problem_.limits.match_belt;
  const double along = exit_speed * math::cos(end.slope_angle) * math::cos(match.direction.radians());
  see_side({LimitId::match_belt, Bound::lowest}, match.speed * (1.0 - match.within), along, end.arc_length);
  see_side({LimitId::match_belt, Bound::highest}, match.speed * (1.0 + match.within), along, end.arc_length);
}

void Watches::at_end(const Centerline& track) {
  const double end = track.length();
  const CenterlinePoint last = track.at(end);
  see(LimitId::entry_slope_angle, track.at(0.0).slope_angle, 0.0);
  see(LimitId::exit_slope_angle, last.slope_angle, end);
  see(LimitId::arc_length, end, end);
  const double miss_run = last.x - std::fabs(problem_.endpoints.run);
  const double miss_drop = last.drop - problem_.endpoints.drop;
  double miss = 0.0;
  switch (problem_.finish.kind) {
    case FinishKind::point:
      miss = math::hypot(miss_run, miss_drop);
      break;
    case FinishKind::vertical_line:
      miss = std::fabs(miss_run);
      see_range(LimitId::finish_drop, problem_.finish.free_range, last.drop, end);
      break;
    case FinishKind::level:
      miss = std::fabs(miss_drop);
      see_range(LimitId::finish_run, problem_.finish.free_range, last.x, end);
      break;
    case FinishKind::anywhere:
      see_range(LimitId::finish_run, problem_.finish.free_range, last.x, end);
      see_range(LimitId::finish_drop, problem_.finish.free_drop, last.drop, end);
      return;
  }
  see_side({LimitId::finish, Bound::exactly}, 0.0, miss, end);
}

void Watches::at_leads(double in, double out, double length) {
  see(LimitId::lead_in, in, in);
  see(LimitId::lead_out, out, length - out);
}

void Watches::at_arrival(LimitId limit, double distance, double length) {
  see_side({limit, Bound::lowest}, length, distance, distance);
}

void Watches::near(std::size_t waypoint, double distance, double s) {
  see_item(LimitId::waypoints, waypoint, 0.0, distance, s);
}

std::vector<Broken> Watches::broken() const {
  std::vector<Broken> result;
  for (const Watch& watch : watches_) {
    result.insert(result.end(), watch.broken().begin(), watch.broken().end());
  }
  return result;
}

std::vector<LimitCheck> Watches::checks() const {
  std::vector<LimitCheck> result;
  for (const Watch& watch : watches_) {
    if (watch.seen()) result.push_back(watch.check());
  }
  return result;
}

void Watches::see(LimitId id, double value, double s) {
  const LimitEntry& entry = entry_of(id);
  const Limits& limits = problem_.limits;
  if (entry.range != nullptr) see_range(id, range_of(entry, limits), value, s);
  if (entry.value != nullptr && limits.*entry.value)
    see_side({id, entry.bound}, *(limits.*entry.value), value, s);
  if (entry.length != nullptr && limits.*entry.length > 0.0) {
    see_side({id, entry.bound}, limits.*entry.length, value, s);
  }
}

void Watches::see_range(LimitId id, const Range& range, double value, double s) {
  if (range.is_fixed() && entry_of(id).fixable) {
    see_side({id, Bound::exactly}, *range.lowest, value, s);
    return;
  }
  if (range.lowest) see_side({id, Bound::lowest}, *range.lowest, value, s);
  if (range.highest) see_side({id, Bound::highest}, *range.highest, value, s);
}

void Watches::see_item(LimitId id, std::size_t index, double bound, double value, double s) {
  see_side({id, entry_of(id).bound, index}, bound, value, s);
}

void Watches::see_side(const LimitName& limit, double bound, double value, double s) {
  watch(limit, bound, scale_of(limit, bound)).see(value, s, friction_);
}

double Watches::scale_of(const LimitName& limit, double bound) const {
  if (limit.is_radius()) return bound;
  switch (limit.dimension()) {
    case Dimension::length:
      return chord_;
    case Dimension::speed:
      return std::sqrt(problem_.gravity * chord_);
    case Dimension::acceleration:
      return std::max(problem_.gravity, std::fabs(bound));
    case Dimension::per_area:
      return std::max(bound, kLeastRateScale / (chord_ * chord_));
    case Dimension::power_per_area:
      return bound;
    default:
      return 1.0;
  }
}

Watch& Watches::watch(const LimitName& limit, double bound, double scale) {
  const auto found = std::find_if(watches_.begin(), watches_.end(),
                                  [&](const Watch& known) { return known.check().limit == limit; });
  if (found != watches_.end()) return *found;
  return watches_.emplace_back(limit, bound, scale);
}

double Watches::steepest_friction(double s) const {
  return friction_at(s, problem_.high_friction.value_or(problem_.body.friction)).angle().radians();
}

Friction Watches::friction_at(double s, Friction friction) const {
  for (const FrictionChange& change : problem_.body.friction_changes) {
    if (change.from <= s) friction = change.friction;
  }
  return friction;
}

}  // namespace glissade::referee
