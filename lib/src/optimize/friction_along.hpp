#pragma once

#include "glissade/motion/law.hpp"
#include "glissade/motion/motion.hpp"

#include <vector>

namespace glissade::optimizer {

/// Friction that changes along the track, as a search sees it: c = mean resistance(s).
///
/// Where it changes at once, the search lets it change over kChange chords, half of them before the place, by a step
/// whose first two derivatives are continuous: a place in metres moves over the stations as the track's length
/// changes, and what jumps there has no derivatives. What friction takes over the whole change is the same; the referee,
/// which knows the places, has the last word on times and limits.
class FrictionAlong final : public Law {
 public:
  /// Over so much a friction changes, in chords. Theory: the time of a ride differs by its square; taste, beyond that: a
  /// piece of the default mesh is about as long.
  static constexpr double kChange = 0.04;

  /// @param body   with changes
  /// @param chord  the unit of length [m]
  FrictionAlong(const Body& body, double chord);

  /// @return what the friction coefficients are counted in: their mean over a chord's length; the largest where that
  ///         is 0
  [[nodiscard]] double mean() const { return mean_; }

  [[nodiscard]] std::string_view kind() const noexcept override { return "friction along the track"; }
  [[nodiscard]] Resistance resistance(double s, double v) const override;
  [[nodiscard]] LawPtr in_units(double length, double speed) const override;

 private:
  struct Step {
    double at = 0.0;
    double by = 0.0;  ///< over mean_
  };

  double mean_ = 0.0;
  double first_ = 0.0;  ///< at the start, over mean_
  double change_ = kChange;
  std::vector<Step> steps_;
};

}  // namespace glissade::optimizer
