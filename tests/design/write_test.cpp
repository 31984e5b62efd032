#include "glissade/design/write.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/quantity.hpp"
#include "glissade/design/template.hpp"

#include "design/design_text.hpp"
#include "support/catch.hpp"
#include "support/paths.hpp"
#include "support/random.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numbers>
#include <optional>
#include <string>

namespace write_test {

using namespace glissade;
using namespace glissade::test;

namespace {

std::string text_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::optional<Design> read(const std::string& text, const std::filesystem::path& file) {
  try {
    return parse_design(text, file);
  } catch (const Error&) {
    return {};
  }
}

void check_written(const Design& design) {
  const std::string text = design_text(design);
  INFO(text);
  const Design again = parse_design(text, design.file);
  CHECK(again.asks_the_same(design));
  CHECK(design_text(again) == text);
}

}  // namespace

TEST_CASE("every shipped design, template and sound design of the corpus is written back as it was read") {
  std::size_t count = 0;
  for (const std::string& folder : {designs_path(), test_data_path("corpus/design")}) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
      if (!entry.is_regular_file() || entry.path().extension() == ".csv") continue;
      const std::optional<Design> design = read(text_of(entry.path()), entry.path());
      if (!design) continue;
      INFO(entry.path());
      check_written(*design);
      ++count;
    }
  }
  CHECK(count >= 10);
  for (const DesignTemplate& entry : design_templates()) {
    INFO(std::string(entry.kind));
    check_written(parse_design(design_template(entry.kind), "d.yaml"));
  }
}

TEST_CASE("every key of the processes is written back") {
  for (
      const std::string& fabrication :
      {std::string("{process: plate, corners: lap}"),
       std::string("{process: plate, split: {widest: 0.7 m, bar: 12 m, frames: 3}}"),
       std::string(
           "{process: plate, walls: on-floor, corners: {kind: tab-and-slot, overlap: 30 mm, tab: 50 mm, "
           "spacing: 0.25 m, clearance: 0.3 mm}}"),
       std::string(
           "{process: print, material: {name: PETG, density: 1270 kg/m^3}, arc_tolerance: 0.05 mm, "
           "split: {bed: [180 mm, 190 mm, 200 mm], gap: 3 mm, longest: 150 mm, heaviest: 0.09 kg, allowed: "
           "false}, "
           "dowels: {diameter: 3 mm, depth: 7 mm, fit: 0.2 mm, chamfer: 0.4 mm}, pose: end, layer: 0.15 mm, "
           "wall: 1.2 mm, overhang: 50 deg, number_depth: 0.3 mm, ease: 0.1 mm}"),
       std::string("{process: print, dowels: none, pose: flat}"), std::string("{process: print, pose: side}"),
       std::string("{process: print, joint: tongue, pose: side}"),
       std::string(
           "{process: print, joint: dovetail, tongue: {height: 4 mm, depth: 3 mm, fit: 0.25 mm, chamfer: 0.3 "
           "mm, flare: 12 deg}, stands: {ground: [[0 m, -1 m], [4 m, -2 m]], clear: 20 mm, spacing: 0.3 m, "
           "thickness: 12 mm, cheek: 6 mm, fit: 0.3 mm, steepest: 50 deg}}"),
       std::string(
           "{process: plate, rules: {sets: [shop-plate], leave_out: [plate.web], own: [{id: a, sentence: S., "
           "quantity: hole_thicknesses, lowest: 2, source: us}]}}"),
       std::string(
           "{process: timber, material: {name: spruce plywood, density: 460 kg/m^3}, "
           "lumber: {name: GL24h, density: 430 kg/m^3}, arc_tolerance: 2 mm, frame: beams, "
           "bearers: {count: 3, spacing: 0.5 m, width: 100 mm, depth: 300 mm}, deck: {layers: 3, "
           "stave_tolerance: 5 mm, boards: {width: 100 mm, length: 3.5 m, gap: 4 mm}}, "
           "cross_members: {width: 60 mm, height: 80 mm, spacing: 350 mm, cheek: 50 mm, reach: 200 mm}, "
           "legs: {ground: [[0 m, -1 m], [4 m, -2 m]], spacing: 1.5 m, side: 100 mm, braced_from: 2 m, "
           "brace_width: 140 mm, brace_thickness: 30 mm}, "
           "split: {sheet: [3 m, 1.5 m], longest: 9 m, heaviest: 80 kg, margin: 12 mm, spacing: 6 mm}, fit: "
           "3 mm, joint_step: 0.5 mm}"),
       std::string("{process: timber, legs: {ground: -2 m}}")}) {
    const Design design = parse_design(
        "glissade: 1\ntrack: {start: {x: 0 m, z: 6 m}, finish: {x: 5 m, z: 1 m}}\nbody: {friction_angle: 17 "
        "deg}\n"
        "cross_section: {kind: u-channel, width: 400 mm, wall_height: 250 mm, thickness: 24 mm}\n"
        "fabrication: " +
            fabrication + "\n",
        "d.yaml");
    check_written(design);
  }
}

TEST_CASE("every key is written back") {
  const auto check = [](const std::string& from, const std::string& to, const std::string& and_from = "",
                        const std::string& and_to = "") {
    std::string text = sound_design_with(from, to);
    if (!and_from.empty()) text.replace(text.find(and_from), and_from.size(), and_to);
    check_written(parse_design(text, "d.yaml"));
  };
  check("name: Chute", "name: \"a: \\\"b\\\" #c \u00e4\"");
  check("friction_angle: 17 deg", "friction_coefficient: 0.30573");
  check("friction_angle: 17 deg",
        "friction_angle: 17.123456789 deg\n  entry_speed: 3.7 km/h\n  drag: 0.00123 1/m");
  check("friction_angle: 17 deg", "friction: [{from: 0 m, angle: 3 deg}, {from: 4 m, coefficient: 0.21}]",
        "{kind: fastest}", "{kind: straight}");
  check("friction_angle: 17 deg",
        "friction_angle: {low: 14 deg, nominal: 17 deg}\n  head_wind: 2 m/s\n  drag_area: 0.3 m^2\n  mass: "
        "85 kg\n"
        "  air: {altitude: 1200 m, temperature: -5 degC}\nlimits: {headroom: 1.9 m, stay_above: [{line: [[0 "
        "m, 1 m], "
        "[6 m, 0 m]]}]}");
  check("mesh:", "limits: {clearances_from: centerline}\nmesh:");
  check("friction_angle: 17 deg",
        "kind: rolling\n  rolling_resistance: 0.01\n  radius: 8 mm\n  groove_half_angle: 60 deg\n"
        "  friction_coefficient: 0.3");
  check("{x: 5.4 m, z: 1.1 m}", "{x: 5.4 m, y: 3 ft, z: {lowest: 1 m, highest: 2 m}}");
  check("{x: 5.4 m, z: 1.1 m}", "{x: free, z: 1.1 m}");
  const std::string kSpeed = "\nlimits: {exit_speed: {lowest: 9 m/s}, objective: least_drop}\nbody:";
  check("{x: 5.4 m, z: 1.1 m}\nbody:", "{x: {highest: -1 m}, z: {lowest: 0 m, highest: 2 m}}" + kSpeed);
  const std::string kEnds = "start: {x: 0 m, z: 6.2 m}\n  finish: {x: 5.4 m, z: 1.1 m}\nbody:";
  check(kEnds, "edge: {x: 7 m, z: 1 m}" + kSpeed);
  const std::string kShort = "\nlimits: {exit_speed: {lowest: 9 m/s}, objective: least_length}\nbody:";
  check(kEnds, "edge: {x: 7 m, y: 2 m, z: 1 m}\n  azimuth: 30 deg\n  start: {x: free, z: 4 m}" + kShort);
  check(kEnds, "edge: {x: 7 m, z: 1 m}\n  start: {x: 2 m, y: 1 m, z: free}" + kSpeed);
  check(kEnds, "edge: {x: 7 m, z: 1 m}\n  start: {x: 2 m, z: 3 m}" + kShort);
  check("{kind: fastest}",
        "{kind: points, file: found.csv, columns: [run_m, height_m, slope_angle_deg, curvature_per_m]}");
  check("{kind: fastest}", "{kind: constant-speed, p: 12.3 m^2/s^2}");
  check("mesh:", "gravity: 1 g\nmesh:");
  check("[stl, off, scad]", "{formats: [stl-ascii, csv], unit: m, frame: site}");
  check("{tolerance: 0.5 mm}", "{tolerance: 0.51 mm, largest_kink: 0.25 deg}");
  check("mesh:",
        "limits: {entry_slope_angle: 40 deg, slope_angle: {lowest: -10 deg, highest: 61.7 deg}, "
        "smallest_radius: 2 m, highest_curvature_rate: 0.8 1/m^2, concave: true, highest_normal_load: 2.5 g, "
        "lowest_normal_load: 0.1 g, highest_curvature_load: 1 g, "
        "speed: {lowest: 1 m/s, highest: 36 km/h, lowest_from: 50 cm}, exit_speed: 4 m/s, "
        "arc_length: {highest: 9 m}, lead_in: 0.1 m, lead_out: 200 mm, "
        "half_planes: [{line: [[0 m, 7 m], [1 m, 7 m]], stay: below, clearance: 10 cm}, "
        "{line: [[6 m, 0 m], [6 m, 1 m]], stay: left}], "
        "keep_outs: [{outline: [[2 m, 5 m], [2.4 m, 5 m], [2.4 m, 5.4 m], [2 m, 5.4 m]], pass: below}], "
        "stay_above: [{line: [[0 m, 1 m], [6 m, 0 m]], clearance: 200 mm}], "
        "stay_below: [{line: [[0 m, 8 m], [6 m, 6 m]]}], waypoints: [[2 m, 3 m]], "
        "objective: {kind: blend, exit_speed_weight: 0.1 s/(m/s)}}\nmesh:");
  check("mesh:", "limits: {}\nmesh:");
  const std::string fed = "friction_angle: 17 deg\n  entry_speed: 2 m/s\nstream:";
  check("friction_angle: 17 deg", fed + " {mass_flow: 40 t/h, bulk_density: 780 kg/m^3}");
  check("friction_angle: 17 deg",
        fed +
            " {mass_flow: 11.3 kg/s, bulk_density: {low: 750 kg/m^3, nominal: 0.78 t/m^3, high: 900 kg/m^3}, "
            "lump_size: 6 mm, lateral_pressure_ratio: 0.54, slip_ratio: 0.7, surge: 2, trickle: 20 %, "
            "liner_plate: {thickness: 12 mm, hardness: 4 GPa, wear_coefficient: 2e-4}}");
  const std::string by_name = "entry_speed: 2 m/s\nstream: {mass_flow: 40 t/h, material: ";
  check("friction_angle: 17 deg", by_name + "wheat, liner: mild-steel, moisture: 14 %}");
  check("friction_angle: 17 deg", by_name + "wheat, liner: mild-steel, lateral_pressure_ratio: 0.5}");
  check("friction_angle: 17 deg",
        by_name +
            "own, liner: plate}\nmaterials: [{material: own, name: \"Own\", density: {low: 700 kg/m^3, high: "
            "800 "
            "kg/m^3, source: s}, lateral_pressure_ratio: {value: 0.4, source: s}, friction: [{liner: plate, "
            "angle: {low: 15 deg, high: 18 deg}, moisture: {low: 4 %, high: 9 %}, source: \"t: u\"}], "
            "highest_speed: {value: 8 m/s, why: dust, source: s}, warnings: [\"a: b\"]}]");
  check("friction_angle: 17 deg",
        "friction_angle: 17 deg\nstream: {mass_flow: 40 t/h, bulk_density: 780 kg/m^3}\n"
        "feed: {kind: belt, belt_speed: 3.2 m/s, pulley_radius: 400 mm, belt_angle: 12 deg, drop: 0.8 m}\n"
        "discharge: {belt_speed: 2.5 m/s, drop: 40 cm, direction: 30 deg, belt_angle: 5 deg, belt_friction: "
        "0.6}\n"
        "limits: {match_belt: {speed: 3 m/s, direction: 30 deg, within: 5 %}, highest_burden_depth: 60 mm, "
        "highest_floor_wear: 90 W/m^2, lowest_slope_margin: 5 deg, objective: least_wear}");
  check("friction_angle: 17 deg",
        "friction_angle: 17 deg\nstream: {mass_flow: 40 t/h, bulk_density: 780 kg/m^3}\n"
        "feed: {kind: hopper, outlet_speed: 0.5 m/s, drop: 0.8 m}\n"
        "limits: {objective: least_peak_wear}");
  check(
      "friction_angle: 17 deg",
      "friction_angle: 17 deg\nstream: {mass_flow: 40 t/h, bulk_density: 780 kg/m^3, liner_plate: "
      "{thickness: "
      "6 mm, hardness: 4 GPa, wear_coefficient: 2e-4}}\n"
      "feed: {kind: hopper, outlet_speed: 0.5 m/s, drop: 0.8 m}\n"
      "fabrication: {process: plate, liner: {thickness: 6 mm, where: worn, worn_from: 40 %, life: 20000 h}}");
  check("friction_angle: 17 deg",
        "friction_angle: 17 deg\nstream: {mass_flow: 40 t/h, bulk_density: 780 kg/m^3, liner_plate: "
        "{thickness: "
        "6 mm, hardness: 4 GPa, wear_coefficient: 2e-4}}\n"
        "feed: {kind: hopper, outlet_speed: 0.5 m/s, drop: 0.8 m}\n"
        "fabrication: {process: plate, liner: {thickness: 6 mm, tonnage: 5e6 t}}");
  check("mesh:", "probes: [{from_start: 2 m, name: gate}, {from_finish: 10 cm}, {x: 3.1 m}]\nmesh:");
}

TEST_CASE("a quantity is written as the shortest decimal that reads as the same value") {
  CHECK(written_quantity(0.4, Dimension::length) == "0.4 m");
  CHECK(written_quantity(2.5 * 9.80665, Dimension::acceleration) == "2.5 g");
  CHECK(written_quantity(10.0 / 36.0, Dimension::speed) == "1 km/h");
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (int i = 0; i < 2000; ++i) {
    for (const Dimension dimension : {Dimension::length, Dimension::angle, Dimension::speed,
                                      Dimension::acceleration, Dimension::per_length, Dimension::per_area}) {
      const double value = random.between(-1.0, 1.0) * std::pow(10.0, random.between(-9.0, 9.0));
      const std::string text = written_quantity(value, dimension);
      CAPTURE(text);
      CHECK(parse_quantity(text, dimension, "it") == value);
    }
  }
}

TEST_CASE("a friction is written as what reads as the same bits, up to the roughest that a design may have") {
  constexpr double kRoughest = 1e4;  // theory: the bound of docs/design-file.md
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  const auto design_of = [](const std::string& body) {
    return parse_design(
        "glissade: 1\ntrack: {start: {x: 0 m, z: 2 m}, finish: {x: 0.1 mm, z: 0 m}}\nbody: {" + body + "}\n",
        "steep.yaml");
  };
  for (int i = 0; i < 200; ++i) {
    const double mu = kRoughest * std::pow(10.0, random.between(-6.0, 0.0));
    const double angle = 180.0 / std::numbers::pi * std::atan(mu);
    INFO(mu);
    for (const int digits : {1, 2, 4, 6, 12, 17}) {
      check_written(design_of("friction_coefficient: " + rounded_text(std::min(mu, kRoughest), digits)));
      const double rounded = parse_quantity(rounded_text(angle, digits), Dimension::number, "");
      if (rounded > 89.994) continue;
      check_written(design_of("friction_angle: " + rounded_text(angle, digits) + " deg"));
      check_written(design_of("friction: [{from: 0 m, angle: " + rounded_text(angle, digits) + " deg}]"));
    }
  }
  for (const char* const text :
       {"friction_angle: 86 deg", "friction_angle: 89.994 deg", "friction_coefficient: 10000",
        "friction_angle: {low: 84 deg, nominal: 86 deg, high: 89.99 deg}"})
    check_written(design_of(text));
}

TEST_CASE("a half-plane is written by the points that it was given by") {
  const Design design = parse_design(
      sound_design_with(
          "centerline: {kind: fastest}",
          "centerline: {kind: fastest}\nlimits: {half_planes: [{line: [[0 m, -0.5 m], [10 m, -5.1 m]], "
          "stay: above}]}"),
      "d.yaml");
  CHECK(design_text(design).find("line: [[0 m, -0.5 m], [10 m, -5.1 m]]") != std::string::npos);
  check_written(design);
}

TEST_CASE("widths along the track are written back as they were read") {
  const Design design = parse_design(
      sound_design_with("width: 400 mm", "width: [{at: 0 m, width: 600 mm}, {at: 2 m, width: 400 mm}]"),
      "d.yaml");
  CHECK(design_text(design).find("width: [{at: 0 m, width: 0.6 m}, {at: 2 m, width: 0.4 m}]") !=
        std::string::npos);
  check_written(design);
}

}  // namespace write_test
