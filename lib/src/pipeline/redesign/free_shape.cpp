#include "pipeline/redesign/free_shape.hpp"

#include "glissade/centerline/clothoid_spline.hpp"
#include "glissade/centerline/track_from.hpp"
#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/quantity.hpp"

#include "optimize/stopped.hpp"
#include "pipeline/redesign/places.hpp"
#include "pipeline/redesign/shapes.hpp"
#include "pipeline/task/search_goes_on.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace glissade::pipeline {
namespace {

/// The rate at which the curvature of a certificate's bend grows at most; none where it jumps at E1.
std::optional<double> rate_of(const InRunShape& shape) {
  const double turn = shape.gamma.radians() - shape.alpha.radians();
  switch (shape.transition) {
    case InRunTransition::cubic: {
      // 6 C of eta = C xi^3, at E1
      const double cosine = math::cos(turn);
      const double reach = 2.0 * shape.r1 * math::sin(turn) * cosine * cosine;
      return 2.0 * math::tan(turn) / (reach * reach);
    }
    case InRunTransition::clothoid:
      return 1.0 / (shape.r1 * transition_length(shape));
    default:
      return {};
  }
}

/// Searches the way from the start to the table, which is straight and adds nothing that could be chosen: so the
/// curvature may jump there, as the norm has it.
class FreeShape {
 public:
  /// @param places  counted from the edge
  FreeShape(const Design& design, const RedesignOptions& options, const InRunShape& certificate,
            const RuledLetters& ruled, const TakeOff& take_off, const Problem& places)
      : options_(options),
        certificate_(certificate),
        ruled_(ruled),
        take_off_(take_off),
        places_(places),
        start_area_(start_area_of(design)) {
    table_ = ruled.table ? ruled.table->value : certificate.t;
    problem_.limits = limits_above(table_);
    problem_.places_from = PlacesFrom::finish;
    problem_.body = take_off.body;
    problem_.gravity = take_off.gravity;
    set_goal();
  }

  /// What it is to be the least of.
  [[nodiscard]] double value_of(const RedesignShape& shape) const {
    switch (options_.goal) {
      case RedesignGoal::least_drop:
        return shape.ends.drop;
      case RedesignGoal::least_length:
        return shape.length;
      case RedesignGoal::least_load:
        return shape.highest_load;
      case RedesignGoal::least_curvature_rate:
        return shape.curvature_rate;
      case RedesignGoal::exit_speed:
        break;
    }
    return -shape.take_off_speed;
  }

  /// @return the best shape that keeps all that is asked of the free one; null where none does
  [[nodiscard]] const RedesignShape* best_of(const std::vector<RedesignShape>& shapes) const {
    const RedesignShape* best = nullptr;
    for (const RedesignShape& shape : shapes) {
      if (keeps(shape) && (best == nullptr || value_of(shape) < value_of(*best))) best = &shape;
    }
    return best;
  }

  /// @param known  whether there is a shape to tell where none is found
  /// @return the whole track, its table included
  /// @throws InfeasibleError if table and start area alone are in the way; ConvergenceError if there is none; Interrupted if it was to end
  ///         before there was one, and none is known
  CenterlinePtr found(const RunContext& context, bool known, std::optional<OptimizeReport>& report) {
    if (const auto conflict = conflict_of_straights()) {
      report = OptimizeReport{};
      report->status = OptimizeStatus::infeasible;
      report->message = conflict->text;
      report->objective = problem_.objective;
      report->conflict = *conflict;
      throw InfeasibleError({"", conflict->text, conflict->why, ""});
    }
    const SearchGoesOn goes_on(context);
    OptimizeOptions options;
    options.time_budget = context.time_budget;
    double wanted = is_speed_given() ? speed_above_table() : 0.0;
    CenterlinePtr track;
    // A skier's centre of mass feels the end of the bend: the speed above the table is corrected by what is missed.
    constexpr int kMostRounds = 4;
    for (int round = 0; round < kMostRounds; ++round) {
      if (is_speed_given()) problem_.limits.exit_speed.lowest = wanted;
      // All rounds have one budget; where nothing is left of it the last one says so.
      if (report) options.time_budget = std::max(kLeastBudget, options.time_budget - report->seconds);
      Optimum optimum = optimize(problem_, options, context.stop, context.progress);
      const bool stopped = context.stop.stop_requested();
      if (!optimum.centerline && stopped && track == nullptr && !known)
        throw Interrupted({"", "interrupted in the search", "", ""});
      // Of a round that was stopped before it came to a track the one before is the best so far.
      if (!optimum.centerline && stopped && track != nullptr) {
        optimizer::tell_stopped(*report);
        break;
      }
      report = std::move(optimum.report);
      if (!optimum.centerline) throw ConvergenceError({"", report->message, "", ""});
      track = with_table(*optimum.centerline);
      // A round that was cut short missed the speed for that alone.
      if (!is_speed_given() || stopped || report->ended_early) break;
      const Motion motion(track, take_off_.body, take_off_.gravity);
      const double miss = take_off_.speed - (motion.arrived() ? motion.exit_speed() : 0.0);
      if (std::fabs(miss) < kEnough * take_off_.speed) break;
      wanted += miss;
    }
    return track;
  }

 private:
  void set_goal() {
    switch (options_.goal) {
      case RedesignGoal::least_drop:
        problem_.objective.kind = ObjectiveKind::least_drop;
        break;
      case RedesignGoal::least_length:
        problem_.objective.kind = ObjectiveKind::least_length;
        break;
      case RedesignGoal::least_load:
        problem_.objective.kind = ObjectiveKind::least_load;
        break;
      case RedesignGoal::least_curvature_rate:
        problem_.objective.kind = ObjectiveKind::least_curvature_rate;
        break;
      case RedesignGoal::exit_speed:
        problem_.objective.kind = ObjectiveKind::exit_speed;
        break;
    }
    const bool free =
        options_.goal == RedesignGoal::least_drop || options_.goal == RedesignGoal::least_length;
    problem_.finish.kind = free ? FinishKind::anywhere : FinishKind::level;
    const double drop = InRun(certificate_).endpoints().drop;
    problem_.endpoints = {0.0, drop - table_ * math::sin(certificate_.alpha.radians())};
  }

  static constexpr double kEnough = 1e-7;       // accuracy: of the take-off speed
  static constexpr double kLeastBudget = 1e-3;  // budget: [s]

  [[nodiscard]] bool is_speed_given() const { return options_.goal != RedesignGoal::exit_speed; }

  /// What is asked of the way to a table of that length.
  [[nodiscard]] Limits limits_above(double table) const {
    const double alpha = certificate_.alpha.radians();
    Limits limits = moved(places_.limits, {table * math::cos(alpha), table * math::sin(alpha)});
    limits.slope_angle.highest = ruled_.steepest ? ruled_.steepest->value : certificate_.gamma.radians();
    limits.exit_slope_angle = Range::fixed(alpha);
    limits.concave = true;
    limits.lead_in = start_area_;
    if (options_.goal != RedesignGoal::least_load)
      limits.smallest_valley_radius = ruled_.radius ? ruled_.radius->value : certificate_.r1;
    if (options_.goal != RedesignGoal::least_curvature_rate) {
      limits.highest_curvature_rate =
          options_.curvature_rate ? options_.curvature_rate : rate_of(certificate_);
    }
    return limits;
  }

  /// Whether a shape with a table of its own, no shorter, keeps all that is asked of the free one.
  [[nodiscard]] bool keeps(const RedesignShape& shape) const {
    constexpr double kRounding = 1e-9;  // rounding: of lengths that are sums
    constexpr double kLevel = 1e-6;     // accuracy: of the drop, as searches meet it [m]
    if (shape.track == nullptr || !shape.problem.empty()) return false;
    // Of one that is faster the body does not take off at that speed, either.
    if (is_speed_given() && std::fabs(shape.take_off_speed - take_off_.speed) > kEnough * take_off_.speed)
      return false;
    const double drop = InRun(certificate_).endpoints().drop;
    if (problem_.finish.kind == FinishKind::level && std::fabs(shape.ends.drop - drop) > kLevel) return false;
    const std::vector<double> breaks = shape.track->breaks();
    const double begins = breaks[breaks.size() - 2];
    const double table = shape.length - begins;
    const bool straight = shape.track->direction(begins + 0.5 * table).curvature == 0.0;
    if (!straight || begins == 0.0 || table < (1.0 - kRounding) * table_) return false;
    if (straight_of(*shape.track) < (1.0 - kRounding) * start_area_) return false;
    Problem above = problem_;
    above.limits = limits_above(table);
    above.limits.lead_in = 0.0;  // looked at already
    above.finish.kind = FinishKind::anywhere;
    above.objective = {};
    const auto way = std::make_shared<const TrackFrom>(shape.track, 0.0, begins);
    above.endpoints = way->endpoints();
    const std::vector<LimitCheck> checks = check_limits(above, way);
    return std::all_of(checks.begin(), checks.end(), [](const LimitCheck& check) { return check.kept(); });
  }

  /// The speed at the end of a straight as steep as the table, of a body that enters it with one; 0 of one that does not get
  /// there [m/s].
  [[nodiscard]] double speed_down(double length, double entry_speed) const {
    const auto straight = std::make_shared<const ClothoidSpline>(
        certificate_.alpha, std::vector<ClothoidSegment>{{length, 0.0, 0.0}});
    Body body = take_off_.body;
    body.entry_speed = entry_speed;
    const Motion motion(straight, body, take_off_.gravity);
    return motion.arrived() ? motion.exit_speed() : 0.0;
  }

  /// Whether no way over start area and table is slower than one all as steep as the table. On a bend that turns from theta down to
  /// alpha, q = v^2 exp(-2 mu (theta - alpha)) grows by 2 g (sin(theta) - mu cos(theta)) exp(-2 mu (theta - alpha)) along the track,
  /// the more the steeper as long as tan(theta) < (1 + 2 mu^2)/mu, which is 2.83 or more, less a drag that is no greater than that
  /// of the speed sqrt(q) unless the wind comes from behind.
  [[nodiscard]] bool is_least_on_ramp() const {
    constexpr double kSteepest = 2.8;  // theory: of 2 sqrt(2), with room
    const Body& body = take_off_.body;
    return !body.law && body.friction_changes.empty() && !(body.head_wind < 0.0) &&
           *problem_.limits.slope_angle.highest < math::atan(kSteepest);
  }

  /// Why no way to the table can be: table and start area alone are too high, or too fast. No search is needed for that.
  [[nodiscard]] std::optional<Conflict> conflict_of_straights() const {
    const double drop = InRun(certificate_).endpoints().drop;
    if (problem_.finish.kind == FinishKind::level && !(problem_.endpoints.drop > 0.0)) {
      const auto [own, whole] = texts_apart(drop - problem_.endpoints.drop, drop, &length_text);
      return Conflict{{},
                      {},
                      "the table alone, " + length_text(table_) + ", drops by " + own +
                          ", which leaves nothing of the in-run's " + whole + "; it would take a shorter one",
                      "The start is as high above the edge as that of the certificate."};
    }
    if (!is_speed_given()) return {};
    if (const double least = speed_down(table_, 0.0); least > take_off_.speed) {
      return too_fast("the table alone, " + length_text(table_) + ", gives", least, "a shorter table",
                      "Whatever lies above the table, a body enters it with no less than that.");
    }
    if (!(start_area_ > 0.0) || !is_least_on_ramp()) return {};
    if (const double least = speed_down(start_area_ + table_, 0.0); least > take_off_.speed) {
      return too_fast(
          "start area and table alone, " + length_text(start_area_) + " and " + length_text(table_) +
              ", give",
          least, "a shorter start area or table",
          "No part of the way is less steep than the table: a body is no slower than on a ramp as steep.");
    }
    return {};
  }

  [[nodiscard]] Conflict too_fast(const std::string& what, double least, const std::string& change,
                                  std::string why) const {
    const auto [given, wanted] = texts_apart(least, take_off_.speed, [](double speed, int digits) {
      return quantity_text(speed, Dimension::speed, digits);
    });
    return {{},
            {},
            what + " more than the take-off speed: " + given + " from rest, " + wanted +
                " are asked for; it would take " + change + ", or a higher speed",
            std::move(why)};
  }

  /// The speed where the table begins that gives the take-off speed at its end.
  [[nodiscard]] double speed_above_table() const {
    double speed = take_off_.speed;
    constexpr int kMostRounds = 20;
    for (int round = 0; round < kMostRounds; ++round) {
      const double miss = take_off_.speed - speed_down(table_, speed);
      speed = std::max(speed + miss, 0.0);
      if (std::fabs(miss) < kTakeOffAccuracy * take_off_.speed) break;
    }
    return speed;
  }

  [[nodiscard]] CenterlinePtr with_table(const Centerline& found) const {
    const auto& spline = dynamic_cast<const ClothoidSpline&>(found);
    std::vector<ClothoidSegment> segments = spline.segments();
    segments.push_back({table_, 0.0, 0.0});
    return std::make_shared<const ClothoidSpline>(spline.entry_slope_angle(), std::move(segments));
  }

  const RedesignOptions& options_;
  const InRunShape& certificate_;
  const RuledLetters& ruled_;
  const TakeOff& take_off_;
  const Problem& places_;
  double start_area_;
  double table_ = 0.0;
  Problem problem_;
};

}  // namespace

RedesignShape free_shape(const Design& design, const RedesignOptions& options, const InRunShape& certificate,
                         const RuledLetters& ruled, const Problem& places, const RunContext& context,
                         Redesign& result) {
  FreeShape search(design, options, certificate, ruled, result.take_off, places);
  const RedesignShape* const known = search.best_of(result.shapes);
  const std::string name = "free, " + std::string(word(result.goal));
  RedesignShape found = attempted(name, result.take_off,
                                  [&] { return search.found(context, known != nullptr, result.search); });
  constexpr double kBetter = 1e-6;  // rounding: by less two routes to one shape differ
  if (known == nullptr || !result.search) return found;
  const double least = search.value_of(*known);
  const bool is_worse = found.track == nullptr || search.value_of(found) > least + kBetter * std::fabs(least);
  if (!is_worse) return found;
  OptimizeReport& report = *result.search;
  report.status = OptimizeStatus::feasible_not_converged;
  report.message += "; no better shape is known than this one: " + known->name;
  report.first_order_residual = HUGE_VAL;
  report.finer_mesh_wins.reset();
  report.active.clear();
  report.conflict = {};
  found = *known;
  found.name = name;
  return found;
}

}  // namespace glissade::pipeline
