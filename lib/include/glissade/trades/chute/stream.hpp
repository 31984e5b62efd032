#pragma once

#include "glissade/motion/laws/bulk_stream.hpp"
#include "glissade/motion/motion.hpp"

#include <optional>

namespace glissade {

/// A value and where along the track it is.
struct ValueAt {
  double value = 0.0;
  double arc_length = 0.0;  ///< [m]
};

/// Where a stream grows too deep, and for what.
struct Choke {
  double arc_length = 0.0;  ///< [m]
  double speed = 0.0;       ///< [m/s]
  double depth = 0.0;       ///< [m]
  double bound = 0.0;       ///< the wall's height, or the width where that is less [m]
  bool over_wall = false;   ///< spills over the wall; otherwise as deep as wide, where Roberts' law ends
};

/// What the ride of a stream of bulk solid was: docs/chutes.md.
struct StreamFacts {
  ValueAt deepest;                   ///< H [m]
  std::optional<double> exit_depth;  ///< at the finish [m]; none unless it arrives there
  ValueAt equivalent_friction;       ///< greatest mu (1 + K_v H/B)
  ValueAt filling;  ///< greatest H over the depth at which the stream chokes there; 1 where it does
  std::optional<Choke> choke;  ///< none: it does not

  /// @return how much deeper the stream could be at its fullest place, as a share of what chokes it
  [[nodiscard]] double margin() const { return 1.0 - filling.value; }
};

/// A stream at one place of its track, and what it does to the chute there (docs/chutes.md, wear).
struct StreamState {
  double depth = 0.0;                ///< H [m]
  double equivalent_friction = 0.0;  ///< mu (1 + K_v H/B)
  double floor_pressure = 0.0;       ///< p = rho H N [Pa]
  /// W_c = Q K_c mu N/B: rubbing power per area of the floor [W/m^2]; Roberts' abrasive wear factor
  double floor_wear = 0.0;
  double wall_wear = 0.0;  ///< W_c K_v/(2 K_c), of each side wall below the surface [W/m^2]
  double pressed = 0.0;    ///< p v_slip = W_c/mu: by which a liner gets thinner [W/m^2]
};

/// @param s  as for Motion::at()
/// @throws InputError if the body of the motion is no stream, or s lies outside the ride
[[nodiscard]] StreamState stream_state(const Motion& motion, double s);
/// @param at  of a ride of that stream
[[nodiscard]] StreamState stream_state(const BulkStream& stream, const LawState& at);

/// @param member  what of a StreamState
/// @return its greatest value along the ride, as Motion::highest() finds it
/// @throws InputError if the body of the motion is no stream
[[nodiscard]] ValueAt stream_peak(const Motion& motion, double StreamState::*member);
/// @param motion  of a stream
/// @return the mean of W_c over its way [W/m^2]
[[nodiscard]] double mean_floor_wear(const Motion& motion);

/// @return the law of a body that is a stream; null for any other
[[nodiscard]] const BulkStream* stream_of(const Body& body);

/// @return the facts of a stream's ride; none of another body's
[[nodiscard]] std::optional<StreamFacts> stream_facts(const Motion& motion);

/// The greatest mass flow that does not choke on a track, all else equal; to kChokingFlowAccuracy.
/// @param body  a stream that need not carry that much itself
/// @throws InputError if the body is no stream, or as Motion
/// @return [kg/s]; 0 if not even a grain arrives; none if it does not choke at a thousand times the body's flow
[[nodiscard]] std::optional<double> choking_mass_flow(const CenterlinePtr& centerline, const Body& body,
                                                      double gravity);

/// The body with another flow, as a share of its own.
/// @param body  a stream
/// @param factor  > 0
/// @throws InputError if the body is no stream
[[nodiscard]] Body with_flow(Body body, double factor);
/// The body with another bulk density [kg/m^3].
/// @throws InputError if the body is no stream
[[nodiscard]] Body with_density(Body body, double density);

/// Stated relative accuracy of choking_mass_flow().
inline constexpr double kChokingFlowAccuracy = 1e-6;

}  // namespace glissade
