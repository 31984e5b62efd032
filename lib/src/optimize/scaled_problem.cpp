#include "optimize/scaled_problem.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace glissade::optimizer {
namespace {

/// Collects the limits of one problem.
class LimitList {
 public:
  explicit LimitList(std::vector<LimitSpec>& limits) : limits_(limits) {}

  void add(const std::string& key, const char* unit, Measure measure, const Range& range, double unit_si,
           double scale, std::size_t obstacle = 0) {
    if (range.lowest && range.highest && *range.lowest == *range.highest) {
      add_one(key, unit, measure, 0, *range.lowest, unit_si, scale, obstacle);
      return;
    }
    if (range.lowest) add_one(key + ".lowest", unit, measure, -1, *range.lowest, unit_si, scale, obstacle);
    if (range.highest) add_one(key + ".highest", unit, measure, +1, *range.highest, unit_si, scale, obstacle);
  }

  void add_one(const std::string& key, const char* unit, Measure measure, int side, double bound_si,
               double unit_si, double scale, std::size_t obstacle = 0) {
    LimitSpec limit;
    limit.key = key;
    limit.unit = unit;
    limit.measure = measure;
    limit.side = side;
    limit.bound_si = bound_si;
    limit.bound = bound_si / unit_si;
    limit.per_si = 1.0 / unit_si;
    limit.scale = scale;
    limit.obstacle = obstacle;
    limits_.push_back(limit);
  }

  void add_radius(const std::string& key, int side, double radius, double chord) {
    add_one(key, "m", Measure::curvature, side, radius, chord, 1.0);
    LimitSpec& limit = limits_.back();
    limit.bound = side * chord / radius;
    limit.per_si = chord / (radius * radius);
    limit.scale = chord / radius;
  }

 private:
  std::vector<LimitSpec>& limits_;
};

/// Upper (least drop) or lower chain of a polygon, ascending in run, where the track runs along the polygon.
std::vector<Vec2> chain(const std::vector<Vec2>& outline, bool upper) {
  std::vector<Vec2> points = outline;
  const double sign = upper ? 1.0 : -1.0;
  std::vector<double> runs;
  for (const Vec2& corner : points) runs.push_back(corner.x);
  std::sort(runs.begin(), runs.end());
  runs.erase(std::unique(runs.begin(), runs.end()), runs.end());
  std::vector<Vec2> result;
  for (const double run : runs) {
    double extreme = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vec2 a = points[i];
      const Vec2 b = points[(i + 1) % points.size()];
      if (std::min(a.x, b.x) > run || std::max(a.x, b.x) < run) continue;
      if (a.x == b.x) {
        extreme = std::min({extreme, sign * a.y, sign * b.y});
      } else {
        extreme = std::min(extreme, sign * (a.y + (b.y - a.y) * (run - a.x) / (b.x - a.x)));
      }
    }
    result.push_back({run, sign * extreme});
  }
  return result;
}

}  // namespace

ScaledProblem scaled(const Problem& problem, const Passages& passages) {
  const Limits& limits = problem.limits;
  ScaledProblem out;
  out.finish = problem.finish.kind;
  const double run = std::fabs(problem.endpoints.run);
  switch (problem.finish.kind) {
    case FinishKind::point:
      out.chord = math::hypot(run, problem.endpoints.drop);
      break;
    case FinishKind::vertical_line:
      out.chord = run;
      break;
    case FinishKind::level:
      out.chord = std::fabs(problem.endpoints.drop);
      break;
  }
  out.gravity = problem.gravity;
  out.time = std::sqrt(out.chord / problem.gravity);
  out.speed = std::sqrt(out.chord * problem.gravity);
  out.run = run / out.chord;
  out.drop = problem.endpoints.drop / out.chord;
  out.lead_in = limits.lead_in / out.chord;
  out.lead_out = limits.lead_out / out.chord;
  out.lowest_speed_from = limits.lowest_speed_from / out.chord;
  const double entry_speed = problem.body.entry_speed / out.speed;
  out.entry_speed2 = entry_speed * entry_speed;
  out.drag = problem.body.drag_per_metre * out.chord;

  std::vector<double> frictions{problem.body.friction.coefficient()};
  if (problem.low_friction) frictions.push_back(problem.low_friction->coefficient());
  if (problem.high_friction) frictions.push_back(problem.high_friction->coefficient());
  std::sort(frictions.begin(), frictions.end());
  frictions.erase(std::unique(frictions.begin(), frictions.end()), frictions.end());
  for (const double mu : frictions) out.rides.push_back({mu, out.entry_speed2, out.drag});
  const auto nominal = std::find(frictions.begin(), frictions.end(), problem.body.friction.coefficient());
  out.nominal_ride = static_cast<std::size_t>(nominal - frictions.begin());
  out.objective_ride = problem.objective.worst_case ? frictions.size() - 1 : out.nominal_ride;
  switch (problem.objective.kind) {
    case ObjectiveKind::travel_time:
      break;
    case ObjectiveKind::exit_speed:
      out.time_weight = 0.0;
      out.speed_weight = 1.0;
      break;
    case ObjectiveKind::blend:
      out.speed_weight = problem.objective.exit_speed_weight * out.speed / out.time;
      break;
  }

  LimitList list(out.limits);
  const double chord = out.chord;
  list.add("entry_slope_angle", "rad", Measure::entry_slope_angle, limits.entry_slope_angle, 1.0, 1.0);
  list.add("exit_slope_angle", "rad", Measure::exit_slope_angle, limits.exit_slope_angle, 1.0, 1.0);
  list.add("slope_angle", "rad", Measure::slope_angle, limits.slope_angle, 1.0, 1.0);
  if (limits.smallest_valley_radius) {
    list.add_radius("smallest_valley_radius", +1, *limits.smallest_valley_radius, chord);
  }
  if (limits.concave) {
    list.add_one("concave", "1/m", Measure::curvature, -1, 0.0, 1.0 / chord, 1.0);
  } else if (limits.smallest_crest_radius) {
    list.add_radius("smallest_crest_radius", -1, *limits.smallest_crest_radius, chord);
  }
  if (limits.highest_curvature_rate) {
    const double bound = *limits.highest_curvature_rate * chord * chord;
    list.add_one("highest_curvature_rate", "1/m^2", Measure::curvature_rate, +1,
                 *limits.highest_curvature_rate, 1.0 / (chord * chord), bound);
    list.add_one("highest_curvature_rate", "1/m^2", Measure::curvature_rate, -1,
                 *limits.highest_curvature_rate, 1.0 / (chord * chord), bound);
    out.limits.back().bound = -bound;
  }
  const auto load_scale = [&](double bound) { return std::max(1.0, std::fabs(bound) / problem.gravity); };
  if (limits.highest_normal_load) {
    list.add_one("highest_normal_load", "m/s^2", Measure::normal_load, +1, *limits.highest_normal_load,
                 problem.gravity, load_scale(*limits.highest_normal_load));
  }
  if (limits.lowest_normal_load) {
    list.add_one("lowest_normal_load", "m/s^2", Measure::normal_load, -1, *limits.lowest_normal_load,
                 problem.gravity, load_scale(*limits.lowest_normal_load));
  }
  if (limits.highest_curvature_load) {
    list.add_one("highest_curvature_load", "m/s^2", Measure::curvature_load, +1,
                 *limits.highest_curvature_load, problem.gravity, load_scale(*limits.highest_curvature_load));
  }
  list.add("speed", "m/s", Measure::speed, limits.speed, out.speed, 1.0);
  list.add("exit_speed", "m/s", Measure::exit_speed, limits.exit_speed, out.speed, 1.0);
  list.add("arc_length", "m", Measure::arc_length, limits.arc_length, chord, 1.0);
  if (problem.finish.kind != FinishKind::point) {
    list.add(problem.finish.kind == FinishKind::level ? "finish.run" : "finish.drop", "m",
             Measure::finish_coordinate, problem.finish.free_range, chord, 1.0);
  }

  const auto add_obstacle = [&](const std::string& key, Obstacle obstacle, double clearance) {
    for (Vec2& corner : obstacle.corners) corner = (1.0 / chord) * corner;
    list.add_one(key, "m", Measure::distance, -1, clearance, chord, 1.0, out.obstacles.size());
    out.obstacles.push_back(std::move(obstacle));
  };
  const auto indexed = [](const char* name, std::size_t i) { return name + ("[" + std::to_string(i) + "]"); };
  for (std::size_t i = 0; i < limits.half_planes.size(); ++i) {
    const HalfPlane& plane = limits.half_planes[i];
    Obstacle obstacle;
    obstacle.endless = true;
    obstacle.forbidden = (1.0 / norm(plane.forbidden)) * plane.forbidden;
    obstacle.corners = {plane.point};
    add_obstacle(indexed("half_planes", i), obstacle, plane.clearance);
  }
  for (std::size_t i = 0; i < limits.keep_outs.size(); ++i) {
    Obstacle obstacle;
    const bool above = passages[i] == Passage::above;
    obstacle.side = above ? 1.0 : -1.0;
    obstacle.corners = chain(limits.keep_outs[i].outline, above);
    add_obstacle(indexed("keep_outs", i), obstacle, limits.keep_outs[i].clearance);
  }
  for (std::size_t i = 0; i < limits.stay_above.size(); ++i) {
    Obstacle obstacle;
    obstacle.corners = limits.stay_above[i].line;
    add_obstacle(indexed("stay_above", i), obstacle, limits.stay_above[i].clearance);
  }
  for (std::size_t i = 0; i < limits.stay_below.size(); ++i) {
    Obstacle obstacle;
    obstacle.side = -1.0;
    obstacle.corners = limits.stay_below[i].line;
    add_obstacle(indexed("stay_below", i), obstacle, limits.stay_below[i].clearance);
  }
  for (std::size_t i = 0; i < limits.waypoints.size(); ++i) {
    list.add_one(indexed("waypoints", i), "m", Measure::waypoint, 0, 0.0, chord, 1.0, i);
    out.waypoints.push_back((1.0 / chord) * limits.waypoints[i]);
  }
  // Beyond the vertical a track would run backwards; the fastest one of all starts exactly vertical.
  const auto add_upright = [&](bool given, int side) {
    if (given) return;
    LimitSpec upright;
    upright.key = side > 0 ? "no steeper than vertical" : "no climb beyond the vertical";
    upright.unit = "rad";
    upright.measure = Measure::slope_angle;
    upright.side = side;
    upright.bound = side * 0.5 * std::numbers::pi;
    upright.bound_si = upright.bound;
    upright.built_in = true;
    out.limits.push_back(upright);
  };
  add_upright(limits.slope_angle.highest.has_value(), +1);
  add_upright(limits.slope_angle.lowest.has_value(), -1);
  const auto add_length = [&](int side, double bound) {
    LimitSpec length;
    length.key = side > 0 ? "no longer than 20 chords" : "no shorter than the chord";
    length.unit = "m";
    length.measure = Measure::arc_length;
    length.side = side;
    length.bound = bound;
    length.bound_si = bound * out.chord;
    length.per_si = 1.0 / out.chord;
    length.built_in = true;
    out.limits.push_back(length);
  };
  // No track is shorter than a chord; none that is worth building is many times longer.
  constexpr double kShortest = 0.9;
  constexpr double kLongest = 20.0;
  constexpr double kShortestCore = 0.05;
  add_length(-1, std::max(kShortest, out.lead_in + out.lead_out + kShortestCore));
  add_length(+1, kLongest);
  // A body that creeps at less than a millionth of free fall's squared speed is as good as lying still.
  constexpr double kCreep = 1e-6;
  LimitSpec arrival;
  arrival.key = "arrival at the finish";
  arrival.measure = Measure::arrival;
  arrival.side = -1;
  arrival.bound = kCreep;
  arrival.built_in = true;
  out.limits.push_back(arrival);
  return out;
}

namespace {

/// Collects every broken bound of an input.
class Checker {
 public:
  void require(bool holds, const std::string& what, const char* why, const char* hint = "") {
    if (!holds) issues_.push_back({"", what, why, hint});
  }
  void number(const char* name, double value, bool holds, const char* why) {
    require(std::isfinite(value) && holds, std::string(name) + ": " + exact_text(value), why);
  }
  void optional(const char* name, const std::optional<double>& value, bool (*holds)(double),
                const char* why) {
    if (value) number(name, *value, holds(*value), why);
  }
  void range(const char* name, const Range& range, bool (*holds)(double), const char* why) {
    optional(name, range.lowest, holds, why);
    optional(name, range.highest, holds, why);
    if (range.lowest && range.highest) {
      require(*range.lowest <= *range.highest,
              std::string(name) + ": lowest " + exact_text(*range.lowest) + " exceeds highest " +
                  exact_text(*range.highest),
              "a range needs lowest <= highest");
    }
  }
  void points(const std::string& name, const std::vector<Vec2>& points, std::size_t least) {
    require(points.size() >= least, name + ": " + std::to_string(points.size()) + " points",
            "too few points for its shape");
    for (const Vec2& point : points) {
      require(std::isfinite(point.x) && std::isfinite(point.y), name + ": a coordinate is not finite",
              "lengths are finite");
    }
  }
  void finish() {
    if (!issues_.empty()) throw InputError(std::move(issues_));
  }

 private:
  std::vector<Issue> issues_;
};

bool any(double) {
  return true;
}
bool positive(double value) {
  return value > 0.0;
}
bool not_negative(double value) {
  return value >= 0.0;
}
bool upright(double value) {
  return std::fabs(value) <= 0.5 * std::numbers::pi;
}

}  // namespace

void require_valid(const Problem& problem) {
  Checker check;
  const Limits& limits = problem.limits;
  const bool run_given = problem.finish.kind != FinishKind::level;
  const bool drop_given = problem.finish.kind != FinishKind::vertical_line;
  if (run_given) {
    check.number("endpoints.run", problem.endpoints.run, problem.endpoints.run != 0.0,
                 "a run of 0 is a fall straight down, which leaves nothing to optimise");
  }
  if (drop_given) {
    check.number("endpoints.drop", problem.endpoints.drop, true, "the drop is a finite length");
    check.require(problem.body.entry_speed > 0.0 || problem.endpoints.drop > 0.0,
                  "endpoints.drop: " + exact_text(problem.endpoints.drop) + " m",
                  "from rest the finish must lie below the start", "a positive drop, or an entry_speed");
  }
  if (problem.finish.kind == FinishKind::level) {
    check.require(problem.endpoints.drop != 0.0, "endpoints.drop: 0 m", "a level finish needs a drop");
  }
  check.number("gravity", problem.gravity, problem.gravity > 0.0, "gravity is positive");
  check.number("body.entry_speed", problem.body.entry_speed, problem.body.entry_speed >= 0.0,
               "a speed is not negative");
  check.number("body.drag_per_metre", problem.body.drag_per_metre, problem.body.drag_per_metre >= 0.0,
               "drag is not negative");
  if (problem.low_friction) {
    check.require(*problem.low_friction <= problem.body.friction, "low_friction exceeds the body's friction",
                  "a friction range needs low <= nominal <= high");
  }
  if (problem.high_friction) {
    check.require(*problem.high_friction >= problem.body.friction,
                  "high_friction is below the body's friction",
                  "a friction range needs low <= nominal <= high");
  }
  check.number("objective.exit_speed_weight", problem.objective.exit_speed_weight,
               problem.objective.exit_speed_weight >= 0.0, "a weight is not negative");
  constexpr const char* kUpright = "slope angles of an optimised track lie within -90 and 90 deg";
  check.range("entry_slope_angle", limits.entry_slope_angle, upright, kUpright);
  check.range("exit_slope_angle", limits.exit_slope_angle, upright, kUpright);
  check.range("slope_angle", limits.slope_angle, upright, kUpright);
  check.optional("smallest_valley_radius", limits.smallest_valley_radius, positive, "a radius is positive");
  check.optional("smallest_crest_radius", limits.smallest_crest_radius, positive, "a radius is positive");
  check.optional("highest_curvature_rate", limits.highest_curvature_rate, positive,
                 "a rate bound is positive");
  check.optional("highest_normal_load", limits.highest_normal_load, positive,
                 "the load of a straight is positive");
  check.optional("lowest_normal_load", limits.lowest_normal_load, not_negative,
                 "below 0 the body has left the track");
  check.require(limits.lowest_normal_load.has_value(), "lowest_normal_load is lifted",
                "friction of a body held from both sides is not modelled", "0 or a positive value");
  check.optional("highest_curvature_load", limits.highest_curvature_load, positive,
                 "a load bound is positive");
  check.range("speed", limits.speed, positive, "a speed bound is positive");
  check.range("exit_speed", limits.exit_speed, positive, "a speed bound is positive");
  check.number("lowest_speed_from", limits.lowest_speed_from, limits.lowest_speed_from >= 0.0,
               "an arc length is not negative");
  check.range("arc_length", limits.arc_length, positive, "an arc length is positive");
  check.range("finish.free_range", problem.finish.free_range, any, "a length is finite");
  check.number("lead_in", limits.lead_in, limits.lead_in >= 0.0, "a length is not negative");
  check.number("lead_out", limits.lead_out, limits.lead_out >= 0.0, "a length is not negative");
  for (const HalfPlane& plane : limits.half_planes) {
    check.require(norm(plane.forbidden) > 0.0 && std::isfinite(norm(plane.forbidden)) &&
                      std::isfinite(norm(plane.point)),
                  "half_planes: point or direction is not finite, or the direction has no length",
                  "a half-plane needs a direction");
    check.number("half_planes clearance", plane.clearance, plane.clearance >= 0.0,
                 "a clearance is not negative");
  }
  for (const KeepOut& keep_out : limits.keep_outs) {
    check.points("keep_outs outline", keep_out.outline, 3);
    check.number("keep_outs clearance", keep_out.clearance, keep_out.clearance >= 0.0,
                 "a clearance is not negative");
  }
  const auto check_profiles = [&](const char* name, const std::vector<Profile>& profiles) {
    for (const Profile& profile : profiles) {
      check.points(name, profile.line, 2);
      check.number(name, profile.clearance, profile.clearance >= 0.0, "a clearance is not negative");
      for (std::size_t i = 0; i + 1 < profile.line.size(); ++i) {
        check.require(profile.line[i].x < profile.line[i + 1].x,
                      std::string(name) + ": run " + exact_text(profile.line[i + 1].x) + " after " +
                          exact_text(profile.line[i].x),
                      "the runs of a profile ascend");
      }
    }
  };
  check_profiles("stay_above", limits.stay_above);
  check_profiles("stay_below", limits.stay_below);
  check.points("waypoints", limits.waypoints, 0);
  check.finish();
}

void require_valid(const OptimizeOptions& options) {
  Checker check;
  check.require(options.pieces >= 8 && options.pieces <= 200, "pieces: " + std::to_string(options.pieces),
                "8 <= pieces <= 200");
  check.number("tolerance", options.tolerance, options.tolerance >= 1e-12 && options.tolerance <= 1e-3,
               "1e-12 <= tolerance <= 1e-3");
  check.number("limit_tolerance", options.limit_tolerance,
               options.limit_tolerance >= 1e-10 && options.limit_tolerance <= 1e-4,
               "1e-10 <= limit_tolerance <= 1e-4");
  check.number("time_budget", options.time_budget, options.time_budget > 0.0, "a time budget is positive");
  check.finish();
}

Mesh mesh_of(const ScaledProblem& problem, Vector knots, double core_length) {
  Mesh mesh;
  mesh.knots = std::move(knots);
  mesh.lead_in = problem.lead_in;
  mesh.lead_out = problem.lead_out;
  mesh.core_length = core_length;
  mesh.entry_speed2 = problem.entry_speed2;
  return mesh;
}

}  // namespace glissade::optimizer
