#pragma once

#include "glissade/motion/motion.hpp"
#include "glissade/report/figure.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace glissade {

/// What a figure of a ride shows: the side view to scale, or one quantity over the arc length.
enum class RideQuantity { profile, slope, speed, load, curvature, energy };

/// @return the word that a command line uses: "profile", "slope", ...
[[nodiscard]] std::string_view word(RideQuantity quantity);
/// @return the quantity that the word names, none if it names none
[[nodiscard]] std::optional<RideQuantity> ride_quantity(std::string_view word);
/// @return every quantity, in the order of the enumeration
[[nodiscard]] const std::vector<RideQuantity>& ride_quantities();

/// One ride of a figure.
struct FigureRide {
  std::string name;  ///< for the legend
  const Motion* motion = nullptr;
  bool dashed = false;
};

/// One panel with a line for each ride: the shape of the track as a whole, what moves as far as the body
/// came. Heights count from the start. Loads are in g of the ride's own gravity; energies are per mass, above
/// the lowest point of each ride; an unbounded curvature interrupts its line.
/// @throws InputError if there is no ride
[[nodiscard]] Figure ride_figure(RideQuantity quantity, const std::vector<FigureRide>& rides);

}  // namespace glissade
