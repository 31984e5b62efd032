#include "app/law_text.hpp"

#include "glissade/core/number_text.hpp"
#include "glissade/core/quantity.hpp"
#include "glissade/trades/chute/stream.hpp"

#include "app/console.hpp"
#include "app/stream_text.hpp"
#include "app/summary.hpp"
#include "app/table.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>

namespace glissade::app {
namespace {

std::string angle_and_coefficient(Friction friction) {
  return angle_text(friction.angle()) + " (coefficient " + rounded_text(friction.coefficient(), 4) + ")";
}

/// Names each measure of a kind of body.
class KindWords {
 public:
  explicit KindWords(const BodyDesign& body) : body_(body) {}

  void resistance(const char* key, const char*) { add(key, rounded_text(body_.friction.coefficient(), 4)); }
  void length(const char* key, double value, double, double, const char*, const char*) {
    add(key, length_text(value));
  }
  void angle(const char* key, Angle value, Angle most, const char*, const char*) {
    if (value != most) add(key, angle_text(value));
  }
  void grip(const std::optional<Friction>&, const char*) const {}

  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  void add(std::string key, const std::string& value) {
    std::replace(key.begin(), key.end(), '_', ' ');
    text_ += (text_.empty() ? "" : ", ") + key + " " + value;
  }

  const BodyDesign& body_;
  std::string text_;
};

/// @return ", rolls: rolling resistance 0.01, radius 8 mm"
std::string kind_text(const BodyDesign& body) {
  KindWords words(body);
  visit_measures(body, words);
  return ", " + std::string(std::visit([](const auto& kind) { return kind.kDoes; }, body.kind)) + ": " +
         words.text();
}

/// "Rolling" of a rolling body.
std::string law_label(const BodyDesign& body) {
  if (body.slides()) return "Law";
  std::string word(std::visit([](const auto& kind) { return kind.kKind; }, body.kind));
  word.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(word.front())));
  return word;
}

std::string value_text(const LawQuantity& quantity, double value) {
  if (std::isinf(value)) return "no bound";
  return quantity.unit == "m" ? length_text(value) : rounded_text(value, 4);
}

}  // namespace

std::string resistance_text(const Design& design) {
  const BodyDesign& body = design.body;
  std::string text;
  if (!body.slides()) {
    text = kind_text(body);
  } else if (body.friction_changes.size() > 1) {
    text = ", friction angle";
    for (const FrictionFrom& change : body.friction_changes) {
      text += (change.from == 0.0 ? " " : ", from " + length_text(change.from) + " on ") +
              angle_text(change.friction.angle());
    }
  } else if (body.friction.coefficient() == 0.0) {
    text = ", no friction";
  } else {
    text = ", friction angle " + angle_and_coefficient(body.friction);
  }
  if (design.stream) {
    const StreamDesign& stream = *design.stream;
    text += "\n  stream of " + quantity_text(stream.mass_flow, Dimension::mass_flow) + " at " +
            quantity_text(stream.bulk_density, Dimension::density);
    if (stream.lump_size) text += ", lumps up to " + length_text(*stream.lump_size);
    text += ", lateral pressure ratio " + rounded_text(stream.lateral_pressure_ratio, 3);
  }
  if (body.centre_height) text += ", centre of mass " + length_text(*body.centre_height) + " above the track";
  if (body.head_wind != 0.0) {
    text += std::string(body.head_wind > 0.0 ? ", head wind " : ", tail wind ") +
            speed_text(std::fabs(body.head_wind));
  }
  return text;
}

std::string_view ride_status(const Motion& motion) {
  return to_text(ride_end(motion));
}

std::string law_end_text(const Motion& motion) {
  const LawEnd& end = motion.law_end().value();
  const std::string how = end.what == "valley_radius_m" ? "does not fit into the valley" : "chokes";
  return emphasised(how, Emphasis::bad) + " after " + length_text(end.arc_length) + " at " +
         speed_text(end.speed);
}

std::string law_lines(const Design& design, const Track& track) {
  if (design.stream) return stream_lines(design, track);
  const Motion& motion = track.motion;
  const std::vector<LawQuantity> quantities = motion.quantities();
  std::string lines;
  for (std::size_t i = 0; i < quantities.size(); ++i) {
    const LawQuantity& quantity = quantities[i];
    const QuantityPeak peak = motion.highest(i);
    std::string text = std::string(quantity.name) + " " + value_text(quantity, peak.value) +
                       (std::isinf(peak.value) ? ", " : " at most, ") + length_text(peak.arc_length) +
                       " down the track";
    if (quantity.highest && quantity.verdict) {
      const std::string there = rounded_text(*quantity.highest, 4) + " there is";
      text += peak.beyond_from ? "\n" + emphasised(std::string(quantity.verdict->broken), Emphasis::bad) +
                                     " from " + length_text(*peak.beyond_from) + " on: more than the " + there
                               : "\nless than the " + there + ": " + std::string(quantity.verdict->kept);
    }
    lines += labelled(law_label(design.body), text);
  }
  return lines;
}

}  // namespace glissade::app
