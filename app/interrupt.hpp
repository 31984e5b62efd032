#pragma once

#include <stop_token>
#include <thread>

namespace glissade::app {

/// While it lives, the first Ctrl-C (or SIGTERM) asks the work to end; the second one ends the program as
/// usual.
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
