#include "pipeline/ride/stations.hpp"

#include "glissade/centerline/tabulated_curve.hpp"
#include "glissade/core/math.hpp"
#include "glissade/motion/laws/bulk_stream.hpp"

#include "report/ride_stations.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <utility>

namespace glissade {
namespace {

/// Up to where a body rides; below nothing for one that flies over the start.
double end_of_ride(const Motion& motion) {
  return lands(motion) ? motion.distance() : -1.0;
}

/// The body at the stations, none from where its ride ends.
std::vector<std::optional<MotionState>> states_at(const Motion& motion,
                                                  const std::vector<double>& arc_lengths) {
  const auto end = std::upper_bound(arc_lengths.begin(), arc_lengths.end(), end_of_ride(motion));
  const std::vector<MotionState> ridden = motion.at(std::vector<double>(arc_lengths.begin(), end));
  std::vector<std::optional<MotionState>> states(ridden.begin(), ridden.end());
  states.resize(arc_lengths.size());
  return states;
}

/// A column with a value wherever the body comes.
StationColumn column(std::string name, const Motion& motion, const std::vector<double>& arc_lengths,
                     const std::function<double(double)>& value) {
  StationColumn result{std::move(name), {}};
  for (const double s : arc_lengths) {
    result.values.push_back(s <= end_of_ride(motion) ? std::optional(value(s)) : std::nullopt);
  }
  return result;
}

/// What the law of a body says: its quantities, whether those that have a bound keep it, and of a stream the wear.
std::vector<StationColumn> law_columns(const Motion& motion, const std::vector<double>& arc_lengths) {
  std::vector<StationColumn> columns;
  const std::vector<LawQuantity> quantities = motion.quantities();
  for (std::size_t i = 0; i < quantities.size(); ++i) {
    const LawQuantity& quantity = quantities[i];
    const auto value = [&](double s) { return motion.quantity(i, s); };
    columns.push_back(column(std::string(quantity.key), motion, arc_lengths, value));
    if (!quantity.highest || quantity.ends_ride) continue;
    columns.push_back(column(std::string(quantity.key) + "_kept", motion, arc_lengths,
                             [&](double s) { return value(s) <= *quantity.highest ? 1.0 : 0.0; }));
  }
  if (const auto* const stream = dynamic_cast<const BulkStream*>(motion.body().law.get())) {
    columns.push_back(column("floor_wear_w_per_m2", motion, arc_lengths, [&](double s) {
      const LawState at = motion.law_state(s);
      return stream->floor_wear(s, Friction::from_coefficient(at.friction), at.normal_load);
    }));
  }
  return columns;
}

/// Where the centre of mass is, of a body whose centre is not on the track.
void add_centre(const Track& track, const std::vector<double>& arc_lengths, StationTable& table) {
  const LawPtr& law = track.motion.body().law;
  const double height = law ? law->centre_height() : 0.0;
  if (height == 0.0) return;
  StationColumn run{"centre_run_m", {}};
  StationColumn drop{"centre_drop_m", {}};
  for (const double s : arc_lengths) {
    const CenterlinePoint point = track.centerline->at(s);
    run.values.emplace_back(point.x + height * math::sin(point.slope_angle));
    drop.values.emplace_back(point.drop - height * math::cos(point.slope_angle));
  }
  table.law.insert(table.law.begin(), {std::move(run), std::move(drop)});
}

}  // namespace

StationTable pipeline::stations_of(const Track& track, const std::vector<double>& arc_lengths) {
  StationTable table;
  const std::vector<std::optional<MotionState>> states = states_at(track.motion, arc_lengths);
  for (std::size_t index = 0; index < arc_lengths.size(); ++index) {
    const CenterlinePoint point = track.centerline->at(arc_lengths[index]);
    table.rows.push_back({point, track.placement.to_space(point.x, point.drop, 0.0), states[index]});
  }
  table.law = law_columns(track.motion, arc_lengths);
  add_centre(track, arc_lengths, table);
  for (const RangeRide& ride : track.range) {
    table.range.push_back(
        {ride.level, states_at(ride.motion, arc_lengths), law_columns(ride.motion, arc_lengths)});
  }
  return table;
}

namespace {

/// The breaks at which curvature jumps.
std::vector<double> jumps_of(const Centerline& centerline) {
  constexpr double kJump = 1e-9;  // rounding: of both curvatures, as in table_of()
  const std::vector<double> breaks = centerline.breaks();
  std::vector<double> jumps;
  for (std::size_t i = 1; i + 1 < breaks.size(); ++i) {
    const double before = centerline.direction(std::nextafter(breaks[i], 0.0)).curvature;
    const double after = centerline.direction(breaks[i]).curvature;
    if (!(std::fabs(after - before) > kJump * (std::fabs(after) + std::fabs(before)))) continue;
    if (jumps.empty() || jumps.back() < breaks[i]) jumps.push_back(breaks[i]);
  }
  return jumps;
}

/// How near to each other lines of a table may lie whose coordinates count from the origin of the site.
double shortest_between(const Track& track) {
  constexpr double kDigits = 256.0;  // rounding: last digits of coordinates between two lines
  const Endpoints end = track.centerline->endpoints();
  double farthest = 0.0;
  for (const Vec3& at : {track.placement.start(), track.placement.to_space(end.run, end.drop, 0.0)}) {
    farthest = std::max({farthest, std::fabs(at.x), std::fabs(at.y), std::fabs(at.z)});
  }
  return kDigits * std::numeric_limits<double>::epsilon() * farthest;
}

/// The place and what adds up along the ride are those of the station itself; curvature and load stay those of before it.
void move_to(const MotionState& there, std::optional<MotionState>& state) {
  if (!state) return;
  const double load = state->normal_load;
  state = there;
  state->normal_load = load;
}

/// Makes of the station just before a jump a second one at the jump.
void move_to_next(StationTable& table, std::size_t index) {
  StationRow& row = table.rows[index];
  const StationRow& next = table.rows[index + 1];
  const double curvature = row.point.curvature;
  row.point = next.point;
  row.point.curvature = curvature;
  row.position = next.position;
  if (next.motion) move_to(*next.motion, row.motion);
  for (StationRange& range : table.range) {
    if (range.states[index + 1]) move_to(*range.states[index + 1], range.states[index]);
  }
}

}  // namespace

void write_track_csv(const std::filesystem::path& file, const Track& track) {
  // Kind `points` reads the table back: it is as dense as that asks for, and has both curvatures of a jump.
  const Centerline& centerline = *track.centerline;
  const std::vector<double> jumps = jumps_of(centerline);
  std::vector<double> places;
  std::vector<std::size_t> before_jumps;
  for (const double s :
       places_for_table(centerline, report::track_stations(centerline), shortest_between(track))) {
    if (std::binary_search(jumps.begin(), jumps.end(), s)) {
      before_jumps.push_back(places.size());
      places.push_back(std::nextafter(s, 0.0));
    }
    places.push_back(s);
  }
  StationTable table = pipeline::stations_of(track, places);
  for (const std::size_t index : before_jumps) move_to_next(table, index);
  write_stations_csv(file, table);
}

}  // namespace glissade
