#include "glissade/core/width_law.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/number_text.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>

namespace glissade {
namespace {

using Knot = std::vector<WidthAt>::const_iterator;

Knot first_after(const std::vector<WidthAt>& knots, double s) {
  return std::upper_bound(knots.begin(), knots.end(), s,
                          [](double at, const WidthAt& knot) { return at < knot.at; });
}

double slope_before(Knot after) {
  const Knot before = std::prev(after);
  return (after->width - before->width) / (after->at - before->at);
}

bool is_narrower(const WidthAt& a, const WidthAt& b) {
  return a.width < b.width;
}

}  // namespace

WidthLaw::WidthLaw(std::vector<WidthAt> knots) : knots_(std::move(knots)) {
  if (!knots_.empty()) last_place_ = knots_.back().at;
  if (knots_.size() == 1) knots_.front().at = 0.0;  // one width everywhere, wherever it was said
  if (knots_.empty()) throw InputError({"", "width: no place is given", "A floor has a width.", ""});
  for (std::size_t i = 1; i < knots_.size(); ++i) {
    if (knots_[i].at > knots_[i - 1].at) continue;
    throw InputError({"",
                      "width: the place at " + length_text(knots_[i].at) + " does not lie after the one at " +
                          length_text(knots_[i - 1].at),
                      "Widths are given in the order of the track; each place has one.", ""});
  }
}

double WidthLaw::at(double s) const {
  const Knot after = first_after(knots_, s);
  if (after == knots_.begin()) return knots_.front().width;
  if (after == knots_.end()) return knots_.back().width;
  const Knot before = std::prev(after);
  return before->width + (s - before->at) * slope_before(after);
}

double WidthLaw::slope(double s) const {
  const Knot after = first_after(knots_, s);
  return after == knots_.begin() || after == knots_.end() ? 0.0 : slope_before(after);
}

double WidthLaw::narrowest() const {
  return std::min_element(knots_.begin(), knots_.end(), is_narrower)->width;
}

double WidthLaw::widest() const {
  return std::max_element(knots_.begin(), knots_.end(), is_narrower)->width;
}

}  // namespace glissade
