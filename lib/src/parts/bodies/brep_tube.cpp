// A tube between two planes, with windows and holes.

#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"

#include "parts/bodies/brep_building.hpp"
#include "parts/bodies/tube_windows.hpp"

#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace glissade::parts {
namespace {

/// A closed curve round the axis of a tube where a plane z = height + x slope cuts it.
std::size_t add_ring(Brep& brep, double radius, double height, double slope, bool left) {
  BrepEdge edge;
  edge.from = add_vertex(brep, {radius, 0.0, height + radius * slope});
  edge.to = edge.from;
  edge.kind = slope == 0.0 ? CurveKind::circle : CurveKind::ellipse;
  edge.centre = {0.0, 0.0, height};
  const double stretch = math::hypot(1.0, slope);
  edge.reference = {1.0 / stretch, 0.0, slope / stretch};
  edge.axis = (left ? 1.0 : -1.0) * Vec3{-slope / stretch, 0.0, 1.0 / stretch};
  edge.radius = radius * stretch;
  edge.second_radius = radius;
  brep.edges.push_back(edge);
  return brep.edges.size() - 1;
}

}  // namespace

Brep brep_of_tube(const TubeGore& gore, const ShopPart& part) {
  const double inner = gore.inner_radius * core::kMillimetres;
  const double outer = inner + gore.thickness * core::kMillimetres;
  const double length = gore.length * core::kMillimetres;
  const double start = math::tan(gore.start_tilt.radians());
  const double end = math::tan(gore.end_tilt.radians());
  if (!(inner > 0.0) || !(outer > inner)) throw bad_body(part, "its radius or thickness is not positive");
  if (!(length - outer * std::fabs(end - start) > 0.0)) {
    throw bad_body(part, "its end planes meet inside the tube: length " + length_text(gore.length));
  }
  Brep brep;
  BrepFace bottom = ring_plane(0.0, start, false);
  BrepFace top = ring_plane(length, end, true);
  std::array<std::size_t, 2> sides{};
  for (const bool outside : {true, false}) {
    const double radius = outside ? outer : inner;
    const std::size_t low = add_ring(brep, radius, 0.0, start, outside);
    const std::size_t high = add_ring(brep, radius, length, end, outside);
    const std::size_t seam = add_line(brep, brep.edges[low].from, brep.edges[high].from);
    BrepFace face = upright_cylinder({}, kAcross, radius, outside);
    face.loops = {{{low, true}, {seam, true}, {high, false}, {seam, false}}};
    sides[outside ? 1 : 0] = brep.faces.size();
    brep.faces.push_back(std::move(face));
    bottom.loops.push_back({{low, false}});
    top.loops.push_back({{high, true}});
  }
  brep.faces.push_back(std::move(bottom));
  brep.faces.push_back(std::move(top));
  TubeMouths mouths = add_openings(brep, gore);
  for (auto& loop : mouths.inside) brep.faces[sides[0]].loops.push_back(std::move(loop));
  for (auto& loop : mouths.outside) brep.faces[sides[1]].loops.push_back(std::move(loop));
  return brep;
}

}  // namespace glissade::parts
