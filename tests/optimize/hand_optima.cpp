// Fastest tracks within one limit, by hand (docs/theory.md, the frictional brachistochrone).
//
// Where no limit binds up to the finish, the extremals are those of the fastest track from rest: one curve for
// each slope angle at the exit and each scale. What the limit prescribes goes before; the slope angle is
// continuous where the two meet, since it is the control of a regular problem, and so is speed, which fixes
// the scale. The curvature jumps.

#include "optimize/hand_optima.hpp"

#include "glissade/core/units.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <stdexcept>

#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/tools/minima.hpp>
#include <boost/math/tools/roots.hpp>

namespace hand_optima {
namespace {

constexpr int kSteps = 400;

template <class Function>
double integral(const Function& function, double from, double to) {
  if (to < from) return -integral(function, to, from);
  constexpr int kParts = 3;
  double sum = 0.0;
  for (int i = 0; i < kParts; ++i) {
    const double a = from + (to - from) * i / kParts;
    const double b = from + (to - from) * (i + 1) / kParts;
    sum += boost::math::quadrature::gauss<double, 30>::integrate(function, a, b);
  }
  return sum;
}

template <class Function>
double root(const Function& function, double low, double high) {
  std::uintmax_t most = 200;
  const auto ends = boost::math::tools::toms748_solve(function, low, high,
                                                      boost::math::tools::eps_tolerance<double>(52), most);
  return 0.5 * (ends.first + ends.second);
}

/// What is left of the fastest track from rest below a slope angle.
class FreeArc {
 public:
  /// @param speed2  squared speed where it begins
  FreeArc(double mu, double entry, double exit, double speed2)
      : mu_(mu), entry_(entry), exit_(exit), q2_(1.0 - mu * mu + 2.0 * mu * std::tan(exit)) {
    const double unit_speed = std::cos(entry) / denominator(entry);
    scale_ = speed2 / (kGravity * unit_speed * unit_speed);
  }
  [[nodiscard]] double radius(double zeta) const {
    const double e = denominator(zeta);
    const double c = std::cos(zeta);
    const double bracket = e * c + 4.0 * mu_ * c * c * (std::sin(zeta) - std::tan(exit_) * c);
    return scale_ * bracket / (e * e * e);
  }
  [[nodiscard]] double run() const {
    return integral([&](double zeta) { return std::cos(zeta) * radius(zeta); }, exit_, entry_);
  }
  [[nodiscard]] double drop() const {
    return integral([&](double zeta) { return std::sin(zeta) * radius(zeta); }, exit_, entry_);
  }
  [[nodiscard]] double time() const {
    const auto pace = [&](double zeta) {
      return radius(zeta) * denominator(zeta) / (std::sqrt(kGravity * scale_) * std::cos(zeta));
    };
    return integral(pace, exit_, entry_);
  }
  void append_to(std::vector<Bend>& bends) const {
    double s = bends.empty() ? 0.0 : bends.back().arc_length;
    for (int i = 0; i <= kSteps; ++i) {
      const double zeta = entry_ + (exit_ - entry_) * i / kSteps;
      if (i > 0) {
        const double before = entry_ + (exit_ - entry_) * (i - 1) / kSteps;
        s += boost::math::quadrature::gauss<double, 7>::integrate([&](double z) { return radius(z); }, zeta,
                                                                  before);
      }
      bends.push_back({s, 1.0 / radius(zeta)});
    }
  }

 private:
  /// E cos^2
  [[nodiscard]] double denominator(double zeta) const {
    const double lean = std::sin(zeta) - mu_ * std::cos(zeta);
    return lean * lean + q2_ * std::cos(zeta) * std::cos(zeta);
  }
  double mu_, entry_, exit_, q2_;
  double scale_ = 1.0;
};

/// A cycloid of a circle of radius r between two angles rolled.
void append_cycloid(std::vector<Bend>& bends, double r, double from, double to) {
  const double s = bends.empty() ? 0.0 : bends.back().arc_length;
  for (int i = 0; i <= kSteps; ++i) {
    const double theta = from + (to - from) * i / kSteps;
    if (theta == 0.0) continue;  // curvature has no bound at the cusp
    bends.push_back({s + 4.0 * r * (std::cos(0.5 * from) - std::cos(0.5 * theta)),
                     1.0 / (4.0 * r * std::sin(0.5 * theta))});
  }
}

void append_straight(std::vector<Bend>& bends, double length) {
  const double s = bends.empty() ? 0.0 : bends.back().arc_length;
  bends.push_back({s, 0.0});
  bends.push_back({s + length, 0.0});
}

/// An arc from rest: squared speed by Roberts' formula.
class ArcFromRest {
 public:
  ArcFromRest(double mu, double radius, double entry) : mu_(mu), radius_(radius), entry_(entry) {}
  [[nodiscard]] double speed2(double zeta) const {
    const double turned = entry_ - zeta;
    // Near the start the difference cancels; its series to the third order does not.
    constexpr double kShort = 1e-5;
    if (turned < kShort) {
      const double pull = std::sin(entry_) - mu_ * std::cos(entry_);
      const double change = std::cos(entry_) + mu_ * std::sin(entry_) + 2.0 * mu_ * pull;
      return 2.0 * kGravity * radius_ * turned * (pull - 0.5 * turned * change);
    }
    return circle(zeta) - circle(entry_) * std::exp(-2.0 * mu_ * turned);
  }
  [[nodiscard]] double time(double end) const {
    const auto pace = [&](double root) {
      return 2.0 * root * radius_ / std::sqrt(speed2(entry_ - root * root));
    };
    return integral(pace, 0.0, std::sqrt(entry_ - end));
  }

 private:
  [[nodiscard]] double circle(double zeta) const {
    return 2.0 * kGravity * radius_ *
           (3.0 * mu_ * std::sin(zeta) + (1.0 - 2.0 * mu_ * mu_) * std::cos(zeta)) / (1.0 + 4.0 * mu_ * mu_);
  }
  double mu_, radius_, entry_;
};

}  // namespace

Optimum along_wall(double run, double drop, double wall_slope, double wall_drop) {
  // In contact both circles have rolled by theta, since a cycloid's slope is cot(theta/2); the first circle is
  // known by that, the second one by the place where it leaves: it passes through the finish.
  const double theta = 2.0 * std::atan2(1.0, wall_slope);
  const double x_per_r = theta - std::sin(theta);
  const double y_per_r = 1.0 - std::cos(theta);
  const double r = wall_drop / (y_per_r - wall_slope * x_per_r);
  const double y_on = r * y_per_r;
  const double sine = wall_slope / std::hypot(1.0, wall_slope);
  const double y_last = wall_slope * run + wall_drop;
  Optimum best{HUGE_VAL, {}};
  for (const bool rising : {false, true}) {
    const auto rolled = [&](double y) {
      const double angle = std::acos(1.0 - drop * y_per_r / y);
      return rising ? 2.0 * std::numbers::pi - angle : angle;
    };
    const auto miss = [&](double y) {
      const double end = rolled(y);
      return (y - wall_drop) / wall_slope + y / y_per_r * (end - std::sin(end) - x_per_r) - run;
    };
    // A circle that is too small does not reach the depth of the finish.
    const double y_first = std::max(y_on, 0.5 * drop * y_per_r * (1.0 + 1e-12));
    constexpr int kScan = 400;
    for (int i = 0; i < kScan; ++i) {
      const double low = y_first + (y_last - y_first) * i / kScan;
      const double high = y_first + (y_last - y_first) * (i + 1) / kScan;
      if (!(miss(low) * miss(high) <= 0.0)) continue;
      const double y = root(miss, low, high);
      const double q = y / y_per_r;
      const double end = rolled(y);
      if (end < theta) continue;
      const double speed_on = std::sqrt(2.0 * kGravity * y_on);
      const double speed_off = std::sqrt(2.0 * kGravity * y);
      const double time = theta * std::sqrt(r / kGravity) + (speed_off - speed_on) / (kGravity * sine) +
                          (end - theta) * std::sqrt(q / kGravity);
      if (time >= best.travel_time) continue;
      best = {time, {}};
      append_cycloid(best.bends, r, 0.0, theta);
      append_straight(best.bends, (y - y_on) / sine);
      append_cycloid(best.bends, q, theta, end);
    }
  }
  return best;
}

Optimum below_slope(double run, double drop, double mu, double highest) {
  // All of it scales with the straight, so that the direction of the finish fixes the exit.
  const double pull = kGravity * (std::sin(highest) - mu * std::cos(highest));
  const auto after_one_metre = [&](double exit) { return FreeArc(mu, highest, exit, 2.0 * pull); };
  const auto direction = [&](double exit) {
    const FreeArc arc = after_one_metre(exit);
    return (std::sin(highest) + arc.drop()) * run - (std::cos(highest) + arc.run()) * drop;
  };
  constexpr double kMargin = 1e-3;
  const double flattest = 2.0 * std::atan(mu) - glissade::kRightAngle;
  const double exit = root(direction, std::max(flattest, -1.2) + kMargin, highest - kMargin);
  const double straight = run / (std::cos(highest) + after_one_metre(exit).run());
  const FreeArc arc(mu, highest, exit, 2.0 * pull * straight);
  Optimum optimum{std::sqrt(2.0 * straight / pull) + arc.time(), {}};
  append_straight(optimum.bends, straight);
  arc.append_to(optimum.bends);
  return optimum;
}

Optimum above_slope(double run, double drop, double lowest) {
  const double rolled = std::numbers::pi - 2.0 * lowest;
  const double x_per_r = rolled - std::sin(rolled);
  const double y_per_r = 1.0 - std::cos(rolled);
  const double r = (drop - run * std::tan(lowest)) / (y_per_r - x_per_r * std::tan(lowest));
  const double begin = std::sqrt(2.0 * kGravity * r * y_per_r);
  const double end = std::sqrt(2.0 * kGravity * drop);
  Optimum optimum{rolled * std::sqrt(r / kGravity) + (end - begin) / (kGravity * std::sin(lowest)), {}};
  append_cycloid(optimum.bends, r, 0.0, rolled);
  append_straight(optimum.bends, (run - r * x_per_r) / std::cos(lowest));
  return optimum;
}

Optimum above_radius(double run, double drop, double mu, double radius, Turns near) {
  const auto free_arc = [&](const Turns& turns) {
    const double speed2 = ArcFromRest(mu, radius, turns.entry).speed2(turns.arc_end);
    return FreeArc(mu, turns.arc_end, turns.exit, speed2);
  };
  const auto miss = [&](const Turns& turns) {
    const FreeArc arc = free_arc(turns);
    return std::array<double, 2>{
        radius * (std::sin(turns.entry) - std::sin(turns.arc_end)) + arc.run() - run,
        radius * (std::cos(turns.arc_end) - std::cos(turns.entry)) + arc.drop() - drop};
  };
  // Newton's method for the two later angles, the entry given.
  const auto reaching = [&](double entry) {
    Turns turns = near;
    turns.entry = entry;
    for (int step = 0; step < 40; ++step) {
      const auto off = miss(turns);
      if (std::hypot(off[0], off[1]) < 1e-12 * run) return turns;
      constexpr double kStep = 1e-5;
      const auto slope = [&](double Turns::*angle) {
        Turns less = turns;
        Turns more = turns;
        less.*angle -= kStep;
        more.*angle += kStep;
        const auto low = miss(less);
        const auto high = miss(more);
        return std::array<double, 2>{(high[0] - low[0]) / (2.0 * kStep), (high[1] - low[1]) / (2.0 * kStep)};
      };
      const auto by_end = slope(&Turns::arc_end);
      const auto by_exit = slope(&Turns::exit);
      const double determinant = by_end[0] * by_exit[1] - by_end[1] * by_exit[0];
      turns.arc_end -= (off[0] * by_exit[1] - off[1] * by_exit[0]) / determinant;
      turns.exit -= (by_end[0] * off[1] - by_end[1] * off[0]) / determinant;
    }
    throw std::runtime_error("no arc of this radius and free arc meet the finish");
  };
  const auto time = [&](double entry) {
    const Turns turns = reaching(entry);
    return ArcFromRest(mu, radius, entry).time(turns.arc_end) + free_arc(turns).time();
  };
  constexpr double kAround = 0.05;
  constexpr int kBits = 40;
  const auto least =
      boost::math::tools::brent_find_minima(time, near.entry - kAround, near.entry + kAround, kBits);
  const Turns turns = reaching(least.first);
  Optimum optimum{least.second, {}};
  optimum.bends = {{0.0, 1.0 / radius}, {radius * (turns.entry - turns.arc_end), 1.0 / radius}};
  free_arc(turns).append_to(optimum.bends);
  for (const Bend& bend : optimum.bends) {
    if (bend.curvature > (1.0 + 1e-9) / radius)
      throw std::runtime_error("the free arc is tighter than allowed");
  }
  return optimum;
}

namespace {

using Point4 = std::array<double, 4>;

/// Nelder and Mead's simplex, for a smooth function of four numbers near its minimum.
template <class Function>
double least_value(const Function& function, Point4& near, double size) {
  struct Corner {
    Point4 at{};
    double value = 0.0;
  };
  constexpr std::size_t kSize = 4;
  std::array<Corner, kSize + 1> corners;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    corners[i].at = near;
    if (i > 0) corners[i].at[i - 1] += size;
    corners[i].value = function(corners[i].at);
  }
  constexpr int kMostSteps = 600;
  for (int step = 0; step < kMostSteps; ++step) {
    std::sort(corners.begin(), corners.end(),
              [](const Corner& a, const Corner& b) { return a.value < b.value; });
    if (corners[kSize].value - corners[0].value < 1e-13) break;
    Point4 middle{};
    for (std::size_t i = 0; i < kSize; ++i) {
      for (std::size_t j = 0; j < kSize; ++j) middle[j] += corners[i].at[j] / kSize;
    }
    const auto along = [&](double share) {
      Corner corner;
      for (std::size_t j = 0; j < kSize; ++j)
        corner.at[j] = middle[j] + share * (corners[kSize].at[j] - middle[j]);
      corner.value = function(corner.at);
      return corner;
    };
    const Corner reflected = along(-1.0);
    if (reflected.value < corners[0].value) {
      const Corner further = along(-2.0);
      corners[kSize] = further.value < reflected.value ? further : reflected;
    } else if (reflected.value < corners[kSize - 1].value) {
      corners[kSize] = reflected;
    } else {
      const Corner nearer = along(reflected.value < corners[kSize].value ? -0.5 : 0.5);
      if (nearer.value < std::min(corners[kSize].value, reflected.value)) {
        corners[kSize] = nearer;
        continue;
      }
      for (std::size_t i = 1; i <= kSize; ++i) {
        for (std::size_t j = 0; j < kSize; ++j)
          corners[i].at[j] = corners[0].at[j] + 0.5 * (corners[i].at[j] - corners[0].at[j]);
        corners[i].value = function(corners[i].at);
      }
    }
  }
  near = corners[0].at;
  return corners[0].value;
}

/// Newton's method for two equations in two unknowns. @return none where it does not settle
template <class Function>
std::optional<std::array<double, 2>> zero_of(const Function& miss, std::array<double, 2> at) {
  constexpr double kStep = 1e-6;
  for (int step = 0; step < 40; ++step) {
    constexpr double kUpright = 1.5;
    if (!(std::fabs(at[0]) < 10.0 && std::fabs(at[1]) < kUpright)) return std::nullopt;
    const auto here = miss(at);
    if (!std::isfinite(here[0]) || !std::isfinite(here[1])) return std::nullopt;
    if (std::hypot(here[0], here[1]) < 1e-12) return at;
    const auto by_first = miss({at[0] + kStep, at[1]});
    const auto by_second = miss({at[0], at[1] + kStep});
    const double a = (by_first[0] - here[0]) / kStep;
    const double b = (by_second[0] - here[0]) / kStep;
    const double c = (by_first[1] - here[1]) / kStep;
    const double d = (by_second[1] - here[1]) / kStep;
    const double determinant = a * d - b * c;
    at[0] -= (d * here[0] - b * here[1]) / determinant;
    at[1] -= (a * here[1] - c * here[0]) / determinant;
  }
  return std::nullopt;
}

/// The beginning of a fastest track from rest that comes to other ground at a given arc length. What a longer way up to there
/// is worth makes the Hamiltonian per unit of length a constant h that is not 0 (docs/theory.md, ground that changes):
///   (1 + mu^2)/u = P [(t - mu)^2 + q^2] cos(zeta) - h (1 + 2 mu^2 - mu t),  t = tan(zeta)
class ArcToChange {
 public:
  /// @param worth  h/P
  ArcToChange(double mu, double end, double q2, double worth, double length)
      : mu_(mu), end_(end), q2_(q2), worth_(worth) {
    scale_ = length / integral([&](double zeta) { return radius(zeta); }, end_, kUpright);
  }
  [[nodiscard]] double speed2(double zeta) const { return scale_ / (pace(zeta) * pace(zeta)); }
  [[nodiscard]] double run() const {
    return integral([&](double zeta) { return std::cos(zeta) * radius(zeta); }, end_, kUpright);
  }
  [[nodiscard]] double drop() const {
    return integral([&](double zeta) { return std::sin(zeta) * radius(zeta); }, end_, kUpright);
  }
  [[nodiscard]] double time() const {
    return integral([&](double zeta) { return radius(zeta) / std::sqrt(speed2(zeta)); }, end_, kUpright);
  }

 private:
  static constexpr double kUpright = std::numbers::pi / 2.0;
  /// 1/u for scale 1, and its derivative by the slope angle
  [[nodiscard]] double pace(double zeta) const {
    const double t = std::tan(zeta);
    const double lean = t - mu_;
    return std::cos(zeta) * (lean * lean + q2_) - worth_ * (1.0 + 2.0 * mu_ * mu_ - mu_ * t);
  }
  [[nodiscard]] double pace_slope(double zeta) const {
    const double t = std::tan(zeta);
    const double lean = t - mu_;
    const double secant2 = 1.0 + t * t;
    return -std::sin(zeta) * (lean * lean + q2_) + std::cos(zeta) * 2.0 * lean * secant2 +
           worth_ * mu_ * secant2;
  }
  /// From (E2), -ds/dzeta = (2 mu v - dv/dzeta)/(2 g (sin - mu cos)).
  [[nodiscard]] double radius(double zeta) const {
    const double w = pace(zeta);
    const double v = scale_ / (w * w);
    const double slope = -2.0 * v * pace_slope(zeta) / w;
    return (2.0 * mu_ * v - slope) / (2.0 * kGravity * (std::sin(zeta) - mu_ * std::cos(zeta)));
  }
  double mu_, end_, q2_, worth_;
  double scale_ = 1.0;
};

/// Free flight from a slope angle to a steeper one.
struct Flight {
  double x = 0.0, y = 0.0, time = 0.0, length = 0.0, speed2 = 0.0;
};
Flight fly(double speed2, double from, double to) {
  const double level = std::sqrt(speed2) * std::cos(from);
  Flight flight;
  flight.time = level * (std::tan(to) - std::tan(from)) / kGravity;
  flight.x = level * flight.time;
  flight.y = level * std::tan(from) * flight.time + 0.5 * kGravity * flight.time * flight.time;
  flight.speed2 = level * level / (std::cos(to) * std::cos(to));
  const auto pace = [&](double t) { return std::hypot(level, level * std::tan(from) + kGravity * t); };
  flight.length = integral(pace, 0.0, flight.time);
  return flight;
}

}  // namespace

double across_change(double run, double drop, double mu_before, double mu_after, double place,
                     ChangeTurns near) {
  const bool onto_rougher = mu_after > mu_before;
  struct Whole {
    double x = 0.0, y = 0.0, time = 0.0;
  };
  // `other`: where the flight ends, onto rougher ground; else the length of the first arc.
  const auto whole = [&](const Point4& turns, double q2, double exit) {
    const auto& [first, bent, other, worth] = turns;
    const ArcToChange before(mu_before, first, q2, worth, onto_rougher ? place : other);
    double speed2 = before.speed2(first);
    const double corner_mu = onto_rougher ? mu_before : mu_after;
    Flight flight;
    double entry = bent;
    if (onto_rougher) {
      speed2 *= std::exp(-2.0 * corner_mu * (first - bent));
      flight = fly(speed2, bent, other);
      speed2 = flight.speed2;
      entry = other;
    } else {
      const double end =
          root([&](double to) { return fly(speed2, first, to).length - (place - other); }, first, 1.56);
      flight = fly(speed2, first, end);
      speed2 = flight.speed2 * std::exp(-2.0 * corner_mu * (end - bent));
    }
    const FreeArc after(mu_after, entry, exit, speed2);
    return Whole{before.run() + flight.x + after.run(), before.drop() + flight.y + after.drop(),
                 before.time() + flight.time + after.time()};
  };
  const std::array<double, 2> exits{1.0 - mu_before * mu_before + 2.0 * mu_before * std::tan(near.exit),
                                    near.exit};
  const auto time = [&](const Point4& turns) {
    try {
      const auto found = zero_of(
          [&](const std::array<double, 2>& at) {
            const Whole track = whole(turns, at[0], at[1]);
            return std::array{track.x / run - 1.0, track.y / run - drop / run};
          },
          exits);
      return found ? whole(turns, (*found)[0], (*found)[1]).time : HUGE_VAL;
    } catch (const std::exception&) {  // no flight of that length, no arc to that exit
      return HUGE_VAL;
    }
  };
  // A simplex that has gone flat begins anew.
  Point4 turns{near.first, near.bent, near.other, 0.0};
  double least = HUGE_VAL;
  for (const double size : {0.02, 0.02, 0.01, 0.005}) least = std::min(least, least_value(time, turns, size));
  return least;
}

}  // namespace hand_optima
