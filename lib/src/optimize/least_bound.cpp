#include "optimize/least_bound.hpp"

#include "glissade/core/math.hpp"
#include "glissade/referee/referee.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <utility>

namespace glissade::optimizer {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kMostSearches = 40;        // budget
constexpr double kSpeedAccuracy = 1e-9;  // of the speed wanted; accuracy
constexpr double kBoundAccuracy = 1e-9;  // of the bound; accuracy

class LeastBound {
 public:
  LeastBound(const Problem& problem, const OptimizeOptions& options, const std::stop_token& stop,
             const Progress& progress)
      : asked_(problem),
        options_(options),
        stop_(stop),
        progress_(progress),
        begin_(Clock::now()),
        tried_(problem),
        wanted_(*problem.limits.exit_speed.lowest) {
    const bool load = problem.objective.kind == ObjectiveKind::least_load;
    member_ = load ? &Limits::highest_normal_load : &Limits::highest_curvature_rate;
    name_ = {load ? LimitId::highest_normal_load : LimitId::highest_curvature_rate, Bound::highest};
    tried_.objective.kind = ObjectiveKind::exit_speed;
    tried_.limits.exit_speed.lowest.reset();
  }

  [[nodiscard]] Optimum found() {
    Optimum loose = within(asked_.limits.*member_);
    if (!loose.centerline) return told(std::move(loose));
    if (loose.report.exit_speed < wanted_ * (1.0 - kSpeedAccuracy)) return told(too_fast());
    double high = reached_by(loose.centerline);
    double low = 0.0;
    Optimum best = std::move(loose);
    bool settled = false;
    double bound = std::min(0.95 * high, of_a_short_bend(best.centerline));
    while (searches_ < kMostSearches && !out_of_time()) {
      Optimum next = within(bound);
      const bool there = next.centerline != nullptr;
      const double excess = there ? next.report.exit_speed - wanted_ : -wanted_;
      const double price = there ? price_in(next.report) : 0.0;
      (excess >= 0.0 ? high : low) = bound;
      settled = there && std::fabs(excess) <= kSpeedAccuracy * wanted_;
      if (settled || (there && excess >= 0.0)) best = std::move(next);
      settled = settled || high - low <= kBoundAccuracy * high;
      if (settled) break;
      const double newton = price > 0.0 ? newton_step(bound, excess, price) : low;
      bound = newton > low && newton < high ? newton : between(low, high);
    }
    return priced(std::move(best), settled);
  }

 private:
  [[nodiscard]] double seconds() const {
    return std::chrono::duration<double>(Clock::now() - begin_).count();
  }
  [[nodiscard]] bool out_of_time() const {
    return stop_.stop_requested() || seconds() >= options_.time_budget;
  }

  Optimum searched(const Problem& problem) {
    OptimizeOptions options = options_;
    constexpr double kLeast = 1e-3;  // [s]; taste
    options.time_budget = std::max(options.time_budget - seconds(), kLeast);
    Optimum optimum = optimize(problem, options, stop_, progress_);
    ++searches_;
    iterations_ += optimum.report.iterations;
    evaluations_ += optimum.report.evaluations;
    return optimum;
  }
  Optimum within(const std::optional<double>& bound) {
    tried_.limits.*member_ = bound;
    return searched(tried_);
  }
  /// Why the speed is out of reach: a search that asks for it says so.
  Optimum too_fast() {
    Problem problem = asked_;
    problem.objective.kind = ObjectiveKind::travel_time;
    return searched(problem);
  }

  /// The most of what is bounded, as the referee finds it.
  [[nodiscard]] double reached_by(const CenterlinePtr& track) const {
    Problem problem = tried_;
    constexpr double kTight = 1e-9;  // accuracy: a hundredth of that of a limit
    problem.limits = {};
    problem.limits.*member_ = kTight;
    for (const LimitCheck& check : check_limits(problem, track)) {
      if (check.limit == name_ && std::isfinite(check.reached)) return check.reached;
    }
    // A jump of the curvature: any bound is tighter.
    return of_a_short_bend(track);
  }
  /// A rate of curvature that is as good as a jump: it turns the track within a hundredth of its length. The bend that
  /// the mesh puts in a jump's place may be sharper by orders of magnitude. A load knows no such bound.
  [[nodiscard]] double of_a_short_bend(const CenterlinePtr& track) const {
    if (name_.id == LimitId::highest_normal_load) return std::numeric_limits<double>::infinity();
    const double length = track->length();
    return 1e4 / (length * length);
  }
  /// Newton's step to the bound that gives the speed wanted, not in the bound but in the length of the bends that it
  /// allows, which goes with 1/load or 1/sqrt(rate): the speed that a bend costs is nearly linear in its length.
  [[nodiscard]] double newton_step(double bound, double excess, double price) const {
    const double power = name_.id == LimitId::highest_normal_load ? 1.0 : 0.5;
    const double longer = 1.0 + power * excess / (price * bound);
    return longer > 0.0 ? bound * math::pow(longer, -1.0 / power) : std::numeric_limits<double>::infinity();
  }
  /// By their ratio, since they may be orders of magnitude apart.
  [[nodiscard]] static double between(double low, double high) {
    return low > 0.0 ? std::sqrt(low * high) : 0.5 * high;
  }
  [[nodiscard]] double price_in(const OptimizeReport& report) const {
    for (const ActiveLimit& active : report.active) {
      if (active.limit == name_) return active.price;
    }
    return 0.0;
  }

  Optimum told(Optimum optimum) const {
    OptimizeReport& report = optimum.report;
    report.objective = asked_.objective;
    report.iterations = iterations_;
    report.evaluations = evaluations_;
    report.seconds = seconds();
    report.ended_early = report.ended_early || (optimum.centerline && out_of_time());
    return optimum;
  }

  /// In units of the bound, which the speed wanted has a price in, too.
  Optimum priced(Optimum optimum, bool settled) const {
    OptimizeReport& report = optimum.report;
    const double own = price_in(report);
    std::erase_if(report.active, [&](const ActiveLimit& active) { return active.limit == name_; });
    if (own > 0.0) {
      for (ActiveLimit& active : report.active) active.price /= own;
      const double end = optimum.centerline->length();
      report.active.push_back({{LimitId::exit_speed, Bound::lowest}, wanted_, {{end, end}}, 1.0 / own});
      std::sort(report.active.begin(), report.active.end(),
                [](const ActiveLimit& a, const ActiveLimit& b) { return a.limit.key() < b.limit.key(); });
    } else {
      report.active.clear();
    }
    report.checks = check_limits(asked_, optimum.centerline);
    if (!settled) {
      report.status = OptimizeStatus::feasible_not_converged;
      report.message = "every limit holds, but the tightest bound was not found to its accuracy";
    } else if (report.status == OptimizeStatus::optimal) {
      report.message = "every limit holds, and a tighter bound keeps the exit speed from being reached";
    }
    return told(std::move(optimum));
  }

  const Problem& asked_;
  const OptimizeOptions& options_;
  const std::stop_token& stop_;
  const Progress& progress_;
  Clock::time_point begin_;
  Problem tried_;
  double wanted_;
  std::optional<double> Limits::*member_ = nullptr;
  LimitName name_;
  int searches_ = 0;
  int iterations_ = 0;
  int evaluations_ = 0;
};

}  // namespace

Optimum least_bound(const Problem& problem, const OptimizeOptions& options, const std::stop_token& stop,
                    const Progress& progress) {
  return LeastBound(problem, options, stop, progress).found();
}

}  // namespace glissade::optimizer
