#include "glissade/centerline/tabulated_curve.hpp"

#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/vec.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include <boost/math/quadrature/gauss.hpp>

namespace glissade {
namespace {

constexpr unsigned kTableGaussPoints = 10;  // of those that Boost has as a table

/// Integral of density(p) * (cos, sin)(slope(p)) from a to b, in panels that turn little.
template <typename Slope>
Vec2 displacement(const Slope& slope, double a, double b, bool root, double turning) {
  using Rule = boost::math::quadrature::gauss<double, kTableGaussPoints>;
  constexpr double kPanelTurning = 0.5;
  constexpr double kMostPanels = 1000.0;
  const int panels = static_cast<int>(std::clamp(std::ceil(turning / kPanelTurning), 1.0, kMostPanels));
  Vec2 sum;
  for (int panel = 0; panel < panels; ++panel) {
    const double half = 0.5 * (b - a) / panels;
    const double middle = a + half * (2.0 * panel + 1.0);
    const auto add = [&](double p, double weight) {
      const auto [sine, cosine] = math::sine_cosine(slope(p));
      sum = sum + (half * weight * (root ? 2.0 * p : 1.0)) * Vec2{cosine, sine};
    };
    for (std::size_t i = 0; i < Rule::abscissa().size(); ++i) {
      add(middle - half * Rule::abscissa()[i], Rule::weights()[i]);
      add(middle + half * Rule::abscissa()[i], Rule::weights()[i]);
    }
  }
  return sum;
}

/// The cubic on [0, 1] of these values and derivatives at its ends.
void set_cubic(double (&cubic)[4], double from, double rise_from, double to, double rise_to) {
  cubic[0] = from;
  cubic[1] = rise_from;
  cubic[2] = 3.0 * (to - from) - 2.0 * rise_from - rise_to;
  cubic[3] = 2.0 * (from - to) + rise_from + rise_to;
}

double value_of(const double (&cubic)[4], double u) {
  return cubic[0] + u * (cubic[1] + u * (cubic[2] + u * cubic[3]));
}

double rise_of(const double (&cubic)[4], double u) {
  return cubic[1] + u * (2.0 * cubic[2] + u * 3.0 * cubic[3]);
}

/// A cubic whose derivatives at its ends lie between 0 and three times what it rises by grows all along.
double between_none_and(double most, double rise) {
  return std::clamp(rise, std::min(0.0, most), std::max(0.0, most));
}

double turning_of(const double (&cubic)[4]) {
  return std::fabs(cubic[1]) + std::fabs(cubic[2]) + std::fabs(cubic[3]);
}

std::string row_text(const std::vector<TabulatedPoint>& rows, std::size_t index) {
  return "row " + std::to_string(index + 1) + " (" + exact_text(rows[index].x) + ", " +
         exact_text(rows[index].drop) + ")";
}

bool same_place(const TabulatedPoint& a, const TabulatedPoint& b) {
  return a.x == b.x && a.drop == b.drop;
}

/// Whether the way from one row to the next is the one that their slope angles say.
bool agrees(const TabulatedPoint& a, const TabulatedPoint& b, double reach) {
  constexpr double kShareOfChord = 0.02;
  constexpr double kShareOfReach = 1e-6;
  const Vec2 chord{b.x - a.x, b.drop - a.drop};
  // The mean of two slope angles less a twelfth of the curvatures' difference, as the cubic has it.
  const double length = norm(chord);
  const double before = std::isfinite(a.curvature) ? a.curvature : 0.0;
  const double bow = std::isfinite(a.curvature) ? (before - b.curvature) * length / 12.0 : 0.0;
  const double slope = 0.5 * (a.slope_angle + b.slope_angle) - bow;
  const double off = std::fabs(cross(chord, {math::cos(slope), math::sin(slope)}));
  const double turn = std::fabs(a.slope_angle - b.slope_angle);
  const bool ahead = dot(chord, {math::cos(slope), math::sin(slope)}) > 0.0;
  return ahead && off <= (kShareOfChord + 0.3 * turn) * length + kShareOfReach * reach;
}

/// Slope per run of the parabola with an upright axis that touches a curve there; positive on a crest.
double parabola_rate(double slope_angle, double curvature) {
  const double cosine = math::cos(slope_angle);
  return -curvature / (cosine * cosine * cosine);
}

/// Whether a rate is that of one and the same crest.
bool same_crest(double rate, double other) {
  constexpr double kRounding = 1e-11;
  return rate > 0.0 && std::isfinite(rate) && std::fabs(rate - other) <= kRounding * rate;
}

/// Whether two rows lie on one crest of a parabola, as a body that flies by them goes.
bool on_one_flight(const TabulatedPoint& left, const TabulatedPoint& right) {
  constexpr double kRounding = 1e-9;
  constexpr double kPlaceRounding = 4.0 * std::numeric_limits<double>::epsilon();
  const double rate = parabola_rate(left.slope_angle, left.curvature);
  if (!same_crest(rate, parabola_rate(right.slope_angle, right.curvature))) return false;
  const double rise = math::tan(right.slope_angle) - math::tan(left.slope_angle);
  const double rounding = kRounding * rise + kPlaceRounding * rate * (std::fabs(left.x) + std::fabs(right.x));
  return rise > 0.0 && std::fabs(rise - rate * (right.x - left.x)) <= rounding;
}

/// Arc length of the parabola of rate 1 from its top to slope t.
double parabola_length(double t) {
  return 0.5 * (t * std::sqrt(1.0 + t * t) + math::asinh(t));
}

/// Two neighbouring rows, and by what the track turns between them [rad]: as their slope angles and as their curvatures
/// have it.
struct Turn {
  std::size_t row = 0;  // the second
  double by_slopes = 0.0;
  double by_curvatures = 0.0;
};

/// @return 1 where a table leads to the right, -1 where it leads to the left
double side_of(const std::vector<TabulatedPoint>& rows) {
  return rows.back().x < rows.front().x ? -1.0 : 1.0;
}

/// The row as a track that leads to the right has it.
TabulatedPoint seen_ahead(TabulatedPoint row, double side) {
  row.x *= side;
  return row;
}

/// How far rows lie from the first of them.
double reach_of(const std::vector<TabulatedPoint>& rows) {
  double reach = 0.0;
  for (const TabulatedPoint& row : rows) {
    reach = std::max(reach, math::hypot(row.x - rows.front().x, row.drop - rows.front().drop));
  }
  return reach;
}

/// Rows nearer to each other than this are told by rounding: where they lie says nothing of slope or curvature. It is what is
/// left of a bend that is sharper yet.
double rounded_chord(const std::vector<TabulatedPoint>& rows) {
  constexpr double kOfReach =
      1e-12;  // rounding: of arc lengths that add up, and of the curve they were taken from
  constexpr double kDigits = 1024.0 * std::numeric_limits<double>::epsilon();  // rounding: of coordinates
  double farthest = 0.0;
  for (const TabulatedPoint& row : rows)
    farthest = std::max({farthest, std::fabs(row.x), std::fabs(row.drop)});
  return std::max(kOfReach * reach_of(rows), kDigits * farthest);
}

/// The pair of rows whose curvatures are farthest from what the slope angles say, if those of the table are of another
/// sign or size as a whole: a least-squares line through all pairs tells, so that rounded columns do no harm.
std::optional<Turn> turns_otherwise(const std::vector<TabulatedPoint>& rows) {
  constexpr double kLeast = 0.5;
  constexpr double kMost = 2.0;
  constexpr double kHardly = 0.05;  // [rad]: so little turned tells nothing
  double product = 0.0;
  double square = 0.0;
  double turned = 0.0;
  double told = 0.0;
  Turn worst;
  const double least = rounded_chord(rows);
  const double side = side_of(rows);
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const TabulatedPoint& a = rows[i - 1];
    const TabulatedPoint& b = rows[i];
    if (!std::isfinite(a.curvature) || !std::isfinite(b.curvature)) continue;
    const double length = norm(Vec2{b.x - a.x, b.drop - a.drop});
    // The digits of a short one tell nothing, and a flight turns as far as it likes.
    if (length < least || on_one_flight(seen_ahead(a, side), seen_ahead(b, side))) continue;
    const Turn turn{i, a.slope_angle - b.slope_angle, 0.5 * (a.curvature + b.curvature) * length};
    product += turn.by_slopes * turn.by_curvatures;
    square += turn.by_curvatures * turn.by_curvatures;
    turned += std::fabs(turn.by_slopes);
    told += std::fabs(turn.by_curvatures);
    if (std::fabs(turn.by_slopes - turn.by_curvatures) > std::fabs(worst.by_slopes - worst.by_curvatures))
      worst = turn;
  }
  if (std::max(turned, told) <= kHardly) return {};
  const bool fits = square > 0.0 && product >= kLeast * square && product <= kMost * square;
  if (fits) return {};
  return worst;
}

/// By how much curvature changes per length between a row and the next; none where that is a jump, or without bound.
std::optional<double> curvature_rate(const TabulatedPoint& a, const TabulatedPoint& b) {
  const double length = norm(Vec2{b.x - a.x, b.drop - a.drop});
  const double rate = (b.curvature - a.curvature) / length;
  return std::isfinite(rate) ? std::optional(rate) : std::nullopt;
}

/// Curvature in the mean between two rows as their slope angles have it, whichever comes first along the track.
double mean_curvature(const TabulatedPoint& a, const TabulatedPoint& b, double length) {
  return (a.slope_angle - b.slope_angle) / length;
}

/// Arc length between two rows: that of an arc over their chord, which is that of the curve to fourth order.
double arc_between(const TabulatedPoint& a, const TabulatedPoint& b) {
  const double turn = a.slope_angle - b.slope_angle;
  return norm(Vec2{b.x - a.x, b.drop - a.drop}) * (1.0 + turn * turn / 24.0);
}

/// The curvature with which a stretch comes to a jump at its end, where the table tells that of the other side: of the
/// cubic that has the curvatures of the two rows before and turns as slope angles say. The line through the stretch alone
/// is taken where there is no row further away, or where that is so far off the cubic that columns are rounded.
/// @param sign   1 where the rows come in the table's order, -1 where they come in the other
double curvature_up_to_jump(const TabulatedPoint* further, const TabulatedPoint& near,
                            const TabulatedPoint& jump, double sign) {
  constexpr double kRounded = 1e-3;  // taste: of the curvature's jump; lines err by less on stations of 0.3 m
  const double length = arc_between(near, jump);
  const double mean = sign * mean_curvature(near, jump, length);
  const double line = 2.0 * mean - near.curvature;
  if (!further) return line;
  // kappa = near + b u + c u^2 + d u^3 over u, 0 at the near row and -1 at the further one.
  const double unit = arc_between(*further, near);
  const double ratio = length / unit;
  const double by_ends = near.curvature - further->curvature;
  const double by_mean = near.curvature - sign * mean_curvature(*further, near, unit);
  const double ahead = (mean - near.curvature) / ratio;
  const double bend = by_mean - 0.5 * by_ends;
  const double d =
      4.0 * (ahead - 0.5 * by_ends - (3.0 + 2.0 * ratio) * bend) / ((1.0 + ratio) * (1.0 + ratio));
  const double c = 6.0 * bend + 1.5 * d;
  const double b = by_ends + c - d;
  const double cubic = near.curvature + ratio * (b + ratio * (c + ratio * d));
  return std::fabs(cubic - line) <= kRounded * std::fabs(line - jump.curvature) ? cubic : line;
}

/// The rows that say a jump of curvature between rows `at` - 1 and `at`, if their slope angles show one that the table does
/// not say by two rows: stations have the curvature behind a jump alone. The cubic would swing past both curvatures by
/// up to a third of the jump, and with it the smallest radius and the highest load of the track.
std::vector<TabulatedPoint> jump_between(const std::vector<TabulatedPoint>& rows, std::size_t at) {
  constexpr double kLeastTurn = 1e-6;    // [rad]: by what the jump turns the track from row to row
  constexpr double kSmoothBeside = 0.1;  // of the jump, over the same length, in the stretches beside it
  constexpr double kCubicDoes = 0.25;    // nearer to the middle the cubic stays between both curvatures
  constexpr double kAtTheRow = 0.03;     // share of the stretch
  const TabulatedPoint& left = rows[at - 1];
  const TabulatedPoint& right = rows[at];
  const double length = norm(Vec2{right.x - left.x, right.drop - left.drop});
  const double jump = right.curvature - left.curvature;
  if (!std::isfinite(jump) || std::fabs(jump) * length < kLeastTurn) return {};
  const auto before = at > 1 ? curvature_rate(rows[at - 2], left) : std::nullopt;
  const auto after = at + 1 < rows.size() ? curvature_rate(right, rows[at + 1]) : std::nullopt;
  if (!before && !after) return {};
  for (const auto& rate : {before, after}) {
    if (rate && std::fabs(*rate) * length > kSmoothBeside * std::fabs(jump)) return {};
  }
  // Curvature as slope angles have it in the mean; the jump lies where that is the mean of both sides.
  const double mean = (left.slope_angle - right.slope_angle) / length;
  const double share = (right.curvature - mean) / jump;
  if (share < -kAtTheRow || share > 1.0 + kAtTheRow || std::fabs(share - 0.5) < 0.5 - kCubicDoes) return {};
  if (share < kAtTheRow) {
    TabulatedPoint behind = left;
    behind.curvature = curvature_up_to_jump(after ? &rows[at + 1] : nullptr, right, left, -1.0);
    return {behind};
  }
  if (share > 1.0 - kAtTheRow) {
    TabulatedPoint ahead = right;
    ahead.curvature = curvature_up_to_jump(before ? &rows[at - 2] : nullptr, left, right, 1.0);
    return {ahead};
  }
  TabulatedPoint ahead = left;
  const double way = share * length;
  const double middle = left.slope_angle - 0.5 * left.curvature * way;
  ahead.x += way * math::cos(middle);
  ahead.drop += way * math::sin(middle);
  ahead.slope_angle -= left.curvature * way;
  TabulatedPoint behind = ahead;
  behind.curvature = right.curvature;
  return {ahead, behind};
}

/// The row in which a flight from `left` ends, where `right` is that row but for its curvature: stations tell the one
/// behind the place where a body lands. Nothing else would be the parabola to rounding, which contact asks for.
std::optional<TabulatedPoint> end_of_flight(const TabulatedPoint& left, const TabulatedPoint& right) {
  const double cosine = math::cos(right.slope_angle);
  TabulatedPoint end = right;
  end.curvature = -parabola_rate(left.slope_angle, left.curvature) * (cosine * cosine * cosine);
  return on_one_flight(left, end) ? std::optional(end) : std::nullopt;
}

/// The rows, and those of jumps that only the slope angles show.
std::vector<TabulatedPoint> with_jumps(const std::vector<TabulatedPoint>& rows) {
  std::vector<TabulatedPoint> all;
  all.reserve(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (i > 0 && !same_place(rows[i - 1], rows[i]) && !on_one_flight(rows[i - 1], rows[i])) {
      if (const auto end = end_of_flight(rows[i - 1], rows[i])) {
        all.push_back(*end);
      } else {
        for (const TabulatedPoint& row : jump_between(rows, i)) all.push_back(row);
      }
    }
    all.push_back(rows[i]);
  }
  return all;
}

}  // namespace

std::optional<TableFault> table_fault(const std::vector<TabulatedPoint>& rows) {
  const auto fault = [&](std::size_t index, std::string what, std::string why, std::string hint) {
    return TableFault{index, {row_text(rows, index), std::move(what), std::move(why), std::move(hint)}};
  };
  if (rows.size() < 2) {
    return TableFault{{}, {"points", "there is no second row", "A track has a start and a finish.", ""}};
  }
  const double side = side_of(rows);
  const double reach = reach_of(rows);
  const double rounded = rounded_chord(rows);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const TabulatedPoint& row = rows[i];
    if (!std::isfinite(row.x) || !std::isfinite(row.drop) || !std::isfinite(row.slope_angle)) {
      return fault(i, "it is not finite", "A track is made of places and slopes.", "");
    }
    if (!std::isfinite(row.curvature) && (i > 0 || row.curvature < 0.0)) {
      return fault(i, "its curvature is not finite",
                   "Only at its start may a track bend without bound, and only upwards.", "");
    }
    if (i == 0) continue;
    const TabulatedPoint before = seen_ahead(rows[i - 1], side);
    const TabulatedPoint here = seen_ahead(row, side);
    if (same_place(before, here)) {
      constexpr double kSameSlope = 1e-6;
      const bool jump = i > 1 && i + 1 < rows.size() && !same_place(rows[i - 2], row);
      if (jump && std::fabs(before.slope_angle - here.slope_angle) <= kSameSlope) continue;
      return fault(
          i, "it repeats the row before it",
          "Two rows at one place are a jump of curvature: the slope angle is the same in both, and the track "
          "leads on.",
          "leave one of them out");
    }
    const bool near = norm(Vec2{here.x - before.x, here.drop - before.drop}) < rounded;
    if (!near && !on_one_flight(before, here) && !agrees(before, here, reach)) {
      return fault(
          i,
          "its slope angle of " + angle_text(Angle::from_radians(row.slope_angle)) +
              " does not agree with the places",
          "From the row before it the way leads along " +
              angle_text(Angle::from_radians(math::atan2(here.drop - before.drop, here.x - before.x))) + ".",
          "slope angles in degrees, positive downhill, and rows that lie near enough for their bends; or "
          "columns: [x, z] alone, to which a curve is fitted");
    }
  }
  if (const auto turn = turns_otherwise(rows)) {
    return fault(turn->row, "its curvature does not agree with the slope angles",
                 "From the row before it the slope angle falls by " +
                     angle_text(Angle::from_radians(turn->by_slopes), 3) +
                     ", by the curvatures it would by " +
                     angle_text(Angle::from_radians(turn->by_curvatures), 3) + ".",
                 "curvatures in one over the unit of lengths, positive in a valley; or columns: [x, z] "
                 "alone, to which "
                 "a curve is fitted");
  }
  return {};
}

TabulatedCurve::TabulatedCurve(std::vector<TabulatedPoint> rows) {
  if (const auto fault = table_fault(rows)) throw InputError(fault->issue);
  const TabulatedPoint start = rows.front();
  const double side = side_of(rows);
  const double rounded = rounded_chord(rows);
  for (TabulatedPoint& row : rows) {
    row.x = side * (row.x - start.x);
    row.drop -= start.drop;
  }
  rows = with_jumps(rows);
  unbounded_ = !std::isfinite(start.curvature);
  for (std::size_t i = 1; i < rows.size(); ++i) {
    if (same_place(rows[i - 1], rows[i])) continue;
    if (on_one_flight(rows[i - 1], rows[i])) {
      append_flight(rows[i - 1], rows[i]);
    } else {
      append(rows[i - 1], rows[i], rounded);
    }
  }
  rows_ = std::move(rows);
}

/// Adds the stretch between two rows, as long as its chord asks for. One shorter than `rounded` turns no way but from one slope
/// angle to the other, whatever curvatures say.
void TabulatedCurve::append(const TabulatedPoint& left, const TabulatedPoint& right, double rounded) {
  constexpr int kMostSteps = 60;
  const double chord = math::hypot(right.x - left.x, right.drop - left.drop);
  const double start = breaks_.back();
  double length = chord;
  Stretch stretch;
  Vec2 way;
  for (int step = 0; step < kMostSteps; ++step) {
    stretch.from = parameter(start);
    stretch.width = parameter(start + length) - stretch.from;
    // d zeta / dp = -kappa ds/dp; ds/dp is 1, or 2 p where p is the square root.
    const double end = stretch.from + stretch.width;
    const double rise_to = -right.curvature * (unbounded_ ? 2.0 * end : 1.0) * stretch.width;
    const bool first = unbounded_ && start == 0.0;
    const double rise_from = first
                                 ? 2.0 * (right.slope_angle - left.slope_angle) - rise_to
                                 : -left.curvature * (unbounded_ ? 2.0 * stretch.from : 1.0) * stretch.width;
    const double turn = right.slope_angle - left.slope_angle;
    const auto steady = [&](double rise) {
      return chord < rounded ? between_none_and(3.0 * turn, rise) : rise;
    };
    set_cubic(stretch.slope, left.slope_angle, steady(rise_from), right.slope_angle, steady(rise_to));
    const auto slope = [&](double p) { return value_of(stretch.slope, (p - stretch.from) / stretch.width); };
    way = displacement(slope, stretch.from, end, unbounded_, turning_of(stretch.slope));
    const double next = length * (chord / norm(way));
    const bool settled = std::fabs(next - length) <= 1e-16 * length;
    length = next;
    if (settled) break;
  }
  stretch.x = x_;
  stretch.drop = drop_;
  x_ += way.x;
  drop_ += way.y;
  stretches_.push_back(stretch);
  breaks_.push_back(start + length);
}

void TabulatedCurve::append_flight(const TabulatedPoint& left, const TabulatedPoint& right) {
  const double begin = breaks_.back();
  const double rate = parabola_rate(left.slope_angle, left.curvature);
  const double slope = math::tan(left.slope_angle);
  const double end_slope = math::tan(right.slope_angle);
  const double end = begin + (parabola_length(end_slope) - parabola_length(slope)) / rate;
  Stretch stretch;
  stretch.from = parameter(begin);
  stretch.width = parameter(end) - stretch.from;
  stretch.x = x_;
  stretch.drop = drop_;
  stretch.flight = Flight{begin, rate, slope};
  x_ += (end_slope - slope) / rate;
  drop_ += 0.5 * (end_slope - slope) * (end_slope + slope) / rate;
  stretches_.push_back(stretch);
  breaks_.push_back(end);
}

/// By Newton's method: the length is a steady function of the slope whose derivative is at least 1.
double TabulatedCurve::Flight::slope_at(double s) const {
  constexpr int kMostSteps = 50;
  const double length = parabola_length(slope) + rate * (s - begin);
  double t = slope;
  for (int i = 0; i < kMostSteps; ++i) {
    const double step = (length - parabola_length(t)) / std::sqrt(1.0 + t * t);
    t += step;
    if (std::fabs(step) <= 1e-16 * (1.0 + std::fabs(t))) break;
  }
  return t;
}

/// Within 0 and 1: of a stretch that is hardly longer than rounding the digits of p would lead beyond.
double TabulatedCurve::Stretch::share(double p) const {
  return std::clamp((p - from) / width, 0.0, 1.0);
}

double TabulatedCurve::parameter(double s) const {
  return unbounded_ ? std::sqrt(s) : s;
}

const TabulatedCurve::Stretch& TabulatedCurve::stretch_at(double s) const {
  require_on_track(s);
  const auto next = std::upper_bound(breaks_.begin() + 1, breaks_.end() - 1, s);
  return stretches_[static_cast<std::size_t>(next - breaks_.begin()) - 1];
}

Direction TabulatedCurve::direction(double s) const {
  const Stretch& stretch = stretch_at(s);
  if (stretch.flight) {
    const double t = stretch.flight->slope_at(s);
    const double stretched = 1.0 + t * t;
    return {math::atan(t), -stretch.flight->rate / (stretched * std::sqrt(stretched))};
  }
  const double p = parameter(s);
  const double u = stretch.share(p);
  const double per_length = unbounded_ ? 1.0 / (2.0 * p) : 1.0;
  return {value_of(stretch.slope, u), -rise_of(stretch.slope, u) / stretch.width * per_length};
}

double TabulatedCurve::slope_angle(double s) const {
  const Stretch& stretch = stretch_at(s);
  if (stretch.flight) return math::atan(stretch.flight->slope_at(s));
  return value_of(stretch.slope, stretch.share(parameter(s)));
}

CenterlinePoint TabulatedCurve::at(double s) const {
  const Stretch& stretch = stretch_at(s);
  if (stretch.flight) {
    const auto& [begin, rate, before] = *stretch.flight;
    const double t = stretch.flight->slope_at(s);
    const Direction here = direction(s);
    return {s, stretch.x + (t - before) / rate, stretch.drop + 0.5 * (t - before) * (t + before) / rate,
            here.slope_angle, here.curvature};
  }
  const auto slope = [&](double p) { return value_of(stretch.slope, (p - stretch.from) / stretch.width); };
  const Vec2 way = displacement(slope, stretch.from, parameter(s), unbounded_, turning_of(stretch.slope));
  const Direction here = direction(s);
  return {s, stretch.x + way.x, stretch.drop + way.y, here.slope_angle, here.curvature};
}

namespace {

/// By what slope angles between rows may be off [rad]. Through a bend of curvature kappa a body may go as slowly as
/// v^2 = g/kappa, and slope angles that are off all along a track change v^2 by 2 g times its length times that.
double slope_error(const Centerline& curve, double coarser) {
  constexpr double kSlope =
      1e-12;                       // accuracy: of tracks whose bends are no sharper than 1000 to their length
  constexpr double kSpeed = 1e-9;  // accuracy: of v^2 in the sharpest bend
  constexpr double kRounding = 4e-15;  // rounding: of slope angles as closed forms have them
  double sharpest = 0.0;
  const std::vector<double> breaks = curve.breaks();
  for (std::size_t i = 0; i < breaks.size(); ++i) {
    const double before = i > 0 ? std::fabs(curve.direction(std::nextafter(breaks[i], 0.0)).curvature) : 0.0;
    const double after = i > 0 ? std::fabs(curve.direction(breaks[i]).curvature) : 0.0;
    sharpest = std::max({sharpest, before, after});
  }
  return std::clamp(kSpeed / (sharpest * curve.length()), kRounding, kSlope * coarser);
}

/// Rows of a curve between two breaks, as dense as the cubic between them asks for.
class TableRows {
 public:
  /// @param coarser  how many times what a table of its own is off by is close enough
  explicit TableRows(const Centerline& curve, double coarser = 1.0)
      : curve_(curve),
        coarser_(coarser),
        root_(curve.unbounded_curvature_at_start()),
        slope_(slope_error(curve, coarser)) {}

  /// Adds the rows from one place up to, and without, another one.
  void add(double from, double to) {
    constexpr int kFewest = 8;
    const double low = parameter(from);
    const double high = parameter(to);
    for (int i = 0; i < kFewest; ++i) {
      const double width = (high - low) / kFewest;
      std::vector<double> parameters;
      part(low + width * i, low + width * (i + 1), kMostHalvings, parameters);
      for (const double p : parameters) {
        const double s = place(p);
        add_row(s, s == 0.0 && root_ ? HUGE_VAL : curve_.direction(s).curvature);
      }
    }
  }
  void add_row(double s, double curvature) {
    const CenterlinePoint point = curve_.at(s);
    rows.push_back({point.x, point.drop, point.slope_angle, curvature});
  }

  /// @return `places` and those between two of them that the cubic asks for, too
  [[nodiscard]] std::vector<double> with_places_between(const std::vector<double>& places) const {
    constexpr int kMostHalvingsOfStep = 5;  // budget: stations are close already
    constexpr double kUsualSlope = 1e-12;   // accuracy: of tracks without a sharp bend
    const int most = slope_ < kUsualSlope ? kMostHalvings : kMostHalvingsOfStep;
    std::vector<double> all;
    for (std::size_t i = 0; i + 1 < places.size(); ++i) {
      std::vector<double> parameters;
      part(parameter(places[i]), parameter(places[i + 1]), most, parameters);
      all.push_back(places[i]);
      for (std::size_t k = 1; k < parameters.size(); ++k) all.push_back(place(parameters[k]));
    }
    if (!places.empty()) all.push_back(places.back());
    return all;
  }

  /// @return `places` without those, start and finish and breaks aside, that are nearer to one that is kept than `shortest`
  [[nodiscard]] std::vector<double> apart(const std::vector<double>& places, double shortest) const {
    const std::vector<double> breaks = curve_.breaks();
    std::vector<double> kept;
    for (const double s : places) {
      const bool stays = std::binary_search(breaks.begin(), breaks.end(), s);
      // Before a break those give way that are too near to it.
      while (stays && !kept.empty() && s - kept.back() < shortest &&
             !std::binary_search(breaks.begin(), breaks.end(), kept.back())) {
        kept.pop_back();
      }
      if (stays || kept.empty() || s - kept.back() >= shortest) kept.push_back(s);
    }
    return kept;
  }

  std::vector<TabulatedPoint> rows;

 private:
  static constexpr int kMostHalvings = 14;
  [[nodiscard]] double parameter(double s) const { return root_ ? std::sqrt(s) : s; }
  [[nodiscard]] double place(double p) const { return std::min(root_ ? p * p : p, curve_.length()); }
  /// d zeta/dp; none where curvature has no bound.
  [[nodiscard]] double rise(double p) const {
    return -curve_.direction(place(p)).curvature * (root_ ? 2.0 * p : 1.0);
  }

  /// Appends the parameters from a up to, and without, b between which the cubic is the curve.
  void part(double a, double b, int halvings, std::vector<double>& parameters) const {
    if (may_halve(a, b, halvings) && !follows(a, b)) {
      const double middle = 0.5 * (a + b);
      part(a, middle, halvings - 1, parameters);
      part(middle, b, halvings - 1, parameters);
      return;
    }
    parameters.push_back(a);
  }

  /// A sharp bend is halved for as long as each part turns, and is more than the rounding of places: a track next to the
  /// limit of what can be reached turns up within 1e-12 of its length. What it turns in all bounds how often that happens.
  [[nodiscard]] bool may_halve(double a, double b, int halvings) const {
    constexpr double kShortest =
        0x1p-46;                     // rounding: 64 of the last digits of a place are left between two rows
    constexpr double kTurns = 3e-4;  // accuracy: the cubic of a bend errs by some fourth power of it [rad]
    if (b - a <= std::max(kShortest * b, 0.0)) return false;
    return halvings > 0 || std::fabs(curve_.slope_angle(place(b)) - curve_.slope_angle(place(a))) > kTurns;
  }

  /// Whether the cubic between two rows is the curve, in slope angle and in how it changes.
  [[nodiscard]] bool follows(double a, double b) const { return flies(a, b) || follows_cubic(a, b); }

  /// Whether the curve between two rows is a crest that TabulatedCurve knows for a flight.
  [[nodiscard]] bool flies(double a, double b) const {
    const auto rate = [&](double p) {
      const Direction there = curve_.direction(place(p));
      return parabola_rate(there.slope_angle, there.curvature);
    };
    const double first = rate(a);
    constexpr std::array<double, 4> kShares = {0.25, 0.5, 0.75, 1.0};
    return std::all_of(kShares.begin(), kShares.end(), [&](double share) {
      return same_crest(first, rate(share < 1.0 ? a + share * (b - a) : std::nextafter(b, a)));
    });
  }

  [[nodiscard]] bool follows_cubic(double a, double b) const {
    const double most_turning = 1e-10 * coarser_;
    // Differences of slope angles are known to a few of their last digits: no halving makes the turning agree better.
    constexpr double kRounding = 1e-14;  // rounding: of angles up to a right one [rad]
    // In a sharp bend the rounding of a place turns slope angles, and changes curvature in proportion to itself.
    constexpr double kRoundedPlace = 4.0 * std::numeric_limits<double>::epsilon();  // rounding
    const double width = b - a;
    // What comes right before b counts: curvature may jump there.
    const double near = std::nextafter(b, a);
    const double from = curve_.slope_angle(place(a));
    const double to = curve_.slope_angle(place(near));
    const double rise_to = rise(near) * width;
    const double rise_from = root_ && a == 0.0 ? 2.0 * (to - from) - rise_to : rise(a) * width;
    double cubic[4];
    set_cubic(cubic, from, rise_from, to, rise_to);
    const double rises = std::fabs(rise_from) + std::fabs(rise_to);
    const double rounded = kRoundedPlace * place(near) * std::fabs(curve_.direction(place(near)).curvature);
    for (const double u : {0.25, 0.5, 0.75}) {
      const double p = a + u * width;
      const double turning = most_turning * (1.0 + rises) * width + kRounding + rounded * rises;
      if (std::fabs(value_of(cubic, u) - curve_.slope_angle(place(p))) > slope_ + rounded) return false;
      if (std::fabs(rise_of(cubic, u) - rise(p) * width) > turning) return false;
    }
    return true;
  }

  const Centerline& curve_;
  double coarser_;
  bool root_;
  double slope_;  // by what slope angles may be off [rad]
};

}  // namespace

std::vector<TabulatedPoint> table_of(const Centerline& curve) {
  if (const auto* const tabulated = dynamic_cast<const TabulatedCurve*>(&curve)) return tabulated->rows();
  const std::vector<double> breaks = curve.breaks();
  TableRows table(curve);
  for (std::size_t k = 0; k + 1 < breaks.size(); ++k) {
    table.add(breaks[k], breaks[k + 1]);
    // The curvature with which this stretch ends: at() gives the one with which the next begins.
    const double end = breaks[k + 1];
    const double before = curve.direction(std::nextafter(end, breaks[k])).curvature;
    const bool last = k + 2 == breaks.size();
    const double after = last ? before : curve.direction(end).curvature;
    constexpr double kJump = 1e-9;
    if (last || std::fabs(after - before) > kJump * (std::fabs(after) + std::fabs(before))) {
      table.add_row(end, before);
    }
  }
  return std::move(table.rows);
}

std::vector<double> places_for_table(const Centerline& curve, const std::vector<double>& places,
                                     double shortest) {
  // measured: loads and radii of shipped designs come back to 4e-10; at 20 to 1.5e-9, at 1 with half as many rows again
  constexpr double kCoarser = 4.0;
  const TableRows rows(curve, kCoarser);
  const std::vector<double> all = rows.with_places_between(places);
  return shortest > 0.0 ? rows.apart(all, shortest) : all;
}

}  // namespace glissade
