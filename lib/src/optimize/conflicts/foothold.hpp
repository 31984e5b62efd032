#pragma once

#include "glissade/task/limit_catalogue.hpp"

#include "optimize/discretise/transcription.hpp"

#include <cstddef>
#include <functional>
#include <vector>

namespace glissade::optimizer {

/// A track that keeps all limits, to start from.
struct Foothold {
  std::size_t passages = 0;  ///< which of the passages it belongs to
  Mesh mesh;
  Vector z;
};

/// With which curve, of all that bends are looked for from, a search began.
struct Beginning {
  std::size_t passages = 0;
  std::size_t curve = 0;
  LimitName limit;  ///< that asks for bends, and gives way alone
};

/// Searches on from tracks that keep all limits at the stations of their meshes; of several the best one counts.
/// @return whether to look no further: a track was found that keeps them everywhere, or the search was asked to end
using Leads = std::function<bool(const std::vector<Foothold>&)>;

}  // namespace glissade::optimizer
