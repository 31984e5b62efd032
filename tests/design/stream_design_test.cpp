// The group `stream`: a stream of bulk solid, and what it asks of the body, the channel and its own numbers.

#include "glissade/design/design.hpp"
#include "glissade/design/stream_channel.hpp"

#include "design/design_text.hpp"
#include "support/catch.hpp"

#include <string>

using namespace glissade;
using namespace glissade::test;
using Catch::Matchers::Contains;

namespace {

std::string with_stream(const std::string& keys, const std::string& entry = "entry_speed: 2 m/s") {
  return sound_design_with("friction_angle: 17 deg",
                           "friction_angle: 17 deg\n  " + entry + "\nstream: {" + keys + "}");
}

StreamDesign stream_with(const std::string& keys) {
  return parse_design(with_stream(keys), "d.yaml").stream.value();
}

std::string problems(const std::string& keys, const std::string& entry = "entry_speed: 2 m/s") {
  return problems_of(with_stream(keys, entry));
}

const std::string kWheat = "mass_flow: 40 t/h, bulk_density: 780 kg/m^3";

}  // namespace

TEST_CASE("a stream has a flow and a density; the rest has values of its own") {
  const StreamDesign stream = stream_with(kWheat);
  CHECK(stream.mass_flow == Approx(40.0 / 3.6).epsilon(1e-15));
  CHECK(stream.bulk_density == 780.0);
  CHECK_FALSE(stream.low_density);
  CHECK_FALSE(stream.lump_size);
  CHECK(stream.lateral_pressure_ratio == 0.5);
  CHECK(stream.slip_ratio == 0.6);
  CHECK(stream.surge == 1.5);
  CHECK(stream.trickle == 0.1);
  const StreamDesign full = stream_with(
      "mass_flow: 11 kg/s, bulk_density: {low: 0.75 t/m^3, nominal: 780 kg/m^3, high: 900 kg/m^3}, "
      "lump_size: 6 mm, lateral_pressure_ratio: 0.54, slip_ratio: 0.7, surge: 2, trickle: 20 %");
  CHECK(full.low_density == 750.0);
  CHECK(full.high_density == 900.0);
  CHECK(full.lump_size == 0.006);
  CHECK(full.trickle == 0.2);
}

TEST_CASE(
    "a flow that is none, a density without a unit and one that nothing has are refused with a way out") {
  CHECK_THAT(problems("mass_flow: 0 t/h, bulk_density: 780 kg/m^3"),
             Contains("d.yaml:9:21: mass_flow: 0 t/h is not positive") && Contains("650 t/h"));
  CHECK_THAT(problems("mass_flow: -3 t/h, bulk_density: 780 kg/m^3"), Contains("mass_flow: -3 t/h"));
  CHECK_THAT(problems("mass_flow: 40 t/h, bulk_density: 0.78"),
             Contains("bulk_density: 0.78 has no unit") && Contains("Try: 0.78 t/m^3"));
  CHECK_THAT(problems("mass_flow: 40 t/h, bulk_density: 780"), Contains("Try: 780 kg/m^3"));
  CHECK_THAT(problems("mass_flow: 40 t/h, bulk_density: 0.78 kg/m^3"),
             Contains("bulk_density: 0.78 kg/m^3 is out of range") && Contains("between 1 and 30000 kg/m^3"));
  CHECK_THAT(problems("mass_flow: 40 t, bulk_density: 780 kg/m^3"),
             Contains("is a mass, not a mass flow") && Contains("t/h"));
  CHECK_THAT(problems("bulk_density: {low: 800 kg/m^3, nominal: 780 kg/m^3}, mass_flow: 1 kg/s"),
             Contains("not in ascending order"));
}

TEST_CASE(
    "a material that nobody knows is one problem, with the nearest name: what would follow from it is none") {
  const std::string text = problems("mass_flow: 40 t/h, material: wheet, liner: mild-steel");
  CHECK_THAT(text, Contains("material: wheet is none that is known") && Contains("wheat"));
  CHECK_THAT(text, !Contains("bulk_density"));
}

TEST_CASE("every problem of a stream is told at once") {
  const std::string all = problems(
      "mass_flow: 0 t/h, bulk_density: 780 kg/m^3, lump_size: 200 mm, lateral_pressure_ratio: -1, "
      "slip_ratio: 2, surge: 0.5, trickle: 0",
      "entry_speed: 0 m/s");
  for (const char* const part :
       {"mass_flow: 0 t/h", "lump_size: 200 mm is more than a third of the width, 400 mm",
        "a width of at least 600 mm", "lateral_pressure_ratio: -1", "slip_ratio: 2", "surge: 0.5",
        "trickle: 0", "entry_speed: a stream needs one"})
    CHECK_THAT(all, Contains(part));
}

TEST_CASE("a stream slides between two walls on a flat floor") {
  const std::string stream = "stream: {" + kWheat + "}\n";
  const auto in = [&](const std::string& section) {
    std::string text = with_stream(kWheat);
    const std::size_t at = text.find("cross_section:");
    return problems_of(text.replace(at, text.find('\n', at) - at, section));
  };
  CHECK_THAT(in("cross_section: {kind: pipe, inner_diameter: 400 mm, thickness: 4 mm}"),
             Contains("stream: in a cross-section of kind pipe") && Contains("u-channel"));
  CHECK_THAT(in("cross_section: {kind: slab, width: 400 mm, thickness: 4 mm}"), Contains("of kind slab"));
  CHECK(
      in("cross_section: {kind: slab, width: 400 mm, curb_height: 60 mm, curb_width: 20 mm, thickness: 4 mm}")
          .empty());
  CHECK_THAT(in(""), Contains("stream: without a cross_section"));
  CHECK_THAT(problems(kWheat, "centre_height: 1 m\n  entry_speed: 2 m/s"),
             Contains("centre_height: of a stream"));
  CHECK_THAT(problems_of(sound_design_with("friction_angle: 17 deg",
                                           "kind: rolling\n  rolling_resistance: 0.01\n  radius: 8 mm\n"
                                           "  entry_speed: 2 m/s\n" +
                                               stream)),
             Contains("stream: of a body that rolls"));
}

TEST_CASE("a stream that would enter over its wall is refused, with the entry speed that fills half of it") {
  // 40 t/h of wheat in 400 mm: 35.6 litres a second; 250 mm deep at 0.1425 m/s.
  CHECK(problems(kWheat, "entry_speed: 0.15 m/s").empty());
  CHECK_THAT(problems(kWheat, "entry_speed: 0.13 m/s"),
             Contains("enters 273.9 mm deep, over its wall of 250 mm") && Contains("at least 0.2849 m/s"));
}

TEST_CASE(
    "a burden depth below that at which the stream enters is refused, with both to digits that differ") {
  // 35.6 litres a second in 400 mm: 17.806 mm deep at 2 m/s.
  const auto at_most = [](const std::string& depth) {
    return problems(kWheat, "entry_speed: 2 m/s\nlimits: {highest_burden_depth: " + depth + "}");
  };
  CHECK(at_most("17.81 mm").empty());
  CHECK_THAT(at_most("17.8 mm"),
             Contains("highest_burden_depth: 17.8 mm, but at 2 m/s the stream enters 17.81 mm deep") &&
                 Contains("at least 2.201 m/s"));
  CHECK_THAT(at_most("17.806 mm"), Contains("17.806 mm, but at 2 m/s the stream enters 17.8063 mm deep"));
}

TEST_CASE("a liner by wear needs a stream, and a life a wear coefficient of the same plate") {
  const auto lined = [](const std::string& stream, const std::string& liner) {
    return problems_of(sound_design_with("friction_angle: 17 deg",
                                         "friction_angle: 17 deg\n  entry_speed: 2 m/s\n" + stream +
                                             "fabrication: {process: plate, liner: {" + liner + "}}"));
  };
  const std::string stream = "stream: {mass_flow: 40 t/h, bulk_density: 780 kg/m^3";
  CHECK_THAT(lined("", "where: worn"), Contains("where: of a body that is no stream"));
  CHECK_THAT(lined("", "life: 20000 h"), Contains("life: of a body that is no stream"));
  CHECK_THAT(lined(stream + "}\n", "tonnage: 1e6 t"), Contains("life of a liner whose wear is not known") &&
                                                          Contains("liner_plate: {thickness: 12 mm"));
  CHECK_THAT(lined(stream + ", liner_plate: {thickness: 10 mm, hardness: 4 GPa, wear_coefficient: 2e-4}}\n",
                   "life: 20000 h"),
             Contains("thickness: 6 mm contradicts the liner_plate's 10 mm"));
  CHECK_THAT(lined(stream + "}\n", "where: everywhere"), Contains("whole or worn"));
}

TEST_CASE("keys of other groups are told where they belong") {
  CHECK_THAT(problems(kWheat + ", friction_angle: 20 deg"), Contains("below body:"));
  CHECK_THAT(problems(kWheat + ", width: 400 mm"), Contains("below cross_section:"));
  CHECK_THAT(problems(kWheat + ", bulk_densty: 780 kg/m^3"), Contains("bulk_density"));
}
