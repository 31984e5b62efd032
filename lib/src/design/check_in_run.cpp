#include "glissade/centerline/in_run.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/quantity.hpp"

#include "design/checks.hpp"

#include <cmath>
#include <string>
#include <utility>

namespace glissade::design_file {
namespace {

void check_lengths(const InRunDesign& in_run, Collected& findings) {
  const auto positive = [&](const std::string& key, const std::optional<double>& value) {
    if (!value || (*value > 0.0 && *value <= kLongestTrack)) return;
    report(findings, {"centerline." + key},
           out_of_range(key, *value, Dimension::length, {0.0, kLongestTrack},
                        "A length of an in-run is above 0 mm and at most 1000 km.", ""));
  };
  positive("e1", in_run.e1);
  positive("e2", in_run.e2);
  if (in_run.es && !(*in_run.es >= 0.0 && *in_run.es <= kLongestTrack)) {
    report(findings, {"centerline.es"},
           out_of_range("es", *in_run.es, Dimension::length, {0.0, kLongestTrack},
                        "A start area is at least 0 mm and at most 1000 km long.", ""));
  }
  if (in_run.e1 && in_run.e2 && *in_run.e2 > *in_run.e1) {
    report(findings, {"centerline.e2", "centerline.e1"},
           {"", "e2: " + length_text(*in_run.e2) + " is longer than e1, " + length_text(*in_run.e1),
            "e1 counts from the highest start, e2 from the lowest.", "the two exchanged"});
  }
  if (in_run.counts_to_edge && in_run.longest() > 0.0 && in_run.longest() <= in_run.t) {
    report(findings, {in_run.e1 ? "centerline.e1" : "centerline.e2", "centerline.t"},
           {"",
            "e1: " + length_text(in_run.longest()) + " to the edge is not longer than the table, " +
                length_text(in_run.t),
            "An e that counts to the edge includes the table.", "e_counts_to: table, or a longer in-run"});
  }
}

/// What the shape calls "length" is e1 in the file.
/// @param beside  what a problem of which hides this one
void report_letter(Issue issue, const std::string& beside, Collected& findings) {
  const std::string key = issue.where == "length" ? "e1" : issue.where;
  issue.where.clear();
  report(findings, {"centerline." + key, beside}, std::move(issue));
}

/// Letters that are wrong by themselves, all of them, before any of them are held against each other.
void check_letters(const InRunDesign& in_run, Collected& findings) {
  for (const Issue& issue : letter_problems(in_run.shape())) {
    // An alpha that cannot be read is no angle to hold gamma against.
    report_letter(issue, issue.where == "gamma" ? "centerline.alpha" : "centerline." + issue.where, findings);
  }
  const std::optional<double> area = in_run.start_area();
  if (!(in_run.es && in_run.e1 && *in_run.e1 > 0.0 && *area > *in_run.e1)) return;
  const auto [start_area, whole] = texts_apart(*area, *in_run.e1, &length_text);
  report(findings, {"centerline.es", "centerline.e1"},
         {"", "es: the start area, " + start_area + ", is longer than the in-run, e1 " + whole,
          "Gates lie on the straight, above the transition.", "a shorter start area"});
}

}  // namespace

void check_in_run(const Design& design, Collected& findings) {
  const InRunDesign& in_run = design.centerline.in_run;
  const std::size_t before = findings.size();
  check_lengths(in_run, findings);
  check_letters(in_run, findings);
  if (findings.size() != before || !(in_run.longest() > 0.0)) return;
  try {
    const InRun track(in_run.shape());
    const std::optional<double> start_area = in_run.start_area();
    if (start_area && *start_area > track.transition_begins()) {
      const auto [area, straight] = texts_apart(*start_area, track.transition_begins(), &length_text);
      report(findings, {in_run.es ? "centerline.es" : "centerline.e2", "centerline"},
             {"", "es: the start area, " + area + ", is longer than the straight, " + straight,
              "Gates lie on the straight, above the transition.",
              "a shorter start area, a longer in-run, or a smaller r1"});
    }
  } catch (const InputError& error) {
    for (const Issue& issue : error.issues()) report_letter(issue, "centerline", findings);
  }
}

void check_hill(const Design& design, Collected& findings) {
  const HillDesign& hill = design.hill;
  const auto positive = [&](const std::string& key, const std::optional<double>& value,
                            const std::string& text) {
    if (!value || (*value > 0.0 && std::isfinite(*value))) return;
    report(findings, {"hill." + key},
           {"", key + ": " + text + " is not positive", "", "a value above 0, or no " + key});
  };
  const auto length = [&](const std::string& key, const std::optional<double>& value) {
    positive(key, value, length_text(value.value_or(0.0)));
  };
  length("size", hill.size);
  length("construction_point", hill.construction_point);
  length("table_height", hill.table_height);
  length("height", hill.height);
  positive("design_speed", hill.design_speed, rounded_text(hill.design_speed.value_or(0.0), 4) + " m/s");
}

}  // namespace glissade::design_file
