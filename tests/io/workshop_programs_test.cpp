// What the programs of workshops make of our files: opinions that share no code with ours.

#include "glissade/centerline/coulomb_brachistochrone.hpp"
#include "glissade/io/dxf_file.hpp"
#include "glissade/io/mesh_file.hpp"
#include "glissade/io/step_file.hpp"
#include "glissade/io/three_mf_file.hpp"
#include "glissade/parts/prints.hpp"
#include "glissade/solid/mesh_facts.hpp"

#include "parts/bodies/body_mesh.hpp"
#include "support/catch.hpp"
#include "support/openscad_check.hpp"
#include "support/oracle.hpp"
#include "support/paths.hpp"
#include "support/shapes.hpp"
#include "support/shop_parts.hpp"
#include "support/temp_dir.hpp"
#include "support/workshop_shapes.hpp"

#include <cmath>
#include <sstream>
#include <string>
#include <vector>

namespace workshop_programs_test {

namespace {

using namespace glissade;

/// A side plate with holes, a slot, its number and a bend line [mm].
PlaneRegion plate_region(int arcs, int holes) {
  PlaneRegion region = testing::band(arcs, 3000.0, 250.0, holes);
  const Vec2 at = region.holes.back().centre + Vec2{60.0, 10.0};
  region.cutouts.push_back(
      {{{at, 0.0}, {at + Vec2{30.0, 0.0}, 1.0}, {at + Vec2{30.0, 12.0}, 0.0}, {at + Vec2{0.0, 12.0}, 1.0}},
       true});
  return region;
}

Drawing drawing_of(const PlaneRegion& region) {
  Drawing drawing;
  drawing.name = "plate";
  drawing.add(drawing.layer({"CUT", LineStyle::continuous, 0.25, 7}), region);
  const std::size_t mark = drawing.layer({"MARK", LineStyle::continuous, 0.18, 5});
  for (const ArcPath& stroke : stroked_text("07", {40.0, -400.0}, 20.0)) drawing.add(mark, stroke);
  drawing.line(drawing.layer({"BEND_UP", LineStyle::dashed, 0.18, 3}), {0.0, 0.0}, {100.0, 0.0});
  return drawing;
}

}  // namespace

TEST_CASE("ezdxf reads DXF files strictly, finds nothing to mend, and the same areas and holes",
          "[external]") {
  const auto python = python_with("ezdxf");
  if (!python) return;
  const TempDir directory;
  std::vector<std::string> arguments{test_data_path("io/oracles/dxf_facts.py")};
  std::vector<PlaneRegion> regions;
  for (const int arcs : {1, 4, 15}) {
    regions.push_back(plate_region(arcs, 2 + arcs));
    for (const DxfVersion version : {DxfVersion::r2000, DxfVersion::r12}) {
      const std::string name =
          (directory / (std::to_string(arcs) + (version == DxfVersion::r12 ? "r12.dxf" : ".dxf"))).string();
      write_dxf(name, drawing_of(regions.back()), {version});
      arguments.push_back(name);
    }
  }
  const Outcome run = run_program(*python, arguments);
  INFO(run.errors);
  REQUIRE(run.exit_code == 0);
  std::istringstream lines(run.output);
  for (const PlaneRegion& region : regions) {
    for (const bool old : {false, true}) {
      int errors = -1, fixes = -1, units = 0, open = 0, texts = -1, others = -1;
      std::size_t circles = 0;
      double area = 0.0;
      REQUIRE(lines >> errors >> fixes >> units >> area >> circles >> open >> texts >> others);
      CHECK(errors == 0);
      CHECK(fixes == 0);
      CHECK(units == 4);
      CHECK(circles == region.holes.size());
      CHECK(texts == 0);
      if (old) continue;  // lines and arcs belong to no contour
      CHECK(others == 0);
      CHECK(open >= 3);
      CHECK(area == Approx(moments(region).area).epsilon(1e-12));
    }
  }
}

TEST_CASE("OpenSCAD takes R12 as the plate, and R2000 as the plate of its chords", "[external]") {
  // OpenSCAD 2021.01 reads the corners of an LWPOLYLINE and not its bulges.
  const TempDir directory;
  const PlaneRegion region = plate_region(4, 5);
  PlaneRegion chords = region;
  for (PathVertex& vertex : chords.outline.vertices) vertex.bulge = 0.0;
  for (PathVertex& vertex : chords.cutouts.front().vertices) vertex.bulge = 0.0;
  Drawing drawing;
  drawing.add(drawing.layer({"CUT", LineStyle::continuous, 0.25, 7}), region);
  for (const DxfVersion version : {DxfVersion::r2000, DxfVersion::r12}) {
    const auto file = directory / "plate.dxf";
    write_dxf(file, drawing, {version});
    const OpenscadResult result =
        openscad_render("linear_extrude(1000) import(\"" + file.string() + "\", $fn = 720);");
    INFO(result.output);
    CHECK(result.clean());
    put_bytes(directory / "plate.off", result.off);
    const double area = measure(read_mesh(directory / "plate.off")).volume * 1e6;  // m^3 over 1 m, in mm^2
    const double meant = moments(version == DxfVersion::r12 ? region : chords).area;
    CHECK(area == Approx(meant).epsilon(3e-5));  // 720 chords a turn, six digits
  }
}

namespace {

constexpr double kPi = 3.14159265358979323846;

double volume_of(const Prism& prism) {
  return moments(prism.region).area * prism.depth;
}

/// A plane through the tube's axis at its middle cuts off as much as it adds.
double volume_of(const TubeGore& gore) {
  const double outer = gore.inner_radius + gore.thickness;
  double volume = kPi * (outer * outer - gore.inner_radius * gore.inner_radius) * gore.length;
  // Developed: windows by the mean circumference, holes as out of a flat plate.
  for (const TubeWindow& window : gore.windows) {
    volume -= (gore.inner_radius + 0.5 * gore.thickness) * (window.high.radians() - window.low.radians()) *
              (window.to - window.from) * gore.thickness;
  }
  for (const TubeHole& hole : gore.holes) volume -= kPi * hole.radius * hole.radius * gore.thickness;
  return volume;
}

/// Pappus and Guldin: area times the way of its centre.
double volume_of(const MeshBody& body) {
  return measure(body.mesh).volume;
}

/// What holes take out: as out of a flat plate, but for (hole over radius)^2 / 8 of it.
double drilled(const std::vector<Circle>& holes, double thickness) {
  double volume = 0.0;
  for (const Circle& hole : holes) volume += kPi * hole.radius * hole.radius * thickness;
  return volume;
}

double volume_of(const SweptBody& body) {
  const auto section_at = [&](std::size_t vertex) {
    ArcPath section{{}, true};
    for (std::size_t j = 0; j < body.section.size(); ++j) {
      const double shift = body.shifts.empty() ? 0.0 : body.shifts[vertex][j];
      section.vertices.push_back({body.section[j] + Vec2{0.0, shift}});
    }
    return moments({section, {}, {}});
  };
  double volume = 0.0;
  const std::vector<PathPiece> pieces = pieces_of(body.path);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const double turned = 4.0 * std::atan(pieces[i].bulge);
    // Area and moment change evenly where corners move across alone.
    for (const AreaMoments& area : {section_at(i), section_at(i + 1)})
      volume += 0.5 * area.area * (length(pieces[i]) - turned * area.centroid.x);
  }
  return volume - drilled(body.holes, norm(body.section.at(2) - body.section.at(1)));
}

/// Facet by facet: two triangles of each of its six plane faces.
double volume_of(const FoldedPlate& plate) {
  double volume = 0.0;
  for (std::size_t i = 0; i + 1 < plate.corners.size(); ++i) {
    const auto& a = plate.corners[i];
    const auto& b = plate.corners[i + 1];
    const auto add = [&](Vec3 p, Vec3 q, Vec3 r) {
      volume += dot(p - a[0], cross(q - a[0], r - a[0])) / 6.0;
    };
    add(a[0], a[1], a[2]);
    add(a[0], a[2], a[3]);
    add(b[0], b[2], b[1]);
    add(b[0], b[3], b[2]);
    for (std::size_t k = 0; k < 4; ++k) {
      add(a[k], b[k], b[(k + 1) % 4]);
      add(a[k], b[(k + 1) % 4], a[(k + 1) % 4]);
    }
  }
  return std::fabs(volume);
}

/// Sheet by sheet: area on the path, and what its lower face is longer.
double volume_of(const RolledSheet& sheet) {
  if (!sheet.bevels.empty()) return measure(parts::facets_of(sheet, 1e-6, 64)).volume;
  double start = 0.0;
  double volume = 0.0;
  for (const PathPiece& piece : pieces_of(sheet.path)) {
    const double whole = length(piece);
    double area = 0.0;
    // Shares of every rectangle of the region that lie on this piece, by Green over its edges along the path.
    for (std::size_t k = 0; k <= sheet.region.cutouts.size(); ++k) {
      const ArcPath& loop = k == 0 ? sheet.region.outline : sheet.region.cutouts[k - 1];
      const double sense = (signed_area(loop) > 0.0) == (k == 0) ? -1.0 : 1.0;
      for (const PathPiece& edge : pieces_of(loop)) {
        const double from = std::clamp(edge.from.x - start, 0.0, whole);
        const double to = std::clamp(edge.to.x - start, 0.0, whole);
        area += sense * (to - from) * edge.from.y;
      }
    }
    const double curvature = 4.0 * std::atan(piece.bulge) / whole;
    volume += area * sheet.thickness * (1.0 + 0.5 * curvature * sheet.thickness);
    start += whole;
  }
  return volume - drilled(sheet.region.holes, sheet.thickness);
}

bool has_holes(const PartBody& body) {
  if (const auto* const swept = std::get_if<SweptBody>(&body)) return !swept->holes.empty();
  if (const auto* const tube = std::get_if<TubeGore>(&body)) return !tube->holes.empty();
  const auto* const sheet = std::get_if<RolledSheet>(&body);
  return sheet != nullptr && !sheet->region.holes.empty();
}

/// Half a tube, whose planes cut off less than at its axis, and two sides.
double volume_of(const TroughGore& gore) {
  const double outer = gore.inner_radius + gore.thickness;
  const double turn = std::tan(gore.end_tilt.radians()) - std::tan(gore.start_tilt.radians());
  const double ring = 0.5 * kPi * (outer * outer - gore.inner_radius * gore.inner_radius) * gore.length;
  const double wedge = 2.0 / 3.0 * (std::pow(outer, 3.0) - std::pow(gore.inner_radius, 3.0)) * turn;
  const double sides = 2.0 * gore.thickness * gore.side * (gore.length + 0.5 * gore.side * turn);
  return ring - wedge + sides;
}

/// Both legs: by Green over lines and arcs between heel and toe, heel and root.
double volume_of(const AngleBar& bar) {
  const auto area = [](const ArcPath& line, const ArcPath& left) {
    if (line.closed) return std::fabs(signed_area(line) - signed_area(left));
    ArcPath round = line;
    round.closed = true;
    round.vertices.back().bulge = 0.0;
    for (const PathVertex& vertex : reversed(left).vertices) round.vertices.push_back(vertex);
    round.vertices.back().bulge = 0.0;
    return std::fabs(signed_area(round));
  };
  double lying = area(bar.heel, bar.toe);
  for (const ArcPath& slot : bar.slots) lying -= std::fabs(signed_area(slot));
  return lying * bar.thickness + area(bar.heel, bar.root) * (bar.height - bar.thickness) -
         drilled(bar.holes, bar.thickness);
}

}  // namespace

TEST_CASE("Open CASCADE reads STEP as valid closed solids with the volumes of their closed forms",
          "[external]") {
  const auto python =
      python_with("sys, glob; sys.path.extend(glob.glob('/usr/lib/freecad*/lib')); import FreeCAD, Part");
  if (!python) return;
  const TempDir directory;
  const Workshop workshop = testing::sample_workshop();
  const auto file = directory / "chute.step";
  write_step(file, workshop);
  const Outcome run = run_program(*python, {test_data_path("io/oracles/step_facts.py"), file.string()});
  INFO(run.output << run.errors);
  REQUIRE(run.exit_code == 0);
  std::istringstream lines(run.output);
  std::size_t solids = 0;
  lines >> solids;
  std::size_t pieces = 0;
  for (const ShopPart& part : workshop.parts) pieces += part.quantity();
  CHECK(solids == pieces);
  const StepFacts facts = read_step_facts(file);
  for (std::size_t i = 0; i < workshop.parts.size(); ++i) {
    const double meant =
        std::visit([](const auto& body) { return volume_of(body); }, workshop.parts[i].body) * 1e9;
    for (std::size_t k = 0; k < workshop.parts[i].quantity(); ++k) {
      int valid = 0, closed = 0, others = -1;
      double volume = 0.0;
      std::size_t planes = 0, cylinders = 0, cones = 0;
      REQUIRE(lines >> valid >> closed >> volume >> planes >> cylinders >> cones >> others);
      INFO(workshop.parts[i].name);
      CHECK(valid == 1);
      CHECK(closed == 1);
      // Open CASCADE integrates over faces between ellipses numerically.
      const PartBody& body = workshop.parts[i].body;
      const bool exact = !std::holds_alternative<TubeGore>(body) &&
                         !std::holds_alternative<TroughGore>(body) && facts.solids[i].splines == 0;
      // Of holes in curved faces, whose edges are no circles, it finds as little as 99.8 %, of its own as well.
      const double near = has_holes(body) ? 2e-5 : exact ? 1e-8 : 2e-6;
      CHECK(volume == Approx(meant).epsilon(near));
      CHECK(planes == facts.solids[i].planes);
      CHECK(cylinders == facts.solids[i].cylinders);
      CHECK(cones == facts.solids[i].cones);
      CHECK(others == static_cast<int>(facts.solids[i].splines));
    }
  }
}

TEST_CASE("PrusaSlicer finds every piece of a 3MF file, whole and in its size", "[external]") {
  if (!oracle_is_there("prusa-slicer", {"--help"})) return;
  const TempDir directory;
  std::vector<PrintPiece> pieces;
  for (int i = 1; i <= 3; ++i) {
    pieces.push_back(
        {"ring " + std::to_string(i), "0" + std::to_string(i), shapes::torus(0.03, 0.002 * i, 40, 20)});
  }
  const auto file = directory / "rings.3mf";
  write_three_mf(file, laid_on_beds(pieces), "rings");
  const Outcome run = run_program("prusa-slicer", {"--info", file.string()});
  INFO(run.output << run.errors);
  std::size_t whole = 0;
  for (std::size_t at = run.output.find("manifold = yes"); at != std::string::npos;
       at = run.output.find("manifold = yes", at + 1)) {
    ++whole;
  }
  CHECK(whole == 3);
  CHECK(run.output.find("manifold = no") == std::string::npos);
  CHECK(run.output.find("size_z = 12.0") != std::string::npos);
}

TEST_CASE("PrusaSlicer finds every piece of a printed run on its beds, whole", "[external]") {
  if (!oracle_is_there("prusa-slicer", {"--help"})) return;
  const TempDir directory;
  const Friction friction = Friction::from_angle(Angle::from_degrees(10.0));
  const WorkshopBuild build =
      make_prints(CoulombBrachistochrone({0.6, 0.35}, friction), CrossSection::slab(40e-3, 12e-3),
                  {PrintOptions::kArcTolerance}, {}, 5e-5, Placement(), {.friction = friction});
  REQUIRE(build.prints.size() > 3);
  const auto file = directory / "run.3mf";
  write_three_mf(file, laid_on_beds(build.prints), "run");
  const Outcome run = run_program("prusa-slicer", {"--info", file.string()});
  INFO(run.output << run.errors);
  std::size_t whole = 0;
  for (std::size_t at = run.output.find("manifold = yes"); at != std::string::npos;
       at = run.output.find("manifold = yes", at + 1)) {
    ++whole;
  }
  CHECK(whole == build.prints.size());
  CHECK(run.output.find("manifold = no") == std::string::npos);
}

}  // namespace workshop_programs_test
