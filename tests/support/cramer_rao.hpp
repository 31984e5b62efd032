#pragma once

#include "support/known_profiles.hpp"

#include <functional>
#include <vector>

namespace testing {

/// Profiles of one make, by the numbers that somebody who measures one does not know.
struct ProfileMake {
  std::function<KnownProfile(const std::vector<double>&)> of;
  std::vector<double> numbers;

  [[nodiscard]] KnownProfile known() const { return of(numbers); }
};

/// What noise allows: the least standard deviation, relative, that an unbiased estimate of a quantity can have from
/// points of a profile whose make is known, but neither its numbers nor its place across (Cramer and Rao's bound).
/// Independent of any fit: the points' distances by the numbers are differences of places.
/// @param count     points at equal steps of arc length
/// @param noise     standard deviation of their distances from the profile [m]
/// @param quantity  of a profile of that make
[[nodiscard]] double least_deviation(const ProfileMake& make, int count, double noise,
                                     const std::function<double(const KnownProfile&)>& quantity);

}  // namespace testing
