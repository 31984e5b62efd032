#include "glissade/parts/nest.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/units.hpp"

#include "core/least_rectangle.hpp"
#include "core/millimetres.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

namespace glissade {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Of chords that stand for arcs where columns are measured; spacing is widened by as much.
constexpr double kSagitta = 2e-5;
/// Columns that are looked at together; a power of 2.
constexpr std::size_t kBlock = 16;

// --- shapes

/// kBlock columns of a piece.
struct Block {
  std::size_t from = 0;
  double highest_low = 0.0;  ///< of its underside
};

/// Underside and top of a piece in one of its attitudes, column by column; infinite where it has nothing.
struct Attitude {
  PlaneMotion motion;  ///< its box's lower left corner to the origin
  double width = 0.0;
  double height = 0.0;
  std::vector<double> low;
  std::vector<double> high;
  double lowest = 0.0;        ///< of `low`
  std::vector<Block> blocks;  ///< of narrow pieces none
  double above_low = 0.0;     ///< area between its underside and its top, column by column [m^2]
};

void cover(Attitude& attitude, Vec2 a, Vec2 b, double column) {
  if (a.x > b.x) std::swap(a, b);
  const auto last = static_cast<double>(attitude.low.size() - 1);
  const auto first_column = static_cast<std::size_t>(std::clamp(std::floor(a.x / column), 0.0, last));
  const auto last_column = static_cast<std::size_t>(std::clamp(std::floor(b.x / column), 0.0, last));
  for (std::size_t i = first_column; i <= last_column; ++i) {
    const auto at = [&](double x) {
      const double inside = std::clamp(x, a.x, b.x);
      return b.x > a.x ? a.y + (b.y - a.y) * (inside - a.x) / (b.x - a.x) : a.y;
    };
    const double left = b.x > a.x ? at(static_cast<double>(i) * column) : std::min(a.y, b.y);
    const double right = b.x > a.x ? at(static_cast<double>(i + 1) * column) : std::max(a.y, b.y);
    attitude.low[i] = std::min({attitude.low[i], left, right});
    attitude.high[i] = std::max({attitude.high[i], left, right});
  }
}

Attitude attitude_of(const ArcPath& outline, double angle, double column) {
  Attitude attitude;
  attitude.motion = PlaneMotion::turn(angle);
  const PlaneBox box = bounds(moved(outline, attitude.motion));
  attitude.motion.shift = -1.0 * box.low;
  attitude.width = box.width();
  attitude.height = box.height();
  const auto columns = static_cast<std::size_t>(std::floor(attitude.width / column)) + 1;
  attitude.low.assign(columns, kInfinity);
  attitude.high.assign(columns, -kInfinity);
  const std::vector<Vec2> points = flattened(moved(outline, attitude.motion), kSagitta);
  for (std::size_t i = 0; i + 1 < points.size(); ++i) cover(attitude, points[i], points[i + 1], column);
  attitude.lowest = *std::min_element(attitude.low.begin(), attitude.low.end());
  for (std::size_t i = 0; i + kBlock <= columns; i += kBlock) {
    const auto from = attitude.low.begin() + static_cast<std::ptrdiff_t>(i);
    attitude.blocks.push_back({i, *std::max_element(from, from + kBlock)});
  }
  for (const double low : attitude.low) attitude.above_low += column * (attitude.height - low);
  return attitude;
}

// --- one sheet

/// The top of the heap on a sheet, column by column, raised and widened by the spacing.
class Heap {
 public:
  Heap(const NestStock& stock, double column)
      : stock_(stock),
        column_(column),
        tops_(static_cast<std::size_t>(std::floor(stock.width / column)) + 1, stock.margin - stock.spacing) {
    look_over();
  }

  /// Where a piece comes to lie, and how high it then reaches.
  struct Place {
    Vec2 at;
    double top = 0.0;
  };

  /// @return the place where its top is lowest, of several the leftmost; none where it does not fit
  [[nodiscard]] std::optional<Place> place_for(const Attitude& attitude) const {
    std::optional<Place> best;
    const double room = stock_.width - 2.0 * stock_.margin - attitude.width;
    if (room < 0.0) return best;
    // Wherever it lies, its lowest column stands on some column of the heap, and the room above the heap holds it.
    const double limit = stock_.height - stock_.margin;
    if (lowest_ + stock_.spacing - attitude.lowest + attitude.height > limit) return best;
    if (attitude.above_low > room_above_ + kRounding) return best;
    const auto steps = static_cast<std::size_t>(std::floor(room / column_));
    double ceiling = limit;  // above it no place is of use
    std::size_t in_the_way = 0;
    for (std::size_t step = 0; step <= steps; ++step) {
      const double x = stock_.margin + static_cast<double>(step) * column_;
      const auto shift = static_cast<std::size_t>(std::floor(x / column_));
      if (is_blocked(attitude, shift, ceiling, in_the_way)) continue;
      const double y = settled(attitude, shift, ceiling);
      const double top = y + attitude.height;
      if (top > ceiling) continue;
      best = Place{{x, y}, top};
      ceiling = top - 1e-9;
    }
    return best;
  }

  void add(const Attitude& attitude, Vec2 at) {
    const auto reach = static_cast<std::ptrdiff_t>(std::ceil((stock_.spacing + kSagitta) / column_)) + 1;
    const auto shift = static_cast<std::ptrdiff_t>(std::floor(at.x / column_));
    const auto count = static_cast<std::ptrdiff_t>(attitude.high.size());
    for (std::ptrdiff_t i = -reach; i <= count + reach; ++i) {
      const std::ptrdiff_t on = shift + i;
      if (on < 0 || on >= static_cast<std::ptrdiff_t>(tops_.size())) continue;
      double top = -kInfinity;
      for (std::ptrdiff_t k = std::max<std::ptrdiff_t>(0, i - reach); k <= std::min(count - 1, i + reach);
           ++k) {
        top = std::max(top, attitude.high[static_cast<std::size_t>(k)]);
      }
      double& known = tops_[static_cast<std::size_t>(on)];
      known = std::max(known, at.y + top + 2.0 * kSagitta);
    }
    look_over();
  }

 private:
  static constexpr double kRounding = 1e-9;  // of areas [m^2]

  /// Whether some block of the underside alone shows that a piece does not stay below the ceiling.
  /// @param block  the one to ask first; becomes the one that is in the way
  [[nodiscard]] bool is_blocked(const Attitude& attitude, std::size_t shift, double ceiling,
                                std::size_t& block) const {
    const auto stands_up = [&](const Block& one) {
      const double top = block_tops_[std::min(shift + one.from, block_tops_.size() - 1)];
      return top + stock_.spacing - one.highest_low + attitude.height > ceiling;
    };
    if (block < attitude.blocks.size() && stands_up(attitude.blocks[block])) return true;
    const auto found = std::find_if(attitude.blocks.begin(), attitude.blocks.end(), stands_up);
    block = static_cast<std::size_t>(found - attitude.blocks.begin());
    return found != attitude.blocks.end();
  }

  /// @return how high a piece comes to lie; where it reaches above the ceiling, enough to tell
  [[nodiscard]] double settled(const Attitude& attitude, std::size_t shift, double ceiling) const {
    double y = stock_.margin;
    // The piece's columns lie askew to the sheet's: each looks at both that it touches, and a spacing beyond.
    for (std::size_t i = 0; i < attitude.low.size(); ++i) {
      const double top = std::max(tops_[std::min(shift + i, tops_.size() - 1)],
                                  tops_[std::min(shift + i + 1, tops_.size() - 1)]);
      y = std::max(y, top + stock_.spacing - attitude.low[i]);
      if (y + attitude.height > ceiling) break;
    }
    return y;
  }

  void look_over() {
    lowest_ = *std::min_element(tops_.begin(), tops_.end());
    room_above_ = 0.0;
    const double limit = stock_.height - stock_.margin - stock_.spacing;
    for (const double top : tops_) room_above_ += column_ * std::max(0.0, limit - top);
    // Of the columns that a block touches, one more than it has: maxima of 2, 4, 8, 16, then 17.
    block_tops_ = tops_;
    const std::size_t last = tops_.size() - 1;
    for (std::size_t reach = 1; reach < kBlock; reach *= 2) {
      for (std::size_t i = 0; i <= last; ++i)
        block_tops_[i] = std::max(block_tops_[i], block_tops_[std::min(i + reach, last)]);
    }
    for (std::size_t i = 0; i <= last; ++i)
      block_tops_[i] = std::max(block_tops_[i], tops_[std::min(i + kBlock, last)]);
  }

  NestStock stock_;
  double column_;
  std::vector<double> tops_;
  std::vector<double> block_tops_;  ///< the highest of a column and the kBlock after it
  double lowest_ = 0.0;             ///< of `tops_`
  double room_above_ = 0.0;         ///< up to where a piece may reach, a spacing off [m^2]
};

/// A piece to be laid down, with its attitudes.
struct Piece {
  std::size_t part = 0;
  double area = 0.0;
  std::vector<Attitude> attitudes;
};

struct SheetInWork {
  Heap heap;
  NestedSheet sheet;
  std::vector<std::size_t>
      refused;  ///< parts that found no place; none is there later, since heaps only grow
};

bool lay(SheetInWork& sheet, const Piece& piece) {
  if (std::find(sheet.refused.begin(), sheet.refused.end(), piece.part) != sheet.refused.end()) return false;
  std::optional<Heap::Place> best;
  const Attitude* chosen = nullptr;
  for (const Attitude& attitude : piece.attitudes) {
    const auto place = sheet.heap.place_for(attitude);
    if (place && (!best || place->top < best->top - 1e-9)) {
      best = place;
      chosen = &attitude;
    }
  }
  if (!best) {
    sheet.refused.push_back(piece.part);
    return false;
  }
  PlaneMotion motion = chosen->motion;
  motion.shift = motion.shift + best->at;
  sheet.heap.add(*chosen, best->at);
  sheet.sheet.pieces.push_back({piece.part, motion});
  sheet.sheet.utilisation += piece.area / (sheet.sheet.stock.width * sheet.sheet.stock.height);
  return true;
}

double column_of(const NestStock& stock) {
  constexpr double kMost = 4000.0;
  constexpr double kLeast = 20.0;
  return std::clamp(kNestColumn, stock.width / kMost, stock.width / kLeast);
}

Piece piece_of(const ShopPart& part, std::size_t index, double column) {
  Piece piece;
  piece.part = index;
  piece.area = moments(part.pattern->region).area;
  const ArcPath& outline = part.pattern->region.outline;
  const double lying = core::lying_angle(flattened(outline, kSagitta));
  // Along the sheet and across it, end for end; and as it was drawn, whose box is the one that a designer sees.
  std::vector<double> angles = {lying, lying + 2.0 * kRightAngle, lying + kRightAngle,
                                lying + 3.0 * kRightAngle};
  for (const double drawn : {0.0, kRightAngle}) {
    constexpr double kSame = 1e-12;
    const auto is_drawn = [&](double angle) {
      return std::fabs(math::sin(angle - drawn)) < kSame && math::cos(angle - drawn) > 0.0;
    };
    if (std::none_of(angles.begin(), angles.end(), is_drawn)) angles.push_back(drawn);
  }
  for (const double angle : angles) piece.attitudes.push_back(attitude_of(outline, angle, column));
  return piece;
}

Issue too_large(const ShopPart& part, const Piece& piece, const NestStock& stock) {
  const Attitude& lying = piece.attitudes.front();
  return {"split.sheet",
          "part " + std::to_string(part.number) + ", " + part.name + ": its pattern of " +
              length_text(lying.width) + " x " + length_text(lying.height) + " fits no sheet",
          "Sheets are " + length_text(stock.width) + " x " + length_text(stock.height) +
              " with a margin of " + length_text(stock.margin) + ".",
          "a larger sheet, a smaller margin, or shorter parts"};
}

SheetInWork fresh_sheet(const ShopPart& part, const NestStock& stock, double column) {
  NestedSheet sheet;
  sheet.material = part.material;
  sheet.thickness = part.thickness;
  sheet.stock = stock;
  return {Heap(stock, column), std::move(sheet), {}};
}

/// @param pieces  each fits an empty sheet
void lay_group(std::vector<Piece>& pieces, const Workshop& workshop, const NestStock& stock, double column,
               std::vector<NestedSheet>& done) {
  std::stable_sort(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) {
    return a.attitudes.front().width * a.attitudes.front().height >
           b.attitudes.front().width * b.attitudes.front().height;
  });
  std::vector<SheetInWork> sheets;
  for (const Piece& piece : pieces) {
    const bool laid =
        std::any_of(sheets.begin(), sheets.end(), [&](SheetInWork& sheet) { return lay(sheet, piece); });
    if (laid) continue;
    sheets.push_back(fresh_sheet(workshop.parts[piece.part], stock, column));
    (void)lay(sheets.back(), piece);
  }
  for (SheetInWork& sheet : sheets) done.push_back(std::move(sheet.sheet));
}

/// @return a thickness as names of sheets have it [mm]
std::string shown(double thickness) {
  return rounded_text(core::kMillimetres * thickness, 6);
}

/// By what names say: no two sheets are one file, and pieces whose thicknesses differ by rounding lie on one stock.
bool are_of_one_stock(const NestedSheet& sheet, const NestedSheet& other) {
  return other.material == sheet.material && shown(other.thickness) == shown(sheet.thickness);
}

/// @return "nest_S235_4mm_1_of_2"
std::string name_of(const std::vector<NestedSheet>& sheets, std::size_t index) {
  const NestedSheet& sheet = sheets[index];
  const auto alike = [&](const NestedSheet& other) { return are_of_one_stock(sheet, other); };
  const auto here = sheets.begin() + static_cast<std::ptrdiff_t>(index);
  const auto count = std::count_if(sheets.begin(), sheets.end(), alike);
  const auto number = std::count_if(sheets.begin(), here, alike) + 1;
  std::string material;
  for (const char c : sheet.material) {
    const bool plain =
        (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '.' || c == '-';
    material += plain ? c : '-';
  }
  return "nest_" + material + "_" + shown(sheet.thickness) + "mm_" + std::to_string(number) + "_of_" +
         std::to_string(count);
}

/// Thicknesses that are one stock [m].
constexpr double kSameStock = 1e-9;

}  // namespace

std::vector<Issue> stock_problems(const NestStock& stock) {
  std::vector<Issue> issues;
  const auto object = [&](const char* key, std::string what, const char* why, std::string hint) {
    issues.push_back({std::string("split.") + key, key + (": " + std::move(what)), why, std::move(hint)});
  };
  for (const double side : {stock.width, stock.height}) {
    if (!(std::isfinite(side) && side > 0.0))
      object("sheet", length_text(side) + " is not positive", "", "sheet: [3 m, 1.5 m]");
  }
  const bool whole = issues.empty();
  if (!(stock.margin >= 0.0)) {
    object("margin", length_text(stock.margin) + " is negative", "It stays free along the sheet's edges.",
           "margin: 5 mm");
  } else if (whole && !(2.0 * stock.margin < stock.height)) {
    object("margin",
           length_text(stock.margin) + " leaves nothing of a sheet that is " + length_text(stock.height) +
               " wide",
           "Both of its edges keep it free.", "less than " + length_text(0.5 * stock.height));
  }
  if (!(stock.spacing >= 0.0)) {
    object("spacing", length_text(stock.spacing) + " is negative", "Parts on a sheet do not overlap.",
           "spacing: 10 mm");
  } else if (whole && !(stock.spacing < stock.height)) {
    object(
        "spacing",
        length_text(stock.spacing) + " is no less than the width of the sheet, " + length_text(stock.height),
        "Parts on a sheet would never lie side by side.",
        "a spacing of less than " + length_text(stock.height) + ", or a larger sheet");
  }
  return issues;
}

std::vector<NestedSheet> nest(const Workshop& workshop, const NestStock& stock) {
  if (std::vector<Issue> problems = stock_problems(stock); !problems.empty())
    throw InputError(std::move(problems));
  const double column = column_of(stock);
  // By nanometres: what measures add up to is off by rounding.
  std::map<std::pair<std::string, double>, std::vector<Piece>> groups;
  std::vector<Issue> issues;
  for (std::size_t i = 0; i < workshop.parts.size(); ++i) {
    const ShopPart& part = workshop.parts[i];
    if (!part.pattern || part.bought_in || part.places.empty()) continue;
    const Piece piece = piece_of(part, i, column);
    SheetInWork fresh = fresh_sheet(part, stock, column);
    if (!lay(fresh, piece)) issues.push_back(too_large(part, piece, stock));
    auto& group = groups[{part.material, std::nearbyint(part.thickness / kSameStock)}];
    group.insert(group.end(), part.quantity(), piece);
  }
  if (!issues.empty()) throw InputError(std::move(issues));
  std::vector<NestedSheet> sheets;
  for (auto& [kind, pieces] : groups) lay_group(pieces, workshop, stock, column, sheets);
  for (std::size_t i = 0; i < sheets.size(); ++i) sheets[i].name = name_of(sheets, i);
  return sheets;
}

std::vector<StockGroup> by_stock(std::span<const NestedSheet> sheets) {
  std::vector<StockGroup> groups;
  while (!sheets.empty()) {
    const auto next = std::find_if_not(sheets.begin(), sheets.end(), [&](const NestedSheet& sheet) {
      return are_of_one_stock(sheets.front(), sheet);
    });
    const auto count = static_cast<std::size_t>(next - sheets.begin());
    StockGroup group{sheets.first(count), 0.0};
    for (const NestedSheet& sheet : group.sheets)
      group.utilisation += sheet.utilisation / static_cast<double>(count);
    groups.push_back(group);
    sheets = sheets.subspan(count);
  }
  return groups;
}

}  // namespace glissade
