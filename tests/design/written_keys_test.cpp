// Every key that the schema knows, put into designs that are there: what reads is written back as the same design.

#include "glissade/core/error.hpp"
#include "glissade/design/design_source.hpp"
#include "glissade/design/schema.hpp"
#include "glissade/design/template.hpp"
#include "glissade/design/write.hpp"

#include "support/catch.hpp"
#include "support/paths.hpp"
#include "support/thorough.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

using namespace glissade;

namespace {

struct Base {
  DesignSource source;
  Design design;
};

std::optional<Design> with(const DesignSource& source, const std::vector<Override>& overrides) {
  try {
    return source.with(overrides, ReachCheck::no);
  } catch (const Error&) {
    return {};
  }
}

std::vector<Base> bases() {
  std::vector<Base> result;
  const auto add = [&](const DesignSource& source) {
    if (auto design = with(source, {})) result.push_back({source, *std::move(design)});
  };
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(designs_path())) {
    if (entry.path().extension() == ".yaml") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  for (const auto& file : files) add(DesignSource::read(file));
  for (const DesignTemplate& entry : design_templates()) {
    add(DesignSource::parse(design_template(entry.kind), "d.yaml"));
  }
  return result;
}

/// Values of every dimension, among them some that fit beside what is there.
std::vector<std::string> values_of(const DesignKey& key) {
  std::vector<std::string> values;
  for (const std::string& word : key.words) values.push_back(key.list ? "[" + word + "]" : word);
  for (const char* value :
       {"0.137 m",    "1.37 m",       "13.7 mm",       "-0.37 m",     "137 m",
        "0.3 deg",    "13.7 deg",     "61.7 deg",      "83 deg",      "0.137",
        "2.37",       "1.37 m/s",     "13.7 m/s",      "1.37 g",      "0.137 g",
        "0.0137 1/m", "0.137 1/m^2",  "13.7 m^2/s^2",  "71.3 kg",     "0.37 m^2",
        "-3.7 degC",  "1.137 kg/m^3", "0.137 s/(m/s)", "13.7 t/h",    "137 kg/s",
        "true",       "none",         "free",          "other words", "[[0.1 m, 0 m], [0.2 m, -0.1 m]]"}) {
    values.emplace_back(value);
  }
  return values;
}

/// A key that reads beside others alone, or whose value is a list of its own.
struct Beside {
  std::string key;
  std::vector<Override> others;
  std::string value = {};  ///< none: one of values_of()
};

const std::vector<Beside>& besides() {
  const Override area{"body.drag_area", "0.3 m^2"};
  const Override mass{"body.mass", "80 kg"};
  const Override ball{
      "body", "{kind: rolling, rolling_resistance: {low: 0.005, nominal: 0.01, high: 0.5}, radius: 8 mm}"};
  const Override mu{"body.friction_coefficient", "{low: 0.01, nominal: 0.137, high: 0.4}"};
  const Override bulk{"stream.bulk_density", "{low: 1 kg/m^3, nominal: 700 kg/m^3, high: 9000 kg/m^3}"};
  const Override plate{"stream.liner_plate", "{thickness: 12 mm, hardness: 4 GPa, wear_coefficient: 2e-4}"};
  const Override by_name{"stream", "{mass_flow: 40 t/h, material: wheat, liner: mild-steel}"};
  const Override hopper{"feed", "{kind: hopper, outlet_speed: 0.5 m/s, drop: 0.8 m}"};
  const Override blend{"limits.objective", "{kind: blend, exit_speed_weight: 0.1 s/(m/s)}"};
  const Override range{"body.friction_angle", "{nominal: 13 deg, high: 20 deg}"};
  const Override ends{"track.finish.x", "{lowest: 0.5 m, highest: 900 m}"};
  static const std::vector<Beside> all = {
      {"track.finish.x.lowest", {ends}},
      {"track.finish.x.highest", {ends}},
      {"body.kind", {{"body.rolling_resistance", "0.01"}, {"body.radius", "8 mm"}}, "rolling"},
      {"body.friction_coefficient.low", {mu}},
      {"body.friction_coefficient.high", {mu}},
      {"body.friction", {}, "[{from: 0 m, angle: 3 deg}, {from: 1 m, coefficient: 0.1}]"},
      {"body.drag_area", {mass}},
      {"body.mass", {area}},
      {"body.air.altitude", {area, mass}},
      {"body.air.temperature", {area, mass}},
      {"body.air.density", {area, mass}},
      {"body.rolling_resistance.low", {ball}, "0.007"},
      {"body.rolling_resistance.nominal", {ball}},
      {"body.rolling_resistance.high", {ball}},
      {"stream.bulk_density.nominal", {bulk}, "800 kg/m^3"},
      {"stream.bulk_density.high", {bulk}, "900 kg/m^3"},
      {"stream.material", {by_name}, "barley"},
      {"stream.liner", {by_name}, "stainless-steel"},
      {"stream.liner_plate.thickness", {plate}},
      {"stream.liner_plate.hardness", {plate}, "5 GPa"},
      {"stream.liner_plate.wear_coefficient", {plate}, "1e-4"},
      {"feed.kind", {hopper}, "hopper"},
      {"feed.outlet_speed", {hopper}},
      {"limits.objective.worst_case", {range}},
      {"limits.objective.exit_speed_weight", {blend}},
      {"limits.half_planes", {}, "[{line: [[0 m, 900 m], [1 m, 900 m]], stay: below}]"},
      {"limits.keep_outs",
       {},
       "[{outline: [[2 m, 900 m], [3 m, 900 m], [3 m, 901 m], [2 m, 901 m]], pass: below}]"},
      {"limits.stay_above", {}, "[{line: [[-9 m, -900 m], [900 m, -900 m]]}]"},
      {"limits.stay_below", {}, "[{line: [[-9 m, 900 m], [900 m, 900 m]]}]"},
      {"probes", {}, "[{from_start: 0.1 m, name: here}]"},
      {"cross_section.outline",
       {{"cross_section",
         "{kind: polygon, outline: [[-1 m, 0 m], [-1 m, -5 mm], [1 m, -5 mm], [1 m, 0 m], [0 m, 0 m]]}"}},
       "[[-2 m, 0 m], [-2 m, -5 mm], [1 m, -5 mm], [1 m, 0 m], [0 m, 0 m]]"},
      {"centerline.segments",
       {{"centerline", "{kind: segments, entry_slope_angle: 30 deg, segments: [{length: 2 m}]}"}},
       "[{length: 3 m}, {length: 1 m, radius: 9 m}]"},
      {"rules.own",
       {},
       "[{id: mine, quantity: steepest_slope_angle, highest: 60 deg, sentence: steep, source: me}]"},
  };
  return all;
}

/// @return whether some value of the key reads in the design and makes it another one; each that does is written back
bool is_written(const Base& base, const DesignKey& key, const Beside* beside = nullptr) {
  constexpr int kEnough = 3;
  int took_effect = 0;
  const bool given = beside != nullptr && !beside->value.empty();
  for (const std::string& value : given ? std::vector<std::string>{beside->value} : values_of(key)) {
    std::vector<Override> overrides = beside == nullptr ? std::vector<Override>{} : beside->others;
    overrides.push_back({key.path, value});
    const std::optional<Design> design = with(base.source, overrides);
    if (!design || design->asks_the_same(base.design)) continue;
    if (took_effect++ == kEnough) break;
    const std::string text = design_text(*design);
    INFO(base.source.file() << ", " << key.path << "=" << value << "\n" << text);
    const std::optional<Design> again = with(DesignSource::parse(text, base.source.file()), {});
    REQUIRE(again);
    CHECK(again->asks_the_same(*design));
  }
  return took_effect > 0;
}

/// @param first  the design to begin with; becomes the last that took the key: it often takes the next one, too
/// @return whether the key is written back in the designs: in continuous integration all of them are tried, elsewhere they
///         are until one takes it
bool is_written(const std::vector<Base>& designs, std::size_t& first, const DesignKey& key,
                const Beside* beside = nullptr) {
  bool written = false;
  const std::size_t from = first;
  for (std::size_t i = 0; i < designs.size() && (!written || testing::thorough()); ++i) {
    const std::size_t which = (from + i) % designs.size();
    if (!is_written(designs[which], key, beside)) continue;
    written = true;
    first = which;
  }
  return written;
}

}  // namespace

TEST_CASE("every key of the schema that a design here can take is written back") {
  const std::vector<Base> designs = bases();
  REQUIRE(designs.size() >= 15);
  std::size_t tried = 0;
  std::size_t first = 0;
  std::string untried;
  for (const DesignKey& key : design_keys()) {
    const bool is_beside = std::any_of(besides().begin(), besides().end(),
                                       [&](const Beside& one) { return one.key == key.path; });
    // That such a key is taken by itself, too, is asked in CI alone.
    bool written = (!is_beside || testing::thorough()) && is_written(designs, first, key);
    for (const Beside& beside : besides()) {
      if (written || beside.key != key.path) continue;
      written = is_written(designs, first, key, &beside);
    }
    if (written) {
      ++tried;
    } else {
      untried += " " + key.path;
    }
  }
  // The version has one value; the others, of whole groups and lists, stand in write_test.cpp.
  CAPTURE(untried);
  CHECK(tried >= 150);
}
