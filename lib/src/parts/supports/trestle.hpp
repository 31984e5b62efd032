#pragma once

#include "glissade/parts/plates.hpp"

#include "parts/curves/offset_line.hpp"
#include "parts/plates/shell.hpp"

#include <array>
#include <optional>

namespace glissade::parts {

constexpr double kSaddleHalf = 50e-3;   // of a saddle, along the track [m]
constexpr double kSaddleLeast = 30e-3;  // its height where it is lowest [m]
constexpr double kSaddle = 8e-3;        // its thickness [m]
constexpr double kBasePlate = 10e-3;    // thickness of a base plate [m]
constexpr double kBaseGap = 10e-3;      // between two of them [m]

/// One trestle, in the plane (x, height) [m].
struct Trestle {
  double at = 0.0;      ///< along the track
  double x = 0.0;       ///< of its middle
  double beam = 0.0;    ///< height of the cross beam's upper face
  double ground = 0.0;  ///< below its feet

  [[nodiscard]] double leg(const SupportOptions& supports) const {
    return beam - supports.tube - ground - supports.grout - kBasePlate;
  }
};

/// Where the saddles of a trestle stand, and how high the section's outside is there [m].
struct Saddles {
  std::array<double, 2> aside{};   ///< to the left, of the left one and the right one
  std::array<double, 2> height{};  ///< of the outside above the floor line
  double half = kSaddleHalf;       ///< along the track
};

/// @param s     along the track [m]
/// @param half  of a saddle's length along it [m]
[[nodiscard]] Saddles saddles_at(const Shell& shell, double s, double half);
/// @pre shell.options.supports
[[nodiscard]] Trestle trestle_at(const Shell& shell, double at, const Saddles& saddles);

/// What of the outside a saddle is cut to.
/// @param height  of the outside above the floor line [m]
/// @return none where no offset of the track is as long
[[nodiscard]] std::optional<ArcPath> seat_line(const Shell& shell, double at, double half, double height);

/// Of a square base plate [m].
[[nodiscard]] double base_side(const SupportOptions& supports);

}  // namespace glissade::parts
