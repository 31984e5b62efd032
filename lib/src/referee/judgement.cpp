#include "referee/judgement.hpp"

#include "glissade/centerline/clothoid_spline.hpp"
#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/motion/laws/bulk_stream.hpp"
#include "glissade/motion/motion.hpp"

#include "clearance/strip.hpp"
#include "core/plane_geometry.hpp"
#include "task/obstacles.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <string>
#include <utility>

namespace glissade::referee {
namespace {

double distance_to_polygon(Vec2 point, const std::vector<Vec2>& outline) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < outline.size(); ++i) {
    least = std::min(least, core::distance_to_segment(point, outline[i], outline[(i + 1) % outline.size()]));
  }
  return core::is_inside(point, outline) ? -least : least;
}

/// side +1: free above the line, -1: free below it
double distance_to_profile(Vec2 point, const std::vector<Vec2>& line, double side) {
  double least = std::numeric_limits<double>::infinity();
  bool behind = false;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Vec2 a = line[i];
    const Vec2 b = line[i + 1];
    least = std::min(least, core::distance_to_segment(point, a, b));
    if (point.x >= a.x && point.x <= b.x) {
      const double drop = a.y + (b.y - a.y) * (point.x - a.x) / (b.x - a.x);
      behind = behind || side * (point.y - drop) > 0.0;
    }
  }
  return behind ? -least : least;
}

/// Where a vertical line meets a polygon: the least drop and the greatest.
std::optional<std::pair<double, double>> drops_at(const std::vector<Vec2>& outline, double run) {
  std::optional<std::pair<double, double>> drops;
  const auto meet = [&](double drop) {
    if (!drops) drops.emplace(drop, drop);
    drops->first = std::min(drops->first, drop);
    drops->second = std::max(drops->second, drop);
  };
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2 a = outline[i];
    const Vec2 b = outline[(i + 1) % outline.size()];
    if (std::min(a.x, b.x) > run || std::max(a.x, b.x) < run) continue;
    if (a.x == b.x) {
      meet(a.y);
      meet(b.y);
    } else {
      meet(a.y + (b.y - a.y) * (run - a.x) / (b.x - a.x));
    }
  }
  return drops;
}

/// Distance from the area; negative within it, and where the area is passed on the wrong side.
double distance_to_keep_out(Vec2 point, const KeepOut& keep_out) {
  const double distance = distance_to_polygon(point, keep_out.outline);
  if (keep_out.passage == Passage::either) return distance;
  const auto drops = drops_at(keep_out.outline, point.x);
  if (!drops) return distance;
  const bool above = keep_out.passage == Passage::above;
  const double beyond = above ? point.y - drops->first : drops->second - point.y;
  return beyond > 0.0 ? -beyond : distance;
}

/// Keeps the worst value of one limit while the track is sampled, and that of each stretch that breaks it.
class Watch {
 public:
  Watch(const LimitName& limit, double bound, double scale)
      : check_{limit, bound, 0.0, 0.0, scale, 0.0, {}} {}

  void see(double value, double where, std::optional<FrictionLevel> friction = {},
           const std::optional<EnvelopePlace>& closest = {}) {
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
  [[nodiscard]] bool seen() const { return seen_; }
  [[nodiscard]] const LimitCheck& check() const { return check_; }
  [[nodiscard]] const std::vector<Broken>& broken() const { return broken_; }

 private:
  [[nodiscard]] double excess_of(double value) const {
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

  void see_broken(double violation, double where) {
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

  LimitCheck check_;
  std::vector<Broken> broken_;
  bool breaking_ = false;
  double last_ = 0.0;
  bool seen_ = false;
  double worst_ = 0.0;
};

/// Fewer samples where a piece is short: a curvature follows a load in many of them.
/// @param share  of the track that a piece takes up
int samples_within(double share, int samples) {
  constexpr double kUsualPieces = 32.0;
  constexpr double kLeast = 0.3;
  return std::max(static_cast<int>(std::ceil(samples * std::clamp(share * kUsualPieces, kLeast, 1.0))), 2);
}

std::vector<double> sampled(const Centerline& track, const Limits& limits, int samples) {
  const std::vector<double> breaks = track.breaks();
  std::vector<double> stations;
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    const double width = breaks[i + 1] - breaks[i];
    const int count = samples_within(width / breaks.back(), samples);
    for (int k = 0; k < count; ++k) stations.push_back(breaks[i] + width * k / count);
    // At the break itself the values of the next piece hold.
    stations.push_back(std::nextafter(breaks[i + 1], breaks[i]));
  }
  stations.push_back(breaks.back());
  if (limits.lowest_speed_from > 0.0 && limits.lowest_speed_from < breaks.back()) {
    stations.push_back(limits.lowest_speed_from);
    std::sort(stations.begin(), stations.end());
  }
  return stations;
}

/// By so much, as a share of the chord, the least clearance of an envelope may be overstated.
constexpr double kClearanceAccuracy = 1e-9;

/// All watches of a problem, and how to feed them.
class Watches {
 public:
  Watches(const Problem& problem, double chord)
      : problem_(problem), chord_(chord), stream_(dynamic_cast<const BulkStream*>(problem.body.law.get())) {}

  void at_point(const CenterlinePoint& point) {
    const Limits& limits = problem_.limits;
    const double s = point.arc_length;
    see(LimitId::slope_angle, point.slope_angle, s);
    see(LimitId::lowest_slope_margin, point.slope_angle - steepest_friction(s), s);
    if (!limits.envelope.is_line()) return;
    const Vec2 place{point.x, point.drop};
    for (std::size_t i = 0; i < limits.half_planes.size(); ++i) {
      const HalfPlane& plane = limits.half_planes[i];
      const double depth = dot(place - plane.point, plane.forbidden) / norm(plane.forbidden);
      see_item(LimitId::half_planes, i, plane.clearance, -depth, s);
    }
    for (std::size_t i = 0; i < limits.keep_outs.size(); ++i) {
      const KeepOut& keep_out = limits.keep_outs[i];
      see_item(LimitId::keep_outs, i, keep_out.clearance, distance_to_keep_out(place, keep_out), s);
    }
    for (std::size_t i = 0; i < limits.stay_above.size(); ++i) {
      const Profile& profile = limits.stay_above[i];
      see_item(LimitId::stay_above, i, profile.clearance, distance_to_profile(place, profile.line, 1.0), s);
    }
    for (std::size_t i = 0; i < limits.stay_below.size(); ++i) {
      const Profile& profile = limits.stay_below[i];
      see_item(LimitId::stay_below, i, profile.clearance, distance_to_profile(place, profile.line, -1.0), s);
    }
  }

  /// Clearances of the solid and of what slides on it.
  void at_envelope(const Centerline& track, const std::vector<CenterlinePoint>& points) {
    const Limits& limits = problem_.limits;
    if (limits.envelope.is_line()) return;
    const clearance::Strip strip(track, limits.envelope, points);
    for (const task::Obstacle& obstacle : task::obstacles_of(limits)) {
      Watch& clear = watch(obstacle.limit, obstacle.clearance, chord_);
      const std::vector<clearance::Approach> stations = strip.along(obstacle.region);
      for (const clearance::Approach& near : stations) clear.see(near.value, near.arc_length, {}, near.place);
      const clearance::Approach least = strip.least(obstacle.region, stations, kClearanceAccuracy * chord_);
      clear.see(least.value, least.arc_length, {}, least.place);
    }
  }

  /// `curvature` and `load` count on each side of a joint.
  void at_curvature(double s, double curvature) {
    if (curvature > 0.0) see(LimitId::smallest_valley_radius, 1.0 / curvature, s);
    if (problem_.limits.concave) {
      watch({LimitId::concave, Bound::lowest}, 0.0, 1.0 / chord_).see(curvature, s);
    } else if (curvature < 0.0) {
      see(LimitId::smallest_crest_radius, -1.0 / curvature, s);
    }
  }

  void at_rate(double s, double rate) { see(LimitId::highest_curvature_rate, std::fabs(rate), s); }

  /// What is seen from here on is of the ride at this friction, or of none.
  void ride_at(std::optional<FrictionLevel> level, Friction friction = {}) {
    friction_ = level;
    friction_of_ride_ = friction;
  }

  void at_state(const MotionState& state, const CenterlinePoint& point) {
    const double s = state.arc_length;
    // Unbounded curvature at a start from rest loads the track all the same no more than finitely.
    const double curvature_load = std::isfinite(point.curvature) && !problem_.body.law
                                      ? point.curvature * state.speed * state.speed
                                      : state.normal_load - problem_.gravity * math::cos(point.slope_angle);
    see(LimitId::highest_normal_load, state.normal_load, s);
    see(LimitId::lowest_normal_load, state.normal_load, s);
    see(LimitId::highest_curvature_load, curvature_load, s);
    if (stream_ != nullptr) {
      see(LimitId::highest_burden_depth, stream_->depth(s, state.speed), s);
      see(LimitId::highest_floor_wear, stream_->floor_wear(s, friction_of_ride_, state.normal_load), s);
    }
    const Range& speed = problem_.limits.speed;
    if (s >= problem_.limits.lowest_speed_from) {
      see(LimitId::speed, state.speed, s);
    } else if (speed.highest) {
      see_side({LimitId::speed, Bound::highest}, *speed.highest, state.speed, s);
    }
  }

  void at_exit_speed(double exit_speed, const CenterlinePoint& end) {
    see(LimitId::exit_speed, exit_speed, end.arc_length);
    if (!problem_.limits.match_belt) return;
    const BeltMatch& match = *problem_.limits.match_belt;
    const double along = exit_speed * math::cos(end.slope_angle) * math::cos(match.direction.radians());
    see_side({LimitId::match_belt, Bound::lowest}, match.speed * (1.0 - match.within), along, end.arc_length);
    see_side({LimitId::match_belt, Bound::highest}, match.speed * (1.0 + match.within), along,
             end.arc_length);
  }

  void at_end(const Centerline& track) {
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

  /// @param in,out  lengths of the straights that the track starts and ends with
  void at_leads(double in, double out, double length) {
    see(LimitId::lead_in, in, in);
    see(LimitId::lead_out, out, length - out);
  }

  /// How far the body comes at a friction that is not the nominal one.
  void at_arrival(LimitId limit, double distance, double length) {
    see_side({limit, Bound::lowest}, length, distance, distance);
  }

  void near(std::size_t waypoint, double distance, double s) {
    see_item(LimitId::waypoints, waypoint, 0.0, distance, s);
  }

  [[nodiscard]] std::vector<Broken> broken() const {
    std::vector<Broken> result;
    for (const Watch& watch : watches_) {
      result.insert(result.end(), watch.broken().begin(), watch.broken().end());
    }
    return result;
  }

  [[nodiscard]] std::vector<LimitCheck> checks() const {
    std::vector<LimitCheck> result;
    for (const Watch& watch : watches_) {
      if (watch.seen()) result.push_back(watch.check());
    }
    return result;
  }

 private:
  /// Holds a value against whatever the limit asks for, if anything.
  void see(LimitId id, double value, double s) {
    const LimitEntry& entry = entry_of(id);
    const Limits& limits = problem_.limits;
    if (entry.range != nullptr) see_range(id, range_of(entry, limits), value, s);
    if (entry.value != nullptr && limits.*entry.value)
      see_side({id, entry.bound}, *(limits.*entry.value), value, s);
    if (entry.length != nullptr && limits.*entry.length > 0.0) {
      see_side({id, entry.bound}, limits.*entry.length, value, s);
    }
  }

  void see_range(LimitId id, const Range& range, double value, double s) {
    if (range.is_fixed() && entry_of(id).fixable) {
      see_side({id, Bound::exactly}, *range.lowest, value, s);
      return;
    }
    if (range.lowest) see_side({id, Bound::lowest}, *range.lowest, value, s);
    if (range.highest) see_side({id, Bound::highest}, *range.highest, value, s);
  }

  void see_item(LimitId id, std::size_t index, double bound, double value, double s) {
    see_side({id, entry_of(id).bound, index}, bound, value, s);
  }

  void see_side(const LimitName& limit, double bound, double value, double s) {
    watch(limit, bound, scale_of(limit, bound)).see(value, s, friction_);
  }

  /// What a violation is measured against.
  [[nodiscard]] double scale_of(const LimitName& limit, double bound) const {
    if (limit.is_radius()) return bound;
    switch (limit.dimension()) {
      case Dimension::length:
        return chord_;
      case Dimension::speed:
        return std::sqrt(problem_.gravity * chord_);
      case Dimension::acceleration:
        return std::max(problem_.gravity, std::fabs(bound));
      case Dimension::per_area:
      case Dimension::power_per_area:
        return bound;
      default:
        return 1.0;
    }
  }

  Watch& watch(const LimitName& limit, double bound, double scale) {
    const auto found = std::find_if(watches_.begin(), watches_.end(),
                                    [&](const Watch& known) { return known.check().limit == limit; });
    if (found != watches_.end()) return *found;
    return watches_.emplace_back(limit, bound, scale);
  }

  /// @return the highest friction angle of the range at a place [rad]
  [[nodiscard]] double steepest_friction(double s) const {
    Friction friction = problem_.high_friction.value_or(problem_.body.friction);
    for (const FrictionChange& change : problem_.body.friction_changes) {
      if (change.from <= s) friction = change.friction;
    }
    return friction.angle().radians();
  }

  const Problem& problem_;
  double chord_;
  const BulkStream* stream_ = nullptr;
  std::optional<FrictionLevel> friction_;
  Friction friction_of_ride_;
  std::vector<Watch> watches_;
};

/// The samples at which a track passes some points in their order, closest to all of them together.
std::vector<std::size_t> passages_in_order(const std::vector<CenterlinePoint>& points,
                                           const std::vector<Vec2>& targets) {
  // From the last target back: the least sum of squares from a sample on, and the first sample that has it.
  std::vector<double> rest(points.size() + 1, 0.0);
  rest.back() = std::numeric_limits<double>::infinity();
  std::vector<std::vector<std::size_t>> at(targets.size());
  for (std::size_t k = targets.size(); k-- > 0;) {
    at[k].assign(points.size(), points.size() - 1);
    double least = std::numeric_limits<double>::infinity();
    std::size_t where = points.size() - 1;
    for (std::size_t i = points.size(); i-- > 0;) {
      const Vec2 away = Vec2{points[i].x, points[i].drop} - targets[k];
      const double sum = dot(away, away) + rest[i];
      if (sum <= least) {
        least = sum;
        where = i;
      }
      rest[i] = least;
      at[k][i] = where;
    }
  }
  std::vector<std::size_t> passages;
  for (std::size_t k = 0; k < targets.size(); ++k) {
    passages.push_back(at[k][passages.empty() ? 0 : passages.back()]);
  }
  return passages;
}

/// @param nearest  of the points, the one closest to the target
double closest_approach(const Centerline& track, const std::vector<CenterlinePoint>& points,
                        std::size_t nearest, Vec2 target, double& where) {
  double low = points[nearest == 0 ? 0 : nearest - 1].arc_length;
  double high = points[std::min(nearest + 1, points.size() - 1)].arc_length;
  for (int step = 0; step < 60; ++step) {
    const double middle = 0.5 * (low + high);
    const CenterlinePoint point = track.at(middle);
    const double along = (target.x - point.x) * math::cos(point.slope_angle) +
                         (target.y - point.drop) * math::sin(point.slope_angle);
    (along > 0.0 ? low : high) = middle;
  }
  where = 0.5 * (low + high);
  const CenterlinePoint point = track.at(where);
  return norm(Vec2{point.x, point.drop} - target);
}

/// A change of curvature from one piece to the next, times the track's length; below it is rounding.
constexpr double kJump = 1e-9;

/// A spline's curvature is known at its joints, and linear between them.
void see_curvature(const ClothoidSpline& spline, Watches& watches) {
  double s = 0.0;
  double before = spline.segments().front().entry_curvature;
  for (const ClothoidSegment& segment : spline.segments()) {
    const double jump = std::fabs(segment.entry_curvature - before) * spline.length();
    if (jump > kJump) watches.at_rate(s, std::numeric_limits<double>::infinity());
    watches.at_curvature(s, segment.entry_curvature);
    watches.at_rate(s, (segment.exit_curvature - segment.entry_curvature) / segment.length);
    s += segment.length;
    watches.at_curvature(s, segment.exit_curvature);
    before = segment.exit_curvature;
  }
}

void see_curvature(const Centerline& track, int samples, Watches& watches) {
  if (const auto* spline = dynamic_cast<const ClothoidSpline*>(&track)) {
    see_curvature(*spline, watches);
    return;
  }
  const std::vector<double> breaks = track.breaks();
  double before = track.direction(0.0).curvature;
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    double s_before = breaks[i];
    for (int k = 0; k <= samples; ++k) {
      const double s = k == samples ? std::nextafter(breaks[i + 1], breaks[i])
                                    : breaks[i] + (breaks[i + 1] - breaks[i]) * k / samples;
      const double curvature = track.direction(s).curvature;
      watches.at_curvature(s, curvature);
      const double change = std::fabs(curvature - before);
      if (k > 0) {
        watches.at_rate(s_before, change / (s - s_before));
      } else if (!(change * track.length() <= kJump)) {
        watches.at_rate(s, std::numeric_limits<double>::infinity());
      }
      before = curvature;
      s_before = s;
    }
  }
}

/// @return lengths of the straights that a track starts and ends with, as far as its points tell
std::pair<double, double> straight_ends(const std::vector<CenterlinePoint>& points) {
  constexpr double kStraight = 1e-7;  // [rad]
  const CenterlinePoint& first = points.front();
  const CenterlinePoint& last = points.back();
  double in = 0.0;
  for (const CenterlinePoint& point : points) {
    if (!(std::fabs(point.slope_angle - first.slope_angle) <= kStraight)) break;
    in = point.arc_length;
  }
  double out = 0.0;
  const auto bent = std::find_if(points.rbegin(), points.rend(), [&](const CenterlinePoint& point) {
    return !(std::fabs(point.slope_angle - last.slope_angle) <= kStraight);
  });
  if (bent != points.rbegin()) out = last.arc_length - std::prev(bent)->arc_length;
  // The last point before the end is a rounding away from it.
  constexpr double kNothing = 1e-12;
  return {in > kNothing * last.arc_length ? in : 0.0, out > kNothing * last.arc_length ? out : 0.0};
}

/// A friction that limits hold at, and what the check of arriving there is called; none: the nominal one.
struct NamedFriction {
  Friction friction;
  std::optional<FrictionLevel> level;  ///< none where there is no range
  std::optional<LimitId> arrival;
};

std::vector<NamedFriction> frictions_of(const Problem& problem) {
  using enum FrictionLevel;
  const bool ranges = problem.low_friction || problem.high_friction;
  std::vector<NamedFriction> frictions{
      {problem.body.friction, ranges ? std::optional(nominal) : std::nullopt, {}}};
  if (problem.low_friction) {
    frictions.push_back({*problem.low_friction, low, LimitId::arrival_at_low_friction});
  }
  if (problem.high_friction) {
    frictions.push_back({*problem.high_friction, high, LimitId::arrival_at_high_friction});
  }
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

Judgement judge_track(const Problem& asked, const CenterlinePtr& track, int samples,
                      BrokenRides broken_rides) {
  const Problem problem = from_start_of(asked, *track);
  const CenterlinePoint end = track->at(track->length());
  const double chord = math::hypot(end.x, end.drop);
  const std::vector<double> stations = sampled(*track, problem.limits, samples);
  std::vector<CenterlinePoint> points;
  points.reserve(stations.size());
  for (const double s : stations) points.push_back(track->at(s));

  Watches watches(problem, chord);
  for (const CenterlinePoint& point : points) watches.at_point(point);
  watches.at_envelope(*track, points);
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
  for (const auto& [friction, level, arrival] : frictions_of(problem)) {
    watches.ride_at(level, friction);
    Body body = problem.body;
    body.friction = friction;
    const Motion motion(track, body, problem.gravity);
    if (arrival) watches.at_arrival(*arrival, motion.distance(), track->length());
    if (!motion.arrived()) {
      judgement.arrived = false;
      if (motion.lift_off()) judgement.lift_off = motion.lift_off()->arc_length;
      if (motion.stall()) judgement.stall = motion.stall()->arc_length;
      if (motion.law_end()) judgement.stall = motion.law_end()->arc_length;
      if (broken_rides == BrokenRides::left_out) continue;
    }
    if (!arrival) {
      judgement.travel_time = motion.travel_time();
      judgement.exit_speed = motion.exit_speed();
    }
    const auto ridden = std::upper_bound(stations.begin(), stations.end(), motion.distance());
    const std::vector<MotionState> states = motion.at({stations.begin(), ridden});
    for (std::size_t i = 0; i < states.size(); ++i) watches.at_state(states[i], points[i]);
    if (motion.arrived()) watches.at_exit_speed(motion.exit_speed(), end);
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
  require_valid(problem);
  if (!track) throw InputError({"", "there is no track to hold against the limits", "", ""});
  return referee::judge_track(problem, track, referee::kRefereeSamples, referee::BrokenRides::judged).checks;
}

}  // namespace glissade
