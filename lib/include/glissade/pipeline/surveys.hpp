#pragma once

#include "glissade/pipeline/solve.hpp"
#include "glissade/report/figure.hpp"
#include "glissade/trades/survey.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace glissade {

/// Reads measured points from a CSV file: columns `x`, `z` and, if there, `y` and `name`, metres in the frame of the design.
/// @throws FileError if it cannot be read, lacks a column (y, where the track leads within some 6 deg of it), has a cell that is no
///         number or no point
[[nodiscard]] std::vector<SurveyPoint> read_survey(const std::filesystem::path& file,
                                                   const Placement& placement);

/// The deviations as CSV, SI, angles in degrees.
/// @throws FileError as AtomicFile
void write_survey_csv(const std::filesystem::path& file, const Survey& survey);

/// Deviation with its tolerance, slope deviation, and the speeds as built and as designed, along the track.
[[nodiscard]] std::vector<Figure> survey_figures(const Track& track, const Survey& survey,
                                                 const SurveyRides& rides, const SurveyOptions& options);

/// A survey as JSON: docs/json.md.
[[nodiscard]] std::string survey_json(const Design& design, const Survey& survey, const SurveyRides& rides,
                                      const SurveyOptions& options);

}  // namespace glissade
