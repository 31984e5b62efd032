#include "centerline/profile/profile_fit.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"

#include "centerline/profile/crowded_points.hpp"
#include "centerline/profile/profile_cost.hpp"
#include "centerline/profile/profile_description.hpp"
#include "centerline/profile/profile_interpolant.hpp"
#include "centerline/profile/profile_model.hpp"
#include "centerline/profile/profile_overhang.hpp"
#include "centerline/profile/profile_seen.hpp"
#include "centerline/profile/profile_straights.hpp"
#include "centerline/profile/rounded_points.hpp"

#include <algorithm>
#include <array>
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
constexpr int kMostSteps = 60;
constexpr int kMostHalvings = 12;
// A step that promises less than this share of what is left is not worth its while.
constexpr double kSettled = 1e-9;
// Means of neighbours stand for more points than these: they keep what the points say, at a bounded cost.
constexpr std::size_t kMostFitted = 1000;

constexpr std::size_t kMostFollowed = 2000;
constexpr std::size_t kFewestFollowed = 8;

/// @return at most so many points in the same order, each the mean of neighbours; the ends as they are
std::vector<Vec2> thinned(const std::vector<Vec2>& points, std::size_t most) {
  if (points.size() <= most) return points;
  std::vector<Vec2> means = {points.front()};
  const std::size_t inner = points.size() - 2;
  const std::size_t groups = most - 2;
  for (std::size_t group = 0; group < groups; ++group) {
    const std::size_t from = 1 + group * inner / groups;
    const std::size_t to = 1 + (group + 1) * inner / groups;
    Vec2 sum;
    for (std::size_t i = from; i < to; ++i) sum = sum + points[i];
    means.push_back(1.0 / static_cast<double>(to - from) * sum);
  }
  means.push_back(points.back());
  return means;
}

/// What points show of their noise, standard deviation [m].
double noise_of(const std::vector<Vec2>& points, const std::optional<LastPlaces>& places) {
  const auto scatter = scatter_beside_neighbours(points);
  const double rounding = places ? std::sqrt(noise_of_rounding(points, *places)) : 0.0;
  return std::max(scatter ? scatter->quarter : 0.0, rounding);
}

/// A shape that was relaxed, and what it costs.
struct Relaxed {
  Shape shape;
  Cost cost;
  double smoothing = 0.0;
};

class Fitter {
 public:
  /// @param noise  mean square of what is known to be noise [m^2]
  explicit Fitter(const std::vector<Vec2>& points, double noise = 0.0)
      : points_(&points),
        model_(thinned(points, kMostFitted)),
        shape_(model_.first_shape()),
        noise_(noise * static_cast<double>(model_.point_count()) / static_cast<double>(points.size())) {}

  [[nodiscard]] ClothoidSpline within_deviation(double max_deviation) {
    return model_.spline(within(max_deviation));
  }
  [[nodiscard]] ClothoidSpline validated_spline() { return model_.spline(validated()); }
  /// @return what the validated curve costs, or of one that follows all points the best by the Bayesian criterion on
  ///         the way there; none where points are too few
  [[nodiscard]] const std::optional<Cost>& best_cost() const { return best_cost_; }
  /// @return the same, or where noise is known that it would follow, the best beside that
  [[nodiscard]] ClothoidSpline chosen_spline() { return model_.spline(beside_noise_.value_or(shape_)); }
  /// @return whether the curve is that of the best score, which leaves some of the points to noise
  [[nodiscard]] bool leaves_noise() const { return validated_; }
  /// @return of the validated curve, where its noise can be told
  [[nodiscard]] std::optional<CurvatureRange> largest_curvature();

 private:
  void relax(double smoothing);
  [[nodiscard]] Shape moved(const std::vector<double>& move, double share) const;
  [[nodiscard]] std::optional<Cost> cost(double smoothing);
  [[nodiscard]] Shape validated();
  [[nodiscard]] Shape interpolating(double smoothing);
  [[nodiscard]] Shape nearest(double smoothing);
  [[nodiscard]] Shape beside_known_noise(double smoothing);
  [[nodiscard]] double score_of(const Cost& cost) const;
  void keep_best_cost(const Cost& cost);
  [[nodiscard]] Shape within(double max_deviation);
  [[nodiscard]] double farthest_point() const;

  const std::vector<Vec2>* points_;
  ProfileModel model_;
  Shape shape_;
  double noise_ = 0.0;      // of the points of the model
  bool validated_ = false;  // the curve is that of the best score
  bool by_noise_ = false;   // and that score is by the noise that is known
  std::vector<Relaxed> judged_;
  std::optional<CurvatureRange> stiffer_;  // of a curve that would leave some of the points to noise
  std::optional<Cost> best_cost_;
  std::optional<Shape>
      beside_noise_;  // the best beside noise that is known, where the curve follows the points
  std::optional<Cost> judged_cost_;  // of the best score
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
  const double unit = shape_.length * shape_.length;
  return Cost{data.mean_square, freedom, noise_ / unit};
}

/// By how much the curvature at a knot stands out over that of a curve without knots, times length: chords of curvature
/// hold the area of a peak, and pass over it.
double over_peak(const std::vector<double>& bend, std::size_t knot) {
  if (knot == 0 || knot + 1 == bend.size()) return 0.0;
  const double bulge = bend[knot - 1] - 2.0 * bend[knot] + bend[knot + 1];
  return std::max(0.0, std::copysign(1.0, -bend[knot]) * bulge / 12.0);
}

double Fitter::score_of(const Cost& cost) const {
  const std::size_t points = model_.point_count();
  return by_noise_ ? cost.score_beside_noise(points) : cost.validation_score(points);
}

/// Two standard deviations of the posterior that the smoothing stands for (Wahba, J. R. Stat. Soc. B 45 (1983) 133), for
/// every smoothing that cross-validation finds about as good. Where it found none the best, what it would have chosen.
std::optional<CurvatureRange> Fitter::largest_curvature() {
  constexpr double kDeviations = 2.0;
  if (!validated_) return stiffer_;
  const std::size_t points = model_.point_count();
  const auto count = static_cast<double>(points);
  const double as_good = score_of(*judged_cost_) * (1.0 + kDeviations * std::sqrt(2.0 / count));
  std::optional<CurvatureRange> range;
  for (const Relaxed& relaxed : judged_) {
    if (!(score_of(relaxed.cost) <= as_good)) continue;
    Linearized all = model_.linearized(relaxed.shape);
    model_.add_roughness(relaxed.shape, relaxed.smoothing, all);
    stiffen(all.matrix);
    if (!all.matrix.factorize()) continue;
    const double variance = relaxed.cost.beside_noise(points) / std::max(count - relaxed.cost.freedom, 1.0);
    const std::vector<double>& bend = relaxed.shape.bend;
    const auto sharpest = std::max_element(bend.begin(), bend.end(),
                                           [](double a, double b) { return std::fabs(a) < std::fabs(b); });
    std::vector<double> unit(all.matrix.size(), 0.0);
    const auto knot = static_cast<std::size_t>(sharpest - bend.begin());
    unit[kFirstBend + knot] = 1.0;
    all.matrix.solve_forward(unit);
    double spread = 0.0;
    for (const double part : unit) spread += part * part;
    const double most = std::fabs(*sharpest) / relaxed.shape.length;
    const double more = kDeviations * std::sqrt(variance * spread) / relaxed.shape.length;
    const double over = over_peak(bend, knot) / relaxed.shape.length;
    const CurvatureRange here{std::max(0.0, most - over - more), most + more};
    range = range
                ? CurvatureRange{std::min(range->least, here.least), std::max(range->greatest, here.greatest)}
                : here;
  }
  return range;
}

/// The shape of the best score over all of the range: a score with more than one valley is the rule where a
/// profile has more than one length of wave. Where the curve of the most freedom that the score can judge still
/// finds what no noise shows, the points tell more than the score: then the one that goes on to follow them.
Shape Fitter::validated() {
  const std::size_t points = model_.point_count();
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::optional<Relaxed> best;
  double best_score = infinity;
  bool follow = true;
  double smoothing = kMostSmoothing;
  for (; smoothing >= kLeastSmoothing; smoothing *= kSmoothingStep) {
    relax(smoothing);
    // Every point gives one equation, the last one two, the first one none.
    const std::optional<Cost> here = points < kFewestToValidate ? std::nullopt : cost(smoothing);
    if (!here || !here->tells(points)) break;
    keep_best_cost(*here);
    judged_.push_back({shape_, *here, smoothing});
    const double score = here->validation_score(points);
    if (score < best_score) {
      best = {shape_, *here, smoothing};
      best_score = score;
      follow = true;
    } else if (std::isfinite(score) || !follow) {
      follow = here->finds_more_than_noise(best->cost, points);
    }
  }
  if (best && !follow) {
    best_cost_ = best->cost;
    judged_cost_ = best->cost;
    shape_ = best->shape;
    validated_ = true;
    return best->shape;
  }
  if (best && noise_ > 0.0) {
    // Pieces are cut beside the curve that follows the points: another would hide small jumps.
    const Shape stiff = shape_;
    const std::optional<Cost> cost = best_cost_;
    beside_noise_ = beside_known_noise(smoothing);
    judged_cost_ = best_cost_;
    shape_ = stiff;
    best_cost_ = cost;
  }
  if (best && !beside_noise_) {
    const std::vector<double>& bend = best->shape.bend;
    double most = 0.0;
    for (const double here : bend) most = std::max(most, std::fabs(here) / best->shape.length);
    stiffer_ = CurvatureRange{most, most};
  }
  if (smoothing < kLeastSmoothing) return shape_;
  return model_.can_interpolate() ? interpolating(smoothing) : nearest(smoothing);
}

/// The shape of the best score by the noise that is known, where cross-validation would go on to follow the points: that
/// much of them is no shape.
Shape Fitter::beside_known_noise(double smoothing) {
  constexpr double kGoneBy = 1.5;  // taste: less smoothing than at such a score only follows noise
  by_noise_ = true;
  validated_ = true;
  double least = std::numeric_limits<double>::infinity();
  for (const Relaxed& relaxed : judged_) least = std::min(least, score_of(relaxed.cost));
  for (; smoothing >= kLeastSmoothing; smoothing *= kSmoothingStep) {
    relax(smoothing);
    const std::optional<Cost> here = cost(smoothing);
    if (!here || score_of(*here) > kGoneBy * least) break;
    judged_.push_back({shape_, *here, smoothing});
    least = std::min(least, score_of(*here));
  }
  const auto best = std::min_element(judged_.begin(), judged_.end(), [&](const Relaxed& a, const Relaxed& b) {
    return score_of(a.cost) < score_of(b.cost);
  });
  shape_ = best->shape;
  best_cost_ = best->cost;
  return shape_;
}

/// The shape through all points, by less and less smoothing from the one that was relaxed for `smoothing`.
Shape Fitter::interpolating(double smoothing) {
  while (true) {
    const std::optional<Cost> here = best_cost_ ? cost(smoothing) : std::nullopt;
    if (here && here->tells(model_.point_count())) keep_best_cost(*here);
    smoothing *= kSmoothingStep;
    if (smoothing < kLeastSmoothing) return shape_;
    relax(smoothing);
  }
}

/// The same where there are more points than the curve can follow: with less smoothing than what the points ask for
/// it would swing between them.
Shape Fitter::nearest(double smoothing) {
  const auto points = static_cast<double>(model_.point_count());
  Shape best = shape_;
  double least = std::numeric_limits<double>::infinity();
  while (true) {
    const std::optional<Cost> here = cost(smoothing);
    if (!here) return best;
    keep_best_cost(*here);
    const double score = here->mean_square / math::pow(1.0 - here->freedom / points, 2);
    if (score >= least) return best;
    least = score;
    best = shape_;
    smoothing *= kSmoothingStep;
    if (smoothing < kLeastSmoothing) return best;
    relax(smoothing);
  }
}

void Fitter::keep_best_cost(const Cost& cost) {
  const std::size_t points = model_.point_count();
  if (!best_cost_ || cost.bayesian_score(points) < best_cost_->bayesian_score(points)) best_cost_ = cost;
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
  throw InfeasibleError(
      {"",
       "max_deviation: no smooth curve was found within " + length_text(max_deviation) + " of all " +
           std::to_string(points_->size()) + " points",
       "Of the curves tried, from stiff to free, the nearest comes within " + length_text(nearest) + ".",
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
                      const ClothoidSpline& smooth, std::optional<Cost> smooth_cost, double noise) {
  // Points that pieces meet so closely show no other shape.
  constexpr double kExact = 1e-9;
  const double unit = smooth.length() * smooth.length();
  const Cost cost{pieces.mean_square / unit, pieces.freedom, noise / unit};
  if (cost.mean_square <= kExact * kExact) return true;
  if (!smooth_cost || !std::isfinite(cost.validation_score(points.size()))) return false;
  // Of very many points the smooth curve saw means only.
  if (points.size() > kMostFitted) {
    smooth_cost->mean_square = mean_square_deviation(smooth, points) / unit;
    smooth_cost->noise = noise / unit;
  }
  // Where points show no scatter, what is left of them is the description's own fault, and the smooth curve could
  // still come nearer: few pieces must then be clearly better.
  constexpr double kClearly = 10.0;
  const double margin = pieces.scattered ? 0.0 : math::log(kClearly);
  // What no drawing has, jumps between bends of any kind, is as dear then as among pieces where points scatter: a wave cut into
  // such is met by fewer numbers than a smooth curve takes, with a curvature that is wrong at every cut.
  const auto count = static_cast<double>(points.size());
  const double unlikely = pieces.scattered ? pieces.unlikely * math::log(count) / count : 0.0;
  return cost.bayesian_score(points.size()) + unlikely + margin < smooth_cost->bayesian_score(points.size());
}

/// How far a smooth curve may pass a profile between its knots [m]. Where curvature is linear from knot to knot, a
/// change of its slope by c leaves c h^3/384 in the middle of two stretches of length h, the error of a cubic spline;
/// towards the ends, which nothing holds, it is several times as large.
double missed_between(const ClothoidSpline& curve) {
  constexpr double kWithEnds = 10.0 / 384.0;
  double most = 0.0;
  const std::vector<ClothoidSegment>& segments = curve.segments();
  for (std::size_t k = 0; k + 1 < segments.size(); ++k) {
    const ClothoidSegment& here = segments[k];
    const ClothoidSegment& next = segments[k + 1];
    const double change = (next.exit_curvature - next.entry_curvature) / next.length -
                          (here.exit_curvature - here.entry_curvature) / here.length;
    const double stretch = 0.5 * (here.length + next.length);
    most = std::max(most, kWithEnds * std::fabs(change) * stretch * stretch * stretch);
  }
  return most;
}

FittedCurve smooth_curve(ClothoidSpline curve, Vec2 start) {
  const double between = missed_between(curve);
  return {std::move(curve), start, between, 0.0, {}};
}

double largest_curvature_of(const ClothoidSpline& curve) {
  double most = 0.0;
  for (const ClothoidSegment& segment : curve.segments())
    most = std::max({most, std::fabs(segment.entry_curvature), std::fabs(segment.exit_curvature)});
  return most;
}

/// The range with the curve's own largest curvature in it.
std::optional<CurvatureRange> widened(std::optional<CurvatureRange> range, const ClothoidSpline& curve) {
  if (!range) return range;
  const double own = largest_curvature_of(curve);
  return CurvatureRange{std::min(range->least, own), std::max(range->greatest, own)};
}

/// A curve found, and the few pieces that it consists of, if it does.
struct Found {
  FittedCurve fitted;
  std::optional<Description> description;
  std::optional<CurvatureRange>
      beside{};  // of a smooth curve, where the pieces are such that it may be what was built

  [[nodiscard]] bool described() const { return description.has_value(); }
};

Found smooth_or_described(const std::vector<Vec2>& points, const std::optional<LastPlaces>& places) {
  const double noise = places ? noise_of_rounding(points, *places) : 0.0;
  Fitter fitter(points, noise);
  ClothoidSpline smooth = fitter.validated_spline();
  if (points.size() >= kFewestToValidate) {
    auto description = describe_in_pieces(points, smooth, places);
    if (description && describes_better(*description, points, smooth, fitter.best_cost(), noise)) {
      const Vec2 start = description->profile.start(points.front());
      const bool unlikely = description->unlikely > 0.0;
      Found found{{description->profile.spline(), start, 0.0, 0.0, {}}, std::move(description)};
      if (unlikely && fitter.leaves_noise()) found.beside = fitter.largest_curvature();
      return found;
    }
  }
  if (fitter.leaves_noise()) smooth = fitter.chosen_spline();
  FittedCurve fitted = smooth_curve(std::move(smooth), points.front());
  if (fitter.leaves_noise()) {
    // Where that is the curve that was meant the points do not mind.
    constexpr double kNoWorse = 1.02;  // taste: of the mean square, as little as one freedom of a hundred
    ClothoidSpline finer = without_chords(fitted.curve);
    std::vector<Vec2> seen = points;
    for (Vec2& point : seen) point = point - points.front();
    if (mean_square_deviation(finer, seen) <= kNoWorse * mean_square_deviation(fitted.curve, seen))
      fitted.curve = std::move(finer);
  }
  fitted.largest_curvature = widened(fitter.largest_curvature(), fitted.curve);
  return {std::move(fitted), {}};
}

/// What points leave open of the largest curvature of a curve found.
std::optional<CurvatureRange> curvature_range(const Found& found, const std::vector<Vec2>& points,
                                              const std::optional<LastPlaces>& places) {
  if (!found.described()) return found.fitted.largest_curvature;
  if (found.description->scattered) {
    const auto range = widened(largest_curvature_of(*found.description, points, places), found.fitted.curve);
    if (!range || !found.beside) return range;
    return CurvatureRange{std::min(range->least, found.beside->least),
                          std::max(range->greatest, found.beside->greatest)};
  }
  std::vector<Vec2> seen = points;
  for (Vec2& point : seen) point = point - found.fitted.start;
  std::vector<double> stations;
  for (const PointDeviation& point : deviations_from(found.fitted.curve, seen))
    stations.push_back(point.arc_length);
  constexpr double kRounding = 1e-12;  // rounding: of pieces and their places
  const bool met = std::sqrt(found.description->mean_square) <= kRounding * found.fitted.curve.length();
  return widened(largest_curvature_unseen(found.description->profile, stations, met), found.fitted.curve);
}

/// The largest curvature of a curve that was led through points, but for the outermost stretches between them.
double largest_curvature_inside(const ClothoidSpline& through, std::size_t points) {
  constexpr std::size_t kOutermost = 3;  // theory: one polynomial, which nothing holds at its end
  const std::vector<ClothoidSegment>& segments = through.segments();
  const std::size_t left_out = kOutermost * segments.size() / (points - 1);
  double most = 0.0;
  for (std::size_t k = left_out; k + left_out < segments.size(); ++k)
    most = std::max({most, std::fabs(segments[k].entry_curvature), std::fabs(segments[k].exit_curvature)});
  return most;
}

/// What exact points leave open of the largest curvature of the curve through them: by how much every second one of them has
/// another. Where that is much and the curve is sharpest at an end, it may be so nowhere else.
/// @param breaks  whether curvature breaks somewhere
/// @return none where those are too few to tell
std::optional<CurvatureRange> range_by_half(const ClothoidSpline& through, const std::vector<Vec2>& points,
                                            bool breaks) {
  // Twice as dense, splines of fifth degree come nearer by a factor of sixteen, where points are few for their waves by less,
  // and beside a jump their curvature swings as far.
  const double left = breaks ? 1.0 : 0.25;
  std::vector<Vec2> half;
  for (std::size_t i = 0; i < points.size(); i += 2) half.push_back(points[i]);
  if (half.size() < kFewestFollowed) return {};
  const auto other = follow_points(half);
  if (!other) return {};
  const double most = largest_curvature_of(through);
  const double open = left * std::fabs(most - largest_curvature_of(other->curve));
  const double inside = largest_curvature_inside(through, points.size());
  const double inside_open = left * std::fabs(inside - largest_curvature_inside(other->curve, half.size()));
  // An end that is sharper than all the rest is believed where points are dense.
  constexpr double kDense = 0.002;  // measured: of waves from some fourteen points each
  const bool end_alone = inside * (1.0 + kOpenRadius) < most && std::max(inside_open, open) > kDense * most;
  double least = most - open;
  if (open > kOpenRadius * most || end_alone) least = std::min(least, inside - inside_open);
  return CurvatureRange{std::max(0.0, least), most + open};
}

constexpr double kPlainly = 3.0;     // more than the points' own noise
constexpr double kFewPieces = 3e-8;  // pieces, as near as this, tell more than a curve through all points

/// A curve through the points beside the curve found.
struct Comparison {
  double missed = 0.0;       // by the curve found, in the root of the mean square, over its length
  double noise = 0.0;        // of the points, over the same
  double least_noise = 0.0;  // what may be no more than that
  double least_told =
      0.0;  // what pieces may leave of exact points, over the same: less is no evidence against them
  bool breaks = false;    // neighbours foretell each other but in some places
  bool foretold = false;  // every second point foretells the others, everywhere
};

Comparison compared(const FollowedProfile& followed, const Found& found, const std::vector<Vec2>& points,
                    const std::optional<LastPlaces>& places) {
  // Pieces that come so near are what was built, whatever the points are.
  constexpr double kBuilt = 1e-5;
  // Twice as dense, splines of fifth degree come nearer by a factor of sixteen to sixty-four, where curvature jumps by four.
  constexpr double kLeft = 0.125;
  const double length = found.fitted.curve.length();
  std::vector<Vec2> seen = points;
  for (Vec2& point : seen) point = point - found.fitted.start;
  // measured: of waves it is a tenth, of straights and arcs rounding
  constexpr double kForetold = 1e-3;
  Comparison result;
  result.missed = std::sqrt(mean_square_deviation(found.fitted.curve, seen)) / length;
  result.least_told = kBuilt;
  const auto count = static_cast<double>(std::min(points.size(), kMostFollowed));
  result.noise = std::sqrt(followed.cost.mean_square) / (1.0 - followed.cost.freedom / count);
  const double rounding = places ? std::sqrt(noise_of_rounding(points, *places)) / length : 0.0;
  result.noise = std::max(result.noise, rounding);
  if (!followed.exact) return result;
  // What a smooth curve leaves of points that it would follow is its own stiffness.
  const auto left = scatter_beside_neighbours(points);
  if (left) result.noise = std::clamp(left->all / length, rounding, std::max(result.noise, rounding));
  if (places) return result;
  if (left) {
    result.least_noise = std::min(result.noise, left->quarter / length);
    result.breaks = followed.missed_by_half && left->quarter < kForetold * *followed.missed_by_half;
  }
  if (followed.missed_by_half) {
    constexpr double kNoneBetween = 1e-9;  // measured: of waves of a hundred points each and more
    constexpr double kRounding = 1e-14;    // rounding: of coordinates, over the length
    const bool breaks = result.breaks && left->all > kRounding * length;
    result.foretold = !breaks && *followed.missed_by_half <= kNoneBetween * length;
    const double told = kLeft * std::max(*followed.missed_by_half, followed.between) / length;
    result.least_told = std::clamp(told, kFewPieces, kBuilt);
  }
  return result;
}

/// Whether a curve through the points holds what the curve found leaves out, or leaves less open between them.
bool follows_better(const FollowedProfile& followed, const Found& found, const Comparison& beside,
                    const std::vector<Vec2>& points, const std::optional<LastPlaces>& places) {
  constexpr double kMet = 1e-8;
  constexpr double kLittleOpen = 1e-7;
  const double length = found.fitted.curve.length();
  const double open = found.fitted.between;
  if (followed.recovered && !places)
    return found.described() ? beside.missed > kFewPieces : open > kLittleOpen * length;
  const bool leaves_less_open = followed.between < open && open > kLittleOpen * length;
  if (!found.described() && followed.exact && !places && leaves_less_open) return true;
  return points.size() >= kFewestToValidate &&
         beside.missed > std::max(kPlainly * beside.noise, found.described() ? beside.least_told : kMet);
}

/// Whether a smooth curve of hardly more numbers meets points that scatter as well as pieces do that no drawing has: a wave
/// cut into such is met by them, with a curvature that is wrong at the cuts.
bool follows_as_well(const FollowedProfile& followed, const Found& found, const Comparison& beside,
                     const std::vector<Vec2>& points) {
  constexpr double kDrawn = 2.0;       // theory: what one bend costs, as drawings have them
  constexpr double kHardlyMore = 1.3;  // measured: of waves 1.05 to 1.25, of what was drawn from 1.35 on
  constexpr double kAsWell = 1.02;     // taste: of what pieces leave
  if (!found.described() || !found.description->scattered || followed.exact) return false;
  const Description& pieces = *found.description;
  if (pieces.unlikely <= kDrawn) return false;
  if (followed.cost.freedom > kHardlyMore * (pieces.freedom + pieces.unlikely)) return false;
  std::vector<Vec2> seen = points;
  for (Vec2& point : seen) point = point - followed.start;
  const double left = std::sqrt(mean_square_deviation(followed.curve, seen));
  return left <= kAsWell * beside.missed * found.fitted.curve.length();
}

/// Whether pieces leave more of exact points than a drawing does, but less than a curve through them may be off.
bool unsure(const FollowedProfile& followed, const Found& found, const Comparison& beside,
            const std::optional<LastPlaces>& places) {
  return found.described() && followed.exact && !places &&
         beside.missed > std::max(kFewPieces, kPlainly * beside.least_noise);
}

/// The range widened by as much as another curve has another largest curvature, to both sides of the two, and by some share.
CurvatureRange range_beside(const std::optional<CurvatureRange>& range, const ClothoidSpline& curve,
                            const ClothoidSpline& other) {
  const double own = largest_curvature_of(curve);
  const double most = largest_curvature_of(other);
  constexpr double kShare =
      0.15;  // measured: pieces that leave something of exact points are off by up to this
  const double open = std::max(std::fabs(own - most), kShare * own);
  const CurvatureRange known = range.value_or(CurvatureRange{own, own});
  return {std::max(0.0, std::min(known.least, std::min(own, most) - open)),
          std::max(known.greatest, std::max(own, most) + open)};
}

/// The range less what a curve through exact points rules out: of pieces that no drawing has those that lie between points
/// could be as sharp as one likes, though every second one foretells the others.
std::optional<CurvatureRange> within_foretold(const std::optional<CurvatureRange>& range,
                                              const ClothoidSpline& curve, const ClothoidSpline& through,
                                              const std::vector<Vec2>& points) {
  const auto foretold = widened(range_by_half(through, points, false), curve);
  if (!range || !foretold) return range;
  // The last point may be foretold by none.
  if (foretold->greatest > (1.0 + kOpenRadius) * foretold->least) return range;
  return CurvatureRange{std::max(range->least, foretold->least),
                        std::min(range->greatest, foretold->greatest)};
}

/// Of the ways to describe points the best.
FittedCurve best_of_ways(const std::vector<Vec2>& points, const std::optional<LastPlaces>& places) {
  Found found = smooth_or_described(points, places);
  if (places) found.fitted.last_place = std::max(places->x, places->y);
  std::vector<Vec2> to_follow = thinned(points, kMostFollowed);
  auto followed = points.size() < kFewestFollowed ? std::nullopt : follow_points(to_follow);
  const Comparison beside = followed ? compared(*followed, found, points, places) : Comparison{};
  if (!followed || !(follows_better(*followed, found, beside, points, places) ||
                     follows_as_well(*followed, found, beside, points))) {
    found.fitted.largest_curvature = curvature_range(found, points, places);
    if (beside.foretold && found.described() && found.description->unlikely > 0.0) {
      found.fitted.largest_curvature =
          within_foretold(found.fitted.largest_curvature, found.fitted.curve, followed->curve, to_follow);
    }
    if (followed && unsure(*followed, found, beside, places)) {
      found.fitted.largest_curvature =
          range_beside(found.fitted.largest_curvature, found.fitted.curve, followed->curve);
    }
    return std::move(found.fitted);
  }
  std::optional<CurvatureRange> range;
  if (!followed->recovered) {
    if (followed->exact && !places) range = range_by_half(followed->curve, to_follow, beside.breaks);
    if (!range) range = widened(curvature_range(found, points, places), followed->curve);
  }
  return {std::move(followed->curve), followed->start, followed->between, found.fitted.last_place, range};
}

// Less is rounding, or noise beside a vertical start; more, that the order of the points is lost in their noise.
constexpr double kOverhangs = 0.02;  // taste: [rad]

/// Whether a curve turns much as soon as it begins, or just before it ends: led to one of many points that lie within their
/// noise of each other, it comes to the others so.
bool bends_at_once(const ClothoidSpline& curve, double noise) {
  constexpr double kWithin = 4.0;  // taste: standard deviations of points
  constexpr double kMuch = 0.2;    // taste: [rad]
  const double length = curve.length();
  const double near = std::min(kWithin * noise, 0.5 * length);
  constexpr int kLooks = 16;  // taste: places in between, for what turns there and back
  for (int i = 1; i <= kLooks; ++i) {
    const double s = near * i / kLooks;
    if (std::fabs(curve.slope_angle(s) - curve.slope_angle(0.0)) > kMuch) return true;
    if (std::fabs(curve.slope_angle(length - s) - curve.slope_angle(length)) > kMuch) return true;
  }
  return false;
}

/// Points that may lead a curve astray, as some lie within their noise of each other.
class CrowdedPoints {
 public:
  CrowdedPoints(const std::vector<Vec2>& points, const std::optional<LastPlaces>& places)
      : points_(points), places_(places), noise_(noise_of(points, places)) {
    if (!lose_order(points)) return;
    is_crowded_ = true;
    const std::vector<Vec2> back(points.rbegin(), points.rend());
    at_ends_ = lost_from(points, 0, kCrowd * noise_) > 1 || lost_from(back, 0, kCrowd * noise_) > 1;
  }

  /// The curve, or another one if it overhangs, bends at once at an end or leaves more than noise beside a crowd: to the means of
  /// crowds at the ends, then to those of wider and wider ones all along, until one does not.
  [[nodiscard]] FittedCurve led_aright(FittedCurve found) const {
    if (!is_crowded_) return found;
    constexpr std::array kReaches = {2.0, 4.0, 8.0};  // taste: standard deviations
    FittedCurve best = std::move(found);
    double least = left_by(best);
    const auto keep_better = [&](const std::vector<Vec2>& told) {
      if (told.size() >= points_.size() || told.size() < kFewestToValidate) return;
      FittedCurve next = best_of_ways(told, places_);
      const double left = left_by(next);
      if (left >= least) return;
      least = left;
      best = std::move(next);
    };
    if (least > kNoMore * noise_) keep_better(with_ends_told(points_, kCrowd * noise_));
    for (const double reach : kReaches) {
      if (least <= kNoMore * noise_) break;
      keep_better(with_order_told(points_, reach * noise_, true));
    }
    return best;
  }

 private:
  static constexpr double kCrowd = 1.5;    // taste: standard deviations of points within which a crowd lies
  static constexpr double kNoMore = 1.15;  // taste: than the noise of neighbours

  /// What a curve leaves, in the root of the mean square [m]; 0 where nothing can lead it astray, no bound where something did.
  [[nodiscard]] double left_by(const FittedCurve& curve) const {
    const bool overhangs = beyond_vertical(curve.curve) > kOverhangs;
    if (overhangs || (at_ends_ && bends_at_once(curve.curve, noise_)))
      return std::numeric_limits<double>::infinity();
    if (!at_ends_) return 0.0;
    std::vector<Vec2> seen = points_;
    for (Vec2& point : seen) point = point - curve.start;
    return std::sqrt(mean_square_deviation(curve.curve, seen));
  }

  const std::vector<Vec2>& points_;
  const std::optional<LastPlaces>& places_;
  double noise_;
  bool is_crowded_ = false;
  bool at_ends_ = false;
};

}  // namespace

FittedCurve fit_clothoid_spline(const std::vector<Vec2>& points, const ProfileFit& fit) {
  if (fit.max_deviation) {
    Fitter fitter(points);
    return smooth_curve(fitter.within_deviation(*fit.max_deviation), points.front());
  }
  if (const auto straights = straights_through(points)) {
    return {straights->profile.spline(), straights->profile.start(points.front()), 0.0, 0.0,
            straights->largest};
  }
  const std::optional<LastPlaces> places = last_places(points);
  return not_overhanging(CrowdedPoints(points, places).led_aright(best_of_ways(points, places)));
}

std::vector<PointDeviation> deviations_from(const ClothoidSpline& curve, const std::vector<Vec2>& points) {
  std::vector<PointDeviation> deviations;
  const std::vector<double> lengths = rough_arc_lengths(points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto deviation_from = [&](double guess) {
      const double s = nearest_place(curve, points[i], guess);
      const CenterlinePoint place = curve.at(s);
      const Vec2 away = points[i] - Vec2{place.x, place.drop};
      const double side = dot(away, {-math::sin(place.slope_angle), math::cos(place.slope_angle)});
      return PointDeviation{s, std::copysign(norm(away), side)};
    };
    PointDeviation nearest = deviation_from(curve.length() * (lengths[i] / lengths.back()));
    if (i > 0) {
      // On narrow waves the guess by the polygon may lie on the next flank.
      const double chord = norm(points[i] - points[i - 1]);
      const PointDeviation ahead =
          deviation_from(std::min(curve.length(), deviations.back().arc_length + chord));
      if (std::fabs(ahead.deviation) < std::fabs(nearest.deviation)) nearest = ahead;
    }
    deviations.push_back(nearest);
  }
  return deviations;
}

}  // namespace glissade::centerline
