#include "glissade/design/schema.hpp"

#include <algorithm>

#include <nlohmann/json.hpp>

namespace glissade {
namespace design_file {
namespace {

using Json = nlohmann::ordered_json;

class KeyList {
 public:
  /// Adds what may stand at a place and below it.
  void collect(const Json& schema, const std::string& path) {
    if (schema.contains("anyOf")) {
      for (const Json& one : schema["anyOf"]) collect(one, path);
    } else if (schema.contains("properties")) {
      for (const auto& [key, value] : schema["properties"].items())
        collect(value, path.empty() ? key : path + "." + key);
    } else {
      const bool list = schema.contains("items");
      DesignKey& key = key_at(path);
      const std::size_t known = key.words.size();
      add_words(list ? schema["items"] : schema, key);
      key.list = key.list || (list && key.words.size() > known);
    }
  }

  [[nodiscard]] std::vector<DesignKey> take() { return std::move(keys_); }

 private:
  DesignKey& key_at(const std::string& path) {
    const auto known =
        std::find_if(keys_.begin(), keys_.end(), [&](const DesignKey& key) { return key.path == path; });
    return known != keys_.end() ? *known : keys_.emplace_back(DesignKey{path, {}, false});
  }

  static void add_words(const Json& schema, DesignKey& key) {
    const Json words =
        schema.contains("const") ? Json::array({schema["const"]}) : schema.value("enum", Json::array());
    for (const Json& word : words) {
      if (!word.is_string()) continue;
      const auto text = word.get<std::string>();
      if (std::find(key.words.begin(), key.words.end(), text) == key.words.end()) key.words.push_back(text);
    }
    if (schema.value("type", Json()) == "boolean") key.words = {"true", "false"};
  }

  std::vector<DesignKey> keys_;
};

}  // namespace
}  // namespace design_file

std::vector<DesignKey> design_keys() {
  design_file::KeyList keys;
  keys.collect(design_file::Json::parse(design_schema()), "");
  return keys.take();
}

}  // namespace glissade
