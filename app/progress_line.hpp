#pragma once

#include "glissade/core/progress.hpp"

#include <chrono>
#include <string>

namespace glissade::app {

/// One line on a terminal that tells what long work does and how long it still takes; nothing in the first
/// second, nothing where standard error is no terminal.
class ProgressLine {
 public:
  explicit ProgressLine(bool quiet);
  /// Wipes the line.
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// @return what the library calls; valid as long as this lives
  [[nodiscard]] Progress callback();

 private:
  using Clock = std::chrono::steady_clock;

  void show(std::string_view stage, double fraction);

  bool enabled_;
  bool shown_ = false;
  Clock::time_point start_ = Clock::now();
  Clock::time_point stage_start_ = start_;
  std::string stage_;
};

}  // namespace glissade::app
