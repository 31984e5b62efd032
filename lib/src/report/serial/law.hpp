#pragma once

#include "report/serial/vocabulary.hpp"

#include <string_view>

namespace glissade::report {

/// @return "arrived", "stalled", "lifted off", "does not fit" (a valley), "choked", "flies over the start", "stands where it
///         lands" (a feed)
[[nodiscard]] std::string_view status_of(const Motion& motion);

/// What a body is that is not a sliding point: body, rolling_resistance, radius_m, ...; nothing for one.
void add_law_body(Json& json, const BodyDesign& body);

/// What the body's law adds to a ride: inertia_factor, law_end, law; nothing without one.
void add_law(Json& json, const Motion& motion);

}  // namespace glissade::report
