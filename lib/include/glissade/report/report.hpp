#pragma once

#include "glissade/centerline/centerline.hpp"
#include "glissade/clearance/envelope.hpp"
#include "glissade/core/units.hpp"
#include "glissade/design/design.hpp"
#include "glissade/motion/motion.hpp"
#include "glissade/motion/probe.hpp"
#include "glissade/optimize/optimize.hpp"
#include "glissade/parts/workshop_build.hpp"
#include "glissade/route/placement.hpp"
#include "glissade/section/cross_section.hpp"
#include "glissade/solid/mesh_facts.hpp"
#include "glissade/solid/sweep.hpp"
#include "glissade/trades/chute/ends.hpp"
#include "glissade/trades/rules.hpp"
#include "glissade/trades/ski_jump/gates.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

namespace glissade {

/// What was found about one property; a property that nobody looked at is `not_checked`, never a pass.
enum class Verdict { pass, fail, not_checked };

/// A piece of a sentence: words, or a value that a reader may see in other units.
struct ReportPiece {
  std::string words;            ///< of a value empty
  std::optional<double> value;  ///< SI
  std::string unit;             ///< "m", "m/s^2"
  int digits = 4;
};

/// One line of a report's list of checks.
struct ReportCheck {
  std::string name;
  Verdict verdict = Verdict::not_checked;
  std::string detail;  ///< the numbers behind it, one sentence
  std::vector<ReportPiece> pieces =
      {};                   ///< the same in pieces, of one with values that have units; else empty
  bool of_nominal = false;  ///< it speaks of the ride at nominal friction alone
};

/// A stream in the air, before its chute or after it.
struct ReportFlight {
  std::string name;          ///< "from the belt", "to the belt"
  std::vector<Vec2> points;  ///< x run from the start, y height z [m]
};

/// One limit of the design and what the track made of it.
struct ReportLimit {
  std::string name;                   ///< "exit slope angle"; the key in the design file is check.limit
  std::string status;                 ///< "kept", "active" or "violated"
  LimitCheck check;                   ///< bound, what was reached, where, and at which friction
  std::optional<ActiveLimit> active;  ///< places and price of one that holds the track back
};

/// The ride at one friction of the design's range.
struct ReportRide {
  FrictionLevel level = FrictionLevel::nominal;
  const Motion* motion = nullptr;
  std::vector<ReportCheck> checks = {};    ///< those of this ride that the report has of the nominal one
  std::vector<ReportFlight> flights = {};  ///< of its stream
};

/// An area that the track stays out of; an open line where only one side is known.
struct ReportKeepOut {
  std::string name;
  std::vector<Vec2> points;  ///< x run from the start, y height z [m]
  bool open = false;
  double clearance = 0.0;  ///< the band around it that is kept free too [m]
};

/// A file that a report lists.
struct ReportFile {
  std::string name;
  std::uintmax_t bytes = 0;
  std::string sha256;  ///< 64 hexadecimal digits
};

/// The solid as it was written.
struct ReportSolid {
  const Solid* solid = nullptr;
  const MeshFacts* facts = nullptr;
  const CrossSection* section = nullptr;
  double max_deviation = 0.0;  ///< of the mesh as the files hold it [m]
};
/// A chute at one friction and one flow, in words and numbers.
struct ReportCase {
  FrictionLevel friction = FrictionLevel::nominal;
  std::string flow;  ///< "trickle", "nominal", "surge"
  const Motion* motion = nullptr;
};

/// One of the rides that a reader goes through by flow and friction.
struct ReportWhatIf {
  double mass_flow = 0.0;  ///< [kg/s]
  Friction friction;       ///< of the wall
  bool nominal = false;    ///< the design's own
  const Motion* motion = nullptr;
  std::optional<BeltLanding> landing;  ///< none without a belt, or where it does not arrive or land
  std::vector<Vec2> flight;            ///< to the belt: x run from the start, y height z [m]; may be empty
};

/// What a report is made from. Everything was computed elsewhere: a report measures nothing of its own.
struct ReportInput {
  const Design* design = nullptr;
  std::string centerline;  ///< how the track came about, in words; empty: the kind of the curve
  Endpoints endpoints;
  Placement placement;
  const Motion* motion = nullptr;
  const Motion* straight = nullptr;  ///< the same body on the straight line; null if it does not arrive there
  /// From rest on the exact optimum without limits; null where that does not apply.
  const Motion* optimum = nullptr;
  std::optional<double> optimum_travel_time;  ///< by its closed form [s]; none: that of the ride on it
  /// Smallest radius of curvature, 0 where it vanishes at the start [m]; none: the smallest at the stations.
  std::optional<double> min_radius;
  std::optional<Angle> steepest_slope_angle;  ///< anywhere; none: the steepest at the stations
  ReportSolid solid;
  std::vector<ReportCheck> checks;
  std::vector<ReportLimit> limits;
  /// The rides at every friction of the design, from low to high; empty: `motion` alone.
  std::vector<ReportRide> rides;
  std::optional<Angle> stall_angle;  ///< friction angle from which on the body stalls on this track
  std::vector<ProbeReading> probes;
  const GateTable* gates = nullptr;         ///< the rides from every gate; null: the design has none
  std::vector<Judgement> rules;             ///< the rules of the design, judged
  const WorkshopBuild* workshop = nullptr;  ///< what a workshop makes; null: nothing
  std::vector<ReportFlight> flights;        ///< of a stream
  std::vector<ReportCase> cases;            ///< of a stream: every friction with every flow
  std::vector<ReportWhatIf> what_if;  ///< of a stream: every flow of a friction, friction after friction
  std::vector<Issue> warnings;        ///< what to hear of beside the answer
  std::vector<ReportKeepOut> keep_outs;
  Envelope envelope;  ///< what the keep-outs are kept clear of; all 0: the centerline
  std::vector<ReportFile> files;
  std::stop_token stop = {};  ///< report_html() throws Interrupted if it asks for it
};

/// What the referee found of each limit: one row a limit, a limit that holds the track back with what it
/// costs. "violated" is what LimitCheck::kept() denies.
[[nodiscard]] std::vector<ReportLimit> report_limits(const std::vector<LimitCheck>& checks,
                                                     const std::vector<ActiveLimit>& active = {});

/// Where a design keeps its track out: polygons, grounds and ceilings (open lines), half-planes (an open line
/// as long as the chord).
[[nodiscard]] std::vector<ReportKeepOut> report_keep_outs(const Design& design);

/// One edge of an envelope, as a line to draw.
struct EnvelopeEdge {
  std::string name;          ///< "underside", "top of the solid", "headroom"
  std::vector<Vec2> points;  ///< x run from the start, y height above it [m]; from start to finish face
  bool dashed = false;       ///< the headroom: nothing is built there
};

/// The edges of an envelope over a track, cut at the end faces and creases as the solid is; the underside
/// first, none for a side on which it does not reach beyond the centerline.
[[nodiscard]] std::vector<EnvelopeEdge> envelope_edges(const Centerline& centerline,
                                                       const Envelope& envelope);

/// The report's data as one JSON document, "glissade-report/2": docs/report-data.md describes each field.
/// Bytes depend on the input alone. The view of a solid above kViewTriangles is swept anew at a coarser
/// tolerance, and the document says so.
[[nodiscard]] std::string report_json(const ReportInput& input);

/// The report as one self-contained page: data, styles and scripts inside, no request to anywhere.
[[nodiscard]] std::string report_html(const ReportInput& input);

/// Most facets that the page's 3-D view holds.
inline constexpr std::size_t kViewTriangles = 150'000;

/// @return SHA-256 of a file's bytes as 64 hexadecimal digits
/// @throws FileError if the file cannot be read
/// @throws Interrupted if `stop` asks for it
[[nodiscard]] std::string sha256_of_file(const std::filesystem::path& file, const std::stop_token& stop = {});
/// @return SHA-256 of the bytes, as 64 hexadecimal digits
[[nodiscard]] std::string sha256_of_text(std::string_view text);

}  // namespace glissade
