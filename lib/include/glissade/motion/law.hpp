#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

namespace glissade {

/// How strongly a law resists: c of docs/theory.md, laws of motion, over the friction coefficient mu, and its
/// derivatives by v = u^2 and by arc length.
struct Resistance {
  double factor = 1.0;  ///< c/mu
  double by_v = 0.0;    ///< [s^2/m^2]
  double by_v_v = 0.0;  ///< [s^4/m^4]
  double by_s = 0.0;    ///< [1/m]
  double by_s_v = 0.0;  ///< [s^2/m^3]
  double by_s_s = 0.0;  ///< [1/m^2]
};

/// What people are told of a quantity that is held against its bound while the ride goes on.
struct LawVerdict {
  std::string_view check;   ///< a sentence that is true where it is kept: "The ball rolls and does not slip"
  std::string_view kept;    ///< "it does not slip"
  std::string_view broken;  ///< "the ball slips"
  std::string_view why;     ///< what that means for the ride
  std::string_view hint;    ///< what to try
};

/// What a law has to say beyond speed, time and load: a column of a ride.
struct LawQuantity {
  std::string_view key;   ///< as in JSON, e.g. "friction_needed"
  std::string_view name;  ///< as in texts, e.g. "friction that rolling needs"
  std::string_view unit;  ///< "m", "rad"; empty for a number
  /// What it must not exceed for the law to hold, if anything.
  std::optional<double> highest;
  bool ends_ride = false;  ///< beyond `highest` the ride is not told; otherwise it goes on, and a check fails
  std::optional<LawVerdict> verdict =
      {};  ///< of one that does not end the ride, whether or not there is a bound
};

/// The body at a place of a track, as a law's quantities are computed from it. Per unit mass, SI.
struct LawState {
  double arc_length = 0.0;
  double slope_angle = 0.0;
  double curvature = 0.0;
  double v = 0.0;            ///< squared speed of the centre of mass [m^2/s^2]
  double normal_load = 0.0;  ///< N [m/s^2]
  double friction = 0.0;     ///< mu there
  double drive = 0.0;        ///< g sin(zeta) less drag [m/s^2]
};

/// What the resistance of a sliding body is called where it is an angle.
inline constexpr std::string_view kFrictionAngleName = "friction angle";

class Law;
/// How laws travel; none stands for the sliding point, Coulomb's law.
using LawPtr = std::shared_ptr<const Law>;

/// How a body resists being moved along a track, beside its Body's friction, drag and wind: what makes a ball,
/// a rider or a stream of grain different from a sliding point.
///
/// With h the height of the centre of mass above the track and v the square of its speed (docs/theory.md, laws
/// of motion):
///   dv/ds = (2/f) [(1 - kappa h) (g sin(zeta) - k D(v)) - c ((1 - kappa h) g cos(zeta) + kappa v)]
///   N     = g cos(zeta) + kappa v/(1 - kappa h),  dt/ds = (1 - kappa h)/sqrt(v),  c = mu resistance(s, v)
/// where D(v) = v without wind; below a hood (side() = -1) the parenthesis after c and N change their sign. A law says what f, h and c are, where it ends, and which quantities it adds.
/// Identity: f v/2 + losses = g (drop of the centre) + f v(0)/2.
/// A new law is a class derived from this one; Motion and optimize() need not know it.
class Law {
 public:
  virtual ~Law() = default;

  /// @return the word that a design file uses, e.g. "rolling"
  [[nodiscard]] virtual std::string_view kind() const noexcept = 0;

  /// @return what its resistance is called where it is told as an angle
  [[nodiscard]] virtual std::string_view resistance_angle_name() const noexcept { return kFrictionAngleName; }

  /// @return f, inertia over mass; >= 1
  [[nodiscard]] virtual double inertia() const noexcept { return 1.0; }
  /// @return h, height of the centre of mass above the track [m]; >= 0. A valley whose radius is not larger
  ///         ends the ride.
  [[nodiscard]] virtual double centre_height() const noexcept { return 0.0; }

  /// @return 1 of what lies on the track; -1 of what runs below it, pressed outwards against the concave underside of a
  ///         hood: N is then -(g cos(zeta) + kappa v), and it leaves the track where that falls below 0
  [[nodiscard]] virtual double side() const noexcept { return 1.0; }

  /// @return true if c depends on the speed: the equation is then not linear in v
  [[nodiscard]] virtual bool depends_on_speed() const noexcept { return false; }
  /// @param s  arc length [m]
  /// @param v  squared speed [m^2/s^2]; > 0
  [[nodiscard]] virtual Resistance resistance(double s, double v) const;
  /// @return ascending arc lengths between which c is smooth along the track [m]; those of the track itself
  ///         are left out
  [[nodiscard]] virtual std::vector<double> breaks() const { return {}; }

  /// @return the quantities that quantity() tells, in order
  [[nodiscard]] virtual std::vector<LawQuantity> quantities() const { return {}; }
  /// @return a quantity's value; +infinity where it has no bound
  [[nodiscard]] virtual double quantity(std::size_t index, const LawState& state) const;

  /// Squared speed at and below which the ride ends, because a quantity is beyond its bound; 0 if none does.
  [[nodiscard]] virtual double least_v(double s) const;
  /// Squared speed at which the quantity is at its bound: least_v(), or less where the ride ends a little before, with no way
  /// left that would count.
  [[nodiscard]] virtual double bound_v(double s) const { return least_v(s); }
  /// @return the quantity that is at its bound where v is bound_v()
  [[nodiscard]] virtual std::size_t ending_quantity() const { return 0; }

  /// The same law on a track that is the rest of this one.
  /// @param s  where that begins [m]
  /// @return none: the law is the same everywhere
  [[nodiscard]] virtual LawPtr from(double s) const;

  /// The same law measured in other units, for a search without dimensions.
  /// @param length  the new unit of length [m]; > 0
  /// @param speed   the new unit of speed [m/s]; > 0
  [[nodiscard]] virtual LawPtr in_units(double length, double speed) const = 0;

 protected:
  Law() = default;
  Law(const Law&) = default;
  Law(Law&&) = default;
  Law& operator=(const Law&) = default;
  Law& operator=(Law&&) = default;
};

}  // namespace glissade
