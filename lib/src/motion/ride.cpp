#include "ride.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"

#include "core/float_limits.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include <boost/math/tools/toms748_solve.hpp>

namespace glissade::motion {
namespace {

// A panel is fine enough when the last Chebyshev coefficients of push and pace are below this, relative to
// their largest values; the terms left out are smaller again by orders of magnitude.
constexpr double kTailTolerance = 1e-14;
// The load enters no speed or time; its own integral is the friction loss.
constexpr double kLoadTailTolerance = 1e-13;
// A tail that halving does not shrink any more is rounding of the centerline's own, if it is below this.
constexpr double kNoise = 1e-10;
constexpr double kNoShrink = 0.5;
// A load is negative, a squared speed at the finish distinct from rest, only beyond what rounding can do to
// it.
constexpr double kLoadRounding = 1e-12;
constexpr double kRestRounding = 64.0 * core::kEpsilon;
// Slope angles as near as this to the friction angle do not start a resting body.
constexpr double kPushRounding = 8.0 * core::kEpsilon;
// A valley is too tight where the centre of mass advances by less than this share of the track below it, and
// the ride is told up to twice that: beyond, its load grows without bound.
constexpr double kTight = 1e-6;
// Smooth parts are looked at in this many panels at least, in all, before their smoothness is believed.
constexpr std::size_t kLeastPanels = 4;
constexpr int kDeepest = 200;
// How near to a finish at which a body arrives only after endless time its ride is still told: 2^-26 of the
// panel.
constexpr int kDeepestCreep = 26;
constexpr std::size_t kMostPanels = 10'000;  // hundreds do; beyond it a ride is one that rounding decides

enum class Sign { positive, negative_somewhere, unknown };

/// Sign of a polynomial on all of its panel; values down to -rounding count as zero, and zero as positive.
Sign sign_of(const chebyshev::Values& f, double rounding) {
  if (*std::min_element(f.begin(), f.end()) < -rounding) return Sign::negative_somewhere;
  if (chebyshev::range(f).lower >= -rounding) return Sign::positive;
  const chebyshev::Range slope = chebyshev::range(chebyshev::derivative(f));
  const bool monotone = slope.lower >= 0.0 || slope.upper <= 0.0;
  return monotone ? Sign::positive : Sign::unknown;
}

bool falls_throughout(const chebyshev::Values& f) {
  return chebyshev::range(chebyshev::derivative(f)).upper < 0.0;
}

double largest_size(const chebyshev::Values& f) {
  double size = 0.0;
  for (const double value : f) size = std::max(size, std::fabs(value));
  return size;
}

template <class Function>
double root_between(const Function& function, double a, double b) {
  const double at_a = function(a);
  const double at_b = function(b);
  if (at_a == 0.0 || at_b == 0.0) return at_a == 0.0 ? a : b;
  if ((at_a < 0.0) == (at_b < 0.0)) return std::fabs(at_a) < std::fabs(at_b) ? a : b;
  std::uintmax_t iterations = 300;
  const boost::math::tools::eps_tolerance<double> to_the_last_bits(51);
  const auto [low, high] =
      boost::math::tools::toms748_solve(function, a, b, at_a, at_b, to_the_last_bits, iterations);
  return 0.5 * (low + high);
}

/// By how much a panel misses its tolerances; at most 1 is fine.
struct Miss {
  double shape = core::kInfinity;  ///< of push and load
  double pace = core::kInfinity;   ///< of dt/dsigma
};

double spread(const chebyshev::Values& f) {
  const auto [least, largest] = std::minmax_element(f.begin(), f.end());
  return *largest - *least;
}

Miss miss_of(const Equation& equation, const Panel& panel) {
  const double distance = panel.stretch.end - panel.stretch.begin;
  // Arc lengths are rounded: the share of the panel by which a node may be off, with a factor for steep
  // functions.
  const double place_rounding = 10.0 * core::kEpsilon * panel.stretch.end / distance;

  const double push_size = largest_size(panel.push);
  const double push_rounding =
      4.0 * core::kEpsilon * (2.0 * equation.gravity * (1.0 + equation.mu) + equation.push_of_wind());
  const double least_v = *std::min_element(panel.v.begin(), panel.v.end());
  const double push_tolerance = std::max({kTailTolerance * push_size, place_rounding * spread(panel.push),
                                          push_rounding, 0.1 * kTailTolerance * least_v / distance});
  const chebyshev::Values& load = panel.load_unbounded() ? panel.stretched_load : panel.load;
  const double load_size = largest_size(load);
  const double load_tolerance =
      std::max(kLoadTailTolerance * std::max(load_size, equation.gravity), place_rounding * spread(load));

  Miss miss;
  if (!panel.resolved) return miss;
  miss.shape = std::max(chebyshev::tail(panel.push) * push_size / push_tolerance,
                        chebyshev::tail(load) * load_size / load_tolerance);
  const bool moves_throughout =
      std::all_of(panel.pace.begin(), panel.pace.end(), [](double pace) { return std::isfinite(pace); });
  if (!moves_throughout) return miss;
  // From rest the pace is as uncertain as the push, which rounding blurs where it is small.
  const double pace_size = largest_size(panel.pace);
  const double blur = panel.at_rest() ? push_tolerance / push_size : 0.0;
  const double pace_tolerance =
      std::max(std::max(kTailTolerance, blur) * pace_size, place_rounding * spread(panel.pace));
  miss.pace = chebyshev::tail(panel.pace) * pace_size / pace_tolerance;
  return miss;
}

bool fine_enough(double miss, double miss_of_parent) {
  if (miss <= 1.0) return true;
  return miss * kTailTolerance < kNoise && miss > kNoShrink * miss_of_parent;
}

struct Task {
  Stretch stretch;
  bool proven = false;  ///< nothing happens on it but sliding
  int depth = 0;
  Miss of_parent;
};

class Integrator {
 public:
  Integrator(const Equation& equation, double entry_speed)
      : length_(equation.centerline->length()), v_(entry_speed * entry_speed), v_terms_(v_) {
    record_.equation = equation;
    record_.end.speed = entry_speed;
  }

  RideRecord run();

 private:
  enum class Verdict { pass, split, stall, rest_at_finish, endless, lift_off, too_tight, law_ends };

  [[nodiscard]] const Equation& equation() const { return record_.equation; }
  [[nodiscard]] bool starts();
  [[nodiscard]] Direction direction(double s) const { return equation().centerline->direction(s); }
  [[nodiscard]] Stretch first_stretch(double end) const;
  void slide(Stretch whole, int halvings);
  std::optional<Stretch> slide_on(const Stretch& whole, int halvings);
  void press(const Stretch& stretch);
  [[nodiscard]] Verdict judge(const Panel& panel, const Task& task, const Miss& miss) const;
  [[nodiscard]] Verdict judge_events(const Panel& panel, bool may_split) const;
  [[nodiscard]] Verdict judge_finish(const Panel& panel, bool may_split) const;
  [[nodiscard]] bool rests_at_finish(const Panel& panel) const;
  [[nodiscard]] Sign load_sign(const Panel& panel) const;
  [[nodiscard]] chebyshev::Values pressed(const Panel& panel) const;
  void append(const Panel& panel);
  void come_to_rest(const Stretch& stretch, double s, int deepest);
  void stall(const Panel& panel);
  [[nodiscard]] std::optional<double> creeps_to_rest_at(const Stretch& stretch) const;
  [[nodiscard]] double friction_on(const Stretch& stretch) const;
  void creep(const Stretch& stretch, double rest);
  [[nodiscard]] double where_load_ends(const Panel& panel) const;
  void leave_track(double s);
  [[nodiscard]] chebyshev::Values law_margin(const Panel& panel) const;
  [[nodiscard]] double where_it_is_too_tight(const Panel& panel) const;
  [[nodiscard]] double where_law_ends(const Panel& panel) const;
  void end_in_valley(double s);
  void end_law(double s);
  void close(double s, double v);
  [[nodiscard]] Panel integrated(const Stretch& stretch, double v);

  RideRecord record_;
  double length_;
  double v_;        // where the next panel begins
  double v_terms_;  // size of all terms that made up v_, its rounding is in proportion
  RideSums sums_;
  double pressing_ = 1.0;        // -1 where a held body presses upwards
  std::size_t panels_left_ = 0;  // that may still be tried
  bool ended_ = false;
};

RideRecord Integrator::run() {
  if (!starts()) return std::move(record_);
  const std::vector<double> breaks = breaks_of(equation());
  panels_left_ = kMostPanels + 100 * breaks.size();
  int halvings = 0;
  while ((breaks.size() - 1) << static_cast<unsigned>(halvings) < kLeastPanels) ++halvings;
  for (std::size_t i = 0; i + 1 < breaks.size() && !ended_; ++i) {
    if (!(breaks[i] < breaks[i + 1])) continue;
    slide(i == 0 ? first_stretch(breaks[1]) : Stretch::even(breaks[i], breaks[i + 1]), halvings);
  }
  if (!ended_) close(length_, v_);
  return std::move(record_);
}

bool Integrator::starts() {
  if (v_ > 0.0) return true;
  const Direction start =
      equation().height == 0.0 ? Direction{equation().centerline->slope_angle(0.0), 0.0} : direction(0.0);
  const bool hangs = equation().held && equation().load(start, 0.0) < 0.0;
  const double mu = (hangs ? -1.0 : 1.0) * equation().friction_at(0.0);
  const double rounding = kPushRounding * 2.0 * equation().gravity * (1.0 + std::fabs(mu));
  // Where the valley is too tight at once, the ride ends for that.
  if (equation().path_rate(start) <= kTight || equation().slope_at_rest(start, mu) > rounding) return true;
  record_.stall =
      Stall{0.0, Angle::from_radians(std::max(0.0, math::atan(std::fabs(mu)) - start.slope_angle))};
  close(0.0, 0.0);
  return false;
}

Stretch Integrator::first_stretch(double end) const {
  const bool from_root = v_ == 0.0 || equation().centerline->unbounded_curvature_at_start();
  if (from_root) return Stretch::root(0.0, end, 0.0);
  // Near the start v = v0 + push s: as from rest, but from a point v0 / push further up.
  // Only where to begin a panel finely: of a held body that presses upwards, roughly.
  const double push =
      equation().slope_at_rest({equation().centerline->slope_angle(0.0), 0.0}, equation().friction_at(0.0));
  const double way_from_rest = v_ / push;
  const bool slow_start = push > 0.0 && way_from_rest < 0.25 * end;
  return slow_start ? Stretch::root(0.0, end, std::sqrt(way_from_rest)) : Stretch::even(0.0, end);
}

void Integrator::slide(Stretch whole, int halvings) {
  if (!equation().held) {
    slide_on(whole, halvings);
    return;
  }
  press(whole);
  // Where the load of a held body changes its sign, it presses on the other side from there on.
  while (const std::optional<Stretch> rest = slide_on(whole, halvings)) {
    pressing_ = -pressing_;
    whole = *rest;
  }
}

/// The side on which a held body presses where a stretch begins; where there is no load, that of before.
void Integrator::press(const Stretch& stretch) {
  const double load = pressing_ * integrated(stretch, v_).load.front();
  if (load < -kLoadRounding * equation().gravity) pressing_ = -pressing_;
}

/// @return what is left of the stretch where a held body has come to press on the other side; nothing otherwise
std::optional<Stretch> Integrator::slide_on(const Stretch& whole, int halvings) {
  std::vector<Task> tasks{{whole, false, 0, {}}};
  struct Event {
    Verdict what;
    double s;
  };
  std::optional<Event> event;
  // What has been found to happen at s: only the way there is still to be told, and what happens on it comes before.
  const auto go_to = [&](const Task& task, Verdict what, double s, bool proven) {
    tasks.clear();
    if (s > task.stretch.begin) tasks.push_back({task.stretch.cut_at(s), proven, 0, {}});
    event = Event{what, s};
  };
  while (!tasks.empty()) {
    const Task task = tasks.back();
    tasks.pop_back();
    if (const std::optional<double> rest = creeps_to_rest_at(task.stretch)) {
      creep(task.stretch, *rest);
      return {};
    }
    const Panel panel = integrated(task.stretch, v_);
    const Miss miss = miss_of(equation(), panel);
    const bool too_wide = task.depth < halvings && task.stretch.can_split() && !task.proven;
    switch (too_wide ? Verdict::split : judge(panel, task, miss)) {
      case Verdict::split:
        tasks.push_back({task.stretch.half_beyond(), task.proven, task.depth + 1, miss});
        tasks.push_back({task.stretch.half_at_anchor(), task.proven, task.depth + 1, miss});
        break;
      case Verdict::pass:
        append(panel);
        break;
      case Verdict::stall:
        stall(panel);
        return {};
      case Verdict::rest_at_finish:
        come_to_rest(task.stretch, length_, kDeepest);
        close(length_, 0.0);
        return {};
      case Verdict::endless:
        come_to_rest(task.stretch, length_, kDeepestCreep);
        record_.stall = Stall{length_, Angle()};
        close(length_, 0.0);
        record_.end.time = core::kInfinity;
        return {};
      case Verdict::lift_off:
        go_to(task, Verdict::lift_off, where_load_ends(panel), true);
        break;
      case Verdict::too_tight:
        // Other things may still happen on the way.
        go_to(task, Verdict::too_tight, where_it_is_too_tight(panel), false);
        break;
      case Verdict::law_ends:
        go_to(task, Verdict::law_ends, where_law_ends(panel), true);
        break;
    }
  }
  if (!event) return {};
  if (event->what == Verdict::law_ends) end_law(event->s);
  if (event->what == Verdict::too_tight) end_in_valley(event->s);
  if (event->what != Verdict::lift_off) return {};
  if (!equation().held) leave_track(event->s);
  return equation().held && event->s < whole.end ? std::optional(whole.beyond(event->s)) : std::nullopt;
}

Integrator::Verdict Integrator::judge(const Panel& panel, const Task& task, const Miss& miss) const {
  const bool may_split = task.depth < kDeepest && task.stretch.can_split();
  if (panel.path_rate && *std::min_element(panel.path_rate->begin(), panel.path_rate->end()) <= kTight) {
    return Verdict::too_tight;
  }
  if (may_split && !fine_enough(miss.shape, task.of_parent.shape)) return Verdict::split;
  const Verdict events = task.proven ? Verdict::pass : judge_events(panel, may_split);
  if (events != Verdict::pass) return events;
  return may_split && !fine_enough(miss.pace, task.of_parent.pace) ? Verdict::split : Verdict::pass;
}

/// What happens on a panel whose shape is known; split where that is not yet clear.
Integrator::Verdict Integrator::judge_events(const Panel& panel, bool may_split) const {
  const Sign load = load_sign(panel);
  if (equation().law != nullptr) {
    const chebyshev::Values margin = law_margin(panel);
    const Sign sign = sign_of(margin, 0.0);
    if (may_split && sign == Sign::unknown) return Verdict::split;
    if (sign == Sign::negative_somewhere) {
      const bool clear = load == Sign::positive && (margin.front() < 0.0 || falls_throughout(margin));
      return may_split && !clear ? Verdict::split : Verdict::law_ends;
    }
  }
  if (rests_at_finish(panel)) {
    return may_split && load != Sign::positive ? Verdict::split : judge_finish(panel, may_split);
  }
  const Sign speed = sign_of(panel.at_rest() ? panel.weighted_mean_push : panel.v, 0.0);
  if (may_split && speed == Sign::unknown) return Verdict::split;
  if (speed == Sign::negative_somewhere) {
    const bool clear = load == Sign::positive && chebyshev::range(panel.push).upper < 0.0;
    return may_split && !clear ? Verdict::split : Verdict::stall;
  }
  if (may_split && load == Sign::unknown) return Verdict::split;
  if (load != Sign::negative_somewhere) return Verdict::pass;
  const chebyshev::Values presses = pressed(panel);
  const bool at_once = presses.front() < -kLoadRounding * equation().gravity;
  const bool clear = at_once || (!panel.load_unbounded() && falls_throughout(presses));
  return may_split && !clear ? Verdict::split : Verdict::lift_off;
}

Integrator::Verdict Integrator::judge_finish(const Panel& panel, bool may_split) const {
  if (chebyshev::range(panel.push).upper < 0.0) return Verdict::rest_at_finish;
  const double rounding = kLoadRounding * equation().gravity * (1.0 + equation().mu);
  const double highest_push = *std::max_element(panel.push.begin(), panel.push.end());
  if (std::fabs(panel.push.back()) <= rounding && highest_push <= rounding) return Verdict::endless;
  return may_split ? Verdict::split : Verdict::rest_at_finish;
}

/// True if rounding cannot tell the speed at the finish from zero.
bool Integrator::rests_at_finish(const Panel& panel) const {
  if (panel.stretch.end != length_) return false;
  // What chokes before it stands does not stand there, however little of its speed is known where small changes of it grow.
  if (equation().law != nullptr && equation().law->least_v(length_) > 0.0) return false;
  return std::fabs(panel.v.back()) <= kRestRounding * (panel.kept * v_terms_ + panel.far_v_terms());
}

/// The load on the side that is pressed.
chebyshev::Values Integrator::pressed(const Panel& panel) const {
  chebyshev::Values load = panel.load;
  for (double& value : load) value *= panel.pressing;
  return load;
}

Sign Integrator::load_sign(const Panel& panel) const {
  chebyshev::Values load = panel.load_unbounded() ? panel.stretched_load : panel.load;
  for (double& value : load) value *= panel.pressing;
  return sign_of(load, kLoadRounding * std::max(equation().gravity, largest_size(load)));
}

void Integrator::append(const Panel& panel) {
  record_.panels.push_back(panel);
  record_.sums_before.push_back(sums_);
  sums_ = sums_ + panel.sums();
  v_terms_ = panel.kept * v_terms_ + panel.far_v_terms();
  v_ = panel.far_v();
}

void Integrator::stall(const Panel& panel) {
  const auto first_at_rest =
      std::find_if(panel.v.begin() + 1, panel.v.end(), [](double v) { return !(v > 0.0); });
  const auto node = static_cast<std::size_t>(first_at_rest - panel.v.begin());
  const auto node_sigma = [&](std::size_t i) { return panel.stretch.width * chebyshev::nodes()[i]; };
  const double sigma =
      root_between([&](double at) { return panel.scaled_w(at); }, node_sigma(node - 1), node_sigma(node));
  const double s = panel.stretch.arc_length(sigma);
  come_to_rest(panel.stretch, s, kDeepest);
  const double missing = math::atan(std::fabs(panel.friction)) - equation().centerline->slope_angle(s);
  record_.stall = Stall{s, Angle::from_radians(std::max(0.0, missing))};
  close(s, 0.0);
}

/// Appends the panels of the last way to rest at s, integrated backwards from there: near it, v as a
/// difference would lose all its digits.
void Integrator::come_to_rest(const Stretch& stretch, double s, int deepest) {
  if (!(stretch.begin < s)) return;
  std::vector<Panel> backwards;
  std::vector<Task> tasks{{Stretch::up_to_rest(stretch.begin, s, stretch.smooth_end), true, 0, {}}};
  double v = 0.0;
  while (!tasks.empty()) {
    const Task task = tasks.back();
    tasks.pop_back();
    const Panel panel = integrated(task.stretch, v);
    const Miss miss = miss_of(equation(), panel);
    const bool may_split = task.depth < deepest && task.stretch.can_split();
    const bool fine =
        fine_enough(miss.shape, task.of_parent.shape) && fine_enough(miss.pace, task.of_parent.pace);
    if (may_split && !fine) {
      tasks.push_back({task.stretch.half_beyond(), true, task.depth + 1, miss});
      tasks.push_back({task.stretch.half_at_anchor(), true, task.depth + 1, miss});
      continue;
    }
    v = panel.far_v();
    // Left out: the last bit of a way that takes for ever.
    if (std::isfinite(panel.mean_pace.back())) backwards.push_back(panel);
  }
  std::for_each(backwards.rbegin(), backwards.rend(), [&](const Panel& panel) { append(panel); });
}

/// A wind from behind pushes less the faster a body is: there is a speed at which wind, slope and friction balance, and where that
/// falls to 0, at s0, and slowly, all bodies come to rest after endless time, as near to that speed as one likes. In the body's
/// u u' = P(s) - 2 K w u + K u^2, with P what there is at rest and K half of gain times drag, u <= m (s0 - s) holds for all of the
/// way to s0 once it does, for m = K w / 2, where P(s) <= 0.7 K^2 w^2 (s0 - s) and u is small beside w: there
/// u' <= (0.7 K^2 w^2) / m - 2 K w + 0.01 K w < -m. And no body stays behind while P is positive.
std::optional<double> Integrator::creeps_to_rest_at(const Stretch& stretch) const {
  constexpr double kCreeps = 1e-3;   // taste: of the wind; what is as slow is told as standing
  constexpr double kSlowly = 0.7;    // theory
  constexpr double kSmall = 0.01;    // theory: beside the wind
  constexpr double kNearRest = 0.5;  // theory
  const double w = -equation().head_wind;
  const double u = std::sqrt(v_);
  if (equation().law != nullptr || !(w > 0.0) || !(u > 0.0) || u > kCreeps * w) return {};
  const double friction = friction_on(stretch);
  const auto push = [&](double s) { return 0.5 * equation().slope_at_rest(direction(s), friction); };
  if (!(push(stretch.begin) > 0.0) || !(push(stretch.end) < 0.0)) return {};
  const double rest = root_between(push, stretch.begin, stretch.end);
  const double way = rest - stretch.begin;
  double path = HUGE_VAL;
  for (const double x : chebyshev::nodes())
    path = std::min(path, equation().path_rate(direction(stretch.begin + x * way)));
  const double rate = 0.5 * equation().gain * equation().k * path * w;
  if (!(u <= kNearRest * rate * way) || !(kNearRest * rate * way <= kSmall * w)) return {};
  for (const double x : chebyshev::nodes()) {
    const double at = stretch.begin + x * way;
    const double most = kSlowly * rate * rate * (rest - at);
    if (x < 1.0 && !(push(at) > 0.0 && push(at) <= most)) return {};
  }
  return rest;
}

double Integrator::friction_on(const Stretch& stretch) const {
  return pressing_ * (equation().changes.empty()
                          ? equation().mu
                          : equation().friction_at(0.5 * (stretch.begin + stretch.end)));
}

/// The last of the way to rest, on which wind, slope and friction balance.
void Integrator::creep(const Stretch& stretch, double rest) {
  const double friction = friction_on(stretch);
  const double share = equation().changes.empty() ? pressing_ : friction;
  const double way = rest - stretch.begin;
  chebyshev::Values pressed;
  chebyshev::Values dragged;
  for (std::size_t i = 0; i < chebyshev::kNodes; ++i) {
    const Direction at = direction(stretch.begin + chebyshev::nodes()[i] * way);
    pressed[i] = share * equation().load(at, 0.0) * equation().path_rate(at);
    dragged[i] = equation().push(at, friction) / (equation().gain * equation().k);
  }
  sums_.load += way * chebyshev::running_mean(pressed).back();
  // And what is left of the speed goes into the air.
  sums_.speed_squared +=
      way * chebyshev::running_mean(dragged).back() + v_ / (equation().gain * equation().k);
  sums_.time = core::kInfinity;
  const double missing = math::atan(std::fabs(friction)) - equation().centerline->slope_angle(rest);
  record_.stall = Stall{rest, Angle::from_radians(std::max(0.0, missing))};
  close(rest, 0.0);
}

double Integrator::where_load_ends(const Panel& panel) const {
  const double rounding = kLoadRounding * equation().gravity;
  const chebyshev::Values loads = pressed(panel);
  const auto lifted = std::find_if(loads.begin(), loads.end(), [&](double load) { return load < -rounding; });
  if (lifted == loads.begin()) return panel.stretch.begin;
  const auto pressing =
      std::find_if(std::make_reverse_iterator(lifted), loads.rend(), [](double load) { return load >= 0.0; });
  if (pressing == loads.rend()) return panel.stretch.begin;
  const auto node_sigma = [&](auto node) {
    return panel.stretch.width * chebyshev::nodes()[static_cast<std::size_t>(node - loads.begin())];
  };
  const double sigma = root_between([&](double at) { return panel.load_at(equation(), at); },
                                    node_sigma(pressing.base() - 1), node_sigma(lifted));
  return panel.stretch.arc_length(sigma);
}

void Integrator::leave_track(double s) {
  close(s, v_);
  record_.lift_off = LiftOff{s, std::sqrt(v_), equation().centerline->direction(s).curvature};
}

/// How far v at the nodes lies above where the law ends.
chebyshev::Values Integrator::law_margin(const Panel& panel) const {
  chebyshev::Values margin = panel.v;
  for (std::size_t i = 0; i < chebyshev::kNodes; ++i) {
    margin[i] -=
        equation().law->least_v(panel.stretch.arc_length(panel.stretch.width * chebyshev::nodes()[i]));
  }
  return margin;
}

double Integrator::where_it_is_too_tight(const Panel& panel) const {
  const chebyshev::Values& rate = *panel.path_rate;
  const auto node_sigma = [&](std::size_t i) { return panel.stretch.width * chebyshev::nodes()[i]; };
  std::size_t tight = 0;
  while (rate[tight] > kTight) ++tight;
  if (tight == 0) return panel.stretch.begin;
  const double sigma =
      root_between([&](double at) { return panel.path_rate_at(equation(), at) - 2.0 * kTight; },
                   node_sigma(tight - 1), node_sigma(tight));
  return panel.stretch.arc_length(sigma);
}

double Integrator::where_law_ends(const Panel& panel) const {
  const chebyshev::Values margin = law_margin(panel);
  const auto node_sigma = [&](std::size_t i) { return panel.stretch.width * chebyshev::nodes()[i]; };
  std::size_t ended = 0;
  while (ended + 1 < chebyshev::kNodes && margin[ended] >= 0.0) ++ended;
  if (ended == 0) return panel.stretch.begin;
  const double sigma = root_between(
      [&](double at) {
        return panel.v_at(equation(), at) - equation().law->least_v(panel.stretch.arc_length(at));
      },
      node_sigma(ended - 1), node_sigma(ended));
  return panel.stretch.arc_length(sigma);
}

void Integrator::end_in_valley(double s) {
  close(s, v_);
  record_.law_end =
      LawEnd{"valley_radius_m", s, std::sqrt(v_), 1.0 / direction(s).curvature, equation().height};
}

void Integrator::end_law(double s) {
  const Law& law = *equation().law;
  const double bound_v = law.bound_v(s);
  if (bound_v < law.least_v(s) && bound_v < v_) {
    // What is left of the speed is rubbed off within micrometres.
    const double friction = equation().loss_friction();
    if (friction > 0.0) sums_.load += (v_ - bound_v) / (equation().gain * friction);
    v_ = bound_v;
  }
  close(s, v_);
  const std::size_t index = law.ending_quantity();
  const auto value_at = [&](double v) {
    return law.quantity(index, {.arc_length = s, .v = v, .friction = equation().friction_at(s)});
  };
  record_.law_end = LawEnd{law.quantities()[index].key, s, std::sqrt(v_), value_at(v_), value_at(bound_v)};
}

void Integrator::close(double s, double v) {
  ended_ = true;
  record_.end = {s,
                 sums_.time,
                 std::sqrt(v),
                 equation().load(equation().centerline->direction(s), v),
                 equation().loss_friction() * sums_.load,
                 equation().k * sums_.speed_squared};
}

Panel Integrator::integrated(const Stretch& stretch, double v) {
  if (panels_left_ == 0) {
    const double k = equation().k;
    constexpr double kBraked =
        1e3;  // of the drag times the length: beyond, the speed follows the slope at once
    if (k * equation().centerline->length() > kBraked) {
      throw ConvergenceError({"", "the ride comes no further than " + length_text(stretch.begin),
                              "A drag of " + rounded_text(k, 4) + " 1/m takes a body's speed within " +
                                  length_text(1.0 / k) + ": too many steps lead down the track.",
                              "the unit of drag; what slides has 0.0001 to 0.1 1/m"});
    }
    const double w = equation().head_wind;
    constexpr double kAllButStands = 1e-2;  // of the wind
    if (w < 0.0 && v_ < kAllButStands * kAllButStands * w * w) {
      throw ConvergenceError(
          {"", "the ride comes no further than " + length_text(stretch.begin),
           "Wind from behind, slope and friction balance there: the body all but stands, and a "
           "hair more or less of any of them decides whether it does.",
           "a little more, or less, wind or friction"});
    }
    throw ConvergenceError(
        {"", "the ride comes no further than " + length_text(stretch.begin),
         "The centerline is not smooth between its breaks, so that no panel is fine enough.",
         "a centerline whose breaks() tell where its curvature jumps"});
  }
  --panels_left_;
  return {equation(), stretch, v, pressing_};
}

}  // namespace

std::vector<double> breaks_of(const Equation& equation) {
  std::vector<double> breaks = equation.centerline->breaks();
  std::vector<double> others;
  if (equation.law != nullptr) others = equation.law->breaks();
  for (const FrictionChange& change : equation.changes) others.push_back(change.from);
  if (others.empty()) return breaks;
  std::erase_if(others, [&](double s) { return !(s > 0.0 && s < equation.centerline->length()); });
  breaks.insert(breaks.end(), others.begin(), others.end());
  std::sort(breaks.begin(), breaks.end());
  return breaks;
}

RideRecord ride_down(const Equation& equation, double entry_speed) {
  return Integrator(equation, entry_speed).run();
}

}  // namespace glissade::motion
