#include "profile_fit.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/number_text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>

#include <boost/math/quadrature/gauss.hpp>

namespace glissade {
namespace {

// The smoothing is lowered from the first to the last in these steps: from "an arc" to "through every point"
// for points that are exact to some 1e-9 of the length.
constexpr double kMostSmoothing = 1.0;
constexpr double kLeastSmoothing = 1e-20;
constexpr double kSmoothingStep = 0.31622776601683794;
// Plain cross-validation now and then takes noise for shape; counting each freedom of the curve this often is
// the usual remedy (Cummins, Filloon and Nychka, J. Am. Stat. Assoc. 96 (2001) 233).
constexpr double kPriceOfFreedom = 1.4;
// It needs more points than the curve has freedom; beyond this share it tells rounding.
constexpr double kMostFreedom = 0.65;
constexpr std::size_t kFewestToValidate = 8;
// The search for the best score ends when it has not become better over this many steps.
constexpr int kMostStepsUphill = 8;
constexpr int kMostSteps = 60;
constexpr int kMostHalvings = 12;
constexpr std::size_t kCoarseChords = 24;
constexpr unsigned kGaussPoints = 6;

/// @return for each point its arc length along a polygon through those points that lie well apart: the way
/// through all of them grows with their noise.
std::vector<double> rough_arc_lengths(const std::vector<Vec2>& points) {
  constexpr double kLeastChord = 0.01;
  double reach = 0.0;
  for (const Vec2& point : points) reach = std::max(reach, norm(point - points.front()));
  std::vector<double> lengths(points.size(), 0.0);
  std::size_t from = 0;
  for (std::size_t to = 1; to < points.size(); ++to) {
    const Vec2 chord = points[to] - points[from];
    const bool last = to + 1 == points.size();
    if (norm(chord) < kLeastChord * reach && !last) continue;
    for (std::size_t i = from + 1; i <= to; ++i) {
      const double along = norm(chord) > 0.0 ? dot(points[i] - points[from], chord) / norm(chord) : 0.0;
      lengths[i] = lengths[from] + std::clamp(along, 0.0, norm(chord));
    }
    from = to;
  }
  return lengths;
}

Vec2 perpendicular(Vec2 a) {
  return {-a.y, a.x};
}

/// A dense symmetric positive definite matrix, lower triangle, row by row.
class SymmetricMatrix {
 public:
  explicit SymmetricMatrix(std::size_t size) : size_(size), values_(size * size, 0.0) {}

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] double& at(std::size_t row, std::size_t column) { return values_[row * size_ + column]; }
  [[nodiscard]] double at(std::size_t row, std::size_t column) const { return values_[row * size_ + column]; }

  /// Adds to the element of this row and column, and so to that of this column and row.
  void add(std::size_t row, std::size_t column, double value) {
    at(std::max(row, column), std::min(row, column)) += value;
  }

  /// Replaces the matrix by its Cholesky factor.
  /// @return false if it is not positive definite
  [[nodiscard]] bool factorize() {
    for (std::size_t column = 0; column < size_; ++column) {
      for (std::size_t row = column; row < size_; ++row) {
        double sum = at(row, column);
        for (std::size_t k = 0; k < column; ++k) sum -= at(row, k) * at(column, k);
        if (row > column) {
          at(row, column) = sum / at(column, column);
        } else if (sum > 0.0) {
          at(row, row) = std::sqrt(sum);
        } else {
          return false;
        }
      }
    }
    return true;
  }

  /// Solves factor * x = b in place, for a factorized matrix.
  void solve_forward(std::vector<double>& b) const {
    for (std::size_t row = 0; row < size_; ++row) {
      for (std::size_t k = 0; k < row; ++k) b[row] -= at(row, k) * b[k];
      b[row] /= at(row, row);
    }
  }

  /// Solves transposed factor * x = b in place.
  void solve_backward(std::vector<double>& b) const {
    for (std::size_t row = size_; row-- > 0;) {
      for (std::size_t k = row + 1; k < size_; ++k) b[row] -= at(k, row) * b[k];
      b[row] /= at(row, row);
    }
  }

 private:
  std::size_t size_;
  std::vector<double> values_;
};

/// The unknowns: a curve of length `length` whose curvature times length is `bend` at the knots, linear
/// between. The place on it is u = s / length, so that the shape does not depend on the length.
struct Shape {
  double entry = 0.0;  // slope angle at the start
  double length = 0.0;
  std::vector<double> bend;
};

/// Order of the unknowns in a vector: entry slope angle, length, bends.
constexpr std::size_t kEntry = 0;
constexpr std::size_t kLength = 1;
constexpr std::size_t kFirstBend = 2;

/// What a point sees of the unknowns: every complete knot before it in three ways, and four of its own.
constexpr std::size_t kSight = 7;
enum : std::size_t { kByX, kByDrop, kByArea, kOwnLeft, kOwnRight, kOwnEntry, kOwnLength };
using Sight = std::array<double, kSight>;

/// The sum of squares about one shape, to second order without the curvature of its terms.
struct Linearized {
  explicit Linearized(std::size_t unknowns) : matrix(unknowns), gradient(unknowns, 0.0) {}
  SymmetricMatrix matrix;        // of the mean of (distance/scale)^2 / 2
  std::vector<double> gradient;  // of the same
  double mean_square = 0.0;      // of distance/scale
  double max_distance = 0.0;     // [m]
};

class Fitter {
 public:
  explicit Fitter(const std::vector<Vec2>& points);

  [[nodiscard]] Shape shape_for(const ProfileFit& fit);
  [[nodiscard]] ClothoidSpline spline(const Shape& shape) const;

 private:
  struct Local {
    Vec2 position;
    Vec2 tangent;
    Vec2 turned;  // integral of the perpendicular of the tangent over the knot interval so far, times length
    Vec2 left_turned;  // the same, weighted by what the interval's left bend has turned
    Vec2 right_turned;
  };

  [[nodiscard]] std::size_t unknowns() const { return kFirstBend + knots_.size(); }
  [[nodiscard]] std::size_t interval_of(double u) const;
  [[nodiscard]] double width(std::size_t interval) const { return knots_[interval + 1] - knots_[interval]; }
  [[nodiscard]] double area_before(std::size_t knot) const { return knot == 0 ? 0.0 : 0.5 * width(knot - 1); }
  void place_knots();
  void start_from_chords();
  void lay_out(const Shape& shape);
  [[nodiscard]] double slope_at(const Shape& shape, std::size_t interval, double local) const;
  [[nodiscard]] Local local_at(const Shape& shape, std::size_t interval, double u) const;
  void project(const Shape& shape);
  [[nodiscard]] Linearized linearized(const Shape& shape);
  void add_interval(std::size_t interval, const std::array<Sight, kSight>& gram, const Sight& moment,
                    Linearized& sum) const;
  [[nodiscard]] double roughness(const Shape& shape) const;
  void add_roughness(const Shape& shape, double smoothing, Linearized& sum) const;
  void relax(double smoothing);
  [[nodiscard]] double validation_score(double smoothing);
  [[nodiscard]] Shape validated();
  [[nodiscard]] Shape within(double max_deviation);

  const std::vector<Vec2>* points_;
  std::vector<double> places_;  // u of each point
  std::vector<double> knots_;   // u
  double scale_ = 0.0;          // length of the polygon through the points
  Shape shape_;
  // Of the shape laid out last, at each knot.
  std::vector<Vec2> knot_positions_;
  std::vector<double> knot_slopes_;
  std::vector<std::vector<Vec2>> knot_changes_;  // of position by each bend
};

Fitter::Fitter(const std::vector<Vec2>& points) : points_(&points), places_(points.size(), 0.0) {
  for (std::size_t i = 1; i < points.size(); ++i)
    places_[i] = places_[i - 1] + norm(points[i] - points[i - 1]);
  scale_ = places_.back();
  for (double& place : places_) place /= scale_;
  place_knots();
  start_from_chords();
}

void Fitter::place_knots() {
  const std::size_t gaps = places_.size() - 1;
  const std::size_t count = std::min<std::size_t>(gaps, kMostProfileKnots - 1);
  // Points may cluster; knots nearer than this would only add rounding.
  const double least_width = 0.05 / static_cast<double>(count);
  knots_ = {0.0};
  for (std::size_t k = 1; k < count; ++k) {
    const double place = places_[k * gaps / count];
    if (place - knots_.back() >= least_width && 1.0 - place >= least_width) knots_.push_back(place);
  }
  knots_.push_back(1.0);
}

/// A first shape from the directions of a few chords: near enough for the iteration, hardly touched by noise.
void Fitter::start_from_chords() {
  const std::vector<Vec2>& points = *points_;
  const std::size_t chords = std::min(kCoarseChords, points.size() - 1);
  std::vector<double> middles;
  std::vector<double> slopes;
  std::size_t from = 0;
  for (std::size_t k = 1; k <= chords; ++k) {
    const double goal = static_cast<double>(k) / static_cast<double>(chords);
    std::size_t to = from + 1;
    while (to + 1 < points.size() && places_[to] < goal) ++to;
    const Vec2 chord = points[to] - points[from];
    const double slope = std::atan2(chord.y, chord.x);
    const double before = slopes.empty() ? slope : slopes.back();
    slopes.push_back(before + std::remainder(slope - before, 2.0 * std::numbers::pi));
    middles.push_back(0.5 * (places_[from] + places_[to]));
    from = to;
    if (from + 1 == points.size()) break;
  }
  const auto slope_at_place = [&](double u) {
    if (slopes.size() == 1) return slopes.front();
    const auto next = std::upper_bound(middles.begin() + 1, middles.end() - 1, u);
    const auto i = static_cast<std::size_t>(next - middles.begin());
    const double share = (u - middles[i - 1]) / (middles[i] - middles[i - 1]);
    return slopes[i - 1] + share * (slopes[i] - slopes[i - 1]);
  };
  shape_.entry = slope_at_place(0.0);
  shape_.length = scale_;
  const double reach = 1.0 / static_cast<double>(chords);
  for (const double knot : knots_) {
    const double low = std::max(0.0, knot - reach);
    const double high = std::min(1.0, knot + reach);
    shape_.bend.push_back((slope_at_place(low) - slope_at_place(high)) / (high - low));
  }
}

std::size_t Fitter::interval_of(double u) const {
  const auto next = std::upper_bound(knots_.begin() + 1, knots_.end() - 1, u);
  return static_cast<std::size_t>(next - knots_.begin()) - 1;
}

double Fitter::slope_at(const Shape& shape, std::size_t interval, double local) const {
  const double left = shape.bend[interval];
  const double change = shape.bend[interval + 1] - left;
  return knot_slopes_[interval] - local * (left + 0.5 * change * local / width(interval));
}

Fitter::Local Fitter::local_at(const Shape& shape, std::size_t interval, double u) const {
  using Rule = boost::math::quadrature::gauss<double, kGaussPoints>;
  const double local = u - knots_[interval];
  const double half = 0.5 * local;
  Local sum;
  const auto add = [&](double offset, double weight) {
    const double t = half + offset;
    const double slope = slope_at(shape, interval, t);
    const Vec2 tangent{std::cos(slope), std::sin(slope)};
    const double right_area = 0.5 * t * t / width(interval);
    const double left_area = area_before(interval) + t - right_area;
    const double weighted = half * weight * shape.length;
    sum.position = sum.position + weighted * tangent;
    sum.turned = sum.turned + weighted * perpendicular(tangent);
    sum.left_turned = sum.left_turned + (weighted * left_area) * perpendicular(tangent);
    sum.right_turned = sum.right_turned + (weighted * right_area) * perpendicular(tangent);
  };
  for (std::size_t i = 0; i < Rule::abscissa().size(); ++i) {
    add(-half * Rule::abscissa()[i], Rule::weights()[i]);
    add(half * Rule::abscissa()[i], Rule::weights()[i]);
  }
  sum.position = knot_positions_[interval] + sum.position;
  const double slope = slope_at(shape, interval, local);
  sum.tangent = {std::cos(slope), std::sin(slope)};
  return sum;
}

/// Positions at the knots and how they change with each bend.
void Fitter::lay_out(const Shape& shape) {
  const std::size_t count = knots_.size();
  knot_positions_.assign(count, {});
  knot_slopes_.assign(count, shape.entry);
  knot_changes_.assign(count, std::vector<Vec2>(count));
  for (std::size_t k = 0; k + 1 < count; ++k) {
    const Local end = local_at(shape, k, knots_[k + 1]);
    knot_positions_[k + 1] = end.position;
    knot_slopes_[k + 1] = slope_at(shape, k, width(k));
    for (std::size_t j = 0; j < k; ++j) {
      const double area = area_before(j) + 0.5 * width(j);
      knot_changes_[k + 1][j] = knot_changes_[k][j] - area * end.turned;
    }
    knot_changes_[k + 1][k] = knot_changes_[k][k] - end.left_turned;
    knot_changes_[k + 1][k + 1] = Vec2{} - end.right_turned;
  }
}

/// Moves the points' places towards the nearest places on the curve laid out.
void Fitter::project(const Shape& shape) {
  constexpr int kNewtonSteps = 3;
  for (std::size_t i = 1; i < places_.size(); ++i) {
    for (int step = 0; step < kNewtonSteps; ++step) {
      const Local here = local_at(shape, interval_of(places_[i]), places_[i]);
      const double ahead = dot((*points_)[i] - here.position, here.tangent) / shape.length;
      places_[i] = std::clamp(places_[i] + ahead, 0.0, 1.0);
      if (std::fabs(ahead) < 1e-10) break;
    }
  }
  // The finish is where the last point is nearest: there the curve ends.
  places_.back() = 1.0;
}

Linearized Fitter::linearized(const Shape& shape) {
  lay_out(shape);
  project(shape);
  Linearized sum(unknowns());
  std::vector<std::array<Sight, kSight>> grams(knots_.size() - 1);
  std::vector<Sight> moments(knots_.size() - 1);
  for (auto& gram : grams) {
    for (Sight& row : gram) row.fill(0.0);
  }
  for (Sight& moment : moments) moment.fill(0.0);

  const double weight = 1.0 / (static_cast<double>(points_->size()) * scale_ * scale_);
  const auto add = [&](std::size_t k, const Local& here, Vec2 away, Vec2 direction) {
    const Vec2 left = knot_changes_[k][k] - here.left_turned;
    const Sight sight{direction.x,
                      direction.y,
                      -dot(here.turned, direction),
                      dot(left, direction),
                      -dot(here.right_turned, direction),
                      dot(perpendicular(here.position), direction),
                      dot(here.position, direction) / shape.length};
    const double distance = dot(away, direction);
    for (std::size_t a = 0; a < kSight; ++a) {
      moments[k][a] -= weight * distance * sight[a];
      for (std::size_t b = 0; b <= a; ++b) grams[k][a][b] += weight * sight[a] * sight[b];
    }
    sum.mean_square += weight * distance * distance;
  };
  for (std::size_t i = 1; i < points_->size(); ++i) {
    const std::size_t k = interval_of(places_[i]);
    const Local here = local_at(shape, k, places_[i]);
    const Vec2 away = (*points_)[i] - here.position;
    const bool last = i + 1 == points_->size();
    if (last) {
      add(k, here, away, {1.0, 0.0});
      add(k, here, away, {0.0, 1.0});
    } else {
      add(k, here, away, perpendicular(here.tangent));
    }
    const double distance = last ? norm(away) : std::fabs(dot(away, perpendicular(here.tangent)));
    sum.max_distance = std::max(sum.max_distance, distance);
  }
  for (std::size_t k = 0; k < grams.size(); ++k) add_interval(k, grams[k], moments[k], sum);
  return sum;
}

/// Spreads what the points of one knot interval see over the unknowns.
void Fitter::add_interval(std::size_t interval, const std::array<Sight, kSight>& gram, const Sight& moment,
                          Linearized& sum) const {
  const std::size_t complete = interval;
  const std::size_t own[] = {kFirstBend + interval, kFirstBend + interval + 1, kEntry, kLength};
  const auto symmetric = [&](std::size_t a, std::size_t b) { return a >= b ? gram[a][b] : gram[b][a]; };
  const auto seen = [&](std::size_t j) {
    const Vec2 change = knot_changes_[interval][j];
    return std::array<double, 3>{change.x, change.y, area_before(j) + 0.5 * width(j)};
  };
  for (std::size_t i = 0; i < complete; ++i) {
    const auto row = seen(i);
    std::array<double, kSight> mixed{};
    for (std::size_t b = 0; b < kSight; ++b) {
      for (std::size_t a = 0; a < 3; ++a) mixed[b] += row[a] * symmetric(a, b);
    }
    for (std::size_t j = 0; j <= i; ++j) {
      const auto column = seen(j);
      sum.matrix.at(kFirstBend + i, kFirstBend + j) +=
          mixed[kByX] * column[0] + mixed[kByDrop] * column[1] + mixed[kByArea] * column[2];
    }
    for (std::size_t b = 0; b < 4; ++b) {
      sum.matrix.add(kFirstBend + i, own[b], mixed[kOwnLeft + b]);
    }
    sum.gradient[kFirstBend + i] +=
        row[0] * moment[kByX] + row[1] * moment[kByDrop] + row[2] * moment[kByArea];
  }
  for (std::size_t a = 0; a < 4; ++a) {
    for (std::size_t b = 0; b <= a; ++b) {
      sum.matrix.add(own[a], own[b], symmetric(kOwnLeft + a, kOwnLeft + b));
    }
    sum.gradient[own[a]] += moment[kOwnLeft + a];
  }
}

double Fitter::roughness(const Shape& shape) const {
  double sum = 0.0;
  for (std::size_t k = 0; k + 1 < knots_.size(); ++k) {
    const double change = shape.bend[k + 1] - shape.bend[k];
    sum += change * change / width(k);
  }
  return sum;
}

void Fitter::add_roughness(const Shape& shape, double smoothing, Linearized& sum) const {
  for (std::size_t k = 0; k + 1 < knots_.size(); ++k) {
    const double stiffness = smoothing / width(k);
    const double change = shape.bend[k + 1] - shape.bend[k];
    const std::size_t left = kFirstBend + k;
    sum.matrix.at(left, left) += stiffness;
    sum.matrix.at(left + 1, left + 1) += stiffness;
    sum.matrix.at(left + 1, left) -= stiffness;
    sum.gradient[left] -= stiffness * change;
    sum.gradient[left + 1] += stiffness * change;
  }
}

/// Minimises for one smoothing by damped Gauss-Newton steps, from the shape so far.
void Fitter::relax(double smoothing) {
  Linearized here = linearized(shape_);
  double value = here.mean_square + smoothing * roughness(shape_);
  for (int step = 0; step < kMostSteps; ++step) {
    add_roughness(shape_, smoothing, here);
    for (std::size_t i = 0; i < unknowns(); ++i) here.matrix.at(i, i) *= 1.0 + 1e-13;
    if (!here.matrix.factorize()) return;
    std::vector<double> move = here.gradient;
    here.matrix.solve_forward(move);
    double promised = 0.0;
    for (const double part : move) promised += part * part;
    here.matrix.solve_backward(move);

    double share = 1.0;
    double next_value = value;
    Shape next = shape_;
    Linearized there(unknowns());
    for (int halving = 0; halving < kMostHalvings; ++halving, share *= 0.5) {
      next.entry = shape_.entry - share * move[kEntry];
      next.length = shape_.length - share * move[kLength];
      if (!(next.length > 0.0)) continue;
      for (std::size_t k = 0; k < knots_.size(); ++k)
        next.bend[k] = shape_.bend[k] - share * move[kFirstBend + k];
      there = linearized(next);
      next_value = there.mean_square + smoothing * roughness(next);
      if (next_value < value) break;
    }
    if (!(next_value < value)) return;
    const bool settled = promised <= 1e-9 * value;
    shape_ = next;
    here = std::move(there);
    value = next_value;
    if (settled) return;
  }
}

/// Craven and Wahba's score of the shape that was relaxed for this smoothing: an estimate of its distance
/// from the curve that the points were noisy samples of. Infinite where the curve is too free for the score
/// to mean anything.
double Fitter::validation_score(double smoothing) {
  const Linearized data = linearized(shape_);
  Linearized all = data;
  add_roughness(shape_, smoothing, all);
  for (std::size_t i = 0; i < unknowns(); ++i) all.matrix.at(i, i) *= 1.0 + 1e-13;
  if (!all.matrix.factorize()) return std::numeric_limits<double>::infinity();
  double freedom = 0.0;
  for (std::size_t column = 0; column < unknowns(); ++column) {
    std::vector<double> image(unknowns());
    for (std::size_t row = 0; row < unknowns(); ++row) {
      image[row] = data.matrix.at(std::max(row, column), std::min(row, column));
    }
    all.matrix.solve_forward(image);
    all.matrix.solve_backward(image);
    freedom += image[column];
  }
  // Every point gives one equation, the last one two, the first one none.
  const auto equations = static_cast<double>(points_->size());
  if (freedom > kMostFreedom * equations) return std::numeric_limits<double>::infinity();
  return data.mean_square / std::pow(1.0 - kPriceOfFreedom * freedom / equations, 2);
}

Shape Fitter::validated() {
  Shape best;
  double best_score = std::numeric_limits<double>::infinity();
  int uphill = 0;
  for (double smoothing = kMostSmoothing; smoothing >= kLeastSmoothing; smoothing *= kSmoothingStep) {
    relax(smoothing);
    const double score =
        points_->size() < kFewestToValidate ? linearized(shape_).mean_square : validation_score(smoothing);
    if (!std::isfinite(score)) break;
    if (score >= best_score) {
      if (++uphill == kMostStepsUphill) break;
      continue;
    }
    uphill = 0;
    best = shape_;
    best_score = score;
  }
  return best.bend.empty() ? shape_ : best;
}

Shape Fitter::within(double max_deviation) {
  constexpr int kBisections = 8;
  // The deviations are measured again on the finished curve; this much may be rounding in between.
  const double goal = max_deviation * (1.0 - 1e-6);
  double nearest = std::numeric_limits<double>::infinity();
  Shape smoother = shape_;
  for (double smoothing = kMostSmoothing; smoothing >= kLeastSmoothing; smoothing *= kSmoothingStep) {
    smoother = shape_;
    relax(smoothing);
    const double distance = linearized(shape_).max_distance;
    nearest = std::min(nearest, distance);
    if (distance > goal) continue;
    Shape near_enough = shape_;
    double low = smoothing;
    double high = smoothing / kSmoothingStep;
    for (int i = 0; i < kBisections; ++i) {
      const double middle = std::sqrt(low * high);
      shape_ = near_enough;
      relax(middle);
      const bool fits = linearized(shape_).max_distance <= goal;
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

Shape Fitter::shape_for(const ProfileFit& fit) {
  return fit.max_deviation ? within(*fit.max_deviation) : validated();
}

ClothoidSpline Fitter::spline(const Shape& shape) const {
  std::vector<ClothoidSegment> segments;
  for (std::size_t k = 0; k + 1 < knots_.size(); ++k) {
    segments.push_back(
        {shape.length * width(k), shape.bend[k] / shape.length, shape.bend[k + 1] / shape.length});
  }
  return {Angle::from_radians(shape.entry), std::move(segments)};
}

/// The place of the curve nearest to a point, by Newton steps from s.
double nearest_place(const ClothoidSpline& curve, Vec2 point, double s) {
  constexpr int kNewtonSteps = 50;
  for (int step = 0; step < kNewtonSteps; ++step) {
    const CenterlinePoint here = curve.at(s);
    const Vec2 tangent{std::cos(here.slope_angle), std::sin(here.slope_angle)};
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

}  // namespace

ClothoidSpline fit_clothoid_spline(const std::vector<Vec2>& points, const ProfileFit& fit) {
  Fitter fitter(points);
  return fitter.spline(fitter.shape_for(fit));
}

std::vector<PointDeviation> deviations_from(const ClothoidSpline& curve, const std::vector<Vec2>& points) {
  std::vector<PointDeviation> deviations;
  const std::vector<double> lengths = rough_arc_lengths(points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double s = nearest_place(curve, points[i], curve.length() * (lengths[i] / lengths.back()));
    const CenterlinePoint place = curve.at(s);
    const Vec2 away = points[i] - Vec2{place.x, place.drop};
    const double side = dot(away, {-std::sin(place.slope_angle), std::cos(place.slope_angle)});
    deviations.push_back({s, std::copysign(norm(away), side)});
  }
  return deviations;
}

}  // namespace glissade
