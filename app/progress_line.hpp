#pragma once

#include "glissade/core/progress.hpp"

#include "app/verbosity.hpp"

#include <chrono>
#include <string>
#include <string_view>

namespace glissade::app {

/// One line on a terminal that tells what long work does and how long it still takes; nothing in the first
/// second, nothing where standard error is no terminal. Verbose: a line for each step, wherever it goes.
class ProgressLine {
 public:
  explicit ProgressLine(const Verbosity& verbosity);
  /// Wipes the line.
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// @return what the library calls; valid as long as this lives
  [[nodiscard]] Progress callback();

 private:
  using Clock = std::chrono::steady_clock;

  void show(std::string_view stage, double fraction);
  void tell(std::string_view stage);

  bool enabled_;
  bool verbose_;
  bool shown_ = false;
  Clock::time_point start_ = Clock::now();
  Clock::time_point stage_start_ = start_;
  std::string stage_;
};

}  // namespace glissade::app
