#include "optimize/prices.hpp"

#include "optimize/refinement.hpp"
#include "optimize/switches.hpp"

#include <algorithm>
#include <cmath>
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

}  // namespace

Found priced(const ScaledProblem& problem, Found found, const OptimizeOptions& options,
             SearchControl& control) {
  constexpr int kRounds = 4;  // budget
  MeshTrack finer{found.track->mesh(), found.z};
  for (int round = 0; round < kRounds; ++round) {
    const std::vector<bool> beside = beside_jumps(finer.mesh);
    if (std::none_of(beside.begin(), beside.end(), [](bool is_beside) { return is_beside; })) return found;
    finer = with_halved_pieces(Transcription(finer.mesh), finer.z, beside);
  }
  control.tolerance = options.tolerance;
  control.most_rounds = 0;
  Found next = minimise(problem, finer.mesh, finer.z, found.rows->margins(), control, &found);
  const bool use =
      !next.stopped && next.residual <= options.tolerance && next.feasible(options.limit_tolerance);
  return use ? next : found;
}

std::vector<ActiveLimit> active_limits(const ScaledProblem& problem, const Found& found) {
  // Seconds, or m/s or metres where speed or a length alone counts.
  const double length_or_speed = problem.speed_weight > 0.0 ? problem.speed : problem.chord;
  const double objective_si = problem.time_weight > 0.0 ? problem.time : length_or_speed;
  std::vector<ActiveLimit> result;
  const std::vector<std::vector<Span>> bindings = bindings_of(problem, found);
  for (std::size_t i = 0; i < problem.limits.size(); ++i) {
    const LimitSpec& limit = problem.limits[i];
    const double multiplier = multiplier_of(found, limit, i);
    if (multiplier <= 0.0) continue;
    ActiveLimit active;
    active.limit = limit.name;
    active.value = limit.bound_si;
    for (const Span& span : bindings[i]) {
      active.where.push_back({span.from * problem.chord, span.to * problem.chord});
    }
    active.price = multiplier / limit.scale * limit.per_si * objective_si;
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
  std::sort(result.begin(), result.end(), [](const ActiveLimit& a, const ActiveLimit& b) {
    return a.limit == b.limit ? a.value < b.value : a.limit.key() < b.limit.key();
  });
  return result;
}

}  // namespace glissade::optimizer
