// Holes drilled through plates that are rolled: in bodies, solids and facets as in patterns.

#include "parts/bodies/bores.hpp"

#include "glissade/centerline/clothoid_spline.hpp"
#include "glissade/core/math.hpp"
#include "glissade/parts/plates.hpp"
#include "glissade/solid/mesh_facts.hpp"

#include "parts/bodies/body_depth.hpp"
#include "parts/bodies/body_edges.hpp"
#include "parts/bodies/body_mesh.hpp"
#include "parts/bodies/body_moments.hpp"
#include "parts/brep_faults.hpp"
#include "parts/chute_plates.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/shop_parts.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace bores_test {

namespace {

using namespace glissade;
using namespace testing;

/// A quarter of a ring of sheet, hollow or crest, with a hole in its middle.
RolledSheet ring(double radius, double hole, bool hollow) {
  RolledSheet sheet;
  const double bulge = math::tan(0.125 * std::numbers::pi);
  sheet.path = {{{{0.0, 0.0}, hollow ? bulge : -bulge}, {{radius, hollow ? radius : -radius}, 0.0}}, false};
  sheet.thickness = 4e-3;
  const double length = 0.5 * std::numbers::pi * radius;
  sheet.region.outline = rectangle({}, {length, 0.1});
  sheet.region.holes = {{{0.5 * length, 0.05}, hole}};
  return sheet;
}

/// Of a point from the two lines of a leaning sheet's section, by its distance from the axis of the arc.
double off_face(const parts::Bore& bore, double depth, Vec3 point) {
  const Vec3 away = point - bore.centre;
  const double x = dot(away, bore.along);
  const double y = dot(away, bore.across);
  return dot(away, bore.into) - bore.rise(depth, x, y);
}

/// Points of a rational curve by de Boor's sum.
std::vector<Vec3> points_of(const parts::RationalCurve& curve) {
  std::vector<Vec3> points;
  for (std::size_t half = 0; half < 2; ++half) {
    for (const double t : {0.0, 0.06, 0.13, 0.37, 0.5, 0.61, 0.81}) {
      Vec3 sum;
      double weights = 0.0;
      double choose = 1.0;
      for (std::size_t k = 0; k <= curve.degree; ++k) {
        const double bernstein = choose * std::pow(t, static_cast<double>(k)) *
                                 std::pow(1.0 - t, static_cast<double>(curve.degree - k));
        const double weight = bernstein * curve.weights.at(half * curve.degree + k);
        sum = sum + weight * curve.poles.at(half * curve.degree + k);
        weights += weight;
        choose *= static_cast<double>(curve.degree - k) / static_cast<double>(k + 1);
      }
      points.push_back((1.0 / weights) * sum);
    }
  }
  return points;
}

std::size_t holes_in(const PartBody& body) {
  if (const auto* const prism = std::get_if<Prism>(&body)) return prism->region.holes.size();
  if (const auto* const swept = std::get_if<SweptBody>(&body)) return swept->holes.size();
  if (const auto* const sheet = std::get_if<RolledSheet>(&body)) return sheet->region.holes.size();
  return 0;
}

}  // namespace

TEST_CASE("bores: what a hole takes out of a ring is the same by quadrature and by its series") {
  for (const bool hollow : {true, false}) {
    for (const double radius : {0.06, 0.3, 2.0, 50.0}) {
      for (const double hole : {2e-3, 6e-3, 11e-3}) {
        const RolledSheet sheet = ring(radius, hole, hollow);
        const double taken = parts::moments(parts::bores_of(sheet).front()).volume;
        const double least = hollow ? radius : radius - sheet.thickness;
        CHECK(std::fabs(taken / parts::drilled_volume(hole, sheet.thickness, least) - 1.0) < 1e-12);
        CHECK(std::fabs(taken / parts::drilled_by_layers(parts::bores_of(sheet).front()) - 1.0) < 1e-12);
        // Less than the straight cylinder by (hole / radius)^2 / 8.
        const double flat = std::numbers::pi * hole * hole * sheet.thickness;
        const double share = hole * hole / (8.0 * least * (least + sheet.thickness));
        CHECK(taken / flat - 1.0 == Approx(share).epsilon(0.05));
        RolledSheet plain = sheet;
        plain.region.holes.clear();
        CHECK(std::fabs((parts::moments(plain).volume - parts::moments(sheet).volume) / taken - 1.0) < 1e-10);
      }
    }
  }
  CHECK(parts::drilled_volume(0.01, 0.005, std::numeric_limits<double>::infinity()) ==
        Approx(std::numbers::pi * 5e-7).epsilon(1e-15));
}

TEST_CASE("bores: edges of holes lie on the hole's cylinder, and on both faces within (hole / radius)^4") {
  for (const double lean : {0.0, 0.3, 0.9}) {
    const RolledSheet sheet = lean == 0.0 ? drilled_floor() : leaning_sheet(lean);
    for (const parts::Bore& bore : parts::bores_of(sheet)) {
      parts::Brep brep;
      const parts::BoreLoops loops = parts::add_bore(brep, bore);
      for (const auto& [use, depth] : {std::pair(loops.face, 0.0), std::pair(loops.back, bore.depth)}) {
        const parts::BrepEdge& edge = brep.edges[use.edge];
        CHECK((edge.kind == parts::CurveKind::mouth) == (bore.from_axis != 0.0));
        if (edge.kind != parts::CurveKind::mouth) continue;
        const double ratio = bore.radius / bore.from_axis;
        for (const Vec3 point : points_of(parts::rational_mouth(edge))) {
          const Vec3 away = point - bore.centre;
          CHECK(std::fabs(math::hypot(dot(away, bore.along), dot(away, bore.across)) - bore.radius) < 1e-14);
          CHECK(std::fabs(off_face(bore, depth, point)) < 2.0 * bore.radius * ratio * ratio * ratio);
        }
      }
    }
  }
}

TEST_CASE("bores: through a plate that leans, heights and layers find the same volume") {
  for (const double lean : {0.2, 0.7, 1.3}) {
    for (const parts::Bore& bore : parts::bores_of(leaning_sheet(lean)))
      CHECK(std::fabs(parts::moments(bore).volume / parts::drilled_by_layers(bore) - 1.0) < 1e-12);
  }
}

TEST_CASE("bores: drilled bodies are closed surfaces, and their facets tend to their volume") {
  for (const PartBody& body :
       {PartBody(drilled_floor()), PartBody(drilled_leaning_plate()), PartBody(leaning_sheet()),
        PartBody(leaning_sheet(1.2)), PartBody(ring(1.0, 0.01, true)), PartBody(ring(1.0, 0.01, false))}) {
    ShopPart weighed = shop_part(1, "plate", body);
    INFO("body " << body.index() << ", " << holes_in(body) << " holes");
    parts::weigh(weighed);
    CHECK(fault_of(weighed) == "");
    const TriangleMesh mesh = parts::facets_of(body, 1e-5, 48);
    const MeshFacts facts = measure(mesh);
    CHECK(facts.boundary_edges == 0);
    CHECK(facts.non_manifold_edges == 0);
    CHECK(facts.self_intersections == 0);
    CHECK(facts.oriented_outward);
    CHECK(facts.euler_characteristic ==
          2 - 2 * static_cast<int>(holes_in(body) + (std::holds_alternative<RolledSheet>(body)
                                                         ? std::get<RolledSheet>(body).region.cutouts.size()
                                                         : 0)));
    CHECK(facts.volume == Approx(weighed.volume).epsilon(2e-5));
  }
}

TEST_CASE("bores: a sheet that leans weighs what the same plate does as a section along its path") {
  RolledSheet sheet = leaning_sheet();
  const double whole = length(sheet.path);
  sheet.region = {rectangle({}, {whole, 0.2}), {}, {{{0.7, 0.1}, 8e-3}}};
  sheet.bevels.pop_back();
  const Vec2 into{-sheet.across.y, sheet.across.x};
  const auto upper = [&](double y) { return sheet.foot + y * sheet.across; };
  const auto lower = [&](double y) { return upper(y) + sheet.thickness * into; };
  const SweptBody swept{
      sheet.path, {upper(0.0), upper(0.2), lower(0.197), lower(0.002)}, {}, {{{0.7, 0.1}, 8e-3}}};
  const parts::BodyMoments one = parts::moments(sheet);
  const parts::BodyMoments other = parts::moments(swept);
  CHECK(one.volume == Approx(other.volume).epsilon(1e-12));
  CHECK(norm(one.centroid - other.centroid) < 1e-9);
  for (const Vec3 point : parts::edge_points(swept, 20e-6)) {
    CHECK(parts::depth_inside(sheet, point) > 0.0);
    CHECK(parts::depth_inside(swept, point) > 0.0);
  }
}

TEST_CASE("bores: every hole of a pattern is one of the body, and tiles lie on floors hole upon hole") {
  PlateOptions options;
  options.split.longest = 2.9;
  options.liner.emplace();
  options.rim.emplace();
  options.cover.emplace();
  options.corners.kind = CornerJoint::tab_and_slot;
  const WorkshopBuild build = plates(chute(), options);
  std::size_t holes = 0;
  for (const ShopPart& part : build.workshop.parts) {
    if (!part.pattern || part.bought_in) continue;
    INFO(part.name);
    CHECK(holes_in(part.body) == part.pattern->region.holes.size());
    CHECK(fault_of(part) == "");
    holes += part.quantity() * holes_in(part.body);
    const MeshFacts facts = measure(parts::facets_of(part.body, 2e-4));
    CHECK(facts.boundary_edges + facts.non_manifold_edges + facts.self_intersections == 0);
  }
  CHECK(holes > 300);
  CHECK(build.proof.bolted > 150);
  REQUIRE(build.proof.differences.size() == 4);
  CHECK(build.proof.differences.back().what == "holes of the liner");
  double sum = build.proof.exact_volume;
  for (const VolumeDifference& one : build.proof.differences) sum += one.volume;
  CHECK(std::fabs(build.proof.volume / sum - 1.0) < kPartsVolumeAccuracy);
  // M8, coarse: 10 mm through 4 mm.
  std::size_t drilled = 0;
  for (const ShopPart* floor : named(build, "floor")) drilled += holes_in(floor->body);
  CHECK(-build.proof.differences.back().volume ==
        Approx(static_cast<double>(drilled) * std::numbers::pi * 25e-6 * 4e-3).epsilon(1e-4));
}

TEST_CASE("bores: holes keep off the joints of arcs, even where arcs are as short as they are") {
  PlateOptions options;
  options.liner.emplace();
  options.liner->tile_length = 0.15;
  const WorkshopBuild build =
      make_plates(chute(), kChannel, {1e-5}, options, Placement(), {.friction = kFriction});
  for (const ShopPart* tile : named(build, "tile")) {
    const auto& sheet = std::get<RolledSheet>(tile->body);
    double start = 0.0;
    for (const PathPiece& piece : pieces_of(sheet.path)) {
      start += length(piece);
      for (const Circle& hole : sheet.region.holes)
        CHECK((std::fabs(hole.centre.x - start) > hole.radius || start > length(sheet.path) - 1e-9));
    }
  }
  options.liner->tile_length = 40e-3;
  options.liner->bolt = 16;
  options.liner->thickness = 12e-3;
  options.liner->tile_width = 0.3;
  const std::string refused = refusal_of(
      [&] { return make_plates(chute(), kChannel, {1e-6}, options, Placement(), {.friction = kFriction}); });
  CHECK(refused.find("liner") != std::string::npos);
}

}  // namespace bores_test
