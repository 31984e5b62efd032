#include "app/interrupt.hpp"

#include "glissade/io/unfinished.hpp"

#include "app/console.hpp"
#include "app/exit_code.hpp"

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <ctime>
#include <string>

#include <fcntl.h>
#include <poll.h>
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

/// @return what this process has spent on processors [s]
double processor_time() {
  timespec time{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// When the work was asked to end, by both clocks.
struct Asked {
  double processor = 0.0;  ///< [s]
  std::chrono::steady_clock::time_point at;
};

/// @return whether the work has had its time to end in good order. What is ended leaves as little behind: only its last words are
///         others. So the clock counts, too, on a machine that does much else, and for what does not compute at all (nobody
///         takes its output, a disk is gone).
bool out_of_patience(const Asked& asked) {
  constexpr double kOfProcessor = 0.12;                  // budget [s]: of the 0.2 s that docs/cli.md promises
  constexpr std::chrono::milliseconds kByTheClock{150};  // budget: the same, with what ending takes left over
  return processor_time() - asked.processor > kOfProcessor ||
         std::chrono::steady_clock::now() - asked.at > kByTheClock;
}

/// Ends the program wherever the work is; nothing half written stays.
[[noreturn]] void end_at_once() {
  discard_unfinished();
  if (error_is_terminal()) print_over_line("");
  print_error("glissade: error: interrupted; what was not finished is gone\n");
  std::_Exit(static_cast<int>(ExitCode::interrupted));
}

}  // namespace

Interrupt::Interrupt() {
  if (::pipe2(pipe_ends.data(), O_CLOEXEC) != 0) return;  // then a signal ends the program as usual
  listener_ = std::thread([this] { listen(); });
  set_handler(SIGINT, on_interrupt);
  set_handler(SIGTERM, on_termination);
}

void Interrupt::listen() {
  constexpr int kLook = 10;  // [ms]
  Asked asked;
  while (true) {
    pollfd incoming{pipe_ends[0], POLLIN, 0};
    const int ready = ::poll(&incoming, 1, source_.stop_requested() && !goes_on_ ? kLook : -1);
    if (ready < 0 && errno == EINTR) continue;
    if (ready == 0) {
      if (!goes_on_ && out_of_patience(asked)) end_at_once();
      continue;
    }
    char message = 0;
    if (::read(pipe_ends[0], &message, 1) != 1 || message == 'e') return;
    if (message == 't' || source_.stop_requested()) end_at_once();
    asked = {processor_time(), std::chrono::steady_clock::now()};
    source_.request_stop();
  }
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
