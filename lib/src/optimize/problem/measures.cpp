// What the search measures for limits on the track itself and on its ride; for distances see
// distance_measures.cpp. Equations: docs/optimization.md, docs/theory.md.

#include "glissade/core/math.hpp"

#include "optimize/problem/measure.hpp"
#include "optimize/problem/rows.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace glissade::optimizer {
namespace {

std::size_t last_station(const RowAt& at) {
  return at.track.stations().size() - 1;
}

double core_length(const RowAt& at) {
  return at.track.core_length(at.state.z);
}

/// Length of the core over sigma within a piece, and its derivative by the unknown that it is.
struct PieceLength {
  double length = 1.0;
  double first = 1.0;
  std::size_t unknown = 0;
};
PieceLength piece_length(const RowAt& at, std::size_t piece) {
  return {at.track.stretch(at.state.z, piece), at.track.stretches(piece) ? 1.0 : 0.0,
          at.track.length_of(piece)};
}

/// Whether a limit holds at a station: one for a friction along part of the track holds at that part's ends, too.
bool concerns(const RowAt& at, std::size_t station) {
  if (!at.limit.zone) return true;
  const std::vector<Station>& stations = at.track.stations();
  const std::size_t next = std::min(station + 1, stations.size() - 1);
  return stations[station].zone == *at.limit.zone || stations[next].zone == *at.limit.zone;
}

/// One row for each watched station from `first` on.
void add_stations(const RowAt& at, std::size_t ride, std::size_t first, std::vector<Row>& rows) {
  Row row = at.row;
  row.ride = ride;
  for (const std::size_t station : at.track.watched()) {
    if (station < first || !concerns(at, station)) continue;
    row.place = station;
    rows.push_back(row);
  }
}

void add_last(const RowAt& at, std::size_t ride, std::vector<Row>& rows) {
  Row row = at.row;
  row.ride = ride;
  row.place = last_station(at);
  rows.push_back(row);
}

/// The ride that a bound on speed is held on: more friction is a slower body at every point, so the ends of the friction
/// range hold all between.
std::size_t fastest_or_slowest(const RowAt& at) {
  return at.limit.side > 0 ? 0 : at.problem.rides.size() - 1;
}

void add_pair(Matrix& hessian, std::size_t i, std::size_t j, double value) {
  hessian(i, j) += value;
  hessian(j, i) += value;
}

/// Second derivative of c/L, c = first z_i + second z_(i+1).
void add_curvature_terms(Matrix& hessian, std::size_t i, double first, double second, double curvature,
                         const PieceLength& stretch, double factor) {
  if (stretch.first == 0.0) return;
  const double length = stretch.length;
  const std::size_t at_length = stretch.unknown;
  add_pair(hessian, i, at_length, -factor * first / (length * length));
  if (second != 0.0) add_pair(hessian, i + 1, at_length, -factor * second / (length * length));
  hessian(at_length, at_length) += 2.0 * factor * curvature / (length * length);
}

class SlopeAngle : public Measure {
 public:
  [[nodiscard]] double value(const RowAt& at) const override { return at.state.shape.zeta[at.row.place]; }
  void gradient(const RowAt& at, double* out) const override { at.track.add_dzeta(at.row.place, 1.0, out); }
  void add_rows(const RowAt& at, std::vector<Row>& rows) const override { add_stations(at, 0, 0, rows); }
  [[nodiscard]] bool holds_along() const override { return true; }
};

class EntrySlopeAngle final : public SlopeAngle {
 public:
  void add_rows(const RowAt& at, std::vector<Row>& rows) const override { rows.push_back(at.row); }
  void set_exact_row(Row& row) const override { row.place = 0; }
  [[nodiscard]] bool holds_along() const override { return false; }
};

class ExitSlopeAngle final : public SlopeAngle {
 public:
  void add_rows(const RowAt& at, std::vector<Row>& rows) const override { add_last(at, 0, rows); }
  [[nodiscard]] bool holds_along() const override { return false; }
};

/// At the knots, those of fine pieces among them: between two of them curvature is linear.
class Curvature final : public Measure {
 public:
  [[nodiscard]] double value(const RowAt& at) const override {
    const Bend here = bend(at);
    return here.turn / piece_length(at, here.piece).length;
  }

  void gradient(const RowAt& at, double* out) const override {
    const Layout& layout = at.track.layout();
    const Bend here = bend(at);
    const auto [length, first, unknown] = piece_length(at, here.piece);
    out[layout.turn(here.piece)] = (1.0 - here.share) / length;
    out[layout.turn(here.piece + 1)] = here.share / length;
    out[unknown] = -first * here.turn / (length * length);
  }

  void add_terms(const RowAt& at, double factor, Matrix& hessian) const override {
    const Layout& layout = at.track.layout();
    const Bend here = bend(at);
    const PieceLength along = piece_length(at, here.piece);
    add_curvature_terms(hessian, layout.turn(here.piece), 1.0 - here.share, here.share,
                        here.turn / along.length, along, factor);
  }

  void add_rows(const RowAt& at, std::vector<Row>& rows) const override {
    Row row = at.row;
    const std::size_t count = at.track.layout().knots + at.track.fine_knots().size();
    for (row.place = 0; row.place < count; ++row.place) rows.push_back(row);
  }

  [[nodiscard]] double place(const RowAt& at) const override {
    return at.track.arc_length(at.state.z, bend(at).sigma);
  }
  [[nodiscard]] bool holds_along() const override { return true; }

 private:
  /// The knot of a row.
  struct Bend {
    std::size_t piece = 0;
    double share = 0.0;  ///< of the way through it
    double turn = 0.0;   ///< curvature times the stretch
    double sigma = 0.0;
  };

  static Bend bend(const RowAt& at) {
    const Layout& layout = at.track.layout();
    const std::size_t place = at.row.place;
    if (place >= layout.knots) {
      const FineKnot& fine = at.track.fine_knots()[place - layout.knots];
      return {fine.piece, fine.share, at.track.fine_turn(at.state.z, place - layout.knots), fine.sigma};
    }
    // The last knot is the end of the last piece, the first one at a border that of the piece before it.
    const Vector& knots = at.track.mesh().knots;
    const bool ends = place + 1 == layout.knots || knots[place] == knots[place + 1];
    const std::size_t piece = ends ? place - 1 : place;
    return {piece, place == piece ? 0.0 : 1.0, at.state.z[layout.turn(place)], at.track.mesh().knots[place]};
  }
};

/// Of each piece.
class CurvatureRate final : public Measure {
 public:
  [[nodiscard]] double value(const RowAt& at) const override {
    const Layout& layout = at.track.layout();
    const double length = piece_length(at, at.row.place).length;
    return (at.state.z[layout.turn(at.row.place + 1)] - at.state.z[layout.turn(at.row.place)]) /
           (piece_share(at) * length * length);
  }

  void gradient(const RowAt& at, double* out) const override {
    const Layout& layout = at.track.layout();
    const auto [length, first, unknown] = piece_length(at, at.row.place);
    const double factor = 1.0 / (piece_share(at) * length * length);
    out[layout.turn(at.row.place + 1)] = factor;
    out[layout.turn(at.row.place)] = -factor;
    out[unknown] = -2.0 * first * value(at) / length;
  }

  void add_terms(const RowAt& at, double factor, Matrix& hessian) const override {
    const Layout& layout = at.track.layout();
    const auto [length, first, at_length] = piece_length(at, at.row.place);
    if (first == 0.0) return;
    const double by_turn = -2.0 * factor / (piece_share(at) * length * length * length);
    add_pair(hessian, layout.turn(at.row.place + 1), at_length, by_turn);
    add_pair(hessian, layout.turn(at.row.place), at_length, -by_turn);
    hessian(at_length, at_length) += 6.0 * factor * value(at) / (length * length);
  }

  void add_rows(const RowAt& at, std::vector<Row>& rows) const override {
    Row row = at.row;
    for (row.place = 0; row.place + 1 < at.track.layout().knots; ++row.place) {
      if (piece_share(RowAt{at.problem, at.track, at.envelope, at.state, at.limit, row}) > 0.0)
        rows.push_back(row);
    }
  }

  [[nodiscard]] double place(const RowAt& at) const override {
    return at.track.arc_length(at.state.z, at.track.mesh().knots[at.row.place]);
  }

 private:
  static double piece_share(const RowAt& at) {
    const Vector& knots = at.track.mesh().knots;
    return knots[at.row.place + 1] - knots[at.row.place];
  }
};

/// kappa u^2, with or without the weight g cos(zeta): curvature and speed both change.
class Load final : public Measure {
 public:
  explicit constexpr Load(bool with_weight) : with_weight_(with_weight) {}

  [[nodiscard]] double value(const RowAt& at) const override {
    const double of_curvature = load(at).value;
    return with_weight_ ? at.state.shape.cos[at.row.place] + of_curvature : of_curvature;
  }

  void gradient(const RowAt& at, double* out) const override {
    const Layout& layout = at.track.layout();
    const Ride::CurvatureLoad parts = load(at);
    if (with_weight_) at.track.add_dzeta(at.row.place, -at.state.shape.sin[at.row.place], out);
    at.track.add(at.state.flows[at.row.ride].dv, at.row.place, parts.by_v, out);
    const Station& station = at.track.stations()[at.row.place];
    if (station.part != Part::core) return;
    const auto [length, first, unknown] = piece_length(at, station.piece);
    const double v = parts.by_curvature;
    out[layout.turn(station.piece)] += v * (1.0 - station.share) / length;
    out[layout.turn(station.piece + 1)] += v * station.share / length;
    out[unknown] -= first * v * at.state.shape.curvature[at.row.place] / length;
  }

  void add_weights(const RowAt& at, double factor, StationWeights& weights) const override {
    if (with_weight_) weights.zeta_zeta[at.row.place] -= factor * at.state.shape.cos[at.row.place];
    weights.v[at.row.ride][at.row.place] += factor * load(at).by_v;
  }

  void add_terms(const RowAt& at, double factor, Matrix& hessian) const override {
    const Station& station = at.track.stations()[at.row.place];
    if (station.part != Part::core) return;
    const Layout& layout = at.track.layout();
    const PieceLength along = piece_length(at, station.piece);
    const double length = along.length;
    const double bend = at.state.shape.curvature[at.row.place];
    Vector by_curvature(layout.size(), 0.0);
    by_curvature[layout.turn(station.piece)] = (1.0 - station.share) / length;
    by_curvature[layout.turn(station.piece + 1)] = station.share / length;
    by_curvature[along.unknown] = -along.first * bend / length;
    Vector dv(layout.size(), 0.0);
    at.track.add(at.state.flows[at.row.ride].dv, at.row.place, 1.0, dv.data());
    const Ride::CurvatureLoad parts = load(at);
    add_symmetric(hessian, factor * parts.by_curvature_v, by_curvature, dv);
    if (parts.by_curvature_curvature != 0.0) {
      add_symmetric(hessian, 0.5 * factor * parts.by_curvature_curvature, by_curvature, by_curvature);
    }
    add_curvature_terms(hessian, layout.turn(station.piece), 1.0 - station.share, station.share, bend, along,
                        factor * parts.by_curvature);
  }

  void add_rows(const RowAt& at, std::vector<Row>& rows) const override {
    add_stations(at, at.limit.ride.value_or(0), 0, rows);
    // More friction is a slower body at every point, so the ends of the friction range hold all between.
    const std::size_t last_ride = at.problem.rides.size() - 1;
    if (with_weight_ && last_ride > 0 && !at.limit.ride && is_held_up_by_slowest(at.limit))
      add_stations(at, last_ride, 0, rows);
  }

  [[nodiscard]] bool holds_along() const override { return true; }
  [[nodiscard]] bool is_load() const override { return true; }

 private:
  /// On a crest the slowest body carries the most, less than its weight: only a bound below that asks for it.
  static bool is_held_up_by_slowest(const LimitSpec& limit) {
    constexpr double kWeight = 1.0;  // theory: in units of gravity
    return limit.side < 0 || limit.bound < kWeight;
  }

  static Ride::CurvatureLoad load(const RowAt& at) {
    return at.problem.rides[at.row.ride].curvature_load(at.state.shape.curvature[at.row.place],
                                                        at.state.flows[at.row.ride].v[at.row.place]);
  }

  bool with_weight_;
};

/// A place between two stations, or next to them, of a track whose length is an unknown.
struct Between {
  std::size_t from = 0;
  std::size_t to = 0;
  double share = 0.0;  ///< of the way from one to the other
  double first = 0.0;  ///< its derivatives by the length of the core
  double second = 0.0;
};

/// Where a limit that holds from a place on begins to: at a row's station, but for what the track is longer or shorter than the
/// mesh was laid for. None at other rows.
std::optional<Between> at_beginning(const RowAt& at) {
  if (!holds_from_a_place(at.limit) || at.track.held_from() != at.row.place) return std::nullopt;
  const std::vector<Station>& stations = at.track.stations();
  Between place;
  place.from = at.row.place;
  place.to = place.from + 1 < stations.size() ? place.from + 1 : place.from - 1;
  const Station& from = stations[place.from];
  const Station& to = stations[place.to];
  const double length = core_length(at);
  const double by_length = from.before + from.by_length;
  const double way = to.arc_length(length) - from.arc_length(length);
  const double way_by_length = to.before + to.by_length - by_length;
  place.share = (at.problem.lowest_speed_from - from.arc_length(length)) / way;
  place.first = -(by_length + place.share * way_by_length) / way;
  place.second = -2.0 * place.first * way_by_length / way;
  return place;
}

/// Squared.
class Speed : public Measure {
 public:
  [[nodiscard]] double value(const RowAt& at) const override {
    const Vector& v = at.state.flows[at.row.ride].v;
    const std::optional<Between> begin = at_beginning(at);
    return begin ? v[begin->from] + begin->share * (v[begin->to] - v[begin->from]) : v[at.row.place];
  }
  void gradient(const RowAt& at, double* out) const override {
    const Flow& flow = at.state.flows[at.row.ride];
    const std::optional<Between> begin = at_beginning(at);
    if (!begin) return at.track.add(flow.dv, at.row.place, 1.0, out);
    at.track.add(flow.dv, begin->from, 1.0 - begin->share, out);
    at.track.add(flow.dv, begin->to, begin->share, out);
    out[at.track.layout().length()] += begin->first * (flow.v[begin->to] - flow.v[begin->from]);
  }
  void add_weights(const RowAt& at, double factor, StationWeights& weights) const override {
    Vector& v = weights.v[at.row.ride];
    const std::optional<Between> begin = at_beginning(at);
    v[at.row.place] += begin ? factor * (1.0 - begin->share) : factor;
    if (begin) v[begin->to] += factor * begin->share;
  }
  void add_terms(const RowAt& at, double factor, Matrix& hessian) const override {
    const std::optional<Between> begin = at_beginning(at);
    if (!begin) return;
    const Flow& flow = at.state.flows[at.row.ride];
    Vector difference(at.track.layout().size(), 0.0);
    at.track.add(flow.dv, begin->to, 1.0, difference.data());
    at.track.add(flow.dv, begin->from, -1.0, difference.data());
    Vector length(difference.size(), 0.0);
    length[at.track.layout().length()] = 1.0;
    add_symmetric(hessian, factor * begin->first, difference, length);
    hessian(at.track.layout().length(), at.track.layout().length()) +=
        factor * begin->second * (flow.v[begin->to] - flow.v[begin->from]);
  }
  [[nodiscard]] double place(const RowAt& at) const override {
    return at_beginning(at) ? at.problem.lowest_speed_from : Measure::place(at);
  }

  void add_rows(const RowAt& at, std::vector<Row>& rows) const override {
    Row row = at.row;
    row.ride = fastest_or_slowest(at);
    const double from = holds_from_a_place(at.limit) ? at.problem.lowest_speed_from : 0.0;
    for (row.place = 0; row.place <= last_station(at); ++row.place) {
      const Station& station = at.track.stations()[row.place];
      if (!station.watched) continue;
      if (at.track.held_from() != row.place && at.track.arc_length(at.state.z, station) < from) continue;
      rows.push_back(row);
    }
  }

  [[nodiscard]] bool is_squared() const override { return true; }
  [[nodiscard]] bool holds_along() const override { return true; }
};

class ExitSpeed final : public Speed {
 public:
  void add_rows(const RowAt& at, std::vector<Row>& rows) const override {
    add_last(at, fastest_or_slowest(at), rows);
  }
  [[nodiscard]] bool is_met_at_each_end_of_range() const override { return true; }
  [[nodiscard]] bool holds_along() const override { return false; }
};

/// u cos(zeta) at the finish.
class ExitRunSpeed final : public Measure {
 public:
  [[nodiscard]] double value(const RowAt& at) const override { return run_speed(at).value; }

  void gradient(const RowAt& at, double* out) const override {
    const RunSpeed run = run_speed(at);
    at.track.add(at.state.flows[at.row.ride].dv, at.row.place, run.by_v, out);
    at.track.add_dzeta(at.row.place, run.by_zeta, out);
  }

  void add_weights(const RowAt& at, double factor, StationWeights& weights) const override {
    const RunSpeed run = run_speed(at);
    weights.v[at.row.ride][at.row.place] += factor * run.by_v;
    weights.v_v[at.row.ride][at.row.place] += factor * run.by_v_v;
    weights.zeta_zeta[at.row.place] += factor * run.by_zeta_zeta;
  }

  void add_terms(const RowAt& at, double factor, Matrix& hessian) const override {
    Vector dv(at.track.layout().size(), 0.0);
    Vector dz(at.track.layout().size(), 0.0);
    at.track.add(at.state.flows[at.row.ride].dv, at.row.place, 1.0, dv.data());
    at.track.add_dzeta(at.row.place, 1.0, dz.data());
    add_symmetric(hessian, factor * run_speed(at).by_zeta_v, dv, dz);
  }

  void add_rows(const RowAt& at, std::vector<Row>& rows) const override {
    add_last(at, fastest_or_slowest(at), rows);
  }

 private:
  struct RunSpeed {
    double value = 0.0;
    double by_v = 0.0, by_zeta = 0.0;
    double by_v_v = 0.0, by_zeta_v = 0.0, by_zeta_zeta = 0.0;
  };

  static RunSpeed run_speed(const RowAt& at) {
    // A squared speed below zero is continued as in Rows::objective().
    const double v = at.state.flows[at.row.ride].v[at.row.place];
    const double u = std::sqrt(std::max(std::fabs(v), 1e-12));
    const double cosine = at.state.shape.cos[at.row.place];
    const double sine = at.state.shape.sin[at.row.place];
    RunSpeed run;
    run.value = std::copysign(u, v) * cosine;
    run.by_v = 0.5 * cosine / u;
    run.by_zeta = -u * sine;
    run.by_v_v = -0.25 * cosine / (u * u * u);
    run.by_zeta_v = -0.5 * sine / u;
    run.by_zeta_zeta = -u * cosine;
    return run;
  }
};

class ArcLength final : public Measure {
 public:
  [[nodiscard]] double value(const RowAt& at) const override {
    return at.problem.lead_in + core_length(at) + at.problem.lead_out;
  }
  void gradient(const RowAt& at, double* out) const override { at.track.add_core_length(1.0, out); }
  void add_rows(const RowAt& at, std::vector<Row>& rows) const override { add_last(at, 0, rows); }
};

class FinishCoordinate final : public Measure {
 public:
  [[nodiscard]] double value(const RowAt& at) const override {
    return is_run(at) ? at.state.run() : at.state.drop();
  }
  void gradient(const RowAt& at, double* out) const override {
    const Derivatives& places = is_run(at) ? at.state.shape.dx : at.state.shape.dy;
    at.track.add(places, last_station(at), 1.0, out);
    at.track.add(places, 0, -1.0, out);
  }
  void add_weights(const RowAt& at, double factor, StationWeights& weights) const override {
    weigh_across(is_run(at) ? weights.x : weights.y, factor);
  }
  void add_rows(const RowAt& at, std::vector<Row>& rows) const override { add_last(at, 0, rows); }

 private:
  static bool is_run(const RowAt& at) { return at.limit.name.id == LimitId::finish_run; }
};

/// Squared speed over that of free fall through the arc length, 2 (s + v_0/2).
class Arrival final : public Measure {
 public:
  [[nodiscard]] double value(const RowAt& at) const override {
    return at.state.flows[at.row.ride].v[at.row.place] / free_fall(at);
  }
  void gradient(const RowAt& at, double* out) const override {
    at.track.add(at.state.flows[at.row.ride].dv, at.row.place, 1.0 / free_fall(at), out);
  }
  void add_weights(const RowAt& at, double factor, StationWeights& weights) const override {
    weights.v[at.row.ride][at.row.place] += factor / free_fall(at);
  }
  void add_rows(const RowAt& at, std::vector<Row>& rows) const override {
    add_stations(at, at.problem.rides.size() - 1, 1, rows);
  }

 private:
  static double free_fall(const RowAt& at) {
    const double s = at.track.stations()[at.row.place].arc_length(at.track.mesh().core_length);
    return 2.0 * s + at.problem.rides[at.row.ride].entry_speed2;
  }
};

/// L of each span over that of the mesh.
class SpanLength final : public Measure {
 public:
  [[nodiscard]] double value(const RowAt& at) const override {
    return at.state.z[at.track.layout().length(at.row.place)] / at.track.mesh().core_length;
  }
  void gradient(const RowAt& at, double* out) const override {
    out[at.track.layout().length(at.row.place)] = 1.0 / at.track.mesh().core_length;
  }
  void add_rows(const RowAt& at, std::vector<Row>& rows) const override {
    Row row = at.row;
    for (row.place = 0; row.place < at.track.layout().spans; ++row.place) rows.push_back(row);
  }
  [[nodiscard]] double place(const RowAt&) const override { return 0.0; }
};

constinit const EntrySlopeAngle kEntrySlopeAngle{};
constinit const ExitSlopeAngle kExitSlopeAngle{};
constinit const SlopeAngle kSlopeAngle{};
constinit const Curvature kCurvature{};
constinit const CurvatureRate kCurvatureRate{};
constinit const Load kNormalLoad{true};
constinit const Load kCurvatureLoad{false};
constinit const Speed kSpeed{};
constinit const ExitSpeed kExitSpeed{};
constinit const ExitRunSpeed kExitRunSpeed{};
constinit const ArcLength kArcLength{};
constinit const FinishCoordinate kFinishCoordinate{};
constinit const Arrival kArrival{};
constinit const SpanLength kSpanLength{};

}  // namespace

constinit const Measure* const Measure::entry_slope_angle = &kEntrySlopeAngle;
constinit const Measure* const Measure::exit_slope_angle = &kExitSlopeAngle;
constinit const Measure* const Measure::slope_angle = &kSlopeAngle;
constinit const Measure* const Measure::curvature = &kCurvature;
constinit const Measure* const Measure::curvature_rate = &kCurvatureRate;
constinit const Measure* const Measure::normal_load = &kNormalLoad;
constinit const Measure* const Measure::curvature_load = &kCurvatureLoad;
constinit const Measure* const Measure::speed = &kSpeed;
constinit const Measure* const Measure::exit_speed = &kExitSpeed;
constinit const Measure* const Measure::exit_run_speed = &kExitRunSpeed;
constinit const Measure* const Measure::arc_length = &kArcLength;
constinit const Measure* const Measure::finish_coordinate = &kFinishCoordinate;
constinit const Measure* const Measure::arrival = &kArrival;
constinit const Measure* const Measure::span_length = &kSpanLength;

double Measure::place(const RowAt& at) const {
  return at.track.arc_length(at.state.z, at.track.stations()[at.row.place]);
}

const Measure* measure_of(LimitId id) {
  static constexpr std::pair<LimitId, const Measure*> kMeasures[] = {
      {LimitId::entry_slope_angle, &kEntrySlopeAngle},
      {LimitId::exit_slope_angle, &kExitSlopeAngle},
      {LimitId::slope_angle, &kSlopeAngle},
      {LimitId::lowest_slope_margin, &kSlopeAngle},
      {LimitId::smallest_valley_radius, &kCurvature},
      {LimitId::smallest_crest_radius, &kCurvature},
      {LimitId::concave, &kCurvature},
      {LimitId::highest_curvature_rate, &kCurvatureRate},
      {LimitId::highest_normal_load, &kNormalLoad},
      {LimitId::lowest_normal_load, &kNormalLoad},
      {LimitId::highest_floor_wear, &kNormalLoad},
      {LimitId::highest_curvature_load, &kCurvatureLoad},
      {LimitId::speed, &kSpeed},
      {LimitId::highest_burden_depth, &kSpeed},
      {LimitId::no_choking, &kSpeed},
      {LimitId::exit_speed, &kExitSpeed},
      {LimitId::match_belt, &kExitRunSpeed},
      {LimitId::arc_length, &kArcLength},
      {LimitId::finish_run, &kFinishCoordinate},
      {LimitId::finish_drop, &kFinishCoordinate},
  };
  for (const auto& [limit, measure] : kMeasures) {
    if (limit == id) return measure;
  }
  return nullptr;
}

}  // namespace glissade::optimizer
