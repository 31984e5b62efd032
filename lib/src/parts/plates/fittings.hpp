#pragma once

#include "parts/curves/offset_line.hpp"
#include "parts/plates/plate_joints.hpp"

#include <functional>
#include <utility>
#include <vector>

namespace glissade::parts {

/// Stretches of the track that something below or beside the channel takes up already.
class TakenUp {
 public:
  void add(double from, double to) { spans_.push_back({from, to}); }
  /// @return whether nothing lies within `half` of a place, which does so inside a span
  [[nodiscard]] bool is_free(double s, double half, const Span& within) const;
  /// @return the place nearest to `about` with nothing within `half` of it, inside a span; none if there is none
  [[nodiscard]] std::optional<double> free_place(double about, double half, const Span& within) const;

 private:
  std::vector<Span> spans_;
};

/// What is set on the channel of a job, unit by unit, and listed in its workshop.
struct Fitting {
  const Job& job;
  const std::vector<Unit>& units;
  Workshop& workshop;
  TakenUp& below;  ///< by frames, bolts and stiffeners
};

/// @return the place nearest to an end of a unit whose whole plane, up to a height, is clear of what stands there
/// @param taken  by that, along the track [m]
/// @param sense  +1 from the upstream end, -1 from the downstream one
[[nodiscard]] double beyond_frame(const ArcSpline& track, double taken, double end, double sense,
                                  double high);
inline constexpr double kLeastOpening = 20e-3;  ///< that is proposed where one is too high [m]
inline constexpr double kAsideOfFrame = 1e-3;   ///< between a rim and the frame that it ends before [m]

/// @return how far a lid reaches beyond its opening, all round: its bolts, in the middle, are as far off both edges as the shop
///         asks [m]
[[nodiscard]] double lid_lap(const InspectionOptions& opening, const ShopLeast& shop);

/// @return the heights above the floor line between which an opening and its lid lie
[[nodiscard]] Span lid_heights(const Job& job, const InspectionOptions& opening);

/// What no shop can make of stiffeners, lugs and trestles, whatever they are set on.
[[nodiscard]] std::vector<Issue> set_on_problems(const PlateOptions& options);
/// What no shop can make of openings, but for their places.
[[nodiscard]] std::vector<Issue> opening_value_problems(const PlateOptions& options);
/// What no shop can make of tiles on a lane.
/// @param lane  its width as `width`
[[nodiscard]] std::vector<Issue> liner_problems(const ChannelMeasures& lane, const PlateOptions& options);
/// Of a cover and the rims that it lies on, but for their places.
[[nodiscard]] std::vector<Issue> cover_problems(const PlateOptions& options);

/// Holes through a plate of one width that follows the track: its body becomes a sheet. Its pattern gets none.
/// @param part   as upright_plate() makes it of a band
/// @param upper  height of its upper face above the track, at which it folds nowhere
/// @param holes  (place along the track, along z of the part) [m]
void drill_plate(const Job& job, const Span& span, double upper, double width,
                 const std::vector<Circle>& holes, ShopPart& part);

/// @return distance along a flat that develops an offset of the track, from its downstream end [m]
/// @param height  of the neutral line above the floor line
[[nodiscard]] double flat_from_end(const ArcSpline& track, const Span& span, double height, double s);

/// @return how long a length of track is at least on an offset of it, between two places; at least a tenth
[[nodiscard]] double least_stretch(const ArcSpline& track, const Span& span, double height);

/// A stretch in as few even pieces as fit, a gap between two of them; whole where no number of them does.
/// @param seams  where pieces may end
[[nodiscard]] std::vector<Span> pieces_that_fit(const Span& span, const OnOneArc& seams,
                                                const std::function<bool(const Span&)>& fits);
/// Refuses a cover of which no shorter pieces fit.
/// @throws InputError of cover: what it takes, the bound, ways out
void require_cover_fits(const ShopPart& piece, const PlateOptions& options);
inline constexpr double kLidGap = 1e-3;  ///< between the pieces of a cover [m]

/// How far a cover's first bolts are from the ends of its unit: `least` where no one arc is nearer to the usual place [m].
struct CoverEnds {
  double usual = 40e-3;
  double least = 20e-3;
};
/// @param stretch  of the rim and the cover at the ends of the unit, as least_stretch() has it
[[nodiscard]] CoverEnds cover_ends(const PlateOptions& options, double stretch);
inline constexpr double kEndOfCover = 0.2;  ///< of a unit, in which its first bolts stand [m]

/// Flat bars along the outsides of the walls' tops.
void add_rims(const Fitting& fitting);
/// Plates round the channel between its ends.
void add_channel_stiffeners(const Fitting& fitting);
/// Lids over the rims, bolted to them.
void add_covers(const Fitting& fitting);
/// Openings in the left walls, with lids.
void add_openings(const Fitting& fitting);
/// Lugs beside the centre of gravity of each unit, on the walls.
void add_channel_lugs(const Fitting& fitting);
/// Holes of the liner's bolts in the floors' patterns, before they are listed.
void drill_floors(const Job& job, std::vector<Unit>& units);
/// Tiles on the floor, their upper faces the track.
void add_liner(const Fitting& fitting);

/// What no shop can make of fittings, whatever the track is.
[[nodiscard]] std::vector<Issue> fitting_problems(const ChannelMeasures& channel,
                                                  const PlateOptions& options);

}  // namespace glissade::parts
