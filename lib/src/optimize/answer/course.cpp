#include "optimize/answer/course.hpp"

#include "glissade/centerline/straight_line.hpp"

#include "optimize/search/ramp.hpp"
#include "optimize/search/smoother_ground.hpp"
#include "optimize/search/starts.hpp"
#include "referee/judgement.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace glissade::optimizer {
namespace {

/// The better one of two ends.
bool is_better(const Candidate& candidate, const std::optional<Candidate>& best) {
  if (!best) return true;
  if (candidate.kept != best->kept) return candidate.kept;
  return candidate.kept && candidate.found->objective < best->found->objective;
}

/// Whether a body that was fast is all but at rest somewhere: next to that a track is an optimum among those that keep it moving,
/// and others, on which it stays fast, lie far away.
bool nearly_stops(const Found& found) {
  constexpr double kOfSpeed = 0.05;  // taste: of the highest speed before
  const State state = found.rows->state(found.z, false);
  return std::any_of(state.flows.begin(), state.flows.end(), [](const Flow& flow) {
    double highest = 0.0;
    for (const double v : flow.v) {
      if (v < kOfSpeed * kOfSpeed * highest) return true;
      highest = std::max(highest, v);
    }
    return false;
  });
}

}  // namespace

void Course::from_starts() {
  if (control_.any_track) {
    for (std::size_t way = 0; way < ways_.size() && !stopped_ && !kept(); ++way)
      take(way, searcher_.search(ways_[way]));
    return;
  }
  // The promising ways first: what is plainly behind them need not be searched to its end.
  std::vector<Searcher::Opening> openings;
  Vector promises;
  do {
    openings.push_back(searcher_.opened(ways_[openings.size()]));
    promises.push_back(openings.back().promise());
  } while (openings.size() < ways_.size() && !control_.stop());
  const double least = *std::min_element(promises.begin(), promises.end());
  for (const bool first_ones : {true, false}) {
    for (std::size_t way = 0; way < openings.size(); ++way) {
      constexpr double kBehind = 0.01;  // taste
      const bool is_promising = promises[way] <= least + kBehind * std::fabs(least);
      if (stopped_) return;
      if (is_promising == first_ones) take(way, searcher_.search(std::move(openings[way]), best_));
    }
  }
}

void Course::onto_smoother_ground() {
  for (std::size_t way = 0; way < ways_.size(); ++way) {
    if (!kept() || stopped_) return;
    // The same track by another way differs by less, and that is no reason to prefer it.
    constexpr double kFaster = 1e-6;  // accuracy: that of a time
    const Candidate known = *best_;
    const double enough = known.found->objective - kFaster * std::fabs(known.found->objective);
    for (Candidate& other : on_smoother_ground(problem_, ways_[way], known, options_, control_, progress_)) {
      if (other.found->objective < enough) take(way, std::move(other));
    }
  }
}

void Course::from_straight_line() {
  constexpr double kSlower = 1e-6;  // accuracy: that of a time
  if (stopped_ || problem_.finish.kind != FinishKind::point || has_straight_line_behind(kSlower)) return;
  const CenterlinePtr line = std::make_shared<StraightLine>(problem_.endpoints);
  const referee::Judgement judgement = referee::judge_track(problem_, line, referee::kRefereeSamples);
  if (!judgement.arrived || judgement.worst > options_.limit_tolerance) return;
  const auto is_behind = [&] {
    return !kept() ||
           (is_fastest() && best_->judgement.travel_time > (1.0 + kSlower) * judgement.travel_time);
  };
  from_line({std::fabs(problem_.endpoints.run), problem_.endpoints.drop}, is_behind);
}

void Course::from_ramp() {
  constexpr double kHigher = 1e-7;  // accuracy: that of a limit
  if (stopped_ || !is_low_or_short(problem_.objective.kind)) return;
  const std::optional<Ramp> ramp = steepest_ramp(problem_);
  if (!ramp || !ramp->keeps_limits(options_.limit_tolerance)) return;
  const double length = measure_of(*ramp->line, problem_.objective.kind);
  const auto is_behind = [&] {
    return !kept() || measure_of(*best_->track, problem_.objective.kind) > (1.0 + kHigher) * length;
  };
  const Endpoints ends = ramp->line->endpoints();
  from_line({ends.run, ends.drop}, is_behind);
}

void Course::from_track(const Centerline& track) {
  constexpr std::size_t kPieces = 24;  // taste
  for (std::size_t way = 0; way < ways_.size() && !kept() && !stopped_; ++way) {
    const ScaledProblem problem = scaled(problem_, ways_[way]);
    const std::optional<GuessCurve> curve = curve_along(problem, track);
    if (!curve) return;
    const Mesh mesh = mesh_of(problem, graded_knots(*curve, kPieces, 1.0), curve->length);
    from(Foothold{way, mesh, fit(*curve, Transcription(mesh))});
  }
}

void Course::from(const Foothold& foothold) {
  if (!stopped_)
    take(foothold.passages, searcher_.search_from(ways_[foothold.passages], foothold.mesh, foothold.z));
}

void Course::from_known() {
  if (stopped_ && !kept()) take(way_, searcher_.from_known());
}

Course::Onto Course::onto(Found found) {
  constexpr double kPays = 5e-7;  // accuracy: half that of a time
  const double known = best_->found->objective;
  if (stopped_ || !(known - found.objective > kPays * std::fabs(known))) return Onto::untried;
  const Candidate end = searcher_.ended_on(*best_, std::move(found));
  const bool converged = end.kept && !end.stopped && end.found->residual <= options_.tolerance;
  if (!converged) return Onto::untried;
  take(way_, end);
  return best_->found->objective < known ? Onto::taken : Onto::no_better;
}

void Course::sharpen_crest() {
  if (!stopped_) best_ = searcher_.with_sharper_crest(*std::move(best_));
}

void Course::from(const std::vector<Foothold>& footholds) {
  if (control_.any_track) {
    for (const Foothold& foothold : footholds) {
      if (!kept()) from(foothold);
    }
    return;
  }
  std::vector<Searcher::Stage> stages;
  double best = HUGE_VAL;
  for (const Foothold& foothold : footholds) {
    stages.push_back(searcher_.carried_on(ways_[foothold.passages], foothold.mesh, foothold.z));
    if (is_on_limits(stages.back())) best = std::min(best, stages.back().found.objective);
  }
  const auto may_win = [&](const Searcher::Stage& stage) {
    constexpr double kBehind = 0.01;  // taste: of the objective; what follows wins less
    return is_on_limits(stage) && stage.found.objective <= best + kBehind * std::fabs(best);
  };
  for (const bool first : {true, false}) {
    for (std::size_t i = 0; i < stages.size(); ++i) {
      if (stopped_ || (!first && kept())) return;
      if (may_win(stages[i]) == first) take(footholds[i].passages, searcher_.ended(std::move(stages[i])));
    }
  }
}

void Course::look_again(bool by_footholds) {
  const auto is_optimum = [&] { return best_->found->residual <= options_.tolerance; };
  look_at_promising();
  bool is_hooked = false;
  if (kept() && !stopped_) {
    const double known = best_->found->objective;
    best_ = searcher_.from_hooks(*std::move(best_));
    stopped_ = best_->stopped;
    // Other tracks that wind take long to find: that is for those that hooks do not help.
    is_hooked = best_->found->objective < known && is_optimum();
  }
  if (!kept() || stopped_) return;
  best_ = searcher_.with_promises_tried(*std::move(best_));
  stopped_ = best_->stopped;
  if (stopped_) return;
  const bool is_doubted = (is_about_exit_speed() && nearly_stops(*best_->found)) ||
                          promises_too_much(*best_->problem, best_->ahead.finer_mesh_wins.value_or(0.0));
  if (!is_hooked && (by_footholds || !is_optimum() || is_doubted)) {
    best_ = by_footholds ? searcher_.from_loose_caps(*std::move(best_))
                         : searcher_.from_scattered(*std::move(best_));
    if (!best_->stopped && (by_footholds || !is_optimum()))
      best_ = searcher_.on_other_meshes(*std::move(best_), by_footholds);
  }
  // Bends that lie well by themselves may still lie in the wrong order.
  if (!best_->stopped) best_ = searcher_.with_shifted_bends(*std::move(best_));
  stopped_ = best_->stopped;
}

void Course::from_likely(const std::vector<Beginning>& likely) {
  control_.most_rounds = kFarRounds;
  (void)has_likely_footing(problem_, ways_, leads(), control_, likely);
}

void Course::from_footholds(bool bends) {
  control_.most_rounds = kFarRounds;
  (void)has_footing(problem_, ways_, leads(), control_, bends);
}

Conflict Course::explained(const Resolve& resolve, bool& certain) {
  control_.most_rounds = kFarRounds;
  Explanation explanation = explain(problem_, ways_, leads(), resolve, control_);
  stopped_ = stopped_ || control_.stop();
  certain = explanation.certain && !best_->kept && !stopped_;
  return std::move(explanation.conflict);
}

bool Course::is_on_limits(const Searcher::Stage& stage) {
  constexpr double kNearly = 1e-5;  // accuracy: a hundred times that of a limit
  return stage.found.feasible(kNearly);
}

Leads Course::leads() {
  return [this](const std::vector<Foothold>& footholds) {
    from(footholds);
    return kept() || stopped_;
  };
}

void Course::from_line(Vec2 finish, const std::function<bool()>& is_behind) {
  constexpr std::size_t kPieces = 24;  // taste
  for (std::size_t way = 0; way < ways_.size() && is_behind() && !stopped_; ++way) {
    const ScaledProblem problem = scaled(problem_, ways_[way]);
    const std::optional<GuessCurve> curve = straight_line(problem, (1.0 / problem.chord) * finish);
    if (!curve) return;
    const Mesh mesh = mesh_of(problem, graded_knots(*curve, kPieces, 1.0), curve->length);
    const Foothold foothold{way, mesh, fit(*curve, Transcription(mesh))};
    from(foothold);
    if (is_behind() && !stopped_) take(way, searcher_.mended(ways_[way], foothold.mesh, foothold.z));
  }
}

bool Course::has_straight_line_behind(double share) const {
  if (!kept()) return false;
  if (!is_fastest()) return true;
  const bool simple = best_->rough->drag == 0.0;
  return simple && best_->found->objective <= (1.0 + share) * straight_time(*best_->rough);
}

void Course::look_at_promising() {
  constexpr double kMuch = 1e-4;  // taste: for less of the objective it is not worth the way
  if (!kept() || stopped_ || !promising_) return;
  const double known = best_->found->objective;
  if (!(known - promising_->promising->objective > kMuch * std::fabs(known))) return;
  Candidate end = searcher_.from_promising(*promising_);
  stopped_ = stopped_ || end.stopped;
  if (end.kept && end.found->residual <= options_.tolerance) take(promising_way_, std::move(end));
}

void Course::take(std::size_t way, Candidate candidate) {
  stopped_ = stopped_ || candidate.stopped;
  const bool promises = candidate.promising &&
                        (!promising_ || candidate.promising->objective < promising_->promising->objective);
  if (promises) {
    promising_ = candidate;
    promising_way_ = way;
  }
  if (!is_better(candidate, best_)) return;
  best_ = std::move(candidate);
  way_ = way;
}

}  // namespace glissade::optimizer
