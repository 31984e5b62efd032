#include "glissade/trades/chute/materials.hpp"

#include "glissade/core/number_text.hpp"

#include <algorithm>
#include <cmath>

namespace glissade {
namespace {

template <typename Thing>
const Thing* find_word(const std::vector<Thing>& things, std::string_view word) {
  const auto found =
      std::find_if(things.begin(), things.end(), [&](const Thing& thing) { return thing.word == word; });
  return found == things.end() ? nullptr : &*found;
}

std::string percent(double share, int digits) {
  return rounded_text(100.0 * share, digits) + " %";
}

/// A source read at a moisture; what it does not tell is a warning.
WallFriction at_moisture(WallFriction friction, std::optional<double> moisture,
                         std::vector<std::string>& warnings) {
  if (!friction.moisture || !moisture) return friction;
  const double dry = *friction.moisture->lowest;
  const double wet = *friction.moisture->highest;
  if (*moisture < dry || *moisture > wet) {
    constexpr int kDigits = 3;  // taste: as moistures are told
    const auto [below, least] = texts_apart(*moisture, dry, &percent, kDigits);
    const auto [above, most] = texts_apart(*moisture, wet, &percent, kDigits);
    warnings.push_back("moisture: " + (*moisture < dry ? below : above) + " lies outside the " + least +
                       " to " + most + " that was measured (" + friction.from.text + ")");
  }
  if (friction.low == friction.high) return friction;
  const double share = std::clamp((*moisture - dry) / (wet - dry), 0.0, 1.0);
  const double angle = friction.low.radians() + share * (friction.high.radians() - friction.low.radians());
  friction.low = friction.nominal = friction.high = Angle::from_radians(angle);
  return friction;
}

}  // namespace

const Material* MaterialLibrary::material(std::string_view word) const {
  return find_word(materials, word);
}

const Liner* MaterialLibrary::liner(std::string_view word) const {
  return find_word(liners, word);
}

Certainty FrictionFound::certainty() const {
  Certainty least = from.front().from.certainty;
  for (const WallFriction& friction : from) least = std::max(least, friction.from.certainty);
  return least;
}

std::optional<FrictionFound> friction_on(const Material& material, const Liner& liner,
                                         std::optional<double> moisture) {
  FrictionFound found;
  double sum = 0.0;
  for (const WallFriction& told : material.friction) {
    const bool of_class = !told.wall_class.empty() && told.wall_class == liner.wall_class;
    const bool of_liner = !told.liner.empty() && told.liner == liner.word;
    if (!of_liner && !of_class) continue;
    const WallFriction friction = at_moisture(told, moisture, found.warnings);
    const bool first = found.from.empty();
    found.low = first ? friction.low : std::min(found.low, friction.low);
    found.high = first ? friction.high : std::max(found.high, friction.high);
    sum += friction.nominal.radians();
    found.from.push_back(friction);
  }
  if (found.from.empty()) return {};
  found.nominal = Angle::from_radians(sum / static_cast<double>(found.from.size()));
  return found;
}

}  // namespace glissade
