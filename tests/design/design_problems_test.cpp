#include "glissade/core/number_text.hpp"
#include "glissade/core/quantity.hpp"
#include "glissade/design/design.hpp"
#include "glissade/trades/rules.hpp"

#include "design/design_text.hpp"
#include "support/catch.hpp"

#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace design_problems_test {

using namespace glissade;
using namespace glissade::test;
using Catch::Matchers::Contains;
using Catch::Matchers::EndsWith;
using Catch::Matchers::StartsWith;

TEST_CASE("the design that the other tests break is sound") {
  CHECK(problems_of(kSoundDesign).empty());
}

TEST_CASE("an unknown key is refused where it stands, with the key that was meant") {
  CHECK(problems_with("wall_height", "wall_hight") ==
        "d.yaml:9:49: unknown key wall_hight\n"
        "      A cross_section of kind u-channel has the keys kind, width, wall_height and thickness.\n"
        "      Try: wall_height");
  CHECK_THAT(problems_with("name:", "nmae:"),
             Contains("d.yaml:2:1: unknown key nmae") && Contains("Try: name"));
  CHECK_THAT(problems_with("tolerance", "Tolerance"), Contains("Try: tolerance"));
}

TEST_CASE("a key of another kind is refused with the kind that has it") {
  CHECK_THAT(problems_with("thickness: 4 mm", "thickness: 4 mm, inner_diameter: 10 mm"),
             StartsWith("d.yaml:9:87: unknown key inner_diameter") && Contains("Try: kind: pipe"));
  CHECK_THAT(problems_with("{kind: fastest}", "{kind: fastest, p: 100 m^2/s^2}"),
             StartsWith("d.yaml:8:29: unknown key p") && Contains("Try: kind: constant-speed"));
  CHECK_THAT(problems_with("  friction_angle", "friction_angle"),
             Contains("d.yaml:7:1: unknown key friction_angle") && Contains("below body:"));
}

TEST_CASE("characters that cannot be told from plain ones are named where they do harm") {
  CHECK_THAT(
      problems_with("  friction_angle", "\u00a0\u00a0friction_angle"),
      Contains("d.yaml:7:1: unknown key <U+00A0><U+00A0>friction_angle: it begins with a no-break space "
               "(U+00A0)") &&
          Contains("Try: blanks before friction_angle"));
  CHECK_THAT(problems_with("friction_angle: 17", "friction_angle:\u00a017"),
             Contains("there is a no-break space (U+00A0) in it") && Contains("Try: friction_angle: 17 deg"));
  CHECK_THAT(problems_with("wall_height", "wall\u2011height"), Contains("it holds a hyphen (U+2011)"));
  CHECK_THAT(problems_with("fastest", "\u2018fastest\u2019"),
             Contains("it holds a curly quote (U+2018)") && Contains("Try: fastest"));
  // In names and comments they are welcome.
  CHECK(problems_with("name: Chute", "name: Rutsche \u2013 Silo\u00a03 # 11\u00a0\u00b0").empty());
}

TEST_CASE("a tab in the indentation is named where it stands") {
  CHECK(problems_with("  friction_angle", "\tfriction_angle") ==
        "d.yaml:7:1: not valid YAML: a tab indents this line\n"
        "      YAML indents with blanks alone.\n"
        "      Try: blanks instead of the tab");
  CHECK_THAT(problems_with("  start: {x", "  \tstart: {x"), Contains("d.yaml:4:3: not valid YAML: a tab"));
  CHECK_THAT(problems_with("  finish", "\t\tfinish"), Contains("d.yaml:5:1: not valid YAML: a tab"));
  // A tab elsewhere is a blank.
  CHECK(problems_with("name: Chute", "name:\tChute\t# the first").empty());
}

TEST_CASE("a key that is missing is asked for with an example") {
  CHECK_THAT(problems_with("  friction_angle: 17 deg", "  entry_speed: 0 m/s"),
             Contains("friction_angle is missing") && Contains("or friction_coefficient: 0.306"));
  CHECK_THAT(problems_with(", z: 1.1 m", ""),
             StartsWith("d.yaml:5:3: z is missing\n      A finish needs it."));
  CHECK_THAT(problems_of("name: x"),
             Contains("glissade is missing") && Contains("track is missing") && Contains("body is missing"));
}

TEST_CASE("a key given twice is refused") {
  CHECK_THAT(problems_with("tolerance: 0.5 mm", "tolerance: 0.5 mm, tolerance: 1 mm"),
             StartsWith("d.yaml:10:27: tolerance is given twice\n      It stands already at d.yaml:10:8."));
  // Once, also in groups that are read as one of several things.
  for (const std::string track :
       {"{start: {x: 0 m, z: 6 m}, finish: {x: 5 m, z: 1 m}, start: {x: 0 m, z: 6 m}}",
        "{start: {x: 0 m, x: 1 m, z: 6 m}, finish: {x: 5 m, z: 1 m}}",
        "{edge: {x: 0 m, z: 0 m}, start: {x: free, z: free}, start: {x: free, z: free}}"}) {
    CAPTURE(track);
    const std::string told = problems_of(
        "glissade: 1\nbody: {friction_angle: 17 deg}\ncenterline: {kind: fastest}\ntrack: " + track);
    CHECK_THAT(told, Contains("is given twice"));
    CHECK(told.find("is given twice") == told.rfind("is given twice"));
  }
}

TEST_CASE("a value of the wrong type is refused") {
  CHECK_THAT(problems_with("{kind: fastest}", "fastest"),
             StartsWith("d.yaml:8:13: centerline is a single value, not a group of keys") &&
                 Contains("Try: {kind: fastest}"));
  CHECK_THAT(problems_with("17 deg", "[17 deg]"),
             StartsWith("d.yaml:7:19: friction_angle is a list, not a single value"));
  CHECK_THAT(problems_with("[stl, off, scad]", "stl"), Contains("export is a single value, not a list"));
  CHECK_THAT(problems_with("6.2 m", ""), Contains("z has no value"));
  CHECK_THAT(problems_of("[1, 2]"), Contains("the design is a list, not a group of keys"));
}

TEST_CASE("a missing or wrong unit is refused where the value stands") {
  CHECK_THAT(problems_with("400 mm", "400"), StartsWith("d.yaml:9:41: width: 400 has no unit"));
  CHECK_THAT(problems_with("17 deg", "17 mm"),
             StartsWith("d.yaml:7:19: friction_angle: 17 mm is a length, not an angle"));
  CHECK_THAT(problems_with("5.4 m", "nan m"), Contains("x: nan m is not finite"));
  CHECK_THAT(
      problems_with("5.4 m", "5,4 m"),
      Contains("x: 5 has no unit") && Contains("a decimal point, if the comma before it was meant as one"));
}

TEST_CASE("a kind that is not known is refused with the one that was meant") {
  CHECK_THAT(
      problems_with("fastest", "fastst"),
      StartsWith("d.yaml:8:20: kind: fastst is not known\n      It is one of fastest, constant-speed, "
                 "straight, cycloid, no-curvature-load, segments, points or in-run.\n      Try: fastest"));
  CHECK_THAT(problems_with("off", "obj"), Contains("d.yaml:11:15: export[1]: obj is not known"));
  CHECK_THAT(problems_with("off", "report"), Contains("export[1]: the report page is no format") &&
                                                 Contains("A build writes it anyway") &&
                                                 !Contains("is not known"));
}

TEST_CASE("another version of design files is refused") {
  CHECK_THAT(problems_with("glissade: 1", "glissade: 2"),
             StartsWith("d.yaml:1:11: glissade: 2 is not a version"));
}

TEST_CASE("friction is given once, and within its range") {
  CHECK_THAT(problems_with("17 deg", "17 deg\n  friction_coefficient: 0.3"),
             Contains("both friction_angle and friction_coefficient are given"));
  CHECK_THAT(problems_with("17 deg", "95 deg"),
             StartsWith("d.yaml:7:19: friction_angle: 95 deg is out of range"));
  CHECK_THAT(problems_with("friction_angle: 17 deg", "friction_coefficient: -0.1"),
             StartsWith("d.yaml:7:25: friction_coefficient: -0.1 is out of range"));
}

TEST_CASE("start and finish are two points, the finish below") {
  CHECK_THAT(problems_with("{x: 5.4 m, z: 1.1 m}", "{x: 0 m, z: 6.2 m}"),
             StartsWith("d.yaml:5:3: start and finish are the same point"));
  CHECK_THAT(
      problems_with("z: 1.1 m", "z: 7 m"),
      StartsWith("d.yaml:5:25: the finish lies 0.8 m above the start") && Contains("z counts upwards"));
  CHECK_THAT(problems_with("z: 1.1 m", "z: 6.2 m"), Contains("the finish lies level with the start"));
  // Where a wind blows it on the ride tells.
  std::string above(kSoundDesign);
  above.replace(above.find("z: 1.1 m"), 8, "z: 7 m");
  for (const std::string wind : {"20", "-20"}) {
    std::string blown = above;
    blown.replace(blown.find("17 deg"), 6, "17 deg\n  drag: 0.1 1/m\n  head_wind: " + wind + " m/s");
    CAPTURE(blown);
    CHECK(problems_of(blown).empty() == (wind == "-20"));
  }
  CHECK_THAT(problems_with("x: 5.4 m", "x: 2e6 m"),
             Contains("d.yaml:5:3: start and finish are 2000 km apart"));
  CHECK_THAT(problems_with("x: 5.4 m", "x: 2e9 m"), Contains("x: 2000000 km is too far from the origin"));
}

TEST_CASE("one value under the key of a list of frictions is told its own key first") {
  const auto problems_of_friction = [](const std::string& value) {
    return problems_with("friction_angle: 17 deg", "friction: " + value);
  };
  const std::string list = ", or friction: [{from: 0 m, angle: 3 deg}, {from: 40 m, angle: 8 deg}]";
  CHECK_THAT(problems_of_friction("0.3"), Contains("friction is a single value, not a list") &&
                                              Contains("Try: friction_coefficient: 0.3" + list));
  CHECK_THAT(problems_of_friction("17 deg"), Contains("Try: friction_angle: 17 deg" + list));
  CHECK_THAT(problems_of_friction("17"), Contains("Try: friction_angle: 17 deg" + list));
  CHECK_THAT(problems_of_friction("{low: 0.2, nominal: 0.3, high: 0.4}"),
             Contains("friction is a group of keys, not a list") &&
                 Contains("Try: friction_coefficient: {low: 0.2, nominal: 0.3, high: 0.4}" + list));
  // Keys that a range does not have are not given back as advice.
  CHECK_THAT(problems_of_friction("{from: 0.16, to: 0.08}"),
             Contains("Try: friction_coefficient: {low: 0.08, nominal: 0.12, high: 0.16}" + list));
  CHECK_THAT(problems_of_friction("{least: 4 deg, usual: 5 deg, most: 9 deg}"),
             Contains("Try: friction_angle: {low: 4 deg, nominal: 5 deg, high: 9 deg}" + list));
  CHECK_THAT(problems_of_friction("{low: 4, high: 9}"),
             Contains("Try: friction_angle: {low: 4 deg, nominal: 6.5 deg, high: 9 deg}" + list));
  // Those of an item of the list, without its place.
  CHECK_THAT(problems_of_friction("{coefficient: 0.05}"), Contains("Try: friction_coefficient: 0.05" + list));
  CHECK_THAT(problems_of_friction("{angle: 3 deg}"), Contains("Try: friction_angle: 3 deg" + list));
  CHECK_THAT(problems_of_friction("{angle: 1}"), Contains("Try: friction_angle: 1 deg" + list));
  CHECK_THAT(problems_of_friction("{lowest: 0.08, highest: 0.16}"),
             Contains("Try: friction_coefficient: {low: 0.08, nominal: 0.12, high: 0.16}" + list));
  CHECK_THAT(problems_of_friction("{angle: 30 %}"), Contains("Try: friction_coefficient: 30 %" + list));
  CHECK_THAT(problems_of_friction("{coefficient: 17 deg}"), Contains("Try: friction_angle: 17 deg" + list));
  CHECK_THAT(problems_of_friction("300 %"), Contains("Try: friction_coefficient: 300 %" + list));
  CHECK_THAT(problems_of_friction("{value: 0.3}"), Contains("Try: friction_coefficient: 0.3" + list));
  CHECK_THAT(problems_of_friction("{from: 0, angle: 3}"), Contains("Try: [{from: 0 m, angle: 3 deg}"));
  CHECK_THAT(problems_of_friction("much"), Contains("Try: [{from: 0 m, angle: 3 deg}"));
}

TEST_CASE(
    "a group whose kind is misspelt is told of itself alone: it is not missing, nor judged by another kind") {
  // Every group that has a kind, and what stands beside it because of it.
  const std::string text = R"(glissade: 1
track: {start: {x: 0 m, z: 3 m}, finish: {x: 3 m, z: 0 m}}
body: {kind: sliding, friction_angle: 20 deg, drag: 0.001 1/m, head_wind: 1 m/s}
stream: {mass_flow: 60 t/h, bulk_density: 800 kg/m^3}
feed: {kind: belt, belt_speed: 2 m/s, pulley_radius: 200 mm, drop: 300 mm}
hood: {radius: 1.2 m, drop: 300 mm}
cross_section: {kind: u-channel, width: 300 mm, wall_height: 200 mm, thickness: 3 mm}
fabrication: {process: print, layer: 0.2 mm, rules: {leave_out: [print.bed]}}
export: [stl, 3mf]
)";
  const auto problems_without = [&](const std::vector<std::pair<std::string, std::string>>& slips) {
    std::string slipped = text;
    for (const auto& [word, slip] : slips) slipped.replace(slipped.find(word), word.size(), slip);
    return problems_of(slipped);
  };
  const auto count = [](const std::string& message) {
    std::size_t lines = 0;
    for (std::size_t at = message.find("d.yaml:"); at != std::string::npos;
         at = message.find("d.yaml:", at + 1))
      ++lines;
    return lines;
  };
  const std::vector<std::pair<std::string, std::string>> slips = {
      {"kind: sliding", "kind: slidng"},
      {"kind: belt", "kind: belts"},
      {"kind: u-channel", "kind: u-chanel"},
      {"process: print", "process: prints"},
      {"{kind: belt, belt_speed: 2 m/s, pulley_radius: 200 mm, drop: 300 mm}", "17 deg"}};
  const std::string sound = problems_without({});
  CHECK(sound.empty());
  for (const auto& slip : slips) {
    const std::string message = problems_without({slip});
    INFO(message);
    CHECK_THAT(message, !Contains("without a") && !Contains("there is no") && !Contains("needs one") &&
                            !Contains("unknown key") && !Contains("nothing makes any"));
    CHECK(count(message) == 1);
  }
  for (const std::string nothing : {"stream: 3", "stream:", "stream: []"}) {
    const std::string message =
        problems_without({{"stream: {mass_flow: 60 t/h, bulk_density: 800 kg/m^3}", nothing},
                          {"friction_angle: 20 deg, ", ""}});
    INFO(message);
    CHECK(count(message) == 1);
    CHECK_THAT(message, StartsWith("d.yaml:4:") && !Contains("friction_angle is missing"));
  }
  const std::string all = problems_without({slips[0], slips[1], slips[2], slips[3]});
  CHECK(count(all) == 4);
  CHECK_THAT(all, Contains("kind: slidng is not known") && Contains("kind: belts is not known") &&
                      Contains("kind: u-chanel is not known") && Contains("process: prints is not known"));
}

TEST_CASE("of a centerline whose kind is not known, the track and the rules are judged by none") {
  const auto with = [](const std::string& track, const std::string& rest) {
    return problems_of("glissade: 1\ntrack: " + track + "\nbody: {friction_coefficient: 0.03}\n" + rest);
  };
  const std::string in_run =
      "centerline: {kind: in-rn, gamma: 35 deg, alpha: 11 deg, r1: 93 m, t: 6.7 m, e1: 99 m}\n"
      "gates: {count: 10}\nrules: {leave_out: [fis.in-run.load]}\n";
  const std::string edge = with("{edge: {x: 0 m, z: 0 m}}", in_run);
  CHECK_THAT(edge, StartsWith("d.yaml:4:20: kind: in-rn is not known") && EndsWith("Try: in-run"));
  CHECK_THAT(
      with("{start: {x: 0 m, z: 50 m}}", "centerline: segments\n"),
      StartsWith("d.yaml:4:13: centerline is a single value, not a group of keys") && !Contains("finish"));
  // What any kind would refuse is told at once.
  CHECK_THAT(with("{edge: {x: 0 m, z: 0}}", in_run), Contains("z: 0 has no unit") && Contains("kind: in-rn"));
  CHECK_THAT(with("{start: {x: 0 m, z: 1 m}, finish: {x: 0 m, z: 1 m}}", "centerline: {kind: fastets}\n"),
             Contains("start and finish are the same point") && Contains("kind: fastets"));
}

TEST_CASE("a measure that is missing or misspelt hides nothing that is wrong with the others") {
  const auto with = [](const std::string& measures) {
    return problems_with("width: 400 mm, wall_height: 250 mm, thickness: 4 mm", measures);
  };
  const std::string thick = with("width: 400 mm, wall_height: 250 mm, thickness: 500 mm");
  REQUIRE_THAT(thick, Contains("thickness: 500 mm"));
  const std::string both = with("width: 400 mm, wall_hight: 250 mm, thickness: 500 mm");
  CHECK_THAT(both, Contains("unknown key wall_hight") && !Contains("wall_height is missing") &&
                       Contains("thickness: 500 mm"));
  // One that is there is not meant by another.
  CHECK_THAT(with("width: 400 mm, wdth: 300 mm, thickness: 4 mm"),
             Contains("wall_height is missing") && Contains("unknown key wdth"));
  // What hangs on the missing one is not guessed at.
  CHECK_THAT(with("wdth: 400 mm, wall_height: 250 mm, thickness: 500 mm"), !Contains("thickness: 500 mm"));
}

TEST_CASE("a quantity that is a list or a group is refused with what it takes and an example") {
  CHECK(problems_of(
            "glissade: 1\ntrack: {start: {x: 0 m, z: 3 m}, finish: {x: 3 m, z: 0 m}}\n"
            "body: {friction_angle: 17 deg, entry_speed: 2 m/s}\n"
            "stream: {mass_flow: {}, bulk_density: 800 kg/m^3}\n"
            "cross_section: {kind: u-channel, width: 900 mm, wall_height: 250 mm, thickness: 4 mm}\n") ==
        "d.yaml:4:21: mass_flow is a group of keys, not a single value\n"
        "      It takes a mass flow with its unit: t/h, kg/s, kg/h, kg/min, t/min or lb/h.\n"
        "      Try: mass_flow: 650 t/h");
  // One that is in there is what was meant.
  CHECK_THAT(problems_with("thickness: 4 mm", "thickness: [4 mm]"), EndsWith("Try: thickness: 4 mm"));
  CHECK_THAT(problems_with("tolerance: 0.5 mm", "tolerance: {value: 2 mm}"),
             EndsWith("Try: tolerance: 2 mm"));
  CHECK_THAT(problems_with("{kind: fastest}", "{kind: [fastest]}"), Contains("kind is a list, not a word") &&
                                                                        Contains("It is one of") &&
                                                                        Contains("Try: kind: fastest"));
}

TEST_CASE("every problem says what to try") {
  for (const auto& [part, with] : std::vector<std::pair<std::string, std::string>>{
           {"17 deg", "1e400 deg"},
           {"17 deg", "{}"},
           {"17 deg", "[]"},
           {"name: Chute", "name: {}"},
           {"kind: fastest", "kind: xyzzy"},
           {"kind: fastest", "kind: fastest, xyzzy: 1"},
           {"{x: 5.4 m, z: 1.1 m}", "{x: 0 m, z: 6.2 m}"},
           {"[stl, off, scad]", "[xyzzy]"},
           {"{tolerance: 0.5 mm}", "{tolerance: 0.5 mm, largest_kink: 40 deg}"},
           {"mesh:", "limits: {headroom: -1 m}\nmesh:"},
           {"mesh:", "limits: {arc_length: {highest: 1 m}}\nmesh:"},
           {"mesh:",
            "limits: {half_planes: [{line: [[0 m, 2 m], [5 m, 2 m]], stay: below, clearance: -1 m}]}\nmesh:"},
           {"mesh:", "limits: {keep_outs: [{outline: [[0 m, 2 m]]}]}\nmesh:"},
           {"mesh:", "limits: {stay_above: [{line: [[0 m, 2 m]]}]}\nmesh:"},
           {"mesh:", "hill: {size: -1 m}\nmesh:"},
           {"mesh:", "gates: {slow: {drag: -1 1/m}, start_area: 1 m}\nmesh:"},
           {"{kind: fastest}", "{kind: segments, segments: [{length: -1 m}]}"},
           {"{kind: fastest}", "{kind: segments, entry_slope_angle: 95 deg, segments: [{length: 1 m}]}"}}) {
    const std::string message = problems_with(part, with);
    INFO(part << " -> " << with << "\n" << message);
    CHECK_FALSE(message.empty());
    // Each begins with its place, and ends with its hint.
    for (std::size_t at = message.find("d.yaml:"); at != std::string::npos;) {
      const std::size_t next = message.find("\nd.yaml:", at);
      CHECK_THAT(message.substr(at, next - at), Contains("      Try: "));
      at = next == std::string::npos ? next : next + 1;
    }
  }
  CHECK_THAT(problems_with("kind: fastest", "kind: xyzzy"),
             Contains("It is one of fastest") && EndsWith("Try: one of these words"));
  CHECK_THAT(problems_with("kind: fastest", "kind: fastest, xyzzy: 1"),
             Contains("has the keys kind") && EndsWith("Try: one of these keys, or none"));
}

TEST_CASE("the advice for a rule of a workshop names what rules of a workshop may speak of") {
  const auto with = [](const std::string& rule) {
    return problems_with("mesh:", "fabrication: {process: plate, rules: {own: [" + rule + "]}}\nmesh:");
  };
  const std::string rest = ", id: own.a, sentence: A b., source: us, highest: 3 kg";
  for (const std::string slip :
       {"part_length", "arc_length", "part_mas", "exit_sped", "hole_pitch", "bend_radius"}) {
    const std::string message = with("{quantity: " + slip + rest + "}");
    INFO(message);
    const std::string advice = message.substr(message.rfind("Try: ") + 5);
    const std::string again = with("{quantity: " + advice + rest + "}");
    if (rule_quantity(advice) != nullptr) CHECK_THAT(again, !Contains("is of tracks"));
  }
  CHECK_THAT(with("{quantity: part_mas" + rest + "}"), EndsWith("Try: part_mass"));
  CHECK_THAT(with("{quantity: part_mass, when: 3" + rest + "}"),
             EndsWith("Try: [{quantity: part_thickness, highest: 3 mm}]"));
  CHECK_THAT(with("3"), EndsWith("quantity: part_mass, highest: 25 kg, source: ...}"));
}

TEST_CASE("a friction under the key of the other way to say it is sent there, or converted") {
  const auto with = [](const std::string& body) {
    return problems_with("body:\n  friction_angle: 17 deg", "body: {" + body + "}");
  };
  CHECK_THAT(with("friction_angle: 30 %"),
             Contains("friction_angle: 30 % is a share, not an angle") &&
                 EndsWith("Try: friction_coefficient: 30 %, or 16.7 deg, whose tangent is 30 %"));
  CHECK_THAT(with("friction_coefficient: 17 deg"),
             Contains("friction_coefficient: 17 deg is an angle, not a plain number") &&
                 EndsWith("Try: friction_angle: 17 deg, or 0.3057, the tangent of 17 deg"));
  CHECK_THAT(with("friction_angle: 0.3"), EndsWith("Try: friction_coefficient: 0.3, or 0.3 deg"));
  CHECK_THAT(with("friction_angle: 17"), EndsWith("Try: 17 deg"));
  CHECK_THAT(with("friction_angle: 17 mm"), EndsWith("Try: 17 deg"));
  CHECK_THAT(with("friction: [{from: 0 m, coefficient: 4 deg}]"),
             Contains("Try: angle: 4 deg, or 0.06993, the tangent"));
  CHECK_THAT(with("friction_angle: {low: 10 %, nominal: 17 deg}"),
             EndsWith("Try: 5.711 deg, whose tangent is 10 %"));
  CHECK_THAT(with("kind: rolling, radius: 30 mm, rolling_resistance: 2 deg"),
             Contains("Try: 0.03492, the tangent of 2 deg"));
}

TEST_CASE("friction steeper than the mean slope is infeasible, with what would do") {
  CHECK(
      problems_with("17 deg", "48 deg") ==
      "infeasible: d.yaml:7:19: friction_angle: 48 deg is steeper than the mean slope from start to finish, "
      "43.36 deg (drop 5.1 m over 5.4 m)\n"
      "      From rest, no track between these points reaches the finish, whatever its shape "
      "(docs/theory.md, reach theorem).\n"
      "      Try: a friction_angle of at most 43.32 deg, a drop of at least 6.003 m, or an "
      "entry_speed of at least 2.176 m/s");
  CHECK_THAT(problems_with("friction_angle: 17 deg", "friction_coefficient: 0.95"),
             StartsWith("infeasible: d.yaml:7:25: friction_coefficient: 0.95 (43.53 deg) is steeper"));
}

TEST_CASE("what the reach message says to try is feasible indeed") {
  CHECK(problems_with("17 deg", "43.32 deg").empty());
  CHECK(problems_with("17 deg", "48 deg\n  entry_speed: 2.176 m/s").empty());
  std::string lower = sound_design_with("17 deg", "48 deg");
  lower.replace(lower.find("z: 6.2 m"), 8, "z: 7.103 m");
  CHECK(problems_of(lower).empty());
}

TEST_CASE("reach is an equality at the friction angle itself: a mean slope equal to it is not enough") {
  const std::string level_slope = sound_design_with("friction_angle: 17 deg", "friction_coefficient: 0.5");
  std::string equal = level_slope;
  equal.replace(equal.find("{x: 5.4 m, z: 1.1 m}"), 20, "{x: 8 m, z: 2.2 m}");
  CHECK_THAT(problems_of(equal), StartsWith("infeasible"));
}

TEST_CASE("sizes are positive") {
  CHECK_THAT(problems_with("400 mm", "0 mm"), StartsWith("d.yaml:9:41: width: 0 mm is not positive"));
  CHECK_THAT(problems_with("250 mm", "-250 mm"),
             StartsWith("d.yaml:9:62: wall_height: -250 mm is not positive"));
  CHECK_THAT(problems_with("4 mm", "0 mm"), Contains("thickness: 0 mm is not positive"));
  CHECK_THAT(problems_with("400 mm", "400 km"), Contains("width: 400 km is out of range"));
  CHECK_THAT(problems_with("17 deg", "17 deg\n  entry_speed: -1 m/s"),
             Contains("entry_speed: -1 m/s is out of range"));
  CHECK_THAT(problems_with("17 deg", "17 deg\n  drag: -1 1/m"), Contains("drag: -1 1/m is negative"));
  CHECK_THAT(problems_with("17 deg", "17 deg\ngravity: 0 m/s^2"),
             Contains("gravity: 0 m/s^2 is out of range") && !Contains("mean slope"));
  CHECK_THAT(problems_with("x: 5.4 m", "x: 1e300 m"),
             Contains("x: 1e+297 km is too far from the origin") && !Contains("tolerance"));
  CHECK_THAT(
      problems_with("17 deg", "17 deg\nlimits: {match_belt: {speed: 2 m/s, within: 200 %}}"),
      Contains("within: 200 % is out of range\n      A share of the belt's speed: above 0, at most 100 %."));
  CHECK_THAT(problems_with("17 deg", "17 deg\nlimits: {match_belt: {speed: 2 m/s, direction: 400 deg}}"),
             Contains("direction: 400 deg is out of range") && Contains("between -90 and 90 deg"));
}

TEST_CASE("a plate wider than the channel is refused") {
  CHECK(problems_with("4 mm", "500 mm") ==
        "d.yaml:9:81: thickness: 500 mm is no thinner than the width, 400 mm\n"
        "      A plate is thinner than the width that it encloses.\n"
        "      Try: the units of both");
}

namespace {

constexpr std::string_view kSoundSection =
    "kind: u-channel, width: 400 mm, wall_height: 250 mm, thickness: 4 mm";

std::string section_problems(std::string_view measures) {
  return problems_with(kSoundSection, measures);
}

}  // namespace

TEST_CASE(
    "what measures of a section ask of each other is said on reading, at the key and in the section's "
    "nouns") {
  CHECK(section_problems("kind: pipe, inner_diameter: 100 mm, thickness: 100 mm") ==
        "d.yaml:9:64: thickness: 100 mm is no thinner than the inner_diameter, 100 mm\n"
        "      A plate is thinner than the inner_diameter that it encloses.\n"
        "      Try: the units of both");
  CHECK(section_problems("kind: slab, width: 40 mm, thickness: 10 mm, curb_height: 5 mm") ==
        "d.yaml:9:74: curb_height stands alone\n"
        "      A curb has both a curb_height and a curb_width.\n"
        "      Try: both, or none");
  // Curbs stand outside the width: they take nothing of it.
  CHECK(section_problems(
            "kind: slab, width: 40 mm, thickness: 10 mm, curb_height: 5 mm, curb_width: 30 mm") == "");
  CHECK_THAT(section_problems(
                 "kind: v-channel, angle: 10 deg, bottom_radius: 5 mm, wall_height: 90 mm, thickness: 2 mm"),
             StartsWith("d.yaml:9:41: angle: 10 deg is out of range"));
  CHECK_THAT(section_problems("kind: polygon, outline: [[-1 m, 1 m], [-1 m, 2 m], [1 m, 2 m], [1 m, 1 m]]"),
             StartsWith("d.yaml:9:32: outline: (0, 0) does not lie on it"));
  CHECK_THAT(section_problems("kind: polygon, outline: [[-1 m, 1 m], [-1 m, 0 m], [1 m, 0 m], [1 m, 1 m]]"),
             StartsWith("d.yaml:9:32: outline: the side at (0, 0) does not face up"));
  // One problem, not two: what is misread is not compared.
  CHECK_THAT(
      section_problems("kind: slab, width: 40 mm, thickness: 10 mm, curb_height: 5 kg, curb_width: 3 mm"),
      !Contains("stands alone"));
}

TEST_CASE("a measure of another kind is told from where it belongs") {
  CHECK_THAT(section_problems("kind: pipe, width: 100 mm, thickness: 1 mm"), Contains("Try: inner_diameter"));
  CHECK_THAT(
      section_problems("kind: u-channel, width: 1 m, wall_height: 1 m, thickness: 1 mm, wall_angle: 3 deg"),
      Contains("Try: kind: trapezoid, which has wall_angle"));
  CHECK_THAT(
      section_problems("kind: u-channel, width: 1 m, wall_height: 1 m, thickness: 1 mm, curb_width: 3 mm"),
      Contains("Try: kind: slab, which has curb_height and curb_width"));
  CHECK_THAT(section_problems("kind: slab, width: 1 m, thickness: 1 mm, bottom_radius: 3 mm"),
             Contains("Try: kind: v-channel, which has angle and bottom_radius"));
  CHECK_THAT(section_problems("kind: gutter"), Contains("v-channel, track-groove"));
}

TEST_CASE("widths along the track are read by place, and their faults told") {
  const auto channel = [](const std::string& widths) {
    return section_problems("kind: u-channel, width: " + widths + ", wall_height: 250 mm, thickness: 4 mm");
  };
  const std::string sound = "[{at: 0 m, width: 600 mm}, {at: 2 m, width: 400 mm}]";
  CHECK(channel(sound) == "");
  const Design design = parse_design(sound_design_with("width: 400 mm", "width: " + sound), "d.yaml");
  CHECK(section::width_law(*design.cross_section) == WidthLaw({{0.0, 0.6}, {2.0, 0.4}}));
  CHECK_THAT(channel("[{at: 2 m, width: 600 mm}, {at: 1 m, width: 400 mm}]"),
             StartsWith("d.yaml:9:41: width: the place at 1 m does not lie after the one at 2 m"));
  CHECK_THAT(channel("[]"), StartsWith("d.yaml:9:41: width: no place is given"));
  CHECK_THAT(channel("[{at: 0 m}]"), Contains("width is missing"));
  CHECK_THAT(channel("[{at: 0 m, width: 600 mm, height: 2 m}]"), Contains("unknown key height"));
  CHECK_THAT(channel("[{at: 0 m, width: 3 mm}, {at: 2 m, width: 400 mm}]"),
             Contains("thickness: 4 mm is no thinner than the width, 3 mm"));
  CHECK_THAT(channel("[{at: -1 m, width: 600 mm}, {at: 2 m, width: 400 mm}]"),
             Contains("width: the place at -1 m is out of range"));
  CHECK_THAT(channel("[{at: 0 m, width: 600 mm}, {at: 50 mm, width: 400 mm}]"),
             Contains("width: after 0 mm it changes by 4 times the length of track that it takes"));
  CHECK_THAT(section_problems("kind: half-pipe, width: " + sound + ", thickness: 4 mm"), Contains("width"));
}

TEST_CASE("a tolerance that no mesh can have is refused, with the size that it would need") {
  CHECK_THAT(problems_with("0.5 mm", "0 mm"), StartsWith("d.yaml:10:19: tolerance: 0 mm is not positive"));
  CHECK_THAT(problems_with("0.5 mm", "1e-9 mm"),
             StartsWith("d.yaml:10:19: tolerance: 1e-09 mm is finer than the curve is known"));
  CHECK_THAT(problems_with("0.5 mm", "20 m"), Contains("tolerance: 20 m is larger than the track, 7.428 m"));
}

TEST_CASE("all problems of a file are told at once, in its order") {
  const std::string text = problems_of(R"(glissade: 2
nme: x
track: {start: {x: 0, z: 1 m}, finish: {x: 2 m, z: 5 deg}}
body: {friction_angle: 3 m}
cross_section: {kind: slab, width: -1 m}
)");
  std::size_t last = 0;
  for (const char* part :
       {"1:11: glissade: 2", "2:1: unknown key nme", "3:20: x: 0 has no unit", "3:52: z: 5 deg is an angle",
        "4:24: friction_angle: 3 m is a length", "5:1: thickness is missing", "5:36: width: -1 m"}) {
    INFO(part << " in\n" << text);
    const std::size_t at = text.find(part);
    REQUIRE(at != std::string::npos);
    CHECK(at >= last);
    last = at;
  }
}

TEST_CASE("a file of a thousand problems shows a hundred and counts the rest") {
  std::string text(kSoundDesign);
  for (int index = 0; index < 1500; ++index) text += "key" + std::to_string(index) + ": 1\n";
  CHECK_THAT(problems_of(text), Catch::Matchers::EndsWith("d.yaml: and 1400 more problems"));
}

TEST_CASE("an outline is simple and passes through the centerline") {
  const auto outline = [](const std::string& corners) {
    return problems_with("{kind: u-channel, width: 400 mm, wall_height: 250 mm, thickness: 4 mm}",
                         "{kind: polygon, outline: " + corners + "}");
  };
  CHECK(outline("[[-2 m, 0 m], [-2 m, -1 m], [2 m, -1 m], [2 m, 0 m]]").empty());
  CHECK_THAT(outline("[[-2 m, 1 m], [-2 m, -1 m], [2 m, -1 m], [2 m, 1 m]]"),
             Contains("outline: (0, 0) does not lie on it"));
  CHECK_THAT(outline("[[-2 m, 0 m], [2 m, -1 m], [-2 m, -1 m], [2 m, 0 m]]"),
             Contains("the edges after corners 0 and 2 meet"));
  CHECK_THAT(outline("[[-2 m, 0 m], [2 m, 0 m]]"), Contains("outline: 2 corners"));
  CHECK_THAT(outline("[[-2 m, 0 m], [-2 m, 0 m], [2 m, -1 m], [2 m, 0 m]]"),
             Contains("corners 0 and 1 are the same point"));
  CHECK_THAT(outline("[[-2 m, 0 m, 0 m], [-2 m, -1 m], [2 m, 0 m]]"),
             Contains("outline[0] has 3 values instead of 2"));
  CHECK_THAT(outline("[[-2 m, 0], [-2 m, -1 m], [2 m, 0 m]]"), Contains("outline[0][1]: 0 has no unit"));
}

TEST_CASE("curbs have a height and a width, and stand outside the floor") {
  const auto slab = [](const std::string& keys) {
    return problems_with("{kind: u-channel, width: 400 mm, wall_height: 250 mm, thickness: 4 mm}",
                         "{kind: slab, width: 400 mm, thickness: 20 mm, " + keys + "}");
  };
  CHECK(slab("curb_height: 50 mm, curb_width: 20 mm").empty());
  CHECK_THAT(slab("curb_height: 50 mm"), Contains("curb_height stands alone"));
  CHECK(slab("curb_height: 50 mm, curb_width: 300 mm").empty());
}

namespace {

std::string segments(const std::string& list, const std::string& entry = "40 deg") {
  std::string text = sound_design_with(
      "{kind: fastest}", "{kind: segments, entry_slope_angle: " + entry + ", segments: " + list + "}");
  return text.erase(text.find("  finish"), std::string_view("  finish: {x: 5.4 m, z: 1.1 m}\n").size());
}

}  // namespace

TEST_CASE("the finish of segments follows from them") {
  // A straight at 30 deg: 3 m fall 1.5 m.
  const Design straight = parse_design(segments("[{length: 3 m}]", "30 deg"), "d.yaml");
  CHECK_FALSE(straight.track.finish_given);
  CHECK(straight.track.finish.x == Approx(3.0 * std::cos(0.52359877559829887)).epsilon(1e-15));
  CHECK(straight.track.finish.z == Approx(6.2 - 1.5).epsilon(1e-15));
  // A quarter circle of 2 m from straight down to level: 2 m across, 2 m down.
  const Design arc =
      parse_design(segments("[{length: 3.141592653589793 m, radius: 2 m}]", "90 deg"), "d.yaml");
  CHECK(arc.track.finish.x == Approx(2.0).epsilon(1e-14));
  CHECK(arc.track.finish.z == Approx(4.2).epsilon(1e-14));
}

TEST_CASE("segments that miss the finish of the file, overhang or bend in two ways are refused") {
  CHECK_THAT(problems_with("{kind: fastest}",
                           "{kind: segments, entry_slope_angle: 40 deg, segments: [{length: 3 m}]}"),
             Contains("d.yaml:5:3: the segments miss the finish by 4.436 m"));
  CHECK_THAT(problems_of(segments("[{length: 3 m}, {length: 2 m, radius: -1 m}]")),
             Contains("segments[1] overhangs: its slope angle reaches 154.6 deg"));
  CHECK_THAT(problems_of(segments("[{length: 3 m, radius: 2 m, curvature: 1 1/m}]")),
             Contains("segments[0] is bent in more than one way"));
  CHECK_THAT(problems_of(segments("[{length: 3 m, radius: 0 m}]")),
             Contains("radius: 0 m bends without bound"));
  CHECK_THAT(problems_of(segments("[]")), Contains("segments: the list is empty"));
  CHECK_THAT(problems_of(segments("[{length: -3 m}]")),
             Contains("d.yaml:7:77: length: -3 m is out of range"));
}

TEST_CASE("a given track is not asked for reach: its ride tells where it stalls") {
  CHECK(problems_of(segments("[{length: 3 m}]", "10 deg")).empty());
}

TEST_CASE("the file of a profile is found beside the design file") {
  const std::string text =
      sound_design_with("{kind: fastest}", "{kind: points, file: p.csv, columns: [s, h], unit: mm}");
  const Design design = parse_design(text, "some/where/d.yaml");
  CHECK(design.centerline.points_file == "some/where/p.csv");
  CHECK(design.centerline.points_distance_column == "s");
  CHECK(design.centerline.points_height_column == "h");
  CHECK(design.centerline.points_unit == LengthUnit::millimetre);
  CHECK_THAT(problems_with("{kind: fastest}", "{kind: points, file: p.csv, columns: [s]}"),
             Contains("columns: 1 name instead of 2"));
  CHECK_THAT(problems_with("{kind: fastest}", "{kind: points}"), Contains("file is missing"));
}

TEST_CASE("no column of a file is two numbers") {
  for (const char* const columns :
       {"[x, x]", "[z, z]", "[x, z, z, k]", "[x, z, a, x]", "[x, z, a, a]", "[a, z, x, x]"}) {
    INFO(columns);
    CHECK_THAT(problems_with("{kind: fastest}",
                             "{kind: points, file: p.csv, columns: " + std::string(columns) + "}"),
               Contains("is named twice") && Contains("columns: "));
    if (std::string(columns).size() > 6) continue;
    CHECK_THAT(problems_with("mesh:", "limits: {stay_above: [{file: p.csv, columns: " + std::string(columns) +
                                          "}]}\nmesh:"),
               Contains("is named twice"));
  }
}

TEST_CASE("tracks that are drawn have their ends as far apart as others") {
  const auto problem = [](const std::string& segments) {
    return problems_of(
        "glissade: 1\ntrack: {start: {x: 0 m, z: 0 m}}\nbody: {friction_angle: 5 deg}\n"
        "centerline: {kind: segments, entry_slope_angle: 30 deg, segments: [" +
        segments + "]}\n");
  };
  CHECK(problem("{length: 1 mm}") == "");
  CHECK_THAT(problem("{length: 1e-9 m}"), Contains("the segments end ") &&
                                              Contains("from where they begin") &&
                                              Contains("between 0.1 mm and 1000 km apart"));
  CHECK_THAT(problem("{length: 900 km}, {length: 900 km}"),
             Contains("the segments end ") && Contains("between 0.1 mm and 1000 km apart"));
}

TEST_CASE("a design that was not read from a file is checked too, by key paths") {
  Design design = parse_design(kSoundDesign, "d.yaml");
  design.file.clear();
  design.locations.clear();
  CHECK(check(design).empty());
  std::get<section::UChannel>(*design.cross_section).width = std::numeric_limits<double>::quiet_NaN();
  design.mesh.tolerance = 0.0;
  const std::vector<Issue> issues = check(design);
  REQUIRE(issues.size() == 2);
  CHECK(issues[0].where == "cross_section.width");
  CHECK(issues[1].where == "mesh.tolerance");
}

TEST_CASE("the location of a key that is not in the file is that of its parent") {
  const Design design = parse_design(kSoundDesign, "d.yaml");
  CHECK(design.where("body.entry_speed") == "d.yaml:6:1");
  CHECK(design.where("track.finish.z") == "d.yaml:5:25");
  CHECK(design.where("gravity") == "d.yaml");
}

TEST_CASE("a curvature beyond all measure is one problem, and no finish is sought at the end of it") {
  const std::string without_finish = sound_design_with("  finish: {x: 5.4 m, z: 1.1 m}\n", "");
  const auto refusal_of = [&](const std::string& segment) {
    std::string text = without_finish;
    const std::string kind = "{kind: fastest}";
    text.replace(text.find(kind), kind.size(),
                 "{kind: segments, entry_slope_angle: 55 deg, segments: [" + segment + "]}");
    return problems_of(text);
  };
  for (const std::string segment :
       {"{length: 1 m, curvature: 1e300 1/m}", "{length: 1 m, curvature: -1e300 1/m}",
        "{length: 1000 m, radius: 1e-9 m}",
        "{length: 1 m, entry_curvature: 1e200 1/m, exit_curvature: -1e200 1/m}"}) {
    const std::string refusal = refusal_of(segment);
    INFO(segment << "\n" << refusal);
    CHECK_THAT(refusal, StartsWith("d.yaml:7:"));
    CHECK_THAT(refusal, Contains("overhangs"));
    CHECK(refusal.find("d.yaml", 1) == std::string::npos);
    CHECK_THAT(refusal, !Contains("finish"));
  }
  CHECK(refusal_of("{length: 2 m, curvature: 0.2 1/m}").empty());
}

TEST_CASE("a friction just too steep for the track is told with the digits that show it") {
  // tan(33.69 deg) is 0.66666..., the mean slope 2 in 3.
  const std::string same = sound_design_with("{x: 5.4 m, z: 1.1 m}", "{x: 7.5 m, z: 1.2 m}");
  std::string steep = same;
  steep.replace(steep.find("17 deg"), 6, "33.69007 deg");
  CHECK_THAT(problems_of(steep),
             Contains("33.69007 deg is steeper than the mean slope from start to finish, 33.69006"));
}

TEST_CASE("what the message of a mesh too coarse for its track says to try is finer than the track") {
  std::string tiny = sound_design_with("{x: 5.4 m, z: 1.1 m}", "{x: 0.3 mm, z: 6199.8 mm}");
  const std::string problems = problems_of(tiny);
  CHECK_THAT(problems,
             Contains("tolerance: 0.5 mm is larger than the track, 0.3606 mm") && !Contains("Try: 0.5 mm"));
}

TEST_CASE("the default tolerance is asked for where a mesh is made alone, and told as the default") {
  const auto short_track = [](const std::string& more) {
    return problems_of(
        "glissade: 1\ntrack: {start: {x: 0 mm, z: 0.2 mm}, finish: {x: 0.3 mm, z: 0 mm}}\n"
        "body: {friction_angle: 10 deg}\n" +
        more);
  };
  const std::string channel =
      "cross_section: {kind: u-channel, width: 0.03 mm, wall_height: 0.02 mm, thickness: 0.002 mm}\n";
  CHECK(short_track("") == "");
  CHECK_THAT(short_track("mesh: {tolerance: 0.5 mm}"),
             StartsWith("d.yaml:4:19: tolerance: 0.5 mm is larger than the track, 0.3606 mm"));
  const std::string told = short_track(channel);
  CHECK_THAT(told, Contains("tolerance: 0.5 mm, the default, is larger than the track, 0.3606 mm") &&
                       Contains("Try: mesh: {tolerance: 0.0004 mm}"));
  const std::size_t from = told.find("Try: ") + 5;
  CHECK(short_track(channel + told.substr(from, told.find('}', from) + 1 - from)) == "");
}

TEST_CASE(
    "a mesh that would have more triangles than Glissade makes is refused on reading, by the sweep's own "
    "bound") {
  const auto round = [](const std::string& tolerance) {
    std::string text = sound_design_with("kind: u-channel, width: 400 mm, wall_height: 250 mm",
                                         "kind: half-pipe, width: 400 mm");
    const std::string held = "tolerance: 0.5 mm";
    return problems_of(text.replace(text.find(held), held.size(), "tolerance: " + tolerance));
  };
  const std::string refusal = round("0.000002 mm");
  CHECK_THAT(refusal, Contains("needs more than") && Contains("A mesh has at most 20000000 triangles."));
  // What is told is the first that is not refused.
  const std::size_t from = refusal.find("Try: a tolerance above ") + 23;
  CHECK(round(refusal.substr(from, refusal.find(';') - from)) == "");
  // What is flat across needs no more facets the wider it is.
  for (const std::string width : {"400 mm", "30 m", "300 m"}) {
    for (const std::string tolerance : {"0.00001 mm", "0.000002 mm"}) {
      CAPTURE(width, tolerance);
      std::string text = sound_design_with("width: 400 mm", "width: " + width);
      const std::string held = "tolerance: 0.5 mm";
      CHECK(problems_of(text.replace(text.find(held), held.size(), "tolerance: " + tolerance)) == "");
    }
  }
}

TEST_CASE("a lowest speed that holds from behind the longest track is refused") {
  std::string text(kSoundDesign);
  text += "limits: {arc_length: {highest: 9 m}, speed: {lowest: 1 m/s, lowest_from: 30 m}}\n";
  CHECK_THAT(problems_of(text), Contains("speed.lowest_from: 30 m lies past the end of the track"));
}

TEST_CASE("what is wrong with a section is told by itself, whatever it is to be made of") {
  for (const std::string process : {"plate", "print", "timber"}) {
    INFO(process);
    std::string text = sound_design_with("kind: u-channel", "kind: polygon");
    const std::string alone = problems_of(text);
    CHECK_THAT(alone, Contains("outline is missing"));
    text += "fabrication: {process: " + process + "}\n";
    const std::string whole = problems_of(text);
    CHECK_THAT(whole, StartsWith("d.yaml:9:1: outline is missing"));
    CHECK(whole == alone);
  }
}

TEST_CASE("how parts are split is asked for in one group") {
  const std::string text =
      std::string(kSoundDesign) + "fabrication: {process: print, bed: [1 m, 1 m, 1 m]}\n";
  CHECK_THAT(problems_of(text), Contains("unknown key bed") &&
                                    Contains("Try: split: {bed: [220 mm, 220 mm, 250 mm]}, of a print"));
}

TEST_CASE(
    "every letter of an in-run that is wrong by itself is told at once, and so is where its gates are "
    "measured") {
  const auto problems = [](const std::string& letters, const std::string& gates) {
    return problems_of(
        "glissade: 1\ntrack: {edge: {x: 0 m, z: 0 m}}\nbody: {friction_coefficient: 0.03}\n"
        "centerline: {kind: in-run, " +
        letters + "}\nhill: {size: -142 m}\ngates: {" + gates + "}\n");
  };
  const std::string bad =
      problems("gamma: 35 deg, alpha: 41 deg, r1: -103 m, t: 0 m, e1: 96 m, es: 124 m", "count: 1");
  CHECK_THAT(bad, Contains("gamma: 35 deg is not above alpha, 41 deg"));
  CHECK_THAT(bad, Contains("r1: -103 m is not positive"));
  CHECK_THAT(bad, Contains("t: 0 mm is not positive"));
  CHECK_THAT(bad, Contains("es: the start area, 124 m, is longer than the in-run, e1 96 m"));
  CHECK_THAT(bad, Contains("size: -142 m is not positive"));
  const std::string sound = "gamma: 35 deg, alpha: 11 deg, r1: 103 m, t: 6.9 m, e1: 96 m, es: 24 m";
  CHECK_THAT(problems(sound, "count: 1, measuring_place: 300 m"),
             Contains("measuring_place: 300 m before the edge no ride of this line passes") &&
                 Contains("The in-run is 102.9 m long"));
  CHECK_THAT(problems(sound, "count: 1, measuring_place: 102.9 m"), Contains("no ride of this line passes"));
  CHECK_THAT(problems(sound, "count: 1, measuring_place: 102 m"), !Contains("measuring_place"));
}

namespace {

/// A key with a bound, and what else the design needs for it.
struct Bounded {
  std::string key;
  double bound;  ///< in `unit`
  std::string unit;
  double outwards = 1.0;             ///< to which side values are refused
  std::vector<Override> along = {};  ///< set beside it
};

std::vector<Bounded> bounded_keys() {
  const std::vector<Override> drag = {{"body.mass", "80 kg"}, {"body.drag_area", "0.3 m^2"}};
  const std::vector<Override> stream = {
      {"stream",
       "{mass_flow: 10 t/h, bulk_density: 1600 kg/m^3, "
       "liner_plate: {thickness: 12 mm, hardness: 4 GPa, wear_coefficient: 2e-4}}"},
      {"body.entry_speed", "2 m/s"}};
  const std::vector<Override> straight = {{"centerline", "{kind: straight}"}};
  const auto with = [](std::vector<Override> all, const Override& one) {
    all.push_back(one);
    return all;
  };
  const auto section = [](const char* text) { return std::vector<Override>{{"cross_section", text}}; };
  const std::vector<Override> v_channel =
      section("{kind: v-channel, angle: 90 deg, bottom_radius: 20 mm, wall_height: 100 mm, thickness: 4 mm}");
  const std::vector<Override> trapezoid =
      section("{kind: trapezoid, width: 400 mm, wall_height: 250 mm, wall_angle: 30 deg, thickness: 4 mm}");
  return {
      {"gravity", 10'000.0, "m/s^2"},
      {"body.entry_speed", 10'000.0, "m/s"},
      {"body.friction_coefficient", 10'000.0, ""},
      {"body.centre_height", 1000.0, "m"},
      {"body.mass", 1e9, "kg", 1.0, drag},
      {"body.head_wind", 150.0, "m/s", 1.0, {{"body.drag", "0.01 1/m"}}},
      {"body.head_wind", -150.0, "m/s", -1.0, {{"body.drag", "0.01 1/m"}}},
      {"body.air.altitude", 11'000.0, "m", 1.0, drag},
      {"body.air.altitude", -500.0, "m", -1.0, drag},
      {"body.air.temperature", 100.0, "degC", 1.0, drag},
      {"body.air.temperature", -100.0, "degC", -1.0, drag},
      {"limits.speed.highest", 10'000.0, "m/s"},
      {"limits.headroom", 1000.0, "km"},
      {"track.finish.x", 10'000.0, "km"},
      {"track.finish.x", -10'000.0, "km", -1.0},
      {"track.start.z", 10'000.0, "km"},
      {"cross_section.width", 10.0, "km"},
      {"cross_section.thickness", 0.001, "mm", -1.0},
      {"cross_section.angle", 170.0, "deg", 1.0, v_channel},
      {"cross_section.wall_angle", 80.0, "deg", 1.0, trapezoid},
      {"mesh.largest_kink", 14.0, "deg"},
      {"mesh.largest_kink", 0.001, "deg", -1.0},
      {"stream.bulk_density", 30'000.0, "kg/m^3", 1.0, stream},
      {"stream.bulk_density", 1.0, "kg/m^3", -1.0, stream},
      {"stream.mass_flow", 3'600'000.0, "t/h", 1.0, stream},
      {"stream.lateral_pressure_ratio", 10.0, "", 1.0, stream},
      {"stream.slip_ratio", 1.0, "", 1.0, stream},
      {"stream.surge", 100.0, "", 1.0, stream},
      {"stream.surge", 1.0, "", -1.0, stream},
      {"stream.trickle", 1.0, "", 1.0, stream},
      {"stream.liner_plate.thickness", 1.0, "m", 1.0, stream},
      {"stream.liner_plate.wear_coefficient", 1.0, "", 1.0, stream},
      {"feed.belt_speed", 100.0, "m/s", 1.0,
       with(stream, {"feed", "{kind: belt, belt_speed: 3 m/s, pulley_radius: 400 mm, drop: 1 m}"})},
      {"centerline.segments.0.length",
       1000.0,
       "km",
       1.0,
       {{"centerline", "{kind: segments, entry_slope_angle: 30 deg, segments: [{length: 5 m}]}"}}},
      {"centerline.entry_slope_angle",
       90.0,
       "deg",
       1.0,
       {{"centerline", "{kind: segments, entry_slope_angle: 30 deg, segments: [{length: 5 m}]}"}}},
  };
}

/// Where the message shows the bound, and as what the value: "gravity: 10001 m/s^2 is ...".
void tells_apart(const Bounded& bounded, double share) {
  const double value = bounded.bound + bounded.outwards * std::fabs(bounded.bound) * share;
  const std::string written = decimal_text(value) + (bounded.unit.empty() ? "" : " " + bounded.unit);
  std::vector<Override> overrides = bounded.along;
  overrides.push_back({bounded.key, written});
  const std::string said = problems_of(kSoundDesign, overrides);
  CAPTURE(bounded.key, written, said);
  // "--set gravity: gravity: 10001 m/s^2 is ..."
  const std::string place = "--set " + bounded.key + ": ";
  const std::size_t begins = said.find(place);
  REQUIRE(begins != std::string::npos);
  const std::size_t at = said.find(": ", begins + place.size()) + 2;
  const std::string line = said.substr(at, said.find('\n', at) - at);
  // The number and its unit.
  std::size_t end = line.find(' ');
  if (!bounded.unit.empty()) end = line.find(' ', end + 1);
  const std::string shown = line.substr(0, end);
  CAPTURE(shown);
  const auto number = [&](const std::string& text, Dimension dimension) {
    return parse_quantity(text, dimension, "");
  };
  for (const Dimension dimension :
       {Dimension::number, Dimension::length, Dimension::angle, Dimension::speed, Dimension::acceleration,
        Dimension::mass, Dimension::density, Dimension::temperature, Dimension::mass_flow}) {
    const auto asked = read_quantity(written, dimension, "");
    if (!std::holds_alternative<double>(asked)) continue;
    const double bound =
        number(decimal_text(bounded.bound) + (bounded.unit.empty() ? "" : " " + bounded.unit), dimension);
    CHECK((number(shown, dimension) - bound) * bounded.outwards > 0.0);
  }
}

}  // namespace

TEST_CASE("a value just outside a bound is never shown as the bound, nor inside it") {
  for (const Bounded& bounded : bounded_keys()) {
    for (const double share : {1e-3, 1e-6, 1e-9}) tells_apart(bounded, share);
  }
}

TEST_CASE("bounds on what ends and angles give are told apart as well") {
  CHECK_THAT(problems_of(kSoundDesign, {{"body.friction_angle", "89.9999 deg"}}),
             Contains("friction_angle: 89.9999 deg is out of range") && Contains("89.994 deg"));
  CHECK_THAT(problems_of(kSoundDesign, {{"body.friction_angle", "89.99428 deg"}}),
             Contains("friction_angle: 89.9943 deg is out of range"));
  CHECK_THAT(problems_of(kSoundDesign, {{"track.finish.x", "1000.008 km"}}),
             Contains("start and finish are 1000.01 km apart"));
  CHECK_THAT(
      problems_with("centerline:", "limits: {speed: {lowest: 5.00001 m/s, highest: 5 m/s}}\ncenterline:"),
      Contains("lowest 5.00001 m/s is above highest 5 m/s"));
  // Within, friction is held against the mean slope as ever.
  CHECK_THAT(problems_of(kSoundDesign, {{"body.friction_angle", "43.3635 deg"}}), Contains("mean slope"));
}

TEST_CASE("a friction out of range is called by its key, and stands where it was set") {
  CHECK_THAT(
      problems_of(kSoundDesign, {{"body", "{kind: rolling, radius: 8 mm, rolling_resistance: -0.01}"}}),
      StartsWith("--set body: rolling_resistance: -0.01 is out of range") && !Contains("tangent"));
  CHECK_THAT(problems_of(kSoundDesign, {{"body.friction_coefficient", "1e308"}}),
             StartsWith("--set body.friction_coefficient: friction_coefficient: 1e+308 is out of range"));
  CHECK_THAT(
      problems_with("friction_angle: 17 deg", "friction_coefficient: {low: -0.1, nominal: 0.3, high: 0.4}"),
      Contains("friction_coefficient.low: -0.1 is out of range"));
  CHECK_THAT(problems_of(kSoundDesign, {{"body.friction_coefficient", "3/10"}}), Contains("Try: 0.3"));
}

TEST_CASE("a width before the start is refused, the only one too") {
  CHECK_THAT(problems_with("width: 400 mm", "width: [{at: -50 m, width: 600 mm}]"),
             Contains("width: the place at -50 m is out of range"));
}

}  // namespace design_problems_test
