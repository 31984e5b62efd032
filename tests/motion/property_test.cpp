#include "glissade/motion/motion.hpp"

#include "support/catch.hpp"
#include "tracks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include <boost/numeric/odeint.hpp>

namespace property_test {

using namespace glissade;

namespace {

constexpr double kGravity = kDefaultGravity;
constexpr int kTracks = 60;

Body random_body(testing::Random& random, bool from_rest) {
  Body body;
  body.friction = Friction::from_coefficient(random.between(0.0, 0.6));
  body.entry_speed = from_rest ? 0.0 : std::pow(10.0, random.between(-2.0, 1.3));
  body.drag_per_metre = random.integer(0, 1) == 0 ? 0.0 : std::pow(10.0, random.between(-4.0, -1.0));
  return body;
}

/// (v, t) along s by Bulirsch and Stoer's extrapolation of the energy equation as it stands; no code in
/// common.
class ExtrapolationAlongTrack {
 public:
  using State = std::array<double, 2>;

  ExtrapolationAlongTrack(const Centerline& track, const Body& body) : track_(&track), body_(body) {
    state_ = {body.entry_speed * body.entry_speed, 0.0};
  }

  /// To s, which must not lie beyond a jump of curvature.
  void advance(double s, double smooth_end) {
    namespace odeint = boost::numeric::odeint;
    if (s <= s_) return;
    const auto equation = [&](const State& state, State& change, double at) {
      const double inside = at >= smooth_end ? std::nextafter(smooth_end, 0.0) : at;
      const CenterlinePoint point = track_->at(inside);
      const double load = kGravity * std::cos(point.slope_angle) + point.curvature * state[0];
      change[0] = 2.0 * (kGravity * std::sin(point.slope_angle) - body_.friction.coefficient() * load -
                         body_.drag_per_metre * state[0]);
      change[1] = 1.0 / std::sqrt(state[0]);
    };
    odeint::integrate_adaptive(odeint::bulirsch_stoer<State>(1e-16, 1e-14), equation, state_, s_, s,
                               1e-3 * (s - s_));
    s_ = s;
  }

  [[nodiscard]] double speed() const { return std::sqrt(state_[0]); }
  [[nodiscard]] double time() const { return state_[1]; }

 private:
  const Centerline* track_;
  Body body_;
  State state_{};
  double s_ = 0.0;
};

/// The theorem's domain: slope angles within 180 deg of the friction angle, so no loops.
bool winds_less_than_half_a_turn(const Centerline& track, double until, double delta) {
  constexpr int kSamples = 400;
  for (int i = 0; i < kSamples; ++i) {
    if (std::fabs(track.slope_angle(until * i / kSamples) - delta) > 3.1) return false;
  }
  return true;
}

}  // namespace

TEST_CASE(
    "Motion agrees with an extrapolating integrator along random tracks with friction, drag and jumps of "
    "curvature") {
  auto random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  int rides = 0;
  for (int i = 0; i < kTracks; ++i) {
    const auto track = testing::random_rough_track(random);
    const Body body = random_body(random, false);
    const Motion motion(track, body);
    // Near a stop the integrator's own error grows without bound.
    const double until = motion.stall() ? 0.9 * motion.distance() : motion.distance();
    ExtrapolationAlongTrack extrapolation(*track, body);
    double highest_v = std::pow(body.entry_speed, 2);
    double lowest_v = highest_v;
    const std::vector<double> breaks = track->breaks();
    for (std::size_t piece = 0; piece + 1 < breaks.size() && breaks[piece] < until; ++piece) {
      for (const double part : {0.31, 0.74, 1.0}) {
        const double s = std::min(until, breaks[piece] + part * (breaks[piece + 1] - breaks[piece]));
        extrapolation.advance(s, breaks[piece + 1]);
        const MotionState state = motion.at(s);
        // Both integrators lose the digits that v loses as a difference of greater terms.
        highest_v = std::max(highest_v, std::pow(state.speed, 2));
        lowest_v = std::min(lowest_v, std::pow(state.speed, 2));
        const double tolerance = 1e-12 + 1e-14 * highest_v / lowest_v;
        CHECK(state.speed == Approx(extrapolation.speed()).epsilon(tolerance));
        CHECK(state.time == Approx(extrapolation.time()).epsilon(tolerance));
        ++rides;
      }
    }
  }
  CHECK(rides > kTracks);
}

TEST_CASE("Motion agrees with Newton's law in time, from rest on random smooth tracks") {
  namespace odeint = boost::numeric::odeint;
  using State = std::array<double, 2>;  // s, u
  auto random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  int rides = 0;
  for (int i = 0; i < kTracks; ++i) {
    const auto track = testing::random_smooth_track(random);
    const Body body = random_body(random, true);
    const Motion motion(track, body);
    if (motion.distance() == 0.0) continue;
    const double until = 0.8 * motion.distance();
    const double time = motion.at(until).time;
    const auto newton = [&](const State& state, State& change, double) {
      const CenterlinePoint point = track->at(std::clamp(state[0], 0.0, track->length()));
      const double v = state[1] * state[1];
      const double load = kGravity * std::cos(point.slope_angle) + point.curvature * v;
      change = {state[1], kGravity * std::sin(point.slope_angle) - body.friction.coefficient() * load -
                              body.drag_per_metre * v};
    };
    State state{0.0, 0.0};
    odeint::integrate_adaptive(odeint::bulirsch_stoer<State>(1e-16, 1e-14), newton, state, 0.0, time,
                               1e-4 * time);
    CHECK(state[0] == Approx(until).epsilon(1e-11));
    CHECK(state[1] == Approx(motion.at(until).speed).epsilon(1e-10));
    ++rides;
  }
  CHECK(rides > kTracks / 2);
}

TEST_CASE("energy: what friction and drag take, the body has lost, at every station") {
  auto random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (int i = 0; i < 4 * kTracks; ++i) {
    const auto track = testing::random_rough_track(random);
    const Body body = random_body(random, i % 2 == 0);
    const Motion motion(track, body);
    for (int part = 0; part <= 7; ++part) {
      const double s = part == 7 ? motion.distance() : motion.distance() * part / 7.0;
      const MotionState state = motion.at(s);
      const double given = kGravity * track->at(s).drop + 0.5 * body.entry_speed * body.entry_speed;
      const double found = 0.5 * state.speed * state.speed + state.friction_loss + state.drag_loss;
      const double size = kGravity * s + 0.5 * body.entry_speed * body.entry_speed;
      CHECK(std::fabs(found - given) <= 1e-12 * size);
    }
  }
}

TEST_CASE(
    "reach theorem: no track gives a body more speed than the theorem allows, none arrives beyond reach") {
  auto random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  int arrivals = 0;
  for (int i = 0; i < 10 * kTracks; ++i) {
    const auto track = testing::random_rough_track(random);
    Body body = random_body(random, i % 2 == 0);
    body.drag_per_metre = 0.0;
    const Motion motion(track, body);
    const double mu = body.friction.coefficient();
    const double delta = body.friction.angle().radians();
    const double entry = track->slope_angle(0.0);
    if (!winds_less_than_half_a_turn(*track, motion.distance(), delta)) continue;
    for (int part = 1; part <= 5; ++part) {
      const CenterlinePoint point = track->at(part == 5 ? motion.distance() : motion.distance() * part / 5.0);
      const double zeta = point.slope_angle;
      const double v0 = body.entry_speed * body.entry_speed;
      const double bound = v0 * std::exp(2.0 * mu * (zeta - entry)) +
                           2.0 * kGravity * (point.drop - mu * point.x) * std::exp(2.0 * mu * (zeta - delta));
      const double v = std::pow(motion.at(point.arc_length).speed, 2);
      CHECK(v <= bound + 1e-12 * (kGravity * point.arc_length + v0));
    }
    if (!motion.arrived()) continue;
    ++arrivals;
    const Endpoints end = track->endpoints();
    if (body.entry_speed == 0.0) CHECK(end.drop > mu * end.run);
  }
  CHECK(arrivals > kTracks);
}

TEST_CASE("the highest and lowest values of a ride bound every station of it") {
  auto random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (int i = 0; i < kTracks; ++i) {
    const auto track = testing::random_smooth_track(random);
    const Motion motion(track, random_body(random, i % 2 == 0));
    const double highest = motion.highest_load().normal_load;
    const double lowest = motion.lowest_load().normal_load;
    const double fastest = motion.highest_speed().speed;
    const double size = std::max(kGravity, highest);
    // They occur: the curvature of these tracks does not jump, so at() tells the same.
    CHECK(motion.at(motion.highest_load().arc_length).normal_load == Approx(highest).margin(1e-12 * size));
    CHECK(motion.at(motion.lowest_load().arc_length).normal_load == Approx(lowest).margin(1e-12 * size));
    CHECK(motion.at(motion.highest_speed().arc_length).speed == Approx(fastest).epsilon(1e-13));
    // To the last digit: a summary shows these side by side.
    CHECK(fastest >= motion.exit_speed());
    CHECK(fastest >= motion.at(0.0).speed);
    double sampled_highest = -1e300;
    double sampled_lowest = 1e300;
    double sampled_fastest = 0.0;
    constexpr int kSamples = 2000;
    for (int k = 0; k <= kSamples; ++k) {
      const MotionState state =
          motion.at(k == kSamples ? motion.distance() : motion.distance() * k / kSamples);
      sampled_highest = std::max(sampled_highest, state.normal_load);
      sampled_lowest = std::min(sampled_lowest, state.normal_load);
      sampled_fastest = std::max(sampled_fastest, state.speed);
    }
    CHECK(sampled_highest <= highest + 1e-12 * size);
    CHECK(sampled_lowest >= lowest - 1e-12 * size);
    CHECK(sampled_fastest <= fastest * (1.0 + 1e-14));
  }
}

TEST_CASE("stations asked for at once are the same as one by one") {
  auto random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  const auto track = testing::random_rough_track(random);
  const Motion motion(track, {Friction::from_coefficient(0.1), 1.0, 0.001});
  std::vector<double> stations;
  for (int i = 0; i <= 20; ++i) stations.push_back(motion.distance() * (i / 20.0));
  const std::vector<MotionState> table = motion.at(stations);
  REQUIRE(table.size() == stations.size());
  double time = -1.0;
  for (std::size_t i = 0; i < stations.size(); ++i) {
    const MotionState single = motion.at(stations[i]);
    CHECK(table[i].arc_length == stations[i]);
    CHECK(table[i].time == single.time);
    CHECK(table[i].speed == single.speed);
    CHECK(table[i].time > time);
    time = table[i].time;
  }
}

}  // namespace property_test
