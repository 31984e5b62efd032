#pragma once

#include "glissade/core/vec.hpp"
#include "glissade/pipeline/solve.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace glissade {

/// Where a stream flies through the air.
enum class FlightKind {
  feed,       ///< from pulley or outlet to the hood or the start of the track
  from_hood,  ///< from the hood down to the start of the track
  to_belt     ///< from the finish down to the receiving belt
};

/// @return "feed", "fall from the hood", "fall on the belt"
[[nodiscard]] std::string_view to_text(FlightKind kind);

/// A stream in the air, without air drag: a parabola, and the other side of the stream, which gets thinner as it gets
/// faster: Q/(rho B u), B the width of the channel where the track begins, or ends.
///
/// Frame: run from the start of the track and height above it, upwards positive [m].
struct StreamFlight {
  FlightKind kind = FlightKind::feed;
  std::vector<Vec2> path;  ///< of the side that lay on what it left; of what falls straight down, of one side
  std::vector<Vec2> beyond;  ///< of its other side, as many
};

/// @param design  solved: as_solved()
/// @param motion  a ride of its track, at any friction and flow; a stream
/// @param nominal the hood's passage at the nominal friction, from which on track and hood lie; none without a hood
/// @param hood    the passage that belongs to `motion`
/// @return every flight there is, in the order of the stream; those after an early end are left out
[[nodiscard]] std::vector<StreamFlight> stream_flights(const Design& design, const Motion& motion,
                                                       const HoodPassage* nominal, const HoodPassage* hood);
/// At the nominal friction and flow.
[[nodiscard]] std::vector<StreamFlight> stream_flights(const Design& design, const Track& track);
/// Of another ride of the track; its hood, which stands where it is, passes the stream with that ride's friction.
[[nodiscard]] std::vector<StreamFlight> stream_flights(const Design& design, const Track& track,
                                                       const Motion& motion);

/// The underside of a design's hood as a line, in the same frame; empty without one.
[[nodiscard]] std::vector<Vec2> hood_line(const Design& design, const Track& track);

/// How near a stream in the air comes to what the limits of its design keep clear of. What is passed above or below by the
/// track, a stream may pass on either side.
struct FlightApproach {
  std::string limit;       ///< "keep_outs[0]"
  double clearance = 0.0;  ///< asked for [m]
  double distance = 0.0;   ///< of the stream [m]; negative: it reaches in
  FlightKind kind = FlightKind::feed;
  Vec2 at;  ///< of the stream, in the frame of StreamFlight

  /// @return what is left of the distance beyond the clearance [m]
  [[nodiscard]] double margin() const { return distance - clearance; }
};
/// @return for each obstacle the closest flight
[[nodiscard]] std::vector<FlightApproach> flight_approaches(const Design& design,
                                                            const std::vector<StreamFlight>& flights);

}  // namespace glissade
