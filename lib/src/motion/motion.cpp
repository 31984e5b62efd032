#include "glissade/motion/motion.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/number_text.hpp"

#include "ride.hpp"

#include <algorithm>
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
  require(gravity > 0.0 && std::isfinite(gravity),
          "gravity: " + exact_text(gravity) + " m/s^2 is not a finite number larger than 0",
          "Gravity drives the body.");
}

/// A value along a ride and its place.
struct Found {
  const Panel* panel = nullptr;
  double sigma = 0.0;
  double value = std::numeric_limits<double>::infinity();
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
    const auto node = std::min_element(f.begin(), f.end());
    if (*node < least.value)
      least = {&panel, node_sigma(panel, static_cast<std::size_t>(node - f.begin())), *node};
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
      if (value < least.value - rounding) least = {&panel, sigma, value};
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
        record_(ride_down({centerline_.get(), body.friction.coefficient(), body.drag_per_metre, gravity},
                          body.entry_speed)) {}

  [[nodiscard]] const Centerline& centerline() const { return *centerline_; }
  [[nodiscard]] const Body& body() const { return body_; }
  [[nodiscard]] const RideRecord& record() const { return record_; }
  [[nodiscard]] MotionState at(double s) const;
  [[nodiscard]] MotionState load_extreme(double sign) const;
  [[nodiscard]] MotionState highest_speed() const;

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
  const RideSums sums =
      record_.sums_before[static_cast<std::size_t>(&panel - record_.panels.data())] + panel.sums_to(sigma);
  const Direction direction = centerline_->direction(s);
  const double v = panel.v_for(equation(), sigma, direction.slope_angle);
  return {s,
          sums.time,
          std::sqrt(v),
          equation().load(direction, v),
          equation().mu * sums.load,
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

Motion::Motion(CenterlinePtr centerline, Body body, double gravity) {
  if (!centerline) throw InputError({"", "there is no centerline to ride on", "", ""});
  require_body(body, gravity);
  ride_ = std::make_unique<const Ride>(std::move(centerline), body, gravity);
}

Motion::~Motion() = default;
Motion::Motion(Motion&&) noexcept = default;
Motion& Motion::operator=(Motion&&) noexcept = default;

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
  return !stall() && !lift_off();
}

const std::optional<Stall>& Motion::stall() const noexcept {
  return ride_->record().stall;
}

const std::optional<LiftOff>& Motion::lift_off() const noexcept {
  return ride_->record().lift_off;
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

}  // namespace glissade
