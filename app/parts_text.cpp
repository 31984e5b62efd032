#include "app/parts_text.hpp"

#include "glissade/core/number_text.hpp"

#include "app/console.hpp"
#include "app/table.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace glissade::app {
namespace {

std::string counted(std::size_t count, const std::string& thing) {
  return std::to_string(count) + " " + thing + (count == 1 ? "" : "s");
}

std::string arcs_text(const MasterCurve& master) {
  return counted(master.arcs, "arc") + "; no fewer than " + std::to_string(master.lower_bound) + " reach " +
         length_text(master.tolerance) + " (found: " + length_text(master.max_deviation, 3) + ")";
}

std::string pieces_text(const Workshop& workshop, const PartsProof& proof) {
  std::size_t pieces = 0;
  double mass = 0.0;
  for (const ShopPart& part : workshop.parts) {
    pieces += part.quantity();
    mass += part.mass * static_cast<double>(part.quantity());
  }
  return counted(workshop.parts.size(), "part") + ", " + counted(pieces, "piece") + ", " +
         rounded_text(mass, 4) + " kg; they add up to the solid, none clash" +
         (proof.bolted > 0 ? ", " + counted(proof.bolted, "pair") + " of holes meet" : "");
}

/// One line a stock: "6 of 400 HB, 6 mm, 3 m x 1.5 m: 67 % used".
std::string stock_text(const std::vector<NestedSheet>& sheets) {
  std::string text;
  for (const StockGroup& group : by_stock(sheets)) {
    const NestedSheet& first = group.sheets.front();
    text += (text.empty() ? "" : "\n") + counted(group.sheets.size(), "sheet") + " of " + first.material +
            ", " + length_text(first.thickness) + ", " + length_text(first.stock.width) + " x " +
            length_text(first.stock.height) + ": " + rounded_text(100.0 * group.utilisation, 2) + " % used";
  }
  return text;
}

/// What has to be printed, and how much less it would be on larger paper.
std::string templates_text(const TemplatePages& pages, TemplatePaper paper) {
  std::string roll = counted(pages.roll, "length") + " of a roll";
  if (paper == TemplatePaper::roll) return roll;
  if (paper == TemplatePaper::a3)
    return counted(pages.a3, "page") + " of A3; export: {paper: roll} takes " + roll;
  return counted(pages.a4, "page") + " of A4; export: {paper: a3} takes " + counted(pages.a3, "page") +
         ", {paper: roll} " + roll;
}

std::string ride_text(const AsBuiltRide& ride) {
  if (!ride.arrives) {
    return "the body does not arrive on the floor as it is built: " + ride.stopped;
  }
  std::string text = rounded_text(ride.travel_time, 5) + " s, " + rounded_text(ride.exit_speed, 5) + " m/s";
  if (!(ride.design_exit_speed > 0.0)) return text;
  const double change = ride.exit_speed / ride.design_exit_speed - 1.0;
  if (ride.bends > 0) {
    text += ": " + counted(ride.bends, "bend") + " cost " + rounded_text(-100.0 * change, 2) +
            " % of the exit speed";
  } else if (std::fabs(change) > 1e-6) {
    text += ": " + rounded_text(std::fabs(100.0 * change), 2) + " % " + (change < 0.0 ? "less" : "more") +
            " exit speed than designed";
  }
  if (ride.hops > 0) {
    text += "; off the floor " +
            (ride.hops == 1 ? std::string("once") : std::to_string(ride.hops) + " times") + ", by " +
            length_text(ride.highest_hop, 2) +
            " at most, where the floor falls away or its load is all but nothing";
  }
  return text;
}

std::string checks_text(const std::vector<ShopCheck>& checks) {
  std::string text;
  std::size_t passed = 0;
  for (const ShopCheck& check : checks) {
    if (check.verdict == ShopVerdict::pass) {
      ++passed;
      continue;
    }
    const bool failed = check.verdict == ShopVerdict::fail;
    text += "\n" +
            emphasised(std::string(to_text(check.verdict)), failed ? Emphasis::bad : Emphasis::heading) +
            ": " + check.rule + " " + check.value + ", " + check.bound + " (" + check.where + "; " +
            check.source + (check.needs_checking ? " [" + check.certainty + "]" : "") + ")";
  }
  return std::to_string(passed) + " of " + std::to_string(checks.size()) + " rules of the shop kept" + text;
}

/// A note that lists hundreds of parts begun, and where the rest of it is.
std::string cut_short(const std::string& note) {
  constexpr std::size_t kMost = 240;
  if (note.size() <= kMost) return note;
  return note.substr(0, note.find_last_of(' ', kMost)) + " ... (the whole of it is on the drawings)";
}

/// One line each; what is not as asked for is a warning beside.
std::string notes_text(const std::vector<std::string>& notes) {
  std::string text;
  for (const std::string& note : notes) text += (text.empty() ? "" : "\n") + cut_short(note);
  return text;
}

}  // namespace

std::string parts_lines(const WorkshopBuild& build, TemplatePaper paper) {
  return labelled("Master curve", arcs_text(build.master)) +
         labelled("Parts", pieces_text(build.workshop, build.proof)) +
         (build.nests.empty() ? "" : labelled("Stock", stock_text(build.nests))) +
         (build.template_pages.roll == 0
              ? ""
              : labelled("Templates", templates_text(build.template_pages, paper))) +
         labelled("As built", ride_text(build.ride)) + labelled("Shop", checks_text(build.workshop.checks)) +
         (build.workshop.notes.empty() ? "" : labelled("Notes", notes_text(build.workshop.notes)));
}

}  // namespace glissade::app
