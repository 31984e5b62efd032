#include "parts/supports/trestle_row.hpp"

#include "glissade/core/math.hpp"

#include "parts/plates/even_row.hpp"
#include "parts/supports/side_view.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

namespace glissade::parts {
namespace {

constexpr double kOffTaken = 10e-3;                      // taste: of what is taken [m]
constexpr double kLeastClear = kSaddleHalf + kOffTaken;  // of a trestle's middle from it [m]
constexpr double kApart = 300e-3;  // of the first and last trestle from the ends, about [m]

/// How far from a trestle along the track frames must stay: below a slope they lean back over its beam.
double clear_of(const Shell& shell, double at, double saddle_height) {
  const PlateOptions& options = shell.options;
  const double width = std::max(options.flanges.width, options.stiffeners ? options.stiffeners->width : 0.0);
  const double high =
      width + options.flanges.gap + saddle_height - shell.lowest + std::max(0.0, -shell.lowest);
  const auto [sine, cosine] = math::sine_cosine(shell.track.at(at).slope_angle);
  const double reach = (0.5 * options.supports->tube + high * std::fabs(sine)) / std::max(0.1, cosine);
  return std::max(kLeastClear, reach + kOffTaken);
}

std::optional<TrestlePlace> free_place(const Shell& shell, const TakenUp& taken, double about, double clear) {
  const Span whole = shell.whole;
  if (shell.straights.empty()) {
    const auto at = taken.free_place(about, clear, whole);
    if (!at) return std::nullopt;
    return TrestlePlace{*at, kSaddleHalf};
  }
  // In the middle of what is straight, where that is shorter than a saddle.
  constexpr double kLeastHalf = 20e-3;
  constexpr double kOffBend = 1e-3;
  std::optional<TrestlePlace> best;
  for (const Straight& straight : shell.straights) {
    const double half = std::min(kSaddleHalf, 0.5 * (straight.span.to - straight.span.from) - kOffBend);
    if (half < kLeastHalf) continue;
    const Span room{straight.span.from + kOffBend + half, straight.span.to - kOffBend - half};
    constexpr int kPlaces = 20;
    for (int k = 0; k <= kPlaces; ++k) {
      const double s = room.from + (room.to - room.from) * k / kPlaces;
      if (best && std::fabs(best->at - about) <= std::fabs(s - about)) continue;
      if (taken.is_free(s, clear, whole)) best = TrestlePlace{s, half};
    }
  }
  return best;
}

/// Looks for places at which a trestle can stand.
class TrestleSeats {
 public:
  TrestleSeats(const Shell& shell, const SideView& view) : shell_(shell), view_(view) {}

  /// @param clear  that it keeps off what is taken, at the least [m]
  /// @return the free place nearest to one, clear of what leans over it; none where that is none
  [[nodiscard]] std::optional<Standing> near(double about, const TakenUp& taken, double clear,
                                             int tries) const {
    constexpr double kFarther =
        10e-3;  // taste: that one keeps off more, where a frame stands over its beam [m]
    for (int k = 0; k < tries; ++k, clear += kFarther) {
      const auto place = free_place(shell_, taken, about, clear);
      if (!place) return std::nullopt;
      if (auto one = at(*place, clear)) return one;
    }
    return std::nullopt;
  }

  /// @return a trestle at a place; none where the track is too steep, or where it is steeper than where it was asked for, and frames
  ///         lean farther over it
  [[nodiscard]] std::optional<Standing> at(const TrestlePlace& place, double clear) const {
    if (shell_.track.at(place.at).slope_angle > shell_.options.supports->steepest.radians())
      return std::nullopt;
    const Saddles saddles = saddles_at(shell_, place.at, place.half);
    if (!seat_line(shell_, place.at, place.half, saddles.height[0]) ||
        !seat_line(shell_, place.at, place.half, saddles.height[1]))
      return std::nullopt;
    Standing one{place, clear, saddles, trestle_at(shell_, place.at, saddles)};
    if (!view_.is_clear(one.trestle, shell_.options.supports->tube) || !saddles_clear(one))
      return std::nullopt;
    return one;
  }

  [[nodiscard]] const Shell& shell() const { return shell_; }

 private:
  [[nodiscard]] bool saddles_clear(const Standing& one) const {
    for (std::size_t side = 0; side < 2; ++side) {
      const auto seat = seat_line(shell_, one.place.at, one.place.half, one.saddles.height[side]);
      if (!view_.is_clear(*seat, one.saddles.aside[side], one.trestle.beam)) return false;
    }
    return true;
  }

  const Shell& shell_;
  const SideView& view_;
};

/// Whether two trestles, one after the other, leave each other what they take up, and do not stand on each other's base plates.
bool stand_beside(const Standing& a, const Standing& b, const SupportOptions& supports) {
  constexpr double kSame = 1e-9;  // rounding [m]
  return b.place.at - a.place.at >= a.clear + b.clear - kSame &&
         std::fabs(b.trestle.x - a.trestle.x) >= base_side(supports) + kBaseGap;
}

/// In so many gaps, as even as what is taken allows; those that find no place are left out.
Trestles evenly_standing(const TrestleSeats& seats, double gaps) {
  const Shell& shell = seats.shell();
  const double room = std::max(0.0, shell.track.length() - 2.0 * kApart);
  TakenUp taken = shell.taken;
  constexpr int kTries = 12;  // budget
  Trestles row;
  for (double k = 0.0; k <= gaps; k += 1.0) {
    const double about = kApart + room * k / gaps;
    const auto one =
        seats.near(about, taken, clear_of(shell, about, saddles_at(shell, about, 0.0).height[0]), kTries);
    if (!one) continue;
    const auto after = std::find_if(row.begin(), row.end(),
                                    [&](const Standing& other) { return other.place.at > one->place.at; });
    const SupportOptions& supports = *shell.options.supports;
    // Two of them on the only places that are free stand on each other's base plates.
    if (after != row.begin() && !stand_beside(*(after - 1), *one, supports)) continue;
    if (after != row.end() && !stand_beside(*one, *after, supports)) continue;
    taken.add(one->place.at - one->clear, one->place.at + one->clear);
    row.insert(after, *one);
  }
  return row;
}

/// Every place at which one could stand, in steps.
Trestles all_standing(const TrestleSeats& seats) {
  constexpr double kStep = 10e-3;  // taste: in which places are looked for, no finer [m]
  constexpr double kMost = 400.0;  // budget: of steps
  constexpr int kTries = 3;        // budget: places farther off are those of other steps
  const Shell& shell = seats.shell();
  const double length = shell.track.length();
  const double steps = std::clamp(std::ceil(length / kStep), 1.0, kMost);
  Trestles all;
  for (double k = 0.0; k <= steps; k += 1.0) {
    // What leans over it is looked at from the side; of the rest it keeps off as a trestle below a level track.
    if (auto one = seats.near(length * k / steps, shell.taken, kLeastClear, kTries))
      all.push_back(*std::move(one));
  }
  std::stable_sort(all.begin(), all.end(), [](const Standing& a, const Standing& b) {
    return std::pair(a.place.at, a.clear) < std::pair(b.place.at, b.clear);
  });
  const auto same = [](const Standing& a, const Standing& b) { return a.place.at == b.place.at; };
  all.erase(std::unique(all.begin(), all.end(), same), all.end());
  return all;
}

RowTask task_of(const Trestles& all, const Shell& shell) {
  const SupportOptions& supports = *shell.options.supports;
  RowTask task;
  for (const Standing& one : all) task.places.push_back(one.place.at);
  task.to = shell.track.length();
  task.spacing = supports.spacing;
  // The moment of the weight of an end that sticks out, w a^2/2, is that of a span, w l^2/8.
  task.end_weight = 2.0;
  task.least = 2;
  task.beside = [&](std::size_t a, std::size_t b) { return stand_beside(all[a], all[b], supports); };
  return task;
}

bool keeps_to_spacing(const Trestles& row, const Shell& shell) {
  if (row.empty()) return false;
  std::vector<std::size_t> all(row.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  return cost_of(task_of(row, shell), all).excess == 0.0;
}

}  // namespace

Trestles trestles_along(const Shell& shell) {
  const SupportOptions& supports = *shell.options.supports;
  const double length = shell.track.length();
  const double gaps = std::max(1.0, std::ceil((length - 2.0 * kApart) / supports.spacing - 1e-9));
  const SideView view(shell);
  const TrestleSeats seats(shell, view);
  const Trestles even = evenly_standing(seats, gaps);
  if (keeps_to_spacing(even, shell)) return even;
  Trestles all = all_standing(seats);
  all.insert(all.end(), even.begin(), even.end());
  std::stable_sort(all.begin(), all.end(),
                   [](const Standing& a, const Standing& b) { return a.place.at < b.place.at; });
  Trestles row;
  for (const std::size_t i : cheapest_row(task_of(all, shell))) row.push_back(all[i]);
  return row;
}

}  // namespace glissade::parts
