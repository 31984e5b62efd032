#include "support/running_program.hpp"

#include "support/temp_dir.hpp"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace {

/// Far beyond what anything waited for takes, also on a machine that does much else.
constexpr std::chrono::seconds kPatience{90};

void redirect(const char* file, int flags, int descriptor) {
  const int opened = ::open(file, flags, 0600);
  if (opened < 0 || ::dup2(opened, descriptor) < 0) ::_exit(126);
}

/// @return what a file holds; nothing before there is one
std::string written(const std::filesystem::path& file) {
  return std::filesystem::exists(file) ? bytes_of(file) : "";
}

}  // namespace

RunningProgram::RunningProgram(const std::string& program, const std::vector<std::string>& arguments,
                               const std::filesystem::path& directory)
    : directory_(directory) {
  std::vector<std::string> words = {program};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  // What an earlier program wrote there is not this one's.
  std::filesystem::remove(directory_ / "output");
  std::filesystem::remove(directory_ / "errors");
  child_ = ::fork();
  if (child_ < 0) throw std::runtime_error("fork failed");
  if (child_ > 0) return;
  // Until the program is there, the test's own handlers would answer a signal.
  for (const int signal : {SIGINT, SIGTERM}) ::signal(signal, SIG_DFL);
  if (::chdir(directory_.c_str()) != 0) ::_exit(126);
  redirect("/dev/null", O_RDONLY, STDIN_FILENO);
  redirect("output", O_WRONLY | O_CREAT | O_APPEND, STDOUT_FILENO);
  redirect("errors", O_WRONLY | O_CREAT | O_APPEND, STDERR_FILENO);
  ::execvp(pointers.front(), pointers.data());
  ::_exit(127);
}

RunningProgram::~RunningProgram() {
  if (child_ > 0) static_cast<void>(end_by(SIGKILL));
}

std::string RunningProgram::output() const {
  return written(directory_ / "output");
}

std::string RunningProgram::errors() const {
  return written(directory_ / "errors");
}

std::string RunningProgram::output_of_lines(std::size_t count) const {
  const auto end = std::chrono::steady_clock::now() + kPatience;
  std::string text;
  do {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    text = output();
  } while (static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')) < count &&
           std::chrono::steady_clock::now() < end);
  return text;
}

double RunningProgram::processor_time() const {
  // Fields 14 and 15 of /proc/PID/stat, after the name in parentheses, which may hold anything.
  std::string text = bytes_of("/proc/" + std::to_string(child_) + "/stat");
  std::istringstream fields(text.substr(text.rfind(')') + 2));
  std::string skipped;
  for (int i = 3; i < 14; ++i) fields >> skipped;
  double user = 0.0;
  double system = 0.0;
  fields >> user >> system;
  return (user + system) / static_cast<double>(::sysconf(_SC_CLK_TCK));
}

void RunningProgram::send(int signal) const {
  ::kill(child_, signal);
}

int RunningProgram::end_by(int signal) {
  send(signal);
  int status = 0;
  while (::waitpid(child_, &status, 0) < 0 && errno == EINTR) {
  }
  child_ = -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}
