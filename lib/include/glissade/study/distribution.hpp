#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace glissade::study {

enum class DistributionKind {
  uniform,           ///< uniform(LOWEST, HIGHEST)
  normal,            ///< normal(MEAN, STANDARD-DEVIATION)
  truncated_normal,  ///< truncated-normal(MEAN, STANDARD-DEVIATION, LOWEST, HIGHEST): a normal one cut at both ends
  lognormal,  ///< lognormal(MEDIAN, SIGMA): SIGMA is the standard deviation of the logarithm, without a unit
  triangular  ///< triangular(LOWEST, MODE, HIGHEST)
};

/// How a value scatters, in a unit of its own.
///
/// Accuracy: quantile() to 1e-13 of the distribution's width, by Boost.Math in extended precision; the same digits on
///   every x86-64.
class Distribution {
 public:
  /// @param text  as a user writes it, e.g. "normal(17deg, 1.5deg)"; every parameter that has a unit has the same one
  /// @param name  what scatters, for messages
  /// @throws InputError if the name, the number of parameters, a number or a unit is wrong; a standard deviation,
  ///         SIGMA or width is not positive; a MEDIAN is not positive; a MODE lies outside its bounds; the bounds of
  ///         a truncated normal lie more than 30 standard deviations from its MEAN, which they need not hold
  [[nodiscard]] static Distribution parse(std::string_view text, std::string_view name);

  /// @param probability  0 < probability < 1
  /// @throws InputError if it is not within them
  /// @return the value below which this share of all values lies [unit()]
  [[nodiscard]] double quantile(double probability) const;

  [[nodiscard]] DistributionKind kind() const noexcept { return kind_; }
  [[nodiscard]] const std::vector<double>& parameters() const noexcept { return parameters_; }
  /// @return the unit as it was written, e.g. "deg"; empty for plain numbers
  [[nodiscard]] const std::string& unit() const noexcept { return unit_; }
  /// @return the text that reads back as this distribution, without blanks
  [[nodiscard]] std::string text() const;

 private:
  DistributionKind kind_ = DistributionKind::uniform;
  std::vector<double> parameters_;
  std::string unit_;
};

enum class Sampling {
  random,           ///< independent pseudo-random numbers
  latin_hypercube,  ///< each of N equal shares of every distribution is met exactly once
  sobol             ///< points of Sobol's sequence, shifted digit by digit by the seed: the evenest
};

/// @return "random", "latin-hypercube", "sobol"
[[nodiscard]] std::string_view word(Sampling sampling);
/// @throws InputError if the word names none
[[nodiscard]] Sampling sampling_named(std::string_view word);

/// Points of the unit cube, each computed by its number alone: every process that knows the plan finds the same ones.
///
/// Identity: of `latin_hypercube`, every interval [k/count, (k+1)/count) holds one sample in each dimension.
struct UnitCube {
  Sampling sampling = Sampling::sobol;
  std::uint64_t count = 1;     ///< samples; 1 <= count <= kMostSamples
  std::size_t dimensions = 1;  ///< 1 <= dimensions <= kMostDimensions
  std::uint64_t seed = 1;

  static constexpr std::size_t kMostDimensions = 64;
  static constexpr std::uint64_t kMostSamples = std::uint64_t{1}
                                                << 53U;  // theory: a double tells the shares of as many apart

  /// @param sample  0 <= sample < count
  /// @throws InputError if it, the count or the dimensions are out of their range
  /// @return a coordinate a dimension, each within (0, 1)
  [[nodiscard]] std::vector<double> at(std::uint64_t sample) const;
};

}  // namespace glissade::study
