#include "glissade/pipeline/surveys.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/version.hpp"
#include "glissade/io/atomic_file.hpp"
#include "glissade/io/csv_columns.hpp"

#include "core/millimetres.hpp"
#include "report/serial/vocabulary.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace glissade {

using namespace report;

namespace {

/// Of points without y what their x says of the track, along which it grows by cos(azimuth).
void require_run_from_x(const std::filesystem::path& file, Angle azimuth) {
  constexpr double kLeast = 0.1;  // taste: ten millimetres along the track are one of x
  if (std::fabs(math::cos(azimuth.radians())) >= kLeast) return;
  throw FileError(
      {file.string(), "there is no column y, and the track leads along y",
       "With an azimuth of " + angle_text(azimuth) + " x says next to nothing of where a point lies.",
       "columns x, y and z"});
}

}  // namespace

std::vector<SurveyPoint> read_survey(const std::filesystem::path& file, const Placement& placement) {
  const CsvColumns columns = CsvColumns::read(file, "the survey");
  constexpr std::string_view kAxes = "x,z or name,x,y,z, in metres";
  columns.require({{"x", kAxes}, {"z", kAxes}});
  columns.require_spelt({"name", "x", "y", "z"});
  if (!columns.has("y")) require_run_from_x(file, placement.azimuth());
  const double azimuth = placement.azimuth().radians();
  const Vec3 start = placement.start();
  std::vector<SurveyPoint> points;
  for (std::size_t row = 0; row < columns.rows(); ++row) {
    const double x = columns.number(row, "x") - start.x;
    const double y = columns.has("y") ? columns.number(row, "y") - start.y : 0.0;
    SurveyPoint point;
    const std::string name = columns.text(row, "name");
    point.source = columns.place(row);
    point.name = name.empty() ? point.source : name;
    point.run = columns.has("y") ? x * math::cos(azimuth) + y * math::sin(azimuth) : x / math::cos(azimuth);
    point.aside = columns.has("y") ? y * math::cos(azimuth) - x * math::sin(azimuth) : 0.0;
    point.drop = start.z - columns.number(row, "z");
    points.push_back(std::move(point));
  }
  if (points.empty()) {
    throw FileError({file.string(), "there are no points in the file",
                     "The first line names the columns, each other one is a point.",
                     "a line a point, every 2 m along the track"});
  }
  return points;
}

void write_survey_csv(const std::filesystem::path& file, const Survey& survey) {
  std::string text =
      "name,arc_length_m,deviation_m,aside_m,slope_angle_deg,slope_deviation_deg,curvature_per_m,"
      "designed_curvature_per_m\n";
  for (const SurveyedPlace& place : survey.places) {
    text += place.name;
    for (const double value : {place.arc_length, place.deviation, place.aside, degrees(place.slope_angle),
                               degrees(place.slope_deviation), place.curvature, place.designed_curvature}) {
      text += "," + exact_text(value);
    }
    text += "\n";
  }
  write_atomically(file, text);
}

namespace {

/// A bound on both sides, dashed from end to end: one line that is interrupted, with one name.
void add_bound(Figure& figure, double length, double bound, const std::string& name) {
  constexpr double kBreak = std::numeric_limits<double>::quiet_NaN();
  figure.lines.push_back(
      {name, {0.0, length, kBreak, 0.0, length}, {bound, bound, kBreak, -bound, -bound}, true});
}

FigureLine speed_line(const std::string& name, const Motion& motion, double from, double to, bool dashed) {
  constexpr int kSamples = 300;
  FigureLine line{name, {}, {}, dashed};
  const double way = std::min(to - from, motion.distance());
  for (int i = 0; i <= kSamples; ++i) {
    const double at = i == kSamples ? way : way * i / kSamples;
    line.xs.push_back(from + at);
    line.ys.push_back(motion.at(at).speed);
  }
  return line;
}

}  // namespace

std::vector<Figure> survey_figures(const Track& track, const Survey& survey, const SurveyRides& rides,
                                   const SurveyOptions& options) {
  const double length = track.centerline->length();
  Figure deviation{"Deviation square to the profile", "arc length [m]", "deviation [mm]", {}, {}, false};
  Figure slope{"Slope angle as built less designed", "arc length [m]", "deviation [deg]", {}, {}, false};
  FigureLine points{"points", {}, {}, false};
  FigureLine slopes{"as built", {}, {}, false};
  for (const SurveyedPlace& place : survey.places) {
    points.xs.push_back(place.arc_length);
    points.ys.push_back(core::kMillimetres * place.deviation);
    slopes.xs.push_back(place.arc_length);
    slopes.ys.push_back(degrees(place.slope_deviation));
  }
  deviation.lines.push_back(std::move(points));
  slope.lines.push_back(std::move(slopes));
  add_bound(deviation, length, core::kMillimetres * options.tolerance, "tolerance");
  add_bound(slope, length, degrees(options.slope_tolerance), "tolerance");
  Figure speed{"Speed", "arc length [m]", "speed [m/s]", {}, {}, false};
  speed.lines.push_back(speed_line("as built", rides.as_built, rides.from, rides.to, false));
  speed.lines.push_back(speed_line("designed", rides.designed, 0.0, length, true));
  return {std::move(deviation), std::move(slope), std::move(speed)};
}

std::string survey_json(const Design& design, const Survey& survey, const SurveyRides& rides,
                        const SurveyOptions& options) {
  Json json{{"glissade", version()}};
  if (!design.name.empty()) json["name"] = design.name;
  json["sound"] = survey.sound();
  json["tolerance_m"] = options.tolerance;
  json["within_tolerance"] = survey.within_tolerance;
  json["slope_tolerance_deg"] = degrees(options.slope_tolerance);
  json["slope_within_tolerance"] = survey.slope_within_tolerance;
  json["mean_deviation_m"] = survey.mean_deviation;
  json["rms_deviation_m"] = survey.rms_deviation;
  json["max_deviation_m"] = survey.places[survey.worst].deviation;
  json["max_deviation_at_m"] = survey.places[survey.worst].arc_length;
  json["max_slope_deviation_deg"] = degrees(survey.places[survey.worst_slope].slope_deviation);
  json["max_slope_deviation_at_m"] = survey.places[survey.worst_slope].arc_length;
  json["gaps"] = Json::array();
  for (const SurveyGap& gap : survey.gaps) json["gaps"].push_back({{"from_m", gap.from}, {"to_m", gap.to}});
  json["from_m"] = rides.from;
  json["to_m"] = rides.to;
  json["before_start_m"] = survey.before_start;
  json["beyond_end_m"] = survey.beyond_end;
  json["as_built"] = Json::object();
  add_ride(json["as_built"], rides.as_built);
  const bool comes = rides.designed.distance() >= rides.to;
  json["designed_speed_at_end_m_per_s"] = comes ? number(rides.designed.at(rides.to).speed) : Json(nullptr);
  json["designed_max_normal_load_m_per_s2"] = number(rides.designed_there.highest_load().normal_load);
  json["points"] = Json::array();
  for (const SurveyedPlace& place : survey.places) {
    json["points"].push_back({{"name", place.name},
                              {"arc_length_m", place.arc_length},
                              {"deviation_m", place.deviation},
                              {"aside_m", place.aside},
                              {"beyond_m", place.beyond},
                              {"slope_angle_deg", degrees(place.slope_angle)},
                              {"slope_deviation_deg", degrees(place.slope_deviation)},
                              {"curvature_per_m", number(place.curvature)},
                              {"designed_curvature_per_m", number(place.designed_curvature)}});
  }
  return document_text(json);
}

}  // namespace glissade
