#include "glissade/core/number_text.hpp"

#include "design/checks.hpp"

#include <cmath>
#include <string>
#include <type_traits>
#include <variant>

namespace glissade {

std::optional<ChannelMeasures> channel_of(const section::Measures& measures) {
  if (const auto* const channel = std::get_if<section::UChannel>(&measures)) {
    if (!channel->width.is_constant()) return std::nullopt;
    return ChannelMeasures{channel->width.narrowest(), channel->wall_height, channel->thickness};
  }
  if (const auto* const slab = std::get_if<section::Slab>(&measures)) {
    if (!slab->width.is_constant() || slab->curb_height != 0.0) return std::nullopt;
    return ChannelMeasures{slab->width.narrowest(), 0.0, slab->thickness};
  }
  return std::nullopt;
}

namespace design_file {
namespace {

void check_numbers(const FabricationDesign& fabrication, Collected& findings) {
  const auto positive = [&](double value, const std::string& key, const std::string& text, const char* hint) {
    if (value > 0.0) return;
    report(findings, {"fabrication." + key},
           {"", key.substr(key.rfind('.') + 1) + ": " + text + " is not positive", "", hint});
  };
  positive(fabrication.arc_tolerance, "arc_tolerance", length_text(fabrication.arc_tolerance),
           "0.1 mm, which suits plates");
  const double density = fabrication.plate.material.density;
  positive(density, "material.density", rounded_text(density, 6) + " kg/m^3", "7850 kg/m^3, which is steel");
  const BendOptions& bend = fabrication.plate.bend;
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

}  // namespace

void check_fabrication(const Design& design, Collected& findings) {
  if (!design.fabrication) return;
  check_numbers(*design.fabrication, findings);
  if (!design.cross_section) {
    report(findings, {"fabrication"},
           {"", "fabrication: there is no cross_section to make", "",
            "cross_section: {kind: u-channel, width: 400 mm, wall_height: 250 mm, thickness: 4 mm}"});
    return;
  }
  const auto channel = channel_of(*design.cross_section);
  if (!channel) {
    const std::string kind(std::visit(
        [](const auto& measures) { return std::decay_t<decltype(measures)>::kKind; }, *design.cross_section));
    report(findings, {"cross_section.kind", "fabrication"},
           {"", "fabrication: this " + kind + " cannot be made of plates yet",
            "Plates are made of a flat floor of one width and upright walls.",
            "kind: u-channel with one width, or a slab without curbs"});
    return;
  }
  for (Issue& issue : plate_problems(*channel, design.fabrication->plate)) {
    const std::string key =
        (issue.where == "width" || issue.where == "thickness" ? "cross_section." : "fabrication.") +
        issue.where;
    issue.where.clear();
    // Of a cross-section that is no good itself, its own check tells.
    if (!key.starts_with("cross_section.")) report(findings, {key}, std::move(issue));
  }
}

}  // namespace design_file
}  // namespace glissade
