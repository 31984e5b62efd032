#pragma once

#include "glissade/core/vec.hpp"
#include "glissade/section/cross_section.hpp"

#include <optional>
#include <string>
#include <vector>

namespace glissade::parts {

/// @return area of a polygon, positive counter-clockwise
[[nodiscard]] double area_of(const std::vector<Vec2>& corners);

/// The end face of a piece: outline and bore as polygons, in the frame of the section (across to the left, height).
class FaceOutline {
 public:
  explicit FaceOutline(const CrossSection& section, double chord_tolerance = 1e-5);
  /// @param loops  of any flat face; a point is within the material where it is inside an odd number of them
  explicit FaceOutline(std::vector<std::vector<Vec2>> loops);

  /// @return distance of a point from the edge: positive within the material [m]
  [[nodiscard]] double clearance(Vec2 at) const;
  /// @return whether a rectangle lies within the material, its edges no nearer to that of the face than `margin`
  [[nodiscard]] bool holds(Vec2 low, Vec2 high, double margin) const;
  [[nodiscard]] Vec2 low() const { return low_; }
  [[nodiscard]] Vec2 high() const { return high_; }
  [[nodiscard]] const std::vector<std::vector<Vec2>>& loops() const { return loops_; }

  /// @return the clearance on a point's own side of the middle: two holes that mirror each other share what lies between them
  [[nodiscard]] double room(Vec2 at) const;
  /// The place of most room on one side of the middle; of places nearly as good, the farthest out.
  /// @param left  across > 0, else across < 0
  [[nodiscard]] Vec2 roomiest(bool left) const;

 private:
  void measure();

  std::vector<std::vector<Vec2>> loops_;
  Vec2 low_;
  Vec2 high_;
};

/// What is sunk into a face square to it: similar rings of equal numbers of corners, each deeper than the one before.
struct Recess {
  struct Ring {
    std::vector<Vec2> corners;  ///< counter-clockwise, seen from outside the face
    double depth = 0.0;         ///< of the first one 0 [m]
  };
  std::vector<Ring> rings;

  [[nodiscard]] double volume() const;
};

/// A round blind hole, nowhere narrower than asked.
/// @param chamfer  of its mouth [m]; 0: none
[[nodiscard]] Recess round_hole(Vec2 centre, double diameter, double depth, double chamfer);

/// Digits of straight bars that touch nowhere, as on a pocket calculator.
/// @param corner  lower left corner of the first digit
/// @param height  of the digits; they are 0.6 of that wide, with 0.25 between two
[[nodiscard]] std::vector<Recess> sunk_digits(const std::string& digits, Vec2 corner, double height,
                                              double depth);
/// @return width of so many digits for each unit of height
[[nodiscard]] double width_of_digits(std::size_t count);
/// @return width of the bars for each unit of height
inline constexpr double kBarWidth = 0.13;

/// Where a number goes, and how high it is.
struct NumberPlace {
  Vec2
      corner;  ///< lower left one, in the frame of the section as seen from downstream: mirrored for the other face
  double height = 0.0;
};
/// @param keep_off  centres of round holes, of `radius`
/// @return the largest place up to 8 mm high; none where not even 2 mm fit
[[nodiscard]] std::optional<NumberPlace> place_for_digits(const FaceOutline& face, std::size_t count,
                                                          const std::vector<Vec2>& keep_off, double radius);

}  // namespace glissade::parts
