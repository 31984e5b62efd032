#include "cli/glissade.hpp"
#include "support/catch.hpp"
#include "support/temp_dir.hpp"

#include <algorithm>
#include <string>

#include <nlohmann/json.hpp>

using Catch::Matchers::Contains;
using nlohmann::json;

namespace {

/// A tetrahedron of volume 1/6 with one corner at the origin, in millimetres; the last facet may be left out.
std::string tetrahedron(bool closed) {
  return std::string("OFF\n4 ") + (closed ? "4" : "3") +
         " 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n" + (closed ? "3 1 2 3\n" : "");
}

/// Header and facet count of a binary STL file without its facets.
std::string binary_stl(std::uint32_t facets) {
  std::string bytes(80, ' ');
  for (int shift = 0; shift < 32; shift += 8)
    bytes += static_cast<char>(facets >> static_cast<unsigned>(shift));
  return bytes;
}

Outcome inspected(const std::string& bytes, const std::string& name) {
  const TempDir place;
  put_bytes(place / name, bytes);
  return glissade_run({"inspect", (place / name).string()});
}

}  // namespace

TEST_CASE("inspect of a sound mesh ends with 0 and tells its facts") {
  const TempDir place;
  put_bytes(place / "corner.off", tetrahedron(true));
  const Outcome outcome = glissade_run({"inspect", (place / "corner.off").string(), "--json"});
  CHECK(outcome.exit_code == 0);
  const json facts = json::parse(outcome.output);
  CHECK(facts["valid"] == true);
  CHECK(facts["watertight"] == true);
  CHECK(facts["triangles"] == 4);
  CHECK(facts["self_intersections"] == 0);
  CHECK(facts["euler_characteristic"] == 2);
  CHECK(facts["volume_m3"].get<double>() == Approx(1e-9 / 6.0));
  const Outcome metres = glissade_run({"inspect", (place / "corner.off").string(), "--json", "--unit", "m"});
  CHECK(json::parse(metres.output)["volume_m3"].get<double>() == Approx(1.0 / 6.0));
}

TEST_CASE("inspect of an open mesh ends with 1 and names the fault") {
  const Outcome outcome = inspected(tetrahedron(false), "open.off");
  CHECK(outcome.exit_code == 1);
  CHECK(outcome.errors.empty());
  CHECK_THAT(
      outcome.output,
      Contains("faulty") && Contains("3 edges with one facet only: the surface is open; the first at ("));
}

TEST_CASE("inspect of a broken file ends with 5 and says where") {
  struct Broken {
    std::string name;
    std::string bytes;
    std::string message;
  };
  const std::vector<Broken> cases = {
      {"empty.stl", "", "empty"},
      {"noise.stl", "hello", ""},
      {"truncated.stl", binary_stl(1) + std::string(20, '\0'), ""},
      {"absurd.stl", binary_stl(4'000'000'000U) + std::string(50, '\0'), "4000000000"},
      {"nan.off", "OFF\n3 1 0\n0 0 0\nnan 0 0\n0 1 0\n3 0 1 2\n", "nan"},
      {"truncated.off", "OFF\n4 4 0\n0 0 0\n1 0 0\n", ""},
      {"speck.off", "OFF\n3 1 0\n0 0 0\n1e-299 0 0\n0 1e-299 0\n3 0 1 2\n", "too small to be measured"},
      {"absurd.off", "OFF\n99999999999 1 0\n0 0 0\n", "99999999999"},
  };
  for (const Broken& broken : cases) {
    const Outcome outcome = inspected(broken.bytes, broken.name);
    INFO(broken.name);
    INFO(outcome.errors);
    CHECK(outcome.exit_code == 5);
    CHECK(outcome.output.empty());
    CHECK_THAT(outcome.errors, Contains(broken.name) && Contains(broken.message));
  }
}

TEST_CASE("inspect tells a volume in the unit that suits its size") {
  for (const auto& [side, volume] :
       std::vector<std::pair<std::string, std::string>>{{"0.1", "0.000166667 mm^3"},
                                                        {"5", "20.8333 mm^3"},
                                                        {"30", "4.5 cm^3"},
                                                        {"100", "0.166667 litres"},
                                                        {"3000", "4.5 m^3"}}) {
    const std::string corners = "0 0 0\n" + side + " 0 0\n0 " + side + " 0\n0 0 " + side + "\n";
    const Outcome outcome =
        inspected("OFF\n4 4 0\n" + corners + "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n", "corner.off");
    INFO(outcome.output);
    CHECK_THAT(outcome.output, Contains(" " + volume + "\n"));
  }
}

TEST_CASE("inspect of a file that is not there ends with 5") {
  const Outcome outcome = glissade_run({"inspect", "no-such-file.stl"});
  CHECK(outcome.exit_code == 5);
  CHECK_THAT(outcome.errors, Contains("no-such-file.stl") && Contains("No such file"));
}

TEST_CASE(
    "rules of a design with a fabrication are those of the shop, too; one that a part breaks is the exit "
    "code") {
  const std::string design = shipped("grain_chute_fabricated");
  const Outcome kept = glissade_run({"rules", design, "-q"});
  CHECK(kept.exit_code == 0);
  CHECK_THAT(kept.output, Contains("rule of the shop") && Contains("plate.hole-edge"));
  // What finds no place is no matter of rules, but of warnings.
  CHECK_THAT(
      kept.errors,
      Contains("glissade: warning: ") &&
          Contains(
              "spacing: the track sticks out by 1.37 m above support 1, at 1.375 m along it, for 950 mm, "
              "half of 1.9 m\n") &&
          Contains("a trestle stands below no more than 60 deg (steepest).\n") &&
          Contains("Try: spacing: 2.77 m, a larger steepest, or a support of your own"));
  const Outcome broken =
      glissade_run({"rules", design, "-q", "--json", "--set",
                    "fabrication.rules={own: [{id: our.crane, sentence: Our crane lifts 5 kg., "
                    "quantity: part_mass, highest: 5 kg, source: its plate}]}"});
  CHECK(broken.exit_code == 1);
  const json verdicts = json::parse(broken.output);
  CHECK(verdicts["rules"].empty());
  const auto found = std::find_if(verdicts["shop_checks"].begin(), verdicts["shop_checks"].end(),
                                  [](const json& check) { return check["rule"] == "our.crane"; });
  REQUIRE(found != verdicts["shop_checks"].end());
  CHECK((*found)["verdict"] == "fail");
  CHECK((*found)["bound"] == "at most 5 kg");
}
