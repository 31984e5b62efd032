#include "glissade/io/mesh_file.hpp"
#include "glissade/io/scad_file.hpp"
#include "glissade/solid/mesh_facts.hpp"

#include "support/catch.hpp"
#include "support/openscad_check.hpp"
#include "support/shapes.hpp"

namespace external_programs_test {

using namespace glissade;
using namespace glissade::shapes;

namespace {

/// Volume of OpenSCAD's result [m^3], which it gives in millimetres.
double volume_of(const OpenscadResult& result) {
  const TempDir dir;
  put_bytes(dir / "result.off", result.off);
  return measure(read_mesh(dir / "result.off")).volume;
}

std::vector<Vec3> bent_line(double azimuth) {
  std::vector<Vec3> points;
  for (int i = 0; i <= 100; ++i) {
    const double run = 0.01 * i;
    points.push_back({0.1 + run * std::cos(azimuth), 0.2 + run * std::sin(azimuth), 1.0 - std::sqrt(run)});
  }
  return points;
}

const TriangleMesh kRing = torus(0.3, 0.1, 40, 20);

}  // namespace

TEST_CASE("OpenSCAD takes the solid of every format through a boolean operation unchanged", "[external]") {
  const TempDir dir;
  write_mesh(dir / "ring.stl", MeshFormat::stl_binary, kRing, {.unit = {}, .name = "ring"});
  write_mesh(dir / "text.stl", MeshFormat::stl_ascii, kRing,
             {.unit = {}, .name = "ring with facet in its name"});
  write_mesh(dir / "ring.off", MeshFormat::off, kRing, {.unit = {}, .name = "ring"});
  write_scad(dir / "ring.scad", kRing, bent_line(0.3), {.unit = {}, .name = "ring", .section = "round"});
  const double volume = measure(kRing).volume;
  // OpenSCAD prints OFF coordinates to six digits.
  constexpr double kPrinted = 1e-5;
  for (const char* name : {"ring.stl", "text.stl", "ring.off", "ring.scad"}) {
    const OpenscadResult result = openscad_check(dir / name);
    INFO(name << "\n" << result.output);
    CHECK(result.simple());
    CHECK(result.clean());
    CHECK(volume_of(result) == Approx(volume).epsilon(kPrinted));
  }
}

TEST_CASE("the check through OpenSCAD can fail", "[external]") {
  const TempDir dir;
  TriangleMesh open = kRing;
  open.triangles.pop_back();
  write_mesh(dir / "open.off", MeshFormat::off, open);
  bool passed = false;
  try {
    const OpenscadResult result = openscad_check(dir / "open.off");
    passed = result.simple() && result.clean();
  } catch (const std::runtime_error&) {
    passed = false;
  }
  CHECK_FALSE(passed);
}

TEST_CASE("an OpenSCAD file renders as it is, hostile names and all", "[external]") {
  const TempDir dir;
  write_scad(dir / "ring.scad", kRing, bent_line(0.0),
             {.unit = {}, .name = "*/ cube(1e4);\n cube(1e4); \"<>", .section = "\r\ncube(1e4);"});
  const OpenscadResult result = openscad_render(bytes_of(dir / "ring.scad"));
  CHECK(result.clean());
  CHECK(volume_of(result) == Approx(measure(kRing).volume).epsilon(1e-5));
}

TEST_CASE("another OpenSCAD file can use the centerline", "[external]") {
  const TempDir dir;
  write_scad(dir / "ring.scad", kRing, bent_line(2.5));
  const std::string use = "use <" + (dir / "ring.scad").string() + ">\n";
  const OpenscadResult bar =
      openscad_render(use + "echo(len(glissade_centerline_points()), glissade_centerline_points()[100]);\n" +
                      scad_with_difference("glissade_centerline(20);"));
  INFO(bar.output);
  CHECK(bar.simple());
  CHECK(bar.clean());
  CHECK(bar.output.find("ECHO: 101, [-701.144, 798.472, 0]") != std::string::npos);
  // A bar 20 mm square about the line, with half-round ends: within its polygons.
  double length = 0.0;
  const std::vector<Vec3> line = bent_line(2.5);
  for (std::size_t i = 1; i < line.size(); ++i) length += norm(line[i] - line[i - 1]);
  CHECK(volume_of(bar) == Approx(0.02 * (0.02 * length + 3.14 * 0.01 * 0.01)).epsilon(0.01));
  const TempDir result_dir;
  put_bytes(result_dir / "bar.off", bar.off);
  const MeshFacts facts = measure(read_mesh(result_dir / "bar.off"));
  CHECK(facts.upper.z == Approx(1.01).epsilon(1e-4));
}

TEST_CASE("admesh finds nothing to repair in STL files", "[external]") {
  const TempDir dir;
  for (const auto& [format, mesh] : {std::pair{MeshFormat::stl_binary, kRing},
                                     {MeshFormat::stl_ascii, kRing},
                                     {MeshFormat::stl_binary, unit_cube()}}) {
    write_mesh(dir / "mesh.stl", format, mesh);
    const AdmeshResult result = admesh_check(dir / "mesh.stl");
    INFO(result.output);
    CHECK(result.repaired_nothing());
  }
}

TEST_CASE("the check through admesh can fail", "[external]") {
  const TempDir dir;
  TriangleMesh mesh = unit_cube();
  std::swap(mesh.triangles[3][0], mesh.triangles[3][1]);
  write_mesh(dir / "mesh.stl", MeshFormat::stl_binary, mesh);
  CHECK_FALSE(admesh_check(dir / "mesh.stl").repaired_nothing());
}

TEST_CASE("admesh sees the volume that Glissade measures", "[external]") {
  const TempDir dir;
  write_mesh(dir / "mesh.stl", MeshFormat::stl_binary, kRing);
  const std::string output = admesh_check(dir / "mesh.stl").output;
  const std::size_t place = output.find("Volume   :");
  REQUIRE(place != std::string::npos);
  const double cubic_millimetres = std::strtod(output.c_str() + place + 10, nullptr);
  CHECK(cubic_millimetres * 1e-9 == Approx(measure(kRing).volume).epsilon(1e-5));
}

}  // namespace external_programs_test
