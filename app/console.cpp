#include "app/console.hpp"

#include "glissade/core/error.hpp"

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <system_error>

#include <unistd.h>

namespace glissade::app {

void print(std::string_view text) {
  errno = 0;
  const bool written =
      std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0;
  if (written || errno == EPIPE) return;
  throw FileError({"standard output", "writing failed: " + std::generic_category().message(errno), "",
                   "a disk with space left"});
}

void print_error(std::string_view text) {
  (void)std::fwrite(text.data(), 1, text.size(), stderr);
  (void)std::fflush(stderr);
}

bool output_is_terminal() {
  return isatty(STDOUT_FILENO) == 1;
}

bool error_is_terminal() {
  return isatty(STDERR_FILENO) == 1;
}

std::string emphasised(std::string_view text, Emphasis emphasis) {
  static const bool coloured = [] {
    const char* refusal = std::getenv("NO_COLOR");
    return output_is_terminal() && (refusal == nullptr || *refusal == '\0');
  }();
  if (!coloured) return std::string(text);
  const char* start = "\033[1m";
  if (emphasis == Emphasis::good) start = "\033[32m";
  if (emphasis == Emphasis::bad) start = "\033[31m";
  return start + std::string(text) + "\033[0m";
}

}  // namespace glissade::app
