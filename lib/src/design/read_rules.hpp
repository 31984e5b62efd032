#pragma once

#include "glissade/design/design.hpp"

#include "design/map_reader.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace glissade::design_file {

/// @return whether a set of rules is a file of one's own, by its name
[[nodiscard]] bool is_rule_file(std::string_view name);

/// @return the rules of shipped sets, by their names
[[nodiscard]] RulesDesign suggested_rules(const std::vector<std::string>& suggested);

/// Reads a group of rules: sets, own, leave_out.
/// @param suggested  the sets that hold where none are named
/// @param subject    what its rules may speak of
/// @param folder     that relative paths of files are taken from
[[nodiscard]] RulesDesign read_rule_group(const Value& value,
                                          const std::optional<std::vector<std::string>>& suggested,
                                          RuleSubject subject, const std::filesystem::path& folder,
                                          Findings& findings);

/// Reads the group `rules` of a design, and with it what it names; the design's centerline is known by then.
void read_rules(MapReader& top, Design& design, Findings& findings);

}  // namespace glissade::design_file
