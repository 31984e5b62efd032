#pragma once

#include "optimize/discretise/transcription.hpp"
#include "optimize/problem/scaled_problem.hpp"

#include <array>
#include <cstddef>
#include <vector>

namespace glissade::optimizer {

struct Row;
struct State;

/// Clearances measured from an envelope instead of from the centerline, as rows with exact gradients.
///
/// Rows of one obstacle, of four sorts; each keeps its meaning for every track, wherever its place moves:
///   - a station's normal, at the height of the underside or of the top, against an edge of the chain, or
///     another side of an area in front of which it lies. Where the normal passes behind an end plane, it is
///     cut there;
///   - a corner of the obstacle. At its foot on the track a level is a parallel curve: its distance is that of
///     the centerline less the height. Beyond an end of the track, or of the level, it is the distance from
///     the end face;
///   - a station of the track, against a corner of the chain, past both edges beside it: a track that runs round
///     the corner (round_rows.hpp);
///   - a corner of an end face, against the whole outline. Where the level at the top leaves the end plane
///     only later along the track, the corner is there (docs/solid.md, trims).
/// Normals that fold over beyond a centre of curvature are no special case: their points lie in the solid.
class EnvelopeRows {
 public:
  EnvelopeRows(const ScaledProblem& problem, const Transcription& track) : problem_(problem), track_(track) {}

  /// @return first station that turned by a right angle since the start, and last one before the finish:
  ///   beyond them normals are not cut by these planes
  struct Zones {
    std::size_t start = 0;
    std::size_t finish = 0;
  };
  [[nodiscard]] Zones zones(const Shape& shape) const;

  /// Every row of one limit on distance; those that another row stands for are left out.
  [[nodiscard]] std::vector<Row> rows(const State& state, std::size_t limit) const;

  [[nodiscard]] double measure(const State& state, const Obstacle& obstacle, const Row& row) const;
  void gradient(const State& state, const Obstacle& obstacle, const Row& row, double* out) const;
  void add_weights(const State& state, const Obstacle& obstacle, const Row& row, double factor,
                   StationWeights& weights) const;
  /// Second derivatives beside those of the weights. Exact for what is not cut by an end plane; of cut levels
  /// and their corners the change of the cut is left out.
  void add_direct_terms(const State& state, const Obstacle& obstacle, const Row& row, double factor,
                        Matrix& hessian) const;

 private:
  /// An end face's plane.
  struct Face {
    std::size_t station = 0;
    Vec2 point;
    Vec2 tangent;
    Vec2 normal;
    double outward = -1.0;  ///< along the tangent: -1 at the start, +1 at the finish
  };
  /// A corner of an end face.
  struct FaceCorner {
    Vec2 point;
    double along = 0.0;  ///< from the centerline, along the face's normal
    bool is_cut = false;
    Foot at;  ///< of a cut level: where it leaves the plane
  };
  /// Where a level at some place of the track is cut, if it is.
  struct Cut {
    bool is_cut = false;
    bool at_start = false;
    double height = 0.0;
  };
  /// The least distance of a point from an obstacle, negative behind it.
  struct Distance {
    double value = 0.0;
    Vec2 away;               ///< its derivative by the point
    bool at_corner = false;  ///< nearest to a corner: round about it
  };
  /// How an obstacle's corner lies to the envelope.
  struct CornerView {
    Foot foot;
    double side = 1.0;  ///< the obstacle's own; of a corner that no part of the track is over or under, that
                        ///< on which it lies
    bool beyond = false;  ///< an end face is nearest
    bool at_finish = false;
    bool between = false;  ///< nearest to its inside, not to one of its corners
  };

  [[nodiscard]] double height(std::size_t level) const {
    return level == 0 ? problem_.envelope_low : problem_.envelope_high;
  }
  /// The level that is turned towards what is forbidden below (side +1) or above (-1).
  [[nodiscard]] static std::size_t level_towards(double side) { return side > 0.0 ? 0 : 1; }
  [[nodiscard]] Face face(const Shape& shape, bool finish) const;
  [[nodiscard]] Cut cut(const State& state, std::size_t base, Vec2 point, Vec2 normal, double height) const;
  [[nodiscard]] Cut cut(const State& state, std::size_t station, double height) const;
  [[nodiscard]] FaceCorner face_corner(const State& state, bool finish, std::size_t level) const;
  [[nodiscard]] Foot leaving(const State& state, const Face& face, double height, std::size_t from,
                             std::size_t to) const;
  void add_corner_gradient(const State& state, const Face& face, const FaceCorner& corner, double height,
                           Vec2 direction, double* out) const;
  [[nodiscard]] static Distance distance(const Obstacle& obstacle, Vec2 point);
  /// Of an obstacle's corner, looked for once in each state.
  [[nodiscard]] Foot exact_foot(const State& state, const Obstacle& obstacle, std::size_t index) const;
  [[nodiscard]] Foot looked_for(const State& state, Vec2 corner) const;
  [[nodiscard]] CornerView view(const State& state, const Obstacle& obstacle, const Row& row) const;
  [[nodiscard]] static Vec2 forbidden(const Obstacle& obstacle, std::size_t edge);
  [[nodiscard]] static Vec2 on_edge(const Obstacle& obstacle, std::size_t edge);
  /// Whether a station's normal counts by itself.
  [[nodiscard]] bool stands(const State& state, std::size_t station, std::size_t level) const;
  void add_edge_rows(const State& state, const Obstacle& obstacle, Row row, std::vector<Row>& rows) const;
  void add_corner_rows(const State& state, const Obstacle& obstacle, const Row& row,
                       std::vector<Row>& rows) const;
  void station_gradient(const State& state, const Obstacle& obstacle, const Row& row, double* out) const;
  void corner_gradient(const State& state, const Obstacle& obstacle, const Row& row, double* out) const;

  const ScaledProblem& problem_;
  const Transcription& track_;
};

}  // namespace glissade::optimizer
