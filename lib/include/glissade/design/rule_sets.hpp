#pragma once

#include "glissade/trades/rules.hpp"

#include <filesystem>
#include <string_view>
#include <vector>

namespace glissade {

/// @return the sets of lib/data/rules, which the program carries, by name
[[nodiscard]] const std::vector<RuleSet>& shipped_rule_sets();

/// Reads a file of rules as lib/data/rules has them; docs/rules.md describes its keys.
/// @throws FileError if it cannot be read
/// @throws InputError with every problem at once: unknown or missing keys, quantities, units, bounds
[[nodiscard]] RuleSet read_rule_set(const std::filesystem::path& file);

/// The same from text; `file` names it in messages.
[[nodiscard]] RuleSet parse_rule_set(std::string_view text, const std::filesystem::path& file);

}  // namespace glissade
