#include "glissade/core/number_text.hpp"
#include "glissade/core/quantity.hpp"

#include "core/outline.hpp"
#include "design/checks.hpp"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace glissade::design_file {
namespace {

constexpr double kLargestMeasure = 1e4;    // [m]
constexpr double kSmallestMeasure = 1e-6;  // [m]

/// Holds every measure against what any measure may be, and lists its key.
class MeasureCheck {
 public:
  explicit MeasureCheck(Collected& findings) : findings_(findings) {}

  void width(const std::string& key, const WidthLaw& law, const char* example) {
    note(key);
    for (const WidthAt& knot : law.knots()) {
      check(key, knot.width, example);
      check_place(key, knot.at);
    }
    // Of one width everywhere the law has no place; what was written has one.
    if (law.knots().size() == 1) check_place(key, law.last_place());
  }
  void length(const std::string& key, double value, const char* example) {
    note(key);
    check(key, value, example);
  }
  void optional_length(const std::string& key, double value) {
    note(key);
    if (value != 0.0) check(key, value, "");
  }
  void angle(const std::string& key, Angle, const char*) { note(key); }
  void corners(const std::string& key, const std::vector<Vec2>& corners, const char*) {
    note(key);
    if (auto fault = core::outline_fault(corners, key)) add(key, *std::move(fault));
  }
  void misnomer(const char*, const char*) const {}

  [[nodiscard]] bool found_nothing() const { return sound_; }
  /// @return the key path of the measure that the text begins with, and after it those of all measures
  [[nodiscard]] std::vector<std::string> paths(const std::string& text) const {
    std::vector<std::string> all{"cross_section." + text.substr(0, text.find_first_of(": "))};
    all.insert(all.end(), paths_.begin(), paths_.end());
    return all;
  }

 private:
  void note(const std::string& key) { paths_.push_back("cross_section." + key); }
  void add(const std::string& key, Issue issue) {
    sound_ = false;
    report(findings_, {"cross_section." + key}, std::move(issue));
  }
  void check(const std::string& key, double value, const char* example) {
    if (value >= kSmallestMeasure && value <= kLargestMeasure) return;
    Issue issue = out_of_range(key, value, Dimension::length, {kSmallestMeasure, kLargestMeasure},
                               "It lies between 0.001 mm and 10 km.", example);
    if (!(value > 0.0)) issue.what = key + ": " + length_text(value) + " is not positive";
    add(key, std::move(issue));
  }
  void check_place(const std::string& key, double at) {
    if (at >= 0.0 && at <= kLongestTrack) return;
    const std::string place = quantity_beyond(at, Dimension::length, {0.0, kLongestTrack});
    add(key, {"", key + ": the place at " + place + " is out of range",
              "It is an arc length along the track, from 0 m to 1000 km.", "at: 2 m"});
  }

  Collected& findings_;
  std::vector<std::string> paths_;
  bool sound_ = true;
};

std::optional<CrossSection> checked_section(const CrossSectionDesign& design, Collected& findings) {
  MeasureCheck check(findings);
  section::visit_measures(design, check);
  if (!check.found_nothing()) return {};
  // What measures ask of each other is said where the outline is made of them.
  try {
    return CrossSection(design);
  } catch (const InputError& error) {
    for (const Issue& issue : error.issues()) report(findings, check.paths(issue.what), issue);
  }
  return {};
}

}  // namespace

void check_cross_section(const Design& design, Collected& findings) {
  if (design.cross_section) static_cast<void>(checked_section(*design.cross_section, findings));
}

std::optional<CrossSection> sound_cross_section(const Design& design) {
  Collected findings;
  return design.cross_section ? checked_section(*design.cross_section, findings) : std::nullopt;
}

}  // namespace glissade::design_file
