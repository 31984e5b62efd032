#include "design/read_segments.hpp"

#include "glissade/core/quantity.hpp"

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace glissade::design_file {
namespace {

const std::vector<std::pair<std::string_view, SegmentBend>>& bend_words() {
  static const std::vector<std::pair<std::string_view, SegmentBend>> words = {
      {"clothoid", SegmentBend::clothoid}, {"cubic", SegmentBend::cubic}};
  return words;
}

/// Curvature, from a radius or as it is.
class CurvatureReader {
 public:
  CurvatureReader(MapReader& map, Findings& findings) : map_(map), findings_(findings) {}

  std::optional<double> read(std::string_view curvature_key, std::string_view radius_key) {
    const std::optional<double> curvature = map_.quantity(curvature_key, Dimension::per_length);
    const std::optional<double> radius = map_.quantity(radius_key, Dimension::length);
    if (!radius) return curvature;
    if (*radius == 0.0) {
      const std::string path = map_.path_of(radius_key);
      findings_.add(findings_.position(path), path,
                    {"", std::string(radius_key) + ": 0 m bends without bound", "",
                     "a positive radius for a valley, a negative one for a crest"});
      return {};
    }
    return 1.0 / *radius;
  }

 private:
  MapReader& map_;
  Findings& findings_;
};

void refuse_two_bends(const MapReader& map, const Value& value, Findings& findings) {
  const auto given = [&](std::initializer_list<std::string_view> keys) {
    int count = 0;
    for (const std::string_view key : keys) count += map.has(key) ? 1 : 0;
    return count;
  };
  const int entries = given({"entry_curvature", "entry_radius"});
  const int exits = given({"exit_curvature", "exit_radius"});
  const int whole = given({"radius", "curvature"});
  if (entries <= 1 && exits <= 1 && whole + (entries + exits > 0 ? 1 : 0) <= 1) return;
  findings.add(findings.position(value.key_path), value.key_path,
               {"", value.key + " is bent in more than one way",
                "A segment is straight, has a curvature, has a radius, or has an entry_curvature and an "
                "exit_curvature (or an entry_radius and an exit_radius).",
                "one of them"});
}

SegmentDesign read_segment(const Value& value, Findings& findings) {
  MapReader map(value, "A segment", "{length: 2 m, radius: 5 m}", findings);
  map.expect({"length", "to_slope_angle", "to_point", "radius", "curvature", "entry_radius", "exit_radius",
              "entry_curvature", "exit_curvature", "bend"});
  SegmentDesign segment;
  const bool leads_somewhere = map.has("to_slope_angle") || map.has("to_point");
  segment.length = leads_somewhere ? map.quantity("length", Dimension::length)
                                   : map.needed_quantity("length", Dimension::length, "length: 2 m");
  if (const auto angle = map.quantity("to_slope_angle", Dimension::angle)) {
    segment.to_slope_angle = Angle::from_radians(*angle);
  }
  if (const auto point = map.find("to_point")) segment.to_point = as_point(*point, findings);
  refuse_two_bends(map, value, findings);
  CurvatureReader curvatures(map, findings);
  const std::optional<double> whole = curvatures.read("curvature", "radius");
  const std::optional<double> entry = curvatures.read("entry_curvature", "entry_radius");
  const std::optional<double> exit = curvatures.read("exit_curvature", "exit_radius");
  segment.entry_curvature = entry.value_or(whole.value_or(0.0));
  segment.exit_curvature = exit.value_or(whole.value_or(0.0));
  if (const auto bend = map.find("bend")) {
    segment.bend = map.choice(*bend, bend_words()).value_or(SegmentBend::clothoid);
  }
  map.refuse_unknown_keys();
  return segment;
}

}  // namespace

void read_segments(MapReader& map, CenterlineDesign& centerline, Findings& findings) {
  centerline.entry_slope_angle = Angle::from_radians(
      map.needed_quantity("entry_slope_angle", Dimension::angle, "entry_slope_angle: 35 deg").value_or(0.0));
  constexpr std::string_view kExample = "[{length: 2 m}, {length: 1.5 m, radius: 3 m}]";
  const auto list = map.need("segments", kExample);
  if (!list) return;
  for (const Value& item : as_list(*list, kExample, findings, {.least = 1})) {
    centerline.segments.push_back(read_segment(item, findings));
  }
}

}  // namespace glissade::design_file
