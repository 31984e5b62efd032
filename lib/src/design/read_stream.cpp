#include "design/read_stream.hpp"

#include "glissade/core/nearest_word.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/words.hpp"
#include "glissade/design/materials.hpp"

#include "design/checks.hpp"

#include <optional>
#include <string>
#include <vector>

namespace glissade::design_file {
namespace {

constexpr std::string_view kExample = "{mass_flow: 650 t/h, bulk_density: 1600 kg/m^3}";

/// One density, or a range with a nominal value.
void read_density(const Value& value, StreamDesign& stream, Findings& findings) {
  if (value.node->kind != Node::Kind::map) {
    stream.bulk_density = as_quantity(value, Dimension::density, findings).value_or(0.0);
    return;
  }
  MapReader map(value, "A range of bulk density", "", findings);
  map.expect({"low", "nominal", "high"});
  stream.bulk_density = map.needed_quantity("nominal", Dimension::density,
                                            "nominal: the density that the objective is taken at")
                            .value_or(0.0);
  stream.low_density = map.quantity("low", Dimension::density);
  stream.high_density = map.quantity("high", Dimension::density);
  map.refuse_unknown_keys();
}

LinerPlateDesign read_plate(const Value& value, Findings& findings) {
  MapReader map(value, "A liner plate", "{thickness: 12 mm, hardness: 4 GPa, wear_coefficient: 2e-4}",
                findings);
  map.expect({"thickness", "hardness", "wear_coefficient"});
  LinerPlateDesign plate;
  plate.thickness = map.needed_quantity("thickness", Dimension::length, "thickness: 12 mm").value_or(1.0);
  plate.hardness =
      map.needed_quantity("hardness", Dimension::pressure, "hardness: 4 GPa, of 400 HB").value_or(1.0);
  plate.wear_coefficient =
      map.needed_quantity("wear_coefficient", Dimension::number,
                          "wear_coefficient: 2e-4, from a test or from a liner that was worn")
          .value_or(1.0);
  map.refuse_unknown_keys();
  return plate;
}

std::optional<MaterialChoice> read_choice(MapReader& map, Findings& findings) {
  const auto material = map.find("material");
  const auto liner = map.find("liner");
  const auto moisture = map.quantity("moisture", Dimension::number);
  if (!material) {
    for (const char* const key : {"liner", "moisture"}) {
      if (!map.has(key)) continue;
      findings.add(findings.position(map.path_of(key)), map.path_of(key),
                   {"", std::string(key) + ": without a material", "What rubs on it is not known.",
                    "material: wheat, or friction_angle below body:"});
    }
    return {};
  }
  MaterialChoice choice;
  choice.material = as_text(*material, findings).value_or("");
  if (liner) choice.liner = as_text(*liner, findings).value_or("");
  choice.moisture = moisture;
  if (moisture && !(*moisture >= 0.0 && *moisture < 1.0)) {
    findings.add(findings.position(map.path_of("moisture")), map.path_of("moisture"),
                 {"", "moisture: " + percent_beyond(*moisture, {0.0, 1.0}) + " is out of range",
                  "Water over the mass of all: 0 to 100 %.", "14 %"});
  }
  return choice;
}

/// Why a word is not in the library, with what comes near it.
template <typename Thing>
Issue unknown_word(const std::string& key, const std::string& word, const std::vector<Thing>& things) {
  std::vector<std::string_view> words;
  for (const Thing& thing : things) words.push_back(thing.word);
  const std::string_view near = nearest_word(word, words);
  return {
      "", key + ": " + shown(word) + " is none that is known",
      "'glissade materials' lists " + std::to_string(things.size()) + " of them.",
      (near.empty() ? std::string() : std::string(near) + ", or ") + "an entry of your own below materials:"};
}

/// @return the material of that word, of the design's own first; null if there is none
const Material* find_material(const Design& design, const std::string& word) {
  for (const Material& own : design.materials) {
    if (own.word == word) return &own;
  }
  return shipped_materials().material(word);
}

/// What nothing is known of, and on which liners something is.
Issue unknown_friction(const Material& material, const MaterialChoice& choice) {
  const std::vector<Liner>& liners = shipped_materials().liners;
  std::vector<std::string> known;
  for (const Liner& liner : liners) {
    if (friction_on(material, liner)) known.push_back(liner.word);
  }
  const std::string without = known.empty() ? "" : "liner: " + listed(known, "or") + "; or ";
  const std::string hint = without + "friction_angle below body:, from a test of your own";
  if (choice.liner.empty()) {
    return {"", "material: " + shown(choice.material) + " without a liner",
            "Wall friction is that of a material on a liner.", hint};
  }
  if (shipped_materials().liner(choice.liner) == nullptr && !material.own)
    return unknown_word("liner", choice.liner, liners);
  return {"", "liner: nothing is known of " + shown(choice.material) + " on " + shown(choice.liner), "",
          hint};
}

void follow_friction(const Material& material, Design& design, Findings& findings) {
  const MaterialChoice& choice = *design.stream->material;
  const Liner* const known = shipped_materials().liner(choice.liner);
  const Liner own{choice.liner, choice.liner, ""};
  const auto found = friction_on(material, known == nullptr ? own : *known, choice.moisture);
  if (!found) {
    const std::string path = choice.liner.empty() ? "stream.material" : "stream.liner";
    findings.add(findings.position(path), path, unknown_friction(material, choice));
    return;
  }
  design.body.friction = Friction::from_angle(found->nominal);
  if (found->low < found->nominal) design.body.low_friction = Friction::from_angle(found->low);
  if (found->nominal < found->high) design.body.high_friction = Friction::from_angle(found->high);
}

void follow_density(const Material& material, StreamDesign& stream, Findings& findings) {
  if (!material.density) {
    findings.add(findings.position("stream.material"), "stream.material",
                 {"", "material: " + shown(material.word) + " has no density in the library", "",
                  "bulk_density: 1600 kg/m^3, as it was weighed"});
    return;
  }
  const MaterialDensity& density = *material.density;
  stream.bulk_density = density.nominal;
  if (density.low < density.nominal) stream.low_density = density.low;
  if (density.high > density.nominal) stream.high_density = density.high;
}

}  // namespace

void follow_material(Design& design, Findings& findings) {
  if (!design.stream || !design.stream->material) return;
  StreamDesign& stream = *design.stream;
  const Material* const material = find_material(design, stream.material->material);
  if (material == nullptr) {
    std::vector<Material> all = design.materials;
    const std::vector<Material>& shipped = shipped_materials().materials;
    all.insert(all.end(), shipped.begin(), shipped.end());
    findings.add(findings.position("stream.material"), "stream.material",
                 unknown_word("material", stream.material->material, all));
    return;
  }
  if (!design.body.friction_given) follow_friction(*material, design, findings);
  if (stream.material->density_follows) follow_density(*material, stream, findings);
  if (stream.material->pressure_ratio_follows && material->lateral_pressure_ratio)
    stream.lateral_pressure_ratio = material->lateral_pressure_ratio->value;
}

std::optional<StreamDesign> read_stream(MapReader& top, Findings& findings) {
  const std::optional<Value> value = top.find("stream");
  if (!value) return {};
  MapReader map(*value, "A stream", kExample, findings);
  if (!map.readable()) return {};
  map.expect({"mass_flow", "bulk_density", "material", "liner", "moisture", "lump_size",
              "lateral_pressure_ratio", "slip_ratio", "liner_plate", "surge", "trickle"});
  for (const std::string_view key : {"friction_angle", "friction_coefficient", "entry_speed"})
    map.add_stranger(key, "below body:, which says how the stream rubs and how fast it enters");
  for (const std::string_view key : {"width", "wall_height"})
    map.add_stranger(key, "below cross_section:, which says what the stream runs in");
  StreamDesign stream;
  stream.material = read_choice(map, findings);
  stream.mass_flow =
      map.needed_quantity("mass_flow", Dimension::mass_flow, "mass_flow: 650 t/h").value_or(0.0);
  const auto density =
      stream.material ? map.find("bulk_density") : map.need("bulk_density", "bulk_density: 1600 kg/m^3");
  if (density) read_density(*density, stream, findings);
  if (stream.material) {
    stream.material->density_follows = !density;
    stream.material->pressure_ratio_follows = !map.has("lateral_pressure_ratio");
  }
  stream.lump_size = map.quantity("lump_size", Dimension::length);
  const auto number = [&](std::string_view key, double& field) {
    field = map.quantity(key, Dimension::number).value_or(field);
  };
  number("lateral_pressure_ratio", stream.lateral_pressure_ratio);
  number("slip_ratio", stream.slip_ratio);
  if (const auto plate = map.find("liner_plate")) stream.liner_plate = read_plate(*plate, findings);
  number("surge", stream.surge);
  number("trickle", stream.trickle);
  map.refuse_unknown_keys();
  return stream;
}

}  // namespace glissade::design_file
