// Points as few straights, arcs and clothoids: cut, fitted together, and then simplified as long as the points
// do not object, by the Bayesian information criterion.
#include "centerline/profile/profile_description.hpp"

#include "glissade/core/math.hpp"

#include "centerline/profile/profile_fit.hpp"
#include "centerline/profile/profile_partition.hpp"
#include "centerline/profile/profile_straights.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

namespace glissade::centerline {
namespace {

// Shapes finer than this share of the length are not looked for: exact points of a curve that is none of ours
// would otherwise be cut into as many pieces as there are points. Which share is best depends on the curve, so
// both are tried where the points show no scatter, and once more beside the better of the two: beside a smooth
// curve that rings where the points' curvature jumps little can be told.
constexpr std::array kLeastScatters = {2e-8, 2e-9};
constexpr double kLeastScatterAtLast = 1e-9;
// Steps of the fit that take less than this many variances of a point from the sum of squares do not tell whether
// a number is worth its price, which is some five.
constexpr double kPiecesSettled = 0.1;
constexpr int kMostRounds = 40;
constexpr int kFewSteps = 6;
constexpr int kMostTrials = 40;
// So many points, means of neighbours, decide what the pieces are; all of them, how long and how curved.
constexpr std::size_t kMostDeciding = 300;

// What a number costs by Akaike's criterion: what points leave open is asked of descriptions that they would hardly ask for.
constexpr double kAkaike = 2.0;

// What a jump of curvature at a clothoid or another bend costs, in numbers, beside the number itself.
constexpr double kPriceOfJump = 1.0;
// And any bend: drawings have straights, arcs, clothoids and cubic parabolas.
constexpr double kPriceOfBend = 2.0;

// And a piece that spans less than so many points: noise makes such.
constexpr double kFewPoints = 3.0;
constexpr double kPriceOfHardlySeen = 1.0;

enum class Change { tie, simpler, merge };

/// One way of putting the profile with fewer numbers.
struct Simplification {
  Change change = Change::tie;
  std::size_t index = 0;
  double price = 0.0;    // growth of the sum of squares that is expected
  double numbers = 1.0;  // that it saves

  friend bool operator<(const Simplification& a, const Simplification& b) {
    return std::pair(a.change, a.index) < std::pair(b.change, b.index);
  }
};

void tie(ProfilePiece& before, ProfilePiece& piece) {
  piece.tied = true;
  if (before.constant()) {
    piece.entry_curvature = before.exit_curvature;
  } else if (piece.constant()) {
    before.exit_curvature = piece.entry_curvature;
  } else {
    const double mean = 0.5 * (before.exit_curvature + piece.entry_curvature);
    before.exit_curvature = mean;
    piece.entry_curvature = mean;
  }
}

void simplify(ProfilePiece& piece) {
  if (piece.shape == PieceShape::bend) {
    --piece.swellings;
    if (piece.swellings == 0) piece.shape = PieceShape::clothoid;
    return;
  }
  const bool arc = piece.shape == PieceShape::clothoid;
  piece.shape = arc ? PieceShape::arc : PieceShape::straight;
  const double curvature = arc ? 0.5 * (piece.entry_curvature + piece.exit_curvature) : 0.0;
  piece.entry_curvature = curvature;
  piece.exit_curvature = curvature;
}

ProfilePiece merged(const ProfilePiece& a, const ProfilePiece& b) {
  ProfilePiece both{a.shape, a.length + b.length, a.entry_curvature, b.exit_curvature, a.tied};
  if (a.shape == PieceShape::clothoid && b.shape == PieceShape::clothoid) return both;
  const bool straight = a.shape == PieceShape::straight || b.shape == PieceShape::straight;
  const double mean = (a.length * (a.entry_curvature + a.exit_curvature) +
                       b.length * (b.entry_curvature + b.exit_curvature)) /
                      (2.0 * both.length);
  both.shape = straight ? PieceShape::straight : PieceShape::arc;
  both.entry_curvature = straight ? 0.0 : mean;
  both.exit_curvature = both.entry_curvature;
  return both;
}

PiecewiseProfile changed(PiecewiseProfile profile, const Simplification& step) {
  std::vector<ProfilePiece>& pieces = profile.pieces;
  switch (step.change) {
    case Change::tie:
      tie(pieces[step.index - 1], pieces[step.index]);
      break;
    case Change::simpler:
      simplify(pieces[step.index]);
      break;
    case Change::merge:
      pieces[step.index - 1] = merged(pieces[step.index - 1], pieces[step.index]);
      pieces.erase(pieces.begin() + static_cast<std::ptrdiff_t>(step.index));
      // What was tied to the second piece is tied to both together only if it still can be.
      if (step.index < pieces.size() && pieces[step.index].tied) {
        const ProfilePiece& before = pieces[step.index - 1];
        ProfilePiece& behind = pieces[step.index];
        behind.tied = !before.constant() || !behind.constant();
        if (behind.tied) tie(pieces[step.index - 1], behind);
      }
      break;
  }
  return profile;
}

bool both_straight(const ProfilePiece& a, const ProfilePiece& b) {
  return a.shape == PieceShape::straight && b.shape == PieceShape::straight;
}

std::vector<Simplification> simplifications(const PieceFit& fit) {
  std::vector<Simplification> steps;
  const std::vector<ProfilePiece>& pieces = fit.profile().pieces;
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    if (const auto price = fit.price_of_simpler(k)) {
      steps.push_back({Change::simpler, k, *price, pieces[k].shape == PieceShape::bend ? 2.0 : 1.0});
    }
    if (k == 0) continue;
    if (both_straight(pieces[k - 1], pieces[k])) {
      steps.push_back({Change::merge, k, 0.0, 1.0});
      continue;
    }
    // A jump where a clothoid meets another piece is rare on drawings: it has to show twice as clearly.
    if (const auto price = fit.price_of_tie(k)) steps.push_back({Change::tie, k, *price, kPriceOfJump + 1.0});
    if (const auto price = fit.price_of_merger(k)) steps.push_back({Change::merge, k, *price, 2.0});
  }
  return steps;
}

/// Whether curvature goes over evenly from one piece to the next: a cubic bend has none at its straight end.
bool goes_over_evenly(const ProfilePiece& before, const ProfilePiece& piece) {
  if (piece.tied) return true;
  const bool begins = piece.shape == PieceShape::cubic && !piece.backwards();
  const bool ends = before.shape == PieceShape::cubic && before.backwards();
  return (begins && before.shape == PieceShape::straight) || (ends && piece.shape == PieceShape::straight);
}

/// Jumps of curvature but those from arc to straight or arc, which are a way of building.
std::size_t jumps_of(const PiecewiseProfile& profile) {
  std::size_t count = 0;
  for (std::size_t k = 1; k < profile.pieces.size(); ++k) {
    const ProfilePiece& before = profile.pieces[k - 1];
    const ProfilePiece& piece = profile.pieces[k];
    if ((!before.constant() || !piece.constant()) && !goes_over_evenly(before, piece)) ++count;
  }
  return count;
}

/// Angle by which pieces turn upwards.
double turn_of(const std::vector<ProfilePiece>& pieces, std::size_t from, std::size_t to) {
  double turn = 0.0;
  for (std::size_t k = from; k < to; ++k) {
    // The first and the third swelling turn the track, the others as much one way as the other.
    const ProfilePiece& piece = pieces[k];
    double mean = 0.5 * (piece.entry_curvature + piece.exit_curvature);
    if (piece.swellings > 0) mean += piece.swelling[0] * 2.0 / 3.0;
    if (piece.swellings > 2) mean += piece.swelling[2] * 2.0 / 15.0;
    turn += piece.length * mean;
  }
  return turn;
}

/// Whether pieces turn now to one side and now to the other, much more than they do together: no drawing's bend does.
bool turn_both_ways(const std::vector<ProfilePiece>& pieces, std::size_t from, std::size_t to) {
  constexpr int kPlaces = 8;       // taste: more than a swelling has turns
  constexpr double kMuch = 2.0;    // taste: noise makes a bend swing a little
  constexpr double kLittle = 0.1;  // taste: [rad], what noise makes of a straight
  double turning = 0.0;
  for (std::size_t k = from; k < to; ++k) {
    for (int i = 0; i < kPlaces; ++i)
      turning += pieces[k].length / kPlaces * std::fabs(pieces[k].curvature((i + 0.5) / kPlaces));
  }
  return turning > kLittle + kMuch * std::fabs(turn_of(pieces, from, to));
}

/// The pieces [from, to) as one.
PiecewiseProfile replaced(PiecewiseProfile profile, std::size_t from, std::size_t to,
                          const ProfilePiece& by) {
  std::vector<ProfilePiece>& pieces = profile.pieces;
  pieces.erase(pieces.begin() + static_cast<std::ptrdiff_t>(from) + 1,
               pieces.begin() + static_cast<std::ptrdiff_t>(to));
  pieces[from] = by;
  return profile;
}

/// Bends beside a straight as cubic parabolas: of a ski jump's transition, several clothoids are one.
void add_cubic_bends(const PiecewiseProfile& profile, std::vector<PiecewiseProfile>& ways) {
  constexpr std::size_t kMostReplaced = 4;
  const std::vector<ProfilePiece>& pieces = profile.pieces;
  const auto is_bend = [&](std::size_t k) {
    return !pieces[k].constant() && pieces[k].shape != PieceShape::cubic;
  };
  const auto is_straight = [&](std::size_t k) {
    return k < pieces.size() && pieces[k].shape == PieceShape::straight;
  };
  for (std::size_t from = 0; from < pieces.size(); ++from) {
    double length = 0.0;
    bool bent = false;
    for (std::size_t to = from + 1; to <= std::min(pieces.size(), from + kMostReplaced); ++to) {
      if (pieces[to - 1].shape == PieceShape::straight || pieces[to - 1].shape == PieceShape::cubic) break;
      length += pieces[to - 1].length;
      bent = bent || is_bend(to - 1);
      if (!bent || turn_both_ways(pieces, from, to)) continue;
      const double turn = turn_of(pieces, from, to);
      if (from > 0 && is_straight(from - 1)) {
        if (auto cubic = cubic_piece(length, turn, false)) {
          PiecewiseProfile next = replaced(profile, from, to, *cubic);
          if (from + 1 < next.pieces.size() && next.pieces[from + 1].tied) {
            // What is constant has its own curvature: a jump from the cubic's.
            ProfilePiece& behind = next.pieces[from + 1];
            behind.tied = !behind.constant();
            if (behind.tied) behind.entry_curvature = cubic->exit_curvature;
          }
          ways.push_back(std::move(next));
        }
      }
      if (is_straight(to)) {
        if (auto cubic = cubic_piece(length, turn, true)) {
          PiecewiseProfile next = replaced(profile, from, to, *cubic);
          if (from + 1 < next.pieces.size()) next.pieces[from + 1].tied = false;
          ways.push_back(std::move(next));
        }
      }
    }
  }
}

/// The profile with one of its pieces that turn little as a straight.
std::vector<PiecewiseProfile> with_straights(const PiecewiseProfile& profile) {
  constexpr double kLittle = 0.02;  // [rad]
  std::vector<PiecewiseProfile> all;
  for (std::size_t k = 0; k < profile.pieces.size(); ++k) {
    const ProfilePiece& piece = profile.pieces[k];
    const bool turns = std::fabs(turn_of(profile.pieces, k, k + 1)) > kLittle;
    if (turns || piece.shape == PieceShape::straight || piece.shape == PieceShape::cubic) continue;
    ProfilePiece straight;
    straight.shape = PieceShape::straight;
    straight.length = piece.length;
    PiecewiseProfile next = replaced(profile, k, k + 1, straight);
    if (k + 1 < next.pieces.size()) next.pieces[k + 1].tied = false;
    all.push_back(std::move(next));
  }
  return all;
}

/// Where curvature jumps a little between a clothoid and a straight or an arc: no jump, and the break where the
/// clothoid has the other's curvature.
void add_moved_ties(const PiecewiseProfile& profile, std::vector<PiecewiseProfile>& ways) {
  for (std::size_t k = 1; k < profile.pieces.size(); ++k) {
    if (profile.pieces[k].tied) continue;
    PiecewiseProfile next = profile;
    ProfilePiece& before = next.pieces[k - 1];
    ProfilePiece& piece = next.pieces[k];
    if (before.shape == PieceShape::cubic && !before.backwards() && piece.shape == PieceShape::arc) {
      piece.entry_curvature = piece.exit_curvature = before.exit_curvature;
      piece.tied = true;
      ways.push_back(std::move(next));
      continue;
    }
    if (before.shape == PieceShape::arc && piece.shape == PieceShape::cubic && piece.backwards()) {
      piece.entry_curvature = before.exit_curvature;
      piece.tied = true;
      if (piece.settle_cubic()) ways.push_back(std::move(next));
      continue;
    }
    const bool into = before.shape == PieceShape::clothoid && piece.constant();
    const bool out_of = before.constant() && piece.shape == PieceShape::clothoid;
    if (!into && !out_of) continue;
    ProfilePiece& clothoid = into ? before : piece;
    ProfilePiece& other = into ? piece : before;
    double& end = into ? clothoid.exit_curvature : clothoid.entry_curvature;
    const double far_end = into ? clothoid.entry_curvature : clothoid.exit_curvature;
    const double share = (other.entry_curvature - far_end) / (end - far_end);
    const double moved = clothoid.length * (1.0 - share);
    if (!(share > 0.0 && other.length + moved > 0.0)) continue;
    end = other.entry_curvature;
    clothoid.length -= moved;
    other.length += moved;
    piece.tied = true;
    ways.push_back(std::move(next));
  }
}

/// The profile with a straight at an end, out of a part of the piece there: a jump that few points beyond it show.
std::vector<PiecewiseProfile> with_straight_ends(const PiecewiseProfile& profile) {
  std::vector<PiecewiseProfile> all;
  for (const bool last : {false, true}) {
    const ProfilePiece& piece = last ? profile.pieces.back() : profile.pieces.front();
    if (piece.constant() || piece.shape == PieceShape::cubic) continue;
    for (const double share : {0.4, 0.7}) {
      ProfilePiece straight;
      straight.shape = PieceShape::straight;
      straight.length = share * piece.length;
      PiecewiseProfile next = profile;
      ProfilePiece& rest = last ? next.pieces.back() : next.pieces.front();
      rest.length -= straight.length;
      rest.shape = PieceShape::clothoid;
      rest.swellings = 0;
      if (last) {
        rest.exit_curvature = rest.entry_curvature;
        next.pieces.push_back(straight);
      } else {
        rest.entry_curvature = rest.exit_curvature;
        rest.tied = false;
        next.pieces.insert(next.pieces.begin(), straight);
      }
      all.push_back(std::move(next));
    }
  }
  return all;
}

/// What lies between two straights or arcs as one clothoid that leads over: noise lets an arc, another bend, or both pass
/// for it.
void add_plain_transitions(const PiecewiseProfile& profile, std::vector<PiecewiseProfile>& ways) {
  constexpr std::size_t kMostReplaced = 3;
  constexpr double kLonger = 0.4;  // than an arc that stands for it, on both sides
  const std::vector<ProfilePiece>& pieces = profile.pieces;
  for (std::size_t from = 1; from + 1 < pieces.size(); ++from) {
    double length = 0.0;
    for (std::size_t to = from + 1; to < pieces.size() && to <= from + kMostReplaced; ++to) {
      length += pieces[to - 1].length;
      const ProfilePiece& before = pieces[from - 1];
      const ProfilePiece& after = pieces[to];
      const bool arc = pieces[from].constant();
      const bool known =
          to == from + 1 && pieces[from].shape == PieceShape::clothoid && pieces[from].tied && after.tied;
      if (!before.constant() || !after.constant() || known) continue;
      if (before.exit_curvature == after.entry_curvature) continue;
      const double more =
          arc && to == from + 1 ? std::min({kLonger * length, 0.5 * before.length, 0.5 * after.length}) : 0.0;
      ProfilePiece clothoid;
      clothoid.length = length + 2.0 * more;
      clothoid.entry_curvature = before.exit_curvature;
      clothoid.exit_curvature = after.entry_curvature;
      clothoid.tied = true;
      PiecewiseProfile next = replaced(profile, from, to, clothoid);
      next.pieces[from - 1].length -= more;
      next.pieces[from + 1].length -= more;
      next.pieces[from + 1].tied = true;
      ways.push_back(std::move(next));
    }
  }
}

/// What lies between two straights as drawings have it: an arc, one with clothoids before and behind it or on one side,
/// two clothoids, two arcs. Noise, or points that are few for the bend, hide that from a cut.
void add_drawn_bends(const PiecewiseProfile& profile, std::vector<PiecewiseProfile>& ways) {
  /// Pieces by their shares of the length, and the curvature where they begin and end as shares of the highest.
  struct Part {
    double share;
    double entry;
    double exit;
  };
  static const std::vector<std::vector<Part>> kDrawn = {
      {{1.0, 1.0, 1.0}},
      {{0.3, 0.0, 1.0}, {0.4, 1.0, 1.0}, {0.3, 1.0, 0.0}},
      {{0.45, 0.0, 1.0}, {0.1, 1.0, 1.0}, {0.45, 1.0, 0.0}},
      {{0.5, 0.0, 1.0}, {0.5, 1.0, 1.0}},
      {{0.5, 1.0, 1.0}, {0.5, 1.0, 0.0}},
      {{0.5, 0.0, 1.0}, {0.5, 1.0, 0.0}},
      {{0.5, 0.5, 0.5}, {0.5, 1.0, 1.0}},
      {{0.5, 1.0, 1.0}, {0.5, 0.5, 0.5}},
  };
  const std::vector<ProfilePiece>& pieces = profile.pieces;
  const auto is_straight = [&](std::size_t k) { return pieces[k].shape == PieceShape::straight; };
  const auto fits = [&](const std::vector<Part>& parts, std::size_t from) {
    return std::equal(parts.begin(), parts.end(), pieces.begin() + static_cast<std::ptrdiff_t>(from),
                      [](const Part& part, const ProfilePiece& piece) {
                        return part.entry == part.exit ? piece.shape == PieceShape::arc
                                                       : piece.shape == PieceShape::clothoid && piece.tied;
                      });
  };
  for (std::size_t from = 0; from < pieces.size(); ++from) {
    if (is_straight(from) || (from > 0 && !is_straight(from - 1))) continue;
    std::size_t to = from + 1;
    double length = pieces[from].length;
    while (to < pieces.size() && !is_straight(to)) length += pieces[to++].length;
    if (turn_both_ways(pieces, from, to)) continue;
    const double turn = turn_of(pieces, from, to);
    for (const std::vector<Part>& parts : kDrawn) {
      if (parts.size() == to - from && fits(parts, from)) continue;
      const bool runs_in = parts.front().entry == 0.0;
      const bool runs_out = parts.back().exit == 0.0;
      if ((runs_in && from == 0) || (runs_out && to == pieces.size())) continue;
      double area = 0.0;
      for (const Part& part : parts) area += part.share * 0.5 * (part.entry + part.exit);
      const double highest = turn / (length * area);
      std::vector<ProfilePiece> drawn;
      for (const Part& part : parts) {
        ProfilePiece piece;
        piece.shape = part.entry == part.exit ? PieceShape::arc : PieceShape::clothoid;
        piece.length = part.share * length;
        piece.entry_curvature = part.entry * highest;
        piece.exit_curvature = part.exit * highest;
        piece.tied = drawn.empty() ? part.entry == 0.0 : drawn.back().exit_curvature == piece.entry_curvature;
        drawn.push_back(piece);
      }
      PiecewiseProfile next = replaced(profile, from, to, drawn.back());
      next.pieces.insert(next.pieces.begin() + static_cast<std::ptrdiff_t>(from), drawn.begin(),
                         drawn.end() - 1);
      const std::size_t behind = from + drawn.size();
      if (behind < next.pieces.size()) next.pieces[behind].tied = runs_out;
      ways.push_back(std::move(next));
    }
  }
}

/// The profile with one of its pieces bending more freely.
void add_freer_pieces(const PiecewiseProfile& profile, std::vector<PiecewiseProfile>& ways) {
  for (std::size_t k = 0; k < profile.pieces.size(); ++k) {
    PiecewiseProfile next = profile;
    ProfilePiece& piece = next.pieces[k];
    if (piece.shape == PieceShape::arc) {
      piece.shape = PieceShape::clothoid;
    } else if (piece.shape == PieceShape::clothoid || piece.shape == PieceShape::bend) {
      if (piece.swellings == kMostSwellings) continue;
      piece.shape = PieceShape::bend;
      piece.swelling[piece.swellings++] = 0.0;
    } else {
      continue;
    }
    ways.push_back(std::move(next));
  }
}

/// The profile without one of the pieces between two points, or of few points at an end: noise makes such, no point shows
/// what they are.
void add_without_slivers(const PiecewiseProfile& profile, double spacing,
                         std::vector<PiecewiseProfile>& ways) {
  const std::vector<ProfilePiece>& pieces = profile.pieces;
  if (pieces.size() < 2) return;
  if (pieces.front().length < kFewPoints * spacing && pieces[1].shape != PieceShape::cubic) {
    PiecewiseProfile next = profile;
    next.pieces[1].length += pieces.front().length;
    next.pieces[1].tied = false;
    next.pieces.erase(next.pieces.begin());
    ways.push_back(std::move(next));
  }
  if (pieces.back().length < kFewPoints * spacing && pieces[pieces.size() - 2].shape != PieceShape::cubic) {
    PiecewiseProfile next = profile;
    next.pieces[pieces.size() - 2].length += pieces.back().length;
    next.pieces.pop_back();
    ways.push_back(std::move(next));
  }
  for (std::size_t k = 1; k + 1 < pieces.size(); ++k) {
    const bool cubic = pieces[k - 1].shape == PieceShape::cubic || pieces[k + 1].shape == PieceShape::cubic;
    if (pieces[k].length >= spacing || cubic) continue;
    PiecewiseProfile next = profile;
    ProfilePiece& before = next.pieces[k - 1];
    ProfilePiece& after = next.pieces[k + 1];
    before.length += 0.5 * pieces[k].length;
    after.length += 0.5 * pieces[k].length;
    after.tied = false;
    next.pieces.erase(next.pieces.begin() + static_cast<std::ptrdiff_t>(k));
    ways.push_back(next);
    if (next.pieces[k - 1].constant() && next.pieces[k].constant()) continue;
    tie(next.pieces[k - 1], next.pieces[k]);
    ways.push_back(std::move(next));
  }
}

/// What the points had to yield: the unknowns, and the places of the breaks once more, as they were chosen among
/// many.
double freedom_of(const PieceFit& fit) {
  return static_cast<double>(fit.freedom() + fit.profile().pieces.size() - 1);
}

/// Number of pieces that span less than so many points.
std::size_t hardly_seen(const PiecewiseProfile& profile, std::size_t points, double few_points) {
  const double few = few_points * profile.length() / static_cast<double>(points);
  const auto count = std::count_if(profile.pieces.begin(), profile.pieces.end(),
                                   [&](const ProfilePiece& piece) { return piece.length < few; });
  return static_cast<std::size_t>(count);
}

/// What the kinds of pieces cost beside their numbers, in numbers; those that few points see among them.
/// @param points  number of them
double prices_of_kinds(const PieceFit& fit, std::size_t points) {
  const std::vector<ProfilePiece>& pieces = fit.profile().pieces;
  const auto bends = std::count_if(pieces.begin(), pieces.end(),
                                   [](const ProfilePiece& piece) { return piece.shape == PieceShape::bend; });
  return kPriceOfJump * static_cast<double>(jumps_of(fit.profile())) +
         kPriceOfBend * static_cast<double>(bends) +
         kPriceOfHardlySeen * static_cast<double>(hardly_seen(fit.profile(), points, kFewPoints));
}

class Describer {
 public:
  Describer(std::vector<Vec2> points, std::vector<double> places, const PiecewiseProfile& cut, double scatter)
      : points_(std::move(points)),
        places_(std::move(places)),
        fit_(points_, places_, cut),
        number_price_(math::log(static_cast<double>(points_.size()))) {
    fit_.relax(kPiecesSettled * scatter * scatter, kMostRounds);
    const double spare =
        std::max(1.0, static_cast<double>(points_.size()) - static_cast<double>(fit_.freedom()));
    variance_ = std::max(scatter * scatter, fit_.square_sum() / spare);
  }

  /// Takes the steps that pay, as long as some do: those that cost next to nothing all at once, the others one by
  /// one, the best first.
  void simplify_all() {
    for (int trial = 0; trial < kMostTrials; ++trial) {
      const std::vector<Simplification> steps = best_steps();
      if (steps.empty()) return;
      PiecewiseProfile simpler = fit_.profile();
      double numbers = 0.0;
      for (const Simplification& step : steps) {
        simpler = changed(std::move(simpler), step);
        numbers += step.numbers;
      }
      PieceFit next(points_, places_, std::move(simpler));
      next.relax(kPiecesSettled * variance_, kFewSteps);
      const double growth = next.square_sum() - fit_.square_sum();
      if (growth < numbers * number_price_ * variance_) {
        const bool renumbered = std::any_of(steps.begin(), steps.end(), [](const Simplification& step) {
          return step.change == Change::merge;
        });
        if (renumbered) refused_.clear();
        fit_ = std::move(next);
      } else {
        refused_.insert(steps.front());
      }
    }
  }

  /// What the price of a step to second order does not foresee: other shapes, breaks that move. Each is fitted to its
  /// end, the best is taken, as long as one pays.
  void reshape() {
    constexpr std::size_t kMostPieces = 16;
    constexpr int kMostReshapes = 8;
    for (int i = 0; i < kMostReshapes && fit_.profile().pieces.size() <= kMostPieces; ++i) {
      std::optional<PieceFit> best;
      double least = score(fit_);
      for (PiecewiseProfile& way : other_ways()) {
        PieceFit next(points_, places_, std::move(way));
        if (!relax_below(least, next, number_price_)) continue;
        least = score(next);
        best = std::move(next);
      }
      if (!best) return;
      fit_ = *std::move(best);
    }
  }

  [[nodiscard]] const PiecewiseProfile& profile() const { return fit_.profile(); }

  /// The largest curvatures of all that describes the points about as well.
  [[nodiscard]] std::optional<CurvatureRange> largest_curvature() const {
    constexpr double kAsWell = 6.0;  // odds of one to twenty
    constexpr double kUnseen = 2.0;  // points: what fewer see is bounded by nothing
    const auto akaike = [&](const PieceFit& fit) { return score(fit, kAkaike); };
    const double bound = akaike(fit_) + kAsWell;
    std::optional<CurvatureRange> range;
    const auto widen = [&](const PieceFit& fit) {
      const double room = bound - akaike(fit);
      const auto sharpest = fit.sharpest();
      if (!sharpest || !(room > 0.0)) return;
      const double more = std::sqrt(room * variance_) * sharpest->deviation;
      const CurvatureRange here{std::max(0.0, sharpest->curvature - more), sharpest->curvature + more};
      range =
          range ? CurvatureRange{std::min(range->least, here.least), std::max(range->greatest, here.greatest)}
                : here;
    };
    widen(fit_);
    std::vector<PiecewiseProfile> ways = other_ways();
    add_freer_pieces(fit_.profile(), ways);
    for (PiecewiseProfile& way : ways) {
      PieceFit next(points_, places_, std::move(way));
      if (relax_below(bound, next, kAkaike) && hardly_seen(next.profile(), points_.size(), kUnseen) == 0)
        widen(next);
    }
    return range;
  }

 private:
  /// Relaxes to the end, or as long as it looks as if the score came below a bound. @return whether it does
  [[nodiscard]] bool relax_below(double bound, PieceFit& fit, double number_price) const {
    // Steps in this number that do not take a good part of what is missing will not get there.
    constexpr int kStepsAtOnce = 5;
    constexpr double kGoodPart = 0.1;
    double before = std::numeric_limits<double>::infinity();
    for (int steps = 0; steps < kMostRounds; steps += kStepsAtOnce) {
      fit.relax(kPiecesSettled * variance_, kStepsAtOnce);
      const double now = score(fit, number_price);
      if (!(before - now > kGoodPart * (now - bound))) return now < bound;
      if (before - now <= kPiecesSettled) break;
      before = now;
    }
    return score(fit, number_price) < bound;
  }

  /// The profile with other shapes in some places.
  [[nodiscard]] std::vector<PiecewiseProfile> other_ways() const {
    std::vector<PiecewiseProfile> ways;
    add_moved_ties(fit_.profile(), ways);
    add_cubic_bends(fit_.profile(), ways);
    add_plain_transitions(fit_.profile(), ways);
    add_without_slivers(fit_.profile(), fit_.profile().length() / static_cast<double>(points_.size()), ways);
    // A neighbour that hardly turns may be the straight that noise hides.
    for (const PiecewiseProfile& straighter : with_straights(fit_.profile())) {
      add_cubic_bends(straighter, ways);
      add_plain_transitions(straighter, ways);
      add_drawn_bends(straighter, ways);
    }
    for (const PiecewiseProfile& ended : with_straight_ends(fit_.profile())) {
      ways.push_back(ended);
      add_cubic_bends(ended, ways);
      add_plain_transitions(ended, ways);
      add_drawn_bends(ended, ways);
    }
    add_drawn_bends(fit_.profile(), ways);
    return ways;
  }

  /// Of the Bayesian information criterion, in variances.
  [[nodiscard]] double score(const PieceFit& fit) const { return score(fit, number_price_); }
  [[nodiscard]] double score(const PieceFit& fit, double number_price) const {
    return fit.square_sum() / variance_ +
           (freedom_of(fit) + prices_of_kinds(fit, points_.size())) * number_price;
  }

  /// From the last place of the profile to the first, so that the steps leave each other's indices alone.
  [[nodiscard]] std::vector<Simplification> best_steps() const {
    // Steps that cost less than this share of what they save, two pieces apart, hardly touch each other.
    constexpr double kNextToNothing = 0.1;
    constexpr std::size_t kApart = 3;
    // Where a break moves along with its jump, the price foretold is too high by as much as this.
    constexpr double kWorthTrying = 10.0;
    std::vector<Simplification> paying;
    for (const Simplification& step : simplifications(fit_)) {
      const double limit = kWorthTrying * step.numbers * number_price_ * variance_;
      if (step.price < limit && !refused_.contains(step)) paying.push_back(step);
    }
    std::sort(paying.begin(), paying.end(), [&](const Simplification& a, const Simplification& b) {
      return std::pair(-gain_of(a), a) < std::pair(-gain_of(b), b);
    });
    std::vector<Simplification> taken;
    for (const Simplification& step : paying) {
      const bool free = step.price < kNextToNothing * step.numbers * number_price_ * variance_;
      const bool apart = std::all_of(taken.begin(), taken.end(), [&](const Simplification& other) {
        return std::max(step.index, other.index) - std::min(step.index, other.index) >= kApart;
      });
      if (taken.empty() || (free && apart && refused_.empty())) taken.push_back(step);
    }
    std::sort(taken.begin(), taken.end(),
              [](const Simplification& a, const Simplification& b) { return a.index > b.index; });
    return taken;
  }

  [[nodiscard]] double gain_of(const Simplification& step) const {
    return step.numbers * number_price_ - step.price / variance_;
  }

  std::vector<Vec2> points_;
  std::vector<double> places_;
  PieceFit fit_;
  double number_price_;
  double variance_ = 0.0;
  std::set<Simplification> refused_;
};

PlacedPoints placed_beside(const ClothoidSpline& reference, const std::vector<Vec2>& points) {
  PlacedPoints placed;
  for (const PointDeviation& point : deviations_from(reference, points)) {
    const double before = placed.places.empty() ? 0.0 : placed.places.back();
    placed.places.push_back(std::max(before, point.arc_length));
    placed.deviations.push_back(point.deviation);
  }
  return placed;
}

/// The points, or means of neighbours if there are more. A mean is taken of the distances from the curve, so that
/// it lies off no bend.
PlacedPoints means_of_neighbours(const PlacedPoints& points, std::size_t most) {
  const std::size_t size = points.places.size();
  if (size <= most) return points;
  PlacedPoints means;
  for (std::size_t group = 0; group < most; ++group) {
    const std::size_t from = group * size / most;
    const std::size_t to = (group + 1) * size / most;
    double place = 0.0;
    double deviation = 0.0;
    for (std::size_t i = from; i < to; ++i) {
      place += points.places[i];
      deviation += points.deviations[i];
    }
    means.places.push_back(place / static_cast<double>(to - from));
    means.deviations.push_back(deviation / static_cast<double>(to - from));
  }
  return means;
}

std::vector<Vec2> beside(const ClothoidSpline& reference, const PlacedPoints& placed) {
  std::vector<Vec2> points;
  for (std::size_t i = 0; i < placed.places.size(); ++i) {
    const CenterlinePoint place = reference.at(placed.places[i]);
    const Vec2 across{-math::sin(place.slope_angle), math::cos(place.slope_angle)};
    points.push_back(Vec2{place.x, place.drop} + placed.deviations[i] * across);
  }
  return points;
}

std::vector<Vec2> from(Vec2 start, std::vector<Vec2> points) {
  for (Vec2& point : points) point = point - start;
  return points;
}

/// Whether a piece goes round and round between points: no track does, and no spline holds it.
bool winds(const PiecewiseProfile& profile) {
  constexpr double kMostTurn = 100.0;  // [rad]
  return std::any_of(profile.pieces.begin(), profile.pieces.end(), [](const ProfilePiece& piece) {
    double most = std::max(std::fabs(piece.entry_curvature), std::fabs(piece.exit_curvature));
    for (std::size_t i = 0; i < piece.swellings; ++i) most += std::fabs(piece.swelling[i]);
    return !(piece.length * most <= kMostTurn);
  });
}

class Descriptions {
 public:
  /// @param noise  mean square of what is known to be noise [m^2]
  Descriptions(const std::vector<Vec2>& points, double noise) : points_(points), noise_(noise) {}

  [[nodiscard]] const std::optional<PieceFit>& best() const { return best_; }
  /// Whether few pieces, none of them short, leave nothing but the noise that is known.
  [[nodiscard]] bool as_good_as_noise() const {
    constexpr std::size_t kFew = 8;
    constexpr double kSeen = 8.0;  // points that a piece has at least
    // Of this many standard deviations of a mean of squares, as rounding has them.
    constexpr double kChance = 3.0;
    constexpr double kOfRounding = 0.8;
    if (!best_ || best_->profile().pieces.size() > kFew) return false;
    const auto count = static_cast<double>(points_.size());
    const double least = kSeen * best_->profile().length() / count;
    const std::vector<ProfilePiece>& pieces = best_->profile().pieces;
    const bool seen = std::all_of(pieces.begin(), pieces.end(),
                                  [&](const ProfilePiece& piece) { return piece.length > least; });
    const double length = best_->profile().length();
    const double floor = std::max(noise_, kRounding * length * length);
    return seen && best_->square_sum() <= floor * (count + kChance * std::sqrt(kOfRounding * count));
  }

  /// Tries one description, of means of neighbours beside a reference.
  void add(const ClothoidSpline& reference, const PlacedPoints& placed, double scatter) {
    const PlacedPoints deciding = means_of_neighbours(placed, kMostDeciding);
    const auto cut = partition(reference, deciding, scatter);
    if (!cut) return;
    Describer describer(beside(reference, deciding), deciding.places, *cut, scatter);
    describer.simplify_all();
    describer.reshape();
    describer.simplify_all();
    keep_if_better(PieceFit(points_, placed.places, describer.profile()));
  }

  /// Tries straights that meet at angles, as the points themselves show them.
  void add_straights(const PlacedPoints& placed, double scatter) {
    constexpr double kBeyondNoise = 4.5;  // theory: standard deviations, of some 100 000 points one
    const auto straights = straights_through(points_, kBeyondNoise * scatter);
    if (straights) keep_if_better(PieceFit(points_, placed.places, straights->profile));
  }
  /// How often a better one was found.
  [[nodiscard]] std::size_t changes() const { return changes_; }

 private:
  void keep_if_better(PieceFit fit) {
    fit.relax(0.0, kMostRounds);
    if (winds(fit.profile()) || (best_ && score(fit) >= score(*best_))) return;
    best_ = std::move(fit);
    ++changes_;
  }

  /// The Bayesian information criterion.
  [[nodiscard]] double score(const PieceFit& fit) const {
    const auto count = static_cast<double>(points_.size());
    const double length = fit.profile().length();
    const double noise = noise_ * (1.0 - std::min(1.0, freedom_of(fit) / count));
    const double mean_square = std::max({fit.square_sum() / count, noise, kRounding * length * length});
    return count * math::log(mean_square) +
           (freedom_of(fit) + prices_of_kinds(fit, points_.size())) * math::log(count);
  }

  // The series of a cubic bend leave some 1e-12 of the length: below the square of 1e-11 nothing is better.
  static constexpr double kRounding = 1e-22;

  const std::vector<Vec2>& points_;
  double noise_ = 0.0;
  std::optional<PieceFit> best_;
  std::size_t changes_ = 0;
};

}  // namespace

std::optional<Description> describe_in_pieces(const std::vector<Vec2>& points,
                                              const ClothoidSpline& reference,
                                              const std::optional<LastPlaces>& places) {
  const auto count = static_cast<double>(points.size());
  const double share = std::sqrt(std::min(1.0, static_cast<double>(kMostDeciding) / count));
  const PlacedPoints placed = placed_beside(reference, points);
  const double noise = places ? noise_of_rounding(points, *places) : 0.0;
  const double scatter = share * std::max(std::sqrt(noise), scatter_of(reference, placed));
  const double coarse = kLeastScatters.front() * reference.length();
  const bool scattered = places || scatter >= coarse;
  Descriptions descriptions(points, noise);
  // Beside a curve that rings the means of neighbours lie off where curvature breaks, and beside a smooth one small jumps
  // do not show.
  const auto add_beside_best = [&] {
    const bool told = scattered && points.size() <= kMostDeciding;
    if (!descriptions.best() || told || descriptions.as_good_as_noise()) return;
    const PiecewiseProfile rough = descriptions.best()->profile();
    // A reference need only lie near: measured, one to the last digit finds no better pieces.
    constexpr double kNear = 1e-5;
    const ClothoidSpline nearer = rough.spline(kNear);
    const PlacedPoints again = placed_beside(nearer, from(rough.start(points.front()), points));
    const double seen = share * std::max(std::sqrt(noise), scatter_of(nearer, again));
    descriptions.add(nearer, again, std::max(seen, kLeastScatterAtLast * nearer.length()));
  };
  descriptions.add(reference, placed, std::max(scatter, coarse));
  if (scattered) descriptions.add_straights(placed, scatter / share);
  add_beside_best();
  const std::size_t seen_best = descriptions.changes();
  if (scatter < coarse && !descriptions.as_good_as_noise()) {
    descriptions.add(reference, placed, std::max(scatter, kLeastScatters.back() * reference.length()));
  }
  if (places && !descriptions.as_good_as_noise()) {
    // What rounding leaves along a straight goes on in steps, which look like shape: as chance has it they do not.
    const PlacedPoints moved = placed_beside(reference, dithered(points, *places));
    descriptions.add(reference, moved,
                     share * std::max(std::sqrt(2.0 * noise), scatter_of(reference, moved)));
  }
  if (descriptions.changes() != seen_best) add_beside_best();
  if (!descriptions.best()) return {};
  const PieceFit& fit = *descriptions.best();
  return Description{fit.profile(), fit.square_sum() / count, scattered, freedom_of(fit),
                     prices_of_kinds(fit, points.size())};
}

std::optional<CurvatureRange> largest_curvature_of(const Description& description,
                                                   const std::vector<Vec2>& points,
                                                   const std::optional<LastPlaces>& places) {
  if (!description.scattered) return {};
  const auto count = static_cast<double>(points.size());
  const double share = std::sqrt(std::min(1.0, static_cast<double>(kMostDeciding) / count));
  const double noise = places ? noise_of_rounding(points, *places) : 0.0;
  PiecewiseProfile profile = description.profile;
  const ClothoidSpline near = profile.spline();
  const PlacedPoints last = placed_beside(near, from(profile.start(points.front()), points));
  const PlacedPoints deciding = means_of_neighbours(last, kMostDeciding);
  const double seen = share * std::max(std::sqrt(noise), scatter_of(near, last));
  profile.offset = 0.0;
  return Describer(beside(near, deciding), deciding.places, profile, seen).largest_curvature();
}

}  // namespace glissade::centerline
