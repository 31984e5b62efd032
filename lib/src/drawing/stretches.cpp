#include "drawing/stretches.hpp"

#include "core/millimetres.hpp"

#include <algorithm>
#include <set>
#include <utility>

namespace glissade::drawing {
namespace {

struct SeenPiece {
  double x = 0.0;
  std::size_t part = 0;
  std::size_t place = 0;
};

std::vector<SeenPiece> pieces_in_order(const Workshop& workshop, const Eye& eye) {
  std::vector<SeenPiece> pieces;
  for (std::size_t i = 0; i < workshop.parts.size(); ++i) {
    const ShopPart& part = workshop.parts[i];
    for (std::size_t k = 0; k < part.places.size(); ++k)
      pieces.push_back({middle_of(part, part.places[k], eye).x, i, k});
  }
  std::stable_sort(pieces.begin(), pieces.end(),
                   [](const SeenPiece& a, const SeenPiece& b) { return a.x < b.x; });
  return pieces;
}

/// @return where stretches with so many kinds of parts at most, and no longer ones, begin among pieces in order
std::vector<std::size_t> stretch_starts(const std::vector<SeenPiece>& pieces, std::size_t most,
                                        double longest) {
  std::vector<std::size_t> starts;
  std::set<std::size_t> kinds;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    kinds.insert(pieces[i].part);
    const bool fits = !starts.empty() && pieces[i].x - pieces[starts.back()].x <= longest;
    if (fits && kinds.size() <= most) continue;
    starts.push_back(i);
    kinds = {pieces[i].part};
  }
  return starts;
}

}  // namespace

Vec2 middle_of(const ShopPart& part, const Frame& place, const Eye& eye) {
  const Frame& first = part.places.front();
  const Vec3 from = part.centre_of_gravity - first.origin;
  const Vec3 own{dot(from, first.x), dot(from, first.y), dot(from, first.z)};
  return core::kMillimetres * eye.see(place.to_space(own));
}

std::vector<Workshop> stretches_of(const Workshop& workshop, const Eye& eye, std::size_t most,
                                   double longest) {
  const std::vector<SeenPiece> pieces = pieces_in_order(workshop, eye);
  std::vector<std::size_t> starts = stretch_starts(pieces, most, longest);
  // No more stretches, as evenly full as these can be.
  for (std::size_t fewer = most - 1; fewer > 0; --fewer) {
    std::vector<std::size_t> even = stretch_starts(pieces, fewer, longest);
    if (even.size() > starts.size()) break;
    starts = std::move(even);
  }
  std::vector<Workshop> stretches;
  for (std::size_t k = 0; k < starts.size(); ++k) {
    const std::size_t end = k + 1 < starts.size() ? starts[k + 1] : pieces.size();
    std::vector<std::vector<std::size_t>> places(workshop.parts.size());
    for (std::size_t i = starts[k]; i < end; ++i) places[pieces[i].part].push_back(pieces[i].place);
    Workshop stretch;
    stretch.name = workshop.name;
    stretch.tolerance = workshop.tolerance;
    stretch.setting_out = workshop.setting_out;
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (places[i].empty()) continue;
      const ShopPart& whole = workshop.parts[i];
      ShopPart part = whole;
      part.places.clear();
      for (const std::size_t place : places[i]) part.places.push_back(whole.places[place]);
      // Of the first of its pieces, which may be another one here.
      const Frame& first = whole.places.front();
      const Vec3 from = whole.centre_of_gravity - first.origin;
      part.centre_of_gravity =
          part.places.front().to_space({dot(from, first.x), dot(from, first.y), dot(from, first.z)});
      stretch.parts.push_back(std::move(part));
    }
    stretches.push_back(std::move(stretch));
  }
  return stretches;
}

}  // namespace glissade::drawing
