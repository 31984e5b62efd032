#pragma once

#include "glissade/core/units.hpp"
#include "glissade/motion/motion.hpp"
#include "glissade/trades/chute/ends.hpp"

#include <optional>

namespace glissade {

/// A hood: a plate bent to an arc in front of a feed, which catches the stream on its concave underside and turns it
/// down, onto the start of the track below (the spoon).
struct HoodShape {
  double radius = 0.0;  ///< R, of the underside [m]; > 0
  Angle impact_angle;   ///< between the way of the feed and the hood where they meet; >= 0
  Angle exit_slope;     ///< of the stream where it leaves the hood, below the horizontal; at most 90 deg
  double drop = 0.0;    ///< from the hood's lower edge down to the start of the track [m]; >= 0
};

/// How one stream passes a hood.
///
/// Below a hood the load is N = kappa_h u^2 - g cos(zeta), kappa_h = 1/R, which presses outwards; it is in contact
/// while u^2/(g R) >= cos(zeta) (docs/theory.md, laws of motion; Roberts 2003). Roberts' depth and the friction of the
/// side walls hold as on a floor. From the lower edge, or where contact is lost, it falls without air.
struct HoodPassage {
  Impact impact;  ///< of the feed on the hood
  Motion motion;  ///< along the hood from where the feed meets it; its ride ends early where contact is lost
  double contact = 0.0;        ///< u^2/(g R cos(zeta)) where the feed meets the hood; in contact from 1 on
  double least_contact = 0.0;  ///< the least of it along the ride
  /// Where it comes down on the level of the track's start, seen from where the feed meets the hood: run and drop [m].
  Vec2 start = {};
  double reach =
      0.0;  ///< horizontal way of the fall from the hood down to the level of the track's start [m]
  double fall_time = 0.0;  ///< of that fall [s]
  /// How it comes down there; at a stand where the stream comes to one on the hood.
  Landing landing = {};

  /// @return true if the stream is pressed on the hood all along and leaves it at its lower edge
  [[nodiscard]] bool holds() const { return motion.arrived(); }
  /// @return from the hood on to the start of the track [s]
  [[nodiscard]] double time() const { return motion.travel_time() + fall_time; }
};

/// @return the underside of a hood from where the feed meets it to its lower edge, an arc
/// @param feed  on its way to the hood
/// @throws InputError if the hood does not turn the stream down: landing.angle + impact_angle >= exit_slope; or if a
///         measure breaks its bound
[[nodiscard]] CenterlinePtr hood_arc(const HoodShape& hood, const Landing& feed);

/// @param feed     on its way to the hood
/// @param body     a stream; its channel below the hood is as wide, and its walls as high, as at the start of its track
/// @throws InputError as hood_arc(), or if the body is no stream or the feed has no speed
[[nodiscard]] HoodPassage pass_hood(const HoodShape& hood, const Landing& feed, const Body& body,
                                    double gravity);

/// A feed and the hood that it meets, as what a stream does before it comes down on its track.
class HoodApproach final : public Approach {
 public:
  HoodApproach(const HoodShape& hood, const Landing& feed, double gravity)
      : hood_(hood), feed_(feed), gravity_(gravity) {}
  [[nodiscard]] Landing landing(const Body& body) const override;
  [[nodiscard]] bool falls_away(const Body& body) const override;

 private:
  HoodShape hood_;
  Landing feed_;
  double gravity_;
};

}  // namespace glissade
