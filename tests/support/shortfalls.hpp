#pragma once

#include "glissade/parts/shop_part.hpp"

#include <string>
#include <vector>

namespace testing {

/// @return what of a workshop is not as asked for, as "where|what|why|hint": all of it whose `what` begins so
inline std::vector<std::string> shortfalls_of(const glissade::Workshop& workshop,
                                              const std::string& begin = "") {
  std::vector<std::string> found;
  for (const glissade::Issue& issue : workshop.shortfalls) {
    if (issue.what.starts_with(begin))
      found.push_back(issue.where + "|" + issue.what + "|" + issue.why + "|" + issue.hint);
  }
  return found;
}

/// @return the first of them; empty where there is none
inline std::string shortfall_of(const glissade::Workshop& workshop, const std::string& begin = "") {
  const std::vector<std::string> all = shortfalls_of(workshop, begin);
  return all.empty() ? std::string() : all.front();
}

}  // namespace testing
