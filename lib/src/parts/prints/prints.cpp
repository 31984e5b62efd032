#include "glissade/parts/prints.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/parts/plates.hpp"
#include "glissade/section/outline.hpp"
#include "glissade/solid/sweep.hpp"

#include "parts/bodies/as_built.hpp"
#include "parts/bodies/piece_mesh.hpp"
#include "parts/curves/nearest_place.hpp"
#include "parts/prints/print_facts.hpp"
#include "parts/prints/print_split.hpp"
#include "parts/prints/print_unit.hpp"
#include "parts/prints/stands.hpp"
#include "parts/prints/tongue.hpp"
#include "parts/shop/setting_out.hpp"
#include "parts/shop/workshop_list.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

namespace glissade {

using namespace parts;

namespace {

constexpr std::array<double, 3> kSegmentColour = {0.85, 0.45, 0.20};
constexpr std::array<double, 3> kOtherSegmentColour = {0.95, 0.65, 0.35};
constexpr std::array<double, 3> kStandColour = {0.60, 0.62, 0.66};
constexpr std::array<double, 3> kPinColour = {0.45, 0.45, 0.50};
// Facets of pieces depart no farther from the exact shape, however coarse the solid's are [m]: faces that meet are alike and holes
// keep their walls, which a printer's layers need.
constexpr double kPieceTolerance = 0.05e-3;
constexpr double kEndPlay = 0.5e-3;     // of a pin at the bottom of each hole [m]
constexpr double kFoldedVolume = 1e-6;  // relative, where levels are trimmed
constexpr double kSameFace = 1e-9;      // greatest difference of mating faces [m]

std::string count_of(std::size_t number, std::size_t of) {
  return std::to_string(number) + " of " + std::to_string(of);
}

void finish_part(const PrintJob& job, ShopPart& part, const TriangleMesh& mesh) {
  part.material = job.options.material.name;
  part.density = job.options.material.density;
  part.mass = part.volume * part.density;
  part.centre_of_gravity = part.places.front().to_space(mesh_moments(mesh).centre);
  part.body = MeshBody{mesh};
}

void add_segments(const PrintJob& job, const std::vector<PrintUnit>& units, WorkshopBuild& build) {
  for (std::size_t i = 0; i < units.size(); ++i) {
    const PrintUnit& unit = units[i];
    ShopPart part;
    part.number = static_cast<int>(i) + 1;
    part.name = "segment";
    if (units.size() > 1) part.name += "_" + std::to_string(i + 1);
    part.thickness = job.section.narrowest();
    part.colour = i % 2 == 0 ? kSegmentColour : kOtherSegmentColour;
    part.places = {place_of(job, unit.origin)};
    part.volume = unit.exact_volume - unit.eased_volume - unit.sunk_volume;
    finish_part(job, part, unit.mesh);
    build.prints.push_back({"segment " + count_of(i + 1, units.size()), std::to_string(part.number),
                            posed(unit.mesh, unit.pose)});
    build.workshop.parts.push_back(std::move(part));
  }
}

/// Pins lie half in each of two holes, with play at both ends.
void add_pins(const PrintJob& job, const std::vector<double>& joints, const Dowels& dowels,
              WorkshopBuild& build) {
  const double length = 2.0 * (dowels.depth - kEndPlay);
  const double chamfer = std::min({job.options.dowels.chamfer, 0.25 * dowels.diameter, 0.25 * length});
  const TriangleMesh mesh = round_bar(dowels.diameter, length, chamfer);
  ShopPart part;
  part.number = static_cast<int>(build.workshop.parts.size()) + 1;
  part.name = "pin";
  part.thickness = dowels.diameter;
  part.colour = kPinColour;
  const Frame track = place_of(job, {});
  const auto turned = [&](Vec2 direction) { return direction.x * track.x + direction.y * track.z; };
  for (std::size_t i = 1; i + 1 < joints.size(); ++i) {
    const TrackFrame at = frame_at(job.track, joints[i]);
    for (const Vec2 place : dowels.places) {
      const Vec2 bottom = at.at + place.y * at.up - 0.5 * length * at.along;
      part.places.push_back({job.placement.to_space(bottom.x, -bottom.y, place.x), turned(at.up),
                             -1.0 * track.y, turned(at.along)});
    }
  }
  part.volume = mesh_moments(mesh).volume;
  finish_part(job, part, mesh);
  for (std::size_t i = 0; i < part.quantity(); ++i) {
    build.prints.push_back({"pin " + count_of(i + 1, part.quantity()), std::to_string(part.number), mesh});
  }
  build.workshop.parts.push_back(std::move(part));
}

/// The part's number in the right side of a block of a stand.
TriangleMesh numbered(const PrintJob& job, TriangleMesh mesh, int number, double& taken) {
  taken = 0.0;
  if (job.options.number_depth <= 0.0) return mesh;
  Vec3 corner = mesh.vertices.front();
  for (const Vec3& vertex : mesh.vertices) {
    if (vertex.y < corner.y) corner = vertex;
  }
  const FacePlane side{corner, {1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}};
  TriangleMesh copy = mesh;
  std::vector<std::vector<Vec2>> loops;
  for (const auto& edge : take_flat_face(copy, side)) {
    loops.emplace_back();
    for (const std::uint32_t vertex : edge) loops.back().push_back(side.see(mesh.vertices[vertex]));
  }
  const std::string digits = std::to_string(number);
  const auto place = place_for_digits(FaceOutline(std::move(loops)), digits.size(), {}, 0.0);
  if (!place) return mesh;
  const auto recesses = sunk_digits(digits, place->corner, place->height, job.options.number_depth);
  for (const Recess& recess : recesses) taken += recess.volume();
  sink(mesh, side, recesses);
  drop_unused_vertices(mesh);
  return mesh;
}

void add_block(const PrintJob& job, const Stand& stand, const StandBlock& block, const std::string& name,
               WorkshopBuild& build) {
  ShopPart part;
  part.number = static_cast<int>(build.workshop.parts.size()) + 1;
  part.name = name;
  part.thickness = job.options.stands->thickness;
  part.colour = kStandColour;
  part.places = {place_of(job, {stand.x, 0.0})};
  double taken = 0.0;
  const TriangleMesh mesh = numbered(job, block.mesh, part.number, taken);
  part.volume = block.volume - taken;
  finish_part(job, part, mesh);
  Pose pose;
  pose.right = {1.0, 0.0, 0.0};
  pose.deep = {0.0, 1.0, 0.0};
  pose.up = {0.0, 0.0, 1.0};
  const auto turned = turned_to_fit(pose, mesh.vertices, job.options.split.bed);
  if (!turned) {
    const Vec3 size = size_on_bed(pose, mesh.vertices);
    const double margin = 2.0 * job.options.split.bed.gap + 1e-3;
    throw InputError({"stands",
                      "stands: the one below " + stand.what + " is " + length_text(size.x, 3) + " x " +
                          length_text(size.y, 3) + " wide, which fits the bed in no way",
                      "It is printed standing on its foot.",
                      "a bed of at least " + length_text(size.x + margin, 3) + " x " +
                          length_text(size.y + margin, 3) + ", or stands: none"});
  }
  build.prints.push_back({name, std::to_string(part.number), posed(mesh, *turned)});
  build.workshop.parts.push_back(std::move(part));
}

/// Pins upright between the blocks of stands.
void add_stand_pins(const PrintJob& job, const std::vector<Stand>& stands, WorkshopBuild& build) {
  const double length = 2.0 * (kStandPinDepth - kEndPlay);
  ShopPart part;
  part.number = static_cast<int>(build.workshop.parts.size()) + 1;
  part.name = "stand_pin";
  part.thickness = kStandPin;
  part.colour = kPinColour;
  for (const Stand& stand : stands) {
    for (const Vec3& pin : stand.pins) {
      Frame place = place_of(job, {stand.x, 0.0});
      place.origin = place.to_space(pin - Vec3{0.0, 0.0, 0.5 * length});
      part.places.push_back(place);
    }
  }
  if (part.places.empty()) return;
  const TriangleMesh mesh =
      round_bar(kStandPin, length, std::min(job.options.dowels.chamfer, 0.25 * kStandPin));
  part.volume = mesh_moments(mesh).volume;
  finish_part(job, part, mesh);
  for (std::size_t i = 0; i < part.quantity(); ++i) {
    build.prints.push_back(
        {"stand pin " + count_of(i + 1, part.quantity()), std::to_string(part.number), mesh});
  }
  build.workshop.parts.push_back(std::move(part));
}

void add_stands(const PrintJob& job, const std::vector<Stand>& stands, WorkshopBuild& build) {
  for (std::size_t i = 0; i < stands.size(); ++i) {
    const std::string name = "stand_" + std::to_string(i + 1);
    const std::vector<StandBlock>& blocks = stands[i].blocks;
    for (std::size_t k = 0; k < blocks.size(); ++k) {
      const std::string which = blocks.size() == 1 ? name : name + "_" + std::to_string(k + 1);
      add_block(job, stands[i], blocks[k], which, build);
    }
    build.workshop.setting_out.push_back(
        setting_out_point(job.track, build.joints, job.placement,
                          {"stand " + std::to_string(i + 1), stands[i].x, stands[i].ground, stands[i].at}));
  }
  add_stand_pins(job, stands, build);
  in_order(build.workshop.setting_out);
}

AsBuiltRide ride_prints(const std::vector<PrintUnit>& units, const Motion& design, const Body& body,
                        double gravity, double step) {
  std::vector<std::shared_ptr<const ArcSpline>> floors;
  for (const PrintUnit& unit : units) floors.push_back(std::make_shared<ArcSpline>(unit.line));
  return ride_units(floors, step, design, body, gravity);
}

/// Volume of the section along the whole of the arcs, by another route than that of the pieces.
double exact_volume(const PrintJob& job, bool& folded) {
  const double reach = std::max(job.section.highest(), 0.0);
  const double depth = std::min(job.section.lowest(), 0.0);
  const Span whole{0.0, job.track.length()};
  folded = folds(job.track, whole, reach) || folds(job.track, whole, depth);
  if (folded) {
    return sweep(job.track, job.section, Placement(),
                 {.tolerance = job.mesh_tolerance, .shape_triangles = 1000, .stop = job.stop})
        .exact_volume;
  }
  const double turned = job.track.direction(0.0).slope_angle - job.track.direction(whole.to).slope_angle;
  return job.section.area() * whole.to - job.section.first_moment() * turned;
}

double distance_from(const section::Stroke& stroke, Vec2 point) {
  if (stroke.arc) return std::fabs(norm(point - stroke.arc->centre()) - stroke.arc->radius);
  const Vec2 along = stroke.to - stroke.from;
  const double share = std::clamp(dot(point - stroke.from, along) / dot(along, along), 0.0, 1.0);
  return norm(point - stroke.from - share * along);
}

/// Greatest distance between the corners of a face and the outline of the section, both ways.
double mismatch(const CrossSection& section, const std::vector<Vec2>& face) {
  double most = 0.0;
  std::vector<double> nearest(face.size(), 1.0);
  for (const section::Outline& loop : section.loops()) {
    for (const section::Stroke& stroke : loop) {
      double to_corner = 1.0;
      for (std::size_t i = 0; i < face.size(); ++i) {
        nearest[i] = std::min(nearest[i], distance_from(stroke, face[i]));
        to_corner = std::min(to_corner, norm(stroke.from - face[i]));
      }
      most = std::max(most, to_corner);
    }
  }
  for (const double distance : nearest) most = std::max(most, distance);
  return most;
}

/// @return whether a point, from the joint, lies between the flanks of a tongue's notch or on them
bool in_notch(const std::vector<Vec2>& notch, double along, double height) {
  const double share = along / notch[1].x;
  const double low = notch[0].y + share * (notch[1].y - notch[0].y);
  const Vec2 bottom = notch[notch.size() - 2];
  const double high = notch.back().y + share * (bottom.y - notch.back().y);
  return along >= -kSameFace && along <= notch[1].x + kSameFace && height >= low - kSameFace &&
         height <= high + kSameFace;
}

/// Pieces keep to their side of the planes between them, but for the tongue in its notch.
void require_apart(const PrintJob& job, const std::vector<PrintUnit>& units, const Hold& hold,
                   std::size_t joint) {
  const TrackFrame at = frame_at(job.track, units[joint].span.from);
  const std::vector<Vec2> notch = hold.tongue ? hold.tongue->notch() : std::vector<Vec2>{};
  const auto past = [&](const PrintUnit& unit, double sense) {
    double most = -1.0;
    for (const Vec3& vertex : unit.mesh.vertices) {
      const Vec2 point = Vec2{vertex.x, vertex.z} + unit.origin - at.at;
      if (!notch.empty() && in_notch(notch, dot(point, at.along), dot(point, at.up))) continue;
      if (norm(point) < 4.0 * (job.section.highest() - job.section.lowest()))
        most = std::max(most, sense * dot(point, at.along));
    }
    return most;
  };
  const double most = std::max(past(units[joint - 1], 1.0), past(units[joint], -1.0));
  if (most <= kSameFace) return;
  throw InternalError(
      {"", "segments clash: one reaches " + length_text(most, 3) + " past joint " + std::to_string(joint), "",
       "another design, and a report of this one"});
}

/// @return the least distance between a tongue and its notch [m]
double gap_of(const Tongue& tongue) {
  const auto path = [](const std::vector<Vec2>& points) {
    ArcPath line;
    for (const Vec2 point : points) line.vertices.push_back({point, 0.0});
    return line;
  };
  // Roots lie in one plane, beside one another.
  std::vector<Vec2> profile = tongue.profile();
  return distance(path(profile), path(tongue.notch()));
}

/// No corner of a stand lies within the run, none of the run within a stand: they are `fit` apart.
void require_stands_clear(const PrintJob& job, const std::vector<Stand>& stands) {
  for (const Stand& stand : stands) {
    for (const Vec3& vertex : stand.blocks.back().mesh.vertices) {
      const Vec2 point{vertex.x + stand.x, vertex.z};
      const TrackFrame at = frame_at(job.track, nearest_place(job.track, {0.0, job.track.length()}, point).s);
      const double height = dot(point - at.at, at.up);
      if (std::fabs(dot(point - at.at, at.along)) > kSameFace) continue;  // beyond an end
      if (job.face.clearance({vertex.y, height}) <= 0.0) continue;
      throw InternalError({"", "the stand below " + stand.what + " reaches into the run", "", ""});
    }
  }
}

PartsProof prove_prints(const PrintJob& job, const std::vector<PrintUnit>& units, const Hold& hold,
                        const std::vector<Stand>& stands, const Workshop& workshop) {
  PartsProof proof;
  double made = 0.0;
  for (const PrintUnit& unit : units) proof.volume += unit.exact_volume;
  for (const ShopPart& part : workshop.parts) made += part.volume * static_cast<double>(part.quantity());
  proof.added_volume = made - proof.volume;
  bool folded = false;
  proof.exact_volume = exact_volume(job, folded);
  const double allowed = folded ? kFoldedVolume : kPartsVolumeAccuracy;
  if (!(std::fabs(proof.volume - proof.exact_volume) <= allowed * proof.exact_volume)) {
    throw InternalError({"",
                         "the segments hold " + rounded_text(proof.volume, 12) + " m^3, the solid " +
                             rounded_text(proof.exact_volume, 12) + " m^3",
                         "", ""});
  }
  for (std::size_t i = 1; i < units.size(); ++i) {
    require_apart(job, units, hold, i);
    proof.edge_mismatch = std::max({proof.edge_mismatch, mismatch(job.section, units[i - 1].last_face),
                                    mismatch(job.section, units[i].first_face)});
  }
  proof.pairs = units.size() - 1;
  if (!(proof.edge_mismatch <= kSameFace)) {
    throw InternalError({"", "faces of a joint differ by " + length_text(proof.edge_mismatch, 3), "", ""});
  }
  if (hold.dowels) {
    proof.smallest_gap = std::min(0.5 * job.options.dowels.fit, kEndPlay);
    proof.pairs += 2 * hold.dowels->places.size() * (units.size() - 1);
  }
  if (hold.tongue) proof.smallest_gap = gap_of(*hold.tongue);
  require_stands_clear(job, stands);
  proof.pairs += stands.size();
  return proof;
}

std::string hold_note(const PrintJob& job, const Hold& hold) {
  if (hold.dowels) {
    return "Pins of " + length_text(hold.dowels->diameter) + " in holes of " +
           length_text(hold.dowels->hole) + ", " + length_text(hold.dowels->depth) + " deep in both faces";
  }
  if (!hold.tongue) return "";
  const Tongue& tongue = *hold.tongue;
  const bool dovetail = job.options.joint == PrintJoint::dovetail;
  return std::string(dovetail ? "Dovetails" : "Tongues") + " of " +
         length_text(tongue.high - tongue.low + 2.0 * tongue.spread, 3) + " x " +
         length_text(tongue.depth, 3) + " at the lower end of each segment, in notches wider by " +
         length_text(tongue.fit) + " below and above" + (dovetail ? ": put together sideways" : "");
}

std::vector<std::string> notes_of(const PrintJob& job, const PrintPlan& plan, const Hold& hold,
                                  const std::vector<Stand>& stands) {
  std::vector<std::string> notes;
  const char* const lies = plan.kind == PrintPose::side  ? "on their side"
                           : plan.kind == PrintPose::end ? "on a joint face"
                                                         : "as they are used";
  notes.push_back("Segments are printed " + std::string(lies) + ", layers of " +
                  length_text(job.options.layer));
  if (std::string note = hold_note(job, hold); !note.empty()) notes.push_back(std::move(note));
  if (!stands.empty())
    notes.emplace_back("Stands are printed as they stand; the table of setting out has their places");
  return notes;
}

/// Joints and cuts of stands that nothing holds are glued.
void add_glue(const PrintJob& job, const Hold& hold, const std::vector<Stand>& stands, WorkshopBuild& build) {
  const std::string name = "adhesive for " + job.options.material.name;
  if (!hold.dowels && !hold.tongue)
    add_item(build.workshop, {name, "by its maker's table", build.joints.size() - 2, "joints without pins"});
  std::size_t cuts = 0;
  for (const Stand& stand : stands) {
    if (stand.pins.empty()) cuts += stand.blocks.size() - 1;
  }
  add_item(build.workshop, {name, "by its maker's table", cuts, "cuts of stands without pins"});
}

}  // namespace

WorkshopBuild make_prints(const Centerline& track, const CrossSection& section, const MasterCurveOptions& fit,
                          const PrintOptions& options, double mesh_tolerance, const Placement& placement,
                          const Body& body, double gravity, const std::stop_token& stop) {
  std::vector<Issue> problems = print_problems(section, options);
  if (!problems.empty()) throw InputError(std::move(problems));
  WorkshopBuild build;
  build.master = fit_arcs(track, fit);
  const double tolerance = std::min(mesh_tolerance, kPieceTolerance);
  const PrintJob job{
      *build.master.spline, section, FaceOutline(section, tolerance), options, tolerance, placement, stop};
  const Motion smooth(CenterlinePtr(CenterlinePtr(), &track), body, gravity);
  const PrintPlan plan = plan_prints(job);
  const Hold hold = hold_joints(job, plan);
  const std::vector<Stand> stands = make_stands(job, plan.joints, build.workshop);
  std::vector<PrintUnit> units;
  for (std::size_t i = 0; i + 1 < plan.joints.size(); ++i) {
    units.push_back(make_unit(job, plan, hold, i));
  }
  build.joints = plan.joints;
  add_segments(job, units, build);
  if (hold.dowels) add_pins(job, plan.joints, *hold.dowels, build);
  build.workshop.setting_out = setting_out(job.track, build.joints, placement);
  add_stands(job, stands, build);
  add_glue(job, hold, stands, build);
  build.workshop.tolerance = "Printed to 0.2 mm; seams off the running surface";
  build.workshop.notes = notes_of(job, plan, hold, stands);
  const double drop = hold.tongue ? hold.tongue->fit : hold.dowels ? options.dowels.fit : 0.0;
  build.ride = ride_prints(units, smooth, body, gravity, drop);
  measure_prints(job, units, hold, build.workshop);
  build.proof = prove_prints(job, units, hold, stands, build.workshop);
  return build;
}

}  // namespace glissade
