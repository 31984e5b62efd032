// What rules of the shop (lib/data/rules/shop-plate.yaml) may bound of tabs and slots.

#include "glissade/core/number_text.hpp"

#include "parts/plates/corners.hpp"
#include "parts/plates/plate_facts.hpp"
#include "parts/shop/shop_facts.hpp"

#include <algorithm>
#include <limits>
#include <string>

namespace glissade::parts {
namespace {

/// The least web between a slot and what else its plate ends at.
double least_web(const PlaneRegion& region) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < region.cutouts.size(); ++i) {
    least = std::min(least, distance(region.cutouts[i], region.outline));
    for (std::size_t k = 0; k < i; ++k)
      least = std::min(least, distance(region.cutouts[i], region.cutouts[k]));
    for (const Circle& hole : region.holes)
      least = std::min(least, distance(region.cutouts[i], path_of(hole)));
  }
  return least;
}

}  // namespace

void measure_slots(Workshop& workshop) {
  ShopFacts facts(workshop);
  for (const ShopPart& part : workshop.parts) {
    if (!part.pattern || part.pattern->region.cutouts.empty()) continue;
    facts.of(part, "web_thicknesses", least_web(part.pattern->region), part.thickness);
  }
}

void measure_corners(const Job& job, const std::vector<Unit>& units, Workshop& workshop) {
  if (!has_tabs(job)) return;
  const bool beside = job.options.walls == WallSeat::beside_floor;
  const double tabbed = beside ? job.channel.thickness : job.channel.wall();
  ShopFacts facts(workshop);
  for (const Unit& unit : units) {
    const std::string where = (beside ? unit.floor.name : unit.wall->name) + " at " +
                              length_text(unit.span.from, 3) + " along the track";
    for (std::size_t i = 0; i < unit.tabs.size(); ++i) {
      const double width = unit.tabs[i].to - unit.tabs[i].from;
      facts.at(where, "tab_width", width);
      facts.at(where, "tab_thicknesses", width, tabbed);
      if (i > 0) facts.at(where, "tab_gap", unit.tabs[i].from - unit.tabs[i - 1].to);
    }
  }
  measure_slots(workshop);
  facts.at("every slot", "slot_clearance", job.options.corners.clearance);
}

}  // namespace glissade::parts
