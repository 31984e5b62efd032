#include "app/interrupt.hpp"

#include <array>
#include <csignal>
#include <cstdlib>

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

extern "C" void on_signal(int) {
  send('s');
}

void set_handler(void (*handler)(int), int flags) {
  struct sigaction action = {};
  action.sa_handler = handler;
  action.sa_flags = flags;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

}  // namespace

Interrupt::Interrupt() {
  if (::pipe2(pipe_ends.data(), O_CLOEXEC) != 0) return;  // then Ctrl-C ends the program at once
  listener_ = std::thread([this] {
    char message = 0;
    while (::read(pipe_ends[0], &message, 1) == 1 && message == 's') source_.request_stop();
  });
  set_handler(on_signal, static_cast<int>(SA_RESETHAND) | SA_RESTART);
}

Interrupt::~Interrupt() {
  if (!listener_.joinable()) return;
  set_handler(SIG_DFL, 0);
  send('e');
  listener_.join();
  ::close(pipe_ends[0]);
  ::close(pipe_ends[1]);
}

}  // namespace glissade::app
