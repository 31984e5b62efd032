#pragma once

#include "glissade/motion/law.hpp"
#include "glissade/motion/motion.hpp"

#include "optimize/dense.hpp"

#include <cstddef>
#include <vector>

namespace glissade::optimizer {

/// Everything in this folder but the facade is in units of a chord and of sqrt(chord/gravity): gravity is 1.

/// The unknowns of a clothoid spline between optional straight ends, as offsets into one vector:
///   [0] entry slope angle zeta_0 [rad]
///   [1 .. knots] turning rates c_i = core_length kappa_i at the knots sigma_i, linear in between [rad]
///   [knots + 1] core_length [chords]
/// With them zeta is linear in (zeta_0, c), whatever the length.
struct Layout {
  std::size_t knots = 0;
  [[nodiscard]] std::size_t angle() const { return 0; }
  [[nodiscard]] std::size_t turn(std::size_t knot) const { return 1 + knot; }
  [[nodiscard]] std::size_t length() const { return 1 + knots; }
  [[nodiscard]] std::size_t size() const { return 2 + knots; }
};

/// Where the curvature's knots lie and how the track is cut for quadrature.
struct Mesh {
  Vector knots;         ///< sigma, ascending from 0 to 1: shares of the core length
  Vector extra_breaks;  ///< further sigma at which limits are to be held exactly
  /// Sigma, ascending, none of them a knot: here the curvature has further knots, which go along with those
  /// around them, ...
  Vector fine;
  Vector fine_turns;         ///< ... but for this turning rate each, which is no unknown [rad]
  double lead_in = 0.0;      ///< straight before the core [chords]
  double lead_out = 0.0;     ///< straight after it
  double core_length = 1.0;  ///< of the guess: places the nodes of the substitution only
  double entry_speed2 = 0.0;
  double centre_height = 0.0;  ///< of the body: no track turns upwards more tightly
};

enum class Part { lead_in, core, lead_out };

/// A point of the track at which the state is known: s = fixed_length + sigma core_length.
struct Station {
  double fixed_length = 0.0;
  double sigma = 0.0;
  std::size_t piece = 0;   ///< between knots piece and piece + 1
  double share = 0.0;      ///< of the way between these knots
  Part part = Part::core;  ///< curvature is 0 outside the core
  bool watched = true;     ///< limits are held here; enough of them that little happens in between
  [[nodiscard]] double arc_length(double core_length) const { return fixed_length + sigma * core_length; }
};

/// What slides, scaled.
struct Ride {
  double friction = 0.0;      ///< mu
  double entry_speed2 = 0.0;  ///< v at the start
  double drag = 0.0;          ///< k [1/chord]
  double gain = 2.0;          ///< 2/f
  double height = 0.0;        ///< h, of the centre of mass above the track [chords]
  double head_wind = 0.0;     ///< [sqrt(gravity chord)]
  /// How it comes down on the start, in these units; entry_speed2 is then that before the impact.
  std::optional<Landing> landing;
  /// Above 0: what counts as time is not 1/u, but how uneven the speed is (evenness()).
  double even_speed = 0.0;
  LawPtr law = nullptr;  ///< where c depends on the speed, in these units; none otherwise

  /// kappa v/(1 - kappa h): what curvature adds to the load, and its derivatives.
  struct CurvatureLoad {
    double value = 0.0;
    double by_curvature = 0.0;
    double by_v = 0.0;
    double by_curvature_curvature = 0.0;
    double by_curvature_v = 1.0;
  };
  [[nodiscard]] CurvatureLoad curvature_load(double curvature, double v) const {
    if (height == 0.0) return {curvature * v, v, curvature, 0.0, 1.0};
    const double path = 1.0 - curvature * height;
    return {curvature * v / path, v / (path * path), curvature / path,
            2.0 * height * v / (path * path * path), 1.0 / (path * path)};
  }

  /// Coulomb's law, whose flow has a closed integrating factor.
  [[nodiscard]] bool sliding_point() const {
    return !landing && gain == 2.0 && height == 0.0 && head_wind == 0.0 && law == nullptr;
  }
};

/// A further knot of the curvature, between two that are unknowns.
struct FineKnot {
  double sigma = 0.0;
  std::size_t piece = 0;
  double share = 0.0;  ///< of the way through the piece
  double turn = 0.0;   ///< turning rate beyond what lies between the knots of the piece [rad]
};

/// Geometry at every station, with derivatives by the unknowns.
struct Shape {
  Vector zeta, sin, cos, x, y, curvature;
  Matrix dx, dy;
};

/// The point of a track that is closest to another point.
struct Foot {
  Station at;
  std::size_t base = 0;     ///< a station between which and `at` curvature is linear
  std::size_t towards = 0;  ///< the station on the other side
  double share = 0.0;       ///< of the way from base to towards
  double x = 0.0;
  double y = 0.0;
  double sin = 0.0;
  double cos = 1.0;
  bool end = false;  ///< the start or the finish, the target lying beyond it
};

/// Motion at every station for one friction, with derivatives by the unknowns.
struct Flow {
  Vector v;  ///< squared speed
  Matrix dv;
  double time = 0.0;
  Vector dtime;
};

/// How strongly the Lagrangian depends on the state of each station; what its Hessian is made of.
struct StationWeights {
  Vector x, y;               ///< dL/dx, dL/dy
  Vector zeta_zeta;          ///< d2L/dzeta2 of terms in zeta alone
  std::vector<Vector> v;     ///< dL/dv, for each ride
  std::vector<Vector> v_v;   ///< d2L/dv2 of terms in v alone, for each ride
  std::vector<double> time;  ///< dL/dT, for each ride
};

/// Quadrature of the motion over the track, and its exact derivatives through the very same quadrature.
///
/// Each panel carries Gauss-Legendre nodes in r = sqrt(s + s_0), s_0 = v_0/2 (theory: 1/u is integrable at
/// rest); states inside a panel come from the spectral integration matrix of those nodes. Stations are the
/// start, then for each panel its nodes and its end.
class Transcription {
 public:
  explicit Transcription(const Mesh& mesh);

  [[nodiscard]] const Layout& layout() const { return layout_; }
  [[nodiscard]] const Mesh& mesh() const { return mesh_; }
  [[nodiscard]] const std::vector<Station>& stations() const { return stations_; }
  /// dzeta/d(unknown) of a station; constant
  [[nodiscard]] const double* dzeta(std::size_t station) const { return dzeta_.row(station); }
  [[nodiscard]] double curvature(const Vector& z, std::size_t station) const;
  [[nodiscard]] const std::vector<FineKnot>& fine_knots() const { return fine_; }
  /// Turning rate at a fine knot, its own included.
  [[nodiscard]] double fine_turn(const Vector& z, std::size_t fine_knot) const;
  /// What the fine knots add to the turning rate, and to the slope angle, at any place of the core.
  [[nodiscard]] double own_turn(double sigma) const;
  [[nodiscard]] double own_angle(double sigma) const;
  /// Whether a trial point is a track at all; a search comes back from where it is not.
  [[nodiscard]] bool is_track(const Vector& z) const;
  /// The same row for any point of the track; `row` has layout().size() entries.
  void turning_row(const Station& station, double* row) const;
  /// Position of the point closest to `target`, by its own quadrature from the nearest station.
  [[nodiscard]] Foot foot(const Vector& z, const Shape& shape, double target_x, double target_y) const;
  /// @param nearest  the station to start from
  [[nodiscard]] Foot foot(const Vector& z, const Shape& shape, double target_x, double target_y,
                          std::size_t nearest) const;
  /// The point a share of the way from one station to one next to it.
  [[nodiscard]] Foot between(const Vector& z, const Shape& shape, std::size_t base, std::size_t towards,
                             double share) const;
  /// Derivatives of a foot's position at fixed sigma.
  void foot_derivatives(const Vector& z, const Shape& shape, const Foot& foot, Vector& dx, Vector& dy) const;

  void shape(const Vector& z, Shape& out, bool derivatives) const;
  void flow(const Vector& z, const Shape& shape, const Ride& ride, Flow& out, bool derivatives) const;

  /// Second derivative of the Lagrangian that the weights describe.
  [[nodiscard]] Matrix hessian(const Vector& z, const Shape& shape, const std::vector<Ride>& rides,
                               const std::vector<Flow>& flows, const StationWeights& weights) const;

 private:
  struct Panel {
    std::size_t first = 0;    ///< station of its first node
    std::size_t columns = 0;  ///< dzeta of its nodes is zero from this unknown up to the length
    Part part = Part::core;
    double ds[8] = {};  ///< ds/dtau at the nodes, per core length or absolute
  };
  /// What a Hessian is made of: at each station multiples of dzeta dzeta, of dzeta dv + dv dzeta and of dv dv, and
  /// one row and column of the length.
  struct HessianParts {
    Vector zeta_zeta;
    std::vector<Vector> zeta_v;  ///< for each ride
    std::vector<Vector> v_v;
    Vector length;  ///< enters as e_L a^T + a e_L^T
    Matrix
        curvature;  ///< its rows a of the unknowns that curvature depends on enter as e a^T + a e^T; of laws
  };
  /// Flow of any law: collocation at the panels' nodes, exact derivatives through its equations (law_flow.cpp).
  void law_flow(const Vector& z, const Shape& shape, const Ride& ride, Flow& out, bool derivatives) const;
  void add_law_parts(const Vector& z, const Shape& shape, const Ride& ride, const Flow& flow,
                     const StationWeights& weights, std::size_t index, HessianParts& parts) const;
  [[nodiscard]] double slowest(const Ride& ride, std::size_t station) const;
  void add_shape_parts(const Vector& z, const Shape& shape, const StationWeights& weights,
                       HessianParts& parts) const;
  void add_flow_parts(const Vector& z, const Shape& shape, const Ride& ride, const Flow& flow,
                      const StationWeights& weights, std::size_t index, HessianParts& parts) const;
  void add_panels(double a, double b, Part part, std::size_t piece);
  void add_station(double at, Part part, std::size_t piece);
  void add_fine_knots();
  [[nodiscard]] std::size_t start_station(std::size_t panel) const;

  Mesh mesh_;
  Layout layout_;
  std::vector<Panel> panels_;
  std::vector<Station> stations_;
  Matrix dzeta_;
  std::vector<FineKnot> fine_;
  /// Knots of both kinds, with what the fine ones add there; empty where there are none of those.
  Vector own_sigma_, own_turn_, own_angle_;
  Vector station_turn_, station_angle_;  ///< of the same, at every station
};

/// 1/sqrt(v), continued below a floor by its second-order Taylor polynomial, so that a body that would not
/// arrive costs much but not infinitely much.
struct Slowness {
  double value = 0.0;
  double first = 0.0;
  double second = 0.0;
};
[[nodiscard]] Slowness slowness(double v, double floor);
/// ((u/u0 - 1)^2 + epsilon u0/u)/u0, of two tracks that are equally even the faster.
/// @param even_speed  u0
[[nodiscard]] Slowness evenness(double v, double floor, double even_speed);
/// @return what the objective integrates along the centre's way: slowness() or evenness()
[[nodiscard]] Slowness pace_of(const Ride& ride, double v, double floor);

}  // namespace glissade::optimizer
