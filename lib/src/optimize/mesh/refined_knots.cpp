#include "optimize/mesh/refined_knots.hpp"

#include "glissade/core/math.hpp"

#include <algorithm>
#include <cmath>

namespace glissade::optimizer {
namespace {

/// A stretch with knots of its own.
struct Cut {
  Span span;
  std::size_t pieces = 1;
  Span blurred;
};

std::vector<Cut> cuts_of(const Vector& knots, const std::vector<Switch>& switches) {
  constexpr std::size_t kMoreBlurred = 2;  // taste
  constexpr double kApart = 4.0 * kPair;   // taste
  std::vector<Cut> cuts;
  for (std::size_t i = 0; i < switches.size(); ++i) {
    const Switch& change = switches[i];
    const double free_from = cuts.empty() ? 0.0 : cuts.back().span.to + kApart;
    if (change.jump) {
      // Jumps too close to tell apart are kept as one stretch.
      const bool joined = change.jump->from < free_from && !cuts.empty();
      if (!joined) cuts.push_back({*change.jump, change.pieces, change.blurred});
      cuts.back().span.to = std::max(cuts.back().span.to, change.jump->to);
      cuts.back().blurred.to = std::max(cuts.back().blurred.to, change.blurred.to);
      cuts.back().pieces += joined ? 2 : 0;
      continue;
    }
    const bool before_jump = i + 1 < switches.size() && switches[i + 1].jump;
    const double free_to = before_jump ? switches[i + 1].jump->from - kApart : 1.0;
    const Span span{std::max(change.blurred.from, free_from), std::min(change.blurred.to, free_to)};
    if (span.to - span.from < kApart) continue;
    const double width = count_pieces(knots, span.to) - count_pieces(knots, span.from);
    cuts.push_back({span, kMoreBlurred + static_cast<std::size_t>(std::lround(width)), change.blurred});
  }
  return cuts;
}

/// zeta''' at the knots, from the kinks of the curvature there; in a cut it is that of its surroundings.
Vector third_differences(const Transcription& track, const Vector& z, const std::vector<Cut>& cuts) {
  const Layout& layout = track.layout();
  const Vector& knots = track.mesh().knots;
  const std::size_t n = knots.size();
  const auto slope = [&](std::size_t i) {
    return (z[layout.turn(i + 1)] - z[layout.turn(i)]) / (knots[i + 1] - knots[i]);
  };
  Vector third(n, 0.0);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    third[i] = std::fabs(slope(i) - slope(i - 1)) * 2.0 / (knots[i + 1] - knots[i - 1]);
  }
  third[0] = third[1];
  third[n - 1] = third[n - 2];
  constexpr double kRounding = 1e-12;  // rounding
  for (const Cut& cut : cuts) {
    const auto begin = std::lower_bound(knots.begin(), knots.end(), cut.blurred.from - kRounding);
    const auto end = std::upper_bound(knots.begin(), knots.end(), cut.blurred.to + kRounding);
    const auto first = static_cast<std::size_t>(begin - knots.begin());
    const auto last = static_cast<std::size_t>(end - knots.begin());
    const double before = first > 0 ? third[first - 1] : 0.0;
    const double behind = last < n ? third[last] : 0.0;
    for (std::size_t i = first; i < last; ++i) third[i] = 2 * i < first + last ? before : behind;
  }
  return third;
}

/// How many pieces are due up to a place, to some scale: linear between the knots of the track found.
class Demand {
 public:
  Demand(const Transcription& track, const Vector& z, const std::vector<Cut>& cuts)
      : knots_(track.mesh().knots), total_(knots_.size(), 0.0) {
    constexpr double kEvenShare = 0.3;  // taste
    constexpr double kMost = 1e100;  // rounding: of a jump between knots that are one; its square is a number
    const Mesh& mesh = track.mesh();
    const std::size_t n = knots_.size();
    const Vector third = third_differences(track, z, cuts);
    const double before = (mesh.lead_in + 0.5 * mesh.entry_speed2) / mesh.core_length;
    Vector density(n - 1);
    double mean = 0.0;
    for (std::size_t i = 0; i + 1 < n; ++i) {
      const double third_here = 0.5 * (third[i] + third[i + 1]);
      const double error = third_here < kMost ? third_here : kMost;
      const double speed = std::sqrt(0.5 * (knots_[i] + knots_[i + 1]) + before);
      density[i] = math::pow(error * error / speed, 1.0 / 7.0);
      mean += density[i] * (knots_[i + 1] - knots_[i]);
    }
    for (std::size_t i = 0; i + 1 < n; ++i) {
      const double due = density[i] + kEvenShare * (mean + 1e-6);
      total_[i + 1] = total_[i] + due * (knots_[i + 1] - knots_[i]);
    }
  }

  [[nodiscard]] double up_to(double sigma) const {
    const double at = count_pieces(knots_, sigma);
    const auto i = std::min(static_cast<std::size_t>(at), total_.size() - 2);
    return total_[i] + (at - static_cast<double>(i)) * (total_[i + 1] - total_[i]);
  }
  [[nodiscard]] double within(Span span) const { return up_to(span.to) - up_to(span.from); }
  /// Appends what lies behind span.from, in equal parts.
  void share_out(Span span, std::size_t pieces, Vector& knots) const {
    const double begin = up_to(span.from);
    const double amount = within(span);
    std::size_t at = 0;
    for (std::size_t k = 1; k < pieces; ++k) {
      const double wanted = begin + amount * static_cast<double>(k) / static_cast<double>(pieces);
      while (total_[at + 1] < wanted) ++at;
      const double share = (wanted - total_[at]) / (total_[at + 1] - total_[at]);
      knots.push_back(knots_[at] + share * (knots_[at + 1] - knots_[at]));
    }
    knots.push_back(span.to);
  }

 private:
  const Vector& knots_;
  Vector total_;
};

/// With those whose place is known: where friction changes.
std::vector<Switch> with_changes(std::vector<Switch> switches, const Mesh& mesh) {
  for (const ChangeKnots& change : mesh.change_knots) {
    if (change.from < change.to) switches.push_back({{change.from, change.to}, Span{change.from, change.to}});
  }
  std::stable_sort(switches.begin(), switches.end(),
                   [](const Switch& a, const Switch& b) { return a.blurred.from < b.blurred.from; });
  return switches;
}

}  // namespace

Vector refined_knots(const Transcription& track, const Vector& z, const std::vector<Switch>& switches,
                     std::size_t pieces) {
  constexpr std::size_t kFewest = 2;  // taste
  const std::vector<Cut> cuts = cuts_of(track.mesh().knots, with_changes(switches, track.mesh()));
  const Demand demand(track, z, cuts);
  double shared = demand.up_to(1.0);
  for (const Cut& cut : cuts) shared -= demand.within(cut.span);
  Vector knots{0.0};
  const auto share_out_to = [&](double to) {
    const Span span{knots.back(), to};
    if (span.to <= span.from) return;
    // Next to nothing is shared where cuts take all of the track but rounding.
    const double part = shared > 0.0 ? std::clamp(demand.within(span) / shared, 0.0, 1.0) : 0.0;
    const auto due = static_cast<std::size_t>(std::lround(part * static_cast<double>(pieces)));
    demand.share_out(span, std::max(kFewest, due), knots);
  };
  for (const Cut& cut : cuts) {
    share_out_to(cut.span.from);
    for (std::size_t k = 1; k < cut.pieces; ++k) {
      const double share = static_cast<double>(k) / static_cast<double>(cut.pieces);
      knots.push_back(cut.span.from + share * (cut.span.to - cut.span.from));
    }
    knots.push_back(cut.span.to);
  }
  share_out_to(1.0);
  for (double& knot : knots) knot = track.share_of_core(z, knot);
  return knots;
}

}  // namespace glissade::optimizer
