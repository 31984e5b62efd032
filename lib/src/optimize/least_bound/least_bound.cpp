#include "optimize/least_bound/least_bound.hpp"

#include "glissade/centerline/clothoid_spline.hpp"
#include "glissade/centerline/straight_line.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/quantity.hpp"
#include "glissade/motion/motion.hpp"
#include "glissade/referee/referee.hpp"

#include "optimize/conflicts/mean_slope.hpp"
#include "optimize/least_bound/bound_bracket.hpp"
#include "optimize/least_bound/least_kept.hpp"
#include "optimize/least_bound/most_reached.hpp"
#include "optimize/least_bound/optimize_briefly.hpp"
#include "optimize/search/patience.hpp"
#include "optimize/search/simple_tracks.hpp"
#include "optimize/search/starts.hpp"
#include "optimize/search/straight_fan.hpp"
#include "referee/judgement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace glissade::optimizer {
namespace {

constexpr int kMostSearches = 48;        // budget
constexpr double kSpeedAccuracy = 1e-9;  // of the speed wanted; accuracy
constexpr double kSpeedReached = 1e-6;   // of the speed wanted: ten times the accuracy of a limit
// The least bound is looked at from so far below: a search that lost its way at it would show there.
constexpr double kNeighbour = 1e-4;  // taste
// From a bound that does so far down a track may lead to one that keeps a tighter one, ...
constexpr double kByFar = 1e-2;  // taste
// ... where it is faster than is asked for by such a share.
constexpr double kSpareSpeed = 1e-2;  // taste
// Where a descent from the best track wins less, and searches below it come to no end, it is the least beside it.
constexpr double kLeftAtMost = 1e-5;  // accuracy: ten times that of such a bound

class LeastBound {
 public:
  LeastBound(const Problem& problem, const OptimizeOptions& options, const std::stop_token& stop,
             const Progress& progress)
      : asked_(problem),
        options_(options),
        stop_(stop),
        progress_(progress),
        outlay_(options, stop),
        tried_(problem),
        wanted_(*problem.limits.exit_speed.lowest) {
    control_.stop = [this] { return outlay_.ends(); };
    const bool load = problem.objective.kind == ObjectiveKind::least_load;
    member_ = load ? &Limits::highest_normal_load : &Limits::highest_curvature_rate;
    name_ = {load ? LimitId::highest_normal_load : LimitId::highest_curvature_rate, Bound::highest};
    tried_.objective.kind = ObjectiveKind::exit_speed;
    // The speed wanted is to be reached by the body that arrives slowest: the rougher, the slower.
    tried_.objective.worst_case = problem.high_friction.has_value();
    tried_.limits.exit_speed.lowest.reset();
  }

  [[nodiscard]] Optimum found() {
    bracket_.learn(least_known(), Verdict::kept_by_none);
    const std::optional<Straight> straight = gentlest_straight();
    if (straight && straight->is_open_above && name_.id == LimitId::highest_normal_load)
      return told_open(*straight);
    if (straight && straight->reached - bracket_.tight <= bracket_.accuracy() * straight->reached)
      return told(*straight);
    if (std::optional<Optimum> none = begin(); none && !straight)
      return outlay_.told(*std::move(none), asked_.objective);
    if (straight && (!best_.centerline || straight->reached < reached_by(best_.centerline))) take(*straight);
    bracket_.loose = reached_by(best_.centerline);
    close(std::min(0.95 * bracket_.loose, of_a_short_bend(best_.centerline)));
    for (int round = 0; round < kMostNeighbours && settled_ && !outlay_.ends(); ++round) {
      if (!does_below()) break;
    }
    return priced();
  }

 private:
  Optimum searched(const Problem& problem) {
    OptimizeOptions options = options_;
    options.time_budget = outlay_.left();
    // Without a track the end is what the user reads: its reasons are told in full.
    BriefEnd end = best_.centerline ? optimize_briefly(problem, options, stop_, progress_)
                                    : BriefEnd{optimize(problem, options, stop_, progress_), std::nullopt};
    foothold_ = std::move(end.foothold);
    ++searches_;
    outlay_.add(end.optimum.report);
    return std::move(end.optimum);
  }
  Optimum within(const std::optional<double>& bound) {
    tried_.limits.*member_ = bound;
    return searched(tried_);
  }
  /// Another way to the same bound, for what the one by the greatest speed leaves open.
  Optimum asking_for_speed(const std::optional<double>& bound) {
    Problem problem = asked_;
    problem.limits.*member_ = bound;
    problem.objective.kind = ObjectiveKind::travel_time;
    return searched(problem);
  }

  void take(Optimum optimum) {
    best_ = std::move(optimum);
    beside_best_.reset();
    best_foothold_ = std::exchange(foothold_, std::nullopt);
    best_by_speed_ = best_.report.objective.kind == ObjectiveKind::exit_speed;
  }

  /// A straight line that keeps every limit, and reaches the speed.
  struct Straight {
    CenterlinePtr line;
    referee::Judgement judgement;
    double reached = 0.0;        ///< of what is bounded
    bool is_open_above = false;  ///< nothing but how far lines are looked at bounds its height
  };

  /// A start that needs no search: of the straight lines that the ends leave, the one with the least of what is bounded, and
  /// of several the fastest.
  [[nodiscard]] std::optional<Straight> gentlest_straight() const {
    const StraightFan fan(asked_);
    const std::vector<double> slopes = fan.slopes();
    std::vector<std::optional<Straight>> lines;
    for (const double slope : slopes) lines.push_back(straight_at(fan, slope));
    std::optional<Straight> best;
    std::size_t place = 0;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      if (!is_gentler(lines[i], best)) continue;
      best = lines[i];
      place = i;
    }
    if (!best) return best;
    if (place > 0 && !lines[place - 1]) look_between(fan, slopes[place], slopes[place - 1], best);
    if (place + 1 < lines.size() && !lines[place + 1])
      look_between(fan, slopes[place], slopes[place + 1], best);
    best->is_open_above = fan.is_open_above() && place + 1 == lines.size();
    return best;
  }

  [[nodiscard]] static bool is_gentler(const std::optional<Straight>& line,
                                       const std::optional<Straight>& than) {
    if (!line || !than) return line.has_value();
    return line->reached < than->reached ||
           (line->reached == than->reached && line->judgement.travel_time < than->judgement.travel_time);
  }

  /// The last line before limits are broken, where it is gentler than the best one.
  void look_between(const StraightFan& fan, double kept, double broken, std::optional<Straight>& best) const {
    constexpr int kHalvings = 40;  // rounding: 2^-40 of a step
    std::optional<Straight> last;
    for (int i = 0; i < kHalvings; ++i) {
      const double middle = 0.5 * (kept + broken);
      std::optional<Straight> line = straight_at(fan, middle);
      (line ? kept : broken) = middle;
      if (line) last = std::move(line);
    }
    if (is_gentler(last, best)) best = std::move(last);
  }

  /// @return none where it breaks a limit
  [[nodiscard]] std::optional<Straight> straight_at(const StraightFan& fan, double slope) const {
    const CenterlinePtr line = straight_track(fan.ends_at(slope));
    if (asked_.limits.lead_in + asked_.limits.lead_out > line->length()) return std::nullopt;
    std::optional<KeptTrack> kept = kept_track(asked_, line, options_.limit_tolerance);
    if (!kept) return std::nullopt;
    return Straight{line, std::move(kept->judgement), reached_by(line)};
  }

  /// As a search finds tracks, so that whatever goes on with one can go on with it.
  [[nodiscard]] static CenterlinePtr straight_track(const Endpoints& ends) {
    const StraightLine line(ends);
    return std::make_shared<ClothoidSpline>(Angle::from_radians(line.slope_angle(0.0)),
                                            std::vector<ClothoidSegment>{{line.length(), 0.0, 0.0}});
  }

  void take(const Straight& straight) {
    Optimum optimum;
    optimum.centerline = straight.line;
    OptimizeReport& report = optimum.report;
    report.status = OptimizeStatus::optimal;
    report.objective = asked_.objective;
    report.travel_time = straight.judgement.travel_time;
    report.exit_speed = straight.judgement.exit_speed;
    report.unlimited_travel_time = unlimited_travel_time(asked_);
    report.finer_mesh_wins = 0.0;
    take(std::move(optimum));
  }

  /// The straight line, where nothing has less.
  Optimum told(const Straight& straight) {
    take(straight);
    OptimizeReport& report = best_.report;
    report.checks = check_limits(asked_, best_.centerline);
    report.message = name_.id == LimitId::highest_normal_load
                         ? "every limit holds, and no track carries less than the straight line"
                         : "every limit holds, and the straight line has no curvature that could change";
    return outlay_.told(std::move(best_), asked_.objective);
  }

  /// A straight line as high as lines are looked at, where a higher one carries less.
  Optimum told_open(const Straight& straight) {
    take(straight);
    OptimizeReport& report = best_.report;
    report.checks = check_limits(asked_, best_.centerline);
    report.status = OptimizeStatus::feasible_not_converged;
    report.message =
        "every limit holds, but there is no least load: the higher a track, the less it carries; bound the "
        "free height";
    return outlay_.told(std::move(best_), asked_.objective);
  }

  /// The first track, by search: the loosest bound.
  /// @return the end of the search, where there is none
  [[nodiscard]] std::optional<Optimum> begin() {
    Optimum loose = within(asked_.limits.*member_);
    const bool slow = loose.centerline && slowest_of(loose) < wanted_ * (1.0 - kSpeedAccuracy);
    if (!loose.centerline || slow) {
      // A search that asks for the speed says why it is out of reach, or finds that it is not.
      Optimum other = asking_for_speed(asked_.limits.*member_);
      if (!other.centerline) return slow ? std::move(other) : std::move(loose);
      loose = std::move(other);
    }
    take(std::move(loose));
    return std::nullopt;
  }

  /// A track that keeps a bound, the fastest beside the one it was found from.
  struct Led {
    BriefEnd end;
    double excess = 0.0;  ///< of its exit speed
  };
  /// Near what no track goes below those that keep a bound are few and all alike: the best one known leads to one, where starts of
  /// their own take a hundred times as long, or come to no end.
  [[nodiscard]] std::optional<Led> led_to(double bound) {
    constexpr std::size_t kMostKnots = 130;  // budget: meshes grow from one to the next
    const bool is_near = bracket_.why == Verdict::kept_by_none && bracket_.tight > 0.0 &&
                         bound > (1.0 - kByFar) * bracket_.loose;
    if (!is_near || !best_foothold_ || !best_by_speed_) return std::nullopt;
    if (best_foothold_->mesh.knots.size() > kMostKnots) return std::nullopt;
    return led_from(*best_foothold_, bound);
  }
  [[nodiscard]] std::optional<Led> led_from(const Foothold& foothold, double bound) {
    OptimizeOptions options = options_;
    options.time_budget = outlay_.left();
    tried_.limits.*member_ = bound;
    BriefEnd end = optimize_from(tried_, foothold, options, stop_, progress_);
    ++searches_;
    outlay_.add(end.optimum.report);
    if (!end.optimum.centerline || end.optimum.report.status != OptimizeStatus::optimal) return std::nullopt;
    const double excess = slowest_of(end.optimum) - wanted_;
    return Led{std::move(end), excess};
  }
  void take(Led led) {
    excess_ = led.excess;
    price_ = price_in(led.end.optimum.report);
    foothold_ = std::move(led.end.foothold);
    take(std::move(led.end.optimum));
  }

  /// Looks at a bound: from the best track, and where that is not plainly fast enough, from everywhere.
  Verdict look(double bound) {
    std::optional<Led> led = led_to(bound);
    // Beside the speed wanted another track may be the faster one.
    if (led && led->excess > kSpareSpeed * wanted_) {
      take(*std::move(led));
      return Verdict::does;
    }
    const Verdict verdict = look_from_everywhere(bound);
    if (verdict == Verdict::does || !led) return verdict;
    // What is known to keep the bound stands against a search that found nothing.
    if (led->excess < 0.0) return verdict == Verdict::kept_by_none ? Verdict::too_slow : verdict;
    settled_ = std::fabs(led->excess) <= kSpeedAccuracy * wanted_;
    take(*std::move(led));
    return Verdict::does;
  }

  /// By a second way where the first comes to no end.
  Verdict look_from_everywhere(double bound) {
    Optimum fastest = within(bound);
    excess_ = fastest.centerline ? slowest_of(fastest) - wanted_ : -wanted_;
    price_ = fastest.centerline ? price_in(fastest.report) : 0.0;
    const bool there = fastest.centerline != nullptr;
    const bool optimal = fastest.report.status == OptimizeStatus::optimal;
    settled_ = there && optimal && std::fabs(excess_) <= kSpeedAccuracy * wanted_;
    if (there && (settled_ || excess_ >= 0.0)) {
      take(std::move(fastest));
      return Verdict::does;
    }
    if (there && optimal) return Verdict::too_slow;
    if (fastest.report.status == OptimizeStatus::infeasible) return Verdict::kept_by_none;
    if (outlay_.ends()) return Verdict::untold;
    Optimum other = asking_for_speed(bound);
    if (!other.centerline)
      return other.report.status == OptimizeStatus::infeasible ? Verdict::too_slow : Verdict::untold;
    price_ = 0.0;
    take(std::move(other));
    return Verdict::does;
  }

  /// Narrows the bracket down until a bound gives just the speed wanted, or nothing is left of it.
  void close(double bound) {
    settled_ = false;
    int untold = 0;
    while (searches_ < kMostSearches && untold < kMostUntold && !outlay_.ends()) {
      if (bracket_.is_closed()) {
        settled_ = bracket_.untold.empty() || is_too_tight_below();
        return;
      }
      const Verdict verdict = look(bound);
      if (verdict == Verdict::untold) {
        ++untold;
        if (is_least_beside()) return;
      }
      bracket_.learn(verdict == Verdict::does ? std::min(bound, reached_by(best_.centerline)) : bound,
                     verdict);
      settled_ = settled_ || is_as_good_as_none(bracket_.loose);
      if (settled_) return;
      if (verdict == Verdict::does) leap();
      bound = next_after(bound, verdict);
    }
  }

  /// Where searches below the best track come to no end: whether no small change of it does better, by a descent.
  [[nodiscard]] bool is_least_beside() {
    const std::optional<LeastKept> least = least_beside(bracket_.tight);
    if (!least || !(least->bound > (1.0 - kLeftAtMost) * bracket_.loose)) return false;
    left_beside_ = std::max(0.0, 1.0 - least->bound / bracket_.loose);
    settled_ = true;
    return true;
  }

  /// The least that a descent from the best track comes to. @param tight  a bound that no track keeps
  std::optional<LeastKept> least_beside(double tight) {
    if (bracket_.why != Verdict::kept_by_none || !(tight > 0.0) || !best_foothold_) return std::nullopt;
    if (beside_best_ && beside_best_->tight == tight) return beside_best_->least;
    Problem problem = tried_;
    problem.limits.*member_ = tight;
    std::optional<LeastKept> least = least_kept_near(problem, name_, *best_foothold_, control_);
    beside_best_ = BesideBest{tight, least};
    if (least && (!least_beside_ || least->bound < least_beside_->bound)) least_beside_ = least;
    return least;
  }

  /// Just below the least bound that does a search may come to no end. Whether one a little farther below tells that it is the
  /// least, to five digits.
  [[nodiscard]] bool is_too_tight_below() {
    constexpr double kShares[] = {1e-5, 1e-4, 1e-3};  // taste
    const double excess = excess_;
    const double price = price_;
    for (const double share : kShares) {
      const double bound = bracket_.loose * (1.0 - share);
      if (!(bound > bracket_.tight) || outlay_.ends()) return false;
      const Verdict verdict = look(bound);
      bracket_.learn(bound, verdict);
      if (verdict == Verdict::does) return false;
      excess_ = excess;
      price_ = price;
      if (verdict != Verdict::untold) return share == kShares[0];
    }
    return false;
  }

  [[nodiscard]] double next_after(double bound, Verdict verdict) {
    // From far above the tangent leads to bounds that nothing keeps, and such searches take the longest.
    constexpr double kBoldest = 0.25;  // taste
    const double floor = bracket_.floor();
    const auto is_open = [&](double next) { return next > floor && next < bracket_.loose; };
    const double tangent = price_ > 0.0 ? newton_step(bound, excess_, price_) : 0.0;
    const double bold = tangent > 0.0 ? std::max(tangent, kBoldest * bracket_.loose) : 0.0;
    const double next = by_descent(bound, verdict);
    // What no track near the best one keeps is not worth a look for the speed that it would have.
    if (is_open(next) && next >= bold) return next;
    step_ = 0.0;
    if (is_open(bold)) return bold;
    return between(floor, bracket_.loose);
  }

  /// Where no track keeps a tighter bound, however slow it is: just above the least that a descent from the best track comes
  /// to, in steps that grow while that does not do, and just below once it does. @return 0 where nothing is known
  [[nodiscard]] double by_descent(double bound, Verdict verdict) {
    constexpr double kFirstStep = 1e-7;  // taste: a tenth of what such bounds are told to
    constexpr double kGrowth = 8.0;      // taste
    constexpr double kJustBelow = 0.9;   // taste: of the accuracy, so that the bracket closes
    if (bracket_.why != Verdict::kept_by_none || !(bracket_.tight > 0.0)) return 0.0;
    if (verdict != Verdict::does && step_ > 0.0) {
      // Its stations keep it, not what lies between them.
      step_ *= kGrowth;
      return bound * (1.0 + step_);
    }
    const std::optional<LeastKept> least = least_beside(bracket_.tight);
    const double below = bracket_.loose * (1.0 - kJustBelow * bracket_.accuracy());
    if (!least) return 0.0;
    // Far above it searches come to an end sooner than just above it, and lead nearer.
    constexpr double kOfWay = 0.25;  // taste
    if (least->bound < (1.0 - kByFar) * bracket_.loose)
      return least->bound + kOfWay * (bracket_.loose - least->bound);
    if (verdict != Verdict::does || least->bound < below) {
      step_ = kFirstStep;
      return least->bound * (1.0 + step_);
    }
    step_ = 0.0;
    return below;
  }

  /// From the best track to what no track goes below, as long as a descent leads there to far tighter bounds that do.
  void leap() {
    constexpr int kMostLeaps = 8;    // budget
    constexpr double kAbove = 1e-6;  // taste: of the bound; its stations keep it, not what lies between them
    for (int i = 0; i < kMostLeaps && bracket_.why == Verdict::kept_by_none && !outlay_.ends(); ++i) {
      const std::optional<LeastKept> least = least_beside(bracket_.tight);
      if (!least || !(least->bound < (1.0 - kByFar) * bracket_.loose)) return;
      const double bound = least->bound * (1.0 + kAbove);
      std::optional<Led> led = led_from(least->track, bound);
      if (!led || led->excess < 0.0) return;
      take(*std::move(led));
      bracket_.learn(std::min(bound, reached_by(best_.centerline)), Verdict::does);
      step_ = 0.0;
    }
  }

  /// What no track goes below, shown without a search. 0 where nothing is known.
  [[nodiscard]] double least_known() const {
    return name_.id == LimitId::highest_normal_load ? least_load_anywhere(asked_) : 0.0;
  }

  /// Whether, against expectation, a bound a little below the least does: then goes on from there.
  bool does_below() {
    if (is_as_good_as_none(bracket_.loose)) return false;
    const double bound = bracket_.loose * (1.0 - kNeighbour);
    if (!(bound > 0.0)) return false;  // there is none
    if (bound <= bracket_.tight && bracket_.why == Verdict::kept_by_none) return false;
    const double excess = excess_;
    const double price = price_;
    const Verdict verdict = look(bound);
    if (verdict != Verdict::does) {
      settled_ = true;
      excess_ = excess;
      price_ = price;
      return false;
    }
    bracket_ = {std::min(bound, reached_by(best_.centerline)), 0.0, Verdict::too_slow, {}};
    left_beside_.reset();
    if (!settled_)
      close(price_ > 0.0 ? std::min(newton_step(bound, excess_, price_), 0.99 * bound) : 0.9 * bound);
    return true;
  }

  /// The exit speed at the friction of the range at which it is least. @pre there is a track
  [[nodiscard]] double slowest_of(const Optimum& optimum) const {
    if (!asked_.high_friction) return optimum.report.exit_speed;
    Body body = asked_.body;
    body.friction = *asked_.high_friction;
    return Motion(optimum.centerline, body, asked_.gravity).exit_speed();
  }

  /// The most of what is bounded, as the referee finds it.
  [[nodiscard]] double reached_by(const CenterlinePtr& track) const {
    // A jump of the curvature: any bound is tighter.
    return most_reached(tried_, member_, name_, track).value_or(of_a_short_bend(track));
  }
  /// A rate of curvature that is as good as a jump: it turns the track within a hundredth of its length. The bend that
  /// the mesh puts in a jump's place may be sharper by orders of magnitude. A load knows no such bound.
  [[nodiscard]] double of_a_short_bend(const CenterlinePtr& track) const {
    if (name_.id == LimitId::highest_normal_load) return std::numeric_limits<double>::infinity();
    const double length = track->length();
    return 1e4 / (length * length);
  }
  /// A rate of curvature by which a track is an arc, or a straight line: its slope is off one's by less than a billionth. A load of
  /// less than a hundred thousandth of the weight.
  [[nodiscard]] bool is_as_good_as_none(double bound) const {
    constexpr double kTurned = 1e-9;    // accuracy: a hundredth of that of a limit [rad]
    constexpr double kOfWeight = 1e-5;  // accuracy: ten times what searches keep loads above 0 by
    if (name_.id == LimitId::highest_normal_load) return bound < kOfWeight * asked_.gravity;
    const double length = best_.centerline->length();
    return bound * length * length < kTurned;
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

  /// In units of the bound, which the speed wanted has a price in, too.
  Optimum priced() {
    outlay_.add(control_);
    if (!best_by_speed_ && bracket_.loose > 0.0 && !outlay_.ends()) {
      Optimum again = within(bracket_.loose);
      if (again.centerline && slowest_of(again) >= wanted_ * (1.0 - kSpeedAccuracy)) take(std::move(again));
    }
    OptimizeReport& report = best_.report;
    // Where more than the speed wanted is reached it is not the speed that keeps the bound from being tighter.
    const bool reached = slowest_of(best_) <= wanted_ * (1.0 + kSpeedReached);
    const double own = best_by_speed_ && reached ? price_in(report) : 0.0;
    std::erase_if(report.active, [&](const ActiveLimit& active) { return active.limit == name_; });
    if (own > 0.0) {
      for (ActiveLimit& active : report.active) {
        active.price /= own;
        if (active.tightening_price) *active.tightening_price /= own;
      }
      const double end = best_.centerline->length();
      report.active.push_back({{LimitId::exit_speed, Bound::lowest}, wanted_, {{end, end}}, 1.0 / own});
      std::sort(report.active.begin(), report.active.end(),
                [](const ActiveLimit& a, const ActiveLimit& b) { return a.limit.key() < b.limit.key(); });
    } else {
      report.active = holding_up();
    }
    if (left_beside_ && report.finer_mesh_wins)
      report.finer_mesh_wins = std::max(*report.finer_mesh_wins, *left_beside_);
    report.checks = check_limits(asked_, best_.centerline);
    if (!settled_) {
      report.status = OptimizeStatus::feasible_not_converged;
      report.message = "every limit holds, but the tightest bound was not found: " + open_text();
    } else if (report.status == OptimizeStatus::optimal) {
      report.message =
          is_as_good_as_none(bracket_.loose)
              ? (name_.id == LimitId::highest_normal_load
                     ? "every limit holds on the path of a body that flies, which carries nothing"
                     : "every limit holds on a track of one curvature, which has none that could change")
          : left_beside_ ? "every limit holds, and no neighbouring track keeps a tighter bound"
          : bracket_.why == Verdict::kept_by_none
              ? "every limit holds, and no track keeps a tighter bound"
              : "every limit holds, and a tighter bound keeps the exit speed from being reached";
    }
    return outlay_.told(std::move(best_), asked_.objective);
  }

  /// Where no track keeps a tighter bound, however slow it is: the limits that keep it from being tighter.
  [[nodiscard]] std::vector<ActiveLimit> holding_up() {
    constexpr double kSame = 1e-3;  // taste: by so much a descent on one mesh may miss the bound
    if (!settled_ || outlay_.ends()) return {};
    // The mesh on which it gives way least is the one that fits it best. On the last, largest one a descent may come to no end.
    (void)least_beside(bracket_.tight * (1.0 - kSame));
    if (!least_beside_ || std::fabs(least_beside_->bound / bracket_.loose - 1.0) > kSame) return {};
    return least_beside_->holding;
  }

  /// What is left open: "of bounds between 14.2 m/s^2, which is too tight, and 14.9 m/s^2 searches did not tell"
  [[nodiscard]] std::string open_text() const {
    const auto text = [&](double value, int digits) {
      return quantity_text(value, name_.dimension(), digits);
    };
    const auto [tight, loose] = texts_apart(bracket_.tight, bracket_.loose, text);
    return "of those between " + (bracket_.tight > 0.0 ? tight + ", which is too tight," : "none") + " and " +
           loose +
           (bracket_.untold.empty() || outlay_.ends() ? " not all were tried"
                                                      : " the searches came to no end");
  }

  const Problem& asked_;
  const OptimizeOptions& options_;
  const std::stop_token& stop_;
  const Progress& progress_;
  Outlay outlay_;
  SearchControl control_;  ///< of descents
  Problem tried_;
  double wanted_;
  std::optional<double> Limits::*member_ = nullptr;
  LimitName name_;
  static constexpr int kMostNeighbours = 4;  // budget
  static constexpr int kMostUntold = 6;      // budget: they take the longest
  Bracket bracket_;
  Optimum best_;                           ///< at `loose`
  std::optional<Foothold> foothold_;       ///< of the last search
  std::optional<Foothold> best_foothold_;  ///< of `best_`; none where that came from no mesh
  bool best_by_speed_ = false;             ///< the greatest speed was what it was searched for: it has prices
  bool settled_ = false;                   ///< nothing tighter does
  double excess_ = 0.0;                    ///< of the exit speed, at the bound looked at last
  double price_ = 0.0;                     ///< of that bound, in speed
  /// What a descent from the best track wins still, as a share of its bound; none where searches told that a tighter one is too tight.
  std::optional<double> left_beside_;
  /// What the last descent from the best track told.
  struct BesideBest {
    double tight = 0.0;
    std::optional<LeastKept> least;
  };
  std::optional<BesideBest> beside_best_;
  std::optional<LeastKept> least_beside_;  ///< the least that descents told
  double step_ = 0.0;  ///< by how much the last bound lay above what a descent came to, of itself
  int searches_ = 0;
};

}  // namespace

Optimum least_bound(const Problem& problem, const OptimizeOptions& options, const std::stop_token& stop,
                    const Progress& progress) {
  return LeastBound(problem, options, stop, progress).found();
}

}  // namespace glissade::optimizer
