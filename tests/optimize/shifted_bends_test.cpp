// A bend that changes places with part of the stretch beside it: the same curvature in another order.

#include "optimize/search/shifted_bends.hpp"

#include "support/catch.hpp"

#include <cmath>
#include <memory>
#include <tuple>
#include <utility>

namespace shifted_bends_test {

using namespace glissade::optimizer;

namespace {

constexpr double kLength = 1.2;
constexpr double kSlope = 0.3;
constexpr Span kBefore{0.2, 0.4};
constexpr Span kBehind{0.6, 0.9};

/// Straight but for a wave between 0.4 and 0.6, which turns back what it turns.
/// @param fine  with knots between those that are unknowns, at which the wave is rounder
Found wave(bool fine = false) {
  Mesh mesh;
  if (fine) {
    mesh.fine = {0.425, 0.475, 0.525, 0.575};
    mesh.fine_turns = {-0.2, 0.3, -0.3, 0.2};
  }
  mesh.knots = {0.0, 0.1, 0.2, 0.3, 0.4, 0.45, 0.5, 0.55, 0.6, 0.7, 0.8, 0.9, 1.0};
  mesh.core_length = kLength;
  Found found;
  found.track = std::make_shared<const Transcription>(std::move(mesh));
  found.z = {kSlope, 0.0, 0.0, 0.0, 0.0, 0.0, 2.0, 0.0, -2.0, 0.0, 0.0, 0.0, 0.0, 0.0, kLength};
  return found;
}

GuessCurve curve_of(const MeshTrack& track) {
  return glissade::optimizer::curve_of(Transcription(track.mesh), track.z);
}

/// Where a curve leads, of a length of 1.
struct End {
  double x = 0.0;
  double y = 0.0;
};

End end_of(const GuessCurve& curve) {
  constexpr int kSteps = 20000;
  End end;
  for (int i = 0; i < kSteps; ++i) {
    const double zeta = curve.slope_angle((i + 0.5) / kSteps);
    end.x += std::cos(zeta) / kSteps;
    end.y += std::sin(zeta) / kSteps;
  }
  return end;
}

}  // namespace

TEST_CASE("a bend goes into the stretch behind it or before it, and the track leads to the same place") {
  const bool fine = GENERATE(false, true);
  CAPTURE(fine);
  const Found found = wave(fine);
  const GuessCurve known = glissade::optimizer::curve_of(*found.track, found.z);
  const End end = end_of(known);
  for (const double share : {0.5, 0.1, 0.025, -0.025, -0.1, -0.5}) {
    const double by = share > 0.0 ? share * (kBehind.to - kBehind.from) : share * (kBefore.to - kBefore.from);
    CAPTURE(share, by);
    const MeshTrack shifted = with_shifted_bend(found, kBefore, kBehind, share);
    REQUIRE(shifted.z.size() == shifted.mesh.knots.size() + 2);
    CHECK(shifted.mesh.knots.front() == 0.0);
    CHECK(shifted.mesh.knots.back() == 1.0);
    for (std::size_t i = 1; i < shifted.mesh.knots.size(); ++i)
      CHECK(shifted.mesh.knots[i] > shifted.mesh.knots[i - 1]);
    CHECK(shifted.z.front() == kSlope);
    CHECK(shifted.z.back() == kLength);
    const GuessCurve curve = curve_of(shifted);
    // Where the wave stood before it stands so much farther on; knots beside the seams take what lies between them.
    for (const double at : {0.42, 0.45, 0.5, 0.55, 0.58})
      CHECK_THAT(curve.slope_angle(at + by), Catch::Matchers::WithinAbs(known.slope_angle(at), 2e-3));
    const End there = end_of(curve);
    CHECK_THAT(there.x, Catch::Matchers::WithinAbs(end.x, 1e-3));
    CHECK_THAT(there.y, Catch::Matchers::WithinAbs(end.y, 1e-3));
  }
}

TEST_CASE("what follows a load between the knots of a bend goes along with it") {
  const Found found = wave(true);
  const Transcription& track = *found.track;
  for (const double share : {0.5, -0.5}) {
    const double by = share > 0.0 ? share * (kBehind.to - kBehind.from) : share * (kBefore.to - kBefore.from);
    const MeshTrack shifted = with_shifted_bend(found, kBefore, kBehind, share);
    CAPTURE(share, by);
    REQUIRE(shifted.mesh.fine.size() == track.mesh().fine.size());
    const Transcription there(shifted.mesh);
    for (std::size_t i = 0; i < shifted.mesh.fine.size(); ++i) {
      CHECK_THAT(shifted.mesh.fine[i], Catch::Matchers::WithinAbs(track.mesh().fine[i] + by, 1e-12));
      CHECK_THAT(there.fine_turn(shifted.z, i),
                 Catch::Matchers::WithinAbs(track.fine_turn(found.z, i), 1e-9));
    }
  }
}

TEST_CASE("a corner with which a bend begins goes along whole, however narrow it is") {
  constexpr double kHalf = 2e-5;
  constexpr double kTurn = 0.5;
  Mesh mesh;
  mesh.knots = {0.0, 0.1, 0.2, 0.3, 0.4, 0.4 + kHalf, 0.4 + 2.0 * kHalf, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0};
  mesh.core_length = kLength;
  Found found;
  found.track = std::make_shared<const Transcription>(std::move(mesh));
  found.z = {kSlope, 0.0, 0.0, 0.0, 0.0, 0.0, kTurn / kHalf, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, kLength};
  const GuessCurve known = glissade::optimizer::curve_of(*found.track, found.z);
  REQUIRE(std::fabs(known.slope_angle(0.5) - kSlope) > 0.9 * kTurn);
  for (const double share : {0.5, 0.025, -0.025, -0.5}) {
    const double by = share > 0.0 ? share * (kBehind.to - kBehind.from) : share * (kBefore.to - kBefore.from);
    CAPTURE(share, by);
    const GuessCurve curve = curve_of(with_shifted_bend(found, kBefore, kBehind, share));
    for (const double at : {0.39, 0.41, 0.5, 0.58})
      CHECK_THAT(curve.slope_angle(at + by), Catch::Matchers::WithinAbs(known.slope_angle(at), 1e-6));
  }
}

TEST_CASE("a bend between stretches that begin or end the track changes places with them, too") {
  const Found found = wave();
  for (const auto& [before, behind, share] :
       {std::tuple{Span{0.0, 0.4}, Span{0.6, 1.0}, 0.5}, std::tuple{Span{0.0, 0.4}, Span{0.6, 1.0}, -0.5},
        std::tuple{Span{0.0, 0.4}, Span{0.6, 1.0}, 1.0}, std::tuple{Span{0.0, 0.4}, Span{0.6, 1.0}, -1.0},
        std::tuple{Span{0.3, 0.6}, Span{1.0, 1.0}, -0.4}, std::tuple{Span{0.0, 0.0}, Span{0.6, 0.9}, 0.4}}) {
    CAPTURE(before.from, behind.to, share);
    const MeshTrack shifted = with_shifted_bend(found, before, behind, share);
    REQUIRE(shifted.z.size() == shifted.mesh.knots.size() + 2);
    CHECK(shifted.mesh.knots.front() == 0.0);
    CHECK(shifted.mesh.knots.back() == 1.0);
    for (std::size_t i = 1; i < shifted.mesh.knots.size(); ++i)
      CHECK(shifted.mesh.knots[i] > shifted.mesh.knots[i - 1]);
  }
}

TEST_CASE("shifted there and back a bend stands where it stood") {
  const Found found = wave();
  const MeshTrack there = with_shifted_bend(found, kBefore, kBehind, 0.5);
  Found shifted;
  shifted.track = std::make_shared<const Transcription>(there.mesh);
  shifted.z = there.z;
  const double by = 0.5 * (kBehind.to - kBehind.from);
  const Span before{kBefore.from, kBefore.to + by};
  const Span behind{kBehind.from + by, kBehind.to};
  const MeshTrack back = with_shifted_bend(shifted, before, behind, -by / (before.to - before.from));
  const GuessCurve known = glissade::optimizer::curve_of(*found.track, found.z);
  const GuessCurve curve = curve_of(back);
  for (int i = 0; i <= 100; ++i) {
    const double at = i / 100.0;
    CAPTURE(at);
    CHECK_THAT(curve.slope_angle(at), Catch::Matchers::WithinAbs(known.slope_angle(at), 4e-3));
  }
}

}  // namespace shifted_bends_test
