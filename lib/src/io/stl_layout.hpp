#pragma once

#include <cstddef>

/// Sizes of binary STL: a header of free text, a count, then facets of twelve floats and two unused bytes.
namespace glissade::stl {

inline constexpr std::size_t kHeaderBytes = 80;
inline constexpr std::size_t kPrefixBytes = kHeaderBytes + 4;
inline constexpr std::size_t kFacetBytes = 12 * 4 + 2;

}  // namespace glissade::stl
