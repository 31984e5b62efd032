#include "glissade/report/report.hpp"

#include "support/catch.hpp"

#include <limits>
#include <numbers>
#include <vector>

using namespace glissade;

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

std::vector<LimitCheck> checks_with_exit_slope(double violation) {
  return {{{LimitId::exit_slope_angle, Bound::highest},
           11.0 * kDegree,
           11.0 * kDegree + violation,
           violation,
           1.0,
           91.2},
          {{LimitId::smallest_valley_radius, Bound::lowest}, 3.0, 3.5, 0.0, 1.0, 4.0},
          {{LimitId::highest_normal_load, Bound::highest}, 19.6133, 18.0, 0.0, 9.81, 12.0},
          {{LimitId::keep_outs, Bound::lowest, 1}, 0.2, 0.25, 0.0, 100.0, 12.0},
          {{LimitId::concave, Bound::lowest}, 0.0, 1e-9, 0.0, 0.01, 12.0}};
}

const std::vector<ActiveLimit> kActive = {
    {{LimitId::exit_slope_angle, Bound::highest}, 11.0 * kDegree, {{91.2, 91.2}}, 0.5}};

}  // namespace

TEST_CASE("limits carry what the referee found, a name for people, and the price of an active one") {
  const std::vector<ReportLimit> rows = report_limits(checks_with_exit_slope(0.0), kActive);
  REQUIRE(rows.size() == 5);
  CHECK(rows[0].name == "exit slope angle");
  CHECK(rows[0].check.limit.key() == "exit_slope_angle.highest");
  CHECK(rows[0].status == "active");
  REQUIRE(rows[0].active);
  CHECK(rows[0].active->price == 0.5);
  CHECK(rows[1].status == "kept");
  CHECK_FALSE(rows[1].active);
  CHECK(rows[3].name == "keep-out");
  CHECK(rows[3].check.limit.key() == "keep_outs[1]");
}

TEST_CASE("a limit that is broken by more than the tolerance is violated, active or not, and has no price") {
  const ReportLimit broken = report_limits(checks_with_exit_slope(1e-3), kActive).front();
  CHECK(broken.status == "violated");
  CHECK_FALSE(broken.active);
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  CHECK(report_limits(checks_with_exit_slope(unknown), kActive).front().status == "violated");
}

TEST_CASE("keep-outs are drawn where the design has them, heights as the design counts them") {
  Design design;
  design.track.start = {2.0, 0.0, 10.0};
  design.track.finish = {12.0, 0.0, 4.0};
  CHECK(report_keep_outs(design).empty());
  design.limits.emplace();
  design.limits->keep_outs = {{{{5.0, 6.0}, {6.0, 6.0}, {6.0, 7.0}}, 0.0, Passage::either}};
  design.limits->stay_above = {{{{2.0, 3.0}, {12.0, 2.0}}, 0.1}};
  const std::vector<ReportKeepOut> areas = report_keep_outs(design);
  REQUIRE(areas.size() == 2);
  CHECK(areas[0].name == "keep_outs[0]");
  CHECK(areas[1].name == "stay_above[0]");
  CHECK_FALSE(areas[0].open);
  CHECK(areas[0].points.front() == Vec2{3.0, 6.0});
  CHECK(areas[1].open);
  CHECK(areas[1].points.back() == Vec2{10.0, 2.0});
}
