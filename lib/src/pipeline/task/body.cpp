// What moves: from the design's body to Motion's, and what is to be said of its law.

#include "pipeline/task/body.hpp"

#include "glissade/core/number_text.hpp"
#include "glissade/design/stream_channel.hpp"
#include "glissade/motion/laws/bulk_stream.hpp"
#include "glissade/motion/laws/most_wear.hpp"
#include "glissade/motion/laws/rider.hpp"
#include "glissade/motion/laws/rolling_ball.hpp"
#include "glissade/pipeline/solve.hpp"
#include "glissade/trades/chute/stream.hpp"

#include "pipeline/task/hood.hpp"
#include "pipeline/task/located.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <vector>

namespace glissade {

using namespace pipeline;

namespace {

LawPtr stream_law(const StreamDesign& design, const CrossSectionDesign& section) {
  const auto channel = stream_channel(section);
  if (!channel) throw InternalError({"", "a stream in a cross-section that is no channel", "", ""});
  StreamShape shape;
  shape.mass_flow = design.mass_flow;
  shape.bulk_density = design.bulk_density;
  shape.lateral_pressure_ratio = design.lateral_pressure_ratio;
  shape.width = channel->width;
  shape.wall_height = channel->wall_height;
  shape.slip_ratio = design.slip_ratio;
  return std::make_shared<const BulkStream>(shape);
}

// The law of each kind of body.

LawPtr law_of(const SlidingDesign&, const BodyDesign& body) {
  const double height = body.centre_height.value_or(0.0);
  return height == 0.0 ? nullptr : std::make_shared<const Rider>(height);
}

LawPtr law_of(const RollingDesign& ball, const BodyDesign& body) {
  BallShape shape;
  shape.radius = ball.radius;
  shape.groove_half_angle = ball.groove_half_angle;
  shape.centre_height = body.centre_height;
  shape.grip = ball.grip;
  return std::make_shared<const RollingBall>(shape);
}

LawPtr law_of(const BodyDesign& body) {
  return std::visit([&](const auto& kind) { return law_of(kind, body); }, body.kind);
}

/// Of the stream that rides, which need not be the nominal one: a surge is at the lowest density [kg/m^3].
double density_of(const Motion& motion) {
  const BulkStream* const stream = stream_of(motion.body());
  if (stream == nullptr)
    throw InputError(
        {"", "the body is no stream", "Only a bulk solid has a density.", "a design with a stream"});
  return stream->shape().bulk_density;
}

}  // namespace

FeedFall pipeline::first_fall(const Design& design) {
  const FeedDesign& feed = design.feed.value();
  if (feed.kind != FeedKind::belt) return fall_from_outlet(feed.outlet_speed, feed.drop, design.gravity);
  return fall_from_belt({feed.belt_speed, feed.pulley_radius, feed.belt_angle}, feed.drop, design.gravity);
}

BeltLanding belt_landing(const Design& design, const Motion& motion) {
  const DischargeDesign& belt = design.discharge.value();
  return land_on_belt(motion.exit_speed(),
                      Angle::from_radians(motion.centerline().slope_angle(motion.distance())),
                      {belt.belt_speed, belt.direction, belt.belt_angle, belt.drop, belt.belt_friction},
                      density_of(motion), design.gravity);
}

std::optional<Impact> impact_of(const Motion& motion) {
  const Body& body = motion.body();
  if (!body.landing || !lands(motion)) return {};
  return impact_on(*body.landing, Angle::from_radians(motion.centerline().slope_angle(0.0)), body.friction,
                   density_of(motion));
}

std::optional<Motion> pipeline::most_wearing_ride(const CenterlinePtr& centerline, const Motion& nominal,
                                                  const std::vector<RangeRide>& range) {
  if (range.empty()) return {};
  Body body = nominal.body();
  Friction low = body.friction;
  Friction high = low;
  for (const RangeRide& ride : range) {
    low = std::min(low, ride.motion.body().friction);
    high = std::max(high, ride.motion.body().friction);
  }
  const auto friction = friction_of_most_wear(centerline, body, nominal.gravity(), low, high);
  if (!friction) return {};
  body.friction = *friction;
  return Motion(centerline, body, nominal.gravity());
}

WearAtFrictions wear_at_frictions(const Track& track) {
  std::vector<LevelRide> rides = track.rides();
  const std::optional<Motion> between = most_wearing_ride(track.centerline, track.motion, track.range);
  if (between) rides.push_back({FrictionLevel::between, &*between});
  // What flies over the start, or stands there, rubs nothing.
  std::erase_if(rides, [](const LevelRide& ride) { return !enters(*ride.motion); });
  if (rides.empty()) return {};
  std::vector<const Motion*> motions;
  for (const LevelRide& ride : rides) motions.push_back(ride.motion);
  WearAtFrictions wear;
  wear.facts = wear_of(motions);
  wear.level = rides[wear.facts.ride].level;
  wear.pressed_level = rides[wear.facts.pressed_ride].level;
  return wear;
}

std::vector<FloorWear> pipeline::floor_wear(const Design& design, const Track& track) {
  std::vector<const Motion*> motions;
  for (const LevelRide& ride : track.rides()) motions.push_back(ride.motion);
  const std::optional<Motion> between = most_wearing_ride(track.centerline, track.motion, track.range);
  if (between) motions.push_back(&*between);
  const std::vector<FloorLoad> loads = floor_loads(motions);
  double peak = 0.0;
  for (const FloorLoad& load : loads) peak = std::max(peak, load.wear);
  const auto& plate = design.stream.value().liner_plate;
  std::vector<FloorWear> wear;
  for (const FloorLoad& load : loads) {
    wear.push_back(
        {load.at, peak > 0.0 ? load.wear / peak : 0.0,
         plate ? thickness_loss_rate({plate->wear_coefficient, plate->hardness}, load.pressed) : 0.0});
  }
  return wear;
}

std::optional<LinerLoss> liner_loss(const Design& design, const WearFacts& wear) {
  const StreamDesign& stream = design.stream.value();
  if (!stream.liner_plate || !(wear.pressed.value > 0.0)) return {};
  const LinerPlateDesign& plate = *stream.liner_plate;
  const double rate = thickness_loss_rate({plate.wear_coefficient, plate.hardness}, wear.pressed.value);
  constexpr double kHour = 3600.0;
  constexpr double kMegatonne = 1e9;  // [kg]
  return LinerLoss{rate * 1000.0 * kHour, rate * kMegatonne / stream.mass_flow,
                   plate.thickness / rate / kHour};
}

Body body_of(const Design& design) {
  const BodyDesign& from = design.body;
  Body body;
  body.friction = from.friction;
  body.entry_speed = from.entry_speed;
  body.drag_per_metre = from.drag_per_metre;
  body.head_wind = from.head_wind;
  for (const FrictionFrom& change : from.friction_changes) {
    const std::vector<FrictionChange>& changes = body.friction_changes;
    const Friction before = changes.empty() ? body.friction : changes.back().friction;
    // A list of one friction is that friction, with all that is known of it.
    if (change.friction != before) body.friction_changes.push_back({change.from, change.friction});
  }
  // A stream has nothing above it that could press on it.
  body.held = design.limits && !design.limits->lowest_normal_load && !design.stream;
  if (design.feed) {
    body.landing = first_fall(design).landing;
  }
  body.law = at_place(design.where(design.stream ? "stream" : "body"), [&] {
    return design.stream ? stream_law(*design.stream, design.cross_section.value()) : law_of(from);
  });
  if (design.hood && design.feed) {
    const Landing feed = *body.landing;
    body.approach = at_place(design.where("hood"), [&] {
      return std::make_shared<const HoodApproach>(shape_of(*design.hood), feed, design.gravity);
    });
    body.landing = at_place(design.where("hood"), [&] { return landing_of(body); });
  }
  // Before the impact; what it leaves is known on a track.
  if (body.landing) body.entry_speed = body.landing->speed;
  return body;
}

std::string pipeline::friction_text(const Body& body, const Stall& stall) {
  Friction friction = body.friction;
  for (const FrictionChange& change : body.friction_changes) {
    if (change.from <= stall.arc_length) friction = change.friction;
  }
  const std::string_view resistance = body.law ? body.law->resistance_angle_name() : kFrictionAngleName;
  return "the " + std::string(resistance) + ", " + angle_text(friction.angle());
}

namespace {

Issue choke_problem(const Design& design, const LawEnd& end, const std::string& before) {
  const StreamChannel channel = stream_channel(design.cross_section.value()).value();
  const double width = channel.width.at(end.arc_length);
  const bool over_wall = channel.wall_height < width;
  return {design.where("stream"), "the stream chokes" + before,
          "At " + rounded_text(end.speed, 4) + " m/s it is " + length_text(end.value) + " deep there, " +
              (over_wall ? "as high as the wall: it spills over."
                         : "as deep as the channel is wide: Roberts' law of a fast, thin stream ends."),
          std::string("a steeper track, a wider channel, ") + (over_wall ? "a higher wall, " : "") +
              // Beside a feed there is no entry_speed to give.
              (design.feed ? "a start nearer to the direction of the fall, which leaves more speed, "
                           : "a higher entry_speed, ") +
              "or less flow or friction"};
}

}  // namespace

Issue pipeline::law_end_problem(const Design& design, const LawEnd& end, double length) {
  const std::string before =
      " after " + length_text(end.arc_length) + ", before the finish at " + length_text(length);
  if (end.what == "valley_radius_m") {
    return {design.where("centerline"), "the body does not fit into the valley" + before,
            "The track bends upwards there with a radius of " + length_text(end.value) +
                "; the centre of mass runs " + length_text(end.bound) + " above the track.",
            "a valley with a larger radius, or a smaller body"};
  }
  if (design.stream) return choke_problem(design, end, before);
  return {design.where("body"), std::string(end.what) + " reaches its bound" + before,
          "It is " + rounded_text(end.value, 4) + " there; the bound is " + rounded_text(end.bound, 4) + ".",
          ""};
}

std::optional<Issue> law_problem(const Design& design, const Track& track) {
  const std::vector<LawQuantity> quantities = track.motion.quantities();
  for (std::size_t i = 0; i < quantities.size(); ++i) {
    const LawQuantity& quantity = quantities[i];
    if (!quantity.highest || !quantity.verdict) continue;
    const QuantityPeak peak = track.motion.highest(i);
    if (!peak.beyond_from) continue;
    const std::string most = std::isinf(peak.value) ? "has no bound" : "is " + rounded_text(peak.value, 3);
    return Issue{design.where("body"),
                 std::string(quantity.verdict->broken) + ", from " + length_text(*peak.beyond_from) +
                     " down the track on",
                 "The " + std::string(quantity.name) + " " + most + " " + length_text(peak.arc_length) +
                     " down the track; there is " + rounded_text(*quantity.highest, 3) + ". " +
                     std::string(quantity.verdict->why),
                 std::string(quantity.verdict->hint)};
  }
  return {};
}

}  // namespace glissade
