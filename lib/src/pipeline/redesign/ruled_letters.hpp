#pragma once

#include "glissade/design/design.hpp"
#include "glissade/pipeline/rules.hpp"
#include "glissade/trades/ski_jump/redesign.hpp"

#include <optional>

namespace glissade::pipeline {

/// A bound of a letter and the rule that sets it.
struct RuledBound {
  double value = 0.0;
  const Rule* rule = nullptr;
  double by_speed = 0.0;  ///< d(value)/d(v0), of a rule that counts with v0 or with the speed of a ride
};

struct RuledLetters {
  std::optional<RuledBound> steepest;  ///< gamma at most
  std::optional<RuledBound> radius;    ///< r1 at least
  std::optional<RuledBound> table;     ///< t at least
};

/// Takes a bound of a rule where it asks for more than the one that is known.
/// @param sign  1 of a bound that is lowest, -1 of one that is highest
void tighten(std::optional<RuledBound>& bound, double value, const Rule& rule, double sign,
             double by_speed = 0.0);

/// @return whether all conditions of a rule are met
[[nodiscard]] bool applies(const Rule& rule, const Measurements& measurements);

/// @param v0  the speed that the rules size table and transition by [m/s]
[[nodiscard]] RuledLetters ruled_letters(const Design& design, const Measurements& measurements, double v0);

/// A letter that a rule bounds may take any value within it; of the others each stays.
[[nodiscard]] LetterBounds bounds_of(const RuledLetters& ruled);

}  // namespace glissade::pipeline
