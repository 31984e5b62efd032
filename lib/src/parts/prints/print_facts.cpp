// What rules of the shop (lib/data/rules/shop-print.yaml) may bound of prints.

#include "parts/prints/print_facts.hpp"

#include "parts/prints/tongue.hpp"
#include "parts/shop/shop_facts.hpp"

#include <algorithm>
#include <cstddef>
#include <string>

namespace glissade::parts {
namespace {

std::string where_of(std::size_t index) {
  return "segment " + std::to_string(index + 1);
}

void measure_size(const PrintJob& job, const PrintUnit& unit, const std::string& where, ShopFacts& facts) {
  const PrintBed& bed = job.options.split.bed;
  const Vec3 size = size_on_bed(unit.pose, unit.mesh.vertices);
  facts.at(where, "bed_share", size.x, bed.x - 2.0 * bed.gap);
  facts.at(where, "bed_share", size.y, bed.y - 2.0 * bed.gap);
  facts.at(where, "bed_share", size.z, bed.z);
}

void measure_joints(const PrintJob& job, const Hold& hold, ShopFacts& facts) {
  const std::string where = "all joints";
  const double ease = job.options.ease;
  if (hold.tongue) {
    facts.at(where, "hole_wall_walls", hold.tongue->wall, job.options.wall);
    facts.at(where, "joint_play", hold.tongue->fit);
    facts.at(where, "step_up", std::max(0.0, hold.tongue->fit - ease));
    return;
  }
  if (job.options.dowels.wanted) {
    const double pins = hold.dowels ? static_cast<double>(hold.dowels->places.size()) : 0.0;
    facts.at(where, "pins_at_joint", pins, 1.0, Dimension::number);
  }
  if (!hold.dowels) return;
  const double fit = job.options.dowels.fit;
  facts.at(where, "hole_wall_walls", hold.dowels->wall, job.options.wall);
  facts.at(where, "joint_play", fit);
  facts.at(where, "step_up", std::max(0.0, fit - ease));
}

}  // namespace

void measure_prints(const PrintJob& job, const std::vector<PrintUnit>& units, const Hold& hold,
                    Workshop& workshop) {
  const PrintOptions& options = job.options;
  ShopFacts facts(workshop);
  facts.parts(options.split.heaviest);
  facts.at("cross-section", "section_walls", job.section.narrowest(), options.wall);
  for (std::size_t i = 0; i < units.size(); ++i) {
    const PrintUnit& unit = units[i];
    measure_size(job, unit, where_of(i), facts);
    facts.at(where_of(i), "overhang_share", unit.pose.overhang, options.overhang.radians(), Dimension::angle);
    facts.at(where_of(i), "run_surface_step_layers", unit.pose.step, options.layer);
    if (unit.digit_height > 0.0) facts.at(where_of(i), "number_bar", kBarWidth * unit.digit_height);
  }
  if (units.size() > 1) measure_joints(job, hold, facts);
}

}  // namespace glissade::parts
