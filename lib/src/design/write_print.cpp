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
  group.add("dowels", dowels(print.dowels));
  group.add("pose", pose(print.pose));
  group.add("layer", print.layer, Dimension::length);
  group.add("wall", print.wall, Dimension::length);
  group.add("overhang", print.overhang.radians(), Dimension::angle);
  group.add("number_depth", print.number_depth, Dimension::length);
  group.add("ease", print.ease, Dimension::length);
}

}  // namespace glissade::design_file
