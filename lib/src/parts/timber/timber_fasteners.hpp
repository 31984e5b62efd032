#pragma once

#include "parts/timber/timber_frame.hpp"
#include "parts/timber/timber_trough.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace glissade::parts {

/// A screw for timber: EN 14592.
struct Screw {
  int diameter = 0;     ///< [mm]
  double length = 0.0;  ///< [m]

  [[nodiscard]] std::string name() const;  ///< "screw 5 x 60"
};

/// What a screw holds together.
struct ScrewedJoint {
  double fixed = 0.0;    ///< thickness of the piece below its head [m]
  double through = 0.0;  ///< of all that it goes through before the member that holds its tip [m]; >= fixed
  double into = 0.0;     ///< of that member along the screw [m]
  double edge = 0.0;     ///< distance of the screw from the nearest edge of that member [m]
};

/// Its diameter by the thickness of what is fixed, no more than a third of the distance from the edge that it is predrilled at, and 4 mm at
/// least; its tip six diameters deep, but short of the far face (EN 1995-1-1, table 8.2 and 8.7.2).
[[nodiscard]] Screw screw_for(const ScrewedJoint& joint);

/// @return screws in a row across a piece, no farther apart than `spacing`: two at least, one in a piece narrower than 50 mm
[[nodiscard]] std::size_t screws_across(double width, double spacing);

/// Screws of sheets or boards of the deck to the cross members.
void fix_deck(const TimberJob& job, const std::vector<std::vector<DeckRow>>& rows,
              const std::vector<CrossMember>& members, Workshop& workshop);

/// Screws of the strips of a lining to the templates.
void fix_lining(const TimberJob& job, const Lining& lining, const std::vector<CrossMember>& members,
                Workshop& workshop);

/// Screws from below the deck into a curb.
/// @param length  of the piece along its foot
void fix_curb(const TimberJob& job, double length, std::size_t pieces, Workshop& workshop);

/// Screws of splices on both sides of a joint of a rib.
/// @param length  of the splice
void fix_splices(const TimberJob& job, double length, std::size_t splices, Workshop& workshop);

/// How many there are of each.
struct FrameCounts {
  std::size_t members = 0;  ///< cross members or templates
  std::size_t bearers = 0;
  std::size_t leg_rows = 0;
  std::size_t boards = 0;  ///< that brace legs
};

/// Screws or brackets of cross members or templates on the bearers; heads and feet of legs; bolts of their boards.
void fix_frame(const TimberJob& job, const FrameCounts& counts, Workshop& workshop);

}  // namespace glissade::parts
