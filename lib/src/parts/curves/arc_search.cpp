// Gates stand across the track, as wide as the band. An arc that leaves a place with a heading is one of the circles
// that touch there, and those are nested: the ones that pass a gate have curvatures between the two that meet its posts.
// So what lies ahead of a state, place and heading, is an interval of curvatures that shrinks from gate to gate, and a few of
// them give the states in which the next arc may begin. All states that n arcs reach come before those of n + 1; of
// states alike in place, offset and heading the first is kept, with its true values, so that nothing is rounded.

#include "parts/curves/arc_search.hpp"

#include "glissade/core/math.hpp"

#include "parts/curves/arc_fronts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace glissade::parts {
namespace {

constexpr int kMostHalvings = 6;  // of what lies between two gates

/// A line across the band.
struct Gate {
  double s = 0.0;
  Vec2 point;
  Vec2 along;
  Vec2 left, right;      // posts
  double heading = 0.0;  // half widths of the band a piece: what headings are counted in
  bool joint = false;    // whether arcs may meet here
};

/// Where an arc may begin.
struct State {
  Vec2 at;
  Vec2 along;
  std::size_t gate = 0;  // the last one that it has passed, or stands on
  int before = -1;       // the state in which the arc to here begins
};

/// How a kept piece may be met: where, with which heading.
struct Arrival {
  ArcAt leg;
  Vec2 along;
  double reach = 0.0;
};

/// The last arcs of a chain.
struct Closing {
  int state = -1;
  std::size_t arcs = 0;
  std::vector<Vec2> to;
  double reach = 0.0;
};

/// The curvature of the circle that leaves a state and meets a point.
double curvature_to(const State& state, Vec2 point) {
  const Vec2 away = point - state.at;
  return 2.0 * cross(state.along, away) / dot(away, away);
}

/// The state of an arc beside a point: its distance is that of distance_from().
State foot(const State& state, double curvature, Vec2 point) {
  const Vec2 away = point - state.at;
  const double u = dot(state.along, away);
  const double v = cross(state.along, away);
  const double left = 1.0 - curvature * v;
  const double back = curvature * u;
  const double grade = std::sqrt(back * back + left * left);
  const double distance = 2.0 * (v - 0.5 * curvature * (u * u + v * v)) / (1.0 + grade);
  const double unit = 1.0 / grade;
  const Vec2 normal = (unit * left) * left_of(state.along) - (unit * back) * state.along;
  return {point - distance * normal, {normal.y, -normal.x}, 0, -1};
}

double heading_of(Vec2 along) {
  return math::atan2(along.y, along.x);
}

class Search : private ArcFronts<Search, Gate, State, Closing> {
  friend ArcFronts;

 public:
  Search(const Centerline& track, const TrackSamples& samples, const Stretch& stretch, const Band& band,
         std::size_t steps)
      : track_(track), samples_(samples), stretch_(stretch), band_(band) {
    place_gates(steps);
    make_room();
    start();
    arrive();
  }

  std::optional<FoundChain> run() {
    const auto closing = search();
    if (!closing) return std::nullopt;
    return found(*closing);
  }

 private:
  [[nodiscard]] double end() const { return samples_.s[stretch_.last]; }

  void add_gate(double s, double piece, bool joint) {
    const CenterlinePoint at = track_.at(std::min(s, track_.length()));
    const Vec2 point = s > 0.0 ? Vec2{at.x, -at.drop} : Vec2{};
    const Vec2 along = direction_of(-at.slope_angle);
    gates_.push_back({s, point, along, point + band_.left * left_of(along),
                      point - band_.right * left_of(along), band_.half_width() / piece, joint});
  }

  [[nodiscard]] double mean_curvature(double from, double to) const {
    double turned = track_.at(from).slope_angle - track_.at(std::min(to, track_.length())).slope_angle;
    return turned / (to - from);
  }

  /// Adds gates where the track bends so much otherwise than its piece that an arc could leave the band between two.
  void add_between(double from, double to, double piece, double bend, int halvings) {
    const double middle = 0.5 * (from + to);
    const double turn = bend * (to - from) - wrapped(track_.at(from).slope_angle - track_.at(to).slope_angle);
    if (halvings == 0 || std::fabs(turn) * (to - from) < 8.0 * kBetween * band_.half_width()) return;
    add_between(from, middle, piece, bend, halvings - 1);
    add_gate(middle, piece, false);
    add_between(middle, to, piece, bend, halvings - 1);
  }

  /// As many gates along each piece that one circle passes.
  void place_gates(std::size_t steps) {
    const CirclePieces pieces = circle_pieces(samples_, stretch_.first, stretch_.last, band_.half_width());
    const double begin = samples_.s[stretch_.first];
    double from = begin;
    double before = 0.0;
    for (const std::size_t last : pieces.ends) {
      const double to = samples_.s[last];
      if (!(to > from)) continue;
      // The last one may be a remnant: its gates are no closer than those before.
      const double piece = last == stretch_.last && before > 0.0 ? std::max(to - from, before) : to - from;
      const auto wanted = static_cast<double>(steps * kGatesPerStep);
      const auto count = static_cast<std::size_t>(std::ceil(wanted * (to - from) / piece));
      const bool unbounded = from == 0.0 && track_.unbounded_curvature_at_start();
      const double bend = mean_curvature(from, to);
      for (std::size_t k = 0; k < count; ++k) {
        const double share = static_cast<double>(k) / static_cast<double>(count);
        const double s = from + (unbounded ? share * share : share) * (to - from);
        if (!gates_.empty()) add_between(gates_.back().s, s, piece, bend, kMostHalvings);
        add_gate(s, piece, k % kGatesPerStep == 0);
      }
      before = piece;
      from = to;
    }
    add_gate(end(), before, true);
  }

  /// The state of an arc that begins where a kept piece ends, or, at the track's own start, with any heading.
  void start() {
    const double begin = samples_.s[stretch_.first];
    if (stretch_.before) {
      for (const double part : places_within(stretch_.before->reach)) {
        const ArcAt leg = stretch_.before->leg.after(part);
        std::size_t gate = 0;
        while (gate + 1 < gates_.size() && gates_[gate + 1].s <= begin + part) ++gate;
        if (gate == last_gate()) continue;
        push({leg.from, direction_of(leg.heading), gate, -1});
        reached_.push_back(part);
      }
      return;
    }
    const Gate& first = gates_.front();
    for (const double off : free_headings()) {
      const Vec2 along = first.along + off * first.heading * left_of(first.along);
      if (along.x < 0.0 && off != 0.0) continue;  // an upright start does not lean over
      push({first.point, (1.0 / norm(along)) * along, 0, -1});
    }
  }

  /// Where the kept piece after the stretch may be met, and the first gate from which one arc gets there.
  void arrive() {
    earliest_ = last_gate();
    if (!stretch_.after) return;
    for (const double part : places_within(stretch_.after->reach)) {
      const ArcAt leg = stretch_.after->leg.after(-part);
      arrivals_.push_back({leg, direction_of(leg.heading), part});
      const State back{leg.from, -1.0 * arrivals_.back().along, 0, -1};
      double lowest = -std::numeric_limits<double>::infinity();
      double highest = std::numeric_limits<double>::infinity();
      std::size_t gate = last_gate();
      while (gate > 0 && lowest <= highest) {
        --gate;
        if (gates_[gate].s >= end() - part) continue;
        if (!narrows(back, gates_[gate].right, gates_[gate].left, lowest, highest)) break;
      }
      earliest_ = std::min(earliest_, gate);
    }
  }

  static bool narrows(const State& from, const Gate& next, double& lowest, double& highest) {
    return narrows(from, next.left, next.right, lowest, highest);
  }
  /// Leaves the curvatures that pass between two posts; false where none does or the posts are not ahead.
  static bool narrows(const State& state, Vec2 left, Vec2 right, double& lowest, double& highest) {
    if (!(dot(state.along, left - state.at) > 0.0) || !(dot(state.along, right - state.at) > 0.0))
      return false;
    highest = std::min(highest, curvature_to(state, left));
    lowest = std::max(lowest, curvature_to(state, right));
    return lowest <= highest;
  }

  /// @return one arc from a state to the end, if it keeps the band
  [[nodiscard]] std::optional<Closing> closed(int index, std::size_t farthest, std::size_t arcs) const {
    const State& from = state(index);
    if (!stretch_.after) {
      if (farthest + 1 < last_gate()) return std::nullopt;
      const Vec2 to = gates_.back().point;
      if (!(dot(from.along, to - from.at) > 0.0)) return std::nullopt;
      if (!passes(from, curvature_to(from, to), last_gate() - 1)) return std::nullopt;
      return Closing{index, arcs + 1, {to}, 0.0};
    }
    const double reach = stretch_.after->reach;
    if (gates_[std::min(farthest + 1, last_gate())].s < end() - reach) return std::nullopt;
    const auto arc = touching({from.at, heading_of(from.along), 0.0}, stretch_.after->leg);
    if (!arc || arc->beyond > 0.0 || arc->beyond < -reach) return std::nullopt;
    const std::size_t gate = gate_before(end() + arc->beyond, from.gate);
    if (gate > farthest || !passes(from, arc->leg.curvature, gate)) return std::nullopt;
    return Closing{index, arcs + 1, {arc->leg.after(arc->length).from}, -arc->beyond};
  }

  /// Two arcs from a state to the kept piece after the stretch, if none are known.
  void close_in_two(int index, std::size_t farthest, std::size_t arcs) {
    if (!stretch_.after || in_two_.state >= 0 || farthest < earliest_) return;
    const State& from = state(index);
    for (const Arrival& arrival : arrivals_) {
      for (std::size_t k = 1; k < kBiarcs; ++k) {
        const double share = static_cast<double>(k) / static_cast<double>(kBiarcs);
        const Vec2 joint =
            biarc_joint(from.at, heading_of(from.along), arrival.leg.from, arrival.leg.heading, share);
        if (!keeps(from, joint, farthest, arrival)) continue;
        in_two_ = {index, arcs + 2, {joint, arrival.leg.from}, arrival.reach};
        return;
      }
    }
  }

  [[nodiscard]] bool keeps(const State& from, Vec2 joint, std::size_t farthest,
                           const Arrival& arrival) const {
    if (!(dot(from.along, joint - from.at) > 0.0)) return false;
    std::size_t gate = from.gate;
    while (gate < last_gate() && dot(gates_[gate + 1].along, gates_[gate + 1].point - joint) < 0.0) ++gate;
    const double curvature = curvature_to(from, joint);
    if (gate > farthest || !passes(from, curvature, gate)) return false;
    const State second = foot(from, curvature, joint);
    if (!(dot(second.along, arrival.leg.from - joint) > 0.0)) return false;
    const double onwards = curvature_to(second, arrival.leg.from);
    for (++gate; gate < last_gate() && gates_[gate].s < end() - arrival.reach; ++gate) {
      if (onwards > curvature_to(second, gates_[gate].left)) return false;
      if (onwards < curvature_to(second, gates_[gate].right)) return false;
    }
    return true;
  }

  /// The states in which arcs from one stand beside the middle of a gate.
  [[nodiscard]] auto onto(const State& from, std::size_t gate) const {
    return [&from, &to = gates_[gate]](double curvature) -> std::optional<State> {
      const State reached = foot(from, curvature, to.point);
      if (!(dot(reached.along, to.along) > 0.0)) return std::nullopt;
      return reached;
    };
  }

  [[nodiscard]] CellPlace place_of(const State& state) const {
    const Gate& gate = gates_[state.gate];
    const double offset = dot(state.at - gate.point, left_of(gate.along)) + band_.right;
    return {static_cast<double>(kOffsets) * offset / (2.0 * band_.half_width()),
            cross(gate.along, state.along) / (kHeadings * gate.heading)};
  }

  /// The chain that a closing ends.
  [[nodiscard]] FoundChain found(const Closing& closing) const {
    const std::vector<int> states = chain_to(closing.state);
    FoundChain found;
    found.arcs = closing.arcs;
    const State& first = state(states.front());
    std::vector<Vec2> joints;
    joints.reserve(states.size() + closing.to.size());
    for (const int index : states) joints.push_back(state(index).at);
    joints.insert(joints.end(), closing.to.begin(), closing.to.end());
    double heading = heading_of(first.along);
    found.joints.heading = heading;
    std::vector<ArcAt> legs;
    for (std::size_t i = 0; i < joints.size(); ++i) {
      double half = 0.0;
      if (i + 1 < joints.size()) {
        const Vec2 chord = joints[i + 1] - joints[i];
        half = wrapped(heading_of(chord) - heading);
        legs.push_back({joints[i], heading, 2.0 * math::sin(half) / norm(chord)});
      }
      found.chain.vertices.push_back({joints[i], math::tan(0.5 * half)});
      heading += 2.0 * half;
      note_joint(found.joints, joints[i]);
    }
    if (stretch_.before) found.chain.first_reach = reached_[static_cast<std::size_t>(states.front())];
    found.chain.last_reach = closing.reach;
    found.joints.knots.front() = samples_.s[stretch_.first] + found.chain.first_reach;
    found.joints.knots.back() = end() - closing.reach;
    found.chain.deviation = deviation(legs, found.joints.knots);
    return found;
  }

  /// The greatest distance of a sample's arc from the middle of the band.
  [[nodiscard]] double deviation(const std::vector<ArcAt>& legs, const std::vector<double>& knots) const {
    const double middle = 0.5 * (band_.left - band_.right);
    double most = 0.0;
    std::size_t leg = 0;
    for (std::size_t j = stretch_.first + 1; j < stretch_.last; ++j) {
      const double s = samples_.s[j];
      if (s < knots.front() || s > knots.back()) continue;
      while (leg + 1 < legs.size() && s >= knots[leg + 1]) ++leg;
      most = std::max(most, std::fabs(-legs[leg].distance(samples_.point[j]) - middle));
    }
    return most;
  }

  /// Adds a joint as seen from the track.
  void note_joint(ChainStart& joints, Vec2 at) const {
    std::size_t near = 0;
    for (std::size_t i = 1; i < gates_.size(); ++i) {
      if (norm(gates_[i].point - at) < norm(gates_[near].point - at)) near = i;
    }
    const Gate& gate = gates_[near];
    joints.knots.push_back(gate.s + dot(at - gate.point, gate.along));
    joints.offsets.push_back(dot(at - gate.point, left_of(gate.along)));
  }

  const Centerline& track_;
  const TrackSamples& samples_;
  const Stretch& stretch_;
  Band band_;
  std::vector<double> reached_;  // by the kept piece before, one a first state [m]
  std::vector<Arrival> arrivals_;
};

}  // namespace

std::optional<FoundChain> search_chain(const Centerline& track, const TrackSamples& samples,
                                       const Stretch& stretch, const Band& band, std::size_t steps) {
  return Search(track, samples, stretch, band, steps).run();
}

}  // namespace glissade::parts
