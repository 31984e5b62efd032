#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/quantity.hpp"
#include "glissade/core/units.hpp"
#include "glissade/report/report.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

namespace glissade {
namespace {

constexpr int kDigits = 5;
constexpr int kReachedDigits = 4;
constexpr int kPlaceDigits = 3;

std::string value_text(double value, Dimension dimension, int digits) {
  // What an angle is off level by rounding is no angle.
  if (dimension == Dimension::angle && std::fabs(value) < 1e-11) value = 0.0;
  std::string text = quantity_text(value, dimension, digits);
  if (dimension == Dimension::acceleration && std::isfinite(value)) {
    text += " (" + rounded_text(value / kStandardGravity, 3) + " g)";
  }
  return text;
}

std::string bound_text(const LimitCheck& check) {
  if (const std::string_view met = entry_of(check.limit.id).met; !met.empty()) return std::string(met);
  const Bound bound = check.limit.bound;
  const std::string_view side = bound == Bound::highest  ? "at most "
                                : bound == Bound::lowest ? "at least "
                                                         : "";
  return std::string(side) + value_text(check.value, check.limit.dimension(), kDigits);
}

std::string reached_text(const LimitCheck& check) {
  const std::string_view met = entry_of(check.limit.id).met;
  if (!met.empty() && check.kept()) return std::string(met);
  constexpr double kAlmostStraight = 1e6;
  if (check.limit.is_radius() && check.reached > kAlmostStraight * check.scale) return "straight";
  return value_text(check.reached, check.limit.dimension(), kReachedDigits);
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

}  // namespace

std::vector<ReportLimit> report_limits(const std::vector<LimitCheck>& checks,
                                       const std::vector<ActiveLimit>& active, const Objective& objective) {
  std::vector<ReportLimit> rows;
  for (const LimitCheck& check : checks) {
    const auto found = std::find_if(active.begin(), active.end(),
                                    [&](const ActiveLimit& one) { return one.limit == check.limit; });
    const ActiveLimit* const holding = check.kept() && found != active.end() ? &*found : nullptr;
    ReportLimit row;
    row.name = check.limit.label();
    row.bound = bound_text(check);
    row.reached = reached_text(check);
    row.where = places_text(check, holding);
    row.status = !check.kept() ? "violated" : holding != nullptr ? "active" : "kept";
    if (holding != nullptr) {
      row.price = price_for_people(holding->price, holding->limit);
      row.price_unit = price_unit(holding->limit, objective);
    }
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
  const Limits& limits = *design.limits;
  for (const KeepOut& area : limits.keep_outs) add("keep-out", area.outline, false);
  for (const Profile& ground : limits.stay_above) add("stay above", ground.line, true);
  for (const Profile& ceiling : limits.stay_below) add("stay below", ceiling.line, true);
  const Vec3 way = design.track.finish - design.track.start;
  const double reach = math::hypot(way.x, way.y, way.z);
  for (const HalfPlane& side : limits.half_planes) {
    const Vec2 along{-side.forbidden.y * reach, side.forbidden.x * reach};
    add("half-plane",
        {{side.point.x - along.x, side.point.y - along.y}, {side.point.x + along.x, side.point.y + along.y}},
        true);
  }
  return areas;
}

}  // namespace glissade
