// Every key that the schema knows, put into designs that are there: what reads is written back as the same design.

#include "glissade/core/error.hpp"
#include "glissade/design/design_source.hpp"
#include "glissade/design/schema.hpp"
#include "glissade/design/template.hpp"
#include "glissade/design/write.hpp"

#include "support/catch.hpp"
#include "support/paths.hpp"

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

/// @return whether some value of the key reads in the design and makes it another one; each that does is written back
bool is_written(const Base& base, const DesignKey& key) {
  constexpr int kEnough = 3;
  int took_effect = 0;
  for (const std::string& value : values_of(key)) {
    const std::optional<Design> design = with(base.source, {{key.path, value}});
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

}  // namespace

TEST_CASE("every key of the schema that a design here can take is written back") {
  const std::vector<Base> designs = bases();
  REQUIRE(designs.size() >= 15);
  std::size_t tried = 0;
  std::string untried;
  for (const DesignKey& key : design_keys()) {
    bool written = false;
    for (const Base& base : designs) written = is_written(base, key) || written;
    if (written) {
      ++tried;
    } else {
      untried += " " + key.path;
    }
  }
  // The others need a second key beside them: write_test.cpp has those.
  CAPTURE(untried);
  CHECK(tried >= 100);
}
