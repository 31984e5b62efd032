#include "glissade/core/width_law.hpp"

#include "glissade/core/error.hpp"

#include "support/catch.hpp"

#include <utility>
#include <vector>

using namespace glissade;

TEST_CASE("width law: linear between places, constant outside them") {
  const WidthLaw law(std::vector<WidthAt>{{1.0, 0.6}, {3.0, 0.4}, {4.0, 0.4}});
  CHECK(law.at(0.0) == 0.6);
  CHECK(law.at(1.0) == 0.6);
  CHECK(law.at(2.0) == Approx(0.5).epsilon(1e-15));
  CHECK(law.at(3.0) == 0.4);
  CHECK(law.at(9.0) == 0.4);
  CHECK(law.slope(0.5) == 0.0);
  CHECK(law.slope(1.0) == Approx(-0.1).epsilon(1e-14));
  CHECK(law.slope(3.5) == 0.0);
  CHECK(law.narrowest() == 0.4);
  CHECK(law.widest() == 0.6);
  CHECK_FALSE(law.is_constant());
}

TEST_CASE("width law: a number is a constant law, whatever place it was said at") {
  const WidthLaw law = 0.4;
  CHECK(law.is_constant());
  CHECK(law.at(7.0) == 0.4);
  CHECK(law == WidthLaw(std::vector<WidthAt>{{3.0, 0.4}}));
  CHECK(WidthLaw(std::vector<WidthAt>{{3.0, 0.4}}).last_place() == 3.0);
  CHECK(WidthLaw(std::vector<WidthAt>{{1.0, 0.4}, {3.0, 0.4}}).last_place() == 3.0);
}

TEST_CASE("width law: a regular value, also when something was moved from it") {
  WidthLaw law(std::vector<WidthAt>{{1.0, 0.6}, {3.0, 0.4}});
  const WidthLaw copy = law;
  const WidthLaw moved = std::move(law);
  CHECK(moved == copy);
  // NOLINTBEGIN(bugprone-use-after-move): what this is about
  CHECK(law.at(2.0) == law.at(2.0));
  CHECK(law.narrowest() <= law.widest());
  law = WidthLaw(0.3);
  CHECK(law.at(2.0) == 0.3);
  // NOLINTEND(bugprone-use-after-move)
}

TEST_CASE("width law: places ascend, and there is one at least") {
  CHECK_THROWS_WITH(WidthLaw(std::vector<WidthAt>{}),
                    Catch::Matchers::StartsWith("width: no place is given"));
  CHECK_THROWS_WITH(WidthLaw(std::vector<WidthAt>{{2.0, 0.4}, {2.0, 0.5}}),
                    Catch::Matchers::StartsWith("width: the place at 2 m does not lie after the one at 2 m"));
}
