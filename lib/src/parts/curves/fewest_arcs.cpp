// Joints that lie well are moved until their chain comes as close as it can, to first order; how far it stays outside, or
// inside, tells how many arcs there should be: their number grows with the cube root of it. They begin at the ends of
// pieces that single circles pass, and, where that leaves many arcs, where a search by dynamic programming puts them. Where
// neither gives a chain, the search over true arcs does whatever the track, with some more than needed.

#include "parts/curves/fewest_arcs.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"

#include "parts/curves/joint_fit.hpp"
#include "parts/curves/joint_search.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace glissade::parts {
namespace {

// Of the band: between gates a chain may stray a little farther than at them.
constexpr double kSearched = 0.98;
constexpr double kFitted = 0.998;
constexpr double kFittedJoints = 0.995;   // of that, to first order
constexpr std::size_t kSteps = 8;         // of the searches
constexpr std::size_t kFineSteps = 16;    // where the first ones meet nothing, or more than there should be
constexpr std::size_t kFinestSteps = 64;  // before the search gives up
constexpr std::size_t kFewPieces = 3;     // for which the search itself is quick enough
constexpr double kMostReach = 0.8;        // of a stretch, by a kept piece
constexpr double kSharp = 4.0;            // times the track's own curvature: no arc needs more
constexpr double kSway = 8.0;         // of a straight one: half widths of the band over its length squared
constexpr double kLeastWider = 1.05;  // bands of the search, one to the next
constexpr double kMostWider = 1.5;
constexpr double kWidest = 4.0;
constexpr int kMostSearches = 4;
constexpr std::size_t kVeryFewArcs = 12;  // of which no more than needed are worth a search
constexpr std::size_t kFewArcs = 24;      // the same of a thorough one
constexpr std::size_t kManyArcs = 40;     // of which one more than needed is let pass
constexpr double kNearly = 1.1;           // tolerances, of true arcs on joints that are within one
constexpr int kMostFits = 8;              // from one start
constexpr double kRoundedDown = 0.35;     // of an arc that seems to be missing
constexpr double kMostMore = 2.0;         // times as many arcs as were tried
constexpr std::size_t kMostCuts = 3;      // of arcs that stay outside
constexpr double kLeastShare = 0.02;  // of the greatest deviation, by which an arc counts that comes closer
/// Arcs with common tangents to separate ones, where the curvature changes steadily: (192 / 124.7)^(1/3).
constexpr double kTangentShare = 1.155;

/// A stretch with what its kept ends may reach within a band.
/// @param share  of the stretch at most
Stretch reaching(const TrackSamples& samples, Stretch stretch, const Band& band, double share) {
  const double most = share * (samples.s[stretch.last] - samples.s[stretch.first]);
  for (auto* end : {&stretch.before, &stretch.after}) {
    const int step = end == &stretch.before ? 1 : -1;
    if (*end) (*end)->reach = std::min(most, reach_of(samples, stretch, (*end)->leg, band, step));
  }
  return stretch;
}

/// A stretch without what its kept ends reach, but for a part.
Stretch inner_part(const TrackSamples& samples, const Stretch& stretch) {
  // Of what a kept piece may reach, where its joint begins to look for its place.
  constexpr double kFirstShare = 0.6;
  Stretch inner = stretch;
  if (stretch.before)
    inner.first = index_at(samples, samples.s[stretch.first] + kFirstShare * stretch.before->reach);
  if (stretch.after)
    inner.last = index_at(samples, samples.s[stretch.last] - kFirstShare * stretch.after->reach);
  return inner;
}

/// Joints where a given number of separate arcs with the least common tolerance end.
ChainStart even_joints(const TrackSamples& samples, const Stretch& stretch, const Band& band,
                       std::size_t cells) {
  double high = band.half_width();  // too many pieces below `low`, few enough at `high`
  double low = high;
  const auto pieces_at = [&](double bound) {
    return circle_pieces(samples, stretch.first, stretch.last, bound);
  };
  CirclePieces pieces = pieces_at(high);
  while (pieces.count() > cells) pieces = pieces_at(high *= 2.0);
  for (int k = 0; k < 8 && pieces_at(low).count() <= cells; ++k) low *= 0.5;
  for (int k = 0; k < 5; ++k) {
    const double middle = std::sqrt(low * high);
    CirclePieces tried = pieces_at(middle);
    if (tried.count() > cells) {
      low = middle;
    } else {
      high = middle;
      pieces = std::move(tried);
    }
  }
  ChainStart start;
  start.knots = {samples.s[stretch.first]};
  for (std::size_t i = 0; i + 1 < pieces.ends.size(); ++i) start.knots.push_back(samples.s[pieces.ends[i]]);
  start.knots.push_back(samples.s[stretch.last]);
  std::vector<double>& knots = start.knots;
  while (knots.size() < cells + 1) {  // fewer pieces would do: split the longest
    std::size_t longest = 0;
    for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
      if (knots[i + 1] - knots[i] > knots[longest + 1] - knots[longest]) longest = i;
    }
    const double middle = 0.5 * (knots[longest] + knots[longest + 1]);
    knots.insert(knots.begin() + static_cast<std::ptrdiff_t>(longest) + 1, middle);
  }
  start.offsets.assign(knots.size(), band.middle());
  start.heading = samples.heading[stretch.first];
  return start;
}

/// Chains of fewer and fewer arcs along one stretch.
class Fewer {
 public:
  /// @param reach  share of the stretch that its kept ends may reach
  Fewer(const Centerline& track, const TrackSamples& samples, const Stretch& stretch, const Band& band,
        const FewestSearch& search, double reach)
      : track_(track),
        samples_(samples),
        stretch_(reaching(samples, stretch, band, reach)),
        reach_(reach),
        band_(band),
        tolerance_(kFitted * band.half_width()),
        least_(search.least),
        thorough_(search.thorough),
        best_(search.known != nullptr ? *search.known : ArcChain{}) {}

  /// @return no vertices where no chain is found
  ArcChain run() {
    const Stretch inner = inner_part(samples_, stretch_);
    const std::size_t bound = circle_pieces(samples_, inner.first, inner.last, band_.half_width()).count();
    fewest_ = std::max<std::size_t>(std::max(bound, least_), stretch_.before && stretch_.after ? 2 : 1);
    const auto tangent = static_cast<std::size_t>(std::ceil(kTangentShare * static_cast<double>(bound)));
    likely_ = std::max(tangent + (tangent > kManyArcs ? 2 : 1), fewest_);
    if (!known() && bound <= kFewPieces) search();
    if (!known() || arcs() > fewest_)
      close_in(even_joints(samples_, inner, band_, known() ? std::min(likely_, arcs() - 1) : likely_));
    if (!known() || worth()) from_joints(kSteps);
    const bool few = known() && arcs() <= (arcs() > likely_ + 1 ? kFewArcs : kVeryFewArcs);
    const bool close = thorough_ && few && worth();
    if (!known() || close) from_joints(kFineSteps);
    if (!known()) search();
    return std::move(best_);
  }

 private:
  [[nodiscard]] bool known() const { return !best_.vertices.empty(); }
  [[nodiscard]] std::size_t arcs() const { return best_.vertices.size() - 1; }

  /// Fits one number of arcs after the other, from a start on.
  void close_in(ChainStart start) {
    std::size_t failed = fewest_ - 1;  // the greatest number of arcs that were not enough
    FittedJoints good;                 // joints of the last chain that does, to go on from
    for (int fits = 0; fits < kMostFits && inside(start); ++fits) {
      FittedJoints fitted = fit_joints(samples_, stretch_, start, band_.middle(), kFittedJoints * tolerance_);
      const std::size_t count = fitted.deviations.size();
      if (take(fitted)) {
        good = std::move(fitted);
        if (count - 1 < fewest_) return;
        start = count - 1 > failed ? spread(good, count - 1) : without_least(good);
      } else if (count > failed) {
        failed = count;
        const std::size_t next = more_than(fitted);
        if (next > failed) {
          start = with_arcs(fitted, next);
        } else if (!good.deviations.empty() && (worth() || arcs() <= kFewArcs)) {
          start = without_least(good);  // all joints moved did not do: one taken out may
        } else {
          return;
        }
      } else {
        return;
      }
    }
  }

  /// How many arcs a chain that stays outside seems to need, fewer than are known to do; 0 where that is far off.
  [[nodiscard]] std::size_t more_than(const FittedJoints& fitted) const {
    const std::size_t count = fitted.deviations.size();
    const double wanted = static_cast<double>(count) * math::cbrt(fitted.deviation / tolerance_);
    if (!(wanted < kMostMore * static_cast<double>(count))) return 0;
    const auto next = std::max(count + 1, static_cast<std::size_t>(std::ceil(wanted - kRoundedDown)));
    // A few that stay outside are cut where they are.
    const std::size_t outside = outside_of(fitted);
    if (outside <= kMostCuts && (!known() || count + outside < arcs())) return count + outside;
    return known() ? std::min(next, arcs() - 1) : next;
  }

  /// Whether a chain of fewer arcs is worth a search.
  [[nodiscard]] bool worth() const {
    return arcs() > fewest_ && (arcs() > likely_ || arcs() <= (thorough_ ? kFewArcs : kVeryFewArcs));
  }

  /// Starts from joints that are found in bands so wide that they are as few as wanted.
  void from_joints(std::size_t steps) {
    double wider = kSearched;
    const int most = thorough_ ? 2 * kMostSearches : kMostSearches;
    for (int searches = 0; searches < most && wider <= kWidest; ++searches) {
      if (known() && !worth()) return;
      const std::size_t wanted = known() ? arcs() - 1 : likely_;
      const Band band = band_.scaled(wider);
      auto joints = search_joints(samples_, reaching(samples_, stretch_, band, reach_), band, steps);
      if (!joints) {  // gates that stand too far apart for a narrow band
        wider *= kMostWider;
        continue;
      }
      const std::size_t count = joints->knots.size() - 1;
      // Arcs are as many as the cube root of the width asks.
      const double ratio = static_cast<double>(count) / static_cast<double>(wanted);
      wider *= std::clamp(ratio * ratio * ratio, kLeastWider, kMostWider);
      if (count <= wanted || (!known() && searches + 1 == most)) close_in(std::move(*joints));
    }
  }

  /// A first chain whatever the track.
  void search() {
    const Band inside = band_.scaled(kSearched);
    for (std::size_t steps = kSteps; steps <= kFinestSteps; steps *= 2) {
      const Stretch within = reaching(samples_, stretch_, inside, reach_);
      auto found = search_chain(track_, samples_, within, inside, steps);
      if (!found) continue;
      // Between gates it strays: joints that move a little are far cheaper than gates that stand closer.
      best_ = std::move(found->chain);
      if (best_.deviation > band_.half_width())
        best_ =
            fit_chain(samples_, within, moved(within, std::move(found->joints)), band_.middle(), tolerance_);
      if (best_.deviation <= band_.half_width()) return;
    }
    best_ = {};
  }

  [[nodiscard]] ChainStart moved(const Stretch& within, ChainStart joints) const {
    if (within.before && within.after && joints.knots.size() < 3) return joints;
    return fit_joints(samples_, within, std::move(joints), band_.middle(), kFittedJoints * tolerance_).joints;
  }

  /// Puts the ends of a start where kept pieces reach.
  /// @return whether its joints follow each other
  bool inside(ChainStart& start) const {
    std::vector<double>& knots = start.knots;
    const double begin = samples_.s[stretch_.first];
    const double end = samples_.s[stretch_.last];
    if (stretch_.before) knots.front() = std::min(knots.front(), begin + stretch_.before->reach);
    if (stretch_.after) knots.back() = std::max(knots.back(), end - stretch_.after->reach);
    for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
      if (!(knots[i] < knots[i + 1])) return false;
    }
    return knots.size() > (stretch_.before && stretch_.after ? 2 : 1);
  }

  bool take(const FittedJoints& fitted) {
    if (!(fitted.deviation <= tolerance_)) return false;
    ArcChain chain = fit_chain(samples_, stretch_, fitted.joints, band_.middle(), tolerance_);
    if (chain.deviation > tolerance_ && chain.deviation < kNearly * tolerance_) {
      // What the first order leaves out is made up for.
      const double aim = kFittedJoints * tolerance_ * std::min(1.0, fitted.deviation / chain.deviation);
      const FittedJoints closer = fit_joints(samples_, stretch_, fitted.joints, band_.middle(), aim);
      chain = fit_chain(samples_, stretch_, closer.joints, band_.middle(), tolerance_);
    }
    if (!(chain.deviation <= tolerance_)) return false;
    best_ = std::move(chain);
    return true;
  }

  /// Joints for another number of arcs, from those of a chain.
  [[nodiscard]] ChainStart with_arcs(const FittedJoints& fitted, std::size_t count) const {
    const std::size_t before = fitted.deviations.size();
    return count == before + outside_of(fitted) ? with_cuts(fitted) : spread(fitted, count);
  }

  [[nodiscard]] std::size_t outside_of(const FittedJoints& fitted) const {
    const auto outside = std::count_if(fitted.deviations.begin(), fitted.deviations.end(),
                                       [&](double deviation) { return deviation > tolerance_; });
    return static_cast<std::size_t>(outside);
  }

  /// The arcs that stay outside cut in two.
  [[nodiscard]] ChainStart with_cuts(const FittedJoints& fitted) const {
    const std::vector<double>& knots = fitted.joints.knots;
    ChainStart start{{knots.front()}, {}, fitted.joints.heading};
    for (std::size_t i = 0; i < fitted.deviations.size(); ++i) {
      if (fitted.deviations[i] > tolerance_) start.knots.push_back(0.5 * (knots[i] + knots[i + 1]));
      start.knots.push_back(knots[i + 1]);
    }
    start.offsets.assign(start.knots.size(), band_.middle());
    return start;
  }

  /// The joints but the one between the two arcs that would make the closest one.
  [[nodiscard]] ChainStart without_least(const FittedJoints& fitted) const {
    const auto sum_at = [&](std::size_t joint) {
      return math::cbrt(fitted.deviations[joint - 1]) + math::cbrt(fitted.deviations[joint]);
    };
    std::size_t least = 1;
    for (std::size_t i = 2; i < fitted.deviations.size(); ++i) {
      if (sum_at(i) < sum_at(least)) least = i;
    }
    ChainStart start = fitted.joints;
    start.knots.erase(start.knots.begin() + static_cast<std::ptrdiff_t>(least));
    start.offsets.erase(start.offsets.begin() + static_cast<std::ptrdiff_t>(least));
    return start;
  }

  /// Joints between which arcs would come as close as each other, by the cubes of their widths.
  [[nodiscard]] ChainStart spread(const FittedJoints& fitted, std::size_t count) const {
    const std::vector<double>& knots = fitted.joints.knots;
    std::vector<double> shares{0.0};
    for (const double deviation : fitted.deviations)
      shares.push_back(shares.back() + math::cbrt(std::max(deviation / fitted.deviation, kLeastShare)));
    ChainStart start{{knots.front()}, {}, fitted.joints.heading};
    std::size_t cell = 0;
    for (std::size_t i = 1; i < count; ++i) {
      const double wanted = shares.back() * static_cast<double>(i) / static_cast<double>(count);
      while (shares[cell + 1] < wanted) ++cell;
      const double part = (wanted - shares[cell]) / (shares[cell + 1] - shares[cell]);
      start.knots.push_back(knots[cell] + part * (knots[cell + 1] - knots[cell]));
    }
    start.knots.push_back(knots.back());
    start.offsets.assign(start.knots.size(), band_.middle());
    return start;
  }

  const Centerline& track_;
  const TrackSamples& samples_;
  Stretch stretch_;
  double reach_ = kMostReach;
  Band band_;
  double tolerance_ = 0.0;
  std::size_t least_ = 1;
  bool thorough_ = false;
  ArcChain best_;
  std::size_t fewest_ = 1;  // arcs that a chain can have
  std::size_t likely_ = 1;  // and that it is to be expected to have
};

double sharpest_arc(const ArcChain& chain) {
  double most = 0.0;
  for (std::size_t i = 0; i + 1 < chain.vertices.size(); ++i) {
    const double bulge = std::fabs(chain.vertices[i].bulge);
    const double chord = norm(chain.vertices[i + 1].at - chain.vertices[i].at);
    most = std::max(most, 4.0 * bulge / ((1.0 + bulge * bulge) * chord));
  }
  return most;
}

/// The greatest curvature that arcs along a stretch have a use for.
double sharpest_wanted(const TrackSamples& samples, const Stretch& stretch, const Band& band) {
  double most = 0.0;
  for (std::size_t i = stretch.first; i < stretch.last; ++i) {
    const double turned = std::fabs(samples.heading[i + 1] - samples.heading[i]);
    most = std::max(most, turned / (samples.s[i + 1] - samples.s[i]));
  }
  for (const auto& end : {stretch.before, stretch.after}) {
    if (end) most = std::max(most, std::fabs(end->leg.curvature));
  }
  const double length = samples.s[stretch.last] - samples.s[stretch.first];
  return kSharp * most + kSway * band.half_width() / (length * length);
}

}  // namespace

double reach_of(const TrackSamples& samples, const Stretch& stretch, const ArcAt& leg, const Band& band,
                int step) {
  const std::size_t from = step > 0 ? stretch.first : stretch.last;
  double reached = 0.0;
  for (std::size_t j = from; j >= stretch.first && j <= stretch.last; j += static_cast<std::size_t>(step)) {
    const double away = -leg.distance(samples.point[j]);
    if (away > band.left || away < -band.right) break;
    reached = std::fabs(samples.s[j] - samples.s[from]);
  }
  return reached;
}

ArcChain fewest_arcs(const Centerline& track, const TrackSamples& samples, const Stretch& stretch,
                     const Band& band, const FewestSearch& search) {
  ArcChain chain = Fewer(track, samples, stretch, band, search, kMostReach).run();
  if (chain.vertices.empty()) {
    throw ConvergenceError({"",
                            "no arcs found that follow the track within " + length_text(band.half_width()),
                            "", "a larger tolerance"});
  }
  // Kept pieces that go on as far as the band lets them may leave a short stretch no room but for a sharp turn back.
  const double wanted = sharpest_wanted(samples, stretch, band);
  for (const double reach : {0.5 * kMostReach, 0.25 * kMostReach, 0.0}) {
    if (!(sharpest_arc(chain) > wanted)) break;
    ArcChain calmer =
        Fewer(track, samples, stretch, band, {search.least, search.thorough, nullptr}, reach).run();
    const bool few = !calmer.vertices.empty() && calmer.vertices.size() <= chain.vertices.size();
    if (few && sharpest_arc(calmer) < sharpest_arc(chain)) chain = std::move(calmer);
  }
  return chain;
}

}  // namespace glissade::parts
