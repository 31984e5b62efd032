#pragma once

#include <functional>
#include <string_view>

namespace glissade {

/// Told by long work what it does and how far it is; called from the thread that works, at most some ten
/// times a second. `fraction` of the stage done: 0 to 1, negative where it cannot be known.
using Progress = std::function<void(std::string_view stage, double fraction)>;

}  // namespace glissade
