#pragma once

#include "glissade/parts/plate_options.hpp"
#include "glissade/parts/shop_part.hpp"

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

namespace glissade::parts {

/// What goes round a section in a band - frames, rings, stiffeners - is cut into pieces where the sheet, or the bar, is too short for
/// it, or it is too heavy: square to the band, halfway between two bolts, off its corners, and elsewhere than the one that it meets.

/// A line in a band, with the way along it; closed of a ring.
class BandLine {
 public:
  explicit BandLine(const ArcPath& line);

  [[nodiscard]] double length() const { return starts_.back(); }
  [[nodiscard]] bool closed() const { return closed_; }
  [[nodiscard]] const std::vector<PathPiece>& pieces() const { return pieces_; }
  /// @return how far along a piece begins
  [[nodiscard]] double begins(std::size_t piece) const { return starts_[piece]; }
  struct Place {
    std::size_t piece = 0;
    double share = 0.0;  ///< of that piece
    Vec2 at;
    Vec2 along;  ///< unit tangent
  };
  /// @param s  of a closed line any place, beyond its ends too
  [[nodiscard]] Place at(double s) const;
  /// @return what of it lies between two places, open; of a closed one on over its end where the second place comes first
  [[nodiscard]] ArcPath stretch(double from, double to) const;
  /// @return how far along it comes nearest to a point
  [[nodiscard]] double nearest(Vec2 point) const;

 private:
  std::vector<PathPiece> pieces_;
  std::vector<double> starts_;  ///< of the pieces, and the end
  bool closed_ = false;
};

inline constexpr int kMostFramePieces = 60;  ///< of one plate

/// What cuts of a band keep to.
struct BandCuts {
  std::size_t pieces = 2;
  std::vector<double> bolts;  ///< along the line, in any order
  /// One of two that meet is cut elsewhere, by one bolt.
  bool staggered = false;
  std::function<bool(double)> is_free;
};
/// @return ascending places, as near to even ones as there are; none where one of them is not to be had
[[nodiscard]] std::optional<std::vector<double>> cuts_along(const BandLine& line, const BandCuts& cuts);

/// @param cut_into  so many pieces, none where they find no cuts
/// @return the least mass of the heaviest piece, of any number of them; none where there are no cuts
[[nodiscard]] std::optional<double> lightest_pieces(
    const std::function<std::optional<std::vector<ShopPart>>(std::size_t)>& cut_into);

/// @return how far from the inner edge of a band its line lies: near the outer one, outside of what laps at corners [m]
[[nodiscard]] double line_in_band(double width);

/// Adds a plate across the track in pieces that fit the sheet, `split.frames` of them at least; where one is enough whole if
/// it fits, or if no cuts are to be had.
/// @param line  in the band, with the outside on its left; bolts stand near it
/// @throws InputError  of split.frames, if no cuts make so many pieces; of split.heaviest, if none make them light enough
void add_in_pieces(const ShopPart& plate, const ArcPath& line, bool staggered, const PlateOptions& options,
                   const std::array<double, 3>& colour, Workshop& workshop);

}  // namespace glissade::parts
