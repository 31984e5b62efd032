// Stiffeners of sections of any kind: plates across the track along the outside of the section, round what laps.

#include "glissade/core/number_text.hpp"

#include "parts/plates/frame_pieces.hpp"
#include "parts/plates/shell.hpp"
#include "parts/plates/shortfalls.hpp"
#include "parts/shop/workshop_list.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

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

}  // namespace

std::vector<StandingPlate> add_stiffeners(const Shell& shell) {
  if (!shell.options.stiffeners) return {};
  const StiffenerOptions& stiffener = *shell.options.stiffeners;
  const double half = 0.5 * stiffener.thickness;
  const double out = shell.options.flanges.gap + stiffener.width;
  const Span heights{shell.lowest - out, shell.highest + (shell.ring ? out : 0.0)};
  const std::vector<StandingPlate> frames = standing_frames(shell);
  std::vector<StandingPlate> standing;
  StiffenerPlaces places;
  for (const Span& unit : shell.units) {
    const double whole = unit.to - unit.from;
    const double gaps = std::ceil(whole / stiffener.spacing - 1e-9);
    const Span room = between_frames(shell, unit);
    for (double k = 1.0; k < gaps; k += 1.0) {
      const double about = unit.from + whole * k / gaps;
      places.ask(about);
      const auto cost = [&](double s) {
        const StandingPlate here{frame_of(shell, s), half, heights};
        return all_apart(here, frames) && all_apart(here, standing) ? std::fabs(s - about) : kNoPlace;
      };
      const auto at = best_seat(shell, {half + kAside, half}, room, cost);
      if (!at || std::fabs(*at - about) > 0.5 * whole / gaps) continue;
      const auto ring = ring_at(shell, *at);
      if (!ring) continue;
      ShopPart part = cross_plate(shell, "stiffener", ring->region, stiffener.thickness, *at);
      if (shell.ring) {
        part.name = "stiffener_half";
        part.places.push_back(turned(part.places.front(), stiffener.thickness));
      }
      add_in_pieces(part, ring->line, false, shell.options, kFittingColour, shell.workshop);
      shell.taken.add(*at - half, *at + half);
      standing.push_back({frame_of(shell, *at), half, heights});
      places.found();
    }
  }
  places.tell_missing(shell.options, shell.workshop);
  return standing;
}

}  // namespace glissade::parts
