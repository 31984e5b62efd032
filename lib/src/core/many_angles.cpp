#include "glissade/core/many_angles.hpp"

#include "glissade/core/math.hpp"

#include <cmath>
#include <cstddef>

#ifdef __SSE2__
#include <emmintrin.h>
#include <sleef.h>
#endif

namespace glissade::math {
namespace {

void one_by_one(std::span<const double> angles, std::span<double> sines, std::span<double> cosines) {
  for (std::size_t i = 0; i < angles.size(); ++i) {
    const auto [sine, cosine] = sine_cosine(angles[i]);
    sines[i] = sine;
    cosines[i] = cosine;
  }
}

}  // namespace

void sines_cosines(std::span<const double> angles, std::span<double> sines, std::span<double> cosines) {
  std::size_t i = 0;
#ifdef __SSE2__
  // Larger angles are reduced otherwise, and those beside them with them.
  constexpr double kSmall = 10.0;  // below SLEEF's 15
  for (; i + 2 <= angles.size(); i += 2) {
    if (!(std::fabs(angles[i]) <= kSmall && std::fabs(angles[i + 1]) <= kSmall)) {
      one_by_one(angles.subspan(i, 2), sines.subspan(i, 2), cosines.subspan(i, 2));
      continue;
    }
    const Sleef___m128d_2 both = Sleef_cinz_sincosd2_u10sse2(_mm_loadu_pd(&angles[i]));
    _mm_storeu_pd(&sines[i], both.x);
    _mm_storeu_pd(&cosines[i], both.y);
  }
#endif
  one_by_one(angles.subspan(i), sines.subspan(i), cosines.subspan(i));
}

}  // namespace glissade::math
