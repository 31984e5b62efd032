#include "cli/glissade.hpp"
#include "support/catch.hpp"
#include "support/temp_dir.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

TEST_CASE("--version names the program and its version") {
  const Outcome outcome = glissade_run({"--version"});
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.output == "glissade " GLISSADE_VERSION "\n");
  CHECK(outcome.errors.empty());
}

TEST_CASE("without a command the program says how to get help") {
  const Outcome outcome = glissade_run({});
  CHECK(outcome.exit_code == 2);
  CHECK(outcome.output.empty());
  CHECK_THAT(outcome.errors, StartsWith("glissade: error: "));
  CHECK_THAT(outcome.errors, Contains("Try: glissade --help"));
}

TEST_CASE("an unknown command is named") {
  const Outcome outcome = glissade_run({"bild", "x.yaml"});
  CHECK(outcome.exit_code == 2);
  CHECK_THAT(outcome.errors, Contains("bild") && Contains("Try: "));
}

TEST_CASE("an unknown option is named, with the help of that command") {
  const Outcome outcome = glissade_run({"solve", "--fall", "5"});
  CHECK(outcome.exit_code == 2);
  CHECK_THAT(outcome.errors, Contains("--fall") && Contains("Try: glissade solve --help"));
}

TEST_CASE("build without a design says what is missing") {
  const Outcome outcome = glissade_run({"build"});
  CHECK(outcome.exit_code == 2);
  CHECK_THAT(outcome.errors, Contains("DESIGN.yaml is required") && Contains("Try: glissade build --help"));
}

TEST_CASE("wrong options of solve are answered with what to give instead") {
  struct Wrong {
    std::vector<std::string> arguments;
    std::string message;
  };
  const std::vector<Wrong> cases = {
      {{"solve"}, "neither a design file nor options are given"},
      {{"solve", "--run", "10", "--friction-coefficient", "0.2"}, "--drop is missing"},
      {{"solve", "--run", "10", "--drop", "5"},
       "exactly one of --friction-angle and --friction-coefficient is needed"},
      {{"solve", "--run", "10", "--drop", "5", "--friction-angle", "11"},
       "error: --friction-angle: 11 has no unit"},
      {{"solve", "--run", "10", "--drop", "5", "--friction-angle", "95deg"},
       "friction angle 95 deg is out of range"},
      {{"solve", "--run", "10", "--drop", "5", "--friction-coefficient", "-0.1"}, "out of range"},
      {{"solve", "--run", "10", "--drop", "5", "--friction-coefficient", "nan"}, "--friction-coefficient"},
      {{"solve", "--run", "10 kg", "--drop", "5", "--friction-coefficient", "0"}, "kg"},
      {{"solve", "--run", "10", "--drop", "-5", "--friction-coefficient", "0"}, "--drop: -5 is not positive"},
      {{"solve", "--run", "10", "--drop", "5", "--friction-coefficient", "0", "--centerline", "spiral"},
       "'spiral' is no kind of centerline"},
      {{"solve", "--run", "10", "--drop", "5", "--friction-coefficient", "0", "--centerline", "segments"},
       "needs a design file"},
      {{"solve", "--run", "10", "--drop", "5", "--friction-coefficient", "0.2", "--centerline", "straight",
        "--p", "100"},
       "only the centerline constant-speed has a P"},
      {{"solve", "--set", "body.friction_angle=19deg"}, "there is no design file"},
      {{"solve", shipped("grain_chute"), "--set", "friction"}, "'friction' is not of the form KEY=VALUE"},
      {{"solve", shipped("grain_chute"), "--run", "10"}, "cannot be combined with a design file"},
  };
  for (const Wrong& wrong : cases) {
    const Outcome outcome = glissade_run(wrong.arguments);
    INFO(wrong.message);
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.output.empty());
    CHECK_THAT(outcome.errors, StartsWith("glissade: error: ") && Contains(wrong.message));
  }
}

TEST_CASE("a full disk behind standard output is an error with exit code 5") {
  RunLimits limits;
  limits.output_to = "/dev/full";
  const Outcome outcome = glissade_run({"init"}, limits);
  CHECK(outcome.exit_code == 5);
  CHECK_THAT(outcome.errors, Contains("standard output: writing failed: No space left on device"));
}

TEST_CASE("files that are written before standard output takes nothing are told of") {
  const TempDir place;
  RunLimits limits;
  limits.directory = place.path();
  limits.output_to = "/dev/full";
  const Outcome built = glissade_run({"build", shipped("grain_chute"), "--no-report", "-o", "made"}, limits);
  CHECK(built.exit_code == 5);
  CHECK(built.errors ==
        "glissade: error: standard output: writing failed: No space left on device\n"
        "      All files are written, into made. Only what was to be printed is lost.\n"
        "      Try: a disk with space left\n");
  CHECK(std::filesystem::exists(place / "made/grain_chute.stl"));
  const Outcome compared = glissade_run({"compare", shipped("grain_chute"), "--csv", "c.csv"}, limits);
  CHECK(compared.exit_code == 5);
  CHECK_THAT(compared.errors, Contains("The files that were asked for are written. Only what"));
  const Outcome solved =
      glissade_run({"solve", shipped("grain_chute"), "--csv", "s.csv", "--frozen", "f.yaml"}, limits);
  CHECK(solved.exit_code == 5);
  CHECK_THAT(solved.errors, Contains("The files that were asked for are written. Only what"));
  CHECK(std::filesystem::exists(place / "s.csv"));
  CHECK(std::filesystem::exists(place / "f.yaml"));
  CHECK_FALSE(bytes_of(place / "c.csv").empty());
}

TEST_CASE("what is printed is printed also where a file cannot be written") {
  const TempDir place;
  RunLimits limits;
  limits.directory = place.path();
  std::filesystem::create_directory(place / "taken");
  const Outcome solved = glissade_run({"solve", shipped("grain_chute"), "--csv", "taken"}, limits);
  CHECK(solved.exit_code == 5);
  CHECK_THAT(solved.output, Contains("Travel time"));
  CHECK_THAT(solved.errors, Contains("taken"));
  const Outcome compared = glissade_run({"compare", shipped("grain_chute"), "--csv", "taken"}, limits);
  CHECK(compared.exit_code == 5);
  CHECK_THAT(compared.output, Contains("constant-speed"));
  CHECK_THAT(compared.errors, Contains("taken"));
  const Outcome judged =
      glissade_run({"rules", shipped("hills/garmisch_redesign"), "--csv", "taken"}, limits);
  CHECK(judged.exit_code == 5);
  CHECK_THAT(judged.output, Contains("pass"));
  CHECK_THAT(judged.errors, Contains("taken"));
}

TEST_CASE("the table of gates tells neighbours apart, whatever the size of the track") {
  const TempDir place;
  for (const double scale : {1.0, 0.1, 0.01, 0.001}) {
    CAPTURE(scale);
    const auto m = [&](double metres) { return nlohmann::json(scale * metres).dump() + " m"; };
    std::ofstream(place / "hill.yaml")
        << "glissade: 1\ntrack: {edge: {x: 0 m, z: 0 m}}\nbody: {friction_coefficient: 0.03}\n"
        << "centerline: {kind: in-run, gamma: 36 deg, alpha: 11 deg, r1: " << m(101.1) << ", t: " << m(7.0)
        << ", e1: " << m(99.0) << ", es: " << m(22.0) << ", e_counts_to: table, transition: cubic}\n"
        << "gates: {count: 32, measuring_place: " << m(10.0) << "}\n";
    const Outcome outcome = glissade_run({"gates", (place / "hill.yaml").string()});
    REQUIRE(outcome.exit_code == 0);
    std::istringstream lines(outcome.output);
    std::vector<double> to_edge;
    for (std::string line; std::getline(lines, line);) {
      std::istringstream row(line);
      int gate = 0;
      double distance = 0.0;
      if (row >> gate >> distance) to_edge.push_back(distance);
    }
    REQUIRE(to_edge.size() == 32);
    const double apart = scale * 22.0 / 31.0;
    for (std::size_t i = 1; i < to_edge.size(); ++i) {
      CHECK(to_edge[i] - to_edge[i - 1] == Approx(apart).epsilon(0.1));
    }
    CHECK_THAT(outcome.output, Contains("to edge [m]"));
  }
}

TEST_CASE("the table of gates tells y on a track that is turned in plan, as its JSON and CSV do") {
  const TempDir place;
  for (const double azimuth : {0.0, 37.0, 90.0, 180.0, -120.0}) {
    CAPTURE(azimuth);
    const std::string turn = "track.azimuth=" + nlohmann::json(azimuth).dump() + " deg";
    const auto gates = [&](std::vector<std::string> more) {
      more.insert(more.begin(), {"gates", shipped("hills/garmisch_hs142"), "--set", turn});
      const Outcome outcome = glissade_run(more, {place.path(), {}, {}});
      REQUIRE(outcome.exit_code == 0);
      return outcome.output;
    };
    const std::string text = gates({});
    const auto list = nlohmann::json::parse(gates({"--json"}))["gates"];
    const bool turned = azimuth != 0.0 && azimuth != 180.0;
    CHECK((text.find(" y [m]") != std::string::npos) == turned);
    std::istringstream lines(text);
    std::size_t rows = 0;
    for (std::string line; std::getline(lines, line);) {
      std::istringstream row(line);
      int gate = 0;
      double to_edge = 0.0;
      std::array<double, 3> at{};
      if (!(row >> gate >> to_edge >> at[0])) continue;
      if (turned) row >> at[1];
      row >> at[2];
      const auto& told = list.at(rows++);
      CHECK(told["gate"] == gate);
      constexpr double kShown = 0.0051;  // two decimals
      CHECK(std::fabs(told["x_m"].get<double>() - at[0]) < kShown);
      CHECK(std::fabs(told["y_m"].get<double>() - at[1]) < kShown);
      CHECK(std::fabs(told["z_m"].get<double>() - at[2]) < kShown);
    }
    CHECK(rows == 49);
  }
}

TEST_CASE("where neither a file nor standard output can be written both are told") {
  const TempDir place;
  RunLimits limits;
  limits.directory = place.path();
  limits.output_to = "/dev/full";
  std::filesystem::create_directory(place / "taken");
  for (const auto& [command, design] : {std::pair{"solve", "grain_chute"},
                                        {"compare", "grain_chute"},
                                        {"rules", "hills/garmisch_redesign"}}) {
    CAPTURE(command);
    const Outcome outcome = glissade_run({command, shipped(design), "--csv", "taken"}, limits);
    CHECK(outcome.exit_code == 5);
    CHECK_THAT(outcome.errors, Contains("glissade: error: standard output: ") &&
                                   Contains("glissade: error: taken: ") && !Contains("is written") &&
                                   !Contains("are written"));
  }
}

TEST_CASE("a pipe or device takes no file, by whatever name it goes") {
  for (const std::string& name : {std::string("/dev/stdout"), std::string("/dev/null")}) {
    const Outcome outcome = run_program("/bin/sh", {"-c", R"("$0" solve "$1" --csv "$2" | cat)",
                                                    glissade_program(), shipped("grain_chute"), name});
    CHECK_THAT(outcome.errors, Contains(name + ": cannot write: not a regular file\n") &&
                                   Contains("Try: the name of a file"));
  }
}

TEST_CASE("control characters of names, paths and cells are shown, not obeyed") {
  const TempDir place;
  RunLimits limits;
  limits.directory = place.path();
  const Outcome missing = glissade_run({"solve", "\x1b[31mred.yaml"}, limits);
  CHECK(missing.exit_code == 5);
  CHECK_THAT(missing.errors, StartsWith("glissade: error: <U+001B>[31mred.yaml: ") && !Contains("\x1b"));
  put_bytes(place / "points.csv", "name,x,z\nA,0,0\n\x1b[31mB,-1,0.5\n");
  const Outcome survey = glissade_run({"survey", shipped("hills/garmisch_hs142"), "points.csv"}, limits);
  CHECK(survey.exit_code == 5);
  CHECK_THAT(
      survey.errors,
      Contains("points.csv:3: column \"name\": there is a control character (U+001B) in \"<U+001B>[31mB\""));
}

TEST_CASE("a slip in a command or an option is answered with the one that was meant") {
  struct Slip {
    std::vector<std::string> arguments;
    std::string message;
  };
  const std::vector<Slip> cases = {
      {{"bild", "x.yaml"}, "there is no command bild\n      There are build, solve, "},
      {{"bild", "x.yaml"}, "Try: glissade build"},
      {{"--hlep"}, "glissade has no option --hlep\n      Try: glissade --help"},
      {{"solve", "--jsno"},
       "glissade solve has no option --jsno\n      Try: --json, or glissade solve --help"},
      {{"solve", "-dash.yaml"},
       "-dash.yaml is taken for an option\n      What begins with - is one, unless -- stands before it.\n"
       "      Try: ./-dash.yaml, or -- before it"},
      {{"build", "--jsno"}, "glissade build has no option --jsno"},
      {{"solve", "--firction-angle=11deg"}, "has no option --firction-angle\n      Try: --friction-angle"},
      {{"solve", "\u2014json"}, "\u2014json: it begins with a dash (U+2014), not with -"},
      {{"build", "a.yaml", "--csv", "b"}, "It belongs to "},
      {{"solve", "a.yaml", "b.yaml"}, "glissade solve does not know what to do with b.yaml"},
      {{"swim"}, "Try: glissade --help"},
      {{"build", "a.yaml", "-o", "a", "-o", "b"},
       "--output: it is given more than once\n      It takes one DIR."},
      {{"build", "a.yaml", "--output"}, "--output: no value is given\n      It takes DIR."},
      {{"build"}, "DESIGN.yaml is required"},
      {{"build", "--"}, "DESIGN.yaml is required"},
      {{"solve", "--", "a.yaml", "-q"}, "glissade solve does not know what to do with -q"},
  };
  CHECK(glissade_run({"solve", "--", "-dash.yaml"}).exit_code == 5);
  for (const Slip& slip : cases) {
    const Outcome outcome = glissade_run(slip.arguments);
    INFO(outcome.errors);
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.output.empty());
    CHECK_THAT(outcome.errors, StartsWith("glissade: error: ") && Contains(slip.message));
  }
}

TEST_CASE("an empty value, and - for a file, are refused by every option") {
  const std::string design = shipped("powder_chute");
  const std::vector<std::vector<std::string>> empty = {
      {"build", design, "-o", ""},
      {"plot", design, "--output", ""},
      {"compare", design, "--csv", ""},
      {"compare", design, "--html", ""},
      {"init", "-o", ""},
      {"solve", ""},
      {"solve", "--run", "", "--drop", "1", "--friction-coefficient", "0"}};
  for (const auto& arguments : empty) {
    const Outcome outcome = glissade_run(arguments);
    INFO(outcome.errors);
    CHECK(outcome.exit_code == 2);
    CHECK_THAT(outcome.errors, Contains("an empty text is given"));
  }
  for (const auto& arguments : std::vector<std::vector<std::string>>{
           {"compare", design, "--csv", "-"}, {"init", "-o", "-"}, {"build", design, "-o", "-"}}) {
    const Outcome outcome = glissade_run(arguments);
    CHECK(outcome.exit_code == 2);
    CHECK_THAT(outcome.errors, Contains("- is no name of a file"));
  }
  CHECK_THAT(glissade_run({"solve", "-"}).errors, Contains("Try: /dev/stdin"));
}

TEST_CASE("a closed standard output is called that") {
  RunLimits limits;
  limits.closes_output = true;
  const Outcome outcome = glissade_run({"init"}, limits);
  CHECK(outcome.exit_code == 5);
  CHECK_THAT(outcome.errors, Contains("standard output: it is closed") && !Contains("disk"));
}

TEST_CASE("a file never takes the place of a closed standard error") {
  const TempDir place;
  RunLimits limits;
  limits.closes_errors = true;
  const Outcome outcome = glissade_run(
      {"compare", shipped("powder_chute"), "--csv", (place / "c.csv").string(), "--verbose"}, limits);
  CHECK(outcome.exit_code == 0);
  std::ifstream file(place / "c.csv");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  CHECK_THAT(text, !Contains("finding") && !Contains("glissade:"));
}

TEST_CASE("what a command reads is not written over, nor one result by another") {
  const TempDir place;
  const std::string design = (place / "wall.yaml").string();
  const std::string profile = (place / "profile.csv").string();
  REQUIRE(glissade_run({"init", "points", "-o", design}).exit_code == 0);
  const std::string points = bytes_of(profile);
  const std::string words = bytes_of(design);
  const std::string around = (place / "." / "profile.csv").string();
  const std::vector<std::vector<std::string>> cases = {
      {"solve", design, "--csv", profile},          {"solve", design, "--csv", around},
      {"solve", design, "--frozen", design},        {"solve", "--csv", design, "--", design},
      {"compare", design, "--csv", profile},        {"survey", design, profile, "--csv", profile},
      {"survey", design, profile, "--svg", profile}};
  for (const auto& arguments : cases) {
    const Outcome outcome = glissade_run(arguments);
    INFO(outcome.errors);
    CHECK(outcome.exit_code == 2);
    CHECK_THAT(outcome.errors,
               Contains(" is read by this command, too\n      What it holds would be lost.\n"));
    CHECK(bytes_of(profile) == points);
    CHECK(bytes_of(design) == words);
  }
  const std::string result = (place / "result").string();
  CHECK_THAT(glissade_run({"solve", design, "--csv", result, "--frozen", result}).errors,
             Contains("--frozen: " + result + " is what --csv writes"));
  // A frozen design's table stands beside it.
  const std::string found = (place / "found.csv").string();
  const std::string frozen = (place / "found.yaml").string();
  const std::vector<std::string> run = {"solve", "--run", "3", "--drop", "2", "--friction-angle", "17deg"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), run.begin(), run.end());
    return glissade_run(more);
  };
  CHECK_THAT(with({"--csv", found, "--frozen", frozen}).errors,
             Contains("--frozen: " + found + " is what --csv writes"));
  CHECK_FALSE(std::filesystem::exists(found));
  std::ofstream(found) << "precious\n";
  const Outcome refused = with({"--frozen", frozen});
  CHECK(refused.exit_code == 2);
  CHECK_THAT(refused.errors, Contains(found + ": it is there, and no table of a frozen track"));
  CHECK(bytes_of(found) == "precious\n");
  CHECK_FALSE(std::filesystem::exists(frozen));
  std::filesystem::remove(found);
  CHECK(with({"--frozen", frozen}).exit_code == 0);
  // A result may replace an older one.
  CHECK(with({"--frozen", frozen}).exit_code == 0);
  CHECK(glissade_run({"solve", design, "--csv", result}).exit_code == 0);
  CHECK(glissade_run({"solve", design, "--csv", result}).exit_code == 0);
}

TEST_CASE("no file of a build takes the place of one that its design reads, by whatever path") {
  const TempDir place;
  const std::filesystem::path directory = place.path();
  constexpr const char* kSlab =
      "body: {friction_angle: 10 deg}\n"
      "cross_section: {kind: slab, width: 200 mm, thickness: 20 mm}\nmesh: {tolerance: 5 mm}\n";
  const std::string points = "x,z\n0,1.5\n1,0.7\n2,0.2\n3,0\n";
  const std::string drawn = std::string("glissade: 1\ntrack: {start: {x: 0 m, z: 2 m}}\n") + kSlab;
  const std::string between =
      std::string("glissade: 1\ntrack: {start: {x: 0 m, z: 2 m}, finish: {x: 3 m, z: 0.5 m}}\n") + kSlab;
  std::filesystem::create_directory(directory / "sub");
  std::filesystem::create_directory_symlink(directory, directory / "link");
  struct Case {
    std::string design;
    std::string text;
    std::string read;     ///< by the design
    std::string told_at;  ///< key with its place
    std::vector<std::string> command;
  };
  const std::vector<Case> cases = {
      {"p.yaml",
       drawn + "centerline: {kind: points, file: p.csv}\nexport: [stl, csv]\n",
       "p.csv",
       "p.yaml:6:34: centerline.file: ",
       {"build", "p.yaml", "-o", "."}},
      {"q.yaml",
       drawn + "centerline: {kind: points, file: sub/../q.csv}\nexport: [csv]\n",
       "q.csv",
       "q.yaml:6:34: centerline.file: ",
       {"build", "q.yaml", "-o", "link/sub/.."}},
      {"t.yaml",
       between + "limits: {stay_above: [{file: t.csv}]}\nexport: [stl, csv]\n",
       "t.csv",
       "t.yaml:6:30: limits.stay_above.0.file: ",
       {"build", "t.yaml", "-o", "."}},
      {"r.yaml",
       drawn + "centerline: {kind: points, file: r.coordinates.csv}\n",
       "r.coordinates.csv",
       "r.yaml:6:34: centerline.file: ",
       {"profile", "r.yaml", "-d", "."}},
      {"d.yaml",
       drawn + "centerline: {kind: points, file: d.report.html}\nexport: [stl]\n",
       "d.report.html",
       "d.yaml:6:34: centerline.file: ",
       {"build", "d.yaml", "-o", "."}},
      {"s.csv", between + "export: [csv]\n", "s.csv", "s.csv: the design: ", {"build", "s.csv", "-o", "."}}};
  for (const Case& item : cases) {
    const std::string held = item.read == item.design ? item.text : points;
    put_bytes(directory / item.read, held);
    put_bytes(directory / item.design, item.text);
    const std::vector<std::string> before = place.names();
    const Outcome outcome = glissade_run(item.command, {directory, {}, {}});
    INFO(outcome.errors);
    CHECK(outcome.exit_code == 2);
    CHECK_THAT(outcome.errors,
               Contains(item.told_at) && Contains(item.read + " is read by this command, too") &&
                   Contains("Try: another directory with " + item.command[2] + ", or another name for"));
    CHECK(bytes_of(directory / item.read) == held);
    CHECK(place.names() == before);
  }
  // Elsewhere all of these are built.
  const Outcome elsewhere = glissade_run({"build", "t.yaml", "-o", "out"}, {directory, {}, {}});
  INFO(elsewhere.errors);
  CHECK(elsewhere.exit_code == 0);
}

TEST_CASE(
    "a build reads neither what it wrote itself nor what is frozen in its own place, and removes neither") {
  const TempDir place;
  const std::filesystem::path directory = place.path();
  const std::string body =
      "body: {friction_angle: 10 deg}\ncross_section: {kind: slab, width: 200 mm, thickness: 20 mm}\n"
      "mesh: {tolerance: 5 mm}\n";
  const std::string first = "glissade: 1\ntrack: {start: {x: 0 m, z: 2 m}, finish: {x: 3 m, z: 0.5 m}}\n" +
                            body + "export: [csv]\n";
  put_bytes(directory / "x.yaml", first);
  const auto run = [&](const std::vector<std::string>& arguments) {
    return glissade_run(arguments, {directory, {}, {}});
  };
  REQUIRE(run({"solve", "x.yaml", "--frozen", "found.yaml"}).exit_code == 0);
  const std::string table = bytes_of(directory / "found.csv");
  const Outcome frozen = run({"build", "found.yaml", "-o", "."});
  CHECK(frozen.exit_code == 2);
  CHECK_THAT(frozen.errors,
             Contains("centerline.file: ") && Contains("found.csv is read by this command, too"));
  CHECK(bytes_of(directory / "found.csv") == table);

  REQUIRE(run({"build", "x.yaml", "-o", "."}).exit_code == 0);
  const std::string stations = bytes_of(directory / "x.csv");
  const std::string again =
      "glissade: 1\ntrack: {start: {x: 0 m, z: 2 m}}\n" + body +
      "centerline: {kind: points, file: x.csv, columns: [run_m, z_m, slope_angle_deg, curvature_per_m]}\n";
  put_bytes(directory / "x.yaml", again + "export: [csv]\n");
  CHECK(run({"build", "x.yaml", "-o", "."}).exit_code == 2);
  CHECK(bytes_of(directory / "x.csv") == stations);
  // It is no file of an earlier build that goes because this one has none of its name.
  put_bytes(directory / "x.yaml", again + "export: [stl]\n");
  const Outcome kept = run({"build", "x.yaml", "-o", "."});
  INFO(kept.errors);
  CHECK(kept.exit_code == 0);
  CHECK(bytes_of(directory / "x.csv") == stations);
}

TEST_CASE(
    "the page of a sweep takes the place of no file that it reads, nor does anything that of a set of "
    "rules") {
  const TempDir place;
  const std::filesystem::path directory = place.path();
  const auto run = [&](const std::vector<std::string>& arguments) {
    return glissade_run(arguments, {directory, {}, {}});
  };
  put_bytes(directory / "sweep.html", "body.friction_angle\n10 deg\n12 deg\n");
  put_bytes(directory / "rules.yaml",
            "glissade_rules: 1\nname: own\ntitle: Own\n"
            "rules: [{id: a, sentence: s, quantity: run, highest: 9 m, source: s, certainty: own}]\n");
  put_bytes(directory / "d.yaml",
            "glissade: 1\ntrack: {start: {x: 0 m, z: 2 m}, finish: {x: 3 m, z: 0.5 m}}\n"
            "body: {friction_angle: 10 deg}\nrules: {sets: [rules.yaml]}\n");
  const Outcome swept = run({"sweep", "d.yaml", "--points", "sweep.html", "-o", "."});
  CHECK(swept.exit_code == 2);
  CHECK_THAT(swept.errors, Contains("--output: ") && Contains("sweep.html is read by this command, too"));
  CHECK_FALSE(std::filesystem::exists(directory / "manifest.json"));
  const std::string rules = bytes_of(directory / "rules.yaml");
  const Outcome outcome = run({"solve", "d.yaml", "--csv", "rules.yaml"});
  INFO(outcome.errors);
  CHECK(outcome.exit_code == 2);
  CHECK_THAT(outcome.errors, Contains("--csv: rules.yaml is read by this command, too"));
  CHECK(bytes_of(directory / "rules.yaml") == rules);
}

TEST_CASE("what a sweep has left is not written over by its own table") {
  const TempDir place;
  const std::string design = (place / "d.yaml").string();
  std::ofstream(design) << "glissade: 1\ntrack: {start: {x: 0 m, z: 2 m}, finish: {x: 3 m, z: 0 m}}\n"
                           "body: {friction_angle: 17 deg}\n";
  const std::string sweep = (place / "sw").string();
  REQUIRE(
      glissade_run({"sweep", design, "--vary", "body.friction_angle=10deg:20deg:5", "-o", sweep}).exit_code ==
      0);
  for (const std::string& file : {sweep + "/manifest.json", sweep + "/chunks/000000.csv"}) {
    const std::string before = bytes_of(file);
    const Outcome outcome = glissade_run({"sweep", "--merge", sweep, "-o", file});
    CHECK(outcome.exit_code == 2);
    CHECK_THAT(outcome.errors, Contains("--output: " + file + " is read by this command, too"));
    CHECK(bytes_of(file) == before);
  }
  const std::string before = bytes_of(design);
  const Outcome over_design = glissade_run({"sweep", "--merge", sweep, "-o", design});
  CHECK(over_design.exit_code == 2);
  CHECK_THAT(over_design.errors, Contains("--output: " + design + " has the name of a file that was swept"));
  const std::string points = (place / "points.csv").string();
  put_bytes(points, "body.friction_angle\n11 deg\n12 deg\n");
  const std::string tried = (place / "tried").string();
  REQUIRE(glissade_run({"sweep", design, "--points", points, "-o", tried}).exit_code == 0);
  const Outcome over_points = glissade_run({"sweep", "--merge", tried, "-o", points});
  CHECK(over_points.exit_code == 2);
  CHECK_THAT(over_points.errors, Contains("--output: " + points + " has the name of a file that was swept"));
  CHECK(bytes_of(points).starts_with("body.friction_angle\n"));
  CHECK(bytes_of(design) == before);
  CHECK(glissade_run({"sweep", "--merge", sweep, "-o", sweep + "/table.csv"}).exit_code == 0);
}

TEST_CASE("options that would change nothing are refused, with why") {
  struct Pair {
    std::vector<std::string> arguments;
    std::string option;
  };
  const std::string design = shipped("grain_chute");
  const std::string hill = shipped("hills/garmisch_hs142");
  const std::vector<Pair> pairs = {
      {{"rules", "--csv", "zz.csv"}, "--csv"},
      {{"rules", "slide", "--set", "a=b"}, "--set"},
      {{"rules", "slide", "--time-budget", "3s"}, "--time-budget"},
      {{"rules", "slide", "--quantities"}, "WORD"},
      {{"rules", "--quantities", "--csv", "zz.csv"}, "--csv"},
      {{"gates", hill, "--json", "--speed", "25"}, "--speed"},
      {{"gates", hill, "--json", "--slopes"}, "--slopes"},
      {{"init", "chute", "--force"}, "--force"},
      {{"rewrite", design, "--force"}, "--force"},
      {{"redesign", hill, "--letters"}, "--letters"},
      {{"sweep", "--merge", "s", "-o", "s.csv", "--frozen"}, "--frozen"},
      {{"sweep", design, "--vary", "mesh.tolerance=1mm,2mm", "--tasks", "2"}, "--tasks"},
      {{"sweep", design, "--vary", "mesh.tolerance=1mm,2mm", "--seed", "2"}, "--seed"},
      {{"sweep", design, "--vary", "mesh.tolerance=1mm,2mm", "--slurm", "--jobs", "2"}, "--jobs"},
  };
  for (const Pair& pair : pairs) {
    const TempDir place;
    const Outcome outcome = glissade_run(pair.arguments, {place.path(), {}, {}});
    CAPTURE(pair.arguments);
    CHECK(outcome.exit_code == 2);
    CHECK_THAT(outcome.errors, Contains(pair.option) && Contains("it changes nothing") && Contains("Try: "));
    CHECK(place.names().empty());
  }
}

TEST_CASE("numbers of sweep are whole, and within their bounds") {
  const std::vector<std::string> scatter = {"sweep",     shipped("grain_chute"),
                                            "--scatter", "body.friction_angle=uniform(16deg,18deg)",
                                            "--samples", "4"};
  for (const auto& [option, value] : std::vector<std::pair<std::string, std::string>>{
           {"--seed", "-1"}, {"--jobs", "-1"}, {"--jobs", "65537"}, {"--jobs", "1.5"}, {"--seed", "x"}}) {
    const TempDir place;
    std::vector<std::string> arguments = scatter;
    arguments.insert(arguments.end(), {option, value});
    const Outcome outcome = glissade_run(arguments, {place.path(), {}, {}});
    CAPTURE(option, value);
    CHECK(outcome.exit_code == 2);
    CHECK_THAT(outcome.errors, StartsWith("glissade: error: " + option + ": '" + value + "' is ") &&
                                   Contains("It lies between 0 and"));
    CHECK(place.names().empty());
  }
}

TEST_CASE("what rules may bound comes as JSON where that is asked for") {
  const Outcome outcome = glissade_run({"rules", "--quantities", "--json"});
  CHECK(outcome.exit_code == 0);
  const nlohmann::json document = nlohmann::json::parse(outcome.output);
  CHECK(document.at("quantities").size() > 20);
  for (const auto& quantity : document.at("quantities")) {
    CHECK(quantity.at("quantity").is_string());
    CHECK((quantity.at("of") == "track" || quantity.at("of") == "fabrication"));
    CHECK(quantity.contains("unit"));
    CHECK(!quantity.at("meaning").get<std::string>().empty());
  }
}

TEST_CASE("a value that an option cannot take is told as all errors are") {
  const Outcome outcome = glissade_run({"build", "b.yaml", "--json=x"});
  CHECK(outcome.exit_code == 2);
  CHECK(outcome.errors ==
        "glissade: error: --json: it cannot take x\n      It takes no value.\n      Try: --json alone\n");
}

TEST_CASE("profile on a full disk names the file that was asked for, and leaves nothing behind") {
  const TempDir place;
  RunLimits limits;
  limits.directory = place.path();
  limits.largest_file = 2000;
  const Outcome outcome = glissade_run({"profile", shipped("hills/garmisch_hs142"), "-d", "out"}, limits);
  CHECK(outcome.exit_code == 5);
  CHECK_THAT(outcome.errors,
             Contains("out/garmisch_hs142.section.dxf: cannot write") && !Contains(".glissade-"));
  CHECK(place.names().empty());
}

TEST_CASE("where one of several files cannot be written, none of them is") {
  const TempDir place;
  RunLimits limits;
  limits.directory = place.path();
  std::filesystem::create_directory(place / "taken.svg");
  std::filesystem::create_directory(place / "profile.csv");
  const std::string hill = shipped("hills/garmisch_hs142");
  const std::string points = std::filesystem::path(hill).parent_path() / "garmisch_survey.csv";
  const std::vector<std::vector<std::string>> commands = {
      {"solve", shipped("grain_chute"), "--csv", "a.csv", "--frozen", "none/b.yaml"},
      {"survey", hill, points, "--offset", "120mm", "--csv", "a.csv", "--svg", "taken.svg"},
      {"compare", shipped("grain_chute"), "--svg", "a.svg", "--html", "a.html", "--csv", "none/a.csv"},
      {"init", "points", "--force", "-o", "a.yaml"}};
  for (const std::vector<std::string>& command : commands) {
    INFO(command[0]);
    CHECK(glissade_run(command, limits).exit_code == 5);
    CHECK(place.names() == std::vector<std::string>{"profile.csv", "taken.svg"});
  }
}

TEST_CASE("no file takes the place of the one that standard output goes to") {
  const TempDir place;
  const std::string output = (place / "o.txt").string();
  put_bytes(output, "");
  for (const std::string& name : {std::string("/dev/stdout"), output}) {
    RunLimits limits;
    limits.output_to = output;
    const Outcome outcome = glissade_run({"solve", shipped("grain_chute"), "--csv", name}, limits);
    CHECK(outcome.exit_code == 2);
    CHECK_THAT(outcome.errors, Contains("--csv: " + name + " is where standard output goes"));
    CHECK(place.names() == std::vector<std::string>{"o.txt"});
  }
}

TEST_CASE("fit: speeds that tell nothing are told with their file, one that is wrong with its line") {
  const TempDir place;
  const std::string hill = shipped("hills/garmisch_hs142");
  const auto told = [&](const std::string& rows, const std::string& design) {
    put_bytes(place / "speeds.csv", "gate,speed_km_h\n" + rows);
    const Outcome outcome = glissade_run({"fit", (place / "speeds.csv").string(), design});
    CHECK(outcome.exit_code == 2);
    return outcome.errors;
  };
  CHECK_THAT(told("1,85\n1,85\n1,85\n", hill),
             Contains("speeds.csv: these speeds do not tell friction and drag apart"));
  CHECK_THAT(told("1,85\n", hill), Contains("speeds.csv: 1 speed does not tell 2 parameters"));
  CHECK_THAT(told("1,85\n1,860\n", hill),
             Contains("speeds.csv:3: Garmisch") && Contains("is more than free fall gives"));
  // Fitted it comes down, as it was designed it does not.
  std::string rough = bytes_of(hill);
  const std::string friction = "friction_coefficient: ";
  const std::size_t at = rough.find(friction) + friction.size();
  put_bytes(place / "rough.yaml", rough.replace(at, rough.find_first_of(",}\n", at) - at, "0.9"));
  CHECK_THAT(told("1,85\n20,88\n49,92\n", (place / "rough.yaml").string()),
             Contains("speeds.csv:2: Garmisch") && Contains("does not come to where its speed was measured"));
}

TEST_CASE("fit: a friction that changes along the track is told as that") {
  const TempDir place;
  put_bytes(
      place / "a.yaml",
      "glissade: 1\ntrack: {start: {x: 0 m, z: 0 m}}\n"
      "body: {drag: 0.001 1/m, friction: [{from: 0 m, coefficient: 0.02}, {from: 50 m, coefficient: 0.2}]}\n"
      "centerline: {kind: segments, entry_slope_angle: 35 deg, segments: [{length: 100 m}]}\n");
  put_bytes(place / "speeds.csv",
            "design,length_m,speed_m_per_s,before_edge_m\na.yaml,100,25,0\na.yaml,60,20,0\n");
  const Outcome text = glissade_run({"fit", (place / "speeds.csv").string()});
  INFO(text.errors);
  CHECK_THAT(text.output, Contains("friction as each design has it along its track, drag 0.001 1/m"));
  const auto told =
      nlohmann::json::parse(glissade_run({"fit", (place / "speeds.csv").string(), "--json"}).output);
  CHECK(told["design_friction_coefficient"] == nullptr);
}

TEST_CASE(
    "survey: points that tell nothing are told with their file, one that lies elsewhere with its line") {
  const TempDir place;
  const auto told = [&](const std::string& rows) {
    put_bytes(place / "points.csv", "name,x,z\n" + rows);
    const Outcome outcome =
        glissade_run({"survey", shipped("hills/garmisch_hs142"), (place / "points.csv").string()});
    CHECK(outcome.exit_code == 2);
    return outcome.errors;
  };
  CHECK_THAT(told("P1,-90,47\n"), Contains("points.csv: 1 point makes no survey"));
  CHECK_THAT(told("P1,-90,47\n,-80,90\nP3,-70,35\nP4,-60,80\nP5,-50,21\n"),
             Contains("points.csv:3: the point lies ") && Contains("points.csv:5: the point P4 lies "));
  const std::string same = "P,-90.1894,47.0825\n";
  CHECK_THAT(told(same + same + same + same + same), Contains("points.csv: 1 point makes no survey") &&
                                                         Contains("Readings of one place are one point."));
}

TEST_CASE(
    "fit: friction and drag that are well known go together without a word that nothing tells them apart") {
  const TempDir place;
  struct Straight {
    const char* name;
    int slope_deg;
    int length;
    const char* whole;
    const char* half;
  };
  // Friction 0.05 and drag 0.002 1/m, read to a few centimetres a second.
  std::string speeds = "design,length_m,speed_m_per_s,before_edge_m\n";
  for (const Straight& one : {Straight{"a", 30, 60, "21.897", "15.957"},
                              {"b", 20, 80, "19.940", "14.563"},
                              {"c", 40, 30, "18.401", "13.163"},
                              {"d", 25, 120, "26.508", "19.901"}}) {
    put_bytes(place / (std::string(one.name) + ".yaml"),
              "glissade: 1\ntrack: {start: {x: 0 m, z: 0 m}}\nbody: {friction_coefficient: 0.03, drag: "
              "0.0013 1/m}\n"
              "centerline: {kind: segments, entry_slope_angle: " +
                  std::to_string(one.slope_deg) + " deg, segments: [{length: " + std::to_string(one.length) +
                  " m}]}\n");
    speeds += std::string(one.name) + ".yaml," + std::to_string(one.length) + "," + one.whole + ",0\n";
    speeds += std::string(one.name) + ".yaml," + std::to_string(one.length / 2) + "," + one.half + ",0\n";
  }
  put_bytes(place / "speeds.csv", speeds);
  const Outcome outcome = glissade_run({"fit", (place / "speeds.csv").string()});
  INFO(outcome.output << outcome.errors);
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.output,
             Contains(" between friction and drag") && !Contains("hardly tell the two apart"));
}

TEST_CASE("what cannot be written into a directory is advised another one by the command's own option") {
  const TempDir place;
  put_bytes(place / "file", "");
  const std::vector<std::vector<std::string>> commands = {
      {"build", shipped("grain_chute"), "-o"},
      {"profile", shipped("hills/garmisch_hs142"), "-d"},
      {"sweep", shipped("grain_chute"), "--vary", "body.friction_angle=10deg:12deg:3", "-o"},
      {"sweep", shipped("grain_chute"), "--slurm", "--vary", "body.friction_angle=10deg:12deg:3", "-o"},
      {"help", "--man-pages"}};
  for (std::vector<std::string> command : commands) {
    const std::string option = command.back();
    // Below a file there is no directory, and a file is none.
    for (const char* const path : {"file/below", "file"}) {
      std::vector<std::string> arguments = command;
      arguments.push_back((place / path).string());
      const Outcome outcome = glissade_run(arguments);
      INFO(command.front() << " " << option << " " << path << "\n" << outcome.errors);
      CHECK(outcome.exit_code == 5);
      CHECK_THAT(outcome.errors, Contains("file") && Contains("Try: another directory with " + option));
      // No other option is named than those that there are.
      const Outcome help = glissade_run({command.front(), "--help"});
      CHECK_THAT(help.output, Contains(option));
    }
  }
}
