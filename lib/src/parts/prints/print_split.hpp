#pragma once

#include "glissade/parts/prints.hpp"

#include "parts/bodies/joint_face.hpp"
#include "parts/prints/print_pose.hpp"

#include <memory>
#include <optional>
#include <stop_token>
#include <vector>

namespace glissade::parts {

/// Everything that the pieces of one solid are made from.
struct PrintJob {
  const ArcSpline& track;
  const CrossSection& section;
  FaceOutline face;
  const PrintOptions& options;
  double mesh_tolerance;
  const Placement& placement;
  std::stop_token stop;
};

/// Where the track is cut, and how its pieces are meant to lie.
struct PrintPlan {
  PrintPose kind = PrintPose::side;
  std::vector<double> joints;  ///< arc lengths, first 0, last the length [m]
};

/// As few pieces as bed, length and mass allow, of about even length, cut where the track bends least.
/// @throws InputError if none will do: names the bed, what does not fit, and the bed that would
[[nodiscard]] PrintPlan plan_prints(const PrintJob& job);

/// @return how a piece lies: turned to fit the bed; the pose with less overhang where two fit
[[nodiscard]] std::optional<Pose> pose_on_bed(const PrintJob& job, PrintPose kind, const Span& span,
                                              const std::vector<Vec3>& points);

/// Two holes in both faces of every joint.
struct Dowels {
  double diameter = 0.0;     ///< of the pins [m]
  double hole = 0.0;         ///< diameter [m]
  double depth = 0.0;        ///< of each hole [m]
  double wall = 0.0;         ///< least one left beside a hole [m]
  std::vector<Vec2> places;  ///< in the frame of the section
};

struct Tongue;
/// What holds the pieces at every joint.
struct Hold {
  std::optional<Dowels> dowels;
  std::shared_ptr<const Tongue> tongue;
};
/// @throws InputError as place_dowels() and place_tongue()
[[nodiscard]] Hold hold_joints(const PrintJob& job, const PrintPlan& plan);

/// @return none where none are wanted, or none fit and no diameter was asked for
/// @throws InputError if the diameter or depth of the design leaves too thin a wall: names the joint
[[nodiscard]] std::optional<Dowels> place_dowels(const PrintJob& job, const std::vector<double>& joints);

}  // namespace glissade::parts
