#include "optimize/mesh/refinement.hpp"

#include "optimize/mesh/switches.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace glissade::optimizer {
namespace {

// A piece as short as this, of the core's length, is not halved: it stands for a jump of the curvature, or next to
// one.
constexpr double kShortest = 1.5e-3;  // theory: between a pair of knots at a jump and half a piece
// This share of what is left is to be won by the pieces that are halved.
constexpr double kMost = 0.9;  // taste

}  // namespace

MeshTrack with_halved_pieces(const Transcription& track, const Vector& z, const std::vector<bool>& halved) {
  const Mesh& mesh = track.mesh();
  const Layout& layout = track.layout();
  const auto turn_at = [&](std::size_t piece, double sigma) {
    const double share = (sigma - mesh.knots[piece]) / (mesh.knots[piece + 1] - mesh.knots[piece]);
    return (1.0 - share) * z[layout.turn(piece)] + share * z[layout.turn(piece + 1)] + track.own_turn(sigma);
  };
  MeshTrack result;
  result.mesh = mesh;
  result.mesh.knots.clear();
  result.mesh.fine.clear();
  result.mesh.fine_turns.clear();
  Vector turns;
  std::size_t next = 0;
  for (std::size_t piece = 0; piece + 1 < mesh.knots.size(); ++piece) {
    const double from = mesh.knots[piece];
    const double to = mesh.knots[piece + 1];
    Vector ends{from, to};
    if (halved[piece]) ends.insert(ends.begin() + 1, 0.5 * (from + to));
    for (std::size_t part = 0; part + 1 < ends.size(); ++part) {
      const double first = turn_at(piece, ends[part]);
      const double last = turn_at(piece, ends[part + 1]);
      result.mesh.knots.push_back(ends[part]);
      turns.push_back(first);
      const double width = ends[part + 1] - ends[part];
      constexpr double kSame = 1e-9;  // rounding
      for (; next < mesh.fine.size() && mesh.fine[next] < ends[part + 1] - kSame * width; ++next) {
        const double sigma = mesh.fine[next];
        if (sigma <= ends[part] + kSame * width) continue;  // a knot now
        const double share = (sigma - ends[part]) / width;
        result.mesh.fine.push_back(sigma);
        result.mesh.fine_turns.push_back(turn_at(piece, sigma) - ((1.0 - share) * first + share * last));
      }
    }
  }
  result.mesh.knots.push_back(mesh.knots.back());
  turns.push_back(z[layout.turn(layout.knots - 1)]);
  // Changes of friction hold the pieces before them in place.
  if (!track.has_fixed_pieces()) result.mesh.core_length = z[layout.length()];
  result.z.push_back(z[layout.angle()]);
  result.z.insert(result.z.end(), turns.begin(), turns.end());
  result.z.push_back(z[layout.length()]);
  return result;
}

namespace {

/// Which pieces do not stand for a jump. Next to the start they are short for another reason, too: what a body flies over
/// there bends as its own speed has it, however long the track.
std::vector<bool> worth_a_knot(const Mesh& mesh) {
  constexpr double kGrown = 0.15;   // taste: of the way from the start, more than a jump there is wide
  constexpr double kNarrow = 1e-5;  // taste: ten times a piece of a joint
  std::vector<bool> halved(mesh.knots.size() - 1);
  for (std::size_t i = 0; i < halved.size(); ++i) {
    const double width = mesh.knots[i + 1] - mesh.knots[i];
    const bool grows = mesh.entry_speed2 > 0.0 && width > std::max(kNarrow, kGrown * mesh.knots[i + 1]);
    halved[i] = width > kShortest || grows;
  }
  return halved;
}

}  // namespace

MeshTrack with_all_halved(const Transcription& track, const Vector& z) {
  return with_halved_pieces(track, z, worth_a_knot(track.mesh()));
}

MeshTrack with_halved_near(const Found& found, const std::vector<bool>& limits) {
  constexpr std::size_t kBeside = 2;  // taste
  const Transcription& track = *found.track;
  const Vector& knots = track.mesh().knots;
  const std::vector<bool> long_enough = worth_a_knot(track.mesh());
  for (std::size_t i = 0; i < found.equality.size(); ++i) {
    const std::size_t* const limit = found.rows->limit_of_equality(i);
    if (limit != nullptr && limits[*limit]) return with_halved_pieces(track, found.z, long_enough);
  }
  const State state = found.rows->state(found.z, false);
  std::vector<bool> halved(long_enough.size(), false);
  for (std::size_t k = 0; k < found.active.size(); ++k) {
    if (!limits[found.active[k].limit] || !(found.inequality[k] > 0.0)) continue;
    const double sigma = track.sigma_at(found.z, found.rows->place(state, found.active[k]));
    const auto above = std::upper_bound(knots.begin() + 1, knots.end() - 1, sigma);
    const auto piece = static_cast<std::size_t>(above - knots.begin()) - 1;
    const std::size_t last = std::min(piece + kBeside, halved.size() - 1);
    for (std::size_t i = piece - std::min(piece, kBeside); i <= last; ++i) halved[i] = long_enough[i];
  }
  return with_halved_pieces(track, found.z, halved);
}

MeshTrack with_short_pieces_at(Ends ends, const Transcription& track, const Vector& z) {
  MeshTrack result{track.mesh(), z};
  for (;;) {
    const Vector& knots = result.mesh.knots;
    std::vector<bool> halved(knots.size() - 1, false);
    bool any = false;
    for (std::size_t i = 0; i < halved.size(); ++i) {
      const double width = knots[i + 1] - knots[i];
      const double off = std::min(1.0 - knots[i + 1], ends == Ends::both ? knots[i] : 1.0);
      // Beyond a pair of knots at an end, too: a jump that lies there may want to be a bend.
      halved[i] = width > 4.0 * kShortest && off < 0.5 * width;
      any = any || halved[i];
    }
    if (!any) return result;
    result = with_halved_pieces(Transcription(result.mesh), result.z, halved);
  }
}

namespace {

/// Fine knots of a piece that shrinks go along: beyond its ends what they add to the curvature would no longer fade out there. Those
/// of a piece that grows stay where they are.
/// @param before  the mesh whose knots were moved
/// @param grown   by which the curvature within pieces that shrank has grown
void carry_fine_knots(const Mesh& before, double grown, Mesh& after) {
  std::size_t piece = 0;
  for (std::size_t k = 0; k < before.fine.size(); ++k) {
    while (before.fine[k] >= before.knots[piece + 1]) ++piece;
    const double width = before.knots[piece + 1] - before.knots[piece];
    const double now = after.knots[piece + 1] - after.knots[piece];
    if (!(now < width)) continue;
    after.fine[k] = after.knots[piece] + (before.fine[k] - before.knots[piece]) / width * now;
    after.fine_turns[k] = grown * before.fine_turns[k];
  }
}

}  // namespace

std::optional<MeshTrack> with_narrow_jumps(const Transcription& track, const Vector& z) {
  constexpr double kNarrow = 0.2 * kPair;  // taste: a place is still met
  constexpr double kJump = 3.0;            // taste: as much as curvature changes in the pieces beside it
  MeshTrack result{track.mesh(), z};
  Vector& knots = result.mesh.knots;
  const std::vector<ChangeKnots>& changes = result.mesh.change_knots;
  const auto change_in = [&](std::size_t piece) {
    return std::fabs(z[track.layout().turn(piece + 1)] - z[track.layout().turn(piece)]);
  };
  bool any = false;
  for (std::size_t i = 1; i + 2 < knots.size(); ++i) {
    const double width = knots[i + 1] - knots[i];
    const bool may = width > 2.0 * kNarrow && width < 2.0 * kPair;
    const bool stands_for_jump = may && change_in(i) > kJump * std::max(change_in(i - 1), change_in(i + 1));
    const bool at_change = std::any_of(changes.begin(), changes.end(), [&](const ChangeKnots& change) {
      return knots[i] <= change.to && knots[i + 1] >= change.from;
    });
    if (!stands_for_jump || at_change) continue;
    const double middle = 0.5 * (knots[i] + knots[i + 1]);
    knots[i] = middle - 0.5 * kNarrow;
    knots[i + 1] = middle + 0.5 * kNarrow;
    any = true;
  }
  carry_fine_knots(track.mesh(), 1.0, result.mesh);
  return any ? std::optional(std::move(result)) : std::nullopt;
}

std::optional<MeshTrack> with_tighter_corners(const Transcription& track, const Vector& z) {
  constexpr double kPart = 0.25;      // taste: as the crest's
  constexpr double kTightest = 2e-5;  // taste: of the core, ten times a joint
  const Layout& layout = track.layout();
  MeshTrack result{track.mesh(), z};
  Vector& knots = result.mesh.knots;
  const auto turns = [&](std::size_t piece) {
    const double width = knots[piece + 1] - knots[piece];
    const double turn = 0.5 * width * std::fabs(z[layout.turn(piece)] + z[layout.turn(piece + 1)]);
    return width < kShortest && turn > kCorner;
  };
  // Changes of friction hold knots in place, and have corners of their own.
  if (track.has_fixed_pieces()) return std::nullopt;
  bool any = false;
  for (std::size_t first = 1; first + 2 < knots.size(); ++first) {
    if (!turns(first)) continue;
    std::size_t last = first;
    while (last + 2 < knots.size() && turns(last + 1)) ++last;
    const double from = knots[first];
    const double to = knots[last + 1];
    if (last + 2 < knots.size() && to - from > kTightest) {
      for (std::size_t i = first; i <= last + 1; ++i) {
        knots[i] = 0.5 * (from + to) + kPart * (knots[i] - 0.5 * (from + to));
        if (i > first && i <= last) result.z[layout.turn(i)] /= kPart;
      }
      any = true;
    }
    first = last + 1;
  }
  carry_fine_knots(track.mesh(), 1.0 / kPart, result.mesh);
  return any ? std::optional(std::move(result)) : std::nullopt;
}

MeshTrack with_shorter_beginning(const Transcription& track, const Vector& z) {
  constexpr double kPart = 0.25;  // taste: that of the knots behind it
  const Mesh& mesh = track.mesh();
  const Layout& layout = track.layout();
  std::size_t last = 1;  // of the crest's knots
  while (last + 2 < mesh.knots.size() && z[layout.turn(last + 1)] < 0.0) ++last;
  MeshTrack result{mesh, {z[layout.angle()]}};
  result.mesh.knots.clear();
  result.mesh.fine.clear();
  result.mesh.fine_turns.clear();
  result.mesh.extra_breaks.clear();
  for (std::size_t i = 0; i <= last; ++i) {
    result.mesh.knots.push_back(kPart * mesh.knots[i]);
    result.z.push_back(z[layout.turn(i)] / kPart);
  }
  for (std::size_t k = 0; k < mesh.fine.size() && mesh.fine[k] < mesh.knots[last]; ++k) {
    result.mesh.fine.push_back(kPart * mesh.fine[k]);
    result.mesh.fine_turns.push_back(mesh.fine_turns[k] / kPart);
  }
  const double crest = result.mesh.knots.back();
  for (std::size_t i = 0; i < mesh.knots.size(); ++i) {
    if (!(mesh.knots[i] > 1.5 * crest)) continue;
    result.mesh.knots.push_back(mesh.knots[i]);
    result.z.push_back(z[layout.turn(i)]);
  }
  const double next = result.mesh.knots[last + 1];
  for (const double place : mesh.extra_breaks) {
    if (place < mesh.knots[last]) result.mesh.extra_breaks.push_back(kPart * place);
    if (place > crest) result.mesh.extra_breaks.push_back(place);
  }
  for (std::size_t k = 0; k < mesh.fine.size(); ++k) {
    if (!(mesh.fine[k] > next)) continue;
    result.mesh.fine.push_back(mesh.fine[k]);
    result.mesh.fine_turns.push_back(mesh.fine_turns[k]);
  }
  // Where the tighter crest meets the track that was there, it is not known yet where the body comes to press again.
  const Vector& knots = result.mesh.knots;
  for (std::size_t i = last; i < last + 2 && i + 1 < knots.size(); ++i) {
    for (const double share : {0.25, 0.5, 0.75})
      result.mesh.extra_breaks.push_back(knots[i] + share * (knots[i + 1] - knots[i]));
  }
  result.z.push_back(z[layout.length()]);
  return result;
}

Remainder remainder_of(const ScaledProblem& problem, const Found& found, SearchControl& control) {
  const std::vector<bool> halved = worth_a_knot(found.track->mesh());
  const MeshTrack finer = with_halved_pieces(*found.track, found.z, halved);
  const Outlook outlook =
      look_ahead(problem, finer.mesh, finer.z, found.rows->margins(), control, found, RowsAhead::broken);
  Remainder remainder;
  remainder.objective = std::max(0.0, outlook.won);
  remainder.lost = std::max(0.0, -outlook.won);
  remainder.by_limit = outlook.by_limit;
  remainder.by_piece.assign(halved.size(), 0.0);
  std::size_t knot = 0;
  for (std::size_t i = 0; i < halved.size(); ++i, ++knot) {
    if (!halved[i]) continue;
    // In the middle, beyond what the knots on either side do.
    const Layout layout{finer.mesh.knots.size()};
    const double own = outlook.step[layout.turn(knot + 1)] -
                       0.5 * (outlook.step[layout.turn(knot)] + outlook.step[layout.turn(knot + 2)]);
    remainder.by_piece[i] = std::fabs(own * outlook.force[layout.turn(knot + 1)]);
    ++knot;
  }
  return remainder;
}

std::vector<bool> beside_jumps(const Mesh& mesh) {
  const std::size_t pieces = mesh.knots.size() - 1;
  const auto is_jump = [&](std::size_t piece) {
    // Next to the start pieces are short for another reason.
    const double width = mesh.knots[piece + 1] - mesh.knots[piece];
    return width <= kShortest && mesh.knots[piece] > 10.0 * kShortest && mesh.knots[piece + 1] < 1.0;
  };
  std::vector<bool> beside(pieces, false);
  for (std::size_t i = 0; i < pieces; ++i) {
    if (is_jump(i)) continue;
    beside[i] = (i > 0 && is_jump(i - 1)) || (i + 1 < pieces && is_jump(i + 1));
  }
  return beside;
}

std::vector<bool> worth_halving(const Remainder& remainder) {
  std::vector<std::size_t> order(remainder.by_piece.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return remainder.by_piece[a] > remainder.by_piece[b];
  });
  const double whole = std::accumulate(remainder.by_piece.begin(), remainder.by_piece.end(), 0.0);
  std::vector<bool> halved(remainder.by_piece.size(), false);
  double sum = 0.0;
  for (const std::size_t piece : order) {
    if (sum >= kMost * whole || remainder.by_piece[piece] <= 0.0) break;
    halved[piece] = true;
    sum += remainder.by_piece[piece];
  }
  return halved;
}

}  // namespace glissade::optimizer
