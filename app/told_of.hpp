#pragma once

#include "glissade/core/error.hpp"

#include <string>
#include <utility>
#include <vector>

namespace glissade::app {

/// @return `issues`, those that name no place with `file`
inline std::vector<Issue> placed_in(std::vector<Issue> issues, const std::string& file) {
  for (Issue& issue : issues) {
    if (issue.where.empty()) issue.where = file;
  }
  return issues;
}

/// Work on what was read from a file: what of it the work cannot do is told with the file where it names no place.
/// @return what `work` returns
/// @throws what `work` throws
template <typename Work>
auto told_of(const std::string& file, const Work& work) {
  try {
    return work();
  } catch (const InputError& error) {
    throw InputError(placed_in(error.issues(), file));
  } catch (const InfeasibleError& error) {
    throw InfeasibleError(placed_in(error.issues(), file));
  } catch (const ConvergenceError& error) {
    throw ConvergenceError(placed_in(error.issues(), file));
  }
}

}  // namespace glissade::app
