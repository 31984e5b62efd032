#include "design/read_probes.hpp"

#include "glissade/core/number_text.hpp"

#include <optional>
#include <string>
#include <utility>

namespace glissade::design_file {
namespace {

constexpr std::string_view kExample = "{from_start: 12 m}";

std::optional<ProbeDesign> read_probe(const Value& value, Findings& findings) {
  MapReader map(value, "A probe", kExample, findings);
  map.expect({"from_start", "from_finish", "x", "name"});
  ProbeDesign probe;
  if (const auto name = map.find("name")) probe.name = as_text(*name, findings).value_or("");
  int given = 0;
  bool sound = true;
  const auto place = [&](std::string_view key, ProbeOrigin origin) {
    if (!map.has(key)) return;
    ++given;
    const std::optional<double> at = map.quantity(key, Dimension::length);
    sound = sound && at.has_value();
    probe.origin = origin;
    probe.at = at.value_or(0.0);
    if (origin == ProbeOrigin::x || probe.at >= 0.0) return;
    sound = false;
    findings.add(findings.position(map.path_of(key)), map.path_of(key),
                 {"", std::string(key) + ": " + length_text(probe.at) + " is negative",
                  "It is an arc length along the track.", "a length of 0 m or more"});
  };
  place("from_start", ProbeOrigin::start);
  place("from_finish", ProbeOrigin::finish);
  place("x", ProbeOrigin::x);
  const bool readable = map.readable();
  map.refuse_unknown_keys();
  if (readable && given != 1) {
    findings.add(value.node->at, value.key_path,
                 {"", value.key + (given == 0 ? " has no place" : " has more than one place"),
                  "A probe has exactly one of from_start, from_finish and x.", std::string(kExample)});
  }
  if (given != 1 || !sound) return {};
  return probe;
}

}  // namespace

std::vector<ProbeDesign> read_probes(MapReader& top, Findings& findings) {
  std::vector<ProbeDesign> probes;
  const auto value = top.find("probes");
  if (!value) return probes;
  for (const Value& item : as_list(*value, "[{from_start: 12 m}]", findings)) {
    // One that is wrong keeps its place, so that the others keep their numbers.
    probes.push_back(read_probe(item, findings).value_or(ProbeDesign{}));
  }
  return probes;
}

}  // namespace glissade::design_file
