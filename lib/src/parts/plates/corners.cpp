#include "parts/plates/corners.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/number_text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

namespace glissade::parts {
namespace {

constexpr double kOffFrame = 10e-3;   // of tabs from the ends of laps [m]
constexpr double kLeastTab = 3.2e-3;  // narrower ones burn away [m]

bool walls_beside(const Job& job) {
  return job.options.walls == WallSeat::beside_floor;
}

/// Stretches of a face on which a tab may stand.
std::vector<Span> tab_room(const Job& job, const FloorFace& face) {
  const Span lap = lapped(job, face.line.length());
  const bool bent = face.facets.has_value();
  const double slack = 0.5 * job.options.corners.clearance;
  const double off = slack + (bent ? 2.0 * job.channel.thickness : kOffJoint);
  std::vector<Span> rooms;
  for (const TrackArc& arc : face.line.arcs()) {
    if (bent && arc.curvature != 0.0) continue;
    const Span room{std::max(arc.start + off, lap.from + kOffFrame),
                    std::min(arc.start + arc.length - off, lap.to - kOffFrame)};
    if (room.to - room.from >= job.options.corners.tab) rooms.push_back(room);
  }
  return rooms;
}

/// The middle of a tab nearest to a place; none where all room nearby is beyond `within`.
std::optional<double> nearest_middle(const std::vector<Span>& rooms, double half, double about,
                                     double within) {
  std::optional<double> best;
  for (const Span& room : rooms) {
    const double place = std::clamp(about, room.from + half, room.to - half);
    const double away = std::fabs(place - about);
    if (away <= within && (!best || away < std::fabs(*best - about))) best = place;
  }
  return best;
}

/// A place off every joint of a line.
double off_joints(const ArcSpline& line, double place, double step) {
  for (const TrackArc& arc : line.arcs()) {
    if (std::fabs(place - arc.start) < kOffJoint) return arc.start + step * kOffJoint;
  }
  return place;
}

void append(ArcPath& path, const ArcPath& more, Vec2 origin) {
  for (const PathVertex& vertex : more.vertices) path.vertices.push_back({vertex.at + origin, vertex.bulge});
}

ArcPath moved_by(ArcPath path, Vec2 origin) {
  for (PathVertex& vertex : path.vertices) vertex.at = vertex.at + origin;
  return path;
}

/// The lower line of a wall: with tabs through the floor, or with laps below it between the frames.
std::optional<ArcPath> lower_line(const Job& job, const Span& span, const FloorFace& face,
                                  const std::vector<Span>& tabs, double low) {
  if (!walls_beside(job) && !tabs.empty()) {
    ArcPath path;
    double reached = 0.0;
    for (const Span& tab : tabs) {
      append(path, *offset_line(face.line, {reached, tab.from}, 0.0), face.origin);
      append(path, *offset_line(face.line, tab, -job.channel.thickness), face.origin);
      reached = tab.to;
    }
    append(path, *offset_line(face.line, {reached, face.line.length()}, 0.0), face.origin);
    return path;
  }
  const double length = span.to - span.from;
  const Span lap = lapped(job, length);
  if (!walls_beside(job) || overlap(job) == 0.0 || lap.from == 0.0) return offset_line(job.track, span, low);
  const double flush = low + overlap(job);
  ArcPath path;
  const std::array<std::pair<Span, double>, 3> steps = {{{{span.from, span.from + lap.from}, flush},
                                                         {{span.from + lap.from, span.from + lap.to}, low},
                                                         {{span.from + lap.to, span.to}, flush}}};
  for (const auto& [part, height] : steps) {
    const auto line = offset_line(job.track, part, height);
    if (!line) return std::nullopt;
    append(path, *line, {});
  }
  return path;
}

/// A closed outline without corners that come twice.
ArcPath closed_outline(ArcPath lower, const ArcPath& upper) {
  const ArcPath back = reversed(upper);
  lower.vertices.insert(lower.vertices.end(), back.vertices.begin(), back.vertices.end());
  lower.vertices.back().bulge = 0.0;
  lower.closed = true;
  return lower;
}

}  // namespace

double overlap(const Job& job) {
  const bool laps = job.options.corners.kind != CornerJoint::butt && job.channel.wall_height > 0.0;
  return laps ? job.options.corners.overlap : 0.0;
}

bool has_tabs(const Job& job) {
  return job.options.corners.kind == CornerJoint::tab_and_slot && job.channel.wall_height > 0.0;
}

double floor_width(const Job& job) {
  if (job.channel.wall_height == 0.0) return job.channel.width;
  if (!walls_beside(job)) return job.channel.width + 2.0 * (job.channel.wall() + overlap(job));
  return job.channel.width + (has_tabs(job) ? 2.0 * job.channel.wall() : 0.0);
}

Span floor_base(const Job& job) {
  const double out = has_tabs(job) && walls_beside(job) ? job.channel.wall() : 0.0;
  return {out, floor_width(job) - out};
}

Span lapped(const Job& job, double length) {
  const double end = job.options.flanges.wanted ? job.options.flanges.along() + kLapAside : 0.0;
  return {end, length - end};
}

Span lapped(const Job& job, const ArcSpline& line) {
  const Span whole = lapped(job, line.length());
  if (whole.from == 0.0) return whole;
  return {off_joints(line, whole.from, 1.0), off_joints(line, whole.to, -1.0)};
}

std::vector<Span> tab_places(const Job& job, const FloorFace& face, std::size_t unit) {
  if (!has_tabs(job)) return {};
  const CornerOptions& corners = job.options.corners;
  const double half = 0.5 * corners.tab;
  const std::vector<Span> rooms = tab_room(job, face);
  if (rooms.empty()) {
    double longest = 0.0;
    for (const TrackArc& arc : face.line.arcs()) {
      if (!face.facets || arc.curvature == 0.0) longest = std::max(longest, arc.length);
    }
    throw InputError(
        {"corners.tab",
         "tab: " + length_text(corners.tab) + " finds no place on the floor of unit " + std::to_string(unit),
         (face.facets ? "Its longest flat between bends is " : "Its longest arc is ") +
             length_text(longest, 3) + ", and frames take the ends.",
         "tab: " + length_text(0.3 * longest, 2) +
             (face.facets ? ", fewer bends, or corners: lap" : ", or corners: lap")});
  }
  const double low = rooms.front().from + half;
  const double high = rooms.back().to - half;
  const double count = std::max(1.0, std::ceil((high - low) / corners.spacing - 1e-9));
  const double step = (high - low) / count;
  std::vector<Span> places;
  for (double k = 0.0; k <= count; k += 1.0) {
    const auto middle = nearest_middle(rooms, half, low + k * step, 0.5 * step + corners.tab);
    const bool apart = middle && (places.empty() || *middle - half - places.back().to > corners.tab);
    if (apart) places.push_back({*middle - half, *middle + half});
  }
  return places;
}

PlaneRegion floor_sheet(const Job& job, const ArcSpline& line, const std::vector<Span>& tabs) {
  const double length = line.length();
  const double width = floor_width(job);
  const Span base = floor_base(job);
  // The right half of the outline from the upstream edge on; the left half mirrors it.
  std::vector<Vec2> right = {{0.0, base.from}};
  PlaneRegion region;
  if (walls_beside(job) || overlap(job) == 0.0) {
    for (const Span& tab : tabs) {
      if (!walls_beside(job)) break;
      right.insert(right.end(), {{tab.from, base.from}, {tab.from, 0.0}, {tab.to, 0.0}, {tab.to, base.from}});
    }
  } else {
    const double lap = overlap(job);
    const double slack = 0.5 * job.options.corners.clearance;
    const Span out = lapped(job, line);
    if (out.from > 0.0) right = {{0.0, lap}, {out.from, lap}, {out.from, 0.0}, {out.to, 0.0}, {out.to, lap}};
    for (const Span& tab : tabs) {
      const Vec2 low{tab.from - slack, lap - slack};
      const Vec2 high{tab.to + slack, lap + job.channel.wall() + slack};
      region.cutouts.push_back(rectangle(low, high));
      region.cutouts.push_back(rectangle({low.x, width - high.y}, {high.x, width - low.y}));
    }
  }
  right.push_back({length, right.front().y});
  region.outline.closed = true;
  for (const Vec2 corner : right) region.outline.vertices.push_back({corner, 0.0});
  for (auto corner = right.rbegin(); corner != right.rend(); ++corner)
    region.outline.vertices.push_back({{corner->x, width - corner->y}, 0.0});
  return region;
}

PlaneRegion developed(const Job& job, const FloorFace& face, const PlaneRegion& sheet) {
  const bool bent = face.facets.has_value();
  const auto flat = [&](double x) {
    double sum = 0.0;
    for (const TrackArc& arc : face.line.arcs()) {
      const double whole = flat_length(arc, job.channel.thickness, neutral_fibre(job), bent);
      if (x >= arc.start + arc.length) {
        sum += whole;
        continue;
      }
      return sum + std::max(0.0, x - arc.start) * (whole / arc.length);
    }
    return sum;
  };
  PlaneRegion region = sheet;
  for (PathVertex& vertex : region.outline.vertices) vertex.at.x = flat(vertex.at.x);
  for (ArcPath& cutout : region.cutouts) {
    for (PathVertex& vertex : cutout.vertices) vertex.at.x = flat(vertex.at.x);
  }
  return region;
}

std::optional<PlaneRegion> wall_region(const Job& job, const Span& span, const FloorFace& face,
                                       const std::vector<Span>& tabs) {
  const Span heights = wall_heights(job);
  auto lower = lower_line(job, span, face, tabs, heights.from);
  const auto upper = offset_line(job.track, span, heights.to);
  if (!lower || !upper) return std::nullopt;
  PlaneRegion region{closed_outline(std::move(*lower), *upper), {}, {}};
  if (!walls_beside(job)) return region;
  const double slack = 0.5 * job.options.corners.clearance;
  for (const Span& tab : tabs) {
    const auto slot =
        band(face.line, {tab.from - slack, tab.to + slack}, -job.channel.thickness - slack, slack);
    region.cutouts.push_back(moved_by(*slot, face.origin));
  }
  return region;
}

std::vector<Issue> corner_problems(const ChannelMeasures& channel, const PlateOptions& options) {
  const CornerOptions& corners = options.corners;
  std::vector<Issue> issues;
  if (corners.kind == CornerJoint::butt) return issues;
  if (channel.wall_height <= 0.0) {
    issues.push_back({"corners", "corners: there are no walls that a floor could meet", "",
                      "corners: butt, or a cross_section with walls"});
    return issues;
  }
  const double wall = channel.wall();
  const bool beside = options.walls == WallSeat::beside_floor;
  const double slotted = beside ? wall : channel.thickness;
  const double tabbed = beside ? channel.thickness : wall;
  const bool tabs = corners.kind == CornerJoint::tab_and_slot;
  const double least = tabs ? slotted + 0.5 * corners.clearance : 0.0;
  if (!(corners.overlap > 0.0) || corners.overlap < least) {
    issues.push_back(
        {"corners.overlap",
         "overlap: " + length_text(corners.overlap) +
             (tabs ? " leaves too little beyond the slots" : " is not positive"),
         tabs ? "A web is at least as wide as its plate is thick, " + length_text(slotted) + "." : "",
         "overlap: " + length_text(std::max(15e-3, 2.0 * least), 2)});
  }
  if (!tabs) return issues;
  if (!(corners.clearance >= 0.0) || corners.clearance > 0.5 * tabbed) {
    issues.push_back({"corners.clearance",
                      "clearance: " + text_beyond(corners.clearance, {0.0, 0.5 * tabbed}, &length_text) +
                          " is out of range",
                      "A slot is larger than its tab by 0 to half the plate's thickness, " +
                          length_text(0.5 * tabbed) + ".",
                      "clearance: 0.2 mm"});
  }
  const double narrow = std::max(2.0 * tabbed, kLeastTab);
  if (!(corners.tab >= narrow)) {
    issues.push_back({"corners.tab", "tab: " + length_text(corners.tab) + " is too narrow",
                      "Tabs are at least 2 thicknesses wide, and 3.2 mm: " + length_text(narrow) + ".",
                      "tab: " + length_text(4.0 * tabbed)});
  }
  if (!(corners.spacing >= 2.0 * corners.tab)) {
    issues.push_back(
        {"corners.spacing",
         "spacing: " + length_text(corners.spacing) + " is too close for tabs of " + length_text(corners.tab),
         "They are at least twice their width apart.",
         "spacing: " + length_text(std::max(0.3, 4.0 * corners.tab))});
  }
  return issues;
}

}  // namespace glissade::parts
