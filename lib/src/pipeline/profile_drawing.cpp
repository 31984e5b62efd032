#include "glissade/pipeline/profile_drawing.hpp"

#include "glissade/centerline/in_run.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/pipeline/rules.hpp"

#include "core/millimetres.hpp"
#include "pipeline/letters.hpp"

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
constexpr double kTextScale = 250.0;

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

void add_gates(const Track& track, const Plane& plane, Drawing& drawing) {
  if (!track.gates) return;
  const std::size_t layer = drawing.layer({"gates", LineStyle::continuous, 0.18, 3});
  constexpr double kTick = 0.6;  // [m]
  constexpr int kEvery = 5;
  const int last = track.gates->gates.back().number;
  for (const Gate& gate : track.gates->gates) {
    // A number close to the last would lie across it.
    const bool told = gate.number == 1 || gate.number == last ||
                      (gate.number % kEvery == 0 && last - gate.number > kEvery / 2);
    drawing.line(layer, plane.at(gate.from_start), plane.at(gate.from_start, told ? 2.0 * kTick : kTick));
    if (!told) continue;
    // Beside the lines that lead to dimensions from the first and the last of them.
    constexpr double kBeside = 0.9;  // [m]
    drawing.texts.push_back({layer,
                             plane.at(gate.from_start + kBeside, 2.4 * kTick),
                             1.8,
                             std::to_string(gate.number),
                             TextAnchor::centre,
                             {}});
  }
}

void add_letters(const Design& design, const Track& track, const Plane& plane, Drawing& drawing) {
  const std::size_t layer = drawing.layer({"letters", LineStyle::continuous, 0.25, 1});
  std::optional<double> before;
  for (const Letter& letter : letters_of(design, *track.centerline)) {
    constexpr double kRadius = 150.0;  // [mm]
    drawing.add(layer, Circle{plane.at(letter.arc_length), kRadius});
    // Letters that would cover each other stand one below the other.
    constexpr double kClose = 4.0;   // [m]
    constexpr double kBelow = -2.5;  // [m]
    constexpr double kLower = -6.0;  // [m]
    const bool close = before && letter.arc_length - *before < kClose;
    drawing.texts.push_back({layer,
                             plane.at(letter.arc_length, close ? kLower : kBelow),
                             3.5,
                             letter.name,
                             TextAnchor::right,
                             {}});
    before = letter.arc_length;
  }
}

std::string metres_text(double metres) {
  return rounded_text(1e-3 * std::round(1e3 * metres), 7) + " m";
}

/// Lengths along the straight pieces and the measures of the whole.
void add_dimensions(const Design& design, const Track& track, const Plane& plane, Drawing& drawing) {
  const std::size_t layer = drawing.layer({"dimensions", LineStyle::continuous, 0.18, 5});
  const Centerline& centerline = *track.centerline;
  const auto add = [&](double from, double to, double offset, DimensionKind kind, const std::string& text) {
    drawing.dimensions.push_back({layer, plane.at(from), plane.at(to), offset, kind, text});
  };
  const double length = centerline.length();
  const Endpoints end = centerline.endpoints();
  add(0.0, length, -22.0, DimensionKind::level, metres_text(end.run));
  add(0.0, length, 16.0, DimensionKind::upright, metres_text(end.drop));
  const auto* const in_run = dynamic_cast<const InRun*>(&centerline);
  if (in_run == nullptr) return;
  if (const auto area = design.centerline.in_run.start_area(); area && *area > 0.0) {
    // High enough for its text to stand clear of the line at the level of A.
    add(0.0, *area, 20.0, DimensionKind::aligned, "es " + metres_text(*area));
  }
  add(in_run->table_begins(), length, 12.0, DimensionKind::aligned, "t " + metres_text(in_run->shape().t));
  const double e1 = design.centerline.in_run.longest();
  const double bend = in_run->table_begins() - in_run->transition_begins();
  const std::size_t notes = drawing.layer({"notes", LineStyle::continuous, 0.25, 7});
  const auto note = [&](double s, double height, const std::string& text) {
    drawing.texts.push_back({notes, plane.at(s, height), 2.5, text, TextAnchor::left, {}});
  };
  note(0.5 * (in_run->transition_begins() + in_run->table_begins()), 3.0,
       "E1-E2 " + metres_text(bend) + ", r1 " + metres_text(in_run->shape().r1));
  note(in_run->transition_begins(), 11.0,
       "gamma " + angle_text(in_run->shape().gamma, 6) + ", e1 " + metres_text(e1) + " to the " +
           (design.centerline.in_run.counts_to_edge ? "edge" : "table"));
  // To the left, clear of the line down from the edge.
  drawing.texts.push_back({notes,
                           plane.at(in_run->table_begins(), -6.0),
                           2.5,
                           "alpha " + angle_text(in_run->shape().alpha, 6),
                           TextAnchor::right,
                           {}});
}

}  // namespace

Drawing longitudinal_section(const Design& design, const Track& track, const ProfileOptions& options) {
  // The table's checks are those of the parallel lines, too.
  static_cast<void>(coordinate_table(design, track, options));
  const Centerline& centerline = *track.centerline;
  const Plane plane(centerline);
  Drawing drawing;
  drawing.name = design.name;
  drawing.text_scale = kTextScale;
  drawing.add(drawing.layer({"track", LineStyle::continuous, 0.5, 7}), path_of(centerline, plane, 0.0));
  for (const ParallelLine& line : options.parallels) {
    drawing.add(drawing.layer({"parallel-" + line.name, LineStyle::dashed, 0.25, 8}),
                path_of(centerline, plane, line.height));
  }
  add_gates(track, plane, drawing);
  add_letters(design, track, plane, drawing);
  add_dimensions(design, track, plane, drawing);
  return drawing;
}

namespace {

using Row = std::vector<std::string>;

/// What a certificate says, letter by letter, in English, German and French.
std::vector<Row> certificate_rows(const Design& design, const Track& track, const InRun& in_run) {
  const InRunDesign& from = design.centerline.in_run;
  const HillDesign& hill = design.hill;
  std::vector<Row> rows;
  const auto add = [&](const char* letter, const char* english, const char* german, const char* french,
                       const std::string& value) {
    rows.push_back({letter, english, german, french, value});
  };
  const auto length = [&](const char* letter, const char* english, const char* german, const char* french,
                          const std::optional<double>& value) {
    if (value) add(letter, english, german, french, metres_text(*value));
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

TitleBlock title_of(const Design& design, const std::string& title) {
  TitleBlock block;
  block.title = title;
  block.owner = design.name;
  block.note = "Lengths in metres; x, z from the frame of the design, z up";
  block.unit = "m";
  return block;
}

Sheet section_sheet(const Design& design, const Track& track, const ProfileOptions& options) {
  Sheet sheet = blank_sheet(PaperSize::a3);
  sheet.title = title_of(design, "Longitudinal section / Längsprofil / profil en long");
  PlaneBox room = drawing_area(sheet);
  constexpr double kMargin = 30.0;  // [mm] for dimension lines
  room.low = room.low + Vec2{kMargin, kMargin};
  room.high = room.high - Vec2{kMargin, kMargin};
  sheet.views.push_back(fitted_view(longitudinal_section(design, track, options), room));
  return sheet;
}

std::optional<Sheet> cross_section_sheet(const Design& design) {
  std::optional<Drawing> drawing = cross_section_drawing(design);
  if (!drawing) return {};
  Sheet sheet = blank_sheet(PaperSize::a3);
  sheet.title = title_of(design, "Cross-section / Querschnitt / profil en travers");
  sheet.title.note = "Millimetres; as seen downhill, the centerline at the cross";
  sheet.title.unit = "mm";
  PlaneBox room = drawing_area(sheet);
  constexpr double kMargin = 40.0;  // [mm] for dimension lines
  room.low = room.low + Vec2{kMargin, kMargin};
  room.high = room.high - Vec2{kMargin, kMargin};
  sheet.views.push_back(fitted_view(*std::move(drawing), room));
  return sheet;
}

SheetTable gates_sheet_table(const GateTable& gates) {
  SheetTable table;
  table.caption = "Gates, speed " + rounded_text(gates.measuring_place, 4) + " m before the edge";
  table.header = {"gate", "to edge [m]", "x [m]", "z [m]"};
  table.widths_mm = {14.0, 22.0, 24.0, 24.0};
  for (const GateCondition& condition : gates.conditions) {
    table.header.push_back(condition.name + " [m/s]");
    table.widths_mm.push_back(30.0);
  }
  for (std::size_t i = 0; i < gates.gates.size(); ++i) {
    Row row = {std::to_string(gates.gates[i].number), rounded_text(gates.gates[i].to_edge, 6),
               rounded_text(gates.positions[i].x, 7), rounded_text(gates.positions[i].z, 7)};
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
                          bound_text(one.rule), certainty_text(one.rule.certainty)});
  }
  return table;
}

SheetTable coordinates_sheet_table(const std::vector<ProfileStation>& stations,
                                   const ProfileOptions& options) {
  SheetTable table;
  table.caption = "Coordinates";
  table.header = {"", "s [m]", "to edge [m]", "x [m]", "y [m]", "z [m]", "slope [deg]", "radius [m]"};
  table.widths_mm = {12.0, 22.0, 22.0, 28.0, 28.0, 28.0, 22.0, 24.0};
  for (const ParallelLine& line : options.parallels) {
    table.header.push_back(line.name + " x, z [m]");
    table.widths_mm.push_back(46.0);
  }
  for (const ProfileStation& station : stations) {
    Row row = {station.name,
               rounded_text(station.arc_length, 7),
               rounded_text(station.to_edge, 7),
               rounded_text(station.position.x, 8),
               rounded_text(station.position.y, 8),
               rounded_text(station.position.z, 8),
               rounded_text(station.slope_angle.degrees(), 6),
               station.curvature == 0.0 ? "straight" : rounded_text(1.0 / station.curvature, 6)};
    for (const Vec3& at : station.parallels)
      row.push_back(rounded_text(at.x, 8) + ", " + rounded_text(at.z, 8));
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace

std::vector<Sheet> profile_sheets(const Design& design, const Track& track, const ProfileOptions& options) {
  std::vector<Sheet> sheets = {section_sheet(design, track, options)};
  const auto add = [&](const std::string& title, SheetTable table) {
    for (Sheet& sheet : table_sheets(title_of(design, title), PaperSize::a3, std::move(table))) {
      sheets.push_back(std::move(sheet));
    }
  };
  if (std::optional<Sheet> sheet = cross_section_sheet(design)) sheets.push_back(*std::move(sheet));
  if (const auto* const in_run = dynamic_cast<const InRun*>(track.centerline.get())) {
    SheetTable table;
    table.header = {"", "English", "Deutsch", "français", ""};
    table.widths_mm = {20.0, 95.0, 95.0, 95.0, 40.0};
    table.rows = certificate_rows(design, track, *in_run);
    table.caption = "In-run";
    add("Parameters / Kenngrössen / paramètres", std::move(table));
  }
  if (track.gates) add("Start gates / Startluken / portes de départ", gates_sheet_table(*track.gates));
  const std::vector<Judgement> judgements = judge_rules(design, track);
  if (!judgements.empty()) add("Rules / Regeln / règles", rules_sheet_table(judgements));
  add("Coordinates / Koordinaten / coordonnées",
      coordinates_sheet_table(coordinate_table(design, track, options), options));
  return numbered(std::move(sheets));
}

}  // namespace glissade
