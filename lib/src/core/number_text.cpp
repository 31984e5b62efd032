#include "glissade/core/number_text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <vector>

namespace glissade {

std::string exact_text(double value) {
  std::array<char, 32> buffer;
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
  return {buffer.data(), end};
}

std::string decimal_text(double value) {
  // The smallest double has 324 zeros after the point.
  std::array<char, 512> buffer;
  const auto end =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::fixed).ptr;
  return {buffer.data(), end};
}

std::string rounded_text(double value, int digits) {
  if (!std::isfinite(value)) return exact_text(value);
  std::array<char, 64> buffer;
  const auto scientific = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                                        std::chars_format::scientific, digits - 1)
                              .ptr;
  double rounded = 0.0;
  std::from_chars(buffer.data(), scientific, rounded);
  const double size = std::fabs(rounded);
  const bool plain = size == 0.0 || (size >= 1e-5 && size < 1e10);
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), rounded,
                                 plain ? std::chars_format::fixed : std::chars_format::scientific)
                       .ptr;
  return {buffer.data(), end};
}

std::string length_text(double metres, int digits) {
  // What rounds to a metre is told as one, as what has just reached it is.
  const double size = std::fabs(metres);
  const bool below_metre = size < 1.0 && rounded_text(size, digits) != "1";
  if (below_metre) return rounded_text(metres * 1e3, digits) + " mm";
  if (size >= 1e4 || rounded_text(size, digits) == "10000")
    return rounded_text(metres * 1e-3, digits) + " km";
  return rounded_text(metres, digits) + " m";
}

std::string angle_text(Angle angle, int digits) {
  constexpr double kLevel = 1e-12;
  if (std::fabs(angle.radians()) < kLevel) return "0 deg";
  return rounded_text(angle.degrees(), digits) + " deg";
}

std::pair<std::string, std::string> texts_apart(double a, double b,
                                                const std::function<std::string(double, int)>& text,
                                                int digits) {
  constexpr int kMostDigits = 15;
  while (digits < kMostDigits && a != b && text(a, digits) == text(b, digits)) ++digits;
  return {text(a, digits), text(b, digits)};
}

std::pair<std::string, std::string> texts_apart(Angle a, Angle b, int digits) {
  const auto text = [](double radians, int shown) { return angle_text(Angle::from_radians(radians), shown); };
  return texts_apart(a.radians(), b.radians(), text, digits);
}

std::string text_beyond(double value, std::initializer_list<double> bounds,
                        const std::function<std::string(double, int)>& text, int digits) {
  constexpr int kMostDigits = 17;  // rounding: all that a double has
  std::vector<std::string> taken;
  for (const double bound : bounds) taken.push_back(text(bound, digits));
  const auto is_taken = [&](int shown) {
    return std::find(taken.begin(), taken.end(), text(value, shown)) != taken.end();
  };
  while (digits < kMostDigits && is_taken(digits)) ++digits;
  return text(value, digits);
}

std::string size_text(double bytes, int digits) {
  constexpr std::array<const char*, 4> kUnits = {" bytes", " kB", " MB", " GB"};
  std::size_t unit = 0;
  while (bytes >= 1000.0 && unit + 1 < kUnits.size()) {
    bytes /= 1000.0;
    ++unit;
  }
  return rounded_text(bytes, digits) + kUnits[unit];
}

}  // namespace glissade
