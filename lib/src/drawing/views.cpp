#include "drawing/views.hpp"

#include "glissade/core/math.hpp"
#include "glissade/drawing/workshop_drawings.hpp"

#include "core/millimetres.hpp"
#include "parts/bodies/brep.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <variant>

namespace glissade {
namespace drawing {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

/// An edge in space, placed.
struct PlacedEdge {
  const parts::BrepEdge* edge;
  Vec3 from;
  Vec3 to;
  Vec3 centre;
  Vec3 axis;
  Vec3 reference;
};

Vec3 turned(const Frame& place, Vec3 direction) {
  return direction.x * place.x + direction.y * place.y + direction.z * place.z;
}

/// @return how far a round edge turns about its axis [rad]
double sweep_of(const PlacedEdge& placed) {
  if (placed.edge->from == placed.edge->to) return kTurn;
  const Vec3 a = placed.from - placed.centre;
  const Vec3 b = placed.to - placed.centre;
  const double angle = math::atan2(dot(cross(a, b), placed.axis), dot(a, b));
  return angle > 0.0 ? angle : angle + kTurn;
}

/// A round edge as the eye sees it: an arc where it looks along the axis, otherwise chords that no pen tells from it.
ArcPath seen_round(const PlacedEdge& placed, const Eye& eye) {
  const Vec3 towards_eye = cross(eye.right, eye.up);
  const double facing = dot(placed.axis, towards_eye);
  const double sweep = sweep_of(placed);
  constexpr double kAlong = 1.0 - 1e-12;
  if (placed.edge->kind != parts::CurveKind::ellipse && std::fabs(facing) > kAlong) {
    if (placed.edge->from == placed.edge->to) return path_of({eye.see(placed.centre), placed.edge->radius});
    const double bulge = bulge_of_sweep(facing > 0.0 ? sweep : -sweep);
    return {{{eye.see(placed.from), bulge}, {eye.see(placed.to)}}, false};
  }
  const Vec3 across = cross(placed.axis, placed.reference);
  const double second =
      placed.edge->kind == parts::CurveKind::ellipse ? placed.edge->second_radius : placed.edge->radius;
  const Vec3 spoke = placed.from - placed.centre;
  const double start =
      math::atan2(dot(spoke, across) / second, dot(spoke, placed.reference) / placed.edge->radius);
  const int steps = std::max(1, static_cast<int>(std::ceil(sweep / (kTurn / 72))));
  ArcPath path;
  for (int i = 0; i <= steps; ++i) {
    const auto [sine, cosine] = math::sine_cosine(start + sweep * i / steps);
    const double out = cosine * cosine * (placed.edge->rise + placed.edge->skew * sine);
    path.vertices.push_back({eye.see(placed.centre + (placed.edge->radius * cosine) * placed.reference +
                                     (second * sine) * across + out * placed.axis),
                             0.0});
  }
  return path;
}

/// A cubic edge as chords that no pen tells from it.
ArcPath seen_cubic(const parts::BrepEdge& edge, const Frame& place, const Eye& eye) {
  constexpr int kChords = 6;
  ArcPath path;
  for (int k = 0; k <= kChords; ++k) {
    const double t = static_cast<double>(k) / kChords;
    const double u = 1.0 - t;
    const Vec3 at = (u * u * u) * edge.poles[0] + (3.0 * u * u * t) * edge.poles[1] +
                    (3.0 * u * t * t) * edge.poles[2] + (t * t * t) * edge.poles[3];
    path.vertices.push_back({eye.see(place.to_space(at)), 0.0});
  }
  return path;
}

using PathKey = std::vector<std::int64_t>;

/// The same for lines that a pen would draw over each other, whichever way they run.
PathKey key_of(const ArcPath& path) {
  constexpr double kPen = 0.05;  // [mm]
  const auto whole = [&](const ArcPath& one) {
    PathKey key;
    for (const PathVertex& vertex : one.vertices) {
      key.push_back(std::llround(vertex.at.x / kPen));
      key.push_back(std::llround(vertex.at.y / kPen));
      key.push_back(std::llround(vertex.bulge * 1e4));
    }
    return key;
  };
  if (path.closed) return whole(path);
  ArcPath back = reversed(path);
  back.vertices.back().bulge = 0.0;
  ArcPath there = path;
  there.vertices.back().bulge = 0.0;
  return std::min(whole(there), whole(back));
}

bool is_point(const ArcPath& path) {
  constexpr double kNothing = 0.01;  // [mm]
  const PlaneBox box = bounds(path);
  return box.width() < kNothing && box.height() < kNothing;
}

/// An end of the track among the rows that are set out; none where nothing is.
const SettingOutPoint* end_of_track(const Workshop& workshop, std::string_view what) {
  const auto found = std::find_if(workshop.setting_out.begin(), workshop.setting_out.end(),
                                  [&](const SettingOutPoint& point) { return point.what == what; });
  return found == workshop.setting_out.end() ? nullptr : &*found;
}

Vec3 level_direction(const Workshop& workshop) {
  const SettingOutPoint* const start = end_of_track(workshop, "start");
  const SettingOutPoint* const finish = end_of_track(workshop, "finish");
  if (start == nullptr || finish == nullptr) return {1.0, 0.0, 0.0};
  const Vec3 run = finish->site - start->site;
  const double size = math::hypot(run.x, run.y);
  return size > 0.0 ? Vec3{run.x / size, run.y / size, 0.0} : Vec3{1.0, 0.0, 0.0};
}

/// @return where the track starts in the frame of the parts: at its origin, or where the site has it; whichever lies closer
///         to what is seen [m]
Vec3 start_of(const Workshop& workshop, const PlaneBox& seen, const Eye& eye) {
  const SettingOutPoint* const start = end_of_track(workshop, "start");
  if (start == nullptr) return {};
  const Vec3 on_site = start->site;
  const auto away = [&](Vec3 place) {
    const Vec2 at = core::kMillimetres * eye.see(place);
    return math::hypot(std::max({seen.low.x - at.x, at.x - seen.high.x, 0.0}),
                       std::max({seen.low.y - at.y, at.y - seen.high.y, 0.0}));
  };
  return away(on_site) < away({}) ? on_site : Vec3{};
}

Drawing whole_view(const Workshop& workshop, const Eye& eye, const std::string& name) {
  Projection projection(eye);
  for (const ShopPart& part : workshop.parts) {
    for (const Frame& place : part.places) projection.add(part, place);
  }
  return projection.drawing(name);
}

}  // namespace

namespace {

/// @return edges that only close a cylinder and are no corners: one face uses them on both sides
std::set<std::size_t> seams_of(const parts::Brep& brep) {
  std::set<std::size_t> seams;
  for (const parts::BrepFace& face : brep.faces) {
    std::set<std::size_t> seen;
    for (const std::vector<parts::BrepUse>& loop : face.loops) {
      for (const parts::BrepUse& use : loop) {
        if (!seen.insert(use.edge).second) seams.insert(use.edge);
      }
    }
  }
  return seams;
}

/// Where the side of a round tube turns away from the eye: lines between its two end curves.
std::vector<ArcPath> outlines_of(const parts::Brep& brep, const Frame& place, const Eye& eye) {
  std::vector<ArcPath> lines;
  for (const parts::BrepFace& face : brep.faces) {
    std::vector<const parts::BrepEdge*> rings;
    for (const parts::BrepUse& use : face.loops.front()) {
      const parts::BrepEdge& edge = brep.edges[use.edge];
      if (edge.from == edge.to) rings.push_back(&edge);
    }
    if (face.kind != parts::SurfaceKind::cylinder || !face.outward || rings.size() != 2) continue;
    const Vec3 axis = turned(place, face.axis);
    const Vec3 across = cross(axis, cross(eye.right, eye.up));
    constexpr double kAlong = 1e-6;
    if (norm(across) < kAlong) continue;
    for (const double side : {-1.0, 1.0}) {
      const Vec3 foot = place.to_space(face.origin) + (side * face.radius / norm(across)) * across;
      const auto end = [&](const parts::BrepEdge& ring) {
        const Vec3 normal = turned(place, ring.axis);
        const double up = dot(normal, place.to_space(ring.centre) - foot) / dot(normal, axis);
        return PathVertex{eye.see(foot + up * axis), 0.0};
      };
      lines.push_back({{end(*rings[0]), end(*rings[1])}, false});
    }
  }
  return lines;
}

/// Edges of a mesh that are seen: those at which its facets meet at an angle, and those at which a round side turns away.
/// @param towards_eye  in the frame of the mesh
std::vector<std::pair<Vec3, Vec3>> seen_edges(const TriangleMesh& mesh, Vec3 towards_eye) {
  const auto faces_eye = [&](Vec3 normal) {
    constexpr double kEdgeOn = 1e-6;
    return dot(normal, towards_eye) > kEdgeOn;
  };
  constexpr double kBlunt = 0.94;  // cosine of the angle of normals: 20 deg
  std::map<std::pair<std::uint32_t, std::uint32_t>, Vec3> normals;
  std::vector<std::pair<Vec3, Vec3>> edges;
  for (const auto& corner : mesh.triangles) {
    const Vec3 a = mesh.vertices[corner[0]];
    const Vec3 normal = cross(mesh.vertices[corner[1]] - a, mesh.vertices[corner[2]] - a);
    const Vec3 unit = (1.0 / norm(normal)) * normal;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t from = corner[i];
      const std::uint32_t to = corner[(i + 1) % 3];
      const auto other = normals.find({to, from});
      if (other == normals.end()) {
        normals[{from, to}] = unit;
      } else if (dot(unit, other->second) < kBlunt || faces_eye(unit) != faces_eye(other->second)) {
        edges.emplace_back(mesh.vertices[from], mesh.vertices[to]);
      }
    }
  }
  return edges;
}

}  // namespace

void Projection::add_mesh(const TriangleMesh& mesh, const Frame& place) {
  const Vec3 towards_eye = cross(eye_.right, eye_.up);
  const Vec3 own{dot(towards_eye, place.x), dot(towards_eye, place.y), dot(towards_eye, place.z)};
  for (const auto& [from, to] : seen_edges(mesh, own)) {
    ArcPath path{{{eye_.see(core::kMillimetres * place.to_space(from))},
                  {eye_.see(core::kMillimetres * place.to_space(to))}},
                 false};
    if (!is_point(path)) paths_.push_back(std::move(path));
  }
}

void Projection::add(const ShopPart& part, const Frame& place) {
  if (const auto* const printed = std::get_if<MeshBody>(&part.body)) return add_mesh(printed->mesh, place);
  const parts::Brep brep = parts::brep_of(part);
  Frame millimetres = place;
  millimetres.origin = core::kMillimetres * place.origin;
  for (ArcPath& line : outlines_of(brep, millimetres, eye_)) paths_.push_back(std::move(line));
  const std::set<std::size_t> seams = seams_of(brep);
  for (std::size_t i = 0; i < brep.edges.size(); ++i) {
    if (seams.contains(i)) continue;
    const parts::BrepEdge& edge = brep.edges[i];
    const PlacedEdge placed{&edge,
                            millimetres.to_space(brep.vertices[edge.from]),
                            millimetres.to_space(brep.vertices[edge.to]),
                            millimetres.to_space(edge.centre),
                            turned(place, edge.axis),
                            turned(place, edge.reference)};
    ArcPath path = edge.kind == parts::CurveKind::line
                       ? ArcPath{{{eye_.see(placed.from)}, {eye_.see(placed.to)}}, false}
                   : edge.kind == parts::CurveKind::cubic ? seen_cubic(edge, millimetres, eye_)
                                                          : seen_round(placed, eye_);
    if (!is_point(path)) paths_.push_back(std::move(path));
  }
}

Drawing Projection::drawing(const std::string& name) const {
  Drawing drawing;
  drawing.name = name;
  const std::size_t layer = drawing.layer({"EDGES", LineStyle::continuous, 0.25, 7});
  std::set<PathKey> drawn;
  for (const ArcPath& path : paths_) {
    if (drawn.insert(key_of(path)).second) drawing.add(layer, path);
  }
  return drawing;
}

Eye eye_beside(const Workshop& workshop) {
  return {level_direction(workshop), {0.0, 0.0, 1.0}};
}

Eye eye_above(const Workshop& workshop) {
  const Vec3 along = level_direction(workshop);
  return {along, {-along.y, along.x, 0.0}};
}

std::vector<MarkedPlace> marked_places(const Workshop& workshop, const PlaneBox& seen, const Eye& eye) {
  const double reach = 0.03 * std::max(seen.width(), seen.height());
  const Vec2 start = core::kMillimetres * eye.see(start_of(workshop, seen, eye));
  std::vector<MarkedPlace> places;
  for (const SettingOutPoint& point : workshop.setting_out) {
    const Vec2 at = start + core::kMillimetres * Vec2{point.x, point.z};
    const bool near = at.x >= seen.low.x - reach && at.x <= seen.high.x + reach &&
                      at.y >= seen.low.y - reach && at.y <= seen.high.y + reach;
    if (!point.what.ends_with("station") && near) places.push_back({point.what, at});
  }
  return places;
}

}  // namespace drawing

Drawing side_view(const Workshop& workshop) {
  return drawing::whole_view(workshop, drawing::eye_beside(workshop), "side view");
}

Drawing plan_view(const Workshop& workshop) {
  return drawing::whole_view(workshop, drawing::eye_above(workshop), "plan view");
}

}  // namespace glissade
