#include "parts/strips/section_seams.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/number_text.hpp"

#include "parts/plates/liner_tiles.hpp"
#include "parts/plates/seams.hpp"
#include "parts/shop/bolts.hpp"
#include "parts/strips/strip_fittings.hpp"
#include "parts/strips/strip_openings.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace glissade::parts {
namespace {

constexpr double kOffCorner = 3.0;  // thicknesses from a corner, its slots and its bevel to a seam
constexpr double kOffHole = 1.5;    // diameters from the middle of a hole to a seam

/// A plate along its face, from `face_from`: between the ends of its middle line.
Span across_of(const SectionPlate& plate) {
  return {dot(plate.middle_from() - plate.face_from, plate.way()),
          dot(plate.middle_to() - plate.face_from, plate.way())};
}

bool is_level(const SectionPlate& plate) {
  return std::fabs(plate.way().y) < 1e-9;
}

/// Whether units are welded end to end, without frames.
bool is_welded(const PlateSection& section, const PlateOptions& options) {
  return !options.flanges.wanted || !section.convex;
}

/// Seams of a plate of one width.
/// @param lid  that they keep off, if it lies on that plate
Seams even_seams(const PlateSection& section, std::size_t index, const PlateOptions& options,
                 const std::optional<LidStretch>& lid) {
  const SectionPlate& plate = section.plates[index];
  Span across = across_of(plate);
  const double off = kOffCorner * section.thickness + options.corners.clearance;
  std::vector<Span> taken = {{across.from - off, across.from + off}, {across.to - off, across.to + off}};
  if (options.corners.kind != CornerJoint::butt) {
    // A plate that passes others reaches beyond them.
    const double lap = options.corners.overlap + 2.0 * section.thickness;
    across = {across.from - lap, across.to + lap};
    taken.push_back({across.from, across.from + lap});
    taken.push_back({across.to - lap, across.to});
  }
  if (lid && lid->plate == index) taken.push_back(lid->across);
  for (const LinedFace& face : section.lined) {
    if (face.plate != index) continue;
    const Lane lane = lane_of(section, face);
    const double from = lane.low - dot(plate.face_from - face.from, plate.way());
    const double room = kOffHole * clearance_hole(options.liner->bolt, HoleFit::coarse);
    for (const double y : bolts_across(options, lane.width))
      taken.push_back({from + y - room, from + y + room});
  }
  return seams_across(plate.name, across, is_level(plate), taken, options.split, is_welded(section, options));
}

/// A floor that widens, in strips: an odd number, those beside the middle one all as wide.
struct WideningFloor {
  Span across;  ///< where it is narrowest
  double widest = 0.0;
  double most = 0.0;   ///< of a strip
  double least = 0.0;  ///< of the middle one

  [[nodiscard]] double side(double count) const { return widest / count; }
  [[nodiscard]] bool takes(double count) const {
    return across.to - across.from - (count - 1.0) * side(count) >= least;
  }
  /// @return by how much seams may lie aside: the strip at one end is as much wider, the one at the other end narrower
  [[nodiscard]] double aside(double count) const {
    return std::min({kSeamStagger, 0.25 * side(count), most - side(count)});
  }
  [[nodiscard]] std::vector<double> seams(double count, double aside) const {
    std::vector<double> seams;
    const auto sides = static_cast<int>(count) / 2;
    for (int k = 1; k <= sides; ++k) seams.push_back(across.from + k * side(count) + aside);
    for (int k = sides; k >= 1; --k) seams.push_back(across.to - k * side(count) + aside);
    return seams;
  }
};

/// Seams of a floor on both sides of whose middle the width changes: an odd number of strips, the middle one as wide as is left.
Seams seams_of_widening(const PlateSection& section, const SectionPlate& plate, const SplitOptions& split,
                        bool welded) {
  WideningFloor floor;
  floor.across = across_of(plate);
  const double narrowest = floor.across.to - floor.across.from;
  floor.widest = narrowest + section.widths->widest() - section.widths->narrowest();
  floor.most = widest_strip(floor.widest, false, split);
  floor.least = 2.0 * kOffCorner * section.thickness;
  if (!(floor.widest > floor.most)) return {};
  double count = std::ceil(floor.widest / floor.most - 1e-9);
  if (std::fmod(count, 2.0) == 0.0) count += 1.0;
  if (!floor.takes(count)) {
    throw InputError({"cross_section.width",
                      "the " + plate.name + " goes from " + length_text(narrowest, 4) + " to " +
                          length_text(floor.widest, 4) + ": strips of " + length_text(floor.most, 4) +
                          " leave nothing of the one in the middle",
                      "That one takes the change of width; those beside it are as wide everywhere.",
                      "a smaller change of width, or larger strips (split.widest, split.sheet)"});
  }
  if (!welded) return {floor.seams(count, 0.0), floor.seams(count, 0.0)};
  // Pairs of strips more, as far as they make room to lie aside.
  constexpr int kMore = 3;
  double best = count;
  for (int more = 1; more <= kMore; ++more) {
    const double strips = count + 2.0 * more;
    if (floor.aside(best) >= std::min(kSeamStagger, 0.25 * floor.side(best)) || !floor.takes(strips)) break;
    if (floor.aside(strips) > floor.aside(best)) best = strips;
  }
  const double aside = floor.aside(best);
  return {floor.seams(best, aside), floor.seams(best, -aside)};
}

Seams seams_of(const PlateSection& section, std::size_t index, const PlateOptions& options,
               const std::optional<LidStretch>& lid) {
  const SectionPlate& plate = section.plates[index];
  const bool both_sides = plate.face_from.x * plate.face_to.x < 0.0;
  const bool welded = is_welded(section, options);
  if (section.widths && both_sides) return seams_of_widening(section, plate, options.split, welded);
  return even_seams(section, index, options, lid);
}

/// The plate between seams, whose edges there are square.
std::vector<SectionPlate> cut(const SectionPlate& plate, double thickness, const std::vector<double>& seams) {
  const Vec2 back = thickness * Vec2{-plate.way().y, plate.way().x};
  std::vector<SectionPlate> strips;
  SectionPlate rest = plate;
  for (const double seam : seams) {
    SectionPlate strip = rest;
    strip.name = plate.name + strip_letter(strips.size(), seams.size() + 1);
    strip.face_to = plate.face_from + seam * plate.way();
    strip.back_to = strip.face_to + back;
    rest.face_from = strip.face_to;
    rest.back_from = strip.back_to;
    strips.push_back(std::move(strip));
  }
  rest.name = plate.name + strip_letter(strips.size(), seams.size() + 1);
  strips.push_back(std::move(rest));
  return strips;
}

PlateSection seamed(const PlateSection& whole, const PlateOptions& options,
                    const std::optional<LidStretch>& lid) {
  PlateSection result = whole;
  result.plates.clear();
  std::vector<SectionPlate> odd;
  for (std::size_t i = 0; i < whole.plates.size(); ++i) {
    const Seams both = seams_of(whole, i, options, lid);
    const std::vector<double>& seams = both.even;
    const std::size_t first = result.plates.size();
    for (std::size_t k = 0; k < whole.lined.size(); ++k) {
      if (whole.lined[k].plate != i) continue;
      if (whole.widths && !seams.empty()) {
        throw InputError({"liner",
                          "liner: the " + whole.plates[i].name + " is up to " +
                              length_text(norm(whole.plates[i].face_to - whole.plates[i].face_from) +
                                              whole.widths->widest() - whole.widths->narrowest(),
                                          4) +
                              " wide, wider than one strip may be",
                          "Where the width changes its seams would run through holes of the tiles.",
                          "a larger split.sheet or split.widest, or no liner"});
      }
      result.lined[k].plate = first;
      result.lined[k].strips = seams.size() + 1;
    }
    if (seams.empty()) {
      result.plates.push_back(whole.plates[i]);
      odd.push_back(whole.plates[i]);
      continue;
    }
    for (SectionPlate& strip : cut(whole.plates[i], whole.thickness, seams)) {
      if (result.plates.size() > first) result.seams.push_back(result.plates.size());
      result.plates.push_back(std::move(strip));
    }
    for (SectionPlate& strip : cut(whole.plates[i], whole.thickness, both.odd))
      odd.push_back(std::move(strip));
  }
  if (is_welded(whole, options) && !result.seams.empty()) result.staggered = std::move(odd);
  return result;
}

}  // namespace

PlateSection with_seams(const PlateSection& section, const PlateOptions& options) {
  PlateSection even = seamed(section, options, std::nullopt);
  // An opening and its lid lie in the widest strip. Where none holds them the seams go beside the lid.
  if (!strip_opening_problems(section, options).empty() || strip_opening_problems(even, options).empty())
    return even;
  PlateSection beside = seamed(section, options, lid_stretch(section, options));
  if (auto issues = strip_opening_problems(beside, options); !issues.empty())
    throw InputError(std::move(issues));
  return beside;
}

}  // namespace glissade::parts
