#include "glissade/core/error.hpp"
#include "glissade/io/mesh_file.hpp"
#include "glissade/io/scad_file.hpp"
#include "glissade/solid/mesh_facts.hpp"

#include "support/catch.hpp"
#include "support/file_size_limit.hpp"
#include "support/shapes.hpp"
#include "support/temp_dir.hpp"

#include <array>
#include <bit>
#include <clocale>
#include <cmath>
#include <ctime>
#include <functional>
#include <limits>
#include <stop_token>

#include <sched.h>

using namespace glissade;
using namespace glissade::shapes;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

std::string written(MeshFormat format, const TriangleMesh& mesh, const MeshFileOptions& options = {}) {
  const TempDir dir;
  write_mesh(dir / "mesh", format, mesh, options);
  CHECK(dir.names().size() == 1);
  return bytes_of(dir / "mesh");
}

std::uint32_t word_at(const std::string& bytes, std::size_t place) {
  std::uint32_t word = 0;
  for (std::size_t i = 4; i-- > 0;) word = (word << 8U) | static_cast<unsigned char>(bytes.at(place + i));
  return word;
}

float float_at(const std::string& bytes, std::size_t place) {
  return std::bit_cast<float>(word_at(bytes, place));
}

Vec3 position_at(const std::string& bytes, std::size_t place) {
  return {float_at(bytes, place), float_at(bytes, place + 4), float_at(bytes, place + 8)};
}

/// Leaves the process one core, and gives the others back at the end.
class OneCore {
 public:
  OneCore() {
    ::sched_getaffinity(0, sizeof before_, &before_);
    cpu_set_t one;
    CPU_ZERO(&one);
    for (std::size_t core = 0; core < CPU_SETSIZE; ++core) {
      if (CPU_ISSET(core, &before_) == 0) continue;
      CPU_SET(core, &one);
      break;
    }
    ::sched_setaffinity(0, sizeof one, &one);
  }
  ~OneCore() { ::sched_setaffinity(0, sizeof before_, &before_); }
  OneCore(const OneCore&) = delete;
  OneCore& operator=(const OneCore&) = delete;

 private:
  cpu_set_t before_{};
};

template <typename Call>
std::string input_error(Call&& call) {
  try {
    call();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace

TEST_CASE("binary STL is a named header, a count and 50 bytes a facet") {
  const std::string bytes = written(MeshFormat::stl_binary, tetrahedron(), {.unit = {}, .name = "Nose"});
  REQUIRE(bytes.size() == 84 + 4 * 50);
  CHECK(bytes.substr(0, 80) == "Glissade binary STL; unit: mm; Nose" + std::string(45, '\0'));
  CHECK(word_at(bytes, 80) == 4);
  // Last facet {1, 2, 3}: its normal, then its corners in millimetres.
  const std::size_t last = 84 + 3 * 50;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    CHECK(float_at(bytes, last + 4 * axis) == static_cast<float>(1.0 / std::sqrt(3.0)));
    for (std::size_t corner = 0; corner < 3; ++corner) {
      CHECK(float_at(bytes, last + 12 + 12 * corner + 4 * axis) == (axis == corner ? 1000.0F : 0.0F));
    }
  }
  CHECK(bytes.substr(last + 48) == std::string(2, '\0'));
}

TEST_CASE("each facet of a binary STL of several blocks is its unit normal and its corners") {
  // More facets than two blocks hold, and no round number of anything.
  const TriangleMesh mesh =
      as_written(torus(0.3, 0.1, 307, 101), MeshFormat::stl_binary, LengthUnit::millimetre);
  const std::string bytes = written(MeshFormat::stl_binary, mesh);
  REQUIRE(bytes.size() == 84 + 50 * mesh.triangles.size());
  std::size_t wrong_corners = 0;
  double worst_normal = 0.0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const std::size_t facet = 84 + 50 * i;
    std::array<Vec3, 3> corners{};
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 expected = mesh.vertices[mesh.triangles[i][k]];
      const Vec3 corner = position_at(bytes, facet + 12 + 12 * k);
      corners[k] = corner;
      if (!(Vec3{corner.x / 1000.0, corner.y / 1000.0, corner.z / 1000.0} == expected)) ++wrong_corners;
    }
    const Vec3 normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
    const Vec3 error = position_at(bytes, facet) - (1.0 / norm(normal)) * normal;
    worst_normal = std::max({worst_normal, std::fabs(error.x), std::fabs(error.y), std::fabs(error.z)});
    if (bytes.compare(facet + 48, 2, std::string(2, '\0')) != 0) ++wrong_corners;
  }
  CHECK(wrong_corners == 0);
  // Half a step of single precision, and what doubles round.
  CHECK(worst_normal <= 0x1p-25 + 1e-15);
}

TEST_CASE("one core writes the same bytes as several") {
  const TriangleMesh mesh = torus(0.3, 0.1, 307, 101);
  for (const MeshFormat format : {MeshFormat::stl_binary, MeshFormat::stl_ascii, MeshFormat::off}) {
    const std::string several = written(format, mesh);
    const OneCore one_core;
    CHECK(written(format, mesh) == several);
  }
}

TEST_CASE("normals keep unit length at both ends of single precision") {
  for (const float size : {0x1p-149F, 0x1p-126F, 1.0F, 0x1p127F}) {
    TriangleMesh mesh = tetrahedron();
    for (Vec3& p : mesh.vertices) p = static_cast<double>(size) * p;
    const std::string bytes = written(MeshFormat::stl_binary, mesh, {.unit = LengthUnit::metre, .name = ""});
    const std::size_t last = 84 + 3 * 50;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      CHECK(float_at(bytes, last + 4 * axis) == static_cast<float>(1.0 / std::sqrt(3.0)));
    }
  }
}

TEST_CASE("ASCII STL holds doubles in full") {
  TriangleMesh mesh = tetrahedron();
  mesh.vertices[1].x = 1.0 / 3.0;
  mesh.triangles = {{0, 2, 1}};
  const std::string text = written(MeshFormat::stl_ascii, mesh, {.unit = LengthUnit::metre, .name = "Nose"});
  CHECK(text ==
        "solid Glissade; unit: m; Nose\n"
        "facet normal 0 0 -1\n"
        "outer loop\n"
        "vertex 0 0 0\n"
        "vertex 0 1 0\n"
        "vertex 0.3333333333333333 0 0\n"
        "endloop\n"
        "endfacet\n"
        "endsolid Glissade; unit: m; Nose\n");
}

TEST_CASE("OFF says its unit and holds doubles in full") {
  TriangleMesh mesh = tetrahedron();
  mesh.vertices[1] = {1.2345678901234567, -0.0, 0x1p-30};
  CHECK(written(MeshFormat::off, mesh, {.unit = {}, .name = "Nose"}) ==
        "OFF\n# Glissade; unit: mm; Nose\n4 4 0\n"
        "0 0 0\n1234.5678901234567 0 9.313225746154785e-07\n0 1000 0\n0 0 1000\n"
        "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n");
}

TEST_CASE("same mesh, same bytes, whatever the locale") {
  const TriangleMesh mesh = torus(0.3, 0.1, 40, 20);
  for (const MeshFormat format : {MeshFormat::stl_binary, MeshFormat::stl_ascii, MeshFormat::off}) {
    const std::string first = written(format, mesh);
    // A locale with a decimal comma where the machine has one; the plain one otherwise.
    std::setlocale(LC_ALL, "de_DE.UTF-8");
    CHECK(written(format, mesh) == first);
    std::setlocale(LC_ALL, "C");
  }
}

TEST_CASE("no name can break a file") {
  const std::vector<std::string> names = {"solid",
                                          "line\nbreak\r\n\tfacet normal",
                                          "COLOR=red",
                                          "*/ # // \"",
                                          std::string(1'000'000, 'n'),
                                          std::string("\xff\xfe\0", 3),
                                          "Rutsche für Körner €",
                                          "\xE2\x80\xA8",
                                          "\xC2\x85 next line",
                                          std::string(1, '\0')};
  const TriangleMesh mesh = tetrahedron();
  for (const std::string& name : names) {
    const std::string binary = written(MeshFormat::stl_binary, mesh, {.unit = {}, .name = name});
    CHECK(binary.size() == 84 + 4 * 50);
    CHECK_THAT(binary, StartsWith("Glissade"));
    CHECK(binary.substr(0, 80).find("COLOR=") == std::string::npos);
    CHECK(word_at(binary, 80) == 4);
    const std::string off = written(MeshFormat::off, mesh, {.unit = {}, .name = name});
    CHECK(std::count(off.begin(), off.end(), '\n') == 3 + 4 + 4);
    CHECK(off.size() < 600);
    CHECK(off.find('\r') == std::string::npos);
    CHECK(off.find("\xE2\x80\xA8") == std::string::npos);
    const std::string ascii = written(MeshFormat::stl_ascii, mesh, {.unit = {}, .name = name});
    CHECK(std::count(ascii.begin(), ascii.end(), '\n') == 2 + 4 * 7);
  }
  const std::string umlauts = written(MeshFormat::off, mesh, {.unit = {}, .name = "Rutsche für Körner €"});
  CHECK_THAT(umlauts, Contains("; Rutsche für Körner €\n"));
}

TEST_CASE("a name is never cut within a character") {
  const std::string bytes =
      written(MeshFormat::stl_binary, tetrahedron(), {.unit = {}, .name = std::string(48, 'n') + "€€"});
  CHECK(bytes.substr(0, 80) == "Glissade binary STL; unit: mm; " + std::string(48, 'n') + '\0');
}

TEST_CASE("as written: binary STL holds single precision, text holds doubles") {
  const TriangleMesh mesh = torus(0.3, 0.1, 40, 20);
  const TriangleMesh single = as_written(mesh, MeshFormat::stl_binary, LengthUnit::millimetre);
  const TriangleMesh text = as_written(mesh, MeshFormat::off, LengthUnit::millimetre);
  CHECK(single.triangles == mesh.triangles);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const auto in_file = static_cast<double>(static_cast<float>(1000.0 * mesh.vertices[i].x));
    CHECK(single.vertices[i].x == in_file / 1000.0);
    CHECK(std::fabs(text.vertices[i].x - mesh.vertices[i].x) <= 0x1p-53);
  }
  CHECK(as_written(mesh, MeshFormat::stl_ascii, LengthUnit::metre).vertices == mesh.vertices);
}

TEST_CASE("as written twice is as written once") {
  const TriangleMesh mesh = torus(3.7, 1.1, 60, 30);
  for (const MeshFormat format : {MeshFormat::stl_binary, MeshFormat::off}) {
    for (const LengthUnit unit : {LengthUnit::millimetre, LengthUnit::metre}) {
      const TriangleMesh once = as_written(mesh, format, unit);
      CHECK(as_written(once, format, unit).vertices == once.vertices);
      CHECK(written(format, mesh, {.unit = unit, .name = ""}) ==
            written(format, once, {.unit = unit, .name = ""}));
    }
  }
}

TEST_CASE("vertices that single precision would merge stay apart, at most one step from where they were") {
  // At 5 m in millimetres a step is 2^-11 mm; eight vertices within a tenth of it.
  const double step = 0x1p-11;
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.vertices.push_back({(5000.0 + 0.3 * step + 0.01 * step * i) / 1000.0, 5.0, -5.0 + 1e-9 * i});
  }
  mesh.vertices.push_back(mesh.vertices[3]);
  const TriangleMesh result = as_written(mesh, MeshFormat::stl_binary, LengthUnit::millimetre);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const Vec3 error = 1000.0 * (result.vertices[i] - mesh.vertices[i]);
    CHECK(std::max({std::fabs(error.x), std::fabs(error.y), std::fabs(error.z)}) <= step * (1.0 + 1e-9));
    for (std::size_t j = 0; j < i; ++j) {
      CHECK((result.vertices[i] == result.vertices[j]) == (mesh.vertices[i] == mesh.vertices[j]));
    }
  }
  CHECK(as_written(result, MeshFormat::stl_binary, LengthUnit::millimetre).vertices == result.vertices);
}

TEST_CASE("a solid so far from the origin that single precision cannot hold it is refused") {
  const TriangleMesh far = moved(torus(0.3, 0.1, 40, 20), {1e6, 0, 0});
  const TempDir dir;
  const std::string message = input_error([&] { write_mesh(dir / "far.stl", MeshFormat::stl_binary, far); });
  CHECK_THAT(message, Contains(" by more than 45 deg: it is"));
  CHECK_THAT(message, Contains("at 1000 km its steps are 64 mm"));
  CHECK_THAT(message, Contains("Try: an origin so close that coordinates stay below"));
  CHECK(dir.names().empty());
  CHECK_NOTHROW(write_mesh(dir / "far.off", MeshFormat::off, far));
}

TEST_CASE("the size that a refusal names does work") {
  const auto pair_at = [](double x) { return TriangleMesh{{{x, x, x}, {x + 8e-6, x, x}}, {}}; };
  const double too_far = 1e4;
  const double good = 8e-6 * 0x1p21;
  TriangleMesh crowd = pair_at(too_far);
  for (int i = 7; i > 0; --i) crowd.vertices.push_back({too_far + 1e-6 * i, too_far, too_far});
  CHECK_THAT(input_error([&] { (void)as_written(crowd, MeshFormat::stl_binary, LengthUnit::metre); }),
             Contains("vertices 8 and 0") && Contains("below 2.1 m"));
  const TriangleMesh near = as_written(pair_at(good), MeshFormat::stl_binary, LengthUnit::metre);
  CHECK_FALSE(near.vertices[0] == near.vertices[1]);
}

TEST_CASE("a mesh that no file can hold is refused and leaves nothing behind") {
  const TempDir dir;
  const auto refused = [&dir](const TriangleMesh& mesh, MeshFormat format) {
    return input_error([&] { write_mesh(dir / "mesh", format, mesh); });
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_THAT(refused({{{0, 0, 0}}, {{0, 0, 1}}}, MeshFormat::off), Contains("vertex 1 does not exist"));
  CHECK_THAT(refused({{{0, nan, 0}}, {{0, 0, 0}}}, MeshFormat::stl_ascii),
             Contains("must be a finite number"));
  CHECK_THAT(refused({{{0, nan, 0}}, {{0, 0, 0}}}, MeshFormat::stl_binary),
             Contains("must be a finite number"));
  CHECK_THAT(refused({{{1e36, 0, 0}}, {{0, 0, 0}}}, MeshFormat::stl_binary),
             Contains("1e+39 mm does not fit"));
  for (const MeshFormat format : {MeshFormat::stl_binary, MeshFormat::stl_ascii, MeshFormat::off}) {
    CHECK_THAT(refused({{{0, 0, 0}}, {}}, format), Contains("the mesh has no facets"));
  }
  TriangleMesh late = as_written(torus(0.3, 0.1, 307, 101), MeshFormat::stl_binary, LengthUnit::millimetre);
  late.triangles[60'000][1] = 1'000'000;
  CHECK_THAT(refused(late, MeshFormat::stl_binary),
             Contains("triangle 60000 of the mesh: vertex 1000000 does not exist"));
  CHECK(dir.names().empty());
}

TEST_CASE("writing that was asked to end ends before it rounds, and leaves nothing behind") {
  // Rounding all of it, and looking at it, takes a hundred times what may pass.
  const TriangleMesh mesh = torus(0.3, 0.1, 2000, 500);
  const TempDir dir;
  const std::stop_source source = [] {
    std::stop_source asked;
    asked.request_stop();
    return asked;
  }();
  const auto seconds_of = [](const std::function<void()>& work) {
    const std::clock_t before = std::clock();
    CHECK_THROWS_AS(work(), Interrupted);
    return static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC;
  };
  constexpr double kMost = 0.02;  // budget: "some milliseconds", on a machine that others use [s]
  for (const MeshFormat format : {MeshFormat::stl_binary, MeshFormat::stl_ascii, MeshFormat::off}) {
    MeshFileOptions options;
    options.stop = source.get_token();
    CHECK(seconds_of([&] { write_mesh(dir / "mesh", format, mesh, options); }) < kMost);
    CHECK(seconds_of([&] { (void)as_written(mesh, format, LengthUnit::millimetre, source.get_token()); }) <
          kMost);
  }
  ScadFileOptions options;
  options.stop = source.get_token();
  CHECK(seconds_of([&] { write_scad(dir / "mesh", mesh, {{0, 0, 0}, {1, 0, 0}}, options); }) < kMost);
  CHECK(dir.names().empty());
}

TEST_CASE("a disk that fills up in the middle of a mesh leaves the old file and no other") {
  const TriangleMesh mesh = torus(0.3, 0.1, 400, 200);
  const TempDir dir;
  put_bytes(dir / "mesh", "old");
  for (const MeshFormat format : {MeshFormat::stl_binary, MeshFormat::stl_ascii, MeshFormat::off}) {
    std::string message;
    {
      const FileSizeLimit limit(3'000'000);
      try {
        write_mesh(dir / "mesh", format, mesh);
      } catch (const FileError& error) {
        message = error.what();
      }
    }
    CHECK_THAT(message, Contains("cannot write: File too large"));
    CHECK(bytes_of(dir / "mesh") == "old");
    CHECK(dir.names() == std::vector<std::string>{"mesh"});
  }
}

TEST_CASE("a facet without area has no normal") {
  const std::string text = written(MeshFormat::stl_ascii, {{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}});
  CHECK_THAT(text, Contains("facet normal 0 0 0\n"));
}
