// Flats of bent floors and mitred tubes: one behind the other, whatever way a track turns.

#include "parts/bodies/facets.hpp"

#include "glissade/parts/arc_spline.hpp"

#include "support/random.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

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

/// Straight pieces and bends of one radius after the other, tangent; the first and the last may be either.
ArcSpline straights_and_arcs(testing::Random& random) {
  ArcPath path;
  Vec2 at;
  double heading = random.between(-1.2, -0.6);
  bool straight = random.integer(0, 1) == 0;
  for (int k = random.integer(2, 7); k > 0; --k) {
    const double turn = straight ? 0.0 : random.between(0.05, 0.4) * (random.integer(0, 1) == 0 ? -1.0 : 1.0);
    const double length = straight ? random.between(0.2, 2.0) : std::fabs(turn) * random.between(1.5, 8.0);
    path.vertices.push_back({at, std::tan(0.25 * turn)});
    const double chord = straight ? length : length * std::sin(0.5 * turn) / (0.5 * turn);
    at = at + chord * Vec2{std::cos(heading + 0.5 * turn), std::sin(heading + 0.5 * turn)};
    heading += turn;
    straight = !straight;
  }
  path.vertices.push_back({at, 0.0});
  return ArcSpline(path);
}

/// A place along flats, and the way of its flat.
TrackFrame on_flats(const Facets& facets, double place) {
  std::size_t i = 0;
  double length = norm(facets.corners[1] - facets.corners[0]);
  while (i + 2 < facets.corners.size() && place > length) {
    place -= length;
    ++i;
    length = norm(facets.corners[i + 1] - facets.corners[i]);
  }
  const Vec2 way = (1.0 / length) * (facets.corners[i + 1] - facets.corners[i]);
  return {facets.corners[i] + place * way, way, {-way.y, way.x}};
}

void require_places(const ArcSpline& track, const Facets& facets, testing::Random& random) {
  const FlatPlaces places = flat_places(track, facets);
  double whole = 0.0;
  for (std::size_t i = 0; i + 1 < facets.corners.size(); ++i)
    whole += norm(facets.corners[i + 1] - facets.corners[i]);
  REQUIRE(places.corners.size() == facets.corners.size());
  CHECK(places.flats_at(0.0) == 0.0);
  CHECK(places.flats_at(track.length()) == Approx(whole).epsilon(1e-12));
  double before = -1.0;
  double off_foot = 0.0;
  double off_track = 0.0;
  for (const double one : facets.misses) off_track = std::max(off_track, one);
  for (int k = 0; k <= 200; ++k) {
    const double s = track.length() * k / 200;
    const double place = places.flats_at(s);
    CHECK(place > before);
    before = place;
    CHECK(std::fabs(places.track_at(place) - s) < 1e-9);
    const TrackFrame on = on_flats(facets, place);
    const Vec2 off = frame_at(track, s).at - on.at;
    off_foot = std::max(off_foot, std::fabs(dot(off, on.along)));
    off_track = std::max(off_track, std::fabs(dot(off, on.up)));
  }
  CHECK(off_foot <= kFlatPlacesAccuracy * off_track + 1e-9);
  for (std::size_t i = 1; i + 1 < facets.corners.size(); ++i) {
    // A corner lies as near to its place as it misses the track.
    CHECK(norm(frame_at(track, places.corners[i]).at - facets.corners[i]) ==
          Approx(facets.misses[i - 1]).margin(1e-9));
  }
  for (const TrackArc& arc : track.arcs()) {
    if (arc.curvature != 0.0) continue;
    // Where a flat lies on a straight piece of the track, places are the same.
    for (int k = 0; k < 5; ++k) {
      const double s = arc.start + random.between(0.0, 1.0) * arc.length;
      const Vec2 at = frame_at(track, s).at;
      for (std::size_t i = 0; i + 1 < facets.corners.size(); ++i) {
        const Vec2 way = facets.corners[i + 1] - facets.corners[i];
        const double along = dot(at - facets.corners[i], way) / norm(way);
        if (std::fabs(cross(way, at - facets.corners[i])) > 1e-9 * norm(way) || along < 0.0 ||
            along > norm(way) || std::fabs(cross(way, frame_at(track, s).along)) > 1e-9 * norm(way))
          continue;
        CHECK(norm(on_flats(facets, places.flats_at(s)).at - at) < 1e-9);
      }
    }
  }
}

}  // namespace

TEST_CASE("facets: a place on the track is its foot on the flats, the same on straights, there and back") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (int run = 0; run < 60; ++run) {
    const ArcSpline track = run % 3 == 0 ? waves(random) : straights_and_arcs(random);
    const Span whole{0.0, track.length()};
    const double least = run % 2 == 0 ? 0.0 : random.between(0.02, 0.2);
    CAPTURE(run, least);
    require_places(track, facets_by_angle(track, whole, random.between(0.02, 0.3), least), random);
    require_places(track, facets_by_length(track, whole, random.between(0.05, 0.5), least), random);
    require_places(track, facets_by_chord(track, whole, random.between(1e-4, 1e-2), least), random);
  }
}

TEST_CASE("facets: what hardly turns between two bends takes no bend of its own") {
  for (const double hardly : {3e-9, -4e-8, -1e-6, 5e-5, -9e-5}) {
    ArcPath path;
    Vec2 at;
    double heading = -0.9;
    for (const double turn : {0.3, hardly, 0.2, hardly, -0.25}) {
      path.vertices.push_back({at, std::tan(0.25 * turn)});
      const double chord = 1.3 * std::sin(0.5 * turn) / (0.5 * turn);
      at = at + chord * Vec2{std::cos(heading + 0.5 * turn), std::sin(heading + 0.5 * turn)};
      heading += turn;
    }
    path.vertices.push_back({at, 0.0});
    const ArcSpline track(path);
    const Facets facets = facets_by_angle(track, {0.0, track.length()}, 0.1, 0.01, 0.01);
    CAPTURE(hardly, facets.bends());
    require_in_order(track, facets);
    for (const double kink : facets.kinks) CHECK(std::fabs(kink) > 1e-3);
    CHECK(bent_face(facets, 5e-3, 3e-3).length() < track.length() + 0.1);
  }
  // Flats that turn by next to nothing make a face all the same.
  Facets slight;
  slight.corners = {{0.0, 0.0}, {1.3, 0.0}, {2.9, 1.6 * 4e-8}};
  slight.kinks = {4e-8};
  slight.misses = {0.0};
  slight.touches = {0.0, 2.9};
  CHECK(bent_face(slight, 5e-3, 3e-3).length() == Approx(2.9).epsilon(1e-12));
}

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
