#pragma once

#include "glissade/core/units.hpp"

#include <functional>
#include <initializer_list>
#include <string>
#include <utility>

namespace glissade {

/// @return the shortest decimal text that reads back as exactly `value`, independent of locale;
///         "nan", "inf", "-inf" where it is not finite
[[nodiscard]] std::string exact_text(double value);

/// @return the same without an exponent, for coordinates: "4000000"
[[nodiscard]] std::string decimal_text(double value);

/// @param digits  significant digits; 1 to 17
/// @return `value` rounded to `digits` significant digits, without trailing zeros, in plain notation where
///         the exponent lies within -5 to 9; independent of locale
[[nodiscard]] std::string rounded_text(double value, int digits);

/// @return a length for people, in the unit that suits its size: "0 mm", "0.35 mm", "412 mm", "5.4 m", "1.2 km"
[[nodiscard]] std::string length_text(double metres, int digits = 4);

/// @return an angle for people: "17 deg"; "0 deg" below 1e-12 rad, which no drawing can tell from level
[[nodiscard]] std::string angle_text(Angle angle, int digits = 4);

/// Two values that a message holds against each other.
/// @param text    how one of them is written with so many digits, e.g. &length_text
/// @param digits  how many are enough where the two differ anyhow
/// @return both with the digits that it takes to tell them apart, at most 15; equal texts for equal values
[[nodiscard]] std::pair<std::string, std::string> texts_apart(
    double a, double b, const std::function<std::string(double, int)>& text, int digits = 4);
/// The same of two angles.
[[nodiscard]] std::pair<std::string, std::string> texts_apart(Angle a, Angle b, int digits = 4);

/// A value that bounds refuse, beside whose texts a message shows it.
/// @param bounds  as `text` writes them with `digits`
/// @return it with the digits that it takes to tell it from all of them, at most 17: never rounded onto one
[[nodiscard]] std::string text_beyond(double value, std::initializer_list<double> bounds,
                                      const std::function<std::string(double, int)>& text, int digits = 4);

/// @return a size of memory or of a file for people: "512 bytes", "3.41 MB"
[[nodiscard]] std::string size_text(double bytes, int digits = 3);

}  // namespace glissade
