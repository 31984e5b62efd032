#pragma once

#include "glissade/core/vec.hpp"
#include "glissade/parts/plate_options.hpp"
#include "glissade/section/measures.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace glissade::parts {

/// One flat plate of a section. Points are (across to the left, height above the floor line) [m].
struct SectionPlate {
  std::string name;  ///< "left_wall", "floor", "strip_3"
  Vec2 face_from;    ///< along the face that is seen from inside, or from outside of a closed outline
  Vec2 face_to;
  Vec2 back_from;  ///< on the other side
  Vec2 back_to;
  /// Edges that stay where they are where the section widens: of tiles beside other tiles.
  bool from_stays = false;
  bool to_stays = false;
  double out =
      0.0;  ///< by how much half the section is wider where its corners are told than where it is narrowest [m]

  /// Its unit direction along the face.
  [[nodiscard]] Vec2 way() const { return (1.0 / norm(face_to - face_from)) * (face_to - face_from); }
  /// Ends of its middle line.
  [[nodiscard]] Vec2 middle_from() const { return 0.5 * (face_from + back_from); }
  [[nodiscard]] Vec2 middle_to() const { return 0.5 * (face_to + back_to); }
  /// @return whether the edge beside the floor is that at `face_to`: bend schedules count along it, of both mirror images
  [[nodiscard]] bool ends_at_floor() const;
};

/// What tiles of a liner lie on, their faces where the section has its own.
struct LinedFace {
  std::size_t plate = 0;  ///< below them, the first of its strips
  Vec2 from;              ///< of the section's own face, as `face_from` and `face_to`
  Vec2 to;
  std::size_t strips = 1;  ///< into which seams along the track cut the plate
};

/// A section as flat plates that meet in mitres: from the left rim round to the right one.
struct PlateSection {
  std::vector<SectionPlate> plates;
  double thickness = 0.0;
  bool closed = false;
  bool convex = false;  ///< a frame fits round it, up to its tops
  double lowest = 0.0;
  double highest = 0.0;
  double departure = 0.0;  ///< of the plates from a round section [m]
  /// Corners of the outside, which lies to their left: from the left top below the section to the right one; of a ring all round.
  std::vector<Vec2> outside;
  bool ring = false;            ///< closed all round, with nothing to slide on outside
  bool inside_outline = false;  ///< plates lie inside a free outline, their faces are its sides
  bool mitred = true;           ///< else walls stand beside a floor, or on it, edge against face
  std::vector<std::size_t> seams =
      {};  ///< plates that are strips and meet the one before at a seam along the track
  /// Plates of every other unit, where units are welded end to end: strips whose seams lie elsewhere. None: those of all units.
  std::vector<SectionPlate> staggered = {};
  std::vector<LinedFace> lined = {};  ///< of a section that is to be lined: its plates lie farther out for it
  /// Of a floor that widens: all of the above are of its narrowest place, and corners beside the middle move out with half of it.
  std::optional<WidthLaw> widths = std::nullopt;

  /// @param unit  from 0
  [[nodiscard]] const std::vector<SectionPlate>& plates_of(std::size_t unit) const {
    return unit % 2 == 1 && !staggered.empty() ? staggered : plates;
  }
  /// @return the section as one unit has it
  [[nodiscard]] PlateSection of_unit(std::size_t unit) const;
};

/// @return a section as plates; none of curbs and free outlines whose width changes along the track
/// @param options  staves of round sections, thickness of plates round free ones, seat of walls beside a width that changes
[[nodiscard]] std::optional<PlateSection> plate_section(const section::Measures& measures,
                                                        const PlateOptions& options);

/// @return a chain of lines moved to its left, corners mitred, ends of an open one at the heights that they had
[[nodiscard]] std::vector<Vec2> moved_to_left(const std::vector<Vec2>& chain, bool closed, double by);

}  // namespace glissade::parts
