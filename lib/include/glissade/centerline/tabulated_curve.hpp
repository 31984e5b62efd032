#pragma once

#include "glissade/centerline/centerline.hpp"
#include "glissade/core/error.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace glissade {

/// One row of a table that describes a track.
struct TabulatedPoint {
  double x = 0.0;            ///< horizontal distance [m]
  double drop = 0.0;         ///< positive DOWN [m]
  double slope_angle = 0.0;  ///< zeta [rad], positive downhill, seen towards the last row
  /// kappa [1/m], positive in a valley. Of the first row it may be infinite: curvature then grows without bound
  /// towards the start, like s^(-1/2).
  double curvature = 0.0;

  friend bool operator==(const TabulatedPoint&, const TabulatedPoint&) = default;
};

/// Why rows are no track, and which of them shows it.
struct TableFault {
  std::optional<std::size_t> row;  ///< its index; none where there are too few of them
  Issue issue;                     ///< `where` names the row by number, counted from 1, and its place
};

/// @return the first fault of rows that TabulatedCurve would take; none if they make a track
[[nodiscard]] std::optional<TableFault> table_fault(const std::vector<TabulatedPoint>& rows);

/// A track that was found elsewhere, or before: taken as its table of slope angles and curvatures says, nothing fitted.
///
/// Between rows the slope angle is the cubic that has the angle and curvature of both; in arc length, or in its square
/// root where curvature has no bound at the start. Arc lengths follow from the chords between rows, places from the
/// slope angle. Two rows at one place are a jump of curvature; one that the table does not say so is seen where the slope
/// angles show it and curvature hardly changes in the stretches beside it. Between two rows that lie on one crest of a
/// parabola with an upright axis, to rounding, the curve is that parabola: a body that flies along it (N = 0) does so
/// from the table, too.
/// Frame: the first row is the start. Where the last row lies to the left of the first, the table is mirrored.
/// Curve: slope angle and curvature continuous but at jumps; smooth between breaks(), which are rows and jumps.
/// Accuracy: fourth order in the distance of the rows, third in curvature where that is not linear between them. table_of()
///   and places_for_table() keep travel time, exit speed and length to kTableAccuracy, and v^2 to kTableRounding besides: next to
///   the limit of what can be reached a body all but stops, and both tell. A jump of curvature in one row: to 1e-9 in what
///   places_for_table() has, by the line through the stretch alone where columns are rounded. Rows nearer than 1e-12 of how far the
///   track leads, or than 1024 last digits of their coordinates, tell places and slope angles alone: of a bend that is sharper its turn
///   is kept, and nothing of its shape.
class TabulatedCurve final : public Centerline {
 public:
  /// @param rows  in order along the track, at least 2
  /// @throws InputError with the table_fault()
  explicit TabulatedCurve(std::vector<TabulatedPoint> rows);

  [[nodiscard]] std::string_view kind() const noexcept override { return "points"; }
  [[nodiscard]] double length() const noexcept override { return breaks_.back(); }
  [[nodiscard]] CenterlinePoint at(double s) const override;
  [[nodiscard]] double slope_angle(double s) const override;
  [[nodiscard]] Direction direction(double s) const override;
  [[nodiscard]] std::vector<double> breaks() const override { return breaks_; }
  [[nodiscard]] bool unbounded_curvature_at_start() const noexcept override { return unbounded_; }

  /// @return those that it was made of, counted from the start, x growing towards the finish; jumps of curvature in two rows
  [[nodiscard]] const std::vector<TabulatedPoint>& rows() const noexcept { return rows_; }

 private:
  /// The path of a body in free flight: its slope t = tan(zeta) grows by `rate` per run.
  struct Flight {
    double begin = 0.0;  // arc length
    double rate = 0.0;   // [1/m]
    double slope = 0.0;  // t where it begins

    [[nodiscard]] double slope_at(double s) const;
  };
  /// A stretch between rows. Its parameter p is arc length, or the square root of it where curvature has no bound.
  struct Stretch {
    double from = 0.0;  // p
    double width = 0.0;
    double slope[4] = {};  // coefficients of the slope angle in (p - from) / width, lowest first
    double x = 0.0;        // where it begins
    double drop = 0.0;
    std::optional<Flight> flight = {};  // in place of the cubic

    [[nodiscard]] double share(double p) const;
  };
  [[nodiscard]] double parameter(double s) const;
  [[nodiscard]] const Stretch& stretch_at(double s) const;
  void append(const TabulatedPoint& left, const TabulatedPoint& right, double rounded);
  void append_flight(const TabulatedPoint& left, const TabulatedPoint& right);

  std::vector<TabulatedPoint> rows_;
  std::vector<double> breaks_ = {0.0};
  std::vector<Stretch> stretches_;
  bool unbounded_ = false;
  double x_ = 0.0;  // where the next stretch begins
  double drop_ = 0.0;
};

/// @return a table of the curve so dense that TabulatedCurve gives it back to kTableAccuracy; of a TabulatedCurve its own rows
[[nodiscard]] std::vector<TabulatedPoint> table_of(const Centerline& curve);

/// @param places    arc lengths on the curve, ascending, every break of it among them
/// @param shortest  how near to each other rows may lie [m], 0 however near; those of `places` that are nearer are left out, but for
///   breaks. Coordinates that count from far away round places: 256 of their last digits keep rows in order
/// @return these and as many between them as TabulatedCurve needs to give the curve back from rows there, to
///   kTableAccuracy
[[nodiscard]] std::vector<double> places_for_table(const Centerline& curve, const std::vector<double>& places,
                                                   double shortest = 0.0);

/// Stated bound of the relative error of travel time, exit speed and length on TabulatedCurve(table_of(curve)), for
/// curves that this library knows.
inline constexpr double kTableAccuracy = 1e-9;

/// Stated bound of what the square of the exit speed may be off by besides, of v0^2 + 2 g length. measured: 2.2e-13 of fastest
/// tracks that lie within the reach limit by 1e-4 or more, at friction coefficients of 0.003 to 5; the travel time is off by that
/// over g times the exit speed. Nearer to the limit their last bend is sharper than places can tell: 1e-11, and whether a body
/// arrives is left to rounding. Coordinates that count from farther away than the track is long add their own rounding.
inline constexpr double kTableRounding = 3e-13;

}  // namespace glissade
