#include "glissade/trades/ski_jump/gates.hpp"

#include "glissade/centerline/clothoid_spline.hpp"
#include "glissade/centerline/in_run.hpp"
#include "glissade/core/error.hpp"
#include "glissade/motion/laws/rider.hpp"
#include "glissade/trades/ski_jump/sizing.hpp"

#include "support/catch.hpp"
#include "support/random.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace gates_test {

using namespace glissade;
using Catch::Matchers::Contains;

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kGravity = 9.81;

InRunShape garmisch(InRunTransition transition = InRunTransition::cubic) {
  return {Angle::from_degrees(35.0), Angle::from_degrees(11.0), 103.0, 6.9, 102.9, transition, 0.0};
}

CenterlinePtr garmisch_track(InRunTransition transition = InRunTransition::cubic) {
  return std::make_shared<const InRun>(garmisch(transition));
}

Body skier(double mu, double drag) {
  Body body;
  body.friction = Friction::from_coefficient(mu);
  body.drag_per_metre = drag;
  return body;
}

/// v = u^2 after a straight, in closed form.
double after_straight(double v, double slope, double length, double mu, double k) {
  const double a = 2.0 * kGravity * (std::sin(slope) - mu * std::cos(slope));
  if (k == 0.0) return v + a * length;
  const double left = std::exp(-2.0 * k * length);
  return v * left + a / (2.0 * k) * (1.0 - left);
}

/// The same after the cubic bend, by classical Runge-Kutta in xi along its tangent: no arc length, no panels.
double after_bend(double v, const InRunShape& shape, double mu, double k) {
  const double gamma = shape.gamma.radians();
  const double turn = gamma - shape.alpha.radians();
  const double d = 2.0 * shape.r1 * std::sin(turn) * std::pow(std::cos(turn), 2.0);
  const double c = std::tan(turn) / (3.0 * d * d);
  const auto rate = [&](double xi, double value) {
    const double slope = 3.0 * c * xi * xi;
    const double stretch = std::sqrt(1.0 + slope * slope);
    const double zeta = gamma - std::atan(slope);
    const double kappa = 6.0 * c * xi / (stretch * stretch * stretch);
    const double load = kGravity * std::cos(zeta) + kappa * value;
    return stretch * 2.0 * (kGravity * std::sin(zeta) - mu * load - k * value);
  };
  constexpr int kSteps = 4000;
  const double h = d / kSteps;
  for (int i = 0; i < kSteps; ++i) {
    const double xi = i * h;
    const double k1 = rate(xi, v);
    const double k2 = rate(xi + 0.5 * h, v + 0.5 * h * k1);
    const double k3 = rate(xi + 0.5 * h, v + 0.5 * h * k2);
    const double k4 = rate(xi + h, v + h * k3);
    v += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
  }
  return v;
}

}  // namespace

TEST_CASE(
    "rides of an in-run from its certificate give another program's speeds and loads, as far as that is "
    "exact") {
  struct Reference {
    InRunTransition transition;
    double mu, drag, edge, ten_before, at_e2, load;
  };
  // Worked out by another program to some 1e-4, as its frictionless speeds show: sqrt(2 g drop) is 30.40048 and 29.97261
  // m/s where it has 30.4004 and 29.9726. Load over weight.
  const std::vector<Reference> references = {
      {InRunTransition::cubic, 0.0, 0.0, 30.4004, 29.7633, 29.9726, 1.8707},
      {InRunTransition::cubic, 0.03, 0.0, 29.2200, 28.6834, 28.8437, 1.8050},
      {InRunTransition::cubic, 0.03, 0.0013, 27.0665, 26.8370, 26.9038, 1.6980},
      {InRunTransition::cubic, 0.05, 0.0013, 26.3196, 26.1526, 26.1897, 1.6604},
      {InRunTransition::circle, 0.03, 0.0013, 27.4533, 27.2380, 27.2999, 1.7192},
      {InRunTransition::clothoid, 0.03, 0.0013, 26.6541, 26.4088, 26.4813, 1.6756}};
  constexpr double kLastDigit = 1.5e-4;
  for (const Reference& reference : references) {
    CAPTURE(static_cast<int>(reference.transition), reference.mu, reference.drag);
    const CenterlinePtr track = garmisch_track(reference.transition);
    const Motion motion(track, skier(reference.mu, reference.drag), kGravity);
    CHECK(std::fabs(motion.exit_speed() - reference.edge) <= kLastDigit);
    CHECK(std::fabs(motion.at(track->length() - 10.0).speed - reference.ten_before) <= kLastDigit);
    CHECK(std::fabs(motion.at(track->length() - 6.9).speed - reference.at_e2) <= kLastDigit);
    CHECK(std::fabs(motion.highest_load().normal_load / kGravity - reference.load) <= kLastDigit);
  }
}

TEST_CASE("without friction and drag the speed is that of the drop, and the load that of the speed") {
  const CenterlinePtr track = garmisch_track();
  const Motion motion(track, skier(0.0, 0.0), kGravity);
  CHECK(motion.exit_speed() == Approx(std::sqrt(2.0 * kGravity * track->endpoints().drop)).epsilon(1e-13));
  // composite Simpson of the arc length in 200 000 steps, then sqrt(2 g drop)
  CHECK(motion.exit_speed() == Approx(30.400476330560).epsilon(1e-11));
  CHECK(motion.at(96.0).speed == Approx(29.972614516402).epsilon(1e-11));
  CHECK(motion.highest_load().normal_load / kGravity == Approx(1.8707116533752).epsilon(1e-11));
}

TEST_CASE("another method, another code path: the speed at the edge to 1e-9") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (int i = 0; i < 20; ++i) {
    InRunShape shape = garmisch();
    shape.r1 = random.between(40.0, 110.0);
    shape.gamma = Angle::from_degrees(random.between(30.0, 38.0));
    shape.alpha = Angle::from_degrees(random.between(8.0, 12.0));
    shape.length = 110.0;
    const double mu = random.between(0.0, 0.08);
    const double k = random.between(0.0, 0.002);
    CAPTURE(shape.r1, shape.gamma.degrees(), shape.alpha.degrees(), mu, k);
    const InRun in_run(shape);
    double v = after_straight(0.0, shape.gamma.radians(), in_run.transition_begins(), mu, k);
    v = after_bend(v, shape, mu, k);
    v = after_straight(v, shape.alpha.radians(), shape.t, mu, k);
    const Motion motion(std::make_shared<const InRun>(shape), skier(mu, k), kGravity);
    CHECK(std::fabs(motion.exit_speed() / std::sqrt(v) - 1.0) < 1e-9);
  }
}

TEST_CASE("gates fill the start area evenly, or follow each other by a step from its lowest place") {
  const std::vector<Gate> even = even_gates(102.9, 24.0, 49);
  REQUIRE(even.size() == 49);
  CHECK(even.front().number == 1);
  CHECK(even.front().to_edge == Approx(78.9).epsilon(1e-14));
  CHECK(even.back().from_start == 0.0);
  CHECK(even[1].to_edge - even[0].to_edge == Approx(0.5).epsilon(1e-12));
  CHECK(even_gates(102.9, 24.0, 1).front().from_start == 24.0);
  const std::vector<Gate> stepped = stepped_gates(102.9, 24.0, 0.7);
  CHECK(stepped.size() == 35);
  CHECK(stepped.front().from_start == 24.0);
  CHECK(stepped.back().from_start == Approx(24.0 - 34 * 0.7).epsilon(1e-12));
  CHECK(stepped_gates(102.9, 24.0, 0.5).size() == 49);
  CHECK(stepped_gates(102.9, 24.0, 0.5).back().from_start == 0.0);
  // 23.1 times 24 over 24 is 3.6e-15 more than 23.1.
  CHECK(even_gates(102.9, 23.1, 25).back().from_start == 0.0);
  for (int count = 2; count < 80; ++count) {
    for (int tenth = 1; tenth < 600; ++tenth) {
      const std::vector<Gate> gates = even_gates(102.9, 0.1 * tenth, count);
      REQUIRE(gates.back().from_start == 0.0);
      REQUIRE(gates.back().to_edge == 102.9);
      REQUIRE(gates.front().from_start == 0.1 * tenth);
    }
  }
  CHECK_THROWS_WITH(even_gates(20.0, 24.0, 3),
                    Contains("the start area, 24 m, does not fit an in-run of 20 m"));
  CHECK_THROWS_AS(stepped_gates(102.9, 24.0, 0.0), InputError);
  CHECK_THROWS_AS(stepped_gates(102.9, 24.0, 1e-9), InputError);
}

TEST_CASE("gates a step in height apart are so on a start area that bends, too") {
  const double entry = 38.0 * kDegree;
  const double turn = 23.0 * kDegree;
  const ClothoidSpline arc(Angle::from_radians(entry),
                           {{60.0 * turn, 1.0 / 60.0, 1.0 / 60.0}, {6.0, 0.0, 0.0}});
  const double lowest = arc.at(15.0).drop;
  const std::vector<Gate> gates = gates_by_height(arc, 15.0, 1.3);
  REQUIRE(gates.size() == 6);
  for (const Gate& gate : gates) {
    const double drop = lowest - 1.3 * (gate.number - 1);
    CHECK(std::fabs(arc.at(gate.from_start).drop - drop) < 1e-11);
    // cos(zeta) of the place is that of the start and drop/R.
    CHECK(gate.from_start ==
          Approx(60.0 * (entry - std::acos(std::cos(entry) + drop / 60.0))).epsilon(1e-10));
    CHECK(gate.from_start + gate.to_edge == Approx(arc.length()).epsilon(1e-14));
  }
  // A height of whole steps ends at the start.
  CHECK(gates_by_height(arc, 15.0, lowest / 8.0).size() == 9);
  CHECK(gates_by_height(arc, 15.0, lowest / 8.0).back().from_start == 0.0);
  // On a straight they are steps along it.
  const std::vector<Gate> straight = gates_by_height(*garmisch_track(), 24.0, 0.4);
  const std::vector<Gate> along = stepped_gates(102.9, 24.0, 0.4 / std::sin(35.0 * kDegree));
  REQUIRE(straight.size() == along.size());
  for (std::size_t i = 0; i < along.size(); ++i)
    CHECK(std::fabs(straight[i].from_start - along[i].from_start) < 1e-11);
  CHECK_THROWS_WITH(gates_by_height(arc, 15.0, 0.0), Contains("vertical_step: 0 mm is out of range"));
  const ClothoidSpline hump(Angle::from_degrees(-5.0), {{40.0, -0.02, -0.02}, {6.0, 0.0, 0.0}});
  CHECK_THROWS_WITH(gates_by_height(hump, 20.0, 0.4), Contains("the track rises within the start area"));
}

TEST_CASE(
    "a ride from a gate is that from the start less what the start had won, since the equation is linear") {
  const CenterlinePtr track = garmisch_track();
  const Body body = skier(0.03, 0.0013);
  const Motion from_top(track, body, kGravity);
  const std::vector<Gate> gates = even_gates(track->length(), 24.0, 49);
  const std::vector<GateRide> rides = ride_gates(track, gates, body, 10.0, kGravity);
  double before = 0.0;
  for (const GateRide& ride : rides) {
    CAPTURE(ride.gate.number);
    const double turned = track->slope_angle(ride.gate.from_start) - 11.0 * kDegree;
    const double left = std::exp(-2.0 * 0.03 * turned - 2.0 * 0.0013 * ride.gate.to_edge);
    const double at_gate = from_top.at(ride.gate.from_start).speed;
    const double v = from_top.exit_speed() * from_top.exit_speed() - at_gate * at_gate * left;
    CHECK(ride.arrived);
    CHECK(std::fabs(ride.speed_at_edge / std::sqrt(v) - 1.0) < 1e-11);
    CHECK(ride.speed_at_edge > before);
    CHECK(ride.speed_at_measuring_place < ride.speed_at_edge);
    CHECK(ride.lowest_load > 0.0);
    before = ride.speed_at_edge;
  }
  CHECK(rides.back().travel_time == from_top.travel_time());
  CHECK(rides.back().highest_load_at == Approx(96.0).epsilon(1e-9));
  const double at_e2 = from_top.at(96.0).speed;
  CHECK(rides.back().highest_radial == Approx(at_e2 * at_e2 / 103.0).epsilon(1e-9));
  CHECK(rides.back().highest_radial_at == Approx(96.0).epsilon(1e-9));
}

TEST_CASE("of a steep in-run the highest radial acceleration lies before E2, where the bend is sharpest") {
  InRunShape shape{
      Angle::from_degrees(38.6), Angle::from_degrees(10.5), 95.55, 6.45, 96.35, InRunTransition::cubic, 0.0};
  const auto track = std::make_shared<const InRun>(shape);
  const std::vector<GateRide> rides =
      ride_gates(track, even_gates(track->length(), 16.75, 2), skier(0.03, 0.0013), 10.0, kGravity);
  for (const GateRide& ride : rides) {
    CHECK(ride.highest_radial_at < track->table_begins() - 0.5);
    const Motion motion = ride_from(track, ride.gate.from_start, skier(0.03, 0.0013), kGravity);
    double most = 0.0;
    for (int i = 0; i < 4000; ++i) {
      const double s = track->table_begins() * i / 4000.0 - ride.gate.from_start;
      if (s < 0.0) continue;
      const MotionState state = motion.at(s);
      most = std::max(most, state.speed * state.speed * track->direction(s + ride.gate.from_start).curvature);
    }
    CHECK(std::fabs(ride.highest_radial / most - 1.0) < 1e-6);
  }
}

TEST_CASE("the derivatives of a speed are what differences of rides say") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (const bool upright : {false, true}) {
    for (int i = 0; i < 6; ++i) {
      Body body = skier(random.between(0.01, 0.08), random.between(0.0005, 0.002));
      if (upright) body.law = std::make_shared<const Rider>(0.6);
      const CenterlinePtr track = garmisch_track();
      const double start = random.between(1.0, 24.0);
      const double place = random.between(30.0, 102.9);
      CAPTURE(upright, start, place, body.friction.coefficient(), body.drag_per_metre);
      const auto speed = [&](double mu, double k, double from) {
        Body other = body;
        other.friction = Friction::from_coefficient(mu);
        other.drag_per_metre = k;
        return ride_from(track, from, other, kGravity).at(place - from).speed;
      };
      const double mu = body.friction.coefficient();
      const double k = body.drag_per_metre;
      const SpeedSlopes slopes = speed_slopes(track, start, place, body, kGravity);
      CHECK(slopes.by_friction ==
            Approx((speed(mu + 1e-4, k, start) - speed(mu - 1e-4, k, start)) / 2e-4).epsilon(1e-6));
      CHECK(slopes.by_drag ==
            Approx((speed(mu, k + 1e-6, start) - speed(mu, k - 1e-6, start)) / 2e-6).epsilon(1e-6));
      CHECK(slopes.by_length ==
            Approx((speed(mu, k, start - 1e-3) - speed(mu, k, start + 1e-3)) / 2e-3).epsilon(1e-6));
      // Wind that is next to none takes the other way to the same derivatives.
      Body blown = body;
      blown.head_wind = 1e-12;
      const SpeedSlopes other = speed_slopes(track, start, place, blown, kGravity);
      CHECK(other.by_friction == Approx(slopes.by_friction).epsilon(1e-6));
      CHECK(other.by_drag == Approx(slopes.by_drag).epsilon(1e-6));
      CHECK(other.by_length == Approx(slopes.by_length).epsilon(1e-6));
    }
  }
}

TEST_CASE("the derivative by friction moves all frictions along the track alike, one of none too") {
  const CenterlinePtr track = garmisch_track();
  const double place = 90.0;
  for (const double least : {0.0, 3e-5, 0.02}) {
    CAPTURE(least);
    const auto with = [&](double change) {
      Body body = skier(0.04 + change, 0.0013);
      body.friction_changes = {{30.0, Friction::from_coefficient(least + change)},
                               {60.0, Friction::from_coefficient(0.05 + change)}};
      return body;
    };
    const auto speed = [&](double change) {
      return ride_from(track, 0.0, with(change), kGravity).at(place).speed;
    };
    const double step = 2e-5;  // below the least friction that is not 0
    const double less = std::min(step, least);
    const double slope = (speed(step) - speed(-less)) / (step + less);
    CHECK(speed_slopes(track, 0.0, place, with(0.0), kGravity).by_friction == Approx(slope).epsilon(1e-3));
  }
}

TEST_CASE("more friction, more drag or head wind make every gate slower, a longer in-run faster") {
  const CenterlinePtr track = garmisch_track();
  const std::vector<Gate> gates = even_gates(track->length(), 24.0, 5);
  const auto rides = [&](const Body& body) { return ride_gates(track, gates, body, 10.0, kGravity); };
  const std::vector<GateRide> base = rides(skier(0.03, 0.0013));
  Body windy = skier(0.03, 0.0013);
  windy.head_wind = 2.0;
  const std::vector<GateRide> head = rides(windy);
  windy.head_wind = -2.0;
  const std::vector<GateRide> tail = rides(windy);
  const std::vector<GateRide> rough = rides(skier(0.05, 0.0013));
  for (std::size_t i = 0; i < gates.size(); ++i) {
    CHECK(head[i].speed_at_edge < base[i].speed_at_edge);
    CHECK(tail[i].speed_at_edge > base[i].speed_at_edge);
    CHECK(rough[i].speed_at_edge < base[i].speed_at_edge);
    CHECK(base[i].slopes->by_friction < 0.0);
    CHECK(base[i].slopes->by_drag < 0.0);
    CHECK(base[i].slopes->by_length > 0.0);
  }
}

TEST_CASE("a body that stalls or starts below the measuring place is told so, not guessed") {
  const CenterlinePtr track = garmisch_track();
  const std::vector<Gate> gates = even_gates(track->length(), 24.0, 2);
  const std::vector<GateRide> stuck = ride_gates(track, gates, skier(0.9, 0.0), 10.0, kGravity);
  CHECK_FALSE(stuck.front().arrived);
  CHECK_FALSE(stuck.front().speed_at_measuring_place.has_value());
  const std::vector<GateRide> above = ride_gates(track, gates, skier(0.03, 0.0), 90.0, kGravity);
  CHECK(above.front().arrived);
  CHECK(above.front().speed_at_edge > 0.0);
  CHECK_FALSE(above.front().speed_at_measuring_place.has_value());
  CHECK_FALSE(above.front().slopes.has_value());
  CHECK(above.back().speed_at_measuring_place > 0.0);
  CHECK(above.back().slopes.has_value());
  // A gate at the place itself has not passed it.
  CHECK_FALSE(passes(gates.front(), gates.front().to_edge));
  CHECK_FALSE(gate_for_speed(above, 1.0).has_value());
}

TEST_CASE("a measuring place that no gate's ride passes is refused") {
  const CenterlinePtr track = garmisch_track();
  const std::vector<Gate> gates = even_gates(track->length(), 24.0, 2);
  const auto rides = [&](double place) {
    return ride_gates(track, gates, skier(0.03, 0.0), place, kGravity);
  };
  CHECK_THROWS_WITH(rides(300.0), Contains("300 m before the edge no ride of this line passes") &&
                                      Contains("102.9 m before it"));
  CHECK_THROWS_AS(rides(track->length()), InputError);
  CHECK_THROWS_WITH(rides(-1.0), Contains("measuring_place: -1 m is out of range"));
  CHECK_NOTHROW(rides(102.0));
}

TEST_CASE("the gate for a speed lies between those that are slower and faster") {
  const CenterlinePtr track = garmisch_track();
  const std::vector<GateRide> rides =
      ride_gates(track, even_gates(track->length(), 24.0, 49), skier(0.03, 0.0013), 10.0, kGravity);
  CHECK(gate_for_speed(rides, *rides[10].speed_at_measuring_place) == 11.0);
  const double between = 0.5 * (*rides[10].speed_at_measuring_place + *rides[11].speed_at_measuring_place);
  CHECK(*gate_for_speed(rides, between) == Approx(11.5).epsilon(1e-9));
  CHECK_FALSE(gate_for_speed(rides, 10.0).has_value());
  CHECK_FALSE(gate_for_speed(rides, 40.0).has_value());
}

TEST_CASE("suggested K points are of the class of their hill size, and grow with it") {
  // IWO 411.1: small up to HS 49 and K 44, medium to 84 and 74, normal to 109 and 99, large, flying from 185 and 170 on.
  const auto class_of = [](double value, const std::array<double, 4>& from) {
    return std::count_if(from.begin(), from.end(), [&](double one) { return value >= one; });
  };
  double before = 0.0;
  for (int half_metres = 20; half_metres <= 520; ++half_metres) {
    const double hill_size = 0.5 * half_metres;
    CAPTURE(hill_size);
    const double point = suggested_in_run(hill_size).construction_point;
    CHECK(class_of(point, {45.0, 75.0, 100.0, 170.0}) == class_of(hill_size, {50.0, 85.0, 110.0, 185.0}));
    CHECK(point >= before);
    CHECK(point < hill_size);
    before = point;
  }
  for (const auto& [size, certified] :
       {std::pair{38.0, 35.0}, {66.0, 60.0}, {97.0, 90.0}, {106.0, 95.0}, {140.0, 125.0}, {240.0, 200.0}})
    CHECK(suggested_in_run(size).construction_point == certified);
}

TEST_CASE("suggested sizes hold the rules that they come from, for every hill") {
  for (double hill_size = kSmallestHill; hill_size <= kLargestHill; hill_size += 7.0) {
    CAPTURE(hill_size);
    const InRunSizes sizes = suggested_in_run(hill_size);
    const double v0 = sizes.design_speed;
    CHECK(sizes.t >= 0.25 * v0 * (1.0 - 1e-12));
    CHECK(sizes.t < 0.25 * v0 + 0.05);
    CHECK(sizes.r1 >= 0.14 * v0 * v0 * (1.0 - 1e-12));
    CHECK(sizes.r1 < 0.14 * v0 * v0 + 0.5);
    CHECK(sizes.es * std::sin(sizes.gamma.radians()) / (sizes.gates - 1) <= 0.40);
    const InRunShape shape{
        sizes.gamma, sizes.alpha, sizes.r1, sizes.t, sizes.e1 + sizes.t, InRunTransition::cubic, 0.0};
    const InRun in_run(shape);
    CHECK(sizes.es < in_run.transition_begins());
    const Motion slow(std::make_shared<const InRun>(shape), skier(kSlowFriction, kInRunDrag));
    CHECK(slow.exit_speed() >= v0);
  }
  // certificates: Almaty HS106 t 6.58 m, r1 96.87 m; HS140 t 6.82 m, r1 104.04 m
  CHECK(suggested_in_run(106.0).t == Approx(6.6).epsilon(1e-12));
  CHECK(suggested_in_run(106.0).r1 == 97.0);
  CHECK(suggested_in_run(140.0).r1 == Approx(104.5).epsilon(1e-12));
  CHECK_THROWS_WITH(suggested_in_run(5.0), Contains("a hill size of 5 m is out of range"));
}

}  // namespace gates_test
