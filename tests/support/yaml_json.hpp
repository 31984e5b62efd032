#pragma once

#include <string>

#include <nlohmann/json.hpp>
#include <yaml-cpp/yaml.h>

namespace yaml_json_detail {

/// A scalar as YAML's core schema types it.
inline nlohmann::json scalar(const YAML::Node& node) {
  const std::string text = node.Scalar();
  if (node.Tag() == "!") return text;  // quoted
  if (text == "true" || text == "false") return text == "true";
  try {
    std::size_t used = 0;
    const double number = std::stod(text, &used);
    if (used == text.size()) {
      return number == static_cast<double>(static_cast<long long>(number))
                 ? nlohmann::json(static_cast<long long>(number))
                 : nlohmann::json(number);
    }
  } catch (const std::exception&) {
    return text;
  }
  return text;
}

inline nlohmann::json of(const YAML::Node& node) {
  if (node.IsScalar()) return scalar(node);
  nlohmann::json value;
  if (node.IsSequence()) {
    value = nlohmann::json::array();
    for (const auto& item : node) value.push_back(of(item));
  } else if (node.IsMap()) {
    value = nlohmann::json::object();
    for (const auto& entry : node) value[entry.first.as<std::string>()] = of(entry.second);
  }
  return value;
}

}  // namespace yaml_json_detail

/// @return a YAML document as the JSON that an editor holds against a schema
/// @throws YAML::Exception if it is none
inline nlohmann::json yaml_as_json(const std::string& text) {
  return yaml_json_detail::of(YAML::Load(text));
}
