// What moves: from the design's body to Motion's, and what is to be said of its law.

#include "pipeline/body.hpp"

#include "glissade/core/number_text.hpp"
#include "glissade/motion/laws/rider.hpp"
#include "glissade/motion/laws/rolling_ball.hpp"
#include "glissade/pipeline/solve.hpp"

#include "pipeline/located.hpp"

#include <cmath>
#include <memory>

namespace glissade {

using namespace pipeline;

namespace {

LawPtr law_of(const BodyDesign& design) {
  if (design.rolling) {
    BallShape shape;
    shape.radius = design.rolling->radius;
    shape.groove_half_angle = design.rolling->groove_half_angle;
    shape.centre_height = design.centre_height;
    shape.grip = design.rolling->grip;
    return std::make_shared<const RollingBall>(shape);
  }
  const double height = design.centre_height.value_or(0.0);
  return height == 0.0 ? nullptr : std::make_shared<const Rider>(height);
}

}  // namespace

Body body_of(const Design& design) {
  const BodyDesign& from = design.body;
  Body body;
  body.friction = from.friction;
  body.entry_speed = from.entry_speed;
  body.drag_per_metre = from.drag_per_metre;
  body.head_wind = from.head_wind;
  for (const FrictionFrom& change : from.friction_changes) {
    if (change.from > 0.0) body.friction_changes.push_back({change.from, change.friction});
  }
  body.law = at_place(design.where("body"), [&] { return law_of(from); });
  return body;
}

std::string pipeline::friction_text(const Body& body, const Stall& stall) {
  Friction friction = body.friction;
  for (const FrictionChange& change : body.friction_changes) {
    if (change.from <= stall.arc_length) friction = change.friction;
  }
  const bool rolls = body.law && body.law->kind() == "rolling";
  return (rolls ? "the angle of rolling resistance, " : "the friction angle, ") +
         angle_text(friction.angle().radians());
}

Issue pipeline::law_end_problem(const Design& design, const LawEnd& end, double length) {
  const std::string before =
      " after " + length_text(end.arc_length) + ", before the finish at " + length_text(length);
  if (end.what == "valley_radius_m") {
    return {design.where("centerline"), "the body does not fit into the valley" + before,
            "The track bends upwards there with a radius of " + length_text(end.value) +
                "; the centre of mass runs " + length_text(end.bound) + " above the track.",
            "a valley with a larger radius, or a smaller body"};
  }
  return {design.where("body"), std::string(end.what) + " reaches its bound" + before,
          "It is " + rounded_text(end.value, 4) + " there; the bound is " + rounded_text(end.bound, 4) + ".",
          ""};
}

std::optional<Issue> law_problem(const Design& design, const Track& track) {
  const std::vector<LawQuantity> quantities = track.motion.quantities();
  for (std::size_t i = 0; i < quantities.size(); ++i) {
    if (!quantities[i].highest || quantities[i].ends_ride) continue;
    const QuantityPeak peak = track.motion.highest(i);
    if (!peak.beyond_from) continue;
    const std::string most =
        std::isinf(peak.value) ? "no friction is enough there" : "it needs " + rounded_text(peak.value, 3);
    return Issue{design.where("body"),
                 "the ball slips, from " + length_text(*peak.beyond_from) + " down the track on",
                 "Rolling needs more friction than the " + rounded_text(*quantities[i].highest, 3) +
                     " there is: " + most + " " + length_text(peak.arc_length) +
                     " down the track. The ride is that of a ball that rolls all the way.",
                 "a track less steep (limits: slope_angle), or a ball and a track that grip better"};
  }
  return {};
}

}  // namespace glissade
