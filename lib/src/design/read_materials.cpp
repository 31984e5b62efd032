#include "design/read_materials.hpp"

#include "glissade/core/math.hpp"
#include "glissade/core/nearest_word.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/units.hpp"
#include "glissade/core/words.hpp"
#include "glissade/design/materials.hpp"

#include "data/shipped_data.hpp"
#include "design/schema_words.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <string_view>
#include <utility>

namespace glissade {
namespace design_file {
namespace {

void complain(const Value& value, std::string what, std::string why, std::string hint, Findings& findings) {
  findings.add(value.node->at, value.key_path, {"", std::move(what), std::move(why), std::move(hint)});
}

/// Reads entries and numbers of a list of materials, each with its source.
class Entries {
 public:
  Entries(const SourceKeys* sources, Findings& findings) : sources_(sources), findings_(findings) {}

  Material material(const Value& value) {
    MapReader map(value, "A material", "{material: my-ore, friction: [...]}", findings_);
    map.expect(
        {"material", "name", "density", "lateral_pressure_ratio", "friction", "highest_speed", "warnings"});
    Material material;
    material.own = sources_ == nullptr;
    if (const auto word = map.need("material", "material: my-ore")) material.word = text(*word);
    const auto name = map.find("name");
    material.name = name ? text(*name) : material.word;
    if (const auto density = map.find("density")) material.density = this->density(*density);
    if (const auto ratio = map.find("lateral_pressure_ratio"))
      material.lateral_pressure_ratio = sourced(*ratio, Dimension::number, "{value: 0.5, source: ...}");
    if (const auto list = map.find("friction")) {
      for (const Value& item : as_list(
               *list, "[{liner: mild-steel, angle: {low: 24 deg, high: 31 deg}, source: ...}]", findings_)) {
        if (auto friction = this->friction(item)) material.friction.push_back(*std::move(friction));
      }
    }
    if (const auto speed = map.find("highest_speed"))
      material.highest_speed = sourced(*speed, Dimension::speed, "{value: 8 m/s, source: ...}");
    if (const auto list = map.find("warnings")) {
      for (const Value& item : as_list(*list, "[\"measure it\"]", findings_))
        material.warnings.push_back(text(item));
    }
    map.refuse_unknown_keys();
    return material;
  }

 private:
  std::string text(const Value& value) { return as_text(value, findings_).value_or(""); }

  MaterialSource source(MapReader& map) {
    const auto value = map.need("source", "source: shear test of May, laboratory X");
    if (!value) return {};
    const std::string key = text(*value);
    if (sources_ == nullptr) return {key, Certainty::own};
    const auto found = sources_->find(key);
    if (found != sources_->end()) return found->second;
    std::vector<std::string_view> known;
    for (const auto& [name, unused] : *sources_) known.push_back(name);
    complain(*value, "source: " + shown(key) + " is none of the sources of this file", "",
             listed(known, "or"), findings_);
    return {};
  }

  MaterialDensity density(const Value& value) {
    MapReader map(value, "A density", "{low: 750 kg/m^3, high: 900 kg/m^3, source: ...}", findings_);
    map.expect({"low", "nominal", "high", "source"});
    const auto [low, nominal, high] = range(value, map, Dimension::density);
    MaterialDensity density{low, nominal, high, source(map)};
    map.refuse_unknown_keys();
    if (!(density.low > 0.0))
      complain(value, "density: it is not positive", "A bulk solid weighs something.", "1600 kg/m^3",
               findings_);
    return density;
  }

  SourcedValue sourced(const Value& value, Dimension dimension, std::string_view example) {
    MapReader map(value, "A value with its source", example, findings_);
    map.expect({"value", "why", "source"});
    SourcedValue result;
    result.value = map.needed_quantity("value", dimension, "value: ...").value_or(0.0);
    if (const auto why = map.find("why")) result.why = text(*why);
    result.from = source(map);
    map.refuse_unknown_keys();
    return result;
  }

  std::optional<WallFriction> friction(const Value& value) {
    MapReader map(value, "A wall friction",
                  "{liner: mild-steel, angle: {low: 24 deg, high: 31 deg}, source: ...}", findings_);
    if (sources_ != nullptr) {
      map.expect({"liner", "class", "angle", "coefficient", "factor", "moisture", "source"});
    } else {
      map.expect({"liner", "angle", "moisture", "source"});
    }
    WallFriction friction;
    if (sources_ != nullptr && map.has("class")) {
      static const Words<std::string> classes = {{"D1", "D1"}, {"D2", "D2"}, {"D3", "D3"}};
      friction.wall_class = map.choice(*map.find("class"), classes).value_or("");
      const auto mean = map.needed_quantity("coefficient", Dimension::number, "coefficient: 0.38");
      const auto factor = map.needed_quantity("factor", Dimension::number, "factor: 1.16");
      if (mean && factor && *mean > 0.0 && *factor >= 1.0) {
        friction.low = Angle::from_radians(math::atan(*mean / *factor));
        friction.nominal = Angle::from_radians(math::atan(*mean));
        friction.high = Angle::from_radians(math::atan(*mean * *factor));
      } else if (mean && factor) {
        complain(value, value.key + ": the coefficient is not positive, or the factor below 1", "",
                 "coefficient: 0.38, factor: 1.16", findings_);
      }
    } else {
      if (const auto liner = map.need("liner", "liner: mild-steel, or class: D2"))
        friction.liner = text(*liner);
      if (const auto angle = map.need("angle", "angle: {low: 24 deg, high: 31 deg}"))
        read_angles(*angle, friction);
    }
    if (const auto moisture = map.find("moisture")) friction.moisture = read_moisture(*moisture);
    friction.from = source(map);
    map.refuse_unknown_keys();
    return friction;
  }

  void read_angles(const Value& value, WallFriction& friction) {
    double low = 0.0;
    double nominal = 0.0;
    double high = 0.0;
    if (value.node->kind == Node::Kind::map) {
      MapReader map(value, "A range of angles", "{low: 24 deg, high: 31 deg}", findings_);
      map.expect({"low", "nominal", "high"});
      std::tie(low, nominal, high) = range(value, map, Dimension::angle);
      map.refuse_unknown_keys();
    } else {
      low = nominal = high = as_quantity(value, Dimension::angle, findings_).value_or(0.0);
    }
    if (!(low >= 0.0 && high < kRightAngle))
      complain(value, value.key + ": out of range", "A friction angle lies between 0 and 90 deg.",
               "{low: 24 deg, high: 31 deg}", findings_);
    friction.low = Angle::from_radians(low);
    friction.nominal = Angle::from_radians(nominal);
    friction.high = Angle::from_radians(high);
  }

  std::optional<Range> read_moisture(const Value& value) {
    MapReader map(value, "A range of moisture", "{low: 12 %, high: 18 %}", findings_);
    const auto low = map.needed_quantity("low", Dimension::number, "low: 12 %");
    const auto high = map.needed_quantity("high", Dimension::number, "high: 18 %");
    map.refuse_unknown_keys();
    if (!low || !high) return {};
    if (!(0.0 <= *low && *low < *high && *high < 1.0)) {
      complain(value, value.key + ": low and high are not in ascending order between 0 and 100 %", "",
               "{low: 12 %, high: 18 %}", findings_);
      return {};
    }
    return Range{low, high};
  }

  /// low, nominal and high: a nominal value, two ends, or all three.
  std::tuple<double, double, double> range(const Value& value, MapReader& map, Dimension dimension) {
    const auto low = map.quantity("low", dimension);
    const auto nominal = map.quantity("nominal", dimension);
    const auto high = map.quantity("high", dimension);
    if (!nominal && !(low && high)) {
      complain(value, value.key + ": neither a nominal value nor both ends are given", "",
               "low and high, or nominal", findings_);
      return {1.0, 1.0, 1.0};
    }
    const double middle = nominal ? *nominal : 0.5 * (*low + *high);
    const double least = low.value_or(middle);
    const double most = high.value_or(middle);
    if (!(least <= middle && middle <= most))
      complain(value, value.key + ": low, nominal and high are not in ascending order", "", "", findings_);
    return {least, middle, most};
  }

  const SourceKeys* sources_;
  Findings& findings_;
};

SourceKeys read_sources(MapReader& top, Findings& findings) {
  SourceKeys sources;
  const auto value = top.find("sources");
  if (!value) return sources;
  static const Words<Certainty> words = [] {
    Words<Certainty> all;
    for (const Certainty certainty : certainties()) all.emplace_back(word(certainty), certainty);
    return all;
  }();
  for (const auto& entry : value->node->entries) {
    MapReader map({&entry.value, entry.key, value->key_path + "." + entry.key}, "A source",
                  "{text: ..., certainty: secondary}", findings);
    MaterialSource source;
    if (const auto text = map.need("text", "text: EN 1991-4"))
      source.text = as_text(*text, findings).value_or("");
    if (const auto certainty = map.need("certainty", "certainty: secondary"))
      source.certainty = map.choice(*certainty, words).value_or(Certainty::own);
    map.refuse_unknown_keys();
    sources.emplace(entry.key, source);
  }
  return sources;
}

std::vector<Liner> read_liners(MapReader& top, Findings& findings) {
  std::vector<Liner> liners;
  const auto value = top.find("liners");
  if (!value) return liners;
  static const Words<std::string> classes = {{"D1", "D1"}, {"D2", "D2"}, {"D3", "D3"}};
  for (const Value& item : as_list(*value, "[{liner: mild-steel, name: mild steel, class: D2}]", findings)) {
    MapReader map(item, "A liner", "{liner: mild-steel, name: mild steel, class: D2}", findings);
    Liner liner;
    if (const auto word = map.need("liner", "liner: mild-steel"))
      liner.word = as_text(*word, findings).value_or("");
    if (const auto name = map.need("name", "name: mild steel"))
      liner.name = as_text(*name, findings).value_or("");
    if (const auto wall = map.find("class")) liner.wall_class = map.choice(*wall, classes).value_or("");
    map.refuse_unknown_keys();
    liners.push_back(std::move(liner));
  }
  return liners;
}

}  // namespace

std::vector<Material> read_materials(MapReader& top, const SourceKeys* sources, Findings& findings) {
  std::vector<Material> materials;
  const auto value = top.find("materials");
  if (!value) return materials;
  Entries entries(sources, findings);
  for (const Value& item : as_list(*value, "[{material: my-ore, friction: [...]}]", findings))
    materials.push_back(entries.material(item));
  return materials;
}

}  // namespace design_file

MaterialLibrary parse_materials(std::string_view text, const std::filesystem::path& file) {
  using namespace design_file;
  const std::vector<Override> none;
  Findings findings(file, none);
  Node root;
  try {
    root = parse_tree(text);
  } catch (const SyntaxProblem& problem) {
    Issue issue = problem.issues().front();
    issue.where = findings.where(problem.at());
    throw InputError(std::move(issue));
  }
  MaterialLibrary library;
  MapReader top({&root, "", ""}, "A file of materials", "glissade_materials: 1 as its first line", findings);
  top.expect({"glissade_materials", "sources", "liners", "materials"});
  if (const auto version = top.need("glissade_materials", "glissade_materials: 1"))
    static_cast<void>(as_quantity(*version, Dimension::number, findings));
  const SourceKeys sources = read_sources(top, findings);
  library.liners = read_liners(top, findings);
  library.materials = read_materials(top, &sources, findings);
  top.refuse_unknown_keys();
  if (!findings.empty()) throw InputError(findings.issues());
  return library;
}

const MaterialLibrary& shipped_materials() {
  static const MaterialLibrary library = [] {
    MaterialLibrary all;
    for (const data::DataFile& file : data::shipped_data("materials")) {
      MaterialLibrary part = parse_materials(file.text, file.path);
      std::move(part.materials.begin(), part.materials.end(), std::back_inserter(all.materials));
      std::move(part.liners.begin(), part.liners.end(), std::back_inserter(all.liners));
    }
    return all;
  }();
  return library;
}

}  // namespace glissade
