#include "design/read_cross_section.hpp"

#include "glissade/core/words.hpp"

#include "design/schema_words.hpp"

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace glissade::design_file {
namespace {

constexpr const char* kWidthsExample = "[{at: 0 m, width: 600 mm}, {at: 3 m, width: 400 mm}]";

std::optional<WidthAt> read_width_at(const Value& value, Findings& findings) {
  MapReader map(value, "A width at a place", "{at: 2 m, width: 600 mm}", findings);
  const auto at = map.needed_quantity("at", Dimension::length, "at: 2 m, along the track");
  const auto width = map.needed_quantity("width", Dimension::length, "width: 600 mm");
  map.refuse_unknown_keys();
  if (!at || !width) return {};
  return WidthAt{*at, *width};
}

/// @return the law that a list of widths makes; none if something is wrong with it, which is then a finding
std::optional<WidthLaw> read_widths(const Value& value, Findings& findings) {
  std::vector<WidthAt> knots;
  bool sound = true;
  for (const Value& item : as_list(value, kWidthsExample, findings, {.least = 1})) {
    const std::optional<WidthAt> knot = read_width_at(item, findings);
    sound = sound && knot.has_value();
    if (knot) knots.push_back(*knot);
  }
  if (!sound) return {};
  try {
    return WidthLaw(std::move(knots));
  } catch (const InputError& error) {
    Issue issue = error.issues().front();
    if (issue.hint.empty()) issue.hint = kWidthsExample;
    findings.add(value.node->at, value.key_path, std::move(issue));
  }
  return {};
}

/// Reads each measure of a kind under its key.
class MeasureReader {
 public:
  MeasureReader(MapReader& map, Findings& findings) : map_(map), findings_(findings) {}

  void width(const char* key, WidthLaw& law, const char* example) {
    const auto value = map_.need(key, std::string(key) + ": " + example);
    if (!value) return;
    if (value->node->kind == Node::Kind::sequence) {
      law = read_widths(*value, findings_).value_or(WidthLaw());
    } else {
      law = as_quantity(*value, Dimension::length, findings_).value_or(0.0);
    }
  }
  void length(const char* key, double& value, const char* example) {
    value = needed(key, Dimension::length, example);
  }
  void optional_length(const char* key, double& value) {
    value = map_.quantity(key, Dimension::length).value_or(0.0);
  }
  void angle(const char* key, Angle& value, const char* example) {
    value = Angle::from_radians(needed(key, Dimension::angle, example));
  }
  void corners(const char* key, std::vector<Vec2>& values, const char* example) {
    if (const auto list = map_.need(key, example))
      values = as_points(*list, example, findings_, {.least = 3});
  }
  void misnomer(const char* key, const char* right) { map_.add_stranger(key, right); }

 private:
  double needed(const char* key, Dimension dimension, const char* example) {
    return map_.needed_quantity(key, dimension, std::string(key) + ": " + example).value_or(0.0);
  }

  MapReader& map_;
  Findings& findings_;
};

/// The keys of a kind, without those that only point elsewhere.
class SectionKeys {
 public:
  void width(const char* key, const WidthLaw&, const char*) { keys_.emplace_back(key); }
  void length(const char* key, double, const char*) { keys_.emplace_back(key); }
  void optional_length(const char* key, double) { keys_.emplace_back(key); }
  void angle(const char* key, Angle, const char*) { keys_.emplace_back(key); }
  void corners(const char* key, const std::vector<Vec2>&, const char*) { keys_.emplace_back(key); }
  void misnomer(const char*, const char*) const {}

  [[nodiscard]] const std::vector<std::string_view>& keys() const { return keys_; }

 private:
  std::vector<std::string_view> keys_;
};

std::vector<std::string_view> keys_of(const section::Measures& measures) {
  SectionKeys keys;
  section::visit_measures(measures, keys);
  return keys.keys();
}

/// A key that one kind alone has, with the hint that names the kind.
struct OwnKey {
  std::string_view key;
  std::string hint;
};

std::vector<OwnKey> own_keys() {
  std::vector<OwnKey> all;
  for (const auto& [kind, measures] : cross_section_words()) {
    std::vector<std::string_view> own = keys_of(measures);
    for (const auto& [other, others_measures] : cross_section_words()) {
      if (other == kind) continue;
      const std::vector<std::string_view> others = keys_of(others_measures);
      std::erase_if(own, [&](std::string_view key) {
        return std::find(others.begin(), others.end(), key) != others.end();
      });
    }
    for (const std::string_view key : own) {
      all.push_back({key, "kind: " + std::string(kind) + ", which has " + listed(own)});
    }
  }
  return all;
}

}  // namespace

std::optional<CrossSectionDesign> read_cross_section(MapReader& top, Findings& findings) {
  static const std::vector<OwnKey> kOwnKeys = own_keys();
  const std::optional<Value> value = top.find("cross_section");
  if (!value) return {};
  MapReader map(*value, "A cross_section",
                "{kind: u-channel, width: 400 mm, wall_height: 250 mm, thickness: 4 mm}", findings);
  const auto kind_value = map.need("kind", "kind: u-channel");
  std::optional<CrossSectionDesign> section =
      kind_value ? map.choice(*kind_value, cross_section_words()) : std::nullopt;
  if (!section) return {};
  const std::string noun = "A cross_section of kind " + std::string(section::kind(*section));
  map.rename(noun);
  section::visit_measures(*section, MeasureReader(map, findings));
  for (const OwnKey& own : kOwnKeys) map.add_stranger(own.key, own.hint);
  map.refuse_unknown_keys();
  return section;
}

}  // namespace glissade::design_file
