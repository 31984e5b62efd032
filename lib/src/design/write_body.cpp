#include "design/write_body.hpp"

#include "glissade/core/number_text.hpp"
#include "glissade/core/quantity.hpp"

#include "design/read_body.hpp"
#include "design/written_text.hpp"

#include <optional>
#include <string_view>
#include <variant>

namespace glissade::design_file {
namespace {

std::string coefficient_of(Friction friction) {
  return exact_text(friction.coefficient());
}

/// @return the angle of a friction as a text that reads as that very friction; none if no angle does, or if the
///         coefficient, in which it was given then, is the shorter text
std::optional<std::string> angle_of(Friction friction) {
  const int most_digits = static_cast<int>(coefficient_of(friction).size());
  const double angle = friction.angle().radians();
  for (int digits = 1; digits <= most_digits; ++digits) {
    std::string text = angle_text(Angle::from_radians(angle), digits);
    const auto read = read_quantity(text, Dimension::angle, "friction_angle");
    const double* const value = std::get_if<double>(&read);
    // Of few digits, a steep one may read as 90 deg, which no friction has.
    if (value != nullptr && friction_of_angle(*value) == friction) return text;
  }
  return {};
}

/// A range of frictions, or the one value that there is.
template <typename Text>
std::string friction_range(const BodyDesign& body, Text text_of) {
  if (!body.low_friction && !body.high_friction) return text_of(body.friction);
  Group friction;
  if (body.low_friction) friction.add("low", text_of(*body.low_friction));
  friction.add("nominal", text_of(body.friction));
  if (body.high_friction) friction.add("high", text_of(*body.high_friction));
  return friction.inlined();
}

/// By angle where all of them are one, otherwise by coefficient.
void add_friction(const BodyDesign& body, Group& group) {
  const bool by_angle = angle_of(body.friction) && angle_of(body.low_friction.value_or(body.friction)) &&
                        angle_of(body.high_friction.value_or(body.friction));
  if (by_angle) {
    group.add("friction_angle", friction_range(body, [](Friction friction) { return *angle_of(friction); }));
  } else {
    group.add("friction_coefficient", friction_range(body, coefficient_of));
  }
}

std::string friction_from(const FrictionFrom& change) {
  Group group;
  group.add("from", change.from, Dimension::length);
  const std::optional<std::string> angle = angle_of(change.friction);
  group.add(angle ? "angle" : "coefficient", angle ? *angle : coefficient_of(change.friction));
  return group.inlined();
}

/// Writes each measure of a kind of body under its key.
class KindWriter {
 public:
  KindWriter(const BodyDesign& body, Group& group) : body_(body), group_(group) {}

  void resistance(const char* key, const char*) { group_.add(key, friction_range(body_, coefficient_of)); }
  void length(const char* key, double value, double, double, const char*, const char*) {
    group_.add(key, value, Dimension::length);
  }
  void angle(const char* key, Angle value, Angle most, const char*, const char*) {
    if (value != most) group_.add(key, value.radians(), Dimension::angle);
  }
  void grip(const std::optional<Friction>& value, const char*) {
    if (value) group_.add("friction_coefficient", coefficient_of(*value));
  }

 private:
  const BodyDesign& body_;
  Group& group_;
};

void add_drag(const BodyDesign& body, Group& group) {
  if (!body.drag) {
    group.add_unless(0.0, "drag", body.drag_per_metre, Dimension::per_length);
    return;
  }
  group.add("drag_area", body.drag->drag_area, Dimension::area);
  group.add("mass", body.drag->mass, Dimension::mass);
  Group air;
  air.add("density", body.drag->density, Dimension::density);
  if (!body.drag->density) air.add_unless(0.0, "altitude", body.drag->altitude, Dimension::length);
  air.add("temperature", body.drag->temperature, Dimension::temperature);
  group.add("air", air.inlined());
}

}  // namespace

std::string written_body(const BodyDesign& design) {
  Group group;
  if (!design.slides()) {
    group.add("kind", std::string(std::visit([](const auto& kind) { return kind.kKind; }, design.kind)));
    visit_measures(design, KindWriter(design, group));
  } else if (!design.friction_changes.empty()) {
    group.add("friction", list_of(design.friction_changes, friction_from));
  } else if (design.friction_given) {
    add_friction(design, group);
  }
  group.add("centre_height", design.centre_height, Dimension::length);
  group.add_unless(0.0, "entry_speed", design.entry_speed, Dimension::speed);
  add_drag(design, group);
  group.add_unless(0.0, "head_wind", design.head_wind, Dimension::speed);
  return group.lines();
}

}  // namespace glissade::design_file
