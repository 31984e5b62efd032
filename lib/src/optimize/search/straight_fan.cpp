#include "optimize/search/straight_fan.hpp"

#include "glissade/core/math.hpp"
#include "glissade/core/units.hpp"

#include <algorithm>
#include <cmath>

namespace glissade::optimizer {

StraightFan::StraightFan(const Problem& problem) : finish_(problem.finish.kind), given_(problem.endpoints) {
  constexpr double kNotUpright = 1e-3;  // taste: a thousand runs high [rad]
  flattest_ = finish_ == FinishKind::level ? kNotUpright : kNotUpright - kRightAngle;
  steepest_ = kRightAngle - kNotUpright;
  const double upright = steepest_;
  const Limits& limits = problem.limits;
  for (const Range& range : {limits.slope_angle, limits.entry_slope_angle, limits.exit_slope_angle}) {
    if (range.lowest) flattest_ = std::max(flattest_, *range.lowest);
    if (range.highest) steepest_ = std::min(steepest_, *range.highest);
  }
  const Range& free = problem.finish.free_range;
  const double run = std::fabs(given_.run);
  if (finish_ == FinishKind::vertical_line) {
    if (free.lowest) flattest_ = std::max(flattest_, math::atan2(*free.lowest, run));
    if (free.highest) steepest_ = std::min(steepest_, math::atan2(*free.highest, run));
  } else if (finish_ == FinishKind::level) {
    if (free.highest) flattest_ = std::max(flattest_, math::atan2(given_.drop, *free.highest));
    if (free.lowest) steepest_ = std::min(steepest_, math::atan2(given_.drop, *free.lowest));
  }
  is_open_above_ = finish_ == FinishKind::vertical_line && steepest_ == upright &&
                   !problem.finish.free_range.highest && !limits.arc_length.highest;
}

std::vector<double> StraightFan::slopes() const {
  constexpr int kSteps = 512;  // taste
  if (finish_ == FinishKind::point) return {math::atan2(given_.drop, std::fabs(given_.run))};
  const bool level = finish_ == FinishKind::level;
  if (finish_ == FinishKind::anywhere || flattest_ > steepest_ || (level && !(given_.drop > 0.0))) return {};
  std::vector<double> slopes;
  for (int i = 0; i <= kSteps; ++i)
    slopes.push_back(i == kSteps ? steepest_ : flattest_ + (steepest_ - flattest_) * i / kSteps);
  return slopes;
}

Endpoints StraightFan::ends_at(double slope) const {
  const double run = std::fabs(given_.run);
  switch (finish_) {
    case FinishKind::level:
      return {given_.drop / math::tan(slope), given_.drop};
    case FinishKind::vertical_line:
      return {run, run * math::tan(slope)};
    default:
      return given_;
  }
}

}  // namespace glissade::optimizer
