// The facade: scales the problem, searches coarse to fine on every way past the keep-outs, lets the referee
// judge, and explains the end.

#include "glissade/optimize/optimize.hpp"

#include "glissade/centerline/clothoid_spline.hpp"
#include "glissade/core/error.hpp"

#include "optimize/end_conflict.hpp"
#include "optimize/infeasibility.hpp"
#include "optimize/least_violation.hpp"
#include "optimize/load_arcs.hpp"
#include "optimize/prices.hpp"
#include "optimize/refinement.hpp"
#include "optimize/scaled_problem.hpp"
#include "optimize/search.hpp"
#include "optimize/starts.hpp"
#include "optimize/switches.hpp"
#include "referee/judgement.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <optional>

namespace glissade {
namespace optimizer {
namespace {

using Clock = std::chrono::steady_clock;

// Pieces of the coarse levels before the finest.
constexpr std::size_t kCoarsePieces = 12;
constexpr std::size_t kMiddlePieces = 16;
constexpr std::size_t kFinerPieces = 24;
constexpr std::size_t kMovedLevels = 4;
// By such a share a smoother track may be slower.
constexpr double kDearer = 1e-7;
// By less of a share nothing is won.
constexpr double kWithoutEffect = 1e-8;
// Pieces of the mesh on which a track is looked for that keeps the limits at all.
constexpr std::size_t kRescuePieces = 20;
constexpr double kCoarseTolerance = 1e-3;
// A coarse track that breaks its limits by less is carried on to a finer mesh.
constexpr double kNearlyFeasible = 1e-3;
// The lowest load is kept this far above its bound, in g: a body that weighs nothing at all has left the
// track.
constexpr double kContactMargin = 1e-6;
constexpr int kTighteningRounds = 12;
// So many of them, short ones, once the search has been asked to end.
constexpr int kGraceRounds = 6;
constexpr int kGraceEffort = 2;
// In the first of them limits are held at the places that the referee names; later they are tightened.
constexpr int kHoldingRounds = 4;
// In so many a curvature that follows the load more closely is tried where a body lifts off.
constexpr int kFollowingRounds = 3;
// A track that then still breaks a limit at a station by more than kNearlyFeasible is given up: tighter
// limits are no easier.
constexpr int kPatientRounds = 3;
// A load that falls below none by less between two stations is mended by a greater margin, a deeper fall by
// holding the load there: next to a jump it is deep, and short.
constexpr double kShallow = 1e-5;
// By what is missing and a little more, since the track moves.
constexpr double kTightening = 1.3;
// A body that stalled between two stations is kept this much faster, squared, over free fall.
constexpr double kStallMargin = 1e-5;
constexpr std::size_t kMostPassages = 16;

CenterlinePtr track_of(const ScaledProblem& problem, const Found& found) {
  const Layout& layout = found.track->layout();
  const Mesh& mesh = found.track->mesh();
  const double length = found.z[layout.length()];
  std::vector<ClothoidSegment> segments;
  if (mesh.lead_in > 0.0) segments.push_back({mesh.lead_in * problem.chord, 0.0, 0.0});
  const double scale = 1.0 / (length * problem.chord);
  const std::vector<FineKnot>& fine = found.track->fine_knots();
  std::size_t next = 0;
  for (std::size_t i = 0; i + 1 < layout.knots; ++i) {
    double sigma = mesh.knots[i];
    double turn = found.z[layout.turn(i)];
    const auto add_up_to = [&](double to, double turn_there) {
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

/// Whether the rate of curvature is limited: then nothing jumps.
bool is_smooth(const ScaledProblem& problem) {
  return std::any_of(problem.limits.begin(), problem.limits.end(),
                     [](const LimitSpec& limit) { return limit.measure == Measure::curvature_rate; });
}

/// Whether the fastest track would turn down at once from where a limit on the entry holds it: a body at rest
/// loses nothing by that, the tighter the crest the better, and no crest is the tightest. How tight it may be is
/// then up to the mesh, which has to be the same there for every such problem.
bool starts_with_crest(const ScaledProblem& problem) {
  if (problem.entry_speed2 > 0.0 || problem.lead_in > 0.0) return false;
  bool held = false;
  for (const LimitSpec& limit : problem.limits) {
    if (limit.measure == Measure::curvature_rate) return false;
    held = held || (limit.measure == Measure::entry_slope_angle && limit.side >= 0);
  }
  return held;
}

/// Knots in shares of the core that do not depend on the track found: from a hundred-millionth on, each this factor
/// behind the one before.
Vector with_crest_knots(const Vector& knots) {
  constexpr double kFirst = 1e-8;
  constexpr double kFactor = 4.0;
  constexpr double kLast = 2e-3;
  Vector result{0.0};
  double next = kFirst;
  for (; next < kLast; next *= kFactor) result.push_back(next);
  for (const double knot : knots) {
    if (knot > 0.75 * next) result.push_back(knot);
  }
  return result;
}

/// One way past the keep-outs, searched to its end.
struct Candidate {
  std::shared_ptr<ScaledProblem> problem;
  std::optional<Found> found;
  CenterlinePtr track;
  referee::Judgement judgement;
  bool kept = false;  ///< the referee finds every limit kept
  bool stopped = false;
};

class Searcher {
 public:
  Searcher(const Problem& problem, const OptimizeOptions& options, SearchControl& control,
           const Progress& progress)
      : problem_(problem), options_(options), control_(control), progress_(progress) {}

  /// From the product's own starts.
  [[nodiscard]] Candidate search(const Passages& passages) {
    Candidate candidate = begun(passages);
    const ScaledProblem& scaled_problem = *candidate.problem;
    const bool unlimited = is_unlimited();
    // Clipped slopes are often the unclipped ones: what led nowhere is not tried twice.
    std::vector<GuessCurve> lost;
    for (const GuessCurve& start : starts(scaled_problem)) {
      if (std::find(lost.begin(), lost.end(), start) != lost.end()) continue;
      std::optional<Found> found =
          unlimited ? from_exact(scaled_problem, start) : coarse(scaled_problem, start);
      if (control_.stop()) candidate.stopped = true;
      if (!found) lost.push_back(start);
      if (!found) continue;
      // It tightens the limits, with which a start must be tried anew.
      lost.clear();
      refine(candidate, *found, unlimited);
      // A track that keeps the limits, but is no optimum, may have lost its way: the next start is tried too.
      const bool converged = candidate.kept && candidate.found->residual <= options_.tolerance;
      if (converged || candidate.stopped) break;
    }
    return candidate;
  }

  /// From a track that keeps the limits.
  [[nodiscard]] Candidate search_from(const Passages& passages, const Mesh& mesh, const Vector& z) {
    Candidate candidate = begun(passages);
    aim_at(kCoarseTolerance, 12);
    const Found found = minimise(*candidate.problem, mesh, z, margins_, control_);
    refine(candidate, found, false);
    return candidate;
  }

 private:
  [[nodiscard]] Candidate begun(const Passages& passages) {
    Candidate candidate;
    candidate.problem = std::make_shared<ScaledProblem>(scaled(problem_, passages));
    const std::vector<LimitSpec>& limits = candidate.problem->limits;
    margins_.assign(limits.size(), 0.0);
    for (std::size_t i = 0; i < margins_.size(); ++i) {
      if (limits[i].measure == Measure::normal_load && limits[i].side < 0) margins_[i] = kContactMargin;
    }
    return candidate;
  }

  /// Only what every track obeys: the mesh can then be laid by the exact solution.
  [[nodiscard]] bool is_unlimited() const {
    Limits limits;
    return problem_.limits == limits && problem_.finish.kind == FinishKind::point &&
           problem_.body.entry_speed == 0.0 && problem_.objective.kind == ObjectiveKind::travel_time &&
           is_sliding_point(problem_.body);
  }

  [[nodiscard]] Mesh mesh_with(const ScaledProblem& problem, Vector knots, double core_length) const {
    if (starts_with_crest(problem)) knots = with_crest_knots(knots);
    Mesh mesh = mesh_of(problem, std::move(knots), core_length);
    mesh.extra_breaks = breaks_of(problem, core_length);
    return mesh;
  }

  /// Where a limit begins to hold.
  [[nodiscard]] static Vector breaks_of(const ScaledProblem& problem, double core_length) {
    if (!(problem.lowest_speed_from > problem.lead_in)) return {};
    const double sigma = (problem.lowest_speed_from - problem.lead_in) / core_length;
    return sigma < 1.0 ? Vector{sigma} : Vector{};
  }

  [[nodiscard]] static double entry_share(const ScaledProblem& problem, double core_length) {
    return (problem.lead_in + 0.5 * problem.entry_speed2) / core_length;
  }

  [[nodiscard]] std::optional<Found> from_exact(const ScaledProblem& problem, const GuessCurve& start) {
    const auto pieces = static_cast<std::size_t>(options_.pieces);
    const Mesh mesh = mesh_with(problem, graded_knots(start, pieces, 0.0), start.length);
    aim_at(options_.tolerance, 8);
    Found found = minimise(problem, mesh, fit(start, Transcription(mesh)), margins_, control_);
    return found;
  }

  [[nodiscard]] std::optional<Found> coarse(const ScaledProblem& problem, const GuessCurve& start) {
    tell("coarse track", 0.0);
    const Mesh mesh = mesh_with(
        problem, graded_knots(start, kCoarsePieces, entry_share(problem, start.length)), start.length);
    aim_at(kCoarseTolerance, 5);
    Found found = minimise(problem, mesh, fit(start, Transcription(mesh)), margins_, control_);
    if (found.feasible(kNearlyFeasible) || found.stopped) return found;
    // The descent lost its way, or the mesh is too coarse: look for any track that keeps the limits first.
    const Mesh finer = mesh_with(
        problem, graded_knots(start, kRescuePieces, entry_share(problem, start.length)), start.length);
    control_.most_rounds = 6;
    return rescued(problem, finer, fit(start, Transcription(finer)));
  }

  /// By way of any track that keeps the limits. @return nothing where none comes close
  [[nodiscard]] std::optional<Found> rescued(const ScaledProblem& problem, const Mesh& mesh,
                                             const Vector& beginning) {
    const Relaxed relaxed =
        least_violation(problem, mesh, beginning, Elastic::all(problem.limits.size()), margins_, control_);
    if (relaxed.t > kNearlyFeasible) return std::nullopt;
    Found found = minimise(problem, mesh, relaxed.found.z, margins_, control_);
    if (!found.feasible(kNearlyFeasible)) return std::nullopt;
    return found;
  }

  /// Finer meshes, then tightening until the referee is content.
  void refine(Candidate& candidate, Found found, bool unlimited) {
    const ScaledProblem& problem = *candidate.problem;
    // A track that only a finer mesh could find is not taken back to a coarser one.
    const std::size_t pieces =
        std::max(static_cast<std::size_t>(options_.pieces), found.track->mesh().knots.size() - 1);
    std::vector<std::size_t> levels;
    if (!unlimited) {
      if (found.track->mesh().knots.size() <= kMiddlePieces && pieces > kMiddlePieces) {
        levels.push_back(kMiddlePieces);
      }
      if (pieces > kFinerPieces) levels.push_back(kFinerPieces);
      // The last of them only while the places at which limits change over move, and it pays.
      levels.insert(levels.end(), 1 + kMovedLevels, pieces);
    }
    double done = 0.2;
    for (std::size_t level = 0; level < levels.size(); ++level) {
      if (found.stopped) break;
      const std::vector<Switch> switches = switches_of(problem, found);
      const bool last_ones = level + kMovedLevels >= levels.size();
      if (last_ones && settled(switches)) break;
      tell("finer track", done);
      done += 0.7 / static_cast<double>(levels.size());
      if (levels[level] == levels.back()) {
        aim_at(options_.tolerance, 10);
      } else {
        aim_at(kCoarseTolerance, 5);
      }
      const Mesh mesh = mesh_with(problem, refined_knots(*found.track, found.z, switches, levels[level]),
                                  found.z[found.track->layout().length()]);
      const Vector beginning = fit(curve_of(*found.track, found.z), Transcription(mesh));
      Found next = minimise(problem, mesh, beginning, margins_, control_, &found);
      if (!next.stopped && !next.feasible(kNearlyFeasible) && found.feasible(kNearlyFeasible)) {
        std::optional<Found> other = rescued(problem, mesh, beginning);
        if (other) next = std::move(*other);
      }
      if (next.stopped && !next.feasible(kNearlyFeasible)) {
        found.stopped = true;
        break;
      }
      const auto converged = [&](const Found& track) {
        return track.residual <= options_.tolerance && track.feasible(options_.limit_tolerance);
      };
      const double dearer = next.objective - found.objective;
      // Where the places at which limits change over move without effect they need not be followed.
      const bool still = last_ones && converged(found) && converged(next) &&
                         std::fabs(dearer) <= kWithoutEffect * std::fabs(found.objective);
      const bool pays = converged(next) && dearer <= kDearer * std::fabs(found.objective);
      if (last_ones && converged(found) && !pays) break;
      found = std::move(next);
      if (still) break;
    }
    if (!unlimited && !found.stopped) found = followed(problem, std::move(found));
    if (!unlimited && !found.stopped) found = halved(problem, std::move(found));
    candidate.stopped = candidate.stopped || found.stopped;
    tell("referee", 0.9);
    const std::function<bool()> stop = control_.stop;
    Vector held;  // places, of the core's length, at which limits are held beside the stations
    for (int round = 0; round < kTighteningRounds; ++round) {
      const CenterlinePtr track = track_of(problem, found);
      const referee::Judgement judgement = referee::judge_track(problem_, track, referee::kRefereeSamples);
      const bool kept = judgement.arrived && judgement.worst <= options_.limit_tolerance;
      const bool better = !candidate.found || (kept && !candidate.kept) ||
                          (kept == candidate.kept && found.objective < candidate.found->objective);
      if (better) {
        candidate.found = found;
        candidate.track = track;
        candidate.judgement = judgement;
        candidate.kept = kept;
      }
      if (kept) break;
      if (found.stopped) {
        // Asked to end on a track that all but keeps its limits: a little more work makes it one that does.
        if (!found.feasible(kNearlyFeasible) || round >= kGraceRounds) break;
        control_.stop = [] { return false; };
      }
      if (round >= kPatientRounds && !found.feasible(kNearlyFeasible)) break;
      const double core_length = found.z[found.track->layout().length()];
      const auto share_of = [&](double place) {
        return (place / problem.chord - problem.lead_in) / core_length;
      };
      // A curvature that follows the load more closely, rather than a load that keeps its distance everywhere.
      std::vector<LiftOff> lifts;
      if (judgement.lift_off) {
        lifts = lift_offs_of(problem, found);
        lifts.push_back({share_of(*judgement.lift_off), 0.0});
      }
      if (judgement.lift_off && round < kFollowingRounds && !found.stopped) {
        Vector lifting;
        for (const LiftOff& lift : lifts) lifting.push_back(lift.sigma);
        const std::optional<Mesh> closer = following_loads(problem, found, lifting);
        if (closer && closer->fine.size() > found.track->mesh().fine.size()) {
          aim_at(options_.tolerance, 10);
          Found next = minimise(problem, *closer, found.z, margins_, control_, &found);
          if (next.feasible(options_.limit_tolerance)) {
            found = std::move(next);
            continue;
          }
        }
      }
      tighten(problem, judgement, lifts, round);
      aim_at(options_.tolerance, 10);
      Mesh mesh = found.track->mesh();
      mesh.core_length = core_length;
      mesh.extra_breaks = breaks_of(problem, core_length);
      for (const double place : places_to_hold(problem, judgement, round)) {
        const double sigma = share_of(place);
        if (sigma > 0.0 && sigma < 1.0) hold(sigma, mesh.knots, held);
      }
      for (const LiftOff& lift : lifts) {
        if (lift.depth > kShallow) hold(lift.sigma, mesh.knots, held);
      }
      mesh.extra_breaks.insert(mesh.extra_breaks.end(), held.begin(), held.end());
      if (found.stopped) control_.most_rounds = kGraceEffort;
      const bool stopped = found.stopped;
      Found next = minimise(problem, mesh, found.z, margins_, control_, &found);
      // A descent that lost its way would go on from nowhere.
      if (!next.stopped && !next.feasible(kNearlyFeasible) && found.feasible(kNearlyFeasible)) {
        std::optional<Found> other = rescued(problem, mesh, found.z);
        if (other) next = std::move(*other);
      }
      found = std::move(next);
      control_.stop = stop;
      found.stopped = found.stopped || stopped;
    }
    candidate.stopped = candidate.stopped || found.stopped;
  }

  /// The same track with a curvature that follows the load limits which it lies at.
  [[nodiscard]] Found followed(const ScaledProblem& problem, Found found) {
    constexpr int kMostRounds = 3;
    constexpr double kPays = 1e-7;
    for (int round = 0; round < kMostRounds; ++round) {
      const std::optional<Mesh> mesh = following_loads(problem, found);
      if (!mesh) break;
      aim_at(options_.tolerance, 0);
      Found next = minimise(problem, *mesh, found.z, margins_, control_, &found);
      if (next.stopped || next.residual > options_.tolerance || !next.feasible(options_.limit_tolerance))
        break;
      const double won = found.objective - next.objective;
      found = std::move(next);
      if (std::fabs(won) < kPays * std::fabs(found.objective)) break;
    }
    return found;
  }

  /// Pieces are halved where a finer mesh has much left to win.
  [[nodiscard]] Found halved(const ScaledProblem& problem, Found found) {
    constexpr int kMostRounds = 6;
    // Under a limit on the rate of curvature no jump tells where knots belong: halving alone makes prices exact.
    const double left_at_most = is_smooth(problem) ? 1e-8 : 1e-6;
    constexpr std::size_t kMostPieces = 120;
    constexpr double kKept = 0.1;
    for (int round = 0; round < kMostRounds; ++round) {
      const Remainder left = remainder_of(problem, found, control_);
      if (left.objective <= left_at_most * std::fabs(found.objective)) break;
      if (found.track->mesh().knots.size() > kMostPieces) break;
      const MeshTrack finer = with_halved_pieces(*found.track, found.z, worth_halving(left));
      aim_at(options_.tolerance, 0);
      Found next = minimise(problem, finer.mesh, finer.z, margins_, control_, &found);
      if (next.stopped || next.residual > options_.tolerance || !next.feasible(options_.limit_tolerance))
        break;
      next = followed(problem, std::move(next));
      const double won = found.objective - next.objective;
      found = std::move(next);
      // What is promised but not won is not there.
      if (won < kKept * left_at_most * std::fabs(found.objective)) break;
    }
    return found;
  }

  /// Where the referee found the ride ending, or in the first rounds limits broken the most: holding a limit
  /// exactly there costs nothing, other than tightening it as a whole.
  [[nodiscard]] std::vector<double> places_to_hold(const ScaledProblem& problem,
                                                   const referee::Judgement& judgement, int round) const {
    std::vector<double> places;
    if (judgement.lift_off) places.push_back(*judgement.lift_off);
    if (judgement.stall) places.push_back(*judgement.stall);
    if (round >= kHoldingRounds) return places;
    for (const referee::Broken& broken : judgement.broken) {
      const bool load = std::any_of(
          problem.limits.begin(), problem.limits.end(),
          [&](const LimitSpec& limit) { return limit.name == broken.limit && is_highest_load(limit); });
      if (!load && broken.violation > 0.5 * options_.limit_tolerance) places.push_back(broken.where);
    }
    return places;
  }

  /// A track that follows such a limit breaks it a little in every piece, between any places where it is
  /// held, since a linear curvature does not follow it. Tightening takes less than that already leaves.
  [[nodiscard]] static bool is_highest_load(const LimitSpec& limit) {
    const bool load = limit.measure == Measure::normal_load || limit.measure == Measure::curvature_load;
    return load && limit.side > 0;
  }

  /// A place close to one that is held already takes its part: limits are touched there now.
  static void hold(double sigma, const Vector& knots, Vector& held) {
    constexpr double kClose = 0.02;
    const auto above = std::upper_bound(knots.begin() + 1, knots.end() - 1, sigma);
    const double piece = *above - *(above - 1);
    for (double& place : held) {
      if (std::fabs(place - sigma) > kClose * piece) continue;
      place = sigma;
      return;
    }
    held.push_back(sigma);
  }

  void tighten(const ScaledProblem& problem, const referee::Judgement& judgement, const std::vector<LiftOff>& lifts,
               int round) {
    for (std::size_t i = 0; i < problem.limits.size(); ++i) {
      const LimitSpec& limit = problem.limits[i];
      if (limit.side == 0) continue;
      const bool contact = limit.measure == Measure::normal_load && limit.side < 0;
      if (contact && judgement.lift_off) {
        double shallow = 0.0;
        for (const LiftOff& lift : lifts) {
          if (lift.depth <= kShallow) shallow = std::max(shallow, lift.depth);
        }
        margins_[i] = std::max(2.0 * margins_[i], margins_[i] + kTightening * shallow);
        continue;
      }
      const bool keeps_moving = limit.measure == Measure::arrival || limit.name.id == LimitId::no_choking;
      if (keeps_moving && judgement.stall) {
        margins_[i] = std::max(kStallMargin, 2.0 * margins_[i]);
        continue;
      }
      const bool load = is_highest_load(limit);
      if (round < kHoldingRounds && !load) continue;
      const LimitCheck* check = judgement.find(limit.name);
      if (check == nullptr || check->violation <= 0.5 * options_.limit_tolerance * check->scale) continue;
      margins_[i] += kTightening * check->violation / check->scale;
    }
  }

  /// What the next descents are to reach.
  void aim_at(double tolerance, int most_rounds) {
    control_.tolerance = tolerance;
    control_.most_rounds = most_rounds;
  }

  void tell(std::string_view stage, double fraction) const {
    if (progress_) progress_(stage, fraction);
  }

  const Problem& problem_;
  const OptimizeOptions& options_;
  SearchControl& control_;
  const Progress& progress_;
  Vector margins_;
};

/// Every combination of sides for the keep-outs that leave it open, up to kMostPassages.
std::vector<Passages> all_passages(const Limits& limits) {
  std::vector<Passages> all{{}};
  for (const KeepOut& keep_out : limits.keep_outs) {
    std::vector<Passages> longer;
    for (const Passages& begun : all) {
      for (const Passage side : {Passage::above, Passage::below}) {
        if (keep_out.passage != Passage::either && keep_out.passage != side) continue;
        // Beyond the cap the earlier keep-outs have branched already; the later ones go above.
        if (keep_out.passage == Passage::either && side == Passage::below && all.size() >= kMostPassages)
          continue;
        Passages passages = begun;
        passages.push_back(side);
        longer.push_back(std::move(passages));
      }
    }
    all = std::move(longer);
  }
  return all;
}

std::string none_found_text(const std::vector<std::string>& nearly) {
  std::string text = "no track was found that keeps every limit, and no conflict between them is certain";
  for (std::size_t i = 0; i < nearly.size(); ++i) {
    if (i == 0) text += "; the closest one breaks ";
    if (i > 0) text += i + 1 == nearly.size() ? " and " : ", ";
    text += nearly[i];
  }
  return text;
}

}  // namespace
}  // namespace optimizer

Optimum optimize(const Problem& problem, const OptimizeOptions& options, const std::stop_token& stop,
                 const Progress& progress) {
  using namespace optimizer;
  require_searchable(problem);
  require_passable_in_order(problem);
  require_valid(options);
  const auto begin = Clock::now();
  SearchControl control;
  control.limit_tolerance = 0.1 * options.limit_tolerance;
  bool out_of_time = false;
  bool stopped = false;
  control.stop = [&] {
    if (stop.stop_requested()) return true;
    out_of_time = std::chrono::duration<double>(Clock::now() - begin).count() > options.time_budget;
    return out_of_time;
  };

  Optimum optimum;
  OptimizeReport& report = optimum.report;
  report.objective = problem.objective;
  report.unlimited_travel_time = unlimited_travel_time(problem);
  const auto finish = [&] {
    report.ended_early = stopped;
    report.iterations = control.rounds;
    report.evaluations = control.evaluations;
    report.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  };

  std::optional<Conflict> at_once = beyond_reach(problem);
  if (!at_once) at_once = too_close_at_an_end(problem);
  if (const std::optional<Conflict>& conflict = at_once) {
    report.status = OptimizeStatus::infeasible;
    report.conflict = *conflict;
    report.message = conflict->text;
    finish();
    return optimum;
  }

  Searcher searcher(problem, options, control, progress);
  std::optional<Candidate> best;
  const std::vector<Passages> all = all_passages(problem.limits);
  for (const Passages& passages : all) {
    Candidate candidate = searcher.search(passages);
    stopped = stopped || candidate.stopped;
    const bool better = !best || (candidate.kept && !best->kept) ||
                        (candidate.kept && best->kept && candidate.found->objective < best->found->objective);
    if (better) best = std::move(candidate);
    if (stopped) break;
  }

  std::optional<Conflict> conflict;
  std::vector<std::string> nearly;
  if (!best->kept && !stopped) {
    control.most_rounds = 10;
    Explanation explanation = explain(problem, all, control);
    conflict = std::move(explanation.conflict);
    nearly = std::move(explanation.nearly);
    if (!conflict && !explanation.z.empty()) {
      best = searcher.search_from(all[explanation.passages], explanation.mesh, explanation.z);
    }
    stopped = best->stopped || control.stop();
  }

  if (best->kept) {
    const Found& found = *best->found;
    optimum.centerline = best->track;
    report.travel_time = best->judgement.travel_time;
    report.exit_speed = best->judgement.exit_speed;
    report.checks = best->judgement.checks;
    report.first_order_residual = found.residual;
    report.active = active_limits(*best->problem, priced(*best->problem, found, options, control));
    const bool converged = found.residual <= options.tolerance && !stopped;
    report.status = converged ? OptimizeStatus::optimal : OptimizeStatus::feasible_not_converged;
    if (converged) {
      report.message = "every limit holds and no neighbouring track is faster";
    } else if (stopped) {
      report.message =
          out_of_time ? "the time budget ran out: the best track so far" : "stopped: the best track so far";
    } else {
      report.message = "every limit holds, but the first-order residual stayed above its tolerance";
    }
  } else if (stopped && !conflict) {
    report.status = OptimizeStatus::no_track_found;
    report.message = "ended early, before any track kept every limit";
  } else {
    if (conflict) {
      report.status = OptimizeStatus::infeasible;
      report.conflict = *conflict;
      report.message = conflict->text;
    } else {
      report.status = OptimizeStatus::no_track_found;
      report.message = none_found_text(nearly);
    }
  }
  finish();
  return optimum;
}

}  // namespace glissade
