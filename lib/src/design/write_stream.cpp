#include "design/write_stream.hpp"

#include "glissade/core/number_text.hpp"
#include "glissade/core/quantity.hpp"

#include "design/written_text.hpp"

#include <optional>
#include <string_view>
#include <utility>

namespace glissade::design_file {
namespace {

std::string sourced(const SourcedValue& value, Dimension dimension) {
  Group group;
  group.add("value", value.value, dimension);
  if (!value.why.empty()) group.add("why", in_quotes(value.why));
  group.add("source", in_quotes(value.from.text));
  return group.inlined();
}

std::string wall_friction(const WallFriction& friction) {
  Group angle;
  angle.add("low", friction.low.radians(), Dimension::angle);
  angle.add("nominal", friction.nominal.radians(), Dimension::angle);
  angle.add("high", friction.high.radians(), Dimension::angle);
  Group group;
  group.add("liner", in_quotes(friction.liner));
  group.add("angle", angle.inlined());
  if (friction.moisture) {
    group.add("moisture", "{low: " + exact_text(*friction.moisture->lowest) +
                              ", high: " + exact_text(*friction.moisture->highest) + "}");
  }
  group.add("source", in_quotes(friction.from.text));
  return group.inlined();
}

/// A value, or the bounds of what a search chooses.
void add_choice(Group& group, std::string_view key, const Range& range, Dimension dimension) {
  if (range.is_fixed()) {
    group.add(key, *range.lowest, dimension);
    return;
  }
  Group bounds;
  bounds.add("lowest", range.lowest, dimension);
  bounds.add("highest", range.highest, dimension);
  group.add(key, bounds.inlined());
}

}  // namespace

/// One of the design's own.
std::string written_bulk_material(const Material& design) {
  Group group;
  group.add("material", in_quotes(design.word));
  group.add("name", in_quotes(design.name));
  if (design.density) {
    Group density;
    density.add("low", design.density->low, Dimension::density);
    density.add("nominal", design.density->nominal, Dimension::density);
    density.add("high", design.density->high, Dimension::density);
    density.add("source", in_quotes(design.density->from.text));
    group.add("density", density.inlined());
  }
  if (design.lateral_pressure_ratio)
    group.add("lateral_pressure_ratio", sourced(*design.lateral_pressure_ratio, Dimension::number));
  if (!design.friction.empty()) group.add("friction", list_of(design.friction, wall_friction));
  if (design.highest_speed) group.add("highest_speed", sourced(*design.highest_speed, Dimension::speed));
  if (!design.warnings.empty()) group.add("warnings", list_of(design.warnings, in_quotes));
  return group.inlined();
}

std::string written_feed(const FeedDesign& design) {
  Group group;
  switch (design.kind) {
    case FeedKind::belt:
      group.add("kind", "belt");
      group.add("belt_speed", design.belt_speed, Dimension::speed);
      group.add("pulley_radius", design.pulley_radius, Dimension::length);
      group.add_unless(0.0, "belt_angle", design.belt_angle.radians(), Dimension::angle);
      break;
    case FeedKind::hopper:
      group.add("kind", "hopper");
      group.add_unless(0.0, "outlet_speed", design.outlet_speed, Dimension::speed);
      break;
    case FeedKind::free_fall:
      group.add("kind", "free-fall");
      break;
  }
  group.add("drop", design.drop, Dimension::length);
  return group.lines();
}

std::string written_hood(const HoodDesign& design) {
  Group group;
  add_choice(group, "radius", design.radius, Dimension::length);
  add_choice(group, "impact_angle", design.impact_angle, Dimension::angle);
  add_choice(group, "exit_angle", design.exit_angle, Dimension::angle);
  group.add("drop", design.drop, Dimension::length);
  return group.lines();
}

std::string written_discharge(const DischargeDesign& design) {
  Group group;
  group.add("belt_speed", design.belt_speed, Dimension::speed);
  group.add_unless(0.0, "drop", design.drop, Dimension::length);
  group.add_unless(0.0, "direction", design.direction.radians(), Dimension::angle);
  group.add_unless(0.0, "belt_angle", design.belt_angle.radians(), Dimension::angle);
  if (design.belt_friction != DischargeDesign{}.belt_friction)
    group.add("belt_friction", exact_text(design.belt_friction));
  return group.lines();
}

std::string written_stream(const StreamDesign& design) {
  const StreamDesign left_out;
  Group density;
  density.add("low", design.low_density, Dimension::density);
  density.add("nominal", design.bulk_density, Dimension::density);
  density.add("high", design.high_density, Dimension::density);
  Group group;
  group.add("mass_flow", design.mass_flow, Dimension::mass_flow);
  if (design.material) {
    group.add("material", in_quotes(design.material->material));
    if (!design.material->liner.empty()) group.add("liner", in_quotes(design.material->liner));
    if (design.material->moisture) group.add("moisture", exact_text(*design.material->moisture));
  }
  if (design.material && design.material->density_follows) {
    // Left to the material.
  } else if (design.low_density || design.high_density) {
    group.add("bulk_density", density.inlined());
  } else {
    group.add("bulk_density", design.bulk_density, Dimension::density);
  }
  group.add("lump_size", design.lump_size, Dimension::length);
  const auto number = [&](std::string_view key, double value, double usual) {
    if (value != usual) group.add(key, exact_text(value));
  };
  if (!design.material) {
    number("lateral_pressure_ratio", design.lateral_pressure_ratio, left_out.lateral_pressure_ratio);
  } else if (!design.material->pressure_ratio_follows) {
    group.add("lateral_pressure_ratio", exact_text(design.lateral_pressure_ratio));
  }
  number("slip_ratio", design.slip_ratio, left_out.slip_ratio);
  if (design.liner_plate) {
    Group plate;
    plate.add("thickness", design.liner_plate->thickness, Dimension::length);
    plate.add("hardness", design.liner_plate->hardness, Dimension::pressure);
    plate.add("wear_coefficient", exact_text(design.liner_plate->wear_coefficient));
    group.add("liner_plate", plate.inlined());
  }
  number("surge", design.surge, left_out.surge);
  number("trickle", design.trickle, left_out.trickle);
  return group.lines();
}

}  // namespace glissade::design_file
