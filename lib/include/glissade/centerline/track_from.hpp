#pragma once

#include "glissade/centerline/centerline.hpp"

#include <optional>

namespace glissade {

/// The part of a track from some place on, to its finish (what is ridden from a lower gate) or to a place before that.
///
/// Frame: arc length, run and drop count from its own start.
/// Accuracy: that of the whole track.
class TrackFrom final : public Centerline {
 public:
  /// @param whole  the track; not null
  /// @param start  arc length on it where this one begins [m]; 0 or more, less than its length
  /// @param end    arc length on it where this one ends [m]; more than `start`, at most its length; none: that
  /// @throws InputError if there is no track, or the start or the end is not on it
  TrackFrom(CenterlinePtr whole, double start, std::optional<double> end = {});

  /// @return the kind of the whole
  [[nodiscard]] std::string_view kind() const noexcept override { return whole_->kind(); }
  [[nodiscard]] double length() const noexcept override { return end_ - start_; }
  [[nodiscard]] CenterlinePoint at(double s) const override;
  [[nodiscard]] double slope_angle(double s) const override;
  [[nodiscard]] Direction direction(double s) const override;
  [[nodiscard]] std::vector<double> breaks() const override;
  [[nodiscard]] bool unbounded_curvature_at_start() const noexcept override;

 private:
  [[nodiscard]] double on_whole(double s) const;

  CenterlinePtr whole_;
  double start_;
  double end_;
  CenterlinePoint origin_;
};

}  // namespace glissade
