// Of the circles that touch a kept piece at a place, those that pass a sample within the band have curvatures between two
// values. Both values change one way as the place moves along the kept piece (each is a ratio of linear functions of the
// cosine of what lies between), so that over an interval of places they are bounded by what they are at its ends. So
// intervals of places are left out that no arc can leave from, and the others halved.

#include "parts/curves/least_arcs.hpp"

#include "parts/curves/arc_at.hpp"
#include "parts/curves/fewest_arcs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

namespace glissade::parts {
namespace {

constexpr int kPlaces = 12;          // intervals of places to begin with
constexpr int kMostIntervals = 400;  // that are looked at; what is left open then counts as possible
constexpr int kMeetingSteps = 64;    // along a stretch at which kept pieces may meet
constexpr double kRounding = 1e-12;  // of the track's length, by which pieces that meet may miss each other
constexpr double kTooNear = 4.0;     // widths of the band within which a sample tells nothing of a curvature

/// Curvatures between two values.
struct Curvatures {
  double lowest = -std::numeric_limits<double>::infinity();
  double highest = std::numeric_limits<double>::infinity();

  [[nodiscard]] bool none() const { return lowest > highest; }
  void narrow(const Curvatures& other) {
    lowest = std::max(lowest, other.lowest);
    highest = std::min(highest, other.highest);
  }
  void widen(const Curvatures& other) {
    lowest = std::min(lowest, other.lowest);
    highest = std::max(highest, other.highest);
  }
};

/// Places along a kept piece that an arc may leave from, as lengths beyond where it meets the stretch [m].
struct Interval {
  double from = 0.0;
  double to = 0.0;

  [[nodiscard]] double middle() const { return 0.5 * (from + to); }
};

/// A kept piece as it goes on into a stretch, from its start or backwards from its end.
struct KeptSide {
  ArcAt leg;
  double reach = 0.0;      ///< to the first sample that lies out of the band [m]
  std::size_t passed = 0;  ///< samples of the stretch before that one
};

/// A stretch in the order of one direction along it.
class Walk {
 public:
  Walk(const TrackSamples& samples, const Stretch& stretch, bool backward)
      : samples_(samples), stretch_(stretch), backward_(backward) {}

  [[nodiscard]] std::size_t count() const { return stretch_.last - stretch_.first + 1; }
  [[nodiscard]] Vec2 point(std::size_t k) const { return samples_.point[index(k)]; }
  [[nodiscard]] double length(std::size_t k) const {
    return std::fabs(samples_.s[index(k)] - samples_.s[index(0)]);
  }
  [[nodiscard]] std::size_t index(std::size_t k) const {
    return backward_ ? stretch_.last - k : stretch_.first + k;
  }
  /// The kept piece that the walk begins at.
  [[nodiscard]] const std::optional<KeptEnd>& kept() const {
    return backward_ ? stretch_.after : stretch_.before;
  }

  [[nodiscard]] KeptSide side(const Band& band) const {
    KeptSide side{turned(kept()->leg), 0.0, 0};
    const double reached = reach_of(samples_, stretch_, kept()->leg, band, backward_ ? -1 : 1);
    while (side.passed < count() && length(side.passed) <= reached) ++side.passed;
    side.reach = length(std::min(side.passed, count() - 1));
    return side;
  }
  /// A leg as it is gone along.
  [[nodiscard]] ArcAt turned(const ArcAt& leg) const {
    return backward_ ? ArcAt{leg.from, leg.heading + std::numbers::pi, -leg.curvature} : leg;
  }

 private:
  const TrackSamples& samples_;
  const Stretch& stretch_;
  bool backward_ = false;
};

/// Arcs that leave one kept piece.
class Leaving {
 public:
  Leaving(const TrackSamples& samples, const Stretch& stretch, const Band& band, bool backward)
      : walk_(samples, stretch, backward),
        kept_(walk_.side(band)),
        band_(backward ? Band{band.right, band.left} : band),
        near_(kTooNear * std::max(band.left, band.right)) {}

  /// @return how many samples some arc passes at most
  [[nodiscard]] std::size_t farthest() const {
    std::size_t sure = 0;
    const auto reached = [&](const Interval& places) {
      Curvatures left;
      return narrow(places, walk_.count(), left);
    };
    std::size_t most = 0;
    halve([&](const Interval& places, bool give_up) {
      sure = std::max(sure, reached({places.middle(), places.middle()}));
      const std::size_t bound = reached(places);
      if (give_up) most = std::max(most, bound);
      return bound > sure;
    });
    return std::max(sure, most);
  }

  /// Whether some arc may touch another kept piece, too, which passes the last samples.
  [[nodiscard]] bool may_touch(const KeptEnd& other, std::size_t others) const {
    const ArcAt leg = walk_.turned(other.leg);
    const std::size_t own = walk_.count() - std::min(walk_.count(), others);
    bool may = false;
    halve([&](const Interval& places, bool give_up) {
      if (may) return false;
      Curvatures left = touching(places, leg);
      narrow(places, own, left);
      if (left.none()) return false;
      const Interval middle{places.middle(), places.middle()};
      Curvatures there = touching(middle, leg);
      narrow(middle, own, there);
      may = give_up || !there.none();
      return !may;
    });
    return may;
  }

 private:
  /// Halves the intervals of places that are worth it.
  /// @param worth  of an interval, and whether it is not halved any more
  template <typename Worth>
  void halve(const Worth& worth) const {
    std::vector<Interval> open;
    for (int k = 0; k < kPlaces; ++k)
      open.push_back({kept_.reach * k / kPlaces, kept_.reach * (k + 1) / kPlaces});
    for (int looked = 0; !open.empty(); ++looked) {
      const Interval here = open.back();
      open.pop_back();
      const bool give_up = looked >= kMostIntervals;
      if (!worth(here, give_up) || give_up) continue;
      open.push_back({here.from, here.middle()});
      open.push_back({here.middle(), here.to});
    }
  }

  /// Of the circles that touch the kept piece at a place, those that pass a point within the band.
  [[nodiscard]] Curvatures passing(const ArcAt& from, Vec2 along, Vec2 point) const {
    const Vec2 away = point - from.from;
    const double left = cross(along, away);
    const double square = dot(away, away);
    // A point at the distance d to the left of a circle: k = 2 (left - d) / (square - d^2).
    return {2.0 * (left - band_.right) / (square - band_.right * band_.right),
            2.0 * (left + band_.left) / (square - band_.left * band_.left)};
  }

  /// What samples leave of the curvatures of arcs from an interval of places.
  /// @param end  samples that are looked at
  /// @return how many of them, from the first on, some curvature passes
  std::size_t narrow(const Interval& places, std::size_t end, Curvatures& left) const {
    const ArcAt from = kept_.leg.after(places.from);
    const ArcAt to = kept_.leg.after(places.to);
    const Vec2 from_along = direction_of(from.heading);
    const Vec2 to_along = direction_of(to.heading);
    for (std::size_t k = 0; k < end; ++k) {
      const Vec2 point = walk_.point(k);
      const Vec2 away = point - to.from;
      // Not what the kept piece passes itself.
      if (!(dot(to_along, away) > 0.0) || dot(away, away) < near_ * near_) continue;
      Curvatures here = passing(to, to_along, point);
      if (places.from < places.to) here.widen(passing(from, from_along, point));
      left.narrow(here);
      if (left.none()) return k;
    }
    return end;
  }

  /// The curvatures of arcs that touch another leg, too; all of them where that tells nothing.
  [[nodiscard]] Curvatures touching(const Interval& places, const ArcAt& other) const {
    const TouchingCurvature from = touching_curvature(kept_.leg.after(places.from), other);
    const TouchingCurvature to = touching_curvature(kept_.leg.after(places.to), other);
    if (!(from.below * to.below > 0.0)) return {};
    return {std::min(from.value(), to.value()), std::max(from.value(), to.value())};
  }

  Walk walk_;
  KeptSide kept_;
  Band band_;
  double near_ = 0.0;  // a sample tells nothing of curvatures [m]
};

/// Whether two kept pieces could be one after the other, or one could begin or end the track: circles that do not meet along the
/// stretch between them, or miss its end, need an arc in between.
/// @return true unless it is certain that they do not
bool may_meet(const TrackSamples& samples, const Stretch& stretch) {
  const double rounding = kRounding * samples.s.back();
  if (!stretch.before)
    return std::fabs(stretch.after->leg.distance(samples.point[stretch.first])) <= rounding;
  if (!stretch.after) return std::fabs(stretch.before->leg.distance(samples.point[stretch.last])) <= rounding;
  const ArcAt& from = stretch.before->leg;
  const ArcAt& to = stretch.after->leg;
  const double step = (samples.s[stretch.last] - samples.s[stretch.first]) / kMeetingSteps;
  // Between two places the distance bends by no more than both circles do.
  const double bend = std::fabs(from.curvature) + std::fabs(to.curvature);
  const double sure = 0.125 * bend * step * step + rounding;
  const double first = to.distance(from.from);
  for (int k = 0; k <= kMeetingSteps; ++k) {
    const double distance = to.distance(from.after(step * k).from);
    if (std::fabs(distance) <= sure || (distance < 0.0) != (first < 0.0)) return true;
  }
  return false;
}

}  // namespace

std::size_t farthest_from_kept(const TrackSamples& samples, const Stretch& stretch, const Band& band,
                               bool backward) {
  const std::size_t passed = Leaving(samples, stretch, band, backward).farthest();
  return Walk(samples, stretch, backward).index(passed - 1);
}

bool one_arc_may_do(const TrackSamples& samples, const Stretch& stretch, const Band& band) {
  const std::size_t others = Walk(samples, stretch, true).side(band).passed;
  return Leaving(samples, stretch, band, false).may_touch(*stretch.after, others);
}

std::size_t least_arcs(const TrackSamples& samples, const Stretch& stretch, const Band& band) {
  const TrackSamples middle = moved_left(samples, band.middle());
  const auto separate = [&](std::size_t first, std::size_t last) {
    return circle_pieces(middle, first, last, band.half_width()).count();
  };
  if (!stretch.before && !stretch.after) return separate(stretch.first, stretch.last);
  const auto passed = [&](bool backward) {
    const Walk walk(samples, stretch, backward);
    return walk.kept() ? walk.side(band).passed : 0;
  };
  const bool nothing_between = passed(false) + passed(true) > stretch.last - stretch.first;
  if (nothing_between && may_meet(samples, stretch)) return 0;
  if (stretch.before && stretch.after && one_arc_may_do(samples, stretch, band)) return 1;
  std::size_t arcs = 0;
  std::size_t first = stretch.first;
  std::size_t last = stretch.last;
  if (stretch.before) {
    first = farthest_from_kept(samples, stretch, band, false) + 1;
    ++arcs;
  }
  if (stretch.after) {
    last = farthest_from_kept(samples, stretch, band, true);
    if (last == 0) return arcs + 1;
    --last;
    ++arcs;
  }
  return arcs + (first <= last ? separate(first, last) : 0);
}

}  // namespace glissade::parts
