#include "parts/bodies/brep_building.hpp"

#include "glissade/core/math.hpp"

#include <cmath>
#include <string>

namespace glissade::parts {

Vec3 at_height(Vec2 point, double z) {
  return {point.x, point.y, z};
}

Vec3 unit(Vec3 direction) {
  return (1.0 / norm(direction)) * direction;
}

InputError bad_body(const ShopPart& part, const std::string& what) {
  return InputError({"part " + std::to_string(part.number) + ", " + part.name, what, "", ""});
}

std::size_t add_vertex(Brep& brep, Vec3 point) {
  brep.vertices.push_back(point);
  return brep.vertices.size() - 1;
}

std::size_t add_line(Brep& brep, std::size_t from, std::size_t to) {
  BrepEdge edge;
  edge.from = from;
  edge.to = to;
  brep.edges.push_back(edge);
  return brep.edges.size() - 1;
}

std::size_t add_arc(Brep& brep, std::size_t from, std::size_t to, Vec2 centre, bool left) {
  BrepEdge edge;
  edge.from = from;
  edge.to = to;
  edge.kind = CurveKind::circle;
  edge.centre = at_height(centre, brep.vertices[from].z);
  edge.axis = left ? kUp : kDown;
  const Vec3 spoke = brep.vertices[from] - edge.centre;
  edge.radius = norm(spoke);
  edge.reference = unit(spoke);
  brep.edges.push_back(edge);
  return brep.edges.size() - 1;
}

std::array<Vec3, 4> helix_poles(Vec3 from, Vec3 to, Vec2 centre, double sweep) {
  // Tangents of the circle's best cubic; the climb in thirds.
  const double reach = 4.0 / 3.0 * math::tan(0.25 * sweep);
  const Vec3 climb = (1.0 / 3.0) * Vec3{0.0, 0.0, to.z - from.z};
  const auto tangent = [&](Vec3 at) { return reach * Vec3{-(at.y - centre.y), at.x - centre.x, 0.0}; };
  return {from, from + tangent(from) + climb, to - tangent(to) - climb, to};
}

std::size_t add_helix(Brep& brep, std::size_t from, std::size_t to, Vec2 centre, double sweep) {
  BrepEdge edge;
  edge.from = from;
  edge.to = to;
  edge.kind = CurveKind::cubic;
  edge.poles = helix_poles(brep.vertices[from], brep.vertices[to], centre, sweep);
  brep.edges.push_back(edge);
  return brep.edges.size() - 1;
}

BrepFace level_plane(double z, bool up) {
  BrepFace face;
  face.origin = {0.0, 0.0, z};
  face.axis = up ? kUp : kDown;
  face.reference = kAcross;
  return face;
}

BrepFace upright_cylinder(Vec2 centre, Vec3 reference, double radius, bool outward) {
  BrepFace face;
  face.kind = SurfaceKind::cylinder;
  face.origin = at_height(centre, 0.0);
  face.axis = kUp;
  face.reference = reference;
  face.radius = radius;
  face.outward = outward;
  return face;
}

BrepFace round_face(const PathPiece& piece, Vec2 from, Vec2 to) {
  const Vec2 step = to - from;
  // What is level or upright but for rounding is no cone: readers of STEP take none that flat or that steep.
  constexpr double kRounding = 1e-9;
  if (std::fabs(step.y) <= kRounding * std::fabs(step.x)) return level_plane(from.y, step.x < 0.0);
  const CircularArc arc = arc_of(piece);
  const double outward_per_left = piece.bulge > 0.0 ? -1.0 : 1.0;  // of the distance from the axis
  const bool outward = step.y * outward_per_left > 0.0;
  const Vec3 spoke = unit(at_height(piece.from - arc.centre, 0.0));
  BrepFace made = upright_cylinder(arc.centre, spoke, arc.radius + outward_per_left * from.x, outward);
  if (std::fabs(step.x) <= kRounding * std::fabs(step.y)) return made;
  const double widening = step.x * outward_per_left / step.y;  // per height
  // A cone is given where it is thinnest, and widens along its axis.
  const bool widens_up = widening > 0.0;
  const Vec2 thin = (step.y > 0.0) == widens_up ? from : to;
  made.kind = SurfaceKind::cone;
  made.axis = widens_up ? kUp : kDown;
  made.origin.z = thin.y;
  made.radius = arc.radius + outward_per_left * thin.x;
  made.half_angle = math::atan(std::fabs(widening));
  return made;
}

BrepFace flat_face(const Brep& brep, std::size_t at, std::size_t ahead, std::size_t aside) {
  const Vec3 from = brep.vertices[at];
  BrepFace made;
  made.origin = from;
  made.reference = unit(brep.vertices[ahead] - from);
  made.axis = unit(cross(brep.vertices[aside] - from, made.reference));
  return made;
}

Vec2 start_tangent(const PathPiece& piece) {
  const Vec2 along = piece.to - piece.from;
  const double b = piece.bulge;
  // The chord turned back by half the sweep: cos and sin of 2 atan(b).
  const double cosine = (1.0 - b * b) / (1.0 + b * b);
  const double sine = 2.0 * b / (1.0 + b * b);
  return (1.0 / norm(along)) * Vec2{cosine * along.x + sine * along.y, cosine * along.y - sine * along.x};
}

Vec2 end_tangent(const PathPiece& piece) {
  const PathPiece back{piece.to, piece.from, -piece.bulge};
  return -1.0 * start_tangent(back);
}

BrepFace ring_plane(double height, double slope, bool up) {
  BrepFace face;
  const double stretch = math::hypot(1.0, slope);
  face.origin = {0.0, 0.0, height};
  face.axis = (up ? 1.0 : -1.0) * Vec3{-slope / stretch, 0.0, 1.0 / stretch};
  face.reference = {1.0 / stretch, 0.0, slope / stretch};
  return face;
}

ArcPath turning(const ArcPath& path, bool left) {
  return (signed_area(path) > 0.0) == left ? path : reversed(path);
}

}  // namespace glissade::parts
