#pragma once

#include "glissade/core/progress.hpp"

#include "app/verbosity.hpp"

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>

namespace glissade::app {

/// One line on a terminal that tells what long work does, how far it is and how long it still takes; nothing in
/// the first second, nothing where standard error is no terminal, or the variable CI is set. Drawn anew as time passes, also while a step
/// tells nothing. Verbose: a line for each step instead, wherever it goes.
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

  void note(std::string_view stage, std::optional<double> fraction);
  void tell(std::string_view stage);
  void keep_drawing(const std::stop_token& stop);
  void draw(Clock::time_point now);
  [[nodiscard]] std::string distance_text(Clock::time_point now) const;

  bool enabled_;
  bool verbose_;
  bool shown_ = false;
  Clock::time_point start_ = Clock::now();
  std::string stage_;
  std::optional<double> fraction_;  ///< done when last told; none where unknown
  Clock::time_point told_ = start_;
  Clock::time_point work_start_ = start_;  ///< when the work began that the fraction is of

  std::mutex mutex_;  ///< of everything above
  std::condition_variable_any ended_;
  std::jthread drawer_;
};

}  // namespace glissade::app
