#include "pipeline/ride/gates.hpp"

#include "pipeline/task/located.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>

namespace glissade::pipeline {
namespace {

std::vector<Gate> gates_of(const Design& design, const Centerline& centerline) {
  const GatesDesign& gates = *design.gates;
  const double area = gates.start_area.value_or(design.centerline.in_run.start_area().value_or(0.0));
  if (gates.count) return even_gates(centerline.length(), area, *gates.count);
  if (gates.step) return stepped_gates(centerline.length(), area, *gates.step);
  return gates_by_height(centerline, area, *gates.vertical_step);
}

Body in_condition(Body body, const ConditionDesign& condition, const std::optional<DragDesign>& drag) {
  if (condition.friction) {
    body.friction = *condition.friction;
    body.friction_changes.clear();
  }
  body.drag_per_metre = condition.drag_per_metre.value_or(body.drag_per_metre);
  if (condition.drag_area && drag) {
    DragDesign other = *drag;
    other.drag_area = *condition.drag_area;
    body.drag_per_metre = other.drag_per_metre();
  }
  body.head_wind = condition.head_wind.value_or(body.head_wind);
  return body;
}

using Conditions = std::vector<std::pair<std::string, Body>>;

/// The design's own condition, and slow and fast ones: those given, or the ends of its range of friction.
Conditions conditions_of(const Design& design) {
  const Body nominal = body_of(design);
  Conditions conditions = {{"nominal", nominal}};
  const auto add = [&](const char* name, const std::optional<ConditionDesign>& given,
                       const std::optional<Friction>& end_of_range) {
    if (given) {
      conditions.emplace_back(name, in_condition(nominal, *given, design.body.drag));
    } else if (end_of_range) {
      Body body = nominal;
      body.friction = *end_of_range;
      conditions.emplace_back(name, std::move(body));
    }
  };
  add("slow", design.gates->slow, design.body.high_friction);
  add("fast", design.gates->fast, design.body.low_friction);
  return conditions;
}

/// The ends of the design's range of friction in whose place conditions are given: who adds one takes no ride from what is judged.
Conditions range_beside(const Design& design) {
  Conditions ends;
  const auto add = [&](const char* name, bool replaced, const std::optional<Friction>& friction) {
    if (!replaced || !friction) return;
    ends.emplace_back(name, body_of(design));
    ends.back().second.friction = *friction;
  };
  add("high friction", design.gates->slow.has_value(), design.body.high_friction);
  add("low friction", design.gates->fast.has_value(), design.body.low_friction);
  return ends;
}

double largest_height_step(const std::vector<Vec3>& positions) {
  double largest = 0.0;
  for (std::size_t i = 1; i < positions.size(); ++i) {
    largest = std::max(largest, positions[i].z - positions[i - 1].z);
  }
  return largest;
}

/// Calls `make`; what it throws about a key of the gates gets that key's place in the design.
template <typename Make>
auto at_keys_of_gates(const Design& design, Make&& make) {
  return at_place(design.where("gates"), [&] {
    try {
      return std::forward<Make>(make)();
    } catch (const InputError& error) {
      std::vector<Issue> issues = error.issues();
      for (Issue& issue : issues) {
        if (!issue.where.empty()) issue.where = design.where("gates." + issue.where);
      }
      throw InputError(std::move(issues));
    }
  });
}

}  // namespace

std::optional<GateTable> gate_table(const Design& design, const CenterlinePtr& centerline,
                                    const Placement& placement) {
  if (!design.gates) return {};
  return at_keys_of_gates(design, [&] {
    GateTable table;
    table.measuring_place = design.gates->measuring_place;
    table.gates = gates_of(design, *centerline);
    for (const Gate& gate : table.gates) {
      const CenterlinePoint point = centerline->at(gate.from_start);
      table.positions.push_back(placement.to_space(point.x, point.drop, 0.0));
    }
    table.largest_height_step = largest_height_step(table.positions);
    const auto ridden = [&](const Conditions& conditions) {
      std::vector<GateCondition> all;
      for (const auto& [name, body] : conditions) {
        all.push_back(
            {name, body, ride_gates(centerline, table.gates, body, table.measuring_place, design.gravity)});
      }
      return all;
    };
    table.conditions = ridden(conditions_of(design));
    table.range = ridden(range_beside(design));
    return table;
  });
}

}  // namespace glissade::pipeline
