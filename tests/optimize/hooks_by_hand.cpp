#include "optimize/hooks_by_hand.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace glissade::testing_problems {
namespace {

constexpr double kGravity = 9.80665;
// All below in units of the chord and of gravity.
constexpr double kHookCurvature = 300.0;
constexpr double kSteepest = 1.565;
constexpr double kFlattest = -1.45;

struct Body {
  double x = 0.0;
  double y = 0.0;  ///< down
  double zeta = kSteepest;
  double speed2 = 0.0;
  double time = 0.0;
  double path = 0.0;
};

enum class Way { fall, at_cap, hook };

/// One track by the rules.
class Ride {
 public:
  Ride(double run, double friction, double cap) : run_(run), friction_(friction), cap2_(cap * cap) {}

  /// @param at_cap  lengths of the rides at the cap, before a hook each; the last one goes on to the finish
  /// @param turn    of each hook
  /// @return where it passes the finish, if it gets there
  [[nodiscard]] std::optional<Body> to_finish(const std::vector<double>& at_cap, double turn) const {
    Body body;
    for (std::size_t i = 0;; ++i) {
      while (body.speed2 < cap2_ * (1.0 - 1e-5)) {
        const double gain = 2.0 * std::sin(body.zeta);
        double step = step_of(Way::fall, body);
        if (gain > 0.0) step = std::min(step, std::max(1e-4, (cap2_ - body.speed2) / gain));
        if (const End end = advance(Way::fall, step, body); end != End::none) return arrived(end, body);
      }
      const bool last = i == at_cap.size();
      for (double left = last ? 1e9 : at_cap[i]; left > 1e-6;) {
        const double step = std::min(left, step_of(Way::at_cap, body));
        if (const End end = advance(Way::at_cap, step, body); end != End::none) return arrived(end, body);
        left -= step;
      }
      for (double left = turn; left > 1e-6 && body.zeta > kFlattest;) {
        const double before = body.zeta;
        const double step = std::min(left, 0.02) / kHookCurvature;
        if (const End end = advance(Way::hook, step, body); end != End::none) return arrived(end, body);
        left -= before - body.zeta;
      }
    }
  }

 private:
  enum class End { none, finish, lost };

  static std::optional<Body> arrived(End end, const Body& body) {
    return end == End::finish ? std::optional(body) : std::nullopt;
  }

  /// Positive into a valley; at the cap friction in the bend takes what the slope gives.
  [[nodiscard]] double curvature(Way way, const Body& body) const {
    const double cosine = std::cos(body.zeta);
    const double speed2 = std::max(body.speed2, 1e-9);
    const double lifts_off = -cosine / speed2;
    double kappa = kHookCurvature;
    if (way == Way::fall) kappa = lifts_off;
    if (way == Way::at_cap) kappa = (std::sin(body.zeta) - friction_ * cosine) / (friction_ * speed2);
    kappa = std::max(std::min(kappa, kHookCurvature), lifts_off);
    const bool held = (kappa < 0.0 && body.zeta >= kSteepest) || (kappa > 0.0 && body.zeta <= kFlattest);
    return held ? 0.0 : kappa;
  }

  [[nodiscard]] double step_of(Way way, const Body& body) const {
    const double usual = body.speed2 < 0.02 ? 0.0005 : 0.0015;
    return std::min(usual, 0.01 / std::max(std::fabs(curvature(way, body)), 1e-3));
  }

  /// By the midpoint rule.
  [[nodiscard]] End advance(Way way, double step, Body& body) const {
    const Body from = body;
    const auto gone = [&](const Body& at, double length) {
      const double kappa = curvature(way, at);
      const double load = std::cos(at.zeta) + kappa * at.speed2;
      Body to = from;
      to.x += length * std::cos(at.zeta);
      to.y += length * std::sin(at.zeta);
      to.zeta -= length * kappa;
      to.speed2 += length * 2.0 * (std::sin(at.zeta) - friction_ * load);
      return to;
    };
    Body middle = gone(from, 0.5 * step);
    middle.speed2 = std::max(middle.speed2, 1e-12);
    body = gone(middle, step);
    body.path += step;
    if (!(body.speed2 > 1e-6)) return End::lost;
    body.time += 2.0 * step / (std::sqrt(from.speed2) + std::sqrt(body.speed2));
    if (body.x >= run_) {
      const double part = (run_ - from.x) / (body.x - from.x);
      body.y = from.y + part * (body.y - from.y);
      body.time = from.time + part * (body.time - from.time);
      return End::finish;
    }
    const bool lost = body.path > 8.0 || body.y > 4.0 || body.y < -2.0;
    return lost ? End::lost : End::none;
  }

  double run_;
  double friction_;
  double cap2_;
};

/// Of one hook to three: what lies at the cap before the first one, and before each of the others.
std::vector<std::vector<double>> lengths_at_cap() {
  const std::vector<double> lengths{0.0, 0.03, 0.06, 0.1, 0.15, 0.22, 0.32, 0.45};
  std::vector<std::vector<double>> all;
  for (const double first : lengths) {
    all.push_back({first});
    for (const double other : lengths) {
      all.push_back({first, other});
      all.push_back({first, other, other});
    }
  }
  return all;
}

}  // namespace

std::optional<double> least_time_with_hooks(double run, double drop, double friction, double cap) {
  constexpr int kTurns = 12;
  constexpr double kWidest = 2.6;
  constexpr int kHalvings = 20;
  constexpr double kClose = 0.01;
  const double chord = std::hypot(run, drop);
  const double unit = std::sqrt(kGravity * chord);
  const Ride ride(run / chord, friction, cap / unit);
  std::optional<double> least;
  for (const std::vector<double>& at_cap : lengths_at_cap()) {
    std::optional<double> before;
    double below = 0.0;
    for (int k = 0; k <= kTurns; ++k) {
      const double turn = kWidest * k / kTurns;
      const std::optional<Body> end = ride.to_finish(at_cap, turn);
      const double off = end ? end->y - drop / chord : 0.0;
      if (end && before && off * below <= 0.0) {
        double low = *before;
        double high = turn;
        std::optional<Body> body = end;
        for (int halving = 0; halving < kHalvings && body; ++halving) {
          const double middle = 0.5 * (low + high);
          body = ride.to_finish(at_cap, middle);
          if (body) ((body->y - drop / chord) * below <= 0.0 ? high : low) = middle;
        }
        const bool close = body && std::fabs(body->y - drop / chord) < kClose;
        if (close && (!least || body->time < *least)) least = body->time;
      }
      before = end ? std::optional(turn) : std::nullopt;
      below = off;
    }
  }
  if (least) *least *= chord / unit;
  return least;
}

}  // namespace glissade::testing_problems
