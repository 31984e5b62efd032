#include "glissade/parts/plate_options.hpp"

#include "design/read_process.hpp"

#include <cstddef>
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
  return as_point(value, findings, "[3 m, 1.5 m]").value_or(SplitOptions{}.sheet);
}

SplitOptions read_plate_split(const Value& value, Findings& findings) {
  MapReader map(value, "A split", "{longest: 3 m, sheet: [3 m, 1.5 m]}", findings);
  SplitOptions split;
  split.longest = map.quantity("longest", Dimension::length);
  if (const auto sheet = map.find("sheet")) split.sheet = read_sheet(*sheet, findings);
  split.heaviest = map.quantity("heaviest", Dimension::mass);
  split.widest = map.quantity("widest", Dimension::length);
  set_length(map, "bar", split.bar);
  split.frames = read_count(map, "frames", findings).value_or(split.frames);
  set_length(map, "margin", split.margin);
  set_length(map, "spacing", split.spacing);
  if (const auto allowed = map.find("allowed")) split.allowed = as_flag(*allowed, findings).value_or(true);
  map.refuse_unknown_keys();
  return split;
}

/// "M10" as 10, of the sizes whose holes are known.
void set_bolt(MapReader& map, std::string_view key, int& bolt) {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const int size : bolt_sizes()) all.push_back("M" + std::to_string(size));
    return all;
  }();
  std::vector<std::pair<std::string_view, int>> words;
  for (std::size_t i = 0; i < names.size(); ++i) words.emplace_back(names[i], bolt_sizes()[i]);
  bolt = chosen(map, key, bolt, words);
}

FlangeOptions read_flanges(const Value& value, Findings& findings) {
  FlangeOptions flanges;
  flanges.as_told = true;
  if (value.node->kind != Node::Kind::map && is_word(value, "none", findings)) {
    flanges.wanted = false;
    return flanges;
  }
  MapReader map(value, "A set of flanges", "{width: 50 mm, thickness: 6 mm, bolt: M10, pitch: 150 mm}",
                findings);
  flanges.width = map.quantity("width", Dimension::length).value_or(flanges.width);
  flanges.thickness = map.quantity("thickness", Dimension::length).value_or(flanges.thickness);
  set_bolt(map, "bolt", flanges.bolt);
  flanges.pitch = map.quantity("pitch", Dimension::length).value_or(flanges.pitch);
  flanges.gap = map.quantity("gap", Dimension::length).value_or(flanges.gap);
  flanges.slotted = chosen<std::optional<FlangeSide>>(
      map, "slotted", flanges.slotted,
      {{"none", std::nullopt}, {"downstream", FlangeSide::downstream}, {"upstream", FlangeSide::upstream}});
  flanges.slot = map.quantity("slot", Dimension::length);
  flanges.section = chosen<FlangeSection>(map, "section", flanges.section,
                                          {{"flat", FlangeSection::flat}, {"angle", FlangeSection::angle}});
  map.refuse_unknown_keys();
  return flanges;
}

/// A word, or a map with measures.
CornerOptions read_corners(MapReader& whole, const Value& value, Findings& findings) {
  const std::vector<std::pair<std::string_view, CornerJoint>> words = {
      {"butt", CornerJoint::butt}, {"lap", CornerJoint::lap}, {"tab-and-slot", CornerJoint::tab_and_slot}};
  CornerOptions corners;
  if (value.node->kind != Node::Kind::map) {
    corners.kind = whole.choice(value, words).value_or(corners.kind);
    return corners;
  }
  MapReader map(value, "A set of corners", "{kind: tab-and-slot, overlap: 15 mm, tab: 40 mm}", findings);
  if (const auto kind = map.need("kind", "kind: tab-and-slot"))
    corners.kind = map.choice(*kind, words).value_or(corners.kind);
  corners.overlap = map.quantity("overlap", Dimension::length).value_or(corners.overlap);
  corners.tab = map.quantity("tab", Dimension::length).value_or(corners.tab);
  corners.spacing = map.quantity("spacing", Dimension::length).value_or(corners.spacing);
  corners.clearance = map.quantity("clearance", Dimension::length).value_or(corners.clearance);
  map.refuse_unknown_keys();
  return corners;
}

RimOptions read_rim(const Value& value, Findings& findings) {
  MapReader map(value, "A rim", "{width: 40 mm, thickness: 5 mm}", findings);
  RimOptions rim;
  set_length(map, "width", rim.width);
  set_length(map, "thickness", rim.thickness);
  map.refuse_unknown_keys();
  return rim;
}

StiffenerOptions read_stiffeners(const Value& value, Findings& findings) {
  MapReader map(value, "A set of stiffeners", "{spacing: 800 mm, width: 40 mm, thickness: 6 mm}", findings);
  StiffenerOptions stiffeners;
  set_length(map, "spacing", stiffeners.spacing);
  set_length(map, "width", stiffeners.width);
  set_length(map, "thickness", stiffeners.thickness);
  map.refuse_unknown_keys();
  return stiffeners;
}

/// Where tiles go, and how long they are to last.
void read_places(MapReader& map, LinerOptions& liner) {
  static const std::vector<std::pair<std::string_view, LinerPlaces>> places = {{"whole", LinerPlaces::whole},
                                                                               {"worn", LinerPlaces::worn}};
  if (const auto where = map.find("where")) liner.where = map.choice(*where, places).value_or(liner.where);
  liner.worn_from = map.quantity("worn_from", Dimension::number).value_or(liner.worn_from);
  liner.life = map.quantity("life", Dimension::time);
  liner.tonnage = map.quantity("tonnage", Dimension::mass);
}

LinerOptions read_liner(const Value& value, Findings& findings) {
  MapReader map(value, "A liner", "{thickness: 6 mm, tile_length: 600 mm, tile_width: 200 mm}", findings);
  LinerOptions liner;
  if (const auto material = map.find("material"))
    liner.material = read_material(*material, liner.material, findings);
  set_length(map, "thickness", liner.thickness);
  set_length(map, "tile_length", liner.tile_length);
  set_length(map, "tile_width", liner.tile_width);
  set_length(map, "gap", liner.gap);
  liner.heaviest = map.quantity("heaviest", Dimension::mass).value_or(liner.heaviest);
  set_bolt(map, "bolt", liner.bolt);
  read_places(map, liner);
  map.refuse_unknown_keys();
  return liner;
}

CoverOptions read_cover(const Value& value, Findings& findings) {
  MapReader map(value, "A cover", "{thickness: 2 mm, bolt: M8, pitch: 300 mm}", findings);
  CoverOptions cover;
  set_length(map, "thickness", cover.thickness);
  set_bolt(map, "bolt", cover.bolt);
  set_length(map, "pitch", cover.pitch);
  map.refuse_unknown_keys();
  return cover;
}

InspectionOptions read_opening(const Value& value, Findings& findings) {
  MapReader map(value, "An opening", "{at: 2 m, length: 200 mm, height: 150 mm}", findings);
  InspectionOptions opening;
  opening.at = map.needed_quantity("at", Dimension::length, "at: 2 m").value_or(opening.at);
  set_length(map, "length", opening.length);
  set_length(map, "height", opening.height);
  set_bolt(map, "bolt", opening.bolt);
  map.refuse_unknown_keys();
  return opening;
}

LiftingOptions read_lifting(const Value& value, Findings& findings) {
  MapReader map(value, "A set of lifting points", "{thickness: 10 mm, hole: 22 mm}", findings);
  LiftingOptions lifting;
  set_length(map, "thickness", lifting.thickness);
  set_length(map, "hole", lifting.hole);
  map.refuse_unknown_keys();
  return lifting;
}

SupportOptions read_supports(const Value& value, Findings& findings) {
  MapReader map(value, "A set of supports", "{ground: 0 m, spacing: 2 m}", findings);
  SupportOptions supports;
  if (const auto ground = map.need("ground", "ground: 0 m")) {
    supports.ground = read_ground(*ground, findings);
  }
  set_length(map, "spacing", supports.spacing);
  set_length(map, "tube", supports.tube);
  set_length(map, "wall", supports.wall);
  if (const auto steepest = map.quantity("steepest", Dimension::angle))
    supports.steepest = Angle::from_radians(*steepest);
  set_length(map, "braced_from", supports.braced_from);
  set_length(map, "grout", supports.grout);
  set_bolt(map, "anchor", supports.anchor);
  map.refuse_unknown_keys();
  return supports;
}

void read_fittings(MapReader& map, PlateOptions& plate, Findings& findings) {
  const auto with = [&](auto read) {
    return [&findings, read](const Value& value) { return read(value, findings); };
  };
  plate.rim = optional_group<RimOptions>(map, "rim", findings, with(read_rim));
  plate.stiffeners = optional_group<StiffenerOptions>(map, "stiffeners", findings, with(read_stiffeners));
  plate.liner = optional_group<LinerOptions>(map, "liner", findings, with(read_liner));
  plate.cover = optional_group<CoverOptions>(map, "cover", findings, with(read_cover));
  const auto openings = map.find("inspection");
  if (openings && !is_word(*openings, "none", findings)) {
    for (const Value& value : as_list(*openings, "[{at: 2 m}]", findings))
      plate.inspection.push_back(read_opening(value, findings));
  }
  plate.lifting = optional_group<LiftingOptions>(map, "lifting", findings, with(read_lifting));
  plate.supports = optional_group<SupportOptions>(map, "supports", findings, with(read_supports));
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
  if (const auto corners = map.find("corners")) plate.corners = read_corners(map, *corners, findings);
  if (const auto split = map.find("split")) plate.split = read_plate_split(*split, findings);
  if (const auto flanges = map.find("flanges")) plate.flanges = read_flanges(*flanges, findings);
  plate.round = chosen<RoundMake>(
      map, "round", plate.round,
      {{"as-fits", RoundMake::as_fits}, {"mitred", RoundMake::mitred}, {"staves", RoundMake::staves}});
  set_length(map, "stave_tolerance", plate.stave_tolerance);
  plate.polygon_thickness = map.quantity("thickness", Dimension::length);
  read_fittings(map, plate, findings);
  if (const auto hood = map.find("hood")) plate.hood = as_flag(*hood, findings).value_or(true);
  plate.joint_step = map.quantity("joint_step", Dimension::length).value_or(plate.joint_step);
  return plate;
}

}  // namespace glissade::design_file
