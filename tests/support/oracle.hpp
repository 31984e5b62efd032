#pragma once

#include "support/program.hpp"

#include <initializer_list>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

/// Programs that a machine may lack: `./test` installs the light ones, `./test --with-oracles` all.

/// @return whether a program starts; where it does not, says on standard error that the test is skipped
inline bool oracle_is_there(const std::string& program, const std::vector<std::string>& arguments) {
  if (run_program(program, arguments).exit_code == 0) return true;
  std::cerr << "skipped: " << program << " is not installed (./test --with-oracles installs it)\n";
  return false;
}

/// @return a Python that has a module of Debian's; none, said on standard error, where there is none
inline std::optional<std::string> python_with(const std::string& module) {
  for (const char* python : {"/usr/bin/python3", "python3"}) {
    if (run_program(python, {"-c", "import " + module}).exit_code == 0) return python;
  }
  std::cerr << "skipped: no Python with the module " << module << " (./test installs it)\n";
  return std::nullopt;
}
