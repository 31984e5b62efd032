// Rules over a range of friction, gates and conditions, held against each single ride.

#include "glissade/design/design.hpp"
#include "glissade/pipeline.hpp"
#include "glissade/pipeline/json.hpp"
#include "glissade/pipeline/rules.hpp"

#include "support/catch.hpp"
#include "support/random.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace rule_extremes_test {

using namespace glissade;
using Catch::Matchers::Contains;
using nlohmann::json;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// What every ride has of a quantity, each for itself.
struct Values {
  std::vector<double> seen;
  bool lacking = false;
};
using ValuesByKey = std::map<std::string, Values>;

void add_ride(const Motion& motion, ValuesByKey& all) {
  all["highest_speed"].seen.push_back(motion.highest_speed().speed);
  all["highest_normal_load"].seen.push_back(motion.highest_load().normal_load);
  all["lowest_normal_load"].seen.push_back(motion.lowest_load().normal_load);
  if (motion.arrived()) {
    all["exit_speed"].seen.push_back(motion.exit_speed());
    all["travel_time"].seen.push_back(motion.travel_time());
    return;
  }
  all["exit_speed"].lacking = true;
  all["travel_time"].lacking = true;
  if (!motion.stall()) return;
  all["exit_speed"].seen.push_back(0.0);
  all["travel_time"].seen.push_back(kInfinity);
}

RuleVerdict expected(const Values& values, const Range& bound) {
  for (const double value : values.seen) {
    if (bound.lowest && value < *bound.lowest) return RuleVerdict::fail;
    if (bound.highest && value > *bound.highest) return RuleVerdict::fail;
  }
  return values.lacking || values.seen.empty() ? RuleVerdict::cannot_be_judged : RuleVerdict::pass;
}

/// Bounds of one side or both, around the values that there are.
Range random_bound(testing::Random& random, const Values& values) {
  double low = kInfinity;
  double high = -kInfinity;
  for (const double value : values.seen) {
    if (std::isinf(value)) continue;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  if (low > high) low = high = 1.0;
  const double room = std::max(high - low, 0.1);
  const double one = random.between(low - room, high + room);
  const double other = random.between(low - room, high + room);
  switch (random.integer(0, 2)) {
    case 0:
      return {one, {}};
    case 1:
      return {{}, one};
    default:
      return {std::min(one, other), std::max(one, other)};
  }
}

Rule rule_of(const std::string& quantity, const Range& bound) {
  Rule rule;
  rule.id = "test." + quantity;
  rule.sentence = "A sentence.";
  rule.quantity = quantity;
  rule.bound = bound;
  rule.source = "this test";
  return rule;
}

/// @return how many rules were kept, broken and not to be judged
std::map<RuleVerdict, int> compare(testing::Random& random, const Design& design, const Track& track,
                                   const ValuesByKey& all) {
  std::map<RuleVerdict, int> told;
  const Measurements measurements = rule_measurements(design, track);
  for (const auto& [key, values] : all) {
    INFO(key);
    const Extremes* const extremes = measurements.find(key);
    REQUIRE(extremes != nullptr);
    CHECK(extremes->missing().has_value() == values.lacking);
    REQUIRE(extremes->least().has_value() == !values.seen.empty());
    if (!values.seen.empty()) {
      const auto [least, most] = std::minmax_element(values.seen.begin(), values.seen.end());
      CHECK(extremes->least()->value == Approx(*least).epsilon(1e-9));
      CHECK(extremes->most()->value == Approx(*most).epsilon(1e-9));
    }
    for (int i = 0; i < 6; ++i) {
      const Range bound = random_bound(random, values);
      INFO(bound.lowest.value_or(-kInfinity) << " to " << bound.highest.value_or(kInfinity));
      const Judgement judgement = judge({rule_of(key, bound)}, measurements).front();
      CHECK(judgement.verdict == expected(values, bound));
      if (judgement.verdict == RuleVerdict::fail)
        CHECK((judgement.bound_is_highest ? *judgement.value > *bound.highest
                                          : *judgement.value < *bound.lowest));
      ++told[judgement.verdict];
    }
  }
  return told;
}

void add_up(std::map<RuleVerdict, int>& sum, const std::map<RuleVerdict, int>& more) {
  for (const auto& [verdict, count] : more) sum[verdict] += count;
}

Judgement judged(const std::string& text, const std::string& id) {
  const Design design = parse_design(text, "d.yaml");
  for (const Judgement& one : judge_rules(design, solve(design))) {
    if (one.rule.id == id) return one;
  }
  FAIL("no rule " + id);
  return {};
}

/// 5 m of drop over 10 m, and rules of its own.
std::string straight(const std::string& rules) {
  return "glissade: 1\ntrack: {start: {x: 0 m, z: 5 m}, finish: {x: 10 m, z: 0 m}}\n"
         "body: {friction_coefficient: {low: 0.1, nominal: 0.2, high: 0.4}}\ncenterline: {kind: straight}\n"
         "rules: {own: [" +
         rules + "]}\n";
}

/// At high friction it stalls after some 6.7 m.
std::string with_stall(const std::string& rules, const std::string& friction) {
  return "glissade: 1\ntrack: {start: {x: 0 m, z: 5 m}}\nbody: {friction_coefficient: " + friction +
         "}\ncenterline: {kind: segments, entry_slope_angle: 35 deg, segments: [{length: 3 m}, {radius: 5 m, "
         "to_slope_angle: 3 deg}, {length: 7 m}]}\nrules: {own: [" +
         rules + "]}\n";
}

std::string own(const std::string& quantity, const std::string& bounds) {
  return "{id: o." + quantity + ", sentence: S., quantity: " + quantity + ", " + bounds + ", source: me}";
}

std::string hill(const std::string& body, const std::string& gates, const std::string& rules) {
  return "glissade: 1\ntrack: {edge: {x: 0 m, z: 0 m}}\nbody: {" + body +
         "}\ncenterline: {kind: in-run, gamma: 35 deg, alpha: 11 deg, r1: 103 m, t: 6.9 m, e1: 96 m, es: 24 "
         "m}\ngates: {" +
         gates + "}\nrules: {sets: [], own: [" + rules + "]}\n";
}

}  // namespace

TEST_CASE("a rule with a lower bound is judged by the least value of a range of friction") {
  // sqrt(2 g (5 - mu 10)), and the time 2 s/u of an even acceleration
  const double slow = std::sqrt(2.0 * 9.81 * (5.0 - 0.4 * 10.0));
  const double fast = std::sqrt(2.0 * 9.81 * (5.0 - 0.1 * 10.0));
  const Judgement exit = judged(straight(own("exit_speed", "lowest: 5 m/s")), "o.exit_speed");
  CHECK(exit.verdict == RuleVerdict::fail);
  CHECK(*exit.value == Approx(slow).epsilon(1e-12));
  CHECK(exit.place == "high friction");
  CHECK(*exit.margin == Approx(slow - 5.0).epsilon(1e-9));
  const Judgement time = judged(straight(own("travel_time", "lowest: 2.8 s")), "o.travel_time");
  CHECK(time.verdict == RuleVerdict::fail);
  CHECK(*time.value == Approx(2.0 * std::hypot(5.0, 10.0) / fast).epsilon(1e-12));
  CHECK(time.place == "low friction");
  CHECK(judged(straight(own("highest_speed", "lowest: 5 m/s")), "o.highest_speed").verdict ==
        RuleVerdict::fail);
  // Both sides of a window count; the one that is told is the one that is broken.
  const std::string window = own("exit_speed", "lowest: 5 m/s, highest: 9 m/s");
  CHECK(judged(straight(window), "o.exit_speed").value == exit.value);
  const Judgement kept = judged(straight(own("exit_speed", "lowest: 4 m/s, highest: 9 m/s")), "o.exit_speed");
  CHECK(kept.verdict == RuleVerdict::pass);
  CHECK(*kept.value == Approx(fast).epsilon(1e-12));
  CHECK(kept.place == "low friction");
  CHECK(kept.bound_is_highest);
  const Judgement narrow =
      judged(straight(own("exit_speed", "lowest: 4.9 m/s, highest: 8.8 m/s")), "o.exit_speed");
  CHECK(narrow.verdict == RuleVerdict::fail);
  CHECK_FALSE(narrow.bound_is_highest);  // 0.47 m/s too slow, 0.06 m/s too fast
}

TEST_CASE("a ride that does not arrive lets no rule on arriving pass") {
  const std::string range = "{low: 0.1, nominal: 0.2, high: 0.4}";
  const auto verdict = [&](const char* quantity, const char* bounds, const std::string& friction) {
    return judged(with_stall(own(quantity, bounds), friction), std::string("o.") + quantity);
  };
  const Judgement late = verdict("travel_time", "highest: 5 s", range);
  CHECK(late.verdict == RuleVerdict::fail);
  CHECK(late.value == kInfinity);
  CHECK(late.place == "high friction: stalled");
  CHECK(*late.arc_length == Approx(6.671).epsilon(1e-3));
  CHECK(measured_text(late) == "unbounded at 6.671 m (high friction: stalled)");
  const Judgement slow = verdict("exit_speed", "lowest: 1 m/s", range);
  CHECK(slow.verdict == RuleVerdict::fail);
  CHECK(slow.value == 0.0);
  const char* const reason = " needs rides that arrive (high friction: stalled at 6.671 m)";
  const Judgement early = verdict("travel_time", "lowest: 1 s", range);
  CHECK(early.verdict == RuleVerdict::cannot_be_judged);
  CHECK(early.reason == std::string("the travel time") + reason);
  const Judgement fast = verdict("exit_speed", "highest: 9 m/s", range);
  CHECK(fast.verdict == RuleVerdict::cannot_be_judged);
  CHECK(fast.reason == std::string("the speed at the finish") + reason);
  // What another ride breaks is broken.
  CHECK(verdict("exit_speed", "highest: 2 m/s", range).verdict == RuleVerdict::fail);
  CHECK(verdict("travel_time", "lowest: 1 s", "0.4").reason ==
        "the travel time needs rides that arrive (stalled at 6.671 m)");
  // One that leaves the track has neither a speed nor a time: nothing of it is broken.
  const Judgement flies = judged(
      "glissade: 1\ntrack: {start: {x: 0 m, z: 9 m}}\nbody: {friction_coefficient: 0.2, entry_speed: 5 "
      "m/s}\ncenterline: {kind: segments, entry_slope_angle: 30 deg, segments: [{length: 2 m}, {length: 0.5 "
      "m, "
      "radius: -1 m}]}\nrules: {own: [" +
          own("exit_speed", "lowest: 1 m/s") + "]}\n",
      "o.exit_speed");
  CHECK(flies.verdict == RuleVerdict::cannot_be_judged);
  CHECK(flies.reason == "the speed at the finish needs rides that arrive (lifted off at 2 m)");
  // How fast it was on its way is known.
  CHECK(verdict("highest_speed", "highest: 9 m/s", range).verdict == RuleVerdict::pass);
  const Design design = parse_design(with_stall(own("travel_time", "highest: 5 s"), range), "d.yaml");
  const json told = json::parse(track_json(design, solve(design)))["rules"][0];
  CHECK(told["verdict"] == "fail");
  CHECK(told["value"].is_null());
  CHECK(told["place"] == "high friction: stalled");
}

TEST_CASE("rules over random ranges of friction say what each single ride does") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  std::map<RuleVerdict, int> told;
  for (int i = 0; i < 40; ++i) {
    const double slope = random.between(25.0, 45.0);
    const double low = random.between(0.02, 0.2);
    const double nominal = low + random.between(0.01, 0.2);
    const double high = nominal + random.between(0.01, 0.25);
    const std::string body =
        fmt::format("{{friction_coefficient: {{low: {}, nominal: {}, high: {}}}, entry_speed: {} m/s}}", low,
                    nominal, high, random.between(0.0, 3.0));
    const std::string text = fmt::format(
        "glissade: 1\ntrack: {{start: {{x: 0 m, z: 5 m}}}}\nbody: {}\ncenterline: {{kind: segments, "
        "entry_slope_angle: {} deg, segments: [{{length: 2 m}}, {{radius: {} m, to_slope_angle: {} deg}}, "
        "{{length: {} m}}]}}\n",
        body, slope, random.between(2.0, 6.0), random.between(1.0, 6.0), random.between(1.0, 8.0));
    INFO(text);
    const Design design = parse_design(text, "d.yaml");
    const Track track = solve(design);
    ValuesByKey all;
    for (const double friction : {low, nominal, high}) {
      Body ridden = body_of(design);
      ridden.friction = Friction::from_coefficient(friction);
      add_ride(Motion(track.centerline, ridden, design.gravity), all);
    }
    add_up(told, compare(random, design, track, all));
  }
  for (const RuleVerdict verdict : {RuleVerdict::pass, RuleVerdict::fail, RuleVerdict::cannot_be_judged})
    CHECK(told[verdict] > 10);
}

TEST_CASE("rules over random gates, conditions and ranges say what each single ride does") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  std::map<RuleVerdict, int> told;
  for (int i = 0; i < 8; ++i) {
    const double low = random.between(0.01, 0.03);
    const double nominal = low + random.between(0.0, 0.02);
    const double high = nominal + random.between(0.0, 0.05);
    // Some conditions hold the body at its gate.
    const double rough = i % 3 == 0 ? 0.75 : random.between(0.02, 0.1);
    const double wind = random.between(-4.0, 4.0);
    const std::string text =
        hill(fmt::format("friction_coefficient: {{low: {}, nominal: {}, high: {}}}, drag: 0.0013 1/m", low,
                         nominal, high),
             fmt::format("count: {}, slow: {{friction_coefficient: {}}}, fast: {{head_wind: {} m/s}}",
                         random.integer(1, 4), rough, wind),
             "");
    INFO(text);
    const Design design = parse_design(text, "d.yaml");
    const Track track = solve(design);
    Body slow = body_of(design);
    slow.friction = Friction::from_coefficient(rough);
    Body fast = body_of(design);
    fast.head_wind = wind;
    ValuesByKey all;
    Values& highest = all["highest_take_off_speed"];
    Values& lowest = all["lowest_take_off_speed"];
    Body slippery = body_of(design);
    slippery.friction = Friction::from_coefficient(low);
    Body rougher = body_of(design);
    rougher.friction = Friction::from_coefficient(high);
    // Of the range, too: that conditions are given takes no ride from any gate.
    for (const Body& body : {body_of(design), slow, fast, slippery, rougher}) {
      std::vector<double> speeds;
      for (const Gate& gate : track.gates->gates) {
        const Motion motion = ride_from(track.centerline, gate.from_start, body, design.gravity);
        add_ride(motion, all);
        speeds.push_back(motion.arrived() ? motion.exit_speed() : 0.0);
        lowest.lacking = lowest.lacking || !motion.arrived();
      }
      highest.lacking = highest.lacking || speeds.back() == 0.0;
      highest.seen.push_back(*std::max_element(speeds.begin(), speeds.end()));
      lowest.seen.push_back(*std::min_element(speeds.begin(), speeds.end()));
    }
    for (const double friction : {low, nominal, high}) {
      Body body = body_of(design);
      body.friction = Friction::from_coefficient(friction);
      const Motion motion(track.centerline, body, design.gravity);
      add_ride(motion, all);
    }
    add_up(told, compare(random, design, track, all));
  }
  for (const RuleVerdict verdict : {RuleVerdict::pass, RuleVerdict::fail, RuleVerdict::cannot_be_judged})
    CHECK(told[verdict] > 10);
}

TEST_CASE("gates neither hide the range of friction nor go unseen by speeds and times") {
  const std::string body =
      "friction_coefficient: {low: 0.02, nominal: 0.03, high: 0.05}, drag: 0.0013 1/m, centre_height: 0.6 m, "
      "head_wind: 1 m/s";
  const std::string gates = "count: 9, slow: {friction_coefficient: 0.06}, fast: {head_wind: -1 m/s}";
  const auto verdict = [&](const char* quantity, const char* bounds) {
    return judged(hill(body, gates, own(quantity, bounds)), std::string("o.") + quantity);
  };
  const Judgement load = verdict("highest_normal_load", "highest: 16.775 m/s^2");
  CHECK(load.verdict == RuleVerdict::fail);
  CHECK(load.place == "gate 9, low friction");
  CHECK(*load.value == Approx(16.784).epsilon(1e-4));
  const Judgement slow = verdict("exit_speed", "lowest: 24 m/s");
  CHECK(slow.verdict == RuleVerdict::fail);
  CHECK(slow.place == "gate 1, slow");
  CHECK(slow.value == verdict("lowest_take_off_speed", "lowest: 24 m/s").value);
  const Judgement late = verdict("travel_time", "highest: 7 s");
  CHECK_THAT(late.place, Contains("slow"));
  // The highest gate is slowest, too, in one of its conditions.
  const Judgement high = verdict("highest_take_off_speed", "lowest: 26.5 m/s");
  CHECK(high.verdict == RuleVerdict::fail);
  CHECK(high.place == "gate 9, slow");
  CHECK(verdict("highest_take_off_speed", "highest: 20 m/s").place == "gate 9, low friction");
  CHECK(judged(hill("friction_coefficient: 0.03", "count: 9", own("exit_speed", "highest: 20 m/s")),
               "o.exit_speed")
            .place == "gate 9");
}

TEST_CASE("conditions that are given take no gate's ride of the range of friction from what is judged") {
  const std::string body = "friction_coefficient: {low: 0.02, nominal: 0.03, high: 0.09}, drag: 0.0013 1/m";
  const auto verdict = [&](const std::string& conditions, const char* quantity, const char* bounds) {
    return judged(hill(body, "count: 9" + conditions, own(quantity, bounds)), std::string("o.") + quantity);
  };
  const std::string mild = ", slow: {friction_coefficient: 0.035}, fast: {friction_coefficient: 0.028}";
  for (const char* const quantity : {"lowest_take_off_speed", "exit_speed"}) {
    const Judgement ends = verdict("", quantity, "lowest: 24 m/s");
    const Judgement given = verdict(mild, quantity, "lowest: 24 m/s");
    CHECK(ends.place == "gate 1, slow");
    CHECK(given.place == "gate 1, high friction");
    CHECK(given.value == ends.value);
    CHECK(given.verdict == ends.verdict);
  }
  CHECK(verdict(mild, "travel_time", "highest: 5 s").value ==
        verdict("", "travel_time", "highest: 5 s").value);
  // One of them alone leaves the other end to its condition.
  CHECK(verdict(", slow: {friction_coefficient: 0.035}", "highest_take_off_speed", "highest: 20 m/s").place ==
        "gate 9, fast");
  // A rule is judged over what no table shows.
  const Design design = parse_design(hill(body, "count: 9" + mild, ""), "d.yaml");
  const GateTable table = *solve(design).gates;
  CHECK(table.conditions.size() == 3);
  REQUIRE(table.range.size() == 2);
  CHECK(table.range.front().rides.size() == 9);
}

TEST_CASE("steps of gates are held against both sides") {
  // On an arc equal steps along the track are none in height.
  const auto verdict = [](const char* bounds) {
    return judged(
        std::string("glissade: 1\ntrack: {start: {x: 0 m, z: 50 m}}\nbody: {friction_coefficient: 0.03}\n"
                    "centerline: {kind: segments, entry_slope_angle: 40 deg, segments: [{radius: 50 m, "
                    "to_slope_angle: 20 deg}, {length: 20 m}]}\ngates: {count: 5, start_area: 16 m}\n"
                    "rules: {own: [") +
            own("gate_step_height", bounds) + "]}\n",
        "o.gate_step_height");
  };
  const Judgement large = verdict("highest: 2.5 m");
  const Judgement small = verdict("lowest: 2 m");
  CHECK(large.verdict == RuleVerdict::pass);
  CHECK(small.verdict == RuleVerdict::fail);
  CHECK(*small.value < *large.value - 0.3);
}

TEST_CASE("a stream's rules hold both sides over every friction and flow") {
  const auto chute = [](const std::string& friction, const std::string& surge, const std::string& rules) {
    return "glissade: 1\ntrack: {start: {x: 0 m, z: 4 m}, finish: {x: 3 m, z: 1.3 m}}\nbody: "
           "{friction_angle: " +
           friction +
           ", entry_speed: 1 m/s}\nstream: {mass_flow: 246.24 t/h, bulk_density: 1600 kg/m^3, "
           "lateral_pressure_ratio: 0.6, lump_size: 50 mm, trickle: 0.5, surge: " +
           surge +
           "}\ncenterline: {kind: straight}\ndischarge: {belt_speed: 3 m/s, drop: 300 mm}\n"
           "cross_section: {kind: u-channel, width: 300 mm, wall_height: 900 mm, thickness: 8 mm}\nrules: "
           "{sets: [chute], own: [" +
           rules + "]}\n";
  };
  const std::string range = "{low: 28 deg, nominal: 29.5 deg, high: 31 deg}";
  // The stream is thinnest where a trickle is fastest: with little friction, at the finish.
  const Design design = parse_design(chute(range, "1.5", own("depth_over_width", "lowest: 0.09")), "d.yaml");
  const Track track = solve(design);
  Body trickle = with_flow(body_of(design), 0.5);
  trickle.friction = Friction::from_angle(Angle::from_degrees(28.0));
  const Motion thinnest(track.centerline, trickle, design.gravity);
  const double depth = 0.5 * 246.24 / 3.6 / (1600.0 * 0.3 * thinnest.exit_speed()) / 0.3;
  const auto find = [](const std::vector<Judgement>& all, const std::string& id) {
    return *std::find_if(all.begin(), all.end(), [&](const Judgement& one) { return one.rule.id == id; });
  };
  const std::vector<Judgement> all = judge_rules(design, track);
  const Judgement thin = find(all, "o.depth_over_width");
  CHECK(*thin.value == Approx(depth).epsilon(1e-9));
  CHECK(thin.place == "low friction, trickle flow");
  CHECK(thin.verdict == (depth < 0.09 ? RuleVerdict::fail : RuleVerdict::pass));
  CHECK(find(all, "chute.7.depth").place == "high friction, surge flow");
  // Of the belt both sides: each rule by the case that is nearest to breaking it.
  const auto belt = [&](const char* bounds) {
    return judged(chute(range, "1.5", own("belt_match", bounds)), "o.belt_match");
  };
  const Judgement fast = belt("highest: 5");
  const Judgement slow = belt("lowest: 0.01");
  CHECK_THAT(fast.place, Contains("low friction"));
  CHECK_THAT(slow.place, Contains("high friction"));
  CHECK(*slow.value < *fast.value);
  // One case chokes: what only streams that arrive have cannot be judged, unless another one breaks it.
  const Judgement wear = judged(chute(range, "2", ""), "chute.9.wear");
  CHECK(wear.verdict == RuleVerdict::cannot_be_judged);
  CHECK_THAT(wear.reason, Contains("needs rides that arrive (high friction, surge flow: choked at "));
  CHECK(judged(chute(range, "2", own("wear_peak", "highest: 0.5")), "o.wear_peak").verdict ==
        RuleVerdict::fail);
}

}  // namespace rule_extremes_test
