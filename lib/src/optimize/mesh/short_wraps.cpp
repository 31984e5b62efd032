#include "optimize/mesh/short_wraps.hpp"

#include "optimize/mesh/jump_fit.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace glissade::optimizer {
namespace {

// Longer ones are seen from their ends.
constexpr double kMostPieces = 4.0;  // taste

/// A corner that the track touches, and is held back by.
struct Touch {
  double price = 0.0;
  double moment = 0.0;  ///< of the price, by the length of the core
  double from = 1.0;
  double to = 0.0;
  double bend = 0.0;  ///< curvature of a track round it, positive in a valley [1/chord]

  [[nodiscard]] double middle() const { return moment / price; }
};

double radius_about(const ScaledProblem& problem, const LimitSpec& limit, const Obstacle& obstacle) {
  const double height = obstacle.side > 0.0 ? problem.envelope_low : problem.envelope_high;
  const bool envelope = problem.envelope_high > problem.envelope_low;
  return limit.bound + (envelope ? std::fabs(height) : 0.0);
}

/// As much of a bend round the corner as the limits on radius allow. @return none where loads do not
std::optional<double> allowed_bend(const ScaledProblem& problem, const Found& found, const State& state,
                                   const Touch& touch) {
  double bend = touch.bend;
  for (const LimitSpec& limit : problem.limits) {
    if (limit.measure == Measure::curvature && limit.side * (bend - limit.bound) > 0.0) bend = limit.bound;
  }
  const std::vector<Station>& stations = found.track->stations();
  const auto at =
      std::lower_bound(stations.begin(), stations.end() - 1, touch.middle(),
                       [](const Station& station, double sigma) { return station.sigma < sigma; });
  const auto i = static_cast<std::size_t>(at - stations.begin());
  const bool carried = std::all_of(problem.limits.begin(), problem.limits.end(), [&](const LimitSpec& limit) {
    if (limit.measure != Measure::normal_load) return true;
    return std::all_of(state.flows.begin(), state.flows.end(), [&](const Flow& flow) {
      return limit.side * (state.shape.cos[i] + bend * flow.v[i] - limit.bound) <= 0.0;
    });
  });
  return carried ? std::optional(bend) : std::nullopt;
}

std::vector<Touch> touches_of(const ScaledProblem& problem, const Found& found) {
  const State state = found.rows->state(found.z, false);
  std::map<std::pair<std::size_t, std::size_t>, Touch> touches;
  for (std::size_t k = 0; k < found.active.size(); ++k) {
    const Row& row = found.active[k];
    const LimitSpec& limit = problem.limits[row.limit];
    if (limit.measure != Measure::distance || found.inequality[k] <= 0.0 || !(row.foot || row.around))
      continue;
    const Obstacle& obstacle = problem.obstacles[limit.obstacle];
    const std::size_t corner = row.foot ? row.place : row.edge;
    if (corner >= obstacle.corners.size()) continue;
    const double sigma = found.track->sigma_at(found.z, found.rows->place(state, row));
    Touch& touch = touches[{row.limit, corner}];
    touch.price += found.inequality[k];
    touch.moment += found.inequality[k] * sigma;
    touch.from = std::min(touch.from, sigma);
    touch.to = std::max(touch.to, sigma);
    touch.bend = -obstacle.side / radius_about(problem, limit, obstacle);
  }
  std::vector<Touch> result;
  for (auto& [key, touch] : touches) {
    const std::optional<double> bend = allowed_bend(problem, found, state, touch);
    if (!bend) continue;
    touch.bend = *bend;
    result.push_back(touch);
  }
  std::sort(result.begin(), result.end(),
            [](const Touch& a, const Touch& b) { return a.middle() < b.middle(); });
  return result;
}

/// Slope angles of a track found between any places, and how wide its pieces are.
class Turning {
 public:
  explicit Turning(const Found& found) : knots_(found.track->mesh().knots), slope_(found) {
    for (const double knot : knots_) {
      if (wide_.empty() || knot - wide_.back() > 2.0 * kPair) wide_.push_back(knot);
    }
    wide_.back() = 1.0;
  }

  /// The place some wide pieces before (negative) or behind another one; none beyond the ends.
  [[nodiscard]] std::optional<double> away(double sigma, double pieces) const {
    const double at = count_pieces(wide_, sigma) + pieces;
    if (!(at >= 0.0 && at <= static_cast<double>(wide_.size() - 1))) return std::nullopt;
    const auto i = std::min(static_cast<std::size_t>(at), wide_.size() - 2);
    return wide_[i] + (at - static_cast<double>(i)) * (wide_[i + 1] - wide_[i]);
  }
  [[nodiscard]] double pieces(Span span) const {
    return count_pieces(wide_, span.to) - count_pieces(wide_, span.from);
  }
  /// By which the track turns up from one place to another.
  [[nodiscard]] double between(double from, double to) const { return slope_at(from) - slope_at(to); }
  /// The knots around a place.
  [[nodiscard]] Span around(double sigma) const {
    const auto above = std::upper_bound(knots_.begin() + 1, knots_.end() - 1, sigma);
    return {*(above - 1), *above};
  }

 private:
  [[nodiscard]] double slope_at(double sigma) const {
    const double at = count_pieces(knots_, sigma);
    const auto i = std::min(static_cast<std::size_t>(at), knots_.size() - 2);
    return slope_.value(i, at - static_cast<double>(i));
  }

  const Vector& knots_;
  FoundSlope slope_;
  Vector wide_;
};

/// The arc about a corner that turns as much as the track found does there.
std::optional<Span> arc_of(const Touch& touch, const Turning& turning, double core_length) {
  constexpr double kSeen = 3.0;  // taste: pieces before and behind that tell how the track bends else
  const double half = 0.5 * kMostPieces;
  const std::optional<double> from = turning.away(touch.middle(), -half);
  const std::optional<double> to = turning.away(touch.middle(), half);
  if (!from || !to) return std::nullopt;
  const std::optional<double> before = turning.away(*from, -kSeen);
  const std::optional<double> behind = turning.away(*to, kSeen);
  if (!before || !behind || turning.pieces({touch.from, touch.to}) > kMostPieces - 1.0) return std::nullopt;
  const double usual = 0.5 * (turning.between(*before, *from) / (*from - *before) +
                              turning.between(*to, *behind) / (*behind - *to));
  const double round = touch.bend * core_length;
  const double more = turning.between(*from, *to) - usual * (*to - *from);
  const double length = more / (round - usual);
  if (!(length > 4.0 * kPair) ||
      turning.pieces({touch.middle() - 0.5 * length, touch.middle() + 0.5 * length}) > half)
    return std::nullopt;
  return Span{touch.middle() - 0.5 * length, touch.middle() + 0.5 * length};
}

}  // namespace

std::vector<Switch> short_wraps(const ScaledProblem& problem, const Found& found) {
  const std::vector<Touch> touches = touches_of(problem, found);
  if (touches.empty()) return {};
  const Turning turning(found);
  std::vector<Switch> switches;
  for (const Touch& touch : touches) {
    const std::optional<Span> arc = arc_of(touch, turning, found.track->core_length(found.z));
    if (!arc) continue;
    for (const double end : {arc->from, arc->to})
      switches.push_back({turning.around(end), Span{end - 0.5 * kPair, end + 0.5 * kPair}});
  }
  return switches;
}

}  // namespace glissade::optimizer
