#include "pipeline/rules/in_run_rules.hpp"

#include "glissade/core/math.hpp"

#include "pipeline/ride/ride_facts.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace glissade::pipeline {
namespace {

/// The take-off speeds from the fastest and from the slowest gate of each condition.
void measure_take_off(const GateTable& table, const std::vector<GateCondition>& conditions,
                      Measurements& measurements) {
  for (const GateCondition& condition : conditions) {
    Extremes speeds;
    for (const GateRide& ride : condition.rides) {
      const RideFacts facts = facts_of(ride, place_of(table, condition, ride));
      see_exit_speed(facts, speeds);
      if (facts.arrived()) continue;
      measurements.lack("lowest_take_off_speed", missing_arrival(facts));
      // The speed from a higher gate, if there is one, stands for the highest.
      if (&ride == &condition.rides.back())
        measurements.lack("highest_take_off_speed", missing_arrival(facts));
    }
    if (!speeds.least()) continue;
    measurements.see("highest_take_off_speed", *speeds.most());
    measurements.see("lowest_take_off_speed", *speeds.least());
  }
}

void measure_gates(const Track& track, Measurements& measurements) {
  const GateTable& table = *track.gates;
  measure_take_off(table, table.conditions, measurements);
  measure_take_off(table, table.range, measurements);
  for (std::size_t i = 1; i < table.positions.size(); ++i)
    measurements.see("gate_step_height", table.positions[i].z - table.positions[i - 1].z);
}

void see_or_ask(Measurements& measurements, std::string_view key, const std::optional<double>& value,
                const char* missing) {
  if (value) {
    measurements.see(key, *value);
  } else {
    measurements.lack(key, missing);
  }
}

/// The letters that rules ask about, of any in-run.
struct Letters {
  double gamma = 0.0;                ///< [rad]
  double alpha = 0.0;                ///< [rad]
  double r1 = 0.0;                   ///< [m]; of a shape that is no certificate's the smallest radius
  double t = 0.0;                    ///< [m]; 0 where the track does not end straight
  double e1 = 0.0;                   ///< arc length where the first straight ends [m]
  double longest = 0.0;              ///< from the highest start to the table [m]
  std::optional<double> start_area;  ///< [m]
};

/// Whether letters can be asked of a track: of a certificate's, and of any that tells of its hill or names the rules of in-runs.
bool is_in_run(const Design& design) {
  if (design.centerline.kind == CenterlineKind::in_run || design.hill.size) return true;
  constexpr std::string_view kRules = "fis-in-run";  // and fis-in-run-circle
  const auto& sets = design.rules.sets;
  return sets && std::any_of(sets->begin(), sets->end(),
                             [&](const std::string& set) { return set.starts_with(kRules); });
}

bool is_straight(const Centerline& track, double from, double to) {
  constexpr double kStraight = 1e-12;  // [1/m]
  for (const double share : {0.01, 0.3, 0.7, 0.99}) {
    if (std::fabs(track.direction(from + share * (to - from)).curvature) > kStraight) return false;
  }
  return true;
}

Letters letters_of(const Design& design, const Track& track) {
  const Centerline& centerline = *track.centerline;
  const std::vector<double> breaks = centerline.breaks();
  Letters letters;
  if (design.gates) letters.start_area = design.gates->start_area;
  if (design.centerline.kind == CenterlineKind::in_run) {
    const InRunDesign& in_run = design.centerline.in_run;
    letters.gamma = in_run.gamma.radians();
    letters.alpha = in_run.alpha.radians();
    letters.r1 = in_run.r1;
    letters.t = in_run.t;
    letters.e1 = breaks[1];
    // Ratios of certificates count e1 to the table, whatever the file's e counts to.
    letters.longest = in_run.shape().length - in_run.t;
    if (const auto es = in_run.start_area()) letters.start_area = es;
    return letters;
  }
  letters.gamma = centerline.slope_angle(0.0);
  letters.alpha = centerline.slope_angle(centerline.length());
  letters.r1 = track.min_radius;
  std::size_t first = 0;
  while (first + 1 < breaks.size() && is_straight(centerline, breaks[first], breaks[first + 1])) ++first;
  std::size_t last = breaks.size() - 1;
  while (last > first && is_straight(centerline, breaks[last - 1], breaks[last])) --last;
  letters.e1 = breaks[first];
  letters.t = centerline.length() - breaks[last];
  letters.longest = breaks[last];
  return letters;
}

void measure_letters(const Design& design, const Track& track, Measurements& measurements) {
  const Letters letters = letters_of(design, track);
  const HillDesign& hill = design.hill;
  measurements.see("in_run_slope_angle", letters.gamma);
  measurements.see("table_slope_angle", letters.alpha);
  measurements.see("table_length", letters.t);
  measurements.see("transition_radius", letters.r1);
  constexpr const char* kSpeed = "hill: {design_speed: 27 m/s}, v0 of the norm";
  std::optional<double> table_time;
  std::optional<double> radial;
  if (hill.design_speed) {
    table_time = letters.t / *hill.design_speed;
    radial = *hill.design_speed * *hill.design_speed / letters.r1;
  }
  see_or_ask(measurements, "table_time", table_time, kSpeed);
  see_or_ask(measurements, "design_radial_acceleration", radial, kSpeed);
  std::optional<double> ratio;
  if (hill.table_height && hill.construction_point) ratio = *hill.table_height / *hill.construction_point;
  see_or_ask(measurements, "table_height_ratio", ratio,
             "hill: {table_height: 3.2 m, construction_point: 125 m}, s and w of the certificate");
  std::optional<double> area;
  if (letters.start_area) area = *letters.start_area / letters.longest;
  see_or_ask(measurements, "start_area_ratio", area,
             "es, or e2, in the centerline, or a start_area of the gates");
  measurements.see("curvature_step_at_e1", track.centerline->at(letters.e1).curvature, letters.e1, "E1");
}

/// What presses a jumper down beyond the weight on the table.
void measure_load(const Design& design, double alpha, Measurements& measurements) {
  const Extremes* const load = measurements.find("highest_normal_load");
  if (load == nullptr) return;
  for (const std::optional<MeasuredValue>& extreme : {load->least(), load->most()}) {
    if (!extreme) continue;
    measurements.see("load_above_table_weight", extreme->value - design.gravity * math::cos(alpha),
                     extreme->arc_length, extreme->place);
  }
  if (load->missing()) measurements.lack("load_above_table_weight", *load->missing());
}

void measure_grooves(const Design& design, Measurements& measurements) {
  const auto* const grooves =
      design.cross_section ? std::get_if<section::TrackGroove>(&*design.cross_section) : nullptr;
  if (grooves == nullptr) {
    for (const char* const key : {"track_spacing", "track_groove_width", "track_groove_depth"}) {
      measurements.lack(key, "cross_section: {kind: track-groove}, the grooves that skis run in");
    }
    return;
  }
  measurements.see("track_spacing", grooves->groove_spacing);
  measurements.see("track_groove_width", grooves->groove_width);
  measurements.see("track_groove_depth", grooves->groove_depth);
}

}  // namespace

void measure_in_run(const Design& design, const Track& track, Measurements& measurements) {
  const HillDesign& hill = design.hill;
  const bool in_run = is_in_run(design);
  if (in_run) {
    see_or_ask(measurements, "hill_size", hill.size, "hill: {size: 142 m}, HS of the certificate");
    see_or_ask(measurements, "construction_point", hill.construction_point,
               "hill: {construction_point: 125 m}, w of the certificate");
    see_or_ask(measurements, "hill_height", hill.height, "hill: {height: 62 m}, zU of the certificate");
  }
  if (in_run) {
    measure_letters(design, track, measurements);
    measure_grooves(design, measurements);
  }
  if (track.gates) {
    measure_gates(track, measurements);
  } else {
    for (const char* const key : {"gate_step_height", "highest_take_off_speed", "lowest_take_off_speed"}) {
      measurements.lack(key, "gates: {count: 49}");
    }
  }
  if (in_run) {
    measure_load(design, track.centerline->slope_angle(track.centerline->length()), measurements);
  }
}

}  // namespace glissade::pipeline
