#pragma once

#include "support/program.hpp"

#include <string>
#include <vector>

/// Runs the program that users run.
inline Outcome glissade_run(const std::vector<std::string>& arguments, const RunLimits& limits = {}) {
  return run_program(GLISSADE_PROGRAM, arguments, limits);
}

/// @return path of a design that is shipped
inline std::string shipped(const std::string& name) {
  return std::string(GLISSADE_DESIGNS) + "/" + name + ".yaml";
}
