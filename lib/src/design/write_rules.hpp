#pragma once

#include "glissade/design/rules_design.hpp"

#include "design/written_text.hpp"

namespace glissade::design_file {

/// @return whether a design says anything of its rules
[[nodiscard]] bool are_given(const RulesDesign& rules);
/// @return the keys of a group of rules
[[nodiscard]] Group written_rules(const RulesDesign& rules);

}  // namespace glissade::design_file
