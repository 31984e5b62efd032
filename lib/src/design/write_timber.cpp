#include "design/write_fabrication.hpp"

namespace glissade::design_file {
namespace {

std::string bearers(const BearerOptions& options) {
  Group group;
  if (options.count) group.add("count", std::to_string(*options.count));
  group.add("spacing", options.spacing, Dimension::length);
  group.add("width", options.width, Dimension::length);
  group.add("depth", options.depth, Dimension::length);
  return group.inlined();
}

std::string deck(const DeckOptions& options) {
  Group group;
  group.add("layers", std::to_string(options.layers));
  group.add("stave_tolerance", options.stave_tolerance, Dimension::length);
  if (options.boards) {
    Group boards;
    boards.add("width", options.boards->width, Dimension::length);
    boards.add("length", options.boards->length, Dimension::length);
    boards.add("gap", options.boards->gap, Dimension::length);
    group.add("boards", boards.inlined());
  }
  return group.inlined();
}

std::string cross_members(const CrossMemberOptions& options) {
  Group group;
  group.add("width", options.width, Dimension::length);
  group.add("height", options.height, Dimension::length);
  group.add("spacing", options.spacing, Dimension::length);
  group.add("cheek", options.cheek, Dimension::length);
  group.add("reach", options.reach, Dimension::length);
  return group.inlined();
}

std::string legs(const LegOptions& options) {
  Group group;
  group.add("ground", written_ground(options.ground));
  group.add("spacing", options.spacing, Dimension::length);
  group.add("side", options.side, Dimension::length);
  group.add("braced_from", options.braced_from, Dimension::length);
  group.add("brace_width", options.brace_width, Dimension::length);
  group.add("brace_thickness", options.brace_thickness, Dimension::length);
  return group.inlined();
}

std::string split(const TimberSplit& options) {
  Group group;
  group.add("sheet", point(options.sheet));
  group.add("longest", options.longest, Dimension::length);
  group.add("heaviest", options.heaviest, Dimension::mass);
  group.add("margin", options.margin, Dimension::length);
  group.add("spacing", options.spacing, Dimension::length);
  return group.inlined();
}

}  // namespace

void add_process(Group& group, const TimberOptions& timber) {
  group.add("lumber", written_material(timber.lumber));
  group.add("frame", timber.frame == TimberFrame::beams ? "beams" : "ribs");
  group.add("bearers", bearers(timber.bearers));
  group.add("deck", deck(timber.deck));
  group.add("cross_members", cross_members(timber.cross_members));
  if (timber.legs) group.add("legs", legs(*timber.legs));
  group.add("split", split(timber.split));
  group.add("fit", timber.fit, Dimension::length);
  group.add("joint_step", timber.joint_step, Dimension::length);
}

}  // namespace glissade::design_file
