// Laws of motion beside the sliding point: each against closed forms, against Newton's second law by an
// integrator that shares no code with Motion, and against the identities that its header states.

#include "glissade/centerline/cycloid.hpp"
#include "glissade/core/error.hpp"
#include "glissade/motion/laws/bulk_stream.hpp"
#include "glissade/motion/laws/rider.hpp"
#include "glissade/motion/laws/rolling_ball.hpp"
#include "glissade/motion/motion.hpp"

#include "support/catch.hpp"
#include "tracks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include <boost/numeric/odeint.hpp>

namespace laws_test {

using namespace glissade;
using testing::track;

namespace {

constexpr double kGravity = kDefaultGravity;
constexpr double kDegree = 3.14159265358979323846 / 180.0;
/// What two routes to one number agree to.
constexpr double kAgreement = 1e-9;

LawPtr ball(double radius, double groove_half_angle_deg = 90.0, std::optional<double> centre_height = {},
            std::optional<double> grip = {}) {
  BallShape shape;
  shape.radius = radius;
  shape.groove_half_angle = Angle::from_degrees(groove_half_angle_deg);
  shape.centre_height = centre_height;
  if (grip) shape.grip = Friction::from_coefficient(*grip);
  return std::make_shared<const RollingBall>(shape);
}

std::shared_ptr<const BulkStream> stream(double mass_flow, double density, double width,
                                         std::optional<double> wall_height = {}) {
  return std::make_shared<const BulkStream>(StreamShape{mass_flow, density, 0.5, width, wall_height});
}

Body body(double mu, double entry_speed, LawPtr law, double drag = 0.0) {
  Body body;
  body.friction = Friction::from_coefficient(mu);
  body.entry_speed = entry_speed;
  body.drag_per_metre = drag;
  body.law = std::move(law);
  return body;
}

double friction_at(const Body& body, double s) {
  double mu = body.friction.coefficient();
  for (const FrictionChange& change : body.friction_changes) {
    if (s >= change.from) mu = change.friction.coefficient();
  }
  return mu;
}

double centre_drop(const Centerline& track, const Body& body, double s) {
  const double height = body.law ? body.law->centre_height() : 0.0;
  const CenterlinePoint point = track.at(s);
  return point.drop - height * (std::cos(point.slope_angle) - std::cos(track.slope_angle(0.0)));
}

/// Newton's second law for the centre of mass, speed and time along the track, by Bulirsch and Stoer's
/// extrapolation of the law as the theory states it.
class NewtonAlongTrack {
 public:
  using State = std::array<double, 2>;

  NewtonAlongTrack(const Centerline& track, const Body& body)
      : track_(&track), body_(&body), state_{body.entry_speed, 0.0} {}

  /// Onwards to the arc length s; nothing may jump before it.
  void advance(double s) {
    namespace odeint = boost::numeric::odeint;
    const auto newton = [&](const State& state, State& change, double at) {
      change = rate(state[0], std::min(at, std::nextafter(s, 0.0)));
    };
    odeint::integrate_adaptive(odeint::bulirsch_stoer<State>(1e-16, 1e-14), newton, state_, s_, s,
                               1e-3 * (s - s_));
    s_ = s;
  }

  [[nodiscard]] double speed() const { return state_[0]; }
  [[nodiscard]] double time() const { return state_[1]; }

 private:
  /// @return du/ds and dt/ds
  [[nodiscard]] State rate(double u, double s) const {
    const CenterlinePoint point = track_->at(s);
    const double height = body_->law ? body_->law->centre_height() : 0.0;
    const double inertia = body_->law ? body_->law->inertia() : 1.0;
    const double radius_share = 1.0 - point.curvature * height;
    const double load = kGravity * std::cos(point.slope_angle) + point.curvature / radius_share * u * u;
    double c = friction_at(*body_, s);
    if (const auto* flow = dynamic_cast<const BulkStream*>(body_->law.get())) {
      c *= 1.0 + flow->shape().lateral_pressure_ratio * flow->depth(s, u) / flow->width(s);
    }
    const double air = u + body_->head_wind;
    const double acceleration =
        (kGravity * std::sin(point.slope_angle) - c * load - body_->drag_per_metre * air * std::fabs(air)) /
        inertia;
    const double pace = radius_share / u;
    return {acceleration * pace, pace};
  }

  const Centerline* track_;
  const Body* body_;
  State state_;
  double s_ = 0.0;
};

/// A law of any kind that suits a track of about this size.
Body random_body(testing::Random& random, double length) {
  Body body;
  body.friction = Friction::from_coefficient(random.between(0.0, 0.3));
  body.entry_speed = std::sqrt(kGravity * length) * random.between(0.1, 1.0);
  body.drag_per_metre = random.integer(0, 1) == 0 ? 0.0 : random.between(0.0, 0.3) / length;
  switch (random.integer(0, 3)) {
    case 0:
      body.law = ball(random.between(0.001, 0.1) * length, random.between(30.0, 90.0));
      break;
    case 1:
      body.law = std::make_shared<const Rider>(random.between(0.001, 0.1) * length);
      break;
    case 2: {
      const double width = 0.1 * length;
      StreamShape shape;
      shape.bulk_density = 1000.0;
      shape.mass_flow = random.between(0.01, 0.5) * width * width * body.entry_speed * shape.bulk_density;
      shape.width = width;
      if (random.integer(0, 1) == 0) shape.width = WidthLaw({{0.0, width}, {0.7 * length, 0.8 * width}});
      body.law = std::make_shared<const BulkStream>(shape);
      break;
    }
    default:
      break;
  }
  if (random.integer(0, 2) == 0) body.head_wind = random.between(-0.5, 0.5) * std::sqrt(kGravity * length);
  if (random.integer(0, 2) == 0) {
    body.friction_changes.push_back({0.3 * length, Friction::from_coefficient(random.between(0.0, 0.3))});
    body.friction_changes.push_back({0.6 * length, Friction::from_coefficient(random.between(0.0, 0.3))});
  }
  return body;
}

std::vector<double> places_where_something_jumps(const Centerline& track, const Body& body) {
  std::vector<double> places = track.breaks();
  for (const FrictionChange& change : body.friction_changes) places.push_back(change.from);
  if (body.law) {
    for (const double s : body.law->breaks()) places.push_back(s);
  }
  std::sort(places.begin(), places.end());
  return places;
}

/// The exit speed squared of c N on an arc of radius R from slope angle a to b, for inertia f and a centre h
/// above it: dv/dzeta = (2 c/f) v - (2 g (R - h)/f) (sin(zeta) - c cos(zeta)).
double v_after_arc(double v, double radius, double from, double to, double c, double f, double h) {
  const double m = 2.0 * c / f;
  const double a = 2.0 * kGravity * (radius - h) / f;
  const double p = a * (c + m) / (1.0 + m * m);
  const double q = a - m * p;
  const double constant = (v - p * std::sin(from) - q * std::cos(from)) * std::exp(-m * from);
  return constant * std::exp(m * to) + p * std::sin(to) + q * std::cos(to);
}

}  // namespace

TEST_CASE("laws: Motion agrees with Newton's law for every law, wind and friction by place") {
  auto random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  int compared = 0;
  int of_streams = 0;
  for (int i = 0; i < 200; ++i) {
    const auto smooth = testing::random_rough_track(random);
    const Body body = random_body(random, smooth->length());
    const Motion motion(smooth, body);
    // Near a stop, and where a valley grows too tight, the integrator's own error grows without bound.
    const double until = motion.stall() || motion.law_end() ? 0.9 * motion.distance() : motion.distance();
    NewtonAlongTrack newton(*smooth, body);
    double s = 0.0;
    for (const double next : places_where_something_jumps(*smooth, body)) {
      const double end = std::min(next, until);
      if (!(end > s)) continue;
      newton.advance(end);
      s = end;
      const MotionState state = motion.at(s);
      CAPTURE(i, s, motion.distance(), smooth->length());
      CHECK(state.time == Approx(newton.time()).epsilon(kAgreement));
      CHECK(state.speed == Approx(newton.speed()).epsilon(kAgreement));
      ++compared;
      if (body.law && body.law->depends_on_speed()) ++of_streams;
    }
  }
  CHECK(compared > 200);
  CHECK(of_streams > 30);
}

TEST_CASE("laws: f u^2/2 and the losses make up what the drop of the centre of mass gives") {
  auto random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (int i = 0; i < 300; ++i) {
    const auto rough = testing::random_rough_track(random);
    Body body = random_body(random, rough->length());
    if (i % 2 == 0 && !(body.law && body.law->depends_on_speed())) body.entry_speed = 0.0;
    const double f = body.law ? body.law->inertia() : 1.0;
    const Motion motion(rough, body);
    for (int part = 0; part <= 7; ++part) {
      const double s = part == 7 ? motion.distance() : motion.distance() * part / 7.0;
      const MotionState state = motion.at(s);
      const double entry = 0.5 * f * body.entry_speed * body.entry_speed;
      const double given = kGravity * centre_drop(*rough, body, s) + entry;
      const double found = 0.5 * f * state.speed * state.speed + state.friction_loss + state.drag_loss;
      CAPTURE(i, s, motion.distance());
      CHECK(std::fabs(found - given) <= 1e-11 * (kGravity * rough->length() + entry));
    }
  }
}

TEST_CASE(
    "rolling: a frictionless ball takes sqrt(f) times as long as a sliding point on its centre's path") {
  for (const double groove : {90.0, 60.0, 45.0, 20.0}) {
    const double f = 1.0 + 0.4 / std::pow(std::sin(groove * kDegree), 2);
    constexpr double kHeight = 0.02;
    constexpr double kRadius = 0.5;
    const double turn = 60.0 * kDegree;
    const Motion rolling(track(turn, {{kRadius * turn, 1.0 / kRadius, 1.0 / kRadius}}),
                         body(0.0, 0.0, ball(0.02, groove, kHeight)));
    const double inner = kRadius - kHeight;
    const Motion sliding(track(turn, {{inner * turn, 1.0 / inner, 1.0 / inner}}), body(0.0, 0.0, nullptr));
    REQUIRE(rolling.arrived());
    CHECK(rolling.travel_time() == Approx(std::sqrt(f) * sliding.travel_time()).epsilon(1e-13));
    CHECK(rolling.exit_speed() == Approx(sliding.exit_speed() / std::sqrt(f)).epsilon(1e-13));
  }
}

TEST_CASE("rolling: on a straight the ball accelerates by (g/f) (sin - c cos)") {
  for (const double c : {0.0, 0.01, 0.2}) {
    const double angle = 25.0 * kDegree;
    const Motion motion(track(angle, {{3.0, 0.0, 0.0}}), body(c, 0.0, ball(0.01)));
    const double acceleration = kGravity / 1.4 * (std::sin(angle) - c * std::cos(angle));
    CHECK(motion.travel_time() == Approx(std::sqrt(6.0 / acceleration)).epsilon(1e-13));
    CHECK(motion.exit_speed() == Approx(std::sqrt(6.0 * acceleration)).epsilon(1e-13));
  }
}

TEST_CASE("rolling: on an arc the ball keeps Roberts' formula with its inertia and its centre's radius") {
  for (const double height : {0.01, 0.2}) {
    for (const double c : {0.02, 0.4}) {
      constexpr double kRadius = 3.0;
      constexpr double kEntry = 2.0;
      const double from = 80.0 * kDegree;
      const double to = 10.0 * kDegree;
      const Motion motion(track(from, {{kRadius * (from - to), 1.0 / kRadius, 1.0 / kRadius}}),
                          body(c, kEntry, ball(0.01, 50.0, height)));
      const double f = 1.0 + 0.4 / std::pow(std::sin(50.0 * kDegree), 2);
      REQUIRE(motion.arrived());
      CHECK(std::pow(motion.exit_speed(), 2) ==
            Approx(v_after_arc(kEntry * kEntry, kRadius, from, to, c, f, height)).epsilon(1e-12));
    }
  }
}

TEST_CASE("rolling: the friction that rolling needs on a straight, and where a ball slips") {
  // From rest on a straight, without resistance: F = (f - 1)/f g sin, pressed by g cos/sin(groove half angle).
  const double angle = 40.0 * kDegree;
  for (const double groove : {90.0, 45.0}) {
    const double spread = std::sin(groove * kDegree);
    const double f = 1.0 + 0.4 / (spread * spread);
    const double needed = (f - 1.0) / f * std::tan(angle) * spread;
    const auto straight = track(angle, {{2.0, 0.0, 0.0}});
    const Motion held(straight, body(0.0, 0.0, ball(0.01, groove, {}, 1.001 * needed)));
    CHECK(held.quantities().front().key == "friction_needed");
    CHECK(held.quantity(0, 1.0) == Approx(needed).epsilon(1e-13));
    CHECK(held.highest(0).value == Approx(needed).epsilon(1e-13));
    CHECK_FALSE(held.highest(0).beyond_from);
    const Motion slipping(straight, body(0.0, 0.0, ball(0.01, groove, {}, 0.999 * needed)));
    CHECK(slipping.highest(0).beyond_from == 0.0);
    CHECK(slipping.arrived());
  }
  // Straight, then ever steeper: it slips from where 2/7 tan reaches the grip, if the crest's load allows for.
  const auto crest = track(10.0 * kDegree, {{1.0, 0.0, 0.0}, {20.0, -1.0 / 1000.0, -1.0 / 20.0}});
  const Motion over(crest, body(0.0, 0.0, ball(0.01, 90.0, {}, 0.2)));
  const QuantityPeak peak = over.highest(0);
  REQUIRE(peak.beyond_from);
  CHECK(over.quantity(0, *peak.beyond_from) == Approx(0.2).epsilon(1e-9));
  CHECK(over.quantity(0, *peak.beyond_from - 0.01) < 0.2);
}

TEST_CASE("rolling: a vertical start needs friction without bound") {
  const auto cycloid = std::make_shared<const testing::Cycloid>(1.0, 2.0);
  // Its curvature grows without bound, so that no ball fits in.
  const Motion none(cycloid, body(0.0, 0.0, ball(0.01)));
  REQUIRE(none.law_end());
  CHECK(none.law_end()->what == "valley_radius_m");
  CHECK(none.law_end()->arc_length == 0.0);
  const Motion vertical(track(90.0 * kDegree, {{1.0, 0.0, 0.0}, {1.0, 0.5, 0.5}}),
                        body(0.0, 0.0, ball(0.01)));
  CHECK(vertical.highest(0).value > 1e9);
}

TEST_CASE("a valley tighter than the body's centre of mass is high ends its ride there") {
  // At a jump of curvature.
  const Motion jump(track(0.8, {{1.0, 0.0, 0.0}, {0.01, 1.0 / 0.05, 1.0 / 0.05}, {1.0, 0.0, 0.0}}),
                    body(0.05, 0.0, ball(0.06)));
  REQUIRE(jump.law_end());
  CHECK_FALSE(jump.arrived());
  CHECK(jump.distance() == 1.0);
  CHECK(jump.law_end()->value == Approx(0.05));
  CHECK(jump.law_end()->bound == 0.06);
  CHECK(jump.exit_speed() > 0.0);
  // Where curvature grows into it: 1/h is reached at 0.6 of the way.
  const Motion growing(track(0.8, {{0.1, 0.0, 10.0}}),
                       body(0.05, 1.0, std::make_shared<const Rider>(1.0 / 6.0)));
  REQUIRE(growing.law_end());
  CHECK(growing.distance() == Approx(0.06).epsilon(1e-5));
  // A larger radius is passed.
  CHECK(Motion(track(0.8, {{1.0, 0.0, 0.0}, {0.01, 1.0 / 0.07, 1.0 / 0.07}}), body(0.05, 0.0, ball(0.06)))
            .arrived());
}

TEST_CASE("on a piece that ends in a valley too tight, a crest before it ends the ride") {
  // One clothoid from the crest to the valley: only its end is too tight.
  const std::vector<ClothoidSegment> segments{
      {0.3, 0.0, 0.1}, {0.3, 0.0, -0.1}, {0.2, 0.0, 0.0}, {0.2, 0.1, 0.0}, {0.24, -28.0, 28.0}};
  const Motion motion(track(0.8, segments), body(0.05, 0.0, ball(0.04)));
  REQUIRE(motion.lift_off());
  CHECK_FALSE(motion.law_end());
  CHECK(motion.distance() == Approx(1.0).epsilon(1e-12));
  const Motion before(track(0.8, {segments.begin(), segments.end() - 1}), body(0.05, 0.0, ball(0.04)));
  CHECK(motion.lift_off()->speed == Approx(before.exit_speed()).epsilon(1e-12));
  // One that a held body passes, pressing upwards on the crest, ends in the valley.
  Body held = body(0.05, 0.0, ball(0.04));
  held.held = true;
  const Motion passes(track(0.8, segments), held);
  CHECK_FALSE(passes.lift_off());
  REQUIRE(passes.law_end());
  CHECK(passes.distance() > 1.2);
}

TEST_CASE("rider: a centre of mass above a level take-off is lower there than at the steep start") {
  // In-run of 35 deg to 10 deg: without friction, energy alone gives the speed of the centre.
  constexpr double kHeight = 0.6;
  const double from = 35.0 * kDegree;
  const double to = 10.0 * kDegree;
  const auto in_run = track(from, {{60.0, 0.0, 0.0}, {100.0 * (from - to), 0.01, 0.01}, {6.0, 0.0, 0.0}});
  const Motion point(in_run, body(0.0, 0.0, nullptr));
  const Motion rider(in_run, body(0.0, 0.0, std::make_shared<const Rider>(kHeight)));
  const double lift = kHeight * (std::cos(to) - std::cos(from));
  CHECK(std::pow(rider.exit_speed(), 2) ==
        Approx(std::pow(point.exit_speed(), 2) - 2.0 * kGravity * lift).epsilon(1e-13));
  // Pressed by the centre's own circle, of radius R - h.
  const double s = 61.0;
  const MotionState state = rider.at(s);
  CHECK(state.normal_load ==
        Approx(kGravity * std::cos(in_run->slope_angle(s)) + state.speed * state.speed / (100.0 - kHeight))
            .epsilon(1e-13));
}

TEST_CASE("friction by place: two straights of one slope, one after the other") {
  const double angle = 20.0 * kDegree;
  Body sledge = body(0.05, 3.0, nullptr);
  sledge.friction_changes = {{4.0, Friction::from_coefficient(0.3)}};
  const Motion motion(track(angle, {{10.0, 0.0, 0.0}}), sledge);
  const auto gain = [&](double mu, double way) {
    return 2.0 * kGravity * (std::sin(angle) - mu * std::cos(angle)) * way;
  };
  CHECK(std::pow(motion.at(4.0).speed, 2) == Approx(9.0 + gain(0.05, 4.0)).epsilon(1e-13));
  CHECK(std::pow(motion.exit_speed(), 2) == Approx(9.0 + gain(0.05, 4.0) + gain(0.3, 6.0)).epsilon(1e-13));
  CHECK(motion.at(10.0).friction_loss ==
        Approx(kGravity * std::cos(angle) * (0.05 * 4.0 + 0.3 * 6.0)).epsilon(1e-13));
  // A change that is none, at the start or beyond the finish.
  for (const double from : {0.0, 4.0, 10.0, 40.0}) {
    Body same = body(0.05, 3.0, nullptr);
    same.friction_changes = {{from, same.friction}};
    CHECK(Motion(track(angle, {{10.0, 0.0, 0.0}}), same).exit_speed() ==
          Approx(Motion(track(angle, {{10.0, 0.0, 0.0}}), body(0.05, 3.0, nullptr)).exit_speed())
              .epsilon(1e-15));
  }
  // It stalls where the new friction holds, and tells the slope that is missing there.
  Body rough = body(0.05, 3.0, nullptr);
  rough.friction_changes = {{4.0, Friction::from_coefficient(2.0)}};
  const Motion stalled(track(angle, {{10.0, 0.0, 0.0}}), rough);
  REQUIRE(stalled.stall());
  CHECK(stalled.stall()->missing_slope.radians() == Approx(std::atan(2.0) - angle).epsilon(1e-12));
  CHECK(stalled.distance() == Approx(4.0 - (9.0 + gain(0.05, 4.0)) / gain(2.0, 1.0)).epsilon(1e-12));
}

TEST_CASE("wind: a level track slows a body by k (u + w)^2; a gale from behind starts it") {
  // du/dt = -k (u + w)^2: 1/(u + w) grows by k t; s = ln(...)/k - w t.
  constexpr double kDrag = 0.02;
  constexpr double kWind = 4.0;
  Body sledge = body(0.0, 10.0, nullptr, kDrag);
  sledge.head_wind = kWind;
  const Motion motion(track(0.0, {{20.0, 0.0, 0.0}}), sledge);
  REQUIRE(motion.arrived());
  const double t = motion.travel_time();
  const double air = 1.0 / (1.0 / (10.0 + kWind) + kDrag * t);
  CHECK(motion.exit_speed() == Approx(air - kWind).epsilon(1e-12));
  CHECK(std::log(1.0 + kDrag * t * (10.0 + kWind)) / kDrag - kWind * t == Approx(20.0).epsilon(1e-12));
  Body sail = body(0.0, 0.0, nullptr, kDrag);
  sail.head_wind = -10.0;
  // u = w - 1/(1/w + k t)
  const Motion sailing(track(0.0, {{20.0, 0.0, 0.0}}), sail);
  REQUIRE(sailing.arrived());
  CHECK(sailing.exit_speed() == Approx(10.0 - 1.0 / (0.1 + kDrag * sailing.travel_time())).epsilon(1e-11));
}

TEST_CASE("stream: Roberts' worked examples with friction that grows with the depth") {
  // Facts on chutes, vectors C and D; all of their digits.
  struct Example {
    double mu, mass_flow, density, width, entry, slope_deg, exit_slope_deg, length, speed, time;
  };
  const double arc2 = 2.0 * 40.0 * kDegree;
  const double arc3 = 3.0 * 55.0 * kDegree;
  const std::vector<Example> examples = {
      {0.25, 20.0, 770.0, 0.3, 0.5, 35.0, 35.0, 4.0, 5.327886, 1.390415},
      {0.5, 277.78, 1000.0, 1.0, 1.0, 45.0, 45.0, 5.0, 5.853409, 1.475125},
      {0.25, 20.0, 770.0, 0.3, 1.0, 70.0, 30.0, arc2, 3.704754, 0.521927},
      {0.5, 277.78, 1000.0, 1.0, 4.0, 90.0, 35.0, arc3, 5.090361, 0.571912},
  };
  for (const Example& e : examples) {
    const double curvature = (e.slope_deg - e.exit_slope_deg) * kDegree / e.length;
    const auto law = stream(e.mass_flow, e.density, e.width);
    const Motion motion(track(e.slope_deg * kDegree, {{e.length, curvature, curvature}}),
                        body(e.mu, e.entry, law));
    REQUIRE(motion.arrived());
    CHECK(motion.exit_speed() == Approx(e.speed).margin(1.1e-6));
    CHECK(motion.travel_time() == Approx(e.time).margin(1.1e-6));
    CHECK(motion.quantity(0, e.length) ==
          Approx(e.mass_flow / (e.density * e.width * motion.exit_speed())).epsilon(1e-14));
    CHECK(motion.quantity(1, e.length) ==
          Approx(e.mu * (1.0 + 0.5 * motion.quantity(0, e.length) / e.width)).epsilon(1e-14));
    // It only grows thinner where it only speeds up.
    if (curvature == 0.0) CHECK(motion.highest(0).arc_length == 0.0);
  }
}

TEST_CASE("stream: without lateral pressure it is the sliding point") {
  const auto valley = track(1.2, {{2.0, 0.0, 0.3}, {2.0, 0.3, 0.1}});
  StreamShape shape{20.0, 770.0, 0.0, 0.3, {}};
  const Motion flowing(valley, body(0.3, 1.0, std::make_shared<const BulkStream>(shape)));
  const Motion sliding(valley, body(0.3, 1.0, nullptr));
  CHECK(flowing.travel_time() == Approx(sliding.travel_time()).epsilon(1e-13));
  CHECK(flowing.exit_speed() == Approx(sliding.exit_speed()).epsilon(1e-13));
}

TEST_CASE("stream: it chokes where it grows as deep as its wall or its chute is wide") {
  const auto flat = track(40.0 * kDegree, {{1.0, 0.0, 0.0}, {2.0, 0.3, 0.3}, {5.0, 0.0, 0.0}});
  for (const std::optional<double> wall : {std::optional(0.08), std::optional<double>()}) {
    const auto law = stream(20.0, 770.0, 0.3, wall);
    const Motion motion(flat, body(0.5, 2.0, law));
    REQUIRE(motion.law_end());
    CHECK_FALSE(motion.arrived());
    CHECK_FALSE(motion.stall());
    CHECK(motion.law_end()->what == "burden_depth_m");
    CHECK(motion.law_end()->value == Approx(wall.value_or(0.3)).epsilon(1e-11));
    CHECK(motion.law_end()->bound == Approx(wall.value_or(0.3)).epsilon(1e-14));
    CHECK(motion.law_end()->speed == Approx(20.0 / (770.0 * 0.3 * wall.value_or(0.3))).epsilon(1e-11));
    CHECK(motion.highest(0).arc_length == motion.distance());
  }
  // Fed slower than the chute can take it.
  const Motion at_once(flat, body(0.5, 0.2, stream(20.0, 770.0, 0.3)));
  REQUIRE(at_once.law_end());
  CHECK(at_once.distance() == 0.0);
  CHECK(at_once.law_end()->value == Approx(20.0 / (770.0 * 0.3 * 0.2)));
  // A chute that narrows is deeper there.
  StreamShape narrowing{40.0, 770.0, 0.5, WidthLaw({{0.0, 0.3}, {1.0, 0.3}, {2.0, 0.1}}), 0.09};
  const Motion narrowed(track(40.0 * kDegree, {{3.0, 0.0, 0.0}}),
                        body(0.5, 2.0, std::make_shared<const BulkStream>(narrowing)));
  REQUIRE(narrowed.law_end());
  CHECK(narrowed.law_end()->value == Approx(0.09).epsilon(1e-11));
  CHECK(narrowed.distance() > 1.0);
  CHECK(narrowed.distance() < 2.0);
}

TEST_CASE("the greatest of anything along a ride is found on both sides of each jump, and between samples") {
  auto random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (int i = 0; i < 40; ++i) {
    // Bends between straights: the load is greatest where one of them begins, ends, or in between.
    const double radius = random.between(0.4, 2.0);
    const double bend = radius * random.between(0.02, 0.6);
    const double knot = random.between(0.1, 4.0);
    const auto bent =
        track(random.between(70.0, 85.0) * kDegree,
              {{random.between(0.01, 1.0), 0.0, 0.0}, {bend, 1.0 / radius, 1.0 / radius}, {4.0, 0.0, 0.0}});
    StreamShape shape{30.0, 1500.0, 0.5, WidthLaw({{0.0, 0.5}, {knot, 0.4}, {5.0, 0.45}}), {}};
    const auto law = std::make_shared<const BulkStream>(shape);
    Body fed = body(0.3, random.between(1.0, 4.0), law);
    fed.friction_changes = {{random.between(0.1, 4.0), Friction::from_coefficient(0.25)}};
    const Motion motion(bent, fed, kGravity);
    REQUIRE(motion.arrived());
    const auto wear = [&](const LawState& at) {
      return at.friction * at.normal_load / law->width(at.arc_length);
    };
    const std::vector<double> breaks = motion.breaks();
    double most = 0.0;
    double sum = 0.0;
    for (std::size_t k = 1; k < breaks.size(); ++k) {
      // Of the last place before a break the values before it hold; Simpson's rule within.
      const double from = breaks[k - 1];
      const double to = std::nextafter(breaks[k], from);
      constexpr int kSteps = 400;
      for (int j = 0; j <= kSteps; ++j) {
        const double value = wear(motion.law_state(std::min(to, from + (to - from) * j / kSteps)));
        most = std::max(most, value);
        sum += value * (j == 0 || j == kSteps ? 1.0 : j % 2 == 1 ? 4.0 : 2.0) / 3.0 * (to - from) / kSteps;
      }
    }
    const QuantityPeak peak = motion.highest(wear);
    CHECK(peak.value >= most * (1.0 - 1e-9));
    CHECK(peak.value <= most * (1.0 + 1e-5));
    CHECK(motion.mean(wear) == Approx(sum / motion.distance()).epsilon(1e-9));
    const auto load = [](const LawState& at) { return at.normal_load; };
    CHECK(motion.highest(load).value == Approx(motion.highest_load().normal_load).epsilon(1e-12));
  }
}

TEST_CASE("laws: the same ride in other units") {
  auto random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (int i = 0; i < 60; ++i) {
    const auto rough = testing::random_rough_track(random);
    Body given = random_body(random, rough->length());
    given.friction_changes.clear();
    const double length = 3.7;
    const double speed = std::sqrt(length * kGravity);
    std::vector<ClothoidSegment> segments = rough->segments();
    for (ClothoidSegment& segment : segments) {
      segment.length /= length;
      segment.entry_curvature *= length;
      segment.exit_curvature *= length;
    }
    Body scaled = given;
    scaled.entry_speed /= speed;
    scaled.drag_per_metre *= length;
    scaled.head_wind /= speed;
    if (given.law) scaled.law = given.law->in_units(length, speed);
    const Motion here(rough, given);
    const Motion there(track(rough->entry_slope_angle().radians(), segments), scaled, 1.0);
    CAPTURE(i);
    CHECK(here.arrived() == there.arrived());
    CHECK(here.distance() == Approx(there.distance() * length).epsilon(1e-10));
    CHECK(here.exit_speed() == Approx(there.exit_speed() * speed).epsilon(1e-9).margin(1e-12));
  }
}

TEST_CASE("laws: a body that no law can move is refused with its number") {
  const auto ramp = track(0.5, {{1.0, 0.0, 0.0}});
  CHECK_THROWS_WITH(ball(0.0), Catch::Matchers::Contains("radius: 0 m is not a finite number larger than 0"));
  CHECK_THROWS_WITH(ball(0.01, 0.0), Catch::Matchers::Contains("groove_half_angle: 0 deg"));
  CHECK_THROWS_WITH(ball(0.01, 91.0), Catch::Matchers::Contains("groove_half_angle: 91 deg"));
  CHECK_THROWS_WITH(ball(0.01, 90.0, -1.0), Catch::Matchers::Contains("centre_height: -1 m"));
  CHECK_THROWS_WITH(Rider(0.0), Catch::Matchers::Contains("centre_height: 0 m"));
  CHECK_THROWS_WITH(stream(-1.0, 1000.0, 1.0), Catch::Matchers::Contains("mass_flow: -1 kg/s"));
  CHECK_THROWS_WITH(stream(1.0, 0.0, 1.0), Catch::Matchers::Contains("bulk_density: 0 kg/m^3"));
  CHECK_THROWS_WITH(stream(1.0, 1000.0, 0.0), Catch::Matchers::Contains("width: 0 m"));
  CHECK_THROWS_WITH(stream(1.0, 1000.0, 1.0, 0.0), Catch::Matchers::Contains("wall_height: 0 m"));
  CHECK_THROWS_WITH(BulkStream(StreamShape{1.0, 1000.0, -0.1, 1.0, {}}),
                    Catch::Matchers::Contains("lateral_pressure_ratio: -0.1"));
  CHECK_THROWS_WITH(
      BulkStream(StreamShape{1.0, 1000.0, 0.5, WidthLaw({{1.0, 1.0}, {1.0, 2.0}}), {}}),
      Catch::Matchers::Contains("Widths are given in the order of the track; each place has one."));
  CHECK_THROWS_WITH(Motion(ramp, body(0.1, 0.0, stream(1.0, 1000.0, 1.0))),
                    Catch::Matchers::Contains("cannot start from rest"));
  CHECK_THROWS_WITH(
      Motion(std::make_shared<const testing::Cycloid>(1.0, 2.0), body(0.1, 2.0, stream(1.0, 1000.0, 1.0))),
      Catch::Matchers::Contains("unbounded curvature"));
  Body windy = body(0.1, 0.0, nullptr, 0.1);
  windy.head_wind = std::nan("");
  CHECK_THROWS_WITH(Motion(ramp, windy), Catch::Matchers::Contains("head_wind: nan m/s is not finite"));
  Body back = body(0.1, 0.0, nullptr);
  back.friction_changes = {{2.0, {}}, {1.0, {}}};
  CHECK_THROWS_WITH(Motion(ramp, back), Catch::Matchers::Contains("1 m after 2 m"));
  CHECK_THROWS_AS(Motion(ramp, body(0.1, 0.0, nullptr)).quantity(0, 0.5), InputError);
}

TEST_CASE("a centre of mass above a start that bends too tightly: the load has no bound, and is a number") {
  const auto cycloid = std::make_shared<const Cycloid>(Endpoints{7.0, 5.0});
  const auto arc = track(0.5, {{2.0, 4.0, 4.0}});  // of 0.25 m
  for (const CenterlinePtr& tight : std::vector<CenterlinePtr>{cycloid, arc}) {
    const Motion ride(tight, body(0.1, 1.0, std::make_shared<const Rider>(0.4)));
    REQUIRE(ride.law_end());
    CHECK(ride.law_end()->what == "valley_radius_m");
    CHECK(ride.distance() == 0.0);
    CHECK(ride.highest_load().normal_load == std::numeric_limits<double>::infinity());
    CHECK(ride.lowest_load().normal_load == std::numeric_limits<double>::infinity());
  }
}

}  // namespace laws_test
