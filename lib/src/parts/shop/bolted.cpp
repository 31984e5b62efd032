#include "parts/shop/bolted.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/slot.hpp"

#include "parts/bodies/angle_bar.hpp"
#include "parts/bodies/body_depth.hpp"
#include "parts/bodies/bores.hpp"
#include "parts/bodies/placed_piece.hpp"
#include "parts/bodies/tube_windows.hpp"
#include "parts/shop/bolts.hpp"
#include "parts/shop/equal_parts.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace glissade::parts {
namespace {

// Pieces that get one number differ by what no machine cuts.
constexpr double kSame = 4.0 * kSamePart;
constexpr double kTouch = 0.2e-3;  // pieces nearer than this lie on each other [m]

/// A round hole, or a slot with round ends, in the frame of its part.
struct Hole {
  Vec3 begin;  ///< centre of its first end
  Vec3 into;   ///< unit
  double depth = 0.0;
  double radius = 0.0;
  Vec3 reach;  ///< from a slot's centre to that of its end; 0 of a hole that is round
};

std::vector<Hole> slots_of(const Prism& prism) {
  std::vector<Hole> slots;
  for (const ArcPath& cutout : prism.region.cutouts) {
    const auto slot = as_slot(cutout);
    if (!slot) continue;
    slots.push_back({{slot->middle.x, slot->middle.y, 0.0},
                     {0.0, 0.0, 1.0},
                     prism.depth,
                     slot->radius,
                     {slot->reach.x, slot->reach.y, 0.0}});
  }
  return slots;
}

std::vector<Hole> from_bores(const std::vector<Bore>& bores) {
  std::vector<Hole> holes;
  for (const Bore& bore : bores) holes.push_back({bore.centre, bore.into, bore.depth, bore.radius, {}});
  return holes;
}

std::vector<Hole> holes_of(const Prism& prism) {
  std::vector<Hole> holes = slots_of(prism);
  for (const Circle& hole : prism.region.holes)
    holes.push_back({{hole.centre.x, hole.centre.y, 0.0}, {0.0, 0.0, 1.0}, prism.depth, hole.radius, {}});
  return holes;
}

std::vector<Hole> holes_of(const PartBody& body) {
  if (const auto* const bar = std::get_if<AngleBar>(&body)) return holes_of(legs_of(*bar)[0]);
  if (const auto* const tube = std::get_if<TubeGore>(&body)) return from_bores(bores_of(*tube));
  if (const auto* const trough = std::get_if<TroughGore>(&body))
    return from_bores(bores_of(round_of(*trough)));
  if (const auto* const swept = std::get_if<SweptBody>(&body)) return from_bores(bores_of(*swept));
  if (const auto* const sheet = std::get_if<RolledSheet>(&body)) return from_bores(bores_of(*sheet));
  const auto* const prism = std::get_if<Prism>(&body);
  if (prism == nullptr) return {};
  return holes_of(*prism);
}

/// Tubes and boards that are bought.
bool drilled_on_site(const ShopPart& part) {
  return part.bought_in && !std::holds_alternative<AngleBar>(part.body);
}

Vec3 turned(const Frame& place, Vec3 direction) {
  return direction.x * place.x + direction.y * place.y + direction.z * place.z;
}

/// One end of a hole of a piece.
struct Mouth {
  std::size_t piece = 0;
  Vec3 at;
  Vec3 out;  ///< unit, away from the plate
  double depth = 0.0;
  double radius = 0.0;
  Vec3 reach;  ///< of a slot
};

struct Pieces {
  std::vector<PlacedPiece> all;
  std::vector<Mouth> mouths;  ///< by ascending x
};

Pieces pieces_of(const Workshop& workshop) {
  Pieces pieces{placed_pieces(workshop), {}};
  std::vector<Hole> holes;
  const ShopPart* part = nullptr;
  for (std::size_t i = 0; i < pieces.all.size(); ++i) {
    const Frame& place = pieces.all[i].place;
    if (pieces.all[i].part != part) {
      part = pieces.all[i].part;
      holes = drilled_on_site(*part) ? std::vector<Hole>() : holes_of(part->body);
    }
    for (const Hole& hole : holes) {
      const Vec3 begin = place.to_space(hole.begin);
      const Vec3 into = turned(place, hole.into);
      const Vec3 reach = turned(place, hole.reach);
      pieces.mouths.push_back({i, begin, -1.0 * into, hole.depth, hole.radius, reach});
      pieces.mouths.push_back({i, begin + hole.depth * into, into, hole.depth, hole.radius, reach});
    }
  }
  std::stable_sort(pieces.mouths.begin(), pieces.mouths.end(),
                   [](const Mouth& a, const Mouth& b) { return a.at.x < b.at.x; });
  return pieces;
}

/// How far a mouth's axis is from what a bolt through another one takes: its axis, or that of a slot anywhere along it.
double off_axis(const Mouth& mouth, const Mouth& other) {
  Vec3 aside = other.at - mouth.at;
  aside = aside - dot(aside, mouth.out) * mouth.out;
  for (const Vec3 reach : {mouth.reach, other.reach}) {
    const double half = norm(reach);
    if (half > 0.0) aside = aside - std::clamp(dot(aside, reach) / half, -half, half) / half * reach;
  }
  // Axes that lean to each other part within the plates.
  return norm(aside) + norm(cross(mouth.out, other.out)) * std::max(mouth.depth, other.depth);
}

/// Whether two pieces touch where both have a hole, or most of one.
bool meet(const Mouth& mouth, const Mouth& other) {
  if (mouth.piece == other.piece || dot(mouth.out, other.out) > -0.9) return false;
  const Vec3 away = other.at - mouth.at;
  const double apart = dot(away, mouth.out);
  const double aside = norm(away - apart * mouth.out);
  return std::fabs(apart) < kTouch &&
         aside < mouth.radius + other.radius + norm(mouth.reach) + norm(other.reach);
}

bool one_bolt_fits(double radius, double other) {
  const auto fits = [](const Bolt& bolt, double r) {
    const auto is = [&](double diameter) { return std::fabs(2.0 * r - diameter) < kSame; };
    return is(bolt.fine) || is(bolt.medium) || is(bolt.coarse);
  };
  if (std::fabs(radius - other) < kSame) return true;
  const auto sizes = bolt_sizes();
  return std::any_of(sizes.begin(), sizes.end(),
                     [&](int size) { return fits(bolt_of(size), radius) && fits(bolt_of(size), other); });
}

[[noreturn]] void tell(const PlacedPiece& piece, const Mouth& mouth, const std::string& what) {
  throw InternalError({"",
                       "the hole of " + length_text(2.0 * mouth.radius) + " in " + piece.part->name +
                           " at (" + length_text(mouth.at.x, 5) + ", " + length_text(mouth.at.y, 5) + ", " +
                           length_text(mouth.at.z, 5) + ") " + what,
                       "", "another design, and a report of this one"});
}

/// A piece other than its own, and other than that of the hole that it meets, covers a mouth.
bool covers(const PlacedPiece& piece, const Mouth& mouth) {
  const Vec3 before = in_own(piece.place, mouth.at + kTouch * mouth.out);
  const double room = mouth.radius + norm(mouth.reach);
  if (!piece.near(before, room)) return false;
  const double depth = depth_inside(piece.part->body, before);
  if (depth > 0.0 || norm(mouth.reach) > 0.0) return depth > 0.0;
  if (depth < -mouth.radius) return false;
  constexpr int kRound = 12;
  constexpr double kInside =
      0.95;  // of the radius: what just touches the edge of a hole lets the bolt through
  const Vec3 out = in_own(piece.place, piece.place.origin + mouth.out);
  const Vec3 least = std::fabs(out.x) < 0.6 ? Vec3{1.0, 0.0, 0.0} : Vec3{0.0, 1.0, 0.0};
  const Vec3 square = cross(out, least);
  const Vec3 one = (kInside * mouth.radius / norm(square)) * square;
  const Vec3 other = cross(out, one);
  for (int k = 0; k < kRound; ++k) {
    const auto [sine, cosine] = math::sine_cosine(2.0 * std::numbers::pi * k / kRound);
    if (depth_inside(piece.part->body, before + cosine * one + sine * other) > 0.0) return true;
  }
  return false;
}

/// The mouth of another piece that lies nearest on this one; none.
const Mouth* partner_of(const Pieces& pieces, std::size_t index, double reach) {
  const Mouth& mouth = pieces.mouths[index];
  const Mouth* nearest = nullptr;
  const auto see = [&](const Mouth& other) {
    if (meet(mouth, other) && (nearest == nullptr || off_axis(mouth, other) < off_axis(mouth, *nearest)))
      nearest = &other;
  };
  for (std::size_t k = index; k-- > 0 && mouth.at.x - pieces.mouths[k].at.x <= reach;) see(pieces.mouths[k]);
  for (std::size_t k = index + 1; k < pieces.mouths.size() && pieces.mouths[k].at.x - mouth.at.x <= reach;
       ++k)
    see(pieces.mouths[k]);
  return nearest;
}

/// Pieces by the stretch of x that they take, for mouths in the order of theirs.
class Sweep {
 public:
  explicit Sweep(const std::vector<PlacedPiece>& pieces) {
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      const PlacedPiece& piece = pieces[i];
      const Vec3 middle = piece.place.to_space(0.5 * (piece.low + piece.high));
      const Vec3 half = 0.5 * (piece.high - piece.low);
      const double reach = std::fabs(piece.place.x.x) * half.x + std::fabs(piece.place.y.x) * half.y +
                           std::fabs(piece.place.z.x) * half.z;
      spans_.push_back({middle.x - reach, middle.x + reach, i});
    }
    std::stable_sort(spans_.begin(), spans_.end(),
                     [](const Span& a, const Span& b) { return a.low < b.low; });
  }

  /// @return indices of the pieces about x; x ascends from call to call
  const std::vector<std::size_t>& about(double x, double room) {
    while (next_ < spans_.size() && spans_[next_].low <= x + room) open_.push_back(spans_[next_++]);
    open_.erase(
        std::remove_if(open_.begin(), open_.end(), [&](const Span& span) { return span.high < x - room; }),
        open_.end());
    found_.clear();
    for (const Span& span : open_) found_.push_back(span.piece);
    return found_;
  }

 private:
  struct Span {
    double low;
    double high;
    std::size_t piece;
  };
  std::vector<Span> spans_;
  std::vector<Span> open_;
  std::vector<std::size_t> found_;
  std::size_t next_ = 0;
};

}  // namespace

BoltedHoles require_bolts_meet(const Workshop& workshop) {
  const Pieces pieces = pieces_of(workshop);
  BoltedHoles facts;
  double widest = 0.0;
  for (const Mouth& mouth : pieces.mouths) widest = std::max(widest, mouth.radius + norm(mouth.reach));
  Sweep sweep(pieces.all);
  for (std::size_t i = 0; i < pieces.mouths.size(); ++i) {
    const Mouth& mouth = pieces.mouths[i];
    const PlacedPiece& own = pieces.all[mouth.piece];
    const Mouth* const partner = partner_of(pieces, i, 2.0 * widest + kTouch);
    if (partner != nullptr) {
      const std::string& name = pieces.all[partner->piece].part->name;
      const double off = off_axis(mouth, *partner);
      if (!(off <= kSame)) tell(own, mouth, "is " + length_text(off, 3) + " off the axis of that in " + name);
      if (!one_bolt_fits(mouth.radius, partner->radius)) {
        tell(own, mouth,
             "meets one of " + length_text(2.0 * partner->radius) + " in " + name +
                 ", and no bolt goes with both");
      }
      facts.off_axis = std::max(facts.off_axis, off);
      facts.joined += 1;
    } else {
      facts.open += 1;
    }
    for (const std::size_t k : sweep.about(mouth.at.x, widest + kTouch)) {
      const PlacedPiece& piece = pieces.all[k];
      if (k == mouth.piece || (partner != nullptr && k == partner->piece) || drilled_on_site(*piece.part))
        continue;
      if (covers(piece, mouth))
        tell(own, mouth, "is covered by " + piece.part->name + ", which has none there");
    }
  }
  facts.joined /= 2;
  return facts;
}

}  // namespace glissade::parts
