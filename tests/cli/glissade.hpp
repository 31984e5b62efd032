#pragma once

#include "support/program.hpp"

#include <string>
#include <vector>

/// @return path of the program that users run
std::string glissade_program();

/// Runs the program that users run.
Outcome glissade_run(const std::vector<std::string>& arguments, const RunLimits& limits = {});

/// @return path of a design that is shipped
std::string shipped(const std::string& name);
