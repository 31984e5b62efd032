#include "optimize/referee.hpp"

#include "glissade/centerline/clothoid_spline.hpp"
#include "glissade/core/math.hpp"
#include "glissade/motion/motion.hpp"

#include "core/plane_geometry.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <string>
#include <utility>

namespace glissade::optimizer {
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
  Watch(std::string limit, const char* unit, int side, double bound, double scale)
      : check_{std::move(limit), bound, 0.0, 0.0, scale, 0.0, unit, side, {}} {}

  void see(double value, double where, std::optional<FrictionLevel> friction = {}) {
    const double excess =
        check_.side == 0 ? std::fabs(value - check_.value) : check_.side * (value - check_.value);
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
    check_.violation = std::max(0.0, excess);
  }
  [[nodiscard]] bool seen() const { return seen_; }
  [[nodiscard]] const LimitCheck& check() const { return check_; }
  [[nodiscard]] const std::vector<Broken>& broken() const { return broken_; }

 private:
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

std::vector<double> sampled(const Centerline& track, const Limits& limits, int samples) {
  const std::vector<double> breaks = track.breaks();
  std::vector<double> stations;
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    for (int k = 0; k < samples; ++k) {
      stations.push_back(breaks[i] + (breaks[i + 1] - breaks[i]) * k / samples);
    }
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

std::string indexed(const char* name, std::size_t i) {
  return name + ("[" + std::to_string(i) + "]");
}

/// All watches of a problem, and how to feed them.
class Watches {
 public:
  Watches(const Problem& problem, double chord) : problem_(problem), chord_(chord) {}

  void at_point(const CenterlinePoint& point) {
    const Limits& limits = problem_.limits;
    const double s = point.arc_length;
    range("slope_angle", "rad", limits.slope_angle, 1.0, point.slope_angle, s);
    const Vec2 place{point.x, point.drop};
    for (std::size_t i = 0; i < limits.half_planes.size(); ++i) {
      const HalfPlane& plane = limits.half_planes[i];
      const double depth = dot(place - plane.point, plane.forbidden) / norm(plane.forbidden);
      least(indexed("half_planes", i), plane.clearance, -depth, s);
    }
    for (std::size_t i = 0; i < limits.keep_outs.size(); ++i) {
      const KeepOut& keep_out = limits.keep_outs[i];
      least(indexed("keep_outs", i), keep_out.clearance, distance_to_keep_out(place, keep_out), s);
    }
    for (std::size_t i = 0; i < limits.stay_above.size(); ++i) {
      const Profile& profile = limits.stay_above[i];
      least(indexed("stay_above", i), profile.clearance, distance_to_profile(place, profile.line, 1.0), s);
    }
    for (std::size_t i = 0; i < limits.stay_below.size(); ++i) {
      const Profile& profile = limits.stay_below[i];
      least(indexed("stay_below", i), profile.clearance, distance_to_profile(place, profile.line, -1.0), s);
    }
  }

  /// `curvature` and `load` count on each side of a joint.
  void at_curvature(double s, double curvature) {
    const Limits& limits = problem_.limits;
    if (limits.smallest_valley_radius && curvature > 0.0)
      radius("smallest_valley_radius", *limits.smallest_valley_radius, curvature, s);
    if (limits.concave) {
      watch("concave", "1/m", -1, 0.0, 1.0 / chord_).see(curvature, s);
    } else if (limits.smallest_crest_radius && curvature < 0.0) {
      radius("smallest_crest_radius", *limits.smallest_crest_radius, -curvature, s);
    }
  }

  void at_rate(double s, double rate) {
    const auto& bound = problem_.limits.highest_curvature_rate;
    if (bound) watch("highest_curvature_rate", "1/m^2", +1, *bound, *bound).see(std::fabs(rate), s);
  }

  /// What is seen from here on is of the ride at this friction, or of none.
  void ride_at(std::optional<FrictionLevel> friction) { friction_ = friction; }

  void at_state(const MotionState& state, const CenterlinePoint& point) {
    const Limits& limits = problem_.limits;
    const double s = state.arc_length;
    // Unbounded curvature at a start from rest loads the track all the same no more than finitely.
    const double curvature_load = std::isfinite(point.curvature)
                                      ? point.curvature * state.speed * state.speed
                                      : state.normal_load - problem_.gravity * math::cos(point.slope_angle);
    const double speed_scale = std::sqrt(problem_.gravity * chord_);
    if (limits.highest_normal_load) {
      watch("highest_normal_load", "m/s^2", +1, *limits.highest_normal_load,
            load_scale(*limits.highest_normal_load))
          .see(state.normal_load, s, friction_);
    }
    if (limits.lowest_normal_load) {
      watch("lowest_normal_load", "m/s^2", -1, *limits.lowest_normal_load,
            load_scale(*limits.lowest_normal_load))
          .see(state.normal_load, s, friction_);
    }
    if (limits.highest_curvature_load) {
      watch("highest_curvature_load", "m/s^2", +1, *limits.highest_curvature_load,
            load_scale(*limits.highest_curvature_load))
          .see(curvature_load, s, friction_);
    }
    if (limits.speed.highest)
      watch("speed.highest", "m/s", +1, *limits.speed.highest, speed_scale).see(state.speed, s, friction_);
    if (limits.speed.lowest && s >= limits.lowest_speed_from) {
      watch("speed.lowest", "m/s", -1, *limits.speed.lowest, speed_scale).see(state.speed, s, friction_);
    }
  }

  void at_exit_speed(double exit_speed, double end) {
    range("exit_speed", "m/s", problem_.limits.exit_speed, std::sqrt(problem_.gravity * chord_), exit_speed,
          end);
  }

  void at_end(const Centerline& track) {
    const Limits& limits = problem_.limits;
    const double end = track.length();
    const CenterlinePoint first = track.at(0.0);
    const CenterlinePoint last = track.at(end);
    range("entry_slope_angle", "rad", limits.entry_slope_angle, 1.0, first.slope_angle, 0.0);
    range("exit_slope_angle", "rad", limits.exit_slope_angle, 1.0, last.slope_angle, end);
    range("arc_length", "m", limits.arc_length, chord_, end, end);
    const double miss_run = last.x - std::fabs(problem_.endpoints.run);
    const double miss_drop = last.drop - problem_.endpoints.drop;
    double miss = 0.0;
    switch (problem_.finish.kind) {
      case FinishKind::point:
        miss = math::hypot(miss_run, miss_drop);
        break;
      case FinishKind::vertical_line:
        miss = std::fabs(miss_run);
        range("finish.drop", "m", problem_.finish.free_range, chord_, last.drop, end);
        break;
      case FinishKind::level:
        miss = std::fabs(miss_drop);
        range("finish.run", "m", problem_.finish.free_range, chord_, last.x, end);
        break;
    }
    watch("finish", "m", 0, 0.0, chord_).see(miss, end);
  }

  /// @param in,out  lengths of the straights that the track starts and ends with
  void at_leads(double in, double out, double length) {
    if (problem_.limits.lead_in > 0.0) least("lead_in", problem_.limits.lead_in, in, in);
    if (problem_.limits.lead_out > 0.0) least("lead_out", problem_.limits.lead_out, out, length - out);
  }

  /// How far the body comes at a friction that is not the nominal one.
  void at_arrival(const std::string& limit, double distance, double length) {
    watch(limit, "m", -1, length, chord_).see(distance, distance, friction_);
  }

  void near(std::size_t waypoint, double distance, double s) {
    watch(indexed("waypoints", waypoint), "m", 0, 0.0, chord_).see(distance, s);
  }

  [[nodiscard]] std::vector<Broken> broken() const {
    std::vector<Broken> result;
    for (const auto& [name, watch] : watches_) {
      result.insert(result.end(), watch.broken().begin(), watch.broken().end());
    }
    return result;
  }

  [[nodiscard]] std::vector<LimitCheck> checks() const {
    std::vector<LimitCheck> result;
    for (const auto& [name, watch] : watches_) {
      if (watch.seen()) result.push_back(watch.check());
    }
    return result;
  }

 private:
  [[nodiscard]] double load_scale(double bound) const { return std::max(problem_.gravity, std::fabs(bound)); }

  Watch& watch(const std::string& limit, const char* unit, int side, double bound, double scale) {
    const auto found = std::find_if(watches_.begin(), watches_.end(),
                                    [&](const auto& entry) { return entry.first == limit; });
    if (found != watches_.end()) return found->second;
    watches_.emplace_back(limit, Watch(limit, unit, side, bound, scale));
    return watches_.back().second;
  }
  void range(const std::string& limit, const char* unit, const Range& range, double scale, double value,
             double s) {
    if (range.lowest && range.highest && *range.lowest == *range.highest) {
      watch(limit, unit, 0, *range.lowest, scale).see(value, s, friction_);
      return;
    }
    if (range.lowest) watch(limit + ".lowest", unit, -1, *range.lowest, scale).see(value, s, friction_);
    if (range.highest) watch(limit + ".highest", unit, +1, *range.highest, scale).see(value, s, friction_);
  }
  void least(const std::string& limit, double bound, double value, double s) {
    watch(limit, "m", -1, bound, chord_).see(value, s);
  }
  void radius(const std::string& limit, double bound, double curvature, double s) {
    watch(limit, "m", -1, bound, bound).see(1.0 / curvature, s);
  }

  const Problem& problem_;
  double chord_;
  std::optional<FrictionLevel> friction_;
  std::vector<std::pair<std::string, Watch>> watches_;
};

double closest_approach(const Centerline& track, const std::vector<CenterlinePoint>& points, Vec2 target,
                        double& where) {
  std::size_t nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double distance = norm(Vec2{points[i].x, points[i].drop} - target);
    if (distance < least) {
      least = distance;
      nearest = i;
    }
  }
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

/// A friction that limits hold at, and what the check of arriving there is called; empty: the nominal one.
struct NamedFriction {
  Friction friction;
  std::optional<FrictionLevel> level;  ///< none where there is no range
  std::string arrival;
};

std::vector<NamedFriction> frictions_of(const Problem& problem) {
  using enum FrictionLevel;
  const bool ranges = problem.low_friction || problem.high_friction;
  std::vector<NamedFriction> frictions{
      {problem.body.friction, ranges ? std::optional(nominal) : std::nullopt, ""}};
  if (problem.low_friction) frictions.push_back({*problem.low_friction, low, "arrival_at_low_friction"});
  if (problem.high_friction) frictions.push_back({*problem.high_friction, high, "arrival_at_high_friction"});
  return frictions;
}

}  // namespace

const LimitCheck* Verdict::find(const std::string& limit) const {
  const auto found = std::find_if(checks.begin(), checks.end(),
                                  [&](const LimitCheck& check) { return check.limit == limit; });
  return found == checks.end() ? nullptr : &*found;
}

Verdict judge_track(const Problem& problem, const CenterlinePtr& track, int samples,
                    BrokenRides broken_rides) {
  const CenterlinePoint end = track->at(track->length());
  const double chord = math::hypot(end.x, end.drop);
  const std::vector<double> stations = sampled(*track, problem.limits, samples);
  std::vector<CenterlinePoint> points;
  points.reserve(stations.size());
  for (const double s : stations) points.push_back(track->at(s));

  Watches watches(problem, chord);
  for (const CenterlinePoint& point : points) watches.at_point(point);
  see_curvature(*track, samples, watches);
  const auto [lead_in, lead_out] = straight_ends(points);
  watches.at_leads(lead_in, lead_out, track->length());
  for (std::size_t i = 0; i < problem.limits.waypoints.size(); ++i) {
    double where = 0.0;
    const double distance = closest_approach(*track, points, problem.limits.waypoints[i], where);
    watches.near(i, distance, where);
  }

  Verdict verdict;
  verdict.arrived = true;
  for (const auto& [friction, level, arrival] : frictions_of(problem)) {
    watches.ride_at(level);
    Body body = problem.body;
    body.friction = friction;
    const Motion motion(track, body, problem.gravity);
    if (!arrival.empty()) watches.at_arrival(arrival, motion.distance(), track->length());
    if (!motion.arrived()) {
      verdict.arrived = false;
      if (motion.lift_off()) verdict.lift_off = motion.lift_off()->arc_length;
      if (motion.stall()) verdict.stall = motion.stall()->arc_length;
      if (broken_rides == BrokenRides::left_out) continue;
    }
    if (arrival.empty()) {
      verdict.travel_time = motion.travel_time();
      verdict.exit_speed = motion.exit_speed();
    }
    const auto ridden = std::upper_bound(stations.begin(), stations.end(), motion.distance());
    const std::vector<MotionState> states = motion.at({stations.begin(), ridden});
    for (std::size_t i = 0; i < states.size(); ++i) watches.at_state(states[i], points[i]);
    if (motion.arrived()) watches.at_exit_speed(motion.exit_speed(), track->length());
  }
  watches.ride_at({});
  watches.at_end(*track);
  verdict.checks = watches.checks();
  verdict.broken = watches.broken();
  for (const LimitCheck& check : verdict.checks) {
    verdict.worst = std::max(verdict.worst, check.violation / check.scale);
  }
  return verdict;
}

}  // namespace glissade::optimizer
