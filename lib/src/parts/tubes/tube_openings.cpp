#include "parts/tubes/tube_openings.hpp"

#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"

#include "parts/bodies/bores.hpp"
#include "parts/plates/fittings.hpp"
#include "parts/plates/plate_unit.hpp"
#include "parts/shop/bolts.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

namespace glissade::parts {
namespace {

constexpr double kLeft = -0.5 * std::numbers::pi;     // about the axis, from upright
constexpr double kMostHalf = std::numbers::pi / 3.0;  // of a lid: off the seams, 20 deg from the crown
constexpr double kMostQuarter =
    80.0 / 180.0 * std::numbers::pi;     // of the round of a trough beside its lowest line
constexpr double kOffRim = 2e-3;         // of a lid [m]
constexpr double kOffMitre = 8e-3;       // of a lid: room for the weld [m]
constexpr double kPitch = 150e-3;        // of a lid's bolts [m]
constexpr double kMostHole = 1.0 / 3.0;  // of the tube's radius

double outer_of(const TubeGore& tube) {
  return tube.inner_radius + tube.thickness;
}

/// Half the angle of an opening, or of its lid.
double half_angle(const TubeGore& tube, double height) {
  return 0.5 * height / outer_of(tube);
}

/// What a rim takes of the round of a trough: an angle from where that begins.
double below_rim(double outer, double thickness, const TroughSide& trough) {
  const double taken = (trough.rim ? trough.rim->thickness : 0.0) - trough.height;
  // The lid's outer face is what would meet it.
  return std::max(0.0, taken + kOffRim) / (outer + thickness) + kOffRim / outer;
}

/// The angle about the axis at which the middles of openings of a height lie.
double middle_angle(const TubeGore& tube, double lid_height, const std::optional<TroughSide>& trough) {
  if (!trough) return kLeft;
  return kLeft - below_rim(outer_of(tube), tube.thickness, *trough) - half_angle(tube, lid_height);
}

/// Along the axis, where a lid may lie: off flanges, and off mitres at every angle that it covers.
Span lid_room(const TubeRoom& room, double lid_height, const std::optional<TroughSide>& trough) {
  const TubeGore& tube = *room.body;
  const double outer = outer_of(tube) + tube.thickness;
  const double middle = middle_angle(tube, lid_height, trough);
  const double half = half_angle(tube, lid_height);
  const double low = outer * math::cos(middle - half);  // upright from the axis
  const double high = outer * math::cos(middle + half);
  const auto past = [&](Angle tilt) {
    const double slope = math::tan(tilt.radians());
    return Span{std::min(low * slope, high * slope), std::max(low * slope, high * slope)};
  };
  const auto weld = [](Angle tilt) { return tilt.radians() == 0.0 ? 0.0 : kOffMitre; };
  return {std::max(room.from, past(tube.start_tilt).to + weld(tube.start_tilt)),
          std::min(room.to, tube.length + past(tube.end_tilt).from - weld(tube.end_tilt))};
}

/// A tube and where along its axis the middle of an opening may be.
struct Seat {
  std::size_t tube = 0;
  double along = 0.0;
  double about = 0.0;  ///< its angle about the axis
};

std::string word_of(const std::optional<TroughSide>& trough) {
  return trough ? "trough" : "tube";
}

std::optional<Seat> nearest_seat(const InspectionOptions& opening, const std::vector<TubeRoom>& tubes,
                                 const std::optional<TroughSide>& trough, const FlatPlaces& flats,
                                 double lap) {
  std::optional<Seat> best;
  double least = 0.0;
  const double reach = 0.5 * opening.length + lap;
  const double at = flats.flats_at(opening.at);
  for (std::size_t i = 0; i < tubes.size(); ++i) {
    const Span room = lid_room(tubes[i], opening.height + 2.0 * lap, trough);
    if (!(room.to - room.from >= 2.0 * reach)) continue;
    const double asked = at - tubes[i].begins;
    const double along = std::clamp(asked, room.from + reach, room.to - reach);
    if (best && std::fabs(along - asked) >= least) continue;
    least = std::fabs(along - asked);
    best = Seat{i, along, middle_angle(*tubes[i].body, opening.height + 2.0 * lap, trough)};
  }
  return best;
}

Issue too_long(const InspectionOptions& opening, const std::vector<TubeRoom>& tubes,
               const std::optional<TroughSide>& trough, double lap) {
  double longest = 0.0;
  for (const TubeRoom& tube : tubes) {
    const Span room = lid_room(tube, opening.height + 2.0 * lap, trough);
    longest = std::max(longest, room.to - room.from);
  }
  const double most = 1e-3 * std::floor(1e3 * (longest - 2.0 * lap));
  return {"inspection",
          "length: an opening of " + length_text(opening.length) + " fits no " + word_of(trough),
          "With its lid it is " + length_text(opening.length + 2.0 * lap) +
              " long; between mitres and flanges " + length_text(longest, 3) + " are left at most.",
          (most > 0.0 ? "length: " + length_text(most) + ", " : std::string()) + "longer " + word_of(trough) +
              "s (bend), or round: staves"};
}

TubeWindow window_about(const TubeGore& tube, Seat seat, double length, double height) {
  const double half = half_angle(tube, height);
  return {seat.along - 0.5 * length, seat.along + 0.5 * length, Angle::from_radians(seat.about - half),
          Angle::from_radians(seat.about + half)};
}

/// In the middle of the lid's lap, below and above the opening.
std::vector<TubeHole> bolts_round(const TubeGore& tube, const TubeWindow& window, double radius, double lap) {
  const double out = 0.5 * lap;
  std::vector<TubeHole> holes;
  for (const double angle :
       {window.low.radians() - out / outer_of(tube), window.high.radians() + out / outer_of(tube)}) {
    for (const Vec2 at : evenly({window.from - out, 0.0}, {window.to + out, 0.0}, kPitch))
      holes.push_back({at.x, Angle::from_radians(angle), radius});
  }
  return holes;
}

std::optional<Issue> too_close(const std::vector<TubeOpening>& cut) {
  const TubeOpening& last = cut.back();
  for (std::size_t i = 0; i + 1 < cut.size(); ++i) {
    if (cut[i].tube != last.tube || cut[i].lid.from >= last.lid.to || last.lid.from >= cut[i].lid.to)
      continue;
    return Issue{"inspection",
                 "at: openings at " + length_text(cut[i].asked, 4) + " and " + length_text(last.asked, 4) +
                     " are too close",
                 "Each lies with its lid in one tube, and the nearest one is the same.", "one of them"};
  }
  return std::nullopt;
}

}  // namespace

std::vector<TubeOpening> cut_tubes(const std::vector<InspectionOptions>& openings,
                                   const std::vector<TubeRoom>& tubes,
                                   const std::optional<TroughSide>& trough, const FlatPlaces& flats,
                                   const ShopLeast& shop) {
  std::vector<TubeOpening> cut;
  std::vector<Issue> issues;  // of each opening the first
  for (const InspectionOptions& opening : openings) {
    const double lap = lid_lap(opening, shop);
    const auto seat = nearest_seat(opening, tubes, trough, flats, lap);
    if (!seat) {
      issues.push_back(too_long(opening, tubes, trough, lap));
      continue;
    }
    const TubeRoom& room = tubes[seat->tube];
    const double at = flats.track_at(room.begins + seat->along);
    // It may not be moved out of reach of what it is there for.
    if (std::fabs(at - opening.at) > 0.5 * opening.length + lap) {
      issues.push_back(
          {"inspection",
           "at: an opening at " + length_text(opening.at, 4) + " lies across a mitre or a flange",
           "Openings lie in one " + word_of(trough) + ", " + length_text(opening.length) +
               " long, with lids that lap over by " + length_text(lap) + ".",
           "at: " + length_text(at, 4) + ", or a smaller length"});
      continue;
    }
    TubeGore& tube = *room.body;
    TubeOpening made;
    made.tube = seat->tube;
    made.bolt = opening.bolt;
    made.at = at;
    made.asked = opening.at;
    const TubeWindow window = window_about(tube, *seat, opening.length, opening.height);
    made.lid = window_about(tube, *seat, opening.length + 2.0 * lap, opening.height + 2.0 * lap);
    made.bolts = bolts_round(tube, window, 0.5 * clearance_hole(opening.bolt, HoleFit::coarse), lap);
    cut.push_back(made);
    if (auto issue = too_close(cut)) {
      issues.push_back(*std::move(issue));
      cut.pop_back();
      continue;
    }
    tube.windows.push_back(window);
    const double drilled = 0.5 * clearance_hole(opening.bolt, HoleFit::medium);
    for (const TubeHole& hole : bolts_round(tube, window, drilled, lap)) tube.holes.push_back(hole);
  }
  if (!issues.empty()) throw InputError(std::move(issues));
  return cut;
}

ShopPart tube_lid(const TubeOpening& opening, const TubeGore& tube, const StockMaterial& material) {
  const double radius = outer_of(tube);
  const double thickness = tube.thickness;
  const double low = opening.lid.low.radians();
  const double turn = opening.lid.high.radians() - low;
  const double length = opening.lid.to - opening.lid.from;
  const auto at = [&](double angle) {
    const auto [sine, cosine] = math::sine_cosine(angle);
    return Vec2{radius * cosine, radius * sine};
  };
  RolledSheet sheet;
  // On the tube: what is below its upper face lies outside.
  sheet.path = {{{at(low), bulge_of_sweep(turn)}, {at(low + turn), 0.0}}, false};
  sheet.thickness = thickness;
  sheet.region.outline = rectangle({}, {radius * turn, length});
  FlatPattern pattern;
  const double mean = radius + 0.5 * thickness;
  pattern.region.outline = rectangle({}, {mean * turn, length});
  for (const TubeHole& bolt : opening.bolts) {
    const double angle = bolt.about.radians() - low;
    const double along = bolt.along - opening.lid.from;
    sheet.region.holes.push_back({{radius * angle, along}, bolt.radius});
    pattern.region.holes.push_back({{mean * angle, along}, bolt.radius});
  }
  pattern.rolls.push_back({{0.0, 0.0}, {0.0, length}, radius});
  ShopPart part;
  part.name = "lid";
  part.material = material.name;
  part.density = material.density;
  part.thickness = thickness;
  part.body = std::move(sheet);
  part.pattern = std::move(pattern);
  return part;
}

std::vector<Issue> tube_opening_problems(const section::Pipe& pipe, std::optional<double> side,
                                         const PlateOptions& options) {
  std::vector<Issue> issues;
  if (options.inspection.empty()) return issues;
  issues = opening_value_problems(options);
  if (!issues.empty()) return issues;
  const double radius = 0.5 * pipe.inner_diameter;
  const double outer = radius + pipe.thickness;
  // Of a trough from its rim down to beside its lowest line.
  const double angle =
      side ? kMostQuarter - below_rim(outer, pipe.thickness, {*side, options.rim}) : 2.0 * kMostHalf;
  for (const InspectionOptions& opening : options.inspection) {
    const double lap = lid_lap(opening, options.shop);
    const double most = 1e-3 * std::floor(1e3 * (angle * outer - 2.0 * lap));
    if (opening.height > most) {
      issues.push_back({"inspection",
                        "height: " + length_text(opening.height) + " leaves too little of a " +
                            (side ? "trough" : "tube") + " of " + length_text(2.0 * outer),
                        "Along its outside, with a lid that laps over by " + length_text(lap) +
                            (side ? ", it lies beside the lowest line, below the rim."
                                  : ", it covers a third of it at most, off the seams."),
                        most > 0.0 ? "height: " + length_text(most) : "no inspection, or a larger pipe"});
    }
    const double hole = 0.5 * clearance_hole(opening.bolt, HoleFit::coarse);
    if (hole > kMostHole * radius) {
      issues.push_back({"inspection",
                        "bolt: M" + std::to_string(opening.bolt) + " is too large for a " +
                            (side ? "trough" : "tube") + " of " + length_text(2.0 * outer),
                        "Its holes are more than a third of it wide.", "a smaller bolt"});
    }
  }
  return issues;
}

double openings_volume(const std::vector<TubeRoom>& tubes) {
  double volume = 0.0;
  for (const TubeRoom& room : tubes) {
    const TubeGore& tube = *room.body;
    const double mean = tube.inner_radius + 0.5 * tube.thickness;
    for (const TubeWindow& window : tube.windows) {
      volume -=
          mean * (window.high.radians() - window.low.radians()) * (window.to - window.from) * tube.thickness;
    }
    for (const TubeHole& hole : tube.holes)
      volume -= drilled_volume(hole.radius, tube.thickness, tube.inner_radius);
  }
  return volume;
}

}  // namespace glissade::parts
