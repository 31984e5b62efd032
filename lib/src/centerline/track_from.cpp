#include "glissade/centerline/track_from.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/number_text.hpp"

#include <algorithm>
#include <utility>

namespace glissade {

TrackFrom::TrackFrom(CenterlinePtr whole, double start) : whole_(std::move(whole)), start_(start) {
  if (!whole_) throw InputError({"", "there is no track to take a part of", "", ""});
  if (!(start >= 0.0 && start < whole_->length())) {
    throw InputError({"", "a part of the track cannot begin at " + exact_text(start) + " m",
                      "The track is " + exact_text(whole_->length()) + " m long.", ""});
  }
  origin_ = whole_->at(start);
}

double TrackFrom::on_whole(double s) const {
  require_on_track(s);
  return std::min(start_ + s, whole_->length());
}

CenterlinePoint TrackFrom::at(double s) const {
  CenterlinePoint point = whole_->at(on_whole(s));
  point.arc_length = s;
  point.x -= origin_.x;
  point.drop -= origin_.drop;
  return point;
}

double TrackFrom::slope_angle(double s) const {
  return whole_->slope_angle(on_whole(s));
}

Direction TrackFrom::direction(double s) const {
  return whole_->direction(on_whole(s));
}

std::vector<double> TrackFrom::breaks() const {
  std::vector<double> breaks = {0.0};
  for (const double at : whole_->breaks()) {
    if (at > start_ && at < whole_->length()) breaks.push_back(at - start_);
  }
  breaks.push_back(length());
  return breaks;
}

bool TrackFrom::unbounded_curvature_at_start() const noexcept {
  return start_ == 0.0 && whole_->unbounded_curvature_at_start();
}

}  // namespace glissade
