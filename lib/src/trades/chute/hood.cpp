// A stream on the concave underside of a hood: Roberts' inverted curve, ridden by the referee with the load's sign turned.

#include "glissade/trades/chute/hood.hpp"

#include "glissade/centerline/clothoid_spline.hpp"
#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/quantity.hpp"
#include "glissade/trades/chute/stream.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

namespace glissade {
namespace {

// What a stand leaves is the slowest stream there is: it chokes where it lands.
constexpr double kStopped = 1e-9;  // [m/s]

void require_shape(const HoodShape& hood) {
  if (!(hood.radius > 0.0 && std::isfinite(hood.radius)))
    throw InputError(
        {"", "radius: " + length_text(hood.radius), "A hood is bent: its radius is positive.", ""});
  if (!(hood.exit_slope.radians() <= kRightAngle))
    throw InputError({"", "exit_angle: " + angle_text(hood.exit_slope),
                      "A hood turns its stream no further than straight down, 90 deg.", "80 deg"});
  if (!(hood.drop >= 0.0 && std::isfinite(hood.drop)))
    throw InputError({"", "drop: " + length_text(hood.drop), "The track begins below its hood.", ""});
  if (!(hood.impact_angle.radians() >= 0.0 && hood.impact_angle.radians() < kRightAngle))
    throw InputError({"", "impact_angle: " + angle_text(hood.impact_angle),
                      "The feed meets the underside at 0 to 90 deg.", "10 deg"});
}

void require_feed(const Landing& feed) {
  if (feed.speed > 0.0 && std::isfinite(feed.speed)) return;
  throw InputError({"", "feed: " + exact_text(feed.speed) + " m/s is not a finite speed above 0",
                    "A stream that meets a hood moves.", ""});
}

/// The same stream below the hood: as wide and as high as where its track begins.
Body below_hood(const Body& body, const BulkStream& stream, double entry_speed) {
  StreamShape shape = stream.shape();
  shape.width = WidthLaw(stream.width(0.0));
  shape.underside = true;
  Body below;
  below.friction = body.friction;
  below.drag_per_metre = body.drag_per_metre;
  below.entry_speed = entry_speed;
  below.law = std::make_shared<const BulkStream>(shape);
  return below;
}

/// v^2/(g R cos) below a hood of radius R.
double contact_of(const Motion& motion, double radius, const LawState& at) {
  const double cosine = math::cos(at.slope_angle);
  return at.v / (motion.gravity() * radius * std::max(cosine, std::numeric_limits<double>::min()));
}

double least_contact(const Motion& motion, double radius) {
  return -motion.highest([&](const LawState& at) { return -contact_of(motion, radius, at); }).value;
}

}  // namespace

CenterlinePtr hood_arc(const HoodShape& hood, const Landing& feed) {
  require_shape(hood);
  const Angle entry = feed.angle + hood.impact_angle;
  const double turn = (hood.exit_slope - entry).radians();
  if (!(turn > 0.0)) {
    throw InputError(
        {"",
         "exit_angle: " + angle_text(hood.exit_slope) + ", the stream meets the hood at " + angle_text(entry),
         "A hood turns a stream down: the feed falls " + angle_text(feed.angle) +
             " below the horizontal, and meets the hood at impact_angle.",
         "a larger exit_angle, a smaller impact_angle, or a feed that falls less before the hood"});
  }
  const double curvature = -1.0 / hood.radius;
  return std::make_shared<const ClothoidSpline>(
      entry, std::vector<ClothoidSegment>{{hood.radius * turn, curvature, curvature}});
}

namespace {

/// All but where it is pressed least, which takes a look at many places.
HoodPassage passage_of(const HoodShape& hood, const Landing& feed, const Body& body, double gravity) {
  const BulkStream* const stream = stream_of(body);
  if (stream == nullptr)
    throw InputError(
        {"", "the body is no stream", "Only a stream passes a hood.", "a body whose law is BulkStream"});
  require_feed(feed);
  const CenterlinePtr arc = hood_arc(hood, feed);
  // The impact is that on a floor at the same angle to the way.
  Impact impact =
      impact_on({feed.speed, hood.impact_angle}, Angle{}, body.friction, stream->shape().bulk_density);
  const double entry_speed = std::max(impact.speed_ratio * feed.speed, kStopped);
  Motion motion(arc, below_hood(body, *stream, entry_speed), gravity);

  HoodPassage passage{impact, std::move(motion)};
  const Motion& ride = passage.motion;
  passage.contact = contact_of(ride, hood.radius, ride.law_state(0.0));
  const CenterlinePoint edge = arc->at(arc->length());
  const CenterlinePoint leaves = arc->at(ride.distance());
  passage.start.y = edge.drop + hood.drop;
  const bool stands = ride.stall() || ride.law_end();
  const double speed = stands ? 0.0 : ride.exit_speed();
  const double ahead = speed * math::cos(leaves.slope_angle);
  const double sinks = speed * math::sin(leaves.slope_angle);
  const double height = passage.start.y - leaves.drop;
  const double down = std::sqrt(std::max(0.0, sinks * sinks + 2.0 * gravity * height));
  passage.fall_time = (down - sinks) / gravity;
  passage.reach = ahead * passage.fall_time;
  passage.start.x = leaves.x + passage.reach;
  passage.landing = stands ? Landing{kStopped, Angle::from_radians(kRightAngle)}
                           : Landing{math::hypot(ahead, down), Angle::from_radians(math::atan2(down, ahead))};
  return passage;
}

}  // namespace

HoodPassage pass_hood(const HoodShape& hood, const Landing& feed, const Body& body, double gravity) {
  HoodPassage passage = passage_of(hood, feed, body, gravity);
  passage.least_contact = least_contact(passage.motion, hood.radius);
  return passage;
}

Landing HoodApproach::landing(const Body& body) const {
  return passage_of(hood_, feed_, body, gravity_).landing;
}

bool HoodApproach::falls_away(const Body& body) const {
  return passage_of(hood_, feed_, body, gravity_).motion.lift_off().has_value();
}

}  // namespace glissade
