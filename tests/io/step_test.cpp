#include "glissade/core/error.hpp"
#include "glissade/io/step_file.hpp"

#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/shop_parts.hpp"
#include "support/temp_dir.hpp"

#include <cstddef>
#include <set>
#include <sstream>
#include <string>

namespace step_test {

using namespace glissade;

namespace {

std::string message_of(const std::filesystem::path& file) {
  try {
    (void)read_step_facts(file);
  } catch (const FileError& error) {
    return error.what();
  }
  return "read";
}

std::string refusal_of(PartBody body) {
  try {
    (void)step_text(testing::shop_part(7, "plate", std::move(body)));
  } catch (const InputError& error) {
    return error.what();
  }
  return "written";
}

}  // namespace

TEST_CASE(
    "STEP of an assembly: every part once, every place, closed shells, vertices on their curves and "
    "surfaces") {
  const TempDir directory;
  const Workshop workshop = testing::sample_workshop();
  const auto file = directory / "chute.step";
  write_step(file, workshop);
  require_same_step(file, workshop);
  const StepFacts facts = read_step_facts(file);
  REQUIRE(facts.solids.size() == 17);
  for (const StepSolid& solid : facts.solids) {
    CHECK(solid.closed);
    CHECK(solid.worst_gap_mm <= kStepAccuracy);
  }
  CHECK(facts.occurrences.size() == 19);
  CHECK(facts.solids[0].name == "01 left_wall");
  // A wall: 7 arcs on both edges, 9 holes, half circles at both ends of a slot; planes: faces, ends, slot.
  CHECK(facts.solids[0].cylinders == 14 + 9 + 2);
  CHECK(facts.solids[0].planes == 2 + 2 + 2);
  CHECK(facts.solids[1].cylinders == 12);
  CHECK(facts.solids[1].planes == 4);
  // A leaning plate: all four sides of each of its 6 arcs are cones, of its straight planes.
  CHECK(facts.solids[2].cones == 4 * 6);
  CHECK(facts.solids[2].planes == 4 + 2);
  CHECK(facts.solids[3].cylinders == 2);
  CHECK(facts.solids[3].planes == 2);
  const std::string text = bytes_of(file);
  CHECK(text == step_text(workshop));
  // Splines stand where a section moves across along an arc, and nowhere else.
  for (std::size_t i = 0; i < 9; ++i) CHECK(facts.solids[i].splines == 0);
  CHECK(facts.solids[9].splines == 4 * 5);
  // A floor: both faces and both edges of its 7 pieces, a tab and a step on one side each, a slot a piece, both ends.
  CHECK(facts.solids[6].cylinders == 2 * 6);
  CHECK(facts.solids[7].planes == 4 + 2 + 2);
  CHECK(facts.solids[8].planes == 2 + 2);
  // Holes are cylinders, whatever they go through.
  CHECK(facts.solids[10].cylinders == 2 * 6 + 2 * 7);
  CHECK(facts.solids[11].cylinders == 7);
  // Angles: two holes and a slot; three lines round a ring, two halves each; arcs and sides of half a one, a hole and a slot.
  CHECK(facts.solids[13].cylinders == 2 + 2);
  CHECK(facts.solids[13].planes == 3 + 3 + 2 + 2);
  CHECK(facts.solids[14].cylinders == 3 * 2 + 6);
  CHECK(facts.solids[14].planes == 3);
  CHECK(facts.solids[15].cylinders == 3 + 1 + 2);
  CHECK(facts.solids[15].planes == 3 * 2 + 3 + 2 + 2);
  // A tube: both sides and four holes; both ends and the walls of its window.
  CHECK(facts.solids[16].cylinders == 2 + 4);
  CHECK(facts.solids[16].planes == 2 + 4);
  CHECK(facts.solids[11].cones == 4 * 6);
  CHECK(facts.solids[12].cylinders == 7);
  // Both faces, both edges, a slot and, but for one piece, a lap that make more of them.
  CHECK(facts.solids[12].cones == 6 * (4 + 2) + 2);
  for (std::size_t i = 10; i < 13; ++i) CHECK(facts.solids[i].splines == 0);
  // ISO 10303-21 has capital exponents, after a decimal point.
  CHECK(text.find(",7.525E-06,") != std::string::npos);
  CHECK(text.find("e-") == std::string::npos);
  CHECK(text.find("'Chute with ''quotes'', L\\X2\\00E4\\X0\\nge'") != std::string::npos);
}

TEST_CASE("STEP of random parts is closed and exact, wherever they lie and however they turn") {
  const TempDir directory;
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  const auto file = directory / "part.step";
  for (int round = 0; round < 25; ++round) {
    PlaneRegion region = testing::metre_band(random.integer(1, 14), random.integer(0, 9));
    PlaneMotion motion = PlaneMotion::turn(random.between(-3.0, 3.0), {random.between(-50.0, 50.0), 1.0});
    motion.mirrored = round % 2 == 1;
    region = moved(region, motion);
    if (round % 3 == 0) region.outline = reversed(region.outline);
    ShopPart part = testing::shop_part(round, "plate", Prism{region, random.between(1e-3, 2.0)});
    if (round % 5 == 0) {
      part.body = testing::leaning_plate(random.between(-1.5, 3.0), random.between(0.05, 0.2), 0.004);
    }
    if (round % 5 == 1) {
      part.body =
          TubeGore{random.between(0.05, 0.3), 0.003, 0.4, Angle::from_radians(random.between(-0.3, 0.3)),
                   Angle::from_radians(random.between(-0.3, 0.3))};
    }
    write_step(file, part);
    CHECK_NOTHROW(require_same_step(file, part));
  }
}

TEST_CASE(
    "STEP of arcs all but straight, their centres thousands of kilometres away, is read back as written") {
  const TempDir directory;
  const auto file = directory / "part.step";
  for (const double sagitta : {1e-4, 1e-6, 1e-8, 1e-10}) {
    const double bulge = 2.0 * sagitta / 3.0;
    const Vec2 end{3.0 * std::cos(0.3), -3.0 * std::sin(0.3)};
    const Vec2 up{0.02 * std::sin(0.3), 0.02 * std::cos(0.3)};
    const ArcPath band{{{{0.0, 0.0}, bulge}, {end, 0.0}, {end + up, -bulge}, {up, 0.0}}, true};
    const ShopPart plate = testing::shop_part(1, "plate", Prism{{band, {}, {}}, 1.0});
    const ShopPart swept =
        testing::shop_part(2, "swept",
                           SweptBody{{{{{0.0, 0.0}, bulge}, {end, 0.0}}, false},
                                     {{0.0, 0.0}, {0.1, 0.2}, {0.1, 0.204}, {0.0, 0.004}}});
    for (const ShopPart& part : {plate, swept}) {
      INFO(part.name << " " << sagitta);
      write_step(file, part);
      CHECK_NOTHROW(require_same_step(file, part));
    }
  }
}

TEST_CASE("STEP writes each point, direction and frame once, coordinates to 1e-9 mm") {
  const std::string text = step_text(testing::sample_workshop());
  std::set<std::string> written;
  std::size_t points = 0;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const std::string entity = line.substr(line.find('=') + 1);
    const auto is = [&](const char* keyword) { return entity.rfind(keyword, 0) == 0; };
    if (!is("CARTESIAN_POINT(") && !is("DIRECTION(") && !is("VECTOR(") && !is("AXIS2_PLACEMENT_3D("))
      continue;
    INFO(line);
    CHECK(written.insert(entity).second);
    if (!is("CARTESIAN_POINT(")) continue;
    ++points;
    std::istringstream numbers(entity.substr(entity.rfind('(') + 1));
    for (std::string number; std::getline(numbers, number, ',');) {
      if (number.find('E') != std::string::npos) continue;
      CHECK(number.substr(number.find('.') + 1, number.find(')') - number.find('.') - 1).size() <= 9);
    }
  }
  CHECK(points > 500);
}

TEST_CASE("a STEP file that is not the parts is found out") {
  const TempDir directory;
  const auto file = directory / "chute.step";
  const Workshop workshop = testing::sample_workshop();
  const std::string good = step_text(workshop);
  const auto spoil = [&](const std::string& from, const std::string& to) {
    std::string bad = good;
    const std::size_t place = bad.find(from);
    REQUIRE(place != std::string::npos);
    put_bytes(file, bad.replace(place, from.size(), to));
    return [&] { require_same_step(file, workshop); };
  };
  CHECK_THROWS_AS(spoil(",.F.)", ",.T.)")(), InternalError);
  CHECK_THROWS_AS(spoil("01 left_wall", "01 left_wal")(), InternalError);
  CHECK_THROWS_AS(spoil("CYLINDRICAL_SURFACE('',#", "CYLINDRICAL_SURFACE('',#9999")(), FileError);
  CHECK_THROWS_AS(spoil("PLANE(", "B_SPLINE_SURFACE(")(), FileError);
  CHECK_THROWS_AS(spoil("7.525E-06", "7.525e-06")(), FileError);
  Workshop other = workshop;
  std::get<Prism>(other.parts[0].body).region.holes.pop_back();
  put_bytes(file, good);
  CHECK_THROWS_AS(require_same_step(file, other), InternalError);
  other = workshop;
  other.parts[3].places.pop_back();
  CHECK_THROWS_AS(require_same_step(file, other), InternalError);
  // A vertex moved by a micrometre.
  const std::size_t vertex = good.find("VERTEX_POINT");
  const std::size_t point = good.rfind("CARTESIAN_POINT('',(", vertex);
  std::string moved_text = good;
  moved_text.insert(point + 20, "1.E-3,0.,0.));#900000=CARTESIAN_POINT('',(");
  put_bytes(file, moved_text);
  CHECK_THROWS_AS(require_same_step(file, workshop), InternalError);
}

TEST_CASE(
    "a STEP file with a radius that coordinates do not carry is found out, however well vertices lie on it") {
  const TempDir directory;
  const auto file = directory / "flat.step";
  const auto part_of = [](double bulge) {
    PlaneRegion region{rectangle({0.0, 0.0}, {1.0, 0.2}), {}, {}};
    region.outline.vertices[0].bulge = bulge;
    return testing::shop_part(1, "plate", Prism{region, 0.004});
  };
  const ShopPart flat = part_of(1e-9);
  write_step(file, flat);
  CHECK_NOTHROW(require_same_step(file, flat));
  CHECK(read_step_facts(file).solids.front().largest_radius_mm == Approx(1000.0 / 4e-9));
  const ShopPart endless = part_of(1.4e-16);
  write_step(file, endless);
  CHECK_THROWS_AS(require_same_step(file, endless), InternalError);
}

TEST_CASE("a STEP file that is cut off or broken anywhere is an error, never more") {
  const TempDir directory;
  const auto file = directory / "broken.step";
  const std::string good =
      step_text(testing::shop_part(1, "pipe", TubeGore{0.05, 0.002, 1.0, {}, Angle::from_radians(0.1)}));
  for (std::size_t size = 0; size + 20 < good.size(); size += 97) {
    put_bytes(file, good.substr(0, size));
    CHECK(message_of(file).find("broken.step") != std::string::npos);
  }
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (int round = 0; round < 300; ++round) {
    std::string bad = good;
    for (int i = 0; i < 2; ++i) {
      bad[static_cast<std::size_t>(random.integer(0, static_cast<int>(bad.size()) - 1))] =
          static_cast<char>(random.integer(32, 126));
    }
    put_bytes(file, bad);
    CHECK_NOTHROW(message_of(file));
  }
}

TEST_CASE("bodies that are none are refused with what is wrong") {
  PlaneRegion region = testing::metre_band(3, 1);
  region.holes[0].radius = 1.0;
  CHECK(refusal_of(Prism{region, 0.004}) == "part 7, plate: hole 1 reaches outside the outline");
  CHECK(refusal_of(Prism{testing::metre_band(3, 1), 0.0}) == "part 7, plate: its depth is 0 mm");
  CHECK(refusal_of(TubeGore{0.1, 0.003, 0.02, Angle::from_radians(-0.3), Angle::from_radians(0.3)}) ==
        "part 7, plate: its end planes meet inside the tube: length 20 mm");
  SweptBody kinked = testing::leaning_plate(0.5, 0.2, 0.004);
  kinked.path.vertices[2].bulge = 0.0;
  CHECK(refusal_of(kinked) == "part 7, plate: its path has a kink after piece 2");
  CHECK(refusal_of(testing::leaning_plate(0.0, 1.5, 0.004))
            .find("its section reaches beyond the centre of arc 1, radius") != std::string::npos);
}

}  // namespace step_test
