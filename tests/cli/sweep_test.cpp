#include "cli/glissade.hpp"
#include "support/catch.hpp"
#include "support/temp_dir.hpp"

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

using Catch::Matchers::Contains;
using nlohmann::json;

namespace {

Outcome sweep(const TempDir& place, std::vector<std::string> arguments, RunLimits limits = {}) {
  arguments.insert(arguments.begin(), "sweep");
  limits.directory = place.path();
  return glissade_run(arguments, limits);
}

/// A table as rows of cells; no cell of these tests holds a comma.
std::vector<std::vector<std::string>> cells(const std::string& text) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    rows.emplace_back();
    std::istringstream row(line);
    for (std::string cell; std::getline(row, cell, ',');) rows.back().push_back(cell);
  }
  return rows;
}

std::size_t column(const std::vector<std::string>& headings, const std::string& name) {
  const auto found = std::find(headings.begin(), headings.end(), name);
  REQUIRE(found != headings.end());
  return static_cast<std::size_t>(found - headings.begin());
}

}  // namespace

TEST_CASE("sweep: a row has the figures of solve --json, under the same names") {
  const TempDir place;
  const Outcome outcome =
      sweep(place, {shipped("grain_chute_with_limits"), "--vary", "body.entry_speed=0m/s,0.5m/s", "-o", "s"});
  INFO(outcome.errors);
  REQUIRE(outcome.exit_code == 0);
  CHECK_THAT(outcome.output, Contains("Points            2 in 1 chunk") && Contains("travel_time_s") &&
                                 Contains("s/sweep.html"));
  REQUIRE(sweep(place, {"--merge", "s", "-o", "s.csv"}).exit_code == 0);
  const auto rows = cells(bytes_of(place / "s.csv"));
  REQUIRE(rows.size() == 3);
  const Outcome solved = glissade_run(
      {"solve", "--json", shipped("grain_chute_with_limits"), "--set", "body.entry_speed=0.5m/s"});
  const json track = json::parse(solved.output);
  for (const auto& [name, value] : track.items()) {
    if (!value.is_number()) continue;
    INFO(name);
    if (name == "gravity_m_per_s2") continue;
    CHECK(std::stod(rows[2][column(rows[0], name)]) == value.get<double>());
  }
  for (const json& limit : track["limits"]) {
    const std::string name = "limits." + limit["limit"].get<std::string>() + ".reached";
    INFO(name);
    if (limit["reached"].is_number())
      CHECK(std::stod(rows[2][column(rows[0], name)]) == limit["reached"].get<double>());
  }
  CHECK(rows[2][column(rows[0], "status")] == "arrived");
  CHECK(rows[2][column(rows[0], "body.entry_speed_m_per_s")] == "0.5");
}

TEST_CASE("sweep: statuses are counted, and the same command again computes nothing") {
  const TempDir place;
  const std::vector<std::string> command = {shipped("grain_chute"), "--vary",
                                            "body.friction_angle=10deg:50deg:5", "-o", "s"};
  const Outcome first = sweep(place, command);
  CHECK_THAT(first.output, Contains("1 computed") && Contains("arrived          4   80 %") &&
                               Contains("infeasible       1   20 %"));
  const Outcome second = sweep(place, command);
  CHECK_THAT(second.output, Contains("0 computed, 1 there before"));
  const Outcome merged = sweep(place, {"--merge", "s", "-o", "s.csv"});
  CHECK_THAT(merged.output, Contains("arrived          4   80 %") && Contains("s.csv"));
}

TEST_CASE("sweep: what is asked for wrongly is one error with exit code 2, and no directory appears") {
  const TempDir place;
  const std::string design = shipped("grain_chute");
  const auto refused = [&](const std::vector<std::string>& arguments, const std::string& message) {
    const Outcome outcome = sweep(place, arguments);
    INFO(outcome.errors);
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.output.empty());
    CHECK_THAT(outcome.errors, Contains("glissade: error: ") && Contains(message));
    CHECK_FALSE(std::filesystem::exists(place / "s"));
  };
  refused({design, "-o", "s"}, "nothing varies");
  refused({"-o", "s"}, "a design file is missing");
  refused({design, "--vary", "body.friction_angel=1deg:2deg:3", "-o", "s"}, "friction_angel");
  refused({design, "--vary", "body.friction_angle=1:2:3", "-o", "s"}, "--set body.friction_angle");
  refused({design, "--scatter", "body.friction_angle=normal(17deg,1deg)", "-o", "s"}, "--samples is missing");
  refused({design, "--vary", "body.friction_angle=1deg,2deg", "--samples", "4", "-o", "s"},
          "nothing scatters");
  refused({design, "--vary", "body.friction_angle=1deg,2deg", "--shard", "2/2", "-o", "s"}, "0 <= i < n");
  refused({design, "--vary", "body.friction_angle=1deg,2deg", "--columns", "time", "-o", "s"},
          "'time' is no quantity");
  refused({design, "--vary", "track.finish.z=0m,1m", "--frozen", "-o", "s"},
          "shapes the track, which is frozen");
  refused({"--merge", "x"}, "-o is missing");
  refused({design, "--merge", "x", "-o", "y.csv"}, "a design is given as well");
}

TEST_CASE("sweep: another design in the same directory is refused and nothing is lost") {
  const TempDir place;
  put_bytes(place / "d.yaml", bytes_of(shipped("grain_chute")));
  const std::vector<std::string> command = {"d.yaml", "--vary", "body.friction_angle=10deg:20deg:3", "-o",
                                            "s"};
  REQUIRE(sweep(place, command).exit_code == 0);
  const std::string before = bytes_of(place / "s/chunks/000000.csv");
  put_bytes(place / "d.yaml", bytes_of(shipped("grain_chute")) + "\n");
  const Outcome edited = sweep(place, command);
  CHECK(edited.exit_code == 2);
  CHECK_THAT(edited.errors, Contains("the directory holds another sweep; these differ: design_sha256"));
  CHECK(bytes_of(place / "s/chunks/000000.csv") == before);
}

TEST_CASE("sweep: a full disk is an error with exit code 5, and the sweep goes on once there is room") {
  const TempDir place;
  const std::vector<std::string> command = {shipped("grain_chute"), "--vary",
                                            "body.friction_angle=10deg:20deg:300", "-o", "s"};
  RunLimits limits;
  limits.largest_file = 20'000;  // the manifest fits, a chunk does not
  const Outcome full = sweep(place, command, limits);
  CHECK(full.exit_code == 5);
  CHECK_THAT(full.errors, Contains("000000.csv") && Contains("cannot write"));
  CHECK(std::filesystem::is_empty(place / "s/chunks"));
  CHECK(sweep(place, command).exit_code == 0);
}

TEST_CASE("sweep: where not even the manifest can be written it is named, and no directory stays") {
  const TempDir place;
  RunLimits limits;
  limits.largest_file = 250;  // what is said of it fits
  const std::vector<std::string> command = {shipped("grain_chute"), "--vary",
                                            "body.friction_angle=10deg:20deg:3", "-o", "new/s"};
  const Outcome full = sweep(place, command, limits);
  CHECK(full.exit_code == 5);
  CHECK_THAT(full.errors, Contains("new/s/manifest.json: cannot write") && !Contains(".part"));
  CHECK(place.names().empty());
  std::vector<std::string> batch = command;
  batch.emplace_back("--slurm");
  const Outcome slurm = sweep(place, batch, limits);
  CHECK(slurm.exit_code == 5);
  CHECK_THAT(slurm.errors, Contains("new/s/sweep.sbatch"));
  CHECK(place.names().empty());
  // One that was there before stays.
  std::filesystem::create_directories(place / "new");
  CHECK(sweep(place, command, limits).exit_code == 5);
  CHECK(place.names() == std::vector<std::string>{"new"});
  CHECK(std::filesystem::is_empty(place / "new"));
}

TEST_CASE("sweep: a directory that cannot be made is an error with exit code 5") {
  const TempDir place;
  put_bytes(place / "file", "");
  const Outcome outcome =
      sweep(place, {shipped("grain_chute"), "--vary", "body.friction_angle=10deg:20deg:3", "-o", "file/s"});
  CHECK(outcome.exit_code == 5);
  CHECK_THAT(outcome.errors, Contains("file/s: cannot be made"));
}

TEST_CASE("sweep: --slurm writes a batch file that gives every task its shard, and computes nothing") {
  const TempDir place;
  const Outcome outcome =
      sweep(place, {shipped("grain_chute"), "--scatter", "body.friction_angle=normal(17deg,1.5deg)",
                    "--samples", "40000", "--frozen", "-o", "a sweep", "--slurm", "--tasks", "8"});
  INFO(outcome.errors);
  REQUIRE(outcome.exit_code == 0);
  CHECK_THAT(outcome.output, Contains("a sweep/sweep.sbatch, 8 tasks"));
  const std::string batch = bytes_of(place / "a sweep/sweep.sbatch");
  CHECK_THAT(batch, Contains("#SBATCH --array=0-7\n"));
  CHECK_THAT(
      batch,
      Contains(
          "--scatter 'body.friction_angle=normal(17deg,1.5deg)' --samples 40000 --sampling sobol --seed 1 "
          "--frozen -o 'a sweep'"));
  CHECK_THAT(batch, Contains("--shard \"$SLURM_ARRAY_TASK_ID/8\" "));
  CHECK_THAT(batch, Contains("#SBATCH --output='a sweep/slurm-%A_%a.log'\n"));
  CHECK_THAT(outcome.output, Contains("sbatch 'a sweep/sweep.sbatch', where this command was given"));
  CHECK_FALSE(std::filesystem::exists(place / "a sweep/chunks"));
  CHECK(run_program("bash", {"-n", (place / "a sweep/sweep.sbatch").string()}).exit_code == 0);
}

TEST_CASE("sweep: a batch file in a directory of any name is told for a shell, its logs for Slurm") {
  const TempDir place;
  struct Told {
    const char* directory;
    const char* command;
    const char* log;
  };
  for (const Told& one :
       {Told{"s", "sbatch s/sweep.sbatch,", "--output=s/slurm-%A_%a.log\n"},
        Told{"it's", "sbatch 'it'\\''s/sweep.sbatch',", "--output='it'\\''s/slurm-%A_%a.log'\n"},
        Told{"50%j", "sbatch 50%j/sweep.sbatch,", "--output=50%%j/slurm-%A_%a.log\n"},
        Told{"#1 $HOME", "sbatch '#1 $HOME/sweep.sbatch',", "--output='#1 $HOME/slurm-%A_%a.log'\n"},
        // Slurm takes no % after a backslash for what it is.
        Told{"a\\b", "sbatch 'a\\b/sweep.sbatch',", "--output=slurm-%A_%a.log\n"}}) {
    CAPTURE(one.directory);
    const Outcome outcome =
        sweep(place, {shipped("grain_chute"), "--vary", "body.friction_angle=10deg:20deg:3", "-o",
                      one.directory, "--slurm"});
    INFO(outcome.errors);
    REQUIRE(outcome.exit_code == 0);
    CHECK_THAT(outcome.output, Contains(one.command));
    CHECK_THAT(bytes_of(place / one.directory / "sweep.sbatch"), Contains(one.log));
  }
}

TEST_CASE("sweep: a task of the batch file that is submitted again alone computes the shard that it had") {
  const TempDir place;
  // Chunks of 1,000 points: the last one has one.
  REQUIRE(sweep(place, {shipped("grain_chute"), "--vary", "body.friction_angle=10deg:20deg:2001", "--frozen",
                        "-o", "s", "--slurm", "--tasks", "3"})
              .exit_code == 0);
  RunLimits limits;
  limits.directory = place.path();
  // As Slurm does after `sbatch --array=2`.
  const Outcome outcome =
      run_program("env",
                  {"GLISSADE=" + glissade_program(), "SLURM_ARRAY_TASK_ID=2", "SLURM_ARRAY_TASK_COUNT=1",
                   "SLURM_CPUS_PER_TASK=1", "bash", "s/sweep.sbatch"},
                  limits);
  INFO(outcome.errors);
  CHECK(outcome.exit_code == 0);
  CHECK(std::filesystem::exists(place / "s/chunks/000002.csv"));
  CHECK_FALSE(std::filesystem::exists(place / "s/chunks/000000.csv"));
  CHECK_FALSE(std::filesystem::exists(place / "s/chunks/000001.csv"));
}

TEST_CASE("sweep: a standard output that takes nothing costs the page nothing, and the message tells of it") {
  const TempDir place;
  RunLimits limits;
  limits.output_to = "/dev/full";
  const Outcome outcome =
      sweep(place, {shipped("grain_chute"), "--vary", "body.friction_angle=10deg,20deg", "-o", "s"}, limits);
  CHECK(outcome.exit_code == 5);
  CHECK_THAT(outcome.errors,
             Contains("The rows are written, into s, and what they say, as s/sweep.html. Only what was"));
  CHECK_THAT(bytes_of(place / "s/sweep.html"), Contains("</html>"));
  CHECK(std::filesystem::exists(place / "s/chunks/000000.csv"));
}
