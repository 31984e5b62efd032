#include "pipeline/task/cross_section.hpp"

#include "glissade/core/file_format.hpp"
#include "glissade/core/number_text.hpp"

#include <algorithm>
#include <string>
#include <vector>

namespace glissade {

namespace pipeline {

namespace {

/// Each measure after its key in plain words.
class MeasureWords {
 public:
  explicit MeasureWords(std::string& text) : text_(text) {}

  void width(const std::string& key, const WidthLaw& law, const char*) {
    std::string widths;
    for (const WidthAt& knot : law.knots()) {
      widths += (widths.empty() ? "" : ", ") + length_text(knot.width);
      if (law.knots().size() > 1) widths += " at " + length_text(knot.at);
    }
    add(key, widths);
  }
  void length(const std::string& key, double value, const char*) { add(key, length_text(value)); }
  void optional_length(const std::string& key, double value) {
    if (value > 0.0) add(key, length_text(value));
  }
  void angle(const std::string& key, Angle value, const char*) { add(key, angle_text(value)); }
  void corners(const std::string&, const std::vector<Vec2>&, const char*) const {}
  void misnomer(const char*, const char*) const {}

 private:
  void add(std::string key, const std::string& value) {
    std::replace(key.begin(), key.end(), '_', ' ');
    text_ += ", " + key + " " + value;
  }

  std::string& text_;
};

}  // namespace

std::string section_in_words(const CrossSectionDesign& section) {
  std::string text(section::kind(section));
  section::visit_measures(section, MeasureWords(text));
  return text;
}

bool tells_of_track_alone(const Design& design) {
  const std::vector<ExportFormat>& formats = design.exports.formats;
  return !design.cross_section && !design.fabrication && !formats.empty() &&
         std::all_of(formats.begin(), formats.end(), [](ExportFormat format) {
           return file_format(format).content == FileContent::stations;
         });
}

void require_cross_section(const Design& design) {
  if (design.cross_section || tells_of_track_alone(design)) return;
  throw InputError(
      {design.where("cross_section"), "there is no cross_section to make a solid of",
       "A build sweeps a cross-section along the centerline.",
       "cross_section: {kind: u-channel, width: 400 mm, wall_height: 250 mm, thickness: 4 mm}, or "
       "export: [csv], which tells of the track alone"});
}

}  // namespace pipeline

}  // namespace glissade
