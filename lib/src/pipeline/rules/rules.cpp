#include "glissade/pipeline/rules.hpp"

#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/quantity.hpp"
#include "glissade/io/atomic_file.hpp"

#include "pipeline/ride/extremes.hpp"
#include "pipeline/ride/ride_facts.hpp"
#include "pipeline/rules/chute_rules.hpp"
#include "pipeline/rules/in_run_rules.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace glissade {

using namespace pipeline;

namespace {

void measure_shape(const Track& track, Measurements& measurements) {
  const Centerline& centerline = *track.centerline;
  const double length = centerline.length();
  measurements.see("run", std::fabs(track.endpoints.run));
  measurements.see("drop", track.endpoints.drop);
  measurements.see("arc_length", length);
  measurements.see("mean_slope_angle", math::atan2(track.endpoints.drop, std::fabs(track.endpoints.run)));
  measurements.see("entry_slope_angle", centerline.slope_angle(0.0), 0.0);
  measurements.see("exit_slope_angle", centerline.slope_angle(length), length);
  const auto slope = [&](double s) { return centerline.slope_angle(s); };
  const Extreme steepest = highest_along(centerline, slope);
  measurements.see("steepest_slope_angle", steepest.value, steepest.at);
  const Extreme flattest = highest_along(centerline, [&](double s) { return -slope(s); });
  measurements.see("flattest_slope_angle", -flattest.value, flattest.at);
  if (centerline.unbounded_curvature_at_start()) {
    measurements.see("smallest_valley_radius", 0.0, 0.0);
    return;
  }
  const auto curvature = [&](double s) { return centerline.direction(s).curvature; };
  const auto radius_of = [](double bend) {
    return bend > 0.0 ? 1.0 / bend : std::numeric_limits<double>::infinity();
  };
  const Extreme valley = highest_along(centerline, curvature);
  const Extreme crest = highest_along(centerline, [&](double s) { return -curvature(s); });
  measurements.see("smallest_valley_radius", radius_of(valley.value), valley.at);
  measurements.see("smallest_crest_radius", radius_of(crest.value), crest.at);
  measurements.see("least_curvature", 0.0 - crest.value, crest.at);  // never -0
}

}  // namespace

Measurements rule_measurements(const Design& design, const Track& track) {
  Measurements measurements;
  measure_shape(track, measurements);
  for (const RideFacts& ride : all_rides(track)) measure_ride(ride, measurements);
  measure_in_run(design, track, measurements);
  measure_chute(as_solved(design, track), track, measurements);
  return measurements;
}

std::vector<Judgement> judge_rules(const Design& design, const Track& track) {
  if (design.rules.in_force.empty()) return {};
  return judge(design.rules.in_force, rule_measurements(design, track));
}

std::string marked_bound_text(const Judgement& judgement) {
  const Rule& rule = judgement.rule;
  const std::string text = bound_text(rule, digits_of(judgement));
  return needs_checking(rule.certainty) ? text + " [" + std::string(word(rule.certainty)) + "]" : text;
}

std::string certainty_text(Certainty certainty) {
  return std::string(word(certainty)) + (needs_checking(certainty) ? ", to be checked" : "");
}

std::string measured_text(const Judgement& judgement) {
  if (!judgement.value) return "-";
  std::string text = quantity_text(*judgement.value, rule_quantity(judgement.rule.quantity)->dimension,
                                   digits_of(judgement));
  if (judgement.arc_length) text += " at " + length_text(*judgement.arc_length);
  if (!judgement.place.empty()) text += " (" + judgement.place + ")";
  return text;
}

namespace {

/// A text as a cell of CSV has it.
std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string cell = "\"";
  for (const char letter : text) {
    if (letter == '"') cell += '"';
    cell += letter == '\n' ? ' ' : letter;
  }
  return cell + "\"";
}

}  // namespace

void write_verdicts_csv(const std::filesystem::path& file, const std::vector<Judgement>& judgements) {
  std::string text =
      "id,verdict,value,lowest,highest,unit,margin,where_m,place,quantity,sentence,source,certainty,needs_"
      "checking,reason\n";
  for (const Judgement& judgement : judgements) {
    const Rule& rule = judgement.rule;
    const Dimension dimension = rule_quantity(rule.quantity)->dimension;
    const auto number = [&](const std::optional<double>& value) {
      return value ? exact_text(in_unit_for_people(*value, dimension)) : std::string();
    };
    text += quoted(rule.id) + "," + std::string(to_text(judgement.verdict)) + "," + number(judgement.value) +
            "," + number(rule.bound.lowest) + "," + number(rule.bound.highest) + "," +
            std::string(unit_for_people(dimension)) + "," + number(judgement.margin) + "," +
            (judgement.arc_length ? exact_text(*judgement.arc_length) : "") + "," + quoted(judgement.place) +
            "," + rule.quantity + "," + quoted(rule.sentence) + "," + quoted(rule.source) + "," +
            std::string(word(rule.certainty)) + "," + (needs_checking(rule.certainty) ? "true" : "false") +
            "," + quoted(judgement.reason) + "\n";
  }
  write_atomically(file, text);
}

}  // namespace glissade
