#pragma once

#include <array>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <vector>

#include <sys/wait.h>

/// What a program did: both its outputs, mixed as they came, and its exit code (128 + n after signal n).
struct ProgramResult {
  std::string output;
  int exit_code = 0;
};

/// Runs a program found in PATH; arguments reach it as they are.
inline ProgramResult run_program(const std::vector<std::string>& arguments) {
  std::string command;
  for (const std::string& argument : arguments) {
    command += '\'';
    for (const char c : argument) c == '\'' ? command += "'\\''" : command += c;
    command += "' ";
  }
  std::FILE* pipe = ::popen((command + "2>&1").c_str(), "r");
  if (pipe == nullptr) throw std::runtime_error("cannot start " + command);
  ProgramResult result;
  std::array<char, 4096> block{};
  while (const std::size_t got = std::fread(block.data(), 1, block.size(), pipe)) {
    result.output.append(block.data(), got);
  }
  const int status = ::pclose(pipe);
  result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return result;
}
