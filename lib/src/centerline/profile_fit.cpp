#include "profile_fit.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"

#include "profile_description.hpp"
#include "profile_model.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <utility>

namespace glissade::centerline {
namespace {

// The smoothing is lowered from the first to the last in these steps: from "an arc" to "through every point"
// for points that are exact to some 1e-9 of the length. Ten times the smoothing is half again the stretch
// that it smooths over, so that finer steps find no better curve.
constexpr double kMostSmoothing = 1.0;
constexpr double kLeastSmoothing = 1e-20;
constexpr double kSmoothingStep = 0.1;
// Plain cross-validation now and then takes noise for shape; counting each freedom of the curve this often is
// the usual remedy (Cummins, Filloon and Nychka, J. Am. Stat. Assoc. 96 (2001) 233).
constexpr double kPriceOfFreedom = 1.4;
// It needs many more points than the curve has freedom. Beyond this share, or with fewer points than this, it
// tells nothing.
constexpr double kMostFreedom = 0.65;
constexpr std::size_t kFewestToValidate = 20;
constexpr int kMostSteps = 60;
constexpr int kMostHalvings = 12;
// A step that promises less than this share of what is left is not worth its while.
constexpr double kSettled = 1e-9;
// Root of the mean squared distance over length that is rounding.
constexpr double kRoundingShare = 1e-15;
// Means of neighbours stand for more points than these: they keep what the points say, at a bounded cost.
constexpr std::size_t kMostFitted = 1000;

/// @return at most kMostFitted points in the same order, each the mean of neighbours; the ends as they are
std::vector<Vec2> thinned(const std::vector<Vec2>& points) {
  if (points.size() <= kMostFitted) return points;
  std::vector<Vec2> means = {points.front()};
  const std::size_t inner = points.size() - 2;
  constexpr std::size_t kGroups = kMostFitted - 2;
  for (std::size_t group = 0; group < kGroups; ++group) {
    const std::size_t from = 1 + group * inner / kGroups;
    const std::size_t to = 1 + (group + 1) * inner / kGroups;
    Vec2 sum;
    for (std::size_t i = from; i < to; ++i) sum = sum + points[i];
    means.push_back(1.0 / static_cast<double>(to - from) * sum);
  }
  means.push_back(points.back());
  return means;
}

/// What a description of points costs: what it leaves of them, and the numbers that it takes.
struct Cost {
  double mean_square = 0.0;  // of distance over length
  double freedom = 0.0;

  /// Craven and Wahba's score: an estimate of the distance from the curve that the points were noisy samples of.
  /// Infinite where the description is too free for the score to mean anything.
  [[nodiscard]] double validation_score(std::size_t points) const {
    const auto equations = static_cast<double>(points);
    if (freedom > kMostFreedom * equations) return std::numeric_limits<double>::infinity();
    return mean_square / math::pow(1.0 - kPriceOfFreedom * freedom / equations, 2);
  }
  /// Schwarz's Bayesian information criterion, over the number of points.
  [[nodiscard]] double bayesian_score(std::size_t points) const {
    const auto equations = static_cast<double>(points);
    return math::log(std::max(mean_square, kRoundingShare * kRoundingShare)) +
           freedom * math::log(equations) / equations;
  }
};

class Fitter {
 public:
  explicit Fitter(const std::vector<Vec2>& points)
      : points_(&points), model_(thinned(points)), shape_(model_.first_shape()) {}

  [[nodiscard]] ClothoidSpline within_deviation(double max_deviation) {
    return model_.spline(within(max_deviation));
  }
  [[nodiscard]] ClothoidSpline validated_spline() { return model_.spline(validated()); }
  /// @return what the smooth curve of the best score costs; none where cross-validation told nothing
  [[nodiscard]] const std::optional<Cost>& best_cost() const { return best_cost_; }

 private:
  void relax(double smoothing);
  [[nodiscard]] Shape moved(const std::vector<double>& move, double share) const;
  [[nodiscard]] std::optional<Cost> cost(double smoothing);
  [[nodiscard]] Shape validated();
  [[nodiscard]] Shape within(double max_deviation);
  [[nodiscard]] double farthest_point() const;

  const std::vector<Vec2>* points_;
  ProfileModel model_;
  Shape shape_;
  std::optional<Cost> best_cost_;
};

/// Keeps rounding from making a matrix indefinite that is only just not.
void stiffen(SymmetricMatrix& matrix) {
  constexpr double kShare = 1e-13;
  for (std::size_t i = 0; i < matrix.size(); ++i) matrix.at(i, i) *= 1.0 + kShare;
}

Shape Fitter::moved(const std::vector<double>& move, double share) const {
  Shape next = shape_;
  next.entry -= share * move[kEntry];
  next.length -= share * move[kLength];
  for (std::size_t k = 0; k < next.bend.size(); ++k) next.bend[k] -= share * move[kFirstBend + k];
  return next;
}

/// Minimises for one smoothing by damped Gauss-Newton steps, from the shape so far.
void Fitter::relax(double smoothing) {
  Linearized here = model_.linearized(shape_);
  double value = here.mean_square + smoothing * model_.roughness(shape_);
  for (int step = 0; step < kMostSteps && value > kRoundingShare * kRoundingShare; ++step) {
    model_.add_roughness(shape_, smoothing, here);
    stiffen(here.matrix);
    if (!here.matrix.factorize()) return;
    std::vector<double> move = here.gradient;
    here.matrix.solve_forward(move);
    double promised = 0.0;
    for (const double part : move) promised += part * part;
    if (promised <= kSettled * value) return;
    here.matrix.solve_backward(move);

    bool better = false;
    double share = 1.0;
    for (int halving = 0; halving < kMostHalvings && !better; ++halving, share *= 0.5) {
      const Shape next = moved(move, share);
      if (!(next.length > 0.0)) continue;
      Linearized there = model_.linearized(next);
      const double next_value = there.mean_square + smoothing * model_.roughness(next);
      better = next_value < value;
      if (!better) continue;
      shape_ = next;
      here = std::move(there);
      value = next_value;
    }
    if (!better) return;
  }
}

/// What the shape that was relaxed for this smoothing costs.
std::optional<Cost> Fitter::cost(double smoothing) {
  const Linearized data = model_.linearized(shape_);
  Linearized all = data;
  model_.add_roughness(shape_, smoothing, all);
  stiffen(all.matrix);
  if (!all.matrix.factorize()) return {};
  const std::size_t size = data.matrix.size();
  double freedom = 0.0;
  for (std::size_t column = 0; column < size; ++column) {
    std::vector<double> image(size);
    for (std::size_t row = 0; row < size; ++row) {
      image[row] = data.matrix.at(std::max(row, column), std::min(row, column));
    }
    all.matrix.solve_forward(image);
    all.matrix.solve_backward(image);
    freedom += image[column];
  }
  return Cost{data.mean_square, freedom};
}

/// The shape of the best score over all of the range: a score with more than one valley is the rule where a
/// profile has more than one length of wave. Where the score becomes better as long as it means anything, the
/// points show no noise: then the one that goes through all of them.
Shape Fitter::validated() {
  Shape best = shape_;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  double best_score = infinity;
  bool meaningful = model_.point_count() >= kFewestToValidate;
  bool improving = true;
  for (double smoothing = kMostSmoothing; smoothing >= kLeastSmoothing; smoothing *= kSmoothingStep) {
    relax(smoothing);
    if (!meaningful) continue;
    // Every point gives one equation, the last one two, the first one none.
    const std::optional<Cost> here = cost(smoothing);
    const double score = here ? here->validation_score(model_.point_count()) : infinity;
    meaningful = std::isfinite(score);
    if (!meaningful) {
      if (!improving) return best;
      continue;
    }
    improving = score < best_score;
    if (!improving) continue;
    best = shape_;
    best_score = score;
    best_cost_ = here;
  }
  return improving ? shape_ : best;
}

double Fitter::farthest_point() const {
  double farthest = 0.0;
  for (const PointDeviation& point : deviations_from(model_.spline(shape_), *points_)) {
    farthest = std::max(farthest, std::fabs(point.deviation));
  }
  return farthest;
}

Shape Fitter::within(double max_deviation) {
  constexpr int kBisections = 4;
  double nearest = std::numeric_limits<double>::infinity();
  for (double smoothing = kMostSmoothing; smoothing >= kLeastSmoothing; smoothing *= kSmoothingStep) {
    relax(smoothing);
    const double distance = farthest_point();
    nearest = std::min(nearest, distance);
    if (distance > max_deviation) continue;
    Shape near_enough = shape_;
    double low = smoothing;
    double high = smoothing / kSmoothingStep;
    for (int i = 0; i < kBisections; ++i) {
      const double middle = std::sqrt(low * high);
      shape_ = near_enough;
      relax(middle);
      const bool fits = farthest_point() <= max_deviation;
      (fits ? low : high) = middle;
      if (fits) near_enough = shape_;
    }
    return near_enough;
  }
  throw InfeasibleError({"",
                         "max_deviation: no smooth curve stays within " + length_text(max_deviation) +
                             " of all " + std::to_string(points_->size()) + " points",
                         "The nearest one found comes within " + length_text(nearest) + ".",
                         "a larger max_deviation, or a look at the points that lie farthest off"});
}

/// The place of the curve nearest to a point, by Newton steps from s.
double nearest_place(const ClothoidSpline& curve, Vec2 point, double s) {
  constexpr int kNewtonSteps = 50;
  for (int step = 0; step < kNewtonSteps; ++step) {
    const CenterlinePoint here = curve.at(s);
    const Vec2 tangent{math::cos(here.slope_angle), math::sin(here.slope_angle)};
    const Vec2 away = point - Vec2{here.x, here.drop};
    // Half the second derivative of the squared distance: kept away from zero where the point is a centre of
    // curvature.
    const double convexity = std::max(0.5, 1.0 + here.curvature * dot(away, perpendicular(tangent)));
    const double next = std::clamp(s + dot(away, tangent) / convexity, 0.0, curve.length());
    if (std::fabs(next - s) <= 1e-15 * curve.length()) return next;
    s = next;
  }
  return s;
}

double mean_square_deviation(const ClothoidSpline& curve, const std::vector<Vec2>& points) {
  double sum = 0.0;
  for (const PointDeviation& point : deviations_from(curve, points)) sum += point.deviation * point.deviation;
  return sum / static_cast<double>(points.size());
}

/// Whether few pieces describe the points better than the smooth curve does.
bool describes_better(const Description& pieces, const std::vector<Vec2>& points,
                      const ClothoidSpline& smooth, std::optional<Cost> smooth_cost) {
  // Points that pieces meet so closely show no other shape.
  constexpr double kExact = 1e-9;
  const double unit = smooth.length() * smooth.length();
  const Cost cost{pieces.mean_square / unit, pieces.freedom};
  if (cost.mean_square <= kExact * kExact) return true;
  if (!smooth_cost) return false;
  // Of very many points the smooth curve saw means only.
  if (points.size() > kMostFitted) smooth_cost->mean_square = mean_square_deviation(smooth, points) / unit;
  // Where points show no scatter, what is left of them is the description's own fault, and the smooth curve could
  // still come nearer: few pieces must then be clearly better.
  constexpr double kClearly = 10.0;
  const double margin = pieces.scattered ? 0.0 : math::log(kClearly);
  return cost.bayesian_score(points.size()) + margin < smooth_cost->bayesian_score(points.size());
}

}  // namespace

FittedCurve fit_clothoid_spline(const std::vector<Vec2>& points, const ProfileFit& fit) {
  Fitter fitter(points);
  if (fit.max_deviation) return {fitter.within_deviation(*fit.max_deviation), points.front()};
  ClothoidSpline smooth = fitter.validated_spline();
  if (points.size() < kFewestToValidate) return {std::move(smooth), points.front()};
  const auto description = describe_in_pieces(points, smooth);
  if (!description || !describes_better(*description, points, smooth, fitter.best_cost())) {
    return {std::move(smooth), points.front()};
  }
  return {description->profile.spline(), description->profile.start(points.front())};
}

std::vector<PointDeviation> deviations_from(const ClothoidSpline& curve, const std::vector<Vec2>& points) {
  std::vector<PointDeviation> deviations;
  const std::vector<double> lengths = rough_arc_lengths(points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double s = nearest_place(curve, points[i], curve.length() * (lengths[i] / lengths.back()));
    const CenterlinePoint place = curve.at(s);
    const Vec2 away = points[i] - Vec2{place.x, place.drop};
    const double side = dot(away, {-math::sin(place.slope_angle), math::cos(place.slope_angle)});
    deviations.push_back({s, std::copysign(norm(away), side)});
  }
  return deviations;
}

}  // namespace glissade::centerline
