#include "glissade/core/error.hpp"
#include "glissade/io/mesh_file.hpp"
#include "glissade/solid/mesh_facts.hpp"

#include "support/catch.hpp"
#include "support/paths.hpp"

#include <algorithm>
#include <filesystem>
#include <vector>

using namespace glissade;

TEST_CASE("every file of the mesh corpus is a mesh that can be measured or one clear error") {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(test_data_path("corpus/mesh"))) {
    files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  REQUIRE(files.size() >= 40);
  for (const std::filesystem::path& file : files) {
    INFO(file.filename().string());
    try {
      const MeshFacts facts = measure(read_mesh(file));
      CHECK(facts.valid() == facts.faults().empty());
      CHECK(facts.triangles > 0);
    } catch (const FileError& error) {
      CHECK(error.issues().size() == 1);
      CHECK(error.issues().front().where.find(file.string()) == 0);
      CHECK_FALSE(error.issues().front().what.empty());
    }
  }
}
