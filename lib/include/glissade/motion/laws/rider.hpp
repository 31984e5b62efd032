#pragma once

#include "glissade/motion/law.hpp"

namespace glissade {

/// A sliding body whose centre of mass runs at a height above the track: a skier, a toboggan with its crew.
///
/// Its centre takes the inner way through a valley, speed u (1 - kappa h) for u of the runner below it, and is
/// pressed by N = g cos(zeta) + kappa u^2 (1 - kappa h) (docs/theory.md, laws of motion).
class Rider final : public Law {
 public:
  /// @param centre_height  h [m]; finite, > 0
  /// @throws InputError if it is not
  explicit Rider(double centre_height);

  [[nodiscard]] std::string_view kind() const noexcept override { return "sliding"; }
  [[nodiscard]] double centre_height() const noexcept override { return height_; }
  [[nodiscard]] LawPtr in_units(double length, double speed) const override;

 private:
  double height_;
};

}  // namespace glissade
