#pragma once

#include "parts/strips/strip_shape.hpp"
#include "parts/timber/timber_frame.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace glissade::parts {

/// A flat strip of the lining: a share of one side of the section, in one layer.
struct LiningStrip {
  SectionPlate plate;
  std::string name;  ///< "left_wall", "stave_4_layer_2"
  std::size_t set =
      0;  ///< of seams: twice its layer, and one more for every other strip; that in the middle is even
};
/// @return strips of all layers, the upper one first, each from the left rim to the right one
[[nodiscard]] std::vector<LiningStrip> lining_strips(const TimberJob& job);

/// What keeps a section from being lined, whatever the track is.
[[nodiscard]] std::vector<Issue> lining_problems(const TimberChannel& channel, const TimberOptions& options);

/// The lining of a trough: strips that are cut along curves from sheets or boards.
class Lining {
 public:
  /// @throws InputError where a side folds over, or its curve is cut from no sheet or board: names the place
  explicit Lining(const TimberJob& job);

  /// @return rows of each set of seams, as deck_rows() has them
  [[nodiscard]] const std::vector<std::vector<DeckRow>>& rows() const { return rows_; }
  /// @return a part a strip and row, without numbers
  [[nodiscard]] std::vector<ShopPart> parts() const;
  /// A S - M phi of the section, less gaps and what folds at an end.
  [[nodiscard]] double exact_volume() const;
  /// @return greatest difference between edges of the patterns and the lines that they become [m]
  [[nodiscard]] double edge_mismatch() const;
  /// Says how it is made, and where it is short of the track.
  void tell(Workshop& workshop) const;

 private:
  [[nodiscard]] bool fits(const LiningStrip& strip, const Span& span) const;
  [[nodiscard]] double longest_row(std::size_t set, double from) const;

  const TimberJob& job_;
  PlateOptions plate_options_;
  StripJob strip_job_;
  std::vector<LiningStrip> strips_;
  std::vector<Span> unfolded_;  ///< one a strip
  std::vector<std::vector<DeckRow>> rows_;
};

/// The template of a trough: a rectangle with the section cut out of its upper edge, from its lower right corner (x to the left).
[[nodiscard]] PlaneRegion template_region(const TimberChannel& channel, const TimberOptions& options);

}  // namespace glissade::parts
