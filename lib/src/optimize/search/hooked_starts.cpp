#include "optimize/search/hooked_starts.hpp"

#include "glissade/core/math.hpp"
#include "glissade/core/units.hpp"

#include "core/float_limits.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

namespace glissade::optimizer {
namespace hooked {
namespace {

using core::kInfinity;

/// What the limits leave of slope, curvature, load and speed.
struct Room {
  double cap = kInfinity;       ///< of the squared speed
  double exit_cap = kInfinity;  ///< the same at the finish
  double lowest = -1.45;        ///< slope angles [rad]; taste: a little less than upright
  double highest = 1.565;       // taste
  double valley = 60.0;  ///< greatest curvature of a hook [1/chord]; taste: what some thirty pieces follow
  double crest = kInfinity;  ///< and of a fall
  double lightest = 0.0;     ///< loads in g
  double heaviest = kInfinity;
  double bend_load = kInfinity;  ///< curvature times squared speed
  double entry_lowest = -kRightAngle;
  double entry_highest = kRightAngle;
  double exit_lowest = -kRightAngle;
  double exit_highest = kRightAngle;
};

Room room_of(const ScaledProblem& problem) {
  Room room;
  for (const LimitSpec& limit : problem.limits) {
    const auto take = [&](double& least, double& most) {
      if (limit.side <= 0) least = std::max(least, limit.bound);
      if (limit.side >= 0) most = std::min(most, limit.bound);
    };
    double none = -kInfinity;
    if (limit.measure == Measure::speed && limit.side > 0) {
      room.cap = std::min(room.cap, limit.bound * limit.bound);
    } else if (limit.measure == Measure::exit_speed && limit.side >= 0) {
      room.exit_cap = std::min(room.exit_cap, limit.bound * limit.bound);
    } else if (limit.measure == Measure::slope_angle) {
      take(room.lowest, room.highest);
    } else if (limit.measure == Measure::entry_slope_angle) {
      take(room.entry_lowest, room.entry_highest);
    } else if (limit.measure == Measure::exit_slope_angle) {
      take(room.exit_lowest, room.exit_highest);
    } else if (limit.measure == Measure::normal_load) {
      take(room.lightest, room.heaviest);
    } else if (limit.measure == Measure::curvature_load) {
      take(none, room.bend_load);
    } else if (limit.measure == Measure::curvature && limit.side > 0) {
      room.valley = std::min(room.valley, limit.bound);
    } else if (limit.measure == Measure::curvature && limit.side < 0) {
      room.crest = std::min(room.crest, -limit.bound);
    }
  }
  return room;
}

enum class Piece { straight, fall, at_cap, hook };

/// A track in the making, with every body of the friction range on it.
struct State {
  double x = 0.0;
  double y = 0.0;
  double zeta = 0.0;
  double s = 0.0;
  double t = 0.0;
  std::vector<double> v;  ///< squared speed of each ride
};

/// What makes a track: its entry, how long it rides at the cap before each hook, and how far each hook turns.
struct Plan {
  double entry = 0.0;
  std::vector<double> at_cap;
  std::vector<double> turns;
};

struct EndOfRide {
  double y = 0.0;
  double zeta = 0.0;
  double t = 0.0;
  double v = 0.0;  ///< of the fastest body
};

/// Rides down plans.
class Rider {
 public:
  Rider(const ScaledProblem& problem, const Room& room) : problem_(problem), room_(room) {}

  /// @param path  where the states on the way are added
  /// @return none where it does not come to the run of the finish
  [[nodiscard]] std::optional<EndOfRide> ride(const Plan& plan, std::vector<State>* path = nullptr) const {
    constexpr double kLongest = 8.0;  // chords; taste
    State state;
    state.zeta = plan.entry;
    for (const Ride& ride : problem_.rides) state.v.push_back(ride.entry_speed2);
    State before;
    std::optional<EndOfRide> end;
    const auto goes_on = [&](Piece piece, double most) {
      if (path != nullptr) path->push_back(state);
      before = state;
      if (!advance(piece, std::min(most, step_of(piece, state)), state)) return false;
      if (state.x >= problem_.run) {
        const double share = (problem_.run - before.x) / (state.x - before.x);
        const auto at = [&](double a, double b) { return a + share * (b - a); };
        end = EndOfRide{at(before.y, state.y), at(before.zeta, state.zeta), at(before.t, state.t),
                        at(before.v.front(), state.v.front())};
        if (path != nullptr) {
          path->push_back(state);
          path->back().s = at(before.s, state.s);
          path->back().zeta = end->zeta;
        }
        return false;
      }
      return state.s < kLongest;
    };
    while (state.s < problem_.lead_in) {
      if (!goes_on(Piece::straight, problem_.lead_in - state.s + 1e-9)) return end;
    }
    for (std::size_t hook = 0;; ++hook) {
      while (state.v.front() < room_.cap * (1.0 - 1e-3)) {
        const double rises = 2.0 * math::sin(state.zeta);
        const double most = rises > 0.0 ? std::max(1e-4, (room_.cap - state.v.front()) / rises) : kInfinity;
        if (!goes_on(Piece::fall, most)) return end;
      }
      const bool last = hook >= plan.turns.size();
      for (double left = last ? kInfinity : plan.at_cap[hook]; left > 1e-9;) {
        if (!goes_on(Piece::at_cap, left)) return end;
        left -= state.s - before.s;
      }
      if (last) return std::nullopt;
      for (double left = plan.turns[hook]; left > 1e-6 && state.zeta > room_.lowest + 1e-6;) {
        const double bend = curvature(Piece::hook, state);
        if (!(bend > 0.0)) return std::nullopt;
        if (!goes_on(Piece::hook, left / bend)) return end;
        left -= before.zeta - state.zeta;
      }
    }
  }

 private:
  [[nodiscard]] double curvature(Piece piece, const State& state) const {
    const auto [sine, cosine] = math::sine_cosine(state.zeta);
    const double v = std::max(state.v.front(), 1e-9);
    const Ride& ride = problem_.rides.front();
    const double least = std::max(-room_.crest, (room_.lightest - cosine) / v);
    double bend = 0.0;
    switch (piece) {
      case Piece::straight:
        return 0.0;
      case Piece::fall:
        bend = least;
        break;
      case Piece::at_cap:
        bend = ride.friction > 0.0 ? (sine - ride.friction * cosine - ride.drag * v) / (ride.friction * v)
                                   : least;
        break;
      case Piece::hook:
        bend = room_.valley;
        break;
    }
    bend = std::min({bend, room_.valley, (room_.heaviest - cosine) / v, room_.bend_load / v});
    bend = std::max(bend, least);
    const bool is_at_end =
        (bend < 0.0 && state.zeta >= room_.highest) || (bend > 0.0 && state.zeta <= room_.lowest);
    return is_at_end ? 0.0 : bend;
  }

  [[nodiscard]] double step_of(Piece piece, const State& state) const {
    constexpr double kLongest = 0.012;  // chords; taste
    constexpr double kSlow = 0.02;      // of the squared speed; taste
    constexpr double kMostTurn = 0.08;  // [rad]; taste
    const double longest = state.v.front() < kSlow ? kLongest / 3.0 : kLongest;
    return std::min(longest, kMostTurn / std::max(std::fabs(curvature(piece, state)), 1e-3));
  }

  /// By the midpoint rule. @return false where a body stalls
  [[nodiscard]] bool advance(Piece piece, double ds, State& state) const {
    constexpr double kStalled = 1e-5;  // taste
    const auto rate = [&](std::size_t i, double zeta, double bend, double v) {
      const Ride& ride = problem_.rides[i];
      const auto [sine, cosine] = math::sine_cosine(zeta);
      return 2.0 * (sine - ride.friction * (cosine + bend * v) - ride.drag * v);
    };
    const double bend = curvature(piece, state);
    State middle = state;
    middle.zeta -= 0.5 * ds * bend;
    for (std::size_t i = 0; i < state.v.size(); ++i)
      middle.v[i] = std::max(1e-12, state.v[i] + 0.5 * ds * rate(i, state.zeta, bend, state.v[i]));
    const double bend_there = curvature(piece, middle);
    const auto [sine, cosine] = math::sine_cosine(middle.zeta);
    state.x += ds * cosine;
    state.y += ds * sine;
    state.zeta -= ds * bend_there;
    state.s += ds;
    for (std::size_t i = 0; i < state.v.size(); ++i) {
      const double before = state.v[i];
      state.v[i] += ds * rate(i, middle.zeta, bend_there, middle.v[i]);
      if (!(state.v[i] > kStalled)) return false;
      if (i == problem_.objective_ride)
        state.t += 2.0 * ds / (std::sqrt(std::max(before, 0.0)) + std::sqrt(state.v[i]));
    }
    return true;
  }

  const ScaledProblem& problem_;
  const Room& room_;
};

/// The fastest plans.
class Planner {
 public:
  Planner(const ScaledProblem& problem, const Room& room)
      : problem_(problem), room_(room), rider_(problem, room) {}

  struct Found {
    Plan plan;
    double worth = kInfinity;  ///< time, and what is broken at the finish
  };

  /// Whether a fall as steep as it may begin, and the ride at the cap behind it, end above the finish.
  [[nodiscard]] bool asks_for_hooks() const {
    const std::optional<EndOfRide> end = rider_.ride({entries().back(), {}, {}});
    return !end || end->y < problem_.drop;
  }

  [[nodiscard]] std::optional<Found> with_hooks(std::size_t hooks) const {
    Found best;
    for (const double entry : entries()) {
      for (const double first : kAtCap) {
        for (const double others : kAtCap) {
          if (hooks == 1 && others != kAtCap[0]) continue;
          for (const double last : kLastTurns) {
            if (last != 1.0 && (hooks == 1 || !asks_of_exit())) continue;
            Plan plan{entry, std::vector<double>(hooks, others), std::vector<double>(hooks, 1.0)};
            plan.at_cap.front() = first;
            plan.turns.back() = last;
            take(plan, best);
          }
        }
      }
    }
    if (best.worth == kInfinity) return std::nullopt;
    improve(best);
    return best;
  }

  [[nodiscard]] GuessCurve curve_of(const Plan& plan) const {
    std::vector<State> path;
    (void)rider_.ride(plan, &path);
    GuessCurve curve;
    const double from = problem_.lead_in;
    const double whole = path.back().s - problem_.lead_out - from;
    for (const State& state : path) {
      const double sigma = (state.s - from) / whole;
      if (sigma < 0.0 || sigma > 1.0) continue;
      if (!curve.sigma.empty() && !(sigma > curve.sigma.back() + 1e-9)) continue;
      curve.sigma.push_back(sigma);
      curve.zeta.push_back(state.zeta);
      curve.speed.push_back(std::sqrt(std::max(state.v.front(), 1e-6)));
    }
    curve.sigma.front() = 0.0;
    curve.sigma.back() = 1.0;
    curve.length = whole;
    return curve;
  }

 private:
  static constexpr double kAtCap[] = {0.0, 0.08, 0.18, 0.32};  // chords; taste
  static constexpr double kLastTurns[] = {1.0, 0.6, 1.5};      // of the others; taste

  [[nodiscard]] std::vector<double> entries() const {
    const double highest = std::min(room_.highest, room_.entry_highest);
    const double lowest = std::max(room_.lowest, room_.entry_lowest);
    if (problem_.entry_speed2 == 0.0 || !(lowest < highest)) return {highest};
    const double mean = math::atan2(problem_.drop, problem_.run);
    std::vector<double> entries;
    for (const double more : {-0.2, 0.2, 0.5}) entries.push_back(std::clamp(mean + more, lowest, highest));
    entries.erase(std::unique(entries.begin(), entries.end()), entries.end());
    return entries;
  }

  [[nodiscard]] bool asks_of_exit() const {
    return room_.exit_cap < kInfinity || room_.exit_lowest > -kRightAngle || room_.exit_highest < kRightAngle;
  }

  /// A plan whose hooks turn as far as leads to the finish, in the proportion of its turns.
  void take(const Plan& plan, Found& best) const {
    constexpr int kSteps = 9;      // taste
    constexpr int kHalvings = 11;  // taste
    constexpr double kMost = 2.7;  // [rad]; taste
    const auto turned = [&](double by) {
      Plan scaled = plan;
      for (double& turn : scaled.turns) turn *= by;
      return scaled;
    };
    bool is_known = false;
    double before = 0.0;
    double low = 0.0;
    for (int step = 1; step <= kSteps; ++step) {
      const double by = kMost * step / kSteps;
      const std::optional<EndOfRide> end = rider_.ride(turned(by));
      if (!end) {
        is_known = false;
        continue;
      }
      const double off = end->y - problem_.drop;
      if (is_known && off * before <= 0.0) halve(turned, low, by, before, kHalvings, best);
      is_known = true;
      before = off;
      low = by;
    }
  }

  void halve(const std::function<Plan(double)>& turned, double low, double high, double off_low, int halvings,
             Found& best) const {
    constexpr double kNear = 2e-3;  // chords; taste
    for (int i = 0; i < halvings; ++i) {
      const double middle = 0.5 * (low + high);
      const std::optional<EndOfRide> end = rider_.ride(turned(middle));
      if (!end) return;
      const double off = end->y - problem_.drop;
      if (std::fabs(off) < kNear && (i + 1 == halvings || std::fabs(off) < 1e-5)) {
        const double worth = worth_of(*end);
        if (worth < best.worth) best = {turned(middle), worth};
        return;
      }
      if (off * off_low > 0.0) {
        low = middle;
      } else {
        high = middle;
      }
    }
  }

  [[nodiscard]] double worth_of(const EndOfRide& end) const {
    constexpr double kPrice = 1.0;  // of each radian, and of the squared speed; taste
    const double slope = std::max({0.0, room_.exit_lowest - end.zeta, end.zeta - room_.exit_highest});
    const double speed = std::max(0.0, end.v - room_.exit_cap);
    return end.t + kPrice * (slope + speed);
  }

  /// One number of the plan after the other, by smaller and smaller steps.
  void improve(Found& best) const {
    constexpr int kRounds = 6;  // budget
    double way = 0.06;          // chords; taste
    double share = 0.25;        // taste
    for (int round = 0; round < kRounds; ++round) {
      const double known = best.worth;
      for (std::size_t hook = 0; hook < best.plan.turns.size(); ++hook) {
        for (const double side : {1.0, -1.0}) {
          Plan longer = best.plan;
          longer.at_cap[hook] = std::max(0.0, longer.at_cap[hook] + side * way);
          take_near(longer, best);
          if (hook == 0) continue;
          Plan wider = best.plan;
          wider.turns[hook] *= 1.0 + side * share;
          take_near(wider, best);
        }
      }
      if (best.worth < known) continue;
      way *= 0.4;
      share *= 0.4;
    }
  }

  /// take() of a plan whose turns are about right.
  void take_near(const Plan& plan, Found& best) const {
    constexpr double kNear = 0.25;  // taste
    constexpr int kHalvings = 14;   // taste
    const auto turned = [&](double by) {
      Plan scaled = plan;
      for (double& turn : scaled.turns) turn *= by;
      return scaled;
    };
    const std::optional<EndOfRide> less = rider_.ride(turned(1.0 - kNear));
    const std::optional<EndOfRide> more = rider_.ride(turned(1.0 + kNear));
    if (!less || !more) return;
    const double off = less->y - problem_.drop;
    if (off * (more->y - problem_.drop) > 0.0) return;
    halve(turned, 1.0 - kNear, 1.0 + kNear, off, kHalvings, best);
  }

  const ScaledProblem& problem_;
  const Room& room_;
  Rider rider_;
};

}  // namespace
}  // namespace hooked

std::vector<GuessCurve> hooked_starts(const ScaledProblem& problem) {
  constexpr std::size_t kMostHooks = 4;  // taste
  using namespace hooked;
  const Room room = room_of(problem);
  const bool applies = room.cap < kInfinity && problem.finish == FinishKind::point &&
                       problem.changes.empty() && !is_smooth(problem) && room.lowest < room.highest;
  if (!applies) return {};
  const Planner planner(problem, room);
  if (!planner.asks_for_hooks()) return {};
  std::vector<Planner::Found> plans;
  for (std::size_t hooks = 1; hooks <= kMostHooks; ++hooks) {
    if (auto found = planner.with_hooks(hooks)) plans.push_back(std::move(*found));
  }
  std::stable_sort(plans.begin(), plans.end(),
                   [](const Planner::Found& a, const Planner::Found& b) { return a.worth < b.worth; });
  std::vector<GuessCurve> curves;
  for (const Planner::Found& found : plans) curves.push_back(planner.curve_of(found.plan));
  return curves;
}

}  // namespace glissade::optimizer
