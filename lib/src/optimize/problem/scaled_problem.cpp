#include "optimize/problem/scaled_problem.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/units.hpp"
#include "glissade/motion/laws/bulk_stream.hpp"
#include "glissade/task/limit_catalogue.hpp"

#include "optimize/problem/change_knots.hpp"
#include "optimize/problem/feet.hpp"
#include "optimize/problem/touchable_line.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

namespace glissade::optimizer {
namespace {

/// +1: at most, -1: at least, 0: exactly.
int side_of(Bound bound) {
  return bound == Bound::highest ? 1 : bound == Bound::lowest ? -1 : 0;
}

void set_normals(Obstacle& obstacle) {
  obstacle.normals.clear();
  for (std::size_t i = 0; i + 1 < obstacle.corners.size(); ++i)
    obstacle.normals.push_back(edge_normal(obstacle.corners[i], obstacle.corners[i + 1], obstacle.side));
}

/// What an area's outline has beside its chain.
void add_others(Obstacle& obstacle) {
  const std::vector<Vec2>& outline = obstacle.outline;
  const std::vector<Vec2>& chain = obstacle.corners;
  double area = 0.0;
  for (std::size_t i = 0; i < outline.size(); ++i)
    area += cross(outline[i], outline[(i + 1) % outline.size()]);
  const auto in_chain = [&](Vec2 a, Vec2 b) {
    for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
      if ((chain[i] == a && chain[i + 1] == b) || (chain[i] == b && chain[i + 1] == a)) return true;
    }
    return false;
  };
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2 a = outline[i];
    const Vec2 b = outline[(i + 1) % outline.size()];
    if (!in_chain(a, b)) obstacle.other_sides.push_back(area > 0.0 ? std::pair(a, b) : std::pair(b, a));
    if (std::find(chain.begin(), chain.end(), a) == chain.end()) obstacle.other_corners.push_back(a);
  }
}

/// Collects the limits of one problem, scaled.
class LimitList {
 public:
  LimitList(const Problem& problem, ScaledProblem& out) : problem_(problem), out_(out) {}

  /// Every limit of the catalogue that is a number, in its order.
  void add_numbers() {
    for (const LimitEntry& entry : limit_catalogue()) {
      const Limits& limits = problem_.limits;
      if (entry.range != nullptr) add_range(entry, range_of(entry, limits));
      if (entry.id == LimitId::concave && limits.concave) add({entry.id, entry.bound}, 0.0);
      if (entry.value != nullptr && limits.*entry.value) add_value(entry, *(limits.*entry.value));
    }
    if (problem_.limits.match_belt) add_match(*problem_.limits.match_belt);
    const Finish& finish = problem_.finish;
    if (!fixes_run(finish.kind)) add_range(entry_of(LimitId::finish_run), finish.free_range);
    if (fixes_drop(finish.kind)) return;
    const bool both = finish.kind == FinishKind::anywhere;
    add_range(entry_of(LimitId::finish_drop), both ? finish.free_drop : finish.free_range);
  }

  LimitSpec& add(const LimitName& name, double bound_si) {
    LimitSpec limit;
    limit.name = name;
    limit.measure = measure_of(name.id);
    limit.side = side_of(name.bound);
    limit.bound_si = bound_si;
    limit.bound = bound_si / unit(name.dimension());
    limit.per_si = 1.0 / unit(name.dimension());
    limit.scale = scale(name.dimension(), limit.bound);
    return out_.limits.emplace_back(limit);
  }

  void add_obstacle(const LimitName& name, Obstacle obstacle, double clearance) {
    for (Vec2& corner : obstacle.corners) corner = (1.0 / out_.chord) * corner;
    for (Vec2& corner : obstacle.outline) corner = (1.0 / out_.chord) * corner;
    if (!obstacle.outline.empty()) add_others(obstacle);
    set_normals(obstacle);
    LimitSpec& limit = add(name, clearance);
    limit.measure = Measure::distance;
    limit.obstacle = out_.obstacles.size();
    out_.obstacles.push_back(std::move(obstacle));
  }

  void add_waypoint(std::size_t index) {
    LimitSpec& limit = add({LimitId::waypoints, Bound::exactly, index}, 0.0);
    limit.measure = Measure::waypoint;
    limit.obstacle = index;
    out_.waypoints.push_back((1.0 / out_.chord) * problem_.limits.waypoints[index]);
  }

  /// A stream keeps faster than where it is as deep as its wall is high, or as its channel is wide.
  void add_no_choking() {
    const BulkStream* const stream = stream_of_problem();
    if (stream == nullptr) return;
    const LimitName name{LimitId::no_choking, Bound::highest};
    const double flow = stream->depth(0.0, 1.0) * stream->width(0.0);
    const auto add_side = [&](double deepest, int power) {
      add_lowest_speed(name, flow / (stream->width(0.0) * deepest));
      out_.limits.back().built_in = true;
      out_.limits.back().width_power = power;
    };
    if (stream->shape().wall_height) add_side(*stream->shape().wall_height, 2);
    add_side(stream->width(0.0), 4);
  }

  /// What holds without being asked for.
  void add_built_in(LimitId id, const Measure* measure, double bound) {
    LimitSpec limit;
    limit.name = {id, entry_of(id).bound};
    limit.measure = measure;
    limit.side = side_of(limit.name.bound);
    limit.bound = bound;
    limit.per_si = 1.0 / unit(limit.name.dimension());
    limit.bound_si = bound * unit(limit.name.dimension());
    limit.built_in = true;
    out_.limits.push_back(limit);
  }

 private:
  void add_range(const LimitEntry& entry, const Range& range) {
    if (range.is_fixed() && entry.fixable) {
      add({entry.id, Bound::exactly}, *range.lowest);
      return;
    }
    if (range.lowest) add({entry.id, Bound::lowest}, *range.lowest);
    if (range.highest) add({entry.id, Bound::highest}, *range.highest);
  }

  void add_value(const LimitEntry& entry, double value) {
    const LimitName name{entry.id, entry.bound};
    if (name.is_radius()) {
      // No crest at all leaves none to have a radius.
      if (entry.id == LimitId::smallest_valley_radius || !problem_.limits.concave) add_radius(name, value);
      return;
    }
    if (entry.id == LimitId::highest_burden_depth) return add_depth(name, value);
    if (entry.id == LimitId::highest_floor_wear) return add_wear(name, value);
    if (entry.id == LimitId::lowest_slope_margin) return add_slope_margin(name, value);
    add(name, value);
    if (entry.id != LimitId::highest_curvature_rate) return;
    // The rate is limited both ways.
    const double rate = value * out_.chord * out_.chord;
    const double scale = std::max(rate, kLeastRateScale);
    out_.limits.back().scale = scale;
    LimitSpec& other = add(name, value);
    other.side = -1;
    other.bound = -rate;
    other.scale = scale;
  }

  void add_match(const BeltMatch& match) {
    const double seen = math::cos(match.direction.radians());
    for (const Bound bound : {Bound::lowest, Bound::highest}) {
      const double side = bound == Bound::highest ? 1.0 : -1.0;
      LimitSpec& limit = add({LimitId::match_belt, bound}, match.speed * (1.0 + side * match.within));
      limit.bound /= seen;
      limit.per_si /= seen;
      limit.scale = 1.0;
    }
  }

  /// H <= depth is u B(s) >= Q/(rho depth): a lowest speed.
  void add_depth(const LimitName& name, double depth) {
    const BulkStream* const stream = stream_of_problem();
    if (stream == nullptr) return;
    add_lowest_speed(name, stream->depth(0.0, 1.0) / depth);
    out_.limits.back().bound_si = depth;
    out_.limits.back().per_si = out_.limits.back().bound / depth;
    out_.limits.back().width_power = 2;
  }

  /// mu N/B(s) <= wear/(Q K_c): a highest load, on each ride its own.
  void add_wear(const LimitName& name, double wear) {
    const BulkStream* const stream = stream_of_problem();
    if (stream == nullptr) return;
    for (std::size_t ride = 0; ride < out_.rides.size(); ++ride) {
      for (std::size_t zone = 0; zone <= out_.changes.size(); ++zone) {
        const Friction friction = Friction::from_coefficient(out_.rides[ride].friction_in(zone));
        const double per_load = stream->floor_wear(0.0, friction, 1.0);
        if (!(per_load > 0.0)) continue;
        LimitSpec& limit = add_in(zone, name, wear);
        limit.side = 1;
        limit.ride = ride;
        limit.bound = wear / (per_load * problem_.gravity);
        limit.per_si = limit.bound / wear;
        limit.scale = limit.bound;
        limit.width_power = -1;
      }
    }
  }

  /// zeta >= atan(mu) + margin at the highest friction.
  void add_slope_margin(const LimitName& name, double margin) {
    for (std::size_t zone = 0; zone <= out_.changes.size(); ++zone) {
      LimitSpec& limit = add_in(zone, name, margin);
      limit.bound += math::atan(out_.rides.back().friction_in(zone));
    }
  }

  /// Held where the track has one of its frictions.
  LimitSpec& add_in(std::size_t zone, const LimitName& name, double bound_si) {
    LimitSpec& limit = add(name, bound_si);
    if (!out_.changes.empty()) limit.zone = zone;
    return limit;
  }

  void add_lowest_speed(const LimitName& name, double speed) {
    LimitSpec& limit = add(name, 1.0);
    limit.side = -1;
    limit.bound = speed / out_.speed;
    limit.scale = 1.0;
  }

  [[nodiscard]] const BulkStream* stream_of_problem() const {
    return dynamic_cast<const BulkStream*>(problem_.body.law.get());
  }

  void add_radius(const LimitName& name, double radius) {
    LimitSpec& limit = add(name, radius);
    limit.side = name.id == LimitId::smallest_valley_radius ? 1 : -1;
    limit.bound = limit.side * out_.chord / radius;
    limit.per_si = out_.chord / (radius * radius);
    limit.scale = out_.chord / radius;
  }

  /// One unit of the scaled problem [SI].
  [[nodiscard]] double unit(Dimension dimension) const {
    switch (dimension) {
      case Dimension::length:
        return out_.chord;
      case Dimension::speed:
        return out_.speed;
      case Dimension::acceleration:
        return problem_.gravity;
      case Dimension::per_length:
        return 1.0 / out_.chord;
      case Dimension::per_area:
        return 1.0 / (out_.chord * out_.chord);
      default:
        return 1.0;
    }
  }

  /// What a violation is measured against.
  [[nodiscard]] static double scale(Dimension dimension, double bound) {
    return dimension == Dimension::acceleration ? std::max(1.0, std::fabs(bound)) : 1.0;
  }

  const Problem& problem_;
  ScaledProblem& out_;
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

/// A line's corners; of many without those that no track touches which keeps the limits on radii.
TouchableLine worth_holding(const Problem& problem, const Profile& profile, double side) {
  constexpr std::size_t kFew = 64;         // budget: so many cost next to nothing
  constexpr double kSharper = 1.0 - 1e-3;  // taste: what rounding and tolerances may take of a radius
  constexpr double kStraight = 1e3;        // runs; taste: the radius of what has no bend to that side
  const Limits& limits = problem.limits;
  const Envelope& envelope = limits.envelope;
  const double run = std::fabs(problem.endpoints.run);
  std::optional<double> radius = side > 0.0 ? limits.smallest_valley_radius : limits.smallest_crest_radius;
  if (side < 0.0 && limits.concave) radius = kStraight * run;
  const double reach = profile.clearance + envelope.below + envelope.top();
  const bool applies = profile.line.size() > kFew && radius && problem.finish.kind == FinishKind::point;
  // Normals that reach beyond a centre of curvature lead to places that no bend of the track tells.
  if (!applies || !(*radius > reach)) return {profile.line, {}};
  const double start = problem.places_from == PlacesFrom::start ? 0.0 : -run;
  return touchable(profile.line, {side, kSharper * *radius, start + reach, start + run - reach});
}

void add_obstacles(const Problem& problem, const Passages& passages, LimitList& list) {
  const Limits& limits = problem.limits;
  for (std::size_t i = 0; i < limits.half_planes.size(); ++i) {
    const HalfPlane& plane = limits.half_planes[i];
    Obstacle obstacle;
    obstacle.endless = true;
    obstacle.forbidden = (1.0 / norm(plane.forbidden)) * plane.forbidden;
    obstacle.corners = {plane.point};
    list.add_obstacle({LimitId::half_planes, Bound::lowest, i}, obstacle, plane.clearance);
  }
  for (std::size_t i = 0; i < limits.keep_outs.size(); ++i) {
    Obstacle obstacle;
    const bool above = passages[i] == Passage::above;
    obstacle.side = above ? 1.0 : -1.0;
    obstacle.corners = chain(limits.keep_outs[i].outline, above);
    obstacle.outline = limits.keep_outs[i].outline;
    list.add_obstacle({LimitId::keep_outs, Bound::lowest, i}, obstacle, limits.keep_outs[i].clearance);
  }
  const auto add_line = [&](LimitId id, std::size_t index, const Profile& profile, double side) {
    TouchableLine line = worth_holding(problem, profile, side);
    Obstacle obstacle;
    obstacle.side = side;
    obstacle.corners = std::move(line.corners);
    obstacle.out_of_reach = std::move(line.out_of_reach);
    list.add_obstacle({id, Bound::lowest, index}, std::move(obstacle), profile.clearance);
  };
  for (std::size_t i = 0; i < limits.stay_above.size(); ++i)
    add_line(LimitId::stay_above, i, limits.stay_above[i], 1.0);
  for (std::size_t i = 0; i < limits.stay_below.size(); ++i)
    add_line(LimitId::stay_below, i, limits.stay_below[i], -1.0);
}

Ride scaled_ride(const Body& body, double friction, const ScaledProblem& units) {
  Ride ride;
  ride.friction = friction;
  ride.entry_speed2 = units.entry_speed2;
  ride.drag = units.drag;
  // Without drag there is no air to feel.
  if (units.drag > 0.0) ride.head_wind = body.head_wind / units.speed;
  Body at_friction = body;
  at_friction.friction = Friction::from_coefficient(friction);
  if (const auto landing = landing_of(at_friction))
    ride.landing = Landing{landing->speed / units.speed, landing->angle};
  if (!body.law) return ride;
  ride.gain = 2.0 / body.law->inertia();
  ride.height = body.law->centre_height() / units.chord;
  if (body.law->depends_on_speed()) ride.law = body.law->in_units(units.chord, units.speed);
  return ride;
}

/// Where friction changes, in truth, at any friction of the range.
void add_changes(const Body& body, ScaledProblem& out) {
  for (const FrictionChange& change : body.friction_changes) {
    const double mu = change.friction.coefficient();
    const std::size_t zone = out.changes.size();
    const bool same = std::all_of(out.rides.begin(), out.rides.end(),
                                  [&](const Ride& ride) { return ride.friction_in(zone) == mu; });
    if (same) continue;
    out.changes.push_back(change.from / out.chord);
    for (Ride& ride : out.rides) ride.later_frictions.push_back(mu);
  }
}

/// How far from the start the bounds of a free finish lie [m]; 0 where it is given, or has none.
double farthest_finish(const Problem& problem) {
  const auto farthest = [](const Range& range) {
    return std::max(std::fabs(range.lowest.value_or(0.0)), std::fabs(range.highest.value_or(0.0)));
  };
  const Finish& finish = problem.finish;
  switch (finish.kind) {
    case FinishKind::point:
      return 0.0;
    case FinishKind::vertical_line:
      return math::hypot(problem.endpoints.run, farthest(finish.free_range));
    case FinishKind::level:
      return math::hypot(farthest(finish.free_range), problem.endpoints.drop);
    case FinishKind::anywhere:
      return math::hypot(farthest(finish.free_range), farthest(finish.free_drop));
  }
  return 0.0;
}

/// How long a track may be, in chords. @param farthest  that its finish may lie away, in chords
double most_chords(double farthest) {
  constexpr double kUsual = 20.0;     // taste
  constexpr double kDetour = 1.5;     // taste: of the way to the farthest finish
  constexpr double kSearched = 90.0;  // accuracy: below what a transcription tells from no track at all
  return std::min(std::max(kUsual, kDetour * farthest), kSearched);
}

void add_limits(const Problem& problem, const Passages& passages, ScaledProblem& out) {
  const Limits& limits = problem.limits;
  LimitList list(problem, out);
  list.add_numbers();
  add_obstacles(problem, passages, list);
  for (std::size_t i = 0; i < limits.waypoints.size(); ++i) list.add_waypoint(i);
  // Beyond the vertical a track would run backwards; the fastest one of all starts exactly vertical.
  if (!limits.slope_angle.highest) {
    list.add_built_in(LimitId::no_steeper_than_vertical, Measure::slope_angle, kRightAngle);
  }
  if (!limits.slope_angle.lowest) {
    list.add_built_in(LimitId::no_climb_beyond_vertical, Measure::slope_angle, -kRightAngle);
  }
  // In a valley hardly wider than the body is high its centre hardly moves and is pressed without bound: a ball
  // would roll up the tightest bend there is to touch the finish. Unless a radius is asked for, it is at least
  // twice the height.
  constexpr double kFits = 0.98;     // theory: below 1
  constexpr double kFitsWell = 0.5;  // taste
  const double height = out.rides.front().height;
  if (height > 0.0) {
    list.add_built_in(LimitId::room_for_body, Measure::curvature,
                      (limits.smallest_valley_radius ? kFits : kFitsWell) / height);
    out.limits.back().scale = out.limits.back().bound;
  }
  // No track is shorter than a chord; none that is worth building is many times longer, but where its finish may lie so far.
  constexpr double kShortest = 0.9;  // theory: below 1
  list.add_built_in(LimitId::not_shorter_than_chord, Measure::arc_length,
                    std::max(kShortest, out.lead_in + out.lead_out + 2.0 * kShortestCore));
  list.add_built_in(LimitId::not_many_chords_long, Measure::arc_length,
                    most_chords(farthest_finish(problem) / out.chord));
  list.add_built_in(LimitId::arrival, Measure::arrival, kCreep);
  list.add_no_choking();
  // A stream flatter than the floor flies on over it.
  std::optional<Angle> flattest;
  for (const Ride& ride : out.rides) {
    if (ride.landing) flattest = std::min(flattest.value_or(ride.landing->angle), ride.landing->angle);
  }
  if (flattest) list.add_built_in(LimitId::landing, Measure::entry_slope_angle, flattest->radians());
}

}  // namespace

namespace {

/// How near to the start a free coordinate of the finish may come [m].
double nearest(const Range& range) {
  double value = 0.0;
  if (range.lowest) value = std::max(value, *range.lowest);
  if (range.highest) value = std::min(value, *range.highest);
  return value;
}

/// The drop of free fall to the speed that is to be reached [m]. No track has less of it, but where a wind blows the body on.
double fall_to_lowest_speed(const Problem& problem) {
  const double speed = problem.limits.exit_speed.lowest.value_or(0.0);
  const double entry = problem.body.entry_speed;
  return std::max(0.0, (speed * speed - entry * entry) / (2.0 * problem.gravity));
}

/// The length that the problem is scaled by [m]: no track that meets the finish is shorter.
double chord_of(const Problem& problem) {
  const double run = std::fabs(problem.endpoints.run);
  const double drop = problem.endpoints.drop;
  const Finish& finish = problem.finish;
  const double fall = is_driven_by_wind(problem.body) ? 0.0 : fall_to_lowest_speed(problem);
  switch (finish.kind) {
    case FinishKind::point:
      break;
    case FinishKind::vertical_line:
      return math::hypot(run, std::max(fall, nearest(finish.free_range)));
    case FinishKind::level:
      return math::hypot(nearest(finish.free_range), drop);
    case FinishKind::anywhere: {
      const double away = math::hypot(nearest(finish.free_range), std::max(fall, nearest(finish.free_drop)));
      // Next to the start nothing else tells of a size.
      return away > 0.0 ? away : fall_to_lowest_speed(problem);
    }
  }
  return math::hypot(run, drop);
}

void set_objective(const Objective& objective, double entry_speed, ScaledProblem& out) {
  switch (objective.kind) {
    case ObjectiveKind::travel_time:
    // What is searched for within a bound just above the least (least_peak.cpp).
    case ObjectiveKind::least_peak_wear:
      break;
    case ObjectiveKind::even_speed:
      for (Ride& ride : out.rides) ride.even_speed = entry_speed;
      break;
    case ObjectiveKind::least_wear:
      out.time_weight = 0.0;
      out.speed_weight = 1.0;
      out.tilt = out.rides.front().gain * out.rides.front().height;
      break;
    case ObjectiveKind::exit_speed:
    // Of a least bound this is what is searched for at each bound that is tried (least_bound.cpp).
    case ObjectiveKind::least_load:
    case ObjectiveKind::least_curvature_rate:
      out.time_weight = 0.0;
      out.speed_weight = 1.0;
      break;
    case ObjectiveKind::least_drop:
      out.time_weight = 0.0;
      out.drop_weight = 1.0;
      break;
    case ObjectiveKind::least_length:
      out.time_weight = 0.0;
      out.length_weight = 1.0;
      break;
    case ObjectiveKind::blend:
      out.speed_weight = objective.exit_speed_weight * out.speed / out.time;
      break;
  }
}

/// How many bits of a number are kept.
class Rounding {
 public:
  explicit Rounding(int bits) : bits_(bits) {}

  /// A place, in chords: so many bits of the unit.
  void place(double& value) const {
    const double steps = std::ldexp(1.0, bits_);
    value = std::round(value * steps) / steps;
  }
  void place(Vec2& point) const {
    place(point.x);
    place(point.y);
  }
  /// So many bits of its own.
  void number(double& value) const {
    int exponent = 0;
    const double mantissa = std::frexp(value, &exponent);
    value = std::ldexp(std::round(std::ldexp(mantissa, bits_)), exponent - bits_);
  }

 private:
  int bits_;
};

/// The same problem of another size or at another height differs by the rounding of its numbers, and a search may end in
/// another valley for it. Here such problems become the same, nearly always. Angles and friction do not scale and keep all
/// their digits.
void round_off(const Rounding& rounding, ScaledProblem& out) {
  for (double* place : {&out.run, &out.drop, &out.lead_in, &out.lead_out, &out.lowest_speed_from,
                        &out.envelope_low, &out.envelope_high, &out.headroom}) {
    rounding.place(*place);
  }
  for (Obstacle& obstacle : out.obstacles) {
    for (std::vector<Vec2>* line : {&obstacle.corners, &obstacle.outline, &obstacle.other_corners}) {
      for (Vec2& corner : *line) rounding.place(corner);
    }
    for (auto& [from, to] : obstacle.other_sides) {
      rounding.place(from);
      rounding.place(to);
    }
    set_normals(obstacle);
  }
  for (Vec2& waypoint : out.waypoints) rounding.place(waypoint);
  for (double& change : out.changes) rounding.place(change);
  for (LimitSpec& limit : out.limits) {
    if (limit.built_in || limit.name.dimension() == Dimension::angle) continue;
    rounding.number(limit.bound);
    rounding.number(limit.scale);
  }
  rounding.number(out.entry_speed2);
  rounding.number(out.drag);
  for (Ride& ride : out.rides) {
    for (double* number : {&ride.entry_speed2, &ride.drag, &ride.head_wind, &ride.even_speed}) {
      rounding.number(*number);
    }
  }
}

}  // namespace

ScaledProblem scaled(const Problem& problem, const Passages& passages) {
  constexpr int kBits = 40;  // accuracy: what a number may lose, 5e-13, is below all that is promised
  const Limits& limits = problem.limits;
  ScaledProblem out;
  out.finish = problem.finish.kind;
  out.places_from = problem.places_from;
  const double run = std::fabs(problem.endpoints.run);
  out.chord = chord_of(problem);
  out.gravity = problem.gravity;
  out.time = std::sqrt(out.chord / problem.gravity);
  out.speed = std::sqrt(out.chord * problem.gravity);
  out.run = run / out.chord;
  out.drop = problem.endpoints.drop / out.chord;
  out.fall = fall_to_lowest_speed(problem) / out.chord;
  out.lead_in = limits.lead_in / out.chord;
  out.lead_out = limits.lead_out / out.chord;
  out.lowest_speed_from = limits.lowest_speed_from / out.chord;
  const double entry_speed = problem.body.entry_speed / out.speed;
  out.entry_speed2 = entry_speed * entry_speed;
  out.drag = problem.body.drag_per_metre * out.chord;

  std::vector<double> frictions{problem.body.friction.coefficient()};
  if (problem.low_friction) frictions.push_back(problem.low_friction->coefficient());
  if (problem.high_friction) frictions.push_back(problem.high_friction->coefficient());
  for (const Friction& friction : problem.further_frictions) frictions.push_back(friction.coefficient());
  std::sort(frictions.begin(), frictions.end());
  frictions.erase(std::unique(frictions.begin(), frictions.end()), frictions.end());
  for (const double mu : frictions) out.rides.push_back(scaled_ride(problem.body, mu, out));
  add_changes(problem.body, out);
  const auto nominal = std::find(frictions.begin(), frictions.end(), problem.body.friction.coefficient());
  out.nominal_ride = static_cast<std::size_t>(nominal - frictions.begin());
  out.objective_ride = problem.objective.worst_case ? frictions.size() - 1 : out.nominal_ride;
  set_objective(problem.objective, entry_speed, out);

  out.envelope_low = -limits.envelope.below / out.chord;
  out.envelope_high = limits.envelope.top() / out.chord;
  out.headroom = limits.envelope.headroom / out.chord;
  add_limits(problem, passages, out);
  round_off(Rounding(kBits), out);
  return out;
}

namespace {

/// Whether limits leave hardly any track but the straight line: which one that is the last digits tell.
bool is_all_but_straight(const ScaledProblem& problem) {
  constexpr double kHair = 1e-6;  // accuracy: a hundred times what rounding to 1e-8 takes
  if (problem.finish != FinishKind::point) return false;
  const double mean_slope = math::atan2(problem.drop, problem.run);
  const double chord = math::hypot(problem.run, problem.drop);
  return std::any_of(problem.limits.begin(), problem.limits.end(), [&](const LimitSpec& limit) {
    if (limit.measure == Measure::slope_angle) return std::fabs(limit.bound - mean_slope) < kHair;
    return limit.measure == Measure::arc_length && limit.side >= 0 && std::fabs(limit.bound - chord) < kHair;
  });
}

}  // namespace

ScaledProblem roughly_scaled(const Problem& problem, const Passages& passages) {
  constexpr int kBits = 26;  // accuracy: 1e-8, of a limit's own
  ScaledProblem out = scaled(problem, passages);
  // Meshes are laid by the places where friction changes, to the last digit.
  if (out.changes.empty() && !is_all_but_straight(out)) round_off(Rounding(kBits), out);
  return out;
}

void require_valid(const OptimizeOptions& options) {
  std::vector<Issue> issues;
  const auto require = [&](bool holds, const std::string& what, const char* why) {
    if (!holds) issues.push_back({"", what, why, ""});
  };
  const auto number = [&](const char* name, double value, bool holds, const char* why) {
    require(std::isfinite(value) && holds, std::string(name) + ": " + exact_text(value), why);
  };
  require(options.pieces >= 8 && options.pieces <= 200, "pieces: " + std::to_string(options.pieces),
          "8 <= pieces <= 200");
  number("tolerance", options.tolerance, options.tolerance >= 1e-12 && options.tolerance <= 1e-3,
         "1e-12 <= tolerance <= 1e-3");
  number("limit_tolerance", options.limit_tolerance,
         options.limit_tolerance >= 1e-10 && options.limit_tolerance <= 1e-4,
         "1e-10 <= limit_tolerance <= 1e-4");
  number("time_budget", options.time_budget, options.time_budget > 0.0,
         "a time budget is positive and finite");
  if (!issues.empty()) throw InputError(std::move(issues));
}

void require_searchable(const Problem& problem) {
  require_valid(problem);
  if (problem.body.law && problem.body.law->side() < 0.0) {
    throw InputError({"", "body.law: a stream below a hood", "A search is for the track that a body lies on.",
                      "the track below, with the hood as its approach"});
  }
  if (problem.limits.lowest_normal_load) return;
  throw InputError(
      {"", "lowest_normal_load is lifted",
       "No track is searched for a body held from both sides: its friction turns round where its load does.",
       "0 or a positive value; any other kind of track is ridden by such a body"});
}

void require_passable_in_order(const Problem& problem) {
  const Limits& limits = problem.limits;
  const bool runs_back = limits.slope_angle.highest.value_or(kRightAngle) > kRightAngle ||
                         limits.slope_angle.lowest.value_or(-kRightAngle) < -kRightAngle;
  if (runs_back) return;
  std::vector<Issue> issues;
  for (std::size_t i = 0; i + 1 < limits.waypoints.size(); ++i) {
    const double now = limits.waypoints[i].x;
    const double next = limits.waypoints[i + 1].x;
    if (!(next < now)) continue;
    issues.push_back(
        {"",
         "waypoints[" + std::to_string(i + 1) + "]: " + length_text(next) +
             " along the run lies before waypoints[" + std::to_string(i) + "], " + length_text(now),
         "A track passes its waypoints in their order, and none that keeps within the vertical runs back.",
         "the waypoints in the order of their runs"});
  }
  if (!issues.empty()) throw InputError(std::move(issues));
}

bool is_smooth(const ScaledProblem& problem) {
  return std::any_of(problem.limits.begin(), problem.limits.end(),
                     [](const LimitSpec& limit) { return limit.measure == Measure::curvature_rate; });
}

double relaxed_bound(const LimitSpec& limit, double t, double measured) {
  const bool squared = limit.measure == Measure::speed || limit.measure == Measure::exit_speed;
  if (limit.side == 0) return (squared ? std::sqrt(std::max(measured, 0.0)) : measured) / limit.per_si;
  if (limit.name.is_radius()) {
    // A radius: its curvature grows by t times its own bound.
    return limit.bound_si / (1.0 + t);
  }
  if (squared) {
    const double v = limit.bound * limit.bound + limit.side * t * 2.0 * limit.bound * limit.scale;
    const double share = std::sqrt(std::max(v, 0.0)) / limit.bound;
    // A depth is as much larger as the speed may be smaller.
    return limit.name.id == LimitId::highest_burden_depth ? limit.bound_si / share : limit.bound_si * share;
  }
  if (limit.measure == Measure::curvature_rate) return limit.bound_si * (1.0 + t);
  return limit.bound_si + limit.side * t * limit.scale / limit.per_si;
}

bool is_cap_along(const LimitSpec& limit) {
  return limit.measure == Measure::speed && limit.side > 0;
}

bool holds_from_a_place(const LimitSpec& limit) {
  return limit.side < 0 && limit.name.id == LimitId::speed;
}

Mesh mesh_of(const ScaledProblem& problem, Vector knots, double core_length) {
  Mesh mesh;
  mesh.changes = problem.changes;
  mesh.change_knots = change_knots(problem, core_length);
  mesh.knots = with_change_knots(knots, mesh.change_knots);
  const bool begins_later = std::any_of(problem.limits.begin(), problem.limits.end(), holds_from_a_place);
  if (begins_later) mesh.held_from = problem.lowest_speed_from;
  mesh.lead_in = problem.lead_in;
  mesh.lead_out = problem.lead_out;
  mesh.core_length = core_length;
  mesh.entry_speed2 = problem.entry_speed2;
  mesh.centre_height = problem.rides.front().height;
  return mesh;
}

}  // namespace glissade::optimizer
