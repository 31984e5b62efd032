#include "optimize/answer/substitute.hpp"

#include "glissade/centerline/clothoid_spline.hpp"
#include "glissade/centerline/fastest_track.hpp"
#include "glissade/centerline/straight_line.hpp"
#include "glissade/core/math.hpp"

#include "optimize/search/ramp.hpp"
#include "referee/judgement.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace glissade::optimizer {
namespace {

/// A track that no mesh was needed for, in the place of the one found.
void answer_with(CenterlinePtr track, const referee::Judgement& judgement, std::vector<ActiveLimit> active,
                 Optimum& optimum) {
  OptimizeReport& report = optimum.report;
  optimum.centerline = std::move(track);
  report.active = std::move(active);
  report.travel_time = judgement.travel_time;
  report.exit_speed = judgement.exit_speed;
  report.checks = judgement.checks;
  report.first_order_residual = 0.0;
  report.finer_mesh_wins = 0.0;
}

/// The unlimited optimum, where that keeps every limit. @pre there is one: unlimited_travel_time()
std::optional<KeptTrack> exact_track(const Problem& problem, const OptimizeOptions& options) {
  const FastestTrack fastest =
      fastest_track(problem.endpoints, problem.body.friction, problem.body.entry_speed, problem.gravity);
  return kept_track(problem, fastest.centerline, options.limit_tolerance);
}

bool is_fastest_at_nominal(const Objective& objective) {
  return objective.kind == ObjectiveKind::travel_time && !objective.worst_case;
}

}  // namespace

bool take_unlimited(const Problem& problem, const OptimizeOptions& options, Optimum& optimum) {
  constexpr double kBehind = 1e-6;  // accuracy: that of a time
  OptimizeReport& report = optimum.report;
  const std::optional<double> least = report.unlimited_travel_time;
  const bool is_fastest = is_fastest_at_nominal(problem.objective);
  if (!least || !is_fastest || report.travel_time <= (1.0 + kBehind) * *least) return false;
  // Who asks for few pieces gets what they give.
  if (options.pieces < OptimizeOptions{}.pieces) return false;
  const bool bound = std::any_of(report.active.begin(), report.active.end(), [](const ActiveLimit& active) {
    return active.limit.id != LimitId::lowest_normal_load && active.limit.id != LimitId::arrival;
  });
  if (bound) return false;
  const std::optional<KeptTrack> exact = exact_track(problem, options);
  if (!exact || !(exact->judgement.travel_time < report.travel_time)) return false;
  answer_with(exact->track, exact->judgement, {}, optimum);
  return true;
}

void take_ramp(const Problem& problem, const OptimizeOptions& options, Optimum& optimum) {
  constexpr double kBehind = 1e-7;  // accuracy: that of a limit
  const ObjectiveKind kind = problem.objective.kind;
  if (!is_low_or_short(kind)) return;
  const std::optional<Ramp> ramp = steepest_ramp(problem);
  if (!ramp || !ramp->keeps_limits(options.limit_tolerance)) return;
  if (!(measure_of(*ramp->line, kind) < (1.0 - kBehind) * measure_of(*optimum.centerline, kind))) return;
  answer_with(ramp->line, ramp->judgement, active_limits(*ramp, problem), optimum);
}

void answer_with_any(const KeptTrack& kept, Optimum& optimum) {
  answer_with(kept.track, kept.judgement, {}, optimum);
  optimum.report.status = OptimizeStatus::feasible_not_converged;
  optimum.report.first_order_residual = HUGE_VAL;
  optimum.report.finer_mesh_wins.reset();
}

void tell_creeping(const Problem& problem, const OptimizeOptions& options, const Creep& creep,
                   Optimum& optimum) {
  OptimizeReport& report = optimum.report;
  const bool has_exact = report.unlimited_travel_time && is_fastest_at_nominal(problem.objective);
  if (const auto exact = has_exact ? exact_track(problem, options) : std::nullopt) {
    answer_with(exact->track, exact->judgement, {}, optimum);
    report.status = OptimizeStatus::optimal;
    report.message = "every limit holds, and no track without limits is faster";
    return;
  }
  const auto line =
      kept_track(problem, std::make_shared<const StraightLine>(problem.endpoints), options.limit_tolerance);
  report.message =
      (line ? "every limit holds on the straight line, but " : "no search was made: ") + creep_text(creep);
  if (line) answer_with_any(*line, optimum);
}

void meet_finish(const Problem& problem, double tolerance, Optimum& optimum) {
  constexpr double kMet = 1e-10;  // accuracy: of the chord; a tenth of what tables come back to
  const auto* const spline = dynamic_cast<const ClothoidSpline*>(optimum.centerline.get());
  if (spline == nullptr || problem.finish.kind != FinishKind::point) return;
  const Vec2 asked{std::fabs(problem.endpoints.run), problem.endpoints.drop};
  const CenterlinePoint last = spline->at(spline->length());
  const Vec2 end{last.x, last.drop};
  if (!(norm(end - asked) > kMet * norm(asked))) return;
  const double scale = norm(asked) / norm(end);
  const double turn = math::atan2(cross(end, asked), dot(end, asked));
  std::vector<ClothoidSegment> segments = spline->segments();
  for (ClothoidSegment& segment : segments) {
    segment.length *= scale;
    segment.entry_curvature /= scale;
    segment.exit_curvature /= scale;
  }
  const Angle entry = Angle::from_radians(spline->entry_slope_angle().radians() + turn);
  const auto met = std::make_shared<const ClothoidSpline>(entry, std::move(segments));
  referee::Judgement judgement = referee::judge_track(problem, met, referee::kRefereeSamples);
  if (!judgement.arrived || judgement.worst > tolerance) return;
  for (ActiveLimit& active : optimum.report.active) {
    for (Stretch& stretch : active.where) stretch = {scale * stretch.from, scale * stretch.to};
  }
  optimum.centerline = met;
  optimum.report.travel_time = judgement.travel_time;
  optimum.report.exit_speed = judgement.exit_speed;
  optimum.report.checks = std::move(judgement.checks);
}

}  // namespace glissade::optimizer
