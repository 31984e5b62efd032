// A profile of few pieces, fitted to points: Gauss-Newton in the lengths and curvatures of the pieces.
#include "centerline/profile/profile_pieces.hpp"

#include "glissade/core/many_angles.hpp"
#include "glissade/core/math.hpp"

#include "centerline/numerics/chebyshev_series.hpp"
#include "centerline/profile/profile_model.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <boost/math/quadrature/gauss.hpp>

namespace glissade::centerline {
namespace {

// Of those that Boost has as a table: on a panel that turns by so much it is wrong by some 1e-21.
constexpr unsigned kPieceGaussPoints = 7;
constexpr double kPanelTurning = 0.7;

// Order of the unknowns in front of those of the pieces.
constexpr std::size_t kOffset = 0;
constexpr std::size_t kEntrySlope = 1;
constexpr std::size_t kFirstPiece = 2;

// Swellings: 4 u (1 - u) times 1, w, w^2, w^3 with w = 2 u - 1.
double swelling(std::size_t index, double u) {
  double value = 4.0 * u * (1.0 - u);
  for (std::size_t i = 0; i < index; ++i) value *= 2.0 * u - 1.0;
  return value;
}

/// Integrals of the swellings from 0 to u: with w, 4 u (1 - u) = 1 - w^2.
std::array<double, kMostSwellings> swelling_areas(std::size_t count, double u) {
  const double w = 2.0 * u - 1.0;
  std::array<double, kMostSwellings> areas{};
  double power = w;
  double from = -1.0;  // the power where u is 0
  for (std::size_t i = 0; i < count; ++i, power *= w, from = -from) {
    const auto n = static_cast<double>(i + 1);
    areas[i] = 0.5 * power * (1.0 / n - w * w / (n + 2.0)) - 0.5 * from * (1.0 / n - 1.0 / (n + 2.0));
  }
  return areas;
}

// A cubic parabola eta = xi^3 w/(3 d^2), w = tan(turn), by the share u of its length (CubicBend): with y = xi/d,
// Int_0^y sqrt(1 + w^2 t^4) dt = u Int_0^1 and it has turned by atan(w y^2).

/// Int_0^y sqrt(1 + w^2 t^4) dt by the binomial series; w^2 below 1/3.
double cubic_length(double w2, double y) {
  const double ratio = w2 * y * y * y * y;
  double coefficient = 1.0;
  double power = 1.0;
  double sum = 1.0;
  for (int n = 1; n < 40; ++n) {
    coefficient *= (1.5 - n) / n;
    power *= ratio;
    const double term = coefficient * power / (4.0 * n + 1.0);
    sum += term;
    if (std::fabs(term) < 1e-17) break;
  }
  return y * sum;
}

double cubic_reach(double w2, double u) {
  const double length = u * cubic_length(w2, 1.0);
  double y = length;
  for (int i = 0; i < 8; ++i) {
    const double step = (cubic_length(w2, y) - length) / std::sqrt(1.0 + w2 * y * y * y * y);
    y -= step;
    if (std::fabs(step) < 1e-12) break;
  }
  return y;
}

/// @param turn  of the whole bend, not negative
double cubic_turned(double turn, double u) {
  const double w = math::tan(turn);
  const double y = cubic_reach(w * w, u);
  return math::atan(w * y * y);
}

/// Curvature times length where it ends.
double cubic_bending(double turn) {
  const double w = math::tan(turn);
  const auto [sine, cosine] = math::sine_cosine(turn);
  return 2.0 * sine * cosine * cosine * cubic_length(w * w, 1.0);
}

/// Curvature times length at u.
double cubic_curvature(double turn, double u) {
  const double w = math::tan(turn);
  const double y = cubic_reach(w * w, u);
  const double slope = w * y * y;
  const double stretch = 1.0 + slope * slope;
  return 2.0 * w * y / (stretch * std::sqrt(stretch)) * cubic_length(w * w, 1.0);
}

/// @param turn  of the whole bend, not negative
CubicShape cubic_shape(double turn) {
  constexpr double kStep = 1e-5;
  CubicShape shape{turn, kStep / (cubic_bending(turn + kStep) - cubic_bending(turn)), {}, {}, {}};
  const double low = std::max(0.0, turn - kStep);
  for (std::size_t j = 0; j < CubicShape::kTerms; ++j) {
    const double u2 = std::sqrt(0.5 * (1.0 + node_cosine<CubicShape::kTerms>(1, j)));
    const double u = std::sqrt(u2);
    shape.turned[j] = cubic_turned(turn, u) / u2;
    shape.by_turn[j] = (cubic_turned(turn + kStep, u) - cubic_turned(low, u)) / ((turn + kStep - low) * u2);
    shape.bending[j] = cubic_curvature(turn, u) / u;
  }
  shape.turned = chebyshev_series(shape.turned);
  shape.by_turn = chebyshev_series(shape.by_turn);
  shape.bending = chebyshev_series(shape.bending);
  return shape;
}

/// How far a cubic bend has turned up to u, and the same by its whole turn.
struct CubicTurn {
  double turned = 0.0;
  double by_turn = 0.0;
};

CubicTurn cubic_turn(const ProfilePiece& piece, double u) {
  const double side = piece.cubic.turn < 0.0 ? -1.0 : 1.0;
  const double from_straight = piece.backwards() ? 1.0 - u : u;
  const double u2 = from_straight * from_straight;
  const double at = 2.0 * u2 * u2 - 1.0;
  const double turned = side * u2 * chebyshev_value(piece.cubic.turned, at);
  const double by_turn = u2 * chebyshev_value(piece.cubic.by_turn, at);
  if (!piece.backwards()) return {turned, by_turn};
  return {piece.cubic.turn - turned, 1.0 - by_turn};
}

/// Angle that a piece has turned by up to u, over its length.
double turned_share(const ProfilePiece& piece, double u) {
  if (piece.shape == PieceShape::cubic) return cubic_turn(piece, u).turned / piece.length;
  double sum = piece.entry_curvature * (u - 0.5 * u * u) + piece.exit_curvature * (0.5 * u * u);
  if (piece.swellings == 0) return sum;
  const auto areas = swelling_areas(piece.swellings, u);
  for (std::size_t i = 0; i < piece.swellings; ++i) sum += piece.swelling[i] * areas[i];
  return sum;
}

double slope_after(double slope, const ProfilePiece& piece, double t) {
  return slope - piece.length * turned_share(piece, t / piece.length);
}

/// Whether a clothoid runs out into the straight behind it.
bool ends_straight(const PiecewiseProfile& profile, std::size_t k) {
  if (k + 1 == profile.pieces.size()) return false;
  const ProfilePiece& behind = profile.pieces[k + 1];
  return behind.tied && behind.shape == PieceShape::straight;
}

Vec2 tangent_of(double slope) {
  const auto [sine, cosine] = math::sine_cosine(slope);
  return {cosine, sine};
}

}  // namespace

bool ProfilePiece::settle_cubic() {
  const double curvature = backwards() ? entry_curvature : exit_curvature;
  const double wanted = std::fabs(curvature) * length;
  if (!(wanted <= cubic_bending(kMostCubicTurn))) return false;
  double found = 0.5 * wanted;
  for (int i = 0; i < 40; ++i) {
    constexpr double kStep = 1e-6;
    const double rate = (cubic_bending(found + kStep) - cubic_bending(found)) / kStep;
    const double step = (cubic_bending(found) - wanted) / rate;
    found = std::clamp(found - step, 0.0, 1.1 * kMostCubicTurn);
    if (std::fabs(step) < 1e-15) break;
  }
  cubic = cubic_shape(found);
  if (curvature < 0.0) cubic.turn = -found;
  return true;
}

std::optional<ProfilePiece> cubic_piece(double length, double turn, bool backwards) {
  if (turn == 0.0 || std::fabs(turn) > kMostCubicTurn) return {};
  const double bending = cubic_bending(std::fabs(turn)) / length;
  const double curvature = turn < 0.0 ? -bending : bending;
  ProfilePiece piece{PieceShape::cubic, length, backwards ? curvature : 0.0, backwards ? 0.0 : curvature};
  if (!piece.settle_cubic()) return {};
  return piece;
}

double ProfilePiece::curvature(double u) const {
  if (shape == PieceShape::cubic) {
    const double from_straight = backwards() ? 1.0 - u : u;
    const double u2 = from_straight * from_straight;
    const double bending = from_straight * chebyshev_value(cubic.bending, 2.0 * u2 * u2 - 1.0) / length;
    return cubic.turn < 0.0 ? -bending : bending;
  }
  double sum = entry_curvature + u * (exit_curvature - entry_curvature);
  for (std::size_t i = 0; i < swellings; ++i) sum += this->swelling[i] * centerline::swelling(i, u);
  return sum;
}

double PiecewiseProfile::length() const {
  double sum = 0.0;
  for (const ProfilePiece& piece : pieces) sum += piece.length;
  return sum;
}

namespace {

/// A bend as clothoids of equal length, as many as told, at least 4.
std::vector<ClothoidSegment> clothoids_of(const ProfilePiece& piece, std::size_t count) {
  const double step = 1.0 / static_cast<double>(count);
  // Chords of a curvature that bulges one way turn too little: by a twelfth of its second difference each.
  const auto lost = [&](std::size_t i) {
    const double u = static_cast<double>(i) * step;
    return (piece.curvature(u + step) - 2.0 * piece.curvature(u) + piece.curvature(u - step)) / 12.0;
  };
  // The ends have the curvature that they have: it is what the smallest radius is read from. Half of what they lose, as
  // one of their chords does, the node beside them makes up for.
  const auto node = [&](std::size_t i) {
    if (i == 0 || i == count) return i == 0 ? piece.entry_curvature : piece.exit_curvature;
    const double beside = i == 1 || i + 1 == count ? 0.5 * lost(i) : 0.0;
    return piece.curvature(static_cast<double>(i) * step) - lost(i) - beside;
  };
  std::vector<ClothoidSegment> segments;
  for (std::size_t i = 0; i < count; ++i) segments.push_back({piece.length * step, node(i), node(i + 1)});
  return segments;
}

/// The farthest that two rows of clothoids of the same length pass each other, at some places along them.
double apart(const std::vector<ClothoidSegment>& one, const std::vector<ClothoidSegment>& other) {
  constexpr int kPlaces = 8;  // taste: one to each of the fewest clothoids
  const ClothoidSpline here(Angle::from_radians(0.0), one);
  const ClothoidSpline there(Angle::from_radians(0.0), other);
  double most = 0.0;
  for (int i = 1; i <= kPlaces; ++i) {
    const CenterlinePoint a = here.at(here.length() * i / kPlaces);
    const CenterlinePoint b = there.at(there.length() * i / kPlaces);
    most = std::max(most, norm(Vec2{a.x - b.x, a.drop - b.drop}));
  }
  return most;
}

/// A bend as so many clothoids that twice as many pass the same places: two that end in the same place may differ between.
/// @param alike  share of the length
std::vector<ClothoidSegment> clothoids_of(const ProfilePiece& piece, double alike) {
  constexpr std::size_t kFewest = 8;
  constexpr std::size_t kMost = 64;
  std::vector<ClothoidSegment> segments = clothoids_of(piece, kFewest);
  for (std::size_t count = 2 * kFewest; count <= kMost; count *= 2) {
    std::vector<ClothoidSegment> finer = clothoids_of(piece, count);
    const double passed = apart(finer, segments);
    segments = std::move(finer);
    if (passed <= alike * piece.length) break;
  }
  return segments;
}

}  // namespace

ClothoidSpline PiecewiseProfile::spline(double alike) const {
  std::vector<ClothoidSegment> segments;
  for (const ProfilePiece& piece : pieces) {
    if (piece.shape == PieceShape::bend || piece.shape == PieceShape::cubic) {
      const std::vector<ClothoidSegment> bend = clothoids_of(piece, alike);
      segments.insert(segments.end(), bend.begin(), bend.end());
    } else {
      segments.push_back({piece.length, piece.entry_curvature, piece.exit_curvature});
    }
  }
  return {Angle::from_radians(entry), std::move(segments)};
}

Vec2 PiecewiseProfile::start(Vec2 first_point) const {
  return first_point + offset * perpendicular(tangent_of(entry));
}

/// Half the sum of the squared distances to second order: matrix and gradient in the scaled unknowns.
struct PieceFit::System {
  explicit System(std::size_t size) : matrix(size), gradient(size, 0.0) {}
  SymmetricMatrix matrix;
  std::vector<double> gradient;
};

PieceFit::PieceFit(const std::vector<Vec2>& points, std::vector<double> places, PiecewiseProfile profile)
    : points_(points), places_(std::move(places)), profile_(std::move(profile)), scale_(places_.back()) {
  number_unknowns();
  lay_out();
  square_sum_ = project();
}

void PieceFit::number_unknowns() {
  columns_.clear();
  std::size_t next = kFirstPiece;
  for (std::size_t k = 0; k < profile_.pieces.size(); ++k) {
    const ProfilePiece& piece = profile_.pieces[k];
    Columns columns{next++, kNone, kNone, kNone};
    const std::size_t before = k > 0 ? columns_[k - 1].exit_curvature : kNone;
    if (piece.shape == PieceShape::cubic) {
      if (piece.backwards()) {
        columns.entry_curvature = piece.tied ? before : next++;
      } else {
        columns.exit_curvature = next++;
      }
      columns.first_swelling = next;
      columns_.push_back(columns);
      continue;
    }
    if (piece.shape != PieceShape::straight) columns.entry_curvature = piece.tied ? before : next++;
    columns.exit_curvature = columns.entry_curvature;
    if (!piece.constant()) columns.exit_curvature = ends_straight(profile_, k) ? kNone : next++;
    columns.first_swelling = next;
    next += piece.swellings;
    columns_.push_back(columns);
  }
  unknowns_ = next;
}

PieceFit::Ways PieceFit::ways_at(const ProfilePiece& piece, double t) {
  const double u = t / piece.length;
  Ways ways{};
  if (piece.shape == PieceShape::cubic) {
    const double by_turn = cubic_turn(piece, u).by_turn * piece.cubic.turn_by_bending;
    const double curvature = piece.backwards() ? piece.entry_curvature : piece.exit_curvature;
    ways[piece.backwards() ? 0 : 1] = -by_turn * piece.length;
    ways[2] = u * piece.curvature(u) - by_turn * curvature;
    return ways;
  }
  ways[0] = -piece.length * (u - 0.5 * u * u);
  ways[1] = -piece.length * 0.5 * u * u;
  ways[2] = u * piece.curvature(u) - turned_share(piece, u);
  const auto areas = swelling_areas(piece.swellings, u);
  for (std::size_t i = 0; i < piece.swellings; ++i) ways[3 + i] = -piece.length * areas[i];
  return ways;
}

/// Those of Gauss's rule from where a panel begins, the middle one first, and the end.
struct PieceFit::Nodes {
  using Rule = boost::math::quadrature::gauss<double, kPieceGaussPoints>;
  static_assert(kPieceGaussPoints % 2 == 1, "the first of Boost's nodes is the middle one");
  static constexpr std::size_t kCount = kPieceGaussPoints;

  Nodes(const ProfilePiece& piece, const Laid& laid, const Panel& panel, double distance) {
    const double half = 0.5 * (distance - panel.from);
    const double middle = panel.from + half;
    std::array<double, kCount + 1> slope;
    place[0] = middle;
    weight[0] = half * Rule::weights()[0];
    for (std::size_t i = 1; i < Rule::abscissa().size(); ++i) {
      place[2 * i - 1] = middle + -half * Rule::abscissa()[i];
      place[2 * i] = middle + half * Rule::abscissa()[i];
      weight[2 * i - 1] = weight[2 * i] = half * Rule::weights()[i];
    }
    for (std::size_t i = 0; i < kCount; ++i) slope[i] = slope_after(laid.slope, piece, place[i]);
    slope[kCount] = end_slope = slope_after(laid.slope, piece, distance);
    math::sines_cosines(slope, sine, cosine);
  }
  [[nodiscard]] Vec2 step(std::size_t i) const { return {weight[i] * cosine[i], weight[i] * sine[i]}; }
  [[nodiscard]] Vec2 end_tangent() const { return {cosine[kCount], sine[kCount]}; }

  double end_slope;
  std::array<double, kCount> place, weight;
  std::array<double, kCount + 1> sine, cosine;
};

const PieceFit::Panel& PieceFit::panel_at(const Laid& laid, double distance) {
  const auto next = std::upper_bound(laid.panels.begin() + 1, laid.panels.end(), distance,
                                     [](double value, const Panel& panel) { return value < panel.from; });
  return *std::prev(next);
}

PieceFit::Place PieceFit::place_along(const ProfilePiece& piece, const Laid& laid, double distance) {
  if (piece.shape == PieceShape::straight) {
    const Vec2 tangent = tangent_of(laid.slope);
    return {distance * tangent, tangent};
  }
  const Panel& panel = panel_at(laid, distance);
  const Nodes nodes(piece, laid, panel, distance);
  Place place{panel.position, nodes.end_tangent()};
  for (std::size_t i = 0; i < Nodes::kCount; ++i) place.position = place.position + nodes.step(i);
  return place;
}

PieceFit::Panel PieceFit::along(const ProfilePiece& piece, const Laid& laid, double distance) {
  if (piece.shape == PieceShape::straight)
    return {distance, laid.slope, distance * tangent_of(laid.slope), {}};
  const Panel& panel = panel_at(laid, distance);
  const Nodes nodes(piece, laid, panel, distance);
  Panel sum{distance, nodes.end_slope, panel.position, panel.turned};
  const std::size_t ways_count = 3 + piece.swellings;
  for (std::size_t i = 0; i < Nodes::kCount; ++i) {
    const Vec2 step = nodes.step(i);
    sum.position = sum.position + step;
    const Ways ways = ways_at(piece, nodes.place[i]);
    for (std::size_t w = 0; w < ways_count; ++w)
      sum.turned[w] = sum.turned[w] + ways[w] * perpendicular(step);
  }
  return sum;
}

void PieceFit::lay_out() {
  laid_.clear();
  Laid next{0.0, profile_.start(points_.front()), profile_.entry, {}, {}, {}, {}, {}};
  for (const ProfilePiece& piece : profile_.pieces) {
    double most = std::max(std::fabs(piece.entry_curvature), std::fabs(piece.exit_curvature));
    for (std::size_t i = 0; i < piece.swellings; ++i) most += std::fabs(piece.swelling[i]);
    const double turning = piece.length * most;
    const auto count = static_cast<int>(std::clamp(std::ceil(turning / kPanelTurning), 1.0, 1000.0));
    next.panels = {{0.0, next.slope, {}, {}}};
    for (int i = 1; i < count; ++i) next.panels.push_back(along(piece, next, piece.length * i / count));
    next.end = along(piece, next, piece.length);
    next.tangent = tangent_of(next.slope);
    next.end_tangent = tangent_of(next.end.slope);
    next.end_ways = ways_at(piece, piece.length);
    laid_.push_back(next);
    next = {next.from + piece.length, next.start + next.end.position, next.end.slope, {}, {}, {}, {}, {}};
  }
}

std::size_t PieceFit::piece_at(double s) const {
  const auto next = std::upper_bound(laid_.begin() + 1, laid_.end(), s,
                                     [](double value, const Laid& laid) { return value < laid.from; });
  return static_cast<std::size_t>(next - laid_.begin()) - 1;
}

double PieceFit::project() {
  constexpr int kNewtonSteps = 4;
  // Half its square times the curvature is what it does to a distance.
  constexpr double kNear = 1e-9;
  const double length = profile_.length();
  const double stretch = length / places_.back();
  double sum = 0.0;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    double s = std::min(places_[i] * stretch, length);
    Vec2 away;
    Place here;
    const bool last = i + 1 == points_.size();
    for (int step = 0; step <= kNewtonSteps; ++step) {
      if (last) s = length;
      const std::size_t k = piece_at(s);
      here = place_along(profile_.pieces[k], laid_[k], s - laid_[k].from);
      away = points_[i] - (laid_[k].start + here.position);
      const double next = std::clamp(s + dot(away, here.tangent), 0.0, length);
      const double moved = std::fabs(next - s);
      if (last || step == kNewtonSteps || moved <= kNear * length) break;
      s = next;
    }
    places_[i] = s;
    const double across = dot(away, perpendicular(here.tangent));
    sum += across * across;
    if (last) sum += dot(away, here.tangent) * dot(away, here.tangent);
  }
  return sum;
}

/// How a place in the direction given moves with each unknown.
void PieceFit::fill_row(std::size_t piece, const Panel& here, Vec2 position, Vec2 direction, bool at_end,
                        std::vector<double>& row) const {
  std::fill(row.begin(), row.end(), 0.0);
  const auto add = [&](std::size_t column, double value) {
    if (column != kNone) row[column] += value;
  };
  const Vec2 start = laid_.front().start;
  const Vec2 entry = laid_.front().tangent;
  row[kOffset] = dot(direction, perpendicular(entry));
  row[kEntrySlope] =
      dot(direction, perpendicular(position - start)) - profile_.offset * dot(direction, entry);
  for (std::size_t k = 0; k <= piece; ++k) {
    const ProfilePiece& of = profile_.pieces[k];
    const bool own = k == piece;
    const Panel& end = own ? here : laid_[k].end;
    Ways by{};
    for (std::size_t w = 0; w < 3 + of.swellings; ++w) by[w] = dot(direction, end.turned[w]);
    if (!own) by[2] += dot(direction, laid_[k].end_tangent);
    if (own && at_end) by[2] += dot(direction, tangent_of(end.slope));
    if (!own) {
      // All behind the piece turns about its end.
      const double lever = dot(direction, perpendicular(position - laid_[k + 1].start));
      const Ways& turned = laid_[k].end_ways;
      for (std::size_t w = 0; w < 3 + of.swellings; ++w) by[w] += turned[w] * lever;
      // Longer altogether, and not measured at the same place: its end turns by all of what it is longer.
      by[2] -= of.exit_curvature * lever;
    }
    add(columns_[k].entry_curvature, by[0]);
    add(columns_[k].exit_curvature, by[1]);
    add(columns_[k].length, by[2]);
    for (std::size_t i = 0; i < of.swellings; ++i) add(columns_[k].first_swelling + i, by[3 + i]);
  }
}

PieceFit::System PieceFit::linearized() const {
  System sum(unknowns_);
  std::vector<double> row(unknowns_);
  // Unknowns of like size: lengths over the scale, curvatures times it.
  std::vector<double> unit(unknowns_, scale_);
  unit[kEntrySlope] = 1.0;
  for (const Columns& columns : columns_) {
    if (columns.entry_curvature != kNone) unit[columns.entry_curvature] = 1.0 / scale_;
    if (columns.exit_curvature != kNone) unit[columns.exit_curvature] = 1.0 / scale_;
  }
  for (std::size_t k = 0; k < columns_.size(); ++k) {
    for (std::size_t i = 0; i < profile_.pieces[k].swellings; ++i) {
      unit[columns_[k].first_swelling + i] = 1.0 / scale_;
    }
  }
  const auto add = [&](std::size_t k, const Panel& here, Vec2 position, Vec2 away, Vec2 direction,
                       bool at_end) {
    fill_row(k, here, position, direction, at_end, row);
    const double distance = dot(away, direction);
    // Unknowns stand in the order of the pieces: behind those of this piece the row is empty.
    const std::size_t size = k + 1 < columns_.size() ? columns_[k + 1].length : unknowns_;
    for (std::size_t a = 0; a < size; ++a) {
      row[a] *= unit[a];
      sum.gradient[a] -= distance * row[a];
      double* const into = &sum.matrix.at(a, 0);
      for (std::size_t b = 0; b <= a; ++b) into[b] += row[a] * row[b];
    }
  };
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const std::size_t k = piece_at(places_[i]);
    const Panel here = along(profile_.pieces[k], laid_[k], places_[i] - laid_[k].from);
    const Vec2 position = laid_[k].start + here.position;
    const Vec2 away = points_[i] - position;
    const Vec2 tangent = tangent_of(here.slope);
    const bool last = i + 1 == points_.size();
    add(k, here, position, away, perpendicular(tangent), last);
    if (last) add(k, here, position, away, tangent, true);
  }
  return sum;
}

PiecewiseProfile PieceFit::moved(const std::vector<double>& move) const {
  PiecewiseProfile next = profile_;
  next.offset -= scale_ * move[kOffset];
  next.entry -= move[kEntrySlope];
  for (std::size_t k = 0; k < next.pieces.size(); ++k) {
    ProfilePiece& piece = next.pieces[k];
    const Columns& columns = columns_[k];
    piece.length -= scale_ * move[columns.length];
    if (columns.entry_curvature != kNone) piece.entry_curvature -= move[columns.entry_curvature] / scale_;
    if (columns.exit_curvature != kNone) piece.exit_curvature -= move[columns.exit_curvature] / scale_;
    if (piece.shape == PieceShape::cubic && !piece.settle_cubic())
      piece.length = 0.0;  // which relax() refuses
    for (std::size_t i = 0; i < piece.swellings; ++i) {
      piece.swelling[i] -= move[columns.first_swelling + i] / scale_;
    }
  }
  return next;
}

void PieceFit::relax(double least_gain, int most_steps) {
  // Least share of its length that a piece may lose or keep in a step.
  constexpr double kLeastKept = 0.25;
  constexpr double kRounding = 1e-30;
  constexpr double kSettled = 1e-8;
  double damping = 1e-9;
  factor_.reset();
  const double nothing = kRounding * scale_ * scale_ * static_cast<double>(points_.size());
  for (int step = 0; step < most_steps && square_sum_ > nothing; ++step) {
    System here = linearized();
    bool better = false;
    double gain = 0.0;
    for (int attempt = 0; attempt < 12 && !better; ++attempt, damping *= 10.0) {
      SymmetricMatrix matrix = here.matrix;
      for (std::size_t i = 0; i < unknowns_; ++i) matrix.at(i, i) += damping * matrix.at(i, i) + 1e-300;
      if (!matrix.factorize()) continue;
      std::vector<double> move = here.gradient;
      matrix.solve_forward(move);
      matrix.solve_backward(move);
      PiecewiseProfile next = moved(move);
      bool usable = true;
      for (std::size_t k = 0; k < next.pieces.size(); ++k) {
        usable = usable && next.pieces[k].length > kLeastKept * profile_.pieces[k].length;
      }
      if (!usable) continue;
      std::swap(next, profile_);
      const std::vector<double> places = places_;
      lay_out();
      const double value = project();
      better = value < square_sum_;
      if (better) {
        gain = square_sum_ - value;
        square_sum_ = value;
      } else {
        std::swap(next, profile_);
        places_ = places;
        lay_out();
      }
    }
    damping = std::max(1e-12, 1e-3 * damping);
    if (!better || gain <= std::max(least_gain, kSettled * square_sum_)) break;
  }
}

/// Variance of a linear combination of the unknowns, as they are scaled, where that of the points is 1.
std::optional<double> PieceFit::variance_of(const Terms& terms) const {
  if (!factor_) {
    SymmetricMatrix matrix = linearized().matrix;
    for (std::size_t i = 0; i < unknowns_; ++i) matrix.at(i, i) += 1e-12 * matrix.at(i, i) + 1e-300;
    if (!matrix.factorize()) return {};
    factor_ = std::move(matrix);
  }
  std::vector<double> combination(unknowns_, 0.0);
  bool any = false;
  for (const auto& [column, weight] : terms) {
    if (column == kNone) continue;
    combination[column] += weight;
    any = true;
  }
  if (!any) return {};
  factor_->solve_forward(combination);
  double variance = 0.0;
  for (const double part : combination) variance += part * part;
  if (!(variance > 0.0)) return {};
  return variance;
}

/// Growth of the sum of squares if a linear combination of the unknowns, now `value`, were made zero.
std::optional<double> PieceFit::price(const Terms& terms, double value) const {
  const auto variance = variance_of(terms);
  if (!variance) return {};
  return value * scale_ * (value * scale_) / *variance;
}

std::optional<Sharpest> PieceFit::sharpest() const {
  Sharpest found;
  Terms terms;
  for (std::size_t k = 0; k < profile_.pieces.size(); ++k) {
    const ProfilePiece& piece = profile_.pieces[k];
    const Columns& columns = columns_[k];
    const int places = piece.shape == PieceShape::bend ? 4 : 1;
    for (int i = 0; i <= places; ++i) {
      const double u = static_cast<double>(i) / places;
      const double curvature = std::fabs(piece.curvature(u));
      if (!(curvature > found.curvature)) continue;
      found.curvature = curvature;
      terms = {{columns.entry_curvature, 1.0 - u}, {columns.exit_curvature, u}};
      for (std::size_t j = 0; j < piece.swellings; ++j)
        terms.emplace_back(columns.first_swelling + j, swelling(j, u));
    }
  }
  const auto variance = variance_of(terms);
  if (!variance) return {};
  found.deviation = std::sqrt(*variance) / scale_;
  return found;
}

std::optional<double> PieceFit::price_of_tie(std::size_t joint) const {
  const ProfilePiece& piece = profile_.pieces[joint];
  const ProfilePiece& before = profile_.pieces[joint - 1];
  if (piece.shape == PieceShape::cubic || before.shape == PieceShape::cubic) return {};
  // Two that are constant would become one piece: that is no tie.
  if (piece.tied || (piece.constant() && before.constant())) return {};
  return price({{columns_[joint].entry_curvature, 1.0}, {columns_[joint - 1].exit_curvature, -1.0}},
               piece.entry_curvature - before.exit_curvature);
}

std::optional<double> PieceFit::price_of_simpler(std::size_t k) const {
  const ProfilePiece& piece = profile_.pieces[k];
  if (piece.shape == PieceShape::cubic) return {};
  if (piece.shape == PieceShape::bend) {
    const std::size_t highest = piece.swellings - 1;
    return price({{columns_[k].first_swelling + highest, 1.0}}, piece.swelling[highest]);
  }
  const bool held = piece.tied || (k + 1 < profile_.pieces.size() && profile_.pieces[k + 1].tied);
  if (held || piece.shape == PieceShape::straight) return {};
  if (piece.shape == PieceShape::arc) {
    return price({{columns_[k].entry_curvature, 1.0}}, piece.entry_curvature);
  }
  return price({{columns_[k].entry_curvature, 1.0}, {columns_[k].exit_curvature, -1.0}},
               piece.entry_curvature - piece.exit_curvature);
}

std::optional<double> PieceFit::price_of_merger(std::size_t joint) const {
  const ProfilePiece& piece = profile_.pieces[joint];
  const ProfilePiece& before = profile_.pieces[joint - 1];
  const auto is_other = [](const ProfilePiece& of) {
    return of.shape == PieceShape::bend || of.shape == PieceShape::cubic;
  };
  if (is_other(piece) || is_other(before)) return {};
  if (!piece.tied) {
    if (!piece.constant() || !before.constant()) return {};
    return price({{columns_[joint].entry_curvature, 1.0}, {columns_[joint - 1].exit_curvature, -1.0}},
                 piece.entry_curvature - before.exit_curvature);
  }
  const double rate = (piece.exit_curvature - piece.entry_curvature) / piece.length;
  const double rate_before = (before.exit_curvature - before.entry_curvature) / before.length;
  return price({{columns_[joint].exit_curvature, 1.0 / piece.length},
                {columns_[joint].entry_curvature, -1.0 / piece.length},
                {columns_[joint - 1].exit_curvature, -1.0 / before.length},
                {columns_[joint - 1].entry_curvature, 1.0 / before.length}},
               rate - rate_before);
}

}  // namespace glissade::centerline
