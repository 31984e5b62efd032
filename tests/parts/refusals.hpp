#pragma once

#include "glissade/core/error.hpp"

#include <string>

namespace testing {

/// @return everything that making something is refused for, an issue a line; empty: it was made
template <typename Make>
std::string refusal_of(const Make& make) {
  try {
    (void)make();
  } catch (const glissade::InputError& error) {
    std::string text;
    for (const glissade::Issue& issue : error.issues())
      text += issue.where + "|" + issue.what + "|" + issue.why + "|" + issue.hint + "\n";
    return text;
  }
  return "";
}

}  // namespace testing
