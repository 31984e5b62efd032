#include "design/read_in_run.hpp"

#include "glissade/core/quantity.hpp"

#include <string>
#include <utility>
#include <vector>

namespace glissade {
namespace design_file {
namespace {

const std::vector<std::pair<std::string_view, InRunTransition>>& transition_words() {
  static const std::vector<std::pair<std::string_view, InRunTransition>> words = {
      {"cubic", InRunTransition::cubic},
      {"circle", InRunTransition::circle},
      {"clothoid", InRunTransition::clothoid},
      {"two-radii", InRunTransition::two_radii}};
  return words;
}

void read_lengths(MapReader& map, InRunDesign& in_run, Findings& findings) {
  in_run.e1 = map.quantity("e1", Dimension::length);
  in_run.e2 = map.quantity("e2", Dimension::length);
  in_run.es = map.quantity("es", Dimension::length);
  const bool complete = map.has("e1") || (map.has("e2") && map.has("es"));
  if (map.readable() && !complete) {
    const std::string missing = map.has("e2") ? "es" : "e1";
    findings.add(findings.position(map.path_of("kind")), map.path_of(missing),
                 {"", missing + " is missing", "The length of an in-run is e1, or e2 + es.",
                  missing == "es" ? "es: 24 m" : "e1: 96 m"});
  }
  if (map.has("e1") && map.has("e2") && map.has("es")) {
    findings.add(findings.position(map.path_of("es")), map.path_of("es"),
                 {"", "e1, e2 and es are all given", "Any two of them give the third: es = e1 - e2.",
                  "two of the three"});
  }
}

}  // namespace

std::string_view word(InRunTransition transition) {
  for (const auto& [text, meaning] : transition_words()) {
    if (meaning == transition) return text;
  }
  return "";
}

void read_in_run(MapReader& map, InRunDesign& in_run, Findings& findings) {
  map.expect(
      {"kind", "gamma", "alpha", "r1", "t", "e1", "e2", "es", "e_counts_to", "transition", "first_radius"});
  const auto angle = [&](std::string_view key, std::string_view example) {
    return Angle::from_radians(map.needed_quantity(key, Dimension::angle, example).value_or(0.0));
  };
  in_run.gamma = angle("gamma", "gamma: 35 deg");
  in_run.alpha = angle("alpha", "alpha: 11 deg");
  in_run.r1 = map.needed_quantity("r1", Dimension::length, "r1: 103 m").value_or(0.0);
  in_run.t = map.needed_quantity("t", Dimension::length, "t: 6.9 m").value_or(0.0);
  read_lengths(map, in_run, findings);
  static const std::vector<std::pair<std::string_view, bool>> kEnds = {{"table", false}, {"edge", true}};
  if (const auto value = map.find("e_counts_to")) {
    in_run.counts_to_edge = map.choice(*value, kEnds).value_or(false);
  }
  if (const auto value = map.find("transition")) {
    in_run.transition = map.choice(*value, transition_words()).value_or(InRunTransition::cubic);
  }
  if (in_run.transition == InRunTransition::two_radii) {
    in_run.first_radius = map.needed_quantity("first_radius", Dimension::length,
                                              "first_radius: 142 m, where the transition begins")
                              .value_or(0.0);
  } else if (map.has("first_radius")) {
    static_cast<void>(map.find("first_radius"));
    findings.add(findings.position(map.path_of("first_radius")), map.path_of("first_radius"),
                 {"", "first_radius: only a transition of two radii has one",
                  "Others are told by r1 alone, the radius where they end.", "transition: two-radii"});
  }
}

HillDesign read_hill(MapReader& top, Findings& findings) {
  HillDesign hill;
  const std::optional<Value> value = top.find("hill");
  if (!value) return hill;
  MapReader map(*value, "A hill", "{size: 142 m, construction_point: 125 m}", findings);
  hill.size = map.quantity("size", Dimension::length);
  hill.construction_point = map.quantity("construction_point", Dimension::length);
  hill.table_height = map.quantity("table_height", Dimension::length);
  hill.height = map.quantity("height", Dimension::length);
  hill.design_speed = map.quantity("design_speed", Dimension::speed);
  map.refuse_unknown_keys();
  return hill;
}

}  // namespace design_file

double InRunDesign::longest() const {
  if (e1) return *e1;
  return e2 && es ? *e2 + *es : 0.0;
}

std::optional<double> InRunDesign::start_area() const {
  if (es) return es;
  if (e1 && e2) return *e1 - *e2;
  return {};
}

InRunShape InRunDesign::shape() const {
  InRunShape shape;
  shape.gamma = gamma;
  shape.alpha = alpha;
  shape.r1 = r1;
  shape.t = t;
  shape.length = longest() + (counts_to_edge ? 0.0 : t);
  shape.transition = transition;
  shape.first_radius = first_radius;
  return shape;
}

}  // namespace glissade
