#include "task/obstacles.hpp"

#include <cstddef>
#include <utility>

namespace glissade::task {
namespace {

clearance::Pass pass_of(Passage passage) {
  switch (passage) {
    case Passage::above:
      return clearance::Pass::above;
    case Passage::below:
      return clearance::Pass::below;
    case Passage::either:
      break;
  }
  return clearance::Pass::either;
}

}  // namespace

std::vector<Obstacle> obstacles_of(const Limits& limits) {
  std::vector<Obstacle> obstacles;
  const auto add = [&](LimitId id, std::size_t index, double clearance, clearance::Region region) {
    obstacles.push_back({{id, Bound::lowest, index}, clearance, std::move(region)});
  };
  for (std::size_t i = 0; i < limits.half_planes.size(); ++i) {
    const HalfPlane& plane = limits.half_planes[i];
    add(LimitId::half_planes, i, plane.clearance,
        clearance::Region::half_plane(plane.point, plane.forbidden));
  }
  for (std::size_t i = 0; i < limits.keep_outs.size(); ++i) {
    const KeepOut& area = limits.keep_outs[i];
    add(LimitId::keep_outs, i, area.clearance, clearance::Region::area(area.outline, pass_of(area.passage)));
  }
  for (std::size_t i = 0; i < limits.stay_above.size(); ++i) {
    const Profile& line = limits.stay_above[i];
    add(LimitId::stay_above, i, line.clearance, clearance::Region::line(line.line, true));
  }
  for (std::size_t i = 0; i < limits.stay_below.size(); ++i) {
    const Profile& line = limits.stay_below[i];
    add(LimitId::stay_below, i, line.clearance, clearance::Region::line(line.line, false));
  }
  return obstacles;
}

}  // namespace glissade::task
