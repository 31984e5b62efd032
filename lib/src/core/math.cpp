// SLEEF's "cinz" functions of one double in pure C: consistent results, no fused multiply-add. Their callers need
// none of its header, which declares vectors of every processor.

#include "glissade/core/math.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>

#include <sleef.h>

namespace glissade::math {
namespace {

/// SLEEF's exponentials end 1.7e-9 before their value is no number.
constexpr double kLastExponent = 710.0;  // theory: beyond ln of the largest double

/// @return exp(value)/2, where exp(value) itself may be beyond the largest double and half of it is not
double half_exponential(double value) {
  // theory: exp(710)/2 as the sum of two doubles
  constexpr double kMiddle = 710.0;
  constexpr double kHalf = 0x1.3e21a464507f9p+1023;
  constexpr double kHalfRest = 0x1.282b80dc02e26p+969;
  const double growth = expm1(value - kMiddle);
  const double more = kHalf * growth;
  const double sum = kHalf + more;
  if (!std::isfinite(sum)) return sum;
  const double rest = more - (sum - kHalf);
  return sum + (rest + (std::fma(kHalf, growth, -more) + kHalfRest));
}

/// So near zero that a function with slope one there is its argument to the last bit: SLEEF's lose the sign of the smallest.
bool is_tiny(double value) {
  constexpr double kTiny = 1e-300;  // theory: what follows is below it by 1e-300 of it
  return std::fabs(value) < kTiny;
}

/// @return log(2 value) of a large finite value
double logarithm_of_double(double value) {
  constexpr double kTopBinade = 0x1p1023;
  if (value < kTopBinade) return log(2.0 * value);
  // theory: 1024 ln 2 as the sum of two doubles
  constexpr double kBits = 0x1.62e42fefa39efp+9;
  constexpr double kBitsRest = 0x1.abc9e3b39803fp-46;
  return kBits + (log(value / kTopBinade) + kBitsRest);
}

}  // namespace

double sin(double angle) {
  return sine_cosine(angle).sine;
}

double cos(double angle) {
  return sine_cosine(angle).cosine;
}

double tan(double angle) {
  if (is_tiny(angle)) return angle;
  return Sleef_cinz_tand1_u10purec(angle);
}

double asin(double value) {
  return Sleef_cinz_asind1_u10purec(value);
}

double acos(double value) {
  return Sleef_cinz_acosd1_u10purec(value);
}

double atan(double value) {
  return Sleef_cinz_atand1_u10purec(value);
}

double atan2(double y, double x) {
  constexpr double kSmall =
      0x1p-1000;  // theory: its cube is nothing; SLEEF rounds twice what loses digits there
  const double angle = Sleef_cinz_atan2d1_u10purec(y, x);
  return std::fabs(angle) < kSmall && y != 0.0 ? y / x : angle;
}

SineCosine sine_cosine(double angle) {
  const Sleef_double_2 both = Sleef_cinz_sincosd1_u10purec(angle);
  return {both.x, both.y};
}

double cos_pi(double turns) {
  constexpr double kLarge = 0x1p20;  // taste: below SLEEF's 2.5e8, beyond which it takes every cosine for one
  if (!(std::fabs(turns) > kLarge)) return Sleef_cinz_cospid1_u05purec(turns);
  if (std::isinf(turns)) return std::numeric_limits<double>::quiet_NaN();
  return Sleef_cinz_cospid1_u05purec(std::remainder(turns, 2.0));
}

double sinh(double value) {
  const double sine = Sleef_cinz_sinhd1_u10purec(value);
  // SLEEF's exponential overflows before its half does.
  if (!std::isinf(sine) || std::isinf(value)) return sine;
  return std::copysign(half_exponential(std::fabs(value)), value);
}

double cosh(double value) {
  const double cosine = Sleef_cinz_coshd1_u10purec(value);
  if (!std::isinf(cosine) || std::isinf(value)) return cosine;
  return half_exponential(std::fabs(value));
}

double tanh(double value) {
  return Sleef_cinz_tanhd1_u10purec(value);
}

double asinh(double value) {
  if (is_tiny(value)) return value;
  const double angle = Sleef_cinz_asinhd1_u10purec(value);
  // SLEEF's square of it overflows.
  if (!std::isinf(angle) || std::isinf(value)) return angle;
  return std::copysign(logarithm_of_double(std::fabs(value)), value);
}

double exp(double value) {
  const double power = Sleef_cinz_expd1_u10purec(value);
  if (!std::isinf(power) || value > kLastExponent) return power;
  return 2.0 * half_exponential(value);
}

double expm1(double value) {
  const double growth = Sleef_cinz_expm1d1_u10purec(value);
  if (!std::isinf(growth) || value > kLastExponent) return growth;
  return 2.0 * half_exponential(value);
}

double log(double value) {
  return Sleef_cinz_logd1_u10purec(value);
}

double log1p(double value) {
  // Beyond it one is less than the last digit; SLEEF's sum overflows from 1e307 on.
  constexpr double kLarge = 1e300;  // theory
  if (is_tiny(value)) return value;
  if (value > kLarge) return log(value);
  return Sleef_cinz_log1pd1_u10purec(value);
}

double pow(double base, double exponent) {
  return Sleef_cinz_powd1_u10purec(base, exponent);
}

double cbrt(double value) {
  return Sleef_cinz_cbrtd1_u10purec(value);
}

double hypot_of_extremes(double x, double y) {
  // SLEEF loses digits where the result has fewer than 53.
  constexpr double kSmall = 0x1p-500;  // theory: as many binades as the scale, whose products are exact
  constexpr double kScale = 0x1p+500;  // theory: 2^-1074 of it has all its digits
  if (std::fabs(x) < kSmall && std::fabs(y) < kSmall)
    return Sleef_cinz_hypotd1_u05purec(kScale * x, kScale * y) / kScale;
  return Sleef_cinz_hypotd1_u05purec(x, y);
}

double decade_of(double value) {
  std::array<char, 32> text;
  char* const end =
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::scientific).ptr;
  char* const exponent = std::find(text.data(), end, 'e');
  double decade = 0.0;
  if (exponent == end) return decade;
  char* const one = exponent - 1;  // "2.5e+02": the last digit before the exponent gives way to 1
  *one = '1';
  std::from_chars(one, end, decade);
  return decade;
}

}  // namespace glissade::math
