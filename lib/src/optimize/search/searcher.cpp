#include "optimize/search/searcher.hpp"

#include "optimize/mesh/refined_knots.hpp"
#include "optimize/mesh/switches.hpp"
#include "optimize/search/settling.hpp"
#include "optimize/search/starts.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace glissade::optimizer {
namespace {

// Pieces of the coarse levels before the finest.
constexpr std::size_t kCoarsePieces = 12;  // taste
constexpr std::size_t kMovedLevels = 4;    // budget
// More of them while each wins as much of a share.
constexpr std::size_t kMoreLevels = 8;  // budget
constexpr double kWinsMuch = 2e-5;      // accuracy: twenty times that of a time
// By such a share a smoother track may be slower.
constexpr double kDearer = 1e-7;  // accuracy: below that of a time
// By less of a share nothing is won.
constexpr double kWithoutEffect = 1e-8;  // accuracy: a hundredth of that of a time
// Pieces of the mesh on which a track is looked for that keeps the limits at all.
constexpr std::size_t kRescuePieces = 20;  // taste

bool is_travel_time(const ScaledProblem& problem) {
  return problem.speed_weight == 0.0 && problem.drop_weight == 0.0 && problem.length_weight == 0.0;
}

/// Of a track that need not be fast, but lead to speed or keep it even, any detour may be the better one.
bool is_about_speed(const ScaledProblem& problem) {
  return problem.speed_weight != 0.0 || problem.rides.front().even_speed > 0.0;
}

double entry_share(const ScaledProblem& problem, double core_length) {
  return (problem.lead_in + 0.5 * problem.entry_speed2) / core_length;
}

/// Where the track from the first start is doubted: other starts, which may lead to better ones.
std::vector<GuessCurve> worth_trying(const ScaledProblem& problem, const std::vector<GuessCurve>& curves,
                                     const Found& first, bool got_lost) {
  constexpr double kDoubtful = 0.05;  // taste: slower by such a share than without limits
  std::vector<GuessCurve> more;
  const bool counts_speed = is_about_speed(problem);
  if (got_lost || counts_speed) more.assign(curves.begin() + 1, curves.end());
  // A speed is kept even in bends, and there are many ways to bend.
  if (problem.rides.front().even_speed > 0.0) {
    const std::vector<GuessCurve> scattered = scattered_starts(problem);
    more.insert(more.end(), scattered.begin(), scattered.end());
  }
  if (!counts_speed && !is_travel_time(problem)) return more;
  if (more.empty() && first.objective > straight_time(problem)) more.assign(curves.begin() + 1, curves.end());
  const std::optional<FlyingStart> flying = flying_start(problem);
  // Where speed counts travel times tell nothing; the crest that is flown over at the start may pay there, too.
  const bool may_win = flying && (counts_speed || first.objective > (1.0 + kDoubtful) * flying->travel_time);
  if (may_win) more.push_back(flying->curve);
  return more;
}

}  // namespace

double Searcher::Opening::promise() const {
  return first.found && first.found->feasible(kNearlyFeasible) ? first.found->objective : HUGE_VAL;
}

Searcher::Opening Searcher::opened(const Passages& passages) {
  Opening opening;
  opening.candidate = begun(passages);
  opening.starts = starts(*opening.candidate.rough);
  if (!is_unlimited() && !opening.starts.empty())
    opening.first = coarse(*opening.candidate.rough, opening.starts.front());
  return opening;
}

Candidate Searcher::search(Opening opening, const std::optional<Candidate>& to_beat) {
  Candidate candidate = std::move(opening.candidate);
  const ScaledProblem& scaled_problem = *candidate.problem;
  descents_.begin_margins(scaled_problem);
  to_beat_.reset();
  // Of a sum of unlike things no share tells what is far behind.
  if (to_beat && to_beat->kept && problem_.objective.kind != ObjectiveKind::blend)
    to_beat_ = to_beat->found->objective;
  const bool unlimited = is_unlimited();
  std::vector<Found> others;  // that came to nothing
  // Clipped slopes are often the unclipped ones: what did not do is not tried twice, unless limits were tightened on
  // the way.
  std::vector<std::pair<GuessCurve, Vector>> tried;
  const std::vector<GuessCurve>& curves = opening.starts;
  for (const GuessCurve& start : curves) {
    const std::pair<GuessCurve, Vector> trial(start, descents_.margins());
    if (std::find(tried.begin(), tried.end(), trial) != tried.end()) continue;
    tried.push_back(trial);
    Rough rough;
    if (unlimited) {
      rough.found = from_exact(scaled_problem, start);
    } else {
      rough = tried.size() == 1 ? std::move(opening.first) : coarse(*candidate.rough, start);
    }
    std::optional<Found>& found = rough.found;
    if (found) remember(candidate, *found);
    if (control_.stop()) candidate.stopped = true;
    if (!found || is_behind(*found, false)) continue;
    if (control_.any_track) {
      const Vector margins = descents_.margins();
      mend_any(candidate, found->track->mesh(), found->z);
      descents_.set_margins(margins);
      if (candidate.kept || candidate.stopped) break;
      continue;
    }
    // Only of the first start, or the first that leads to a track: others are tried anyway.
    std::vector<GuessCurve> more;
    if (!unlimited && (tried.size() == 1 || is_about_speed(*candidate.rough)))
      more = worth_trying(*candidate.rough, curves, *found, rough.got_lost);
    if (!unlimited && tried.size() == 1) {
      std::vector<GuessCurve> to_other_runs = promising_runs(*candidate.rough, *found);
      std::move(to_other_runs.begin(), to_other_runs.end(), std::back_inserter(more));
    }
    if (more.empty() || candidate.stopped) {
      refine(candidate, *found, unlimited && scaled_problem.drag == 0.0);
      if (!candidate.kept && !candidate.stopped && candidate.found) others.push_back(std::move(*found));
    } else {
      take_best(candidate, *found, more, others);
      if (rough.got_lost) break;
    }
    // A track that keeps the limits, but is no optimum, may have lost its way: the next start is tried too.
    const bool converged = candidate.kept && candidate.found->residual <= options_.tolerance;
    if (converged || candidate.stopped) break;
  }
  to_beat_.reset();
  // Slower ones, better than none.
  for (const Found& other : others) {
    if (candidate.kept || candidate.stopped) break;
    mend_any(candidate, other.track->mesh(), other.z);
  }
  return candidate;
}

std::vector<GuessCurve> Searcher::promising_runs(const ScaledProblem& problem, const Found& first) {
  constexpr std::size_t kMost = 2;   // budget
  constexpr double kSame = 1e-4;     // taste: of the objective, on coarse meshes
  constexpr double kNotFar = 0.02;   // taste: of the objective, by which what follows may win more
  constexpr double kLoosely = 1e-3;  // taste: what is no optimum on a coarse mesh promises nothing
  if (!(problem.drop_weight > 0.0 || problem.length_weight > 0.0)) return {};
  const auto is_same = [&](double a, double b) { return std::fabs(a - b) <= kSame * std::fabs(b); };
  std::vector<std::pair<double, GuessCurve>> promising;
  for (GuessCurve& start : starts_to_other_runs(problem)) {
    if (control_.stop()) break;
    const std::optional<Found> found = coarse(problem, start).found;
    if (!found || !found->feasible(kNearlyFeasible) || found->residual > kLoosely) continue;
    if (found->objective > first.objective + kNotFar * std::fabs(first.objective)) continue;
    const bool is_known = is_same(found->objective, first.objective) ||
                          std::any_of(promising.begin(), promising.end(), [&](const auto& known) {
                            return is_same(found->objective, known.first);
                          });
    if (!is_known) promising.emplace_back(found->objective, std::move(start));
  }
  std::stable_sort(promising.begin(), promising.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  if (promising.size() > kMost) promising.resize(kMost);
  std::vector<GuessCurve> curves;
  for (auto& [objective, start] : promising) curves.push_back(std::move(start));
  return curves;
}

void Searcher::take_best(Candidate& candidate, Found first, const std::vector<GuessCurve>& more,
                         std::vector<Found>& others) {
  const ScaledProblem& problem = *candidate.rough;
  std::vector<Found> tracks{std::move(first)};
  const auto is_same = [](const Found& a, const Found& b) {
    constexpr double kSame = 1e-6;  // accuracy: that of a time
    return std::fabs(a.objective - b.objective) <= kSame * std::fabs(b.objective);
  };
  for (const GuessCurve& start : more) {
    if (control_.stop()) break;
    std::optional<Found> found = coarse(*candidate.rough, start).found;
    if (!found) continue;
    const bool known =
        std::any_of(tracks.begin(), tracks.end(), [&](const Found& track) { return is_same(track, *found); });
    if (!known && !is_behind(*found, false)) tracks.push_back(*std::move(found));
  }
  // Which is the best one coarse meshes don't tell: some of them have hardly begun to be fast.
  for (Found& track : tracks)
    track = descents_.laid_anew(problem, on_finer_meshes(problem, problem, std::move(track)));
  std::stable_sort(tracks.begin(), tracks.end(), [](const Found& a, const Found& b) {
    const bool keeps = a.feasible(kNearlyFeasible);
    return keeps != b.feasible(kNearlyFeasible) ? keeps : a.objective < b.objective;
  });
  const auto is_converged = [&](const Candidate& end) {
    return end.kept && end.found->residual <= options_.tolerance;
  };
  std::erase_if(tracks, [this](const Found& track) { return is_behind(track, true); });
  for (Found& track : tracks) {
    if (candidate.stopped) return;
    // One that has not come to its end yet may still become the best.
    const bool may_win = track.residual > options_.tolerance && track.feasible(kNearlyFeasible);
    if (is_converged(candidate) && !may_win) continue;
    Candidate end = Candidate::on_problems_of(candidate);
    descents_.begin_margins(problem);
    settle(end, track);
    if (!end.kept) others.push_back(std::move(track));
    const bool stopped = end.stopped;
    const bool counts = !is_converged(candidate) || is_converged(end);
    const bool is_better = !candidate.found || (end.kept && !candidate.kept) ||
                           (is_converged(end) && !is_converged(candidate)) ||
                           (end.kept && end.found->objective < candidate.found->objective);
    if (end.found && counts && is_better) candidate = std::move(end);
    candidate.stopped = stopped;
  }
}

Candidate Searcher::search_from(const Passages& passages, const Mesh& mesh, const Vector& z) {
  return control_.any_track ? mended(passages, mesh, z) : ended(carried_on(passages, mesh, z));
}

Searcher::Stage Searcher::carried_along(const Passages& passages, const Mesh& mesh, const Vector& z) {
  Stage stage{begun(passages), {}, mesh, z};
  const ScaledProblem& problem = *stage.candidate.rough;
  descents_.aim_at(kCoarseTolerance, 12);
  stage.found = descents_.laid_anew(problem, descents_.minimised(problem, mesh, z));
  return stage;
}

Searcher::Stage Searcher::carried_on(const Passages& passages, const Mesh& mesh, const Vector& z) {
  Stage stage{begun(passages), {}, mesh, z};
  const ScaledProblem& problem = *stage.candidate.rough;
  descents_.aim_at(kCoarseTolerance, 12);
  Found found = descents_.minimised(problem, mesh, z);
  stage.found = descents_.laid_anew(problem, on_finer_meshes(problem, problem, std::move(found)));
  remember(stage.candidate, stage.found);
  return stage;
}

Candidate Searcher::ended(Stage stage) {
  descents_.begin_margins(*stage.candidate.problem);
  settle(stage.candidate, std::move(stage.found));
  if (!stage.candidate.kept && !stage.candidate.stopped) mend_any(stage.candidate, stage.mesh, stage.z);
  return std::move(stage.candidate);
}

Candidate Searcher::ended_on(const Candidate& known, Found found) {
  Candidate candidate = Candidate::on_problems_of(known);
  descents_.set_margins(found.rows->margins());
  mending_.mend(candidate, descents_.laid_anew(*candidate.problem, std::move(found)), known.ahead);
  return candidate;
}

Candidate Searcher::mended(const Passages& passages, const Mesh& mesh, const Vector& z) {
  Candidate candidate = begun(passages);
  mend_any(candidate, mesh, z);
  return candidate;
}

void Searcher::mend_any(Candidate& candidate, const Mesh& mesh, const Vector& z) {
  mending_.mend_any(candidate, mesh, z);
}

void Searcher::remember(const Candidate& candidate, const Found& found) {
  constexpr std::size_t kMost = 4;  // budget: of those that are mended where time is over
  if (found.stopped || !found.feasible(options_.limit_tolerance)) return;
  const auto better = [](const auto& a, const auto& b) { return a.second.objective < b.second.objective; };
  std::pair<Candidate, Found> known{Candidate::on_problems_of(candidate), found};
  const auto at = std::upper_bound(known_.begin(), known_.end(), known, better);
  known_.insert(at, std::move(known));
  if (known_.size() > kMost) known_.pop_back();
}

Candidate Searcher::from_known() {
  Candidate candidate;
  candidate.stopped = true;
  // Where rounds that keep a track fast come to nothing, any track will do.
  for (const bool any : {false, true}) {
    for (const auto& [begun, known] : known_) {
      if (candidate.kept) break;
      candidate = begun;
      descents_.set_margins(known.rows->margins());
      Found found = known;
      found.stopped = true;
      control_.any_track = any;
      mending_.mend(candidate, descents_.exactly(*candidate.problem, std::move(found)), {});
      control_.any_track = false;
    }
  }
  return candidate;
}

Candidate Searcher::begun(const Passages& passages) {
  Candidate candidate;
  candidate.problem = std::make_shared<ScaledProblem>(scaled(problem_, passages));
  candidate.rough = std::make_shared<ScaledProblem>(roughly_scaled(problem_, passages));
  descents_.begin_margins(*candidate.problem);
  return candidate;
}

Candidate Searcher::begun_again(const Candidate& known) {
  Candidate candidate = Candidate::on_problems_of(known);
  descents_.begin_margins(*candidate.problem);
  return candidate;
}

bool Searcher::is_unlimited() const {
  Limits limits;
  return problem_.limits == limits && problem_.finish.kind == FinishKind::point &&
         problem_.body.entry_speed == 0.0 && problem_.objective.kind == ObjectiveKind::travel_time &&
         is_sliding_point(problem_.body);
}

std::optional<Found> Searcher::from_exact(const ScaledProblem& problem, const GuessCurve& start) {
  const auto pieces = static_cast<std::size_t>(options_.pieces);
  const Mesh mesh = mesh_with(problem, graded_knots(start, pieces, 0.0), start.length);
  descents_.aim_at_optimum(8);
  Found found = descents_.minimised(problem, mesh, fit(start, Transcription(mesh)));
  return found;
}

Searcher::Rough Searcher::coarse(const ScaledProblem& problem, const GuessCurve& start) {
  tell("coarse track", 0.0);
  descents_.aim_at(kCoarseTolerance, 5);
  Found found = coarsely(problem, start, kCoarsePieces);
  if (found.feasible(kNearlyFeasible) || found.stopped) return {std::move(found)};
  // The descent lost its way, or the mesh is too coarse: look for any track that keeps the limits first.
  const Mesh finer = mesh_with(
      problem, graded_knots(start, kRescuePieces, entry_share(problem, start.length)), start.length);
  control_.most_rounds = 6;
  return {descents_.rescued(problem, finer, fit(start, Transcription(finer))), true};
}

Found Searcher::coarsely(const ScaledProblem& problem, const GuessCurve& start, std::size_t pieces) {
  const Mesh mesh =
      mesh_with(problem, graded_knots(start, pieces, entry_share(problem, start.length)), start.length);
  return descents_.minimised(problem, mesh, fit(start, Transcription(mesh)));
}

void Searcher::refine(Candidate& candidate, Found found, bool unlimited) {
  if (unlimited) {
    mending_.mend(candidate, std::move(found), {});
    return;
  }
  const ScaledProblem& problem = *candidate.rough;
  found = descents_.laid_anew(problem, on_finer_meshes(problem, problem, std::move(found)));
  if (!is_behind(found, true)) settle(candidate, std::move(found));
}

bool Searcher::is_behind(const Found& found, bool on_finest) const {
  constexpr double kFar = 0.25;     // taste: of the objective; finer meshes win some 10 % at most
  constexpr double kFinest = 0.05;  // taste
  const double tolerance = on_finest ? options_.tolerance : kCoarseTolerance;
  const bool is_optimum = found.residual <= tolerance;
  if (!to_beat_ || !found.feasible(kNearlyFeasible) || (!on_finest && !is_optimum)) return false;
  const double share = on_finest && is_optimum ? kFinest : kFar;
  return found.objective > *to_beat_ + share * std::fabs(*to_beat_);
}

void Searcher::settle(Candidate& candidate, Found begun, Promises promises) {
  const ScaledProblem& problem = *candidate.rough;
  Settling settling(problem, descents_, promises);
  Settled track = settling.settled(std::move(begun));
  for (const Found& stage : track.on_the_way) remember(candidate, stage);
  const auto mend_on = [&](Candidate& end_of, Found end) {
    if (!end.stopped) end = descents_.laid_anew(problem, std::move(end));
    end_of.rough_found = end;
    mending_.mend(end_of, descents_.exactly(*end_of.problem, std::move(end)), track.ahead);
  };
  if (!track.moved) {
    mend_on(candidate, std::move(track.found));
    return;
  }
  // The better optimum of the two counts. The other one is mended only where that may be the better: what is mended gets
  // no better.
  Candidate other = Candidate::on_problems_of(candidate);
  mend_on(other, settling.followed(*track.moved));
  const bool is_good = other.kept && descents_.is_optimum(*other.found);
  if (!is_good || !(other.found->objective < track.found.objective)) {
    descents_.begin_margins(problem);
    mend_on(candidate, std::move(track.found));
  }
  const bool stopped = candidate.stopped || other.stopped;
  const bool takes = is_good && (!candidate.kept || other.found->objective < candidate.found->objective);
  if (takes) candidate = std::move(other);
  if (!is_good) candidate.promising = std::move(track.moved);
  candidate.stopped = stopped;
}

Found Searcher::on_finer_meshes(const ScaledProblem& problem, const ScaledProblem& rough, Found found) {
  // A track that only a finer mesh could find is not taken back to a coarser one.
  const std::size_t begun = found.track->mesh().knots.size();
  const std::size_t pieces = std::max(static_cast<std::size_t>(options_.pieces), begun - 1);
  std::vector<std::size_t> levels;
  if (begun <= kMiddlePieces && pieces > kMiddlePieces) levels.push_back(kMiddlePieces);
  if (pieces > kFinerPieces) levels.push_back(kFinerPieces);
  levels.insert(levels.end(), 1 + kMovedLevels, pieces);
  const std::size_t usual = levels.size();
  levels.insert(levels.end(), kMoreLevels, pieces);
  double done = 0.2;
  int hopeless = 0;
  bool is_rough = true;
  for (std::size_t level = 0; level < levels.size() && !found.stopped; ++level) {
    const std::vector<Switch> switches = switches_of(problem, found);
    const bool last_ones = level + kMovedLevels >= usual;
    if (last_ones && settled(switches)) break;
    tell("finer track", done);
    done = std::min(0.9, done + 0.7 / static_cast<double>(usual));
    const bool finest = levels[level] == pieces;
    descents_.aim_at(finest ? kAimed * options_.tolerance : kCoarseTolerance, finest ? 3 : 5);
    const Mesh mesh = mesh_with(problem, refined_knots(*found.track, found.z, switches, levels[level]),
                                core_length_of(found));
    Found next = descents_.on_mesh(finest ? problem : rough, mesh,
                                   fit(curve_of(*found.track, found.z), Transcription(mesh)), found);
    if (!next.feasible(kNearlyFeasible) && (next.stopped || found.feasible(kNearlyFeasible))) {
      // A mesh on which the search gets lost is no reason to give a track away.
      found.stopped = next.stopped;
      // On a mesh that the same track lays once more it ends where it has ended.
      while (level + 1 < levels.size() && levels[level + 1] == levels[level]) ++level;
      continue;
    }
    constexpr double kLess = 0.7;  // taste
    hopeless += !next.feasible(kHopeless) && next.violation > kLess * found.violation ? 1 : 0;
    const double dearer = next.objective - found.objective;
    const double size = std::fabs(found.objective);
    const bool pays = descents_.is_optimum(next) && dearer <= kDearer * size;
    if (last_ones && descents_.is_optimum(found) && !pays) break;
    // Where the places at which limits change over move without effect they need not be followed.
    const bool still =
        last_ones && descents_.is_optimum(found) && pays && std::fabs(dearer) <= kWithoutEffect * size;
    found = std::move(next);
    is_rough = !finest;
    const bool goes_on = level + 1 < usual || (pays && -dearer > kWinsMuch * size);
    if (still || hopeless > 1 || !goes_on) break;
  }
  if (!is_rough) return found;
  descents_.aim_at_optimum(3);
  return descents_.minimised(problem, found.track->mesh(), found.z, &found);
}

}  // namespace glissade::optimizer
