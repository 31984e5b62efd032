#pragma once

#include "glissade/trades/rules.hpp"

#include <optional>
#include <string>
#include <vector>

namespace glissade {

/// Which rules a design is held against.
struct RulesDesign {
  /// Names of shipped sets, and files of one's own (they end in .yaml or .yml; relative paths are taken from the
  /// design file's directory); none: those that the kind of centerline suggests.
  std::optional<std::vector<std::string>> sets;
  std::vector<Rule> own;              ///< beside the sets; one with the id of another replaces it
  std::vector<std::string> left_out;  ///< ids
  std::vector<Rule> in_force;         ///< what follows from these

  friend bool operator==(const RulesDesign&, const RulesDesign&) = default;
};

}  // namespace glissade
