#include "glissade/core/math.hpp"
#include "glissade/report/report.hpp"
#include "glissade/solid/level_line.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>

namespace glissade {

std::vector<ReportLimit> report_limits(const std::vector<LimitCheck>& checks,
                                       const std::vector<ActiveLimit>& active) {
  std::vector<ReportLimit> rows;
  for (const LimitCheck& check : checks) {
    const auto found = std::find_if(active.begin(), active.end(),
                                    [&](const ActiveLimit& one) { return one.limit == check.limit; });
    const bool holds = check.kept() && found != active.end();
    const char* const kept = holds ? "active" : "kept";
    // The key stands beside the name and counts as the design file does: the name alone has no number.
    rows.push_back({std::string(entry_of(check.limit.id).label), check.kept() ? kept : "violated", check,
                    holds ? std::optional(*found) : std::nullopt});
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
  const auto add = [&](const std::string& name, const std::vector<Vec2>& points, bool open,
                       double clearance) {
    ReportKeepOut area{name, {}, open, clearance};
    for (const Vec2 point : points) area.points.push_back(in_profile(point));
    areas.push_back(std::move(area));
  };
  const Limits& limits = *design.limits;
  const auto key = [](LimitId id, std::size_t index) { return LimitName{id, Bound::lowest, index}.key(); };
  for (std::size_t i = 0; i < limits.keep_outs.size(); ++i)
    add(key(LimitId::keep_outs, i), limits.keep_outs[i].outline, false, limits.keep_outs[i].clearance);
  for (std::size_t i = 0; i < limits.stay_above.size(); ++i)
    add(key(LimitId::stay_above, i), limits.stay_above[i].line, true, limits.stay_above[i].clearance);
  for (std::size_t i = 0; i < limits.stay_below.size(); ++i)
    add(key(LimitId::stay_below, i), limits.stay_below[i].line, true, limits.stay_below[i].clearance);
  const Vec3 way = design.track.finish - design.track.start;
  const double reach = math::hypot(way.x, way.y, way.z);
  for (std::size_t i = 0; i < limits.half_planes.size(); ++i) {
    const HalfPlane& side = limits.half_planes[i];
    const Vec2 along{-side.forbidden.y * reach, side.forbidden.x * reach};
    add(key(LimitId::half_planes, i),
        {{side.point.x - along.x, side.point.y - along.y}, {side.point.x + along.x, side.point.y + along.y}},
        true, side.clearance);
  }
  return areas;
}

std::vector<EnvelopeEdge> envelope_edges(const Centerline& centerline, const Envelope& envelope) {
  // Half a line's width where the track is a thousand wide.
  const double tolerance = 5e-4 * centerline.length();
  std::vector<EnvelopeEdge> edges;
  const auto add = [&](const char* name, double height) {
    edges.push_back({name, level_line(centerline, height, tolerance), false});
  };
  if (envelope.below > 0.0) add("underside", -envelope.below);
  if (envelope.above > 0.0) add("top of the solid", envelope.above);
  if (envelope.headroom > envelope.above)
    edges.push_back({"headroom", offset_line(centerline, envelope.headroom, tolerance), true});
  return edges;
}

}  // namespace glissade
