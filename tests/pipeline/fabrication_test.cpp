// From a design with `fabrication` to everything that a workshop gets.

#include "glissade/core/error.hpp"
#include "glissade/drawing/workshop_drawings.hpp"
#include "glissade/io/dxf_file.hpp"
#include "glissade/io/mesh_file.hpp"
#include "glissade/io/step_file.hpp"
#include "glissade/io/three_mf_file.hpp"
#include "glissade/pipeline.hpp"
#include "glissade/pipeline/json.hpp"
#include "glissade/solid/mesh_facts.hpp"

#include "support/catch.hpp"
#include "support/paths.hpp"
#include "support/temp_dir.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace fabrication_test {

namespace {

using namespace glissade;

/// A design with plates alone, and a mesh that is soon made.
Design quick(const std::string& fabrication = "{process: plate}") {
  return parse_design(
      "glissade: 1\n"
      "track: {start: {x: 2 m, z: 6.2 m}, finish: {x: 7.4 m, z: 1.1 m}}\n"
      "body: {friction_angle: 17 deg}\n"
      "cross_section: {kind: u-channel, width: 400 mm, wall_height: 250 mm, thickness: 4 mm}\n"
      "fabrication: " +
          fabrication + "\nmesh: {tolerance: 2 mm}\nexport: [off]\n",
      "chute.yaml");
}

/// The rows of a setting-out table whose words begin like this, each held against the chord between the joints about it.
/// @return how many
std::size_t ordinates_from_their_chords(const Workshop& workshop, const std::string& kind) {
  std::vector<const SettingOutPoint*> joints;
  for (const SettingOutPoint& row : workshop.setting_out) {
    if (row.what == "start" || row.what == "finish" || row.what.starts_with("joint ")) joints.push_back(&row);
  }
  std::size_t count = 0;
  for (const SettingOutPoint& row : workshop.setting_out) {
    if (!row.what.starts_with(kind)) continue;
    std::size_t next = 1;
    while (next + 1 < joints.size() && joints[next]->arc_length <= row.arc_length) ++next;
    const Vec2 from{joints[next - 1]->x, joints[next - 1]->z};
    const Vec2 chord = Vec2{joints[next]->x, joints[next]->z} - from;
    INFO(row.what << " at " << row.arc_length << " m");
    CHECK(row.ordinate == Approx(cross(chord, Vec2{row.x, row.z} - from) / norm(chord)).margin(1e-9));
    ++count;
  }
  return count;
}

std::string refusal(const std::string& fabrication) {
  try {
    const Design design = quick(fabrication);
    (void)assemble(design, solve(design));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("fabrication: the process alone gives every file, each of its part, and JSON that tells of them") {
  const TempDir place;
  const Design design = quick();
  const Build built = build(design, place / "out", {}, {.report = false});
  REQUIRE(built.fabrication);
  const nlohmann::json json = nlohmann::json::parse(build_json(design, built));
  const Workshop& workshop = built.fabrication->workshop;
  REQUIRE(json["parts"].size() == workshop.parts.size());
  CHECK(json["master_curve"]["arcs"] == 12);
  CHECK(json["master_curve"]["lower_bound"] == 11);
  CHECK(json["master_curve"]["max_deviation_m"] <= json["master_curve"]["tolerance_m"]);
  double volume = 0.0;
  for (std::size_t i = 0; i < workshop.parts.size(); ++i) {
    const nlohmann::json& part = json["parts"][i];
    CHECK(part["number"] == static_cast<int>(i) + 1);
    CHECK(std::fabs(part["mass_kg"].get<double>() - 7850.0 * part["volume_m3"].get<double>()) < 1e-9);
    volume += part["volume_m3"].get<double>() * part["quantity"].get<double>();
    REQUIRE(part["files"].size() == 2);
    const Drawing drawing = read_dxf(place / "out" / part["files"][0].get<std::string>());
    CHECK(drawing.circles.size() == workshop.parts[i].pattern->region.holes.size());
    const StepFacts step = read_step_facts(place / "out" / part["files"][1].get<std::string>());
    REQUIRE(step.solids.size() == 1);
    CHECK(step.solids.front().closed);
  }
  CHECK(std::fabs(json["parts_volume_m3"].get<double>() / volume - 1.0) < 1e-12);
  CHECK(json["as_built"]["travel_time_s"].get<double>() ==
        Approx(built.track.motion.travel_time()).epsilon(1e-3));
  for (const nlohmann::json& check : json["shop_checks"]) {
    CHECK(check["verdict"] == "pass");
    CHECK_FALSE(check["source"].get<std::string>().empty());
  }
  const StepFacts assembly = read_step_facts(place / "out" / "chute.step");
  CHECK(assembly.solids.size() == workshop.parts.size());
  // The volume of the channel along the arcs is that of the solid along the track, to the tolerance of the arcs.
  const double solid = json["mesh"]["volume_m3"];
  CHECK(std::fabs(json["channel_volume_m3"].get<double>() / solid - 1.0) < 1e-3);
}

TEST_CASE(
    "fabrication: what is not as asked for is told by warnings, JSON and the report alike, with its place") {
  const TempDir place;
  const Design design =
      quick("{process: plate, supports: {ground: 0 m, spacing: 1 m}, lifting: {hole: 22 mm}}");
  const Build built = build(design, place / "out");
  REQUIRE(built.fabrication);
  const Workshop& workshop = built.fabrication->workshop;
  REQUIRE_FALSE(workshop.shortfalls.empty());
  REQUIRE_FALSE(workshop.notes.empty());
  const Issue& end = workshop.shortfalls.front();
  CHECK(end.where.starts_with("chute.yaml:5:"));
  CHECK(end.what.starts_with("spacing: the track sticks out by "));
  CHECK(end.what.find(", for 500 mm, half of 1 m") != std::string::npos);
  CHECK(end.why.find("a trestle stands below no more than 60 deg (steepest).") != std::string::npos);
  CHECK(end.hint.starts_with("spacing: "));
  const std::vector<Issue> told = warnings(design, built.track, built.fabrication.get());
  const std::vector<Issue> of_track = warnings(design, built.track);
  REQUIRE(told.size() == of_track.size() + workshop.shortfalls.size());
  CHECK(std::equal(workshop.shortfalls.begin(), workshop.shortfalls.end(),
                   told.end() - static_cast<std::ptrdiff_t>(workshop.shortfalls.size())));
  CHECK(warnings(design, built.track, nullptr) == of_track);

  // In the order of the keys, as the report has them.
  using Json = nlohmann::ordered_json;
  const Json json = Json::parse(build_json(design, built));
  REQUIRE(json["shortfalls"].size() == workshop.shortfalls.size());
  CHECK(json["shortfalls"][0]["where"] == end.where);
  CHECK(json["shortfalls"][0]["what"] == end.what);
  CHECK(json["shortfalls"][0]["why"] == end.why);
  CHECK(json["shortfalls"][0]["hint"] == end.hint);
  CHECK(json["notes"] == Json(workshop.notes));
  REQUIRE(json["warnings"].size() == told.size());
  CHECK(json["warnings"].back() == json["shortfalls"].back());
  const Json rules = Json::parse(verdicts_json(design, built.track, {}, built.fabrication.get()));
  CHECK(rules["warnings"] == json["warnings"]);

  std::ifstream page(place / "out/chute.report.html");
  const std::string report{std::istreambuf_iterator<char>(page), {}};
  CHECK(report.find("\"warnings\":" + json["warnings"].dump()) != std::string::npos);
  CHECK(report.find("\"shortfalls\":" + json["shortfalls"].dump()) != std::string::npos);
}

TEST_CASE("fabrication: a body that does not arrive on the floor as it is made is warned of") {
  // Next to no friction more stops it; three bends take more than that.
  const Design design = parse_design(
      "glissade: 1\n"
      "track: {start: {x: 0 m, z: 3 m}, finish: {x: 4 m, z: 1.8 m}}\n"
      "body: {friction_angle: 16.5 deg}\n"
      "cross_section: {kind: u-channel, width: 200 mm, wall_height: 60 mm, thickness: 3 mm}\n"
      "fabrication: {process: plate, floor: bent, bend: {bends: 3}, flanges: none}\n"
      "mesh: {tolerance: 3 mm}\nexport: [off]\n",
      "slow.yaml");
  const Assembly assembly = assemble(design, solve(design), {}, {.report = false});
  REQUIRE_FALSE(assembly.fabrication->ride.arrives);
  const std::vector<Issue> told = warnings(design, assembly.track, assembly.fabrication.get());
  REQUIRE_FALSE(told.empty());
  CHECK(told.back().where == "slow.yaml:5:1");
  CHECK(told.back().what.starts_with("the body does not arrive on the floor as it is built: it stalls "));
  CHECK(told.back().hint.starts_with("a limit lowest_normal_load above 0"));
}

TEST_CASE("fabrication: frames that leave much of their sheets are noted, those in pieces are not") {
  const auto noted = [](const std::string& split) {
    const Design design = parse_design(
        "glissade: 1\n"
        "track: {start: {x: 2 m, z: 6.2 m}, finish: {x: 7.4 m, z: 1.1 m}}\n"
        "body: {friction_angle: 17 deg}\n"
        "cross_section: {kind: u-channel, width: 2 m, wall_height: 600 mm, thickness: 4 mm}\n"
        "fabrication: {process: plate, split: " +
            split + "}\nmesh: {tolerance: 2 mm}\nexport: [off]\n",
        "wide.yaml");
    const Assembly assembly = assemble(design, solve(design), {}, {.report = false});
    std::vector<std::string> found;
    for (const std::string& note : assembly.fabrication->workshop.notes) {
      if (note.find("split: {frames: 3}") != std::string::npos) found.push_back(note);
    }
    return found;
  };
  const std::vector<std::string> whole = noted("{longest: 1.4 m}");
  REQUIRE(whole.size() == 1);
  CHECK(whole.front().find(" sheets of S235, 6 mm, are ") != std::string::npos);
  CHECK(whole.front().ends_with(" % used: less would be left over of frames in pieces, split: {frames: 3}."));
  CHECK(noted("{longest: 1.4 m, frames: 3}").empty());
}

TEST_CASE("fabrication: what is set out lies in the frame of the site, parts in that of the mesh files") {
  const Design design = quick("{process: plate, flanges: none}");
  const Assembly assembly = assemble(design, solve(design), {}, {.report = false});
  const Workshop& workshop = assembly.fabrication->workshop;
  const SettingOutPoint& start = workshop.setting_out.front();
  const SettingOutPoint& finish = workshop.setting_out.back();
  CHECK(start.what == "start");
  CHECK(norm(start.site - Vec3{2.0, 0.0, 6.2}) < 1e-12);
  CHECK(norm(finish.site - Vec3{7.4, 0.0, 1.1}) < 1e-9);
  CHECK(workshop.parts.front().centre_of_gravity.z < 0.0);
  CHECK(workshop.items.empty());
}

TEST_CASE("fabrication: every ordinate that is set out is that from the chord of its own unit") {
  const auto workshop_of = [](const Design& design) {
    return assemble(design, solve(design), {}, {.report = false}).fabrication->workshop;
  };
  const Workshop channel =
      workshop_of(quick("{process: plate, split: {longest: 2 m}, supports: {ground: 0 m, spacing: 1.5 m}}"));
  CHECK(ordinates_from_their_chords(channel, "station") > 10);
  CHECK(ordinates_from_their_chords(channel, "support") > 3);
  const Design pipe = parse_design(
      "glissade: 1\n"
      "track: {start: {x: 0 m, z: 4 m}, finish: {x: 4 m, z: 0 m}}\n"
      "body: {friction_angle: 17 deg, entry_speed: 2 m/s}\n"
      "cross_section: {kind: pipe, inner_diameter: 200 mm, thickness: 2 mm}\n"
      "fabrication: {process: plate, round: mitred, split: {longest: 2 m}}\n"
      "mesh: {tolerance: 2 mm}\nexport: [off]\n",
      "pipe.yaml");
  CHECK(ordinates_from_their_chords(workshop_of(pipe), "mitre") > 3);
  const Workshop printed = workshop_of(read_design(designs_path("marble_run_printed.yaml")));
  CHECK(ordinates_from_their_chords(printed, "stand ") > 3);
}

TEST_CASE("fabrication: the general arrangement names every joint and support of every shipped design") {
  std::size_t places = 0;
  for (const char* const name :
       {"coal_chute_fabricated", "grain_chute_fabricated", "grain_chute_with_limits_bent",
        "marble_run_printed", "ore_transfer_fabricated", "powder_chute_mitred", "sand_ski_ramp_in_timber",
        "ski_jump_inrun_in_timber"}) {
    CAPTURE(name);
    const Design design = read_design(designs_path(std::string(name) + ".yaml"));
    const Workshop workshop = assemble(design, solve(design), {}, {.report = false}).fabrication->workshop;
    std::set<std::string> told;
    for (const DrawnText& text : drawing_set(workshop).front().views.front().drawing.texts)
      told.insert(text.text);
    for (const SettingOutPoint& point : workshop.setting_out) {
      const std::string what = point.what.substr(0, point.what.find_first_of(",:"));
      if (!what.starts_with("joint") && !what.starts_with("support")) continue;
      CAPTURE(point.what);
      CHECK(told.contains(what));
      ++places;
    }
  }
  CHECK(places > 20);
}

TEST_CASE("fabrication: every piece that is cut lies on one sheet of its thickness, holes and all") {
  const TempDir place;
  const Build built = build(quick(), place / "out", {}, {.report = false});
  std::size_t cut = 0;
  std::size_t holes = 0;
  for (const WrittenFile& file : built.files) {
    if (file.path.parent_path().filename() != "chute.nests") continue;
    CHECK(file.path.filename().string().find("nest_S235_") == 0);
    const Drawing drawing = read_dxf(file.path);
    holes += drawing.circles.size();
    for (const DrawnPath& drawn : drawing.paths) {
      cut += drawn.path.closed && drawing.layers[drawn.layer].name == "CUT" ? 1 : 0;
    }
  }
  std::size_t contours = 0;
  std::size_t circles = 0;
  for (const ShopPart& part : built.fabrication->workshop.parts) {
    contours += part.quantity() * (1 + part.pattern->region.cutouts.size());
    circles += part.quantity() * part.pattern->region.holes.size();
  }
  CHECK(cut == contours);
  CHECK(holes == circles);
  CHECK(std::filesystem::exists(place / "out" / "chute.nests.csv"));
}

TEST_CASE(
    "fabrication: sheets keep the margin and spacing that are asked for, and --json tells what is used of "
    "each") {
  const TempDir place;
  Design design = quick("{process: plate, split: {sheet: [2.2 m, 1.1 m], margin: 40 mm, spacing: 25 mm}}");
  design.exports.layers = LayerPreset::sendcutsend;
  const Build built = build(design, place / "out", {}, {.report = false});
  const nlohmann::json json = nlohmann::json::parse(build_json(design, built));
  REQUIRE(json["nests"].size() == built.fabrication->nests.size());
  REQUIRE(json["nests"].size() > 1);
  std::size_t pieces = 0;
  double area = 0.0;
  for (std::size_t i = 0; i < json["nests"].size(); ++i) {
    const nlohmann::json& sheet = json["nests"][i];
    CHECK(sheet["margin_m"] == 0.04);
    CHECK(sheet["spacing_m"] == 0.025);
    CHECK(sheet["sheet_m"] == nlohmann::json({2.2, 1.1}));
    CHECK(sheet["utilisation"].get<double>() * 2.2 * 1.1 == Approx(sheet["parts_area_m2"].get<double>()));
    pieces += sheet["pieces"].get<std::size_t>();
    area += sheet["parts_area_m2"].get<double>();
    const Drawing drawing = read_dxf(place / "out" / sheet["file"].get<std::string>());
    const PlaneBox box = bounds(drawing).value();
    CHECK(box.low.x >= 40.0 - 1e-6);
    CHECK(box.low.y >= 40.0 - 1e-6);
    CHECK(box.high.x <= 2160.0 + 1e-6);
    CHECK(box.high.y <= 1060.0 + 1e-6);
    for (const DrawingLayer& layer : drawing.layers) CHECK(layer.name == "0");
  }
  std::size_t ordered = 0;
  double expected = 0.0;
  for (const ShopPart& part : built.fabrication->workshop.parts) {
    if (!part.pattern || part.bought_in) continue;
    ordered += part.quantity();
    expected += static_cast<double>(part.quantity()) * moments(part.pattern->region).area;
  }
  CHECK(pieces == ordered);
  CHECK(area == Approx(expected).epsilon(1e-12));
}

TEST_CASE("fabrication: margins and spacings that leave nothing of a sheet are refused where they stand") {
  using Catch::Matchers::Contains;
  CHECK_THAT(refusal("{process: plate, split: {margin: 0.75 m}}"),
             Contains("margin: 750 mm leaves nothing of a sheet that is 1.5 m wide") &&
                 Contains("less than 750 mm"));
  CHECK_THAT(refusal("{process: plate, split: {spacing: 1.5 m, margin: -1 mm}}"),
             Contains("spacing: 1.5 m is no less than the width of the sheet") &&
                 Contains("margin: -1 mm is negative"));
  CHECK_THAT(refusal("{process: plate, margin: 5 mm}"), Contains("split: {margin: 5 mm}"));
}

TEST_CASE(
    "fabrication: a print gives its pieces as one 3MF file, each whole, and meshes of single pieces on "
    "request") {
  const TempDir place;
  Design design = read_design(designs_path("marble_run_printed.yaml"));
  design.exports.formats = {ExportFormat::off};
  const Build built = build(design, place / "out", {}, {.report = false});
  REQUIRE(built.fabrication);
  const nlohmann::json json = nlohmann::json::parse(build_json(design, built));
  std::size_t pieces = 0;
  for (const nlohmann::json& part : json["parts"]) {
    pieces += part["quantity"].get<std::size_t>();
    REQUIRE(part["files"].size() == 2);
    CHECK(part["files"][0] == "marble_run_printed.3mf");
    const TriangleMesh single =
        read_mesh(place / "out" / part["files"][1].get<std::string>(), LengthUnit::millimetre);
    CHECK(measure(single).valid());
    CHECK(measure(single).volume == Approx(part["volume_m3"].get<double>()).epsilon(5e-3));
  }
  const std::vector<PrintPiece> read = read_three_mf(place / "out" / "marble_run_printed.3mf");
  REQUIRE(read.size() == pieces);
  const auto stands = std::count_if(read.begin(), read.end(),
                                    [](const PrintPiece& piece) { return piece.name.starts_with("stand"); });
  CHECK(stands == 9);  // six stands, one of them in two blocks with two pins
  CHECK(pieces == 3 + 4 + 9);
  for (const PrintPiece& piece : read) {
    INFO(piece.name);
    CHECK(measure(piece.mesh).valid());  // at the precision of the file
  }
  CHECK(json["as_built"]["joints"] == 2);
  CHECK_FALSE(std::filesystem::exists(place / "out" / "marble_run_printed.step"));
}

TEST_CASE(
    "fabrication: a timber ramp gives patterns, STEP, templates and a setting-out table with the levels of "
    "its edges") {
  const TempDir place;
  Design design = read_design(designs_path("sand_ski_ramp_in_timber.yaml"));
  design.exports.formats = {ExportFormat::off};
  const Build built = build(design, place / "out", {}, {.report = false});
  REQUIRE(built.fabrication);
  const Workshop& workshop = built.fabrication->workshop;
  for (const ShopPart& part : workshop.parts) {
    INFO(part.name);
    CHECK(part.files.size() == (part.pattern ? 2 : 1));
    for (const std::string& file : part.files) CHECK(std::filesystem::exists(place / "out" / file));
  }
  const StepFacts assembly = read_step_facts(place / "out" / "sand_ski_ramp_in_timber.step");
  std::size_t pieces = 0;
  for (const ShopPart& part : workshop.parts) pieces += part.quantity();
  CHECK(assembly.solids.size() == workshop.parts.size());
  CHECK(pieces > 300);
  std::ifstream table(place / "out" / "sand_ski_ramp_in_timber.setting_out.csv");
  std::string head;
  std::getline(table, head);
  CHECK(head.ends_with("underside_of_deck_plumb_mm,top_of_ribs_plumb_mm,underside_of_ribs_plumb_mm"));
}

TEST_CASE(
    "fabrication: a half-pipe in timber gives every file of a ramp, its strips and templates among them") {
  const TempDir place;
  Design design = parse_design(
      "glissade: 1\nname: Start\ntrack: {start: {x: 0 m, z: 2 m}, finish: {x: 5 m, z: 0 m}}\n"
      "body: {friction_coefficient: 0.06, entry_speed: 1 m/s}\ncenterline: {kind: fastest}\n"
      "limits: {slope_angle: {highest: 35 deg, lowest: 0 deg}, smallest_radius: 4 m}\n"
      "cross_section: {kind: half-pipe, width: 0.9 m, wall_height: 100 mm, thickness: 18 mm}\n"
      "fabrication: {process: timber, deck: {stave_tolerance: 8 mm}, legs: {ground: -1.5 m}}\n",
      "start.yaml");
  design.exports.formats = {ExportFormat::off};
  const Build built = build(design, place / "out", {}, {.report = false});
  REQUIRE(built.fabrication);
  const Workshop& workshop = built.fabrication->workshop;
  double strips = 0.0;
  for (const ShopPart& part : workshop.parts) {
    INFO(part.name);
    REQUIRE(part.files.size() == 2);
    for (const std::string& file : part.files) CHECK(std::filesystem::exists(place / "out" / file));
    if (part.name.starts_with("stave") || part.name.starts_with("floor"))
      strips += part.volume * static_cast<double>(part.quantity());
  }
  CHECK(strips == Approx(built.fabrication->proof.exact_volume).epsilon(1e-9));
  CHECK(read_step_facts(place / "out" / "start.step").solids.size() == workshop.parts.size());
  for (const char* ending : {".drawings.pdf", ".templates.pdf", ".cut_list.csv", ".setting_out.csv"})
    CHECK(std::filesystem::exists(place / "out" / (std::string("start") + ending)));
}

TEST_CASE("fabrication: the same design gives the same bytes") {
  const TempDir place;
  const Design design = quick("{process: plate, floor: bent, split: {longest: 2 m}}");
  const Build first = build(design, place / "a", {}, {.report = false});
  const Build second = build(design, place / "b", {}, {.report = false});
  REQUIRE(first.files.size() == second.files.size());
  for (std::size_t i = 0; i < first.files.size(); ++i) {
    CHECK(bytes_of(first.files[i].path) == bytes_of(second.files[i].path));
  }
  CHECK(first.fabrication->ride.bends > 20);
  CHECK(1.0 - first.fabrication->ride.exit_speed / first.track.motion.exit_speed() <= 0.0105);
}

TEST_CASE("fabrication: export names the files of the parts, and what kind of DXF they are") {
  const TempDir place;
  const auto files_of = [&](const std::string& exports) {
    const Design design = parse_design(
        "glissade: 1\n"
        "track: {start: {x: 0 m, z: 5.1 m}, finish: {x: 5.4 m, z: 0 m}}\n"
        "body: {friction_angle: 17 deg}\n"
        "cross_section: {kind: u-channel, width: 400 mm, wall_height: 250 mm, thickness: 4 mm}\n"
        "fabrication: {process: plate}\nmesh: {tolerance: 2 mm}\nexport: " +
            exports + "\n",
        "chute.yaml");
    std::vector<std::string> names;
    const Build built = build(design, place / "out", {}, {.report = false});
    for (const WrittenFile& file : built.files) names.push_back(file.path.extension().string());
    std::sort(names.begin(), names.end());
    names.erase(std::unique(names.begin(), names.end()), names.end());
    return names;
  };
  CHECK(files_of("[off, dxf]") == std::vector<std::string>{".dxf", ".off"});
  CHECK(files_of("[step]") == std::vector<std::string>{".step"});
  CHECK(files_of("[off, workshop]") == std::vector<std::string>{".csv", ".dxf", ".off", ".pdf", ".step"});
  CHECK(files_of("{formats: [svg, templates], paper: a3}") == std::vector<std::string>{".pdf", ".svg"});
  CHECK(files_of("{formats: [dxf], dxf_version: r12, layers: plain}") == std::vector<std::string>{".dxf"});
  for (const auto& entry : std::filesystem::directory_iterator(place / "out" / "chute.parts")) {
    const std::string text = bytes_of(entry.path());
    CHECK(text.find("AC1009") != std::string::npos);
    CHECK(text.find("LWPOLYLINE") == std::string::npos);
    CHECK(text.find("CUT") == std::string::npos);
  }
}

TEST_CASE("fabrication: words of export that nothing makes are refused at their place") {
  const auto message = [](const std::string& fabrication, const std::string& exports) {
    try {
      (void)parse_design(
          "glissade: 1\n"
          "track: {start: {x: 0 m, z: 5.1 m}, finish: {x: 5.4 m, z: 0 m}}\n"
          "body: {friction_angle: 17 deg}\n"
          "cross_section: {kind: u-channel, width: 400 mm, wall_height: 250 mm, thickness: 4 mm}\n" +
              fabrication + "export: " + exports + "\n",
          "chute.yaml");
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  CHECK(message("", "[dxf]").find("export: dxf is of parts, and nothing makes any") != std::string::npos);
  CHECK(message("", "workshop").find("fabrication: {process: plate}") != std::string::npos);
  CHECK(message("fabrication: {process: plate}\n", "[3mf]").find("export: 3mf does not fit process: plate") !=
        std::string::npos);
  CHECK(message("fabrication: {process: plate}\n", "[dxf, dxf]").find("dxf is named twice") !=
        std::string::npos);
}

TEST_CASE("fabrication: every group that is left out by default is left out by the word none") {
  for (const char* const key :
       {"flanges", "rim", "stiffeners", "liner", "cover", "inspection", "lifting", "supports"}) {
    INFO(key);
    CHECK(refusal("{process: plate, " + std::string(key) + ": none}").empty());
  }
  CHECK(refusal("{process: plate, inspection: nothing}").find("inspection") != std::string::npos);
}

TEST_CASE(
    "fabrication: a ground line is read as those of limits, and one above the track is told at its place") {
  CHECK(refusal("{process: plate, supports: {ground: 5 m}}").find("chute.yaml:5:") != std::string::npos);
  CHECK(refusal("{process: plate, supports: {ground: 5 m}}").find("above the underside of the track") !=
        std::string::npos);
  CHECK(refusal("{process: plate, supports: {ground: [[2 m, 0 m], [7.4 m, 0.5 m]]}}").empty());
  CHECK(refusal("{process: plate, supports: {}}").find("ground") != std::string::npos);
}

TEST_CASE("fabrication: what a shop makes by its own rules is not refused, and what it does not make is") {
  const auto with_rule = [](const std::string& options, const std::string& rule) {
    return refusal("{process: plate, " + options + ", rules: {own: [{id: " + rule +
                   ", sentence: So does our shop., source: our shop}]}}");
  };
  const std::string close = "flanges: {pitch: 28 mm}";
  CHECK(refusal("{process: plate, " + close + "}")
            .find("holes of 12 mm are at least 28.8 mm apart (EN 1993-1-8).") != std::string::npos);
  // Ten gaps of 26.15 mm beside the walls.
  CHECK(with_rule(close, "plate.hole-pitch, quantity: hole_pitch_diameters, lowest: 2.17").empty());
  CHECK(with_rule(close, "plate.hole-pitch, quantity: hole_pitch_diameters, lowest: 2.19")
            .find("pitch: holes of 12 mm stand 26.1 mm apart at a pitch of 28 mm") != std::string::npos);
  CHECK(with_rule(close, "plate.hole-pitch, quantity: hole_pitch_diameters, lowest: 2.5")
            .find("holes of 12 mm are at least 30 mm apart (the rules of this shop).") != std::string::npos);
  CHECK(refusal("{process: plate, " + close + ", rules: {leave_out: [plate.hole-pitch]}}").empty());
  const std::string sharp = "floor: bent, bend: {bends: 10, inner_radius: 3 mm}";
  CHECK(refusal("{process: plate, " + sharp + "}").find("Mild steel cracks below 4 mm (1 thickness).") !=
        std::string::npos);
  CHECK(with_rule(sharp, "plate.bend-radius, quantity: bend_radius_thicknesses, lowest: 0.5").empty());
  CHECK(with_rule("floor: bent, bend: {bends: 10}",
                  "plate.bend-radius, quantity: bend_radius_thicknesses, lowest: 2")
            .find("Its rules ask for 8 mm (2 thicknesses of the plate) or more.") != std::string::npos);
}

TEST_CASE("fabrication: bent floors keep to the least flat of the shop") {
  const auto shortest = [](const std::string& rules) {
    const Design design = quick("{process: plate, floor: bent, bend: {bends: 400}" + rules + "}");
    const auto build = assemble(design, solve(design)).fabrication;
    double least = 1e300;
    for (const ShopMeasurement& measured : build->workshop.measured) {
      if (measured.quantity == "flat") least = std::min(least, measured.value);
    }
    return least;
  };
  const auto own = [](const std::string& bound) {
    return ", rules: {own: [{id: plate.flat, sentence: So does our press., quantity: flat, lowest: " + bound +
           ", source: our press}]}";
  };
  const double usual = shortest("");
  CHECK(usual < 30e-3);
  CHECK(shortest(own("8 mm")) < usual);
  CHECK(shortest(own("60 mm")) > 1.5 * usual);  // places of touch are 60 mm apart, flats about that
}

TEST_CASE("fabrication: what cannot be made is refused at its place in the file") {
  CHECK(refusal("{process: plate, flanges: {pitch: 20 mm}}")
            .find("chute.yaml:5:48: pitch: 20 mm is too close for M10") != std::string::npos);
  CHECK(refusal("{process: plate, split: {allowed: false}}")
            .find("chute.yaml:5:31: the floor of unit 1 takes 7.7") != std::string::npos);
  for (const std::string bolt : {"10", "M11", "m10"}) {
    const std::string message = refusal("{process: plate, flanges: {bolt: " + bolt + "}}");
    CHECK(message.find("chute.yaml:5:47: bolt: " + bolt + " is not known") != std::string::npos);
    CHECK(message.find("It is one of M5, M6, M8, M10, M12, M16, M20 or M24.") != std::string::npos);
  }
  CHECK(refusal("{process: plate, bend: {bends: 10, segment_length: 1 m}}").find("more than one rule") !=
        std::string::npos);
  CHECK(refusal("{process: casting}").find("plate") != std::string::npos);
  CHECK(refusal("{process: print, split: {bed: [20 mm, 20 mm, 20 mm], gap: 0 mm}}")
            .find("chute.yaml:5:39: bed: 20 mm x 20 mm x 20 mm is too small for the section of") !=
        std::string::npos);
  CHECK(refusal("{process: print, split: {bed: [20 mm, 20 mm]}}").find("bed: 2 lengths") !=
        std::string::npos);
  CHECK(refusal("{process: timber, deck: {layers: 2.5}}").find("layers: 2.5 is no whole number") !=
        std::string::npos);
  CHECK(refusal("{process: timber, deck: {layers: 40}}").find("chute.yaml:5:47: layers: 40 layers") !=
        std::string::npos);
  CHECK(refusal("{}").find("process") != std::string::npos);
}

}  // namespace fabrication_test
