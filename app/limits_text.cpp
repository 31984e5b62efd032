#include "app/limits_text.hpp"

#include "glissade/core/number_text.hpp"

#include "app/console.hpp"
#include "app/table.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace glissade::app {
namespace {

std::string value_text(double value, const std::string& unit) {
  if (!std::isfinite(value)) return "unbounded";
  if (unit == "rad") return angle_text(value);
  if (unit == "m") return length_text(value);
  return rounded_text(value, 4) + " " + unit;
}

std::string bound_text(const LimitCheck& check) {
  if (check.limit == "concave") return "no crest";
  if (check.limit == "finish" || check.limit.starts_with("waypoints")) return "met";
  if (check.limit.starts_with("arrival")) return "arrives";
  const char* const sides[] = {">= ", "", "<= "};
  return sides[check.side + 1] + value_text(check.value, check.unit);
}

/// Rounding of a position that is met is of no interest.
std::string reached_text(const LimitCheck& check) {
  const bool position = check.limit == "finish" || check.limit.starts_with("waypoints");
  if (position && check.kept()) return "met";
  if (check.limit == "concave" && check.kept()) return "no crest";
  if (check.limit.starts_with("arrival") && check.kept()) return "arrives";
  constexpr double kAlmostStraight = 1e6;
  if (check.limit.find("radius") != std::string::npos && check.reached > kAlmostStraight * check.scale) {
    return "straight";
  }
  return value_text(check.reached, check.unit);
}

std::string price_text(const ActiveLimit& active, const Design& design) {
  constexpr double kRadiansPerDegree = std::numbers::pi / 180.0;
  const bool angle = active.unit == "rad";
  const bool speed_counts = design.limits && design.limits->objective.kind == ObjectiveDesignKind::exit_speed;
  return rounded_text(angle ? active.price * kRadiansPerDegree : active.price, 3) +
         (speed_counts ? " m/s per " : " s per ") + (angle ? "deg" : active.unit);
}

std::string places_text(const std::vector<Stretch>& where) {
  constexpr std::size_t kMost = 3;
  constexpr int kDigits = 3;
  std::string text;
  for (std::size_t index = 0; index < std::min(where.size(), kMost); ++index) {
    if (index != 0) text += ", ";
    text += length_text(where[index].from, kDigits);
    if (where[index].to > where[index].from) text += " to " + length_text(where[index].to, kDigits);
  }
  if (where.size() > kMost) text += ", ...";
  return text;
}

const ActiveLimit* active_of(const Track& track, const std::string& limit) {
  if (!track.search) return nullptr;
  const std::vector<ActiveLimit>& active = track.search->active;
  const auto found =
      std::find_if(active.begin(), active.end(), [&](const ActiveLimit& one) { return one.limit == limit; });
  return found == active.end() ? nullptr : &*found;
}

std::vector<std::string> row_of(const Design& design, const Track& track, const LimitCheck& check) {
  const std::string friction =
      check.friction ? ", " + std::string(to_text(*check.friction)) + " friction" : std::string();
  std::string place = length_text(check.where, 3) + friction;
  if (!check.kept()) {
    std::string broken = "broken";
    if (std::isfinite(check.violation)) broken += " by " + value_text(check.violation, check.unit);
    return {check.limit, bound_text(check), reached_text(check), place, emphasised(broken, Emphasis::bad)};
  }
  const ActiveLimit* const active = active_of(track, check.limit);
  if (active == nullptr) return {check.limit, bound_text(check), reached_text(check), place, "kept"};
  if (!active->where.empty()) place = places_text(active->where) + friction;
  return {check.limit, bound_text(check), reached_text(check), place, price_text(*active, design)};
}

std::string search_text(const Track& track) {
  const OptimizeReport& search = *track.search;
  const bool optimal = search.status == OptimizeStatus::optimal;
  return emphasised(to_text(search.status), optimal ? Emphasis::good : Emphasis::bad) + ": " +
         search.message + "\nfirst-order residual " + rounded_text(search.first_order_residual, 2) + ", " +
         std::to_string(search.iterations) + " rounds, " + std::to_string(search.evaluations) +
         " evaluations, " + rounded_text(search.seconds, 2) + " s";
}

}  // namespace

std::string limits_lines(const Design& design, const Track& track) {
  std::string text;
  if (track.search) text += labelled("Search", search_text(track));
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
