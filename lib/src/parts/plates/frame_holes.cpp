#include "parts/plates/frame_holes.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/slot.hpp"

#include "parts/shop/bolts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace glissade::parts {
namespace {

constexpr double kUsualSlot = 2.5;    // of the bolt's diameter, overall: long slots of EN 1090-2, table 11
constexpr double kAtTop = 1.5;        // hole diameters below the top of a frame
constexpr double kLongerBy = 1e-3;    // than wide: slots that are less are round holes [m]
constexpr double kStep = 0.5e-3;      // of what is advised [m]
constexpr int kTries = 1000;          // of such steps
constexpr double kSameLength = 1e-9;  // [m]

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

/// Whether a frame's bolts keep their distance, whichever of the two that meet is drilled.
bool far_enough(const PlateOptions& options, const FlangeOptions& flange, const FrameBolts& bolts) {
  return nearest(bolts(flange), slot_reach(flange)) >= least_apart(options) - kSameLength;
}

/// The next pitch at which bolts that are spread evenly keep their distance.
std::optional<double> next_pitch(const PlateOptions& options, const FrameBolts& bolts) {
  FlangeOptions other = options.flanges;
  // No two are farther apart than the pitch.
  const double from = std::max(std::floor(options.flanges.pitch / kStep + 1e-9) + 1.0,
                               std::ceil(least_apart(options) / kStep - 1e-9));
  for (int k = 0; k < kTries; ++k) {
    other.pitch = kStep * (from + k);
    if (far_enough(options, other, bolts)) return other.pitch;
  }
  return std::nullopt;
}

/// The next shorter slot that does.
std::optional<double> next_slot(const PlateOptions& options, const FrameBolts& bolts) {
  FlangeOptions other = options.flanges;
  if (!other.slotted || other.pitch < least_apart(options)) return std::nullopt;
  const double shortest = widest_hole(other) + kLongerBy;
  for (int k = 1; k <= kTries; ++k) {
    other.slot = kStep * (std::ceil(slot_length(options.flanges) / kStep - 1e-9) - k);
    if (*other.slot < shortest) break;
    if (far_enough(options, other, bolts)) return other.slot;
  }
  return std::nullopt;
}

/// What asks that holes are so far apart.
std::string asked_apart(const ShopLeast& shop) {
  if (hole_pitch_diameters(shop) > shop.hole_pitch_diameters) return " (less leaves no web)";
  return shop.hole_pitch_diameters == ShopLeast{}.hole_pitch_diameters ? " (EN 1993-1-8)"
                                                                       : " (the rules of this shop)";
}

/// Refuses a pitch at which bolts would stand too near each other. Of round holes that no pitch puts farther apart the rules of the
/// shop tell.
void require_pitch(const PlateOptions& options, const FrameBolts& bolts) {
  const FlangeOptions& flange = options.flanges;
  const double least = least_apart(options);
  // Bolts at a pitch that is smaller than that are not counted: there may be any number.
  const bool small = flange.pitch < least;
  if (!small && far_enough(options, flange, bolts)) return;
  const auto pitch = next_pitch(options, bolts);
  if (!small && !pitch && !flange.slotted) return;
  const std::string size = flange.slotted ? "slots of " + length_text(slot_length(flange))
                                          : "holes of " + length_text(widest_hole(flange));
  const std::string what =
      small ? "pitch: " + length_text(flange.pitch) + " is too close for M" + std::to_string(flange.bolt)
            : "pitch: " + size + " stand " + length_text(nearest(bolts(flange), slot_reach(flange)), 3) +
                  (flange.slotted ? " from end to end" : " apart") + " at a pitch of " +
                  length_text(flange.pitch);
  const std::string why =
      (flange.slotted ? "Ends of slots are at least " + length_text(least) + " apart, as middles of holes are"
                      : "Middles of holes of " + length_text(widest_hole(flange)) + " are at least " +
                            length_text(least) + " apart") +
      asked_apart(options.shop) + ".";
  std::string ways;
  if (pitch) ways += "pitch: " + length_text(*pitch) + ", ";
  if (const auto slot = next_slot(options, bolts)) ways += "slot: " + length_text(*slot) + ", ";
  throw InputError({"flanges.pitch", what, why, ways + (ways.empty() ? "" : "or ") + "a smaller bolt"});
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

double bolts_below_rim(const PlateOptions& options) {
  constexpr double kOffRim = 1e-3;  // taste: of washers from its underside [m]
  const FlangeOptions& flange = options.flanges;
  // Before an angle's other leg a rim ends farther off than heads and nuts reach.
  if (!options.rim || !flange.wanted || flange.section == FlangeSection::angle) return 0.0;
  const Bolt& bolt = bolt_of(flange.bolt);
  const double half = 0.5 * (flange.slotted ? bolt.large_washer : bolt.washer) + kOffRim;
  if (options.rim->width < flange.gap + 0.5 * flange.width - half) return 0.0;
  return options.rim->thickness + half + slot_reach(flange);
}

std::string frame_name(const std::string& name, const FlangeOptions& flange, FlangeSide side) {
  if (!is_loose(flange, side)) return name;
  return name + (flange.slotted ? "_slotted" : "_loose");
}

void drill_frame(const PlateOptions& options, FlangeSide side, const FrameBolts& bolts, PlaneRegion& region) {
  const FlangeOptions& flange = options.flanges;
  require_pitch(options, bolts);
  const std::vector<Vec2> all = bolts(flange);
  const double reach = slot_reach(flange);
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
