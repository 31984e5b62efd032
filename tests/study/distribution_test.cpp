#include "glissade/study/distribution.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/number_text.hpp"

#include "study/sobol.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include <boost/random/sobol.hpp>

using namespace glissade;
using namespace glissade::study;
using Catch::Matchers::Contains;

namespace {

/// Share of a normal distribution below x, by the error function: another route than the quantile's.
double normal_below(double x) {
  return 0.5 * std::erfc(-x / std::sqrt(2.0));
}

double quantile(const std::string& law, double probability) {
  return Distribution::parse(law, "--scatter x").quantile(probability);
}

}  // namespace

TEST_CASE("a quantile is the value below which that share lies") {
  for (const double p : {1e-12, 1e-4, 0.025, 0.3, 0.5, 0.77, 0.999, 1.0 - 1e-9}) {
    INFO(p);
    CHECK(std::fabs(quantile("uniform(2deg,5deg)", p) - (2.0 + 3.0 * p)) <= 1e-14);
    CHECK(std::fabs(normal_below((quantile("normal(17deg,1.5deg)", p) - 17.0) / 1.5) / p - 1.0) <= 1e-9);
    CHECK(std::fabs(normal_below(std::log(quantile("lognormal(17,0.2)", p) / 17.0) / 0.2) / p - 1.0) <= 1e-9);
    const double t = quantile("triangular(1,2,5)", p);
    const double below = t <= 2.0 ? (t - 1.0) * (t - 1.0) / 4.0 : 1.0 - (5.0 - t) * (5.0 - t) / 12.0;
    CHECK(std::fabs(below / p - 1.0) <= 1e-9);
  }
}

TEST_CASE("a quantile lies between the ends of a probability, which have none") {
  for (const char* const law : {"uniform(15,19)", "normal(17,1.5)", "truncated-normal(5,1,0,1)",
                                "lognormal(17,0.1)", "triangular(14,17,21)"}) {
    for (const double p : {0.0, 1.0, -1.0, 2.0, std::nan("")}) {
      INFO(law << " at " << p);
      CHECK_THROWS_AS(quantile(law, p), InputError);
    }
  }
}

TEST_CASE("a truncated normal distribution keeps its bounds and its shares, far in a tail too") {
  for (const auto& [low, high] :
       {std::pair(14.0, 20.0), std::pair(20.0, 30.0), std::pair(2.0, 10.0), std::pair(25.0, 26.0)}) {
    const std::string law =
        "truncated-normal(17,1.5," + std::to_string(low) + "," + std::to_string(high) + ")";
    INFO(law);
    for (const double p : {1e-9, 0.2, 0.5, 0.9, 1.0 - 1e-9}) {
      const double value = quantile(law, p);
      CHECK(value >= low);
      CHECK(value <= high);
      // Shares are taken from the side of the tail, where they keep their digits.
      const double sign = low > 17.0 ? -1.0 : 1.0;
      const auto share = [&](double x) { return normal_below(sign * (x - 17.0) / 1.5); };
      CHECK(std::fabs((share(value) - share(low)) / (share(high) - share(low)) - p) <= 1e-9);
    }
  }
}

TEST_CASE("quantiles of a truncated normal distribution are those of its mirror image, in both tails") {
  const auto law = [](double low, double high) {
    return "truncated-normal(0,1," + exact_text(low) + "," + exact_text(high) + ")";
  };
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (int i = 0; i < 300; ++i) {
    const double low = random.between(-29.0, 29.0);
    const double high = low + std::exp(random.between(-20.0, 3.0));
    // Digits that both tails keep.
    const double p =
        std::ldexp(std::floor(random.between(1.0, 1024.0)), -static_cast<int>(random.between(11.0, 50.0)));
    CAPTURE(low, high, p);
    const double width = std::min(high - low, 1.0);
    const double rounding = 3e-16 * std::max(std::fabs(low), std::fabs(high));
    CHECK(std::fabs(quantile(law(low, high), 1.0 - p) + quantile(law(-high, -low), p)) <=
          1e-13 * width + rounding);
  }
  // bisection of erfc
  CHECK(std::fabs(quantile(law(-0.5, 30.0), 1.0 - 1e-9) - 6.057454444532) <= 1e-11);
}

TEST_CASE(
    "between bounds that are near to each other a normal distribution is a line, and its slope bends it") {
  for (const double low : {-25.0, -1.0, -5e-7, 0.0, 2.0, 29.0}) {
    for (const double width : {1e-10, 1e-8, 1e-6, 0.00999, 0.0101}) {
      const double high = low + width;
      const double exact_width = high - low;
      const std::string law = "truncated-normal(0,1," + exact_text(low) + "," + exact_text(high) + ")";
      for (const double p : {1e-6, 0.25, 0.5, 0.9}) {
        CAPTURE(law, p);
        // The density exp(-low t) over so short a way has a closed form.
        const double middle = low + 0.5 * exact_width;
        const double steep = middle * exact_width;
        const double share = std::fabs(steep) < 1e-7 ? p * (1.0 + 0.5 * steep * (p - 1.0))
                                                     : -std::log1p(p * std::expm1(-steep)) / steep;
        const double square = exact_width * exact_width;  // what t^2/2 beside it bends
        CHECK(std::fabs(quantile(law, p) - (low + exact_width * share)) <=
              1e-13 * exact_width + exact_width * 0.1 * square + 5e-16 * std::fabs(low));
      }
    }
  }
}

TEST_CASE("a distribution reads back from its own text") {
  for (const char* law :
       {"uniform(15deg,19deg)", "normal(17deg,1.5deg)", "truncated-normal(17deg,1.5deg,14deg,20deg)",
        "lognormal(0.3,0.1)", "lognormal(17deg,0.1)", "triangular(14mm,17mm,21mm)",
        "uniform(0.001 1/m,0.003 1/m)", "lognormal(0.01 1/m,0.5)", "normal(0.08 1/m^2,0.01 1/m^2)"}) {
    CHECK(Distribution::parse(law, "x").text() == law);
  }
  CHECK(Distribution::parse(" normal( 17 deg , 1.5 deg ) ", "x").text() == "normal(17deg,1.5deg)");
}

TEST_CASE("a distribution that is none is refused with what would be one") {
  const auto refused = [](const std::string& law, const std::string& message) {
    INFO(law);
    CHECK_THROWS_AS(Distribution::parse(law, "--scatter k"), InputError);
    CHECK_THROWS_WITH(Distribution::parse(law, "--scatter k"),
                      Contains("--scatter k: ") && Contains(message));
  };
  refused("gauss(1,2)", "There are uniform, normal, truncated-normal, lognormal and triangular");
  refused("normal", "is no distribution");
  refused("normal(17deg)", "has 1 parameters instead of 2");
  refused("normal(17deg,1.5)", "All parameters of a distribution are in one unit");
  refused("normal(17deg,x)", "'x' in 'normal(17deg,x)' is no number");
  refused("normal(17deg,0deg)", "the standard deviation 0 is not positive");
  refused("uniform(3,2)", "the width -1 is not positive");
  refused("uniform(-1e308,1e308)", "the width is beyond the range of numbers");
  refused("lognormal(-1,0.2)", "the median -1 is not positive");
  refused("lognormal(1deg,0.2deg)", "The standard deviation of a logarithm has none");
  refused("triangular(1,7,5)", "the mode 7 does not lie between 1 and 5");
  refused("truncated-normal(0,1,50,60)", "more than 30 standard deviations from the mean");
}

TEST_CASE("a point of Sobol's sequence is found by its number alone") {
  boost::random::sobol sequence(7);
  CHECK(sobol_point(7, 0) == std::vector<std::uint64_t>(7, 0));
  for (std::uint64_t index = 1; index < 3000; ++index) {
    std::vector<std::uint64_t> expected(7);
    for (std::uint64_t& coordinate : expected) coordinate = sequence();
    REQUIRE(sobol_point(7, index) == expected);
  }
}

TEST_CASE("samples lie within the cube, depend on the seed and on nothing else") {
  for (const Sampling sampling : {Sampling::random, Sampling::latin_hypercube, Sampling::sobol}) {
    const UnitCube cube{sampling, 5000, 4, 7};
    const UnitCube other{sampling, 5000, 4, 8};
    std::size_t same = 0;
    std::vector<double> sums(4, 0.0);
    for (std::uint64_t sample = 0; sample < cube.count; ++sample) {
      const std::vector<double> point = cube.at(sample);
      CHECK(point == cube.at(sample));
      if (point == other.at(sample)) ++same;
      for (std::size_t d = 0; d < 4; ++d) {
        REQUIRE(point[d] > 0.0);
        REQUIRE(point[d] < 1.0);
        sums[d] += point[d];
      }
    }
    CHECK(same == 0);
    // Standard error of the mean of 5000 random numbers: 0.0041.
    for (const double sum : sums) CHECK(std::fabs(sum / 5000.0 - 0.5) < 5 * 0.0041);
  }
}

TEST_CASE("samples beyond what is stated of the cube are refused with the bound") {
  for (const Sampling sampling : {Sampling::random, Sampling::latin_hypercube, Sampling::sobol}) {
    const auto refused = [&](const UnitCube& cube, std::uint64_t sample, const std::string& message) {
      CHECK_THROWS_AS(cube.at(sample), InputError);
      CHECK_THROWS_WITH(cube.at(sample), Contains(message));
    };
    constexpr std::uint64_t kMost = UnitCube::kMostSamples;
    refused({sampling, 0, 2, 1}, 0, "samples: 0 is not within 1 to 9007199254740992");
    refused({sampling, std::uint64_t{1} << 63U, 2, 1}, 0, "samples: 9223372036854775808 is not within 1 to");
    refused({sampling, kMost + 1, 2, 1}, 0, "samples: 9007199254740993 is not within 1 to");
    refused({sampling, 5, 2, 1}, 5, "sample: 5 is not within 0 to 4");
    refused({sampling, 5, 65, 1}, 0, "dimensions: 65 is not within 1 to 64");
    refused({sampling, 5, 0, 1}, 0, "dimensions: 0 is not within 1 to 64");
    for (const std::uint64_t count : {std::uint64_t{1}, std::uint64_t{5}, kMost - 1, kMost}) {
      for (const double coordinate : UnitCube{sampling, count, 64, 1}.at(count - 1)) {
        CHECK(coordinate > 0.0);
        CHECK(coordinate < 1.0);
      }
    }
  }
}

TEST_CASE("a Latin hypercube meets each share of each dimension once") {
  for (const std::uint64_t count : {1U, 2U, 7U, 100U, 1000U}) {
    const UnitCube cube{Sampling::latin_hypercube, count, 3, 11};
    for (std::size_t d = 0; d < 3; ++d) {
      std::set<std::uint64_t> met;
      for (std::uint64_t sample = 0; sample < count; ++sample) {
        met.insert(static_cast<std::uint64_t>(cube.at(sample)[d] * static_cast<double>(count)));
      }
      CHECK(met.size() == count);
    }
  }
}

TEST_CASE("the first 2^m samples of Sobol's sequence meet each 2^-m share once") {
  const UnitCube cube{Sampling::sobol, 256, 5, 3};
  for (std::size_t d = 0; d < 5; ++d) {
    std::set<int> met;
    for (std::uint64_t sample = 0; sample < 256; ++sample)
      met.insert(static_cast<int>(cube.at(sample)[d] * 256.0));
    CHECK(met.size() == 256);
  }
}

TEST_CASE("a way to draw samples has a word, and the word names it") {
  for (const Sampling sampling : {Sampling::random, Sampling::latin_hypercube, Sampling::sobol}) {
    CHECK(sampling_named(word(sampling)) == sampling);
  }
  CHECK_THROWS_WITH(sampling_named("halton"), Contains("There are random, latin-hypercube and sobol"));
}
