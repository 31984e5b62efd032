// Rows of clearances that are measured from an envelope: their derivatives against differences, and their
// least one against the referee's own geometry, which shares nothing with them.

#include "glissade/centerline/clothoid_spline.hpp"

#include "clearance/strip.hpp"
#include "optimize/differences.hpp"
#include "optimize/discretise/transcription.hpp"
#include "optimize/places.hpp"
#include "optimize/problem/rows.hpp"
#include "optimize/problem/scaled_problem.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

namespace envelope_rows_test {

using namespace glissade;
using namespace glissade::optimizer;

namespace {

struct Setup {
  Problem given;
  Passages passages;
  ScaledProblem problem;
  Mesh mesh;
  Vector z;
};

/// A track that starts steeply with a small radius, so that the planes of both ends cut the walls.
Setup make_setup(PlacesFrom from = PlacesFrom::start) {
  Setup setup;
  Problem& given = setup.given;
  given.endpoints = {10.0, 5.0};
  given.finish = {FinishKind::vertical_line, {}};
  given.body.friction = Friction::from_coefficient(0.2);
  Limits& limits = given.limits;
  limits.lead_out = 1.1;
  limits.envelope = {0.15, 1.3, 0.0};
  limits.half_planes.push_back({{0.0, 3.0}, {-0.5, 1.0}, 0.1});
  limits.half_planes.push_back({{11.0, 0.0}, {1.0, 0.1}, 0.1});
  limits.half_planes.push_back({{0.0, -2.0}, {0.1, -1.0}, 0.1});
  limits.keep_outs.push_back({{{3.0, 0.5}, {3.6, 0.4}, {3.5, 1.2}, {3.1, 1.3}}, 0.1, Passage::below});
  limits.keep_outs.push_back({{{-0.5, -1.0}, {1.5, -1.2}, {1.4, -0.4}}, 0.1, Passage::below});
  limits.keep_outs.push_back({{{3.0, 7.0}, {4.0, 6.5}, {4.2, 8.0}}, 0.1, Passage::above});
  limits.keep_outs.push_back({{{10.6, 3.0}, {11.0, 3.0}, {11.0, 6.0}, {10.6, 6.0}}, 0.1, Passage::below});
  limits.keep_outs.push_back({{{-1.0, -0.3}, {-0.2, -0.5}, {-0.2, 0.5}, {-1.0, 0.5}}, 0.1, Passage::above});
  limits.stay_above.push_back({{{1.0, 5.0}, {4.0, 6.0}, {7.0, 7.5}}, 0.2});
  limits.stay_below.push_back({{{-1.0, -1.0}, {2.0, -1.5}, {5.0, 0.3}, {9.0, 2.0}, {12.0, 2.5}}, 0.2});
  setup.passages = {Passage::below, Passage::below, Passage::above, Passage::below, Passage::above};
  if (from == PlacesFrom::finish) given = testing::counted_from_finish(given, {10.0, 5.0});
  setup.problem = scaled(given, setup.passages);
  setup.mesh.knots = {0.0, 0.1, 0.25, 0.5, 0.8, 1.0};
  setup.mesh.lead_out = setup.problem.lead_out;
  setup.mesh.core_length = 0.95;
  setup.z = {1.5, 9.0, 1.1, 0.3, 0.2, -0.4, -1.6, 0.9};
  return setup;
}

struct Sorts {
  int stations = 0;
  int corners = 0;
  int faces = 0;
};

}  // namespace

TEST_CASE("rows of an envelope: gradients are those of their values") {
  const Setup setup = make_setup(GENERATE(PlacesFrom::start, PlacesFrom::finish));
  const Transcription track(setup.mesh);
  const Rows rows(setup.problem, track);
  const State state = rows.state(setup.z, true);
  Sorts sorts;
  for (const Row& row : rows.candidates(state, HUGE_VAL)) {
    if (setup.problem.limits[row.limit].measure != Measure::distance) continue;
    ++(row.face ? sorts.faces : row.foot ? sorts.corners : sorts.stations);
    const auto value = [&](const Vector& z) { return rows.value(rows.state(z, false), row); };
    Vector gradient(setup.z.size());
    rows.gradient(state, row, gradient.data());
    CAPTURE(setup.problem.limits[row.limit].name.key(), row.place, row.edge, row.foot, row.face, row.level);
    CHECK(gradient_error(value, setup.z, gradient) < kDifferenceError);
  }
  CHECK(sorts.stations > 100);
  CHECK(sorts.corners > 10);
  CHECK(sorts.faces > 30);
}

TEST_CASE("rows of an envelope: a normal that an end plane cuts keeps its value and its gradient") {
  const Setup setup = make_setup();
  const Transcription track(setup.mesh);
  const Rows rows(setup.problem, track);
  const State state = rows.state(setup.z, true);
  int cut = 0;
  const std::vector<Row> candidates = rows.candidates(state, HUGE_VAL);
  for (std::size_t limit = 0; limit < setup.problem.limits.size(); ++limit) {
    if (setup.problem.limits[limit].name.key() != "half_planes[2]") continue;
    for (std::size_t place = 1; place + 1 < track.stations().size(); ++place) {
      Row row;
      row.limit = limit;
      row.place = place;
      row.level = 1;
      // Candidates leave out those that are cut: the end face's corners stand for them.
      if (!track.stations()[place].watched) continue;
      if (std::find(candidates.begin(), candidates.end(), row) != candidates.end()) continue;
      ++cut;
      const auto value = [&](const Vector& z) { return rows.value(rows.state(z, false), row); };
      Vector gradient(setup.z.size());
      rows.gradient(state, row, gradient.data());
      CAPTURE(place);
      CHECK(gradient_error(value, setup.z, gradient) < kDifferenceError);
    }
  }
  CHECK(cut >= 3);
}

TEST_CASE("rows of an envelope: the Hessian is that of their gradients where no plane cuts") {
  Setup setup = make_setup(GENERATE(PlacesFrom::start, PlacesFrom::finish));
  setup.problem.envelope_high = 0.05;  // below every radius
  const Transcription track(setup.mesh);
  const Rows rows(setup.problem, track);
  const Vector equality(rows.equality_count(), 0.0);
  Sorts sorts;
  KnownStates states(rows);
  const State& state = states.at(setup.z);
  for (const Row& row : rows.candidates(state, HUGE_VAL)) {
    if (setup.problem.limits[row.limit].measure != Measure::distance) continue;
    if (!row.foot && !row.face && row.place % 7 != 3) continue;
    // Far off, towards the centre of curvature, a foot moves fast.
    if (row.foot && std::fabs(rows.value(state, row)) > 0.3) continue;
    ++(row.face ? sorts.faces : row.foot ? sorts.corners : sorts.stations);
    CAPTURE(setup.problem.limits[row.limit].name.key(), row.place, row.edge, row.foot, row.face, row.level);
    CHECK(hessian_error(setup.z, rows, states, equality, {row}, {0.9}) <
          (row.foot ? kFootError : 10.0 * kDifferenceError));
  }
  CHECK(sorts.stations > 20);
  CHECK(sorts.corners > 10);
  CHECK(sorts.faces > 30);
}

TEST_CASE("rows of an envelope: the least of them is the clearance that the referee finds") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  int compared = 0;
  for (int i = 0; i < 400; ++i) {
    Problem given;
    given.endpoints = {10.0, 5.0};
    given.finish = {FinishKind::vertical_line, {}};
    given.limits.envelope = {random.between(0.0, 0.3), random.between(0.0, 1.5), random.between(0.0, 0.8)};
    const Vec2 middle{random.between(-2.0, 13.0), random.between(-4.0, 12.0)};
    std::vector<Vec2> outline;
    for (int k = 0; k < 4; ++k) {
      const double angle = 0.3 + k * 1.5707963;
      const double radius = random.between(0.1, 0.8);
      outline.push_back(middle + Vec2{radius * std::cos(angle), radius * std::sin(angle)});
    }
    given.limits.keep_outs.push_back({outline, 0.0, Passage::either});
    Mesh mesh;
    mesh.lead_out = random.integer(0, 1) == 0 ? 0.0 : 0.1;
    for (int k = 0; k <= 40; ++k) mesh.knots.push_back(k / 40.0);
    Vector z{random.between(0.2, 1.55)};
    // Turning rates of a smooth curve.
    const double first = random.between(0.0, 3.0);
    const double second = random.between(-1.5, 1.5);
    for (const double knot : mesh.knots) z.push_back((1.0 - knot) * first + knot * second);
    z.push_back(random.between(0.7, 1.1));
    const Transcription track(mesh);
    const double chord = scaled(given, {Passage::above}).chord;
    std::vector<ClothoidSegment> segments;
    const double length = z.back() * chord;
    for (std::size_t k = 0; k < 40; ++k) {
      segments.push_back({length / 40.0, z[1 + k] / length, z[2 + k] / length});
    }
    if (mesh.lead_out > 0.0) segments.push_back({mesh.lead_out * chord, 0.0, 0.0});
    const double end = z[0] - 0.5 * (first + second);
    const double middle_slope = z[0] - 0.375 * first - 0.125 * second;
    if (std::min(end, middle_slope) < -1.5) continue;
    const ClothoidSpline spline(Angle::from_radians(z[0]), segments);
    std::vector<CenterlinePoint> stations;
    for (int k = 0; k < 300; ++k) stations.push_back(spline.at(spline.length() * k / 300.0));
    stations.push_back(spline.at(spline.length()));
    const clearance::Strip strip(spline, given.limits.envelope, stations);
    const auto region = clearance::Region::area(outline, clearance::Pass::either);
    const double expected = strip.least(region, strip.along(region), 1e-9).closest.value;

    // Of the two ways past it the one that the track takes.
    double least = -HUGE_VAL;
    for (const Passage passage : {Passage::above, Passage::below}) {
      const ScaledProblem problem = scaled(given, {passage});
      const Rows rows(problem, track);
      const State state = rows.state(z, false);
      double of_way = HUGE_VAL;
      for (const Row& row : rows.candidates(state, HUGE_VAL)) {
        if (problem.limits[row.limit].measure != Measure::distance) continue;
        of_way = std::min(of_way, -rows.value(state, row) * problem.chord);
      }
      least = std::max(least, of_way);
    }
    INFO("case " << i << ": envelope " << given.limits.envelope.below << " " << given.limits.envelope.top()
                 << ", obstacle at " << middle.x << " " << middle.y << ", referee " << expected << ", rows "
                 << least);
    if (expected <= 0.0) {
      CHECK(least <= 0.02);
      continue;
    }
    ++compared;
    // A station stands every 3 cm or so: what a corner of the envelope loses between two of them.
    CHECK(least == Approx(expected).margin(0.02));
  }
  CHECK(compared > 100);
}

}  // namespace envelope_rows_test
