#pragma once

#include <cstdint>
#include <cstdlib>
#include <random>
#include <string>

namespace testing {

/// Random numbers that are the same on every machine: std's distributions are not.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed), seed_(seed) {}

  [[nodiscard]] std::uint64_t seed() const { return seed_; }

  /// @return a number in [low, high)
  double between(double low, double high) {
    constexpr double kOneOver2To53 = 0x1p-53;
    return low + (high - low) * (static_cast<double>(engine_() >> 11U) * kOneOver2To53);
  }

  /// @return an integer in low..high, both included
  int integer(int low, int high) {
    return low + static_cast<int>(engine_() % (static_cast<std::uint64_t>(high - low) + 1));
  }

 private:
  std::mt19937_64 engine_;
  std::uint64_t seed_;
};

/// Random numbers for a property test, seeded from the environment variable GLISSADE_SEED if that is set. The
/// test logs the seed: INFO("GLISSADE_SEED=" << random.seed()).
inline Random seeded_random(std::uint64_t default_seed = 20250217) {
  const char* const text = std::getenv("GLISSADE_SEED");
  const std::uint64_t seed = text == nullptr ? default_seed : std::stoull(text);
  return Random(seed);
}

}  // namespace testing
