#pragma once

#include "glissade/trades/chute/ends.hpp"
#include "glissade/trades/chute/hood.hpp"

#include "report/serial/vocabulary.hpp"

#include <optional>

namespace glissade::report {

/// Adds what flows, where the design has a stream.
void add_stream_body(Json& json, const Design& design);
/// @param impact  none of a feed that flies over what it should land on
[[nodiscard]] Json feed_json(const FeedFall& fall, const std::optional<Impact>& impact, double entry_speed);
/// What a hood does with the stream of one ride, without where it stands.
[[nodiscard]] Json hood_passage_json(const HoodPassage& passage);
/// A hood and its stream at the nominal friction, with how it comes down on the track below.
/// @param impact  on the track; none where the stream flies over it
[[nodiscard]] Json hood_json(const HoodShape& hood, const HoodPassage& passage,
                             const std::optional<Impact>& impact);
[[nodiscard]] Json belt_landing_json(const BeltLanding& landing);
/// Adds `stream` to a ride of one: how deep it is, what it rubs, whether it chokes.
void add_stream(Json& json, const Motion& motion);

}  // namespace glissade::report
