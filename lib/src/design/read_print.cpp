#include "core/counted.hpp"
#include "design/read_process.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace glissade::design_file {
namespace {

/// [220 mm, 220 mm, 250 mm]: width, depth and height.
PrintBed read_bed(const Value& value, PrintBed bed, Findings& findings) {
  constexpr std::string_view kExample = "[220 mm, 220 mm, 250 mm]";
  const std::vector<Value> sides = as_list(value, kExample, findings, {.exactly = {3}});
  if (value.node->kind != Node::Kind::sequence) return bed;
  const std::array<double*, 3> lengths = {&bed.x, &bed.y, &bed.z};
  for (std::size_t i = 0; i < std::min(sides.size(), lengths.size()); ++i) {
    *lengths[i] = as_quantity(sides[i], Dimension::length, findings).value_or(*lengths[i]);
  }
  if (sides.size() != lengths.size()) {
    findings.add(value.node->at, value.key_path,
                 {"", "bed: " + core::counted(sides.size(), "length"),
                  "A bed has a width, a depth and a height.", "bed: " + std::string(kExample)});
  }
  return bed;
}

PrintSplit read_print_split(const Value& value, Findings& findings) {
  MapReader map(value, "A split of a print", "{bed: [220 mm, 220 mm, 250 mm]}", findings);
  PrintSplit split;
  if (const auto bed = map.find("bed")) split.bed = read_bed(*bed, split.bed, findings);
  split.bed.gap = map.quantity("gap", Dimension::length).value_or(split.bed.gap);
  split.longest = map.quantity("longest", Dimension::length);
  split.heaviest = map.quantity("heaviest", Dimension::mass);
  if (const auto allowed = map.find("allowed")) split.allowed = as_flag(*allowed, findings).value_or(true);
  map.refuse_unknown_keys();
  return split;
}

DowelOptions read_dowels(const Value& value, Findings& findings) {
  DowelOptions dowels;
  if (value.node->kind != Node::Kind::map && is_word(value, "none", findings)) {
    dowels.wanted = false;
    return dowels;
  }
  MapReader map(value, "A set of dowels", "{diameter: 4 mm, fit: 0.15 mm}", findings);
  dowels.diameter = map.quantity("diameter", Dimension::length);
  dowels.depth = map.quantity("depth", Dimension::length);
  dowels.fit = map.quantity("fit", Dimension::length).value_or(dowels.fit);
  dowels.chamfer = map.quantity("chamfer", Dimension::length).value_or(dowels.chamfer);
  map.refuse_unknown_keys();
  return dowels;
}

TongueOptions read_tongue(const Value& value, Findings& findings) {
  MapReader map(value, "A tongue", "{height: 4 mm, depth: 3 mm, fit: 0.2 mm}", findings);
  TongueOptions tongue;
  tongue.height = map.quantity("height", Dimension::length);
  tongue.depth = map.quantity("depth", Dimension::length);
  set_length(map, "fit", tongue.fit);
  set_length(map, "chamfer", tongue.chamfer);
  if (const auto flare = map.quantity("flare", Dimension::angle)) tongue.flare = Angle::from_radians(*flare);
  map.refuse_unknown_keys();
  return tongue;
}

StandOptions read_stands(const Value& value, Findings& findings) {
  MapReader map(value, "A set of stands", "{spacing: 200 mm, clear: 10 mm}", findings);
  StandOptions stands;
  if (const auto ground = map.find("ground")) stands.ground = read_ground(*ground, findings);
  set_length(map, "clear", stands.clear);
  set_length(map, "spacing", stands.spacing);
  set_length(map, "thickness", stands.thickness);
  set_length(map, "cheek", stands.cheek);
  set_length(map, "fit", stands.fit);
  if (const auto steepest = map.quantity("steepest", Dimension::angle))
    stands.steepest = Angle::from_radians(*steepest);
  map.refuse_unknown_keys();
  return stands;
}

}  // namespace

PrintOptions read_print(MapReader& map, Findings& findings) {
  PrintOptions print;
  if (const auto split = map.find("split")) print.split = read_print_split(*split, findings);
  print.joint = chosen<PrintJoint>(
      map, "joint", print.joint,
      {{"dowels", PrintJoint::dowels}, {"tongue", PrintJoint::tongue}, {"dovetail", PrintJoint::dovetail}});
  if (const auto tongue = map.find("tongue")) print.tongue = read_tongue(*tongue, findings);
  print.stands = optional_group<StandOptions>(
      map, "stands", findings, [&](const Value& value) { return read_stands(value, findings); });
  if (const auto dowels = map.find("dowels")) print.dowels = read_dowels(*dowels, findings);
  print.pose = chosen<PrintPose>(map, "pose", print.pose,
                                 {{"automatic", PrintPose::automatic},
                                  {"side", PrintPose::side},
                                  {"end", PrintPose::end},
                                  {"flat", PrintPose::flat}});
  print.layer = map.quantity("layer", Dimension::length).value_or(print.layer);
  print.wall = map.quantity("wall", Dimension::length).value_or(print.wall);
  if (const auto overhang = map.quantity("overhang", Dimension::angle))
    print.overhang = Angle::from_radians(*overhang);
  print.number_depth = map.quantity("number_depth", Dimension::length).value_or(print.number_depth);
  print.ease = map.quantity("ease", Dimension::length).value_or(print.ease);
  return print;
}

}  // namespace glissade::design_file
