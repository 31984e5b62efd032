// A tube between two planes, with windows and holes.

#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"

#include "parts/bores.hpp"
#include "parts/brep_building.hpp"
#include "parts/tube_windows.hpp"

#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace glissade::parts {
namespace {

using Loop = std::vector<BrepUse>;

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

/// The edges of a window on one cylinder: counter-clockwise seen from outside from the corner at `from` and `low`.
struct WindowRim {
  std::array<std::size_t, 4> corners{};
  std::array<std::size_t, 4> edges{};
};

WindowRim add_rim(Brep& brep, const TubeWindow& window, double radius) {
  WindowRim rim;
  const auto corner = [&](Angle about, double along) {
    const auto [sine, cosine] = math::sine_cosine(about.radians());
    return add_vertex(brep, {radius * cosine, radius * sine, core::kMillimetres * along});
  };
  rim.corners = {corner(window.low, window.from), corner(window.high, window.from),
                 corner(window.high, window.to), corner(window.low, window.to)};
  rim.edges = {add_arc(brep, rim.corners[0], rim.corners[1], {}, true),
               add_line(brep, rim.corners[1], rim.corners[2]),
               add_arc(brep, rim.corners[2], rim.corners[3], {}, false),
               add_line(brep, rim.corners[3], rim.corners[0])};
  return rim;
}

/// The four walls of a window: two square to the axis, two through it.
void add_walls(Brep& brep, const TubeWindow& window, const WindowRim& outer, const WindowRim& inner) {
  std::array<std::size_t, 4> across{};
  for (std::size_t k = 0; k < 4; ++k) across[k] = add_line(brep, inner.corners[k], outer.corners[k]);
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t next = (k + 1) % 4;
    BrepFace face = level_plane(core::kMillimetres * (k == 0 ? window.from : window.to), k == 0);
    if (k % 2 == 1) {
      // Out of the tube is into the window: back from its upper edge, on from its lower one.
      const auto [sine, cosine] = math::sine_cosine((k == 1 ? window.high : window.low).radians());
      const double sense = k == 1 ? -1.0 : 1.0;
      face.origin = brep.vertices[inner.corners[k]];
      face.axis = {-sense * sine, sense * cosine, 0.0};
      face.reference = {cosine, sine, 0.0};
    }
    face.loops = {
        {{outer.edges[k], true}, {across[next], false}, {inner.edges[k], false}, {across[k], true}}};
    brep.faces.push_back(std::move(face));
  }
}

Loop loop_of(const WindowRim& rim, bool forward) {
  Loop loop;
  for (std::size_t k = 0; k < 4; ++k) loop.push_back({rim.edges[forward ? k : 3 - k], forward});
  return loop;
}

/// What bores_of() needs of it.
TubeGore in_millimetres(const TubeGore& gore) {
  TubeGore scaled;
  scaled.inner_radius = core::kMillimetres * gore.inner_radius;
  scaled.thickness = core::kMillimetres * gore.thickness;
  for (const TubeHole& hole : gore.holes)
    scaled.holes.push_back({core::kMillimetres * hole.along, hole.about, core::kMillimetres * hole.radius});
  return scaled;
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
  for (const TubeWindow& window : gore.windows) {
    const WindowRim rim = add_rim(brep, window, outer);
    const WindowRim inside = add_rim(brep, window, inner);
    add_walls(brep, window, rim, inside);
    brep.faces[sides[1]].loops.push_back(loop_of(rim, false));
    brep.faces[sides[0]].loops.push_back(loop_of(inside, true));
  }
  for (const Bore& bore : bores_of(in_millimetres(gore))) {
    const BoreLoops loops = add_bore(brep, bore);
    brep.faces[sides[0]].loops.push_back({loops.face});
    brep.faces[sides[1]].loops.push_back({loops.back});
  }
  return brep;
}

}  // namespace glissade::parts
