#include "glissade/core/error.hpp"
#include "glissade/io/three_mf_file.hpp"

#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/shapes.hpp"
#include "support/temp_dir.hpp"

#include <algorithm>
#include <string>
#include <vector>

namespace three_mf_test {

using namespace glissade;

namespace {

std::vector<PrintPiece> rings(int count) {
  std::vector<PrintPiece> pieces;
  for (int i = 1; i <= count; ++i) {
    pieces.push_back({"ring " + std::to_string(i) + " of <\"" + std::to_string(count) + "\"> & more, Länge",
                      "0" + std::to_string(i), shapes::torus(0.02 + 0.002 * i, 0.005, 20, 10)});
  }
  return pieces;
}

std::string message_of(const std::filesystem::path& file) {
  try {
    (void)read_three_mf(file);
  } catch (const FileError& error) {
    return error.what();
  }
  return "read";
}

struct Box {
  double low_x = 1e9, high_x = -1e9, low_y = 1e9, high_y = -1e9, low_z = 1e9;
};

Box box_of(const TriangleMesh& mesh) {
  Box box;
  for (const Vec3& p : mesh.vertices) {
    box.low_x = std::min(box.low_x, p.x);
    box.high_x = std::max(box.high_x, p.x);
    box.low_y = std::min(box.low_y, p.y);
    box.high_y = std::max(box.high_y, p.y);
    box.low_z = std::min(box.low_z, p.z);
  }
  return box;
}

}  // namespace

TEST_CASE("3MF read back is the pieces: names, numbers, triangles, every coordinate as readers hold it") {
  const TempDir directory;
  const auto file = directory / "rings.3mf";
  const std::vector<PrintPiece> pieces = rings(3);
  write_three_mf(file, pieces, "Rings & <more>");
  require_same_three_mf(file, pieces);
  const std::vector<PrintPiece> found = read_three_mf(file);
  REQUIRE(found.size() == 3);
  CHECK(found[1].name == pieces[1].name);
  CHECK(found[1].number == "02");
  for (std::size_t i = 0; i < pieces[1].mesh.vertices.size(); ++i) {
    CHECK(norm(found[1].mesh.vertices[i] - pieces[1].mesh.vertices[i]) < 1e-8);
  }
  CHECK(bytes_of(file) == three_mf_bytes(pieces, "Rings & <more>"));
  // What is read is already rounded: written again it is the same file.
  CHECK(three_mf_bytes(found, "Rings & <more>") == bytes_of(file));
}

TEST_CASE("a 3MF file that is not the pieces is found out") {
  const TempDir directory;
  const auto file = directory / "rings.3mf";
  std::vector<PrintPiece> pieces = rings(2);
  write_three_mf(file, pieces, "");
  pieces[1].number = "03";
  CHECK_THROWS_AS(require_same_three_mf(file, pieces), InternalError);
  pieces = rings(2);
  pieces[0].mesh.vertices[7].x += 1e-6;
  CHECK_THROWS_AS(require_same_three_mf(file, pieces), InternalError);
  pieces = rings(2);
  std::swap(pieces[0].mesh.triangles[3][0], pieces[0].mesh.triangles[3][1]);
  CHECK_THROWS_AS(require_same_three_mf(file, pieces), InternalError);
  CHECK_THROWS_AS(require_same_three_mf(file, rings(3)), InternalError);
  CHECK_THROWS_AS(three_mf_bytes({}, ""), InputError);
  CHECK_THROWS_AS(three_mf_bytes({{"empty", "01", {}}}, ""), InputError);
}

TEST_CASE("a 3MF file that is cut off or broken anywhere is an error, never more") {
  const TempDir directory;
  const auto file = directory / "broken.3mf";
  const std::string good = three_mf_bytes(rings(1), "x");
  for (std::size_t size = 0; size < good.size(); size += 53) {
    put_bytes(file, good.substr(0, size));
    CHECK(message_of(file).find("broken.3mf: is no whole zip archive") != std::string::npos);
  }
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  int refused = 0;
  for (int round = 0; round < 200; ++round) {
    std::string bad = good;
    bad[static_cast<std::size_t>(random.integer(0, static_cast<int>(bad.size()) - 1))] =
        static_cast<char>(random.integer(0, 255));
    put_bytes(file, bad);
    refused += message_of(file) == "read" ? 0 : 1;
  }
  // Dates, attributes and the like may change; what is held by checksums may not.
  CHECK(refused > 150);
}

TEST_CASE("pieces lie on beds, apart, none over an edge; those larger than the bed are named") {
  const PrintBed bed{0.15, 0.12, 0.05, 0.004};
  const std::vector<PrintPiece> laid = laid_on_beds(rings(9), bed);
  REQUIRE(laid.size() == 9);
  for (std::size_t i = 0; i < laid.size(); ++i) {
    CHECK(laid[i].number == "0" + std::to_string(i + 1));
    const Box box = box_of(laid[i].mesh);
    CHECK(box.low_z == Approx(0.0).margin(1e-12));
    const double bed_at = std::floor(box.low_x / (1.2 * bed.x)) * 1.2 * bed.x;
    CHECK(box.low_x - bed_at >= bed.gap - 1e-12);
    CHECK(box.high_x - bed_at <= bed.x - bed.gap + 1e-12);
    CHECK(box.low_y >= bed.gap - 1e-12);
    CHECK(box.high_y <= bed.y - bed.gap + 1e-12);
    for (std::size_t k = 0; k < i; ++k) {
      const Box other = box_of(laid[k].mesh);
      const double apart = std::max({box.low_x - other.high_x, other.low_x - box.high_x,
                                     box.low_y - other.high_y, other.low_y - box.high_y});
      CHECK(apart >= bed.gap - 1e-12);
    }
  }
  try {
    (void)laid_on_beds(rings(9), {0.065, 0.12, 0.05, 0.004});
    FAIL("laid");
  } catch (const InputError& error) {
    // Across they measure 50 mm and 4 mm more for each number: all but the first exceed 57 mm.
    CHECK(error.issues().size() == 8);
    CHECK(error.issues()[0].where == "piece 02");
    CHECK(error.issues()[0].why == "The bed is 65 mm x 120 mm x 50 mm with a gap of 4 mm.");
  }
}

}  // namespace three_mf_test
