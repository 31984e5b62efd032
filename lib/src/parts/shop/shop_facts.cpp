#include "parts/shop/shop_facts.hpp"

namespace glissade::parts {

void ShopFacts::at(const std::string& where, std::string_view quantity, double value, double unit,
                   Dimension dimension) {
  workshop_.measured.push_back({quantity, value, unit, dimension, where, {}, {}});
}

void ShopFacts::of(const ShopPart& part, std::string_view quantity, double value, double unit,
                   Dimension dimension) {
  workshop_.measured.push_back({quantity, value, unit, dimension, part.name, part.thickness, part.density});
}

void ShopFacts::parts(std::optional<double> heaviest) {
  for (const ShopPart& part : workshop_.parts) {
    of(part, "part_thickness", part.thickness);
    of(part, "part_density", part.density, 1.0, Dimension::density);
    of(part, "part_mass", part.mass, 1.0, Dimension::mass);
    if (heaviest) of(part, "part_mass_share", part.mass, *heaviest, Dimension::mass);
  }
}

}  // namespace glissade::parts
