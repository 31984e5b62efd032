// Sections whose sides lean or are round, in timber: each side in flat strips along the track, in layers, in templates across it.

#include "parts/timber/timber_trough.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"

#include "parts/bodies/body_moments.hpp"
#include "parts/plates/plate_joints.hpp"
#include "parts/plates/plate_unit.hpp"
#include "parts/shop/workshop_list.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>
#include <variant>

namespace glissade::parts {
namespace {

constexpr double kRoomForCurve =
    0.85;  // of a sheet's or board's width that a strip takes; the rest is for its curve
constexpr double kNarrowestStave = 8e-3;  // [m]
constexpr double kLeastRow = 0.3;         // of a lining, along the track [m]

double stock_width(const TimberOptions& options) {
  if (options.deck.boards) return options.deck.boards->width;
  return options.split.sawn().room().y;
}

double stock_length(const TimberOptions& options) {
  if (options.deck.boards) return options.deck.boards->length;
  return options.split.sawn().room().x;
}

/// What a side of the section is cut into across: its edges on the face and on the back.
struct SideCut {
  Vec2 face;
  Vec2 back;
};

/// A side cut into so many strips. Edges between them are square to it; those at its ends are its own.
std::vector<SectionPlate> cut_across(const SectionPlate& side, double thickness, int count, double gap) {
  const Vec2 run = side.face_to - side.face_from;
  const double width = norm(run);
  const Vec2 along = (1.0 / width) * run;
  Vec2 out{-along.y, along.x};
  if (dot(side.back_from - side.face_from, out) < 0.0) out = -1.0 * out;
  const double pitch = (width + gap) / count;
  std::vector<SectionPlate> strips;
  for (int k = 0; k < count; ++k) {
    const auto inner = [&](double at) {
      const Vec2 face = side.face_from + at * along;
      return SideCut{face, face + thickness * out};
    };
    const SideCut from = k == 0 ? SideCut{side.face_from, side.back_from} : inner(pitch * k);
    const SideCut to = k + 1 == count ? SideCut{side.face_to, side.back_to} : inner(pitch * (k + 1) - gap);
    strips.push_back({side.name, from.face, to.face, from.back, to.back});
  }
  return strips;
}

/// As few strips of a side as are no wider than the widest, on the face or on the back, which its mitres make wider; where mitres alone
/// are too much for that, as few as their faces ask for.
std::vector<SectionPlate> strips_across(const SectionPlate& side, double thickness, double widest,
                                        double gap) {
  const double face = norm(side.face_to - side.face_from);
  const int least = std::max(1, static_cast<int>(std::ceil((face + gap) / (widest + gap) - 1e-9)));
  const auto fits = [&](const SectionPlate& strip) {
    return norm(strip.back_to - strip.back_from) <= widest * (1.0 + 1e-9);
  };
  for (int count = least; (face + gap) / count - gap >= kNarrowestStave; ++count) {
    std::vector<SectionPlate> strips = cut_across(side, thickness, count, gap);
    if (std::all_of(strips.begin(), strips.end(), fits)) return strips;
  }
  return cut_across(side, thickness, least, gap);
}

/// A layer of a strip, between two shares of its thickness.
SectionPlate layer_of(const SectionPlate& strip, double upper, double lower) {
  const auto at = [](Vec2 face, Vec2 back, double share) { return face + share * (back - face); };
  return {strip.name, at(strip.face_from, strip.back_from, upper), at(strip.face_to, strip.back_to, upper),
          at(strip.face_from, strip.back_from, lower), at(strip.face_to, strip.back_to, lower)};
}

bool carries(const SectionPlate& strip) {
  return strip.face_from.x >= 0.0 && strip.face_to.x <= 0.0 && strip.face_from.x > strip.face_to.x;
}

/// The strip that a body slides on: of two beside the middle, the right one.
std::size_t middle_of(const std::vector<SectionPlate>& strips) {
  std::size_t best = 0;
  for (std::size_t i = 0; i < strips.size(); ++i) {
    if (carries(strips[i])) return i;
    const auto away = [&](std::size_t k) {
      return std::fabs(strips[k].face_from.x + strips[k].face_to.x) + strips[k].face_from.y +
             strips[k].face_to.y;
    };
    if (away(i) <= away(best)) best = i;
  }
  return best;
}

/// All strips of a layer from the left rim to the right one.
std::vector<SectionPlate> strips_round(const TimberChannel& channel, const TimberOptions& options) {
  const double gap = options.deck.boards ? options.deck.boards->gap : 0.0;
  std::vector<SectionPlate> strips;
  for (const SectionPlate& side : channel.trough->section.plates) {
    std::vector<SectionPlate> made =
        strips_across(side, channel.thickness, kRoomForCurve * stock_width(options), gap);
    for (std::size_t k = 0; k < made.size(); ++k) {
      if (made.size() > 1) made[k].name += "_strip_" + std::to_string(k + 1);
      strips.push_back(std::move(made[k]));
    }
  }
  return strips;
}

ArcPath outline_of(const std::vector<Vec2>& corners) {
  ArcPath outline;
  outline.closed = true;
  for (const Vec2 corner : corners) outline.vertices.push_back({corner, 0.0});
  return signed_area(outline) < 0.0 ? reversed(outline) : outline;
}

/// Area and first moment about the floor line.
struct Section {
  double area = 0.0;
  double first = 0.0;

  [[nodiscard]] double along(const ArcSpline& track, const Span& span) const {
    const double turned = track.direction(span.from).slope_angle - track.direction(span.to).slope_angle;
    return area * (span.to - span.from) - first * turned;
  }
};

Section section_of(const std::vector<Vec2>& corners) {
  const AreaMoments all = glissade::moments(PlaneRegion{outline_of(corners), {}, {}});
  return {all.area, all.area * all.centroid.y};
}

Section section_of(const SectionPlate& plate) {
  return section_of({plate.face_from, plate.face_to, plate.back_to, plate.back_from});
}

/// The part of a chain from rim to rim that lies below a height.
std::vector<Vec2> below(const std::vector<Vec2>& chain, double height) {
  std::vector<Vec2> kept;
  for (std::size_t i = 0; i < chain.size(); ++i) {
    if (i > 0 && (chain[i - 1].y > height) != (chain[i].y > height)) {
      const Vec2 run = chain[i] - chain[i - 1];
      kept.push_back(chain[i - 1] + ((height - chain[i - 1].y) / run.y) * run);
    }
    if (chain[i].y <= height) kept.push_back(chain[i]);
  }
  return kept;
}

/// A strip where the track is straight: its section moved along, so that strips that a turn about the track brings together
/// are seen to be equal.
Prism straight_body(const SectionPlate& plate, double length) {
  return {{outline_of({plate.face_from, plate.face_to, plate.back_to, plate.back_from}), {}, {}}, length};
}

}  // namespace

std::optional<TimberChannel> timber_channel_of(const section::Measures& measures,
                                               const TimberOptions& options) {
  if (const auto width = section::width_law(measures); width && !width->is_constant()) return std::nullopt;
  if (const auto* const channel = std::get_if<section::UChannel>(&measures)) {
    return TimberChannel{
        channel->width.narrowest(), channel->thickness, channel->wall_height, channel->thickness, {}};
  }
  if (const auto* const slab = std::get_if<section::Slab>(&measures))
    return TimberChannel{slab->width.narrowest(), slab->thickness, slab->curb_height, slab->curb_width, {}};
  PlateOptions plates;
  plates.stave_tolerance = options.deck.stave_tolerance;
  std::optional<PlateSection> section = plate_section(measures, plates);
  // Sides that meet in mitres from rim to rim, open above: templates hold them from below.
  const bool stands_in_templates =
      section && section->mitred && !section->closed && section->plates.size() > 2;
  if (!stands_in_templates) return std::nullopt;
  TimberTrough trough{std::move(*section), {}};
  const double rim = trough.section.outside.front().y;
  trough.seat = below(trough.section.outside, std::min(rim, options.cross_members.reach.value_or(rim)));
  double outer = 0.0;
  for (const Vec2 corner : trough.seat) outer = std::max(outer, std::fabs(corner.x));
  TimberChannel channel{2.0 * (outer + options.cross_members.cheek), trough.section.thickness, 0.0, 0.0, {}};
  channel.trough = std::move(trough);
  return channel;
}

std::vector<LiningStrip> lining_strips(const TimberJob& job) {
  const std::vector<SectionPlate> round = strips_round(job.channel, job.options);
  const std::size_t middle = middle_of(round);
  const auto layers = static_cast<std::size_t>(job.options.deck.layers);
  std::vector<LiningStrip> strips;
  for (std::size_t layer = 0; layer < layers; ++layer) {
    const auto share = [&](std::size_t k) { return static_cast<double>(k) / static_cast<double>(layers); };
    for (std::size_t i = 0; i < round.size(); ++i) {
      LiningStrip strip{layer_of(round[i], share(layer), share(layer + 1)), round[i].name,
                        2 * layer + (i + middle) % 2};
      if (layers > 1) strip.name += "_layer_" + std::to_string(layer + 1);
      strips.push_back(std::move(strip));
    }
  }
  return strips;
}

std::vector<Issue> lining_problems(const TimberChannel& channel, const TimberOptions& options) {
  std::vector<Issue> issues;
  const PlateSection& section = channel.trough->section;
  if (section.departure > 0.0) {
    // Staves of a round are all of one width but for those at its ends.
    const SectionPlate& stave = section.plates[section.plates.size() / 2];
    const double width = norm(stave.face_to - stave.face_from);
    if (width < kNarrowestStave) {
      const double grown = kNarrowestStave / width;
      return {
          {"deck.stave_tolerance",
           "stave_tolerance: " + length_text(options.deck.stave_tolerance) + " takes staves of " +
               length_text(width, 2) + " width",
           "Staves are at least " + length_text(kNarrowestStave) + " wide; they miss the round by w^2/(8 r).",
           "stave_tolerance: " + length_text(1.1 * grown * grown * section.departure, 2)}};
    }
  }
  for (const SectionPlate& strip : strips_round(channel, options)) {
    const Vec2 along = strip.face_to - strip.face_from;
    if (dot(strip.back_to - strip.back_from, along) > 0.0 && dot(along, along) > 0.0) continue;
    issues.push_back({"cross_section.thickness",
                      "thickness: " + length_text(channel.thickness) + " leaves nothing of the " +
                          strip.name + ", which is " + length_text(norm(along), 3) + " wide",
                      "Strips meet in mitres there.", "a thinner section, or a larger deck.stave_tolerance"});
    break;
  }
  const PlaneBox box = bounds(template_region(channel, options).outline);
  const double longer = std::max(box.width(), box.height());
  const double shorter = std::min(box.width(), box.height());
  const Vec2 sheet = options.split.sheet;
  const auto [long_side, short_side] = options.split.sawn().room();
  if (longer <= long_side && shorter <= short_side) return issues;
  // Templates that are cut off lower down fit where only their height is too much.
  const double over = box.height() - (box.width() <= short_side ? long_side : short_side);
  const double reach = std::floor((channel.trough->seat.front().y - over) * 1e3) * 1e-3;
  const double edges = 2.0 * options.split.sawn().margin;
  const bool lower_do = box.width() <= long_side && reach > 0.0;
  issues.push_back({"split.sheet",
                    "sheet: templates of " + length_text(box.width(), 4) + " x " +
                        length_text(box.height(), 4) + " fit no sheet of " + length_text(sheet.x) + " x " +
                        length_text(sheet.y),
                    "Each is cut in one piece, " + length_text(options.split.sawn().margin) +
                        " from the edges; it reaches up to the rim, or to cross_members.reach.",
                    "a sheet of at least " + length_text(std::ceil((longer + edges) * 1e3 - 1e-6) * 1e-3) +
                        " x " + length_text(std::ceil((shorter + edges) * 1e3 - 1e-6) * 1e-3) +
                        (lower_do ? ", or cross_members: {reach: " + length_text(reach) + "}"
                                  : ", or a narrower section")});
  return issues;
}

PlaneRegion template_region(const TimberChannel& channel, const TimberOptions& options) {
  const double wide = channel.overall();
  const double low = -channel.thickness - options.cross_members.height;
  const double high = channel.trough->seat.front().y;
  std::vector<Vec2> corners = {{0.0, 0.0}, {wide, 0.0}, {wide, high - low}};
  for (const Vec2 corner : channel.trough->seat) corners.push_back(corner - Vec2{-0.5 * wide, low});
  corners.push_back({0.0, high - low});
  return {outline_of(corners), {}, {}};
}

// --- the lining

Lining::Lining(const TimberJob& job)
    : job_(job), strip_job_(job.track, job.channel.trough->section, plate_options_, job.placement) {
  strips_ = lining_strips(job);
  for (const LiningStrip& strip : strips_) unfolded_.push_back(unfolded(strip_job_, strip.plate));
  const std::size_t sets = job.sets_per_layer() * static_cast<std::size_t>(job.options.deck.layers);
  for (std::size_t set = 0; set < sets; ++set) {
    const std::vector<double> seams = seams_of_set(job, rows_, [&](double from, double share) {
      const double end = longest_row(set, from);
      return share == 1.0 ? end : from + share * (end - from);
    });
    std::vector<DeckRow> rows;
    for (std::size_t i = 0; i + 1 < seams.size(); ++i)
      rows.push_back({{seams[i], seams[i + 1]}, seams[i + 1] - seams[i]});
    rows_.push_back(std::move(rows));
  }
}

bool Lining::fits(const LiningStrip& strip, const Span& span) const {
  const PlaneBox box = bounds(pattern_of(developed(strip_job_, strip.plate, span), {}).region.outline);
  const TimberOptions& options = job_.options;
  if (options.split.heaviest) {
    const double volume = section_of(strip.plate).along(job_.track, span);
    if (volume * job_.deck_material().density > *options.split.heaviest) return false;
  }
  return box.width() <= stock_length(options) && box.height() <= stock_width(options);
}

double Lining::longest_row(std::size_t set, double from) const {
  const double length = job_.track.length();
  const LiningStrip* tight = nullptr;
  const auto all_fit = [&](double to) {
    for (std::size_t i = 0; i < strips_.size(); ++i) {
      if (strips_[i].set != set) continue;
      const Span span{std::max(from, unfolded_[i].from), std::min(to, unfolded_[i].to)};
      if (!(span.to - span.from > 1e-6) || fits(strips_[i], span)) continue;
      tight = &strips_[i];
      return false;
    }
    return true;
  };
  if (all_fit(length)) return length;
  double good = std::min(length, from + kLeastRow);
  if (!all_fit(good)) {
    const bool boards = job_.options.deck.boards.has_value();
    const SectionPlate& plate = tight->plate;
    throw InputError(
        {boards ? "deck.boards" : "split.sheet",
         "the " + tight->name + ", " + length_text(norm(plate.face_to - plate.face_from), 3) +
             " wide, is cut from no " + (boards ? "board" : "sheet") + " of " +
             length_text(stock_length(job_.options)) + " x " + length_text(stock_width(job_.options)) +
             " at " + length_text(from, 3) + " along the track",
         "A piece of " + length_text(kLeastRow) + " would not fit, along its curve, or be too heavy.",
         std::string(boards ? "wider boards" : "a larger sheet") +
             ", a limit on the track's radius, or a larger split.heaviest"});
  }
  double bad = length;
  constexpr double kFine = 1e-3;  // [m]
  while (bad - good > kFine) {
    const double middle = 0.5 * (good + bad);
    (all_fit(middle) ? good : bad) = middle;
  }
  return good;
}

std::vector<ShopPart> Lining::parts() const {
  std::vector<ShopPart> parts;
  for (std::size_t i = 0; i < strips_.size(); ++i) {
    const LiningStrip& strip = strips_[i];
    int piece = 0;
    for (const DeckRow& row : rows_[strip.set]) {
      const Span span{std::max(row.span.from, unfolded_[i].from), std::min(row.span.to, unfolded_[i].to)};
      if (!(span.to - span.from > 1e-6)) continue;
      ShopPart part;
      part.name = strip.name + "_" + std::to_string(++piece);
      part.material = job_.deck_material().name;
      part.density = job_.deck_material().density;
      part.thickness = job_.layer();
      part.bought_in = job_.options.deck.boards.has_value();
      const std::vector<StripArc> arcs = strip_job_.arcs_in(span);
      if (std::all_of(arcs.begin(), arcs.end(),
                      [](const StripArc& one) { return one.arc.curvature == 0.0; })) {
        const TrackFrame at = frame_at(job_.track, span.from);
        part.body = straight_body(strip.plate, span.to - span.from);
        part.places = {{in_space(job_.placement, at.at), across(job_.placement),
                        direction_in_space(job_.placement, at.up),
                        direction_in_space(job_.placement, at.along)}};
      } else {
        Vec2 origin;
        part.body = strip_body(strip_job_, strip.plate, span, origin);
        part.places = {plane_of_track(job_.placement, origin, 0.0,
                                      -0.5 * (strip.plate.face_from.x + strip.plate.face_to.x))};
      }
      part.pattern = pattern_of(developed(strip_job_, strip.plate, span), {});
      weigh(part);
      parts.push_back(std::move(part));
    }
  }
  return parts;
}

double Lining::exact_volume() const {
  const PlateSection& section = job_.channel.trough->section;
  std::vector<Vec2> corners;
  for (const SectionPlate& plate : section.plates) corners.push_back(plate.face_from);
  corners.push_back(section.plates.back().face_to);
  corners.push_back(section.plates.back().back_to);
  for (auto plate = section.plates.rbegin(); plate != section.plates.rend(); ++plate)
    corners.push_back(plate->back_from);
  const Span whole{0.0, job_.track.length()};
  double volume = section_of(corners).along(job_.track, whole);
  // Gaps lie between strips of one side, square to it.
  const std::vector<SectionPlate> round = strips_round(job_.channel, job_.options);
  const double gap = job_.gap();
  for (std::size_t i = 0; gap > 0.0 && i + 1 < round.size(); ++i) {
    if (norm(round[i + 1].face_from - round[i].face_to) < 0.5 * gap) continue;
    const double height = 0.25 * (round[i].face_to.y + round[i].back_to.y + round[i + 1].face_from.y +
                                  round[i + 1].back_from.y);
    const double area = gap * job_.channel.thickness;
    volume -= Section{area, area * height}.along(job_.track, whole);
  }
  for (std::size_t i = 0; i < strips_.size(); ++i) {
    const Section strip = section_of(strips_[i].plate);
    if (unfolded_[i].from > 0.0) volume -= strip.along(job_.track, {0.0, unfolded_[i].from});
    if (unfolded_[i].to < whole.to) volume -= strip.along(job_.track, {unfolded_[i].to, whole.to});
  }
  return volume;
}

double Lining::edge_mismatch() const {
  double most = 0.0;
  for (std::size_t i = 0; i < strips_.size(); ++i) {
    for (const DeckRow& row : rows_[strips_[i].set]) {
      const Span span{std::max(row.span.from, unfolded_[i].from), std::min(row.span.to, unfolded_[i].to)};
      if (!(span.to - span.from > 1e-6)) continue;
      const Development flat = developed(strip_job_, strips_[i].plate, span);
      const double turned =
          job_.track.direction(span.from).slope_angle - job_.track.direction(span.to).slope_angle;
      const auto finished = [&](Vec2 middle) { return span.to - span.from - turned * middle.y; };
      most = std::max(
          {most, std::fabs(length_along(flat.base, flat.turns) - finished(strips_[i].plate.middle_to())),
           std::fabs(length_along(flat.upper, flat.turns) - finished(strips_[i].plate.middle_from()))});
    }
  }
  return most;
}

void Lining::tell(Workshop& workshop) const {
  workshop.notes.emplace_back(
      "Strips of the lining meet in mitres: patterns are of the middle of each layer, edges are bevelled to "
      "the joint. Strips of the left and of the right side are mirror images: turned over, the bevel is on "
      "the wrong side.");
  const double departure = job_.channel.trough->section.departure;
  if (departure > 0.0) {
    workshop.notes.push_back("Flat staves stand in for the round section; they lie outside it by at most " +
                             length_text(departure, 3) + ".");
  }
  for (std::size_t i = 0; i < strips_.size(); ++i) {
    if (unfolded_[i].from == 0.0 && unfolded_[i].to == job_.track.length()) continue;
    tell_short_plate(strips_[i].name, unfolded_[i].from, unfolded_[i].to, job_.track.length(), workshop);
  }
}

}  // namespace glissade::parts
