#pragma once

#include "glissade/optimize/optimize.hpp"

#include <string>

namespace CLI {
class App;
}

namespace glissade::app {

/// --time-budget TIME: how long a search within limits may take.
class TimeBudget {
 public:
  void add_to(CLI::App& command);
  /// @return [s]; > 0
  /// @throws InputError if what was given is no positive time
  [[nodiscard]] double seconds() const;

 private:
  std::string text_;
};

}  // namespace glissade::app
