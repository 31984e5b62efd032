#pragma once

#include "glissade/parts/print_options.hpp"
#include "glissade/solid/triangle_mesh.hpp"

#include "parts/bodies/piece_mesh.hpp"
#include "parts/prints/print_split.hpp"

#include <array>
#include <optional>
#include <vector>

namespace glissade::parts {

/// Heights between which a section is full from its left side to its right, both upright there.
struct LevelBand {
  double low = 0.0;   ///< in the frame of the section [m]
  double high = 0.0;  ///< [m]
};
/// @return the thickest such band; none where there is none
[[nodiscard]] std::optional<LevelBand> level_band(const FaceOutline& face);

/// A strip from side to side that the upstream piece has beyond the joint, and the notch for it in the downstream piece. Both
/// lie in the plane of the track: printed on their side, no layer overhangs the one below. Of pieces that stand on their upstream
/// face, or lie as they are used, strips taper towards the head by what overhangs without support; a dovetail of pieces that
/// stand keeps its form, and its notch, open below, closes in a roof as steep.
struct Tongue {
  LevelBand band;
  double low = 0.0;      ///< lower edge of the root, in the frame of the section [m]
  double high = 0.0;     ///< upper edge of the root [m]
  double spread = 0.0;   ///< by which the head is wider than the root, below and above; < 0: narrower [m]
  double depth = 0.0;    ///< [m]
  double chamfer = 0.0;  ///< of the head's edges [m]
  double fit = 0.0;      ///< by which the notch is wider below and above, and deeper [m]
  double wall = 0.0;     ///< least one left below and above the notch [m]
  double roof = 0.0;     ///< slope of the notch's roof, across per depth; 0: its bottom is flat

  /// @return how deep the notch goes [m]
  [[nodiscard]] double reach() const;
  /// @return (along the track, height) from the lower root over the head to the upper one
  [[nodiscard]] std::vector<Vec2> profile() const;
  [[nodiscard]] std::vector<Vec2> notch() const;
};

/// What speaks against tongues whatever the track is.
/// @return issues whose `where` is the key
[[nodiscard]] std::vector<Issue> tongue_problems(const CrossSection& section, const PrintOptions& options);

/// What speaks against dovetails of pieces that stand on a joint face: flanks that overhang.
[[nodiscard]] std::optional<Issue> flare_problem(const PrintOptions& options);

/// The tongue of every joint; its depth is that of the design, or the greatest up to three quarters of its height that leaves
/// the walls.
/// @throws InputError if the track bends so much, or the pieces are so short, that none does: names the joint
[[nodiscard]] std::optional<Tongue> place_tongue(const PrintJob& job, const PrintPlan& plan);
/// @return its depth before the joints are known; 0 where none are wanted
[[nodiscard]] double tongue_reach(const PrintJob& job, PrintPose kind);

/// Adds a tongue to an end face, or cuts a notch into it.
/// @param end      the face; it goes from side to side over the heights of the profile
/// @param along    of the track, downstream
/// @param profile  (along, height in the face)
/// @return the loops of the face that are left below and above, as end.see() has them
/// @throws InternalError if the face or its sides are not there
std::array<std::vector<Vec2>, 2> shape_end(TriangleMesh& mesh, const FacePlane& end, Vec3 along,
                                           const std::vector<Vec2>& profile);

/// @return the most that a tongue adds to the piece upstream of a joint [m^3]; 0 of joints with pins
[[nodiscard]] double most_tongue_volume(const PrintJob& job, PrintPose kind);
/// @return volume of a tongue, or of a notch, over a width
[[nodiscard]] double profile_volume(const std::vector<Vec2>& profile, double width);

}  // namespace glissade::parts
