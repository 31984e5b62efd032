#include "glissade/core/quantity.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/units.hpp"

#include "support/catch.hpp"
#include "support/random.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <string_view>

using namespace glissade;

namespace {

std::string refusal(std::string_view text, Dimension dimension) {
  try {
    static_cast<void>(parse_quantity(text, dimension, "width"));
    return {};
  } catch (const InputError& error) {
    return error.what();
  }
}

/// What a refused text's message says to try.
std::string tried(const std::string& text, Dimension dimension) {
  const std::string message = refusal(text, dimension);
  return message.substr(message.rfind("Try: ") + 5);
}

}  // namespace

TEST_CASE("a length in any unit is the double nearest to its value in metres") {
  CHECK(parse_quantity("400 mm", Dimension::length, "") == 0.4);
  CHECK(parse_quantity("0.1 mm", Dimension::length, "") == 0.0001);
  CHECK(parse_quantity("41 cm", Dimension::length, "") == 0.41);
  CHECK(parse_quantity("5.4 m", Dimension::length, "") == 5.4);
  CHECK(parse_quantity("1.5 km", Dimension::length, "") == 1500.0);
  CHECK(parse_quantity("7 um", Dimension::length, "") == 7e-6);
  CHECK(parse_quantity("7 \u00b5m", Dimension::length, "") == 7e-6);
  CHECK(parse_quantity("1 in", Dimension::length, "") == 0.0254);
  CHECK(parse_quantity("10 ft", Dimension::length, "") == 3.048);
}

TEST_CASE("every dimension has its units") {
  CHECK(parse_quantity("180 deg", Dimension::angle, "") == std::numbers::pi);
  CHECK(parse_quantity("0.5 rad", Dimension::angle, "") == 0.5);
  CHECK(parse_quantity("90\u00b0", Dimension::angle, "") == std::numbers::pi / 2);
  CHECK(parse_quantity("3 m/s", Dimension::speed, "") == 3.0);
  CHECK(parse_quantity("36 km/h", Dimension::speed, "") == 10.0);
  CHECK(parse_quantity("9.81 m/s^2", Dimension::acceleration, "") == 9.81);
  CHECK(parse_quantity("2 g", Dimension::acceleration, "") == 2 * 9.80665);
  CHECK(parse_quantity("0.0013 1/m", Dimension::per_length, "") == 0.0013);
  CHECK(parse_quantity("2 1/mm", Dimension::per_length, "") == 2000.0);
  CHECK(parse_quantity("0.1 1/m^2", Dimension::per_area, "") == 0.1);
  CHECK(parse_quantity("100 m^2/s^2", Dimension::specific_energy, "") == 100.0);
  CHECK(parse_quantity("100 J/kg", Dimension::specific_energy, "") == 100.0);
  CHECK(parse_quantity("0.306", Dimension::number, "") == 0.306);
  CHECK(parse_quantity("30 %", Dimension::number, "") == 0.3);
}

TEST_CASE("the blank before a unit may be left out, and a plus sign or an exponent be there") {
  CHECK(parse_quantity("19deg", Dimension::angle, "") == parse_quantity("19 deg", Dimension::angle, ""));
  CHECK(parse_quantity("  +5e-1 m ", Dimension::length, "") == 0.5);
  CHECK(parse_quantity("-2.5m", Dimension::length, "") == -2.5);
}

TEST_CASE("a value without a unit is refused with the units that fit") {
  CHECK(refusal("400", Dimension::length) ==
        "width: 400 has no unit\n"
        "      It takes a length with its unit: m, mm, cm, km, um, in or ft.\n"
        "      Try: 400 m or 400 mm");
  CHECK_THAT(refusal("0", Dimension::angle), Catch::Matchers::Contains("0 has no unit"));
  CHECK_THAT(refusal("3", Dimension::acceleration), Catch::Matchers::EndsWith("Try: 3 m/s^2 or 3 g"));
  CHECK_THAT(refusal("9.81", Dimension::acceleration), Catch::Matchers::EndsWith("Try: 9.81 m/s^2"));
}

TEST_CASE("a value of another dimension is refused by its name") {
  CHECK(refusal("17 mm", Dimension::angle) ==
        "width: 17 mm is a length, not an angle\n"
        "      It takes an angle with its unit: deg or rad.\n"
        "      Try: 17 deg");
  CHECK_THAT(refusal("30 %", Dimension::length), Catch::Matchers::Contains("30 % is a share, not a length"));
  CHECK_THAT(refusal("3 deg", Dimension::number), Catch::Matchers::Contains("an angle, not a plain number"));
  CHECK_THAT(refusal("4 furlong", Dimension::length),
             Catch::Matchers::Contains("has the unknown unit furlong") &&
                 Catch::Matchers::Contains("Try: 804.672 m"));
}

TEST_CASE("a value in an unknown unit is tried in a known one only where it means the same") {
  CHECK(tried("500 cm2", Dimension::area) == "500 cm^2");
  CHECK(tried("5 sqft", Dimension::area) == "0.464515 m^2");
  CHECK(tried("981 cm/s^2", Dimension::acceleration) == "9.81 m/s^2");
  CHECK(tried("1.2 g/l", Dimension::density) == "1.2 kg/m^3");
  CHECK(tried("0.284 lb/in^3", Dimension::density) == "7861.09 kg/m^3");
  CHECK(tried("60 g/s", Dimension::mass_flow) == "0.216 t/h");
  CHECK(tried("10 knots", Dimension::speed) == "5.14444 m/s");
  CHECK(tried("12 Degrees", Dimension::angle) == "12 deg");
  CHECK(tried("5 MM", Dimension::length) == "5 mm");
  CHECK(tried("30 permille", Dimension::number) == "0.03");
  // Of others the units alone are told: the digits would be another value.
  CHECK(tried("10 cubits", Dimension::length) == "a value in m, mm, cm, km, um, in or ft");
  CHECK(tried("400 HB", Dimension::pressure).find("400") == std::string::npos);
}

TEST_CASE("what to try for a value of a related quantity means what was written") {
  // A gradient is a tangent.
  CHECK(tried("30 %", Dimension::angle) == "16.7 deg, whose tangent is 30 %");
  CHECK(tried("-30 %", Dimension::angle) == "-16.7 deg, whose tangent is -30 %");
  CHECK(tried("17 deg", Dimension::number) == "0.3057, the tangent of 17 deg");
  CHECK(tried("150 %", Dimension::acceleration) == "1.5 g");
  CHECK(tried("9 m/s", Dimension::specific_energy) == "81 m^2/s^2, the square of 9 m/s");
  CHECK(tried("81 m^2/s^2", Dimension::speed) == "9 m/s, the root of 81 m^2/s^2");
  CHECK(tried("50 m", Dimension::per_length) == "0.02 1/m, the reciprocal of 50 m");
  CHECK(tried("0.02 1/m", Dimension::length) == "50 m, the reciprocal of 0.02 1/m");
  CHECK(tried("500 g", Dimension::mass) == "0.5 kg");
  // Per something, or of something more, in the unit that was written.
  CHECK(tried("650 kg", Dimension::mass_flow) == "650 kg/s, 650 kg/h or 650 kg/min");
  CHECK(tried("650 t", Dimension::mass_flow) == "650 t/h or 650 t/min");
  CHECK(tried("650 kg/h", Dimension::mass) == "650 kg");
  CHECK(tried("20 km", Dimension::speed) == "20 km/h");
  CHECK(tried("3 cm", Dimension::speed) == "0.03 m/s");
  CHECK(tried("3 ft", Dimension::area) == "3 ft^2");
  CHECK(tried("1.6 t", Dimension::density) == "1.6 t/m^3");
  // A guess at a slip of the key, where nothing else can be meant.
  CHECK(tried("17 mm", Dimension::angle) == "17 deg");
}

TEST_CASE("what to try for a unit of another trade is the same value") {
  CHECK_THAT(refusal("60 mph", Dimension::speed), Catch::Matchers::EndsWith("Try: 26.8224 m/s"));
  CHECK_THAT(refusal("50 gon", Dimension::angle), Catch::Matchers::EndsWith("Try: 45 deg"));
  CHECK_THAT(refusal("2 bar", Dimension::pressure), Catch::Matchers::EndsWith("Try: 200000 Pa"));
  CHECK_THAT(refusal("68 F", Dimension::temperature), Catch::Matchers::EndsWith("Try: 293.15 K"));
  CHECK_THAT(refusal("2 g/cm^3", Dimension::density), Catch::Matchers::EndsWith("Try: 2000 kg/m^3"));
}

TEST_CASE("a character that only looks like a plain one is named, with what to write") {
  CHECK(refusal("11\u00a0deg", Dimension::angle) ==
        "width: 11<U+00A0>deg holds a no-break space (U+00A0)\n"
        "      It takes blanks, digits and signs of the keyboard.\n"
        "      Try: 11 deg");
  CHECK_THAT(refusal("11\u2009deg", Dimension::angle), Catch::Matchers::Contains("a thin space (U+2009)"));
  CHECK_THAT(refusal("\u22121 m", Dimension::length),
             Catch::Matchers::Contains("\u22121 m holds a minus sign (U+2212)") &&
                 Catch::Matchers::Contains("Try: -1 m"));
  CHECK_THAT(refusal("\u20131 m", Dimension::length), Catch::Matchers::Contains("a dash (U+2013)"));
  CHECK_THAT(refusal("4\u200b00 mm", Dimension::length),
             Catch::Matchers::Contains("4<U+200B>00 mm holds a zero-width mark") &&
                 Catch::Matchers::Contains("Try: 400 mm"));
  CHECK_THAT(refusal("\uff14 m", Dimension::length), Catch::Matchers::Contains("a full-width 4 (U+FF14)"));
  CHECK_THAT(refusal("90\u00ba", Dimension::angle), Catch::Matchers::Contains("Try: 90\u00b0"));
  // On the screen it is the same letter.
  CHECK(refusal("5 \u043c", Dimension::length) ==
        "width: 5 \u043c holds a Cyrillic letter (U+043C)\n"
        "      It takes blanks, digits and signs of the keyboard.\n"
        "      Try: 5 m");
  CHECK_THAT(refusal("5 c\u043c", Dimension::length), Catch::Matchers::Contains("Try: 5 cm"));
  CHECK_THAT(refusal("5 \u0434\u043c", Dimension::length),
             Catch::Matchers::Contains("the unknown unit \u0434\u043c"));
  // What is wrong beside it is said in the hint.
  CHECK_THAT(refusal("17\u00a0mm", Dimension::angle), Catch::Matchers::Contains("Try: 17 deg"));
}

TEST_CASE("only finite decimal numbers are numbers") {
  for (const char* text : {"nan m", "inf m", "-inf m", "infinity m"}) {
    INFO(text);
    CHECK_THAT(refusal(text, Dimension::length), Catch::Matchers::Contains("is not finite"));
  }
  CHECK_THAT(refusal("1e999 m", Dimension::length), Catch::Matchers::Contains("beyond the range of numbers"));
  CHECK_THAT(refusal("1e306 km", Dimension::length),
             Catch::Matchers::Contains("beyond the range of numbers"));
  CHECK_THAT(refusal("0x10 m", Dimension::length), Catch::Matchers::Contains("unknown unit x10 m"));
  CHECK_THAT(refusal("wide", Dimension::length), Catch::Matchers::Contains("width: wide is not a number"));
  CHECK_THAT(refusal("", Dimension::length), Catch::Matchers::Contains("an empty text is not a number"));
  CHECK_THAT(refusal("+-5 m", Dimension::length), Catch::Matchers::Contains("is not a number"));
  CHECK_THAT(refusal("5,4 m", Dimension::length),
             Catch::Matchers::Contains("a decimal point instead of the comma"));
}

TEST_CASE("every value of every dimension is written as a text that reads as exactly that value") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  constexpr int kLast = static_cast<int>(Dimension::power_per_area);
  constexpr int kTries = 3000;
  for (int which = 0; which <= kLast; ++which) {
    const auto dimension = static_cast<Dimension>(which);
    int wrong = 0;
    std::string first;
    for (int i = 0; i < kTries; ++i) {
      double value = random.between(-1.0, 1.0) * std::pow(10.0, random.between(-9.0, 9.0));
      // Such as people write, and such as they do not.
      if (i % 3 == 1) value = std::floor(value * 1000.0) / 1000.0;
      if (i % 3 == 2) value *= std::pow(10.0, random.between(-290.0, 290.0));
      const std::string text = written_quantity(value, dimension);
      if (parse_quantity(text, dimension, "it") == value) continue;
      if (wrong++ == 0) first = text;
    }
    INFO("dimension " << which << ", first " << first);
    CHECK(wrong == 0);
    CHECK(parse_quantity(written_quantity(0.0, dimension), dimension, "it") == 0.0);
    const double least = std::numeric_limits<double>::denorm_min();
    CHECK(parse_quantity(written_quantity(least, dimension), dimension, "it") == least);
  }
}

TEST_CASE("a mass flow that no number of t/h reads as is written in kg/s") {
  CHECK(written_quantity(7.7, Dimension::mass_flow) == "7.7 kg/s");
  CHECK(written_quantity(0.1, Dimension::mass_flow) == "0.1 kg/s");
  CHECK(written_quantity(parse_quantity("400 t/h", Dimension::mass_flow, ""), Dimension::mass_flow) ==
        "400 t/h");
}

TEST_CASE("a quotient is answered with its value, not with the number before its stroke") {
  CHECK_THAT(refusal("3/10", Dimension::number),
             Catch::Matchers::Contains("not a quotient") && Catch::Matchers::EndsWith("Try: 0.3"));
  CHECK_THAT(refusal("1/20 m", Dimension::length), Catch::Matchers::EndsWith("Try: 0.05 m"));
  for (const char* const text : {"3/0", "3/x", "1/20 kg"})
    CHECK_THAT(refusal(text, Dimension::length), !Catch::Matchers::Contains("Try:"));
}

TEST_CASE("what is no number is told as that, what has no bound as unbounded") {
  CHECK(quantity_text(std::nan(""), Dimension::angle) == "not a number");
  CHECK(quantity_text(std::nan(""), Dimension::length) == "not a number");
  CHECK(quantity_text(HUGE_VAL, Dimension::angle) == "unbounded");
  CHECK(quantity_text(HUGE_VAL, Dimension::speed) == "unbounded");
  CHECK_THROWS_WITH(Friction::from_angle(Angle::from_radians(std::nan(""))),
                    Catch::Matchers::Contains("friction angle not a number is out of range"));
}
