// One piece of a print: the sweep of its own stretch of arcs, its end faces sunk with holes and its number, the edge that a
// body meets eased.

#include "parts/prints/print_unit.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/section/outline.hpp"
#include "glissade/solid/mesh_facts.hpp"
#include "glissade/solid/sweep.hpp"

#include "parts/bodies/piece_mesh.hpp"
#include "parts/prints/tongue.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

namespace glissade::parts {
namespace {

constexpr double kOnFace = 1e-9;               // [m]
constexpr std::size_t kShapeTriangles = 4000;  // well shaped facets are none of a slicer's business

Vec3 upright(Vec2 direction) {
  return {direction.x, 0.0, direction.y};
}

/// The piece's floor line, with a joint of its arcs where the eased edge ends.
ArcSpline line_of(const PrintJob& job, const Span& span, double ease) {
  ArcPath path = *offset_line(job.track, span, 0.0);
  const Vec2 origin = path.vertices.front().at;
  for (PathVertex& vertex : path.vertices) vertex.at = vertex.at - origin;
  const PathPiece first = pieces_of(path).front();
  const double share = ease / length(first);
  if (ease > 0.0 && share < 0.5) {
    const double quarter = math::atan(first.bulge);
    path.vertices.front().bulge = math::tan(quarter * share);
    path.vertices.insert(path.vertices.begin() + 1,
                         {point_on(first, share), math::tan(quarter * (1.0 - share))});
  }
  return ArcSpline(std::move(path));
}

FacePlane face_at(const ArcSpline& line, bool downstream) {
  const TrackFrame at = frame_at(line, downstream ? line.length() : 0.0);
  return {upright(at.at), {0.0, downstream ? 1.0 : -1.0, 0.0}, upright(at.up)};
}

/// Corners of an end face in the frame of the section.
std::vector<Vec2> corners_in(const TriangleMesh& mesh, const FacePlane& plane) {
  const std::vector<bool> in_plane = vertices_in(mesh, plane);
  std::vector<Vec2> corners;
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    if (!in_plane[i]) continue;
    const Vec2 seen = plane.see(mesh.vertices[i]);
    corners.push_back({plane.right.y * seen.x, seen.y});
  }
  return corners;
}

/// Which way out of the material the run surface faces at a corner of the section; nothing where it is none of it.
Vec2 out_of_floor(const CrossSection& section, Vec2 corner) {
  constexpr double kOn = 1e-7;  // [m]
  Vec2 sum;
  for (const section::Stroke& stroke : section.strokes(section::Side::floor)) {
    if (stroke.arc) {
      const Vec2 in = stroke.arc->centre() - corner;
      const Vec2 low = {std::min(stroke.from.x, stroke.to.x), 0.0};
      const Vec2 high = {std::max(stroke.from.x, stroke.to.x), 0.0};
      if (std::fabs(norm(in) - stroke.arc->radius) < kOn && corner.x > low.x - kOn && corner.x < high.x + kOn)
        sum = sum + (1.0 / norm(in)) * in;
      continue;
    }
    const Vec2 along = stroke.to - stroke.from;
    const double share = dot(corner - stroke.from, along) / dot(along, along);
    const double away = std::fabs(cross(along, corner - stroke.from)) / norm(along);
    if (away < kOn && share > -1e-6 && share < 1.0 + 1e-6)
      sum = sum + (1.0 / norm(along)) * Vec2{along.y, -along.x};
  }
  return norm(sum) > 0.0 ? (1.0 / norm(sum)) * sum : Vec2{};
}

/// Moves the edge of the run surface into the material.
void ease_edge(const PrintJob& job, TriangleMesh& mesh, const FacePlane& plane) {
  const std::vector<bool> in_plane = vertices_in(mesh, plane);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    if (!in_plane[i]) continue;
    const Vec2 seen = plane.see(mesh.vertices[i]);
    const Vec2 out = out_of_floor(job.section, {plane.right.y * seen.x, seen.y});
    const Vec2 in_face{plane.right.y * out.x, out.y};
    mesh.vertices[i] = mesh.vertices[i] - job.options.ease * (in_face.x * plane.right + in_face.y * plane.up);
  }
}

/// Holes for pins in a joint face.
std::vector<Recess> holes_in(const PrintJob& job, const Dowels& dowels, bool downstream, double& reach) {
  std::vector<Recess> holes;
  const double chamfer = std::min(job.options.dowels.chamfer, 0.25 * dowels.depth);
  reach = 0.5 * dowels.hole + chamfer;
  for (const Vec2 place : dowels.places) {
    holes.push_back(
        round_hole({downstream ? place.x : -place.x, place.y}, dowels.hole, dowels.depth, chamfer));
  }
  return holes;
}

/// Digits of a number in a face; none where it has no room.
/// @param mirrored  the face is seen from upstream: its number keeps to the place of the other face
std::vector<Recess> digits_in(const PrintJob& job, const FaceOutline& face, const std::string& number,
                              const std::vector<Vec2>& holes, double reach, bool mirrored, double& height) {
  if (job.options.number_depth <= 0.0) return {};
  const auto place = place_for_digits(face, number.size(), holes, reach);
  if (!place) return {};
  height = height > 0.0 ? std::min(height, place->height) : place->height;
  Vec2 corner = place->corner;
  if (mirrored) corner.x = -corner.x - width_of_digits(number.size()) * place->height;
  return sunk_digits(number, corner, place->height, job.options.number_depth);
}

void sink_all(PrintUnit& unit, const FacePlane& plane, const std::vector<Recess>& recesses) {
  for (const Recess& recess : recesses) unit.sunk_volume += recess.volume();
  sink(unit.mesh, plane, recesses);
}

/// A joint face with pins: their holes, and the piece's number.
void work_pinned(const PrintJob& job, const std::optional<Dowels>& dowels, const std::string& number,
                 const FacePlane& plane, bool downstream, PrintUnit& unit) {
  double reach = 0.0;
  std::vector<Recess> recesses;
  std::vector<Vec2> places;
  if (dowels) {
    recesses = holes_in(job, *dowels, downstream, reach);
    places = dowels->places;
  }
  for (Recess& digit : digits_in(job, job.face, number, places, reach, !downstream, unit.digit_height)) {
    recesses.push_back(std::move(digit));
  }
  sink_all(unit, plane, recesses);
}

/// A joint face with a tongue (downstream) or its notch (upstream), and the piece's number below or above.
void work_tongued(const PrintJob& job, const Tongue& tongue, const std::string& number,
                  const FacePlane& plane, bool downstream, PrintUnit& unit) {
  const std::vector<Vec2> profile = downstream ? tongue.profile() : tongue.notch();
  const Vec3 along = downstream ? plane.outward() : -1.0 * plane.outward();
  const auto faces = shape_end(unit.mesh, plane, along, profile);
  const double volume = profile_volume(profile, job.face.high().x - job.face.low().x);
  unit.sunk_volume += downstream ? -volume : volume;
  const FaceOutline left({faces.begin(), faces.end()});
  sink_all(unit, plane, digits_in(job, left, number, {}, 0.0, false, unit.digit_height));
}

/// A flat face along the piece that its number may go into: a side that is upright, or the underside of a straight piece.
struct OuterFace {
  FacePlane plane;  ///< at the middle of the piece's length and of the face's breadth
  Vec2 low;         ///< what numbers take of the section: their depth, and a wall behind it
  Vec2 high;
};

/// The longest stroke of a section's outline that lies on one side of it, as (lower end, upper end); none where none does.
std::optional<std::array<Vec2, 2>> outer_stroke(const FaceOutline& face, bool upright, double at) {
  std::optional<std::array<Vec2, 2>> longest;
  const auto off = [&](Vec2 point) { return std::fabs((upright ? point.x : point.y) - at); };
  for (const auto& loop : face.loops()) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vec2 a = loop[i];
      const Vec2 b = loop[(i + 1) % loop.size()];
      if (off(a) > kOnFace || off(b) > kOnFace) continue;
      if (longest && norm(b - a) <= norm((*longest)[1] - (*longest)[0])) continue;
      longest = {a.x + a.y < b.x + b.y ? a : b, a.x + a.y < b.x + b.y ? b : a};
    }
  }
  return longest;
}

/// Faces for a number: the left side, which is seen from where the run begins at the left, the right one, the underside.
std::vector<OuterFace> outer_faces(const PrintJob& job, const PrintUnit& unit) {
  const TrackFrame middle = frame_at(unit.line, 0.5 * unit.line.length());
  const Vec3 along = upright(middle.along);
  const double depth = job.options.number_depth + job.options.wall;
  std::vector<OuterFace> faces;
  const auto add = [&](const std::array<Vec2, 2>& stroke, Vec2 inward, Vec3 right, Vec3 up) {
    const Vec2 centre = 0.5 * (stroke[0] + stroke[1]);
    const Vec2 point = middle.at + centre.y * middle.up;
    const Vec2 back = depth * inward;
    const Vec2 edge = 1e-6 * inward;
    const Vec2 in = 1e-6 * (1.0 / norm(stroke[1] - stroke[0])) * (stroke[1] - stroke[0]);
    const Vec2 a = stroke[0] + in + edge;
    const Vec2 b = stroke[1] - in + back;
    faces.push_back({{{point.x, centre.x, point.y}, right, up},
                     {std::min(a.x, b.x), std::min(a.y, b.y)},
                     {std::max(a.x, b.x), std::max(a.y, b.y)}});
  };
  // Seen from the left, downstream lies to the left.
  if (const auto left = outer_stroke(job.face, true, job.face.high().x))
    add(*left, {-1.0, 0.0}, -1.0 * along, upright(middle.up));
  if (const auto right = outer_stroke(job.face, true, job.face.low().x))
    add(*right, {1.0, 0.0}, along, upright(middle.up));
  const std::vector<TrackArc>& arcs = unit.line.arcs();
  const bool straight =
      std::all_of(arcs.begin(), arcs.end(), [](const TrackArc& arc) { return arc.curvature == 0.0; });
  if (const auto under = outer_stroke(job.face, false, job.face.low().y); under && straight)
    add(*under, {0.0, 1.0}, {0.0, 1.0, 0.0}, along);
  return faces;
}

/// The piece's number in a flat face along it: joint faces are hidden once it is put together.
void number_outside(const PrintJob& job, const std::string& number, PrintUnit& unit) {
  if (job.options.number_depth <= 0.0) return;
  constexpr std::array<double, 7> kHeights = {8e-3, 7e-3, 6e-3, 5e-3, 4e-3, 3e-3, 2e-3};
  constexpr double kMargin = 0.6e-3;
  for (const OuterFace& outer : outer_faces(job, unit)) {
    if (!job.face.holds(outer.low, outer.high, 0.0)) continue;
    std::vector<std::vector<Vec2>> loops;
    TriangleMesh copy = unit.mesh;
    for (const std::vector<std::uint32_t>& edge : take_flat_face(copy, outer.plane)) {
      std::vector<Vec2> loop;
      for (const std::uint32_t vertex : edge) loop.push_back(outer.plane.see(unit.mesh.vertices[vertex]));
      loops.push_back(std::move(loop));
    }
    if (loops.empty()) continue;
    const FaceOutline face(std::move(loops));
    for (const double height : kHeights) {
      const Vec2 half{0.5 * width_of_digits(number.size()) * height, 0.5 * height};
      if (!face.holds(-1.0 * half, half, kMargin)) continue;
      sink_all(unit, outer.plane, sunk_digits(number, -1.0 * half, height, job.options.number_depth));
      return;
    }
  }
}

void require_sound(const TriangleMesh& mesh, const std::string& which, const std::stop_token& stop) {
  const MeshFacts facts = measure(mesh, stop);
  if (facts.valid() && facts.components == 1) return;
  const std::vector<std::string> faults = facts.faults();
  throw InternalError({which, "its mesh is faulty: " + (faults.empty() ? "several pieces" : faults.front()),
                       "A faulty mesh is never written.", "another mesh.tolerance"});
}

Pose pose_of(const PrintJob& job, PrintPose kind, const Span& span, const TriangleMesh& mesh,
             const std::string& which) {
  if (auto pose = pose_on_bed(job, kind, span, mesh.vertices)) return *pose;
  const PrintBed& bed = job.options.split.bed;
  throw InputError({"split.bed",
                    which + " fits the bed of " + length_text(bed.x) + " x " + length_text(bed.y) + " x " +
                        length_text(bed.z) + " in no way",
                    "Where the track starts upright its end face is larger than the section.",
                    "a larger bed, or longest"});
}

}  // namespace

Frame place_of(const PrintJob& job, Vec2 origin) {
  const Vec3 zero = job.placement.to_space(0.0, 0.0, 0.0);
  return {job.placement.to_space(origin.x, -origin.y, 0.0),
          job.placement.to_space(1.0, 0.0, 0.0) - zero,
          job.placement.to_space(0.0, 0.0, 1.0) - zero,
          {0.0, 0.0, 1.0}};
}

PrintUnit make_unit(const PrintJob& job, const PrintPlan& plan, const Hold& hold, std::size_t index) {
  const Span span{plan.joints[index], plan.joints[index + 1]};
  const bool joined_before = index > 0;
  const bool joined_after = index + 2 < plan.joints.size();
  const double ease = joined_before ? job.options.ease : 0.0;
  const std::string number = std::to_string(index + 1);
  const std::string which = "segment " + number;
  PrintUnit unit{
      span, line_of(job, span, ease), frame_at(job.track, span.from).at, {}, {}, 0.0, 0.0, 0.0, 0.0, {}, {}};
  Solid solid =
      sweep(unit.line, job.section, Placement(),
            {.tolerance = job.mesh_tolerance, .shape_triangles = kShapeTriangles, .stop = job.stop});
  unit.exact_volume = solid.exact_volume;
  unit.mesh = std::move(solid.mesh);
  const FacePlane before = face_at(unit.line, false);
  const FacePlane after = face_at(unit.line, true);
  unit.first_face = corners_in(unit.mesh, before);
  unit.last_face = corners_in(unit.mesh, after);
  const double swept = mesh_moments(unit.mesh).volume;
  if (ease > 0.0) ease_edge(job, unit.mesh, before);
  const double eased = mesh_moments(unit.mesh).volume;
  unit.eased_volume = swept - eased;
  const auto work = [&](const FacePlane& plane, bool downstream) {
    if (hold.tongue) {
      work_tongued(job, *hold.tongue, number, plane, downstream, unit);
    } else {
      work_pinned(job, hold.dowels, number, plane, downstream, unit);
    }
  };
  if (joined_before) work(before, false);
  if (joined_after) work(after, true);
  if (joined_before || joined_after) number_outside(job, number, unit);
  drop_unused_vertices(unit.mesh);
  const double left = mesh_moments(unit.mesh).volume;
  if (!(std::fabs(left + unit.sunk_volume - eased) <= 1e-9 * swept)) {
    throw InternalError({which, "its holes and tongues do not add up to its volume", "", ""});
  }
  require_sound(unit.mesh, which, job.stop);
  unit.pose = pose_of(job, plan.kind, span, unit.mesh, which);
  return unit;
}

}  // namespace glissade::parts
