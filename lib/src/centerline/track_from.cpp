#include "glissade/centerline/track_from.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/number_text.hpp"

#include <algorithm>
#include <string>
#include <utility>

namespace glissade {

TrackFrom::TrackFrom(CenterlinePtr whole, double start, std::optional<double> end)
    : whole_(std::move(whole)), start_(start), end_(0.0) {
  if (!whole_) throw InputError({"", "there is no track to take a part of", "", ""});
  end_ = end.value_or(whole_->length());
  const std::string why = "The track is " + exact_text(whole_->length()) + " m long.";
  if (!(start >= 0.0 && start < whole_->length())) {
    throw InputError({"", "a part of the track cannot begin at " + exact_text(start) + " m", why, ""});
  }
  if (!(end_ > start && end_ <= whole_->length())) {
    throw InputError(
        {"",
         "a part of the track from " + exact_text(start) + " m on cannot end at " + exact_text(end_) + " m",
         why, ""});
  }
  origin_ = whole_->at(start);
}

double TrackFrom::on_whole(double s) const {
  require_on_track(s);
  return std::min(start_ + s, end_);
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
    if (at > start_ && at < end_) breaks.push_back(at - start_);
  }
  breaks.push_back(length());
  return breaks;
}

bool TrackFrom::unbounded_curvature_at_start() const noexcept {
  return start_ == 0.0 && whole_->unbounded_curvature_at_start();
}

}  // namespace glissade
