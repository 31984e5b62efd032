#include "glissade/core/number_text.hpp"
#include "glissade/report/report.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

namespace glissade {
namespace {

constexpr double kStandardGravity = 9.80665;
constexpr int kDigits = 5;

std::string value_text(double value, std::string_view unit) {
  if (unit == "rad") return angle_text(value, kDigits);
  if (unit == "m") return length_text(value, kDigits);
  std::string text = rounded_text(value, kDigits) + " " + std::string(unit);
  if (unit == "m/s^2") text += " (" + rounded_text(value / kStandardGravity, 3) + " g)";
  return text;
}

/// "slope_angle.highest" -> "slope angle"
std::string name_of(std::string key) {
  for (const std::string_view ending : {".lowest", ".highest"}) {
    if (key.ends_with(ending)) key.resize(key.size() - ending.size());
  }
  std::replace(key.begin(), key.end(), '_', ' ');
  return key;
}

std::string bound_text(const LimitCheck& check) {
  const bool at_most = check.limit.find("highest") != std::string::npos;
  const bool at_least = check.limit.find("lowest") != std::string::npos ||
                        check.limit.find("smallest") != std::string::npos ||
                        check.limit.find("clearance") != std::string::npos;
  return (at_most ? "at most " : at_least ? "at least " : "") + value_text(check.value, check.unit);
}

void add_price(ReportLimit& row, const ActiveLimit& active) {
  const bool angle = active.unit == "rad";
  row.price = angle ? active.price * (std::numbers::pi / 180.0) : active.price;
  row.price_unit = "s per " + (angle ? std::string("deg") : active.unit);
}

}  // namespace

std::vector<ReportLimit> report_limits(const OptimizeReport& report) {
  const double tolerance = OptimizeOptions{}.limit_tolerance;
  std::vector<ReportLimit> rows;
  for (const LimitCheck& check : report.checks) {
    ReportLimit row;
    row.name = name_of(check.limit);
    row.bound = bound_text(check);
    row.reached = value_text(check.reached, check.unit);
    row.where = "s = " + length_text(check.where);
    const auto active =
        std::find_if(report.active.begin(), report.active.end(),
                     [&](const ActiveLimit& candidate) { return candidate.limit == check.limit; });
    if (active != report.active.end()) add_price(row, *active);
    const bool violated = !(check.violation <= tolerance * check.scale);
    row.status = violated ? "violated" : active != report.active.end() ? "active" : "kept";
    rows.push_back(std::move(row));
  }
  return rows;
}

std::vector<ReportKeepOut> report_keep_outs(const Design& design) {
  std::vector<ReportKeepOut> areas;
  if (!design.limits) return areas;
  const double height = design.track.start.z;
  const auto in_profile = [&](Vec2 point) {
    const Vec2 plane = in_track_plane(design.track, point);
    return Vec2{plane.x, height - plane.y};
  };
  const auto add = [&](const std::string& name, const std::vector<Vec2>& points, bool open) {
    ReportKeepOut area{name, {}, open};
    for (const Vec2 point : points) area.points.push_back(in_profile(point));
    areas.push_back(std::move(area));
  };
  const LimitsDesign& limits = *design.limits;
  for (const KeepOutDesign& area : limits.keep_outs) add("keep-out", area.outline, false);
  for (const ProfileDesign& ground : limits.stay_above) add("stay above", ground.line, true);
  for (const ProfileDesign& ceiling : limits.stay_below) add("stay below", ceiling.line, true);
  const Vec3 way = design.track.finish - design.track.start;
  const double reach = std::hypot(way.x, way.y, way.z);
  for (const HalfPlaneDesign& side : limits.half_planes) {
    const Vec2 along{-side.forbidden.y * reach, side.forbidden.x * reach};
    add("half-plane",
        {{side.point.x - along.x, side.point.y - along.y}, {side.point.x + along.x, side.point.y + along.y}},
        true);
  }
  return areas;
}

}  // namespace glissade
