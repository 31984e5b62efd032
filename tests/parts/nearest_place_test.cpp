// The nearest place of a track against many places of it.

#include "parts/curves/nearest_place.hpp"

#include "glissade/core/math.hpp"

#include "support/catch.hpp"
#include "support/random.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace {

using namespace glissade;
using namespace glissade::parts;

/// Lines and arcs with common tangents, valleys and crests.
ArcSpline random_spline(testing::Random& random) {
  ArcPath path;
  path.vertices.push_back({{}, 0.0});
  double heading = random.between(-1.5, 0.5);
  const int pieces = random.integer(1, 9);
  for (int i = 0; i < pieces; ++i) {
    const double turn = random.integer(0, 3) == 0 ? 0.0 : random.between(-1.2, 1.2);
    const double chord = random.between(0.05, 3.0);
    path.vertices.back().bulge = math::tan(0.25 * turn);
    const auto [sine, cosine] = math::sine_cosine(heading + 0.5 * turn);
    path.vertices.push_back({path.vertices.back().at + chord * Vec2{cosine, sine}, 0.0});
    heading += turn;
  }
  return ArcSpline(path);
}

TEST_CASE("the nearest place of a track is no farther than any other, and as far as it says") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (int run = 0; run < 200; ++run) {
    const ArcSpline track = random_spline(random);
    const double length = track.length();
    const double a = random.between(0.0, length);
    const double b = random.between(0.0, length);
    const Span span{std::min(a, b), std::max(a, b)};
    const Vec2 point{random.between(-3.0, 12.0), random.between(-12.0, 3.0)};
    const TrackPlace found = nearest_place(track, span, point);
    CHECK(found.s >= span.from);
    CHECK(found.s <= span.to);
    CHECK(found.distance == Approx(norm(frame_at(track, found.s).at - point)).margin(1e-13));
    double least = std::numeric_limits<double>::infinity();
    constexpr int kPlaces = 1000;
    for (int k = 0; k <= kPlaces; ++k) {
      const double s = span.from + (span.to - span.from) * k / kPlaces;
      least = std::min(least, norm(frame_at(track, std::min(s, length)).at - point));
    }
    CHECK(found.distance <= least + 1e-12);
    CHECK(found.distance >= least - (span.to - span.from) / kPlaces);
  }
}

TEST_CASE("a place beside the track is found again, up to the centre of its arc") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (int run = 0; run < 200; ++run) {
    const ArcSpline track = random_spline(random);
    const double s = random.between(0.0, track.length());
    const TrackArc& arc = track.arcs()[track.arc_at(s)];
    const double reach = arc.curvature == 0.0 ? 1.0 : std::min(1.0, 0.9 / std::fabs(arc.curvature));
    const double height = random.between(-reach, reach);
    const TrackFrame frame = frame_at(track, s);
    // On its own arc: another one may pass closer by.
    const TrackPlace found =
        nearest_place(track, {arc.start, arc.start + arc.length}, frame.at + height * frame.up);
    CHECK(found.s == Approx(s).margin(1e-9));
    CHECK(found.distance == Approx(std::fabs(height)).margin(1e-12));
  }
}

}  // namespace
