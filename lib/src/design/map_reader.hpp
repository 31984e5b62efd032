#pragma once

#include "glissade/core/quantity.hpp"
#include "glissade/core/vec.hpp"

#include "design/findings.hpp"
#include "design/yaml_tree.hpp"

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace glissade::design_file {

/// One value of a design file with its name and key path: what the typed readers below work on.
struct Value {
  const Node* node = nullptr;
  std::string key;
  std::string key_path;
  std::string example{};  ///< what could stand there: "mass_flow: 650 t/h"; empty where nothing is known
};

/// Each reads a value, or adds a finding and returns none.
[[nodiscard]] std::optional<double> as_quantity(const Value& value, Dimension dimension, Findings& findings);
/// @return true if the value is that word; nothing is found wrong with another
[[nodiscard]] bool is_word(const Value& value, std::string_view word, Findings& findings);
[[nodiscard]] std::optional<std::string> as_text(const Value& value, Findings& findings);
[[nodiscard]] std::optional<bool> as_flag(const Value& value, Findings& findings);
/// A pair of lengths: [5.4 m, 1.1 m].
/// @param example  one that would do in its place
[[nodiscard]] std::optional<Vec2> as_point(const Value& value, Findings& findings,
                                           std::string_view example = "[-200 mm, 250 mm]");
/// A list of such pairs.
[[nodiscard]] std::vector<Vec2> as_points(const Value& value, std::string_view example, Findings& findings,
                                          const ItemCounts& counts = {});
/// @param example  what such a list looks like, for the hint
/// @param counts   how many items it may have, for the schema: whoever asks holds the list to it
[[nodiscard]] std::vector<Value> as_list(const Value& value, std::string_view example, Findings& findings,
                                         const ItemCounts& counts = {});

/// Reads the entries of one map: every key that is asked for is known, any other is a problem.
class MapReader {
 public:
  /// @param noun     what the map describes, with its article, for messages: "a u-channel"
  /// @param example  what such a map looks like, for the hint
  MapReader(const Value& value, std::string_view noun, std::string_view example, Findings& findings);

  /// Says so in later messages, once a kind is known.
  void rename(std::string_view noun) { noun_ = noun; }

  /// Names the keys in the order in which messages list them; otherwise it is the order of asking.
  void expect(std::initializer_list<std::string_view> keys);
  void expect(const std::vector<std::string_view>& keys);

  /// @return false if the value is no map; every reading then returns none, without a problem of its own
  [[nodiscard]] bool readable() const { return node_ != nullptr; }
  [[nodiscard]] bool has(std::string_view key) const;
  /// @return whether a key that nobody asked for is meant for this one, which is known: that alone is then the problem
  [[nodiscard]] bool has_misspelt(std::string_view key) const;
  [[nodiscard]] std::string path_of(std::string_view key) const;

  [[nodiscard]] std::optional<Value> find(std::string_view key);
  /// @param example  what the value could be, for the hint of a missing key
  [[nodiscard]] std::optional<Value> need(std::string_view key, std::string_view example);

  [[nodiscard]] std::optional<double> quantity(std::string_view key, Dimension dimension);
  [[nodiscard]] std::optional<double> needed_quantity(std::string_view key, Dimension dimension,
                                                      std::string_view example);

  /// @param words  the words that the value may be, with what each means
  template <typename Meaning>
  [[nodiscard]] std::optional<Meaning> choice(
      const Value& value, const std::vector<std::pair<std::string_view, Meaning>>& words) {
    const std::optional<std::size_t> index = choose(value, first_of(words));
    if (!index) return {};
    return words[*index].second;
  }

  /// A key that belongs elsewhere: known to the schema, but not here.
  void add_stranger(std::string_view key, std::string_view belongs_to) {
    strangers_.emplace_back(key, belongs_to);
  }

  /// Reports every key that was not asked for; the last call on a reader.
  void refuse_unknown_keys();

 private:
  template <typename Meaning>
  static std::vector<std::string_view> first_of(
      const std::vector<std::pair<std::string_view, Meaning>>& words) {
    std::vector<std::string_view> texts;
    texts.reserve(words.size());
    for (const auto& word : words) texts.push_back(word.first);
    return texts;
  }

  [[nodiscard]] std::optional<std::size_t> choose(const Value& value,
                                                  const std::vector<std::string_view>& words);
  void refuse_duplicates();
  [[nodiscard]] Issue unknown_key(const std::string& key) const;
  /// @return the known key that is not there and that an unknown one is meant for; empty if there is none
  [[nodiscard]] std::string_view meant_by(const std::string& key) const;

  const Node* node_ = nullptr;
  std::string key_path_;
  std::string_view noun_;
  Findings& findings_;
  std::vector<std::string_view> known_;
  std::vector<std::pair<std::string_view, std::string_view>> strangers_;
};

}  // namespace glissade::design_file
