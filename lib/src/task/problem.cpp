#include "glissade/task/problem.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/quantity.hpp"
#include "glissade/core/units.hpp"
#include "glissade/motion/laws/bulk_stream.hpp"
#include "glissade/task/limit_catalogue.hpp"

#include "core/counted.hpp"
#include "core/outline.hpp"

#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace glissade {
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
  void range(const char* name, const Range& range) {
    if (range.lowest) number(name, *range.lowest, true, "a length is finite");
    if (range.highest) number(name, *range.highest, true, "a length is finite");
    if (!range.lowest || !range.highest) return;
    require(*range.lowest <= *range.highest,
            std::string(name) + ": lowest " + exact_text(*range.lowest) + " exceeds highest " +
                exact_text(*range.highest),
            "a range needs lowest <= highest");
  }
  void add(Issue issue) { issues_.push_back(std::move(issue)); }
  void points(const std::string& name, const std::vector<Vec2>& points, std::size_t least) {
    require(points.size() >= least, name + ": " + core::counted(points.size(), "point"),
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

void check_ends(const Problem& problem, Checker& check) {
  if (fixes_run(problem.finish.kind)) {
    check.number("endpoints.run", problem.endpoints.run, problem.endpoints.run != 0.0,
                 "a run of 0 is a fall straight down, which leaves nothing to optimise");
  }
  if (fixes_drop(problem.finish.kind)) {
    check.number("endpoints.drop", problem.endpoints.drop, true, "the drop is a finite length");
    check.require(
        problem.body.entry_speed > 0.0 || problem.endpoints.drop > 0.0 || is_driven_by_wind(problem.body),
        "endpoints.drop: " + exact_text(problem.endpoints.drop) + " m",
        "from rest the finish must lie below the start", "a positive drop, or an entry_speed");
  }
  if (problem.finish.kind == FinishKind::level) {
    check.require(problem.endpoints.drop != 0.0, "endpoints.drop: 0 m", "a level finish needs a drop");
  }
}

void check_body(const Problem& problem, Checker& check) {
  check.number("gravity", problem.gravity, problem.gravity > 0.0, "gravity is positive");
  check.number("body.entry_speed", problem.body.entry_speed, problem.body.entry_speed >= 0.0,
               "a speed is not negative");
  check.number("body.drag_per_metre", problem.body.drag_per_metre, problem.body.drag_per_metre >= 0.0,
               "drag is not negative");
  if (problem.low_friction) {
    check.require(*problem.low_friction <= problem.body.friction, "low_friction exceeds the body's friction",
                  "a friction range needs low <= nominal <= high");
  }
  const Friction least = problem.low_friction.value_or(problem.body.friction);
  const Friction most = problem.high_friction.value_or(problem.body.friction);
  for (const Friction& friction : problem.further_frictions) {
    check.require(least <= friction && friction <= most, "further_frictions leave the range",
                  "what lies outside it is no friction of the body");
  }
  if (problem.high_friction) {
    check.require(*problem.high_friction >= problem.body.friction,
                  "high_friction is below the body's friction",
                  "a friction range needs low <= nominal <= high");
  }
}

/// What the catalogue cannot tell: a belt is a group, and some limits are of a stream alone.
void check_stream_limits(const Problem& problem, Checker& check) {
  if (const auto& match = problem.limits.match_belt) {
    check.number("match_belt.speed", match->speed, match->speed > 0.0, "a belt runs: its speed is above 0");
    check.number("match_belt.within", match->within, match->within > 0.0 && match->within <= 1.0,
                 "a share of the belt's speed is above 0 and at most 1");
    const double off = std::fabs(match->direction.radians());
    check.require(off <= kRightAngle,
                  "match_belt.direction: " + quantity_beyond(match->direction.radians(), Dimension::angle,
                                                             {-kRightAngle, kRightAngle}),
                  "what lands has no speed along a belt that runs against the track: within +-90 deg");
  }
  if (dynamic_cast<const BulkStream*>(problem.body.law.get()) != nullptr) return;
  check.require(!problem.limits.highest_burden_depth, "highest_burden_depth: of a body that is no stream",
                "only a stream has a depth", "a BulkStream as the body's law");
  check.require(!problem.limits.highest_floor_wear, "highest_floor_wear: of a body that is no stream",
                "what rubs on the floor follows from a mass flow", "a BulkStream as the body's law");
}

void check_objective(const Problem& problem, Checker& check) {
  check.number("objective.exit_speed_weight", problem.objective.exit_speed_weight,
               problem.objective.exit_speed_weight >= 0.0, "a weight is not negative");
  const Range& exit_speed = problem.limits.exit_speed;
  const bool speed_given = exit_speed.lowest && *exit_speed.lowest > problem.body.entry_speed;
  const bool anywhere = problem.finish.kind == FinishKind::anywhere;
  const bool is_away = !problem.finish.free_range.holds(0.0) || !problem.finish.free_drop.holds(0.0);
  if (anywhere && !is_away) {
    check.require(speed_given, "finish: free both ways, without a lowest exit speed above the entry speed",
                  "it is the speed to be reached that says how far the track has to fall",
                  "exit_speed.lowest, or a finish with a run or a drop");
  }
  if (problem.objective.kind == ObjectiveKind::least_drop) {
    check.require(!fixes_drop(problem.finish.kind), "objective: least_drop, of a finish whose drop is given",
                  "it is the least height between start and finish", "a finish whose drop is free");
  }
  if (problem.objective.kind == ObjectiveKind::least_peak_wear) {
    check.require(dynamic_cast<const BulkStream*>(problem.body.law.get()) != nullptr,
                  "objective: least_peak_wear, of a body that is no stream",
                  "what rubs on the floor follows from a mass flow", "objective: least_wear");
  }
  if (!is_least_bound(problem.objective.kind)) return;
  check.require(speed_given, "objective: a least bound, without a lowest exit speed above the entry speed",
                "the tightest bound is the one at which a given speed is just reached", "exit_speed.lowest");
  check.require(!anywhere, "objective: a least bound, with a finish that is free both ways",
                "a longer and longer track has less and less of it", "a finish with a drop");
}

void check_profiles(const char* name, const std::vector<Profile>& profiles, Checker& check) {
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
}

void check_obstacles(const Limits& limits, Checker& check) {
  for (const HalfPlane& plane : limits.half_planes) {
    check.require(norm(plane.forbidden) > 0.0 && std::isfinite(norm(plane.forbidden)) &&
                      std::isfinite(norm(plane.point)),
                  "half_planes: point or direction is not finite, or the direction has no length",
                  "a half-plane needs a direction");
    check.number("half_planes clearance", plane.clearance, plane.clearance >= 0.0,
                 "a clearance is not negative");
  }
  for (const KeepOut& keep_out : limits.keep_outs) {
    if (auto fault = core::outline_fault(keep_out.outline, "keep_outs outline")) check.add(std::move(*fault));
    check.number("keep_outs clearance", keep_out.clearance, keep_out.clearance >= 0.0,
                 "a clearance is not negative");
  }
  check_profiles("stay_above", limits.stay_above, check);
  check_profiles("stay_below", limits.stay_below, check);
  check.points("waypoints", limits.waypoints, 0);
  const Envelope& envelope = limits.envelope;
  check.number("envelope.below", envelope.below, envelope.below >= 0.0, "a depth is not negative");
  check.number("envelope.above", envelope.above, envelope.above >= 0.0, "a height is not negative");
  check.number("envelope.headroom", envelope.headroom, envelope.headroom >= 0.0, "a height is not negative");
}

}  // namespace

namespace {

/// @param searched  whether a track is to be found; one that is given leads where it leads, whatever it was found for
void require_sound(const Problem& problem, bool searched) {
  Checker check;
  if (searched) check_ends(problem, check);
  check_body(problem, check);
  if (searched) check_objective(problem, check);
  const Limits& limits = problem.limits;
  for (LimitFault& fault : limit_faults(limits)) check.add(std::move(fault.issue));
  check_stream_limits(problem, check);
  check.number("lowest_speed_from", limits.lowest_speed_from, limits.lowest_speed_from >= 0.0,
               "an arc length is not negative");
  check.range("finish.free_range", problem.finish.free_range);
  check.range("finish.free_drop", problem.finish.free_drop);
  check_obstacles(limits, check);
  check.finish();
}

}  // namespace

void require_valid(const Problem& problem) {
  require_sound(problem, true);
}

void require_judgeable(const Problem& problem) {
  require_sound(problem, false);
}

}  // namespace glissade
