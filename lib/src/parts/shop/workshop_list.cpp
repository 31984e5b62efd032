#include "parts/shop/workshop_list.hpp"

#include "glissade/core/number_text.hpp"

#include "parts/bodies/body_moments.hpp"
#include "parts/shop/bolts.hpp"
#include "parts/shop/equal_parts.hpp"
#include "parts/shop/pattern_marks.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

namespace glissade::parts {
namespace {

/// A part's name without the side of the section on which it lies.
std::string name_without_side(const std::string& name) {
  for (const char* const side : {"left_", "right_"}) {
    if (name.starts_with(side)) return name.substr(std::string_view(side).size());
  }
  return name;
}

}  // namespace

int add_part(Workshop& workshop, ShopPart part, const std::array<double, 3>& colour) {
  if (part.pattern) clip_lines(*part.pattern);
  for (ShopPart& other : workshop.parts) {
    // Where the other one's body lies in this one's frame.
    const auto inner = place_in(other, part);
    if (!inner) continue;
    for (const Frame& place : part.places) other.places.push_back(placed(place, *inner));
    if (name_without_side(part.name) != part.name && name_without_side(other.name) != other.name &&
        part.name.front() != other.name.front())
      other.name = name_without_side(other.name);
    return other.number;
  }
  part.number = static_cast<int>(workshop.parts.size()) + 1;
  part.colour = colour;
  if (part.pattern) set_number_place(*part.pattern, part.number);
  workshop.parts.push_back(std::move(part));
  return workshop.parts.back().number;
}

void take_back(Workshop& workshop, ShopPart part, const Frame& place) {
  if (part.pattern) clip_lines(*part.pattern);
  for (ShopPart& other : workshop.parts) {
    const auto inner = place_in(other, part);
    if (!inner) continue;
    const Vec3 there = placed(place, *inner).origin;
    const auto found = std::find_if(other.places.begin(), other.places.end(),
                                    [&](const Frame& one) { return norm(one.origin - there) <= kSamePart; });
    if (found == other.places.end()) continue;
    other.places.erase(found);
    if (!other.places.empty())
      other.centre_of_gravity = other.places.front().to_space(moments(other.body).centroid);
    return;
  }
}

void add_note(std::string note, Workshop& workshop) {
  if (std::find(workshop.notes.begin(), workshop.notes.end(), note) == workshop.notes.end())
    workshop.notes.push_back(std::move(note));
}

void add_shortfall(Issue shortfall, Workshop& workshop) {
  std::vector<Issue>& all = workshop.shortfalls;
  if (std::find(all.begin(), all.end(), shortfall) == all.end()) all.push_back(std::move(shortfall));
}

void tell_short_plate(const std::string& name, double from, double to, double length, Workshop& workshop) {
  add_shortfall({"cross_section",
                 "cross_section: the " + name + " goes from " + length_text(from, 4) + " to " +
                     length_text(to, 4) + " along the track, which is " + length_text(length, 4) + " long",
                 "Beyond, its rim would fold over: the track bends there with a smaller radius than the rim "
                 "is high above it.",
                 "lower walls, or a larger radius there"},
                workshop);
}

void tell_moved_opening(double asked, double at, const std::string& why, Workshop& workshop) {
  constexpr double kTold = 0.5e-3;  // [m]
  if (std::fabs(at - asked) < kTold) return;
  add_shortfall({"inspection",
                 "at: the opening that is asked for at " + length_text(asked, 4) + " along the track is at " +
                     length_text(at, 4) + ", " + length_text(std::fabs(at - asked), 2) +
                     (at > asked ? " farther down" : " farther up"),
                 why, "at: " + length_text(at, 4) + " if that will do, or another one"},
                workshop);
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

namespace {

/// Bolts and nuts without washers.
void add_fastener(Workshop& workshop, int size, double grip, std::size_t count, const std::string& where) {
  const std::string name = "M" + std::to_string(size);
  add_item(workshop, {"bolt " + name + " x " + rounded_text(1e3 * bolt_length(bolt_of(size), grip), 4),
                      "ISO 4017 8.8", count, where});
  add_item(workshop, {"nut " + name, "ISO 4032 8", count, where});
}

}  // namespace

void add_bolts(Workshop& workshop, int size, double grip, std::size_t count, const std::string& where) {
  const std::string name = "M" + std::to_string(size);
  add_fastener(workshop, size, grip, count, where);
  add_item(workshop, {"washer " + name, "ISO 7089 200 HV", 2 * count, where});
}

void add_timber_bolts(Workshop& workshop, int size, double grip, std::size_t count,
                      const std::string& where) {
  const Bolt& bolt = bolt_of(size);
  constexpr double kWasher = 0.3;  // thickness over the diameter: ISO 7094, and EN 1995-1-1, 10.4.3
  constexpr double kStep = 10e-3;  // long bolts come in these
  const double washers = 2.0 * (kWasher * 1e-3 * size - bolt.washer_height);
  const double length = kStep * std::ceil(least_bolt_length(bolt, grip + washers) / kStep - 1e-9);
  const std::string name = "M" + std::to_string(size);
  add_item(workshop, {"bolt " + name + " x " + rounded_text(1e3 * length, 4), "EN 14592", count, where});
  add_item(workshop, {"nut " + name, "ISO 4032 8", count, where});
  add_item(workshop, {"large washer " + name, "ISO 7094 100 HV", 2 * count, where});
}

void add_joint_bolts(Workshop& workshop, const FlangeOptions& flange, std::size_t bolts, std::size_t joints) {
  if (joints == 0) return;
  const std::string where = joints == 1 ? "at the joint" : "at the " + std::to_string(joints) + " joints";
  const double grip = 2.0 * flange.thickness;
  if (!flange.slotted) return add_bolts(workshop, flange.bolt, grip, bolts, where);
  // A usual washer would sink into the slot.
  const Bolt& bolt = bolt_of(flange.bolt);
  const double more = bolt.large_washer_height - bolt.washer_height;
  const std::string name = "M" + std::to_string(flange.bolt);
  add_fastener(workshop, flange.bolt, grip + more, bolts, where);
  add_item(workshop, {"washer " + name, "ISO 7089 200 HV", bolts, where});
  add_item(workshop, {"large washer " + name, "ISO 7093-1 200 HV", bolts, where + ", on the slots"});
}

void note_differences(const PartsProof& proof, const std::string& whole, Workshop& workshop) {
  if (proof.differences.empty()) return;
  std::string listed;
  for (const VolumeDifference& difference : proof.differences) {
    listed += (listed.empty() ? "" : ", ") + difference.what + " " + (difference.volume > 0.0 ? "+" : "") +
              rounded_text(1e6 * difference.volume, 6) + " cm^3";
  }
  workshop.notes.push_back("Against " + whole + ": " + listed + ".");
}

}  // namespace glissade::parts
