#include "parts/strips/strip_frames.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"

#include "parts/bodies/body_moments.hpp"
#include "parts/plates/angle_frames.hpp"
#include "parts/plates/frame_holes.hpp"
#include "parts/plates/frame_pieces.hpp"
#include "parts/plates/frame_room.hpp"
#include "parts/plates/plate_facts.hpp"
#include "parts/plates/plate_unit.hpp"
#include "parts/shop/workshop_list.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

namespace glissade::parts {
namespace {

void add_polygon(ArcPath& path, const std::vector<Vec2>& corners) {
  for (const Vec2 corner : corners) path.vertices.push_back({corner, 0.0});
}

/// Evenly spaced places along a chain of lines.
/// @param edge  of an open chain, from its ends
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

/// How far along a chain that comes down from a level rim a place lies so far below it; none if the chain stays above.
std::optional<double> along_to(const std::vector<Vec2>& chain, double below) {
  double along = 0.0;
  for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
    const double deep = chain.front().y - chain[i].y;
    const double deeper = chain.front().y - chain[i + 1].y;
    const double whole = norm(chain[i + 1] - chain[i]);
    if (deeper >= below) return along + whole * (below - deep) / (deeper - deep);
    along += whole;
  }
  return std::nullopt;
}

/// The outside of the section over the thickness of the frames on both sides of a joint: farther out nowhere.
std::vector<Vec2> outside_at(const StripJob& job, double lean, double s) {
  const double t = job.options.flanges.along();
  double wider = 0.0;
  for (const double place : {s - t, s, s + t}) wider = std::max(wider, job.wider_at(place));
  std::vector<Vec2> corners;
  for (const Vec2 corner : job.section.outside) corners.push_back(job.at(corner, wider, lean));
  return line_of_frames(std::move(corners), job.section.ring, job.options.flanges);
}

/// Of the uppermost bolts, from the ends of the chain on which they stand.
double frame_edge(const std::vector<Vec2>& outside, const std::vector<Vec2>& chain, bool ring,
                  const FlangeOptions& flange, double rim) {
  const double below = std::max(below_top(flange), rim);
  if (ring) return below;
  if (flange.slotted) {
    if (const auto along = along_to(chain, below)) return *along;
  }
  // Rims are level: of a wall that leans, holes keep their distance from the rim, not along the wall.
  const Vec2 first = outside[1] - outside[0];
  const double upright = std::fabs(first.y) / norm(first);
  return below / (upright > 0.0 ? upright : 1.0);
}

/// @param of_joint  the side on which it lies
ShopPart frame_of(const StripJob& job, const std::vector<Vec2>& outside, FlangeSide of_joint) {
  const FlangeOptions& flange = job.options.flanges;
  const PlateSection& section = job.section;
  const auto at = [&](double by) { return moved_to_left(outside, section.ring, by); };
  std::vector<Vec2> inner = at(flange.gap);
  std::vector<Vec2> outer = at(flange.gap + flange.width);
  FlatPattern pattern;
  pattern.region.outline.closed = true;
  if (section.ring) {
    add_polygon(pattern.region.outline, outer);
    pattern.region.cutouts.push_back({{}, true});
    add_polygon(pattern.region.cutouts.back(), inner);
  } else {
    std::reverse(inner.begin(), inner.end());
    add_polygon(pattern.region.outline, outer);
    add_polygon(pattern.region.outline, inner);
  }
  const std::vector<Vec2> chain = at(flange.gap + 0.5 * flange.width);
  const double rim = section.ring ? 0.0 : bolts_below_rim(job.options);
  drill_frame(
      job.options, of_joint,
      [&](const FlangeOptions& with) {
        return along_chain(chain, section.ring, with.pitch,
                           frame_edge(outside, chain, section.ring, with, rim));
      },
      pattern.region);
  if (!faults_of(pattern.region).empty()) {
    throw InputError(
        {"flanges",
         "flanges: a frame of " + length_text(flange.width) + " round this section runs into itself",
         "Its sides are moved out by that, its ends are level.",
         "flanges: none, a smaller width, or a section whose rims are level"});
  }
  ShopPart part;
  part.name = frame_name("end_frame", flange, of_joint);
  part.material = job.options.material.name;
  part.density = job.options.material.density;
  part.thickness = flange.thickness;
  part.body = Prism{pattern.region, flange.thickness};
  part.pattern = std::move(pattern);
  return part;
}

/// On which its bolts stand.
ArcPath line_in_frame(const StripJob& job, const std::vector<Vec2>& outside) {
  const FlangeOptions& flange = job.options.flanges;
  ArcPath line;
  line.closed = job.section.ring;
  add_polygon(line, moved_to_left(outside, job.section.ring, flange.gap + 0.5 * flange.width));
  return line;
}

std::size_t bolts_of(const ShopPart& frame, bool ring) {
  const PlaneRegion& region = frame.pattern->region;
  return region.holes.empty() ? region.cutouts.size() - (ring ? 1 : 0) : region.holes.size();
}

Frame place_of_frame(const StripJob& job, double s, double shift) {
  const TrackFrame at = frame_at(job.track, s);
  return {in_space(job.placement, at.at + shift * at.along), across(job.placement),
          direction_in_space(job.placement, at.up), direction_in_space(job.placement, at.along)};
}

/// @return how many bolts
std::size_t add_angles(const StripJob& job, const std::optional<BentStrips>& bent,
                       const std::vector<double>& joints, Workshop& workshop) {
  std::size_t bolts = 0;
  for (const FlangeSide side : {FlangeSide::upstream, FlangeSide::downstream}) {
    const bool before = side == FlangeSide::upstream;
    for (std::size_t i = before ? 1 : 0; i + (before ? 0 : 1) < joints.size(); ++i) {
      const double lean = bent ? bent->lean_at(joints[i]) : job.lean_at(joints[i]);
      AngleFrame frame = angle_frame({outside_at(job, lean, joints[i]), job.section.ring}, job.options, side,
                                     {place_of_frame(job, joints[i], 0.0)});
      if (before && i + 1 < joints.size()) bolts += frame.bolts;
      for (ShopPart& piece : frame.pieces) {
        if (job.widens()) piece.name += "_" + std::to_string(i);
      }
      add_angle_frame(frame, side, job.options, workshop);
    }
  }
  return bolts;
}

}  // namespace

std::vector<Vec2> line_of_frames(std::vector<Vec2> outside, bool ring, const FlangeOptions& frame) {
  // A side whose far edge would lead the other way.
  const auto turned = [&](std::size_t i) {
    const std::vector<Vec2> far = moved_to_left(outside, false, frame.gap + frame.width);
    return !(dot(far[i + 1] - far[i], outside[i + 1] - outside[i]) > 0.0);
  };
  while (!ring && outside.size() > 2) {
    if (turned(0))
      outside.erase(outside.begin());
    else if (turned(outside.size() - 2))
      outside.pop_back();
    else
      break;
  }
  return outside;
}

void add_strip_frames(const StripJob& job, const std::optional<BentStrips>& bent,
                      const std::vector<double>& joints, Workshop& workshop) {
  if (!job.options.flanges.wanted) return;
  if (!job.section.convex) {
    add_shortfall({"flanges", "flanges: no frames at the ends of units, which are to be welded",
                   "The section is hollow below: no frame fits round it.",
                   "flanges: none if that is meant, or a section that is nowhere hollow below"},
                  workshop);
    return;
  }
  if (job.options.flanges.section == FlangeSection::angle) {
    const std::size_t bolts = add_angles(job, bent, joints, workshop);
    return add_joint_bolts(workshop, job.options.flanges, bolts, joints.size() - 2);
  }
  std::size_t bolts = 0;
  for (const FlangeSide side : {FlangeSide::upstream, FlangeSide::downstream}) {
    for (std::size_t i = 0; i < joints.size(); ++i) {
      const bool before = side == FlangeSide::upstream;
      if (before ? i == 0 : i + 1 == joints.size()) continue;
      // Both frames of a joint are one figure, but for their holes.
      const double lean = bent ? bent->lean_at(joints[i]) : job.lean_at(joints[i]);
      const std::vector<Vec2> outside = outside_at(job, lean, joints[i]);
      ShopPart frame = frame_of(job, outside, side);
      if (job.widens()) frame.name += "_" + std::to_string(i);
      frame.places = {place_of_frame(job, joints[i], before ? -job.options.flanges.thickness : 0.0)};
      if (before && i + 1 < joints.size()) bolts += bolts_of(frame, job.section.ring);
      weigh(frame);
      const ArcPath line = line_in_frame(job, outside);
      measure_bolt_row(bolts_in_order(frame, line), line.closed, workshop);
      add_in_pieces(frame, line, !before, job.options, kFrameColour, workshop);
    }
  }
  add_joint_bolts(workshop, job.options.flanges, bolts, joints.size() - 2);
}

namespace {

/// How far plates stand out of the section behind frames.
struct StandingOut {
  double most = 0.0;   ///< [m]
  double where = 0.0;  ///< along the track [m]
};

/// @param reach  what stands out farther is beyond the frames [m]
StandingOut standing_out_behind(const StripJob& job, const std::vector<double>& joints,
                                const std::vector<PlacedFacets>& plates, double reach) {
  const double thickness = job.options.flanges.along();
  StandingOut out;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const FrameOpening opening{outside_at(job, job.lean_at(joints[i]), joints[i]), job.section.ring};
    for (const double shift : {0.0, -thickness}) {
      if (shift == 0.0 ? i + 1 == joints.size() : i == 0) continue;
      const Frame place = place_of_frame(job, joints[i], shift);
      for (const PlacedFacets& plate : plates) {
        const double by = standing_out(plate, opening, place, thickness, reach);
        if (by > out.most) out = {by, joints[i]};
      }
    }
  }
  return out;
}

[[noreturn]] void refuse_gap(const FlangeOptions& flange, const StandingOut& out, double enough) {
  throw InputError({"flanges.gap",
                    "gap: " + length_text(flange.gap) +
                        " is closed by plates that begin or bend behind a frame, at " +
                        length_text(out.where, 3) + " along the track",
                    "They stand " + length_text(out.most, 3) + " out of the section there.",
                    "gap: " + length_text(enough) + ", or a " +
                        (flange.section == FlangeSection::angle ? "narrower angle" : "thinner frame")});
}

[[noreturn]] void refuse_frame(const StandingOut& out) {
  throw InputError({"flanges",
                    "flanges: the frame at " + length_text(out.where, 3) +
                        " along the track lies across plates that bend away behind it",
                    "They stand " + length_text(out.most, 3) + " out of the section within its thickness.",
                    "a track that bends less there, by a limit smallest_valley_radius, or flanges: none"});
}

}  // namespace

FlangeOptions frames_that_clear(const StripJob& job, const std::vector<double>& joints,
                                const std::vector<Strip>& strips) {
  FlangeOptions flange = job.options.flanges;
  if (!flange.wanted || !job.section.convex) return flange;
  std::vector<PlacedFacets> plates;
  plates.reserve(strips.size());
  for (const Strip& strip : strips) plates.push_back(placed_facets(strip.part));
  const StandingOut out = standing_out_behind(job, joints, plates, 0.5 * flange.width);
  constexpr double kRounding = 1.5e-5;  // of arcs, and of parts that share a number
  if (out.most > flange.gap + kRounding) {
    const double enough = 1e-4 * std::ceil(1.05e4 * out.most);
    if (flange.as_told) refuse_gap(flange, out, enough);
    flange.gap = enough;
  }
  // What stands out farther than half a frame is none that it makes way for.
  const StandingOut farther = standing_out_behind(job, joints, plates, flange.gap + flange.width);
  if (farther.most > flange.gap + kRounding) refuse_frame(farther);
  return flange;
}

}  // namespace glissade::parts
