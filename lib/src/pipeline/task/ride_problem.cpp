// What is wrong with a ride, in words.

#include "glissade/centerline/straight_line.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/pipeline/solve.hpp"
#include "glissade/trades/chute/stream.hpp"

#include "pipeline/task/body.hpp"
#include "pipeline/task/friction_range.hpp"
#include "pipeline/task/located.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace glissade {

using namespace pipeline;

namespace {

/// A feed that falls flatter than the floor where it should land never meets it there.
std::optional<Issue> feed_problem(const Design& design, const Track& track) {
  if (!design.feed) return {};
  Angle falls = track.motion.body().landing->angle;
  bool all_land = lands(track.motion);
  for (const LevelRide& ride : track.rides()) {
    falls = std::min(falls, ride.motion->body().landing->angle);
    all_land = all_land && lands(*ride.motion);
  }
  if (all_land) return {};
  const Angle slope = Angle::from_radians(track.centerline->slope_angle(0.0));
  return Issue{design.where("feed"),
               "the feed flies over the start: it falls at " + angle_text(falls) + ", the floor at " +
                   angle_text(slope),
               "A stream meets a floor that is less steep than its way.",
               "a larger drop, a slower belt, or limits: {entry_slope_angle: {highest: " +
                   angle_text(falls, 3) + "}}"};
}

// Tenths of a degree, rounded to the side that helps.
constexpr double kShownSteps = 10.0;  // taste

Angle shown_up(Angle angle) {
  return Angle::from_degrees(std::ceil(kShownSteps * angle.degrees()) / kShownSteps);
}
Angle shown_down(Angle angle) {
  return Angle::from_degrees(std::floor(kShownSteps * angle.degrees()) / kShownSteps);
}

/// What would do in place of a feed that stands where it lands: the impact then leaves what practice asks for. Only what
/// brings the stream to the finish is told.
class WaysOut {
 public:
  WaysOut(const Design& design, const Track& track, const Motion& motion)
      : design_(design), track_(track), motion_(motion) {}

  [[nodiscard]] std::string text() const {
    std::string text;
    for (const std::string& way : {floor(), friction(), feed()}) {
      if (!way.empty()) text += (text.empty() ? "" : ", or ") + way;
    }
    if (text.empty()) return "less friction, or a floor nearer to the direction of the fall";
    return text + ": the impact then leaves " + rounded_text(kSpeedToKeep, 2) + " of the speed";
  }

 private:
  [[nodiscard]] Angle falls() const { return motion_.body().landing->angle; }
  [[nodiscard]] Angle slope() const { return Angle::from_radians(motion_.centerline().slope_angle(0.0)); }
  [[nodiscard]] Angle steepest() const { return steepest_impact(kSpeedToKeep, motion_.body().friction); }
  [[nodiscard]] bool arrives(const CenterlinePtr& centerline, const Body& body) const {
    const Motion tried(centerline, body, design_.gravity);
    return tried.arrived() && enters(tried);
  }

  [[nodiscard]] std::string floor() const {
    const Angle least = std::min(falls(), shown_up(falls() - steepest()));
    // A floor that is upright has no run; one that climbs leads nowhere.
    constexpr double kMost = 89.9;  // taste [deg]
    if (!(least.degrees() > 0.0 && least.degrees() < kMost)) return {};
    const double length = track_.centerline->length();
    const Endpoints ends{length * math::cos(least.radians()), length * math::sin(least.radians())};
    if (!arrives(std::make_shared<const StraightLine>(ends), motion_.body())) return {};
    return "a floor of at least " + angle_text(least) + " where it lands";
  }

  [[nodiscard]] std::string friction() const {
    const auto kept = most_friction_of_impact(kSpeedToKeep, falls() - slope());
    const std::optional<Angle> stops = stall_angle_of(track_);
    if (!kept || !stops) return {};
    const Angle most = shown_down(std::min(kept->angle(), *stops));
    Body body = motion_.body();
    body.friction = Friction::from_angle(most);
    return arrives(track_.centerline, body) ? "a friction angle of at most " + angle_text(most)
                                            : std::string();
  }

  [[nodiscard]] std::string feed() const {
    if (design_.hood || design_.feed->kind != FeedKind::belt) return {};
    const Angle most = shown_down(slope() + steepest());
    Body body = motion_.body();
    body.landing->angle = most;
    if (!arrives(track_.centerline, body)) return {};
    return "a feed that falls at " + angle_text(slope(), 3) + " to " + angle_text(most) +
           " (a faster belt, or less drop)";
  }

  const Design& design_;
  const Track& track_;
  const Motion& motion_;
};

/// A feed of which friction takes all the speed where it lands.
Issue stand_problem(const Design& design, const Track& track, const Motion& motion, const std::string& when) {
  const Angle steeper =
      motion.body().landing->angle - Angle::from_radians(motion.centerline().slope_angle(0.0));
  return {design.where("feed"), when + "the feed stands where it lands: friction takes all of its speed",
          "It falls " + angle_text(steeper, 3) + " steeper than the floor; with the friction angle, " +
              angle_text(motion.body().friction.angle()) + ", that is 90 deg or more.",
          WaysOut(design, track, motion).text()};
}

/// What keeps one ride from the finish. Of a ride at the nominal friction the friction needs no name.
std::optional<Issue> problem_of_ride(const Design& design, const Track& track, const LevelRide& ride) {
  const Motion& motion = *ride.motion;
  const double length = track.centerline->length();
  const std::string when = ride.level == FrictionLevel::nominal ? "" : at_friction_text(ride) + ", ";
  if (stands_where_it_lands(motion)) return stand_problem(design, track, motion, when);
  if (const auto& stall = motion.stall()) {
    const auto [stalls_after, whole] = texts_apart(stall->arc_length, length, &length_text);
    const bool all_but_there = stalls_after == whole;  // nearer than digits tell
    const std::string place = all_but_there
                                  ? "the body stalls all but at the finish, at " + length_text(length)
                                  : (stall->arc_length == 0.0 ? "the body does not start to slide"
                                                              : "the body stalls after " + stalls_after) +
                                        ", before the finish at " + whole;
    return Issue{design.where("centerline"), when + place,
                 "The slope angle there is " +
                     angle_text(Angle::from_radians(track.centerline->slope_angle(stall->arc_length))) +
                     ", " + angle_text(stall->missing_slope) + " less than " +
                     friction_text(motion.body(), *stall) + ".",
                 std::string("a steeper track, less friction, or ") +
                     (design.body.entry_speed > 0.0 ? "a higher entry_speed" : "an entry_speed")};
  }
  if (const auto& lift_off = motion.lift_off()) {
    return Issue{design.where("centerline"),
                 when + "the body leaves the track after " + length_text(lift_off->arc_length) + ", at " +
                     rounded_text(lift_off->speed, 4) + " m/s",
                 "The track bends away below it there with a radius of " +
                     length_text(1.0 / std::fabs(lift_off->curvature)) +
                     ", tighter than gravity can make it follow.",
                 "a larger radius at that crest, or less speed"};
  }
  if (const auto& end = motion.law_end()) return law_end_problem(design, *end, length);
  return {};
}

}  // namespace

std::optional<LevelRide> ride_that_fails(const Track& track) {
  for (const LevelRide& ride : track.rides()) {
    if (!lands(*ride.motion)) return ride;
  }
  if (!track.motion.arrived()) return LevelRide{FrictionLevel::nominal, &track.motion};
  for (const RangeRide& ride : track.range) {
    if (!ride.motion.arrived()) return LevelRide{ride.level, &ride.motion};
  }
  return {};
}

std::optional<Issue> ride_problem(const Design& design, const Track& track) {
  const std::optional<LevelRide> fails = ride_that_fails(track);
  if (!fails) return {};
  if (auto problem = feed_problem(design, track)) return problem;
  auto problem = problem_of_ride(design, track, *fails);
  const bool searched = design.limits && design.centerline.kind == CenterlineKind::fastest;
  if (problem && fails->level != FrictionLevel::nominal && !searched &&
      design.centerline.kind == CenterlineKind::fastest) {
    problem->hint = "limits: {}, which finds the fastest track that holds over the whole range of friction";
  }
  return problem;
}

}  // namespace glissade
