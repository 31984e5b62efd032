#pragma once

#include "glissade/design/design.hpp"

#include "design/findings.hpp"
#include "design/yaml_tree.hpp"

#include <vector>

namespace glissade::design_file {

/// Puts the values of the overrides in their places in the tree; keys that are not there are added.
void apply_overrides(Node& root, const std::vector<Override>& overrides, Findings& findings);

}  // namespace glissade::design_file
