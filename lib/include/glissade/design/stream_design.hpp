#pragma once

#include <optional>
#include <string>

namespace glissade {

/// The material of a stream by its word in the library or among the design's own, and what follows from it where
/// the design says nothing else.
struct MaterialChoice {
  std::string material;            ///< "wheat"
  std::string liner;               ///< "mild-steel"; empty: not told
  std::optional<double> moisture;  ///< share of the mass
  bool density_follows = false;
  bool pressure_ratio_follows = false;

  friend bool operator==(const MaterialChoice&, const MaterialChoice&) = default;
};

/// The liner that a stream wears, under Archard's law.
struct LinerPlateDesign {
  double thickness = 0.0;         ///< [m]; > 0
  double hardness = 0.0;          ///< [Pa]; > 0
  double wear_coefficient = 0.0;  ///< k [-]; > 0

  friend bool operator==(const LinerPlateDesign&, const LinerPlateDesign&) = default;
};

/// A stream of bulk solid in place of a single body. How it rubs and how fast it enters is said by the
/// BodyDesign beside it, the channel by the cross-section.
struct StreamDesign {
  double mass_flow = 0.0;              ///< Q [kg/s]; > 0
  double bulk_density = 0.0;           ///< rho, the nominal one [kg/m^3]; > 0
  std::optional<double> low_density;   ///< <= bulk_density: the stream is deepest there
  std::optional<double> high_density;  ///< >= bulk_density
  std::optional<MaterialChoice> material;
  std::optional<double> lump_size;      ///< of the largest lump [m]; none: not judged
  double lateral_pressure_ratio = 0.5;  ///< K_v: pressure on the side walls over that from above; >= 0
  double slip_ratio = 0.6;  ///< K_c: speed at the floor over the mean speed, for wear; > 0, at most 1
  std::optional<LinerPlateDesign> liner_plate;  ///< none: how fast it gets thinner is not told
  double surge = 1.5;                           ///< greatest flow over mass_flow; >= 1
  double trickle = 0.1;                         ///< least flow over mass_flow; > 0, at most 1

  friend bool operator==(const StreamDesign&, const StreamDesign&) = default;
};

}  // namespace glissade
