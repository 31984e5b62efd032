#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/units.hpp"
#include "glissade/report/report.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>
#include <utility>

namespace glissade {
namespace {

constexpr int kDigits = 5;
constexpr int kReachedDigits = 4;
constexpr int kPlaceDigits = 3;

std::string value_text(double value, std::string_view unit, int digits) {
  if (!std::isfinite(value)) return "unbounded";
  // What an angle is off level by rounding is no angle.
  if (unit == "rad") return angle_text(std::fabs(value) < 1e-11 ? 0.0 : value, digits);
  if (unit == "m") return length_text(value, digits);
  std::string text = rounded_text(value, digits) + " " + std::string(unit);
  if (unit == "m/s^2") text += " (" + rounded_text(value / kStandardGravity, 3) + " g)";
  return text;
}

/// "slope_angle.highest" -> "slope angle", "keep_outs[0]" -> "keep-out 1"
std::string name_of(std::string key) {
  for (const std::string_view ending : {".lowest", ".highest"}) {
    if (key.ends_with(ending)) key.resize(key.size() - ending.size());
  }
  constexpr std::array<std::pair<std::string_view, std::string_view>, 3> kPlurals = {
      {{"keep_outs", "keep-out"}, {"half_planes", "half-plane"}, {"waypoints", "waypoint"}}};
  for (const auto& [plural, singular] : kPlurals) {
    if (key.starts_with(plural)) key.replace(0, plural.size(), singular);
  }
  std::replace(key.begin(), key.end(), '_', ' ');
  std::replace(key.begin(), key.end(), '.', ' ');
  const std::size_t bracket = key.find('[');
  if (bracket == std::string::npos) return key;
  // People count from one.
  const int index = std::stoi(key.substr(bracket + 1)) + 1;
  return key.substr(0, bracket) + " " + std::to_string(index);
}

/// What is asked for without a number: how it reads as a bound, and where it is kept.
std::optional<std::string> plain_words(const std::string& limit) {
  if (limit == "concave") return "no crest";
  if (limit == "finish") return "met";
  if (limit.starts_with("waypoints")) return "passed";
  if (limit.starts_with("arrival")) return "the body arrives";
  return {};
}

std::string bound_text(const LimitCheck& check) {
  if (const auto words = plain_words(check.limit)) return *words;
  const std::string_view side = check.side > 0 ? "at most " : check.side < 0 ? "at least " : "";
  return std::string(side) + value_text(check.value, check.unit, kDigits);
}

std::string reached_text(const LimitCheck& check) {
  const auto words = plain_words(check.limit);
  if (words && check.kept()) return *words;
  constexpr double kAlmostStraight = 1e6;
  const bool radius = check.limit.find("radius") != std::string::npos;
  if (radius && check.reached > kAlmostStraight * check.scale) return "straight";
  return value_text(check.reached, check.unit, kReachedDigits);
}

std::string places_text(const LimitCheck& check, const ActiveLimit* active) {
  if (active == nullptr || active->where.empty()) return "s = " + length_text(check.where, kPlaceDigits);
  constexpr std::size_t kMost = 3;
  std::string text = "s = ";
  for (std::size_t index = 0; index < std::min(active->where.size(), kMost); ++index) {
    const Stretch& stretch = active->where[index];
    if (index != 0) text += ", ";
    text += length_text(stretch.from, kPlaceDigits);
    if (stretch.to > stretch.from) text += " to " + length_text(stretch.to, kPlaceDigits);
  }
  return active->where.size() > kMost ? text + ", ..." : text;
}

void add_price(ReportLimit& row, const ActiveLimit& active, const std::string& objective_unit) {
  const bool angle = active.unit == "rad";
  row.price = angle ? active.price * (std::numbers::pi / 180.0) : active.price;
  row.price_unit = objective_unit + " per " + (angle ? "deg" : active.unit);
}

}  // namespace

std::vector<ReportLimit> report_limits(const std::vector<LimitCheck>& checks,
                                       const std::vector<ActiveLimit>& active,
                                       const std::string& objective_unit) {
  std::vector<ReportLimit> rows;
  for (const LimitCheck& check : checks) {
    const auto found = std::find_if(active.begin(), active.end(),
                                    [&](const ActiveLimit& one) { return one.limit == check.limit; });
    const ActiveLimit* const holding = check.kept() && found != active.end() ? &*found : nullptr;
    ReportLimit row;
    row.name = name_of(check.limit);
    row.bound = bound_text(check);
    row.reached = reached_text(check);
    row.where = places_text(check, holding);
    row.status = !check.kept() ? "violated" : holding != nullptr ? "active" : "kept";
    if (holding != nullptr) add_price(row, *holding, objective_unit);
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
  const double reach = math::hypot(way.x, way.y, way.z);
  for (const HalfPlaneDesign& side : limits.half_planes) {
    const Vec2 along{-side.forbidden.y * reach, side.forbidden.x * reach};
    add("half-plane",
        {{side.point.x - along.x, side.point.y - along.y}, {side.point.x + along.x, side.point.y + along.y}},
        true);
  }
  return areas;
}

}  // namespace glissade
