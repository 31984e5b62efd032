#pragma once

namespace glissade::core {

/// @return processor time that the calling thread has taken [s]; where the system does not count it, time on a clock that
///         never goes back
[[nodiscard]] double processor_seconds();

}  // namespace glissade::core
