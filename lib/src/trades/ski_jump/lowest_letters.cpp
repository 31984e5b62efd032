// One letter after the other, as long as that gains. Letters that give another take-off speed than the one asked for, whatever
// their straight, count as infinitely high: a line of search ends where they begin. Where the shortest straight is in the way the
// three letters hold each other, and two of them move together.

#include "glissade/core/error.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/units.hpp"

#include "trades/ski_jump/straight.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include <boost/math/tools/minima.hpp>
#include <boost/math/tools/toms748_solve.hpp>

namespace glissade {
namespace trades {
namespace {

/// gamma [rad], r1 [m], t [m]
constexpr std::size_t kCount = 3;
constexpr std::size_t kGamma = 0;
using Letters = std::array<double, kCount>;

struct Sides {
  double lowest = 0.0;
  double highest = 0.0;
};

Sides sides_of(const Range& bound, double now) {
  Sides sides{bound.lowest.value_or(now), bound.highest.value_or(now)};
  if (bound.lowest && !bound.highest) sides.highest = std::max(now, sides.lowest);
  if (bound.highest && !bound.lowest) sides.lowest = std::min(now, sides.highest);
  if (!(sides.lowest <= sides.highest)) {
    throw InputError({"bounds",
                      "a letter's lowest bound, " + exact_text(sides.lowest) + ", is above its highest, " +
                          exact_text(sides.highest),
                      "Nothing lies between them.", ""});
  }
  return sides;
}

/// Letters with the straight that gives the take-off speed.
struct Trial {
  Letters letters = {};
  InRunShape shape;
  Reach reach = Reach::no_bend;
  double drop = HUGE_VAL;  ///< infinite where they do not give it [m]
  double straight = 0.0;   ///< [m]
};

class LowestLetters {
 public:
  LowestLetters(const InRunShape& shape, const LetterBounds& bounds, const TakeOff& take_off)
      : shape_(shape),
        take_off_(take_off),
        own_{shape.gamma.radians(), shape.r1, shape.t},
        sides_{sides_of(bounds.gamma, own_[0]), sides_of(bounds.r1, own_[1]), sides_of(bounds.t, own_[2])},
        shortest_(std::max(bounds.straight, kShortestStraight)) {}

  [[nodiscard]] InRunShape found() const {
    Trial best = start();
    constexpr int kMostRounds = 20;  // budget: two where the lowest letters lie at their bounds
    constexpr double kGain = 1e-9;   // accuracy: [m]
    for (int round = 0; round < kMostRounds; ++round) {
      const double before = best.drop;
      for (std::size_t letter = 0; letter < kCount; ++letter) best = moved(best, letter);
      if (before - best.drop >= kGain) continue;
      if (has_shortest_straight(best)) best = moved_along_shortest(best);
      if (before - best.drop < kGain) break;
    }
    return best.shape;
  }

 private:
  [[nodiscard]] InRunShape with(const Letters& letters) const {
    InRunShape shape = shape_;
    shape.gamma = Angle::from_radians(letters[0]);
    shape.r1 = letters[1];
    shape.t = letters[2];
    return shape;
  }

  /// @param shape  with letters that make an in-run
  [[nodiscard]] double speed_with(InRunShape shape, double straight) const {
    shape.length = transition_length(shape) + shape.t + straight;
    return exit_speed(std::make_shared<const InRun>(shape), take_off_);
  }

  [[nodiscard]] Trial tried(const Letters& letters) const {
    Trial trial{letters, with(letters)};
    if (!letter_problems(trial.shape).empty()) return trial;
    const Straight straight = straight_for(
        take_off_, [&](double length) { return speed_with(trial.shape, length); }, shortest_);
    trial.reach = straight.reach;
    if (straight.reach != Reach::reached) return trial;
    trial.straight = straight.length;
    trial.shape.length = transition_length(trial.shape) + trial.shape.t + straight.length;
    trial.drop = InRun(trial.shape).endpoints().drop;
    return trial;
  }

  /// The lowest of the letters as they are and of all corners of the bounds; where none of those can be, some between.
  [[nodiscard]] Trial start() const {
    Letters clamped = own_;
    for (std::size_t i = 0; i < kCount; ++i)
      clamped[i] = std::clamp(own_[i], sides_[i].lowest, sides_[i].highest);
    std::vector<Trial> seen = {tried(clamped)};
    for (const bool is_large : {false, true}) {
      for (const bool is_long : {false, true}) {
        const auto corner = [&](double gamma) {
          return tried({gamma, is_large ? sides_[1].highest : sides_[1].lowest,
                        is_long ? sides_[2].highest : sides_[2].lowest});
        };
        seen.push_back(corner(sides_[kGamma].lowest));
        const Reach gentle = seen.back().reach;
        seen.push_back(corner(sides_[kGamma].highest));
        if (gentle == Reach::too_slow && seen.back().reach == Reach::too_fast)
          seen.push_back(between_reaches(corner));
      }
    }
    const Trial best = *std::min_element(
        seen.begin(), seen.end(), [](const Trial& one, const Trial& other) { return one.drop < other.drop; });
    if (!std::isfinite(best.drop)) refuse(seen);
    return best;
  }

  /// The gentlest in-run is too slow and the steepest too fast: what lies between is looked for by halves.
  [[nodiscard]] Trial between_reaches(const std::function<Trial(double)>& with_gamma) const {
    double gentle = sides_[kGamma].lowest;
    double steep = sides_[kGamma].highest;
    constexpr int kMostHalvings = 50;  // accuracy: to rounding
    for (int i = 0; i < kMostHalvings; ++i) {
      const double middle = 0.5 * (gentle + steep);
      const Trial trial = with_gamma(middle);
      if (std::isfinite(trial.drop)) return trial;
      (trial.reach == Reach::too_slow ? gentle : steep) = middle;
    }
    return with_gamma(gentle);
  }

  [[noreturn]] void refuse(const std::vector<Trial>& seen) const {
    const auto has_bend = [](const Trial& trial) { return trial.reach != Reach::no_bend; };
    const auto first = std::find_if(seen.begin(), seen.end(), has_bend);
    if (first == seen.end()) {
      static_cast<void>(InRun(seen.front().shape));  // says what is wrong with the letters
      throw InternalError({"", "letters of an in-run are refused, and it is not", "", ""});
    }
    static_cast<void>(required({first->reach, 0.0}, take_off_));
    throw InternalError({"", "a straight that is there is refused", "", ""});
  }

  /// The lowest trial along a line through a place where there is one.
  /// @param now  where that is
  [[nodiscard]] static Trial lowest_along(Sides line, double now, Trial best,
                                          const std::function<Trial(double)>& at) {
    const auto drop = [&](double value) {
      const Trial trial = at(value);
      if (trial.drop < best.drop) best = trial;
      return trial.drop;
    };
    const auto end = [&](double farthest) {
      if (farthest == now || std::isfinite(drop(farthest))) return farthest;
      double can_be = now;
      constexpr int kMostHalvings = 42;  // accuracy: some 1e-13 of the line
      for (int i = 0; i < kMostHalvings; ++i) {
        const double middle = 0.5 * (can_be + farthest);
        (std::isfinite(drop(middle)) ? can_be : farthest) = middle;
      }
      return can_be;
    };
    const double from = end(line.lowest);
    const double to = end(line.highest);
    constexpr int kMinimumBits = 20;  // accuracy: of a drop that is flat where it is least
    std::uintmax_t most = 30;
    if (from < to)
      static_cast<void>(boost::math::tools::brent_find_minima(drop, from, to, kMinimumBits, most));
    return best;
  }

  [[nodiscard]] Trial moved(const Trial& from, std::size_t letter) const {
    return lowest_along(sides_[letter], from.letters[letter], from, [&](double value) {
      Letters letters = from.letters;
      letters[letter] = value;
      return tried(letters);
    });
  }

  [[nodiscard]] bool has_shortest_straight(const Trial& trial) const {
    constexpr double kNear = 1e-6;  // accuracy: of a line that ends there [m]
    return trial.straight < shortest_ + kNear;
  }

  /// Each letter once more, with each of the others going with it so that the straight stays the shortest.
  [[nodiscard]] Trial moved_along_shortest(Trial best) const {
    for (std::size_t letter = 0; letter < kCount; ++letter) {
      for (std::size_t follower = 0; follower < kCount; ++follower) {
        if (follower == letter || sides_[follower].lowest == sides_[follower].highest) continue;
        const Trial from = best;
        best = lowest_along(sides_[letter], from.letters[letter], from, [&](double value) {
          Letters letters = from.letters;
          letters[letter] = value;
          return with_shortest(letters, follower);
        });
      }
    }
    return best;
  }

  /// The letters with the one of them that gives the take-off speed below the shortest straight; no drop where none does.
  [[nodiscard]] Trial with_shortest(Letters letters, std::size_t follower) const {
    const auto excess = [&](double value) {
      letters[follower] = value;
      const InRunShape shape = with(letters);
      // Only a gamma can make no in-run, where it is too gentle or too steep.
      if (!letter_problems(shape).empty()) return value < own_[follower] ? -take_off_.speed : take_off_.speed;
      return speed_with(shape, shortest_) - take_off_.speed;
    };
    const Sides& sides = sides_[follower];
    if ((excess(sides.lowest) > 0.0) == (excess(sides.highest) > 0.0)) return {};
    std::uintmax_t most = 60;
    constexpr int kBits = 44;  // accuracy: of a letter that is bracketed
    const auto [left, right] = boost::math::tools::toms748_solve(
        excess, sides.lowest, sides.highest, boost::math::tools::eps_tolerance<double>(kBits), most);
    letters[follower] = left;
    const Trial trial = tried(letters);
    if (std::isfinite(trial.drop)) return trial;
    letters[follower] = right;
    return tried(letters);
  }

  InRunShape shape_;
  TakeOff take_off_;
  Letters own_;
  std::array<Sides, kCount> sides_;
  double shortest_;
};

}  // namespace
}  // namespace trades

InRunShape least_drop_in_run(const InRunShape& shape, const LetterBounds& bounds, const TakeOff& take_off) {
  return trades::LowestLetters(shape, bounds, take_off).found();
}

}  // namespace glissade
