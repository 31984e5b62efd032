// The transcription's gradients against complex steps through a quadrature of the test's own in long double;
// they and the Hessian against central differences carried out in the unknowns, and the limits' rows
// likewise. Steps and differences are the test's; the product has none.

#include "glissade/motion/laws/bulk_stream.hpp"
#include "glissade/motion/laws/rolling_ball.hpp"

#include "optimize/differences.hpp"
#include "optimize/discretise/transcription.hpp"
#include "optimize/places.hpp"
#include "optimize/problem/rows.hpp"
#include "optimize/problem/scaled_problem.hpp"
#include "support/catch.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <memory>
#include <string>
#include <vector>

#include <boost/math/quadrature/gauss.hpp>

namespace derivatives_test {

using namespace glissade;
using namespace glissade::optimizer;

namespace {

struct Setup {
  ScaledProblem problem;
  Mesh mesh;
  Vector z;
};

/// What rides in a test, and with which name.
struct Rider {
  std::string name;
  double entry_speed = 0.0;
  LawPtr law;
  double head_wind = 0.0;
  ObjectiveKind objective = ObjectiveKind::travel_time;
  bool lands = false;
};

std::vector<Rider> riders() {
  BallShape ball;
  ball.radius = 0.3;
  ball.groove_half_angle = Angle::from_degrees(50.0);
  StreamShape stream;
  stream.mass_flow = 500.0;
  stream.bulk_density = 1000.0;
  stream.width = WidthLaw({{0.0, 1.0}, {30.0, 0.7}});
  return {{"point from rest", 0.0, nullptr},
          {"point", 2.5, nullptr},
          {"ball from rest", 0.0, std::make_shared<const RollingBall>(ball)},
          {"ball", 2.5, std::make_shared<const RollingBall>(ball)},
          {"wind", 2.5, nullptr, 3.0},
          {"lowest", 2.5, nullptr, 0.0, ObjectiveKind::least_drop},
          {"shortest", 2.5, nullptr, 0.0, ObjectiveKind::least_length},
          {"stream", 2.5, std::make_shared<const BulkStream>(stream)},
          {"even stream", 2.5, std::make_shared<const BulkStream>(stream), 0.0, ObjectiveKind::even_speed},
          {"landing stream", 3.5, std::make_shared<const BulkStream>(stream), 0.0, ObjectiveKind::travel_time,
           true}};
}

Setup make_setup(const Rider& rider, PlacesFrom from = PlacesFrom::start) {
  Problem given;
  given.endpoints = {10.0, 5.0};
  const double entry_speed = rider.entry_speed;
  given.body = {Friction::from_coefficient(0.2), entry_speed, 0.01};
  given.body.law = rider.law;
  given.body.head_wind = rider.head_wind;
  given.high_friction = Friction::from_coefficient(0.3);
  Limits& limits = given.limits;
  limits.lead_in = entry_speed > 0.0 ? 0.7 : 0.0;
  limits.lead_out = 1.1;
  limits.slope_angle.highest = 1.4;
  limits.smallest_valley_radius = 3.0;
  limits.smallest_crest_radius = 2.0;
  limits.highest_curvature_rate = 0.5;
  limits.highest_normal_load = 20.0;
  limits.highest_curvature_load = 10.0;
  limits.speed.highest = 8.0;
  limits.speed.lowest = 1.0;
  limits.lowest_speed_from = 5.0;
  limits.exit_speed.lowest = 2.0;
  limits.arc_length.highest = 14.0;
  limits.half_planes.push_back({{0.0, 1.0}, {-0.5, 1.0}, 0.1});
  limits.stay_above.push_back({{{1.0, 4.0}, {4.0, 5.0}, {7.0, 6.5}}, 0.2});
  limits.waypoints.push_back({5.0, 3.6});
  limits.lowest_slope_margin = -0.4;
  limits.match_belt = BeltMatch{3.0, Angle::from_radians(0.4), 0.1};
  if (rider.law && rider.law->kind() == "stream") {
    limits.highest_burden_depth = 0.3;
    limits.highest_floor_wear = 2500.0;
  }
  given.objective.kind = rider.objective;
  if (rider.lands) given.body.landing = Landing{entry_speed, Angle::from_radians(1.4)};
  limits.exit_speed.highest = 9.0;
  Setup setup;
  if (from == PlacesFrom::finish) given = testing::counted_from_finish(given, {10.0, 5.0});
  setup.problem = scaled(given, {});
  setup.mesh.knots = {0.0, 0.1, 0.25, 0.5, 0.8, 1.0};
  setup.mesh.extra_breaks = {0.33};
  // On a track that is shorter than the mesh was laid for.
  setup.mesh.held_from = setup.problem.lowest_speed_from;
  setup.mesh.lead_in = setup.problem.lead_in;
  setup.mesh.lead_out = setup.problem.lead_out;
  setup.mesh.core_length = 0.95;
  setup.mesh.entry_speed2 = setup.problem.entry_speed2;
  setup.z = {1.1, 0.3, 1.1, 0.9, 0.7, 1.2, 0.4, 0.9};
  return setup;
}

/// The same with fine knots, whose turning rates are no unknowns.
Setup make_fine_setup(const Rider& rider) {
  Setup setup = make_setup(rider);
  setup.mesh.fine = {0.15, 0.2, 0.6, 0.7};
  setup.mesh.fine_turns = {0.2, -0.3, 0.15, 0.1};
  return setup;
}

/// The same on a track that rubs differently along the straights, at two knots of the core, and from a place on that no
/// track reaches.
Setup make_changing_setup(const Rider& rider) {
  Setup setup = make_fine_setup(rider);
  Mesh& mesh = setup.mesh;
  const double core_end = mesh.lead_in + mesh.core_length;
  if (mesh.lead_in > 0.0) mesh.changes.push_back(0.4 * mesh.lead_in);
  for (const double sigma : {mesh.knots[1], mesh.knots[3]}) {
    mesh.changes.push_back(mesh.lead_in + sigma * mesh.core_length);
    mesh.change_knots.push_back({sigma, sigma, sigma, false});
  }
  for (const double place : {core_end + 0.2 * mesh.lead_out, core_end + 0.7 * mesh.lead_out, 100.0})
    mesh.changes.push_back(place);
  setup.problem.changes = mesh.changes;
  for (Ride& ride : setup.problem.rides) {
    for (std::size_t i = 0; i < mesh.changes.size(); ++i)
      ride.later_frictions.push_back(0.25 + 0.15 * std::cos(2.0 * static_cast<double>(i)));
  }
  return setup;
}

/// The same with fine knots on a core of three spans, whose curvature jumps where they meet.
Setup make_parted_setup(const Rider& rider, PlacesFrom from = PlacesFrom::start) {
  Setup setup = make_setup(rider, from);
  setup.mesh.knots = {0.0, 0.1, 0.25, 0.25, 0.5, 0.8, 0.8, 1.0};
  setup.mesh.borders = {0.25, 0.8};
  setup.mesh.fine = {0.15, 0.2, 0.6, 0.7};
  setup.mesh.fine_turns = {0.2, -0.3, 0.15, 0.1};
  setup.z = {1.1, 0.3, 1.1, 0.9, 1.3, 0.7, 1.2, 0.8, 0.4, 0.9, 1.05, 0.8};
  return setup;
}

/// Every rider, on plain knots and with fine ones; one of each way to ride where friction changes; on spans all whose
/// ride does not know how far it has come.
std::vector<Setup> setups() {
  std::vector<Setup> all;
  for (const Rider& rider : riders()) {
    all.push_back(make_setup(rider));
    all.push_back(make_fine_setup(rider));
    const bool one_of_each =
        rider.name == "point" || rider.name == "ball from rest" || rider.name == "stream";
    if (one_of_each) all.push_back(make_changing_setup(rider));
    if (!rider.law || rider.law->kind() != "stream") all.push_back(make_parted_setup(rider));
  }
  all.push_back(make_setup(riders()[1], PlacesFrom::finish));
  all.push_back(make_parted_setup(riders()[1], PlacesFrom::finish));
  return all;
}

using Complex = std::complex<long double>;

struct RideEnd {
  Complex time;
  Complex speed2;
};

/// The ride from rest by its own quadrature: w' = 2 (sin - mu cos) e^(-2 mu zeta + 2 k s), in sigma = r^2,
/// panel by panel; analytic in the unknowns, so that a tiny imaginary step gives the derivative to every
/// digit. Where friction changes the core keeps its length up to the last change in it, and of the straight behind it
/// only the ends move. Where two knots lie at one place another span begins, which has its own length.
RideEnd ridden(const Setup& setup, const std::vector<Complex>& z, const Ride& ride) {
  using Gauss = boost::math::quadrature::gauss<long double, 20>;
  const Mesh& mesh = setup.mesh;
  const std::size_t knots = mesh.knots.size();
  std::size_t span = 0;
  Complex length = z[1 + knots];
  Complex span_begin;  // so far, but for what the sigma of the span adds
  const long double fixed = mesh.change_knots.empty() ? 0.0L : mesh.change_knots.back().sigma;
  const long double laid = mesh.core_length;
  long double mu = ride.friction;
  const long double k = ride.drag;
  Complex zeta_at_knot = z[0];
  Complex w = 0.0L;
  Complex time = 0.0L;
  Complex zeta_end;
  const auto stretch = [&](long double from, long double to, const auto& zeta, const auto& s,
                           const Complex& unit) {
    // unit: ds over d(from..to), in the root of the variable where the track starts.
    const auto push = [&](long double r) {
      const Complex angle = zeta(r * r);
      return 2.0L * (std::sin(angle) - mu * std::cos(angle)) *
             std::exp(-2.0L * mu * angle + 2.0L * k * s(r * r)) * unit * 2.0L * r;
    };
    constexpr int kPanels = 8;
    const long double low = std::sqrt(from);
    const long double high = std::sqrt(to);
    for (int panel = 0; panel < kPanels; ++panel) {
      const long double a = low + (high - low) * panel / kPanels;
      const long double b = low + (high - low) * (panel + 1) / kPanels;
      const Complex w_before = w;
      const auto pace = [&](long double r) {
        const Complex here = w_before + Gauss::integrate(push, a, r);
        const Complex v = here * std::exp(2.0L * mu * zeta(r * r) - 2.0L * k * s(r * r));
        return unit * 2.0L * r / std::sqrt(v);
      };
      time += Gauss::integrate(pace, a, b);
      w += Gauss::integrate(push, a, b);
    }
  };
  std::size_t zone = 0;
  const auto change_friction = [&](const Complex& zeta, const Complex& s) {
    const Complex v = w * std::exp(2.0L * mu * zeta - 2.0L * k * s);
    mu = ride.friction_in(++zone);
    w = v * std::exp(-2.0L * mu * zeta + 2.0L * k * s);
  };
  for (std::size_t i = 0; i + 1 < knots; ++i) {
    const long double from = mesh.knots[i];
    if (zone < mesh.change_knots.size() && mesh.change_knots[zone].sigma == mesh.knots[i])
      change_friction(zeta_at_knot, laid * from);
    const long double to = mesh.knots[i + 1];
    if (from == to) {
      const Complex next = z[1 + knots + ++span];
      span_begin += (length - next) * from;
      length = next;
      continue;
    }
    const auto zeta = [&](long double sigma) {
      const long double along = sigma - from;
      return zeta_at_knot - z[1 + i] * along - (z[2 + i] - z[1 + i]) * (along * along / (2.0L * (to - from)));
    };
    const auto s = [&](long double sigma) {
      const long double held = std::min(sigma, fixed);
      return span_begin + laid * held + length * (sigma - held);
    };
    stretch(from, to, zeta, s, to <= fixed ? Complex(laid) : length);
    zeta_end = zeta(to);
    zeta_at_knot = zeta_end;
  }
  const Complex core = span_begin + laid * fixed + length * (1.0L - fixed);
  const Complex end = core + static_cast<long double>(mesh.lead_out);
  const auto straight = [&](const Complex& a, const Complex& b) {
    stretch(
        1.0L, 2.0L, [&](long double) { return zeta_end; },
        [&](long double tau) { return a + (b - a) * (tau - 1.0L); }, b - a);
  };
  Complex at = core;
  while (zone < mesh.changes.size() && mesh.changes[zone] < end.real()) {
    const Complex change = mesh.changes[zone];
    straight(at, change);
    change_friction(zeta_end, change);
    at = change;
  }
  straight(at, end);
  return {time, w * std::exp(2.0L * mu * zeta_end - 2.0L * k * end)};
}

}  // namespace

TEST_CASE("time and exit speed carry the derivatives that complex steps in long double give") {
  // The transcription's own quadrature is resolved to some 1e-11.
  constexpr double kAgreement = 1e-9;
  constexpr long double kTiny = 1e-30L;
  Setup changing = make_changing_setup(riders().front());
  changing.mesh.fine.clear();
  changing.mesh.fine_turns.clear();
  Setup parted = make_parted_setup(riders().front());
  parted.mesh.fine.clear();
  parted.mesh.fine_turns.clear();
  for (const Setup& setup : {make_setup(riders().front()), changing, parted}) {
    const Transcription track(setup.mesh);
    const Rows rows(setup.problem, track);
    const State state = rows.state(setup.z, true);
    REQUIRE(setup.problem.rides.size() == 2);
    for (std::size_t friction = 0; friction < 2; ++friction) {
      const Flow& flow = state.flows[friction];
      const Ride& ride = setup.problem.rides[friction];
      for (std::size_t j = 0; j < setup.z.size(); ++j) {
        std::vector<Complex> z(setup.z.begin(), setup.z.end());
        z[j] += Complex(0.0L, kTiny);
        const RideEnd end = ridden(setup, z, ride);
        CAPTURE(friction, j);
        CHECK(flow.time == Approx(static_cast<double>(end.time.real())).epsilon(kAgreement));
        CHECK(flow.dtime[j] ==
              Approx(static_cast<double>(end.time.imag() / kTiny)).epsilon(kAgreement).margin(kAgreement));
        const std::size_t last = flow.v.size() - 1;
        CHECK(flow.v[last] == Approx(static_cast<double>(end.speed2.real())).epsilon(kAgreement));
        Vector exit_speed2_by(setup.z.size(), 0.0);
        track.add(flow.dv, last, 1.0, exit_speed2_by.data());
        CHECK(exit_speed2_by[j] ==
              Approx(static_cast<double>(end.speed2.imag() / kTiny)).epsilon(kAgreement).margin(kAgreement));
      }
    }
  }
}

TEST_CASE("every row and the objective carry their exact gradient") {
  for (const Setup& setup : setups()) {
    const Transcription track(setup.mesh);
    const Rows rows(setup.problem, track);
    const State state = rows.state(setup.z, true);
    CAPTURE(setup.mesh.entry_speed2, setup.mesh.fine.size(), setup.mesh.changes.size());

    const auto objective = [&](const Vector& z) { return rows.objective(rows.state(z, false)); };
    CHECK(gradient_error(objective, setup.z, rows.objective_gradient(state)) < kDifferenceError);

    Vector value;
    Matrix jacobian;
    rows.equalities(state, value, jacobian);
    REQUIRE(value.size() == rows.equality_count());
    const auto equalities = [&](const Vector& z) {
      Vector values;
      Matrix unused;
      rows.equalities(rows.state(z, true), values, unused);
      return values;
    };
    std::vector<Vector> gradients;
    for (std::size_t i = 0; i < value.size(); ++i)
      gradients.emplace_back(jacobian.row(i), jacobian.row(i) + setup.z.size());
    for (const double error : gradient_errors(equalities, setup.z, gradients))
      CHECK(error < kDifferenceError);

    const std::vector<Row> all = rows.candidates(state, 1e3);
    REQUIRE(all.size() > 300);
    const auto inequalities = [&](const Vector& z) {
      const State moved = rows.state(z, false);
      Vector values;
      for (const Row& row : all) values.push_back(rows.value(moved, row));
      return values;
    };
    gradients.assign(all.size(), Vector(setup.z.size()));
    for (std::size_t i = 0; i < all.size(); ++i) rows.gradient(state, all[i], gradients[i].data());
    const Vector errors = gradient_errors(inequalities, setup.z, gradients);
    for (std::size_t i = 0; i < all.size(); ++i) {
      const Row& row = all[i];
      CAPTURE(setup.problem.limits[row.limit].name.key(), row.place, row.ride, row.foot);
      CHECK(errors[i] < kDifferenceError);
    }
  }
}

TEST_CASE("a track of fine knots is the clothoid spline that has them all") {
  const Rider rider = riders()[1];
  const Setup setup = make_fine_setup(rider);
  const Transcription track(setup.mesh);
  Setup spline = make_setup(rider);
  spline.mesh.knots = {0.0, 0.1, 0.15, 0.2, 0.25, 0.5, 0.6, 0.7, 0.8, 1.0};
  const Vector& z = setup.z;
  const auto between = [](double a, double b, double share) { return a + share * (b - a); };
  spline.z = {z[0],
              z[1],
              z[2],
              between(z[2], z[3], 1.0 / 3.0) + 0.2,
              between(z[2], z[3], 2.0 / 3.0) - 0.3,
              z[3],
              z[4],
              between(z[4], z[5], 1.0 / 3.0) + 0.15,
              between(z[4], z[5], 2.0 / 3.0) + 0.1,
              z[5],
              z[6],
              z[7]};
  const Transcription all(spline.mesh);
  const Rows rows(setup.problem, track);
  const Rows other(spline.problem, all);
  const State fine = rows.state(z, true);
  const State plain = other.state(spline.z, true);
  REQUIRE(track.stations().size() == all.stations().size());
  constexpr double kRounding = 1e-13;
  for (std::size_t i = 0; i < track.stations().size(); ++i) {
    CAPTURE(i);
    CHECK(fine.shape.zeta[i] == Approx(plain.shape.zeta[i]).margin(kRounding));
    CHECK(fine.shape.curvature[i] == Approx(plain.shape.curvature[i]).margin(kRounding));
    CHECK(fine.shape.x[i] == Approx(plain.shape.x[i]).margin(kRounding));
    CHECK(fine.shape.y[i] == Approx(plain.shape.y[i]).margin(kRounding));
    CHECK(fine.flows[0].v[i] == Approx(plain.flows[0].v[i]).margin(kRounding));
  }
  CHECK(fine.flows[1].time == Approx(plain.flows[1].time).margin(kRounding));
  const Foot foot = track.foot(z, fine.shape, 0.4, 0.3);
  const Foot same = all.foot(spline.z, plain.shape, 0.4, 0.3);
  CHECK(foot.x == Approx(same.x).margin(kRounding));
  CHECK(foot.y == Approx(same.y).margin(kRounding));
}

TEST_CASE("the Hessian of the Lagrangian is that of its gradient") {
  for (Setup setup : setups()) {
    setup.problem.speed_weight = 0.3;
    const Transcription track(setup.mesh);
    const Rows rows(setup.problem, track);
    KnownStates states(rows);
    CAPTURE(setup.mesh.entry_speed2, setup.mesh.fine.size(), setup.mesh.changes.size());
    Vector equality(rows.equality_count(), 0.0);
    equality[0] = 0.4;
    equality[1] = -0.7;
    CHECK(hessian_error(setup.z, rows, states, equality, {}, {}) < 10.0 * kDifferenceError);
    // One row of every limit and ride.
    std::size_t limit = setup.problem.limits.size();
    std::size_t ride = 0;
    for (const Row& row : rows.candidates(states.at(setup.z), 1e3)) {
      const bool known = row.limit == limit && row.ride == ride;
      const bool last = row.place + 3 >= track.stations().size();
      if (known && !last && !row.foot) continue;
      limit = row.limit;
      ride = row.ride;
      CAPTURE(setup.problem.limits[row.limit].name.key(), row.place, row.ride, row.foot);
      const double allowed = row.foot ? kFootError : 10.0 * kDifferenceError;
      CHECK(hessian_error(setup.z, rows, states, equality, {row}, {0.9}) < allowed);
    }
    equality.back() = 0.8;
    CHECK(hessian_error(setup.z, rows, states, equality, {}, {}) < kFootError);
  }
}

TEST_CASE("derivatives added to a state are those of a state that was made with them") {
  const auto same = [](const Derivatives& a, const Derivatives& b) {
    REQUIRE(a.starts.rows() == b.starts.rows());
    bool all = a.local == b.local;
    for (std::size_t i = 0; i < a.starts.rows(); ++i)
      all = all && std::equal(a.starts.row(i), a.starts.row(i) + a.starts.columns(), b.starts.row(i));
    return all;
  };
  for (const Setup& setup : setups()) {
    const Transcription track(setup.mesh);
    const Rows rows(setup.problem, track);
    const State at_once = rows.state(setup.z, true);
    State later = rows.state(setup.z, false);
    CHECK(later.shape.dx.empty());
    rows.add_derivatives(later);
    CHECK(later.shape.x == at_once.shape.x);
    CHECK(later.shape.y == at_once.shape.y);
    CHECK(same(later.shape.dx, at_once.shape.dx));
    CHECK(same(later.shape.dy, at_once.shape.dy));
    for (std::size_t ride = 0; ride < at_once.flows.size(); ++ride) {
      CHECK(later.flows[ride].v == at_once.flows[ride].v);
      CHECK(later.flows[ride].time == at_once.flows[ride].time);
      CHECK(later.flows[ride].dtime == at_once.flows[ride].dtime);
      CHECK(same(later.flows[ride].dv, at_once.flows[ride].dv));
    }
  }
}

}  // namespace derivatives_test
