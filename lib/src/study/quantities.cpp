#include "glissade/study/study.hpp"

#include "pipeline/track_document.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

namespace glissade::study {
namespace {

using report::Json;

/// How far a search came says something of the search, and its seconds differ from run to run.
constexpr std::array<std::string_view, 4> kNoFigures = {"search.rounds", "search.evaluations",
                                                        "search.seconds", "gravity_m_per_s2"};

/// Groups that are there only where a ride ends early, or only where it does not, with their figures, so that every
/// row has the same columns whatever the first one met.
struct Group {
  std::string_view name;
  std::vector<std::string_view> members;
};

const std::vector<Group>& groups() {
  static const std::vector<Group> all = {
      {"stall", {"arc_length_m", "missing_slope_deg"}},
      {"lift_off", {"arc_length_m", "speed_m_per_s", "curvature_per_m"}},
      {"law_end", {"arc_length_m", "speed_m_per_s", "value", "bound"}},
      {"choke", {"arc_length_m", "speed_m_per_s", "depth_m", "bound_m"}},
      {"wear",
       {"highest_floor_wear_w_per_m2", "highest_floor_wear_at_m", "mean_floor_wear_w_per_m2",
        "highest_wall_wear_w_per_m2", "highest_wall_wear_at_m", "loss_at_m", "loss_mm_per_1000_h",
        "loss_mm_per_mt", "liner_life_h"}},
      {"discharge",
       {"speed_along_belt_m_per_s", "speed_into_belt_m_per_s", "speed_across_belt_m_per_s",
        "landing_speed_m_per_s", "speed_along_over_belt_speed", "belt_wear_factor", "belt_wear_w_per_m2",
        "reach_m", "off_centre_m", "time_s"}},
  };
  return all;
}

/// @param name  of a quantity, with the groups that it is in: "rides.high.stream.choke"
const Group* group_of(std::string_view name) {
  for (const Group& group : groups()) {
    if (name == group.name || name.ends_with("." + std::string(group.name))) return &group;
  }
  return nullptr;
}

void add(const std::string& name, const Json& value, std::vector<Quantity>& quantities) {
  if (std::find(kNoFigures.begin(), kNoFigures.end(), name) != kNoFigures.end()) return;
  if (const Group* const group = group_of(name)) {
    for (const std::string_view member : group->members) {
      const bool there = value.is_object() && value.contains(std::string(member));
      add(name + "." + std::string(member), there ? value[std::string(member)] : Json(nullptr), quantities);
    }
  } else if (value.is_number()) {
    quantities.emplace_back(name, value.get<double>());
  } else if (value.is_null() && name != "search") {
    quantities.emplace_back(name, std::nullopt);
  } else if (value.is_object()) {
    for (const auto& [member, inner] : value.items()) add(name + "." + member, inner, quantities);
  }
}

void add_limit(const Json& limit, std::vector<Quantity>& quantities) {
  const std::string prefix = "limits." + limit["limit"].get<std::string>();
  add(prefix + ".reached", limit["reached"], quantities);
  add(prefix + ".violation", limit["violation"], quantities);
}

bool is_stall_margin(std::string_view name) {
  return name.ends_with("stall_friction_angle_deg") || name.ends_with("stall_margin_deg");
}

/// The ends of a friction range; the nominal ride is the track's own, but for how far it is from a stall.
void add_ride(const Json& ride, std::vector<Quantity>& quantities) {
  const auto level = ride["friction"].get<std::string>();
  const bool nominal = level == to_text(FrictionLevel::nominal);
  for (const auto& [name, value] : ride.items()) {
    // Where such a ride ends early is said by its status in --json; here its time is empty.
    if (name == "stall" || name == "lift_off" || is_stall_margin(name)) continue;
    if (!nominal) add("rides." + level + "." + name, value, quantities);
  }
}

void add_stall_margins(const Json& rides, std::vector<Quantity>& quantities) {
  for (const Json& ride : rides) {
    const auto level = ride["friction"].get<std::string>();
    const std::string prefix = level == to_text(FrictionLevel::nominal) ? "" : "rides." + level + ".";
    for (const auto& [name, value] : ride.items()) {
      if (is_stall_margin(name)) add(prefix + name, value, quantities);
    }
  }
}

std::vector<Quantity> quantities(const Design& design, const Track& track, pipeline::Told told) {
  const Json json = pipeline::track_document(design, track, told);
  std::vector<Quantity> quantities;
  for (const auto& [name, value] : json.items()) {
    if (name == "limits") {
      for (const Json& limit : value) add_limit(limit, quantities);
    } else if (name == "rides") {
      for (const Json& ride : value) add_ride(ride, quantities);
      if (told == pipeline::Told::figures_and_stall_margin) add_stall_margins(value, quantities);
    } else {
      add(name, value, quantities);
    }
  }
  return quantities;
}

}  // namespace

std::vector<Quantity> quantities_of(const Design& design, const Track& track) {
  return quantities(design, track, pipeline::Told::figures);
}

std::vector<Quantity> quantities_with_stall_margins(const Design& design, const Track& track) {
  return quantities(design, track, pipeline::Told::figures_and_stall_margin);
}

bool needs_stall_margins(const std::vector<std::string>& columns) {
  return std::any_of(columns.begin(), columns.end(), is_stall_margin);
}

}  // namespace glissade::study
