// Counts points and unknowns, piece by piece and in rows of neighbours. A row that lies between others meets them in place
// and direction: two equations more.
#include "centerline/profile/profile_seen.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace glissade::centerline {
namespace {

/// Curvatures that a piece has of its own, as long as it is tied to no other.
std::size_t curvatures_of(const ProfilePiece& piece) {
  switch (piece.shape) {
    case PieceShape::straight:
      return 0;
    case PieceShape::arc:
    case PieceShape::cubic:
      return 1;
    case PieceShape::clothoid:
    case PieceShape::bend:
      break;
  }
  return 2 + piece.swellings;
}

/// Pieces and points beside them.
class SeenPieces {
 public:
  SeenPieces(const PiecewiseProfile& profile, const std::vector<double>& places, bool met)
      : profile_(profile), places_(places), spare_(met ? 0 : 1), curve_(profile.spline()) {
    breaks_.push_back(0.0);
    for (const ProfilePiece& piece : profile.pieces) breaks_.push_back(breaks_.back() + piece.length);
    determined_.assign(profile.pieces.size(), true);
  }

  [[nodiscard]] std::optional<CurvatureRange> range() {
    const std::size_t size = profile_.pieces.size();
    for (std::size_t first = 0; first < size; ++first) {
      // The shortest row from here: longer ones tell of it again.
      std::size_t last = first;
      while (last < size && determined(first, last)) ++last;
      if (last < size) add(first, last);
    }
    if (!range_) return {};
    for (std::size_t k = 0; k < size; ++k) {
      const ProfilePiece& piece = profile_.pieces[k];
      if (!determined_[k]) continue;
      const double most = std::max(std::fabs(piece.entry_curvature), std::fabs(piece.exit_curvature));
      range_->least = std::max(range_->least, most);
      range_->greatest = std::max(range_->greatest, most);
    }
    return range_;
  }

 private:
  /// Whether points are no fewer along the pieces from first to last than the unknowns of these.
  [[nodiscard]] bool determined(std::size_t first, std::size_t last) const {
    const std::size_t size = profile_.pieces.size();
    std::size_t unknowns = 0;
    for (std::size_t k = first; k <= last; ++k) unknowns += 1 + curvatures_of(profile_.pieces[k]);
    std::size_t known = 0;
    for (std::size_t k = std::max<std::size_t>(first, 1); k <= std::min(last + 1, size - 1); ++k)
      known += profile_.pieces[k].tied ? 1 : 0;
    // Lengths are one more than pieces between others, and the two equations; at an end one each. All of them together begin
    // in a place and direction, and their last length is not asked for.
    const bool inside = first > 0 && last + 1 < size;
    const bool all = first == 0 && last + 1 == size;
    if (inside) ++known;
    if (all) ++unknowns;
    return seen(first, last) + known >= unknowns + spare_;
  }

  [[nodiscard]] std::size_t seen(std::size_t first, std::size_t last) const {
    // A point as near to a break shows nothing of what lies behind it.
    constexpr double kAtBreak = 1e-3;  // rounding: of the mean distance of points
    const double near = kAtBreak * breaks_.back() / static_cast<double>(places_.size());
    const double from = first == 0 ? -near : breaks_[first] + near;
    const double to = last + 1 == profile_.pieces.size() ? breaks_.back() + near : breaks_[last + 1] - near;
    return static_cast<std::size_t>(
        std::count_if(places_.begin(), places_.end(), [&](double s) { return s > from && s < to; }));
  }

  /// What turns as far between the points beside a row: evenly, or all at once.
  void add(std::size_t first, std::size_t last) {
    constexpr double kSharper = 20.0;  // taste: nobody draws a bend that is shorter than this part of the way
    for (std::size_t k = first; k <= last; ++k) determined_[k] = false;
    double from = 0.0;
    double to = curve_.length();
    for (const double s : places_) {
      if (s <= breaks_[first]) from = std::max(from, std::min(s, to));
    }
    for (const double s : places_) {
      if (s >= breaks_[last + 1]) to = std::min(to, s);
    }
    const double even = std::fabs(curve_.slope_angle(to) - curve_.slope_angle(from)) / (to - from);
    // At an end no direction behind it is known: what leads to the last point by a shorter bend turns by more.
    const bool at_end = first == 0 || last + 1 == profile_.pieces.size();
    if (!range_) range_.emplace();
    range_->least = std::max(range_->least, at_end ? 0.5 * even : even);
    range_->greatest = std::max(range_->greatest, (at_end ? kSharper * kSharper : kSharper) * even);
  }

  const PiecewiseProfile& profile_;
  const std::vector<double>& places_;
  std::size_t
      spare_;  // points beyond what is needed: without, unknowns that do not meet them would be the wrong ones
  ClothoidSpline curve_;
  std::vector<double> breaks_;
  std::vector<bool> determined_;
  std::optional<CurvatureRange> range_;
};

}  // namespace

std::optional<CurvatureRange> largest_curvature_unseen(const PiecewiseProfile& profile,
                                                       const std::vector<double>& places, bool met) {
  return SeenPieces(profile, places, met).range();
}

}  // namespace glissade::centerline
