// Reports as text for people.

#include "glissade/core/number_text.hpp"
#include "glissade/core/quantity.hpp"
#include "glissade/core/words.hpp"
#include "glissade/optimize/optimize.hpp"

#include <cmath>
#include <cstddef>
#include <vector>

namespace glissade {
namespace {

std::string places_text(const std::vector<Stretch>& where) {
  std::string text;
  for (const Stretch& stretch : where) {
    if (!text.empty()) text += ", ";
    // A stretch too short to be seen in so many digits is a place.
    const std::string from = length_text(stretch.from, 4);
    const std::string to = length_text(stretch.to, 4);
    text += to == from ? "at " + from : "from " + from + " to " + to;
  }
  return text;
}

}  // namespace

std::string_view to_text(OptimizeStatus status) {
  switch (status) {
    case OptimizeStatus::optimal:
      return "optimal";
    case OptimizeStatus::feasible_not_converged:
      return "feasible, not converged";
    case OptimizeStatus::infeasible:
      return "infeasible";
    case OptimizeStatus::no_track_found:
      return "no track found";
  }
  return "unknown";
}

namespace {

/// The bound that would do; of a place in the way by how much it would have to lie elsewhere.
std::string relaxed_text(const Relaxation& relaxation) {
  const LimitId id = relaxation.limit.id;
  const std::string key = relaxation.limit.key();
  if (id == LimitId::waypoints) return key + " moved by " + length_text(std::fabs(relaxation.needed));
  const bool place = id == LimitId::half_planes || id == LimitId::keep_outs || id == LimitId::stay_above ||
                     id == LimitId::stay_below;
  if (place && relaxation.needed < 0.0) {
    return key + " moved away by " + length_text(relaxation.value - relaxation.needed);
  }
  return key + " " + quantity_text(relaxation.needed, relaxation.limit.dimension());
}

}  // namespace

std::string price_text(const ActiveLimit& active, const Objective& objective) {
  // By as much as itself: which price it is no mesh tells, only how high one had it.
  if (active.price_error >= 1.0)
    return "below some " + price_text((1.0 + active.price_error) * active.price, active.limit, objective);
  const std::string relaxing = price_text(active.price, active.limit, objective);
  if (active.price_error > 0.0)
    return relaxing + " (to " + rounded_text(100.0 * active.price_error, 1) + " %)";
  if (!active.tightening_price) return relaxing;
  const double tightening = price_for_people(*active.tightening_price, active.limit);
  const bool none = std::isinf(tightening);
  return relaxing + " looser, " + (none ? "no track" : rounded_text(tightening, 3)) + " tighter";
}

std::string conflict_text(const Conflict& conflict) {
  std::vector<std::string> words;
  for (const StatedLimit& stated : conflict.limits) {
    std::string word = stated.limit.key();
    if (stated.value && stated.limit.id != LimitId::waypoints)
      word += " " + quantity_text(*stated.value, stated.limit.dimension());
    words.push_back(std::move(word));
  }
  std::string text = listed(words) + (words.size() == 1 ? " cannot be met" : " cannot be met together");
  for (std::size_t i = 0; i < conflict.relaxations.size(); ++i) {
    const Relaxation& relaxation = conflict.relaxations[i];
    text += (i == 0 ? "; it would take " : ", or ") + relaxed_text(relaxation);
  }
  return text;
}

std::string OptimizeReport::convergence_text() const {
  if (!std::isfinite(first_order_residual)) return "how near an optimum it is did not come out";
  const std::string residual = "first-order residual " + rounded_text(first_order_residual, 2);
  if (!finer_mesh_wins) return residual;
  // Less than the accuracy of the referee's own quadrature is nothing.
  constexpr double kNothing = 1e-10;
  const std::string won = *finer_mesh_wins < kNothing ? "nothing" : rounded_text(*finer_mesh_wins, 2);
  return residual + ", a finer mesh would win " + won;
}

std::string OptimizeReport::brief() const {
  std::string text = std::string(to_text(status)) + ": " + message + "\n";
  if (status == OptimizeStatus::optimal || status == OptimizeStatus::feasible_not_converged) {
    text += "travel time " + rounded_text(travel_time, 7) + " s";
    if (unlimited_travel_time) {
      const double excess = travel_time / *unlimited_travel_time - 1.0;
      text += ", " + rounded_text(100.0 * excess, 3) + " % above the optimum without limits, " +
              rounded_text(*unlimited_travel_time, 7) + " s";
    }
    text += "; exit speed " + rounded_text(exit_speed, 5) + " m/s\n";
    for (const ActiveLimit& limit : active) {
      text += "  " + limit.limit.key() + " " + quantity_text(limit.value, limit.limit.dimension()) + ": " +
              price_text(limit, objective);
      if (!limit.where.empty()) text += ", " + places_text(limit.where);
      text += "\n";
    }
    text += convergence_text() + "; ";
  }
  text += std::to_string(iterations) + " rounds, " + std::to_string(evaluations) + " evaluations, " +
          rounded_text(1e3 * seconds, 3) + " ms\n";
  return text;
}

}  // namespace glissade
