#include "glissade/core/number_text.hpp"
#include "glissade/drawing/workshop_drawings.hpp"

#include "drawing/ink.hpp"
#include "drawing/ordinates.hpp"
#include "drawing/views.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace glissade {
namespace {

using drawing::Eye;
using drawing::Projection;

constexpr double kMillimetres = 1000.0;  // in a metre

/// @return a length in millimetres, to a tenth
std::string mm(double metres) {
  if (!std::isfinite(metres)) return "-";
  return decimal_text(std::round(metres * 1e4) / 10.0 + 0.0);
}

std::string fixed(double value, int decimals) {
  double unit = 1.0;
  for (int i = 0; i < decimals; ++i) unit *= 10.0;
  return std::isfinite(value) ? decimal_text(std::round(value * unit) / unit + 0.0) : "-";
}

std::string number_of(const ShopPart& part) {
  return (part.number < 10 ? "0" : "") + std::to_string(part.number);
}

TitleBlock title_of(const Workshop& workshop, std::string title) {
  TitleBlock block;
  block.title = std::move(title);
  block.owner = workshop.name;
  block.note = workshop.tolerance;
  return block;
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

PlaneBox shrunk(PlaneBox box, double left, double below, double right, double above) {
  return {box.low + Vec2{left, below}, box.high - Vec2{right, above}};
}

// --- general arrangement

/// Numbers of the parts in a row above a view, each with a line to the part.
void add_balloons(SheetView& view, const Workshop& workshop, const Eye& eye) {
  const auto box = bounds(view.drawing);
  if (!box) return;
  const double per_paper = 1.0 / view.scale;
  constexpr double kStep = 9.0;    // between balloons, on paper [mm]
  constexpr double kAbove = 12.0;  // of the row over the view, on paper [mm]
  constexpr double kRadius = 3.5;
  std::vector<std::pair<Vec2, std::string>> targets;
  // Where there are more parts than a row has room for, the first of each family stands for all.
  constexpr std::size_t kMostBalloons = 36;
  const bool all = workshop.parts.size() <= kMostBalloons;
  std::set<std::string> families;
  for (const ShopPart& part : workshop.parts) {
    if (!all && !families.insert(part.name.substr(0, part.name.find_last_not_of("_0123456789") + 1)).second)
      continue;
    if (!part.places.empty())
      targets.emplace_back(kMillimetres * eye.see(part.centre_of_gravity), number_of(part));
  }
  std::sort(targets.begin(), targets.end(), [](const auto& a, const auto& b) {
    return std::pair(a.first.x, a.second) < std::pair(b.first.x, b.second);
  });
  const std::size_t layer = view.drawing.layer({"NUMBERS", LineStyle::continuous, 0.18, 7});
  const double step = std::min(kStep * per_paper,
                               box->width() / static_cast<double>(targets.size()) + kStep * 0.4 * per_paper);
  const double first =
      0.5 * (box->low.x + box->high.x) - 0.5 * step * static_cast<double>(targets.size() - 1);
  for (std::size_t i = 0; i < targets.size(); ++i) {
    const Vec2 at{first + step * static_cast<double>(i), box->high.y + kAbove * per_paper};
    view.drawing.add(layer, Circle{at, kRadius * per_paper});
    view.drawing.line(layer, at - Vec2{0.0, kRadius * per_paper}, targets[i].first);
    DrawnText text;
    text.layer = layer;
    text.at = at - Vec2{0.0, 1.25 * per_paper};
    text.text = targets[i].second;
    text.anchor = TextAnchor::centre;
    view.drawing.texts.push_back(std::move(text));
  }
}

/// Ends, joints and supports: a chain line down from each to its name below the view, where nothing else is drawn. Of names
/// that would lie across one another the first is told; the setting-out table has all.
void add_marks(SheetView& view, const Workshop& workshop, const Eye& eye, const PlaneBox& seen) {
  const double per_paper = 1.0 / view.scale;
  constexpr double kBelow = 12.0;  // of the names, with room for a dimension above them, on paper [mm]
  constexpr double kApart = 3.5;   // names, on paper [mm]
  std::vector<drawing::MarkedPlace> places = drawing::marked_places(workshop, seen, eye);
  std::stable_sort(places.begin(), places.end(),
                   [](const auto& a, const auto& b) { return a.at.x < b.at.x; });
  const std::size_t layer = view.drawing.layer({"JOINTS", LineStyle::chain, 0.18, 1});
  const double low = seen.low.y - kBelow * per_paper;
  double last = -std::numeric_limits<double>::infinity();
  for (const drawing::MarkedPlace& place : places) {
    if (place.at.x - last < kApart * per_paper) continue;
    last = place.at.x;
    view.drawing.line(layer, place.at, {place.at.x, low});
    DrawnText text;
    text.layer = layer;
    text.at = {place.at.x + 1.25 * per_paper, low - 1.0 * per_paper};
    text.text = place.what.substr(0, place.what.find_first_of(",:"));
    text.angle = Angle::from_degrees(90.0);
    text.anchor = TextAnchor::right;
    view.drawing.texts.push_back(std::move(text));
  }
}

Sheet general_arrangement(const Workshop& workshop) {
  Sheet sheet = blank_sheet(PaperSize::a3);
  sheet.title = title_of(workshop, "General arrangement");
  const PlaneBox room = drawing_area(sheet);
  Drawing side = side_view(workshop);
  Drawing plan = plan_view(workshop);
  const PlaneBox above = bounds(plan).value_or(PlaneBox{});
  const PlaneBox beside = bounds(side).value_or(PlaneBox{});
  // Both views at one scale, the plan below (first-angle projection): each gets its share of the height that balloons,
  // dimensions and names leave.
  constexpr double kBalloons = 20.0;   // above the side view, on paper [mm]
  constexpr double kNames = 32.0;      // below it
  constexpr double kAroundPlan = 8.0;  // below and above the plan
  constexpr double kDimension = 20.0;  // to the right of both
  const double free = room.height() - kBalloons - kNames - kAroundPlan;
  const double share = above.height() / std::max(above.height() + beside.height(), 1e-9);
  const double plan_height = share * free;
  const PlaneBox for_plan{{room.low.x + 5.0, room.low.y + 0.5 * kAroundPlan},
                          {room.high.x - kDimension, room.low.y + 0.5 * kAroundPlan + plan_height}};
  const PlaneBox for_side = shrunk(room, 5.0, plan_height + kAroundPlan + kNames, kDimension, kBalloons);
  SheetView side_view_ = fitted_view(std::move(side), for_side);
  SheetView plan_view_ = fitted_view(std::move(plan), for_plan);
  const double scale = std::min(side_view_.scale, plan_view_.scale);
  side_view_.scale = plan_view_.scale = scale;
  const Eye eye = drawing::eye_beside(workshop);
  add_balloons(side_view_, workshop, eye);
  add_marks(side_view_, workshop, eye, beside);
  // Dimensions of the parts, not of the balloons above them.
  const std::size_t thin = side_view_.drawing.layer({"DIM", LineStyle::continuous, 0.18, 7});
  side_view_.drawing.dimensions.push_back(
      {thin, beside.low, {beside.high.x, beside.low.y}, -9.0, DimensionKind::level, ""});
  side_view_.drawing.dimensions.push_back(
      {thin, {beside.high.x, beside.low.y}, beside.high, -9.0, DimensionKind::upright, ""});
  const std::size_t width = plan_view_.drawing.layer({"DIM", LineStyle::continuous, 0.18, 7});
  plan_view_.drawing.dimensions.push_back(
      {width, {above.high.x, above.low.y}, above.high, -9.0, DimensionKind::upright, ""});
  sheet.views = {std::move(side_view_), std::move(plan_view_)};
  double line = room.high.y - 4.0;
  for (const std::string& note : workshop.notes) {
    DrawnText text;
    text.at = {room.low.x, line};
    text.text = note;
    sheet.texts.push_back(std::move(text));
    line -= 4.5;
  }
  return sheet;
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
  table.caption = "Bend schedule: distances on the flat from the upstream edge";
  table.widths_mm = {12.0, 12.0, 26.0, 24.0, 22.0, 22.0, 26.0, 16.0};
  table.header = {"part", "no.", "distance mm", "length mm", "angle deg", "sum deg", "radius mm", "chord mm"};
  for (const BendStep& step : workshop.bends) {
    table.rows.push_back({std::to_string(step.part), std::to_string(step.hit), mm(step.distance),
                          mm(step.length), fixed(step.angle.degrees(), 3), fixed(step.sum.degrees(), 3),
                          mm(step.radius), fixed(step.chord_error * kMillimetres, 2)});
  }
  return table;
}

SheetTable setting_out_table(const Workshop& workshop) {
  SheetTable table;
  table.caption =
      "Setting out: x and z from the start, X Y Z of the site, ordinates above the chord of the piece";
  table.widths_mm = {64.0, 20.0, 20.0, 20.0, 24.0, 24.0, 24.0, 19.0, 23.0, 18.0};
  table.header = {"what", "s mm", "x mm",      "z mm",      "X mm",
                  "Y mm", "Z mm", "slope deg", "radius mm", "ordinate"};
  for (std::size_t i = 0; i < workshop.offset_names.size() && i < 4; ++i) {
    table.widths_mm.push_back(30.0);
    table.header.push_back(workshop.offset_names[i]);
  }
  for (const SettingOutPoint& point : workshop.setting_out) {
    std::vector<std::string> row{
        point.what,       mm(point.arc_length), mm(point.x),      mm(point.z),
        mm(point.site.x), mm(point.site.y),     mm(point.site.z), fixed(point.slope_angle.degrees(), 3),
        mm(point.radius), mm(point.ordinate)};
    for (std::size_t i = 0; i < point.offsets.size() && i < 4; ++i) row.push_back(mm(point.offsets[i]));
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

/// Holes by number, from the lower left corner of the pattern; numbers beside the holes in the view.
void add_holes(const ShopPart& part, Drawing& view, SheetTable& table) {
  const FlatPattern& pattern = *part.pattern;
  const PlaneBox box = bounds(pattern.region.outline);
  table.caption = "Holes, from the lower left corner";
  table.widths_mm = {12.0, 20.0, 20.0, 14.0};
  table.header = {"no.", "x mm", "y mm", "Ø mm"};
  const std::size_t layer = view.layer({"NUMBERS", LineStyle::continuous, 0.18, 7});
  for (std::size_t i = 0; i < pattern.region.holes.size(); ++i) {
    const Circle& hole = pattern.region.holes[i];
    table.rows.push_back({std::to_string(i + 1), mm(hole.centre.x - box.low.x), mm(hole.centre.y - box.low.y),
                          mm(2.0 * hole.radius)});
    DrawnText text;
    text.layer = layer;
    text.at =
        view.circles[i].circle.centre + Vec2{view.circles[i].circle.radius, view.circles[i].circle.radius};
    text.height_mm = 1.8;
    text.text = std::to_string(i + 1);
    view.texts.push_back(std::move(text));
  }
}

std::vector<std::string> facts_of(const ShopPart& part) {
  std::vector<std::string> facts{std::to_string(part.quantity()) + " off",
                                 "mass " + fixed(part.mass, 3) + " kg each"};
  if (!part.pattern) return facts;
  const FlatPattern& pattern = *part.pattern;
  const PlaneBox box = bounds(pattern.region.outline);
  facts.push_back("flat " + mm(box.width()) + " x " + mm(box.height()) + " mm");
  facts.push_back("cut edge " + mm(length(pattern.region.outline)) + " mm round the outline");
  if (!pattern.bends.empty()) {
    facts.push_back(std::to_string(pattern.bends.size()) + " bends, inner radius " +
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
  SheetTable holes = part.pattern->region.holes.empty() && part.pattern->rolls.empty()
                         ? drawing::ordinate_table(part.pattern->region.outline)
                         : SheetTable{};
  const std::string listed = part.pattern->region.holes.empty() ? ": ordinates" : ": holes";
  if (!part.pattern->region.holes.empty()) add_holes(part, view, holes);
  if (!holes.rows.empty()) {
    room.high.x -= kTableWidth + 4.0;
    holes.at = {area.high.x - kTableWidth, area.high.y};
  }
  sheet.views.push_back(fitted_view(std::move(view), room, "Flat pattern"));
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
  std::vector<Sheet> sheets{general_arrangement(workshop)};
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
