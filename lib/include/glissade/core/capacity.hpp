#pragma once

#include <cstddef>

namespace glissade {

/// Most triangles of a mesh that Glissade makes: with all that is kept of each while it is proven, some 1.2 GB.
inline constexpr std::size_t kMostTriangles = 20'000'000;

}  // namespace glissade
