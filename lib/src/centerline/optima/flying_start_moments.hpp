#pragma once

namespace glissade::centerline {

/// The integrals of docs/theory.md, fastest track, over a range of slopes, where E(t) = (t - mu)^2 + q2 > 0.
/// Here q2 may be 0 or negative: the closed forms over the phase are written with sin(q x)/q, which passes
/// through q2 = 0 smoothly, about the middle of the range, where all terms of a sum have one sign.
struct SlopeMoments {
  double m1 = 0.0;  ///< Int dt/E
  double m2 = 0.0;  ///< Int dt/E^2
  double m3 = 0.0;  ///< Int dt/E^3
  double k2 = 0.0;  ///< Int (t - from) dt/E^2
  double k3 = 0.0;  ///< Int (t - from) dt/E^3
};

/// A slope with its E.
struct SlopeEnd {
  double slope = 0.0;
  double e = 0.0;  ///< E(slope) > 0, from where it loses no digits
};

/// @param q2    q^2 of (B4); may be negative, E > 0 between the ends
/// @param from  the smaller slope
[[nodiscard]] SlopeMoments slope_moments(double mu, double q2, const SlopeEnd& from, const SlopeEnd& to);

}  // namespace glissade::centerline
