// How few arcs a stretch beside kept pieces takes: against arcs that are tried.

#include "parts/curves/least_arcs.hpp"

#include "glissade/centerline/clothoid_spline.hpp"
#include "glissade/core/math.hpp"
#include "glissade/parts/master_curve.hpp"

#include "parts/curves/fewest_arcs.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/thorough.hpp"

#include <algorithm>
#include <cmath>

namespace {

using namespace glissade;
using namespace glissade::parts;

/// A kept piece, a ramp whose curvature changes steadily, and another kept piece.
struct Ramp {
  double first = 0.0;  ///< curvature before it [1/m]
  double length = 0.0;
  double last = 0.0;
  TrackSamples samples;
  Stretch stretch;
};

Ramp ramp_of(double first, double length, double last) {
  const ClothoidSpline track(Angle::from_degrees(40.0),
                             {{1.0, first, first}, {length, first, last}, {1.0, last, last}});
  Ramp ramp{first, length, last, sample(track, 3000), {}};
  const std::size_t begin = index_at(ramp.samples, 1.0);
  const std::size_t end = index_at(ramp.samples, 1.0 + length);
  const auto leg = [&](std::size_t at, double curvature) {
    return KeptEnd{{ramp.samples.point[at], ramp.samples.heading[at], curvature}, 0.0};
  };
  ramp.stretch = {begin, end, leg(begin, first), leg(end, last)};
  return ramp;
}

Ramp drawn_ramp(testing::Random& random) {
  const double first = random.integer(0, 1) == 0 ? 0.0 : random.between(-0.5, 0.5);
  const double more = random.between(0.1, 0.6) * (random.integer(0, 1) == 0 ? 1.0 : -1.0);
  return ramp_of(first, random.between(0.2, 1.5), first + more);
}

Band drawn_band(testing::Random& random) {
  const double tolerance = math::exp(random.between(math::log(2e-5), math::log(2e-3)));
  switch (random.integer(0, 2)) {
    case 0:
      return {tolerance, tolerance};
    case 1:
      return {tolerance, 0.02 * tolerance};
    default:
      return {0.02 * tolerance, tolerance};
  }
}

/// How far an arc goes that leaves the piece before the ramp at a place, until a sample lies out of the band.
std::size_t last_passed(const Ramp& ramp, const Band& band, double place, double curvature) {
  ArcAt arc = ramp.stretch.before->leg.after(place);
  arc.curvature = curvature;
  const Vec2 along = direction_of(arc.heading);
  std::size_t j = ramp.stretch.first;
  for (; j <= ramp.stretch.last; ++j) {
    if (dot(ramp.samples.point[j] - arc.from, along) <= 0.0) continue;
    const double left = -arc.distance(ramp.samples.point[j]);
    if (left > band.left || left < -band.right) break;
  }
  return j - 1;
}

}  // namespace

TEST_CASE(
    "least arcs: no arc that leaves a kept piece along its tangent goes farther than is told, some do "
    "nearly") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (int run = 0; run < (testing::thorough() ? 12 : 2); ++run) {
    const Ramp ramp = drawn_ramp(random);
    const Band band = drawn_band(random);
    const std::size_t told = farthest_from_kept(ramp.samples, ramp.stretch, band, false);
    const double reach = reach_of(ramp.samples, ramp.stretch, ramp.stretch.before->leg, band, 1);
    std::size_t most = ramp.stretch.first;
    for (int i = 0; i <= 60; ++i) {
      const double place = reach * i / 60.0;
      const ArcAt from = ramp.stretch.before->leg.after(place);
      for (std::size_t j = ramp.stretch.first + 8; j <= ramp.stretch.last; j += 8) {
        for (const double across : {-0.999, -0.5, 0.0, 0.5, 0.999}) {
          const Vec2 beside =
              (band.middle() + across * band.half_width()) * left_of(direction_of(ramp.samples.heading[j]));
          const Vec2 away = ramp.samples.point[j] + beside - from.from;
          const double curvature = 2.0 * cross(direction_of(from.heading), away) / dot(away, away);
          most = std::max(most, last_passed(ramp, band, place, curvature));
        }
      }
    }
    INFO("run " << run << ": from " << ramp.first << " to " << ramp.last << " over " << ramp.length
                << ", band " << band.left << ", " << band.right);
    CHECK(most <= told);
    // Tried ones are some: what they miss of the ramp is little.
    const double missed = ramp.samples.s[told] - ramp.samples.s[most];
    CHECK(missed <= 0.03 * (ramp.samples.s[told] - ramp.samples.s[ramp.stretch.first]) + 2e-3);
  }
}

TEST_CASE("least arcs: a stretch the other way round takes as many") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (int run = 0; run < 40; ++run) {
    const Ramp ramp = drawn_ramp(random);
    const Band band = drawn_band(random);
    // Turned about: left is right, and a bend to the left one to the right.
    Ramp back = ramp;
    const std::size_t size = ramp.samples.size();
    for (std::size_t j = 0; j < size; ++j) {
      const std::size_t from = size - 1 - j;
      back.samples.s[j] = ramp.samples.s.back() - ramp.samples.s[from];
      back.samples.point[j] = -1.0 * ramp.samples.point[from];
      back.samples.heading[j] = ramp.samples.heading[from];
    }
    const auto turned = [](const KeptEnd& end) {
      return KeptEnd{{-1.0 * end.leg.from, end.leg.heading, -end.leg.curvature}, 0.0};
    };
    back.stretch = {size - 1 - ramp.stretch.last, size - 1 - ramp.stretch.first, turned(*ramp.stretch.after),
                    turned(*ramp.stretch.before)};
    const std::size_t there = least_arcs(ramp.samples, ramp.stretch, band);
    const std::size_t other = least_arcs(back.samples, back.stretch, {band.right, band.left});
    INFO("run " << run << ": " << there << ", " << other);
    // Pieces between the first arc and the last are counted from one side.
    CHECK(std::max(there, other) <= std::min(there, other) + 1);
    CHECK(one_arc_may_do(ramp.samples, ramp.stretch, band) ==
          one_arc_may_do(back.samples, back.stretch, {band.right, band.left}));
  }
}

TEST_CASE(
    "least arcs: where one arc that touches both pieces keeps the band, one may do; else it takes two") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  int one = 0;
  int more = 0;
  for (int run = 0; run < 60; ++run) {
    const Ramp ramp = drawn_ramp(random);
    const Band band = drawn_band(random);
    const double reach = reach_of(ramp.samples, ramp.stretch, ramp.stretch.before->leg, band, 1);
    const double back = reach_of(ramp.samples, ramp.stretch, ramp.stretch.after->leg, band, -1);
    const double end = ramp.samples.s[ramp.stretch.last];
    bool does = false;
    for (int i = 0; i <= 4000 && !does; ++i) {
      const double place = reach * i / 4000.0;
      const auto arc = touching(ramp.stretch.before->leg.after(place), ramp.stretch.after->leg);
      if (!arc || arc->beyond > 0.0 || arc->beyond < -back) continue;
      does = ramp.samples.s[last_passed(ramp, band, place, arc->leg.curvature)] >= end + arc->beyond;
    }
    const bool may = one_arc_may_do(ramp.samples, ramp.stretch, band);
    const std::size_t least = least_arcs(ramp.samples, ramp.stretch, band);
    INFO("run " << run << ": from " << ramp.first << " to " << ramp.last << " over " << ramp.length
                << ", band " << band.left << ", " << band.right << ", least " << least);
    if (does) CHECK(may);
    if (!may) CHECK(least >= 2);
    if (may) CHECK(least <= 1);
    CHECK(least >= 1);  // a ramp moves the circles off each other
    (does ? one : more) += 1;
  }
  CHECK(one > 3);
  CHECK(more > 3);
}

TEST_CASE("least arcs: pieces that meet take none") {
  // A line, and an arc that touches it.
  const Ramp ramp = ramp_of(0.0, 1e-9, 0.3);
  CHECK(least_arcs(ramp.samples, ramp.stretch, {1e-4, 1e-4}) == 0);
}

TEST_CASE("least arcs: the arcs of a search go where they cost too many, drawn ones and lines never") {
  // Arcs so flat that a line within the tolerance could stand for them, between ramps.
  const ClothoidSpline track(Angle::from_degrees(45.0), {{3.0, 0.0, 0.0},
                                                         {0.2, 0.0, 0.08},
                                                         {0.1, 0.08, 0.08},
                                                         {0.2, 0.08, -0.08},
                                                         {0.1, -0.08, -0.08},
                                                         {0.2, -0.08, 0.08},
                                                         {0.1, 0.08, 0.08},
                                                         {0.2, 0.08, 0.0},
                                                         {3.0, 0.0, 0.0}});
  const double tolerance = 1e-4;
  const MasterCurve drawn = fit_arcs(track, {tolerance});
  const MasterCurve found = fit_arcs(track, {tolerance, FitSide::both, true});
  CHECK(drawn.kept == 5);
  CHECK(found.kept == 2);
  CHECK(found.lines >= 2);
  CHECK(found.arcs < drawn.arcs);
  CHECK(found.max_deviation <= tolerance);
  for (const MasterCurve& curve : {drawn, found}) {
    CHECK(curve.lower_bound <= curve.arcs);
    CHECK(curve.spline->arcs().front().curvature == 0.0);
    CHECK(curve.spline->arcs().back().curvature == 0.0);
  }
}
