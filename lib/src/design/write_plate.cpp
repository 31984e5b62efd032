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
  group.add("widest", options.widest, Dimension::length);
  group.add("bar", options.bar, Dimension::length);
  if (options.frames != SplitOptions{}.frames) group.add("frames", std::to_string(options.frames));
  group.add("margin", options.margin, Dimension::length);
  group.add("spacing", options.spacing, Dimension::length);
  if (!options.allowed) group.add("allowed", "false");
  return group.inlined();
}

std::string flanges(const FlangeOptions& options) {
  if (!options.wanted) return "none";
  Group group;
  if (options.section == FlangeSection::angle) group.add("section", "angle");
  group.add("width", options.width, Dimension::length);
  group.add("thickness", options.thickness, Dimension::length);
  group.add("bolt", "M" + std::to_string(options.bolt));
  group.add("pitch", options.pitch, Dimension::length);
  group.add("gap", options.gap, Dimension::length);
  if (options.slotted)
    group.add("slotted", options.slotted == FlangeSide::downstream ? "downstream" : "upstream");
  group.add("slot", options.slot, Dimension::length);
  return group.inlined();
}

std::string bolt(int size) {
  return "M" + std::to_string(size);
}

std::string corners(const CornerOptions& options) {
  const char* const kind = options.kind == CornerJoint::butt  ? "butt"
                           : options.kind == CornerJoint::lap ? "lap"
                                                              : "tab-and-slot";
  Group group;
  group.add("kind", kind);
  group.add("overlap", options.overlap, Dimension::length);
  group.add("tab", options.tab, Dimension::length);
  group.add("spacing", options.spacing, Dimension::length);
  group.add("clearance", options.clearance, Dimension::length);
  return group.inlined();
}

std::string rim(const RimOptions& options) {
  Group group;
  group.add("width", options.width, Dimension::length);
  group.add("thickness", options.thickness, Dimension::length);
  return group.inlined();
}

std::string stiffeners(const StiffenerOptions& options) {
  Group group;
  group.add("spacing", options.spacing, Dimension::length);
  group.add("width", options.width, Dimension::length);
  group.add("thickness", options.thickness, Dimension::length);
  return group.inlined();
}

std::string liner(const LinerOptions& options) {
  Group group;
  group.add("material", written_material(options.material));
  group.add("thickness", options.thickness, Dimension::length);
  group.add("tile_length", options.tile_length, Dimension::length);
  group.add("tile_width", options.tile_width, Dimension::length);
  group.add("gap", options.gap, Dimension::length);
  group.add("heaviest", options.heaviest, Dimension::mass);
  group.add("bolt", bolt(options.bolt));
  group.add("where", options.where == LinerPlaces::worn ? "worn" : "whole");
  group.add("worn_from", options.worn_from, Dimension::number);
  if (options.life) group.add("life", *options.life, Dimension::time);
  if (options.tonnage) group.add("tonnage", *options.tonnage, Dimension::mass);
  return group.inlined();
}

std::string cover(const CoverOptions& options) {
  Group group;
  group.add("thickness", options.thickness, Dimension::length);
  group.add("bolt", bolt(options.bolt));
  group.add("pitch", options.pitch, Dimension::length);
  return group.inlined();
}

std::string opening(const InspectionOptions& options) {
  Group group;
  group.add("at", options.at, Dimension::length);
  group.add("length", options.length, Dimension::length);
  group.add("height", options.height, Dimension::length);
  group.add("bolt", bolt(options.bolt));
  return group.inlined();
}

std::string lifting(const LiftingOptions& options) {
  Group group;
  group.add("thickness", options.thickness, Dimension::length);
  group.add("hole", options.hole, Dimension::length);
  return group.inlined();
}

std::string supports(const SupportOptions& options) {
  Group group;
  group.add("ground", written_ground(options.ground));
  group.add("spacing", options.spacing, Dimension::length);
  group.add("tube", options.tube, Dimension::length);
  group.add("wall", options.wall, Dimension::length);
  group.add("steepest", options.steepest.radians(), Dimension::angle);
  group.add("braced_from", options.braced_from, Dimension::length);
  group.add("grout", options.grout, Dimension::length);
  group.add("anchor", bolt(options.anchor));
  return group.inlined();
}

}  // namespace

void add_process(Group& group, const PlateOptions& plate) {
  group.add("floor", plate.floor == FloorMake::bent ? "bent" : "rolled");
  group.add("bend", bend(plate.bend));
  group.add("walls", plate.walls == WallSeat::on_floor ? "on-floor" : "beside-floor");
  group.add("corners", corners(plate.corners));
  group.add("split", split(plate.split));
  if (plate.flanges != FlangeOptions()) group.add("flanges", flanges(plate.flanges));
  group.add("round", plate.round == RoundMake::staves   ? "staves"
                     : plate.round == RoundMake::mitred ? "mitred"
                                                        : "as-fits");
  group.add("stave_tolerance", plate.stave_tolerance, Dimension::length);
  group.add("thickness", plate.polygon_thickness, Dimension::length);
  if (plate.rim) group.add("rim", rim(*plate.rim));
  if (plate.stiffeners) group.add("stiffeners", stiffeners(*plate.stiffeners));
  if (plate.liner) group.add("liner", liner(*plate.liner));
  if (plate.cover) group.add("cover", cover(*plate.cover));
  if (!plate.inspection.empty()) group.add("inspection", list_of(plate.inspection, opening));
  if (plate.lifting) group.add("lifting", lifting(*plate.lifting));
  if (plate.supports) group.add("supports", supports(*plate.supports));
  if (!plate.hood) group.add("hood", "false");
  group.add("joint_step", plate.joint_step, Dimension::length);
}

}  // namespace glissade::design_file
