#include "glissade/trades/survey.hpp"

#include "glissade/centerline/in_run.hpp"
#include "glissade/core/error.hpp"
#include "glissade/pipeline.hpp"
#include "glissade/pipeline/surveys.hpp"
#include "glissade/report/figure.hpp"

#include "support/catch.hpp"
#include "support/paths.hpp"
#include "support/random.hpp"
#include "support/temp_dir.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

namespace survey_test {

using namespace glissade;
using Catch::Matchers::Contains;

namespace {

CenterlinePtr in_run() {
  return std::make_shared<const InRun>(InRunShape{Angle::from_degrees(35.0), Angle::from_degrees(11.0), 103.0,
                                                  6.9, 102.9, InRunTransition::cubic, 0.0});
}

/// Points square above the track, with a deviation of their own.
std::vector<SurveyPoint> points_on(const Centerline& track, double from, double to, int count, double height,
                                   const std::function<double(double s)>& deviation) {
  std::vector<SurveyPoint> points;
  for (int i = 0; i < count; ++i) {
    const double s = from + (to - from) * i / (count - 1);
    const CenterlinePoint at = track.at(s);
    const double up = height + deviation(s);
    points.push_back({"p" + std::to_string(i + 1), at.x + up * std::sin(at.slope_angle),
                      at.drop - up * std::cos(at.slope_angle), 0.002});
  }
  return points;
}

std::size_t count_of(const std::string& text, const std::string& what) {
  std::size_t count = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++count;
  return count;
}

std::string problem_of(const std::vector<SurveyPoint>& points, const SurveyOptions& options = {}) {
  try {
    static_cast<void>(survey_of(*in_run(), points, options));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

Body skier() {
  Body body;
  body.friction = Friction::from_coefficient(0.03);
  body.drag_per_metre = 0.0013;
  return body;
}

}  // namespace

TEST_CASE("points of the design itself deviate by nothing, in any order, whatever they are mounted on") {
  const CenterlinePtr track = in_run();
  for (const double height : {0.0, 0.12, -0.4}) {
    CAPTURE(height);
    std::vector<SurveyPoint> points =
        points_on(*track, 0.0, track->length(), 60, height, [](double) { return 0.0; });
    std::swap(points[3], points[40]);
    SurveyOptions options;
    options.height = height;
    const Survey survey = survey_of(*track, points, options);
    REQUIRE(survey.places.size() == 60);
    for (const SurveyedPlace& place : survey.places) {
      CHECK(std::fabs(place.deviation) < 1e-9);
      CHECK(abs(place.slope_deviation).radians() < 1e-4);
      CHECK(place.aside == 0.002);
    }
    CHECK(survey.sound());
    const SurveyRides rides = ride_survey(track, survey, skier(), 9.81);
    CHECK(rides.from == 0.0);
    CHECK(rides.as_built.arrived());
    CHECK(std::fabs(rides.as_built.exit_speed() - rides.designed.exit_speed()) < 1e-3);
  }
}

TEST_CASE("a deviation that was built is found again, square to the profile, and its slope with it") {
  const CenterlinePtr track = in_run();
  testing::Random random = testing::seeded_random();
  const double place = random.between(30.0, 70.0);
  CAPTURE(place);
  const auto bump = [&](double s) { return 0.03 * std::exp(-std::pow((s - place) / 8.0, 2.0)); };
  const Survey survey = survey_of(*track, points_on(*track, 0.0, track->length(), 200, 0.0, bump));
  for (const SurveyedPlace& one : survey.places)
    CHECK(std::fabs(one.deviation - bump(one.arc_length)) < 1e-6);
  CHECK_FALSE(survey.within_tolerance);
  CHECK(std::fabs(survey.places[survey.worst].arc_length - place) < 0.6);
  // uphill of the bump the track is flatter than designed, by the bump's own slope
  const double steepest = 0.03 * std::sqrt(2.0) / 8.0 * std::exp(-0.5);
  CHECK(abs(survey.places[survey.worst_slope].slope_deviation).radians() == Approx(steepest).epsilon(0.15));
  SurveyOptions wide;
  wide.tolerance = 0.031;
  wide.slope_tolerance = Angle::from_radians(0.01);
  CHECK(survey_of(*track, points_on(*track, 0.0, track->length(), 200, 0.0, bump), wide).sound());
}

TEST_CASE("a point beyond an end of the track is held against that end, and told") {
  const CenterlinePtr track = in_run();
  std::vector<SurveyPoint> points = points_on(*track, 0.0, 102.9, 40, 0.0, [](double) { return 0.0; });
  const double alpha = track->slope_angle(track->length());
  points.back().run += 0.5 * std::cos(alpha);
  points.back().drop += 0.5 * std::sin(alpha);
  const Survey survey = survey_of(*track, points, {});
  CHECK(survey.places.back().beyond == Approx(0.5).epsilon(1e-9));
  CHECK(survey.places.back().arc_length == track->length());
  CHECK(survey.places[20].beyond == 0.0);
}

TEST_CASE("stretches without points are told, those at the ends too") {
  const CenterlinePtr track = in_run();
  std::vector<SurveyPoint> points = points_on(*track, 8.0, 40.0, 33, 0.0, [](double) { return 0.0; });
  for (const SurveyPoint& point : points_on(*track, 52.0, 102.9, 52, 0.0, [](double) { return 0.0; })) {
    points.push_back(point);
  }
  const Survey survey = survey_of(*track, points);
  REQUIRE(survey.gaps.size() == 2);
  CHECK(survey.gaps[0].from == 0.0);
  CHECK(survey.gaps[0].to == Approx(8.0).epsilon(1e-9));
  CHECK(survey.gaps[1].from == Approx(40.0).epsilon(1e-9));
  CHECK(survey.gaps[1].to == Approx(52.0).epsilon(1e-9));
  CHECK_FALSE(survey.sound());
  const SurveyRides rides = ride_survey(track, survey, skier(), 9.81);
  CHECK(rides.from == Approx(8.0).epsilon(1e-9));
  CHECK(std::fabs(rides.as_built.exit_speed() - rides.designed.at(rides.to).speed) < 5e-3);
}

TEST_CASE("of a part that was surveyed both loads are of that part") {
  const CenterlinePtr track = in_run();
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (int i = 0; i < 6; ++i) {
    const double from = i == 0 ? 0.0 : random.between(0.0, 60.0);
    const double to = from + random.between(15.0, 40.0);
    CAPTURE(from, to);
    const Survey survey = survey_of(*track, points_on(*track, from, to, 40, 0.0, [](double) { return 0.0; }));
    const SurveyRides rides = ride_survey(track, survey, skier(), 9.81);
    double most = 0.0;
    constexpr int kLooks = 4000;
    for (int k = 0; k <= kLooks; ++k)
      most = std::max(most, rides.designed.at(std::min(from + (to - from) * k / kLooks, to)).normal_load);
    CHECK(rides.designed_there.highest_load().normal_load == Approx(most).epsilon(1e-5));
    CHECK(rides.as_built.highest_load().normal_load == Approx(most).epsilon(5e-3));
    CHECK(rides.designed_there.exit_speed() == Approx(rides.designed.at(rides.to).speed).epsilon(1e-9));
    const auto told = nlohmann::json::parse(survey_json({}, survey, rides, {}));
    CHECK(told["designed_max_normal_load_m_per_s2"].get<double>() == Approx(most).epsilon(1e-5));
  }
}

TEST_CASE(
    "points off the ends of the track, in any order, change nothing of the ride on what was built of it") {
  const CenterlinePtr track = in_run();
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  const std::vector<SurveyPoint> points =
      points_on(*track, 0.0, track->length(), 60, 0.0, [](double) { return 0.0; });
  const SurveyRides within = ride_survey(track, survey_of(*track, points), skier(), 9.81);
  const auto off = [&](const CenterlinePoint& end, double by) {
    return SurveyPoint{"off " + std::to_string(by), end.x + by * std::cos(end.slope_angle),
                       end.drop + by * std::sin(end.slope_angle), 0.0};
  };
  for (int i = 0; i < 8; ++i) {
    std::vector<SurveyPoint> more = points;
    const double before = random.between(0.5, 1.0);
    const double beyond = random.between(0.5, 1.0);
    CAPTURE(before, beyond);
    for (const double by : {0.4 * before, before}) more.push_back(off(track->at(0.0), -by));
    for (const double by : {beyond, 0.4 * beyond}) more.push_back(off(track->at(track->length()), by));
    for (std::size_t k = more.size(); k > 1; --k)
      std::swap(more[k - 1],
                more[static_cast<std::size_t>(random.between(0.0, 1.0) * static_cast<double>(k - 1))]);
    const Survey survey = survey_of(*track, more);
    CHECK(survey.places.front().beyond == Approx(-before).epsilon(1e-6));
    CHECK(survey.places.back().beyond == Approx(beyond).epsilon(1e-6));
    CHECK(survey.before_start == Approx(before).epsilon(1e-3));
    CHECK(survey.beyond_end == Approx(beyond).epsilon(1e-3));
    const SurveyRides rides = ride_survey(track, survey, skier(), 9.81);
    CHECK(rides.from == 0.0);
    CHECK(rides.to == track->length());
    CHECK(rides.as_built.exit_speed() == Approx(within.as_built.exit_speed()).epsilon(1e-4));
    CHECK(rides.as_built.travel_time() == Approx(within.as_built.travel_time()).epsilon(1e-3));
    const auto told = nlohmann::json::parse(survey_json({}, survey, rides, {}));
    CHECK(told["before_start_m"].get<double>() == survey.before_start);
    CHECK(told["beyond_end_m"].get<double>() == survey.beyond_end);
  }
  std::vector<SurveyPoint> none;
  for (int i = 0; i < 6; ++i) none.push_back(off(track->at(track->length()), 0.1 + 0.1 * i));
  CHECK_THROWS_WITH(ride_survey(track, survey_of(*track, none), skier(), 9.81),
                    Contains("the points lie before the start of the track or beyond its end"));
}

TEST_CASE("below the first point of a survey friction is that of the place, and no impact is met again") {
  const CenterlinePtr track = in_run();
  Body body = skier();
  body.friction_changes = {{20.0, Friction::from_coefficient(0.1)}, {60.0, Friction::from_coefficient(0.02)}};
  body.landing = Landing{9.0, Angle::from_degrees(60.0)};
  for (const double from : {0.0, 10.0, 40.0, 70.0}) {
    CAPTURE(from);
    const Survey survey =
        survey_of(*track, points_on(*track, from, track->length(), 120, 0.0, [](double) { return 0.0; }));
    const SurveyRides rides = ride_survey(track, survey, body, 9.81);
    CHECK(rides.as_built.exit_speed() == Approx(rides.designed.exit_speed()).epsilon(1e-4));
    CHECK(rides.designed_there.exit_speed() == Approx(rides.designed.exit_speed()).epsilon(1e-9));
  }
}

TEST_CASE(
    "points that do not belong to the profile are all told, each with its distance, the bound and a way "
    "out") {
  std::vector<SurveyPoint> points = points_on(*in_run(), 0.0, 102.0, 30, 0.0, [](double) { return 0.0; });
  points[4].drop -= 3.0;
  points[9].aside = 2.5;
  points.push_back({"far", -4.0, -3.0, 0.0});
  points.push_back({"beyond", 94.0, 48.0, 0.0});
  const std::string text = problem_of(points);
  CHECK_THAT(text, Contains("p5: the point lies 2.4") && Contains("above the profile"));
  CHECK_THAT(text, Contains("p10: the point lies 2.5 m beside the profile"));
  CHECK_THAT(text, Contains("far: the point lies") && Contains("before the start of the track"));
  CHECK_THAT(text, Contains("beyond: the point lies") && Contains("beyond the end of the track"));
  CHECK_THAT(text, Contains("Points within 1 m of the profile belong to it.") &&
                       Contains("Try: points of this track"));
  points[4].source = "s.csv:6";
  points[9].name = points[9].source = "s.csv:11";
  CHECK_THAT(problem_of(points),
             Contains("s.csv:6: the point p5 lies 2.4") && Contains("s.csv:11: the point lies 2.5 m beside"));
  CHECK_THAT(problem_of({points[0], points[1]}), Contains("2 points make no survey"));
  SurveyOptions none;
  none.tolerance = 0.0;
  CHECK_THAT(problem_of(points, none), Contains("--tolerance: 0 mm is not positive"));
}

TEST_CASE("a survey in site coordinates is turned into the plane of a track that leads anywhere") {
  const std::string text =
      "glissade: 1\ntrack: {edge: {x: 400 m, y: -30 m, z: 900 m}, azimuth: 130 deg}\n"
      "body: {friction_coefficient: 0.03}\n"
      "centerline: {kind: in-run, gamma: 35 deg, alpha: 11 deg, r1: 103 m, t: 6.9 m, e1: 96 m}\n";
  const Design design = parse_design(text, "d.yaml");
  CHECK(design.track.finish.x == 400.0);
  const Track track = solve(design);
  const TempDir folder;
  std::string csv = "name,x,y,z\n";
  for (int i = 0; i <= 40; ++i) {
    const CenterlinePoint point = track.centerline->at(track.centerline->length() * i / 40);
    const Vec3 at = track.placement.to_space(point.x, point.drop, 0.05);
    csv += "q" + std::to_string(i) + "," + std::to_string(at.x) + "," + std::to_string(at.y) + "," +
           std::to_string(at.z) + "\n";
  }
  put_bytes(folder / "s.csv", csv);
  const Survey survey = survey_of(*track.centerline, read_survey(folder / "s.csv", track.placement));
  CHECK(survey.sound());
  for (const SurveyedPlace& place : survey.places) {
    CHECK(std::fabs(place.deviation) < 2e-6);
    CHECK(std::fabs(place.aside - 0.05) < 2e-6);
  }
  const SurveyRides rides = ride_survey(track.centerline, survey, track.motion.body(), design.gravity);
  for (const Figure& figure : survey_figures(track, survey, rides, {})) {
    CAPTURE(figure.title);
    // Tolerances above and below are of one look and name.
    CHECK(figure.lines.size() == 2);
    const std::string svg = figures_svg({figure});
    CHECK(svg.find("<title></title>") == std::string::npos);
    const std::size_t title = svg.find("<title>tolerance</title>");
    CHECK((title != std::string::npos) == (figure.title != "Speed"));
    if (title == std::string::npos) continue;
    const std::size_t path = svg.rfind(" d=\"", title);
    CHECK(count_of(svg.substr(path, title - path), "M") == 2);
    CHECK(count_of(svg, ">tolerance<") == 2);  // it and its name in the legend
  }
  put_bytes(folder / "bad.csv", "x,y\n1,2\n");
  CHECK_THROWS_WITH(read_survey(folder / "bad.csv", track.placement), Contains("there is no column \"z\""));
  put_bytes(folder / "bad.csv", "x,Y,z\n1,5,2\n");
  CHECK_THROWS_WITH(read_survey(folder / "bad.csv", track.placement),
                    Contains("bad.csv:1: nobody reads a column \"Y\""));
  put_bytes(folder / "own.csv", "x,s,z,n\n1,5,2,3\n");
  CHECK(read_survey(folder / "own.csv", track.placement).front().aside == 0.0);
  put_bytes(folder / "bad.csv", "x,z\n1,5,2,5\n");
  CHECK_THROWS_WITH(
      read_survey(folder / "bad.csv", track.placement),
      Contains("bad.csv:2: the line has 4 cells, more than the 2 names") && Contains("decimal comma"));
  put_bytes(folder / "bad.csv", "x,z,z\n1,5,2\n");
  CHECK_THROWS_WITH(read_survey(folder / "bad.csv", track.placement),
                    Contains("bad.csv:1: two columns are called \"z\""));
  put_bytes(folder / "named.csv", "x,z,name\n1,5,\"A, left\"\n1,5,,\n");
  put_bytes(folder / "bad.csv", "x,z\n");
  CHECK_THROWS_WITH(read_survey(folder / "bad.csv", track.placement),
                    Contains("bad.csv: there are no points in the file") && Contains("a line a point"));
  const std::vector<SurveyPoint> named = read_survey(folder / "named.csv", track.placement);
  CHECK(named[0].name == "A, left");
  CHECK_THAT(named[1].name, Contains("named.csv:3"));
}

TEST_CASE("points without y are refused where the track leads along y, of which x says nothing") {
  const Design design = read_design(designs_path("hills/garmisch_hs142.yaml"));
  const Track track = solve(design);
  const TempDir folder;
  for (const double azimuth : {0.0, 60.0, 84.0, 86.0, 90.0, -90.0, 180.0, 271.0}) {
    CAPTURE(azimuth);
    const Placement placement(track.placement.start(), Angle::from_degrees(azimuth));
    std::string csv = "x,z\n";
    for (int i = 0; i <= 40; ++i) {
      const CenterlinePoint point = track.centerline->at(track.centerline->length() * i / 40);
      const Vec3 at = placement.to_space(point.x, point.drop, 0.0);
      csv += std::to_string(at.x) + "," + std::to_string(at.z) + "\n";
    }
    put_bytes(folder / "s.csv", csv);
    if (std::fabs(std::cos(azimuth * std::numbers::pi / 180.0)) < 0.1) {
      CHECK_THROWS_WITH(read_survey(folder / "s.csv", placement),
                        Contains("s.csv: there is no column y, and the track leads along y") &&
                            Contains("Try: columns x, y and z"));
      continue;
    }
    for (const SurveyedPlace& place :
         survey_of(*track.centerline, read_survey(folder / "s.csv", placement)).places)
      CHECK(std::fabs(place.deviation) < 1e-5);
  }
}

TEST_CASE("the shipped survey belongs to its hill") {
  const Design design = read_design(designs_path("hills/garmisch_hs142.yaml"));
  const Track track = solve(design);
  SurveyOptions options;
  options.height = 0.12;
  const Survey survey = survey_of(
      *track.centerline, read_survey(designs_path("hills/garmisch_survey.csv"), track.placement), options);
  CHECK(survey.places.size() == 52);
  CHECK(survey.within_tolerance);
  CHECK(std::fabs(survey.places[survey.worst].deviation) > 0.003);
  CHECK(survey.gaps.empty());
}

}  // namespace survey_test
