// Rules of a shop: which are in force, and what they say of parts.

#include "glissade/pipeline/shop_rules.hpp"

#include "glissade/core/error.hpp"
#include "glissade/design/design.hpp"
#include "glissade/design/write.hpp"
#include "glissade/pipeline.hpp"

#include "support/catch.hpp"
#include "support/paths.hpp"
#include "support/shop_rules.hpp"
#include "support/temp_dir.hpp"

#include <cmath>
#include <set>
#include <string>
#include <vector>

namespace shop_rules_test {

namespace {

using namespace glissade;
using Catch::Matchers::Contains;

Rule rule_of(const std::string& quantity, Range bound, bool advice = false) {
  Rule rule;
  rule.id = "own." + quantity;
  rule.sentence = "A sentence.";
  rule.quantity = quantity;
  rule.bound = bound;
  rule.advice = advice;
  rule.source = "this test";
  return rule;
}

/// A hole in a plate.
ShopMeasurement hole(double diameter, double thickness, const std::string& part, double density = 7850.0) {
  return {"hole_thicknesses", diameter, thickness, Dimension::length, part, thickness, density};
}

std::string design_with(const std::string& rules) {
  return "glissade: 1\n"
         "track: {start: {x: 2 m, z: 6.2 m}, finish: {x: 7.4 m, z: 1.1 m}}\n"
         "body: {friction_angle: 17 deg}\n"
         "cross_section: {kind: u-channel, width: 400 mm, wall_height: 250 mm, thickness: 4 mm}\n"
         "fabrication: {process: plate, rules: " +
         rules + "}\n";
}

std::string problems_of(const std::string& text) {
  try {
    static_cast<void>(parse_design(text, "d.yaml"));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE(
    "shop rules: a rule that counts in thicknesses is told in lengths, at the part that keeps it worst") {
  Workshop workshop;
  workshop.measured = {hole(10e-3, 4e-3, "floor"), hole(14e-3, 12e-3, "lug"), hole(11e-3, 6e-3, "frame")};
  const ShopCheck kept = judge_shop({rule_of("hole_thicknesses", {1.0, {}})}, workshop).front();
  CHECK(kept.verdict == ShopVerdict::pass);
  CHECK(kept.where == "lug");
  const ShopCheck broken = judge_shop({rule_of("hole_thicknesses", {1.2, {}})}, workshop).front();
  CHECK(broken.verdict == ShopVerdict::fail);
  CHECK(broken.rule == "own.hole_thicknesses");
  CHECK(broken.value == "14 mm");
  CHECK(broken.bound == "at least 14.4 mm");
  CHECK(broken.where == "lug");
  CHECK(broken.source == "this test");
  CHECK(broken.certainty == "own");
  CHECK_FALSE(broken.needs_checking);
  const ShopCheck advised = judge_shop({rule_of("hole_thicknesses", {{}, 2.0}, true)}, workshop).front();
  CHECK(advised.verdict == ShopVerdict::warn);
  CHECK(advised.where == "floor");
  CHECK(advised.bound == "at most 8 mm");
}

TEST_CASE("shop rules: conditions choose the parts by thickness and density") {
  Workshop workshop;
  workshop.measured = {hole(4e-3, 4e-3, "thin"), hole(4e-3, 12e-3, "thick"),
                       hole(1e-3, 4e-3, "light", 2700.0)};
  Rule rule = rule_of("hole_thicknesses", {0.9, {}});
  rule.when = {{"part_thickness", {{}, 8e-3}}, {"part_density", {4000.0, {}}}};
  CHECK(judge_shop({rule}, workshop).front().verdict == ShopVerdict::pass);
  rule.when.front().range = {8e-3, {}};
  CHECK(judge_shop({rule}, workshop).front().where == "thick");
  rule.when.front().range = {1.0, {}};
  CHECK(judge_shop({rule}, workshop).empty());
}

TEST_CASE("shop rules: a part of which too little is known hides behind none that keeps the rule") {
  Workshop workshop;
  workshop.measured = {hole(4e-3, 4e-3, "kept"), hole(4e-3, 4e-3, "of unknown density")};
  workshop.measured.back().density.reset();
  Rule rule = rule_of("hole_thicknesses", {0.9, {}});
  rule.when = {{"part_density", {4000.0, {}}}};
  const ShopCheck open = judge_shop({rule}, workshop).front();
  CHECK(open.verdict == ShopVerdict::cannot_be_judged);
  CHECK_THAT(open.where, Contains("of unknown density: density of a part is not known"));
  // What is broken is told first.
  workshop.measured.push_back(hole(1e-3, 4e-3, "broken"));
  CHECK(judge_shop({rule}, workshop).front().where == "broken");
}

TEST_CASE("shop rules: what nothing has is not told of shipped rules, and cannot be judged by others") {
  Workshop workshop;
  workshop.measured = {hole(10e-3, 4e-3, "floor")};
  for (const ShopCheck& check : testing::shop_checks(workshop, "print")) FAIL(check.rule);
  const ShopCheck own = judge_shop({rule_of("bed_share", {{}, 0.9})}, workshop).front();
  CHECK(own.verdict == ShopVerdict::cannot_be_judged);
  CHECK(own.value == "-");
  CHECK_THAT(own.where, Contains("size of a segment over that of the bed"));
  // Nothing is overhanging where nothing may.
  const ShopMeasurement upright{"overhang_share", 0.0, 0.0, Dimension::angle, "segment 1", {}, {}};
  ShopMeasurement leaning = upright;
  leaning.value = 0.1;
  workshop.measured = {upright};
  CHECK(judge_shop({rule_of("overhang_share", {{}, 1.0})}, workshop).front().verdict == ShopVerdict::pass);
  workshop.measured = {upright, leaning};
  CHECK(judge_shop({rule_of("overhang_share", {{}, 1.0})}, workshop).front().verdict == ShopVerdict::fail);
}

TEST_CASE("shop rules: every shipped rule of a shop can be kept, and can be broken") {
  std::size_t rules = 0;
  for (const char* process : {"plate", "print", "timber"}) {
    for (const Rule& rule : testing::rules_named(std::string("shop-") + process)) {
      INFO(rule.id);
      ++rules;
      REQUIRE(rule_quantity(rule.quantity)->subject == RuleSubject::workshop);
      const auto verdict = [&](double value) {
        Workshop workshop;
        ShopMeasurement measured{
            rule_quantity(rule.quantity)->key, value, 1.0, Dimension::number, "here", 4e-3, 7850.0};
        for (const RuleCondition& condition : rule.when) {
          const double met = condition.range.lowest ? *condition.range.lowest : *condition.range.highest;
          (condition.quantity == "part_thickness" ? measured.thickness : measured.density) = met;
        }
        workshop.measured = {measured};
        return judge_shop({rule}, workshop).front().verdict;
      };
      const double bound = rule.bound.lowest ? *rule.bound.lowest : *rule.bound.highest;
      const double sense = rule.bound.lowest ? 1.0 : -1.0;
      const double step = 0.01 * std::fabs(bound) + 1e-6;
      CHECK(verdict(bound + sense * step) == ShopVerdict::pass);
      CHECK(verdict(bound - sense * step) == (rule.advice ? ShopVerdict::warn : ShopVerdict::fail));
    }
  }
  CHECK(rules > 30);
}

TEST_CASE(
    "shop rules: a process brings its own; a design adds, replaces, leaves out and takes sets of its own") {
  const TempDir place;
  put_bytes(place / "ours.yaml",
            "glissade_rules: 1\nname: ours\nrules:\n"
            "  - {id: ours.hole, sentence: S., quantity: hole_thicknesses, lowest: 2, source: us}\n");
  const auto rules = [&](const std::string& group) {
    return parse_design(design_with(group), place / "d.yaml").fabrication->rules.in_force;
  };
  const std::size_t shipped = testing::rules_named("shop-plate").size();
  CHECK(rules("{}").size() == shipped);
  CHECK(rules("{sets: []}").empty());
  CHECK(rules("{sets: [shop-plate, ours.yaml]}").size() == shipped + 1);
  CHECK(rules("{leave_out: [plate.web]}").size() == shipped - 1);
  const std::vector<Rule> replaced = rules(
      "{own: [{id: plate.hole-diameter, sentence: S., quantity: hole_thicknesses, lowest: 3, source: our "
      "laser}]}");
  CHECK(replaced.size() == shipped);
  const Design design = parse_design(
      design_with("{own: [{id: plate.hole-diameter, sentence: S., quantity: hole_thicknesses, lowest: 3, "
                  "source: our laser}], leave_out: [plate.web]}"),
      "d.yaml");
  const Assembly assembly = assemble(design, solve(design), {}, {.report = false});
  const ShopCheck check = testing::check_of(assembly.fabrication->workshop.checks, "plate.hole-diameter");
  CHECK(check.verdict == ShopVerdict::fail);
  CHECK(check.value == "11 mm");
  CHECK(check.bound == "at least 18 mm");
  CHECK(testing::check_of(assembly.fabrication->workshop.checks, "plate.web").rule.empty());
  const Design again = parse_design(design_text(design), "d.yaml");
  CHECK(again.fabrication == design.fabrication);
}

TEST_CASE(
    "shop rules: a gap between bolts that is too wide is told, however near each has another neighbour") {
  // Below a floor of 200 mm one gap of 259 mm; up the walls of 120 mm the next bolts are half as far.
  const Design design = parse_design(
      "glissade: 1\n"
      "track: {start: {x: 2 m, z: 6.2 m}, finish: {x: 7.4 m, z: 1.1 m}}\n"
      "body: {friction_angle: 17 deg}\n"
      "cross_section: {kind: u-channel, width: 200 mm, wall_height: 120 mm, thickness: 4 mm}\n"
      "fabrication: {process: plate, flanges: {width: 50 mm, thickness: 6 mm, bolt: M10, pitch: 300 mm},\n"
      "  rules: {own: [{id: own.pitch, sentence: S., quantity: bolt_pitch, lowest: 140 mm, source: us}]}}\n",
      "d.yaml");
  const Assembly assembly = assemble(design, solve(design), {}, {.report = false});
  const std::vector<ShopCheck>& checks = assembly.fabrication->workshop.checks;
  const ShopCheck widest = testing::check_of(checks, "plate.bolt-pitch");
  CHECK(widest.verdict == ShopVerdict::warn);
  CHECK(widest.value == "259 mm");
  CHECK(widest.bound == "at most 150 mm");
  CHECK_THAT(widest.where, Contains("end_frame"));
  const ShopCheck least = testing::check_of(checks, "own.pitch");
  CHECK(least.verdict == ShopVerdict::fail);
  CHECK(least.value == "131.5 mm");
}

TEST_CASE("shop rules: rules of tracks among those of a workshop are refused, and the other way round") {
  CHECK_THAT(problems_of(design_with(
                 "{own: [{id: a, sentence: S., quantity: highest_speed, highest: 9 m/s, source: us}]}")),
             Contains("d.yaml:5:77: quantity: highest_speed is of tracks") &&
                 Contains("Try: the rule below rules:"));
  CHECK_THAT(problems_of(design_with("{sets: [playground-slide]}")),
             Contains("its rule en1176-3.steepest is not of this place"));
  CHECK_THAT(problems_of(design_with("{sets: [shop-plat]}")), Contains("Try: shop-plate"));
  CHECK_THAT(problems_of(design_with("{}") + "rules: {sets: [shop-plate]}\n"),
             Contains("its rule plate.sheet is not of this place") &&
                 Contains("Try: the set below fabrication: {rules: {sets: ...}}"));
}

TEST_CASE("shop rules: the floor's step at a joint is measured on the plates, rolled or bent, and is none") {
  for (const char* floor : {"rolled", "bent"}) {
    const Design design =
        parse_design(design_with("{}") + "export: [off]\n", "d.yaml",
                     {{"fabrication.floor", floor}, {"fabrication.split", "{longest: 2 m}"}});
    const Assembly assembly = assemble(design, solve(design), {}, {.report = false});
    std::size_t places = 0;
    for (const ShopMeasurement& measured : assembly.fabrication->workshop.measured) {
      if (measured.quantity != "step_up") continue;
      ++places;
      CHECK(measured.value == 0.0);
    }
    // Twice across the floor, and on each wall.
    CHECK(places == 4 * (assembly.fabrication->joints.size() - 2));
  }
}

}  // namespace shop_rules_test
