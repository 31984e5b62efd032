#pragma once

#include "glissade/parts/arc_spline.hpp"
#include "glissade/parts/plate_options.hpp"

#include "parts/strips/bent_strips.hpp"
#include "parts/strips/strip_shape.hpp"

#include <vector>

namespace glissade::parts {

/// The line of flats that the plates of a bent job follow, from unit to unit, as what is cut and set along it counts: a place on it
/// stands for one on the track as corners of flats stand for the middle between the places where their flats touch it.
class FlatsLine {
 public:
  /// @param corners  of flats, both ends of the track and of its units among them; ascending places on the track
  explicit FlatsLine(const std::vector<FlatCorner>& corners);

  [[nodiscard]] const ArcSpline& line() const { return line_; }
  /// @return the place along the line of one on the track, and the other way round; both linear between corners
  [[nodiscard]] double on_line(double s) const;
  [[nodiscard]] double on_track(double place) const;
  [[nodiscard]] const std::vector<FlatCorner>& corners() const { return corners_; }
  /// @return how far the corner nearest to a point (x, height) lies off the track [m]
  [[nodiscard]] double miss_at(Vec2 point) const;

 private:
  std::vector<FlatCorner> corners_;
  std::vector<double> places_;
  ArcSpline line_;
};

/// A bent job as its plates see it: along their line of flats.
class FlatsJob {
 public:
  FlatsJob(const StripJob& job, const BentStrips& bent, const std::vector<double>& joints);
  FlatsJob(const FlatsJob&) = delete;
  FlatsJob& operator=(const FlatsJob&) = delete;

  [[nodiscard]] const FlatsLine& flats() const { return flats_; }
  [[nodiscard]] const StripJob& job() const { return job_; }
  [[nodiscard]] const std::vector<double>& joints() const { return joints_; }

 private:
  FlatsLine flats_;
  PlateOptions options_;  ///< with places along the line
  StripJob job_;
  std::vector<double> joints_;
};

/// @return whether plates of a section are cut or set on other than plainly, along the line
[[nodiscard]] bool has_works(const PlateOptions& options);

/// Rows of the bend schedule for parts that have bends and no rows yet.
void schedule_bends(const FlatsJob& flats, Workshop& workshop);

}  // namespace glissade::parts
