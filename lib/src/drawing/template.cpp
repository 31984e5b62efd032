#include "core/plane_geometry.hpp"
#include "drawing/ink.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace glissade {
namespace {

// What office printers leave white [mm].
constexpr double kUnprinted = 8.0;
constexpr double kScaleBar = 100.0;
constexpr double kFoot = 14.0;           // room for the words below the picture
constexpr double kBarRoom = 4.0;         // left of the picture, for the upright bar with its marks
constexpr double kKey = 7.0;             // height of the key to the tiles
constexpr double kLongestPage = 5000.0;  // PDF pages have 14 400 pt at most, 5080 mm

/// Bars of 100 mm in both directions, to be held against a rule before anything is cut.
void scale_bars(Drawing& drawing, Vec2 corner) {
  const std::size_t thin = drawing.layer(drawing::thin_ink());
  for (const bool level : {true, false}) {
    const Vec2 along = level ? Vec2{1.0, 0.0} : Vec2{0.0, 1.0};
    const Vec2 aside = level ? Vec2{0.0, 1.0} : Vec2{1.0, 0.0};
    drawing.line(thin, corner, corner + kScaleBar * along);
    for (int tick = 0; tick <= 10; ++tick) {
      const double size = tick % 5 == 0 ? 3.0 : 1.5;
      const Vec2 foot = corner + (0.1 * kScaleBar * tick) * along;
      drawing.line(thin, foot, foot + size * aside);
    }
  }
  DrawnText text;
  text.layer = drawing.layer(drawing::text_ink());
  text.at = corner + Vec2{6.0, 4.5};
  text.text = "100 mm both ways: print at 100 %, no fit to page";
  drawing.texts.push_back(std::move(text));
}

/// Crosses where neighbouring sheets are laid over each other.
void register_marks(Drawing& drawing, const PlaneBox& tile, double overlap) {
  const std::size_t thin = drawing.layer(drawing::thin_ink());
  constexpr double kArm = 4.0;
  for (const double x : {tile.low.x + 0.5 * overlap, tile.high.x - 0.5 * overlap}) {
    for (const double y : {tile.low.y + 0.5 * overlap, tile.high.y - 0.5 * overlap}) {
      drawing.line(thin, {x - kArm, y}, {x + kArm, y});
      drawing.line(thin, {x, y - kArm}, {x, y + kArm});
    }
  }
}

Sheet bare_sheet(double width, double height) {
  Sheet sheet;
  sheet.width_mm = width;
  sheet.height_mm = height;
  sheet.frame = false;
  return sheet;
}

SheetView life_size(Drawing drawing, Vec2 at, Vec2 anchor) {
  SheetView view;
  view.drawing = std::move(drawing);
  view.at = at;
  view.anchor = anchor;
  return view;
}

/// Bars and words of a sheet, in millimetres of paper.
SheetView foot_of(const std::string& words, Vec2 corner, double width) {
  Drawing foot;
  scale_bars(foot, corner);
  drawing::write_fitted(foot, foot.layer(drawing::text_ink()), words, corner + Vec2{0.0, -4.5}, 2.5, width);
  return life_size(std::move(foot), {}, {});
}

// --- which tiles

/// A tile of a drawing; row 0 is the uppermost.
struct Tile {
  int row = 0;
  int column = 0;
};

/// Windows over a drawing, each a step from the next, and those of them that show something of it.
struct TilePlan {
  Vec2 window;  ///< width and height of one [mm]
  double overlap = 0.0;
  int columns = 1;
  int rows = 1;
  Vec2 start;  ///< lower left corner of the lowest on the left
  std::vector<Tile> kept;

  [[nodiscard]] Vec2 step() const { return window - Vec2{overlap, overlap}; }
  [[nodiscard]] PlaneBox box(Tile tile) const {
    const Vec2 low = start + Vec2{tile.column * step().x, (rows - 1 - tile.row) * step().y};
    return {low, low + window};
  }
};

/// Which of the tiles, row by row, a line or the inside of a contour lies in.
std::vector<bool> shown_by(const TilePlan& plan, const Drawing& drawing) {
  std::vector<bool> shown(static_cast<std::size_t>(plan.rows) * static_cast<std::size_t>(plan.columns));
  const auto each_tile = [&](const auto& asks) {
    for (int row = 0; row < plan.rows; ++row) {
      for (int column = 0; column < plan.columns; ++column) {
        const std::size_t at = static_cast<std::size_t>(row) * static_cast<std::size_t>(plan.columns) +
                               static_cast<std::size_t>(column);
        if (!shown[at]) shown[at] = asks(plan.box({row, column}));
      }
    }
  };
  constexpr double kSagitta = 0.05;  // [mm]
  for (const DrawnPath& drawn : drawing.paths) {
    const std::vector<Vec2> points = flattened(drawn.path, kSagitta);
    each_tile([&](const PlaneBox& box) {
      for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        if (core::touches_rectangle(points[i], points[i + 1], box.low, box.high)) return true;
      }
      return drawn.path.closed && contains(drawn.path, 0.5 * (box.low + box.high));
    });
  }
  for (const DrawnCircle& drawn : drawing.circles) {
    const Vec2 reach{drawn.circle.radius, drawn.circle.radius};
    const PlaneBox round{drawn.circle.centre - reach, drawn.circle.centre + reach};
    each_tile([&](const PlaneBox& box) {
      return round.low.x <= box.high.x && round.high.x >= box.low.x && round.low.y <= box.high.y &&
             round.high.y >= box.low.y;
    });
  }
  return shown;
}

/// All tiles together reach beyond the drawing alike on both sides.
TilePlan plan_tiles(const Drawing& drawing, const PlaneBox& box, Vec2 window, double overlap) {
  TilePlan plan;
  plan.window = window;
  plan.overlap = overlap;
  const auto count = [&](double length, double room) {
    return length <= room ? 1 : static_cast<int>(std::ceil((length - overlap) / (room - overlap)));
  };
  plan.columns = count(box.width(), window.x);
  plan.rows = count(box.height(), window.y);
  const Vec2 whole = Vec2{plan.columns * plan.step().x, plan.rows * plan.step().y} + Vec2{overlap, overlap};
  plan.start = 0.5 * (box.low + box.high) - 0.5 * whole;
  const std::vector<bool> shown = shown_by(plan, drawing);
  std::size_t at = 0;
  for (int row = 0; row < plan.rows; ++row) {
    for (int column = 0; column < plan.columns; ++column) {
      if (shown[at++]) plan.kept.push_back({row, column});
    }
  }
  return plan;
}

// --- sheets of tiles

/// The contours over the tiles, small, the one of a sheet grey.
Drawing key_of(const TilePlan& plan, const Drawing& drawing, Tile here, const PlaneBox& room) {
  Drawing key;
  const std::size_t thin = key.layer(drawing::thin_ink());
  const PlaneBox whole{plan.box({plan.rows - 1, 0}).low, plan.box({0, plan.columns - 1}).high};
  const double scale = std::min(room.width() / whole.width(), room.height() / whole.height());
  const auto place = [&](Vec2 point) { return room.low + scale * (point - whole.low); };
  const PlaneBox own = plan.box(here);
  ArcPath grey = rectangle(place(own.low), place(own.high));
  key.paths.push_back({thin, std::move(grey), 253, {}, true});
  for (const Tile tile : plan.kept) {
    const PlaneBox box = plan.box(tile);
    key.add(thin, rectangle(place(box.low), place(box.high)));
  }
  for (const DrawnPath& drawn : drawing.paths) {
    if (!drawn.path.closed) continue;
    ArcPath path = drawn.path;
    for (PathVertex& vertex : path.vertices) vertex.at = place(vertex.at);
    key.add(thin, std::move(path));
  }
  return key;
}

/// @param paper  of each sheet
/// @param frame  the window on it
std::vector<Sheet> sheets_of(const TilePlan& plan, const Drawing& drawing, const TitleBlock& title,
                             Vec2 paper, const PlaneBox& frame, Vec2 foot) {
  std::vector<Sheet> sheets;
  for (const Tile tile : plan.kept) {
    const PlaneBox box = plan.box(tile);
    Drawing shown = drawing;
    std::string words = title.owner + "; " + title.number + " " + title.title;
    Sheet sheet = bare_sheet(paper.x, paper.y);
    if (plan.kept.size() > 1) {
      register_marks(shown, box, plan.overlap);
      words += "; sheet " + std::to_string(sheets.size() + 1) + " of " + std::to_string(plan.kept.size()) +
               ", row " + std::to_string(tile.row + 1) + " of " + std::to_string(plan.rows) + ", column " +
               std::to_string(tile.column + 1) + " of " + std::to_string(plan.columns) + "; overlap " +
               std::to_string(std::lround(plan.overlap)) + " mm";
    }
    sheet.views.push_back(life_size(std::move(shown), frame.low, box.low));
    sheet.views.back().clip = frame;
    sheet.views.push_back(foot_of(words, foot, frame.width()));
    if (plan.kept.size() > 1) {
      constexpr double kBesideBar = 10.0;
      const Vec2 low = foot + Vec2{kScaleBar + kBesideBar, 0.0};
      const PlaneBox room{low, {frame.high.x, low.y + kKey}};
      sheet.views.push_back(life_size(key_of(plan, drawing, tile, room), {}, {}));
    }
    sheets.push_back(std::move(sheet));
  }
  return sheets;
}

/// The tiles on paper of a size, upright or lying, whichever takes fewer.
struct PaperPlan {
  TilePlan tiles;
  Vec2 paper;
  PlaneBox frame;
};

PaperPlan plan_paper(const Drawing& drawing, const PlaneBox& box, PaperSize size, double overlap) {
  PaperPlan best;
  for (const bool landscape : {true, false}) {
    const Sheet blank = blank_sheet(size, landscape);
    const PlaneBox frame{{kUnprinted + kBarRoom, kUnprinted + kFoot},
                         {blank.width_mm - kUnprinted, blank.height_mm - kUnprinted}};
    TilePlan tiles = plan_tiles(drawing, box, {frame.width(), frame.height()}, overlap);
    if (best.tiles.kept.empty() || tiles.kept.size() < best.tiles.kept.size())
      best = {std::move(tiles), {blank.width_mm, blank.height_mm}, frame};
  }
  return best;
}

constexpr double kRollEdge = 20.0;
constexpr double kRollFoot = 30.0;  // for bars and words

TilePlan plan_roll(const Drawing& drawing, const PlaneBox& box, double overlap) {
  const double longest = kLongestPage - 2.0 * kRollEdge;
  constexpr double kRound = 2.0;  // no line is cut off along its middle [mm]
  return plan_tiles(drawing, box, {std::min(box.width() + kRound, longest), box.height() + kRound}, overlap);
}

}  // namespace

std::vector<Sheet> tiled_template(const Drawing& drawing, const TitleBlock& title, PaperSize size,
                                  double overlap_mm) {
  const auto box = bounds(drawing);
  if (!box) return {};
  const PaperPlan plan = plan_paper(drawing, *box, size, overlap_mm);
  return sheets_of(plan.tiles, drawing, title, plan.paper, plan.frame, {kUnprinted, kUnprinted + 6.0});
}

std::vector<Sheet> roll_template(const Drawing& drawing, const TitleBlock& title, double overlap_mm) {
  const auto box = bounds(drawing);
  if (!box) return {};
  const TilePlan plan = plan_roll(drawing, *box, overlap_mm);
  const Vec2 low{kRollEdge, kRollEdge + kRollFoot};
  const Vec2 foot{kRollEdge - kBarRoom, kRollEdge};
  const Vec2 paper{std::max(plan.window.x, kScaleBar + 20.0) + 2.0 * kRollEdge,
                   std::max(plan.window.y, kScaleBar) + 2.0 * kRollEdge + kRollFoot};
  return sheets_of(plan, drawing, title, paper, {low, low + plan.window}, foot);
}

std::size_t template_sheets(const Drawing& drawing, std::optional<PaperSize> size, double overlap_mm) {
  const auto box = bounds(drawing);
  if (!box) return 0;
  return (size ? plan_paper(drawing, *box, *size, overlap_mm).tiles : plan_roll(drawing, *box, overlap_mm))
      .kept.size();
}

}  // namespace glissade
