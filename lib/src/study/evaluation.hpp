#pragma once

#include "glissade/study/study.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace glissade::study {

/// Computes single points of a study.
class Evaluation {
 public:
  /// Finds the track to be frozen and the columns.
  /// @throws as run()
  Evaluation(const Study& study, const std::stop_token& stop);

  /// @return names of the quantities of a row
  [[nodiscard]] const std::vector<std::string>& columns() const noexcept { return columns_; }
  /// Safe to call from several threads at once.
  /// @return one line of a table, without its end
  [[nodiscard]] std::string row(std::uint64_t index) const;

 private:
  struct Outcome {
    Status status = Status::invalid;
    std::string reason;
    std::vector<Quantity> quantities;
  };

  [[nodiscard]] Outcome outcome(const std::vector<Override>& values) const;
  [[nodiscard]] Track track_of(const Design& design) const;
  [[nodiscard]] std::vector<std::string> known_columns(const std::stop_token& stop) const;

  const Study& study_;
  CenterlinePtr frozen_;
  std::optional<HoodDesign> frozen_hood_;  ///< before it, where its search chose one
  std::vector<std::string> columns_;
};

/// @return the first line of every table of a study
[[nodiscard]] std::string table_heading(const Plan& plan, const std::vector<std::string>& columns);

}  // namespace glissade::study
