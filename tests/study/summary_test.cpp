#include "glissade/study/summary.hpp"

#include "support/catch.hpp"
#include "support/temp_dir.hpp"
#include "support/thorough.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

namespace summary_test {

using namespace glissade;
using namespace glissade::study;
using Catch::Matchers::Contains;

namespace {

constexpr const char* kDesign = R"(glissade: 1
track: {start: {x: 0 m, z: 5 m}, finish: {x: 10 m, z: 0 m}}
body: {friction_angle: 11 deg}
centerline: {kind: straight}
)";

std::vector<Quantity> time_alone(const Design&, const Track& track) {
  return {
      {"travel_time_s", track.motion.arrived() ? std::optional(track.motion.travel_time()) : std::nullopt},
      {"always_one", 1.0}};
}

Summary summary_of(const TempDir& place, std::vector<Factor> factors) {
  const Study study{
      DesignSource::parse(kDesign, "slide.yaml"), {}, Plan(std::move(factors)), false, {}, time_alone};
  (void)run(study, {.directory = place.path()});
  return summarise(Results::open(place.path()));
}

std::vector<double> times(const TempDir& place) {
  std::vector<double> values;
  Results::open(place.path()).for_each([&](const Row& row) {
    if (row.quantities[0]) values.push_back(*row.quantities[0]);
  });
  std::sort(values.begin(), values.end());
  return values;
}

}  // namespace

TEST_CASE("the facts of a column are those of its values") {
  const TempDir place;
  const Summary summary = summary_of(place, {vary("body.friction_angle=5deg:30deg:501")});
  const std::vector<double> values = times(place);
  REQUIRE(values.size() < 501);  // above 26.6 deg none arrives
  const ColumnFacts& facts = summary.quantities[0];
  CHECK(facts.count == values.size());
  CHECK(facts.lowest == values.front());
  CHECK(facts.highest == values.back());
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
  CHECK(facts.mean == Approx(mean).epsilon(1e-12));
  double squares = 0.0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  CHECK(facts.standard_deviation ==
        Approx(std::sqrt(squares / static_cast<double>(values.size() - 1))).epsilon(1e-12));
  for (std::size_t index = 0; index < kQuantiles.size(); ++index) {
    const auto below =
        std::count_if(values.begin(), values.end(), [&](double v) { return v <= facts.quantiles[index]; });
    CHECK(std::fabs(static_cast<double>(below) - kQuantiles[index] * static_cast<double>(values.size())) <=
          1.0);
  }
  CHECK(std::accumulate(facts.histogram.begin(), facts.histogram.end(), std::uint64_t{0}) == values.size());
  CHECK(summary.counts.at(Status::arrived) == values.size());
  CHECK(summary.counts.at(Status::infeasible) == 501 - values.size());
  CHECK_THAT(summary.reasons.at(Status::infeasible), Contains("steeper than the mean slope"));
  CHECK(summary.varying == std::vector<std::size_t>{0});
}

TEST_CASE("best points are the best of all, with their inputs") {
  const TempDir place;
  const Summary summary =
      summary_of(place, {vary("body.friction_angle=5deg:25deg:201"), vary("body.entry_speed=0m/s,2m/s")});
  const std::vector<double> values = times(place);
  REQUIRE(summary.lowest.size() == 1);
  REQUIRE(summary.lowest[0].size() == kBest);
  for (std::size_t place_of = 0; place_of < kBest; ++place_of) {
    CHECK(summary.lowest[0][place_of].value == values[place_of]);
    CHECK(summary.highest[0][place_of].value == values[values.size() - 1 - place_of]);
  }
  CHECK(summary.lowest[0][0].inputs == std::vector<std::string>{"5", "2"});
  CHECK(summary.highest[0][0].inputs == std::vector<std::string>{"25", "0"});
}

TEST_CASE("an input told again in SI is no figure of its own, and dependent inputs have no share") {
  const TempDir place;
  // Fewer points arrive where friction and speed are both unfavourable.
  const auto figures = [](const Design& design, const Track& track) {
    const double speed = design.body.entry_speed;
    const bool told = speed < 1.5 || track.motion.body().friction.coefficient() < 0.2;
    return std::vector<Quantity>{
        {"entry_speed_m_per_s", speed},
        {"exit_speed_m_per_s", track.motion.exit_speed()},
        {"travel_time_s", told ? std::optional(track.motion.travel_time()) : std::nullopt}};
  };
  // Each point is a search.
  const std::string values = testing::thorough() ? "41" : "17";
  const Study study{DesignSource::parse(kDesign, "slide.yaml"),
                    {},
                    Plan({vary("body.friction_angle=5deg:20deg:" + values),
                          vary("body.entry_speed=1km/h:9km/h:" + values)}),
                    false,
                    {},
                    figures};
  (void)run(study, {.directory = place.path()});
  const Summary summary = summarise(Results::open(place.path()));
  CHECK(summary.varying == std::vector<std::size_t>{1, 2});
  REQUIRE(summary.influences.size() == 4);
  for (const Influence& influence : summary.influences) {
    CHECK(influence.dependent_here == (influence.quantity == 2));
    CHECK(influence.first_order.has_value() == (influence.quantity == 1));
  }
}

TEST_CASE("maps and bands count every point once") {
  const TempDir place;
  const Summary summary =
      summary_of(place, {vary("body.friction_angle=5deg:25deg:97"), vary("body.entry_speed=0m/s,1m/s,2m/s")});
  REQUIRE(summary.bands.size() == 2);
  REQUIRE(summary.maps.size() == 1);
  const auto total = [](const std::vector<std::uint64_t>& counts) {
    return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
  };
  CHECK(total(summary.bands[0].counts) == 291);
  CHECK(summary.bands[1].counts == std::vector<std::uint64_t>{97, 97, 97});
  CHECK(total(summary.maps[0].counts) == 291);
  CHECK(summary.maps[0].up.values == std::vector<double>{0, 1, 2});
  CHECK(summary.bands[1].first_points[1].inputs == std::vector<std::string>{"5", "1"});
  CHECK(summary.bands[1].first_points[1].index == 1);
  // More entry speed is faster, at the same frictions.
  CHECK((*summary.bands[1].values[0][2])[1] < (*summary.bands[1].values[0][0])[1]);
}

TEST_CASE("the page holds its data and nothing that a browser would fetch") {
  const TempDir place;
  const Summary summary = summary_of(place, {vary("body.friction_angle=5deg:25deg:11")});
  const std::string page = summary_page(Results::open(place.path()), summary);
  CHECK_THAT(page, Contains("\"points\":11") && Contains("<title>Sweep of slide.yaml</title>"));
  for (const char* outside : {"http://www.w3.org/2000/svg"}) CHECK_THAT(page, Contains(outside));
  CHECK(page.find("https://") == std::string::npos);
  CHECK(page.find("src=") == std::string::npos);
  CHECK(page == summary_page(Results::open(place.path()), summarise(Results::open(place.path()))));
}

}  // namespace summary_test
