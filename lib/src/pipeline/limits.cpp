// From the design's frame (x, z up) to that of the optimiser (run, drop down) and back.

#include "pipeline/limits.hpp"

#include "glissade/core/number_text.hpp"

#include "pipeline/located.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

namespace glissade {

using namespace pipeline;

namespace {

/// The track leads towards smaller x, so that runs count the other way.
bool is_mirrored(const TrackDesign& track) {
  return in_track_plane(track, {track.start.x + 1.0, 0.0}).x < in_track_plane(track, {track.start.x, 0.0}).x;
}

Range same(const LimitRange& range) {
  return {range.lowest, range.highest};
}

/// A speed of 0 or more is no limit: every speed is.
Range speeds(const LimitRange& range) {
  Range speeds = same(range);
  if (speeds.lowest && *speeds.lowest <= 0.0) speeds.lowest.reset();
  return speeds;
}

std::vector<Vec2> in_plane(const TrackDesign& track, const std::vector<Vec2>& points) {
  std::vector<Vec2> result;
  result.reserve(points.size());
  for (const Vec2 point : points) result.push_back(in_track_plane(track, point));
  return result;
}

Profile profile_of(const TrackDesign& track, const ProfileDesign& design) {
  Profile profile{in_plane(track, design.line), design.clearance};
  if (is_mirrored(track)) std::reverse(profile.line.begin(), profile.line.end());
  return profile;
}

Passage passage_of(PassageDesign passage) {
  switch (passage) {
    case PassageDesign::either:
      return Passage::either;
    case PassageDesign::above:
      return Passage::above;
    case PassageDesign::below:
      return Passage::below;
  }
  throw InternalError({"", "a passage without a side", "", ""});
}

Limits limits_of(const TrackDesign& track, const LimitsDesign& design) {
  Limits limits;
  limits.entry_slope_angle = same(design.entry_slope_angle);
  limits.exit_slope_angle = same(design.exit_slope_angle);
  limits.slope_angle = same(design.slope_angle);
  limits.smallest_valley_radius = design.smallest_valley_radius;
  limits.smallest_crest_radius = design.smallest_crest_radius;
  limits.highest_curvature_rate = design.highest_curvature_rate;
  limits.concave = design.concave;
  limits.highest_normal_load = design.highest_normal_load;
  limits.lowest_normal_load = design.lowest_normal_load;
  limits.highest_curvature_load = design.highest_curvature_load;
  limits.speed = speeds(design.speed);
  limits.lowest_speed_from = design.lowest_speed_from;
  limits.exit_speed = speeds(design.exit_speed);
  limits.arc_length = same(design.arc_length);
  if (limits.arc_length.lowest && *limits.arc_length.lowest <= 0.0) limits.arc_length.lowest.reset();
  limits.lead_in = design.lead_in;
  limits.lead_out = design.lead_out;
  for (const HalfPlaneDesign& plane : design.half_planes) {
    const Vec2 point = in_track_plane(track, plane.point);
    const Vec2 forbidden = in_track_plane(track, plane.point + plane.forbidden) - point;
    limits.half_planes.push_back({point, forbidden, plane.clearance});
  }
  for (const KeepOutDesign& area : design.keep_outs) {
    limits.keep_outs.push_back({in_plane(track, area.outline), area.clearance, passage_of(area.passage)});
  }
  for (const ProfileDesign& line : design.stay_above) limits.stay_above.push_back(profile_of(track, line));
  for (const ProfileDesign& line : design.stay_below) limits.stay_below.push_back(profile_of(track, line));
  limits.waypoints = in_plane(track, design.waypoints);
  return limits;
}

ObjectiveKind objective_kind_of(ObjectiveDesignKind kind) {
  switch (kind) {
    case ObjectiveDesignKind::travel_time:
      return ObjectiveKind::travel_time;
    case ObjectiveDesignKind::exit_speed:
      return ObjectiveKind::exit_speed;
    case ObjectiveDesignKind::blend:
      return ObjectiveKind::blend;
  }
  throw InternalError({"", "an objective without a kind", "", ""});
}

/// Drop grows where z falls, run where x falls on a mirrored track: then the ends of a range change places.
Range turned(const LimitRange& range, double at_zero, double sign) {
  const auto moved = [&](const std::optional<double>& value) {
    return value ? std::optional(sign * (*value - at_zero)) : std::nullopt;
  };
  return sign > 0.0 ? Range{moved(range.lowest), moved(range.highest)}
                    : Range{moved(range.highest), moved(range.lowest)};
}

Finish finish_of(const TrackDesign& track) {
  switch (track.free_finish) {
    case FreeFinish::none:
      return {};
    case FreeFinish::height:
      return {FinishKind::vertical_line, turned(track.free_range, track.start.z, -1.0)};
    case FreeFinish::run:
      break;
  }
  Range runs = turned(track.free_range, track.start.x, is_mirrored(track) ? -1.0 : 1.0);
  // Behind the start there is no track that leads to the finish.
  if (runs.lowest && *runs.lowest <= 0.0) runs.lowest.reset();
  return {FinishKind::level, runs};
}

/// The way back for the coordinates of a free finish: what the optimiser calls finish.drop and finish.run.
class FinishNames {
 public:
  explicit FinishNames(const TrackDesign& track)
      : start_(track.start), mirrored_(is_mirrored(track)), level_(track.start.y == track.finish.y) {}

  void rename(LimitCheck& check) const {
    if (!is_finish(check.limit)) return;
    check.value = coordinate(check.limit, check.value);
    check.reached = coordinate(check.limit, check.reached);
    if (is_turned(check.limit)) check.side = -check.side;
    check.limit = name(check.limit);
  }
  void rename(ActiveLimit& active) const {
    if (!is_finish(active.limit)) return;
    active.value = coordinate(active.limit, active.value);
    active.limit = name(active.limit);
  }
  void rename(Relaxation& relaxation) const {
    if (!is_finish(relaxation.limit)) return;
    relaxation.value = coordinate(relaxation.limit, relaxation.value);
    relaxation.needed = coordinate(relaxation.limit, relaxation.needed);
    relaxation.limit = name(relaxation.limit);
  }
  void rename(StatedLimit& stated) const {
    if (!is_finish(stated.limit)) return;
    if (stated.value) stated.value = coordinate(stated.limit, *stated.value);
    stated.limit = name(stated.limit);
  }

 private:
  [[nodiscard]] static bool is_finish(std::string_view limit) { return limit.starts_with("finish."); }
  [[nodiscard]] static bool is_drop(std::string_view limit) { return limit.starts_with("finish.drop"); }
  [[nodiscard]] bool is_turned(std::string_view limit) const { return is_drop(limit) || mirrored_; }

  [[nodiscard]] double coordinate(std::string_view limit, double value) const {
    if (is_drop(limit)) return start_.z - value;
    return (level_ ? start_.x : 0.0) + (mirrored_ ? -value : value);
  }
  [[nodiscard]] std::string name(std::string_view limit) const {
    std::string end(limit.substr(limit.rfind('.')));
    if (end == ".lowest" || end == ".highest") {
      if (is_turned(limit)) end = end == ".lowest" ? ".highest" : ".lowest";
    } else {
      end.clear();
    }
    return (is_drop(limit) ? "finish.z" : "finish.x") + end;
  }

  Vec3 start_;
  bool mirrored_;
  bool level_;
};

std::string value_text(double value, const std::string& unit) {
  if (unit == "rad") return angle_text(value);
  if (unit == "m") return length_text(value);
  return rounded_text(value, 4) + " " + unit;
}

/// Where a limit stands in the design file: "keep_outs[0]" at limits.keep_outs.0.
std::string place_of(const Design& design, std::string limit) {
  if (limit.starts_with("finish")) return design.where("track." + limit);
  if (limit.starts_with("friction") || limit.starts_with("arrival")) return design.where("body");
  for (const char bracket : {'[', ']'}) std::replace(limit.begin(), limit.end(), bracket, '.');
  if (limit.ends_with('.')) limit.pop_back();
  return design.where("limits." + limit);
}

Issue conflict_issue(const Design& design, const OptimizeReport& report) {
  const Conflict& conflict = report.conflict;
  const std::string place =
      conflict.limits.empty() ? design.where("limits") : place_of(design, conflict.limits.front().limit);
  std::string hint;
  for (std::size_t index = 0; index < conflict.relaxations.size(); ++index) {
    const Relaxation& relaxation = conflict.relaxations[index];
    if (index != 0) hint += index + 1 == conflict.relaxations.size() ? " or " : ", ";
    hint += relaxation.limit + ": " + value_text(relaxation.needed, relaxation.unit);
  }
  if (conflict.relaxations.size() > 1) hint += " (each alone would do)";
  return {place, conflict.text, "Even the track that breaks them least still breaks them.", hint};
}

void rename_finish(const Design& design, OptimizeReport& report) {
  const FinishNames names(design.track);
  for (LimitCheck& check : report.checks) names.rename(check);
  for (ActiveLimit& active : report.active) names.rename(active);
  for (StatedLimit& stated : report.conflict.limits) names.rename(stated);
  for (Relaxation& relaxation : report.conflict.relaxations) names.rename(relaxation);
  // Out of reach is a sentence of its own, and knows no free finish.
  if (design.track.free_finish == FreeFinish::none || report.conflict.limits.empty()) return;
  report.conflict.text = conflict_text(report.conflict);
  report.message = report.conflict.text;
}

std::string broken_text(const LimitCheck& check) {
  std::string text = check.limit + " " + value_text(check.value, check.unit) + " is broken";
  if (std::isfinite(check.violation)) text += " by " + value_text(check.violation, check.unit);
  return text + " (" + value_text(check.reached, check.unit) + " after " + length_text(check.where) + ")";
}

}  // namespace

Problem problem_of(const Design& design) {
  Problem problem;
  problem.endpoints = endpoints_of(design);
  problem.finish = finish_of(design.track);
  problem.body = {design.body.friction, design.body.entry_speed, design.body.drag_per_metre};
  problem.low_friction = design.body.low_friction;
  problem.high_friction = design.body.high_friction;
  problem.gravity = design.gravity;
  if (!design.limits) return problem;
  problem.limits = limits_of(design.track, *design.limits);
  const ObjectiveDesign& objective = design.limits->objective;
  problem.objective = {objective_kind_of(objective.kind), objective.exit_speed_weight, objective.worst_case};
  return problem;
}

Optimum pipeline::search_within_limits(const Design& design, const RunContext& context) {
  OptimizeOptions options;
  options.time_budget = context.time_budget;
  Optimum optimum = at_place(design.where("limits"), [&] {
    return optimize(problem_of(design), options, context.stop, context.progress);
  });
  rename_finish(design, optimum.report);
  if (optimum.centerline) return optimum;
  if (optimum.report.status == OptimizeStatus::infeasible) {
    throw LimitsConflict(conflict_issue(design, optimum.report), optimum.report);
  }
  const std::string place = design.where("limits");
  if (context.stop.stop_requested()) {
    throw Interrupted({place, "interrupted before any track kept every limit", "", ""});
  }
  throw ConvergenceError({place, optimum.report.message, "", "a larger --time-budget, or wider limits"});
}

std::vector<LimitCheck> pipeline::checked_limits(const Design& design, const Endpoints& endpoints,
                                                 const CenterlinePtr& centerline) {
  if (!design.limits) return {};
  Problem problem = problem_of(design);
  problem.endpoints = endpoints;
  std::vector<LimitCheck> checks =
      at_place(design.where("limits"), [&] { return check_limits(problem, centerline); });
  const FinishNames names(design.track);
  for (LimitCheck& check : checks) names.rename(check);
  return checks;
}

std::optional<Issue> limits_problem(const Design& design, const Track& track) {
  std::string broken;
  std::string place;
  for (const LimitCheck& check : track.limit_checks) {
    if (check.kept()) continue;
    if (place.empty()) place = place_of(design, check.limit);
    broken += (broken.empty() ? "" : "; ") + broken_text(check);
  }
  if (broken.empty()) return {};
  return Issue{place, "this track breaks limits of the design: " + broken,
               "A track of kind " + std::string(word(design.centerline.kind)) +
                   " is not shaped by limits, only held against them.",
               "kind: fastest, which is found within the limits, or other limits"};
}

std::optional<Issue> search_problem(const Design& design, const Track& track) {
  if (!track.search || track.search->status == OptimizeStatus::optimal) return {};
  return Issue{design.where("limits"),
               "the search for the fastest track ended early: " + track.search->message,
               "Every limit holds, but a faster track may be near: the first-order residual is " +
                   rounded_text(track.search->first_order_residual, 2) + " instead of at most " +
                   rounded_text(OptimizeOptions{}.tolerance, 2) + ".",
               "a larger --time-budget"};
}

}  // namespace glissade
