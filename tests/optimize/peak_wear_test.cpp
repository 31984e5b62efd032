// The least peak wear: closed forms of straight chutes, bounds from the other side, and neighbours.

#include "glissade/centerline/clothoid_spline.hpp"
#include "glissade/centerline/straight_line.hpp"
#include "glissade/core/math.hpp"
#include "glissade/motion/laws/bulk_stream.hpp"
#include "glissade/optimize/optimize.hpp"
#include "glissade/trades/chute/wear.hpp"

#include "optimize/ore.hpp"
#include "optimize/solved.hpp"
#include "support/catch.hpp"
#include "support/thorough.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <vector>

using namespace glissade;
using testing_problems::solved;

namespace {

/// Ore over a range of its friction, worn the least where it wears most.
Problem wearing(double run, double drop, double entry_speed) {
  Problem problem = testing_problems::ore(run, drop, entry_speed);
  problem.body.friction = Friction::from_angle(Angle::from_degrees(27.0));
  problem.low_friction = Friction::from_angle(Angle::from_degrees(24.0));
  problem.high_friction = Friction::from_angle(Angle::from_degrees(31.0));
  problem.objective.kind = ObjectiveKind::least_peak_wear;
  return problem;
}

/// Peak of the wear of a track over all frictions, by the trade's own survey; none where one does not arrive.
std::optional<double> peak_of(const Problem& problem, const CenterlinePtr& track) {
  std::vector<Motion> motions;
  for (const auto& friction :
       {problem.low_friction, std::optional(problem.body.friction), problem.high_friction}) {
    if (!friction) continue;
    Body body = problem.body;
    body.friction = *friction;
    motions.emplace_back(track, body, problem.gravity);
    if (!motions.back().arrived()) return std::nullopt;
  }
  std::vector<const Motion*> rides;
  for (const Motion& motion : motions) rides.push_back(&motion);
  return wear_of(rides).floor.value;
}

/// At one friction, which is quicker, where the range is not what a test is about.
Problem with_bends(double run, double drop, double entry_speed) {
  Problem problem = wearing(run, drop, entry_speed);
  problem.low_friction.reset();
  problem.high_friction.reset();
  problem.limits.entry_slope_angle = {1.05, 1.2};  // the feed comes down steeply
  problem.limits.exit_slope_angle = Range::fixed(0.62);
  problem.limits.concave = true;
  return problem;
}

/// The answer to with_bends(4.3, 5.9, 2.5): in several tests, solved once.
const Optimum& bent() {
  static const Optimum found = solved(with_bends(4.3, 5.9, 2.5));
  return found;
}

}  // namespace

TEST_CASE("peak wear: without crests no chute wears less at its peak than the straight one, in closed form") {
  for (const auto& [run, drop, speed] : {std::tuple{4.3, 5.9, 2.5}, {4.3, 3.4, 1.5}}) {
    Problem problem = wearing(run, drop, speed);
    problem.limits.concave = true;
    const Optimum found = solved(problem);
    // Q K_c mu g cos(alpha)/B at the highest friction: somewhere a track is no steeper than its chord.
    const auto& stream = dynamic_cast<const BulkStream&>(*problem.body.law);
    const double straight = stream.shape().mass_flow * stream.shape().slip_ratio *
                            problem.high_friction->coefficient() * problem.gravity * run /
                            math::hypot(run, drop) / 0.8;
    INFO(run << " x " << drop);
    CHECK(*peak_of(problem, found.centerline) == Approx(straight).epsilon(1e-4));
    CHECK(*peak_of(problem, found.centerline) >= straight * (1.0 - 1e-7));
    CHECK(found.report.objective.kind == ObjectiveKind::least_peak_wear);
  }
}

TEST_CASE(
    "peak wear: a fastest track with a corner, whose wear there knows no bound, hides no chute that wears "
    "little") {
  Problem problem = with_bends(8.78, 8.99, 1.75);
  problem.limits.concave = false;
  problem.limits.entry_slope_angle = {};
  problem.limits.exit_slope_angle = {0.538, 0.806};
  problem.limits.lead_in = 1.12;
  const Optimum found = solved(problem);
  const auto straight = std::make_shared<const StraightLine>(problem.endpoints);
  CHECK(found.report.message == "every limit holds, and no neighbouring track wears less at its peak");
  CHECK(*peak_of(problem, found.centerline) <= *peak_of(problem, straight) * (1.0 + 1e-4));
}

TEST_CASE("peak wear: the bound that the search keeps below is the least for which there is a track") {
  const Problem problem = with_bends(4.3, 5.9, 2.5);
  const Optimum& found = bent();
  const double peak = *peak_of(problem, found.centerline);
  Problem bounded = problem;
  bounded.objective.kind = ObjectiveKind::travel_time;
  bounded.limits.highest_floor_wear = peak * 1.001;
  const Optimum above = optimize(bounded);
  REQUIRE(above.centerline);
  CHECK(above.report.travel_time <= found.report.travel_time * (1.0 + 1e-6));
  if (testing::thorough()) {
    bounded.limits.highest_floor_wear = peak * 0.999;
    CHECK_FALSE(optimize(bounded).centerline);
  }
  // The fastest track within the same limits wears more where it wears most, and is never slower.
  bounded.limits.highest_floor_wear.reset();
  const Optimum fastest = solved(bounded);
  CHECK(*peak_of(problem, fastest.centerline) > 1.01 * peak);
  CHECK(fastest.report.travel_time <= found.report.travel_time * (1.0 + 1e-9));
}

TEST_CASE("peak wear: relaxed it is never more, and mirrored the same") {
  Problem problem = with_bends(4.3, 5.9, 2.5);
  const double peak = *peak_of(problem, bent().centerline);
  if (testing::thorough()) {
    Problem mirrored = problem;
    mirrored.endpoints.run = -problem.endpoints.run;
    CHECK(*peak_of(mirrored, solved(mirrored).centerline) == Approx(peak).epsilon(1e-4));
    Problem over_range = problem;
    over_range.high_friction = Friction::from_angle(Angle::from_degrees(31.0));
    CHECK(*peak_of(over_range, solved(over_range).centerline) >= peak * (1.0 - 1e-4));
  }
  problem.limits.exit_slope_angle = Range{0.6, 0.64};
  problem.limits.entry_slope_angle.lowest = 1.0;
  CHECK(*peak_of(problem, solved(problem).centerline) <= peak * (1.0 + 1e-4));
}

TEST_CASE("peak wear: prices are what a little less of a limit wins") {
  Problem problem = with_bends(4.3, 5.9, 2.5);
  const Optimum& found = bent();
  const double peak = *peak_of(problem, found.centerline);
  REQUIRE(!found.report.active.empty());
  bool seen = false;
  for (const ActiveLimit& active : found.report.active) {
    if (active.limit.id != LimitId::exit_slope_angle) continue;
    seen = true;
    constexpr double kStep = 2e-3;
    problem.limits.exit_slope_angle = Range::fixed(0.62 + kStep);
    const double steeper = *peak_of(problem, solved(problem).centerline);
    problem.limits.exit_slope_angle = Range::fixed(0.62 - kStep);
    const double flatter = *peak_of(problem, solved(problem).centerline);
    CHECK(std::fabs(steeper - flatter) / (2.0 * kStep) == Approx(active.price).epsilon(0.03));
    CHECK(std::min(steeper, flatter) < peak);
  }
  CHECK(seen);
}

TEST_CASE("peak wear: no neighbour that keeps the limits wears less at its peak") {
  const Problem problem = with_bends(4.3, 5.9, 2.5);
  const Optimum& found = bent();
  const double peak = *peak_of(problem, found.centerline);
  const double entry = found.centerline->slope_angle(0.0);
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  int neighbours = 0;
  const double length = found.centerline->length();
  const double exit = found.centerline->slope_angle(length);
  for (int i = 0; i < 200; ++i) {
    // The slope angle plus a random wave that leaves both ends as they are, then turned and stretched back to the finish.
    std::vector<double> wave(4);
    for (double& share : wave) share = 0.008 * normal(random);
    constexpr int kPieces = 400;
    const auto track_with = [&](double bow, double longer) {
      std::vector<ClothoidSegment> segments;
      const auto slope = [&](double sigma) {
        double angle =
            found.centerline->slope_angle(sigma * length) + bow * math::sin(2.0 * kRightAngle * sigma);
        for (std::size_t k = 0; k < wave.size(); ++k)
          angle += wave[k] * math::sin(2.0 * kRightAngle * static_cast<double>(k + 2) * sigma);
        return angle;
      };
      const double step = longer * length / kPieces;
      for (int k = 0; k < kPieces; ++k) {
        const double curvature = (slope(double(k) / kPieces) - slope(double(k + 1) / kPieces)) / step;
        segments.push_back({step, curvature, curvature});
      }
      return std::make_shared<const ClothoidSpline>(Angle::from_radians(slope(0.0)), segments);
    };
    double bow = 0.0;
    double longer = 1.0;
    CenterlinePtr track;
    for (int newton = 0; newton < 12; ++newton) {
      const auto miss = [&](double b, double l) {
        const Endpoints end = track_with(b, l)->endpoints();
        return Vec2{end.run - problem.endpoints.run, end.drop - problem.endpoints.drop};
      };
      const Vec2 off = miss(bow, longer);
      if (math::hypot(off.x, off.y) < 1e-9) break;
      constexpr double kStep = 1e-6;
      const Vec2 by_bow = (1.0 / kStep) * (miss(bow + kStep, longer) - off);
      const Vec2 by_length = (1.0 / kStep) * (miss(bow, longer + kStep) - off);
      const double det = cross(by_bow, by_length);
      bow -= cross(off, by_length) / det;
      longer -= cross(by_bow, off) / det;
    }
    track = track_with(bow, longer);
    bool concave = true;
    for (int k = 0; k <= 800; ++k)
      concave = concave && track->at(std::min(track->length(), track->length() * k / 800.0)).curvature >= 0.0;
    const double entry_now = track->slope_angle(0.0);
    if (!concave || entry_now < 1.05 - 1e-9 || std::fabs(track->slope_angle(track->length()) - exit) > 1e-9)
      continue;
    ++neighbours;
    const auto its = peak_of(problem, track);
    if (its) CHECK(*its >= peak * (1.0 - 1e-4));
  }
  CHECK(entry >= 1.05 - 1e-7);
  CHECK(neighbours > 5);
}
