#include "glissade/core/air.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/quantity.hpp"

#include "design/checks.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace glissade {

double DragDesign::drag_per_metre() const {
  const double thickness =
      density.value_or(air_density(altitude, temperature.value_or(standard_temperature(altitude))));
  return thickness * drag_area / (2.0 * mass);
}

namespace design_file {
namespace {

constexpr double kHighestSpeed = 1e4;    // [m/s]
constexpr double kHighestGravity = 1e4;  // [m/s^2], taste: a thousand times that of the Earth
constexpr double kHighestCentre = 1e3;   // [m]
constexpr double kHighestWind = 150.0;   // [m/s], beyond any storm
constexpr double kHeaviest = 1e9;        // [kg]
constexpr double kFreezing = 273.15;     // [K]
constexpr double kColdest = kFreezing - 100.0;
constexpr double kHottest = kFreezing + 100.0;

/// What a value may be; unbounded where infinite.
struct Within {
  double least = 0.0;
  double most = HUGE_VAL;
  bool above_least = false;

  [[nodiscard]] bool holds(double value) const {
    return std::isfinite(value) && value <= most && (above_least ? value > least : value >= least);
  }
};

void check_range(const std::string& key, double value, Dimension dimension, Within within,
                 const std::string& why, const std::string& hint, Collected& findings) {
  if (within.holds(value)) return;
  const std::string last = key.substr(key.rfind('.') + 1);
  report(findings, {key}, out_of_range(last, value, dimension, {within.least, within.most}, why, hint));
}

void check_friction_range(const Design& design, Collected& findings) {
  const BodyDesign& body = design.body;
  const std::string key = friction_key(design);
  const double low = body.low_friction.value_or(body.friction).coefficient();
  const double high = body.high_friction.value_or(body.friction).coefficient();
  const double nominal = body.friction.coefficient();
  if (low > nominal || nominal > high) {
    report(findings, {"body." + key},
           {"", key + ": low, nominal and high are not in ascending order",
            "They are " + angle_text(Angle::from_radians(math::atan(low))) + ", " +
                angle_text(Angle::from_radians(math::atan(nominal))) + " and " +
                angle_text(Angle::from_radians(math::atan(high))) + ".",
            ""});
  }
}

void check_friction_changes(const Design& design, Collected& findings) {
  const std::vector<FrictionFrom>& changes = design.body.friction_changes;
  if (changes.empty()) return;
  if (changes.front().from != 0.0) {
    report(findings, {"body.friction.0.from", "body.friction"},
           {"", "friction: the first entry begins at " + length_text(changes.front().from),
            "The track rubs from its start on.", "from: 0 m"});
  }
  for (std::size_t i = 1; i < changes.size(); ++i) {
    if (changes[i - 1].from < changes[i].from && std::isfinite(changes[i].from)) continue;
    report(findings, {"body.friction." + std::to_string(i) + ".from", "body.friction"},
           {"", "from: " + length_text(changes[i].from) + " after " + length_text(changes[i - 1].from),
            "Entries stand in the order of the track, each from further on than the one before.",
            "the entries in ascending order of from"});
  }
}

/// Holds each measure of a kind against what it may be.
class KindCheck {
 public:
  explicit KindCheck(Collected& findings) : findings_(findings) {}

  void resistance(const char*, const char*) const {}
  void length(const std::string& key, double value, double least, double most, const char* why,
              const char* example) {
    check_range("body." + key, value, Dimension::length, {least, most}, why, example, findings_);
  }
  void angle(const std::string& key, Angle value, Angle most, const char* why, const char* hint) {
    check_range("body." + key, value.radians(), Dimension::angle, {0.0, most.radians(), true}, why, hint,
                findings_);
  }
  void grip(const std::optional<Friction>&, const char*) const {}

 private:
  Collected& findings_;
};

/// Told in degrees as people tell the weather.
void check_temperature(double temperature, Collected& findings) {
  if (temperature >= kColdest && temperature <= kHottest) return;
  const auto text = [](double kelvin, int digits) {
    return rounded_text(kelvin - kFreezing, digits) + " degC";
  };
  report(findings, {"body.air.temperature"},
         {"", "temperature: " + text_beyond(temperature, {kColdest, kHottest}, text) + " is out of range",
          "Air is between -100 degC and 100 degC.", "-5 degC"});
}

void check_drag_parts(const DragDesign& drag, Collected& findings) {
  check_range("body.mass", drag.mass, Dimension::mass, {0.0, kHeaviest, true},
              "It is positive, and at most 1e9 kg.", "85 kg, with all that moves along", findings);
  check_range("body.drag_area", drag.drag_area, Dimension::area, {}, "Drag slows the body down.",
              "drag coefficient x frontal area: 0.25 m^2 of a skier's tuck", findings);
  check_range("body.air.density", drag.density.value_or(0.0), Dimension::density, {}, "Air weighs something.",
              "1.2 kg/m^3", findings);
  check_range("body.air.altitude", drag.altitude, Dimension::length, {kLowestAltitude, kHighestAltitude},
              "It lies between -500 m and 11 km, in the troposphere.", "1200 m, above sea level", findings);
  check_temperature(drag.temperature.value_or(kFreezing), findings);
}

void check_drag(const BodyDesign& body, Collected& findings) {
  if (body.drag) {
    check_drag_parts(*body.drag, findings);
  } else if (!(body.drag_per_metre >= 0.0 && std::isfinite(body.drag_per_metre))) {
    report(findings, {"body.drag"},
           {"", "drag: " + rounded_text(body.drag_per_metre, 4) + " 1/m is negative",
            "Drag slows the body down.", "air density x drag coefficient x frontal area / (2 x mass)"});
  }
  check_range("body.head_wind", body.head_wind, Dimension::speed, {-kHighestWind, kHighestWind},
              "It lies between -150 m/s, from behind, and 150 m/s.", "3 m/s", findings);
  if (body.head_wind == 0.0 || body.drag_per_metre != 0.0) return;
  report(findings, {"body.head_wind", "body.drag", "body.drag_area"},
         {"", "head_wind: " + rounded_text(body.head_wind, 4) + " m/s on a body without drag",
          "Without drag the air does nothing.", "drag, or mass and drag_area"});
}

void check_closed_forms(const Design& design, Collected& findings) {
  const bool constant_speed = design.centerline.kind == CenterlineKind::constant_speed;
  if (!constant_speed || design.stream || is_sliding_point(design.body) || design.centerline.constant_speed_p)
    return;
  report(findings, {"centerline.kind", "body"},
         {"", "constant-speed without p, for a body that is not a sliding point",
          "The p with the least travel time is known for the sliding point alone.",
          "p: 9 m^2/s^2, the square of the speed"});
}

}  // namespace

Friction least_friction(const BodyDesign& body) {
  Friction least = body.high_friction.value_or(body.friction);
  for (const FrictionFrom& change : body.friction_changes) least = std::min(least, change.friction);
  return least;
}

bool is_sliding_point(const BodyDesign& body) {
  const bool rubs_alike =
      std::all_of(body.friction_changes.begin(), body.friction_changes.end(),
                  [&](const FrictionFrom& change) { return change.friction == body.friction; });
  return body.slides() && centre_height(body) == 0.0 && rubs_alike && body.head_wind == 0.0;
}

double centre_height(const BodyDesign& body) {
  if (body.centre_height) return *body.centre_height;
  return std::visit([](const auto& kind) { return kind.default_centre_height(); }, body.kind);
}

void check_body(const Design& design, Collected& findings) {
  const BodyDesign& body = design.body;
  check_friction_range(design, findings);
  check_friction_changes(design, findings);
  visit_measures(body, KindCheck(findings));
  if (body.centre_height) {
    const double height = *body.centre_height;
    check_range("body.centre_height", height, Dimension::length, {0.0, kHighestCentre, !body.slides()},
                "The centre of mass lies above the track, by at most 1000 m.", "0.6 m of a skier", findings);
  }
  check_range("body.entry_speed", body.entry_speed, Dimension::speed, {0.0, kHighestSpeed},
              "It lies between 0 and 10000 m/s.", "0 m/s, or no entry_speed, for a start from rest",
              findings);
  check_drag(body, findings);
  check_closed_forms(design, findings);
  check_range("gravity", design.gravity, Dimension::acceleration, {0.0, kHighestGravity, true},
              "It is positive, and at most 10000 m/s^2.", "9.81 m/s^2", findings);
}

}  // namespace design_file
}  // namespace glissade
