#include "optimize/shifted_bends.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace glissade::optimizer {
namespace {

/// Puts parts of a track one behind the other: the same curvature in another order.
class Assembly {
 public:
  explicit Assembly(const Found& found)
      : knots_(found.track->mesh().knots), layout_(found.track->layout()), z_(found.z) {
    result_.mesh = found.track->mesh();
    result_.mesh.knots.clear();
    // What follows loads between the knots is found again.
    result_.mesh.fine.clear();
    result_.mesh.fine_turns.clear();
    if (!found.track->has_fixed_pieces()) result_.mesh.core_length = found.track->core_length(z_);
    result_.z.push_back(z_[layout_.angle()]);
  }

  /// Where it begins and ends in the track itself there is a knot already.
  void append(Span part) {
    constexpr double kBeside = 0.2 * kPair;  // taste: curvature may jump where parts meet
    if (!(part.to - part.from > 2.0 * kBeside)) return;
    const double by = at_ - part.from;
    const bool begins = part.from == 0.0;
    const bool ends = part.to == 1.0;
    if (!begins) add(at_ + kBeside, turn_at(part.from + kBeside));
    for (std::size_t i = 0; i < knots_.size(); ++i) {
      const bool within =
          (begins || knots_[i] > part.from + 2.0 * kBeside) && (ends || knots_[i] < part.to - kBeside);
      if (within) add(ends && i + 1 == knots_.size() ? 1.0 : knots_[i] + by, z_[layout_.turn(i)]);
    }
    at_ += part.to - part.from;
    if (!ends) add(at_, turn_at(part.to));
  }

  [[nodiscard]] MeshTrack whole() && {
    result_.z.push_back(z_[layout_.length()]);
    return std::move(result_);
  }

 private:
  [[nodiscard]] double turn_at(double sigma) const {
    const double at = count_pieces(knots_, sigma);
    const auto piece = std::min(static_cast<std::size_t>(at), knots_.size() - 2);
    const double share = at - static_cast<double>(piece);
    return (1.0 - share) * z_[layout_.turn(piece)] + share * z_[layout_.turn(piece + 1)];
  }
  void add(double knot, double turn) {
    result_.mesh.knots.push_back(knot);
    result_.z.push_back(turn);
  }

  const Vector& knots_;
  const Layout& layout_;
  const Vector& z_;
  MeshTrack result_;
  double at_ = 0.0;
};

bool is_cap_along(const LimitSpec& limit) {
  return limit.measure == Measure::speed && limit.side > 0;
}

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
  const double from = before.to;
  const double to = behind.from;
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
