#include "optimize/search/settling.hpp"

#include "optimize/mesh/free_spans.hpp"
#include "optimize/mesh/held_arcs.hpp"
#include "optimize/mesh/moved_knots.hpp"
#include "optimize/mesh/refinement.hpp"
#include "optimize/search/held_places.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace glissade::optimizer {
namespace {

/// Whether a highest load binds. Not where bends ever tighter at the start win more than what is left there.
bool lies_at_highest_load(const ScaledProblem& problem, const Found& found) {
  if (starts_with_crest(problem)) return false;
  for (std::size_t i = 0; i < found.active.size(); ++i) {
    if (found.inequality[i] > 0.0 && is_highest_load(problem.limits[found.active[i].limit])) return true;
  }
  return false;
}

}  // namespace

Settled Settling::settled(Found found) {
  Settled track;
  track.on_the_way.push_back(found);
  if (!found.stopped) found = held_between(std::move(found));
  if (!found.stopped) found = with_far_jumps_moved(std::move(found));
  if (!found.stopped) found = followed(std::move(found));
  track.on_the_way.push_back(found);
  if (!found.stopped) found = bent_at_ends(std::move(found));
  if (!found.stopped) found = halved(std::move(found), track.ahead);
  track.on_the_way.push_back(found);
  track.found = std::move(found);
  if (descents_.is_optimum(track.found) && !is_smooth(problem_)) track.moved = with_jumps_at_rest(track);
  return track;
}

Found Settling::held_between(Found found) {
  constexpr int kMostRounds = 4;  // budget
  if (!descents_.is_optimum(found) || control_.any_track) return found;
  HeldPlaces held(found.track->mesh().extra_breaks);
  for (int round = 0; round < kMostRounds && !control_.stop(); ++round) {
    const Vector places = exceeded_caps_of(problem_, found, options_.limit_tolerance);
    if (places.empty()) break;
    Mesh mesh = mesh_again(found);
    for (const double place : places) held.add(place, mesh.knots);
    mesh.extra_breaks = held.places();
    descents_.aim_at_optimum(3);
    Found next = descents_.laid_anew(problem_, descents_.on_mesh(problem_, mesh, found.z, found));
    if (!descents_.is_optimum(next)) break;
    found = std::move(next);
  }
  return found;
}

// On a mesh that follows no load yet it costs little, and what follows begins in the better valley.
Found Settling::with_far_jumps_moved(Found found) {
  if (!descents_.is_optimum(found) || !can_free_spans(problem_)) return found;
  KnotMoves moves;
  moves.worth = moves.far;
  std::optional<Found> moved = with_moved_knots(problem_, found, options_.tolerance, control_, moves).found;
  return moved ? std::move(*moved) : found;
}

Found Settling::followed(Found found) {
  constexpr int kMostRounds = 3;  // budget
  constexpr double kPays = 1e-7;  // accuracy: below that of a time
  for (int round = 0; round < kMostRounds; ++round) {
    const std::optional<Mesh> mesh = following_limits(problem_, found);
    if (!mesh) break;
    descents_.aim_at_optimum(0);
    Found next = descents_.minimised(problem_, *mesh, found.z, &found);
    if (next.stopped || next.residual > options_.tolerance || !next.feasible(options_.limit_tolerance)) break;
    const double won = found.objective - next.objective;
    found = std::move(next);
    if (std::fabs(won) < kPays * std::fabs(found.objective)) break;
  }
  return found;
}

Found Settling::bent_at_ends(Found found) {
  constexpr double kPays = 1e-6;  // accuracy: that of a time
  // Where speed counts a short bend may carry less at the finish; a body whose centre is high has a shorter way over bends at either end.
  const bool is_high = problem_.rides[problem_.objective_ride].height > 0.0;
  const bool may_pay = is_high || (problem_.speed_weight != 0.0 && problem_.lead_out == 0.0);
  if (!may_pay || is_smooth(problem_) || !descents_.is_optimum(found)) return found;
  const Ends ends = is_high && !starts_with_crest(problem_) ? Ends::both : Ends::finish;
  const MeshTrack finer = with_short_pieces_at(ends, *found.track, found.z);
  const Outlook outlook =
      look_ahead(problem_, finer.mesh, finer.z, descents_.margins(), control_, found, RowsAhead::near);
  if (!(outlook.won > kPays * std::fabs(found.objective))) return found;
  descents_.aim_at_optimum(0);
  Found next = descents_.minimised(problem_, finer.mesh, finer.z, &found);
  return descents_.is_optimum(next) && next.objective < found.objective ? next : found;
}

Found Settling::halved(Found found, Ahead& ahead) {
  constexpr int kMostRounds = 6;  // budget
  // Under a limit on the rate of curvature no jump tells where knots belong: halving alone makes prices exact.
  const bool smooth = is_smooth(problem_);
  // Along a highest load halving wins six to forty times what one program promises.
  constexpr double kLeftLoaded = 3e-8;  // measured: what is promised where two rounds more win less than 1e-6
  const double left_at_most = smooth ? 1e-8 : lies_at_highest_load(problem_, found) ? kLeftLoaded : 1e-6;
  constexpr double kLostAtMost = 5e-7;  // accuracy: half that of a time
  // Where curvature may jump, what mending takes for less is no worse than on a finer mesh.
  constexpr double kLostAmongJumps = 1e-3;  // taste
  constexpr std::size_t kMostPieces = 120;  // budget
  constexpr double kKept = 0.1;             // taste
  constexpr int kMostIdle = 1;     // budget: halves that win nothing by themselves may let the next ones
  constexpr double kSpread = 0.5;  // taste
  constexpr double kTold = 1e-5;   // accuracy: ten times that of a time
  constexpr std::size_t kMostSpread = 80;  // budget
  int idle = 0;
  double before = HUGE_VAL;
  for (int round = 0; round < kMostRounds; ++round) {
    const Remainder left = remainder_of(problem_, found, control_);
    ahead.finer_mesh_wins = left.objective / std::fabs(found.objective);
    ahead.multipliers = left.by_limit;
    // What a curvature of few pieces breaks between its stations is followed by finer ones.
    const double lost_at_most = smooth ? kLostAtMost : kLostAmongJumps;
    const bool breaks = left.lost > lost_at_most * std::fabs(found.objective);
    if (!breaks && left.objective <= left_at_most * std::fabs(found.objective)) break;
    // A finer mesh hardly ever has so much left: where a program promises it, its step leads away from the track.
    const bool is_doubtful = left.objective > kMostPromised * std::fabs(found.objective);
    if (is_doubtful && promises_ == Promises::left) break;
    if (found.track->mesh().knots.size() > kMostPieces) break;
    // A few pieces that promise the most of it, and win nothing, are not where it is to be won.
    const bool spread = smooth && found.track->mesh().knots.size() <= kMostSpread &&
                        left.objective > kSpread * std::max(before, kTold * std::fabs(found.objective));
    before = left.objective;
    const MeshTrack finer = breaks || spread || is_doubtful
                                ? with_all_halved(*found.track, found.z)
                                : with_halved_pieces(*found.track, found.z, worth_halving(left));
    descents_.aim_at_optimum(0);
    Found next = descents_.minimised(problem_, finer.mesh, finer.z, &found);
    if (next.stopped || next.residual > options_.tolerance || !next.feasible(options_.limit_tolerance)) break;
    if (is_doubtful && !(found.objective - next.objective > kKept * left.objective)) break;
    next = followed(std::move(next));
    const double won = found.objective - next.objective;
    found = std::move(next);
    // What is promised again and again but not won is not there; prices may gain from it all the same.
    const bool pays = won >= kKept * left_at_most * std::fabs(found.objective);
    idle = pays ? 0 : idle + 1;
    if (!smooth && idle > kMostIdle) break;
  }
  return found;
}

std::optional<Found> Settling::with_jumps_at_rest(Settled& track) {
  constexpr int kMostRounds = 4;         // budget
  constexpr int kMostEvaluations = 500;  // budget: a sixth of what a hard search takes
  constexpr double kFar = 1e-4;   // taste: of the objective; jumps that win less lie on a mesh that fits them
  constexpr double kPays = 1e-5;  // accuracy: ten times that of a time
  Found& found = track.found;
  const auto move = [&] {
    found = with_tight_corners(with_short_ramps(std::move(found)));
    MovedKnots moves = with_moved_knots(problem_, found, options_.tolerance, control_);
    track.ahead.moves_promise = moves.promised / std::fabs(found.objective);
    return std::move(moves.found);
  };
  std::optional<Found> moved = move();
  const int begun = control_.evaluations;
  double before = found.objective;
  for (int round = 0; round < kMostRounds && moved; ++round) {
    if (control_.stop() || control_.evaluations - begun > kMostEvaluations) break;
    if (!(before - moved->objective > (round == 0 ? kFar : kPays) * std::fabs(before))) break;
    before = moved->objective;
    // Where jumps lie elsewhere other pieces are too long, and what they win may be taken again between stations.
    Found next = halved(held_between(followed(*moved)), track.ahead);
    if (!descents_.is_optimum(next)) break;
    const double promised = track.ahead.moves_promise;
    std::swap(found, next);
    std::optional<Found> again = move();
    if (again && again->objective < before) {
      moved = std::move(again);
    } else if (found.objective < before) {
      moved = found;
    } else {
      track.ahead.moves_promise = promised;
      found = std::move(next);
      break;
    }
  }
  return moved;
}

Found Settling::with_short_ramps(Found found) {
  const std::optional<MeshTrack> narrow = with_narrow_jumps(*found.track, found.z);
  if (!narrow) return found;
  descents_.aim_at_optimum(0);
  Found next = descents_.minimised_closely(problem_, narrow->mesh, narrow->z, found);
  return descents_.is_optimum(next) && next.objective < found.objective ? next : found;
}

Found Settling::with_tight_corners(Found found) {
  constexpr int kMostRounds = 4;  // budget: each wins a quarter of what the one before did
  constexpr double kPays = 5e-7;  // accuracy: half that of a time
  for (int round = 0; round < kMostRounds && !control_.stop(); ++round) {
    const std::optional<MeshTrack> tighter = with_tighter_corners(*found.track, found.z);
    if (!tighter) break;
    descents_.aim_at_optimum(0);
    Found next = descents_.minimised(problem_, tighter->mesh, tighter->z, &found);
    if (!descents_.is_optimum(next) || !(next.objective < found.objective)) break;
    const double won = found.objective - next.objective;
    found = std::move(next);
    if (won < kPays * std::fabs(found.objective)) break;
  }
  return found;
}

}  // namespace glissade::optimizer
