#include "pipeline/stations.hpp"

#include "report/ride_stations.hpp"

#include <algorithm>

namespace glissade {
namespace {

/// The body at the stations, none from where its ride ends.
std::vector<std::optional<MotionState>> states_at(const Motion& motion,
                                                  const std::vector<double>& arc_lengths) {
  const auto end = std::upper_bound(arc_lengths.begin(), arc_lengths.end(), motion.distance());
  const std::vector<MotionState> ridden = motion.at(std::vector<double>(arc_lengths.begin(), end));
  std::vector<std::optional<MotionState>> states(ridden.begin(), ridden.end());
  states.resize(arc_lengths.size());
  return states;
}

}  // namespace

StationTable pipeline::stations_of(const Track& track, const std::vector<double>& arc_lengths) {
  StationTable table;
  const std::vector<std::optional<MotionState>> states = states_at(track.motion, arc_lengths);
  for (std::size_t index = 0; index < arc_lengths.size(); ++index) {
    const CenterlinePoint point = track.centerline->at(arc_lengths[index]);
    table.rows.push_back({point, track.placement.to_space(point.x, point.drop, 0.0), states[index]});
  }
  for (const RangeRide& ride : track.range)
    table.range.push_back({ride.level, states_at(ride.motion, arc_lengths)});
  return table;
}

void write_track_csv(const std::filesystem::path& file, const Track& track) {
  write_stations_csv(file, pipeline::stations_of(track, report::track_stations(*track.centerline)));
}

}  // namespace glissade
