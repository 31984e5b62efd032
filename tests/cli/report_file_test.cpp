#include "cli/glissade.hpp"
#include "support/catch.hpp"
#include "support/temp_dir.hpp"

#include <filesystem>
#include <map>
#include <string>

#include <nlohmann/json.hpp>

using Catch::Matchers::Contains;
using nlohmann::json;

namespace {

json data_of(const std::string& page) {
  const std::string opening = "<script type=\"application/json\" id=\"glissade-data\">";
  const std::size_t from = page.find(opening) + opening.size();
  REQUIRE(from > opening.size());
  return json::parse(page.substr(from, page.find("</script>", from) - from));
}

}  // namespace

TEST_CASE("the report page tells what --json tells, and lists the files as they are") {
  const TempDir place;
  const Outcome outcome =
      glissade_run({"build", shipped("grain_chute"), "-o", "out", "--json"}, {place.path(), {}, {}});
  INFO(outcome.errors);
  REQUIRE(outcome.exit_code == 0);
  const json built = json::parse(outcome.output);
  const json report = data_of(bytes_of(place / "out/grain_chute.report.html"));
  CHECK(report["schema"] == "glissade-report/2");
  // Whatever both of them tell is the same, to the last digit.
  const auto compare = [](const json& page, const json& printed) {
    std::size_t common = 0;
    for (const auto& [key, value] : page.items()) {
      if (!printed.contains(key)) continue;
      INFO(key);
      CHECK(value == printed[key]);
      ++common;
    }
    return common;
  };
  CHECK(compare(report["ride"], built) == 20);
  CHECK(compare(report["mesh"], built["mesh"]) >= 8);
  CHECK(compare(report["body"], built) >= 5);
  // Every file but the report itself, which stands last.
  CHECK_THAT(built["files"].back()["path"].get<std::string>(), Contains("grain_chute.report.html"));
  REQUIRE(report["files"].size() + 1 == built["files"].size());
  for (const json& file : report["files"]) {
    const std::filesystem::path path = place / "out" / file["name"].get<std::string>();
    INFO(path);
    CHECK(file["bytes"] == std::filesystem::file_size(path));
    const Outcome sum = run_program("/usr/bin/sha256sum", {path.string()});
    CHECK(sum.output.substr(0, 64) == file["sha256"]);
  }
}

TEST_CASE("the report's verdicts pass for what the build checked, and say what it did not check") {
  const TempDir place;
  REQUIRE(glissade_run({"build", shipped("grain_chute"), "-o", "out"}, {place.path(), {}, {}}).exit_code ==
          0);
  std::map<std::string, std::string> verdicts;
  const json report = data_of(bytes_of(place / "out/grain_chute.report.html"));
  for (const json& check : report["checks"]) {
    verdicts[check["name"]] = check["verdict"];
    CHECK(check["detail"].get<std::string>().size() > 5);
  }
  for (const char* name :
       {"The body arrives", "It never leaves the track", "Energy is accounted for", "The solid is watertight",
        "It does not intersect itself", "The facets follow the track", "Files hold this solid"}) {
    INFO(name);
    CHECK(verdicts[name] == "pass");
  }
}

TEST_CASE("the report calls a searched track what was searched for") {
  const TempDir place;
  put_bytes(place / "ramp.yaml",
            "glissade: 1\ntrack: {edge: {x: 0 m, z: 0 m}}\nbody: {friction_coefficient: 0.05}\n"
            "limits: {objective: least_drop, exit_speed: {lowest: 10 m/s}, slope_angle: {highest: 65 deg}}\n"
            "export: [csv]\n");
  REQUIRE(glissade_run({"build", "ramp.yaml", "-o", "out"}, {place.path(), {}, {}}).exit_code == 0);
  std::map<std::string, std::string> verdicts;
  const json report = data_of(bytes_of(place / "out/ramp.report.html"));
  for (const json& check : report["checks"]) verdicts[check["name"]] = check["verdict"];
  CHECK(verdicts["Lowest within the limits"] == "pass");
  CHECK_FALSE(verdicts.contains("Fastest within the limits"));
}

TEST_CASE("with only a table to write, the report does not claim that files were read back") {
  const TempDir place;
  REQUIRE(glissade_run({"build", shipped("grain_chute"), "-o", "out", "--set", "export=[csv]"},
                       {place.path(), {}, {}})
              .exit_code == 0);
  const json report = data_of(bytes_of(place / "out/grain_chute.report.html"));
  std::string verdict;
  for (const json& check : report["checks"]) {
    if (check["name"] == "Files hold this solid") verdict = check["verdict"];
  }
  CHECK(verdict == "not-checked");
}

TEST_CASE("--no-report leaves the page out") {
  const TempDir place;
  const Outcome outcome =
      glissade_run({"build", shipped("grain_chute"), "-o", "out", "--no-report"}, {place.path(), {}, {}});
  CHECK(outcome.exit_code == 0);
  CHECK_FALSE(std::filesystem::exists(place / "out/grain_chute.report.html"));
  CHECK(std::filesystem::exists(place / "out/grain_chute.stl"));
}

TEST_CASE("the same design gives the same report, byte for byte") {
  const TempDir place;
  for (const char* folder : {"one", "two"}) {
    REQUIRE(glissade_run({"build", shipped("grain_chute"), "-o", folder}, {place.path(), {}, {}}).exit_code ==
            0);
  }
  CHECK(bytes_of(place / "one/grain_chute.report.html") == bytes_of(place / "two/grain_chute.report.html"));
}
