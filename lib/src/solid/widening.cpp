#include "solid/widening.hpp"

#include <algorithm>
#include <cstddef>

#include <boost/math/quadrature/gauss_kronrod.hpp>

namespace glissade::solid {

Widening::Widening(const CrossSection& section)
    : narrow_(section.at_narrowest()), wide_(section.at_widest()) {
  if (!section.varies()) return;
  law_ = section.width_law();
  least_ = law_->narrowest();
  most_ = law_->widest();
}

double Widening::share(double s) const {
  return law_ ? (law_->at(s) - least_) / (most_ - least_) : 0.0;
}

std::vector<double> Widening::knots_between(double from, double to) const {
  std::vector<double> places;
  if (!law_) return places;
  for (const WidthAt& knot : law_->knots()) {
    if (knot.at > from && knot.at < to) places.push_back(knot.at);
  }
  return places;
}

double Widening::over_length(double from, double to) const {
  if (!law_) return 0.0;
  std::vector<double> places = knots_between(from, to);
  places.insert(places.begin(), from);
  places.push_back(to);
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < places.size(); ++i) {
    sum += 0.5 * (share(places[i]) + share(places[i + 1])) * (places[i + 1] - places[i]);
  }
  return sum;
}

// By parts, since the slope angle has a slope without bound at a fastest start: t zeta less the integral of zeta dt.
double Widening::over_slope(const Centerline& centerline, double from, double to) const {
  if (!law_ || !(to > from)) return 0.0;
  double sum = share(to) * centerline.slope_angle(to) - share(from) * centerline.slope_angle(from);
  std::vector<double> places = knots_between(from, to);
  for (const double s : centerline.breaks()) {
    if (s > from && s < to) places.push_back(s);
  }
  places.push_back(from);
  places.push_back(to);
  std::sort(places.begin(), places.end());
  constexpr unsigned kDeepest = 12;
  constexpr double kAgreement = 1e-10;
  for (std::size_t i = 0; i + 1 < places.size(); ++i) {
    const double rise = share(places[i + 1]) - share(places[i]);
    if (rise == 0.0) continue;
    const double mean = boost::math::quadrature::gauss_kronrod<double, 15>::integrate(
                            [&](double s) { return centerline.slope_angle(s); }, places[i], places[i + 1],
                            kDeepest, kAgreement) /
                        (places[i + 1] - places[i]);
    sum -= rise * mean;
  }
  return sum;
}

WithBreaks::WithBreaks(const Centerline& centerline, const std::vector<double>& further)
    : centerline_(centerline), breaks_(centerline.breaks()) {
  breaks_.insert(breaks_.end(), further.begin(), further.end());
  std::sort(breaks_.begin(), breaks_.end());
  breaks_.erase(std::unique(breaks_.begin(), breaks_.end()), breaks_.end());
}

}  // namespace glissade::solid
