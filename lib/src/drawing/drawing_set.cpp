#include "glissade/core/math.hpp"
#include "glissade/core/slot.hpp"
#include "glissade/drawing/workshop_drawings.hpp"
#include "glissade/parts/bend_hits.hpp"

#include "core/least_rectangle.hpp"
#include "drawing/general_arrangement.hpp"
#include "drawing/ink.hpp"
#include "drawing/ordinates.hpp"
#include "drawing/sheet_words.hpp"
#include "drawing/views.hpp"
#include "parts/bodies/angle_bar.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace glissade {
namespace {

using drawing::mm;
using drawing::number_of;
using drawing::Projection;
using drawing::shrunk;
using drawing::title_of;

/// As many decimals in every row, so that points of a column stand below one another.
std::string fixed(double value, int decimals) {
  if (!std::isfinite(value)) return "-";
  std::array<char, 400> text{};
  const auto end =
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed, decimals).ptr;
  const std::string written(text.data(), end);
  return written.find_first_not_of("-0.") == std::string::npos && written.front() == '-' ? written.substr(1)
                                                                                         : written;
}

/// Millimetres of a table.
std::string tabled(double metres) {
  return fixed(core::kMillimetres * metres, 1);
}

/// Overall sizes of a drawing, below and to its right.
void add_overall_dimensions(Drawing& drawing) {
  const auto box = bounds(drawing);
  if (!box) return;
  const std::size_t thin = drawing.layer({"DIM", LineStyle::continuous, 0.18, 7});
  drawing.dimensions.push_back({thin, box->low, {box->high.x, box->low.y}, -9.0, DimensionKind::level, ""});
  drawing.dimensions.push_back(
      {thin, {box->high.x, box->low.y}, box->high, -9.0, DimensionKind::upright, ""});
}

// --- lists

SheetTable parts_list(const Workshop& workshop) {
  SheetTable table;
  table.caption = "Parts list";
  table.widths_mm = {10.0, 48.0, 12.0, 30.0, 16.0, 22.0, 22.0};
  table.header = {"no.", "name", "qty", "material", "t mm", "kg each", "kg all"};
  double mass = 0.0;
  for (const ShopPart& part : workshop.parts) {
    const double all = part.mass * static_cast<double>(part.quantity());
    mass += all;
    table.rows.push_back({number_of(part), part.name, std::to_string(part.quantity()), part.material,
                          mm(part.thickness), fixed(part.mass, 3), fixed(all, 3)});
  }
  table.rows.push_back({"", "total", "", "", "", "", fixed(mass, 3)});
  return table;
}

SheetTable items_list(const Workshop& workshop) {
  SheetTable table;
  table.caption = "Bought-in items";
  table.widths_mm = {50.0, 45.0, 15.0, 50.0};
  table.header = {"name", "standard", "qty", "where"};
  for (const BoughtInItem& item : workshop.items) {
    table.rows.push_back({item.name, item.standard, std::to_string(item.quantity), item.where});
  }
  return table;
}

SheetTable bend_schedule(const Workshop& workshop) {
  SheetTable table;
  table.caption =
      "Bend schedule: distances on the flat from the upstream edge, along the edge beside the floor";
  table.widths_mm = {12.0, 12.0, 26.0, 24.0, 22.0, 22.0, 26.0, 16.0};
  table.header = {"part", "no.", "distance mm", "length mm", "angle deg", "sum deg", "radius mm", "chord mm"};
  for (const BendStep& step : workshop.bends) {
    table.rows.push_back({std::to_string(step.part), std::to_string(step.hit), tabled(step.distance),
                          tabled(step.length), fixed(step.angle.degrees(), 3), fixed(step.sum.degrees(), 3),
                          tabled(step.radius), fixed(step.chord_error * core::kMillimetres, 2)});
  }
  return table;
}

SheetTable setting_out_table(const Workshop& workshop) {
  SheetTable table;
  table.caption =
      "Setting out: x and z from the start, X Y Z of the site, ordinates above the chord of the piece";
  if (!workshop.offset_names.empty())
    table.caption += "; levels z plumb below the place, - where the line ends short";
  table.widths_mm = {64.0, 20.0, 20.0, 20.0, 24.0, 24.0, 24.0, 19.0, 23.0, 18.0};
  table.header = {"what", "s mm", "run mm",    "z mm",      "X mm",
                  "Y mm", "Z mm", "slope deg", "radius mm", "ordinate"};
  for (std::size_t i = 0; i < workshop.offset_names.size() && i < 4; ++i) {
    table.widths_mm.push_back(36.0);
    table.header.push_back(workshop.offset_names[i] + ", plumb");
  }
  for (const SettingOutPoint& point : workshop.setting_out) {
    std::vector<std::string> row{point.what,          tabled(point.arc_length), tabled(point.x),
                                 tabled(point.z),     tabled(point.site.x),     tabled(point.site.y),
                                 tabled(point.site.z)};
    if (point.beyond_track)
      row.insert(row.end(), 3, "-");
    else
      row.insert(row.end(),
                 {fixed(point.slope_angle.degrees(), 3), tabled(point.radius), tabled(point.ordinate)});
    for (std::size_t i = 0; i < point.offsets.size() && i < 4; ++i)
      row.push_back(point.offsets[i] ? tabled(*point.offsets[i]) : "-");
    table.rows.push_back(std::move(row));
  }
  return table;
}

SheetTable check_table(const Workshop& workshop) {
  SheetTable table;
  table.caption = "Checks";
  table.widths_mm = {46.0, 14.0, 30.0, 34.0, 38.0};
  table.header = {"rule", "verdict", "value", "bound", "where"};
  for (const ShopCheck& check : workshop.checks) {
    const std::string verdict(check.verdict == ShopVerdict::fail ? "FAIL" : to_text(check.verdict));
    table.rows.push_back({check.rule, verdict, check.value, check.bound, check.where});
  }
  return table;
}

void append_table(std::vector<Sheet>& sheets, const Workshop& workshop, const std::string& title,
                  SheetTable table, PaperSize paper = PaperSize::a4) {
  if (table.rows.empty()) return;
  for (Sheet& sheet : table_sheets(title_of(workshop, title), paper, std::move(table))) {
    sheets.push_back(std::move(sheet));
  }
}

// --- a sheet a part

constexpr double kTableWidth = 66.0;

bool has_holes(const ShopPart& part) {
  const PlaneRegion& region = part.pattern->region;
  return !region.holes.empty() ||
         std::any_of(region.cutouts.begin(), region.cutouts.end(),
                     [](const ArcPath& cutout) { return as_slot(cutout).has_value(); });
}

DrawnText number_at(Vec2 at, std::size_t layer, std::size_t number) {
  DrawnText text;
  text.layer = layer;
  text.at = at;
  text.height_mm = 1.8;
  text.text = std::to_string(number);
  return text;
}

/// Slots by number after the holes: their middles, width and overall length.
void add_slots(const ShopPart& part, Drawing& view, std::size_t layer, SheetTable& table) {
  const PlaneRegion& region = part.pattern->region;
  const PlaneBox box = bounds(region.outline);
  for (std::size_t i = 0; i < region.cutouts.size(); ++i) {
    const auto slot = as_slot(region.cutouts[i]);
    if (!slot) continue;
    const std::size_t number = table.rows.size() + 1;
    table.rows.push_back({std::to_string(number), mm(slot->middle.x - box.low.x),
                          mm(slot->middle.y - box.low.y),
                          mm(2.0 * slot->radius) + " x " + mm(overall_length(*slot))});
    // The outline is drawn first, then cutouts as they come.
    const PlaneBox drawn = bounds(view.paths.at(1 + i).path);
    view.texts.push_back(number_at(drawn.high, layer, number));
  }
}

/// Holes by number, from the lower left corner of the pattern; numbers beside the holes in the view.
void add_holes(const ShopPart& part, Drawing& view, SheetTable& table) {
  const FlatPattern& pattern = *part.pattern;
  const PlaneBox box = bounds(pattern.region.outline);
  table.caption = "Holes, from the lower left corner";
  table.widths_mm = {10.0, 18.0, 18.0, 20.0};
  table.header = {"no.", "x mm", "y mm", "Ø mm"};
  const std::size_t layer = view.layer({"NUMBERS", LineStyle::continuous, 0.18, 7});
  for (std::size_t i = 0; i < pattern.region.holes.size(); ++i) {
    const Circle& hole = pattern.region.holes[i];
    table.rows.push_back({std::to_string(i + 1), mm(hole.centre.x - box.low.x), mm(hole.centre.y - box.low.y),
                          mm(2.0 * hole.radius)});
    const Circle& drawn = view.circles[i].circle;
    view.texts.push_back(number_at(drawn.centre + Vec2{drawn.radius, drawn.radius}, layer, i + 1));
  }
  add_slots(part, view, layer, table);
}

/// The angles between a straight bar's edges and the cuts at its ends, seen on the drilled leg.
std::string cut_text(const AngleBar& bar) {
  const auto at = [&](bool start) {
    const Vec2 from = start ? bar.heel.vertices.front().at : bar.heel.vertices.back().at;
    const Vec2 to = start ? bar.toe.vertices.front().at : bar.toe.vertices.back().at;
    const Vec2 along = bar.heel.vertices.back().at - bar.heel.vertices.front().at;
    const double angle = math::atan2(std::fabs(cross(along, to - from)), std::fabs(dot(along, to - from)));
    return fixed(Angle::from_radians(angle).degrees(), 1);
  };
  return at(true) + " and " + at(false) + " deg";
}

std::vector<std::string> facts_of(const ShopPart& part) {
  constexpr double kWorthTelling = 0.98;  // of the area
  std::vector<std::string> facts{std::to_string(part.quantity()) + " off",
                                 "mass " + fixed(part.mass, 3) + " kg each"};
  if (!part.pattern) return facts;
  const FlatPattern& pattern = *part.pattern;
  if (const auto* const angle = std::get_if<AngleBar>(&part.body)) {
    facts.push_back("angle " + mm(angle->height) + " x " + mm(angle->height) + " x " + mm(angle->thickness) +
                    " mm, EN 10056-1");
    facts.push_back(mm(parts::stock_length(*angle)) + " mm of bar");
    facts.push_back(parts::is_rolled(*angle) ? "rolled, the drilled leg outwards"
                                             : "ends cut at " + cut_text(*angle));
    return facts;
  }
  const PlaneBox box = bounds(pattern.region.outline);
  if (part.flat_bar) {
    facts.push_back("flat bar " + mm(box.height()) + " x " + mm(part.thickness) + " mm");
    facts.push_back(mm(box.width()) + " mm of bar");
    return facts;
  }
  facts.push_back("flat " + mm(box.width()) + " x " + mm(box.height()) + " mm");
  const Vec2 least = core::least_size(pattern.region.outline);
  if (least.x * least.y < kWorthTelling * box.width() * box.height())
    facts.push_back("cut from " + mm(least.x) + " x " + mm(least.y) + " mm");
  facts.push_back("cut edge " + mm(length(pattern.region.outline)) + " mm round the outline");
  if (!pattern.bends.empty()) {
    facts.push_back(std::to_string(bend_hits(pattern)) + " bends, inner radius " +
                    mm(pattern.bends.front().inner_radius) + " mm: see the bend schedule");
  }
  if (!pattern.rolls.empty()) facts.emplace_back("rolled: radii in the bend schedule");
  return facts;
}

void add_facts(const ShopPart& part, Sheet& sheet, Vec2 at) {
  for (const std::string& fact : facts_of(part)) {
    DrawnText text;
    text.at = at;
    text.text = fact;
    sheet.texts.push_back(std::move(text));
    at.y -= 4.5;
  }
}

/// Views of a part that is cut from no sheet: from above its own plane and from the side.
void add_body_views(const ShopPart& part, Sheet& sheet, const PlaneBox& room) {
  Projection above({{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}});
  Projection beside({{1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}});
  above.add(part, {});
  beside.add(part, {});
  const double half = 0.5 * (room.low.x + room.high.x);
  Drawing first = above.drawing("x-y");
  Drawing second = beside.drawing("x-z");
  add_overall_dimensions(first);
  add_overall_dimensions(second);
  SheetView left = fitted_view(std::move(first), {room.low, {half - 14.0, room.high.y}}, "x-y");
  SheetView right =
      fitted_view(std::move(second), {{half + 6.0, room.low.y}, room.high - Vec2{10.0, 0.0}}, "x-z");
  left.scale = right.scale = std::min(left.scale, right.scale);
  sheet.views = {std::move(left), std::move(right)};
}

/// The drilled leg of an angle, and from its end, or of a ring from the side, both legs at a scale of their own.
void add_angle_views(const ShopPart& part, Drawing leg, Sheet& sheet, const PlaneBox& room) {
  constexpr double kEnd = 0.3;  // of the room's height
  const auto& bar = std::get<AngleBar>(part.body);
  const bool rolled = parts::is_rolled(bar);
  Projection beside(rolled ? drawing::Eye{{1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}}
                           : drawing::Eye{{0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}});
  beside.add(part, {});
  Drawing end = beside.drawing("legs");
  add_overall_dimensions(end);
  const double split = room.low.y + kEnd * (room.high.y - room.low.y);
  sheet.views.push_back(fitted_view(std::move(leg), {{room.low.x, split + 12.0}, room.high},
                                    "Drilled leg, the other one towards you"));
  sheet.views.push_back(fitted_view(std::move(end), {room.low, {room.high.x, split - 12.0}},
                                    rolled ? "From the side" : "From its end"));
}

std::vector<Sheet> part_sheets(const Workshop& workshop, const ShopPart& part) {
  Sheet sheet = blank_sheet(PaperSize::a4);
  sheet.title = title_of(workshop, part.name);
  sheet.title.number = number_of(part);
  sheet.title.material = part.material + ", " + mm(part.thickness) + " mm";
  const PlaneBox area = drawing_area(sheet);
  add_facts(part, sheet, {area.low.x, area.high.y - 3.0});
  PlaneBox room = shrunk(area, 6.0, 18.0, 18.0, 34.0);
  if (!part.pattern) {
    add_body_views(part, sheet, room);
    return {sheet};
  }
  Drawing view = cut_drawing(part);
  for (DrawingLayer& layer : view.layers) layer.width_mm = layer.name == "CUT" ? 0.5 : 0.18;
  add_overall_dimensions(view);
  // A curve without holes is marked by its ordinates.
  SheetTable holes = !has_holes(part) && part.pattern->rolls.empty()
                         ? drawing::ordinate_table(part.pattern->region.outline)
                         : SheetTable{};
  const std::string listed = has_holes(part) ? ": holes" : ": ordinates";
  if (has_holes(part)) add_holes(part, view, holes);
  if (!holes.rows.empty()) {
    room.high.x -= kTableWidth + 4.0;
    holes.at = {area.high.x - kTableWidth, area.high.y};
  }
  if (std::holds_alternative<AngleBar>(part.body)) {
    add_angle_views(part, std::move(view), sheet, room);
  } else {
    sheet.views.push_back(fitted_view(std::move(view), room, "Flat pattern"));
  }
  std::vector<Sheet> sheets;
  std::vector<std::vector<std::string>> rest;
  while (drawing::table_height(holes, holes.rows.size()) > area.height() && !holes.rows.empty()) {
    rest.push_back(std::move(holes.rows.back()));
    holes.rows.pop_back();
  }
  if (!holes.rows.empty()) sheet.tables.push_back(holes);
  sheets.push_back(sheet);
  if (!rest.empty()) {
    std::reverse(rest.begin(), rest.end());
    holes.rows = std::move(rest);
    TitleBlock title = sheet.title;
    title.title += listed;
    for (Sheet& more : table_sheets(title, PaperSize::a4, std::move(holes)))
      sheets.push_back(std::move(more));
  }
  return sheets;
}

}  // namespace

std::vector<Sheet> drawing_set(const Workshop& workshop) {
  std::vector<Sheet> sheets = drawing::general_arrangement(workshop);
  append_table(sheets, workshop, "Parts list", parts_list(workshop));
  append_table(sheets, workshop, "Bought-in items", items_list(workshop));
  for (const ShopPart& part : workshop.parts) {
    for (Sheet& sheet : part_sheets(workshop, part)) sheets.push_back(std::move(sheet));
  }
  append_table(sheets, workshop, "Bend schedule", bend_schedule(workshop));
  append_table(sheets, workshop, "Setting out", setting_out_table(workshop), PaperSize::a3);
  append_table(sheets, workshop, "Checks", check_table(workshop));
  return numbered(std::move(sheets));
}

}  // namespace glissade
