#include "optimize/least_bound/least_kept.hpp"

#include "optimize/descent/least_violation.hpp"
#include "optimize/prices/prices.hpp"
#include "optimize/problem/changed_bound.hpp"
#include "optimize/problem/passages.hpp"

#include <algorithm>
#include <memory>
#include <utility>

namespace glissade::optimizer {
namespace {

constexpr double kOthersKept = 1e-6;  // accuracy: ten times that of a limit

/// Descents of one limit's violation, by one way past the keep-outs.
class LeastKeptSearch {
 public:
  LeastKeptSearch(const Problem& problem, const LimitName& name, std::size_t passages, const Passages& way,
                  SearchControl& control)
      : problem_(problem), name_(name), passages_(passages), way_(way), control_(control) {}

  [[nodiscard]] std::optional<LeastKept> near(const Mesh& mesh, const Vector& z) {
    return closed(descended(problem_, mesh, z));
  }

 private:
  struct End {
    std::shared_ptr<const ScaledProblem> problem;
    Relaxed relaxed;

    [[nodiscard]] bool is_on_limits() const { return relaxed.found.violation <= kOthersKept; }
  };

  [[nodiscard]] End descended(const Problem& problem, const Mesh& mesh, const Vector& z) {
    End end{std::make_shared<const ScaledProblem>(scaled(problem, way_)), {}};
    Elastic elastic;
    elastic.equalities = false;
    for (const LimitSpec& limit : end.problem->limits) elastic.limits.push_back(limit.name == name_);
    const Vector margins(elastic.limits.size(), 0.0);
    end.relaxed = least_violation(*end.problem, mesh, z, elastic, margins, control_);
    return end;
  }

  /// What the limit gives way to, in the user's unit. @return none where it does not
  [[nodiscard]] std::optional<double> bound_of(const End& end) const {
    if (!(end.relaxed.settled && end.relaxed.t > 0.0 && end.is_on_limits())) return std::nullopt;
    for (const LimitSpec& limit : end.problem->limits) {
      if (limit.name == name_) return relaxed_bound(limit, end.relaxed.t, 0.0);
    }
    return std::nullopt;
  }

  /// How well a descent finds the least goes with how far that is from the bound: from ever closer ones.
  [[nodiscard]] std::optional<LeastKept> closed(End end) {
    constexpr double kOfGap = 0.05;        // measured: a descent leaves less than a hundredth
    constexpr double kCloseEnough = 1e-7;  // accuracy: a tenth of what such bounds are told to
    constexpr int kMostDescents = 24;      // budget
    std::optional<double> least = bound_of(end);
    std::optional<End> held_up = least ? std::optional(end) : std::nullopt;
    std::optional<double> tight = bound_now(problem_);
    double share = kOfGap;
    for (int i = 0; least && tight && i < kMostDescents && !control_.stop(); ++i) {
      const double next = *least - share * (*least - *tight);
      if (*least - next <= kCloseEnough * *least)
        return LeastKept{*least, holding(*held_up), foothold_of(end)};
      const std::optional<Problem> closer = with_bound(problem_, name_, next);
      if (!closer) return std::nullopt;
      End trial = descended(*closer, end.relaxed.found.track->mesh(), end.relaxed.found.z);
      if (!trial.is_on_limits()) return std::nullopt;
      if (trial.relaxed.t <= 0.0) {
        least = next;
        share = std::min(0.5, 2.0 * share);
      } else {
        least = bound_of(trial);
        tight = next;
        share = kOfGap;
        if (least) held_up = trial;
      }
      end = std::move(trial);
    }
    return std::nullopt;
  }

  /// What the others carry, for each unit that the limit itself does.
  [[nodiscard]] std::vector<ActiveLimit> holding(const End& end) const {
    std::vector<ActiveLimit> active = active_limits(*end.problem, end.relaxed.found, 0.0);
    double own = 0.0;
    for (const ActiveLimit& one : active) own += one.limit == name_ ? one.price : 0.0;
    std::erase_if(active, [&](const ActiveLimit& one) { return one.limit == name_; });
    if (!(own > 0.0)) return {};
    for (ActiveLimit& one : active) one.price /= own;
    return active;
  }

  [[nodiscard]] std::optional<double> bound_now(const Problem& problem) const {
    for (const LimitSpec& limit : scaled(problem, way_).limits) {
      if (limit.name == name_) return limit.bound_si;
    }
    return std::nullopt;
  }

  [[nodiscard]] Foothold foothold_of(const End& end) const {
    return {passages_, Mesh(end.relaxed.found.track->mesh()), end.relaxed.found.z};
  }

  const Problem& problem_;
  const LimitName& name_;
  std::size_t passages_;
  const Passages& way_;
  SearchControl& control_;
};

}  // namespace

std::optional<LeastKept> least_kept_near(const Problem& problem, const LimitName& name, const Foothold& track,
                                         SearchControl& control) {
  const std::vector<Passages> ways = all_passages(problem.limits);
  return LeastKeptSearch(problem, name, track.passages, ways[track.passages], control)
      .near(track.mesh, track.z);
}

}  // namespace glissade::optimizer
