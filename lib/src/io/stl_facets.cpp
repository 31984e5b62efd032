#include "io/stl_facets.hpp"

#include "io/stl_layout.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstring>

namespace glissade::io {
namespace {

constexpr std::size_t kFloatBytes = 4;
constexpr std::size_t kPositionBytes = 3 * kFloatBytes;

/// Puts numbers down, each with its lowest byte first.
template <std::size_t count>
void put_numbers(char* place, const std::array<float, count>& numbers) {
  if constexpr (std::endian::native == std::endian::little) {
    std::memcpy(place, numbers.data(), sizeof numbers);
  } else {
    for (const float number : numbers) {
      auto bits = std::bit_cast<std::uint32_t>(number);
      for (std::size_t i = 0; i < kFloatBytes; ++i) {
        *place++ = static_cast<char>(bits & 0xFFU);
        bits >>= 8U;
      }
    }
  }
}

/// A corner as it is put down: a position in single precision and a zero, four numbers that move at once. The
/// zero makes room for the next corner; that of the last one is the two bytes after it.
class Corner {
 public:
  explicit Corner(Vec3 p) : numbers_{nearest(p)[0], nearest(p)[1], nearest(p)[2], 0.0F} {}

  [[nodiscard]] const std::array<float, 4>& numbers() const { return numbers_; }
  [[nodiscard]] Vec3 position() const { return {numbers_[0], numbers_[1], numbers_[2]}; }

 private:
  std::array<float, 4> numbers_;
};

/// Normals of some facets that are not yet of unit length; one array a coordinate, so that the processor
/// takes square roots and quotients of several at once.
class Normals {
 public:
  static constexpr std::size_t kMost = 64;

  void set(std::size_t facet, Vec3 normal) {
    x_[facet] = normal.x;
    y_[facet] = normal.y;
    z_[facet] = normal.z;
    scale_[facet] = dot(normal, normal);
  }

  void find_lengths() {
    // Too small to change the length of any normal (the smallest, of facets in single precision, is 1e-90),
    // it only keeps those of no length at 0. A comparison would keep the compiler from vectorising.
    constexpr double kTiny = 1e-300;
    for (double& scale : scale_) scale = 1.0 / (std::sqrt(scale) + kTiny);
  }

  [[nodiscard]] std::array<float, 3> unit(std::size_t facet) const {
    // Adding +0 turns -0 into +0.
    return {static_cast<float>(scale_[facet] * x_[facet]) + 0.0F,
            static_cast<float>(scale_[facet] * y_[facet]) + 0.0F,
            static_cast<float>(scale_[facet] * z_[facet]) + 0.0F};
  }

 private:
  std::array<double, kMost> x_{};
  std::array<double, kMost> y_{};
  std::array<double, kMost> z_{};
  std::array<double, kMost> scale_{};
};

}  // namespace

char* put_stl_facets(char* place, const std::array<std::uint32_t, 3>* begin,
                     const std::array<std::uint32_t, 3>* end, const std::vector<Vec3>& vertices,
                     double per_metre) {
  Normals normals;
  while (begin != end) {
    const auto count = std::min<std::size_t>(Normals::kMost, static_cast<std::size_t>(end - begin));
    char* facet = place;
    for (std::size_t i = 0; i < count; ++i, facet += stl::kFacetBytes) {
      const Corner a(per_metre * vertices[begin[i][0]]);
      const Corner b(per_metre * vertices[begin[i][1]]);
      const Corner c(per_metre * vertices[begin[i][2]]);
      normals.set(i, cross(b.position() - a.position(), c.position() - a.position()));
      put_numbers(facet + kPositionBytes, a.numbers());
      put_numbers(facet + 2 * kPositionBytes, b.numbers());
      put_numbers(facet + 3 * kPositionBytes, c.numbers());
    }
    normals.find_lengths();
    for (std::size_t i = 0; i < count; ++i, place += stl::kFacetBytes) put_numbers(place, normals.unit(i));
    begin += count;
  }
  return place;
}

}  // namespace glissade::io
