#include "glissade/design/design.hpp"
#include "glissade/design/template.hpp"

#include "cli/glissade.hpp"
#include "support/catch.hpp"
#include "support/temp_dir.hpp"

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
