#pragma once

#include "glissade/core/vec.hpp"

#include <string>
#include <vector>

namespace glissade::parts {

/// @param ground  (x, height) from left to right; one point: level
/// @return its height at x; beyond its ends it goes on straight: what reaches there of a foot that stands on it
[[nodiscard]] double ground_at(const std::vector<Vec2>& ground, double x);
/// @return the highest of it between two places
[[nodiscard]] double highest_ground(const std::vector<Vec2>& ground, double from, double to);

/// Where something stands, and the place on the track that it holds up: on a slope one lies beside the other.
struct Foot {
  double x = 0.0;  ///< of its middle [m]
  double above = 0.0;
};
/// @param where  key of the ground
/// @param what   stands on them: "a trestle"
/// @throws InputError where both lie beyond an end of a line: which end, how far from the start
void require_on_ground(const std::vector<Vec2>& ground, const std::vector<Foot>& feet,
                       const std::string& where, const std::string& what);

}  // namespace glissade::parts
