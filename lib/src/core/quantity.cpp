#include "glissade/core/quantity.hpp"

#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/odd_characters.hpp"
#include "glissade/core/units.hpp"
#include "glissade/core/words.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace glissade {
namespace {

/// One spelling of a unit. Its size in SI units is multiply / divide: of the two one is 1 wherever a decimal
/// fraction would round, so that 400 mm is the double nearest to 0.4. Degrees Celsius count from `zero`.
struct Unit {
  std::string_view text;
  Dimension dimension;
  double multiply;
  double divide;
  bool listed;  ///< named in messages; further spellings are accepted silently
  double zero = 0.0;
};

constexpr std::array kUnits = {
    Unit{"%", Dimension::number, 1.0, 100.0, true},
    Unit{"m", Dimension::length, 1.0, 1.0, true},
    Unit{"mm", Dimension::length, 1.0, 1e3, true},
    Unit{"cm", Dimension::length, 1.0, 1e2, true},
    Unit{"km", Dimension::length, 1e3, 1.0, true},
    Unit{"um", Dimension::length, 1.0, 1e6, true},
    Unit{"\u00b5m", Dimension::length, 1.0, 1e6, false},
    Unit{"\u03bcm", Dimension::length, 1.0, 1e6, false},
    Unit{"in", Dimension::length, 254.0, 1e4, true},
    Unit{"ft", Dimension::length, 3048.0, 1e4, true},
    Unit{"deg", Dimension::angle, Angle::from_degrees(1.0).radians(), 1.0, true},
    Unit{"\u00b0", Dimension::angle, Angle::from_degrees(1.0).radians(), 1.0, false},
    Unit{"rad", Dimension::angle, 1.0, 1.0, true},
    Unit{"m/s", Dimension::speed, 1.0, 1.0, true},
    Unit{"km/h", Dimension::speed, 10.0, 36.0, true},
    Unit{"mm/s", Dimension::speed, 1.0, 1e3, true},
    Unit{"ft/s", Dimension::speed, 3048.0, 1e4, true},
    Unit{"m/s^2", Dimension::acceleration, 1.0, 1.0, true},
    Unit{"m/s2", Dimension::acceleration, 1.0, 1.0, false},
    Unit{"m/s\u00b2", Dimension::acceleration, 1.0, 1.0, false},
    Unit{"ft/s^2", Dimension::acceleration, 3048.0, 1e4, true},
    Unit{"g", Dimension::acceleration, kStandardGravity, 1.0, true},
    Unit{"1/m", Dimension::per_length, 1.0, 1.0, true},
    Unit{"1/mm", Dimension::per_length, 1e3, 1.0, true},
    Unit{"1/km", Dimension::per_length, 1.0, 1e3, true},
    Unit{"1/ft", Dimension::per_length, 1e4, 3048.0, true},
    Unit{"1/m^2", Dimension::per_area, 1.0, 1.0, true},
    Unit{"1/mm^2", Dimension::per_area, 1e6, 1.0, true},
    Unit{"1/m2", Dimension::per_area, 1.0, 1.0, false},
    Unit{"1/m\u00b2", Dimension::per_area, 1.0, 1.0, false},
    Unit{"m^2/s^2", Dimension::specific_energy, 1.0, 1.0, true},
    Unit{"m2/s2", Dimension::specific_energy, 1.0, 1.0, false},
    Unit{"m\u00b2/s\u00b2", Dimension::specific_energy, 1.0, 1.0, false},
    Unit{"J/kg", Dimension::specific_energy, 1.0, 1.0, true},
    Unit{"s", Dimension::time, 1.0, 1.0, true},
    Unit{"ms", Dimension::time, 1.0, 1e3, true},
    Unit{"min", Dimension::time, 60.0, 1.0, true},
    Unit{"h", Dimension::time, 3600.0, 1.0, true},
    Unit{"kg", Dimension::mass, 1.0, 1.0, true},
    Unit{"t", Dimension::mass, 1e3, 1.0, true},
    Unit{"lb", Dimension::mass, 45359237.0, 1e8, true},
    Unit{"m^2", Dimension::area, 1.0, 1.0, true},
    Unit{"m2", Dimension::area, 1.0, 1.0, false},
    Unit{"m\u00b2", Dimension::area, 1.0, 1.0, false},
    Unit{"cm^2", Dimension::area, 1.0, 1e4, true},
    Unit{"ft^2", Dimension::area, 9290304.0, 1e8, true},
    Unit{"kg/m^3", Dimension::density, 1.0, 1.0, true},
    Unit{"kg/m3", Dimension::density, 1.0, 1.0, false},
    Unit{"kg/m\u00b3", Dimension::density, 1.0, 1.0, false},
    Unit{"t/m^3", Dimension::density, 1e3, 1.0, true},
    Unit{"t/m3", Dimension::density, 1e3, 1.0, false},
    Unit{"t/m\u00b3", Dimension::density, 1e3, 1.0, false},
    Unit{"degC", Dimension::temperature, 1.0, 1.0, true, 273.15},
    Unit{"\u00b0C", Dimension::temperature, 1.0, 1.0, false, 273.15},
    Unit{"K", Dimension::temperature, 1.0, 1.0, true},
    Unit{"t/h", Dimension::mass_flow, 10.0, 36.0, true},
    Unit{"kg/s", Dimension::mass_flow, 1.0, 1.0, true},
    Unit{"kg/h", Dimension::mass_flow, 1.0, 3600.0, true},
    Unit{"kg/min", Dimension::mass_flow, 1.0, 60.0, true},
    Unit{"t/min", Dimension::mass_flow, 1e3, 60.0, true},
    Unit{"lb/h", Dimension::mass_flow, 45359237.0, 36e10, true},
    Unit{"Pa", Dimension::pressure, 1.0, 1.0, true},
    Unit{"kPa", Dimension::pressure, 1e3, 1.0, true},
    Unit{"MPa", Dimension::pressure, 1e6, 1.0, true},
    Unit{"GPa", Dimension::pressure, 1e9, 1.0, true},
    Unit{"W/m^2", Dimension::power_per_area, 1.0, 1.0, true},
    Unit{"W/m2", Dimension::power_per_area, 1.0, 1.0, false},
    Unit{"W/m\u00b2", Dimension::power_per_area, 1.0, 1.0, false},
    Unit{"kW/m^2", Dimension::power_per_area, 1e3, 1.0, true},
    Unit{"s/(m/s)", Dimension::time_per_speed, 1.0, 1.0, true},
    Unit{"s^2/m", Dimension::time_per_speed, 1.0, 1.0, true},
};

std::string_view noun(Dimension dimension) {
  switch (dimension) {
    case Dimension::number:
      return "plain number";
    case Dimension::length:
      return "length";
    case Dimension::angle:
      return "angle";
    case Dimension::speed:
      return "speed";
    case Dimension::acceleration:
      return "acceleration";
    case Dimension::per_length:
      return "value per length";
    case Dimension::per_area:
      return "value per area";
    case Dimension::specific_energy:
      return "squared speed";
    case Dimension::time:
      return "time";
    case Dimension::time_per_speed:
      return "time per speed";
    case Dimension::mass:
      return "mass";
    case Dimension::area:
      return "area";
    case Dimension::density:
      return "density";
    case Dimension::temperature:
      return "temperature";
    case Dimension::mass_flow:
      return "mass flow";
    case Dimension::pressure:
      return "pressure";
    case Dimension::power_per_area:
      return "power per area";
  }
  throw InternalError({"", "a dimension without a name", "", ""});
}

std::string with_article(Dimension dimension) {
  const bool vowel =
      dimension == Dimension::angle || dimension == Dimension::acceleration || dimension == Dimension::area;
  return std::string(vowel ? "an " : "a ").append(noun(dimension));
}

std::vector<std::string_view> listed_units_of(Dimension dimension) {
  std::vector<std::string_view> texts;
  for (const Unit& unit : kUnits) {
    if (unit.dimension == dimension && unit.listed) texts.push_back(unit.text);
  }
  return texts;
}

const Unit* find_unit(std::string_view text) {
  for (const Unit& unit : kUnits) {
    if (unit.text == text) return &unit;
  }
  return nullptr;
}

std::string units_that_fit(Dimension dimension) {
  if (dimension == Dimension::number) return "It takes a plain number, or one with %.";
  return "It takes " + with_article(dimension) +
         " with its unit: " + listed(listed_units_of(dimension), "or") + ".";
}

std::string example(std::string_view number, Dimension dimension) {
  if (dimension == Dimension::number) return std::string(number);
  // Whoever writes a density of 1.6 thinks of tonnes.
  constexpr double kOfTonnes = 30.0;
  double value = std::numeric_limits<double>::infinity();
  std::from_chars(number.data(), number.data() + number.size(), value);
  if (dimension == Dimension::density && value < kOfTonnes) return std::string(number).append(" t/m^3");
  const std::vector<std::string_view> units = listed_units_of(dimension);
  std::string text = std::string(number).append(" ").append(units[0]);
  if (dimension == Dimension::length) text.append(" or ").append(number).append(" ").append(units[1]);
  // Loads are mostly thought of in shares of gravity.
  constexpr double kOfGravity = 9.0;
  if (dimension == Dimension::acceleration && value < kOfGravity)
    text.append(" or ").append(number).append(" g");
  return text;
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r\n";
  const std::size_t first = text.find_first_not_of(kBlank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

std::string named(std::string_view name, std::string_view text) {
  return std::string(name) + ": " + (text.empty() ? std::string("an empty text") : shown(text));
}

Issue not_a_number(std::string_view name, std::string_view text, Dimension dimension) {
  Issue issue{"", named(name, text) + " is not a number", units_that_fit(dimension), ""};
  issue.hint = example("1.5", dimension);
  return issue;
}

/// What "3/10", or "1/20 m", would be as one number; the number before the stroke alone is no such thing.
std::string quotient_hint(std::string_view number, std::string_view unit_text, Dimension dimension) {
  constexpr int kDigits = 6;  // taste
  double above = 0.0;
  double below = 0.0;
  std::from_chars(number.data(), number.data() + number.size(), above);
  const std::string_view divisor = trimmed(unit_text.substr(1));
  const char* const end = divisor.data() + divisor.size();
  const auto [rest, error] = std::from_chars(divisor.data(), end, below);
  const std::string_view unit = trimmed({rest, static_cast<std::size_t>(end - rest)});
  const Unit* const known = find_unit(unit);
  const bool fits =
      unit.empty() ? dimension == Dimension::number : known != nullptr && known->dimension == dimension;
  if (error != std::errc{} || below == 0.0 || !std::isfinite(above / below) || !fits) return "";
  return rounded_text(above / below, kDigits) + (unit.empty() ? "" : " ") + std::string(unit);
}

/// The number that digits say which have been read as one.
double number_of(std::string_view digits) {
  if (digits.starts_with('+')) digits.remove_prefix(1);
  double number = 0.0;
  std::from_chars(digits.data(), digits.data() + digits.size(), number);
  return number;
}

/// A spelling of other programs and trades, and what it is in SI units; theory: by its definition.
struct ForeignUnit {
  std::string_view text;
  Dimension dimension;
  double scale;
  double zero = 0.0;
};

constexpr std::array kForeignUnits = {
    ForeignUnit{"mph", Dimension::speed, 0.44704},
    ForeignUnit{"kmh", Dimension::speed, 1.0 / 3.6},
    ForeignUnit{"kph", Dimension::speed, 1.0 / 3.6},
    ForeignUnit{"kn", Dimension::speed, 1852.0 / 3600.0},
    ForeignUnit{"kt", Dimension::speed, 1852.0 / 3600.0},
    ForeignUnit{"m/min", Dimension::speed, 1.0 / 60.0},
    ForeignUnit{"fpm", Dimension::speed, 0.3048 / 60.0},
    ForeignUnit{"ft/min", Dimension::speed, 0.3048 / 60.0},
    ForeignUnit{"fps", Dimension::speed, 0.3048},
    ForeignUnit{"in/s", Dimension::speed, 0.0254},
    ForeignUnit{"mi/h", Dimension::speed, 0.44704},
    ForeignUnit{"knot", Dimension::speed, 1852.0 / 3600.0},
    ForeignUnit{"gal", Dimension::acceleration, 1e-2},
    ForeignUnit{"cm/s^2", Dimension::acceleration, 1e-2},
    ForeignUnit{"ft/s^2", Dimension::acceleration, 0.3048},
    ForeignUnit{"dm", Dimension::length, 0.1},
    ForeignUnit{"inch", Dimension::length, 0.0254},
    ForeignUnit{"\"", Dimension::length, 0.0254},
    ForeignUnit{"'", Dimension::length, 0.3048},
    ForeignUnit{"yd", Dimension::length, 0.9144},
    ForeignUnit{"yard", Dimension::length, 0.9144},
    ForeignUnit{"fathom", Dimension::length, 1.8288},
    ForeignUnit{"furlong", Dimension::length, 201.168},
    ForeignUnit{"foot", Dimension::length, 0.3048},
    ForeignUnit{"feet", Dimension::length, 0.3048},
    ForeignUnit{"metre", Dimension::length, 1.0},
    ForeignUnit{"meter", Dimension::length, 1.0},
    ForeignUnit{"millimetre", Dimension::length, 1e-3},
    ForeignUnit{"millimeter", Dimension::length, 1e-3},
    ForeignUnit{"degree", Dimension::angle, Angle::from_degrees(1.0).radians()},
    ForeignUnit{"radian", Dimension::angle, 1.0},
    ForeignUnit{"mi", Dimension::length, 1609.344},
    ForeignUnit{"grad", Dimension::angle, Angle::from_degrees(0.9).radians()},
    ForeignUnit{"gon", Dimension::angle, Angle::from_degrees(0.9).radians()},
    ForeignUnit{"mrad", Dimension::angle, 1e-3},
    ForeignUnit{"mm^2", Dimension::area, 1e-6},
    ForeignUnit{"in^2", Dimension::area, 0.0254 * 0.0254},
    ForeignUnit{"ft^2", Dimension::area, 0.3048 * 0.3048},
    ForeignUnit{"sqft", Dimension::area, 0.3048 * 0.3048},
    ForeignUnit{"1/in", Dimension::per_length, 1.0 / 0.0254},
    ForeignUnit{"1/ft", Dimension::per_length, 1.0 / 0.3048},
    ForeignUnit{"1/ft^2", Dimension::per_area, 1.0 / (0.3048 * 0.3048)},
    ForeignUnit{"permille", Dimension::number, 1e-3},
    ForeignUnit{"percent", Dimension::number, 1e-2},
    ForeignUnit{"us", Dimension::time, 1e-6},
    ForeignUnit{"lbs", Dimension::mass, 0.45359237},
    ForeignUnit{"oz", Dimension::mass, 0.45359237 / 16.0},
    ForeignUnit{"st", Dimension::mass, 14.0 * 0.45359237},
    ForeignUnit{"g/s", Dimension::mass_flow, 1e-3},
    ForeignUnit{"lb/min", Dimension::mass_flow, 0.45359237 / 60.0},
    ForeignUnit{"tph", Dimension::mass_flow, 1.0 / 3.6},
    ForeignUnit{"g/cm^3", Dimension::density, 1e3},
    ForeignUnit{"kg/l", Dimension::density, 1e3},
    ForeignUnit{"kg/dm^3", Dimension::density, 1e3},
    ForeignUnit{"g/ml", Dimension::density, 1e3},
    ForeignUnit{"g/l", Dimension::density, 1.0},
    ForeignUnit{"lb/ft^3", Dimension::density, 16.018463},
    ForeignUnit{"pcf", Dimension::density, 16.018463},
    ForeignUnit{"lb/in^3", Dimension::density, 27679.905},
    ForeignUnit{"R", Dimension::temperature, 1.0 / 1.8},
    ForeignUnit{"F", Dimension::temperature, 1.0 / 1.8, 459.67 / 1.8},
    ForeignUnit{"degF", Dimension::temperature, 1.0 / 1.8, 459.67 / 1.8},
    ForeignUnit{"C", Dimension::temperature, 1.0, 273.15},
    ForeignUnit{"bar", Dimension::pressure, 1e5},
    ForeignUnit{"mbar", Dimension::pressure, 1e2},
    ForeignUnit{"psi", Dimension::pressure, 6894.757},
    ForeignUnit{"N/mm^2", Dimension::pressure, 1e6},
    ForeignUnit{"N/m^2", Dimension::pressure, 1.0},
};

/// A value in the unit of another trade, in one that is known; empty for any other unit.
std::string translated(double number, std::string_view unit_text, Dimension dimension) {
  constexpr int kDigits = 6;  // taste
  for (const ForeignUnit& unit : kForeignUnits) {
    if (unit.text == unit_text && unit.dimension == dimension)
      return quantity_text(number * unit.scale + unit.zero, dimension, kDigits);
  }
  return {};
}

/// The unit as it may be meant: a power without its sign, capital letters, a plural.
std::vector<std::string> spellings_of(std::string_view unit_text) {
  std::vector<std::string> all{std::string(unit_text)};
  std::string small = all.front();
  for (char& letter : small) {
    if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
  }
  all.push_back(small);
  const char last = small.back();
  if ((last == '2' || last == '3') && small.size() > 1 && small[small.size() - 2] != '^')
    all.push_back(small.substr(0, small.size() - 1) + '^' + last);
  if (last == 's' && small.size() > 2) all.push_back(small.substr(0, small.size() - 1));
  return all;
}

/// What to try for a value in an unknown unit: what it means in a known one; where that cannot be told no digits, which in
/// another unit would be another value.
std::string in_known_unit(std::string_view digits, std::string_view unit_text, Dimension dimension) {
  for (const std::string& spelling : spellings_of(unit_text)) {
    const Unit* const unit = find_unit(spelling);
    if (unit != nullptr && unit->dimension == dimension) return std::string(digits).append(" ") + spelling;
    std::string text = translated(number_of(digits), spelling, dimension);
    if (!text.empty()) return text;
  }
  if (dimension == Dimension::number) return "a plain number";
  return "a value in " + listed(listed_units_of(dimension), "or");
}

/// Two dimensions of which one is the other per something, or of something more.
bool are_related(Dimension a, Dimension b) {
  constexpr std::array<std::pair<Dimension, Dimension>, 7> kRelated = {{
      {Dimension::length, Dimension::speed},
      {Dimension::length, Dimension::area},
      {Dimension::speed, Dimension::acceleration},
      {Dimension::mass, Dimension::mass_flow},
      {Dimension::mass, Dimension::density},
      {Dimension::per_length, Dimension::per_area},
      {Dimension::time, Dimension::time_per_speed},
  }};
  return std::any_of(kRelated.begin(), kRelated.end(),
                     [&](const auto& pair) { return pair == std::pair(a, b) || pair == std::pair(b, a); });
}

/// The same digits in the units that say the one given with more, or with less: "650 kg" as a mass flow is "650 kg/s,
/// 650 kg/h or 650 kg/min". Where there is no such unit, the value in SI units.
std::string in_related_units(double number, std::string_view digits, const Unit& unit, Dimension dimension) {
  constexpr int kDigits = 6;  // taste
  const auto goes_on = [](std::string_view whole, std::string_view part) {
    return whole.size() > part.size() && whole.starts_with(part) &&
           (whole[part.size()] == '/' || whole[part.size()] == '^');
  };
  std::vector<std::string> texts;
  for (const std::string_view other : listed_units_of(dimension)) {
    if (goes_on(other, unit.text) || goes_on(unit.text, other))
      texts.push_back(std::string(digits).append(" ").append(other));
  }
  if (!texts.empty()) return listed(texts, "or");
  const auto si = std::find_if(kUnits.begin(), kUnits.end(), [&](const Unit& one) {
    return one.dimension == dimension && one.multiply == one.divide;
  });
  return rounded_text(number * unit.multiply / unit.divide, kDigits) + " " + std::string(si->text);
}

/// What a value in the unit of another dimension says of this one, where there is a law between them: a gradient is the
/// tangent of an angle. Empty where there is none.
std::string by_law(double value, std::string_view text, Dimension from, Dimension to) {
  const auto is = [&](Dimension a, Dimension b) { return from == a && to == b; };
  const std::string given(text);
  if (is(Dimension::number, Dimension::angle)) {
    const double angle = math::atan(value);
    return quantity_beyond(angle, to, {-kRightAngle, kRightAngle}) + ", whose tangent is " + given;
  }
  if (is(Dimension::angle, Dimension::number) && std::fabs(value) < kRightAngle)
    return quantity_text(math::tan(value), to) + ", the tangent of " + given;
  if (is(Dimension::number, Dimension::acceleration)) return rounded_text(value, 6) + " g";
  if (is(Dimension::speed, Dimension::specific_energy))
    return quantity_text(value * value, to) + ", the square of " + given;
  if (is(Dimension::specific_energy, Dimension::speed) && value >= 0.0)
    return quantity_text(std::sqrt(value), to) + ", the root of " + given;
  const bool reciprocal =
      is(Dimension::length, Dimension::per_length) || is(Dimension::per_length, Dimension::length);
  if (reciprocal && std::isfinite(1.0 / value))
    return quantity_text(1.0 / value, to) + ", the reciprocal of " + given;
  return {};
}

/// What to try for a value whose unit is of another dimension: what it says of this one, or else its digits.
std::string of_this_dimension(std::string_view text, std::string_view digits, const Unit& unit,
                              Dimension dimension) {
  const double number = number_of(digits);
  const double value = number * unit.multiply / unit.divide + unit.zero;
  if (!std::isfinite(value)) return example(digits, dimension);
  // Of a mass, that is grams.
  if (unit.text == "g" && dimension == Dimension::mass) return rounded_text(number / 1e3, 6) + " kg";
  const std::string meant = by_law(value, text, unit.dimension, dimension);
  if (!meant.empty()) return meant;
  if (are_related(unit.dimension, dimension)) return in_related_units(number, digits, unit, dimension);
  return example(digits, dimension);
}

Issue wrong_unit(std::string_view name, std::string_view text, std::string_view number,
                 std::string_view unit_text, Dimension dimension) {
  if (const Unit* unit = find_unit(unit_text)) {
    const bool is_share = unit->dimension == Dimension::number;
    const std::string what = is_share ? "a share" : with_article(unit->dimension);
    return {"", named(name, text) + " is " + what + ", not " + with_article(dimension),
            units_that_fit(dimension), of_this_dimension(text, number, *unit, dimension)};
  }
  Issue issue{"", named(name, text) + " has the unknown unit " + shown(unit_text), units_that_fit(dimension),
              in_known_unit(number, unit_text, dimension)};
  if (unit_text.front() == ',') issue.hint = "a decimal point instead of the comma";
  if (unit_text.front() == '/') {
    issue.why = "A value is one decimal number, not a quotient. " + issue.why;
    issue.hint = quotient_hint(number, unit_text, dimension);
  }
  return issue;
}

Issue beyond_numbers(std::string_view name, std::string_view text, Dimension dimension) {
  return {"", named(name, text) + " is beyond the range of numbers",
          "Numbers reach from about 1e-308 to 1e308.", example("1.5", dimension)};
}

/// What is wrong with a text that reads as a quantity, or comes nearer to one, once its odd characters are
/// plain ones.
Issue with_odd_character(std::string_view name, std::string_view text, const OddCharacter& odd,
                         Dimension dimension) {
  const std::string plain(trimmed(with_plain_characters(text)));
  const auto reading = read_quantity(plain, dimension, name);
  Issue issue{"", named(name, text) + " holds " + odd.name,
              "It takes blanks, digits and signs of the keyboard.", plain};
  if (const Issue* const other = std::get_if<Issue>(&reading)) {
    issue.why = other->why;
    issue.hint = other->hint;
  }
  return issue;
}

}  // namespace

std::variant<double, Issue> read_quantity(std::string_view text, Dimension dimension, std::string_view name) {
  if (const auto odd = odd_character(text)) return with_odd_character(name, text, *odd, dimension);
  text = trimmed(text);
  std::string_view digits = text;
  if (digits.starts_with('+') && !digits.starts_with("+-")) digits.remove_prefix(1);
  double number = 0.0;
  const char* const end = digits.data() + digits.size();
  const auto [rest, error] = std::from_chars(digits.data(), end, number);
  if (error == std::errc::result_out_of_range) return beyond_numbers(name, text, dimension);
  if (error != std::errc{}) return not_a_number(name, text, dimension);
  if (!std::isfinite(number)) {
    return Issue{"", named(name, text) + " is not finite", units_that_fit(dimension),
                 example("1.5", dimension)};
  }

  const std::string_view number_text(text.data(), static_cast<std::size_t>(rest - text.data()));
  const std::string_view unit_text = trimmed({rest, static_cast<std::size_t>(end - rest)});
  if (unit_text.empty() && dimension == Dimension::number) return number;
  if (unit_text.empty()) {
    return Issue{"", named(name, text) + " has no unit", units_that_fit(dimension),
                 example(number_text, dimension)};
  }
  const Unit* const unit = find_unit(unit_text);
  if (unit == nullptr || unit->dimension != dimension) {
    return wrong_unit(name, text, number_text, unit_text, dimension);
  }
  const double value = number * unit->multiply / unit->divide + unit->zero;
  if (!std::isfinite(value)) return beyond_numbers(name, text, dimension);
  return value;
}

double parse_quantity(std::string_view text, Dimension dimension, std::string_view name) {
  const auto reading = read_quantity(text, dimension, name);
  if (const Issue* issue = std::get_if<Issue>(&reading)) throw InputError(*issue);
  return std::get<double>(reading);
}

std::vector<UnitName> units_of(Dimension dimension) {
  std::vector<UnitName> units;
  for (const Unit& unit : kUnits) {
    if (unit.dimension == dimension) units.push_back({unit.text, unit.listed});
  }
  return units;
}

std::string written_quantity(double value, Dimension dimension) {
  // Of every dimension one is the SI unit, whose 17 digits are the value: of no number of t/h, say, is 7.7 kg/s the
  // nearest double.
  constexpr std::array<std::string_view, 6> kBesides = {"mm", "rad", "km/h", "g", "K", "kg/s"};
  constexpr int kMostDigits = 17;
  for (int digits = 1; digits <= kMostDigits; ++digits) {
    for (const Unit& unit : kUnits) {
      const bool first = unit.text == unit_for_people(dimension);
      const bool beside = std::find(kBesides.begin(), kBesides.end(), unit.text) != kBesides.end();
      if (unit.dimension != dimension || !(first || beside)) continue;
      const std::string text = rounded_text((value - unit.zero) / unit.multiply * unit.divide, digits) + " " +
                               std::string(unit.text);
      const auto read = read_quantity(text, dimension, "");
      if (const double* const again = std::get_if<double>(&read); again != nullptr && *again == value)
        return text;
    }
  }
  if (dimension == Dimension::number) return exact_text(value);
  throw InternalError({"", "no " + std::string(noun(dimension)) + " reads as " + exact_text(value), "", ""});
}

std::string_view unit_for_people(Dimension dimension) {
  switch (dimension) {
    case Dimension::number:
      return "";
    case Dimension::length:
      return "m";
    case Dimension::angle:
      return "deg";
    case Dimension::speed:
      return "m/s";
    case Dimension::acceleration:
      return "m/s^2";
    case Dimension::per_length:
      return "1/m";
    case Dimension::per_area:
      return "1/m^2";
    case Dimension::specific_energy:
      return "m^2/s^2";
    case Dimension::time:
      return "s";
    case Dimension::time_per_speed:
      return "s/(m/s)";
    case Dimension::mass:
      return "kg";
    case Dimension::area:
      return "m^2";
    case Dimension::density:
      return "kg/m^3";
    case Dimension::temperature:
      return "K";
    case Dimension::mass_flow:
      return "t/h";
    case Dimension::pressure:
      return "Pa";
    case Dimension::power_per_area:
      return "W/m^2";
  }
  throw InternalError({"", "a dimension without a unit", "", ""});
}

double in_unit_for_people(double value, Dimension dimension) {
  if (dimension == Dimension::angle) return Angle::from_radians(value).degrees();
  if (dimension == Dimension::mass_flow) return value * 36.0 / 10.0;
  return value;
}

std::string quantity_text(double value, Dimension dimension, int digits) {
  if (std::isnan(value)) return "not a number";
  if (std::isinf(value)) return "unbounded";
  if (dimension == Dimension::angle) return angle_text(Angle::from_radians(value), digits);
  if (dimension == Dimension::length) return length_text(value, digits);
  const std::string_view unit = unit_for_people(dimension);
  return rounded_text(in_unit_for_people(value, dimension), digits) + (unit.empty() ? "" : " ") +
         std::string(unit);
}

std::string quantity_beyond(double value, Dimension dimension, std::initializer_list<double> bounds) {
  const auto text = [&](double shown, int digits) { return quantity_text(shown, dimension, digits); };
  return text_beyond(value, bounds, text);
}

namespace {

/// What lies within bounds; empty where there are none.
std::string within(Dimension dimension, std::initializer_list<double> bounds) {
  if (bounds.size() == 0) return {};
  const double least = std::min(bounds);
  const double most = std::max(bounds);
  const std::string lowest = quantity_text(least, dimension);
  if (bounds.size() == 1 || !std::isfinite(most)) return lowest + " or more";
  return "a value from " + lowest + " to " + quantity_text(most, dimension);
}

}  // namespace

Issue out_of_range(std::string_view name, double value, Dimension dimension,
                   std::initializer_list<double> bounds, std::string why, std::string hint) {
  if (hint.empty()) hint = within(dimension, bounds);
  return {"", std::string(name) + ": " + quantity_beyond(value, dimension, bounds) + " is out of range",
          std::move(why), std::move(hint)};
}

}  // namespace glissade
