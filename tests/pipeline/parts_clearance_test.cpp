// Parts of a build against what its design keeps clear of.

#include "pipeline/build/parts_clearance.hpp"

#include "glissade/core/math.hpp"
#include "glissade/pipeline.hpp"

#include "parts/bodies/body_edges.hpp"
#include "support/catch.hpp"

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

namespace {

using namespace glissade;

struct Job {
  double side = 1.0;     // +1: towards larger x
  double from = 0.0;     // x of the start [m]
  double beam_z = 2.05;  // top of a beam below the track [m]
  std::string more{};    // of the limits
  std::string fabrication = "{process: plate, split: {longest: 2 m}}";
};

std::string metres(double value) {
  return std::to_string(value) + " m";
}

std::string point(const Job& job, double x, double z) {
  return "[" + metres(job.from + job.side * x) + ", " + metres(z) + "]";
}

/// A straight channel 4 m down, 6 m out, and a beam below its middle.
Design design(const Job& job) {
  return parse_design(
      "glissade: 1\n"
      "track: {start: {x: " +
          metres(job.from) + ", z: 5 m}, finish: {x: " + metres(job.from + 6.0 * job.side) +
          ", z: 1 m}}\n"
          "body: {friction_angle: 17 deg, entry_speed: 1 m/s}\n"
          "centerline: {kind: straight}\n"
          "limits:\n"
          "  keep_outs: [{outline: [" +
          point(job, 2.5, 1.6) + ", " + point(job, 2.9, 1.6) + ", " + point(job, 2.9, job.beam_z) + ", " +
          point(job, 2.5, job.beam_z) + "], clearance: 100 mm}]\n" + job.more +
          "cross_section: {kind: u-channel, width: 400 mm, wall_height: 250 mm, thickness: 4 mm}\n"
          "fabrication: " +
          job.fabrication + "\nmesh: {tolerance: 2 mm}\nexport: [off]\n",
      "chute.yaml");
}

struct Found {
  Assembly assembly;
  std::vector<pipeline::PartApproach> parts;
};

Found closest(const Job& job) {
  const Design chute = design(job);
  Assembly assembly = assemble(chute, solve(chute));
  const Placement frame = assembly.track.placement.at_origin();
  std::vector<pipeline::PartApproach> parts =
      pipeline::closest_parts(chute, frame, assembly.fabrication->workshop);
  return {std::move(assembly), std::move(parts)};
}

double distance(Vec2 p, Vec2 low, Vec2 high) {
  const double x = std::max({low.x - p.x, 0.0, p.x - high.x});
  const double y = std::max({low.y - p.y, 0.0, p.y - high.y});
  return math::hypot(x, y);
}

/// By brute force over points along the edges of the bodies, in the site's own axes.
double least_distance(const Workshop& workshop, Vec2 low, Vec2 high) {
  double least = std::numeric_limits<double>::infinity();
  for (const ShopPart& part : workshop.parts) {
    const std::vector<Vec3> points = parts::edge_points(part.body, 0.0);
    for (const Frame& place : part.places) {
      for (const Vec3 at : points) {
        const Vec3 space = place.to_space(at);
        least = std::min(least, distance({space.x, 5.0 + space.z}, low, high));
      }
    }
  }
  return least;
}

}  // namespace

TEST_CASE(
    "parts clearance: frames that stand out below a channel come closer to a beam than the channel does") {
  // The joint lies above the beam; the channel keeps 100 mm, its frames do not.
  const Found found = closest({.beam_z = 2.93});
  REQUIRE(found.assembly.track.limit_checks.front().kept());
  REQUIRE(found.parts.size() == 1);
  const pipeline::PartApproach& near = found.parts.front();
  REQUIRE(near.limit == "keep_outs[0]");
  REQUIRE(near.asked == 0.1);
  REQUIRE(near.name.find("end_frame") == 0);
  const double expected = least_distance(found.assembly.fabrication->workshop, {2.5, 1.6}, {2.9, 2.93});
  REQUIRE(near.reached == Approx(expected).margin(1e-3));
  REQUIRE(near.reached <= expected + 1e-9);
  REQUIRE(near.reached < found.assembly.track.limit_checks.front().reached - 0.02);
}

TEST_CASE("parts clearance: mirrored and moved far away, the same distance") {
  const double here = closest({}).parts.front().reached;
  REQUIRE(closest({.side = -1.0}).parts.front().reached == Approx(here).margin(1e-9));
  REQUIRE(closest({.from = 5e6}).parts.front().reached == Approx(here).margin(1e-6));
}

TEST_CASE("parts clearance: legs may stand on the ground that the track stays above, but not in a beam") {
  const std::string ground = "  stay_above: [{line: [[-1 m, 0 m], [8 m, 0 m]], clearance: 300 mm}]\n";
  const std::string supported = "{process: plate, split: {longest: 2 m}, supports: {ground: 0 m}}";
  const Found found = closest({.more = ground, .fabrication = supported});
  REQUIRE(found.parts.size() == 2);
  for (const pipeline::PartApproach& near : found.parts) {
    CAPTURE(near.limit, near.name, near.reached);
    if (near.limit == "stay_above[0]") REQUIRE(near.reached > 0.3);
  }
}

TEST_CASE("parts clearance: none where clearances count from the centerline") {
  REQUIRE(closest({.more = "  clearances_from: centerline\n"}).parts.empty());
}

TEST_CASE("parts clearance: a frame in the way of a beam fails the shop's rule, with part and place") {
  const auto check_of = [](const Job& job) {
    const Design chute = design(job);
    const Assembly assembly = assemble(chute, solve(chute));
    for (const ShopCheck& check : assembly.fabrication->workshop.checks) {
      if (check.rule == "plate.clear") return check;
    }
    FAIL("no such check");
    return ShopCheck{};
  };
  const ShopCheck near = check_of({.beam_z = 2.93});
  REQUIRE(near.verdict == ShopVerdict::fail);
  REQUIRE(near.where.find("end_frame") == 0);
  REQUIRE(near.where.find("keep_outs[0]: ") != std::string::npos);
  REQUIRE(near.where.find(" of 100 mm, ") != std::string::npos);
  REQUIRE(check_of({.beam_z = 2.05}).verdict == ShopVerdict::pass);
}
