#include "glissade/design/schema.hpp"

#include "glissade/core/error.hpp"
#include "glissade/design/design.hpp"
#include "glissade/design/template.hpp"
#include "glissade/design/write.hpp"

#include "design/design_text.hpp"
#include "support/catch.hpp"
#include "support/json_schema.hpp"
#include "support/paths.hpp"
#include "support/yaml_json.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

namespace schema_test {

using namespace glissade;
using namespace glissade::test;
using nlohmann::json;

namespace {

const json& schema() {
  static const json kSchema = json::parse(design_schema());
  return kSchema;
}

std::string text_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::string fault_of(const std::string& text) {
  return json_schema_fault(schema(), yaml_as_json(text));
}

/// What a reading finds, as far as it has nothing to do with whether the track can be ridden.
bool reads(const std::string& text, const std::filesystem::path& file) {
  try {
    static_cast<void>(parse_design(text, file));
  } catch (const InputError&) {
    return false;
  } catch (const InfeasibleError&) {
    return true;
  }
  return true;
}

}  // namespace

TEST_CASE("the schema accepts every shipped design and every template") {
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(designs_path())) {
    if (entry.path().extension() != ".yaml") continue;
    INFO(entry.path());
    CHECK(fault_of(text_of(entry.path())) == "");
    ++count;
  }
  CHECK(count >= 10);
  for (const DesignTemplate& entry : design_templates()) {
    INFO(std::string(entry.kind));
    CHECK(fault_of(design_template(entry.kind)) == "");
  }
}

TEST_CASE("the schema accepts a start that is free beside an edge, as the reference and rewrite have it") {
  constexpr std::string_view kEnds = "  start: {x: 0 m, z: 6.2 m}\n  finish: {x: 5.4 m, z: 1.1 m}\n";
  for (const std::string start : {"", "  start: {x: free, z: 47 m}\n", "  start: {x: -50 m, z: free}\n",
                                  "  start: {x: free, y: 0 m, z: free}\n"}) {
    const std::string text = sound_design_with(kEnds, "  edge: {x: 0 m, z: 0 m}\n" + start) +
                             "limits: {exit_speed: {lowest: 9 m/s}}\n";
    INFO(text);
    CHECK(fault_of(text) == "");
    CHECK(fault_of(design_text(parse_design(text, "to_edge.yaml"))) == "");
  }
  CHECK(fault_of(sound_design_with(kEnds, "  edge: {x: 0 m, z: 0 m}\n  start: {x: fere, z: 47 m}\n")) != "");
  CHECK(fault_of(sound_design_with(kEnds, "  edge: {x: free, z: 0 m}\n")) != "");
}

TEST_CASE("the schema accepts what is written of every shipped design") {
  for (const auto& entry : std::filesystem::directory_iterator(designs_path())) {
    if (entry.path().extension() != ".yaml") continue;
    INFO(entry.path());
    CHECK(fault_of(design_text(read_design(entry.path()))) == "");
  }
}

TEST_CASE("what the schema refuses of the corpus no reading accepts") {
  std::size_t refused = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(test_data_path("corpus/design"))) {
    if (!entry.is_regular_file()) continue;
    const std::string text = text_of(entry.path());
    json document;
    try {
      document = yaml_as_json(text);
    } catch (const std::exception&) {
      continue;  // not YAML at all
    }
    const std::string fault = json_schema_fault(schema(), document);
    INFO(entry.path() << ": " << fault);
    if (fault.empty()) continue;
    CHECK_FALSE(reads(text, entry.path()));
    ++refused;
  }
  CHECK(refused >= 1);
}

TEST_CASE("the schema refuses unknown keys, missing keys, wrong units, words and shapes") {
  const auto with = [](const std::string& from, const std::string& to) {
    return fault_of(sound_design_with(from, to));
  };
  CHECK(fault_of(sound_design_with("17 deg", "17 deg")) == "");
  CHECK(with("friction_angle: 17 deg", "frictoin_angle: 17 deg") != "");
  CHECK(with("17 deg", "17 m") != "");
  CHECK(with("17 deg", "17") != "");
  CHECK(with("17 deg", "{low: 14 deg, nominal: 17 deg, high: 20 deg}") == "");
  CHECK(with("17 deg", "{low: 14 deg, high: 20 deg}") != "");
  CHECK(with("{x: 5.4 m, z: 1.1 m}", "{x: 5.4 m}") != "");
  CHECK(with("{x: 5.4 m, z: 1.1 m}", "{x: 5.4 m, z: free}") == "");
  CHECK(with("{x: 5.4 m, z: 1.1 m}", "{x: 5.4 m, z: {lowest: 1 m}}") == "");
  CHECK(with("{x: 5.4 m, z: 1.1 m}", "[5.4 m, 1.1 m]") != "");
  const auto limited = [](const std::string& limits) {
    std::string text = sound_design_with("17 deg", "17 deg");
    text.insert(text.find("mesh:"), "limits: {" + limits + "}\n");
    return fault_of(text);
  };
  CHECK(limited("") == "");
  CHECK(limited("slope_angle: {highest: 35 deg}, exit_slope_angle: 11 deg, concave: true") == "");
  CHECK(limited("slope_angle: 35 deg") != "");
  CHECK(limited("concave: maybe") != "");
  CHECK(limited("lowest_normal_load: none") == "");
  CHECK(limited("keep_outs: [{outline: [[1 m, 2 m], [3 m, 2 m], [3 m, 4 m]], pass: below}]") == "");
  CHECK(limited("keep_outs: [{outline: [[1 m, 2 m], [3 m, 2 m], [3 m, 4 m]], pass: aside}]") != "");
  CHECK(limited("objective: {kind: blend, exit_speed_weight: 0.1 s/(m/s)}") == "");
  CHECK(limited("objective: {kind: blend}") != "");
  CHECK(limited("stay_above: [{file: ground.csv, unit: mm, columns: [x, z], clearance: 1 m}]") == "");
  CHECK(limited("stay_above: [{file: ground.csv, unit: feet}]") != "");
  CHECK(with("mesh:", "probes: [{from_start: 2 m, name: gate}, {x: 3 m}]\nmesh:") == "");
  CHECK(with("mesh:", "probes: [{from_stat: 2 m}]\nmesh:") != "");
}

TEST_CASE("words that the reader takes from a table, and lengths of lists, are those of the schema") {
  const auto with = [](const std::string& line) {
    const std::string text = sound_design_with("mesh:", line + "\nmesh:");
    const std::string fault = fault_of(text);
    INFO(text << fault);
    CHECK(reads(text, "d.yaml") == fault.empty());
    return fault.empty();
  };
  const auto plate = [&](const std::string& keys) {
    return with("fabrication: {process: plate, " + keys + "}");
  };
  for (const std::string group : {"flanges: {bolt: M", "rim: {width: 60 mm}, cover: {bolt: M",
                                  "inspection: [{at: 2 m, bolt: M", "supports: {ground: 0 m, anchor: M"}) {
    const std::string end = group.find('[') != std::string::npos ? "}]" : "}";
    CHECK(plate(group + "10" + end));
    CHECK_FALSE(plate(group + "11" + end));
    CHECK_FALSE(plate(group + "none" + end));
  }
  const auto rule = [](const std::string& quantity, const std::string& bound) {
    return "rules: {own: [{id: own.a, sentence: A., source: us, quantity: " + quantity +
           ", highest: " + bound + "}]}";
  };
  CHECK(plate(rule("part_mass", "3 kg")));
  CHECK_FALSE(plate(rule("part_length", "3 m")));
  CHECK_FALSE(plate(rule("exit_speed", "3 m/s")));
  CHECK(with(rule("exit_speed", "3 m/s")));
  CHECK_FALSE(with(rule("part_mass", "3 kg")));
  CHECK(plate("split: {sheet: [3 m, 1.5 m]}"));
  CHECK_FALSE(plate("split: {sheet: [3 m]}"));
  CHECK_FALSE(plate("split: {sheet: [3 m, 1.5 m, 1 m]}"));
  CHECK(with("fabrication: {process: print, split: {bed: [420 mm, 420 mm, 450 mm]}}"));
  CHECK_FALSE(with("fabrication: {process: print, split: {bed: [420 mm, 420 mm]}}"));
  const auto keep_out = [](const std::string& points) {
    return "limits: {keep_outs: [{outline: [" + points + "]}]}";
  };
  CHECK(with(keep_out("[1 m, 8 m], [2 m, 8 m], [2 m, 9 m]")));
  CHECK_FALSE(with(keep_out("[1 m, 8 m], [2 m, 8 m]")));
  CHECK_FALSE(with(keep_out("[1 m, 8 m], [2 m, 8 m], [2 m]")));
  CHECK_FALSE(fault_of(sound_design_with("[stl, off, scad]", "[]")).empty());
  for (const std::string columns : {"[x, z]", "[x, z, slope, curvature]"})
    CHECK(fault_of(
              sound_design_with("{kind: fastest}", "{kind: points, file: p.csv, columns: " + columns + "}"))
              .empty());
  CHECK_FALSE(
      fault_of(sound_design_with("{kind: fastest}", "{kind: points, file: p.csv, columns: [x, z, slope]}"))
          .empty());
}

TEST_CASE("what hangs on a kind is asked of that kind alone") {
  const auto section = [](const std::string& keys) {
    std::string text = sound_design_with("17 deg", "17 deg");
    const std::size_t at = text.find("cross_section:");
    if (at != std::string::npos) text.erase(at, text.find('\n', at) + 1 - at);
    return fault_of(text + "\ncross_section: {" + keys + "}\n");
  };
  CHECK(section("kind: u-channel, width: 400 mm, wall_height: 250 mm, thickness: 4 mm") == "");
  CHECK(section("kind: u-channel, width: 400 mm, thickness: 4 mm") != "");
  CHECK(
      section("kind: u-channel, width: [{at: 0 m, width: 1 m}, {at: 2 m, width: 2 m}], wall_height: 250 mm, "
              "thickness: 4 mm") == "");
  CHECK(section("kind: u-channel, width: [{at: 0 m, with: 1 m}], wall_height: 250 mm, thickness: 4 mm") !=
        "");
  CHECK(section("kind: pipe, inner_diameter: 150 mm, thickness: 4 mm") == "");
  CHECK(section("kind: pipe, width: 150 mm, thickness: 4 mm") != "");
}

}  // namespace schema_test
