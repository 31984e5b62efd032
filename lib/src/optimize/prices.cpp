#include "optimize/prices.hpp"

#include "optimize/lead_prices.hpp"
#include "optimize/one_sided_prices.hpp"
#include "optimize/refinement.hpp"
#include "optimize/switches.hpp"

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

/// Whether prices on two meshes are the same, but for those that do not count.
bool same_prices(const Vector& a, const Vector& b) {
  constexpr double kSame = 0.01;    // accuracy: half that of a price
  constexpr double kCounts = 1e-3;  // of the greatest one; taste
  if (a.size() != b.size()) return false;
  double greatest = 0.0;
  for (const double multiplier : a) greatest = std::max(greatest, multiplier);
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (std::fabs(a[i] - b[i]) > kSame * std::max(a[i], kCounts * greatest)) return false;
  }
  return true;
}

/// What limits carry at the optimum on a finer mesh. @return none where it does not arrive there
std::optional<Found> on_finer_mesh(const ScaledProblem& problem, const Found& found, const MeshTrack& finer,
                                   const OptimizeOptions& options, SearchControl& control) {
  if (auto near = approximated(problem, finer.mesh, finer.z, found.rows->margins(), control, found))
    return near;
  control.tolerance = kAimed * options.tolerance;
  control.most_rounds = 0;
  control.is_close = true;
  Found next = minimise(problem, finer.mesh, finer.z, found.rows->margins(), control, &found);
  control.is_close = false;
  const bool use =
      !next.stopped && next.residual <= options.tolerance && next.feasible(options.limit_tolerance);
  return use ? std::optional(std::move(next)) : std::nullopt;
}

/// Pieces next to jumps, halved a few times.
std::optional<MeshTrack> halved_beside_jumps(const Found& found) {
  constexpr int kRounds = 4;  // budget
  MeshTrack finer{found.track->mesh(), found.z};
  for (int round = 0; round < kRounds; ++round) {
    const std::vector<bool> beside = beside_jumps(finer.mesh);
    if (std::none_of(beside.begin(), beside.end(), [](bool is_beside) { return is_beside; })) break;
    finer = with_halved_pieces(Transcription(finer.mesh), finer.z, beside);
  }
  if (finer.mesh.knots.size() == found.track->mesh().knots.size()) return std::nullopt;
  return finer;
}

}  // namespace

Found priced(const ScaledProblem& problem, Found found, const Vector& ahead, const OptimizeOptions& options,
             SearchControl& control) {
  if (const std::optional<MeshTrack> finer = halved_beside_jumps(found)) {
    if (auto next = on_finer_mesh(problem, found, *finer, options, control)) found = std::move(*next);
  }
  // Where a finer mesh has other prices, they are taken from there, and from a finer one still until they stay.
  constexpr int kRounds = 3;                // budget
  constexpr std::size_t kMostPieces = 200;  // budget
  Vector prices = multipliers_of(problem, found);
  bool same = ahead.empty() || same_prices(prices, ahead);
  for (int round = 0; !same && round < kRounds; ++round) {
    if (found.track->mesh().knots.size() > kMostPieces) break;
    auto next = on_finer_mesh(problem, found, with_all_halved(*found.track, found.z), options, control);
    if (!next) break;
    found = std::move(*next);
    Vector finer = multipliers_of(problem, found);
    same = same_prices(finer, prices);
    prices = std::move(finer);
  }
  return found;
}

namespace {

/// Seconds, or m/s or metres where speed or a length alone counts.
double objective_unit(const ScaledProblem& problem) {
  const double length_or_speed = problem.speed_weight > 0.0 ? problem.speed : problem.chord;
  return problem.time_weight > 0.0 ? problem.time : length_or_speed;
}

/// Straight ends that cost something.
void add_leads(const ScaledProblem& problem, const Found& found, double objective,
               std::vector<ActiveLimit>& limits) {
  const double length = problem.lead_in + found.track->core_length(found.z) + problem.lead_out;
  for (const LeadPrice& lead : lead_prices(problem, found, objective)) {
    ActiveLimit active;
    active.limit = lead.limit;
    active.value = lead.length * problem.chord;
    const double from = lead.limit.id == LimitId::lead_in ? 0.0 : length - lead.length;
    active.where.push_back({from * problem.chord, (from + lead.length) * problem.chord});
    active.price = lead.price / problem.chord * objective_unit(problem);
    limits.push_back(std::move(active));
  }
}

/// Each limit that carries something, or binds without.
std::vector<ActiveLimit> binding_limits(const ScaledProblem& problem, const Found& found, double objective) {
  std::vector<ActiveLimit> result;
  const std::vector<std::vector<Span>> bindings = bindings_of(problem, found);
  for (std::size_t i = 0; i < problem.limits.size(); ++i) {
    const LimitSpec& limit = problem.limits[i];
    const double multiplier = multiplier_of(found, limit, i);
    if (multiplier <= 0.0 && limit.side != 0 && bindings[i].empty()) continue;
    ActiveLimit active;
    active.limit = limit.name;
    active.value = limit.bound_si;
    for (const Span& span : bindings[i]) {
      active.where.push_back({span.from * problem.chord, span.to * problem.chord});
    }
    active.price = multiplier / limit.scale * limit.per_si * objective_unit(problem);
    // A limit with two sides under one name, as that on the rate of curvature, gives way on both.
    const auto same = std::find_if(result.begin(), result.end(),
                                   [&](const ActiveLimit& known) { return known.limit == active.limit; });
    if (same == result.end()) {
      result.push_back(std::move(active));
      continue;
    }
    same->price += active.price;
    same->where = joined(std::move(same->where), active.where);
  }
  add_leads(problem, found, objective, result);
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
  return told(binding_limits(problem, found, objective));
}

std::vector<ActiveLimit> active_limits_to_either_side(const ScaledProblem& problem, const Found& found) {
  std::vector<ActiveLimit> limits = binding_limits(problem, found, 1.0);
  for (const OneSidedPrice& price : one_sided_prices(problem, found)) {
    for (ActiveLimit& active : limits) {
      if (active.limit != price.limit) continue;
      active.price = price.relaxing * objective_unit(problem);
      active.tightening_price = price.tightening * objective_unit(problem);
    }
  }
  return told(std::move(limits));
}

}  // namespace glissade::optimizer
