#include "optimize/least_bound/least_peak.hpp"

#include "glissade/centerline/straight_line.hpp"

#include "optimize/descent/least_violation.hpp"
#include "optimize/least_bound/most_reached.hpp"
#include "optimize/mesh/refined_knots.hpp"
#include "optimize/prices/prices.hpp"
#include "optimize/problem/passages.hpp"
#include "optimize/search/patience.hpp"
#include "optimize/search/searcher.hpp"
#include "optimize/search/starts.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace glissade::optimizer {
namespace {

constexpr std::size_t kPieces = 24;       // taste
constexpr std::size_t kFinerPieces = 32;  // taste
constexpr std::size_t kFollowed = 2;      // budget: ends that finer meshes follow
constexpr int kMostRounds = 4;            // budget
constexpr double kRestKept = 1e-6;        // accuracy: ten times that of a limit
constexpr double kKeptTo = 1e-9;          // accuracy: a hundredth of that of a limit
constexpr double kSame = 1e-4;            // of the peak: the accuracy of a least one
// Below this share of a straight chute's peak the stream all but flies: nothing is won by less.
constexpr double kAllButNone = 1e-3;  // taste
// Above the least that a mesh finds, by these shares: the track that keeps it between the stations too.
constexpr double kAboveLeast[] = {1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2};  // taste: tried in turn

/// What gives way.
LimitName wear_limit() {
  return {LimitId::highest_floor_wear, Bound::highest};
}

Elastic wear_alone(const ScaledProblem& problem) {
  Elastic elastic;
  elastic.equalities = false;
  for (const LimitSpec& limit : problem.limits) elastic.limits.push_back(limit.name == wear_limit());
  return elastic;
}

/// A track whose peak no small change lowers, on its mesh.
struct PeakEnd {
  std::size_t way = 0;
  std::shared_ptr<const ScaledProblem> problem;  ///< with a bound below the peak
  Mesh mesh;
  Relaxed relaxed;
  double bound = 0.0;  ///< the one of `problem` [W/m^2]
  double peak = 0.0;   ///< [W/m^2]
};

bool less_worn(const PeakEnd& a, const PeakEnd& b) {
  return a.peak < b.peak;
}

class LeastPeak {
 public:
  LeastPeak(const Problem& problem, const OptimizeOptions& options, const std::stop_token& stop,
            const Progress& progress)
      : asked_(problem),
        options_(options),
        stop_(stop),
        progress_(progress),
        outlay_(options, stop),
        tried_(problem),
        ways_(all_passages(problem.limits)) {
    tried_.objective.kind = ObjectiveKind::travel_time;
    control_.limit_tolerance = 0.1 * options.limit_tolerance;
    control_.stop = [this] { return outlay_.ends(); };
  }

  [[nodiscard]] Optimum found() {
    Optimum fastest = optimize(tried_, options_, stop_, progress_);
    outlay_.add(fastest.report);
    if (!fastest.centerline) return told(std::move(fastest));
    hardly_any_ = kAllButNone * usual_peak(fastest.centerline);
    std::optional<PeakEnd> least = from_starts(0.5 * peak_of(fastest.centerline));
    std::unique_ptr<Built> best;
    for (int round = 0; least && round < kMostRounds; ++round) {
      std::unique_ptr<Built> built = built_near(*least);
      if (!built || (best && built->peak >= best->peak)) break;
      best = std::move(built);
      const Found& found = *best->candidate.found;
      least = descended(best->end.way, found.track->mesh(), found.z, best->end.bound);
      if (!least || outlay_.ends()) break;
      // Where the search on the finer mesh, begun at what stands, finds hardly less, that is the least.
      best->settled = best->peak <= least->peak * (1.0 + kSame);
      if (best->settled) break;
    }
    if (!best) return unsettled(std::move(fastest));
    return described(*best, std::move(fastest.report));
  }

 private:
  /// The fastest track within a bound just above the least.
  struct Built {
    PeakEnd end;
    Candidate candidate;
    double peak = 0.0;     ///< as the referee finds it [W/m^2]
    bool settled = false;  ///< a search from it on its own, finer mesh finds hardly less
  };

  [[nodiscard]] double peak_of(const CenterlinePtr& track) const {
    return most_reached(tried_, &Limits::highest_floor_wear, wear_limit(), track).value_or(0.0);
  }

  /// What there is to be won from: the fastest track's peak, but where that has a corner, in which wear is what the mesh
  /// makes of it, that of a straight chute between the same ends.
  [[nodiscard]] double usual_peak(const CenterlinePtr& fastest) const {
    const double peak = peak_of(fastest);
    const Endpoints ends = fastest->endpoints();
    if (ends.run == 0.0) return peak;
    const double straight = peak_of(std::make_shared<const StraightLine>(ends));
    return straight > 0.0 ? std::min(peak, straight) : peak;
  }

  [[nodiscard]] Problem within(double bound) const {
    Problem problem = tried_;
    problem.limits.highest_floor_wear = std::min(bound, asked_.limits.highest_floor_wear.value_or(bound));
    return problem;
  }

  /// The least peak near a track. The bound that gives way is one that cannot be kept.
  [[nodiscard]] std::optional<PeakEnd> descended(std::size_t way, const Mesh& mesh, Vector z, double bound) {
    for (;; bound *= 0.5) {
      const auto problem = std::make_shared<const ScaledProblem>(scaled(within(bound), ways_[way]));
      const Vector margins(problem->limits.size(), 0.0);
      Relaxed relaxed = least_violation(*problem, mesh, z, wear_alone(*problem), margins, control_);
      if (relaxed.found.violation > kRestKept) return std::nullopt;
      const bool kept = relaxed.t <= kKeptTo;
      if (!kept || bound <= hardly_any_ || control_.stop()) {
        const double peak = bound * (1.0 + std::max(0.0, relaxed.t));
        return PeakEnd{way, problem, mesh, std::move(relaxed), bound, peak};
      }
      z = relaxed.found.z;
    }
  }

  [[nodiscard]] std::optional<PeakEnd> from_starts(double bound) {
    std::vector<PeakEnd> ends;
    for (std::size_t way = 0; way < ways_.size(); ++way) {
      const ScaledProblem problem = scaled(within(bound), ways_[way]);
      for (const GuessCurve& start : starts(problem)) {
        if (outlay_.ends()) break;
        if (progress_) progress_("least peak", {});
        const Mesh mesh = mesh_of(problem, graded_knots(start, kPieces, 1.0), start.length);
        auto end = descended(way, mesh, fit(start, Transcription(mesh)), bound);
        if (end) ends.push_back(std::move(*end));
      }
    }
    std::stable_sort(ends.begin(), ends.end(), less_worn);
    for (std::size_t i = 0; i < std::min(kFollowed, ends.size()); ++i) follow(ends[i]);
    const auto least = std::min_element(ends.begin(), ends.end(), less_worn);
    if (least == ends.end()) return std::nullopt;
    return std::move(*least);
  }

  void follow(PeakEnd& end) {
    if (outlay_.ends()) return;
    const Found& found = end.relaxed.found;
    const Mesh mesh = mesh_of(
        *end.problem, refined_knots(*found.track, found.z, switches_of(*end.problem, found), kFinerPieces),
        found.track->core_length(found.z));
    auto finer =
        descended(end.way, mesh, fit(curve_of(*found.track, found.z), Transcription(mesh)), end.bound);
    if (finer && finer->peak < end.peak) end = std::move(*finer);
  }

  [[nodiscard]] std::unique_ptr<Built> built_near(const PeakEnd& end) {
    for (const double above : kAboveLeast) {
      if (outlay_.ends()) break;
      const Problem problem = within(end.peak * (1.0 + above));
      Searcher searcher(problem, options_, control_, progress_);
      Candidate candidate = searcher.search_from(ways_[end.way], end.mesh, end.relaxed.found.z);
      if (!candidate.kept) continue;
      const double peak = peak_of(candidate.track);
      return std::make_unique<Built>(Built{end, std::move(candidate), peak});
    }
    return nullptr;
  }

  Optimum told(Optimum optimum) {
    outlay_.add(control_);
    return outlay_.told(std::move(optimum), asked_.objective);
  }

  Optimum unsettled(Optimum optimum) {
    optimum.report.status = OptimizeStatus::feasible_not_converged;
    optimum.report.message = "every limit holds, but no track of less peak wear was found than the fastest";
    optimum.report.active.clear();
    return told(std::move(optimum));
  }

  Optimum described(const Built& best, OptimizeReport report) {
    const Candidate& candidate = best.candidate;
    report.travel_time = candidate.judgement.travel_time;
    report.exit_speed = candidate.judgement.exit_speed;
    report.first_order_residual = candidate.found->residual;
    report.finer_mesh_wins = candidate.ahead.finer_mesh_wins;
    report.checks = check_limits(asked_, candidate.track);
    const bool flies = best.end.peak <= hardly_any_;
    report.active = flies ? std::vector<ActiveLimit>{} : prices(best.end);
    const bool settled = flies || best.settled;
    report.status =
        settled && !outlay_.ends() ? OptimizeStatus::optimal : OptimizeStatus::feasible_not_converged;
    report.message = !settled ? "every limit holds, but the least peak was not found to its accuracy"
                     : flies  ? "every limit holds, and the stream all but flies: the floor hardly wears"
                              : "every limit holds, and no neighbouring track wears less at its peak";
    return told({candidate.track, std::move(report)});
  }

  /// What a unit of each limit is worth of the peak.
  [[nodiscard]] static std::vector<ActiveLimit> prices(const PeakEnd& end) {
    ScaledProblem problem = *end.problem;
    problem.time_weight = 1.0;
    problem.time = end.bound;
    std::vector<ActiveLimit> active = active_limits(problem, end.relaxed.found, 0.0);
    std::erase_if(active, [](const ActiveLimit& limit) { return limit.limit == wear_limit(); });
    return active;
  }

  const Problem& asked_;
  const OptimizeOptions& options_;
  const std::stop_token& stop_;
  const Progress& progress_;
  Outlay outlay_;
  Problem tried_;
  std::vector<Passages> ways_;
  SearchControl control_;
  double hardly_any_ = 0.0;  ///< a peak that is as good as none [W/m^2]
};

}  // namespace

Optimum least_peak(const Problem& problem, const OptimizeOptions& options, const std::stop_token& stop,
                   const Progress& progress) {
  return LeastPeak(problem, options, stop, progress).found();
}

}  // namespace glissade::optimizer
