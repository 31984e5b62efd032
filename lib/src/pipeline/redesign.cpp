#include "glissade/pipeline/redesign.hpp"

#include "glissade/centerline/clothoid_spline.hpp"
#include "glissade/centerline/track_from.hpp"
#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/quantity.hpp"
#include "glissade/pipeline/rules.hpp"

#include "optimize/stopped.hpp"
#include "pipeline/ride/extremes.hpp"
#include "pipeline/task/search_goes_on.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <memory>
#include <tuple>
#include <utility>

namespace glissade {

using namespace pipeline;

namespace {

constexpr std::array<std::string_view, 5> kGoalWords = {"least-drop", "least-length", "least-load",
                                                        "least-curvature-rate", "exit-speed"};
constexpr std::string_view kWithinRules = "its letters within the rules";

// --- what the rules say of letters -------------------------------------------------------------------

/// A bound of a letter and the rule that sets it.
struct RuledBound {
  double value = 0.0;
  const Rule* rule = nullptr;
  double by_speed = 0.0;  ///< d(value)/d(v0), of a rule that counts with v0 or with the speed of a ride
};

struct RuledLetters {
  std::optional<RuledBound> steepest;  ///< gamma at most
  std::optional<RuledBound> radius;    ///< r1 at least
  std::optional<RuledBound> table;     ///< t at least
};

void tighten(std::optional<RuledBound>& bound, double value, const Rule& rule, double sign,
             double by_speed = 0.0) {
  if (!bound || sign * value > sign * bound->value) bound = RuledBound{value, &rule, by_speed};
}

bool applies(const Rule& rule, const Measurements& measurements) {
  return std::all_of(rule.when.begin(), rule.when.end(), [&](const RuleCondition& condition) {
    return is_met(condition, measurements).value_or(false);
  });
}

/// @param v0  the speed that the rules size table and transition by [m/s]
RuledLetters ruled_letters(const Design& design, const Measurements& measurements, double v0) {
  RuledLetters letters;
  for (const Rule& rule : design.rules.in_force) {
    if (!applies(rule, measurements)) continue;
    const Range& bound = rule.bound;
    if (rule.quantity == "in_run_slope_angle" && bound.highest)
      tighten(letters.steepest, *bound.highest, rule, -1.0);
    if (rule.quantity == "transition_radius" && bound.lowest)
      tighten(letters.radius, *bound.lowest, rule, 1.0);
    if (rule.quantity == "design_radial_acceleration" && bound.highest)
      tighten(letters.radius, v0 * v0 / *bound.highest, rule, 1.0, 2.0 * v0 / *bound.highest);
    if (rule.quantity == "table_length" && bound.lowest) tighten(letters.table, *bound.lowest, rule, 1.0);
    if (rule.quantity == "table_time" && bound.lowest)
      tighten(letters.table, v0 * *bound.lowest, rule, 1.0, *bound.lowest);
  }
  return letters;
}

/// A letter that a rule bounds may take any value within it; of the others each stays.
LetterBounds bounds_of(const RuledLetters& ruled) {
  LetterBounds bounds;
  if (ruled.steepest) bounds.gamma.highest = ruled.steepest->value;
  if (ruled.radius) bounds.r1.lowest = ruled.radius->value;
  if (ruled.table) bounds.t.lowest = ruled.table->value;
  return bounds;
}

// --- shapes and their rides --------------------------------------------------------------------------

/// Highest rate of the curvature between its jumps, and the largest of those but for the one at the table's beginning.
void measure_bends(const Centerline& track, RedesignShape& shape) {
  constexpr int kSamples = 200;
  constexpr double kInside = 1e-9;
  const std::vector<double> breaks = track.breaks();
  double before = 0.0;
  for (std::size_t i = 1; i < breaks.size(); ++i) {
    const double from = breaks[i - 1];
    const double width = (breaks[i] - from) * (1.0 - kInside);
    const auto curvature = [&](int k) { return track.direction(from + width * k / kSamples).curvature; };
    double last = curvature(0);
    const bool at_table = i + 1 == breaks.size();
    if (i > 1 && !at_table) shape.largest_jump = std::max(shape.largest_jump, std::fabs(last - before));
    for (int k = 1; k <= kSamples; ++k) {
      const double now = curvature(k);
      shape.curvature_rate = std::max(shape.curvature_rate, std::fabs(now - last) * kSamples / width);
      last = now;
    }
    before = last;
  }
}

RedesignShape ridden(std::string name, CenterlinePtr track, const TakeOff& take_off) {
  RedesignShape shape;
  shape.name = std::move(name);
  const Motion motion(track, take_off.body, take_off.gravity);
  shape.ends = track->endpoints();
  shape.length = track->length();
  if (motion.arrived()) {
    shape.take_off_speed = motion.exit_speed();
  } else {
    shape.problem = "the body does not arrive at the edge";
  }
  shape.highest_load = motion.highest_load().normal_load;
  shape.highest_radial = highest_radial_acceleration(motion).value;
  measure_bends(*track, shape);
  shape.track = std::move(track);
  return shape;
}

/// A shape, or why there is none.
RedesignShape attempted(const std::string& name, const TakeOff& take_off,
                        const std::function<CenterlinePtr()>& make) {
  try {
    return ridden(name, make(), take_off);
  } catch (const Interrupted&) {
    throw;
  } catch (const Error& error) {
    RedesignShape none;
    none.name = name;
    none.problem = error.issues().front().what;
    return none;
  }
}

/// The same of one that letters make.
RedesignShape lettered(const std::string& name, const TakeOff& take_off,
                       const std::function<InRunShape()>& make) {
  std::optional<InRunShape> letters;
  RedesignShape shape = attempted(name, take_off, [&] {
    letters = make();
    return std::make_shared<const InRun>(*letters);
  });
  if (shape.track != nullptr) shape.letters = letters;
  return shape;
}

std::string name_of(InRunTransition transition) {
  switch (transition) {
    case InRunTransition::cubic:
      return "cubic";
    case InRunTransition::circle:
      return "circle";
    case InRunTransition::clothoid:
      return "clothoid";
    case InRunTransition::two_radii:
      break;
  }
  return "two-radii";
}

/// What rules allow in a bend.
struct BendBounds {
  double radial = HUGE_VAL;  ///< v^2/radius at most [m/s^2]
  double load = HUGE_VAL;    ///< normal load at most [m/s^2]
};

/// @param otherwise  the v^2/radius where no rule speaks of it or of the load [m/s^2]
BendBounds bend_bounds(const Design& design, const Measurements& measurements, double otherwise) {
  const double table_weight = design.gravity * math::cos(design.centerline.in_run.alpha.radians());
  BendBounds bounds;
  for (const Rule& rule : design.rules.in_force) {
    if (!rule.bound.highest || !applies(rule, measurements)) continue;
    const double highest = *rule.bound.highest;
    if (rule.quantity == "design_radial_acceleration" || rule.quantity == "highest_radial_acceleration")
      bounds.radial = std::min(bounds.radial, highest);
    if (rule.quantity == "highest_normal_load") bounds.load = std::min(bounds.load, highest);
    if (rule.quantity == "load_above_table_weight")
      bounds.load = std::min(bounds.load, table_weight + highest);
  }
  if (std::isinf(bounds.radial) && std::isinf(bounds.load)) bounds.radial = otherwise;
  return bounds;
}

/// Its v^2/radius is kept at what the rules allow, or at as much as leaves the load at what they allow.
CenterlinePtr load_controlled(const InRunShape& certificate, const TakeOff& take_off,
                              const BendBounds& bounds) {
  const double table_weight = take_off.gravity * math::cos(certificate.alpha.radians());
  double radial = std::min(bounds.radial, bounds.load - table_weight);
  CenterlinePtr track;
  constexpr int kMostRounds = 8;    // budget: each leaves some hundredth of what was missing
  constexpr double kEnough = 1e-9;  // rounding: of a bound
  for (int round = 0; round < kMostRounds; ++round) {
    track = std::make_shared<const ClothoidSpline>(load_controlled_in_run(certificate, radial, take_off));
    if (std::isinf(bounds.load)) break;
    const Motion motion(track, take_off.body, take_off.gravity);
    // Where the weight counts most, at the end of the bend, the load is fading already: there is more to give.
    const double wanted = std::min(bounds.radial, radial + bounds.load - motion.highest_load().normal_load);
    if (std::fabs(wanted - radial) <= kEnough * bounds.load) break;
    radial = wanted;
  }
  return track;
}

/// The certificate's own letters with every other transition, and the curves of the literature.
void add_comparisons(const InRunShape& certificate, const TakeOff& take_off, const BendBounds& bounds,
                     std::vector<RedesignShape>& shapes) {
  for (const InRunTransition other :
       {InRunTransition::cubic, InRunTransition::circle, InRunTransition::clothoid}) {
    if (other == certificate.transition) continue;
    InRunShape shape = certificate;
    shape.transition = other;
    shapes.push_back(
        lettered("its letters, " + name_of(other), take_off, [&] { return reaching(shape, take_off); }));
  }
  shapes.push_back(attempted("power curve (after Zanevskyy)", take_off, [&] {
    return std::make_shared<const ClothoidSpline>(power_in_run(certificate, take_off));
  }));
  // Its pieces have a rate each; the curve's own, of xi^(1/cos(D) - 2), has no bound at E1 while cos(D) is above 1/2.
  if (shapes.back().track != nullptr &&
      2.0 * math::cos((certificate.gamma - certificate.alpha).radians()) > 1.0) {
    shapes.back().curvature_rate = HUGE_VAL;
  }
  shapes.push_back(attempted("load-controlled (after Palej, Filipowska)", take_off,
                             [&] { return load_controlled(certificate, take_off, bounds); }));
}

// --- what is in the way ------------------------------------------------------------------------------

/// The clearances and waypoints of a design, counted from the edge of its in-run; of its other limits rules take the place.
Problem places_to_edge(const Design& design, const Endpoints& certificate) {
  Problem places = problem_of(design);
  const Limits asked = std::exchange(places.limits, {});
  const Vec2 edge{certificate.run, certificate.drop};
  const auto counted = [&](std::vector<Vec2> points) {
    for (Vec2& point : points) point = point - edge;
    return points;
  };
  Limits& limits = places.limits;
  limits.envelope = asked.envelope;
  limits.half_planes = asked.half_planes;
  for (HalfPlane& plane : limits.half_planes) plane.point = plane.point - edge;
  limits.keep_outs = asked.keep_outs;
  for (KeepOut& area : limits.keep_outs) area.outline = counted(area.outline);
  limits.stay_above = asked.stay_above;
  limits.stay_below = asked.stay_below;
  for (std::vector<Profile>* const lines : {&limits.stay_above, &limits.stay_below}) {
    for (Profile& profile : *lines) profile.line = counted(profile.line);
  }
  limits.waypoints = counted(asked.waypoints);
  places.finish = {FinishKind::level, {}, {}};
  places.places_from = PlacesFrom::finish;
  return places;
}

/// The same, counted from a place before the edge.
Limits moved(Limits limits, Vec2 from_there_to_edge) {
  const auto move = [&](std::vector<Vec2>& points) {
    for (Vec2& point : points) point = point + from_there_to_edge;
  };
  for (HalfPlane& plane : limits.half_planes) plane.point = plane.point + from_there_to_edge;
  for (KeepOut& area : limits.keep_outs) move(area.outline);
  for (Profile& profile : limits.stay_above) move(profile.line);
  for (Profile& profile : limits.stay_below) move(profile.line);
  move(limits.waypoints);
  return limits;
}

/// Along which gates lie, and no bend begins; 0 where the design says nothing of it.
double start_area_of(const Design& design) {
  const double of_gates = design.gates ? design.gates->start_area.value_or(0.0) : 0.0;
  return std::max(of_gates, design.centerline.in_run.start_area().value_or(0.0));
}

/// How far a track is straight from its start on.
double straight_of(const Centerline& track) {
  const std::vector<double> breaks = track.breaks();
  for (std::size_t i = 1; i < breaks.size(); ++i) {
    const double middle = breaks[i - 1] + 0.5 * (breaks[i] - breaks[i - 1]);
    if (track.direction(middle).curvature != 0.0) return breaks[i - 1];
  }
  return track.length();
}

/// Tells of each shape but the free one, which the search holds to it, where gates would lie in the bend.
void hold_to_area(double area, std::vector<RedesignShape>& shapes) {
  for (std::size_t i = 0; i + 1 < shapes.size(); ++i) {
    RedesignShape& shape = shapes[i];
    if (shape.track == nullptr) continue;
    constexpr double kRounding = 1e-9;  // rounding: of lengths that are sums
    const double straight = straight_of(*shape.track);
    if (straight < area * (1.0 - kRounding)) shape.short_straight = straight;
  }
}

/// Tells of each shape what it runs into.
void hold_against(Problem places, std::vector<RedesignShape>& shapes) {
  if (!places.limits.has_clearances() && places.limits.waypoints.empty()) return;
  for (RedesignShape& shape : shapes) {
    if (shape.track == nullptr) continue;
    for (const LimitCheck& check : check_limits(places, shape.track)) {
      if (check.kept() || entry_of(check.limit.id).form != LimitForm::list) continue;
      shape.breaks.push_back(check.limit.key());
    }
  }
}

// --- the free shape ----------------------------------------------------------------------------------

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

/// The free shape. Where a search ended with a worse one than is known, or with none, what is known is the answer.
RedesignShape free_shape(FreeShape& search, const RunContext& context, Redesign& result) {
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

// --- prices ------------------------------------------------------------------------------------------

bool lies_at(const std::optional<RuledBound>& bound, double value) {
  constexpr double kAt = 1e-9;  // rounding, of the bound
  return bound && std::fabs(value - bound->value) <= kAt * std::fabs(bound->value);
}

/// The price of the take-off speed, alone and with the letters that rules size by it.
LetterPrice price_of_speed(const InRunShape& shape, double speed, const DropSlopes& slopes,
                           const RuledLetters& ruled) {
  LetterPrice row;
  row.letter = "v";
  row.value = speed;
  row.price = slopes.by_speed;
  row.dimension = Dimension::speed;
  double price = slopes.by_speed;
  const auto follow = [&](const char* name, double value, double by_letter,
                          const std::optional<RuledBound>& bound) {
    if (!lies_at(bound, value) || bound->by_speed == 0.0) return;
    row.following.emplace_back(name);
    price += by_letter * bound->by_speed;
  };
  follow("r1", shape.r1, slopes.by_r1, ruled.radius);
  follow("t", shape.t, slopes.by_t, ruled.table);
  if (!row.following.empty()) row.price_with_rules = price;
  return row;
}

std::vector<LetterPrice> prices_of(const InRunShape& shape, const TakeOff& take_off,
                                   const RuledLetters& ruled) {
  const DropSlopes slopes = drop_slopes(shape, take_off);
  const auto letter = [](const char* name, double value, double price, Dimension dimension,
                         const std::optional<RuledBound>& bound = {}) {
    LetterPrice row;
    row.letter = name;
    row.value = value;
    row.price = price;
    row.dimension = dimension;
    if (bound && lies_at(bound, value)) {
      row.rule = bound->rule->id;
      row.certainty = bound->rule->certainty;
    }
    return row;
  };
  return {letter("gamma", shape.gamma.radians(), slopes.by_gamma, Dimension::angle, ruled.steepest),
          letter("alpha", shape.alpha.radians(), slopes.by_alpha, Dimension::angle),
          letter("r1", shape.r1, slopes.by_r1, Dimension::length, ruled.radius),
          letter("t", shape.t, slopes.by_t, Dimension::length, ruled.table),
          price_of_speed(shape, take_off.speed, slopes, ruled)};
}

TakeOff take_off_of(const Design& design, const RedesignOptions& options, const CenterlinePtr& certificate) {
  TakeOff take_off{body_of(design), 0.0, design.gravity};
  if (options.speed) {
    take_off.speed = *options.speed;
    return take_off;
  }
  const Motion motion(certificate, take_off.body, take_off.gravity);
  if (!motion.arrived()) {
    throw InfeasibleError({design.where("centerline"), "the body does not arrive at the edge of the in-run",
                           "What it would be redesigned for is its take-off speed.",
                           "less friction, or --speed"});
  }
  take_off.speed = motion.exit_speed();
  return take_off;
}

}  // namespace

std::string_view word(RedesignGoal goal) {
  return kGoalWords[static_cast<std::size_t>(goal)];
}

const std::vector<RedesignGoal>& redesign_goals() {
  static const std::vector<RedesignGoal> all = {RedesignGoal::least_drop, RedesignGoal::least_length,
                                                RedesignGoal::least_load, RedesignGoal::least_curvature_rate,
                                                RedesignGoal::exit_speed};
  return all;
}

namespace {

/// How many times as large r1 has to be for the rule on the load of the bend that asks for most, below 1 where all are kept with
/// room to spare; that rule, and what r1 grows by with the take-off speed. None where there is no such rule.
std::optional<RuledBound> growth_of_radius(const Design& design, const Measurements& measurements,
                                           double speed) {
  const Extremes* const bend = measurements.find("highest_radial_acceleration");
  if (bend == nullptr || !bend->most()) return {};
  const double radial = bend->most()->value;
  std::optional<RuledBound> growth;
  for (const Rule& rule : design.rules.in_force) {
    const bool of_bend = rule.quantity == "highest_radial_acceleration" ||
                         rule.quantity == "highest_normal_load" || rule.quantity == "load_above_table_weight";
    const Extremes* const load = of_bend ? measurements.find(rule.quantity) : nullptr;
    if (load == nullptr || !load->most() || !rule.bound.highest || !applies(rule, measurements)) continue;
    // What curvature adds to the load goes with 1/r1.
    const double allowed = radial - (load->most()->value - *rule.bound.highest);
    if (!(allowed > 0.0)) continue;
    // The squared speed of that ride grows by about as much as that of the one that counts.
    tighten(growth, radial / allowed, rule, 1.0, 2.0 * speed / allowed);
  }
  return growth;
}

/// The lowest letters within bounds that keep a straight along the start area. What shortens it is a steep in-run, of which
/// the bend takes more of the height: gamma gives way where it may be chosen. If that does not help it is told of the shape.
/// @throws InfeasibleError if no letters within the bounds reach the speed
InRunShape least_drop_beside_area(const InRunShape& certificate, LetterBounds bounds, const TakeOff& take_off,
                                  double area) {
  const LetterBounds elsewhere = bounds;
  constexpr double kBeyond = 1.0 + 1e-9;  // rounding: on the safe side, when read back too
  bounds.straight = kBeyond * area;
  const auto lowest = [&]() -> std::optional<InRunShape> {
    try {
      return least_drop_in_run(certificate, bounds, take_off);
    } catch (const InfeasibleError&) {
      return {};
    }
  };
  if (area > 0.0) {
    if (const auto found = lowest()) return *found;
    if (bounds.gamma.highest) {
      constexpr double kHardly = 1.0 / 64.0;  // budget: of the turn, hardly a bend
      const double alpha = certificate.alpha.radians();
      bounds.gamma.lowest = alpha + kHardly * (*bounds.gamma.highest - alpha);
      if (const auto found = lowest()) return *found;
    }
  }
  return least_drop_in_run(certificate, elsewhere, take_off);
}

/// growth_of_radius() of the letters found; none where their gates cannot be ridden: that no gamma leaves a straight along the
/// start area is told of the shape.
std::optional<RuledBound> growth_for_rides(const Design& design, const Redesign& result,
                                           const RunContext& context) {
  try {
    const Design found = redesigned(design, result, false);
    return growth_of_radius(design, rule_measurements(found, solve(found, context)), result.take_off.speed);
  } catch (const InfeasibleError&) {
    return {};
  } catch (const InputError&) {
    return {};
  }
}

/// The least r1 with which every rule on a ride is kept, by secants of the logarithms: what curvature adds to the load goes with
/// about 1/r1.
class RadiusForRides {
 public:
  /// Whether the rides of a radius keep every rule, and hardly more than that.
  [[nodiscard]] static bool keeps(double growth) { return growth <= 1.0 + kRounding; }
  [[nodiscard]] static bool keeps_barely(double growth) {
    return keeps(growth) && growth >= 1.0 - 2.0 * kRoom;
  }

  /// @return the radius to try next
  double after(double radius, double growth) {
    const double x = math::log(radius);
    const double y = math::log(growth);
    double slope = -1.0;
    if (before_ && before_->first != x) {
      const double secant = (y - before_->second) / (x - before_->first);
      constexpr double kMost = 3.0;  // taste: beyond, another gate or gamma got in between
      if (secant < -1.0 / kMost && secant > -kMost) slope = secant;
    }
    before_ = {x, y};
    return math::exp(x - (y + kRoom) / slope);
  }

 private:
  static constexpr double kRounding = 1e-9;  // rounding: of a bound, as rules count what lies at it
  static constexpr double kRoom = 5e-8;      // accuracy: of r1, on the safe side
  std::optional<std::pair<double, double>> before_;
};

/// The lowest in-run of a certificate's letters that keeps every rule: those on the ride, too, from every gate and in every
/// condition, of which a fast one is faster than the nominal ride.
/// @param result  of which within_rules changes
/// @throws InfeasibleError if no letters reach the speed
InRunShape letters_within_rules(const Design& design, const InRunShape& certificate,
                                const RunContext& context, RuledLetters& ruled, Redesign& result) {
  const auto lowest = [&] {
    return least_drop_beside_area(certificate, bounds_of(ruled), result.take_off, result.start_area);
  };
  RadiusForRides radius;
  std::optional<std::pair<InRunShape, RuledLetters>> kept;  // the one with the least r1
  constexpr int kMostRounds = 12;  // budget: some five of them for what a load asks for
  result.within_rules = lowest();
  for (int round = 0; round < kMostRounds; ++round) {
    const InRunShape& found = *result.within_rules;
    const std::optional<RuledBound> growth = growth_for_rides(design, result, context);
    const bool keeps = !growth || RadiusForRides::keeps(growth->value);
    if (keeps && (!kept || found.r1 < kept->first.r1)) kept = {found, ruled};
    // With the r1 that rules on the letters ask for, or one that is lower for being larger, no load holds it.
    const bool is_free = round == 0 || !ruled.radius || found.r1 > ruled.radius->value;
    if (!growth || (keeps && is_free) || RadiusForRides::keeps_barely(growth->value)) break;
    ruled.radius = RuledBound{radius.after(found.r1, growth->value), growth->rule, growth->by_speed};
    result.within_rules = lowest();
  }
  if (kept) std::tie(*result.within_rules, ruled) = *kept;
  return *result.within_rules;
}

/// Of letters within the rules, where there are any.
void add_prices(const TakeOff& take_off, const RuledLetters& ruled, Redesign& result) {
  const InRunShape& letters = *result.within_rules;
  try {
    result.prices = prices_of(letters, take_off, ruled);
  } catch (const InfeasibleError&) {
    return;  // no letters near them reach the speed
  }
  constexpr double kJust = 1.0 + 1e-6;  // rounding: of a straight that gamma has given way for
  constexpr double kHardly = 1e-6;      // accuracy: of one that is hardly there [m]
  const bool just_fits = InRun(letters).transition_begins() <= kJust * result.start_area + kHardly;
  LetterPrice& gamma = result.prices.front();
  gamma.by_start_area =
      just_fits && ruled.steepest && letters.gamma.radians() < ruled.steepest->value && gamma.rule.empty();
}

}  // namespace

Redesign redesign(const Design& design, const RedesignOptions& options, const RunContext& context) {
  if (design.centerline.kind != CenterlineKind::in_run) {
    throw InputError(
        {design.where("centerline.kind"),
         "a track of kind " + std::string(word(design.centerline.kind)) + " is no in-run by its letters",
         "What is redesigned are gamma, r1 and t of a certificate.", "kind: in-run"});
  }
  const Track track = solve(design, context);
  const InRunShape certificate = design.centerline.in_run.shape();
  Redesign result;
  result.goal = options.goal;
  result.start_area = start_area_of(design);
  result.take_off = take_off_of(design, options, track.centerline);
  const TakeOff& take_off = result.take_off;
  const double v0 = design.hill.design_speed.value_or(take_off.speed);
  const Measurements measurements = rule_measurements(design, track);
  RuledLetters ruled = ruled_letters(design, measurements, v0);
  if (design.hill.design_speed) {  // rules count with that speed, whatever the take-off's is
    for (auto* const bound : {&ruled.radius, &ruled.table}) {
      if (*bound) (*bound)->by_speed = 0.0;
    }
  }

  result.shapes.push_back(ridden("certificate", track.centerline, take_off));
  result.shapes.back().letters = certificate;
  const bool moved = std::fabs(result.shapes.front().take_off_speed / take_off.speed - 1.0) > 1e-9;
  if (moved) {
    result.shapes.push_back(
        lettered("its letters, at that speed", take_off, [&] { return reaching(certificate, take_off); }));
  }
  result.shapes.push_back(lettered(std::string(kWithinRules), take_off, [&] {
    return letters_within_rules(design, certificate, context, ruled, result);
  }));
  if (result.shapes.back().letters) {
    add_prices(take_off, ruled, result);
  } else {
    result.within_rules.reset();
  }
  const double radius = ruled.radius ? ruled.radius->value : certificate.r1;
  const BendBounds bounds = bend_bounds(design, measurements, take_off.speed * take_off.speed / radius);
  add_comparisons(certificate, take_off, bounds, result.shapes);
  const Problem places = places_to_edge(design, result.shapes.front().ends);
  FreeShape search(design, options, certificate, ruled, take_off, places);
  result.shapes.push_back(free_shape(search, context, result));
  hold_against(places, result.shapes);
  hold_to_area(result.start_area, result.shapes);
  return result;
}

bool Redesign::is_infeasible() const {
  return shapes.back().track == nullptr && search && search->status == OptimizeStatus::infeasible;
}

std::optional<Issue> Redesign::search_problem() const {
  const RedesignShape& free = shapes.back();
  if (free.track == nullptr) {
    return Issue{"", "there is no free shape: " + free.problem, search ? search->conflict.why : "", ""};
  }
  if (!search || search->status == OptimizeStatus::optimal) return {};
  const bool early = search->ended_early;
  return Issue{"",
               std::string("the search for the free shape ") +
                   (early ? "ended early: " : "did not converge: ") + search->message,
               "It keeps every limit, but a better shape may be near.",
               early ? hint_to_search_on(search->interrupted) : "another goal; more time would not help"};
}

std::optional<Issue> Redesign::letters_problem() const {
  if (within_rules) return {};
  const auto of_letters = std::find_if(shapes.begin(), shapes.end(),
                                       [](const RedesignShape& shape) { return shape.name == kWithinRules; });
  const std::string why = of_letters == shapes.end() ? std::string() : ": " + of_letters->problem;
  return Issue{"", "there are no letters within the rules" + why, "",
               "another --speed, or rules of your own that leave more room"};
}

Design redesigned(const Design& design, const Redesign& found, bool free) {
  Design result = design;
  const RedesignShape& shape = found.shapes.back();
  if (free && shape.track == nullptr) {
    if (found.is_infeasible()) throw InfeasibleError(*found.search_problem());
    throw ConvergenceError(*found.search_problem());
  }
  InRunDesign& letters = result.centerline.in_run;
  const double area = letters.start_area().value_or(0.0);
  // Rules count with the speed that it was found for.
  if (!result.hill.design_speed) result.hill.design_speed = found.take_off.speed;
  const std::optional<InRunShape> made_by = free ? shape.letters : found.within_rules;
  if (!free && !made_by) throw InfeasibleError(*found.letters_problem());
  if (made_by) {
    letters.gamma = made_by->gamma;
    letters.transition = made_by->transition;
    letters.r1 = made_by->r1;
    letters.t = made_by->t;
    letters.e1 = made_by->length - (letters.counts_to_edge ? 0.0 : made_by->t);
    letters.e2.reset();
    if (area > 0.0) letters.es = area;
  } else {
    const auto& spline = dynamic_cast<const ClothoidSpline&>(*shape.track);
    if (result.gates && !result.gates->start_area) result.gates->start_area = area;
    // What an in-run is held against by its kind is asked for by name.
    const bool circle = letters.transition == InRunTransition::circle;
    if (!result.rules.sets) result.rules.sets = {circle ? "fis-in-run-circle" : "fis-in-run"};
    result.centerline = {};
    result.centerline.kind = CenterlineKind::segments;
    result.centerline.entry_slope_angle = spline.entry_slope_angle();
    for (const ClothoidSegment& piece : spline.segments()) {
      result.centerline.segments.push_back({piece.length, piece.entry_curvature, piece.exit_curvature});
    }
  }
  // The edge is where it was: the start follows.
  const Endpoints ends = made_by ? InRun(*made_by).endpoints() : shape.ends;
  const Placement from = Placement::through(design.track.start, design.track.finish);
  const Vec3 miss = design.track.finish - from.to_space(ends.run, ends.drop, 0.0);
  result.track.start = from.start() + miss;
  if (!made_by) {
    result.track.edge.reset();
    result.track.azimuth = {};
    result.track.finish_given = true;
  }
  return result;
}

}  // namespace glissade
