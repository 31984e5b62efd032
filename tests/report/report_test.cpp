#include "glissade/report/report.hpp"

#include "glissade/centerline/straight_line.hpp"

#include "report/station_table.hpp"
#include "support/catch.hpp"
#include "support/temp_dir.hpp"

#include <cmath>
#include <cstring>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

using namespace glissade;
using nlohmann::json;

namespace {

/// A straight chute 4 m long and 3 m high with everything that a report is made from.
class Chute {
 public:
  explicit Chute(double thickness = 4e-3)
      : placement_({1.0, 2.0, 10.0}, Angle::from_degrees(30.0)),
        centerline_(std::make_shared<StraightLine>(Endpoints{4.0, 3.0})),
        motion_(centerline_, Body{Friction::from_coefficient(0.3), 0.0, 0.0}),
        section_(CrossSection::u_channel(0.4, 0.2, thickness)),
        solid_(sweep(*centerline_, section_, placement_, {.tolerance = 1e-3})),
        facts_(measure(solid_.mesh)) {
    design.name = "Straight chute";
    design.file = "chutes/straight.yaml";
    design.track.start = {1.0, 2.0, 10.0};
    design.track.finish = {1.0 + 4.0 * std::sqrt(0.75), 4.0, 7.0};
    design.body.friction = Friction::from_coefficient(0.3);
    design.mesh.tolerance = 1e-3;
  }

  [[nodiscard]] ReportInput input() const {
    ReportInput input;
    input.design = &design;
    input.endpoints = {4.0, 3.0};
    input.placement = placement_;
    input.motion = &motion_;
    input.straight = &motion_;
    input.solid = {&solid_, &facts_, &section_};
    input.checks = {{"Reaches the finish", Verdict::pass, "3.4 m/s there"},
                    {"Limits", Verdict::not_checked, ""}};
    input.files = {{"straight.stl", 84, std::string(64, 'a')}};
    return input;
  }

  Design design;

  [[nodiscard]] const Motion& motion() const { return motion_; }
  [[nodiscard]] const MeshFacts& facts() const { return facts_; }

 private:
  Placement placement_;
  CenterlinePtr centerline_;
  Motion motion_;
  CrossSection section_;
  Solid solid_;
  MeshFacts facts_;
};

/// Numbers of a packed column.
std::vector<double> unpacked(const json& column) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  REQUIRE(column["type"] == "f64");
  std::string bytes;
  unsigned bits = 0;
  int held = 0;
  for (const char c : column["data"].get<std::string>()) {
    if (c == '=') break;
    bits = (bits << 6) | static_cast<unsigned>(digits.find(c));
    held += 6;
    if (held >= 8) bytes.push_back(static_cast<char>((bits >> (held -= 8)) & 0xff));
  }
  std::vector<double> values(bytes.size() / sizeof(double));
  std::memcpy(values.data(), bytes.data(), values.size() * sizeof(double));
  return values;
}

std::string between(const std::string& text, const std::string& from, const std::string& to) {
  const std::size_t start = text.find(from) + from.size();
  return text.substr(start, text.find(to, start) - start);
}

}  // namespace

TEST_CASE("report data: the ride is the referee's, to the last digit") {
  const Chute chute;
  const json document = json::parse(report_json(chute.input()));
  CHECK(document["schema"] == "glissade-report/2");
  CHECK(document["ride"]["travel_time_s"] == chute.motion().travel_time());
  CHECK(document["ride"]["exit_speed_m_per_s"] == chute.motion().exit_speed());
  // Straight ramp: T = sqrt(2 l / (g (sin - mu cos))), sin = 0.6, cos = 0.8.
  CHECK(document["ride"]["travel_time_s"].get<double>() ==
        Approx(std::sqrt(2.0 * 5.0 / (9.81 * (0.6 - 0.3 * 0.8)))).epsilon(1e-12));
  CHECK(document["ride"]["min_radius_m"].is_null());
  CHECK(document["ride"]["optimum_travel_time_s"].is_null());
  CHECK(document["mesh"]["triangles"] == chute.facts().triangles);
}

TEST_CASE("report data: start, run and direction lead to where the body is on the site, to the last digit") {
  const Chute chute;
  const json document = json::parse(report_json(chute.input()));
  const json& placement = document["placement"];
  const json& stations = document["stations"];
  for (std::size_t i = 0; i < stations["x_m"].size(); ++i) {
    const double run = stations["x_m"][i];
    const Vec3 there = chute.input().placement.to_space(run, stations["drop_m"][i], 0.0);
    CHECK(placement["start_m"][0].get<double>() + run * placement["direction"][0].get<double>() == there.x);
    CHECK(placement["start_m"][1].get<double>() + run * placement["direction"][1].get<double>() == there.y);
  }
}

TEST_CASE("report data: every column of the stations has the same length, the energies add up") {
  const Chute chute;
  const json document = json::parse(report_json(chute.input()));
  const json& stations = document["stations"];
  const std::size_t count = stations["arc_length_m"].size();
  CHECK(count > 300);
  for (const auto& [key, column] : stations.items()) {
    INFO(key);
    CHECK(column.size() == count);
  }
  CHECK(stations["arc_length_m"].back() == 5.0);
  for (std::size_t i = 0; i < count; ++i) {
    const double kinetic = 0.5 * std::pow(stations["speed_m_per_s"][i].get<double>(), 2);
    const double lost =
        stations["friction_loss_j_per_kg"][i].get<double>() + stations["drag_loss_j_per_kg"][i].get<double>();
    CHECK(kinetic + lost == Approx(9.81 * stations["drop_m"][i].get<double>()).epsilon(1e-9).margin(1e-12));
    CHECK(stations["z_m"][i].get<double>() == Approx(10.0 - stations["drop_m"][i].get<double>()));
  }
}

TEST_CASE("report data: rows of the table of stations are what the motion tells there, at rounded places") {
  const Chute chute;
  const json document = json::parse(report_json(chute.input()));
  const json& table = document["table"];
  const std::vector<double> places = unpacked(table["arc_length_m"]);
  const std::vector<double> heights = unpacked(table["z_m"]);
  const json& ride = document["rides"][0]["table"];
  const std::vector<double> times = unpacked(ride["time_s"]);
  const std::vector<double> speeds = unpacked(ride["speed_m_per_s"]);
  const std::vector<double> loads = unpacked(ride["normal_load_m_per_s2"]);
  REQUIRE(places.size() == 501);
  CHECK(table["spacing_m"] == 0.01);
  CHECK(places[7] == 0.07);
  CHECK(places.back() == 5.0);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const MotionState state = chute.motion().at(places[i]);
    CHECK(heights[i] == 10.0 - chute.motion().centerline().at(places[i]).drop);
    CHECK(times[i] == state.time);
    CHECK(speeds[i] == state.speed);
    CHECK(loads[i] == state.normal_load);
  }
}

TEST_CASE("station table: 200 to 2000 spacings of a power of ten, and the end of the ride once") {
  for (const double length : {3e-3, 0.2, 0.31622, 1.0, 2.0, 7.54321, 19.999999, 20.0, 1e5}) {
    const Motion motion(std::make_shared<StraightLine>(Endpoints{0.8 * length, 0.6 * length}),
                        Body{Friction::from_coefficient(0.1), 0.0, 0.0});
    const report::StationGrid grid = report::station_grid(motion);
    INFO(length);
    CHECK(grid.places.size() > 200);
    CHECK(grid.places.size() <= 2002);
    CHECK(grid.places.front() == 0.0);
    CHECK(grid.places.back() == motion.distance());
    for (std::size_t i = 1; i < grid.places.size(); ++i)
      CHECK(grid.places[i] - grid.places[i - 1] > 1e-7 * grid.spacing);
  }
}

TEST_CASE("station table: a ride that ends early has no values beyond") {
  const auto track = std::make_shared<StraightLine>(Endpoints{4.0, 3.0});
  const Motion whole(track, Body{Friction::from_coefficient(0.3), 0.0, 0.0});
  const Motion stalled(track, Body{Friction::from_coefficient(0.8), 1.0, 0.0});
  REQUIRE(stalled.stall());
  const report::StationGrid grid = report::station_grid(whole);
  const std::vector<double> speeds = unpacked(report::ride_table(stalled, grid)["speed_m_per_s"]);
  for (std::size_t i = 0; i < grid.places.size(); ++i)
    CHECK(std::isnan(speeds[i]) == (grid.places[i] > stalled.distance()));
}

TEST_CASE("report data: a verdict that nobody reached stays \"not checked\"") {
  const json document = json::parse(report_json(Chute().input()));
  CHECK(document["checks"][0]["verdict"] == "pass");
  CHECK(document["checks"][1]["verdict"] == "not-checked");
}

TEST_CASE("report: same input, same bytes") {
  CHECK(report_html(Chute().input()) == report_html(Chute().input()));
}

TEST_CASE("report: the page carries its data, styles and scripts, and asks nobody for more") {
  const std::string page = report_html(Chute().input());
  const json document =
      json::parse(between(page, "<script type=\"application/json\" id=\"glissade-data\">", "</script>"));
  CHECK(document["design"]["name"] == "Straight chute");
  CHECK(page.find("default-src 'none'") != std::string::npos);
  CHECK(page.find("<link") == std::string::npos);
  CHECK(page.find("<script src") == std::string::npos);
}

TEST_CASE("report: markup in a design's name stays text") {
  Chute chute;
  chute.design.name = "</title></script><script>alert(1)</script> & <!-- \"x\"";
  const std::string page = report_html(chute.input());
  CHECK(page.find("alert(1)</script>") == std::string::npos);
  CHECK(page.find("<script>alert") == std::string::npos);
  CHECK(page.find("<title>&lt;/title&gt;&lt;/script&gt;&lt;script&gt;alert(1)&lt;/script&gt; &amp; &lt;!-- "
                  "&quot;x&quot;</title>") != std::string::npos);
  const json document =
      json::parse(between(page, "<script type=\"application/json\" id=\"glissade-data\">", "</script>"));
  CHECK(document["design"]["name"] == chute.design.name);
}

TEST_CASE("report: a name that is not UTF-8 does not stop the report") {
  Chute chute;
  chute.design.name = "Chute \xff\xfe";
  CHECK_NOTHROW(json::parse(report_json(chute.input())));
}

TEST_CASE("report: a solid with more facets than the view holds is shown with fewer, and the page says so") {
  // A thin plate takes many small facets to stay well shaped.
  const Chute chute(0.4e-3);
  const std::size_t written = chute.facts().triangles;
  REQUIRE(written > kViewTriangles);
  const json document = json::parse(report_json(chute.input()));
  const std::string note = document["view"]["note"];
  const std::string apart = std::to_string(written).insert(3, "\u202f");
  CHECK(note.find("The files hold " + apart + " facets") != std::string::npos);
  // Twelve bytes a facet, four characters for three bytes.
  CHECK(document["view"]["indices"]["data"].get<std::string>().size() <= kViewTriangles * 12 * 4 / 3 + 4);
  CHECK(document["mesh"]["triangles"] == written);
}

TEST_CASE("checksum: SHA-256 of a known text") {
  const TempDir folder;
  std::ofstream(folder / "abc.txt", std::ios::binary) << "abc";
  // FIPS 180-2, appendix B.1.
  CHECK(sha256_of_file(folder / "abc.txt") ==
        "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  CHECK_THROWS_WITH(sha256_of_file(folder / "none.txt"),
                    Catch::Matchers::Contains("none.txt") && Catch::Matchers::Contains("cannot be read"));
}
