#include "parts/workshop_list.hpp"

#include "glissade/core/number_text.hpp"

#include "parts/bolts.hpp"

#include <utility>
#include <variant>

namespace glissade::parts {
namespace {

/// Sections along a path say where they lie: only the very same body has the same place.
bool same_body(const PartBody& a, const PartBody& b) {
  const auto* const one = std::get_if<SweptBody>(&a);
  const auto* const other = std::get_if<SweptBody>(&b);
  if (one == nullptr || other == nullptr) return a.index() == b.index();
  return one->path == other->path && one->section == other->section;
}

/// The same on the flat and of the same volume when finished; what is bought, the same by name.
bool same_part(const ShopPart& a, const ShopPart& b) {
  if (a.thickness != b.thickness || a.material != b.material || a.volume != b.volume) return false;
  if (!same_body(a.body, b.body)) return false;
  if (a.pattern.has_value() != b.pattern.has_value()) return false;
  return a.pattern ? a.pattern->region == b.pattern->region : a.name == b.name;
}

}  // namespace

int add_part(Workshop& workshop, ShopPart part, const std::array<double, 3>& colour) {
  for (ShopPart& other : workshop.parts) {
    if (!same_part(other, part)) continue;
    other.places.insert(other.places.end(), part.places.begin(), part.places.end());
    return other.number;
  }
  part.number = static_cast<int>(workshop.parts.size()) + 1;
  part.colour = colour;
  workshop.parts.push_back(std::move(part));
  return workshop.parts.back().number;
}

void add_item(Workshop& workshop, BoughtInItem item) {
  if (item.quantity == 0) return;
  for (BoughtInItem& other : workshop.items) {
    if (other.name != item.name || other.where != item.where) continue;
    other.quantity += item.quantity;
    return;
  }
  workshop.items.push_back(std::move(item));
}

void add_bolts(Workshop& workshop, int size, double grip, std::size_t count, const std::string& where) {
  const Bolt& bolt = bolt_of(size);
  const std::string name = "M" + std::to_string(size);
  add_item(workshop, {"bolt " + name + " x " + rounded_text(1e3 * bolt_length(bolt, grip), 4), "ISO 4017 8.8",
                      count, where});
  add_item(workshop, {"nut " + name, "ISO 4032 8", count, where});
  add_item(workshop, {"washer " + name, "ISO 7089 200 HV", 2 * count, where});
}

void add_joint_bolts(Workshop& workshop, const FlangeOptions& flange, std::size_t holes, std::size_t joints) {
  if (joints == 0) return;
  const std::string where = joints == 1 ? "at the joint" : "at the " + std::to_string(joints) + " joints";
  add_bolts(workshop, flange.bolt, 2.0 * flange.thickness, holes * joints, where);
}

}  // namespace glissade::parts
