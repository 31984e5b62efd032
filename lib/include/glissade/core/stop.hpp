#pragma once

#include "glissade/core/error.hpp"

#include <stop_token>

namespace glissade {

/// Ends work that was asked to end. Long work asks this at least every few milliseconds.
/// @throws Interrupted if the token's source was asked to stop; never for a token without a source
inline void require_going(const std::stop_token& stop) {
  if (stop.stop_requested()) throw Interrupted({"", "interrupted, nothing was written", "", ""});
}

}  // namespace glissade
