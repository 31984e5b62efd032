#include "glissade/core/error.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/quantity.hpp"
#include "glissade/io/atomic_file.hpp"
#include "glissade/pipeline.hpp"
#include "glissade/pipeline/json.hpp"
#include "glissade/pipeline/surveys.hpp"
#include "glissade/report/figure.hpp"

#include "app/command_line.hpp"
#include "app/console.hpp"
#include "app/option_value.hpp"
#include "app/output_files.hpp"
#include "app/searched_track.hpp"
#include "app/summary.hpp"
#include "app/table.hpp"
#include "app/time_budget.hpp"
#include "app/told_of.hpp"
#include "app/track_input.hpp"

#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace glissade::app {
namespace {

constexpr const char* kSurveyDescription =
    "Hold a track as it was surveyed against its design: deviation, slope angle and radius at every point,\n"
    "gaps, and the ride on the profile as built against the designed one.\n"
    "\n"
    "The CSV file has the columns x, z and, if wanted, y and name: metres in the frame of the design. The "
    "exit\n"
    "code is 1 if a tolerance is broken or points are missing.";

constexpr const char* kSurveyFooter =
    "Examples:\n"
    "  glissade survey designs/hills/garmisch_hs142.yaml designs/hills/garmisch_survey.csv --offset 120mm\n"
    "  glissade survey designs/hills/garmisch_hs142.yaml designs/hills/garmisch_survey.csv \\\n"
    "      --offset 120mm --svg survey.svg --csv deviations.csv";

struct SurveyArguments {
  DesignInput design;
  std::string points;
  std::string offset;
  std::string tolerance;
  std::string slope_tolerance;
  std::string gap;
  std::string reach;
  std::string csv;
  std::string svg;
  bool json = false;
  TimeBudget time_budget;
  Verbosity verbosity;
};

SurveyOptions options_of(const SurveyArguments& options) {
  SurveyOptions survey;
  const auto take = [](const std::string& text, Dimension dimension, const char* name, double& value) {
    if (!text.empty()) value = option_value(text, dimension, name);
  };
  take(options.offset, Dimension::length, "--offset", survey.height);
  take(options.tolerance, Dimension::length, "--tolerance", survey.tolerance);
  double slope_tolerance = survey.slope_tolerance.radians();
  take(options.slope_tolerance, Dimension::angle, "--slope-tolerance", slope_tolerance);
  survey.slope_tolerance = Angle::from_radians(slope_tolerance);
  take(options.gap, Dimension::length, "--largest-gap", survey.largest_gap);
  take(options.reach, Dimension::length, "--reach", survey.reach);
  return survey;
}

std::string verdict(bool sound, const std::string& bound) {
  return sound ? emphasised("within", Emphasis::good) + " " + bound
               : emphasised("beyond", Emphasis::bad) + " " + bound;
}

std::string signed_text(double metres) {
  return (metres > 0.0 ? "+" : "") + length_text(metres, 3);
}

Table places_table(const Survey& survey) {
  Table table({"point", "s [m]", "deviation [mm]", "aside [mm]", "slope [deg]", "off by [deg]", "radius [m]",
               "designed [m]"});
  const auto radius = [](double curvature) {
    constexpr double kStraight = 1e-4;  // [1/m]
    return std::fabs(curvature) < kStraight ? std::string("straight") : fixed_text(1.0 / curvature, 1);
  };
  for (const SurveyedPlace& place : survey.places) {
    table.add({place.name, fixed_text(place.arc_length, 2), fixed_text(1e3 * place.deviation, 1),
               fixed_text(1e3 * place.aside, 1), fixed_text(place.slope_angle.degrees(), 3),
               fixed_text(place.slope_deviation.degrees(), 3), radius(place.curvature),
               radius(place.designed_curvature)});
  }
  return table;
}

/// What of the profile as built lies off the ends of the design, which no ride is on.
std::string left_out_text(const Survey& survey) {
  constexpr double kLeast = 1e-3;  // taste: a reading or two [m]
  std::string text;
  const auto add = [&](double length, const char* where) {
    if (length > kLeast) text += (text.empty() ? "" : " and ") + length_text(length, 3) + where;
  };
  add(survey.before_start, " before the start");
  add(survey.beyond_end, " beyond the end");
  return text.empty() ? "" : "\nwithout what was built " + text + " of the design";
}

std::string rides_text(const Survey& survey, const SurveyRides& rides) {
  const Motion& built = rides.as_built;
  if (!built.arrived()) return emphasised("does not arrive", Emphasis::bad) + " on the profile as built";
  if (rides.designed.distance() < rides.to) return "the designed ride does not come to the last point";
  const double designed = rides.designed.at(rides.to).speed;
  const double load = built.highest_load().normal_load;
  const double designed_load = rides.designed_there.highest_load().normal_load;
  const double change = built.exit_speed() - designed;
  return speed_text(built.exit_speed()) + (survey.beyond_end > 0.0 ? " at the end" : " at the last point") +
         ", designed " + speed_text(designed) + ": " + (change < 0.0 ? "" : "+") + rounded_text(change, 2) +
         " m/s\nload " + load_text(load) + " at most, designed " + load_text(designed_load) +
         (rides.from > 0.0 ? "\nfrom the first point on, " + length_text(rides.from) +
                                 " down the track, at the designed speed"
                           : "") +
         left_out_text(survey);
}

/// Points within reach of the track, but off its ends by more than the tolerance.
std::string beyond_text(const Survey& survey, const SurveyOptions& options) {
  std::string text;
  for (const SurveyedPlace& place : survey.places) {
    if (std::fabs(place.beyond) <= options.tolerance) continue;
    text += (text.empty() ? "" : "\n") + place.name + " lies " + length_text(std::fabs(place.beyond), 3) +
            (place.beyond < 0.0 ? " before the start" : " beyond the end") + ", and is held against it";
  }
  return text.empty() ? "" : labelled("Off the track", text);
}

std::string survey_summary(const Design& design, const Survey& survey, const SurveyRides& rides,
                           const SurveyOptions& options) {
  const SurveyedPlace& worst = survey.places[survey.worst];
  const SurveyedPlace& slope = survey.places[survey.worst_slope];
  std::string text = emphasised(design.name.empty() ? "Survey" : design.name, Emphasis::heading) + "\n\n" +
                     places_table(survey).text() + "\n";
  text += labelled("Deviation", signed_text(worst.deviation) + " at most, at " + worst.name + ", " +
                                    length_text(worst.arc_length) + " down the track: " +
                                    verdict(survey.within_tolerance, length_text(options.tolerance)) + "\n" +
                                    signed_text(survey.mean_deviation) + " on average, " +
                                    length_text(survey.rms_deviation, 3) + " in the root of the mean square");
  text += labelled("Slope angle",
                   "off by " + angle_text(slope.slope_deviation, 3) + " at most, at " + slope.name + ": " +
                       verdict(survey.slope_within_tolerance, angle_text(options.slope_tolerance)));
  std::string gaps = "none longer than " + length_text(options.largest_gap);
  if (!survey.gaps.empty()) gaps = "";
  for (const SurveyGap& gap : survey.gaps) {
    gaps += (gaps.empty() ? "" : "\n") + std::string("no point from ") + length_text(gap.from) + " to " +
            length_text(gap.to);
  }
  return text + beyond_text(survey, options) + labelled("Gaps", gaps) +
         labelled("Ride", rides_text(survey, rides));
}

ExitCode survey(const SurveyArguments& options) {
  const SurveyOptions wanted = options_of(options);
  const Design design = options.design.read();
  const Track track = searched_track(design, options.verbosity, options.time_budget.seconds());
  const std::vector<SurveyPoint> points = read_survey(options.points, track.placement);
  const Survey found = told_of(options.points, [&] { return survey_of(*track.centerline, points, wanted); });
  const SurveyRides rides = told_of(options.points, [&] {
    return ride_survey(track.centerline, found, track.motion.body(), design.gravity);
  });
  const auto write = [&] {
    OutputFiles files;
    files.make(options.csv, [&](const std::filesystem::path& csv) { write_survey_csv(csv, found); });
    files.make(options.svg, [&](const std::filesystem::path& svg) {
      write_atomically(svg, figures_svg(survey_figures(track, found, rides, wanted)));
    });
    files.put_in_place();
  };
  write_and_print(
      write,
      options.json ? survey_json(design, found, rides, wanted) : survey_summary(design, found, rides, wanted),
      options.csv.empty() && options.svg.empty() ? "" : kFilesWritten);
  if (!found.sound()) return ExitCode::faulty;
  require_searched_through(design, track);
  return ExitCode::done;
}

}  // namespace

void add_survey(CLI::App& program, Action& action) {
  CLI::App& command = *program.add_subcommand("survey", kSurveyDescription)->footer(kSurveyFooter);
  const auto options = std::make_shared<SurveyArguments>();
  options->design.add_to(command);
  command.add_option("points", options->points, "CSV file of the measured points")
      ->type_name("POINTS.csv")
      ->required();
  const auto add = [&](const std::string& name, std::string& text, const std::string& unit,
                       const std::string& description) {
    command.add_option(name, text, description)->type_name(unit);
  };
  add("--offset", options->offset, "LENGTH",
      "How far the points lie above the track, square to it: prism, guide tube [default: 0]");
  add("--tolerance", options->tolerance, "LENGTH", "Of the deviation square to the profile [default: 10 mm]");
  add("--slope-tolerance", options->slope_tolerance, "ANGLE", "Of the slope angle [default: 0.1 deg]");
  add("--largest-gap", options->gap, "LENGTH", "Between neighbouring points, along the track [default: 5 m]");
  add("--reach", options->reach, "LENGTH",
      "A point farther from the profile does not belong to it [default: 1 m]");
  add("--csv", options->csv, "FILE", "Write the table");
  add("--svg", options->svg, "FILE", "Draw deviation, slope angle and speed along the track");
  add_json_flag(command, options->json, "the table");
  options->time_budget.add_to(command);
  options->verbosity.add_to(command, "Show no progress");
  command.callback([options, &action] { action = [options] { return survey(*options); }; });
}

}  // namespace glissade::app
