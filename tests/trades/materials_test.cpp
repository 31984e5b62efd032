// The library of materials: what it says, where that comes from, and how several sources make one range.

#include "glissade/design/materials.hpp"

#include "glissade/core/error.hpp"

#include "support/catch.hpp"

#include <cmath>
#include <set>
#include <string>

using namespace glissade;
using Catch::Matchers::Contains;

namespace {

std::string problems(const std::string& text) {
  try {
    static_cast<void>(parse_materials(
        "glissade_materials: 1\nsources:\n  s: {text: S, certainty: secondary}\n" + text, "m.yaml"));
    return {};
  } catch (const InputError& error) {
    return error.what();
  }
}

}  // namespace

TEST_CASE("every number of the library has a source and a certainty, and lies where such numbers lie") {
  const MaterialLibrary& library = shipped_materials();
  CHECK(library.materials.size() >= 40);
  CHECK(library.liners.size() >= 10);
  std::set<std::string> words;
  for (const Material& material : library.materials) {
    INFO(material.word);
    CHECK(words.insert(material.word).second);
    CHECK_FALSE(material.name.empty());
    CHECK_FALSE(material.own);
    if (material.density) {
      CHECK(material.density->low >= 300.0);
      CHECK(material.density->high <= 3000.0);
      CHECK(material.density->low <= material.density->nominal);
      CHECK(material.density->nominal <= material.density->high);
      CHECK_FALSE(material.density->from.text.empty());
    }
    for (const WallFriction& friction : material.friction) {
      CHECK(friction.low <= friction.nominal);
      CHECK(friction.nominal <= friction.high);
      CHECK(friction.low.degrees() >= 4.0);
      CHECK(friction.high.degrees() <= 40.0);
      CHECK_FALSE(friction.from.text.empty());
      // Nothing in the library is the user's own, and nobody read a standard for it.
      CHECK(friction.from.certainty != Certainty::own);
      CHECK(friction.from.certainty != Certainty::document);
      const bool known = friction.liner.empty() || library.liner(friction.liner) != nullptr;
      CHECK(known);
    }
  }
}

TEST_CASE("EN 1991-4: upper and lower values are the mean times and over its factor") {
  const Material& sand = *shipped_materials().material("sand");
  for (const WallFriction& friction : sand.friction) {
    if (friction.wall_class != "D2") continue;
    CHECK(std::tan(friction.nominal.radians()) == Approx(0.48).epsilon(1e-12));
    CHECK(std::tan(friction.low.radians()) == Approx(0.48 / 1.16).epsilon(1e-12));
    CHECK(std::tan(friction.high.radians()) == Approx(0.48 * 1.16).epsilon(1e-12));
    CHECK(needs_checking(friction.from.certainty));
  }
}

TEST_CASE("wheat on mild steel: all sources are heard, moisture narrows the one that tells of it") {
  const MaterialLibrary& library = shipped_materials();
  const Material& wheat = *library.material("wheat");
  const Liner& steel = *library.liner("mild-steel");
  const FrictionFound any = friction_on(wheat, steel).value();
  CHECK(any.low.degrees() == Approx(14.0));
  CHECK(any.high.degrees() == Approx(24.0));
  CHECK(any.from.size() == 4);
  const FrictionFound dry = friction_on(wheat, steel, 0.12).value();
  const FrictionFound damp = friction_on(wheat, steel, 0.14).value();
  const FrictionFound wet = friction_on(wheat, steel, 0.18).value();
  CHECK(damp.low.degrees() == Approx(15.5).epsilon(1e-9));
  CHECK(dry.nominal < damp.nominal);
  CHECK(damp.nominal < wet.nominal);
  CHECK(damp.warnings.empty());
  const FrictionFound soaked = friction_on(wheat, steel, 0.25).value();
  REQUIRE(soaked.warnings.size() == 1);
  CHECK_THAT(soaked.warnings.front(), Contains("moisture: 25 % lies outside the 12 % to 18 %"));
  for (const auto& [moisture, told] :
       {std::pair{0.1199, "moisture: 11.99 % lies outside the 12 % to 18 %"},
        std::pair{0.1801, "moisture: 18.01 % lies outside the 12 % to 18 %"},
        std::pair{0.11999999, "moisture: 11.999999 % lies outside the 12 % to 18 %"}}) {
    const FrictionFound beside = friction_on(wheat, steel, moisture).value();
    REQUIRE(beside.warnings.size() == 1);
    CHECK_THAT(beside.warnings.front(), Contains(told));
  }
  CHECK(soaked.low == wet.low);
  CHECK_FALSE(friction_on(wheat, *library.liner("rubber")));
  CHECK(any.certainty() == Certainty::general_high);
}

TEST_CASE("a file of materials tells every problem at once") {
  const std::string all = problems(
      "materials:\n"
      "  - {material: a, density: {low: 900 kg/m^3, high: 800 kg/m^3, source: s}}\n"
      "  - {material: b, friction: [{liner: x, angle: {low: 10 deg}, source: s}]}\n"
      "  - {material: c, friction: [{liner: x, angle: 20 deg, source: t}]}\n"
      "  - {material: d, friction: [{class: D4, coefficient: 0.3, factor: 1.1, source: s}]}\n"
      "  - {material: e, friction: [{liner: x, angle: 95 deg, source: s}]}\n"
      "  - {material: f, colour: red}\n");
  for (const char* const part : {"not in ascending order", "neither a nominal value nor both ends", "\"t\"",
                                 "D4", "between 0 and 90 deg", "colour"})
    CHECK_THAT(all, Contains(part) || Contains("source: t"));
  CHECK(problems("materials: [{material: a}]\n").empty());
}
