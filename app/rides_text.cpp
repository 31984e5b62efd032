#include "app/rides_text.hpp"

#include "glissade/core/number_text.hpp"

#include "app/law_text.hpp"
#include "app/summary.hpp"

#include <string_view>
#include <utility>
#include <vector>

namespace glissade::app {
namespace {

constexpr int kDigits = 4;

std::string time_of(const Motion& motion) {
  if (!enters(motion)) return std::string(ride_status(motion));
  if (motion.arrived()) return time_text(motion.travel_time());
  if (motion.stall()) return "stalls after " + length_text(motion.stall()->arc_length, kDigits);
  if (motion.law_end())
    return std::string(ride_status(motion)) + " after " + length_text(motion.distance(), kDigits);
  return "leaves after " + length_text(motion.lift_off()->arc_length, kDigits);
}

std::string margin_text(const Motion& motion, const std::optional<Angle>& stall_angle) {
  if (!lands(motion)) return "-";
  // Of what does not get down the track as it is nothing follows for other frictions.
  if (!stall_angle) return motion.arrived() ? "never stalls" : "-";
  return angle_text(*stall_angle - motion.body().friction.angle(), 3);
}

std::string stall_text(const Track& track, const std::optional<Angle>& stall_angle) {
  if (!stall_angle) return "at no friction angle below 89.9 deg";
  if (stall_angle->radians() == 0.0) return "even without friction";
  const Angle margin = *stall_angle - track.motion.body().friction.angle();
  const LawPtr& law = track.motion.body().law;
  const std::string_view resistance = law ? law->resistance_angle_name() : kFrictionAngleName;
  const bool vowel = std::string_view("aeiou").find(resistance.front()) != std::string_view::npos;
  return (vowel ? "an " : "a ") + std::string(resistance) + " of " + angle_text(*stall_angle) + " (margin " +
         angle_text(margin, 3) + ")";
}

}  // namespace

Table rides_table(const std::string& heading) {
  return Table(
      {heading, "travel time", "exit speed", "highest speed", "highest load", "lowest load", "stall margin"});
}

void add_ride(Table& table, const std::string& name, const Motion& motion,
              const std::optional<Angle>& stall_angle, const std::string& limits) {
  const bool there = enters(motion);
  std::vector<std::string> row = {name,
                                  time_of(motion),
                                  there && motion.arrived() ? speed_text(motion.exit_speed()) : "-",
                                  there ? speed_text(motion.highest_speed().speed) : "-",
                                  there ? acceleration_text(motion.highest_load().normal_load) : "-",
                                  there ? acceleration_text(motion.lowest_load().normal_load) : "-",
                                  margin_text(motion, stall_angle)};
  if (!limits.empty()) row.push_back(limits);
  table.add(std::move(row));
}

std::string friction_lines(const Track& track) {
  const std::optional<Angle> stall_angle = stall_angle_of(track);
  // Nothing is known of the impact of what flies over the start.
  const bool told = lands(track.motion) && (stall_angle || track.motion.arrived());
  std::string text = told ? labelled("Stalls from", stall_text(track, stall_angle)) : "";
  if (track.range.empty()) return text;
  Table table = rides_table("Friction");
  for (const LevelRide& ride : track.rides()) {
    const Angle angle = ride.motion->body().friction.angle();
    add_ride(table, std::string(to_text(ride.level)) + ", " + angle_text(angle), *ride.motion, stall_angle);
  }
  return text + "\n" + table.text();
}

}  // namespace glissade::app
