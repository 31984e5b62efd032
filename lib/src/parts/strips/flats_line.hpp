#pragma once

#include "glissade/parts/arc_spline.hpp"
#include "glissade/parts/plate_options.hpp"

#include "parts/bodies/facets.hpp"
#include "parts/strips/bent_strips.hpp"
#include "parts/strips/strip_shape.hpp"

#include <vector>

namespace glissade::parts {

/// The line of flats that the plates of a bent job follow, from unit to unit, as what is cut and set along it counts: places on it stand
/// for those on the track as FlatPlaces has it.
class FlatsLine {
 public:
  /// @param units  flats of each
  FlatsLine(const ArcSpline& track, const std::vector<Facets>& units);

  [[nodiscard]] const ArcSpline& line() const { return line_; }
  /// @return the place along the line of one on the track, and the other way round
  [[nodiscard]] double on_line(double s) const;
  [[nodiscard]] double on_track(double place) const;
  /// @return the end of the track
  [[nodiscard]] double track_end() const { return places_.on_track.back(); }
  /// @return how far the corner nearest to a point (x, height) lies off the track [m]
  [[nodiscard]] double miss_at(Vec2 point) const;

 private:
  /// Where flats meet, both ends of the line among them.
  struct Corner {
    Vec2 at;            ///< in the frame (x, height)
    double miss = 0.0;  ///< from the track [m]
  };
  static std::vector<Corner> corners_of(const std::vector<Facets>& units);
  static ArcSpline line_through(const std::vector<Corner>& corners);

  std::vector<Corner> corners_;
  ArcSpline line_;
  FlatPlaces places_;
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
