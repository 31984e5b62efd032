#include "drawing/general_arrangement.hpp"

#include "glissade/drawing/workshop_drawings.hpp"

#include "drawing/balloons.hpp"
#include "drawing/ink.hpp"
#include "drawing/sheet_words.hpp"
#include "drawing/stretches.hpp"
#include "drawing/views.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace glissade::drawing {
namespace {

constexpr double kBalloons =
    18.0;  // for a row or a column of balloons beside the view from the side, on paper [mm]
constexpr double kBalloonAway = 12.0;  // of a row or a column from what is seen
constexpr double kDimension = 28.0;    // for balloons and dimensions to the right of both views
constexpr double kNames = 32.0;        // for names below the view from the side
constexpr double kSizeAway = 9.0;      // of dimensions from what is seen, or from balloons beside it
constexpr double kAroundPlan = 8.0;    // below and above the plan
/// Kinds of parts that one view tells apart by numbers round it: a row above, and columns as high as a flat view lets them be.
constexpr std::size_t kMostNumbers = 24;

/// Middles of all pieces of a part as an eye sees them [mm].
Named pieces_of(const ShopPart& part, const Eye& eye) {
  Named named;
  for (const Frame& place : part.places) named.pieces.push_back(middle_of(part, place, eye));
  return named;
}

/// What carries a number. Where there are more parts than there is room for, the first of each family stands for all.
std::vector<const ShopPart*> numbered_parts(const Workshop& workshop, std::size_t room) {
  std::vector<const ShopPart*> parts;
  const bool all = workshop.parts.size() <= std::min(room, kMostNumbers);
  std::set<std::string> families;
  for (const ShopPart& part : workshop.parts) {
    if (part.places.empty() || parts.size() == room) continue;
    const std::string family = part.name.substr(0, part.name.find_last_not_of("_0123456789") + 1);
    if (all || families.insert(family).second) parts.push_back(&part);
  }
  return parts;
}

/// Places for balloons round three sides of what is seen: a row above, a column to the left, one to the right (ISO 6433: in rows
/// and columns). Columns that go on below the view have lines that run through the names there, a row that goes on beyond the
/// columns ones that run through these: both do so only where they must.
/// @param seen    of the view [mm of the drawing]
/// @param paper   that balloons may take [mm of paper]
/// @param wanted  how many balloons there are
std::vector<Vec2> balloon_places(const SheetView& view, const PlaneBox& seen, const PlaneBox& paper,
                                 std::size_t wanted) {
  constexpr double kStep = 9.0;      // between balloons
  constexpr double kRadius = 4.0;    // of a balloon, with a little air
  constexpr std::size_t kSpare = 3;  // places to choose from
  const Vec2 low = view.at + view.scale * (seen.low - view.anchor);
  const Vec2 high = view.at + view.scale * (seen.high - view.anchor);
  std::vector<Vec2> on_paper;
  const auto add = [&](Vec2 at) {
    if (at.x - kRadius >= paper.low.x && at.x + kRadius <= paper.high.x && at.y + kRadius <= paper.high.y) {
      on_paper.push_back(at);
    }
  };
  // Clear of the lines of the height's dimension.
  const auto add_columns = [&](double from, double to) {
    for (double y = from; y >= to; y -= kStep) {
      add({low.x - kBalloonAway, y});
      if (std::fabs(y - low.y) > kRadius) add({high.x + kBalloonAway, y});
    }
  };
  add_columns(high.y - 0.5 * kStep, low.y);
  const double middle = 0.5 * (low.x + high.x);
  const int half = static_cast<int>(0.5 * paper.width() / kStep);
  const int within = std::min(half, static_cast<int>((middle - low.x + kBalloonAway) / kStep));
  const auto add_pair = [&](int i) {
    add({middle + i * kStep, high.y + kBalloonAway});
    if (i > 0) add({middle - i * kStep, high.y + kBalloonAway});
  };
  for (int i = 0; i <= within; ++i) add_pair(i);
  // Then beside the names below the view, and beyond the columns.
  if (on_paper.size() < wanted + kSpare) add_columns(low.y - kRadius - 0.5 * kStep, low.y - kNames + kRadius);
  for (int i = within + 1; i <= half && on_paper.size() < wanted + kSpare; ++i) add_pair(i);
  for (Vec2& at : on_paper) at = view.anchor + (1.0 / view.scale) * (at - view.at);
  return on_paper;
}

/// Where the number of the length stands.
std::vector<Vec2> words_of_length(const PlaneBox& seen, double per_paper) {
  constexpr double kHalf = 5.0;  // [mm of paper]
  const Vec2 middle{0.5 * (seen.low.x + seen.high.x), seen.low.y - (kSizeAway - 2.0) * per_paper};
  const Vec2 aside{kHalf * per_paper, 0.0};
  return {middle - aside, middle, middle + aside};
}

/// Numbers of the parts round a view, each with a line to a piece of the part and how many there are.
/// @return whether some stand to the right of it
bool add_balloons(SheetView& view, const Workshop& workshop, const Eye& eye, const PlaneBox& seen,
                  const PlaneBox& paper) {
  const double per_paper = 1.0 / view.scale;
  constexpr double kRadius = 3.5;
  constexpr double kDot = 0.4;  // where a line ends on a part
  const std::size_t most = balloon_places(view, seen, paper, workshop.parts.size()).size();
  const std::vector<const ShopPart*> parts = numbered_parts(workshop, most);
  const bool counted = parts.size() == workshop.parts.size();
  const std::vector<Vec2> places = balloon_places(view, seen, paper, parts.size());
  std::vector<Named> names;
  names.reserve(parts.size());
  for (const ShopPart* const part : parts) names.push_back(pieces_of(*part, eye));
  const std::vector<Label> labels =
      labelled(names, places, (kRadius + 0.5) * per_paper, words_of_length(seen, per_paper));
  const std::size_t layer = view.drawing.layer({"NUMBERS", LineStyle::continuous, 0.18, 7});
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const Vec2 at = places[labels[i].slot];
    const Vec2 line = labels[i].target - at;
    const Vec2 along = norm(line) > 0.0 ? (1.0 / norm(line)) * line : Vec2{0.0, -1.0};
    view.drawing.add(layer, Circle{at, kRadius * per_paper});
    view.drawing.line(layer, at + kRadius * per_paper * along, labels[i].target);
    view.drawing.add(layer, Circle{labels[i].target, kDot * per_paper});
    const std::size_t pieces = parts[i]->places.size();
    const auto write = [&](std::string text, double below, double height) {
      view.drawing.texts.push_back(
          {layer, at - Vec2{0.0, below * per_paper}, height, std::move(text), TextAnchor::centre, {}});
    };
    const bool several = pieces > 1 && counted;
    write(number_of(*parts[i]), several ? 0.4 : 1.25, 2.5);
    if (several) write(std::to_string(pieces) + "x", 2.7, 1.8);
  }
  return std::any_of(labels.begin(), labels.end(), [&](const Label& one) {
    return places[one.slot].x > seen.high.x && places[one.slot].y < seen.high.y;
  });
}

/// The line down from a place to a height, without what would run through the number of the length.
std::vector<std::pair<Vec2, Vec2>> clear_of_length(Vec2 from, double low, const PlaneBox& seen,
                                                   double per_paper) {
  constexpr double kTextHigh = 4.5;  // with what is free round it, above the dimension's line [mm of paper]
  const double half = 0.5 * stroked_width("000000.0", 2.5) * per_paper;
  const Vec2 to{from.x, low};
  const double line = seen.low.y - kSizeAway * per_paper;
  const double top = line + kTextHigh * per_paper;
  if (std::fabs(from.x - 0.5 * (seen.low.x + seen.high.x)) > half || from.y < top) return {{from, to}};
  return {{from, {from.x, top}}, {{from.x, line}, to}};
}

constexpr double kNamesApart = 3.5;  // names below the view, on paper [mm]

/// Names side by side, each as near to its place as the others let it be.
/// @param at  their places, from left to right
/// @param low, high  where names stand; there is room for all
std::vector<double> beside_one_another(const std::vector<double>& at, double apart, double low, double high) {
  struct Row {
    double first;  // where its first name is
    std::size_t names;
  };
  std::vector<Row> rows;
  const auto place = [&](Row row) {
    return Row{std::clamp(row.first, low, std::max(low, high - apart * static_cast<double>(row.names - 1))),
               row.names};
  };
  for (const double one : at) {
    rows.push_back(place({one, 1}));
    while (rows.size() > 1) {
      const Row& before = rows[rows.size() - 2];
      const Row& last = rows.back();
      if (last.first - before.first >= apart * static_cast<double>(before.names)) break;
      // Together in the middle of what they name.
      const auto held = static_cast<double>(before.names);
      const auto more = static_cast<double>(last.names);
      const double first = (held * before.first + more * (last.first - held * apart)) / (held + more);
      const Row both = place({first, before.names + last.names});
      rows.pop_back();
      rows.back() = both;
    }
  }
  std::vector<double> names;
  for (const Row& row : rows) {
    for (std::size_t i = 0; i < row.names; ++i) names.push_back(row.first + apart * static_cast<double>(i));
  }
  return names;
}

/// All places but mitres, moved to be apart; of more than there is room for the first of those that are near to one another.
/// Mitres, of which there are many, where all others leave their place free.
/// @param low, high  of the names [mm]
/// @return each with where its name is, across
std::vector<std::pair<MarkedPlace, double>> named_below(std::vector<MarkedPlace> places, double apart,
                                                        double low, double high) {
  std::stable_sort(places.begin(), places.end(),
                   [](const auto& a, const auto& b) { return a.at.x < b.at.x; });
  const auto mitres = std::stable_partition(places.begin(), places.end(), [](const MarkedPlace& place) {
    return !place.what.starts_with("mitre");
  });
  std::vector<MarkedPlace> told(places.begin(), mitres);
  const auto too_near = [&](const MarkedPlace& a, const MarkedPlace& b) { return b.at.x - a.at.x < apart; };
  if (static_cast<double>(told.size()) * apart > high - low)
    told.erase(std::unique(told.begin(), told.end(), too_near), told.end());
  std::vector<double> at;
  for (const MarkedPlace& place : told) at.push_back(place.at.x);
  const std::vector<double> names = beside_one_another(at, apart, low, high);
  std::vector<std::pair<MarkedPlace, double>> named;
  for (std::size_t i = 0; i < told.size(); ++i) named.emplace_back(told[i], names[i]);
  for (auto place = mitres; place != places.end(); ++place) {
    const auto in_the_way = [&](const auto& one) {
      const auto [from, to] = std::minmax(one.first.at.x, one.second);
      return place->at.x > from - apart && place->at.x < to + apart;
    };
    if (std::none_of(named.begin(), named.end(), in_the_way)) named.emplace_back(*place, place->at.x);
  }
  return named;
}

/// Ends, joints and supports: a chain line down from each to its name below the view, where nothing else is drawn, the last of
/// it aslant where names would lie across one another. Mitres where others leave room; the setting-out table has all.
/// @param whole  what all sheets together show
/// @param paper  that names may take [mm of paper]
void add_marks(SheetView& view, const Workshop& workshop, const Eye& eye, const PlaneBox& seen,
               const PlaneBox& whole, const PlaneBox& paper) {
  const double per_paper = 1.0 / view.scale;
  constexpr double kBelow = 12.0;  // of the names, with room for a dimension above them, on paper [mm]
  constexpr double kAslant = 2.5;  // of a line to a name that is moved, on paper [mm]
  constexpr double kEdge = 2.0;    // taste: names keep from the edge of the paper [mm]
  std::vector<MarkedPlace> places = marked_places(workshop, whole, eye);
  if (seen.low.x > whole.low.x)
    std::erase_if(places, [&](const MarkedPlace& place) { return place.at.x < seen.low.x; });
  if (seen.high.x < whole.high.x)
    std::erase_if(places, [&](const MarkedPlace& place) { return place.at.x > seen.high.x; });
  const auto on_drawing = [&](double x) { return view.anchor.x + (x - view.at.x) * per_paper; };
  const std::size_t layer = view.drawing.layer({"JOINTS", LineStyle::chain, 0.18, 1});
  const double low = seen.low.y - kBelow * per_paper;
  for (const auto& [place, x] :
       named_below(std::move(places), kNamesApart * per_paper, on_drawing(paper.low.x + kEdge),
                   on_drawing(paper.high.x - kEdge))) {
    const double bend = x == place.at.x ? low : low + kAslant * per_paper;
    for (const auto& [from, to] : clear_of_length(place.at, bend, seen, per_paper))
      view.drawing.line(layer, from, to);
    if (bend != low) view.drawing.line(layer, {place.at.x, bend}, {x, low});
    DrawnText text;
    text.layer = layer;
    text.at = {x + 1.25 * per_paper, low - 1.0 * per_paper};
    text.text = place.what.substr(0, place.what.find_first_of(",:"));
    text.angle = Angle::from_degrees(90.0);
    text.anchor = TextAnchor::right;
    view.drawing.texts.push_back(std::move(text));
  }
}

/// Overall sizes of the parts, not of the balloons round them.
/// @param numbered  on the right: the height stands beyond, where no line to a part runs through it
void add_sizes(SheetView& side, const PlaneBox& beside, bool numbered, SheetView& plan,
               const PlaneBox& above) {
  constexpr double kAway = -kSizeAway;
  const std::size_t thin = side.drawing.layer({"DIM", LineStyle::continuous, 0.18, 7});
  side.drawing.dimensions.push_back(
      {thin, beside.low, {beside.high.x, beside.low.y}, kAway, DimensionKind::level, ""});
  side.drawing.dimensions.push_back({thin,
                                     {beside.high.x, beside.low.y},
                                     beside.high,
                                     kAway - (numbered ? kBalloonAway : 0.0),
                                     DimensionKind::upright,
                                     ""});
  const std::size_t width = plan.drawing.layer({"DIM", LineStyle::continuous, 0.18, 7});
  plan.drawing.dimensions.push_back(
      {width, {above.high.x, above.low.y}, above.high, kAway, DimensionKind::upright, ""});
}

constexpr double kNoteHeight = 2.5;
constexpr double kNoteStep = 4.5;

/// Notes in lines no wider than a room [mm].
std::vector<std::string> note_lines(const std::vector<std::string>& notes, double room) {
  std::vector<std::string> lines;
  for (const std::string& note : notes) {
    std::string line;
    for (std::size_t at = 0; at < note.size();) {
      const std::size_t end = std::min(note.find(' ', at), note.size());
      const std::string longer = line + (line.empty() ? "" : " ") + note.substr(at, end - at);
      if (!line.empty() && stroked_width(longer, kNoteHeight) > room) {
        lines.push_back(std::move(line));
        line = note.substr(at, end - at);
      } else {
        line = longer;
      }
      at = end + 1;
    }
    lines.push_back(std::move(line));
  }
  return lines;
}

/// Notes beside the title block, as many as there is room for.
/// @return whether all were told
bool add_notes(const std::vector<std::string>& notes, Sheet& sheet) {
  const PlaneBox room = notes_area(sheet);
  std::vector<std::string> lines = note_lines(notes, room.width());
  const auto most = static_cast<std::size_t>(room.height() / kNoteStep);
  const bool all = lines.size() <= most;
  if (!all) {
    lines.resize(most - 1);
    lines.emplace_back("... and more on the sheet of notes.");
  }
  Vec2 at{room.low.x, room.high.y - kNoteHeight};
  for (std::string& line : lines) {
    DrawnText text;
    text.at = at;
    text.text = std::move(line);
    text.height_mm = kNoteHeight;
    sheet.texts.push_back(std::move(text));
    at.y -= kNoteStep;
  }
  return all;
}

/// What is not as asked for, each in one paragraph, and the notes.
std::vector<std::string> all_notes(const Workshop& workshop) {
  std::vector<std::string> notes;
  for (const Issue& shortfall : workshop.shortfalls) {
    notes.push_back("Not as asked for: " + shortfall.what + "." +
                    (shortfall.why.empty() ? "" : " " + shortfall.why) +
                    (shortfall.hint.empty() ? "" : " Try: " + shortfall.hint + "."));
  }
  notes.insert(notes.end(), workshop.notes.begin(), workshop.notes.end());
  return notes;
}

std::vector<Sheet> sheets_of_notes(const Workshop& workshop) {
  SheetTable table;
  table.caption = "Notes";
  table.widths_mm = {170.0};
  table.header = {"of this set"};
  for (std::string& line : note_lines(all_notes(workshop), table.widths_mm.front() - 4.0)) {
    table.rows.push_back({std::move(line)});
  }
  return table_sheets(title_of(workshop, "Notes"), PaperSize::a4, std::move(table));
}

/// Both views of a workshop on a sheet, with numbers, names and sizes.
/// @param whole  from the side, what all sheets together show
Sheet arrangement_sheet(const Workshop& workshop, std::string title, const PlaneBox* whole) {
  Sheet sheet = blank_sheet(PaperSize::a3);
  sheet.title = title_of(workshop, std::move(title));
  const PlaneBox room = drawing_area(sheet);
  Drawing side = side_view(workshop);
  Drawing plan = plan_view(workshop);
  const PlaneBox above = bounds(plan).value_or(PlaneBox{});
  const PlaneBox beside = bounds(side).value_or(PlaneBox{});
  // Both views at one scale, the plan below (first-angle projection): each gets its share of the height that balloons,
  // dimensions and names leave.
  const double free = room.height() - kBalloons - kNames - kAroundPlan;
  const double share = above.height() / std::max(above.height() + beside.height(), 1e-9);
  const double plan_height = share * free;
  const PlaneBox for_plan{{room.low.x + 5.0, room.low.y + 0.5 * kAroundPlan},
                          {room.high.x - kDimension, room.low.y + 0.5 * kAroundPlan + plan_height}};
  const PlaneBox for_side = shrunk(room, 5.0, plan_height + kAroundPlan + kNames, kDimension, kBalloons);
  SheetView from_side = fitted_view(std::move(side), for_side);
  SheetView from_above = fitted_view(std::move(plan), for_plan);
  from_side.scale = from_above.scale = std::min(from_side.scale, from_above.scale);
  const Eye eye = eye_beside(workshop);
  const bool numbered = add_balloons(from_side, workshop, eye, beside, room);
  add_marks(from_side, workshop, eye, beside, whole != nullptr ? *whole : beside, room);
  add_sizes(from_side, beside, numbered, from_above, above);
  sheet.views = {std::move(from_side), std::move(from_above)};
  return sheet;
}

}  // namespace

namespace {

/// The sheets of a workshop's stretches, at a larger scale than the whole where more of them make it so.
std::vector<Sheet> stretch_sheets(const Workshop& workshop, const SheetView& whole) {
  // Seen before numbers and names were added: as the parts are.
  const PlaneBox seen = bounds(side_view(workshop)).value_or(PlaneBox{});
  const auto sheets_with = [&](double longest) {
    const std::vector<Workshop> stretches =
        stretches_of(workshop, eye_beside(workshop), kMostNumbers, longest);
    std::vector<Sheet> sheets;
    for (const Workshop& stretch : stretches) {
      sheets.push_back(arrangement_sheet(stretch,
                                         "Arrangement, stretch " + std::to_string(sheets.size() + 1) +
                                             " of " + std::to_string(stretches.size()),
                                         &seen));
      (void)add_notes({"Pieces whose middles lie in this stretch, with how many of a number there are."},
                      sheets.back());
    }
    return sheets;
  };
  const auto is_larger = [&](const Sheet& sheet) { return sheet.views.front().scale > whole.scale; };
  const auto all_larger = [&](const std::vector<Sheet>& some) {
    return std::all_of(some.begin(), some.end(), is_larger);
  };
  std::vector<Sheet> sheets = sheets_with(std::numeric_limits<double>::infinity());
  constexpr int kMostCuts = 6;
  for (int cuts = 2; cuts <= kMostCuts && !all_larger(sheets); ++cuts) {
    std::vector<Sheet> shorter = sheets_with(seen.width() / cuts);
    if (all_larger(shorter)) sheets = std::move(shorter);
  }
  return sheets;
}

}  // namespace

std::vector<Sheet> general_arrangement(const Workshop& workshop) {
  std::vector<Sheet> sheets{arrangement_sheet(workshop, "General arrangement", nullptr)};
  std::vector<std::string> notes = all_notes(workshop);
  if (workshop.parts.size() > kMostNumbers) {
    for (Sheet& stretch : stretch_sheets(workshop, sheets.front().views.front()))
      sheets.push_back(std::move(stretch));
    notes.insert(notes.begin(), "One number a family of parts; all numbers are on sheets 2 to " +
                                    std::to_string(sheets.size()) + ".");
  }
  if (!add_notes(notes, sheets.front())) {
    for (Sheet& more : sheets_of_notes(workshop)) sheets.push_back(std::move(more));
  }
  return sheets;
}

}  // namespace glissade::drawing
