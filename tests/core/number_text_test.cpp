#include "glissade/core/number_text.hpp"

#include "support/catch.hpp"

#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>
#include <utility>

using namespace glissade;

TEST_CASE("exact text reads back as the same double") {
  for (const double value : {0.1, 1.0 / 3.0, 6.02214076e23, -5e-324, 9.81, 1e22, 0.0}) {
    CHECK(std::strtod(exact_text(value).c_str(), nullptr) == value);
  }
  CHECK(exact_text(0.1) == "0.1");
  CHECK(exact_text(std::numeric_limits<double>::infinity()) == "inf");
}

TEST_CASE("rounded text keeps significant digits and drops trailing zeros") {
  CHECK(rounded_text(2.14712546857048, 6) == "2.14713");
  CHECK(rounded_text(2.5, 6) == "2.5");
  CHECK(rounded_text(0.99999999, 3) == "1");
  CHECK(rounded_text(-1234.5678, 6) == "-1234.57");
  CHECK(rounded_text(1.5e-9, 3) == "1.5e-09");
  CHECK(rounded_text(0.0, 3) == "0");
}

TEST_CASE("lengths are shown in the unit that suits their size") {
  CHECK(length_text(0.00035) == "0.35 mm");
  CHECK(length_text(0.4) == "400 mm");
  CHECK(length_text(5.4) == "5.4 m");
  CHECK(length_text(12000) == "12 km");
  CHECK(length_text(0.99996) == "1 m");
  CHECK(length_text(-0.99996) == "-1 m");
  CHECK(length_text(0.99994) == "999.9 mm");
  CHECK(length_text(0.99996, 6) == "999.96 mm");
  CHECK(length_text(9999.6) == "10 km");
  CHECK(length_text(9999.4) == "9999 m");
  CHECK(angle_text(Angle::from_radians(0.29670597283903605)) == "17 deg");
  CHECK(angle_text(Angle::from_radians(-8.7e-16)) == "0 deg");
  CHECK(angle_text(Angle::from_radians(1e-9)) == "5.73e-08 deg");
}

TEST_CASE("number text: decimals have no exponent and read back as the same number") {
  CHECK(decimal_text(4e6) == "4000000");
  CHECK(decimal_text(-0.1) == "-0.1");
  CHECK(std::strtod(decimal_text(5e-324).c_str(), nullptr) == 5e-324);  // stod() refuses what is not normal
  CHECK(std::stod(decimal_text(-1.7976931348623157e308)) == -1.7976931348623157e308);
}

TEST_CASE("two values that a message holds against each other are written with digits that tell them apart") {
  using Texts = std::pair<std::string, std::string>;
  CHECK(texts_apart(1.0, 2.0, &length_text) == Texts{"1 m", "2 m"});
  CHECK(texts_apart(0.0005, 0.00036056, &length_text) == Texts{"0.5 mm", "0.3606 mm"});
  CHECK(texts_apart(33.6901, 33.6899, [](double value, int digits) { return rounded_text(value, digits); }) ==
        Texts{"33.6901", "33.6899"});
  CHECK(texts_apart(2.0, 2.0, &length_text) == Texts{"2 m", "2 m"});
  CHECK(texts_apart(0.99999, 1.0, &length_text) == Texts{"999.99 mm", "1 m"});
}

TEST_CASE("a value that bounds refuse is never written as one of them, and in the unit of the bound") {
  CHECK(text_beyond(10'001.0, {0.0, 10'000.0}, &rounded_text) == "10001");
  CHECK(text_beyond(10'000'001.0, {-1e7, 1e7}, &length_text) == "10000.001 km");
  CHECK(text_beyond(12'345.6, {1e4}, &length_text) == "12.35 km");
  CHECK(text_beyond(std::nextafter(1e4, 2e4), {1e4}, &rounded_text) == "10000.000000000002");
  // Of the bound itself there is nothing to tell apart.
  CHECK(text_beyond(1.0, {1.0}, &rounded_text) == "1");
}
