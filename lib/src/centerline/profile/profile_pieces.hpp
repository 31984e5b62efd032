#pragma once

#include "glissade/centerline/clothoid_spline.hpp"
#include "glissade/core/vec.hpp"

#include "centerline/numerics/symmetric_matrix.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace glissade::centerline {

/// How the curvature runs along a piece: zero, constant, linear, as a polynomial of higher degree, or as along a cubic
/// parabola (CubicBend) that begins or ends without curvature.
enum class PieceShape { straight, arc, clothoid, bend, cubic };

/// What a bend has beyond a clothoid: polynomials that vanish at both of its ends.
inline constexpr std::size_t kMostSwellings = 4;

/// How a cubic bend turns, by the share u of its length from its straight end: all of it as series in u^4.
struct CubicShape {
  static constexpr std::size_t kTerms = 15;
  using Series = std::array<double, kTerms>;

  double turn = 0.0;             // upwards
  double turn_by_bending = 0.0;  // its derivative by curvature times length
  Series turned{};               // over u^2
  Series by_turn{};              // of that; over u^2
  Series bending{};              // curvature times length, over u
};

/// One piece of a profile that is put together from few.
struct ProfilePiece {
  PieceShape shape = PieceShape::clothoid;
  double length = 0.0;           // [m]
  double entry_curvature = 0.0;  // [1/m]; of a straight 0
  double exit_curvature = 0.0;   // of an arc the same
  bool tied = false;             // begins with the curvature with which the piece before it ends
  std::size_t swellings = 0;  // of a bend, at least 1: its curvature is a polynomial of degree 1 + swellings
  std::array<double, kMostSwellings> swelling{};  // [1/m]
  CubicShape cubic{};                             // of a cubic bend, as settle_cubic() finds it

  [[nodiscard]] bool constant() const { return shape == PieceShape::straight || shape == PieceShape::arc; }
  /// Whether a cubic bend begins with its curvature and ends without.
  [[nodiscard]] bool backwards() const { return entry_curvature != 0.0; }
  /// Of a cubic bend: finds its shape again after its length or curvature has changed.
  /// @return false if it would turn by more than kMostCubicTurn
  bool settle_cubic();
  /// @param u  place, 0 at the start of the piece, 1 at its end
  [[nodiscard]] double curvature(double u) const;
};

/// The most that a cubic bend of a profile turns by: its turn follows from its length and curvature up to there [rad].
inline constexpr double kMostCubicTurn = 0.52;

/// @return the cubic bend of that length that turns by so much upwards; none beyond kMostCubicTurn
[[nodiscard]] std::optional<ProfilePiece> cubic_piece(double length, double turn, bool backwards);

inline constexpr double kBendAsClothoids = 1e-8;  // accuracy: no noise of points is as small

/// A profile of few pieces with breaks where they have to be: curvature jumps there unless the pieces are tied.
struct PiecewiseProfile {
  double offset = 0.0;  // of the start from the first point, across the curve, positive below it [m]
  double entry = 0.0;   // slope angle at the start
  std::vector<ProfilePiece> pieces;

  [[nodiscard]] double length() const;
  /// @param alike  how far the clothoids of a bend may pass it, as a share of its length
  [[nodiscard]] ClothoidSpline spline(double alike = kBendAsClothoids) const;
  /// @return where the curve starts [m], in the frame of the points
  [[nodiscard]] Vec2 start(Vec2 first_point) const;
};

/// Where a profile bends most.
struct Sharpest {
  double curvature = 0.0;  // its magnitude [1/m]
  double deviation = 0.0;  // its standard deviation, over that of the points [1/m^2]
};

/// Points in order and profiles of few pieces beside them: moves lengths and curvatures of the pieces, and so the
/// breaks between them, to where the squared distances sum up to the least.
class PieceFit {
 public:
  /// @param points  at least 3 [m]
  /// @param places  arc length of each on a curve near them; from 0 on, ascending
  PieceFit(const std::vector<Vec2>& points, std::vector<double> places, PiecewiseProfile profile);

  /// Damped Gauss-Newton steps from the profile so far, until one takes less than this from the sum [m^2].
  void relax(double least_gain, int most_steps);
  [[nodiscard]] const PiecewiseProfile& profile() const { return profile_; }
  /// @return sum of the squared distances [m^2]; the last point counts along the curve, too
  [[nodiscard]] double square_sum() const { return square_sum_; }
  /// @return number of unknowns
  [[nodiscard]] std::size_t freedom() const { return unknowns_; }
  /// How much the sum would grow, to second order, if pieces[joint] began with the curvature that the piece
  /// before it has at its end.
  /// @return none where they are tied, or where nothing is left to tie
  [[nodiscard]] std::optional<double> price_of_tie(std::size_t joint) const;
  /// The same if the piece lost its highest swelling (a bend), or, tied to no other, became an arc (a clothoid) or
  /// a straight (an arc).
  [[nodiscard]] std::optional<double> price_of_simpler(std::size_t piece) const;
  /// The same if pieces[joint] and the one before became one: two of linear curvature that are tied, or two of
  /// constant curvature.
  [[nodiscard]] std::optional<double> price_of_merger(std::size_t joint) const;
  /// @return none for a straight, and where the points leave the pieces undetermined
  [[nodiscard]] std::optional<Sharpest> sharpest() const;

 private:
  /// Unknowns and their weights.
  using Terms = std::vector<std::pair<std::size_t, double>>;
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  /// Which unknown holds a number; kNone where it is zero for good.
  struct Columns {
    std::size_t length;
    std::size_t entry_curvature;
    std::size_t exit_curvature;
    std::size_t first_swelling;
  };
  /// How the slope angle along a piece changes with its entry curvature, its exit curvature, its length and its
  /// swellings.
  static constexpr std::size_t kWays = 3 + kMostSwellings;
  using Ways = std::array<double, kWays>;
  /// A stretch of a piece that turns little, with the integrals over the piece up to it.
  struct Panel {
    double from = 0.0;
    double slope = 0.0;
    Vec2 position;                   // from where the piece begins
    std::array<Vec2, kWays> turned;  // integrals of the ways times the perpendicular of the tangent
  };
  /// A place of a piece.
  struct Place {
    Vec2 position;  // from where the piece begins
    Vec2 tangent;
  };
  [[nodiscard]] static Ways ways_at(const ProfilePiece& piece, double t);
  struct Laid {
    double from = 0.0;  // arc length
    Vec2 start;
    double slope = 0.0;
    std::vector<Panel> panels;
    Panel end;
    // Of where it begins and ends, for every point behind.
    Vec2 tangent;
    Vec2 end_tangent;
    Ways end_ways;
  };
  struct System;

  void number_unknowns();
  void lay_out();
  struct Nodes;
  [[nodiscard]] static const Panel& panel_at(const Laid& laid, double distance);
  [[nodiscard]] static Panel along(const ProfilePiece& piece, const Laid& laid, double distance);
  /// The same place, without what the unknowns do there.
  [[nodiscard]] static Place place_along(const ProfilePiece& piece, const Laid& laid, double distance);
  [[nodiscard]] std::size_t piece_at(double s) const;
  /// Moves the points' places to where the curve is nearest. @return sum of the squared distances
  double project();
  void fill_row(std::size_t piece, const Panel& here, Vec2 position, Vec2 direction, bool at_end,
                std::vector<double>& row) const;
  [[nodiscard]] System linearized() const;
  [[nodiscard]] PiecewiseProfile moved(const std::vector<double>& move) const;
  [[nodiscard]] std::optional<double> variance_of(const Terms& terms) const;
  [[nodiscard]] std::optional<double> price(const Terms& terms, double value) const;

  std::vector<Vec2> points_;
  std::vector<double> places_;
  PiecewiseProfile profile_;
  std::vector<Columns> columns_;
  std::size_t unknowns_ = 0;
  std::vector<Laid> laid_;
  double square_sum_ = 0.0;
  double scale_ = 1.0;
  mutable std::optional<SymmetricMatrix> factor_;
};

}  // namespace glissade::centerline
