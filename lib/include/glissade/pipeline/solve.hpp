#pragma once

#include "glissade/centerline/centerline.hpp"
#include "glissade/centerline/constant_speed_curve.hpp"
#include "glissade/clearance/envelope.hpp"
#include "glissade/core/units.hpp"
#include "glissade/design/design.hpp"
#include "glissade/motion/motion.hpp"
#include "glissade/pipeline/track.hpp"
#include "glissade/section/cross_section.hpp"
#include "glissade/trades/chute/ends.hpp"
#include "glissade/trades/chute/hood.hpp"
#include "glissade/trades/chute/wear.hpp"

#include <optional>
#include <string>
#include <vector>

namespace glissade {

/// The first half of the one way that data flow: design -> centerline -> motion.

/// Where a design's track leads, in the plane of its centerline. Of a free finish it is some place within its
/// range.
[[nodiscard]] Endpoints endpoints_of(const Design& design);

/// What slides or rolls, as Motion takes it.
/// @throws InputError if a measure of the body breaks its bound, or if something of the hood is still to be chosen
[[nodiscard]] Body body_of(const Design& design);

/// The design that a track is of: with the hood and the start that its search chose. body_of(), feed_fall() and what stands on them
/// take such a design.
[[nodiscard]] Design as_solved(Design design, const Track& track);

/// How the stream of a design passes its hood.
/// @param design  with a hood, of which nothing is left to choose
/// @param body    body_of() the design, or one with another friction or flow
[[nodiscard]] HoodPassage hood_passage(const Design& design, const Body& body);

/// How far before (negative) and behind the start of a track its streams come down, the nominal one on the start [m].
/// @param design  with a hood, solved
[[nodiscard]] Range landing_spread(const Design& design, const Track& track);

/// From the pulley to the finish by all three ways: feed, hood, track [s].
/// @param design  with a hood
[[nodiscard]] double transfer_time(const Design& design, const Motion& motion);

/// How the feed of a design comes down on its start, or on its hood where it has one; where it comes from is seen from
/// the start in either case.
/// @param design  with a feed
[[nodiscard]] FeedFall feed_fall(const Design& design);

/// How the stream of a ride comes down on the start of its track, at the density that it has on that ride.
/// @param motion  of a stream
/// @return none of one that enters along the track, or flies over the start (lands()); of one that stands where it lands the
///         impact that takes all of its speed
[[nodiscard]] std::optional<Impact> impact_of(const Motion& motion);

/// How the stream of a ride lands on the belt of a design, at the density that it has on that ride.
/// @param design  with a discharge
/// @param motion  of a stream, arrived
[[nodiscard]] BeltLanding belt_landing(const Design& design, const Motion& motion);

/// Where the stream of a track wears its chute, and at which frictions of the design.
struct WearAtFrictions {
  WearFacts facts;
  FrictionLevel level = FrictionLevel::nominal;          ///< at which the floor wears most
  FrictionLevel pressed_level = FrictionLevel::nominal;  ///< at which a liner gets thinner fastest
};
/// Over every friction of the range at which it gets onto its track (enters()): the ends, the nominal one, and where the floor
/// wears more at one between them (friction_of_most_wear()) that, too.
/// @param track  of a design with a stream
/// @return facts whose numbers of rides mean nothing, which the levels tell instead; nothing worn where none enters
[[nodiscard]] WearAtFrictions wear_at_frictions(const Track& track);

/// How fast a liner gets thinner where it wears most.
struct LinerLoss {
  double per_1000_h = 0.0;     ///< [m]
  double per_megatonne = 0.0;  ///< of material that passes [m]
  double life_hours = 0.0;     ///< until it is worn through
};

/// @return none for a stream whose design tells of no liner plate, or that nothing rubs
[[nodiscard]] std::optional<LinerLoss> liner_loss(const Design& design, const WearFacts& wear);

/// A design as the optimiser takes it: run and drop from the start.
[[nodiscard]] Problem problem_of(const Design& design);

/// What the clearances of a design are measured from: the solid of its cross_section and the headroom; all 0
/// where that is the centerline, or where nothing is kept clear of.
/// @throws InputError if the measures do not make a cross-section
[[nodiscard]] Envelope envelope_of(const Design& design);

/// A part of a design's envelope in words: "wall rim", "underside", "finish face".
[[nodiscard]] std::string part_text(const Design& design, EnvelopePart part);

/// A design whose finish is where its centerline ends, for those that leave it to `segments` or `points`;
/// with it, other kinds of centerline can be put in its place.
/// @throws as make_centerline()
[[nodiscard]] Design with_finish(Design design);

/// The curve that a design asks for, its limits left aside.
/// @throws InputError, InfeasibleError, ConvergenceError, FileError with the location in the design
[[nodiscard]] CenterlinePtr make_centerline(const Design& design);

/// @param body  how it enters does not count
/// @return sqrt(P), where such a body that is fed at this speed keeps it all along [m/s]; none with drag, of a body whose
///         friction is not that of the curve, of other laws, and on a crest that does not hold a body
[[nodiscard]] std::optional<double> kept_speed(const ConstantSpeedCurve& curve, const Body& body);

/// The ride of the design's body down a given centerline, what it is measured by, and its limits checked.
/// @param context  its measures_optimum alone counts
[[nodiscard]] Track ride(const Design& design, CenterlinePtr centerline, const RunContext& context = {});

/// The same design at one other friction, without a range. Where friction changes along the track it is that of the start, and the
/// others change by the same angle.
/// @param length  of its track, as far as it is known [m]: what begins beyond has no effect, and may be any
/// @throws InputError at the friction that would then lie below 0 or above 89.994 deg, as none may
[[nodiscard]] Design with_friction(Design design, const Friction& friction, double length);

/// A track that stays as it is, ridden by its design with_friction(): nothing is searched or chosen anew. Its limits are held against
/// that friction alone.
/// @param design      where the track and the rest of the body come from
/// @param centerline  a track of that design
/// @throws InputError as with_friction()
[[nodiscard]] Track ride_at(Design design, const CenterlinePtr& centerline, const Friction& friction);

/// The friction angle from which on a track's body stalls on it: stall_friction_angle() of the nominal ride; none, too, of a
/// feed that flies over the start.
[[nodiscard]] std::optional<Angle> stall_angle_of(const Track& track);

/// Design to centerline and motion. With limits, the kind fastest is searched for within them, and so it is for a
/// body that is not a sliding point; on other kinds
/// they are checked. A body that stalls or leaves the track is a result, not an error, and so is a broken
/// limit, or a search that ends early with a track (Track::search).
/// @throws InputError with everything that check() finds; LimitsConflict if no track keeps the limits; NoTrackFound
///         if none was found, or not in time; Interrupted if the search was stopped before it found one; else as
///         make_centerline()
[[nodiscard]] Track solve(const Design& design, const RunContext& context = {});

/// @return what to call a track that was searched for: "fastest within the limits", "of the highest exit speed within the limits", "fastest, searched for"
///         where the search had another reason (drag, a free finish)
[[nodiscard]] std::string searched_name(const Design& design);

/// The ride that keeps a track from being what was wanted, at a friction of its range.
/// @return one that flies over the start first, else the nominal one, low, high; none if all arrive
[[nodiscard]] std::optional<LevelRide> ride_that_fails(const Track& track);

/// Why a ride is not what was wanted: the body stalls or leaves the track, or its law ends.
/// @return the problem with the place and what is missing there; none if the body arrives
[[nodiscard]] std::optional<Issue> ride_problem(const Design& design, const Track& track);

/// Where a law holds no longer although the ride goes on: a ball that slips.
/// @return the problem with the place and what is missing; none where the law holds all along
[[nodiscard]] std::optional<Issue> law_problem(const Design& design, const Track& track);

/// Why a track is not what its limits ask for.
/// @return the problem, every broken limit with the place and by how much; none if all are kept
[[nodiscard]] std::optional<Issue> limits_problem(const Design& design, const Track& track);

/// Whether a search within limits, or that for a hood, ended before it converged.
/// @return how it ended and what that means; none if it converged, or there was none
[[nodiscard]] std::optional<Issue> search_problem(const Design& design, const Track& track);
/// @param interrupted  whether it was asked to; else its time ran out
/// @return what lets a search that ended early come to its end
[[nodiscard]] std::string hint_to_search_on(bool interrupted);

/// What a user should hear of beside a sound answer: something asked for that had no effect, or data that may
/// not say what they seem to.
[[nodiscard]] std::vector<Issue> warnings(const Design& design, const Track& track);

}  // namespace glissade
