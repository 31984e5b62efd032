#pragma once

#include <optional>

namespace glissade::testing_problems {

/// Falls without load, rides at the cap and hooks of one radius between them, in turn, from rest and from a vertical start:
/// tracks by three rules, on a coarse grid of their lengths and turns. It shares nothing with the search.
/// @return the least time of those that end within a hundredth of the chord above or below the finish, s; none where none does
[[nodiscard]] std::optional<double> least_time_with_hooks(double run, double drop, double friction,
                                                          double cap);

}  // namespace glissade::testing_problems
