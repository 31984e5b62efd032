#pragma once

#include "glissade/optimize/optimize.hpp"

#include "core/processor_time.hpp"
#include "optimize/descent/search.hpp"

#include <algorithm>
#include <chrono>
#include <stop_token>

namespace glissade::optimizer {

/// How long a search may go on: its budget of processor time, and the caller's wish to stop. Keeps count of what it took.
/// To be asked by the thread that made it.
class Patience {
 public:
  Patience(double time_budget, const std::stop_token& stop) : time_budget_(time_budget), stop_(stop) {}

  /// @return on the clock [s]
  [[nodiscard]] double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  }
  [[nodiscard]] bool out_of_time() const { return core::processor_seconds() - taken_before_ > time_budget_; }
  [[nodiscard]] bool ends() const { return stop_.stop_requested() || out_of_time(); }

  /// @return what is left of the budget, for a search that is part of this one [s]; > 0
  [[nodiscard]] double left() const {
    constexpr double kLeast = 1e-3;  // taste
    return std::max(time_budget_ - (core::processor_seconds() - taken_before_), kLeast);
  }

 private:
  double time_budget_;
  const std::stop_token& stop_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  double taken_before_ = core::processor_seconds();
};

/// A search that is made of searches: its patience, and what all of them took together.
class Outlay {
 public:
  Outlay(const OptimizeOptions& options, const std::stop_token& stop)
      : patience_(options.time_budget, stop) {}

  [[nodiscard]] bool ends() const { return patience_.ends(); }
  [[nodiscard]] double left() const { return patience_.left(); }

  void add(const OptimizeReport& part) {
    iterations_ += part.iterations;
    evaluations_ += part.evaluations;
  }
  void add(const SearchControl& part) {
    iterations_ += part.rounds;
    evaluations_ += part.evaluations;
  }

  /// @return the end of the whole search, for what was asked
  [[nodiscard]] Optimum told(Optimum optimum, const Objective& asked) const {
    OptimizeReport& report = optimum.report;
    report.objective = asked;
    report.iterations = iterations_;
    report.evaluations = evaluations_;
    report.seconds = patience_.seconds();
    report.ended_early = report.ended_early || (optimum.centerline && patience_.ends());
    return optimum;
  }

 private:
  Patience patience_;
  int iterations_ = 0;
  int evaluations_ = 0;
};

}  // namespace glissade::optimizer
