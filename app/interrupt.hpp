#pragma once

#include "glissade/pipeline/solve.hpp"

#include <atomic>
#include <stop_token>
#include <thread>
#include <utility>

namespace glissade::app {

/// While it lives, the first Ctrl-C asks the work to end; work that has not done so soon (interrupt.cpp) is ended. The second
/// one, or SIGTERM, ends the program at once, wherever the work is. What was being written is taken away, files that are
/// finished stay.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  [[nodiscard]] std::stop_token token() const { return source_.get_token(); }
  /// @return how work is asked to end; what goes on with the best track so far is not ended
  [[nodiscard]] RunContext context(Progress progress, double time_budget = RunContext{}.time_budget) const {
    return {std::move(progress), token(), time_budget, &goes_on_};
  }

 private:
  /// Waits for a signal; ends work that takes too long over the request to stop.
  void listen();

  std::stop_source source_;
  mutable std::atomic<bool> goes_on_ = false;
  std::thread listener_;
};

}  // namespace glissade::app
