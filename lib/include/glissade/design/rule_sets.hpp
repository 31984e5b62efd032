#pragma once

#include "glissade/trades/rules.hpp"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace glissade {

struct Design;

/// @return the sets of lib/data/rules, which the program carries, by name
[[nodiscard]] const std::vector<RuleSet>& shipped_rule_sets();

/// Reads a file of rules as lib/data/rules has them; docs/rules.md describes its keys.
/// @throws FileError if it cannot be read
/// @throws InputError with every problem at once: unknown or missing keys, quantities, units, bounds
[[nodiscard]] RuleSet read_rule_set(const std::filesystem::path& file);

/// The same from text; `file` names it in messages.
[[nodiscard]] RuleSet parse_rule_set(std::string_view text, const std::filesystem::path& file);

/// @return names of the sets that a design is held against where it names none: those that its stream or its kind of
///         centerline brings along
[[nodiscard]] std::vector<std::string> suggested_rule_sets(const Design& design);

}  // namespace glissade
