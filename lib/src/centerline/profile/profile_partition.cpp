// Where the curvature of a profile breaks. Beside a curve that leads along the points, the twofold integral of a
// curvature is a height: that of the curve less the points' distances from it is what the points say of theirs
// (to first order in the distances). A straight, an arc, a clothoid are polynomials of first, second and third
// degree there, other bends of higher ones, whatever the profile turns by, so that every stretch of points is judged by linear least squares.
#include "centerline/profile/profile_partition.hpp"

#include "glissade/core/math.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace glissade::centerline {
namespace {

constexpr std::size_t kNumbers = 4 + kMostSwellings;  // of the highest polynomial

constexpr std::size_t kClothoidNumbers = 4;

/// Points as arc length and the twofold integral of curvature.
struct Unrolled {
  std::vector<double> s;
  std::vector<double> height;
};

Unrolled unrolled(const ClothoidSpline& curve, const std::vector<double>& places,
                  const std::vector<double>& deviations) {
  Unrolled points;
  const std::vector<double> joints = curve.breaks();
  std::size_t k = 0;
  double height = 0.0;  // at the joint before
  double rise = 0.0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto after = [&](double t, double& high, double& steep) {
      const ClothoidSegment& segment = curve.segments()[k];
      const double rate = (segment.exit_curvature - segment.entry_curvature) / segment.length;
      high = height + t * (rise + t * (0.5 * segment.entry_curvature + rate * t / 6.0));
      steep = rise + t * (segment.entry_curvature + 0.5 * rate * t);
    };
    double high = 0.0;
    double steep = 0.0;
    while (k + 1 < curve.segments().size() && places[i] > joints[k + 1]) {
      after(joints[k + 1] - joints[k], high, steep);
      height = high;
      rise = steep;
      ++k;
    }
    after(places[i] - joints[k], high, steep);
    points.s.push_back(places[i]);
    points.height.push_back(high - deviations[i]);
  }
  return points;
}

/// Polynomials of least squares through points that come one after the other, by rotations: no digit is lost
/// however long the stretch.
class RunningFit {
 public:
  void add(double t, double value) {
    std::array<double, kNumbers + 1> row{1.0};
    for (std::size_t k = 1; k < kNumbers; ++k) row[k] = row[k - 1] * t;
    row[kNumbers] = value;
    for (std::size_t k = 0; k < kNumbers; ++k) {
      if (row[k] == 0.0) continue;
      const double radius = std::sqrt(rows_[k][k] * rows_[k][k] + row[k] * row[k]);
      const double cosine = rows_[k][k] / radius;
      const double sine = row[k] / radius;
      for (std::size_t j = k; j <= kNumbers; ++j) {
        const double old = rows_[k][j];
        rows_[k][j] = cosine * old + sine * row[j];
        row[j] = cosine * row[j] - sine * old;
      }
    }
    rest_ += row[kNumbers] * row[kNumbers];
  }

  /// @return sum of the squares that a polynomial of this many numbers leaves
  [[nodiscard]] double left_by(std::size_t numbers) const {
    double sum = rest_;
    for (std::size_t k = numbers; k < kNumbers; ++k) sum += rows_[k][kNumbers] * rows_[k][kNumbers];
    return sum;
  }

  /// @return coefficients of the polynomial of this many numbers, lowest first, the others 0
  [[nodiscard]] std::array<double, kNumbers> coefficients(std::size_t numbers) const {
    std::array<double, kNumbers> found{};
    for (std::size_t k = numbers; k-- > 0;) {
      double sum = rows_[k][kNumbers];
      for (std::size_t j = k + 1; j < numbers; ++j) sum -= rows_[k][j] * found[j];
      found[k] = rows_[k][k] > 0.0 ? sum / rows_[k][k] : 0.0;
    }
    return found;
  }

 private:
  std::array<std::array<double, kNumbers + 1>, kNumbers> rows_{};
  double rest_ = 0.0;
};

/// A stretch of points and the polynomial that describes it.
struct Stretch {
  std::size_t from = 0;
  std::size_t to = 0;  // behind its last point
  std::size_t numbers = 0;
};

/// The cheapest cut of points 0 .. n-1 into stretches, by dynamic programming.
std::vector<Stretch> cheapest_cut(const Unrolled& points, double scatter) {
  const std::size_t count = points.s.size();
  const double unit = points.s.back() / static_cast<double>(count);
  const double price = math::log(static_cast<double>(count));
  const double weight = 1.0 / (scatter * scatter);
  std::vector<double> cost(count + 1, std::numeric_limits<double>::infinity());
  std::vector<Stretch> last(count + 1);
  cost[0] = 0.0;
  for (std::size_t from = 0; from < count; ++from) {
    if (!std::isfinite(cost[from])) continue;
    RunningFit sums;
    for (std::size_t to = from + 1; to <= count; ++to) {
      sums.add((points.s[to - 1] - points.s[from]) / unit, points.height[to - 1] - points.height[from]);
      for (std::size_t numbers = 2; numbers <= std::min(kNumbers, to - from); ++numbers) {
        const std::size_t swellings = numbers > kClothoidNumbers ? numbers - kClothoidNumbers : 0;
        const double total = cost[from] + sums.left_by(numbers) * weight +
                             static_cast<double>(numbers + 1 + swellings) * price;
        if (total >= cost[to]) continue;
        cost[to] = total;
        last[to] = {from, to, numbers};
      }
    }
  }
  std::vector<Stretch> stretches;
  for (std::size_t to = count; to > 0; to = last[to].from) stretches.push_back(last[to]);
  std::reverse(stretches.begin(), stretches.end());
  return stretches;
}

/// A stretch's polynomial about its own first point.
struct Polynomial {
  double from = 0.0;
  std::array<double, kNumbers> coefficients{};

  [[nodiscard]] double slope(double s) const {
    double sum = 0.0;
    for (std::size_t k = kNumbers; k-- > 1;)
      sum = sum * (s - from) + static_cast<double>(k) * coefficients[k];
    return sum;
  }
  [[nodiscard]] double curvature(double s) const {
    double sum = 0.0;
    for (std::size_t k = kNumbers; k-- > 2;) {
      sum = sum * (s - from) + static_cast<double>(k * (k - 1)) * coefficients[k];
    }
    return sum;
  }
};

Polynomial polynomial_of(const Unrolled& points, const Stretch& stretch) {
  const double unit = points.s.back() / static_cast<double>(points.s.size());
  RunningFit sums;
  for (std::size_t i = stretch.from; i < stretch.to; ++i) {
    sums.add((points.s[i] - points.s[stretch.from]) / unit, points.height[i] - points.height[stretch.from]);
  }
  Polynomial polynomial{points.s[stretch.from], sums.coefficients(stretch.numbers)};
  double power = 1.0;
  for (double& coefficient : polynomial.coefficients) {
    coefficient /= power;
    power *= unit;
  }
  return polynomial;
}

/// Where one polynomial goes over into the next: where they slope alike, if that is near the gap between their
/// points, or else the middle of the gap.
double joint_between(const Polynomial& left, const Polynomial& right, double low, double high) {
  const double reach = high - low;
  const double middle = 0.5 * (low + high);
  const double from = low - 0.5 * reach;
  const double to = high + 0.5 * reach;
  const auto gap = [&](double s) { return left.slope(s) - right.slope(s); };
  if (gap(from) * gap(to) >= 0.0) return middle;
  double a = from;
  double b = to;
  constexpr int kBisections = 50;
  for (int i = 0; i < kBisections; ++i) {
    const double c = 0.5 * (a + b);
    (gap(a) * gap(c) <= 0.0 ? b : a) = c;
  }
  return 0.5 * (a + b);
}

PieceShape shape_of(const Stretch& stretch) {
  if (stretch.numbers == 2) return PieceShape::straight;
  if (stretch.numbers == 3) return PieceShape::arc;
  return stretch.numbers == 4 ? PieceShape::clothoid : PieceShape::bend;
}

/// The piece that bends as the polynomial does.
ProfilePiece piece_of(const Stretch& stretch, const Polynomial& polynomial, double from, double to) {
  ProfilePiece piece{shape_of(stretch), to - from, polynomial.curvature(from), polynomial.curvature(to)};
  if (piece.shape != PieceShape::bend) return piece;
  // What the curvature has beyond a clothoid, over 4 u (1 - u), is a polynomial in w = 2 u - 1, of third degree at
  // most: its values at w = 1/4 and 3/4 and their mirror places give the coefficients.
  const auto excess = [&](double w) {
    const double u = 0.5 * (1.0 + w);
    return (polynomial.curvature(from + u * piece.length) - piece.curvature(u)) / (4.0 * u * (1.0 - u));
  };
  constexpr double kNear = 0.25;
  constexpr double kFar = 0.75;
  constexpr double kSquares = kFar * kFar - kNear * kNear;
  const double near_even = 0.5 * (excess(kNear) + excess(-kNear));
  const double far_even = 0.5 * (excess(kFar) + excess(-kFar));
  const double near_odd = 0.5 * (excess(kNear) - excess(-kNear)) / kNear;
  const double far_odd = 0.5 * (excess(kFar) - excess(-kFar)) / kFar;
  const double square = (far_even - near_even) / kSquares;
  const double cube = (far_odd - near_odd) / kSquares;
  piece.swellings = stretch.numbers - kClothoidNumbers;
  piece.swelling = {near_even - square * kNear * kNear, near_odd - cube * kNear * kNear, square, cube};
  return piece;
}

/// Straights do not meet at an angle: where few points lie between two they are an arc, and where none do there is one.
void round_corners(PiecewiseProfile& profile, const std::vector<Stretch>& stretches,
                   const std::vector<Polynomial>& polynomials, double spacing) {
  constexpr std::size_t kFew = 3;
  const auto is_straight = [&](std::size_t k) { return stretches[k].numbers == 2; };
  std::vector<ProfilePiece> rounded;
  for (std::size_t k = 0; k < stretches.size(); ++k) {
    ProfilePiece piece = profile.pieces[k];
    const bool between = k > 0 && k + 1 < stretches.size() && is_straight(k - 1) && is_straight(k + 1);
    const bool few = stretches[k].to - stretches[k].from <= kFew;
    if (is_straight(k) && between && few) {
      const double turn = polynomials[k + 1].coefficients[1] - polynomials[k - 1].coefficients[1];
      piece.shape = PieceShape::arc;
      piece.entry_curvature = piece.exit_curvature = turn / piece.length;
    } else if (is_straight(k) && !rounded.empty() && rounded.back().shape == PieceShape::straight) {
      ProfilePiece arc;
      arc.shape = PieceShape::arc;
      arc.length = std::min({spacing, 0.5 * piece.length, 0.5 * rounded.back().length});
      arc.entry_curvature = arc.exit_curvature =
          (polynomials[k].coefficients[1] - polynomials[k - 1].coefficients[1]) / arc.length;
      rounded.back().length -= 0.5 * arc.length;
      piece.length -= 0.5 * arc.length;
      rounded.push_back(arc);
    }
    rounded.push_back(piece);
  }
  profile.pieces = std::move(rounded);
}

}  // namespace

double scatter_of(const ClothoidSpline& reference, const PlacedPoints& placed) {
  constexpr std::size_t kWindow = 9;
  constexpr std::size_t kQuintic = 6;
  // Lower quartile of the chi-squared distribution with 3 degrees of freedom, over 3: three windows in four may show
  // what no quintic follows.
  constexpr double kQuartileOfThree = 0.4042;
  const Unrolled points = unrolled(reference, placed.places, placed.deviations);
  const double unit = points.s.back() / static_cast<double>(points.s.size());
  std::vector<double> squares;
  for (std::size_t from = 0; from + kWindow <= points.s.size(); ++from) {
    RunningFit sums;
    for (std::size_t i = from; i < from + kWindow; ++i) {
      sums.add((points.s[i] - points.s[from]) / unit, points.height[i] - points.height[from]);
    }
    squares.push_back(sums.left_by(kQuintic) / static_cast<double>(kWindow - kQuintic));
  }
  if (squares.empty()) return 0.0;
  const auto quartile = squares.begin() + static_cast<std::ptrdiff_t>(squares.size() / 4);
  std::nth_element(squares.begin(), quartile, squares.end());
  return std::sqrt(*quartile / kQuartileOfThree);
}

std::optional<PiecewiseProfile> partition(const ClothoidSpline& reference, const PlacedPoints& placed,
                                          double scatter) {
  const Unrolled points = unrolled(reference, placed.places, placed.deviations);
  const std::vector<Stretch> stretches = cheapest_cut(points, scatter);
  if (stretches.size() > kMostProfilePieces) return {};
  PiecewiseProfile profile;
  std::vector<Polynomial> polynomials;
  polynomials.reserve(stretches.size());
  for (const Stretch& stretch : stretches) polynomials.push_back(polynomial_of(points, stretch));
  const double spacing = reference.length() / static_cast<double>(points.s.size());
  double from = 0.0;
  profile.entry = reference.entry_slope_angle().radians() - polynomials.front().slope(0.0);
  for (std::size_t k = 0; k < stretches.size(); ++k) {
    double to = reference.length();
    if (k + 1 < stretches.size()) {
      to = joint_between(polynomials[k], polynomials[k + 1], points.s[stretches[k].to - 1],
                         points.s[stretches[k].to]);
    }
    to = std::max(to, from + 1e-3 * spacing);
    profile.pieces.push_back(piece_of(stretches[k], polynomials[k], from, to));
    from = to;
  }
  round_corners(profile, stretches, polynomials, spacing);
  return profile;
}

}  // namespace glissade::centerline
