#include "app/limits_text.hpp"

#include "glissade/core/number_text.hpp"
#include "glissade/core/quantity.hpp"
#include "glissade/task/limit_catalogue.hpp"

#include "app/console.hpp"
#include "app/table.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

namespace glissade::app {
namespace {

std::string bound_text(const LimitCheck& check) {
  if (const std::string_view met = entry_of(check.limit.id).met; !met.empty()) return std::string(met);
  const Bound bound = check.limit.bound;
  return (bound == Bound::highest  ? "<= "
          : bound == Bound::lowest ? ">= "
                                   : "") +
         quantity_text(check.value, check.limit.dimension());
}

/// Rounding of a position that is met is of no interest.
std::string reached_text(const LimitCheck& check) {
  const std::string_view met = entry_of(check.limit.id).met;
  if (!met.empty() && check.kept()) return std::string(met);
  constexpr double kAlmostStraight = 1e6;
  if (check.limit.is_radius() && check.reached > kAlmostStraight * check.scale) return "straight";
  return quantity_text(check.reached, check.limit.dimension());
}

std::string places_text(const std::vector<Stretch>& where) {
  constexpr std::size_t kMost = 3;
  constexpr int kDigits = 3;
  std::string text;
  for (std::size_t index = 0; index < std::min(where.size(), kMost); ++index) {
    if (index != 0) text += ", ";
    // A stretch too short to be seen in so many digits is a place.
    const std::string from = length_text(where[index].from, kDigits);
    const std::string to = length_text(where[index].to, kDigits);
    text += to == from ? from : from + " to " + to;
  }
  if (where.size() > kMost) text += ", ...";
  return text;
}

const ActiveLimit* active_of(const Track& track, const LimitName& limit) {
  if (!track.search) return nullptr;
  const std::vector<ActiveLimit>& active = track.search->active;
  const auto found =
      std::find_if(active.begin(), active.end(), [&](const ActiveLimit& one) { return one.limit == limit; });
  return found == active.end() ? nullptr : &*found;
}

std::vector<std::string> row_of(const Design& design, const Track& track, const LimitCheck& check) {
  const std::string friction =
      check.friction ? ", " + std::string(to_text(*check.friction)) + " friction" : std::string();
  std::vector<std::string> row = {check.limit.key(), bound_text(check), reached_text(check),
                                  length_text(check.where, 3) + friction, "kept"};
  if (!check.kept()) {
    std::string broken = "broken";
    if (check.leaves_track) {
      broken += ": leaves the track";
    } else if (std::isfinite(check.violation)) {
      broken += " by " + quantity_text(check.violation, check.limit.dimension());
    }
    row[4] = emphasised(broken, Emphasis::bad);
  } else if (const ActiveLimit* const active = active_of(track, check.limit)) {
    if (!active->where.empty()) row[3] = places_text(active->where) + friction;
    row[4] = price_text(*active, design.objective);
  }
  return row;
}

/// What clearances are measured from.
std::string clearances_text(const Design& design) {
  const Envelope envelope = envelope_of(design);
  if (envelope.is_line()) return "from the centerline";
  std::string text = design.cross_section
                         ? "from the whole solid, " + length_text(envelope.below, 3) + " below to " +
                               length_text(envelope.above, 3) + " above the floor"
                         : "from the floor";
  if (envelope.headroom > 0.0) text += ", and a headroom of " + length_text(envelope.headroom, 3);
  return text;
}

std::string search_text(const Track& track) {
  const OptimizeReport& search = *track.search;
  const bool optimal = search.status == OptimizeStatus::optimal;
  return emphasised(to_text(search.status), optimal ? Emphasis::good : Emphasis::bad) + ": " +
         search.message + "\n" + search.convergence_text() + ", " + std::to_string(search.iterations) +
         " rounds, " + std::to_string(search.evaluations) + " evaluations, " +
         rounded_text(search.seconds, 2) + " s";
}

}  // namespace

std::string limits_lines(const Design& design, const Track& track) {
  std::string text;
  if (track.search) text += labelled("Search", search_text(track));
  if (design.limits && design.limits->has_clearances())
    text += labelled("Clearances", clearances_text(design));
  if (track.limit_checks.empty()) return text;
  Table table({"Limit", "bound", "reached", "at", "price or verdict"});
  for (const LimitCheck& check : track.limit_checks) table.add(row_of(design, track, check));
  return text + "\n" + table.text();
}

std::string limits_verdict(const Track& track) {
  if (track.limit_checks.empty()) return "-";
  const auto broken = std::count_if(track.limit_checks.begin(), track.limit_checks.end(),
                                    [](const LimitCheck& check) { return !check.kept(); });
  return broken == 0 ? "kept" : std::to_string(broken) + " broken";
}

}  // namespace glissade::app
