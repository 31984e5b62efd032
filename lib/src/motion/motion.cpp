#include "glissade/motion/motion.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"

#include "ride.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include <boost/math/tools/minima.hpp>

namespace glissade {

using namespace motion;

namespace {

void require_body(const Body& body, double gravity) {
  const auto require = [](bool fine, const std::string& what, const std::string& why) {
    if (!fine) throw InputError({"", what, why, ""});
  };
  require(body.entry_speed >= 0.0 && std::isfinite(body.entry_speed),
          "entry_speed: " + exact_text(body.entry_speed) + " m/s is not a finite number, 0 or larger",
          "The body starts from rest or moves towards the finish.");
  require(body.drag_per_metre >= 0.0 && std::isfinite(body.drag_per_metre),
          "drag_per_metre: " + exact_text(body.drag_per_metre) + " 1/m is not a finite number, 0 or larger",
          "Drag slows a body down: k = air density * drag coefficient * frontal area / (2 * mass).");
  require(std::isfinite(body.head_wind), "head_wind: " + exact_text(body.head_wind) + " m/s is not finite",
          "Wind along the track, against the motion where positive.");
  double before = 0.0;
  bool first = true;
  for (const FrictionChange& change : body.friction_changes) {
    require((change.from > before || (first && change.from == before)) && std::isfinite(change.from),
            "friction_changes: " + exact_text(change.from) + " m after " + exact_text(before) + " m",
            "The places from which on friction changes are finite and ascend.");
    before = change.from;
    first = false;
  }
  require(gravity > 0.0 && std::isfinite(gravity),
          "gravity: " + exact_text(gravity) + " m/s^2 is not a finite number larger than 0",
          "Gravity drives the body.");
  const std::string within = " the squares of all speeds stay within the range of numbers.";
  require(body.entry_speed <= kFastestEntry,
          "entry_speed: " + exact_text(body.entry_speed) + " m/s is out of range",
          "Up to " + rounded_text(kFastestEntry, 3) + " m/s" + within);
  require(gravity >= kWeakestGravity && gravity <= kStrongestGravity,
          "gravity: " + exact_text(gravity) + " m/s^2 is out of range",
          "Between " + rounded_text(kWeakestGravity, 3) + " and " + rounded_text(kStrongestGravity, 3) +
              " m/s^2" + within);
}

void require_ride(const Centerline& centerline, const Body& body, double gravity) {
  constexpr double kMost = 1e305;  // taste: a thousandth of the largest double
  if (!(gravity * centerline.length() <= kMost)) {
    throw InputError({"",
                      "the track is " + exact_text(centerline.length()) + " m long, at a gravity of " +
                          exact_text(gravity) + " m/s^2",
                      "Squares of the speeds on it leave the range of numbers.", "lengths in metres"});
  }
  if (!body.law || !body.law->depends_on_speed()) return;
  if (!(body.entry_speed > 0.0)) {
    throw InputError({"", "entry_speed: 0 m/s", "What resists more the slower it is cannot start from rest.",
                      "the speed with which the " + std::string(body.law->kind()) + " is fed"});
  }
  if (!centerline.unbounded_curvature_at_start()) return;
  throw InputError({"", "the track starts with unbounded curvature",
                    "What resists in proportion to its load cannot enter it with speed.",
                    "a track with a smallest radius"});
}

Equation equation_of(const Centerline& centerline, const Body& body, double gravity) {
  Equation equation;
  equation.centerline = &centerline;
  equation.mu = body.friction.coefficient();
  equation.k = body.drag_per_metre;
  equation.gravity = gravity;
  // Without drag there is no air to feel.
  equation.head_wind = body.drag_per_metre == 0.0 ? 0.0 : body.head_wind;
  equation.changes = body.friction_changes;
  equation.held = body.held;
  if (!body.law) return equation;
  equation.gain = 2.0 / body.law->inertia();
  equation.height = body.law->centre_height();
  equation.side = body.law->side();
  if (body.law->depends_on_speed()) equation.law = body.law.get();
  return equation;
}

void require_one(const Motion::Quantity& quantity) {
  if (!quantity) throw InputError({"", "quantity: there is none", "What is looked for is a function.", ""});
}

void require_quantity(const Motion& motion, std::size_t index) {
  if (index < motion.quantities().size()) return;
  throw InputError({"", "quantity " + std::to_string(index) + " is not one of the ride's",
                    "The body's law adds " + std::to_string(motion.quantities().size()) + ".", ""});
}

/// A value along a ride and its place.
struct Found {
  const Panel* panel = nullptr;
  double sigma = 0.0;
  double value = std::numeric_limits<double>::infinity();
  std::optional<std::size_t> node = {};  ///< none: between two
};

double node_sigma(const Panel& panel, std::size_t node) {
  return panel.stretch.width * chebyshev::nodes()[node];
}

/// The least of `values` at the nodes of all panels, of which there is at least one.
template <class Values>
Found least_node(const std::vector<Panel>& panels, const Values& values) {
  Found least{&panels.front()};
  for (const Panel& panel : panels) {
    const chebyshev::Values f = values(panel);
    const auto node = static_cast<std::size_t>(std::min_element(f.begin(), f.end()) - f.begin());
    if (f[node] < least.value) least = {&panel, node_sigma(panel, node), f[node], node};
  }
  return least;
}

/// The least value of a function over the ride, between the nodes too.
/// @param values    of a panel: the function at its nodes
/// @param evaluate  of a panel and sigma: the function there
template <class Values, class Evaluate>
Found least_anywhere(const std::vector<Panel>& panels, const Values& values, const Evaluate& evaluate) {
  constexpr int kHalfOfDigits = std::numeric_limits<double>::digits / 2;
  Found least = least_node(panels, values);
  for (const Panel& panel : panels) {
    const chebyshev::Values f = values(panel);
    // Of what is the same all along a panel, a straight's load, the nodes have told.
    if (std::equal(f.begin() + 1, f.end(), f.begin())) continue;
    if (chebyshev::range(f).lower >= least.value) continue;
    for (std::size_t i = 0; i < chebyshev::kNodes; ++i) {
      const std::size_t before = i == 0 ? 0 : i - 1;
      const std::size_t after = std::min(i + 1, chebyshev::kNodes - 1);
      if (f[i] > f[before] || f[i] > f[after]) continue;
      std::uintmax_t iterations = 100;
      const auto [sigma, value] = boost::math::tools::brent_find_minima(
          [&](double at) { return evaluate(panel, at); }, node_sigma(panel, before), node_sigma(panel, after),
          kHalfOfDigits, iterations);
      const double rounding = 4.0 * std::numeric_limits<double>::epsilon() * std::fabs(least.value);
      if (value < least.value - rounding) least = {&panel, sigma, value, {}};
    }
  }
  return least;
}

chebyshev::Values negated(chebyshev::Values f) {
  for (double& value : f) value = -value;
  return f;
}

}  // namespace

class Motion::Ride {
 public:
  Ride(CenterlinePtr centerline, const Body& body, double gravity)
      : centerline_(std::move(centerline)),
        body_(body),
        record_(ride_down(equation_of(*centerline_, body_, gravity), body.entry_speed)) {}

  [[nodiscard]] const Centerline& centerline() const { return *centerline_; }
  [[nodiscard]] const Body& body() const { return body_; }
  [[nodiscard]] const RideRecord& record() const { return record_; }
  [[nodiscard]] MotionState at(double s) const;
  [[nodiscard]] MotionState load_extreme(double sign) const;
  [[nodiscard]] MotionState highest_speed() const;
  [[nodiscard]] LawState law_state(const MotionState& state) const;
  [[nodiscard]] QuantityPeak highest(std::size_t index) const;
  [[nodiscard]] QuantityPeak highest(const Quantity& searched, const Quantity& told) const;
  [[nodiscard]] double mean(const Quantity& quantity) const;

 private:
  [[nodiscard]] const Equation& equation() const { return record_.equation; }
  [[nodiscard]] MotionState state(const Panel& panel, double s) const;
  [[nodiscard]] MotionState at_found(const Found& found) const;

  CenterlinePtr centerline_;
  Body body_;
  RideRecord record_;
};

MotionState Motion::Ride::at(double s) const {
  if (!(s >= 0.0 && s <= record_.end.arc_length)) {
    throw InputError({"", "arc length " + exact_text(s) + " m is not on the ride",
                      "The ride is " + exact_text(record_.end.arc_length) + " m long.", ""});
  }
  const bool after_last = record_.panels.empty() || s >= record_.panels.back().stretch.end;
  if (s == record_.end.arc_length || after_last) {
    MotionState state = record_.end;
    state.arc_length = s;
    return state;
  }
  const auto next =
      std::upper_bound(record_.panels.begin(), record_.panels.end(), s,
                       [](double value, const Panel& panel) { return value < panel.stretch.begin; });
  return state(*std::prev(next), s);
}

MotionState Motion::Ride::state(const Panel& panel, double s) const {
  const double sigma = std::min(panel.stretch.sigma(s), panel.stretch.width);
  const chebyshev::Interpolation at = panel.interpolation(sigma);
  const RideSums sums = record_.sums_before[static_cast<std::size_t>(&panel - record_.panels.data())] +
                        panel.sums_to(sigma, at);
  const Direction direction = centerline_->direction(s);
  const double v = panel.v_for(equation(), sigma, direction.slope_angle, at);
  return {s,
          sums.time,
          std::sqrt(v),
          equation().load(direction, v),
          equation().loss_friction() * sums.load,
          equation().k * sums.speed_squared};
}

MotionState Motion::Ride::at_found(const Found& found) const {
  return state(*found.panel, found.panel->stretch.arc_length(found.sigma));
}

MotionState Motion::Ride::load_extreme(double sign) const {
  if (record_.panels.empty()) return record_.end;
  const Found found = least_anywhere(
      record_.panels, [&](const Panel& panel) { return sign < 0.0 ? negated(panel.load) : panel.load; },
      [&](const Panel& panel, double sigma) { return sign * panel.load_at(equation(), sigma); });
  MotionState state = at_found(found);
  // At a jump of curvature the load on the side that counts, which need not be the one after it.
  state.normal_load = sign * found.value;
  return state;
}

MotionState Motion::Ride::highest_speed() const {
  if (record_.panels.empty()) return record_.end;
  const Found found = least_anywhere(
      record_.panels, [](const Panel& panel) { return negated(panel.v); },
      [&](const Panel& panel, double sigma) { return -panel.v_at(equation(), sigma); });
  // The ends are known to the last digit, which a search between them may miss.
  MotionState highest = at_found(found);
  for (const MotionState& end : {at(0.0), record_.end}) {
    if (end.speed > highest.speed) highest = end;
  }
  return highest;
}

LawState Motion::Ride::law_state(const MotionState& state) const {
  const double s = state.arc_length;
  return equation().law_state(s, centerline_->direction(s), state.speed * state.speed, state.normal_load,
                              equation().friction_at(s));
}

/// @param searched  grows with the quantity, and is as smooth
/// @param told      the quantity
QuantityPeak Motion::Ride::highest(const Quantity& searched, const Quantity& told) const {
  const LawState end = law_state(record_.end);
  if (record_.panels.empty()) return {told(end), end.arc_length, {}};
  const Found found = least_anywhere(
      record_.panels,
      [&](const Panel& panel) {
        chebyshev::Values values;
        for (std::size_t i = 0; i < chebyshev::kNodes; ++i)
          values[i] = -searched(panel.law_state_at(equation(), i));
        return values;
      },
      [&](const Panel& panel, double sigma) { return -searched(panel.law_state(equation(), sigma)); });
  // Where a law ends a ride, what ends it is at its bound: beyond what panels tell (Law::bound_v()).
  if (record_.law_end && searched(end) > -found.value) return {told(end), end.arc_length, {}};
  const LawState state = found.node ? found.panel->law_state_at(equation(), *found.node)
                                    : found.panel->law_state(equation(), found.sigma);
  return {told(state), state.arc_length, {}};
}

double Motion::Ride::mean(const Quantity& quantity) const {
  if (record_.panels.empty()) return quantity(law_state(record_.end));
  double sum = 0.0;
  for (const Panel& panel : record_.panels) {
    chebyshev::Values values;
    for (std::size_t i = 0; i < chebyshev::kNodes; ++i) {
      values[i] =
          quantity(panel.law_state_at(equation(), i)) * panel.stretch.stretching(node_sigma(panel, i));
    }
    if (!std::isfinite(values[0])) values[0] = chebyshev::extrapolated_to_zero(values);
    sum += panel.stretch.width * chebyshev::running_mean(values).back();
  }
  return sum / record_.end.arc_length;
}

QuantityPeak Motion::Ride::highest(std::size_t index) const {
  const auto told = [&](const LawState& state) { return body_.law->quantity(index, state); };
  // Infinite values are told apart by no search: it goes by a value that stays finite.
  const auto finite = [&](const LawState& state) { return math::atan(told(state)); };
  QuantityPeak peak = highest(finite, told);
  const std::optional<double> bound = body_.law->quantities().at(index).highest;
  if (!bound || !(peak.value > *bound)) return peak;
  const auto finite_at = [&](double s) { return finite(law_state(at(s))); };
  std::vector<double> places;
  for (const Panel& panel : record_.panels) {
    for (std::size_t i = 0; i + 1 < chebyshev::kNodes; i += 2) {
      places.push_back(
          panel.stretch.anchored_at_end
              ? panel.stretch.arc_length(panel.stretch.width * chebyshev::nodes()[chebyshev::kNodes - 1 - i])
              : panel.stretch.arc_length(panel.stretch.width * chebyshev::nodes()[i]));
    }
    places.push_back(std::nextafter(panel.stretch.end, panel.stretch.begin));
  }
  places.push_back(record_.end.arc_length);
  std::vector<double> values;
  for (const double s : places) values.push_back(finite_at(s));
  const double limit = math::atan(*bound);
  std::size_t first = 0;
  while (first + 1 < places.size() && values[first] <= limit) ++first;
  if (values[first] <= limit) {
    peak.beyond_from = peak.arc_length;  // it exceeds the bound between two samples only
  } else if (first == 0) {
    peak.beyond_from = places.front();
  } else {
    double within = places[first - 1];
    double beyond = places[first];
    for (int step = 0; step < 60; ++step) {
      const double middle = 0.5 * (within + beyond);
      (finite_at(middle) <= limit ? within : beyond) = middle;
    }
    peak.beyond_from = beyond;
  }
  return peak;
}

double speed_after(const Landing& landing, Angle slope_angle, Friction friction) {
  const double theta = (landing.angle - slope_angle).radians();
  return landing.speed * (math::cos(theta) - math::sin(theta) * friction.coefficient());
}

namespace {

constexpr double kStopped = 1e-9;  // rounding: what an impact leaves when it leaves nothing [m/s]

}  // namespace

std::optional<Landing> landing_of(const Body& body) {
  return body.approach ? body.approach->landing(body) : body.landing;
}

bool is_sliding_point(const Body& body) {
  const bool point = !body.law || (body.law->inertia() == 1.0 && body.law->centre_height() == 0.0 &&
                                   !body.law->depends_on_speed() && body.law->side() == 1.0);
  const bool calm = body.head_wind == 0.0 || body.drag_per_metre == 0.0;
  return point && calm && body.friction_changes.empty() && !body.landing && !body.approach;
}

bool lands(const Motion& motion) {
  const std::optional<Landing>& landing = motion.body().landing;
  constexpr double kRounding =
      1e-9;  // rounding, of a search that leads its track along the way of the feed [rad]
  return !landing || motion.centerline().slope_angle(0.0) <= landing->angle.radians() + kRounding;
}

bool stands_where_it_lands(const Motion& motion) {
  return lands(motion) && motion.body().landing && motion.body().entry_speed <= kStopped;
}

bool enters(const Motion& motion) {
  return lands(motion) && !stands_where_it_lands(motion);
}

RideEnd ride_end(const Motion& motion) {
  if (!lands(motion)) return RideEnd::flies_over_start;
  if (stands_where_it_lands(motion)) return RideEnd::stands_at_start;
  if (motion.arrived()) return RideEnd::arrived;
  if (motion.stall()) return RideEnd::stalled;
  if (motion.lift_off()) return RideEnd::lifted_off;
  return motion.law_end()->what == "valley_radius_m" ? RideEnd::does_not_fit : RideEnd::choked;
}

std::string_view to_text(RideEnd end) {
  constexpr std::array<std::string_view, 7> kTexts = {"arrived",
                                                      "stalled",
                                                      "lifted off",
                                                      "does not fit",
                                                      "choked",
                                                      "flies over the start",
                                                      "stands where it lands"};
  return kTexts[static_cast<std::size_t>(end)];
}

Body body_from(Body body, double start) {
  if (start == 0.0) return body;
  if (LawPtr rest = body.law ? body.law->from(start) : nullptr) body.law = std::move(rest);
  std::vector<FrictionChange> changes;
  for (const FrictionChange& change : body.friction_changes) {
    if (change.from > start) {
      changes.push_back({change.from - start, change.friction});
    } else {
      body.friction = change.friction;
    }
  }
  body.friction_changes = std::move(changes);
  return body;
}

Friction least_friction(const Body& body) {
  Friction least = body.friction;
  for (const FrictionChange& change : body.friction_changes) least = std::min(least, change.friction);
  return least;
}

Motion::Motion(CenterlinePtr centerline, Body body, double gravity) {
  if (!centerline) throw InputError({"", "there is no centerline to ride on", "", ""});
  body.landing = landing_of(body);
  if (body.landing) {
    const double speed = body.landing->speed;
    if (!(speed > 0.0 && std::isfinite(speed)))
      throw InputError({"", "landing: " + exact_text(speed) + " m/s is not a finite speed above 0",
                        "What comes down on a track moves.", ""});
    // What friction stops at once stands where it lands; a law that needs speed ends there.
    const double left =
        speed_after(*body.landing, Angle::from_radians(centerline->slope_angle(0.0)), body.friction);
    body.entry_speed = std::max(left, kStopped);
  }
  require_body(body, gravity);
  require_ride(*centerline, body, gravity);
  ride_ = std::make_shared<const Ride>(std::move(centerline), body, gravity);
}

const Centerline& Motion::centerline() const noexcept {
  return ride_->centerline();
}

const Body& Motion::body() const noexcept {
  return ride_->body();
}

double Motion::gravity() const noexcept {
  return ride_->record().equation.gravity;
}

bool Motion::arrived() const noexcept {
  return !stall() && !lift_off() && !law_end();
}

const std::optional<Stall>& Motion::stall() const noexcept {
  return ride_->record().stall;
}

const std::optional<LiftOff>& Motion::lift_off() const noexcept {
  return ride_->record().lift_off;
}

const std::optional<LawEnd>& Motion::law_end() const noexcept {
  return ride_->record().law_end;
}

double Motion::distance() const noexcept {
  return ride_->record().end.arc_length;
}

double Motion::travel_time() const noexcept {
  const bool never_moves = distance() == 0.0 && stall().has_value();
  return never_moves ? std::numeric_limits<double>::infinity() : ride_->record().end.time;
}

double Motion::exit_speed() const noexcept {
  return ride_->record().end.speed;
}

MotionState Motion::highest_load() const {
  return ride_->load_extreme(-1.0);
}

MotionState Motion::lowest_load() const {
  return ride_->load_extreme(1.0);
}

MotionState Motion::highest_speed() const {
  return ride_->highest_speed();
}

MotionState Motion::at(double s) const {
  return ride_->at(s);
}

std::vector<MotionState> Motion::at(const std::vector<double>& stations) const {
  std::vector<MotionState> states;
  states.reserve(stations.size());
  for (const double s : stations) states.push_back(ride_->at(s));
  return states;
}

std::vector<LawQuantity> Motion::quantities() const {
  return body().law ? body().law->quantities() : std::vector<LawQuantity>{};
}

LawState Motion::law_state(double s) const {
  return ride_->law_state(at(s));
}

double Motion::quantity(std::size_t index, double s) const {
  require_quantity(*this, index);
  return body().law->quantity(index, law_state(s));
}

QuantityPeak Motion::highest(std::size_t index) const {
  require_quantity(*this, index);
  return ride_->highest(index);
}

QuantityPeak Motion::highest(const Quantity& quantity) const {
  require_one(quantity);
  return ride_->highest(quantity, quantity);
}

double Motion::mean(const Quantity& quantity) const {
  require_one(quantity);
  return ride_->mean(quantity);
}

std::vector<double> Motion::breaks() const {
  std::vector<double> places = breaks_of(ride_->record().equation);
  std::erase_if(places, [&](double s) { return s >= distance(); });
  places.push_back(distance());
  places.erase(std::unique(places.begin(), places.end()), places.end());
  return places;
}

}  // namespace glissade
