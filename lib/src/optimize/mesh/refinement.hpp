#pragma once

#include "optimize/descent/search.hpp"

#include <optional>
#include <vector>

namespace glissade::optimizer {

/// A track on a mesh.
struct MeshTrack {
  Mesh mesh;
  Vector z;
};

/// The same track with a knot more in the middle of some pieces.
/// @param halved  one entry a piece
[[nodiscard]] MeshTrack with_halved_pieces(const Transcription& track, const Vector& z,
                                           const std::vector<bool>& halved);

/// The same with a knot more in every piece that does not stand for a jump.
[[nodiscard]] MeshTrack with_all_halved(const Transcription& track, const Vector& z);

/// The same with a knot more in those of them that lie within or next to where some limits bind; everywhere
/// where one of these is of one value.
/// @param limits  one entry a limit of the problem
[[nodiscard]] MeshTrack with_halved_near(const Found& found, const std::vector<bool>& limits);

enum class Ends { finish, both };
/// The same with pieces ever shorter towards the ends, each half as long as the one before.
[[nodiscard]] MeshTrack with_short_pieces_at(Ends ends, const Transcription& track, const Vector& z);

/// The same with the knots around each jump of the curvature closer together: what the ramp between them costs falls faster than
/// the square of its width. @return none where there are none
[[nodiscard]] std::optional<MeshTrack> with_narrow_jumps(const Transcription& track, const Vector& z);
/// The same with each corner of the track, a bend within a few pieces as short as those that stand for a jump, a quarter as wide: where
/// nothing asks for a radius how tight it is is up to the mesh. @return none where there are none
[[nodiscard]] std::optional<MeshTrack> with_tighter_corners(const Transcription& track, const Vector& z);
/// The same with a first piece a quarter as long, the crest there as much tighter: what falls off a place of rest looks the
/// same on every scale.
[[nodiscard]] MeshTrack with_shorter_beginning(const Transcription& track, const Vector& z);

/// What is left to win by a finer mesh: the step of the quadratic program on the mesh whose every piece is
/// halved, which knows the rows that hold between the stations of the coarser one.
struct Remainder {
  double objective = 0.0;  ///< by which that step lowers the objective; >= 0
  double lost = 0.0;       ///< by which it raises it, limits being held in more places; >= 0
  Vector by_piece;         ///< where: the part of it that is due to the knot in the middle of each piece
  Vector by_limit;         ///< multipliers of the program, as in Outlook
};
[[nodiscard]] Remainder remainder_of(const ScaledProblem& problem, const Found& found,
                                     SearchControl& control);

/// The pieces on either side of a jump, one entry a piece.
[[nodiscard]] std::vector<bool> beside_jumps(const Mesh& mesh);

/// The fewest pieces to halve for most of what is left.
[[nodiscard]] std::vector<bool> worth_halving(const Remainder& remainder);

}  // namespace glissade::optimizer
