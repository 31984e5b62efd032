#pragma once

#include "glissade/core/error.hpp"
#include "glissade/parts/plate_options.hpp"
#include "glissade/parts/shop_part.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace glissade::parts {

/// Frames of equal angles: one leg lies in the plane of the joint and holds the bolts, the other one stands along the channel, to
/// which it is welded. Round corners they are pieces that meet in mitres, each with bolts of its own; round sections get them rolled,
/// the leg with the bolts outwards.

/// @return radius of the fillet at the root of an equal angle (EN 10056-1) [m]; none if no such bar is rolled
[[nodiscard]] std::optional<double> root_radius(double leg, double thickness);

/// @return from the heel of an angle to the middles of its bolts: the middle
///         between its fillet and its toe [m]
[[nodiscard]] double bolt_line(const FlangeOptions& flange);

/// Appends what no shop can make of flanges of angles of these measures, whatever the section is.
void add_angle_problems(const PlateOptions& options, std::vector<Issue>& issues);

/// The outside of a section that an angle frame goes round.
struct AngleSeat {
  std::vector<Vec2> outside;  ///< convex, to its left; x across to the left, y up from the floor line
  bool ring = false;          ///< closed all round
};
/// Appends what keeps bolts from a side of it: which, and what would do.
void add_angle_seat_problems(const AngleSeat& seat, const PlateOptions& options, std::vector<Issue>& issues);

/// The pieces of the frames on one side of joints.
struct AngleFrame {
  std::vector<ShopPart> pieces;
  std::size_t bolts = 0;  ///< of one frame
  /// Of each piece, middles in the plane of the joint, in the order in which pieces and bolts go round the section [m].
  std::vector<std::vector<Vec2>> rows;
  bool closed = false;  ///< all round it
};
/// @param places  of the joints' faces: x to the left, y up, z downstream, origins on the floor line
/// @throws InputError where `flanges.pitch` if slots would stand too near each other
[[nodiscard]] AngleFrame angle_frame(const AngleSeat& seat, const PlateOptions& options, FlangeSide of_joint,
                                     const std::vector<Frame>& places);

/// Adds its pieces, cut to the lengths that bars come in, and measures how far apart its bolts are.
/// @throws InputError as angle_pieces()
void add_angle_frame(const AngleFrame& frame, FlangeSide of_joint, const PlateOptions& options,
                     Workshop& workshop);

/// @return the outside of a channel, or of a slab below it
[[nodiscard]] AngleSeat channel_seat(const ChannelMeasures& channel, const PlateOptions& options);

/// An angle rolled along a line, the leg with the bolts to the line's left; without holes.
/// @param line  of lines and arcs with common tangents: its heel
[[nodiscard]] AngleBar rolled_angle(const ArcPath& line, const FlangeOptions& flange);

/// A part of it, its holes and slots cut, drawn in the plane of the joint.
[[nodiscard]] ShopPart angle_part(const PlateOptions& options, std::string name, AngleBar bar);

/// @return where a frame's other half is seen from the far side of the joint: turned about the upright, z upstream
[[nodiscard]] Frame turned_about(const Frame& place);

/// Elongation of a rolled angle's toe: (a - c) / (r + c) of a leg a, its centroid c from the heel, rolled to the radius r at the heel.
[[nodiscard]] double elongation_of(const FlangeOptions& flange, double radius);

}  // namespace glissade::parts
