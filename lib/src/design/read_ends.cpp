#include "design/read_ends.hpp"

#include "design/schema_words.hpp"

namespace glissade::design_file {
namespace {

void read_belt(MapReader& map, FeedDesign& feed) {
  map.rename("A feed from a belt");
  map.add_stranger("outlet_speed", "kind: hopper, which has outlet_speed");
  feed.belt_speed = map.needed_quantity("belt_speed", Dimension::speed, "belt_speed: 3.2 m/s").value_or(0.0);
  feed.pulley_radius =
      map.needed_quantity("pulley_radius", Dimension::length, "pulley_radius: 400 mm, belt included")
          .value_or(0.0);
  if (const auto angle = map.quantity("belt_angle", Dimension::angle))
    feed.belt_angle = Angle::from_radians(*angle);
}

}  // namespace

std::optional<FeedDesign> read_feed(MapReader& top, Findings& findings) {
  const auto value = top.find("feed");
  if (!value) return {};
  static const Words<FeedKind> kinds = {
      {"belt", FeedKind::belt}, {"hopper", FeedKind::hopper}, {"free-fall", FeedKind::free_fall}};
  MapReader map(*value, "A feed", "{kind: belt, belt_speed: 3.2 m/s, pulley_radius: 400 mm, drop: 0.8 m}",
                findings);
  const auto kind_value = map.need("kind", "kind: belt, hopper or free-fall");
  const auto kind = kind_value ? map.choice(*kind_value, kinds) : std::nullopt;
  if (!kind) return {};
  FeedDesign feed;
  feed.kind = *kind;
  switch (feed.kind) {
    case FeedKind::belt:
      map.expect({"kind", "belt_speed", "pulley_radius", "belt_angle", "drop"});
      break;
    case FeedKind::hopper:
      map.expect({"kind", "outlet_speed", "drop"});
      break;
    case FeedKind::free_fall:
      map.expect({"kind", "drop"});
      break;
  }
  feed.drop = map.needed_quantity("drop", Dimension::length, "drop: 0.8 m, down to the start of the track")
                  .value_or(0.0);
  if (feed.kind == FeedKind::belt) {
    read_belt(map, feed);
  } else {
    for (const std::string_view key : {"belt_speed", "pulley_radius", "belt_angle"})
      map.add_stranger(key, "kind: belt, which has belt_speed, pulley_radius and belt_angle");
  }
  if (feed.kind == FeedKind::hopper)
    feed.outlet_speed = map.quantity("outlet_speed", Dimension::speed).value_or(0.0);
  map.refuse_unknown_keys();
  return feed;
}

namespace {

/// A value, or the bounds within which the search chooses it.
std::optional<Range> read_choice(MapReader& map, std::string_view key, Dimension dimension,
                                 std::string_view example, Findings& findings) {
  const auto value = map.find(key);
  if (!value) return {};
  if (value->node->kind != Node::Kind::map) {
    const auto number = as_quantity(*value, dimension, findings);
    return number ? std::optional(Range::fixed(*number)) : std::nullopt;
  }
  MapReader bounds(*value, "What a search chooses", example, findings);
  const auto lowest = bounds.needed_quantity("lowest", dimension, example);
  const auto highest = bounds.needed_quantity("highest", dimension, example);
  bounds.refuse_unknown_keys();
  return Range{lowest, highest};
}

}  // namespace

std::optional<HoodDesign> read_hood(MapReader& top, Findings& findings) {
  const auto value = top.find("hood");
  if (!value) return {};
  MapReader map(*value, "A hood", "{radius: 1.2 m, impact_angle: 10 deg, exit_angle: 75 deg, drop: 500 mm}",
                findings);
  map.expect({"radius", "impact_angle", "exit_angle", "drop"});
  HoodDesign hood;
  const bool given = map.need("radius", "radius: 1.2 m, or {lowest: 0.8 m, highest: 2 m}").has_value();
  if (given) {
    hood.radius = read_choice(map, "radius", Dimension::length, "{lowest: 0.8 m, highest: 2 m}", findings)
                      .value_or(Range{});
  }
  hood.impact_angle =
      read_choice(map, "impact_angle", Dimension::angle, "{lowest: 5 deg, highest: 20 deg}", findings)
          .value_or(Range::fixed(Angle::from_degrees(10.0).radians()));
  hood.exit_angle =
      read_choice(map, "exit_angle", Dimension::angle, "{lowest: 60 deg, highest: 85 deg}", findings)
          .value_or(Range::fixed(Angle::from_degrees(80.0).radians()));
  hood.drop = map.needed_quantity("drop", Dimension::length, "drop: 500 mm, down to the start of the track")
                  .value_or(0.0);
  map.refuse_unknown_keys();
  return hood;
}

std::optional<DischargeDesign> read_discharge(MapReader& top, Findings& findings) {
  const auto value = top.find("discharge");
  if (!value) return {};
  MapReader map(*value, "A discharge", "{belt_speed: 2.5 m/s, drop: 400 mm}", findings);
  map.expect({"belt_speed", "drop", "direction", "belt_angle", "belt_friction"});
  DischargeDesign discharge;
  discharge.belt_speed =
      map.needed_quantity("belt_speed", Dimension::speed, "belt_speed: 2.5 m/s").value_or(0.0);
  discharge.drop = map.quantity("drop", Dimension::length).value_or(0.0);
  if (const auto angle = map.quantity("direction", Dimension::angle))
    discharge.direction = Angle::from_radians(*angle);
  if (const auto angle = map.quantity("belt_angle", Dimension::angle))
    discharge.belt_angle = Angle::from_radians(*angle);
  discharge.belt_friction =
      map.quantity("belt_friction", Dimension::number).value_or(discharge.belt_friction);
  map.refuse_unknown_keys();
  return discharge;
}

}  // namespace glissade::design_file
