#include "glissade/design/template.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/nearest_word.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/words.hpp"
#include "glissade/trades/ski_jump/sizing.hpp"

#include <algorithm>
#include <cstddef>

namespace glissade {
namespace {

constexpr std::string_view kHead =
    R"(# yaml-language-server: $schema=glissade.schema.json
# A design file of Glissade. Every value has its unit; docs/design-file.md lists all keys.
glissade: 1
)";

constexpr std::string_view kChute = R"(name: Grain chute
track:                                 # the two ends of the floor; z counts upwards, y is optional
  start: {x: 0 m, z: 6.2 m}
  finish: {x: 5.4 m, z: 1.1 m}
body:                                  # what slides
  friction_angle: 17 deg               # or friction_coefficient: 0.306
  # entry_speed: 0.5 m/s               # 0 if left out: a start from rest
  # drag: 0.001 1/m                    # air density x drag coefficient x frontal area / (2 x mass)
# gravity: 9.81 m/s^2
centerline: {kind: fastest}            # or constant-speed, straight, cycloid, segments, points
cross_section:                         # or slab, trapezoid, half-pipe, pipe, v-channel, track-groove, polygon
  kind: u-channel
  width: 400 mm                        # inside
  wall_height: 250 mm                  # inside
  thickness: 4 mm
# fabrication:                         # what a workshop makes of it: parts, patterns, drawings, lists
#   process: plate
#   material: {name: S235, density: 7850 kg/m^3}
#   floor: rolled                      # or bent
#   split: {longest: 2.9 m, sheet: [3 m, 1.5 m]}
#   flanges: {width: 50 mm, thickness: 6 mm, bolt: M10, pitch: 150 mm}
#   supports: {ground: 0 m, spacing: 2 m}
mesh: {tolerance: 0.5 mm}              # how far the mesh may depart from the exact shape
export: [stl, off, scad]               # also stl-ascii and csv; of parts dxf, step, pdf, ..., or workshop
)";

constexpr std::string_view kChuteInPlates = R"(name: Grain chute in plates
track:
  start: {x: 0 m, z: 6.2 m}
  finish: {x: 5.4 m, z: 1.1 m}
body:
  friction_angle: 17 deg
centerline: {kind: fastest}
cross_section: {kind: u-channel, width: 400 mm, wall_height: 250 mm, thickness: 4 mm}
fabrication:                           # {process: plate} alone will do; docs/design-file.md has all keys
  process: plate
  material: {name: S235, density: 7850 kg/m^3}
  arc_tolerance: 0.1 mm                # between the track and the arcs that are cut
  floor: bent                          # or rolled
  bend: {speed_loss: 1 %}              # as many bends as cost no more of the exit speed
  corners: butt                        # or lap, tab-and-slot
  split: {longest: 2.9 m, sheet: [3 m, 1.5 m], margin: 5 mm, spacing: 10 mm}  # stock, and what parts keep on it
  flanges: {width: 50 mm, thickness: 6 mm, bolt: M10, pitch: 150 mm}  # slotted: downstream for slots on that side; section: angle
  rim: {width: 40 mm, thickness: 5 mm}
  # liner: {thickness: 6 mm}           # tiles; with floor: rolled
  # lifting: {hole: 22 mm}
  supports: {ground: 0 m, spacing: 2 m}
  # rules: {leave_out: [plate.bolt-pitch]}   # of the shop: "glissade rules shop-plate" lists them
mesh: {tolerance: 0.5 mm}
export: workshop                       # the solid, and all that the shop gets
)";

constexpr std::string_view kRamp = R"(name: Ski ramp
track:
  start: {x: 0 m, z: 45.79 m}
  finish: {x: 83.48 m, z: 0 m}
body:
  friction_coefficient: 0.03
centerline: {kind: fastest}
cross_section:
  kind: slab                           # a flat ramp; the curbs are optional
  width: 2.6 m
  thickness: 200 mm
  curb_height: 500 mm
  curb_width: 100 mm
# fabrication: {process: timber, frame: beams, bearers: {count: 5}}  # parts for carpenters: docs/fabrication.md
mesh: {tolerance: 5 mm}
export: [stl, scad, csv]
)";

constexpr std::string_view kToboggan = R"(name: Toboggan run
track:                                 # points in space: the run may lead in any direction
  start: {x: 10 m, y: 4 m, z: 652 m}
  finish: {x: 94 m, y: 67 m, z: 628 m}
body:
  friction_coefficient: 0.06
centerline: {kind: fastest}
cross_section:
  kind: half-pipe
  width: 1.4 m                         # inside diameter of the round floor
  wall_height: 400 mm                  # optional: the sides go on straight up
  thickness: 60 mm
mesh: {tolerance: 5 mm}
export: [stl, csv]
)";

constexpr std::string_view kPipe = R"(name: Powder pipe
track:                                 # the lowest line of the bore
  start: {x: 0 mm, z: 2350 mm}
  finish: {x: 950 mm, z: 1100 mm}
body:
  friction_angle: 24 deg
centerline: {kind: fastest}
cross_section: {kind: pipe, inner_diameter: 150 mm, thickness: 2 mm}
mesh: {tolerance: 0.2 mm}
export: [stl, scad]
)";

constexpr std::string_view kMarbleRun = R"(name: Marble run
track:
  start: {x: 0 mm, z: 120 mm}
  finish: {x: 200 mm, z: 0 mm}
body:
  kind: rolling
  radius: 8 mm
  rolling_resistance: 0.01             # force over load, of a steel marble on a printed track
  friction_coefficient: 0.3            # while it slips: what keeps it rolling
centerline: {kind: fastest}
limits:
  slope_angle: {lowest: 0 deg, highest: 42 deg}  # steeper, it would slip: rolling needs 2/7 tan(slope)
  smallest_valley_radius: 40 mm
cross_section:
  kind: polygon                        # [across, height]; [0 mm, 0 mm] is the centerline, on the floor
  outline:
    - [-12 mm, -3 mm]
    - [12 mm, -3 mm]
    - [12 mm, 5 mm]
    - [10 mm, 5 mm]
    - [3 mm, 0 mm]
    - [-3 mm, 0 mm]
    - [-10 mm, 5 mm]
    - [-12 mm, 5 mm]
# fabrication:                         # pieces for a printer: docs/fabrication.md
#   process: print
#   joint: dovetail                    # or tongue, dowels
#   stands: {spacing: 200 mm}          # feet below joints and ends
mesh: {tolerance: 0.02 mm}
export: {formats: [stl], unit: mm}
)";

constexpr std::string_view kConstantSpeed = R"(name: Constant-speed chute
track:
  start: {x: 0 m, z: 3 m}
  finish: {x: 3 m, z: 0 m}
body:
  friction_angle: 17 deg
centerline:
  kind: constant-speed                 # a body fed at sqrt(p) keeps that speed: constant depth, even wear
  # p: 100 m^2/s^2                     # if left out: the one with the least travel time from rest
cross_section: {kind: trapezoid, width: 400 mm, wall_height: 200 mm, wall_angle: 20 deg, thickness: 4 mm}
mesh: {tolerance: 0.5 mm}
export: [stl, off, scad]
)";

constexpr std::string_view kSegments = R"(name: Chute on the drawing
track:
  start: {x: 0 m, z: 3 m}              # no finish: it follows from the segments
body:
  friction_angle: 17 deg
centerline:
  kind: segments
  entry_slope_angle: 55 deg            # below the horizontal
  segments:
    - {length: 2 m}                    # straight
    - {length: 0.2 m, entry_curvature: 0 1/m, exit_curvature: 0.5 1/m}   # eases into the arc
    - {length: 1 m, radius: 2 m}       # a valley; a crest has a negative radius
cross_section: {kind: u-channel, width: 400 mm, wall_height: 250 mm, thickness: 4 mm}
mesh: {tolerance: 0.5 mm}
export: [stl, csv]
)";

constexpr std::string_view kPoints = R"(name: Chute as measured
track:
  start: {x: 0 m, z: 2.4 m}            # no finish: it follows from the profile
body:
  friction_angle: 17 deg
centerline:
  kind: points
  file: profile.csv                    # beside this file; init -o FILE writes one to start from
  columns: [x, z]                      # horizontal distance and height
  unit: m
  # max_deviation: 2 mm                # how far the smooth curve may pass a point by
cross_section: {kind: u-channel, width: 400 mm, wall_height: 250 mm, thickness: 4 mm}
mesh: {tolerance: 0.5 mm}
export: [stl, csv]
)";

// Points of a quarter-like bow, 2 m across and 1.9 m down, with readings to the millimetre.
constexpr std::string_view kProfile = R"(x,z
0.000,2.400
0.200,1.940
0.400,1.588
0.600,1.305
0.800,1.073
1.000,0.886
1.200,0.739
1.400,0.630
1.600,0.555
1.800,0.513
2.000,0.500
)";

/// A line of a template, its remark where those of the others stand.
std::string with_remark(std::string text, std::string_view remark) {
  constexpr std::size_t kRemarkColumn = 39;
  text.resize(std::max(text.size() + 1, kRemarkColumn), ' ');
  return text.append("# ").append(remark).append("\n");
}

std::string in_run_text(const InRunSizes& sizes) {
  const auto metres = [](double value) { return rounded_text(value, 6) + " m"; };
  const auto degrees = [](Angle angle) { return rounded_text(angle.degrees(), 6) + " deg"; };
  std::string text = "name: In-run of a hill of " + rounded_text(sizes.hill_size, 6) + " m\n";
  text += with_remark("track: {edge: {x: 0 m, z: 0 m}}",
                      "the take-off edge T; or start, the highest gate; azimuth turns it");
  text += "body:\n";
  text += with_remark("  friction_coefficient: 0.03", "of skis on the ice track");
  text += with_remark("  drag: " + rounded_text(kInRunDrag, 4) + " 1/m", "or drag_area, mass and air");
  text +=
      "# Nobody read the bounds named below in the norm itself: 'glissade rules fis' tells the source and "
      "certainty of each.\n";
  text += "centerline:\n  kind: in-run\n";
  text += with_remark("  gamma: " + degrees(sizes.gamma), "slope of the straight");
  text += with_remark("  alpha: " + degrees(sizes.alpha), "slope of the table");
  text += with_remark("  r1: " + metres(sizes.r1), "radius where the transition ends, at least 0.14 v0^2");
  text += with_remark("  t: " + metres(sizes.t), "length of the table, at least 0.25 v0");
  text += with_remark("  e1: " + metres(sizes.e1), "length from the highest gate");
  text += with_remark("  es: " + metres(sizes.es), "length of the start area");
  text += with_remark("  e_counts_to: table", "both definitions are in use; edge is the other");
  text += with_remark("  transition: cubic", "or circle, clothoid, two-radii with first_radius");
  text += "hill: {size: " + metres(sizes.hill_size) +
          ", construction_point: " + metres(sizes.construction_point) +
          ", table_height: " + metres(sizes.table_height) +
          ", design_speed: " + rounded_text(sizes.design_speed, 4) + " m/s}\n";
  text += "gates:\n";
  text += with_remark("  count: " + std::to_string(sizes.gates), "numbered from the lowest");
  text += with_remark("  measuring_place: 10 m", "before the edge");
  text += "  slow: {friction_coefficient: " + rounded_text(kSlowFriction, 2) + "}\n";
  text += "  fast: {friction_coefficient: 0.02}\n";
  constexpr double kLargeHill = 110.0;  // [m], from which on grooves are deeper
  text += "cross_section:\n  kind: track-groove\n";
  text += with_remark("  width: 2.8 m", "of the bed that is prepared");
  text += with_remark("  groove_width: 135 mm", "13 to 13.5 cm");
  text += with_remark(std::string("  groove_depth: ") + (sizes.hill_size < kLargeHill ? "20 mm" : "30 mm"),
                      "at least 2 cm, of large hills 3 cm");
  text += with_remark("  groove_spacing: 320 mm", "30 to 33 cm");
  text += with_remark("  thickness: 200 mm", "under the grooves");
  return text + "mesh: {tolerance: 5 mm}\nexport: [stl, csv]\n";
}

constexpr double kTemplateHill = 140.0;  // [m]

const std::string& in_run_of_template() {
  static const std::string text = in_run_text(suggested_in_run(kTemplateHill));
  return text;
}

struct Source {
  DesignTemplate entry;
  std::string_view text;
};

const std::vector<Source>& sources() {
  static const std::vector<Source> all = {
      {{"chute", "a U-channel for bulk material, the fastest track"}, kChute},
      {{"ramp", "a flat ramp with curbs, such as a ski in-run"}, kRamp},
      {{"toboggan", "a half-pipe between two points in space"}, kToboggan},
      {{"in-run", "a ski jump's in-run from its certificate, with gates; --hill-size"}, in_run_of_template()},
      {{"pipe", "a closed pipe"}, kPipe},
      {{"chute-in-plates", "a chute as a sheet-metal shop makes it: parts, patterns, drawings"},
       kChuteInPlates},
      {{"marble-run", "a section of your own outline, for a 3-D printer"}, kMarbleRun},
      {{"constant-speed", "a chute that keeps a body at its speed"}, kConstantSpeed},
      {{"segments", "a track of straights, arcs and clothoids as drawn"}, kSegments},
      {{"points", "a measured profile from a CSV file"}, kPoints},
  };
  return all;
}

}  // namespace

const std::vector<DesignTemplate>& design_templates() {
  static const std::vector<DesignTemplate> entries = [] {
    std::vector<DesignTemplate> all;
    for (const Source& source : sources()) all.push_back(source.entry);
    return all;
  }();
  return entries;
}

std::string design_template(std::string_view kind) {
  std::vector<std::string_view> kinds;
  for (const Source& source : sources()) {
    if (source.entry.kind == kind) return std::string(kHead).append(source.text);
    kinds.push_back(source.entry.kind);
  }
  throw InputError({"", "there is no template named " + shown(kind), "There are " + listed(kinds) + ".",
                    std::string(nearest_word(kind, kinds))});
}

std::string in_run_template(double hill_size) {
  return std::string(kHead).append(in_run_text(suggested_in_run(hill_size)));
}

std::string_view design_template_profile() {
  return kProfile;
}

}  // namespace glissade
