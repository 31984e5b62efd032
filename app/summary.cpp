#include "app/summary.hpp"

#include "glissade/centerline/constant_speed_curve.hpp"
#include "glissade/centerline/fitted_profile.hpp"
#include "glissade/centerline/in_run.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/units.hpp"
#include "glissade/design/stream_channel.hpp"
#include "glissade/pipeline/rules.hpp"

#include "app/console.hpp"
#include "app/gates_text.hpp"
#include "app/law_text.hpp"
#include "app/limits_text.hpp"
#include "app/parts_text.hpp"
#include "app/probes_text.hpp"
#include "app/rides_text.hpp"
#include "app/rules_text.hpp"
#include "app/table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>

namespace glissade::app {
namespace {

std::string profile_text(const FittedProfile& profile) {
  // Less than this share of the length changes no figure that is shown.
  constexpr double kNothing = 1e-5;
  const double between = profile.between_points();
  const std::string open = between > kNothing * profile.length()
                               ? "\nbetween them it may be off by some " + length_text(between, 1)
                               : std::string();
  return "points (a curve fitted to " + count_text(profile.points().size()) +
         " of them)\nit passes them by " + length_text(profile.max_deviation(), 3) + " at most (point " +
         count_text(profile.farthest_point() + 1) + "), " + length_text(profile.rms_deviation(), 3) +
         " in the root of the mean square" + open;
}

/// Depth is flow over width and speed: only in one width it is as even as the speed.
bool runs_in_one_width(const Design& design) {
  const auto channel = design.cross_section ? stream_channel(*design.cross_section) : std::nullopt;
  return channel && channel->width.is_constant();
}

/// Who keeps the speed of the curve, where anybody does.
std::string kept_speed_line(const Design& design, const ConstantSpeedCurve& curve, Body body) {
  const bool drag = body.drag_per_metre > 0.0;
  body.drag_per_metre = 0.0;
  const std::optional<double> kept = kept_speed(curve, body);
  if (!kept) return "";
  const std::string speed = speed_text(*kept);
  if (drag) return "\nwithout drag a body fed at " + speed + " would keep that speed";
  const std::string time = ", for " + time_text(curve.travel_time_at_constant_speed());
  // A range is of frictions that the curve was not made for.
  const bool several = design.body.low_friction || design.body.high_friction;
  const std::string nominal = several ? " at the nominal friction" : "";
  if (!design.stream) return "\na body fed at " + speed + nominal + " keeps that speed" + time;
  return "\nat an entry speed of " + speed + nominal + " the stream keeps its speed" +
         (runs_in_one_width(design) ? " and its depth" : "") + time;
}

std::string kind_text(const Design& design, const Track& track) {
  const Centerline& centerline = *track.centerline;
  if (const auto* const profile = dynamic_cast<const FittedProfile*>(&centerline))
    return profile_text(*profile);
  if (track.search && design.objective.kind == ObjectiveKind::least_wear)
    return "least wear within the limits: least work of rubbing on floor and walls";
  if (track.search && design.objective.kind == ObjectiveKind::least_peak_wear)
    return "least peak wear within the limits: the floor wears least where it wears most";
  if (track.search && design.objective.kind == ObjectiveKind::even_speed)
    return std::string("most even speed within the limits") +
           (runs_in_one_width(design) ? ", and with it the most even burden depth" : "");
  if (track.search) return searched_name(design);
  if (centerline.kind() == "fastest") return "fastest (the brachistochrone under Coulomb friction)";
  if (const auto* const curve = dynamic_cast<const ConstantSpeedCurve*>(&centerline)) {
    return "constant-speed (Pudasaini's curve, P " + rounded_text(curve->p(), 6) + " m^2/s^2)" +
           kept_speed_line(design, *curve, track.motion.body());
  }
  if (const auto* const in_run = dynamic_cast<const InRun*>(&centerline)) return in_run_text(*in_run);
  if (centerline.kind() == "no-curvature-load") return "no-curvature-load (for comparison only)";
  return std::string(centerline.kind());
}

/// "12 % less than the straight line's 2.91 s"
std::string against(double time, double other, const std::string& whose) {
  const double change = 100.0 * (time / other - 1.0);
  const std::string amount = rounded_text(std::fabs(change), 3) + " %";
  constexpr double kSame = 1e-6;  // percent
  if (std::fabs(change) < kSame) return "the same as " + whose + " " + time_text(other);
  return amount + (change < 0.0 ? " less" : " more") + " than " + whose + " " + time_text(other);
}

std::string comparison_lines(const Design& design, const Track& track) {
  const bool fastest = track.centerline->kind() == "fastest";
  const double time = track.motion.travel_time();
  std::string text;
  const auto add = [&](const std::string& line) { text += "\n" + line; };
  if (track.optimum_travel_time) {
    if (fastest) {
      add("the least that is possible between these points");
    } else {
      add(against(time, *track.optimum_travel_time,
                  track.limit_checks.empty() ? "the least possible," : "the least possible without limits,"));
    }
  }
  if (const auto& fastest_within = track.fastest_within) {
    const MotionState end = track.motion.at(track.motion.distance());
    std::string line =
        rounded_text(time - fastest_within->travel_time, 3) + " s more than the fastest within these limits";
    // Where nothing rubs there is nothing to have a share of.
    if (fastest_within->friction_loss > 0.0) {
      const double less = 100.0 * (1.0 - end.friction_loss / fastest_within->friction_loss);
      line += "; it rubs " + rounded_text(std::fabs(less), 3) + " % " + (less < 0.0 ? "more" : "less");
    }
    const double worn = fastest_within->floor_wear.value_or(0.0);
    if (worn > 0.0 && design.objective.kind == ObjectiveKind::least_peak_wear) {
      const double peak = wear_at_frictions(track).facts.floor.value;
      line += ",\nand its floor wears " + rounded_text(100.0 * (1.0 - peak / worn), 3) +
              " % less where it wears most";
    }
    add(line);
  }
  if (track.centerline->kind() == "straight") return text;
  add(track.straight ? against(time, track.straight->travel_time(), "the straight line's")
                     : "on the straight line the body would not arrive");
  return text;
}

std::string ride_lines(const Design& design, const Track& track) {
  const Motion& motion = track.motion;
  if (!enters(motion)) {
    return labelled("Ride", "none: the feed " + emphasised(std::string(ride_status(motion)), Emphasis::bad));
  }
  if (motion.arrived()) {
    return labelled("Travel time", time_text(motion.travel_time()) + comparison_lines(design, track)) +
           labelled("Exit speed", speed_text(motion.exit_speed()));
  }
  if (motion.stall()) {
    return labelled("Ride", emphasised("stalls", Emphasis::bad) + " after " +
                                length_text(motion.stall()->arc_length) + " of " +
                                length_text(track.centerline->length()));
  }
  if (motion.law_end()) return labelled("Ride", law_end_text(motion));
  return labelled("Ride", emphasised("leaves the track", Emphasis::bad) + " after " +
                              length_text(motion.lift_off()->arc_length) + " at " +
                              speed_text(motion.lift_off()->speed));
}

std::string slope_text(const Track& track) {
  const Centerline& centerline = *track.centerline;
  return angle_text(Angle::from_radians(centerline.slope_angle(0.0))) + " at the start, " +
         angle_text(Angle::from_radians(centerline.slope_angle(centerline.length()))) + " at the finish";
}

/// The cosine of a right angle is not quite 0 in a computer.
double without_rounding(double load) {
  constexpr double kNothing = 1e-12;
  return std::fabs(load) < kNothing ? 0.0 : load;
}

std::string load_lines(const Motion& motion) {
  if (!enters(motion)) return "";
  const MotionState highest = motion.highest_load();
  const std::string most =
      std::isinf(highest.normal_load) ? "unbounded, " : load_text(highest.normal_load) + " at most, ";
  return labelled("Normal load", most + length_text(highest.arc_length) + " down the track\n" +
                                     load_text(motion.lowest_load().normal_load) + " at least");
}

std::string radius_text(const Track& track) {
  if (std::isinf(track.min_radius)) return "none: the track is straight";
  if (track.min_radius == 0.0) return "0: the track starts vertical, its curvature grows without bound there";
  const auto* const profile = dynamic_cast<const FittedProfile*>(track.centerline.get());
  constexpr double kOpen = 1.01;
  const bool open = profile != nullptr && profile->largest_curvature() &&
                    profile->largest_curvature()->greatest > kOpen * profile->largest_curvature()->least;
  if (!open) return length_text(track.min_radius);
  return length_text(track.min_radius) + "; " + radius_range_text(*profile->largest_curvature()) +
         " describe the points about as well";
}

std::string solid_lines(const Design& design, const Build& build) {
  const MeshFacts& facts = build.swept().facts;
  std::string text =
      count_text(facts.triangles) + " triangles, volume " + volume_text(build.swept().solid.exact_volume, 4) +
      ", " + length_text(facts.upper.x - facts.lower.x) + " x " + length_text(facts.upper.y - facts.lower.y) +
      " x " + length_text(facts.upper.z - facts.lower.z);
  text += "\ndeparts from the exact shape by " + length_text(build.swept().max_deviation, 2) +
          " at most (tolerance " + length_text(design.mesh.tolerance, 3) + ")";
  if (build.swept().offset) {
    text += "\nin the files' own frame: their origin is the start of the track, at (" +
            decimal_text(build.swept().offset->x) + ", " + decimal_text(build.swept().offset->y) + ", " +
            decimal_text(build.swept().offset->z) + ") m of the site";
  }
  if (build.swept().solid.trimmed) text += "\ntrimmed where the section would have folded over itself";
  return text;
}

/// Files of one folder and ending as one line where they are many.
std::string removed_lines(const std::vector<std::filesystem::path>& removed) {
  constexpr std::size_t kMany = 4;
  std::map<std::pair<std::string, std::string>, std::vector<std::string>> kinds;
  for (const std::filesystem::path& file : removed)
    kinds[{file.parent_path().string(), file.extension().string()}].push_back(file.string());
  std::string text;
  for (const auto& [kind, files] : kinds) {
    if (files.size() >= kMany) {
      text += (kind.first.empty() ? "" : kind.first + "/  ") + std::to_string(files.size()) + " " +
              kind.second + " files removed: an earlier build wrote them, this one does not\n";
      continue;
    }
    for (const std::string& file : files)
      text += file + "  removed: an earlier build wrote it, this one does not\n";
  }
  return text;
}

/// What a build did to files that were there before it; empty if nothing.
std::string earlier_file_lines(const Build& build) {
  std::string text = removed_lines(build.removed);
  for (const std::filesystem::path& file : build.set_aside) {
    text += file.string() + "  set aside: it was in the way and not as a build of this design wrote it\n";
  }
  if (text.empty()) return "";
  text.pop_back();
  return labelled("Before", text);
}

/// Files of one ending in one folder below that of the build.
struct FileGroup {
  std::filesystem::path folder;
  std::string ending;
  std::size_t count = 0;
  double bytes = 0.0;
};

/// One line a file of the build; folders of parts and nests, which may hold hundreds, one line an ending.
std::string file_lines(const std::vector<WrittenFile>& files) {
  std::vector<std::string> lines;
  std::vector<FileGroup> groups;
  for (const WrittenFile& file : files) {
    const std::filesystem::path folder = file.path.parent_path();
    const auto bytes = static_cast<double>(file.bytes);
    if (folder == files.front().path.parent_path()) {
      lines.push_back(file.path.string() + "  " + size_text(bytes));
      continue;
    }
    const std::string ending = file.path.extension().string();
    const auto known = std::find_if(groups.begin(), groups.end(), [&](const FileGroup& group) {
      return group.folder == folder && group.ending == ending;
    });
    FileGroup& group = known != groups.end() ? *known : groups.emplace_back(FileGroup{folder, ending});
    ++group.count;
    group.bytes += bytes;
  }
  for (const FileGroup& group : groups) {
    const std::string what = group.count == 1 ? " file" : " files";
    lines.push_back((group.folder / "").string() + "  " + std::to_string(group.count) + " " + group.ending +
                    what + ", " + size_text(group.bytes));
  }
  std::string text;
  for (const std::string& line : lines) text += (text.empty() ? "" : "\n") + line;
  return text;
}

}  // namespace

std::string time_text(double seconds) {
  return rounded_text(seconds, 5) + " s";
}

std::string speed_text(double metres_per_second) {
  return rounded_text(metres_per_second, 4) + " m/s";
}

std::string acceleration_text(double metres_per_second_squared) {
  if (std::isinf(metres_per_second_squared)) return "unbounded";
  return rounded_text(without_rounding(metres_per_second_squared), 4) + " m/s^2";
}

std::string load_text(double metres_per_second_squared) {
  std::string text = acceleration_text(metres_per_second_squared);
  if (std::isinf(metres_per_second_squared)) return text;
  return text + " (" + rounded_text(without_rounding(metres_per_second_squared) / kStandardGravity, 3) +
         " g)";
}

std::string volume_text(double cubic_metres, int digits) {
  const double size = std::fabs(cubic_metres);
  if (size >= 1.0) return rounded_text(cubic_metres, digits) + " m^3";
  if (size >= 1e-4 || size == 0.0) return rounded_text(cubic_metres * 1e3, digits) + " litres";
  if (size >= 1e-7) return rounded_text(cubic_metres * 1e6, digits) + " cm^3";
  return rounded_text(cubic_metres * 1e9, digits) + " mm^3";
}

std::string count_text(std::size_t count) {
  const std::string digits = std::to_string(count);
  std::string text;
  for (std::size_t index = 0; index < digits.size(); ++index) {
    if (index != 0 && (digits.size() - index) % 3 == 0) text += ' ';
    text += digits[index];
  }
  return text;
}

std::string span_line(const Design& design, const Endpoints& endpoints) {
  const BodyDesign& body = design.body;
  std::string text = "run " + length_text(endpoints.run) + ", drop " + length_text(endpoints.drop);
  text += design.feed               ? ", fed from above"
          : body.entry_speed == 0.0 ? ", from rest"
                                    : ", entry speed " + speed_text(body.entry_speed);
  if (body.drag_per_metre != 0.0) text += ", drag " + rounded_text(body.drag_per_metre, 4) + " 1/m";
  if (design.gravity != kDefaultGravity) text += ", gravity " + rounded_text(design.gravity, 6) + " m/s^2";
  return text;
}

std::string task_line(const Design& design, const Endpoints& endpoints) {
  return span_line(design, endpoints) + resistance_text(design);
}

std::string track_summary(const Design& design, const Track& track) {
  const std::string heading = design.name.empty() ? std::string("Track") : design.name;
  return emphasised(heading, Emphasis::heading) + "\n  " + task_line(design, track.endpoints) + "\n\n" +
         labelled("Centerline", kind_text(design, track)) + ride_lines(design, track) +
         labelled("Slope angle", slope_text(track)) +
         labelled("Arc length", length_text(track.centerline->length())) + load_lines(track.motion) +
         law_lines(design, track) + labelled("Smallest radius", radius_text(track)) + friction_lines(track) +
         limits_lines(design, track) + probes_lines(design, track) + gates_lines(track) +
         rules_lines(judge_rules(design, track));
}

std::string build_summary(const Design& design, const Build& build) {
  const std::string verdict = emphasised("proven", Emphasis::good) +
                              ": watertight, one piece, facing outward, no self-intersection,\n"
                              "no degenerate facet; measured at the precision of each file, each read back";
  return track_summary(design, build.track) + "\n" +
         (build.has_solid() ? labelled("Solid", solid_lines(design, build)) + labelled("Mesh", verdict) + "\n"
                            : std::string()) +
         (build.fabrication ? parts_lines(*build.fabrication, design.exports.paper) + "\n" : "") +
         labelled("Files", file_lines(build.files)) + earlier_file_lines(build);
}

}  // namespace glissade::app
