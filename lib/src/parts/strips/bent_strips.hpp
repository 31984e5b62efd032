#pragma once

#include "glissade/parts/plates.hpp"

#include "parts/bodies/facets.hpp"
#include "parts/plates/plate_section.hpp"
#include "parts/strips/strip_shape.hpp"

#include <cstddef>
#include <numbers>
#include <optional>
#include <vector>

namespace glissade::parts {

/// A strip of a unit with the lengths of its developed edges.
struct Strip {
  std::size_t plate = 0;
  std::size_t unit = 0;
  Span span;
  std::size_t first = 0;  ///< of a bent one: its first and last station
  std::size_t last = 0;
  ShopPart part;
  std::vector<BendStep> steps;
  double edge_from = 0.0;  ///< at the side of `face_from` [m]
  double edge_to = 0.0;
  std::optional<double> edge_mismatch =
      std::nullopt;      ///< of one whose edges are not those of the section [m]
  double pressed = 0.0;  ///< of a rolled one, Development::pressed [m]
  double sprung = 0.0;   ///< of a bent one that springs(): the largest angle between its flats, else 0 [rad]
};

/// Whether a plate springs into place without bends. On every other one each bend of the line is pressed, as its lean from upright
/// leaves it: floors, which the body rides, have all of them.
/// @param tightest  radius that its bends average, where that is least [m]
[[nodiscard]] bool springs(const SectionPlate& plate, double tightest, double thickness);

/// An angle that nobody bends [rad].
inline constexpr double kNoBend = 1e-6;

/// @return inner radius of the bends of a plate
[[nodiscard]] double inner_radius_of(const StripJob& job, double thickness);
/// @return by how much both flats of a bend together are shorter on the flat than up to their corner, in the middle of the thickness
[[nodiscard]] double bend_cut(const StripJob& job, double thickness, double angle);

/// @return how short a flat may be [m]
[[nodiscard]] double least_bent_flat(const StripJob& job);
/// @return flats of a stretch by the rule of the job
[[nodiscard]] Facets bent_flats(const StripJob& job, const Span& span, double largest_kink);

/// Every plate of a section as flats between bends, beside one width or one that changes.
///
/// Flats touch the track; each plate's facets meet at the plane that halves the angle of a bend. With T along a flat, N its normal
/// and b' the taper of a half of the section, a facet whose ruling is N + l Y is plane if its edges run along T + b' Y at every
/// height; facets meet in one line at a bend of angle phi if there
///
///     l' = l - (b' + b'') tan(phi/2)
///
/// - what l' = -kappa b' of rolled plates becomes (strip_shape.hpp). Bends are without a radius in bodies; in patterns they have the
/// allowance of the punch: (r + K t) theta in place of 2 (r + t/2) tan(theta/2) in the middle of the thickness.
class BentStrips {
 public:
  /// @param largest_kink  as facets_by_rule()
  /// @throws InputError as facets_by_rule()
  BentStrips(const StripJob& job, double largest_kink, const std::vector<double>& joints);

  /// @throws InputError where a plate is higher than flats of a hollow are long: the place, a height that would do
  [[nodiscard]] std::vector<Strip> strips() const;
  /// Plates set on the section, unit by unit: they follow its flats and bends.
  /// @param thickness  of their stock [m]
  /// @param taken      by frames, from the planes of each unit's ends on [m]
  /// @throws InputError as strips()
  [[nodiscard]] std::vector<Strip> set(const SectionPlate& plate, double thickness, double taken);
  /// @return out per height where a unit begins or ends
  [[nodiscard]] double lean_at(double s) const;
  /// How a half of the section stands on a flat, square to it.
  struct Half {
    double wide = 0.0;  ///< as StripArc has it
    double lean = 0.0;  ///< out per height
  };
  /// @param at  on the floor line; off it, the flat nearest to that counts
  [[nodiscard]] Half half_at(Vec2 at) const;
  [[nodiscard]] const std::vector<Facets>& facets() const { return facets_; }
  [[nodiscard]] std::size_t bends() const;
  /// @return by how much a side lies off the width that is asked for, where that begins to change beside a bend [m]
  [[nodiscard]] double departure() const { return departure_; }

  /// @return the volume of a strip's plate in closed form, and the lengths of its edges: by heights above the flats
  struct Expected {
    double volume = 0.0;
    double edge_from = 0.0;
    double edge_to = 0.0;
  };
  [[nodiscard]] Expected expected(const Strip& strip) const;

 private:
  /// Where two flats meet, a unit ends, or the width begins or ends to change.
  struct Station {
    double s = 0.0;
    Vec2 at;    ///< of the floor line, in the frame (x, height)
    Vec2 rise;  ///< per height above the flats, along the plane in which they meet
    double kink = 0.0;
    double miss = 0.0;
    double wide = 0.0;  ///< as StripArc has it
    double lean = 0.0;  ///< out per height above the flats
  };
  /// Stations from one to another.
  struct Stretch {
    std::size_t first = 0;
    std::size_t last = 0;
  };
  /// A facet on the flat: its edges from a base along x, and where its rulings point.
  struct Quad {
    Vec2 base;
    Vec2 upper;
    double from = 0.5 * std::numbers::pi;  ///< heading of the first ruling from x [rad]
    double to = 0.5 * std::numbers::pi;
  };
  struct Bend {
    double angle = 0.0;  ///< positive towards the face
    double before =
        0.0;             ///< by which the flat before it is shorter than it is up to the corner, square to it
    double after = 0.0;  ///< and the one after it
    bool pressed = false;
  };

  void add_unit(const Facets& facets);
  /// Where the width begins or ends to change on a flat, it is folded; too near a bend for that, it changes there.
  void add_knots(const Facets& facets, std::size_t flat, const FlatPlaces& places);
  void lean_facets();
  [[nodiscard]] double flat(std::size_t i) const { return norm(stations_[i + 1].at - stations_[i].at); }
  [[nodiscard]] double taper(std::size_t i) const;
  /// @return how rulings square to flat i lean, out per height: all alike
  [[nodiscard]] double square_lean(std::size_t i) const;
  /// @return by how much flat i is shorter per height above it
  [[nodiscard]] double narrowing(std::size_t i) const;
  [[nodiscard]] Vec3 place(const Station& station, Vec2 corner) const;
  [[nodiscard]] Stretch stretch_of(const SectionPlate& plate, const Stretch& unit) const;
  /// The flats of a unit from one of its ends on.
  struct SideOfUnit {
    std::size_t joint = 0;  ///< the station of that end
    std::size_t from = 0;   ///< where a plate begins, and where it ends at the latest
    std::size_t to = 0;
    bool downstream = true;  ///< the way from the end on
  };
  /// An end that stands square on a flat, clear of the frame.
  struct SquareEnd {
    Station station;
    std::size_t flat = 0;  ///< the station from which that flat leads on
  };
  /// @param taken  by the frame, from the joint's plane on [m]
  [[nodiscard]] std::optional<SquareEnd> square_end(const SectionPlate& plate, double taken,
                                                    const SideOfUnit& side) const;
  /// @return a unit without its ends, as stations of its own; none where nothing is left
  [[nodiscard]] std::optional<Stretch> trimmed(const SectionPlate& plate, const Stretch& unit, double taken);
  [[nodiscard]] std::vector<Bend> bends_of(const SectionPlate& plate, double thickness,
                                           const Stretch& stretch) const;
  [[nodiscard]] Strip strip_of(const SectionPlate& plate, double thickness, const Stretch& stretch) const;
  [[nodiscard]] FoldedPlate body_of(const SectionPlate& plate, const Stretch& stretch) const;
  /// Gives a fold on a flat no more of it than there is: the flat on its other side has the rest.
  void share_fold(const SectionPlate& plate, const Stretch& stretch, std::size_t fold,
                  std::vector<Bend>& bends) const;
  /// @param cut_from,cut_to  by its bends
  [[nodiscard]] Quad quad(const SectionPlate& plate, std::size_t i, double cut_from, double cut_to) const;
  [[nodiscard]] double widened_volume(const SectionPlate& plate, std::size_t i) const;
  void develop(const SectionPlate& plate, double thickness, const Stretch& stretch, Strip& strip) const;

  const StripJob& job_;
  std::vector<Facets> facets_;
  std::vector<Station> stations_;  ///< those of a unit, then those of the next
  std::vector<Stretch> units_;
  double departure_ = 0.0;
};

/// What rules of the shop may bound of bends and the flats between them.
void measure_bends(const std::vector<Strip>& strips, const PlateOptions& options, Workshop& workshop);

}  // namespace glissade::parts
