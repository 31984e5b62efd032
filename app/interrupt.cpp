#include "app/interrupt.hpp"

#include "glissade/io/unfinished.hpp"

#include "app/console.hpp"
#include "app/exit_code.hpp"

#include <array>
#include <csignal>
#include <cstdlib>
#include <string>

#include <fcntl.h>
#include <unistd.h>

namespace glissade::app {
namespace {

// A signal handler may do next to nothing: it passes a byte to a thread that may do everything.
std::array<int, 2> pipe_ends = {-1, -1};

void send(char message) {
  const auto written = ::write(pipe_ends[1], &message, 1);
  (void)written;
}

extern "C" void on_interrupt(int) {
  send('s');
}

extern "C" void on_termination(int) {
  send('t');
}

void set_handler(int signal, void (*handler)(int)) {
  struct sigaction action = {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;
  sigaction(signal, &action, nullptr);
}

/// Ends the program wherever the work is; nothing half written stays.
[[noreturn]] void end_at_once() {
  discard_unfinished();
  print_error(std::string(error_is_terminal() ? "\r\033[K" : "") +
              "glissade: error: interrupted; what was not finished is gone\n");
  std::_Exit(static_cast<int>(ExitCode::interrupted));
}

}  // namespace

Interrupt::Interrupt() {
  if (::pipe2(pipe_ends.data(), O_CLOEXEC) != 0) return;  // then a signal ends the program as usual
  listener_ = std::thread([this] {
    char message = 0;
    while (::read(pipe_ends[0], &message, 1) == 1 && message != 'e') {
      if (message == 't' || source_.stop_requested()) end_at_once();
      source_.request_stop();
    }
  });
  set_handler(SIGINT, on_interrupt);
  set_handler(SIGTERM, on_termination);
}

Interrupt::~Interrupt() {
  if (!listener_.joinable()) return;
  set_handler(SIGINT, SIG_DFL);
  set_handler(SIGTERM, SIG_DFL);
  send('e');
  listener_.join();
  ::close(pipe_ends[0]);
  ::close(pipe_ends[1]);
}

}  // namespace glissade::app
