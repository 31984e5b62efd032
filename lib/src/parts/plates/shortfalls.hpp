#pragma once

#include "glissade/parts/plate_options.hpp"
#include "glissade/parts/shop_part.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace glissade::parts {

/// Places along the track at which stiffeners are asked for, and those of them at which none stands.
class StiffenerPlaces {
 public:
  /// @param about  arc length [m]
  void ask(double about) {
    ++asked_;
    missing_.push_back(about);
  }
  /// Of the last one that was asked for.
  void found() { missing_.pop_back(); }
  /// Says which of them find no place; nothing where all do.
  void tell_missing(const PlateOptions& options, Workshop& workshop) const;

 private:
  std::size_t asked_ = 0;
  std::vector<double> missing_;
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
