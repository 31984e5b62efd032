#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/quantity.hpp"
#include "glissade/core/units.hpp"
#include "glissade/design/stream_channel.hpp"
#include "glissade/trades/chute/ends.hpp"

#include "design/checks.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace glissade {

double speed_of_free_fall(const Design& design) {
  const double g = design.gravity;
  double square = design.body.entry_speed * design.body.entry_speed;
  if (design.feed) {
    const FeedDesign& feed = *design.feed;
    const double leaves = feed.kind == FeedKind::belt     ? feed.belt_speed
                          : feed.kind == FeedKind::hopper ? feed.outlet_speed
                                                          : 0.0;
    square = leaves * leaves + 2.0 * g * feed.drop;
    // From where it meets a hood, no further down than the hood is wide.
    if (design.hood)
      square += 2.0 * g * (2.0 * design.hood->radius.highest.value_or(0.0) + design.hood->drop);
  }
  return std::sqrt(std::max(0.0, square + 2.0 * g * design_file::drop_of(design.track)));
}

}  // namespace glissade

namespace glissade::design_file {
namespace {

constexpr double kFastest = 100.0;                                 // [m/s]
constexpr double kHighest = 1e3;                                   // [m]
constexpr double kLargest = 10.0;                                  // [m], of a pulley's radius
constexpr double kSteepest = Angle::from_degrees(45.0).radians();  // of a belt
constexpr double kLargestHood = 100.0;                             // [m]
constexpr double kUpright = Angle::from_degrees(90.0).radians();

void check_between(double value, double least, double most, bool above_least, const std::string& key,
                   Dimension dimension, const std::string& why, const std::string& hint,
                   Collected& findings) {
  const bool fine = value <= most && (above_least ? value > least : value >= least);
  if (fine) return;
  const std::string last = key.substr(key.rfind('.') + 1);
  report(findings, {key}, out_of_range(last, value, dimension, {least, most}, why, hint));
}

void check_feed(const Design& design, Collected& findings) {
  const FeedDesign& feed = *design.feed;
  if (!design.stream) {
    report(findings, {"feed"},
           {"", "feed: without a stream", "A feed is that of a stream of bulk solid.",
            "stream: {mass_flow: 650 t/h, bulk_density: 1600 kg/m^3}, or an entry_speed"});
  }
  if (design.body.entry_speed != 0.0) {
    report(findings, {"body.entry_speed", "feed"},
           {"", "entry_speed: beside a feed", "How fast the stream enters follows from the feed's impact.",
            "one of the two"});
  }
  const bool even =
      design.centerline.kind == CenterlineKind::constant_speed && !design.centerline.constant_speed_p;
  if (even || design.objective.kind == ObjectiveKind::even_speed) {
    report(findings, {"feed", "centerline.kind"},
           {"", std::string(even ? "constant-speed without p" : "objective: even_speed") + ", with a feed",
            "The speed to keep is the one at which the stream enters, and that follows from the track.",
            "entry_speed below body: in place of the feed"});
  }
  const bool at_outlet = feed.kind == FeedKind::hopper && feed.outlet_speed > 0.0;
  check_between(feed.drop, 0.0, kHighest, !at_outlet, "feed.drop", Dimension::length,
                "Without a way down the feed never meets the floor: above 0, at most 1 km.",
                "0.8 m, from where the stream leaves down to the start of the track", findings);
  if (feed.kind == FeedKind::hopper) {
    check_between(feed.outlet_speed, 0.0, kFastest, false, "feed.outlet_speed", Dimension::speed,
                  "It lies between 0 and 100 m/s.", "0.5 m/s", findings);
  }
  if (feed.kind != FeedKind::belt) return;
  check_between(feed.belt_speed, 0.0, kFastest, true, "feed.belt_speed", Dimension::speed,
                "A belt runs: above 0, at most 100 m/s.", "3.2 m/s", findings);
  check_between(feed.pulley_radius, 0.0, kLargest, true, "feed.pulley_radius", Dimension::length,
                "It is positive, and at most 10 m.", "400 mm, belt included", findings);
  check_between(feed.belt_angle.radians(), -kSteepest, kSteepest, false, "feed.belt_angle", Dimension::angle,
                "A belt climbs or falls by at most 45 deg.", "12 deg", findings);
}

/// One measure of a hood, or the bounds that it is chosen within.
void check_choice(const Range& range, double least, double most, bool above_least, const std::string& key,
                  Dimension dimension, const std::string& why, const std::string& hint, Collected& findings) {
  if (!range.lowest || !range.highest) return;  // the reader has said so
  const std::string where = "hood." + key;
  if (range.is_fixed()) {
    check_between(*range.lowest, least, most, above_least, where, dimension, why, hint, findings);
    return;
  }
  check_between(*range.lowest, least, most, above_least, where + ".lowest", dimension, why, hint, findings);
  check_between(*range.highest, least, most, above_least, where + ".highest", dimension, why, hint, findings);
  if (*range.lowest < *range.highest) return;
  const auto text = [&](double value, int digits) { return quantity_text(value, dimension, digits); };
  const auto [lowest, highest] = texts_apart(*range.lowest, *range.highest, text);
  report(findings, {where},
         {"", key + ": lowest, " + lowest + ", is above highest, " + highest, "",
          "lowest: " + quantity_text(*range.highest, dimension) +
              ", highest: " + quantity_text(*range.lowest, dimension)});
}

bool sound(const HoodDesign& hood) {
  const auto within = [](const Range& range, double least, double most) {
    return range.lowest && range.highest && *range.lowest >= least && *range.highest <= most &&
           *range.lowest <= *range.highest;
  };
  return within(hood.radius, 1e-6, kLargestHood) && within(hood.impact_angle, 0.0, kSteepest) &&
         within(hood.exit_angle, 0.0, kUpright);
}

/// Whether the stream can press on the hood where it meets it, at the friction that takes most of its speed.
void check_contact(const Design& design, Collected& findings) {
  const FeedDesign& feed = *design.feed;
  const HoodDesign& hood = *design.hood;
  const bool feed_is_sound = feed.kind == FeedKind::belt && feed.belt_speed > 0.0 &&
                             feed.pulley_radius > 0.0 && feed.drop > 0.0 &&
                             std::fabs(feed.belt_angle.radians()) <= kSteepest;
  if (!feed_is_sound || !sound(hood) || !(design.gravity > 0.0)) return;
  const Landing falls =
      fall_from_belt({feed.belt_speed, feed.pulley_radius, feed.belt_angle}, feed.drop, design.gravity)
          .landing;
  const Angle theta = Angle::from_radians(*hood.impact_angle.lowest);
  const Angle slope = falls.angle + theta;
  if (!(slope.radians() < *hood.exit_angle.highest)) {
    report(findings, {"hood.exit_angle", "hood"},
           {"",
            "exit_angle: " + angle_text(Angle::from_radians(*hood.exit_angle.highest)) +
                ", but the stream meets the hood at " + angle_text(slope),
            "A hood turns a stream down: the feed falls " + angle_text(falls.angle) +
                " below the horizontal, and the hood is steeper than that by its impact_angle.",
            "a larger exit_angle, a smaller impact_angle, or a shorter drop of the feed"});
    return;
  }
  const Friction friction = design.body.high_friction.value_or(design.body.friction);
  const double left = std::max(0.0, impact_on({falls.speed, theta}, Angle{}, friction, 1.0).speed_ratio);
  const double speed = left * falls.speed;
  const double presses = speed * speed / (design.gravity * *hood.radius.lowest);
  const double needed = math::cos(slope.radians());
  if (presses >= needed) return;
  const double fits = speed * speed / (design.gravity * needed);
  report(findings, {"hood.radius", "hood"},
         {"",
          "hood: no contact where the feed meets it: v^2/(g R) is " + rounded_text(presses, 3) + ", at " +
              quantity_text(speed, Dimension::speed) + " and a radius of " + length_text(*hood.radius.lowest),
          "Below " + rounded_text(needed, 3) + ", the cosine of its slope of " + angle_text(slope, 3) +
              ", the stream falls away from the underside before the hood has turned it.",
          "a radius below " + length_text(fits, 3) + ", a faster belt, or a longer drop of the feed"});
}

void check_hood(const Design& design, Collected& findings) {
  const HoodDesign& hood = *design.hood;
  if (!design.feed || design.feed->kind != FeedKind::belt) {
    report(
        findings, {"hood"},
        {"", std::string("hood: without a feed from a belt"),
         "A hood stands in front of a head pulley and turns down what comes from it.",
         "feed: {kind: belt, belt_speed: 3.2 m/s, pulley_radius: 400 mm, drop: 200 mm}, its drop down to the "
         "hood"});
  }
  check_choice(hood.radius, 0.0, kLargestHood, true, "radius", Dimension::length,
               "That of its underside: above 0, at most 100 m.", "1.2 m", findings);
  check_choice(hood.impact_angle, 0.0, kSteepest, false, "impact_angle", Dimension::angle,
               "Between the way of the feed and the hood: 0 to 45 deg.", "10 deg", findings);
  check_choice(hood.exit_angle, 0.0, kUpright, false, "exit_angle", Dimension::angle,
               "Of the stream at the lower edge, below the horizontal: at most 90 deg, straight down.",
               "80 deg", findings);
  check_between(hood.drop, 0.0, kHighest, true, "hood.drop", Dimension::length,
                "From its lower edge down to the start of the track: above 0, at most 1 km.", "500 mm",
                findings);
  if (design.feed) check_contact(design, findings);
}

void check_discharge(const Design& design, Collected& findings) {
  const DischargeDesign& discharge = *design.discharge;
  if (!design.stream) {
    report(findings, {"discharge"},
           {"", "discharge: without a stream", "It is a stream that lands on a belt.",
            "stream: {mass_flow: 650 t/h, bulk_density: 1600 kg/m^3}"});
  }
  check_between(discharge.belt_speed, 0.0, kFastest, true, "discharge.belt_speed", Dimension::speed,
                "A belt runs: above 0, at most 100 m/s.", "2.5 m/s", findings);
  check_between(discharge.drop, 0.0, kHighest, false, "discharge.drop", Dimension::length,
                "The belt lies below the finish: 0 to 1 km.", "400 mm", findings);
  check_between(discharge.direction.radians(), -std::numbers::pi, std::numbers::pi, false,
                "discharge.direction", Dimension::angle, "Seen from above, between -180 and 180 deg.",
                "0 deg", findings);
  check_between(discharge.belt_angle.radians(), -kSteepest, kSteepest, false, "discharge.belt_angle",
                Dimension::angle, "A belt climbs or falls by at most 45 deg.", "12 deg", findings);
  check_between(discharge.belt_friction, 0.0, 10.0, false, "discharge.belt_friction", Dimension::number,
                "A coefficient of friction: 0 to 10.", "0.5", findings);
}

/// What a stream can have along a belt at most: all of its energy, and none of it worn down.
void check_match(const Design& design, Collected& findings) {
  if (!design.limits || !design.limits->match_belt) return;
  const BeltMatch& match = *design.limits->match_belt;
  check_between(match.speed, 0.0, kFastest, true, "limits.match_belt.speed", Dimension::speed,
                "A belt runs: above 0, at most 100 m/s.", "2.5 m/s", findings);
  if (!(match.within > 0.0 && match.within <= 1.0)) {
    report(findings, {"limits.match_belt.within"},
           {"", "within: " + percent_beyond(match.within, {0.0, 1.0}) + " is out of range",
            "A share of the belt's speed: above 0, at most 100 %.", "10 %"});
  }
  const double cosine = math::cos(match.direction.radians());
  if (!(cosine > 0.0 && std::fabs(match.direction.radians()) <= kRightAngle)) {
    report(findings, {"limits.match_belt.direction"},
           {"",
            "direction: " + angle_text(match.direction) +
                (cosine > 0.0 ? " is out of range" : ", against the track"),
            "What lands has no speed along such a belt.", "a direction between -90 and 90 deg"});
    return;
  }
  if (design.track.free_finish != FinishKind::point || is_drawn(design.centerline.kind)) return;
  const double most = speed_of_free_fall(design) * cosine;
  const double least = match.speed * (1.0 - match.within);
  if (!(least > most)) return;
  report(
      findings, {"limits.match_belt.speed"},
      {"",
       "match_belt: a belt of " + quantity_text(match.speed, Dimension::speed) +
           " is faster than the stream can be, " + quantity_text(most, Dimension::speed),
       std::string("That is the speed of free fall from ") + (design.feed ? "the feed" : "start") +
           " to finish" +
           std::string(match.direction == Angle() ? "." : ", of which the belt sees its direction's share."),
       "a slower belt, or a longer drop"});
}

}  // namespace

void check_ends(const Design& design, Collected& findings) {
  if (design.feed) check_feed(design, findings);
  if (design.hood) check_hood(design, findings);
  if (design.discharge) check_discharge(design, findings);
  check_match(design, findings);
}

}  // namespace glissade::design_file
