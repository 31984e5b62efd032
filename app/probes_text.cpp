#include "app/probes_text.hpp"

#include "glissade/core/number_text.hpp"
#include "glissade/pipeline/probes.hpp"

#include "app/summary.hpp"
#include "app/table.hpp"

#include <string>
#include <vector>

namespace glissade::app {
namespace {

/// One row a friction; what does not depend on it stands in the first.
void add_rows(Table& table, const ProbeReading& probe, bool ranged) {
  std::string name = probe.name;
  std::string place = length_text(probe.point.arc_length);
  std::string slope = angle_text(Angle::from_radians(probe.point.slope_angle));
  for (const ProbeState& state : probe.states) {
    std::vector<std::string> row = {name, place, slope};
    if (ranged) row.emplace_back(to_text(state.level));
    if (state.motion) {
      row.push_back(speed_text(state.motion->speed));
      row.push_back(load_text(state.motion->normal_load));
      row.push_back(time_text(state.motion->time));
    } else {
      row.emplace_back("the body does not come here");
    }
    table.add(std::move(row));
    name = place = slope = "";
  }
}

}  // namespace

std::string probes_lines(const Design& design, const Track& track) {
  const std::vector<ProbeReading> probes = probe_readings(design, track);
  if (probes.empty()) return "";
  const bool ranged = !track.range.empty();
  std::vector<std::string> headings = {"Probe", "arc length", "slope angle"};
  if (ranged) headings.emplace_back("friction");
  for (const char* heading : {"speed", "normal load", "time"}) headings.emplace_back(heading);
  Table table(std::move(headings));
  for (const ProbeReading& probe : probes) add_rows(table, probe, ranged);
  return "\n" + table.text();
}

}  // namespace glissade::app
