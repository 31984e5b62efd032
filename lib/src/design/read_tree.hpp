#pragma once

#include "glissade/design/design.hpp"

#include "design/findings.hpp"
#include "design/yaml_tree.hpp"

#include <filesystem>

namespace glissade::design_file {

/// Reads the values of a design from its tree; what is wrong with single values goes to the findings.
[[nodiscard]] Design read_tree(const Node& root, const std::filesystem::path& file, Findings& findings);

}  // namespace glissade::design_file
