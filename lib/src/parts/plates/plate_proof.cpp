// The parts as they are, against what they should be, by routes of their own: the channel's volume by its section, points
// of each part's edges against the insides of all others, developed lengths against the neutral fibre's.

#include "parts/plates/plate_proof.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"

#include "parts/bodies/bores.hpp"
#include "parts/bodies/clash.hpp"
#include "parts/plates/channel_strips.hpp"
#include "parts/plates/corners.hpp"
#include "parts/shop/bolted.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace glissade::parts {
namespace {

constexpr double kEdge = 1e-9;  // greatest difference of developed and finished edges [m]

/// Area and first moment of the channel's section about the floor line.
struct Section {
  double area = 0.0;
  double first = 0.0;
};

Section rectangle_section(double width, double low, double high) {
  return {width * (high - low), 0.5 * width * (high * high - low * low)};
}

/// Volume of a section along a stretch: less where it stands in a hollow.
double along_track(const Section& section, double length, double turned) {
  return section.area * length - section.first * turned;
}

/// Where lines fold: the integral of their lengths over the height, between the radii at which arcs vanish.
double folded_area(const ArcSpline& track, const Span& span, double low, double high) {
  std::vector<double> places = {low, high};
  for (const TrackArc& arc : track.arcs()) {
    const double radius = arc.curvature > 0.0 ? 1.0 / arc.curvature : high;
    if (radius > std::max(low, 0.0) && radius < high) places.push_back(radius);
  }
  if (low < 0.0) places.push_back(0.0);
  std::sort(places.begin(), places.end());
  constexpr std::array<double, 3> kNodes = {0.1127016653792583, 0.5,
                                            0.8872983346207417};  // Gauss, three points
  constexpr std::array<double, 3> kWeights = {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
  constexpr int kPanels = 24;
  double area = 0.0;
  for (std::size_t i = 0; i + 1 < places.size(); ++i) {
    const double step = (places[i + 1] - places[i]) / kPanels;
    if (!(step > 0.0)) continue;
    for (int panel = 0; panel < kPanels; ++panel) {
      for (std::size_t k = 0; k < kNodes.size(); ++k) {
        const auto line = offset_line(track, span, places[i] + step * (panel + kNodes[k]));
        if (line) area += kWeights[k] * step * length(*line);
      }
    }
  }
  return area;
}

double turned_along(const ArcSpline& track, const Span& span) {
  return track.direction(span.from).slope_angle - track.direction(span.to).slope_angle;
}

/// Heights of the walls and width of the floor of corners that butt.
Span plain_heights(const Job& job) {
  Span heights = wall_heights(job);
  if (job.options.walls == WallSeat::beside_floor) heights.from += overlap(job);
  return heights;
}

double plain_width(const Job& job) {
  const bool under = job.options.walls == WallSeat::on_floor && job.channel.wall_height > 0.0;
  return job.channel.width + (under ? 2.0 * job.channel.wall() : 0.0);
}

double exact_volume(const Job& job, const std::vector<Unit>& units) {
  const double thickness = job.channel.thickness;
  const Span heights = plain_heights(job);
  double volume = 0.0;
  for (const Unit& unit : units) {
    const ArcSpline& line = unit.face.line;
    const double floor_turned = line.slope_angle(0.0) - line.slope_angle(line.length());
    volume += along_track(rectangle_section(plain_width(job), -thickness, 0.0), line.length(), floor_turned);
    if (!unit.wall) continue;
    if (folds(job.track, unit.span, heights.to)) {
      volume += 2.0 * job.channel.wall() * folded_area(job.track, unit.span, heights.from, heights.to);
    } else {
      volume += along_track(rectangle_section(2.0 * job.channel.wall(), heights.from, heights.to),
                            unit.span.to - unit.span.from, turned_along(job.track, unit.span));
    }
  }
  return volume;
}

/// What corners that lap or hold tabs have more, or less, than plain ones, in closed form.
std::vector<VolumeDifference> corner_differences(const Job& job, const std::vector<Unit>& units) {
  const double lap = overlap(job);
  if (lap == 0.0) return {};
  const bool beside = job.options.walls == WallSeat::beside_floor;
  const double thickness = job.channel.thickness;
  const double wall = job.channel.wall();
  const double slack = 0.5 * job.options.corners.clearance;
  VolumeDifference laps{"laps", 0.0};
  VolumeDifference tabs{"tabs", 0.0};
  VolumeDifference slots{"slots", 0.0};
  for (const Unit& unit : units) {
    const ArcSpline& line = unit.face.line;
    const auto along_face = [&](const Section& section, const Span& span) {
      return along_track(section, span.to - span.from,
                         line.slope_angle(span.from) - line.slope_angle(span.to));
    };
    if (beside) {
      const double low = wall_heights(job).from;
      const Span out = lapped(job, unit.span.to - unit.span.from);
      const Span span{unit.span.from + out.from, unit.span.from + out.to};
      laps.volume += along_track(rectangle_section(2.0 * wall, low, low + lap), span.to - span.from,
                                 turned_along(job.track, span));
    } else {
      laps.volume += along_face(rectangle_section(2.0 * lap, -thickness, 0.0), lapped(job, line));
    }
    for (const Span& tab : unit.tabs) {
      const Span slot{tab.from - slack, tab.to + slack};
      tabs.volume += along_face(rectangle_section(2.0 * wall, -thickness, 0.0), tab);
      slots.volume -= along_face(beside ? rectangle_section(2.0 * wall, -thickness - slack, slack)
                                        : rectangle_section(2.0 * (wall + 2.0 * slack), -thickness, 0.0),
                                 slot);
    }
  }
  if (!has_tabs(job)) return {laps};
  return {laps, tabs, slots};
}

/// What holes for the liner take out of floors, in closed form.
VolumeDifference hole_difference(const std::vector<Unit>& units) {
  VolumeDifference holes{"holes of the liner", 0.0};
  for (const Unit& unit : units) {
    const auto* const sheet = std::get_if<RolledSheet>(&unit.floor.body);
    if (sheet == nullptr) continue;
    for (const Circle& hole : sheet->region.holes) {
      const ArcSpline& line = unit.face.line;
      const double curvature = line.arcs()[line.arc_at(hole.centre.x)].curvature;
      // Of a hollow the upper face is the smaller cylinder.
      const double face =
          curvature == 0.0 ? std::numeric_limits<double>::infinity() : 1.0 / std::fabs(curvature);
      const double least = curvature < 0.0 ? face - sheet->thickness : face;
      holes.volume -= drilled_volume(hole.radius, sheet->thickness, least);
    }
  }
  return holes;
}

/// Corners of slots (or tabs) of a wall against where the finished floor has them.
double tab_mismatch(const Job& job, const Unit& unit) {
  if (unit.tabs.empty() || !unit.wall) return 0.0;
  const bool beside = job.options.walls == WallSeat::beside_floor;
  const double slack = beside ? 0.5 * job.options.corners.clearance : 0.0;
  const auto flat = [&](const ShopPart& part, Vec2 point) {
    const Vec3 there = part.places.front().to_space({point.x, point.y, 0.0}) - in_space(job.placement, {});
    return Vec2{dot(there, along(job.placement)), there.z};
  };
  std::vector<Vec2> corners;
  const PlaneRegion& region = unit.wall->pattern->region;
  for (const PathVertex& vertex : region.outline.vertices) corners.push_back(flat(*unit.wall, vertex.at));
  for (const ArcPath& cutout : region.cutouts) {
    for (const PathVertex& vertex : cutout.vertices) corners.push_back(flat(*unit.wall, vertex.at));
  }
  double most = 0.0;
  for (const Span& tab : unit.tabs) {
    for (const double s : {tab.from - slack, tab.to + slack}) {
      const TrackFrame at = frame_at(unit.face.line, s);
      for (const double height : {slack, -job.channel.thickness - slack}) {
        const Vec2 wanted = at.at + unit.face.origin + height * at.up;
        double least = std::numeric_limits<double>::infinity();
        for (const Vec2 corner : corners) least = std::min(least, norm(corner - wanted));
        most = std::max(most, least);
      }
    }
  }
  return most;
}

/// Middles of tabs (or slots) on the flat floor against the lengths of its neutral fibre up to them.
double flat_tab_mismatch(const Job& job, const Unit& unit) {
  const bool beside = job.options.walls == WallSeat::beside_floor;
  const bool bent = unit.face.facets.has_value();
  const double neutral = neutral_fibre(job) * job.channel.thickness;
  const PlaneRegion& region = unit.floor.pattern->region;
  double most = 0.0;
  for (std::size_t i = 0; i < unit.tabs.size(); ++i) {
    double middle = 0.0;
    if (beside) {
      // Four corners a tab, after that of the upstream edge.
      for (std::size_t k = 1; k <= 4; ++k) middle += 0.25 * region.outline.vertices.at(4 * i + k).at.x;
    } else {
      for (const PathVertex& vertex : region.cutouts.at(2 * i).vertices) middle += 0.25 * vertex.at.x;
    }
    double fibre = 0.0;
    const double to = 0.5 * (unit.tabs[i].from + unit.tabs[i].to);
    for (const TrackArc& arc : unit.face.line.arcs()) {
      const double end = std::min(to, arc.start + arc.length);
      if (!(end > arc.start)) break;
      const double below = bent && arc.curvature < 0.0 ? job.channel.thickness - neutral : neutral;
      fibre += length(*offset_line(unit.face.line, {arc.start, end}, -below));
    }
    most = std::max(most, std::fabs(middle - fibre));
  }
  return most;
}

/// The least distance between the channel's outside and the inside of a frame.
double least_frame_gap(const Job& job, const std::vector<Unit>& units) {
  const FlangeOptions& flange = job.options.flanges;
  double least = flange.gap;
  const auto see = [&](const Unit& unit, double at, double sense) {
    const TrackFrame frame = frame_at(job.track, at == 0.0 ? unit.span.from : unit.span.to);
    constexpr int kPlaces = 8;
    for (int k = 0; k <= kPlaces; ++k) {
      const double s = at + sense * flange.along() * k / kPlaces;
      const TrackFrame floor = frame_at(unit.face.line, s);
      const Vec2 under = floor.at + unit.face.origin - job.channel.thickness * floor.up;
      const double drop = -floor_depth(job) - job.channel.thickness - dot(under - frame.at, frame.up);
      least = std::min(least, flange.gap - drop);
    }
  };
  for (const Unit& unit : units) {
    see(unit, 0.0, 1.0);
    see(unit, unit.face.line.length(), -1.0);
  }
  return least;
}

double largest_edge_mismatch(const Job& job, const std::vector<Unit>& units) {
  double most = 0.0;
  for (const Unit& unit : units) {
    // The neutral fibre as a line of its own, against the developed length.
    double developed = 0.0;
    double fibre = 0.0;
    const double neutral = neutral_fibre(job);
    const bool bent = unit.face.facets.has_value();
    for (const TrackArc& arc : unit.face.line.arcs()) {
      developed += flat_length(arc, job.channel.thickness, neutral, bent);
      const double below = job.channel.thickness * (bent && arc.curvature < 0.0 ? 1.0 - neutral : neutral);
      const auto line = offset_line(unit.face.line, {arc.start, arc.start + arc.length}, -below);
      fibre += length(*line);
    }
    most =
        std::max({most, std::fabs(developed - fibre), tab_mismatch(job, unit), flat_tab_mismatch(job, unit)});
    most = std::max(most, std::fabs(bounds(unit.floor.pattern->region.outline).width() - developed));
    if (bent || !unit.wall || job.options.walls != WallSeat::beside_floor) continue;
    // Lower edges of floor and wall.
    const auto wall = offset_line(job.track, unit.span, plain_heights(job).from);
    const auto floor = offset_line(unit.face.line, {0.0, unit.face.line.length()}, -job.channel.thickness);
    most = std::max(most, std::fabs(length(*wall) - length(*floor)));
  }
  return most;
}

}  // namespace

PartsProof prove(const Job& job, const std::vector<Unit>& units, const Workshop& workshop) {
  PartsProof proof;
  for (std::size_t i = 0; i < units.size(); ++i) {
    for (const ShopPart& floor : floor_strips(job, units[i], i)) proof.volume += floor.volume;
    for (const WallStrip& wall : wall_strips(job, units[i], i)) proof.volume += 2.0 * wall.part.volume;
  }
  double listed = 0.0;
  for (const ShopPart& part : workshop.parts) listed += part.volume * static_cast<double>(part.quantity());
  proof.added_volume = listed - proof.volume;
  proof.exact_volume = exact_volume(job, units);
  const bool folded = folds(job.track, {0.0, job.track.length()}, job.channel.wall_height);
  const double allowed = folded ? 1e-6 : kPartsVolumeAccuracy;
  proof.differences = corner_differences(job, units);
  if (job.options.liner) proof.differences.push_back(hole_difference(units));
  double wanted = proof.exact_volume;
  for (const VolumeDifference& difference : proof.differences) wanted += difference.volume;
  if (!(std::fabs(proof.volume - wanted) <= allowed * wanted)) {
    throw InternalError({"",
                         "the plates hold " + rounded_text(proof.volume, 12) + " m^3, the channel " +
                             rounded_text(wanted, 12) + " m^3",
                         "", ""});
  }
  proof.pairs = require_no_clash(workshop);
  proof.bolted = require_bolts_meet(workshop).joined;
  if (job.options.flanges.wanted) proof.smallest_gap = least_frame_gap(job, units);
  if (has_tabs(job)) {
    const double slack = 0.5 * job.options.corners.clearance;
    proof.smallest_gap = job.options.flanges.wanted ? std::min(proof.smallest_gap, slack) : slack;
  }
  proof.edge_mismatch = largest_edge_mismatch(job, units);
  if (!(proof.edge_mismatch <= kEdge)) {
    throw InternalError({"", "edges differ by " + length_text(proof.edge_mismatch, 3), "", ""});
  }
  return proof;
}

}  // namespace glissade::parts
