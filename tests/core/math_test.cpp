// The library's elementary functions against the C library's in extended precision.

#include "glissade/core/math.hpp"

#include "glissade/core/many_angles.hpp"

#include "support/catch.hpp"
#include "support/random.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <vector>

using namespace glissade;

namespace {

/// @return error of `found` in units of its last place; `exact` has 64 bits
double error_in_ulp(double found, long double exact) {
  const double size = std::fabs(found);
  const double place = std::nextafter(size, std::numeric_limits<double>::infinity()) - size;
  return static_cast<double>(std::fabs(found - exact) / place);
}

constexpr int kTries = 20'000;

template <class Ours, class Exact>
double worst(Ours ours, Exact exact, double low, double high) {
  testing::Random random = testing::seeded_random();
  double largest = 0.0;
  for (int i = 0; i < kTries; ++i) {
    const double x = random.between(low, high);
    largest = std::max(largest, error_in_ulp(ours(x), exact(static_cast<long double>(x))));
  }
  return largest;
}

}  // namespace

// Extended precision is itself good to some 0.001 ulp of a double.
constexpr double kBound = math::kMathAccuracyUlp + 0.002;

#define CHECK_FUNCTION(name, low, high)                                                                \
  CHECK(worst([](double x) { return math::name(x); }, [](long double x) { return std::name(x); }, low, \
              high) <= kBound)

TEST_CASE("elementary functions keep the accuracy that is stated") {
  CHECK_FUNCTION(sin, -7.0, 7.0);
  CHECK_FUNCTION(sin, -1e6, 1e6);
  CHECK_FUNCTION(cos, -7.0, 7.0);
  CHECK_FUNCTION(tan, -1.57, 1.57);
  CHECK_FUNCTION(asin, -1.0, 1.0);
  CHECK_FUNCTION(acos, -1.0, 1.0);
  CHECK_FUNCTION(atan, -5.0, 5.0);
  CHECK_FUNCTION(sinh, -3.0, 3.0);
  CHECK_FUNCTION(cosh, -3.0, 3.0);
  CHECK_FUNCTION(tanh, -3.0, 3.0);
  CHECK_FUNCTION(asinh, -5.0, 5.0);
  CHECK_FUNCTION(exp, -700.0, 700.0);
  CHECK_FUNCTION(exp, -1e-3, 1e-3);
  CHECK_FUNCTION(expm1, -40.0, 40.0);
  CHECK_FUNCTION(expm1, -1e-3, 1e-3);
  CHECK_FUNCTION(log, 0.0, 10.0);
  CHECK_FUNCTION(log, 0.999, 1.001);
  CHECK_FUNCTION(log1p, -0.999, 10.0);
  CHECK_FUNCTION(log1p, -1e-3, 1e-3);
  CHECK_FUNCTION(cbrt, -5.0, 5.0);
}

TEST_CASE("hyperbolic functions keep their accuracy up to where their value ends to be a number") {
  constexpr double kLast = 710.475860073943;  // acosh of the largest double, rounded down
  CHECK_FUNCTION(sinh, 700.0, kLast);
  CHECK_FUNCTION(sinh, -kLast, -709.7);
  CHECK_FUNCTION(cosh, 709.7, kLast);
  CHECK_FUNCTION(asinh, 1e150, 1e155);
  CHECK_FUNCTION(asinh, -1e300, -1e155);
  CHECK_FUNCTION(asinh, 1e307, std::numeric_limits<double>::max());
  const double infinity = std::numeric_limits<double>::infinity();
  CHECK(math::sinh(711.0) == infinity);
  CHECK(math::sinh(-711.0) == -infinity);
  CHECK(math::cosh(-infinity) == infinity);
  CHECK(math::asinh(-infinity) == -infinity);
  CHECK(std::isnan(math::sinh(std::numeric_limits<double>::quiet_NaN())));
}

TEST_CASE(
    "exponentials keep their accuracy up to where their value ends to be a number, one by one and many") {
  constexpr double kLast = 709.78271289338397;  // ln of the largest double, rounded down
  const double infinity = std::numeric_limits<double>::infinity();
  CHECK_FUNCTION(exp, 709.7827, kLast);
  CHECK_FUNCTION(expm1, 709.7827, kLast);
  CHECK_FUNCTION(exp, -745.13, -708.0);
  for (const double value : {std::nextafter(kLast, 1000.0), 709.8, 711.0, 1e300, infinity}) {
    CHECK(math::exp(value) == infinity);
    CHECK(math::expm1(value) == infinity);
  }
  CHECK(std::isfinite(math::exp(kLast)));
  testing::Random random = testing::seeded_random();
  std::vector<double> values(1000);
  for (double& value : values) value = random.between(709.782711, 709.782713);
  std::vector<double> results(values.size());
  math::exponentials(values, results);
  for (std::size_t i = 0; i < values.size(); ++i) CHECK(results[i] == math::exp(values[i]));
  // The same of powers, as far as they are stated to be told.
  for (int i = 0; i < 1000; ++i) {
    const double base = std::exp(random.between(0.01, 600.0));
    const double exponent =
        std::log(math::kLargestPower) / std::log(base) * random.between(0.99, 1.0 - 1e-12);
    CAPTURE(base, exponent);
    CHECK(error_in_ulp(math::pow(base, exponent), std::pow(static_cast<long double>(base), exponent)) <=
          kBound);
  }
}

TEST_CASE("the cosine of turns is that of what is left of whole ones, however many they are") {
  testing::Random random = testing::seeded_random();
  for (const double whole : {0.0, 2.0, 0x1p20, 0x1p21, 250'000'000.0, 1e9, 0x1p40, 0x1p48}) {
    for (int i = 0; i < 100; ++i) {
      const double part = std::floor(random.between(0.0, 32.0)) / 16.0;
      CAPTURE(whole, part);
      CHECK(math::cos_pi(whole + part) == math::cos_pi(part));
      CHECK(math::cos_pi(-whole - part) == math::cos_pi(part));
    }
  }
  CHECK(math::cos_pi(250'000'000.5) == 0.0);
  CHECK(math::cos_pi(1e9 + 1.0) == -1.0);
  CHECK(math::cos_pi(0x1p53 - 1.0) == -1.0);
  CHECK(math::cos_pi(1e300) == 1.0);
  CHECK(std::isnan(math::cos_pi(std::numeric_limits<double>::infinity())));
}

TEST_CASE("hypotenuses and angles so small that they lose digits are right to the last one left") {
  testing::Random random = testing::seeded_random();
  double largest_hypot = 0.0;
  double largest_atan2 = 0.0;
  for (int i = 0; i < kTries; ++i) {
    const double size = std::ldexp(1.0, static_cast<int>(random.between(-1074.0, -480.0)));
    const double x = size * random.between(0.0, 3.0);
    const double y = size * random.between(0.0, 3.0);
    largest_hypot =
        std::max(largest_hypot, error_in_ulp(math::hypot(x, y), std::hypot(static_cast<long double>(x), y)));
    const double beside = random.between(1.0, 1e5);
    const double above =
        std::ldexp(random.between(1.0, 2.0), static_cast<int>(random.between(-1074.0, -960.0)));
    largest_atan2 = std::max(
        largest_atan2,
        error_in_ulp(math::atan2(above, beside), std::atan2(static_cast<long double>(above), beside)));
  }
  CHECK(largest_hypot <= math::kHypotAccuracyUlp);
  CHECK(largest_atan2 <= kBound);
  CHECK(math::atan2(0.0, 0.0) == 0.0);
  CHECK(math::atan2(1e-310, std::numeric_limits<double>::infinity()) == 0.0);
}

TEST_CASE("elementary functions of two numbers keep the accuracy that is stated") {
  testing::Random random = testing::seeded_random();
  double largest_atan2 = 0.0;
  double largest_pow = 0.0;
  double largest_hypot = 0.0;
  for (int i = 0; i < kTries; ++i) {
    const double x = random.between(-3.0, 3.0);
    const double y = random.between(-3.0, 3.0);
    const long double long_x = x;
    const long double long_y = y;
    largest_atan2 = std::max(largest_atan2, error_in_ulp(math::atan2(y, x), std::atan2(long_y, long_x)));
    largest_pow =
        std::max(largest_pow, error_in_ulp(math::pow(std::fabs(x), y), std::pow(std::fabs(long_x), long_y)));
    largest_hypot = std::max(largest_hypot, error_in_ulp(math::hypot(x, y), std::hypot(long_x, long_y)));
  }
  CHECK(largest_atan2 <= kBound);
  CHECK(largest_pow <= kBound);
  CHECK(largest_hypot <= math::kHypotAccuracyUlp);
}

TEST_CASE("sine and cosine asked for together are those asked for alone") {
  testing::Random random = testing::seeded_random();
  for (int i = 0; i < 1000; ++i) {
    const double angle = random.between(-10.0, 10.0);
    const auto [sine, cosine] = math::sine_cosine(angle);
    CHECK(sine == math::sin(angle));
    CHECK(cosine == math::cos(angle));
  }
}

TEST_CASE("sines and cosines of many angles are those of each, whatever stands beside it") {
  testing::Random random = testing::seeded_random();
  for (const std::size_t count : {0, 1, 2, 7, 1000}) {
    std::vector<double> angles(count);
    for (std::size_t i = 0; i < count; ++i) {
      const double widths[] = {1e-9, 0.5, 3.0, 10.0, 20.0, 1e6};
      const double width = widths[static_cast<std::size_t>(random.between(0.0, 6.0)) % 6];
      angles[i] = random.between(-width, width);
    }
    if (count > 2) angles[2] = std::numeric_limits<double>::infinity();
    std::vector<double> sines(count);
    std::vector<double> cosines(count);
    math::sines_cosines(angles, sines, cosines);
    for (std::size_t i = 0; i < count; ++i) {
      const auto [sine, cosine] = math::sine_cosine(angles[i]);
      CAPTURE(angles[i]);
      CHECK(std::bit_cast<std::uint64_t>(sines[i]) == std::bit_cast<std::uint64_t>(sine));
      CHECK(std::bit_cast<std::uint64_t>(cosines[i]) == std::bit_cast<std::uint64_t>(cosine));
    }
  }
}

TEST_CASE("exponentials of many values are those of each, whatever stands beside it") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (const std::size_t count : {0, 1, 2, 3, 7, 2000}) {
    std::vector<double> values(count);
    for (double& value : values) {
      const double widths[] = {1e-9, 0.5, 3.0, 40.0, 1000.0};
      const double width = widths[static_cast<std::size_t>(random.between(0.0, 5.0)) % 5];
      value = random.between(-width, width);
    }
    if (count > 3) {
      values[1] = std::numeric_limits<double>::infinity();
      values[2] = -values[1];
      values[3] = std::numeric_limits<double>::quiet_NaN();
    }
    std::vector<double> results(count);
    math::exponentials(values, results);
    for (std::size_t i = 0; i < count; ++i) {
      CAPTURE(values[i]);
      const double alone = math::exp(values[i]);
      if (std::isnan(alone)) {
        CHECK(std::isnan(results[i]));
      } else {
        CHECK(std::bit_cast<std::uint64_t>(results[i]) == std::bit_cast<std::uint64_t>(alone));
      }
    }
  }
}

TEST_CASE("elementary functions are exact where geometry counts on it") {
  CHECK(math::sin(0.0) == 0.0);
  CHECK(math::cos(0.0) == 1.0);
  CHECK(math::tan(0.0) == 0.0);
  CHECK(math::exp(0.0) == 1.0);
  CHECK(math::log(1.0) == 0.0);
  CHECK(math::atan2(0.0, 1.0) == 0.0);
  CHECK(math::atan2(1.0, 0.0) == std::numbers::pi / 2.0);
  CHECK(math::atan2(0.0, -1.0) == std::numbers::pi);
  CHECK(math::cos_pi(0.5) == 0.0);
  CHECK(math::cos_pi(1.0) == -1.0);
  CHECK(math::hypot(3.0, 4.0) == 5.0);
  CHECK(math::hypot(2.0, 3.0, 6.0) == 7.0);
  CHECK(math::hypot(0.0, -7.0) == 7.0);
}

TEST_CASE("elementary functions keep their last digit, and their sign, at the ends of the range of numbers") {
  constexpr double kLeast = std::numeric_limits<double>::denorm_min();
  for (const double value : {-kLeast, kLeast, -3e-308, 2e-301, -0.0}) {
    INFO(value);
    for (const double found :
         {math::sin(value), math::tan(value), math::asin(value), math::atan(value), math::sinh(value),
          math::tanh(value), math::asinh(value), math::expm1(value), math::log1p(value)}) {
      CHECK(found == value);
      CHECK(std::signbit(found) == std::signbit(value));
    }
  }
  CHECK_THAT(math::log1p(1.1e307), Catch::Matchers::WithinRel(706.9889337289763, 2.3e-16));
  CHECK_THAT(math::log1p(std::numeric_limits<double>::max()),
             Catch::Matchers::WithinRel(709.782712893384, 2.3e-16));
}

TEST_CASE("a hypotenuse neither overflows nor vanishes before its sides do") {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  CHECK(math::hypot(3e200, 4e200) == Approx(5e200).epsilon(1e-15));
  CHECK(math::hypot(3e-200, 4e-200) == Approx(5e-200).epsilon(1e-15));
  CHECK(math::hypot(2e-200, 3e-200, 6e-200) == Approx(7e-200).epsilon(1e-15));
  CHECK(math::hypot(0.0, 0.0) == 0.0);
  CHECK(math::hypot(kInfinity, 1.0) == kInfinity);
  CHECK(std::isnan(math::hypot(std::numeric_limits<double>::quiet_NaN(), 1.0)));
}

TEST_CASE("the decade of a number is the power of ten below it, to the last bit") {
  CHECK(math::decade_of(1.0) == 1.0);
  CHECK(math::decade_of(250.0) == 100.0);
  CHECK(math::decade_of(0.005) == 0.001);
  CHECK(math::decade_of(1000.0) == 1000.0);
  CHECK(math::decade_of(std::nextafter(1000.0, 0.0)) == 100.0);
  CHECK(math::decade_of(9.999999e-7) == 1e-7);
  CHECK(math::decade_of(1e300) == 1e300);
}
