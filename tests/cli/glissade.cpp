#include "cli/glissade.hpp"

#include "support/paths.hpp"

std::string glissade_program() {
  return GLISSADE_PROGRAM;
}

Outcome glissade_run(const std::vector<std::string>& arguments, const RunLimits& limits) {
  return run_program(glissade_program(), arguments, limits);
}

std::string shipped(const std::string& name) {
  return designs_path(name + ".yaml");
}
