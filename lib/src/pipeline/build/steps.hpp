#pragma once

#include "glissade/core/stop.hpp"
#include "glissade/pipeline.hpp"

#include <string>

namespace glissade::pipeline {

/// Tells how far a build is, step by step. Costs are shares of time, in units of writing one mesh file.
class Steps {
 public:
  /// @param total  cost of everything, done or not
  /// @param done   what has been done before
  Steps(const RunContext& context, double total, double done = 0.0)
      : context_(context), total_(total), done_(done) {}

  /// Tells what comes next and what it will have cost, unless the work is to end.
  void enter(const std::string& stage, double cost) {
    require_going(context_.stop);
    if (context_.progress) context_.progress(stage, done_ / total_);
    done_ += cost;
  }

  [[nodiscard]] const std::stop_token& stop() const { return context_.stop; }

 private:
  const RunContext& context_;
  double total_;
  double done_;
};

}  // namespace glissade::pipeline
