#pragma once

#include "glissade/report/report.hpp"

#include <nlohmann/json.hpp>

namespace glissade::report {

/// The report's data, fields in the order that docs/report-data.md lists them.
[[nodiscard]] nlohmann::ordered_json report_document(const ReportInput& input);

}  // namespace glissade::report
