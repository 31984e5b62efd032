#include "glissade/motion/laws/rider.hpp"

#include "motion/laws/requirement.hpp"

namespace glissade {

Rider::Rider(double centre_height) : height_(centre_height) {
  motion::require_positive("centre_height", centre_height, " m",
                           "A body without height is the sliding point.");
}

LawPtr Rider::in_units(double length, double /*speed*/) const {
  return std::make_shared<const Rider>(height_ / length);
}

}  // namespace glissade
