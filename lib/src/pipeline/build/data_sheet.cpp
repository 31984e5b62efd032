// The data sheet of a chute: nothing on it is computed here but places on paper.

#include "pipeline/build/data_sheet.hpp"

#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/quantity.hpp"
#include "glissade/design/stream_channel.hpp"
#include "glissade/pipeline/rules.hpp"
#include "glissade/report/report.hpp"
#include "glissade/trades/chute/stream.hpp"

#include "core/millimetres.hpp"
#include "pipeline/build/report.hpp"
#include "pipeline/task/cross_section.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace glissade::pipeline {
namespace {

constexpr int kGrey = 254;
constexpr int kBlue = 5;
constexpr int kBlack = 7;
constexpr double kText = 1.9;  // [mm], capital letters of tables

ArcPath chain(const std::vector<Vec2>& points, bool closed = false) {
  ArcPath path;
  for (const Vec2 point : points) path.vertices.push_back({point, 0.0});
  path.closed = closed;
  return path;
}

std::vector<Vec2> in_millimetres(std::vector<Vec2> points) {
  for (Vec2& point : points) point = core::kMillimetres * point;
  return points;
}

// --- side view

/// The floor and the surface of the stream above it, run and height from the start [m].
struct StreamOutline {
  std::vector<Vec2> floor;
  std::vector<Vec2> surface;
};

StreamOutline outline_of(const Motion& motion) {
  constexpr int kPlaces = 160;
  StreamOutline outline;
  for (int i = 0; i <= kPlaces; ++i) {
    const double s = std::min(motion.distance(), motion.distance() * i / kPlaces);
    const CenterlinePoint at = motion.centerline().at(s);
    const double depth = motion.quantity(BulkStream::kDepth, s);
    outline.floor.push_back({at.x, -at.drop});
    outline.surface.push_back(
        {at.x + depth * math::sin(at.slope_angle), -at.drop + depth * math::cos(at.slope_angle)});
  }
  return outline;
}

void add_track(const Design& design, const Track& track, Drawing& view) {
  const std::size_t thick = view.layer({"FLOOR", LineStyle::continuous, 0.5, kBlack});
  const std::size_t thin = view.layer({"EDGES", LineStyle::continuous, 0.18, kBlack});
  const std::size_t stream = view.layer({"STREAM", LineStyle::continuous, 0.18, kBlue});
  const StreamOutline outline = outline_of(track.motion);
  std::vector<Vec2> body = outline.floor;
  body.insert(body.end(), outline.surface.rbegin(), outline.surface.rend());
  DrawnPath filled{stream, chain(in_millimetres(body), true), kGrey, {}, true};
  view.paths.push_back(std::move(filled));
  view.add(stream, chain(in_millimetres(outline.surface)));
  Envelope envelope;
  const CrossSection section(*design.cross_section);
  envelope.below = -section.lowest();
  envelope.above = section.highest();
  for (const EnvelopeEdge& edge : envelope_edges(*track.centerline, envelope)) {
    std::vector<Vec2> points = in_millimetres(edge.points);
    view.add(thin, chain(points));
  }
  std::vector<Vec2> floor;
  constexpr int kPlaces = 160;
  for (int i = 0; i <= kPlaces; ++i) {
    const CenterlinePoint at =
        track.centerline->at(std::min(track.centerline->length(), track.centerline->length() * i / kPlaces));
    floor.push_back({core::kMillimetres * at.x, -core::kMillimetres * at.drop});
  }
  view.add(thick, chain(floor));
}

void add_surroundings(const Design& design, const Track& track, Drawing& view) {
  const std::size_t thick = view.layer({"HOOD", LineStyle::continuous, 0.5, kBlack});
  const std::size_t air = view.layer({"AIR", LineStyle::chain, 0.18, kBlue});
  const std::size_t around = view.layer({"AROUND", LineStyle::dashed, 0.25, kBlack});
  const double height = design.track.start.z;
  for (const ReportFlight& flight : flights_of(design, track)) {
    std::vector<Vec2> points = flight.points;
    for (Vec2& point : points) point.y -= height;
    view.add(flight.name == "the hood" ? thick : air, chain(in_millimetres(points)));
  }
  if (design.feed && design.feed->kind == FeedKind::belt) {
    view.add(around, Circle{core::kMillimetres * feed_fall(design).pulley,
                            core::kMillimetres * design.feed->pulley_radius});
  }
  if (design.discharge && track.motion.arrived()) {
    const BeltLanding landing = belt_landing(design, track.motion);
    const CenterlinePoint end = track.centerline->at(track.centerline->length());
    const Vec2 at{end.x + landing.reach, -end.drop - design.discharge->drop};
    const double climb = design.discharge->belt_angle.radians();
    const Vec2 along{0.4 * math::cos(climb), 0.4 * math::sin(climb)};
    view.add(around, chain(in_millimetres({at - along, at + along})));
  }
}

/// Obstacles as far as they lie beside the chute: half-planes and grounds reach on for ever.
void add_obstacles(const Design& design, Drawing& view) {
  const auto box = bounds(view);
  if (!design.limits || !box) return;
  const std::size_t layer = view.layer({"OBSTACLES", LineStyle::continuous, 0.35, 1});
  const double height = design.track.start.z;
  for (const ReportKeepOut& area : report_keep_outs(design)) {
    if (area.open) continue;
    std::vector<Vec2> points = area.points;
    for (Vec2& point : points) point.y -= height;
    view.add(layer, chain(in_millimetres(points), true));
  }
}

Drawing side_of(const Design& design, const Track& track) {
  Drawing view;
  add_track(design, track, view);
  add_surroundings(design, track, view);
  add_obstacles(design, view);
  return view;
}

// --- charts

/// A quantity along the track, at every friction.
struct Chart {
  std::string title;
  double unit = 1.0;  ///< SI to what is written
  std::function<double(const BulkStream&, const LawState&)> value;
};

void label(Drawing& ink, Vec2 at, const std::string& text, TextAnchor anchor) {
  const std::size_t layer = ink.layer({"LABELS", LineStyle::continuous, 0.18, kBlack});
  ink.texts.push_back({layer, at, kText, text, anchor, {}});
}

const BulkStream& stream_on(const Motion& motion) {
  return *stream_of(motion.body());
}

QuantityPeak peak_of(const Chart& chart, const Motion& motion) {
  const BulkStream& stream = stream_on(motion);
  return motion.highest([&](const LawState& at) { return chart.value(stream, at); });
}

/// Where a chart is drawn: evenly, at its peaks, and on both sides of each place where a ride changes.
std::vector<double> chart_places(const Chart& chart, const Track& track) {
  constexpr int kPlaces = 500;  // taste: a fifth of a millimetre of paper
  const double length = track.centerline->length();
  std::vector<double> places;
  for (int i = 0; i <= kPlaces; ++i) places.push_back(std::min(length, length * i / kPlaces));
  for (const LevelRide& ride : track.rides()) {
    places.push_back(peak_of(chart, *ride.motion).arc_length);
    for (const double at : ride.motion->breaks()) {
      if (at > 0.0) places.push_back(std::nextafter(at, 0.0));
      places.push_back(at);
    }
  }
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
  return places;
}

Drawing chart_of(const Chart& chart, const Track& track, const PlaneBox& room) {
  const double length = track.centerline->length();
  const std::vector<double> places = chart_places(chart, track);
  std::vector<std::vector<double>> lines;
  double most = 0.0;
  for (const LevelRide& ride : track.rides()) {
    lines.emplace_back();
    for (const double s : places) {
      if (s > ride.motion->distance()) break;
      lines.back().push_back(chart.unit * chart.value(stream_on(*ride.motion), ride.motion->law_state(s)));
    }
    most = std::max(most, chart.unit * peak_of(chart, *ride.motion).value);
  }
  const PlaneBox frame{room.low + Vec2{2.0, 6.0}, room.high - Vec2{2.0, 5.0}};
  const auto place = [&](std::size_t i, double value) {
    return Vec2{frame.low.x + frame.width() * places[i] / length,
                frame.low.y + frame.height() * value / (1.08 * std::max(most, 1e-12))};
  };
  Drawing ink;
  const std::size_t band = ink.layer({"BAND", LineStyle::continuous, 0.13, kGrey});
  const std::size_t thick = ink.layer({"NOMINAL", LineStyle::continuous, 0.35, kBlue});
  const std::size_t axes = ink.layer({"AXES", LineStyle::continuous, 0.25, kBlack});
  // Between the least and the greatest of the frictions.
  std::vector<Vec2> upper;
  std::vector<Vec2> lower;
  for (std::size_t i = 0; i < places.size(); ++i) {
    double least = 1e300;
    double greatest = -1e300;
    for (const auto& line : lines) {
      if (i >= line.size()) continue;
      least = std::min(least, line[i]);
      greatest = std::max(greatest, line[i]);
    }
    if (greatest < least) break;
    upper.push_back(place(i, greatest));
    lower.push_back(place(i, least));
  }
  upper.insert(upper.end(), lower.rbegin(), lower.rend());
  if (lines.size() > 1) ink.paths.push_back({band, chain(upper, true), kGrey, {}, true});
  const std::vector<LevelRide> rides = track.rides();
  for (std::size_t k = 0; k < rides.size(); ++k) {
    if (rides[k].level != FrictionLevel::nominal) continue;
    std::vector<Vec2> line;
    for (std::size_t i = 0; i < lines[k].size(); ++i) line.push_back(place(i, lines[k][i]));
    if (line.size() > 1) ink.add(thick, chain(line));
  }
  ink.add(axes, rectangle(frame.low, frame.high));
  label(ink, {frame.low.x, frame.high.y + 1.5}, chart.title, TextAnchor::left);
  label(ink, {frame.high.x, frame.high.y + 1.5}, rounded_text(most, 3) + " at most", TextAnchor::right);
  label(ink, {frame.low.x, frame.low.y - 3.2}, "0", TextAnchor::left);
  label(ink, {frame.high.x, frame.low.y - 3.2}, length_text(length, 3), TextAnchor::right);
  return ink;
}

std::vector<Chart> charts() {
  const auto of = [](double StreamState::*member) {
    return
        [member](const BulkStream& stream, const LawState& at) { return stream_state(stream, at).*member; };
  };
  return {{"depth [mm]", 1e3, of(&StreamState::depth)},
          {"speed [m/s]", 1.0, [](const BulkStream&, const LawState& at) { return std::sqrt(at.v); }},
          {"floor pressure [kPa]", 1e-3, of(&StreamState::floor_pressure)},
          {"floor wear [W/m^2]", 1.0, of(&StreamState::floor_wear)}};
}

// --- tables

using Rows = std::vector<std::vector<std::string>>;

std::string friction_range_text(const BodyDesign& body) {
  const auto degrees = [](const Friction& friction) { return rounded_text(friction.angle().degrees(), 3); };
  if (body.friction_changes.size() > 1) {
    const auto [least, most] = std::minmax_element(
        body.friction_changes.begin(), body.friction_changes.end(),
        [](const FrictionFrom& a, const FrictionFrom& b) { return a.friction < b.friction; });
    return degrees(least->friction) + " to " + degrees(most->friction) + " deg along the track";
  }
  if (!body.low_friction && !body.high_friction) return degrees(body.friction) + " deg";
  return degrees(body.low_friction.value_or(body.friction)) + " / " + degrees(body.friction) + " / " +
         degrees(body.high_friction.value_or(body.friction)) + " deg";
}

std::string feed_text(const FeedDesign& feed) {
  switch (feed.kind) {
    case FeedKind::belt:
      return "belt " + quantity_text(feed.belt_speed, Dimension::speed, 3) + ", drop " +
             length_text(feed.drop, 3);
    case FeedKind::hopper:
      return "hopper, drop " + length_text(feed.drop, 3);
    case FeedKind::free_fall:
      break;
  }
  return "free fall, " + length_text(feed.drop, 3);
}

Rows task_rows(const Design& design, const Track& track) {
  const StreamDesign& stream = *design.stream;
  Rows rows;
  rows.push_back({"mass flow", quantity_text(stream.mass_flow, Dimension::mass_flow) + ", surge x " +
                                   rounded_text(stream.surge, 3)});
  if (stream.material) {
    rows.push_back({"material", stream.material->material +
                                    (stream.material->liner.empty() ? "" : " on " + stream.material->liner)});
  }
  rows.push_back({"bulk density", quantity_text(stream.bulk_density, Dimension::density)});
  if (stream.lump_size) rows.push_back({"largest lump", length_text(*stream.lump_size, 3)});
  rows.push_back({"wall friction", friction_range_text(design.body)});
  rows.push_back(
      {"ends", "run " + length_text(track.endpoints.run) + ", drop " + length_text(track.endpoints.drop)});
  rows.push_back({"length", length_text(track.centerline->length())});
  rows.push_back(
      {"slope",
       rounded_text(Angle::from_radians(track.centerline->slope_angle(0.0)).degrees(), 3) + " to " +
           rounded_text(
               Angle::from_radians(track.centerline->slope_angle(track.centerline->length())).degrees(), 3) +
           " deg"});
  rows.push_back(
      {"least radius", std::isinf(track.min_radius) ? "straight" : length_text(track.min_radius, 3)});
  rows.push_back({"section", section_in_words(*design.cross_section)});
  if (design.feed) rows.push_back({"feed", feed_text(*design.feed)});
  if (design.hood) {
    rows.push_back({"hood", "radius " + length_text(*design.hood->radius.lowest, 3) + ", to " +
                                angle_text(Angle::from_radians(*design.hood->exit_angle.lowest), 3) +
                                ", drop " + length_text(design.hood->drop, 3)});
  }
  if (design.discharge) {
    rows.push_back({"belt", quantity_text(design.discharge->belt_speed, Dimension::speed, 3) + ", " +
                                length_text(design.discharge->drop, 3) + " below the finish"});
  }
  return rows;
}

/// What differs from friction to friction: a column each.
Rows ride_rows(const Design& design, const Track& track) {
  Rows rows;
  const auto add = [&](const std::string& name, const std::function<std::string(const Motion&)>& text) {
    std::vector<std::string> row{name};
    for (const LevelRide& ride : track.rides()) row.push_back(text(*ride.motion));
    rows.push_back(std::move(row));
  };
  const auto arrived = [](const std::function<std::string(const Motion&)>& text) {
    return [text](const Motion& m) { return m.arrived() ? text(m) : std::string("-"); };
  };
  const auto facts = [](const Motion& m) { return stream_facts(m).value(); };
  add("travel time [s]", arrived([](const Motion& m) { return rounded_text(m.travel_time(), 4); }));
  add("enters at [m/s]", [](const Motion& m) { return rounded_text(m.body().entry_speed, 3); });
  add("leaves at [m/s]", arrived([](const Motion& m) { return rounded_text(m.exit_speed(), 3); }));
  add("deepest [mm]",
      [&](const Motion& m) { return rounded_text(core::kMillimetres * facts(m).deepest.value, 3); });
  add("fullest [% of what chokes]",
      [&](const Motion& m) { return rounded_text(100.0 * facts(m).filling.value, 3); });
  add("floor wear, peak [W/m^2]", [](const Motion& m) { return rounded_text(wear_of({&m}).floor.value, 3); });
  if (design.hood) {
    add("hood: v^2/(g R cos), least",
        [&](const Motion& m) { return rounded_text(hood_passage(design, m.body()).least_contact, 3); });
    add("hood: leaves at [m/s]",
        [&](const Motion& m) { return rounded_text(hood_passage(design, m.body()).motion.exit_speed(), 3); });
  }
  if (design.discharge) {
    const auto landed = [&](double BeltLanding::*speed) {
      return arrived([&design, speed](const Motion& m) {
        const BeltLanding landing = belt_landing(design, m);
        return landing.lands() ? rounded_text(landing.*speed, 3) : std::string("-");
      });
    };
    add("along the belt [m/s]", landed(&BeltLanding::speed_along));
    add("into the belt [m/s]", landed(&BeltLanding::speed_into));
  }
  return rows;
}

std::string value_text(const Judgement& one) {
  if (!one.value) return "-";
  return quantity_text(*one.value, rule_quantity(one.rule.quantity)->dimension, 3);
}

Rows verdict_rows(const std::vector<Judgement>& judgements) {
  Rows rows;
  for (const Judgement& one : judgements) {
    const bool unknown = one.verdict == RuleVerdict::cannot_be_judged;
    rows.push_back({one.rule.id, unknown ? "look" : std::string(to_text(one.verdict)), value_text(one),
                    marked_bound_text(one)});
  }
  return rows;
}

double table_height(const SheetTable& table) {
  // As the table is drawn: a caption, and rows of 1.9 times their text.
  return 6.0 + 1.9 * table.text_height_mm * (static_cast<double>(table.rows.size()) + 1.0);
}

SheetTable table_of(Vec2 at, std::string caption, std::vector<double> widths, std::vector<std::string> header,
                    Rows rows, double text = kText) {
  return {at, std::move(caption), std::move(widths), std::move(header), std::move(rows), text};
}

/// Tables of what it is for and what it does, side by side.
double add_facts(const Design& design, const Track& track, Vec2 at, double width, Sheet& sheet) {
  constexpr double kGap = 4.0;
  const double half = 0.5 * (width - kGap);
  const std::vector<LevelRide> rides = track.rides();
  std::vector<std::string> header{"at friction"};
  for (const LevelRide& ride : rides) header.emplace_back(to_text(ride.level));
  std::vector<double> widths(header.size(), (half - 40.0) / static_cast<double>(rides.size()));
  widths.front() = 40.0;
  sheet.tables.push_back(
      table_of(at, "What it is made for", {24.0, half - 24.0}, {"", ""}, task_rows(design, track)));
  const double left = table_height(sheet.tables.back());
  sheet.tables.push_back(table_of(at + Vec2{half + kGap, 0.0}, "What the stream does", std::move(widths),
                                  std::move(header), ride_rows(design, track)));
  return std::max(left, table_height(sheet.tables.back()));
}

/// Verdicts in two columns, in letters as high as the room allows.
void add_verdicts(const std::vector<Judgement>& judgements, const PlaneBox& room, Sheet& sheet) {
  if (judgements.empty()) return;
  constexpr double kGap = 4.0;
  const double half = 0.5 * (room.width() - kGap);
  const Rows rows = verdict_rows(judgements);
  const std::size_t first = (rows.size() + 1) / 2;
  const double text =
      std::clamp((room.height() - 7.0) / (1.9 * (static_cast<double>(first) + 1.0)), 1.0, kText);
  const std::vector<double> widths{0.4 * half, 0.13 * half, 0.2 * half, 0.27 * half};
  const std::vector<std::string> header{"rule", "verdict", "worst", "bound"};
  const auto middle = rows.begin() + static_cast<std::ptrdiff_t>(first);
  sheet.tables.push_back(
      table_of({room.low.x, room.high.y},
               "Verdicts, the worst over every friction and flow; \"look\": cannot be judged", widths, header,
               {rows.begin(), middle}, text));
  sheet.tables.push_back(table_of({room.low.x + half + kGap, room.high.y - 6.0}, "", widths, header,
                                  {middle, rows.end()}, text));
}

/// A view as large as its room allows at a round scale: between those of ISO 5455 a page of this size wants others too.
SheetView filling(Drawing drawing, const PlaneBox& room) {
  SheetView view = fitted_view(std::move(drawing), room);
  const PlaneBox box = bounds(view.drawing).value_or(PlaneBox{});
  for (const double larger : {0.4, 0.5, 0.6, 0.75}) {
    const double scale = view.scale / larger;
    if (scale * box.width() > room.width() || scale * box.height() > room.height()) continue;
    view.scale = scale;
    break;
  }
  return view;
}

}  // namespace

Sheet chute_data_sheet(const Design& design, const Track& track) {
  Sheet sheet = blank_sheet(PaperSize::a4, false);
  const std::vector<Judgement> judgements = judge_rules(design, track);
  sheet.title.title = "Data sheet of a chute";
  sheet.title.owner = design.name;
  sheet.title.material = section_in_words(*design.cross_section);
  sheet.title.note =
      judgements.empty() ? "no rules in force" : "rules: " + std::string(to_text(worst(judgements)));
  sheet.title.sheet = "1/1";
  const PlaneBox room = drawing_area(sheet);
  constexpr double kView = 88.0;
  constexpr double kCharts = 30.0;
  double top = room.high.y;
  sheet.views.push_back(filling(side_of(design, track), {{room.low.x, top - kView}, {room.high.x, top}}));
  top -= kView + 2.0;
  const std::vector<Chart> all = charts();
  const double each = room.width() / static_cast<double>(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double left = room.low.x + each * static_cast<double>(i);
    SheetView view;
    view.drawing = chart_of(all[i], track, {{left, top - kCharts}, {left + each, top}});
    sheet.views.push_back(std::move(view));
  }
  top -= kCharts + 2.0;
  top -= add_facts(design, track, {room.low.x, top}, room.width(), sheet) + 2.0;
  add_verdicts(judgements, {room.low, {room.high.x, top}}, sheet);
  return sheet;
}

}  // namespace glissade::pipeline
