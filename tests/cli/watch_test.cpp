// build --watch: what a save, a slip and Ctrl-C do.

#include "cli/glissade.hpp"
#include "support/catch.hpp"
#include "support/running_program.hpp"
#include "support/temp_dir.hpp"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <string>
#include <thread>

using Catch::Matchers::Contains;

namespace {

namespace fs = std::filesystem;

/// Small and quick to build; its profile lies beside it.
std::string design(const std::string& thickness) {
  return "glissade: 1\n"
         "track: {start: {x: 0 m, z: 2 m}}\n"
         "body: {friction_angle: 10 deg}\n"
         "centerline: {kind: points, file: profile.csv}\n"
         "cross_section: {kind: slab, width: 300 mm, thickness: " +
         thickness +
         "}\n"
         "mesh: {tolerance: 5 mm}\n"
         "export: [off]\n";
}

std::string profile(const std::string& last_height) {
  return "x,z\n0,2\n0.5,1.7\n1,1.4\n1.5,1.1\n2,0.8\n2.5,0.5\n3," + last_height + "\n";
}

std::string last_line(const std::string& text) {
  const std::size_t start = text.rfind('\n', text.size() - 2);
  return text.substr(start == std::string::npos ? 0 : start + 1);
}

/// As many editors save: a new file takes the name of the old one.
void replace(const fs::path& file, const std::string& text) {
  put_bytes(file.string() + ".new", text);
  fs::rename(file.string() + ".new", file);
}

}  // namespace

TEST_CASE("a build that watches follows each save, survives slips and ends by Ctrl-C") {
  const TempDir place;
  put_bytes(place / "slide.yaml", design("20 mm"));
  put_bytes(place / "profile.csv", profile("0.2"));
  RunningProgram watching(glissade_program(), {"build", "slide.yaml", "--watch", "--no-report"},
                          place.path());
  CHECK_THAT(watching.output_of_lines(1), Contains("built in") && Contains("files in out/slide"));
  CHECK_THAT(watching.errors(), Contains("watching slide.yaml and profile.csv; Ctrl-C ends it"));
  const std::string thin = bytes_of(place / "out/slide/slide.off");

  // In place.
  put_bytes(place / "slide.yaml", design("40 mm"));
  CHECK_THAT(last_line(watching.output_of_lines(2)), Contains("built in"));
  const std::string thick = bytes_of(place / "out/slide/slide.off");
  CHECK(thick != thin);

  // A slip is told, the files of the last good build stay, and it goes on.
  replace(place / "slide.yaml", design("40 kg"));
  CHECK_THAT(last_line(watching.output_of_lines(3)),
             Contains("not built; waiting for a change of slide.yaml"));
  CHECK_THAT(watching.errors(), Contains("glissade: error: slide.yaml:5:") && Contains("thickness"));
  CHECK(bytes_of(place / "out/slide/slide.off") == thick);
  replace(place / "slide.yaml", design("20 mm"));
  CHECK_THAT(last_line(watching.output_of_lines(4)), Contains("built in"));
  CHECK(bytes_of(place / "out/slide/slide.off") == thin);

  // The profile that the design names, one that is broken for a while included.
  replace(place / "profile.csv", profile("0.25"));
  CHECK_THAT(last_line(watching.output_of_lines(5)), Contains("built in"));
  CHECK(bytes_of(place / "out/slide/slide.off") != thin);
  replace(place / "profile.csv", profile("low"));
  CHECK_THAT(last_line(watching.output_of_lines(6)), Contains("not built"));
  replace(place / "profile.csv", profile("0.2"));
  CHECK_THAT(last_line(watching.output_of_lines(7)), Contains("built in"));
  CHECK(bytes_of(place / "out/slide/slide.off") == thin);

  // Gone and back again.
  fs::remove(place / "slide.yaml");
  CHECK_THAT(last_line(watching.output_of_lines(8)), Contains("not built"));
  put_bytes(place / "slide.yaml", design("40 mm"));
  CHECK_THAT(last_line(watching.output_of_lines(9)), Contains("built in"));
  CHECK(bytes_of(place / "out/slide/slide.off") == thick);

  // Nothing happens while nothing changes.
  const double before = watching.processor_time();
  std::this_thread::sleep_for(std::chrono::milliseconds(900));
  CHECK(watching.processor_time() - before <= 0.1);
  const std::string lines = watching.output();
  CHECK(std::count(lines.begin(), lines.end(), '\n') == 9);
  CHECK(watching.end_by(SIGINT) == 130);
}

TEST_CASE("a build that watches prints no JSON, and with --quiet nothing but errors") {
  const Outcome both = glissade_run({"build", shipped("grain_chute"), "--watch", "--json"});
  CHECK(both.exit_code == 2);
  CHECK_THAT(both.errors, Contains("--watch") && Contains("--json"));
  const TempDir place;
  put_bytes(place / "slide.yaml", design("20 mm"));
  RunningProgram watching(glissade_program(), {"build", "slide.yaml", "--watch", "-q"}, place.path());
  for (int i = 0; i < 500 && watching.errors().empty(); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  CHECK_THAT(watching.errors(), Contains("profile.csv"));
  CHECK(watching.output().empty());
  CHECK(watching.end_by(SIGTERM) == 130);
}
