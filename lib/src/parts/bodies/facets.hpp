#pragma once

#include "glissade/parts/arc_spline.hpp"
#include "glissade/parts/plates.hpp"

#include "parts/curves/offset_line.hpp"

#include <memory>
#include <string>
#include <vector>

namespace glissade::parts {

/// A bent floor: flats that touch the track from below in a hollow, from above on a crest, and meet at bends.
struct Facets {
  std::vector<double> touches;  ///< arc lengths of the track where flats touch it, with both ends [m]
  std::vector<Vec2> corners;    ///< where flats meet, with both ends, in the frame (x, height)
  std::vector<double> kinks;    ///< at the corners between, positive where the floor curls up [rad]
  std::vector<double> misses;   ///< distance of those corners from the track [m]

  [[nodiscard]] std::size_t bends() const { return kinks.size(); }
};

/// Places on a track and those of flats that stand for them, along the line of the flats.
///
/// A place on a flat stands for the one on the track whose foot it is; a corner for the place of the track nearest to it. Exact where
/// a flat touches, along straight pieces of the track that lie on one, and where arcs meet; linear between.
///
/// Accuracy: off the foot by at most kFlatPlacesAccuracy times the farthest that flats lie off the track.
/// Identity: both ways are ascending and each other's inverse.
struct FlatPlaces {
  std::vector<double> on_track;  ///< ascending [m]
  std::vector<double> on_flats;  ///< of each, from where the flats begin; ascending [m]
  std::vector<double> corners;   ///< places on the track of the flats' corners, with both ends [m]

  /// @return the place along the flats of one on the track, and the other way round
  [[nodiscard]] double flats_at(double s) const;
  [[nodiscard]] double track_at(double place) const;
};
inline constexpr double kFlatPlacesAccuracy = 1.0;  // measured: 15,000 lines of flats beside random tracks
[[nodiscard]] FlatPlaces flat_places(const ArcSpline& track, const Facets& facets);

/// Flats over a stretch of track, tangent to it at both ends.
/// @param largest_kink  [rad]; > 0. Larger where flats would be shorter than `least_flat`
/// @param least_flat    that a press can hold [m]; >= 0
/// @param least_end     of the flats at both ends, as far as there is more than one bend [m]
[[nodiscard]] Facets facets_by_angle(const ArcSpline& track, const Span& span, double largest_kink,
                                     double least_flat, double least_end = 0.0);
/// @param longest  flats between two bends, about [m]; > 0
[[nodiscard]] Facets facets_by_length(const ArcSpline& track, const Span& span, double longest,
                                      double least_flat, double least_end = 0.0);
/// @param tolerance  greatest distance of a corner from the track [m]; > 0
[[nodiscard]] Facets facets_by_chord(const ArcSpline& track, const Span& span, double tolerance,
                                     double least_flat, double least_end = 0.0);

/// The finished floor's upper face: flats and bends round the punch.
/// @param inner_radius  of every bend; on a crest the upper face has thickness more
/// @return as an ArcSpline from its own origin
/// @throws InputError if a flat is shorter than its bends take: names the flat
[[nodiscard]] ArcSpline bent_face(const Facets& facets, double inner_radius, double thickness);

/// A body down the flats one by one; at each corner that curls up the speed falls to cos phi - mu sin phi of it, without
/// a rebound. At one that falls away it flies on until it comes down on a flat behind it, and keeps there what is along that
/// less mu of what is not; over the end of the floor it arrives in flight. A body that is held keeps cos phi. Where the load on an
/// arc comes to nothing it flies, too.
struct FacetRide {
  bool arrives = false;
  double time = 0.0;
  double speed = 0.0;
  double highest_load = 0.0;
  std::size_t hops = 0;
  double highest_hop = 0.0;  ///< above the floor [m]
  std::string stopped;       ///< of one that does not arrive: what ends it, and where
};
/// @param joint_step  by which the floor drops from unit to unit; landing costs mu sqrt(2 g d) of the speed [m]
[[nodiscard]] FacetRide ride_facets(const std::vector<Facets>& units, const Body& body, double gravity,
                                    double joint_step);

/// The same down the arcs of rolled floors.
[[nodiscard]] FacetRide ride_lines(const std::vector<std::shared_ptr<const ArcSpline>>& units,
                                   const Body& body, double gravity, double joint_step);

}  // namespace glissade::parts
