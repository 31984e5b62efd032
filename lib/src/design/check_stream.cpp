#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/quantity.hpp"
#include "glissade/design/stream_channel.hpp"

#include "design/checks.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace glissade {

double StreamChannel::full_area() const {
  return wall_height * (width.widest() + math::tan(wall_angle.radians()) * wall_height);
}

std::optional<StreamChannel> stream_channel(const CrossSectionDesign& section) {
  if (const auto* const channel = std::get_if<section::UChannel>(&section))
    return StreamChannel{channel->width, channel->wall_height};
  if (const auto* const channel = std::get_if<section::Trapezoid>(&section))
    return StreamChannel{channel->width, channel->wall_height, channel->wall_angle};
  const auto* const slab = std::get_if<section::Slab>(&section);
  if (slab == nullptr || !(slab->curb_height > 0.0)) return {};
  return StreamChannel{slab->width, slab->curb_height};
}

namespace design_file {
namespace {

constexpr double kLeastFlow = 1e-9;                  // [kg/s]
constexpr double kGreatestFlow = 1e6;                // [kg/s], 3.6 million t/h
constexpr double kLightest = 1.0;                    // [kg/m^3], lighter than any loose fibre or foam
constexpr double kHeaviestBulk = 3e4;                // [kg/m^3], denser than any solid element
constexpr double kMostOfWidth = (1.0 + 1e-9) / 3.0;  // lumps beyond bridge across the channel

void check_between(double value, double least, double most, const std::string& key, Dimension dimension,
                   const std::string& why, const std::string& hint, Collected& findings) {
  if (value >= least && value <= most) return;
  Issue issue = out_of_range(key, value, dimension, {least, most}, why, hint);
  if (!(value > 0.0)) issue.what = key + ": " + quantity_text(value, dimension) + " is not positive";
  report(findings, {"stream." + key}, std::move(issue));
}

void check_densities(const StreamDesign& stream, Collected& findings) {
  // Of a material that nobody knows there is none, and that has been said.
  if (stream.material && stream.material->density_follows && stream.bulk_density == 0.0) return;
  const double low = stream.low_density.value_or(stream.bulk_density);
  const double high = stream.high_density.value_or(stream.bulk_density);
  for (const double density : {low, stream.bulk_density, high}) {
    if (density >= kLightest && density <= kHeaviestBulk) continue;
    return check_between(density, kLightest, kHeaviestBulk, "bulk_density", Dimension::density,
                         "A bulk solid weighs between 1 and 30000 kg/m^3.",
                         "1600 kg/m^3 of crushed ore, 780 kg/m^3 of wheat", findings);
  }
  if (low <= stream.bulk_density && stream.bulk_density <= high) return;
  report(findings, {"stream.bulk_density"},
         {"", "bulk_density: low, nominal and high are not in ascending order",
          "They are " + quantity_text(low, Dimension::density) + ", " +
              quantity_text(stream.bulk_density, Dimension::density) + " and " +
              quantity_text(high, Dimension::density) + ".",
          ""});
}

void check_numbers(const StreamDesign& stream, Collected& findings) {
  check_between(stream.mass_flow, kLeastFlow, kGreatestFlow, "mass_flow", Dimension::mass_flow,
                "A stream carries something, at most 3600000 t/h (1e6 kg/s).", "650 t/h", findings);
  const auto number = [&](double value, double least, double most, bool above_least, const char* key,
                          const char* why, const char* hint) {
    if (value <= most && (above_least ? value > least : value >= least)) return;
    report(findings, {std::string("stream.") + key},
           out_of_range(key, value, Dimension::number, {least, most}, why, hint));
  };
  number(stream.lateral_pressure_ratio, 0.0, 10.0, false, "lateral_pressure_ratio",
         "Pressure on the side walls over that from above: 0 to 10.", "0.4 to 0.6 of most streams");
  number(stream.slip_ratio, 0.0, 1.0, true, "slip_ratio",
         "Speed at the floor over the mean speed: above 0, at most 1.",
         "0.6 of a fast thin stream, 0.2 of a deep slow one");
  number(stream.surge, 1.0, 100.0, false, "surge", "The greatest flow over mass_flow: 1 to 100.", "1.5");
  number(stream.trickle, 0.0, 1.0, true, "trickle", "The least flow over mass_flow: above 0, at most 1.",
         "0.1");
}

void check_plate(const LinerPlateDesign& plate, Collected& findings) {
  constexpr double kThickest = 1.0;
  constexpr double kHardest = 1e12;
  check_between(plate.thickness, 1e-6, kThickest, "liner_plate.thickness", Dimension::length,
                "A liner is at most 1 m thick.", "12 mm", findings);
  check_between(plate.hardness, 1.0, kHardest, "liner_plate.hardness", Dimension::pressure,
                "It is positive, and at most 1e12 Pa.", "4 GPa, of 400 HB", findings);
  check_between(plate.wear_coefficient, 1e-12, 1.0, "liner_plate.wear_coefficient", Dimension::number,
                "Archard's coefficient: above 0, at most 1.", "2e-4", findings);
}

/// What a stream asks of the body beside it.
void check_its_body(const Design& design, Collected& findings) {
  if (!design.body.slides()) {
    report(findings, {"stream", "body.kind"},
           {"", "stream: of a body that rolls", "A stream slides on the floor and the walls.",
            "body: {friction_angle: 27 deg, entry_speed: 2 m/s}"});
  }
  if (design.body.centre_height) {
    report(findings, {"body.centre_height", "stream"},
           {"", "centre_height: of a stream", "A stream moves as one thin layer on the floor.",
            "no centre_height"});
  }
  if (design.body.entry_speed > 0.0 || design.feed) return;
  report(findings, {"body.entry_speed"},
         {"", "entry_speed: a stream needs one, above 0",
          "At rest it would be infinitely deep: its depth is flow / (density x width x speed).",
          "entry_speed: 2 m/s, the speed along the track at which it comes in, or a feed"});
}

/// How deep a stream comes in no track changes.
void check_its_entry(const Design& design, const StreamChannel& channel, Collected& findings) {
  const StreamDesign& stream = *design.stream;
  const double speed = design.body.entry_speed;
  if (!(speed > 0.0)) return;
  const double depth = stream.mass_flow / (stream.bulk_density * channel.width.at(0.0) * speed);
  const double deepest = std::min(channel.width.at(0.0), channel.wall_height);
  const char* const why = "Its depth is flow / (density x width x speed).";
  const std::string enters = "at " + quantity_text(speed, Dimension::speed) + " the stream enters ";
  if (depth >= deepest) {
    const bool wall = channel.wall_height < channel.width.at(0.0);
    report(findings, {"body.entry_speed", "stream", "cross_section"},
           {"",
            "entry_speed: " + enters + length_text(depth) + " deep, " +
                (wall ? "over its wall of " : "more than its width of ") + length_text(deepest),
            why,
            "an entry_speed of at least " + quantity_text(2.0 * speed * depth / deepest, Dimension::speed) +
                ", which fills half of that, or a wider channel"});
    return;
  }
  if (!design.limits || !design.limits->highest_burden_depth) return;
  const double most = *design.limits->highest_burden_depth;
  if (!(depth > most) || !(most > 0.0)) return;
  const auto [asked, there] = texts_apart(most, depth, &length_text);
  report(findings, {"limits.highest_burden_depth", "body.entry_speed", "stream"},
         {"", "highest_burden_depth: " + asked + ", but " + enters + there + " deep", why,
          "an entry_speed of at least " + quantity_text(1.1 * speed * depth / most, Dimension::speed) +
              ", a wider channel, or a greater depth"});
}

void check_its_channel(const Design& design, Collected& findings) {
  const StreamDesign& stream = *design.stream;
  if (!design.cross_section) {
    report(findings, {"stream"},
           {"", "stream: without a cross_section",
            "Its depth follows from the width of the channel, its walls rub too.",
            "cross_section: {kind: u-channel, width: 800 mm, wall_height: 600 mm, thickness: 10 mm}"});
    return;
  }
  const auto channel = stream_channel(*design.cross_section);
  if (!channel) {
    report(findings, {"cross_section.kind", "stream"},
           {"", "stream: in a cross-section of kind " + std::string(section::kind(*design.cross_section)),
            "Roberts' law is that of a flat floor between two walls.",
            "kind: u-channel, trapezoid (its floor counts), or slab with curbs"});
    return;
  }
  if (stream.lump_size) {
    const double narrowest = channel->width.narrowest();
    const double most = kMostOfWidth * narrowest;
    const double lump = *stream.lump_size;
    if (!(lump > 0.0)) {
      report(findings, {"stream.lump_size"},
             {"", "lump_size: " + length_text(lump) + " is not positive", "The size of the largest lump.",
              "150 mm"});
    } else if (lump > most) {
      report(findings, {"stream.lump_size", "cross_section.width"},
             {"",
              "lump_size: " + length_text(lump) + " is more than a third of the width, " +
                  length_text(narrowest),
              "Three such lumps lock across the channel.",
              "a width of at least " + length_text(lump / kMostOfWidth) + ", or smaller lumps"});
    }
  }
  check_its_entry(design, *channel, findings);
}

}  // namespace

void check_stream(const Design& design, Collected& findings) {
  if (!design.stream) return;
  check_numbers(*design.stream, findings);
  if (design.stream->liner_plate) check_plate(*design.stream->liner_plate, findings);
  check_densities(*design.stream, findings);
  check_its_body(design, findings);
  check_its_channel(design, findings);
}

}  // namespace design_file
}  // namespace glissade
