// Prints one line a number: a checksum of what the C library's elementary functions return, then one of what
// ours return. Run once as the processor is and once without its fused multiply-add, it shows that the C
// library's differ, so that a test of "the same bytes" can fail.

#include "glissade/core/math.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <initializer_list>

namespace {

std::uint64_t mixed(std::uint64_t sum, double value) {
  return sum * 6364136223846793005U + std::bit_cast<std::uint64_t>(value);
}

}  // namespace

int main() {
  namespace math = glissade::math;
  std::uint64_t theirs = 0;
  std::uint64_t ours = 0;
  for (int i = 1; i < 20'000; ++i) {
    const double x = i * 0x1.9p-13 / 3.0;
    for (const double value : {std::sin(x), std::cos(x), std::tan(x), std::atan(x), std::atan2(x, 0.7),
                               std::exp(x), std::log(x), std::pow(x, 0.7)}) {
      theirs = mixed(theirs, value);
    }
    for (const double value :
         {math::sin(x), math::cos(x), math::tan(x), math::asin(x), math::acos(x), math::atan(x),
          math::atan2(x, 0.7), math::cos_pi(x), math::sinh(x), math::cosh(x), math::tanh(x), math::asinh(x),
          math::exp(x), math::expm1(x), math::log(x), math::log1p(x), math::pow(x, 0.7), math::cbrt(x),
          math::hypot(x, 0.7)}) {
      ours = mixed(ours, value);
    }
  }
  std::printf("%016llx\n%016llx\n", static_cast<unsigned long long>(theirs),
              static_cast<unsigned long long>(ours));
  return 0;
}
