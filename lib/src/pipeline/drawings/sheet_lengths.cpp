#include "pipeline/drawings/sheet_lengths.hpp"

#include "glissade/core/number_text.hpp"

#include "core/millimetres.hpp"

#include <array>
#include <charconv>
#include <cmath>

namespace glissade {

double pipeline::lettering_factor(double size, double smallest, double largest) {
  return size < smallest ? size / smallest : size > largest ? size / largest : 1.0;
}

std::string pipeline::fixed_text(double value, int decimals) {
  // The largest double has 309 digits before the point.
  std::array<char, 400> buffer;
  const auto end =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::fixed, decimals)
          .ptr;
  const std::string text(buffer.data(), end);
  const bool zero = text.find_first_not_of("-0.") == std::string::npos;
  return zero && text.front() == '-' ? text.substr(1) : text;
}

double pipeline::SheetLengths::in_unit(double metres) const {
  return metres_ ? metres : core::kMillimetres * metres;
}

std::string pipeline::SheetLengths::head(std::string_view name) const {
  return std::string(name) + " [" + unit() + "]";
}

std::string pipeline::SheetLengths::place(double metres) const {
  constexpr int kDecimals = 4;  // taste: finer than anything is set out or printed
  return fixed_text(in_unit(metres), kDecimals);
}

std::string pipeline::SheetLengths::measure(double metres) const {
  constexpr double kShares = 1000.0;  // taste
  return decimal_text(std::round(kShares * in_unit(metres)) / kShares + 0.0) + " " + unit();
}

std::string pipeline::SheetLengths::radius(double curvature, double length) const {
  constexpr double kStraight = 1e-6;  // rounding: what a curvature of sums along the track is sure to
  if (std::fabs(curvature) * length < kStraight) return "straight";
  const double radius = in_unit(1.0 / curvature);
  constexpr int kDigits = 6;      // taste
  constexpr double kPlain = 1e6;  // taste: to the unit from here on, without an exponent
  return std::fabs(radius) < kPlain ? rounded_text(radius, kDigits) : fixed_text(radius, 0);
}

}  // namespace glissade
