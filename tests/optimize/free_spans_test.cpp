// Jumps of the curvature far from where they belong: where they are found does not depend on where they were looked for.

#include "optimize/mesh/free_spans.hpp"

#include "glissade/motion/laws/bulk_stream.hpp"

#include "optimize/mesh/switches.hpp"
#include "optimize/problem/scaled_problem.hpp"
#include "optimize/search/starts.hpp"
#include "support/catch.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

namespace free_spans_test {

using namespace glissade;
using namespace glissade::optimizer;

namespace {

constexpr double kTolerance = 1e-7;

/// A level entry: over a crest of the smallest radius into the fastest dive, its curvature jumps once.
Problem over_a_crest() {
  Problem problem;
  problem.endpoints = {10.0, 6.0};
  problem.body = {Friction::from_coefficient(0.15), 2.0};
  problem.limits.entry_slope_angle = Range::fixed(0.0);
  problem.limits.smallest_crest_radius = 2.0;
  return problem;
}

/// The optimum on a mesh that lets curvature jump at one place alone.
Found with_jump_at(const ScaledProblem& problem, double place) {
  const GuessCurve start = starts(problem).front();
  Vector knots;
  constexpr int kPieces = 24;
  for (int i = 0; i <= kPieces; ++i) {
    const double sigma = static_cast<double>(i) / kPieces;
    if (std::fabs(sigma - place) > 0.2 / kPieces) knots.push_back(sigma);
  }
  knots.push_back(place - 0.5 * kPair);
  knots.push_back(place + 0.5 * kPair);
  std::sort(knots.begin(), knots.end());
  const Mesh mesh = mesh_of(problem, knots, start.length);
  SearchControl control;
  control.tolerance = kTolerance;
  return minimise(problem, mesh, fit(start, Transcription(mesh)), Vector(problem.limits.size(), 0.0),
                  control);
}

/// Where the steepest ramp of the curvature lies.
double jump_of(const Found& found) {
  const Vector& knots = found.track->mesh().knots;
  const Layout& layout = found.track->layout();
  double steepest = 0.0;
  double place = 0.0;
  for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
    const double rate =
        std::fabs(found.z[layout.turn(i + 1)] - found.z[layout.turn(i)]) / (knots[i + 1] - knots[i]);
    if (rate <= steepest) continue;
    steepest = rate;
    place = 0.5 * (knots[i] + knots[i + 1]);
  }
  return place;
}

}  // namespace

TEST_CASE("a jump of the curvature is found from wherever it is looked for") {
  const ScaledProblem problem = scaled(over_a_crest(), {});
  REQUIRE(can_free_spans(problem));
  const auto freed_from = [&](double place) {
    const Found begun = with_jump_at(problem, place);
    REQUIRE(begun.residual <= kTolerance);
    SearchControl control;
    const auto freed = with_free_spans(problem, begun, kTolerance, control);
    REQUIRE(freed);
    CHECK(freed->residual <= kTolerance);
    CHECK(freed->feasible(control.limit_tolerance));
    CHECK(freed->objective < begun.objective);
    CHECK(freed->track->mesh().borders.empty());
    CHECK(freed->rows->margins() == begun.rows->margins());
    return *freed;
  };
  const Found far_off = freed_from(0.65);
  // With two knots at that place from the beginning, and nothing else freed.
  const double where = jump_of(far_off);
  const Found there = with_jump_at(problem, where);
  CAPTURE(where);
  CHECK(far_off.objective < there.objective);
  for (const double place : {0.2, 0.35, 0.5}) {
    CAPTURE(place);
    CHECK(freed_from(place).objective < there.objective);
  }
}

TEST_CASE(
    "lengths are free only where no law and no friction asks how far a ride has come, and curvature may "
    "jump") {
  CHECK(can_free_spans(scaled(over_a_crest(), {})));
  Problem smooth = over_a_crest();
  smooth.limits.highest_curvature_rate = 0.1;
  CHECK_FALSE(can_free_spans(scaled(smooth, {})));
  StreamShape shape;
  shape.mass_flow = 500.0;
  shape.bulk_density = 1000.0;
  shape.width = WidthLaw({{0.0, 1.0}, {30.0, 0.7}});
  Problem stream = over_a_crest();
  stream.body.law = std::make_shared<const BulkStream>(shape);
  CHECK_FALSE(can_free_spans(scaled(stream, {})));
  ScaledProblem changing = scaled(over_a_crest(), {});
  changing.changes = {0.3};
  CHECK_FALSE(can_free_spans(changing));
}

}  // namespace free_spans_test
