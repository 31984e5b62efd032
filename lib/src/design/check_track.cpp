#include "glissade/core/number_text.hpp"
#include "glissade/core/quantity.hpp"

#include "design/checks.hpp"

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace glissade::design_file {
namespace {

constexpr double kFarthestCoordinate =
    1e7;  // [m]; beyond, a double no longer holds a tenth of a micrometre well

void check_coordinates(const Vec3& position, const std::string& key_path, Collected& findings) {
  const std::array<std::pair<const char*, double>, 3> coordinates = {
      {{"x", position.x}, {"y", position.y}, {"z", position.z}}};
  for (const auto& [name, value] : coordinates) {
    if (std::fabs(value) <= kFarthestCoordinate) continue;
    report(findings, {key_path + "." + name},
           {"",
            std::string(name) + ": " +
                quantity_beyond(value, Dimension::length, {-kFarthestCoordinate, kFarthestCoordinate}) +
                " is too far from the origin",
            "Coordinates lie within 10000 km of the origin.", "a local origin"});
  }
}

/// A wind from behind drives the body, too: how far, its ride tells. That it has no drag for that is told beside it.
bool is_blown(const Design& design) {
  return design.body.head_wind < 0.0;
}

bool may_climb(const Design& design) {
  const CenterlineKind kind = design.centerline.kind;
  return (kind == CenterlineKind::fastest || kind == CenterlineKind::straight) &&
         (design.body.entry_speed > 0.0 || is_blown(design));
}

void check_drop(const Design& design, Collected& findings) {
  const double drop = drop_of(design.track);
  // A track that is drawn leads anywhere: its ride tells how far the body comes.
  if (drop > 0.0 || is_drawn(design.centerline.kind)) return;
  const std::vector<std::string> paths = {"track.finish.z", "track.start.z",    "track.finish",
                                          "track.start",    "body.entry_speed", "centerline"};
  const std::string place = drop < 0.0 ? metres(-drop) + " above the start" : "level with the start";
  if (!may_climb(design) && design.body.entry_speed > 0.0) {
    report(findings, paths,
           {"", "the finish lies " + place,
            "The kind " + std::string(word(design.centerline.kind)) +
                " is made for a start from rest: it must go down.",
            "kind: fastest, which takes account of the entry_speed, or kind: straight"});
    return;
  }
  if (!may_climb(design)) {
    report(findings, paths,
           {"", "the finish lies " + place, "Nothing but gravity drives the body: it must go down.",
            "a finish.z below " + metres(design.track.start.z) + "; z counts upwards"});
    return;
  }
  const double climb = design.body.entry_speed * design.body.entry_speed / (2.0 * design.gravity);
  if (-drop < climb || is_blown(design)) return;
  report(findings, paths,
         {"", "the finish lies " + place + ", higher than the entry speed can carry the body",
          "An entry_speed of " + rounded_text(design.body.entry_speed, 4) + " m/s is worth a climb of " +
              metres(climb) + " without friction.",
          "a lower finish.z or a higher entry_speed"});
}

void check_free_range(const Range& range, const std::string& key, Collected& findings) {
  if (range.lowest && range.highest && *range.lowest > *range.highest) {
    report(findings, {"track.finish." + key},
           {"", key + ": lowest " + metres(*range.lowest) + " is above highest " + metres(*range.highest),
            "Nothing lies between them.", "the two the other way round"});
  }
  if (range.lowest) check_coordinates({*range.lowest, 0.0, 0.0}, "track.finish." + key, findings);
  if (range.highest) check_coordinates({*range.highest, 0.0, 0.0}, "track.finish." + key, findings);
}

/// It is the speed to be reached that says how far a track with a free end has to fall, or bounds that keep the end away from the
/// other one.
void check_free_both_ways(const Design& design, const char* end, Collected& findings) {
  const TrackDesign& track = design.track;
  const bool given =
      design.limits && design.limits->exit_speed.lowest.value_or(0.0) > design.body.entry_speed;
  const bool is_away = !track.free_start &&
                       (!track.free_range.holds(track.start.x) || !track.free_height.holds(track.start.z));
  if (given || is_away) return;
  const std::optional<std::string> speed = exit_speed_to_ask_for(design);
  report(
      findings, {"limits.exit_speed", std::string("track.") + end, "track.edge", "limits", "track"},
      {"",
       std::string("the ") + end + " is free both ways, and no exit speed above the entry speed is asked for",
       "It is the speed to be reached that says how far the track has to fall.",
       speed ? "limits: {exit_speed: {lowest: " + *speed + "}}" : "bounds between which the track falls"});
}

/// A start that the search chooses lies nowhere before it is found.
void check_free_start(const Design& design, Collected& findings) {
  const TrackDesign& track = design.track;
  if (track.free_finish == FinishKind::anywhere) check_free_both_ways(design, "start", findings);
  if (track.free_finish == FinishKind::vertical_line && run_of(track) == 0.0) {
    report(findings, {"track.start", "track.edge"},
           {"", "the start lies on the vertical through the edge",
            "With a free height the track could begin where it ends.", "a start to the side"});
  }
}

void check_free_finish(const Design& design, Collected& findings) {
  const TrackDesign& track = design.track;
  const std::string key = track.free_finish == FinishKind::level ? "x" : "z";
  if (track.free_finish == FinishKind::anywhere) {
    check_free_both_ways(design, "finish", findings);
    check_free_range(track.free_range, "x", findings);
    check_free_range(track.free_height, "z", findings);
  } else {
    check_free_range(track.free_range, key, findings);
  }
  if (design.centerline.kind != CenterlineKind::fastest) {
    report(findings, {"track.finish", "centerline.kind"},
           {"", "a free " + key + " of the finish needs the kind fastest",
            "It is the fastest track that chooses.", "kind: fastest, or a finish with a value for " + key});
  }
  const bool aside = track.start.y == track.finish.y;
  if (!fixes_run(track.free_finish) && !aside) {
    report(findings, {"track.finish.y", "track.start"},
           {"", "y: a finish with a free x lies straight along x from the start", "", "the y of the start"});
  }
  if (track.free_finish == FinishKind::vertical_line && track.start.x == track.finish.x && aside) {
    report(findings, {"track.finish", "track.start"},
           {"", "the finish lies on the vertical through the start",
            "With a free height the track could end where it begins.", "a finish to the side"});
  }
}

}  // namespace

void check_track(const Design& design, Collected& findings) {
  const TrackDesign& track = design.track;
  check_coordinates(track.start, "track.start", findings);
  check_coordinates(track.finish, "track.finish", findings);
  if (!track.finish_given) return;
  if (track.free_finish != FinishKind::point) {
    (track.free_start ? check_free_start : check_free_finish)(design, findings);
  }
  if (track.free_finish == FinishKind::anywhere) return;
  const std::vector<std::string> paths = {"track.finish", "track.start"};
  const double distance = norm(track.finish - track.start);
  if (distance == 0.0) {
    report(findings, paths,
           {"", "start and finish are the same point", "A track leads somewhere.",
            "finish: {x: 5.4 m, z: 1.1 m}"});
    return;
  }
  if (distance < kShortestTrack || distance > kLongestTrack) {
    report(findings, paths,
           {"",
            "start and finish are " +
                quantity_beyond(distance, Dimension::length, {kShortestTrack, kLongestTrack}) + " apart",
            "A track is between 0.1 mm and 1000 km long.", "the units of start and finish"});
    return;
  }
  check_drop(design, findings);
}

}  // namespace glissade::design_file
