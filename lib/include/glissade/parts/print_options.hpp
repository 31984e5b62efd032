#pragma once

#include "glissade/core/error.hpp"
#include "glissade/core/units.hpp"
#include "glissade/parts/plate_options.hpp"
#include "glissade/parts/print_piece.hpp"
#include "glissade/section/cross_section.hpp"

#include <optional>
#include <string_view>
#include <vector>

namespace glissade {

/// How a printed piece lies on the bed.
enum class PrintPose {
  automatic,  ///< of those without overhang the one with the lowest steps on the run surface
  side,       ///< on one side of the section: every layer has the contour of the track, no step along it
  end,        ///< on a joint face, the track upright
  flat        ///< as it is used, its chord level
};

/// Pins in holes of both faces of a joint.
struct DowelOptions {
  bool wanted = true;
  std::optional<double>
      diameter;  ///< of the pins [m]; none: the largest round one, up to 6 mm, that leaves `wall`
  std::optional<double> depth;  ///< of each hole [m]; none: 2.5 diameters, less where the track bends away
  double fit = 0.15e-3;         ///< by which a hole is wider than its pin [m]
  double chamfer = 0.5e-3;      ///< at the mouth of the holes and both ends of the pins [m]

  friend bool operator==(const DowelOptions&, const DowelOptions&) = default;
};

/// What holds two pieces together.
enum class PrintJoint {
  dowels,   ///< pins in holes of both faces
  tongue,   ///< a strip of one piece in a notch of the other, from side to side
  dovetail  ///< the same, wider at its head: put together sideways
};

/// Tongues and dovetails.
struct TongueOptions {
  std::optional<double>
      height;  ///< of the head, square to the track [m]; none: half of what is full from side to side
  std::optional<double>
      depth;  ///< along the track [m]; none: three quarters of the height, less where the track bends away
  double fit = 0.2e-3;                      ///< by which the notch is wider below and above, and deeper [m]
  double chamfer = 0.5e-3;                  ///< of the head's edges [m]
  Angle flare = Angle::from_degrees(10.0);  ///< of each flank of a dovetail

  friend bool operator==(const TongueOptions&, const TongueOptions&) = default;
};

/// Stands below the joints, both ends and between, whose cheeks hold the run.
struct StandOptions {
  std::vector<Vec2>
      ground;  ///< (x, height above the start), from left to right; one point: level [m]; none: `clear` below the run
  double clear = 10e-3;      ///< between the lowest point of the run and a ground that is not given [m]
  double spacing = 0.2;      ///< greatest distance along the run [m]
  double thickness = 10e-3;  ///< along the run, at the top [m]
  double cheek = 5e-3;       ///< height of the cheeks beside the run [m]
  double fit = 0.2e-3;       ///< between stand and run on every side [m]
  Angle steepest = Angle::from_degrees(60.0);  ///< slope angle beyond which none stands

  friend bool operator==(const StandOptions&, const StandOptions&) = default;
};

/// What no piece may exceed beside the bed.
struct PrintSplit {
  PrintBed bed;
  std::optional<double> longest;   ///< along the track [m]
  std::optional<double> heaviest;  ///< [kg]
  bool allowed = true;             ///< false: everything in one piece, or an error

  friend bool operator==(const PrintSplit&, const PrintSplit&) = default;
};

/// How a swept solid is printed in pieces.
struct PrintOptions {
  static constexpr std::string_view kProcess = "print";
  static constexpr double kArcTolerance = 2e-5;  ///< [m]

  StockMaterial material{"PLA", 1240.0};
  PrintSplit split;
  PrintJoint joint = PrintJoint::dowels;
  DowelOptions dowels;
  TongueOptions tongue;
  std::optional<StandOptions> stands;
  PrintPose pose = PrintPose::automatic;
  double layer = 0.2e-3;  ///< height of a layer [m]
  double wall = 0.9e-3;   ///< least wall that the printer makes: two lines of a 0.4 mm nozzle [m]
  Angle overhang = Angle::from_degrees(45.0);  ///< steepest lean from upright that needs no support
  double number_depth = 0.4e-3;  ///< of the numbers in joint faces and in a flat side [m]; 0: none; <= 2 mm
  double ease =
      0.2e-3;  ///< by which the run surface of the downstream piece is eased at a joint [m]; 0: not; <= 0.5 mm

  friend bool operator==(const PrintOptions&, const PrintOptions&) = default;
};

/// Options that no printer can make, whatever the track is: all of them.
/// @param section  that is printed
/// @return issues whose `where` is the key: "dowels.diameter", "split.bed"; of the section "cross_section"
[[nodiscard]] std::vector<Issue> print_problems(const CrossSection& section, const PrintOptions& options);

}  // namespace glissade
