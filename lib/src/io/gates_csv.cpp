#include "glissade/io/gates_csv.hpp"

#include "glissade/core/number_text.hpp"
#include "glissade/io/atomic_file.hpp"

#include <cstddef>
#include <optional>
#include <string>

namespace glissade {
namespace {

std::string headings(const GateTable& table) {
  std::string text = "gate,distance_to_edge_m,x_m,y_m,z_m";
  for (const GateCondition& condition : table.conditions) {
    const std::string name = condition.name == "nominal" ? "" : condition.name + "_";
    for (const char* const column :
         {"travel_time_s", "speed_at_measuring_place_m_per_s", "speed_at_edge_m_per_s",
          "max_normal_load_m_per_s2", "speed_by_friction_m_per_s", "speed_by_drag_m2_per_s",
          "speed_by_length_per_s"}) {
      text += "," + name + column;
    }
  }
  return text + "\n";
}

}  // namespace

void write_gates_csv(const std::filesystem::path& file, const GateTable& table) {
  std::string text = headings(table);
  for (std::size_t i = 0; i < table.gates.size(); ++i) {
    const Vec3 at = table.positions[i];
    text += std::to_string(table.gates[i].number);
    for (const double value : {table.gates[i].to_edge, at.x, at.y, at.z}) text += "," + exact_text(value);
    for (const GateCondition& condition : table.conditions) {
      const GateRide& ride = condition.rides[i];
      using Value = std::optional<double>;
      const auto slope = [&](double SpeedSlopes::*const by) {
        return ride.slopes ? Value((*ride.slopes).*by) : Value();
      };
      for (const Value& value :
           {Value(ride.travel_time), ride.speed_at_measuring_place, Value(ride.speed_at_edge),
            Value(ride.highest_load), slope(&SpeedSlopes::by_friction), slope(&SpeedSlopes::by_drag),
            slope(&SpeedSlopes::by_length)}) {
        text += "," + (ride.arrived && value ? exact_text(*value) : std::string());
      }
    }
    text += "\n";
  }
  write_atomically(file, text);
}

}  // namespace glissade
