#include "design/write_fabrication.hpp"

namespace glissade::design_file {
namespace {

std::string bend(const BendOptions& options) {
  Group group;
  switch (options.rule) {
    case FacetRule::speed_loss:
      group.add("speed_loss", options.value, Dimension::number);
      break;
    case FacetRule::chord_tolerance:
      group.add("chord_tolerance", options.value, Dimension::length);
      break;
    case FacetRule::bends:
      group.add("bends", options.value, Dimension::number);
      break;
    case FacetRule::segment_length:
      group.add("segment_length", options.value, Dimension::length);
      break;
    case FacetRule::segment_angle:
      group.add("segment_angle", options.value, Dimension::angle);
      break;
  }
  group.add("inner_radius", options.inner_radius, Dimension::length);
  group.add("k_factor", options.k_factor, Dimension::number);
  return group.inlined();
}

std::string split(const SplitOptions& options) {
  Group group;
  group.add("longest", options.longest, Dimension::length);
  group.add("sheet", point(options.sheet));
  group.add("heaviest", options.heaviest, Dimension::mass);
  if (!options.allowed) group.add("allowed", "false");
  return group.inlined();
}

std::string flanges(const FlangeOptions& options) {
  if (!options.wanted) return "none";
  Group group;
  group.add("width", options.width, Dimension::length);
  group.add("thickness", options.thickness, Dimension::length);
  group.add("bolt", "M" + std::to_string(options.bolt));
  group.add("pitch", options.pitch, Dimension::length);
  group.add("gap", options.gap, Dimension::length);
  return group.inlined();
}

}  // namespace

void add_process(Group& group, const PlateOptions& plate) {
  group.add("floor", plate.floor == FloorMake::bent ? "bent" : "rolled");
  group.add("bend", bend(plate.bend));
  group.add("walls", plate.walls == WallSeat::on_floor ? "on-floor" : "beside-floor");
  group.add("split", split(plate.split));
  group.add("flanges", flanges(plate.flanges));
  group.add("round", plate.round == RoundMake::staves ? "staves" : "mitred");
  group.add("stave_tolerance", plate.stave_tolerance, Dimension::length);
  group.add("thickness", plate.polygon_thickness, Dimension::length);
  group.add("joint_step", plate.joint_step, Dimension::length);
}

}  // namespace glissade::design_file
