// A search over states gives a chain whatever the track, with some arcs more than needed, since its joints lie on gates.
// Chains of fewer arcs are then closed in on by moving joints freely, from two kinds of start: pieces of single circles,
// best where the curvature changes steadily, and the search's own chains in wider bands, best beside kept pieces and
// where the change of curvature changes its sign.

#include "parts/fewest_arcs.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/number_text.hpp"

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
constexpr double kSearchedSlip = 0.5;  // of the narrow side of a band to one side
constexpr double kFitted = 0.998;
constexpr std::size_t kSteps = 8;         // of the search, where joints are moved after it
constexpr std::size_t kFineSteps = 16;    // once more where that leaves many arcs
constexpr std::size_t kFinerSteps = 24;   // where they are not moved
constexpr std::size_t kFinestSteps = 64;  // before the search gives up
constexpr double kMostReach = 0.8;        // of a stretch, by a kept piece
constexpr double kWider = 1.2;            // bands of the search, one to the next
constexpr double kWidest = 4.0;
constexpr int kTries = 2;  // from wider bands, before the number of arcs stands
/// Arcs with common tangents to separate ones, where the curvature changes steadily: (192 / 124.7)^(1/3).
constexpr double kTangentShare = 1.155;

/// A stretch with what its kept ends may reach within a band.
Stretch reaching(const TrackSamples& samples, Stretch stretch, const Band& band) {
  const double most = kMostReach * (samples.s[stretch.last] - samples.s[stretch.first]);
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
ChainStart even_joints(const TrackSamples& samples, const Stretch& stretch, double tolerance,
                       std::size_t cells) {
  double high = tolerance;  // too many pieces below `low`, few enough at `high`
  double low = tolerance;
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
  start.offsets.assign(knots.size(), 0.0);
  start.heading = samples.heading[stretch.first];
  return start;
}

/// Chains of fewer and fewer arcs along one stretch.
class Fewer {
 public:
  Fewer(const Centerline& track, const TrackSamples& samples, const Stretch& stretch, const Band& band,
        FoundChain found)
      : track_(track),
        samples_(samples),
        stretch_(reaching(samples, stretch, band)),
        band_(band),
        tolerance_(kFitted * band.half_width()),
        best_(std::move(found)) {}

  ArcChain run() {
    const Stretch inner = inner_part(samples_, stretch_);
    const std::size_t bound = circle_pieces(samples_, inner.first, inner.last, band_.half_width()).count();
    const std::size_t least = stretch_.before && stretch_.after ? 2 : 1;
    const std::size_t fewest = std::max(bound, least);
    const auto likely = static_cast<std::size_t>(std::ceil(kTangentShare * static_cast<double>(bound))) + 1;
    if (likely > fewest && likely < best_.arcs) from_even(inner, likely);
    for (const std::size_t steps : {kSteps, kFineSteps}) {
      wider_ = steps == kSteps ? kWider : 1.0;
      while (best_.arcs > fewest) {
        const std::size_t arcs = best_.arcs;
        if (!from_wider(arcs, fewest, steps) && !from_even(inner, arcs - 1)) break;
      }
      if (best_.arcs <= likely) break;
    }
    return std::move(best_.chain);
  }

 private:
  bool from_even(const Stretch& inner, std::size_t arcs) {
    return take(even_joints(samples_, inner, band_.half_width(), arcs));
  }

  /// Searches wider bands until fewer arcs than the best are met, and closes in from there.
  bool from_wider(std::size_t arcs, std::size_t fewest, std::size_t steps) {
    int tries = 0;
    for (; wider_ <= kWidest && tries < kTries; wider_ *= kWider) {
      const Band band = band_.scaled(wider_);
      const auto found = search_chain(track_, samples_, reaching(samples_, stretch_, band), band, steps);
      if (!found || found->arcs >= arcs) continue;
      if (found->arcs < fewest) return false;
      if (take(found->joints)) return true;
      ++tries;
    }
    return false;
  }

  bool take(ChainStart start) {
    std::vector<double>& knots = start.knots;
    const double begin = samples_.s[stretch_.first];
    const double end = samples_.s[stretch_.last];
    if (stretch_.before) knots.front() = std::min(knots.front(), begin + stretch_.before->reach);
    if (stretch_.after) knots.back() = std::max(knots.back(), end - stretch_.after->reach);
    for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
      if (!(knots[i] < knots[i + 1])) return false;
    }
    const std::size_t arcs = knots.size() - 1;
    ArcChain chain = fit_chain(samples_, stretch_, std::move(start), tolerance_);
    if (!(chain.deviation <= tolerance_)) return false;
    best_ = {std::move(chain), {}, arcs};
    return true;
  }

  const Centerline& track_;
  const TrackSamples& samples_;
  Stretch stretch_;
  Band band_;
  double tolerance_ = 0.0;
  FoundChain best_;
  double wider_ = kWider;
};

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
                     const Band& band) {
  const bool even = band.left == band.right;
  const auto inside_of = [&](double side) {
    return side < band.half_width() ? kSearchedSlip * side : kSearched * side;
  };
  const Band inside = {inside_of(band.left), inside_of(band.right)};
  for (std::size_t steps = even ? kSteps : kFinerSteps; steps <= kFinestSteps; steps *= 2) {
    const Stretch within = reaching(samples, stretch, inside);
    auto found = search_chain(track, samples, within, inside, steps);
    if (!found) continue;
    // Between gates it strays: joints that move a little are far cheaper than gates that stand closer.
    const bool strays = found->chain.deviation > band.half_width();
    if (strays && even) found->chain = fit_chain(samples, within, found->joints, kFitted * band.half_width());
    if (found->chain.deviation > band.half_width()) continue;
    if (!even) return std::move(found->chain);
    return Fewer(track, samples, stretch, band, std::move(*found)).run();
  }
  throw ConvergenceError(
      {"", "no arcs found that follow the track within " + length_text(band.left), "", "a larger tolerance"});
}

}  // namespace glissade::parts
