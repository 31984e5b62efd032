#pragma once

#include "glissade/design/design.hpp"
#include "glissade/section/cross_section.hpp"

#include "design/findings.hpp"

#include <initializer_list>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace glissade::design_file {

/// What the checks of one part of a design have found; each adds to it what it finds.
using Collected = std::vector<Finding>;

void check_track(const Design& design, Collected& findings);
void check_body(const Design& design, Collected& findings);
void check_ends(const Design& design, Collected& findings);
void check_stream(const Design& design, Collected& findings);
void check_centerline(const Design& design, Collected& findings);
void check_in_run(const Design& design, Collected& findings);
void check_hill(const Design& design, Collected& findings);
void check_gates(const Design& design, Collected& findings);
void check_cross_section(const Design& design, Collected& findings);
void check_mesh(const Design& design, Collected& findings);
/// What a workshop cannot make of it.
void check_fabrication(const Design& design, Collected& findings);
void check_export(const Design& design, Collected& findings);
/// Every problem of the limits, and of them with the rest of the design.
void check_limits(const Design& design, Collected& findings);

inline constexpr double kShortestTrack = 1e-4;  ///< [m], from end to end
inline constexpr double kLongestTrack = 1e6;    ///< [m]

inline void report(Collected& findings, std::vector<std::string> key_paths, Issue issue) {
  findings.push_back({std::move(key_paths), std::move(issue)});
}

/// @return the length in metres whatever its size
[[nodiscard]] std::string metres(double value);

/// @return a share that the bounds refuse, in percent
[[nodiscard]] std::string percent_beyond(double share, std::initializer_list<double> bounds);

/// @return the horizontal distance of the finish from the start [m]
[[nodiscard]] double run_of(const TrackDesign& track);
/// @return the height of the start above the finish [m]
[[nodiscard]] double drop_of(const TrackDesign& track);
/// @return "drop 1.08 m over 5.4 m"
[[nodiscard]] std::string drop_over_run(const TrackDesign& track);

/// @return an exit speed above the entry speed that tracks of the design may well reach, as files write it: "7 m/s"; none where
///         a straight line gains no speed
[[nodiscard]] std::optional<std::string> exit_speed_to_ask_for(const Design& design);
/// @return a drop [m] on which the lowest exit speed of the design, or one that is not asked for, may well be reached
[[nodiscard]] double drop_to_ask_for(const Design& design);

/// @return the section of the design; none if it has none, or check_cross_section() finds something wrong with it
[[nodiscard]] std::optional<CrossSection> sound_cross_section(const Design& design);

/// @return the key by which the design says what resists: "friction_angle", "rolling_resistance", ...
[[nodiscard]] std::string friction_key(const Design& design);
/// @return what resists least anywhere on the track, at the highest friction of a range
[[nodiscard]] Friction least_friction(const BodyDesign& body);
/// @return height of the centre of mass above the track [m]
[[nodiscard]] double centre_height(const BodyDesign& body);
/// @return true for what the closed forms of the fastest and the constant-speed track are about
[[nodiscard]] bool is_sliding_point(const BodyDesign& body);

}  // namespace glissade::design_file
