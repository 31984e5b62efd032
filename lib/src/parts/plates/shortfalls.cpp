// What is set on plates and finds no place there: which, why, and what to try.

#include "parts/plates/shortfalls.hpp"

#include "glissade/core/number_text.hpp"
#include "glissade/core/words.hpp"

#include "parts/shop/workshop_list.hpp"

namespace glissade::parts {
namespace {

constexpr std::size_t kTold = 6;  // taste: of places or units, the others are counted

}  // namespace

void StiffenerPlaces::tell_missing(const PlateOptions& options, Workshop& workshop) const {
  if (missing_.empty()) return;
  const StiffenerOptions& stiffener = *options.stiffeners;
  std::vector<std::string> places;
  for (std::size_t i = 0; i < missing_.size() && i < kTold; ++i)
    places.push_back(length_text(missing_[i], 3));
  if (missing_.size() > kTold) places.push_back(std::to_string(missing_.size() - kTold) + " more");
  add_shortfall({"stiffeners",
                 "stiffeners: " + std::to_string(missing_.size()) + " of " + std::to_string(asked_) +
                     (missing_.size() == 1 ? " finds" : " find") + " no place, at about " + listed(places) +
                     " along the track",
                 "Over their thickness of " + length_text(stiffener.thickness) +
                     " plates bend there by more than the gap of " + length_text(options.flanges.gap) +
                     " (flanges.gap), or frames, bolts or openings are in the way.",
                 "another spacing than " + length_text(stiffener.spacing) +
                     ", a smaller thickness, a larger flanges.gap, or no stiffeners"},
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
  constexpr double kOffPlumb = 20e-3;  // taste: told from there on [m]
  workshop.notes.push_back("Unit " + std::to_string(unit + 1) + ": " + rounded_text(mass, 4) +
                           " kg, lugs at " + length_text(at, 4) + " along the track, " +
                           (off > kOffPlumb ? length_text(off, 3) + " from plumb above" : "beside") +
                           " its centre of gravity.");
}

}  // namespace glissade::parts
