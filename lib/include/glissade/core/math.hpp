#pragma once

#include <cmath>

/// Elementary functions that return the same bits on every x86-64 processor and with every C library.
///
/// The C library picks its sine, exponential, logarithm, power and their inverses by the processor (with or
/// without fused multiply-add); their last digits differ, and a search that ends on a flat optimum carries such
/// a digit into every file. All of the library calls these instead (docs/decisions/0007); IEEE 754 defines
/// std::sqrt, std::fma, std::remainder, std::floor and their like to the last bit, so those stay as they are.
///
/// Angles are in radians. Domains, signs, infinities and NaN are those of the function of the same name in
/// `<cmath>`; errno is never set.
///
/// Accuracy: kMathAccuracyUlp over the whole domain, kHypotAccuracyUlp for the hypotenuse. A power above
/// kLargestPower may be infinite.
///
/// Source: SLEEF (N. Shibata and F. Petrogalli, IEEE Trans. Parallel Distrib. Syst. 31(6), 2020,
/// doi:10.1109/TPDS.2019.2960333), its functions without processor variants.
namespace glissade::math {

/// Largest error of every function but hypot(), in units of the last place of the result.
inline constexpr double kMathAccuracyUlp = 1.0;
/// The same for hypot() of two sides (the three roundings of the sum of squares count by half).
inline constexpr double kHypotAccuracyUlp = 1.25;
/// The powers that pow() surely tells: the largest double less seven millionths of it.
inline constexpr double kLargestPower = 1.79768e308;

[[nodiscard]] double sin(double angle);
[[nodiscard]] double cos(double angle);
[[nodiscard]] double tan(double angle);
[[nodiscard]] double asin(double value);
[[nodiscard]] double acos(double value);
[[nodiscard]] double atan(double value);
[[nodiscard]] double atan2(double y, double x);

/// Both of an angle.
struct SineCosine {
  double sine = 0.0;
  double cosine = 1.0;
};

/// @return sin() and cos() of one angle, to the same bits, at the price of one of them
[[nodiscard]] SineCosine sine_cosine(double angle);

/// @return cos(pi turns), exact where it is 0, 1 or -1
[[nodiscard]] double cos_pi(double turns);

[[nodiscard]] double sinh(double value);
[[nodiscard]] double cosh(double value);
[[nodiscard]] double tanh(double value);
[[nodiscard]] double asinh(double value);

[[nodiscard]] double exp(double value);
[[nodiscard]] double expm1(double value);
[[nodiscard]] double log(double value);
[[nodiscard]] double log1p(double value);
[[nodiscard]] double pow(double base, double exponent);
[[nodiscard]] double cbrt(double value);

/// hypot() where the squares overflow, vanish or are not numbers.
[[nodiscard]] double hypot_of_extremes(double x, double y);

/// @return sqrt(x^2 + y^2) without overflow
[[nodiscard]] inline double hypot(double x, double y) {
  const double square = x * x + y * y;
  return square > 0x1p-900 && square < 0x1p1000 ? std::sqrt(square) : hypot_of_extremes(x, y);
}

/// @return sqrt(x^2 + y^2 + z^2) without overflow
[[nodiscard]] inline double hypot(double x, double y, double z) {
  const double square = x * x + y * y + z * z;
  return square > 0x1p-900 && square < 0x1p1000 ? std::sqrt(square) : hypot(hypot(x, y), z);
}

/// @param value  positive and finite
/// @return the largest power of ten that is no larger, correctly rounded: 100 of 250, 0.001 of 0.005
[[nodiscard]] double decade_of(double value);

}  // namespace glissade::math
