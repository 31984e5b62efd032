#pragma once

#include "glissade/centerline/clothoid_spline.hpp"
#include "glissade/optimize/optimize.hpp"

#include "optimize/problem/changed_bound.hpp"
#include "optimize/random_limits.hpp"
#include "referee/judgement.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/thorough.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

// What the search calls infeasible is held against a search of another kind: penalised violations of splines
// of few pieces, minimised without derivatives from many random beginnings. It finds a track where there
// plainly is one, and must not find any where the report says that limits contradict each other.
namespace glissade::testing_problems {

inline constexpr int kPiecesOfSearch = 6;

inline std::shared_ptr<ClothoidSpline> track_of(const Problem& problem, const std::vector<double>& z) {
  const double chord = std::hypot(problem.endpoints.run, problem.endpoints.drop);
  const double core = std::exp(z[1]) * chord - problem.limits.lead_in - problem.limits.lead_out;
  if (!(core > 0.05 * chord)) return nullptr;
  const bool starts_straight = problem.limits.lead_in > 0.0;
  const bool ends_straight = problem.limits.lead_out > 0.0;
  std::vector<ClothoidSegment> segments;
  if (starts_straight) segments.push_back({problem.limits.lead_in, 0.0, 0.0});
  const auto curvature = [&](int knot) {
    if ((knot == 0 && starts_straight) || (knot == kPiecesOfSearch && ends_straight)) return 0.0;
    return z[static_cast<std::size_t>(2 + knot)] / chord;
  };
  for (int i = 0; i < kPiecesOfSearch; ++i)
    segments.push_back({core / kPiecesOfSearch, curvature(i), curvature(i + 1)});
  if (ends_straight) segments.push_back({problem.limits.lead_out, 0.0, 0.0});
  return std::make_shared<ClothoidSpline>(Angle::from_radians(z[0]), std::move(segments));
}

inline double violation(const Problem& problem, const std::vector<double>& z) {
  constexpr double kNoTrack = 10.0;
  if (std::fabs(z[0]) > 1.5) return kNoTrack;
  // Coils, and tracks of more than e^4 chords, are none; a spline refuses to be wound up without end.
  constexpr double kCoil = 1e3;
  constexpr double kLongest = 4.0;
  if (std::any_of(z.begin(), z.end(), [](double value) { return !(std::fabs(value) < kCoil); }))
    return kNoTrack;
  if (z[1] > kLongest) return kNoTrack;
  const auto track = track_of(problem, z);
  if (!track) return kNoTrack;
  for (const double s : track->breaks()) {
    if (std::fabs(track->slope_angle(s)) > 1.57) return kNoTrack;
  }
  const referee::Judgement verdict = referee::judge_track(problem, track, 6);
  return verdict.worst + (verdict.arrived ? 0.0 : 1.0);
}

/// A (1+1) evolution: random steps, kept where they pay, of a size that follows its success.
inline double least_found(const Problem& problem, testing::Random& random) {
  double least = 10.0;
  for (int beginning = 0; beginning < (testing::thorough() ? 3 : 1); ++beginning) {
    std::vector<double> z(static_cast<std::size_t>(3 + kPiecesOfSearch), 0.0);
    const double mean = std::atan2(problem.endpoints.drop, problem.endpoints.run);
    z[0] = mean + random.between(-0.2, 0.5);
    z[1] = random.between(0.0, 0.1);
    for (std::size_t i = 2; i < z.size(); ++i) z[i] = random.between(-0.2, 1.0);
    double now = violation(problem, z);
    double size = 0.3;
    for (int step = 0; step < 400; ++step) {
      std::vector<double> next = z;
      for (double& value : next) value += size * random.between(-1.0, 1.0) * random.between(0.0, 1.0);
      const double there = violation(problem, next);
      if (there <= now) {
        now = there;
        z = std::move(next);
        size *= 1.5;
      } else {
        size *= 0.92;
      }
      if (size < 1e-6) size = 0.05;
    }
    least = std::min(least, now);
  }
  return least;
}

/// How many of a test's problems are searched; more of it takes minutes: continuous integration does that.
inline int problems_of(int quick) {
  const int most = std::max(1, 2 * testing_problems::problem_count() / 3);
  return testing::thorough() ? most : std::min(most, quick);
}

/// What would do is enough: each bound, put in alone, has a track.
inline void check_needed(const Problem& problem, const OptimizeReport& report) {
  for (const Relaxation& relaxation : report.conflict.relaxations) {
    CAPTURE(relaxation.limit.key(), relaxation.value, relaxation.needed);
    const bool moves = entry_of(relaxation.limit.id).form == LimitForm::list && relaxation.needed < 0.0;
    if (moves || relaxation.limit.id == LimitId::match_belt) continue;
    const auto changed = optimizer::with_bound(problem, relaxation.limit, relaxation.needed);
    REQUIRE(changed);
    CHECK(optimize(*changed).centerline);
  }
}

/// Holds an answer without a track against that search. @return whether the limits are said to contradict each other
inline bool hold_none(const Problem& problem, const OptimizeReport& report, testing::Random& steps) {
  CAPTURE(report.message);
  check_needed(problem, report);
  if (report.status != OptimizeStatus::infeasible) return false;
  CHECK(least_found(problem, steps) > 1e-5);
  return true;
}

}  // namespace glissade::testing_problems
