#pragma once

#include <vector>

namespace glissade {

/// The inside width of a chute at a place.
struct WidthAt {
  double at = 0.0;     ///< arc length [m]
  double width = 0.0;  ///< B [m]; > 0

  friend bool operator==(const WidthAt&, const WidthAt&) = default;
};

/// The width of a floor along the track: linear between given places, constant before the first and after the last.
///
/// Regular value; a plain number is a constant law.
class WidthLaw {
 public:
  /// The same width everywhere.
  WidthLaw(double width = 0.0)
      : knots_{{0.0, width}} {}  // NOLINT(google-explicit-constructor): a number is one
  /// @param knots  at least one, by ascending places
  /// @throws InputError if there is none or a place does not lie after the one before it
  explicit WidthLaw(std::vector<WidthAt> knots);
  // Copies alone: what was moved from has its width still.
  WidthLaw(const WidthLaw&) = default;
  WidthLaw& operator=(const WidthLaw&) = default;
  ~WidthLaw() = default;

  [[nodiscard]] const std::vector<WidthAt>& knots() const { return knots_; }
  /// @return B(s) [m]
  [[nodiscard]] double at(double s) const;
  /// @return dB/ds [-]; beside a knot that of the side after it
  [[nodiscard]] double slope(double s) const;
  [[nodiscard]] double narrowest() const;
  [[nodiscard]] double widest() const;
  /// @return the farthest place that was given; of one width everywhere, where it was said [m]
  [[nodiscard]] double last_place() const { return last_place_; }
  [[nodiscard]] bool is_constant() const { return narrowest() == widest(); }

  friend bool operator==(const WidthLaw& a, const WidthLaw& b) { return a.knots_ == b.knots_; }

 private:
  std::vector<WidthAt> knots_;
  double last_place_ = 0.0;
};

}  // namespace glissade
