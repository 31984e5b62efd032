#include "glissade/task/limit_catalogue.hpp"

#include "glissade/core/number_text.hpp"
#include "glissade/core/units.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace glissade {
namespace {

constexpr double kFastest = 1e4;  // [m/s]
constexpr double kLongest = 1e6;  // [m]
constexpr double kAny = std::numeric_limits<double>::max();

constexpr LimitEntry slope(LimitId id, std::string_view key, std::string_view label, Range Limits::*range,
                           bool fixable) {
  return {id,
          key,
          LimitForm::range,
          Bound::exactly,
          Dimension::angle,
          -kRightAngle,
          kRightAngle,
          false,
          fixable,
          label,
          {},
          range};
}

constexpr LimitEntry amount(LimitId id, std::string_view key, Dimension dimension, double most,
                            std::string_view label, Range Limits::*range, bool fixable) {
  return {id, key, LimitForm::range, Bound::exactly, dimension, 0.0, most, true, fixable, label, {}, range};
}

constexpr LimitEntry positive(LimitId id, std::string_view key, Bound bound, Dimension dimension,
                              std::string_view label, std::optional<double> Limits::*value) {
  return {id, key, LimitForm::value, bound, dimension, 0.0, kAny, true, false, label, {}, nullptr, value};
}

constexpr LimitEntry lead(LimitId id, std::string_view key, std::string_view label, double Limits::*length) {
  return {
      id, key,     LimitForm::length, Bound::lowest, Dimension::length, 0.0, kLongest, false, false, label,
      {}, nullptr, nullptr,           length};
}

constexpr LimitEntry shapes(LimitId id, std::string_view key, std::string_view label) {
  return {id, key, LimitForm::list, Bound::lowest, Dimension::length, 0.0, kLongest, false, false, label};
}

constexpr LimitEntry asked(LimitId id, std::string_view key, Bound bound, Dimension dimension,
                           std::string_view label, std::string_view met = {}) {
  return {id, key, LimitForm::of_task, bound, dimension, -kAny, kAny, false, false, label, met};
}

constexpr LimitEntry coordinate(LimitId id, std::string_view key, std::string_view label) {
  return {id, key, LimitForm::of_task, Bound::exactly, Dimension::length, -kAny, kAny, false, true, label};
}

constexpr LimitEntry implied(LimitId id, std::string_view key, Bound bound, Dimension dimension) {
  return {id, key, LimitForm::of_search, bound, dimension, -kAny, kAny, false, false, key};
}

constexpr std::array kCatalogue = {
    slope(LimitId::entry_slope_angle, "entry_slope_angle", "entry slope angle", &Limits::entry_slope_angle,
          true),
    slope(LimitId::exit_slope_angle, "exit_slope_angle", "exit slope angle", &Limits::exit_slope_angle, true),
    slope(LimitId::slope_angle, "slope_angle", "slope angle", &Limits::slope_angle, false),
    positive(LimitId::smallest_valley_radius, "smallest_valley_radius", Bound::lowest, Dimension::length,
             "smallest valley radius", &Limits::smallest_valley_radius),
    LimitEntry{LimitId::concave, "concave", LimitForm::flag, Bound::lowest, Dimension::per_length, 0.0, 0.0,
               false, false, "concave", "no crest"},
    positive(LimitId::smallest_crest_radius, "smallest_crest_radius", Bound::lowest, Dimension::length,
             "smallest crest radius", &Limits::smallest_crest_radius),
    positive(LimitId::highest_curvature_rate, "highest_curvature_rate", Bound::highest, Dimension::per_area,
             "highest curvature rate", &Limits::highest_curvature_rate),
    positive(LimitId::highest_normal_load, "highest_normal_load", Bound::highest, Dimension::acceleration,
             "highest normal load", &Limits::highest_normal_load),
    LimitEntry{LimitId::lowest_normal_load,
               "lowest_normal_load",
               LimitForm::value,
               Bound::lowest,
               Dimension::acceleration,
               0.0,
               kAny,
               false,
               false,
               "lowest normal load",
               {},
               nullptr,
               &Limits::lowest_normal_load},
    positive(LimitId::highest_curvature_load, "highest_curvature_load", Bound::highest,
             Dimension::acceleration, "highest curvature load", &Limits::highest_curvature_load),
    positive(LimitId::highest_burden_depth, "highest_burden_depth", Bound::highest, Dimension::length,
             "highest burden depth", &Limits::highest_burden_depth),
    positive(LimitId::highest_floor_wear, "highest_floor_wear", Bound::highest, Dimension::power_per_area,
             "highest wear of the floor", &Limits::highest_floor_wear),
    LimitEntry{LimitId::lowest_slope_margin,
               "lowest_slope_margin",
               LimitForm::value,
               Bound::lowest,
               Dimension::angle,
               -kRightAngle,
               kRightAngle,
               false,
               false,
               "slope above the friction angle",
               {},
               nullptr,
               &Limits::lowest_slope_margin},
    amount(LimitId::speed, "speed", Dimension::speed, kFastest, "speed", &Limits::speed, false),
    amount(LimitId::exit_speed, "exit_speed", Dimension::speed, kFastest, "exit speed", &Limits::exit_speed,
           true),
    LimitEntry{LimitId::match_belt, "match_belt", LimitForm::of_group, Bound::exactly, Dimension::speed, 0.0,
               kFastest, true, false, "speed along the belt"},
    amount(LimitId::arc_length, "arc_length", Dimension::length, kLongest, "arc length", &Limits::arc_length,
           true),
    lead(LimitId::lead_in, "lead_in", "lead in", &Limits::lead_in),
    lead(LimitId::lead_out, "lead_out", "lead out", &Limits::lead_out),
    shapes(LimitId::half_planes, "half_planes", "half-plane"),
    shapes(LimitId::keep_outs, "keep_outs", "keep-out"),
    shapes(LimitId::stay_above, "stay_above", "stay above"),
    shapes(LimitId::stay_below, "stay_below", "stay below"),
    LimitEntry{LimitId::waypoints, "waypoints", LimitForm::list, Bound::exactly, Dimension::length, 0.0, 0.0,
               false, false, "waypoint", "passed"},
    asked(LimitId::finish, "finish", Bound::exactly, Dimension::length, "finish", "met"),
    coordinate(LimitId::finish_run, "finish.run", "finish run"),
    coordinate(LimitId::finish_drop, "finish.drop", "finish drop"),
    coordinate(LimitId::finish_x, "finish.x", "finish x"),
    coordinate(LimitId::finish_z, "finish.z", "finish z"),
    asked(LimitId::friction, "friction", Bound::exactly, Dimension::angle, "friction"),
    asked(LimitId::arrival_at_low_friction, "arrival_at_low_friction", Bound::lowest, Dimension::length,
          "arrival at low friction", "arrives"),
    asked(LimitId::arrival_at_high_friction, "arrival_at_high_friction", Bound::lowest, Dimension::length,
          "arrival at high friction", "arrives"),
    implied(LimitId::arrival, "arrival at the finish", Bound::lowest, Dimension::number),
    implied(LimitId::no_steeper_than_vertical, "no steeper than vertical", Bound::highest, Dimension::angle),
    implied(LimitId::no_climb_beyond_vertical, "no climb beyond the vertical", Bound::lowest,
            Dimension::angle),
    implied(LimitId::not_shorter_than_chord, "no shorter than the chord", Bound::lowest, Dimension::length),
    implied(LimitId::not_many_chords_long, "no longer than 20 chords", Bound::highest, Dimension::length),
    implied(LimitId::room_for_body, "a valley that the body fits into", Bound::highest,
            Dimension::per_length),
    implied(LimitId::no_choking, "a stream that does not choke", Bound::highest, Dimension::length),
    implied(LimitId::landing, "a start no steeper than the feed falls", Bound::highest, Dimension::angle),
};

constexpr bool is_in_order() {
  for (std::size_t i = 0; i < kCatalogue.size(); ++i) {
    if (static_cast<std::size_t>(kCatalogue[i].id) != i) return false;
  }
  return true;
}
static_assert(is_in_order(), "entry_of() finds an entry by its place");

std::string domain_text(const LimitEntry& entry) {
  const std::string least = quantity_text(entry.least, entry.dimension);
  if (entry.most == kAny)
    return entry.above_least ? "It is above " + least + "." : "It is " + least + " or more.";
  return "It lies between " + least + " and " + quantity_text(entry.most, entry.dimension) + ".";
}

std::string domain_hint(const LimitEntry& entry, double value) {
  if (entry.above_least || entry.most == kAny)
    return "no " + std::string(entry.key) + ", if it is not limited";
  return value > entry.most ? "at most " + quantity_text(entry.most, entry.dimension)
                            : "at least " + quantity_text(entry.least, entry.dimension);
}

class Faults {
 public:
  void see(const LimitEntry& entry, const std::string& key, double value, bool above_least) {
    const bool inside = value >= entry.least && value <= entry.most;
    if (inside && !(above_least && value == entry.least)) return;
    const bool too_low = above_least && value == entry.least;
    Issue issue = out_of_range(key, value, entry.dimension, {entry.least, entry.most}, domain_text(entry),
                               domain_hint(entry, value));
    if (too_low) issue.what = key + ": " + quantity_text(value, entry.dimension) + " is not positive";
    found_.push_back({key, std::move(issue)});
  }

  void see(const LimitEntry& entry, const Range& range) {
    const std::string key(entry.key);
    if (range.is_fixed()) {
      see(entry, key, *range.lowest, entry.above_least);
      return;
    }
    // At least nothing is no limit, and no fault.
    if (range.lowest) see(entry, key + ".lowest", *range.lowest, false);
    if (range.highest) see(entry, key + ".highest", *range.highest, entry.above_least);
    if (!range.lowest || !range.highest || *range.lowest <= *range.highest) return;
    const auto text = [&](double value, int digits) { return quantity_text(value, entry.dimension, digits); };
    const auto [lowest, highest] = texts_apart(*range.lowest, *range.highest, text);
    found_.push_back({key,
                      {"", key + ": lowest " + lowest + " is above highest " + highest,
                       "Nothing lies between them.", "the two the other way round"}});
  }

  [[nodiscard]] std::vector<LimitFault> found() && { return std::move(found_); }

 private:
  std::vector<LimitFault> found_;
};

}  // namespace

std::span<const LimitEntry> limit_catalogue() {
  return kCatalogue;
}

const LimitEntry& entry_of(LimitId id) {
  return kCatalogue[static_cast<std::size_t>(id)];
}

Range range_of(const LimitEntry& entry, const Limits& limits) {
  if (entry.range == nullptr) return {};
  Range range = limits.*entry.range;
  if (entry.above_least && range.lowest && *range.lowest <= entry.least) range.lowest.reset();
  return range;
}

std::string LimitName::key() const {
  const LimitEntry& entry = entry_of(id);
  std::string text(entry.key);
  if (entry.form == LimitForm::list) return text + "[" + std::to_string(index) + "]";
  const bool ranged = entry.form == LimitForm::range || entry.form == LimitForm::of_group ||
                      (entry.form == LimitForm::of_task && entry.fixable);
  if (ranged && bound != Bound::exactly) text += bound == Bound::lowest ? ".lowest" : ".highest";
  return text;
}

std::string LimitName::label() const {
  const LimitEntry& entry = entry_of(id);
  std::string text(entry.label);
  return entry.form == LimitForm::list ? text + " " + std::to_string(index + 1) : text;
}

double price_for_people(double price, const LimitName& limit) {
  return price / in_unit_for_people(1.0, limit.dimension());
}

std::string price_unit(const LimitName& limit, const Objective& objective) {
  return std::string(unit_of(objective)) + " per " + std::string(unit_for_people(limit.dimension()));
}

std::string price_text(double price, const LimitName& limit, const Objective& objective) {
  return rounded_text(price_for_people(price, limit), 3) + " " + price_unit(limit, objective);
}

std::vector<LimitFault> limit_faults(const Limits& limits) {
  Faults faults;
  for (const LimitEntry& entry : kCatalogue) {
    const std::string key(entry.key);
    if (entry.range != nullptr) faults.see(entry, limits.*entry.range);
    if (entry.value != nullptr && limits.*entry.value)
      faults.see(entry, key, *(limits.*entry.value), entry.above_least);
    if (entry.length != nullptr) faults.see(entry, key, limits.*entry.length, false);
  }
  return std::move(faults).found();
}

}  // namespace glissade
