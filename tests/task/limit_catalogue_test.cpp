#include "glissade/task/limit_catalogue.hpp"

#include "glissade/core/error.hpp"
#include "glissade/motion/laws/bulk_stream.hpp"
#include "glissade/task/problem.hpp"

#include "support/catch.hpp"

#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <set>
#include <string>
#include <string_view>
#include <vector>

using namespace glissade;

TEST_CASE("every limit has one entry, found by its id, and a key of its own") {
  std::set<std::string_view> keys;
  for (const LimitEntry& entry : limit_catalogue()) {
    CAPTURE(std::string(entry.key));
    CHECK(&entry_of(entry.id) == &entry);
    CHECK(keys.insert(entry.key).second);
    CHECK_FALSE(entry.label.empty());
    CHECK(entry.least <= entry.most);
    CHECK((entry.form == LimitForm::range) == (entry.range != nullptr));
    CHECK((entry.form == LimitForm::value) == (entry.value != nullptr));
    CHECK((entry.form == LimitForm::length) == (entry.length != nullptr));
  }
}

TEST_CASE("a limit is named as in the design file, and for people who count from one") {
  CHECK(LimitName{LimitId::slope_angle, Bound::highest}.key() == "slope_angle.highest");
  CHECK(LimitName{LimitId::exit_speed, Bound::exactly}.key() == "exit_speed");
  CHECK(LimitName{LimitId::highest_normal_load, Bound::highest}.key() == "highest_normal_load");
  CHECK(LimitName{LimitId::keep_outs, Bound::lowest, 1}.key() == "keep_outs[1]");
  CHECK(LimitName{LimitId::finish_z, Bound::lowest}.key() == "finish.z.lowest");
  CHECK(LimitName{LimitId::keep_outs, Bound::lowest, 1}.label() == "keep-out 2");
  CHECK(LimitName{LimitId::slope_angle, Bound::highest}.label() == "slope angle");
}

TEST_CASE("every number among the limits is held against its entry's bounds") {
  for (const LimitEntry& entry : limit_catalogue()) {
    if (entry.range == nullptr && entry.value == nullptr && entry.length == nullptr) continue;
    CAPTURE(std::string(entry.key));
    const auto faults = [&](double value) {
      Limits limits;
      if (entry.range != nullptr) limits.*entry.range = {{}, value};
      if (entry.value != nullptr) limits.*entry.value = value;
      if (entry.length != nullptr) limits.*entry.length = value;
      return limit_faults(limits);
    };
    const double below = entry.least - 0.1;
    REQUIRE(faults(below).size() == 1);
    CHECK(faults(below)[0].issue.what.starts_with(std::string(entry.key)));
    CHECK_FALSE(faults(below)[0].issue.why.empty());
    CHECK_FALSE(faults(below)[0].issue.hint.empty());
    CHECK(faults(entry.least).size() == (entry.above_least && entry.length == nullptr ? 1U : 0U));
    CHECK(faults(entry.least + 0.1).empty());
    CHECK(faults(std::numeric_limits<double>::quiet_NaN()).size() == 1);
    CHECK(faults(std::numeric_limits<double>::infinity()).size() == 1);
  }
}

TEST_CASE("a range has its ends in order, and a lowest value that nothing falls below is none") {
  Limits limits;
  limits.slope_angle = {0.5, 0.25};
  const std::vector<LimitFault> faults = limit_faults(limits);
  REQUIRE(faults.size() == 1);
  CHECK(faults[0].key == "slope_angle");
  CHECK(faults[0].issue.what == "slope_angle: lowest 28.65 deg is above highest 14.32 deg");
  limits.slope_angle = {};
  limits.speed = {0.0, 4.0};
  CHECK(limit_faults(limits).empty());
  CHECK(range_of(entry_of(LimitId::speed), limits) == Range{{}, 4.0});
}

TEST_CASE("prices are told in the unit of the objective for a unit that people use") {
  const LimitName angle{LimitId::exit_slope_angle, Bound::highest};
  CHECK(price_text(std::numbers::pi / 180.0 * 180.0 / std::numbers::pi, angle, {}) == "0.0175 s per deg");
  CHECK(price_unit({LimitId::highest_normal_load, Bound::highest}, {ObjectiveKind::exit_speed}) ==
        "m/s per m/s^2");
}

TEST_CASE("a problem out of its bounds is refused in degrees, with what to try") {
  Problem problem;
  problem.endpoints = {10.0, 5.0};
  CHECK_NOTHROW(require_valid(problem));
  problem.limits.exit_slope_angle.highest = 100.0 * std::numbers::pi / 180.0;
  problem.limits.lead_in = -1.0;
  try {
    require_valid(problem);
    FAIL("it is valid");
  } catch (const InputError& error) {
    REQUIRE(error.issues().size() == 2);
    CHECK(error.issues()[0].what == "exit_slope_angle.highest: 100 deg is out of range");
    CHECK(error.issues()[0].hint == "at most 90 deg");
    CHECK(error.issues()[1].what == "lead_in: -1 m is out of range");
  }
}

TEST_CASE("a belt to match is held to its bounds, and what only a stream has is asked of a stream") {
  Problem problem;
  problem.endpoints = {10.0, 5.0};
  const auto refusal = [&] {
    try {
      require_valid(problem);
    } catch (const InputError& error) {
      CHECK_THROWS_AS(require_judgeable(problem), InputError);
      REQUIRE(error.issues().size() == 1);
      return error.issues()[0].what;
    }
    return std::string();
  };
  const auto matched = [&](double speed, double direction, double within) {
    problem.limits.match_belt = BeltMatch{speed, Angle::from_degrees(direction), within};
    return refusal();
  };
  CHECK(matched(2.5, 0.0, 0.1) == "");
  CHECK(matched(2.5, -90.0, 1.0) == "");
  CHECK(matched(0.0, 0.0, 0.1) == "match_belt.speed: 0");
  CHECK(matched(-2.0, 0.0, 0.1) == "match_belt.speed: -2");
  CHECK(matched(2.5, 0.0, 1.5) == "match_belt.within: 1.5");
  CHECK(matched(2.5, 0.0, 0.0) == "match_belt.within: 0");
  CHECK(matched(2.5, 100.0, 0.1) == "match_belt.direction: 100 deg");
  CHECK(matched(2.5, -400.0, 0.1) == "match_belt.direction: -400 deg");
  CHECK(matched(2.5, std::nan(""), 0.1) == "match_belt.direction: not a number");
  problem.limits.match_belt.reset();
  problem.limits.highest_burden_depth = 0.1;
  CHECK(refusal() == "highest_burden_depth: of a body that is no stream");
  problem.limits.highest_burden_depth.reset();
  problem.limits.highest_floor_wear = 10.0;
  CHECK(refusal() == "highest_floor_wear: of a body that is no stream");
  const StreamShape shape{200.0, 1600.0, 0.5, 1.0, {}};
  problem.body.law = std::make_shared<const BulkStream>(shape);
  CHECK(refusal() == "");
}

TEST_CASE("a problem's envelope and outlines are held to their bounds, outlines as those of a design are") {
  const auto refused = [](const Envelope& envelope, const std::vector<Vec2>& outline) -> std::string {
    Problem problem;
    problem.endpoints = {10.0, 5.0};
    problem.limits.envelope = envelope;
    problem.limits.keep_outs = {{outline}};
    try {
      require_valid(problem);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  const std::vector<Vec2> box = {{4.0, 0.0}, {5.0, 0.0}, {5.0, 1.0}, {4.0, 1.0}};
  CHECK(refused({0.1, 0.2, 0.3}, box).empty());
  CHECK_THAT(refused({-1.0, 0.0, 0.0}, box), contains_text("envelope.below: -1"));
  CHECK_THAT(refused({0.0, HUGE_VAL, 0.0}, box), contains_text("envelope.above: inf"));
  CHECK_THAT(refused({0.0, 0.0, std::nan("")}, box), contains_text("envelope.headroom: nan"));
  CHECK_THAT(refused({}, {{3.0, 4.0}, {5.0, 7.0}, {3.0, 7.0}, {5.0, 4.0}}),
             contains_text("keep_outs outline: the edges after corners 0 and 2 meet"));
  CHECK_THAT(refused({}, {{3.0, 4.0}, {3.0, 4.0}, {5.0, 7.0}}), contains_text("are the same point"));
  CHECK_THAT(refused({}, {{3.0, 4.0}, {5.0, 7.0}}), contains_text("2 corners"));
  CHECK_THAT(refused({}, {{3.0, 4.0}, {5.0, std::nan("")}, {3.0, 7.0}}),
             contains_text("corner 1 is out of range"));
}
