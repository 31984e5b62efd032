#include "glissade/pipeline/frozen.hpp"

#include "glissade/centerline/clothoid_spline.hpp"
#include "glissade/centerline/fitted_profile.hpp"
#include "glissade/centerline/tabulated_curve.hpp"
#include "glissade/core/error.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/units.hpp"
#include "glissade/design/rule_sets.hpp"
#include "glissade/design/write.hpp"
#include "glissade/io/atomic_file.hpp"

#include <cmath>
#include <fstream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace glissade {
namespace {

/// The pieces of a track that is made of clothoids; none of another.
const ClothoidSpline* clothoids_of(const Centerline& centerline) {
  if (const auto* const fitted = dynamic_cast<const FittedProfile*>(&centerline)) return &fitted->curve();
  return dynamic_cast<const ClothoidSpline*>(&centerline);
}

/// Counts places of limits and probes from another zero.
/// @param by  how far it lies before the one that they count from [m]
void count_from(double by, Design& design) {
  if (design.limits) {
    Limits& limits = *design.limits;
    for (HalfPlane& plane : limits.half_planes) {
      plane.point.x += by;
      if (plane.second) plane.second->x += by;
    }
    for (KeepOut& keep_out : limits.keep_outs) {
      for (Vec2& corner : keep_out.outline) corner.x += by;
    }
    for (std::vector<Profile>* const profiles : {&limits.stay_above, &limits.stay_below}) {
      for (Profile& profile : *profiles) {
        for (Vec2& point : profile.line) point.x += by;
      }
    }
    for (Vec2& waypoint : limits.waypoints) waypoint.x += by;
  }
  for (ProbeDesign& probe : design.probes) {
    if (probe.origin == ProbeOrigin::x) probe.at += by;
  }
}

/// Keeps places of limits and probes where they lie: they are those of the site along the x axis, and off it count from the
/// edge that an azimuth leads to, or from a start that is given.
void keep_places(const Design& design, const Track& track, Design& frozen) {
  if (design.track.start.y == design.track.finish.y) {
    frozen.track.finish.y = frozen.track.start.y;  // which sin(180 deg) misses by a rounding
  } else if (design.track.free_start) {
    count_from(track.endpoints.run, frozen);
  }
}

/// The design with the finish where the track ends and nothing left of what its centerline was.
Design emptied(const Design& design, const Track& track) {
  Design frozen = as_solved(design, track);
  const Endpoints end = track.centerline->endpoints();
  frozen.track.start = track.placement.start();
  frozen.track.finish = track.placement.to_space(end.run, end.drop, 0.0);
  keep_places(design, track, frozen);
  frozen.track.finish_given = true;
  frozen.track.free_finish = FinishKind::point;
  frozen.track.free_range = {};
  frozen.track.free_height = {};
  frozen.track.free_start = false;
  frozen.track.edge.reset();
  frozen.track.azimuth = {};
  // Gates fill the start area of an in-run's certificate, which goes.
  if (frozen.gates && !frozen.gates->start_area)
    frozen.gates->start_area = design.centerline.in_run.start_area();
  // An in-run brings rules along, its track alone does not.
  if (!frozen.rules.sets && design.centerline.kind == CenterlineKind::in_run)
    frozen.rules.sets = suggested_rule_sets(design);
  frozen.centerline = {};
  return frozen;
}

CenterlineDesign as_segments(const ClothoidSpline& spline) {
  CenterlineDesign centerline;
  centerline.kind = CenterlineKind::segments;
  centerline.entry_slope_angle = spline.entry_slope_angle();
  for (const ClothoidSegment& segment : spline.segments()) {
    centerline.segments.push_back(
        {segment.length, segment.entry_curvature, segment.exit_curvature, {}, {}, SegmentBend::clothoid});
  }
  return centerline;
}

CenterlineDesign as_table(const std::filesystem::path& csv) {
  CenterlineDesign centerline;
  centerline.kind = CenterlineKind::points;
  centerline.points_file = csv;
  centerline.points_distance_column = "run_m";
  centerline.points_height_column = "height_m";
  centerline.points_slope_angle_column = "slope_angle_deg";
  centerline.points_curvature_column = "curvature_per_m";
  return centerline;
}

constexpr const char* kTableHead = "run_m,height_m,slope_angle_deg,curvature_per_m";

/// A file of the user's own under the name of a table is not lost.
/// @throws InputError where one is there that is no table of a frozen track
void require_no_other(const std::filesystem::path& csv) {
  std::ifstream there(csv);
  std::string head;
  if (!there || !std::getline(there, head) || head == kTableHead) return;
  throw InputError({csv.string(), "it is there, and no table of a frozen track",
                    "The table of the track would take its place, beside the design under its name.",
                    "another name for the design, or the file moved away"});
}

/// Heights count from the start: what a site adds to them would cost digits.
std::string table_text(const std::vector<TabulatedPoint>& rows) {
  std::string text = std::string(kTableHead) + "\n";
  for (const TabulatedPoint& row : rows) {
    text += exact_text(row.x) + "," + exact_text(row.drop == 0.0 ? 0.0 : -row.drop) + "," +
            exact_text(Angle::from_radians(row.slope_angle).degrees()) + "," + exact_text(row.curvature) +
            "\n";
  }
  return text;
}

/// v0^2 + 2 g length, of which rounding takes its share.
double energy_of(const Motion& ride) {
  const double entry = ride.body().entry_speed;
  return entry * entry + 2.0 * ride.gravity() * ride.centerline().length();
}

/// Whether a body comes to the finish so slowly that the last digits of a table decide how, and whether it does.
bool creeps_in(const Motion& ride) {
  constexpr double kSlow =
      1e-11;  // measured: of tracks that come back to 1e-13 of it, 1e-11 where a bend is lost in rounding
  return ride.arrived() && ride.exit_speed() * ride.exit_speed() <= kSlow * energy_of(ride);
}

bool rides_alike(const Motion& was, const Motion& is) {
  if (!was.arrived() || creeps_in(was)) return true;
  const double rounding = kTableRounding * energy_of(was) / (was.gravity() * was.exit_speed());
  return is.arrived() &&
         std::fabs(is.travel_time() - was.travel_time()) <= kTableAccuracy * was.travel_time() + rounding;
}

/// The table of a track, on which the body rides as it did.
std::vector<TabulatedPoint> faithful_table(const Track& track) {
  std::vector<TabulatedPoint> rows = table_of(*track.centerline);
  const Motion& was = track.motion;
  const Motion is(std::make_shared<TabulatedCurve>(rows), was.body(), was.gravity());
  if (rides_alike(was, is)) return rows;
  throw InternalError({"centerline",
                       "the track of kind " + std::string(track.centerline->kind()) +
                           " does not ride the same from its table",
                       "", ""});
}

}  // namespace

void write_frozen_design(const std::filesystem::path& file, const Design& design, const Track& track) {
  FileSet files;
  add_frozen_design(files, file, design, track);
  files.commit();
}

void add_frozen_design(FileSet& files, const std::filesystem::path& file, const Design& design,
                       const Track& track) {
  std::filesystem::path csv = file;
  csv.replace_extension(".csv");
  if (csv == file) {
    throw InputError(
        {file.string(), "a design is no CSV file",
         "Where the track needs a table of its own, it is put beside the design under this name.",
         csv.replace_extension(".yaml").string()});
  }
  Design frozen = moved_to(emptied(design, track), file);
  std::string remark;
  if (design.centerline.kind == CenterlineKind::segments) {
    frozen.centerline = design.centerline;
  } else if (const ClothoidSpline* const clothoids = clothoids_of(*track.centerline)) {
    frozen.centerline = as_segments(*clothoids);
  } else {
    require_no_other(csv);
    files.put(csv, table_text(faithful_table(track)));
    frozen.centerline = as_table(frozen.file.parent_path() / csv.filename());
    if (creeps_in(track.motion)) {
      remark =
          "# It reaches its finish at " + rounded_text(track.motion.exit_speed(), 3) +
          " m/s: whether a body does so on the table, and how fast, is left to the table's last digits.\n";
    }
  }
  const std::string origin = design.name.empty() ? std::string("a design") : design.name;
  std::string note = "# The track found for " + origin + ", as it is: nothing is searched for any more.\n";
  for (char& letter : note) {
    if (static_cast<unsigned char>(letter) < 0x20U && letter != '\n') letter = ' ';
  }
  files.put(file, note + remark + design_text(frozen));
}

}  // namespace glissade
