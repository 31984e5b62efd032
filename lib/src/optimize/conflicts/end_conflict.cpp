#include "optimize/conflicts/end_conflict.hpp"

#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/units.hpp"
#include "glissade/core/words.hpp"

#include "core/float_limits.hpp"
#include "task/obstacles.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace glissade::optimizer {
namespace {

using WouldDo = std::function<bool(const LimitName&, double)>;

constexpr int kDirections = 2048;  // accuracy: 0.18 deg apart

/// One end of the track, and the directions that it may have.
struct GivenEnd {
  const char* name;
  Vec2 point;
  double flattest = 0.0;
  double steepest = 0.0;

  [[nodiscard]] double direction(int i) const {
    return flattest + (steepest - flattest) * static_cast<double>(i) / kDirections;
  }
  [[nodiscard]] double step() const { return (steepest - flattest) / kDirections; }
};

GivenEnd end_of(const char* name, Vec2 point, const Range& own, const Range& whole) {
  GivenEnd end{name, point, -kRightAngle, kRightAngle};
  for (const Range* range : {&own, &whole}) {
    if (range->lowest) end.flattest = std::max(end.flattest, *range->lowest);
    if (range->highest) end.steepest = std::min(end.steepest, *range->highest);
  }
  return end;
}

double value_at(const GivenEnd& end, double direction, const Envelope& envelope,
                const clearance::Region& region) {
  const Vec2 normal{math::sin(direction), -math::cos(direction)};
  const std::array<Vec2, 2> rib{end.point - envelope.below * normal, end.point + envelope.top() * normal};
  return region.nearest(rib).value;
}

/// By how much the end lacks room in its best direction; not above 0 where it has some.
double lacking(const GivenEnd& end, const Envelope& envelope, const std::vector<task::Obstacle>& obstacles) {
  double best = -core::kInfinity;
  for (int i = 0; i <= kDirections; ++i) {
    double spare = core::kInfinity;
    for (const task::Obstacle& obstacle : obstacles) {
      spare =
          std::min(spare, value_at(end, end.direction(i), envelope, obstacle.region) - obstacle.clearance);
    }
    best = std::max(best, spare);
  }
  // No point of the normal moves further between two directions.
  return -best - 0.5 * end.step() * std::max(envelope.below, envelope.top());
}

/// The largest top of the envelope that has room, the underside kept; below 0 if none does.
double largest_top(const GivenEnd& end, Envelope envelope, const std::vector<task::Obstacle>& obstacles) {
  const auto fits = [&](double top) {
    envelope.above = std::min(envelope.above, top);
    envelope.headroom = top;
    return lacking(end, envelope, obstacles) <= 0.0;
  };
  const Envelope asked = envelope;
  if (!fits(0.0)) return -1.0;
  double low = 0.0;
  double high = asked.top();
  constexpr int kHalvings = 20;  // rounding: a millionth of the height
  for (int i = 0; i < kHalvings; ++i) {
    envelope = asked;
    const double middle = 0.5 * (low + high);
    (fits(middle) ? low : high) = middle;
  }
  return low;
}

/// The clearance that is left in the best direction, all other obstacles kept.
double best_clearance(const GivenEnd& end, const Envelope& envelope,
                      const std::vector<task::Obstacle>& obstacles, const task::Obstacle& asked) {
  double best = -core::kInfinity;
  for (int i = 0; i <= kDirections; ++i) {
    bool kept = true;
    for (const task::Obstacle& other : obstacles) {
      if (&other == &asked) continue;
      kept = kept && value_at(end, end.direction(i), envelope, other.region) >= other.clearance;
    }
    if (kept) best = std::max(best, value_at(end, end.direction(i), envelope, asked.region));
  }
  return best;
}

Conflict conflict_at(const GivenEnd& end, const Envelope& envelope,
                     const std::vector<task::Obstacle>& obstacles, const WouldDo& would_do) {
  Conflict conflict;
  std::vector<std::string> names;
  std::string remedies;
  for (const task::Obstacle& obstacle : obstacles) {
    // What can do without is not to blame.
    std::vector<task::Obstacle> others;
    for (const task::Obstacle& other : obstacles) {
      if (&other != &obstacle) others.push_back(other);
    }
    if (!others.empty() && lacking(end, envelope, others) > 0.0) continue;
    conflict.limits.push_back({obstacle.limit, obstacle.clearance});
    names.push_back(obstacle.limit.key());
    // A little less than all there is: the track has to lead on from there.
    constexpr double kLess = 1e-3;  // taste
    const double left = (1.0 - kLess) * best_clearance(end, envelope, obstacles, obstacle);
    if (left < 0.0 || !would_do || !would_do(obstacle.limit, left)) continue;
    conflict.relaxations.push_back({obstacle.limit, obstacle.clearance, left});
    remedies += (remedies.empty() ? "" : ", ") + obstacle.limit.key() + " " + length_text(left, 3);
  }
  // Two of them, each of which is too close alone.
  if (names.empty()) {
    for (const task::Obstacle& obstacle : obstacles) {
      if (lacking(end, envelope, {obstacle}) <= 0.0) continue;
      conflict.limits.push_back({obstacle.limit, obstacle.clearance});
      names.push_back(obstacle.limit.key());
    }
  }
  const double top = largest_top(end, envelope, obstacles);
  if (top > 0.0) {
    remedies += (remedies.empty() ? "" : ", or ") + std::string("a solid and headroom that reach at most ") +
                length_text(top, 3) + " above the floor";
  }
  conflict.text = std::string(end.name) + " lies too close to " + listed(names) +
                  " for the solid, which reaches " + length_text(envelope.below, 3) + " below and " +
                  length_text(envelope.top(), 3) +
                  " above the floor: no direction of the track there keeps the clearance";
  conflict.why =
      "There the solid stands square to the track: every direction that the limits allow was tried.";
  if (!remedies.empty()) conflict.text += "; it would take " + remedies;
  return conflict;
}

/// The ends whose place is given, with the directions that the track may have there.
std::vector<GivenEnd> given_ends(const Problem& problem) {
  const Limits& limits = problem.limits;
  const bool from_start = problem.places_from == PlacesFrom::start;
  const bool both = problem.finish.kind == FinishKind::point;
  const Vec2 way{std::fabs(problem.endpoints.run), problem.endpoints.drop};
  std::vector<GivenEnd> ends;
  if (from_start || both) {
    ends.push_back(
        end_of("the start", from_start ? Vec2{} : -1.0 * way, limits.entry_slope_angle, limits.slope_angle));
  }
  if (!from_start || both) {
    ends.push_back(
        end_of("the finish", from_start ? way : Vec2{}, limits.exit_slope_angle, limits.slope_angle));
  }
  return ends;
}

}  // namespace

std::optional<Conflict> on_other_side_at_an_end(const Problem& problem) {
  for (const task::Obstacle& obstacle : task::obstacles_of(problem.limits)) {
    if (obstacle.limit.id != LimitId::keep_outs) continue;
    const KeepOut& area = problem.limits.keep_outs[obstacle.limit.index];
    if (area.passage == Passage::either) continue;
    const bool below = area.passage == Passage::below;
    for (const GivenEnd& end : given_ends(problem)) {
      const std::array<Vec2, 2> place{end.point, end.point};
      if (!(obstacle.region.nearest(place).value < 0.0)) continue;
      Conflict conflict;
      conflict.limits.push_back({obstacle.limit, obstacle.clearance});
      conflict.text = std::string(end.name) + " lies " + (below ? "above " : "below ") +
                      obstacle.limit.key() + ", which is to be passed " + (below ? "below" : "above");
      conflict.why = "A track that ends there does not pass it on that side, however it leads.";
      return conflict;
    }
  }
  return std::nullopt;
}

std::optional<Conflict> too_close_at_an_end(const Problem& problem, const WouldDo& would_do) {
  const Limits& limits = problem.limits;
  if (limits.envelope.is_line()) return std::nullopt;
  const std::vector<task::Obstacle> obstacles = task::obstacles_of(limits);
  if (obstacles.empty()) return std::nullopt;
  for (const GivenEnd& end : given_ends(problem)) {
    const bool given = end.flattest <= end.steepest;
    if (given && lacking(end, limits.envelope, obstacles) > 0.0) {
      return conflict_at(end, limits.envelope, obstacles, would_do);
    }
  }
  return std::nullopt;
}

}  // namespace glissade::optimizer
