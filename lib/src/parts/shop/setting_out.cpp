#include "parts/shop/setting_out.hpp"

#include "glissade/core/number_text.hpp"
#include "glissade/core/vec.hpp"

#include "core/millimetres.hpp"
#include "parts/curves/plumb.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <utility>

namespace glissade::parts {
namespace {

/// A round distance that gives some 10 to 25 stations.
double round_step(double length) {
  double step = 0.001;
  constexpr std::array<double, 3> kFactors = {2.5, 2.0, 2.0};  // 1, 2.5, 5, 10
  for (std::size_t k = 0; length / step > 25.0; ++k) step *= kFactors[k % 3];
  return step;
}

}  // namespace

Span segment_at(const std::vector<double>& joints, double s) {
  const auto next = std::upper_bound(joints.begin() + 1, joints.end() - 1, s);
  return {*(next - 1), *next};
}

SettingOutPoint setting_out_point(const ArcSpline& track, const Span& chord_span, const Placement& placement,
                                  std::string what, double s) {
  const CenterlinePoint at = track.at(s);
  const CenterlinePoint from = track.at(chord_span.from);
  const CenterlinePoint to = track.at(chord_span.to);
  const Vec2 chord{to.x - from.x, from.drop - to.drop};
  const Vec2 away{at.x - from.x, from.drop - at.drop};
  SettingOutPoint row;
  row.what = std::move(what);
  row.arc_length = s;
  row.x = at.x;
  row.z = 0.0 - at.drop;
  row.site = placement.to_space(at.x, at.drop, 0.0);
  row.slope_angle = Angle::from_radians(at.slope_angle);
  row.radius = at.curvature == 0.0 ? std::numeric_limits<double>::infinity() : 1.0 / at.curvature;
  row.ordinate = cross(chord, away) / norm(chord);
  return row;
}

SettingOutPoint setting_out_point(const ArcSpline& track, const std::vector<double>& joints,
                                  const Placement& placement, const StandingBelow& standing) {
  const auto in_mm = [](double metres) { return rounded_text(core::kMillimetres * metres, 6); };
  const std::optional<double> above = place_at_run(track, standing.x, standing.at);
  const double s = above.value_or(standing.at);
  SettingOutPoint row = setting_out_point(
      track, segment_at(joints, s), placement,
      standing.what + ": middle x " + in_mm(standing.x) + ", foot z " + in_mm(standing.foot), s);
  if (above) return row;
  row.beyond_track = true;
  row.x = standing.x;
  row.z = standing.foot;
  row.site = placement.to_space(standing.x, 0.0 - standing.foot, 0.0);
  row.slope_angle = Angle();
  row.radius = std::numeric_limits<double>::infinity();
  row.ordinate = 0.0;
  return row;
}

void in_order(std::vector<SettingOutPoint>& rows) {
  std::stable_sort(rows.begin(), rows.end(), [](const SettingOutPoint& a, const SettingOutPoint& b) {
    return a.arc_length < b.arc_length;
  });
}

std::vector<SettingOutPoint> setting_out(const ArcSpline& track, const std::vector<double>& joints,
                                         const Placement& placement) {
  const auto point = [&](std::string what, double s) {
    return setting_out_point(track, segment_at(joints, s), placement, std::move(what), s);
  };
  std::vector<SettingOutPoint> rows;
  const double step = round_step(track.length());
  for (double k = 1.0; k * step < track.length(); k += 1.0) rows.push_back(point("station", k * step));
  for (std::size_t i = 1; i + 1 < joints.size(); ++i) {
    rows.push_back(point("joint " + std::to_string(i), joints[i]));
  }
  rows.push_back(point("start", 0.0));
  rows.push_back(point("finish", track.length()));
  in_order(rows);
  return rows;
}

}  // namespace glissade::parts
