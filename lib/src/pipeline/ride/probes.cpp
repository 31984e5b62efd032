#include "glissade/pipeline/probes.hpp"

#include "glissade/core/number_text.hpp"

#include "pipeline/ride/probes.hpp"

#include <algorithm>
#include <cstddef>

namespace glissade {
namespace {

std::string name_of(const ProbeDesign& probe, const TrackDesign& track) {
  if (!probe.name.empty()) return probe.name;
  switch (probe.origin) {
    case ProbeOrigin::start:
      return length_text(probe.at) + " from the start";
    case ProbeOrigin::finish:
      return length_text(probe.at) + " from the finish";
    case ProbeOrigin::x:
      // Of a track that is turned in plan it counts along the run, which is no x of the site.
      return (track.start.y == track.finish.y ? "x = " : "run = ") + length_text(probe.at);
  }
  return "";
}

/// @return the arc length of a probe; none if the track does not have it
std::optional<double> arc_length_of(const Design& design, const Track& found, const ProbeDesign& probe) {
  const Centerline& track = *found.centerline;
  const double length = track.length();
  // Both ends are on it, however they are rounded.
  constexpr double kRounding = 1e-9;
  const double beyond = kRounding * length;
  switch (probe.origin) {
    case ProbeOrigin::start:
      return probe.at <= length + beyond ? std::optional(std::min(probe.at, length)) : std::nullopt;
    case ProbeOrigin::finish:
      return probe.at <= length + beyond ? std::optional(std::max(length - probe.at, 0.0)) : std::nullopt;
    case ProbeOrigin::x:
      break;
  }
  TrackDesign placed = design.track;
  placed.start = found.placement.start();
  const double run = in_track_plane(placed, {probe.at, placed.start.z}).x;
  const double whole = track.endpoints().run;
  if (run < -beyond || run > whole + beyond) return {};
  return track.arc_length_at_run(std::clamp(run, 0.0, whole));
}

}  // namespace

std::vector<ProbeReading> probe_readings(const Design& design, const Track& track) {
  std::vector<ProbeReading> readings;
  for (const ProbeDesign& probe : design.probes) {
    const auto s = arc_length_of(design, track, probe);
    if (!s) continue;
    ProbeReading reading{name_of(probe, design.track), track.centerline->at(*s), {}, {}};
    reading.position = track.placement.to_space(reading.point.x, reading.point.drop, 0.0);
    for (const LevelRide& ride : track.rides()) {
      ProbeState state{ride.level, {}};
      if (enters(*ride.motion) && *s <= ride.motion->distance()) state.motion = ride.motion->at(*s);
      reading.states.push_back(state);
    }
    readings.push_back(std::move(reading));
  }
  return readings;
}

std::vector<Issue> pipeline::probes_beside_track(const Design& design, const Track& track) {
  std::vector<Issue> issues;
  for (std::size_t index = 0; index < design.probes.size(); ++index) {
    const ProbeDesign& probe = design.probes[index];
    if (arc_length_of(design, track, probe)) continue;
    const std::string key = "probes[" + std::to_string(index) + "]";
    issues.push_back({design.where("probes." + std::to_string(index)),
                      key + ", " + name_of(probe, design.track) + ", does not lie on the track",
                      "The track is " + length_text(track.centerline->length()) + " long and has a run of " +
                          length_text(track.endpoints.run) + ".",
                      "a place on it"});
  }
  return issues;
}

}  // namespace glissade
