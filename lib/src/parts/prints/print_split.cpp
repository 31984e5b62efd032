#include "parts/prints/print_split.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/quantity.hpp"

#include "parts/curves/nearest_place.hpp"
#include "parts/plates/calm_joints.hpp"
#include "parts/prints/tongue.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

namespace glissade::parts {
namespace {

constexpr std::size_t kMostPieces = 400;
constexpr double kLeastPiece = 2e-3;  // along the track [m]
constexpr double kRoom = 0.1;         // of a piece, by which a joint may move to where the track bends less

std::string bed_text(const PrintBed& bed) {
  return length_text(bed.x) + " x " + length_text(bed.y) + " x " + length_text(bed.z);
}

/// Nothing stands on its tongue, which is at the downstream end.
bool stands_well(const PrintJob& job, const Pose& pose, const Span& span) {
  if (pose.kind != PrintPose::end || job.options.joint == PrintJoint::dowels) return true;
  const Vec2 along = frame_at(job.track, span.from).along;
  return pose.up.x * along.x + pose.up.z * along.y > 0.0;
}

/// @return no less than the mass of a piece: its sweep along the arcs and the tongue that it has unless it is the last one [kg]
double most_mass(const PrintJob& job, PrintPose kind, const Span& span) {
  const double turned = job.track.direction(span.from).slope_angle - job.track.direction(span.to).slope_angle;
  const double swept = job.section.area() * (span.to - span.from) - job.section.first_moment() * turned;
  const double tongue = span.to < job.track.length() ? most_tongue_volume(job, kind) : 0.0;
  return (swept + tongue) * job.options.material.density;
}

bool fits(const PrintJob& job, PrintPose kind, const Span& span) {
  const PrintSplit& split = job.options.split;
  const double length = span.to - span.from;
  if (split.longest && length > *split.longest * (1.0 + 1e-12)) return false;
  if (split.heaviest && most_mass(job, kind, span) > *split.heaviest) return false;
  PrintBed bed = split.bed;
  // Points of the outline stand for the piece, and its tongue lies beyond them.
  const double reach = tongue_reach(job, kind);
  bed.gap += 1e-4 + (kind == PrintPose::end ? 0.0 : 0.5 * reach);
  if (kind == PrintPose::end) bed.z -= reach;
  const std::vector<Vec3> points = outline_points(job.track, span, job.face);
  // Flanks of a dovetail lean farther out than the piece that it stands on.
  const double flare = job.options.joint == PrintJoint::dovetail ? job.options.tongue.flare.radians() : 0.0;
  const double steepest = job.options.overhang.radians() - flare;
  for (const Pose& pose : poses_of(kind, job.track, span, job.face, job.options.layer)) {
    const bool hangs = kind == PrintPose::end && pose.overhang > steepest;
    if (!hangs && stands_well(job, pose, span) && turned_to_fit(pose, points, bed)) return true;
  }
  return false;
}

bool all_fit(const PrintJob& job, PrintPose kind, const std::vector<double>& joints) {
  for (std::size_t i = 0; i + 1 < joints.size(); ++i) {
    if (!fits(job, kind, {joints[i], joints[i + 1]})) return false;
  }
  return true;
}

/// The longest pieces one after the other; none where one would be too short.
std::optional<std::vector<double>> greedy_joints(const PrintJob& job, PrintPose kind) {
  const double length = job.track.length();
  std::vector<double> joints = {0.0};
  while (!fits(job, kind, {joints.back(), length})) {
    const double from = joints.back();
    const double least = std::min(kLeastPiece, 0.5 * (length - from));
    if (joints.size() > kMostPieces || !fits(job, kind, {from, from + least})) return std::nullopt;
    double good = from + least;
    double bad = length;
    while (bad - good > 1e-4 * length) {
      const double middle = 0.5 * (good + bad);
      (fits(job, kind, {from, middle}) ? good : bad) = middle;
    }
    joints.push_back(good);
  }
  joints.push_back(length);
  return joints;
}

std::optional<std::vector<double>> joints_for(const PrintJob& job, PrintPose kind) {
  std::optional<std::vector<double>> greedy = greedy_joints(job, kind);
  if (!greedy || greedy->size() == 2) return greedy;
  const std::size_t count = greedy->size() - 1;
  const double even = job.track.length() / static_cast<double>(count);
  for (const double room : {kRoom * even, 0.0}) {
    std::vector<double> joints = calm_joints(job.track, count, room);
    if (all_fit(job, kind, joints)) return joints;
  }
  // A remnant is shared with the piece before it.
  std::vector<double> shared = *greedy;
  shared[count - 1] = 0.5 * (shared[count - 2] + shared[count]);
  return all_fit(job, kind, shared) ? shared : greedy;
}

/// Whether the bed is not what keeps pieces from being made: the longest or heaviest one would be shorter than any.
std::optional<InputError> too_short(const PrintJob& job) {
  const PrintSplit& split = job.options.split;
  const double least = std::min(kLeastPiece, 0.5 * job.track.length());
  if (split.longest && *split.longest < least) {
    return InputError(
        {"split.longest", "longest: pieces of " + length_text(*split.longest) + " are shorter than any",
         "Pieces are at least " + length_text(least) + " long, so that their joints have a place.",
         "longest: " + length_text(10.0 * least) + ", or more"});
  }
  const double per_metre = job.section.area() * job.options.material.density;
  const double tongue = most_tongue_volume(job, PrintPose::side) * job.options.material.density;
  if (split.heaviest && *split.heaviest > tongue && *split.heaviest < tongue + per_metre * least) {
    return InputError(
        {"split.heaviest",
         "heaviest: " + quantity_text(*split.heaviest, Dimension::mass) + " is a piece of " +
             length_text((*split.heaviest - tongue) / per_metre, 3) + " along the track",
         "Pieces are at least " + length_text(least) + " long, so that their joints have a place.",
         "a larger mass, or a thinner section"});
  }
  if (split.heaviest && *split.heaviest <= tongue) {
    return InputError({"split.heaviest",
                       "heaviest: " + quantity_text(*split.heaviest, Dimension::mass) +
                           " is no more than the tongue of a joint weighs, " +
                           quantity_text(tongue, Dimension::mass),
                       "A piece and its tongue are one.", "a larger mass, or joint: dowels"});
  }
  return std::nullopt;
}

std::string_view words_of(PrintPose kind) {
  return kind == PrintPose::side  ? "on its side"
         : kind == PrintPose::end ? "on a joint face"
                                  : "as it is used";
}

/// A bed on which the track comes in pieces, little larger than it has to be; none where no size would do.
std::optional<PrintBed> bed_that_does(const PrintJob& job, PrintPose kind) {
  const double width = job.face.high().x - job.face.low().x;
  const double height = job.face.high().y - job.face.low().y;
  constexpr double kShort = 50e-3;  // a piece that is worth printing [m]
  const double margin = 2.0 * job.options.split.bed.gap;
  const double across = std::max(height, kShort);
  PrintBed bed = kind == PrintPose::side  ? PrintBed{across + margin, height + margin, width, 0.0}
                 : kind == PrintPose::end ? PrintBed{width + margin, height + margin, kShort, 0.0}
                                          : PrintBed{width + margin, across + margin, across, 0.0};
  PrintOptions options = job.options;
  const PrintJob tried{job.track,          job.section,   job.face, options,
                       job.mesh_tolerance, job.placement, job.stop};
  constexpr int kRounds = 12;
  for (int round = 0; round < kRounds; ++round) {
    // Whole millimetres, one of which is for what rounding takes.
    for (double* const side : {&bed.x, &bed.y, &bed.z}) *side = std::ceil(*side * 1e3 + 1.0) * 1e-3;
    options.split.bed = {bed.x, bed.y, bed.z, job.options.split.bed.gap};
    if (greedy_joints(tried, kind)) return bed;
    for (double* const side : {&bed.x, &bed.y, &bed.z}) *side *= 1.12;
  }
  return std::nullopt;
}

/// What to say where no pose fits.
/// @param kinds  poses that were tried
InputError no_bed(const PrintJob& job, const std::vector<PrintPose>& kinds) {
  if (const auto shorter = too_short(job)) return *shorter;
  const PrintSplit& split = job.options.split;
  std::string hint;
  for (const PrintPose kind : {PrintPose::side, PrintPose::end, PrintPose::flat}) {
    const bool tried = std::find(kinds.begin(), kinds.end(), kind) != kinds.end();
    if (tried || job.options.joint != PrintJoint::dowels || !joints_for(job, kind)) continue;
    hint = "pose: " +
           std::string(kind == PrintPose::side  ? "side"
                       : kind == PrintPose::end ? "end"
                                                : "flat") +
           ", ";
    break;
  }
  if (const auto bed = bed_that_does(job, kinds.front()))
    hint += "a bed of at least " + bed_text(*bed) + " for a piece that lies " +
            std::string(words_of(kinds.front())) + ", ";
  const std::string way = job.options.pose == PrintPose::automatic ? "whichever way it lies"
                                                                   : std::string(words_of(job.options.pose));
  return InputError({"split.bed",
                     "bed: " + bed_text(split.bed) + " is too small for the section of " +
                         length_text(job.face.high().x - job.face.low().x) + " x " +
                         length_text(job.face.high().y - job.face.low().y),
                     "No piece of the track fits it " + way + ", with a gap of " +
                         length_text(split.bed.gap) + " round it.",
                     hint + (hint.empty() ? "" : "or ") + "a smaller section"});
}

/// The least wall beside a hole, along its depth: the track bends away from it.
double wall_along(const PrintJob& job, double s, double sense, Vec2 place, double radius, double depth) {
  const TrackFrame joint = frame_at(job.track, s);
  double least = job.face.room(place) - radius;
  const Span beside{std::max(0.0, s - 2.0 * depth), std::min(job.track.length(), s + 2.0 * depth)};
  constexpr int kPlaces = 8;
  for (int k = 1; k <= kPlaces; ++k) {
    const Vec2 point = joint.at + place.y * joint.up + (sense * depth * k / kPlaces) * joint.along;
    const TrackFrame at = frame_at(job.track, nearest_place(job.track, beside, point).s);
    const double height = dot(point - at.at, at.up);
    least = std::min(least, job.face.room({place.x, height}) - radius);
  }
  return least;
}

struct ThinnestWall {
  double wall = 1e300;
  double joint = 0.0;
};

ThinnestWall thinnest_wall(const PrintJob& job, const std::vector<double>& joints, const Dowels& dowels) {
  ThinnestWall thinnest;
  for (std::size_t i = 1; i + 1 < joints.size(); ++i) {
    for (const Vec2 place : dowels.places) {
      for (const double sense : {-1.0, 1.0}) {
        const double wall = wall_along(job, joints[i], sense, place, 0.5 * dowels.hole, dowels.depth);
        if (wall < thinnest.wall) thinnest = {wall, joints[i]};
      }
    }
  }
  return thinnest;
}

double deepest_hole(const PrintJob& job, const std::vector<double>& joints) {
  double shortest = job.track.length();
  for (std::size_t i = 0; i + 1 < joints.size(); ++i)
    shortest = std::min(shortest, joints[i + 1] - joints[i]);
  return 0.5 * (shortest - job.options.wall);
}

/// The deepest holes of a diameter that keep the wall; none where not even one diameter deep ones do.
/// @param depth  none: 2.5 diameters, less where they leave too little
std::optional<Dowels> holes_of(const PrintJob& job, const std::vector<double>& joints, double diameter,
                               const std::optional<double>& depth, const std::vector<Vec2>& places) {
  const DowelOptions& asked = job.options.dowels;
  Dowels dowels{diameter, diameter + asked.fit, 0.0, 0.0, places};
  const double mouth = 0.5 * dowels.hole + asked.chamfer + std::max(0.2e-3, job.options.ease);
  for (const Vec2 place : places) {
    if (job.face.room(place) < mouth) return std::nullopt;
  }
  for (const double share : {2.5, 2.25, 2.0, 1.75, 1.5, 1.25, 1.0}) {
    dowels.depth = depth.value_or(share * diameter);
    if (dowels.depth > deepest_hole(job, joints)) continue;
    dowels.wall = thinnest_wall(job, joints, dowels).wall;
    if (dowels.wall >= job.options.wall) return dowels;
  }
  return std::nullopt;
}

constexpr std::array<double, 7> kDiameters = {6e-3, 5e-3, 4e-3, 3e-3, 2.5e-3, 2e-3, 1.5e-3};

/// Pins that do where those asked for do not: of another depth, or thinner ones. Empty: none do.
std::string other_pins(const PrintJob& job, const std::vector<double>& joints,
                       const std::vector<Vec2>& places) {
  const DowelOptions& asked = job.options.dowels;
  if (asked.diameter && asked.depth) {
    if (const auto dowels = holes_of(job, joints, *asked.diameter, std::nullopt, places))
      return "depth: " + length_text(dowels->depth) + ", ";
  }
  for (const double diameter : kDiameters) {
    if (asked.diameter && diameter >= *asked.diameter) continue;
    if (asked.diameter && holes_of(job, joints, diameter, asked.depth, places))
      return "diameter: " + length_text(diameter) + ", ";
    const auto dowels = holes_of(job, joints, diameter, std::nullopt, places);
    if (!dowels) continue;
    const std::string depth = asked.depth ? "depth: " + length_text(dowels->depth) + ", " : "";
    return asked.diameter ? "diameter: " + length_text(diameter) + (asked.depth ? " and " : ", ") + depth
                          : depth;
  }
  return "";
}

InputError thin_wall(const PrintJob& job, const std::vector<double>& joints, Dowels dowels) {
  const DowelOptions& asked = job.options.dowels;
  dowels.depth = std::min(asked.depth.value_or(dowels.diameter), deepest_hole(job, joints));
  const ThinnestWall thinnest = thinnest_wall(job, joints, dowels);
  const std::string key = asked.diameter ? "diameter" : "depth";
  const double value = asked.diameter ? *asked.diameter : *asked.depth;
  const auto [wall, least] = texts_apart(std::max(0.0, thinnest.wall), job.options.wall, &length_text, 3);
  return InputError({"dowels." + key,
                     key + ": holes of " + length_text(dowels.hole) + " leave a wall of " + wall +
                         " at the joint " + length_text(thinnest.joint) + " along the track",
                     "The printer's least wall is " + least + ", " + key + " is " + length_text(value) + ".",
                     other_pins(job, joints, dowels.places) + "a thicker section, or dowels: none"});
}

/// Pieces with tongues lie on their side where that has no overhang; else they stand on their upstream face, or, with tongues
/// that taper, lie as they are used.
std::vector<PrintPose> kinds_for_tongues(const PrintJob& job, double overhang) {
  if (overhang <= job.options.overhang.radians() + 1e-9) return {PrintPose::side};
  if (job.options.joint == PrintJoint::tongue) return {PrintPose::end, PrintPose::flat};
  if (auto issue = flare_problem(job.options)) throw InputError({std::move(*issue)});
  return {PrintPose::end};
}

}  // namespace

Hold hold_joints(const PrintJob& job, const PrintPlan& plan) {
  if (job.options.joint == PrintJoint::dowels) return {place_dowels(job, plan.joints), nullptr};
  const std::optional<Tongue> tongue = place_tongue(job, plan);
  return {std::nullopt, tongue ? std::make_shared<const Tongue>(*tongue) : nullptr};
}

std::optional<Pose> pose_on_bed(const PrintJob& job, PrintPose kind, const Span& span,
                                const std::vector<Vec3>& points) {
  for (const Pose& pose : poses_of(kind, job.track, span, job.face, job.options.layer)) {
    if (!stands_well(job, pose, span)) continue;
    if (auto turned = turned_to_fit(pose, points, job.options.split.bed)) return turned;
  }
  return std::nullopt;
}

PrintPlan plan_prints(const PrintJob& job) {
  std::vector<PrintPose> kinds = {job.options.pose};
  if (job.options.pose == PrintPose::automatic) {
    kinds = {PrintPose::side, PrintPose::end, PrintPose::flat};
    const Span whole{0.0, job.track.length()};
    const double on_side =
        poses_of(PrintPose::side, job.track, whole, job.face, job.options.layer).front().overhang;
    // A side with an overhang comes after the poses that need no support.
    if (on_side > job.options.overhang.radians() + 1e-9) kinds = {PrintPose::end, PrintPose::flat};
    if (job.options.joint != PrintJoint::dowels) kinds = kinds_for_tongues(job, on_side);
  }
  for (const PrintPose kind : kinds) {
    auto joints = joints_for(job, kind);
    if (!joints) continue;
    if (joints->size() > 2 && !job.options.split.allowed) {
      throw InputError({"split.allowed",
                        "the track takes " + std::to_string(joints->size() - 1) + " pieces on a bed of " +
                            bed_text(job.options.split.bed),
                        "Splits are not allowed.", "a larger bed, or allowed: true"});
    }
    return {kind, std::move(*joints)};
  }
  throw no_bed(job, kinds);
}

std::optional<Dowels> place_dowels(const PrintJob& job, const std::vector<double>& joints) {
  const DowelOptions& asked = job.options.dowels;
  if (!asked.wanted || joints.size() < 3) return std::nullopt;
  const std::vector<Vec2> places = {job.face.roomiest(true), job.face.roomiest(false)};
  if (asked.diameter) {
    if (auto dowels = holes_of(job, joints, *asked.diameter, asked.depth, places)) return dowels;
    throw thin_wall(job, joints, {*asked.diameter, *asked.diameter + asked.fit, 0.0, 0.0, places});
  }
  for (const double diameter : kDiameters) {
    if (auto dowels = holes_of(job, joints, diameter, asked.depth, places)) return dowels;
  }
  if (asked.depth) throw thin_wall(job, joints, {1.5e-3, 1.5e-3 + asked.fit, 0.0, 0.0, places});
  return std::nullopt;
}

}  // namespace glissade::parts
