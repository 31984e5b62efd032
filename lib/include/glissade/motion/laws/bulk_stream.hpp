#pragma once

#include "glissade/core/units.hpp"
#include "glissade/core/width_law.hpp"
#include "glissade/motion/law.hpp"

#include <optional>
#include <vector>

namespace glissade {

/// What flows, and in what channel.
struct StreamShape {
  double mass_flow = 0.0;                  ///< Q [kg/s]; > 0
  double bulk_density = 0.0;               ///< rho [kg/m^3]; > 0
  double lateral_pressure_ratio = 0.5;     ///< K_v [-]; >= 0
  WidthLaw width;                          ///< B(s) [m]; > 0
  std::optional<double> wall_height = {};  ///< inside [m]; > 0; none: no wall to spill over
  /// K_c: speed at the floor over the mean speed; > 0, at most 1. It decides wear, not motion.
  double slip_ratio = 0.6;
  /// Slower than this a stream is taken to be choking [m/s]; > 0. One of so small a flow that it is not yet as deep as that
  /// is so within micrometres: it slows down, and rubs the more the deeper it is. Without this it would change its law within
  /// less than the last digit of a place.
  double least_speed = 1e-3;
  /// It runs on the concave underside of a hood, pressed outwards, instead of on a floor.
  bool underside = false;
};

/// A stream of bulk solid that moves as one: Roberts' lumped model of a fast, thin stream.
///
/// Continuity gives its depth H = Q/(rho B u), the side walls add to the floor's friction:
/// c = mu (1 + K_v H/B). Body::friction is the wall friction of floor and side walls.
/// Source: Roberts 1969, Roberts & Scott 1981, Roberts 2003; docs/theory.md, laws of motion.
/// Domain: H < B. Where the stream grows deeper than its chute is wide, or than its wall, it chokes and the
///   ride ends: quantity 0. A stream that slows down chokes before it would stand. It must enter with speed, since a
///   stream at rest is infinitely deep.
/// Quantities: 0 "burden_depth" H [m]; 1 "equivalent_friction" c.
class BulkStream final : public Law {
 public:
  /// Of quantities().
  static constexpr std::size_t kDepth = 0;
  static constexpr std::size_t kEquivalentFriction = 1;

  /// @throws InputError if a value breaks its stated bound
  explicit BulkStream(const StreamShape& shape);

  [[nodiscard]] const StreamShape& shape() const noexcept { return shape_; }
  /// @return B at s [m]
  [[nodiscard]] double width(double s) const;
  /// @return dB/ds at s; that after the place where it changes there
  [[nodiscard]] double width_slope(double s) const;
  /// @return the H that chokes it at s: the height of its wall, or the width where that is less [m]
  [[nodiscard]] double deepest(double s) const;
  /// @return H at s for a speed [m]
  [[nodiscard]] double depth(double s, double speed) const;
  /// W_c = Q K_c mu N/B: rubbing power per area of the floor [W/m^2]; Roberts' abrasive wear factor
  /// @param friction     of the wall
  /// @param normal_load  N [m/s^2]
  [[nodiscard]] double floor_wear(double s, Friction friction, double normal_load) const;

  [[nodiscard]] std::string_view kind() const noexcept override { return "stream"; }
  [[nodiscard]] bool depends_on_speed() const noexcept override { return true; }
  [[nodiscard]] double side() const noexcept override { return shape_.underside ? -1.0 : 1.0; }
  [[nodiscard]] Resistance resistance(double s, double v) const override;
  [[nodiscard]] std::vector<double> breaks() const override;
  [[nodiscard]] std::vector<LawQuantity> quantities() const override;
  [[nodiscard]] double quantity(std::size_t index, const LawState& state) const override;
  [[nodiscard]] double least_v(double s) const override;
  [[nodiscard]] double bound_v(double s) const override;
  [[nodiscard]] LawPtr from(double s) const override;
  [[nodiscard]] LawPtr in_units(double length, double speed) const override;

 private:
  StreamShape shape_;
  double flow_;  ///< Q/rho [m^3/s]
};

}  // namespace glissade
