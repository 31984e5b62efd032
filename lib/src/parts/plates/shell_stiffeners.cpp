// Stiffeners of sections of any kind: plates across the track along the outside of the section, round what laps.

#include "glissade/core/number_text.hpp"

#include "parts/plates/frame_pieces.hpp"
#include "parts/plates/shell.hpp"
#include "parts/plates/shortfalls.hpp"
#include "parts/plates/stiffener_row.hpp"
#include "parts/shop/workshop_list.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace glissade::parts {
namespace {

constexpr double kAside = 15e-3;     // of stiffeners from what else stands there, for welding [m]
constexpr double kHalfGap = 0.5e-3;  // between the halves of one round a ring, for welding [m]

PlaneRegion between(ArcPath outer, const ArcPath& inner) {
  outer.vertices.back().bulge = 0.0;
  for (const PathVertex& vertex : reversed(inner).vertices) outer.vertices.push_back(vertex);
  outer.vertices.back().bulge = 0.0;
  outer.closed = true;
  return {outer, {}, {}};
}

/// A stiffener, and a line in it outside of what laps.
struct Ring {
  PlaneRegion region;
  ArcPath line;
};

/// @return none where laps leave no way round them
std::optional<Ring> ring_at(const Shell& shell, double s) {
  const StiffenerOptions& stiffener = *shell.options.stiffeners;
  const double gap = shell.options.flanges.gap;
  if (shell.ring) {
    const SectionOutside outside = shell.outside(s);
    const auto inner = round_laps(outside, gap);
    if (!inner) return std::nullopt;
    return Ring{between(left_half(moved_out(outside.line, gap + stiffener.width), kHalfGap),
                        left_half(*inner, kHalfGap)),
                left_half(moved_out(outside.line, gap + line_in_band(stiffener.width)), kHalfGap)};
  }
  const double rim = shell.options.rim ? shell.options.rim->thickness + gap : 0.0;
  const SectionOutside outside = lowered(shell.outside(s), rim);
  const auto inner = round_laps(outside, gap);
  if (!inner) return std::nullopt;
  return Ring{between(moved_out(outside.line, gap + stiffener.width), *inner),
              moved_out(outside.line, gap + line_in_band(stiffener.width))};
}

/// The other half, turned about the upright.
Frame turned(const Frame& place, double thickness) {
  return {place.origin + thickness * place.z, -1.0 * place.x, place.y, -1.0 * place.z};
}

/// Where stiffeners of a shell may stand.
class ShellSeats {
 public:
  explicit ShellSeats(const Shell& shell) : shell_(shell), frames_(standing_frames(shell)) {
    const double out = shell.options.flanges.gap + shell.options.stiffeners->width;
    heights_ = {shell.lowest - out, shell.highest + (shell.ring ? out : 0.0)};
    half_ = 0.5 * shell.options.stiffeners->thickness;
  }

  [[nodiscard]] StandingPlate plate(double s) const { return {frame_of(shell_, s), half_, heights_}; }

  /// @param standing  those of units before
  [[nodiscard]] StiffenerSeats in(const Span& unit, const std::vector<StandingPlate>& standing) const {
    const Span room = between_frames(shell_, unit);
    StiffenerSeats seats;
    for (int k = 0; k <= kSeats; ++k) seats.places.push_back(seat_place(room, k));
    seats.is_free = [this, room, &standing](double s) {
      const StandingPlate here = plate(s);
      return all_apart(here, frames_) && all_apart(here, standing) &&
             is_seat(shell_, {half_ + kAside, half_}, room, s) && ring_at(shell_, s);
    };
    seats.beside = [this](double a, double b) {
      return b - a >= least_apart(*shell_.options.stiffeners) && stand_apart(plate(a), plate(b));
    };
    return seats;
  }

 private:
  const Shell& shell_;
  std::vector<StandingPlate> frames_;
  Span heights_;
  double half_ = 0.0;
};

}  // namespace

std::vector<StandingPlate> add_stiffeners(const Shell& shell) {
  if (!shell.options.stiffeners) return {};
  const StiffenerOptions& stiffener = *shell.options.stiffeners;
  const double half = 0.5 * stiffener.thickness;
  const ShellSeats seats(shell);
  std::vector<StandingPlate> standing;
  WideGaps gaps;
  for (const Span& unit : shell.units) {
    const std::vector<double> row = stiffener_row(unit, stiffener.spacing, seats.in(unit, standing));
    gaps.add(unit, row, stiffener.spacing);
    for (const double at : row) {
      const Ring ring = ring_at(shell, at).value();
      ShopPart part = cross_plate(shell, "stiffener", ring.region, stiffener.thickness, at);
      if (shell.ring) {
        part.name = "stiffener_half";
        part.places.push_back(turned(part.places.front(), stiffener.thickness));
      }
      add_in_pieces(part, ring.line, false, shell.options, kFittingColour, shell.workshop);
      shell.taken.add(at - half, at + half);
      standing.push_back(seats.plate(at));
    }
  }
  gaps.tell(shell.options, shell.workshop);
  return standing;
}

}  // namespace glissade::parts
