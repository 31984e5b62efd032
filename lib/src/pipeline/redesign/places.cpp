#include "pipeline/redesign/places.hpp"

#include "glissade/pipeline/solve.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace glissade::pipeline {

Problem places_to_edge(const Design& design, const Endpoints& certificate) {
  Problem places = problem_of(design);
  const Limits asked = std::exchange(places.limits, {});
  const Vec2 edge{certificate.run, certificate.drop};
  const auto counted = [&](std::vector<Vec2> points) {
    for (Vec2& point : points) point = point - edge;
    return points;
  };
  Limits& limits = places.limits;
  limits.envelope = asked.envelope;
  limits.half_planes = asked.half_planes;
  for (HalfPlane& plane : limits.half_planes) plane.point = plane.point - edge;
  limits.keep_outs = asked.keep_outs;
  for (KeepOut& area : limits.keep_outs) area.outline = counted(area.outline);
  limits.stay_above = asked.stay_above;
  limits.stay_below = asked.stay_below;
  for (std::vector<Profile>* const lines : {&limits.stay_above, &limits.stay_below}) {
    for (Profile& profile : *lines) profile.line = counted(profile.line);
  }
  limits.waypoints = counted(asked.waypoints);
  places.finish = {FinishKind::level, {}, {}};
  places.places_from = PlacesFrom::finish;
  return places;
}

Limits moved(Limits limits, Vec2 from_there_to_edge) {
  const auto move = [&](std::vector<Vec2>& points) {
    for (Vec2& point : points) point = point + from_there_to_edge;
  };
  for (HalfPlane& plane : limits.half_planes) plane.point = plane.point + from_there_to_edge;
  for (KeepOut& area : limits.keep_outs) move(area.outline);
  for (Profile& profile : limits.stay_above) move(profile.line);
  for (Profile& profile : limits.stay_below) move(profile.line);
  move(limits.waypoints);
  return limits;
}

double start_area_of(const Design& design) {
  const double of_gates = design.gates ? design.gates->start_area.value_or(0.0) : 0.0;
  return std::max(of_gates, design.centerline.in_run.start_area().value_or(0.0));
}

double straight_of(const Centerline& track) {
  const std::vector<double> breaks = track.breaks();
  for (std::size_t i = 1; i < breaks.size(); ++i) {
    const double middle = breaks[i - 1] + 0.5 * (breaks[i] - breaks[i - 1]);
    if (track.direction(middle).curvature != 0.0) return breaks[i - 1];
  }
  return track.length();
}

void hold_to_area(double area, std::vector<RedesignShape>& shapes) {
  for (std::size_t i = 0; i + 1 < shapes.size(); ++i) {
    RedesignShape& shape = shapes[i];
    if (shape.track == nullptr) continue;
    constexpr double kRounding = 1e-9;  // rounding: of lengths that are sums
    const double straight = straight_of(*shape.track);
    if (straight < area * (1.0 - kRounding)) shape.short_straight = straight;
  }
}

void hold_against(Problem places, std::vector<RedesignShape>& shapes) {
  if (!places.limits.has_clearances() && places.limits.waypoints.empty()) return;
  for (RedesignShape& shape : shapes) {
    if (shape.track == nullptr) continue;
    for (const LimitCheck& check : check_limits(places, shape.track)) {
      if (check.kept() || entry_of(check.limit.id).form != LimitForm::list) continue;
      shape.breaks.push_back(check.limit.key());
    }
  }
}

}  // namespace glissade::pipeline
