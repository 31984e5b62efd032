#pragma once

#include "glissade/centerline/centerline.hpp"
#include "glissade/motion/motion.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace glissade {

/// A speed that was measured on a hill.
struct SpeedReading {
  std::string name;         ///< of the hill or the gate, for tables
  CenterlinePtr track;      ///< from the highest start to the edge
  double from_start = 0.0;  ///< where the rides began, from the start of the track [m]
  double place = 0.0;  ///< where the speed was measured, from the start of the track [m]; above `from_start`
  double speed = 0.0;  ///< [m/s]; > 0
  Body body = {};      ///< of its design, with the wind, entry speed, friction and drag of that
  double gravity = kDefaultGravity;  ///< [m/s^2]; > 0
  double count = 1.0;                ///< how many rides it is the mean of; told, not weighted by
  std::string source = {};           ///< "speeds.csv:7", for messages; empty if it comes from no file
};

/// One reading against the fitted body.
struct SpeedResidual {
  double computed = 0.0;  ///< [m/s]
  double excess = 0.0;    ///< computed less measured [m/s]
};

/// Friction and drag that rides are best explained by.
struct SpeedFit {
  double friction = 0.0;  ///< coefficient mu; >= 0
  double drag = 0.0;      ///< k [1/m]; >= 0
  std::optional<double>
      friction_uncertainty;  ///< one standard deviation; none if it was not fitted or cannot be told; at the bound upwards
  std::optional<double> drag_uncertainty;  ///< [1/m]
  std::optional<double> correlation;       ///< of the two; none unless both were fitted
  double rms = 0.0;                        ///< of the residuals [m/s]
  std::vector<SpeedResidual> residuals;    ///< in the order of the readings
  bool friction_at_bound = false;          ///< less than none would explain them better
  bool drag_at_bound = false;
};

/// What is known beforehand.
struct SpeedFitOptions {
  std::optional<double> friction;  ///< held at this coefficient
  std::optional<double> drag;      ///< held at this [1/m]
};

/// Fits one friction and one drag to measured speeds of all hills by least squares, every reading alike: what hills differ by is
/// far more than the error of a mean. Everything else is each reading's own: height of the centre of mass, wind, entry speed,
/// gravity. Rides are the referee's, derivatives those of speed_slopes().
///
/// Uncertainties come from the scatter of the residuals (their sum of squares over readings less parameters) and the
/// derivatives; where one is at its bound, none, they are those of both as if it were not: the truth may lie beside the
/// bound, and then the other is less by what it takes. End speeds tell friction and drag apart badly: their correlation is near -1, and the sum of what both take
/// away is known much better than either.
/// @throws InputError if there are fewer readings than parameters, a reading has no track, is out of its range or a
///   twentieth above free fall (unless the wind comes from behind), a body without what is fitted does not come to its
///   place, or rides of one length to one place do not tell friction and drag apart
/// @throws ConvergenceError if the iteration does not settle
[[nodiscard]] SpeedFit fit_speeds(const std::vector<SpeedReading>& readings,
                                  const SpeedFitOptions& options = {});

/// The readings against the bodies of their own designs.
/// @throws InputError if a reading has no track, or a ride does not come to its place
[[nodiscard]] std::vector<SpeedResidual> speed_residuals(const std::vector<SpeedReading>& readings);
/// The same with one friction coefficient and one drag [1/m] for all of them.
[[nodiscard]] std::vector<SpeedResidual> speed_residuals(const std::vector<SpeedReading>& readings,
                                                         double friction, double drag);
/// Friction and drag that the designs of all readings have; none where they differ, no friction where it changes along a track.
struct CommonResistance {
  std::optional<double> friction;  ///< coefficient
  std::optional<double> drag;      ///< [1/m]
  bool friction_changes = false;   ///< along the track of one of them
};
[[nodiscard]] CommonResistance common_resistance(const std::vector<SpeedReading>& readings);

/// @return root of the mean square of the excesses [m/s]
[[nodiscard]] double rms_of(const std::vector<SpeedResidual>& residuals);

}  // namespace glissade
