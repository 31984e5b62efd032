#pragma once

#include <string>
#include <string_view>

namespace glissade::pipeline {

/// Sizes of lettering and marks of a drawing, over those that they have in drawings of a usual size: 1 from the smallest of these to the
/// largest, otherwise the same share of the drawing as there.
/// @param size  of what is drawn; > 0
[[nodiscard]] double lettering_factor(double size, double smallest, double largest);

/// @return with so many digits after the point, 0 without a sign; no exponent
[[nodiscard]] std::string fixed_text(double value, int decimals);

/// How the sheets of a track write lengths: in metres, or in millimetres where all of it is shorter than a metre.
class SheetLengths {
 public:
  /// @param size  of the track, along its greater side [m]
  explicit SheetLengths(double size) : metres_(size >= 1.0) {}  // taste

  [[nodiscard]] std::string unit() const { return metres_ ? "m" : "mm"; }
  [[nodiscard]] std::string units_in_words() const { return metres_ ? "metres" : "millimetres"; }
  /// @return a head of a column: "x [m]"
  [[nodiscard]] std::string head(std::string_view name) const;
  /// @return a number of a column: as many decimals for all, the ten-thousandth of a unit
  [[nodiscard]] std::string place(double metres) const;
  /// @return a measure with its unit, to the thousandth: "103 m"
  [[nodiscard]] std::string measure(double metres) const;
  /// @return a radius of curvature, to six digits; "straight" from a million times the track's length on, where rounding is all
  ///         that bends it
  /// @param curvature  [1/m]
  /// @param length     of the track [m]
  [[nodiscard]] std::string radius(double curvature, double length) const;

 private:
  [[nodiscard]] double in_unit(double metres) const;

  bool metres_;
};

}  // namespace glissade::pipeline
