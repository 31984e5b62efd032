// A program not ours opens what is built. Apart from the other tests of the program because it takes longest.

#include "glissade/design/design.hpp"

#include "cli/glissade.hpp"
#include "support/catch.hpp"
#include "support/openscad_check.hpp"
#include "support/paths.hpp"
#include "support/temp_dir.hpp"
#include "support/thorough.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <vector>

namespace fs = std::filesystem;

namespace {

std::string text_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

/// Builds a design so coarse that OpenSCAD's exact arithmetic does not take minutes for it: end faces and trims stay.
/// @return where its OFF file lies
fs::path built(const fs::path& design, const fs::path& folder, const std::vector<std::string>& options) {
  std::vector<std::string> arguments{
      "build", design.string(),          "-q", "-o", ".", "--no-report", "--set", "mesh.tolerance=20mm",
      "--set", "export=[stl, off, scad]"};
  arguments.insert(arguments.end(), options.begin(), options.end());
  const Outcome outcome = glissade_run(arguments, {folder, {}, {}});
  INFO(design.stem().string());
  INFO(outcome.errors);
  REQUIRE(outcome.exit_code == 0);
  return folder / (design.stem().string() + ".off");
}

}  // namespace

TEST_CASE("OpenSCAD takes every shipped design for a closed solid", "[external]") {
  std::size_t checked = 0;
  std::size_t small = 0;
  std::set<std::string> kinds;
  std::set<fs::path> designs;
  for (const auto& entry : fs::directory_iterator(designs_path())) {
    if (entry.path().extension() == ".yaml") designs.insert(entry.path());
  }
  for (const fs::path& design : designs) {
    if (!testing::thorough()) {
      // Parts of a workshop change nothing of the swept solid, of which the others have every kind; of each kind the first.
      if (text_of(design).find("\nfabrication:") != std::string::npos) continue;
      const glissade::Design read = glissade::read_design(design);
      if (!kinds.emplace(glissade::section::kind(read.cross_section.value())).second) continue;
    }
    const std::string stem = design.stem().string();
    const TempDir thin;
    const TempDir thick;
    const std::uintmax_t size = fs::file_size(built(design, thin.path(), {}));
    // The largest ones take it so long that one format has to do: it holds the same numbers as the OFF file. So do two of
    // three, of the meshes one in turn, and outside continuous integration one of the three in turn.
    constexpr std::uintmax_t kLargest = 500'000;
    const bool is_small = size < kLargest;
    // No facet is many times as long as wide, so the edge of a thin plate asks for very many: outside continuous
    // integration plates are thick where that makes fewer.
    const bool is_thick =
        !is_small && !testing::thorough() &&
        fs::file_size(built(design, thick.path(), {"--set", "cross_section.thickness=40mm"})) < size / 2;
    const fs::path place = is_thick ? thick.path() : thin.path();
    std::vector<std::string> endings{".scad", ".stl", ".off"};
    if (!is_small) {
      endings = {".scad"};
    } else if (testing::thorough()) {
      endings.erase(endings.begin() + 1 + static_cast<std::ptrdiff_t>(small++ % 2));
    } else {
      endings = {endings[checked % endings.size()]};
    }
    checked += endings.size();
    for (const std::string& ending : endings) {
      const OpenscadResult rendered = openscad_check(place / (stem + ending));
      INFO(ending);
      INFO(rendered.output);
      CHECK(rendered.simple());
      CHECK(rendered.clean());
    }
  }
  CHECK(checked >= (testing::thorough() ? 7 + 4 : 8));
}
