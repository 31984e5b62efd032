#include "glissade/trades/rules.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/design/design.hpp"
#include "glissade/design/rule_sets.hpp"
#include "glissade/design/template.hpp"
#include "glissade/design/write.hpp"
#include "glissade/pipeline.hpp"
#include "glissade/pipeline/profile_drawing.hpp"
#include "glissade/pipeline/rules.hpp"

#include "support/catch.hpp"
#include "support/paths.hpp"
#include "support/temp_dir.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <numbers>
#include <set>
#include <string>

using namespace glissade;
using Catch::Matchers::Contains;

namespace {

Rule rule_of(std::string quantity, Range bound, bool advice = false) {
  Rule rule;
  rule.id = "test." + quantity;
  rule.sentence = "A sentence.";
  rule.quantity = std::move(quantity);
  rule.bound = bound;
  rule.advice = advice;
  rule.source = "this test";
  return rule;
}

Judgement judged(const Rule& rule, const Measurements& measurements) {
  const std::vector<Judgement> judgements = judge({rule}, measurements);
  REQUIRE(judgements.size() == 1);
  return judgements.front();
}

Measurements speed_of(double speed) {
  Measurements measurements;
  measurements.see("exit_speed", speed, 5.0, "high friction");
  return measurements;
}

std::string problems_of_set(const std::string& text) {
  try {
    static_cast<void>(parse_rule_set(text, "own.yaml"));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

constexpr const char* kSet =
    "glissade_rules: 1\nname: own\nrules:\n"
    "  - {id: a, sentence: S., quantity: exit_speed, highest: 9 m/s, source: us}\n";

const std::string kDesign =
    "glissade: 1\nname: Slide\ntrack: {start: {x: 0 m, z: 3 m}, finish: {x: 5 m, z: 0 m}}\n"
    "body: {friction_angle: {low: 10 deg, nominal: 15 deg, high: 20 deg}}\ncenterline: {kind: straight}\n";

}  // namespace

TEST_CASE("a rule passes up to its bound, fails beyond it, and warns if it is advice") {
  const double inf = std::numeric_limits<double>::infinity();
  CHECK(judged(rule_of("exit_speed", {{}, 9.0}), speed_of(8.0)).verdict == RuleVerdict::pass);
  CHECK(judged(rule_of("exit_speed", {{}, 9.0}), speed_of(9.0)).verdict == RuleVerdict::pass);
  CHECK(judged(rule_of("exit_speed", {{}, 9.0}), speed_of(9.0 * (1.0 + 2.0 * kRuleAccuracy))).verdict ==
        RuleVerdict::fail);
  CHECK(judged(rule_of("exit_speed", {{}, 9.0}, true), speed_of(10.0)).verdict == RuleVerdict::warn);
  CHECK(judged(rule_of("exit_speed", {9.0, {}}), speed_of(8.0)).verdict == RuleVerdict::fail);
  CHECK(judged(rule_of("exit_speed", {{}, 9.0}), speed_of(inf)).verdict == RuleVerdict::fail);
  CHECK(judged(rule_of("exit_speed", {9.0, {}}), speed_of(inf)).verdict == RuleVerdict::pass);
}

TEST_CASE("a judgement tells value, place, the nearer bound and the margin to it") {
  const Judgement above = judged(rule_of("exit_speed", {4.0, 9.0}), speed_of(9.5));
  CHECK(above.verdict == RuleVerdict::fail);
  CHECK(above.value == 9.5);
  CHECK(above.bound == 9.0);
  CHECK(above.bound_is_highest);
  CHECK(above.margin == -0.5);
  CHECK(above.arc_length == 5.0);
  CHECK(above.place == "high friction");
  const Judgement within = judged(rule_of("exit_speed", {4.0, 9.0}), speed_of(4.5));
  CHECK(within.bound == 4.0);
  CHECK_FALSE(within.bound_is_highest);
  CHECK(within.margin == 0.5);
}

TEST_CASE("what nobody measured cannot be judged, and the reason names what is missing") {
  Measurements measurements;
  measurements.lack("hill_size", "hill: {size: 142 m}");
  const Judgement unknown = judged(rule_of("hill_size", {100.0, {}}), measurements);
  CHECK(unknown.verdict == RuleVerdict::cannot_be_judged);
  CHECK(unknown.reason == "the hill size HS needs hill: {size: 142 m}");
  CHECK_FALSE(unknown.value.has_value());
  CHECK(judged(rule_of("drop", {{}, 1.0}), measurements).reason ==
        "this track has no drop from start to finish");
  CHECK_THROWS_AS(measurements.see("gadgets", 1.0), InternalError);
}

TEST_CASE("a rule holds where its conditions do, and is left out elsewhere") {
  Rule rule = rule_of("exit_speed", {{}, 9.0});
  rule.when = {{"hill_size", {110.0, 184.0}}};
  Measurements measurements = speed_of(10.0);
  CHECK(judged(rule, measurements).verdict == RuleVerdict::cannot_be_judged);
  measurements.see("hill_size", 140.0);
  CHECK(judged(rule, measurements).verdict == RuleVerdict::fail);
  Measurements small = speed_of(10.0);
  small.see("hill_size", 100.0);
  CHECK(judge({rule}, small).empty());
}

TEST_CASE("each side of a rule is held against the extreme that would break it first") {
  Measurements measurements;
  measurements.see("exit_speed", 6.0, 5.0, "low friction");
  measurements.see("exit_speed", 5.0, 5.0, "nominal friction");
  measurements.see("exit_speed", 3.0, 4.0, "high friction");
  CHECK(judged(rule_of("exit_speed", {4.0, {}}), measurements).place == "high friction");
  CHECK(judged(rule_of("exit_speed", {4.0, {}}), measurements).verdict == RuleVerdict::fail);
  CHECK(judged(rule_of("exit_speed", {{}, 7.0}), measurements).place == "low friction");
  // Of two sides that are broken the one that is more so; of two that are kept the nearer one.
  const Judgement both = judged(rule_of("exit_speed", {3.5, 4.0}), measurements);
  CHECK(both.value == 6.0);
  CHECK(both.margin == -2.0);
  const Judgement kept = judged(rule_of("exit_speed", {2.5, 7.0}), measurements);
  CHECK(kept.verdict == RuleVerdict::pass);
  CHECK(kept.value == 3.0);
  CHECK(kept.arc_length == 4.0);
  // A side that is broken comes before one that its allowance keeps, however small its margin is.
  const Judgement tiny = judged(rule_of("exit_speed", {3.0 + 3.2e-6, 6.0 - 5.5e-6}), measurements);
  CHECK(tiny.verdict == RuleVerdict::fail);
  CHECK(tiny.value == 3.0);
}

TEST_CASE("where a ride lacks a quantity a rule on it is broken by the others, or cannot be judged") {
  Measurements measurements = speed_of(8.0);
  measurements.lack("exit_speed", "rides that arrive (low friction: lifted off at 3 m)");
  measurements.lack("exit_speed", "something else");
  const Judgement open = judged(rule_of("exit_speed", {{}, 9.0}), measurements);
  CHECK(open.verdict == RuleVerdict::cannot_be_judged);
  CHECK(open.reason == "the speed at the finish needs rides that arrive (low friction: lifted off at 3 m)");
  CHECK(open.value == 8.0);
  CHECK_FALSE(open.bound);
  const Judgement broken = judged(rule_of("exit_speed", {{}, 7.0}), measurements);
  CHECK(broken.verdict == RuleVerdict::fail);
  CHECK(broken.reason.empty());
  // No number is no value.
  Measurements nothing = speed_of(std::numeric_limits<double>::quiet_NaN());
  CHECK(judged(rule_of("exit_speed", {{}, 7.0}), nothing).reason == "speed at the finish is not known");
}

TEST_CASE("a condition on what rides differ in is met where one of them may meet it") {
  Measurements measurements = speed_of(8.0);
  measurements.see("exit_speed", 4.0);
  const auto met = [&](Range range) { return is_met({"exit_speed", range}, measurements); };
  CHECK(met({7.0, {}}) == true);
  CHECK(met({{}, 5.0}) == true);
  CHECK(met({9.0, {}}) == false);
  CHECK(met({{}, 3.0}) == false);
  measurements.lack("exit_speed", "rides that arrive");
  CHECK(met({7.0, {}}) == true);
  CHECK_FALSE(met({9.0, {}}).has_value());
  CHECK_FALSE(is_met({"hill_size", {1.0, {}}}, measurements).has_value());
}

TEST_CASE("the worst verdict is a failure, then a warning, then what cannot be judged") {
  const auto of = [](RuleVerdict verdict) {
    Judgement judgement;
    judgement.verdict = verdict;
    return judgement;
  };
  CHECK(worst({}) == RuleVerdict::pass);
  CHECK(worst({of(RuleVerdict::pass), of(RuleVerdict::cannot_be_judged)}) == RuleVerdict::cannot_be_judged);
  CHECK(worst({of(RuleVerdict::warn), of(RuleVerdict::cannot_be_judged)}) == RuleVerdict::warn);
  CHECK(worst({of(RuleVerdict::warn), of(RuleVerdict::fail), of(RuleVerdict::pass)}) == RuleVerdict::fail);
}

TEST_CASE("every file below lib/data/rules is carried by the program, and no rule claims a document unread") {
  std::set<std::string> in_folder;
  for (const auto& entry : std::filesystem::directory_iterator(designs_path("../lib/data/rules"))) {
    in_folder.insert(entry.path().stem().string());
    const RuleSet from_file = read_rule_set(entry.path());
    bool carried = false;
    for (const RuleSet& set : shipped_rule_sets()) {
      carried = carried || (set.name == from_file.name && set.rules == from_file.rules);
    }
    INFO(entry.path());
    CHECK(carried);
  }
  CHECK(in_folder.size() == shipped_rule_sets().size());
  CHECK(in_folder.size() >= 4);
  for (const RuleSet& set : shipped_rule_sets()) {
    CHECK(in_folder.contains(set.name));
    for (const Rule& rule : set.rules) {
      INFO(rule.id);
      // Nobody read a standard; what the design says is read.
      CHECK(needs_checking(rule.certainty) != rule.source.ends_with(" of the design"));
      CHECK(rule.source.size() > 10);
      CHECK(rule.sentence.ends_with('.'));
    }
  }
}

TEST_CASE("every problem of a file of rules is told at once, with its place and what to try") {
  CHECK(problems_of_set(kSet) == "");
  const std::string text = problems_of_set(
      "glissade_rules: 1\nname: own\nrules:\n"
      "  - {id: a, sentence: S., quantity: exit_sped, highest: 9 m/s, source: us}\n"
      "  - {id: b, sentence: S., quantity: exit_speed, highest: 9 deg, source: us}\n"
      "  - {id: b, sentence: S., quantity: exit_speed, source: us, certainty: sure}\n"
      "  - {id: c, sentence: S., quantity: exit_speed, lowest: 9 m/s, highest: 4 m/s}\n");
  CHECK_THAT(text,
             Contains("own.yaml:4:37: quantity: exit_sped is not known") && Contains("Try: exit_speed"));
  CHECK_THAT(text, Contains("own.yaml:5:") && Contains("is an angle, not a speed"));
  CHECK_THAT(text, Contains("id: b is given twice"));
  CHECK_THAT(text, Contains("has neither lowest nor highest") && Contains("Try: highest: 1 m/s"));
  CHECK_THAT(text, Contains("certainty: sure is not known"));
  CHECK_THAT(text, Contains("lowest: 9 m/s is above highest, 4 m/s"));
  CHECK_THAT(text, Contains("source is missing"));
  CHECK_THAT(problems_of_set("glissade_rules: 2\nname: own\nrules: []\n"), Contains("It reads version 1."));
  CHECK_THAT(problems_of_set("a: [\n"), Contains("own.yaml:1:4: not valid YAML"));
}

TEST_CASE("a design takes sets by name or file, adds rules, replaces them by their id and leaves some out") {
  const TempDir place;
  put_bytes(place / "own.yaml", kSet);
  const auto rules = [&](const std::string& group) {
    return parse_design(kDesign + "rules: " + group + "\n", place / "d.yaml").rules.in_force;
  };
  CHECK(parse_design(kDesign, place / "d.yaml").rules.in_force.empty());
  const std::size_t slide = rules("{sets: [playground-slide]}").size();
  CHECK(slide == 4);
  CHECK(rules("{sets: [playground-slide, own.yaml]}").size() == slide + 1);
  CHECK(rules("{sets: [playground-slide], leave_out: [en1176-3.mean]}").size() == slide - 1);
  const std::vector<Rule> replaced = rules(
      "{sets: [own.yaml], own: [{id: a, sentence: S., quantity: exit_speed, highest: 3 m/s, source: me}]}");
  REQUIRE(replaced.size() == 1);
  CHECK(replaced.front().bound.highest == 3.0);
  CHECK(replaced.front().certainty == Certainty::own);
}

TEST_CASE("a set that there is not, a rule that there is not and a faulty file are problems of the design") {
  const TempDir place;
  put_bytes(place / "bad.yaml", "glissade_rules: 1\nname: bad\nrules:\n  - {id: a}\n");
  const auto problems = [&](const std::string& group) -> std::string {
    try {
      static_cast<void>(parse_design(kDesign + "rules: " + group + "\n", place / "d.yaml"));
    } catch (const FileError& error) {
      return std::string("file: ") + error.what();
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  CHECK_THAT(problems("{sets: [playground-slid]}"),
             Contains("d.yaml:6:16") && Contains("Try: playground-slide"));
  CHECK_THAT(problems("{sets: [gone.yaml]}"),
             Contains("file: ") && Contains("gone.yaml: cannot read the file of rules: no such file"));
  CHECK_THAT(problems("{sets: [bad.yaml]}"), Contains("bad.yaml:4:5: sentence is missing"));
  CHECK_THAT(problems("{sets: [playground-slide], leave_out: [en1176-3.men]}"),
             Contains("no rule of this design has the id en1176-3.men") && Contains("Try: en1176-3.mean"));
}

TEST_CASE("rules are written back with the design") {
  const Design design = parse_design(
      kDesign +
          "rules: {sets: [playground-slide], leave_out: [en1176-3.mean], own: [{id: \"a: b\", sentence: S., "
          "quantity: highest_normal_load, lowest: 0.5 g, highest: 2 g, advice: true, when: [{quantity: drop, "
          "lowest: 2.5 m}], source: \"we, 2.3\", certainty: general-low}]}\n",
      "d.yaml");
  const Design again = parse_design(design_text(design), "d.yaml");
  CHECK(again.asks_the_same(design));
  CHECK(again.rules.in_force == design.rules.in_force);
}

TEST_CASE("what rules measure on a straight slide is what its formulas say, at the worst friction") {
  const Design design = parse_design(kDesign + "rules: {sets: [playground-slide]}\n", "d.yaml");
  const Track track = solve(design);
  const Measurements measurements = rule_measurements(design, track);
  const auto value = [&](std::string_view key) {
    REQUIRE(measurements.find(key) != nullptr);
    return measurements.find(key)->most()->value;
  };
  const double slope = std::atan2(3.0, 5.0);
  const double length = std::hypot(3.0, 5.0);
  CHECK(value("mean_slope_angle") == Approx(slope).epsilon(1e-14));
  CHECK(value("flattest_slope_angle") == Approx(slope).epsilon(1e-14));
  const auto speed_at = [&](double friction_deg) {
    const double mu = std::tan(friction_deg * std::numbers::pi / 180.0);
    return std::sqrt(2.0 * 9.81 * length * (std::sin(slope) - mu * std::cos(slope)));
  };
  CHECK(value("highest_speed") == Approx(speed_at(10.0)).epsilon(1e-12));
  CHECK(measurements.find("highest_speed")->most()->place == "low friction");
  CHECK(value("highest_normal_load") == Approx(9.81 * std::cos(slope)).epsilon(1e-12));
  CHECK(value("highest_radial_acceleration") == Approx(0.0).margin(1e-12));
  CHECK(std::isinf(value("smallest_valley_radius")));
  const std::vector<Judgement> judgements = judge_rules(design, track);
  REQUIRE(judgements.size() == 4);
  CHECK(judgements[0].verdict == RuleVerdict::pass);
  CHECK(judgements[2].rule.id == "en1176-3.run-out");
  CHECK(judgements[2].verdict == RuleVerdict::fail);
  CHECK(judgements[2].margin == Approx(10.0 * std::numbers::pi / 180.0 - slope).epsilon(1e-12));
}

namespace {

const Judgement& judgement_of(const std::vector<Judgement>& judgements, std::string_view id) {
  const auto found = std::find_if(judgements.begin(), judgements.end(),
                                  [&](const Judgement& one) { return one.rule.id == id; });
  REQUIRE(found != judgements.end());
  return *found;
}

}  // namespace

TEST_CASE("the load on a jumper is held against the weight on this table and the rule of r1") {
  for (const char* const file :
       {"hills/garmisch_hs142.yaml", "hills/lahti_hs130.yaml", "hills/wisla_hs134.yaml"}) {
    CAPTURE(file);
    const Design design = read_design(designs_path(file));
    const Track track = solve(design);
    const Measurements measurements = rule_measurements(design, track);
    REQUIRE(measurements.find("load_above_table_weight") != nullptr);
    const auto& load = measurements.find("highest_normal_load")->most();
    const auto& above = measurements.find("load_above_table_weight")->most();
    const double weight = design.gravity * std::cos(design.centerline.in_run.alpha.radians());
    CHECK(above->value == Approx(load->value - weight).epsilon(1e-9));
    CHECK(above->place == load->place);
    const std::vector<Judgement> judgements = judge_rules(design, track);
    const Judgement& judged = judgement_of(judgements, "fis.in-run.load");
    CHECK(judged.rule.bound.highest == Approx(1.0 / 0.14).epsilon(1e-12));
    // Sentence, value and bound are of one quantity, the load beyond the weight.
    CHECK(judged.rule.sentence.find("at most 1/0.14 m/s^2 (0.73 g) more than the weight") !=
          std::string::npos);
    CHECK((judged.verdict == RuleVerdict::pass) == (load->value <= weight + 1.0 / 0.14));
    // Where both are at E2 the load says what the radial acceleration does.
    CHECK(judged.verdict == judgement_of(judgements, "fis.in-run.radial-acceleration").verdict);
  }
}

TEST_CASE("one in-run has one ratio of the start area, whatever its e counts to") {
  const auto judged = [](const std::string& lengths) {
    const Design design = parse_design(
        "glissade: 1\ntrack: {edge: {x: 0 m, z: 0 m}}\nbody: {friction_coefficient: 0.03}\n"
        "centerline: {kind: in-run, gamma: 35 deg, alpha: 11 deg, r1: 60 m, t: 6.9 m, es: 33.1 m, " +
            lengths + "}\nhill: {size: 142 m}\ngates: {count: 49}\n",
        "d.yaml");
    return judgement_of(judge_rules(design, solve(design)), "fis.in-run.start-area");
  };
  const Judgement to_table = judged("e1: 96 m");
  const Judgement to_edge = judged("e1: 102.9 m, e_counts_to: edge");
  CHECK(*to_table.value == Approx(33.1 / 96.0).epsilon(1e-12));
  CHECK(*to_edge.value == Approx(*to_table.value).epsilon(1e-12));
  CHECK(to_edge.verdict == to_table.verdict);
}

TEST_CASE("the examples of docs/rules.md read as they stand") {
  const std::string page = bytes_of(designs_path("../docs/rules.md"));
  int designs = 0;
  int sets = 0;
  constexpr std::string_view kOpening = "```yaml\n";
  for (std::size_t at = page.find(kOpening); at != std::string::npos; at = page.find(kOpening, at)) {
    at += kOpening.size();
    const std::string block = page.substr(at, page.find("```", at) - at);
    INFO(block);
    if (block.starts_with("glissade_rules:")) {
      ++sets;
      CHECK(problems_of_set(block) == "");
    } else {
      ++designs;
      CHECK(parse_design(kDesign + block, "d.yaml").rules.in_force.size() == 4);
    }
  }
  CHECK(designs == 1);
  CHECK(sets == 1);
}

TEST_CASE("a value that breaks its bound by little does not read like it") {
  Rule rule;
  rule.id = "own.exit";
  rule.quantity = "exit_speed";
  rule.bound = {{}, 27.0665};
  for (const double excess : {1.0, 1e-2, 1e-3, 1e-4}) {
    Measurements measurements;
    measurements.see("exit_speed", 27.0665 + excess);
    const Judgement judgement = judge({rule}, measurements).front();
    CAPTURE(excess, measured_text(judgement), marked_bound_text(judgement));
    CHECK(judgement.verdict == RuleVerdict::fail);
    CHECK_THAT(marked_bound_text(judgement), !Contains(measured_text(judgement)));
  }
  Measurements kept;
  kept.see("exit_speed", 27.0664);
  CHECK(measured_text(judge({rule}, kept).front()) == "27.07 m/s");
}

TEST_CASE("how sure a bound is shows wherever the bound shows") {
  const Design design = read_design(designs_path("hills/garmisch_hs142.yaml"));
  const Track track = solve(design);
  const std::vector<Judgement> judgements = judge_rules(design, track);
  const TempDir place;
  write_verdicts_csv(place / "verdicts.csv", judgements);
  const std::string csv = bytes_of(place / "verdicts.csv");
  CHECK(csv.starts_with(
      "id,verdict,value,lowest,highest,unit,margin,where_m,place,quantity,sentence,source,certainty,"));
  CHECK_THAT(csv, Contains("fis.in-run.gamma,pass,35,,37,deg,") && Contains(",secondary,true,"));
  CHECK(std::count(csv.begin(), csv.end(), '\n') == static_cast<std::ptrdiff_t>(judgements.size()) + 1);
  std::string sheets;
  for (const Sheet& sheet : profile_sheets(design, track, {})) {
    for (const SheetTable& table : sheet.tables) {
      for (const std::vector<std::string>& row : table.rows) {
        for (const std::string& cell : row) sheets += cell + "\n";
      }
    }
  }
  for (const Judgement& judgement : judgements) {
    INFO(judgement.rule.id);
    CHECK(needs_checking(judgement.rule.certainty));
    CHECK_THAT(marked_bound_text(judgement),
               Contains(" [" + std::string(word(judgement.rule.certainty)) + "]"));
    CHECK_THAT(sheets, Contains(judgement.rule.id + "\n" + std::string(to_text(judgement.verdict)) + "\n" +
                                measured_text(judgement) + "\n" + bound_text(judgement.rule) + "\n" +
                                certainty_text(judgement.rule.certainty)));
  }
  CHECK_THAT(design_template("in-run"), Contains("Nobody read the bounds"));
}
