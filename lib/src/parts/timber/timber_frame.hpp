#pragma once

#include "glissade/parts/shop_part.hpp"
#include "glissade/parts/timber.hpp"

#include "parts/curves/offset_line.hpp"
#include "parts/plates/plate_section.hpp"

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

namespace glissade::parts {

/// A section whose sides stand in templates across the track.
struct TimberTrough {
  PlateSection section;    ///< its sides, each flat
  std::vector<Vec2> seat;  ///< its outside from the left top of the templates round to the right one
};

/// Inside measures of what is built of timber [m].
struct TimberChannel {
  double width = 0.0;        ///< of the floor between the curbs; of a trough, of its templates
  double thickness = 0.0;    ///< of the floor
  double curb_height = 0.0;  ///< 0: none
  double curb_thickness = 0.0;
  std::optional<TimberTrough> trough;

  [[nodiscard]] double overall() const { return width + 2.0 * (curb_height > 0.0 ? curb_thickness : 0.0); }
};
/// @return a slab, U-channel, trapezoid, half-pipe or V-channel of one width; none of others
[[nodiscard]] std::optional<TimberChannel> timber_channel_of(const section::Measures& measures,
                                                             const TimberOptions& options = {});

/// Everything that the parts of one structure are made from.
struct TimberJob {
  const ArcSpline& track;
  TimberChannel channel;
  const TimberOptions& options;
  const Placement& placement;

  [[nodiscard]] double layer() const { return channel.thickness / options.deck.layers; }
  /// @return how many sheets or boards lie side by side
  [[nodiscard]] int strips() const;
  [[nodiscard]] double gap() const { return options.deck.boards ? options.deck.boards->gap : 0.0; }
  [[nodiscard]] double strip_width() const { return (channel.overall() - gap() * (strips() - 1)) / strips(); }
  [[nodiscard]] const StockMaterial& deck_material() const {
    return options.deck.boards ? options.lumber : options.material;
  }
  /// Sheets of a layer have one set of seams; of boards, and of the strips of a trough, every other one has seams of its own.
  [[nodiscard]] std::size_t sets_per_layer() const { return options.deck.boards || channel.trough ? 2 : 1; }
  [[nodiscard]] double member_width() const { return options.member_width(channel.trough.has_value()); }
  /// Height of the upper edge of the bearers.
  [[nodiscard]] double bearer_top() const {
    return -(channel.thickness + options.cross_members.height + options.fit);
  }
  [[nodiscard]] double bearer_bottom() const { return bearer_top() - options.bearer_depth(); }
};

/// A stretch of deck, one sheet long.
struct DeckRow {
  Span span;
  double flat_length = 0.0;  ///< along the neutral fibre [m]
};

/// @return rows of each set of seams: of the upper layer first, of its even boards before its odd ones
[[nodiscard]] std::vector<std::vector<DeckRow>> deck_rows(const TimberJob& job);

/// The seams of one set, apart from those of the set above and of the one beside it.
/// @param done    sets before it
/// @param end_of  where a row ends that begins at a place, for a share of the longest
[[nodiscard]] std::vector<double> seams_of_set(
    const TimberJob& job, const std::vector<std::vector<DeckRow>>& done,
    const std::function<double(double from, double share)>& end_of);

/// A cross member that touches the deck, or a template that touches the lining.
struct CrossMember {
  double at = 0.0;       ///< arc length of its middle [m]
  double top = 0.0;      ///< height of its upper face above the floor line, square to the track there [m]
  double sagitta = 0.0;  ///< by which deck or bearers bend away over its width [m]
};
/// @throws InputError where the track bends so much that the gaps exceed the fit: names the place
[[nodiscard]] std::vector<CrossMember> cross_members(const TimberJob& job,
                                                     const std::vector<std::vector<DeckRow>>& rows);

/// Where bearers stand, and where each is jointed: every other one half a unit farther.
struct BearerPlan {
  std::vector<double> across;   ///< middles, to the left [m]
  std::vector<double> joints;   ///< of the even ones, ends included; arc lengths [m]
  std::vector<double> shifted;  ///< of the odd ones
};
/// @throws InputError if no length of piece fits the stock: names the depth that would
[[nodiscard]] BearerPlan plan_bearers(const TimberJob& job);

/// A post from the ground to the underside of a bearer.
struct Leg {
  double at = 0.0;      ///< arc length of the bearer's point above its middle [m]
  double x = 0.0;       ///< of its middle [m]
  double ground = 0.0;  ///< the highest below its foot, which is level
  Vec2 top_left;        ///< of its slanted upper end
  Vec2 top_right;

  [[nodiscard]] double length() const { return 0.5 * (top_left.y + top_right.y) - ground; }
};
/// @param workshop  is told which rows find no place, and which are left out where bearers lie on the ground
/// @throws InputError where the ground lies above the underside of the bearers, or its line ends before a leg: names the place, by how
///         much
[[nodiscard]] std::vector<Leg> plan_legs(const TimberJob& job, Workshop& workshop);

/// @return angle of the chord of a stretch of track [rad]
[[nodiscard]] double chord_angle(const TimberJob& job, const Span& span);

/// A part that stands in the plane of the track, with the pattern that is cut where it comes from a sheet.
/// @param angle  of what lies level in the part's own plane, in that of the track [rad]
/// @param middles  of the pieces, across to the left [m]
[[nodiscard]] ShopPart upright_part(const TimberJob& job, const ArcPath& outline, double angle, double depth,
                                    const std::vector<double>& middles, const StockMaterial& material);

}  // namespace glissade::parts
