#include "cli/glissade.hpp"
#include "support/catch.hpp"
#include "support/paths.hpp"
#include "support/temp_dir.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>
#include <string>

#include <nlohmann/json.hpp>

using Catch::Matchers::Contains;
using nlohmann::json;

namespace {

json compared(const std::vector<std::string>& arguments) {
  std::vector<std::string> all = {"compare", "--json"};
  all.insert(all.end(), arguments.begin(), arguments.end());
  const Outcome outcome = glissade_run(all);
  INFO(outcome.errors);
  REQUIRE(outcome.exit_code == 0);
  return json::parse(outcome.output)["tracks"];
}

}  // namespace

TEST_CASE("compare: no kind of centerline beats the fastest one") {
  const json tracks = compared({"--run", "10", "--drop", "5", "--friction-coefficient", "0.2"});
  REQUIRE(tracks.size() == 5);
  CHECK(tracks[0]["centerline"] == "fastest");
  const double least = tracks[0]["travel_time_s"];
  for (std::size_t index = 1; index < tracks.size(); ++index) {
    INFO(tracks[index].dump());
    CHECK(tracks[index]["travel_time_s"].get<double>() > least);
  }
  // docs/theory.md, table of travel times: Pudasaini's curve at its best P, the straight line.
  CHECK(tracks[1]["travel_time_s"].get<double>() == Approx(2.19868).epsilon(1e-5));
  CHECK(tracks[2]["travel_time_s"].get<double>() == Approx(2.91457).epsilon(1e-5));
}

TEST_CASE("compare says why a kind does not exist") {
  const Outcome outcome =
      glissade_run({"compare", "--run", "10", "--drop", "5", "--friction-coefficient", "0"});
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.output, Contains("constant-speed") && Contains("friction"));
  const json tracks = compared({"--run", "10", "--drop", "5", "--friction-coefficient", "0"});
  CHECK(tracks[1]["centerline"] == "constant-speed");
  CHECK(tracks[1]["problem"].is_string());
  // A reader asks each track for the same keys.
  CHECK(tracks[1].size() == tracks[0].size());
  CHECK(tracks[1].at("travel_time_s").is_null());
}

TEST_CASE("a friction sweep at P = 100 gives the seven curves of the paper's figure 1") {
  const json tracks = compared({"--run", "2.5", "--drop", "2.5", "--p", "100", "--friction-sweep",
                                "11deg,13deg,15deg,17deg,20deg,25deg,40deg"});
  REQUIRE(tracks.size() == 7);
  // The paper's observation: the more friction, the less the curve bends.
  double turned_before = 180.0;
  for (const json& track : tracks) {
    INFO(track.dump());
    CHECK(track["centerline"] == "constant-speed");
    const double turned =
        track["entry_slope_angle_deg"].get<double>() - track["exit_slope_angle_deg"].get<double>();
    CHECK(turned > 0.0);
    CHECK(turned < turned_before);
    turned_before = turned;
  }
}

TEST_CASE("a friction sweep tells nothing of bodies that it does not hold for") {
  const std::vector<std::string> task = {"compare",          "--run",     "10", "--drop", "5",
                                         "--friction-sweep", "5deg,10deg"};
  const auto told = [&](const std::vector<std::string>& more) {
    std::vector<std::string> all = task;
    all.insert(all.end(), more.begin(), more.end());
    return glissade_run(all).output;
  };
  CHECK_THAT(told({}), Contains("from rest") && Contains("0.63225 s"));
  const std::string dragged = told({"--drag", "0.1", "--entry-speed", "3"});
  CHECK_THAT(dragged, Contains("from 3 m/s") && !Contains("from rest") && !Contains("none arrives"));
  // The P that is fastest with drag; a speed that is kept there is none.
  CHECK_THAT(dragged, Contains("755.8 m^2/s^2") && !Contains("445.1 m^2/s^2") && Contains("  -  "));
}

TEST_CASE("--set replaces a value of every design that is compared") {
  const json tracks =
      compared({shipped("grain_chute"), shipped("powder_chute"), "--set", "body.friction_angle=5deg"});
  REQUIRE(tracks.size() == 2);
  for (const json& track : tracks) CHECK(track["friction_angle_deg"].get<double>() == Approx(5.0));
}

TEST_CASE("compare --csv writes every curve from the start to the finish") {
  const TempDir place;
  const std::string file = (place / "curves.csv").string();
  const Outcome outcome = glissade_run({"compare", shipped("grain_chute"), "--csv", file});
  REQUIRE(outcome.exit_code == 0);
  std::istringstream lines(bytes_of(file));
  std::string line;
  std::getline(lines, line);
  CHECK(line == "design,centerline,friction_angle_deg,arc_length_m,run_m,drop_m,slope_angle_deg");
  std::size_t count = 0;
  while (std::getline(lines, line)) ++count;
  CHECK(count == 5 * 201);
}

TEST_CASE("compare --csv of two designs tells which design a curve belongs to") {
  const TempDir place;
  const std::string file = (place / "curves.csv").string();
  const std::vector<std::string> designs = {shipped("grain_chute"), shipped("powder_chute")};
  REQUIRE(glissade_run({"compare", designs[0], designs[1], "--csv", file}).exit_code == 0);
  std::istringstream lines(bytes_of(file));
  std::set<std::string> found;
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) found.insert(line.substr(0, line.find(',')));
  CHECK(found == std::set<std::string>(designs.begin(), designs.end()));
}

TEST_CASE("compare shows the fastest track within limits beside the others, each held against the limits") {
  const Outcome outcome = glissade_run({"compare", shipped("grain_chute_with_limits")});
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.output, Contains("fastest in limits") && Contains("kept") && Contains(" broken"));
  const json tracks = compared({shipped("grain_chute_with_limits")});
  REQUIRE(tracks.size() == 6);
  CHECK(tracks[0]["search"]["status"] == "optimal");
  CHECK(tracks[1]["centerline"] == "fastest");
  CHECK(tracks[1]["search"].is_null());
  // Without limits it is faster, between the same two points.
  CHECK(tracks[1]["travel_time_s"].get<double>() < tracks[0]["travel_time_s"].get<double>());
  for (const json& track : tracks) {
    if (!track["problem"].is_null()) continue;
    CHECK(track["drop_m"].get<double>() == Approx(tracks[0]["drop_m"].get<double>()));
  }
  CHECK(tracks[3]["centerline"] == "straight");
  CHECK_FALSE(tracks[3]["limits"].empty());
}

TEST_CASE("hills side by side tell what a planner chooses them by, and a page lets each be taken away") {
  const TempDir place;
  const std::string page = (place / "hills.html").string();
  const Outcome outcome = glissade_run({"compare", designs_path("hills/garmisch_hs142.yaml"),
                                        designs_path("hills/rasnov_hs38.yaml"), "--html", page});
  INFO(outcome.errors);
  REQUIRE(outcome.exit_code == 0);
  CHECK_THAT(outcome.output,
             Contains("gamma, alpha") && Contains("35 deg, 11 deg") && Contains("30 deg, 9.4 deg"));
  CHECK_THAT(outcome.output, Contains("22.71 to 26.84 m/s"));
  const std::string html = bytes_of(page);
  CHECK_THAT(html, Contains("id=\"choose-2\"") && !Contains("id=\"choose-3\""));
  // Bare numbers under headings with units, to sort by.
  CHECK_THAT(html, Contains(">gamma [deg]</th>") && Contains("<td>9.4</td>") && Contains("<td>22.71</td>"));
  // A line in each of five figures; the boxes are their legend.
  std::size_t found = 0;
  for (std::size_t at = html.find("line choice-2\""); at != std::string::npos;
       at = html.find("line choice-2\"", at + 1)) {
    ++found;
  }
  CHECK(found == 5);
  CHECK_THAT(html, Contains("<tr class=\"choice-2\">"));
}

TEST_CASE("compare: designs of one file name are told apart by as much of their path as that takes") {
  const TempDir directory;
  const auto write = [&](const std::string& file, const std::string& name) {
    std::filesystem::create_directories((directory.path() / file).parent_path());
    std::ofstream(directory.path() / file)
        << "glissade: 1\n"
        << name << "track: {start: {x: 0 m, z: 6 m}, finish: {x: 10 m, z: 0 m}}\n"
        << "body: {friction_angle: 11 deg}\ncenterline: {kind: straight}\n";
    return (directory.path() / file).string();
  };
  const std::string first = write("a/x/chute.yaml", "");
  const std::string second = write("b/x/chute.yaml", "");
  const std::string third = write("b/slide.yaml", "");
  const std::string page = (directory.path() / "page.html").string();
  const Outcome outcome = glissade_run({"compare", first, second, third, "--html", page});
  INFO(outcome.errors);
  REQUIRE(outcome.exit_code == 0);
  CHECK_THAT(outcome.output,
             Contains("a/x/chute ") && Contains("b/x/chute ") && Contains("slide ") && !Contains("/slide"));
  std::ifstream stream(page);
  const std::string html((std::istreambuf_iterator<char>(stream)), {});
  CHECK_THAT(html, Contains("a/x/chute") && Contains("b/x/chute"));
  // Names of their own that are the same, too.
  const Outcome named = glissade_run(
      {"compare", write("c/one.yaml", "name: Chute\n"), write("c/two.yaml", "name: Chute\n"), third});
  CHECK_THAT(named.output, Contains("Chute (one)") && Contains("Chute (two)") && Contains("slide "));
}
