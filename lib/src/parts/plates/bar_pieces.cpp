#include "parts/plates/bar_pieces.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/slot.hpp"

#include "parts/bodies/angle_bar.hpp"
#include "parts/bodies/body_moments.hpp"
#include "parts/plates/frame_holes.hpp"
#include "parts/plates/frame_pieces.hpp"
#include "parts/plates/plate_joints.hpp"
#include "parts/plates/plate_unit.hpp"
#include "parts/plates/seams.hpp"
#include "parts/shop/workshop_list.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>

namespace glissade::parts {
namespace {

constexpr double kRounding = 1e-9;       // [m]
constexpr std::size_t kMostPieces = 60;  // of one bar

/// @param lightest  to which cuts bring its heaviest piece [kg]
[[noreturn]] void refuse(const ShopPart& part, double length, double lightest, const PlateOptions& options) {
  const bool one = !options.split.allowed;
  if (is_too_heavy(part, options.split)) {
    throw_too_heavy(part, *options.split.heaviest, lightest,
                    one ? "One piece is asked for." : "Cuts of it lie square between its bolts.");
  }
  throw InputError({one ? "split" : "split.bar",
                    (one ? "" : "bar: ") + part.name + " takes " + length_text(length, 4) + " of bar",
                    one ? "One piece is asked for, and bars are " + length_text(options.split.bar) + " long."
                        : "Pieces of " + length_text(options.split.bar) + " find no cuts between its bolts.",
                    "bar: " + length_text(std::ceil(length))});
}

/// A bar's lines and how it is cut.
class CutBar {
 public:
  CutBar(const AngleBar& bar, const PlateOptions& options)
      : bar_(bar), heel_(bar.heel), root_(bar.root), toe_(bar.toe) {
    const double edge = 2.0 * hole_edge_diameters(options.shop);
    for (const Circle& hole : bar.holes) taken_.push_back({heel_.nearest(hole.centre), edge * hole.radius});
    for (const ArcPath& path : bar.slots) {
      const Slot slot = *as_slot(path);
      taken_.push_back({heel_.nearest(slot.middle),
                        2.0 * options.shop.slot_edge_diameters * slot.radius + norm(slot.reach)});
    }
  }

  [[nodiscard]] const BandLine& heel() const { return heel_; }
  [[nodiscard]] std::vector<double> bolts() const {
    std::vector<double> places;
    for (const Taken& one : taken_) places.push_back(one.at);
    return places;
  }

  /// Off bolts, and where a square cut goes through both legs.
  [[nodiscard]] bool is_free(double s) const {
    for (const Taken& one : taken_) {
      double apart = std::fabs(s - one.at);
      if (heel_.closed()) apart = std::fabs(apart - heel_.length() * std::nearbyint(apart / heel_.length()));
      if (apart < one.off) return false;
    }
    const BandLine::Place here = heel_.at(s);
    for (const BandLine* const line : {&root_, &toe_}) {
      const Vec2 way = line->at(line->nearest(here.at)).at - here.at;
      constexpr double kSquare = 1e-9;
      if (std::fabs(dot(way, here.along)) > kSquare) return false;
    }
    return true;
  }

  /// @return what lies between two cuts, none: the end
  [[nodiscard]] AngleBar between(std::optional<double> from, std::optional<double> to) const {
    AngleBar piece;
    piece.heel = stretch(heel_, from, to);
    piece.root = stretch(root_, across(root_, from), across(root_, to));
    piece.toe = stretch(toe_, across(toe_, from), across(toe_, to));
    piece.thickness = bar_.thickness;
    piece.height = bar_.height;
    const PlaneRegion leg = lying_leg(piece);
    for (const Circle& hole : bar_.holes) {
      if (contains(leg.outline, hole.centre)) piece.holes.push_back(hole);
    }
    for (const ArcPath& slot : bar_.slots) {
      if (contains(leg.outline, as_slot(slot)->middle)) piece.slots.push_back(slot);
    }
    return piece;
  }

 private:
  struct Taken {
    double at = 0.0;
    double off = 0.0;
  };

  /// The place on another of the lines, square to that on the heel.
  [[nodiscard]] std::optional<double> across(const BandLine& line, std::optional<double> s) const {
    if (!s) return std::nullopt;
    return line.nearest(heel_.at(*s).at);
  }

  [[nodiscard]] static ArcPath stretch(const BandLine& line, std::optional<double> from,
                                       std::optional<double> to) {
    return line.stretch(from.value_or(0.0), to.value_or(line.length()));
  }

  const AngleBar& bar_;
  BandLine heel_;
  BandLine root_;
  BandLine toe_;
  std::vector<Taken> taken_;
};

ShopPart piece_of(const ShopPart& bar, const AngleBar& body, std::size_t index, std::size_t count) {
  const OwnPlane own = own_plane(lying_leg(body).outline);
  const PlaneMotion motion = into(own);
  ShopPart piece = bar;
  piece.name += strip_letter(index, count);
  AngleBar moved_body = body;
  for (ArcPath* const line : {&moved_body.heel, &moved_body.root, &moved_body.toe})
    *line = moved(*line, motion);
  for (Circle& hole : moved_body.holes) hole.centre = motion(hole.centre);
  for (ArcPath& slot : moved_body.slots) slot = moved(slot, motion);
  piece.pattern = FlatPattern{};
  piece.pattern->region = lying_leg(moved_body);
  piece.body = std::move(moved_body);
  for (Frame& place : piece.places) place = moved_into(place, own);
  weigh(piece);
  return piece;
}

std::optional<std::vector<ShopPart>> in_pieces(const ShopPart& bar, const CutBar& cut, const BandCuts& wanted,
                                               const SplitOptions& split) {
  const auto places = cuts_along(cut.heel(), wanted);
  if (!places) return std::nullopt;
  std::vector<std::optional<double>> ends(places->begin(), places->end());
  if (cut.heel().closed()) {
    ends.push_back(places->front() + cut.heel().length());
  } else {
    ends.insert(ends.begin(), std::nullopt);
    ends.push_back(std::nullopt);
  }
  std::vector<ShopPart> pieces;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    const AngleBar body = cut.between(ends[i], ends[i + 1]);
    if (stock_length(body) > split.bar + kRounding) return std::nullopt;
    pieces.push_back(piece_of(bar, body, i, wanted.pieces));
    if (is_too_heavy(pieces.back(), split)) return std::nullopt;
  }
  return pieces;
}

}  // namespace

std::vector<ShopPart> angle_pieces(const ShopPart& bar, bool staggered, const PlateOptions& options) {
  const auto& body = std::get<AngleBar>(bar.body);
  const SplitOptions& split = options.split;
  const double length = stock_length(body);
  const bool heavy = is_too_heavy(bar, split);
  if (!heavy && length <= split.bar + kRounding) return {bar};
  if (!split.allowed) refuse(bar, length, bar.mass, options);
  const CutBar cut(body, options);
  BandCuts wanted;
  wanted.bolts = cut.bolts();
  wanted.staggered = staggered;
  wanted.is_free = [&](double s) { return cut.is_free(s); };
  const auto least = static_cast<std::size_t>(std::min(std::ceil(length / split.bar - kRounding), 1e3));
  for (wanted.pieces = std::max<std::size_t>(2, least); wanted.pieces <= kMostPieces; ++wanted.pieces) {
    if (auto pieces = in_pieces(bar, cut, wanted, split)) return *pieces;
  }
  SplitOptions any = split;
  any.heaviest.reset();
  double lightest = 0.0;
  for (const bool turned : {false, true}) {
    wanted.staggered = turned;
    const auto cut_into = [&](std::size_t count) {
      wanted.pieces = count;
      return in_pieces(bar, cut, wanted, any);
    };
    lightest = std::max(lightest, lightest_pieces(cut_into).value_or(bar.mass));
  }
  refuse(bar, length, lightest, options);
}

void add_tube(const ShopPart& tube, const PlateOptions& options, const std::array<double, 3>& colour,
              Workshop& workshop) {
  const double length = std::get<Prism>(tube.body).depth;
  const SplitOptions& split = options.split;
  double count = std::ceil(length / split.bar - kRounding);
  if (is_too_heavy(tube, split)) count = std::max(count, std::ceil(tube.mass / *split.heaviest - kRounding));
  if (count < 2.0) {
    add_part(workshop, tube, colour);
    return;
  }
  const auto most = static_cast<double>(kMostPieces);
  if (!split.allowed || count > most) refuse(tube, length, tube.mass / (split.allowed ? most : 1.0), options);
  ShopPart piece = tube;
  const double one = length / count;
  std::get<Prism>(piece.body).depth = one;
  piece.places.clear();
  for (const Frame& place : tube.places) {
    for (double k = 0.0; k < count; k += 1.0) {
      piece.places.push_back(place);
      piece.places.back().origin = place.origin + k * one * place.z;
    }
  }
  weigh(piece);
  add_part(workshop, std::move(piece), colour);
  note_bar_pieces(options, workshop);
}

namespace {

/// What of a flat bar along x lies between two square cuts, in a frame of its own.
ShopPart piece_of_flat(const ShopPart& bar, const Span& along, std::size_t index, std::size_t count) {
  const PlaneRegion& whole = bar.pattern->region;
  const PlaneBox box = bounds(whole.outline);
  const Vec2 corner{along.from, box.low.y};
  PlaneRegion region{rectangle({}, {along.to - along.from, box.height()}), {}, {}};
  for (const Circle& hole : whole.holes) {
    if (hole.centre.x > along.from && hole.centre.x < along.to)
      region.holes.push_back({hole.centre - corner, hole.radius});
  }
  ShopPart piece = bar;
  piece.name += strip_letter(index, count);
  piece.pattern = FlatPattern{};
  piece.pattern->region = region;
  piece.body = Prism{std::move(region), std::get<Prism>(bar.body).depth};
  for (Frame& place : piece.places) place.origin = place.to_space({corner.x, corner.y, 0.0});
  weigh(piece);
  return piece;
}

/// A flat bar in so many pieces as long as each other; none where a cut comes near a hole, or a piece is too heavy.
std::optional<std::vector<ShopPart>> flat_pieces(const ShopPart& bar, std::size_t count,
                                                 const PlateOptions& options) {
  const PlaneBox box = bounds(bar.pattern->region.outline);
  const auto cut = [&](std::size_t k) {
    return box.low.x + box.width() * static_cast<double>(k) / static_cast<double>(count);
  };
  const double off = 2.0 * hole_edge_diameters(options.shop);  // radii
  std::vector<ShopPart> pieces;
  for (std::size_t k = 0; k < count; ++k) {
    const Span along{cut(k), cut(k + 1)};
    for (const Circle& hole : bar.pattern->region.holes) {
      if (k > 0 && std::fabs(hole.centre.x - along.from) < off * hole.radius) return std::nullopt;
    }
    pieces.push_back(piece_of_flat(bar, along, k, count));
    if (is_too_heavy(pieces.back(), options.split)) return std::nullopt;
  }
  return pieces;
}

}  // namespace

void add_flat_bar(ShopPart bar, const PlateOptions& options, const std::array<double, 3>& colour,
                  Workshop& workshop) {
  bar.bought_in = true;
  bar.flat_bar = true;
  const SplitOptions& split = options.split;
  const double length = bounds(bar.pattern->region.outline).width();
  const bool heavy = is_too_heavy(bar, split);
  if (!heavy && length <= split.bar + kRounding) {
    add_part(workshop, std::move(bar), colour);
    return;
  }
  if (!split.allowed) refuse(bar, length, bar.mass, options);
  const auto least = static_cast<std::size_t>(std::min(std::ceil(length / split.bar - kRounding), 1e3));
  for (std::size_t count = std::max<std::size_t>(2, least); count <= kMostPieces; ++count) {
    auto pieces = flat_pieces(bar, count, options);
    if (!pieces) continue;
    for (ShopPart& piece : *pieces) add_part(workshop, std::move(piece), colour);
    note_bar_pieces(options, workshop);
    return;
  }
  SplitOptions any = split;
  any.heaviest.reset();
  PlateOptions of_any = options;
  of_any.split = any;
  const auto cut_into = [&](std::size_t count) { return flat_pieces(bar, count, of_any); };
  refuse(bar, length, lightest_pieces(cut_into).value_or(bar.mass), options);
}

void note_bar_pieces(const PlateOptions& options, Workshop& workshop) {
  add_note("Bars longer than the " + length_text(options.split.bar) + " that they come in" +
               (options.split.heaviest ? ", or too heavy," : "") +
               " are pieces, cut square and welded end to end.",
           workshop);
}

}  // namespace glissade::parts
