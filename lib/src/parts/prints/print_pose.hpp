#pragma once

#include "glissade/parts/arc_spline.hpp"
#include "glissade/parts/print_options.hpp"
#include "glissade/solid/triangle_mesh.hpp"

#include "parts/bodies/joint_face.hpp"
#include "parts/curves/offset_line.hpp"

#include <optional>
#include <vector>

namespace glissade::parts {

/// The axes of a bed in the frame of a piece (x along the run, y across, z up), with what the pose costs.
struct Pose {
  PrintPose kind = PrintPose::side;
  Vec3 right{1.0, 0.0, 0.0};  ///< of the bed
  Vec3 deep{0.0, 1.0, 0.0};
  Vec3 up{0.0, 0.0, 1.0};
  double overhang = 0.0;  ///< steepest lean of an underside from upright [rad]
  double step = 0.0;      ///< of the layers on the run surface, square to it [m]
};

/// The ways in which a stretch of track may lie on a bed, for one kind of pose; the one with less overhang first.
[[nodiscard]] std::vector<Pose> poses_of(PrintPose kind, const ArcSpline& track, const Span& span,
                                         const FaceOutline& face, double layer);

/// Turns a pose about the vertical until points fit the bed.
/// @param points  in the frame of the piece
/// @return none where no angle (of whole degrees) does
[[nodiscard]] std::optional<Pose> turned_to_fit(Pose pose, const std::vector<Vec3>& points,
                                                const PrintBed& bed);
/// @return size of what the points fill along the axes of the bed
[[nodiscard]] Vec3 size_on_bed(const Pose& pose, const std::vector<Vec3>& points);

/// Corners of the section along a stretch of track, in the frame of the track (x, across, height).
[[nodiscard]] std::vector<Vec3> outline_points(const ArcSpline& track, const Span& span,
                                               const FaceOutline& face);

/// @return the mesh on the bed: its lowest point at 0, its lower left corner at the origin
[[nodiscard]] TriangleMesh posed(const TriangleMesh& mesh, const Pose& pose);

}  // namespace glissade::parts
