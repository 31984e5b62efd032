// Rules of printing as data, with who says so; and options that no printer can make.

#include "parts/print_checks.hpp"

#include "glissade/core/number_text.hpp"

#include "parts/shop_rule.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace glissade {
namespace parts {
namespace {

constexpr double kNozzle = 0.4e-3;

constexpr ShopRule kBedRule{"largest segment, share of the bed", false, ShopVerdict::fail,
                            "bed of the design"};
constexpr ShopRule kMassRule{"mass of a segment", false, ShopVerdict::fail, "heaviest of the design"};
constexpr ShopRule kOverhangRule{"overhang", false, ShopVerdict::warn,
                                 "printing practice: 45 deg from upright without supports"};
constexpr ShopRule kStepRule{"step of the layers on the run surface", false, ShopVerdict::warn,
                             "half a layer: a pose whose layers follow the track has none"};
constexpr ShopRule kSectionRule{"least thickness of the section", true, ShopVerdict::fail,
                                "two lines of a 0.4 mm nozzle"};
constexpr ShopRule kWallRule{"wall beside a hole", true, ShopVerdict::fail, "two lines of a 0.4 mm nozzle"};
constexpr ShopRule kTightRule{"play of the pins, least", true, ShopVerdict::warn,
                              "printed fits: 0.1 mm very tight, 0.15 mm tight, 0.2 mm loose"};
constexpr ShopRule kLooseRule{"play of the pins, greatest", false, ShopVerdict::warn,
                              "printed fits: 0.3 to 0.5 mm slide"};
constexpr ShopRule kUpRule{"step up at a joint", false, ShopVerdict::warn,
                           "downstream edge never higher: its edge is eased by at least the play"};
constexpr ShopRule kDigitRule{"bars of the numbers", true, ShopVerdict::warn, "one line of a 0.4 mm nozzle"};

std::string as_length(double metres) {
  return length_text(metres, 3);
}
std::string as_angle(double radians) {
  return angle_text(Angle::from_radians(radians), 3);
}
std::string as_share(double share) {
  return rounded_text(100.0 * share, 3) + " %";
}
std::string as_mass(double kilograms) {
  return rounded_text(kilograms, 3) + " kg";
}

std::string where_of(std::size_t index) {
  return "segment " + std::to_string(index + 1);
}

void check_dowels(const PrintJob& job, const std::optional<Dowels>& dowels, std::size_t joints,
                  std::vector<ShopCheck>& checks) {
  if (joints == 0) return;
  if (!dowels) {
    if (job.options.dowels.wanted) {
      checks.push_back({"pins at the joints", ShopVerdict::warn, "none", "two a joint", "all joints",
                        "the section is too thin for pins of 1.5 mm: glue the faces"});
    }
    return;
  }
  const std::string where = "all joints";
  add_check(checks, kWallRule, dowels->wall, job.options.wall, where, as_length);
  add_check(checks, kTightRule, job.options.dowels.fit, 0.1e-3, where, as_length);
  add_check(checks, kLooseRule, job.options.dowels.fit, 0.5e-3, where, as_length);
  add_check(checks, kUpRule, std::max(0.0, job.options.dowels.fit - job.options.ease), 0.0, where, as_length);
}

}  // namespace

std::vector<ShopCheck> print_checks(const PrintJob& job, const std::vector<PrintUnit>& units,
                                    const std::optional<Dowels>& dowels) {
  const PrintOptions& options = job.options;
  const PrintBed& bed = options.split.bed;
  std::vector<ShopCheck> checks;
  ShopCase largest(kBedRule), heaviest(kMassRule), overhang(kOverhangRule), step(kStepRule),
      digits(kDigitRule);
  for (std::size_t i = 0; i < units.size(); ++i) {
    const PrintUnit& unit = units[i];
    const Vec3 size = size_on_bed(unit.pose, unit.mesh.vertices);
    const double taken =
        std::max({size.x / (bed.x - 2.0 * bed.gap), size.y / (bed.y - 2.0 * bed.gap), size.z / bed.z});
    largest.see(taken, 1.0, where_of(i), as_share);
    if (options.split.heaviest) {
      heaviest.see(unit.exact_volume * options.material.density, *options.split.heaviest, where_of(i),
                   as_mass);
    }
    overhang.see(unit.pose.overhang, options.overhang.radians(), where_of(i), as_angle);
    step.see(unit.pose.step, 0.5 * options.layer, where_of(i), as_length);
    if (options.number_depth > 0.0 && units.size() > 1)
      digits.see(kBarWidth * unit.digit_height, kNozzle, where_of(i), as_length);
  }
  for (const ShopCase* one : {&largest, &heaviest, &overhang, &step}) one->add_to(checks);
  add_check(checks, kSectionRule, job.section.narrowest(), options.wall, "cross-section", as_length);
  check_dowels(job, dowels, units.size() - 1, checks);
  digits.add_to(checks);
  return checks;
}

}  // namespace parts

namespace {

/// Collects what is wrong with single options.
class Problems {
 public:
  void positive(const std::string& key, double value, const std::string& text, const std::string& hint) {
    if (value > 0.0) return;
    issues.push_back({key, name_of(key) + ": " + text + " is not positive", "", hint});
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

}  // namespace

std::vector<Issue> print_problems(const CrossSection& section, const PrintOptions& options) {
  Problems problems;
  check_bed(options.split.bed, problems);
  if (options.split.longest)
    problems.positive("split.longest", *options.split.longest, length_text(*options.split.longest), "200 mm");
  if (options.split.heaviest) {
    problems.positive("split.heaviest", *options.split.heaviest,
                      rounded_text(*options.split.heaviest, 4) + " kg", "0.5 kg");
  }
  const DowelOptions& dowels = options.dowels;
  if (dowels.diameter)
    problems.positive("dowels.diameter", *dowels.diameter, length_text(*dowels.diameter), "4 mm");
  if (dowels.depth) problems.positive("dowels.depth", *dowels.depth, length_text(*dowels.depth), "10 mm");
  problems.not_negative("dowels.fit", dowels.fit, "0.15 mm");
  problems.not_negative("dowels.chamfer", dowels.chamfer, "0.5 mm");
  problems.positive("layer", options.layer, length_text(options.layer), "0.2 mm");
  problems.positive("wall", options.wall, length_text(options.wall), "0.9 mm");
  problems.not_negative("number_depth", options.number_depth, "0.4 mm");
  problems.not_negative("ease", options.ease, "0.2 mm");
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
  if (section.varies()) {
    problems.issues.push_back({"cross_section.width",
                               "width: it changes along the track, which prints cannot",
                               "Both faces of a joint must be the same.", "one width"});
  }
  return problems.issues;
}

}  // namespace glissade
