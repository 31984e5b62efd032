#include "optimize/mesh/switches.hpp"

#include "optimize/mesh/jump_fit.hpp"
#include "optimize/mesh/short_wraps.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace glissade::optimizer {
namespace {

// Where the core joins a straight that is given, the place is known. The ramp of a jump there lies to one side of it, and costs
// as much as its width: with 1e-4 five of a hundred drawn times are 1e-6 to 1e-5 longer.
constexpr double kJoint = 1e-6;  // measured
// Two pieces turn a corner, too, which is the best where no radius is asked for.
constexpr std::size_t kJointPieces = 2;  // theory
// A jump is seen from the track this many pieces before and behind it.
constexpr double kWindow = 4.0;  // taste
// And counts as one if it is this large a share of the curvature there.
constexpr double kJump = 0.1;  // taste

/// By how much a limit may be left alone between two places where it binds: a linear curvature cannot follow
/// that of a load.
double slack_within(const Measure& measure) {
  constexpr double kOfLoad = 0.1;  // taste
  constexpr double kElse = 1e-5;   // accuracy: a hundred times that of a limit
  return measure.is_load() ? kOfLoad : kElse;
}

/// Places where a limit that carries a price begins or ceases to bind, counted in pieces.
std::vector<double> ends_of_binding(const ScaledProblem& problem, const Found& found) {
  constexpr double kEnd = 1e-6;  // accuracy: ten times that of a limit
  const Mesh& mesh = found.track->mesh();
  std::vector<double> price(problem.limits.size(), 0.0);
  for (std::size_t k = 0; k < found.active.size(); ++k) price[found.active[k].limit] += found.inequality[k];
  const std::vector<std::vector<Span>> bindings = bindings_of(problem, found);
  std::vector<double> ends;
  for (std::size_t i = 0; i < bindings.size(); ++i) {
    if (price[i] <= 0.0 || !problem.limits[i].measure->holds_along()) continue;
    // A load that a linear curvature misses next to an end of the core is held up to there all the same: a body
    // that flies off with little speed bends more in the first pieces than they can follow.
    constexpr double kJoined = 3.0;  // taste
    const double last = static_cast<double>(mesh.knots.size() - 1);
    const bool load = problem.limits[i].measure->is_load();
    for (const Span& span : bindings[i]) {
      for (const double place : {span.from, span.to}) {
        const double at = count_pieces(mesh.knots, found.track->sigma_at(found.z, place));
        const bool joins_start = load && place == span.from && at < kJoined && mesh.lead_in == 0.0;
        const bool joins_finish = load && place == span.to && at > last - kJoined && mesh.lead_out == 0.0;
        if (at > kEnd && at < last - kEnd && !joins_start && !joins_finish) ends.push_back(at);
      }
    }
  }
  return ends;
}

/// Finds the jumps of one track.
class JumpFinder {
 public:
  JumpFinder(const ScaledProblem& problem, const Found& found)
      : found_(found),
        knots_(found.track->mesh().knots),
        pieces_(knots_.size() - 1),
        slope_angle_(found),
        ends_(ends_of_binding(problem, found)),
        wide_(knots_.size(), 0.0) {
    for (std::size_t i = 0; i < pieces_; ++i) {
      wide_[i + 1] = wide_[i] + (is_narrow(i) ? 0.0 : 1.0);
    }
  }

  [[nodiscard]] std::vector<Switch> switches() const {
    const Mesh& mesh = found_.track->mesh();
    const std::vector<std::size_t> ramps = this->ramps();
    const std::size_t first = mesh.lead_in > 0.0 ? pieces_of_joint(0) : 0;
    const std::size_t last = mesh.lead_out > 0.0 ? pieces_ - pieces_of_joint(pieces_ - 1) : pieces_;
    std::vector<Switch> result;
    if (first > 0 && turns(0))
      result.push_back({{0.0, knots_[first]}, Span{0.0, kJointPieces * kJoint}, kJointPieces});
    for (std::size_t k = 0; k < ramps.size(); ++k) {
      if (ramps[k] < first || ramps[k] >= last) continue;
      const auto [free_from, free_to] = between_changes(ramps[k], first, last);
      const std::size_t begin = k == 0 ? free_from : std::max(free_from, ramps[k - 1] + 1);
      const std::size_t end = k + 1 == ramps.size() ? free_to : std::min(free_to, ramps[k + 1]);
      if (const std::optional<Switch> seen = seen_from(ramps[k], begin, end)) result.push_back(*seen);
    }
    if (last < pieces_ && turns(pieces_ - 1))
      result.push_back({{knots_[last], 1.0}, Span{1.0 - kJointPieces * kJoint, 1.0}, kJointPieces});
    return result;
  }

 private:
  [[nodiscard]] bool is_narrow(std::size_t piece) const {
    return knots_[piece + 1] - knots_[piece] < 2.0 * kPair;
  }
  /// At either end: those that stand for a joint made out before, or the one that may hold it.
  [[nodiscard]] std::size_t pieces_of_joint(std::size_t outermost) const {
    constexpr double kWidest = 2.0 * kJointPieces * kJoint;  // theory: between that and any other piece
    const bool known = knots_[outermost + 1] - knots_[outermost] < kWidest;
    return known && pieces_ > 2 * kJointPieces ? kJointPieces : 1;
  }
  /// Whether a piece stands for the jump at a change of friction, whose place is known.
  [[nodiscard]] bool is_at_change(std::size_t piece) const {
    const std::vector<ChangeKnots>& changes = found_.track->mesh().change_knots;
    return std::any_of(changes.begin(), changes.end(), [&](const ChangeKnots& change) {
      return knots_[piece] >= change.from && knots_[piece + 1] <= change.to;
    });
  }
  /// The pieces around one of them, within [first, last), up to the next changes of friction.
  [[nodiscard]] std::pair<std::size_t, std::size_t> between_changes(std::size_t piece, std::size_t first,
                                                                    std::size_t last) const {
    for (const ChangeKnots& change : found_.track->mesh().change_knots) {
      while (first <= piece && knots_[first] < change.to && change.to <= knots_[piece]) ++first;
      while (last > piece + 1 && knots_[last] > change.from && change.from >= knots_[piece + 1]) --last;
    }
    return {first, last};
  }
  [[nodiscard]] double turn(std::size_t knot) const { return found_.z[found_.track->layout().turn(knot)]; }
  [[nodiscard]] double change(std::size_t piece) const { return std::fabs(turn(piece + 1) - turn(piece)); }
  /// Whether curvature changes across a piece by much of what it is nearby.
  [[nodiscard]] bool turns(std::size_t piece) const {
    double size = 0.0;
    for (std::size_t k = 0; k <= pieces_; ++k) {
      const bool near = wide_[k] >= wide_[piece] - kWindow && wide_[k] <= wide_[piece + 1] + kWindow;
      if (near) size = std::max(size, std::fabs(turn(k)));
    }
    return change(piece) > kJump * size;
  }

  /// The pieces that stand for a jump each: near the end of a binding, and no ripple of a greater one.
  [[nodiscard]] std::vector<std::size_t> ramps() const {
    constexpr double kNear = 3.0;    // taste
    constexpr double kRipple = 1.5;  // taste
    std::vector<std::size_t> by_size;
    for (std::size_t i = 0; i < pieces_; ++i) {
      const double middle = static_cast<double>(i) + 0.5;
      const bool near = std::any_of(ends_.begin(), ends_.end(),
                                    [&](double end) { return std::fabs(end - middle) < kNear; });
      if (near && turns(i) && !is_at_change(i)) by_size.push_back(i);
    }
    std::stable_sort(by_size.begin(), by_size.end(),
                     [&](std::size_t a, std::size_t b) { return change(a) > change(b); });
    std::vector<std::size_t> ramps;
    for (const std::size_t i : by_size) {
      const bool ripple = std::any_of(ramps.begin(), ramps.end(), [&](std::size_t greater) {
        return wide_[std::max(i, greater)] - wide_[std::min(i, greater) + 1] < kRipple;
      });
      if (!ripple) ramps.push_back(i);
    }
    std::sort(ramps.begin(), ramps.end());
    return ramps;
  }

  /// @param first,last  pieces [first, last) belong to this jump and to no other
  /// @return none where curvature turns out to change smoothly
  [[nodiscard]] std::optional<Switch> seen_from(std::size_t ramp, std::size_t first, std::size_t last) const {
    constexpr double kPartOfRamp = 0.6;    // taste
    constexpr std::size_t kMostRamps = 3;  // taste
    std::size_t begin = ramp;
    std::size_t end = ramp + 1;
    while (begin > first && end - begin < kMostRamps && change(begin - 1) > kPartOfRamp * change(ramp))
      --begin;
    while (end < last && end - begin < kMostRamps && change(end) > kPartOfRamp * change(ramp)) ++end;
    std::size_t before = begin;
    while (before > first && wide_[begin] - wide_[before - 1] <= kWindow) --before;
    std::size_t behind = end;
    while (behind < last && wide_[behind + 1] - wide_[end] <= kWindow) ++behind;

    Switch result;
    result.blurred = {knots_[begin], knots_[end]};
    if (wide_[before] == wide_[begin] || wide_[behind] == wide_[end]) return result;
    const Span search{0.5 * (knots_[begin - 1] + knots_[begin]), 0.5 * (knots_[end] + knots_[end + 1])};
    if (end == begin + 1 && is_narrow(begin)) {
      result.jump = moved(begin, begin - first, last - end, search);
      if (result.jump) return result;
    }
    const Kink kink(knots_, slope_angle_, before, behind, result.blurred);
    const double at = kink.best(search);
    const Kink::Fit fit = kink.fit(at);
    // Two parabolas that do not fit tell of more than one jump.
    constexpr double kFits = 1e-2;     // taste
    constexpr double kLikeRamp = 0.3;  // taste
    const double risen = turn(begin) - turn(end);
    if (fit.miss > kFits * std::fabs(risen) * (knots_[behind] - knots_[before])) return result;
    if (fit.jump / risen < kLikeRamp) return std::nullopt;
    if (at > search.from && at < search.to) result.jump = Span{at - 0.5 * kPair, at + 0.5 * kPair};
    return result;
  }

  /// Two knots around a jump that two knots stand around already, where the curves on both sides meet.
  /// @param before,behind  pieces up to the next jumps
  [[nodiscard]] std::optional<Span> moved(std::size_t pair, std::size_t before, std::size_t behind,
                                          Span search) const {
    constexpr std::size_t kNeeded = 3;  // theory: a parabola has three coefficients
    if (before < kNeeded || behind < kNeeded) return std::nullopt;
    const Parabola left = beside_jump(knots_, slope_angle_, pair, true, before);
    const Parabola right = beside_jump(knots_, slope_angle_, pair + 1, false, behind);
    constexpr int kSteps = 6;  // budget
    double at = 0.5 * (knots_[pair] + knots_[pair + 1]);
    for (int step = 0; step < kSteps; ++step) {
      at -= (right.value(at) - left.value(at)) / (right.slope(at) - left.slope(at));
    }
    if (!(at > search.from && at < search.to)) return std::nullopt;
    return Span{at - 0.5 * kPair, at + 0.5 * kPair};
  }

  const Found& found_;
  const Vector& knots_;
  std::size_t pieces_;
  FoundSlope slope_angle_;
  std::vector<double> ends_;
  std::vector<double> wide_;  ///< pieces before each knot, without those across a jump made out before
};

}  // namespace

std::vector<std::vector<Span>> bindings_of(const ScaledProblem& problem, const Found& found) {
  constexpr double kAtBound = 1e-6;     // accuracy: ten times that of a limit
  constexpr double kSameStretch = 1.5;  // taste
  struct Place {
    double at = 0.0;
    double slack = 0.0;
  };
  const Mesh& mesh = found.track->mesh();
  const State state = found.rows->state(found.z, false);
  const auto pieces_at = [&](double at) {
    return count_pieces(mesh.knots, found.track->sigma_at(found.z, at));
  };
  std::vector<std::vector<Place>> places(problem.limits.size());
  for (const Row& row : found.rows->candidates(state, HUGE_VAL)) {
    const double slack = -found.rows->value(state, row);
    // How far a corner is tells of the track at one place, not along it.
    if ((row.foot || row.face) && slack > kAtBound) continue;
    const double at = found.rows->place(state, row);
    places[row.limit].push_back({at, slack});
    if (problem.limits[row.limit].measure != Measure::curvature_rate) continue;
    const double width = mesh.knots[row.place + 1] - mesh.knots[row.place];
    places[row.limit].push_back({at + width * found.track->stretch(found.z, row.place), slack});
  }
  std::vector<std::vector<Span>> bindings(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    // Of two rides at one place the closer one counts.
    std::sort(places[i].begin(), places[i].end(),
              [](const Place& a, const Place& b) { return a.at != b.at ? a.at < b.at : a.slack < b.slack; });
    const auto end = std::unique(places[i].begin(), places[i].end(),
                                 [](const Place& a, const Place& b) { return a.at == b.at; });
    places[i].erase(end, places[i].end());
    const double shallow = slack_within(*problem.limits[i].measure);
    double deepest = 0.0;
    for (const Place& place : places[i]) {
      deepest = std::max(deepest, place.slack);
      if (place.slack > kAtBound) continue;
      const bool goes_on =
          !bindings[i].empty() &&
          (deepest < shallow || pieces_at(place.at) - pieces_at(bindings[i].back().to) < kSameStretch);
      if (!goes_on) bindings[i].push_back({place.at, place.at});
      bindings[i].back().to = place.at;
      deepest = 0.0;
    }
  }
  return bindings;
}

std::vector<Switch> switches_of(const ScaledProblem& problem, const Found& found) {
  // Under a limit on its rate curvature does not jump.
  const bool smooth = std::any_of(problem.limits.begin(), problem.limits.end(), [](const LimitSpec& limit) {
    return limit.measure == Measure::curvature_rate;
  });
  if (smooth) return {};
  std::vector<Switch> switches = JumpFinder(problem, found).switches();
  const std::vector<Switch> wraps = short_wraps(problem, found);
  // What is seen of an arc's ends beside it are its ripples.
  const Vector& knots = found.track->mesh().knots;
  for (std::size_t i = 0; i + 1 < wraps.size(); i += 2) {
    constexpr double kRipples = 2.5;  // taste: pieces
    const double from = count_pieces(knots, wraps[i].jump->from) - kRipples;
    const double to = count_pieces(knots, wraps[i + 1].jump->to) + kRipples;
    std::erase_if(switches, [&](const Switch& change) {
      const Span& at = change.jump ? *change.jump : change.blurred;
      const double middle = count_pieces(knots, 0.5 * (at.from + at.to));
      return middle > from && middle < to;
    });
  }
  switches.insert(switches.end(), wraps.begin(), wraps.end());
  std::stable_sort(switches.begin(), switches.end(), [](const Switch& a, const Switch& b) {
    const auto place = [](const Switch& change) {
      return change.jump ? change.jump->from : change.blurred.from;
    };
    return place(a) < place(b);
  });
  return switches;
}

bool settled(const std::vector<Switch>& switches) {
  constexpr double kSettled = 0.1 * kPair;  // taste
  return std::all_of(switches.begin(), switches.end(), [](const Switch& change) {
    if (!change.jump) return false;
    const double before = std::fabs(change.jump->from - change.blurred.from);
    const double behind = std::fabs(change.jump->to - change.blurred.to);
    return std::max(before, behind) <= kSettled;
  });
}

}  // namespace glissade::optimizer
