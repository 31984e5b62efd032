#pragma once

#include "glissade/core/error.hpp"

#include <string>
#include <utility>
#include <vector>

namespace glissade::pipeline {

/// @return the issues of an error; those that do not say where they arose get `where`
inline std::vector<Issue> located(const Error& error, const std::string& where) {
  std::vector<Issue> issues = error.issues();
  for (Issue& issue : issues) {
    if (issue.where.empty()) issue.where = where;
  }
  return issues;
}

/// Calls `make`; what it throws gets a place in the design.
template <typename Make>
auto at_place(const std::string& where, Make&& make) {
  try {
    return std::forward<Make>(make)();
  } catch (const InputError& error) {
    throw InputError(located(error, where));
  } catch (const InfeasibleError& error) {
    throw InfeasibleError(located(error, where));
  } catch (const ConvergenceError& error) {
    throw ConvergenceError(located(error, where));
  }
}

}  // namespace glissade::pipeline
