#include "glissade/io/stations_csv.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/units.hpp"
#include "glissade/io/atomic_file.hpp"

#include "io/text_writer.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <string>

namespace glissade {

using namespace io;

namespace {

constexpr std::array<std::string_view, 9> kTrackColumns = {
    "arc_length_m", "run_m", "drop_m", "x_m", "y_m", "z_m", "slope_angle_deg", "curvature_per_m", "radius_m"};
constexpr std::array<std::string_view, 5> kMotionColumns = {"time_s", "speed_m_per_s", "normal_load_m_per_s2",
                                                            "friction_loss_j_per_kg", "drag_loss_j_per_kg"};

double radius_of(double curvature) {
  return curvature == 0.0 ? std::numeric_limits<double>::infinity() : 1.0 / std::fabs(curvature);
}

std::array<double, kTrackColumns.size()> track_values(const StationRow& station) {
  const CenterlinePoint& point = station.point;
  return {point.arc_length,
          point.x,
          point.drop,
          station.position.x,
          station.position.y,
          station.position.z,
          Angle::from_radians(point.slope_angle).degrees(),
          point.curvature,
          radius_of(point.curvature)};
}

std::array<double, kMotionColumns.size()> motion_values(const MotionState& state) {
  return {state.time, state.speed, state.normal_load, state.friction_loss, state.drag_loss};
}

[[noreturn]] void refuse_nan(std::size_t station, std::string_view column) {
  throw InputError({"station " + std::to_string(station), std::string(column) + " is not a number",
                    "Every value of a station must be a number.", ""});
}

template <std::size_t Count>
void write_values(TextWriter& text, const std::array<double, Count>& values,
                  const std::array<std::string_view, Count>& columns, std::size_t station) {
  for (std::size_t i = 0; i < Count; ++i) {
    if (std::isnan(values[i])) refuse_nan(station, columns[i]);
    if (i > 0) text.put(',');
    text.put(values[i]);
  }
}

void write_motion(TextWriter& text, const std::optional<MotionState>& motion, std::size_t station) {
  text.put(',');
  if (motion) {
    write_values(text, motion_values(*motion), kMotionColumns, station);
  } else {
    text.put(std::string(kMotionColumns.size() - 1, ','));
  }
}

void write_law(TextWriter& text, const std::vector<StationColumn>& columns, std::size_t station) {
  for (const StationColumn& column : columns) {
    text.put(',');
    const std::optional<double> value = column.values.at(station);
    if (!value) continue;
    if (std::isnan(*value)) refuse_nan(station, column.name);
    text.put(*value);
  }
}

/// "speed_m_per_s" at low friction: "speed_low_m_per_s"; the unit stays at the end.
std::string column_at(std::string_view column, FrictionLevel level) {
  for (const std::string_view unit : {"_w_per_m2", "_m_per_s2", "_m_per_s", "_j_per_kg", "_s", "_m"}) {
    if (!column.ends_with(unit)) continue;
    return std::string(column.substr(0, column.size() - unit.size()))
        .append("_")
        .append(to_text(level))
        .append(unit);
  }
  return std::string(column) + "_" + std::string(to_text(level));
}

void write_names(TextWriter& text, const StationTable& stations) {
  text.put(kTrackColumns.front());
  for (std::size_t i = 1; i < kTrackColumns.size(); ++i) text.put(',', kTrackColumns[i]);
  for (const std::string_view column : kMotionColumns) text.put(',', column);
  for (const StationColumn& column : stations.law) text.put(',', column.name);
  for (const StationRange& range : stations.range) {
    for (const std::string_view column : kMotionColumns) text.put(',', column_at(column, range.level));
    for (const StationColumn& column : range.law) text.put(',', column_at(column.name, range.level));
  }
  text.put('\n');
}

}  // namespace

void write_stations_csv(const std::filesystem::path& file, const StationTable& stations) {
  AtomicFile output(file);
  TextWriter text(output);
  write_names(text, stations);
  for (std::size_t i = 0; i < stations.rows.size(); ++i) {
    write_values(text, track_values(stations.rows[i]), kTrackColumns, i);
    write_motion(text, stations.rows[i].motion, i);
    write_law(text, stations.law, i);
    for (const StationRange& range : stations.range) {
      write_motion(text, range.states.at(i), i);
      write_law(text, range.law, i);
    }
    text.put('\n');
  }
  output.commit();
}

}  // namespace glissade
