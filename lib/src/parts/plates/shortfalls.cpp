// What is set on plates and finds no place there: which, why, and what to try.

#include "parts/plates/shortfalls.hpp"

#include "glissade/core/number_text.hpp"
#include "glissade/core/words.hpp"

#include "parts/shop/workshop_list.hpp"

#include <algorithm>
#include <cmath>

namespace glissade::parts {
namespace {

constexpr std::size_t kTold = 6;     // taste: of places or units, the others are counted
constexpr double kLeastTold = 1e-6;  // rounding [m]

}  // namespace

std::string spacing_that_does(double least) {
  constexpr double kRoom = 20e-3;   // budget: two steps of the places that are looked at [m]
  constexpr double kDigits = 0.01;  // taste: of what is told [m]
  return "spacing: " + length_text(kDigits * std::ceil((least + kRoom) / kDigits), 6);
}

void WideGaps::add(const Span& unit, const std::vector<double>& row, double spacing) {
  double before = unit.from;
  const auto end_at = [&](double s) {
    if (s - before > spacing + kLeastTold) gaps_.push_back({before, s});
    before = s;
  };
  for (const double at : row) end_at(at);
  end_at(unit.to);
}

void WideGaps::tell(const PlateOptions& options, Workshop& workshop) const {
  if (gaps_.empty()) return;
  const StiffenerOptions& stiffener = *options.stiffeners;
  double widest = 0.0;
  std::vector<std::string> places;
  for (const Span& gap : gaps_) {
    widest = std::max(widest, gap.to - gap.from);
    if (places.size() < kTold) places.push_back(length_text(gap.from, 4) + " to " + length_text(gap.to, 4));
  }
  if (gaps_.size() > kTold) places.push_back(std::to_string(gaps_.size() - kTold) + " more");
  add_shortfall({"stiffeners.spacing",
                 "spacing: stiffeners and ends of units are " + length_text(widest, 4) + " apart, for " +
                     length_text(stiffener.spacing) + ", along the track from " + listed(places),
                 "Over their thickness of " + length_text(stiffener.thickness) +
                     " plates bend there by more than the gap of " + length_text(options.flanges.gap) +
                     " (flanges.gap), or frames, bolts or openings are in the way.",
                 spacing_that_does(widest) +
                     ", a smaller thickness, a larger flanges.gap, openings elsewhere, or no stiffeners"},
                workshop);
}

void UnitsWithoutLugs::add(std::size_t unit, double mass, std::vector<std::string>& units) {
  units.push_back(std::to_string(unit + 1) + " (" + rounded_text(mass, 4) + " kg)");
}

void UnitsWithoutLugs::tell(double take, const std::string& folded, Workshop& workshop) const {
  const auto which = [](std::vector<std::string> units) {
    const std::string many = units.size() == 1 ? "unit " : "units ";
    if (units.size() > kTold) {
      const std::string more = std::to_string(units.size() - kTold) + " more";
      units.resize(kTold);
      units.push_back(more);
    }
    return "lifting: no lugs on " + many + listed(units);
  };
  if (!no_place_.empty()) {
    add_shortfall({"lifting", which(no_place_),
                   "Frames, stiffeners, bolts and openings leave no " + length_text(take, 3) +
                       " of the track free, which a pair of them takes.",
                   "longer units (split.longest), narrower frames, fewer stiffeners, or slings round them"},
                  workshop);
  }
  if (!no_room_.empty()) {
    add_shortfall({"lifting", which(no_room_), folded,
                   "another split.longest, no rim or another section, or slings round them"},
                  workshop);
  }
}

void note_lugs(std::size_t unit, double mass, double at, double off, Workshop& workshop) {
  constexpr double kOffPlumb = 5e-3;  // taste: told from there on [m]
  workshop.notes.push_back("Unit " + std::to_string(unit + 1) + ": " + rounded_text(mass, 4) +
                           " kg, lugs at " + length_text(at, 4) + " along the track, " +
                           (off > kOffPlumb ? length_text(off, 3) + " from plumb above" : "beside") +
                           " its centre of gravity.");
}

}  // namespace glissade::parts
