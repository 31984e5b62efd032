#include "design/write_fabrication.hpp"

#include <array>

namespace glissade::design_file {
namespace {

std::string split(const PrintSplit& options) {
  Group group;
  group.add("bed", list_of(std::array<double, 3>{options.bed.x, options.bed.y, options.bed.z}, length));
  group.add("gap", options.bed.gap, Dimension::length);
  group.add("longest", options.longest, Dimension::length);
  group.add("heaviest", options.heaviest, Dimension::mass);
  if (!options.allowed) group.add("allowed", "false");
  return group.inlined();
}

std::string dowels(const DowelOptions& options) {
  if (!options.wanted) return "none";
  Group group;
  group.add("diameter", options.diameter, Dimension::length);
  group.add("depth", options.depth, Dimension::length);
  group.add("fit", options.fit, Dimension::length);
  group.add("chamfer", options.chamfer, Dimension::length);
  return group.inlined();
}

std::string tongue(const TongueOptions& options) {
  Group group;
  group.add("height", options.height, Dimension::length);
  group.add("depth", options.depth, Dimension::length);
  group.add("fit", options.fit, Dimension::length);
  group.add("chamfer", options.chamfer, Dimension::length);
  group.add("flare", options.flare.radians(), Dimension::angle);
  return group.inlined();
}

std::string stands(const StandOptions& options) {
  Group group;
  if (!options.ground.empty()) group.add("ground", written_ground(options.ground));
  group.add("clear", options.clear, Dimension::length);
  group.add("spacing", options.spacing, Dimension::length);
  group.add("thickness", options.thickness, Dimension::length);
  group.add("cheek", options.cheek, Dimension::length);
  group.add("fit", options.fit, Dimension::length);
  group.add("steepest", options.steepest.radians(), Dimension::angle);
  return group.inlined();
}

std::string pose(PrintPose pose) {
  switch (pose) {
    case PrintPose::side:
      return "side";
    case PrintPose::end:
      return "end";
    case PrintPose::flat:
      return "flat";
    case PrintPose::automatic:
      break;
  }
  return "automatic";
}

}  // namespace

void add_process(Group& group, const PrintOptions& print) {
  group.add("split", split(print.split));
  if (print.joint == PrintJoint::dowels) {
    group.add("dowels", dowels(print.dowels));
  } else {
    group.add("joint", print.joint == PrintJoint::tongue ? "tongue" : "dovetail");
    group.add("tongue", tongue(print.tongue));
  }
  if (print.stands) group.add("stands", stands(*print.stands));
  group.add("pose", pose(print.pose));
  group.add("layer", print.layer, Dimension::length);
  group.add("wall", print.wall, Dimension::length);
  group.add("overhang", print.overhang.radians(), Dimension::angle);
  group.add("number_depth", print.number_depth, Dimension::length);
  group.add("ease", print.ease, Dimension::length);
}

}  // namespace glissade::design_file
