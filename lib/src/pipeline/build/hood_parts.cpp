// The hood of a transfer as plates: a valley, turned over. What rides it is pressed on by its speed.

#include "pipeline/build/hood_parts.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"

#include "parts/bodies/clash.hpp"
#include "parts/shop/workshop_list.hpp"
#include "pipeline/task/hood.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace glissade::pipeline {
namespace {

// The stream is held on by its speed alone while kinks are counted [m/s^2].
constexpr double kNoGravity = 1e-6;

PlateOptions options_of_hood(PlateOptions options) {
  options.supports.reset();
  options.lifting.reset();
  options.inspection.clear();
  options.cover.reset();
  options.floor_wear.clear();
  if (options.liner) {
    options.liner->where = LinerPlaces::whole;
    options.liner->life.reset();
    options.liner->tonnage.reset();
  }
  return options;
}

/// The section at the start of the track, left and right exchanged: turning over exchanges them again.
section::Measures section_of_hood(const Design& design) {
  section::Measures measures = *design.cross_section;
  if (const auto width = section::width_law(measures))
    measures = section::with_width(measures, width->at(0.0));
  if (auto* const polygon = std::get_if<section::Polygon>(&measures)) {
    for (Vec2& corner : polygon->outline) corner.x = 0.0 - corner.x;
    std::reverse(polygon->outline.begin(), polygon->outline.end());
  }
  return measures;
}

/// Half a turn about the level line along the run, and on to where the hood hangs.
class TurnedOver {
 public:
  TurnedOver(const Placement& made, Vec3 entry)
      : along_(made.to_space(1.0, 0.0, 0.0) - made.to_space(0.0, 0.0, 0.0)), entry_(entry) {}

  [[nodiscard]] Vec3 direction(Vec3 v) const { return 2.0 * dot(along_, v) * along_ - v; }
  [[nodiscard]] Vec3 operator()(Vec3 point) const { return entry_ + direction(point); }
  [[nodiscard]] Frame operator()(const Frame& frame) const {
    return {(*this)(frame.origin), direction(frame.x), direction(frame.y), direction(frame.z)};
  }

 private:
  Vec3 along_;
  Vec3 entry_;
};

/// @param entry  where the feed meets the hood, seen from the start of the track: run and height [m]
SettingOutPoint hanging(SettingOutPoint point, Vec2 entry, const TurnedOver& turned) {
  point.what = "hood " + point.what;
  point.x += entry.x;
  point.z = entry.y - point.z;
  point.site = turned(point.site);
  point.slope_angle = Angle::from_radians(-point.slope_angle.radians());
  point.radius = -point.radius;
  point.ordinate = 0.0 - point.ordinate;
  return point;
}

void join_parts(Workshop hood, const TurnedOver& turned, Workshop& all) {
  std::map<int, int> numbers;  // of parts that no other is equal to
  for (ShopPart& part : hood.parts) {
    const int before = part.number;
    part.name.insert(0, "hood_");
    for (Frame& place : part.places) place = turned(place);
    part.centre_of_gravity = turned(part.centre_of_gravity);
    const std::size_t count = all.parts.size();
    const auto colour = part.colour;
    const int number = parts::add_part(all, std::move(part), colour);
    if (all.parts.size() > count) numbers[before] = number;
  }
  for (BendStep step : hood.bends) {
    const auto found = numbers.find(step.part);
    if (found == numbers.end()) continue;
    step.part = found->second;
    all.bends.push_back(step);
  }
}

void join_lists(Workshop hood, Vec2 entry, const TurnedOver& turned, Workshop& all) {
  for (BoughtInItem& item : hood.items) {
    item.where += ", of the hood";
    parts::add_item(all, std::move(item));
  }
  for (ShopMeasurement& value : hood.measured) {
    value.where.insert(0, "hood: ");
    all.measured.push_back(std::move(value));
  }
  for (const SettingOutPoint& point : hood.setting_out)
    all.setting_out.push_back(hanging(point, entry, turned));
  for (Issue& shortfall : hood.shortfalls) {
    shortfall.what.insert(0, "hood: ");
    all.shortfalls.push_back(std::move(shortfall));
  }
  for (const std::string& note : hood.notes) all.notes.push_back("Hood: " + note);
}

void join_proofs(const PartsProof& hood, PartsProof& all) {
  all.volume += hood.volume;
  all.exact_volume += hood.exact_volume;
  all.added_volume += hood.added_volume;
  all.bolted += hood.bolted;
  all.edge_mismatch = std::max(all.edge_mismatch, hood.edge_mismatch);
  if (hood.smallest_gap > 0.0)
    all.smallest_gap =
        all.smallest_gap > 0.0 ? std::min(all.smallest_gap, hood.smallest_gap) : hood.smallest_gap;
  for (const VolumeDifference& one : hood.differences)
    all.differences.push_back({one.what + ", hood", one.volume});
}

}  // namespace

void add_hood_parts(const Design& design, const Track& track, const Placement& frame,
                    const PlateOptions& options, WorkshopBuild& build) {
  const HoodPassage passage = hood_passage(design, track.motion.body());
  Body body;
  body.friction = track.motion.body().friction;
  body.entry_speed = passage.motion.at(0.0).speed;
  const Placement made = track.placement.at_origin();
  const CenterlinePtr valley = turned_over(shape_of(design.hood.value()), first_fall(design).landing);
  WorkshopBuild hood = make_plates(*valley, section_of_hood(design), {design.fabrication->arc_tolerance},
                                   options_of_hood(options), made, body, kNoGravity);
  const Vec2 entry{-passage.start.x, passage.start.y};
  const TurnedOver turned(made, frame.to_space(entry.x, -entry.y, 0.0));
  join_parts(hood.workshop, turned, build.workshop);
  join_lists(std::move(hood.workshop), entry, turned, build.workshop);
  join_proofs(hood.proof, build.proof);
  try {
    build.proof.pairs = parts::require_no_clash(build.workshop);
  } catch (const InternalError& error) {
    // Each of them alone has none.
    throw InputError(
        {design.where("hood"), "hood and track do not go together: " + error.issues().front().what,
         "Their plates, frames and rims take room beside the stream.",
         "a larger drop, narrower or no flanges, another radius, or hood: false in fabrication"});
  }
}

}  // namespace glissade::pipeline
