#include "centerline/profile/smoothed_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace glissade::centerline {
namespace {

constexpr std::size_t kBand = 3;  // beside the diagonal
// Ten times the smoothing is half again the stretch that it smooths over.
constexpr double kStiffest = 1e-3;
constexpr double kSoftest = 1e-26;
constexpr double kSofter = 0.1;

/// A symmetric positive definite matrix of few diagonals.
class BandMatrix {
 public:
  explicit BandMatrix(std::size_t size) : size_(size), values_(size * (kBand + 1), 0.0) {}

  /// @param below  row - column, 0 to kBand
  [[nodiscard]] double& at(std::size_t column, std::size_t below) {
    return values_[column * (kBand + 1) + below];
  }
  [[nodiscard]] double at(std::size_t column, std::size_t below) const {
    return values_[column * (kBand + 1) + below];
  }

  /// Replaces the matrix by its Cholesky factor. @return false if it is not positive definite
  [[nodiscard]] bool factorize() {
    for (std::size_t j = 0; j < size_; ++j) {
      if (!(at(j, 0) > 0.0)) return false;
      at(j, 0) = std::sqrt(at(j, 0));
      const std::size_t reach = std::min(kBand, size_ - 1 - j);
      for (std::size_t a = 1; a <= reach; ++a) at(j, a) /= at(j, 0);
      for (std::size_t a = 1; a <= reach; ++a) {
        for (std::size_t b = a; b <= reach; ++b) at(j + a, b - a) -= at(j, a) * at(j, b);
      }
    }
    return true;
  }

  /// Solves for a factorized matrix, in place.
  void solve(std::vector<Vec2>& b) const {
    for (std::size_t j = 0; j < size_; ++j) {
      b[j] = (1.0 / at(j, 0)) * b[j];
      for (std::size_t a = 1; a <= std::min(kBand, size_ - 1 - j); ++a) b[j + a] = b[j + a] - at(j, a) * b[j];
    }
    for (std::size_t j = size_; j-- > 0;) {
      for (std::size_t a = 1; a <= std::min(kBand, size_ - 1 - j); ++a) b[j] = b[j] - at(j, a) * b[j + a];
      b[j] = (1.0 / at(j, 0)) * b[j];
    }
  }

  /// @return the trace of the inverse of the matrix that was factorized, by what of the inverse lies within the band
  /// (Hutchinson and de Hoog, Numer. Math. 47 (1985) 99)
  [[nodiscard]] double inverse_trace() const {
    std::vector<std::array<double, kBand + 1>> inverse(size_, std::array<double, kBand + 1>{});
    double trace = 0.0;
    for (std::size_t j = size_; j-- > 0;) {
      const std::size_t reach = std::min(kBand, size_ - 1 - j);
      const auto between = [&](std::size_t a, std::size_t b) {
        return inverse[j + std::min(a, b)][std::max(a, b) - std::min(a, b)];
      };
      for (std::size_t a = reach; a >= 1; --a) {
        double sum = 0.0;
        for (std::size_t k = 1; k <= reach; ++k) sum -= at(j, k) * between(k, a);
        inverse[j][a] = sum / at(j, 0);
      }
      double own = 1.0 / at(j, 0);
      for (std::size_t k = 1; k <= reach; ++k) own -= at(j, k) * inverse[j][k];
      inverse[j][0] = own / at(j, 0);
      trace += inverse[j][0];
    }
    return trace;
  }

 private:
  std::size_t size_;
  std::vector<double> values_;
};

/// Integral of the squared third derivative, as third divided differences show it.
BandMatrix roughness(const std::vector<double>& t) {
  BandMatrix sum(t.size());
  for (std::size_t i = 0; i + kBand < t.size(); ++i) {
    std::array<double, kBand + 1> weights{};
    for (std::size_t a = 0; a <= kBand; ++a) {
      weights[a] = 6.0;
      for (std::size_t b = 0; b <= kBand; ++b) {
        if (b != a) weights[a] /= t[i + a] - t[i + b];
      }
    }
    const double stretch = (t[i + kBand] - t[i]) / static_cast<double>(kBand);
    for (std::size_t a = 0; a <= kBand; ++a) {
      for (std::size_t b = a; b <= kBand; ++b) sum.at(i + a, b - a) += stretch * weights[a] * weights[b];
    }
  }
  return sum;
}

std::optional<SmoothedPoints> smoothed_by(const BandMatrix& rough, double smoothing,
                                          const std::vector<Vec2>& points) {
  const std::size_t count = points.size();
  const double weight = 1.0 / static_cast<double>(count);
  BandMatrix matrix(count);
  SmoothedPoints result;
  for (std::size_t j = 0; j < count; ++j) {
    for (std::size_t a = 0; a <= std::min(kBand, count - 1 - j); ++a) {
      matrix.at(j, a) = smoothing * rough.at(j, a);
    }
    matrix.at(j, 0) += weight;
    result.points.push_back(weight * points[j]);
  }
  if (!matrix.factorize()) return {};
  matrix.solve(result.points);
  for (std::size_t j = 0; j < count; ++j) {
    const Vec2 away = points[j] - result.points[j];
    result.cost.mean_square += weight * dot(away, away);
  }
  result.cost.freedom = weight * matrix.inverse_trace();
  return result;
}

}  // namespace

std::optional<SmoothedPoints> smoothed(const std::vector<double>& parameters,
                                       const std::vector<Vec2>& points) {
  const BandMatrix rough = roughness(parameters);
  const std::size_t count = points.size();
  if (count < kFewestToValidate) return SmoothedPoints{points, {0.0, static_cast<double>(count)}, true};
  std::optional<SmoothedPoints> best;
  std::optional<Cost> freest;
  bool follow = true;
  for (double smoothing = kStiffest; smoothing >= kSoftest; smoothing *= kSofter) {
    auto here = smoothed_by(rough, smoothing, points);
    if (!here) continue;
    if (!here->cost.tells(count)) break;
    freest = here->cost;
    const double score = here->cost.validation_score(count);
    if (!best || score < best->cost.validation_score(count)) {
      best = std::move(here);
      follow = true;
    } else if (std::isfinite(score) || !follow) {
      follow = here->cost.finds_more_than_noise(best->cost, count);
    }
  }
  if (best && follow) return SmoothedPoints{points, *freest, true};
  return best;
}

}  // namespace glissade::centerline
