#pragma once

#include "glissade/parts/plate_options.hpp"
#include "glissade/parts/shop_part.hpp"

#include "parts/curves/offset_line.hpp"

#include <string>
#include <vector>

namespace glissade::parts {

/// Plates that are wider than the sheet is long, or than `split.widest`, are strips side by side, welded edge to edge along the
/// track.

/// Of a sheet that curved strips may take: their pattern needs more.
inline constexpr double kCurvedOfSheet = 0.95;  // taste: room for the rise of the arc

/// @return the widest that a strip of a plate may be; infinity of a plate that goes in one piece
/// @param straight  its pattern is as wide as it is; else it curves, and takes more of a sheet
[[nodiscard]] double widest_strip(double width, bool straight, const SplitOptions& split);

/// Seams across a plate in one unit, and in the next; ascending places.
struct Seams {
  std::vector<double> even;
  std::vector<double> odd;

  /// @param unit  from 0
  [[nodiscard]] const std::vector<double>& of_unit(std::size_t unit) const {
    return unit % 2 == 0 ? even : odd;
  }
};

/// By which seams of units that are welded end to end lie off even places, one way in one and the other way in the next [m].
inline constexpr double kSeamStagger = 100e-3;

/// The seams across a plate: as few as strips need, even, but off what is taken; none of a plate that goes in one piece. Of units that
/// are welded end to end they lie 200 mm or half a strip apart, less where something is taken; as many in one as in the next.
/// @param across    the plate from edge to edge
/// @param straight  as above
/// @param taken     stretches that no seam may lie in
/// @param welded    units meet without frames; else all of them have the same seams
/// @throws InputError where no seams keep off what is taken: the widest strip, and a way out
[[nodiscard]] Seams seams_across(const std::string& plate, const Span& across, bool straight,
                                 const std::vector<Span>& taken, const SplitOptions& split, bool welded);

/// @return the strips that seams leave of a plate, edge to edge
[[nodiscard]] std::vector<Span> strips_between_seams(const Span& across, const std::vector<double>& seams);

/// @return "_a", "_b", ... of a strip's name; nothing where there is one
[[nodiscard]] std::string strip_letter(std::size_t strip, std::size_t strips);

/// @param outline  of straight edges
/// @param normal   a unit vector
/// @return what of a region lies where a point's share along the normal is no less than `from`
[[nodiscard]] ArcPath part_beyond(const ArcPath& outline, Vec2 normal, double from);

/// Says how long the seams are.
void note_seams(double length, Workshop& workshop);

}  // namespace glissade::parts
