#include "glissade/core/error.hpp"
#include "glissade/io/mesh_file.hpp"
#include "glissade/solid/mesh_facts.hpp"

#include "support/catch.hpp"
#include "support/shapes.hpp"
#include "support/temp_dir.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <limits>

#include <sys/resource.h>
#include <sys/stat.h>

using namespace glissade;
using namespace glissade::shapes;
using Catch::Matchers::Contains;

namespace {

TriangleMesh read_text(const std::string& bytes, LengthUnit unit = LengthUnit::metre) {
  const TempDir dir;
  put_bytes(dir / "in", bytes);
  return read_mesh(dir / "in", unit);
}

/// @return the message without the directory
std::string fault_of(const std::string& bytes) {
  const TempDir dir;
  put_bytes(dir / "in", bytes);
  try {
    (void)read_mesh(dir / "in");
  } catch (const FileError& error) {
    const std::string message = error.what();
    const std::string prefix = dir.path().string() + "/";
    REQUIRE(message.find(prefix) == 0);
    return message.substr(prefix.size());
  }
  return "no fault";
}

std::string bytes_of_word(std::uint32_t word) {
  std::string bytes;
  for (int i = 0; i < 4; ++i) bytes += static_cast<char>((word >> (8 * i)) & 0xFFU);
  return bytes;
}

std::string binary_stl(const std::vector<std::array<float, 9>>& facets, const std::string& title = "test") {
  std::string bytes = title + std::string(80 - title.size(), ' ');
  bytes += bytes_of_word(static_cast<std::uint32_t>(facets.size()));
  for (const auto& facet : facets) {
    bytes += std::string(12, '\0');
    for (const float coordinate : facet) bytes += bytes_of_word(std::bit_cast<std::uint32_t>(coordinate));
    bytes += std::string(2, '\0');
  }
  return bytes;
}

constexpr std::array<float, 9> kFacet = {0, 0, 0, 1, 0, 0, 0, 1, 0};

const std::string kAsciiFacet =
    "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";

}  // namespace

TEST_CASE("what is written is read back exactly as as_written() says") {
  const TriangleMesh mesh = torus(0.37, 0.11, 40, 20);
  const TempDir dir;
  for (const MeshFormat format : {MeshFormat::stl_binary, MeshFormat::stl_ascii, MeshFormat::off}) {
    for (const LengthUnit unit : {LengthUnit::millimetre, LengthUnit::metre}) {
      write_mesh(dir / "mesh", format, mesh, {.unit = unit, .name = "solid facet"});
      const TriangleMesh expected = as_written(mesh, format, unit);
      const TriangleMesh result = read_mesh(dir / "mesh", unit);
      CHECK(result.vertices.size() == expected.vertices.size());
      REQUIRE(result.triangles.size() == expected.triangles.size());
      // STL numbers vertices anew, so facets are compared by position.
      for (std::size_t i = 0; i < result.triangles.size(); ++i) {
        for (std::size_t corner = 0; corner < 3; ++corner) {
          REQUIRE(result.vertices[result.triangles[i][corner]] ==
                  expected.vertices[expected.triangles[i][corner]]);
        }
      }
      CHECK(measure(result).valid());
      if (format == MeshFormat::off) CHECK(result.triangles == mesh.triangles);
    }
  }
}

TEST_CASE("a large file of every format is read back the same") {
  // More than one block of every reader.
  const TriangleMesh mesh = torus(2, 0.7, 250, 120);
  const TempDir dir;
  for (const MeshFormat format : {MeshFormat::stl_binary, MeshFormat::stl_ascii, MeshFormat::off}) {
    write_mesh(dir / "first", format, mesh);
    write_mesh(dir / "second", format, read_mesh(dir / "first"));
    const TriangleMesh again = read_mesh(dir / "second");
    CHECK(again.triangles.size() == mesh.triangles.size());
    CHECK(again.vertices.size() == mesh.vertices.size());
    write_mesh(dir / "third", format, again);
    CHECK(bytes_of(dir / "second") == bytes_of(dir / "third"));
  }
}

TEST_CASE("binary STL is told by its size, whatever its header says") {
  for (const std::string title : {"solid part", "OFF", "", "facet"}) {
    const TriangleMesh mesh = read_text(binary_stl({kFacet}, title));
    CHECK(mesh.triangles.size() == 1);
    CHECK(mesh.vertices == std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  }
}

TEST_CASE("STL in millimetres is read in metres") {
  CHECK(read_text(binary_stl({kFacet}), LengthUnit::millimetre).vertices[1].x == 0.001);
  CHECK(read_text("OFF 3 1\n0 0 0 2500 0 0 0 1 0\n3 0 1 2", LengthUnit::millimetre).vertices[1].x == 2.5);
}

TEST_CASE("STL vertices at equal positions become one, -0 equals 0") {
  const TriangleMesh mesh = read_text(binary_stl({kFacet, {-0.0F, 0, 0, 0, 1, 0, -1, 0, 0}}));
  CHECK(mesh.vertices.size() == 4);
  CHECK(mesh.triangles[1] == std::array<std::uint32_t, 3>{0, 2, 3});
}

TEST_CASE("OFF vertices stay as they are") {
  const TriangleMesh mesh = read_text("OFF\n4 1 0\n0 0 0\n1 0 0\n0 1 0\n0 0 0\n3 0 1 2\n");
  CHECK(mesh.vertices.size() == 4);
  CHECK(measure(mesh).duplicate_vertices == 1);
}

TEST_CASE("ASCII STL is read in any case, with any white space, with several solids") {
  const std::string text =
      "  SOLID a name with facet and endsolid\r\n\r\nFACET NORMAL nan nan nan OUTER LOOP\r\n"
      "Vertex +1.5e0\t0 0 vertex 0 1. 0 vertex 0 0 .5e-400 ENDLOOP endfacet\r"
      "endsolid a name\n"
      "solid\n" +
      kAsciiFacet + "endsolid";
  const TriangleMesh mesh = read_text(text);
  REQUIRE(mesh.triangles.size() == 2);
  CHECK(mesh.vertices[0] == Vec3{1.5, 0, 0});
  CHECK(mesh.vertices[2] == Vec3{0, 0, 0});
}

TEST_CASE("OFF is read with comments, colours, several counts of white space, with and without edge count") {
  for (const std::string text : {
           "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
           "OFF 3 1 0\n0 0 0 1 0 0 0 1 0 3 0 1 2",
           "# made by hand\n\nOFF # so\n#\n3 1\n\n0 0 0 # origin\n1 0 0\n0 1 0\n3 0 1 2 255 0 0\n# end",
           "OFF\r\n3 1 0\r\n0 0 0\r\n1 0 0\r\n0 1 0\r\n3 0 1 2\r\n",
           "\xEF\xBB\xBFOFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 0.5 0.5 0.5 1\n",
           "COFF\n3 1 0\n0 0 0 1 0 0 1\n1 0 0 255 255 255\n0 1 0\n3 0 1 2\n",
           "NOFF\n3 1 0\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n3 0 1 2\n",
           "STCNOFF\n3 1 0\n0 0 0 9 9 9 9 9 9 9 9 9\n1 0 0 9\n0 1 0 9\n3 0 1 2\n",
       }) {
    const TriangleMesh mesh = read_text(text);
    CHECK(mesh.vertices == std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    CHECK(mesh.triangles == std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}});
  }
}

TEST_CASE("OFF polygons become fans without folds") {
  // An arrow head, concave at vertex 2: only a fan from there or from the tip, vertex 0, covers it.
  const TriangleMesh mesh = read_text("OFF\n4 1 0\n0 2 0\n-1 -1 0\n0 0 0\n1 -1 0\n4 0 1 2 3\n");
  CHECK(mesh.triangles == std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {0, 2, 3}});
  const TriangleMesh turned = read_text("OFF\n4 1 0\n0 2 0\n-1 -1 0\n0 0 0\n1 -1 0\n4 3 0 1 2\n");
  CHECK(turned.triangles == std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {0, 2, 3}});
  // Nobody in one arm of a U sees into the other.
  const std::string letter =
      "OFF\n8 1 0\n0 0 0\n3 0 0\n3 3 0\n2 3 0\n2 1 0\n1 1 0\n1 3 0\n0 3 0\n8 0 1 2 3 4 5 6 7\n";
  CHECK_THAT(fault_of(letter), Contains("in:11, facet 0: a polygon of 8 corners that no fan covers"));
}

TEST_CASE("a cube of squares is a valid solid") {
  const TriangleMesh cube = read_text(
      "OFF\n8 6 12\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n"
      "4 3 2 1 0\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n");
  const MeshFacts facts = measure(cube);
  CHECK(facts.valid());
  CHECK(facts.volume == Approx(1.0));
}

TEST_CASE("what is not a mesh is refused in one clear sentence") {
  CHECK(fault_of("") == "in: is empty");
  CHECK_THAT(fault_of("hello world"), Contains("in: is neither STL nor OFF"));
  CHECK_THAT(fault_of(std::string(100, 'x')), Contains("in: is neither STL nor OFF"));
  CHECK_THAT(fault_of(std::string(1'000'000, ' ')), Contains("in: is neither STL nor OFF"));
  CHECK_THAT(fault_of(std::string(10, '\0')), Contains("in: is neither STL nor OFF"));
  CHECK_THAT(fault_of(std::string(100, '\0')),
             Contains("as binary STL it claims 0 facets, which take 84 bytes"));
  CHECK(fault_of(std::string(84, '\0')) == "in: holds no facets");
  CHECK(fault_of("solid\nendsolid\n") == "in: holds no facets");
  CHECK(fault_of("OFF\n0 0 0\n") == "in: holds no facets");
}

TEST_CASE("truncated and damaged binary STL says what is wrong") {
  const std::string good = binary_stl({kFacet, kFacet});
  CHECK_THAT(fault_of(good.substr(0, 150)),
             Contains("claims 2 facets, which take 184 bytes, but it has 150") && Contains("truncated"));
  CHECK_THAT(fault_of(good + "x"), Contains("claims 2 facets, which take 184 bytes, but it has 185"));
  std::string absurd = good;
  absurd.replace(80, 4, std::string(4, '\xff'));
  CHECK_THAT(fault_of(absurd), Contains("claims 4294967295 facets, which take 214748364834 bytes"));
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                          -std::numeric_limits<float>::infinity()}) {
    CHECK(fault_of(binary_stl({kFacet, {0, 0, 0, 1, bad, 0, 0, 1, 0}})) ==
          "in, facet 2: a coordinate is not a finite number");
  }
}

TEST_CASE("faults in ASCII STL are told with line and facet") {
  const auto fault = [](const std::string& rest) { return fault_of("solid x\n" + kAsciiFacet + rest); };
  CHECK_THAT(fault(""),
             Contains("in:9, after facet 1: the file ends where \"facet\" or \"endsolid\" is due"));
  CHECK_THAT(fault("vertex"), Contains("in:9, after facet 1: \"vertex\" stands where \"facet\""));
  CHECK_THAT(fault("facet\nnormal 0 0 1\nouter loop\nvertex 0 0 nan"),
             Contains("in:12, facet 2: coordinate \"nan\" is not a finite number"));
  CHECK_THAT(fault("facet normal 0 0 1 outer loop vertex 0 -inf 0"), Contains("coordinate \"-inf\""));
  CHECK_THAT(fault("facet normal 0 0 1 outer loop vertex 0 1e999 0"), Contains("\"1e999\" is too large"));
  CHECK_THAT(fault("facet normal 0 0 1 outer loop vertex 0 1e70 0"), Contains("\"1e70\" is too large"));
  CHECK_THAT(fault("facet normal 0 0 1 outer loop vertex 0 1,5 0"),
             Contains("\"1,5\" stands where a coordinate"));
  CHECK_THAT(fault("facet normal 0 0 1 outer loop vertex 0 0"),
             Contains("the file ends where a coordinate is due"));
  CHECK_THAT(fault("facet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0 endloop"),
             Contains("\"endloop\" stands where \"vertex\" is due"));
  CHECK_THAT(fault("endsolid\nsoild"), Contains("in:10, after facet 1: \"soild\" stands where \"solid\""));
  CHECK_THAT(fault(std::string(1'000'000, 'a')),
             Contains("\"" + std::string(40, 'a') + "...\" stands where"));
  CHECK_THAT(fault("a\x01\xff"), Contains("\"a  \" stands where"));
}

TEST_CASE("faults in OFF are told with line and facet") {
  const std::string vertices = "0 0 0\n1 0 0\n0 1 0\n";
  CHECK_THAT(
      fault_of("OFF\n3 1 0\n" + vertices + "3 0 1 3\n"),
      Contains("in:6, facet 0: vertex 3 does not exist") && Contains("has 3 vertices, counted from 0"));
  CHECK_THAT(fault_of("OFF\n3 1 0\n" + vertices + "2 0 1 3\n"), Contains("in:6, facet 0: has 2 corners"));
  CHECK_THAT(fault_of("OFF\n3 1 0\n" + vertices + "4000000000 0 1\n"), Contains("has 4000000000 corners"));
  CHECK_THAT(fault_of("OFF\n3 1 0\n" + vertices + "3 0 -1 2\n"),
             Contains("\"-1\" stands where the number of a vertex"));
  CHECK_THAT(fault_of("OFF\n3 1 0\n" + vertices + "3 0 1 2\n3 0 1 2\n"),
             Contains("in:7, after the last facet: \"3\" stands where the end is due"));
  CHECK_THAT(fault_of("OFF\n3 2 0\n" + vertices + "3 0 1 2\n          "),
             Contains("in:7, facet 1: the file ends where a number of corners is due"));
  CHECK_THAT(fault_of("OFF\n3 1 0\n0 0 x\n1 0 0\n0 1 0\n3 0 1 2\n"),
             Contains("in:3, vertex 0: \"x\" stands where a coordinate"));
  CHECK_THAT(fault_of("OFF\n99999999 1 0\n" + vertices),
             Contains("claims 99999999 vertices and 1 facets, more than"));
  CHECK_THAT(fault_of("OFF\n3 99999999 0\n" + vertices),
             Contains("99999999 facets, more than its size can hold"));
  CHECK_THAT(fault_of("OFF\n18446744073709551615 1 0\n"), Contains("Glissade reads up to 4294967294"));
  CHECK_THAT(fault_of("OFF\n18446744073709551616 1 0\n"),
             Contains("stands where the number of vertices is due"));
  CHECK_THAT(fault_of("OFF\n"), Contains("the file ends where the number of vertices is due"));
  CHECK_THAT(fault_of("4OFF\n3 1 0\n"), Contains("\"4OFF\" is a kind of OFF that cannot be read"));
  CHECK_THAT(fault_of("nOFF\n4\n3 1 0\n"), Contains("\"nOFF\" is a kind of OFF"));
  CHECK_THAT(fault_of("OFF BINARY\n\x01\x02"), Contains("\"OFF BINARY\" is a kind of OFF"));
}

TEST_CASE("what cannot be opened is refused with the system's reason") {
  const TempDir dir;
  const auto refusal = [](const std::filesystem::path& file) -> std::string {
    try {
      (void)read_mesh(file);
    } catch (const FileError& error) {
      return error.what();
    }
    return "no refusal";
  };
  CHECK_THAT(refusal(dir / "missing.stl"), Contains("missing.stl: cannot read: No such file or directory"));
  CHECK_THAT(refusal(dir.path()), Contains("Is a directory"));
  CHECK_THAT(refusal("/dev/zero"), Contains("not a regular file"));
  REQUIRE(::mkfifo((dir / "pipe").c_str(), 0600) == 0);
  CHECK_THAT(refusal(dir / "pipe"), Contains("not a regular file"));
}

TEST_CASE("every beginning of a good file is a clear error or a smaller mesh, never a crash") {
  const TempDir dir;
  for (const MeshFormat format : {MeshFormat::stl_binary, MeshFormat::stl_ascii, MeshFormat::off}) {
    write_mesh(dir / "mesh", format, tetrahedron());
    const std::string good = bytes_of(dir / "mesh");
    std::size_t faults = 0;
    for (std::size_t length = 0; length < good.size(); ++length) {
      if (fault_of(good.substr(0, length)) != "no fault") ++faults;
    }
    // Only the line feed at the end, the title after "endsolid" and a last index of fewer digits can be
    // missed.
    CHECK(faults >= good.size() - 30);
  }
}
