#pragma once

#include <regex>
#include <string>

#include <nlohmann/json.hpp>

/// As much of JSON Schema draft-07 as glissade::design_schema() uses; another word in a schema is a fault.
/// @return where and why the value breaks the schema; empty if it does not
inline std::string json_schema_fault(const nlohmann::json& schema, const nlohmann::json& value,
                                     const std::string& place = "");

namespace json_schema_detail {

inline bool is_type(const nlohmann::json& value, const std::string& type) {
  if (type == "object") return value.is_object();
  if (type == "array") return value.is_array();
  if (type == "string") return value.is_string();
  if (type == "number") return value.is_number();
  return type == "boolean" && value.is_boolean();
}

inline std::string object_fault(const nlohmann::json& schema, const nlohmann::json& value,
                                const std::string& place) {
  for (const auto& key : schema.value("required", nlohmann::json::array())) {
    if (!value.contains(key.get<std::string>())) return place + ": lacks " + key.get<std::string>();
  }
  for (const auto& [key, entry] : value.items()) {
    if (!schema.contains("properties") || !schema["properties"].contains(key)) {
      if (schema.value("additionalProperties", true)) continue;
      return place + ": unknown " + key;
    }
    const std::string fault = json_schema_fault(schema["properties"][key], entry, place + "." + key);
    if (!fault.empty()) return fault;
  }
  return "";
}

inline std::string word_fault(const std::string& word, const nlohmann::json& wanted,
                              const nlohmann::json& value, const std::string& place) {
  if (word == "type") {
    for (const auto& type : wanted.is_array() ? wanted : nlohmann::json::array({wanted})) {
      if (is_type(value, type)) return "";
    }
    return place + ": is not of type " + wanted.dump();
  }
  if (word == "const") return value == wanted ? "" : place + ": is not " + wanted.dump();
  if (word == "enum") {
    for (const auto& one : wanted) {
      if (value == one) return "";
    }
    return place + ": is none of " + wanted.dump();
  }
  if (word == "pattern") {
    if (!value.is_string()) return "";
    const bool fits = std::regex_search(value.get<std::string>(), std::regex(wanted.get<std::string>()));
    return fits ? "" : place + ": " + value.dump() + " does not fit";
  }
  if (word == "minItems" || word == "maxItems") {
    const bool few = word == "minItems" && value.is_array() && value.size() < wanted.get<std::size_t>();
    const bool many = word == "maxItems" && value.is_array() && value.size() > wanted.get<std::size_t>();
    return few || many ? place + ": has " + std::to_string(value.size()) + " items" : "";
  }
  if (word == "items") {
    if (!value.is_array()) return "";
    for (std::size_t i = 0; i < value.size(); ++i) {
      const std::string fault = json_schema_fault(wanted, value[i], place + "[" + std::to_string(i) + "]");
      if (!fault.empty()) return fault;
    }
    return "";
  }
  if (word == "anyOf") {
    std::string faults;
    for (const auto& one : wanted) {
      const std::string fault = json_schema_fault(one, value, place);
      if (fault.empty()) return "";
      faults += (faults.empty() ? "" : "; ") + fault;
    }
    return faults;
  }
  return "the schema uses " + word;
}

}  // namespace json_schema_detail

std::string json_schema_fault(const nlohmann::json& schema, const nlohmann::json& value,
                              const std::string& place) {
  for (const auto& [word, wanted] : schema.items()) {
    if (word == "$schema" || word == "title" || word == "description") continue;
    if (word == "properties" || word == "required" || word == "additionalProperties") continue;
    const std::string fault = json_schema_detail::word_fault(word, wanted, value, place);
    if (!fault.empty()) return fault;
  }
  return value.is_object() ? json_schema_detail::object_fault(schema, value, place) : "";
}
