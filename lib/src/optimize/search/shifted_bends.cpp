#include "optimize/search/shifted_bends.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace glissade::optimizer {
namespace {

// Curvature may jump where parts meet: knots nearer to that are left out.
constexpr double kBeside = 0.2 * kPair;  // taste

/// Whether the track turns there by much within less than is left out where parts meet: where no radius is asked for bends
/// begin and end with corners.
bool has_corner_at(const Found& found, double place) {
  const Vector& knots = found.track->mesh().knots;
  const Layout& layout = found.track->layout();
  double turn = 0.0;
  for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
    const double width = knots[i + 1] - knots[i];
    const bool is_near = knots[i] < place + 2.0 * kBeside && knots[i + 1] > place - 2.0 * kBeside;
    if (is_near && width < kBeside)
      turn += 0.5 * width * (found.z[layout.turn(i)] + found.z[layout.turn(i + 1)]);
  }
  return std::fabs(turn) > kCorner;
}

/// Where parts meet beside a corner. @return from the end of the stretch that it ends
double beside_corner(Span stretch) {
  return std::min(kPair, 0.25 * (stretch.to - stretch.from));
}

/// Puts parts of a track one behind the other: the same curvature in another order.
class Assembly {
 public:
  explicit Assembly(const Found& found)
      : track_(*found.track), knots_(track_.mesh().knots), layout_(track_.layout()), z_(found.z) {
    result_.mesh = track_.mesh();
    result_.mesh.knots.clear();
    result_.mesh.fine.clear();
    result_.mesh.fine_turns.clear();
    if (!track_.has_fixed_pieces()) result_.mesh.core_length = track_.core_length(z_);
    result_.z.push_back(z_[layout_.angle()]);
  }

  void append(Span part) {
    if (!(part.to - part.from > 2.0 * kBeside)) return;
    const double by = at_ - part.from;
    const double first = at_ == 0.0 ? part.from : part.from + kBeside;
    add(first + by, turn_at(first));
    const double from = part.from == 0.0 ? 0.0 : first + kBeside;
    const double to = part.to == 1.0 ? 1.0 : part.to - kBeside;
    for (std::size_t i = 0; i < knots_.size(); ++i) {
      if (knots_[i] > from && knots_[i] < to) add(knots_[i] + by, z_[layout_.turn(i)]);
    }
    // What follows loads between the knots goes along.
    for (const double sigma : track_.mesh().fine) {
      if (sigma > from && sigma < to) fine_.emplace_back(sigma + by, turn_at(sigma));
    }
    at_ += part.to - part.from;
    add(at_, turn_at(part.to));
  }

  [[nodiscard]] MeshTrack whole() && {
    constexpr double kSame = 1e-9;  // rounding
    Vector& knots = result_.mesh.knots;
    knots.back() = 1.0;  // but for what is too short to be a part
    result_.z.push_back(z_[layout_.length()]);
    const Layout layout{knots.size()};
    for (const auto& [sigma, turn] : fine_) {
      const double at = count_pieces(knots, sigma);
      const auto piece = std::min(static_cast<std::size_t>(at), knots.size() - 2);
      const double share = at - static_cast<double>(piece);
      if (share < kSame || share > 1.0 - kSame) continue;  // a knot now
      const double along =
          (1.0 - share) * result_.z[layout.turn(piece)] + share * result_.z[layout.turn(piece + 1)];
      result_.mesh.fine.push_back(sigma);
      result_.mesh.fine_turns.push_back(turn - along);
    }
    return std::move(result_);
  }

 private:
  [[nodiscard]] double turn_at(double sigma) const {
    const double at = count_pieces(knots_, sigma);
    const auto piece = std::min(static_cast<std::size_t>(at), knots_.size() - 2);
    const double share = at - static_cast<double>(piece);
    return (1.0 - share) * z_[layout_.turn(piece)] + share * z_[layout_.turn(piece + 1)] +
           track_.own_turn(sigma);
  }
  void add(double knot, double turn) {
    result_.mesh.knots.push_back(knot);
    result_.z.push_back(turn);
  }

  const Transcription& track_;
  const Vector& knots_;
  const Layout& layout_;
  const Vector& z_;
  MeshTrack result_;
  std::vector<std::pair<double, double>> fine_;  ///< places and turning rates
  double at_ = 0.0;
};

}  // namespace

std::vector<Span> stretches_at_cap(const ScaledProblem& problem, const Found& found) {
  constexpr double kHardlyApart = 0.01;  // taste
  const std::vector<std::vector<Span>> bindings = bindings_of(problem, found);
  std::vector<Span> stretches;
  for (std::size_t i = 0; i < problem.limits.size(); ++i) {
    if (!is_cap_along(problem.limits[i])) continue;
    for (const Span& span : bindings[i]) {
      const auto share_at = [&](double place) { return found.track->sigma_at(found.z, place); };
      stretches.push_back({share_at(span.from), share_at(span.to)});
    }
  }
  std::stable_sort(stretches.begin(), stretches.end(),
                   [](const Span& a, const Span& b) { return a.from < b.from; });
  std::vector<Span> apart;
  for (const Span& span : stretches) {
    if (apart.empty() || span.from - apart.back().to > kHardlyApart) {
      apart.push_back(span);
    } else {
      apart.back().to = std::max(apart.back().to, span.to);
    }
  }
  return apart;
}

MeshTrack with_shifted_bend(const Found& found, Span before, Span behind, double share) {
  const double from = before.to - (has_corner_at(found, before.to) ? beside_corner(before) : 0.0);
  const double to = behind.from + (has_corner_at(found, behind.from) ? beside_corner(behind) : 0.0);
  Assembly track(found);
  if (share > 0.0) {
    const double part = share * (behind.to - behind.from);
    for (const Span& span : {Span{0.0, from}, Span{to, to + part}, Span{from, to}, Span{to + part, 1.0}})
      track.append(span);
  } else {
    const double part = -share * (before.to - before.from);
    for (const Span& span : {Span{0.0, from - part}, Span{from, to}, Span{from - part, from}, Span{to, 1.0}})
      track.append(span);
  }
  return std::move(track).whole();
}

}  // namespace glissade::optimizer
