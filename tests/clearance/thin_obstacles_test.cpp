// Obstacles narrower than the distance between two samples of a track: a verdict counts for the whole of it.

#include "glissade/centerline/cycloid.hpp"
#include "glissade/centerline/straight_line.hpp"
#include "glissade/motion/motion.hpp"
#include "glissade/referee/referee.hpp"

#include "support/catch.hpp"
#include "support/random.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

using namespace glissade;

namespace {

constexpr double kRun = 50.0;
constexpr double kDrop = 25.0;
constexpr double kDeep = 60.0;

CenterlinePtr straight() {
  return std::make_shared<StraightLine>(Endpoints{kRun, kDrop});
}
CenterlinePtr rolled() {
  return std::make_shared<Cycloid>(Endpoints{kRun, kDrop});
}

/// An upright post, its foot far below the track and its head at a drop.
KeepOut post(double run, double width, double head) {
  return {{{run, head}, {run + width, head}, {run + width, kDeep}, {run, kDeep}}, 0.0, Passage::either};
}

Problem problem_with(const Limits& limits) {
  Problem problem;
  problem.endpoints = {kRun, kDrop};
  problem.body.friction = Friction::from_coefficient(0.1);
  problem.limits = limits;
  return problem;
}

const LimitCheck& check_of(const std::vector<LimitCheck>& checks, LimitId id) {
  const auto found =
      std::find_if(checks.begin(), checks.end(), [&](const LimitCheck& one) { return one.limit.id == id; });
  REQUIRE(found != checks.end());
  return *found;
}

/// The drop of a track where it passes a run, by bisection.
double drop_at(const Centerline& track, double run) {
  double low = 0.0;
  double high = track.length();
  for (int i = 0; i < 80; ++i) {
    const double middle = 0.5 * (low + high);
    (track.at(middle).x < run ? low : high) = middle;
  }
  return track.at(low).drop;
}

}  // namespace

TEST_CASE(
    "a post that stands through a track breaks its clearance, however narrow, and one below it does not") {
  testing::Random random = testing::seeded_random(11);
  INFO("GLISSADE_SEED=" << random.seed());
  for (const CenterlinePtr& track : {straight(), rolled()}) {
    for (int draw = 0; draw < 60; ++draw) {
      const double run = random.between(1.0, kRun - 1.0);
      const double width = std::pow(10.0, random.between(-3.3, -1.0));
      const double above = random.between(0.01, 3.0) * (random.integer(0, 1) == 0 ? 1.0 : -1.0);
      const double head = drop_at(*track, run + 0.5 * width) - above;
      INFO("post at " << run << " m, " << width << " m wide, head " << above << " m above the track");
      Limits limits;
      limits.keep_outs = {post(run, width, head)};
      const LimitCheck area = check_of(check_limits(problem_with(limits), track), LimitId::keep_outs);
      const bool through = above > 0.0;
      // A track that leaves steeply may pass a head close to it on the far side.
      const bool clear = above < -width;
      if (through) {
        CHECK_FALSE(area.kept());
        CHECK(area.where == Approx(track->length() * run / kRun).margin(15.0));
      }
      if (clear) CHECK(area.kept());

      Limits spiked;
      spiked.stay_above = {{{{-1.0, kDeep},
                             {run, kDeep},
                             {run + 0.5 * width, head},
                             {run + width, kDeep},
                             {kRun + 1.0, kDeep}},
                            0.0}};
      const LimitCheck line = check_of(check_limits(problem_with(spiked), track), LimitId::stay_above);
      if (through) CHECK_FALSE(line.kept());
      if (clear) CHECK(line.kept());
    }
  }
}

TEST_CASE("a post that stands through walls is met, a wire between them too, however thin") {
  testing::Random random = testing::seeded_random(13);
  INFO("GLISSADE_SEED=" << random.seed());
  const CenterlinePtr track = straight();
  const double steep = std::hypot(1.0, kDrop / kRun);
  for (int draw = 0; draw < 40; ++draw) {
    const double run = random.between(2.0, kRun - 2.0);
    const double width = std::pow(10.0, random.between(-6.0, -2.0));
    const double height = random.between(-0.3, 1.0);  // of the post's head above the floor, upright
    Limits limits;
    limits.envelope = {0.01, 0.5, 0.0};
    limits.keep_outs = {post(run, width, drop_at(*track, run) - height)};
    INFO("post at " << run << " m, " << width << " m wide, head " << height << " m above the floor");
    const LimitCheck check = check_of(check_limits(problem_with(limits), track), LimitId::keep_outs);
    if (height > -0.01 * steep + width + 1e-3) {
      CHECK_FALSE(check.kept());
    } else if (height < -0.01 * steep - width - 1e-3) {
      CHECK(check.kept());
    }
    // A wire within the walls, no edge of the envelope near it.
    const Vec2 wire{run, drop_at(*track, run) - 0.2 * steep};
    limits.keep_outs = {{{wire, wire + Vec2{width, 0.0}, wire + Vec2{0.0, width}}, 0.0, Passage::either}};
    CHECK_FALSE(check_of(check_limits(problem_with(limits), track), LimitId::keep_outs).kept());
  }
}

TEST_CASE("a track that lies along a line does not hide a post that stands through it") {
  const CenterlinePtr track = straight();
  const double slope = kDrop / kRun;
  // Ground along the track itself, by a rounding above it, with a spike of 2 mm at its middle and none of the samples.
  const double lift = 1e-13;
  const double run = 30.0123;
  const auto ground = [&](double spike) {
    Limits limits;
    limits.stay_above = {{{{0.0, -lift},
                           {run - 1e-3, slope * (run - 1e-3) - lift},
                           {run, slope * run - spike},
                           {run + 1e-3, slope * (run + 1e-3) - lift},
                           {kRun, kDrop - lift}},
                          0.0}};
    return check_of(check_limits(problem_with(limits), track), LimitId::stay_above);
  };
  CHECK(ground(lift).kept());
  const LimitCheck spiked = ground(0.5);
  CHECK_FALSE(spiked.kept());
  CHECK(spiked.where == Approx(run * std::hypot(1.0, slope)).margin(0.01));
}

TEST_CASE("a speed is highest where the mats begin, wherever that is") {
  const CenterlinePtr track = straight();
  Limits limits;
  limits.speed.highest = 100.0;
  Problem problem = problem_with(limits);
  testing::Random random = testing::seeded_random(12);
  INFO("GLISSADE_SEED=" << random.seed());
  for (int draw = 0; draw < 20; ++draw) {
    const double from = random.between(5.0, 50.0);
    problem.body.friction_changes = {{from, Friction::from_coefficient(0.8)}};
    const LimitCheck speed = check_of(check_limits(problem, track), LimitId::speed);
    // On a straight line v^2 = 2 g s (sin - mu cos).
    const double chord = std::hypot(kRun, kDrop);
    const double fastest = std::sqrt(2.0 * problem.gravity * from * (kDrop - 0.1 * kRun) / chord);
    CHECK(speed.where == Approx(from).epsilon(1e-12));
    CHECK(speed.reached == Approx(fastest).epsilon(1e-9));
  }
}
