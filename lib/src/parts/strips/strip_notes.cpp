#include "parts/strips/strip_notes.hpp"

#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"

#include "parts/plates/seams.hpp"
#include "parts/plates/section_corners.hpp"
#include "parts/shop/equal_parts.hpp"
#include "parts/shop/workshop_list.hpp"
#include "parts/strips/strip_works.hpp"

#include <algorithm>
#include <cstddef>
#include <string>

namespace glissade::parts {
namespace {

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
void tell_short_plates(const StripJob& job, const std::vector<Strip>& strips, Workshop& workshop) {
  for (std::size_t p = 0; p < job.section.plates.size(); ++p) {
    Span span{job.track.length(), 0.0};
    for (const Strip& strip : strips) {
      if (strip.plate != p) continue;
      span = {std::min(span.from, strip.span.from), std::max(span.to, strip.span.to)};
    }
    if (span.from == 0.0 && span.to == job.track.length()) continue;
    tell_short_plate(job.section.plates[p].name, span.from, span.to, job.track.length(), workshop);
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

/// Plates that have no bends where the floor has some.
void note_sprung(const StripJob& job, const std::vector<Strip>& strips, Workshop& workshop) {
  std::vector<std::string> names;
  double largest = 0.0;
  for (const Strip& strip : strips) {
    if (!(strip.sprung > kNoBend)) continue;
    largest = std::max(largest, strip.sprung);
    const std::string& name = job.section.plates_of(strip.unit)[strip.plate].name;
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  if (names.empty()) return;
  std::string all;
  for (const std::string& name : names) all += (all.empty() ? "" : ", ") + name;
  workshop.notes.push_back(all +
                           ": all but upright, pressed at no bend of the floor, sprung into place; flats of "
                           "the bodies meet at up to " +
                           angle_text(Angle::from_radians(largest), 2) + ".");
}

}  // namespace

void add_strip_notes(const StripJob& job, const std::optional<BentStrips>& bent, const PartsProof& proof,
                     const std::vector<Strip>& strips, Workshop& workshop) {
  if (bent) {
    note_bends(job, *bent, proof, workshop);
    note_sprung(job, strips, workshop);
  }
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
  tell_short_plates(job, strips, workshop);
  double seams = 0.0;
  for (const Strip& strip : strips) {
    const auto& all = job.section.seams;
    if (std::find(all.begin(), all.end(), strip.plate) == all.end()) continue;
    const double height = job.section.plates_of(strip.unit)[strip.plate].face_from.y;
    for (const StripArc& one : job.arcs_in(strip.span))
      seams += one.arc.length * (1.0 - one.arc.curvature * height);
  }
  note_seams(seams, workshop);
}

}  // namespace glissade::parts
