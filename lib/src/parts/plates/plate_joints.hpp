#pragma once

#include "parts/plates/plate_unit.hpp"

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace glissade::parts {

/// Of one track.
inline constexpr std::size_t kMostUnits = 400;

/// Why a part cannot be had in one piece.
struct Excess {
  std::string what;
  std::string bound;
  double times = 1.0;   ///< what may be, of a length or mass that shorter units make smaller
  std::string way_out;  ///< the sheet or the mass that takes it
  /// Units so short that it lies across the sheet may make it fit, and until they are its measures across stay as they are.
  bool turns = false;
};

/// How a pattern lies on a sheet, as nests lay it: along the axes of its drawing or, where that does not fit, of its least rectangle.
/// @param sheet  longer side first [m]
/// @return its length and width there, the longer one first [m]
[[nodiscard]] Vec2 laid_size(const ArcPath& outline, Vec2 sheet);

[[nodiscard]] std::optional<Excess> excess(const SplitOptions& split, const ShopPart& part);
[[nodiscard]] bool is_too_heavy(const ShopPart& part, const SplitOptions& split);
/// @param lightest  mass to which it can be had [kg]
/// @throws InputError of split.heaviest
[[noreturn]] void throw_too_heavy(const ShopPart& part, double heaviest, double lightest,
                                  const std::string& why);
/// Of what exceeds, the part that does so most: shorter units are judged by one measure.
/// @param part  its name, put before what it takes
void keep_worse(std::optional<Excess> found, const std::string& part, std::optional<Excess>& worst);

/// Calls `make` with growing counts of units until no part exceeds what is allowed.
/// @param make  units of a count: returns what exceeds, none if nothing does
/// @throws InputError naming the part and what it exceeds, where that is not to be had
void split_until_it_fits(const SplitOptions& split, double length,
                         const std::function<std::optional<Excess>(std::size_t)>& make);

/// A unit between two joints.
struct Unit {
  Span span;
  ShopPart floor;
  std::optional<ShopPart> wall;
  FloorFace face;
  std::vector<BendStep> steps;
  std::vector<Span> tabs = {};  ///< along the face, of floor or walls
};

/// Units of about even length, their ends where the track bends least nearby, as few as sheet, transport and mass allow.
/// @param largest_kink  of a bent floor; whatever else the rule gives where the rule is another
/// @throws InputError naming the part and what it exceeds, where that is not to be had
[[nodiscard]] std::vector<Unit> split_units(const Job& job, double largest_kink);

/// The largest turning of one bend at which the bends cost no more than their share of the exit speed; that of the rule
/// where it is another one.
/// @param facets  of the whole track, by their largest turning
[[nodiscard]] double kink_for_speed(const ArcSpline& track, const BendOptions& bend,
                                    const std::function<Facets(double)>& facets, const Body& body,
                                    double gravity, double design_speed);

/// A note where bends cost more of the exit speed than is asked for: how much, why, and what would do.
/// @param least    length of a flat that the shop makes [m]
/// @param or_else  another way out, after a comma; may be empty
void tell_missed_speed(const BendOptions& bend, const std::vector<Facets>& units, double least,
                       const std::string& or_else, const Body& body, double gravity, double design_speed,
                       Workshop& workshop);

/// @return flats of a stretch by a rule
/// @param least,least_end  as facets_by_angle()
[[nodiscard]] Facets facets_by_rule(const ArcSpline& track, const Span& span, const BendOptions& bend,
                                    double largest_kink, double least, double least_end = 0.0);

/// Refuses units so short that the frames at their ends would meet.
/// @param lowest,highest  of the section, from the floor line [m]
/// @throws InputError of what split them, naming the unit, the room that frames take and ways out
void require_units_longer(const ArcSpline& track, const std::vector<double>& joints,
                          const PlateOptions& options, double lowest, double highest);

/// Refuses the leg of an angle that stands across a bend by more than its gap.
/// @param facets  of a unit
/// @throws InputError naming the place, the flat there and ways out
void require_end_flats(const Span& unit, const Facets& facets, const FlangeOptions& frame);

/// @return that of flats at the ends of a unit along which the leg of an angle stands [m]; 0 of other frames
/// @param more  as for least_flat()
[[nodiscard]] double least_end_flat(const PlateOptions& options, double more);
/// @return the least length of flats: what the shop's press holds, and those at the ends of a unit no shorter than its frame is thick
/// @param more  for plates that lie off the floor line [m]
[[nodiscard]] double least_flat(double thickness, const PlateOptions& options, double more);

/// Refuses frames that are so thick that the channel bends out of their gap within them: below on a crest, above in a hollow.
/// @param joints   arc lengths of the units' ends
/// @param lowest   of the section's outside
/// @param highest  of that of a closed one
/// @throws InputError naming the place and the gap that would do
void require_frame_room(const ArcSpline& track, const std::vector<double>& joints, const FlangeOptions& frame,
                        double lowest, std::optional<double> highest);

/// Places of joints of about even distance, where the track bends least nearby.
[[nodiscard]] std::vector<double> joints_of(const ArcSpline& track, const SplitOptions& split,
                                            std::size_t count);

/// @return the flats of a unit by the rule of the job
[[nodiscard]] Facets facets_of(const Job& job, const Span& span, double largest_kink);

}  // namespace glissade::parts
