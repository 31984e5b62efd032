#include "support/program.hpp"

#include "support/temp_dir.hpp"

#include <cerrno>
#include <stdexcept>
#include <system_error>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace {

void redirect(const std::filesystem::path& file, int flags, int descriptor) {
  const int opened = ::open(file.c_str(), flags, 0600);
  if (opened < 0 || ::dup2(opened, descriptor) < 0) ::_exit(126);
}

[[noreturn]] void become(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                         const RunLimits& limits, const TempDir& scratch) {
  constexpr int kWrite = O_WRONLY | O_CREAT | O_TRUNC;
  redirect("/dev/null", O_RDONLY, STDIN_FILENO);
  redirect(limits.output_to.empty() ? scratch / "output" : limits.output_to, kWrite, STDOUT_FILENO);
  redirect(scratch / "errors", kWrite, STDERR_FILENO);
  if (!limits.directory.empty() && ::chdir(limits.directory.c_str()) != 0) ::_exit(126);
  if (limits.largest_file) {
    const rlimit limit{*limits.largest_file, *limits.largest_file};
    if (::setrlimit(RLIMIT_FSIZE, &limit) != 0) ::_exit(126);
  }
  if (limits.closes_output) ::close(STDOUT_FILENO);
  if (limits.closes_errors) ::close(STDERR_FILENO);
  std::vector<char*> words;
  std::string name = program.string();
  std::vector<std::string> copies = arguments;
  words.push_back(name.data());
  for (std::string& copy : copies) words.push_back(copy.data());
  words.push_back(nullptr);
  ::execvp(name.c_str(), words.data());
  ::_exit(127);
}

}  // namespace

Outcome run_program(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                    const RunLimits& limits) {
  const TempDir scratch;
  const pid_t child = ::fork();
  if (child < 0) throw std::system_error(errno, std::generic_category(), "fork");
  if (child == 0) become(program, arguments, limits, scratch);

  int status = 0;
  while (::waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) throw std::system_error(errno, std::generic_category(), "waitpid");
  }
  Outcome outcome;
  outcome.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  if (limits.output_to.empty()) outcome.output = bytes_of(scratch / "output");
  outcome.errors = bytes_of(scratch / "errors");
  return outcome;
}
