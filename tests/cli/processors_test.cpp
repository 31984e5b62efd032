// The same design gives the same bytes on every x86-64 processor: every shipped design is built as this processor
// is, and again with the C library told that it has no fused multiply-add and no AVX2, as on older ones.

#include "cli/glissade.hpp"
#include "support/catch.hpp"
#include "support/paths.hpp"
#include "support/temp_dir.hpp"
#include "support/thorough.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

using nlohmann::json;

namespace {

namespace fs = std::filesystem;

constexpr const char* kOlderProcessor = "GLIBC_TUNABLES=glibc.cpu.hwcaps=-FMA,-AVX2";

Outcome run_as_on(const std::string& processor, const std::string& program,
                  const std::vector<std::string>& words, const fs::path& directory) {
  std::vector<std::string> arguments{processor, program};
  arguments.insert(arguments.end(), words.begin(), words.end());
  return run_program("env", arguments, {directory, {}, {}});
}

std::vector<fs::path> shipped_designs() {
  std::vector<fs::path> designs;
  for (const auto& entry : fs::directory_iterator(designs_path())) {
    if (entry.path().extension() == ".yaml") designs.push_back(entry.path());
  }
  std::sort(designs.begin(), designs.end());
  return designs;
}

/// What the program prints, without how long it took.
std::string without_times(const std::string& text) {
  json document = json::parse(text);
  if (document.contains("search") && document["search"].is_object()) document["search"].erase("seconds");
  return document.dump();
}

std::map<std::string, std::string> files_in(const fs::path& directory) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(directory)) {
    if (!entry.is_regular_file()) continue;
    files[fs::relative(entry.path(), directory).generic_string()] = bytes_of(entry.path());
  }
  return files;
}

}  // namespace

TEST_CASE("elementary functions return the same bits with and without fused multiply-add") {
  const Outcome here = run_program(GLISSADE_PROBE, {});
  const Outcome older = run_as_on(kOlderProcessor, GLISSADE_PROBE, {}, {});
  REQUIRE(here.exit_code == 0);
  REQUIRE(older.exit_code == 0);
  const auto second_line = [](const std::string& text) { return text.substr(text.find('\n')); };
  CHECK(second_line(here.output) == second_line(older.output));
  if (here.output == older.output) {
    WARN(
        "this C library returns the same bits both ways: whether files depend on the processor goes "
        "untested");
  }
}

TEST_CASE("every shipped design gives the same bytes with and without fused multiply-add") {
  const std::vector<fs::path> designs = shipped_designs();
  REQUIRE(designs.size() >= 10);
  // Outside continuous integration every sixth of them.
  for (std::size_t i = 0; i < designs.size(); i += testing::thorough() ? 1 : 6) {
    const fs::path& design = designs[i];
    INFO(design.filename().string());
    const TempDir place;
    const std::vector<std::string> words{
        "build", design.string(), "-o", "out", "--json", "--set", "export=[stl, stl-ascii, off, scad, csv]"};
    fs::create_directory(place / "here");
    fs::create_directory(place / "older");
    const Outcome here = run_as_on("LC_ALL=C", glissade_program(), words, place / "here");
    const Outcome older = run_as_on(kOlderProcessor, glissade_program(), words, place / "older");
    INFO(here.errors);
    REQUIRE(here.exit_code == 0);
    CHECK(older.exit_code == 0);
    CHECK(without_times(here.output) == without_times(older.output));
    const auto files = files_in(place / "here");
    const auto others = files_in(place / "older");
    CHECK(files.size() >= 7);  // the report counts, and the list of files; parts have more
    REQUIRE(files.size() == others.size());
    for (const auto& [name, bytes] : files) {
      INFO(name);
      CHECK(others.contains(name));
      CHECK(bytes == others.at(name));
    }
  }
}
