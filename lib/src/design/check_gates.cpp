#include "glissade/centerline/in_run.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/trades/ski_jump/gates.hpp"

#include "design/checks.hpp"

#include <string>
#include <utility>

namespace glissade::design_file {
namespace {

/// The start area of an in-run lies on its straight; check_in_run() holds es to that.
void check_area_of_in_run(const Design& design, Collected& findings) {
  const InRunDesign& in_run = design.centerline.in_run;
  const GatesDesign& gates = *design.gates;
  if (!gates.start_area) {
    if (in_run.start_area()) return;
    report(findings, {"gates", "centerline"},
           {"", "gates: nothing says how long the start area is", "Gates fill the start area, es.",
            "es: 24 m in the centerline, or start_area: 24 m here"});
    return;
  }
  try {
    const double straight = InRun(in_run.shape()).transition_begins();
    if (*gates.start_area <= straight) return;
    report(findings, {"gates.start_area", "centerline"},
           {"",
            "start_area: gates over " + length_text(*gates.start_area) + " lie beyond the straight, " +
                length_text(straight),
            "Gates lie on the straight, above the transition.",
            "a start_area of at most " + length_text(straight)});
  } catch (const InputError&) {
    return;  // the centerline has problems of its own, which are told
  }
}

/// A place above the start of the track; gate_table() holds it to the gates themselves.
void check_measuring_place(const Design& design, Collected& findings) {
  const InRunDesign& in_run = design.centerline.in_run;
  const double length = in_run.shape().length;
  const double place = design.gates->measuring_place;
  if (!(in_run.longest() > 0.0 && in_run.t > 0.0) || place < length) return;
  const auto [measured, whole] = texts_apart(place, length, length_text);
  report(findings, {"gates.measuring_place", "gates"},
         {"", "measuring_place: " + measured + " before the edge no ride of this line passes",
          "The in-run is " + whole + " long from the highest start to the edge.", "measuring_place: 10 m"});
}

}  // namespace

void check_gates(const Design& design, Collected& findings) {
  if (!design.gates) return;
  const GatesDesign& gates = *design.gates;
  const auto check_drag_area = [&](const std::optional<ConditionDesign>& condition, const std::string& key) {
    if (!condition || !condition->drag_area || design.body.drag) return;
    report(findings, {"gates." + key + ".drag_area", "gates." + key, "gates"},
           {"", "drag_area: of a body whose mass is not known",
            "drag = air density x drag_area / (2 x mass), and both are those of the body.",
            "mass: 68 kg and drag_area: 0.15 m^2 in the body, or drag here"});
  };
  check_drag_area(gates.slow, "slow");
  check_drag_area(gates.fast, "fast");
  if (design.centerline.kind == CenterlineKind::in_run) {
    check_area_of_in_run(design, findings);
    check_measuring_place(design, findings);
  } else if (!gates.start_area) {
    report(findings, {"gates", "centerline.kind"},
           {"", "gates: nothing says how long the start area is",
            "A centerline of kind " + std::string(word(design.centerline.kind)) + " has no es.",
            "start_area: 24 m, from the start of the track on"});
  }
}

}  // namespace glissade::design_file
