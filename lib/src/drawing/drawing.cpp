#include "glissade/drawing/drawing.hpp"

#include <algorithm>
#include <utility>

namespace glissade {

std::size_t Drawing::layer(const DrawingLayer& wanted) {
  const auto found = std::find_if(layers.begin(), layers.end(),
                                  [&](const DrawingLayer& known) { return known.name == wanted.name; });
  if (found != layers.end()) return static_cast<std::size_t>(found - layers.begin());
  layers.push_back(wanted);
  return layers.size() - 1;
}

Drawing& Drawing::add(std::size_t layer, ArcPath path) {
  DrawnPath drawn;
  drawn.layer = layer;
  drawn.path = std::move(path);
  paths.push_back(std::move(drawn));
  return *this;
}

Drawing& Drawing::add(std::size_t layer, const Circle& circle) {
  circles.push_back({layer, circle});
  return *this;
}

Drawing& Drawing::add(std::size_t layer, const PlaneRegion& region) {
  add(layer, region.outline);
  for (const ArcPath& cutout : region.cutouts) add(layer, cutout);
  for (const Circle& hole : region.holes) add(layer, hole);
  return *this;
}

Drawing& Drawing::line(std::size_t layer, Vec2 from, Vec2 to) {
  return add(layer, ArcPath{{{from}, {to}}, false});
}

std::optional<PlaneBox> bounds(const Drawing& drawing) {
  std::optional<PlaneBox> whole;
  const auto include = [&](const PlaneBox& box) {
    if (!whole) whole = box;
    whole->low = {std::min(whole->low.x, box.low.x), std::min(whole->low.y, box.low.y)};
    whole->high = {std::max(whole->high.x, box.high.x), std::max(whole->high.y, box.high.y)};
  };
  for (const DrawnPath& drawn : drawing.paths) {
    if (!drawn.path.vertices.empty()) include(bounds(drawn.path));
  }
  for (const DrawnCircle& drawn : drawing.circles) {
    const Vec2 half{drawn.circle.radius, drawn.circle.radius};
    include({drawn.circle.centre - half, drawn.circle.centre + half});
  }
  return whole;
}

}  // namespace glissade
