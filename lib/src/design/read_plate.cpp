#include "glissade/core/words.hpp"

#include "design/read_process.hpp"

#include <charconv>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace glissade::design_file {
namespace {

BendOptions read_bend(const Value& value, Findings& findings) {
  MapReader map(value, "A bend", "{speed_loss: 1 %, inner_radius: 6 mm}", findings);
  map.expect({"speed_loss", "chord_tolerance", "bends", "segment_length", "segment_angle", "inner_radius",
              "k_factor"});
  BendOptions bend;
  int given = 0;
  const auto rule = [&](std::string_view key, Dimension dimension, FacetRule meant) {
    const bool asked = map.has(key);
    const auto found = map.quantity(key, dimension);
    if (!asked) return;
    ++given;
    bend.rule = meant;
    bend.value = found.value_or(bend.value);
  };
  rule("speed_loss", Dimension::number, FacetRule::speed_loss);
  rule("chord_tolerance", Dimension::length, FacetRule::chord_tolerance);
  rule("bends", Dimension::number, FacetRule::bends);
  rule("segment_length", Dimension::length, FacetRule::segment_length);
  rule("segment_angle", Dimension::angle, FacetRule::segment_angle);
  bend.inner_radius = map.quantity("inner_radius", Dimension::length);
  bend.k_factor = map.quantity("k_factor", Dimension::number);
  map.refuse_unknown_keys();
  if (given > 1) {
    findings.add(findings.position(value.key_path), value.key_path,
                 {"", "bend: more than one rule for the number of bends",
                  "It is one of speed_loss, chord_tolerance, bends, segment_length and segment_angle.",
                  "one of them"});
  }
  return bend;
}

Vec2 read_sheet(const Value& value, Findings& findings) {
  return as_point(value, findings).value_or(SplitOptions{}.sheet);
}

SplitOptions read_split(const Value& value, Findings& findings) {
  MapReader map(value, "A split", "{longest: 3 m, sheet: [3 m, 1.5 m]}", findings);
  SplitOptions split;
  split.longest = map.quantity("longest", Dimension::length);
  if (const auto sheet = map.find("sheet")) split.sheet = read_sheet(*sheet, findings);
  split.heaviest = map.quantity("heaviest", Dimension::mass);
  if (const auto allowed = map.find("allowed")) split.allowed = as_flag(*allowed, findings).value_or(true);
  map.refuse_unknown_keys();
  return split;
}

/// "M10" as 10.
std::optional<int> read_bolt(const Value& value, Findings& findings) {
  const std::optional<std::string> text = as_text(value, findings);
  if (!text) return {};
  int size = 0;
  const char* const end = text->data() + text->size();
  const bool metric = text->size() > 1 && (text->front() == 'M' || text->front() == 'm');
  const auto [rest, error] = std::from_chars(text->data() + (metric ? 1 : 0), end, size);
  if (metric && error == std::errc{} && rest == end) return size;
  findings.add(value.node->at, value.key_path,
               {"", "bolt: " + shown(*text) + " is no metric bolt", "", "bolt: M10"});
  return {};
}

FlangeOptions read_flanges(const Value& value, Findings& findings) {
  FlangeOptions flanges;
  if (value.node->kind != Node::Kind::map && is_word(value, "none", findings)) {
    flanges.wanted = false;
    return flanges;
  }
  MapReader map(value, "A set of flanges", "{width: 50 mm, thickness: 6 mm, bolt: M10, pitch: 150 mm}",
                findings);
  flanges.width = map.quantity("width", Dimension::length).value_or(flanges.width);
  flanges.thickness = map.quantity("thickness", Dimension::length).value_or(flanges.thickness);
  if (const auto bolt = map.find("bolt")) flanges.bolt = read_bolt(*bolt, findings).value_or(flanges.bolt);
  flanges.pitch = map.quantity("pitch", Dimension::length).value_or(flanges.pitch);
  flanges.gap = map.quantity("gap", Dimension::length).value_or(flanges.gap);
  map.refuse_unknown_keys();
  return flanges;
}

void set_length(MapReader& map, std::string_view key, double& value) {
  value = map.quantity(key, Dimension::length).value_or(value);
}

}  // namespace

PlateOptions read_plate(MapReader& map, Findings& findings) {
  PlateOptions plate;
  plate.floor = chosen<FloorMake>(map, "floor", plate.floor,
                                  {{"rolled", FloorMake::rolled}, {"bent", FloorMake::bent}});
  if (const auto bend = map.find("bend")) plate.bend = read_bend(*bend, findings);
  plate.walls =
      chosen<WallSeat>(map, "walls", plate.walls,
                       {{"beside-floor", WallSeat::beside_floor}, {"on-floor", WallSeat::on_floor}});
  if (const auto split = map.find("split")) plate.split = read_split(*split, findings);
  if (const auto flanges = map.find("flanges")) plate.flanges = read_flanges(*flanges, findings);
  plate.round = chosen<RoundMake>(map, "round", plate.round,
                                  {{"mitred", RoundMake::mitred}, {"staves", RoundMake::staves}});
  set_length(map, "stave_tolerance", plate.stave_tolerance);
  set_length(map, "thickness", plate.polygon_thickness);
  plate.joint_step = map.quantity("joint_step", Dimension::length).value_or(plate.joint_step);
  return plate;
}

}  // namespace glissade::design_file
