#pragma once

#include <stop_token>
#include <thread>

namespace glissade::app {

/// While it lives, the first Ctrl-C asks the work to end. The second one, or SIGTERM, ends the program at once, wherever
/// the work is: what was being written is taken away, files that are finished stay.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  [[nodiscard]] std::stop_token token() const { return source_.get_token(); }

 private:
  std::stop_source source_;
  std::thread listener_;
};

}  // namespace glissade::app
