#include "drawing/balloons.hpp"

#include <algorithm>
#include <utility>

namespace glissade::drawing {
namespace {

constexpr std::size_t kFree = static_cast<std::size_t>(-1);
// An exchange has to win more than rounding does, or two could go on for ever.
constexpr double kLeastGain = 1e-9;
// In radii of a name: what a line may be longer for not crossing another, and for not running through a name.
constexpr double kCrossing = 60.0;
constexpr double kThrough = 40.0;

/// Names at their slots.
class Seating {
 public:
  Seating(const std::vector<Named>& names, const std::vector<Vec2>& slots, double radius,
          const std::vector<Vec2>& others)
      : slots_(slots), radius_(radius), others_(others), name_at_(slots.size(), kFree) {
    for (std::size_t i = 0; i < names.size(); ++i) {
      std::vector<Vec2> targets;
      targets.reserve(slots.size());
      for (const Vec2 slot : slots) targets.push_back(nearest(names[i], slot));
      targets_.push_back(std::move(targets));
      slot_of_.push_back(i);
      name_at_[i] = i;
    }
  }

  /// Moves names, one or two at a time, until no move makes it better.
  /// @param clear  whether crossings and lines through names count, or lengths alone
  void settle(bool clear) {
    clear_ = clear;
    for (bool better = true; better;) {
      better = false;
      for (std::size_t i = 0; i < slot_of_.size(); ++i) {
        for (std::size_t k = 0; k < slots_.size(); ++k) better = moved(i, k) || better;
      }
    }
  }

  [[nodiscard]] Label label(std::size_t name) const {
    return {slot_of_[name], targets_[name][slot_of_[name]]};
  }

 private:
  static Vec2 nearest(const Named& name, Vec2 slot) {
    return *std::min_element(name.pieces.begin(), name.pieces.end(),
                             [&](Vec2 a, Vec2 b) { return norm(a - slot) < norm(b - slot); });
  }

  /// Moves a name to a slot; whoever stands there goes where the name was, if both together are the better for it.
  bool moved(std::size_t name, std::size_t slot) {
    const std::size_t from = slot_of_[name];
    const std::size_t other = name_at_[slot];
    if (slot == from) return false;
    const double before = cost(name, other);
    exchange(name, from, slot, other);
    if (cost(name, other) < before - kLeastGain) return true;
    exchange(name, slot, from, other);
    return false;
  }

  void exchange(std::size_t name, std::size_t from, std::size_t to, std::size_t other) {
    name_at_[from] = other;
    name_at_[to] = name;
    slot_of_[name] = to;
    if (other != kFree) slot_of_[other] = from;
  }

  /// Of one or two names: their lines' lengths, and what they cost with all others.
  [[nodiscard]] double cost(std::size_t first, std::size_t second) const {
    double sum = length(first) + (second == kFree ? 0.0 : length(second));
    if (!clear_) return sum;
    sum += through_others(first) + (second == kFree ? 0.0 : through_others(second));
    if (second != kFree) sum += between(first, second);
    for (std::size_t i = 0; i < slot_of_.size(); ++i) {
      if (i == first || i == second) continue;
      sum += between(first, i);
      if (second != kFree) sum += between(second, i);
    }
    return sum;
  }

  [[nodiscard]] double length(std::size_t name) const {
    const Label at = label(name);
    return norm(at.target - slots_[at.slot]);
  }

  [[nodiscard]] double through_others(std::size_t name) const {
    const Label at = label(name);
    double sum = 0.0;
    for (const Vec2 other : others_) {
      if (line_passes(slots_[at.slot], at.target, other, radius_)) sum += kThrough * radius_;
    }
    return sum;
  }

  [[nodiscard]] double between(std::size_t one, std::size_t other) const {
    const Label a = label(one);
    const Label b = label(other);
    const Vec2 from = slots_[a.slot];
    const Vec2 from_other = slots_[b.slot];
    double sum = 0.0;
    if (lines_cross(from, a.target, from_other, b.target)) sum += kCrossing * radius_;
    if (line_passes(from, a.target, from_other, radius_)) sum += kThrough * radius_;
    if (line_passes(from_other, b.target, from, radius_)) sum += kThrough * radius_;
    return sum;
  }

  const std::vector<Vec2>& slots_;
  double radius_;
  const std::vector<Vec2>& others_;
  bool clear_ = false;
  std::vector<std::vector<Vec2>> targets_;  ///< by name and slot
  std::vector<std::size_t> slot_of_;        ///< by name
  std::vector<std::size_t> name_at_;        ///< by slot; kFree
};

}  // namespace

bool lines_cross(Vec2 from, Vec2 to, Vec2 other_from, Vec2 other_to) {
  const auto side = [](Vec2 a, Vec2 b, Vec2 point) { return cross(b - a, point - a); };
  return side(from, to, other_from) * side(from, to, other_to) < 0.0 &&
         side(other_from, other_to, from) * side(other_from, other_to, to) < 0.0;
}

bool line_passes(Vec2 from, Vec2 to, Vec2 point, double within) {
  const Vec2 along = to - from;
  const double square = dot(along, along);
  const double share = square > 0.0 ? std::clamp(dot(point - from, along) / square, 0.0, 1.0) : 0.0;
  return norm(from + share * along - point) < within;
}

std::vector<Label> labelled(const std::vector<Named>& names, const std::vector<Vec2>& slots, double radius,
                            const std::vector<Vec2>& others) {
  Seating seating(names, slots, radius, others);
  seating.settle(false);
  seating.settle(true);
  std::vector<Label> labels;
  for (std::size_t i = 0; i < names.size(); ++i) labels.push_back(seating.label(i));
  return labels;
}

}  // namespace glissade::drawing
