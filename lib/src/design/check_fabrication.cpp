#include "glissade/core/number_text.hpp"
#include "glissade/parts/plates.hpp"
#include "glissade/section/cross_section.hpp"

#include "design/checks.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <type_traits>
#include <variant>

namespace glissade {

std::string_view process_word(const FabricationDesign& design) {
  return std::visit([](const auto& process) { return process.kProcess; }, design.process);
}

bool fits(WorkshopFormat format, const FabricationDesign& design) {
  const bool meshes = format == WorkshopFormat::three_mf || format == WorkshopFormat::stl_parts;
  const bool always =
      format == WorkshopFormat::pdf || format == WorkshopFormat::svg || format == WorkshopFormat::tables;
  return always || meshes == std::holds_alternative<PrintOptions>(design.process);
}

bool ExportDesign::asks_for(WorkshopFormat format) const {
  if (whole_workshop || workshop.empty()) return true;
  return std::find(workshop.begin(), workshop.end(), format) != workshop.end();
}

namespace design_file {
namespace {

void positive(double value, const std::string& key, const std::string& text, const char* hint,
              Collected& findings) {
  if (value > 0.0) return;
  report(findings, {"fabrication." + key},
         {"", key.substr(key.rfind('.') + 1) + ": " + text + " is not positive", "", hint});
}

void check_bend(const BendOptions& bend, Collected& findings) {
  if (!(bend.value > 0.0)) {
    report(findings, {"fabrication.bend"},
           {"", "bend: " + rounded_text(bend.value, 6) + " is not positive",
            "It decides how many bends there are.", "{speed_loss: 1 %}"});
  }
  if (bend.k_factor && !(*bend.k_factor >= 0.0 && *bend.k_factor <= 1.0)) {
    report(findings, {"fabrication.bend.k_factor"},
           {"", "k_factor: " + rounded_text(*bend.k_factor, 6) + " lies outside the plate",
            "The neutral fibre is 0 at the inside and 1 at the outside.", "0.33 to 0.5"});
  }
}

/// The options that a problem of one of them may hang on: whether a bar is rolled, and takes its bolts, is a matter of all its
/// measures, and what joins prints of the joint.
std::vector<std::string> with_those_beside(const std::string& key) {
  std::vector<std::string> keys = {key};
  if (key.starts_with("fabrication.flanges.")) {
    for (const char* const other : {"section", "width", "thickness", "bolt", "slotted", "slot"})
      keys.push_back(std::string("fabrication.flanges.") + other);
  }
  if (key == "fabrication.dowels" || key.starts_with("fabrication.tongue"))
    keys.emplace_back("fabrication.joint");
  return keys;
}

void report_all(std::vector<Issue> issues, Collected& findings) {
  for (Issue& issue : issues) {
    const std::string key = (issue.where.starts_with("cross_section.") ? "" : "fabrication.") + issue.where;
    issue.where.clear();
    report(findings, with_those_beside(key), std::move(issue));
  }
}

/// Where a liner is worn, and for how long it lasts, follows from what flows over it.
void check_liner(const Design& design, const LinerOptions& liner, Collected& findings) {
  const bool worn = liner.where == LinerPlaces::worn;
  const bool lasting = liner.life || liner.tonnage;
  if (!design.stream && (worn || lasting)) {
    const char* const key = worn ? "where" : liner.life ? "life" : "tonnage";
    report(findings, {std::string("fabrication.liner.") + key},
           {"", std::string(key) + ": of a body that is no stream",
            "What rubs on the floor follows from a mass flow.",
            "stream: {mass_flow: 650 t/h, bulk_density: 1600 kg/m^3}"});
  } else if (lasting && !design.stream->liner_plate) {
    report(findings, {liner.life ? "fabrication.liner.life" : "fabrication.liner.tonnage"},
           {"", "life of a liner whose wear is not known",
            "Its thickness goes by Archard's law, with a coefficient of yours.",
            "stream: {liner_plate: {thickness: 12 mm, hardness: 4 GPa, wear_coefficient: 2e-4}}"});
  } else if (lasting && design.stream->liner_plate->thickness != liner.thickness) {
    report(findings, {"fabrication.liner.thickness", "stream.liner_plate.thickness"},
           {"",
            "thickness: " + length_text(liner.thickness) + " contradicts the liner_plate's " +
                length_text(design.stream->liner_plate->thickness),
            "They are the same plate.", length_text(design.stream->liner_plate->thickness) + " in both"});
  }
}

void check_process(const Design& design, const PlateOptions& plate, Collected& findings) {
  check_bend(plate.bend, findings);
  if (plate.liner) check_liner(design, *plate.liner, findings);
  if (!plate.hood && !design.hood) {
    report(findings, {"fabrication.hood"},
           {"", "hood: false, of a design without a hood", "It leaves the hood of a transfer a solid alone.",
            "fabrication without hood"});
  }
  report_all(plate_problems(*design.cross_section, plate), findings);
}

void check_process(const Design& design, const PrintOptions& print, Collected& findings) {
  report_all(print_problems(CrossSection(*design.cross_section), print), findings);
}

void check_process(const Design& design, const TimberOptions& timber, Collected& findings) {
  report_all(timber_problems(*design.cross_section, timber), findings);
}

}  // namespace

void check_fabrication(const Design& design, Collected& findings) {
  if (!design.fabrication) return;
  const FabricationDesign& fabrication = *design.fabrication;
  positive(fabrication.arc_tolerance, "arc_tolerance", length_text(fabrication.arc_tolerance),
           "0.1 mm, which suits plates", findings);
  std::visit(
      [&](const auto& process) {
        const double density = process.material.density;
        positive(density, "material.density", rounded_text(density, 6) + " kg/m^3",
                 "7850 kg/m^3, which is steel", findings);
        // Of a section that is no good itself, its own check tells.
        if (sound_cross_section(design)) check_process(design, process, findings);
      },
      fabrication.process);
  if (design.cross_section) return;
  report(findings, {"fabrication"},
         {"", "fabrication: there is no cross_section to make", "",
          "cross_section: {kind: u-channel, width: 400 mm, wall_height: 250 mm, thickness: 4 mm}"});
}

}  // namespace design_file
}  // namespace glissade
