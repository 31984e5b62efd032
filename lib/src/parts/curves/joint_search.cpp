// The search of arc_search.hpp on the offsets of an arc from the track. To first order in them an arc of curvature k lies
// delta beside the track, delta'' = k - kappa: what it gains by its own bend over a length u, k u^2 / 2, less what the
// track does, the integral of its heading. An arc then is a parabola, and an interval of curvatures that pass a gate,
// the place where an arc arrives and the arc that touches a kept piece are each a line of arithmetic, without a root.

#include "parts/curves/joint_search.hpp"

#include "parts/curves/arc_fronts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace glissade::parts {
namespace {

/// A place of the track where arcs are held against the band.
struct Gate {
  std::size_t sample = 0;
  double s = 0.0;
  double heading = 0.0;  // of the track
  double sum = 0.0;      // integral of the heading up to here
  double unit = 0.0;     // half widths of the band a piece: what headings are counted in
  bool joint = false;    // whether arcs may meet here
};

/// Where an arc may begin.
struct State {
  double s = 0.0;
  double heading = 0.0;  // of the track there
  double sum = 0.0;
  double offset = 0.0;
  double slope = 0.0;  // heading less that of the track
  std::size_t gate = 0;
  int before = -1;
};

/// Where a kept piece lies as seen from the track.
struct Beside {
  double offset = 0.0;
  double slope = 0.0;
};

/// The last arcs of a chain.
struct Closing {
  int state = -1;
  std::size_t arcs = 0;
  std::optional<double> joint;  // arc length, where there are two
  double joint_offset = 0.0;
  double reach = 0.0;
};

class Search : private ArcFronts<Search, Gate, State, Closing> {
  friend ArcFronts;

 public:
  Search(const TrackSamples& samples, const Stretch& stretch, const Band& band, std::size_t steps)
      : samples_(samples), stretch_(stretch), band_(band) {
    sum_headings();
    place_gates(steps);
    make_room();
    start();
    arrive();
  }

  std::optional<ChainStart> run() {
    const auto closing = search();
    if (!closing) return std::nullopt;
    return found(*closing);
  }

 private:
  [[nodiscard]] double end() const { return samples_.s[stretch_.last]; }
  [[nodiscard]] double sum_at(std::size_t sample) const { return sums_[sample - stretch_.first]; }

  /// The integral of the heading, less that of the start, which nothing depends on.
  void sum_headings() {
    const double own = samples_.heading[stretch_.first];
    double sum = 0.0;
    sums_ = {0.0};
    for (std::size_t j = stretch_.first; j < stretch_.last; ++j) {
      const double mean = 0.5 * (samples_.heading[j] + samples_.heading[j + 1]) - own;
      sum += mean * (samples_.s[j + 1] - samples_.s[j]);
      sums_.push_back(sum);
    }
  }
  [[nodiscard]] double heading_at(std::size_t sample) const {
    return samples_.heading[sample] - samples_.heading[stretch_.first];
  }

  void add_gate(std::size_t sample, double piece, bool joint) {
    if (!gates_.empty() && gates_.back().sample == sample) return;
    gates_.push_back(
        {sample, samples_.s[sample], heading_at(sample), sum_at(sample), band_.half_width() / piece, joint});
  }

  /// Adds gates where the track bends so much otherwise than its piece that an arc could leave the band between two.
  void add_between(std::size_t to, double piece, double bend) {
    std::size_t from = gates_.back().sample;
    for (std::size_t j = from + 1; j < to; ++j) {
      const double length = samples_.s[j + 1] - samples_.s[from];
      const double turn = bend * length - (samples_.heading[j + 1] - samples_.heading[from]);
      if (std::fabs(turn) * length < 8.0 * kBetween * band_.half_width()) continue;
      add_gate(j, piece, false);
      from = j;
    }
  }

  /// As many gates along each piece that one circle passes.
  void place_gates(std::size_t steps) {
    const CirclePieces pieces = circle_pieces(samples_, stretch_.first, stretch_.last, band_.half_width());
    std::size_t from = stretch_.first;
    double before = 0.0;
    for (const std::size_t last : pieces.ends) {
      if (last <= from) continue;
      const double length = samples_.s[last] - samples_.s[from];
      const double bend = (samples_.heading[last] - samples_.heading[from]) / length;
      // The last one may be a remnant: its gates are no closer than those before.
      const double piece = last == stretch_.last && before > 0.0 ? std::max(length, before) : length;
      const auto wanted = static_cast<double>(steps * kGatesPerStep);
      const auto count = static_cast<std::size_t>(std::ceil(wanted * length / piece));
      const bool upright = from == stretch_.first && !stretch_.before;  // samples are denser there than even
      for (std::size_t k = 0; k < count; ++k) {
        const double share = static_cast<double>(k) / static_cast<double>(count);
        const std::size_t even = index_at(samples_, samples_.s[from] + share * length);
        const std::size_t sample = upright ? from + k * (last - from) / count : even;
        if (!gates_.empty()) add_between(sample, piece, bend);
        add_gate(sample, piece, k % kGatesPerStep == 0);
      }
      add_between(last, piece, bend);
      before = piece;
      from = last;
    }
    add_gate(stretch_.last, before, true);
  }

  [[nodiscard]] Beside beside(const ArcAt& leg, std::size_t sample, double from) const {
    const double heading = leg.heading + leg.curvature * (samples_.s[sample] - from);
    return {-leg.distance(samples_.point[sample]), wrapped(heading - samples_.heading[sample])};
  }

  [[nodiscard]] State state_at(std::size_t sample, const Beside& lies, std::size_t gate) const {
    return {samples_.s[sample], heading_at(sample), sum_at(sample), lies.offset, lies.slope, gate, -1};
  }

  /// The state of an arc that begins where a kept piece ends, or, at the track's own start, with any heading.
  void start() {
    const double begin = samples_.s[stretch_.first];
    if (stretch_.before) {
      for (const double part : places_within(stretch_.before->reach)) {
        const std::size_t sample =
            std::clamp(index_at(samples_, begin + part), stretch_.first, stretch_.last);
        std::size_t gate = 0;
        while (gate + 1 < gates_.size() && gates_[gate + 1].sample <= sample) ++gate;
        if (gate == last_gate()) continue;
        push(state_at(sample, beside(stretch_.before->leg, sample, begin), gate));
      }
      return;
    }
    for (const double off : free_headings()) {
      const double slope = off * gates_.front().unit;
      const bool leans = samples_.heading[stretch_.first] + slope < -0.5 * std::numbers::pi;
      if (leans && off != 0.0) continue;  // an upright start does not lean over
      push(state_at(stretch_.first, {0.0, slope}, 0));
    }
  }

  /// Where the kept piece after the stretch lies at each gate.
  void arrive() {
    if (!stretch_.after) return;
    for (const Gate& gate : gates_) after_.push_back(beside(stretch_.after->leg, gate.sample, end()));
    earliest_ = last_gate();
    for (const double part : places_within(stretch_.after->reach)) {
      const double place = end() - part;
      double lowest = -std::numeric_limits<double>::infinity();
      double highest = std::numeric_limits<double>::infinity();
      std::size_t gate = last_gate();
      while (gate > 0 && lowest <= highest) {
        --gate;
        const double u = place - gates_[gate].s;
        if (!(u > 0.0)) continue;
        lowest = std::max(lowest, -2.0 * (band_.right + after_[gate].offset) / (u * u));
        highest = std::min(highest, 2.0 * (band_.left - after_[gate].offset) / (u * u));
      }
      earliest_ = std::min(earliest_, gate);
    }
  }

  /// How far the track falls behind a line along a state.
  static double behind(const State& from, double s, double sum) {
    const double u = s - from.s;
    return sum - from.sum - from.heading * u - from.offset - from.slope * u;
  }

  [[nodiscard]] bool narrows(const State& from, const Gate& next, double& lowest, double& highest) const {
    const double u = next.s - from.s;
    const double per = 2.0 / (u * u);
    const double straight = behind(from, next.s, next.sum);
    highest = std::min(highest, per * (straight + band_.left));
    lowest = std::max(lowest, per * (straight - band_.right));
    return lowest <= highest;
  }

  /// @return one arc from a state to the end, if it keeps the band
  [[nodiscard]] std::optional<Closing> closed(int index, std::size_t farthest, std::size_t arcs) const {
    const State& from = state(index);
    if (!stretch_.after) {
      if (farthest + 1 < last_gate()) return std::nullopt;
      const double u = end() - from.s;
      const double curvature = 2.0 * behind(from, end(), gates_.back().sum) / (u * u);
      if (!(u > 0.0) || !passes(from, curvature, last_gate() - 1)) return std::nullopt;
      return Closing{index, arcs + 1, {}, 0.0, 0.0};
    }
    const double reach = stretch_.after->reach;
    if (gates_[std::min(farthest + 1, last_gate())].s < end() - reach) return std::nullopt;
    // Off the kept piece by a + b u + c u^2 / 2, which has a double zero.
    const auto [a, b] = off_kept(from);
    const double u = -2.0 * a / b;
    if (!(u > 0.0) || from.s + u > end() || from.s + u < end() - reach) return std::nullopt;
    const std::size_t gate = gate_before(from.s + u, from.gate);
    if (gate > farthest || !passes(from, stretch_.after->leg.curvature + b * b / (2.0 * a), gate))
      return std::nullopt;
    return Closing{index, arcs + 1, {}, 0.0, end() - from.s - u};
  }

  /// How far a state lies off the kept piece after the stretch, and at which slope.
  [[nodiscard]] Beside off_kept(const State& from) const {
    const Beside& kept = after_[from.gate];
    // A first state may stand between two gates.
    const Gate& gate = gates_[from.gate];
    const double u = from.s - gate.s;
    const double track = from.sum - gate.sum - gate.heading * u;
    const double bend = stretch_.after->leg.curvature * u;
    const double offset = kept.offset + kept.slope * u + 0.5 * bend * u - track;
    return {from.offset - offset, from.slope - (kept.slope + bend - (from.heading - gate.heading))};
  }

  /// Two arcs from a state to the kept piece after the stretch, if none are known.
  void close_in_two(int index, std::size_t farthest, std::size_t arcs) {
    if (!stretch_.after || in_two_.state >= 0 || farthest < earliest_) return;
    const State& from = state(index);
    const auto [a, b] = off_kept(from);
    for (const double part : places_within(stretch_.after->reach)) {
      const double whole = end() - part - from.s;
      if (!(whole > 0.0)) continue;
      for (std::size_t k = 1; k < kBiarcs; ++k) {
        const double share = static_cast<double>(k) / static_cast<double>(kBiarcs);
        const double u = share * whole;
        const double first =
            -(2.0 * a + b * whole * (1.0 + share)) / (u * whole);  // curvature off the kept one
        const std::size_t gate = gate_before(from.s + u, from.gate);
        if (gate > farthest || !passes(from, stretch_.after->leg.curvature + first, gate)) continue;
        const double second = -(b + first * u) / (whole - u);
        if (!keeps_back(end() - part, second, gate)) continue;
        in_two_ = {index, arcs + 2, from.s + u, offset_after(from, stretch_.after->leg.curvature + first, u),
                   part};
        return;
      }
    }
  }

  /// The offset of an arc a length beyond its state.
  [[nodiscard]] double offset_after(const State& from, double curvature, double u) const {
    const double s = from.s + u;
    const std::size_t gate = gate_before(s, from.gate);
    const Gate& near = gates_[gate];
    const Gate& next = gates_[std::min(gate + 1, last_gate())];
    const double share = next.s > near.s ? (s - near.s) / (next.s - near.s) : 0.0;
    // The heading between two gates as if it turned evenly.
    const double v = s - near.s;
    const double sum = near.sum + near.heading * v + 0.5 * share * (next.heading - near.heading) * v;
    return 0.5 * curvature * u * u - behind(from, s, sum);
  }

  /// Whether an arc that ends on the kept piece at a place keeps the band back to a gate.
  /// @param more  its curvature less that of the kept piece
  [[nodiscard]] bool keeps_back(double place, double more, std::size_t gate) const {
    for (++gate; gate < last_gate() && gates_[gate].s < place; ++gate) {
      const double u = place - gates_[gate].s;
      const double offset = after_[gate].offset + 0.5 * more * u * u;
      if (offset > band_.left || offset < -band_.right) return false;
    }
    return true;
  }

  /// The states in which arcs from one stand at a gate.
  [[nodiscard]] auto onto(const State& from, std::size_t gate) const {
    const Gate& to = gates_[gate];
    const double u = to.s - from.s;
    const double straight = behind(from, to.s, to.sum);
    return [&from, &to, u, straight](double curvature) -> std::optional<State> {
      return State{to.s,
                   to.heading,
                   to.sum,
                   0.5 * curvature * u * u - straight,
                   from.slope + curvature * u - (to.heading - from.heading),
                   0,
                   -1};
    };
  }

  [[nodiscard]] CellPlace place_of(const State& state) const {
    const double across = (state.offset + band_.right) / (2.0 * band_.half_width());
    return {static_cast<double>(kOffsets) * across, state.slope / (kHeadings * gates_[state.gate].unit)};
  }

  /// The joints of the chain that a closing ends.
  [[nodiscard]] ChainStart found(const Closing& closing) const {
    const std::vector<int> chain = chain_to(closing.state);
    ChainStart joints;
    for (const int index : chain) {
      joints.knots.push_back(state(index).s);
      joints.offsets.push_back(state(index).offset);
    }
    if (closing.joint) {
      joints.knots.push_back(*closing.joint);
      joints.offsets.push_back(closing.joint_offset);
    }
    joints.knots.push_back(end() - closing.reach);
    joints.offsets.push_back(0.0);
    joints.heading = samples_.heading[stretch_.first] + state(chain.front()).slope;
    return joints;
  }

  const TrackSamples& samples_;
  const Stretch& stretch_;
  Band band_;
  std::vector<double> sums_;   // of the heading, one a sample of the stretch
  std::vector<Beside> after_;  // the kept piece after the stretch, one a gate
};

}  // namespace

std::optional<ChainStart> search_joints(const TrackSamples& samples, const Stretch& stretch, const Band& band,
                                        std::size_t steps) {
  return Search(samples, stretch, band, steps).run();
}

}  // namespace glissade::parts
