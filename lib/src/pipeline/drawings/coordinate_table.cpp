#include "glissade/centerline/in_run.hpp"
#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/io/atomic_file.hpp"
#include "glissade/pipeline/profile_drawing.hpp"

#include "pipeline/drawings/letters.hpp"
#include "pipeline/ride/extremes.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace glissade {

using namespace pipeline;

std::vector<Letter> pipeline::letters_of(const Design& design, const Centerline& centerline) {
  const auto* const in_run = dynamic_cast<const InRun*>(&centerline);
  if (in_run == nullptr) return {{"start", 0.0}, {"finish", centerline.length()}};
  std::vector<Letter> letters = {{"A", 0.0}};
  if (const auto area = design.centerline.in_run.start_area(); area && *area > 0.0)
    letters.push_back({"B", *area});
  letters.push_back({"E1", in_run->transition_begins()});
  letters.push_back({"E2", in_run->table_begins()});
  letters.push_back({"T", in_run->length()});
  return letters;
}

namespace {

constexpr double kMostStations = 1e5;

/// @return 1, 2 or 5 times a power of ten that makes some hundred stations
double round_step_along(double length) {
  constexpr double kStations = 100.0;  // taste
  const double step = length / kStations;
  const double decade = math::decade_of(step);
  return step >= 5.0 * decade ? 5.0 * decade : step >= 2.0 * decade ? 2.0 * decade : decade;
}

double step_along(double length, const ProfileOptions& options) {
  constexpr double kMetre = 1.0;  // what in-runs are laid out by
  constexpr double kShort = 20.0;
  constexpr double kLong = 2000.0;
  return options.step.value_or(length < kShort || length > kLong ? round_step_along(length) : kMetre);
}

void require_options(const Track& track, const ProfileOptions& options) {
  const double length = track.centerline->length();
  const double step = step_along(length, options);
  if (!(step > 0.0) || length / step > kMostStations) {
    throw InputError(
        {"--step", "a step of " + length_text(step) + " is out of range",
         "It is above 0, and a track of " + length_text(length) + " has at most 100 000 stations.",
         length_text(round_step_along(length))});
  }
  const Centerline& centerline = *track.centerline;
  if (centerline.unbounded_curvature_at_start() && !options.parallels.empty()) {
    throw InputError({"--offset",
                      "the track starts with unbounded curvature: nothing is parallel to it there", "",
                      "limits: {smallest_radius: ...} in the design"});
  }
  for (const ParallelLine& line : options.parallels) {
    const auto bend = [&](double s) { return line.height * centerline.direction(s).curvature; };
    const Extreme most = highest_along(centerline, bend);
    if (most.value < 1.0) continue;
    throw InputError({"--offset",
                      line.name + ": " + length_text(line.height) + " turns back on itself " +
                          length_text(most.at) + " down the track",
                      "A parallel line ends at the centre of curvature, " +
                          length_text(std::fabs(line.height) / most.value) + " from the track there.",
                      "a line closer to the track"});
  }
}

/// Arc lengths of the stations between the letters, ascending.
std::vector<double> rows_of(const Centerline& centerline, const ProfileOptions& options) {
  const double length = centerline.length();
  const double step = step_along(length, options);
  const double reach = options.row == CountedFrom::run ? centerline.endpoints().run : length;
  std::vector<double> rows;
  for (int i = 0; i * step <= reach; ++i) {
    const double at = i * step;
    if (options.row == CountedFrom::arc_length) rows.push_back(at);
    if (options.row == CountedFrom::to_edge) rows.push_back(length - at);
    if (options.row == CountedFrom::run) rows.push_back(centerline.arc_length_at_run(reach - at));
  }
  return rows;
}

ProfileStation station_at(const Track& track, double s, const ProfileOptions& options) {
  const CenterlinePoint point = track.centerline->at(s);
  ProfileStation station;
  station.arc_length = s;
  station.to_edge = track.centerline->length() - s;
  station.position = track.placement.to_space(point.x, point.drop, 0.0);
  station.slope_angle = Angle::from_radians(point.slope_angle);
  station.curvature = point.curvature;
  for (const ParallelLine& line : options.parallels) {
    const double x = point.x + line.height * math::sin(point.slope_angle);
    const double drop = point.drop - line.height * math::cos(point.slope_angle);
    station.parallels.push_back(track.placement.to_space(x, drop, 0.0));
  }
  return station;
}

}  // namespace

std::vector<ProfileStation> coordinate_table(const Design& design, const Track& track,
                                             const ProfileOptions& options) {
  require_options(track, options);
  const Centerline& centerline = *track.centerline;
  std::vector<std::pair<double, std::string>> places;
  for (const double s : rows_of(centerline, options)) places.emplace_back(s, "");
  for (const Letter& letter : letters_of(design, centerline))
    places.emplace_back(letter.arc_length, letter.name);
  std::sort(places.begin(), places.end());
  std::vector<ProfileStation> stations;
  constexpr double kSame = 1e-9;  // [m]
  for (const auto& [s, name] : places) {
    if (!stations.empty() && s - stations.back().arc_length < kSame &&
        (name.empty() || stations.back().name.empty())) {
      if (stations.back().name.empty()) stations.back().name = name;
      continue;
    }
    stations.push_back(station_at(track, s, options));
    stations.back().name = name;
  }
  return stations;
}

void write_coordinates_csv(const std::filesystem::path& file, const std::vector<ProfileStation>& stations,
                           const ProfileOptions& options) {
  std::string text = "name,arc_length_m,to_edge_m,x_m,y_m,z_m,slope_angle_deg,curvature_per_m";
  for (const ParallelLine& line : options.parallels) {
    for (const char* const axis : {"_x_m", "_y_m", "_z_m"}) text += "," + line.name + axis;
  }
  text += "\n";
  const auto add = [&](Vec3 at) {
    for (const double value : {at.x, at.y, at.z}) text += "," + exact_text(value);
  };
  for (const ProfileStation& station : stations) {
    text += station.name + "," + exact_text(station.arc_length) + "," + exact_text(station.to_edge);
    add(station.position);
    text += "," + exact_text(station.slope_angle.degrees());
    text += "," + (std::isfinite(station.curvature) ? exact_text(station.curvature) : std::string());
    for (const Vec3& at : station.parallels) add(at);
    text += "\n";
  }
  write_atomically(file, text);
}

}  // namespace glissade
