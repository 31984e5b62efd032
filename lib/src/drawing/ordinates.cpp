#include "drawing/ordinates.hpp"

#include "glissade/core/number_text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace glissade::drawing {
namespace {

constexpr double kShortest = 0.3;  // [m]
constexpr double kMostRows = 30.0;

double round_step(double length) {
  constexpr std::array<double, 6> kSteps = {0.05, 0.1, 0.25, 0.5, 1.0, 2.5};
  for (const double step : kSteps) {
    if (length / step <= kMostRows) return step;
  }
  return kSteps.back();
}

/// Heights at which a piece passes over x.
void see_piece(const PathPiece& piece, double x, std::vector<double>& heights) {
  if (piece.straight()) {
    const double run = piece.to.x - piece.from.x;
    if (run == 0.0) {
      if (piece.from.x == x) heights.insert(heights.end(), {piece.from.y, piece.to.y});
      return;
    }
    const double share = (x - piece.from.x) / run;
    if (share >= 0.0 && share <= 1.0) heights.push_back(piece.from.y + share * (piece.to.y - piece.from.y));
    return;
  }
  constexpr int kParts = 16;
  for (int k = 0; k < kParts; ++k) {
    double low = static_cast<double>(k) / kParts;
    double high = static_cast<double>(k + 1) / kParts;
    const double at_low = point_on(piece, low).x - x;
    const double at_high = point_on(piece, high).x - x;
    if (at_low * at_high > 0.0) continue;
    for (int round = 0; round < 60; ++round) {
      const double middle = 0.5 * (low + high);
      const double there = point_on(piece, middle).x - x;
      ((there < 0.0) == (at_low < 0.0) ? low : high) = middle;
    }
    heights.push_back(point_on(piece, 0.5 * (low + high)).y);
  }
}

std::string tenths_of_mm(double metres) {
  return decimal_text(std::round(metres * 1e4) / 10.0 + 0.0);
}

}  // namespace

std::optional<std::pair<double, double>> heights_at(const ArcPath& outline, double x) {
  std::vector<double> heights;
  for (const PathPiece& piece : pieces_of(outline)) see_piece(piece, x, heights);
  if (heights.empty()) return std::nullopt;
  const auto [low, high] = std::minmax_element(heights.begin(), heights.end());
  return std::pair{*low, *high};
}

SheetTable ordinate_table(const ArcPath& outline) {
  SheetTable table;
  const std::vector<PathPiece> pieces = pieces_of(outline);
  const bool curved =
      std::any_of(pieces.begin(), pieces.end(), [](const PathPiece& piece) { return !piece.straight(); });
  const PlaneBox box = bounds(outline);
  if (!curved || box.width() < kShortest) return table;
  table.caption = "Ordinates, from the lower left corner of its box";
  table.widths_mm = {22.0, 22.0, 22.0};
  table.header = {"x mm", "lower mm", "upper mm"};
  const double step = round_step(box.width());
  for (double k = 0.0; k * step <= box.width() * (1.0 + 1e-12); k += 1.0) {
    const double x = std::min(k * step, box.width());
    const auto heights = heights_at(outline, box.low.x + x);
    if (!heights) continue;
    table.rows.push_back({tenths_of_mm(x), tenths_of_mm(heights->first - box.low.y),
                          tenths_of_mm(heights->second - box.low.y)});
  }
  return table;
}

}  // namespace glissade::drawing
