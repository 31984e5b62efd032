#include "optimize/mesh/held_arcs.hpp"

#include "optimize/mesh/switches.hpp"

#include <algorithm>
#include <cmath>

namespace glissade::optimizer {
namespace {

// A piece counts as held if this share of it lies where a limit binds; one at the end of an arc, which a linear
// curvature leaves too early, is held only in part. So does one that stays this close to the bound, in scales.
constexpr double kHeld = 0.05;       // taste
constexpr double kNearBound = 0.02;  // taste
// Of a cap on the speed, which is flat near where a track reaches it.
constexpr double kNearCap = 1e-4;  // taste
// What is flown over next to the start has all that its limit costs, and counts there if it is shorter than one over this of
// the core. Measured of 300 random problems: elsewhere, and of longer ones, it wins nothing but another valley where tracks
// wind, and those take up to 2.6 times as long.
constexpr double kShort = 4.0;
// What fine knots may leave to win in a piece, as a share of the objective: with some ten pieces held, a third of
// the accuracy that is stated for the whole.
constexpr double kLeft = 3e-8;
// Along a highest load it is also by how much this is exceeded between two of them, and the whole limit is tightened by that.
constexpr double kLeftAbove = 5e-9;  // measured: with kLeft tracks stay up to 1.6e-6 behind
// Fine pieces of one piece, at most: beyond that the number of pieces is what is wrong. And so many at least where a
// body left the track.
constexpr std::size_t kMostFine = 16;  // budget
constexpr std::size_t kLifting = 8;    // taste
// Below this squared speed, as a share of that of free fall through a chord, a body is at rest: the curvature of
// constant load has no bound there.
constexpr double kAtRest = 1e-12;  // taste

/// One piece along which a load limit is held.
struct HeldPiece {
  std::size_t piece = 0;
  std::size_t limit = 0;
  double price = 0.0;  ///< of the limit's rows within the piece
  double share = 0.0;  ///< of the piece that the limit binds at a stretch
};

/// A mesh, its rows, and the state of a track found for it or for one of the same knots.
struct OnMesh {
  const ScaledProblem& problem;
  const Transcription& track;
  const Rows& rows;
  const State& state;

  [[nodiscard]] double bound(std::size_t limit) const {
    const LimitSpec& spec = problem.limits[limit];
    return spec.bound - spec.side * rows.margins()[limit] * spec.scale;
  }
  /// Of the ride that a cap is held on.
  [[nodiscard]] double speed(std::size_t limit, std::size_t station) const {
    const std::size_t ride = problem.limits[limit].ride.value_or(0);
    return std::sqrt(std::max(state.flows[ride].v[station], 0.0));
  }
};

/// The curvature at which a load is at its bound, on the ride that is closest to it, or a speed stays at its cap.
double curvature_at_bound(const OnMesh& on, std::size_t limit, std::size_t station) {
  const ScaledProblem& problem = on.problem;
  const State& state = on.state;
  const LimitSpec& spec = problem.limits[limit];
  const double bound = on.bound(limit);
  if (is_cap_along(spec)) {
    const Ride& ride = problem.rides[spec.ride.value_or(0)];
    return on.track.steady_curvature(state.z, state.shape, ride, station, bound * bound)
        .value_or(state.shape.curvature[station]);
  }
  const double weight = spec.measure == Measure::normal_load ? state.shape.cos[station] : 0.0;
  const auto at_ride = [&](std::size_t ride) {
    const double of_centre = (bound - weight) / state.flows[ride].v[station];
    return of_centre / (1.0 + of_centre * problem.rides[ride].height);
  };
  const double first = at_ride(spec.ride.value_or(0));
  // The rides at which the limit is held are those of Rows::candidates.
  if (spec.ride || problem.rides.size() == 1) return first;
  const double last = at_ride(problem.rides.size() - 1);
  return spec.side > 0 ? std::min(first, last) : std::max(first, last);
}

/// How far a load or a speed stays from its bound, at most, at the stations of each piece, on the closest ride.
Vector slack_by_piece(const OnMesh& on, std::size_t limit) {
  const LimitSpec& spec = on.problem.limits[limit];
  Vector slack(on.track.mesh().knots.size() - 1, 0.0);
  for (std::size_t i = 0; i < on.track.stations().size(); ++i) {
    const Station& station = on.track.stations()[i];
    if (station.part != Part::core) continue;
    const double off = is_cap_along(spec) ? on.bound(limit) - on.speed(limit, i)
                                          : (curvature_at_bound(on, limit, i) - on.state.shape.curvature[i]) *
                                                on.state.flows[0].v[i];
    slack[station.piece] = std::max(slack[station.piece], std::fabs(off) / spec.scale);
  }
  return slack;
}

/// Stations at given places of the core, which are ends of panels, both in order.
std::vector<std::size_t> stations_at(const Transcription& track, const Vector& places) {
  std::vector<std::size_t> result;
  const std::vector<Station>& stations = track.stations();
  std::size_t at = 0;
  for (const double place : places) {
    while (stations[at].part == Part::lead_in && at + 1 < stations.size()) ++at;
    while (at + 1 < stations.size() && stations[at].sigma < place) ++at;
    result.push_back(at);
  }
  return result;
}

/// Pieces at whose ends a speed lies at its cap: a linear curvature cannot keep it there in between.
std::vector<bool> between_caps(const OnMesh& on, std::size_t limit) {
  constexpr double kAtCap = 1e-6;  // accuracy: ten times that of a limit
  const Vector& knots = on.track.mesh().knots;
  std::vector<bool> between(knots.size() - 1, false);
  if (!is_cap_along(on.problem.limits[limit])) return between;
  const std::vector<std::size_t> ends = stations_at(on.track, knots);
  const auto is_at_cap = [&](std::size_t station) {
    return std::fabs(on.bound(limit) - on.speed(limit, station)) < kAtCap * on.problem.limits[limit].scale;
  };
  for (std::size_t piece = 0; piece < between.size(); ++piece)
    between[piece] = is_at_cap(ends[piece]) && is_at_cap(ends[piece + 1]);
  return between;
}

/// Which pieces lie at a limit, by which share of them it binds; below 0: not at all.
Vector held_shares(const ScaledProblem& problem, const Found& found, const State& state, std::size_t limit,
                   const std::vector<Span>& bindings) {
  const Transcription& track = *found.track;
  const Vector& knots = track.mesh().knots;
  const OnMesh on{problem, track, *found.rows, state};
  const bool cap = is_cap_along(problem.limits[limit]);
  const Vector slack = slack_by_piece(on, limit);
  const std::vector<bool> between = between_caps(on, limit);
  std::vector<bool> has_fine(knots.size() - 1, false);
  for (const FineKnot& fine : track.fine_knots()) has_fine[fine.piece] = true;
  Vector shares(knots.size() - 1, -1.0);
  for (std::size_t piece = 0; piece + 1 < knots.size(); ++piece) {
    double share = 0.0;
    for (const Span& span : bindings) {
      const double from = std::max(knots[piece], track.sigma_at(found.z, span.from));
      const double to = std::min(knots[piece + 1], track.sigma_at(found.z, span.to));
      share = std::max(share, (to - from) / (knots[piece + 1] - knots[piece]));
    }
    // Speeds stay near a cap far beyond where it binds.
    const bool is_near =
        cap ? between[piece] || slack[piece] <= kNearCap : has_fine[piece] || slack[piece] <= kNearBound;
    if (share >= kHeld || is_near) shares[piece] = share;
  }
  return shares;
}

/// Pieces that lie where a load or a cap on the speed binds, in order, with what its rows cost there: no less than their
/// share of what the whole stretch costs, since of rows side by side a few carry all.
std::vector<HeldPiece> held_pieces(const ScaledProblem& problem, const Found& found, const State& state) {
  const Transcription& track = *found.track;
  const Vector& knots = track.mesh().knots;
  const std::size_t pieces = knots.size() - 1;
  std::vector<std::optional<HeldPiece>> best(pieces);
  const std::vector<std::vector<Span>> bindings = bindings_of(problem, found);
  for (std::size_t i = 0; i < problem.limits.size(); ++i) {
    if (!problem.limits[i].measure->is_load() && !is_cap_along(problem.limits[i])) continue;
    Vector price(pieces, 0.0);
    double whole = 0.0;
    for (std::size_t k = 0; k < found.active.size(); ++k) {
      const Row& row = found.active[k];
      const Station& station = track.stations()[row.place];
      if (row.limit != i || station.part != Part::core) continue;
      price[station.piece] += found.inequality[k];
      whole += found.inequality[k];
    }
    if (whole <= 0.0) continue;
    const Vector shares = held_shares(problem, found, state, i, bindings[i]);
    double stretch = 0.0;
    for (std::size_t piece = 0; piece < pieces; ++piece) {
      if (shares[piece] >= 0.0) stretch += knots[piece + 1] - knots[piece];
    }
    const double part_of_core = problem.entry_speed2 > 0.0 ? std::min(1.0, kShort * stretch) : 1.0;
    for (std::size_t piece = 0; piece < pieces; ++piece) {
      if (shares[piece] < 0.0) continue;
      const double width = knots[piece + 1] - knots[piece];
      const double cost = std::max(price[piece], whole * width / part_of_core);
      // Of two that meet within a piece it follows the one that most of it is bound by.
      const bool is_first = !best[piece] || shares[piece] > best[piece]->share ||
                            (shares[piece] == best[piece]->share && cost > best[piece]->price);
      if (is_first) best[piece] = HeldPiece{piece, i, cost, shares[piece]};
    }
  }
  std::vector<HeldPiece> held;
  for (const std::optional<HeldPiece>& piece : best) {
    if (piece) held.push_back(*piece);
  }
  return held;
}

/// How far the load or the speed strays from its bound within a piece whose curvature is linear, in scales of the limit.
double missed_between(const ScaledProblem& problem, const Found& found, const State& state,
                      const HeldPiece& held) {
  const Vector& knots = found.track->mesh().knots;
  const std::vector<std::size_t> ends = stations_at(*found.track, {knots[held.piece], knots[held.piece + 1]});
  const OnMesh on{problem, *found.track, *found.rows, state};
  const auto wanted = [&](std::size_t station) { return curvature_at_bound(on, held.limit, station); };
  const double first = wanted(ends[0]);
  const double last = wanted(ends[1]);
  double missed = 0.0;
  for (std::size_t station = ends[0] + 1; station < ends[1]; ++station) {
    const double share = (found.track->stations()[station].sigma - knots[held.piece]) /
                         (knots[held.piece + 1] - knots[held.piece]);
    const double off = wanted(station) - (first + share * (last - first));
    missed = std::max(missed, std::fabs(off) * state.flows[0].v[station]);
  }
  const LimitSpec& spec = problem.limits[held.limit];
  if (is_cap_along(spec)) {
    // Friction makes a change of speed of the load that is missed, over a third of the piece.
    constexpr double kShare = 1.0 / 3.0;  // taste
    const double width = (knots[held.piece + 1] - knots[held.piece]) * found.track->core_length(found.z);
    const Ride& ride = problem.rides[spec.ride.value_or(0)];
    missed *= kShare * width * ride.friction_in(found.track->stations()[ends[0]].zone) / spec.bound;
  }
  return missed / spec.scale;
}

/// Into how many parts the fine knots cut a piece.
std::size_t fine_count(const Transcription& track, std::size_t piece) {
  const std::vector<FineKnot>& fine = track.fine_knots();
  return 1 + static_cast<std::size_t>(std::count_if(
                 fine.begin(), fine.end(), [&](const FineKnot& knot) { return knot.piece == piece; }));
}

bool moves(const State& state, const Transcription& track, std::size_t piece) {
  const Vector& knots = track.mesh().knots;
  for (const std::size_t station : stations_at(track, {knots[piece], knots[piece + 1]})) {
    for (const Flow& flow : state.flows) {
      if (!(flow.v[station] > kAtRest)) return false;
    }
  }
  return true;
}

/// Further stations between those at which limits are held.
Mesh with_denser_stations(const Transcription& track) {
  Mesh mesh = track.mesh();
  double before = 0.0;
  for (const Station& station : track.stations()) {
    if (station.part != Part::core || !station.watched) continue;
    if (station.sigma > before) mesh.extra_breaks.push_back(0.5 * (before + station.sigma));
    before = station.sigma;
  }
  return mesh;
}

}  // namespace

std::vector<LiftOff> lift_offs_of(const ScaledProblem& problem, const Found& found) {
  std::vector<LiftOff> lifts;
  const auto limit = std::find_if(problem.limits.begin(), problem.limits.end(), [](const LimitSpec& spec) {
    return spec.measure == Measure::normal_load && spec.side < 0;
  });
  if (limit == problem.limits.end()) return lifts;
  const Transcription track(with_denser_stations(*found.track));
  const Rows rows(problem, track);
  const State state = rows.state(found.z, false);
  LiftOff lowest;
  const auto end_stretch = [&] {
    if (lowest.depth > 0.0) lifts.push_back(lowest);
    lowest = {};
  };
  for (std::size_t i = 0; i < track.stations().size(); ++i) {
    if (track.stations()[i].part != Part::core) continue;
    double load = HUGE_VAL;
    for (std::size_t ride = 0; ride < problem.rides.size(); ++ride) {
      const Ride::CurvatureLoad bent =
          problem.rides[ride].curvature_load(state.shape.curvature[i], state.flows[ride].v[i]);
      load = std::min(load, state.shape.cos[i] + bent.value);
    }
    const double depth = -load / limit->scale;
    if (depth <= 0.0) end_stretch();
    if (depth > lowest.depth) lowest = {track.stations()[i].sigma, depth};
  }
  end_stretch();
  return lifts;
}

Vector exceeded_caps_of(const ScaledProblem& problem, const Found& found, double by) {
  Vector places;
  const State state = found.rows->state(found.z, false);
  const OnMesh on{problem, *found.track, *found.rows, state};
  const std::vector<Station>& stations = found.track->stations();
  for (std::size_t i = 0; i < problem.limits.size(); ++i) {
    const LimitSpec& limit = problem.limits[i];
    if (!is_cap_along(limit)) continue;
    const auto off = [&](std::size_t at) { return (on.speed(i, at) - on.bound(i)) / limit.scale; };
    for (std::size_t at = 1; at + 1 < stations.size(); ++at) {
      const bool within = stations[at - 1].part == Part::core && stations[at + 1].part == Part::core;
      if (!within || (limit.zone && stations[at].zone != *limit.zone)) continue;
      const double here = off(at);
      if (!(here > by) || here < off(at - 1) || !(here > off(at + 1))) continue;
      // The top of the parabola through three of them.
      const double before = stations[at - 1].sigma - stations[at].sigma;
      const double behind = stations[at + 1].sigma - stations[at].sigma;
      double top = 0.0;
      if (before < 0.0 && behind > 0.0) {
        const double slope_before = (off(at - 1) - here) / before;
        const double slope_behind = (off(at + 1) - here) / behind;
        const double second = (slope_behind - slope_before) / (behind - before);
        if (second < 0.0) top = std::clamp(-0.5 * (slope_before - second * before) / second, before, behind);
      }
      places.push_back(stations[at].sigma + top);
    }
  }
  return places;
}

std::optional<Mesh> following_limits(const ScaledProblem& problem, const Found& found, const Vector& lifts) {
  const bool smooth = std::any_of(problem.limits.begin(), problem.limits.end(), [](const LimitSpec& limit) {
    return limit.measure == Measure::curvature_rate;
  });
  if (smooth) return std::nullopt;
  Mesh mesh = found.track->mesh();
  const Vector knots = mesh.knots;
  const State before = found.rows->state(found.z, false);
  const std::vector<HeldPiece> held = held_pieces(problem, found, before);
  if (held.empty()) return std::nullopt;
  std::vector<HeldPiece> fine_pieces;
  mesh.fine.clear();
  mesh.fine_turns.clear();
  for (const HeldPiece& piece : held) {
    if (!moves(before, *found.track, piece.piece)) continue;
    // The mean of a parabola's distance from its chord is two thirds of the greatest.
    const double loss = 2.0 / 3.0 * piece.price * missed_between(problem, found, before, piece);
    const double left = problem.limits[piece.limit].side > 0 ? kLeftAbove : kLeft;
    const double parts = std::sqrt(loss / (left * std::fabs(found.objective)));
    const std::size_t known = fine_count(*found.track, piece.piece);
    const auto wanted = static_cast<std::size_t>(std::ceil(std::max(parts, 1.0)));
    const bool lifts_here = std::any_of(lifts.begin(), lifts.end(), [&](double sigma) {
      return sigma >= knots[piece.piece] && sigma <= knots[piece.piece + 1];
    });
    const std::size_t least = lifts_here ? std::max(kLifting, 2 * known) : known;
    const std::size_t count = std::min(kMostFine, std::max(least, wanted));
    if (count < 2) continue;
    fine_pieces.push_back(piece);
    const double width = (knots[piece.piece + 1] - knots[piece.piece]) / static_cast<double>(count);
    for (std::size_t k = 1; k < count; ++k) {
      const double sigma = knots[piece.piece] + width * static_cast<double>(k);
      mesh.fine.push_back(sigma);
      mesh.fine_turns.push_back(found.track->own_turn(sigma));
    }
  }
  if (mesh.fine.empty()) return std::nullopt;

  const Transcription track(mesh);
  Rows rows(problem, track);
  rows.set_margins(found.rows->margins());
  const State state = rows.state(found.z, false);
  const OnMesh on{problem, track, rows, state};
  std::size_t next = 0;
  for (const HeldPiece& piece : fine_pieces) {
    const double from = knots[piece.piece];
    const double to = knots[piece.piece + 1];
    Vector places{from};
    const std::size_t first = next;
    while (next < mesh.fine.size() && mesh.fine[next] < to) places.push_back(mesh.fine[next++]);
    places.push_back(to);
    const std::vector<std::size_t> stations = stations_at(track, places);
    const auto wanted = [&](std::size_t i) {
      return track.stretch(found.z, piece.piece) * curvature_at_bound(on, piece.limit, stations[i]);
    };
    const double at_first = wanted(0);
    const double at_last = wanted(places.size() - 1);
    for (std::size_t i = first; i < next; ++i) {
      const double share = (mesh.fine[i] - from) / (to - from);
      mesh.fine_turns[i] = wanted(i - first + 1) - (at_first + share * (at_last - at_first));
    }
  }
  return mesh;
}

}  // namespace glissade::optimizer
