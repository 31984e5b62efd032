#include "glissade/core/error.hpp"
#include "glissade/study/study.hpp"

#include "support/catch.hpp"
#include "support/temp_dir.hpp"
#include "support/thorough.hpp"

#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

namespace run_test {

using namespace glissade;
using namespace glissade::study;
using Catch::Matchers::Contains;

namespace {

std::vector<Quantity> time_and_speed(const Design& design, const Track& track) {
  const bool arrived = track.motion.arrived();
  return {{"travel_time_s", arrived ? std::optional(track.motion.travel_time()) : std::nullopt},
          {"exit_speed_m_per_s", arrived ? std::optional(track.motion.exit_speed()) : std::nullopt},
          {"friction_coefficient", design.body.friction.coefficient()}};
}

constexpr const char* kDesign = R"(glissade: 1
track: {start: {x: 0 m, z: 5 m}, finish: {x: 10 m, z: 0 m}}
body: {friction_angle: 11 deg}
centerline: {kind: fastest}
)";

Study study_of(std::vector<Factor> factors, const std::string& design = kDesign) {
  return {DesignSource::parse(design, "slide.yaml"), {}, Plan(std::move(factors)), false, {}, time_and_speed};
}

std::string merged(const std::filesystem::path& directory) {
  const TempDir place;
  merge(Results::open(directory), place.path() / "all.csv");
  return bytes_of(place.path() / "all.csv");
}

std::vector<Row> rows_of(const std::filesystem::path& directory) {
  std::vector<Row> rows;
  Results::open(directory).for_each([&](const Row& row) { rows.push_back(row); });
  return rows;
}

}  // namespace

TEST_CASE("columns are the same whether a stream arrives, chokes or stalls") {
  const auto names_of = [](const std::string& flow, const std::string& angle) {
    const Design design = parse_design(
        "glissade: 1\n"
        "track: {start: {x: 0 m, z: 3 m}, finish: {x: 2 m, z: 0 m}}\n"
        "body: {friction_angle: 25 deg, entry_speed: 2 m/s}\n"
        "stream: {mass_flow: 100 t/h, bulk_density: 800 kg/m^3}\n"
        "discharge: {belt_speed: 3 m/s, drop: 200 mm}\n"
        "centerline: {kind: straight}\n"
        "cross_section: {kind: u-channel, width: 400 mm, wall_height: 250 mm, thickness: 4 mm}\n",
        "d.yaml", {{"stream.mass_flow", flow}, {"body.friction_angle", angle}});
    std::vector<std::string> names;
    for (const Quantity& quantity : quantities_of(design, solve(design))) names.push_back(quantity.first);
    return names;
  };
  const std::vector<std::string> arrives = names_of("100 t/h", "25 deg");
  CHECK(std::find(arrives.begin(), arrives.end(), "stream.choke.depth_m") != arrives.end());
  CHECK(std::find(arrives.begin(), arrives.end(), "law_end.arc_length_m") != arrives.end());
  CHECK(std::find(arrives.begin(), arrives.end(), "discharge.landing_speed_m_per_s") != arrives.end());
  CHECK(names_of("300 t/h", "58 deg") == arrives);
  CHECK(names_of("100 t/h", "70 deg") == arrives);
}

TEST_CASE("a row holds what solve() gives, to the last digit") {
  const TempDir place;
  const Study study = study_of({vary("body.friction_angle=5deg:25deg:21")});
  const RunReport report = run(study, {.directory = place.path()});
  CHECK(report.complete);
  CHECK(report.points == 21);
  const std::vector<Row> rows = rows_of(place.path());
  REQUIRE(rows.size() == 21);
  for (const Row& row : rows) {
    const std::string angle = std::to_string(5 + row.index) + " deg";
    const Design design = parse_design(kDesign, "slide.yaml", {{"body.friction_angle", angle}});
    const Track track = solve(design);
    CHECK(row.status == Status::arrived);
    CHECK(row.reason.empty());
    CHECK(row.inputs == std::vector{std::to_string(5 + row.index)});
    CHECK(row.quantities[0] == track.motion.travel_time());
    CHECK(row.quantities[1] == track.motion.exit_speed());
  }
}

TEST_CASE("a point that fails is a row that says why") {
  const TempDir place;
  // Steeper than the chord, no number of friction, and a word that is no angle.
  (void)run(study_of({vary("body.friction_angle=20deg,30deg,95deg,17,20deg")}), {.directory = place.path()});
  const std::vector<Row> rows = rows_of(place.path());
  REQUIRE(rows.size() == 5);
  CHECK(rows[0].status == Status::arrived);
  CHECK(rows[1].status == Status::infeasible);
  CHECK_THAT(rows[1].reason, Contains("steeper than the mean slope"));
  CHECK_FALSE(rows[1].quantities[0].has_value());
  CHECK(rows[2].status == Status::invalid);
  CHECK(rows[3].status == Status::invalid);
  CHECK_THAT(rows[3].reason, Contains("17"));
  CHECK(rows[4].quantities == rows[0].quantities);
}

TEST_CASE("a frozen track stalls where a track of its own would arrive") {
  const TempDir place;
  Study study = study_of({vary("body.friction_angle=11deg,26deg,30deg")});
  study.frozen = true;
  (void)run(study, {.directory = place.path()});
  const std::vector<Row> rows = rows_of(place.path());
  CHECK(rows[0].quantities[0] == solve(parse_design(kDesign, "slide.yaml")).motion.travel_time());
  CHECK(rows[1].status == Status::stalled);
  CHECK_THAT(rows[1].reason, Contains("stalls after"));
  CHECK(rows[2].status ==
        Status::stalled);  // 26 deg rubs more than the chord falls, but this track begins steeply
}

TEST_CASE("a row says how a stream or a feed does not arrive, in the words of a single ride") {
  const std::string design =
      "glissade: 1\n"
      "track: {start: {x: 0 m, z: 4 m}, finish: {x: 2 m, z: 1 m}}\n"
      "body: {friction_angle: {low: 20 deg, nominal: 24 deg, high: 28 deg}}\n"
      "feed: {kind: belt, belt_speed: 2 m/s, pulley_radius: 400 mm, drop: 500 mm}\n"
      "stream: {mass_flow: 300 t/h, bulk_density: 1600 kg/m^3}\n"
      "centerline: {kind: straight}\n"
      "cross_section: {kind: u-channel, width: 800 mm, wall_height: 500 mm, thickness: 8 mm}\n";
  const auto row_of = [&](const std::string& values) {
    const TempDir place;
    Study study = study_of({vary(values)}, design);
    study.quantities = quantities_of;
    (void)run(study, {.directory = place.path()});
    return rows_of(place.path()).at(0);
  };
  const Row arrives = row_of("stream.mass_flow=300t/h");
  CHECK(arrives.status == Status::arrived);
  const Row chokes = row_of("stream.mass_flow=12000t/h");
  CHECK(word(chokes.status) == "choked");
  CHECK_THAT(chokes.reason, Contains("the stream chokes"));
  const Row flies = row_of("feed.drop=50mm");
  CHECK(word(flies.status) == "flies over the start");
  CHECK(flies.quantities.size() == arrives.quantities.size());
  // Stands at the highest friction alone: the ride that fails has the word, not the nominal one.
  const Row stands = row_of("body.friction_angle.high=89.5deg");
  CHECK(word(stands.status) == "stands where it lands");
  for (const Status status : kStatuses) CHECK(status_named(word(status)) == status);
}

TEST_CASE("what shapes a frozen track cannot vary") {
  const TempDir place;
  Study study = study_of({vary("track.finish.z=0m,1m")});
  study.frozen = true;
  CHECK_THROWS_WITH(run(study, {.directory = place.path()}),
                    Contains("track.finish.z shapes the track, which is frozen"));
}

TEST_CASE("shards of any number, in any order, on any number of threads give the same bytes") {
  // With an entry speed a fastest track is searched for, where one from rest is known.
  const std::vector<std::string> texts = {
      "body.friction_angle=5deg:25deg:1050",
      testing::thorough() ? "body.entry_speed=0m/s,1m/s" : "gravity=9.81m/s^2,1.62m/s^2"};
  const auto study = [&] { return study_of({vary(texts[0]), vary(texts[1])}); };
  const TempDir whole;
  CHECK(run(study(), {.directory = whole.path(), .jobs = 1}).chunks == 3);
  const TempDir parts;
  for (const std::uint64_t shard : {4U, 0U, 2U, 1U, 3U}) {
    const RunReport report = run(study(), {.directory = parts.path(), .shard = {shard, 5}, .jobs = 2});
    CHECK(report.chunks_of_shard == (shard < 3 ? 1 : 0));
    CHECK(report.complete == (shard == 1 || shard == 3));  // the three chunks are those of 0, 1 and 2
  }
  CHECK(merged(whole.path()) == merged(parts.path()));
  CHECK(bytes_of(whole.path() / kManifestName) == bytes_of(parts.path() / kManifestName));
}

TEST_CASE("what is there is not computed again, what is missing is") {
  const TempDir place;
  const auto study = [] { return study_of({vary("body.friction_angle=5deg:25deg:2500")}); };
  CHECK(run(study(), {.directory = place.path()}).chunks_computed == 3);
  const std::string before = merged(place.path());
  std::filesystem::remove(place.path() / "chunks" / "000001.csv");
  CHECK_THROWS_WITH(merged(place.path()), Contains("000001.csv: is missing, with 1 of 3 chunks in all"));
  const RunReport report = run(study(), {.directory = place.path()});
  CHECK(report.chunks_found == 2);
  CHECK(report.chunks_computed == 1);
  CHECK(merged(place.path()) == before);
}

TEST_CASE("another sweep's directory is refused with what differs, and keeps its rows") {
  const TempDir place;
  (void)run(study_of({vary("body.friction_angle=5deg:25deg:3")}), {.directory = place.path()});
  const std::string before = merged(place.path());
  const auto refused = [&](const Study& study, const std::string& difference) {
    CHECK_THROWS_AS(run(study, {.directory = place.path()}), InputError);
    CHECK_THROWS_WITH(run(study, {.directory = place.path()}),
                      Contains("the directory holds another sweep; these differ: " + difference));
  };
  refused(study_of({vary("body.friction_angle=5deg:25deg:4")}), "variations, points");
  const std::string edited = std::string(kDesign) + "gravity: 9.8 m/s^2\n";
  refused(study_of({vary("body.friction_angle=5deg:25deg:3")}, edited), "design_sha256");
  Study frozen = study_of({vary("body.friction_angle=5deg:25deg:3")});
  frozen.frozen = true;
  refused(frozen, "frozen");
  Study fewer = study_of({vary("body.friction_angle=5deg:25deg:3")});
  fewer.columns = {"travel_time_s"};
  refused(fewer, "quantities");
  CHECK(merged(place.path()) == before);
}

TEST_CASE("rows without a manifest are of no sweep that is known: they are refused, and kept") {
  const TempDir place;
  const auto study = [] { return study_of({vary("body.friction_angle=5deg:25deg:3")}); };
  (void)run(study(), {.directory = place.path()});
  const std::filesystem::path manifest = place.path() / kManifestName;
  const std::string told = bytes_of(manifest);
  const std::string rows = bytes_of(place.path() / "chunks" / "000000.csv");
  std::filesystem::remove(manifest);
  CHECK_THROWS_AS(run(study(), {.directory = place.path()}), InputError);
  CHECK_THROWS_WITH(run(study(), {.directory = place.path()}),
                    Contains("chunks: rows lie here, and no manifest.json beside them tells of which sweep"));
  CHECK_FALSE(std::filesystem::exists(manifest));
  CHECK(bytes_of(place.path() / "chunks" / "000000.csv") == rows);
  std::ofstream(manifest, std::ios::binary) << told;
  CHECK(run(study(), {.directory = place.path()}).chunks_found == 1);
  // An empty directory of rows, as a killed process leaves it, is begun.
  std::filesystem::remove_all(place.path());
  std::filesystem::create_directories(place.path() / "chunks");
  CHECK(run(study(), {.directory = place.path()}).chunks_computed == 1);
}

TEST_CASE("a file that a design names is part of what is studied, whichever key names it") {
  const TempDir place;
  const auto put = [&](const char* name, const char* rows) {
    std::ofstream(place.path() / name) << "x,z\n" << rows;
  };
  put("ground.csv", "0,-9\n10,-9\n");
  put("other.csv", "0,-8\n10,-8\n");
  const std::string text =
      std::string(kDesign) + "limits: {stay_above: [{file: ground.csv}], slope_angle: {highest: 60 deg}}\n";
  const auto study = [&] {
    Study made = study_of(
        {vary("body.friction_angle=5deg,6deg"), vary("limits.stay_above.0.file=ground.csv,other.csv")});
    made.source = DesignSource::parse(text, place.path() / "slide.yaml");
    return made;
  };
  const std::filesystem::path rows = place.path() / "rows";
  REQUIRE(run(study(), {.directory = rows}).chunks_computed == 1);
  for (const Row& row : rows_of(rows)) CHECK(row.status == Status::arrived);
  CHECK(run(study(), {.directory = rows}).chunks_found == 1);
  for (const char* edited : {"ground.csv", "other.csv"}) {
    const std::string before = bytes_of(place.path() / edited);
    put(edited, "0,-7\n10,-7\n");
    CHECK_THROWS_WITH(run(study(), {.directory = rows}), Contains("these differ: profiles"));
    std::ofstream(place.path() / edited) << before;
  }
  CHECK(run(study(), {.directory = rows}).chunks_found == 1);
}

TEST_CASE("a key that the design does not know ends the sweep before it begins") {
  const TempDir place;
  CHECK_THROWS_WITH(
      run(study_of({vary("body.frction_angle=5deg:25deg:3")}), {.directory = place.path() / "new"}),
      Contains("frction_angle"));
  CHECK_THROWS_WITH(
      run(study_of({vary("body.friction_angle=5kg:25kg:3")}), {.directory = place.path() / "new"}),
      Contains("kg"));
  CHECK_FALSE(std::filesystem::exists(place.path() / "new"));
}

TEST_CASE("columns are chosen by name, and an unknown one is refused with those that there are") {
  const TempDir place;
  Study study = study_of({vary("body.friction_angle=5deg:25deg:3")});
  study.columns = {"exit_speed_m_per_s"};
  (void)run(study, {.directory = place.path() / "one"});
  CHECK(Results::open(place.path() / "one").quantities() == study.columns);
  study.columns = {"exit_sped"};
  CHECK_THROWS_WITH(
      run(study, {.directory = place.path() / "two"}),
      Contains("'exit_sped' is no quantity of this design") && Contains("travel_time_s, exit_speed_m_per_s"));
}

TEST_CASE("a chunk that is broken is found with the file and the line") {
  const TempDir place;
  (void)run(study_of({vary("body.friction_angle=5deg:25deg:5")}), {.directory = place.path()});
  const std::filesystem::path chunk = place.path() / "chunks" / "000000.csv";
  const std::string good = bytes_of(chunk);
  const auto broken = [&](const std::string& text, const std::string& message) {
    std::ofstream(chunk, std::ios::binary) << text;
    CHECK_THROWS_AS(merged(place.path()), FileError);
    CHECK_THROWS_WITH(merged(place.path()), Contains("000000.csv") && Contains(message));
  };
  const std::size_t second = good.find('\n', good.find('\n') + 1) + 1;
  broken(good.substr(0, good.size() / 2), "");
  broken(good.substr(0, second), "1 rows instead of 5");
  broken("index,status\n" + good, "the heading is not that of the manifest");
  std::string swapped = good;
  swapped.replace(second, 1, "3");
  broken(swapped, "row 3 stands where row 1 belongs");
  std::string renamed = good;
  renamed.replace(renamed.find("arrived"), 7, "arrivde");
  broken(renamed, "'arrivde' is no status");
}

TEST_CASE("a chunk that is cut off anywhere is found, in the middle of a number and of a quoted reason too") {
  const TempDir place;
  (void)run(study_of({vary("body.friction_angle=25deg,60deg")}), {.directory = place.path()});
  const std::filesystem::path chunk = place.path() / "chunks" / "000000.csv";
  const std::string good = bytes_of(chunk);
  REQUIRE_THAT(good, Contains("\""));
  for (std::size_t length = 0; length < good.size(); ++length) {
    INFO(length);
    std::ofstream(chunk, std::ios::binary) << good.substr(0, length);
    CHECK_THROWS_AS(merged(place.path()), FileError);
    CHECK_THROWS_WITH(merged(place.path()), Contains("000000.csv:") && Contains("remove this file"));
  }
  std::ofstream(chunk, std::ios::binary) << good.substr(0, good.size() - 1);
  CHECK_THROWS_WITH(merged(place.path()), Contains("000000.csv:3: the line has no end: the file is cut off"));
  std::ofstream(chunk, std::ios::binary) << good.substr(0, good.rfind('"')) << '\n';
  CHECK_THROWS_WITH(merged(place.path()), Contains("000000.csv:3: a quotation mark is not closed"));
  std::ofstream(chunk, std::ios::binary) << good;
  CHECK_NOTHROW(merged(place.path()));
}

TEST_CASE("rows that the manifest does not tell of are refused, those of an edited manifest too") {
  const TempDir place;
  Study study = study_of({vary("body.friction_angle=5deg:25deg:1001")});
  study.frozen = true;
  (void)run(study, {.directory = place.path()});
  const std::string all = merged(place.path());
  const std::filesystem::path chunks = place.path() / "chunks";
  std::ofstream(chunks / "notes.csv") << "no chunk\n";
  std::ofstream(chunks / "7.csv") << "no chunk\n";
  CHECK(merged(place.path()) == all);
  std::filesystem::copy_file(chunks / "000001.csv", chunks / "000002.csv");
  CHECK_THROWS_AS(merged(place.path()), FileError);
  CHECK_THROWS_WITH(merged(place.path()), Contains("000002.csv: is none of the 2 chunks") &&
                                              Contains("1001 points") && Contains("manifest.json"));
  std::filesystem::remove(chunks / "000002.csv");
  const std::filesystem::path manifest = place.path() / kManifestName;
  std::string text = bytes_of(manifest);
  const std::size_t points = text.find("\"points\": 1001");
  REQUIRE(points != std::string::npos);
  text.replace(points + 10, 4, "1000");
  std::ofstream(manifest, std::ios::binary) << text;
  CHECK_THROWS_WITH(merged(place.path()), Contains("000001.csv: is none of the 1 chunks"));
}

TEST_CASE("an interrupted run says that it can go on") {
  const TempDir place;
  std::stop_source stop;
  stop.request_stop();
  RunOptions options;
  options.directory = place.path();
  options.stop = stop.get_token();
  CHECK_THROWS_AS(run(study_of({vary("body.friction_angle=5deg:25deg:3")}), options), Interrupted);
}

TEST_CASE("an interrupted reading says what it leaves: rows that a sweep goes on from, or no table at all") {
  const TempDir place;
  RunOptions options;
  options.directory = place.path() / "s";
  run(study_of({vary("body.friction_angle=5deg:15deg:3")}), options);
  const Results results = Results::open(place.path() / "s");
  std::stop_source stop;
  stop.request_stop();
  CHECK_THROWS_WITH(
      results.for_each([](const Row&) {}, {}, stop.get_token()),
      Contains("s: interrupted; the rows that are written stay") && Contains("goes on where this one ended"));
  CHECK_THROWS_WITH(merge(results, place.path() / "all.csv", {}, stop.get_token()),
                    Contains("all.csv: interrupted; the table is not written") &&
                        Contains("The rows stay as they are; the same command begins the table anew."));
  CHECK_FALSE(std::filesystem::exists(place.path() / "all.csv"));
}

TEST_CASE("a shard is i/n") {
  CHECK(Shard::parse("3/16").index == 3);
  CHECK(Shard::parse("3/16").count == 16);
  for (const char* text : {"", "3", "16/16", "-1/4", "1/0", "1/2/3", "a/b", "1/4 "}) {
    CHECK_THROWS_WITH(Shard::parse(text), Contains("is not of the form i/n with 0 <= i < n"));
  }
}

TEST_CASE("a directory without a manifest is no sweep") {
  const TempDir place;
  CHECK_THROWS_WITH(Results::open(place.path()), Contains("there is no manifest of a sweep here"));
  std::ofstream(place.path() / kManifestName) << "{}";
  CHECK_THROWS_WITH(Results::open(place.path()), Contains("this is no manifest of a sweep"));
  std::ofstream(place.path() / kManifestName) << "{\"glissade_sweep\": 2, \"rows_per_chunk\": 10}";
  CHECK_THROWS_WITH(Results::open(place.path()), Contains("another version"));
}

TEST_CASE("rows without the optimum's time do not find it, and have the same figures") {
  // With an entry speed the optimum of a drawn track costs several times its ride.
  Study study =
      study_of({vary(testing::thorough() ? "body.friction_angle=5deg:25deg:3" : "body.friction_angle=15deg")},
               std::string(kDesign) + "limits: {speed: {highest: 60 m/s}}\n");
  study.base.push_back({"body.entry_speed", "2 m/s"});
  bool found = false;
  study.quantities = [&](const Design& design, const Track& track) {
    found = found || track.optimum.has_value();
    return quantities_of(design, track);
  };
  const TempDir place;
  (void)run(study, {.directory = place.path() / "all"});
  CHECK(found);
  found = false;
  study.columns = {"travel_time_s", "limits.speed.highest.reached"};
  (void)run(study, {.directory = place.path() / "fewer"});
  CHECK_FALSE(found);
  const std::vector<Row> all = rows_of(place.path() / "all");
  const std::vector<Row> fewer = rows_of(place.path() / "fewer");
  REQUIRE(all.size() == fewer.size());
  const std::vector<std::string> names = Results::open(place.path() / "all").quantities();
  for (std::size_t row = 0; row < all.size(); ++row) {
    for (std::size_t column = 0; column < study.columns.size(); ++column) {
      const auto at = std::find(names.begin(), names.end(), study.columns[column]);
      REQUIRE(at != names.end());
      CHECK(fewer[row].quantities[column] ==
            all[row].quantities[static_cast<std::size_t>(at - names.begin())]);
    }
  }
  study.columns = {"optimum_travel_time_s"};
  (void)run(study, {.directory = place.path() / "optimum"});
  CHECK(found);
}

}  // namespace run_test
