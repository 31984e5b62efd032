#include "app/console.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/odd_characters.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

namespace glissade::app {
namespace {

Issue unwritable_output(int error) {
  Issue issue{"standard output", "writing failed: " + std::generic_category().message(error), "", ""};
  if (error == EBADF)
    issue = {"standard output", "it is closed", "The result has nowhere to go.", "> FILE, or | COMMAND"};
  if (error == ENOSPC || error == EDQUOT) issue.hint = "a disk with space left";
  if (error == EFBIG) issue.hint = "a higher limit on the size of files (ulimit -f)";
  return issue;
}

constexpr std::string_view kBold = "\033[1m";
constexpr std::string_view kRed = "\033[31m";
constexpr std::string_view kGreen = "\033[32m";
constexpr std::string_view kPlain = "\033[0m";
constexpr std::array kEmphases = {kBold, kRed, kGreen, kPlain};

/// What a file, a path or an option brings along is shown, not obeyed; emphasis stays.
std::string harmless(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const auto own = std::find_if(kEmphases.begin(), kEmphases.end(),
                                  [&](std::string_view code) { return text.starts_with(code); });
    if (own != kEmphases.end()) {
      result += *own;
      text.remove_prefix(own->size());
      continue;
    }
    const std::size_t next = std::min(text.find('\033', 1), text.size());
    result += with_controls_shown(text.substr(0, next));
    text.remove_prefix(next);
  }
  return result;
}

}  // namespace

void print(std::string_view result, std::string_view kept) {
  // A file or a pipe gets every byte as it is.
  const std::string text = output_is_terminal() ? harmless(result) : std::string(result);
  errno = 0;
  const bool written =
      std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0;
  if (written || errno == EPIPE) return;
  Issue issue = unwritable_output(errno);
  if (!kept.empty()) issue.why = std::string(kept) + " Only what was to be printed is lost.";
  throw FileError(std::move(issue));
}

void reserve_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(stream, F_GETFD) != -1 || errno != EBADF) continue;
    // The lowest free number is taken: it is this one, as those below are open. Nothing can be written there.
    (void)open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
  }
}

namespace {

void write_error(const std::string& text) {
  (void)std::fwrite(text.data(), 1, text.size(), stderr);
  (void)std::fflush(stderr);
}

}  // namespace

void print_error(std::string_view text) {
  write_error(with_controls_shown(text));
}

void print_over_line(std::string_view text) {
  write_error("\r\033[K" + with_controls_shown(text));
}

void print_problem(const Error& error) {
  std::string text;
  for (const Issue& issue : error.issues()) text += "glissade: error: " + to_text(issue) + "\n";
  print_error(text);
}

void print_before_error(std::string_view text, std::string_view kept) {
  try {
    print(text, kept);
  } catch (const FileError& lost) {
    print_problem(lost);
  }
}

void print_warnings(const std::vector<Issue>& warnings) {
  for (const Issue& warning : warnings) print_error("glissade: warning: " + to_text(warning) + "\n");
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
  std::string_view start = kBold;
  if (emphasis == Emphasis::good) start = kGreen;
  if (emphasis == Emphasis::bad) start = kRed;
  return std::string(start).append(text).append(kPlain);
}

}  // namespace glissade::app
