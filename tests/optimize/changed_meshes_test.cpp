// A mesh whose knots are put elsewhere: what lies between them goes along.

#include "glissade/core/units.hpp"
#include "glissade/optimize/optimize.hpp"

#include "optimize/mesh/refinement.hpp"
#include "support/catch.hpp"

#include <cmath>
#include <optional>
#include <vector>

namespace changed_meshes_test {

using namespace glissade;
using namespace glissade::optimizer;

namespace {

/// A bend within two short pieces, and fine knots within it and beside it.
MeshTrack with_corner() {
  MeshTrack begun;
  begun.mesh.knots = {0.0, 0.2, 0.4995, 0.5, 0.5005, 0.8, 1.0};
  begun.mesh.fine = {0.3, 0.4, 0.49975, 0.50025, 0.6, 0.7};
  begun.mesh.fine_turns = {0.01, -0.02, 1.0, -2.0, 0.03, 0.04};
  begun.mesh.core_length = 1.2;
  begun.z = {0.7, 0.1, 0.2, 0.5, 300.0, 0.6, 0.3, 0.1, 1.2};
  return begun;
}

/// Holds that fine knots of pieces that shrank lie at their shares of them, and all others where they were.
/// @param grown  by which the curvature within those pieces has grown
void check_fine_knots(const Mesh& before, const Mesh& after, double grown) {
  for (std::size_t k = 0; k < before.fine.size(); ++k) {
    const double place = count_pieces(before.knots, before.fine[k]);
    const auto piece = static_cast<std::size_t>(place);
    const bool shrank = after.knots[piece + 1] - after.knots[piece] <
                        (1.0 - 1e-9) * (before.knots[piece + 1] - before.knots[piece]);
    CAPTURE(k, place, shrank);
    // In the same piece, either way.
    const double now = count_pieces(after.knots, after.fine[k]);
    CHECK(now > static_cast<double>(piece));
    CHECK(now < static_cast<double>(piece + 1));
    if (shrank) {
      CHECK(now == Approx(place).epsilon(1e-9));
      CHECK(after.fine_turns[k] == Approx(grown * before.fine_turns[k]));
    } else {
      CHECK(after.fine[k] == before.fine[k]);
      CHECK(after.fine_turns[k] == before.fine_turns[k]);
    }
  }
}

}  // namespace

TEST_CASE("fine knots stay in their pieces where corners are made tighter") {
  const MeshTrack begun = with_corner();
  const std::optional<MeshTrack> tighter = with_tighter_corners(Transcription(begun.mesh), begun.z);
  REQUIRE(tighter);
  CHECK(tighter->mesh.knots[2] == Approx(0.499875).epsilon(1e-12));
  CHECK(tighter->z[4] == Approx(1200.0));
  CHECK(tighter->mesh.fine[2] == Approx(0.4999375).epsilon(1e-12));
  CHECK(tighter->mesh.fine_turns[2] == Approx(4.0));
  check_fine_knots(begun.mesh, tighter->mesh, 4.0);
}

TEST_CASE("so they do where ramps are made narrower") {
  MeshTrack begun = with_corner();
  begun.mesh.knots = {0.0, 0.2, 0.4995, 0.5005, 0.7, 0.8, 1.0};
  begun.mesh.fine = {0.3, 0.4, 0.4998, 0.6, 0.65};
  begun.mesh.fine_turns = {0.01, -0.02, 0.1, 0.03, 0.04};
  begun.z = {0.7, 0.1, 0.2, 0.3, 3.0, 2.9, 2.8, 2.7, 1.2};
  const std::optional<MeshTrack> narrow = with_narrow_jumps(Transcription(begun.mesh), begun.z);
  REQUIRE(narrow);
  CHECK(narrow->mesh.knots[3] - narrow->mesh.knots[2] == Approx(2e-4).epsilon(1e-9));
  CHECK(narrow->mesh.fine[2] == Approx(0.49996).epsilon(1e-12));
  check_fine_knots(begun.mesh, narrow->mesh, 1.0);
}

TEST_CASE(
    "a higher load is no slower where the first bend of a track that follows it is taken for a corner") {
  // One of these ended 2.8e-3 slower: fine knots lay across the knots, of a curvature that jumped where it was not to.
  Problem problem;
  problem.endpoints = {35.23988438, 63.1072077358};
  problem.body.friction = Friction::from_coefficient(0.082407);
  problem.body.drag_per_metre = 0.003147;
  problem.limits.exit_speed.highest = 32.51520649;
  problem.limits.arc_length.highest = 75.93818642;
  double before = HUGE_VAL;
  for (const double load : {5.2963, 5.296934657, 5.3022, 5.302231592, 5.3024, 5.31}) {
    problem.limits.highest_normal_load = load;
    const OptimizeReport report = optimize(problem).report;
    CAPTURE(load, report.brief());
    REQUIRE(report.status == OptimizeStatus::optimal);
    CHECK(report.travel_time < before * (1.0 + 1e-6));
    CHECK(report.finer_mesh_wins.value() < 1e-6);
    before = report.travel_time;
  }
}

}  // namespace changed_meshes_test
