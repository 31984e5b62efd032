#pragma once

#include <cstring>

// Of processors that add four numbers at once functions marked so take half the time, to the same bits: the order of the
// additions stays, and no variant fuses them with the multiplications (docs/decisions/0007).
#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__)
#define GLISSADE_WIDE_VARIANT __attribute__((target_clones("avx2", "default")))
#else
#define GLISSADE_WIDE_VARIANT
#endif

namespace glissade::optimizer {

/// Four numbers side by side: one register, or two where the processor has none so wide.
using Four [[gnu::vector_size(4 * sizeof(double))]] = double;

inline void load(Four& four, const double* from) {
  std::memcpy(&four, from, sizeof four);
}
inline void store(const Four& four, double* to) {
  std::memcpy(to, &four, sizeof four);
}

}  // namespace glissade::optimizer
