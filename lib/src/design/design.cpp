#include "glissade/design/design.hpp"

#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/quantity.hpp"

#include "design/check.hpp"
#include "design/checks.hpp"
#include "design/findings.hpp"

#include <cmath>
#include <utility>

namespace glissade {
namespace {

Issue located(const Design& design, design_file::Finding finding) {
  finding.issue.where = design.where(finding.key_paths.front());
  return std::move(finding.issue);
}

}  // namespace

std::string Design::where(std::string_view key_path) const {
  for (std::string_view path = key_path; !path.empty(); path = design_file::parent_path(path)) {
    const auto found = locations.find(path);
    if (found != locations.end()) return found->second;
  }
  return file.empty() ? std::string(key_path) : file.string();
}

bool Design::asks_the_same(const Design& other) const {
  return name == other.name && track == other.track && body == other.body && stream == other.stream &&
         materials == other.materials && feed == other.feed && hood == other.hood &&
         discharge == other.discharge && gravity == other.gravity && centerline == other.centerline &&
         limits == other.limits && objective == other.objective && probes == other.probes &&
         rules == other.rules && hill == other.hill && gates == other.gates &&
         cross_section == other.cross_section && fabrication == other.fabrication && mesh == other.mesh &&
         exports == other.exports;
}

Vec2 in_track_plane(const TrackDesign& track, Vec2 point) {
  const double drop = track.start.z - point.y;
  if (track.start.y != track.finish.y) {
    const double edge =
        track.free_start ? math::hypot(track.finish.x - track.start.x, track.finish.y - track.start.y) : 0.0;
    return {edge + point.x, drop};
  }
  const double side = track.finish.x < track.start.x ? -1.0 : 1.0;
  return {side * (point.x - track.start.x), drop};
}

Vec2 in_edge_plane(const TrackDesign& track, Vec2 point) {
  const double drop = track.finish.z - point.y;
  if (track.start.y != track.finish.y) return {point.x, drop};
  const double side = track.finish.x < track.start.x ? -1.0 : 1.0;
  return {side * (point.x - track.finish.x), drop};
}

std::optional<Issue> missed_finish(const TrackDesign& track, const std::string& who, Vec2 end,
                                   double allowance) {
  const double run = math::hypot(track.finish.x - track.start.x, track.finish.y - track.start.y);
  const double drop = track.start.z - track.finish.z;
  const double miss = math::hypot(end.x - run, end.y - drop);
  if (miss <= kFinishAgreement * math::hypot(run, drop) + allowance) return {};
  return Issue{"", who + " miss the finish by " + length_text(miss),
               "They end " + length_text(end.x) + " away and " + length_text(end.y) +
                   " below the start; the finish is " + length_text(run) + " away and " + length_text(drop) +
                   " below.",
               "no finish: it then follows from " + who};
}

std::optional<Issue> ends_fault(const std::string& who, double distance) {
  if (distance >= design_file::kShortestTrack && distance <= design_file::kLongestTrack) return {};
  return Issue{"",
               who + " end " +
                   quantity_beyond(distance, Dimension::length,
                                   {design_file::kShortestTrack, design_file::kLongestTrack}) +
                   " from where they begin",
               "The ends of a track are between 0.1 mm and 1000 km apart.", "the unit of their lengths"};
}

std::vector<Issue> check(const Design& design) {
  std::vector<Issue> issues;
  for (design_file::Finding& finding : design_file::check_values(design)) {
    issues.push_back(located(design, std::move(finding)));
  }
  if (!issues.empty()) return issues;
  if (std::optional<Issue> unreachable = check_reach(design)) issues.push_back(*std::move(unreachable));
  return issues;
}

std::optional<Issue> check_reach(const Design& design) {
  std::optional<design_file::Finding> finding = design_file::find_unreachable(design);
  if (!finding) return {};
  return located(design, *std::move(finding));
}

}  // namespace glissade
