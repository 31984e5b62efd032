#include "glissade/design/design.hpp"
#include "glissade/design/template.hpp"

#include "cli/glissade.hpp"
#include "support/catch.hpp"
#include "support/temp_dir.hpp"

#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>

using Catch::Matchers::Contains;

TEST_CASE("init prints a design that build accepts") {
  const TempDir place;
  const Outcome printed = glissade_run({"init"});
  REQUIRE(printed.exit_code == 0);
  put_bytes(place / "chute.yaml", printed.output);
  const Outcome built = glissade_run({"build", "chute.yaml", "-q"}, {place.path(), {}, {}});
  CHECK(built.errors.empty());
  CHECK(built.output.empty());
  CHECK(built.exit_code == 0);
  CHECK(std::filesystem::exists(place / "out/chute/chute.stl"));
}

TEST_CASE("every kind of init reads as a design") {
  const TempDir place;
  for (const glissade::DesignTemplate& entry : glissade::design_templates()) {
    const std::string kind(entry.kind);
    const std::string file = (place / (kind + ".yaml")).string();
    const Outcome outcome = glissade_run({"init", kind, "-o", file});
    INFO(kind);
    INFO(outcome.errors);
    CHECK(outcome.exit_code == 0);
    CHECK_NOTHROW(glissade::read_design(file));
    const Outcome solved = glissade_run({"solve", file});
    INFO(solved.errors);
    CHECK(solved.exit_code == 0);
  }
}

TEST_CASE("init puts the schema that a design names beside it, as schema prints it") {
  const TempDir place;
  REQUIRE(glissade_run({"init", "-o", (place / "chute.yaml").string()}).exit_code == 0);
  CHECK(bytes_of(place / "chute.yaml").starts_with("# yaml-language-server: $schema=glissade.schema.json\n"));
  const Outcome schema = glissade_run({"schema"});
  CHECK(schema.exit_code == 0);
  CHECK(bytes_of(place / "glissade.schema.json") == schema.output);
  CHECK(nlohmann::json::parse(schema.output)["$schema"] == "http://json-schema.org/draft-07/schema#");
}

TEST_CASE("init never writes over a file unless it is told to") {
  const TempDir place;
  const std::string file = (place / "chute.yaml").string();
  put_bytes(file, "my work");
  const Outcome refused = glissade_run({"init", "-o", file});
  CHECK(refused.exit_code == 5);
  CHECK_THAT(refused.errors, Contains("the file exists already") && Contains("--force"));
  CHECK(bytes_of(file) == "my work");
  CHECK(glissade_run({"init", "-o", file, "--force"}).exit_code == 0);
  CHECK_THAT(bytes_of(file), Contains("glissade: 1"));
}

TEST_CASE("init of an unknown kind names those that there are") {
  const Outcome outcome = glissade_run({"init", "rollercoaster"});
  CHECK(outcome.exit_code == 2);
  CHECK_THAT(outcome.errors,
             Contains("rollercoaster") && Contains(std::string(glissade::design_templates().back().kind)));
}

TEST_CASE("init of points comes with a profile that build, solve and compare accept, its deviation told") {
  const TempDir place;
  const RunLimits here{place.path(), {}, {}};
  REQUIRE(glissade_run({"init", "points", "-o", "wall.yaml"}, here).exit_code == 0);
  CHECK(std::filesystem::exists(place / "profile.csv"));
  const Outcome built = glissade_run({"build", "wall.yaml"}, here);
  INFO(built.errors);
  CHECK(built.exit_code == 0);
  CHECK_THAT(built.output, Contains("fitted to 11") && Contains("passes them by") && Contains("run 2 m"));
  const nlohmann::json solved =
      nlohmann::json::parse(glissade_run({"solve", "wall.yaml", "--json"}, here).output);
  CHECK(solved["profile"]["points"] == 11);
  CHECK(solved["profile"]["max_deviation_m"].get<double>() < 1e-9);
  CHECK(solved["run_m"].get<double>() == Approx(2.0).epsilon(1e-9));
  CHECK(solved["drop_m"].get<double>() == Approx(1.9).epsilon(1e-9));
  // The other kinds lead to where the profile ends.
  const nlohmann::json compared =
      nlohmann::json::parse(glissade_run({"compare", "wall.yaml", "--json"}, here).output);
  REQUIRE(compared["tracks"].size() == 6);
  for (const nlohmann::json& track : compared["tracks"]) {
    INFO(track.dump());
    CHECK(track["problem"].is_null());
    CHECK(track["run_m"].get<double>() == Approx(2.0).epsilon(1e-9));
  }
}

TEST_CASE("init of points to standard output says that the profile is not written with it") {
  const Outcome printed = glissade_run({"init", "points"});
  CHECK(printed.exit_code == 0);
  CHECK_THAT(printed.errors,
             Contains("reads profile.csv beside it, which is not written") && Contains("-o FILE"));
  CHECK(glissade_run({"init", "segments"}).errors.empty());
}

TEST_CASE("init of points writes both files or none") {
  const TempDir place;
  put_bytes(place / "profile.csv", "my measurements");
  const Outcome refused = glissade_run({"init", "points", "-o", "wall.yaml"}, {place.path(), {}, {}});
  CHECK(refused.exit_code == 5);
  CHECK_THAT(refused.errors, Contains("profile.csv: the file exists already"));
  CHECK_FALSE(std::filesystem::exists(place / "wall.yaml"));
  CHECK(bytes_of(place / "profile.csv") == "my measurements");
}

TEST_CASE("a design is not written where its own profile goes") {
  const TempDir place;
  const Outcome outcome = glissade_run({"init", "points", "-o", "./profile.csv"}, {place.path(), {}, {}});
  CHECK(outcome.exit_code == 2);
  CHECK_THAT(outcome.errors,
             Contains("--output: ./profile.csv is what the profile beside the design is called"));
  CHECK(place.names().empty());
}

TEST_CASE("a finish that is not where the profile ends is refused with both places") {
  const TempDir place;
  const RunLimits here{place.path(), {}, {}};
  REQUIRE(glissade_run({"init", "points", "-o", "wall.yaml"}, here).exit_code == 0);
  const auto with_finish = [&](const std::string& finish) {
    return glissade_run({"solve", "wall.yaml", "--set", "track.finish=" + finish}, here);
  };
  // The profile ends 2 m away and 1.9 m below its first point; the start is at a height of 2.4 m.
  CHECK(with_finish("{x: 2 m, z: 0.5 m}").exit_code == 0);
  CHECK(with_finish("{x: -1.2 m, y: 1.6 m, z: 0.5 m}").exit_code == 0);
  const Outcome refused = with_finish("{x: 2.1 m, z: 0.5 m}");
  CHECK(refused.exit_code == 2);
  CHECK_THAT(refused.errors, Contains("--set track.finish: the points miss the finish by 100 mm") &&
                                 Contains("end 2 m away") && Contains("the finish is 2.1 m away") &&
                                 Contains("Try: no finish"));
}

TEST_CASE("max_deviation makes a profile smoother, and no point is passed by more") {
  const TempDir place;
  const RunLimits here{place.path(), {}, {}};
  REQUIRE(glissade_run({"init", "points", "-o", "wall.yaml"}, here).exit_code == 0);
  const auto fitted = [&](const std::string& deviation) {
    const Outcome outcome = glissade_run(
        {"solve", "wall.yaml", "--json", "--set", "centerline.max_deviation=" + deviation}, here);
    INFO(outcome.errors);
    REQUIRE(outcome.exit_code == 0);
    return nlohmann::json::parse(outcome.output);
  };
  const nlohmann::json close = fitted("1 mm");
  const nlohmann::json smooth = fitted("5 mm");
  CHECK(close["profile"]["max_deviation_m"].get<double>() <= 1e-3 * (1.0 + 1e-9));
  CHECK(smooth["profile"]["max_deviation_m"].get<double>() <= 5e-3 * (1.0 + 1e-9));
  CHECK(smooth["profile"]["max_deviation_m"] > close["profile"]["max_deviation_m"]);
  const Outcome refused =
      glissade_run({"solve", "wall.yaml", "--set", "centerline.max_deviation=0 mm"}, here);
  CHECK(refused.exit_code == 2);
  CHECK_THAT(refused.errors, Contains("max_deviation: 0 mm is not positive"));
}

TEST_CASE("a profile that is no profile is refused with file, line and column") {
  const TempDir place;
  const RunLimits here{place.path(), {}, {}};
  REQUIRE(glissade_run({"init", "points", "-o", "wall.yaml"}, here).exit_code == 0);
  const auto refusal = [&](const std::string& text, int exit_code) {
    put_bytes(place / "profile.csv", text);
    const Outcome outcome = glissade_run({"solve", "wall.yaml"}, here);
    CHECK(outcome.exit_code == exit_code);
    return outcome.errors;
  };
  CHECK_THAT(refusal("x,z\n0,2\n1,nan\n2,0\n", 5), Contains("profile.csv:3:3: ") && Contains("nan"));
  CHECK_THAT(refusal("x,z\n0,2\n", 2), Contains("profile.csv: there is 1 point") && Contains("at least 3"));
  CHECK_THAT(refusal("x,z\n0,2\n1,1\n\n1,1\n2,0\n", 2), Contains("profile.csv:5: ") && Contains("repeats"));
  CHECK_THAT(refusal("x,z\n0,2\n2,1\n1,1.5\n3,0\n", 2),
             Contains("profile.csv:3: ") && Contains("turns back"));
  CHECK_THAT(refusal("It was a dark\nand stormy night\n", 5),
             Contains("profile.csv:1: ") && Contains("columns"));
  std::filesystem::remove(place / "profile.csv");
  CHECK(glissade_run({"solve", "wall.yaml"}, here).exit_code == 5);
}
