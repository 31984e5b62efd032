// Flats of bent floors and mitred tubes: one behind the other, whatever way a track turns.

#include "parts/bodies/facets.hpp"

#include "glissade/parts/arc_spline.hpp"

#include "support/random.hpp"

#include <cmath>

#include <catch2/catch.hpp>

using namespace glissade;
using namespace glissade::parts;

namespace {

/// Hollows and crests in turn, some of them slight, downhill from upright to level; or one hollow whose radius changes.
ArcSpline waves(testing::Random& random, bool hollow = false) {
  ArcPath path;
  Vec2 at;
  double heading = random.between(-1.3, -0.4);
  const int count = random.integer(3, 9);
  for (int k = 0; k < count; ++k) {
    const double length = random.between(0.05, 1.5);
    const double turn =
        random.between(hollow ? 0.02 : -0.4, hollow ? 0.2 : 0.4) * (random.integer(0, 2) == 0 ? 0.02 : 1.0);
    path.vertices.push_back({at, std::tan(0.25 * turn)});
    const double chord = length * std::sin(0.5 * turn) / (0.5 * turn);
    at = at + chord * Vec2{std::cos(heading + 0.5 * turn), std::sin(heading + 0.5 * turn)};
    heading += turn;
  }
  path.vertices.push_back({at, 0.0});
  return ArcSpline(path);
}

/// Each flat leads on: it touches the track between its ends.
void require_in_order(const ArcSpline& track, const Facets& facets) {
  for (std::size_t i = 0; i + 1 < facets.corners.size(); ++i) {
    const Vec2 flat = facets.corners[i + 1] - facets.corners[i];
    double nearest = -2.0;
    for (const double s : facets.touches)
      nearest = std::max(nearest, dot(flat, frame_at(track, s).along) / norm(flat));
    CAPTURE(i, norm(flat));
    CHECK(nearest > 1.0 - 1e-9);
  }
}

}  // namespace

TEST_CASE("facets: flats lead on where those beside a turning point would be too short") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (int run = 0; run < 300; ++run) {
    const ArcSpline track = waves(random);
    const Span whole{0.0, track.length()};
    const double least = random.between(0.0, 0.4);
    CAPTURE(run, least);
    require_in_order(track, facets_by_angle(track, whole, random.between(0.02, 0.3), least));
    require_in_order(track, facets_by_length(track, whole, random.between(0.05, 0.5), least));
    require_in_order(track, facets_by_chord(track, whole, random.between(1e-4, 1e-2), least));
  }
}

TEST_CASE(
    "facets: flats at both ends are as long as what stands along them, where more than one bend is left") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  int longer = 0;
  for (int run = 0; run < 200; ++run) {
    const ArcSpline track = waves(random, true);
    const Span whole{0.0, track.length()};
    const double least_end = random.between(0.05, 0.3);
    const double largest = random.between(0.02, 0.3);
    CAPTURE(run, least_end);
    const Facets plain = facets_by_angle(track, whole, largest, 0.02);
    const Facets kept = facets_by_angle(track, whole, largest, 0.02, least_end);
    const auto shorter_end = [](const Facets& facets) {
      return std::min(norm(facets.corners[1] - facets.corners[0]),
                      norm(facets.corners.back() - facets.corners[facets.corners.size() - 2]));
    };
    require_in_order(track, kept);
    if (kept.bends() < 2) continue;
    CHECK(shorter_end(kept) > least_end - 1e-9);
    if (shorter_end(plain) < least_end) ++longer;
  }
  CHECK(longer > 10);
}
