#pragma once

#include "glissade/parts/plate_options.hpp"
#include "glissade/parts/shop_part.hpp"

#include "parts/plates/plate_unit.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace glissade::parts {

/// @param least  that a row keeps to [m]
/// @return a spacing that it keeps to, with some room: its places are looked for anew; "spacing: 1.34 m"
[[nodiscard]] std::string spacing_that_does(double least);

/// Gaps between stiffeners and the ends of their units that are wider than asked for.
class WideGaps {
 public:
  /// @param row  where stiffeners of the unit stand, ascending [m]
  void add(const Span& unit, const std::vector<double>& row, double spacing);
  /// Says which they are, and what to try; nothing where there are none.
  void tell(const PlateOptions& options, Workshop& workshop) const;

 private:
  std::vector<Span> gaps_;
};

/// Units of which nothing can be lifted by lugs.
class UnitsWithoutLugs {
 public:
  /// @param unit  counted from 0
  /// @param mass  [kg]
  void no_place(std::size_t unit, double mass) { add(unit, mass, no_place_); }
  void no_room(std::size_t unit, double mass) { add(unit, mass, no_room_); }
  /// Says which they are; nothing where there are none.
  /// @param take    that a pair takes along the track, welds included [m]
  /// @param folded  why a section leaves them no room, one sentence
  void tell(double take, const std::string& folded, Workshop& workshop) const;

 private:
  static void add(std::size_t unit, double mass, std::vector<std::string>& units);

  std::vector<std::string> no_place_;
  std::vector<std::string> no_room_;
};

/// Says where a unit's lugs are, and how far from plumb above its centre of gravity.
/// @param unit  counted from 0
/// @param mass  [kg]
/// @param at    along the track [m]
/// @param off   [m]
void note_lugs(std::size_t unit, double mass, double at, double off, Workshop& workshop);

}  // namespace glissade::parts
