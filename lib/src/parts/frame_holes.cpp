#include "parts/frame_holes.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/slot.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace glissade::parts {
namespace {

constexpr double kUsualSlot = 2.5;  // of the bolt's diameter, overall: long slots of EN 1090-2, table 11
constexpr double kAtTop = 1.5;      // hole diameters below the top of a frame
constexpr double kLongerBy = 1e-3;  // than wide: slots that are less are round holes [m]
constexpr double kStep = 0.5e-3;    // of what is advised [m]
constexpr int kTries = 1000;        // of such steps

constexpr double kEdgeWithWeb = 0.7;   // diameters
constexpr double kPitchWithWeb = 1.2;  // diameters

double widest_hole(const FlangeOptions& flange) {
  return clearance_hole(flange.bolt, HoleFit::coarse);
}

bool is_loose(const FlangeOptions& flange, FlangeSide side) {
  return side == flange.slotted.value_or(FlangeSide::downstream);
}

/// Ends of slots are at least as far apart as middles of holes; so far at least that a web is left, whatever the shop's rules.
double least_apart(const PlateOptions& options) {
  return hole_pitch_diameters(options.shop) * widest_hole(options.flanges);
}

double least_to_edge(const PlateOptions& options) {
  return std::max(options.shop.slot_edge_diameters, kEdgeWithWeb) * widest_hole(options.flanges);
}

/// The least distance of two upright slots, from axis to axis.
double nearest(const std::vector<Vec2>& middles, double reach) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < middles.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      const Vec2 apart = middles[i] - middles[k];
      least = std::min(least, norm(Vec2{apart.x, std::max(0.0, std::fabs(apart.y) - 2.0 * reach)}));
    }
  }
  return least;
}

/// The next pitch, and the next shorter slot, that leave slots far enough apart.
std::string slots_advice(const PlateOptions& options, const FrameBolts& bolts) {
  const FlangeOptions& told = options.flanges;
  const double least = least_apart(options);
  const auto does = [&](const FlangeOptions& flange) {
    return nearest(bolts(flange), slot_reach(flange)) >= least;
  };
  std::string ways;
  FlangeOptions other = told;
  for (int k = 1; k <= kTries; ++k) {
    other.pitch = kStep * (std::floor(told.pitch / kStep + 1e-9) + k);
    if (!does(other)) continue;
    ways += "pitch: " + length_text(other.pitch) + ", ";
    break;
  }
  other = told;
  const double shortest = widest_hole(told) + kLongerBy;
  for (int k = 1; k <= kTries; ++k) {
    other.slot = kStep * (std::ceil(slot_length(told) / kStep - 1e-9) - k);
    if (*other.slot < shortest) break;
    if (!does(other)) continue;
    ways += "slot: " + length_text(*other.slot) + ", ";
    break;
  }
  return ways + (ways.empty() ? "" : "or ") + "a smaller bolt";
}

}  // namespace

double slot_length(const FlangeOptions& flange) {
  return flange.slot.value_or(kUsualSlot * 1e-3 * flange.bolt);
}

double hole_edge_diameters(const ShopLeast& shop) {
  return std::max(shop.hole_edge_diameters, kEdgeWithWeb);
}

double hole_pitch_diameters(const ShopLeast& shop) {
  return std::max(shop.hole_pitch_diameters, kPitchWithWeb);
}

double slot_reach(const FlangeOptions& flange) {
  return flange.slotted ? 0.5 * (slot_length(flange) - widest_hole(flange)) : 0.0;
}

double below_top(const FlangeOptions& flange) {
  return kAtTop * widest_hole(flange) + slot_reach(flange);
}

std::string frame_name(const std::string& name, const FlangeOptions& flange, FlangeSide side) {
  if (!is_loose(flange, side)) return name;
  return name + (flange.slotted ? "_slotted" : "_loose");
}

void drill_frame(const PlateOptions& options, FlangeSide side, const FrameBolts& bolts, PlaneRegion& region) {
  const FlangeOptions& flange = options.flanges;
  const std::vector<Vec2> all = bolts(flange);
  const double reach = slot_reach(flange);
  // Both frames of a joint are refused alike, whichever is drilled first.
  if (flange.slotted && nearest(all, reach) < least_apart(options)) {
    throw InputError({"flanges.pitch",
                      "pitch: slots of " + length_text(slot_length(flange)) + " stand " +
                          length_text(nearest(all, reach), 3) + " from end to end at a pitch of " +
                          length_text(flange.pitch),
                      "Ends of slots are at least " + length_text(least_apart(options)) +
                          " apart, as middles of holes are.",
                      slots_advice(options, bolts)});
  }
  const bool loose = is_loose(flange, side);
  const double radius = 0.5 * clearance_hole(flange.bolt, loose ? HoleFit::coarse : HoleFit::medium);
  for (const Vec2 middle : all) {
    if (loose && flange.slotted) {
      region.cutouts.push_back(path_of(Slot{middle, {0.0, reach}, radius}));
    } else {
      region.holes.push_back({middle, radius});
    }
  }
}

void add_slot_problems(const PlateOptions& options, std::vector<Issue>& issues) {
  const FlangeOptions& flange = options.flanges;
  if (!flange.slotted) {
    if (flange.slot)
      issues.push_back({"flanges.slot", "slot: " + length_text(*flange.slot) + ", but no flange is slotted",
                        "", "slotted: downstream, or no slot"});
    return;
  }
  const double hole = widest_hole(flange);
  const double slot = slot_length(flange);
  const std::string size = "M" + std::to_string(flange.bolt);
  if (!(slot >= hole + kLongerBy - 1e-9)) {
    issues.push_back({"flanges.slot",
                      "slot: " + length_text(slot) + " is no longer than it is wide for " + size,
                      "Slots are as wide as coarse holes, " + length_text(hole) + ", and at least " +
                          length_text(kLongerBy) + " longer.",
                      "slot: " + length_text(kUsualSlot * 1e-3 * flange.bolt)});
    return;
  }
  if (flange.section == FlangeSection::angle) return;  // add_angle_problems() tells
  const double edge = 0.5 * flange.width - 0.5 * (slot - hole);
  const double least = least_to_edge(options);
  if (!(edge < least - 1e-9)) return;
  const double longest = kStep * std::floor((hole + flange.width - 2.0 * least) / kStep + 1e-9);
  const double widest = 1e-3 * std::ceil(1e3 * (slot - hole + 2.0 * least) - 1e-6);
  const bool usual = least == ShopLeast{}.slot_edge_diameters * hole;
  issues.push_back(
      {flange.slot ? "flanges.slot" : "flanges.slotted",
       "slotted: ends of slots of " + length_text(slot) + " for " + size + " are " +
           length_text(std::max(edge, 0.0), 3) + " from the edge of a flange of " + length_text(flange.width),
       "Middles of their half circles are at least " + length_text(least) + " from it" +
           (usual ? " (EN 1993-1-8)." : " (the rules of this shop)."),
       (longest >= hole + kLongerBy ? "slot: " + length_text(longest) + ", or " : std::string()) +
           "width: " + length_text(widest) + ", or a smaller bolt"});
}

}  // namespace glissade::parts
