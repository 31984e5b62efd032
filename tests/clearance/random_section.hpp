#pragma once

#include "glissade/section/cross_section.hpp"

#include "support/random.hpp"

#include <ostream>

namespace glissade {

/// A section of any kind with walls from low to higher than most tracks bend.
/// @param words  gets its measures, for messages
inline CrossSection random_section(testing::Random& random, std::ostream& words) {
  const double width = random.between(0.2, 1.0);
  const double wall = random.between(0.05, 1.2);
  const double thickness = random.between(0.02, 0.19);
  words << "width " << width << ", wall " << wall << ", thickness " << thickness;
  switch (random.integer(0, 5)) {
    case 0:
      words << ", slab";
      return CrossSection::slab(width, thickness);
    case 1:
      words << ", slab with curbs";
      return CrossSection::slab(width, thickness, 0.3 * wall, 0.2 * width);
    case 2:
      words << ", half-pipe";
      return CrossSection::half_pipe(width, thickness, 0.5 * wall);
    case 3:
      words << ", pipe";
      return CrossSection::pipe(width, thickness);
    case 4:
      words << ", polygon";
      return CrossSection::polygon({{0.0, 0.0},
                                    {-0.5 * width, 0.3 * wall},
                                    {-0.5 * width - thickness, 0.2 * wall},
                                    {-0.3 * width, -thickness},
                                    {0.4 * width, -2.0 * thickness},
                                    {0.5 * width, wall}});
    default:
      words << ", u-channel";
      return CrossSection::u_channel(width, wall, thickness);
  }
}

}  // namespace glissade
