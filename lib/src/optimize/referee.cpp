#include "optimize/referee.hpp"

#include "glissade/motion/motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace glissade::fastest {
namespace {

double distance_to_segment(Vec2 point, Vec2 from, Vec2 to) {
  const Vec2 along = to - from;
  const double share = std::clamp(dot(point - from, along) / dot(along, along), 0.0, 1.0);
  return norm(point - (from + share * along));
}

bool inside(Vec2 point, const std::vector<Vec2>& outline) {
  bool odd = false;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2 a = outline[i];
    const Vec2 b = outline[(i + 1) % outline.size()];
    if ((a.y > point.y) == (b.y > point.y)) continue;
    if (point.x < a.x + (b.x - a.x) * (point.y - a.y) / (b.y - a.y)) odd = !odd;
  }
  return odd;
}

double distance_to_polygon(Vec2 point, const std::vector<Vec2>& outline) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < outline.size(); ++i) {
    least = std::min(least, distance_to_segment(point, outline[i], outline[(i + 1) % outline.size()]));
  }
  return inside(point, outline) ? -least : least;
}

/// side +1: free above the line, -1: free below it
double distance_to_profile(Vec2 point, const std::vector<Vec2>& line, double side) {
  double least = std::numeric_limits<double>::infinity();
  bool behind = false;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Vec2 a = line[i];
    const Vec2 b = line[i + 1];
    least = std::min(least, distance_to_segment(point, a, b));
    if (point.x >= a.x && point.x <= b.x) {
      const double drop = a.y + (b.y - a.y) * (point.x - a.x) / (b.x - a.x);
      behind = behind || side * (point.y - drop) > 0.0;
    }
  }
  return behind ? -least : least;
}

/// Keeps the worst value of one limit while the track is sampled.
class Watch {
 public:
  Watch(std::string limit, const char* unit, int side, double bound, double scale)
      : check_{std::move(limit), bound, 0.0, 0.0, scale, 0.0, unit}, side_(side) {}

  void see(double value, double where) {
    const double excess = side_ == 0 ? std::fabs(value - check_.value) : side_ * (value - check_.value);
    if (seen_ && excess <= worst_) return;
    seen_ = true;
    worst_ = excess;
    check_.reached = value;
    check_.where = where;
    check_.violation = std::max(0.0, excess);
  }
  [[nodiscard]] bool seen() const { return seen_; }
  [[nodiscard]] const LimitCheck& check() const { return check_; }

 private:
  LimitCheck check_;
  int side_;
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
      least(indexed("keep_outs", i), keep_out.clearance, distance_to_polygon(place, keep_out.outline), s);
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

  void at_state(const MotionState& state, double curvature) {
    const Limits& limits = problem_.limits;
    const double s = state.arc_length;
    const double speed_scale = std::sqrt(problem_.gravity * chord_);
    if (limits.highest_normal_load) {
      watch("highest_normal_load", "m/s^2", +1, *limits.highest_normal_load,
            load_scale(*limits.highest_normal_load))
          .see(state.normal_load, s);
    }
    if (limits.lowest_normal_load) {
      watch("lowest_normal_load", "m/s^2", -1, *limits.lowest_normal_load,
            load_scale(*limits.lowest_normal_load))
          .see(state.normal_load, s);
    }
    if (limits.highest_curvature_load) {
      watch("highest_curvature_load", "m/s^2", +1, *limits.highest_curvature_load,
            load_scale(*limits.highest_curvature_load))
          .see(curvature * state.speed * state.speed, s);
    }
    if (limits.speed.highest)
      watch("speed.highest", "m/s", +1, *limits.speed.highest, speed_scale).see(state.speed, s);
    if (limits.speed.lowest && s >= limits.lowest_speed_from) {
      watch("speed.lowest", "m/s", -1, *limits.speed.lowest, speed_scale).see(state.speed, s);
    }
  }

  void at_end(const Centerline& track, double exit_speed) {
    const Limits& limits = problem_.limits;
    const double end = track.length();
    const double speed_scale = std::sqrt(problem_.gravity * chord_);
    const CenterlinePoint first = track.at(0.0);
    const CenterlinePoint last = track.at(end);
    range("entry_slope_angle", "rad", limits.entry_slope_angle, 1.0, first.slope_angle, 0.0);
    range("exit_slope_angle", "rad", limits.exit_slope_angle, 1.0, last.slope_angle, end);
    range("exit_speed", "m/s", limits.exit_speed, speed_scale, exit_speed, end);
    range("arc_length", "m", limits.arc_length, chord_, end, end);
    const double miss_run = last.x - std::fabs(problem_.endpoints.run);
    const double miss_drop = last.drop - problem_.endpoints.drop;
    double miss = 0.0;
    switch (problem_.finish.kind) {
      case FinishKind::point:
        miss = std::hypot(miss_run, miss_drop);
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

  void near(std::size_t waypoint, double distance, double s) {
    watch(indexed("waypoints", waypoint), "m", 0, 0.0, chord_).see(distance, s);
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
      watch(limit, unit, 0, *range.lowest, scale).see(value, s);
      return;
    }
    if (range.lowest) watch(limit + ".lowest", unit, -1, *range.lowest, scale).see(value, s);
    if (range.highest) watch(limit + ".highest", unit, +1, *range.highest, scale).see(value, s);
  }
  void least(const std::string& limit, double bound, double value, double s) {
    watch(limit, "m", -1, bound, chord_).see(value, s);
  }
  void radius(const std::string& limit, double bound, double curvature, double s) {
    watch(limit, "m", -1, bound, bound).see(1.0 / curvature, s);
  }

  const Problem& problem_;
  double chord_;
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
    const double along = (target.x - point.x) * std::cos(point.slope_angle) +
                         (target.y - point.drop) * std::sin(point.slope_angle);
    (along > 0.0 ? low : high) = middle;
  }
  where = 0.5 * (low + high);
  const CenterlinePoint point = track.at(where);
  return norm(Vec2{point.x, point.drop} - target);
}

}  // namespace

const LimitCheck* Verdict::find(const std::string& limit) const {
  const auto found = std::find_if(checks.begin(), checks.end(),
                                  [&](const LimitCheck& check) { return check.limit == limit; });
  return found == checks.end() ? nullptr : &*found;
}

Verdict judge_track(const Problem& problem, const CenterlinePtr& track, int samples) {
  const CenterlinePoint end = track->at(track->length());
  const double chord = std::hypot(end.x, end.drop);
  const std::vector<double> stations = sampled(*track, problem.limits, samples);
  std::vector<CenterlinePoint> points;
  points.reserve(stations.size());
  for (const double s : stations) points.push_back(track->at(s));

  Watches watches(problem, chord);
  for (const CenterlinePoint& point : points) watches.at_point(point);
  const auto& segments = dynamic_cast<const ClothoidSpline&>(*track).segments();
  double s = 0.0;
  for (const ClothoidSegment& segment : segments) {
    watches.at_curvature(s, segment.entry_curvature);
    watches.at_rate(s, (segment.exit_curvature - segment.entry_curvature) / segment.length);
    s += segment.length;
    watches.at_curvature(s, segment.exit_curvature);
  }
  for (std::size_t i = 0; i < problem.limits.waypoints.size(); ++i) {
    double where = 0.0;
    const double distance = closest_approach(*track, points, problem.limits.waypoints[i], where);
    watches.near(i, distance, where);
  }

  Verdict verdict;
  verdict.arrived = true;
  std::vector<Friction> frictions{problem.body.friction};
  if (problem.low_friction) frictions.push_back(*problem.low_friction);
  if (problem.high_friction) frictions.push_back(*problem.high_friction);
  for (const Friction friction : frictions) {
    Body body = problem.body;
    body.friction = friction;
    const Motion motion(track, body, problem.gravity);
    if (!motion.arrived()) {
      verdict.arrived = false;
      if (motion.lift_off()) verdict.lift_off = motion.lift_off()->arc_length;
      continue;
    }
    if (friction == problem.body.friction) {
      verdict.travel_time = motion.travel_time();
      verdict.exit_speed = motion.exit_speed();
    }
    const std::vector<MotionState> states = motion.at(stations);
    for (std::size_t i = 0; i < states.size(); ++i) watches.at_state(states[i], points[i].curvature);
    watches.at_end(*track, motion.exit_speed());
  }
  verdict.checks = watches.checks();
  for (const LimitCheck& check : verdict.checks) {
    verdict.worst = std::max(verdict.worst, check.violation / check.scale);
  }
  return verdict;
}

}  // namespace glissade::fastest
