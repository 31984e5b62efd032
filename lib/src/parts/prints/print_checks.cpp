// Options that no printer can make.

#include "glissade/core/number_text.hpp"
#include "glissade/core/quantity.hpp"
#include "glissade/parts/print_options.hpp"

#include "parts/prints/stands.hpp"
#include "parts/prints/tongue.hpp"

#include <algorithm>
#include <string>
#include <utility>

namespace glissade {
namespace {

/// Collects what is wrong with single options.
class Problems {
 public:
  void positive(const std::string& key, double value, const std::string& text, const std::string& hint) {
    if (value > 0.0) return;
    issues.push_back({key, name_of(key) + ": " + text + " is not positive", "", hint});
  }
  /// Nothing, or more than files in single precision hold apart.
  void none_or_printable(const std::string& key, double value, const std::string& hint) {
    not_negative(key, value, hint);
    constexpr double kFinest = 1e-6;  // [m]
    if (!(value > 0.0 && value < kFinest)) return;
    issues.push_back({key,
                      name_of(key) + ": " + length_text(value) + " is finer than " + length_text(kFinest),
                      "No printer makes it.", hint + ", or 0 mm for none"});
  }
  void not_negative(const std::string& key, double value, const std::string& hint) {
    if (value >= 0.0) return;
    issues.push_back({key, name_of(key) + ": " + length_text(value) + " is negative", "", hint});
  }

  std::vector<Issue> issues;

 private:
  static std::string name_of(const std::string& key) { return key.substr(key.rfind('.') + 1); }
};

void check_bed(const PrintBed& bed, Problems& problems) {
  for (const double side : {bed.x, bed.y, bed.z}) {
    problems.positive("split.bed", side, length_text(side), "bed: [220 mm, 220 mm, 250 mm]");
  }
  problems.not_negative("split.gap", bed.gap, "5 mm");
  const double room = std::min(bed.x, bed.y);
  if (bed.gap >= 0.0 && room > 0.0 && 2.0 * bed.gap >= room) {
    problems.issues.push_back(
        {"split.gap", "gap: " + length_text(bed.gap) + " leaves nothing of a bed of " + length_text(room),
         "It is kept free along every edge.", "5 mm"});
  }
}

void check_tongue(const PrintOptions& options, Problems& problems) {
  const TongueOptions& tongue = options.tongue;
  if (tongue.height) problems.positive("tongue.height", *tongue.height, length_text(*tongue.height), "4 mm");
  if (tongue.depth) problems.positive("tongue.depth", *tongue.depth, length_text(*tongue.depth), "3 mm");
  problems.not_negative("tongue.fit", tongue.fit, "0.2 mm");
  problems.none_or_printable("tongue.chamfer", tongue.chamfer, "0.5 mm");
  const double flare = tongue.flare.radians();
  constexpr double kMost = 0.7853981633974483;  // 45 deg
  if (!(flare > 0.0 && flare <= kMost)) {
    problems.issues.push_back(
        {"tongue.flare",
         "flare: " + quantity_beyond(flare, Dimension::angle, {0.0, kMost}) + " is no flank of a dovetail",
         "It leans by more than 0 deg and at most 45 deg.", "10 deg"});
  }
  const bool tongued = options.joint != PrintJoint::dowels;
  if (tongued && options.dowels != DowelOptions{}) {
    problems.issues.push_back({"dowels", "dowels: the joints have tongues",
                               "Pins and tongues are two ways of joining.", "joint: dowels, or no dowels"});
  }
  if (!tongued && tongue != TongueOptions{}) {
    problems.issues.push_back({"tongue", "tongue: the joints have pins",
                               "It says what tongues and dovetails are like.",
                               "joint: tongue, or joint: dovetail"});
  }
}

void check_stands(const StandOptions& stands, Problems& problems) {
  problems.positive("stands.clear", stands.clear, length_text(stands.clear), "10 mm");
  const double low = parts::kLeastStand + stands.fit;
  if (stands.ground.empty() && stands.clear > 0.0 && stands.fit > 0.0 && stands.clear < low) {
    problems.issues.push_back({"stands.clear",
                               "clear: " + length_text(stands.clear) + " leaves stands no room",
                               "They are at least " + length_text(parts::kLeastStand) + " high, and end " +
                                   length_text(stands.fit) + " below the run.",
                               "clear: " + length_text(low) + " or more"});
  }
  problems.positive("stands.spacing", stands.spacing, length_text(stands.spacing), "200 mm");
  problems.positive("stands.thickness", stands.thickness, length_text(stands.thickness), "10 mm");
  problems.positive("stands.cheek", stands.cheek, length_text(stands.cheek), "5 mm");
  problems.positive("stands.fit", stands.fit, length_text(stands.fit), "0.2 mm");
  const double steepest = stands.steepest.radians();
  if (!(steepest > 0.0 && steepest < kRightAngle)) {
    problems.issues.push_back(
        {"stands.steepest",
         "steepest: " + quantity_beyond(steepest, Dimension::angle, {0.0, kRightAngle}) +
             " is no slope that stands hold",
         "It lies between 0 deg and 90 deg.", "60 deg"});
  }
}

}  // namespace

std::vector<Issue> print_problems(const CrossSection& section, const PrintOptions& options) {
  Problems problems;
  check_bed(options.split.bed, problems);
  if (options.split.longest)
    problems.positive("split.longest", *options.split.longest, length_text(*options.split.longest), "200 mm");
  if (options.split.heaviest) {
    problems.positive("split.heaviest", *options.split.heaviest,
                      quantity_text(*options.split.heaviest, Dimension::mass), "0.5 kg");
  }
  const DowelOptions& dowels = options.dowels;
  if (dowels.diameter)
    problems.positive("dowels.diameter", *dowels.diameter, length_text(*dowels.diameter), "4 mm");
  if (dowels.depth) problems.positive("dowels.depth", *dowels.depth, length_text(*dowels.depth), "10 mm");
  problems.not_negative("dowels.fit", dowels.fit, "0.15 mm");
  problems.none_or_printable("dowels.chamfer", dowels.chamfer, "0.5 mm");
  check_tongue(options, problems);
  if (options.stands) check_stands(*options.stands, problems);
  problems.positive("layer", options.layer, length_text(options.layer), "0.2 mm");
  problems.positive("wall", options.wall, length_text(options.wall), "0.9 mm");
  problems.none_or_printable("number_depth", options.number_depth, "0.4 mm");
  problems.none_or_printable("ease", options.ease, "0.2 mm");
  const double overhang = options.overhang.radians();
  if (!(overhang >= 0.0 && overhang <= kRightAngle)) {
    problems.issues.push_back({"overhang",
                               "overhang: " + angle_text(options.overhang) + " is no lean from upright",
                               "It goes from 0 deg to 90 deg.", "45 deg"});
  }
  const double thin = section.narrowest();
  if (options.ease > 0.0 && options.ease >= 0.5 * thin) {
    problems.issues.push_back({"ease",
                               "ease: " + length_text(options.ease) + " is half the section's thickness of " +
                                   length_text(thin) + " or more",
                               "The edge would have no floor left.", "0.2 mm, or 0 mm for none"});
  }
  constexpr double kMostEase = 0.5e-3;  // numbers and mouths of holes keep that far from edges [m]
  if (options.ease > kMostEase && options.ease < 0.5 * thin) {
    problems.issues.push_back(
        {"ease", "ease: " + length_text(options.ease) + " is more than " + length_text(kMostEase),
         "Numbers and holes for pins keep no farther from the edges of a joint face.",
         "0.2 mm, or 0 mm for none"});
  }
  constexpr double kDeepestNumber = 2e-3;  // [m]
  if (options.number_depth > kDeepestNumber) {
    problems.issues.push_back({"number_depth",
                               "number_depth: " + length_text(options.number_depth) + " is more than " +
                                   length_text(kDeepestNumber),
                               "Numbers are read, not cut through: deeper ones would meet holes of pins.",
                               "0.4 mm"});
  }
  for (Issue& issue : parts::tongue_problems(section, options)) problems.issues.push_back(std::move(issue));
  if (section.varies()) {
    problems.issues.push_back({"cross_section.width",
                               "width: it changes along the track, which prints cannot",
                               "Both faces of a joint must be the same.", "one width"});
  }
  return problems.issues;
}

}  // namespace glissade
