#include "glissade/study/distribution.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/study/plan.hpp"

#include "study/sobol.hpp"
#include "study/trimmed.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include <boost/math/distributions/lognormal.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/triangular.hpp>
#include <boost/math/quadrature/gauss.hpp>

namespace glissade::study {
namespace {

struct KindWords {
  DistributionKind kind;
  std::string_view word;
  std::size_t parameters;
  std::string_view example;
};

constexpr std::array<KindWords, 5> kKinds = {{
    {DistributionKind::uniform, "uniform", 2, "uniform(15deg,19deg)"},
    {DistributionKind::normal, "normal", 2, "normal(17deg,1.5deg)"},
    {DistributionKind::truncated_normal, "truncated-normal", 4, "truncated-normal(17deg,1.5deg,14deg,20deg)"},
    {DistributionKind::lognormal, "lognormal", 2, "lognormal(17deg,0.1)"},
    {DistributionKind::triangular, "triangular", 3, "triangular(14deg,17deg,21deg)"},
}};

const KindWords& words_of(DistributionKind kind) {
  return *std::find_if(kKinds.begin(), kKinds.end(),
                       [&](const KindWords& words) { return words.kind == kind; });
}

[[noreturn]] void refuse(std::string_view name, std::string what, std::string why, std::string hint) {
  throw InputError({std::string(name), std::move(what), std::move(why), std::move(hint)});
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (std::size_t from = 0; from <= text.size();) {
    const std::size_t to = std::min(text.find(separator, from), text.size());
    parts.push_back(trimmed(text.substr(from, to - from)));
    from = to + 1;
  }
  return parts;
}

/// Boost.Math evaluates in extended precision, whose library functions are the same on every processor.
using Precision = long double;

double normal_quantile(double mean, double deviation, Precision probability) {
  const boost::math::normal_distribution<Precision> unit(0.0L, 1.0L);
  // From the nearer tail, where a probability keeps its digits.
  const Precision z =
      probability <= 0.5L ? quantile(unit, probability) : quantile(complement(unit, 1.0L - probability));
  return static_cast<double>(mean + deviation * z);
}

/// Between bounds so near to each other that their probabilities agree in digits which the result needs: by Newton's rule
/// on the integral of the density itself.
double narrow_quantile(const std::vector<double>& parameters, double probability, double low, double width) {
  using Quadrature = boost::math::quadrature::gauss<double, 15>;  // theory: exact to rounding so far
  const auto density = [low](double way) { return math::exp(-way * (low + 0.5 * way)); };
  const double wanted = probability * Quadrature::integrate(density, 0.0, width);
  double way = probability * width;
  constexpr int kRounds = 5;  // theory: the density changes by a third at most; each doubles the digits
  for (int round = 0; round < kRounds; ++round)
    way -= (Quadrature::integrate(density, 0.0, way) - wanted) / density(way);
  return std::clamp(parameters[2] + parameters[1] * way, parameters[2], parameters[3]);
}

double truncated_quantile(const std::vector<double>& parameters, double probability) {
  const double mean = parameters[0];
  const double deviation = parameters[1];
  const boost::math::normal_distribution<Precision> unit(0.0L, 1.0L);
  const Precision low = (static_cast<Precision>(parameters[2]) - mean) / deviation;
  const Precision high = (static_cast<Precision>(parameters[3]) - mean) / deviation;
  constexpr Precision kNarrow = 0.01L;  // accuracy: beyond it differences keep 1e-15
  const Precision width = (static_cast<Precision>(parameters[3]) - parameters[2]) / deviation;
  if (width < kNarrow)
    return narrow_quantile(parameters, probability, static_cast<double>(low), static_cast<double>(width));
  // Both ends in the upper tail: mirrored, so that the probabilities do not run together at 1.
  const bool mirrored = low > 0.0L;
  const Precision from = mirrored ? cdf(unit, -high) : cdf(unit, low);
  const Precision beyond = mirrored ? cdf(unit, low) : cdf(unit, -high);  // above the upper end
  const Precision to = mirrored ? cdf(unit, -low) : cdf(unit, high);
  const Precision above = mirrored ? probability : 1.0L - static_cast<Precision>(probability);
  const Precision below = mirrored ? 1.0L - static_cast<Precision>(probability) : probability;
  const Precision share = from + below * (to - from);
  // From the nearer tail, where a probability keeps its digits.
  const Precision z =
      share <= 0.5L ? quantile(unit, share) : quantile(complement(unit, beyond + above * (to - from)));
  const double value = static_cast<double>(mean + deviation * (mirrored ? -z : z));
  return std::clamp(value, parameters[2], parameters[3]);
}

void require_width(std::string_view name, const std::string& what, double width) {
  if (width > 0.0 && std::isfinite(width)) return;
  if (width > 0.0)
    refuse(name, what + " is beyond the range of numbers", "Values are its start and a share of it.",
           "bounds below 1e307");
  refuse(name, what + " " + exact_text(width) + " is not positive",
         "A value that does not scatter has no distribution.", "--vary or --set for a value that is fixed");
}

void require_sound(DistributionKind kind, const std::vector<double>& p, std::string_view name) {
  switch (kind) {
    case DistributionKind::uniform:
      return require_width(name, "uniform: the width", p[1] - p[0]);
    case DistributionKind::normal:
      return require_width(name, "normal: the standard deviation", p[1]);
    case DistributionKind::truncated_normal: {
      require_width(name, "truncated-normal: the standard deviation", p[1]);
      require_width(name, "truncated-normal: the width between its bounds", p[3] - p[2]);
      const double nearest = std::clamp(p[0], p[2], p[3]);
      constexpr double kFarthest = 30.0;  // standard deviations; beyond, no probability is left in a double
      if (std::fabs(nearest - p[0]) <= kFarthest * p[1]) return;
      refuse(name, "truncated-normal: the bounds lie more than 30 standard deviations from the mean",
             "Next to nothing of the distribution lies between them.", "bounds on both sides of the mean");
    }
    case DistributionKind::lognormal:
      require_width(name, "lognormal: the standard deviation of the logarithm", p[1]);
      if (p[0] > 0.0) return;
      refuse(name, "lognormal: the median " + exact_text(p[0]) + " is not positive",
             "Its values are all positive.", "normal(...)");
    case DistributionKind::triangular:
      require_width(name, "triangular: the width", p[2] - p[0]);
      if (p[0] <= p[1] && p[1] <= p[2]) return;
      refuse(name,
             "triangular: the mode " + exact_text(p[1]) + " does not lie between " + exact_text(p[0]) +
                 " and " + exact_text(p[2]),
             "The parameters are LOWEST, MODE, HIGHEST.", "triangular(14deg,17deg,21deg)");
  }
}

void require_sound(const UnitCube& cube, std::uint64_t sample) {
  const auto require = [](std::string_view what, std::uint64_t value, std::uint64_t least,
                          std::uint64_t most) {
    if (value >= least && value <= most) return;
    throw InputError({"",
                      std::string(what) + ": " + std::to_string(value) + " is not within " +
                          std::to_string(least) + " to " + std::to_string(most),
                      "A point of the unit cube is one of its samples, a coordinate a dimension.", ""});
  };
  require("dimensions", cube.dimensions, 1, UnitCube::kMostDimensions);
  require("samples", cube.count, 1, UnitCube::kMostSamples);
  require("sample", sample, 0, cube.count - 1);
}

/// A generator that jumps to any place: SplitMix64 (Steele, Lea & Flood 2014) as a hash.
std::uint64_t mixed(std::uint64_t value) {
  value += 0x9E3779B97F4A7C15ULL;
  value = (value ^ (value >> 30U)) * 0xBF58476D1CE4E5B9ULL;
  value = (value ^ (value >> 27U)) * 0x94D049BB133111EBULL;
  return value ^ (value >> 31U);
}

std::uint64_t random_bits(std::uint64_t seed, std::uint64_t dimension, std::uint64_t sample) {
  return mixed(mixed(mixed(seed) ^ dimension) ^ sample);
}

/// The middle of one of 2^53 equal parts: never 0, never 1.
double to_unit(std::uint64_t bits) {
  constexpr double kPart = 0x1p-53;
  return (static_cast<double>(bits >> 11U) + 0.5) * kPart;
}

/// Where `sample` goes in a random order of [0, count): a Feistel network over the next even power of two, walked
/// until it falls within the range, so that no table has to be kept.
std::uint64_t shuffled(std::uint64_t sample, std::uint64_t count, std::uint64_t key) {
  unsigned half = 1;
  while ((std::uint64_t{1} << (2U * half)) < count) ++half;  // kMostSamples keeps it below 64 bits
  const std::uint64_t mask = (std::uint64_t{1} << half) - 1U;
  constexpr std::uint64_t kRounds = 6;
  do {
    std::uint64_t left = sample >> half;
    std::uint64_t right = sample & mask;
    for (std::uint64_t round = 0; round < kRounds; ++round) {
      const std::uint64_t next = left ^ (random_bits(key, round, right) & mask);
      left = std::exchange(right, next);
    }
    sample = (left << half) | right;
  } while (sample >= count);
  return sample;
}

}  // namespace

Distribution Distribution::parse(std::string_view text, std::string_view name) {
  text = trimmed(text);
  const std::size_t open = text.find('(');
  const std::string_view given = trimmed(text.substr(0, open));
  const auto words =
      std::find_if(kKinds.begin(), kKinds.end(), [&](const KindWords& known) { return known.word == given; });
  if (words == kKinds.end() || open == std::string_view::npos || text.back() != ')') {
    refuse(name, "'" + std::string(text) + "' is no distribution",
           "There are uniform, normal, truncated-normal, lognormal and triangular, each with its parameters "
           "in round "
           "brackets.",
           "normal(17deg,1.5deg)");
  }
  const auto parts = split(text.substr(open + 1, text.size() - open - 2), ',');
  if (parts.size() != words->parameters) {
    refuse(name,
           "'" + std::string(text) + "' has " + std::to_string(parts.size()) + " parameters instead of " +
               std::to_string(words->parameters),
           "", std::string(words->example));
  }
  Distribution result;
  result.kind_ = words->kind;
  std::optional<std::string> unit;
  for (std::size_t index = 0; index < parts.size(); ++index) {
    const auto quantity = split_quantity(parts[index]);
    if (!quantity) {
      refuse(name, "'" + std::string(parts[index]) + "' in '" + std::string(text) + "' is no number", "",
             std::string(words->example));
    }
    const bool plain = words->kind == DistributionKind::lognormal && index == 1;
    if (!unit && !plain) unit = quantity->unit;
    if (quantity->unit != (plain ? "" : *unit)) {
      refuse(name, "'" + std::string(parts[index]) + "' in '" + std::string(text) + "' has another unit",
             plain ? "The standard deviation of a logarithm has none."
                   : "All parameters of a distribution are in one unit.",
             std::string(words->example));
    }
    result.parameters_.push_back(quantity->number);
  }
  result.unit_ = unit.value_or("");
  require_sound(result.kind_, result.parameters_, name);
  return result;
}

double Distribution::quantile(double probability) const {
  if (!(probability > 0.0 && probability < 1.0)) {
    throw InputError({"", "probability: " + exact_text(probability) + " does not lie between 0 and 1",
                      "A quantile parts the values: some lie below it and some above.", "0.5, the median"});
  }
  const std::vector<double>& p = parameters_;
  switch (kind_) {
    case DistributionKind::uniform:
      return p[0] + (p[1] - p[0]) * probability;
    case DistributionKind::normal:
      return normal_quantile(p[0], p[1], probability);
    case DistributionKind::truncated_normal:
      return truncated_quantile(p, probability);
    case DistributionKind::lognormal: {
      const boost::math::lognormal_distribution<Precision> law(0.0L, static_cast<Precision>(p[1]));
      return static_cast<double>(p[0] * boost::math::quantile(law, static_cast<Precision>(probability)));
    }
    case DistributionKind::triangular: {
      const boost::math::triangular_distribution<Precision> law(p[0], p[1], p[2]);
      return static_cast<double>(boost::math::quantile(law, static_cast<Precision>(probability)));
    }
  }
  throw InternalError({"", "a distribution of no kind", "", ""});
}

std::string Distribution::text() const {
  std::string text(words_of(kind_).word);
  for (std::size_t index = 0; index < parameters_.size(); ++index) {
    const bool plain = kind_ == DistributionKind::lognormal && index == 1;
    text += (index == 0 ? "(" : ",") + joined_quantity(exact_text(parameters_[index]), plain ? "" : unit_);
  }
  return text + ")";
}

std::string_view word(Sampling sampling) {
  switch (sampling) {
    case Sampling::random:
      return "random";
    case Sampling::latin_hypercube:
      return "latin-hypercube";
    case Sampling::sobol:
      return "sobol";
  }
  throw InternalError({"", "a sampling without a word", "", ""});
}

Sampling sampling_named(std::string_view given) {
  for (const Sampling sampling : {Sampling::random, Sampling::latin_hypercube, Sampling::sobol}) {
    if (word(sampling) == given) return sampling;
  }
  throw InputError({"--sampling", "'" + std::string(given) + "' is no way to draw samples",
                    "There are random, latin-hypercube and sobol.", "--sampling sobol"});
}

std::vector<double> UnitCube::at(std::uint64_t sample) const {
  require_sound(*this, sample);
  std::vector<double> point(dimensions);
  if (sampling == Sampling::sobol) {
    const std::vector<std::uint64_t> raw = sobol_point(dimensions, sample);
    for (std::size_t d = 0; d < dimensions; ++d) point[d] = to_unit(raw[d] ^ random_bits(seed, d, 0));
    return point;
  }
  for (std::size_t d = 0; d < dimensions; ++d) {
    const double within = to_unit(random_bits(seed, d, sample));
    if (sampling == Sampling::random) {
      point[d] = within;
      continue;
    }
    const std::uint64_t stratum = shuffled(sample, count, random_bits(seed, d, count));
    // Rounding may reach the next stratum's lower end; one step down stays within.
    const double low = static_cast<double>(stratum) / static_cast<double>(count);
    const double high = static_cast<double>(stratum + 1) / static_cast<double>(count);
    point[d] = std::min(low + within * (high - low), std::nextafter(high, 0.0));
  }
  return point;
}

}  // namespace glissade::study
