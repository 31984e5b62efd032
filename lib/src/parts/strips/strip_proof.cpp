#include "parts/strips/strip_proof.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"

#include "parts/bodies/bores.hpp"
#include "parts/bodies/clash.hpp"
#include "parts/plates/plate_proof.hpp"
#include "parts/plates/section_corners.hpp"
#include "parts/shop/bolted.hpp"
#include "parts/strips/strip_sheet.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>

namespace glissade::parts {
namespace {

constexpr double kMeetingEdges = 1e-9;  // lengths of edges that meet [m]

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

/// Of the plates of all units over the stretches where they are missing.
double missing_volume(const StripJob& job, const std::vector<double>& joints, bool leaning) {
  double volume = 0.0;
  const auto add = [&](const SectionPlate& plate, const Span& span) {
    if (!(span.to > span.from)) return;
    PlateSection alone;
    alone.plates = {plate};
    volume += volume_along(job, alone, span, leaning);
  };
  for (std::size_t j = 0; j + 1 < joints.size(); ++j) {
    for (const SectionPlate& plate : job.section.plates_of(j)) {
      const Span span = unfolded(job, plate);
      add(plate, {joints[j], std::min(joints[j + 1], span.from)});
      add(plate, {std::max(joints[j], span.to), joints[j + 1]});
    }
  }
  return volume;
}

/// What the plates should hold, and the greatest difference of an edge from what it should be.
struct Wanted {
  double volume = 0.0;
  double edge_mismatch = 0.0;
};

Wanted wanted_of(const StripJob& job, const std::vector<Strip>& strips, const std::vector<double>& joints) {
  Wanted wanted{volume_along(job, job.section, {0.0, job.track.length()}, true), 0.0};
  wanted.volume -= missing_volume(job, joints, true);
  for (const Strip& strip : strips) {
    if (strip.edge_mismatch) {
      wanted.edge_mismatch = std::max(wanted.edge_mismatch, *strip.edge_mismatch);
      continue;
    }
    const SectionPlate& plate = job.section.plates_of(strip.unit)[strip.plate];
    double from = 0.0;
    double to = 0.0;
    for (const StripArc& one : job.arcs_in(strip.span)) {
      const auto edge = [&](Vec2 middle) {
        return one.arc.length * (1.0 - one.arc.curvature * middle.y) * math::hypot(1.0, one.taper());
      };
      from += edge(plate.middle_from());
      to += edge(plate.middle_to());
    }
    wanted.edge_mismatch = std::max({wanted.edge_mismatch, std::fabs(from - strip.pressed - strip.edge_from),
                                     std::fabs(to - strip.pressed - strip.edge_to)});
  }
  return wanted;
}

Wanted wanted_of(const BentStrips& bent, const std::vector<Strip>& strips) {
  Wanted wanted;
  for (const Strip& strip : strips) {
    const BentStrips::Expected expected = bent.expected(strip);
    wanted.volume += expected.volume;
    wanted.edge_mismatch = std::max({wanted.edge_mismatch, strip.edge_mismatch.value_or(0.0),
                                     std::fabs(expected.edge_from - strip.edge_from),
                                     std::fabs(expected.edge_to - strip.edge_to)});
  }
  return wanted;
}

/// The section by design over what the plates cover, along the arcs.
double exact_volume(const StripJob& job, const std::optional<BentStrips>& bent,
                    const std::vector<Strip>& strips, const std::vector<double>& joints) {
  double volume = 0.0;
  if (!bent) {
    volume = volume_along(job, job.section, {0.0, job.track.length()}, false);
    // What is missing where the track bends tighter than a strip is high.
    volume -= missing_volume(job, joints, false);
    return volume;
  }
  for (const Strip& strip : strips) {
    PlateSection alone;
    alone.plates = {job.section.plates_of(strip.unit)[strip.plate]};
    volume += volume_along(job, alone, strip.span, false);
  }
  return volume;
}

/// Of a stretch of a plate's section along a stretch of track.
double volume_along(const StripJob& job, Vec2 section, const Span& span) {
  double volume = 0.0;
  for (const StripArc& one : job.arcs_in(span))
    volume += one.arc.length * (section.x - one.arc.curvature * section.y) -
              (one.mitre_from + one.mitre_to) * section.y;
  return volume;
}

/// Area and moment about the floor line of the section of an opening.
Vec2 opening_moments(const StripJob& job, const SectionPlate& plate, const StripWindow& window) {
  const double t = job.section.thickness;
  if (!job.widens()) return stretch_moments(plate, t, {window.across.from, 0.0}, {window.across.to, 0.0});
  // Square through a plate that leans more than the section's: of a shear areas across stay.
  const FaceAt face = face_at(job, plate, 0.5 * (window.along.from + window.along.to));
  const double square = t * std::fabs(face.way.y) / std::fabs(plate.way().y);
  const double area = square * (window.across.to - window.across.from);
  const double across = 0.5 * (window.across.from + window.across.to);
  const double middle = face.from.y + across * face.way.y + 0.5 * square * face.way.x;
  return {area, area * middle};
}

}  // namespace

std::vector<VolumeDifference> cut_differences(const StripJob& job, const std::vector<Strip>& strips,
                                              const std::vector<UnitWork>& works) {
  // Of two plates that meet, one has what the mitre would have left to the other: a difference where only one of them goes on.
  VolumeDifference ends{"edges beyond the ends of other plates", 0.0};
  VolumeDifference laps{"laps", 0.0};
  VolumeDifference tabs{"tabs", 0.0};
  VolumeDifference slots{"slots", 0.0};
  VolumeDifference holes{"holes of the liner", 0.0};
  VolumeDifference openings{"openings", 0.0};
  VolumeDifference lids{"holes of lids", 0.0};
  const std::array<std::vector<CorneredPlate>, 2> all_edges = {cornered(job.section.of_unit(0), job.options),
                                                               cornered(job.section.of_unit(1), job.options)};
  const double t = job.section.thickness;
  for (const Strip& strip : strips) {
    const UnitWork& work = works[strip.unit];
    const std::vector<CorneredPlate>& edges = all_edges[strip.unit % 2];
    const SectionPlate& plate = job.section.plates_of(strip.unit)[strip.plate];
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
      // Plates with openings have no tiles.
      const bool opened = std::any_of(work.windows.begin(), work.windows.end(),
                                      [&](const StripWindow& window) { return window.plate == strip.plate; });
      for (const Bore& bore : bores_of(*sheet)) (opened ? lids : holes).volume -= drilled_by_layers(bore);
    }
    if (const auto* const body = std::get_if<SweptBody>(&strip.part.body)) {
      for (const Bore& bore : bores_of(*body))
        (body->windows.empty() ? holes : lids).volume -= drilled_by_layers(bore);
    }
    for (const StripWindow& window : work.windows) {
      if (window.plate != strip.plate) continue;
      openings.volume -= volume_along(job, opening_moments(job, plate, window), window.along);
    }
  }
  std::vector<VolumeDifference> all;
  constexpr double kRounding = 1e-13;  // [m^3]
  for (const VolumeDifference& one : {ends, laps, tabs, slots, holes, openings, lids}) {
    if (std::fabs(one.volume) > kRounding) all.push_back(one);
  }
  return all;
}

PartsProof prove_strips(const StripJob& job, const std::optional<BentStrips>& bent,
                        const std::vector<Strip>& strips, const std::vector<double>& joints,
                        const std::vector<VolumeDifference>& cut, const Workshop& workshop) {
  PartsProof proof;
  proof.exact_volume = exact_volume(job, bent, strips, joints);
  Wanted wanted = bent ? wanted_of(*bent, strips) : wanted_of(job, strips, joints);
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
  if (!(proof.edge_mismatch <= kMeetingEdges)) {
    throw InternalError({"", "edges differ by " + length_text(proof.edge_mismatch, 3), "", ""});
  }
  proof.pairs = require_no_clash(workshop);
  proof.bolted = require_bolts_meet(workshop).joined;
  if (job.options.flanges.wanted) proof.smallest_gap = job.options.flanges.gap;
  if (has_tabs(job)) {
    const double slack = slack_of(job);
    proof.smallest_gap = proof.smallest_gap > 0.0 ? std::min(proof.smallest_gap, slack) : slack;
  }
  return proof;
}

}  // namespace glissade::parts
