#include "glissade/trades/chute/stream.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

namespace glissade {
namespace {

double deepest_at(const BulkStream& stream, double s) {
  const double wide = stream.width(s);
  return std::min(wide, stream.shape().wall_height.value_or(wide));
}

/// The fullest place: with one width it is the deepest, otherwise it is looked for between the stations of the
/// motion and the places where the width changes.
ValueAt fullest(const Motion& motion, const BulkStream& stream, const ValueAt& deepest) {
  if (stream.shape().width.is_constant()) {
    return {deepest.value / deepest_at(stream, deepest.arc_length), deepest.arc_length};
  }
  const auto filling = [&](double s) { return stream.depth(s, motion.at(s).speed) / deepest_at(stream, s); };
  ValueAt most{filling(0.0), 0.0};
  const auto see = [&](double s) {
    const double value = filling(s);
    if (value > most.value) most = {value, s};
  };
  constexpr int kPlaces = 400;
  const double end = motion.distance();
  for (int i = 1; i <= kPlaces; ++i) see(end * i / kPlaces);
  for (const WidthAt& width : stream.shape().width.knots()) {
    if (width.at > 0.0 && width.at < end) see(width.at);
  }
  // Golden section about the best of them.
  const double step = end / kPlaces;
  double low = std::max(0.0, most.arc_length - step);
  double high = std::min(end, most.arc_length + step);
  constexpr double kGolden = 0.6180339887498949;
  for (int i = 0; i < 60; ++i) {
    const double left = high - kGolden * (high - low);
    const double right = low + kGolden * (high - low);
    if (filling(left) >= filling(right)) {
      high = right;
    } else {
      low = left;
    }
  }
  see(0.5 * (low + high));
  return most;
}

// Of the depth that chokes a stream: beyond, it has choked and not come to a stand.
constexpr double kAsDeep = 1.0 - 1e-9;

std::optional<Choke> choke_of(const Motion& motion, const BulkStream& stream) {
  const auto& end = motion.law_end();
  if (!end || end->what != "burden_depth_m") return {};
  const double wide = stream.width(end->arc_length);
  const double bound = deepest_at(stream, end->arc_length);
  if (!(end->value >= kAsDeep * bound)) return {};
  return Choke{end->arc_length, end->speed, end->value, bound, bound < wide};
}

std::optional<Stall> stall_of(const Motion& motion, const BulkStream& stream) {
  const auto& end = motion.law_end();
  if (!end || choke_of(motion, stream)) return {};
  const double rubs = motion.quantity(BulkStream::kEquivalentFriction, end->arc_length);
  const double missing = math::atan(rubs) - motion.centerline().slope_angle(end->arc_length);
  return Stall{end->arc_length, Angle::from_radians(std::max(0.0, missing))};
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
  facts.stall = stall_of(motion, *stream);
  if (facts.choke) facts.filling = {1.0, facts.choke->arc_length};
  return facts;
}

StreamState stream_state(const Motion& motion, double s) {
  const BulkStream* const stream = &required_stream(motion.body());
  const MotionState at = motion.at(s);
  const StreamShape& shape = stream->shape();
  const double width = stream->width(s);
  StreamState state;
  state.depth = stream->depth(s, at.speed);
  state.equivalent_friction = motion.quantity(BulkStream::kEquivalentFriction, s);
  const double factor = stream->resistance(s, at.speed * at.speed).factor;
  const double wall_friction = state.equivalent_friction / factor;
  state.floor_pressure = shape.bulk_density * state.depth * at.normal_load;
  const double rubbing = shape.mass_flow * wall_friction * at.normal_load / width;
  state.floor_wear = shape.slip_ratio * rubbing;
  state.wall_wear = 0.5 * shape.lateral_pressure_ratio * rubbing;
  return state;
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
