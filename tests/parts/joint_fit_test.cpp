// Joints of arcs along a clothoid, whose best error is known.

#include "parts/curves/joint_fit.hpp"

#include "glissade/centerline/clothoid_spline.hpp"

#include "parts/curves/joint_search.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace {

using namespace glissade;
using namespace glissade::parts;

constexpr double kRate = 0.02;    // of the curvature [1/m^2]
constexpr double kLength = 12.0;  // [m]

TrackSamples clothoid_samples() {
  const ClothoidSpline track(Angle::from_degrees(70.0), {{kLength, 0.0, kRate * kLength}});
  return sample(track, 4000);
}

/// Joints that lie anyhow.
ChainStart drawn_joints(testing::Random& random, std::size_t arcs) {
  ChainStart start{{0.0}, {}, -Angle::from_degrees(70.0).radians()};
  for (std::size_t i = 0; i < arcs; ++i) start.knots.push_back(start.knots.back() + random.between(0.5, 2.0));
  const double scale = kLength / start.knots.back();
  for (double& knot : start.knots) knot *= scale;
  start.knots.back() = kLength;
  start.offsets.assign(start.knots.size(), 0.0);
  return start;
}

}  // namespace

TEST_CASE("joints: from most starts along a clothoid to the error of arcs with common tangents") {
  const TrackSamples samples = clothoid_samples();
  const Stretch stretch{0, samples.size() - 1, {}, {}};
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (const std::size_t arcs : {4U, 12U, 40U}) {
    constexpr int kStarts = 6;
    const double width = kLength / static_cast<double>(arcs);
    const double separate = kRate * width * width * width / 192.0;
    const double tangent = kRate * width * width * width / 124.7;
    int close = 0;
    for (int k = 0; k < kStarts; ++k) {
      // What lies twice as far off as is enough, after a few rounds, is given up: enough is what can be reached.
      const FittedJoints found = fit_joints(samples, stretch, drawn_joints(random, arcs), 0.0, tangent);
      INFO(arcs << " arcs: " << found.deviation / separate << " times the error of separate ones");
      CHECK(found.deviation >= 0.999 * separate);
      // Free ends, where the tangent may turn, spare some of it. Many joints may come to rest before all arcs are alike.
      close += found.deviation <= (arcs < 40U ? 1.1 : 1.3) * tangent ? 1 : 0;
      const ArcChain chain = fit_chain(samples, stretch, found.joints, 0.0, separate);
      CHECK(chain.vertices.size() == arcs + 1);
      CHECK(chain.deviation <= 1.02 * found.deviation);
      CHECK(chain.deviation >= 0.98 * found.deviation);
    }
    CAPTURE(arcs);
    CHECK(close > kStarts / 2);
  }
}

TEST_CASE("joints: a line beside the track is followed as the track is") {
  const TrackSamples samples = clothoid_samples();
  const Stretch stretch{0, samples.size() - 1, {}, {}};
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  const double separate = kRate * std::pow(kLength / 10.0, 3) / 192.0;
  constexpr int kStarts = 6;
  int alike = 0;
  for (int k = 0; k < kStarts; ++k) {
    const ChainStart start = drawn_joints(random, 10);
    const double on_it = fit_joints(samples, stretch, start, 0.0, separate).deviation;
    // Ends stay on the track: half as far from the line as the deviation, they cost little.
    const double beside = fit_joints(samples, stretch, start, 0.5 * on_it, separate).deviation;
    CHECK(beside < 1.5 * on_it);
    alike += beside < 1.05 * on_it && beside > 0.9 * on_it ? 1 : 0;
  }
  CHECK(alike >= kStarts / 2);
}

TEST_CASE("joints: the search puts as many as the width of its band asks") {
  const TrackSamples samples = clothoid_samples();
  const Stretch stretch{0, samples.size() - 1, {}, {}};
  for (const double tolerance : {1e-5, 1e-4, 1e-3}) {
    const auto found = search_joints(samples, stretch, {tolerance, tolerance}, 16);
    REQUIRE(found);
    const double arcs = static_cast<double>(found->knots.size()) - 1.0;
    const double expected = kLength * std::cbrt(kRate / (124.7 * tolerance));
    INFO(tolerance << ": " << arcs << " arcs, " << expected << " expected");
    CHECK(arcs >= std::floor(0.9 * expected));
    CHECK(arcs <= std::ceil(1.12 * expected));
    CHECK(std::is_sorted(found->knots.begin(), found->knots.end()));
    CHECK(fit_joints(samples, stretch, *found, 0.0, tolerance).deviation <= tolerance);
  }
}
