#pragma once

#include "glissade/core/vec.hpp"

#include "optimize/algebra/dense.hpp"
#include "optimize/discretise/transcription.hpp"
#include "optimize/problem/scaled_problem.hpp"

#include <functional>
#include <vector>

namespace glissade::optimizer {

struct Row;
struct State;

// Distances of stations from an obstacle's corners. A track that is kept farther from a corner than its tightest bend
// would run round it along an arc: the one foot of the corner is then anywhere on the arc, or on both sides of a tight
// bend in front of it, and tells the search nothing of the rest.

/// Appends a row for each station that lies past both edges beside a corner of the chain, and not much farther from
/// the corner than it may be.
/// @param row      limit, ride, level and corner (its `edge`) of the rows
/// @param nearest  least distance that is allowed, of the centerline [chords]
/// @param stands   which stations count
/// @return whether there are any
bool add_round_rows(const State& state, const Obstacle& obstacle, Row row, double nearest,
                    const std::function<bool(std::size_t)>& stands, std::vector<Row>& rows);

/// Whether the rows of its stations stand for a corner at its foot: the track bends round it there.
/// @param nearest  least distance that is allowed, of the centerline [chords]
[[nodiscard]] bool runs_round(const Transcription& track, const State& state, Vec2 corner, double side,
                              const Foot& foot, double nearest);

/// @return distance of the row's station from the row's corner
[[nodiscard]] double round_distance(const State& state, const Obstacle& obstacle, const Row& row);
void add_round_gradient(const Transcription& track, const State& state, const Obstacle& obstacle,
                        const Row& row, double* out);
void add_round_weights(const State& state, const Obstacle& obstacle, const Row& row, double factor,
                       StationWeights& weights);
/// Second derivatives beside those of the weights.
void add_round_terms(const Transcription& track, const State& state, const Obstacle& obstacle, const Row& row,
                     double factor, Matrix& hessian);

}  // namespace glissade::optimizer
