#include "optimize/prices/prices.hpp"

#include "optimize/mesh/moved_knots.hpp"
#include "optimize/mesh/refinement.hpp"
#include "optimize/mesh/switches.hpp"
#include "optimize/prices/lead_prices.hpp"
#include "optimize/prices/one_sided_prices.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace glissade::optimizer {
namespace {

/// Stretches of two lists in one, in order.
std::vector<Stretch> joined(std::vector<Stretch> stretches, const std::vector<Stretch>& others) {
  stretches.insert(stretches.end(), others.begin(), others.end());
  std::sort(stretches.begin(), stretches.end(),
            [](const Stretch& a, const Stretch& b) { return a.from < b.from; });
  std::vector<Stretch> result;
  for (const Stretch& stretch : stretches) {
    if (!result.empty() && stretch.from <= result.back().to) {
      result.back().to = std::max(result.back().to, stretch.to);
    } else {
      result.push_back(stretch);
    }
  }
  return result;
}

/// What a limit's rows carry together.
double multiplier_of(const Found& found, const LimitSpec& limit, std::size_t index) {
  double multiplier = 0.0;
  for (std::size_t k = 0; k < found.active.size(); ++k) {
    if (found.active[k].limit == index) multiplier += found.inequality[k];
  }
  if (limit.side != 0) return multiplier;
  for (std::size_t k = 0; k < found.equality.size(); ++k) {
    const std::size_t* owner = found.rows->limit_of_equality(k);
    if (owner != nullptr && *owner == index) multiplier += std::fabs(found.equality[k]);
  }
  return multiplier;
}

/// What each limit carries, in the order of the problem's.
Vector multipliers_of(const ScaledProblem& problem, const Found& found) {
  Vector multipliers(problem.limits.size(), 0.0);
  for (std::size_t i = 0; i < multipliers.size(); ++i) {
    multipliers[i] = multiplier_of(found, problem.limits[i], i);
  }
  return multipliers;
}

// Beside the limits' own: what straight ends carry, as if each were a limit.
constexpr std::size_t kLeads = 2;  // theory: lead_in and lead_out

/// What each limit carries, in the order of the problem's, and then what each chord of the straight ends costs; 0 where nothing.
/// @param objective  as in active_limits()
Vector carried_by(const ScaledProblem& problem, const Found& found, double objective) {
  Vector carried = multipliers_of(problem, found);
  carried.resize(carried.size() + kLeads, 0.0);
  for (const LeadPrice& lead : lead_prices(problem, found, objective)) {
    const std::size_t end = lead.limit.id == LimitId::lead_in ? 0 : 1;
    carried[problem.limits.size() + end] = lead.price;
  }
  return carried;
}

/// The same of a program on a finer mesh, which knows nothing of straight ends: these as on the mesh that is known.
Vector with_leads_of(const Vector& known, Vector by_limit) {
  by_limit.insert(by_limit.end(), known.end() - kLeads, known.end());
  return by_limit;
}

/// Which prices on two meshes are not the same, but for those that do not count.
std::vector<bool> other_prices(const Vector& a, const Vector& b) {
  constexpr double kSame = 0.01;    // accuracy: half that of a price
  constexpr double kCounts = 1e-3;  // of the greatest one; taste
  double greatest = 0.0;
  for (const double multiplier : a) greatest = std::max(greatest, multiplier);
  std::vector<bool> others(a.size(), false);
  for (std::size_t i = 0; i < a.size(); ++i)
    others[i] = std::fabs(a[i] - b[i]) > kSame * std::max(a[i], kCounts * greatest);
  return others;
}

bool same_prices(const Vector& a, const Vector& b) {
  if (a.size() != b.size()) return false;
  const std::vector<bool> others = other_prices(a, b);
  return std::none_of(others.begin(), others.end(), [](bool other) { return other; });
}

/// From close to an optimum to it. @return none where it does not arrive there
std::optional<Found> finished_on(const ScaledProblem& problem, const MeshTrack& begun, const Found& known,
                                 const OptimizeOptions& options, SearchControl& control) {
  control.tolerance = kAimed * options.tolerance;
  control.most_rounds = 0;
  control.is_close = true;
  Found next = minimise(problem, begun.mesh, begun.z, known.rows->margins(), control, &known);
  control.is_close = false;
  const bool use =
      !next.stopped && next.residual <= options.tolerance && next.feasible(options.limit_tolerance);
  return use ? std::optional(std::move(next)) : std::nullopt;
}

/// What limits carry at the optimum on a finer mesh. @return none where it does not arrive there
std::optional<Found> on_finer_mesh(const ScaledProblem& problem, const Found& found, const MeshTrack& finer,
                                   const OptimizeOptions& options, SearchControl& control) {
  if (control.stop()) return std::nullopt;  // none of its programs would be looked at
  if (auto near = approximated(problem, finer.mesh, finer.z, found.rows->margins(), control, found))
    return near;
  return finished_on(problem, finer, found, options, control);
}

/// Pieces next to jumps, and next to straight ends, at which curvature is none: after those it may be another at once.
std::vector<bool> beside_jumps_and_leads(const Mesh& mesh) {
  constexpr double kShort = 3e-3;  // taste: three times a pair of knots
  std::vector<bool> beside = beside_jumps(mesh);
  const auto is_long = [&](std::size_t piece) { return mesh.knots[piece + 1] - mesh.knots[piece] > kShort; };
  if (mesh.lead_in > 0.0 && is_long(0)) beside.front() = true;
  if (mesh.lead_out > 0.0 && is_long(beside.size() - 1)) beside.back() = true;
  return beside;
}

/// These, halved a few times.
std::optional<MeshTrack> halved_beside_jumps(const Found& found) {
  constexpr int kRounds = 4;  // budget
  MeshTrack finer{found.track->mesh(), found.z};
  for (int round = 0; round < kRounds; ++round) {
    const std::vector<bool> beside = beside_jumps_and_leads(finer.mesh);
    if (std::none_of(beside.begin(), beside.end(), [](bool is_beside) { return is_beside; })) break;
    finer = with_halved_pieces(Transcription(finer.mesh), finer.z, beside);
  }
  if (finer.mesh.knots.size() == found.track->mesh().knots.size()) return std::nullopt;
  return finer;
}

/// An optimum that prices are taken from.
struct Priced {
  Found found;
  std::optional<Found>
      before;          ///< on the mesh before, of twice as long pieces; none where one mesh was enough
  Vector multipliers;  ///< as carried_by()
  Vector error;        ///< of each, by what it still changes from mesh to mesh; 0 where it stays
  Found finest;        ///< the best one on the way there
  double rest = 0.0;   ///< as in PricedLimits
  std::optional<double> halved_wins = {};  ///< as in PricedLimits
};

/// Multipliers on one mesh after the other: what they tend to.
class Sequence {
 public:
  void add(Vector multipliers) { terms_.push_back(std::move(multipliers)); }

  [[nodiscard]] const Vector& last() const { return terms_.back(); }
  [[nodiscard]] std::size_t size() const { return terms_.size(); }
  [[nodiscard]] bool stays() const {
    return terms_.size() > 1 && same_prices(terms_.back(), terms_[terms_.size() - 2]);
  }

  /// Those that were not the same on the last two meshes.
  [[nodiscard]] std::vector<bool> changing() const {
    return other_prices(terms_.back(), terms_[terms_.size() - 2]);
  }

  /// One that changes less and less the same way is continued.
  /// Source: A. C. Aitken, Proceedings of the Royal Society of Edinburgh 46 (1927) 289-305.
  /// @param error  by how much it is, or by how much it changed last
  /// @return what it tends to
  [[nodiscard]] double limit_of(std::size_t i, double& error) const {
    constexpr double kSlowest = 0.85;  // taste
    const std::size_t count = terms_.size();
    const double value = last()[i];
    error = 0.0;
    if (count < 2) return value;
    const double change = value - terms_[count - 2][i];
    error = std::fabs(change);
    if (count < 3) return value;
    const double before = terms_[count - 2][i] - terms_[count - 3][i];
    const double ratio = before == 0.0 ? 0.0 : change / before;
    const double rest = ratio > 0.0 && ratio < kSlowest ? change * ratio / (1.0 - ratio) : 0.0;
    if (rest == 0.0 || !(value + rest > 0.0)) return value;
    error = std::fabs(rest);
    return value + rest;
  }

 private:
  std::vector<Vector> terms_;
};

/// Where the mesh holds jumps of the curvature beside where they belong.
std::optional<Found> with_knots_at_rest(const ScaledProblem& problem, const Found& found,
                                        const OptimizeOptions& options, SearchControl& control) {
  // Prices miss by the first order of what the objective misses by the second.
  constexpr KnotMoves kMoves{1e-6, 1e-7, 1e-10, 5e-3, true, 4};  // taste
  return with_moved_knots(problem, found, options.tolerance, control, kMoves).found;
}

/// Takes a track for the finest one where it is the best so far.
/// @param left  of what it wins finer meshes would win as much again
void take_finest(const Found& found, double left, Found& finest, double& rest) {
  if (!(found.objective < finest.objective)) return;
  rest = left * (finest.objective - found.objective);
  finest = found;
}

/// The first optimum on a finer mesh where one tells more of prices than a program there does.
/// @param same  whether the program's are the optimum's own
std::optional<Found> halved_for_prices(const ScaledProblem& problem, const Found& found, const Vector& begun,
                                       bool same, const OptimizeOptions& options, SearchControl& control) {
  // A limit on the rate of curvature lets nothing jump and ties all pieces together. What one program tells of a finer mesh
  // is rough then, and the optimum on it tells whether prices are others. Of straight ends a program tells nothing.
  const bool has_leads =
      std::any_of(begun.end() - kLeads, begun.end(), [](double lead) { return lead > 0.0; });
  if (same ? !has_leads : !is_smooth(problem)) return std::nullopt;
  return on_finer_mesh(problem, found, with_all_halved(*found.track, found.z), options, control);
}

/// A mesh with more pieces where prices are others: near what limits bind, or everywhere where it is a straight end's.
MeshTrack with_halved_for(const Found& found, std::vector<bool> others) {
  const bool of_lead = std::any_of(others.end() - kLeads, others.end(), [](bool other) { return other; });
  if (of_lead) return with_all_halved(*found.track, found.z);
  others.resize(others.size() - kLeads);
  return with_halved_near(found, others);
}

/// What prices tend to, with what they still change by.
/// @param ahead  on another mesh, in case there is but one
void take_limits(const Sequence& sequence, const Vector& ahead, Priced& result) {
  for (std::size_t i = 0; i < result.multipliers.size(); ++i) {
    result.multipliers[i] = sequence.limit_of(i, result.error[i]);
    if (sequence.size() == 1) result.error[i] = std::fabs(result.multipliers[i] - ahead[i]);
  }
}

Priced priced(const ScaledProblem& problem, Found found, const Vector& by_limit,
              const OptimizeOptions& options, SearchControl& control, std::optional<Found>& moved) {
  constexpr int kRounds = 3;                // budget
  constexpr std::size_t kMostPieces = 200;  // budget
  const Vector begun = carried_by(problem, found, 1.0);
  Vector ahead = by_limit.empty() ? begun : with_leads_of(begun, by_limit);
  bool same = same_prices(begun, ahead);
  std::optional<Found> halved;
  if (!by_limit.empty()) halved = halved_for_prices(problem, found, begun, same, options, control);
  if (halved) {
    ahead = carried_by(problem, *halved, 1.0);
    same = same_prices(begun, ahead);
  }
  std::optional<double> halved_wins;
  if (halved && is_smooth(problem)) halved_wins = found.objective - halved->objective;
  const bool refined = !same;
  const bool begins_halved = refined && halved && is_smooth(problem);
  if (refined && !is_smooth(problem)) moved = with_knots_at_rest(problem, found, options, control);
  if (moved) found = *moved;
  Found finest = found;
  double rest = 0.0;
  std::optional<Found> before;
  Sequence sequence;
  if (begins_halved) {
    sequence.add(begun);
    before = std::exchange(found, std::move(*halved));
    take_finest(found, 1.0, finest, rest);
  } else if (const std::optional<MeshTrack> finer = halved_beside_jumps(found)) {
    if (auto next = on_finer_mesh(problem, found, *finer, options, control)) found = std::move(*next);
    // Pieces half as long are twice as good: four times halved they leave a fifteenth of what that wins.
    take_finest(found, 1.0 / 15.0, finest, rest);
  }
  // Where a finer mesh has other prices, they are taken from there, and from a finer one still until they stay.
  sequence.add(carried_by(problem, found, 1.0));
  for (int round = begins_halved ? 1 : 0; !same && round < kRounds; ++round) {
    if (found.track->mesh().knots.size() > kMostPieces) break;
    // Where those bind whose prices still change: halving other pieces, too, hardly changes a digit.
    const MeshTrack finer =
        with_halved_for(found, round == 0 ? other_prices(begun, ahead) : sequence.changing());
    auto next = on_finer_mesh(problem, found, finer, options, control);
    if (!next) break;
    before = std::exchange(found, std::move(*next));
    take_finest(found, 1.0, finest, rest);
    sequence.add(carried_by(problem, found, 1.0));
    same = sequence.stays();
  }
  const Vector none(begun.size(), 0.0);
  Priced result{std::move(found), std::move(before), sequence.last(), none, std::move(finest), rest,
                halved_wins};
  if (!same) take_limits(sequence, ahead, result);
  for (std::size_t i = 0; refined && i < problem.limits.size(); ++i) {
    // What a finer mesh leaves as it is was right before others were looked for.
    constexpr double kStays = 1e-3;  // accuracy: a twentieth of that of a price
    if (!(std::fabs(begun[i] - ahead[i]) < kStays * begun[i])) continue;
    result.multipliers[i] = begun[i];
    result.error[i] = 0.0;
  }
  return result;
}

}  // namespace

namespace {

/// Seconds, or m/s or metres where speed or a length alone counts, or an integral along the track.
double objective_unit(const ScaledProblem& problem) {
  // There slownesses are those of the even speed, less what of it is not even: times that speed they add up to the integral.
  const double even_speed = problem.rides.front().even_speed;
  if (even_speed > 0.0) return even_speed * problem.chord;
  const double length_or_speed = problem.speed_weight > 0.0 ? problem.speed : problem.chord;
  return problem.time_weight > 0.0 ? problem.time : length_or_speed;
}

/// Of a limit's multiplier.
double price_unit(const ScaledProblem& problem, const LimitSpec& limit) {
  return limit.per_si / limit.scale * objective_unit(problem);
}

/// Straight ends that cost something.
void add_leads(const ScaledProblem& problem, const Found& found, const Vector& carried, const Vector& error,
               std::vector<ActiveLimit>& limits) {
  const double length = problem.lead_in + found.track->core_length(found.z) + problem.lead_out;
  for (const LimitId id : {LimitId::lead_in, LimitId::lead_out}) {
    const bool at_start = id == LimitId::lead_in;
    const std::size_t index = problem.limits.size() + (at_start ? 0 : 1);
    if (!(carried[index] > 0.0)) continue;
    const double lead = at_start ? problem.lead_in : problem.lead_out;
    ActiveLimit active;
    active.limit = {id, entry_of(id).bound};
    active.value = lead * problem.chord;
    const double from = at_start ? 0.0 : length - lead;
    active.where.push_back({from * problem.chord, (from + lead) * problem.chord});
    const double unit = objective_unit(problem) / problem.chord;
    active.price = carried[index] * unit;
    active.price_error = error[index] * unit;
    limits.push_back(std::move(active));
  }
}

/// Each limit that carries something, or binds without.
/// @param multipliers  as carried_by()
/// @param error        of each
std::vector<ActiveLimit> binding_limits(const ScaledProblem& problem, const Found& found,
                                        const Vector& multipliers, const Vector& error) {
  constexpr double kNothing = 1e-8;  // accuracy: a hundredth of that of a time, for a whole scale of relief
  std::vector<ActiveLimit> result;
  const std::vector<std::vector<Span>> bindings = bindings_of(problem, found);
  for (std::size_t i = 0; i < problem.limits.size(); ++i) {
    const LimitSpec& limit = problem.limits[i];
    // What rounding leaves of a multiplier is no price.
    const bool counts = multipliers[i] + error[i] > kNothing * std::fabs(found.objective);
    const double multiplier = counts ? multipliers[i] : 0.0;
    if (multiplier <= 0.0 && limit.side != 0 && bindings[i].empty()) continue;
    ActiveLimit active;
    active.limit = limit.name;
    active.value = limit.bound_si;
    for (const Span& span : bindings[i]) {
      active.where.push_back({span.from * problem.chord, span.to * problem.chord});
    }
    const double unit = price_unit(problem, limit);
    active.price = multiplier * unit;
    active.price_error = error[i] * unit;  // of all its sides; a share at last
    // A limit with two sides under one name, as that on the rate of curvature, gives way on both.
    const auto same = std::find_if(result.begin(), result.end(),
                                   [&](const ActiveLimit& known) { return known.limit == active.limit; });
    if (same == result.end()) {
      result.push_back(std::move(active));
      continue;
    }
    same->price += active.price;
    same->price_error += active.price_error;
    same->where = joined(std::move(same->where), active.where);
  }
  add_leads(problem, found, multipliers, error, result);
  for (ActiveLimit& active : result) {
    constexpr double kTold = 0.02;  // accuracy: that of a price
    const bool is_told = active.price_error > kTold * active.price && active.price > 0.0;
    active.price_error = is_told ? active.price_error / active.price : 0.0;
  }
  return result;
}

/// Those that cost something, in the order of their keys.
std::vector<ActiveLimit> told(std::vector<ActiveLimit> limits) {
  std::erase_if(limits, [](const ActiveLimit& active) { return !(active.tightening() > 0.0); });
  std::sort(limits.begin(), limits.end(), [](const ActiveLimit& a, const ActiveLimit& b) {
    return a.limit == b.limit ? a.value < b.value : a.limit.key() < b.limit.key();
  });
  return limits;
}

}  // namespace

std::vector<ActiveLimit> active_limits(const ScaledProblem& problem, const Found& found, double objective) {
  const Vector carried = carried_by(problem, found, objective);
  return told(binding_limits(problem, found, carried, Vector(carried.size(), 0.0)));
}

namespace {

/// Prices to either side on one mesh, and whether they are those of the problem.
struct PriceKink {
  OneSidedPrice price;
  bool lasts = true;  ///< another mesh has it, too, and as wide
};

/// An optimum on a finer mesh, of all pieces halved or else of those near what binds.
std::optional<Found> beside_kinks(const ScaledProblem& problem, const Found& found,
                                  const OptimizeOptions& options, SearchControl& control) {
  const MeshTrack all = with_all_halved(*found.track, found.z);
  if (auto next = on_finer_mesh(problem, found, all, options, control)) return next;
  const std::vector<bool> every(problem.limits.size(), true);
  return on_finer_mesh(problem, found, with_halved_near(found, every), options, control);
}

/// Where a mesh lets two rows just touch there is a kink on it alone, or one that narrows with its pieces.
/// @param at  the optimum on a mesh of halved pieces, where that has not the same kinks
std::vector<PriceKink> kinks_of(const ScaledProblem& problem, Priced& at, const OptimizeOptions& options,
                                SearchControl& control) {
  // A kink of the mesh is half as wide on one twice as fine, one of the problem as wide.
  constexpr double kAsWide = 0.75;  // theory: between the two
  const std::vector<OneSidedPrice> prices = one_sided_prices(problem, at.found);
  if (prices.empty()) return {};
  std::optional<Found> finer;
  if (!at.before) finer = beside_kinks(problem, at.found, options, control);
  const Found* const other = at.before ? &*at.before : finer ? &*finer : nullptr;
  // Without another mesh nothing tells whose kinks they are.
  const std::vector<OneSidedPrice> others =
      other != nullptr ? one_sided_prices(problem, *other) : std::vector<OneSidedPrice>{};
  const auto width = [](const OneSidedPrice& price) { return price.tightening - price.relaxing; };
  std::vector<PriceKink> kinks;
  bool all_last = true;
  for (const OneSidedPrice& price : prices) {
    const auto there = std::find_if(others.begin(), others.end(),
                                    [&](const OneSidedPrice& one) { return one.limit == price.limit; });
    bool lasts = false;
    if (other == nullptr) kinks.push_back({price, std::isinf(width(price))});
    if (there != others.end()) {
      const OneSidedPrice& narrow = width(*there) < width(price) ? *there : price;
      const double wide = std::max(width(*there), width(price));
      lasts = std::isinf(width(price)) || width(narrow) >= kAsWide * wide;
      kinks.push_back({lasts ? price : narrow, lasts});
    }
    all_last = all_last && lasts;
  }
  if (finer && !all_last) {
    at.found = std::move(*finer);
    at.multipliers = carried_by(problem, at.found, 1.0);
    at.error.assign(at.multipliers.size(), 0.0);
  }
  return kinks;
}

/// Sets the price of one that binds: two, or what lies between them where they are not the problem's.
void set_price(const PriceKink& kink, double unit, ActiveLimit& active) {
  const OneSidedPrice& price = kink.price;
  active.price = price.relaxing * unit;
  active.price_error = 0.0;
  if (kink.lasts) {
    active.tightening_price = price.tightening * unit;
    return;
  }
  active.price = 0.5 * (price.relaxing + price.tightening) * unit;
  active.price_error = (price.tightening - price.relaxing) / (price.tightening + price.relaxing);
}

}  // namespace

PricedLimits priced_limits(const ScaledProblem& problem, const Found& found, const Vector& ahead,
                           const OptimizeOptions& options, SearchControl& control) {
  constexpr double kPays = 1e-6;  // accuracy: that of a time
  PricedLimits result;
  Priced at = priced(problem, found, ahead, options, control, result.better);
  const std::vector<PriceKink> kinks = kinks_of(problem, at, options, control);
  std::vector<ActiveLimit> limits = binding_limits(problem, at.found, at.multipliers, at.error);
  for (const PriceKink& kink : kinks) {
    for (ActiveLimit& active : limits) {
      if (active.limit == kink.price.limit) set_price(kink, objective_unit(problem), active);
    }
  }
  result.limits = told(std::move(limits));
  const double core = at.found.track->core_length(at.found.z);
  result.length = (problem.lead_in + core + problem.lead_out) * problem.chord;
  result.least = at.finest.objective;
  result.rest = at.rest;
  result.halved_wins = at.halved_wins;
  const double known = result.better ? result.better->objective : found.objective;
  if (!(known - at.finest.objective > kPays * std::fabs(known))) return result;
  std::optional<Found> finest =
      finished_on(problem, {at.finest.track->mesh(), at.finest.z}, at.finest, options, control);
  if (!finest) return result;
  result.better = std::move(finest);
  result.is_finest = true;
  return result;
}

void carry_over(const ScaledProblem& problem, const Found& from, const Found& to,
                std::vector<ActiveLimit>& limits) {
  const Vector before = multipliers_of(problem, from);
  const Vector behind = multipliers_of(problem, to);
  for (std::size_t i = 0; i < before.size(); ++i) {
    const auto active = std::find_if(limits.begin(), limits.end(), [&](const ActiveLimit& limit) {
      return limit.limit == problem.limits[i].name;
    });
    if (active == limits.end()) continue;
    const double change = (behind[i] - before[i]) * price_unit(problem, problem.limits[i]);
    active->price = std::max(0.0, active->price + change);
    if (active->tightening_price)
      active->tightening_price = std::max(active->price, *active->tightening_price + change);
  }
  limits = told(std::move(limits));
}

}  // namespace glissade::optimizer
