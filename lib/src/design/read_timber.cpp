#include "glissade/core/number_text.hpp"

#include "design/read_process.hpp"

#include <cmath>
#include <string>

namespace glissade::design_file {
namespace {

BearerOptions read_bearers(const Value& value, Findings& findings) {
  MapReader map(value, "A set of bearers", "{count: 5, width: 120 mm, depth: 400 mm}", findings);
  BearerOptions bearers;
  bearers.count = read_count(map, "count", findings);
  bearers.spacing = map.quantity("spacing", Dimension::length).value_or(bearers.spacing);
  bearers.width = map.quantity("width", Dimension::length);
  bearers.depth = map.quantity("depth", Dimension::length);
  map.refuse_unknown_keys();
  return bearers;
}

DeckOptions read_deck(const Value& value, Findings& findings) {
  MapReader map(value, "A deck", "{layers: 2}", findings);
  DeckOptions deck;
  deck.boards = optional_group<BoardOptions>(map, "boards", findings, [&](const Value& group) {
    MapReader keys(group, "A set of boards", "{width: 120 mm, length: 4 m}", findings);
    BoardOptions boards;
    set_length(keys, "width", boards.width);
    set_length(keys, "length", boards.length);
    set_length(keys, "gap", boards.gap);
    keys.refuse_unknown_keys();
    return boards;
  });
  set_length(map, "stave_tolerance", deck.stave_tolerance);
  deck.layers = read_count(map, "layers", findings).value_or(deck.layers);
  map.refuse_unknown_keys();
  return deck;
}

CrossMemberOptions read_cross_members(const Value& value, Findings& findings) {
  MapReader map(value, "A set of cross members", "{width: 45 mm, height: 70 mm, spacing: 400 mm}", findings);
  CrossMemberOptions members;
  members.width = map.quantity("width", Dimension::length);
  set_length(map, "cheek", members.cheek);
  members.reach = map.quantity("reach", Dimension::length);
  members.height = map.quantity("height", Dimension::length).value_or(members.height);
  members.spacing = map.quantity("spacing", Dimension::length).value_or(members.spacing);
  map.refuse_unknown_keys();
  return members;
}

LegOptions read_legs(const Value& value, Findings& findings) {
  MapReader map(value, "A set of legs", "{ground: 0 m, spacing: 2 m, side: 90 mm}", findings);
  LegOptions legs;
  if (const auto ground = map.need("ground", "ground: 0 m")) legs.ground = read_ground(*ground, findings);
  legs.spacing = map.quantity("spacing", Dimension::length).value_or(legs.spacing);
  set_length(map, "side", legs.side);
  set_length(map, "braced_from", legs.braced_from);
  set_length(map, "brace_width", legs.brace_width);
  set_length(map, "brace_thickness", legs.brace_thickness);
  map.refuse_unknown_keys();
  return legs;
}

TimberSplit read_timber_split(const Value& value, Findings& findings) {
  MapReader map(value, "A split of timber", "{sheet: [2.5 m, 1.25 m], longest: 12 m}", findings);
  TimberSplit split;
  if (const auto sheet = map.find("sheet"))
    split.sheet = as_point(*sheet, findings, "[2.5 m, 1.25 m]").value_or(split.sheet);
  split.longest = map.quantity("longest", Dimension::length).value_or(split.longest);
  split.heaviest = map.quantity("heaviest", Dimension::mass);
  set_length(map, "margin", split.margin);
  set_length(map, "spacing", split.spacing);
  map.refuse_unknown_keys();
  return split;
}

}  // namespace

TimberOptions read_timber(MapReader& map, Findings& findings) {
  TimberOptions timber;
  if (const auto lumber = map.find("lumber")) timber.lumber = read_material(*lumber, timber.lumber, findings);
  timber.frame = chosen<TimberFrame>(map, "frame", timber.frame,
                                     {{"ribs", TimberFrame::ribs}, {"beams", TimberFrame::beams}});
  if (const auto bearers = map.find("bearers")) timber.bearers = read_bearers(*bearers, findings);
  if (const auto deck = map.find("deck")) timber.deck = read_deck(*deck, findings);
  if (const auto members = map.find("cross_members"))
    timber.cross_members = read_cross_members(*members, findings);
  if (const auto legs = map.find("legs")) timber.legs = read_legs(*legs, findings);
  if (const auto split = map.find("split")) timber.split = read_timber_split(*split, findings);
  timber.fit = map.quantity("fit", Dimension::length).value_or(timber.fit);
  timber.joint_step = map.quantity("joint_step", Dimension::length).value_or(timber.joint_step);
  return timber;
}

}  // namespace glissade::design_file
