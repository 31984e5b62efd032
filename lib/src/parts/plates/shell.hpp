#pragma once

#include "glissade/parts/plate_options.hpp"
#include "glissade/parts/shop_part.hpp"

#include "parts/curves/offset_line.hpp"
#include "parts/plates/fittings.hpp"
#include "parts/plates/section_outside.hpp"

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace glissade::parts {

/// A stretch over which a shell goes straight on, at all of its heights: a flat between bends, a tube between mitres.
struct Straight {
  Span span;             ///< of the track
  TrackFrame from;       ///< of the floor line where it begins
  double stretch = 1.0;  ///< length of the floor line per length of track
};

/// What stiffeners, lugs and trestles are set on: plates of any section along a track, as they are made.
struct Shell {
  const ArcSpline& track;
  const PlateOptions& options;
  const Placement& placement;
  std::vector<Span> units;          ///< of the track
  std::vector<Straight> straights;  ///< by ascending places; empty: it follows the arcs
  Span whole;                       ///< of the track where every plate is
  double lowest = 0.0;              ///< of the outside, laps included, everywhere [m]
  double highest = 0.0;
  bool ring = false;
  std::function<SectionOutside(double s)> outside;  ///< at a place
  Workshop& workshop;
  TakenUp& taken;  ///< by frames, bolts and whatever is set on it
};

/// @return the floor line at a place, as it is made: on the straight in which it lies deepest, or nearest to; of none, on the track
[[nodiscard]] TrackFrame frame_on(const std::vector<Straight>& straights, const ArcSpline& track, double s);
/// @return the same of a shell
[[nodiscard]] TrackFrame frame_of(const Shell& shell, double s);

/// @return whether the shell keeps within a gap of straight for `half` to both sides of a place
[[nodiscard]] bool keeps_straight(const Shell& shell, double s, double half, double gap);

/// Cost of a place that is none.
inline constexpr double kNoPlace = std::numeric_limits<double>::infinity();
/// What of a place is asked for, besides being free.
struct SeatNeed {
  double taken = 0.0;     ///< half of what it takes up [m]
  double straight = 0.0;  ///< half of what has to be straight, but for the gap of frames [m]
};
/// @return whether a place is free and straight enough
[[nodiscard]] bool is_seat(const Shell& shell, const SeatNeed& need, const Span& within, double s);
inline constexpr int kSeats = 800;  ///< places at which seats are looked for
/// @return the k-th of them, from 0 to kSeats [m]
[[nodiscard]] double seat_place(const Span& within, int k);
/// @param cost  of a place; the least is taken, of equals the first
/// @return none where no place is free
[[nodiscard]] std::optional<double> best_seat(const Shell& shell, const SeatNeed& need, const Span& within,
                                              const std::function<double(double)>& cost);

/// @return what frames leave of a unit
[[nodiscard]] Span between_frames(const Shell& shell, const Span& unit);
/// @return "_2" of the second of several units
[[nodiscard]] std::string unit_suffix(const Shell& shell, std::size_t unit);

/// A plate square to the track.
/// @param region  x across to the left, y up from the floor line
/// @param s       of the middle of its thickness
[[nodiscard]] ShopPart cross_plate(const Shell& shell, const std::string& name, const PlaneRegion& region,
                                   double thickness, double s);

/// Marks what frames take of every unit.
void take_frames(const Shell& shell);

/// A plate square to the track, seen from the side.
struct StandingPlate {
  TrackFrame middle;  ///< of its thickness, on the floor line
  double half = 0.0;  ///< of its thickness [m]
  Span heights;       ///< above the floor line
};
/// @return whether two of them leave room for a weld, as far as they reach: square to straights that meet at a bend they lean together
[[nodiscard]] bool stand_apart(const StandingPlate& a, const StandingPlate& b);
[[nodiscard]] bool all_apart(const StandingPlate& plate, const std::vector<StandingPlate>& others);
/// @return the frames at both ends of every unit
[[nodiscard]] std::vector<StandingPlate> standing_frames(const Shell& shell);

/// Plates round the shell between its ends; of rings in two halves.
/// @return where they stand
std::vector<StandingPlate> add_stiffeners(const Shell& shell);
/// Lugs beside the centre of gravity of each unit: plates across the track that stand on the outside of the tops.
/// @param stiffeners  that they keep off
void add_lugs(const Shell& shell, const std::vector<StandingPlate>& stiffeners);

/// Mass and first moment of what belongs to a unit.
struct UnitMass {
  double mass = 0.0;  ///< [kg]
  Vec3 moment;        ///< [kg m]
};
/// @return one a unit, of all parts listed so far
[[nodiscard]] std::vector<UnitMass> masses_of(const Workshop& workshop, const ArcSpline& track,
                                              const Placement& placement, const std::vector<Span>& units);

}  // namespace glissade::parts
