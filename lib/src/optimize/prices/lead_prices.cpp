#include "optimize/prices/lead_prices.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

namespace glissade::optimizer {
namespace {

// Truncation goes with the square of a step, rounding of quadratures with its inverse.
constexpr double kStep = 1e-4;       // rounding: [chords]
constexpr double kShortStep = 0.01;  // taste: of the length itself
// By less of the objective for each chord nothing is won.
constexpr double kNothing = 1e-6;  // accuracy: that of a time

/// Where a longer straight start leaves the changes of friction: sigma of the core as laid, in that of another start.
class MovedCore {
 public:
  MovedCore(const Mesh& mesh, double by) : by_(by / mesh.core_length) {
    for (const ChangeKnots& change : mesh.change_knots) fixed_.push_back(change.sigma);
  }

  /// Each change keeps its arc length, the ends of the core are its ends; in between all is stretched alike.
  [[nodiscard]] double operator()(double sigma) const {
    const auto above = std::upper_bound(fixed_.begin(), fixed_.end(), sigma);
    const bool last = above == fixed_.end();
    const double from = above == fixed_.begin() ? 0.0 : *(above - 1);
    const double to = last ? 1.0 : *above;
    const double from_there = above == fixed_.begin() ? 0.0 : from - by_;
    const double to_there = last ? 1.0 : to - by_;
    return from_there + (sigma - from) / (to - from) * (to_there - from_there);
  }

 private:
  double by_;
  Vector fixed_;
};

/// The same knots on a core that begins later by so much.
Mesh begun_later(Mesh mesh, double by) {
  const MovedCore moved(mesh, by);
  mesh.lead_in += by;
  for (Vector* const places : {&mesh.knots, &mesh.fine, &mesh.extra_breaks}) {
    for (double& sigma : *places) sigma = moved(sigma);
  }
  for (ChangeKnots& change : mesh.change_knots) {
    change.from = moved(change.from);
    change.to = moved(change.to);
    change.sigma = moved(change.sigma);
  }
  return mesh;
}

/// The Lagrangian of unknowns on a mesh, with an optimum's rows and multipliers; none where these have no counterparts there.
std::optional<double> lagrangian_at(const ScaledProblem& problem, const Found& found, double objective,
                                    const Mesh& mesh, const Vector& z) {
  const Transcription track(mesh);
  if (track.stations().size() != found.track->stations().size()) return std::nullopt;
  Rows rows(problem, track);
  rows.set_margins(found.rows->margins());
  const State state = rows.state(z, false);
  double sum = objective * rows.objective(state);
  const Vector equality = rows.equality_values(state);
  for (std::size_t i = 0; i < equality.size(); ++i) sum += found.equality[i] * equality[i];
  for (std::size_t i = 0; i < found.active.size(); ++i) {
    if (found.inequality[i] > 0.0) sum += found.inequality[i] * rows.value(state, found.active[i]);
  }
  return sum;
}

/// That of an optimum's unknowns with other straight ends.
std::optional<double> lagrangian(const ScaledProblem& problem, const Found& found, double objective,
                                 double later, double longer_end) {
  ScaledProblem changed = problem;
  changed.lead_in += later;
  changed.lead_out += longer_end;
  Mesh mesh = later == 0.0 ? found.track->mesh() : begun_later(found.track->mesh(), later);
  mesh.lead_out += longer_end;
  return lagrangian_at(changed, found, objective, mesh, found.z);
}

/// That of the same track longer by so much behind the last change of friction, as bent as it is.
std::optional<double> lagrangian_of_longer(const ScaledProblem& problem, const Found& found, double objective,
                                           double by) {
  Mesh mesh = found.track->mesh();
  const double fixed = mesh.change_knots.back().sigma;
  const double factor = 1.0 + by / mesh.core_length;
  const auto moved = [&](double sigma) {
    if (sigma <= fixed) return sigma / factor;
    return 1.0 - (1.0 - sigma) / (1.0 - fixed) * (1.0 - fixed / factor);
  };
  for (Vector* const places : {&mesh.knots, &mesh.fine, &mesh.extra_breaks}) {
    for (double& sigma : *places) sigma = moved(sigma);
  }
  for (ChangeKnots& change : mesh.change_knots)
    change = {moved(change.from), moved(change.to), moved(change.sigma)};
  mesh.core_length += by;
  const Layout& layout = found.track->layout();
  Vector z = found.z;
  z[layout.length()] += by;
  for (std::size_t i = 0; i < layout.knots; ++i) z[layout.turn(i)] *= factor;
  for (double& turn : mesh.fine_turns) turn *= factor;
  return lagrangian_at(problem, found, objective, mesh, z);
}

/// Whether the track is straight for longer than it has to be: then a straight end holds nothing back.
bool is_straight_beyond(const Found& found, LimitId end) {
  constexpr double kStraight = 1e-7;  // accuracy: that of a limit [rad]
  const Layout& layout = found.track->layout();
  const std::size_t next = end == LimitId::lead_in ? 1 : layout.knots - 2;
  return std::fabs(found.z[layout.turn(next)]) < kStraight;
}

/// By central differences, or from one side where the quadrature is cut into other panels on the other.
std::optional<double> slope_of(const std::function<std::optional<double>(double)>& function, double step) {
  const std::optional<double> behind = function(step);
  const std::optional<double> before = function(-step);
  if (behind && before) return (*behind - *before) / (2.0 * step);
  const std::optional<double> here = function(0.0);
  if (!here || (!behind && !before)) return std::nullopt;
  return (behind ? *behind - *here : *here - *before) / step;
}

}  // namespace

std::vector<LeadPrice> lead_prices(const ScaledProblem& problem, const Found& found, double objective) {
  std::vector<LeadPrice> prices;
  if (found.equality.size() != found.rows->equality_count()) return prices;
  for (const LimitId id : {LimitId::lead_in, LimitId::lead_out}) {
    const double length = id == LimitId::lead_in ? problem.lead_in : problem.lead_out;
    if (!(length > 0.0) || is_straight_beyond(found, id)) continue;
    const double step = std::min(kStep, kShortStep * length);
    const auto at = [&](double by) {
      const bool start = id == LimitId::lead_in;
      return lagrangian(problem, found, objective, start ? by : 0.0, start ? 0.0 : by);
    };
    const std::optional<double> slope = slope_of(at, step);
    if (!slope) continue;
    // The Lagrangian's are tracks of any length on the mesh of one: with another the curvature of theirs jumps where friction
    // changes for the last time. The track's own is that on its mesh; the straight end takes what it grows by from the core.
    const std::optional<double> by_core =
        found.track->has_fixed_pieces()
            ? slope_of([&](double by) { return lagrangian_of_longer(problem, found, objective, by); }, kStep)
            : 0.0;
    if (!by_core) continue;
    const double price = *slope - *by_core;
    const double size = objective > 0.0 ? std::fabs(found.objective) : 1.0;
    if (price > kNothing * size) prices.push_back({{id, entry_of(id).bound}, length, price});
  }
  return prices;
}

}  // namespace glissade::optimizer
