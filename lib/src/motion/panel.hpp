#pragma once

#include "glissade/motion/motion.hpp"

#include "chebyshev.hpp"

#include <array>
#include <optional>
#include <vector>

namespace glissade::motion {

/// The energy equation of one body on one centerline, docs/theory.md, in the form that has a closed integral
/// where c does not depend on the speed and no wind blows:
///   w = v e^(-(2/f)(mu zeta - k s_c)), dw/ds = push e^(-(2/f)(mu zeta - k s_c)), ds_c = (1 - kappa h) ds.
/// What else a law or the wind asks for enters as `extra`, which a panel iterates on.
struct Equation {
  const Centerline* centerline = nullptr;
  double mu = 0.0;           ///< friction coefficient at the start
  double k = 0.0;            ///< drag [1/m]
  double gravity = 0.0;      ///< [m/s^2]
  double gain = 2.0;         ///< 2/f
  double height = 0.0;       ///< h, of the centre of mass above the track [m]
  double head_wind = 0.0;    ///< [m/s]
  double side = 1.0;         ///< -1 below a hood: the sign of the load
  const Law* law = nullptr;  ///< where c depends on the speed; none otherwise
  std::vector<FrictionChange> changes;
  bool held = false;  ///< Body::held

  /// What is added to the closed form: dv/ds = ... + push + rate v, linear about some v.
  struct Extra {
    double push = 0.0;
    double rate = 0.0;
  };

  [[nodiscard]] bool closed() const { return law == nullptr && head_wind == 0.0; }
  /// @return mu on the stretch that holds s
  [[nodiscard]] double friction_at(double s) const;
  /// @return (2/f) g (sin(zeta) - side mu cos(zeta)) (1 - kappa h) [m/s^2]
  [[nodiscard]] double push(const Direction& direction, double friction) const;
  /// @return what v keeps where the slope angle grows by `turn`
  [[nodiscard]] double keep(double turn, double distance, double friction) const;
  [[nodiscard]] Extra extra(const Direction& direction, double s, double friction, double v) const;
  /// @return dv/ds of a body at rest, were it to move [m/s^2]
  [[nodiscard]] double slope_at_rest(const Direction& direction, double friction) const;
  /// @return ds_c/ds = 1 - kappa h
  [[nodiscard]] double path_rate(const Direction& direction) const;
  /// @return N for v = u^2 [m/s^2]; at rest the curvature does not count, even where it is unbounded
  [[nodiscard]] double load(const Direction& direction, double v) const;
  /// @return c/mu
  [[nodiscard]] double resistance(double s, double v) const;
  /// @return the body at s, for callers who know what it weighs and rubs there
  [[nodiscard]] LawState law_state(double s, const Direction& direction, double v, double normal_load,
                                   double friction) const;
  /// @return D(v): drag over k
  [[nodiscard]] double dragged(double v) const;
  /// @return what the wind does to v of a body at rest [m/s^2], in size: 0 in still air
  [[nodiscard]] double push_of_wind() const { return gain * k * head_wind * head_wind; }
  /// Losses are sums of c N over this: mu alone where it is the same everywhere.
  [[nodiscard]] double loss_friction() const { return changes.empty() ? mu : 1.0; }
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
  /// @return the part from s on; for a stretch anchored at its begin
  [[nodiscard]] Stretch beyond(double s) const;
};

/// Time and energies that a ride adds up.
struct RideSums {
  double time = 0.0;  ///< [s]
  double load = 0.0;  ///< integral of c N/Equation::loss_friction() along the centre's path [m^2/s^2]
  double speed_squared = 0.0;  ///< integral of D(v) along the centre's path [m^3/s^2]

  friend RideSums operator+(const RideSums& a, const RideSums& b) {
    return {a.time + b.time, a.load + b.load, a.speed_squared + b.speed_squared};
  }
};

/// A stretch of a ride as polynomials in sigma.
struct Panel {
  Stretch stretch;
  /// mu, the same on all of it; negative where a held body presses upwards, N < 0: c N then slows it down all the same.
  double friction = 0.0;
  double pressing = 1.0;  ///< the sign of that, so that pressing N = |N|
  double anchor_zeta = 0.0;
  double anchor_v = 0.0;
  double kept = 1.0;     ///< share of v at the anchor that is left at the other end
  bool resolved = true;  ///< false where what is not linear in v did not settle

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
  std::optional<chebyshev::Values>
      path_rate;  ///< ds_c/ds at the nodes, of a body whose centre is off the track
  std::optional<chebyshev::Values>
      mean_rate;  ///< of what v keeps beyond the closed form, where it is not closed

  /// @param side_pressed  1, or -1 where a held body presses upwards
  Panel(const Equation& equation, const Stretch& covered, double v_at_anchor, double side_pressed = 1.0);

  /// @return true if the body rests at the anchor, and v is small of first order in the distance from it
  [[nodiscard]] bool at_rest() const { return anchor_v == 0.0 && stretch.anchor_root == 0.0; }
  /// @return true if curvature is unbounded at the anchor and so is the load there
  [[nodiscard]] bool load_unbounded() const;
  [[nodiscard]] double v_at(const Equation& equation, double sigma) const;
  /// @param zeta  the slope angle at sigma, for callers who know it
  [[nodiscard]] double v_for(const Equation& equation, double sigma, double zeta) const {
    return v_for(equation, sigma, zeta, interpolation(sigma));
  }
  /// @param at  interpolation(sigma), for callers who ask for more than one thing there
  [[nodiscard]] double v_for(const Equation& equation, double sigma, double zeta,
                             const chebyshev::Interpolation& at) const;
  [[nodiscard]] chebyshev::Interpolation interpolation(double sigma) const {
    return chebyshev::Interpolation(sigma / stretch.width);
  }
  [[nodiscard]] double load_at(const Equation& equation, double sigma) const;
  /// @return the body at sigma; at an end of the panel as seen from within it
  [[nodiscard]] LawState law_state(const Equation& equation, double sigma) const;
  /// @return the body at a node
  [[nodiscard]] LawState law_state_at(const Equation& equation, std::size_t node) const;
  /// @return ds_c/ds at sigma
  [[nodiscard]] double path_rate_at(const Equation& equation, double sigma) const;
  /// @return w, scaled by the weight at the anchor
  [[nodiscard]] double scaled_w(double sigma) const { return scaled_w(sigma, interpolation(sigma)); }
  [[nodiscard]] double scaled_w(double sigma, const chebyshev::Interpolation& at) const;
  /// @return size of the terms that make up v at the end that is not the anchor: its rounding is in
  /// proportion
  [[nodiscard]] double far_v_terms() const;
  /// @return v at the end that is not the anchor
  [[nodiscard]] double far_v() const { return v.back(); }
  [[nodiscard]] RideSums sums() const;
  /// @return sums from the begin of the panel to sigma
  [[nodiscard]] RideSums sums_to(double sigma) const { return sums_to(sigma, interpolation(sigma)); }
  [[nodiscard]] RideSums sums_to(double sigma, const chebyshev::Interpolation& at) const;

 private:
  struct Nodes {
    std::array<Direction, chebyshev::kNodes> directions;
    chebyshev::Values closed_keeping;  ///< of the closed form
    chebyshev::Values keeping;
  };
  /// v at the nodes, from what pushes and what is kept.
  void add_up(const Nodes& nodes);
  /// v where the equation is not linear in it, by Newton's method on all nodes at once.
  void settle(const Equation& equation, Nodes& nodes);
  /// Loads, paces and their sums, for the v found.
  void weigh(const Equation& equation, const Nodes& nodes);
  /// What `weigh` leaves out for a sliding point.
  void weigh_law(const Equation& equation, const Nodes& nodes, chebyshev::Values& pressed,
                 chebyshev::Values& stretched_v);
};

}  // namespace glissade::motion
