#pragma once

#include "parts/curves/arc_search.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace glissade::parts {

/// Places along what a kept piece may reach [m], the farthest first; 0 alone where it reaches nowhere.
[[nodiscard]] inline std::vector<double> places_within(double reach) {
  if (!(reach > 0.0)) return {0.0};
  std::vector<double> places;
  for (std::size_t i = 0; i <= kReaches; ++i)
    places.push_back(reach * static_cast<double>(kReaches - i) / static_cast<double>(kReaches));
  return places;
}

/// Headings of a free start off that of the track [half widths of the band a piece], ascending; 0 among them.
[[nodiscard]] inline std::vector<double> free_headings() {
  std::vector<double> headings;
  for (std::size_t i = 0; i < kFreeHeadings; ++i)
    headings.push_back((2.0 * static_cast<double>(i) / static_cast<double>(kFreeHeadings - 1) - 1.0) *
                       kSteepest);
  return headings;
}

/// Where a state lies among those that count as one.
struct CellPlace {
  double offset = 0.0;   ///< of kOffsets across the band
  double heading = 0.0;  ///< of kMostHeadings, from the track's
};

/// The search that search_chain() and search_joints() share: fronts of states that n arcs reach, each before that of n + 1.
/// What an arc is, exactly or to first order, is its own affair:
///   bool narrows(const State& from, const Gate& next, double& lowest, double& highest) const
///     leaves the curvatures that pass a gate; false where none does
///   std::optional<Closing> closed(int index, std::size_t farthest, std::size_t arcs) const
///     one arc from a state to the end
///   void close_in_two(int index, std::size_t farthest, std::size_t arcs)
///     two of them, into in_two_
///   auto onto(const State& from, std::size_t gate) const
///     of a curvature: the state in which its arc stands at the gate, or none
///   CellPlace place_of(const State& state) const
/// @tparam Gate     has `s`, and `joint`: whether arcs may meet there
/// @tparam State    has `gate`, the last one that it has passed, and `before`, the state in which the arc to it begins
/// @tparam Closing  has `state` and `arcs`
template <typename Own, typename Gate, typename State, typename Closing>
class ArcFronts {
 protected:
  /// Once all gates stand.
  void make_room() {
    lowest_.resize(gates_.size());
    highest_.resize(gates_.size());
    seen_.assign(gates_.size() * kOffsets * kMostHeadings, 0);
  }

  /// @return the last arcs of a chain of few; none where no front reaches the end
  [[nodiscard]] std::optional<Closing> search() {
    for (std::size_t arcs = 0; !front_.empty(); ++arcs) {
      if (in_two_.state >= 0 && in_two_.arcs == arcs) return in_two_;
      std::size_t foremost = 0;
      if (arcs > 0) {
        for (const int index : front_) foremost = std::max(foremost, state(index).gate);
      }
      next_.clear();
      for (const int index : front_) {
        const std::size_t farthest = look_ahead(state(index));
        if (auto closing = own().closed(index, farthest, arcs)) return closing;
        own().close_in_two(index, farthest, arcs);
        spread(index, farthest, foremost);
      }
      std::swap(front_, next_);
    }
    if (in_two_.state >= 0) return in_two_;
    return std::nullopt;
  }

  [[nodiscard]] const State& state(int index) const { return states_[static_cast<std::size_t>(index)]; }
  [[nodiscard]] std::size_t last_gate() const { return gates_.size() - 1; }

  /// Adds a state to begin with.
  void push(const State& state) {
    states_.push_back(state);
    front_.push_back(static_cast<int>(states_.size()) - 1);
  }

  /// Whether an arc keeps the band from its state up to a gate.
  [[nodiscard]] bool passes(const State& from, double curvature, std::size_t gate) const {
    return gate <= from.gate || (curvature >= lowest_[gate] && curvature <= highest_[gate]);
  }

  /// The last gate before a place on the track.
  [[nodiscard]] std::size_t gate_before(double s, std::size_t from) const {
    std::size_t gate = from;
    while (gate < last_gate() && gates_[gate + 1].s < s) ++gate;
    return gate;
  }

  /// @return the states of the chain up to one, in their order
  [[nodiscard]] std::vector<int> chain_to(int index) const {
    std::vector<int> chain;
    for (; index >= 0; index = state(index).before) chain.push_back(index);
    std::reverse(chain.begin(), chain.end());
    return chain;
  }

  std::vector<Gate> gates_;
  std::size_t earliest_ = 0;  // gate from which one arc gets to the kept piece after the stretch
  Closing in_two_;

 private:
  [[nodiscard]] Own& own() { return static_cast<Own&>(*this); }

  /// @return the last gate that some arc passes
  std::size_t look_ahead(const State& from) {
    double lowest = -std::numeric_limits<double>::infinity();
    double highest = std::numeric_limits<double>::infinity();
    std::size_t gate = from.gate;
    while (gate < last_gate() && own().narrows(from, gates_[gate + 1], lowest, highest)) {
      ++gate;
      lowest_[gate] = lowest;
      highest_[gate] = highest;
    }
    return gate;
  }

  /// The states that arcs from one reach beyond the front.
  void spread(int index, std::size_t farthest, std::size_t foremost) {
    const State from = state(index);
    const std::size_t back = kStepsBack * kGatesPerStep;
    const std::size_t first = foremost > back ? foremost - back + 1 : 1;
    for (std::size_t gate = std::max(first, from.gate + 1); gate <= std::min(farthest, last_gate() - 1);
         ++gate) {
      if (!gates_[gate].joint) continue;
      const double low = lowest_[gate] + kInside * (highest_[gate] - lowest_[gate]);
      const double wide = (1.0 - 2.0 * kInside) * (highest_[gate] - lowest_[gate]);
      const auto onto = own().onto(from, gate);
      for (std::size_t i = 0; i < kCurvatures; ++i) {
        const double share = static_cast<double>(i) / static_cast<double>(kCurvatures - 1);
        std::optional<State> reached = onto(low + share * wide);
        if (!reached) continue;
        reached->gate = gate;
        reached->before = index;
        std::uint8_t& seen = seen_[cell_of(*reached)];
        if (seen != 0) continue;
        seen = 1;
        states_.push_back(*reached);
        next_.push_back(static_cast<int>(states_.size()) - 1);
      }
    }
  }

  /// Number of the states that are alike.
  [[nodiscard]] std::size_t cell_of(const State& state) {
    const auto within = [](double value, std::size_t count) {
      return static_cast<std::size_t>(std::clamp(value, 0.0, static_cast<double>(count) - 1.0));
    };
    const CellPlace place = own().place_of(state);
    const std::size_t i = within(place.offset, kOffsets);
    const std::size_t j =
        within(std::floor(place.heading) + 0.5 * static_cast<double>(kMostHeadings), kMostHeadings);
    return (state.gate * kOffsets + i) * kMostHeadings + j;
  }

  std::vector<State> states_;
  std::vector<int> front_, next_;         // states of as many arcs, and of one more
  std::vector<double> lowest_, highest_;  // curvatures that pass all gates from the present state on
  std::vector<std::uint8_t> seen_;
};

}  // namespace glissade::parts
