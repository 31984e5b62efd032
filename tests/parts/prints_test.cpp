// Solids in pieces for a printer: they add up to the solid, fit the bed, match at their joints.

#include "glissade/parts/prints.hpp"

#include "glissade/centerline/coulomb_brachistochrone.hpp"
#include "glissade/centerline/straight_line.hpp"
#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/solid/mesh_facts.hpp"

#include "parts/bodies/joint_face.hpp"
#include "parts/bodies/piece_mesh.hpp"
#include "parts/prints/print_pose.hpp"
#include "parts/refusals.hpp"
#include "parts/supports/ground.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/shop_rules.hpp"
#include "support/shortfalls.hpp"
#include "support/thorough.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace prints_test {

namespace {

using namespace glissade;

const Friction kFriction = Friction::from_angle(Angle::from_degrees(10.0));

CrossSection groove() {
  return CrossSection::polygon({{-12e-3, -8e-3},
                                {12e-3, -8e-3},
                                {12e-3, 5e-3},
                                {10e-3, 5e-3},
                                {3e-3, 0.0},
                                {-3e-3, 0.0},
                                {-10e-3, 5e-3},
                                {-12e-3, 5e-3}});
}

CoulombBrachistochrone run() {
  return {{0.6, 0.35}, kFriction};
}

WorkshopBuild prints(const Centerline& track, const CrossSection& section, const PrintOptions& options = {}) {
  return make_prints(track, section, {PrintOptions::kArcTolerance}, options, 5e-5, Placement(),
                     {.friction = kFriction});
}

PrintOptions on_stands(double spacing) {
  StandOptions stands;
  stands.spacing = spacing;
  PrintOptions options;
  options.stands = std::move(stands);
  return options;
}

std::string refusal(const PrintOptions& options, const CrossSection& section) {
  return testing::refusal_of([&] { return prints(run(), section, options); });
}

Vec3 size_of(const TriangleMesh& mesh) {
  const MeshFacts facts = measure(mesh);
  return facts.upper - facts.lower;
}

}  // namespace

TEST_CASE(
    "prints: a run longer than the bed comes in pieces that fit it, valid each, and add up to the section's "
    "A S - M phi") {
  const CrossSection section = groove();
  const WorkshopBuild build = prints(run(), section);
  REQUIRE(build.joints.size() == 4);
  CHECK(build.prints.size() == 3 + 4);  // two pins a joint
  double volume = 0.0;
  for (const PrintPiece& piece : build.prints) {
    const MeshFacts facts = measure(piece.mesh);
    INFO(piece.name);
    CHECK(facts.valid());
    CHECK(facts.components == 1);
    const Vec3 size = facts.upper - facts.lower;
    CHECK(size.x <= 0.21 + 1e-12);
    CHECK(size.y <= 0.21 + 1e-12);
    CHECK(size.z <= 0.25);
    CHECK(facts.lower.z == 0.0);
    volume += facts.volume;
  }
  const ArcSpline& line = *build.master.spline;
  const double turned = line.slope_angle(0.0) - line.slope_angle(line.length());
  const double exact = section.area() * line.length() - section.first_moment() * turned;
  CHECK(std::fabs(build.proof.volume - exact) < 1e-9 * exact);
  CHECK(std::fabs(volume - build.proof.volume - build.proof.added_volume) < 2e-3 * exact);
  CHECK(build.proof.edge_mismatch < 1e-12);
  for (const ShopCheck& check : testing::shop_checks(build.workshop, "print")) {
    INFO(check.rule << " " << check.value << " " << check.bound << " " << check.where);
    CHECK(check.verdict == ShopVerdict::pass);
  }
}

TEST_CASE(
    "prints: a run that fits the bed slantwise is one piece without joints, and a shorter bed takes more "
    "pieces") {
  const CoulombBrachistochrone short_run({0.2, 0.12}, kFriction);
  const WorkshopBuild whole = prints(short_run, groove());
  CHECK(whole.joints.size() == 2);
  CHECK(whole.prints.size() == 1);
  std::size_t before = 1;
  for (const double side : {0.15, 0.1, 0.06}) {
    PrintOptions options;
    options.split.bed = {side, side, 0.1, 0.002};
    const WorkshopBuild build = prints(short_run, groove(), options);
    CHECK(build.joints.size() - 1 > before);
    before = build.joints.size() - 1;
    for (const PrintPiece& piece : build.prints) {
      const Vec3 size = size_of(piece.mesh);
      CHECK(std::max(size.x, size.y) <= side - 0.004 + 1e-12);
    }
  }
}

TEST_CASE(
    "prints: holes on both sides of a joint lie on one axis, and pins leave half the fit all round and play "
    "at both ends") {
  const WorkshopBuild build = prints(run(), groove());
  const ShopPart& pin = build.workshop.parts.back();
  REQUIRE(pin.name == "pin");
  const Vec3 size = size_of(std::get<MeshBody>(pin.body).mesh);
  const double pin_diameter = size.x;
  for (const Frame& place : pin.places) {
    int holes = 0;
    for (const ShopPart& part : build.workshop.parts) {
      if (part.name == "pin") continue;
      // Corners of a hole's walls: nearer to the pin's axis than to anything else of the piece.
      double nearest = 1.0;
      double deepest = 0.0;
      for (const Vec3& vertex : std::get<MeshBody>(part.body).mesh.vertices) {
        const Vec3 away = part.places.front().to_space(vertex) - place.origin;
        const double along = dot(away, place.z);
        const double radius = norm(away - along * place.z);
        if (along < -1e-3 || along > size.z + 1e-3 || radius > 0.51 * (pin_diameter + 0.15e-3)) continue;
        nearest = std::min(nearest, radius);
        deepest = std::max(deepest, std::fabs(along - 0.5 * size.z));
      }
      if (nearest == 1.0) continue;
      ++holes;
      CHECK(nearest >= 0.5 * (pin_diameter + 0.15e-3) - 1e-12);
      CHECK(deepest == Approx(0.5 * size.z + 0.5e-3).epsilon(1e-9));
    }
    CHECK(holes == 2);
  }
}

TEST_CASE(
    "prints: layers follow a groove on its side without a step; a channel stands on its end, its steps the "
    "sine of its turn") {
  const auto rule = [](const WorkshopBuild& build, const std::string& name) {
    return testing::check_of(testing::shop_checks(build.workshop, "print"), name).value;
  };
  CHECK(rule(prints(run(), groove()), "print.run-surface-step") == "0 mm");
  CHECK(rule(prints(run(), groove()), "print.overhang") == "35.54 deg");  // of the groove's side, atan(5/7)
  const WorkshopBuild channel = prints(run(), CrossSection::u_channel(30e-3, 15e-3, 3e-3));
  for (const PrintPiece& piece : channel.prints) CHECK(size_of(piece.mesh).z <= 0.25 + 1e-12);
  CHECK(rule(channel, "print.overhang") != "");
  CHECK(rule(channel, "print.run-surface-step") != "0 m");
}

TEST_CASE(
    "prints: a thin section goes without pins and says so; one asked for by its diameter is refused with the "
    "wall it leaves") {
  const CrossSection thin = CrossSection::slab(30e-3, 2e-3);
  PrintOptions options;
  options.ease = 0.0;
  options.number_depth = 0.0;
  const WorkshopBuild build = prints(run(), thin, options);
  CHECK(build.workshop.parts.back().name != "pin");
  const ShopCheck told = testing::check_of(testing::shop_checks(build.workshop, "print"), "print.joint");
  CHECK(told.verdict == ShopVerdict::warn);
  CHECK(told.value == "0");
  CHECK(told.bound == "at least 2");
  options.dowels.diameter = 1.5e-3;
  const std::string text = refusal(options, thin);
  INFO(text);
  CHECK(text.starts_with("dowels.diameter|diameter: holes of 1.65 mm leave a wall of "));
  CHECK(text.find("The printer's least wall is 0.9 mm") != std::string::npos);
  CHECK(text.find("dowels: none") != std::string::npos);
}

TEST_CASE(
    "prints: what no printer can make is refused with its key, value, bound and a way out, all of it at "
    "once") {
  PrintOptions options;
  options.split.bed = {0.02, 0.02, 0.02, 0.005};
  std::string text = refusal(options, groove());
  CHECK(text.find("split.bed|bed: 20 mm x 20 mm x 20 mm is too small for the section of 24 mm x 13 mm") == 0);
  options = {};
  options.split.allowed = false;
  CHECK(refusal(options, groove())
            .find("split.allowed|the track takes 3 pieces on a bed of 220 mm x 220 mm x 250 mm") == 0);
  options = {};
  options.layer = 0.0;
  options.dowels.fit = -1e-4;
  options.split.bed.z = -1.0;
  text = refusal(options, groove());
  CHECK(text.find("layer|layer: 0 mm is not positive") != std::string::npos);
  CHECK(text.find("dowels.fit|fit: -0.1 mm is negative") != std::string::npos);
  CHECK(text.find("split.bed|bed: -1 m is not positive") != std::string::npos);
}

TEST_CASE(
    "prints: numbers of a face touch neither its edge, nor its holes, nor one another, and read from "
    "outside") {
  const parts::FaceOutline face(groove());
  const std::vector<Vec2> holes = {face.roomiest(true), face.roomiest(false)};
  const auto place = parts::place_for_digits(face, 2, holes, 3e-3);
  REQUIRE(place);
  std::vector<Vec2> corners;
  for (const parts::Recess& bar : parts::sunk_digits("80", place->corner, place->height, 0.4e-3)) {
    CHECK(bar.volume() > 0.0);
    for (const Vec2 corner : bar.rings.front().corners) {
      CHECK(face.clearance(corner) >= 0.6e-3 - 1e-12);
      for (const Vec2 hole : holes) CHECK(norm(corner - hole) >= 3.6e-3 - 1e-12);
      corners.push_back(corner);
    }
  }
  CHECK(corners.size() == 4 * (7 + 6));
  // Of 1 the two right bars alone are cut.
  for (const parts::Recess& bar : parts::sunk_digits("1", {}, 1.0, 0.1)) {
    for (const Vec2 corner : bar.rings.front().corners) CHECK(corner.x >= 0.6 - parts::kBarWidth - 1e-12);
  }
}

TEST_CASE(
    "prints: random runs, sections and beds come as valid pieces within the bed, their volumes those of the "
    "solid") {
  testing::Random random = testing::seeded_random();
  for (int k = 0; k < (testing::thorough() ? 8 : 3); ++k) {
    const CoulombBrachistochrone track({random.between(0.2, 0.9), random.between(0.15, 0.5)}, kFriction);
    const double thickness = random.between(4e-3, 12e-3);
    const CrossSection section =
        k % 3 == 0 ? CrossSection::slab(random.between(15e-3, 60e-3), thickness)
        : k % 3 == 1
            ? CrossSection::u_channel(random.between(20e-3, 40e-3), random.between(5e-3, 20e-3), thickness)
            : CrossSection::half_pipe(random.between(20e-3, 40e-3), thickness);
    PrintOptions options;
    options.split.bed.x = random.between(0.1, 0.3);
    options.split.bed.y = random.between(0.1, 0.3);
    INFO("GLISSADE_SEED=" << random.seed() << ", problem " << k);
    WorkshopBuild build;
    try {
      build = prints(track, section, options);
    } catch (const InputError& error) {
      // A start without radius is wider than the section: it may fit no bed.
      CHECK(error.issues().front().where == "split.bed");
      continue;
    }
    double volume = 0.0;
    for (const PrintPiece& piece : build.prints) {
      const MeshFacts facts = measure(piece.mesh);
      CHECK(facts.valid());
      CHECK(facts.upper.x - facts.lower.x <= options.split.bed.x - 0.01 + 1e-9);
      CHECK(facts.upper.y - facts.lower.y <= options.split.bed.y - 0.01 + 1e-9);
      volume += facts.volume;
    }
    const double listed = build.proof.volume + build.proof.added_volume;
    CHECK(std::fabs(volume - listed) < 5e-3 * listed);
    CHECK(build.proof.volume == Approx(build.proof.exact_volume).epsilon(1e-6));
  }
}

TEST_CASE(
    "prints: the edge that a body meets at a joint is eased over as short a way as it is deep, and nothing "
    "else is") {
  PrintOptions plain;
  plain.ease = 0.0;
  const WorkshopBuild eased = prints(run(), groove());
  const WorkshopBuild sharp = prints(run(), groove(), plain);
  REQUIRE(eased.joints == sharp.joints);
  const double joints = static_cast<double>(eased.joints.size() - 2);
  // Half of ease squared, along the groove's floor and both its sides.
  const double expected = 0.5 * 0.2e-3 * 0.2e-3 * (6e-3 + 2.0 * std::sqrt(7e-3 * 7e-3 + 5e-3 * 5e-3));
  const double taken = (sharp.proof.added_volume - eased.proof.added_volume) / joints;
  CHECK(taken == Approx(expected).epsilon(0.1));
  CHECK(sharp.proof.volume == Approx(eased.proof.volume).epsilon(1e-12));
}

TEST_CASE(
    "prints: dovetails and tongues reach into the next piece, a fit narrower than their notches, and meshes "
    "hold what "
    "they add and take") {
  PrintOptions options;
  options.number_depth = 0.0;
  options.ease = 0.0;
  options.joint = PrintJoint::dowels;
  options.dowels.wanted = false;
  const WorkshopBuild butt = prints(run(), groove(), options);
  for (const PrintJoint joint : {PrintJoint::tongue, PrintJoint::dovetail}) {
    PrintOptions joined = options;
    joined.dowels = {};
    joined.joint = joint;
    joined.tongue.depth = 3e-3;
    joined.tongue.height = 4e-3;
    joined.tongue.chamfer = 0.0;
    const WorkshopBuild build = prints(run(), groove(), joined);
    const std::size_t joints = build.joints.size() - 2;
    REQUIRE(joints >= 2);
    CHECK(build.prints.size() == joints + 1);
    CHECK(build.proof.edge_mismatch < 1e-12);
    const double spread =
        joint == PrintJoint::dovetail ? 3e-3 * std::tan(Angle::from_degrees(10.0).radians()) : 0.0;
    const double rise = joint == PrintJoint::dovetail ? std::tan(Angle::from_degrees(10.0).radians()) : 0.0;
    CHECK(build.proof.smallest_gap == Approx(0.2e-3 / std::hypot(1.0, rise)).epsilon(1e-9));
    // Trapezoids over the width of the section, 24 mm: the head 4 mm, the notch 0.2 mm deeper and wider both ways.
    const double tongue = 24e-3 * 3e-3 * (4e-3 - spread);
    const double notch = 24e-3 * 3.2e-3 * (4e-3 - 2.0 * spread + 0.4e-3 + 3.2e-3 * rise);
    CHECK(build.proof.added_volume == Approx(static_cast<double>(joints) * (tongue - notch)).epsilon(1e-6));
    for (const PrintPiece& piece : build.prints) {
      const MeshFacts facts = measure(piece.mesh);
      CHECK(facts.valid());
      CHECK(facts.components == 1);
      CHECK(std::max(facts.upper.x - facts.lower.x, facts.upper.y - facts.lower.y) <= 0.21 + 1e-12);
    }
    const auto checks = testing::shop_checks(build.workshop, "print");
    CHECK(testing::check_of(checks, "print.joint").rule.empty());
    CHECK(testing::check_of(checks, "print.step-up").verdict == ShopVerdict::warn);  // nothing is eased
    CHECK(testing::check_of(checks, "print.hole-wall").verdict == ShopVerdict::pass);
    CHECK(testing::check_of(checks, "print.play-least").value == "0.2 mm");
  }
  CHECK(butt.proof.added_volume == Approx(0.0).margin(1e-15));
}

TEST_CASE(
    "prints: tongues of pieces that stand on a joint face taper by what overhangs, and stand on none of "
    "them") {
  const CrossSection channel = CrossSection::u_channel(30e-3, 15e-3, 8e-3);
  for (const PrintPose pose : {PrintPose::automatic, PrintPose::end, PrintPose::flat}) {
    PrintOptions options;
    options.joint = PrintJoint::tongue;
    options.pose = pose;
    options.number_depth = 0.0;
    options.ease = 0.0;
    options.tongue.chamfer = 0.0;
    const WorkshopBuild build = prints(run(), channel, options);
    const auto joints = static_cast<double>(build.joints.size() - 2);
    REQUIRE(joints >= 1.0);
    // Half of the floor's 8 mm at the root, 1 mm at the head, flanks of 45 deg: 1.5 mm deep; 30 and two times 8 mm wide.
    const double tongue = 46e-3 * 1.5e-3 * 2.5e-3;
    // The notch begins 0.2 mm wider both ways and goes 0.2 mm deeper.
    const double notch = 46e-3 * 1.7e-3 * (4.4e-3 - 1.7e-3);
    CHECK(build.proof.added_volume == Approx(joints * (tongue - notch)).epsilon(1e-6));
    CHECK(build.proof.smallest_gap == Approx(0.2e-3 / std::sqrt(2.0)).epsilon(1e-9));
    for (const PrintPiece& piece : build.prints) CHECK(measure(piece.mesh).valid());
    if (pose == PrintPose::flat) continue;
    // A face of the whole section on the bed, less the notch; never a tongue's head.
    for (const PrintPiece& piece : build.prints) {
      double area = 0.0;
      for (const auto& triangle : piece.mesh.triangles) {
        const Vec3 a = piece.mesh.vertices[triangle[0]];
        const Vec3 b = piece.mesh.vertices[triangle[1]];
        const Vec3 c = piece.mesh.vertices[triangle[2]];
        if (std::max({a.z, b.z, c.z}) < 1e-7) area += 0.5 * norm(cross(b - a, c - a));
      }
      CHECK(area > 0.6 * channel.area());
    }
  }
}

TEST_CASE("prints: dovetails of pieces that stand go into notches under a roof that the printer holds up") {
  const CrossSection channel = CrossSection::u_channel(30e-3, 15e-3, 9e-3);
  for (const double overhang : {45.0, 30.0}) {
    PrintOptions options;
    options.joint = PrintJoint::dovetail;
    options.overhang = Angle::from_degrees(overhang);
    options.number_depth = 0.0;
    options.ease = 0.0;
    options.tongue.chamfer = 0.0;
    options.tongue.depth = 2e-3;
    options.tongue.height = 4e-3;
    const WorkshopBuild build = prints(run(), channel, options);
    const auto joints = static_cast<double>(build.joints.size() - 2);
    REQUIRE(joints >= 1.0);
    const double flare = std::tan(Angle::from_degrees(10.0).radians());
    const double width = 48e-3;
    const double head = 4e-3 - 2e-3 * flare;
    // 0.2 mm wider both ways at the root and 0.2 mm deeper; above that the roof, down to 1 mm that is bridged.
    const double mouth = 4e-3 - 4e-3 * flare + 0.4e-3;
    const double top = mouth + 2.0 * 2.2e-3 * flare;
    const double roof = 0.5 * (top - 1e-3) / std::tan(options.overhang.radians());
    const double notch = 2.2e-3 * 0.5 * (mouth + top) + roof * 0.5 * (top + 1e-3);
    CHECK(build.proof.added_volume == Approx(joints * width * (2e-3 * head - notch)).epsilon(1e-6));
    CHECK(build.proof.smallest_gap == Approx(0.2e-3 / std::hypot(1.0, flare)).epsilon(1e-9));
    double bridged = 0.0;
    for (const PrintPiece& piece : build.prints) {
      CHECK(measure(piece.mesh).valid());
      for (const auto& triangle : piece.mesh.triangles) {
        const Vec3 a = piece.mesh.vertices[triangle[0]];
        const Vec3 b = piece.mesh.vertices[triangle[1]];
        const Vec3 c = piece.mesh.vertices[triangle[2]];
        if (std::max({a.z, b.z, c.z}) < 1e-7) continue;
        const Vec3 square = cross(b - a, c - a);
        // What hangs over by more than the printer holds up.
        if (-square.z > (std::sin(options.overhang.radians()) + 1e-6) * norm(square))
          bridged += 0.5 * norm(square);
      }
    }
    CHECK(bridged <= joints * width * 1e-3 * (1.0 + 1e-6));
  }
}

TEST_CASE("prints: numbers go into any flat outside that holds them, and leave a wall behind") {
  const auto deepest_y = [](const WorkshopBuild& build, double side) {
    // Vertices that lie the depth of a number within a side.
    std::size_t count = 0;
    for (const ShopPart& part : build.workshop.parts) {
      if (!part.name.starts_with("segment")) continue;
      for (const Vec3& vertex : std::get<MeshBody>(part.body).mesh.vertices) {
        if (std::fabs(vertex.y - side) < 1e-9) ++count;
      }
    }
    return count;
  };
  // Walls of a U-channel: full from side to side nowhere but in its floor.
  const CrossSection channel = CrossSection::u_channel(20e-3, 12e-3, 4e-3);
  CHECK(deepest_y(prints(run(), channel), 14e-3 - 0.4e-3) > 0);
  PrintOptions none;
  none.number_depth = 0.0;
  CHECK(deepest_y(prints(run(), channel, none), 14e-3 - 0.4e-3) == 0);
  // A wall of 1.2 mm has no room for 0.4 mm and a wall of 0.9 mm.
  CHECK(deepest_y(prints(run(), CrossSection::u_channel(20e-3, 12e-3, 1.2e-3)), 11.2e-3 - 0.4e-3) == 0);
  PrintOptions deep;
  deep.number_depth = 3e-3;
  CHECK(refusal(deep, channel).starts_with("number_depth|number_depth: 3 mm is more than 2 mm|"));
  PrintOptions eased;
  eased.ease = 0.8e-3;
  CHECK(refusal(eased, channel).starts_with("ease|ease: 0.8 mm is more than 0.5 mm|"));
}

TEST_CASE("prints: boards thinner than a number is deep have it in no face that it would go through") {
  PrintOptions options;
  options.split.bed = {0.08, 0.08, 0.08};
  const StraightLine down({0.25, 0.2});
  for (const double thickness : {1.01e-3, 1.3e-3, 2.5e-3, 3e-3}) {
    const CrossSection board =
        CrossSection::polygon({{-9e-3, -thickness}, {9e-3, -thickness}, {9e-3, 0.0}, {-9e-3, 0.0}});
    const auto vertices = [&](double deep) {
      options.number_depth = deep;
      std::size_t count = 0;
      for (const PrintPiece& piece : prints(down, board, options).prints) {
        CHECK(measure(piece.mesh).valid());
        count += piece.name.find("segment") == 0 ? piece.mesh.vertices.size() : 0;
      }
      return count;
    };
    const std::size_t plain = vertices(0.0);
    for (const double deep : {0.4e-3, 1.2e-3, 2e-3}) {
      INFO(thickness << " " << deep);
      CHECK((vertices(deep) > plain) == (deep + options.wall < thickness));
    }
  }
}

TEST_CASE("prints: pins and holes without chamfers are sound, and measures finer than printers are refused") {
  PrintOptions options;
  options.dowels.chamfer = 0.0;
  std::size_t pins = 0;
  for (const PrintPiece& piece : prints(run(), groove(), options).prints) {
    CHECK(measure(piece.mesh).valid());
    CHECK(measure(piece.mesh).shortest_edge > 0.1e-3);
    pins += piece.name.find("pin") == 0 ? 1 : 0;
  }
  CHECK(pins > 1);
  options.dowels.chamfer = 1e-8;
  CHECK(refusal(options, groove()) ==
        "dowels.chamfer|chamfer: 0.00001 mm is finer than 0.001 mm|No printer makes it.|0.5 mm, or 0 mm for "
        "none\n");
}

TEST_CASE("prints: pieces are as fine as a printer makes them, however coarse the solid is asked to be") {
  const CrossSection half_pipe = CrossSection::half_pipe(54e-3, 5e-3, 26e-3);
  const auto volume_at = [&](double tolerance) {
    const WorkshopBuild build = make_prints(run(), half_pipe, {PrintOptions::kArcTolerance}, {}, tolerance,
                                            Placement(), {.friction = kFriction});
    double sum = 0.0;
    for (const PrintPiece& piece : build.prints) {
      CHECK(measure(piece.mesh).valid());
      if (piece.name.find("segment") == 0) sum += measure(piece.mesh).volume;
    }
    return sum;
  };
  const double fine = volume_at(5e-5);
  for (const double tolerance : {5e-4, 2e-2}) {
    if (tolerance > 1e-2 || testing::thorough()) CHECK(volume_at(tolerance) == fine);
  }
  CHECK(volume_at(1e-5) != fine);
}

TEST_CASE("prints: pieces that are asked to be shorter or lighter than any are refused by that key") {
  PrintOptions options;
  options.split.longest = 0.1e-3;
  CHECK(refusal(options, groove())
            .starts_with("split.longest|longest: pieces of 0.1 mm are shorter than any|"));
  options = {};
  options.split.heaviest = 1e-4;
  CHECK(refusal(options, groove()).starts_with("split.heaviest|heaviest: 0.0001 kg is a piece of "));
}

TEST_CASE("prints: no part is heavier than allowed, with the tongue that it has, on stands as high as any") {
  PrintOptions options = on_stands(0.3);
  options.stands->ground = {{0.0, -0.15}, {0.3, -0.4}, {0.6, -0.45}};
  options.split.bed = {0.3, 0.3, 0.6, 5e-3};
  int combination = 0;
  for (const PrintJoint joint : {PrintJoint::dowels, PrintJoint::tongue, PrintJoint::dovetail}) {
    options.joint = joint;
    for (const double heaviest : {0.04, 0.06, 0.1}) {
      // Each with one of the three in turn, elsewhere than in CI.
      const int number = combination++;
      if (!testing::thorough() && number % 3 != number / 3) continue;
      options.split.heaviest = heaviest;
      const WorkshopBuild build = prints(run(), groove(), options);
      for (const ShopPart& part : build.workshop.parts) {
        INFO(part.name << ", no heavier than " << heaviest << " kg");
        CHECK(part.mass <= heaviest);
      }
    }
  }
  options.split.heaviest = 4e-3;
  options.joint = PrintJoint::dowels;
  CHECK(refusal(options, groove())
            .starts_with("split.heaviest|heaviest: 0.004 kg is less than a block of the stand"));
}

TEST_CASE("prints: stands with an uneven top come in blocks that are lower below it") {
  PrintOptions options = on_stands(0.3);
  options.stands->thickness = 40e-3;
  options.stands->steepest = Angle::from_degrees(75.0);
  options.stands->ground = {{0.0, -0.6}};
  options.split.bed.z = 0.1;
  const WorkshopBuild build = prints(run(), groove(), options);
  std::size_t blocks = 0;
  for (const PrintPiece& piece : build.prints) {
    if (!piece.name.starts_with("stand_")) continue;
    ++blocks;
    CHECK(size_of(piece.mesh).z <= 0.1);
  }
  CHECK(blocks > 10);
}

TEST_CASE("prints: stands that find no place are told with the slope there, the bound and one that does") {
  PrintOptions options = on_stands(0.08);
  CHECK(testing::shortfall_of(prints(run(), groove(), options).workshop, "steepest: ").find("start, ") !=
        std::string::npos);
  options.stands->steepest = Angle::from_degrees(25.0);
  const WorkshopBuild build = prints(run(), groove(), options);
  std::size_t standing = 0;
  for (const SettingOutPoint& point : build.workshop.setting_out) standing += point.what.find("stand") == 0;
  const std::string told = testing::shortfall_of(build.workshop, "steepest: ");
  INFO(told);
  CHECK(told.starts_with("stands.steepest|steepest: "));
  CHECK(told.find(" stands find no place (start, ") != std::string::npos);
  CHECK(told.find(" out; joint 1, ") != std::string::npos);
  CHECK(told.find(" deg steep|None stands below a run steeper than 25 deg.|steepest: ") != std::string::npos);
  options.stands->steepest = Angle::from_degrees(std::stod(told.substr(told.rfind("|steepest: ") + 11)));
  CHECK(testing::shortfalls_of(prints(run(), groove(), options).workshop).empty());
}

TEST_CASE(
    "prints: a foot that would stand beyond the line of the ground is refused, told from where to where") {
  PrintOptions options = on_stands(0.12);
  options.stands->ground = {{-0.1, -0.3}, {0.2, -0.4}};
  const std::string text = testing::refusal_of([&] { return prints(run(), groove(), options); });
  CHECK(
      text.find(
          "stands.ground|ground: its line ends 200 mm from the start along the run, and a foot stands at ") ==
      0);
}

TEST_CASE("prints: feet of stands are level on the highest ground below them") {
  PrintOptions options = on_stands(0.12);
  options.stands->ground = {{-0.1, -0.3}, {0.2, -0.4}, {0.21, -0.35}, {0.22, -0.4}, {0.8, -0.7}};
  const WorkshopBuild build = prints(run(), groove(), options);
  double least = 1.0;
  for (const ShopPart& part : build.workshop.parts) {
    if (!part.name.starts_with("stand_") || part.name == "stand_pin") continue;
    for (const Frame& place : part.places) {
      for (const Vec3& vertex : std::get<MeshBody>(part.body).mesh.vertices) {
        const Vec3 at = place.to_space(vertex);
        least = std::min(least, at.z - parts::ground_at(options.stands->ground, at.x));
      }
    }
  }
  CHECK(std::fabs(least) < 1e-9);
}

TEST_CASE("prints: a way out of pins or tongues without room is one") {
  PrintOptions options;
  const auto proposed = [](const std::string& text, const std::string& key) {
    const std::size_t at = text.rfind('|' + key + ": ");
    REQUIRE(at != std::string::npos);
    return std::stod(text.substr(at + key.size() + 3)) * 1e-3;
  };
  const CrossSection flat = CrossSection::slab(40e-3, 6e-3, 0.0, 0.0);
  options.dowels.diameter = 5e-3;
  options.dowels.depth = 10e-3;
  std::string text = refusal(options, flat);
  INFO(text);
  options.dowels.diameter = proposed(text, "diameter");
  options.dowels.depth = std::stod(text.substr(text.rfind("and depth: ") + 11)) * 1e-3;
  CHECK(prints(run(), flat, options).joints.size() > 2);
  // Where no pin has room, none is proposed.
  options.dowels = {};
  options.dowels.diameter = 3e-3;
  text = refusal(options, CrossSection::slab(40e-3, 2e-3, 0.0, 0.0));
  CHECK(text.ends_with("|a thicker section, or dowels: none\n"));
  // A flare that leaves no neck.
  options = {};
  options.joint = PrintJoint::dovetail;
  options.tongue.height = 2.2e-3;
  options.tongue.depth = 5.9e-3;
  text = refusal(options, groove());
  CHECK(text.starts_with(
      "tongue.depth|depth: a dovetail of 5.9 mm with a head of 2.2 mm has a neck of 0.119 mm|"));
  options.tongue.depth = proposed(text, "depth");
  CHECK(prints(run(), groove(), options).joints.size() > 2);
  options.tongue.depth.reset();
  options.tongue.height = 7e-3;
  options.tongue.height = proposed(refusal(options, groove()), "height");
  CHECK(prints(run(), groove(), options).joints.size() > 2);
}

TEST_CASE("prints: a bed that is proposed does, and so does another pose") {
  const CrossSection wide = CrossSection::trapezoid(115e-3, 29e-3, Angle::from_degrees(30.0), 6.3e-3);
  int combination = 0;
  for (const PrintPose pose : {PrintPose::automatic, PrintPose::side, PrintPose::end, PrintPose::flat}) {
    for (const CrossSection& section : {wide, groove()}) {
      // Each pose with one of the two in turn, elsewhere than in CI.
      const int number = combination++;
      if (!testing::thorough() && number % 2 != number / 2 % 2) continue;
      PrintOptions options;
      options.pose = pose;
      options.split.bed = {0.02, 0.02, 0.02, 5e-3};
      const std::string text = refusal(options, section);
      INFO(text);
      const std::string begin = "a bed of at least ";
      REQUIRE(text.find(begin) != std::string::npos);
      std::istringstream words(text.substr(text.find(begin) + begin.size()));
      std::string skipped;
      PrintBed& bed = options.split.bed;
      words >> bed.x >> skipped >> skipped >> bed.y >> skipped >> skipped >> bed.z;
      bed = {1e-3 * bed.x, 1e-3 * bed.y, 1e-3 * bed.z, 5e-3};
      CHECK(prints(run(), section, options).joints.size() > 2);
    }
  }
  PrintOptions options;
  options.pose = PrintPose::side;
  options.split.bed = {0.3, 0.2, 0.15, 5e-3};
  const std::string text = refusal(options, wide);
  CHECK(text.find(
            "|No piece of the track fits it on its side, with a gap of 5 mm round it.|pose: end, a bed") !=
        std::string::npos);
  options.pose = PrintPose::end;
  CHECK(prints(run(), wide, options).joints.size() > 2);
}

TEST_CASE("prints: joints that nothing holds are glued, others are not") {
  PrintOptions options = on_stands(0.3);
  CHECK(prints(run(), groove(), options).workshop.items.empty());
  options.dowels.wanted = false;
  const WorkshopBuild build = prints(run(), groove(), options);
  REQUIRE(build.workshop.items.size() == 1);
  CHECK(build.workshop.items.front().name == "adhesive for PLA");
  CHECK(build.workshop.items.front().quantity == build.joints.size() - 2);
}

TEST_CASE("prints: tongues are refused where a section has no place for them, with what would do") {
  PrintOptions options;
  options.joint = PrintJoint::dovetail;
  const CrossSection channel = CrossSection::u_channel(30e-3, 15e-3, 3e-3);
  CHECK(refusal(options, channel)
            .starts_with("joint|joint: a dovetail does not fit a section that is full from side to "
                         "side over 3 mm|With walls of 0.9 mm and its fit it takes 4.2 mm.|"));
  CHECK(refusal(options, CrossSection::pipe(20e-3, 3e-3))
            .starts_with("joint|joint: this section has no place for a dovetail"));
  options.pose = PrintPose::flat;
  CHECK(refusal(options, groove()).starts_with("pose|pose: a dovetail would overhang in pieces that lie as"));
  CHECK(refusal(options, groove()).ends_with("|pose: side or end, or joint: tongue, which tapers then\n"));
  options.pose = PrintPose::end;
  options.overhang = Angle::from_degrees(8.0);
  CHECK(refusal(options, groove())
            .starts_with("tongue.flare|flare: 10 deg overhangs in pieces that stand on a joint face|No more "
                         "than 8 deg from upright prints without supports.|flare: 8 deg, or pose: side"));
  options.overhang = PrintOptions().overhang;
  options.pose = PrintPose::automatic;
  options.dowels.fit = 0.3e-3;
  CHECK(refusal(options, groove()).starts_with("dowels|dowels: the joints have tongues"));
  options.dowels = {};
  options.tongue.height = 7e-3;
  CHECK(refusal(options, groove()).starts_with("tongue.height|height: a dovetail of 7 mm does not fit"));
  options.tongue.height.reset();
  options.tongue.depth = 90e-3;
  CHECK(refusal(options, groove()).starts_with("tongue.depth|depth: a dovetail of 90 mm with a head of "));
  options.joint = PrintJoint::tongue;
  CHECK(refusal(options, groove()).starts_with("tongue.depth|depth: a tongue of 90 mm leaves a wall of "));
  options.joint = PrintJoint::dovetail;
  // A U-channel with a thick floor has the place; on its side it overhangs, so that it stands.
  options.tongue.depth.reset();
  options.tongue.flare = Angle::from_degrees(44.0);
  options.overhang = Angle::from_degrees(40.0);
  CHECK(refusal(options, CrossSection::u_channel(30e-3, 15e-3, 8e-3))
            .starts_with("tongue.flare|flare: 44 deg"));
  PrintOptions pinned;
  pinned.tongue.fit = 0.3e-3;
  CHECK(refusal(pinned, groove()).starts_with("tongue|tongue: the joints have pins"));
}

TEST_CASE(
    "prints: stands below joints, ends and between carry the run a fit below it, in blocks that the printer "
    "holds") {
  PrintOptions options = on_stands(0.12);
  options.split.bed.z = 0.12;
  const WorkshopBuild build = prints(run(), groove(), options);
  const ArcSpline& line = *build.master.spline;
  std::size_t blocks = 0;
  std::size_t stands = 0;
  double last = 0.0;
  for (const SettingOutPoint& row : build.workshop.setting_out) {
    if (!row.what.starts_with("stand ")) continue;
    ++stands;
    INFO(row.what);
    // Plumb above the middle of its blocks, where the track reaches so far.
    CHECK(std::any_of(build.workshop.parts.begin(), build.workshop.parts.end(), [&](const ShopPart& part) {
      return part.name.starts_with("stand_") && part.name != "stand_pin" &&
             std::any_of(part.places.begin(), part.places.end(),
                         [&](const Frame& place) { return std::fabs(place.origin.x - row.x) < 1e-9; });
    }));
    CHECK(row.what.find("middle x " + rounded_text(row.x * 1e3, 6) + ", foot z ") != std::string::npos);
    if (last > 0.0) CHECK(row.x - last <= 0.12 + 0.02);
    last = row.x;
  }
  double lowest = 0.0;
  for (int k = 0; k <= 1000; ++k) {
    const CenterlinePoint at = line.at(line.length() * k / 1000.0);
    lowest = std::min(lowest, -at.drop - 8e-3 * std::cos(at.slope_angle));
  }
  for (const ShopPart& part : build.workshop.parts) {
    if (!part.name.starts_with("stand_") || part.name == "stand_pin") continue;
    ++blocks;
    INFO(part.name);
    const TriangleMesh& mesh = std::get<MeshBody>(part.body).mesh;
    const MeshFacts facts = measure(mesh);
    CHECK(facts.valid());
    CHECK(facts.volume == Approx(part.volume).epsilon(1e-9));
    CHECK(facts.upper.z - facts.lower.z <= 0.12 + 1e-9);
    CHECK(part.places.front().origin.z + facts.lower.z >= lowest - 10e-3 - 1e-6);
    // Every corner between the cheeks lies 0.2 mm below the underside or deeper.
    double nearest = 1.0;
    for (const Vec3& vertex : mesh.vertices) {
      const Vec3 at = part.places.front().to_space(vertex);
      if (std::fabs(vertex.y) > 12.2e-3 + 1e-9) continue;
      const bool is_cheek = std::any_of(mesh.vertices.begin(), mesh.vertices.end(), [&](const Vec3& other) {
        return other.x == vertex.x && other.y == vertex.y && other.z < vertex.z;
      });
      if (is_cheek) continue;
      for (int k = 0; k <= 2000; ++k) {
        const CenterlinePoint on = line.at(line.length() * k / 2000.0);
        nearest = std::min(nearest, std::hypot(at.x - on.x, at.z + on.drop));
      }
    }
    CHECK(nearest >= 8.2e-3 - 2e-6);
  }
  CHECK(stands >= 4);
  CHECK(blocks > stands);  // higher than the printer's 0.12 m
  CHECK(build.workshop.parts.back().name == "stand_pin");
  options.stands->clear = 2e-3;
  CHECK(
      refusal(options, groove()) ==
      "stands.clear|clear: 2 mm leaves stands no room|They are at least 4 mm high, and end 0.2 mm below the "
      "run.|clear: 4.2 mm or more\n");
  options.stands->ground = {{0.0, -0.2}};
  CHECK(refusal(options, groove()).find("too high|A stand is at least 4 mm high.|a lower ground") !=
        std::string::npos);
}

TEST_CASE("prints: in a section that is higher than each of its halves is wide, the two holes keep apart") {
  const CrossSection bar = CrossSection::polygon(
      {{-5.9e-3, -7.5e-3}, {5.9e-3, -7.5e-3}, {5.9e-3, 0.0}, {0.0, 0.0}, {-5.9e-3, 0.0}});
  const WorkshopBuild build = prints(run(), bar);  // threw: holes cut into each other
  CHECK(build.proof.pairs > 0);
  bool pins = false;
  for (const ShopPart& part : build.workshop.parts) pins = pins || part.name.find("pin") != std::string::npos;
  CHECK(pins);
}

}  // namespace prints_test
