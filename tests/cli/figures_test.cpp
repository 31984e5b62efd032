#include "cli/glissade.hpp"
#include "support/catch.hpp"
#include "support/temp_dir.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

const std::vector<std::string> kTrack = {"--run", "10", "--drop", "5", "--friction-angle", "11deg"};

std::vector<std::string> with(std::vector<std::string> first, const std::vector<std::string>& more) {
  first.insert(first.end(), more.begin(), more.end());
  return first;
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t times = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++times;
  return times;
}

}  // namespace

TEST_CASE("plot draws each quantity as a panel of its own") {
  const TempDir place;
  const Outcome outcome = glissade_run(
      with(with({"plot"}, kTrack), {"--what", "profile,slope,speed,load,curvature,energy", "-o", "all.svg"}),
      {place.path(), {}, {}});
  INFO(outcome.errors);
  REQUIRE(outcome.exit_code == 0);
  CHECK(outcome.output.empty());
  const std::string svg = bytes_of(place / "all.svg");
  CHECK_THAT(svg, StartsWith("<svg"));
  CHECK(count(svg, "role=\"group\"") == 6);
  for (const char* label : {"run x [m]", "slope angle [deg]", "speed [m/s]", "normal load [g]",
                            "curvature [1/m]", "lost to friction", "straight line"}) {
    CHECK_THAT(svg, Contains(label));
  }
}

TEST_CASE("plot draws PNG where the name asks for it") {
  const TempDir place;
  const Outcome outcome =
      glissade_run({"plot", shipped("grain_chute"), "-o", "chute.png"}, {place.path(), {}, {}});
  INFO(outcome.errors);
  REQUIRE(outcome.exit_code == 0);
  CHECK_THAT(bytes_of(place / "chute.png"), StartsWith("\x89PNG"));
}

TEST_CASE("plot names what it cannot do") {
  const TempDir place;
  const Outcome format = glissade_run(with(with({"plot"}, kTrack), {"-o", "a.pdf"}), {place.path(), {}, {}});
  CHECK(format.exit_code == 2);
  CHECK_THAT(format.errors, Contains("a.pdf is neither a .svg nor a .png file"));
  const Outcome quantity =
      glissade_run(with(with({"plot"}, kTrack), {"--what", "colour", "-o", "a.svg"}), {place.path(), {}, {}});
  CHECK(quantity.exit_code == 2);
  CHECK_THAT(quantity.errors, Contains("'colour' cannot be drawn") && Contains("profile, slope"));
}

TEST_CASE("compare draws the seven curves of the paper's figure 1") {
  const TempDir place;
  const Outcome outcome =
      glissade_run({"compare", "--run", "2.5", "--drop", "2.5", "--p", "100", "--friction-sweep",
                    "11deg,13deg,15deg,17deg,20deg,25deg,40deg", "--svg", "figure.svg"},
                   {place.path(), {}, {}});
  INFO(outcome.errors);
  REQUIRE(outcome.exit_code == 0);
  const std::string svg = bytes_of(place / "figure.svg");
  CHECK_THAT(svg, Contains("P = 100"));
  // A line and its entry in the legend, in two panels.
  CHECK(count(svg, "class=\"line\"") == 4 * 7);
  for (const char* angle : {"11 deg", "13 deg", "15 deg", "17 deg", "20 deg", "25 deg", "40 deg"}) {
    CHECK_THAT(svg, Contains(std::string("<title>") + angle + "</title>"));
  }
}

TEST_CASE("compare --html is one page with figures and the table, and asks nothing of a network") {
  const TempDir place;
  const Outcome outcome =
      glissade_run(with(with({"compare"}, kTrack), {"--html", "page.html"}), {place.path(), {}, {}});
  INFO(outcome.errors);
  REQUIRE(outcome.exit_code == 0);
  const std::string page = bytes_of(place / "page.html");
  CHECK_THAT(page, StartsWith("<!doctype html>") && Contains("Travel time over friction") &&
                       Contains("Steepest slope over friction") && Contains("constant-speed"));
  CHECK_THAT(page, !Contains("<script") && !Contains("src=") && !Contains("href="));
}

TEST_CASE("compare puts several designs side by side") {
  const TempDir place;
  const Outcome outcome =
      glissade_run({"compare", shipped("grain_chute"), shipped("powder_chute"), "--html", "both.html"},
                   {place.path(), {}, {}});
  INFO(outcome.errors);
  REQUIRE(outcome.exit_code == 0);
  CHECK_THAT(outcome.output, Contains("Comparison of designs"));
  CHECK(std::count(outcome.output.begin(), outcome.output.end(), '\n') >= 5);
  CHECK_THAT(bytes_of(place / "both.html"), Contains("Normal load"));
}

TEST_CASE("a design named <script> stays text in the pages and figures of a comparison") {
  const TempDir place;
  std::string design = bytes_of(shipped("grain_chute"));
  const std::size_t name = design.find("name:");
  REQUIRE(name != std::string::npos);
  design.replace(name, design.find('\n', name) - name, "name: '<script>alert(1)</script>'");
  put_bytes(place / "hostile.yaml", design);
  REQUIRE(glissade_run({"compare", "hostile.yaml", "--html", "page.html", "--svg", "figure.svg"},
                       {place.path(), {}, {}})
              .exit_code == 0);
  CHECK_THAT(bytes_of(place / "page.html"), !Contains("<script"));
  CHECK_THAT(bytes_of(place / "figure.svg"), !Contains("<script"));
}

TEST_CASE(
    "in a pipe a build says nothing while it works; --verbose tells each step, --quiet nothing at all") {
  const TempDir place;
  const std::vector<std::string> build = {"build", shipped("grain_chute"), "-o", "out"};
  CHECK(glissade_run(build, {place.path(), {}, {}}).errors.empty());
  const Outcome verbose = glissade_run(with(build, {"--verbose"}), {place.path(), {}, {}});
  CHECK_THAT(verbose.errors, Contains("finding the track") && Contains("making the mesh") &&
                                 Contains("writing grain_chute.stl") &&
                                 Contains("writing grain_chute.report.html"));
  const Outcome quiet = glissade_run(with(build, {"--quiet"}), {place.path(), {}, {}});
  CHECK(quiet.output.empty());
  CHECK(quiet.errors.empty());
  const Outcome both = glissade_run(with(build, {"--quiet", "--verbose"}), {place.path(), {}, {}});
  CHECK(both.exit_code == 2);
  CHECK_THAT(both.errors, Contains("--verbose") && Contains("--quiet"));
}

TEST_CASE("a comparison of a design with limits draws its curves over friction without them, and says so") {
  const TempDir place;
  std::string design = bytes_of(shipped("ski_jump_inrun"));
  put_bytes(place / "limited.yaml", design + "\nlimits: {slope_angle: {highest: 60 deg}}\n");
  const Outcome outcome =
      glissade_run({"compare", "limited.yaml", "--svg", "figures.svg"}, {place.path(), {}, {}});
  INFO(outcome.errors);
  REQUIRE(outcome.exit_code == 0);
  const std::string svg = bytes_of(place / "figures.svg");
  CHECK_THAT(svg, Contains("Travel time over friction, without limits"));
  // Each track is drawn alike in all figures, no two tracks alike.
  std::map<std::string, std::set<std::string>> styles;
  std::map<std::string, int> figures;
  const std::regex line(
      R"re(<path class="line[^"]*" (stroke="[^"]*"( stroke-dasharray="[^"]*")?) d="[^"]*"><title>([^<]*))re");
  for (std::sregex_iterator one(svg.begin(), svg.end(), line), end; one != end; ++one) {
    styles[(*one)[3]].insert((*one)[1]);
    ++figures[(*one)[3]];
  }
  CHECK(figures.at("fastest") == 4);
  CHECK(figures.at("fastest in limits") == 2);
  std::set<std::string> all;
  for (const auto& [name, own] : styles) {
    CAPTURE(name);
    CHECK(own.size() == 1);
    CHECK(all.insert(*own.begin()).second);
  }
}

TEST_CASE("times over friction tell of friction that changes along the track as ride does") {
  const TempDir place;
  const auto figures = [&](const std::string& friction) {
    put_bytes(
        place / "d.yaml",
        "glissade: 1\ntrack: {start: {x: 0 m, z: 10 m}}\nbody: {friction: [" + friction +
            "]}\ncenterline: {kind: segments, entry_slope_angle: 30 deg, segments: [{length: 10 m}]}\n");
    const Outcome outcome =
        glissade_run({"compare", (place / "d.yaml").string(), "--svg", (place / "f.svg").string()});
    INFO(outcome.errors);
    REQUIRE(outcome.exit_code == 0);
    return bytes_of(place / "f.svg");
  };
  // The first long line below the title is that of the design's own kind: as many heights as points.
  const std::string svg = figures("{from: 0 m, angle: 20 deg}, {from: 5 m, angle: 8 deg}");
  std::size_t at = svg.find("Travel time over friction");
  REQUIRE(at != std::string::npos);
  std::string line;
  while (line.size() < 100) {
    at = svg.find("class=\"line", at + 1);
    REQUIRE(at != std::string::npos);
    const std::size_t from = svg.find(" d=\"", at) + 4;
    line = svg.substr(from, svg.find('"', from) - from);
  }
  std::istringstream points(line.substr(1));
  std::set<std::string> heights;
  std::size_t number = 0;
  for (std::string x, y; std::getline(points, x, ' ') && std::getline(points, y, 'L'); ++number)
    heights.insert(y);
  CHECK(number > 20);
  CHECK(heights.size() == number);
}
