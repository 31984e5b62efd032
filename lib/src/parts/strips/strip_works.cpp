#include "parts/strips/strip_works.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"

#include "parts/bodies/body_moments.hpp"
#include "parts/plates/corners.hpp"
#include "parts/plates/plate_unit.hpp"
#include "parts/shop/shop_facts.hpp"
#include "parts/strips/strip_fittings.hpp"
#include "parts/strips/strip_sheet.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

namespace glissade::parts {
namespace {

double radius_of(double curvature) {
  return curvature == 0.0 ? std::numeric_limits<double>::infinity() : 1.0 / curvature;
}

/// Radii to which the arcs of a strip are rolled, and the steps that do it; none of a plate that bends by itself.
/// @param lengths  of the arcs along the edge from which steps count, on the flat; empty: those along the track at its height
std::vector<double> rolled_radii(const StripJob& job, const SectionPlate& plate, const Span& span,
                                 const std::vector<double>& lengths, std::vector<BendStep>& steps) {
  constexpr double kElastic = 1000.0;  // thicknesses: half of that is where structural steel yields
  const Vec2 across = plate.middle_from() - plate.middle_to();
  const double level = std::fabs(across.x) / norm(across);  // sin b
  const double middle = 0.5 * (plate.middle_from().y + plate.middle_to().y);
  const double edge = (plate.ends_at_floor() ? plate.middle_to() : plate.middle_from()).y;
  std::vector<double> radii;
  double reached = 0.0;
  double sum = 0.0;
  int hit = 0;
  bool rolled = false;
  for (const StripArc& one : job.arcs_in(span)) {
    const TrackArc& arc = one.arc;
    // The normal curvature of the cone; upright plates are not rolled at all.
    const double curvature = level < 1e-9 ? 0.0 : level * arc.curvature / (1.0 - arc.curvature * middle);
    const double length = lengths.empty() ? arc.length * (1.0 - arc.curvature * edge) : lengths[radii.size()];
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

}  // namespace

double slack_of(const StripJob& job) {
  return 0.5 * job.options.corners.clearance;
}

bool has_tabs(const StripJob& job) {
  return job.options.corners.kind == CornerJoint::tab_and_slot;
}

Span all_unfolded(const StripJob& job) {
  Span span{0.0, job.track.length()};
  for (const std::size_t unit : {0U, 1U}) {
    for (const SectionPlate& plate : job.section.plates_of(unit)) {
      const Span one = unfolded(job, plate);
      span = {std::max(span.from, one.from), std::min(span.to, one.to)};
    }
  }
  return span;
}

namespace {

/// Heights between which laps, tabs and slots lie, at the most.
Span lap_heights(const StripJob& job) {
  const double out = job.options.corners.overlap + 2.0 * job.section.thickness;
  return {job.section.lowest - out, job.section.highest + out};
}

/// What frames leave of a unit to laps: their ends off the joints of arcs.
Span laps_of(const StripJob& job, const Span& unit) {
  const Span all = all_unfolded(job);
  Span laps{std::max(unit.from, all.from), std::min(unit.to, all.to)};
  if (!job.options.flanges.wanted || !job.section.convex) return laps;
  const double end = job.options.flanges.along() + kLapAside;
  if (job.bent()) {
    const Span heights = lap_heights(job);
    return {job.off_bends(std::max(laps.from, unit.from + end), 1.0, heights),
            job.off_bends(std::min(laps.to, unit.to - end), -1.0, heights)};
  }
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
  const OnOneArc arcs(job.track, half + slack_of(job), {0.0, 0.0}, {}, job.rooms_at_bends(lap_heights(job)));
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

/// @param index  of the unit, from 0
/// @param row  courses of tiles before the unit; counts on
UnitWork work_of(const StripJob& job, const Span& unit, std::size_t index, int& row) {
  UnitWork work;
  work.holes.resize(job.section.plates.size());
  if (job.options.corners.kind != CornerJoint::butt) {
    work.laps = laps_of(job, unit);
    if (has_tabs(job)) work.tabs = tabs_of(job, work.laps, index + 1);
  }
  std::vector<double> breaks;
  for (const Span& tab : work.tabs) {
    const std::vector<double> ends = OnOneArc::ends_of_tab(tab, slack_of(job));
    breaks.insert(breaks.end(), ends.begin(), ends.end());
  }
  // Where laps begin and end, plates that pass others have steps.
  if (job.options.corners.kind != CornerJoint::butt)
    breaks.insert(breaks.end(), {work.laps.from, work.laps.to});
  if (job.options.liner) {
    work.tiles = strip_tiles(job, unit, index, breaks, row);
    work.holes = holes_below(job, index, work.tiles);
  }
  work.windows = windows_of(job, unit, index, breaks);
  for (const StripWindow& window : work.windows) {
    for (const Vec2 bolt : window.bolts)
      work.holes[window.plate].push_back({bolt, 0.5 * clearance_hole(window.bolt, HoleFit::medium)});
  }
  return work;
}

std::vector<SheetOpening> openings_in(const UnitWork& work, std::size_t plate) {
  std::vector<SheetOpening> openings;
  for (const StripWindow& window : work.windows) {
    if (window.plate == plate) openings.push_back({window.along, window.across});
  }
  return openings;
}

struct PlateOfUnit {
  std::size_t plate = 0;
  std::size_t unit = 0;
};

/// A strip with laps, tabs, slots or holes.
SheetCut worked_cut(const StripJob& job, const PlateOfUnit& of, const Span& span, const CorneredPlate& edges,
                    const UnitWork& work) {
  const auto [index, unit] = of;
  const SectionPlate& plate = job.section.plates_of(unit)[index];
  SheetCut cut = plain_cut(plate, job.section.thickness, span, job.options.material);
  cut.edges = edges;
  cut.laps = {std::max(work.laps.from, span.from), std::min(work.laps.to, span.to)};
  cut.tabs = work.tabs;
  cut.slack = slack_of(job);
  cut.holes = work.holes[index];
  cut.openings = openings_in(work, index);
  return cut;
}

Strip worked_strip(const StripJob& job, const PlateOfUnit& of, const Span& span, const CorneredPlate& edges,
                   const UnitWork& work) {
  const SectionPlate& plate = job.section.plates_of(of.unit)[of.plate];
  Strip strip;
  strip.plate = of.plate;
  strip.unit = of.unit;
  strip.span = span;
  const SheetCut cut = worked_cut(job, of, span, edges, work);
  double mismatch = 0.0;
  strip.part = sheet_part(job, cut, rolled_radii(job, plate, span, {}, strip.steps), mismatch);
  strip.edge_mismatch = mismatch;
  return strip;
}

/// The edge from which steps of the schedule count.
const std::vector<Vec2>& counted_edge(const SectionPlate& plate, const Development& flat) {
  return plate.ends_at_floor() ? flat.base : flat.upper;
}

/// Of its arcs.
std::vector<double> lengths_along(const SectionPlate& plate, const Development& flat) {
  const std::vector<Vec2>& edge = counted_edge(plate, flat);
  std::vector<double> lengths;
  for (std::size_t i = 0; i < flat.turns.size(); ++i)
    lengths.push_back(length_along({edge[i], edge[i + 1]}, {flat.turns[i]}));
  return lengths;
}

/// Hits of the press where the width begins or ends to change, in their places among the arcs that are rolled.
void add_folds(const SectionPlate& plate, const Development& flat, std::vector<BendStep>& steps) {
  if (flat.folds.empty()) return;
  const std::vector<double> lengths = lengths_along(plate, flat);
  for (const BendLine& fold : flat.folds) {
    const auto at = std::find(flat.base.begin(), flat.base.end(), fold.from) - flat.base.begin();
    const double reached = std::accumulate(lengths.begin(), lengths.begin() + at, 0.0);
    const Angle angle = fold.up ? fold.angle : Angle::from_radians(-fold.angle.radians());
    steps.push_back({0, 0, reached, 0.0, angle, angle, fold.inner_radius, 0.0});
  }
  std::stable_sort(steps.begin(), steps.end(),
                   [](const BendStep& a, const BendStep& b) { return a.distance < b.distance; });
  double sum = 0.0;
  int hit = 0;
  for (BendStep& step : steps) {
    sum += step.angle.radians();
    step.sum = Angle::from_radians(sum);
    step.hit = ++hit;
  }
}

/// @param work  beside a width that changes
Strip strip_of(const StripJob& job, const PlateOfUnit& of, const Span& span, const UnitWork& work) {
  const auto [index, unit] = of;
  const SectionPlate& plate = job.section.plates_of(unit)[index];
  Development flat = developed(job, plate, span);
  Strip strip;
  strip.plate = index;
  strip.unit = unit;
  strip.span = span;
  strip.edge_to = length_along(flat.base, flat.turns);
  strip.edge_from = length_along(flat.upper, flat.turns);
  strip.pressed = flat.pressed;
  const bool level = plate.middle_from().y == plate.middle_to().y;
  const std::vector<double> radii =
      rolled_radii(job, plate, span,
                   job.widens() && !level ? lengths_along(plate, flat) : std::vector<double>(), strip.steps);
  add_folds(plate, flat, strip.steps);

  ShopPart& part = strip.part;
  part.name = plate.name;
  part.material = job.options.material.name;
  part.density = job.options.material.density;
  part.thickness = job.section.thickness;
  Vec2 origin;
  SweptBody body = strip_body(job, plate, span, origin);
  cut_through(job, plate, span, work.holes[index], openings_in(work, index), body, flat);
  part.body = std::move(body);
  part.places = {plane_of_track(job.placement, origin, 0.0, -0.5 * (plate.face_from.x + plate.face_to.x))};
  weigh(part);
  part.pattern = pattern_of(flat, radii);
  if (job.widens() && !level) weigh_sheet(part);
  return strip;
}

}  // namespace

std::vector<UnitWork> works_between(const StripJob& job, const std::vector<double>& joints) {
  require_openings_on_track(job);
  std::vector<UnitWork> works;
  int row = 0;
  for (std::size_t j = 0; j + 1 < joints.size(); ++j)
    works.push_back(work_of(job, {joints[j], joints[j + 1]}, j, row));
  return works;
}

std::vector<Strip> strips_between(const StripJob& job, const std::vector<double>& joints,
                                  const std::vector<UnitWork>& works) {
  std::vector<Strip> strips;
  const std::array<std::vector<CorneredPlate>, 2> all = {cornered(job.section.of_unit(0), job.options),
                                                         cornered(job.section.of_unit(1), job.options)};
  for (std::size_t p = 0; p < job.section.plates.size(); ++p) {
    for (std::size_t j = 0; j + 1 < joints.size(); ++j) {
      const std::vector<CorneredPlate>& edges = all[j % 2];
      const Span whole = unfolded(job, job.section.plates_of(j)[p]);
      const Span span{std::max(joints[j], whole.from), std::min(joints[j + 1], whole.to)};
      if (!(span.to - span.from > 1e-6)) continue;
      const bool meets = edges[p].from.meeting != CornerEdge::Meeting::mitre ||
                         edges[p].to.meeting != CornerEdge::Meeting::mitre;
      const bool worked = !job.widens() && (meets || !works[j].holes[p].empty());
      strips.push_back(worked ? worked_strip(job, {p, j}, span, edges[p], works[j])
                              : strip_of(job, {p, j}, span, works[j]));
      if (joints.size() > 2) strips.back().part.name += "_" + std::to_string(j + 1);
    }
  }
  return strips;
}

void work_bent(const StripJob& on_flats, const std::vector<Span>& spans, const std::vector<UnitWork>& works,
               std::vector<Strip>& strips) {
  const std::array<std::vector<CorneredPlate>, 2> all = {
      cornered(on_flats.section.of_unit(0), on_flats.options),
      cornered(on_flats.section.of_unit(1), on_flats.options)};
  for (std::size_t i = 0; i < strips.size(); ++i) {
    Strip& strip = strips[i];
    const std::vector<CorneredPlate>& edges = all[strip.unit % 2];
    const std::size_t unit = strip.unit;
    const std::size_t p = strip.plate;
    const bool meets = edges[p].from.meeting != CornerEdge::Meeting::mitre ||
                       edges[p].to.meeting != CornerEdge::Meeting::mitre;
    if (!meets && works[unit].holes[p].empty()) continue;
    double mismatch = 0.0;
    std::string name = std::move(strip.part.name);
    strip.part =
        sheet_part(on_flats, worked_cut(on_flats, {p, unit}, spans[i], edges[p], works[unit]), {}, mismatch);
    strip.part.name = std::move(name);
    strip.edge_mismatch = mismatch;
  }
}

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

}  // namespace glissade::parts
