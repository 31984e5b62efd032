#include "glissade/core/many_angles.hpp"

#include "glissade/core/math.hpp"

#include <cmath>
#include <cstddef>
#include <limits>

#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__)
#define GLISSADE_HAS_WIDE_FUNCTIONS
#include <immintrin.h>
#include <sleef.h>
// SLEEF's header declares the functions of a processor only to files that are compiled for it as a whole.
#ifndef __AVX__
struct Sleef___m256d_2 {
  __m256d x, y;
};
extern "C" {
__attribute__((target("avx"))) Sleef___m256d_2 Sleef_cinz_sincosd4_u10avx(__m256d angles);
__attribute__((target("avx"))) __m256d Sleef_cinz_expd4_u10avx(__m256d values);
}
#endif
#endif

namespace glissade::math {
namespace {

// Larger angles are reduced otherwise, and those beside them with them.
constexpr double kSmall = 10.0;  // below SLEEF's 15

[[nodiscard]] bool all_small(std::span<const double> angles) {
  bool small = true;
  for (const double angle : angles) small = small && std::fabs(angle) <= kSmall;
  return small;
}

void one_by_one(std::span<const double> angles, std::span<double> sines, std::span<double> cosines) {
  for (std::size_t i = 0; i < angles.size(); ++i) {
    const auto [sine, cosine] = sine_cosine(angles[i]);
    sines[i] = sine;
    cosines[i] = cosine;
  }
}

[[nodiscard]] bool any_infinite(std::span<const double> results) {
  bool any = false;
  for (const double result : results) any = any || result > std::numeric_limits<double>::max();
  return any;
}

#ifdef GLISSADE_HAS_WIDE_FUNCTIONS

[[nodiscard]] bool has_wide_registers() {
  static const bool has = __builtin_cpu_supports("avx") != 0;
  return has;
}

/// Of as many as four go into. @return how many were done
__attribute__((target("avx"))) std::size_t four_by_four(std::span<const double> angles,
                                                        std::span<double> sines, std::span<double> cosines) {
  std::size_t i = 0;
  for (; i + 4 <= angles.size(); i += 4) {
    if (!all_small(angles.subspan(i, 4))) {
      one_by_one(angles.subspan(i, 4), sines.subspan(i, 4), cosines.subspan(i, 4));
      continue;
    }
    const Sleef___m256d_2 both = Sleef_cinz_sincosd4_u10avx(_mm256_loadu_pd(&angles[i]));
    _mm256_storeu_pd(&sines[i], both.x);
    _mm256_storeu_pd(&cosines[i], both.y);
  }
  return i;
}

__attribute__((target("avx"))) std::size_t four_by_four(std::span<const double> values,
                                                        std::span<double> results) {
  std::size_t i = 0;
  for (; i + 4 <= values.size(); i += 4)
    _mm256_storeu_pd(&results[i], Sleef_cinz_expd4_u10avx(_mm256_loadu_pd(&values[i])));
  return i;
}

std::size_t two_by_two(std::span<const double> angles, std::span<double> sines, std::span<double> cosines) {
  std::size_t i = 0;
  for (; i + 2 <= angles.size(); i += 2) {
    if (!all_small(angles.subspan(i, 2))) {
      one_by_one(angles.subspan(i, 2), sines.subspan(i, 2), cosines.subspan(i, 2));
      continue;
    }
    const Sleef___m128d_2 both = Sleef_cinz_sincosd2_u10sse2(_mm_loadu_pd(&angles[i]));
    _mm_storeu_pd(&sines[i], both.x);
    _mm_storeu_pd(&cosines[i], both.y);
  }
  return i;
}

std::size_t two_by_two(std::span<const double> values, std::span<double> results) {
  std::size_t i = 0;
  for (; i + 2 <= values.size(); i += 2)
    _mm_storeu_pd(&results[i], Sleef_cinz_expd2_u10sse2(_mm_loadu_pd(&values[i])));
  return i;
}

#endif

}  // namespace

void sines_cosines(std::span<const double> angles, std::span<double> sines, std::span<double> cosines) {
  std::size_t done = 0;
#ifdef GLISSADE_HAS_WIDE_FUNCTIONS
  if (has_wide_registers()) done = four_by_four(angles, sines, cosines);
  done += two_by_two(angles.subspan(done), sines.subspan(done), cosines.subspan(done));
#endif
  one_by_one(angles.subspan(done), sines.subspan(done), cosines.subspan(done));
}

void exponentials(std::span<const double> values, std::span<double> results) {
  std::size_t i = 0;
#ifdef GLISSADE_HAS_WIDE_FUNCTIONS
  if (has_wide_registers()) i = four_by_four(values, results);
  i += two_by_two(values.subspan(i), results.subspan(i));
#endif
  for (; i < values.size(); ++i) results[i] = exp(values[i]);
  // The wide functions end before their value is no number.
  if (!any_infinite(results)) return;
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (std::isinf(results[k])) results[k] = exp(values[k]);
  }
}

}  // namespace glissade::math
