#include "parts/plates/seams.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/number_text.hpp"

#include "parts/bodies/body_moments.hpp"
#include "parts/plates/plate_joints.hpp"
#include "parts/plates/plate_unit.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>

namespace glissade::parts {
namespace {

constexpr double kStep = 1e-3;         // in which seams move off what is taken [m]
constexpr double kMostStagger = 0.25;  // of a strip
constexpr double kLeastApart = 50e-3;  // seams of units that are welded end to end [m]
constexpr double kApartShare = 0.125;  // of a strip, that is
constexpr int kMoreStrips = 10;        // than an even division asks for
constexpr double kTouch = 1e-9;        // [m]

/// The place nearest to one that lies in nothing that is taken.
std::optional<double> free_place(double about, double room, const std::vector<Span>& taken) {
  const auto is_free = [&](double place) {
    return std::none_of(taken.begin(), taken.end(),
                        [&](const Span& span) { return place > span.from && place < span.to; });
  };
  for (double off = 0.0; off <= room; off += kStep) {
    if (is_free(about - off)) return about - off;
    if (is_free(about + off)) return about + off;
  }
  return std::nullopt;
}

/// Even places, each moved off what is taken; none where one of them cannot be.
std::optional<std::vector<double>> even_seams(const Span& across, std::size_t strips,
                                              const std::vector<Span>& taken, double stagger) {
  const double step = (across.to - across.from) / static_cast<double>(strips);
  const double aside = std::clamp(stagger, -kMostStagger * step, kMostStagger * step);
  std::vector<double> seams;
  for (std::size_t k = 1; k < strips; ++k) {
    const auto place = free_place(across.from + static_cast<double>(k) * step + aside, 0.4 * step, taken);
    const double before = seams.empty() ? across.from : seams.back();
    if (!place || !(*place > before && *place < across.to)) return std::nullopt;
    seams.push_back(*place);
  }
  return seams;
}

double widest_of(const std::vector<Span>& strips) {
  double widest = 0.0;
  for (const Span& strip : strips) widest = std::max(widest, strip.to - strip.from);
  return widest;
}

}  // namespace

double widest_strip(double width, bool straight, const SplitOptions& split) {
  if (!split.allowed) return std::numeric_limits<double>::infinity();
  const double share = straight ? 1.0 : kCurvedOfSheet;
  const auto [longer, shorter] = split.stock().room();
  double most = std::numeric_limits<double>::infinity();
  if (width > share * longer + kTouch) most = share * shorter;
  return std::min(most, split.widest.value_or(most));
}

namespace {

/// The seams of one unit; none where no even division keeps off what is taken.
/// @param stagger  by which they lie off even places, at most a quarter of a strip [m]
/// @param least    so many strips at least
std::optional<std::vector<double>> seams_of_unit(const Span& across, double most,
                                                 const std::vector<Span>& taken, double stagger,
                                                 std::size_t least) {
  const double width = across.to - across.from;
  if (!(width > most + kTouch)) return std::vector<double>();
  // Also of a sheet that has no room at all.
  const double even = most > 0.0 ? std::max(std::ceil(width / most - 1e-9), static_cast<double>(least)) : 0.0;
  for (int more = 0; even > 1.0 && even < 1e3 && more <= kMoreStrips; ++more) {
    auto seams =
        even_seams(across, static_cast<std::size_t>(even) + static_cast<std::size_t>(more), taken, stagger);
    if (seams && widest_of(strips_between_seams(across, *seams)) <= most + kTouch) return seams;
  }
  return std::nullopt;
}

std::optional<Seams> seams_within(const Span& across, double most, const std::vector<Span>& taken,
                                  bool welded) {
  if (!welded) {
    const auto seams = seams_of_unit(across, most, taken, 0.0, 1);
    if (!seams) return std::nullopt;
    return Seams{*seams, *seams};
  }
  std::size_t least = 1;
  while (true) {
    const auto even = seams_of_unit(across, most, taken, kSeamStagger, least);
    if (!even) return std::nullopt;
    const double strip = (across.to - across.from) / static_cast<double>(even->size() + 1);
    const double apart = std::min(kLeastApart, kApartShare * strip);
    std::vector<Span> both = taken;
    for (const double seam : *even) both.push_back({seam - apart, seam + apart});
    const auto odd = seams_of_unit(across, most, both, -kSeamStagger, least);
    if (!odd) return std::nullopt;
    if (odd->size() == even->size()) return Seams{*even, *odd};
    least = std::max(odd->size(), even->size()) + 1;
  }
}

}  // namespace

Seams seams_across(const std::string& plate, const Span& across, bool straight,
                   const std::vector<Span>& taken, const SplitOptions& split, bool welded) {
  const double width = across.to - across.from;
  const double most = widest_strip(width, straight, split);
  if (auto seams = seams_within(across, most, taken, welded)) return *std::move(seams);
  std::string hint = split.widest ? "a larger widest" : "a larger sheet";
  SplitOptions wider = split;
  constexpr double kTried = 10e-3;  // taste: in which wider strips are tried [m]
  for (double tried = std::ceil(most / kTried + 1e-9); split.widest && kTried * tried < width + kTried;
       tried += 1.0) {
    wider.widest = kTried * tried;
    const double room = widest_strip(width, straight, wider);
    // The sheet bounds them from there on.
    if (room < *wider.widest) break;
    if (!seams_within(across, room, taken, welded)) continue;
    hint = "widest: " + length_text(*wider.widest);
    break;
  }
  throw InputError({split.widest ? "split.widest" : "split.sheet",
                    "the " + plate + ", " + length_text(width, 4) +
                        " wide, leaves no place for seams that make strips of " + length_text(most, 4) +
                        " or less",
                    "Seams keep off laps, slots, openings and holes.", std::move(hint)});
}

std::vector<Span> strips_between_seams(const Span& across, const std::vector<double>& seams) {
  std::vector<Span> strips;
  double from = across.from;
  for (const double seam : seams) {
    strips.push_back({from, seam});
    from = seam;
  }
  strips.push_back({from, across.to});
  return strips;
}

std::string strip_letter(std::size_t strip, std::size_t strips) {
  if (strips < 2) return "";
  std::string letters;
  for (std::size_t left = strip + 1; left > 0; left = (left - 1) / 26)
    letters.insert(letters.begin(), static_cast<char>('a' + (left - 1) % 26));
  return "_" + letters;
}

ArcPath part_beyond(const ArcPath& outline, Vec2 normal, double from) {
  ArcPath part;
  part.closed = true;
  const std::size_t count = outline.vertices.size();
  for (std::size_t i = 0; i < count; ++i) {
    const Vec2 a = outline.vertices[i].at;
    const Vec2 b = outline.vertices[(i + 1) % count].at;
    const double at_a = dot(a, normal) - from;
    const double at_b = dot(b, normal) - from;
    if (at_a >= 0.0) part.vertices.push_back({a, 0.0});
    if (!((at_a > 0.0 && at_b < 0.0) || (at_a < 0.0 && at_b > 0.0))) continue;
    const Vec2 met = a + at_a / (at_a - at_b) * (b - a);
    // To the last bit on the line: the part beyond it has the same corner.
    part.vertices.push_back({met + (from - dot(met, normal)) * normal, 0.0});
  }
  return part;
}

void note_seams(double length, Workshop& workshop) {
  if (!(length > 0.0)) return;
  workshop.notes.push_back(
      "Plates wider than a strip may be are strips side by side, welded edge to edge along the track: " +
      length_text(length, 4) + " of seam in all.");
}

}  // namespace glissade::parts
