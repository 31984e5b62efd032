#pragma once

#include "glissade/pipeline.hpp"

#include <string>

namespace glissade::app {

/// What people read: the track and the ride down it.
[[nodiscard]] std::string track_summary(const Design& design, const Track& track);

/// The same with the solid and the files.
[[nodiscard]] std::string build_summary(const Design& design, const Build& build);

/// One line: endpoints, how the body starts.
[[nodiscard]] std::string span_line(const Design& design, const Endpoints& endpoints);

/// The same with the friction.
[[nodiscard]] std::string task_line(const Design& design, const Endpoints& endpoints);

/// @return "1.234 s"
[[nodiscard]] std::string time_text(double seconds);
/// @return "5.43 m/s"
[[nodiscard]] std::string speed_text(double metres_per_second);
/// @return "12.3 m/s^2"; "unbounded" for infinity
[[nodiscard]] std::string acceleration_text(double metres_per_second_squared);
/// @return "12.3 m/s^2 (1.25 g)"; "unbounded" for infinity
[[nodiscard]] std::string load_text(double metres_per_second_squared);
/// @return in the unit that suits its size: "4.56 m^3", "12.3 litres", below a tenth of one "45.6 cm^3", below a tenth of
///         that "78.9 mm^3"; "0 litres"
[[nodiscard]] std::string volume_text(double cubic_metres, int digits);
/// @return digits in groups of three: "48 212"
[[nodiscard]] std::string count_text(std::size_t count);

}  // namespace glissade::app
