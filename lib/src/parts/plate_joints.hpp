#pragma once

#include "parts/plate_unit.hpp"

#include <optional>
#include <string>
#include <vector>

namespace glissade::parts {

/// Round a part on its sheet [m].
inline constexpr double kSheetMargin = 5e-3;

/// A unit between two joints.
struct Unit {
  Span span;
  ShopPart floor;
  std::optional<ShopPart> wall;
  FloorFace face;
  std::vector<BendStep> steps;
};

/// Units of about even length, their ends where the track bends least nearby, as few as sheet, transport and mass allow.
/// @param largest_kink  of a bent floor; whatever else the rule gives where the rule is another
/// @throws InputError naming the part and what it exceeds, where that is not to be had
[[nodiscard]] std::vector<Unit> split_units(const Job& job, double largest_kink);

/// The least turning of one bend at which the bends cost no more than their share of the exit speed; that of the rule
/// where it is another one.
[[nodiscard]] double kink_for_speed(const Job& job, const Body& body, double gravity, double design_speed);

/// @return the flats of a unit by the rule of the job
[[nodiscard]] Facets facets_of(const Job& job, const Span& span, double largest_kink);

}  // namespace glissade::parts
