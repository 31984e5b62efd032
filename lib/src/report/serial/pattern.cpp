#include "report/serial/pattern.hpp"

#include <cmath>

namespace glissade::report {
namespace {

/// To a tenth of a micrometre; bulges, which are no lengths, to nine digits: 5 nm on an arc of 10 m.
double rounded(double value, double digits = 1e7) {
  return std::round(value * digits) / digits + 0.0;
}

Json point_json(Vec2 at) {
  return {rounded(at.x), rounded(at.y)};
}

Json path_json(const ArcPath& path) {
  Json corners = Json::array();
  for (const PathVertex& vertex : path.vertices)
    corners.push_back({rounded(vertex.at.x), rounded(vertex.at.y), rounded(vertex.bulge, 1e9)});
  return corners;
}

Json bend_json(const BendLine& bend) {
  return {{"from_m", point_json(bend.from)},
          {"to_m", point_json(bend.to)},
          {"angle_deg", degrees(bend.angle)},
          {"inner_radius_m", bend.inner_radius},
          {"up", bend.up}};
}

Json roll_json(const RollLine& roll) {
  return {{"from_m", point_json(roll.from)},
          {"to_m", point_json(roll.to)},
          {"radius_m", std::isfinite(roll.radius) ? Json(roll.radius) : Json(nullptr)}};
}

}  // namespace

Json pattern_json(const ShopPart& part) {
  if (!part.pattern) return nullptr;
  const FlatPattern& pattern = *part.pattern;
  Json json{{"outline_m", path_json(pattern.region.outline)},
            {"cutouts_m", Json::array()},
            {"holes_m", Json::array()},
            {"bends", Json::array()},
            {"rolls", Json::array()},
            {"marks_m", Json::array()}};
  for (const ArcPath& cutout : pattern.region.cutouts) json["cutouts_m"].push_back(path_json(cutout));
  for (const Circle& hole : pattern.region.holes)
    json["holes_m"].push_back({rounded(hole.centre.x), rounded(hole.centre.y), rounded(2.0 * hole.radius)});
  for (const BendLine& bend : pattern.bends) json["bends"].push_back(bend_json(bend));
  for (const RollLine& roll : pattern.rolls) json["rolls"].push_back(roll_json(roll));
  for (const ArcPath& mark : pattern.marks) json["marks_m"].push_back(path_json(mark));
  return json;
}

}  // namespace glissade::report
