#pragma once

#include "glissade/pipeline/solve.hpp"

#include "app/exit_code.hpp"
#include "app/track_input.hpp"

#include <filesystem>
#include <functional>
#include <string>

namespace glissade::app {

/// What is made anew when a design changes.
struct Watched {
  std::filesystem::path design;
  const Overrides& overrides;
  /// Makes it. @return one line about what was made; throws as a command does
  std::function<std::string(const RunContext&)> make;
  bool quiet = false;
};

/// Makes it now, and again whenever the design or a file that it names changes, until Ctrl-C: a line each time,
/// with the time of day. An error is told and waits for the next change.
/// @return interrupted
[[nodiscard]] ExitCode watch(const Watched& watched);

}  // namespace glissade::app
