#include "optimize/problem/changed_bound.hpp"

#include <cmath>
#include <vector>

namespace glissade::optimizer {
namespace {

void set(Range& range, Bound bound, double value) {
  switch (bound) {
    case Bound::highest:
      range.highest = value;
      break;
    case Bound::lowest:
      range.lowest = value;
      break;
    case Bound::exactly:
      range = Range::fixed(value);
      break;
  }
}

template <typename Obstacle>
bool set_clearance(std::vector<Obstacle>& obstacles, std::size_t index, double value) {
  if (index >= obstacles.size()) return false;
  obstacles[index].clearance = value;
  return true;
}

/// @return whether it has a bound
bool set_bound(Problem& problem, const LimitName& limit, double value) {
  Limits& limits = problem.limits;
  const LimitEntry& entry = entry_of(limit.id);
  if (entry.range != nullptr) {
    set(limits.*entry.range, limit.bound, value);
    return true;
  }
  if (entry.value != nullptr) {
    limits.*entry.value = value;
    return true;
  }
  if (entry.length != nullptr) {
    limits.*entry.length = value;
    return true;
  }
  switch (limit.id) {
    case LimitId::half_planes:
      return set_clearance(limits.half_planes, limit.index, value);
    case LimitId::keep_outs:
      return set_clearance(limits.keep_outs, limit.index, value);
    case LimitId::stay_above:
      return set_clearance(limits.stay_above, limit.index, value);
    case LimitId::stay_below:
      return set_clearance(limits.stay_below, limit.index, value);
    case LimitId::match_belt:
      limits.match_belt->within = std::fabs(value / limits.match_belt->speed - 1.0);
      return true;
    case LimitId::finish_run:
      if (fixes_run(problem.finish.kind)) return false;
      set(problem.finish.free_range, limit.bound, value);
      return true;
    case LimitId::finish_drop: {
      if (fixes_drop(problem.finish.kind)) return false;
      const bool both = !fixes_run(problem.finish.kind);
      set(both ? problem.finish.free_drop : problem.finish.free_range, limit.bound, value);
      return true;
    }
    default:
      return false;
  }
}

}  // namespace

std::optional<Problem> with_bound(const Problem& problem, const LimitName& limit, double value) {
  Problem changed = problem;
  if (!set_bound(changed, limit, value)) return std::nullopt;
  return changed;
}

}  // namespace glissade::optimizer
