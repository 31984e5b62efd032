#include "parts/plates/frame_pieces.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/slot.hpp"

#include "core/plane_geometry.hpp"
#include "parts/bodies/body_moments.hpp"
#include "parts/bodies/body_places.hpp"
#include "parts/plates/frame_holes.hpp"
#include "parts/plates/plate_joints.hpp"
#include "parts/plates/plate_unit.hpp"
#include "parts/plates/seams.hpp"
#include "parts/shop/workshop_list.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

namespace glissade::parts {
namespace {

constexpr double kCutStep = 1e-3;     // in which cuts move off what is taken [m]
constexpr double kStagger = 60e-3;    // of cuts in two plates without bolts that meet [m]
constexpr double kRoom = 0.4;         // of a piece, by which a cut may move
constexpr double kMostStagger = 0.3;  // of a piece
constexpr double kOffCorner = 5e-3;   // of a cut [m]
constexpr double kWidest = 1.5;       // of a cut, in widths of the band
constexpr int kPlaces = 64;           // where the width is measured
constexpr double kSliver = 1e-9;      // of an arc or line that is left out [m]
constexpr double kSquare = 1e-6;      // sine of the angle by which edges may be off the band's line

constexpr double kWholeTurn = 2.0 * std::numbers::pi;

double sweep_of(const PathPiece& piece) {
  return 4.0 * math::atan(piece.bulge);
}

/// The share of a piece that comes nearest to a point.
double nearest_share(const PathPiece& piece, Vec2 point) {
  if (piece.straight()) {
    const Vec2 way = piece.to - piece.from;
    return std::clamp(dot(point - piece.from, way) / dot(way, way), 0.0, 1.0);
  }
  const CircularArc arc = arc_of(piece);
  const Vec2 out = point - arc.centre;
  // From the middle of the arc, so that what lies beside it goes to the nearer end.
  const double middle = math::atan2(out.y, out.x) - arc.start_angle - 0.5 * arc.sweep;
  const double turned = middle - kWholeTurn * std::nearbyint(middle / kWholeTurn);
  return std::clamp(0.5 + turned / arc.sweep, 0.0, 1.0);
}

}  // namespace

BandLine::BandLine(const ArcPath& line) : pieces_(pieces_of(line)), starts_{0.0}, closed_(line.closed) {
  for (const PathPiece& piece : pieces_) starts_.push_back(starts_.back() + glissade::length(piece));
}

BandLine::Place BandLine::at(double s) const {
  const double on = closed_ ? s - length() * std::floor(s / length()) : std::clamp(s, 0.0, length());
  std::size_t i = 0;
  while (i + 1 < pieces_.size() && on >= starts_[i + 1]) ++i;
  const double share = (on - starts_[i]) / (starts_[i + 1] - starts_[i]);
  return {i, share, point_on(pieces_[i], share), tangent_at(pieces_[i], share)};
}

ArcPath BandLine::stretch(double from, double to) const {
  ArcPath path;
  const auto part = [&](std::size_t i, double low, double high) {
    const PathPiece& piece = pieces_[i];
    // A place at a joint may lie on either side of it.
    if ((high - low) * glissade::length(piece) < kSliver) return;
    path.vertices.push_back(
        {point_on(piece, low), piece.straight() ? 0.0 : bulge_of_sweep((high - low) * sweep_of(piece))});
  };
  const Place first = at(from);
  const Place last = to >= length() && !closed_ ? Place{pieces_.size() - 1, 1.0, {}, {}} : at(to);
  std::size_t i = first.piece;
  double begins = first.share;
  while (i != last.piece || begins > last.share) {
    part(i, begins, 1.0);
    i = (i + 1) % pieces_.size();
    begins = 0.0;
  }
  part(i, begins, last.share);
  path.vertices.push_back({point_on(pieces_[i], last.share), 0.0});
  return path;
}

double BandLine::nearest(Vec2 point) const {
  double best = 0.0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    const double share = nearest_share(pieces_[i], point);
    const double apart = norm(point_on(pieces_[i], share) - point);
    if (apart >= least) continue;
    least = apart;
    best = starts_[i] + share * (starts_[i + 1] - starts_[i]);
  }
  return best;
}

namespace {

/// The ways from one bolt to the next, by their middles; of a closed line the last goes on to the first.
struct Gaps {
  std::vector<double> middles;
  double widest = 0.0;
};

Gaps gaps_of(const BandLine& line, std::vector<double> bolts) {
  Gaps gaps;
  std::sort(bolts.begin(), bolts.end());
  if (line.closed() && !bolts.empty()) bolts.push_back(bolts.front() + line.length());
  for (std::size_t i = 0; i + 1 < bolts.size(); ++i) {
    gaps.middles.push_back(0.5 * (bolts[i] + bolts[i + 1]));
    gaps.widest = std::max(gaps.widest, bolts[i + 1] - bolts[i]);
  }
  return gaps;
}

std::optional<double> cut_near(const BandLine& line, const BandCuts& cuts, const Gaps& gaps, double about,
                               double room) {
  std::optional<double> best;
  const std::vector<double> turns =
      line.closed() ? std::vector<double>{0.0, line.length(), -line.length()} : std::vector<double>{0.0};
  for (const double middle : gaps.middles) {
    for (const double turn : turns) {
      const double off = std::fabs(middle + turn - about);
      if (off > room || (best && off >= std::fabs(*best - about)) || !cuts.is_free(middle)) continue;
      best = middle + turn;
    }
  }
  if (best) return best;
  for (double off = 0.0; off <= room; off += kCutStep) {
    for (const double place : {about - off, about + off}) {
      if (cuts.is_free(place)) return place;
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::vector<double>> cuts_along(const BandLine& line, const BandCuts& cuts) {
  const double step = line.length() / static_cast<double>(cuts.pieces);
  const Gaps gaps = gaps_of(line, cuts.bolts);
  const double aside = gaps.middles.empty() ? kStagger : gaps.widest;
  const double shift = cuts.staggered ? std::min(aside, kMostStagger * step) : 0.0;
  std::vector<double> places;
  for (std::size_t k = line.closed() ? 0 : 1; k < cuts.pieces; ++k) {
    const auto place = cut_near(line, cuts, gaps, static_cast<double>(k) * step + shift, kRoom * step);
    if (!place || (!places.empty() && !(*place > places.back() + 0.1 * step))) return std::nullopt;
    places.push_back(*place);
  }
  if (line.closed() && !(places.front() + line.length() > places.back() + 0.1 * step)) return std::nullopt;
  return places;
}

namespace {

/// Where a ray from a point meets a piece.
struct Meeting {
  double distance = std::numeric_limits<double>::infinity();
  double share = 0.0;
};

Meeting meeting_of(const PathPiece& piece, Vec2 from, Vec2 way) {
  Meeting meeting;
  if (piece.straight()) {
    const Vec2 along = piece.to - piece.from;
    const double area = cross(way, along);
    if (area == 0.0) return meeting;
    const double distance = cross(piece.from - from, along) / area;
    const double share = cross(piece.from - from, way) / area;
    if (distance > 0.0 && share >= 0.0 && share <= 1.0) meeting = {distance, share};
    return meeting;
  }
  const CircularArc arc = arc_of(piece);
  const Vec2 out = from - arc.centre;
  const double half = dot(out, way);
  const double under = half * half - dot(out, out) + arc.radius * arc.radius;
  if (under < 0.0) return meeting;
  for (const double distance : {-half - std::sqrt(under), -half + std::sqrt(under)}) {
    const Vec2 there = out + distance * way;
    const double middle = math::atan2(there.y, there.x) - arc.start_angle - 0.5 * arc.sweep;
    const double turned = middle - kWholeTurn * std::nearbyint(middle / kWholeTurn);
    if (!(distance > 0.0) || std::fabs(turned) > 0.5 * std::fabs(arc.sweep)) continue;
    if (distance < meeting.distance) meeting = {distance, 0.5 + turned / arc.sweep};
  }
  return meeting;
}

/// An edge of a band, the band on its right: the whole outline of an open one, or one side of a ring.
BandLine edge_of(const ArcPath& path, bool clockwise) {
  return BandLine((signed_area(path) < 0.0) == clockwise ? path : reversed(path));
}

/// A cut through a band: where it begins on the outer edge and ends on the inner one.
struct Cut {
  double outer = 0.0;  ///< along it
  double inner = 0.0;
  PathPiece line;
};

/// A band and where it may be cut.
class FrameBand {
 public:
  /// @param line  in the band
  FrameBand(const PlaneRegion& region, const PlateOptions& options, const BandLine& line)
      : region_(region), options_(options), outer_(edge_of(region.outline, true)) {
    for (const ArcPath& cutout : region.cutouts) {
      if (!as_slot(cutout)) inner_.emplace(edge_of(cutout, false));
    }
    for (int i = 0; i < kPlaces; ++i) {
      const auto cut = through(line.at((i + 0.5) / kPlaces * line.length()));
      if (cut) width_ = std::min(width_, glissade::length(cut->line));
    }
  }

  /// @return none where it would not be square to both edges, or come near a corner, a hole or a slot
  [[nodiscard]] std::optional<Cut> cut_at(const BandLine::Place& place) const {
    const std::optional<Cut> cut = through(place);
    // In a corner it would run along the other leg.
    if (!cut || glissade::length(cut->line) > kWidest * width_ || !clear_of_holes(cut->line))
      return std::nullopt;
    return cut;
  }

  /// @return what of it lies between two cuts, or beyond one
  [[nodiscard]] PlaneRegion between(const Cut* from, const Cut* to) const {
    PlaneRegion region;
    if (from != nullptr && to != nullptr) {
      region.outline = outer_.stretch(from->outer, to->outer);
      const ArcPath back = inner().stretch(to->inner, from->inner);
      region.outline.vertices.insert(region.outline.vertices.end(), back.vertices.begin(),
                                     back.vertices.end());
    } else {
      region.outline =
          from != nullptr ? outer_.stretch(from->outer, from->inner) : outer_.stretch(to->inner, to->outer);
    }
    region.outline.closed = true;
    for (const Circle& hole : region_.holes) {
      if (contains(region.outline, hole.centre)) region.holes.push_back(hole);
    }
    for (const ArcPath& cutout : region_.cutouts) {
      const auto slot = as_slot(cutout);
      if (slot && contains(region.outline, slot->middle)) region.cutouts.push_back(cutout);
    }
    return region;
  }

  [[nodiscard]] bool is_ring() const { return inner_.has_value(); }

 private:
  [[nodiscard]] const BandLine& inner() const { return inner_ ? *inner_ : outer_; }

  /// The cut at a place, whatever it meets on its way.
  [[nodiscard]] std::optional<Cut> through(const BandLine::Place& place) const {
    const Vec2 left{-place.along.y, place.along.x};
    const auto out = met(outer_, place.at, left, place.along);
    const auto in = met(inner(), place.at, -1.0 * left, -1.0 * place.along);
    if (!out || !in) return std::nullopt;
    return Cut{*out, *in, {outer_.at(*out).at, inner().at(*in).at, 0.0}};
  }

  /// The first place along an edge that a ray meets; none where that is no piece along the band, or near its end.
  [[nodiscard]] static std::optional<double> met(const BandLine& edge, Vec2 from, Vec2 way, Vec2 along) {
    const std::vector<PathPiece>& pieces = edge.pieces();
    Meeting first;
    std::size_t piece = 0;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      const Meeting meeting = meeting_of(pieces[i], from, way);
      if (meeting.distance >= first.distance) continue;
      first = meeting;
      piece = i;
    }
    if (first.distance == std::numeric_limits<double>::infinity()) return std::nullopt;
    const Vec2 tangent = tangent_at(pieces[piece], first.share);
    if (dot(tangent, along) < 0.0 || std::fabs(cross(tangent, along)) > kSquare) return std::nullopt;
    const double begun = first.share * length(pieces[piece]);
    const double left = length(pieces[piece]) - begun;
    if (begun < kOffCorner && is_corner(pieces, piece)) return std::nullopt;
    if (left < kOffCorner && is_corner(pieces, (piece + 1) % pieces.size())) return std::nullopt;
    return edge.begins(piece) + begun;
  }

  /// Whether an edge turns where a piece begins.
  [[nodiscard]] static bool is_corner(const std::vector<PathPiece>& edge, std::size_t piece) {
    const Vec2 before = tangent_at(edge[(piece + edge.size() - 1) % edge.size()], 1.0);
    const Vec2 after = tangent_at(edge[piece], 0.0);
    return std::fabs(cross(before, after)) > kSquare || dot(before, after) < 0.0;
  }

  [[nodiscard]] bool clear_of_holes(const PathPiece& line) const {
    const double off = hole_edge_diameters(options_.shop);
    for (const Circle& hole : region_.holes) {
      if (core::distance_to_segment(hole.centre, line.from, line.to) < 2.0 * off * hole.radius) return false;
    }
    for (const ArcPath& cutout : region_.cutouts) {
      const auto slot = as_slot(cutout);
      if (!slot) continue;
      const double edge = (2.0 * options_.shop.slot_edge_diameters - 1.0) * slot->radius;
      for (const PathPiece& piece : pieces_of(cutout)) {
        if (distance(piece, line) < edge) return false;
      }
    }
    return true;
  }

  const PlaneRegion& region_;
  const PlateOptions& options_;
  BandLine outer_;
  std::optional<BandLine> inner_;
  double width_ = std::numeric_limits<double>::infinity();  ///< where it is least [m]
};

/// One of several pieces of a plate, lying in the least rectangle round it.
ShopPart piece_of(const ShopPart& plate, const PlaneRegion& region, std::size_t index, std::size_t count) {
  const OwnPlane own = own_plane(region.outline);
  ShopPart piece = plate;
  piece.name += strip_letter(index, count);
  piece.pattern = FlatPattern{};
  piece.pattern->region = moved(region, into(own));
  piece.body = Prism{piece.pattern->region, std::get<Prism>(plate.body).depth};
  for (Frame& place : piece.places) place = moved_into(place, own);
  weigh(piece);
  return piece;
}

/// A plate in so many pieces; none where they do not fit or find no cuts.
std::optional<std::vector<ShopPart>> in_pieces(const ShopPart& plate, const FrameBand& band,
                                               const BandLine& line, const BandCuts& wanted,
                                               const SplitOptions& sheet) {
  const auto places = cuts_along(line, wanted);
  if (!places) return std::nullopt;
  std::vector<Cut> cuts;
  for (const double place : *places) cuts.push_back(*band.cut_at(line.at(place)));
  std::vector<ShopPart> pieces;
  const auto add = [&](const Cut* from, const Cut* to) {
    pieces.push_back(piece_of(plate, band.between(from, to), pieces.size(), wanted.pieces));
    return !excess(sheet, pieces.back());
  };
  if (!band.is_ring() && !add(nullptr, &cuts.front())) return std::nullopt;
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    if (!add(&cuts[i], &cuts[i + 1])) return std::nullopt;
  }
  if (!add(&cuts.back(), band.is_ring() ? &cuts.front() : nullptr)) return std::nullopt;
  return pieces;
}

std::vector<double> bolts_along(const BandLine& line, const PlaneRegion& region) {
  std::vector<double> bolts;
  for (const Circle& hole : region.holes) bolts.push_back(line.nearest(hole.centre));
  for (const ArcPath& cutout : region.cutouts) {
    if (const auto slot = as_slot(cutout)) bolts.push_back(line.nearest(slot->middle));
  }
  return bolts;
}

/// A plate in a band, and its pieces of any number.
class BandPlate {
 public:
  BandPlate(const ShopPart& plate, const ArcPath& along, bool staggered, const PlateOptions& options)
      : plate_(plate), line_(along), band_(plate.pattern->region, options, line_) {
    cuts_.bolts = bolts_along(line_, plate.pattern->region);
    cuts_.staggered = staggered;
    cuts_.is_free = [this](double s) { return band_.cut_at(line_.at(s)).has_value(); };
  }
  BandPlate(const BandPlate&) = delete;
  BandPlate& operator=(const BandPlate&) = delete;

  [[nodiscard]] std::optional<std::vector<ShopPart>> cut_into(std::size_t count, const SplitOptions& sheet) {
    cuts_.pieces = count;
    return in_pieces(plate_, band_, line_, cuts_, sheet);
  }
  /// As the frame that it meets is cut.
  void turn() { cuts_.staggered = !cuts_.staggered; }

  /// @return the least that the heaviest piece may weigh [kg]; none where there are no cuts
  [[nodiscard]] std::optional<double> lightest(SplitOptions sheet) {
    sheet.heaviest.reset();
    return lightest_pieces([&](std::size_t count) { return cut_into(count, sheet); });
  }

 private:
  const ShopPart& plate_;
  BandLine line_;
  FrameBand band_;
  BandCuts cuts_;
};

[[noreturn]] void refuse_count(const ShopPart& plate, BandPlate& band, const SplitOptions& split) {
  const auto asked = static_cast<std::size_t>(split.frames);
  std::size_t fewer = asked - 1;
  const auto both = [&](std::size_t count) {
    const bool one = band.cut_into(count, split).has_value();
    band.turn();
    return band.cut_into(count, split).has_value() && one;
  };
  while (fewer > 1 && !both(fewer)) --fewer;
  throw InputError({"split.frames",
                    "frames: " + plate.name + " is not to be had in " + std::to_string(asked) + " pieces",
                    "Cuts lie square between two bolts, off corners and off holes.",
                    fewer > 1 ? "frames: " + std::to_string(fewer) : "leave it out"});
}

[[noreturn]] void refuse_mass(const ShopPart& plate, BandPlate& band, const SplitOptions& split) {
  double least = plate.mass;
  if (split.allowed) {
    const double one = band.lightest(split).value_or(plate.mass);
    band.turn();
    least = std::max(one, band.lightest(split).value_or(plate.mass));
  }
  throw_too_heavy(plate, *split.heaviest, least,
                  split.allowed ? "Cuts of it lie square between two bolts, off corners and off holes."
                                : "One piece is asked for.");
}

std::vector<ShopPart> pieces_of_band(const ShopPart& plate, const ArcPath& along, bool staggered,
                                     const PlateOptions& options) {
  const SplitOptions& split = options.split;
  const auto asked = static_cast<std::size_t>(std::max(split.frames, 1));
  const bool heavy = is_too_heavy(plate, split);
  if (!heavy && (!split.allowed || (asked == 1 && !excess(split, plate)))) return {plate};
  BandPlate band(plate, along, staggered, options);
  if (split.allowed) {
    for (std::size_t count = std::max<std::size_t>(2, asked); count <= kMostFramePieces; ++count) {
      if (auto pieces = band.cut_into(count, split)) return *pieces;
    }
  }
  if (heavy) refuse_mass(plate, band, split);
  if (asked == 1) return {plate};
  refuse_count(plate, band, split);
}

}  // namespace

std::optional<double> lightest_pieces(
    const std::function<std::optional<std::vector<ShopPart>>(std::size_t)>& cut_into) {
  std::optional<double> least;
  for (std::size_t count = 2; count <= kMostFramePieces; ++count) {
    const auto pieces = cut_into(count);
    if (!pieces) continue;
    double most = 0.0;
    for (const ShopPart& piece : *pieces) most = std::max(most, piece.mass);
    least = std::min(least.value_or(most), most);
  }
  return least;
}

double line_in_band(double width) {
  constexpr double kInset = 5e-3;  // [m]
  return width - std::min(0.25 * width, kInset);
}

void add_in_pieces(const ShopPart& plate, const ArcPath& line, bool staggered, const PlateOptions& options,
                   const std::array<double, 3>& colour, Workshop& workshop) {
  std::vector<ShopPart> pieces = pieces_of_band(plate, line, staggered, options);
  if (pieces.size() > 1) {
    add_note(
        options.split.frames > 1
            ? "Frames, flanges and stiffeners are pieces, cut square between bolts and welded edge to edge."
        : is_too_heavy(plate, options.split)
            ? "Frames, flanges and stiffeners heavier than the heaviest part are pieces, cut square between "
              "bolts and welded edge to edge."
            : "Frames, flanges and stiffeners that the sheet does not take in one are pieces, cut square "
              "between bolts and welded edge to edge.",
        workshop);
  }
  for (ShopPart& piece : pieces) add_part(workshop, std::move(piece), colour);
}

}  // namespace glissade::parts
