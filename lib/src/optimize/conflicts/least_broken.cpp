#include "optimize/conflicts/least_broken.hpp"

#include "optimize/mesh/refined_knots.hpp"
#include "optimize/search/hooked_starts.hpp"
#include "optimize/search/starts.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace glissade::optimizer {
namespace {

constexpr std::size_t kRoughPieces = 24;  // taste

Relaxed all_relaxed(const ScaledProblem& problem, const Mesh& mesh, const GuessCurve& curve,
                    SearchControl& control, StepModel model = StepModel::curved) {
  const Vector margins(problem.limits.size(), 0.0);
  return least_violation(problem, mesh, fit(curve, Transcription(mesh)), Elastic::all(problem.limits.size()),
                         margins, control, model);
}

/// The mesh follows the track, finer where it bends: what is left over then is no fault of the mesh.
void follow(Attempt& attempt, SearchControl& control) {
  constexpr std::size_t kFiner[] = {32, 48};  // taste
  constexpr double kPays = 0.7;               // taste
  for (const std::size_t pieces : kFiner) {
    if (attempt.relaxed.t <= kContradiction || control.stop()) return;
    const Found& found = attempt.relaxed.found;
    const ScaledProblem& problem = *attempt.problem;
    const Mesh mesh =
        mesh_of(problem, refined_knots(*found.track, found.z, {}, pieces), found.track->core_length(found.z));
    Relaxed finer = all_relaxed(problem, mesh, curve_of(*found.track, found.z), control);
    const bool pays = finer.t < kPays * attempt.relaxed.t;
    if (finer.t < attempt.relaxed.t) {
      attempt.mesh = mesh;
      attempt.relaxed = std::move(finer);
    }
    if (!pays) return;
  }
}

}  // namespace

std::optional<Relaxed> relaxed_alone(const Attempt& attempt, const Elastic& elastic, SearchControl& control) {
  constexpr double kKept = 1e-6;         // accuracy: ten times that of a limit
  constexpr std::size_t kFollowing = 3;  // budget
  constexpr std::size_t kFiner = 32;     // taste
  constexpr double kPays = 0.98;         // taste
  const ScaledProblem& problem = *attempt.problem;
  const Vector margins(problem.limits.size(), 0.0);
  std::optional<Relaxed> least;
  bool settled = false;
  const auto descend = [&](const Mesh& mesh, const Vector& beginning) {
    Relaxed alone = least_violation(problem, mesh, beginning, elastic, margins, control);
    settled = alone.settled;
    if (alone.found.violation > kKept || alone.t <= 0.0) return false;
    const bool pays = !least || alone.t < kPays * least->t;
    if (!least || alone.t < least->t) least = std::move(alone);
    return pays;
  };
  if (!descend(attempt.mesh, attempt.relaxed.found.z) && !settled && !control.stop()) {
    descend(attempt.mesh, fit(starts(problem).back(), Transcription(attempt.mesh)));
  }
  // The mesh follows the track: where it bends in the end need not be where it bent in the beginning.
  for (std::size_t round = 0; least && round < kFollowing && !control.stop(); ++round) {
    const Found& found = least->found;
    const Mesh mesh =
        mesh_of(problem, refined_knots(*found.track, found.z, {}, kFiner), found.track->core_length(found.z));
    if (!descend(mesh, fit(curve_of(*found.track, found.z), Transcription(mesh)))) break;
  }
  return least;
}

Elastic alone_of(const std::vector<LimitSpec>& limits, const LimitName& name) {
  Elastic elastic;
  elastic.equalities = false;
  for (const LimitSpec& limit : limits) elastic.limits.push_back(limit.name == name);
  return elastic;
}

std::vector<std::shared_ptr<ScaledProblem>> roughly_scaled_ways(const Problem& problem,
                                                                const std::vector<Passages>& passages) {
  std::vector<std::shared_ptr<ScaledProblem>> ways;
  for (const Passages& way : passages)
    ways.push_back(std::make_shared<ScaledProblem>(roughly_scaled(problem, way)));
  return ways;
}

void Winding::descend_all() {
  for (std::size_t way = 0; way < ways_.size(); ++way) {
    const std::vector<GuessCurve> curves = curves_on(way);
    for (std::size_t curve = 0; curve < curves.size(); ++curve) {
      // Clipped slopes are often the unclipped ones.
      const auto here = curves.begin() + static_cast<std::ptrdiff_t>(curve);
      if (std::find(curves.begin(), here, *here) == here) descend({way, curve, limit_}, *here);
    }
  }
  sort();
  constexpr std::size_t kFollowed = 2;  // budget
  for (std::size_t i = 0; i < std::min(kFollowed, ends_.size()); ++i) follow(ends_[i]);
  sort();
}

bool Winding::descend_from(const Beginning& beginning) {
  if (beginning.passages >= ways_.size()) return false;
  const std::vector<GuessCurve> curves = curves_on(beginning.passages);
  if (beginning.curve >= curves.size()) return false;
  descend(beginning, curves[beginning.curve]);
  if (!ends_.empty() && ends_.front().attempt.relaxed.t > kContradiction) follow(ends_.front());
  return !ends_.empty() && ends_.front().attempt.relaxed.t <= kContradiction;
}

std::vector<Foothold> Winding::footholds() const {
  std::vector<const End*> keeping;
  for (const End& end : ends_) {
    if (end.attempt.relaxed.t <= kContradiction) keeping.push_back(&end);
  }
  std::stable_sort(keeping.begin(), keeping.end(), [](const End* a, const End* b) {
    return a->attempt.relaxed.found.objective < b->attempt.relaxed.found.objective;
  });
  std::vector<Foothold> result;
  for (const End* end : keeping)
    result.push_back({end->beginning.passages, end->attempt.mesh, end->attempt.relaxed.found.z});
  return result;
}

std::vector<Beginning> Winding::best_beginnings() const {
  constexpr std::size_t kMost = 4;  // budget
  std::vector<Beginning> best;
  for (std::size_t i = 0; i < std::min(kMost, ends_.size()); ++i) best.push_back(ends_[i].beginning);
  return best;
}

std::vector<GuessCurve> Winding::curves_on(std::size_t way) const {
  std::vector<GuessCurve> all;
  for (const Curves curves :
       {&starts, &constant_speed_starts, &winding_starts, &stepped_starts, &hooked_starts}) {
    for (GuessCurve& curve : curves(*ways_[way])) all.push_back(std::move(curve));
  }
  return all;
}

void Winding::sort() {
  std::stable_sort(ends_.begin(), ends_.end(),
                   [](const End& a, const End& b) { return a.attempt.relaxed.t < b.attempt.relaxed.t; });
}

Relaxed Winding::relaxed(const ScaledProblem& problem, const Mesh& mesh, const GuessCurve& curve) const {
  const Vector margins(problem.limits.size(), 0.0);
  return least_violation(problem, mesh, fit(curve, Transcription(mesh)), alone_of(problem.limits, limit_),
                         margins, control_);
}

void Winding::descend(const Beginning& beginning, const GuessCurve& curve) {
  if (control_.stop()) return;
  const std::shared_ptr<ScaledProblem>& problem = ways_[beginning.passages];
  End end{beginning, {problem, mesh_of(*problem, graded_knots(curve, kRoughPieces, 1.0), curve.length), {}}};
  end.attempt.relaxed = relaxed(*problem, end.attempt.mesh, curve);
  if (end.attempt.relaxed.found.violation <= kKept) ends_.push_back(std::move(end));
}

void Winding::follow(End& end) {
  constexpr std::size_t kFiner = 40;  // taste
  if (control_.stop()) return;
  const Found& found = end.attempt.relaxed.found;
  const Mesh mesh = mesh_of(*end.attempt.problem, refined_knots(*found.track, found.z, {}, kFiner),
                            found.track->core_length(found.z));
  Relaxed finer = relaxed(*end.attempt.problem, mesh, curve_of(*found.track, found.z));
  if (finer.found.violation > kKept || finer.t >= end.attempt.relaxed.t) return;
  end.attempt.mesh = mesh;
  end.attempt.relaxed = std::move(finer);
}

bool LeastViolation::from(Curves curves_of, StepModel model) {
  for (std::size_t way = 0; way < ways_.size(); ++way) {
    const std::vector<GuessCurve> curves = curves_of(*ways_[way]);
    for (auto start = curves.begin(); start != curves.end(); ++start) {
      if (control_.stop()) return false;
      if (std::find(curves.begin(), start, *start) != start) continue;
      const Mesh mesh = mesh_of(*ways_[way], graded_knots(*start, kRoughPieces, 1.0), start->length);
      if (from(way, mesh, *start, model)) return true;
    }
  }
  return false;
}

bool LeastViolation::from(std::size_t way, const Mesh& mesh, const GuessCurve& curve, StepModel model) {
  Attempt attempt;
  attempt.problem = ways_[way];
  attempt.mesh = mesh;
  attempt.relaxed = all_relaxed(*ways_[way], mesh, curve, control_, model);
  if (attempt.relaxed.t < kNearly && is_new(way, attempt.relaxed)) follow(attempt, control_);
  return ends_at(way, std::move(attempt));
}

bool LeastViolation::from_near(std::size_t way, const Mesh& mesh, const GuessCurve& curve) {
  constexpr double kMayGo = 1e-4;  // taste: ten times what counts as met
  if (from(way, mesh, curve)) return true;
  if (best_->relaxed.t > kMayGo) return false;
  found_ = leads_({Foothold{way_, best_->mesh, best_->relaxed.found.z}});
  return found_;
}

bool LeastViolation::closely() {
  if (best_->relaxed.t < kNearly) return found_;
  Attempt closer = *best_;
  follow(closer, control_);
  return ends_at(way_, std::move(closer));
}

bool LeastViolation::confirmed() {
  constexpr double kSame = 0.98;  // taste
  if (best_->relaxed.settled) return true;
  const double before = best_->relaxed.t;
  const Transcription& track = *best_->relaxed.found.track;
  const GuessCurve curve = curve_of(track, best_->relaxed.found.z);
  (void)from(way_, Mesh(track.mesh()), curve);
  return best_->relaxed.t > kSame * before;
}

bool LeastViolation::ends_at(std::size_t way, Attempt attempt) {
  if (attempt.relaxed.t <= kContradiction && !found_) {
    found_ = leads_({Foothold{way, attempt.mesh, attempt.relaxed.found.z}});
  }
  if (!best_ || attempt.relaxed.t < best_->relaxed.t) {
    best_ = std::move(attempt);
    way_ = way;
  }
  return found_;
}

bool LeastViolation::is_new(std::size_t way, const Relaxed& relaxed) {
  constexpr double kSame = 1e-4;  // taste
  const NearEnd end{way, relaxed.t, relaxed.found.objective};
  const auto same = [&](const NearEnd& known) {
    return known.way == end.way && std::fabs(known.t - end.t) <= kSame * known.t &&
           std::fabs(known.objective - end.objective) <= kSame * std::fabs(known.objective);
  };
  if (std::any_of(near_ends_.begin(), near_ends_.end(), same)) return false;
  near_ends_.push_back(end);
  return true;
}

}  // namespace glissade::optimizer
