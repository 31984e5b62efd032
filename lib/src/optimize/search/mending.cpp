#include "optimize/search/mending.hpp"

#include "glissade/centerline/clothoid_spline.hpp"

#include "optimize/mesh/refined_knots.hpp"
#include "optimize/mesh/refinement.hpp"
#include "optimize/search/held_places.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <utility>

namespace glissade::optimizer {
namespace {

// By more than such a share a track that follows a load more closely is another one.
constexpr double kElsewhere = 1e-5;    // accuracy: ten times that of a time
constexpr int kTighteningRounds = 20;  // budget
// So many of them, short ones, once the search has been asked to end.
constexpr int kGraceRounds = 6;  // budget
constexpr int kGraceEffort = 2;  // budget
// In all of them together.
constexpr int kGraceEvaluations = 100;  // budget: an eighth of a second
// In the first of them limits are held at the places that the referee names; later they are tightened.
constexpr int kHoldingRounds = 8;  // taste
// In so many the pieces around places that are dear to hold are halved.
constexpr int kHalvingRounds = 2;  // budget
// In so many a highest load is held where it is exceeded by much more than elsewhere.
constexpr int kPeakRounds = 3;  // budget
// In so many a curvature that follows the load more closely is tried where a body lifts off.
constexpr int kFollowingRounds = 3;  // budget
// A track that then still breaks a limit at a station by more than kHopeless is given up: tighter limits are no
// easier.
constexpr int kPatientRounds = 2;  // budget
// A load that falls below none by less between two stations is mended by a greater margin, a deeper fall by
// holding the load there: next to a jump it is deep, and short.
constexpr double kShallow = 1e-5;  // taste
// By what is missing and a little more, since the track moves.
constexpr double kTightening = 1.3;  // taste
// A body that stalled between two stations is kept this much faster, squared, over free fall.
constexpr double kStallMargin = 1e-5;  // taste: five times what counts as lying still

CenterlinePtr track_of(const ScaledProblem& problem, const Found& found) {
  const Layout& layout = found.track->layout();
  const Mesh& mesh = found.track->mesh();
  std::vector<ClothoidSegment> segments;
  if (mesh.lead_in > 0.0) segments.push_back({mesh.lead_in * problem.chord, 0.0, 0.0});
  const std::vector<FineKnot>& fine = found.track->fine_knots();
  std::size_t next = 0;
  for (std::size_t i = 0; i + 1 < layout.knots; ++i) {
    const double length = found.track->stretch(found.z, i);
    const double scale = 1.0 / (length * problem.chord);
    double sigma = mesh.knots[i];
    double turn = found.z[layout.turn(i)];
    const auto add_up_to = [&](double to, double turn_there) {
      // Two knots at one place are a jump of the curvature.
      if (to > sigma)
        segments.push_back({(to - sigma) * length * problem.chord, turn * scale, turn_there * scale});
      sigma = to;
      turn = turn_there;
    };
    for (; next < fine.size() && fine[next].piece == i; ++next) {
      add_up_to(fine[next].sigma, found.track->fine_turn(found.z, next));
    }
    add_up_to(mesh.knots[i + 1], found.z[layout.turn(i + 1)]);
  }
  if (mesh.lead_out > 0.0) segments.push_back({mesh.lead_out * problem.chord, 0.0, 0.0});
  return std::make_shared<ClothoidSpline>(Angle::from_radians(found.z[layout.angle()]), std::move(segments));
}

bool asks_for_no_more(const Found& a, const Found& b) {
  return a.rows->margins() == b.rows->margins() &&
         a.track->mesh().extra_breaks == b.track->mesh().extra_breaks;
}

/// How a highest load is exceeded: between all fine knots by about as much, and at a few places, next to jumps, by more.
struct Exceeded {
  double usual = 0.0;         ///< the most of it but for these places, in scales
  std::vector<double> peaks;  ///< arc lengths [m]
};
Exceeded exceeded(const referee::Judgement& judgement, const LimitName& limit) {
  constexpr double kMore = 3.0;  // taste: than the median
  Vector by;
  for (const referee::Broken& broken : judgement.broken) {
    if (broken.limit == limit) by.push_back(broken.violation);
  }
  Exceeded result;
  if (by.empty()) return result;
  const auto middle = by.begin() + static_cast<std::ptrdiff_t>(by.size() / 2);
  std::nth_element(by.begin(), middle, by.end());
  const double median = *middle;
  for (const referee::Broken& broken : judgement.broken) {
    if (broken.limit != limit) continue;
    if (broken.violation > kMore * median) {
      result.peaks.push_back(broken.where);
    } else {
      result.usual = std::max(result.usual, broken.violation);
    }
  }
  return result;
}

/// The same track with two pieces for each on which a body lifts off.
Found halved_at(const std::vector<LiftOff>& lifts, Found found) {
  const Mesh& mesh = found.track->mesh();
  std::vector<bool> halved(mesh.knots.size() - 1, false);
  for (const LiftOff& lift : lifts) {
    const auto above = std::upper_bound(mesh.knots.begin() + 1, mesh.knots.end() - 1, lift.sigma);
    halved[static_cast<std::size_t>(above - mesh.knots.begin()) - 1] = true;
  }
  MeshTrack finer = with_halved_pieces(*found.track, found.z, halved);
  found.track = std::make_shared<const Transcription>(finer.mesh);
  found.z = std::move(finer.z);
  return found;
}

}  // namespace

void Mending::mend(Candidate& candidate, Found found, const Ahead& ahead, const Vector& places) {
  const ScaledProblem& problem = *candidate.problem;
  const std::function<bool()> stop = control_.stop;
  candidate.stopped = candidate.stopped || found.stopped;
  if (progress_) progress_("referee", 0.9);
  HeldPlaces held(places);
  int rides_to_end = 0;  // of those that end early the rest is not known
  std::optional<int> grace_ends;
  for (int round = 0; round < kTighteningRounds; ++round) {
    const CenterlinePtr track = track_of(problem, found);
    const referee::Judgement judgement = referee::judge_track(asked_, track, referee::kRefereeSamples);
    take_if_better(candidate, found, ahead, track, judgement);
    const bool kept = judgement.arrived && judgement.worst <= options_.limit_tolerance;
    if (kept) break;
    if (found.stopped) {
      // Asked to end on a track that all but keeps its limits: a little more work makes it one that does.
      if (!found.feasible(kNearlyFeasible) || round >= kGraceRounds) break;
      if (!grace_ends) grace_ends = control_.evaluations + kGraceEvaluations;
      if (control_.evaluations > *grace_ends) break;
      control_.stop = [&] { return control_.evaluations > *grace_ends; };
    }
    if (round >= kPatientRounds && !found.feasible(kHopeless)) break;
    const auto share_of = [&](double place) { return found.track->sigma_at(found.z, place / problem.chord); };
    std::vector<LiftOff> lifts;
    if (judgement.lift_off) {
      lifts = lift_offs_of(problem, found);
      lifts.push_back({share_of(*judgement.lift_off), 0.0});
      const bool may_follow = round < kFollowingRounds && !found.stopped && !control_.any_track;
      if (auto next = may_follow ? following_closely(problem, found, lifts) : std::nullopt) {
        found = std::move(*next);
        continue;
      }
    }
    tighten(problem, judgement, lifts, rides_to_end);
    if (control_.any_track && !lifts.empty()) found = halved_at(lifts, found);
    Mesh mesh = mesh_again(found);
    for (const double place : places_to_hold(problem, judgement, rides_to_end))
      held.add(share_of(place), mesh.knots);
    for (const LiftOff& lift : lifts) {
      if (lift.depth > kShallow) held.add(lift.sigma, mesh.knots);
    }
    if (judgement.arrived) ++rides_to_end;
    mesh.extra_breaks = held.places();
    descents_.aim_at_optimum(found.stopped ? kGraceEffort : 3);
    const bool stopped = found.stopped;
    Found next = descents_.laid_anew(problem, descents_.on_mesh(problem, mesh, found.z, found));
    if (round < kHalvingRounds) next = cheaper_of(problem, std::move(next), found, mesh);
    control_.stop = stop;
    next.stopped = next.stopped || stopped;
    // Where only short ways are gone, and none was, none will be; nor where no more is asked for than the round before.
    const bool is_same = next.z == found.z;
    const bool asks_same = is_same && asks_for_no_more(next, found);
    const bool tightens = rides_to_end > kHoldingRounds;
    const bool stays = is_same && (control_.is_close || (asks_same && tightens)) && !found.stopped &&
                       !descents_.is_optimum(next);
    // Places that are held already are no help.
    if (asks_same && judgement.arrived) rides_to_end = std::max(rides_to_end, kHoldingRounds);
    found = std::move(next);
    if (stays) break;
  }
  candidate.stopped = candidate.stopped || found.stopped;
}

void Mending::take_if_better(Candidate& candidate, const Found& found, const Ahead& ahead,
                             const CenterlinePtr& track, const referee::Judgement& judgement) const {
  const bool kept = judgement.arrived && judgement.worst <= options_.limit_tolerance;
  const bool better = !candidate.found || (kept && !candidate.kept) ||
                      (kept == candidate.kept && found.objective < candidate.found->objective);
  if (!better) return;
  candidate.ahead = ahead;
  candidate.found = found;
  candidate.track = track;
  candidate.judgement = judgement;
  candidate.kept = kept;
}

Found Mending::cheaper_of(const ScaledProblem& problem, Found next, const Found& found, const Mesh& holding) {
  constexpr double kMuch = 5e-7;  // accuracy: half that of a time
  if (control_.any_track || control_.is_close || !descents_.is_optimum(found) || !descents_.is_optimum(next))
    return next;
  if (!(next.objective - found.objective > kMuch * std::fabs(found.objective))) return next;
  std::vector<LiftOff> places;
  for (const double sigma : holding.extra_breaks) places.push_back({sigma, 0.0});
  const Found halved = halved_at(places, found);
  Mesh mesh = mesh_again(halved);
  mesh.extra_breaks = holding.extra_breaks;
  Found finer = descents_.laid_anew(problem, descents_.on_mesh(problem, mesh, halved.z, found));
  return descents_.is_optimum(finer) && finer.objective < next.objective ? finer : next;
}

std::optional<Found> Mending::following_closely(const ScaledProblem& problem, const Found& found,
                                                const std::vector<LiftOff>& lifts) {
  Vector lifting;
  for (const LiftOff& lift : lifts) lifting.push_back(lift.sigma);
  const std::optional<Mesh> closer = following_limits(problem, found, lifting);
  if (!closer || closer->fine.size() <= found.track->mesh().fine.size()) return std::nullopt;
  // Steps of our own stay in the valley mostly. Another one may be dearer, for which the load is no reason.
  descents_.aim_at_optimum(0);
  Found next = descents_.minimised(problem, *closer, found.z, &found);
  const bool stays = next.objective <= found.objective + kElsewhere * std::fabs(found.objective);
  const bool takes = (next.stopped || stays) && next.feasible(options_.limit_tolerance);
  return takes ? std::optional(std::move(next)) : std::nullopt;
}

void Mending::tighten(const ScaledProblem& problem, const referee::Judgement& judgement,
                      const std::vector<LiftOff>& lifts, int round) {
  Vector margins = descents_.margins();
  for (std::size_t i = 0; i < problem.limits.size(); ++i) {
    const LimitSpec& limit = problem.limits[i];
    if (limit.side == 0) continue;
    const bool contact = limit.measure == Measure::normal_load && limit.side < 0;
    if (contact && judgement.lift_off) {
      double shallow = 0.0;
      for (const LiftOff& lift : lifts) {
        if (lift.depth <= kShallow) shallow = std::max(shallow, lift.depth);
      }
      margins[i] = std::max(2.0 * margins[i], margins[i] + kTightening * shallow);
      continue;
    }
    const bool keeps_moving = limit.measure == Measure::arrival || limit.name.id == LimitId::no_choking;
    if (keeps_moving && judgement.stall) {
      margins[i] = std::max(kStallMargin, 2.0 * margins[i]);
      continue;
    }
    const bool load = is_highest_load(limit);
    if (round < kHoldingRounds && !load) continue;
    const LimitCheck* check = judgement.find(limit.name);
    if (check == nullptr) continue;
    const bool holds_peaks = load && round < kPeakRounds;
    const double violation =
        holds_peaks ? exceeded(judgement, limit.name).usual : check->violation / check->scale;
    if (violation > 0.5 * options_.limit_tolerance) margins[i] += kTightening * violation;
  }
  descents_.set_margins(std::move(margins));
}

std::vector<double> Mending::places_to_hold(const ScaledProblem& problem, const referee::Judgement& judgement,
                                            int round) const {
  std::vector<double> places;
  if (judgement.lift_off) places.push_back(*judgement.lift_off);
  if (judgement.stall) places.push_back(*judgement.stall);
  if (round >= kHoldingRounds) return places;
  for (const LimitSpec& limit : problem.limits) {
    if (!is_highest_load(limit) || round >= kPeakRounds) continue;
    for (const double where : exceeded(judgement, limit.name).peaks) places.push_back(where);
  }
  for (const referee::Broken& broken : judgement.broken) {
    const bool load = std::any_of(problem.limits.begin(), problem.limits.end(), [&](const LimitSpec& limit) {
      return limit.name == broken.limit && is_highest_load(limit);
    });
    if (!load && broken.violation > 0.5 * options_.limit_tolerance) places.push_back(broken.where);
  }
  return places;
}

void Mending::mend_any(Candidate& candidate, const Mesh& mesh, const Vector& z) {
  const ScaledProblem& problem = *candidate.problem;
  const bool any = std::exchange(control_.any_track, true);
  descents_.begin_margins(problem);
  candidate.rough_found.reset();
  Found found = descents_.kept_on(problem, mesh, z);
  // What is left over there may be the mesh's fault.
  constexpr std::size_t kFiner[] = {32, 48};  // taste
  for (const std::size_t pieces : kFiner) {
    if (found.feasible(control_.limit_tolerance) || !found.feasible(kNearlyFeasible) || control_.stop())
      break;
    const Mesh finer =
        mesh_with(problem, refined_knots(*found.track, found.z, {}, pieces), core_length_of(found));
    found = descents_.kept_on(problem, finer, fit(curve_of(*found.track, found.z), Transcription(finer)));
  }
  mend(candidate, descents_.laid_anew(problem, std::move(found)), {});
  control_.any_track = any;
}

}  // namespace glissade::optimizer
