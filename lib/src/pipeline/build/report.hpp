#pragma once

#include "glissade/pipeline.hpp"
#include "glissade/report/report.hpp"

#include <filesystem>
#include <vector>

namespace glissade::pipeline {

/// What a build has made so far, for the report that goes beside it.
struct BuildForReport {
  const Track& track;
  const CrossSection* section;                         ///< null where there is no solid
  const ProvenSolid* swept;                            ///< null where there is none
  std::vector<std::filesystem::path> files;            ///< as they stand, in the order of the build
  std::vector<std::filesystem::path> read_back_files;  ///< those that were read again and compared
  std::stop_token stop = {};
  const WorkshopBuild* workshop = nullptr;  ///< what a workshop makes; null: nothing
};

/// @return what the report page of a build is made from; a verdict is a pass only where this build compared
///         the numbers that stand beside it
[[nodiscard]] ReportInput report_input(const Design& design, const BuildForReport& build);

/// Where the stream of a ride flies from the finish down to the belt, as a line; empty if it does not.
[[nodiscard]] std::vector<Vec2> flight_to_belt(const Design& design, const Motion& motion);

/// The stream in the air and below its hood, as lines: x run from the start, y height of the site [m].
/// @param design  solved
[[nodiscard]] std::vector<ReportFlight> flights_of(const Design& design, const Track& track);
/// The same of another ride of the track.
[[nodiscard]] std::vector<ReportFlight> flights_of(const Design& design, const Track& track,
                                                   const Motion& motion);

}  // namespace glissade::pipeline
