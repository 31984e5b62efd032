// Prints the tables of docs/accuracy.md: the errors actually reached. With --check FILE it fails if one of
// them exceeds its bound, or if the document states other quantities, cases or bounds than are measured here.
#include "glissade/centerline/clothoid_spline.hpp"
#include "glissade/centerline/constant_speed_curve.hpp"
#include "glissade/centerline/coulomb_brachistochrone.hpp"
#include "glissade/centerline/fitted_profile.hpp"
#include "glissade/centerline/flying_start_brachistochrone.hpp"
#include "glissade/centerline/straight_line.hpp"
#include "glissade/motion/motion.hpp"

#include "centerline/coulomb_reference.hpp"
#include "support/cramer_rao.hpp"
#include "support/known_profiles.hpp"
#include "support/paths.hpp"
#include "support/thorough.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace {

using namespace glissade;
using nlohmann::json;

double relative_error(double value, double expected) {
  return std::fabs(value - expected) / std::fabs(expected);
}

/// Worst error of one quantity over all cases.
struct Line {
  std::string quantity;
  double bound = 0.0;
  std::string bound_text;
  int cases = 0;
  double worst = 0.0;
  double worst_ratio = 0.0;  // to the bound of the case

  void add(double error, double bound_of_case) {
    ++cases;
    worst = std::max(worst, error);
    worst_ratio = std::max(worst_ratio, error / bound_of_case);
  }
  void add(double error) { add(error, bound); }
};

/// What the document must state: the line without what was measured.
std::string promise(const Line& line) {
  return fmt::format("{:<58} {:>6}  {:<18}", line.quantity, line.cases, line.bound_text);
}

std::string text(const Line& line) {
  return fmt::format("{} {:>9.1e} {:>8.3f}", promise(line), line.worst, line.worst_ratio);
}

struct Section {
  std::string title;
  std::vector<Line> lines;
};

Line line(std::string quantity, double bound) {
  return {std::move(quantity), bound, fmt::format("{:g}", bound)};
}

Section fastest_track() {
  const auto of = [](std::string quantity) { return Line{std::move(quantity), 0.0, "1e-12 + 1e-15/eps"}; };
  Line time = of("travel time");
  Line speed = of("exit speed");
  Line slope = of("exit slope angle");
  Line straight = of("straight-line time");
  Line x = of("points: run");
  Line drop = of("points: drop");
  Line point_time = of("points: time");
  Line point_speed = of("points: speed");
  for (const reference::CurveCase& curve : reference::curve_cases()) {
    const double bound = coulomb_accuracy(reference::reach_margin(curve.endpoints, curve.friction));
    const CoulombSolution found =
        solve_coulomb_brachistochrone(curve.endpoints, curve.friction, curve.gravity);
    time.add(relative_error(found.travel_time, curve.travel_time), bound);
    speed.add(relative_error(found.exit_speed, curve.exit_speed), bound);
    slope.add(relative_error(found.exit_slope_angle.radians(), curve.exit_slope_angle), bound);
    straight.add(relative_error(found.straight_time, curve.straight_time), bound);
    for (const reference::CurvePoint& point : curve.points) {
      const CoulombState state =
          reference::turned_by(found.at_slope_angle(Angle::from_radians(point.slope_angle)),
                               point.slope_remainder, curve.friction, curve.gravity);
      x.add(relative_error(state.x, point.x), bound);
      drop.add(relative_error(state.drop, point.drop), bound);
      point_time.add(relative_error(state.time, point.time), bound);
      point_speed.add(relative_error(state.speed, point.speed), bound);
    }
  }
  return {"Fastest track, closed form (relative; tests/reference/coulomb_brachistochrone.json)",
          {time, speed, slope, straight, x, drop, point_time, point_speed}};
}

double number(const json& item, const char* key) {
  const json& value = item.at(key);
  return value.is_string() ? std::stod(value.get<std::string>()) : value.get<double>();
}

Section flying_start() {
  const auto of = [](std::string quantity) { return Line{std::move(quantity), 0.0, "1e-12 + 1e-15/margin"}; };
  Line time = of("travel time");
  Line speed = of("exit speed");
  Line entry = of("entry slope angle");
  Line exit = of("exit slope angle");
  Line place = line("finish of the curve, over the length", FlyingStartBrachistochrone::kPositionAccuracy);
  Line ridden_time = line("travel time, by the referee", kMotionAccuracy);
  Line ridden_speed = line("exit speed, by the referee", kMotionAccuracy);
  std::ifstream file(test_data_path("reference/entry_speed.json"));
  for (const json& item : json::parse(file)) {
    const Endpoints ends{number(item, "run"), number(item, "drop")};
    const Friction friction = Friction::from_coefficient(number(item, "friction_coefficient"));
    const double v0 = number(item, "entry_speed");
    const double gravity = number(item, "gravity");
    const auto curve = std::make_shared<const FlyingStartBrachistochrone>(ends, friction, v0, gravity);
    const FlyingStartSolution& found = curve->solution();
    const double size = std::hypot(ends.run, ends.drop) + v0 * v0 / gravity;
    const double bound =
        flying_start_accuracy((ends.drop - least_drop(ends.run, friction, v0, gravity)) / size);
    time.add(relative_error(found.travel_time, number(item, "travel_time")), bound);
    speed.add(relative_error(found.exit_speed, number(item, "exit_speed")), bound);
    entry.add(std::fabs(found.entry_slope_angle.radians() - number(item, "entry_slope_angle")), bound);
    exit.add(std::fabs(found.exit_slope_angle.radians() - number(item, "exit_slope_angle")), bound);
    const Endpoints end = curve->endpoints();
    place.add(std::hypot(end.run - ends.run, end.drop - ends.drop) / curve->length());
    const Motion ride(curve, {friction, v0, 0.0}, gravity);
    ridden_time.add(relative_error(ride.travel_time(), number(item, "travel_time")));
    ridden_speed.add(relative_error(ride.exit_speed(), number(item, "exit_speed")));
  }
  return {"Fastest track with an entry speed (relative, angles in rad; tests/reference/entry_speed.json)",
          {time, speed, entry, exit, place, ridden_time, ridden_speed}};
}

json tracks_file() {
  std::ifstream file(test_data_path("reference/pudasaini_and_tracks.json"));
  return json::parse(file);
}

Section constant_speed_curve() {
  const auto of = [](std::string quantity) { return line(std::move(quantity), kConstantSpeedCurveAccuracy); };
  Line entry = of("entry slope angle");
  Line exit = of("exit slope angle");
  Line length = of("arc length");
  Line time = of("travel time from rest");
  Line speed = of("exit speed from rest");
  Line steady = of("travel time at the constant speed");
  Line ridden_time = line("travel time from rest, by the referee", kMotionAccuracy);
  Line ridden_speed = line("exit speed from rest, by the referee", kMotionAccuracy);
  const json file = tracks_file();
  for (const json& item : file.at("pudasaini")) {
    const Friction friction = Friction::from_coefficient(number(item, "friction_coefficient"));
    const double gravity = number(item, "gravity");
    const auto curve = std::make_shared<const ConstantSpeedCurve>(
        Endpoints{number(item, "run"), number(item, "drop")}, friction, gravity, number(item, "P"));
    entry.add(relative_error(curve->entry_slope_angle().radians(), number(item, "entry_slope_angle")));
    exit.add(relative_error(curve->exit_slope_angle().radians(), number(item, "exit_slope_angle")));
    length.add(relative_error(curve->length(), number(item, "arc_length")));
    time.add(relative_error(curve->travel_time(), number(item, "travel_time_from_rest")));
    speed.add(relative_error(curve->speed(curve->length()), number(item, "exit_speed_from_rest")));
    steady.add(relative_error(curve->travel_time_at_constant_speed(),
                              number(item, "travel_time_at_constant_speed")));
    const Motion ride(curve, {friction, 0.0, 0.0}, gravity);
    ridden_time.add(relative_error(ride.travel_time(), number(item, "travel_time_from_rest")));
    ridden_speed.add(relative_error(ride.exit_speed(), number(item, "exit_speed_from_rest")));
  }
  return {"Constant-speed curve (relative; tests/reference/pudasaini_and_tracks.json, pudasaini)",
          {entry, exit, length, time, speed, steady, ridden_time, ridden_speed}};
}

Section given_tracks() {
  Line x = line("run of the finish, over the length", kClothoidAccuracy);
  Line drop = line("drop of the finish, over the length", kClothoidAccuracy);
  Line time = line("travel time", kMotionAccuracy);
  Line speed = line("exit speed", kMotionAccuracy);
  const json file = tracks_file();
  for (const json& item : file.at("tracks")) {
    std::vector<ClothoidSegment> segments;
    for (const json& segment : item.at("segments")) {
      segments.push_back({segment.at(0), segment.at(1), segment.at(2)});
    }
    const auto track = std::make_shared<const ClothoidSpline>(
        Angle::from_radians(number(item, "entry_slope_angle")), std::move(segments));
    const CenterlinePoint finish = track->at(track->length());
    x.add(std::fabs(finish.x - number(item, "x")) / track->length());
    drop.add(std::fabs(finish.drop - number(item, "drop")) / track->length());
    const Motion ride(track,
                      {Friction::from_coefficient(number(item, "friction_coefficient")),
                       number(item, "entry_speed"), number(item, "drag_per_metre")},
                      number(item, "gravity"));
    time.add(relative_error(ride.travel_time(), number(item, "travel_time")));
    speed.add(relative_error(ride.exit_speed(), number(item, "exit_speed")));
  }
  return {"Given tracks, ridden by the referee (relative; tests/reference/pudasaini_and_tracks.json, tracks)",
          {x, drop, time, speed}};
}

/// What theory.md's closed forms are met to.
constexpr double kClosedFormAccuracy = 1e-12;

Line straight_ramps() {
  Line ramps = line("straight ramp from rest: travel time", kClosedFormAccuracy);
  for (const double length : {1e-3, 1.0, 1e5}) {
    for (const double slope : {0.25, 0.7, 1.2, 1.5}) {
      for (const double mu : {0.0, 0.1, 0.25}) {
        const auto ramp = std::make_shared<const StraightLine>(
            Endpoints{length * std::cos(slope), length * std::sin(slope)});
        const double zeta = ramp->slope_angle(0.0);
        const double acceleration = kDefaultGravity * (std::sin(zeta) - mu * std::cos(zeta));
        const Motion ride(ramp, {Friction::from_coefficient(mu), 0.0, 0.0});
        ramps.add(relative_error(ride.travel_time(), std::sqrt(2.0 * ramp->length() / acceleration)));
      }
    }
  }
  return ramps;
}

Line chute_arcs() {
  Line arcs = line("circular arc, Roberts' formula: speed", kClosedFormAccuracy);
  constexpr double kRadius = 7.0;
  constexpr double kEntry = 1.3;
  constexpr double kEntrySpeed = 4.0;
  const auto arc = std::make_shared<const ClothoidSpline>(
      Angle::from_radians(kEntry),
      std::vector<ClothoidSegment>{{1.1 * kRadius, 1.0 / kRadius, 1.0 / kRadius}});
  for (const double mu : {0.0, 0.1, 0.35}) {
    const auto particular = [&](double zeta) {
      return 2.0 * kDefaultGravity * kRadius *
             (3.0 * mu * std::sin(zeta) + (1.0 - 2.0 * mu * mu) * std::cos(zeta)) / (1.0 + 4.0 * mu * mu);
    };
    const double constant = (kEntrySpeed * kEntrySpeed - particular(kEntry)) * std::exp(-2.0 * mu * kEntry);
    const Motion ride(arc, {Friction::from_coefficient(mu), kEntrySpeed, 0.0});
    for (int i = 0; i <= 50; ++i) {
      const double s = arc->length() * (i / 50.0);
      const double zeta = arc->slope_angle(s);
      const double expected = std::sqrt(constant * std::exp(2.0 * mu * zeta) + particular(zeta));
      arcs.add(relative_error(ride.at(s).speed, expected));
    }
  }
  return arcs;
}

Line draggy_slopes() {
  Line slopes = line("straight with drag: exit speed", kClosedFormAccuracy);
  constexpr double kSlope = 0.8;
  constexpr double kLength = 50.0;
  const auto ramp =
      std::make_shared<const StraightLine>(Endpoints{kLength * std::cos(kSlope), kLength * std::sin(kSlope)});
  for (const double mu : {0.0, 0.3}) {
    for (const double drag : {1e-3, 1e-2, 0.2}) {
      for (const double entry_speed : {0.0, 3.0, 60.0}) {
        const double zeta = ramp->slope_angle(0.0);
        const double limit = kDefaultGravity * (std::sin(zeta) - mu * std::cos(zeta)) / drag;
        // v = limit + (v0 - limit) e^(-2 k s), without its cancellation from rest.
        const double fade = std::expm1(-2.0 * drag * ramp->length());
        const double v = entry_speed * entry_speed * (1.0 + fade) - limit * fade;
        const Motion ride(ramp, {Friction::from_coefficient(mu), entry_speed, drag});
        slopes.add(relative_error(ride.exit_speed(), std::sqrt(v)));
      }
    }
  }
  return slopes;
}

Section referee() {
  return {"Referee, closed forms of docs/theory.md (relative)",
          {straight_ramps(), chute_arcs(), draggy_slopes()}};
}

std::vector<Vec2> sampled(const Centerline& curve, int count) {
  std::vector<Vec2> points;
  for (int i = 0; i < count; ++i) {
    const CenterlinePoint place = curve.at(curve.length() * (static_cast<double>(i) / (count - 1)));
    points.push_back({place.x, place.drop});
  }
  return points;
}

Section fitted_profiles() {
  const CoulombBrachistochrone fastest({10.0, 5.0}, Friction::from_coefficient(0.2));
  const ClothoidSpline eased(
      Angle::from_degrees(60.0),
      {{2.0, 0.0, 0.0}, {1.0, 0.0, 0.4}, {2.0, 0.4, 0.4}, {1.0, 0.4, -0.1}, {2.0, -0.1, -0.1}});
  const ClothoidSpline arc(Angle::from_degrees(80.0), {{3.0, 0.3, 0.3}});
  Section section{"Profiles fitted to exact points (over the length)", {}};
  const auto add = [&](const std::string& name, const Centerline& truth, int count, double bound) {
    const FittedProfile profile(sampled(truth, count));
    Line deviation = line(fmt::format("{}, {} points: largest deviation", name, count), bound);
    deviation.add(profile.max_deviation() / truth.length());
    Line length = line(fmt::format("{}, {} points: length", name, count), bound);
    length.add(relative_error(profile.length(), truth.length()));
    section.lines.push_back(deviation);
    section.lines.push_back(length);
  };
  add("arc", arc, 20, 1e-12);
  add("arc", arc, 200, 1e-12);
  add("straights and arcs, eased", eased, 50, 1e-6);
  add("straights and arcs, eased", eased, 200, 1e-6);
  add("straights and arcs, eased", eased, 3000, 1e-6);
  add("fastest track", fastest, 50, 1e-4);
  add("fastest track", fastest, 200, 1e-6);
  return section;
}

double highest_load(const Centerline& curve) {
  const CenterlinePtr shared(&curve, [](const Centerline*) {});
  return Motion(shared, {Friction::from_coefficient(0.03), 0.0, 0.0}).highest_load().normal_load;
}

using Family = std::vector<testing::ProfileMake>;

/// One line of radius and one of load for profiles of one family.
void add_broken(Section& section, const Family& family, int count, double noise, int draws,
                double radius_bound, double load_bound) {
  const std::string name = fmt::format("{}, {} points", family.front().known().name, count);
  Line radius = line(name + ": radius", radius_bound);
  Line load = line(name + ": load", load_bound);
  testing::Random random(20250217);
  for (const testing::ProfileMake& make : family) {
    const testing::KnownProfile known = make.known();
    const double known_load = highest_load(*known.truth);
    for (int draw = 0; draw < draws; ++draw) {
      const FittedProfile profile(testing::points_of(known, count, noise, random));
      radius.add(relative_error(testing::smallest_valley_radius(profile.curve()), known.smallest_radius));
      load.add(relative_error(highest_load(profile), known_load));
    }
  }
  section.lines.push_back(radius);
  section.lines.push_back(load);
}

/// What the noise allows at all, beside it.
void add_allowed(Section& section, const Family& family, int count, double noise, double radius_bound,
                 double load_bound) {
  const std::string name =
      fmt::format("{}, {} points: the noise allows of", family.front().known().name, count);
  Line radius = line(name + " radius", radius_bound);
  Line load = line(name + " load", load_bound);
  for (const testing::ProfileMake& make : family) {
    radius.add(testing::least_deviation(
        make, count, noise, [](const testing::KnownProfile& known) { return known.smallest_radius; }));
    load.add(testing::least_deviation(
        make, count, noise, [](const testing::KnownProfile& known) { return highest_load(*known.truth); }));
  }
  section.lines.push_back(radius);
  section.lines.push_back(load);
}

/// gamma, alpha, r1, straight; the table is as long as it takes.
testing::ProfileMake in_run(double gamma, double alpha, double r1, double table, double straight) {
  return {
      [table](const std::vector<double>& n) { return testing::known_in_run(n[0], n[1], n[2], table, n[3]); },
      {gamma, alpha, r1, straight}};
}

std::vector<Family> broken_families() {
  using testing::known_profile;
  using Numbers = std::vector<double>;
  const auto arc = [](const Numbers& n) {
    return known_profile("straight and arc", n[0], {{n[1], 0.0, 0.0}, {100.0 - n[1], n[2], n[2]}});
  };
  const auto arc_between = [](const Numbers& n) {
    return known_profile("", n[0], {{n[1], 0.0, 0.0}, {n[2], n[3], n[3]}, {98.0 - n[1] - n[2], 0.0, 0.0}});
  };
  const auto clothoid = [](const Numbers& n) {
    return known_profile("clothoids", n[0],
                         {{n[1], 0.0, 0.0}, {n[2], 0.0, n[3]}, {108.0 - n[1] - n[2], 0.0, 0.0}});
  };
  const auto eased = [](const Numbers& n) {
    const double end = 75.0 - n[1] - n[2] - n[4] - n[5];
    return known_profile(
        "", n[0],
        {{n[1], 0.0, 0.0}, {n[2], 0.0, n[3]}, {n[4], n[3], n[3]}, {n[5], n[3], 0.0}, {end, 0.0, 0.0}});
  };
  return {{in_run(33.0, 9.5, 70.0, 5.6, 60.0), in_run(35.0, 11.0, 103.0, 6.9, 70.0),
           in_run(35.0, 11.0, 60.0, 5.0, 40.0)},
          {{arc, {35.0, 60.0, 0.01}}, {arc_between, {35.0, 60.0, 30.0, 1.0 / 70.0}}},
          {{clothoid, {35.0, 60.0, 40.0, 1.0 / 60.0}}, {eased, {40.0, 30.0, 10.0, 0.025, 15.0, 10.0}}}};
}

/// The farthest that the curve through exact points of a wave lies from it, over its height.
double wave_missed(int each, int periods, double phase) {
  constexpr double kRun = 100.0;
  constexpr double kHeight = 2.0;
  const auto wave = [&](double x) {
    return 0.3 * x + kHeight * std::sin(2.0 * std::numbers::pi * periods * x / kRun + phase);
  };
  std::vector<Vec2> points;
  const int count = each * periods;
  for (int i = 0; i < count; ++i) points.push_back({kRun * i / (count - 1), wave(kRun * i / (count - 1))});
  const FittedProfile profile(points);
  const Vec2 start = points.front() - profile.points().front();
  double most = 0.0;
  for (int i = 0; i <= 1000; ++i) {
    const CenterlinePoint place = profile.at(profile.length() * (i / 1000.0));
    const double away = place.drop + start.y - wave(place.x + start.x);
    most = std::max(most, std::fabs(away) * std::cos(place.slope_angle));
  }
  return most / kHeight;
}

Section waves() {
  Section section{"Waves from exact points, 1 to 10 periods (off the wave, over its height)", {}};
  const std::vector<std::pair<int, double>> bounds = {{5, 0.2},    {6, 0.1},    {8, 0.01},
                                                      {12, 0.002}, {20, 0.004}, {40, 0.001}};
  for (const auto& [each, bound] : bounds) {
    Line entry = line(fmt::format("{} points a period", each), bound);
    for (const int periods : {1, 2, 5, 10}) {
      if (each * periods > 200) continue;
      for (const double phase : {0.0, 0.4}) entry.add(wave_missed(each, periods, phase));
    }
    section.lines.push_back(entry);
  }
  return section;
}

Section rounded_waves() {
  Section section{
      "Waves from points rounded to 1 mm, 4 phases (smallest radius, and what of it the range leaves out; "
      "relative)",
      {}};
  struct Kind {
    int periods;
    int count;
    double bound;
  };
  const std::vector<Kind> kinds = {{1, 60, 0.02},  {1, 400, 0.02}, {3, 60, 0.2},   {3, 120, 0.05},
                                   {3, 400, 0.05}, {5, 60, 0.1},   {5, 120, 0.05}, {5, 400, 0.05},
                                   {8, 120, 0.1},  {8, 200, 0.1},  {8, 300, 0.05}, {8, 400, 0.05},
                                   {9, 400, 0.05}, {12, 120, 0.1}, {12, 200, 0.1}, {12, 400, 0.05}};
  constexpr double kLeftOut = 0.01;
  for (const Kind& kind : kinds) {
    const std::string name = fmt::format("{} periods, {} points", kind.periods, kind.count);
    Line radius = line(name + ": radius", kind.bound);
    Line outside = line(name + ": beyond the range", kLeftOut);
    for (const double phase : {0.0, 0.7, 1.9, 3.4}) {
      const testing::RoundedWave wave{kind.periods, kind.count, phase};
      const FittedProfile profile(wave.points());
      const double truth = 1.0 / wave.smallest_radius();
      const double own = testing::largest_curvature(profile.curve());
      const CurvatureRange range = profile.largest_curvature().value_or(CurvatureRange{own, own});
      radius.add(relative_error(1.0 / own, 1.0 / truth));
      outside.add(std::max({0.0, range.least / truth - 1.0, 1.0 - range.greatest / truth}));
    }
    section.lines.push_back(radius);
    section.lines.push_back(outside);
  }
  return section;
}

Section broken_profiles() {
  Section section{"Profiles whose curvature jumps, fitted to exact points (relative)", {}};
  for (const Family& family : broken_families()) {
    for (const int count : {50, 103, 263, 2000}) add_broken(section, family, count, 0.0, 1, 0.02, 0.01);
  }
  return section;
}

Section noisy_profiles() {
  constexpr double kNoise = 1e-3;
  Section section{
      "The same with 1 mm of noise in both coordinates: worst of 10 draws, and the standard deviation that "
      "the noise allows (relative)",
      {}};
  for (const Family& family : broken_families()) {
    add_broken(section, family, 100, kNoise, 10, 0.02, 0.01);
    add_allowed(section, family, 100, kNoise, 0.03, 0.015);
    add_broken(section, family, 1000, kNoise, 3, 0.005, 0.003);
    add_allowed(section, family, 1000, kNoise, 0.005, 0.003);
  }
  return section;
}

/// @param all  with those that fit hundreds of profiles, which take most of a minute
std::vector<Section> sections(bool all) {
  std::vector<Section> result{fastest_track(), flying_start(), constant_speed_curve(),
                              given_tracks(),  referee(),      fitted_profiles()};
  if (!all) return result;
  for (Section (*const section)() : {waves, rounded_waves, broken_profiles, noisy_profiles})
    result.push_back(section());
  return result;
}

std::string read_all(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot read " + path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// @return how many lines exceed their bound or are stated otherwise by the document
int faults(const std::vector<Section>& measured, const std::string& document) {
  int count = 0;
  for (const Section& section : measured) {
    for (const Line& entry : section.lines) {
      if (!(entry.worst_ratio <= 1.0)) {
        fmt::print("beyond its bound: {}\n", text(entry));
        ++count;
      }
      if (document.find(promise(entry)) == std::string::npos) {
        fmt::print("not in the document: {}\n", promise(entry));
        ++count;
      }
    }
  }
  return count;
}

void print(const std::vector<Section>& measured) {
  for (const Section& section : measured) {
    fmt::print("{}\n", section.title);
    fmt::print("  {:<58} {:>6}  {:<18} {:>9} {:>8}\n", "", "cases", "bound", "worst", "of bound");
    for (const Line& entry : section.lines) fmt::print("  {}\n", text(entry));
    fmt::print("\n");
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const std::vector<std::string_view> arguments(argv + 1, argv + argc);
    const bool is_check = arguments.size() == 2 && arguments[0] == "--check";
    const std::vector<Section> measured = sections(!is_check || testing::thorough());
    print(measured);
    if (!is_check) return 0;
    return faults(measured, read_all(std::string(arguments[1]))) == 0 ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
