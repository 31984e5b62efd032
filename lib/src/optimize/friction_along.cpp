#include "optimize/friction_along.hpp"

#include <algorithm>
#include <memory>

namespace glissade::optimizer {

FrictionAlong::FrictionAlong(const Body& body, double chord) {
  double before = body.friction.coefficient();
  double largest = before;
  double from = 0.0;
  for (const FrictionChange& change : body.friction_changes) {
    const double at = std::min(1.0, change.from / chord);
    mean_ += (at - from) * before;
    from = at;
    steps_.push_back({change.from / chord, change.friction.coefficient() - before});
    before = change.friction.coefficient();
    largest = std::max(largest, before);
  }
  mean_ += (1.0 - from) * before;
  if (mean_ == 0.0) mean_ = largest;
  if (mean_ == 0.0) mean_ = 1.0;
  first_ = body.friction.coefficient() / mean_;
  for (Step& step : steps_) step.by /= mean_;
}

Resistance FrictionAlong::resistance(double s, double /*v*/) const {
  Resistance result;
  result.factor = first_;
  for (const Step& step : steps_) {
    const double t = std::clamp((s - step.at) / change_ + 0.5, 0.0, 1.0);
    const double rest = 1.0 - t;
    result.factor += step.by * t * t * t * (10.0 - t * (15.0 - 6.0 * t));
    result.by_s += step.by * 30.0 * t * t * rest * rest / change_;
    result.by_s_s += step.by * 60.0 * t * rest * (rest - t) / (change_ * change_);
  }
  return result;
}

LawPtr FrictionAlong::in_units(double length, double /*speed*/) const {
  auto scaled = std::make_shared<FrictionAlong>(*this);
  for (Step& step : scaled->steps_) step.at /= length;
  scaled->change_ /= length;
  return scaled;
}

}  // namespace glissade::optimizer
