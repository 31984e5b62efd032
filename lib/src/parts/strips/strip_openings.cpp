// Inspection openings of strips: cut square into the widest side that stands upright on the left, with lids rolled as that side is.

#include "parts/strips/strip_openings.hpp"

#include "glissade/core/number_text.hpp"

#include "core/plane_geometry.hpp"
#include "parts/plates/fittings.hpp"
#include "parts/plates/frame_holes.hpp"
#include "parts/plates/section_corners.hpp"
#include "parts/shop/bolts.hpp"
#include "parts/shop/workshop_list.hpp"
#include "parts/strips/strip_fittings.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>

namespace glissade::parts {
namespace {

constexpr double kOffRim = 2e-3;   // of a lid [m]
constexpr double kPitch = 150e-3;  // of a lid's bolts [m]
constexpr double kUpright = 0.5;   // height per width of a side that counts as one: 60 deg from upright
constexpr double kOffJointOfOpening = 1e-3;  // of its edges from joints of arcs [m]
constexpr double kOnSide = 1e-9;             // [m]

/// Whether a plate is a side of the outside: of those inside an outline, not within its trough.
bool is_outer(const PlateSection& section, const SectionPlate& plate) {
  if (!section.inside_outline) return true;
  const Vec2 middle = 0.5 * (plate.face_from + plate.face_to);
  for (std::size_t i = 0; i + 1 < section.outside.size(); ++i) {
    if (core::distance_to_segment(middle, section.outside[i], section.outside[i + 1]) < kOnSide) return true;
  }
  return false;
}

/// What of a plate a lid may take, along its face.
/// @param edges  of the plate: where it butts against one that laps, that leans over it
Span room_across(const PlateSection& section, const SectionPlate& plate, const CorneredPlate& edges,
                 const PlateOptions& options) {
  Span room{0.0, norm(plate.face_to - plate.face_from)};
  const auto leaning_over = [](const CornerEdge& edge, double sense) {
    const double inwards = sense * edge.plain.below;  // at the plate's far face; the lid's lies as far again
    return edge.meeting == CornerEdge::Meeting::butts && inwards > 0.0 ? 2.0 * inwards + kOffRim : 0.0;
  };
  room.from += leaning_over(edges.from, 1.0);
  room.to -= leaning_over(edges.to, -1.0);
  if (!options.rim || section.ring) return room;
  const double taken = (options.rim->thickness + kOffRim) / std::fabs(plate.way().y);
  const double top = section.outside.front().y;
  if (plate.face_from.y > top - kOnSide) room.from += taken;
  if (plate.face_to.y > top - kOnSide) room.to -= taken;
  return room;
}

struct Side {
  std::size_t plate = 0;
  Span room;
};

std::optional<Side> side_for_openings(const PlateSection& section, const PlateOptions& options) {
  std::optional<Side> best;
  const std::vector<CorneredPlate> edges = cornered(section, options);
  for (std::size_t i = 0; i < section.plates.size(); ++i) {
    const SectionPlate& plate = section.plates[i];
    const bool left = plate.face_from.x + plate.face_to.x > 0.0;
    if (!left || std::fabs(plate.way().y) < kUpright || !is_outer(section, plate)) continue;
    const bool lined = std::any_of(section.lined.begin(), section.lined.end(), [&](const LinedFace& face) {
      return i >= face.plate && i < face.plate + face.strips;
    });
    if (lined) continue;
    const Side side{i, room_across(section, plate, edges[i], options)};
    if (!best || side.room.to - side.room.from > best->room.to - best->room.from + kOnSide) best = side;
  }
  return best;
}

/// Heights of a plate and of the lid on it.
Span heights_of(const PlateSection& section, const SectionPlate& plate) {
  Span heights{plate.face_from.y, plate.face_from.y};
  for (const Vec2 corner : {plate.face_from, plate.face_to, plate.back_from, plate.back_to}) {
    heights.from = std::min(heights.from, corner.y - section.thickness);
    heights.to = std::max(heights.to, corner.y + section.thickness);
  }
  return heights;
}

/// What is wrong with openings, of each the first thing, told at once.
class OpeningIssues {
 public:
  void add(std::string what, std::string why, std::string hint) {
    issues_.push_back({"inspection", std::move(what), std::move(why), std::move(hint)});
  }
  void require_none() {
    if (!issues_.empty()) throw InputError(std::move(issues_));
  }

 private:
  std::vector<Issue> issues_;
};

/// What an opening and its lid take of the floor line to either side: lines above it are shorter in valleys, longer on crests, and
/// what is asked for is the length of the opening's middle line.
struct Reaches {
  double opening = 0.0;
  double lid = 0.0;
};

/// Half of the stretch of floor line about a place whose line at a height has a length; none where it folds away.
std::optional<double> half_of(const StripJob& job, double at, double height, double length) {
  constexpr int kMostSteps = 60;    // budget: each leaves a fraction of what was missing
  constexpr double kMet = 1e-9;     // accuracy [m]
  constexpr double kFolded = 0.05;  // taste: the least share that is left of a line
  double half = 0.5 * length;
  for (int step = 0; step < kMostSteps; ++step) {
    const Span span{std::max(0.0, at - half), std::min(job.track.length(), at + half)};
    const double lost = job.lost_at(span, height);
    if (!(span.to - span.from - lost > kFolded * (span.to - span.from))) return std::nullopt;
    const double missing = length + lost - 2.0 * half;
    if (std::fabs(missing) < kMet) return half;
    half += 0.5 * missing;
  }
  return std::nullopt;
}

double height_at(const SectionPlate& plate, double across) {
  return (plate.face_from + across * plate.way()).y;
}

/// The least length of lines along a plate, anywhere on a stretch, of what they have on the floor line: flats keep theirs.
/// @param across  between which places across the plate
double least_share(const StripJob& job, const SectionPlate& plate, const Span& along, const Span& across) {
  double least = 1.0;
  for (const StripArc& one : job.arcs_in(along)) {
    for (const double place : {across.from, across.to})
      least = std::min(least, 1.0 - one.arc.curvature * height_at(plate, place));
  }
  return least;
}

std::optional<Reaches> reaches_at(const StripJob& job, const SectionPlate& plate, double across,
                                  const InspectionOptions& opening, double at) {
  const double height = height_at(plate, across);
  const double lap = lid_lap(opening, job.options.shop);
  const auto half = half_of(job, at, height, opening.length);
  const auto lid = half_of(job, at, height, opening.length + 2.0 * lap);
  if (!half || !lid) return std::nullopt;
  // Where lines draw together bolts keep off the lid's edges on the shortest of them, too.
  const double high = 0.5 * opening.height + lap;
  const double share = least_share(job, plate, {at - *lid, at + *lid}, {across - high, across + high});
  if (!(share > 0.0)) return std::nullopt;
  const double edges =
      2.0 * hole_edge_diameters(job.options.shop) * clearance_hole(opening.bolt, HoleFit::coarse);
  return Reaches{*half, std::max(*lid, *half + edges / share)};
}

/// Bolts in the middle of the lid's lap, below and above the opening, each on one arc.
std::vector<Vec2> bolts_of(const StripJob& job, const SectionPlate& plate, const StripWindow& window,
                           std::vector<double> breaks) {
  const double hole = clearance_hole(window.bolt, HoleFit::coarse);
  breaks.insert(breaks.end(), {window.along.from, window.along.to});
  if (job.widens()) {
    const std::vector<double> pieces = job.pieces();
    breaks.insert(breaks.end(), pieces.begin(), pieces.end());
  }
  const Span heights = heights_of(job.section, plate);
  const OnOneArc arcs(job.track, 0.5 * hole, heights, breaks, job.rooms_at_bends(heights));
  const double out = 0.5 * (window.along.from - window.lid_along.from);
  const double up = 0.5 * (window.across.from - window.lid_across.from);
  const double edge = hole_edge_diameters(job.options.shop) * hole /
                      least_share(job, plate, window.lid_along, window.lid_across);
  const Span within{window.lid_along.from + edge, window.lid_along.to - edge};
  std::vector<double> places;
  for (const Vec2 at : evenly({window.along.from - out, 0.0}, {window.along.to + out, 0.0}, kPitch)) {
    const auto place = arcs.nearest(at.x, within);
    if (place && (places.empty() || *place - places.back() > 2.4 * hole)) places.push_back(*place);
  }
  std::vector<Vec2> bolts;
  for (const double y : {window.across.from - up, window.across.to + up}) {
    for (const double s : places) bolts.push_back({s, y});
  }
  return bolts;
}

/// A place for an opening, and what it takes there.
struct OpeningPlace {
  double at = 0.0;
  Reaches reaches;
};

/// The place nearest to one at which an opening in a bent side, and its lid, begin and end off its bends: those may go across it.
/// @param room  for the lid
std::optional<OpeningPlace> off_bends(const StripJob& job, const SectionPlate& plate, double across,
                                      const InspectionOptions& opening, const Span& room) {
  const Span heights = heights_of(job.section, plate);
  const OnOneArc ends(job.track, kOffJointOfOpening, heights, {}, job.rooms_at_bends(heights));
  constexpr double kStep = 0.5e-3;  // [m]
  const double most = 0.5 * opening.length + lid_lap(opening, job.options.shop);
  for (double off = 0.0; off <= most; off += kStep) {
    for (const double at : {opening.at - off, opening.at + off}) {
      const auto reaches = reaches_at(job, plate, across, opening, at);
      if (!reaches || at - reaches->lid < room.from || at + reaches->lid > room.to) continue;
      const bool clear = ends.has(at - reaches->opening) && ends.has(at + reaches->opening) &&
                         ends.has(at - reaches->lid) && ends.has(at + reaches->lid);
      if (clear) return OpeningPlace{at, *reaches};
    }
  }
  return std::nullopt;
}

/// The place nearest to one at which an opening lies on one arc of a rolled side, its lid where the width does not change.
/// @param room  for the lid
std::optional<OpeningPlace> on_one_arc(const StripJob& job, const SectionPlate& plate, double across,
                                       const InspectionOptions& opening, const Span& room) {
  std::optional<OpeningPlace> best;
  const auto is_nearer = [&](double at) {
    return !best || std::fabs(at - opening.at) < std::fabs(best->at - opening.at);
  };
  const auto look_on = [&](const Span& stretch) {
    // What it takes is that of an arc: the same all along it, but for lids that reach beyond.
    const double about = std::clamp(opening.at, stretch.from, stretch.to);
    auto reaches = reaches_at(job, plate, across, opening, about);
    constexpr int kMostTimes = 4;  // budget
    for (int time = 0; reaches && time < kMostTimes; ++time) {
      const OnOneArc arcs(job.track, reaches->opening + kOffJointOfOpening, heights_of(job.section, plate),
                          job.widens() ? job.pieces() : std::vector<double>());
      const auto at = arcs.nearest(opening.at, {stretch.from + reaches->lid, stretch.to - reaches->lid});
      if (!at) return;
      const auto there = reaches_at(job, plate, across, opening, *at);
      constexpr double kSame = 1e-9;  // rounding [m]
      const bool fits =
          there && there->opening <= reaches->opening + kSame && there->lid <= reaches->lid + kSame;
      if (fits && is_nearer(*at)) best = OpeningPlace{*at, *there};
      if (fits) return;
      reaches = there;
    }
  };
  const std::vector<Span> stretches = job.widens() ? even_stretches(job, room) : std::vector<Span>{room};
  for (const Span& even : stretches) {
    look_on(even);
    for (const StripArc& one : job.arcs_in(even)) look_on({one.arc.start, one.arc.start + one.arc.length});
  }
  return best;
}

StripWindow window_at(const Side& side, std::size_t unit, const InspectionOptions& opening,
                      const OpeningPlace& place, double lap) {
  const double middle = 0.5 * (side.room.from + side.room.to);
  StripWindow window;
  window.plate = side.plate;
  window.unit = unit;
  window.along = {place.at - place.reaches.opening, place.at + place.reaches.opening};
  window.across = {middle - 0.5 * opening.height, middle + 0.5 * opening.height};
  window.lid_along = {place.at - place.reaches.lid, place.at + place.reaches.lid};
  window.lid_across = {window.across.from - lap, window.across.to + lap};
  window.bolt = opening.bolt;
  window.asked = opening.at;
  return window;
}

/// The lid as a plate of the section, against the outside of the plate with the opening.
SectionPlate lid_plate(const PlateSection& section, const StripWindow& window) {
  const SectionPlate& plate = section.plates_of(window.unit)[window.plate];
  const Vec2 way = plate.way();
  const Vec2 back = section.thickness * Vec2{-way.y, way.x};
  // Of plates inside an outline the face is outside.
  const Vec2 off = section.inside_outline ? -1.0 * back : back;
  const Vec2 from = plate.face_from + window.lid_across.from * way + off;
  const Vec2 to = plate.face_from + window.lid_across.to * way + off;
  return {"lid", from, to, from + back, to + back};
}

/// Whether a lid lies before or behind both frames of its unit, at all of its heights: of a plate higher than the track's radius some of
/// it may stand over a frame.
bool clear_of_frames(const StripJob& job, const Span& unit, const StripWindow& window) {
  if (job.bent() || !job.options.flanges.wanted || !job.section.convex) return true;
  const double taken = job.options.flanges.along() + kAsideOfFrame;
  const SectionPlate lid = lid_plate(job.section, window);
  const auto is_clear = [&](double end, double sense, bool last) {
    const TrackFrame frame = frame_at(job.track, end);
    double least = std::numeric_limits<double>::infinity();
    double most = -least;
    for (const double place : {window.lid_along.from, window.lid_along.to}) {
      const TrackFrame here = frame_at(job.track, place);
      for (const Vec2 corner : {lid.face_from, lid.face_to, lid.back_from, lid.back_to}) {
        const double beyond = sense * dot(here.at + corner.y * here.up - frame.at, frame.along);
        least = std::min(least, beyond);
        most = std::max(most, beyond);
      }
    }
    // Behind the plane of a joint stands the frame of the next unit.
    return least >= job.options.flanges.along() || most <= (last ? 0.0 : -taken);
  };
  return is_clear(unit.from, 1.0, unit.from <= 0.0) && is_clear(unit.to, -1.0, unit.to >= job.track.length());
}

}  // namespace

std::optional<LidStretch> lid_stretch(const PlateSection& section, const PlateOptions& options) {
  if (options.inspection.empty()) return std::nullopt;
  const auto side = side_for_openings(section, options);
  if (!side) return std::nullopt;
  double half = 0.0;
  for (const InspectionOptions& opening : options.inspection)
    half = std::max(half, 0.5 * opening.height + lid_lap(opening, options.shop));
  const double middle = 0.5 * (side->room.from + side->room.to);
  return LidStretch{side->plate, {middle - half, middle + half}};
}

std::vector<StripWindow> windows_of(const StripJob& job, const Span& unit, std::size_t index,
                                    const std::vector<double>& breaks) {
  std::vector<StripWindow> windows;
  if (job.options.inspection.empty()) return windows;
  const Side side = *side_for_openings(job.section.of_unit(index), job.options);
  const SectionPlate& plate = job.section.plates_of(index)[side.plate];
  const Span room = room_of(job, unit, plate);
  OpeningIssues issues;
  for (const InspectionOptions& opening : job.options.inspection) {
    const double lap = lid_lap(opening, job.options.shop);
    const double reach = 0.5 * opening.length + lap;
    if (opening.at < unit.from || opening.at >= unit.to) continue;
    const double across = 0.5 * (side.room.from + side.room.to);
    const std::optional<OpeningPlace> place = job.bent() ? off_bends(job, plate, across, opening, room)
                                                         : on_one_arc(job, plate, across, opening, room);
    const std::string where = "at: an opening at " + length_text(job.on_track(opening.at), 4);
    if (!place) {
      issues.add(where + " finds no place in its unit",
                 "Units end at " + length_text(job.on_track(unit.from), 4) + " and " +
                     length_text(job.on_track(unit.to), 4) + "; it is " + length_text(opening.length) +
                     " long, its lid " + length_text(2.0 * reach) +
                     (job.bent()     ? ", and their ends lie off the bends of the "
                      : job.widens() ? ", and lies on one arc, and where the width does not change, of the "
                                     : ", and lies on one arc of the ") +
                     plate.name + ".",
                 "another at, or a smaller length");
      continue;
    }
    // It may not be moved out of reach of what it is there for.
    if (std::fabs(place->at - opening.at) > std::max(reach, place->reaches.lid)) {
      issues.add(where + " lies across a change of radius" +
                     (job.widens() ? ", where the width changes," : ",") + " or the end of a unit",
                 "Openings lie on one arc of the " + plate.name + ", " + length_text(opening.length) +
                     " long, with lids that lap over by " + length_text(lap) + ".",
                 "at: " + length_text(place->at, 4) + ", or a smaller length");
      continue;
    }
    windows.push_back(window_at(side, index, opening, *place, lap));
    if (!clear_of_frames(job, unit, windows.back())) {
      issues.add(where + " lies beside a frame",
                 "Where the track bends tighter than the " + plate.name +
                     " is high the frames of its unit reach over it.",
                 "another at, or a limit smallest_valley_radius above " +
                     length_text(std::max(plate.face_from.y, plate.face_to.y), 3));
      continue;
    }
    windows.back().bolts = bolts_of(job, plate, windows.back(), breaks);
  }
  issues.require_none();
  return windows;
}

namespace {

/// Where the second of two openings would be far enough from the first, on its side of it, or else on the other.
std::string place_apart(double first, double second, double least, const StripJob& job) {
  const double after = first + least;
  const double before = first - least;
  const auto on_track = [&](double at) { return at > 0.0 && at < job.track.length(); };
  const bool later = on_track(after) && (second >= first || !on_track(before));
  if (!later && !on_track(before)) return "one of them";
  // In whole millimetres, one more than they take: along flats places are not those on the track to the last.
  const double at =
      later ? std::ceil(1e3 * job.on_track(after)) + 1.0 : std::floor(1e3 * job.on_track(before)) - 1.0;
  return "at: " + length_text(1e-3 * at, 6) + ", or one of them";
}

}  // namespace

void require_openings_on_track(const StripJob& job) {
  const std::vector<InspectionOptions>& all = job.options.inspection;
  OpeningIssues issues;
  const auto is_on_track = [&](const InspectionOptions& one) {
    return one.at > 0.0 && one.at < job.track.length();
  };
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!is_on_track(all[i])) {
      issues.add("at: an opening at " + length_text(all[i].at, 4) + " is not on the track",
                 "It is " + length_text(job.on_track(job.track.length()), 4) + " long.",
                 "at: " + length_text(0.5 * job.track.length(), 2));
      continue;
    }
    for (std::size_t k = 0; k < i; ++k) {
      if (!is_on_track(all[k])) continue;
      // Either may be moved by as much as is allowed.
      const double apart = std::fabs(all[i].at - all[k].at);
      const double laps = lid_lap(all[i], job.options.shop) + lid_lap(all[k], job.options.shop);
      const double least = 2.0 * (0.5 * (all[i].length + all[k].length) + laps);
      if (apart >= least) continue;
      issues.add("at: openings at " + length_text(job.on_track(all[k].at), 4) + " and " +
                     length_text(job.on_track(all[i].at), 4) + " are too close",
                 "With room to find one arc each they take " + length_text(least) + ".",
                 place_apart(all[k].at, all[i].at, least, job));
      break;
    }
  }
  issues.require_none();
}

void add_strip_lids(const StripJob& job, const std::vector<StripWindow>& windows, Workshop& workshop) {
  for (const StripWindow& window : windows) {
    const SectionPlate lid = lid_plate(job.section, window);
    // Where the lid's face begins, along that of the plate.
    double begins = window.lid_across.from;
    if (job.widens()) {
      const double s = 0.5 * (window.along.from + window.along.to);
      const FaceAt plate = face_at(job, job.section.plates_of(window.unit)[window.plate], s);
      begins = dot(face_at(job, lid, s).from - plate.from, plate.way);
    }
    std::vector<Circle> holes;
    for (const Vec2 bolt : window.bolts)
      holes.push_back({{bolt.x, bolt.y - begins}, 0.5 * clearance_hole(window.bolt, HoleFit::coarse)});
    add_part(workshop,
             set_plate(job, lid, job.section.thickness, window.lid_along, job.options.material, holes),
             kFittingColour);
    add_bolts(workshop, window.bolt, 2.0 * job.section.thickness, holes.size(), "lids");
    const double at = 0.5 * (window.along.from + window.along.to);
    tell_moved_opening(job.on_track(window.asked), job.on_track(at),
                       job.bent()     ? "Its ends are off the bends of its plate, and clear of frames."
                       : job.widens() ? "With its lid it lies on one arc of its plate, clear of frames, "
                                        "where the width does not change."
                                      : "With its lid it lies on one arc of its plate, clear of frames.",
                       workshop);
  }
}

namespace {

std::vector<Issue> opening_problems_in(const PlateSection& section, const PlateOptions& options) {
  std::vector<Issue> issues;
  const auto add = [&](std::string what, std::string why, std::string hint) {
    issues.push_back({"inspection", "inspection: " + what, std::move(why), std::move(hint)});
  };
  if (section.widths && options.floor == FloorMake::bent) {
    add("sides of bent plates beside a width that changes have no openings",
        "They lean otherwise from flat to flat.", "floor: rolled, or one width");
    return issues;
  }
  const auto side = side_for_openings(section, options);
  if (!side) {
    add("no side on the left stands upright and bare",
        "It is cut into one that leans no more than 60 deg, and that no tiles cover.",
        "another cross_section, or no liner");
    return issues;
  }
  const double wide = side->room.to - side->room.from;
  for (Issue& issue : opening_value_problems(options)) issues.push_back(std::move(issue));
  for (const InspectionOptions& opening : options.inspection) {
    const double lap = lid_lap(opening, options.shop);
    const double most = wide - 2.0 * lap;
    if (opening.height <= most) continue;
    const std::string plate = section.plates[side->plate].name;
    issues.push_back({"inspection",
                      "height: " + length_text(opening.height) + " leaves too little of the " + plate + ", " +
                          length_text(wide, 3) + " wide",
                      "Its lid laps over by " + length_text(lap) + " all round.",
                      most >= kLeastOpening ? "height: " + length_text(1e-3 * std::floor(1e3 * most + 1e-6))
                      : section.departure > 0.0 ? "a larger stave_tolerance, or no inspection"
                                                : "no inspection, or higher sides"});
  }
  return issues;
}

}  // namespace

std::vector<Issue> strip_opening_problems(const PlateSection& section, const PlateOptions& options) {
  if (options.inspection.empty()) return {};
  std::vector<Issue> issues = opening_problems_in(section.of_unit(0), options);
  if (issues.empty() && !section.staggered.empty()) issues = opening_problems_in(section.of_unit(1), options);
  return issues;
}

}  // namespace glissade::parts
