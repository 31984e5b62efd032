#pragma once

#include "glissade/core/math.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace glissade::centerline {

/// Root of the mean squared distance over length that is rounding.
inline constexpr double kRoundingShare = 1e-15;

/// Fewer points than these do not tell noise from shape.
inline constexpr std::size_t kFewestToValidate = 20;

/// What a description of points costs: what it leaves of them, and the numbers that it takes.
struct Cost {
  double mean_square = 0.0;  // of distance over length
  double freedom = 0.0;
  double noise = 0.0;  // mean square over length that is known to be noise: what is left below it is no merit

  // Plain cross-validation now and then takes noise for shape; counting each freedom of the curve this often is
  // the usual remedy (Cummins, Filloon and Nychka, J. Am. Stat. Assoc. 96 (2001) 233).
  static constexpr double kPriceOfFreedom = 1.4;
  // It needs many more points than the curve has freedom. Beyond this share it tells nothing.
  static constexpr double kMostFreedom = 0.65;
  // What is left of points tells their noise up to here, and if it has that much freedom of its own.
  static constexpr double kMostFreedomToTell = 0.85;
  static constexpr double kLeastFreedomLeft = 7.0;
  // Fisher's ratio that noise passes once in a thousand times where 20 points are described, and never where many are.
  static constexpr double kMoreThanNoise = 10.0;

  /// What is left, and at least the share of the noise that this much freedom leaves.
  [[nodiscard]] double beside_noise(std::size_t points) const {
    return std::max(mean_square, noise * (1.0 - std::min(1.0, freedom / static_cast<double>(points))));
  }

  /// Craven and Wahba's score: an estimate of the distance from the curve that the points were noisy samples of.
  /// Infinite where the description is too free for the score to mean anything.
  [[nodiscard]] double validation_score(std::size_t points) const {
    const auto equations = static_cast<double>(points);
    if (freedom > kMostFreedom * equations) return std::numeric_limits<double>::infinity();
    return beside_noise(points) / math::pow(1.0 - kPriceOfFreedom * freedom / equations, 2);
  }
  /// Mallows' score, where the noise is known: an estimate of the same, however free the description is (Technometrics 15
  /// (1973) 661).
  [[nodiscard]] double score_beside_noise(std::size_t points) const {
    return mean_square + 2.0 * noise * freedom / static_cast<double>(points);
  }
  /// Whether so much of the points is left to chance that its size can be told.
  [[nodiscard]] bool tells(std::size_t points) const {
    const auto equations = static_cast<double>(points);
    return freedom <= kMostFreedomToTell * equations && equations - freedom >= kLeastFreedomLeft;
  }
  /// Fisher's ratio: whether this description's additional freedom takes more from the points than noise yields.
  [[nodiscard]] bool finds_more_than_noise(const Cost& stiffer, std::size_t points) const {
    const double more = freedom - stiffer.freedom;
    const double left = beside_noise(points);
    const double taken = (stiffer.beside_noise(points) - left) / more;
    return taken * (static_cast<double>(points) - freedom) > kMoreThanNoise * left;
  }
  /// Schwarz's Bayesian information criterion, over the number of points. What is left is taken as of the points' noise
  /// less the share that as much freedom follows: of few points else the freest description would seem the best.
  [[nodiscard]] double bayesian_score(std::size_t points) const {
    constexpr double kLeastShare = 0.05;
    const auto equations = static_cast<double>(points);
    const double share = std::max(1.0 - freedom / equations, kLeastShare);
    return math::log(std::max(beside_noise(points), kRoundingShare * kRoundingShare) / share) +
           freedom * math::log(equations) / equations;
  }
};

}  // namespace glissade::centerline
