#include "glissade/pipeline/redesign.hpp"

#include "glissade/centerline/clothoid_spline.hpp"
#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/pipeline/rules.hpp"

#include "pipeline/redesign/free_shape.hpp"
#include "pipeline/redesign/places.hpp"
#include "pipeline/redesign/ruled_letters.hpp"
#include "pipeline/redesign/shapes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <tuple>
#include <utility>

namespace glissade {

using namespace pipeline;

namespace {

constexpr std::array<std::string_view, 5> kGoalWords = {"least-drop", "least-length", "least-load",
                                                        "least-curvature-rate", "exit-speed"};
constexpr std::string_view kWithinRules = "its letters within the rules";

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
  result.shapes.push_back(free_shape(design, options, certificate, ruled, places, context, result));
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
