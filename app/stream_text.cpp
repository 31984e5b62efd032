#include "app/stream_text.hpp"

#include "glissade/core/number_text.hpp"
#include "glissade/core/quantity.hpp"
#include "glissade/design/stream_channel.hpp"
#include "glissade/trades/chute/stream.hpp"

#include "app/console.hpp"
#include "app/law_text.hpp"
#include "app/summary.hpp"
#include "app/table.hpp"

#include <cmath>

namespace glissade::app {
namespace {

std::string depth_text(const Design& design, const Motion& motion) {
  const StreamFacts facts = stream_facts(motion).value();
  const StreamChannel channel = stream_channel(design.cross_section.value()).value();
  std::string text = length_text(facts.deepest.value) + " deep at most, " +
                     length_text(facts.deepest.arc_length) + " down the track";
  if (facts.exit_depth) text += ", " + length_text(*facts.exit_depth) + " at the finish";
  const bool wall = channel.has_low_walls();
  const std::string bound =
      wall ? "wall of " + length_text(channel.wall_height)
           : "depth of " + length_text(channel.width.narrowest()) + ", the width, at which its law ends";
  text += "\n" + (facts.choke ? emphasised("chokes", Emphasis::bad) + ": it reaches the " + bound
                              : rounded_text(100.0 * facts.filling.value, 3) + " % of the " + bound);
  text += "\nfriction coefficient " + rounded_text(facts.equivalent_friction.value, 4) +
          " at most with what the side walls add, " + length_text(facts.equivalent_friction.arc_length) +
          " down the track";
  return text;
}

/// A stream at another friction, and how it ends if not at the finish.
std::string range_ride_text(const Motion& motion) {
  if (!enters(motion)) return "none: it " + emphasised(std::string(ride_status(motion)), Emphasis::bad);
  const StreamFacts facts = stream_facts(motion).value();
  const std::string deep = length_text(facts.deepest.value) + " deep at most, ";
  if (facts.exit_depth) return deep + length_text(*facts.exit_depth) + " at the finish";
  const std::string how = motion.stall() ? "stalls" : motion.lift_off() ? "leaves the track" : "chokes";
  return deep + emphasised(how, Emphasis::bad) + " after " + length_text(motion.distance());
}

std::string wear_lines(const Design& design, const Track& track) {
  const WearAtFrictions at_frictions = wear_at_frictions(track);
  const WearFacts& wear = at_frictions.facts;
  const auto friction_text = [&](FrictionLevel level) {
    return track.range.empty() ? std::string() : ", at " + std::string(to_text(level)) + " friction";
  };
  std::string text = "floor " + quantity_text(wear.floor.value, Dimension::power_per_area) + " at most, " +
                     length_text(wear.floor.arc_length) + " down the track" +
                     friction_text(at_frictions.level) + "; side walls " +
                     quantity_text(wear.wall.value, Dimension::power_per_area);
  std::string plates;
  for (const WearStretch& plate : wear.plates)
    plates += (plates.empty() ? "" : ", ") + length_text(plate.from, 3) + " to " + length_text(plate.to, 3);
  text += "\nhalf of that or more: " + plates;
  if (const auto loss = liner_loss(design, wear)) {
    text += "\nliner " + length_text(loss->per_1000_h, 3) + " thinner after 1000 h, " +
            length_text(loss->per_megatonne, 3) + " after a million tonnes; through after " +
            rounded_text(loss->life_hours, 3) + " h, first " + length_text(wear.pressed.arc_length, 3) +
            " down the track" + friction_text(at_frictions.pressed_level);
  }
  return labelled("Wear", text);
}

// Rounding, of a search that leads its track along the way of the feed [rad].
constexpr double kAlong = 1e-9;

/// How a stream comes down on something, and what is left of its speed.
std::string impact_text(const Landing& landing, const Impact& impact, const char* onto) {
  if (impact.angle.radians() < -kAlong) {
    return "falls at " + speed_text(landing.speed) + ", " + angle_text(landing.angle, 3) +
           " below the horizontal\n" + emphasised("flies over", Emphasis::bad) + " the " + onto +
           ", which is steeper by " + angle_text(-1.0 * impact.angle, 3);
  }
  std::string text = "falls at " + speed_text(landing.speed) + ", " + angle_text(landing.angle, 3) +
                     " below the horizontal, " + angle_text(impact.angle, 3) + " to the " + onto;
  if (impact.speed_ratio > 0.0) {
    return text + "\nenters at " + speed_text(impact.speed_ratio * landing.speed) + ", " +
           rounded_text(100.0 * impact.speed_ratio, 3) + " % of that; presses with " +
           rounded_text(impact.pressure / 1e3, 3) + " kPa";
  }
  return text + "\n" + emphasised("stands", Emphasis::bad) +
         " where it lands: friction takes all of its speed";
}

std::string hood_lines(const Design& design, const Track& track) {
  if (!design.hood) return "";
  const HoodPassage passage = hood_passage(design, track.motion.body());
  const HoodDesign& hood = *design.hood;
  const Motion& below = passage.motion;
  const Impact impact = impact_on(passage.landing, Angle::from_radians(track.centerline->slope_angle(0.0)),
                                  track.motion.body().friction, design.stream->bulk_density);
  std::string text = "radius " + length_text(*hood.radius.lowest) + ", turns the stream from " +
                     angle_text(Angle::from_radians(below.centerline().slope_angle(0.0)), 3) + " to " +
                     angle_text(Angle::from_radians(*hood.exit_angle.lowest), 3) + " over " +
                     length_text(below.centerline().length());
  text += "\npressed on: v^2/(g R cos) is " + rounded_text(passage.contact, 3) +
          " where the feed meets it, " + rounded_text(passage.least_contact, 3) + " at least";
  text += "\nleaves at " + speed_text(below.exit_speed()) + ", " +
          length_text(below.highest(BulkStream::kDepth).value) + " deep at most; wears " +
          quantity_text(stream_peak(below, &StreamState::floor_wear).value, Dimension::power_per_area) +
          " at most";
  text += "\n" + impact_text(passage.landing, impact, "floor of the spoon");
  const Range spread = landing_spread(design, track);
  if (*spread.highest > *spread.lowest) {
    text += "\nover the range of friction it comes down " + length_text(-*spread.lowest, 2) + " before to " +
            length_text(*spread.highest, 2) + " behind the start";
  }
  if (track.motion.arrived() && enters(track.motion)) {
    text += "\n" + quantity_text(transfer_time(design, track.motion), Dimension::time) +
            " from the pulley to the finish";
  }
  if (track.early_hood)
    text += "\n" + emphasised("not converged", Emphasis::bad) + ": " + track.early_hood->message;
  return labelled("Hood", text);
}

std::string feed_lines(const Design& design, const Track& track) {
  if (!design.feed) return "";
  const FeedFall fall = feed_fall(design);
  const Body& body = track.motion.body();
  const Impact impact = design.hood
                            ? hood_passage(design, body).impact
                            : impact_on(fall.landing, Angle::from_radians(track.centerline->slope_angle(0.0)),
                                        body.friction, design.stream->bulk_density);
  std::string text = impact_text(fall.landing, impact, design.hood ? "hood" : "floor");
  if (design.feed->kind == FeedKind::belt) {
    text += "\nhead pulley " + length_text(-fall.pulley.x) + (fall.pulley.x < 0.0 ? " before" : " beyond") +
            " the start and " + length_text(fall.pulley.y) + " above it";
  }
  return labelled("Feed", text);
}

std::string discharge_lines(const Design& design, const Track& track) {
  if (!design.discharge || !track.motion.arrived() || !enters(track.motion)) return "";
  const BeltLanding landing = belt_landing(design, track.motion);
  if (!landing.lands()) {
    return labelled("Discharge", "does not land: it moves away from the belt at " +
                                     speed_text(-landing.speed_into) + " where it comes to its plane, " +
                                     length_text(landing.reach) + " beyond the finish");
  }
  return labelled("Discharge",
                  "lands with " + speed_text(landing.speed_along) + " along the belt, " +
                      rounded_text(100.0 * landing.match, 3) + " % of its " +
                      speed_text(design.discharge->belt_speed) + ", and " + speed_text(landing.speed_into) +
                      " into it\n" + length_text(landing.reach) + " beyond the finish" +
                      (landing.off_centre == 0.0 ? ""
                                                 : ", " + length_text(std::fabs(landing.off_centre)) +
                                                       " beside it across the belt") +
                      "; belt wear factor " + rounded_text(landing.wear_factor, 3));
}

}  // namespace

std::string stream_lines(const Design& given, const Track& track) {
  const Design design = as_solved(given, track);
  if (!enters(track.motion)) return feed_lines(design, track) + hood_lines(design, track);
  std::string text = depth_text(design, track.motion);
  const auto most = choking_mass_flow(track.centerline, track.motion.body(), design.gravity);
  if (most && *most == 0.0) {
    text += "\nnot even a grain arrives";
  } else if (most) {
    text += "\nchokes from " + quantity_text(*most, Dimension::mass_flow) + " on, " +
            rounded_text(*most / design.stream->mass_flow, 3) + " times the flow";
  } else {
    text += "\nchokes at no flow below a thousand times its own";
  }
  for (const RangeRide& ride : track.range)
    text += "\nat " + std::string(to_text(ride.level)) + " friction " + range_ride_text(ride.motion);
  return labelled("Stream", text) + wear_lines(design, track) + feed_lines(design, track) +
         hood_lines(design, track) + discharge_lines(design, track);
}

}  // namespace glissade::app
