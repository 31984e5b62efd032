#include "parts/bodies/brep_contour.hpp"

#include "parts/bodies/brep_building.hpp"

#include <algorithm>
#include <utility>

namespace glissade::parts {
namespace {

BrepFace upright_face(const PathPiece& piece) {
  if (!piece.straight()) {
    const CircularArc arc = arc_of(piece);
    const Vec3 spoke = unit(at_height(piece.from - arc.centre, 0.0));
    return upright_cylinder(arc.centre, spoke, arc.radius, piece.bulge > 0.0);
  }
  const Vec2 along = piece.to - piece.from;
  BrepFace face;
  face.origin = at_height(piece.from, 0.0);
  face.axis = unit({along.y, -along.x, 0.0});
  face.reference = unit(at_height(along, 0.0));
  return face;
}

}  // namespace

std::size_t add_edge(Brep& brep, const PathPiece& piece, std::size_t from, std::size_t to) {
  if (piece.straight()) return add_line(brep, from, to);
  return add_arc(brep, from, to, arc_of(piece).centre, piece.bulge > 0.0);
}

UprightEdges add_upright(Brep& brep, const ArcPath& path, double low, double high) {
  const std::vector<PathPiece> pieces = pieces_of(path);
  UprightEdges edges;
  const auto add_pair = [&](Vec2 at) {
    edges.low_vertices.push_back(add_vertex(brep, at_height(at, low)));
    edges.high_vertices.push_back(add_vertex(brep, at_height(at, high)));
    edges.upright.push_back(add_line(brep, edges.low_vertices.back(), edges.high_vertices.back()));
  };
  for (const PathPiece& piece : pieces) add_pair(piece.from);
  if (!path.closed) add_pair(path.vertices.back().at);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const std::size_t next = (i + 1) % edges.upright.size();
    edges.low.push_back(add_edge(brep, pieces[i], edges.low_vertices[i], edges.low_vertices[next]));
    edges.high.push_back(add_edge(brep, pieces[i], edges.high_vertices[i], edges.high_vertices[next]));
    BrepFace face = upright_face(pieces[i]);
    face.loops = {{{edges.low.back(), true},
                   {edges.upright[next], true},
                   {edges.high.back(), false},
                   {edges.upright[i], false}}};
    brep.faces.push_back(std::move(face));
  }
  return edges;
}

void ContourFaces::add(const ArcPath& path) {
  const UprightEdges edges = add_upright(brep_, path, 0.0, depth_);
  std::vector<BrepUse> below;
  std::vector<BrepUse> above;
  for (const std::size_t edge : edges.low) below.push_back({edge, false});
  for (const std::size_t edge : edges.high) above.push_back({edge, true});
  std::reverse(below.begin(), below.end());
  below_.push_back(std::move(below));
  above_.push_back(std::move(above));
}

void ContourFaces::add(const Circle& hole) {
  const Vec2 start = hole.centre + Vec2{hole.radius, 0.0};
  const std::size_t low = add_vertex(brep_, at_height(start, 0.0));
  const std::size_t high = add_vertex(brep_, at_height(start, depth_));
  const std::size_t seam = add_line(brep_, low, high);
  const std::size_t bottom = add_arc(brep_, low, low, hole.centre, false);
  const std::size_t top = add_arc(brep_, high, high, hole.centre, false);
  BrepFace face = upright_cylinder(hole.centre, kAcross, hole.radius, false);
  face.loops = {{{bottom, true}, {seam, true}, {top, false}, {seam, false}}};
  brep_.faces.push_back(std::move(face));
  below_.push_back({{bottom, false}});
  above_.push_back({{top, true}});
}

void ContourFaces::close() {
  BrepFace bottom = level_plane(0.0, false);
  bottom.loops = std::move(below_);
  BrepFace top = level_plane(depth_, true);
  top.loops = std::move(above_);
  brep_.faces.push_back(std::move(bottom));
  brep_.faces.push_back(std::move(top));
}

}  // namespace glissade::parts
