// How far apart trestles stand.

#include "glissade/parts/plates.hpp"

#include "parts/chute_plates.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"

#include <algorithm>
#include <string>
#include <vector>

using namespace glissade;
using namespace testing;

namespace {

/// The longest stretch of track between two trestles [m].
double widest_span(const WorkshopBuild& build) {
  std::vector<double> places;
  for (const SettingOutPoint& point : build.workshop.setting_out) {
    if (point.what.rfind("support ", 0) == 0) places.push_back(point.arc_length);
  }
  REQUIRE(std::is_sorted(places.begin(), places.end()));
  double widest = 0.0;
  for (std::size_t i = 1; i < places.size(); ++i) widest = std::max(widest, places[i] - places[i - 1]);
  return widest;
}

bool tells_of_spans(const WorkshopBuild& build) {
  return std::any_of(build.workshop.notes.begin(), build.workshop.notes.end(),
                     [](const std::string& note) { return note.rfind("Trestles are up to ", 0) == 0; });
}

}  // namespace

TEST_CASE("trestles are no farther apart than is asked for, or a note says where and why") {
  Random random = seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  PlateOptions options;
  options.split.longest = 2.9;
  options.supports.emplace();
  options.supports->ground = {{0.0, -6.2}};
  bool kept = false;
  bool told = false;
  for (int i = 0; i < 12; ++i) {
    options.stiffeners.reset();
    if (i % 2 == 1) options.stiffeners.emplace();
    options.supports->spacing = i == 0 ? 0.25 : i == 1 ? 1.8 : random.between(0.25, 3.0);
    INFO("spacing " << options.supports->spacing << (options.stiffeners ? ", stiffeners" : ""));
    const WorkshopBuild build = plates(chute(), options);
    const bool wide = widest_span(build) > options.supports->spacing + 1e-3;
    CHECK(wide == tells_of_spans(build));
    kept = kept || !wide;
    told = told || wide;
  }
  CHECK(kept);
  CHECK(told);
}

TEST_CASE("trestles: one more stands where the places that are free would leave a span too wide") {
  PlateOptions options;
  options.split.longest = 2.9;
  options.stiffeners.emplace();
  options.supports.emplace();
  options.supports->ground = {{0.0, -6.2}};
  for (const double spacing : {1.6, 1.8, 1.9, 2.2}) {
    INFO("spacing " << spacing);
    options.supports->spacing = spacing;
    CHECK(widest_span(plates(chute(), options)) <= spacing + 1e-9);
  }
}
