#include "glissade/centerline/clothoid_spline.hpp"
#include "glissade/centerline/coulomb_brachistochrone.hpp"
#include "glissade/centerline/fastest_track.hpp"
#include "glissade/centerline/flying_start_brachistochrone.hpp"
#include "glissade/centerline/straight_line.hpp"
#include "glissade/core/error.hpp"
#include "glissade/motion/motion.hpp"

#include "support/catch.hpp"
#include "support/paths.hpp"
#include "support/random.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include <boost/math/quadrature/gauss.hpp>
#include <nlohmann/json.hpp>

namespace flying_start_test {

using namespace glissade;

namespace {

struct Problem {
  Endpoints endpoints;
  Friction friction;
  double entry_speed = 0.0;
};

std::string describe(const Problem& problem) {
  return "mu " + std::to_string(problem.friction.coefficient()) + ", run " +
         std::to_string(problem.endpoints.run) + ", drop " + std::to_string(problem.endpoints.drop) +
         ", entry speed " + std::to_string(problem.entry_speed);
}

double margin_of(const Problem& problem) {
  const double unit = problem.entry_speed * problem.entry_speed / kDefaultGravity;
  return (problem.endpoints.drop - least_drop(problem.endpoints.run, problem.friction, problem.entry_speed)) /
         (std::hypot(problem.endpoints.run, problem.endpoints.drop) + unit);
}

/// Any finish that can be reached: near, far, above, below, by pure flight or not.
Problem random_problem(testing::Random& random, double least_margin = -3.0) {
  Problem problem;
  problem.friction = Friction::from_coefficient(
      random.between(0.0, 1.0) < 0.1 ? 0.0 : std::pow(10.0, random.between(-2.5, 0.3)));
  const double unit = std::pow(10.0, random.between(-2.0, 2.0));  // v0^2/g
  problem.entry_speed = std::sqrt(unit * kDefaultGravity);
  problem.endpoints.run = unit * std::pow(10.0, random.between(-1.5, 3.0));
  const double least = least_drop(problem.endpoints.run, problem.friction, problem.entry_speed);
  const double size = unit + std::fabs(least) + 0.3 * problem.endpoints.run;
  problem.endpoints.drop = least + size * std::pow(10.0, random.between(least_margin, 0.7));
  return problem;
}

FlyingStartSolution solve(const Problem& problem) {
  return solve_flying_start(problem.endpoints, problem.friction, problem.entry_speed);
}

std::shared_ptr<const FlyingStartBrachistochrone> curve(const Problem& problem) {
  return std::make_shared<const FlyingStartBrachistochrone>(problem.endpoints, problem.friction,
                                                            problem.entry_speed);
}

double relative_error(double value, double expected) {
  return std::fabs(value - expected) / std::fabs(expected);
}

/// What rounding of the finish alone leaves of a small exit speed.
double exit_speed_rounding(const FlyingStartSolution& solution) {
  const double chord = std::hypot(solution.endpoints.run, solution.endpoints.drop);
  const double terms = solution.entry_speed * solution.entry_speed + 2.0 * solution.gravity * chord;
  return kFlyingStartRounding * terms / (solution.exit_speed * solution.exit_speed);
}

/// A track whose last stretch is bent: its slope angle plus sines that vanish at both ends of it, and the
/// stretch lengthened. The flight before it is left alone.
class BentTrack : public Centerline {
 public:
  using Amplitudes = std::array<double, 4>;
  BentTrack(std::shared_ptr<const FlyingStartBrachistochrone> base, Amplitudes amplitudes, double stretch)
      : base_(std::move(base)),
        amplitudes_(amplitudes),
        stretch_(stretch),
        begin_(base_->flight_length()),
        first_(base_->at(begin_)) {}

  [[nodiscard]] std::string_view kind() const noexcept override { return "bent"; }
  [[nodiscard]] double length() const noexcept override {
    return begin_ + stretch_ * (base_->length() - begin_);
  }
  [[nodiscard]] std::vector<double> breaks() const override {
    return begin_ > 0.0 ? std::vector{0.0, begin_, length()} : std::vector{0.0, length()};
  }
  [[nodiscard]] Direction direction(double s) const override {
    if (s < begin_) return base_->direction(s);
    Direction bent = base_->direction(std::min(begin_ + (s - begin_) / stretch_, base_->length()));
    bent.curvature /= stretch_;
    for (std::size_t i = 0; i < amplitudes_.size(); ++i) {
      const double wave = static_cast<double>(i + 1) * std::numbers::pi / (length() - begin_);
      bent.slope_angle += amplitudes_[i] * std::sin(wave * (s - begin_));
      bent.curvature -= amplitudes_[i] * wave * std::cos(wave * (s - begin_));
    }
    return bent;
  }
  [[nodiscard]] double slope_angle(double s) const override { return direction(s).slope_angle; }
  [[nodiscard]] CenterlinePoint at(double s) const override {
    if (s < begin_) return base_->at(s);
    CenterlinePoint point = first_;
    constexpr int kPanels = 24;
    const double width = (s - begin_) / kPanels;
    using Gauss = boost::math::quadrature::gauss<double, 15>;
    for (int i = 0; i < kPanels; ++i) {
      const double a = begin_ + i * width;
      point.x += Gauss::integrate([&](double p) { return std::cos(slope_angle(p)); }, a, a + width);
      point.drop += Gauss::integrate([&](double p) { return std::sin(slope_angle(p)); }, a, a + width);
    }
    const Direction here = direction(s);
    return {s, point.x, point.drop, here.slope_angle, here.curvature};
  }

 private:
  std::shared_ptr<const FlyingStartBrachistochrone> base_;
  Amplitudes amplitudes_;
  double stretch_;
  double begin_;
  CenterlinePoint first_;
};

/// A bent track that ends at the finish of its base: Newton over its first sine and its stretch.
std::shared_ptr<const BentTrack> bent_to_finish(const std::shared_ptr<const FlyingStartBrachistochrone>& base,
                                                BentTrack::Amplitudes amplitudes) {
  const Endpoints wanted = base->endpoints();
  double stretch = 1.0;
  const auto miss = [&](double first, double lengthened) {
    BentTrack::Amplitudes moved = amplitudes;
    moved[0] = first;
    const Endpoints end = BentTrack(base, moved, lengthened).endpoints();
    return std::array{end.run - wanted.run, end.drop - wanted.drop};
  };
  for (int step = 0; step < 6; ++step) {
    constexpr double kStep = 1e-6;
    const auto here = miss(amplitudes[0], stretch);
    const auto bent = miss(amplitudes[0] + kStep, stretch);
    const auto longer = miss(amplitudes[0], stretch + kStep);
    const double a = (bent[0] - here[0]) / kStep;
    const double b = (longer[0] - here[0]) / kStep;
    const double c = (bent[1] - here[1]) / kStep;
    const double d = (longer[1] - here[1]) / kStep;
    amplitudes[0] -= (here[0] * d - here[1] * b) / (a * d - b * c);
    stretch -= (here[1] * a - here[0] * c) / (a * d - b * c);
  }
  return std::make_shared<const BentTrack>(base, amplitudes, stretch);
}

}  // namespace

TEST_CASE("fastest track with an entry speed: every reference case") {
  std::ifstream file(test_data_path("reference/entry_speed.json"));
  const auto cases = nlohmann::json::parse(file);
  REQUIRE(cases.size() == 20);
  for (const auto& item : cases) {
    const auto number = [&](const char* key) { return std::stod(item.at(key).get<std::string>()); };
    const Problem problem{{number("run"), number("drop")},
                          Friction::from_coefficient(number("friction_coefficient")),
                          number("entry_speed")};
    const double gravity = number("gravity");
    INFO(describe(problem));
    const FlyingStartSolution found =
        solve_flying_start(problem.endpoints, problem.friction, problem.entry_speed, gravity);
    const double tolerance = flying_start_accuracy(margin_of(problem));
    CHECK(relative_error(found.travel_time, number("travel_time")) <= tolerance);
    CHECK(relative_error(found.exit_speed, number("exit_speed")) <= tolerance + exit_speed_rounding(found));
    // Angles and the flight are given to 12 digits.
    CHECK(std::fabs(found.entry_slope_angle.radians() - number("entry_slope_angle")) <= 2e-12);
    CHECK(std::fabs(found.flight_end_slope_angle.radians() - number("flight_end_slope_angle")) <= 2e-12);
    CHECK(std::fabs(found.exit_slope_angle.radians() - number("exit_slope_angle")) <= 2e-12);
    CHECK(relative_error(found.flight.run, number("flight_run")) <= 1e-11);
    CHECK(std::fabs(found.flight.drop - number("flight_drop")) <= 1e-11 * problem.endpoints.run);
  }
}

TEST_CASE("fastest track with an entry speed: the referee rides it to the same time and speed") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  int flights = 0;
  int uphill = 0;
  constexpr int kProblems = 250;
  for (int i = 0; i < kProblems; ++i) {
    const Problem problem = random_problem(random);
    INFO(describe(problem));
    const auto track = curve(problem);
    const FlyingStartSolution& solution = track->solution();
    const double tolerance = FlyingStartBrachistochrone::kPositionAccuracy * track->length();
    CHECK(std::fabs(track->endpoints().run - problem.endpoints.run) <= tolerance);
    CHECK(std::fabs(track->endpoints().drop - problem.endpoints.drop) <= tolerance);
    const Motion ride(track, Body{problem.friction, problem.entry_speed, 0.0});
    REQUIRE(ride.arrived());
    CHECK(relative_error(ride.travel_time(), solution.travel_time) <= kMotionAccuracy);
    CHECK(relative_error(ride.exit_speed(), solution.exit_speed) <=
          kMotionAccuracy + exit_speed_rounding(solution));
    if (solution.all_flight()) ++flights;
    if (problem.endpoints.drop < 0.0) ++uphill;
  }
  CHECK(flights > kProblems / 40);
  CHECK(uphill > kProblems / 40);
}

TEST_CASE("fastest track with an entry speed: no slower than the straight line nor any track of the family") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  int compared = 0;
  for (int i = 0; i < 100; ++i) {
    const Problem problem = random_problem(random);
    INFO(describe(problem));
    const double best = solve(problem).travel_time;
    const Body body{problem.friction, problem.entry_speed, 0.0};
    const Motion straight(std::make_shared<StraightLine>(problem.endpoints), body);
    if (straight.arrived()) CHECK(best <= straight.travel_time() * (1.0 + 1e-13));
    // Fastest tracks of other bodies: a shorter flight, or a longer second part.
    for (int k = 0; k < 4; ++k) {
      Problem other = problem;
      other.friction =
          Friction::from_coefficient(problem.friction.coefficient() * random.between(0.5, 1.05) + 1e-3 * k);
      other.entry_speed *= random.between(1.0, 1.5);
      if (margin_of(other) <= 1e-3) continue;
      const Motion ride(curve(other), body);
      if (!ride.arrived()) continue;
      CHECK(best <= ride.travel_time() * (1.0 + 1e-12));
      ++compared;
    }
  }
  CHECK(compared > 150);
}

TEST_CASE("fastest track with an entry speed: no slower than a bent neighbour") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  int compared = 0;
  for (int i = 0; i < 40; ++i) {
    const Problem problem = random_problem(random, -1.5);
    const auto base = curve(problem);
    if (base->solution().all_flight()) continue;
    // The test's own quadrature does not follow the sharp ends of a turnpike.
    const Endpoints unbent = BentTrack(base, {}, 1.0).endpoints();
    if (std::hypot(unbent.run - problem.endpoints.run, unbent.drop - problem.endpoints.drop) >
        1e-13 * base->length()) {
      continue;
    }
    const Body body{problem.friction, problem.entry_speed, 0.0};
    for (int k = 0; k < 3; ++k) {
      BentTrack::Amplitudes amplitudes{};
      const double size = std::pow(10.0, random.between(-4.0, -1.5));
      for (double& amplitude : amplitudes) amplitude = size * random.between(-1.0, 1.0);
      const auto track = bent_to_finish(base, amplitudes);
      const Endpoints end = track->endpoints();
      if (!(std::fabs(end.run - problem.endpoints.run) <= 1e-12 * base->length()) ||
          !(std::fabs(end.drop - problem.endpoints.drop) <= 1e-12 * base->length())) {
        continue;
      }
      const Motion ride(track, body);
      if (!ride.arrived()) continue;
      INFO(describe(problem) << ", bent by " << size);
      CHECK(base->solution().travel_time <= ride.travel_time() * (1.0 + 1e-11));
      ++compared;
    }
  }
  CHECK(compared > 40);
}

TEST_CASE("fastest track with an entry speed: the junction condition and the costates") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (int i = 0; i < 300; ++i) {
    const Problem problem = random_problem(random, -1.5);
    const FlyingStartSolution found = solve(problem);
    if (found.all_flight()) continue;
    INFO(describe(problem));
    const double delta = problem.friction.angle().radians();
    const double z0 = found.entry_slope_angle.radians();
    const double zj = found.flight_end_slope_angle.radians();
    const double z1 = found.exit_slope_angle.radians();
    CHECK(std::sin(zj - z0) * std::sin(z0 + delta - z1) * std::cos(zj) ==
          Approx(std::sin(zj - z1) * std::sin(zj - z0 - delta) * std::cos(z0)).margin(1e-12));
    // dT/dL and dT/dH, (B2) and (B3) at the finish.
    const double step = 1e-5 * problem.endpoints.run;
    const auto time = [&](double run, double drop) {
      Problem moved = problem;
      moved.endpoints.run += run;
      moved.endpoints.drop += drop;
      return solve(moved).travel_time;
    };
    const double by_run = (time(step, 0.0) - time(-step, 0.0)) / (2.0 * step);
    const double by_drop = (time(0.0, step) - time(0.0, -step)) / (2.0 * step);
    const double mu = problem.friction.coefficient();
    const double size = std::sqrt(1.0 + mu * mu) / found.exit_speed;
    const double slack = 1e-6 / std::pow(std::min(1.0, margin_of(problem)), 2.0);
    CHECK(std::fabs(by_run - (std::cos(z1) + mu * std::sin(z1)) / found.exit_speed) <= slack * size);
    CHECK(std::fabs(by_drop - (std::sin(z1) - mu * std::cos(z1)) / found.exit_speed) <= slack * size);
  }
}

TEST_CASE("fastest track with an entry speed: from ever less speed the track from rest") {
  const Endpoints endpoints{10.0, 5.0};
  const Friction friction = Friction::from_coefficient(0.2);
  const CoulombSolution rest = solve_coulomb_brachistochrone(endpoints, friction);
  double last = HUGE_VAL;
  for (const double speed : {1e-1, 1e-2, 1e-3, 1e-4, 1e-6, 1e-9}) {
    const FlyingStartSolution found = solve_flying_start(endpoints, friction, speed);
    const double won = 1.0 - found.travel_time / rest.travel_time;
    INFO(speed);
    // A body that falls gains v0/g of time, and what the shape gains is of higher order.
    CHECK(won == Approx(speed / kDefaultGravity / rest.travel_time).epsilon(0.3).margin(1e-14));
    CHECK(found.exit_slope_angle.radians() == Approx(rest.exit_slope_angle.radians()).margin(speed));
    CHECK(found.flight_end_slope_angle.radians() < std::numbers::pi / 2.0);
    CHECK(won < last);
    last = won;
  }
  // The flight shrinks to a point; its two slopes tend to 90 deg - delta and 90 deg.
  const FlyingStartSolution slow = solve_flying_start(endpoints, friction, 1e-9);
  CHECK(slow.entry_slope_angle.radians() == Approx(std::atan(1.0 / 0.2)).margin(1e-4));
  CHECK(slow.flight_end_slope_angle.radians() == Approx(std::numbers::pi / 2.0).margin(1e-4));
}

TEST_CASE(
    "fastest track with an entry speed: beside a vertical it ends at its finish, to its stated accuracy") {
  for (const double run : {1.0, 1.975e-3}) {
    for (const double steepness : {1e2, 1e3, 1e4, 1e5, 2.8e6, 1e7, 9e8}) {
      const Endpoints ends{run, run * steepness};
      for (const double mu : {0.0, 0.1, 0.5, 2.0}) {
        for (const double share : {0.01, 0.05, 0.2, 0.3, 1.0, 3.0}) {
          const double speed = share * std::sqrt(kDefaultGravity * ends.drop);
          CAPTURE(run, steepness, mu, speed);
          const FlyingStartBrachistochrone track(ends, Friction::from_coefficient(mu), speed);
          const CenterlinePoint end = track.at(track.length());
          CHECK(std::hypot(end.x - ends.run, end.drop - ends.drop) <=
                FlyingStartBrachistochrone::kPositionAccuracy * track.length());
        }
      }
    }
  }
}

TEST_CASE(
    "fastest track with an entry speed: drawn from end to end however slow it begins, however steep it is") {
  struct Drawn {
    Endpoints endpoints;
    double friction;
  };
  for (const Drawn& drawn : {Drawn{{10.0, 0.8}, 0.0}, Drawn{{10.0, 0.0}, 0.0}, Drawn{{10.0, -1e-7}, 0.0},
                             Drawn{{1.0, 50.0}, 0.0}, Drawn{{1.0, 100.0}, 0.3}, Drawn{{10.0, 8.0}, 0.1}}) {
    for (const double speed : {2e-2, 1e-2, 1e-3, 1e-6, 1e-9}) {
      if (0.5 * speed * speed + kDefaultGravity * drawn.endpoints.drop <= 0.0) continue;
      CAPTURE(drawn.endpoints.run, drawn.endpoints.drop, drawn.friction, speed);
      const Friction friction = Friction::from_coefficient(drawn.friction);
      const auto track = std::make_shared<const FlyingStartBrachistochrone>(drawn.endpoints, friction, speed,
                                                                            kDefaultGravity);
      const FlyingStartSolution& solution = track->solution();
      const CenterlinePoint begin = track->at(0.0);
      const CenterlinePoint end = track->at(track->length());
      CHECK(begin.slope_angle == Approx(solution.entry_slope_angle.radians()).margin(1e-12));
      CHECK(end.slope_angle == Approx(solution.exit_slope_angle.radians()).margin(1e-9));
      CHECK(end.x == Approx(drawn.endpoints.run).margin(1e-9 * track->length()));
      CHECK(end.drop == Approx(drawn.endpoints.drop).margin(1e-9 * track->length()));
      Body body;
      body.friction = friction;
      body.entry_speed = speed;
      const Motion ride(track, body, kDefaultGravity);
      REQUIRE(ride.arrived());
      CHECK(ride.travel_time() == Approx(solution.travel_time).epsilon(1e-9));
    }
  }
}

TEST_CASE("fastest track with an entry speed: without friction a cycloid without a flight") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (int i = 0; i < 50; ++i) {
    Problem problem = random_problem(random, -1.5);
    problem.friction = Friction{};
    if (margin_of(problem) < 1e-2) continue;
    INFO(describe(problem));
    const auto track = curve(problem);
    CHECK(track->flight_length() == 0.0);
    // u is proportional to cos(zeta), and u^2 = v0^2 + 2 g y: the drop is a function of the slope angle.
    const double speed2 = problem.entry_speed * problem.entry_speed;
    const double ratio = speed2 / std::pow(std::cos(track->at(0.0).slope_angle), 2.0);
    for (const double part : {0.1, 0.35, 0.6, 0.9, 1.0}) {
      const CenterlinePoint point = track->at(part * track->length());
      const double drop =
          (ratio * std::pow(std::cos(point.slope_angle), 2.0) - speed2) / (2.0 * kDefaultGravity);
      CHECK(point.drop == Approx(drop).margin(1e-11 * track->length()));
    }
  }
}

TEST_CASE(
    "fastest track with an entry speed: however little, the track ends at the finish and takes its time") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (int i = 0; i < 60; ++i) {
    const double mu = i % 4 == 0 ? 0.0 : random.between(0.0, 3.0);
    const double run = random.between(0.2, 30.0);
    const double drop = (mu + std::pow(10.0, random.between(-1.0, 1.0))) * run;
    const Friction friction = Friction::from_coefficient(mu);
    const double fall = std::sqrt(kDefaultGravity * std::hypot(run, drop));
    const CoulombSolution rest = solve_coulomb_brachistochrone({run, drop}, friction);
    for (const double share :
         {1e-8, 1e-9, 2e-11, 0.9e-11, 1e-12, 1e-16, 1e-24, 1e-25, 1e-40, 1e-200, 1e-323}) {
      const double speed = std::max(share * fall, std::numeric_limits<double>::denorm_min());
      INFO("mu " << mu << ", run " << run << ", drop " << drop << ", entry speed " << speed);
      const FlyingStartBrachistochrone track({run, drop}, friction, speed);
      const FlyingStartSolution& found = track.solution();
      CHECK((found.limit == FlyingStartLimit::rest) == (share < kRestShare));
      CHECK(found.all_flight() == false);
      // The fastest track is ahead by v0/(g cos delta), that from rest by v0/g.
      const bool as_at_rest = found.limit == FlyingStartLimit::rest;
      const double lead = speed / kDefaultGravity * (as_at_rest ? 1.0 : std::sqrt(1.0 + mu * mu));
      CHECK(std::fabs(found.travel_time - (rest.travel_time - lead)) <=
            1e-2 * lead + 3e-14 * rest.travel_time);
      CHECK(found.exit_speed == Approx(rest.exit_speed).epsilon(1e-8));
      CHECK(track.endpoints().run == Approx(run).epsilon(1e-8));
      CHECK(track.endpoints().drop == Approx(drop).epsilon(1e-8));
      if (share >= kRestShare) continue;
      CHECK(found.travel_time <= rest.travel_time);
      const Motion ride(std::make_shared<const FlyingStartBrachistochrone>(track),
                        Body{friction, speed, 0.0});
      REQUIRE(ride.arrived());
      CHECK(ride.travel_time() == Approx(found.travel_time).epsilon(1e-12));
      CHECK(ride.exit_speed() == Approx(found.exit_speed).epsilon(1e-12));
      CHECK(ride.highest_load().normal_load <= 3.0 * kDefaultGravity);
    }
  }
}

TEST_CASE("fastest track with an entry speed: however much, it is at most a straight line's time away") {
  for (const double mu : {0.0, 1e-6, 0.3, 3.0}) {
    for (const double drop : {2.0, 0.0, -2.0}) {
      for (const double speed : {1e3, 1e5, 1e8, 1e12, 1e30, 1e80, 1e154, 1e155, 1e300, 1.7e308}) {
        INFO("mu " << mu << ", drop " << drop << ", entry speed " << speed);
        const Friction friction = Friction::from_coefficient(mu);
        const FlyingStartBrachistochrone track({3.0, drop}, friction, speed);
        const double chord = std::hypot(3.0, drop);
        CHECK(track.solution().travel_time == Approx(chord / speed).epsilon(1e-4).margin(0.0));
        CHECK(track.solution().exit_speed == Approx(speed).epsilon(1e-4));
        CHECK(track.length() == Approx(chord).epsilon(1e-7));
        CHECK(track.endpoints().run == Approx(3.0).epsilon(2e-9));
        CHECK(track.endpoints().drop == Approx(drop).margin(1e-8));
      }
    }
  }
  // Faster than free fall by sqrt(1e8), where the straight line begins: on either side of it the same.
  const double turn = kStraightTurn * 3.0;
  const double speed = std::sqrt(kDefaultGravity * 3.0 / kStraightTurn);
  for (const double factor : {0.99, 1.01}) {
    const FlyingStartBrachistochrone track({3.0, 2.0}, Friction(), factor * speed);
    CHECK((track.solution().limit == FlyingStartLimit::straight) == (factor > 1.0));
    CHECK(track.at(0.5 * track.length()).drop == Approx(1.0).margin(2.0 * turn));
  }
}

TEST_CASE("fastest track with an entry speed: ways from 1e-200 m to 1e200 m, and others by name") {
  const Friction friction = Friction::from_coefficient(0.3);
  const CoulombSolution one = solve_coulomb_brachistochrone({3.0, 2.0}, friction);
  for (const double scale : {1e-199, 1e-100, 1e100, 1e199}) {
    const FlyingStartBrachistochrone track({3.0 * scale, 2.0 * scale}, friction, 1e-8 * std::sqrt(scale));
    CHECK(track.endpoints().drop == Approx(2.0 * scale).epsilon(1e-8));
    CHECK(track.solution().travel_time == Approx(one.travel_time * std::sqrt(scale)).epsilon(1e-8));
  }
  for (const double scale : {1e-310, 1e-201, 1e200, 5e307})
    CHECK_THROWS_AS(solve_flying_start({3.0 * scale, 2.0 * scale}, friction, 1.0), InputError);
}

TEST_CASE("fastest track with an entry speed: at high speed all of it is flight") {
  const Endpoints endpoints{10.0, 2.0};
  const Friction friction = Friction::from_coefficient(0.3);
  // The speed at which g L = v0 v1 sin(delta).
  const double reach = kDefaultGravity * 10.0 / std::sin(friction.angle().radians());
  const double fall = 2.0 * kDefaultGravity * 2.0;
  const double speed = std::sqrt(-0.5 * fall + std::sqrt(0.25 * fall * fall + reach * reach));
  const FlyingStartSolution slower = solve_flying_start(endpoints, friction, speed * (1.0 - 1e-9));
  const FlyingStartSolution faster = solve_flying_start(endpoints, friction, speed * (1.0 + 1e-9));
  CHECK_FALSE(slower.all_flight());
  CHECK(faster.all_flight());
  CHECK(slower.travel_time == Approx(faster.travel_time).epsilon(1e-8));
  CHECK(faster.flight_end_slope_angle.radians() - faster.entry_slope_angle.radians() ==
        Approx(friction.angle().radians()).epsilon(1e-8));
  for (const double factor : {1.5, 10.0, 1e3, 1e6}) {
    const Problem problem{endpoints, friction, factor * speed};
    const auto track = curve(problem);
    REQUIRE(track->solution().all_flight());
    CHECK(track->breaks().size() == 2);
    const Motion ride(track, Body{friction, problem.entry_speed, 0.0});
    REQUIRE(ride.arrived());
    CHECK(ride.highest_load().normal_load <= 1e-9 * kDefaultGravity);
    CHECK(ride.travel_time() == Approx(track->solution().travel_time).epsilon(kMotionAccuracy));
    CHECK(track->endpoints().drop == Approx(2.0).margin(1e-12));
  }
}

TEST_CASE("fastest track with an entry speed: the load is 0 on the flight and positive after it") {
  const Problem problem{{10.0, 6.0}, Friction::from_coefficient(0.2), 5.0};
  const auto track = curve(problem);
  const double junction = track->flight_length();
  REQUIRE(track->breaks() == std::vector{0.0, junction, track->length()});
  const Motion ride(track, Body{problem.friction, problem.entry_speed, 0.0});
  CHECK(std::fabs(ride.at(0.5 * junction).normal_load) <= 1e-12 * kDefaultGravity);
  CHECK(ride.at(junction).normal_load > kDefaultGravity);
  const CenterlinePoint end = track->at(junction);
  CHECK(end.x == Approx(track->solution().flight.run).epsilon(1e-13));
  CHECK(end.drop == Approx(track->solution().flight.drop).epsilon(1e-13));
  CHECK(end.slope_angle == Approx(track->solution().flight_end_slope_angle.radians()).epsilon(1e-13));
  CHECK(end.curvature > 0.0);
  CHECK(track->at(std::nextafter(junction, 0.0)).curvature < 0.0);
}

TEST_CASE("fastest track with an entry speed: mirrored, scaled and vertical") {
  const Friction friction = Friction::from_coefficient(0.25);
  const FlyingStartSolution right = solve_flying_start({8.0, 3.0}, friction, 4.0);
  const FlyingStartSolution left = solve_flying_start({-8.0, 3.0}, friction, 4.0);
  CHECK(right.travel_time == left.travel_time);
  CHECK(right.entry_slope_angle.radians() == left.entry_slope_angle.radians());
  const FlyingStartSolution large = solve_flying_start({800.0, 300.0}, friction, 40.0);
  CHECK(large.travel_time == Approx(10.0 * right.travel_time).epsilon(1e-13));
  for (const double drop : {3.0, -0.8}) {
    INFO(drop);
    const FlyingStartBrachistochrone vertical({0.0, drop}, friction, 4.0);
    CHECK(vertical.length() == std::fabs(drop));
    CHECK(vertical.at(vertical.length()).drop == drop);
    const double exit = std::sqrt(16.0 + 2.0 * kDefaultGravity * drop);
    CHECK(vertical.solution().exit_speed == Approx(exit).epsilon(1e-14));
    CHECK(vertical.solution().travel_time == Approx(std::fabs(exit - 4.0) / kDefaultGravity).epsilon(1e-13));
    const FlyingStartSolution nearly = solve_flying_start({1e-6, drop}, friction, 4.0);
    CHECK(nearly.travel_time == Approx(vertical.solution().travel_time).epsilon(1e-5));
  }
}

TEST_CASE("reach theorem with an entry speed: no ride ever comes beyond it") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  double nearest = HUGE_VAL;
  for (int i = 0; i < 400; ++i) {
    const Friction friction = Friction::from_coefficient(random.between(0.02, 1.0));
    std::vector<ClothoidSegment> segments;
    for (int k = 0; k < 6; ++k) {
      segments.push_back({random.between(0.1, 2.0), random.between(-0.6, 0.6), random.between(-0.6, 0.6)});
    }
    const auto track =
        std::make_shared<const ClothoidSpline>(Angle::from_radians(random.between(-1.2, 1.0)), segments);
    const double speed = random.between(0.5, 8.0);
    const Motion ride(track, Body{friction, speed, 0.0});
    const double height = 0.5 * speed * speed / kDefaultGravity;
    for (int k = 1; k <= 20; ++k) {
      const CenterlinePoint point = track->at(std::min(ride.distance() * (k / 20.0), ride.distance()));
      // In the frame of the reach theorem a finish lies ahead.
      const double least = least_drop(std::fabs(point.x), friction, speed);
      nearest = std::min(nearest, (point.drop - least) / (height + point.arc_length));
      CHECK(point.drop >= least - 1e-9 * (height + point.arc_length));
    }
  }
  CHECK(nearest < 0.2);
}

TEST_CASE("reach theorem with an entry speed: just within it a track arrives, nearly at rest") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (int i = 0; i < 100; ++i) {
    Problem problem = random_problem(random);
    if (problem.friction.coefficient() < 0.1) continue;
    const double unit = problem.entry_speed * problem.entry_speed / kDefaultGravity;
    problem.endpoints.run = unit * random.between(0.1, 5.0);
    const double least = least_drop(problem.endpoints.run, problem.friction, problem.entry_speed);
    problem.endpoints.drop = least + 1e-6 * unit;
    INFO(describe(problem));
    CHECK(least_entry_speed({problem.endpoints.run, least}, problem.friction) ==
          Approx(problem.entry_speed).epsilon(1e-9));
    const auto track = curve(problem);
    CHECK(track->solution().exit_speed < 5e-3 * problem.entry_speed);
    // Then nearly straight, after a flight that turns by 45 deg + delta/2: short of that by the root of what the drop is beyond the
    // least, and more where the flight is most of the way.
    const double short_of = 1e-3 + 3.0 * std::sqrt(1e-6 * unit / problem.endpoints.run);
    CHECK(track->solution().flight_end_slope_angle.radians() -
              track->solution().entry_slope_angle.radians() ==
          Approx(0.25 * std::numbers::pi + 0.5 * problem.friction.angle().radians()).margin(short_of));
    problem.endpoints.drop = least - 1e-9 * unit;
    CHECK_THROWS_AS(solve(problem), InfeasibleError);
  }
}

TEST_CASE("fastest track with an entry speed: what it cannot do is refused by name") {
  const Friction friction = Friction::from_coefficient(0.2);
  const auto message = [&](const Endpoints& endpoints, double speed) -> std::string {
    try {
      (void)solve_flying_start(endpoints, friction, speed);
    } catch (const Error& error) {
      return error.what();
    }
    return {};
  };
  CHECK_THAT(message({10.0, -2.0}, 5.0), contains_text("entry_speed: 5 m/s is not more than the") &&
                                             contains_text("m/s") && contains_text("an entry_speed above"));
  CHECK_THAT(message({10.0, 5.0}, 0.0), contains_text("entry_speed: 0 m/s is not a finite speed above 0"));
  CHECK_THAT(message({0.0, 0.0}, 5.0), contains_text("Start and finish are the same point"));
  CHECK_THAT(message({NAN, 1.0}, 5.0), contains_text("run: "));
  // Next to the limit of what rest reaches there is no speed of 0 to exceed.
  CHECK_THAT(message({10.0, 2.0}, 1e-30),
             contains_text("entry_speed: 1e-30 m/s is not more than the 1e-30 m/s"));
  CHECK_THAT(message({10.0, -1e-40}, 1e-30), contains_text("entry_speed: 1e-30 m/s is not more than the"));
}

TEST_CASE("reach theorem: what is out of its domain is refused") {
  const Friction friction = Friction::from_coefficient(0.3);
  for (const double gravity : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
    CHECK_THROWS_AS(least_entry_speed({30.0, 2.0}, friction, gravity), InputError);
    CHECK_THROWS_AS(least_drop(3.0, friction, 1.0, gravity), InputError);
    CHECK_THROWS_AS(can_arrive({3.0, 2.0}, friction, 1.0, gravity), InputError);
  }
  for (const double speed : {-1.0, std::nan(""), HUGE_VAL}) {
    CHECK_THROWS_AS(least_drop(3.0, friction, speed), InputError);
    CHECK_THROWS_AS(can_arrive({3.0, 2.0}, friction, speed), InputError);
  }
  CHECK_THROWS_AS(least_entry_speed({std::nan(""), 2.0}, friction), InputError);
  for (const double gravity : {1e308, 1e-101}) {
    CHECK_THROWS_WITH(
        least_entry_speed({30.0, 2.0}, friction, gravity),
        contains_text(" m/s^2 is out of range") && contains_text("Between 1e-100 and 1e+100 m/s^2"));
  }
  // Ways scale as squares of speeds, up to the largest numbers.
  const double unit = least_entry_speed({1.0, -1.0}, friction);
  for (const double size : {1e300, 1e308}) {
    CHECK(least_entry_speed({size, -size}, friction) / std::sqrt(size) == Approx(unit).epsilon(1e-14));
  }
  CHECK_THROWS_AS(least_drop(HUGE_VAL, friction, 1.0), InputError);
  CHECK_THROWS_AS(can_arrive({3.0, std::nan("")}, friction, 1.0), InputError);
  CHECK(least_drop(3.0, friction, 1e155) == -HUGE_VAL);
  CHECK(can_arrive({3.0, -1e300}, friction, 1e155));
}

TEST_CASE(
    "fastest track: an entry speed below 0 or not finite is refused as such, 0 being a start from rest") {
  const Friction friction = Friction::from_coefficient(0.1);
  CHECK_NOTHROW(fastest_track({3.0, 2.0}, friction, 0.0));
  for (const double speed : {-1.0, std::nan(""), HUGE_VAL}) {
    CHECK_THROWS_WITH(fastest_track({3.0, 2.0}, friction, speed),
                      Catch::Matchers::Contains("m/s is negative or not finite") &&
                          !Catch::Matchers::Contains("From rest"));
    CHECK_THROWS_WITH(fastest_travel_time({3.0, 2.0}, friction, speed),
                      Catch::Matchers::Contains("m/s is negative or not finite"));
  }
}

}  // namespace flying_start_test
