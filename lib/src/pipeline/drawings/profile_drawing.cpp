#include "glissade/pipeline/profile_drawing.hpp"

#include "glissade/centerline/in_run.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/pipeline/rules.hpp"

#include "core/millimetres.hpp"
#include "pipeline/drawings/letters.hpp"
#include "pipeline/drawings/sheet_lengths.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

namespace glissade {

using namespace pipeline;

namespace {

/// What the text of a DXF is sized for: a section of 100 m on an A3 sheet.
constexpr double kTextScale = 250.0;  // taste

// What lettering and marks are sized for: the in-runs of hills, along their greater side [m].
constexpr double kSmallestHill = 50.0;  // measured: HS 38
constexpr double kLargestHill = 120.0;  // measured: HS 240

SheetLengths lengths_of(const Track& track) {
  const Endpoints end = track.centerline->endpoints();
  return SheetLengths(std::max(std::fabs(end.run), std::fabs(end.drop)));
}

/// The plane of the drawing: millimetres, the finish at the origin, the body coming from the left.
class Plane {
 public:
  explicit Plane(const Centerline& centerline) : centerline_(centerline), end_(centerline.endpoints()) {}

  /// @param height  above the track, square to it [m]
  [[nodiscard]] Vec2 at(double s, double height = 0.0) const {
    const CenterlinePoint point = centerline_.at(s);
    const double x = point.x + height * math::sin(point.slope_angle) - end_.run;
    const double z = end_.drop - point.drop + height * math::cos(point.slope_angle);
    return {core::kMillimetres * x, core::kMillimetres * z};
  }

 private:
  const Centerline& centerline_;
  Endpoints end_;
};

/// Straight pieces between breaks where the track is straight, chords a quarter of a metre or a 400th of it long elsewhere.
ArcPath path_of(const Centerline& centerline, const Plane& plane, double height) {
  constexpr int kLeastChords = 100;
  constexpr double kChord = 0.25;  // [m]: 0.08 mm off an arc of 100 m
  ArcPath path;
  const std::vector<double> breaks = centerline.breaks();
  for (std::size_t i = 1; i < breaks.size(); ++i) {
    const double width = breaks[i] - breaks[i - 1];
    const double turn = std::fabs(centerline.slope_angle(breaks[i - 1]) - centerline.slope_angle(breaks[i]));
    const int chords =
        turn == 0.0 ? 1
                    : std::max(kLeastChords, static_cast<int>(std::min(std::ceil(width / kChord), 4000.0)));
    for (int k = 0; k < chords; ++k)
      path.vertices.push_back({plane.at(breaks[i - 1] + width * k / chords, height), 0.0});
  }
  path.vertices.push_back({plane.at(centerline.length(), height), 0.0});
  return path;
}

/// What the marks and letters along a track are drawn with; lengths are those on a hill.
class Marks {
 public:
  Marks(const Plane& plane, double factor) : plane_(plane), factor_(factor) {}

  [[nodiscard]] double sized(double metres_on_hill) const { return factor_ * metres_on_hill; }
  /// @param height  above the track, square to it, as on a hill [m]
  [[nodiscard]] Vec2 at(double s, double height = 0.0) const { return plane_.at(s, sized(height)); }

 private:
  const Plane& plane_;
  double factor_;
};

void add_gates(const Track& track, const Marks& marks, Drawing& drawing) {
  if (!track.gates) return;
  const std::size_t layer = drawing.layer({"gates", LineStyle::continuous, 0.18, 3});
  constexpr double kTick = 0.6;  // taste [m]
  constexpr int kEvery = 5;      // taste
  const int last = track.gates->gates.back().number;
  for (const Gate& gate : track.gates->gates) {
    // A number close to the last would lie across it.
    const bool told = gate.number == 1 || gate.number == last ||
                      (gate.number % kEvery == 0 && last - gate.number > kEvery / 2);
    drawing.line(layer, marks.at(gate.from_start), marks.at(gate.from_start, told ? 2.0 * kTick : kTick));
    if (!told) continue;
    // Beside the lines that lead to dimensions from the first and the last of them.
    constexpr double kBeside = 0.9;  // taste [m]
    drawing.texts.push_back({layer,
                             marks.at(gate.from_start + marks.sized(kBeside), 2.4 * kTick),
                             1.8,
                             std::to_string(gate.number),
                             TextAnchor::centre,
                             {}});
  }
}

void add_letters(const Design& design, const Track& track, const Marks& marks, Drawing& drawing) {
  const std::size_t layer = drawing.layer({"letters", LineStyle::continuous, 0.25, 1});
  std::optional<double> before;
  for (const Letter& letter : letters_of(design, *track.centerline)) {
    constexpr double kRadius = 0.15;  // taste [m]
    drawing.add(layer, Circle{marks.at(letter.arc_length), core::kMillimetres * marks.sized(kRadius)});
    // Letters that would cover each other stand one below the other.
    constexpr double kClose = 4.0;   // taste [m]
    constexpr double kBelow = -2.5;  // taste [m]
    constexpr double kLower = -6.0;  // taste [m]
    const bool close = before && letter.arc_length - *before < marks.sized(kClose);
    // A track that climbs to a letter lies below it on the left.
    const bool climbs = before && track.centerline->slope_angle(letter.arc_length) < 0.0;
    drawing.texts.push_back({layer,
                             marks.at(letter.arc_length, close ? kLower : kBelow),
                             3.5,
                             letter.name,
                             climbs ? TextAnchor::left : TextAnchor::right,
                             {}});
    before = letter.arc_length;
  }
}

DrawingLayer dimension_lines() {
  return {"dimensions", LineStyle::continuous, 0.18, 5};
}

/// Lengths along the straight pieces and the letters of an in-run.
void add_in_run_dimensions(const Design& design, const InRun& in_run, const SheetLengths& lengths,
                           const Marks& marks, Drawing& drawing) {
  const std::size_t layer = drawing.layer(dimension_lines());
  const auto add = [&](double from, double to, double offset, const std::string& text) {
    drawing.dimensions.push_back({layer, marks.at(from), marks.at(to), offset, DimensionKind::aligned, text});
  };
  if (const auto area = design.centerline.in_run.start_area(); area && *area > 0.0) {
    // High enough for its text to stand clear of the line at the level of A.
    add(0.0, *area, 20.0, "es " + lengths.measure(*area));
  }
  add(in_run.table_begins(), in_run.length(), 12.0, "t " + lengths.measure(in_run.shape().t));
  const double e1 = design.centerline.in_run.longest();
  const double bend = in_run.table_begins() - in_run.transition_begins();
  const std::size_t notes = drawing.layer({"notes", LineStyle::continuous, 0.25, 7});
  const auto note = [&](double s, double height, const std::string& text) {
    drawing.texts.push_back({notes, marks.at(s, height), 2.5, text, TextAnchor::left, {}});
  };
  note(0.5 * (in_run.transition_begins() + in_run.table_begins()), 3.0,
       "E1-E2 " + lengths.measure(bend) + ", r1 " + lengths.measure(in_run.shape().r1));
  note(in_run.transition_begins(), 11.0,
       "gamma " + angle_text(in_run.shape().gamma, 6) + ", e1 " + lengths.measure(e1) + " to the " +
           (design.centerline.in_run.counts_to_edge ? "edge" : "table"));
  // To the left, clear of the line down from the edge.
  drawing.texts.push_back({notes,
                           marks.at(in_run.table_begins(), -6.0),
                           2.5,
                           "alpha " + angle_text(in_run.shape().alpha, 6),
                           TextAnchor::right,
                           {}});
}

/// The measures of the whole, and those of an in-run.
void add_dimensions(const Design& design, const Track& track, const Marks& marks, Drawing& drawing) {
  const std::size_t layer = drawing.layer(dimension_lines());
  const Centerline& centerline = *track.centerline;
  const SheetLengths lengths = lengths_of(track);
  const auto add = [&](double offset, DimensionKind kind, double measure) {
    drawing.dimensions.push_back(
        {layer, marks.at(0.0), marks.at(centerline.length()), offset, kind, lengths.measure(measure)});
  };
  const Endpoints end = centerline.endpoints();
  add(-22.0, DimensionKind::level, end.run);
  add(16.0, DimensionKind::upright, end.drop);
  const auto* const in_run = dynamic_cast<const InRun*>(&centerline);
  if (in_run != nullptr) add_in_run_dimensions(design, *in_run, lengths, marks, drawing);
}

}  // namespace

Drawing longitudinal_section(const Design& design, const Track& track, const ProfileOptions& options) {
  // The table's checks are those of the parallel lines, too.
  static_cast<void>(coordinate_table(design, track, options));
  const Centerline& centerline = *track.centerline;
  const Plane plane(centerline);
  Drawing drawing;
  drawing.name = design.name;
  drawing.add(drawing.layer({"track", LineStyle::continuous, 0.5, 7}), path_of(centerline, plane, 0.0));
  for (const ParallelLine& line : options.parallels) {
    drawing.add(drawing.layer({"parallel-" + line.name, LineStyle::dashed, 0.25, 8}),
                path_of(centerline, plane, line.height));
  }
  const PlaneBox lines = bounds(drawing).value_or(PlaneBox{});
  const double size = std::max(lines.width(), lines.height()) / core::kMillimetres;
  const double factor = lettering_factor(size, kSmallestHill, kLargestHill);
  drawing.text_scale = factor * kTextScale;
  const Marks marks(plane, factor);
  add_gates(track, marks, drawing);
  add_letters(design, track, marks, drawing);
  add_dimensions(design, track, marks, drawing);
  return drawing;
}

namespace {

using Row = std::vector<std::string>;

/// What a certificate says, letter by letter, in English, German and French.
std::vector<Row> certificate_rows(const Design& design, const Track& track, const InRun& in_run) {
  const InRunDesign& from = design.centerline.in_run;
  const HillDesign& hill = design.hill;
  const SheetLengths lengths = lengths_of(track);
  std::vector<Row> rows;
  const auto add = [&](const char* letter, const char* english, const char* german, const char* french,
                       const std::string& value) {
    rows.push_back({letter, english, german, french, value});
  };
  const auto length = [&](const char* letter, const char* english, const char* german, const char* french,
                          const std::optional<double>& value) {
    if (value) add(letter, english, german, french, lengths.measure(*value));
  };
  const bool edge = from.counts_to_edge;
  length("HS", "hill size", "Hillsize", "taille du tremplin", hill.size);
  length("w", "construction point, distance", "Konstruktionspunkt, Weite", "point de construction, distance",
         hill.construction_point);
  length("e1", edge ? "in-run from the top start, to the edge" : "in-run from the top start, to the table",
         edge ? "Anlauf vom obersten Start, bis zur Kante" : "Anlauf vom obersten Start, bis zum Tisch",
         edge ? "élan du départ le plus haut, au nez" : "élan du départ le plus haut, à la table",
         from.longest());
  if (const auto area = from.start_area()) {
    length("e2", "in-run from the lowest start", "Anlauf vom untersten Start", "élan du départ le plus bas",
           from.longest() - *area);
    length("es", "start area", "Startbereich", "zone de départ", area);
  }
  length("t", "table", "Schanzentisch", "table du tremplin", from.t);
  add("gamma", "slope of the straight", "Neigung der Geraden", "pente de la partie droite",
      angle_text(from.gamma, 6));
  add("alpha", "slope of the table", "Neigung des Schanzentisches", "pente de la table",
      angle_text(from.alpha, 6));
  length("r1", "radius at the end of the transition", "Radius am Ende des Übergangsbogens",
         "rayon à la fin de la courbe de transition", from.r1);
  length("E1-E2", "transition, along the curve", "Übergangsbogen, Länge", "courbe de transition, longueur",
         in_run.table_begins() - in_run.transition_begins());
  length("s", "height of the table", "Höhe des Schanzentisches", "hauteur de la table", hill.table_height);
  length("zU", "edge above the lowest point", "Kante über dem tiefsten Punkt",
         "nez au-dessus du point le plus bas", hill.height);
  if (hill.design_speed) {
    add("v0", "design speed at the edge", "Bemessungsgeschwindigkeit an der Kante",
        "vitesse de calcul au nez", rounded_text(*hill.design_speed, 4) + " m/s");
  }
  if (track.gates) {
    add("", "start gates", "Startluken", "portes de départ", std::to_string(track.gates->gates.size()));
  }
  return rows;
}

TitleBlock title_of(const Design& design, const SheetLengths& lengths, const std::string& title) {
  TitleBlock block;
  block.title = title;
  block.owner = design.name;
  block.note = "Lengths in " + lengths.units_in_words() + "; x, z from the frame of the design, z up";
  block.unit = lengths.unit();
  return block;
}

Sheet section_sheet(const Design& design, const Track& track, const ProfileOptions& options) {
  Sheet sheet = blank_sheet(PaperSize::a3);
  sheet.title = title_of(design, lengths_of(track), "Longitudinal section / Längsprofil / profil en long");
  const PlaneBox whole = drawing_area(sheet);
  constexpr double kMargin = 30.0;  // taste [mm]: for dimension lines
  const PlaneBox room{whole.low + Vec2{kMargin, kMargin}, whole.high - Vec2{kMargin, kMargin}};
  sheet.views.push_back(fitted_view_with_texts(longitudinal_section(design, track, options), room, whole));
  return sheet;
}

std::optional<Sheet> cross_section_sheet(const Design& design, const SheetLengths& lengths) {
  std::optional<Drawing> drawing = cross_section_drawing(design);
  if (!drawing) return {};
  Sheet sheet = blank_sheet(PaperSize::a3);
  sheet.title = title_of(design, lengths, "Cross-section / Querschnitt / profil en travers");
  sheet.title.note = "Millimetres; as seen downhill, the centerline at the cross";
  sheet.title.unit = "mm";
  const PlaneBox whole = drawing_area(sheet);
  constexpr double kMargin = 40.0;  // taste [mm]: for dimension lines
  const PlaneBox room{whole.low + Vec2{kMargin, kMargin}, whole.high - Vec2{kMargin, kMargin}};
  sheet.views.push_back(fitted_view_with_texts(*std::move(drawing), room, whole));
  return sheet;
}

SheetTable gates_sheet_table(const GateTable& gates, const SheetLengths& lengths) {
  SheetTable table;
  table.caption = "Gates, speed " + rounded_text(gates.measuring_place, 4) + " m before the edge";
  table.header = {"gate", lengths.head("to edge"), lengths.head("x")};
  table.widths_mm = {14.0, 22.0, 24.0};
  if (gates.has_y()) {
    table.header.push_back(lengths.head("y"));
    table.widths_mm.push_back(24.0);
  }
  table.header.push_back(lengths.head("z"));
  table.widths_mm.push_back(24.0);
  for (const GateCondition& condition : gates.conditions) {
    table.header.push_back(condition.name + " [m/s]");
    table.widths_mm.push_back(30.0);
  }
  for (std::size_t i = 0; i < gates.gates.size(); ++i) {
    Row row = {std::to_string(gates.gates[i].number), lengths.place(gates.gates[i].to_edge),
               lengths.place(gates.positions[i].x)};
    if (gates.has_y()) row.push_back(lengths.place(gates.positions[i].y));
    row.push_back(lengths.place(gates.positions[i].z));
    for (const GateCondition& condition : gates.conditions) {
      const GateRide& ride = condition.rides[i];
      row.push_back(ride.speed_at_measuring_place ? rounded_text(*ride.speed_at_measuring_place, 4) : "-");
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

/// The verdicts, each bound with how sure it is.
SheetTable rules_sheet_table(const std::vector<Judgement>& judgements) {
  SheetTable table;
  table.caption = "Bounds \"to be checked\" were not read in the document itself";
  table.header = {"rule", "verdict", "value", "bound", "certainty"};
  table.widths_mm = {80.0, 40.0, 100.0, 60.0, 60.0};
  for (const Judgement& one : judgements) {
    table.rows.push_back({one.rule.id, std::string(to_text(one.verdict)), measured_text(one),
                          bound_text(one.rule, digits_of(one)), certainty_text(one.rule.certainty)});
  }
  return table;
}

SheetTable coordinates_sheet_table(const Design& design, const Track& track, const ProfileOptions& options) {
  const SheetLengths lengths = lengths_of(track);
  constexpr int kDecimals = 4;  // taste: of a degree, 0.2 mm over 100 m
  SheetTable table;
  table.caption = "Coordinates";
  table.header = {""};
  for (const char* const column : {"s", "to edge", "x", "y", "z"})
    table.header.push_back(lengths.head(column));
  table.header.emplace_back("slope [deg]");
  table.header.push_back(lengths.head("radius"));
  table.widths_mm = {12.0, 22.0, 22.0, 28.0, 28.0, 28.0, 22.0, 24.0};
  const std::vector<ProfileStation> stations = coordinate_table(design, track, options);
  constexpr double kRounding = 1e-9;  // rounding: of a turn by 180 deg [m]
  const bool has_y = std::any_of(stations.begin(), stations.end(), [](const ProfileStation& station) {
    return std::fabs(station.position.y) > kRounding;
  });
  for (const ParallelLine& line : options.parallels) {
    table.header.push_back(lengths.head(line.name + (has_y ? " x, y, z" : " x, z")));
    table.widths_mm.push_back(has_y ? 66.0 : 46.0);
  }
  for (const ProfileStation& station : stations) {
    Row row = {station.name};
    for (const double value :
         {station.arc_length, station.to_edge, station.position.x, station.position.y, station.position.z})
      row.push_back(lengths.place(value));
    row.push_back(fixed_text(station.slope_angle.degrees(), kDecimals));
    row.push_back(lengths.radius(station.curvature, track.centerline->length()));
    for (const Vec3& at : station.parallels) {
      row.push_back(lengths.place(at.x) + ", " + (has_y ? lengths.place(at.y) + ", " : "") +
                    lengths.place(at.z));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace

std::vector<Sheet> profile_sheets(const Design& design, const Track& track, const ProfileOptions& options) {
  std::vector<Sheet> sheets = {section_sheet(design, track, options)};
  const SheetLengths lengths = lengths_of(track);
  const auto add = [&](const std::string& title, SheetTable table) {
    for (Sheet& sheet : table_sheets(title_of(design, lengths, title), PaperSize::a3, std::move(table))) {
      sheets.push_back(std::move(sheet));
    }
  };
  if (std::optional<Sheet> sheet = cross_section_sheet(design, lengths)) sheets.push_back(*std::move(sheet));
  if (const auto* const in_run = dynamic_cast<const InRun*>(track.centerline.get())) {
    SheetTable table;
    table.header = {"", "English", "Deutsch", "français", ""};
    table.widths_mm = {20.0, 95.0, 95.0, 95.0, 40.0};
    table.rows = certificate_rows(design, track, *in_run);
    table.caption = "In-run";
    add("Parameters / Kenngrössen / paramètres", std::move(table));
  }
  if (track.gates)
    add("Start gates / Startluken / portes de départ", gates_sheet_table(*track.gates, lengths));
  const std::vector<Judgement> judgements = judge_rules(design, track);
  if (!judgements.empty()) add("Rules / Regeln / règles", rules_sheet_table(judgements));
  add("Coordinates / Koordinaten / coordonnées", coordinates_sheet_table(design, track, options));
  return numbered(std::move(sheets));
}

}  // namespace glissade
