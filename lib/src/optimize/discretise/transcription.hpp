#pragma once

#include "glissade/motion/law.hpp"
#include "glissade/motion/motion.hpp"

#include "optimize/algebra/dense.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace glissade::optimizer {

/// Everything in this folder but the facade is in units of a chord and of sqrt(chord/gravity): gravity is 1.

/// Of the chord: no track has less between its straight ends.
inline constexpr double kShortestCore = 1e-4;  // taste

/// The unknowns of a clothoid spline between optional straight ends, as offsets into one vector:
///   [0] entry slope angle zeta_0 [rad]
///   [1 .. knots] turning rates c_i = L kappa_i at the knots sigma_i, linear in between [rad]
///   [knots + 1 ..] L, the length of the core [chords]
/// With them zeta is linear in (zeta_0, c), whatever the length.
///
/// Where the core is parted by Mesh::borders each span between them has a length of its own: L is then what the core would
/// have if all of it were stretched as that span is, and c_i = L kappa_i with the L of the span.
///
/// Where friction changes along the track, each change keeps its arc length: the core up to the last change in it has
/// the length that its mesh gives it, c_i = Mesh::core_length kappa_i there, and L is the length that the core would
/// have if all of it were stretched as what lies behind that change.
struct Layout {
  std::size_t knots = 0;
  std::size_t spans = 1;
  [[nodiscard]] std::size_t angle() const { return 0; }
  [[nodiscard]] std::size_t turn(std::size_t knot) const { return 1 + knot; }
  [[nodiscard]] std::size_t length(std::size_t span = 0) const { return 1 + knots + span; }
  [[nodiscard]] std::size_t size() const { return 1 + knots + spans; }
};

/// A place of the core from which on the track rubs differently, and the knots that stand there.
///
/// The fastest track turns upwards where that costs least: next to the change on its smoother side, at once if no limit
/// keeps it from that, and it flies over the beginning or the end of the rougher side (docs/optimization.md). Its
/// curvature jumps there. Two knots close to each other stand on the smoother side for the jump, and one between them
/// where nothing keeps the bend from being sharp.
struct ChangeKnots {
  double sigma = 0.0;  ///< itself a knot
  double from = 0.0;   ///< of the pieces that stand for the jump; both sigma where curvature does not jump
  double to = 0.0;
  bool sharp = false;
};

/// Where the curvature's knots lie and how the track is cut for quadrature.
struct Mesh {
  Vector knots;  ///< sigma, ascending from 0 to 1: shares of the core length
  /// Sigma, ascending: two knots lie at each, curvature jumps from that of the first to that of the second, and what lies
  /// between two of them has an unknown length of its own. None where friction changes.
  Vector borders;
  Vector extra_breaks;  ///< further sigma at which limits are to be held exactly
  /// Sigma, ascending, none of them a knot: here the curvature has further knots, which go along with those
  /// around them, ...
  Vector fine;
  Vector fine_turns;  ///< ... but for this turning rate each, which is no unknown [rad]
  /// Arc lengths at which the track rubs differently from there on, ascending [chords], ...
  Vector changes;
  std::vector<ChangeKnots> change_knots;  ///< ... and those of them that lie in the core
  /// Arc length from which on a limit holds, itself held exactly; 0: from the start [chords].
  double held_from = 0.0;
  double lead_in = 0.0;      ///< straight before the core [chords]
  double lead_out = 0.0;     ///< straight after it
  double core_length = 1.0;  ///< of the guess: places the nodes of the substitution, and the changes
  double entry_speed2 = 0.0;
  double centre_height = 0.0;  ///< of the body: no track turns upwards more tightly
};

/// A place counted in pieces: 2.25 lies a quarter into the third.
[[nodiscard]] double count_pieces(const Vector& knots, double sigma);

enum class Part { lead_in, core, lead_out };

/// A point of the track at which the state is known: s = fixed_length + by_length L of its span, behind the spans before.
struct Station {
  double fixed_length = 0.0;
  double by_length = 0.0;
  std::size_t span = 0;
  double before = 0.0;      ///< sigma where its span begins
  double sigma = 0.0;       ///< share of the core's length, as the mesh has it
  std::size_t piece = 0;    ///< between knots piece and piece + 1
  double share = 0.0;       ///< of the way between these knots
  Part part = Part::core;   ///< curvature is 0 outside the core
  std::size_t section = 0;  ///< of the track: a straight end or one piece
  std::size_t zone = 0;     ///< changes of friction before it; at a change those before it
  bool watched = true;      ///< limits are held here; enough of them that little happens in between
  /// Where all spans have the same L.
  [[nodiscard]] double arc_length(double length) const {
    return fixed_length + (before + by_length) * length;
  }
};

/// What slides, scaled.
struct Ride {
  double friction = 0.0;      ///< mu, up to the first of Mesh::changes
  Vector later_frictions;     ///< mu from each of them on
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

  [[nodiscard]] double friction_in(std::size_t zone) const {
    return zone == 0 ? friction : later_frictions[zone - 1];
  }

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

/// The derivatives of a quantity at a station by all unknowns, as multiples of five vectors that all stations of
/// a section share: the quantity's own derivatives where the section begins, those of the slope angle there, and the
/// unit vectors of the turning rates at the two knots of the piece and of the length. A section has many stations,
/// and the unknowns are many.
using LocalRow = std::array<double, 5>;
inline constexpr std::size_t kOwn = 0;
inline constexpr std::size_t kZeta = 1;
inline constexpr std::size_t kFirst = 2;
inline constexpr std::size_t kSecond = 3;
inline constexpr std::size_t kLength = 4;
inline constexpr LocalRow kOfLength = {0.0, 0.0, 0.0, 0.0, 1.0};

/// The derivatives of a quantity at every station.
struct Derivatives {
  std::vector<LocalRow> local;  ///< one a station
  Matrix starts;                ///< one row of all unknowns a section: where it begins
  [[nodiscard]] bool empty() const { return local.empty(); }
};

/// Geometry at every station, with derivatives by the unknowns.
struct Shape {
  Vector zeta, sin, cos, x, y, curvature;
  Derivatives dx, dy;
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
  Vector v;       ///< squared speed
  Vector growth;  ///< by the integrating factor since the start of the panel; of a sliding point
  Derivatives dv;
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

/// Quadrature of the motion over the track, and its exact derivatives through the very same quadrature. A panel has
/// one friction.
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
  /// The curvature with which a ride keeps a squared speed at a station, whose slope angle stays.
  /// @return none where curvature does not slow it
  [[nodiscard]] std::optional<double> steady_curvature(const Vector& z, const Shape& shape, const Ride& ride,
                                                       std::size_t station, double v) const;
  /// Those at which limits are held, in order.
  [[nodiscard]] const std::vector<std::size_t>& watched() const { return watched_; }
  /// Station at Mesh::held_from, on a track as long as the mesh was laid for; none where that is the start, or behind the
  /// finish, or where spans have lengths of their own.
  [[nodiscard]] const std::optional<std::size_t>& held_from() const { return held_from_; }
  /// out += factor dzeta/d(unknown) of a station; constant
  void add_dzeta(std::size_t station, double factor, double* out) const;
  /// out += factor d(.)/d(unknown) of a station
  void add(const Derivatives& derivatives, std::size_t station, double factor, double* out) const;
  /// sum of weight dzeta dzeta^T over the stations
  [[nodiscard]] Matrix gram_of_dzeta(const Vector& weights) const;
  [[nodiscard]] double curvature(const Vector& z, std::size_t station) const;
  [[nodiscard]] double core_length(const Vector& z) const;
  /// @return its derivative by the L of a span
  [[nodiscard]] double core_by_length(std::size_t span) const {
    return span_begins_[span + 1] - (span == 0 ? fixed_share_ : span_begins_[span]);
  }
  /// out += factor times the derivatives of the core's length
  void add_core_length(double factor, double* out) const;
  /// Whether a piece is stretched with the L of its span, ...
  [[nodiscard]] bool stretches(std::size_t piece) const { return piece >= fixed_pieces_; }
  /// ... which unknown that is, ...
  [[nodiscard]] std::size_t length_of(std::size_t piece) const { return layout_.length(span_of_[piece]); }
  /// ... and ds/dsigma within it: its curvature is its turning rate over this.
  [[nodiscard]] double stretch(const Vector& z, std::size_t piece) const {
    return stretches(piece) ? z[length_of(piece)] : mesh_.core_length;
  }
  /// Whether there is a change of friction in the core.
  [[nodiscard]] bool has_fixed_pieces() const { return fixed_pieces_ > 0; }
  /// Of a station.
  [[nodiscard]] double arc_length(const Vector& z, const Station& station) const;
  /// Arc length of a place of the core, and the place of an arc length, beyond the core's ends too.
  [[nodiscard]] double arc_length(const Vector& z, double sigma) const;
  [[nodiscard]] double sigma_at(const Vector& z, double arc_length) const;
  /// Arc length of a place of the core from its start, over its whole length: sigma where no friction changes.
  [[nodiscard]] double share_of_core(const Vector& z, double sigma) const {
    return has_fixed_pieces() || !mesh_.borders.empty()
               ? (arc_length(z, sigma) - mesh_.lead_in) / core_length(z)
               : sigma;
  }
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
  /// Adds the derivatives to a shape without, whose positions count from the start.
  void add_derivatives(const Vector& z, Shape& shape) const;
  /// Positions of a shape, counted from the start, count from the finish afterwards.
  void count_from_finish(Shape& shape) const;
  void flow(const Vector& z, const Shape& shape, const Ride& ride, Flow& out, bool derivatives) const;
  /// Adds the derivatives to a flow without.
  void add_derivatives(const Vector& z, const Shape& shape, const Ride& ride, Flow& flow) const;

  /// Second derivative of the Lagrangian that the weights describe.
  [[nodiscard]] Matrix hessian(const Vector& z, const Shape& shape, const std::vector<Ride>& rides,
                               const std::vector<Flow>& flows, const StationWeights& weights) const;

 private:
  struct Panel {
    std::size_t first = 0;    ///< station of its first node
    std::size_t section = 0;  ///< to which it belongs
    Part part = Part::core;
    std::size_t zone = 0;  ///< as of Station
    std::size_t span = 0;  ///< as of Station
    double ds[8] = {};     ///< ds/dtau at the nodes, but for the scale
    double fixed_scale = 0.0;
    double by_length = 1.0;
    [[nodiscard]] double scale(double length) const { return fixed_scale + by_length * length; }
  };
  [[nodiscard]] double scale_of(const Panel& panel, const Vector& z) const {
    return panel.scale(z[layout_.length(panel.span)]);
  }
  /// A stretch of one part with one friction, to be cut into panels. Ends in sigma within the core, in arc length from
  /// the part's start within a straight.
  struct Stretch {
    double from = 0.0;
    double to = 0.0;
    Part part = Part::core;
    std::size_t piece = 0;
    /// Of a straight: where its ends lie, s = fixed + by_length L.
    double fixed[2] = {};
    double by_length[2] = {};
  };
  /// A straight end of the track, or one piece.
  struct Section {
    Part part = Part::core;
    std::size_t piece = 0;
    std::size_t span = 0;
  };
  /// What a Hessian is made of: products of the vectors behind LocalRows, for each section; lower triangle.
  using LocalMatrix = std::array<LocalRow, 5>;
  static void add_square(LocalMatrix& matrix, double factor, const LocalRow& a);
  /// + factor (a b^T + b a^T)
  static void add_pair(LocalMatrix& matrix, double factor, const LocalRow& a, const LocalRow& b);
  /// + square dz dz^T + with_length (dz e^T + e dz^T), e the unit vector of the length: dz begins with the slope angle of
  /// its section, and knows nothing of the length.
  static void add_turning(LocalMatrix& matrix, double square, double with_length, const LocalRow& dz);
  /// What a station adds, as factors of products of dv, dzeta and e, the unit vector of the length; of two different ones
  /// both orders count.
  struct StationTerms {
    double v_v = 0.0, v_zeta = 0.0, v_length = 0.0;
    double zeta_zeta = 0.0, zeta_length = 0.0, length_length = 0.0;
  };
  static void add_terms(LocalMatrix& matrix, const StationTerms& terms, const LocalRow& dv,
                        const LocalRow& dz);

  void differentiate_shape(const Vector& z, std::size_t panel, Shape& out) const;
  /// By the integrating factor, from the start of each panel.
  void set_growth(const Vector& z, const Shape& shape, const Ride& ride, Flow& out) const;
  void flow_through_all(const Vector& z, const Shape& shape, const Ride& ride, Flow& out,
                        bool derivatives) const;
  /// One panel of a sliding point's flow.
  /// @param by_time  its part of the time's derivatives is added; none: no derivatives
  void flow_through(const Vector& z, const Shape& shape, const Ride& ride, std::size_t panel, Flow& out,
                    LocalRow* by_time) const;
  /// How a body of any law enters, ...
  void enter(const Shape& shape, const Ride& ride, Flow& out) const;
  /// ... and one panel of its flow: collocation at the panel's nodes, exact derivatives through its equations (law_flow.cpp).
  void law_flow_through(const Vector& z, const Shape& shape, const Ride& ride, std::size_t panel, Flow& out,
                        LocalRow* by_time) const;
  /// The derivatives of the curvature at a station.
  [[nodiscard]] LocalRow dcurvature(const Vector& z, std::size_t station, double curvature) const;
  struct LawPanel;
  [[nodiscard]] LawPanel law_panel(const Vector& z, const Shape& shape, const Ride& ride, const Flow& flow,
                                   const StationWeights& weights, std::size_t index, std::size_t panel,
                                   double by_end) const;
  void add_law_node(const Vector& z, const Shape& shape, const Ride& ride, const Flow& flow,
                    const LawPanel& law, std::size_t panel, std::size_t node, double theta,
                    LocalMatrix& part) const;
  void add_law_parts(const Vector& z, const Shape& shape, const Ride& ride, const Flow& flow,
                     const StationWeights& weights, std::size_t index, std::vector<LocalMatrix>& parts) const;
  [[nodiscard]] double slowest(const Ride& ride, std::size_t station) const;
  void add_shape_parts(const Vector& z, const Shape& shape, const StationWeights& weights,
                       std::vector<LocalMatrix>& parts) const;
  void add_flow_parts(const Vector& z, const Shape& shape, const Ride& ride, const Flow& flow,
                      const StationWeights& weights, std::size_t index,
                      std::vector<LocalMatrix>& parts) const;
  class LaterSections;
  /// The upper triangle of what the sections add to a Hessian.
  /// @param own  the quantity behind kOwn; none where it has no part
  void expand(const std::vector<LocalMatrix>& parts, const Derivatives* own, Matrix& upper) const;
  /// out += the vector behind a LocalRow
  void expand(const LocalRow& row, std::size_t section, const double* own, double* out) const;

  [[nodiscard]] Derivatives no_derivatives() const;
  /// Whether a panel is the first of its section, ...
  [[nodiscard]] bool begins_section(std::size_t panel) const;
  /// ... where derivatives are carried over into it.
  void carry_over(std::size_t panel, Derivatives& derivatives) const;
  [[nodiscard]] LocalRow at_start(std::size_t panel, const Derivatives& derivatives) const;
  [[nodiscard]] LocalRow dzeta_at_start(std::size_t panel) const;
  [[nodiscard]] LocalRow local_dzeta(const Station& station) const;
  [[nodiscard]] std::size_t section_of(Part part, std::size_t piece) const;
  /// Slope angles at the beginnings of the sections, but for what fine knots add.
  [[nodiscard]] Vector section_angles(const Vector& z) const;
  [[nodiscard]] double angle_at(const Vector& z, const Vector& section_angles, std::size_t station) const;
  void add_core();
  void add_straight(Part part);
  void add_panels(const Stretch& stretch);
  /// What its panels have in common.
  [[nodiscard]] Panel panel_of(const Stretch& stretch) const;
  void add_station(double at, const Stretch& stretch, std::size_t zone);
  /// held_from(), of stations laid already.
  [[nodiscard]] std::optional<std::size_t> station_held_from() const;
  /// Changes of friction before a place of the mesh.
  [[nodiscard]] std::size_t zone_at(double arc_length) const;
  /// Adds what a sliding point's exponent 2 mu zeta - 2 k s of one friction does at a station.
  /// @param by_v  dL/dv there
  /// @param by_length  ds/dL there, from where the exponent counts
  static void add_exponent(StationTerms& terms, double mu, const Ride& ride, double v, double by_length,
                           double by_v);
  void add_fine_knots();
  /// What the fine knots add at the stations.
  void add_fine_to_stations();
  /// own_turn() behind a knot, of both kinds
  [[nodiscard]] double own_turn(double sigma, std::size_t knot) const;
  void add_spans();
  void add_sections();
  [[nodiscard]] std::size_t start_station(std::size_t panel) const;
  /// @return from one station on the first that does not lie before an arc length, or as many as there are
  [[nodiscard]] std::size_t first_behind(const Vector& z, std::size_t from, double arc) const;
  /// Of the stations at the place of one, at a border, that beside which the track goes on.
  [[nodiscard]] std::size_t last_at_place(std::size_t station, bool forward) const;

  Mesh mesh_;
  Layout layout_;
  std::size_t fixed_pieces_ = 0;      ///< up to the last change of friction in the core
  double fixed_share_ = 0.0;          ///< sigma there
  std::vector<std::size_t> span_of_;  ///< of the pieces
  Vector span_begins_;                ///< sigma; of the end of the core, too
  std::vector<Panel> panels_;
  std::vector<Station> stations_;
  std::vector<std::size_t> watched_;
  std::optional<std::size_t> held_from_;
  std::vector<Section> sections_;
  std::vector<std::size_t> section_of_piece_;
  Matrix dzeta_starts_;                ///< dzeta where the sections begin
  std::vector<LocalRow> local_dzeta_;  ///< of the stations
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
