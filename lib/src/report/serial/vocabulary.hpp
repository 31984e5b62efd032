#pragma once

#include "glissade/centerline/centerline.hpp"
#include "glissade/core/friction_level.hpp"
#include "glissade/core/vec.hpp"
#include "glissade/design/design.hpp"
#include "glissade/motion/motion.hpp"
#include "glissade/motion/probe.hpp"
#include "glissade/optimize/optimize.hpp"
#include "glissade/solid/mesh_facts.hpp"
#include "glissade/trades/rules.hpp"
#include "glissade/trades/ski_jump/gates.hpp"

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace glissade::report {

/// The one vocabulary of JSON that Glissade writes: `--json`, the data of a report and bindings put these
/// parts together. docs/json.md describes every key. SI values with the unit in the key, angles in degrees,
/// every number with all digits that a double carries, null where a value does not exist or is unbounded.
using Json = nlohmann::ordered_json;

/// @return null where the value is infinite or no number: JSON has neither
[[nodiscard]] Json number(double value);
[[nodiscard]] Json number(const std::optional<double>& value);
[[nodiscard]] inline double degrees(double radians) {
  return Angle::from_radians(radians).degrees();
}
[[nodiscard]] inline double degrees(Angle angle) {
  return angle.degrees();
}
[[nodiscard]] Json position_json(Vec3 position);
/// friction_coefficient, friction_angle_deg
void add_friction(Json& json, const Friction& friction);
/// The friction, entry_speed_m_per_s, drag_per_m, gravity_m_per_s2
void add_body(Json& json, const Design& design);

/// How a ride went: status, times, speeds, loads, losses, where it ended early.
void add_ride(Json& json, const Motion& motion);

/// A ride with its friction and how far that is from the one at which the body stalls.
/// @param stall_angle  as stall_friction_angle() gives it
[[nodiscard]] Json ride_json(FrictionLevel level, const Motion& motion,
                             const std::optional<Angle>& stall_angle);

/// @return the part of an envelope that comes closest to an obstacle; null where there is none
[[nodiscard]] Json closest_json(const std::optional<EnvelopePlace>& closest);
/// A limit as the referee finds it, and what it costs.
/// @param active  none where it does not hold the track back
[[nodiscard]] Json limit_json(const LimitCheck& check, const ActiveLimit* active, const Objective& objective);
[[nodiscard]] Json active_json(const ActiveLimit& active, const Objective& objective);
/// @return how a search ended; conflict and relaxations are null unless the limits contradict each other
[[nodiscard]] Json search_json(const OptimizeReport& report);
[[nodiscard]] Json probes_json(const std::vector<ProbeReading>& probes);

/// @return list of gates with their rides in the nominal condition, and those in others below `conditions`
[[nodiscard]] Json gates_json(const GateTable& table);

/// @return list of verdicts; `where` is an arc length, null where a rule is about the whole track
[[nodiscard]] Json rules_json(const std::vector<Judgement>& judgements);

/// @return list of {where, what, why, hint}
[[nodiscard]] Json issues_json(const std::vector<Issue>& issues);

[[nodiscard]] Json mesh_json(const MeshFacts& facts);

/// @return the document as it is printed, with a newline at the end; bytes that are no UTF-8 are replaced
[[nodiscard]] std::string document_text(const Json& json);

}  // namespace glissade::report
