#include "parts/strips.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"

#include "core/plane_geometry.hpp"
#include "parts/as_built.hpp"
#include "parts/bent_strips.hpp"
#include "parts/body_geometry.hpp"
#include "parts/bolts.hpp"
#include "parts/bores.hpp"
#include "parts/corners.hpp"
#include "parts/equal_parts.hpp"
#include "parts/frame_room.hpp"
#include "parts/offset_line.hpp"
#include "parts/plate_checks.hpp"
#include "parts/plate_facts.hpp"
#include "parts/plate_joints.hpp"
#include "parts/plate_proof.hpp"
#include "parts/plate_unit.hpp"
#include "parts/section_corners.hpp"
#include "parts/setting_out.hpp"
#include "parts/shop_facts.hpp"
#include "parts/strip_fittings.hpp"
#include "parts/strip_shape.hpp"
#include "parts/strip_sheet.hpp"
#include "parts/workshop_list.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace glissade::parts {
namespace {

constexpr double kSameEdge = 1e-9;  // lengths of edges that meet [m]

double radius_of(double curvature) {
  return curvature == 0.0 ? std::numeric_limits<double>::infinity() : 1.0 / curvature;
}

/// Radii to which the arcs of a strip are rolled, and the steps that do it; none of a plate that bends by itself.
std::vector<double> rolled_radii(const StripJob& job, const SectionPlate& plate, const Span& span,
                                 std::vector<BendStep>& steps) {
  constexpr double kElastic = 1000.0;  // thicknesses: half of that is where structural steel yields
  const Vec2 across = plate.middle_from() - plate.middle_to();
  const double level = std::fabs(across.x) / norm(across);  // sin b
  const double middle = 0.5 * (plate.middle_from().y + plate.middle_to().y);
  std::vector<double> radii;
  double reached = 0.0;
  double sum = 0.0;
  int hit = 0;
  bool rolled = false;
  for (const StripArc& one : job.arcs_in(span)) {
    const TrackArc& arc = one.arc;
    // The normal curvature of the cone; upright plates are not rolled at all.
    const double curvature = level < 1e-9 ? 0.0 : level * arc.curvature / (1.0 - arc.curvature * middle);
    const double length = arc.length * (1.0 - arc.curvature * plate.middle_to().y);
    const double turned = level * arc.curvature * arc.length;
    sum += turned;
    radii.push_back(radius_of(curvature));
    rolled = rolled || std::fabs(radii.back()) < kElastic * job.section.thickness || !job.widens();
    if (hit > 0 && radii.back() == radii[radii.size() - 2]) {
      BendStep& last = steps.back();
      last.length += length;
      last.angle = Angle::from_radians(last.angle.radians() + turned);
      last.sum = Angle::from_radians(sum);
    } else {
      steps.push_back({0, ++hit, reached, length, Angle::from_radians(turned), Angle::from_radians(sum),
                       radii.back(), 0.0});
    }
    reached += length;
  }
  if (level >= 1e-9 && rolled) return radii;
  steps.clear();
  return {};
}

constexpr double kOffFrame = 10e-3;  // of tabs from the ends of laps [m]

/// What is cut from the plates of a unit besides their edges.
struct UnitWork {
  Span laps;               ///< where edges that pass reach out
  std::vector<Span> tabs;  ///< along the track
  std::vector<TilePlace> tiles;
  std::vector<std::vector<Circle>> holes;  ///< a list a plate: (place along the track, y along its face)
};

double slack_of(const StripJob& job) {
  return 0.5 * job.options.corners.clearance;
}

bool has_tabs(const StripJob& job) {
  return job.options.corners.kind == CornerJoint::tab_and_slot;
}

/// The stretch of track on which every plate stands unfolded.
Span all_unfolded(const StripJob& job) {
  Span span{0.0, job.track.length()};
  for (const SectionPlate& plate : job.section.plates) {
    const Span one = unfolded(job, plate);
    span = {std::max(span.from, one.from), std::min(span.to, one.to)};
  }
  return span;
}

/// What frames leave of a unit to laps: their ends off the joints of arcs.
Span laps_of(const StripJob& job, const Span& unit) {
  const Span all = all_unfolded(job);
  Span laps{std::max(unit.from, all.from), std::min(unit.to, all.to)};
  if (!job.options.flanges.wanted || !job.section.convex) return laps;
  const double end = job.options.flanges.thickness + kLapAside;
  const auto off_joints = [&](double place, double sense) {
    for (const TrackArc& arc : job.track.arcs()) {
      if (std::fabs(place - arc.start) < kOffJoint) return arc.start + sense * kOffJoint;
    }
    return place;
  };
  return {off_joints(std::max(laps.from, unit.from + end), 1.0),
          off_joints(std::min(laps.to, unit.to - end), -1.0)};
}

/// Tabs of a unit, evenly as far as arcs let them stand on one of them each.
std::vector<Span> tabs_of(const StripJob& job, const Span& laps, std::size_t number) {
  const CornerOptions& corners = job.options.corners;
  const double half = 0.5 * corners.tab;
  const Span within{laps.from + kOffFrame + half, laps.to - kOffFrame - half};
  const OnOneArc arcs(job.track, half + slack_of(job), {0.0, 0.0});
  const double count = std::max(1.0, std::ceil((within.to - within.from) / corners.spacing - 1e-9));
  const double step = (within.to - within.from) / count;
  std::vector<Span> tabs;
  for (double k = 0.0; k <= count; k += 1.0) {
    const auto middle = arcs.nearest(within.from + k * step, within);
    if (middle && (tabs.empty() || *middle - half - tabs.back().to > corners.tab))
      tabs.push_back({*middle - half, *middle + half});
  }
  if (!tabs.empty()) return tabs;
  double longest = 0.0;
  for (const TrackArc& arc : job.track.arcs()) {
    longest = std::max(longest, std::min(laps.to, arc.start + arc.length) - std::max(laps.from, arc.start));
  }
  throw InputError(
      {"corners.tab",
       "tab: " + length_text(corners.tab) + " finds no place along unit " + std::to_string(number),
       "Its longest arc is " + length_text(longest, 3) + ", and frames take the ends.",
       "tab: " + length_text(0.3 * longest, 2) + ", or corners: lap"});
}

/// @param row  courses of tiles before the unit; counts on
UnitWork work_of(const StripJob& job, const Span& unit, std::size_t number, int& row) {
  UnitWork work;
  work.holes.resize(job.section.plates.size());
  if (job.options.corners.kind != CornerJoint::butt) {
    work.laps = laps_of(job, unit);
    if (has_tabs(job)) work.tabs = tabs_of(job, work.laps, number);
  }
  if (!job.options.liner) return work;
  std::vector<double> breaks;
  for (const Span& tab : work.tabs)
    breaks.insert(breaks.end(), {tab.from - slack_of(job), tab.to + slack_of(job)});
  work.tiles = strip_tiles(job, unit, breaks, row);
  work.holes = holes_below(job, work.tiles);
  return work;
}

/// A strip with laps, tabs, slots or holes.
Strip worked_strip(const StripJob& job, std::size_t index, const Span& span, const CorneredPlate& edges,
                   const UnitWork& work) {
  const SectionPlate& plate = job.section.plates[index];
  Strip strip;
  strip.plate = index;
  strip.span = span;
  SheetCut cut = plain_cut(plate, job.section.thickness, span, job.options.material);
  cut.edges = edges;
  cut.laps = {std::max(work.laps.from, span.from), std::min(work.laps.to, span.to)};
  cut.tabs = work.tabs;
  cut.slack = slack_of(job);
  cut.holes = work.holes[index];
  double mismatch = 0.0;
  strip.part = sheet_part(job, cut, rolled_radii(job, plate, span, strip.steps), mismatch);
  strip.edge_mismatch = mismatch;
  return strip;
}

Strip strip_of(const StripJob& job, std::size_t index, const Span& span) {
  const SectionPlate& plate = job.section.plates[index];
  const Development flat = developed(job, plate, span);
  Strip strip;
  strip.plate = index;
  strip.span = span;
  strip.edge_to = length_along(flat.base, flat.turns);
  strip.edge_from = length_along(flat.upper, flat.turns);
  const std::vector<double> radii = rolled_radii(job, plate, span, strip.steps);
  for (const BendLine& fold : flat.folds) {
    const auto at = std::find(flat.base.begin(), flat.base.end(), fold.from) - flat.base.begin();
    const std::vector<double> turns(flat.turns.begin(), flat.turns.begin() + at);
    const Angle angle = fold.up ? fold.angle : Angle::from_radians(-fold.angle.radians());
    strip.steps.push_back({0, static_cast<int>(strip.steps.size()) + 1, length_along(flat.base, turns), 0.0,
                           angle, angle, fold.inner_radius, 0.0});
  }

  ShopPart& part = strip.part;
  part.name = plate.name;
  part.material = job.options.material.name;
  part.density = job.options.material.density;
  part.thickness = job.section.thickness;
  Vec2 origin;
  part.body = strip_body(job, plate, span, origin);
  part.places = {plane_of_track(job.placement, origin, 0.0, -0.5 * (plate.face_from.x + plate.face_to.x))};
  weigh(part);
  part.pattern = pattern_of(flat, radii);
  return strip;
}

std::vector<UnitWork> works_between(const StripJob& job, const std::vector<double>& joints) {
  std::vector<UnitWork> works;
  int row = 0;
  for (std::size_t j = 0; j + 1 < joints.size(); ++j)
    works.push_back(work_of(job, {joints[j], joints[j + 1]}, j + 1, row));
  return works;
}

std::vector<Strip> strips_between(const StripJob& job, const std::vector<double>& joints,
                                  const std::vector<UnitWork>& works) {
  std::vector<Strip> strips;
  const std::vector<CorneredPlate> edges = cornered(job.section, job.options);
  for (std::size_t p = 0; p < job.section.plates.size(); ++p) {
    const Span whole = unfolded(job, job.section.plates[p]);
    for (std::size_t j = 0; j + 1 < joints.size(); ++j) {
      const Span span{std::max(joints[j], whole.from), std::min(joints[j + 1], whole.to)};
      if (!(span.to - span.from > 1e-6)) continue;
      const bool meets = edges[p].from.meeting != CornerEdge::Meeting::mitre ||
                         edges[p].to.meeting != CornerEdge::Meeting::mitre;
      const bool worked = meets || !works[j].holes[p].empty();
      strips.push_back(worked ? worked_strip(job, p, span, edges[p], works[j]) : strip_of(job, p, span));
      if (joints.size() > 2) strips.back().part.name += "_" + std::to_string(j + 1);
    }
  }
  return strips;
}

// --- frames

void add_polygon(ArcPath& path, const std::vector<Vec2>& corners) {
  for (const Vec2 corner : corners) path.vertices.push_back({corner, 0.0});
}

/// Evenly spaced places along a chain of lines.
std::vector<Vec2> along_chain(std::vector<Vec2> chain, bool closed, double pitch, double edge) {
  if (closed) chain.push_back(chain.front());
  double whole = 0.0;
  for (std::size_t i = 0; i + 1 < chain.size(); ++i) whole += norm(chain[i + 1] - chain[i]);
  const double room = closed ? whole : whole - 2.0 * edge;
  const double gaps = std::max(closed ? 4.0 : 1.0, std::ceil(room / pitch - 1e-9));
  std::vector<Vec2> places;
  for (double k = 0.0; k < (closed ? gaps : gaps + 1.0); k += 1.0) {
    double left = (closed ? 0.5 * room / gaps : edge) + room * k / gaps;
    std::size_t i = 0;
    while (i + 2 < chain.size() && left > norm(chain[i + 1] - chain[i])) {
      left -= norm(chain[i + 1] - chain[i]);
      ++i;
    }
    places.push_back(chain[i] + (left / norm(chain[i + 1] - chain[i])) * (chain[i + 1] - chain[i]));
  }
  return places;
}

/// The outside of the section over the thickness of the frames on both sides of a joint: farther out nowhere.
std::vector<Vec2> outside_at(const StripJob& job, double lean, double s) {
  const double t = job.options.flanges.thickness;
  double wider = 0.0;
  for (const double place : {s - t, s, s + t}) wider = std::max(wider, job.wider_at(place));
  std::vector<Vec2> corners;
  for (const Vec2 corner : job.section.outside) corners.push_back(job.at(corner, wider, lean));
  return corners;
}

ShopPart frame_of(const StripJob& job, const std::vector<Vec2>& outside, HoleFit fit) {
  const FlangeOptions& flange = job.options.flanges;
  const PlateSection& section = job.section;
  const double sign = section.outside_on_left ? 1.0 : -1.0;
  const auto at = [&](double by) { return moved_to_left(outside, section.closed, sign * by); };
  std::vector<Vec2> inner = at(flange.gap);
  std::vector<Vec2> outer = at(flange.gap + flange.width);
  FlatPattern pattern;
  pattern.region.outline.closed = true;
  if (section.closed) {
    add_polygon(pattern.region.outline, outer);
    pattern.region.cutouts.push_back({{}, true});
    add_polygon(pattern.region.cutouts.back(), inner);
  } else {
    std::reverse(inner.begin(), inner.end());
    add_polygon(pattern.region.outline, outer);
    add_polygon(pattern.region.outline, inner);
  }
  // Rims are level: of a wall that leans, holes keep their distance from the rim, not along the wall.
  const Vec2 first = outside[1] - outside[0];
  const double upright = section.closed ? 1.0 : std::fabs(first.y) / norm(first);
  const double edge = 1.5 * clearance_hole(flange.bolt, HoleFit::coarse) / (upright > 0.0 ? upright : 1.0);
  const double radius = 0.5 * clearance_hole(flange.bolt, fit);
  for (const Vec2 centre :
       along_chain(at(flange.gap + 0.5 * flange.width), section.closed, flange.pitch, edge))
    pattern.region.holes.push_back({centre, radius});
  ShopPart part;
  part.name = fit == HoleFit::coarse ? "end_frame_loose" : "end_frame";
  part.material = job.options.material.name;
  part.density = job.options.material.density;
  part.thickness = flange.thickness;
  part.body = Prism{pattern.region, flange.thickness};
  part.pattern = std::move(pattern);
  return part;
}

Frame place_of_frame(const StripJob& job, double s, double shift) {
  const TrackFrame at = frame_at(job.track, s);
  return {in_space(job.placement, at.at + shift * at.along), across(job.placement),
          direction_in_space(job.placement, at.up), direction_in_space(job.placement, at.along)};
}

/// @param bent  none: the plates are rolled
void add_frames(const StripJob& job, const std::optional<BentStrips>& bent, const std::vector<double>& joints,
                Workshop& workshop) {
  if (!job.options.flanges.wanted) return;
  if (!job.section.convex) {
    workshop.notes.emplace_back("The section is hollow outside: no frame fits round it, ends are welded.");
    return;
  }
  std::size_t bolts = 0;
  for (const HoleFit fit : {HoleFit::medium, HoleFit::coarse}) {
    for (std::size_t i = 0; i < joints.size(); ++i) {
      const bool tight = fit == HoleFit::medium;
      if (tight ? i == 0 : i + 1 == joints.size()) continue;
      // Both frames of a joint are one figure, but for their holes.
      const double lean = bent ? bent->lean_at(joints[i]) : job.lean_at(joints[i]);
      ShopPart frame = frame_of(job, outside_at(job, lean, joints[i]), fit);
      if (job.widens()) frame.name += "_" + std::to_string(i);
      frame.places = {place_of_frame(job, joints[i], tight ? -job.options.flanges.thickness : 0.0)};
      if (tight && i + 1 < joints.size()) bolts += frame.pattern->region.holes.size();
      weigh(frame);
      add_part(workshop, frame, kFrameColour);
    }
  }
  if (bolts == 0) return;
  const std::string where =
      joints.size() == 3 ? "at the joint" : "at the " + std::to_string(joints.size() - 2) + " joints";
  add_bolts(workshop, job.options.flanges.bolt, 2.0 * job.options.flanges.thickness, bolts, where);
}

/// Widens the gap of frames that nobody told where plates that begin or bend close behind one would stand in it.
/// @throws InputError where the gap was told: the place, and the gap that would do
FlangeOptions frames_that_clear(const StripJob& job, const std::vector<double>& joints,
                                const std::vector<Strip>& strips) {
  FlangeOptions flange = job.options.flanges;
  if (!flange.wanted || !job.section.convex) return flange;
  double most = 0.0;
  double where = 0.0;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const FrameOpening opening{outside_at(job, job.lean_at(joints[i]), joints[i]), job.section.closed,
                               job.section.outside_on_left};
    for (const double shift : {0.0, -flange.thickness}) {
      if (shift == 0.0 ? i + 1 == joints.size() : i == 0) continue;
      const Frame place = place_of_frame(job, joints[i], shift);
      for (const Strip& strip : strips) {
        const double out = standing_out(strip.part, opening, place, flange.thickness, 0.5 * flange.width);
        if (out > most) where = joints[i];
        most = std::max(most, out);
      }
    }
  }
  constexpr double kRounding = 1.5e-5;  // of arcs, and of parts that share a number
  if (most <= flange.gap + kRounding) return flange;
  const double enough = 1e-4 * std::ceil(1.05e4 * most);
  if (flange.as_told) {
    throw InputError({"flanges.gap",
                      "gap: " + length_text(flange.gap) +
                          " is closed by plates that begin or bend behind a frame, at " +
                          length_text(where, 3) + " along the track",
                      "They stand " + length_text(most, 3) + " out of the section there.",
                      "gap: " + length_text(enough) + ", or a thinner frame"});
  }
  flange.gap = enough;
  return flange;
}

// --- proof

/// Area and first moment of the whole section by its outlines.
Vec2 area_and_moment(const PlateSection& section) {
  if (!section.mitred) {
    // Plates that butt are no chain: one by one.
    Vec2 sum;
    for (const SectionPlate& plate : section.plates) {
      PlateSection one;
      one.plates = {plate};
      sum = sum + area_and_moment(one);
    }
    return sum;
  }
  Vec2 sum;
  const auto add = [&](const std::vector<Vec2>& corners) {
    Vec2 one;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vec2 a = corners[i];
      const Vec2 b = corners[(i + 1) % corners.size()];
      one = one + Vec2{0.5 * cross(a, b), cross(a, b) * (a.y + b.y) / 6.0};
    }
    return one;
  };
  std::vector<Vec2> face;
  std::vector<Vec2> back;
  for (const SectionPlate& plate : section.plates) {
    face.push_back(plate.face_from);
    back.push_back(plate.back_from);
  }
  if (section.closed) {
    const Vec2 one = add(face);
    const Vec2 other = add(back);
    sum = one - other;
  } else {
    face.push_back(section.plates.back().face_to);
    back.push_back(section.plates.back().back_to);
    face.insert(face.end(), back.rbegin(), back.rend());
    sum = add(face);
  }
  return sum.x < 0.0 ? -1.0 * sum : sum;
}

PlateSection moved_out(const StripJob& job, PlateSection section, double wider, double lean) {
  for (SectionPlate& plate : section.plates) {
    for (Vec2* const corner : {&plate.face_from, &plate.face_to, &plate.back_from, &plate.back_to})
      *corner = job.at(*corner, wider, lean);
  }
  return section;
}

/// A S - M phi of a section along a stretch: exactly, since corners move across evenly and keep their heights.
/// @param leaning  as the plates do; else as the design has it
double volume_along(const StripJob& job, const PlateSection& section, const Span& span, bool leaning) {
  double volume = 0.0;
  for (const StripArc& one : job.arcs_in(span)) {
    const double lean = leaning ? 1.0 : 0.0;
    const Vec2 from = area_and_moment(moved_out(job, section, one.wide_from, lean * one.lean_from));
    const Vec2 to = area_and_moment(moved_out(job, section, one.wide_to, lean * one.lean_to));
    const Vec2 mean = 0.5 * (from + to);
    volume += one.arc.length * (mean.x - one.arc.curvature * mean.y);
  }
  return volume;
}

/// Of a plate over the stretches where it is missing.
double missing_volume(const StripJob& job, const SectionPlate& plate, bool leaning) {
  const Span span = unfolded(job, plate);
  PlateSection alone;
  alone.plates = {plate};
  return volume_along(job, alone, {0.0, span.from}, leaning) +
         volume_along(job, alone, {span.to, job.track.length()}, leaning);
}

/// What the plates should hold, and the greatest difference of an edge from what it should be.
struct Wanted {
  double volume = 0.0;
  double edge_mismatch = 0.0;
};

Wanted wanted_of(const StripJob& job, const std::vector<Strip>& strips) {
  Wanted wanted{volume_along(job, job.section, {0.0, job.track.length()}, true), 0.0};
  for (const SectionPlate& plate : job.section.plates) wanted.volume -= missing_volume(job, plate, true);
  for (const Strip& strip : strips) {
    if (strip.edge_mismatch) {
      wanted.edge_mismatch = std::max(wanted.edge_mismatch, *strip.edge_mismatch);
      continue;
    }
    const SectionPlate& plate = job.section.plates[strip.plate];
    double from = 0.0;
    double to = 0.0;
    for (const StripArc& one : job.arcs_in(strip.span)) {
      const auto edge = [&](Vec2 middle) {
        return one.arc.length * (1.0 - one.arc.curvature * middle.y) * math::hypot(1.0, one.taper());
      };
      from += edge(plate.middle_from());
      to += edge(plate.middle_to());
    }
    wanted.edge_mismatch =
        std::max({wanted.edge_mismatch, std::fabs(from - strip.edge_from), std::fabs(to - strip.edge_to)});
  }
  return wanted;
}

Wanted wanted_of(const BentStrips& bent, const std::vector<Strip>& strips) {
  Wanted wanted;
  for (const Strip& strip : strips) {
    const BentStrips::Expected expected = bent.expected(strip);
    wanted.volume += expected.volume;
    wanted.edge_mismatch = std::max({wanted.edge_mismatch, std::fabs(expected.edge_from - strip.edge_from),
                                     std::fabs(expected.edge_to - strip.edge_to)});
  }
  return wanted;
}

/// The section by design over what the plates cover, along the arcs.
double exact_volume(const StripJob& job, const std::optional<BentStrips>& bent,
                    const std::vector<Strip>& strips) {
  double volume = 0.0;
  if (!bent) {
    volume = volume_along(job, job.section, {0.0, job.track.length()}, false);
    // What is missing where the track bends tighter than a strip is high.
    for (const SectionPlate& plate : job.section.plates) volume -= missing_volume(job, plate, false);
    return volume;
  }
  for (const Strip& strip : strips) {
    PlateSection alone;
    alone.plates = {job.section.plates[strip.plate]};
    volume += volume_along(job, alone, strip.span, false);
  }
  return volume;
}

/// Of a stretch of a plate's section along a stretch of track.
double volume_along(const StripJob& job, Vec2 section, const Span& span) {
  double volume = 0.0;
  for (const StripArc& one : job.arcs_in(span))
    volume += one.arc.length * (section.x - one.arc.curvature * section.y);
  return volume;
}

/// What laps, tabs, slots and holes make more or less than mitred plates are, in closed form but for holes in leaning ones.
std::vector<VolumeDifference> cut_differences(const StripJob& job, const std::vector<Strip>& strips,
                                              const std::vector<double>& joints,
                                              const std::vector<UnitWork>& works) {
  // Of two plates that meet, one has what the mitre would have left to the other: a difference where only one of them goes on.
  VolumeDifference ends{"edges beyond the ends of other plates", 0.0};
  VolumeDifference laps{"laps", 0.0};
  VolumeDifference tabs{"tabs", 0.0};
  VolumeDifference slots{"slots", 0.0};
  VolumeDifference holes{"holes of the liner", 0.0};
  const std::vector<CorneredPlate> edges = cornered(job.section, job.options);
  const double t = job.section.thickness;
  for (const Strip& strip : strips) {
    const auto unit = static_cast<std::size_t>(
        std::upper_bound(joints.begin(), joints.end() - 1, strip.span.from) - joints.begin() - 1);
    const UnitWork& work = works[unit];
    const SectionPlate& plate = job.section.plates[strip.plate];
    const CorneredPlate& own = edges[strip.plate];
    const CorneredPlate mitred = plain_cut(plate, t, strip.span, job.options.material).edges;
    ends.volume += volume_along(job,
                                stretch_moments(plate, t, own.from.plain, own.to.plain) -
                                    stretch_moments(plate, t, mitred.from.plain, mitred.to.plain),
                                strip.span);
    const Span out{std::max(work.laps.from, strip.span.from), std::min(work.laps.to, strip.span.to)};
    for (const CornerEdge* const edge : {&edges[strip.plate].from, &edges[strip.plate].to}) {
      const bool passes = edge->meeting == CornerEdge::Meeting::passes;
      if (passes) laps.volume += volume_along(job, stretch_moments(plate, t, edge->plain, edge->out), out);
      if (edge->meeting == CornerEdge::Meeting::mitre) continue;
      for (const Span& tab : work.tabs) {
        const Span slot{tab.from - slack_of(job), tab.to + slack_of(job)};
        if (passes)
          slots.volume -= volume_along(job, stretch_moments(plate, t, edge->slot_near, edge->slot_far), slot);
        else
          tabs.volume += volume_along(job, stretch_moments(plate, t, edge->plain, edge->out), tab);
      }
    }
    if (const auto* const sheet = std::get_if<RolledSheet>(&strip.part.body)) {
      for (const Bore& bore : bores_of(*sheet)) holes.volume -= drilled_by_layers(bore);
    }
  }
  std::vector<VolumeDifference> all;
  constexpr double kRounding = 1e-13;  // [m^3]
  for (const VolumeDifference& one : {ends, laps, tabs, slots, holes}) {
    if (std::fabs(one.volume) > kRounding) all.push_back(one);
  }
  return all;
}

PartsProof prove(const StripJob& job, const std::optional<BentStrips>& bent, const std::vector<Strip>& strips,
                 const std::vector<VolumeDifference>& cut, const Workshop& workshop) {
  PartsProof proof;
  proof.exact_volume = exact_volume(job, bent, strips);
  Wanted wanted = bent ? wanted_of(*bent, strips) : wanted_of(job, strips);
  if (bent) {
    proof.differences = {{job.widens() ? "flats for arcs, lean of the walls" : "flats for arcs",
                          wanted.volume - proof.exact_volume}};
  } else if (job.widens()) {
    proof.differences = {{"lean of the walls", wanted.volume - proof.exact_volume}};
  }
  for (const VolumeDifference& difference : cut) {
    proof.differences.push_back(difference);
    wanted.volume += difference.volume;
  }
  for (const Strip& strip : strips) proof.volume += strip.part.volume;
  proof.edge_mismatch = wanted.edge_mismatch;
  double listed = 0.0;
  for (const ShopPart& part : workshop.parts) listed += part.volume * static_cast<double>(part.quantity());
  proof.added_volume = listed - proof.volume;
  if (!(std::fabs(proof.volume - wanted.volume) <= kPartsVolumeAccuracy * wanted.volume)) {
    throw InternalError({"",
                         "the strips hold " + rounded_text(proof.volume, 12) + " m^3, the section " +
                             rounded_text(wanted.volume, 12) + " m^3",
                         "", ""});
  }
  if (!(proof.edge_mismatch <= kSameEdge)) {
    throw InternalError({"", "edges differ by " + length_text(proof.edge_mismatch, 3), "", ""});
  }
  proof.pairs = require_no_clash(workshop);
  require_bolts_meet(workshop);
  if (job.options.flanges.wanted) proof.smallest_gap = job.options.flanges.gap;
  if (has_tabs(job)) {
    const double slack = slack_of(job);
    proof.smallest_gap = proof.smallest_gap > 0.0 ? std::min(proof.smallest_gap, slack) : slack;
  }
  return proof;
}

void list_strips(std::vector<Strip>& strips, Workshop& workshop) {
  for (Strip& strip : strips) {
    const std::size_t before = workshop.parts.size();
    const bool floor = strip.part.name.starts_with("floor");
    const int number = add_part(workshop, strip.part, floor ? kFloorColour : kWallColour);
    if (workshop.parts.size() == before) continue;
    for (BendStep step : strip.steps) {
      step.part = number;
      workshop.bends.push_back(step);
    }
  }
}

void measure_strips(const std::vector<Strip>& strips, Workshop& workshop) {
  for (const Strip& strip : strips) {
    for (const BendStep& step : strip.steps) {
      if (!std::isfinite(step.radius)) continue;
      measure_rolling(
          std::fabs(step.radius), strip.part,
          strip.part.name + " at " + length_text(strip.span.from + step.distance, 3) + " along the track",
          workshop);
    }
  }
}

/// What rules of the shop may bound of tabs and slots.
void measure_tabs(const StripJob& job, const std::vector<double>& joints, const std::vector<UnitWork>& works,
                  Workshop& workshop) {
  if (!has_tabs(job)) return;
  ShopFacts facts(workshop);
  for (std::size_t j = 0; j < works.size(); ++j) {
    const std::string where = "tabs at " + length_text(joints[j], 3) + " along the track";
    const std::vector<Span>& tabs = works[j].tabs;
    for (std::size_t i = 0; i < tabs.size(); ++i) {
      const double width = tabs[i].to - tabs[i].from;
      facts.at(where, "tab_width", width);
      facts.at(where, "tab_thicknesses", width, job.section.thickness);
      if (i > 0) facts.at(where, "tab_gap", tabs[i].from - tabs[i - 1].to);
    }
  }
  measure_slots(workshop);
  facts.at("every slot", "slot_clearance", job.options.corners.clearance);
}

/// How corners meet that are no mitres.
void note_corners(const StripJob& job, Workshop& workshop) {
  const CornerOptions& corners = job.options.corners;
  if (corners.kind == CornerJoint::butt) return;
  std::string note = job.options.walls == WallSeat::beside_floor ? "Plates farther from the floor reach "
                                                                 : "Plates nearer to the floor reach ";
  note += length_text(corners.overlap) +
          " beyond those that they pass, frames excepted; corners of less than " +
          angle_text(Angle::from_degrees(kLeastTurn), 2) + " and those that turn inwards are mitres";
  if (has_tabs(job)) {
    note += "; tabs, " + length_text(corners.tab) + " wide along the track, stand in slots that are " +
            length_text(corners.clearance) + " larger both ways";
  }
  workshop.notes.push_back(note + ".");
}

/// Which parts are cut alike and formed the other way.
std::string mirrored_pairs(const Workshop& workshop) {
  std::string pairs;
  for (std::size_t i = 0; i < workshop.parts.size(); ++i) {
    const ShopPart& part = workshop.parts[i];
    const auto turned = [&](const ShopPart& other) { return mirror_images(part, other); };
    const auto after = workshop.parts.begin() + static_cast<std::ptrdiff_t>(i) + 1;
    const auto found = std::find_if(after, workshop.parts.end(), turned);
    if (found == workshop.parts.end()) continue;
    pairs +=
        (pairs.empty() ? "" : ", ") + std::to_string(part.number) + " and " + std::to_string(found->number);
  }
  return pairs;
}

/// Where plates begin or end short of the track.
void note_short_plates(const StripJob& job, const std::vector<Strip>& strips, Workshop& workshop) {
  for (std::size_t p = 0; p < job.section.plates.size(); ++p) {
    Span span{job.track.length(), 0.0};
    for (const Strip& strip : strips) {
      if (strip.plate != p) continue;
      span = {std::min(span.from, strip.span.from), std::max(span.to, strip.span.to)};
    }
    if (span.from == 0.0 && span.to == job.track.length()) continue;
    workshop.notes.push_back("The " + job.section.plates[p].name + " goes from " + length_text(span.from, 4) +
                             " to " + length_text(span.to, 4) +
                             " along the track: beyond, its rim would fold over.");
  }
}

void note_bends(const StripJob& job, const BentStrips& bent, const PartsProof& proof, Workshop& workshop) {
  workshop.notes.push_back(
      "Every plate is flats between bends; bodies have the bends without a radius, patterns with that of the "
      "punch, " +
      length_text(job.options.bend.inner_radius.value_or(job.section.thickness)) +
      ". Against the solid along the arcs: " + rounded_text(1e6 * proof.differences.front().volume, 4) +
      " cm^3.");
  if (bent.departure() > 0.0) {
    workshop.notes.push_back(
        "Where the width begins to change beside a bend, it changes at the bend: sides lie off by at most " +
        length_text(bent.departure(), 2) + ".");
  }
}

void add_notes(const StripJob& job, const std::optional<BentStrips>& bent, const PartsProof& proof,
               const std::vector<Strip>& strips, Workshop& workshop) {
  if (bent) note_bends(job, *bent, proof, workshop);
  const std::string pairs = mirrored_pairs(workshop);
  if (!pairs.empty()) {
    workshop.notes.push_back("Parts " + pairs +
                             " are mirror images: blanks alike, turned over, and formed the other way.");
  }
  note_corners(job, workshop);
  if (job.section.mitred) {
    workshop.notes.emplace_back(
        "Strips meet in mitres: patterns are of the middle of the thickness, edges are bevelled to the "
        "joint.");
  }
  if (job.widens()) {
    workshop.notes.push_back(
        "Beside a width that changes walls lean, so that they are bent and not strained: by at most " +
        angle_text(Angle::from_radians(math::atan(job.most_lean())), 3) + ", " +
        length_text(job.departure(), 3) + " from where the width has them" +
        (bent
             ? "."
             : ". Against the solid: " + rounded_text(1e6 * proof.differences.front().volume, 4) + " cm^3."));
    workshop.notes.push_back(
        "Their thickness is counted across the track: square to them it is less by up to " +
        length_text(job.section.thickness * (1.0 - 1.0 / math::hypot(1.0, job.most_taper())), 2) + ".");
  }
  if (job.section.departure > 0.0) {
    workshop.notes.push_back("Flat staves stand in for the round section; they lie outside it by at most " +
                             length_text(job.section.departure, 3) + ".");
  }
  note_short_plates(job, strips, workshop);
}

AsBuiltRide ride_rolled(const StripJob& job, const std::vector<double>& joints, const Body& body,
                        double gravity, const Motion& design) {
  std::vector<std::shared_ptr<const ArcSpline>> lines;
  for (std::size_t i = 0; i + 1 < joints.size(); ++i)
    lines.push_back(std::make_shared<ArcSpline>(rolled_face(job.track, {joints[i], joints[i + 1]}).line));
  return ride_units(lines, job.options.joint_step, design, body, gravity);
}

}  // namespace

std::vector<Issue> strip_problems(const PlateSection& section, const PlateOptions& options) {
  std::vector<Issue> issues;
  if (options.floor == FloorMake::bent) {
    if (auto issue = too_tight_a_bend(section.thickness, options)) issues.push_back(std::move(*issue));
  }
  for (const SectionPlate& plate : section.plates) {
    if (dot(plate.back_to - plate.back_from, plate.face_to - plate.face_from) > 0.0) continue;
    issues.push_back({section.outside_on_left ? "cross_section.thickness" : "thickness",
                      "thickness: " + length_text(section.thickness) + " leaves nothing of the " +
                          plate.name + ", which is " + length_text(norm(plate.face_to - plate.face_from), 3) +
                          " wide",
                      "Plates meet in mitres there.", "a thinner plate"});
    return issues;
  }
  if (!section.outside_on_left) {
    const std::size_t count = section.plates.size();
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t k = i + 1; k < count; ++k) {
        const SectionPlate& a = section.plates[i];
        const SectionPlate& b = section.plates[k];
        const bool next = k == i + 1 || (i == 0 && k + 1 == count);
        const double apart = std::min({core::distance_to_segment(a.face_from, b.face_from, b.face_to),
                                       core::distance_to_segment(a.face_to, b.face_from, b.face_to),
                                       core::distance_to_segment(b.face_from, a.face_from, a.face_to),
                                       core::distance_to_segment(b.face_to, a.face_from, a.face_to)});
        if (next || apart >= 2.0 * section.thickness) continue;
        issues.push_back({"thickness",
                          "thickness: plates of " + length_text(section.thickness) + " inside " + a.name +
                              " and " + b.name + " would meet",
                          "The sides are " + length_text(apart, 3) + " apart.",
                          "thickness: " + length_text(0.45 * apart, 2)});
        return issues;
      }
    }
  }
  return issues;
}

WorkshopBuild make_strips(const ArcSpline& track, const PlateSection& section, const PlateOptions& options,
                          const Placement& placement, const Body& body, double gravity,
                          const Motion& design) {
  const StripJob job(track, section, options, placement);
  std::vector<Strip> strips;
  std::vector<UnitWork> works;
  std::optional<BentStrips> bent;
  WorkshopBuild build;
  const double kink = options.floor == FloorMake::bent
                          ? kink_for_speed(
                                track, options.bend,
                                [&](double largest) {
                                  return bent_flats(job, {0.0, track.length()}, largest);
                                },
                                body, gravity, design.exit_speed())
                          : 1.0;
  split_until_it_fits(options.split, track.length(), [&](std::size_t count) -> std::optional<Excess> {
    build.joints = joints_of(track, options.split, count);
    if (options.floor == FloorMake::bent) {
      bent.emplace(job, kink, build.joints);
      strips = bent->strips();
    } else {
      works = works_between(job, build.joints);
      strips = strips_between(job, build.joints, works);
    }
    for (const Strip& strip : strips) {
      std::optional<Excess> found = excess(options.split, strip.part);
      if (found) found->what = "the " + strip.part.name + " " + found->what;
      if (found) return found;
    }
    return std::nullopt;
  });
  if (!bent && section.convex) {
    require_frame_room(track, build.joints, options.flanges, section.lowest,
                       section.closed ? std::optional(section.highest) : std::nullopt);
  }
  Workshop& workshop = build.workshop;
  list_strips(strips, workshop);
  PlateOptions framed = options;
  if (!bent) framed.flanges = frames_that_clear(job, build.joints, strips);
  add_frames({track, section, framed, placement}, bent, build.joints, workshop);
  add_strip_rims(job, build.joints, workshop);
  add_strip_covers(job, build.joints, workshop);
  if (options.liner) {
    std::vector<TilePlace> tiles;
    for (const UnitWork& work : works) tiles.insert(tiles.end(), work.tiles.begin(), work.tiles.end());
    add_strip_liner(job, tiles, workshop);
  }
  workshop.setting_out = setting_out(track, build.joints, placement);
  build.ride = bent ? as_told(ride_facets(bent->facets(), body, gravity, options.joint_step), design,
                              bent->bends(), build.joints.size() - 2)
                    : ride_rolled(job, build.joints, body, gravity, design);
  measure_plates(options, workshop);
  if (bent)
    measure_bends(strips, options, workshop);
  else
    measure_strips(strips, workshop);
  measure_tabs(job, build.joints, works, workshop);
  const std::vector<VolumeDifference> cut =
      bent ? std::vector<VolumeDifference>() : cut_differences(job, strips, build.joints, works);
  build.proof = prove(job, bent, strips, cut, workshop);
  add_notes(job, bent, build.proof, strips, workshop);
  if (!cut.empty()) note_differences(build.proof, "mitred plates", workshop);
  return build;
}

}  // namespace glissade::parts
