#pragma once

#include <functional>
#include <optional>
#include <string_view>

namespace glissade {

/// Told by long work what it does and how far it is; called from the thread that works, at most some ten
/// times a second. `fraction` of the work done: 0 to 1, none where it cannot be known. It rises from stage
/// to stage of one work; a lower one than before begins another work.
using Progress = std::function<void(std::string_view stage, std::optional<double> fraction)>;

}  // namespace glissade
