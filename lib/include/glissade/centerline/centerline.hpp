#pragma once

#include <memory>
#include <string_view>
#include <vector>

namespace glissade {

/// One point of a centerline.
///
/// Frame: the vertical plane through start and finish. x runs horizontally towards the finish, y is the drop,
/// positive DOWN; the start is (0, 0).
struct CenterlinePoint {
  double arc_length = 0.0;   ///< s, from the start along the track [m]
  double x = 0.0;            ///< horizontal run from the start, positive towards the finish [m]
  double drop = 0.0;         ///< y, positive below the start [m]
  double slope_angle = 0.0;  ///< zeta, below the horizontal, positive downhill [rad]
  double curvature = 0.0;    ///< kappa = -d zeta/ds, positive in a valley (concave side up) [1/m]
};

/// Where a centerline points and how it bends: the part of a CenterlinePoint that a sliding body feels.
struct Direction {
  double slope_angle = 0.0;  ///< zeta [rad], as in CenterlinePoint
  double curvature = 0.0;    ///< kappa [1/m], as in CenterlinePoint
};

/// Where a track leads: the finish as seen from the start.
struct Endpoints {
  double run = 0.0;   ///< L, horizontal distance [m]; its sign is the side, positive to the right
  double drop = 0.0;  ///< H, positive where the finish lies below the start [m]

  friend bool operator==(const Endpoints&, const Endpoints&) = default;
};

/// What the longer of run and drop may be for a closed form of the fastest track or a cycloid [m]; squares and
/// quotients of what they are found by stay within the range of numbers.
inline constexpr double kShortestWay = 1e-200;
inline constexpr double kLongestWay = 1e200;
/// What gravity may be for tracks and rides [m/s^2]: with it, speeds and times of all such ways are numbers.
inline constexpr double kWeakestGravity = 1e-100;
inline constexpr double kStrongestGravity = 1e100;
/// The highest friction coefficient of those closed forms, 89.994 deg.
inline constexpr double kRoughest = 1e4;

/// A curve in the vertical plane, by arc length: what a body slides on and what a solid is built along.
///
/// Curve: dx = cos(zeta) ds, dy = sin(zeta) ds (docs/theory.md, frame); position and slope angle are
///   continuous, curvature is smooth between neighbouring `breaks()`. Curvature may be unbounded at s = 0
///   like s^(-1/2), see `unbounded_curvature_at_start()`.
/// Identity: every derived class is immutable after construction and safe to read from several threads.
class Centerline {
 public:
  virtual ~Centerline() = default;

  /// @return the word that a design file uses for this kind, e.g. "fastest"
  [[nodiscard]] virtual std::string_view kind() const noexcept = 0;

  /// @return arc length from start to finish [m]; finite, > 0
  [[nodiscard]] virtual double length() const noexcept = 0;

  /// @param s  arc length [m]; 0 <= s <= length()
  /// @return the point there; at a jump of curvature the value that holds just after it
  /// @throws InputError if s lies outside the track
  [[nodiscard]] virtual CenterlinePoint at(double s) const = 0;

  /// Slope angle alone; the same number as at(s).slope_angle, cheaper where a kind can.
  [[nodiscard]] virtual double slope_angle(double s) const { return at(s).slope_angle; }

  /// Slope angle and curvature alone; the same numbers as at(s) gives, cheaper where a kind can.
  [[nodiscard]] virtual Direction direction(double s) const;

  /// @return ascending arc lengths [m] between which curvature is smooth; first 0, last length()
  [[nodiscard]] virtual std::vector<double> breaks() const;

  /// @return true where curvature grows without bound towards the start (a vertical, fastest start)
  [[nodiscard]] virtual bool unbounded_curvature_at_start() const noexcept { return false; }

  /// Arc length of the point at a given run: the way back from position to arc length.
  /// @param x  run [m]; one that the track passes, so 0 to the run of the finish, and more where it overhangs
  /// @return the smallest arc length whose at(s).x is x to kRunAccuracy * length(). Where the track is
  ///         vertical its run says little about arc length: an error dx in x means dx / cos(zeta) in s.
  /// @throws InputError if no point of the track has that run
  [[nodiscard]] virtual double arc_length_at_run(double x) const;

  /// @return run and drop of the finish [m]; the run as the curve sees it, so positive towards the finish
  [[nodiscard]] Endpoints endpoints() const;

 protected:
  /// For derived classes: the check that at() owes its caller.
  /// @throws InputError unless 0 <= s <= length()
  void require_on_track(double s) const;

  Centerline() = default;
  Centerline(const Centerline&) = default;
  Centerline(Centerline&&) = default;
  Centerline& operator=(const Centerline&) = default;
  Centerline& operator=(Centerline&&) = default;
};

/// Stated bound of |at(arc_length_at_run(x)).x - x| / length().
inline constexpr double kRunAccuracy = 1e-15;

/// How centerlines travel from one stage to the next.
using CenterlinePtr = std::shared_ptr<const Centerline>;

}  // namespace glissade
