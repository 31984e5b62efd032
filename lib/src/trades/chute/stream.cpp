#include "glissade/trades/chute/stream.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

namespace glissade {
namespace {

/// The fullest place: with one width it is the deepest.
ValueAt fullest(const Motion& motion, const BulkStream& stream, const ValueAt& deepest) {
  if (stream.shape().width.is_constant())
    return {deepest.value / stream.deepest(deepest.arc_length), deepest.arc_length};
  // Of depth over width and over the wall, each of which is smooth, the greater.
  const auto depth = [&](const LawState& state) {
    return stream.depth(state.arc_length, std::sqrt(state.v));
  };
  QuantityPeak most =
      motion.highest([&](const LawState& state) { return depth(state) / stream.width(state.arc_length); });
  if (const auto& wall = stream.shape().wall_height) {
    const QuantityPeak high = motion.highest([&](const LawState& state) { return depth(state) / *wall; });
    if (high.value > most.value) most = high;
  }
  return {most.value, most.arc_length};
}

std::optional<Choke> choke_of(const Motion& motion, const BulkStream& stream) {
  const auto& end = motion.law_end();
  if (!end || end->what != "burden_depth_m") return {};
  const double bound = stream.deepest(end->arc_length);
  return Choke{end->arc_length, end->speed, end->value, bound, bound < stream.width(end->arc_length)};
}

/// @throws InputError if the body is no stream
const BulkStream& required_stream(const Body& body) {
  const BulkStream* const stream = stream_of(body);
  if (stream != nullptr) return *stream;
  throw InputError({"", "the body is no stream", "Only what flows has a depth and a mass flow.",
                    "a body whose law is BulkStream"});
}

Body with_shape(Body body, const StreamShape& shape) {
  body.law = std::make_shared<const BulkStream>(shape);
  return body;
}

}  // namespace

const BulkStream* stream_of(const Body& body) {
  return dynamic_cast<const BulkStream*>(body.law.get());
}

std::optional<StreamFacts> stream_facts(const Motion& motion) {
  const BulkStream* const stream = stream_of(motion.body());
  if (stream == nullptr) return {};
  StreamFacts facts;
  const QuantityPeak depth = motion.highest(BulkStream::kDepth);
  facts.deepest = {depth.value, depth.arc_length};
  const QuantityPeak friction = motion.highest(BulkStream::kEquivalentFriction);
  facts.equivalent_friction = {friction.value, friction.arc_length};
  if (motion.arrived()) facts.exit_depth = motion.quantity(BulkStream::kDepth, motion.distance());
  facts.filling = fullest(motion, *stream, facts.deepest);
  facts.choke = choke_of(motion, *stream);
  if (facts.choke) facts.filling = {1.0, facts.choke->arc_length};
  return facts;
}

StreamState stream_state(const BulkStream& stream, const LawState& at) {
  const StreamShape& shape = stream.shape();
  const double s = at.arc_length;
  StreamState state;
  state.depth = stream.depth(s, std::sqrt(at.v));
  state.equivalent_friction = at.friction * stream.resistance(s, at.v).factor;
  state.floor_pressure = shape.bulk_density * state.depth * at.normal_load;
  const double rubbing = shape.mass_flow * at.friction * at.normal_load / stream.width(s);
  state.floor_wear = shape.slip_ratio * rubbing;
  state.wall_wear = 0.5 * shape.lateral_pressure_ratio * rubbing;
  state.pressed = shape.slip_ratio * shape.mass_flow * at.normal_load / stream.width(s);
  return state;
}

StreamState stream_state(const Motion& motion, double s) {
  return stream_state(required_stream(motion.body()), motion.law_state(s));
}

ValueAt stream_peak(const Motion& motion, double StreamState::*member) {
  const BulkStream& stream = required_stream(motion.body());
  const QuantityPeak peak =
      motion.highest([&](const LawState& state) { return stream_state(stream, state).*member; });
  return {peak.value, peak.arc_length};
}

double mean_floor_wear(const Motion& motion) {
  const BulkStream& stream = required_stream(motion.body());
  return motion.mean([&](const LawState& state) { return stream_state(stream, state).floor_wear; });
}

std::optional<double> choking_mass_flow(const CenterlinePtr& centerline, const Body& body, double gravity) {
  const double own_flow = required_stream(body).shape().mass_flow;
  // A larger flow is deeper at each speed, rubs more and is slower: what chokes once chokes beyond.
  const auto chokes = [&](double factor) {
    return Motion(centerline, with_flow(body, factor), gravity).law_end().has_value();
  };
  constexpr double kMost = 1e3;
  // What stands without any depth is passed by no flow.
  Body point = body;
  point.law = nullptr;
  point.landing = landing_of(body);
  point.approach = nullptr;
  if (!Motion(centerline, point, gravity).arrived()) return 0.0;
  double clear = 0.0;
  double choked = 1.0;
  while (!chokes(choked)) {
    if (choked >= kMost) return {};
    clear = choked;
    choked *= 2.0;
  }
  while (choked - clear > kChokingFlowAccuracy * choked) {
    const double tried = 0.5 * (clear + choked);
    (chokes(tried) ? choked : clear) = tried;
  }
  return clear * own_flow;
}

Body with_flow(Body body, double factor) {
  StreamShape shape = required_stream(body).shape();
  shape.mass_flow *= factor;
  return with_shape(std::move(body), shape);
}

Body with_density(Body body, double density) {
  StreamShape shape = required_stream(body).shape();
  shape.bulk_density = density;
  return with_shape(std::move(body), shape);
}

}  // namespace glissade
