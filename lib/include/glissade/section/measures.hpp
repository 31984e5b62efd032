#pragma once

#include "glissade/core/units.hpp"
#include "glissade/core/vec.hpp"
#include "glissade/core/width_law.hpp"

#include <optional>
#include <string_view>
#include <variant>
#include <vector>

namespace glissade::section {

/// What each kind of cross-section is given by: inside measures, lengths in metres.
///
/// A kind names itself and its measures once: `visit` shows each to a visitor under its key in a design file,
/// with an example of its value, in the order in which people read them. The reader, the checks and the words
/// of a report are such visitors:
///
///     visitor.width(key, law, example);           // above 0; may change along the track
///     visitor.length(key, value, example);        // above 0
///     visitor.optional_length(key, value);        // 0: there is none
///     visitor.angle(key, value, example);
///     visitor.corners(key, values, example);
///     visitor.misnomer(key, right);               // no measure: what people may look for, and its name here
///
/// `kTop` names what stands highest, for messages. The bounds that measures set each other are those of CrossSection.

/// A flat ramp: a plate under the floor, optionally with a curb along each side, which stands outside `width`.
struct Slab {
  static constexpr std::string_view kKind = "slab";
  static constexpr std::string_view kTop = "top of the curbs";
  WidthLaw width;
  double thickness = 0.0;
  double curb_height = 0.0;  ///< both 0: none
  double curb_width = 0.0;

  static void visit(auto& self, auto&& visitor) {
    visitor.width("width", self.width, "400 mm");
    visitor.optional_length("curb_height", self.curb_height);
    visitor.optional_length("curb_width", self.curb_width);
    visitor.length("thickness", self.thickness, "4 mm");
  }

  friend bool operator==(const Slab&, const Slab&) = default;
};

/// A flat floor with upright walls.
struct UChannel {
  static constexpr std::string_view kKind = "u-channel";
  static constexpr std::string_view kTop = "wall rim";
  WidthLaw width;
  double wall_height = 0.0;
  double thickness = 0.0;

  static void visit(auto& self, auto&& visitor) {
    visitor.width("width", self.width, "400 mm");
    visitor.length("wall_height", self.wall_height, "250 mm");
    visitor.length("thickness", self.thickness, "4 mm");
  }

  friend bool operator==(const UChannel&, const UChannel&) = default;
};

/// A flat floor with walls that lean outward.
struct Trapezoid {
  static constexpr std::string_view kKind = "trapezoid";
  static constexpr std::string_view kTop = "wall rim";
  WidthLaw width;  ///< of the floor
  double wall_height = 0.0;
  Angle wall_angle;  ///< from upright
  double thickness = 0.0;

  static void visit(auto& self, auto&& visitor) {
    visitor.width("width", self.width, "400 mm");
    visitor.length("wall_height", self.wall_height, "250 mm");
    visitor.angle("wall_angle", self.wall_angle, "20 deg");
    visitor.length("thickness", self.thickness, "4 mm");
  }

  friend bool operator==(const Trapezoid&, const Trapezoid&) = default;
};

/// Half a round trough, whose sides may go on straight up.
struct HalfPipe {
  static constexpr std::string_view kKind = "half-pipe";
  static constexpr std::string_view kTop = "wall rim";
  double width = 0.0;  ///< inside diameter
  double wall_height = 0.0;
  double thickness = 0.0;

  static void visit(auto& self, auto&& visitor) {
    visitor.length("width", self.width, "400 mm");
    visitor.optional_length("wall_height", self.wall_height);
    visitor.length("thickness", self.thickness, "4 mm");
  }

  friend bool operator==(const HalfPipe&, const HalfPipe&) = default;
};

/// A closed pipe; the centerline is the lowest line of its bore.
struct Pipe {
  static constexpr std::string_view kKind = "pipe";
  static constexpr std::string_view kTop = "top of the pipe";
  double inner_diameter = 0.0;
  double thickness = 0.0;

  static void visit(auto& self, auto&& visitor) {
    visitor.misnomer("width", "inner_diameter");
    visitor.length("inner_diameter", self.inner_diameter, "150 mm");
    visitor.length("thickness", self.thickness, "4 mm");
  }

  friend bool operator==(const Pipe&, const Pipe&) = default;
};

/// Two flat walls that meet in a round bottom.
struct VChannel {
  static constexpr std::string_view kKind = "v-channel";
  static constexpr std::string_view kTop = "wall rim";
  Angle angle;                 ///< between the walls
  double bottom_radius = 0.0;  ///< inside
  double wall_height = 0.0;    ///< of the wall tops above the lowest line
  double thickness = 0.0;

  static void visit(auto& self, auto&& visitor) {
    visitor.misnomer("width", "angle and wall_height, which make the width");
    visitor.angle("angle", self.angle, "90 deg");
    visitor.length("bottom_radius", self.bottom_radius, "20 mm");
    visitor.length("wall_height", self.wall_height, "250 mm");
    visitor.length("thickness", self.thickness, "4 mm");
  }

  friend bool operator==(const VChannel&, const VChannel&) = default;
};

/// The two grooves of a ski-jump in-run in a slab: skis run on the bottoms of the grooves, which are the floor.
struct TrackGroove {
  static constexpr std::string_view kKind = "track-groove";
  static constexpr std::string_view kTop = "top beside the grooves";
  WidthLaw width;               ///< of the whole
  double groove_width = 0.0;    ///< of each groove
  double groove_depth = 0.0;    ///< of their bottoms below the top
  double groove_spacing = 0.0;  ///< between their middles
  double thickness = 0.0;       ///< under their bottoms

  static void visit(auto& self, auto&& visitor) {
    visitor.width("width", self.width, "600 mm");
    visitor.length("groove_width", self.groove_width, "135 mm");
    visitor.length("groove_depth", self.groove_depth, "30 mm");
    visitor.length("groove_spacing", self.groove_spacing, "320 mm");
    visitor.length("thickness", self.thickness, "50 mm");
  }

  friend bool operator==(const TrackGroove&, const TrackGroove&) = default;
};

/// Any simple outline that passes through the origin with the floor's surface.
struct Polygon {
  static constexpr std::string_view kKind = "polygon";
  static constexpr std::string_view kTop = "top of the section";
  std::vector<Vec2> outline;  ///< (across, height), closed by itself

  static void visit(auto& self, auto&& visitor) {
    visitor.corners("outline", self.outline,
                    "[[-200 mm, 0 mm], [-200 mm, -5 mm], [200 mm, -5 mm], [200 mm, 0 mm], [0 mm, 0 mm]]");
  }

  friend bool operator==(const Polygon&, const Polygon&) = default;
};

/// A cross-section by its measures. A kind that is added here is read, checked and named.
using Measures = std::variant<Slab, UChannel, Trapezoid, HalfPipe, Pipe, VChannel, TrackGroove, Polygon>;

/// @return the word that a design file uses, e.g. "u-channel"
[[nodiscard]] inline std::string_view kind(const Measures& measures) {
  return std::visit([](const auto& measure) { return measure.kKind; }, measures);
}

/// @return what stands highest of the section, e.g. "wall rim"
[[nodiscard]] inline std::string_view top(const Measures& measures) {
  return std::visit([](const auto& measure) { return measure.kTop; }, measures);
}

/// What a visitor does with measures that are none of its business: one derives from it and hides the others.
struct PassingVisitor {
  void width(const char*, const WidthLaw&, const char*) const {}
  void length(const char*, double, const char*) const {}
  void optional_length(const char*, double) const {}
  void angle(const char*, Angle, const char*) const {}
  void corners(const char*, const std::vector<Vec2>&, const char*) const {}
  void misnomer(const char*, const char*) const {}
};

/// @return the law of a width that may change along the track; none for kinds without one
[[nodiscard]] std::optional<WidthLaw> width_law(const Measures& measures);
/// @return the same measures at one width everywhere; as they are where the kind has none that may change
[[nodiscard]] Measures with_width(Measures measures, double width);

/// Shows every measure to a visitor.
void visit_measures(auto& measures, auto&& visitor) {
  std::visit([&](auto& measure) { measure.visit(measure, visitor); }, measures);
}

}  // namespace glissade::section
