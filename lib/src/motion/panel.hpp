#pragma once

#include "glissade/centerline/centerline.hpp"

#include "chebyshev.hpp"

namespace glissade::motion {

/// The energy equation of one body on one centerline, docs/theory.md, in the form that has a closed integral:
/// w = v e^(-2 mu zeta + 2 k s), dw/ds = push(zeta) e^(-2 mu zeta + 2 k s).
struct Equation {
  const Centerline* centerline = nullptr;
  double mu = 0.0;       ///< friction coefficient
  double k = 0.0;        ///< drag [1/m]
  double gravity = 0.0;  ///< [m/s^2]

  /// @return 2 g (sin(zeta) - mu cos(zeta)) [m/s^2]
  [[nodiscard]] double push(double zeta) const;
  /// @return e^(2 mu turn - 2 k distance): what v keeps where the slope angle grows by `turn`
  [[nodiscard]] double keep(double turn, double distance) const;
  /// @return N for v = u^2 [m/s^2]; at rest the curvature does not count, even where it is unbounded
  [[nodiscard]] double load(const Direction& direction, double v) const;
};

/// How the place on a panel, sigma in [0, width], maps to distance from the panel's anchor.
enum class Spacing {
  even,  ///< distance = sigma
  root   ///< distance = sigma (2 r + sigma), so that s and 1/u are smooth where the body starts from rest
};

/// A part of a ride that one panel may cover. It is integrated from its anchor, the end where v is known.
struct Stretch {
  double begin = 0.0;  ///< arc lengths [m]
  double end = 0.0;
  bool anchored_at_end = false;
  Spacing spacing = Spacing::even;
  double anchor_root = 0.0;  ///< r of Spacing::root at the anchor [m^(1/2)]
  double width = 0.0;        ///< sigma at the end that is not the anchor
  double smooth_end =
      0.0;  ///< where the track may next be less than smooth; curvature there is taken from before

  [[nodiscard]] static Stretch even(double begin, double end);
  /// @param r  root of the distance, before the anchor, of the point where the substituted s = r^2 begins
  [[nodiscard]] static Stretch root(double begin, double end, double r);
  /// Anchored at the end, where v must be 0.
  [[nodiscard]] static Stretch up_to_rest(double begin, double end, double smooth_end);

  [[nodiscard]] double anchor() const { return anchored_at_end ? end : begin; }
  [[nodiscard]] double distance(double sigma) const;
  [[nodiscard]] double arc_length(double sigma) const;
  [[nodiscard]] double sigma(double s) const;
  /// @return d distance/d sigma
  [[nodiscard]] double stretching(double sigma) const;

  /// @return true if there is a double between the ends for a half to end at
  [[nodiscard]] bool can_split() const;
  [[nodiscard]] Stretch half_at_anchor() const;
  [[nodiscard]] Stretch half_beyond() const;
  /// @return the part from the begin to s; for a stretch anchored there
  [[nodiscard]] Stretch cut_at(double s) const;
};

/// Time and energies that a ride adds up.
struct RideSums {
  double time = 0.0;           ///< [s]
  double load = 0.0;           ///< integral of N ds [m^2/s^2]
  double speed_squared = 0.0;  ///< integral of v ds [m^3/s^2]

  friend RideSums operator+(const RideSums& a, const RideSums& b) {
    return {a.time + b.time, a.load + b.load, a.speed_squared + b.speed_squared};
  }
};

/// A stretch of a ride as polynomials in sigma.
struct Panel {
  Stretch stretch;
  double anchor_zeta = 0.0;
  double anchor_v = 0.0;
  double kept = 1.0;  ///< share of v at the anchor that is left at the other end

  // At the nodes, in ascending order of sigma.
  chebyshev::Values push{};            // dw/ds, scaled by the weight at the anchor
  chebyshev::Values v{};               // u^2
  chebyshev::Values load{};            // N
  chebyshev::Values stretched_load{};  // N ds/dsigma: finite even where curvature is not
  chebyshev::Values pace{};            // dt/dsigma; not finite where the body does not get to

  // Means over [0, sigma].
  chebyshev::Values mean_push{};
  chebyshev::Values weighted_mean_push{};
  chebyshev::Values mean_pace{};
  chebyshev::Values mean_load{};
  chebyshev::Values mean_v{};

  Panel(const Equation& equation, const Stretch& covered, double v_at_anchor);

  /// @return true if the body rests at the anchor, and v is small of first order in the distance from it
  [[nodiscard]] bool at_rest() const { return anchor_v == 0.0 && stretch.anchor_root == 0.0; }
  /// @return true if curvature is unbounded at the anchor and so is the load there
  [[nodiscard]] bool load_unbounded() const;
  [[nodiscard]] double v_at(const Equation& equation, double sigma) const;
  /// @param zeta  the slope angle at sigma, for callers who know it
  [[nodiscard]] double v_for(const Equation& equation, double sigma, double zeta) const;
  [[nodiscard]] double load_at(const Equation& equation, double sigma) const;
  /// @return w, scaled by the weight at the anchor
  [[nodiscard]] double scaled_w(double sigma) const;
  /// @return size of the terms that make up v at the end that is not the anchor: its rounding is in
  /// proportion
  [[nodiscard]] double far_v_terms() const;
  /// @return v at the end that is not the anchor
  [[nodiscard]] double far_v() const { return v.back(); }
  [[nodiscard]] RideSums sums() const;
  /// @return sums from the begin of the panel to sigma
  [[nodiscard]] RideSums sums_to(double sigma) const;
};

}  // namespace glissade::motion
