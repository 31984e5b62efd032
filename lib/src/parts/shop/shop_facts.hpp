#pragma once

#include "glissade/core/quantity.hpp"
#include "glissade/parts/shop_part.hpp"

#include <optional>
#include <string>
#include <string_view>

namespace glissade::parts {

/// Collects what rules of the shop may bound.
class ShopFacts {
 public:
  explicit ShopFacts(Workshop& workshop) : workshop_(workshop) {}

  /// @param unit  what the quantity counts it in; 1: SI
  void at(const std::string& where, std::string_view quantity, double value, double unit = 1.0,
          Dimension dimension = Dimension::length);
  /// Of a part: rules may hold for parts of some thickness or density alone.
  void of(const ShopPart& part, std::string_view quantity, double value, double unit = 1.0,
          Dimension dimension = Dimension::length);
  /// Thickness, density and mass of every part.
  /// @param heaviest  that the design allows
  void parts(std::optional<double> heaviest);

 private:
  Workshop& workshop_;
};

}  // namespace glissade::parts
