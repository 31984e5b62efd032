#pragma once

#include "glissade/design/fabrication_design.hpp"

#include "design/map_reader.hpp"

#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace glissade::design_file {

/// Reads the keys of a process of `fabrication`, those that every process has excepted: material, arc_tolerance.
[[nodiscard]] PlateOptions read_plate(MapReader& map, Findings& findings);
[[nodiscard]] PrintOptions read_print(MapReader& map, Findings& findings);
[[nodiscard]] TimberOptions read_timber(MapReader& map, Findings& findings);

/// @param material  what stands where a key is missing
[[nodiscard]] StockMaterial read_material(const Value& value, StockMaterial material, Findings& findings);

/// A level, or points of a line.
[[nodiscard]] std::vector<Vec2> read_ground(const Value& value, Findings& findings);

inline void set_length(MapReader& map, std::string_view key, double& value) {
  value = map.quantity(key, Dimension::length).value_or(value);
}

/// A count: a whole number without a unit.
[[nodiscard]] std::optional<int> read_count(MapReader& map, std::string_view key, Findings& findings);

/// A group that stands for its defaults where it is `true`, and for nothing where it is `none`.
template <typename Options, typename Read>
std::optional<Options> optional_group(MapReader& map, std::string_view key, Findings& findings, Read read) {
  const auto value = map.find(key);
  if (!value || (value->node->kind != Node::Kind::map && is_word(*value, "none", findings)))
    return std::nullopt;
  return read(*value);
}

/// @return the meaning of a key's word; `otherwise` where the key is missing or no such word
template <typename Meaning>
Meaning chosen(MapReader& map, std::string_view key, Meaning otherwise,
               const std::vector<std::pair<std::string_view, Meaning>>& words) {
  const auto value = map.find(key);
  return value ? map.choice(*value, words).value_or(otherwise) : otherwise;
}

}  // namespace glissade::design_file
