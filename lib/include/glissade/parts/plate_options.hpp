#pragma once

#include "glissade/core/error.hpp"
#include "glissade/core/vec.hpp"

#include <optional>
#include <string>
#include <vector>

namespace glissade {

/// What plates are made of.
struct StockMaterial {
  std::string name = "S235";
  double density = 7850.0;  ///< [kg/m^3]; > 0

  friend bool operator==(const StockMaterial&, const StockMaterial&) = default;
};

/// How a curved floor is made: on plate rolls, or by hits of a press.
enum class FloorMake { rolled, bent };

/// What decides how many bends a floor gets.
enum class FacetRule {
  speed_loss,       ///< share of the exit speed that the bends may cost
  chord_tolerance,  ///< greatest distance between facets and track [m]
  bends,            ///< how many in all
  segment_length,   ///< greatest length of a facet [m]
  segment_angle     ///< greatest angle of a bend [rad]
};

/// How a bent floor is divided into facets, and how it is bent.
struct BendOptions {
  FacetRule rule = FacetRule::speed_loss;
  double value = 0.01;
  std::optional<double> inner_radius;  ///< of the punch [m]; none: the plate's thickness
  std::optional<double>
      k_factor;  ///< neutral fibre, 0 inside to 1; none: k_factor() by radius over thickness

  friend bool operator==(const BendOptions&, const BendOptions&) = default;
};

/// Where walls stand: beside the floor, their lower edges flush with its underside, or on it.
enum class WallSeat { beside_floor, on_floor };

/// What no part may exceed. Ends of parts are where the track bends least.
struct SplitOptions {
  std::optional<double> longest;   ///< length of a transport unit along the track [m]
  Vec2 sheet{3.0, 1.5};            ///< stock, longer side first [m]
  std::optional<double> heaviest;  ///< mass of a part [kg]
  bool allowed = true;             ///< false: everything in one piece, or an error

  friend bool operator==(const SplitOptions&, const SplitOptions&) = default;
};

/// Frames round both ends of every transport unit, bolted together at the joints.
struct FlangeOptions {
  bool wanted = true;
  double width = 50e-3;     ///< of the bar, from the channel outwards [m]
  double thickness = 6e-3;  ///< [m]
  int bolt = 10;            ///< nominal diameter of a metric bolt [mm]; one of bolt_sizes()
  double pitch = 150e-3;    ///< greatest distance of bolts [m]
  double gap = 0.5e-3;      ///< between channel and frame, for welding [m]

  friend bool operator==(const FlangeOptions&, const FlangeOptions&) = default;
};

/// How a channel is made of plates.
struct PlateOptions {
  StockMaterial material;
  FloorMake floor = FloorMake::rolled;
  BendOptions bend;
  WallSeat walls = WallSeat::beside_floor;
  SplitOptions split;
  FlangeOptions flanges;
  double joint_step = 0.0;  ///< by which the floor may drop at a joint, downstream [m]; >= 0

  friend bool operator==(const PlateOptions&, const PlateOptions&) = default;
};

/// Inside measures of a channel of flat plates [m].
struct ChannelMeasures {
  double width = 0.0;
  double wall_height = 0.0;  ///< 0: a slab without walls
  double thickness = 0.0;

  friend bool operator==(const ChannelMeasures&, const ChannelMeasures&) = default;
};

/// @return neutral fibre of a bend as a share of the thickness, from inside: DIN 6935, K = 0.325 + 0.25 lg(r/t), at most 0.5
[[nodiscard]] double k_factor(double inner_radius, double thickness);

/// @return nominal diameters of metric bolts [mm] whose clearance holes are known
[[nodiscard]] const std::vector<int>& bolt_sizes();
/// Fit of a clearance hole, ISO 273.
enum class HoleFit { fine, medium, coarse };
/// @return its diameter [m]
/// @throws InputError if the size is not one of bolt_sizes()
[[nodiscard]] double clearance_hole(int bolt, HoleFit fit);

/// Measures and options that no shop can make, whatever the track is: all of them.
/// @return issues whose `where` is the key: "flanges.pitch", "bend.inner_radius"; of the channel "width", "thickness"
[[nodiscard]] std::vector<Issue> plate_problems(const ChannelMeasures& channel, const PlateOptions& options);

}  // namespace glissade
