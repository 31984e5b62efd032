#pragma once

#include <cstddef>
#include <cstdint>

/// Binary STL: a header of free text, a count, then facets of twelve floats and two unused bytes; numbers
/// with their lowest byte first.
namespace glissade::io::stl {

inline constexpr std::size_t kHeaderBytes = 80;
inline constexpr std::size_t kPrefixBytes = kHeaderBytes + 4;
inline constexpr std::size_t kFacetBytes = 12 * 4 + 2;

/// @return bytes of a file with this many facets
[[nodiscard]] constexpr std::uint64_t file_bytes(std::uint32_t facets) {
  return kPrefixBytes + std::uint64_t{facets} * kFacetBytes;
}

[[nodiscard]] inline std::uint32_t little_endian(const char* bytes) {
  std::uint32_t value = 0;
  for (std::size_t i = 4; i-- > 0;) value = (value << 8U) | static_cast<unsigned char>(bytes[i]);
  return value;
}

}  // namespace glissade::io::stl
