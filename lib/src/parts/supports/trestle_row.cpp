#include "parts/supports/trestle_row.hpp"

#include "glissade/core/math.hpp"

#include "parts/supports/side_view.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

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

/// What a row falls short of what is asked for, and what it takes.
struct RowCost {
  double excess = 0.0;    ///< sum of squares of what spans are wider than asked for
  std::size_t count = 0;  ///< of trestles
  double uneven = 0.0;    ///< sum of squares of spans

  /// @param span  one more; an end that sticks out counts twice: the moment of its weight, w a^2/2, is that of a span, w l^2/8
  [[nodiscard]] RowCost with(double span, double spacing) const {
    constexpr double kSame = 1e-9;  // rounding [m]
    const double more = span > spacing + kSame ? span - spacing : 0.0;
    return {excess + more * more, count, uneven + span * span};
  }
  /// Two of them at least, where they have places.
  [[nodiscard]] bool operator<(const RowCost& other) const {
    return std::pair(count < 2, std::tuple(excess, count, uneven)) <
           std::pair(other.count < 2, std::tuple(other.excess, other.count, other.uneven));
  }
};

RowCost cost_of(const Trestles& row, double spacing, double length) {
  RowCost cost = RowCost().with(2.0 * row.front().place.at, spacing);
  for (std::size_t i = 1; i < row.size(); ++i)
    cost = cost.with(row[i].place.at - row[i - 1].place.at, spacing);
  return cost.with(2.0 * (length - row.back().place.at), spacing);
}

/// Of all rows from these places that of the least cost.
Trestles cheapest(const Trestles& all, const SupportOptions& supports, double length) {
  constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  // Of the rows that end with a trestle the cheapest one of one, and of more.
  struct Way {
    RowCost cost;
    std::size_t from = kNone;
  };
  std::vector<Way> ways(all.size());
  std::optional<Way> best;
  std::size_t last = kNone;
  const auto end_with = [&](std::size_t i, Way way) {
    way.cost = way.cost.with(2.0 * (length - all[i].place.at), supports.spacing);
    if (best && !(way.cost < best->cost)) return;
    best = way;
    last = i;
  };
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double at = all[i].place.at;
    Way first{RowCost().with(2.0 * at, supports.spacing), kNone};
    first.cost.count = 1;
    std::optional<Way> joined;
    for (std::size_t k = 0; k < i; ++k) {
      if (!stand_beside(all[k], all[i], supports)) continue;
      Way one{ways[k].cost.with(at - all[k].place.at, supports.spacing), k};
      ++one.cost.count;
      if (!joined || one.cost < joined->cost) joined = one;
    }
    end_with(i, first);
    if (joined) end_with(i, *joined);
    // What goes on from here has two or more, either way.
    const auto as_part = [](const Way& way) {
      return std::tuple(way.cost.excess, way.cost.count, way.cost.uneven);
    };
    ways[i] = joined && as_part(*joined) < as_part(first) ? *joined : first;
  }
  Trestles row;
  std::size_t from = best ? best->from : kNone;
  if (last != kNone) row.push_back(all[last]);
  for (; from != kNone; from = ways[from].from) row.insert(row.begin(), all[from]);
  return row;
}

}  // namespace

Trestles trestles_along(const Shell& shell) {
  const SupportOptions& supports = *shell.options.supports;
  const double length = shell.track.length();
  const double gaps = std::max(1.0, std::ceil((length - 2.0 * kApart) / supports.spacing - 1e-9));
  const SideView view(shell);
  const TrestleSeats seats(shell, view);
  const Trestles even = evenly_standing(seats, gaps);
  if (!even.empty() && cost_of(even, supports.spacing, length).excess == 0.0) return even;
  Trestles all = all_standing(seats);
  all.insert(all.end(), even.begin(), even.end());
  std::stable_sort(all.begin(), all.end(),
                   [](const Standing& a, const Standing& b) { return a.place.at < b.place.at; });
  return cheapest(all, supports, length);
}

}  // namespace glissade::parts
