#pragma once

#include "glissade/core/units.hpp"
#include "glissade/trades/rules.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace glissade {

/// Where a number of a material comes from.
struct MaterialSource {
  std::string text;
  Certainty certainty = Certainty::own;

  friend bool operator==(const MaterialSource&, const MaterialSource&) = default;
};

/// The friction of a bulk solid on one liner, or on a class of walls, as one source tells it.
struct WallFriction {
  std::string liner;       ///< a Liner's word; empty for a class
  std::string wall_class;  ///< of EN 1991-4: "D1" slippery, "D2" smooth, "D3" rough; empty for a liner
  Angle low;
  Angle nominal;
  Angle high;
  /// Moisture over which it goes from `low` to `high`, as shares; none: not told.
  std::optional<Range> moisture;
  MaterialSource from;

  friend bool operator==(const WallFriction&, const WallFriction&) = default;
};

/// The bulk density of a material, with its source.
struct MaterialDensity {
  double low = 0.0;  ///< [kg/m^3]
  double nominal = 0.0;
  double high = 0.0;
  MaterialSource from;

  friend bool operator==(const MaterialDensity&, const MaterialDensity&) = default;
};

/// A number with its source.
struct SourcedValue {
  double value = 0.0;
  std::string why;  ///< what it is for; may be empty
  MaterialSource from;

  friend bool operator==(const SourcedValue&, const SourcedValue&) = default;
};

/// A bulk solid, and what is known of it. What is not known is none, never a guess.
struct Material {
  std::string word;  ///< as design files name it: "wheat"
  std::string name;  ///< for people
  std::optional<MaterialDensity> density;
  std::optional<SourcedValue> lateral_pressure_ratio;
  std::vector<WallFriction> friction;
  std::optional<SourcedValue> highest_speed;  ///< [m/s], beyond which it suffers
  std::vector<std::string> warnings;
  bool own = false;  ///< an entry of the user's file

  friend bool operator==(const Material&, const Material&) = default;
};

/// What lines a chute.
struct Liner {
  std::string word;        ///< "mild-steel"
  std::string name;        ///< for people
  std::string wall_class;  ///< empty: of none
};

/// What is known of bulk solids and liners.
struct MaterialLibrary {
  std::vector<Material> materials;
  std::vector<Liner> liners;

  /// @return null if there is none of that word
  [[nodiscard]] const Material* material(std::string_view word) const;
  [[nodiscard]] const Liner* liner(std::string_view word) const;
};

/// What a library knows of one material on one liner, together.
struct FrictionFound {
  Angle low;      ///< the least of all sources
  Angle nominal;  ///< the mean of their middles
  Angle high;     ///< the greatest of all sources
  std::vector<WallFriction> from;
  std::vector<std::string> warnings;  ///< of moistures that nobody measured

  /// @return the least sure of its sources
  [[nodiscard]] Certainty certainty() const;
};

/// Every source that tells of the liner, or of its class, is heard: wall friction is a range.
/// @param moisture  share of the mass; none: whatever was measured. A source that tells how friction goes with
///                  moisture is read at it, and at its own end beyond what it measured, which is a warning.
/// @return none if no source tells
[[nodiscard]] std::optional<FrictionFound> friction_on(const Material& material, const Liner& liner,
                                                       std::optional<double> moisture = {});

}  // namespace glissade
