#include "design/read_fabrication.hpp"

#include "glissade/core/number_text.hpp"

#include "core/counted.hpp"
#include "design/read_process.hpp"
#include "design/read_rules.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace glissade::design_file {
namespace {

enum class Process { plate, print, timber };

/// The least that rules ask of a quantity; 0 where none does. What depends on the thickness of a part is judged in the build.
double least_asked(const std::vector<Rule>& rules, std::string_view quantity, double density, bool advice) {
  double least = 0.0;
  for (const Rule& rule : rules) {
    if (rule.quantity != quantity || !rule.bound.lowest || (rule.advice && !advice)) continue;
    const bool holds = std::all_of(rule.when.begin(), rule.when.end(), [&](const RuleCondition& when) {
      return when.quantity == "part_density" && density >= when.range.lowest.value_or(density) &&
             density <= when.range.highest.value_or(density);
    });
    if (holds) least = std::max(least, *rule.bound.lowest);
  }
  return least;
}

/// What is refused as too little, and what bent floors keep to: as rules of the shop have it.
ShopLeast least_of(const std::vector<Rule>& rules, double density) {
  const auto least = [&](std::string_view quantity, bool advice) {
    return least_asked(rules, quantity, density, advice);
  };
  return {.hole_edge_diameters = least("hole_edge_diameters", false),
          .hole_pitch_diameters = least("hole_pitch_diameters", false),
          .slot_edge_diameters = least("slot_edge_diameters", false),
          .bend_radius_thicknesses = least("bend_radius_thicknesses", false),
          .flat_thicknesses = least("flat_thicknesses", true),
          .flat = least("flat", true)};
}

}  // namespace

std::optional<int> read_count(MapReader& map, std::string_view key, Findings& findings) {
  const auto value = map.find(key);
  const auto number = value ? as_quantity(*value, Dimension::number, findings) : std::nullopt;
  if (!number) return std::nullopt;
  constexpr double kMost = 1e6;
  if (std::floor(*number) == *number && std::fabs(*number) <= kMost) return static_cast<int>(*number);
  findings.add(value->node->at, value->key_path,
               {"", std::string(key) + ": " + rounded_text(*number, 6) + " is no whole number", "",
                std::string(key) + ": 3"});
  return std::nullopt;
}

StockMaterial read_material(const Value& value, StockMaterial material, Findings& findings) {
  MapReader map(value, "A material", "{name: S235, density: 7850 kg/m^3}", findings);
  if (const auto name = map.need("name", "name: S235")) material.name = as_text(*name, findings).value_or("");
  material.density =
      map.needed_quantity("density", Dimension::density, "density: 7850 kg/m^3").value_or(material.density);
  map.refuse_unknown_keys();
  return material;
}

std::vector<Vec2> read_ground(const Value& value, Findings& findings) {
  constexpr std::string_view kExample = "[[0 m, 9 m], [5 m, 6 m]]";
  if (value.node->kind != Node::Kind::sequence)
    return {{0.0, as_quantity(value, Dimension::length, findings).value_or(0.0)}};
  std::vector<Vec2> line = as_points(value, kExample, findings, {.least = 2});
  const std::size_t points = value.node->items.size();
  if (points >= 2) return line;
  findings.add(value.node->at, value.key_path,
               {"", "ground: a line of " + core::counted(points, "point"),
                "A line has two points or more; a level is one height.",
                "ground: 0 m, or ground: " + std::string(kExample)});
  return {{0.0, 0.0}};
}

std::optional<FabricationDesign> read_fabrication(MapReader& top, const std::filesystem::path& folder,
                                                  Findings& findings) {
  const auto value = top.find("fabrication");
  if (!value) return {};
  constexpr std::string_view kExample = "{process: plate}";
  MapReader map(*value, "A fabrication", kExample, findings);
  for (const auto& [key, place] :
       {std::pair("bed", "split: {bed: [220 mm, 220 mm, 250 mm]}, of a print"),
        std::pair("sheet", "split: {sheet: [3 m, 1.5 m]}"), std::pair("longest", "split: {longest: 3 m}"),
        std::pair("heaviest", "split: {heaviest: 50 kg}"), std::pair("margin", "split: {margin: 5 mm}"),
        std::pair("spacing", "split: {spacing: 10 mm}")})
    map.add_stranger(key, place);
  map.expect({"process", "material", "arc_tolerance", "rules"});
  FabricationDesign design;
  const auto word = map.need("process", "process: plate");
  const auto kind =
      word ? map.choice<Process>(
                 *word, {{"plate", Process::plate}, {"print", Process::print}, {"timber", Process::timber}})
           : std::nullopt;
  const auto material = map.find("material");
  const auto rules = map.find("rules");
  const auto tolerance = map.quantity("arc_tolerance", Dimension::length);
  if (!kind) {
    // Which keys belong to it is not known.
    if (material) static_cast<void>(read_material(*material, {}, findings));
    if (rules) static_cast<void>(read_rule_group(*rules, {}, RuleSubject::workshop, folder, findings));
    return {};
  }
  switch (*kind) {
    case Process::plate:
      design.process = read_plate(map, findings);
      break;
    case Process::print:
      design.process = read_print(map, findings);
      break;
    case Process::timber:
      design.process = read_timber(map, findings);
      break;
  }
  std::visit(
      [&](auto& process) {
        if (material) process.material = read_material(*material, process.material, findings);
        design.arc_tolerance = tolerance.value_or(process.kArcTolerance);
      },
      design.process);
  const std::vector<std::string> suggested = {"shop-" + std::string(process_word(design))};
  design.rules = rules ? read_rule_group(*rules, suggested, RuleSubject::workshop, folder, findings)
                       : suggested_rules(suggested);
  if (auto* const plate = std::get_if<PlateOptions>(&design.process))
    plate->shop = least_of(design.rules.in_force, plate->material.density);
  map.refuse_unknown_keys();
  return design;
}

}  // namespace glissade::design_file
